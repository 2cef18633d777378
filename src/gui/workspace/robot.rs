//! The nominal robot, at which pose it is drawn, and its links and joints as capsules.

use egui::{Color32, Pos2, Stroke};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::core::quantity::joint_value;
use crate::gui::core::skeleton::Skeleton;
use crate::gui::style::Palette;
use crate::gui::workbench::Workbench;
use crate::kinematics::{JointKind, Robot};
use crate::numeric::single;
use crate::present::chart::Form;

use super::pen::{Camera, Pen};

/// How a joint is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct JointSymbol {
    pub(crate) at_mm: Point3<f64>,
    /// Its axis, a unit vector of the measuring frame.
    pub(crate) axis: [f64; 3],
    /// Whether it turns (else it slides).
    pub(crate) turns: bool,
}

/// The robot as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawn {
    /// The sample; `None`: the pose was not measured.
    pub(crate) sample: Option<usize>,
    /// Whether the user points at that sample, or chose it.
    pub(crate) asked_for: bool,
    /// The joint values, rad or mm.
    pub(crate) q: Vec<f64>,
    /// The nominal robot from base to tool, mm of the measuring frame.
    pub(crate) corners_mm: Vec<Point3<f64>>,
    /// Its joints.
    signs: Vec<JointSymbol>,
}

impl Drawn {
    /// The robot at the sample that is pointed at or chosen, or else at one in the middle.
    pub(crate) fn of(workbench: &Workbench) -> Option<Self> {
        let (loaded_session, view) = (&**workbench.loaded_session(), &workbench.view);
        let robot = &loaded_session.session.robot;
        let asked = view
            .hovered
            .or(view.selected)
            .filter(|s| *s < loaded_session.len());
        let usable = &loaded_session.overview.usable;
        let middle = usable.get(usable.len() / 2).map(|sample| *sample as usize);
        let pose = |sample: usize| -> Vec<f64> {
            let columns = loaded_session.session.samples.q.iter();
            columns.map(|q| q[sample]).collect()
        };
        let sample = asked.or(middle);
        let q = sample.map_or_else(|| home(robot), pose);
        let targets = &loaded_session.session.targets;
        let target = sample.and_then(|s| Some(loaded_session.session.samples.target.as_ref()?[s]));
        let target = targets.get(target.map_or(0, |t| t as usize));
        let target_mm = target.map_or_else(Point3::origin, |t| t.position_mm);
        Some(Self {
            sample,
            asked_for: asked.is_some(),
            ..Self::at(robot, q, &target_mm, &workbench.base())?
        })
    }

    /// A robot by itself at home, without a session.
    pub(crate) fn alone(robot: &Robot) -> Option<Self> {
        let (target_mm, base) = (Point3::origin(), Isometry3::identity());
        Self::at(robot, home(robot), &target_mm, &base)
    }

    fn at(
        robot: &Robot,
        q: Vec<f64>,
        target_mm: &Point3<f64>,
        base: &Isometry3<f64>,
    ) -> Option<Self> {
        let corners = Skeleton::new(robot, target_mm).at(&q)?;
        let corners_mm: Vec<_> = corners.iter().map(|p| base * p).collect();
        Some(Self {
            sample: None,
            asked_for: true,
            signs: signs(robot, &q, base, &corners_mm),
            corners_mm,
            q,
        })
    }

    /// In words: which sample, at which joint values.
    pub(crate) fn describe(&self, workbench: &Workbench) -> String {
        let mut says = match self.sample {
            Some(sample) => say!("robot at sample {sample}", sample = sample + 1),
            None => say!("robot at home").to_owned(),
        };
        let joints = &workbench.loaded_session().session.robot.joints;
        for (k, (joint, q)) in joints.iter().zip(&self.q).enumerate() {
            says += if k == 0 { ": " } else { ", " };
            let value = joint_value(workbench.units(), joint.kind, *q);
            says += &format!("{} {value}", joint.name);
        }
        says
    }
}

