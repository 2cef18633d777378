//! How the workspace is drawn, as the bar over it has it: from before to after, how long vectors are, the heat map,
//! what colour says; the side and the pose in space.

use crate::text::stretch;
use egui::{ComboBox, Popup, PopupCloseBehavior, RichText, Slider, Ui, vec2};

use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Colouring, Standard};
use crate::gui::widgets::{self, caption, fine};
use crate::gui::workbench::Workbench;
use crate::present::numbers::{significant, trimmed};

use super::model::{magnification as magnification_of, offers, readable};
use super::sparse::room;

/// With less room the list of colours goes without its name, points.
const COLOUR: f32 = 172.0;

/// A button that opens what there is no room for; `name` is what it is called.
pub(super) fn folded(ui: &mut Ui, text: &str, name: &str, contents: impl FnOnce(&mut Ui)) {
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
pub(super) fn everything(ui: &mut Ui, workbench: &Workbench) {
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
pub(super) fn blend(ui: &mut Ui, workbench: &Workbench) {
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

/// How long the vectors are drawn and for whose lengths, where there is little room.
pub(super) fn length_folded(ui: &mut Ui, workbench: &Workbench) {
    let now = significant(magnification_of(workbench), 2);
    let name = say!("vectors × {now}", now);
    folded(ui, &name, say!("Length of vectors"), |ui| {
        widgets::row(ui, |ui| magnification(ui, workbench));
        widgets::row(ui, |ui| scale_for(ui, workbench));
    });
}

/// How long the vectors are drawn.
pub(super) fn magnification(ui: &mut Ui, workbench: &Workbench) {
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
pub(super) fn scale_for(ui: &mut Ui, workbench: &Workbench) {
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
pub(super) fn beneath(ui: &mut Ui, workbench: &Workbench) {
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
    let mut open = posing(ui);
    let text = RichText::new(say!("pose")).size(size::SMALL);
    let checkbox = ui
        .checkbox(&mut open, text)
        .on_hover_text(say!("sliders that pose the robot"));
    widgets::label(&checkbox, say!("Pose the robot"));
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
pub(super) fn colouring(ui: &mut Ui, workbench: &Workbench) {
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
