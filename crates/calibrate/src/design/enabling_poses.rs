//! Poses that make an effect testable that a session cannot show: its obstacles are asked for with one condition after
//! the other met, until there are none. Then poses under these conditions are chosen on which each such effect, at one
//! and a half times the noise, is not imitated by the model or by another effect that is enabled with it
//! (T-optimality, as for rivals).

use std::cell::LazyCell;

use crate::diagnosis::NextPose;
use crate::diagnosis::candidates::compatible;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::effects::{Effect, Term, called, find};
use crate::model::Model;
use crate::numeric::extent;
use crate::sessions::Samples;
use crate::text::Text;
use crate::{budget, odds};

use super::candidate::Candidate;
use super::candidate_poses::{CandidatePoses, Conditions};
use super::comparison::{Comparison, enough_for};
use super::covariance;
use super::every_effect::at_representative_settings;
use super::exchange::choose;
use super::model_separation::ModelSeparation;
use super::needs::{Need, Untestable, WARMING_C, lacks, test_load_kg};
use super::reflectors::other_reflectors;

/// An effect whose projection orthogonal to the base model has this share (squared) over all candidates is determined
/// by them.
const NOT_IMITATED: f64 = 1e-3;

/// Every effect that cannot be seen, with what would change that: a condition, or for an effect that the base model
/// imitates wherever it was measured, more travel or a second reflector.
pub(crate) fn untestable(
    prepared: &PreparedSearch,
    not_testable: &[NotTestable],
) -> Vec<Untestable> {
    // A second reflector is another offer only where reflectors alone are measured. An offer is made once for all
    // effects: where targets are held in places, each of its poses is brought there by a search.
    let points = prepared.problem.observed.is_none();
    let geometry = [Need::Travel, Need::Reflector];
    let geometry = geometry.into_iter().take(1 + usize::from(points));
    let offers = geometry.map(|need| {
        let offer = move || offer_for(prepared, &[need], None);
        (need, LazyCell::new(offer))
    });
    let offers: Vec<_> = offers.collect();
    let base = &prepared.regression.base;
    let one = |n: &NotTestable| {
        let joint = n.joint.unwrap_or(0);
        let needs = find(n.effect).map_or_else(Vec::new, |effect| {
            if effect.obstacle(&prepared.survey, joint).is_some() {
                return lacks(effect, &prepared.survey, joint);
            }
            let mut offers = offers.iter();
            let shows = offers.find(|own| not_imitated(&own.1, base, effect, joint));
            shows.map(|own| own.0).into_iter().collect()
        });
        Untestable {
            effect: n.effect,
            joint: n.joint,
            because: n.because.clone(),
            needs,
        }
    };
    not_testable.iter().map(one).collect()
}

/// Whether the residual of an effect is significant where a model is fitted to it over all candidates.
fn not_imitated(
    offer: &CandidatePoses,
    base: &Model,
    effect: &'static Effect,
    joint: usize,
) -> bool {
    let rows = offer.rows(&base.with_term(small(offer, base, effect, joint)), base);
    let pull = &rows.columns * &rows.difference;
    let all = rows.difference.norm_squared();
    let imitated = pull.dot(&(covariance::given_samples(&rows.information(), &rows) * &pull));
    all > 0.0 && all - imitated > NOT_IMITATED * all
}

/// The candidates that meet these needs.
fn offer_for<'p>(
    prepared: &'p PreparedSearch,
    needs: &[Need],
    load_kg: Option<f64>,
) -> CandidatePoses<'p> {
    let session = prepared.problem.session;
    let mut targets = session.targets.clone();
    if needs.contains(&Need::Reflector) && prepared.problem.observed.is_none() {
        targets.extend(
            other_reflectors(&session.robot, &targets)
                .into_iter()
                .next(),
        );
    }
    let mut conditions = Conditions::after(prepared);
    if needs.contains(&Need::Speeds) {
        conditions.speeds = vec![0.0, 1.0, 2.0];
    }
    if needs.contains(&Need::Loads) {
        let load = test_load_kg(load_kg, prepared.survey.largest_load_kg);
        conditions.loads_kg.push(load);
    }
    if needs.contains(&Need::Temperatures) {
        conditions.above_20_c.push(WARMING_C);
    }
    CandidatePoses::new(prepared, targets, &conditions)
}

