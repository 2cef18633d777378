//! The joint values that bring the nominal tool to a pose: from a start, and all of them.
//!
//! ```text
//! least |(p(q) − p)/L|² + |log(R(q)ᵀ R)|²  over the free joints,   L the robot's reach
//! ```
//!
//! Levenberg–Marquardt (Marquardt 1963) on the exact Jacobian, for any chain. All solutions are
//! those that many starts lead to: what was found before, mirror images of it, and points that are
//! spread evenly over the joints' travel (Halton 1960). The starts are always the same, and so is
//! the answer. A robot with more joints than the pose asks for has endlessly many solutions; for it
//! only the one nearest to a start means anything. Arms of the usual shapes have all their solutions at once
//! (`closed_form`).

use std::f64::consts::{PI, TAU};

use crate::{budget, rounding};

use nalgebra::{DMatrix, DVector, Point3, UnitQuaternion, Vector3};

use super::closed_form::ClosedForm;
use super::joint_kind::JointKind;
use super::pose::Pose;
use super::quaternion;
use super::robot::{Robot, value_of};

/// Starts that are spread over the travel.
const STARTS: usize = 72;
/// A pose is reached when no more than this is missing, mm: files round to hundredths.
pub const REACHED_MM: f64 = 0.02;
/// The same for the orientation, rad.
pub const REACHED_RAD: f64 = 2e-4;
/// Solutions nearer to each other than this (rad, or the same part of the reach) are one.
const SAME: f64 = 1e-5;
/// Solutions of the closed form nearer than this (rad) are searched for: a file rounds more.
const NEARBY: f64 = 1e-3;

/// Where the tool is to go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// The tool's origin in the base frame, mm.
    pub position_mm: Point3<f64>,
    /// The tool frame's orientation in the base frame; `None`: any.
    pub rotation: Option<UnitQuaternion<f64>>,
}

impl Goal {
    /// A whole pose.
    pub fn pose(pose: &Pose) -> Self {
        Self {
            position_mm: pose.translation.vector.into(),
            rotation: Some(pose.rotation),
        }
    }

    /// How many numbers it asks for.
    fn size(&self) -> usize {
        if self.rotation.is_some() { 6 } else { 3 }
    }
}

/// A robot of which some joints are free to reach a goal.
#[derive(Debug, Clone)]
pub struct Inverse<'a> {
    robot: &'a Robot,
    free: Vec<usize>,
    reach_mm: f64,
    /// All solutions at once, of an arm that has a shape for it.
    closed: Option<ClosedForm>,
}

impl<'a> Inverse<'a> {
    /// The joints in `free` (counted from 0) move; the others stay where a start puts them.
    pub fn new(robot: &'a Robot, free: &[usize]) -> Self {
        let closed = ClosedForm::of(robot).filter(|_| free == [0, 1, 2, 3, 4, 5]);
        Self {
            robot,
            free: robot.leading(free),
            reach_mm: robot.reach_mm(),
            closed,
        }
    }

    /// Whether the goal has isolated solutions for the free joints, not whole lines of them.
    pub fn is_determined(&self, goal: &Goal) -> bool {
        self.free.len() <= goal.size()
    }

    /// The solution that a start (one value per joint, rad or mm) leads to; limits play no part.
    pub fn from_start(&self, goal: &Goal, start: &[f64]) -> Option<Vec<f64>> {
        let mut q = self.one_value_per_joint(start);
        self.robot.follow(&mut q);
        let mut left = self.missing(goal, &q);
        let mut damping = 1e-3;
        for _ in 0..budget::STEPS {
            let jacobian = self.jacobian(goal, &q);
            let normal = jacobian.transpose() * &jacobian;
            let downhill = jacobian.transpose() * &left;
            let step = self.damped(&normal, &downhill, damping)?;
            let trial = self.stepped(&q, &step);
            let trial_left = self.missing(goal, &trial);
            if trial_left.norm_squared() <= left.norm_squared() {
                (q, left) = (trial, trial_left);
                damping = (damping * 0.1).max(f64::EPSILON);
                if step.amax() < rounding::LAST_BITS {
                    break;
                }
            } else if damping * rounding::LAST_BITS > 1.0 || step.amax() < rounding::LAST_BITS {
                break;
            } else {
                damping *= 10.0;
            }
        }
        self.is_reached(goal, &q).then_some(q)
    }

