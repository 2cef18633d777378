//! The grip between two panels: dragged, or moved by the arrow keys; a double click gives the usual
//! size back.

use egui::{CursorIcon, EventFilter, Id, Key, Rect, Role, Sense, Ui, WidgetInfo, accesskit, vec2};

use crate::gui::style::tokens::Palette;

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
    let says = say!("width of {name}", name = name);
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
