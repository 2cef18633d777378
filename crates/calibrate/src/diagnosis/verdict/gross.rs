//! A gross error, which no noise and no effect explains: an error of a hundredth of the robot's size, or of a turn, is
//! due to the rows, the set-up or a convention, whatever the floor. One limit for every kind of measurement, and for
//! the floor itself, which repeats and estimates raise as far as the error goes.

use crate::answers::diagnosis::{Floor, Gaps};
use crate::answers::identification::Identification;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{is_gross, size_mm};
use crate::observations::kind_in_words;
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;
use crate::text::{Text, length};
use crate::thresholds::GROSS_TURN_RAD;

/// What exceeds the limit, in words.
pub(super) fn beyond_noise(
    prepared: &PreparedSearch,
    floor: &Floor,
    gap: &Gaps,
    identification: &Identification,
    problems: &[DataProblem],
) -> Option<Text> {
    let left_out =
        |problem: &&DataProblem| problem.mend == Some(SessionCorrection::LeaveOutOrientations);
    if let Some(problem) = problems.iter().find(left_out) {
        return Some(problem.what.clone());
    }
    let size_mm = size_mm(prepared);
    for (residual_mm, figure) in [
        (gap.end_mm, phrase!("the remaining error")),
        (floor.mm, phrase!("the floor")),
    ] {
        if is_gross(residual_mm, size_mm) {
            return Some(text!(
                "{figure} is {left} on a robot of {size}: no noise is so large",
                figure,
                left = length(residual_mm, 3),
                size = length(size_mm, 0)
            ));
        }
    }
    let of_angles = |unit: &str, rms: f64| unit == "mrad" && rms / 1e3 > GROSS_TURN_RAD;
    identification.kinds.iter().find_map(|kind| {
        let rms = kind.fitted?.after_rms;
        of_angles(kind.unit, rms).then(|| {
            text!(
                "{kind} is left with {rms} mrad: no noise is so large",
                kind = kind_in_words(kind.kind),
                rms = format!("{rms:.0}")
            )
        })
    })
}
