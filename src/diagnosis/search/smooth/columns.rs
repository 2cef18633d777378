//! The columns that a smooth correction is fitted with: residuals of the named model, its names'
//! columns, and those of the curve's values at its knots; and which samples are held out.

use nalgebra::{DMatrix, DVector};

use crate::effects::curve::{DIRECTIONS, Knots};
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::noise::{Noise, SMALLEST_SIGMA_MM};
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::model::Model;
use crate::text::Text;

use super::likelihood::Sums;

/// A longer session is thinned evenly to so many samples: there are hundreds for each knot then.
const MOST_SAMPLES: usize = 3000;
/// Values of the joint closer than this (rad or mm) are the same pose.
const SAME: f64 = 1e-6;
/// Parts into which the samples are cut to be held out.
const PARTS: usize = 5;

/// See the module. Columns of names are scaled to length 1 and those of the curve to an effect of
/// one unit of noise a sample; only products with their coefficients leave this module.
pub(super) struct Columns<'a> {
    rows: Rows<'a>,
    noise: Noise,
    q: Vec<f64>,
    /// Different values of the joint, in ascending order.
    pub(super) values: Vec<f64>,
    /// Derivatives of the rows by a constant in each direction, scaled.
    directions: DMatrix<f64>,
    /// A value of 1 at a knot, in rad or mm.
    pub(super) unit: [f64; DIRECTIONS],
    pub(super) names: DMatrix<f64>,
    pub(super) white_names: DMatrix<f64>,
    pub(super) residual: DVector<f64>,
    pub(super) white_residual: DVector<f64>,
    /// What rounding leaves in a whitened row, squared.
    pub(super) floor: f64,
}

/// Which part each sample is in.
pub(super) struct Folds {
    pub(super) of: Vec<usize>,
    pub(super) count: usize,
    /// In words.
    pub(super) how: Text,
}

impl<'a> Columns<'a> {
    /// Of the samples of a problem that count.
    pub(super) fn new(problem: &Problem<'a>, noise: &Noise, model: &Model, joint: usize) -> Self {
        let mut problem = problem.clone();
        problem.thin(MOST_SAMPLES);
        let rows = Rows::of(&problem).seen_by(model);
        let probe = Term::absent(&EACH_DIRECTION, joint, 0.0);
        let model = model.with_term(probe.clone());
        let before = model.terms().iter().take_while(|t| !t.same_column(&probe));
        let first: usize = before.map(|t| t.coefficients.len()).sum();
        let (residual, all) = rows.extract(&model);
        let mut directions = all.columns(first, DIRECTIONS).into_owned();
        let probe: Vec<usize> = (first..first + DIRECTIONS).collect();
        let mut names = all.remove_columns_at(&probe);
        let samples = rows.samples.len().max(1) as f64;
        let mut unit = [0.0; DIRECTIONS];
        let white = noise.whitened(&rows, &directions);
        for d in 0..DIRECTIONS {
            let size = (white.column(d).norm_squared() / samples).sqrt();
            unit[d] = if size > 0.0 { 1.0 / size } else { 0.0 };
            directions.column_mut(d).scale_mut(unit[d]);
        }
        let mut white_names = noise.whitened(&rows, &names);
        for k in 0..names.ncols() {
            let norm = white_names.column(k).norm();
            if norm > 0.0 {
                names.column_mut(k).unscale_mut(norm);
                white_names.column_mut(k).unscale_mut(norm);
            }
        }
        let q = rows.inputs.q[joint].to_vec();
        let mut values = q.clone();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| (*a - *b).abs() < SAME);
        let sigma = rows.axes.iter().map(|a| noise.sigma_mm[*a]);
        let smallest = sigma.fold(f64::INFINITY, f64::min);
        Self {
            white_residual: noise.whitened_vector(&rows, &residual),
            residual,
            white_names,
            names,
            unit,
            directions,
            values,
            q,
            floor: (SMALLEST_SIGMA_MM / smallest).powi(2),
            noise: noise.clone(),
            rows,
        }
    }

    pub(super) fn samples(&self) -> usize {
        self.rows.samples.len()
    }

    pub(super) fn from(&self) -> f64 {
        self.q.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(super) fn to(&self) -> f64 {
        self.q.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Rows of the samples that `pick` picks.
    pub(super) fn rows(&self, pick: impl Fn(usize) -> bool) -> Vec<usize> {
        let n = self.samples();
        let rows = (0..self.rows.len()).filter(|row| self.rows.has(*row));
        rows.filter(|row| pick(row % n)).collect()
    }

    /// Columns of the values at the knots, direction by direction, as they are and whitened.
    pub(super) fn curve(&self, knots: &Knots) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.samples();
        let mut raw = DMatrix::zeros(self.rows.len(), DIRECTIONS * knots.count);
        for (sample, q) in self.q.iter().enumerate() {
            for (k, weight) in knots.weights(*q) {
                for row in (sample..self.rows.len()).step_by(n) {
                    for d in 0..DIRECTIONS {
                        raw[(row, d * knots.count + k)] += weight * self.directions[(row, d)];
                    }
                }
            }
        }
        let white = self.noise.whitened(&self.rows, &raw);
        (raw, white)
    }

    /// Products over all rows.
    pub(super) fn sums(&self, knots: &Knots) -> Option<Sums> {
        let (_, white) = self.curve(knots);
        let all = self.rows(|_| true);
        let sums = Sums::of(&white, &self.white_names, &self.white_residual, &all);
        Sums::total([sums].iter(), self.floor)
    }

    /// How samples are held out: values of the joint between others, which the curve has to
    /// predict from its neighbours. Noise that is correlated in time looks smooth over an ordered
    /// sweep; against that, stretches of time.
    pub(super) fn folds(&self, joint: usize) -> Vec<Folds> {
        let rank = |q: f64| self.values.partition_point(|v| *v < q - SAME);
        let values = Folds {
            of: self.q.iter().map(|q| rank(*q) % PARTS).collect(),
            count: PARTS,
            how: text!(
                "every {parts}th value of joint {joint}, each held out in turn and predicted by a fit without it",
                parts = PARTS,
                joint = joint + 1
            ),
        };
        let n = self.samples().max(1);
        let mut folds = vec![values];
        if self.noise.slow.is_some() {
            folds.push(Folds {
                of: (0..n).map(|k| k * PARTS / n).collect(),
                count: PARTS,
                how: text!(
                    "{parts} stretches of time, as the noise is correlated in time",
                    parts = PARTS
                ),
            });
        }
        folds
    }
}
