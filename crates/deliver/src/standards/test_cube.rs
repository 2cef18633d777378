//! The test cube of ISO 9283:1998 (6.8) with its poses and paths, as joint values of a robot.
//!
//! The cube is the largest of the standard's sides that the tool reaches with the edges parallel to
//! the axes of the base. `C1` … `C4` are the corners of its upper face, counted about the base's z from
//! (−x, −y), `C5` … `C8` those below them; poses and paths lie in the inclined plane `C1-C2-C7-C8`:
//!
//! ```text
//! P1 = centre,  P2 … P5 on the diagonals, a tenth of the diagonal from C1, C2, C7, C8
//! line:   P2 → P4, 80 % of the diagonal        circle: about P1, diameter 80 % of the side
//! ```
//!
//! All poses have one configuration: they are followed from P1 on straight ways without passing a
//! singular pose or a limit. The orientation is one for all, along the axes of the base; a robot with
//! fewer than six joints keeps it as far as they allow. Of the places where the largest cube fits the
//! one is taken at which the tool moves most evenly in its worst pose. There is nothing random in it.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use crate::compensation::pose::{Tools, commands_for_poses, conditioning, is_singular};
use crate::diagnosis::NextPose;
use crate::diagnostic::{Place as Field, Rejected};
use crate::effects::Inputs;
use crate::kinematics::inverse::{Goal, Inverse, REACHED_MM};
use crate::kinematics::{Pose, Robot};
use crate::model::Model;
use crate::programs::Axes;
use crate::refusal::Refusal;

use super::pose::STANDARD_CYCLES;

/// Sides of the cube that the standard lists, mm.
pub(crate) const SIDES_MM: [f64; 4] = [1000.0, 630.0, 400.0, 250.0];
/// P2 … P5 stand at this part of the way from the centre to their corners.
const OUT: f64 = 0.8;
/// Ways from the centre to a corner are followed in so many steps.
const STEPS: usize = 5;
/// Points of a straight path and of a circle, both ends included.
const POINTS: [usize; 2] = [21, 37];
/// Places of the spread over the joints' travel that are tried as the centre.
const PLACES: usize = 4000;
/// The centre is a whole multiple of this, mm.
const GRID_MM: f64 = 10.0;

/// A commanded pose of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct TestPose {
    /// `P1` … `P5`, or a path and the number of its point.
    pub name: String,
    /// The tool's pose, base frame, mm.
    pub pose: Pose,
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
}

/// The cube of ISO 9283, 6.8: five poses and the paths between them.
#[derive(Debug, Clone, PartialEq)]
pub struct TestCube {
    /// Length of the edges, mm.
    pub side_mm: f64,
    /// `C1` … `C8`, base frame, mm.
    pub corners_mm: [Point3<f64>; 8],
    /// `P1` … `P5`.
    pub poses: Vec<TestPose>,
    /// Points of the straight path from P2 to P4.
    pub line: Vec<TestPose>,
    /// Points of the circle about P1; the last is the first.
    pub circle: Vec<TestPose>,
    /// Whether the orientation is the same everywhere.
    pub orientation_kept: bool,
}

/// No machine has more, and the search takes the cube of them.
const MOST_JOINTS: usize = 30;

impl TestCube {
    /// The largest cube that fits.
    ///
    /// # Errors
    /// Where none fits.
    pub fn of(robot: &Robot) -> Result<Self, Refusal> {
        if robot.joints.len() > MOST_JOINTS {
            return Err(Refusal(text!(
                "a robot with {joints} joints; poses are looked for with at most {most}",
                joints = robot.joints.len(),
                most = MOST_JOINTS
            )));
        }
        let problems = robot.out_of_range(&Field::default());
        if !problems.is_empty() {
            return Err(Rejected::of(problems).into());
        }
        let search = Search::new(robot)?;
        let places = search.places();
        let fits = |side: &f64| {
            let cubes = places.iter().filter_map(|place| search.cube(*side, place));
            // The first of equals, so that rounding does not choose.
            cubes.reduce(|best, next| if next.0 > 1.001 * best.0 { next } else { best })
        };
        let best = SIDES_MM.iter().find_map(fits);
        best.map(|(_, cube)| cube).ok_or_else(|| {
            Refusal(text!(
                "no test cube of ISO 9283 fits the workspace (reach {reach_mm} mm): the smallest has edges of 250 mm, and nowhere do all its corners and poses lie within the joint limits in one configuration",
                reach_mm = format!("{:.0}", robot.reach_mm())
            ))
        })
    }

