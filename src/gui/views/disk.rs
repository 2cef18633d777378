//! An open file that is not what it was: said above the plots until the user decides.

use std::path::Path;

use egui::{Align, Frame, Label, Layout, Margin, RichText, Ui};

use crate::gui::core::disk::FileChange;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::workbench::{Command, Workbench};

/// Shows the notice, if there is one.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(on_disk) = &workbench.view().on_disk else {
        return;
    };
    let palette = Palette::of(ui);
    let name = on_disk.path.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let (title, says) = match on_disk.fate {
        FileChange::Changed => (
            say!("{name} was changed by another program", name = name),
            say!(
                "Reload reads it again; undo brings back what is here now. If you keep this version, you will be asked before overwriting"
            ),
        ),
        FileChange::Vanished => (
            say!("{name}: file not found", name = name),
            say!("What was read is here still: saving writes it again, or put the file back"),
        ),
    };
    let frame = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
    frame.show(ui, |ui| {
        ui.horizontal_top(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
                if ui.button(say!("Keep this version")).clicked() {
                    commands.push(Command::KeepMine);
                }
                match on_disk.fate {
                    FileChange::Changed if ui.button(say!("Reload")).clicked() => {
                        commands.push(Command::Reload);
                    }
                    FileChange::Vanished => save_again(ui, workbench, &on_disk.path, commands),
                    FileChange::Changed => {}
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

/// Offers to write what is gone. Where it is the samples the document still says where they belong;
/// where it is the document the user has to.
fn save_again(ui: &mut Ui, workbench: &Workbench, gone: &Path, commands: &mut Vec<Command>) {
    let (says, command) = if workbench.samples_file() == Some(gone) {
        (say!("Save it again"), Command::Save)
    } else {
        (say!("Save it again…"), Command::ChooseWhereToSave)
    };
    if ui.button(says).clicked() {
        commands.push(command);
    }
}
