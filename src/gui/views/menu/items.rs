//! What a menu is made of: words with their keys.

use egui::containers::menu::MenuButton;
use egui::{Button, Id, Popup, Response, Role, Ui, WidgetInfo};

use crate::gui::actions;
use crate::gui::actions::Action;
use crate::gui::workbench::{Command, Workbench};

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
        let button = Button::new(text).shortcut_text(actions::keys(ui.ctx(), action));
        let response = ui.add_enabled(enabled, button);
        self.chosen(ui, response, text, action);
    }

    /// One of several ways to look.
    pub(super) fn choice(&mut self, ui: &mut Ui, on: bool, text: &str, action: Action) {
        let keys = actions::keys(ui.ctx(), action);
        let response = ui.add(Button::selectable(on, text).shortcut_text(keys));
        self.chosen(ui, response, text, action);
    }

    fn chosen(&mut self, ui: &mut Ui, response: Response, text: &str, action: Action) {
        if named(response, text).clicked() {
            let command = actions::command_for(ui.ctx(), action, self.workbench);
            self.commands.push(command);
            ui.close();
        }
    }
}

/// Which menu was open in the frame before, and which the pointer has opened, and when.
#[derive(Debug, Clone, Copy, Default)]
struct Open {
    now: Option<Id>,
    by_pointer: Option<(Id, f64)>,
}

/// A click so soon after the pointer has opened a menu is meant to open it, seconds.
const SOON_S: f64 = 2.0;

/// A header of the bar. While one menu is open the pointer opens the others, and a click that comes
/// with the pointer does not close again what the pointer has just opened.
pub(super) fn header(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let key = Id::unique("open menu");
    let mut open: Open = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let time = ui.input(|input| input.time);
    let (response, shown) = MenuButton::new(name).ui(ui, contents);
    let id = Popup::default_response_id(&response);
    let another = open.now.is_some_and(|now| now != id);
    let soon = |(opened, at): (Id, f64)| opened == id && time - at <= SOON_S;
    let meant = response.clicked() && open.by_pointer.is_some_and(soon);
    if response.hovered() && another || meant {
        Popup::open_id(ui.ctx(), id);
        ui.ctx().request_repaint();
        open.now = Some(id);
        if !meant {
            open.by_pointer = Some((id, time));
        }
    } else if shown.is_some() {
        open.now = Some(id);
    } else if open.now == Some(id) {
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

pub(super) fn results_says(open: bool) -> &'static str {
    if open { "Hide results" } else { "Show results" }
}