/// Size of an effect that is to be enabled, in units of the noise: small enough that each new
/// condition is measured several times, as a single odd sample would pass for an outlier.
const SMALL: f64 = 1.5;

/// An effect at a size whose displacement has a root mean square of [`SMALL`] times the noise over the
/// candidates.
fn small(offer: &CandidatePoses, model: &Model, effect: &'static Effect, joint: usize) -> Term {
    let [low, high] = extent(&*offer.inputs.q[joint]);
    let mut term =
        at_representative_settings(effect, joint, 1, &[0.03 * (high - low)], 0.0).swap_remove(0);
    let absent = model.with_term(term.clone());
    let first = absent
        .columns()
        .take_while(|(t, _)| !t.same_column(&term))
        .count();
    let size = term.coefficients.len();
    let energy = &offer.rows(model, &absent).squares()[first..first + size];
    let rows = (offer.inputs.len() as f64).max(1.0);
    for (coefficient, energy) in term.coefficients.iter_mut().zip(energy) {
        let rms = (energy / rows).sqrt();
        if rms > 0.0 {
            *coefficient = SMALL / rms / (size as f64).sqrt();
        }
    }
    term
}

/// Poses that a diagnosis proposes at most where nothing is ambiguous.
const MOST_IN_ADDITION: usize = 12;

/// What a diagnosis proposes where nothing is ambiguous: poses for what the session recorded but
/// never changed, and for the side of approach, which costs nothing. No new equipment.
pub(crate) fn worth_enabling(
    prepared: &PreparedSearch,
    fit: &Fit,
    not_testable: &[NotTestable],
) -> Vec<NextPose> {
    let samples = &prepared.problem.session.samples;
    let cheap = |need: &Need| match need {
        Need::BothSides | Need::Travel => true,
        Need::Speeds | Need::Loads | Need::Temperatures => is_stated(*need, samples),
        _ => false,
    };
    let mut untestable = untestable(prepared, not_testable);
    untestable.retain(|l| l.needs.iter().all(cheap));
    enable(prepared, fit, &untestable, None, MOST_IN_ADDITION)
}

/// The remaining share of the session's information where it does not state the condition under which it was measured.
const WEAK: f64 = 0.02;

/// At most `most` poses that make testable what poses can make testable.
pub(crate) fn enable(
    prepared: &PreparedSearch,
    fit: &Fit,
    untestable: &[Untestable],
    load_kg: Option<f64>,
    most: usize,
) -> Vec<NextPose> {
    let wanted: Vec<&Untestable> = untestable
        .iter()
        .filter(|l| !l.needs.is_empty() && l.needs.iter().all(|n| n.by_poses()))
        .collect();
    if wanted.is_empty() || most == 0 {
        return Vec::new();
    }
    let offer = offer_for(prepared, &needs_of(&wanted, |_| true), load_kg);
    let comparisons = comparisons(&offer, &fit.model, &wanted);
    let fresh = comparisons.clone();
    let mut parting = ModelSeparation::new(comparisons, offer.candidates.len(), 1);
    let mut order = choose(&mut parting, most);
    // Warming up and changing the load take time: once each.
    order.sort_by(|a, b| {
        let (a, b) = (&offer.candidates[*a], &offer.candidates[*b]);
        let warmth = a.above_20_c.total_cmp(&b.above_20_c);
        warmth.then(a.load_kg.total_cmp(&b.load_kg))
    });
    let why = |k: usize| {
        let gain = |c: &Comparison| c.worth(k, |_, gain| gain);
        let gains: Vec<f64> = fresh.iter().map(gain).collect();
        let largest = gains.iter().copied().fold(0.0, f64::max);
        let shown = wanted.iter().zip(&gains);
        let shown = shown.filter(|(_, gain)| **gain > 0.3 * largest);
        words(
            &shown.map(|(one, _)| *one).collect::<Vec<_>>(),
            &offer.candidates[k],
        )
    };
    let poses = order.into_iter().flat_map(|k| offer.poses(k, &why(k)));
    let mut all: Vec<NextPose> = poses.take(most).collect();
    // Where there are warm poses, cold ones are asked for as such.
    if all.iter().any(|p| p.temperature_c.is_some()) {
        for pose in &mut all {
            pose.temperature_c = pose.temperature_c.or(Some(REFERENCE_TEMPERATURE_C));
        }
    }
    all
}

