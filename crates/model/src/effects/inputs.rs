//! The samples of a session as the effects take them: one column for each condition, no cell
//! missing, travel since the last reversal worked out from the order of measuring: that of the file,
//! unless a clock contradicts it.
//!
//! Where a condition is missing an effect cannot act, so the cell takes the value at which it
//! does not: side 0, speed 0, load 0 kg, 20 °C. A missing time is taken from the samples around
//! it, which keeps the order. A joint's own temperature counts before that of the machine.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::sessions::measuring_order::measuring_order;
use crate::sessions::poses::poses;
use crate::sessions::{Samples, Session};

/// Which joint values the simulation starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum JointValues {
    /// The commanded values.
    #[default]
    Commanded,
    /// What the controller read back.
    Read,
}

/// What effects read of the samples. Borrows the session's columns where it can.
#[derive(Debug, Clone)]
pub struct Inputs<'a> {
    /// Commanded joint values, rad or mm.
    pub q: Vec<Cow<'a, [f64]>>,
    /// Side from which each joint came: +1, −1, 0 unknown.
    pub dir: Vec<Option<Cow<'a, [f64]>>>,
    /// Signed joint speeds, rad/s or mm/s.
    pub speed: Vec<Option<Cow<'a, [f64]>>>,
    /// Travel since the last reversal, rad or mm; infinite before the first.
    pub travel: Vec<Option<Vec<f64>>>,
    /// Load at the tool's origin, kg.
    pub load_kg: Option<Cow<'a, [f64]>>,
    /// Temperature over 20 °C.
    pub above_20_c: Option<Vec<f64>>,
    /// The same of each joint, which counts for that joint before `above_20_c`.
    pub joint_above_20_c: Vec<Option<Vec<f64>>>,
    /// Measured torque about each joint, N·m.
    pub torque_nm: Vec<Option<Cow<'a, [f64]>>>,
    /// Time, s.
    pub time_s: Option<Cow<'a, [f64]>>,
    /// Index of the measuring frame, a whole number.
    pub setup: Option<Vec<f64>>,
    /// The [pose](crate::sessions::poses) of each sample; `None`: each has its own.
    #[doc(hidden)]
    pub pose: Option<Vec<u32>>,
    /// Index into `reflectors_at_home`; `None`: always the first.
    pub target: Option<Cow<'a, [u32]>>,
    /// Reflectors at home, base frame, mm; at least one.
    pub reflectors_at_home: Vec<[f64; 3]>,
    /// Time from which drifts count, s, where it is not that of the first sample.
    pub start_s: Option<f64>,
    len: usize,
}

/// The temperature to which all models refer, °C.
pub const REFERENCE_TEMPERATURE_C: f64 = 20.0;

impl<'a> Inputs<'a> {
    /// The inputs of a session's samples. Columns of another length than the points' are as if they had not
    /// been recorded, and missing joint values are zero.
    pub fn new(session: &'a Session, values: JointValues) -> Self {
        let samples = &session.samples;
        let joints = session.robot.joints.len();
        let rows = samples.len();
        let q = (0..joints).map(|joint| joint_values(samples, joint, values));
        let q: Vec<_> = q.collect();
        let own = |columns: &'a [Option<Vec<f64>>], joint: usize| of_joint(columns, joint, rows);
        let dir: Vec<_> = (0..joints)
            .map(|joint| or_fill(own(&samples.dir, joint), 0.0))
            .collect();
        let time_s = of_length(samples.time_s.as_ref(), rows);
        let order = measuring_order(time_s.map(Vec::as_slice));
        let travel = q.iter().zip(&dir).map(|(q, dir)| {
            let dir = dir.as_ref()?;
            Some(match &order {
                None => travel_since_reversal(q, dir),
                Some(order) => travel_in_order(q, dir, order),
            })
        });
        Self {
            travel: travel.collect(),
            speed: (0..joints)
                .map(|joint| or_fill(own(&samples.speed, joint), 0.0))
                .collect(),
            load_kg: or_fill(of_length(samples.load_kg.as_ref(), rows), 0.0),
            above_20_c: of_length(samples.temperature_c.as_ref(), rows).map(|t| warmth(t)),
            joint_above_20_c: (0..joints)
                .map(|joint| own(&samples.joint_temperature_c, joint).map(|t| warmth(t)))
                .collect(),
            torque_nm: (0..joints)
                .map(|joint| or_fill(own(&samples.torque_nm, joint), 0.0))
                .collect(),
            time_s: time_s.map(|t| with_gaps_bridged(t)),
            start_s: order.as_ref().and_then(|order| {
                let times = time_s?;
                order
                    .iter()
                    .map(|row| times[*row])
                    .find(|time| time.is_finite())
            }),
            setup: samples
                .setups
                .as_ref()
                .filter(|setups| setups.index.len() == rows)
                .map(|s| s.index.iter().map(|&i| f64::from(i)).collect()),
            pose: poses(samples),
            target: samples
                .target
                .as_deref()
                .filter(|target| target.len() == rows)
                .map(Cow::Borrowed),
            reflectors_at_home: reflectors_at_home(session),
            len: rows,
            q,
            dir,
        }
    }

