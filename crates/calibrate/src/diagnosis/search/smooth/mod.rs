//! What repeats over a joint and has no name: a smooth curve over the joint's commanded value, common to both
//! sides and half of the reversal, in directions that turn with the joint: along its motion, which a table can
//! correct, along its radius and along its axis.
//!
//! ```text
//! deviation = base and names + r(q, dir) + slow(t) + noise
//! ```
//!
//! r is a Gaussian process of which kernels, sizes and parts are chosen by one restricted likelihood ([`likelihood`]).
//! The names keep the values that are handed out; the base is fitted anew beside r, and what it moves by is a
//! constant of the curve. What comes back in another run is of the axis, and time has what is left.
//!
//! It is handed out where unseen runs, or in a single run unseen values, are predicted better with it ([`folds`]).

mod columns;
mod folds;
mod likelihood;

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::effects::Term;
use crate::effects::curve::{Curve, DIRECTIONS, Knots, Parts};
use crate::fit::gap::{deviations, suspects};
use crate::fit::noise::{Noise, SMALLEST_SIGMA_MM};
use crate::fit::problem::Problem;
use crate::fit::{base_model, noise_beside};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::text::Text;

use super::prepare::PreparedSearch;
use columns::{Along, Columns, MOST_KNOTS, SAME, together};
use folds::Folds;
use likelihood::{Kernels, NamesAlone, Prior, SIDES, Sums};

/// The samples are beyond doubt so much likelier, as a logarithm (as in `verdict::unnamed`): what stands at the ends of
/// the range shows in no fold of the values between them.
const BEYOND_DOUBT: f64 = 50.0;
/// Most knots over a turn …
const MOST_IN_A_TURN: usize = 72;
/// … and over a shorter period.
const MOST_IN_A_PERIOD: usize = 24;
/// With fewer different values of the joint there is nothing between which a curve could be drawn (ISO 230-2 asks
/// for five targets).
const FEWEST_VALUES: usize = 5;
/// How often samples that were suspected are looked at again.
const MOST_ROUNDS: usize = 4;
/// The samples have to be so much likelier with a curve, as a logarithm. Kernels, sizes and parts are chosen, so that
/// noise alone gains something: `tests/reference/axis_tables.py --kinds noise`.
const LIKELIER: f64 = 6.0;

/// What repeats over a joint beside a model.
pub(crate) struct Repeating<'a> {
    /// The curve.
    pub(crate) term: Term,
    /// RMS deviations of samples that no fit has seen: of the base alone, of the model, and with the curve, mm.
    pub(crate) held_out_mm: [f64; 3],
    /// How many those are.
    pub(crate) samples: usize,
    /// How they were held out.
    pub(crate) how: Text,
    /// The samples, with the outliers that there are beside it.
    pub(crate) problem: Problem<'a>,
    /// RMS deviation of unseen runs with the curve, mm; `None` of a single run.
    pub(crate) runs_held_out_mm: Option<f64>,
    /// The same of unseen values, where their neighbours do not predict them.
    pub(crate) values_held_out_mm: Option<f64>,
    /// The noise beside it, where values come back from the same side: then time has what the curve leaves.
    pub(crate) noise: Option<Noise>,
}

/// What repeats over a joint beside a model, or `None` where there is nothing, or it predicts nothing.
/// `problem` holds the samples that count.
pub(crate) fn repeating<'a>(
    problem: &Problem<'a>,
    model: &Model,
    base: &Model,
    joint: usize,
    period: Option<f64>,
) -> Option<Repeating<'a>> {
    let (problem, fitted) = settled(problem, model, joint, period)?;
    if fitted.ln_odds() < LIKELIER {
        return None;
    }
    let held_out = |folds: Folds| (fitted.held_out(&folds), folds);
    let by_values = Folds::values(&fitted.columns, joint).map(held_out);
    let by_runs = Folds::runs(&fitted.columns).map(held_out);
    let gains = |own: &&([f64; 2], Folds)| own.0[1] < own.0[0];
    // Between targets that are too far apart no curve predicts, and at them the axis comes back all the same.
    let said = by_values.as_ref().filter(gains);
    let said = said.or(by_runs.as_ref().filter(gains));
    let seen = |own: &Option<([f64; 2], Folds)>| own.is_some();
    let denied = by_runs.as_ref().is_some_and(|own| !gains(&own));
    let doubted = fitted.ln_odds() < BEYOND_DOUBT || !(seen(&by_values) || seen(&by_runs));
    if denied || said.is_none() && doubted {
        return None;
    }
    let ([before, after], folds) = said.or(by_values.as_ref())?;
    let curve = fitted.curve()?;
    let identified = Columns::new(&problem, base, joint, is_base);
    let term = Term::unexplained(joint, curve);
    let comes_back = Folds::come_back(&fitted.columns);
    Some(Repeating {
        noise: comes_back.then(|| noise_beside(&problem, &model.with_term(term.clone()), &[])),
        term,
        held_out_mm: [alone(&identified, folds), *before, *after],
        samples: folds.samples(),
        problem,
        how: folds.how.clone(),
        runs_held_out_mm: by_runs.as_ref().map(|(gap, _)| gap[1]),
        values_held_out_mm: by_values
            .as_ref()
            .filter(|own| !gains(own))
            .map(|(gap, _)| gap[1]),
    })
}

