//! What would be lost, before it is; and a file that changed, before it is replaced.

use std::path::Path;

use egui::Ui;

use crate::gui::style::tokens::space;
use crate::gui::view::NextAction;
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command, ViewChange, Workbench};

/// Shows what would be lost, and what can be done about it.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    then: &NextAction,
    commands: &mut Vec<Command>,
) {
    ui.set_width(420.0);
    let (title, discard) = match then {
        NextAction::Leave => (say!("Leave without saving?"), say!("Leave without saving")),
        NextAction::Open(_) | NextAction::Example(_) => {
            (say!("Open without saving?"), say!("Open without saving"))
        }
        NextAction::Simulate(_) => (
            say!("Simulate without saving?"),
            say!("Simulate without saving"),
        ),
    };
    widgets::heading(ui, title);
    let name = &workbench.loaded_session().session.name;
    let losses = workbench.at_risk();
    if losses.session {
        let file = workbench.file().and_then(Path::file_name);
        ui.label(match file {
            Some(file) => say!(
                "Changes of {name} are not in its file, {file}",
                name = name,
                file = file.to_string_lossy()
            ),
            None => say!("The session {name} has not been saved", name = name),
        });
    }
    if losses.model {
        ui.label(say!(
            "What was identified from {name} has not been saved",
            name = name
        ));
    }
    let save = match (losses.session, losses.model) {
        (true, _) => say!("Save session"),
        (false, true) => say!("Save model…"),
        (false, false) => say!("Go on"),
    };
    let sheet = |ui: &mut Ui, commands: &mut Vec<Command>| {
        ui.add_space(space::ROW);
        if widgets::primary(ui, save).clicked() {
            commands.push(if losses.any() {
                Command::SaveThen(then.clone())
            } else {
                Command::Do(then.clone())
            });
        }
        ui.columns(2, |columns| {
            if widgets::secondary(&mut columns[0], discard).clicked() {
                commands.push(Command::Do(then.clone()));
            }
            if widgets::secondary(&mut columns[1], say!("Cancel")).clicked() {
                commands.push(Command::View(ViewChange::Sheet(None)));
            }
        });
    };
    sheet(ui, commands);
}

/// Asks whether a file that changed since it was read is to be replaced.
pub(super) fn overwrite(ui: &mut Ui, path: &Path, commands: &mut Vec<Command>) {
    ui.set_width(420.0);
    widgets::heading(ui, say!("Replace what another program wrote?"));
    ui.label(say!(
        "{path} changed since it was read. Saving here would replace what was written there",
        path = path.display()
    ));
    ui.add_space(space::ROW);
    if widgets::primary(ui, say!("Save under another name…")).clicked() {
        commands.push(Command::View(ViewChange::Sheet(None)));
        commands.push(Command::Ask(Asked::WhereToSave));
    }
    ui.columns(2, |columns| {
        if widgets::secondary(&mut columns[0], say!("Replace it")).clicked() {
            commands.push(Command::SaveDespite);
        }
        if widgets::secondary(&mut columns[1], say!("Cancel")).clicked() {
            commands.push(Command::View(ViewChange::Sheet(None)));
        }
    });
}
