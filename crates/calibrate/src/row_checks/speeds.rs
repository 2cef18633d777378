//! Recorded speeds against the direction of approach and against the way in time: their sign, and
//! their unit.
//!
//! A joint that is measured while it moves comes from the side from which it moves: the signs of speed
//! and direction agree. While it is recorded along its way its values change by speed times time.

use super::rows::in_order;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Session, SessionCorrection};
use crate::text::Template;
use crate::units::{deg_from_rad, rad_from_deg};

/// With fewer samples that move nothing is reported.
pub(super) const FEWEST: usize = 8;
/// So large a share has to agree.
pub(super) const NEARLY_ALL: f64 = 0.95;
/// A unit explains the way in time within this, as a ratio.
const CLOSE: f64 = 0.05;
/// Half of the ratios have to be as near to their median as this.
const ALIKE: f64 = 0.1;

pub(super) fn turned_or_scaled(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let speeds = session.samples.speed.iter().enumerate();
    let found = speeds.filter_map(|(joint, speed)| {
        let speed = speed.as_deref()?;
        sign(session, joint, speed).or_else(|| unit(session, joint, speed))
    });
    found.collect()
}

fn sign(session: &Session, joint: usize, speed: &[f64]) -> Option<DataProblem> {
    let samples = &session.samples;
    let number = joint + 1;
    let side = samples.dir.get(joint)?.as_deref()?;
    let moves = (0..speed.len()).filter(|i| speed[*i] * side[*i] != 0.0);
    let products: Vec<f64> = moves
        .map(|i| speed[i] * side[i])
        .filter(|v| v.is_finite())
        .collect();
    let against = products.iter().filter(|v| **v < 0.0).count();
    if products.len() < FEWEST || (against as f64) < NEARLY_ALL * products.len() as f64 {
        return None;
    }
    // Of the two the one that the commands contradict is wrong.
    let (with_side, of) = agreement(session, joint, side);
    let of_side = of >= FEWEST && (with_side as f64) < (1.0 - NEARLY_ALL) * of as f64;
    let evidence = text!(
        "in {opposed} of {all} samples that were measured while joint {joint} moved, speed{joint} and dir{joint} have opposite signs; from row to row the commands agree with dir{joint} in {agree} of {moves}",
        opposed = against,
        all = products.len(),
        joint = number,
        agree = with_side,
        moves = of
    );
    if of_side {
        return Some(DataProblem::of_all(
            text!(
                "the direction of approach of joint {joint} has the wrong sign beside its speed",
                joint = number
            ),
            evidence,
            text!("reverse the sign of dir{joint}", joint = number),
            None,
        ));
    }
    Some(DataProblem::of_all(
        text!(
            "the speed of joint {joint} has the wrong sign",
            joint = number
        ),
        evidence,
        text!(
            "the sign of speed{joint} is reversed; correct the column",
            joint = number
        ),
        SessionCorrection::ScaleSpeed {
            joint,
            factor: -1.0,
        },
    ))
}

/// In how many rows the joint has come from the side that is recorded, and of how many.
pub(super) fn agreement(session: &Session, joint: usize, side: &[f64]) -> (usize, usize) {
    let samples = &session.samples;
    let q = &samples.q[joint];
    let moves = in_order(samples);
    let moves = moves
        .windows(2)
        .map(|pair| (q[pair[1]] - q[pair[0]]) * side[pair[1]]);
    let moves: Vec<f64> = moves.filter(|v| *v != 0.0 && v.is_finite()).collect();
    (moves.iter().filter(|v| **v > 0.0).count(), moves.len())
}

/// Units of speed that are taken for one another, with the message.
fn units() -> [(f64, Template); 6] {
    [
        (deg_from_rad(1.0), phrase!("radians per second")),
        (
            rad_from_deg(1.0),
            phrase!("degrees per second, read as radians"),
        ),
        (6.0, phrase!("revolutions per minute")),
        (1.0 / 60.0, phrase!("units per minute")),
        (1000.0, phrase!("metres per second")),
        (0.001, phrase!("thousandths of its unit")),
    ]
}

