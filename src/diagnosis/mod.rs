//! Finding and naming what is missing: where simulation and measurement disagree, which physical
//! effect does it, how sure that is, and what to measure next where it is not.
//!
//! The way, one file for each idea:
//!
//! 1. [`crate::set_up_errors`]: mistakes of setting up are tried first and mended for what follows.
//! 2. `crate::fit::noise`: residuals of the robust base fit, whitened by axis and in time.
//! 3. `candidates`: every testable name with every setting, and anonymous shapes beside them.
//! 4. `familywise`: what the whole search would find in noise alone.
//! 5. `search`: forward, swaps, drops, pairs; `held_out` proves each step on unseen samples.
//! 6. `aliases`: rivals that the samples cannot rule out. Poses that can are proposed by a planner
//!    that the caller hands in ([`crate::pipeline::diagnose`] takes [`crate::design`]'s).
//! 7. `limits`: what would have been seen, had it been there.
//! 8. `smooth`: what no name explains, as a correction without a name.
//! 9. `unnamed`: what predicts unseen poses and has no name, in the model all the same.
//!
//! Family-wise false alarms: Westfall & Young 1993. Marginal likelihood: Schwarz 1978. Poses:
//! T-optimality, Atkinson & Fedorov 1975.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers, simulated residuals are single precision"
)]

pub(crate) mod aliases;
pub(crate) mod candidates;
pub(crate) mod columns;
mod evidence;
mod exchanged;
pub(crate) mod familywise;
pub(crate) mod limits;
mod memo;
mod of_base;
mod placed;
pub(crate) mod smooth;
mod smooth_rival;

mod base_misfit;
pub(crate) mod classes;
pub(crate) mod conclude;
mod final_set;
mod fitting;
mod floor;
mod free_curve;
mod gross;
mod handed_out;
mod held_out;
mod incomplete;
mod known_fits;
mod left_out;
mod of_group;
mod orders;
pub(crate) mod other_settings;
mod own_evidence;
mod refine;
pub(crate) mod regression;
pub(crate) mod shape_space;

pub(crate) mod prepare;
pub(crate) mod projected;
mod remainder;
mod rescanned;
mod robust;
mod run_away;
mod scores;
pub(crate) mod search;
mod selection;
mod shapes;
pub(crate) mod significance;
mod step_time;
mod steps;
pub(crate) mod surroundings;
pub(crate) mod testable;
mod trials;
mod unnamed;
mod unseen;
mod values;
mod verdict;
mod withheld;
pub(crate) mod work;

pub use crate::answers::diagnosis::{
    Correction, Diagnosis, Equivalent, FamilyP, Floor, FloorFrom, Found, Gaps, HeldOut,
    NotTestable, Stopped, Unexplained, Unnamed, Verdict,
};
pub use crate::answers::limits::{Limit, Sight};
pub use crate::answers::pose::NextPose;
pub use crate::sessions::Mend;
pub use candidates::Allowed;
pub(crate) use conclude::Planner;

use crate::text::Text;
use std::cell::Cell;

use crate::effects::Owner;
use crate::effects::{JointValues, Term};
use crate::fit::noise::Noise;
use crate::sessions::Session;
use crate::set_up_errors::{self, Mended};
use prepare::Prepared;
use work::{FIRST_SEARCH, OTHER_SETS, RIVALS, SECOND_SEARCH, Work};

/// What to look for, and how.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Names that may be used.
    pub allowed: Allowed,
    /// Most effects to add; at most a tenth of the number of samples anyway.
    pub max_effects: Option<usize>,
    /// Share of the samples to lock away from everything.
    pub held_out: Option<f64>,
    /// Seed of the simulated residuals.
    pub seed: u64,
    /// Joint values to start from.
    pub joint_values: JointValues,
    /// Whether what no name explains is to be corrected by a smooth curve.
    pub correct_unexplained: bool,
    /// Whether a watcher that stops the search gets what is proven until then, said to be that; else
    /// [`DiagnoseError::Cancelled`].
    pub keep_when_stopped: bool,
    /// Whether the model holds names and geometry only, and nothing that predicts without a name.
    pub without_unnamed: bool,
    /// On how many threads the parts of a search are done that do not depend on each other; `None`: on two where
    /// the machine has them. The answer is the same to the last bit.
    pub threads: Option<usize>,
}

