//! Poses that decide between explanations that the samples cannot distinguish: T-optimality, greedily, over all
//! candidates.
//!
//! Each pair of explanations meets in two comparisons, for either may be the true one. Poses are
//! added until they decide all comparisons at once in `SURE` of all sessions, whichever explanation
//! is true (`decision`). Where one reflector cannot decide, the place of a second one is
//! chosen with the poses: the one that decides with the fewest.

use super::plan_options::PROPOSED;
use crate::budget;
use crate::diagnosis::NextPose;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::rival::Rival;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{MANY_NAMES, aliases};
use crate::diagnosis::verdict::{Proposal, Undecided};
use crate::effects::{Condition, Over, Term, called};
use crate::numeric::extent;
use crate::text::Text;

use super::candidate::Arrival;
use super::candidate_poses::{CandidatePoses, Conditions};
use super::comparison::ModelDistance;
use super::decision::{Decision, Explanation, SURE};
use super::enabling_poses;
use super::exchange::choose;
use super::model_separation::{Attempt, ModelSeparation, over_reflectors};
use super::plan_options::MOST_JOINTS;

/// Explanations that are compared, and of how many of them rivals are looked for.
const MOST_COMPETING: usize = 14;
/// One condition is proposed at most so often.
const REPEATS: u8 = 2;

/// Poses that distinguish the fit from its rivals, at most `most`.
pub(crate) fn separate(
    prepared: &PreparedSearch,
    fit: &Fit,
    rivals: &[&Rival],
    most: usize,
) -> Vec<NextPose> {
    if rivals.is_empty() {
        return Vec::new();
    }
    let terms = rivals
        .iter()
        .flat_map(|r| r.removed.iter().chain(&r.instead));
    let mut conditions = conditions(prepared, &terms.collect::<Vec<_>>());
    conditions.uneven = rivals.iter().any(|r| !r.other_names());
    let competing = competing(prepared, fit, rivals);
    prepared.regression.forget();
    let (best, ()) = over_reflectors(prepared, |targets| {
        let offer = CandidatePoses::new(prepared, targets, &conditions);
        (attempt(offer, &competing, most), ())
    });
    let why = why(rivals);
    let mut poses = best.poses(&why, most);
    for k in 0..poses.len() {
        let (before, rest) = poses.split_at_mut(k);
        if before.iter().any(|earlier| rest[0].repeats(earlier)) {
            let once = std::mem::take(&mut rest[0].why);
            rest[0].why = text!(
                "{why}; measured a second time, as once is not enough over the noise",
                why = once
            );
        }
    }
    poses
}

/// What to measure next: poses that decide between the rivals, or where there are none, poses that
/// make testable what the session cannot show. None of a robot with more joints than poses are planned for: how long
/// it takes to find them grows with the square of the joints and more.
pub fn propose(undecided: &Undecided) -> Proposal {
    let (prepared, fit) = (undecided.prepared, undecided.fit);
    let poses = if prepared.survey.joints.len() > MOST_JOINTS {
        Vec::new()
    } else if undecided.rivals.is_empty() {
        enabling_poses::worth_enabling(prepared, fit, undecided.not_testable)
    } else {
        separate(prepared, fit, undecided.rivals, PROPOSED)
    };
    let rivals = undecided.rivals.iter();
    Proposal {
        separate_by: rivals.map(|rival| separate_by(rival, &poses)).collect(),
        poses,
    }
}

/// Conditions that matter to these effects.
pub(crate) fn conditions(prepared: &PreparedSearch, terms: &[&Term]) -> Conditions {
    let survey = &prepared.survey;
    let distinguished_by = |condition| {
        let mut abouts = terms.iter().map(|t| t.effect.about());
        abouts.any(|about| about.distinguished_by.contains(&condition))
    };
    let moves = terms.iter().any(|t| t.effect.about().over == Over::Speed);
    let mut conditions = Conditions::after(prepared);
    let speeds_known = survey.joints.iter().any(|j| j.speeds > 0);
    if moves || speeds_known && distinguished_by(Condition::Speed) {
        conditions.speeds = vec![0.0, 1.0, 3.0];
    }
    if survey.loads > 0 && survey.largest_load_kg > 0.0 {
        conditions.loads_kg = vec![0.0, survey.largest_load_kg];
    }
    let warmth = prepared.problem.inputs.above_20_c.as_ref();
    if let Some(warmth) = warmth.filter(|_| distinguished_by(Condition::Temperature)) {
        conditions.above_20_c = extent(warmth).to_vec();
        conditions.above_20_c.dedup();
    }
    if distinguished_by(Condition::Approach) {
        let short = [0.01, 0.05].map(Arrival::Short);
        conditions.arrivals.extend(short);
    }
    conditions
}

