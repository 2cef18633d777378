//! Targets that are written as places in the base frame, at home, where places in the tool are asked for. The fitted
//! position of the tool hides that, and every corrected target is off by it.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Session, SessionCorrection};
use crate::text::length;

use super::changes::frame_is_free;
use super::fits::{share_within, thinned};
use super::nearest::Nominal;
use super::thresholds::{FEW_SAMPLES, GROSS_SHARE, HALF, PLAUSIBLE_SHARE, size_mm};

/// The residual of the nominal robot has to fall to less than this share …
const CORRECTED: f64 = 0.1;

/// Targets that are not places in the tool.
pub(super) fn stated_there(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let mut stated = session
        .targets
        .iter()
        .map(|target| target.position_mm.coords);
    if stated.all(|place| place.norm() == 0.0) {
        return Vec::new();
    }
    let part = thinned(session, FEW_SAMPLES);
    let residual_mm = |part: &Session| {
        let lengths = Nominal::of(part, values).lengths_mm(frame_is_free(part));
        share_within(lengths, HALF)
    };
    let correction = SessionCorrection::TargetsFromBase;
    let mut as_places = part.clone();
    correction.apply(&mut as_places);
    let [before, after] = [residual_mm(&part), residual_mm(&as_places)];
    let is_gross = before >= GROSS_SHARE * size_mm(session);
    let enough = (CORRECTED * before).min(PLAUSIBLE_SHARE * part.samples.spread_mm());
    if !before.is_finite() || !is_gross || after > enough {
        return Vec::new();
    }
    vec![DataProblem::of_all(
        text!("the targets are places in the base frame, not in the tool"),
        text!(
            "where it fits best the nominal robot leaves a median error of {before} with places in the tool and {after} with places at home in the base frame",
            before = length(before, 3),
            after = length(after, 3)
        ),
        text!("write each target as its place in the tool's frame"),
        correction,
    )]
}
