//! Which joint values a target means.

use std::f64::consts::TAU;

use crate::compensation::pose::is_singular;
use crate::kinematics::configuration::{Statement, turns_of};
use crate::kinematics::inverse::{Goal, Inverse};
use crate::kinematics::{JointKind, Pose, Robot};
use crate::text::Text;

use super::answer::{Reason, SkippedTarget};
use super::axes::Axes;
use super::convention::Convention;
use super::target::{Shape, Target};

/// Two solutions are equally near when the farther one is not farther than this times as far.
const AS_NEAR: f64 = 1.1;
/// As many solutions of one pose help to find those of the next.
const MOST_KNOWN: usize = 16;
/// Joint values nearer to each other than this (rad or mm) are the same.
const SAME: f64 = 1e-5;
/// A limit is kept to this, rad or mm.
const ON_THE_LIMIT: f64 = 1e-9;

/// A target as joint values and as the pose that the nominal tool has there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Resolved {
    pub(super) q: Vec<f64>,
    pub(super) pose: Pose,
}

/// Finds the joint values that targets mean. Targets have to come in the order in which they are gone to.
pub(super) struct Resolver<'a> {
    robot: &'a Robot,
    convention: Convention<'a>,
    free: Vec<usize>,
    inverse: Inverse<'a>,
    /// Joint values of the target before.
    before: Option<Vec<f64>>,
    /// All solutions of the pose before: the next ones are not far.
    previous_solutions: Vec<Vec<f64>>,
}

impl<'a> Resolver<'a> {
    /// `start`: joint values before the first target, raw.
    pub(super) fn new(
        robot: &'a Robot,
        axes: &Axes,
        convention: Convention<'a>,
        mut start: Option<Vec<f64>>,
    ) -> Self {
        if let Some(start) = &mut start {
            convention.to_model(start);
        }
        Self {
            robot,
            convention,
            free: axes.free(),
            inverse: Inverse::new(robot, &axes.free()),
            before: start,
            previous_solutions: Vec::new(),
        }
    }

    pub(super) fn resolve(&mut self, target: &Target) -> Result<Resolved, SkippedTarget> {
        if let Some(left) = &target.left {
            return Err((**left).clone());
        }
        let pose;
        let q = match &target.shape {
            Shape::Joints {
                numbers, scales, ..
            } => {
                let values = numbers.iter().zip(scales.iter());
                let mut q: Vec<f64> = values.map(|(number, scale)| number.value * scale).collect();
                self.convention.to_model(&mut q);
                self.check_limits(&q)?;
                pose = self.robot.base_from_tool(&q);
                q
            }
            Shape::Pose(frame) => {
                let Some(goal) = frame.goal() else {
                    return left(Reason::Unreachable, text!("its orientation is not valid"));
                };
                let goal = target.placed.goal(&goal);
                let q = self.solution(target, &goal)?;
                let here = self.robot.base_from_tool(&q);
                let rotation = goal.rotation.unwrap_or(here.rotation);
                pose = Pose::from_parts(goal.position_mm.coords.into(), rotation);
                q
            }
        };
        self.before = Some(q.clone());
        Ok(Resolved { q, pose })
    }

    fn check_limits(&self, q: &[f64]) -> Result<(), SkippedTarget> {
        let Some(beyond) = first_beyond(self.robot, q) else {
            return Ok(());
        };
        let [value, limit] = beyond.shown(self.robot);
        let says = text!(
            "joint {joint} is at {value} in the file, beyond its limit of {limit}",
            joint = beyond.joint + 1,
            value,
            limit
        );
        left(Reason::Unreachable, says)
    }

    fn solution(&mut self, target: &Target, goal: &Goal) -> Result<Vec<f64>, SkippedTarget> {
        let posture = target.posture();
        let mut fixed = vec![0.0; self.robot.joints.len()];
        for (joint, value) in &posture.external {
            fixed[*joint] = *value;
        }
        self.convention.to_model(&mut fixed);
        let with_external = |q: &mut Vec<f64>| {
            for (joint, _) in &posture.external {
                q[*joint] = fixed[*joint];
            }
        };
        let mut near = self.before.clone();
        if let Some(mut stated) = posture.near.clone() {
            self.convention.to_model(&mut stated);
            near = Some(stated);
        }
        near.iter_mut().for_each(with_external);
        if !self.inverse.is_determined(goal) {
            return self.nearest_of_a_line(goal, near.as_deref());
        }
        let mut known = self.previous_solutions.clone();
        known.iter_mut().for_each(with_external);
        let all = self.inverse.all(goal, &fixed, &known);
        if all.is_empty() {
            let says = text!("no joint values within the limits reach it");
            return left(Reason::Unreachable, says);
        }
        let possible = self.as_stated(target, &all)?;
        // Solutions that differ by whole turns lead to the same ones.
        let turns = |q: &&Vec<f64>| {
            let mut pairs = self.robot.joints.iter().zip(q.iter());
            pairs.any(|(joint, q)| joint.kind == JointKind::Revolute && turns_of(*q) != 0)
        };
        let once = all.iter().filter(|q| !turns(q)).take(MOST_KNOWN);
        self.previous_solutions = once.cloned().collect();
        self.nearest(possible, near.as_deref())
    }

