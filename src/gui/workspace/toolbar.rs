//! The bar over the workspace plot: from where it is looked at, what is shown, and how.

use crate::text::stretch;
use egui::{Align, ComboBox, Layout, Popup, PopupCloseBehavior, RichText, Slider, Ui, vec2};

use crate::gui::core::loaded_session::Component;
use crate::gui::plots::{gestures, picture};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::{Aspect, Colouring, Plane, Plot, Standard};
use crate::gui::widgets::{self, caption, fine, title};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::present::numbers::{significant, trimmed};

use super::model::{magnification as magnification_of, offers, readable};

/// What stands at the beginning of the bar.
pub(crate) type First<'a> = &'a mut dyn FnMut(&mut Ui, &mut Vec<Command>);

/// Room for it, points.
const FIRST: f32 = 32.0;

/// Something else that stands in the bar.
pub(crate) type ExtraControls = fn(&mut Ui, &Workbench, &mut Vec<Command>);

/// How much of the bar there is room for.
#[derive(Clone, Copy, PartialEq)]
enum Fold {
    /// All of it side by side.
    Open,
    /// The length of vectors is behind a button.
    Narrow,
    /// So is how anything is drawn.
    Tight,
}

/// Shows the bar; `beside` stands above it, `first` at its beginning.
pub(crate) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    extra: Option<ExtraControls>,
    first: First<'_>,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let measured = !workbench.loaded_session().is_empty();
    let drawn = measured && !view.polar();
    let around = measured && view.polar();
    let blends = drawn && workbench.answer().is_some();
    let mut room = ui.available_size();
    room.x /= stretch();
    let beside_first = room.x - FIRST;
    let fold = match room {
        _ if room.y < TIGHT || view.in_space() && beside_first < SPACE_NARROW => Fold::Tight,
        _ if room.x < if view.in_space() { SPACE_WIDE } else { WIDE } => Fold::Narrow,
        _ => Fold::Open,
    };
    let least = if fold == Fold::Tight {
        ROOMY_FOLDED
    } else {
        ROOMY
    };
    let roomy = beside_first > least && extra.is_none();
    // A row of its own would take a sixth of a low plot: before that the slider stands without its words.
    let bare = !roomy && beside_first > least - WORDS && extra.is_none();
    if let Some(beside) = extra {
        widgets::row(ui, |ui| {
            beside(ui, workbench, commands);
            if blends {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    blend(ui, workbench, commands);
                });
            }
        });
    }
    let row = Row {
        drawn,
        around,
        blends: blends && (roomy || bare),
        least: match (
            blends,
            around && fold == Fold::Open && workbench.answer().is_some(),
        ) {
            _ if extra.is_some() => f32::INFINITY,
            (true, _) => WITH_BLEND,
            (_, true) => WITH_SWITCHES,
            _ => TITLED,
        },
        fold,
    };
    row.show(ui, workbench, first, commands);
    if around && fold != Fold::Open {
        widgets::row(ui, |ui| {
            component(ui, workbench, commands);
            which(ui, workbench, commands);
        });
    }
    if !drawn {
        return;
    }
    match fold {
        Fold::Tight => {}
        Fold::Narrow => {
            widgets::row(ui, |ui| {
                length_folded(ui, workbench, commands);
                beneath(ui, workbench, commands);
                colouring(ui, workbench, commands);
            });
        }
        Fold::Open => {
            widgets::row(ui, |ui| {
                magnification(ui, workbench, commands);
                scale_for(ui, workbench, commands);
                beneath(ui, workbench, commands);
                colouring(ui, workbench, commands);
            });
        }
    }
    if blends && !roomy && !bare && extra.is_none() {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                blend(ui, workbench, commands);
            });
        });
    }
}

/// The first row of the bar.
struct Row {
    /// Whether samples are drawn in a plane or in space.
    drawn: bool,
    /// Whether they are drawn over the direction.
    around: bool,
    /// Whether the slider from before to after stands in it.
    blends: bool,
    /// The room above which the plot has a title, points.
    least: f32,
    fold: Fold,
}

