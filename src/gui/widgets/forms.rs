//! What forms are made of: rows, choices, and fields for numbers and text with their names.

use std::cell::RefCell;
use std::rc::Rc;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align, Align2, ComboBox, DragValue, Id, Key, Layout, Response, TextEdit, Tooltip, Ui, Vec2,
    Widget, vec2,
};

use crate::gui::style::space;
use crate::gui::widgets::buttons::Buttons;
use crate::gui::widgets::words::{Words, label};
use crate::present::units::typed_in;

/// What forms have beside egui's own controls.
pub(crate) trait Forms {
    /// A control that is called by this name for those who do not see it.
    fn named(&mut self, name: impl Into<Box<str>>, control: impl Widget) -> Response;
    /// A row in which everything stands at one height, the tallest controls included: what comes before
    /// one of them would else stand higher.
    fn row<R>(&mut self, contents: impl FnOnce(&mut Ui) -> R) -> R;
    /// A row of a form on a sheet: its name, as wide as all the others, and what is chosen.
    fn form_row(&mut self, name: &str, control: impl FnOnce(&mut Ui));
    /// One of some values, side by side.
    fn choice<T: Copy + PartialEq>(&mut self, offered: &[(T, &str)], value: &mut T);
    /// The same in a row of a form.
    fn choice_row<T: Copy + PartialEq>(&mut self, name: &str, offered: &[(T, &str)], value: &mut T);
    /// A number with its name before it, in this unit; another of its quantity may be typed.
    fn number(&mut self, name: &str, unit: &str, field: DragValue<'_>) -> Response;
    /// The same in two cells of a grid.
    fn number_in_a_grid(&mut self, name: &str, unit: &str, field: DragValue<'_>) -> Response;
    /// The same as a table has it: no wider than it must be.
    fn cell_number(&mut self, name: &str, unit: &str, width: f32, field: DragValue<'_>)
    -> Response;
}

impl Forms for Ui {
    fn named(&mut self, name: impl Into<Box<str>>, control: impl Widget) -> Response {
        let response = self.add(control);
        label(&response, name);
        response
    }

    fn row<R>(&mut self, contents: impl FnOnce(&mut Ui) -> R) -> R {
        let usual = self.spacing().interact_size.y;
        let scope = self.scope(|ui| {
            ui.spacing_mut().interact_size.y = space::ROW_HEIGHT;
            let row = ui.horizontal(|ui| {
                ui.spacing_mut().interact_size.y = usual;
                contents(ui)
            });
            row.inner
        });
        scope.inner
    }

    fn form_row(&mut self, name: &str, control: impl FnOnce(&mut Ui)) {
        const NAMES: f32 = 136.0;
        self.row(|ui| {
            let room = vec2(NAMES, space::CONTROL);
            ui.allocate_ui_with_layout(room, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(NAMES);
                ui.weak(name);
            });
            control(ui);
        });
    }

    fn choice<T: Copy + PartialEq>(&mut self, offered: &[(T, &str)], value: &mut T) {
        *value = self.segmented(offered, *value).unwrap_or(*value);
    }

    fn choice_row<T: Copy + PartialEq>(
        &mut self,
        name: &str,
        offered: &[(T, &str)],
        value: &mut T,
    ) {
        self.form_row(name, |ui| ui.choice(offered, value));
    }

    fn number(&mut self, name: &str, unit: &str, field: DragValue<'_>) -> Response {
        let row = self.horizontal(|ui| {
            let label = ui.weak(name);
            let right = Layout::right_to_left(Align::Center);
            ui.with_layout(right, |ui| {
                typing(ui, FIELD, unit, field).labelled_by(label.id)
            })
        });
        row.inner.inner
    }

    fn number_in_a_grid(&mut self, name: &str, unit: &str, field: DragValue<'_>) -> Response {
        let label = self.weak(name);
        typing(self, FIELD, unit, field).labelled_by(label.id)
    }

    fn cell_number(
        &mut self,
        name: &str,
        unit: &str,
        width: f32,
        field: DragValue<'_>,
    ) -> Response {
        // As high as such a field is at least: in less it would hang out of its row.
        let high = self.spacing().interact_size.y;
        let response = typing(self, [width, high], unit, field);
        label(&response, name);
        response
    }
}

/// Width and height of a field for a number.
const FIELD: [f32; 2] = [96.0, space::CONTROL];

/// Behind the unit of a number that may be absent: "none" is 0.
pub(crate) fn or_none() -> &'static str {
    say!(in "unit", ", or none")
}

/// So long it is said, seconds.
const SAID_S: f64 = 10.0;

/// A field that takes a number when it is complete, with a point or a comma, and converts its unit.
/// What is no number is refused aloud, and the value kept.
fn typing(ui: &mut Ui, size: [f32; 2], unit: &str, field: DragValue<'_>) -> Response {
    let refused: Rc<RefCell<Option<String>>> = Rc::default();
    let said = Rc::clone(&refused);
    let (own, none) = match unit.strip_suffix(or_none()) {
        Some(own) => (own.to_owned(), Some(say!("none"))),
        None => (unit.to_owned(), None),
    };
    let parse = move |text: &str| match typed_in(text, &own, &own) {
        Ok(value) => Some(value),
        Err(_) if none == Some(text.trim()) => Some(0.0),
        Err(because) => {
            *said.borrow_mut() = Some(because);
            None
        }
    };
    let field = field.update_while_editing(false).custom_parser(parse);
    let response = ui.add_sized(size, field);
    let (ctx, id) = (ui.ctx(), response.id.with("refused"));
    let now = ctx.input(|i| i.time);
    if let Some(because) = refused.take() {
        ctx.data_mut(|data| data.insert_temp(id, (because, now)));
    }
    let Some((because, since)) = ctx.data(|data| data.get_temp::<(String, f64)>(id)) else {
        return response;
    };
    let left = since + SAID_S - now;
    if response.has_focus() || response.changed() || left <= 0.0 {
        ctx.data_mut(|data| data.remove_temp::<(String, f64)>(id));
        return response;
    }
    ctx.request_repaint_after(std::time::Duration::from_secs_f64(left));
    let tip = Tooltip::always_open(ctx.clone(), ui.layer_id(), id, response.rect);
    tip.show(|ui| {
        ui.set_max_width(space::TIP);
        ui.wrong(&say!("{because}; the value is kept", because));
    });
    response
}

/// Marks what stands in a line of text: what is typed next takes its place.
pub(crate) fn select_all(ui: &Ui, field: Id, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), field).unwrap_or_default();
    let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), field);
}

