//! How a correction changes a session.

use crate::kinematics::JointKind;
use crate::text::{Template, Text, length};
use crate::units::{deg_from_rad, rad_from_deg};

use super::correction::{DAY_S, GRADIAN_DEG, SessionCorrection, TRAVEL_UNITS_MM, TURN_DEG};
use super::{Samples, Session, Setups, in_rows};

impl SessionCorrection {
    /// Makes the correction; rows that it removes are left out of every fit and figure instead, so that the others
    /// keep their numbers.
    pub fn apply_keeping_rows(&self, session: &mut Session) {
        let Self::Remove(rows) = self else {
            return self.apply(session);
        };
        let n = session.samples.len();
        let out = session
            .samples
            .excluded
            .get_or_insert_with(|| vec![false; n]);
        for row in rows {
            if let Some(out) = out.get_mut(*row) {
                *out = true;
            }
        }
    }

    /// What it does, as a button says it.
    pub fn describe(&self) -> Text {
        match self {
            Self::ScaleJoint { joint, factor } => scaled_joints(joint_called(*joint), *factor),
            Self::ScaleJoints { factor } => scaled_joints(text!("all joints"), *factor),
            Self::ExchangeJoints { first, second } => {
                exchanged(joint_called(*first), joint_called(*second))
            }
            Self::CoupleJoint {
                joint,
                from,
                factor,
            } if *factor < 0.0 => text!(
                "Subtract joint {from} from joint {joint}",
                from = from + 1,
                joint = joint + 1
            ),
            Self::CoupleJoint { joint, from, .. } => text!(
                "Add joint {from} to joint {joint}",
                from = from + 1,
                joint = joint + 1
            ),
            Self::TakeReadBack => text!("Start from the values read back"),
            Self::TurnHome { joint, by_rad } => text!(
                "Turn the home of joint {joint} by {angle}°",
                joint = joint + 1,
                angle = format!("{:.0}", by_rad.to_degrees())
            ),
            Self::ScaleLengths(factor) => scaled_lengths(text!("the coordinates"), *factor),
            Self::ScaleCoordinate { axis, factor } => scaled_coordinate(*axis, *factor),
            Self::Reorder([1, 0, 2]) => exchanged(Text::verbatim("x"), Text::verbatim("y")),
            Self::Reorder(order) => {
                let [a, b, c] = order.map(|k| ["x", "y", "z"][k % 3]);
                text!("Read x, y, z from {axes}", axes = format!("{a}, {b}, {c}"))
            }
            Self::FreeFrame => text!("Fit the measuring frame"),
            Self::Settle { .. } => text!("Take out what the instrument's distances settle by"),
            Self::StraightenSight(_) => text!("Take out what the lines of sight are bent by"),
            Self::TurnGravity(_) => text!("Take gravity as the joints feel it"),
            Self::Remove(rows) if rows.len() == 1 => text!("Remove this sample"),
            Self::Remove(rows) => text!("Remove these {count} samples", count = rows.len()),
            Self::PairRows(_) => text!("Pair the rows again"),
            Self::ScaleSpeed { joint, factor } if *factor < 0.0 => reversed(speeds_of(*joint)),
            Self::ScaleSpeed { joint, factor } => multiplied(speeds_of(*joint), *factor),
            Self::ScaleLoad(factor) if *factor < 1.0 => {
                read_as(text!("the loads"), Text::verbatim("g"))
            }
            Self::ScaleLoad(factor) => multiplied(text!("the loads"), *factor),
            Self::ConvertTemperature { factor, .. } => {
                let unit = if *factor < 1.0 { "°F" } else { "K" };
                read_as(text!("the temperatures"), Text::verbatim(unit))
            }
            Self::ContinueClock(_) => text!("Continue the clock past midnight"),
            Self::WidenNoise(_) => text!("Count the digit as noise"),
            Self::MoveTarget { target, .. } => {
                text!("Move target {target}", target = target + 1)
            }
            Self::LeaveOutOrientations => text!("Leave out the orientations"),
            Self::FreeTargets => text!("Fit the places of the targets"),
            Self::TargetsFromBase => {
                text!("Read the targets as places in the base frame")
            }
            Self::ExchangeDirections { first, second } => text!(
                "Exchange the directions of joints {first} and {second}",
                first = first + 1,
                second = second + 1
            ),
            Self::TurnDirections => reversed(text!("the directions of approach")),
            Self::TargetsWithin(sigma) => text!(
                "Take the places of the targets as known to {sigma}",
                sigma = length(*sigma, 2)
            ),
            Self::RenameTargets(rows) => text!(
                one "Correct the target of {count} sample",
                "Correct the targets of {count} samples",
                count = rows.len()
            ),
            Self::Split { group, index, from } => text!(
                "Take {thing} as a new one from sample {sample} on",
                thing = group.called(index + 1),
                sample = from + 1
            ),
            Self::InRows { rows, by } => text!(
                "{what}, in {rows}",
                what = by.describe(),
                rows = in_rows::listed(rows)
            ),
            Self::Free { group, index } => {
                text!("Fit the place of {thing}", thing = group.called(index + 1))
            }
        }
    }

