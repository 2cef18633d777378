//! The bar at the top: menus, the session's name, undo and redo.

use egui::containers::menu::MenuButton;
use egui::{Align, Label, Layout, MenuBar, RichText, ScrollArea, Ui};

use crate::gui::actions::{self, Action, OPEN_EXAMPLE, STEPS};
use crate::gui::actions::{ABOUT, CANCEL, COMPENSATE, EXCLUDE, FIT, IDENTIFY, IMPORT, LOOK_AROUND};
use crate::gui::actions::{LOOK_IN_SPACE, LOOK_XY, LOOK_XZ, LOOK_YZ, NEW, OPEN, PREFERENCES, QUIT};
use crate::gui::actions::{REDO, RELOAD, REPORT, REPORT_DETAILS, RESULTS, ROBOTS, SAVE, SAVE_AS};
use crate::gui::actions::{SAVE_MODEL, SAVE_TABLE, SAVE_TO_PATH, SEARCH, UNDO, WORDS};
use crate::gui::core::disk::{EXAMPLES, name_of};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets::{self, Buttons, Does};
use crate::gui::workbench::Workbench;
use crate::text::{capital, spoken};

/// Width of the menus, points.
const MENUS: f32 = 200.0;

/// Width of a menu's items, points.
const WIDE: f32 = 260.0;

/// Between a menu's items and its header and the window's edge, together, points.
const AROUND_MENU: f32 = 24.0;

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
                header(ui, say!("Edit"), |ui| groups(ui, workbench, EDIT));
                header(ui, say!("View"), |ui| {
                    groups(ui, workbench, &[&STEPS[..workbench.steps().len()]]);
                    ui.separator();
                    groups(ui, workbench, VIEW);
                });
                header(ui, say!("Help"), |ui| groups(ui, workbench, HELP));
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
            REDO.sign(ui, workbench, widgets::REDO);
            UNDO.sign(ui, workbench, widgets::UNDO);
            ui.add_space(space::ROW);
            let open = room.results();
            let says = if open {
                say!("Hide results")
            } else {
                say!("Show results")
            };
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

/// The session's name, and what its file and its model are called.
fn name(ui: &mut Ui, workbench: &Workbench) {
    let title = RichText::new(&workbench.loaded_session().session.name);
    ui.add(Label::new(title.font(strong(size::BODY))).truncate());
    let file = workbench.file().or(workbench.came_from());
    let mut parts = Vec::from_iter(file.map(|path| name_of(path).into_owned()));
    let model = workbench.document().loaded_model.as_ref();
    parts.extend(model.map(|given| say!("model {name}", name = given.file_name())));
    if workbench.unsaved() {
        parts.push(say!("not saved").to_owned());
    }
    let says = RichText::new(parts.join(" · ")).small().weak();
    ui.add(Label::new(says).truncate());
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

/// A header of the bar. In a low window, or with large text, a menu is higher than what is below its header.
fn header(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let high = ui.ctx().content_rect().bottom() - ui.max_rect().bottom() - AROUND_MENU;
    MenuButton::new(name).ui(ui, |ui| {
        let scroll = ScrollArea::vertical().max_height(high);
        scroll.min_scrolled_height(high).show(ui, |ui| {
            ui.set_min_width(WIDE);
            contents(ui);
            widgets::focus_in_sight(ui);
        });
    });
}

const FILE: &[&[Action]] = &[
    &[IMPORT, NEW, ROBOTS],
    &[SAVE, SAVE_AS, SAVE_TO_PATH],
    &[SAVE_MODEL, SAVE_TABLE, COMPENSATE, REPORT_DETAILS, REPORT],
    &[RELOAD],
    &[QUIT],
];
const EDIT: &[&[Action]] = &[
    &[UNDO, REDO],
    &[EXCLUDE],
    &[IDENTIFY, SEARCH, CANCEL],
    &[PREFERENCES],
];
const VIEW: &[&[Action]] = &[
    &[LOOK_XY, LOOK_XZ, LOOK_YZ, LOOK_AROUND, LOOK_IN_SPACE, FIT],
    &[RESULTS],
];
const HELP: &[&[Action]] = &[&[WORDS, ABOUT]];

fn file(ui: &mut Ui, workbench: &Workbench) {
    OPEN.item(ui, workbench);
    recent(ui, workbench);
    ui.menu_button(say!("Examples"), |ui| {
        for (action, example) in OPEN_EXAMPLE.iter().zip(&EXAMPLES) {
            let item = action.item(ui, workbench);
            item.on_hover_text(spoken(example.what));
        }
    });
    groups(ui, workbench, FILE);
}

fn recent(ui: &mut Ui, workbench: &Workbench) {
    let recent: Vec<_> = workbench.recent().cloned().collect();
    ui.add_enabled_ui(!recent.is_empty(), |ui| {
        ui.menu_button(say!("Recent files"), |ui| {
            for path in recent {
                let item = ui.button(name_of(&path));
                if item.on_hover_text(path.display().to_string()).clicked() {
                    workbench.then(move |bench| bench.open_file(path));
                    ui.close();
                }
            }
        });
    });
}