fn unit(session: &Session, joint: usize, speed: &[f64]) -> Option<DataProblem> {
    let samples = &session.samples;
    let number = joint + 1;
    let time_s = samples.time_s.as_deref()?;
    let q = &samples.q[joint];
    // The way from one row to the next in the time between, where both move at the same speed.
    let ratio = |pair: &[usize]| {
        let (a, b) = (pair[0], pair[1]);
        let mean = 0.5 * (speed[a] + speed[b]);
        let alike = (speed[a] - speed[b]).abs() < 0.2 * mean.abs();
        let passed = time_s[b] - time_s[a];
        let ratio = (q[b] - q[a]) / passed / mean;
        (alike && passed > 0.0 && ratio.is_finite()).then_some(ratio)
    };
    let mut ratios: Vec<f64> = in_order(samples).windows(2).filter_map(ratio).collect();
    if ratios.len() < FEWEST {
        return None;
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    let near = ratios
        .iter()
        .filter(|r| (*r / median - 1.0).abs() < ALIKE)
        .count();
    if (near as f64) < 0.7 * ratios.len() as f64 {
        return None;
    }
    // Radians and minutes differ by less than ratios do: of those that are near the nearest.
    let off = |factor: f64| (median / factor - 1.0).abs();
    let (factor, name) = units()
        .into_iter()
        .filter(|(factor, _)| off(*factor) < CLOSE)
        .min_by(|(one, _), (other, _)| off(*one).total_cmp(&off(*other)))?;
    Some(DataProblem::of_all(
        text!(
            "the speed of joint {joint} is in another unit: {unit}",
            joint = number,
            unit = name
        ),
        text!(
            "joint {joint} moves {median} times as fast from row to row as speed{joint} says, in {near} of {all} pairs of rows",
            joint = number,
            median = format!("{median:.4}"),
            near,
            all = ratios.len()
        ),
        text!(
            "speed{joint} is multiplied by {factor}; correct its unit",
            joint = number,
            factor = format!("{factor:.6}")
        ),
        SessionCorrection::ScaleSpeed { joint, factor },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    #[test]
    fn a_speed_with_the_wrong_sign_is_turned() {
        let mut session = axis(60);
        let speed = |session: &Session| -> Vec<f64> {
            let side = session.samples.dir[0].as_ref().expect("there");
            side.iter()
                .enumerate()
                .map(|(k, s)| s * 0.1 * (k % 3) as f64)
                .collect()
        };
        session.samples.speed[0] = Some(speed(&session));
        assert!(turned_or_scaled(&session, JointValues::Commanded).is_empty());
        let turned = speed(&session).iter().map(|v| -v).collect();
        session.samples.speed[0] = Some(turned);
        let problems = turned_or_scaled(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert!(
            problems[0]
                .what
                .contains("speed of joint 1 has the wrong sign")
        );
        problems[0]
            .mend
            .as_ref()
            .expect("known")
            .apply(&mut session);
        assert_eq!(session.samples.speed[0], Some(speed(&session)));
        // The same with the directions turned.
        let side = session.samples.dir[0].as_mut().expect("there");
        for s in side.iter_mut() {
            *s = -*s;
        }
        let problems = turned_or_scaled(&session, JointValues::Commanded);
        assert!(
            problems[0].what.contains("direction of approach"),
            "{problems:?}"
        );
        assert_eq!(problems[0].mend, None);
    }

    #[test]
    fn a_speed_in_another_unit_is_told_by_the_way_in_time() {
        let mut session = axis(60);
        let time_s: Vec<f64> = (0..60).map(|k| 0.1 * f64::from(k)).collect();
        session.samples.q[0] = time_s.iter().map(|t| 0.35 * t).collect();
        session.samples.dir[0] = None;
        session.samples.time_s = Some(time_s);
        let with = |session: &mut Session, v: f64| {
            session.samples.speed[0] = Some(vec![v; 60]);
            turned_or_scaled(session, JointValues::Commanded)
        };
        assert!(with(&mut session, 0.35).is_empty());
        let problems = with(&mut session, 0.35 * rad_from_deg(1.0));
        assert!(
            problems[0].what.contains("radians per second"),
            "{problems:?}"
        );
        let problems = with(&mut session, 0.35 * 60.0);
        assert!(
            problems[0].what.contains("units per minute"),
            "{problems:?}"
        );
        // Between poses at standstill the way has no information.
        assert!(with(&mut session, 0.0).is_empty());
    }
}
