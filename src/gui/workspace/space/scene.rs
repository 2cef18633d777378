//! What the view in space shows, as a scene: what a plane shows, and beneath it what gives it its
//! bearings, a grid on the plane z = 0 of the base, and frames.

use egui::{Align2, Rect, pos2};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use crate::gui::core::scale::round_down;
use crate::gui::scene::{self, ColourToken, Form, Item, Label, Mark, Place, Scene, Stroke};
use crate::gui::view::Ball;
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;

use super::super::model::{Shown, ball};
use super::super::robot::{Drawn, body};
use super::super::scene::{emphasised, path, samples};

/// Squares of the grid from its middle to its edge, at least.
const SQUARES: f64 = 4.0;
/// Length of a frame's axis, points.
const AXIS: f64 = 34.0;

/// Where everything is in a picture.
pub(super) struct Space {
    pub(super) camera: scene::paint::Camera,
    /// The base in the measuring frame.
    pub(super) base: Isometry3<f64>,
    pub(super) ball: Ball,
}

impl Space {
    /// In a plot here.
    pub(super) fn new(workbench: &Workbench, rect: Rect) -> Self {
        let size = [rect.width(), rect.height()].map(f64::from);
        let ball = ball(workbench);
        let mut bounds = workbench.view.camera.bounds(&ball, size);
        // The scene's coordinates are those of the measuring frame.
        let (facing, base) = (workbench.facing(), workbench.base());
        let shift = facing.flat(base.translation.vector.into());
        for end in &mut bounds {
            *end = [0, 1].map(|k| end[k] + shift[k]);
        }
        Self {
            camera: scene::paint::Camera::showing(facing, bounds, rect),
            base,
            ball,
        }
    }

    /// A point of the base frame in the measuring frame.
    pub(super) fn of_base(&self, p: [f64; 3]) -> [f64; 3] {
        (self.base * Point3::from(p)).into()
    }
}

/// Grid, robot, samples and frames.
pub(super) fn scene(
    workbench: &Workbench,
    shown: &Shown,
    robot: Option<&Drawn>,
    space: &Space,
) -> Scene {
    let mut scene = Scene::default();
    let camera = &space.camera;
    grid(&mut scene, workbench, space);
    path(&mut scene, shown);
    if let Some(robot) = robot {
        body::body(&mut scene, robot, &space.base, camera);
    }
    samples(&mut scene, workbench, shown, camera);
    proposed(&mut scene, workbench, space);
    emphasised(&mut scene, workbench, shown);
    frames(&mut scene, workbench, robot, space);
    side_of_squares(&mut scene, workbench, shown, space);
    scene
}

/// Side of a square of the grid, mm: round in the unit of which `per_mm` are a millimetre, and so that there are a few
/// of them.
fn square_mm(ball: &Ball, per_mm: f64) -> f64 {
    round_down(per_mm * ball.radius_mm / SQUARES) / per_mm
}

/// The grid under everything, in whole squares of the base frame: pairs of ends, mm.
fn lines(ball: &Ball, per_mm: f64) -> Vec<[[f64; 3]; 2]> {
    let square = square_mm(ball, per_mm);
    let ends = [0, 1].map(|k| {
        let reach = |sign: f64| (ball.centre_mm[k] + sign * ball.radius_mm) / square;
        [reach(-1.0).floor() * square, reach(1.0).ceil() * square]
    });
    let mut lines = Vec::new();
    for along in 0..2 {
        let [from, to] = ends[along];
        let [first, last] = ends[1 - along];
        let count = crate::numeric::whole((last - first) / square + 0.5);
        for n in 0..=count {
            let across = first + n as f64 * square;
            let at = |t: f64| {
                let mut p = [0.0; 3];
                p[along] = t;
                p[1 - along] = across;
                p
            };
            lines.push([at(from), at(to)]);
        }
    }
    lines
}

fn grid(scene: &mut Scene, workbench: &Workbench, space: &Space) {
    let per_mm = workbench.units().length_value(1.0);
    for ends in lines(&space.ball, per_mm) {
        let through_origin = ends.iter().all(|p| p[0] == 0.0) || ends.iter().all(|p| p[1] == 0.0);
        let token = if through_origin {
            ColourToken::Axis
        } else {
            ColourToken::Line
        };
        scene.line(ends.map(|p| space.of_base(p)), Stroke::new(1.0, token));
    }
}

/// How long the side of a square is, in the corner.
fn side_of_squares(scene: &mut Scene, workbench: &Workbench, shown: &Shown, space: &Space) {
    let units = workbench.units();
    let square = trimmed(
        units.length_value(square_mm(&space.ball, units.length_value(1.0))),
        3,
    );
    let says = say!("grid {square} {unit}", square, unit = units.length_name());
    let camera = &space.camera;
    let corner = camera
        .transform()
        .value_from_position(camera.frame().left_bottom());
    let corner = shown.look.facing.raised([corner.x, corner.y]);
    scene.label(Label {
        anchor: Align2::LEFT_BOTTOM,
        ..Label::new(
            Place::from(corner).shifted(4.0, -4.0),
            says,
            ColourToken::Muted,
        )
    });
}

