//! What a menu is made of: words with their keys.

use egui::containers::menu::MenuButton;
use egui::{Button, Id, Popup, Response, Role, Ui, WidgetInfo};

use crate::gui::actions::{Action, WindowState};
use crate::gui::workbench::{Command, Workbench};

/// What the items of a menu are about, and what they ask for.
pub(super) struct Menu<'a> {
    pub(super) workbench: &'a Workbench,
    pub(super) commands: &'a mut Vec<Command>,
}

impl Menu<'_> {
    /// Things to do, one below the other.
    pub(super) fn items(&mut self, ui: &mut Ui, actions: &[Action]) {
        for action in actions {
            self.item_about(ui, action, None);
        }
    }

    /// One of them, with what there is to say about it.
    pub(super) fn item_about(&mut self, ui: &mut Ui, action: &Action, about: Option<&str>) {
        let ctx = ui.ctx().clone();
        let now = WindowState {
            ctx: &ctx,
            workbench: self.workbench,
        };
        let text = action.label(now);
        let button = match action.chosen(now) {
            Some(on) => Button::selectable(on, &text),
            None => Button::new(&text),
        };
        let button = button.shortcut_text(action.keys(&ctx));
        let mut response = named(ui.add_enabled(action.enabled(now), button), &text);
        if let Some(about) = about {
            response = response.on_hover_text(about);
        }
        if response.clicked() {
            self.commands.push(action.command(now));
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
