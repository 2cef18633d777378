//! A free curve over a joint as the rival of names that follow nothing but its value: a kink, levels by sector or a
//! chirp can be made up of enough harmonics, a pull of cables at both ends of the range is scale, eccentricity and
//! two-cycle together, and none of them is any of these.
//!
//! The curve is a Gaussian process along the joint's motion, along its radius and along its axis; names are groups of
//! columns as it is one, and the restricted likelihood of both is compared ([`crate::diagnosis::rest`]). Where it is
//! likelier without names, the names that only make it up are withdrawn.

use std::collections::BTreeMap;

use crate::effects::survey::ENOUGH;
use crate::effects::{Over, Setting, Term};
use crate::model::Model;

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use crate::diagnosis::candidates::Placed;
use crate::diagnosis::evidence::EFFECT_PRIOR_PENALTY;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::evidence::rival::UNDECIDED;
use crate::diagnosis::rest::rival::{Contest, FreeCurve};
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// What the curve pays: as a name for being there, and a factor of e for each of its numbers (length,
/// size, roughness). Names are as many as they are; no further preference is needed.
const PRICE: f64 = EFFECT_PRIOR_PENALTY + 3.0;
/// So many names are as much as a curve, where neither can be ruled out.
const FEWEST_NAMES: usize = 3;
/// Waves over the range from which on a name is not smooth.
const FEW_WAVES: f64 = 3.0;
/// Pieces of the curve that takes the names' place in the fit, at most.
const MOST_PIECES: usize = 60;
/// … and at least.
const FEWEST_PIECES: usize = 2;

/// Some of the names over a joint, with the likeliest curve over it where that is worth its price.
struct BesideCurve {
    /// Logarithm of how likely the samples are, beside the same base as other sets of these names.
    ln_evidence: f64,
    curve: Option<FreeCurve>,
}

impl BesideCurve {
    fn of(prepared: &PreparedSearch, contest: &Contest, names: &[Term], kept: &[Term]) -> Self {
        let is_kept = |k: usize| kept.iter().any(|t| t.same_column(&names[k]));
        let Some(standing) = contest.standing(is_kept) else {
            return Self {
                ln_evidence: f64::NEG_INFINITY,
                curve: None,
            };
        };
        let curve = standing.curve.filter(|curve| curve.ln_odds > PRICE);
        let price = |t: &Term| EFFECT_PRIOR_PENALTY + prepared.regression.price_of_term(t);
        let prices: f64 = kept.iter().map(price).sum();
        Self {
            ln_evidence: standing.ln_evidence - prices + worth(curve.as_ref()),
            curve,
        }
    }

    /// The fit of a model and shapes with the curve as a shape more.
    fn into_fit(self, prepared: &PreparedSearch, model: &Model, kept: &[Placed], at: usize) -> Fit {
        let rest = prepared.regression.fit(model, kept);
        let Some(curve) = self.curve else {
            return rest;
        };
        let across = &prepared.regression.table.space.across;
        let own = [
            [Direction::Radial, Direction::Across(0)],
            [Direction::Axial, Direction::Across(1)],
        ];
        let own = curve.direction.checked_sub(1).map(|k| own[k]);
        let mut measured = across.iter().map(|across| across.0);
        let direction = measured.find(|is| own.is_some_and(|own| own.contains(is)));
        let direction = direction.unwrap_or(Direction::Tangential(at));
        // Between neighbouring values more pieces say nothing.
        let most = match prepared.survey.joints[at].values {
            few if few < ENOUGH => few.saturating_sub(1),
            _ => MOST_PIECES,
        };
        let shape = over(at, direction, curve.pieces.min(most).max(FEWEST_PIECES));
        let ln_evidence = rest.ln_evidence + worth(Some(&curve));
        with_curve(&prepared.regression, &rest, shape, ln_evidence)
    }
}

fn worth(curve: Option<&FreeCurve>) -> f64 {
    curve.map_or(0.0, |curve| curve.ln_odds - PRICE)
}

fn contest(
    prepared: &PreparedSearch,
    model: &Model,
    joint: usize,
    names: &[Term],
) -> Option<Contest> {
    let regression = &prepared.regression;
    Contest::new(&regression.problem, &regression.noise, model, joint, names)
}

/// A polygon over a joint.
fn over(joint: usize, direction: Direction, pieces: usize) -> Shape {
    Shape {
        variable: Variable::Joint(joint),
        direction,
        profile: Profile::Curve { pieces },
        tried: 1.0,
    }
}

