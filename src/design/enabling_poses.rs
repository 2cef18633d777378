//! What would make an effect testable that a session cannot show: each effect is asked again with
//! one condition after the other met, until nothing stands against it. Then poses under these
//! conditions are chosen on which each such effect, at one and a half times the noise, cannot
//! hide behind the model or behind another effect that is enabled with it (T-optimality, as for
//! rivals).

use nalgebra::DVector;

use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::effects::{Effect, Setting, Term, find};
use crate::kinematics::JointKind;
use crate::model::Model;

use super::candidate_poses::{self, CandidatePose, Conditions};
use super::comparison::{Axes, Comparison, Parting, Prediction, enough_for, predictions};
use super::exchange::choose;
use super::needs::{Need, TEST_LOAD_KG, Untestable, WARMING_C, lacks};
use super::next_poses::{CandidatePoses, axes_of, gram, later_s, poses_of};
use crate::diagnosis::NextPose;
use crate::diagnosis::candidates::NotTestable;
use crate::diagnosis::prepare::Prepared;
use crate::diagnosis::regression::{Fit, Regression};
use crate::diagnosis::search::compatible;

/// Every effect that cannot be seen, with what would change that.
pub(crate) fn untestable(prepared: &Prepared, not_testable: &[NotTestable]) -> Vec<Untestable> {
    let one = |n: &NotTestable| {
        let joint = n.joint.unwrap_or(0);
        let needs = find(n.effect).map_or_else(Vec::new, |effect| {
            if effect.obstacle(&prepared.survey, joint).is_some() {
                lacks(effect, &prepared.survey, joint)
            } else {
                lacks_geometry(prepared, effect, joint)
            }
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

/// An effect that the base model imitates wherever it was measured: more travel, or a second
/// reflector.
fn lacks_geometry(prepared: &Prepared, effect: &'static dyn Effect, joint: usize) -> Vec<Need> {
    for (need, reflector) in [(Need::Travel, false), (Need::Reflector, true)] {
        let candidates = candidates_for(prepared, &[need], reflector);
        let inputs = candidates.inputs(prepared);
        let axes = axes_of(&prepared.regression);
        let truth = with_effect(&prepared.regression.base, effect, joint, &inputs, &axes);
        let seen = predictions(&truth, &prepared.regression.base, &inputs, &axes);
        let all: f64 = seen.iter().map(|p| p.difference.norm_squared()).sum();
        let p = prepared.regression.base.coefficient_count();
        let nothing = nalgebra::DMatrix::zeros(p, p);
        let mut comparison = Comparison::new(seen, &nothing, f64::INFINITY);
        for k in 0..candidates.poses.len() {
            comparison.take(k);
        }
        if comparison.delta > 1e-3 * all && all > 0.0 {
            return vec![need];
        }
    }
    Vec::new()
}

/// What is offered where these needs are to be met.
fn candidates_for(prepared: &Prepared, needs: &[Need], reflector: bool) -> CandidatePoses {
    let session = prepared.problem.session;
    let mut targets = session.targets.clone();
    let turns = session
        .robot
        .joints
        .iter()
        .any(|j| j.kind == JointKind::Revolute);
    if reflector && turns && targets.len() < 2 {
        targets.extend(
            candidate_poses::other_reflectors(&session.robot, &targets)
                .into_iter()
                .take(1),
        );
    }
    let mut conditions = Conditions::plain(&session.robot);
    for (unit, joint) in conditions
        .unit_of_speed
        .iter_mut()
        .zip(&prepared.survey.joints)
    {
        if joint.largest_speed > 0.0 {
            *unit = joint.largest_speed;
        }
    }
    if needs.contains(&Need::Speeds) {
        conditions.speeds = vec![0.0, 1.0, 2.0];
    }
    if needs.contains(&Need::Loads) {
        let heaviest = prepared.survey.largest_load_kg;
        conditions.loads_kg = vec![
            0.0,
            if heaviest > 0.0 {
                heaviest
            } else {
                TEST_LOAD_KG
            },
        ];
    }
    if needs.contains(&Need::Temperatures) {
        conditions.warmths_c = vec![0.0, WARMING_C];
    }
    conditions.targets = (0..u32::try_from(targets.len()).unwrap_or(1)).collect();
    conditions.time_s = later_s(prepared);
    CandidatePoses::new(prepared, targets, &conditions)
}

/// Size of an effect that is to be enabled, in units of the noise: small enough that each new
/// condition is measured several times, as a single odd sample would pass for an outlier.
const SMALL: f64 = 1.5;

/// A model with an effect more, at a size whose displacement has a root mean square of
/// [`SMALL`] times the noise over the inputs.
pub(crate) fn with_effect(
    model: &Model,
    effect: &'static dyn Effect,
    joint: usize,
    inputs: &crate::effects::Inputs,
    axes: &Axes,
) -> Model {
    let setting = match effect.about().setting {
        Setting::Order { from, .. } => f64::from(from),
        Setting::Fade => {
            let q = &inputs.q[joint];
            let low = q.iter().copied().fold(f64::INFINITY, f64::min);
            let high = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            0.03 * (high - low)
        }
        Setting::Listed(listed) => listed.stands_for_all(joint),
        _ => 0.0,
    };
    let mut term = Term::absent(effect, joint, setting);
    let absent = model.with_term(term.clone());
    let first = absent
        .terms()
        .iter()
        .take_while(|t| !t.same_column(&term))
        .map(|t| t.coefficients.len())
        .sum::<usize>();
    let size = term.coefficients.len();
    let mut energy = vec![0.0; size];
    for Prediction { columns, .. } in predictions(model, &absent, inputs, axes) {
        for (k, energy) in energy.iter_mut().enumerate() {
            *energy += columns.column(first + k).norm_squared();
        }
    }
    let rows = (inputs.len() as f64).max(1.0);
    for (coefficient, energy) in term.coefficients.iter_mut().zip(&energy) {
        let rms = (energy / rows).sqrt();
        if rms > 0.0 {
            *coefficient = SMALL / rms / (size as f64).sqrt();
        }
    }
    model.with_term(term)
}

/// Poses that a diagnosis proposes at most where nothing is ambiguous.
const MOST_BESIDE: usize = 12;

/// What a diagnosis proposes where nothing is ambiguous: poses for what the session recorded but
/// never changed, and for the side of approach, which costs nothing. No new equipment.
pub(crate) fn worth_enabling(
    prepared: &Prepared,
    fit: &Fit,
    not_testable: &[NotTestable],
) -> Vec<NextPose> {
    let samples = &prepared.problem.session.samples;
    let cheap = |need: &Need| match need {
        Need::BothSides | Need::Travel => true,
        Need::Speeds => samples.speed.iter().any(Option::is_some),
        Need::Loads => samples.load_kg.is_some(),
        Need::Temperatures => samples.temperature_c.is_some(),
        _ => false,
    };
    let mut untestable = untestable(prepared, not_testable);
    untestable.retain(|l| l.needs.iter().all(cheap));
    enable(prepared, fit, &untestable, false, MOST_BESIDE)
}

/// What remains of the session's information where it does not say under which condition it was
/// measured.
const WEAK: f64 = 0.02;

/// At most `most` poses that make testable what poses can make testable. Where `reflector` is false nothing has
/// to be mounted.
pub(crate) fn enable(
    prepared: &Prepared,
    fit: &Fit,
    untestable: &[Untestable],
    reflector: bool,
    most: usize,
) -> Vec<NextPose> {
    let wanted: Vec<&Untestable> = untestable
        .iter()
        .filter(|l| !l.needs.is_empty() && l.needs.iter().all(|n| n.by_poses()))
        .filter(|l| reflector || !l.needs.contains(&Need::Reflector))
        .collect();
    if wanted.is_empty() || most == 0 {
        return Vec::new();
    }
    let mut needs: Vec<Need> = wanted.iter().flat_map(|l| l.needs.clone()).collect();
    needs.sort_unstable();
    needs.dedup();
    let mounted = needs.contains(&Need::Reflector);
    let candidates = candidates_for(prepared, &needs, mounted);
    let inputs = candidates.inputs(prepared);
    let axes = axes_of(&prepared.regression);
    let samples = &prepared.problem.session.samples;
    let terms: Vec<Term> = wanted
        .iter()
        .filter_map(|one| {
            let joint = one.joint.unwrap_or(0);
            let model = with_effect(&fit.model, find(one.effect)?, joint, &inputs, &axes);
            let mut terms = model.terms().iter();
            let own = |t: &&Term| t.effect.about().id == one.effect && t.joint == joint;
            terms.find(own).cloned()
        })
        .collect();
    let mut comparisons: Vec<Comparison> = Vec::new();
    for (one, term) in wanted.iter().zip(&terms) {
        // What is enabled together has to be told apart as well.
        let others = terms.iter().filter(|t| compatible(&[term], t));
        let rival = others.fold(fit.model.clone(), |model, t| {
            model.with_term(Term::absent(t.effect, t.joint, t.setting))
        });
        let unsaid = |need: &Need| match need {
            Need::BothSides => samples.dir.iter().all(Option::is_none),
            Need::Speeds => samples.speed.iter().all(Option::is_none),
            Need::Loads => samples.load_kg.is_none(),
            Need::Temperatures => samples.temperature_c.is_none(),
            _ => false,
        };
        let weight = if one.needs.iter().any(unsaid) {
            WEAK
        } else {
            1.0
        };
        let truth = fit.model.with_term(term.clone());
        let seen = predictions(&truth, &rival, &inputs, &axes);
        let known = gram(&prepared.regression, &rival) * weight;
        let comparison = Comparison::new(seen, &known, enough_for(6.0, 0.0));
        // The effect was there already; the samples so far could not show it.
        let (pull, square) = history(&prepared.regression, &truth, &rival);
        comparisons.push(comparison.starting(&(pull * weight), square * weight));
    }
    let fresh = comparisons.clone();
    let mut parting = Parting::new(comparisons, candidates.poses.len(), 1);
    let mut order = choose(&mut parting, most);
    // Warming up and changing the load take time: once each.
    order.sort_by(|a, b| {
        let (a, b) = (&candidates.poses[*a], &candidates.poses[*b]);
        let warmth = a.warmth_c.total_cmp(&b.warmth_c);
        warmth.then(a.load_kg.total_cmp(&b.load_kg))
    });
    let session = prepared.problem.session;
    let why = |k: usize| {
        let gains: Vec<f64> = fresh.iter().map(|c| c.gain(k)).collect();
        let largest = gains.iter().copied().fold(0.0, f64::max);
        let shown: Vec<&Untestable> = wanted
            .iter()
            .zip(&gains)
            .filter(|(_, gain)| **gain > 0.3 * largest)
            .map(|(one, _)| *one)
            .collect();
        words(&shown, &candidates.poses[k])
    };
    let mut all: Vec<NextPose> = order
        .into_iter()
        .flat_map(|k| {
            let why = why(k);
            let mut poses = poses_of(&candidates.poses[k], session, &candidates, &why);
            for pose in &mut poses {
                pose.why.clone_from(&why);
            }
            poses
        })
        .take(most)
        .collect();
    // Beside warm poses cold ones are asked for as such.
    if all.iter().any(|p| p.temperature_c.is_some()) {
        for pose in &mut all {
            pose.temperature_c = pose.temperature_c.or(Some(REFERENCE_TEMPERATURE_C));
        }
    }
    all
}

/// What the samples so far show of a model where another is fitted: columnsᵀ · difference and
/// ‖difference‖².
fn history(regression: &Regression, truth: &Model, other: &Model) -> (DVector<f64>, f64) {
    let (without, columns) = regression.rows.extract(other);
    let (with, _) = regression.rows.extract(truth);
    let difference = regression
        .noise
        .whitened_vector(&regression.rows, &(without - with));
    let white = regression.noise.whitened(&regression.rows, &columns);
    (white.tr_mul(&difference), difference.norm_squared())
}

/// At most so many effects are named in the reason for a pose.
const MOST_NAMED: usize = 3;

fn words(shown: &[&Untestable], choice: &CandidatePose) -> String {
    let matters = |need: &Need| match need {
        Need::Speeds => choice.speed.iter().any(|s| *s != 0.0),
        Need::Loads => choice.load_kg != 0.0,
        Need::Temperatures => choice.warmth_c != 0.0,
        Need::Reflector => choice.target > 0,
        _ => true,
    };
    let mut needs: Vec<Need> = shown.iter().flat_map(|l| l.needs.clone()).collect();
    needs.retain(matters);
    needs.sort_unstable();
    needs.dedup();
    let needs: Vec<&str> = needs.iter().map(|n| n.says()).collect();
    let mut names: Vec<&str> = shown.iter().map(|l| l.effect).collect();
    names.dedup();
    let more = names.len().saturating_sub(MOST_NAMED);
    names.truncate(MOST_NAMED);
    let others = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    let how = if needs.is_empty() {
        "what the others are compared with".to_owned()
    } else {
        needs.join("; ")
    };
    format!("makes {}{others} testable: {how}", names.join(", "))
}
