//! Diagnosis: finding and naming the effects that a model lacks. Where simulation and measurement disagree, which
//! physical effect is the cause, how certain that is, and what to measure next where it is not.
//!
//! The steps, one module for each; a module uses only those before it:
//!
//! 1. [`crate::set_up_errors`]: mistakes of setting up are tried first and corrected for what follows.
//! 2. `crate::fit::noise`: residuals of the robust base fit, whitened by axis and in time.
//! 3. `candidates`: every testable name with every setting, and anonymous shapes.
//! 4. `evidence`: the gain of each, what the whole search would find in noise alone, and cross-validation.
//! 5. `rest`: the part of the error that repeats and has no name.
//! 6. `search`: forward, swaps, drops, pairs, rivals; `search::searched` is all of it on one screen.
//! 7. `verdict`: values with intervals, the unexplained rest, limits of detection, what predicts without a name. Poses
//!    that decide between rivals are proposed by a planner that the caller hands in (`pipeline::diagnose` takes
//!    [`crate::design`]'s).
//!
//! Family-wise false alarms: Westfall & Young 1993. Marginal likelihood: Schwarz 1978. Poses:
//! T-optimality, Atkinson & Fedorov 1975.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers, simulated residuals are single precision"
)]

pub(crate) mod candidates;
pub(crate) mod evidence;
pub(crate) mod rest;
pub(crate) mod search;
pub(crate) mod verdict;

mod error;
mod options;
mod progress;

pub use crate::answers::diagnosis::{
    Correction, Diagnosis, Equivalent, FamilyP, Floor, FloorFrom, FoundEffect, Gaps, HeldOut,
    NotTestable, Stopped, Unexplained, Unnamed, Verdict,
};
pub use crate::answers::limits::{Detectability, Limit};
pub use crate::answers::pose::NextPose;
pub use crate::sessions::SessionCorrection;
use candidates::incomplete;
pub use candidates::table::Allowed;
pub use error::DiagnoseError;
pub use options::Options;
pub use progress::{Cancelled, Progress, Watch};
use search::prepare::PreparedSearch;
use search::until_stopped;
pub(crate) use search::{checked, prepared, searched};
pub(crate) use verdict::Planner;

use std::cell::Cell;

use crate::sessions::Session;
use crate::set_up_errors::CorrectedSession;

/// Diagnoses a session; `planner` proposes poses for open questions.
///
/// # Errors
/// If an option makes no sense, if there is no sample to fit, or if the watcher stops it.
#[doc(hidden)]
pub fn diagnose(
    session: &Session,
    options: &Options,
    planner: Planner,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    options.check()?;
    let stopped = Cell::new(false);
    let asked = |progress: &Progress| {
        let goes_on = !stopped.get() && watch(progress);
        stopped.set(!goes_on);
        goes_on
    };
    let watch: Watch = &asked;
    let corrected = checked(session, options, watch)?;
    let first = prepared(&corrected.session, options, watch)?;
    let (prepared, answer) = answered(&corrected, first, options, planner, watch)?;
    let sides_matter = prepared.incomplete.as_ref().is_none_or(|lacking| {
        let (problem, noise_mm) = (&prepared.problem, answer.floor.mm);
        !incomplete::only_sides_that_matter_little(problem, lacking, &answer.model, noise_mm)
    });
    if sides_matter || answer.stopped.is_some() {
        return Ok(answer);
    }
    let all = PreparedSearch::of(&corrected.session, options, |_| None)?;
    Ok(answered(&corrected, all, options, planner, watch)?.1)
}

/// Searches a prepared session and makes the answer.
fn answered<'a>(
    corrected: &'a CorrectedSession,
    prepared: PreparedSearch<'a>,
    options: &Options,
    planner: Planner,
    watch: Watch,
) -> Result<(PreparedSearch<'a>, Diagnosis), DiagnoseError> {
    let (prepared, found) = searched(prepared, options, watch)?;
    let keep_going = until_stopped(&prepared.regression.work, options, watch);
    let answer = verdict::answer(corrected, &prepared, &found, planner, &keep_going)?;
    drop(keep_going);
    Ok((prepared, answer))
}

#[cfg(test)]
pub(super) mod tests {
    use crate::sessions::Session;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis with an eccentric encoder, measured in steps of so many degrees from both sides.
    pub(in crate::diagnosis) fn eccentric(step_deg: u32, amplitude_deg: f64) -> Session {
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"eccentric","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.03}},
            "poses":{{"sweep":{{"joint":1,"from_deg":-165,"to_deg":165,"step_deg":{step_deg},"both_ways":true}}}},
            "effects":[{{"effect":"encoder-eccentricity","joint":1,
            "parameters":{{"amplitude_deg":{amplitude_deg},"phase_deg":40}}}}],
            "noise":{{"sigma_mm":0.03,"kind":"gauss"}},"seed":4}}"#
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        simulate(&scenario, 1, unwatched).unwrap().0
    }

    /// Two axes, the second on the first, with these effects: joint, amplitude or width in degrees as a scenario has them.
    pub(in crate::diagnosis) fn two_axes(effects: &str) -> Session {
        let stops = (0..120).map(|k| {
            let turn = |by: f64| 240.0 * (f64::from(k) * by).fract() - 120.0;
            let (tilt, turn) = (0.5 * turn(0.754_877_666), turn(0.569_840_291));
            let side = |by: u32| if (k / by).is_multiple_of(2) { 1 } else { -1 };
            let (a, b) = (side(1), side(3));
            format!(r#"{{"q_deg":[{tilt},{turn}],"dir":[{a},{b}]}}"#)
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"positioner","robot":{{"name":"r","joints":[
            {{"name":"tilt","kind":"revolute","axis":[0,-1,0],"point_mm":[0,0,300]}},
            {{"name":"turn","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,300]}}],
            "tool":{{"position_mm":[300,50,200],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.03}},"poses":{{"list":[{}]}},"effects":[{effects}],
            "noise":{{"sigma_mm":0.03,"kind":"gauss"}},"seed":1}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        simulate(&scenario, 1, unwatched).unwrap().0
    }
}
