//! An open file that is not what it was: said above the plots until somebody decides.

use egui::{Align, Frame, Label, Layout, Margin, RichText, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::keeping::disk::Fate;
use crate::gui::tokens::{Palette, size, strong};

/// Shows the notice, if there is one.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(on_disk) = &workbench.view().on_disk else {
        return;
    };
    let palette = Palette::of(ui);
    let name = on_disk.path.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let (title, says) = match on_disk.fate {
        Fate::Changed => (
            format!("{name} was changed by another program"),
            "Reload reads it again; undo brings back what is here now. Whoever keeps this is asked before saving replaces the file",
        ),
        Fate::Vanished => (
            format!("{name} is not there any more"),
            "What was read is here still: save it, or put the file back",
        ),
    };
    let frame = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
    frame.show(ui, |ui| {
        ui.horizontal_top(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
                if ui.button("Keep this").clicked() {
                    commands.push(Command::KeepMine);
                }
                match on_disk.fate {
                    Fate::Changed if ui.button("Reload").clicked() => {
                        commands.push(Command::Reload);
                    }
                    Fate::Vanished if ui.button("Save it again…").clicked() => {
                        commands.push(Command::ChooseWhereToSave);
                    }
                    _ => {}
                }
                ui.with_layout(Layout::top_down(Align::Min), |ui| {
                    ui.spacing_mut().item_spacing.y = 3.0;
                    let title = RichText::new(title).font(strong(size::BODY));
                    ui.add(Label::new(title.color(palette.warning)).wrap());
                    ui.add(Label::new(RichText::new(says).size(size::NOTE)).wrap());
                });
            });
        });
    });
}
