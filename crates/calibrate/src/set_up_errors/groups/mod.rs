//! Places that samples share and that are elsewhere than they should be: a target in the tool, a socket on the table,
//! a setup, a station, a plane, an anchor. One place that is off affects everything that is fitted with it.
//!
//! Each is freed alone, together with the whole base model, and reported where the samples are much likelier then, the
//! residuals clearly smaller, and the place is off by more than its uncertainty.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a setting is a small whole number"
)]

mod evidence;
mod moved;
mod placed;
mod targets;

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::Session;

pub(super) use evidence::evidence;
pub(super) use targets::problem as target_elsewhere;

/// With fewer samples nothing is reported.
const FEWEST_SAMPLES: usize = 16;
/// Exchanged names hide other places that are elsewhere: so often the search is repeated with the right ones.
const MOST_RENAMED: usize = 3;

/// The places that are elsewhere.
pub(super) fn elsewhere(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let mut problems = Vec::new();
    if session.samples.len() < FEWEST_SAMPLES {
        return problems;
    }
    let mut now = session.clone();
    for _ in 0..=MOST_RENAMED {
        let Some(placed) = placed::placed(&now, values) else {
            break;
        };
        for correction in placed
            .problems
            .iter()
            .filter_map(|problem| problem.mend.as_ref())
        {
            correction.apply(&mut now);
        }
        problems.extend(placed.problems);
        if !placed.is_renamed {
            break;
        }
    }
    problems.extend(targets::elsewhere(&now, values));
    problems
}
