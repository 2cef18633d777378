//! A free curve over a joint as the rival of names that follow nothing but its value: a kink, levels by sector or a
//! chirp can be made up of enough harmonics, a pull of cables at both ends of the range is scale, eccentricity and
//! two-cycle together, and none of them is any of these.
//!
//! The curve is a Gaussian process along the joint's motion, along its radius and along its axis
//! ([`crate::diagnosis::rest`]). What repeats over the joint is explained by names, by the curve, or by both: by what
//! makes the samples likeliest. Names that are not needed in addition to the curve are withdrawn.

use std::collections::BTreeMap;

use nalgebra::DMatrix;

use crate::decompose::eigen;
use crate::effects::survey::ENOUGH;
use crate::effects::term::setting_quantity;
use crate::effects::{Over, Term};
use crate::linear::reject_all;
use crate::model::Model;
use crate::{fewest, numeric, odds};

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use crate::diagnosis::candidates::Placed;
use crate::diagnosis::evidence::{EFFECT_PRIOR_PENALTY, Fit, Regression};
use crate::diagnosis::rest::joint::{MOST_IN_A_PERIOD, MOST_KNOTS, free_curve};
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// The penalty of the curve: that of a name, and a factor of e for each of its parameters (length, size, roughness).
/// Names have no prior preference; no further one is needed.
const PRICE: f64 = EFFECT_PRIOR_PENALTY + 3.0;
/// Shares of the range within which a pull at its ends falls to 1/e: cables and hoses are bent there, and the farther
/// the stiffer.
const PULLS: [f64; 6] = [0.05, 0.07, 0.1, 0.14, 0.2, 0.28];

/// A model with the likeliest curve over a joint added, or with none.
struct FitWithCurve {
    ln_evidence: f64,
    fit: Fit,
    curve: Option<Curve>,
}

/// A curve over a joint.
struct Curve {
    /// How much likelier the samples are with it, as a logarithm.
    ln_odds: f64,
    /// Pieces of an equivalent polygon.
    pieces: usize,
    /// The direction in which it is largest.
    direction: Direction,
}

impl FitWithCurve {
    fn of(prepared: &PreparedSearch, model: &Model, shapes: &[Placed], joint: usize) -> Self {
        let fit = prepared.regression.fit(model, shapes);
        let across = &prepared.regression.table.space.across;
        let direction = |k: usize| {
            let own = [
                [Direction::Radial, Direction::Guide(joint, 1)],
                [Direction::Axial, Direction::Guide(joint, 2)],
            ];
            let own = k.checked_sub(1).map(|k| own[k]);
            let measured = across.iter().map(|across| across.0);
            let mut measured = measured.filter(|is| own.is_some_and(|own| own.contains(is)));
            measured.next().unwrap_or(Direction::Tangential(joint))
        };
        let regression = &prepared.regression;
        let curve = free_curve(&regression.problem, &regression.noise, model, joint);
        let curve = curve.map(|curve| Curve {
            ln_odds: curve.ln_odds,
            pieces: curve.freedom.clamp(fewest::OF_A_PART, MOST_KNOTS - 1),
            direction: direction(curve.direction),
        });
        let single = prepared.survey.joints.len() == 1;
        let ends = single.then(|| pulled_at_its_ends(&prepared.regression, &fit, joint));
        let likelier = curve.into_iter().chain(ends.flatten());
        let curve = likelier
            .max_by(|a, b| a.ln_odds.total_cmp(&b.ln_odds))
            .filter(|curve| curve.ln_odds > PRICE);
        let own = curve.as_ref().map_or(0.0, |curve| curve.ln_odds - PRICE);
        Self {
            ln_evidence: fit.ln_evidence + own,
            curve,
            fit,
        }
    }

    /// The fit with the curve as a shape.
    fn into_fit(self, prepared: &PreparedSearch, joint: usize) -> Fit {
        match self.curve {
            Some(curve) => {
                let shape = over(joint, curve.direction, curve.pieces);
                with_curve(&prepared.regression, &self.fit, shape, self.ln_evidence)
            }
            None => self.fit,
        }
    }
}

