//! The few controls that egui does not have, in the window's own look; here surfaces, the focus, and how the window is
//! divided.

use egui::text_edit::TextEditState;
use egui::{
    Context, CornerRadius, EventFilter, Frame, Id, Key, Margin, Rect, Stroke, StrokeKind, Ui, Vec2,
};

use crate::gui::style::{DARK, LIGHT, Palette, space};

mod buttons;
mod forms;
mod words;

pub(crate) use buttons::*;
pub(crate) use forms::*;
pub(crate) use words::*;

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

/// The arrow keys are for this control instead of going to the next.
pub(crate) fn keep_arrows(ui: &Ui, id: Id) {
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
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

/// The same, and says what the sheet is.
pub(crate) fn head(ui: &mut Ui, width: f32, title: impl Into<egui::RichText>) {
    wide(ui, width);
    ui.heading(title);
}

/// Whether Enter was pressed, and for no control in particular: it means the button that stands
/// out.
pub(crate) fn entered(ui: &Ui) -> bool {
    let nowhere = ui.memory(|memory| memory.focused().is_none());
    nowhere && ui.input(|input| input.key_pressed(Key::Enter))
}

// How the window is divided at its size: how wide the sides are, and whether the results are in sight. Sizes are points,
// so that a larger size of text is a smaller window. The sides grow moderately with it; the plots get the rest,
// and are never narrower than [`MIDDLE`]: where there is no room for the results beside them the results are shut,
// and when they are opened they take the plots' place.

/// The narrowest that plots are, points.
pub(crate) const MIDDLE: f32 = 380.0;
/// The narrowest that results are, points.
pub(crate) const RIGHT: f32 = 288.0;
/// The narrowest that steps are, points.
pub(crate) const LEFT: f32 = 260.0;
/// The widest that either can be pulled, points.
pub(crate) const WIDEST: f32 = 720.0;
/// From this width on results are shown beside the plots unless they are shut, points.
const BESIDE: f32 = 980.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layout {
    /// Width of the steps and their controls.
    pub(crate) left: f32,
    /// Width of the results, where they are shown beside the plots.
    pub(crate) right: Option<f32>,
    /// Whether the results take the place of the plots.
    pub(crate) instead: bool,
}

impl Layout {
    /// In a window of this size; `wanted` is whether the results are opened or shut by hand.
    pub(crate) fn of(width: f32, wanted: Option<bool>) -> Self {
        // In steps, so that what was pulled holds while the window is pulled a little.
        let (left, right) = match width {
            ..1100.0 => (280.0, RIGHT),
            ..1600.0 => (304.0, 344.0),
            ..2560.0 => (344.0, 420.0),
            _ => (440.0, 560.0),
        };
        let open = wanted.unwrap_or(width >= BESIDE);
        let beside = width - left - MIDDLE >= right;
        Self {
            left,
            right: (open && beside).then_some(right),
            instead: open && !beside,
        }
    }

    /// Whether the results are in sight.
    pub(crate) fn results(&self) -> bool {
        self.right.is_some() || self.instead
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_never_shrink_as_the_window_grows_and_the_plots_grow_with_it() {
        let mut last = Layout::of(600.0, None);
        for width in (600..4000).step_by(7) {
            let width = width as f32;
            let room = Layout::of(width, None);
            assert!(
                room.left >= last.left && room.right >= last.right,
                "{width}"
            );
            let middle = width - room.left - room.right.unwrap_or(0.0);
            assert!(
                room.instead || width < 700.0 || middle >= MIDDLE,
                "{width}: {middle}"
            );
            if width >= 1280.0 {
                assert!(middle >= 0.48 * width, "{width}: {middle}");
            }
            last = room;
        }
    }

    #[test]
    fn results_that_have_no_room_beside_the_plots_can_be_opened_in_their_place() {
        let narrow = |wanted| Layout::of(683.0, wanted);
        assert!(!narrow(None).results());
        assert!(narrow(Some(true)).instead && narrow(Some(true)).right.is_none());
        assert!(Layout::of(960.0, Some(true)).right.is_some());
        assert!(!Layout::of(1920.0, Some(false)).results());
        assert!(Layout::of(1024.0, None).right.is_some());
    }
}
