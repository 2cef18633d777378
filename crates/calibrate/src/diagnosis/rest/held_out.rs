//! What a base and columns without a name predict of samples that they have not seen.

use nalgebra::{DMatrix, DVector};

use super::groups::Remaining;
use super::products::Products;
use super::{BEYOND_DOUBT, LIKELIER};
use crate::side_by_side::Threads;

/// Rows of the base's columns, of those without a name and of the residual, in this order.
pub(super) struct Whitened {
    pub(super) white: DMatrix<f64>,
    /// As measured, where whitening is more than a factor.
    pub(super) raw: Option<DMatrix<f64>>,
    /// Columns of the base.
    pub(super) base: usize,
    /// Of each row that was measured its sample, and one unit of it in mm.
    pub(super) measured: Vec<(usize, f64)>,
    /// What rounding leaves in a row, squared.
    pub(super) floor: f64,
}

impl Whitened {
    pub(super) fn products(&self, rows: &[usize]) -> Products {
        Products::of(&self.white, self.base, rows, self.floor)
    }

    /// Rows of the samples that `pick` picks.
    pub(super) fn rows(&self, pick: impl Fn(usize) -> bool) -> Vec<usize> {
        let all = 0..self.measured.len();
        all.filter(|row| pick(self.measured[*row].0)).collect()
    }

    /// What coefficients leave of rows, mm², added up for each sample.
    fn squares(&self, rows: &[usize], coefficients: &DVector<f64>, samples: usize) -> Vec<f64> {
        let all = self.raw.as_ref().unwrap_or(&self.white);
        let mut left = all.column(all.ncols() - 1).into_owned();
        let own = all.columns(0, coefficients.len());
        left.gemv(-1.0, &own, coefficients, 1.0);
        let mut squares = vec![0.0; samples];
        for row in rows {
            let (sample, mm) = self.measured[*row];
            squares[sample] += (mm * left[*row]).powi(2);
        }
        squares
    }
}

/// Every fold by the others: what does not depend on how strong the columns without a name are.
pub(super) struct HeldOut<'w> {
    whitened: &'w Whitened,
    folds: Vec<Fold>,
    samples: usize,
    threads: Threads,
}

struct Fold {
    /// Rows that are held out.
    rows: Vec<usize>,
    /// Products of the others.
    seen: Products,
    remaining: Remaining,
    /// What the base alone leaves.
    alone: Vec<f64>,
}

/// What the columns without a name bring on samples that are held out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gains {
    pub(crate) before_mm: f64,
    pub(crate) after_mm: f64,
    /// The gain in units of its standard deviation.
    sigmas: f64,
}

/// The gain has to be so many times its own standard deviation …
const SURE: f64 = 2.5;
/// … or so many where the samples are beyond doubt: of few samples a few that were far off make the gain of all
/// uncertain …
const SURE_ENOUGH: f64 = 1.5;
/// … and this share of the error at least.
const WORTH: f64 = 0.005;

impl Gains {
    /// Of the squares of samples, by what is one witness of the robot; of so many lengths.
    pub(super) fn of(squares: &[[f64; 2]], witnesses: &[Vec<usize>], lengths: usize) -> Self {
        let rms = |k: usize| {
            let sum: f64 = squares.iter().map(|s| s[k]).sum();
            (sum / lengths.max(1) as f64).sqrt()
        };
        let gained = |i: &usize| squares[*i][0] - squares[*i][1];
        let of_witness = |own: &Vec<usize>| own.iter().map(gained).sum();
        let gains: Vec<f64> = witnesses.iter().map(of_witness).collect();
        let n = gains.len();
        let mean = gains.iter().sum::<f64>() / n as f64;
        let spread = gains.iter().map(|g| (g - mean).powi(2)).sum::<f64>();
        let sigma = (spread / (n * n) as f64).sqrt().max(f64::MIN_POSITIVE);
        Self {
            before_mm: rms(0),
            after_mm: rms(1),
            sigmas: mean / sigma,
        }
    }

    /// Whether they bring something.
    pub(super) fn is_better(&self) -> bool {
        self.after_mm < self.before_mm
    }

    /// Whether they predict, beyond what noise does, where the samples are so much likelier with them, as a logarithm.
    pub(super) fn predict(&self, ln_odds: f64) -> bool {
        let sure = if ln_odds > BEYOND_DOUBT {
            SURE_ENOUGH
        } else {
            SURE
        };
        ln_odds >= LIKELIER && self.after_mm < (1.0 - WORTH) * self.before_mm && self.sigmas >= sure
    }
}

impl<'w> HeldOut<'w> {
    /// `seen`: rows that are held out, and the products of the others; of so many samples.
    pub(super) fn new(
        whitened: &'w Whitened,
        seen: &(dyn Fn(usize) -> (Vec<usize>, Products) + Sync),
        folds: usize,
        samples: usize,
        threads: Threads,
    ) -> Option<Self> {
        let none = DVector::zeros(whitened.white.ncols() - whitened.base - 1);
        let of = |fold: usize| {
            let (rows, seen) = seen(fold);
            Some(Fold {
                alone: whitened.squares(&rows, &seen.with_base(&none)?, samples),
                remaining: Remaining::of(&seen)?,
                seen,
                rows,
            })
        };
        Some(Self {
            whitened,
            folds: threads.all(folds, of)?,
            samples,
            threads,
        })
    }

    /// Squares of each sample without and with the columns without a name, whose coefficients are those that the samples
    /// that are seen give.
    pub(super) fn squares(
        &self,
        coefficients: impl Fn(&Remaining) -> Option<DVector<f64>> + Sync,
    ) -> Option<Vec<[f64; 2]>> {
        let with = |fold: usize| {
            let own = &self.folds[fold];
            let all = own.seen.with_base(&coefficients(&own.remaining)?)?;
            Some(self.whitened.squares(&own.rows, &all, self.samples))
        };
        let with = self.threads.all(self.folds.len(), with)?;
        let mut squares = vec![[0.0; 2]; self.samples];
        for (fold, with) in self.folds.iter().zip(with) {
            for (sum, own) in squares.iter_mut().zip(fold.alone.iter().zip(with)) {
                sum[0] += own.0;
                sum[1] += own.1;
            }
        }
        Some(squares)
    }
}
