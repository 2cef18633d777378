//! Set-up errors, tried before any effect: on a real arm with a tracker they were larger than any effect, and imitated
//! one.
//!
//! A set-up error is a hypothesis about the data: the session is changed as the error would have it, the base fit is
//! repeated, and the change is accepted if the RMS error falls to a small part and is only then possible for a robot.
//! The search goes on with the corrected session.

mod changes;
mod examined;
mod fits;
mod gravity;
mod groups;
mod losses;
mod mistakes;
mod motor_values;
mod nearest;
mod orientation_frame;
mod orientations;
mod parts;
mod read_back;
mod refraction;
mod residuals;
mod rows;
mod settling;
mod several;
mod shifted;
mod station_scale;
mod targets_in_base;
mod thresholds;
mod unstated;

use std::borrow::Cow;

pub use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::problem::Problem;
use crate::row_checks;
pub use crate::row_checks::CorrectedSession;
use crate::sessions::Session;

/// They are tried on whole points, where they are so large a part of the samples.
const ENOUGH_POINTS: f64 = 0.5;
/// One mistake may hide another.
const MOST_MISTAKES: usize = 3;
/// Instruments, stations and mountings do no more at a time that no session states.
const MOST_UNSTATED: usize = 6;

fn has_enough_points(session: &Session, joint_values: JointValues) -> bool {
    if session.has_plain_points() {
        return true;
    }
    let points = Problem::new(session, joint_values).samples();
    let all = Problem::observing(session, joint_values).samples();
    points as f64 >= ENOUGH_POINTS * all as f64
}

/// Checks the rows, tries the set-up errors and corrects what it finds.
///
/// A session that cannot be computed with (see [`Session::checked`]) is returned unchanged.
pub fn corrected_session(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    CorrectedSession::of_whole(raw, |raw| corrected(raw, joint_values))
}

/// The same of a session that is whole.
pub(crate) fn corrected(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    without_mistakes(raw, joint_values, true)
}

/// The rows and the gross mistakes alone, for an identification.
#[doc(hidden)]
pub fn noticed(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    without_mistakes(raw, joint_values, false)
}

/// `small_ones`: samples that the instrument lost or took of another target, values that were read back late, and what
/// no session states, too. What others would stumble over comes first.
fn without_mistakes(raw: &Session, values: JointValues, small_ones: bool) -> CorrectedSession<'_> {
    let mut found = CorrectedSession::of(raw);
    for check in row_checks::CHECKS {
        found.look_for(check, values, 1);
    }
    found.look_for(shifted::shifted, values, 1);
    let whole_points = has_enough_points(raw, values);
    if whole_points {
        found.look_for(targets_in_base::stated_there, values, 1);
        // With a part that differs no one change of all rows fits, and many would be tried.
        found.look_for(parts::gross, values, MOST_MISTAKES);
        found.look_for(mistakes::of_all_rows, values, MOST_MISTAKES);
    }
    // Where coordinates have another unit, their digits are of another size.
    found.look_for(row_checks::coarse, values, 1);
    found.look_for(parts::steps, values, 1);
    found.look_for(groups::elsewhere, values, 1);
    if whole_points {
        found.look_for(orientations::of_another_convention, values, 1);
        found.look_for(orientation_frame::of_another_frame, values, 1);
    }
    if !whole_points || !small_ones {
        found.note_corrections(raw);
        return found;
    }
    let (late, better) = read_back::lagging(&found.session, values);
    found.problems.extend(late);
    if let Some(better) = better {
        found.session = Cow::Owned(better);
    }
    found.look_for(unstated::likeliest, values, MOST_UNSTATED);
    found.note_corrections(raw);
    // What is only reported was not corrected.
    let lost = losses::lost(&found.session);
    let mislocked = losses::mislocked(&found.session, values);
    found.problems.extend(lost.into_iter().chain(mislocked));
    found
}
