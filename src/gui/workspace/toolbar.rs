//! The bar over the workspace plot: from where it is looked at, what is shown, and how: from before to after, how long
//! vectors are, the heat map, what colour says; the side in space.

use egui::{Align, ComboBox, Layout, Popup, PopupCloseBehavior, RichText, Slider, Ui, vec2};

use crate::gui::plots::{self, picture};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Aspect, Colouring, Plane, Plot, Standard};
use crate::gui::widgets::{self, caption, fine, title};
use crate::gui::workbench::Workbench;
use crate::present::numbers::{significant, trimmed};
use crate::text::stretch;

use super::model::{magnification as magnification_of, offers, readable, room};

/// What stands at the beginning of the bar.
pub(crate) type First<'a> = &'a mut dyn FnMut(&mut Ui);

/// Room for it, points.
const FIRST: f32 = 32.0;

/// Something else that stands in the bar.
pub(crate) type ExtraControls = fn(&mut Ui, &Workbench);

/// Shows the bar; `extra` stands above it, `first` at its beginning.
pub(crate) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    extra: Option<ExtraControls>,
    first: First<'_>,
) {
    let view = &workbench.view;
    let drawn = !workbench.loaded_session().is_empty();
    let blends = drawn && workbench.answer().is_some();
    let mut room = ui.available_size();
    room.x /= stretch();
    let least = match (view.in_space(), blends) {
        (true, _) => SPACE,
        (false, true) => ANSWERED,
        (false, false) => PLANE,
    };
    let tight = room.y < TIGHT || room.x - FIRST < least;
    let roomy = room.x - FIRST > if tight { ROOMY_FOLDED } else { ROOMY };
    // Beside what stands above the bar, in the bar, or below it.
    let below = blends && extra.is_none() && !roomy;
    if let Some(extra) = extra {
        widgets::row(ui, |ui| {
            extra(ui, workbench);
            if blends {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    blend(ui, workbench);
                });
            }
        });
    }
    let titled = match blends {
        _ if extra.is_some() => f32::INFINITY,
        true => WITH_BLEND,
        false => TITLED,
    };
    widgets::row(ui, |ui| {
        first(ui);
        if ui.available_width() > titled * stretch() {
            title(ui, say!("Workspace"));
        }
        ways(ui, workbench, tight);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if drawn {
                picture(ui, Plot::Workspace, None, workbench);
            }
            if plots::fit(ui, say!("Fit to view")) {
                workbench.then(|bench| bench.view.fit_workspace());
            }
            if drawn && tight {
                folded(ui, say!("display"), say!("How it is drawn"), |ui| {
                    everything(ui, workbench);
                });
            }
            if blends && roomy && extra.is_none() {
                ui.add_space(space::TIGHT);
                blend(ui, workbench);
            }
        });
    });
    if drawn && !tight {
        ui.horizontal_wrapped(|ui| {
            magnification(ui, workbench);
            scale_for(ui, workbench);
            beneath(ui, workbench);
            colouring(ui, workbench);
        });
    }
    if below {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                blend(ui, workbench);
            });
        });
    }
}

/// The ways to look at the workspace.
fn ways(ui: &mut Ui, workbench: &Workbench, tight: bool) {
    let view = &workbench.view;
    let planes = Plane::ALL.map(|plane| ((Aspect::Plane, plane), plane.name()));
    let space = ((Aspect::Space, view.plane), say!("3-D"));
    let views = [planes[0], planes[1], planes[2], space];
    let now = (view.aspect, view.plane);
    let beside = if tight { ICONS + DISPLAY } else { ICONS };
    let room = ui.available_width() - beside * stretch();
    let chosen = if widgets::width_of_segments(ui, &views) <= room {
        widgets::segmented(ui, &views, now)
    } else {
        let named = views.iter().find(|(one, _)| *one == now);
        let view = named.map_or("", |(_, name)| *name);
        let list = ComboBox::from_id_salt("ways to look").width(NARROW_LIST);
        let list = list.selected_text(view);
        widgets::list(ui, say!("{view} view", view), list, views, now)
    };
    match chosen {
        Some((Aspect::Plane, plane)) => workbench.then(move |bench| bench.view.look_in(plane)),
        Some((Aspect::Space, _)) => workbench.then(move |bench| bench.view.look_from(None)),
        None => {}
    }
}

/// Widths in the same row as the choice of view, points: two icons, and the *display* button. The choice becomes a list
/// where the row is too narrow for all of them.
const ICONS: f32 = 76.0;

const DISPLAY: f32 = 78.0;

const NARROW_LIST: f32 = 64.0;

/// With less room the plot has no title, and before and after stand in a row of their own, points.
const TITLED: f32 = 440.0;

const WITH_BLEND: f32 = 590.0;

const ROOMY: f32 = 420.0;

/// The same with a button for how anything is drawn.
const ROOMY_FOLDED: f32 = 570.0;

/// With less room how anything is drawn stands behind a button: in space, in a plane, and where there is an answer,
/// points.
const SPACE: f32 = 500.0;

const PLANE: f32 = 350.0;

const ANSWERED: f32 = 560.0;

/// With less height it does as well, points.
const TIGHT: f32 = 270.0;

