//! A free curve over a joint as the rival of every sum of names that follow nothing but its value:
//! a kink, levels by sector or a chirp can be made up of enough harmonics, and are none.
//!
//! The curve is a Gaussian process along the joint's motion, along its radius and along its axis
//! ([`super::smooth`]); its likelihood, with the curve integrated out, stands beside that of the
//! names. Where it is likelier, the names that only make it up are withdrawn.

use std::collections::BTreeMap;

use crate::effects::{Over, Term};
use crate::model::Model;

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use super::smooth;
use crate::diagnosis::evidence::EFFECT_PRIOR_PENALTY;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// What the curve pays: as a name for being there, and a factor of e for each of its numbers (length,
/// size, roughness). Names are as many as they are; no further preference is needed.
const PRICE: f64 = EFFECT_PRIOR_PENALTY + 3.0;
/// The names that a curve may stand for are at least so many columns: fewer are simpler than a curve.
const FEWEST_COLUMNS: usize = 3;
/// Pieces of the curve that takes the names' place in the fit, at most.
const MOST_PIECES: usize = 60;

/// Holds a free curve over each joint against the names; where it is likelier it takes their place.
pub(crate) fn rival(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    for joint in 0..prepared.survey.joints.len() {
        let fit = &found.fit;
        let made_up: Vec<Term> = regression
            .added(fit)
            .into_iter()
            .filter(|t| follows_only(t, joint))
            .cloned()
            .collect();
        let columns: usize = made_up
            .iter()
            .map(|t| t.coefficients.len() + settings(t))
            .sum();
        let over_joint =
            |s: &crate::diagnosis::candidates::Placed| s.shape.variable == Variable::Joint(joint);
        let shapes = fit.shapes.iter().filter(|s| over_joint(s)).count();
        if columns < FEWEST_COLUMNS && shapes == 0 || made_up.is_empty() {
            continue;
        }
        let model = fit
            .model
            .without(|t| made_up.iter().any(|m| m.same_column(t)));
        let kept = fit.shapes.iter().filter(|s| !over_joint(s)).cloned();
        let rest = regression.fit(&model, &kept.collect::<Vec<_>>());
        let Some(curve) = smooth::free_curve(prepared, &rest.model, joint) else {
            continue;
        };
        let likelihood = rest.ln_evidence + curve.ln_odds - PRICE;
        if likelihood > fit.ln_evidence {
            let pieces = curve.freedom.clamp(4, MOST_PIECES);
            found.fit = with_curve(regression, &rest, joint, pieces, likelihood);
        }
    }
}

/// Takes out, one after the other, names over the only joint without which the samples are likelier, a free curve over
/// it beside the names in both cases: what repeats is in the model with or without a name, and a name has to beat it.
pub(crate) fn withdraw(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    // What wanders is held against the names elsewhere.
    if prepared.survey.joints.len() != 1 || regression.noise.slow.is_some() {
        return;
    }
    let joint = 0;
    let over_joint =
        |s: &crate::diagnosis::candidates::Placed| s.shape.variable == Variable::Joint(joint);
    let kept = found.fit.shapes.iter().filter(|s| !over_joint(s)).cloned();
    let kept: Vec<_> = kept.collect();
    let with_rest = |model: &Model| {
        let fit = regression.fit(model, &kept);
        let curve = smooth::free_curve(prepared, model, joint);
        let own = curve
            .as_ref()
            .map_or(0.0, |curve| (curve.ln_odds - PRICE).max(0.0));
        (fit.ln_evidence + own, fit, curve.filter(|_| own > 0.0))
    };
    let mut model = found.fit.model.clone();
    let mut withdrawn = None;
    let mut most = f64::NAN;
    loop {
        let of_base = |t: &Term| regression.base.terms().iter().any(|b| b.same_column(t));
        let own = |t: &&Term| !of_base(t) && follows_only(t, joint);
        let over: Vec<Term> = model.terms().iter().filter(own).cloned().collect();
        if over.is_empty() {
            break;
        }
        if most.is_nan() {
            most = with_rest(&model).0;
        }
        let without = over.iter().map(|term| {
            let model = model.without(|t| t.same_column(term));
            let (value, fit, curve) = with_rest(&model);
            (value, model, fit, curve)
        });
        let best = without.max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((value, without, fit, curve)) = best.filter(|best| best.0 > most) else {
            break;
        };
        (most, model) = (value, without);
        withdrawn = Some((value, fit, curve));
    }
    if let Some((value, fit, curve)) = withdrawn {
        found.fit = match curve {
            Some(curve) => {
                let pieces = curve.freedom.clamp(4, MOST_PIECES);
                with_curve(regression, &fit, joint, pieces, value)
            }
            None => fit,
        };
    }
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
        let made_up: Vec<Term> = regression
            .added(&found.fit)
            .into_iter()
            .filter(|t| follows_only(t, joint))
            .cloned()
            .collect();
        let model = found
            .fit
            .model
            .without(|t| made_up.iter().any(|m| m.same_column(t)));
        let rest = regression.fit(&model, &[]);
        let Some(curve) = smooth::free_curve(white, &rest.model, joint) else {
            continue;
        };
        let likelihood = rest.ln_evidence + curve.ln_odds - PRICE;
        let before = best
            .as_ref()
            .map_or(found.fit.ln_evidence, |b| b.ln_evidence);
        if likelihood > before {
            let pieces = curve.freedom.clamp(4, MOST_PIECES);
            best = Some(with_curve(regression, &rest, joint, pieces, likelihood));
        }
    }
    best.map(|fit| SearchResult {
        fit,
        named_effects_only: regression.fit(&found.named_effects_only.model, &[]),
        other_ends: Vec::new(),
        withdrawn: Vec::new(),
        base_misfit: false,
    })
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
pub(crate) fn follows_only(term: &Term, joint: usize) -> bool {
    let about = term.effect.about();
    about.over == Over::Angle && (term.joint == joint || !about.per_joint)
}

fn settings(term: &Term) -> usize {
    usize::from(crate::effects::term::setting_quantity(term.effect.about().setting).is_some())
}

pub(crate) fn with_curve(
    regression: &Regression,
    rest: &Fit,
    joint: usize,
    pieces: usize,
    ln_evidence: f64,
) -> Fit {
    let mut shapes = rest.shapes.clone();
    shapes.push(regression.placed(Shape {
        variable: Variable::Joint(joint),
        direction: Direction::Tangential(joint),
        profile: Profile::Curve { pieces },
        tried: 1.0,
    }));
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
        let beside = with_curve(regression, &base, 1, 48, 0.0);
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
}