/// The curve beside the noise and the outliers that are there with it.
fn settled<'a>(
    problem: &Problem<'a>,
    model: &Model,
    joint: usize,
    period: Option<f64>,
) -> Option<(Problem<'a>, OverJoint<'a>)> {
    let mut problem = problem.clone();
    problem.extra_columns.clear();
    use_what_returns(&mut problem, joint);
    let mut fitted =
        OverJoint::fitted(Columns::new(&problem, model, joint, is_base), model, period)?;
    for _ in 0..MOST_ROUNDS {
        let with = model.with_term(Term::unexplained(joint, fitted.curve()?));
        // Beside the names alone the peak of a bump looks like an outlier, and an outlier beside a bump like none.
        let suspected = suspects(&problem, &deviations(&problem, &with));
        let used = suspected
            .iter()
            .zip(&problem.fit)
            .map(|(s, fit)| *fit && !s);
        let used: Vec<bool> = used.collect();
        if problem.observed.is_some() || used == problem.used {
            break;
        }
        problem.used = used;
        let columns = Columns::new(&problem, model, joint, is_base);
        fitted = OverJoint::fitted(columns, model, period)?;
    }
    // Time has what is left once the curve has taken what comes back.
    let left = fitted.left();
    let mut columns = Columns::new(&problem, model, joint, is_base);
    if columns.wander(&left) {
        fitted = OverJoint::fitted(columns, model, period).unwrap_or(fitted);
    }
    Some((problem, fitted))
}

/// What comes back at every visit of a value is of the axis, however far it is from what the names say: no outlier.
/// Readings with nothing measured between them are one visit.
fn use_what_returns(problem: &mut Problem, joint: usize) {
    let (fit, mut counted) = (problem.to_fit(), problem.counted().to_vec());
    let mut places: BTreeMap<i64, (usize, Vec<usize>)> = BTreeMap::new();
    let mut before = None;
    for k in (0..fit.len()).filter(|k| fit[*k]) {
        let place = (problem.inputs.q[joint][problem.sample_of(k)] / SAME).round() as i64;
        let (visits, readings) = places.entry(place).or_default();
        *visits += usize::from(before != Some(place));
        readings.push(k);
        before = Some(place);
    }
    for (visits, readings) in places.values() {
        if *visits > 1 && !readings.iter().any(|k| counted[*k]) {
            for k in readings {
                counted[*k] = true;
            }
        }
    }
    problem.set_counted(counted);
}

/// What belongs to every calibration, and is fitted beside the curve.
fn is_base(term: &Term) -> bool {
    base_model::belongs(term.effect.about().id)
}

/// A free curve over a joint beside a model.
pub(crate) struct FreeCurve {
    /// Logarithm of how much likelier the samples are with it.
    pub(crate) ln_odds: f64,
    /// Columns that it is worth.
    pub(crate) freedom: usize,
    /// In which direction it is largest: along the motion, the radius, the axis.
    pub(crate) direction: usize,
}

