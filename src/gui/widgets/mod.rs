//! The few controls that egui does not have, in the window's own look; here surfaces, the focus, and the grip between
//! two panels.

use std::cell::RefCell;
use std::rc::Rc;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align, Align2, ComboBox, Context, CornerRadius, DragValue, EventFilter, Frame, Id, Key, Layout,
    Margin, Rect, Response, RichText, Stroke, StrokeKind, TextEdit, Tooltip, Ui, Vec2, vec2,
};

use crate::gui::style::{DARK, LIGHT, Palette, space};
use crate::gui::view::Sheet;
use crate::gui::workbench::Workbench;
use crate::present::units::typed_in;

mod buttons;
pub(crate) use buttons::*;

/// What is longer than its panel: it fades where it goes on, and its bar stands in the panel's
/// margin, so that edges keep their line with or without it.
pub(crate) fn scroll(
    ui: &mut Ui,
    salt: impl std::hash::Hash + std::fmt::Debug,
    contents: impl FnOnce(&mut Ui),
) {
    let room = ui.available_rect_before_wrap();
    let with_bar = room.with_max_x(room.right() + space::GUTTER);
    // The panel is not to grow by the bar in its margin.
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(with_bar));
    egui::ScrollArea::vertical()
        .id_salt(salt)
        .auto_shrink([false, false])
        .show(&mut inside, |ui| {
            ui.set_width(room.width().min(ui.available_width()));
            contents(ui);
            focus_in_sight(ui);
        });
    ui.advance_cursor_after_rect(room);
}

/// A surface of its own.
pub(crate) fn card<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let palette = Palette::of(ui);
    let frame = Frame::NONE
        .fill(palette.surface)
        .stroke(Stroke::new(1.0, palette.line))
        .corner_radius(CornerRadius::same(space::ROUND + 2))
        .inner_margin(Margin::same(space::CARD));
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        contents(ui)
    });
    shown.inner
}

/// Where the focus was in the pass before.
fn focus_before() -> Id {
    Id::unique("where the focus was")
}

/// Called behind everything that scrolls: what of it has got the focus comes into sight.
pub(crate) fn focus_in_sight(ui: &Ui) {
    /// Beyond what fades at the edge.
    const BEYOND: f32 = 14.0;
    let ctx = ui.ctx();
    let Some(focused) = ctx.memory(egui::Memory::focused) else {
        return;
    };
    if ctx.data(|data| data.get_temp(focus_before())) == Some(focused) {
        return;
    }
    let Some(response) = ctx.read_response(focused) else {
        return;
    };
    // A control that is fully visible outside of this area is not among its contents, which may extend below it.
    let seen = response.interact_rect;
    let here = !seen.is_positive() || ui.clip_rect().expand(1.0).contains_rect(seen);
    let within = ui.min_rect().expand(1.0).contains_rect(response.rect);
    if here && within && response.layer_id == ui.layer_id() {
        ui.scroll_to_rect(response.rect.expand(BEYOND), None);
    }
}

/// Whether the focus was in a field of text until now: Escape has taken it away by the time that it is read.
pub(crate) fn was_typed_into(ctx: &egui::Context) -> bool {
    let before = ctx.data(|data| data.get_temp(focus_before()));
    before.is_some_and(|id| TextEditState::load(ctx, id).is_some())
}

/// A ring around whatever has the keyboard, in the layer that it is in.
pub(crate) fn focus_ring(ctx: &egui::Context) {
    let focused = ctx.memory(egui::Memory::focused);
    ctx.data_mut(|data| match focused {
        Some(focused) => {
            data.insert_temp(focus_before(), focused);
        }
        None => data.remove::<Id>(focus_before()),
    });
    let Some(response) = focused.and_then(|id| ctx.read_response(id)) else {
        return;
    };
    let palette = if ctx.global_style().visuals.dark_mode {
        DARK
    } else {
        LIGHT
    };
    // What is scrolled out of sight has no ring.
    let seen = response.interact_rect.expand(2.0 * space::RING);
    let painter = ctx.layer_painter(response.layer_id).with_clip_rect(seen);
    let round = CornerRadius::same(space::ROUND + 1);
    let ring = Stroke::new(space::RING, palette.accent);
    painter.rect_stroke(response.rect, round, ring, StrokeKind::Outside);
}

/// What runs in the background tells how far it is and wakes the window for it.
pub(crate) fn look_again_soon(ui: &Ui) {
    ui.ctx()
        .request_repaint_after(std::time::Duration::from_millis(100));
}