/// The fit, its open rivals, and what comes close to any of them: what is ruled out now may come
/// back with new poses, and a rival that is true has rivals of its own.
fn competing(prepared: &PreparedSearch, fit: &Fit, open: &[&Rival]) -> Vec<Explanation> {
    let regression = &prepared.regression;
    let many = regression.added(fit).len() > MANY_NAMES;
    let most = if many { budget::LISTED } else { MOST_COMPETING };
    let own = || [fit].into_iter().chain(open.iter().map(|rival| &rival.fit));
    let near = own().take(1 + budget::LIKELIEST);
    let near = near.flat_map(|one| aliases::rivals(regression, one));
    let near = near
        .filter(Rival::other_names)
        .map(|near| (near.fit, false));
    let mut all: Vec<Explanation> = Vec::new();
    for (fit, open) in own().map(|fit| (fit.clone(), true)).chain(near) {
        if !all.iter().any(|a| same_terms(&a.fit, &fit)) {
            all.push(Explanation { fit, open });
        }
        // More are not even looked for.
        if all.len() == most {
            break;
        }
    }
    all
}

fn same_terms(one: &Fit, other: &Fit) -> bool {
    let (a, b) = (one.model.terms(), other.model.terms());
    let within = |a: &[Term], b: &[Term]| a.iter().all(|t| b.iter().any(|o| o.same_column(t)));
    a.len() == b.len() && within(a, b)
}

/// Poses one after the other until they decide often enough, or `most` are chosen.
fn attempt<'p>(candidates: CandidatePoses<'p>, all: &[Explanation], most: usize) -> Attempt<'p> {
    let (decision, comparisons) = Decision::new(&candidates, all);
    let mut parting = ModelSeparation::new(comparisons, candidates.candidates.len(), REPEATS);
    let enough: Vec<f64> = parting.distances().map(|c| c.enough.max(1.0)).collect();
    parting.decision = Some(decision);
    let mut order = choose(&mut parting, most);
    let needed = parting.decision.as_ref().map(|own| own.needed(SURE));
    let (poses, unparted, probability) = needed.unwrap_or_default();
    order.truncate(poses);
    let share = |(c, enough): (&ModelDistance, &f64)| (c.delta / enough).min(1.0);
    let shares = parting.distances().zip(&enough).map(share);
    Attempt {
        score: probability + shares.sum::<f64>() / enough.len().max(1) as f64,
        decides: unparted == 0 && probability >= SURE,
        unparted,
        order,
        candidates,
    }
}

/// What would distinguish a rival from the model, in words.
pub(crate) fn separate_by(rival: &Rival, poses: &[NextPose]) -> Text {
    let mut words = rival
        .removed
        .iter()
        .chain(&rival.instead)
        .map(|t| t.effect.about().confused_with);
    if poses.is_empty() {
        let hint = words.next().map_or_else(Text::default, Text::from);
        return text!("no pose within the limits tells them apart; {hint}", hint);
    }
    let mut conditions = Vec::new();
    if poses.iter().any(|p| p.target_mm.is_some()) {
        conditions.push(phrase!("a reflector at another radius"));
    }
    if poses.iter().any(|p| p.speed.is_some()) {
        conditions.push(phrase!("other speeds"));
    }
    if poses.iter().any(|p| p.load_kg.is_some()) {
        conditions.push(phrase!("other loads"));
    }
    if poses.iter().any(|p| p.temperature_c.is_some()) {
        conditions.push(phrase!("another temperature"));
    }
    let none = conditions.is_empty();
    let conditions = Text::listed(conditions, ", ");
    match poses.len() {
        1 if none => text!("measure the proposed pose"),
        1 => text!("measure the proposed pose ({conditions})", conditions),
        count if none => text!("measure the {count} proposed poses", count),
        count => text!(
            "measure the {count} proposed poses ({conditions})",
            count,
            conditions
        ),
    }
}

fn why(rivals: &[&Rival]) -> Text {
    let names = |terms: &[Term]| {
        let names = terms.iter().map(|t| called(t.effect.about().id));
        Text::listed(names, " + ")
    };
    let mut pairs: Vec<Text> = Vec::new();
    for rival in rivals {
        let pair = text!(
            "distinguishes {one} from {other}",
            one = names(&rival.removed),
            other = names(&rival.instead)
        );
        if !pairs.contains(&pair) && pairs.len() < budget::LIKELIEST {
            pairs.push(pair);
        }
    }
    Text::listed(pairs, "; ")
}