    /// What to measure for pose accuracy and repeatability: 30 cycles P5 → P4 → P3 → P2 → P1. It begins
    /// at P1, from which P5 is approached in every cycle.
    pub fn measuring_order(&self) -> Vec<NextPose> {
        let joints = self.poses[0].q.len();
        let one = |cycle: usize, k: usize| {
            let (here, before) = (&self.poses[k], &self.poses[(k + 1) % self.poses.len()]);
            let side = |j: usize| {
                let way = here.q[j] - before.q[j];
                if way.abs() < 1e-9 { 0.0 } else { way.signum() }
            };
            NextPose {
                q: here.q.clone(),
                dir: (0..joints).map(side).collect(),
                target: None,
                target_mm: None,
                speed: None,
                load_kg: None,
                temperature_c: None,
                why: text!("{pose} cycle {cycle}", pose = &here.name, cycle = cycle + 1),
            }
        };
        let cycles = 0..STANDARD_CYCLES;
        cycles
            .flat_map(|cycle| (0..self.poses.len()).rev().map(move |k| (cycle, k)))
            .map(|(cycle, k)| one(cycle, k))
            .collect()
    }
}

/// A place for the centre: the tool's pose and the joint values that lead there.
struct Place {
    pose: Pose,
    q: Vec<f64>,
}

struct Search<'a> {
    robot: &'a Robot,
    free: Vec<usize>,
    inverse: Inverse<'a>,
    /// Whether position and orientation can be met at once.
    whole: bool,
    /// For robots that cannot.
    nominal: Model,
}

impl<'a> Search<'a> {
    fn new(robot: &'a Robot) -> Result<Self, Refusal> {
        let free = Axes::new(robot).free();
        match free.len() {
            0 | 1 => {
                return Err(Refusal(text!(
                    "the robot has one joint: ISO 9283 tests the poses of arms; a single axis is tested after ISO 230-2 (positions along its travel, approached from both sides: truepose plan without --iso9283, then truepose standards)"
                )));
            }
            2 => {
                return Err(Refusal(text!(
                    "the robot's {joints} joints move the tool in fewer than three directions: no cube fits its workspace",
                    joints = 2
                )));
            }
            _ => {}
        }
        let inverse = Inverse::new(robot, &free);
        let whole = free.len() >= 6 && robot.mobility() == 6;
        let nominal = Model::nominal(robot.clone());
        Ok(Self {
            robot,
            free,
            inverse,
            whole,
            nominal,
        })
    }

    /// Places spread over the workspace, on the grid and, where the joints allow, along the axes.
    fn places(&self) -> Vec<Place> {
        let middle: Vec<f64> = (self.robot.joints.iter())
            .map(|joint| joint.limits.map_or(0.0, |l| 0.0_f64.clamp(l.from, l.to)))
            .collect();
        let place = |k: usize| {
            let q = self.inverse.spread(&middle, k);
            let mut pose = self.robot.base_from_tool(&q);
            let at = &mut pose.translation.vector;
            *at = at.map(|v| (v / GRID_MM).round() * GRID_MM + 0.0);
            if self.whole {
                pose.rotation = along_the_axes(&pose.rotation);
            }
            let q = self.reached(&pose, &q)?;
            Some(Place { pose, q })
        };
        (0..PLACES).filter_map(place).collect()
    }

    /// The joint values near `from` that bring the tool there, unless a limit or a singular pose is
    /// in the way.
    fn reached(&self, pose: &Pose, from: &[f64]) -> Option<Vec<f64>> {
        let q = if self.whole {
            self.inverse.from_start(&Goal::pose(pose), from)?
        } else {
            let home = self.robot.base_from_tool.translation.vector.into();
            let inputs = Inputs::at_poses(from.iter().map(|q| vec![*q]).collect(), vec![home]);
            let tools = Tools::of(self.robot);
            let mut all = commands_for_poses(&self.nominal, &inputs, &[*pose], &self.free, &tools);
            let reached = all.pop()?;
            if !reached.settled || reached.position_mm > REACHED_MM {
                return None;
            }
            reached.q
        };
        let inside = |(joint, q): (&crate::kinematics::Joint, &f64)| {
            joint.limits.is_none_or(|l| *q >= l.from && *q <= l.to)
        };
        let inside = self.robot.joints.iter().zip(&q).all(inside);
        // A longer way in one step leads into another configuration.
        let near = self.inverse.distance(&q, from) < TAU / 4.0;
        (inside && near && !is_singular(self.robot, &q, &self.free)).then_some(q)
    }