    /// A robot with more joints than the pose asks for goes there from where it is.
    fn nearest_of_a_line(
        &self,
        goal: &Goal,
        near: Option<&[f64]>,
    ) -> Result<Vec<f64>, SkippedTarget> {
        let Some(near) = near else {
            let says = text!(
                "several joint values reach it, and no earlier target determines which: --start says where the robot comes from"
            );
            return left(Reason::Ambiguous, says);
        };
        let Some(q) = self.inverse.from_start(goal, near) else {
            let says = text!("no solution near the previous target reaches it");
            return left(Reason::Unreachable, says);
        };
        self.check_limits(&q)?;
        Ok(q)
    }

    /// The solutions that have the stated configuration. What is certain has to be met; what makers
    /// define each for their own arms decides between what is left.
    fn as_stated(&self, target: &Target, all: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, SkippedTarget> {
        let stated = target.posture().configuration.iter();
        let (certain, sides): (Vec<&Statement>, Vec<&Statement>) =
            stated.partition(|statement| statement.is_certain());
        let meets = |q: &[f64], s: &Statement| s.agrees(self.robot, q) != Some(false);
        let all = all.iter().filter(|q| certain.iter().all(|s| meets(q, s)));
        let mut possible: Vec<Vec<f64>> = all.cloned().collect();
        if possible.is_empty() {
            let says = text!("joint values reach it, but none with its configuration");
            return left(Reason::Unreachable, says);
        }
        for side in sides {
            if possible.iter().any(|q| meets(q, side)) {
                possible.retain(|q| meets(q, side));
            }
        }
        Ok(possible)
    }

    /// Of joint values that differ by whole turns only those nearest to zero: the pose is the same.
    fn with_fewest_turns(&self, mut possible: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let zero = vec![0.0; self.robot.joints.len()];
        let far = |q: &Vec<f64>| self.inverse.distance(q, &zero);
        possible.sort_by(|a, b| far(a).total_cmp(&far(b)));
        let mut kept: Vec<Vec<f64>> = Vec::new();
        for q in possible {
            let same = |other: &Vec<f64>| {
                let pairs = self.robot.joints.iter().zip(q.iter().zip(other));
                let mut apart = pairs.map(|(joint, (a, b))| match joint.kind {
                    JointKind::Revolute => (a - b - TAU * ((a - b) / TAU).round()).abs(),
                    JointKind::Prismatic => (a - b).abs(),
                });
                apart.all(|by| by < SAME)
            };
            if !kept.iter().any(same) {
                kept.push(q);
            }
        }
        kept
    }

    fn nearest(
        &self,
        mut possible: Vec<Vec<f64>>,
        near: Option<&[f64]>,
    ) -> Result<Vec<f64>, SkippedTarget> {
        if let Some(near) = near {
            let far = |q: &Vec<f64>| self.inverse.distance(q, near);
            possible.sort_by(|a, b| far(a).total_cmp(&far(b)));
        } else {
            possible = self.with_fewest_turns(possible);
        }
        let says = match (&possible[..], near) {
            ([only], _) => return Ok(only.clone()),
            (_, None) => {
                text!(
                    "several joint values reach it, and no earlier target determines which: --start says where the robot comes from"
                )
            }
            ([first, second, ..], Some(near)) => {
                let far = |q: &[f64]| self.inverse.distance(q, near);
                if far(second) > AS_NEAR * far(first) {
                    return Ok(first.clone());
                }
                text!("two sets of joint values reach it that are as near to the target before")
            }
            ([], Some(_)) => text!("no joint values reach it"),
        };
        if !possible.is_empty() && is_singular(self.robot, &possible[0], &self.free) {
            let says = text!("it is singular: lines of joint values reach it");
            return left(Reason::Singular, says);
        }
        left(Reason::Ambiguous, says)
    }
}

pub(super) fn left<T>(reason: Reason, says: Text) -> Result<T, SkippedTarget> {
    Err(SkippedTarget::new(reason, says))
}

/// A joint beyond a limit.
pub(super) struct BeyondLimit {
    /// Counted from 0.
    pub(super) joint: usize,
    value: f64,
    pub(super) limit: f64,
}

impl BeyondLimit {
    /// Its value and the limit, as people read them.
    pub(super) fn shown(&self, robot: &Robot) -> [String; 2] {
        let kind = robot.joints[self.joint].kind;
        [self.value, self.limit].map(|v| format!("{:.4}{}", kind.to_display(v), kind.sign()))
    }
}

/// The first joint beyond a limit.
pub(super) fn first_beyond(robot: &Robot, q: &[f64]) -> Option<BeyondLimit> {
    let mut joints = robot.joints.iter().zip(q).enumerate();
    joints.find_map(|(k, (joint, value))| {
        let limits = joint.limits?;
        let limit = if *value < limits.from - ON_THE_LIMIT {
            limits.from
        } else if *value > limits.to + ON_THE_LIMIT {
            limits.to
        } else {
            return None;
        };
        Some(BeyondLimit {
            joint: k,
            value: *value,
            limit,
        })
    })
}
