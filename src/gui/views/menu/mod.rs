//! The bar at the top: menus, the session's name, undo and redo.

mod file;
mod items;
mod lists;

use egui::{Align, FontId, Label, Layout, MenuBar, RichText, Ui};

use crate::gui::core::loaded_session::Origin;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};

use crate::gui::actions;

use items::{Menu, header};

/// Width of the menus, points.
const MENUS: f32 = 200.0;

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

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
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
                let menu = &mut Menu {
                    workbench,
                    commands,
                };
                header(ui, say!("File"), |ui| file::show(ui, menu));
                header(ui, say!("Edit"), |ui| lists::edit(ui, menu));
                header(ui, say!("View"), |ui| lists::view(ui, menu));
                header(ui, say!("Help"), |ui| lists::help(ui, menu));
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
            let redo = workbench.redoes();
            let says = redo.map_or_else(
                || say!("Nothing to redo").into(),
                |w| say!("Redo {edit}", edit = w),
            );
            if widgets::history_button(ui, true, redo.is_some(), &says).clicked() {
                commands.push(Command::Redo);
            }
            let undo = workbench.undoes();
            let says = undo.map_or_else(
                || say!("Nothing to undo").into(),
                |w| say!("Undo {edit}", edit = w),
            );
            if widgets::history_button(ui, false, undo.is_some(), &says).clicked() {
                commands.push(Command::Undo);
            }
            ui.add_space(space::ROW);
            let open = actions::layout(ui.ctx(), workbench).results();
            if widgets::side_button(ui, open, actions::results_says(open)).clicked() {
                commands.push(Command::View(ViewChange::Results(!open)));
            }
        });
    });
}

fn name(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let loaded_session = workbench.loaded_session();
    let title = RichText::new(&loaded_session.session.name).font(strong(size::BODY));
    let title = ui.add(Label::new(title).truncate());
    let file_name = |path: &std::path::Path| {
        let name = path.file_name();
        name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let origin = match (workbench.file(), &loaded_session.origin) {
        (Some(path), _) => file_name(path),
        (None, Origin::Bundled) => say!("example").to_owned(),
        (None, Origin::Simulated) => say!("simulated").to_owned(),
        (None, Origin::Recovered(_)) => say!("restored").to_owned(),
        (None, Origin::Imported(path)) => say!("from {path}", path = file_name(path)),
        (None, Origin::File(path) | Origin::Model(path)) => file_name(path),
    };
    let origin = match (&workbench.document().loaded_model, &loaded_session.origin) {
        (Some(_), Origin::Model(_)) => say!("model {origin}", origin = origin),
        (Some(given), _) => say!(
            "{origin} · model {given}",
            origin = origin,
            given = given.file_name()
        ),
        (None, _) => origin,
    };
    let says = if workbench.unsaved() {
        say!("{origin} · not saved", origin = origin)
    } else {
        origin
    };
    let font = FontId::proportional(size::SMALL);
    let galley = ui
        .painter()
        .layout_no_wrap(says.clone(), font, palette.muted);
    // Of a short name a few letters would say nothing.
    let room = ui.available_width();
    if galley.size().x <= room || room > LEAST_ORIGIN {
        let says = RichText::new(says).size(size::SMALL).color(palette.muted);
        ui.add(Label::new(says).truncate());
    } else {
        title.on_hover_text(says);
    }
}