    /// Every solution within the limits (of a joint without: within a turn either way), in a fixed
    /// order. `fixed` has the values of the joints that are not free; `known` are solutions of a
    /// goal near by, which help to find all of these quickly.
    pub fn all(&self, goal: &Goal, fixed: &[f64], known: &[Vec<f64>]) -> Vec<Vec<f64>> {
        if let Some(found) = self.closed(goal) {
            return self.in_order(found);
        }
        let mut found: Vec<Vec<f64>> = Vec::new();
        let mut starts: Vec<Vec<f64>> = known.to_vec();
        starts.extend((0..STARTS).map(|k| self.spread(fixed, k)));
        // Mirror images of what is found are starts as well.
        let mut next = 0;
        while next < starts.len() && found.len() < MOST_SOLUTIONS {
            if let Some(solution) = self.from_start(goal, &starts[next]) {
                let solution = self.wound_back(solution);
                if found.iter().all(|f| self.distance(f, &solution) > SAME) {
                    starts.extend(self.mirrored(&solution));
                    found.push(solution);
                }
            }
            next += 1;
        }
        self.in_order(found)
    }

    /// The solutions of the closed form; `None` where it has none to give, or may have lost one.
    fn closed(&self, goal: &Goal) -> Option<Vec<Vec<f64>>> {
        let closed = self.closed.as_ref()?;
        let pose = Pose::from_parts(goal.position_mm.coords.into(), goal.rotation?);
        let all = closed.solutions(&pose)?;
        let mut found: Vec<Vec<f64>> = Vec::with_capacity(all.len());
        for q in all {
            if !self.is_reached(goal, &q) {
                return None;
            }
            let q = self.wound_back(q.to_vec());
            // Two that fall together are the border of a singular pose.
            if found.iter().any(|f| self.distance(f, &q) < NEARBY) {
                return None;
            }
            found.push(q);
        }
        // None at all may be a pose at the very end of the reach.
        (!found.is_empty()).then_some(found)
    }

    fn in_order(&self, mut found: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        found.sort_by(|a, b| {
            let pairs = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
            pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        });
        found.iter().flat_map(|q| self.turns(q)).collect()
    }

