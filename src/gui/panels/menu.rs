//! The bar at the top: menus, the session's name, undo and redo.

use egui::{Align, Button, Label, Layout, MenuBar, Response, RichText, Role, Ui, WidgetInfo};

use crate::gui::commands::{Command, Workbench};
use crate::gui::files::EXAMPLES;
use crate::gui::subject::Origin;
use crate::gui::tokens::{Palette, size, space, strong};
use crate::gui::view::{AngleUnit, LengthUnit, Plane, Step};
use crate::gui::widgets;

use super::shortcuts::{self, Action};
use super::unsaved;

/// Width of the menus, points.
const MENUS: f32 = 200.0;

/// Room for the buttons at the right, points.
const BUTTONS: f32 = 190.0;

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
                ui.menu_button("Help", |ui| help(ui, workbench, commands));
            });
        });
        // The session's name stands over the plots, which are its own, and leaves room for the
        // buttons at the right.
        let room = shortcuts::room(ui.ctx(), workbench);
        let over_the_plots = room.left + f32::from(space::PLOT) - ui.cursor().left();
        ui.add_space(over_the_plots.max(0.0));
        let width = (ui.available_width() - BUTTONS).max(0.0);
        let high = ui.available_height();
        let left = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(width, high), left, |ui| name(ui, workbench));
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
            ui.add_space(space::ROW);
            let open = shortcuts::room(ui.ctx(), workbench).results();
            if widgets::side_button(ui, open, results_says(open)).clicked() {
                commands.push(Command::Results(!open));
            }
        });
    });
}

fn results_says(open: bool) -> &'static str {
    if open { "Hide results" } else { "Show results" }
}

fn name(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let subject = workbench.subject();
    let title = RichText::new(&subject.session.name).font(strong(size::BODY));
    ui.add(Label::new(title).truncate());
    let file_name = |path: &std::path::Path| {
        let name = path.file_name();
        name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let origin = match (workbench.file(), &subject.origin) {
        (Some(path), _) => file_name(path),
        (None, Origin::Bundled) => "example".to_owned(),
        (None, Origin::Simulated) => "simulated".to_owned(),
        (None, Origin::Recovered(_)) => "restored".to_owned(),
        (None, Origin::Imported(path)) => format!("from {}", file_name(path)),
        (None, Origin::File(path) | Origin::Model(path)) => file_name(path),
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
    let says = RichText::new(says).size(size::SMALL).color(palette.muted);
    ui.add(Label::new(says).truncate());
}

/// An item goes by its text alone, without its keys.
fn named(response: Response, text: &str) -> Response {
    let enabled = response.enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, text));
    response
}

fn item(
    ui: &mut Ui,
    workbench: &Workbench,
    text: &str,
    action: Action,
    enabled: bool,
    commands: &mut Vec<Command>,
) {
    let keys = shortcuts::keys(ui.ctx(), action);
    let button = Button::new(text).shortcut_text(keys);
    if named(ui.add_enabled(enabled, button), text).clicked() {
        commands.push(shortcuts::command_for(ui.ctx(), action, workbench));
        ui.close();
    }
}

fn file(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(260.0);
    item(ui, workbench, "Open…", Action::Open, true, commands);
    recent(ui, workbench, commands);
    ui.menu_button("Examples", |ui| {
        for (index, example) in EXAMPLES.iter().enumerate() {
            let keys = shortcuts::keys(ui.ctx(), Action::Example(index));
            let button = ui.add(Button::new(example.name).shortcut_text(keys));
            let button = named(button, example.name);
            if button.on_hover_text(example.what).clicked() {
                commands.push(Command::OpenExample(index));
                ui.close();
            }
        }
    });
    item(
        ui,
        workbench,
        "New by simulation…",
        Action::New,
        true,
        commands,
    );
    ui.separator();
    let measured = !workbench.subject().is_empty();
    item(
        ui,
        workbench,
        "Save session",
        Action::Save,
        measured,
        commands,
    );
    item(
        ui,
        workbench,
        "Save session as…",
        Action::SaveAs,
        measured,
        commands,
    );
    let keys = shortcuts::keys(ui.ctx(), Action::SaveToPath);
    let to_path = Button::new("Save session to path…").shortcut_text(keys);
    if named(ui.add_enabled(measured, to_path), "Save session to path…").clicked() {
        commands.push(unsaved::typed_path(workbench));
        ui.close();
    }
    ui.separator();
    let answered = workbench.answer().is_some();
    item(
        ui,
        workbench,
        "Save model…",
        Action::SaveModel,
        answered,
        commands,
    );
    item(
        ui,
        workbench,
        "Save table…",
        Action::SaveTable,
        answered,
        commands,
    );
    ui.separator();
    let has_file = workbench.file().is_some();
    item(
        ui,
        workbench,
        "Read the file again",
        Action::Reload,
        has_file,
        commands,
    );
    let follows = workbench.following().is_some();
    let (text, can) = if follows {
        ("Stop following the file", true)
    } else {
        (
            "Follow the file as it grows",
            workbench.samples_file().is_some(),
        )
    };
    let keys = shortcuts::keys(ui.ctx(), Action::Follow);
    let button = Button::new(text).shortcut_text(keys);
    if named(ui.add_enabled(can, button), text).clicked() {
        commands.push(Command::Follow(!follows));
        ui.close();
    }
    ui.separator();
    item(ui, workbench, "Quit", Action::Quit, true, commands);
}