/// Names that follow only this joint's value, and the shapes of the fit that do not.
fn over_joint(prepared: &PreparedSearch, fit: &Fit, joint: usize) -> (Vec<Term>, Vec<Placed>) {
    let added = prepared.regression.added(fit).into_iter();
    let others = |s: &&Placed| s.shape.variable != Variable::Joint(joint);
    (
        added.filter(|t| follows_only(t, joint)).cloned().collect(),
        fit.shapes.iter().filter(others).cloned().collect(),
    )
}

fn without(model: &Model, names: &[Term]) -> Model {
    model.without(|t| names.iter().any(|n| n.same_column(t)))
}

/// The names among these that change slowly over the range of the joint.
fn slow(prepared: &PreparedSearch, names: &[Term], joint: usize) -> Vec<Term> {
    let (low, high) = prepared
        .regression
        .table
        .space
        .range(Variable::Joint(joint));
    let is_slow = |term: &&Term| match term.effect.about().setting {
        Setting::Order { .. } => term.setting * (high - low) < FEW_WAVES * std::f64::consts::TAU,
        Setting::None => true,
        _ => false,
    };
    names.iter().filter(is_slow).cloned().collect()
}

/// Holds a free curve over each joint against all names over it, and over the only joint against the slow ones and each
/// besides, the curve beside the others. Where the samples are likelier without them they are taken out: what repeats is
/// in the model with or without a name, and a name has to beat it.
pub(crate) fn rival(prepared: &PreparedSearch, found: &mut SearchResult) {
    // What wanders is held against the names elsewhere.
    let single = prepared.survey.joints.len() == 1 && prepared.regression.noise.slow.is_none();
    for joint in 0..prepared.survey.joints.len() {
        let (names, shapes) = over_joint(prepared, &found.fit, joint);
        if names.is_empty() {
            continue;
        }
        let Some(contest) = contest(prepared, &found.fit.model, joint, &names) else {
            continue;
        };
        let beside = |kept: &[Term]| BesideCurve::of(prepared, &contest, &names, kept);
        let mut kept = names.clone();
        let mut most = beside(&kept);
        while !kept.is_empty() {
            let mut sets = vec![kept.clone()];
            if single {
                sets.push(slow(prepared, &kept, joint));
                sets.extend(kept.iter().map(|name| vec![name.clone()]));
            }
            let rests = sets.into_iter().map(|set| {
                let is_in = |name: &Term| set.iter().any(|t| t.same_column(name));
                kept.iter().filter(|name| !is_in(name)).cloned().collect()
            });
            let rests = rests.map(|rest: Vec<Term>| (beside(&rest), rest));
            let best = rests.max_by(|a, b| a.0.ln_evidence.total_cmp(&b.0.ln_evidence));
            let Some(likelier) = best.filter(|best| best.0.ln_evidence > most.ln_evidence) else {
                break;
            };
            (most, kept) = likelier;
        }
        if kept.len() < names.len() {
            let gone: Vec<Term> = names
                .into_iter()
                .filter(|name| !kept.iter().any(|t| t.same_column(name)))
                .collect();
            let model = without(&found.fit.model, &gone);
            found.fit = most.into_fit(prepared, &model, &shapes, joint);
        }
    }
}

/// Names over a joint, with the joint, that the samples cannot tell from a curve.
pub(crate) fn as_likely(prepared: &PreparedSearch, fit: &Fit) -> Option<(usize, Vec<Term>)> {
    let of_joint = |joint: usize| {
        let (names, kept) = over_joint(prepared, fit, joint);
        let names = slow(prepared, &names, joint);
        let is_open = names.len() >= FEWEST_NAMES && kept.len() == fit.shapes.len();
        let odds = is_open.then(|| ln_odds(prepared, fit, joint, &names));
        odds.flatten().map(|odds| (odds, (joint, names)))
    };
    let all = (0..prepared.survey.joints.len()).filter_map(of_joint);
    let likely = all.filter(|own| own.0 > -UNDECIDED);
    let best = likely.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|own| own.1)
}

/// How much likelier the samples are with a curve over a joint in the place of names, as a logarithm.
fn ln_odds(prepared: &PreparedSearch, fit: &Fit, joint: usize, names: &[Term]) -> Option<f64> {
    let contest = contest(prepared, &fit.model, joint, names)?;
    let with = |kept: &[Term]| BesideCurve::of(prepared, &contest, names, kept);
    let (curve, names) = (with(&[]), with(names));
    Some(curve.ln_evidence - names.ln_evidence + worth(names.curve.as_ref()))
}

