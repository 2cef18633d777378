//! How sheets end: their buttons, and Enter.

use egui::{Key, Ui};

use crate::gui::style::tokens::space;
use crate::gui::view::Sheet;
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange};

/// The buttons at the end of a sheet. Whether the first was pressed.
pub(super) fn buttons(ui: &mut Ui, text: &str, enabled: bool, commands: &mut Vec<Command>) -> bool {
    let pressed = buttons_without_enter(ui, text, enabled, commands);
    pressed || (enabled && entered(ui))
}

/// The same where Enter only ends what is typed into one of many fields.
pub(super) fn buttons_without_enter(
    ui: &mut Ui,
    text: &str,
    enabled: bool,
    commands: &mut Vec<Command>,
) -> bool {
    buttons_or_back(ui, text, enabled, None, commands)
}

/// The same where *Cancel* goes back to the sheet that this one was opened from.
pub(super) fn buttons_or_back(
    ui: &mut Ui,
    text: &str,
    enabled: bool,
    back: Option<Sheet>,
    commands: &mut Vec<Command>,
) -> bool {
    ui.add_space(space::ROW);
    ui.columns(2, |columns| {
        if widgets::other(&mut columns[0], say!("Cancel")).clicked() {
            commands.push(Command::View(ViewChange::Sheet(back)));
        }
        let button = columns[1].add_enabled_ui(enabled, |ui| widgets::primary(ui, text));
        button.inner.clicked()
    })
}

/// The button at the end of a sheet that only says something.
pub(super) fn done(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.add_space(space::ROW);
    if widgets::primary(ui, say!("Done")).clicked() || entered(ui) {
        commands.push(Command::View(ViewChange::Sheet(None)));
    }
}

/// Whether Enter was pressed, and for no control in particular: it means the button that stands
/// out.
pub(super) fn entered(ui: &Ui) -> bool {
    let nowhere = ui.memory(|memory| memory.focused().is_none());
    nowhere && ui.input(|input| input.key_pressed(Key::Enter))
}