    /// Changes the session. What the session does not have (a joint, a sample) is passed over.
    #[allow(
        clippy::too_many_lines,
        reason = "one line or two for each kind of correction"
    )]
    pub fn apply(&self, session: &mut Session) {
        let turning = |j: usize| {
            session
                .robot
                .joints
                .get(j)
                .is_some_and(|j| j.kind == JointKind::Revolute)
        };
        let turning: Vec<usize> = (0..session.samples.q.len())
            .filter(|j| turning(*j))
            .collect();
        let samples = &mut session.samples;
        match self {
            Self::ScaleJoints { factor } => {
                for joint in turning {
                    scale_joint(samples, joint, *factor);
                }
            }
            Self::ExchangeJoints { first, second } => exchange(samples, *first, *second),
            Self::CoupleJoint {
                joint,
                from,
                factor,
            } => couple(samples, *joint, *from, *factor),
            Self::TakeReadBack => {
                for (q, read) in samples.q.iter_mut().zip(&samples.q_read) {
                    if let Some(read) = read {
                        q.clone_from(read);
                    }
                }
            }
            Self::ScaleJoint { joint, factor } => scale_joint(samples, *joint, *factor),
            Self::TurnHome { joint, by_rad } => {
                let turn = |column: &mut Vec<f64>| column.iter_mut().for_each(|q| *q += by_rad);
                samples.q.get_mut(*joint).into_iter().for_each(turn);
                let read = samples.q_read.get_mut(*joint);
                read.into_iter().flatten().for_each(turn);
            }
            Self::ScaleLengths(factor) => {
                let columns = [&mut samples.x_mm, &mut samples.y_mm];
                let columns = columns.into_iter().chain(samples.z_mm.as_mut());
                columns.for_each(|column| scale(column, *factor));
            }
            Self::ScaleCoordinate { axis, factor } => scale_coordinate(samples, *axis, *factor),
            Self::Reorder(order) => reorder(samples, *order),
            Self::FreeFrame => {
                samples.setups = Some(Setups {
                    names: vec!["1".to_owned()],
                    index: vec![0; samples.len()],
                });
            }
            Self::Settle {
                by_mm,
                from_s,
                tau_s,
            } => settle(samples, *by_mm, *from_s, *tau_s),
            Self::StraightenSight(by) => straighten(samples, *by),
            Self::TurnGravity(m_s2) => session.robot.gravity_m_s2 = Some((*m_s2).into()),
            Self::Remove(rows) => samples.remove(rows),
            Self::PairRows(shifts) => pair_rows(samples, shifts),
            Self::ScaleSpeed { joint, factor } => {
                let speeds = samples.speed.get_mut(*joint).into_iter().flatten();
                speeds.for_each(|v| scale(v, *factor));
            }
            Self::ScaleLoad(factor) => samples.load_kg.iter_mut().for_each(|v| scale(v, *factor)),
            Self::ConvertTemperature { factor, offset } => {
                let joints = samples.joint_temperature_c.iter_mut().flatten();
                for column in samples.temperature_c.iter_mut().chain(joints) {
                    for v in column.iter_mut() {
                        *v = *v * factor + offset;
                    }
                }
            }
            Self::ContinueClock(days) => continue_clock(samples, days),
            Self::WidenNoise(by_mm) => {
                let axes = samples.axes();
                let own = &mut session.instrument.sigma_mm;
                *own = own.map(|sigma| sigma.widened(*by_mm, axes));
            }
            Self::MoveTarget { target, by_mm } => {
                if let Some(target) = session.targets.get_mut(*target) {
                    target.position_mm += nalgebra::Vector3::from(*by_mm);
                }
            }
            Self::LeaveOutOrientations => samples.orientation_wxyz = None,
            Self::FreeTargets => session.instrument.targets_sigma_mm = None,
            Self::TargetsFromBase => {
                let tool_from_base = session.robot.base_from_tool.inverse();
                for target in &mut session.targets {
                    target.position_mm = tool_from_base * target.position_mm;
                }
            }
            Self::ExchangeDirections { first, second } => {
                let joints = samples.dir.len();
                if *first < joints && *second < joints {
                    samples.dir.swap(*first, *second);
                }
            }
            Self::TurnDirections => {
                let columns = samples.dir.iter_mut().flatten();
                columns.for_each(|column| scale(column, -1.0));
            }
            Self::TargetsWithin(sigma) => {
                let own = &mut session.instrument.targets_sigma_mm;
                *own = own.map(|known| known.max(*sigma));
            }
            Self::RenameTargets(rows) => rename_targets(session, rows),
            Self::Split { group, index, from } => group.split(session, *index, *from),
            Self::InRows { rows, by } => in_rows::corrected(session, rows, by),
            Self::Free { group, index } => group.free(session, *index),
        }
    }
}