/// The free curve that takes the place of a slow part of the noise, beside the names that do not
/// follow the same joint: what comes back at the same value of the joint is no frame that wanders,
/// however quickly both change. `None` where no curve is as likely as what was found.
pub(crate) fn instead_of_slow(
    white: &PreparedSearch,
    found: &SearchResult,
    may_be_over: impl Fn(usize) -> bool,
) -> Option<SearchResult> {
    let regression = &white.regression;
    let mut best: Option<Fit> = None;
    for joint in (0..white.survey.joints.len()).filter(|joint| may_be_over(*joint)) {
        let (names, _) = over_joint(white, &found.fit, joint);
        let model = without(&found.fit.model, &names);
        let Some(contest) = contest(white, &model, joint, &[]) else {
            continue;
        };
        let beside = BesideCurve::of(white, &contest, &[], &[]);
        if beside.curve.is_none() {
            continue;
        }
        let fit = beside.into_fit(white, &model, &[], joint);
        let before = best.as_ref().unwrap_or(&found.fit).ln_evidence;
        if fit.ln_evidence > before {
            best = Some(fit);
        }
    }
    let names = || regression.fit(&found.named_effects_only.model, &[]);
    best.map(|fit| SearchResult::of(fit, names()))
}

/// Whether the values of a joint come back at other times: most samples are near others that were taken a fifth of
/// the session or more before or after. A single sweep does not part what follows the joint from what follows time.
pub(crate) fn comes_back(prepared: &PreparedSearch, joint: usize) -> bool {
    const BINS: f64 = 50.0;
    const LATER: f64 = 0.2;
    let inputs = &prepared.regression.rows.inputs;
    let Some(times) = inputs.time_s.as_deref() else {
        return false;
    };
    let q = &inputs.q[joint];
    let extent = |values: &[f64]| {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        values
            .iter()
            .fold(start, |(a, b), v| (a.min(*v), b.max(*v)))
    };
    let (low, high) = extent(q);
    let (first, last) = extent(times);
    let width = (high - low) / BINS;
    let mut bins: BTreeMap<u64, (f64, f64, usize)> = BTreeMap::new();
    for (q, time) in q.iter().zip(times) {
        let bin = ((q - low) / width) as u64;
        let own = bins.entry(bin).or_insert((*time, *time, 0));
        *own = (own.0.min(*time), own.1.max(*time), own.2 + 1);
    }
    let far = bins
        .values()
        .filter(|(from, to, _)| to - from >= LATER * (last - first));
    let back: usize = far.map(|(.., count)| count).sum();
    2 * back > q.len()
}

/// Whether an effect is a function of this joint's value alone.
fn follows_only(term: &Term, joint: usize) -> bool {
    let about = term.effect.about();
    about.over == Over::Angle && (term.joint == joint || !about.per_joint)
}

