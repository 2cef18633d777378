//! How the view in space is looked at with mouse and keys, and a robot that is looked at so without a
//! session: at its zero, turned by dragging.

use egui::{Color32, EventFilter, Key, PointerButton, Rect, Response, Sense, Stroke, Ui, Vec2};
use nalgebra::Isometry3;

use crate::gui::plots::gestures;
use crate::gui::scene::screen::Screen;
use crate::gui::scene::{self, Scene};
use crate::gui::style::{Palette, space};
use crate::gui::view::{Ball, Camera};
use crate::gui::widgets;
use crate::kinematics::Robot;

use super::super::robot::Drawn;
use super::super::robot::body::body;

/// Room around the robot, a part of its ball.
const ROOM: f64 = 1.12;

/// Draws a robot in a field of this size, seen from where the camera is; `name` says what it shows.
pub(crate) fn robot_alone(
    ui: &mut Ui,
    (robot, name): (&Robot, &str),
    camera: &mut Camera,
    size: Vec2,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    widgets::label(&response, name);
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, space::ROUND, palette.inset);
    let Some(drawn) = Drawn::alone(robot) else {
        return response;
    };
    let points: Vec<[f64; 3]> = drawn.corners_mm.iter().map(|p| p.coords.into()).collect();
    let mut ball = Ball::around(&points);
    ball.radius_mm *= ROOM;
    *camera = looked(ui, &response, rect, &ball, *camera);
    let sides = [rect.width(), rect.height()].map(f64::from);
    let facing = camera.facing();
    let seen = scene::paint::Camera::showing(facing, camera.bounds(&ball, sides), rect);
    let mut scene = Scene::default();
    body(&mut scene, &drawn, &Isometry3::identity(), &seen);
    let mut shapes = Vec::new();
    Screen::new(&painter, &palette, &mut shapes).draw(&scene.items, &seen);
    painter.extend(shapes);
    if response.has_focus() {
        let ring = Stroke::new(1.0, palette.outline);
        let inside = egui::StrokeKind::Inside;
        painter.rect(rect, space::ROUND, Color32::TRANSPARENT, ring, inside);
    }
    response
}

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
