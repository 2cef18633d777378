//! Units, digits, colours, size of text: seen at once, kept for tomorrow.

use crate::text::LANGUAGES;
use egui::{Slider, Ui};

use crate::gui::view::{Preferences, Theme, ZOOM, largest_zoom};
use crate::gui::widgets::{self, Buttons, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::present::units::{AngleUnit, LengthUnit};

pub(super) fn preferences(ui: &mut Ui, workbench: &Workbench) {
    widgets::head(ui, 440.0, say!("Preferences"));
    let now = workbench.view.preferences;
    let mut next = now;
    // Each in its own name.
    let mut languages = vec![(None, say!("System"))];
    languages.extend(LANGUAGES.iter().map(|(one, _, own)| (Some(*one), *own)));
    ui.choice_row(say!("Language"), &languages, &mut next.language);
    let lengths = [
        (LengthUnit::Millimetre, "mm"),
        (LengthUnit::Micrometre, "µm"),
        (LengthUnit::Inch, say!("inch")),
    ];
    ui.choice_row(say!("Lengths in"), &lengths, &mut next.length);
    let angles = [
        (AngleUnit::Degree, say!("degrees")),
        (AngleUnit::Radian, "rad"),
        (AngleUnit::Milliradian, "mrad"),
        (AngleUnit::ArcSecond, "arcsec"),
    ];
    ui.choice_row(say!("Angles in"), &angles, &mut next.angle);
    let decimals = [
        (None, say!("readable")),
        (Some(1), "1"),
        (Some(2), "2"),
        (Some(3), "3"),
        (Some(4), "4"),
        (Some(5), "5"),
    ];
    ui.choice_row(say!("Decimals of lengths"), &decimals, &mut next.decimals);
    let signs = [
        (None, say!("of the language")),
        (Some(false), "1.5"),
        (Some(true), "1,5"),
    ];
    ui.choice_row(say!("Decimal sign"), &signs, &mut next.comma);
    let themes = [
        (Theme::System, say!("System")),
        (Theme::Light, say!("light")),
        (Theme::Dark, say!("dark")),
    ];
    ui.choice_row(say!("Colours"), &themes, &mut next.theme);
    ui.form_row(say!("Size of text"), |ui| {
        let mut percent = (100.0 * now.zoom).round();
        let range = 100.0 * ZOOM.start()..=100.0 * ZOOM.end();
        let slider = Slider::new(&mut percent, range).step_by(10.0).suffix(" %");
        let slider = ui.named(say!("Size of text"), slider.update_while_editing(false));
        // While it is dragged the slider would run away from under the pointer.
        let id = ui.scope_id().with("size of text");
        if slider.dragged() {
            ui.data_mut(|data| data.insert_temp(id, percent));
        } else {
            let dragged = ui.data_mut(|data| data.remove_temp::<f32>(id));
            let chosen = dragged.or(slider.changed().then_some(percent));
            next.zoom = chosen.map_or(next.zoom, |percent| percent / 100.0);
        }
    });
    let largest = largest_zoom(ui.ctx());
    if now.zoom > largest + 1e-3 {
        let percent = (100.0 * largest).floor();
        ui.hint(say!(
            "This window has room for text of {percent} %",
            percent
        ));
    }
    let changed = now != Preferences::default();
    match ui.foot([(say!("Reset all"), changed), (say!("Done"), true)]) {
        Some(0) => next = Preferences::default(),
        pressed if pressed.is_some() || widgets::entered(ui) => {
            workbench.then(|bench| bench.show_sheet(None));
        }
        _ => {}
    }
    if next != now {
        workbench.then(move |bench| bench.prefer(next));
    }
}
