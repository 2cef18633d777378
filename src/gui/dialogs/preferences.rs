//! Units, digits, colours, size of text: seen at once, kept for tomorrow.

use crate::text::LANGUAGES;
use egui::{Slider, Ui};

use crate::gui::view::{Preferences, Theme, ZOOM, largest_zoom};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::present::units::{AngleUnit, LengthUnit};

/// The languages, each in its own name.
fn language(ui: &mut Ui, next: &mut Preferences) {
    let languages = LANGUAGES.iter().map(|(one, _, own)| (Some(*one), *own));
    let languages: Vec<_> = std::iter::once((None, say!("System")))
        .chain(languages)
        .collect();
    widgets::choice_row(ui, say!("Language"), &languages, &mut next.language);
}

pub(super) fn preferences(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, 440.0);
    widgets::heading(ui, say!("Preferences"));
    let now = workbench.view.preferences;
    let mut next = now;
    language(ui, &mut next);
    let lengths = [
        (LengthUnit::Millimetre, "mm"),
        (LengthUnit::Micrometre, "µm"),
        (LengthUnit::Inch, say!("inch")),
    ];
    widgets::choice_row(ui, say!("Lengths in"), &lengths, &mut next.length);
    let angles = [
        (AngleUnit::Degree, say!("degrees")),
        (AngleUnit::Radian, "rad"),
        (AngleUnit::Milliradian, "mrad"),
        (AngleUnit::ArcSecond, "arcsec"),
    ];
    widgets::choice_row(ui, say!("Angles in"), &angles, &mut next.angle);
    let decimals = [
        (None, say!("readable")),
        (Some(1), "1"),
        (Some(2), "2"),
        (Some(3), "3"),
        (Some(4), "4"),
        (Some(5), "5"),
    ];
    widgets::choice_row(
        ui,
        say!("Decimals of lengths"),
        &decimals,
        &mut next.decimals,
    );
    let signs = [
        (None, say!("of the language")),
        (Some(false), "1.5"),
        (Some(true), "1,5"),
    ];
    widgets::choice_row(ui, say!("Decimal sign"), &signs, &mut next.comma);
    let themes = [
        (Theme::System, say!("System")),
        (Theme::Light, say!("light")),
        (Theme::Dark, say!("dark")),
    ];
    widgets::choice_row(ui, say!("Colours"), &themes, &mut next.theme);
    widgets::form_row(ui, say!("Size of text"), |ui| {
        let mut percent = (100.0 * now.zoom).round();
        let range = 100.0 * ZOOM.start()..=100.0 * ZOOM.end();
        let slider = Slider::new(&mut percent, range).step_by(10.0).suffix(" %");
        let slider = ui.add(slider.update_while_editing(false));
        widgets::label(&slider, say!("Size of text"));
        // While it is dragged the slider would run away from under the pointer.
        let id = ui.scope_id().with("size of text");
        if slider.dragged() {
            ui.data_mut(|data| data.insert_temp(id, percent));
        } else if let Some(percent) = ui.data_mut(|data| data.remove_temp::<f32>(id)) {
            next.zoom = percent / 100.0;
        } else if slider.changed() {
            next.zoom = percent / 100.0;
        }
    });
    let largest = largest_zoom(ui.ctx());
    if now.zoom > largest + 1e-3 {
        let percent = (100.0 * largest).floor();
        widgets::hint(
            ui,
            say!("This window has room for text of {percent} %", percent),
        );
    }
    widgets::hint(
        ui,
        say!("Files are read and written in their own units, whatever is shown here"),
    );
    let changed = now != Preferences::default();
    if widgets::done_beside(ui, say!("Reset all"), changed, workbench) {
        next = Preferences::default();
    }
    if next != now {
        workbench.then(move |bench| bench.prefer(next));
    }
}