    /// Some of the samples, in the given order, as they were in the whole: travel and the start of time are kept.
    /// Samples that are not there are left out.
    pub fn select(&self, samples: &[usize]) -> Inputs<'static> {
        let there: Vec<usize>;
        let samples = if samples.iter().all(|sample| *sample < self.len) {
            samples
        } else {
            let of = samples.iter().copied();
            there = of.filter(|sample| *sample < self.len).collect();
            &there
        };
        let pick = |column: &[f64]| -> Vec<f64> {
            let value = |i: &usize| column.get(*i).copied().unwrap_or(0.0);
            samples.iter().map(value).collect()
        };
        let owned = |column: &[f64]| Cow::Owned(pick(column));
        let each = |columns: &[Option<Cow<'a, [f64]>>]| {
            columns
                .iter()
                .map(|c| c.as_deref().map(owned))
                .collect::<Vec<_>>()
        };
        Inputs {
            q: self.q.iter().map(|q| owned(q)).collect(),
            dir: each(&self.dir),
            speed: each(&self.speed),
            travel: self.travel.iter().map(|t| t.as_deref().map(pick)).collect(),
            load_kg: self.load_kg.as_deref().map(owned),
            above_20_c: self.above_20_c.as_deref().map(pick),
            joint_above_20_c: self
                .joint_above_20_c
                .iter()
                .map(|t| t.as_deref().map(pick))
                .collect(),
            torque_nm: each(&self.torque_nm),
            time_s: self.time_s.as_deref().map(owned),
            setup: self.setup.as_deref().map(pick),
            pose: self.pose.as_deref().map(|pose| {
                let own = samples.iter().map(|i| pose.get(*i).copied());
                own.map(Option::unwrap_or_default).collect()
            }),
            target: self.target.as_deref().map(|t| {
                Cow::Owned(
                    samples
                        .iter()
                        .map(|i| t.get(*i).copied().unwrap_or(0))
                        .collect(),
                )
            }),
            reflectors_at_home: self.reflectors_at_home.clone(),
            start_s: Some(self.start_s()),
            len: samples.len(),
        }
    }

    /// At how many places of the flange reflectors were measured.
    pub fn reflector_places(&self) -> usize {
        let measured: BTreeSet<_> = self.target.as_deref().unwrap_or(&[]).iter().collect();
        let homes = &self.reflectors_at_home;
        let places = measured.into_iter().filter_map(|i| homes.get(*i as usize));
        let places = places.map(|home| home.map(f64::to_bits));
        places.collect::<BTreeSet<_>>().len().max(1)
    }

    /// Poses that were not measured: at standstill, at 20 °C, without load, approached from
    /// neither side. The columns are public: set what differs. There are as many poses as the first
    /// joint has values.
    pub fn at_poses(q: Vec<Vec<f64>>, reflectors_at_home: Vec<[f64; 3]>) -> Self {
        let joints = q.len();
        Self {
            len: q.first().map_or(0, Vec::len),
            q: q.into_iter().map(Cow::Owned).collect(),
            dir: vec![None; joints],
            speed: vec![None; joints],
            travel: vec![None; joints],
            load_kg: None,
            above_20_c: None,
            joint_above_20_c: vec![None; joints],
            torque_nm: vec![None; joints],
            time_s: None,
            setup: None,
            pose: None,
            target: None,
            reflectors_at_home,
            start_s: None,
        }
    }

    /// The same for a robot of so many joints: with a column for each, as many values in every column as
    /// there are samples, and a reflector for every sample.
    #[doc(hidden)]
    pub fn fitted_to(&self, joints: usize) -> Cow<'_, Self> {
        let len = self.len;
        let fits = |column: usize| column == len;
        let each = |columns: &[Option<Cow<'a, [f64]>>]| {
            let mut all = columns.iter().flatten();
            columns.len() == joints && all.all(|column| fits(column.len()))
        };
        let known = |column: Option<usize>| column.is_none_or(fits);
        let homes = self.reflectors_at_home.len();
        let seen = |target: &Cow<'a, [u32]>| {
            fits(target.len()) && target.iter().all(|index| (*index as usize) < homes)
        };
        let warmth = |column: &Option<Vec<f64>>| known(column.as_ref().map(Vec::len));
        let all_fit = self.q.len() == joints
            && self.q.iter().all(|q| fits(q.len()))
            && each(&self.dir)
            && each(&self.speed)
            && each(&self.torque_nm)
            && self.travel.len() == joints
            && self.travel.iter().all(warmth)
            && self.joint_above_20_c.iter().all(warmth)
            && warmth(&self.above_20_c)
            && warmth(&self.setup)
            && known(self.load_kg.as_ref().map(|column| column.len()))
            && known(self.time_s.as_ref().map(|column| column.len()))
            && homes > 0
            && self.target.as_ref().is_none_or(seen);
        if all_fit {
            return Cow::Borrowed(self);
        }
        let mut fitted = self.clone();
        fitted.q.resize(joints, Cow::Owned(vec![0.0; len]));
        for q in &mut fitted.q {
            if q.len() != len {
                q.to_mut().resize(len, 0.0);
            }
        }
        let each = |columns: &mut Vec<Option<Cow<'a, [f64]>>>| {
            columns.resize(joints, None);
            for column in columns {
                column.take_if(|column| column.len() != len);
            }
        };
        each(&mut fitted.dir);
        each(&mut fitted.speed);
        each(&mut fitted.torque_nm);
        fitted.travel.resize(joints, None);
        fitted.joint_above_20_c.resize(joints, None);
        let single = [&mut fitted.above_20_c, &mut fitted.setup];
        let of_joints = fitted.travel.iter_mut().chain(&mut fitted.joint_above_20_c);
        for column in of_joints.chain(single) {
            column.take_if(|column| column.len() != len);
        }
        for column in [&mut fitted.load_kg, &mut fitted.time_s] {
            column.take_if(|column| column.len() != len);
        }
        fitted.target.take_if(|target| !seen(target));
        if homes == 0 {
            fitted.reflectors_at_home.push([f64::NAN; 3]);
        }
        Cow::Owned(fitted)
    }

    /// Time from which drifts count, s: that of the session's first sample.
    pub fn start_s(&self) -> f64 {
        let first = || self.time_s.as_ref().and_then(|t| t.first().copied());
        self.start_s.or_else(first).unwrap_or(0.0)
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}