/// Files that were opened before. One that is not there any more says so, and can be taken out.
fn recent(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let recent: Vec<_> = workbench.recent().collect();
    if recent.is_empty() {
        ui.add_enabled(false, Button::new("Recent files"));
        return;
    }
    ui.menu_button("Recent files", |ui| {
        ui.set_min_width(300.0);
        for (k, (path, there)) in recent.iter().enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str());
            let name = name.to_string_lossy();
            let folder = path.parent().map(|f| f.display().to_string());
            ui.horizontal(|ui| {
                let keys = if k == 0 {
                    shortcuts::keys(ui.ctx(), Action::OpenLatest)
                } else {
                    String::new()
                };
                let button = Button::new(name.clone()).shortcut_text(keys);
                let button = named(ui.add_enabled(*there, button), &name);
                let button = button.on_hover_text(path.display().to_string());
                if button.clicked() {
                    commands.push(Command::OpenFile(path.to_path_buf()));
                    ui.close();
                }
                if *there {
                    let muted = Palette::of(ui).muted;
                    let folder = RichText::new(folder.unwrap_or_default());
                    let folder = folder.size(size::SMALL).color(muted);
                    ui.add(egui::Label::new(folder).truncate());
                } else {
                    let warning = Palette::of(ui).warning;
                    let says = RichText::new("not there any more").size(size::SMALL);
                    ui.label(says.color(warning));
                    if ui.small_button(format!("Forget {name}")).clicked() {
                        commands.push(Command::Forget(path.to_path_buf()));
                    }
                }
            });
        }
    });
}

fn edit(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    let undo = workbench.undoes();
    let redo = workbench.redoes();
    let with = |verb: &str, what: Option<&str>| {
        what.map_or_else(|| verb.to_owned(), |what| format!("{verb} {what}"))
    };
    item(
        ui,
        workbench,
        &with("Undo", undo),
        Action::Undo,
        undo.is_some(),
        commands,
    );
    item(
        ui,
        workbench,
        &with("Redo", redo),
        Action::Redo,
        redo.is_some(),
        commands,
    );
    ui.separator();
    let measured = !workbench.subject().is_empty();
    item(
        ui,
        workbench,
        "Identify",
        Action::Identify,
        measured,
        commands,
    );
    item(
        ui,
        workbench,
        "Search for what is missing",
        Action::Search,
        measured,
        commands,
    );
    let running = workbench.tasks().newest().is_some();
    item(
        ui,
        workbench,
        "Cancel what is running",
        Action::Cancel,
        running,
        commands,
    );
    ui.separator();
    item(
        ui,
        workbench,
        "Preferences…",
        Action::Preferences,
        true,
        commands,
    );
}

fn view(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(260.0);
    for step in Step::ALL {
        let on = workbench.view().step == step;
        choice(ui, workbench, on, step.name(), Action::Step(step), commands);
    }
    ui.separator();
    for (plane, name) in [
        (Plane::Xy, "Workspace from above"),
        (Plane::Xz, "Workspace from the side"),
        (Plane::Yz, "Workspace from the front"),
    ] {
        let on = workbench.view().plane == plane && !workbench.view().polar();
        choice(ui, workbench, on, name, Action::Look(plane), commands);
    }
    let (on, name) = (workbench.view().polar(), "Deviation around the angle");
    choice(ui, workbench, on, name, Action::LookAround, commands);
    item(
        ui,
        workbench,
        "Show everything in the plots",
        Action::Fit,
        true,
        commands,
    );
    ui.separator();
    let open = shortcuts::room(ui.ctx(), workbench).results();
    item(
        ui,
        workbench,
        results_says(open),
        Action::Results,
        true,
        commands,
    );
    ui.separator();
    let preferences = &workbench.view().preferences;
    let length = match preferences.length {
        LengthUnit::Millimetre => "Lengths in µm",
        LengthUnit::Micrometre => "Lengths in inches",
        LengthUnit::Inch => "Lengths in mm",
    };
    item(ui, workbench, length, Action::NextLength, true, commands);
    let angle = match preferences.angle {
        AngleUnit::Degree => "Angles in radians",
        AngleUnit::Radian => "Angles in degrees",
    };
    item(ui, workbench, angle, Action::NextAngle, true, commands);
    let dark = ui.visuals().dark_mode;
    let other = if dark { "Light" } else { "Dark" };
    item(ui, workbench, other, Action::OtherTheme, true, commands);
    egui::gui_zoom::zoom_menu_buttons(ui);
}

fn choice(
    ui: &mut Ui,
    workbench: &Workbench,
    on: bool,
    text: &str,
    action: Action,
    commands: &mut Vec<Command>,
) {
    let keys = shortcuts::keys(ui.ctx(), action);
    let button = Button::selectable(on, text).shortcut_text(keys);
    if named(ui.add(button), text).clicked() {
        commands.push(shortcuts::command_for(ui.ctx(), action, workbench));
        ui.close();
    }
}

fn help(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    item(
        ui,
        workbench,
        "What the words mean",
        Action::Words,
        true,
        commands,
    );
    item(
        ui,
        workbench,
        "Keyboard shortcuts",
        Action::Keys,
        true,
        commands,
    );
    item(
        ui,
        workbench,
        "About truepose",
        Action::About,
        true,
        commands,
    );
}
