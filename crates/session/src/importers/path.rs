//! What the robot was told over time, and where it stood still.

use std::ops::RangeInclusive;

use crate::importers::columns::Columns;
use crate::importers::times::extent;
use crate::kinematics::Robot;
use crate::numeric::median;
use crate::sessions::columns::Quantity;

/// An interval in which a joint moves slower than this part of its usual speed is standing.
const STANDING_SPEED: f64 = 0.02;
/// A stop is no shorter than this, s.
const SHORTEST_STOP_S: f64 = 0.2;

/// Joint values over time, between the rows of the commands on straight lines.
#[derive(Debug, Clone)]
pub(crate) struct Path {
    /// Increasing, s.
    pub(crate) time_s: Vec<f64>,
    /// One column for each joint, rad or mm.
    pub(crate) q: Vec<Vec<f64>>,
    /// The row of the commands that each entry comes from.
    pub(crate) row: Vec<usize>,
}

/// Rows between which no joint moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stop {
    /// Entries of the path, the first and the last.
    pub(crate) first: usize,
    pub(crate) last: usize,
    /// Their times, s.
    pub(crate) from_s: f64,
    pub(crate) to_s: f64,
}

impl Path {
    /// The path of the commands; the error is a row at which the time does not increase.
    pub(crate) fn new(commands: &Columns, robot: &Robot) -> Result<Self, Option<usize>> {
        let time_s = commands.numbers(Quantity::Time).ok_or(None)?;
        let mut path = Self {
            time_s: Vec::new(),
            q: vec![Vec::new(); robot.joint_count()],
            row: Vec::new(),
        };
        let mut q = Vec::new();
        for joint in 0..robot.joint_count() {
            q.push(commands.numbers(Quantity::Commanded(joint)).ok_or(None)?);
        }
        for (row, &time) in time_s.iter().enumerate() {
            if time.is_nan() || q.iter().any(|q| q[row].is_nan()) {
                continue;
            }
            if path.time_s.last().is_some_and(|last| time <= *last) {
                return Err(Some(row));
            }
            path.time_s.push(time);
            path.row.push(row);
            for (column, q) in path.q.iter_mut().zip(&q) {
                column.push(q[row]);
            }
        }
        Ok(path)
    }

    pub(crate) fn start(&self) -> f64 {
        self.time_s.first().copied().unwrap_or(0.0)
    }

    pub(crate) fn end(&self) -> f64 {
        self.time_s.last().copied().unwrap_or(0.0)
    }

    /// The entry before or at a time, within the path.
    pub(crate) fn entry(&self, time_s: f64) -> Option<usize> {
        if !(time_s >= self.start() && time_s <= self.end()) {
            return None;
        }
        let after = self.time_s.partition_point(|time| *time <= time_s);
        after.checked_sub(1)
    }

    /// The joint values at a time; false outside the path.
    pub(crate) fn at(&self, time_s: f64, q: &mut [f64]) -> bool {
        let Some(entry) = self.entry(time_s) else {
            return false;
        };
        let share = match self.time_s.get(entry + 1) {
            Some(next) => (time_s - self.time_s[entry]) / (next - self.time_s[entry]),
            None => 0.0,
        };
        for (value, column) in q.iter_mut().zip(&self.q) {
            let from = column[entry];
            *value = match column.get(entry + 1) {
                Some(to) if share > 0.0 => from + share * (to - from),
                _ => from,
            };
        }
        true
    }

    /// Speed of a joint at a time, in inner units per second.
    pub(crate) fn speed(&self, joint: usize, entry: usize) -> f64 {
        // At the very end the last interval's holds.
        let entry = entry.min(self.time_s.len().saturating_sub(2));
        let q = &self.q[joint];
        match (q.get(entry + 1), self.time_s.get(entry + 1)) {
            (Some(to), Some(time)) => (to - q[entry]) / (time - self.time_s[entry]),
            _ => 0.0,
        }
    }

    /// Where the robot was told to stand still, in order.
    pub(crate) fn stops(&self) -> Vec<Stop> {
        let intervals = self.time_s.len().saturating_sub(1);
        let slow: Vec<f64> = (0..self.q.len())
            .map(|joint| {
                let mut speeds: Vec<f64> = (0..intervals)
                    .map(|entry| self.speed(joint, entry).abs())
                    .filter(|speed| *speed > 0.0)
                    .collect();
                speeds.sort_by(f64::total_cmp);
                // The usual speed is one of the higher ones: most of a log may be standing.
                let usual = speeds.get(speeds.len() * 9 / 10).copied().unwrap_or(0.0);
                STANDING_SPEED * usual
            })
            .collect();
        let stands = |entry: usize| {
            (0..self.q.len()).all(|joint| self.speed(joint, entry).abs() <= slow[joint])
        };
        let mut stops = Vec::new();
        let mut entry = 0;
        while entry < intervals {
            if !stands(entry) {
                entry += 1;
                continue;
            }
            let first = entry;
            while entry < intervals && stands(entry) {
                entry += 1;
            }
            let (from_s, to_s) = (self.time_s[first], self.time_s[entry]);
            if to_s - from_s >= SHORTEST_STOP_S {
                stops.push(Stop {
                    first,
                    last: entry,
                    from_s,
                    to_s,
                });
            }
        }
        stops
    }

    /// How far each joint has to move before that is a motion, rad or mm. Of values that were read
    /// back it is twice what they usually wander over while the robot stands.
    pub(crate) fn resolution(&self, stops: &[Stop], is_read_back: bool) -> Vec<f64> {
        let of_joint = |q: &Vec<f64>| {
            let rounding = 1e-7 * extent(q);
            let stops = stops.iter().filter(|_| is_read_back);
            let wander = stops.map(|stop| extent(&q[stop.first..=stop.last]));
            let usual = median(wander).unwrap_or(0.0);
            rounding.max(2.0 * usual)
        };
        self.q.iter().map(of_joint).collect()
    }

    /// The mean of a joint over some time; where no entry falls into it, its value in the middle.
    pub(crate) fn mean(&self, joint: usize, time_s: &RangeInclusive<f64>) -> f64 {
        let entries = self.time_s.iter().zip(&self.q[joint]);
        let from = self.time_s.partition_point(|time| time < time_s.start());
        let inside = entries
            .skip(from)
            .take_while(|(time, _)| *time <= time_s.end());
        let (count, sum) = inside.fold((0.0, 0.0), |(count, sum), (_, q)| (count + 1.0, sum + q));
        if count > 0.0 {
            return sum / count;
        }
        let mut q = vec![0.0; self.q.len()];
        self.at(0.5 * (time_s.start() + time_s.end()), &mut q);
        q[joint]
    }
}

/// The side from which a joint came to each of its values: the sign of its last motion before, 0 where it has not moved
/// yet. Slow motion adds up until it is one.
pub(crate) fn sides(values: &[f64], smallest: f64) -> Vec<f64> {
    let (mut side, mut from) = (0.0, f64::NAN);
    let each = values.iter().map(|&here| {
        if (here - from).abs() > smallest {
            side = (here - from).signum();
            from = here;
        } else if from.is_nan() {
            from = here;
        }
        side
    });
    each.collect()
}