/// Where each target of the session is at home, base frame, mm.
pub fn reflectors_at_home(session: &Session) -> Vec<[f64; 3]> {
    let base_from_tool = &session.robot.base_from_tool;
    let homes = session.targets.iter();
    let homes = homes.map(|t| (base_from_tool * t.position_mm).coords.into());
    homes.collect()
}

fn joint_values(samples: &Samples, joint: usize, values: JointValues) -> Cow<'_, [f64]> {
    let rows = samples.len();
    let commanded = of_length(samples.q.get(joint), rows);
    let read = of_joint(&samples.q_read, joint, rows);
    let chosen = match (values, read) {
        (JointValues::Read, Some(read)) => Some(read),
        _ => commanded,
    };
    chosen.map_or_else(|| Cow::Owned(vec![0.0; rows]), |chosen| filled(chosen, 0.0))
}

/// A joint's own column, where there is one.
fn of_joint(columns: &[Option<Vec<f64>>], joint: usize, rows: usize) -> Option<&Vec<f64>> {
    of_length(columns.get(joint)?.as_ref(), rows)
}

/// A column where it has a value for each sample.
fn of_length(column: Option<&Vec<f64>>, rows: usize) -> Option<&Vec<f64>> {
    column.filter(|column| column.len() == rows)
}

