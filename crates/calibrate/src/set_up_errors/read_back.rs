//! A read-back that lags the command: the controller was read before the joint had arrived, or its
//! values are older than the measured point.
//!
//! ```text
//! read − commanded = −δ·ω        (−s·b/2 where only the side is known)
//! ```
//!
//! A joint that truly lags shows the same. The measured points decide: if they fit the values read
//! back better than the commands, the joint lags and nothing is wrong with the data.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::Session;
use crate::text::angle;

use super::fits::residual_mm;

/// With fewer samples no slope is reported.
const FEWEST: usize = 8;
/// Standard errors from which on a slope is no accident.
const CLEAR: f64 = 5.0;

/// What the values of one joint that are read back follow.
struct Lag {
    joint: usize,
    /// The speed, or the side.
    follows: Vec<f64>,
    by_speed: bool,
    /// read − commanded per unit of it.
    slope: f64,
    samples: usize,
}

/// Joints whose values are read back late; and the session with them brought up to the command's time, where they are
/// those to start from.
pub(super) fn lagging(
    session: &Session,
    values: JointValues,
) -> (Vec<DataProblem>, Option<Session>) {
    let joints = 0..session.samples.q.len();
    let lags: Vec<Lag> = joints.filter_map(|joint| Lag::of(session, joint)).collect();
    let residual_mm = |values| residual_mm(session, values).unwrap_or(f64::INFINITY);
    if lags.is_empty() || residual_mm(JointValues::Read) < residual_mm(JointValues::Commanded) {
        return (Vec::new(), None);
    }
    let problems = lags.iter().map(Lag::problem).collect();
    if values != JointValues::Read {
        return (problems, None);
    }
    let mut better = session.clone();
    for lag in &lags {
        let read = better.samples.q_read[lag.joint].iter_mut().flatten();
        for (read, v) in read.zip(&lag.follows).filter(|(_, v)| v.is_finite()) {
            *read -= lag.slope * v;
        }
    }
    (problems, Some(better))
}

impl Lag {
    fn of(session: &Session, joint: usize) -> Option<Self> {
        let samples = &session.samples;
        let read = samples.q_read[joint].as_ref()?;
        let behind = |by: &Option<Vec<f64>>, by_speed: bool| {
            let by = by.as_ref()?;
            let pairs: Vec<(f64, f64)> = (0..read.len())
                .map(|i| (by[i], read[i] - samples.q[joint][i]))
                .filter(|(v, e)| v.is_finite() && e.is_finite() && *v != 0.0)
                .collect();
            let (slope, error) = slope_through_zero(&pairs)?;
            (slope < -CLEAR * error).then(|| Self {
                joint,
                follows: by.clone(),
                by_speed,
                slope,
                samples: pairs.len(),
            })
        };
        behind(&samples.speed[joint], true).or_else(|| behind(&samples.dir[joint], false))
    }

    fn problem(&self) -> DataProblem {
        let (joint, samples) = (self.joint + 1, self.samples);
        let (what, evidence) = if self.by_speed {
            (
                text!(
                    "the values read back from joint {joint} lag the command by {time} ms",
                    joint,
                    time = format!("{:.2}", -1000.0 * self.slope)
                ),
                text!(
                    "read − commanded follows the speed over {samples} samples, and the measured points fit the commands better",
                    samples
                ),
            )
        } else {
            (
                text!(
                    "the values read back from joint {joint} lag the command by {turn} towards the side it came from",
                    joint,
                    turn = angle(-self.slope, 4)
                ),
                text!(
                    "read − commanded follows the side over {samples} samples, and the measured points fit the commands better",
                    samples
                ),
            )
        };
        let proposal = text!(
            "read joint {joint} back at standstill; taken as they are, these values look like backlash or tracking lag",
            joint
        );
        DataProblem::of_all(what, evidence, proposal, None)
    }
}

/// Slope of a line through zero, and its standard error.
fn slope_through_zero(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    if pairs.len() < FEWEST {
        return None;
    }
    let xx: f64 = pairs.iter().map(|p| p.0 * p.0).sum();
    let slope = pairs.iter().map(|p| p.0 * p.1).sum::<f64>() / xx;
    let rss: f64 = pairs.iter().map(|p| (p.1 - slope * p.0).powi(2)).sum();
    Some((slope, (rss / (pairs.len() - 1) as f64 / xx).sqrt()))
}