fn with_curve(regression: &Regression, rest: &Fit, curve: Shape, ln_evidence: f64) -> Fit {
    let mut shapes = rest.shapes.clone();
    shapes.push(regression.placed(curve));
    let mut fit = regression.fit(&rest.model, &shapes);
    let credit = ln_evidence - fit.ln_evidence;
    if let Some(curve) = fit.shapes.last_mut() {
        curve.credit = credit;
    }
    fit.ln_evidence = ln_evidence;
    fit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::fit::gap::deviations;
    use crate::sessions::Session;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// Two axes over a grid, the second at the same sixteen values each time; what a curve over it can do and
    /// what the geometry can do is nearly the same.
    #[test]
    fn a_curve_and_the_geometry_do_not_run_off_against_each_other() {
        let stops = (0..208).map(|k| {
            let (tilt, turn) = (5.0 * f64::from(k / 16) - 30.0, 22.5 * f64::from(k % 16));
            format!(r#"{{"q_deg":[{tilt},{turn}]}}"#)
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"positioner","robot":{{"name":"r","joints":[
            {{"name":"tilt","kind":"revolute","axis":[0,-1,0],"point_mm":[0,0,300]}},
            {{"name":"turn","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,300]}}],
            "tool":{{"position_mm":[0,0,0],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[-600,-180,510]}},
            "instrument":{{"name":"camera","sigma_mm":0.1}},"poses":{{"list":[{}]}},
            "effects":[{{"effect":"gear-transmission-error","joint":2,
            "parameters":{{"order":7,"amplitude_deg":0.03,"phase_deg":20}}}}],
            "noise":{{"sigma_mm":0.1,"kind":"gauss"}},"seed":1}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let (session, _) = simulate(&scenario, 1, unwatched).unwrap();
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, &[]);
        let beside = with_curve(
            regression,
            &base,
            over(1, Direction::Tangential(1), 48),
            0.0,
        );
        let at = |fit: &Fit| deviations(&prepared.problem, &fit.model).axes_mm;
        let (alone, with) = (at(&base), at(&beside));
        let moved = (0..3).flat_map(|axis| alone[axis].iter().zip(&with[axis]));
        let most = moved.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(most < 0.1, "the geometry alone moves by {most} mm");
        // And the curve does its part.
        assert!(
            beside.rss < 0.7 * base.rss,
            "{} of {}",
            beside.rss,
            base.rss
        );
    }

    const NAMES: [&str; 3] = ["joint-scale", "encoder-eccentricity", "encoder-two-cycle"];

    /// One axis whose angle is off by this many degrees at each of its values, in degrees, beside effects.
    fn axis(effects: &str, off: impl Fn(f64) -> f64) -> Session {
        let stops = (0..140).map(|k| {
            let turn = 340.0 * (f64::from(k) * 0.754_877_666).fract() - 170.0;
            format!(r#"{{"q_deg":[{turn}]}}"#)
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"pull","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180]}}],
            "tool":{{"position_mm":[320,0,210],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"list":[{}]}},
            "effects":[{effects}],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":5}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let mut session = simulate(&scenario, 1, unwatched).unwrap().0;
        let samples = &mut session.samples;
        for k in 0..samples.len() {
            let by = off(samples.q[0][k].to_degrees()).to_radians();
            let (x, y) = (samples.x_mm[k], samples.y_mm[k]);
            samples.x_mm[k] = x * by.cos() - y * by.sin();
            samples.y_mm[k] = x * by.sin() + y * by.cos();
        }
        session
    }

    /// The odds of a smooth curve over the three names of such a session.
    fn odds(session: &Session) -> f64 {
        let prepared = PreparedSearch::new(session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let mut fit = regression.fit(&regression.base, &[]);
        for name in NAMES {
            let mut candidates = regression.table.candidates.iter();
            let is = |t: &Term| t.effect.about().id == name;
            let there = candidates.find(|c| c.what.term().is_some_and(is));
            fit = regression.with(&fit, &there.unwrap().what);
        }
        let (names, _) = over_joint(&prepared, &fit, 0);
        assert_eq!(names.len(), 3);
        ln_odds(&prepared, &fit, 0, &names).unwrap()
    }

    #[test]
    fn a_curve_pushes_where_the_samples_do() {
        let mut session = axis("", |_| 0.0);
        let samples = &mut session.samples;
        for k in 0..samples.len() {
            let up = 0.3 * samples.q[0][k].sin().tanh();
            samples.z_mm.as_mut().unwrap()[k] += up;
        }
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let base = &prepared.regression.base;
        let contest = contest(&prepared, base, 0, &[]).unwrap();
        let beside = BesideCurve::of(&prepared, &contest, &[], &[]);
        let fit = beside.into_fit(&prepared, base, &[], 0);
        assert_eq!(fit.shapes[0].shape.direction, Direction::Axial);
    }

    #[test]
    fn a_pull_of_cables_is_more_of_a_curve_than_three_names() {
        let pull = |q: f64| 0.06 * ((q - 170.0) / 30.0).exp() - 0.05 * ((-170.0 - q) / 45.0).exp();
        let session = axis("", pull);
        assert!(odds(&session) > -UNDECIDED, "{}", odds(&session));
    }

    #[test]
    fn three_names_that_are_there_stay() {
        let of = |id: &str, parameters: &str| {
            format!(r#"{{"effect":"{id}","joint":1,"parameters":{{{parameters}}}}}"#)
        };
        let effects = [
            of(NAMES[0], r#""scale_ppm":250"#),
            of(NAMES[1], r#""amplitude_deg":0.03,"phase_deg":40"#),
            of(NAMES[2], r#""amplitude_deg":0.02,"phase_deg":110"#),
        ];
        let session = axis(&effects.join(","), |_| 0.0);
        assert!(odds(&session) < -UNDECIDED, "{}", odds(&session));
    }
}
