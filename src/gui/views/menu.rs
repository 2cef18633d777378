//! The bar at the top: menus, the session's name, undo and redo.

use egui::containers::menu::MenuButton;
use egui::{Align, Button, FontId, Label, Layout, MenuBar, Popup, RichText, ScrollArea, Ui};

use crate::gui::actions::{self, Action, OPEN_EXAMPLE, OPEN_LATEST};
use crate::gui::core::disk::{EXAMPLES, name_of};
use crate::gui::core::loaded_session::Origin;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets::{self, Buttons, Does};
use crate::gui::workbench::Workbench;
use crate::text::{capital, spoken};

/// Width of the menus, points.
const MENUS: f32 = 200.0;

/// Between a menu's items and its header and the window's edge, together, points.
const AROUND_MENU: f32 = 24.0;

/// With less room it is not said where the session comes from, points.
const LEAST_ORIGIN: f32 = 80.0;

/// Room for the buttons at the right, points.
const BUTTONS: f32 = 190.0;

/// What the window is called.
pub(crate) fn window_title(workbench: &Workbench) -> String {
    let name = &workbench.document().loaded_session.session.name;
    let mark = if workbench.unsaved() { " ●" } else { "" };
    format!("{name}{mark} – truepose")
}

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    ui.horizontal_centered(|ui| {
        let palette = Palette::of(ui);
        ui.label(
            RichText::new("truepose")
                .font(strong(size::HEADING))
                .color(palette.accent),
        );
        ui.add_space(8.0);
        // A menu bar takes all the width that it is given.
        let menus = ui.allocate_ui(egui::vec2(MENUS, ui.available_height()), |ui| {
            MenuBar::new().ui(ui, |ui| {
                header(ui, &capital(say!("file")), |ui| file(ui, workbench));
                header(ui, say!("Edit"), |ui| edit(ui, workbench));
                header(ui, say!("View"), |ui| view(ui, workbench));
                header(ui, say!("Help"), |ui| help(ui, workbench));
            });
        });
        // The session's name stands over the plots, which are its own, and leaves room for the
        // buttons at the right.
        let room = actions::layout(ui.ctx(), workbench);
        let over_the_plots = room.left + f32::from(space::PLOT) - ui.cursor().left();
        ui.add_space(over_the_plots.max(0.0));
        // Menus of another language may be wider.
        if menus.response.rect.width() > MENUS + 0.5 {
            ui.add_space(space::ROW);
        }
        let width = (ui.available_width() - BUTTONS).max(0.0);
        let high = ui.available_height();
        let left = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(width, high), left, |ui| name(ui, workbench));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            actions::REDO.sign(ui, workbench, widgets::REDO);
            actions::UNDO.sign(ui, workbench, widgets::UNDO);
            ui.add_space(space::ROW);
            let open = actions::layout(ui.ctx(), workbench).results();
            let says = actions::results_says(open);
            let side = widgets::icon(widgets::SIDE);
            let button = if open {
                ui.bare_button(side, says)
            } else {
                let name = RichText::new(say!("Results")).font(strong(size::SMALL));
                let name = name.color(Palette::of(ui).accent);
                ui.bare_button((name, side), says)
            };
            button
                .on_hover_text(says)
                .does(workbench, move |bench| bench.view.results = Some(!open));
        });
    });
}

fn name(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    let title = RichText::new(&loaded_session.session.name).font(strong(size::BODY));
    let title = ui.add(Label::new(title).truncate());
    let origin = match (workbench.file(), &loaded_session.origin) {
        (Some(path), _) => name_of(path).into_owned(),
        (None, Origin::Bundled) => say!("example").to_owned(),
        (None, Origin::Simulated) => say!("simulated").to_owned(),
        (None, Origin::Recovered(_)) => say!("restored").to_owned(),
        (None, Origin::Imported(path)) => say!("from {path}", path = name_of(path)),
        (None, Origin::File(path) | Origin::Model(path)) => name_of(path).into_owned(),
    };
    let model = |name: String| say!("model {name}", name);
    let mut parts = match (&workbench.document().loaded_model, &loaded_session.origin) {
        (Some(_), Origin::Model(_)) => vec![model(origin)],
        (Some(given), _) => vec![origin, model(given.file_name())],
        (None, _) => vec![origin],
    };
    if workbench.unsaved() {
        parts.push(say!("not saved").to_owned());
    }
    let says = parts.join(" · ");
    let font = FontId::proportional(size::SMALL);
    let wide = widgets::width_of(ui, &says, font);
    // Of a short name a few letters would say nothing.
    let room = ui.available_width();
    if wide <= room || room > LEAST_ORIGIN {
        let says = RichText::new(says).small().weak();
        ui.add(Label::new(says).truncate());
    } else {
        title.on_hover_text(says);
    }
}