/// How far the diagnosis is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Progress {
    /// Looking for blunders.
    Checking,
    /// Fitting the base, preparing the candidates.
    Preparing,
    /// Searching; what was found so far may still be exchanged for something likelier.
    Searching {
        /// Names of the effects so far, in the order in which they act, of several joints each with
        /// its joint.
        found: Vec<String>,
        /// Share of the most that a search may cost, percent; it may end at any.
        percent: u8,
    },
    /// Comparing with other explanations.
    Comparing,
    /// Looking for poses to measure next.
    Planning,
}

/// Is told of progress; answers whether to go on.
pub type Watch<'a> = &'a dyn Fn(&Progress) -> bool;

/// The watcher asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

/// Why there is no diagnosis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DiagnoseError {
    /// No effect of this name.
    UnknownEffect(String),
    /// The share to lock away makes no sense.
    HeldOutShare(String),
    /// Every sample is held out or cannot be used.
    NothingToFit,
    /// The session is no whole one: columns of different lengths, more joints than a robot has.
    Rejected(crate::diagnostic::Rejected),
    /// The watcher asked to stop.
    Cancelled,
}

impl DiagnoseError {
    /// In words.
    pub fn says(&self) -> Text {
        match self {
            Self::UnknownEffect(effect) => text!(
                "no effect is called '{effect}'; `truepose effects` lists them",
                effect = effect
            ),
            Self::HeldOutShare(share) => text!(
                "--held-out is {share}; expected a share above 0 and below 1, such as 0.25",
                share = share
            ),
            Self::NothingToFit => text!(
                "no sample can be fitted: every one is held out, or lacks a joint value or a measured point (x_mm, y_mm)"
            ),
            Self::Rejected(inner) => inner.says(),
            Self::Cancelled => text!("stopped"),
        }
    }
}

displays_what_it_says!(DiagnoseError);

impl std::error::Error for DiagnoseError {}

impl From<crate::diagnostic::Rejected> for DiagnoseError {
    fn from(error: crate::diagnostic::Rejected) -> Self {
        Self::Rejected(error)
    }
}

impl From<Cancelled> for DiagnoseError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Diagnoses a session; `planner` proposes poses for what stays undecided.
///
/// # Errors
/// If an option makes no sense, if there is no sample to fit, or if the watcher stops it.
pub(crate) fn diagnose(
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
    let mended = checked(session, options, watch)?;
    let (prepared, found) = searched(&mended.session, options, watch)?;
    let told = until_stopped(&prepared.regression.work, options, watch);
    conclude::answer(&mended, &prepared, &found, planner, &told)
}

/// A watcher who is not asked again once the search was stopped, where what is proven until then is wanted.
fn until_stopped<'w>(
    work: &'w Work,
    options: &Options,
    watch: Watch<'w>,
) -> impl Fn(&Progress) -> bool + use<'w> {
    let keep = options.keep_when_stopped;
    move |progress| {
        if work.was_stopped() || watch(progress) {
            return true;
        }
        if keep {
            work.stop();
        }
        keep
    }
}

/// The session without its blunders.
pub(crate) fn checked<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<Mended<'a>, Cancelled> {
    if !watch(&Progress::Checking) && !options.keep_when_stopped {
        return Err(Cancelled);
    }
    Ok(set_up_errors::mended(session, options.joint_values))
}

/// The search, done again once with the names known: outliers and noise look different then. Where
/// a slow part of the noise may explain as much, it is searched beside that as well, and the
/// likelier end wins. What is found is tested again at the end.
pub(crate) fn searched<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<(Prepared<'a>, search::Found), DiagnoseError> {
    let goes_on = watch(&Progress::Preparing);
    if !goes_on && !options.keep_when_stopped {
        return Err(DiagnoseError::Cancelled);
    }
    let mut prepared = Prepared::new(session, options)?;
    let work = prepared.regression.work.clone();
    if !goes_on {
        // Geometry alone is an answer too.
        work.stop();
    }
    let told = until_stopped(&work, options, watch);
    let watch: Watch = &told;
    work.up_to(FIRST_SEARCH);
    let mut found = prepared.search(watch)?;
    work.up_to(SECOND_SEARCH);
    let unfinished = work.ended().is_some();
    if prepared.reconsider(&found) || unfinished {
        work.begin_again();
        found = if unfinished || prepared.may_go_on(&found) {
            prepared.search_on(&found, watch)?
        } else {
            prepared.search(watch)?
        };
    }
    work.up_to(RIVALS);
    // A search that may not go on leaves names unsaid: neither a slow part of the noise nor a free
    // curve is held against those it has, and the verdict says that something is left.
    if !prepared.is_capped(&found) {
        (prepared, found) = against_rivals(&prepared, found, watch)?;
        // What was held against the end was not left out of it.
        work.begin_again();
    }
    work.up_to(OTHER_SETS);
    final_set::test(&prepared, &mut found, watch)?;
    if final_set::exchanged(&prepared, &mut found) {
        final_set::test(&prepared, &mut found, watch)?;
    }
    final_set::as_said(&prepared, &mut found, watch)?;
    base_misfit::withdraw(&prepared, &mut found);
    gross::withdraw(&prepared, &mut found);
    work.up_to(1.0);
    Ok((prepared, found))
}

