//! Fits of a model and shapes to the rows, by Gauss–Newton steps.
//!
//! Most of the cost of a step is its columns and their orthonormal basis. After a step that is small compared with the
//! noise they are kept: their change is a product of that step with the curvature, and the error of the next step is a
//! product with it once more. The number of steps is that with columns that are always recomputed.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::fit::Fit;
use super::memo::Key;
use super::regression::Regression;
use crate::budget;
use crate::diagnosis::candidates::Placed;
use crate::linear::Basis;
use crate::model::Model;

/// Products for each number of a fit's columns besides those of making them orthonormal.
pub(super) const OF_A_FIT: f64 = 150.0;

/// A step whose square is at most this share of the residual sum of squares keeps the columns.
const SMALL: f64 = 1e-5;

impl Regression<'_> {
    /// Fits a model and shapes, starting from their coefficients.
    pub(crate) fn fit(&self, start: &Model, shapes: &[Placed]) -> Fit {
        let key = Key::of_start(start, shapes);
        self.fits
            .of_key(key, || self.fitted(start.clone(), shapes.to_vec()))
    }

    fn fitted(&self, mut model: Model, mut shapes: Vec<Placed>) -> Fit {
        let own = model.coefficient_count();
        let more = (own + shapes.len()).saturating_sub(self.base.coefficient_count());
        let of_a_step = (self.height() * own) as f64 * (OF_A_FIT + 4.0 * (1 + more) as f64);
        let mut place: Option<Arc<Basis>> = None;
        let mut projected = DVector::zeros(self.height());
        let mut rss = 0.0_f64;
        // The square of the last step relative to the residual sum of squares after it.
        let mut last = f64::INFINITY;
        for round in 0..budget::ROUNDS {
            self.work.did(of_a_step);
            let here = place.take().filter(|_| last <= SMALL);
            let (residual, here) = if let Some(here) = here {
                let raw = self.rows.residual(&model);
                (self.whitened_residual(&model, &raw), here)
            } else {
                self.place(&model, &shapes)
            };
            // The shapes are linear: they are solved for again, the model by steps.
            let step = here.solve(&residual);
            projected = here.reject(&residual);
            rss = projected.norm_squared();
            // The part of the residual in the span of the columns is explained by the step, except for the shapes.
            let mut moves = residual - &projected;
            model = model.stepped(&step.as_slice()[..own]);
            let mut first = own;
            for shape in &mut shapes {
                let size = shape.white.ncols();
                shape.coefficients = step.rows(first, size).into_owned();
                moves.gemv(-1.0, &shape.white, &shape.coefficients, 1.0);
                first += size;
            }
            let moved = moves.norm_squared();
            place = Some(here);
            last = moved / rss.max(f64::MIN_POSITIVE);
            // A step of a hundredth of the noise changes nothing to second order.
            if own == 0 || moved <= 1e-10 * self.m().max(1.0) + 1e-8 * rss && round > 0 {
                break;
            }
        }
        let basis =
            place.unwrap_or_else(|| Arc::new(Basis::new(&DMatrix::zeros(self.height(), 0))));
        let ln_evidence = self.ln_evidence(&model, &shapes, rss, basis.rank())
            + self.subset_selection_credit(&model, &basis, rss);
        Fit {
            model,
            shapes,
            residual: projected,
            basis,
            rss,
            ln_evidence,
        }
    }

    /// The residual of the rows, with a basis of all columns.
    fn place(&self, model: &Model, shapes: &[Placed]) -> (DVector<f64>, Arc<Basis>) {
        let (raw, columns) = self.raw(model);
        let (residual, mut all) = self.whitened(model, &raw, columns);
        if !shapes.is_empty() {
            let own = all.ncols();
            let width = own + shapes.iter().map(|s| s.white.ncols()).sum::<usize>();
            let mut numbers = Vec::with_capacity(all.nrows() * width);
            numbers.extend_from_slice(all.as_slice());
            for shape in shapes {
                numbers.extend_from_slice(shape.white.as_slice());
            }
            all = DMatrix::from_vec(all.nrows(), width, numbers);
        }
        (residual, Arc::new(Basis::new(&all)))
    }
}