    /// The cube of this side about a place, and how evenly the tool moves in its worst pose.
    fn cube(&self, side_mm: f64, place: &Place) -> Option<(f64, TestCube)> {
        let centre = place.pose.translation.vector;
        let corners_mm = corners(side_mm).map(|c| Point3::from(centre + c));
        let mut poses = vec![self.named("P1".to_owned(), place.pose, place.q.clone())];
        let plane = [0, 1, 6, 7];
        // Where the way to a corner is furthest decides soonest.
        for (k, corner) in corners(side_mm).iter().enumerate() {
            let mut q = place.q.clone();
            for step in 1..=STEPS {
                let part = step as f64 / STEPS as f64;
                let pose = moved(&place.pose, corner * part);
                q = self.reached(&pose, &q)?;
                if plane.contains(&k) && (part - OUT).abs() < 1e-9 {
                    let name = format!("P{}", poses.len() + 1);
                    poses.push(self.named(name, pose, q.clone()));
                }
            }
        }
        let line = self.path("line", POINTS[0], &poses[1], |part| {
            corners(side_mm)[0] * OUT * (1.0 - 2.0 * part) + centre
        })?;
        // The plane's own directions: along the edge C1-C2, and down the slope from C1 to C8.
        let [across, slope] = [1, 7].map(|k: usize| {
            let edge = corners(side_mm)[k] - corners(side_mm)[0];
            edge.normalize()
        });
        let radius = 0.5 * OUT * side_mm;
        let start = self.followed(&place.pose, &place.q, slope * radius)?;
        let circle = self.path("circle", POINTS[1], &start, |part| {
            let (s, c) = (TAU * part).sin_cos();
            centre + (slope * c + across * s) * radius
        })?;
        let evenly = |p: &TestPose| conditioning(self.robot, &p.q, &self.free);
        let worst = poses.iter().map(evenly).fold(f64::INFINITY, f64::min);
        let all = poses.iter().chain(&line).chain(&circle);
        let kept = |p: &TestPose| p.pose.rotation.angle_to(&place.pose.rotation) < 1e-6;
        let orientation_kept = all.into_iter().all(kept);
        let cube = TestCube {
            side_mm,
            corners_mm,
            poses,
            line,
            circle,
            orientation_kept,
        };
        Some((worst, cube))
    }

    /// Points of a path from a pose on: `at` gives the tool's place for a part of the path.
    fn path(
        &self,
        name: &str,
        points: usize,
        start: &TestPose,
        at: impl Fn(f64) -> Vector3<f64>,
    ) -> Option<Vec<TestPose>> {
        let mut q = start.q.clone();
        let point = |k: usize| {
            let mut pose = start.pose;
            pose.translation.vector = at(k as f64 / (points - 1) as f64);
            q = self.reached(&pose, &q)?;
            Some(self.named(format!("{name} {}", k + 1), pose, q.clone()))
        };
        (0..points).map(point).collect()
    }

    /// The end of a straight way.
    fn followed(&self, from: &Pose, q: &[f64], way: Vector3<f64>) -> Option<TestPose> {
        let mut q = q.to_vec();
        for step in 1..=STEPS {
            q = self.reached(&moved(from, way * (step as f64 / STEPS as f64)), &q)?;
        }
        Some(self.named(String::new(), moved(from, way), q))
    }

    /// A pose of the test; a robot that cannot keep the orientation has its own there.
    fn named(&self, name: String, mut pose: Pose, q: Vec<f64>) -> TestPose {
        if !self.whole {
            pose.rotation = self.robot.base_from_tool(&q).rotation;
        }
        TestPose { name, pose, q }
    }
}

/// `C1` … `C8` from the centre, mm.
fn corners(side_mm: f64) -> [Vector3<f64>; 8] {
    let half = 0.5 * side_mm;
    let ring = [(-half, -half), (half, -half), (half, half), (-half, half)];
    std::array::from_fn(|k| {
        let (x, y) = ring[k % 4];
        Vector3::new(x, y, if k < 4 { half } else { -half })
    })
}

fn moved(pose: &Pose, by: Vector3<f64>) -> Pose {
    let at = pose.translation.vector + by;
    Pose::from_parts(at.into(), pose.rotation)
}

/// Of the 24 orientations along the base's axes the nearest.
fn along_the_axes(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let matrix = rotation.to_rotation_matrix();
    let m = matrix.matrix();
    let orders = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    let mut best = (f64::NEG_INFINITY, Matrix3::identity());
    for order in orders {
        for signs in 0..8_u8 {
            let sign = |k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
            let mut axes = Matrix3::zeros();
            for (column, row) in order.into_iter().enumerate() {
                axes[(row, column)] = sign(column);
            }
            let alike = axes.component_mul(m).sum();
            if axes.determinant() > 0.0 && alike > best.0 + 1e-9 {
                best = (alike, axes);
            }
        }
    }
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(best.1))
}
