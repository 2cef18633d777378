//! Families of columns that may predict without a name, each with its own strength.
//!
//! Along the motion of a joint: gravity, what the conditions of measuring turn it by, harmonics of its
//! own value and of those of its neighbours, a smooth curve over its range; across the joint's axis and
//! along it: harmonics of its own value (a bearing that runs out or wobbles). What slides is displaced across its motion
//! and turned in three directions by smooth curves over its travel: a guide is never straight. So is a single joint that
//! carries several reflectors, in addition to its curve ([`joint`](super::joint)), which cannot follow them all.

use nalgebra::DMatrix;

use crate::effects::curve::DIRECTIONS;
use crate::effects::rest::{Along, CONDITIONS, MOVES, Rest, RestPoint, UNIT_SAGS, Wave, unit_sag};
use crate::effects::unnamed::asked_at;
use crate::effects::{Inputs, Term};
use crate::kinematics::{JointKind, Robot};
use crate::numeric::extent;
use crate::text::Text;
use crate::thresholds::BENDS;

/// Harmonics of a neighbour's value.
const OF_NEIGHBOURS: usize = 2;

/// Harmonics of a joint's own value.
const HARMONICS: usize = 6;
/// How many joints away a neighbour is at most.
const NEIGHBOURS: usize = 2;
/// Harmonics across a joint's axis.
const ACROSS: usize = 3;
/// The half-waves of what a guide does reach beyond its travel by this factor (Fourier extension; Boyd 2002): those of
/// the travel itself are level at its ends, where a guide that sags between its supports is steepest. Measured
/// (`tests/reference/guides.py --count 4 --seed 3`, error over the noise, without → with it): gantry of 60 poses, bow
/// 1.32 → 1.22; of 200, bow and turns 1.14 → 1.09; rail of 60 1.28 → 1.23; nothing hidden equal.
const BEYOND: f64 = 1.5;

/// How a joint that turns is tilted.
const TILTS: [FamilyKind; 2] = [
    FamilyKind::Tilt(DIRECTIONS + 1),
    FamilyKind::Tilt(DIRECTIONS + 2),
];

/// The kinds of families.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FamilyKind {
    Gravity,
    /// See [`Along::conditions`].
    Condition(usize),
    Harmonics,
    Curve,
    /// Over the value of another joint.
    Over(usize),
    /// Radial (1) or axial (2).
    Across(usize),
    /// A smooth curve across the motion of a joint that slides (1, 2), or about one of its directions (3 to 5).
    Guide(usize),
    /// A smooth curve about one of the directions across the axis of a joint that turns (4, 5).
    Tilt(usize),
    /// A gear's order.
    Order(f64),
}

/// A family of columns of one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Family {
    pub(super) joint: usize,
    pub(super) what: FamilyKind,
}

/// A function of the pose.
#[derive(Debug, Clone, PartialEq)]
enum PoseFunction {
    Sag(usize),
    Condition(usize),
    /// `cos(order (q − from))` of a joint's value.
    Cosine {
        joint: usize,
        order: f64,
        from: f64,
    },
}

impl PoseFunction {
    fn at(&self, at: &RestPoint, sags: &[f64; UNIT_SAGS]) -> f64 {
        match self {
            Self::Sag(k) => sags[*k],
            Self::Condition(k) => at.conditions()[*k],
            Self::Cosine { joint, order, from } => (order * (at.q[*joint] - from)).cos(),
        }
    }
}

/// A column: its function about its mean over the measured poses, and what one standard deviation of its coefficient
/// is at strength 1.
///
/// A constant belongs to the geometry (a zero offset, a frame). Over a narrow range a harmonic is hardly more than
/// one: if both had it, they would run away in opposite directions, and the geometry would be off by all of it where
/// the correction has faded.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Column {
    pub(super) family: usize,
    source: PoseFunction,
    pub(super) size: f64,
    /// Known once its poses were looked at.
    mean: f64,
}

/// All families of a robot.
#[derive(Debug, Clone, Default)]
pub(super) struct Families {
    pub(super) all: Vec<Family>,
    pub(super) columns: Vec<Column>,
    ranges: Vec<[f64; 2]>,
    /// Of the conditions of each joint, once its poses were looked at.
    condition_ranges: Vec<Vec<[f64; 2]>>,
}

impl Families {
    /// Of the poses of these samples.
    pub(super) fn of(robot: &Robot, inputs: &Inputs) -> Self {
        let mut families = Self {
            ranges: inputs.q.iter().map(|q| extent(q.iter())).collect(),
            condition_ranges: vec![Vec::new(); robot.joints.len()],
            ..Self::default()
        };
        for joint in 0..robot.joints.len() {
            families.add_of(robot, joint);
        }
        families
    }

