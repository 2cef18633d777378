//! Poses that part models: all comparisons at once, and where the reflectors that are there do not do it,
//! with the place of another one.

use crate::diagnosis::NextPose;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::kinematics::{Joint, JointKind};
use crate::sessions::Target;
use crate::text::Text;

use super::candidate_poses::CandidatePoses;
use super::comparison::{Comparison, ModelDistance};
use super::decision::{Decision, SURE};
use super::exchange::Criterion;
use super::reflectors::other_reflectors;

/// A separation that decides whatever the noise does.
const MOST_SEPARATION: f64 = 1e6;
/// All models are asked to be so much further apart where too few draws are decided.
const FURTHER: f64 = 1.3;
/// Another reflector has to gain so much more, as a share of what is needed.
const WORTH_MOUNTING: f64 = 0.03;

/// Models that have to be distinguished: as far as each comparison asks for, and where there is a decision until the
/// right one is found often enough. No candidate is taken more than `repeats` times.
pub(crate) struct ModelSeparation {
    pub(crate) comparisons: Vec<Comparison>,
    pub(crate) decision: Option<Decision>,
    taken: Vec<u8>,
    repeats: u8,
}

impl ModelSeparation {
    pub(crate) fn new(comparisons: Vec<Comparison>, candidates: usize, repeats: u8) -> Self {
        Self {
            comparisons,
            decision: None,
            taken: vec![0; candidates],
            repeats,
        }
    }

    /// Each pair of models.
    pub(crate) fn distances(&self) -> impl Iterator<Item = &ModelDistance> {
        self.comparisons.iter().flat_map(|c| &c.distances)
    }

    pub(crate) fn parted(&self) -> bool {
        self.distances().all(ModelDistance::decided)
    }
}

impl Criterion for ModelSeparation {
    fn worths(&self) -> Vec<f64> {
        // The gain of each comparison counts up to where it is decided.
        let one =
            |c: &ModelDistance, gain: f64| gain.min(c.enough - c.delta).max(0.0) / (1.0 + c.delta);
        let open: Vec<&Comparison> = self.comparisons.iter().filter(|c| !c.decided()).collect();
        let worth = |k: usize| open.iter().map(|c| c.worth(k, one)).sum();
        let free = |k: usize| self.taken[k] < self.repeats;
        let all = 0..self.taken.len();
        all.map(|k| if free(k) { worth(k) } else { 0.0 }).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.taken[candidate] += 1;
        let all = &mut self.comparisons;
        match &mut self.decision {
            Some(decision) => decision.take(all, candidate),
            None => all.iter_mut().for_each(|one| one.take(candidate, None)),
        }
    }

    fn satisfied(&mut self) -> bool {
        let Some(decision) = &self.decision else {
            return self.parted();
        };
        if decision.probability() >= SURE {
            return true;
        }
        // All are far enough apart and still too few draws are decided: further apart, then.
        let can = |c: &ModelDistance| c.enough < MOST_SEPARATION;
        while self.distances().next().is_some() && self.parted() && self.distances().all(can) {
            for one in self.comparisons.iter_mut().flat_map(|c| &mut c.distances) {
                one.enough = FURTHER * one.enough.max(1.0);
            }
        }
        false
    }
}

/// Poses for one set of reflectors.
pub(crate) struct Attempt<'p> {
    pub(crate) candidates: CandidatePoses<'p>,
    /// The candidates that were chosen.
    pub(crate) order: Vec<usize>,
    /// Pairs of models that none of the candidates part.
    pub(crate) unparted: usize,
    pub(crate) decides: bool,
    /// The share of what is needed that they gain.
    pub(crate) score: f64,
}

impl Attempt<'_> {
    /// The poses that were chosen, at most `most`.
    pub(crate) fn poses(&self, why: &Text, most: usize) -> Vec<NextPose> {
        let joints = &self.candidates.regression.base.robot.joints;
        let place = |(q, joint): (&f64, &Joint)| match joint.kind {
            JointKind::Revolute => format!("{:.1}°", joint.kind.to_display(*q)),
            JointKind::Prismatic => format!("{q:.1} mm"),
        };
        let poses = self.order.iter().flat_map(|k| {
            let places = self.candidates.candidates[*k]
                .q
                .iter()
                .zip(joints)
                .map(place);
            let places = places.collect::<Vec<String>>().join(", ");
            let why = text!("{why}: they differ most at {places}", why, places);
            self.candidates.poses(*k, &why)
        });
        poses.take(most).collect()
    }

    fn better_than(&self, other: &Self) -> bool {
        if self.unparted != other.unparted {
            return self.unparted < other.unparted;
        }
        match (self.decides, other.decides) {
            (true, true) => self.order.len() < other.order.len(),
            (false, false) => self.score > other.score + WORTH_MOUNTING,
            (decides, _) => decides,
        }
    }
}

/// The best attempt: with the session's reflectors where these decide, else where there is but one perhaps
/// with one of the places for another.
pub(crate) fn over_reflectors<'p, T>(
    prepared: &PreparedSearch,
    attempt: impl Fn(Vec<Target>) -> (Attempt<'p>, T),
) -> (Attempt<'p>, T) {
    let session = prepared.problem.session;
    let mut best = attempt(session.targets.clone());
    // Another reflector is offered where points are measured: to an anchor or a socket it is another
    // machine.
    if best.0.decides || prepared.problem.observed.is_some() {
        return best;
    }
    for other in other_reflectors(&session.robot, &session.targets) {
        let with = session.targets.iter().cloned().chain([other]);
        let next = attempt(with.collect());
        if next.0.better_than(&best.0) {
            best = next;
        }
    }
    best
}