/// The likeliest free curve over a joint beside a model, common to both sides, on the samples that a search looks at
/// and beside its noise: its likelihood is compared with those of names.
pub(crate) fn free_curve(
    prepared: &PreparedSearch,
    model: &Model,
    joint: usize,
) -> Option<FreeCurve> {
    let regression = &prepared.regression;
    let (knots, sums) = together(&regression.problem, &regression.noise, model, joint)?;
    let names = NamesAlone::new(&sums);
    let kernels = Kernels::new(knots.count, false)?;
    let prior = likelihood::likeliest(&sums, &names, &kernels)?;
    let fitted = likelihood::fit(&sums, &names, &kernels, &prior, false)?;
    let size = |direction: usize| {
        let own = fitted.values.rows(direction * knots.count, knots.count);
        own.norm()
    };
    let directions = 0..fitted.values.len() / knots.count;
    let pieces = prior.iter().flatten();
    let pieces = pieces.map(|(kernel, _)| kernels.get(*kernel).pieces());
    Some(FreeCurve {
        ln_odds: fitted.ln_evidence - names.ln_evidence,
        freedom: pieces.fold(0.0, f64::max).ceil() as usize,
        direction: directions
            .max_by(|a, b| size(*a).total_cmp(&size(*b)))
            .unwrap_or(0),
    })
}

/// The likeliest curve over a joint on some samples, with what it was fitted to.
struct OverJoint<'a> {
    columns: Columns<'a>,
    knots: Knots,
    kernels: Kernels,
    parts: Vec<Part>,
}

/// The curve in one direction.
struct Part {
    /// Number of the direction among those that were measured.
    along: usize,
    sums: Sums,
    names: NamesAlone,
    prior: Prior,
    /// How much likelier the samples are with it, as a logarithm.
    ln_odds: f64,
}

impl Part {
    fn of(columns: &Columns, along: usize, knots: &Knots, kernels: &Kernels) -> Option<Self> {
        let own = &columns.along[along];
        let sums = own.sums(&own.curve(columns, knots), |_| true)?;
        let names = NamesAlone::new(&sums);
        let prior = likelihood::likeliest(&sums, &names, kernels)?;
        let fitted = likelihood::fit(&sums, &names, kernels, &prior, false)?;
        Some(Self {
            ln_odds: fitted.ln_evidence - names.ln_evidence,
            along,
            sums,
            names,
            prior,
        })
    }
}

impl<'a> OverJoint<'a> {
    /// `None` where no curve makes the samples likelier, or there are too few values.
    /// `period`: after so much, rad or mm, what is left repeats, as the search found.
    fn fitted(columns: Columns<'a>, model: &Model, period: Option<f64>) -> Option<Self> {
        if columns.values.len() < FEWEST_VALUES {
            return None;
        }
        let turns = model.robot.joints[columns.joint].kind == JointKind::Revolute;
        let ln_odds = |parts: &[Part]| parts.iter().map(|part| part.ln_odds).sum::<f64>();
        let mut best: Option<(Knots, Kernels, Vec<Part>)> = None;
        for knots in knots(&columns, turns, period) {
            let kernels = Kernels::new(knots.count, knots.period.is_some())?;
            let directions = 0..columns.along.len();
            let parts = directions.filter_map(|k| Part::of(&columns, k, &knots, &kernels));
            let parts: Vec<Part> = parts.collect();
            if best
                .as_ref()
                .is_none_or(|b| ln_odds(&parts) > ln_odds(&b.2))
            {
                best = Some((knots, kernels, parts));
            }
        }
        let (knots, kernels, parts) = best.filter(|best| !best.2.is_empty())?;
        Some(Self {
            columns,
            knots,
            kernels,
            parts,
        })
    }

    fn ln_odds(&self) -> f64 {
        self.parts.iter().map(|part| part.ln_odds).sum()
    }

    /// The curve, with what the base moves by beside it as constants.
    fn curve(&self) -> Option<Curve> {
        let (mut values, mut sigma) = (Parts::default(), Parts::default());
        let n = self.knots.count;
        for (k, along) in self.columns.along.iter().enumerate() {
            let Some(part) = self.parts.iter().find(|part| part.along == k) else {
                let constant = along.constant_alone();
                if constant.abs() > SMALLEST_SIGMA_MM {
                    values[along.direction] = vec![constant * along.unit; n];
                    sigma[along.direction] = vec![0.0; n];
                }
                continue;
            };
            let fitted =
                likelihood::fit(&part.sums, &part.names, &self.kernels, &part.prior, true)?;
            let constant = along.as_constant(&part.names.step);
            for side in (0..SIDES).filter(|side| part.prior[*side].is_some() || *side == 0) {
                let by = if side == 0 { constant } else { 0.0 };
                let own = |all: &DVector<f64>, by: f64| -> Vec<f64> {
                    let own = all.rows(side * n, n);
                    own.iter().map(|v| (v + by) * along.unit).collect()
                };
                let at = side * DIRECTIONS + along.direction;
                values[at] = own(&fitted.values, by);
                sigma[at] = own(&fitted.sigma, 0.0);
            }
        }
        Curve::new(self.knots, values, sigma).ok()
    }