/// Poses that a diagnosis proposes to measure: open diamonds where the target would be.
fn proposed(scene: &mut Scene, workbench: &Workbench, space: &Space) {
    let session = &workbench.loaded_session().session;
    let poses = workbench.diagnosis().map_or(&[][..], |d| &d.next_poses);
    for pose in poses
        .iter()
        .filter(|p| p.q.len() == session.robot.joint_count())
    {
        let named = |name: &String| session.targets.iter().find(|t| t.name == *name);
        let known = pose
            .target
            .as_ref()
            .and_then(named)
            .or(session.targets.first());
        let target = match pose.target_mm {
            Some(at) => Point3::from(at),
            None => known.map_or_else(Point3::origin, |t| t.position_mm),
        };
        let at = session.robot.point_in_base(&pose.q, &target);
        let at = space.of_base(at.into());
        let edge = Stroke::new(1.5, ColourToken::Accent);
        scene.mark(Mark::ring(at, Form::Diamond, 5.0, edge));
    }
}

/// The frames of base, tool and instrument.
fn frames(scene: &mut Scene, workbench: &Workbench, robot: Option<&Drawn>, space: &Space) {
    frame(scene, say!("base"), space.base, space);
    let session = &workbench.loaded_session().session;
    if let Some(robot) = robot.filter(|r| r.asked_for) {
        let tool = space.base * session.robot.base_from_tool(&robot.q);
        frame(scene, say!("tool"), tool, space);
    }
    let instrument = &session.instrument;
    let own_frame = workbench.found_base().or(workbench.loaded_session().base);
    let stands = instrument.tracker.map(|tracker| tracker.position_mm.coords);
    if let Some(at) = stands.or(own_frame.map(|_| Vector3::zeros())) {
        // A tracker that stands aside is seen from farther away.
        let at = Isometry3::from_parts(at.into(), UnitQuaternion::identity());
        frame(scene, &instrument.name, at, space);
    }
}

/// A frame with its axes' letters and its name; an axis that is looked along has none.
fn frame(scene: &mut Scene, name: &str, frame: Isometry3<f64>, space: &Space) {
    let camera = &space.camera;
    let origin: [f64; 3] = frame.translation.vector.into();
    let from = camera.at(origin);
    let mut below = from.y;
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    for (axis, letter) in axes.into_iter().zip(["x", "y", "z"]) {
        let along = frame.rotation * axis;
        if camera.direction(along.into()).length() < 0.2 {
            continue;
        }
        let end = |points: f64| {
            let end = frame.translation.vector + along * (points / camera.points_per_mm());
            <[f64; 3]>::from(end)
        };
        let ends = [origin, end(AXIS)].map(Place::from);
        let arrow = Item::Vector(ends, Stroke::new(1.5, ColourToken::Text));
        scene.items.push(arrow);
        let letter = Label::new(end(AXIS + 8.0), letter, ColourToken::Text);
        below = below.max(camera.place(&letter.at).y + 6.0);
        scene.label(letter);
    }
    let at = pos2(0.0, below + 2.0 - from.y);
    scene.label(Label {
        anchor: Align2::CENTER_TOP,
        ..Label::new(
            Place::from(origin).shifted(at.x, at.y),
            name,
            ColourToken::Muted,
        )
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_lies_on_the_base_in_round_squares_and_holds_everything() {
        let ball = Ball {
            centre_mm: [130.0, -70.0, 400.0],
            radius_mm: 910.0,
        };
        assert_eq!(square_mm(&ball, 1.0), 200.0);
        let lines = lines(&ball, 1.0);
        assert!(lines.iter().flatten().all(|p| p[2] == 0.0));
        for k in 0..2 {
            let of = |pick: fn(f64, f64) -> f64, start| {
                lines.iter().flatten().map(|p| p[k]).fold(start, pick)
            };
            let (low, high) = (of(f64::min, 1e9), of(f64::max, -1e9));
            assert!(low <= ball.centre_mm[k] - 910.0 && ball.centre_mm[k] + 910.0 <= high);
            assert_eq!((low % 200.0, high % 200.0), (0.0, 0.0));
        }
        // One of them goes through the origin in each direction.
        let through = |[a, b]: &&[[f64; 3]; 2]| a[0] == 0.0 && b[0] == 0.0;
        assert_eq!(lines.iter().filter(through).count(), 1);
        assert!(lines.len() < 40);
    }
}