    /// How far apart two sets of joint values are: rad, sliding joints by parts of the reach.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let squares = self.free.iter().map(|j| {
            let by = (value_of(a, *j) - value_of(b, *j)) / self.unit(*j);
            by * by
        });
        squares.sum::<f64>().sqrt()
    }

    fn unit(&self, joint: usize) -> f64 {
        match self.robot.joints[joint].kind {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => self.reach_mm,
        }
    }

    fn missing(&self, goal: &Goal, q: &[f64]) -> DVector<f64> {
        let here = self.robot.base_from_tool(q);
        let way = (goal.position_mm.coords - here.translation.vector) / self.reach_mm;
        let mut missing: Vec<f64> = way.iter().copied().collect();
        if let Some(rotation) = &goal.rotation {
            let turn = quaternion::log(&(rotation * here.rotation.inverse()));
            missing.extend(turn.iter());
        }
        DVector::from_vec(missing)
    }

    fn jacobian(&self, goal: &Goal, q: &[f64]) -> DMatrix<f64> {
        let here = self.robot.base_from_tool(q);
        let tool = Point3::from(here.translation.vector);
        let twists = self.robot.joint_twists(q);
        let mut jacobian = DMatrix::zeros(goal.size(), self.free.len());
        for (column, joint) in self.free.iter().enumerate() {
            let unit = self.unit(*joint);
            let mut way: Vector3<f64> = twists[*joint].velocity_at(&tool) * (unit / self.reach_mm);
            let mut turn = twists[*joint].angular * unit;
            for (follower, ratio) in self.robot.followers(*joint) {
                way += twists[follower].velocity_at(&tool) * (ratio * unit / self.reach_mm);
                turn += twists[follower].angular * (ratio * unit);
            }
            for axis in 0..3 {
                jacobian[(axis, column)] = way[axis];
                if goal.rotation.is_some() {
                    jacobian[(axis + 3, column)] = turn[axis];
                }
            }
        }
        jacobian
    }

    fn damped(
        &self,
        normal: &DMatrix<f64>,
        downhill: &DVector<f64>,
        damping: f64,
    ) -> Option<DVector<f64>> {
        let n = self.free.len();
        let mean = normal.trace() / n.max(1) as f64;
        let damped = normal + DMatrix::identity(n, n) * (damping * mean + f64::MIN_POSITIVE);
        let step = damped.cholesky()?.solve(downhill);
        step.iter().all(|v| v.is_finite()).then_some(step)
    }

    fn stepped(&self, q: &[f64], step: &DVector<f64>) -> Vec<f64> {
        let mut q = q.to_vec();
        // More than a quarter turn at once leads anywhere.
        let shrink = (0.25 * TAU / step.amax().max(f64::MIN_POSITIVE)).min(1.0);
        for (joint, by) in self.free.iter().zip(step.iter()) {
            q[*joint] += by * shrink * self.unit(*joint);
        }
        self.robot.follow(&mut q);
        q
    }

    /// Whether the tool is at the goal.
    pub fn is_reached(&self, goal: &Goal, q: &[f64]) -> bool {
        let here = self.robot.base_from_tool(q);
        let way = goal.position_mm.coords - here.translation.vector;
        let turn = goal.rotation.map_or(0.0, |r| r.angle_to(&here.rotation));
        way.norm() <= REACHED_MM && turn <= REACHED_RAD
    }

    /// A pose as the search needs it: no value more or less than there are joints.
    fn one_value_per_joint(&self, q: &[f64]) -> Vec<f64> {
        let joints = 0..self.robot.joints.len();
        joints.map(|joint| value_of(q, joint)).collect()
    }

    /// Point k of an even spread over the travel of the free joints; the others as in `fixed`.
    pub fn spread(&self, fixed: &[f64], k: usize) -> Vec<f64> {
        let mut q = self.one_value_per_joint(fixed);
        for (joint, prime) in self.free.iter().zip(PRIMES.iter().cycle()) {
            let share = radical_inverse(k.saturating_add(1), *prime);
            let limits = self.robot.joints[*joint].limits;
            let (from, to) = match self.robot.joints[*joint].kind {
                // More than a turn has nothing new.
                JointKind::Revolute => {
                    limits.map_or((-PI, PI), |l| (l.from.max(-PI), l.to.min(PI)))
                }
                JointKind::Prismatic => {
                    limits.map_or((-self.reach_mm, self.reach_mm), |l| (l.from, l.to))
                }
            };
            q[*joint] = from + share * (to - from);
        }
        self.robot.follow(&mut q);
        q
    }

    /// Where other solutions of the same goal are likely: wrist, elbow and shoulder turned over.
    fn mirrored(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let turns: Vec<usize> = self
            .free
            .iter()
            .copied()
            .filter(|j| self.turns_round(*j))
            .collect();
        let mut mirrored = Vec::new();
        for window in turns.windows(3) {
            let mut other = q.to_vec();
            other[window[0]] += PI;
            other[window[1]] = -other[window[1]];
            other[window[2]] += PI;
            mirrored.push(self.wound_back(other));
        }
        for joint in &turns {
            for by in [-other_side(q[*joint]), PI] {
                let mut other = q.to_vec();
                other[*joint] += by;
                mirrored.push(self.wound_back(other));
            }
        }
        mirrored
    }

    fn turns_round(&self, joint: usize) -> bool {
        self.robot.joints[joint].kind == JointKind::Revolute
    }

    /// Every free turning joint within half a turn of its zero.
    fn wound_back(&self, mut q: Vec<f64>) -> Vec<f64> {
        for joint in self.free.iter().filter(|j| self.turns_round(**j)) {
            q[*joint] -= TAU * (q[*joint] / TAU).round();
        }
        self.robot.follow(&mut q);
        q
    }

    /// The same pose with whole turns of joints more or less, as far as the limits allow.
    fn turns(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let mut all = vec![q.to_vec()];
        for joint in &self.free {
            let limits = self.robot.joints[*joint].limits;
            let steps: &[f64] = if self.turns_round(*joint) {
                &[0.0, -TAU, TAU]
            } else {
                &[0.0]
            };
            let mut further = Vec::new();
            for q in &all {
                for by in steps {
                    let value = q[*joint] + by;
                    let inside = match limits {
                        Some(l) => {
                            value >= l.from - rounding::WRITTEN && value <= l.to + rounding::WRITTEN
                        }
                        None => *by == 0.0 || value.abs() <= TAU,
                    };
                    if inside && further.len() < MOST_SOLUTIONS {
                        let mut q = q.clone();
                        q[*joint] = value;
                        self.robot.follow(&mut q);
                        further.push(q);
                    }
                }
            }
            all = further;
        }
        all
    }
}

/// Twice the way to zero: from a bent elbow to the one bent the other way.
fn other_side(value: f64) -> f64 {
    2.0 * value
}

