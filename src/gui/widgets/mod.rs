//! The few controls that egui does not have, in the window's own look; here surfaces, words, the focus, and the grip
//! between two panels.

mod buttons;
mod fields;

pub(crate) use buttons::{
    COPY, DATA, FIT, NEXT, SAVE, bare_button, has_stood, history_button, icon_button, other,
    primary, read_next, secondary, segmented, segmented_named, side_button, width_of_segments,
};
pub(crate) use fields::{
    buttons_or_back, cell_number, choice, choice_row, done, done_beside, entered, form_row, list,
    number, number_in_a_grid, or_none, room_of_a_sheet, row, select_all, sheet_buttons,
    sheet_buttons_without_enter, wide,
};

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::text_edit::TextEditState;
use egui::{
    Align, CollapsingHeader, Color32, CornerRadius, CursorIcon, EventFilter, FontId, Frame, Id,
    Key, Layout, Margin, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    accesskit, vec2,
};

use crate::gui::help::{self, Word};
use crate::gui::style::{DARK, LIGHT, Palette, size, space, strong};
use crate::gui::workbench::Workbench;
use crate::text::{Template, spoken, within};

/// What is done by a press.
pub(crate) trait Does {
    /// Does this once the frame is drawn, where it was pressed.
    fn does(&self, workbench: &Workbench, change: impl FnOnce(&mut Workbench) + Send + 'static);
}

impl Does for Response {
    fn does(&self, workbench: &Workbench, change: impl FnOnce(&mut Workbench) + Send + 'static) {
        if self.clicked() {
            workbench.then(change);
        }
    }
}

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

/// Part of a whole as a bar: before above, after below.
pub(crate) fn share_bar(ui: &mut Ui, part: f32, color: Color32) {
    let palette = Palette::of(ui);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, palette.inset);
    let mut filled = rect;
    filled.set_width(rect.width() * part.clamp(0.0, 1.0));
    painter.rect_filled(filled, 3.0, color);
}

/// Half of the width in which it can be taken hold of, points.
const REACH: f32 = 4.0;
/// What an arrow key moves it by, points.
const BY_KEY: f32 = 16.0;

/// What was done to a grip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Gripped {
    /// It is to be here, in the window's points.
    To(f32),
    /// It was let go, or moved by a key: the size is to be remembered.
    LetGo(f32),
    /// The usual size again.
    Usual,
}

/// A grip on an edge of `panel` that stands upright at `x`, over its whole height and inside it.
pub(crate) fn grip(ui: &Ui, name: &str, panel: Rect, x: f32) -> Option<Gripped> {
    let inwards = (panel.center().x - x).signum();
    let middle = x + inwards * REACH;
    let rect = Rect::from_x_y_ranges(middle - REACH..=middle + REACH, panel.y_range());
    let says = say!("width of {name}", name);
    let id = Id::unique("grip").with(name);
    let gripped = pulled(ui, id, &says, rect, true)?;
    Some(match gripped {
        Gripped::To(at) => Gripped::To(at - inwards * REACH),
        Gripped::LetGo(at) => Gripped::LetGo(at - inwards * REACH),
        Gripped::Usual => Gripped::Usual,
    })
}

/// A grip in the gap between two panes, which stands upright or lies.
pub(crate) fn grip_between(
    ui: &Ui,
    id: Id,
    label: &str,
    gap: Rect,
    upright: bool,
) -> Option<Gripped> {
    let wider = if upright {
        vec2(REACH - 0.5 * gap.width(), 0.0)
    } else {
        vec2(0.0, REACH - 0.5 * gap.height())
    };
    pulled(ui, id, label, gap.expand2(wider), upright)
}

