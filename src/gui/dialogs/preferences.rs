//! Units, digits, colours, size of text: seen at once, kept for tomorrow.

use crate::text::LANGUAGES;
use egui::Ui;

use crate::gui::view::{Theme, largest_zoom};
use crate::gui::widgets::{self, Forms, Words};
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
    let sizes = [
        (0.8, "80 %"),
        (1.0, "100 %"),
        (1.25, "125 %"),
        (1.5, "150 %"),
        (2.0, "200 %"),
    ];
    ui.choice_row(say!("Size of text"), &sizes, &mut next.zoom);
    let largest = largest_zoom(ui.ctx());
    if now.zoom > largest + 1e-3 {
        let percent = (100.0 * largest).floor();
        ui.hint(say!(
            "This window has room for text of {percent} %",
            percent
        ));
    }
    if next != now {
        workbench.then(move |bench| bench.prefer(next));
    }
}
