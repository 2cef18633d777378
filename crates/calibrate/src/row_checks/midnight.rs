//! A clock that shows the time of day, and passes midnight. What depends on time (a frame that drifts, a machine
//! that warms, a step) would see the second half of the measurement a day before the first.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{DAY_S, Session, SessionCorrection};

/// With a day added the clock goes on within so many s, or within so many of the longest pauses before and after.
const USUAL_PAUSE_S: f64 = 3600.0;
const LONGEST_PAUSES: f64 = 2.0;

pub(super) fn passed(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let Some(time_s) = session.samples.time_s.as_deref() else {
        return Vec::new();
    };
    let midnights = midnights(time_s);
    let Some(&first) = midnights.first() else {
        return Vec::new();
    };
    let before = time_s[..first].iter().rev().find(|t| t.is_finite());
    let before = before.copied().unwrap_or(DAY_S);
    let seconds = |s: f64| format!("{s:.0}");
    vec![DataProblem::of_all(
        text!(
            "time of day: the clock passes midnight at sample {sample}",
            sample = first + 1
        ),
        text!(
            "time_s falls from {before} s to {after} s, and goes on after {pause} s with a day added",
            before = seconds(before),
            after = seconds(time_s[first]),
            pause = seconds(time_s[first] + DAY_S - before)
        ),
        text!("86400 s are added from there on; record seconds since the beginning"),
        SessionCorrection::ContinueClock(midnights),
    )]
}

/// The first samples of new days; none where the clock falls for another reason.
fn midnights(time_s: &[f64]) -> Vec<usize> {
    let known: Vec<(usize, f64)> = time_s
        .iter()
        .copied()
        .enumerate()
        .filter(|(_, time)| time.is_finite())
        .collect();
    if !known.iter().all(|(_, time)| (0.0..=DAY_S).contains(time)) {
        return Vec::new();
    }
    let steps = known
        .windows(2)
        .map(|pair| (pair[1].0, pair[1].1 - pair[0].1));
    let longest = steps
        .clone()
        .fold(0.0, |most: f64, (_, step)| most.max(step));
    let pause = USUAL_PAUSE_S.max(LONGEST_PAUSES * longest).min(0.5 * DAY_S);
    let falls: Vec<(usize, f64)> = steps.filter(|(_, step)| *step < 0.0).collect();
    if falls.iter().all(|(_, step)| step + DAY_S <= pause) {
        falls.into_iter().map(|(sample, _)| sample).collect()
    } else {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_of_day_goes_on_past_midnight() {
        let of_day = |k: u32| (86_000.0 + 30.0 * f64::from(k)) % DAY_S;
        let time_s: Vec<f64> = (0..60).map(of_day).collect();
        assert_eq!(midnights(&time_s), [14]);
        let two_days: Vec<f64> = (0..40)
            .map(|k| (80_000.0 + 3_000.0 * f64::from(k)) % DAY_S)
            .collect();
        assert_eq!(midnights(&two_days).len(), 2);
        let mut session = crate::row_checks::tests::axis(60);
        session.samples.time_s = Some((0_u32..).take(session.samples.len()).map(of_day).collect());
        let found = passed(&session, JointValues::Commanded);
        let correction = found[0].mend.as_ref().expect("mechanical");
        correction.apply(&mut session);
        let after = session.samples.time_s.as_deref().expect("a clock");
        assert!(after.windows(2).all(|pair| pair[1] > pair[0]));
    }

    #[test]
    fn another_clock_that_falls_passes_no_midnight() {
        let visits: Vec<f64> = (0..60).map(|k| f64::from(k % 20) * 30.0).collect();
        let restarted: Vec<f64> = (0..60).map(|k| f64::from(k % 30) * 1500.0).collect();
        let runs_on: Vec<f64> = (0..60).map(|k| 86_000.0 + 30.0 * f64::from(k)).collect();
        for time_s in [visits, restarted, runs_on, vec![f64::NAN; 4], Vec::new()] {
            assert!(midnights(&time_s).is_empty());
        }
    }
}
