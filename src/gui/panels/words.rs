//! What the words mean, all of them.

use egui::{RichText, ScrollArea, Ui};

use crate::gui::help;
use crate::gui::tokens::{size, space, strong};
use crate::gui::widgets;

/// Shows the sheet.
pub(super) fn show(ui: &mut Ui) {
    ui.set_width(520.0);
    widgets::heading(ui, "What the words mean");
    widgets::hint(
        ui,
        "The same stands beside the numbers, where the pointer rests on a name",
    );
    ui.add_space(space::TIGHT);
    ScrollArea::vertical().max_height(460.0).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        for word in help::ALL {
            ui.label(RichText::new(word.name).font(strong(size::BODY)));
            ui.add(egui::Label::new(word.means).wrap());
            ui.add_space(space::ROW);
        }
    });
}
