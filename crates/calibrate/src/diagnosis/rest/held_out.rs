//! Held-out residuals of a base and of columns without a name.

use nalgebra::{DMatrix, DVector};

use super::groups::Remaining;
use super::products::Products;
use crate::side_by_side::Threads;

/// Rows of the base's columns, of those without a name and of the residual, in this order.
#[derive(Clone)]
pub(super) struct Whitened {
    pub(super) white: DMatrix<f64>,
    /// As measured, where whitening is more than a factor.
    pub(super) raw: Option<DMatrix<f64>>,
    /// Columns of the base.
    pub(super) base: usize,
    /// Of each row that was measured its sample, and one unit of it in mm.
    pub(super) measured: Vec<(usize, f64)>,
    /// The square of the rounding in a row.
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

    /// The squares of the residuals of rows, mm², added up for each sample.
    pub(super) fn squares(
        &self,
        rows: &[usize],
        coefficients: &DVector<f64>,
        samples: usize,
    ) -> Vec<f64> {
        let all = self.raw.as_ref().unwrap_or(&self.white);
        let mut residuals = all.column(all.ncols() - 1).into_owned();
        let own = all.columns(0, coefficients.len());
        residuals.gemv(-1.0, &own, coefficients, 1.0);
        let mut squares = vec![0.0; samples];
        for row in rows {
            let (sample, mm) = self.measured[*row];
            squares[sample] += (mm * residuals[*row]).powi(2);
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
    /// The squares of the residuals of the base alone.
    alone: Vec<f64>,
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

    /// Squares of each sample without and with the columns without a name, whose coefficients are fitted to the
    /// samples that are not held out.
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