/// The arrow keys, those across and those up and down, are for this control instead of going to the next.
pub(crate) fn keep_arrows(ui: &Ui, id: Id, [horizontal_arrows, vertical_arrows]: [bool; 2]) {
    let filter = EventFilter {
        horizontal_arrows,
        vertical_arrows,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
}

/// Notes where something is. Others were laid out by where it was in the frame before: if it has moved, the frame is laid out
/// again before it is seen ([`lay_out_again`]).
pub(crate) fn settle(ui: &Ui, id: Id, rect: Rect) {
    let id = id.with("settled");
    if ui.data(|data| data.get_temp(id)) != Some(rect) {
        ui.data_mut(|data| {
            data.insert_temp(id, rect);
            data.insert_temp(something_moved(), true);
        });
    }
}

fn something_moved() -> Id {
    Id::unique("something moved")
}

/// Asks for the frame to be laid out again where something has moved in it. Behind all panels: what is drawn in a pass that
/// is known to be discarded is not measured.
pub(crate) fn lay_out_again(ctx: &Context) {
    if ctx.data_mut(|data| data.remove_temp::<bool>(something_moved())) == Some(true) {
        ctx.request_discard("something moved");
        ctx.request_repaint();
    }
}

// What forms are made of: fields for numbers with their names, rows, and how sheets end: their buttons, and Enter.

/// What was typed into a field and refused, and why.
#[derive(Clone, Default)]
struct Refused {
    because: String,
    /// When, in the window's seconds.
    since: f64,
}

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
        let since = now;
        ctx.data_mut(|data| data.insert_temp(id, Refused { because, since }));
    }
    let Some(refused) = ctx.data(|data| data.get_temp::<Refused>(id)) else {
        return response;
    };
    let left = refused.since + SAID_S - now;
    if response.has_focus() || response.changed() || left <= 0.0 {
        ctx.data_mut(|data| data.remove_temp::<Refused>(id));
        return response;
    }
    ctx.request_repaint_after(std::time::Duration::from_secs_f64(left));
    let tip = Tooltip::always_open(ctx.clone(), ui.layer_id(), id, response.rect);
    tip.show(|ui| {
        ui.set_max_width(space::TIP);
        wrong(
            ui,
            &say!("{because}; the value is kept", because = refused.because),
        );
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

/// A number with its name before it, in this unit; another of its quantity may be typed.
pub(crate) fn number(ui: &mut Ui, name: &str, unit: &str, field: DragValue<'_>) -> Response {
    let muted = Palette::of(ui).muted;
    let row = ui.horizontal(|ui| {
        let label = ui.label(RichText::new(name).color(muted));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            typing(ui, [96.0, space::CONTROL], unit, field).labelled_by(label.id)
        })
        .inner
    });
    row.inner
}

/// The same in two cells of a grid.
pub(crate) fn number_in_a_grid(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    field: DragValue<'_>,
) -> Response {
    let label = ui.label(RichText::new(name).color(Palette::of(ui).muted));
    typing(ui, [96.0, space::CONTROL], unit, field).labelled_by(label.id)
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

/// A choice in a row of a form.
pub(crate) fn choice_row<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    offered: &[(T, &str)],
    value: &mut T,
) {
    form_row(ui, name, |ui| choice(ui, offered, value));
}

/// One of some values, side by side.
pub(crate) fn choice<T: Copy + PartialEq>(ui: &mut Ui, offered: &[(T, &str)], value: &mut T) {
    *value = segmented(ui, offered, *value).unwrap_or(*value);
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

/// A field for a number as a table has it: no wider than it must be.
pub(crate) fn cell_number(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    width: f32,
    field: DragValue<'_>,
) -> Response {
    // As high as such a field is at least: in less it would hang out of its row.
    let high = ui.spacing().interact_size.y;
    let response = typing(ui, [width, high], unit, field);
    label(&response, name);
    response
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
        cell_number(ui, name.trim_end(), unit, width, field);
    }
}

/// The room that the window has for what a sheet says.
pub(crate) fn room_of_a_sheet(ui: &Ui) -> Vec2 {
    /// Between a sheet and the window's edges, together, points.
    const MARGIN: f32 = 12.0;
    ui.ctx().content_rect().size() - Vec2::splat(2.0 * f32::from(space::SHEET) + MARGIN)
}

/// Makes a sheet as wide as this, or as the window has room for.
pub(crate) fn wide(ui: &mut Ui, width: f32) {
    ui.set_width(width.min(room_of_a_sheet(ui).x));
}

/// The buttons at the end of a sheet. Whether the first was pressed.
pub(crate) fn sheet_buttons(ui: &mut Ui, text: &str, enabled: bool, workbench: &Workbench) -> bool {
    let pressed = sheet_buttons_without_enter(ui, text, enabled, workbench);
    pressed || (enabled && entered(ui))
}

/// The same where Enter only ends what is typed into one of many fields.
pub(crate) fn sheet_buttons_without_enter(
    ui: &mut Ui,
    text: &str,
    enabled: bool,
    workbench: &Workbench,
) -> bool {
    buttons_or_back(ui, text, enabled, None, workbench)
}

/// The same where *Cancel* goes back to the sheet that this one was opened from.
pub(crate) fn buttons_or_back(
    ui: &mut Ui,
    text: &str,
    enabled: bool,
    back: Option<Sheet>,
    workbench: &Workbench,
) -> bool {
    ui.add_space(space::ROW);
    ui.columns(2, |columns| {
        other(&mut columns[0], say!("Cancel")).does(workbench, move |bench| bench.show_sheet(back));
        let button = columns[1].add_enabled_ui(enabled, |ui| primary(ui, text));
        button.inner.clicked()
    })
}

/// The button at the end of a sheet that only says something.
pub(crate) fn done(ui: &mut Ui, workbench: &Workbench) {
    ui.add_space(space::ROW);
    if primary(ui, say!("Done")).clicked() || entered(ui) {
        workbench.then(move |bench| bench.show_sheet(None));
    }
}

/// The same with another button beside it. Whether that was pressed.
pub(crate) fn done_beside(ui: &mut Ui, text: &str, enabled: bool, workbench: &Workbench) -> bool {
    ui.add_space(space::ROW);
    ui.columns(2, |columns| {
        let beside = columns[0].add_enabled_ui(enabled, |ui| other(ui, text));
        if primary(&mut columns[1], say!("Done")).clicked() || entered(&columns[1]) {
            workbench.then(move |bench| bench.show_sheet(None));
        }
        beside.inner.clicked()
    })
}

/// Whether Enter was pressed, and for no control in particular: it means the button that stands
/// out.
pub(crate) fn entered(ui: &Ui) -> bool {
    let nowhere = ui.memory(|memory| memory.focused().is_none());
    nowhere && ui.input(|input| input.key_pressed(Key::Enter))
}