impl Row {
    fn show(
        &self,
        ui: &mut Ui,
        workbench: &Workbench,
        first: First<'_>,
        commands: &mut Vec<Command>,
    ) {
        let open = self.around && self.fold == Fold::Open;
        widgets::row(ui, |ui| {
            first(ui, commands);
            if ui.available_width() > self.least * stretch() {
                title(ui, say!("Workspace"));
            }
            ways(ui, workbench, commands);
            if open {
                component(ui, workbench, commands);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if self.drawn || self.around {
                    picture(ui, plot_of(workbench.view().aspect), commands);
                }
                let fit = Command::View(ViewChange::FitWorkspace);
                gestures::fit(ui, say!("Fit to view"), fit, commands);
                if open {
                    which(ui, workbench, commands);
                }
                if self.drawn && self.fold == Fold::Tight {
                    folded(ui, say!("display"), say!("How it is drawn"), |ui| {
                        everything(ui, workbench, commands);
                    });
                }
                if self.blends {
                    ui.add_space(space::TIGHT);
                    blend(ui, workbench, commands);
                }
            });
        });
    }
}

/// The ways to look at the workspace.
fn ways(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = workbench.view();
    let planes = Plane::ALL.map(|plane| ((Aspect::Plane, plane), plane.name()));
    let [space, polar] = [Aspect::Space, Aspect::Around].map(|aspect| (aspect, view.plane));
    let views = [
        planes[0],
        planes[1],
        planes[2],
        (space, say!("3-D")),
        (polar, say!("polar")),
    ];
    match widgets::segmented(ui, &views, (view.aspect, view.plane)) {
        Some((Aspect::Plane, plane)) => commands.push(Command::View(ViewChange::Look(plane))),
        Some((Aspect::Space, _)) => commands.push(Command::View(ViewChange::LookFrom(None))),
        Some((Aspect::Around, _)) => commands.push(Command::View(ViewChange::LookAround)),
        None => {}
    }
}

fn plot_of(aspect: Aspect) -> Plot {
    match aspect {
        Aspect::Plane => Plot::Workspace,
        Aspect::Space => Plot::Space,
        Aspect::Around => Plot::Polar,
    }
}

/// With less room the plot has no title, and before and after stand in a row of their own, points.
const TITLED: f32 = 440.0;
const WITH_BLEND: f32 = 590.0;
const WITH_SWITCHES: f32 = 680.0;
const ROOMY: f32 = 420.0;
/// The words at the ends of the slider from before to after, points.
const WORDS: f32 = 80.0;
/// The same with a button for how anything is drawn.
const ROOMY_FOLDED: f32 = 570.0;
/// With less room what is seldom changed stands behind a button, points.
const WIDE: f32 = 590.0;
/// The same in space, where there is more of it, and below which all of it does.
const SPACE_WIDE: f32 = 760.0;
const SPACE_NARROW: f32 = 510.0;
/// With less room the list of colours goes without its name, points.
const COLOUR: f32 = 172.0;
/// With less height all of it does, points.
const TIGHT: f32 = 270.0;

/// A button that opens what there is no room for; `name` is what it is called.
fn folded(ui: &mut Ui, text: &str, name: &str, contents: impl FnOnce(&mut Ui)) {
    let text = RichText::new(format!("{text} \u{2026}")).size(size::SMALL);
    let button = ui.button(text);
    ui.ctx()
        .accesskit_node_builder(button.id, |node| node.set_label(name));
    Popup::menu(&button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            ui.spacing_mut().item_spacing = vec2(space::ROW, space::ROW);
            contents(ui);
        });
}

/// How vectors, map and colours are drawn, one below the other.
fn everything(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::row(ui, |ui| magnification(ui, workbench, commands));
    widgets::row(ui, |ui| scale_for(ui, workbench, commands));
    beneath(ui, workbench, commands);
    caption(ui, say!("colour"));
    let shown = coloured(workbench);
    for colouring in Colouring::ALL {
        if offers(workbench, colouring) {
            let text = RichText::new(colouring.name()).size(size::SMALL);
            if ui.radio(colouring == shown, text).clicked() && colouring != shown {
                commands.push(Command::View(ViewChange::Colour(colouring)));
            }
        }
    }
}

