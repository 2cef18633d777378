//! The other menus: edit, view, help.

use egui::gui_zoom::{kb_shortcuts, zoom_in, zoom_out};
use egui::{Button, Context, Ui};

use crate::gui::actions;
use crate::gui::preferences::ZOOM;

use super::items::{Menu, named};

pub(super) fn edit(ui: &mut Ui, menu: &mut Menu<'_>) {
    ui.set_min_width(240.0);
    menu.items(ui, &[actions::UNDO, actions::REDO]);
    ui.separator();
    menu.items(ui, &[actions::EXCLUDE]);
    ui.separator();
    menu.items(ui, &[actions::IDENTIFY, actions::SEARCH, actions::CANCEL]);
    ui.separator();
    menu.items(ui, &[actions::PALETTE, actions::PREFERENCES]);
}

pub(super) fn view(ui: &mut Ui, menu: &mut Menu<'_>) {
    use actions::{
        CHART_BELOW, CHART_BESIDE, CLOSE_CHART, FIT, FROM_FRONT, FROM_ISOMETRIC, FROM_SIDE,
        FROM_TOP, LOOK_AROUND, LOOK_IN_SPACE, LOOK_XY, LOOK_XZ, LOOK_YZ, NEXT_ANGLE, NEXT_LENGTH,
        NEXT_PLOT, OTHER_THEME, RESULTS, USUAL_PLOTS,
    };
    ui.set_min_width(260.0);
    menu.items(ui, &actions::STEPS[..menu.workbench.steps().len()]);
    ui.separator();
    menu.items(ui, &[LOOK_XY, LOOK_XZ, LOOK_YZ, LOOK_AROUND, LOOK_IN_SPACE]);
    // In a list of their own: a longer menu would not fit below its header.
    ui.menu_button(say!("Standard 3-D views"), |ui| {
        ui.set_min_width(220.0);
        menu.items(ui, &[FROM_ISOMETRIC, FROM_FRONT, FROM_SIDE, FROM_TOP]);
    });
    ui.menu_button(say!("Charts"), |ui| {
        ui.set_min_width(220.0);
        menu.items(ui, &[CHART_BESIDE, CHART_BELOW, CLOSE_CHART]);
        ui.separator();
        menu.items(ui, &[NEXT_PLOT, USUAL_PLOTS]);
    });
    menu.items(ui, &[FIT]);
    ui.separator();
    menu.items(ui, &[RESULTS]);
    ui.separator();
    menu.items(ui, &[NEXT_LENGTH, NEXT_ANGLE, OTHER_THEME]);
    ui.separator();
    let now = ui.ctx().zoom_factor();
    for (text, keys, change, enabled) in [
        (
            say!("Larger"),
            kb_shortcuts::ZOOM_IN,
            zoom_in as fn(&Context),
            now < *ZOOM.end(),
        ),
        (
            say!("Smaller"),
            kb_shortcuts::ZOOM_OUT,
            zoom_out,
            now > *ZOOM.start(),
        ),
        (
            say!("Reset zoom"),
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
    menu.items(ui, &[actions::WORDS, actions::KEYS, actions::ABOUT]);
}
