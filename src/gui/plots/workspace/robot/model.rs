//! The robot at one pose as strokes from base to tool, mm of the measuring frame.
//!
//! A chain of axes has no links of its own, so that they are drawn where the axes put them: along
//! an axis, and from one to the next on their common perpendicular,
//!
//! ```text
//! base → a₁ … b₁ → a₂ … b₂ → … → tool,   aᵢ, bᵢ on axis i,
//! ```
//!
//! aᵢ nearest to what comes before, bᵢ nearest to what comes after; both are moved from home by
//! the product of exponentials ([`Robot::motions_from_home`]). For a column that is its mast and
//! its arm.
//!
//! The real robot is the same chain with its tool displaced by the deviation, magnified as vectors
//! are. What its joints between do the tool alone cannot tell: the displacement grows evenly along
//! the chain from where the first axis lets go of it, which for a column is exact.

use nalgebra::{Point3, Vector3};

use crate::gui::commands::Workbench;
use crate::gui::plots::round_down;
use crate::gui::view::Plane;
use crate::kinematics::{Axis, JointKind, Robot};

use super::super::model::magnification;

/// Axes that enclose less than this (its sine) have no common perpendicular worth drawing.
const PARALLEL: f64 = 0.02;
/// The real robot is displaced by no more than this part of the workspace.
const MOST_DISPLACED: f64 = 0.3;

/// A corner of the chain at home, and how many joints move it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    at_home: Point3<f64>,
    joints: usize,
}

/// The corners from base to tool: base, two on each axis, tool.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Skeleton<'a> {
    robot: &'a Robot,
    nodes: Vec<Node>,
}

impl<'a> Skeleton<'a> {
    /// The chain of a robot up to a point of its tool, mm of the tool frame.
    pub(crate) fn new(robot: &'a Robot, target_mm: &Point3<f64>) -> Self {
        let tool = robot.base_from_tool * target_mm;
        let base = Point3::origin();
        let axes: Vec<&Axis> = robot.joints.iter().map(|joint| &joint.axis).collect();
        let mut nodes = vec![Node {
            at_home: base,
            joints: 0,
        }];
        let mut last = base;
        let mut enters = axes.first().map(|axis| on_axis(axis, &base));
        for (k, axis) in axes.iter().enumerate() {
            let enter = enters.unwrap_or_else(|| on_axis(axis, &last));
            let (leave, next) = match axes.get(k + 1) {
                None => (on_axis(axis, &tool), None),
                Some(next) => match nearest(axis, next) {
                    Some((here, there)) => (here, Some(there)),
                    None => (enter, Some(on_axis(next, &enter))),
                },
            };
            nodes.push(Node {
                at_home: enter,
                joints: k,
            });
            nodes.push(Node {
                at_home: leave,
                joints: k + 1,
            });
            (last, enters) = (leave, next);
        }
        nodes.push(Node {
            at_home: tool,
            joints: axes.len(),
        });
        Self { robot, nodes }
    }

    /// Where the corners are at a pose, mm of the base frame; `None` where the pose is not one.
    pub(crate) fn at(&self, q: &[f64]) -> Option<Vec<Point3<f64>>> {
        if q.len() != self.robot.joints.len() || !q.iter().all(|v| v.is_finite()) {
            return None;
        }
        let motions = self.robot.motions_from_home(q);
        let moved = self.nodes.iter();
        Some(moved.map(|n| motions[n.joints] * n.at_home).collect())
    }
}

/// The point of an axis that is nearest to a point.
fn on_axis(axis: &Axis, to: &Point3<f64>) -> Point3<f64> {
    let along = axis.direction.into_inner();
    axis.point_mm + along * along.dot(&(to - axis.point_mm))
}

/// The points of two axes that are nearest to each other; `None` where they are parallel.
fn nearest(a: &Axis, b: &Axis) -> Option<(Point3<f64>, Point3<f64>)> {
    let (u, v) = (a.direction.into_inner(), b.direction.into_inner());
    let cosine = u.dot(&v);
    let squared_sine = 1.0 - cosine * cosine;
    if squared_sine < PARALLEL * PARALLEL {
        return None;
    }
    let between = b.point_mm - a.point_mm;
    let (p, r) = (u.dot(&between), v.dot(&between));
    let s = (p - cosine * r) / squared_sine;
    let t = (cosine * p - r) / squared_sine;
    Some((a.point_mm + u * s, b.point_mm + v * t))
}

