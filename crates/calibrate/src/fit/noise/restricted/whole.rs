//! All columns through the filter.

use std::cell::RefCell;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::budget;
use crate::fit::noise::{Noise, Slow};
use crate::fit::regression::Rows;
use crate::linear::{Basis, gram};

use super::summed::{NoiseShape, Summed};

/// Products of whitened columns along one axis.
struct AxisSums {
    gram: DMatrix<f64>,
    ln_determinant: f64,
}

pub(super) struct Whole {
    /// For each axis its rows of columns and residual.
    parts: Vec<DMatrix<f64>>,
    p: usize,
    /// The last sums: neighbouring noises differ along one axis only, and a second search for the slow
    /// part asks for those of the first.
    evaluated: RefCell<Vec<Known>>,
}

/// Axis, time constant and variance, and their sums.
type Known = ((usize, u64, u64), Rc<AxisSums>);

impl Whole {
    pub(super) fn new(rows: &Rows, residual: &DVector<f64>, columns: &DMatrix<f64>) -> Self {
        // The same span, well conditioned, whatever the noise is.
        let basis = Basis::new(columns).q;
        let p = basis.ncols();
        let mut all = basis.insert_column(p, 0.0);
        all.set_column(p, residual);
        let n = rows.samples.len();
        let part = |a: usize| all.rows(a * n, n).into_owned();
        Self {
            parts: (0..rows.axes.len()).map(part).collect(),
            p,
            evaluated: RefCell::new(Vec::new()),
        }
    }

    /// Columns and residual along all axes.
    pub(super) fn together(&self) -> DMatrix<f64> {
        let n = self.parts.first().map_or(0, DMatrix::nrows);
        let mut all = DMatrix::zeros(self.parts.len() * n, self.p + 1);
        for (a, part) in self.parts.iter().enumerate() {
            all.rows_mut(a * n, n).copy_from(part);
        }
        all
    }

    pub(super) fn rank(&self) -> usize {
        self.p
    }

    /// Sums along every axis, with a white part of 1.
    fn sums(&self, rows: &Rows, shape: NoiseShape) -> Vec<Rc<AxisSums>> {
        let parts = self.parts.iter().zip(&rows.axes).enumerate();
        parts
            .map(|(at, (part, axis))| {
                let ratio = shape.ratio[*axis];
                let tau = if ratio > 0.0 { shape.tau } else { 0.0 };
                let same = |known: &&Known| known.0 == (at, tau.to_bits(), ratio.to_bits());
                if let Some((_, sums)) = self.evaluated.borrow().iter().find(same) {
                    return Rc::clone(sums);
                }
                let sums = Rc::new(sums_along(rows, *axis, part, tau, ratio));
                let mut known = self.evaluated.borrow_mut();
                let full = (known.len() + 1) * sums.gram.len() > budget::NUMBERS_KEPT;
                if full && !known.is_empty() {
                    known.remove(0);
                }
                let key = (at, tau.to_bits(), ratio.to_bits());
                known.push((key, Rc::clone(&sums)));
                sums
            })
            .collect()
    }

    pub(super) fn summed(&self, rows: &Rows, shape: NoiseShape) -> Summed {
        self.added(rows, &self.sums(rows, shape), shape)
    }

    fn added(&self, rows: &Rows, sums: &[Rc<AxisSums>], shape: NoiseShape) -> Summed {
        let mut gram = DMatrix::zeros(self.p + 1, self.p + 1);
        for (own, axis) in sums.iter().zip(&rows.axes) {
            gram += &own.gram / shape.sigma[*axis].powi(2);
        }
        let n = rows.samples.len() as f64;
        let ln_determinant = sums
            .iter()
            .zip(&rows.axes)
            .map(|(own, axis)| own.ln_determinant + 2.0 * n * shape.sigma[*axis].ln())
            .sum();
        Summed {
            gram,
            ln_determinant,
        }
    }

    /// Variance along each axis in units of σ², with its degrees of freedom.
    pub(super) fn spread(&self, rows: &Rows, shape: NoiseShape) -> Option<Vec<(f64, f64)>> {
        let p = self.p;
        let n = rows.samples.len() as f64;
        let sums = self.sums(rows, shape);
        let solved = self.added(rows, &sums, shape).solved()?;
        let step = &solved.step;
        let inverse = solved.factor.inverse();
        let one = |(own, axis): (&Rc<AxisSums>, &usize)| {
            let weight = 1.0 / shape.sigma[*axis].powi(2);
            let inner = own.gram.view((0, 0), (p, p)).into_owned();
            let pull = own.gram.view((0, p), (p, 1)).column(0).into_owned();
            let square = own.gram[(p, p)] - 2.0 * step.dot(&pull) + step.dot(&(&inner * step));
            // Both are symmetric: the trace of their product.
            let spent = inverse.dot(&inner) * weight;
            let freedom = (n - spent).max(1.0);
            (square.max(0.0) * weight / freedom, freedom)
        };
        Some(sums.iter().zip(&rows.axes).map(one).collect())
    }
}

fn sums_along(rows: &Rows, axis: usize, part: &DMatrix<f64>, tau: f64, ratio: f64) -> AxisSums {
    let mut noise = Noise::white(1.0);
    if ratio > 0.0 {
        noise.slow = Some(Slow {
            rms_mm: [ratio.sqrt(); 3],
            time_constant_s: tau,
        });
    }
    let filter = noise.filter_over(&rows.times, &[axis]);
    let mut white = part.clone();
    filter.whiten(white.as_mut_slice());
    AxisSums {
        gram: gram(&white),
        ln_determinant: filter.ln_determinant(),
    }
}
