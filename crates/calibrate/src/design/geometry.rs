//! How well a number of poses determines the geometry of a robot with several joints.

use super::arm::Arm;
use super::candidate_set::CandidateSet;
use super::conditions::conditioned;
use super::plan::{ExpectedError, Forecast, Geometry};
use crate::diagnosis::{DiagnoseError, NextPose};

/// The expected error is stated for so many poses.
const CURVE: [usize; 4] = [20, 30, 50, 100];
/// A wanted accuracy is looked for up to so many poses.
const MOST: usize = 400;
/// Sets of random poses that a robot's plan is compared with.
const RANDOM_SETS: usize = 20;

/// Poses that show the geometry best, under conditions that show the effects, and what they do: so many, or as many as
/// bring the 95th percentile of the expected error below an accuracy.
pub(crate) fn best(
    arm: &Arm,
    poses: usize,
    accuracy_mm: Option<f64>,
) -> Result<(Vec<NextPose>, Geometry), DiagnoseError> {
    let unseen = || {
        DiagnoseError::Option(text!(
            "no pose within the joint limits can be measured: none is seen from where the instrument stands, or brings the target to where it is held; expected limits, a place or a cone that leave some"
        ))
    };
    let set = arm.spread().ok_or_else(unseen)?;
    let count = accuracy_mm.map_or(Ok(poses), |mm| enough(&set, mm))?;
    let end = arm.designed(&set, count);
    let all: Vec<usize> = (0..end.candidates.len()).collect();
    let curve = CURVE
        .into_iter()
        .map(|count| (count, set.forecast(&set.chosen(count)).error));
    let geometry = Geometry {
        parameters: set.information.covariance.nrows(),
        before: if set.before > 0 {
            set.forecast(&[])
        } else {
            of_random(arm, &set, count)
        },
        after: end.forecast(&all),
        curve: curve.collect(),
        enough: accuracy_mm.map(|mm| (mm, count)),
    };
    Ok((conditioned(arm, &end.candidates), geometry))
}

/// The smallest number of poses that reaches an accuracy: greedily first, then with fewer that are
/// exchanged.
fn enough(set: &CandidateSet, wanted: f64) -> Result<usize, DiagnoseError> {
    let reached = |error: &ExpectedError| error.p95_mm <= wanted;
    if reached(&set.forecast(&[]).error) {
        return Ok(0);
    }
    let trace = set.trace(MOST);
    let reached_at = trace.iter().position(reached);
    let at = reached_at.ok_or_else(|| {
        let reached = trace.last().map_or(f64::INFINITY, |e| e.p95_mm);
        DiagnoseError::Option(text!(
            "--accuracy {wanted}: {most} poses are expected to leave {reached} mm (95th percentile over the joint ranges); expected a larger value, or a smaller --sigma",
            wanted,
            most = MOST,
            reached = format!("{reached:.4}")
        ))
    })?;
    let (mut few, mut enough) = (at.div_ceil(2), at + 1);
    while few + 1 < enough {
        let middle = few.midpoint(enough);
        if reached(&set.forecast(&set.chosen(middle)).error) {
            enough = middle;
        } else {
            few = middle;
        }
    }
    Ok(enough)
}

/// What random poses of the same number do, in the mean of several sets.
fn of_random(arm: &Arm, set: &CandidateSet, count: usize) -> Forecast {
    let random = arm.at_random(set, RANDOM_SETS * count);
    let all: Vec<usize> = (0..random.candidates.len()).collect();
    let sets = all.chunks(count.max(1)).map(|set| random.forecast(set));
    let sets: Vec<Forecast> = sets.collect();
    let n = sets.len().max(1) as f64;
    let mean = |f: &dyn Fn(&Forecast) -> f64| sets.iter().map(f).sum::<f64>() / n;
    Forecast {
        error: ExpectedError {
            rms_mm: mean(&|p| p.error.rms_mm),
            p95_mm: mean(&|p| p.error.p95_mm),
        },
        observability: mean(&|p| p.observability),
    }
}