/// A line of text by this name. What was typed, once it is complete and another: one step back takes the whole of it
/// back. Escape leaves it as it was.
pub(crate) fn text_when_complete(ui: &mut Ui, name: &str, now: &str, size: Vec2) -> Option<String> {
    let id = ui.scope_id().with(("text", name));
    let mut typed: String = ui
        .data(|data| data.get_temp(id))
        .unwrap_or_else(|| now.to_owned());
    let field = TextEdit::singleline(&mut typed).id(id);
    let field = field.align(Align2::LEFT_CENTER).clip_text(true);
    let field = ui.add_sized(size, field);
    label(&field, name);
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, typed));
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    (field.lost_focus() && typed != now && !escaped).then_some(typed)
}

/// A list that is opened to choose from, by this name. What was chosen, be it what is chosen already.
pub(crate) fn list<T: Copy + PartialEq, N: AsRef<str>>(
    ui: &mut Ui,
    name: impl Into<Box<str>>,
    list: ComboBox<'_>,
    offered: impl IntoIterator<Item = (T, N)>,
    current: T,
) -> Option<T> {
    let mut chosen = None;
    let list = list.show_ui(ui, |ui| {
        for (one, name) in offered {
            let row = ui.selectable_label(one == current, name.as_ref());
            if row.clicked() {
                chosen = Some(one);
            }
        }
    });
    label(&list.response, name);
    chosen
}

/// Such numbers beside each other, each called by their name and its part.
pub(crate) fn numbers(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    parts: &[&str],
    values: &mut [f64],
    (width, speed): (f32, f64),
) {
    for (part, value) in parts.iter().zip(values) {
        let field = DragValue::new(value).speed(speed).max_decimals(6);
        let name = format!("{name} {part}");
        ui.cell_number(name.trim_end(), unit, width, field);
    }
}