    fn add_of(&mut self, robot: &Robot, joint: usize) {
        let turns = |j: usize| robot.joints[j].kind == JointKind::Revolute;
        let guide: Vec<FamilyKind> = (1..MOVES).map(FamilyKind::Guide).collect();
        if robot.joints.len() == 1 {
            let others = if turns(joint) { &TILTS } else { &*guide };
            self.add_smooth(joint, others);
            return;
        }
        if robot.gravity_m_s2.is_some() && turns(joint) {
            let sags = (0..UNIT_SAGS).map(|k| (PoseFunction::Sag(k), 1.0));
            self.add(joint, FamilyKind::Gravity, sags.collect());
        }
        for k in 0..CONDITIONS {
            self.add(
                joint,
                FamilyKind::Condition(k),
                vec![(PoseFunction::Condition(k), 1.0)],
            );
        }
        if turns(joint) {
            let own = harmonics(joint, HARMONICS);
            self.add(joint, FamilyKind::Harmonics, own);
        }
        self.add_smooth(joint, if turns(joint) { &[] } else { &guide });
        for other in
            joint.saturating_sub(NEIGHBOURS)..robot.joints.len().min(joint + NEIGHBOURS + 1)
        {
            if other != joint && turns(other) {
                let own = harmonics(other, OF_NEIGHBOURS);
                self.add(joint, FamilyKind::Over(other), own);
            }
        }
        for direction in 1..DIRECTIONS {
            if turns(joint) {
                self.add(
                    joint,
                    FamilyKind::Across(direction),
                    harmonics(joint, ACROSS),
                );
            }
        }
    }

    /// Smooth curves over a joint's range: along its motion, and how else it moves what it carries: a guide in all
    /// directions, a single joint that turns about those across its axis.
    fn add_smooth(&mut self, joint: usize, others: &[FamilyKind]) {
        let [from, to] = self.ranges[joint];
        if to > from {
            let curve = bends(joint, BENDS, from, to - from);
            self.add(joint, FamilyKind::Curve, curve);
            let count = (BENDS as f64 * BEYOND).ceil() as usize;
            let curve = bends(joint, count, from, BEYOND * (to - from));
            for what in others {
                self.add(joint, *what, curve.clone());
            }
        }
    }

    /// A gear's order more.
    pub(super) fn add_order(&mut self, joint: usize, order: f64) {
        self.add(joint, FamilyKind::Order(order), pair(joint, order).to_vec());
    }

    fn add(&mut self, joint: usize, what: FamilyKind, sources: Vec<(PoseFunction, f64)>) {
        let family = self.all.len();
        self.all.push(Family { joint, what });
        self.columns
            .extend(sources.into_iter().map(|(source, size)| Column {
                family,
                source,
                size,
                mean: 0.0,
            }));
    }

    /// Only some of the families, in the same order.
    pub(super) fn only(&self, kept: &[bool]) -> Self {
        let mut now = Self {
            ranges: self.ranges.clone(),
            condition_ranges: self.condition_ranges.clone(),
            ..Self::default()
        };
        for (k, family) in self.all.iter().enumerate().filter(|(k, _)| kept[*k]) {
            let family_now = now.all.len();
            now.all.push(*family);
            let own = self.columns.iter().filter(|c| c.family == k);
            now.columns.extend(own.map(|c| Column {
                family: family_now,
                ..c.clone()
            }));
        }
        now
    }

    fn direction(&self, column: &Column) -> usize {
        match self.all[column.family].what {
            FamilyKind::Across(direction)
            | FamilyKind::Guide(direction)
            | FamilyKind::Tilt(direction) => direction,
            _ => 0,
        }
    }

    /// The root mean square of each column from number `first` on over the samples at one standard deviation:
    /// `directions` are the rows of a unit in each direction of each joint.
    pub(super) fn shown(
        &mut self,
        robot: &Robot,
        inputs: &Inputs,
        directions: &DMatrix<f64>,
        first: usize,
    ) -> DMatrix<f64> {
        let n = inputs.len();
        let mut all = DMatrix::zeros(directions.nrows(), self.columns.len() - first);
        for joint in 0..robot.joints.len() {
            let places = first..self.columns.len();
            let of_joint = |k: &usize| self.all[self.columns[*k].family].joint == joint;
            let places: Vec<usize> = places.filter(of_joint).collect();
            if places.is_empty() {
                continue;
            }
            let poses = asked_at(robot, inputs, joint);
            let of_condition = |k: usize| extent(poses.iter().map(|at| at.conditions()[k]));
            self.condition_ranges[joint] = (0..CONDITIONS).map(of_condition).collect();
            let sags: Vec<_> = poses
                .iter()
                .map(|at| unit_sag(robot, joint, &at.q))
                .collect();
            for k in places {
                let column = &self.columns[k];
                let at = poses.iter().zip(&sags);
                let value: Vec<f64> = at.map(|(at, sags)| column.source.at(at, sags)).collect();
                let mean = value.iter().sum::<f64>() / n as f64;
                let unit = directions.column(joint * MOVES + self.direction(column));
                let of_column = &mut all.column_mut(k - first);
                for (row, (to, unit)) in of_column.iter_mut().zip(unit.iter()).enumerate() {
                    *to = unit * column.size * (value[row % n] - mean);
                }
                self.columns[k].mean = mean;
            }
        }
        all
    }

