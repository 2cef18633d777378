//! The robot that is drawn, at which pose: the nominal one, and the real one beside it.
//!
//! The real robot is the nominal chain with its tool displaced by the deviation, magnified as vectors
//! are. What its joints between do the tool alone cannot tell: the displacement grows evenly along the
//! chain from where the first axis lets go of it, which for a column is exact.

pub(super) mod body;

use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::core::quantity::joint_value;
use crate::gui::core::scale::round_down;
use crate::gui::core::skeleton::Skeleton;
use crate::gui::workbench::Workbench;
use crate::kinematics::{JointKind, Robot};

use super::model::magnification;

/// The real robot is displaced by no more than this part of the workspace.
const MOST_DISPLACED: f64 = 0.3;

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
pub(crate) struct JointSymbol {
    pub(crate) at_mm: Point3<f64>,
    /// Its axis, a unit vector of the measuring frame.
    pub(crate) axis: [f64; 3],
    /// Whether it turns (else it slides).
    pub(crate) turns: bool,
}

/// The robot beside the nominal one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Real {
    /// From base to tool, mm.
    pub(crate) corners_mm: Vec<Point3<f64>>,
    /// How many times its deviation is drawn.
    pub(crate) times: f64,
    /// Whether that is the identified robot (else it is as it was measured).
    pub(crate) identified: bool,
}

/// The robot as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawn {
    /// The sample; `None`: the pose was not measured.
    pub(crate) sample: Option<usize>,
    /// Whether the user points at that sample, chose it, or posed the robot.
    pub(crate) asked_for: bool,
    /// The joint values, rad or mm.
    pub(crate) q: Vec<f64>,
    /// The nominal robot from base to tool, mm of the measuring frame.
    pub(crate) corners_mm: Vec<Point3<f64>>,
    pub(crate) real: Option<Real>,
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
        let posed = view.pose.clone();
        let sample = asked.or(middle).filter(|_| posed.is_none());
        let q = posed.or_else(|| sample.map(pose));
        let q = q.unwrap_or_else(|| home(robot));
        let targets = &loaded_session.session.targets;
        let target = sample.and_then(|s| Some(loaded_session.session.samples.target.as_ref()?[s]));
        let target = targets.get(target.map_or(0, |t| t as usize));
        let target_mm = target.map_or_else(Point3::origin, |t| t.position_mm);
        let base = workbench.base();
        let corners = Skeleton::new(robot, &target_mm).at(&q)?;
        let corners: Vec<_> = corners.iter().map(|p| base * p).collect();
        let units = workbench.units();
        let values = robot
            .joints
            .iter()
            .zip(&q)
            .map(|(joint, q)| (joint.name.clone(), joint_value(units, joint.kind, *q)));
        Some(Self {
            sample,
            asked_for: asked.is_some() || view.pose.is_some(),
            q: q.clone(),
            real: sample.and_then(|sample| real(workbench, sample, &corners)),
            signs: signs(robot, &q, &base, &corners),
            values: values.collect(),
            corners_mm: corners,
        })
    }

    /// A robot by itself at home, without a session.
    pub(crate) fn alone(robot: &Robot) -> Option<Self> {
        let q = home(robot);
        let corners = Skeleton::new(robot, &Point3::origin()).at(&q)?;
        Some(Self {
            sample: None,
            asked_for: true,
            real: None,
            signs: signs(robot, &q, &Isometry3::identity(), &corners),
            values: Vec::new(),
            corners_mm: corners,
            q,
        })
    }

    /// In words: which sample, at which joint values.
    pub(crate) fn describe(&self) -> String {
        let mut says = match (self.sample, self.asked_for) {
            (Some(sample), true) => say!("robot at sample {sample}", sample = sample + 1),
            (Some(sample), false) => say!(
                "robot at sample {sample}, as an example",
                sample = sample + 1
            ),
            (None, true) => say!("robot as posed").to_owned(),
            (None, false) => say!("robot at home").to_owned(),
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

fn real(workbench: &Workbench, sample: usize, corners: &[Point3<f64>]) -> Option<Real> {
    let loaded_session = &**workbench.loaded_session();
    if !loaded_session.usable[sample] {
        return None;
    }
    let answer = workbench.answer();
    // What the model says is what was measured without what is left.
    let left = answer.map_or([0.0; 3], |answer| answer.deviation_after(sample));
    let real = Vector3::from(loaded_session.measured(sample)) - Vector3::from(left);
    let deviation = real - corners.last()?.coords;
    let length = deviation.norm();
    if !length.is_finite() {
        return None;
    }
    let wanted = magnification(workbench);
    let most = MOST_DISPLACED * loaded_session.overview.reach_mm / length.max(1e-9);
    let times = if wanted <= most {
        wanted
    } else {
        round_down(most).max(1.0)
    };
    let moved = displaced(corners, deviation * times);
    Some(Real {
        corners_mm: moved,
        times,
        identified: answer.is_some(),
    })
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
        assert!(!faint.asked_for && faint.describe().contains("as an example"));
        workbench.execute(|bench| bench.view.select(Some(30)));
        let chosen = Drawn::of(&workbench).expect("there are samples");
        assert!(chosen.asked_for);
        assert_eq!(chosen.describe(), "robot at sample 31: pan 0°");
        workbench.execute(|bench| bench.view.hovered = Some(0));
        let hovered = Drawn::of(&workbench).expect("there are samples");
        assert_eq!(hovered.describe(), "robot at sample 1: pan −90°");
    }

    #[test]
    fn the_real_robot_is_displaced_by_the_magnified_deviation_and_never_off_the_plot() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.select(Some(30)));
        let displacement = |workbench: &Workbench| {
            let drawn = Drawn::of(workbench).expect("there are samples");
            let real = drawn.real.expect("it was measured");
            let (a, b) = (drawn.corners_mm[3], real.corners_mm[3]);
            assert_eq!(drawn.corners_mm[2], real.corners_mm[2], "the mast stays");
            (
                (b[0] - a[0]).hypot(b[1] - a[1]),
                real.times,
                real.identified,
            )
        };
        let e = workbench.loaded_session().deviation_before(30);
        workbench.execute(|bench| bench.view.magnification = Some(2.0));
        let (moved, times, identified) = displacement(&workbench);
        assert!((moved - 2.0 * e[0].hypot(e[1])).abs() < 1e-9);
        assert!(times == 2.0 && !identified);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        workbench.execute(|bench| bench.view.magnification = Some(5000.0));
        let (moved, times, identified) = displacement(&workbench);
        assert!(identified && times < 5000.0);
        assert!(moved <= MOST_DISPLACED * workbench.loaded_session().overview.reach_mm + 1e-9);
    }

    #[test]
    fn everything_of_the_robot_is_within_the_plots_bounds() {
        let mut workbench = workbench();
        for plane in Plane::ALL {
            workbench.execute(|bench| bench.view.look_in(plane));
            let shown = crate::gui::workspace::model::Shown::of(&workbench);
            let [low, high] = crate::gui::workspace::layout::bounds(&shown);
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
