//! What the words mean, all of them.

use egui::{RichText, ScrollArea, Ui};

use crate::gui::charts::CHARTS;
use crate::gui::style::tokens::{size, space, strong};
use crate::gui::workbench::{Command, Workbench};
use crate::gui::{help, widgets};

/// Height of what stands around the list, points.
const REST: f32 = 240.0;

pub(super) fn show(ui: &mut Ui, _: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
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
            ui.label(RichText::new(word.name()).font(strong(size::BODY)));
            ui.add(egui::Label::new(word.means()).wrap());
            ui.add_space(space::ROW);
        }
    });
    super::ends::done(ui, commands);
}