/// What the polar view shows.
fn component(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let now = workbench.view().component;
    let planar = workbench.loaded_session().session.samples.z_mm.is_none();
    let list = ComboBox::from_id_salt("polar component");
    let text = RichText::new(now.name()).size(size::SMALL);
    let list = list.width(84.0).selected_text(text).show_ui(ui, |ui| {
        for component in Component::ALL {
            if planar && component.out_of_plane() {
                continue;
            }
            let chosen = component == now;
            if ui.selectable_label(chosen, component.name()).clicked() && !chosen {
                commands.push(Command::View(ViewChange::Component(component)));
            }
        }
    });
    ui.ctx().accesskit_node_builder(list.response.id, |node| {
        node.set_label(say!("Component of the polar view"));
    });
}

/// Whether the polar view shows the deviation before as well, where there is another.
fn which(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    if workbench.answer().is_none() {
        return;
    }
    let shown = [(false, say!("both")), (true, say!("only after"))];
    if let Some(only) = widgets::segmented(ui, &shown, workbench.view().only_after) {
        commands.push(Command::View(ViewChange::OnlyAfter(only)));
    }
}

/// From before to after. What stands at the end that is shown is written stronger.
fn blend(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut blend = workbench.view().blend;
    // Beside the switch of views in a narrow bar.
    let narrow = ui.available_width() < 320.0;
    let bare = ui.available_width() < 160.0 * stretch();
    let palette = Palette::of(ui);
    let end = |ui: &mut Ui, text: &str, shown: bool| {
        let text = RichText::new(text).size(size::SMALL);
        let text = if shown {
            text.color(palette.text).strong()
        } else {
            text.color(palette.muted)
        };
        ui.label(text);
    };
    if !bare {
        end(ui, say!("after"), blend >= 1.0);
    }
    fine(ui, if narrow { 44.0 } else { 64.0 });
    let slider = ui.add(Slider::new(&mut blend, 0.0..=1.0).show_value(false));
    ui.ctx().accesskit_node_builder(slider.id, |node| {
        node.set_label(say!("From before to after"));
    });
    if slider.changed() {
        commands.push(Command::View(ViewChange::Blend(blend)));
    }
    slider.on_hover_text(blend_says(blend));
    if !bare {
        end(ui, say!("before"), blend <= 0.0);
    }
}

/// What the vectors, the marks and the heat map show.
fn blend_says(blend: f32) -> String {
    if blend <= 0.0 {
        say!("shown: the deviation before, measured − nominal robot").to_owned()
    } else if blend >= 1.0 {
        say!("shown: what is left after, measured − identified robot").to_owned()
    } else {
        let percent = trimmed(100.0 * f64::from(blend), 0);
        say!(
            "shown: {percent} % of the way from before to after",
            percent = percent
        )
    }
}

/// How long the vectors are drawn and for whose lengths, where there is little room.
fn length_folded(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let now = significant(magnification_of(workbench), 2);
    let name = say!("vectors × {now}", now = now);
    folded(ui, &name, say!("Length of vectors"), |ui| {
        widgets::row(ui, |ui| magnification(ui, workbench, commands));
        widgets::row(ui, |ui| scale_for(ui, workbench, commands));
    });
}

/// How long the vectors are drawn.
fn magnification(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let now = magnification_of(workbench);
    caption(ui, say!("vectors"));
    let mut factor = now;
    fine(ui, 60.0);
    let slider = Slider::new(&mut factor, 1.0..=100_000.0)
        .logarithmic(true)
        .show_value(false);
    let slider = ui.add(slider);
    ui.ctx().accesskit_node_builder(slider.id, |node| {
        node.set_label(say!("Length of vectors"));
    });
    if slider.changed() && factor != now {
        commands.push(Command::View(ViewChange::Magnify(Some(factor))));
    }
    caption(ui, &format!("× {}", significant(now, 2)));
}

