//! Effects of instruments, stations and mountings that no session states: the likeliest of a list of hypotheses, each
//! a few columns in addition to the fitted robot and what else may look like it.

use super::examined::{Examined, Unstated};
use super::{gravity, refraction, settling, station_scale};
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::Session;

type Hypothesis = fn(&Session, JointValues, &Examined) -> Option<Unstated>;

/// Every hypothesis.
const HYPOTHESES: [Hypothesis; 4] = [
    settling::settles,
    refraction::bends,
    station_scale::differs,
    gravity::runs_otherwise,
];

/// The likeliest of them.
pub(super) fn likeliest(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let Some(examined) = Examined::at(session, values) else {
        return Vec::new();
    };
    let found = HYPOTHESES
        .iter()
        .filter_map(|of| of(session, values, &examined));
    let best = found.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, problem)| problem).into_iter().collect()
}
