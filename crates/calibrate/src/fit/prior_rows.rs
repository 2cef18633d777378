//! Prior knowledge among the normal equations.

use super::regression::SIZE;
use crate::model::Model;

use super::normal::Normal;
use super::priors::Priors;

impl Priors {
    /// Adds the rows of the priors to the normal equations of the samples.
    pub(super) fn add(&self, model: &Model, normal: &mut Normal) {
        self.add_size(model, normal);
        if !self.weak && self.targets_mm.is_none() {
            return;
        }
        let mut first = 0;
        for term in model.terms() {
            for (k, value) in term.coefficients.iter().enumerate() {
                let free = !term.held.contains(k);
                if let (true, Some(sigma)) = (free, self.sigma(model, term, k)) {
                    let weight = self.variance / (sigma * sigma);
                    normal.gram[(first + k, first + k)] += weight;
                    normal.gradient[first + k] -= weight * value;
                    normal.cost += weight * value * value;
                }
            }
            first += term.coefficients.len();
        }
    }

    /// The row that holds the size.
    pub(super) fn add_size(&self, model: &Model, normal: &mut Normal) {
        if self.size.is_empty() {
            return;
        }
        let row = self.size_row(model);
        let coefficients = model.coefficients();
        let weight = self.variance / (SIZE * SIZE);
        let size: f64 = row.iter().zip(&coefficients).map(|(w, x)| w * x).sum();
        for (i, a) in row.iter().enumerate().filter(|own| *own.1 != 0.0) {
            normal.gradient[i] -= weight * size * a;
            for (j, b) in row.iter().enumerate() {
                normal.gram[(i, j)] += weight * a * b;
            }
        }
        normal.cost += weight * size * size;
    }
}