/// The corners with the last displaced by `tip_mm`, the others as far along as they are.
fn displaced(corners: &[Point3<f64>], tip_mm: Vector3<f64>) -> Vec<Point3<f64>> {
    // Base and the first axis stand where they stand.
    const FIXED: usize = 3;
    let step = |k: usize| (corners[k] - corners[k - 1]).norm();
    let length: f64 = (FIXED..corners.len()).map(step).sum();
    let mut gone = 0.0;
    let mut moved = corners.to_vec();
    for k in FIXED..corners.len() {
        gone += step(k);
        let part = if k + 1 == corners.len() || length <= 0.0 {
            1.0
        } else {
            gone / length
        };
        moved[k] += tip_mm * part;
    }
    moved
}

/// How a joint is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sign {
    /// Where, mm.
    pub(crate) at_mm: [f64; 2],
    /// Its axis as it is seen: 1 long where it lies in the plane, 0 where one looks along it.
    pub(crate) along: [f64; 2],
    /// Whether it turns (else it slides).
    pub(crate) turns: bool,
}

/// The robot beside the nominal one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Real {
    /// From base to tool, mm.
    pub(crate) corners_mm: Vec<[f64; 2]>,
    /// How many times its deviation is drawn.
    pub(crate) times: f64,
    /// Whether that is the identified robot (else it is as it was measured).
    pub(crate) identified: bool,
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawn {
    /// The sample; `None`: nobody measured this pose.
    pub(crate) sample: Option<usize>,
    /// Whether somebody points at that sample, or chose it.
    pub(crate) asked_for: bool,
    /// The nominal robot from base to tool, mm.
    pub(crate) nominal_mm: Vec<[f64; 2]>,
    /// The real one.
    pub(crate) real: Option<Real>,
    /// Its joints.
    pub(crate) signs: Vec<Sign>,
    /// The joints' names and values.
    pub(crate) values: Vec<(String, String)>,
    /// Whether the plane shows what is up and what is down.
    pub(crate) upright: bool,
}

impl Drawn {
    /// The robot at the sample that is pointed at or chosen, or else at one in the middle.
    pub(crate) fn of(workbench: &Workbench) -> Option<Self> {
        let (subject, view) = (&**workbench.subject(), workbench.view());
        let robot = &subject.session.robot;
        let asked = view
            .hovered
            .or(view.selected)
            .filter(|s| *s < subject.len());
        let usable = &subject.overview.usable;
        let middle = usable.get(usable.len() / 2).map(|sample| *sample as usize);
        let pose = |sample: usize| -> Vec<f64> {
            let columns = subject.session.samples.q.iter();
            columns.map(|q| q[sample]).collect()
        };
        let sample = asked.or(middle);
        let q = sample.map_or_else(|| home(robot), pose);
        let targets = &subject.session.targets;
        let target = sample.and_then(|s| Some(subject.session.samples.target.as_ref()?[s]));
        let target = targets.get(target.map_or(0, |t| t as usize));
        let target_mm = target.map_or_else(Point3::origin, |t| t.position_mm);
        let corners = Skeleton::new(robot, &target_mm).at(&q)?;
        let axes = view.plane.axes();
        let flat = |p: &Point3<f64>| axes.map(|k| p[k]);
        let motions = robot.motions_from_home(&q);
        let signs = robot.joints.iter().enumerate().map(|(k, joint)| {
            let along = motions[k].rotation * joint.axis.direction;
            Sign {
                at_mm: flat(&corners[2 * k + 1]),
                along: axes.map(|a| along[a]),
                turns: joint.kind == JointKind::Revolute,
            }
        });
        let units = workbench.units();
        let values = robot.joints.iter().zip(&q).map(|(joint, q)| {
            let value = match joint.kind {
                JointKind::Revolute => units.angle(*q),
                JointKind::Prismatic => units.length(*q),
            };
            (joint.name.clone(), value)
        });
        Some(Self {
            sample,
            asked_for: asked.is_some(),
            nominal_mm: corners.iter().map(flat).collect(),
            real: sample.and_then(|sample| real(workbench, sample, &corners, view.plane)),
            signs: signs.collect(),
            values: values.collect(),
            upright: axes[1] == 2,
        })
    }

