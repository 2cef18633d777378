//! Targets that are written as places in the base frame, at home, where places in the tool are asked for. The tool's
//! position takes that up without a trace, and every corrected target is off by it.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Session, SessionCorrection};
use crate::text::length;

use super::as_it_stands::nominal_mm;
use super::thinned::thinned_to;
use super::thresholds::{FEW_SAMPLES, GROSS_SHARE, HALF, PLAUSIBLE_SHARE};

/// What the nominal robot leaves has to fall to less than this share of what it was …
const MENDED: f64 = 0.1;

/// The session with its targets as places in the tool; `None` where they are.
pub(super) fn corrected(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let stated = session
        .targets
        .iter()
        .any(|target| target.position_mm.coords.norm() > 0.0);
    if !stated {
        return None;
    }
    let part = thinned_to(session, FEW_SAMPLES);
    let before = nominal_mm(&part, values, true, HALF);
    if !before.is_finite() || before < GROSS_SHARE * session.robot.length_along_links_mm() {
        return None;
    }
    let mend = SessionCorrection::TargetsFromBase;
    let mut as_places = part.clone();
    mend.apply(&mut as_places);
    let after = nominal_mm(&as_places, values, true, HALF);
    if after > (MENDED * before).min(PLAUSIBLE_SHARE * part.samples.spread_mm()) {
        return None;
    }
    let mut better = session.clone();
    mend.apply(&mut better);
    problems.push(DataProblem {
        what: text!("the targets are places in the base frame, not in the tool"),
        evidence: text!(
            "where it fits best the nominal robot leaves a median error of {before} with places in the tool and {after} with places at home in the base frame",
            before = length(before, 3),
            after = length(after, 3)
        ),
        proposal: text!("write each target as its place in the tool's frame"),
        mend: Some(mend),
        samples: Vec::new(),
    });
    Some(better)
}
