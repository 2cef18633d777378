//! Fields for numbers, with their names.

use egui::{Align, DragValue, Layout, Response, RichText, Ui, vec2};

use crate::gui::style::tokens::{Palette, space};
use crate::gui::units::typed;

/// A field that takes a number when it is complete, with a point or a comma.
fn typing(field: DragValue<'_>) -> DragValue<'_> {
    field.update_while_editing(false).custom_parser(typed)
}

/// A number with its name before it.
pub(crate) fn number(ui: &mut Ui, name: &str, field: DragValue<'_>) -> Response {
    let muted = Palette::of(ui).muted;
    let row = ui.horizontal(|ui| {
        let label = ui.label(RichText::new(name).color(muted));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_sized([96.0, space::CONTROL], typing(field))
                .labelled_by(label.id)
        })
        .inner
    });
    row.inner
}

/// A row in which everything stands at one height, the tallest controls included: what comes before
/// one of them would else stand higher.
pub(crate) fn row<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let usual = ui.spacing().interact_size.y;
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = space::ROW_HEIGHT;
        let row = ui.horizontal(|ui| {
            ui.spacing_mut().interact_size.y = usual;
            contents(ui)
        });
        row.inner
    })
    .inner
}

/// A row of a form on a sheet: its name, as wide as all the others, and what is chosen.
pub(crate) fn form_row(ui: &mut Ui, name: &str, control: impl FnOnce(&mut Ui)) {
    const NAMES: f32 = 136.0;
    let muted = Palette::of(ui).muted;
    row(ui, |ui| {
        let room = vec2(NAMES, space::CONTROL);
        ui.allocate_ui_with_layout(room, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAMES);
            ui.label(RichText::new(name).color(muted));
        });
        control(ui);
    });
}

/// A field for a number as a table has it: no wider than it must be.
pub(crate) fn cell_number(ui: &mut Ui, name: &str, width: f32, field: DragValue<'_>) -> Response {
    let response = ui.add_sized([width, 24.0], typing(field));
    let name = name.to_owned();
    ui.ctx()
        .accesskit_node_builder(response.id, |node| node.set_label(name));
    response
}
