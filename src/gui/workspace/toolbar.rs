//! The bar over the workspace plot: from where it is looked at, what is shown, and how: from before to after, how long
//! vectors are, the heat map, what colour says; the side in space.

use egui::{Align, ComboBox, Layout, Popup, PopupCloseBehavior, RichText, Slider, Ui, vec2};

use crate::gui::plots::{self, picture};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Aspect, Colouring, Plane, Plot};
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
    let drawn = !workbench.loaded_session().is_empty();
    let blends = drawn && workbench.answer().is_some();
    let roomy = ui.available_width() / stretch() - FIRST > ROOMY;
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
        ways(ui, workbench);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if drawn {
                picture(ui, Plot::Workspace, None, workbench);
            }
            if plots::fit(ui, say!("Fit to view")) {
                workbench.then(|bench| bench.view.fit_workspace());
            }
            if drawn {
                display(ui, workbench);
            }
            if blends && roomy && extra.is_none() {
                ui.add_space(space::TIGHT);
                blend(ui, workbench);
            }
        });
    });
    if below {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                blend(ui, workbench);
            });
        });
    }
}

/// The ways to look at the workspace.
fn ways(ui: &mut Ui, workbench: &Workbench) {
    let view = &workbench.view;
    let planes = Plane::ALL.map(|plane| ((Aspect::Plane, plane), plane.name()));
    let space = ((Aspect::Space, view.plane), say!("3-D"));
    let views = [planes[0], planes[1], planes[2], space];
    let now = (view.aspect, view.plane);
    let room = ui.available_width() - BESIDE * stretch();
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

/// Width of what stands in the same row as the choice of view, points: two icons, and the *display* button. The choice
/// becomes a list where the row is too narrow for all of them.
const BESIDE: f32 = 154.0;
const NARROW_LIST: f32 = 64.0;
/// From these widths on the plot is titled: without before and after in the row, and with them, points.
const TITLED: f32 = 440.0;
const WITH_BLEND: f32 = 590.0;
/// From this width on before and after is in the row, points.
const ROOMY: f32 = 570.0;

/// How vectors, map and colours are drawn.
fn display(ui: &mut Ui, workbench: &Workbench) {
    let text = RichText::new(say!("display").to_owned() + " …").size(size::SMALL);
    let button = ui.button(text);
    widgets::label(&button, say!("How it is drawn"));
    let menu = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    menu.show(|ui| {
        ui.spacing_mut().item_spacing = vec2(space::ROW, space::ROW);
        widgets::row(ui, |ui| magnification(ui, workbench));
        widgets::row(ui, |ui| scale_for(ui, workbench));
        if !workbench.view.in_space() {
            heat(ui, workbench);
        }
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
    });
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

/// What colour says, where the session has it.
fn coloured(workbench: &Workbench) -> Colouring {
    let now = workbench.view.colouring;
    if offers(workbench, now) {
        now
    } else {
        Colouring::State
    }
}
