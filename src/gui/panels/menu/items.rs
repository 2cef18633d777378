//! What a menu is made of: words with their keys.

use egui::containers::menu::MenuButton;
use egui::{Button, Id, Popup, Response, Role, Ui, WidgetInfo};

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

/// Which menu was open in the frame before, and which the pointer has opened.
#[derive(Debug, Clone, Copy, Default)]
struct Open {
    now: Option<Id>,
    by_pointer: Option<Id>,
    /// When that was clicked, in the window's seconds: a frame may be laid out twice.
    clicked_at: Option<f64>,
}

/// A header of the bar. While one menu is open the pointer opens the others, and a click that comes
/// with the pointer does not close again what the pointer has just opened.
pub(super) fn header(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let key = Id::unique("open menu");
    let before: Open = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let mut open = before;
    let (response, shown) = MenuButton::new(name).ui(ui, contents);
    let id = Popup::default_response_id(&response);
    let another = before.now.is_some_and(|now| now != id);
    let clicked = response.clicked();
    let time = ui.input(|input| input.time);
    let first = before.clicked_at.is_none_or(|at| at == time);
    let opened_here = before.by_pointer == Some(id) && first;
    if opened_here && !response.hovered() {
        open.by_pointer = None;
    }
    if response.hovered() && another || clicked && opened_here {
        Popup::open_id(ui.ctx(), id);
        ui.ctx().request_repaint();
        open.now = Some(id);
        open.by_pointer = Some(id);
        open.clicked_at = clicked.then_some(time);
    } else if shown.is_some() {
        open.now = Some(id);
    } else if before.now == Some(id) {
        open = Open::default();
    }
    ui.data_mut(|data| data.insert_temp(key, open));
}

/// An item goes by its text alone, without its keys.
pub(super) fn named(response: Response, text: &str) -> Response {
    let enabled = response.enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, text));
    response
}