/// The joints at a pose, where the corners of the chain are known.
fn signs(
    robot: &Robot,
    q: &[f64],
    base: &Isometry3<f64>,
    corners_mm: &[Point3<f64>],
) -> Vec<JointSymbol> {
    let motions = robot.motions_from_home(q);
    let joints = robot.joints.iter().zip(&motions);
    let corners = corners_mm.iter().skip(1).step_by(2);
    joints
        .zip(corners)
        .map(|((joint, motion), at_mm)| JointSymbol {
            at_mm: *at_mm,
            axis: (base.rotation * (motion.rotation * joint.axis.direction))
                .into_inner()
                .into(),
            turns: joint.kind == JointKind::Revolute,
        })
        .collect()
}

/// Every joint at zero, or as near to it as it gets.
fn home(robot: &Robot) -> Vec<f64> {
    let value = |joint: &crate::kinematics::Joint| match joint.limits {
        Some(range) if range.from <= range.to => 0.0_f64.clamp(range.from, range.to),
        _ => 0.0,
    };
    robot.joints.iter().map(value).collect()
}

/// Width of a link and of its wall, points.
const LINK: f32 = 10.0;
const WALL: f32 = 1.25;
/// Width of a joint that turns and half the length of what is between its ends, points; and of one that slides.
const DRUM: (f32, f64) = (17.0, 4.5);
const SLIDE: (f32, f64) = (12.0, 10.0);
/// Below this part of its length an axis is looked along.
const END_ON: f32 = 0.35;
/// How thick everything becomes at most, and the part of the robot's length at which it begins to.
const THICKER: f64 = 2.2;
const SLENDER: f64 = 0.04;
/// From the wall to the crest: how wide, as a part of the whole, and how much turned to the light.
const ROUND: [(f32, f32); 4] = [(1.0, 0.35), (0.72, 0.55), (0.46, 0.72), (0.2, 0.86)];
/// How much of the robot is seen that was not asked for.
const FAINT: f32 = 0.8;
/// How much of the robot's colour it has where it is turned to the light, and where it is not, on a
/// surface that is lighter than that colour, and on one that is darker.
const ON_LIGHT: [f32; 2] = [0.16, 0.78];
const ON_DARK: [f32; 2] = [0.95, 0.28];

/// A link from one corner to the next, or a joint along its axis: how near it is, its ends, how wide it is, and the
/// colour of its wall.
type Capsule = (f64, [Pos2; 2], f32, Color32);

/// The robot beneath what was measured: links and joints as capsules, lit, what is near over what is far. They are as
/// thick at any zoom: they are signs, not the machine; a robot that is drawn large has them thicker, as far as a hand's
/// breadth.
pub(super) fn body(pen: Pen<'_>, drawn: &Drawn, camera: &Camera) {
    let palette = pen.palette;
    let thick = thick(drawn, camera.points_per_mm());
    let part = if drawn.asked_for { 1.0 } else { FAINT };
    let seen = |color: Color32| palette.surface.lerp_to_gamma(color, part);
    let mut capsules = capsules(drawn, camera, thick, [palette.nominal, palette.text]);
    capsules.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, ends, width, wall) in capsules {
        let inner = width - 2.0 * WALL;
        let lit = ROUND.map(|(part, turned)| (part * inner, lit(palette, turned)));
        for (width, color) in std::iter::once((width, wall)).chain(lit) {
            pen.line(ends, Stroke::new(width, seen(color)));
            for end in ends {
                pen.painter.circle_filled(end, 0.5 * width, seen(color));
            }
        }
    }
    // The open ring of the tool.
    if let Some(tool) = drawn.corners_mm.last() {
        let edge = Stroke::new(1.5, seen(palette.nominal));
        let ring = (Form::Disc, 5.5);
        pen.mark(camera.at(tool.coords.into()), ring, palette.surface, edge);
    }
}

