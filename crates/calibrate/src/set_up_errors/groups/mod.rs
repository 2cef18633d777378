//! Places that samples share and that are elsewhere than they should be: a target in the tool, a socket
//! on the table, a setup, a station, a plane, an anchor. One place that is off spreads over everything that is
//! fitted beside it.
//!
//! Each is set free by itself, with the whole base model beside it, and believed where the samples are
//! likelier by far then, leave clearly less, and the place is off by more than what is known of it.

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

/// With fewer samples nothing is told.
const FEWEST_SAMPLES: usize = 16;
/// Names that are exchanged hide what else is elsewhere: so often the search begins anew with the right ones.
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