fn filled(column: &[f64], with: f64) -> Cow<'_, [f64]> {
    if column.iter().any(|v| v.is_nan()) {
        let fill = |&v: &f64| if v.is_nan() { with } else { v };
        Cow::Owned(column.iter().map(fill).collect())
    } else {
        Cow::Borrowed(column)
    }
}

fn or_fill(column: Option<&Vec<f64>>, with: f64) -> Option<Cow<'_, [f64]>> {
    column.map(|column| filled(column, with))
}

fn warmth(temperature_c: &[f64]) -> Vec<f64> {
    let over = |&t: &f64| {
        if t.is_nan() {
            0.0
        } else {
            t - REFERENCE_TEMPERATURE_C
        }
    };
    temperature_c.iter().map(over).collect()
}

/// A missing time becomes that of the sample before it (of the first known one at the start).
fn with_gaps_bridged(time_s: &[f64]) -> Cow<'_, [f64]> {
    if !time_s.iter().any(|t| t.is_nan()) {
        return Cow::Borrowed(time_s);
    }
    let mut last = time_s.iter().copied().find(|t| !t.is_nan()).unwrap_or(0.0);
    let mut bridge = |&t: &f64| {
        if !t.is_nan() {
            last = t;
        }
        last
    };
    Cow::Owned(time_s.iter().map(&mut bridge).collect())
}

/// How far the joint has moved since it last reversed. While the side stays the same the moves
/// between poses add up; a new side starts from the pose before. The first sample has come from
/// unknown place: infinitely far.
fn travel_since_reversal(q: &[f64], dir: &[f64]) -> Vec<f64> {
    let mut travel = Vec::with_capacity(q.len());
    for i in 0..q.len() {
        travel.push(if i == 0 {
            f64::INFINITY
        } else {
            let moved = (q[i] - q[i - 1]).abs();
            let same_way = dir[i] == dir[i - 1];
            if same_way {
                travel[i - 1] + moved
            } else {
                moved
            }
        });
    }
    travel
}

/// The same of samples that were measured in this order.
fn travel_in_order(q: &[f64], dir: &[f64], order: &[usize]) -> Vec<f64> {
    let pick = |column: &[f64]| -> Vec<f64> { order.iter().map(|row| column[*row]).collect() };
    let in_order = travel_since_reversal(&pick(q), &pick(dir));
    let mut travel = vec![0.0; q.len()];
    for (row, own) in order.iter().zip(in_order) {
        travel[*row] = own;
    }
    travel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_reflectors_at_one_place_are_one() {
        let homes = vec![[0.0; 3], [90.0, 0.0, 0.0], [0.0; 3]];
        let mut inputs = Inputs::at_poses(vec![vec![0.0; 4]], homes);
        assert_eq!(inputs.reflector_places(), 1);
        inputs.target = Some(Cow::Owned(vec![0, 2, 2, 0]));
        assert_eq!(inputs.reflector_places(), 1);
        inputs.target = Some(Cow::Owned(vec![0, 2, 1, 0]));
        assert_eq!(inputs.reflector_places(), 2);
    }

    #[test]
    fn travel_follows_the_order_of_measuring() {
        let (q, dir) = (
            [0.0, 0.5, 1.0, 1.0, 2.0, 3.0],
            [1.0, -1.0, 1.0, 1.0, -1.0, 1.0],
        );
        let travel = travel_in_order(&q, &dir, &[0, 2, 5, 4, 1, 3]);
        assert_eq!(travel[1..], [2.5, f64::INFINITY, 0.5, 1.0, f64::INFINITY]);
    }

    #[test]
    fn travel_adds_up_while_the_side_stays_and_restarts_when_it_changes() {
        let q = [0.0, 1.0, 3.0, 2.0, 0.5, 1.0];
        let dir = [1.0, 1.0, 1.0, -1.0, -1.0, 1.0];
        let travel = travel_since_reversal(&q, &dir);
        assert_eq!(travel[1..], [f64::INFINITY, f64::INFINITY, 1.0, 2.5, 0.5]);
    }

    #[test]
    fn a_missing_time_is_taken_from_the_sample_before() {
        let bridged = with_gaps_bridged(&[f64::NAN, 1.0, f64::NAN, 4.0]);
        assert_eq!(*bridged, [1.0, 1.0, 1.0, 4.0]);
    }
}
