//! A robot by itself, without a session: at its zero, turned by dragging.

use egui::{Color32, Response, Sense, Stroke, Ui, Vec2};
use nalgebra::Isometry3;

use crate::gui::scene::{self, Projection, Scene, Screen, paint};
use crate::gui::style::tokens::{Palette, space};
use crate::gui::view::{Ball, Camera};
use crate::gui::widgets;
use crate::kinematics::Robot;

use super::super::robot::{Drawn, body};
use super::looking::looked;

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
    let seen_along = Projection::Parallel(camera.facing());
    let seen = scene::Camera::showing(seen_along, camera.bounds(&ball, sides), rect);
    let mut scene = Scene::default();
    body(&mut scene, &drawn, &Isometry3::identity(), &seen, None);
    let mut shapes = Vec::new();
    let mut screen = Screen::new(&painter, &palette, &mut shapes);
    paint(&scene, &seen, &mut screen);
    painter.extend(shapes);
    if response.has_focus() {
        let ring = Stroke::new(1.0, palette.outline);
        let inside = egui::StrokeKind::Inside;
        painter.rect(rect, space::ROUND, Color32::TRANSPARENT, ring, inside);
    }
    response
}