/// Takes from every distance what it had settled by at its time.
fn settle(samples: &mut Samples, by_mm: f64, from_s: f64, tau_s: f64) {
    let (Some(time_s), Some(z_mm)) = (&samples.time_s, &mut samples.z_mm) else {
        return;
    };
    let columns = samples.x_mm.iter_mut().zip(&mut samples.y_mm).zip(z_mm);
    for (((x, y), z), t) in columns.zip(time_s) {
        let distance = (*x * *x + *y * *y + *z * *z).sqrt();
        let factor = 1.0 - by_mm * (-(t - from_s) / tau_s).exp() / distance;
        if factor.is_finite() {
            for v in [x, y, z] {
                *v *= factor;
            }
        }
    }
}

/// Takes from every point what its line of sight was bent by.
fn straighten(samples: &mut Samples, by: [f64; 3]) {
    let Some(z_mm) = &mut samples.z_mm else {
        return;
    };
    let columns = samples.x_mm.iter_mut().zip(&mut samples.y_mm).zip(z_mm);
    for ((x, y), z) in columns {
        let square = *x * *x + *y * *y + *z * *z;
        for (v, by) in [x, y, z].into_iter().zip(by) {
            *v -= by * square;
        }
    }
}

/// What multiplying the values of joints does, in words.
fn scaled_joints(what: Text, factor: f64) -> Text {
    if factor == -1.0 {
        return reversed(what);
    }
    match unit_of_joint(factor) {
        Some(unit) => read_as(what, unit.into()),
        None => text!(
            "Divide {axis} by {ratio}",
            axis = what,
            ratio = divisor(factor)
        ),
    }
}

fn joint_called(joint: usize) -> Text {
    text!("joint {joint}", joint = joint + 1)
}

fn speeds_of(joint: usize) -> Text {
    text!("the speeds of joint {joint}", joint = joint + 1)
}

fn exchanged(first: Text, second: Text) -> Text {
    text!("Exchange {first} and {second}", first, second)
}

fn reversed(what: Text) -> Text {
    text!("Reverse {axis}", axis = what)
}

fn read_as(what: Text, unit: Text) -> Text {
    text!("Read {axis} as {unit}", axis = what, unit)
}

/// What multiplying measured coordinates does, in words.
fn scaled_lengths(what: Text, factor: f64) -> Text {
    let unit = match factor {
        1000.0 => phrase!("metres"),
        25.4 => phrase!("inches"),
        0.001 => phrase!("micrometres"),
        factor => return multiplied(what, factor),
    };
    read_as(what, unit.into())
}

/// What multiplying one of them does, in words.
fn scaled_coordinate(axis: usize, factor: f64) -> Text {
    scaled_lengths(Text::verbatim(["x", "y", "z"][axis.min(2)]), factor)
}

fn multiplied(what: Text, factor: f64) -> Text {
    let factor = format!("{factor:.6}");
    text!("Multiply {axis} by {factor}", axis = what, factor)
}

/// In which unit a joint's values are that have to be multiplied by so much, if it is one.
fn unit_of_joint(factor: f64) -> Option<Template> {
    let travel = TRAVEL_UNITS_MM.iter().find(|(mm, _)| *mm == factor);
    let angles = [
        (GRADIAN_DEG, phrase!("gradians")),
        (TURN_DEG, phrase!(in "angle", "turns")),
        (rad_from_deg(1.0), phrase!("degrees")),
        (deg_from_rad(1.0), phrase!("radians")),
    ];
    let angle = angles.iter().find(|(degrees, _)| *degrees == factor);
    travel.or(angle).map(|(_, unit)| *unit)
}

/// What values are divided by that are multiplied by so much.
pub fn divisor(factor: f64) -> String {
    let ratio = 1.0 / factor;
    if (ratio - ratio.round()).abs() < 1e-9 * ratio.abs() {
        format!("{ratio:.0}")
    } else {
        format!("{ratio:.4}")
    }
}

