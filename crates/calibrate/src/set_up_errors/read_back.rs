//! A read-back that lags the command: the controller was read before the joint had arrived, or its
//! values are older than the measured point.
//!
//! ```text
//! read − commanded = −δ·ω        (−s·b/2 where only the side is known)
//! ```
//!
//! A joint that truly lags shows the same. The measured points decide: if they fit the values read
//! back better than the commands, the joint lags and nothing is wrong with the data.

use crate::effects::{JointValues, Role, Term, find};
use crate::fit::gap::{Spread, deviations};
use crate::fit::problem::Problem;
use crate::fit::{DEFAULT_EFFECTS, base_model, fit_without_outliers, free_frames};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::Session;
use crate::text::angle;

use super::DataProblem;
use super::thinned::thinned;

/// What the values of one joint that are read back follow.
struct Lag {
    joint: usize,
    /// read − commanded per unit of what it follows.
    slope: f64,
    by_speed: bool,
    samples: usize,
}

/// Reports joints whose values are read back late. Where the read values are the ones to start
/// from, the answer is the session with them brought up to the command's time.
pub(super) fn lagging(
    session: &Session,
    joint_values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let joints = 0..session.samples.q.len();
    let lags: Vec<Lag> = joints.filter_map(|joint| lag(session, joint)).collect();
    if lags.is_empty() {
        return None;
    }
    let part = thinned(session);
    let left = |values| left_mm(&part, values);
    if left(JointValues::Read) < left(JointValues::Commanded) {
        return None;
    }
    problems.extend(lags.iter().map(Lag::problem));
    if joint_values != JointValues::Read {
        return None;
    }
    let mut mended = session.clone();
    for lag in &lags {
        let samples = &mut mended.samples;
        let by = lag.of(
            samples.speed[lag.joint].as_ref(),
            samples.dir[lag.joint].as_ref(),
        );
        let by = by.cloned().unwrap_or_default();
        if let Some(read) = &mut samples.q_read[lag.joint] {
            let finite = by.iter().map(|v| if v.is_finite() { *v } else { 0.0 });
            for (read, v) in read.iter_mut().zip(finite) {
                *read -= lag.slope * v;
            }
        }
    }
    Some(mended)
}

fn lag(session: &Session, joint: usize) -> Option<Lag> {
    let samples = &session.samples;
    let read = samples.q_read[joint].as_ref()?;
    let follows = |by: &[f64], by_speed: bool| {
        let pairs: Vec<(f64, f64)> = (0..read.len())
            .map(|i| (by[i], read[i] - samples.q[joint][i]))
            .filter(|(v, e)| v.is_finite() && e.is_finite() && *v != 0.0)
            .collect();
        let (slope, t) = slope_through_zero(&pairs)?;
        (slope < 0.0 && t > CLEAR).then_some(Lag {
            joint,
            slope,
            by_speed,
            samples: pairs.len(),
        })
    };
    let by_speed = samples.speed[joint].as_ref();
    let by_side = samples.dir[joint].as_ref();
    by_speed
        .and_then(|v| follows(v, true))
        .or_else(|| by_side.and_then(|v| follows(v, false)))
}

/// Standard errors from which on a slope is no accident.
const CLEAR: f64 = 5.0;

impl Lag {
    fn of<'c>(
        &self,
        speed: Option<&'c Vec<f64>>,
        side: Option<&'c Vec<f64>>,
    ) -> Option<&'c Vec<f64>> {
        if self.by_speed { speed } else { side }
    }

    fn problem(&self) -> DataProblem {
        let number = self.joint + 1;
        let samples = self.samples;
        let (evidence, what) = if self.by_speed {
            (
                text!(
                    "read − commanded follows the speed over {samples} samples, and the measured points fit the commands better",
                    samples
                ),
                text!(
                    "the values read back from joint {joint} lag the command by {time} ms",
                    joint = number,
                    time = format!("{:.2}", -1000.0 * self.slope)
                ),
            )
        } else {
            (
                text!(
                    "read − commanded follows the side over {samples} samples, and the measured points fit the commands better",
                    samples
                ),
                text!(
                    "the values read back from joint {joint} lag the command by {turn} towards the side it came from",
                    joint = number,
                    turn = angle(-self.slope, 4)
                ),
            )
        };
        DataProblem {
            what,
            evidence,
            proposal: text!(
                "read joint {joint} back at standstill; taken as they are, these values look like backlash or tracking lag",
                joint = number
            ),
            mend: None,
            samples: Vec::new(),
        }
    }
}

/// Root mean square of what the base fit leaves, mm.
fn left_mm(session: &Session, values: JointValues) -> f64 {
    let mut problem = Problem::new(session, values);
    let joints = session.robot.joints.as_slice();
    let single = matches!(joints, [joint] if joint.kind == JointKind::Revolute);
    let base = DEFAULT_EFFECTS.iter().filter_map(|id| find(id));
    let mut terms: Vec<Term> = base
        .filter(|e| single || e.about().role == Role::JointZero)
        .flat_map(|e| (0..session.robot.joints.len()).map(move |j| Term::absent(e, j, 0.0)))
        .collect();
    terms.extend(free_frames(session, &problem));
    let start = Model::new(session.robot.clone(), terms);
    let fitted = if base_model::is_arm(session) {
        let start = base_model::start(session, &problem, |_| true);
        base_model::fit(&mut problem, &start, true).solution
    } else {
        fit_without_outliers(&mut problem, &start)
    };
    let left = deviations(&problem, &fitted.model);
    let spread = Spread::of(&left.length_mm, |i| problem.used[i], |_| false);
    spread.map_or(f64::INFINITY, |s| s.rms_mm)
}

/// Slope of a line through zero, and its t value.
fn slope_through_zero(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = pairs.len();
    if n < 8 {
        return None;
    }
    let xx: f64 = pairs.iter().map(|p| p.0 * p.0).sum();
    let xy: f64 = pairs.iter().map(|p| p.0 * p.1).sum();
    let slope = xy / xx;
    let left: f64 = pairs.iter().map(|p| (p.1 - slope * p.0).powi(2)).sum();
    let error = (left / (n - 1) as f64 / xx).sqrt();
    Some((slope, slope.abs() / error.max(1e-300)))
}