/// With less room the list of colours goes without its name, points.
const COLOUR: f32 = 172.0;

/// A button that opens what there is no room for; `name` is what it is called.
fn folded(ui: &mut Ui, text: &str, name: &str, contents: impl FnOnce(&mut Ui)) {
    let text = RichText::new(format!("{text} \u{2026}")).size(size::SMALL);
    let button = ui.button(text);
    widgets::label(&button, name);
    Popup::menu(&button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            ui.spacing_mut().item_spacing = vec2(space::ROW, space::ROW);
            contents(ui);
        });
}

/// How vectors, map and colours are drawn, one below the other.
fn everything(ui: &mut Ui, workbench: &Workbench) {
    widgets::row(ui, |ui| magnification(ui, workbench));
    widgets::row(ui, |ui| scale_for(ui, workbench));
    beneath(ui, workbench);
    caption(ui, say!("colour"));
    let shown = coloured(workbench);
    for colouring in Colouring::ALL {
        if offers(workbench, colouring) {
            let text = RichText::new(colouring.name()).size(size::SMALL);
            if ui.radio(colouring == shown, text).clicked() && colouring != shown {
                workbench.then(move |bench| bench.view.colouring = colouring);
            }
        }
    }
}

/// A list of the bar's size, with what is chosen in it.
fn listed<'a>(salt: &str, shown: &str) -> ComboBox<'a> {
    ComboBox::from_id_salt(salt).selected_text(RichText::new(shown).size(size::SMALL))
}

/// From before to after. What stands at the end that is shown is written stronger.
fn blend(ui: &mut Ui, workbench: &Workbench) {
    let mut blend = workbench.view.blend;
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
    widgets::label(&slider, say!("From before to after"));
    if slider.changed() {
        workbench.then(move |bench| bench.view.blend = blend);
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
            percent
        )
    }
}

/// How long the vectors are drawn.
fn magnification(ui: &mut Ui, workbench: &Workbench) {
    let now = magnification_of(workbench);
    caption(ui, say!("vectors"));
    let mut factor = now;
    fine(ui, 60.0);
    let slider = Slider::new(&mut factor, 1.0..=100_000.0)
        .logarithmic(true)
        .show_value(false);
    let slider = ui.add(slider);
    widgets::label(&slider, say!("Length of vectors"));
    if slider.changed() && factor != now {
        workbench.then(move |bench| bench.view.magnification = Some(factor));
    }
    caption(ui, &format!("× {}", significant(now, 2)));
}

/// Whose lengths vectors and colours are made for.
fn scale_for(ui: &mut Ui, workbench: &Workbench) {
    let Some(after) = workbench.after() else {
        return;
    };
    let loaded_session = workbench.loaded_session();
    let room = room(workbench);
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
            workbench.then(move |bench| bench.view.magnification = None);
        }
        Some(factor) => workbench.then(move |bench| bench.view.magnification = factor),
        None => {}
    }
}

/// What only one way of looking has: the heat map of a plane; the side and the pose in space.
fn beneath(ui: &mut Ui, workbench: &Workbench) {
    let view = &workbench.view;
    if !view.in_space() {
        heat(ui, workbench);
        return;
    }
    caption(ui, say!(in "toolbar", "from"));
    let shown = view.camera.standard();
    let list = listed("view in space", shown.map_or(say!("free"), Standard::name)).width(76.0);
    let offered = Standard::ALL.into_iter();
    let offered = offered.map(|from| (Some(from), from.name()));
    if let Some(from) = widgets::list(ui, say!("Standard view"), list, offered, shown) {
        workbench.then(move |bench| bench.view.look_from(from));
    }
}

/// Whether the error between the samples is shown.
fn heat(ui: &mut Ui, workbench: &Workbench) {
    let mut shown = workbench.view.heat;
    let text = RichText::new(say!("heat map")).size(size::SMALL);
    let says = say!("the root mean square deviation between the samples, fading away from them");
    let checkbox = ui.checkbox(&mut shown, text).on_hover_text(says);
    widgets::label(&checkbox, say!("heat map"));
    if checkbox.changed() {
        workbench.then(move |bench| bench.view.heat = shown);
    }
}

/// What the colour of the vectors says.
fn colouring(ui: &mut Ui, workbench: &Workbench) {
    let shown = coloured(workbench);
    if ui.available_width() > COLOUR {
        caption(ui, say!("colour"));
    }
    let list = listed("colouring", shown.name());
    let list = list.width(112.0).truncate().height(280.0);
    let offered = Colouring::ALL.into_iter();
    let offered = offered.filter(|colouring| offers(workbench, *colouring));
    let offered = offered.map(|colouring| (colouring, colouring.name()));
    let chosen = widgets::list(ui, say!("Colour of vectors"), list, offered, shown);
    if let Some(colouring) = chosen.filter(|colouring| *colouring != shown) {
        workbench.then(move |bench| bench.view.colouring = colouring);
    }
}

/// What colour says, where the session has it.
fn coloured(workbench: &Workbench) -> Colouring {
    let now = workbench.view.colouring;
    if offers(workbench, now) {
        now
    } else {
        Colouring::State
    }
}