/// What these effects need, as far as it matters.
fn needs_of(wanted: &[&Untestable], matters: impl Fn(&Need) -> bool) -> Vec<Need> {
    let mut needs: Vec<Need> = wanted.iter().flat_map(|l| l.needs.clone()).collect();
    needs.retain(matters);
    needs.sort_unstable();
    needs.dedup();
    needs
}

/// Each effect against the model and the effects that are enabled with it, which have to be distinguished as well.
fn comparisons(offer: &CandidatePoses, model: &Model, wanted: &[&Untestable]) -> Vec<Comparison> {
    let term = |one: &&Untestable| {
        let effect = find(one.effect)?;
        Some(small(offer, model, effect, one.joint.unwrap_or(0)))
    };
    let terms: Vec<Term> = wanted.iter().filter_map(term).collect();
    let against_others = |(one, term): (&&Untestable, &Term)| {
        let others = terms.iter().filter(|t| compatible(&[term], t));
        let rival = others.fold(model.clone(), |model, t| {
            model.with_term(Term::absent(t.effect, t.joint, t.setting))
        });
        let samples = &offer.problem.session.samples;
        let unstated = one.needs.iter().any(|need| !is_stated(*need, samples));
        let weight = if unstated { WEAK } else { 1.0 };
        // The effect was there already; the samples so far could not show it.
        let truth = model.with_term(term.clone());
        Comparison::from_the_start(
            offer,
            [&truth, &rival],
            enough_for(odds::TAKEN.nats(), 0.0),
            weight,
        )
    };
    wanted.iter().zip(&terms).map(against_others).collect()
}

/// Whether a session states the condition under which it was measured.
fn is_stated(need: Need, samples: &Samples) -> bool {
    match need {
        Need::BothSides => samples.dir.iter().any(Option::is_some),
        Need::Speeds => samples.speed.iter().any(Option::is_some),
        Need::Loads => samples.load_kg.is_some(),
        Need::Temperatures => samples.temperature_c.is_some(),
        _ => true,
    }
}

fn words(shown: &[&Untestable], choice: &Candidate) -> Text {
    let matters = |need: &Need| match need {
        Need::Speeds => choice.moves(),
        Need::Loads => choice.load_kg != 0.0,
        Need::Temperatures => choice.above_20_c != 0.0,
        Need::Reflector => choice.target > 0,
        _ => true,
    };
    let needs = needs_of(shown, matters);
    let mut names: Vec<&str> = shown.iter().map(|l| l.effect).collect();
    names.dedup();
    let more = names.len().saturating_sub(budget::LIKELIEST);
    names.truncate(budget::LIKELIEST);
    let how = if needs.is_empty() {
        text!("what the others are compared with")
    } else {
        Text::listed(needs.iter().map(|need| need.describe()), "; ")
    };
    let effects = Text::listed(names.into_iter().map(called), ", ");
    if more > 0 {
        text!(
            "makes {effects} and {more} more testable: {how}",
            effects,
            more,
            how
        )
    } else {
        text!("makes {effects} testable: {how}", effects, how)
    }
}
