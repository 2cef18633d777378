//! What this program is, what can be done in it by keys and mouse, and what the words mean.

use egui::{ScrollArea, Ui};


use crate::gui::charts::CHARTS;
use crate::gui::style::space;
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};

pub(super) fn about(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, 400.0);
    widgets::heading(ui, "truepose");
    widgets::hint(
        ui,
        say!("version {version}", version = env!("CARGO_PKG_VERSION")),
    );
    ui.label(say!("Calibrates a robot at commissioning: finds where measurement and simulation disagree, and writes what the controller needs"));
    widgets::hint(
        ui,
        say!("Everything in this window can be done in the terminal too: truepose --help"),
    );
    widgets::hint(
        ui,
        say!("Type: Inter, by the Inter project authors, SIL Open Font License 1.1"),
    );
    widgets::done(ui, workbench);
}

/// Height of what stands around the list, points.
const REST: f32 = 240.0;

/// What the words mean, all of them.
pub(super) fn words(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, 520.0);
    widgets::heading(ui, say!("Glossary"));
    widgets::hint(
        ui,
        say!("The same is shown beside the numbers, where the pointer rests on a name"),
    );
    ui.add_space(space::TIGHT);
    let high = (ui.ctx().content_rect().height() - REST).clamp(120.0, 460.0);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        let charts = CHARTS.iter().map(|chart| chart.about().word);
        let charts = charts.filter(|word| !help::ALL.contains(word));
        for word in help::ALL.iter().copied().chain(charts) {
            widgets::bold(ui, word.name());
            ui.add(egui::Label::new(word.means()).wrap());
            ui.add_space(space::ROW);
        }
    });
    widgets::done(ui, workbench);
}
