//! An open file that is not what it was: said until the user decides.

use std::path::Path;

use egui::{Label, RichText, Ui};

use crate::gui::core::disk::FileChange;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::workbench::{Asked, Command, ViewChange, Workbench};

/// Shows the notice, if there is one.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(on_disk) = &workbench.view().on_disk else {
        return;
    };
    let palette = Palette::of(ui);
    let name = on_disk.path.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let (title, says) = match on_disk.change {
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
    let title = RichText::new(title).font(strong(size::BODY));
    ui.add(Label::new(title.color(palette.warning)).wrap());
    ui.add(Label::new(RichText::new(says).size(size::NOTE)).wrap());
    ui.horizontal_wrapped(|ui| {
        match on_disk.change {
            FileChange::Changed if ui.button(say!("Reload")).clicked() => {
                commands.push(Command::Reload);
            }
            FileChange::Vanished => save_again(ui, workbench, &on_disk.path, commands),
            FileChange::Changed => {}
        }
        if ui.button(say!("Keep this version")).clicked() {
            commands.push(Command::View(ViewChange::KeepMine));
        }
    });
}

/// Offers to write what is gone. Where it is the samples the document still says where they belong;
/// where it is the document the user has to.
fn save_again(ui: &mut Ui, workbench: &Workbench, gone: &Path, commands: &mut Vec<Command>) {
    let (says, command) = if workbench.samples_file() == Some(gone) {
        (say!("Save it again"), Command::Save)
    } else {
        (say!("Save it again…"), Command::Ask(Asked::WhereToSave))
    };
    if ui.button(says).clicked() {
        commands.push(command);
    }
}