/// How much likelier the samples are, as a logarithm, with two pulls along the joint's motion that grow exponentially
/// towards the ends of its range, of independent sizes t in units of the noise. With B their columns projected
/// orthogonal to the fit and r its residual,
///
/// ```text
/// ln E = −½ Σ ln(1 + t² e_k) − (m/2) ln(1 − Σ t² z_k²/(1 + t² e_k) / rss),   e, U: eigen of BᵀB,   z = Uᵀ Bᵀ r
/// ```
fn pulled_at_its_ends(regression: &Regression, reduced: &Fit, joint: usize) -> Option<Curve> {
    let direction = Direction::Tangential(joint);
    let free = regression
        .placed(over(joint, direction, MOST_KNOTS - 1))
        .white;
    // One unit of the curve moves a sample by one unit of its noise, in the mean.
    let samples = regression.rows.samples.len().max(1) as f64;
    let unit = free.column_sum().norm_squared().max(free.norm_squared()) / samples;
    let (total, m) = (regression.rounded(reduced.rss), regression.m());
    let of_length = |length: f64| {
        let root = DMatrix::from_fn(MOST_KNOTS, 2, |row, end| {
            let from_low = row as f64 / (MOST_KNOTS - 1) as f64;
            let away = if end == 0 { from_low } else { 1.0 - from_low };
            (-away / length).exp()
        });
        let mut columns = &*free * root / unit.sqrt();
        reject_all(&reduced.basis.q, &mut columns);
        let own = eigen(columns.tr_mul(&columns));
        let z = own.eigenvectors.tr_mul(&columns.tr_mul(&reduced.residual));
        let of_size = |size: f64| {
            let t2 = size * size;
            let (mut determinant, mut gain) = (0.0, 0.0);
            for (e, z) in own.eigenvalues.iter().zip(&z) {
                let wider = 1.0 + t2 * e.max(0.0);
                determinant += wider.ln();
                gain += t2 * z * z / wider;
            }
            let share = (gain / total.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
            -0.5 * determinant - 0.5 * m * (-share).ln_1p()
        };
        let sizes = (0..15).map(|k| of_size(0.2 * 2.0_f64.powi(k)));
        sizes.fold(f64::NEG_INFINITY, f64::max)
    };
    let best = PULLS
        .map(of_length)
        .into_iter()
        .fold(f64::NEG_INFINITY, f64::max);
    (unit > 0.0).then_some(Curve {
        ln_odds: best,
        pieces: MOST_IN_A_PERIOD,
        direction,
    })
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

/// Compares all names over each joint, fewer of them, and none, each alone and with a free curve over the joint: the
/// least needed name, or all at once, is taken out while the samples are likelier without. What repeats is in the model
/// with or without a name.
pub(crate) fn rival(prepared: &PreparedSearch, found: &mut SearchResult) {
    for joint in 0..prepared.survey.joints.len() {
        let (mut names, kept) = over_joint(prepared, &found.fit, joint);
        if names.is_empty() {
            continue;
        }
        let fitted = |model: &Model| FitWithCurve::of(prepared, model, &kept, joint);
        let mut model = found.fit.model.clone();
        let mut most = found.fit.ln_evidence.max(fitted(&model).ln_evidence);
        let mut likeliest = None;
        while !names.is_empty() {
            let one_by_one = names.iter().map(std::slice::from_ref);
            let sets = one_by_one.chain((names.len() > 1).then_some(names.as_slice()));
            let fewer = sets.map(|set| without(&model, set));
            let fewer = fewer.map(|model| (fitted(&model), model));
            let best = fewer.max_by(|a, b| a.0.ln_evidence.total_cmp(&b.0.ln_evidence));
            let Some((reduced, fewer)) = best.filter(|best| best.0.ln_evidence > most) else {
                break;
            };
            (most, model) = (reduced.ln_evidence, fewer);
            names.retain(|name| model.terms().iter().any(|t| t.same_column(name)));
            likeliest = Some(reduced);
        }
        if let Some(likeliest) = likeliest {
            found.fit = likeliest.into_fit(prepared, joint);
        }
    }
}

/// Takes names over a joint out that are in the model together with a shape over it, where zero offset, names and
/// shape have more parameters than half of the values at which it was measured: the residuals at these cannot
/// contradict them, however often each was visited. (Evidence counts every visit, so that it does not show that.)
pub(crate) fn withdraw_of_few_values(prepared: &PreparedSearch, found: &mut SearchResult) {
    for (joint, survey) in prepared.survey.joints.iter().enumerate() {
        let (names, kept) = over_joint(prepared, &found.fit, joint);
        let own = |s: &&Placed| s.shape.variable == Variable::Joint(joint);
        let shapes = found
            .fit
            .shapes
            .iter()
            .filter(own)
            .map(|s| &s.shape.profile);
        let of_shapes: usize = shapes.map(|s| s.count() + s.settings()).sum();
        let numbers = 1 + numbers_of(&names) + of_shapes;
        if of_shapes > 0 && !names.is_empty() && survey.values < ENOUGH.min(2 * numbers) {
            let reduced = without(&found.fit.model, &names);
            let reduced = FitWithCurve::of(prepared, &reduced, &kept, joint);
            found.fit = reduced.into_fit(prepared, joint);
        }
    }
}

/// Names over a joint, with the joint, that the samples cannot distinguish from a curve.
pub(crate) fn as_likely(prepared: &PreparedSearch, fit: &Fit) -> Option<(usize, Vec<Term>)> {
    let of_joint = |joint: usize| {
        let (names, kept) = over_joint(prepared, fit, joint);
        let is_open = names.len() >= fewest::NO_ACCIDENT && kept.len() == fit.shapes.len();
        let reduced = || FitWithCurve::of(prepared, &without(&fit.model, &names), &kept, joint);
        let odds = is_open.then(|| reduced().ln_evidence - fit.ln_evidence);
        odds.map(|odds| (odds, (joint, names)))
    };
    let all = (0..prepared.survey.joints.len()).filter_map(of_joint);
    let likely = all.filter(|own| own.0 > -odds::OPEN.nats());
    let best = likely.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|own| own.1)
}

/// Numbers that names have: coefficients and settings.
fn numbers_of(names: &[Term]) -> usize {
    let settings = |t: &Term| usize::from(setting_quantity(t.effect.about().setting).is_some());
    names
        .iter()
        .map(|t| t.coefficients.len() + settings(t))
        .sum()
}

/// The free curve that replaces a slow part of the noise, in addition to the names that do not follow the same joint:
/// what comes back at the same value of the joint is no drift of the frame, however quickly both change. `None` where
/// no curve is as likely as what was found.
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
        let fitted = FitWithCurve::of(white, &model, &[], joint);
        let before = best.as_ref().unwrap_or(&found.fit).ln_evidence;
        if fitted.curve.is_some() && fitted.ln_evidence > before {
            best = Some(fitted.into_fit(white, joint));
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
    let [low, high] = numeric::extent(q.iter());
    let [first, last] = numeric::extent(times);
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

fn with_curve(regression: &Regression, reduced: &Fit, curve: Shape, ln_evidence: f64) -> Fit {
    let mut shapes = reduced.shapes.clone();
    shapes.push(regression.placed(curve));
    let mut fit = regression.fit(&reduced.model, &shapes);
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
        let fitted = with_curve(
            regression,
            &base,
            over(1, Direction::Tangential(1), 48),
            0.0,
        );
        let at = |fit: &Fit| deviations(&prepared.problem, &fit.model).axes_mm;
        let (alone, with) = (at(&base), at(&fitted));
        let moved = (0..3).flat_map(|axis| alone[axis].iter().zip(&with[axis]));
        let most = moved.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(most < 0.1, "the geometry alone moves by {most} mm");
        // And the curve does its part.
        assert!(
            fitted.rss < 0.7 * base.rss,
            "{} of {}",
            fitted.rss,
            base.rss
        );
    }

    const NAMES: [&str; 3] = ["joint-scale", "encoder-eccentricity", "encoder-two-cycle"];

    /// One axis whose angle is off by this many degrees at each of its values, in degrees, in addition to effects.
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

    /// How many of the three names stay in such a session.
    fn that_stay(session: &Session) -> usize {
        let prepared = PreparedSearch::new(session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let mut fit = regression.fit(&regression.base, &[]);
        for name in NAMES {
            let mut candidates = regression.table.candidates.iter();
            let is = |t: &Term| t.effect.about().id == name;
            let there = candidates.find(|c| c.what.term().is_some_and(is));
            fit = regression.with(&fit, &there.unwrap().what);
        }
        let mut found = SearchResult::of(fit.clone(), fit);
        rival(&prepared, &mut found);
        regression.added(&found.fit).len()
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
        let fitted = FitWithCurve::of(&prepared, &prepared.regression.base, &[], 0);
        let fit = fitted.into_fit(&prepared, 0);
        assert_eq!(fit.shapes[0].shape.direction, Direction::Axial);
    }

    #[test]
    fn a_pull_of_cables_is_more_of_a_curve_than_three_names() {
        let pull = |q: f64| 0.06 * ((q - 170.0) / 30.0).exp() - 0.05 * ((-170.0 - q) / 45.0).exp();
        assert!(that_stay(&axis("", pull)) < 3);
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
        assert_eq!(that_stay(&axis(&effects.join(","), |_| 0.0)), 3);
    }
}