    /// The terms of a model with such coefficients, in standard deviations at strength 1.
    pub(super) fn terms(&self, coefficients: &[f64], joints: usize) -> Vec<Term> {
        let mut rests = vec![None; joints];
        for (column, coefficient) in self.columns.iter().zip(coefficients) {
            let joint = self.all[column.family].joint;
            let rest = rests[joint].get_or_insert_with(|| Rest {
                ranges: self.ranges.clone(),
                condition_ranges: self.condition_ranges[joint].clone(),
                ..Rest::default()
            });
            let along = &mut rest.along[self.direction(column)];
            let value = column.size * coefficient;
            column.source.write(value, joints, along);
            add_wave(along, vec![0.0; joints], 0.0, -value * column.mean);
        }
        let there = rests.into_iter().enumerate();
        there
            .filter_map(|(joint, rest)| Some(Term::unnamed(joint, rest?)))
            .collect()
    }
}

impl PoseFunction {
    fn write(&self, value: f64, joints: usize, along: &mut Along) {
        match self {
            Self::Sag(k) => {
                along.moments.resize(UNIT_SAGS, 0.0);
                along.moments[*k] += value;
            }
            Self::Condition(k) => along.conditions[*k] += value,
            Self::Cosine { joint, order, from } => {
                let mut orders = vec![0.0; joints];
                orders[*joint] = *order;
                let (sin, cos) = (order * from).sin_cos();
                add_wave(along, orders, value * sin, value * cos);
            }
        }
    }
}

fn add_wave(along: &mut Along, orders: Vec<f64>, sine: f64, cosine: f64) {
    let at = along.waves.iter().position(|w| w.orders == orders);
    let at = at.unwrap_or_else(|| {
        along.waves.push(Wave {
            orders,
            ..Wave::default()
        });
        along.waves.len() - 1
    });
    along.waves[at].sine += sine;
    along.waves[at].cosine += cosine;
}

/// A cosine and a sine of a joint's value.
fn pair(joint: usize, order: f64) -> [(PoseFunction, f64); 2] {
    let quarter = 0.5 * std::f64::consts::PI / order;
    [0.0, quarter].map(|from| (PoseFunction::Cosine { joint, order, from }, 1.0))
}

/// So many half-waves over a range, the shorter the weaker.
fn bends(joint: usize, count: usize, from: f64, range: f64) -> Vec<(PoseFunction, f64)> {
    let bend = |k: usize| {
        let order = k as f64 * std::f64::consts::PI / range;
        (
            PoseFunction::Cosine { joint, order, from },
            (k as f64).powi(-2),
        )
    };
    (1..=count).map(bend).collect()
}

fn harmonics(joint: usize, count: usize) -> Vec<(PoseFunction, f64)> {
    (1..=count).flat_map(|k| pair(joint, k as f64)).collect()
}

impl Family {
    /// In words: the joint and what it follows.
    pub(super) fn in_words(&self) -> Text {
        let own = self.joint + 1;
        let what = match self.what {
            FamilyKind::Gravity => text!("gravity"),
            FamilyKind::Condition(k) => [
                phrase!("load"),
                phrase!("measured torque"),
                phrase!("approach direction"),
                phrase!("speed"),
                phrase!("temperature"),
            ][k]
                .into(),
            FamilyKind::Harmonics => text!("harmonics"),
            FamilyKind::Curve => text!("smooth curve"),
            FamilyKind::Over(other) => text!("over joint {joint}", joint = other + 1),
            FamilyKind::Across(1) => text!("radial harmonics"),
            FamilyKind::Across(_) => text!("axial harmonics"),
            FamilyKind::Guide(direction) if direction < DIRECTIONS => text!("straightness"),
            FamilyKind::Guide(DIRECTIONS) => text!("roll"),
            FamilyKind::Guide(_) => text!("pitch or yaw"),
            FamilyKind::Tilt(_) => text!("tilt"),
            FamilyKind::Order(order) => {
                text!("{count} cycles per turn", count = format!("{order:.1}"))
            }
        };
        text!("joint {joint} ({what})", joint = own, what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::unrepeated;

    /// Whatever the coefficients are, the mean correction over the poses that it comes from is zero.
    #[test]
    fn a_correction_takes_no_constant_from_the_geometry() {
        let session = unrepeated(0.0, 1);
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let robot = &session.robot;
        let mut families = Families::of(robot, &inputs);
        families.add_order(0, 31.0);
        let joints = robot.joints.len();
        let directions = DMatrix::from_element(3 * inputs.len(), joints * MOVES, 1.0);
        let shown = families.shown(robot, &inputs, &directions, 0);
        let coefficient = |k: usize| (k as f64 * 0.7).sin();
        let coefficients: Vec<f64> = (0..shown.ncols()).map(coefficient).collect();
        for term in families.terms(&coefficients, joints) {
            let rest = term.rest().unwrap();
            let poses = asked_at(robot, &inputs, term.joint);
            let values: Vec<[f64; MOVES]> = poses.iter().map(|at| rest.at(at)).collect();
            for direction in 0..MOVES {
                let of = |values: &[f64; MOVES]| values[direction];
                let mean = values.iter().map(of).sum::<f64>() / values.len() as f64;
                assert!(mean.abs() < 1e-9, "joint {}: {mean}", term.joint);
            }
        }
    }
}