/// More are a pose through which lines of solutions run.
const MOST_SOLUTIONS: usize = 512;
const PRIMES: [usize; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// The digits of `k` in base `base`, mirrored at the point: from 0 to 1.
fn radical_inverse(mut k: usize, base: usize) -> f64 {
    let (mut sum, mut part) = (0.0, 1.0);
    while k > 0 {
        part /= base as f64;
        sum += (k % base) as f64 * part;
        k /= base;
    }
    sum
}

impl Robot {
    /// The longest distance that matters, mm: of the tool and of any axis from the base, and of the
    /// tool from any axis, at home; at least 1.
    pub fn reach_mm(&self) -> f64 {
        let tool = self.base_from_tool.translation.vector;
        let points = self.joints.iter().map(|joint| joint.axis.point_mm.coords);
        let far = points.map(|p| p.norm().max((tool - p).norm()));
        far.fold(tool.norm(), f64::max).max(1.0)
    }

    /// How far the tool is from the first axis along all links at home, and no less than from the base, mm.
    #[doc(hidden)]
    pub fn length_along_links_mm(&self) -> f64 {
        let tool = self.base_from_tool.translation.vector;
        let points = self.joints.iter().map(|joint| joint.axis.point_mm.coords);
        let points: Vec<_> = points.chain([tool]).collect();
        let links = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        links.sum::<f64>().max(tool.norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{Axis, Joint, Range};

    fn arm(limit_deg: f64) -> Robot {
        let rows: [([f64; 3], [f64; 3]); 6] = [
            ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            ([0.0, 1.0, 0.0], [30.0, 0.0, 330.0]),
            ([0.0, 1.0, 0.0], [30.0, 0.0, 640.0]),
            ([1.0, 0.0, 0.0], [30.0, 0.0, 710.0]),
            ([0.0, 1.0, 0.0], [340.0, 0.0, 710.0]),
            ([1.0, 0.0, 0.0], [340.0, 0.0, 710.0]),
        ];
        let joint = |(direction, point): ([f64; 3], [f64; 3])| {
            let axis = Axis::through(direction.into(), point.into()).unwrap();
            let mut joint = Joint::new("j", JointKind::Revolute, axis);
            joint.limits = Some(Range {
                from: -limit_deg.to_radians(),
                to: limit_deg.to_radians(),
            });
            joint
        };
        Robot {
            name: "arm".to_owned(),
            joints: rows.into_iter().map(joint).collect(),
            base_from_tool: Pose::translation(420.0, 15.0, 730.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    #[test]
    fn a_spherical_wrist_has_eight_solutions_and_all_of_them_reach() {
        let robot = arm(180.0);
        let inverse = Inverse::new(&robot, &[0, 1, 2, 3, 4, 5]);
        for k in 0..20 {
            let q: Vec<f64> = (0..6)
                .map(|j| 1.2 * (f64::from(k) * 1.7 + f64::from(j) * 2.3).sin() + 0.3)
                .collect();
            let goal = Goal::pose(&robot.base_from_tool(&q));
            let all = inverse.all(&goal, &[0.0; 6], &[]);
            assert!(all.iter().all(|q| inverse.is_reached(&goal, q)));
            assert!(all.iter().any(|a| inverse.distance(a, &q) < 1e-8), "{k}");
            assert!(
                all.len().is_multiple_of(2) && all.len() <= 8,
                "{k}: {}",
                all.len()
            );
            assert!(all.len() >= 4, "{k}: {}", all.len());
        }
    }

    #[test]
    fn whole_turns_count_where_the_limits_allow_them() {
        let narrow = arm(180.0);
        let wide = arm(360.0);
        let q = [0.3, 0.4, -0.2, 0.9, 0.7, -1.1];
        let goal = Goal::pose(&narrow.base_from_tool(&q));
        let count = |robot: &Robot| {
            let inverse = Inverse::new(robot, &[0, 1, 2, 3, 4, 5]);
            inverse.all(&goal, &[0.0; 6], &[]).len()
        };
        assert!(count(&wide) > count(&narrow));
    }

    #[test]
    fn a_value_stands_on_its_limit_and_not_beyond() {
        let robot = arm(170.0);
        let inverse = Inverse::new(&robot, &[3]);
        let at = |q4_deg: f64| vec![0.0, 0.0, 0.0, q4_deg.to_radians(), 0.0, 0.0];
        let turns = |q4_deg| inverse.turns(&at(q4_deg)).len();
        assert_eq!([turns(170.0), turns(170.01), turns(-170.0)], [1, 0, 1]);
        // A whole turn away it is within them again.
        let back = inverse.turns(&at(200.0));
        assert_eq!(back.len(), 1);
        assert!((back[0][3].to_degrees() + 160.0).abs() < 1e-9);
    }

    #[test]
    fn out_of_reach_there_is_none() {
        let robot = arm(180.0);
        let inverse = Inverse::new(&robot, &[0, 1, 2, 3, 4, 5]);
        let goal = Goal::pose(&Pose::translation(5000.0, 0.0, 0.0));
        assert!(inverse.all(&goal, &[0.0; 6], &[]).is_empty());
    }
}
