//! The repeating part of the error of one joint that has no name: a smooth curve over the joint's commanded value,
//! common to both sides and half of the reversal, in directions that turn with the joint: along its motion, which a
//! table can correct, along its radius and along its axis.
//!
//! ```text
//! deviation = base and names + r(q, dir) + slow(t) + noise
//! ```
//!
//! r is a Gaussian process of which kernels, sizes and parts are chosen by one restricted likelihood
//! ([`kernels`](super::kernels)). The names keep the values that are handed out; the base is fitted again with r, and
//! its change is a constant of the curve. What comes back in another run belongs to the axis, the residual to time.
//!
//! It is handed out where unseen runs, or in a single run unseen values, are predicted better with it ([`folds`](super::folds)).

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::effects::Term;
use crate::effects::curve::{Curve, DIRECTIONS, Knots, Parts};
use crate::fit::gap::{deviations, suspects};
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::{base_model, noise_given};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::text::Text;
use crate::{budget, fewest, odds, rounding};

use super::columns::{Block, Columns};
use super::folds::Folds;
use super::groups::Remaining;
use super::held_out::{HeldOut, Whitened};
use super::kernels::{Fitted, Kernels, Prior};
use super::products::Products;
use crate::side_by_side::Threads;

/// With fewer different values of a joint no curve rivals a name.
const FEWEST_TO_RIVAL: usize = 10;

/// Sides of a direction: what is common to both, and half of the reversal.
const SIDES: usize = 2;
/// Most knots of a curve over a range.
pub(crate) const MOST_KNOTS: usize = 61;

/// Most knots over a turn …
const MOST_IN_A_TURN: usize = 72;
/// … and over a shorter period.
pub(crate) const MOST_IN_A_PERIOD: usize = 24;
/// With fewer different values of the joint there is nothing between which a curve could be drawn (ISO 230-2 asks
/// for five targets).
const FEWEST_VALUES: usize = 5;
/// The repeating curve over a joint in addition to a model.
pub(crate) struct Repeating<'a> {
    /// The curve.
    pub(crate) term: Term,
    /// Cross-validated RMS errors: of the base alone, of the model, and with the curve, mm.
    pub(crate) held_out_mm: [f64; 3],
    /// The number of folds of these.
    pub(crate) samples: usize,
    /// The way in which they were held out.
    pub(crate) how: Text,
    /// The samples, with the outliers of the fit with the curve.
    pub(crate) problem: Problem<'a>,
    /// RMS error of unseen runs with the curve, mm; `None` of a single run.
    pub(crate) runs_held_out_mm: Option<f64>,
    /// The same of unseen values, where their neighbours do not predict them.
    pub(crate) values_held_out_mm: Option<f64>,
    /// The noise with the curve, where values come back from the same side: then the residual belongs to time.
    pub(crate) noise: Option<Noise>,
}