fn capsules(drawn: &Drawn, camera: &Camera, thick: f64, walls: [Color32; 2]) -> Vec<Capsule> {
    let at = |p: Point3<f64>| camera.at(p.into());
    let nearness = |p: Point3<f64>| camera.facing.nearness(p.into());
    let links = drawn.corners_mm.windows(2).map(|pair| {
        let middle = nalgebra::center(&pair[0], &pair[1]);
        let width = LINK * single(thick);
        (
            nearness(middle),
            [pair[0], pair[1]].map(at),
            width,
            walls[0],
        )
    });
    let joints = drawn.signs.iter().map(|sign| {
        let (width, half) = if sign.turns { DRUM } else { SLIDE };
        let width = width * single(thick);
        let mm = |points: f64| points / camera.points_per_mm();
        let off = Vector3::from(sign.axis) * mm(thick * half);
        // An axis that is looked along is a point: its end is seen through the links over it.
        let above = if camera.direction(sign.axis).length() < END_ON {
            f64::INFINITY
        } else {
            nearness(sign.at_mm) + mm(0.5 * f64::from(width))
        };
        let ends = [sign.at_mm - off, sign.at_mm + off];
        (above, ends.map(at), width, walls[1])
    });
    links.chain(joints).collect()
}

/// How many times as thick as they are at least links and joints are.
fn thick(drawn: &Drawn, points_per_mm: f64) -> f64 {
    let corners = drawn.corners_mm.windows(2);
    let length_mm: f64 = corners.map(|pair| (pair[1] - pair[0]).norm()).sum();
    let times = SLENDER * length_mm * points_per_mm / f64::from(LINK);
    // A robot without a size has them as they are.
    if times.is_finite() {
        times.clamp(1.0, THICKER)
    } else {
        1.0
    }
}

/// The robot's colour by how much it is turned to the light, from 0 to 1.
fn lit(palette: &Palette, turned: f32) -> Color32 {
    let (surface, nominal) = (palette.surface, palette.nominal);
    let on_light = surface.intensity() > nominal.intensity();
    let [lit, dark] = if on_light { ON_LIGHT } else { ON_DARK };
    surface.lerp_to_gamma(nominal, dark + (lit - dark) * turned)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::gui::testing::workbench;
    use crate::gui::view::Plane;

    use super::*;

    #[test]
    fn the_robot_stands_at_the_chosen_sample_and_else_at_one_as_an_example() {
        let mut workbench = workbench();
        let faint = Drawn::of(&workbench).expect("there are samples");
        assert!(!faint.asked_for);
        workbench.execute(|bench| bench.view.select(Some(30)));
        let chosen = Drawn::of(&workbench).expect("there are samples");
        assert!(chosen.asked_for);
        assert_eq!(chosen.describe(&workbench), "robot at sample 31: pan 0°");
        workbench.execute(|bench| bench.view.hovered = Some(0));
        let hovered = Drawn::of(&workbench).expect("there are samples");
        assert_eq!(hovered.describe(&workbench), "robot at sample 1: pan −90°");
    }

    #[test]
    fn everything_of_the_robot_is_within_the_plots_bounds() {
        let mut workbench = workbench();
        for plane in Plane::ALL {
            workbench.execute(|bench| bench.view.look_in(plane));
            let shown = crate::gui::workspace::model::Shown::of(&workbench);
            let [low, high] = crate::gui::workspace::fitting::bounds(&shown);
            let drawn = Drawn::of(&workbench).expect("there are samples");
            for p in &drawn.corners_mm {
                let p = workbench.facing().flat(p.coords.into());
                assert!((0..2).all(|k| low[k] <= p[k] && p[k] <= high[k]), "{p:?}");
            }
        }
        let loaded_session = Arc::clone(workbench.loaded_session());
        assert_eq!(loaded_session.overview.robot_mm[0][2], 0.0);
    }
}