/// A grip in this place: where its middle is to be.
fn pulled(ui: &Ui, id: Id, says: &str, rect: Rect, upright: bool) -> Option<Gripped> {
    let axis = usize::from(!upright);
    let at = rect.center()[axis];
    let response = ui.interact(rect, id, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, says));
    let response = response.on_hover_cursor(if upright {
        CursorIcon::ResizeHorizontal
    } else {
        CursorIcon::ResizeVertical
    });
    let palette = Palette::of(ui);
    let busy = response.hovered() || response.dragged() || response.has_focus();
    let color = if busy {
        palette.accent
    } else {
        palette.nominal
    };
    let painter = ui.painter();
    for k in [-1.0, 0.0, 1.0] {
        let along = if upright {
            vec2(0.0, 6.0 * k)
        } else {
            vec2(6.0 * k, 0.0)
        };
        painter.circle_filled(rect.center() + along, 1.5, color);
    }
    if response.double_clicked() {
        return Some(Gripped::Usual);
    }
    let pointer = response.interact_pointer_pos().map(|at| at[axis]);
    if response.drag_stopped() {
        return Some(Gripped::LetGo(pointer.unwrap_or(at)));
    }
    if response.dragged() {
        return pointer.map(Gripped::To);
    }
    if !response.has_focus() {
        return None;
    }
    let filter = EventFilter {
        horizontal_arrows: upright,
        vertical_arrows: !upright,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let steps = ui.input(|input| {
        let asked = |action| input.num_accesskit_action_requests(response.id, action) as f32;
        let presses = |key| input.num_presses(key) as f32;
        let [more, less] = if upright {
            [Key::ArrowRight, Key::ArrowLeft]
        } else {
            [Key::ArrowDown, Key::ArrowUp]
        };
        presses(more) - presses(less) + asked(accesskit::Action::Increment)
            - asked(accesskit::Action::Decrement)
    });
    (steps != 0.0).then_some(Gripped::LetGo(at + steps * BY_KEY))
}

/// A text on one line, ended by … where it is wider than its room.
pub(crate) fn cut(
    ui: &Ui,
    text: &str,
    font: FontId,
    color: Color32,
    width: f32,
) -> Arc<egui::Galley> {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(width.max(1.0));
    ui.painter().layout_job(job)
}

/// What a panel is about.
pub(crate) fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::HEADING)));
}

/// How wide a text is in one line, points.
pub(crate) fn width_of(ui: &Ui, text: &str, font: egui::FontId) -> f32 {
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    galley.size().x
}

/// What the next group is about.
pub(crate) fn section(ui: &mut Ui, text: &str) {
    ui.add_space(space::ROW);
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).font(strong(size::SMALL)).color(muted));
}

/// The name of something, or what stands out among other words.
pub(crate) fn bold(ui: &mut Ui, text: impl Into<String>) -> Response {
    ui.label(RichText::new(text).font(strong(size::BODY)))
}

/// What stands in the bar of a plot.
pub(crate) fn title(ui: &mut Ui, text: &str) {
    bold(ui, text);
    ui.add_space(space::ROW);
}

/// A word beside a control of such a bar.
pub(crate) fn caption(ui: &mut Ui, text: &str) -> egui::Response {
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).size(size::SMALL).color(muted))
}

/// The sliders of the bars are finer than those of forms.
pub(crate) fn fine(ui: &mut Ui, width: f32) {
    ui.spacing_mut().slider_width = width;
    ui.spacing_mut().interact_size.y = 18.0;
}

/// A sentence that explains.
pub(crate) fn hint(ui: &mut Ui, text: impl Into<String>) {
    let muted = Palette::of(ui).muted;
    sentence(ui, RichText::new(text).size(size::NOTE).color(muted));
}

/// Height of a window that has room for more than what is done, points.
const ROOMY: f32 = 480.0;

/// The same above a button that is always in sight: in a low window the controls of the step need the room.
pub(crate) fn hint_above_the_button(ui: &mut Ui, text: impl Into<String>) {
    if ui.ctx().content_rect().height() >= ROOMY {
        hint(ui, text);
    }
}

/// Text whose lines are no longer than can be read.
fn sentence(ui: &mut Ui, text: RichText) -> Response {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(space::LINE));
        ui.add(egui::Label::new(text).wrap())
    })
    .inner
}

