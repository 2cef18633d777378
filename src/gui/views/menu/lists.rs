//! The other menus: edit, view, help.

use egui::gui_zoom::{kb_shortcuts, zoom_in, zoom_out};
use egui::{Button, Context, Ui};

use crate::gui::actions;
use crate::gui::actions::Action;
use crate::gui::preferences::ZOOM;
use crate::gui::units::{AngleUnit, LengthUnit};
use crate::gui::view::{Plane, Step};

use super::items::{Menu, named, results_says};

pub(super) fn edit(ui: &mut Ui, menu: &mut Menu<'_>) {
    let workbench = menu.workbench;
    ui.set_min_width(240.0);
    let undo = workbench.undoes();
    let redo = workbench.redoes();
    let with = |verb: &str, what: Option<&str>| {
        what.map_or_else(|| verb.to_owned(), |what| format!("{verb} {what}"))
    };
    menu.item(ui, &with("Undo", undo), Action::Undo, undo.is_some());
    menu.item(ui, &with("Redo", redo), Action::Redo, redo.is_some());
    ui.separator();
    let measured = !workbench.subject().is_empty();
    menu.item(ui, "Identify", Action::Identify, measured);
    menu.item(ui, "Run diagnosis", Action::Search, measured);
    let running = workbench.jobs().newest().is_some();
    menu.item(ui, "Cancel what is running", Action::Cancel, running);
    ui.separator();
    menu.item(ui, "Preferences…", Action::Preferences, true);
}

pub(super) fn view(ui: &mut Ui, menu: &mut Menu<'_>) {
    let workbench = menu.workbench;
    ui.set_min_width(260.0);
    for step in Step::ALL {
        let on = workbench.view().step == step;
        menu.choice(ui, on, step.name(), Action::Step(step));
    }
    ui.separator();
    for (plane, name) in [
        (Plane::Xy, "Workspace from above"),
        (Plane::Xz, "Workspace from the side"),
        (Plane::Yz, "Workspace from the front"),
    ] {
        let on = workbench.view().plane == plane && !workbench.view().polar();
        menu.choice(ui, on, name, Action::Look(plane));
    }
    let (on, name) = (workbench.view().polar(), "Deviation around the angle");
    menu.choice(ui, on, name, Action::LookAround);
    menu.item(ui, "Show everything in the plots", Action::Fit, true);
    ui.separator();
    let open = actions::room(ui.ctx(), workbench).results();
    menu.item(ui, results_says(open), Action::Results, true);
    ui.separator();
    let preferences = &workbench.view().preferences;
    let length = match preferences.length {
        LengthUnit::Millimetre => "Lengths in µm",
        LengthUnit::Micrometre => "Lengths in inches",
        LengthUnit::Inch => "Lengths in mm",
    };
    menu.item(ui, length, Action::NextLength, true);
    let angle = match preferences.angle {
        AngleUnit::Degree => "Angles in radians",
        AngleUnit::Radian => "Angles in degrees",
    };
    menu.item(ui, angle, Action::NextAngle, true);
    let dark = ui.visuals().dark_mode;
    let other = if dark { "Light" } else { "Dark" };
    menu.item(ui, other, Action::OtherTheme, true);
    ui.separator();
    let now = ui.ctx().zoom_factor();
    for (text, keys, change, enabled) in [
        (
            "Larger",
            kb_shortcuts::ZOOM_IN,
            zoom_in as fn(&Context),
            now < *ZOOM.end(),
        ),
        (
            "Smaller",
            kb_shortcuts::ZOOM_OUT,
            zoom_out,
            now > *ZOOM.start(),
        ),
        (
            "Usual size",
            kb_shortcuts::ZOOM_RESET,
            |ctx: &Context| ctx.set_zoom_factor(1.0),
            (now - 1.0).abs() > 1e-3,
        ),
    ] {
        let button = Button::new(text).shortcut_text(actions::in_words(ui.ctx(), keys));
        let response = ui.add_enabled(enabled, button);
        if named(response, text).clicked() {
            change(ui.ctx());
            ui.close();
        }
    }
}

pub(super) fn help(ui: &mut Ui, menu: &mut Menu<'_>) {
    ui.set_min_width(240.0);
    menu.item(ui, "Glossary", Action::Words, true);
    menu.item(ui, "Keyboard and mouse", Action::Keys, true);
    menu.item(ui, "About truepose", Action::About, true);
}
