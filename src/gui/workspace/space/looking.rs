//! How the view in space is looked at with mouse and keys.

use egui::{EventFilter, Key, PointerButton, Rect, Response, Ui, Vec2};

use crate::gui::plots::gestures;
use crate::gui::view::{Ball, Camera};

/// What an arrow key turns, points of a drag.
const STEP: f64 = 12.0;
/// What + and − zoom.
const CLOSER: f64 = 1.25;

/// Where the camera is after what mouse and keys did in this frame.
pub(super) fn looked(
    ui: &Ui,
    response: &Response,
    rect: Rect,
    ball: &Ball,
    camera: Camera,
) -> Camera {
    let size = [rect.width(), rect.height()].map(f64::from);
    let mut camera = camera;
    let dragged = response.drag_delta();
    if dragged != Vec2::ZERO {
        let [right, down] = [dragged.x, dragged.y].map(f64::from);
        let shift = ui.input(|i| i.modifiers.shift);
        camera = if response.dragged_by(PointerButton::Primary) && !shift {
            camera.orbited([right, down])
        } else {
            let scale = camera.points_per_mm(ball, size);
            camera.panned([right / scale, -down / scale])
        };
    }
    if response.contains_pointer()
        && let Some(at) = ui.input(|i| i.pointer.hover_pos())
    {
        let closer = f64::from(gestures::closer(ui.ctx()).y)
            * f64::from(ui.input(egui::InputState::zoom_delta));
        if closer != 1.0 {
            let off = at - rect.center();
            let scale = camera.points_per_mm(ball, size);
            camera = camera.zoomed(
                closer,
                [f64::from(off.x) / scale, -f64::from(off.y) / scale],
            );
        }
    }
    if response.has_focus() {
        keep_arrows(ui, response);
        camera = by_keys(ui, camera);
    }
    camera
}

/// The arrow keys turn the view instead of going to the next control.
fn keep_arrows(ui: &Ui, response: &Response) {
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
}

fn by_keys(ui: &Ui, camera: Camera) -> Camera {
    let pressed = |key| ui.input(|i| i.modifiers.is_none() && i.key_pressed(key));
    let turned = |camera: Camera, way: [f64; 2]| camera.orbited(way.map(|v| STEP * v));
    let mut camera = camera;
    for (key, way) in [
        (Key::ArrowLeft, [-1.0, 0.0]),
        (Key::ArrowRight, [1.0, 0.0]),
        (Key::ArrowUp, [0.0, -1.0]),
        (Key::ArrowDown, [0.0, 1.0]),
    ] {
        if pressed(key) {
            camera = turned(camera, way);
        }
    }
    if pressed(Key::Plus) || pressed(Key::Equals) {
        camera = camera.zoomed(CLOSER, [0.0; 2]);
    }
    if pressed(Key::Minus) {
        camera = camera.zoomed(1.0 / CLOSER, [0.0; 2]);
    }
    camera
}