/// The repeating curve over a joint in addition to a model, or `None` where there is none, or it does not predict.
/// `problem` holds the samples that count.
pub(crate) fn repeating<'a>(
    problem: &Problem<'a>,
    model: &Model,
    base: &Model,
    joint: usize,
    period: Option<f64>,
) -> Option<Repeating<'a>> {
    let (problem, fitted) = settled(problem, model, joint, period)?;
    if fitted.ln_odds() < odds::TAKEN.nats() {
        return None;
    }
    let held_out = |folds: Folds| Some((fitted.held_out(&folds)?, folds));
    let by_values = Folds::values(&fitted.columns, joint).and_then(held_out);
    let by_runs = Folds::runs(&fitted.columns).and_then(held_out);
    let gains = |own: &&([f64; 2], Folds)| own.0[1] < own.0[0];
    // Between targets that are too far apart no curve predicts, and yet at them the axis may repeat.
    let predicting = by_values.as_ref().filter(gains);
    let predicting = predicting.or(by_runs.as_ref().filter(gains));
    let seen = |own: &Option<([f64; 2], Folds)>| own.is_some();
    let denied = by_runs.as_ref().is_some_and(|own| !gains(&own));
    let doubted =
        fitted.ln_odds() < odds::BEYOND_DOUBT.nats() || !(seen(&by_values) || seen(&by_runs));
    if denied || predicting.is_none() && doubted {
        return None;
    }
    let ([before, after], folds) = predicting.or(by_values.as_ref())?;
    let curve = fitted.curve()?;
    let identified = Columns::new(&problem, base, joint, is_base);
    let term = Term::unexplained(joint, curve);
    let comes_back = Folds::come_back(&fitted.columns);
    Some(Repeating {
        noise: comes_back.then(|| noise_given(&problem, &model.with_term(term.clone()), &[])),
        term,
        held_out_mm: [alone(&identified, folds)?, *before, *after],
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

/// The curve with the noise and the outliers that follow from it.
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
    for _ in 0..budget::ROUNDS {
        let with = model.with_term(Term::unexplained(joint, fitted.curve()?));
        // With the names alone the peak of a bump looks like an outlier; with the bump an outlier may look like none.
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
    // The residual of the repeating curve belongs to time.
    let residuals = fitted.residuals();
    let mut columns = Columns::new(&problem, model, joint, is_base);
    if columns.wander(&residuals) {
        fitted = OverJoint::fitted(columns, model, period).unwrap_or(fitted);
    }
    Some((problem, fitted))
}

/// What returns at every visit of a value belongs to the axis, however far it is from the model: it is no outlier.
/// Readings with no measurement between them are one visit.
fn use_what_returns(problem: &mut Problem, joint: usize) {
    let (fit, mut counted) = (problem.to_fit(), problem.counted().to_vec());
    let mut places: BTreeMap<i64, (usize, Vec<usize>)> = BTreeMap::new();
    let mut before = None;
    for k in (0..fit.len()).filter(|k| fit[*k]) {
        let place =
            (problem.inputs.q[joint][problem.sample_of(k)] / rounding::WRITTEN).round() as i64;
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

/// Terms that belong to every calibration, and are fitted with the curve.
fn is_base(term: &Term) -> bool {
    base_model::belongs(term.effect.about().id)
}

/// A free curve over a joint in addition to a model.
pub(crate) struct FreeCurve {
    /// Logarithm of how much likelier the samples are with it.
    pub(crate) ln_odds: f64,
    /// Effective number of parameters.
    pub(crate) freedom: usize,
    /// In which direction it is largest: along the motion, the radius, the axis.
    pub(crate) direction: usize,
}

/// The likeliest free curve over a joint in addition to a model, common to both sides, given a noise: its likelihood
/// is compared with those of names.
pub(crate) fn free_curve(
    problem: &Problem,
    noise: &Noise,
    model: &Model,
    joint: usize,
) -> Option<FreeCurve> {
    let columns = Columns::together(problem, noise, model, joint);
    if columns.values.len() < FEWEST_TO_RIVAL {
        return None;
    }
    let knots = columns.knots(columns.values.len().clamp(fewest::OF_A_PART, MOST_KNOTS));
    let kernels = Kernels::new(knots.count, false)?;
    let block = &columns.blocks[0];
    let whitened = block.whitened(&block.curve(&columns, &knots, 1));
    let remaining = Remaining::of(&whitened.products(&block.measured))?;
    let (prior, ln_odds) = kernels.likeliest(&remaining)?;
    let values = kernels.fit(&remaining, &prior)?.values();
    let size = |direction: &usize| values.rows(direction * knots.count, knots.count).norm();
    let largest = (0..prior.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
    Some(FreeCurve {
        ln_odds,
        freedom: Kernels::pieces(&prior).ceil() as usize,
        direction: largest.unwrap_or(0),
    })
}

/// The likeliest curve over a joint on some samples, with its regression.
struct OverJoint<'a> {
    columns: Columns<'a>,
    knots: Knots,
    kernels: Kernels,
    /// Block by block.
    parts: Vec<Part>,
}

/// The curve of one block.
struct Part {
    curve: DMatrix<f64>,
    whitened: Whitened,
    products: Products,
    /// The curve, and how much likelier the samples are with it, as a logarithm; `None` where there is none.
    found: Option<(Prior, f64)>,
}

impl Part {
    fn of(columns: &Columns, block: &Block, knots: &Knots) -> Self {
        let curve = block.curve(columns, knots, SIDES);
        let whitened = block.whitened(&curve);
        Self {
            products: whitened.products(&block.measured),
            curve,
            whitened,
            found: None,
        }
    }

    fn likeliest(mut self, kernels: &Kernels) -> Option<Self> {
        self.found = kernels.likeliest(&Remaining::of(&self.products)?);
        Some(self)
    }

    fn fitted(&self, kernels: &Kernels) -> Option<Fitted> {
        let (prior, _) = self.found.as_ref()?;
        kernels.fit(&Remaining::of(&self.products)?, prior)
    }

    fn ln_odds(&self) -> f64 {
        self.found.as_ref().map_or(0.0, |found| found.1)
    }
}

impl<'a> OverJoint<'a> {
    /// `None` where no curve makes the samples likelier, or there are too few values.
    /// `period`: the period of the residual, rad or mm, as the search found it.
    fn fitted(columns: Columns<'a>, model: &Model, period: Option<f64>) -> Option<Self> {
        if columns.values.len() < FEWEST_VALUES {
            return None;
        }
        let turns = model.robot.joints[columns.joint].kind == JointKind::Revolute;
        let mut best: Option<(Knots, Kernels, Vec<Part>)> = None;
        let ln_odds = |parts: &[Part]| parts.iter().map(Part::ln_odds).sum::<f64>();
        for knots in knots(&columns, turns, period) {
            let kernels = Kernels::new(knots.count, knots.period.is_some())?;
            let blocks = columns.blocks.iter();
            let parts = blocks.map(|block| Part::of(&columns, block, &knots).likeliest(&kernels));
            let parts: Vec<Part> = parts.collect::<Option<_>>()?;
            let before = best.as_ref().map_or(0.0, |best| ln_odds(&best.2));
            if ln_odds(&parts) > before {
                best = Some((knots, kernels, parts));
            }
        }
        let (knots, kernels, parts) = best?;
        Some(Self {
            columns,
            knots,
            kernels,
            parts,
        })
    }

    fn ln_odds(&self) -> f64 {
        self.parts.iter().map(Part::ln_odds).sum()
    }

    /// The curve, with the change of the base as constants.
    fn curve(&self) -> Option<Curve> {
        let (mut values, mut sigma) = (Parts::default(), Parts::default());
        let n = self.knots.count;
        for (block, part) in self.columns.blocks.iter().zip(&self.parts) {
            let (direction, unit) = (block.directions[0], block.unit[0]);
            let base = block.base.ncols();
            let none = DVector::zeros(part.curve.ncols());
            let step = part.products.with_base(&none)?.rows(0, base).into_owned();
            let constant = block.as_constant(&step);
            let Some(fitted) = part.fitted(&self.kernels) else {
                if constant.abs() > rounding::WRITTEN {
                    values[direction] = vec![constant * unit; n];
                    sigma[direction] = vec![0.0; n];
                }
                continue;
            };
            let (own, deviations) = (fitted.values(), fitted.sigma());
            let prior = part.found.as_ref().map_or(&[][..], |found| &found.0);
            for side in (0..SIDES).filter(|side| prior[*side].is_some() || *side == 0) {
                let by = if side == 0 { constant } else { 0.0 };
                let of = |all: &DVector<f64>, by: f64| -> Vec<f64> {
                    let own = all.rows(side * n, n);
                    own.iter().map(|v| (v + by) * unit).collect()
                };
                let at = side * DIRECTIONS + direction;
                values[at] = of(&own, by);
                sigma[at] = of(&deviations, 0.0);
            }
        }
        Curve::new(self.knots, values, sigma).ok()
    }

    /// The residuals of the fit with the curve, block by block, mm.
    fn residuals(&self) -> Vec<DVector<f64>> {
        let both = self.columns.blocks.iter().zip(&self.parts);
        both.map(|(block, part)| match part.fitted(&self.kernels) {
            Some(fitted) => &block.residual - &part.curve * fitted.values(),
            None => block.residual.clone(),
        })
        .collect()
    }

    /// Root mean square deviations of unseen samples without and with the curve, mm. Base, sizes and curve are
    /// fitted without them.
    fn held_out(&self, folds: &Folds) -> Option<[f64; 2]> {
        let mut sums = [0.0; 2];
        for part in &self.parts {
            let curve = |seen: &Remaining| match &part.found {
                Some((prior, _)) => {
                    let prior = self.kernels.refined(seen, prior.clone()).0;
                    Some(self.kernels.fit(seen, &prior)?.values())
                }
                None => Some(DVector::zeros(seen.columns())),
            };
            let of_part = held_out(&part.whitened, folds)?.squares(curve)?;
            for (sum, side) in sums.iter_mut().zip(0..2) {
                *sum += of_part.iter().map(|own| own[side]).sum::<f64>();
            }
        }
        let samples = folds.samples().max(1) as f64;
        Some(sums.map(|sum| (sum / samples).sqrt()))
    }
}

fn held_out<'w>(whitened: &'w Whitened, folds: &Folds) -> Option<HeldOut<'w>> {
    let seen = |fold: usize| {
        let seen = whitened.rows(|sample| !folds.is_in(sample, fold));
        let rows = whitened.rows(|sample| folds.is_in(sample, fold));
        (rows, whitened.products(&seen))
    };
    HeldOut::new(whitened, &seen, folds.count, folds.all(), Threads::ONE)
}

/// RMS error of unseen samples of the base without a curve, mm.
fn alone(columns: &Columns, folds: &Folds) -> Option<f64> {
    let mut sum = 0.0;
    for block in &columns.blocks {
        let whitened = block.whitened(&DMatrix::zeros(block.samples.len(), 0));
        let squares = held_out(&whitened, folds)?.squares(|_| Some(DVector::zeros(0)))?;
        sum += squares.iter().map(|own| own[0]).sum::<f64>();
    }
    Some((sum / folds.samples().max(1) as f64).sqrt())
}

/// Knots over the range, twice as many as there are values, over a turn where the joint goes round, and over a period.
fn knots(columns: &Columns, turns: bool, period: Option<f64>) -> Vec<Knots> {
    let values = columns.values.len();
    let range = columns.knots((2 * values - 1).clamp(fewest::OF_A_PART, MOST_KNOTS));
    let span = range.to - range.from;
    let around = std::f64::consts::TAU;
    let step = span / (values - 1).max(1) as f64;
    let mut all = vec![range];
    // What does not come round twice is not known to repeat, and what has fewer than four values in a period may be a
    // slower wave.
    let comes_round = |period: &f64| 2.0 * period <= span && *period >= 4.0 * step;
    all.extend(period.filter(comes_round).map(|period| Knots {
        period: Some(period),
        count: values.clamp(fewest::OF_A_PART, MOST_IN_A_PERIOD),
        ..range
    }));
    // The first value of the next turn is a step behind the last one of this.
    if turns && span + 1.5 * step >= around {
        all.push(Knots {
            period: Some(around),
            count: (2 * values).clamp(fewest::OF_A_PART, MOST_IN_A_TURN),
            ..range
        });
    }
    all
}
