//! What a menu is made of: words with their keys.

use egui::{Button, Response, Role, Ui, WidgetInfo};

use crate::gui::commands::{Command, Workbench};
use crate::gui::panels::shortcuts::{self, Action};

/// What the items of a menu are about, and what they ask for.
pub(super) struct Menu<'a> {
    /// What there is.
    pub(super) workbench: &'a Workbench,
    /// What is asked for.
    pub(super) commands: &'a mut Vec<Command>,
}

impl Menu<'_> {
    /// Something to do.
    pub(super) fn item(&mut self, ui: &mut Ui, text: &str, action: Action, enabled: bool) {
        let button = Button::new(text).shortcut_text(shortcuts::keys(ui.ctx(), action));
        let response = ui.add_enabled(enabled, button);
        self.chosen(ui, response, text, action);
    }

    /// One of several ways to look.
    pub(super) fn choice(&mut self, ui: &mut Ui, on: bool, text: &str, action: Action) {
        let keys = shortcuts::keys(ui.ctx(), action);
        let response = ui.add(Button::selectable(on, text).shortcut_text(keys));
        self.chosen(ui, response, text, action);
    }

    fn chosen(&mut self, ui: &mut Ui, response: Response, text: &str, action: Action) {
        if named(response, text).clicked() {
            let command = shortcuts::command_for(ui.ctx(), action, self.workbench);
            self.commands.push(command);
            ui.close();
        }
    }
}

/// An item goes by its text alone, without its keys.
pub(super) fn named(response: Response, text: &str) -> Response {
    let enabled = response.enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, text));
    response
}