/// What is wrong with the field above.
pub(crate) fn wrong(ui: &mut Ui, text: &str) {
    let color = Palette::of(ui).outside;
    sentence(ui, RichText::new(text).size(size::NOTE).color(color));
}

/// As [`fact`], of a name that is spoken here.
pub(crate) fn fact_of(ui: &mut Ui, name: Template, value: impl Into<String>) {
    fact(ui, spoken(name), value);
}

/// Names a control for those who do not see it.
pub(crate) fn label(response: &Response, name: impl Into<Box<str>>) {
    let name = name.into();
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// What folds away below a small title.
pub(crate) fn folded(ui: &mut Ui, text: &str, size: f32, contents: impl FnOnce(&mut Ui)) {
    let title = RichText::new(text).size(size).color(Palette::of(ui).muted);
    let header = CollapsingHeader::new(title).id_salt(text);
    header.show(ui, contents);
}

/// A name and what it is: on one line, or below each other where that is too narrow.
pub(crate) fn fact(ui: &mut Ui, name: &str, value: impl Into<String>) {
    let palette = Palette::of(ui);
    let value = value.into();
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = |text: &str| width_of(ui, text, font.clone());
    let beside = width(name) + 12.0 + width(&value) <= ui.available_width();
    let label = |ui: &mut Ui| {
        let text = RichText::new(name).color(palette.muted);
        let label = ui.add(egui::Label::new(text).wrap());
        if let Some(word) = help::about(name) {
            explained(label, word);
        }
    };
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 16.0;
        ui.spacing_mut().item_spacing.y = 4.0;
        if beside {
            ui.horizontal(|ui| {
                label(ui);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(value);
                });
            });
        } else {
            ui.spacing_mut().item_spacing.y = 1.0;
            label(ui);
            ui.add(egui::Label::new(value).wrap());
        }
    });
}

/// A number in a column of a grid: its end is where the others end.
pub(crate) fn cell_right(ui: &mut Ui, text: RichText) -> Response {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text))
        .inner
}

/// Says what an effect is when the pointer rests on its name.
pub(crate) fn explained_effect(response: Response, id: &str) -> Response {
    let Some(about) = crate::effects::find(id).map(crate::effects::Effect::about) else {
        return response;
    };
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        bold(ui, crate::present::names::title(id));
        ui.label(spoken(about.cause));
        let usual_size = spoken(about.usual_size);
        hint(ui, say!("usually {usual_size}", usual_size));
        hint(ui, about.equation);
    })
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        bold(ui, word.name());
        ui.label(word.means());
    })
}

/// A question mark that says what a word means.
pub(crate) fn question(ui: &mut Ui, word: Word) {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
    let says = say!("what {word} means", word = within(word.name()));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
    let painter = ui.painter();
    painter.circle_stroke(rect.center(), 6.5, Stroke::new(1.0, palette.nominal));
    let font = egui::FontId::proportional(size::TINY);
    let centre = egui::Align2::CENTER_CENTER;
    painter.text(rect.center(), centre, "?", font, palette.muted);
    explained(response, word);
}

/// Rows of text stand close together; rows of controls need room.
pub(crate) fn dense(ui: &mut Ui) {
    ui.spacing_mut().interact_size.y = 16.0;
    ui.spacing_mut().item_spacing.y = 3.0;
}

/// What is said about what the pointer is on.
pub(crate) fn facts(ui: &mut Ui, (title, lines): &(String, Vec<(String, String)>)) {
    let palette = Palette::of(ui);
    ui.set_max_width(220.0);
    dense(ui);
    bold(ui, title);
    egui::Grid::new("facts")
        .num_columns(2)
        .spacing([16.0, 2.0])
        .show(ui, |ui| {
            for (name, value) in lines {
                ui.label(RichText::new(name).size(size::SMALL).color(palette.muted));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(RichText::new(value).size(size::SMALL));
                });
                ui.end_row();
            }
        });
}
