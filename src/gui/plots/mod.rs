//! What plots are made of: axes, marks, the strip above them, gestures, a chart on the screen. A plot itself is a model (what is shown), a layout (where it goes; both are
//! tested without pixels) and paint (egui)

mod axes;
pub(crate) mod chart;
pub(crate) mod gestures;
pub(crate) mod legend;
pub(crate) mod marks;

pub(crate) use axes::{axis, steps_in};
pub(crate) use marks::{Drawing, disc};

use egui::{Response, Role, Ui, WidgetInfo};

use crate::gui::view::{Plot, What};
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command};

/// Saves a plot as a file.
pub(crate) fn picture(ui: &mut Ui, plot: Plot, commands: &mut Vec<Command>) {
    let says = say!("Save picture of the {plot}…", plot = plot.title());
    if widgets::save_button(ui, &says).clicked() {
        commands.push(Command::Ask(Asked::WhereToExport(What::Picture(plot))));
    }
}

/// Names a chart for those who do not see it, and says what is seen in it.
pub(crate) fn figure(response: &Response, name: &str, says: String) {
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name));
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_description(says));
}
