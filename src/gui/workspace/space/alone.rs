//! A robot by itself, without a session: at its zero, turned by dragging.

use egui::{Color32, Response, Sense, Stroke, Ui, Vec2, vec2};
use nalgebra::{Point3, Vector3};

use crate::gui::core::skeleton::Skeleton;
use crate::gui::style::tokens::{Palette, space};
use crate::gui::view::{Ball, Camera};
use crate::gui::widgets;
use crate::kinematics::{JointKind, Robot};

use super::super::robot::{Drawn, Sign, home};
use super::looking::looked;
use super::robot::{Pen, nominal};

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
    let q = home(robot);
    let Some(corners) = Skeleton::new(robot, &Point3::origin()).at(&q) else {
        return response;
    };
    let points: Vec<[f64; 3]> = corners.iter().map(|p| p.coords.into()).collect();
    let mut ball = Ball::around(&points);
    ball.radius_mm *= ROOM;
    *camera = looked(ui, &response, rect, &ball, *camera);
    let facing = camera.facing();
    let sides = [rect.width(), rect.height()].map(f64::from);
    let points_per_mm = camera.points_per_mm(&ball, sides);
    let centre = [0, 1, 2].map(|k| ball.centre_mm[k] + camera.offset_mm[k]);
    let middle = facing.flat(centre);
    #[expect(clippy::cast_possible_truncation, reason = "points of the screen")]
    let screen = |p: Point3<f64>| {
        let at = facing.flat(p.coords.into());
        let off = [at[0] - middle[0], middle[1] - at[1]].map(|v| (v * points_per_mm) as f32);
        rect.center() + vec2(off[0], off[1])
    };
    let motions = robot.motions_from_home(&q);
    let signs = robot.joints.iter().enumerate().map(|(k, joint)| {
        let along = (motions[k].rotation * joint.axis.direction).into_inner();
        Sign {
            at_mm: facing.flat(corners[2 * k + 1].coords.into()),
            along: facing.flat(along.into()),
            axis: along.into(),
            turns: joint.kind == JointKind::Revolute,
        }
    });
    let drawn = Drawn {
        sample: None,
        asked_for: true,
        q: q.clone(),
        nominal_mm: Vec::new(),
        real: None,
        signs: signs.collect(),
        values: Vec::new(),
        corners_mm: corners,
        upright: false,
    };
    let pen = Pen {
        facing: &facing,
        points_per_mm,
        screen,
        palette: &palette,
        base: [Vector3::x(), Vector3::y(), Vector3::z()],
    };
    let mut shapes = Vec::new();
    nominal(&mut shapes, &drawn, &pen, None);
    painter.extend(shapes);
    if response.has_focus() {
        let ring = Stroke::new(1.0, palette.outline);
        let inside = egui::StrokeKind::Inside;
        painter.rect(rect, space::ROUND, Color32::TRANSPARENT, ring, inside);
    }
    response
}
