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
mod fitted;
mod moved;
mod placed;
mod targets;

use crate::effects::JointValues;
use crate::sessions::Session;

pub(super) use evidence::evidence;
pub(super) use fitted::{fitted, left_mm, start_of};
pub(super) use targets::problem as target_elsewhere;

use super::DataProblem;
/// With fewer samples nothing is told.
const FEWEST_SAMPLES: usize = 16;

/// Names that are exchanged hide what else is elsewhere: so often the search begins anew with the right ones.
const MOST_RENAMED: usize = 3;

/// The session with those places free that are elsewhere; `None` where none is.
pub(super) fn freed(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    if session.samples.len() < FEWEST_SAMPLES {
        return None;
    }
    let mut now: Option<Session> = None;
    for _ in 0..=MOST_RENAMED {
        let here = now.as_ref().unwrap_or(session);
        let Some(placed) = placed::placed(here, values) else {
            break;
        };
        problems.extend(placed.problems);
        now = Some(placed.session);
        if !placed.is_renamed {
            break;
        }
    }
    let here = now.as_ref().unwrap_or(session);
    let elsewhere = targets::elsewhere(here, values, problems);
    elsewhere.or(now)
}