fn scale_coordinate(samples: &mut Samples, axis: usize, factor: f64) {
    let column = match axis {
        0 => Some(&mut samples.x_mm),
        1 => Some(&mut samples.y_mm),
        _ => samples.z_mm.as_mut(),
    };
    if let Some(column) = column {
        scale(column, factor);
    }
}

fn scale(column: &mut [f64], factor: f64) {
    for v in column {
        *v *= factor;
    }
}

/// Moves everything that an instrument measured; see [`SessionCorrection::PairRows`].
fn pair_rows(samples: &mut Samples, shifts: &[(usize, isize)]) {
    let n = samples.len();
    let mut from: Vec<Option<usize>> = (0..n).map(Some).collect();
    for (k, (first, by)) in shifts.iter().enumerate() {
        let end = shifts.get(k + 1).map_or(n, |next| next.0.min(n));
        let first = (*first).min(end);
        // A point is that of one row only: the rows above have theirs.
        let taken = from[..first]
            .iter()
            .flatten()
            .max()
            .map_or(0, |last| last + 1);
        for row in first..end {
            let point = row.checked_add_signed(*by);
            from[row] = point.filter(|point| *point < n && *point >= taken);
        }
    }
    let numbers = |column: &mut Vec<f64>| {
        let at = |row: &Option<usize>| row.map_or(f64::NAN, |row| column[row]);
        *column = from.iter().map(at).collect();
    };
    let points = [&mut samples.x_mm, &mut samples.y_mm];
    points
        .into_iter()
        .chain(samples.z_mm.as_mut())
        .for_each(numbers);
    samples
        .orientation_wxyz
        .iter_mut()
        .flatten()
        .for_each(numbers);
    for column in samples.observed.numbers_mut() {
        column.values.iter_mut().for_each(numbers);
    }
}

fn scale_joint(samples: &mut Samples, joint: usize, factor: f64) {
    if joint >= samples.q.len() {
        return;
    }
    let scale = |column: &mut Vec<f64>| scale(column, factor);
    scale(&mut samples.q[joint]);
    samples.q_read[joint].iter_mut().for_each(scale);
    samples.speed[joint].iter_mut().for_each(scale);
    if factor < 0.0 {
        let turn = |column: &mut Vec<f64>| column.iter_mut().for_each(|v| *v = -*v);
        samples.dir[joint].iter_mut().for_each(scale);
        let torque = samples.torque_nm.get_mut(joint);
        torque.into_iter().flatten().for_each(turn);
    }
}

/// See [`SessionCorrection::ContinueClock`].
fn continue_clock(samples: &mut Samples, days: &[usize]) {
    for (sample, time) in samples.time_s.iter_mut().flatten().enumerate() {
        let days = days.iter().filter(|first| **first <= sample).count();
        *time += DAY_S * days as f64;
    }
}

/// See [`SessionCorrection::RenameTargets`].
fn rename_targets(session: &mut Session, rows: &[(usize, u32)]) {
    let targets = session.targets.len();
    let is_one = |(_, target): &&(usize, u32)| (*target as usize) < targets;
    if let Some(column) = &mut session.samples.target {
        for (row, target) in rows.iter().filter(is_one) {
            if let Some(own) = column.get_mut(*row) {
                *own = *target;
            }
        }
    }
}

fn exchange(samples: &mut Samples, first: usize, second: usize) {
    if first.max(second) < samples.q.len() {
        samples.q.swap(first, second);
        samples.q_read.swap(first, second);
        samples.dir.swap(first, second);
        samples.speed.swap(first, second);
    }
}

fn couple(samples: &mut Samples, joint: usize, from: usize, factor: f64) {
    if joint == from || joint.max(from) >= samples.q.len() {
        return;
    }
    let add = |to: &mut Vec<f64>, other: &[f64]| {
        for (value, other) in to.iter_mut().zip(other) {
            *value += factor * other;
        }
    };
    let other = samples.q[from].clone();
    add(&mut samples.q[joint], &other);
    for columns in [&mut samples.q_read, &mut samples.speed] {
        if let Some(other) = columns[from].clone()
            && let Some(own) = &mut columns[joint]
        {
            add(own, &other);
        }
    }
}

fn reorder(samples: &mut Samples, order: [usize; 3]) {
    let Some(z) = samples.z_mm.take() else {
        // Two columns can only be exchanged.
        if order == [1, 0, 2] {
            std::mem::swap(&mut samples.x_mm, &mut samples.y_mm);
        }
        return;
    };
    let old = [
        std::mem::take(&mut samples.x_mm),
        std::mem::take(&mut samples.y_mm),
        z,
    ];
    samples.x_mm.clone_from(&old[order[0] % 3]);
    samples.y_mm.clone_from(&old[order[1] % 3]);
    samples.z_mm = Some(old[order[2] % 3].clone());
}
