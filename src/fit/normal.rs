//! The normal equations of a weighted least-squares problem, summed over blocks of samples:
//! `G = Σ Jᵀ W J`, `g = Σ Jᵀ W r`, `c = Σ rᵀ W r`, r = measured − predicted.
//!
//! Many columns are zero along an axis (a rotation about z moves nothing along z). Where a whole
//! block is zero the products are skipped.

use nalgebra::{DMatrix, DVector};

use crate::effects::block::Block;
use crate::lanes::{LANES, Lanes};
use crate::wide::{Loop, wide};

use super::problem::Problem;

/// See the module.
#[derive(Debug, Clone)]
pub struct Normal {
    /// `Jᵀ W J`.
    pub gram: DMatrix<f64>,
    /// `Jᵀ W r`.
    pub gradient: DVector<f64>,
    /// `rᵀ W r`.
    pub cost: f64,
    /// `Σ W`, over samples and axes.
    pub weight: f64,
}

/// What to sum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sums {
    /// Everything.
    All,
    /// Everything but the Gram matrix, which costs most.
    Gradient,
}

impl Normal {
    /// Equations of so many coefficients, with nothing summed yet.
    pub fn new(coefficients: usize) -> Self {
        Self {
            gram: DMatrix::zeros(coefficients, coefficients),
            gradient: DVector::zeros(coefficients),
            cost: 0.0,
            weight: 0.0,
        }
    }

    /// Adds one block of samples.
    pub fn add(&mut self, problem: &Problem, start: usize, block: &Block, sums: Sums) {
        wide(Adding {
            normal: self,
            problem,
            start,
            block,
            sums,
        });
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    fn add_block(&mut self, problem: &Problem, start: usize, block: &Block, sums: Sums) {
        let p = self.gradient.len();
        let mask = problem.mask(start, block.len);
        for axis in 0..3 {
            let weight = problem.axis_weights[axis];
            if weight == 0.0 {
                continue;
            }
            let residual = problem.residual(axis, start, block, &mask);
            self.cost += weight * dot(&residual, &residual);
            self.weight += weight * mask.iter().sum::<f64>();
            for k in 0..p {
                let column = &block.columns[k][axis];
                if column.iter().all(|v| *v == 0.0) {
                    continue;
                }
                // The residual is zero where the mask is.
                self.gradient[k] += weight * dot(column, &residual);
                if sums == Sums::Gradient {
                    continue;
                }
                let masked: Lanes = std::array::from_fn(|i| column[i] * mask[i]);
                for j in 0..=k {
                    self.gram[(k, j)] += weight * dot(&masked, &block.columns[j][axis]);
                }
            }
        }
    }

    /// Mirrors the lower triangle, in which the sums are kept, to the upper.
    pub fn complete(&mut self) {
        self.gram.fill_upper_triangle_with_lower_triangle();
    }
}

/// The loop of [`Normal::add`].
struct Adding<'a, 'p> {
    normal: &'a mut Normal,
    problem: &'a Problem<'p>,
    start: usize,
    block: &'a Block<'a>,
    sums: Sums,
}

impl Loop for Adding<'_, '_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        self.normal
            .add_block(self.problem, self.start, self.block, self.sums);
    }
}

/// Scalar product over the lanes, in eight running sums so that it can be vectorised.
#[inline(always)]
#[allow(clippy::inline_always, reason = "a part of a wide loop")]
pub fn dot(a: &Lanes, b: &Lanes) -> f64 {
    let mut sums = [0.0; 8];
    for i in 0..LANES / 8 {
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += a[8 * i + k] * b[8 * i + k];
        }
    }
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]))
}