    /// In words: which sample, at which joint values.
    pub(crate) fn says(&self) -> String {
        let mut says = match (self.sample, self.asked_for) {
            (Some(sample), true) => format!("robot at sample {}", sample + 1),
            (Some(sample), false) => format!("robot at sample {}, as an example", sample + 1),
            (None, _) => "robot at home".to_owned(),
        };
        for (k, (name, value)) in self.values.iter().enumerate() {
            says += if k == 0 { ": " } else { ", " };
            says += &format!("{name} {value}");
        }
        says
    }
}

/// Every joint at zero, or as near to it as it gets.
fn home(robot: &Robot) -> Vec<f64> {
    let value = |joint: &crate::kinematics::Joint| match joint.limits {
        Some(range) if range.from <= range.to => 0.0_f64.clamp(range.from, range.to),
        _ => 0.0,
    };
    robot.joints.iter().map(value).collect()
}

fn real(
    workbench: &Workbench,
    sample: usize,
    corners: &[Point3<f64>],
    plane: Plane,
) -> Option<Real> {
    let subject = &**workbench.subject();
    if !subject.usable[sample] {
        return None;
    }
    let before = Vector3::from(subject.deviation_before(sample));
    let answer = workbench.answer();
    // What the model says is what was measured without what is left.
    let deviation = match answer {
        Some(answer) => before - Vector3::from(answer.deviation_after(sample)),
        None => before,
    };
    let length = deviation.norm();
    if !length.is_finite() {
        return None;
    }
    let wanted = magnification(workbench.view(), subject);
    let most = MOST_DISPLACED * subject.overview.reach_mm / length.max(1e-9);
    let times = if wanted <= most {
        wanted
    } else {
        round_down(most).max(1.0)
    };
    let axes = plane.axes();
    let moved = displaced(corners, deviation * times);
    Some(Real {
        corners_mm: moved.iter().map(|p| axes.map(|k| p[k])).collect(),
        times,
        identified: answer.is_some(),
    })
}