/// What was found against a slow part of the noise and a free curve: the likeliest of them.
fn against_rivals<'a>(
    prepared: &Prepared<'a>,
    mut found: search::Found,
    watch: Watch,
) -> Result<(Prepared<'a>, search::Found), DiagnoseError> {
    let slow = prepared.slow_noise();
    let instead = prepared.slow_noise_instead(&found.fit);
    let instead = instead.filter(|n| slow.as_ref().is_none_or(|s| !s.whitens_like(n)));
    let noise = &prepared.regression.noise;
    let white = noise.slow.map(|_| noise.made_white());
    let (mut prepared, fit) = prepared.settled(&found.fit);
    found.fit = fit;
    free_curve::rival(&prepared, &mut found);
    smooth_rival::rival(&prepared, &mut found);
    let mut others = Vec::new();
    for noise in white.into_iter().chain(slow).chain(instead) {
        let known = &prepared.regression.noise;
        let (rival, end) = settled_search(prepared.with_noise(noise), known, watch)?;
        let loser = if standing(&rival, &end) > standing(&prepared, &found) {
            prepared = rival;
            std::mem::replace(&mut found, end)
        } else {
            end
        };
        others.push(loser.fit);
    }
    if prepared.regression.noise.slow.is_some() {
        let white = prepared.with_noise(prepared.regression.noise.made_white());
        if let Some(curve) = free_curve::instead_of_slow(&white, &found) {
            (prepared, found) = (white, curve);
        }
    }
    let least = found.fit.ln_evidence - aliases::UNDECIDED;
    others.retain(|other| other.shapes.is_empty() && other.ln_evidence > least);
    found.other_ends = others;
    Ok((prepared, found))
}

/// How likely an end of a search is beside the others. A step or a drift of the measuring frame is a
/// movement of the frame as a slow part of the noise is, and no set of equivalent names can hold the
/// noise: such a name stands unless the noise rules it out.
fn standing(prepared: &Prepared, end: &search::Found) -> f64 {
    let names = prepared.regression.added(&end.fit);
    let of_the_frame = |t: &&Term| t.effect.about().owner == Owner::Session;
    let only = !names.is_empty() && names.iter().all(of_the_frame);
    let favour = prepared.regression.noise.slow.is_none() && only && end.fit.shapes.is_empty();
    end.fit.ln_evidence + if favour { aliases::UNDECIDED } else { 0.0 }
}

/// A search whose noise is estimated beside what it finds, until that is the same, or one that was searched
/// already.
fn settled_search<'a>(
    mut prepared: Prepared<'a>,
    searched: &Noise,
    watch: Watch,
) -> Result<(Prepared<'a>, search::Found), DiagnoseError> {
    let mut found = prepared.search(watch)?;
    for _ in 0..3 {
        let (settled, fit) = prepared.settled(&found.fit);
        let noise = &settled.regression.noise;
        let same = noise.whitens_like(&prepared.regression.noise);
        let known = noise.whitens_like(searched);
        (prepared, found.fit) = (settled, fit);
        if same || known {
            break;
        }
        found = prepared.search_on(&found, watch)?;
    }
    free_curve::rival(&prepared, &mut found);
    smooth_rival::rival(&prepared, &mut found);
    Ok((prepared, found))
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), DiagnoseError> {
        let named = self.allowed.without.iter();
        for id in named.chain(self.allowed.only.iter().flatten()) {
            if crate::effects::find(id).is_none() {
                return Err(DiagnoseError::UnknownEffect(id.clone()));
            }
        }
        match self.held_out {
            Some(share) if !(share > 0.0 && share < 1.0) => {
                Err(DiagnoseError::HeldOutShare(share.to_string()))
            }
            _ => Ok(()),
        }
    }
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
}
