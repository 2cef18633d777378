//! A path that is typed.

use std::path::PathBuf;

use egui::{Key, TextEdit, Ui};

use crate::export::find;
use crate::gui::view::{Sheet, What};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};

use super::ends::buttons;

/// What was done with a path that is being typed.
enum PathInput {
    /// It is complete.
    Done {
        path: PathBuf,
        replace: bool,
    },
    /// It is another now.
    Changed {
        path: String,
        replace: bool,
    },
    Same,
}

/// A file to save the session to.
pub(super) fn save(
    ui: &mut Ui,
    workbench: &Workbench,
    typed: (&str, bool),
    commands: &mut Vec<Command>,
) {
    let says = say!("The samples are written beside it, as a CSV file of the same name");
    match path_form(ui, workbench, (say!("Save session"), says), typed, commands) {
        PathInput::Done { path, replace } => commands.push(Command::SaveAs { path, replace }),
        PathInput::Changed { path, replace } => {
            commands.push(Command::View(ViewChange::Sheet(Some(Sheet::SavePath {
                path,
                replace,
            }))));
        }
        PathInput::Same => {}
    }
}

fn path_form(
    ui: &mut Ui,
    workbench: &Workbench,
    (title, says): (&str, &str),
    (path, replace): (&str, bool),
    commands: &mut Vec<Command>,
) -> PathInput {
    ui.set_width(420.0);
    widgets::heading(ui, title);
    let (mut typed, mut allowed) = (path.to_owned(), replace);
    let field = ui.add(TextEdit::singleline(&mut typed).desired_width(f32::INFINITY));
    widgets::label(&field, say!("Path to save to"));
    // The field is what the sheet is for: what is typed goes into it from the first letter on.
    if ui.memory(|memory| memory.focused().is_none()) && !field.lost_focus() {
        field.request_focus();
        widgets::select_all(ui, field.id, path);
    }
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let place = workbench.placed(typed.trim().as_ref());
    if let (Some(folder), Some(name)) = (place.parent(), place.file_name()) {
        let (folder, name) = (folder.display(), name.to_string_lossy());
        widgets::hint(
            ui,
            say!(
                "{name}, in the folder {folder}",
                name = name,
                folder = folder
            ),
        );
    }
    ui.checkbox(&mut allowed, say!("replace the file if it exists"));
    widgets::hint(ui, says);
    let named = !typed.trim().is_empty();
    let pressed = buttons(ui, say!("Save"), named, commands);
    if named && (pressed || entered) {
        PathInput::Done {
            path: typed.trim().into(),
            replace: allowed,
        }
    } else if typed != path || allowed != replace {
        PathInput::Changed {
            path: typed,
            replace: allowed,
        }
    } else {
        PathInput::Same
    }
}

/// Whether what is exported describes the robot and is no table.
fn is_robot(workbench: &Workbench) -> bool {
    let format = find(workbench.document().export.format);
    format.is_some_and(|format| format.rules.is_none())
}

/// A file to export to.
pub(super) fn export(
    ui: &mut Ui,
    workbench: &Workbench,
    what: What,
    typed: (&str, bool),
    commands: &mut Vec<Command>,
) {
    let (title, says) = match what {
        What::Table if is_robot(workbench) => (
            say!("Save robot"),
            say!("A file that says what its numbers mean is written beside it"),
        ),
        What::Table => (
            say!("Save table"),
            say!("A file that says what the table means is written beside it"),
        ),
        What::Model => (
            say!("Save model"),
            say!("The model can be exported and verified later"),
        ),
        What::Poses => (
            say!("Save measuring list"),
            say!("A CSV table with the session's column names, to be measured next"),
        ),
        What::Report(_) => (
            say!("Save report"),
            say!(
                "A name that ends in .html or .pdf; a session without a diagnosis is diagnosed first"
            ),
        ),
        What::Picture(_) => (
            say!("Save picture"),
            say!("A name that ends in .svg or .png"),
        ),
        What::Numbers(_) => (
            say!("Save data"),
            say!("A CSV table of what the chart shows, with all digits"),
        ),
        What::Targets => (
            say!("Save corrected file"),
            say!("What was changed is written beside it, as NAME.meta.json"),
        ),
        What::Robot(_) | What::TypedRobot => (
            say!("Save robot file"),
            say!("A file that sessions, imports and plans take"),
        ),
    };
    match path_form(ui, workbench, (title, says), typed, commands) {
        PathInput::Done { path, replace } => commands.push(Command::ExportTo {
            what,
            path,
            replace,
        }),
        PathInput::Changed { path, replace } => {
            commands.push(Command::View(ViewChange::Sheet(Some(Sheet::ExportPath {
                what,
                path,
                replace,
            }))));
        }
        PathInput::Same => {}
    }
}