/// Smallest and largest corner of the robot at some of these poses, mm.
pub(crate) fn extent<'q>(
    robot: &Robot,
    poses: impl Iterator<Item = Vec<f64>> + 'q,
) -> [[f64; 3]; 2] {
    let skeleton = Skeleton::new(robot, &Point3::origin());
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for corner in poses.filter_map(|q| skeleton.at(&q)).flatten() {
        for k in 0..3 {
            ends[0][k] = ends[0][k].min(corner[k]);
            ends[1][k] = ends[1][k].max(corner[k]);
        }
    }
    ends
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gui::commands::Command;
    use crate::gui::edit::Edit;
    use crate::gui::testing::workbench;
    use crate::kinematics::{Joint, Pose};

    /// An arm with six joints: base, shoulder, elbow and a wrist whose axes meet.
    fn arm() -> Robot {
        let joint = |name: &str, along: [f64; 3], at: [f64; 3]| {
            let axis = Axis::through(Vector3::from(along), Point3::from(at)).expect("an axis");
            Joint::new(name, JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: vec![
                joint("base", [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
                joint("shoulder", [0.0, 1.0, 0.0], [150.0, 0.0, 450.0]),
                joint("elbow", [0.0, 1.0, 0.0], [150.0, 0.0, 1050.0]),
                joint("roll", [1.0, 0.0, 0.0], [150.0, 0.0, 1150.0]),
                joint("pitch", [0.0, 1.0, 0.0], [800.0, 0.0, 1150.0]),
                joint("flange", [1.0, 0.0, 0.0], [800.0, 0.0, 1150.0]),
            ],
            base_from_tool: Pose::translation(900.0, 0.0, 1150.0),
            gravity_m_s2: None,
        }
    }

    #[test]
    fn a_column_is_a_mast_and_an_arm() {
        let workbench = workbench();
        let robot = &workbench.subject().session.robot;
        let corners = Skeleton::new(robot, &Point3::origin()).at(&[0.0]);
        let expected = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 300.0],
            [250.0, 0.0, 300.0],
        ];
        let corners = corners.expect("a pose");
        for (corner, expected) in corners.iter().zip(expected) {
            assert!(
                (corner - Point3::from(expected)).norm() < 1e-9,
                "{corners:?}"
            );
        }
    }

    #[test]
    fn the_chain_of_an_arm_ends_where_its_kinematics_say_and_links_keep_their_lengths() {
        let robot = arm();
        let target = Point3::new(10.0, 20.0, 30.0);
        let skeleton = Skeleton::new(&robot, &target);
        let lengths = |corners: &[Point3<f64>]| -> Vec<f64> {
            corners.windows(2).map(|p| (p[1] - p[0]).norm()).collect()
        };
        let home = lengths(&skeleton.at(&[0.0; 6]).expect("a pose"));
        assert!(home.iter().sum::<f64>() < 3_000.0, "{home:?}");
        for q in [
            [0.3, -0.4, 0.5, -0.6, 0.7, -0.8],
            [2.0, 0.1, -1.2, 3.0, 1.0, 0.2],
        ] {
            let corners = skeleton.at(&q).expect("a pose");
            assert_eq!(corners.len(), 2 * 6 + 2);
            let tool = robot.point_in_base(&q, &target);
            assert!((corners[13] - tool).norm() < 1e-9);
            for (here, at_home) in lengths(&corners).iter().zip(&home) {
                assert!((here - at_home).abs() < 1e-9, "a rigid link");
            }
        }
    }

    #[test]
    fn a_joint_that_slides_draws_its_way() {
        let axis = Axis::through(Vector3::x(), Point3::origin()).expect("an axis");
        let robot = Robot {
            joints: vec![Joint::new("rail", JointKind::Prismatic, axis)],
            ..arm()
        };
        let corners = Skeleton::new(&robot, &Point3::origin()).at(&[500.0]);
        let corners = corners.expect("a pose");
        let tool = corners.last().expect("a tool");
        assert!((tool - Point3::new(1400.0, 0.0, 1150.0)).norm() < 1e-9);
    }

    #[test]
    fn what_is_no_pose_draws_no_robot() {
        let robot = arm();
        let skeleton = Skeleton::new(&robot, &Point3::origin());
        assert_eq!(skeleton.at(&[0.0; 5]), None);
        assert_eq!(skeleton.at(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]), None);
    }

    #[test]
    fn the_robot_stands_at_the_chosen_sample_and_else_at_one_as_an_example() {
        let mut workbench = workbench();
        let faint = Drawn::of(&workbench).expect("there are samples");
        assert!(!faint.asked_for && faint.says().contains("as an example"));
        workbench.execute(Command::Select(Some(30)));
        let chosen = Drawn::of(&workbench).expect("there are samples");
        assert!(chosen.asked_for);
        assert_eq!(chosen.says(), "robot at sample 31: pan 0°");
        workbench.execute(Command::Hover(Some(0)));
        let hovered = Drawn::of(&workbench).expect("there are samples");
        assert_eq!(hovered.says(), "robot at sample 1: pan −90°");
    }

    #[test]
    fn the_real_robot_is_displaced_by_the_magnified_deviation_and_never_off_the_plot() {
        let mut workbench = workbench();
        workbench.execute(Command::Select(Some(30)));
        let displacement = |workbench: &Workbench| {
            let drawn = Drawn::of(workbench).expect("there are samples");
            let real = drawn.real.expect("it was measured");
            let (a, b) = (drawn.nominal_mm[3], real.corners_mm[3]);
            assert_eq!(drawn.nominal_mm[2], real.corners_mm[2], "the mast stays");
            (
                (b[0] - a[0]).hypot(b[1] - a[1]),
                real.times,
                real.identified,
            )
        };
        let e = workbench.subject().deviation_before(30);
        workbench.execute(Command::Magnify(Some(2.0)));
        let (moved, times, identified) = displacement(&workbench);
        assert!((moved - 2.0 * e[0].hypot(e[1])).abs() < 1e-9);
        assert!(times == 2.0 && !identified);
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        workbench.execute(Command::Magnify(Some(5000.0)));
        let (moved, times, identified) = displacement(&workbench);
        assert!(identified && times < 5000.0);
        assert!(moved <= MOST_DISPLACED * workbench.subject().overview.reach_mm + 1e-9);
    }

    #[test]
    fn everything_of_the_robot_is_within_the_plots_bounds() {
        let mut workbench = workbench();
        for plane in Plane::ALL {
            workbench.execute(Command::Look(plane));
            let scene = super::super::super::model::Scene::of(&workbench);
            let [low, high] = super::super::super::layout::bounds(&scene);
            let drawn = Drawn::of(&workbench).expect("there are samples");
            for p in &drawn.nominal_mm {
                assert!((0..2).all(|k| low[k] <= p[k] && p[k] <= high[k]), "{p:?}");
            }
        }
        let subject = Arc::clone(workbench.subject());
        assert_eq!(subject.overview.robot_mm[0][2], 0.0);
    }
}