/// Things to do, one below the other, in groups.
fn groups(ui: &mut Ui, workbench: &Workbench, groups: &[&[Action]]) {
    for (k, group) in groups.iter().enumerate() {
        if k > 0 {
            ui.separator();
        }
        for action in *group {
            action.item(ui, workbench);
        }
    }
}

/// A click so soon after the pointer has opened a menu is meant to open it, seconds.
const SOON_S: f64 = 2.0;

/// A header of the bar. While one menu is open the pointer opens the others; a click that comes with the pointer does
/// not close again what the pointer has just opened.
fn header(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    // In a low window, or with large text, a menu is higher than what is below its header.
    let high = ui.ctx().content_rect().bottom() - ui.max_rect().bottom() - AROUND_MENU;
    let (response, shown) = MenuButton::new(name).ui(ui, |ui| {
        let scroll = ScrollArea::vertical().max_height(high);
        scroll.min_scrolled_height(high).show(ui, |ui| {
            contents(ui);
            widgets::focus_in_sight(ui);
        });
    });
    let (id, now) = (
        Popup::default_response_id(&response),
        ui.input(|input| input.time),
    );
    let since: Option<f64> = ui.data(|data| data.get_temp(id));
    if response.clicked() && since.is_some_and(|since| now - since <= SOON_S) {
        Popup::open_id(ui.ctx(), id);
        ui.ctx().request_repaint();
    } else if shown.is_none() {
        ui.data_mut(|data| data.remove::<f64>(id));
    } else if since.is_none() {
        // What a click has opened another closes.
        let since = if response.clicked() {
            f64::NEG_INFINITY
        } else {
            now
        };
        ui.data_mut(|data| data.insert_temp(id, since));
    }
}

fn file(ui: &mut Ui, workbench: &Workbench) {
    use actions::{COMPENSATE, IMPORT, NEW, QUIT, RELOAD, REPORT, REPORT_DETAILS, ROBOTS};
    use actions::{SAVE, SAVE_AS, SAVE_MODEL, SAVE_TABLE, SAVE_TO_PATH};
    ui.set_min_width(260.0);
    actions::OPEN.item(ui, workbench);
    recent(ui, workbench);
    ui.menu_button(say!("Examples"), |ui| {
        for (action, example) in OPEN_EXAMPLE.iter().zip(&EXAMPLES) {
            let item = action.item(ui, workbench);
            item.on_hover_text(spoken(example.what));
        }
    });
    let all: [&[Action]; 5] = [
        &[IMPORT, NEW, ROBOTS],
        &[SAVE, SAVE_AS, SAVE_TO_PATH],
        &[SAVE_MODEL, SAVE_TABLE, COMPENSATE, REPORT_DETAILS, REPORT],
        &[RELOAD],
        &[QUIT],
    ];
    groups(ui, workbench, &all);
}

fn recent(ui: &mut Ui, workbench: &Workbench) {
    let mut recent = workbench.recent().peekable();
    if recent.peek().is_none() {
        ui.add_enabled(false, Button::new(say!("Recent files")));
        return;
    }
    ui.menu_button(say!("Recent files"), |ui| {
        for (k, path) in recent.enumerate() {
            let name = name_of(path);
            let keys = if k == 0 {
                OPEN_LATEST.keys(ui.ctx())
            } else {
                String::new()
            };
            let button = Button::new(name.clone()).shortcut_text(keys);
            let button = actions::item(ui, button, &name, true);
            if button.on_hover_text(path.display().to_string()).clicked() {
                let path = path.clone();
                workbench.then(move |bench| bench.open_file(path));
                ui.close();
            }
        }
    });
}

fn edit(ui: &mut Ui, workbench: &Workbench) {
    use actions::{CANCEL, EXCLUDE, IDENTIFY, PREFERENCES, REDO, SEARCH, UNDO};
    ui.set_min_width(240.0);
    let all: [&[Action]; 4] = [
        &[UNDO, REDO],
        &[EXCLUDE],
        &[IDENTIFY, SEARCH, CANCEL],
        &[PREFERENCES],
    ];
    groups(ui, workbench, &all);
}

fn view(ui: &mut Ui, workbench: &Workbench) {
    use actions::{FIT, LOOK_AROUND, LOOK_IN_SPACE, LOOK_XY, LOOK_XZ, LOOK_YZ, NEXT_ANGLE};
    use actions::{NEXT_LENGTH, OTHER_THEME, RESULTS, STEPS};
    ui.set_min_width(260.0);
    let all: [&[Action]; 4] = [
        &STEPS[..workbench.steps().len()],
        &[LOOK_XY, LOOK_XZ, LOOK_YZ, LOOK_AROUND, LOOK_IN_SPACE, FIT],
        &[RESULTS],
        &[NEXT_LENGTH, NEXT_ANGLE, OTHER_THEME],
    ];
    groups(ui, workbench, &all);
}

fn help(ui: &mut Ui, workbench: &Workbench) {
    ui.set_min_width(240.0);
    groups(ui, workbench, &[&[actions::WORDS, actions::ABOUT]]);
}