/// Whose lengths vectors and colours are made for.
fn scale_for(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(after) = workbench.after() else {
        return;
    };
    let loaded_session = workbench.loaded_session();
    let room = workbench.view().plot_size;
    let [before, left] =
        [loaded_session.overview.readable, after.readable].map(|r| r.magnification(room));
    let now = magnification_of(workbench);
    let says = say!(
        "how long vectors are drawn and where the colours of lengths end: so that the deviations before can be read, or those that are left after"
    );
    caption(ui, say!("scale for")).on_hover_text(says);
    let options = [(Some(before), say!("before")), (Some(left), say!("after"))];
    match widgets::segmented(ui, &options, Some(now)) {
        Some(Some(factor)) if factor == readable(workbench) => {
            commands.push(Command::View(ViewChange::Magnify(None)));
        }
        Some(factor) => commands.push(Command::View(ViewChange::Magnify(factor))),
        None => {}
    }
}

/// What only one way of looking has: the heat map of a plane; the side and the pose in space.
fn beneath(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = workbench.view();
    if !view.in_space() {
        heat(ui, workbench, commands);
        return;
    }
    caption(ui, say!(in "toolbar", "from"));
    let shown = view.camera.standard();
    let text = RichText::new(shown.map_or(say!("free"), Standard::name)).size(size::SMALL);
    let list = ComboBox::from_id_salt("view in space").selected_text(text);
    let list = list.width(76.0).show_ui(ui, |ui| {
        for from in Standard::ALL {
            if ui
                .selectable_label(shown == Some(from), from.name())
                .clicked()
            {
                commands.push(Command::View(ViewChange::LookFrom(Some(from))));
            }
        }
    });
    ui.ctx().accesskit_node_builder(list.response.id, |node| {
        node.set_label(say!("Standard view"));
    });
    let mut open = posing(ui);
    let text = RichText::new(say!("pose")).size(size::SMALL);
    let checkbox = ui
        .checkbox(&mut open, text)
        .on_hover_text(say!("sliders that pose the robot"));
    ui.ctx().accesskit_node_builder(checkbox.id, |node| {
        node.set_label(say!("Pose the robot"));
    });
    if checkbox.changed() {
        ui.data_mut(|data| data.insert_temp(posing_id(), open));
    }
}

fn posing_id() -> egui::Id {
    egui::Id::unique("sliders that pose the robot")
}

/// Whether the sliders that pose the robot are open.
pub(super) fn posing(ui: &Ui) -> bool {
    ui.data(|data| data.get_temp(posing_id()))
        .unwrap_or_default()
}

/// Whether the error between the samples is shown.
fn heat(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut shown = workbench.view().heat;
    let text = RichText::new(say!("heat map")).size(size::SMALL);
    let says = say!("the root mean square deviation between the samples, fading away from them");
    let checkbox = ui.checkbox(&mut shown, text).on_hover_text(says);
    ui.ctx()
        .accesskit_node_builder(checkbox.id, |node| node.set_label(say!("heat map")));
    if checkbox.changed() {
        commands.push(Command::View(ViewChange::Heat(shown)));
    }
}

/// What the colour of the vectors says.
fn colouring(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let shown = coloured(workbench);
    if ui.available_width() > COLOUR {
        caption(ui, say!("colour"));
    }
    let text = RichText::new(shown.name()).size(size::SMALL);
    let list = ComboBox::from_id_salt("colouring").selected_text(text);
    let list = list.width(112.0).truncate().height(280.0);
    let list = list.show_ui(ui, |ui| {
        for colouring in Colouring::ALL {
            if !offers(workbench, colouring) {
                continue;
            }
            let chosen = colouring == shown;
            if ui.selectable_label(chosen, colouring.name()).clicked() && !chosen {
                commands.push(Command::View(ViewChange::Colour(colouring)));
            }
        }
    });
    ui.ctx().accesskit_node_builder(list.response.id, |node| {
        node.set_label(say!("Colour of vectors"));
    });
}

/// What colour says, where the session has it.
fn coloured(workbench: &Workbench) -> Colouring {
    let now = workbench.view().colouring;
    if offers(workbench, now) {
        now
    } else {
        Colouring::State
    }
}
