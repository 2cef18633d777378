//! The robot that is drawn, at which pose: the nominal one, and the real one beside it.
//!
//! The real robot is the nominal chain with its tool displaced by the deviation, magnified as vectors
//! are. What its joints between do the tool alone cannot tell: the displacement grows evenly along the
//! chain from where the first axis lets go of it, which for a column is exact.

use std::f64::consts::TAU;

use egui::{Color32, Pos2, Stroke};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::core::quantity::joint_value;
use crate::gui::core::skeleton::Skeleton;
use crate::gui::style::Palette;
use crate::gui::workbench::Workbench;
use crate::kinematics::{JointKind, Robot};
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
    pub(crate) signs: Vec<JointSymbol>,
    /// The joints' names and values.
    pub(crate) values: Vec<(String, String)>,
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
        let units = workbench.units();
        let values = robot.joints.iter().zip(&q);
        let values =
            values.map(|(joint, q)| (joint.name.clone(), joint_value(units, joint.kind, *q)));
        Some(Self {
            sample,
            asked_for: asked.is_some(),
            values: values.collect(),
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
            values: Vec::new(),
            corners_mm,
            q,
        })
    }

    /// In words: which sample, at which joint values.
    pub(crate) fn describe(&self) -> String {
        let mut says = match self.sample {
            Some(sample) => say!("robot at sample {sample}", sample = sample + 1),
            None => say!("robot at home").to_owned(),
        };
        for (k, (name, value)) in self.values.iter().enumerate() {
            says += if k == 0 { ": " } else { ", " };
            says += &format!("{name} {value}");
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

/// Width of a rod, and of its wall, points.
const ROD: [f32; 2] = [10.0, 1.25];
/// Radius and half the length of a drum, points; of a joint that slides half a side.
const DRUM: [f64; 2] = [8.5, 8.5];
const BLOCK: f64 = 8.0;
/// Below this part of its length an axis is looked along.
const END_ON: f32 = 0.35;
/// Half a side of the plate that the robot stands on, points.
const PLATE: f64 = 17.0;
/// How thick rods and drums become at most, and the part of the robot's length at which they begin to.
const THICKER: f64 = 2.2;
const SLENDER: f64 = 0.04;
/// A rod from its wall to its crest: how wide, as a part of the rod, and how much turned to the light.
const ROUND: [(f32, f32); 4] = [(1.0, 0.35), (0.72, 0.55), (0.46, 0.72), (0.2, 0.86)];
/// How much the ends of drums and their bodies are turned to the light.
const DRUM_LIT: [f32; 2] = [0.95, 0.4];
/// How much of the robot is seen that was not asked for.
const FAINT: f32 = 0.8;
/// How much of the robot's colour a face has that is turned to the light, and one that is not, on a
/// surface that is lighter than that colour, and on one that is darker.
const ON_LIGHT: [f32; 2] = [0.16, 0.78];
const ON_DARK: [f32; 2] = [0.95, 0.28];

/// Both robots, beneath what was measured: links as rods and joints as drums about their axes, lit, what is near over
/// what is far. Rods and drums are as thick at any zoom: they are signs, not the machine; a robot that is drawn large
/// has them thicker, as far as a hand's breadth. The real robot is a line with a filled tool: form says what colour
/// says. `base` is the base in the measuring frame.
pub(super) fn body(pen: &mut Pen<'_>, drawn: &Drawn, base: &Isometry3<f64>, camera: &Camera) {
    let points_per_mm = camera.points_per_mm();
    let body = Body {
        camera,
        palette: pen.palette,
        mm: 1.0 / points_per_mm,
        thick: thick(drawn, points_per_mm),
        part: if drawn.asked_for { 1.0 } else { FAINT },
    };
    let (edge, surface) = (body.seen(pen.palette.nominal), pen.palette.surface);
    if let Some(stands) = drawn.corners_mm.first() {
        let sides = [Vector3::x(), Vector3::y()].map(|side| base.rotation * side * PLATE);
        let plate = body.face(*stands, sides, false);
        pen.area(plate, surface, Stroke::new(1.25, edge));
    }
    body.links_and_joints(pen, drawn);
    // The open ring of the nominal robot's tool.
    if let Some(tool) = drawn.corners_mm.last() {
        let ring = (Form::Disc, 5.5);
        pen.mark(body.at(tool), ring, surface, Stroke::new(1.5, edge));
    }
}

/// How many times as thick as their least rods and drums are.
fn thick(drawn: &Drawn, points_per_mm: f64) -> f64 {
    let corners = drawn.corners_mm.windows(2);
    let length_mm: f64 = corners.map(|pair| (pair[1] - pair[0]).norm()).sum();
    let times = SLENDER * length_mm * points_per_mm / f64::from(ROD[0]);
    // A robot without a size has them as they are.
    if times.is_finite() {
        times.clamp(1.0, THICKER)
    } else {
        1.0
    }
}

/// A link from one corner to the next, or a joint.
enum Piece<'a> {
    Rod(&'a Point3<f64>, &'a Point3<f64>),
    Joint(&'a JointSymbol),
}

/// What the signs of a robot are drawn by.
struct Body<'a> {
    camera: &'a Camera,
    palette: &'a Palette,
    /// A point of the picture, mm.
    mm: f64,
    /// How many times as thick as their least rods and drums are.
    thick: f64,
    /// How much of the robot is seen.
    part: f32,
}

impl Body<'_> {
    /// In full where the pose was asked for, or else paler.
    fn seen(&self, color: Color32) -> Color32 {
        self.palette.surface.lerp_to_gamma(color, self.part)
    }

    /// The colour of a face, by how much it is turned to the light, from 0 to 1.
    fn lit(&self, turned: f32) -> Color32 {
        let Palette {
            surface, nominal, ..
        } = *self.palette;
        let bright = |c: Color32| u16::from(c.r()) + u16::from(c.g()) + u16::from(c.b());
        let on_light = bright(surface) > bright(nominal);
        let [lit, dark] = if on_light { ON_LIGHT } else { ON_DARK };
        self.seen(surface.lerp_to_gamma(nominal, dark + (lit - dark) * turned))
    }

    fn at(&self, p: &Point3<f64>) -> Pos2 {
        self.camera.at(p.coords.into())
    }

    fn links_and_joints(&self, pen: &mut Pen<'_>, drawn: &Drawn) {
        let nearness = |p: Point3<f64>| self.camera.facing.nearness(p.into());
        let mut pieces: Vec<(f64, Piece<'_>)> = Vec::new();
        for pair in drawn.corners_mm.windows(2) {
            if (pair[1] - pair[0]).norm() > 1e-6 {
                let middle = nalgebra::center(&pair[0], &pair[1]);
                pieces.push((nearness(middle), Piece::Rod(&pair[0], &pair[1])));
            }
        }
        for sign in &drawn.signs {
            // An axis that is looked along is a point: its end is seen through the links over it.
            let along = self.camera.direction(sign.axis);
            let above = if along.length() < END_ON {
                f64::INFINITY
            } else {
                nearness(sign.at_mm) + self.thick * DRUM[0] * self.mm
            };
            pieces.push((above, Piece::Joint(sign)));
        }
        pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, piece) in pieces {
            match piece {
                Piece::Rod(from, to) => self.rod(pen, [from, to].map(|p| self.at(p))),
                Piece::Joint(sign) => self.joint(pen, sign),
            }
        }
    }

    /// A flat piece around a point with these half sides (or radii, where it is round), points.
    fn face(&self, at: Point3<f64>, sides: [Vector3<f64>; 2], round: bool) -> Vec<Pos2> {
        let corners: u8 = if round { 24 } else { 4 };
        let corner = |k: u8| {
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(corners)).sin_cos();
            let out = if round { 1.0 } else { 2.0_f64.sqrt() };
            self.at(&(at + (sides[0] * cos + sides[1] * sin) * (out * self.mm)))
        };
        (0..corners).map(corner).collect()
    }

    /// A link: round, lit from the front.
    fn rod(&self, pen: &mut Pen<'_>, ends: [Pos2; 2]) {
        let width = ROD[0] * crate::numeric::single(self.thick);
        let inner = width - 2.0 * ROD[1];
        let lit = ROUND.map(|(part, turned)| (part * inner, self.lit(turned)));
        let wall = (width, self.seen(self.palette.nominal));
        for (width, color) in std::iter::once(wall).chain(lit) {
            pen.line(ends, Stroke::new(width, color));
            for end in ends {
                pen.disc(end, 0.5 * width, color);
            }
        }
    }

    /// A drum about an axis, or a block along it.
    fn joint(&self, pen: &mut Pen<'_>, sign: &JointSymbol) {
        let edge = Stroke::new(1.5, self.seen(self.palette.text));
        let axis = Vector3::from(sign.axis);
        let [radius, half] = if sign.turns { DRUM } else { [BLOCK; 2] };
        let [radius, half] = [radius, half].map(|points| self.thick * points);
        let aside = if axis.x.abs() < 0.9 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        let across = axis.cross(&aside).normalize();
        let sides = [across * radius, axis.cross(&across) * radius];
        // The end that is farther first, the body over it, the nearer end over both.
        let way = if self.camera.facing.nearness(sign.axis) < 0.0 {
            -axis
        } else {
            axis
        };
        let off = way * (half * self.mm);
        let near = sign.at_mm + off;
        let ends = [sign.at_mm - off, near].map(|end| self.face(end, sides, sign.turns));
        pen.area(ends.concat(), self.lit(DRUM_LIT[1]), edge);
        let [_, end] = ends;
        pen.area(end, self.lit(DRUM_LIT[0]), edge);
        pen.disc(self.at(&near), 1.6, edge.color);
    }
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
        assert_eq!(chosen.describe(), "robot at sample 31: pan 0°");
        workbench.execute(|bench| bench.view.hovered = Some(0));
        let hovered = Drawn::of(&workbench).expect("there are samples");
        assert_eq!(hovered.describe(), "robot at sample 1: pan −90°");
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