    /// What is left of the samples beside the curve, direction by direction, mm.
    fn left(&self) -> Vec<DVector<f64>> {
        let columns = &self.columns;
        let of = |(k, along): (usize, &Along)| {
            let part = self.parts.iter().find(|part| part.along == k);
            let fitted = part.and_then(|part| {
                likelihood::fit(&part.sums, &part.names, &self.kernels, &part.prior, false)
            });
            fitted.map_or_else(
                || along.residual.clone(),
                |fitted| &along.residual - along.curve(columns, &self.knots) * fitted.values,
            )
        };
        columns.along.iter().enumerate().map(of).collect()
    }

    /// Root mean square deviations of unseen samples without and with the curve, mm. Base, sizes and curve are
    /// fitted without them.
    fn held_out(&self, folds: &Folds) -> [f64; 2] {
        let columns = &self.columns;
        let (mut before, mut after) = (0.0, 0.0);
        for (k, along) in columns.along.iter().enumerate() {
            let curve = along.curve(columns, &self.knots);
            let part = self.parts.iter().find(|part| part.along == k);
            for fold in 0..folds.count {
                let Some(seen) = along.sums(&curve, |sample| !folds.is_in(sample, fold)) else {
                    continue;
                };
                let names = NamesAlone::new(&seen);
                let fitted = part.and_then(|part| {
                    let prior =
                        likelihood::refined(&seen, &names, &self.kernels, part.prior.clone());
                    likelihood::fit(&seen, &names, &self.kernels, &prior, false)
                });
                for row in along.rows(|sample| folds.is_in(sample, fold)) {
                    let left = along.residual[row] - along.names.row(row).tr_dot(&names.step);
                    let with = fitted
                        .as_ref()
                        .map_or(0.0, |f| curve.row(row).tr_dot(&f.values));
                    before += left * left;
                    after += (left - with).powi(2);
                }
            }
        }
        let samples = folds.samples().max(1) as f64;
        [(before / samples).sqrt(), (after / samples).sqrt()]
    }
}

/// Root mean square deviation of unseen samples from what is fitted beside a curve, without one, mm.
fn alone(columns: &Columns, folds: &Folds) -> f64 {
    let mut squares = 0.0;
    for along in &columns.along {
        let none = DMatrix::zeros(along.samples.len(), 0);
        for fold in 0..folds.count {
            let Some(seen) = along.sums(&none, |sample| !folds.is_in(sample, fold)) else {
                continue;
            };
            let names = NamesAlone::new(&seen);
            for row in along.rows(|sample| folds.is_in(sample, fold)) {
                let left = along.residual[row] - along.names.row(row).tr_dot(&names.step);
                squares += left * left;
            }
        }
    }
    (squares / folds.samples().max(1) as f64).sqrt()
}

/// Knots over the range, twice as many as there are values, over a turn where the joint goes round, and over a period.
fn knots(columns: &Columns, turns: bool, period: Option<f64>) -> Vec<Knots> {
    let values = columns.values.len();
    let range = Knots {
        from: columns.from(),
        to: columns.to(),
        period: None,
        count: (2 * values - 1).clamp(4, MOST_KNOTS),
    };
    let span = range.to - range.from;
    let around = std::f64::consts::TAU;
    let step = span / (values - 1).max(1) as f64;
    let mut all = vec![range];
    // What does not come round twice is not known to repeat, and what has fewer than four values in a period may be a
    // slower wave.
    let comes_round = |period: &f64| 2.0 * period <= span && *period >= 4.0 * step;
    all.extend(period.filter(comes_round).map(|period| Knots {
        period: Some(period),
        count: values.clamp(4, MOST_IN_A_PERIOD),
        ..range
    }));
    // The first value of the next turn is a step behind the last one of this.
    if turns && span + 1.5 * step >= around {
        all.push(Knots {
            period: Some(around),
            count: (2 * values).clamp(4, MOST_IN_A_TURN),
            ..range
        });
    }
    all
}
