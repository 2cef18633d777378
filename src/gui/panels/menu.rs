//! The bar at the top: menus, the session's name, undo and redo.

use egui::{Align, Button, Layout, MenuBar, RichText, ThemePreference, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::files::EXAMPLES;
use crate::gui::simulate::Form;
use crate::gui::subject::Origin;
use crate::gui::tokens::{Palette, size, strong};
use crate::gui::view::{AngleUnit, LengthUnit, Sheet};
use crate::gui::widgets;

use super::shortcuts::{self, Action};

/// Width of the menus, points.
const MENUS: f32 = 200.0;

/// What the window is called.
pub(crate) fn window_title(workbench: &Workbench) -> String {
    let name = &workbench.document().subject.session.name;
    let mark = if workbench.unsaved() { " ●" } else { "" };
    format!("{name}{mark} – truepose")
}

/// Shows the bar.
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
        ui.allocate_ui(egui::vec2(MENUS, ui.available_height()), |ui| {
            MenuBar::new().ui(ui, |ui| {
                ui.menu_button("File", |ui| file(ui, workbench, commands));
                ui.menu_button("Edit", |ui| edit(ui, workbench, commands));
                ui.menu_button("View", |ui| view(ui, workbench, commands));
                ui.menu_button("Help", |ui| help(ui, commands));
            });
        });
        name(ui, workbench);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let redo = workbench.redoes();
            let says = redo.map_or_else(|| "Nothing to redo".into(), |w| format!("Redo {w}"));
            if widgets::history_button(ui, true, redo.is_some(), &says).clicked() {
                commands.push(Command::Redo);
            }
            let undo = workbench.undoes();
            let says = undo.map_or_else(|| "Nothing to undo".into(), |w| format!("Undo {w}"));
            if widgets::history_button(ui, false, undo.is_some(), &says).clicked() {
                commands.push(Command::Undo);
            }
        });
    });
}

fn name(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let subject = workbench.subject();
    ui.label(RichText::new(&subject.session.name).font(strong(size::BODY)));
    let origin = match &subject.origin {
        Origin::Bundled => "example".to_owned(),
        Origin::Simulated => "simulated".to_owned(),
        Origin::File(path) | Origin::Model(path) => path
            .file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
    };
    let origin = match (&workbench.document().given, &subject.origin) {
        (Some(_), Origin::Model(_)) => format!("model {origin}"),
        (Some(given), _) => format!("{origin} · model {}", given.file_name()),
        (None, _) => origin,
    };
    let says = if workbench.unsaved() {
        format!("{origin} · not saved")
    } else {
        origin
    };
    ui.label(RichText::new(says).size(size::SMALL).color(palette.muted));
}

fn item(ui: &mut Ui, text: &str, action: Action, enabled: bool, commands: &mut Vec<Command>) {
    let keys = shortcuts::keys(ui.ctx(), action);
    let button = Button::new(text).shortcut_text(keys);
    if ui.add_enabled(enabled, button).clicked() {
        commands.push(shortcuts::command(action));
        ui.close();
    }
}

fn file(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    item(ui, "Open…", Action::Open, true, commands);
    ui.menu_button("Examples", |ui| {
        for (index, example) in EXAMPLES.iter().enumerate() {
            let button = ui.button(example.name);
            if button.on_hover_text(example.what).clicked() {
                commands.push(Command::OpenExample(index));
                ui.close();
            }
        }
    });
    if ui.button("New by simulation…").clicked() {
        commands.push(Command::Sheet(Some(Sheet::Simulate(Form::default()))));
        ui.close();
    }
    ui.separator();
    let measured = !workbench.subject().is_empty();
    item(ui, "Save session…", Action::Save, measured, commands);
    let to_path = Button::new("Save session to path…");
    if ui.add_enabled(measured, to_path).clicked() {
        let path = crate::gui::files::file_name_for(&workbench.document().subject.session);
        let replace = false;
        commands.push(Command::Sheet(Some(Sheet::SavePath { path, replace })));
        ui.close();
    }
    ui.separator();
    if ui.button("Quit").clicked() {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
    }
}

fn edit(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    let undo = workbench.undoes();
    let redo = workbench.redoes();
    let named = |verb: &str, what: Option<&str>| {
        what.map_or_else(|| verb.to_owned(), |what| format!("{verb} {what}"))
    };
    item(
        ui,
        &named("Undo", undo),
        Action::Undo,
        undo.is_some(),
        commands,
    );
    item(
        ui,
        &named("Redo", redo),
        Action::Redo,
        redo.is_some(),
        commands,
    );
    ui.separator();
    let measured = !workbench.subject().is_empty();
    item(ui, "Identify", Action::Identify, measured, commands);
}

fn view(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    let view = workbench.view();
    let mut choice = |ui: &mut Ui, on: bool, text: &str, command: Command| {
        if ui.radio(on, text).clicked() {
            commands.push(command);
            ui.close();
        }
    };
    for (theme, name) in [
        (ThemePreference::System, "Light or dark as the system"),
        (ThemePreference::Light, "Light"),
        (ThemePreference::Dark, "Dark"),
    ] {
        choice(ui, view.theme == theme, name, Command::Theme(theme));
    }
    ui.separator();
    for (unit, name) in [
        (LengthUnit::Millimetre, "Lengths in mm"),
        (LengthUnit::Micrometre, "Lengths in µm"),
        (LengthUnit::Inch, "Lengths in inches"),
    ] {
        choice(ui, view.length == unit, name, Command::Length(unit));
    }
    ui.separator();
    for (unit, name) in [
        (AngleUnit::Degree, "Angles in degrees"),
        (AngleUnit::Radian, "Angles in radians"),
    ] {
        choice(ui, view.angle == unit, name, Command::Angle(unit));
    }
    ui.separator();
    item(
        ui,
        "Show everything in the plots",
        Action::Fit,
        true,
        commands,
    );
    egui::gui_zoom::zoom_menu_buttons(ui);
}

fn help(ui: &mut Ui, commands: &mut Vec<Command>) {
    for (name, sheet) in [
        ("Keyboard shortcuts", Sheet::Shortcuts),
        ("About truepose", Sheet::About),
    ] {
        if ui.button(name).clicked() {
            commands.push(Command::Sheet(Some(sheet)));
            ui.close();
        }
    }
}
