//! The normal equations of a weighted least-squares problem, summed over blocks of samples:
//! `G = Σ Jᵀ W J`, `g = Σ Jᵀ W r`, `c = Σ rᵀ W r`, r = measured − predicted.
//!
//! Many columns are zero along an axis (a rotation about z moves nothing along z). Where a whole
//! block is zero the products are skipped.

use nalgebra::{DMatrix, DVector};

use crate::effects::block::Block;
use crate::lanes::{LANES, Lanes, Lanes3, TOGETHER};
use crate::observations::RowBlock;
use crate::wide::{Loop, wide};

use super::noise::{Noise, Step, decayed};
use super::problem::Problem;

#[derive(Debug, Clone)]
pub(crate) struct Normal {
    /// `Jᵀ W J`.
    pub gram: DMatrix<f64>,
    /// `Jᵀ W r`.
    pub gradient: DVector<f64>,
    /// `rᵀ W r`.
    pub cost: f64,
    /// `Σ W`, over samples and axes.
    pub weight: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sums {
    /// Everything.
    All,
    /// Everything but the Gram matrix, which costs most.
    Gradient,
}

impl Normal {
    /// Equations of so many coefficients, with nothing summed yet.
    pub(crate) fn new(coefficients: usize) -> Self {
        Self {
            gram: DMatrix::zeros(coefficients, coefficients),
            gradient: DVector::zeros(coefficients),
            cost: 0.0,
            weight: 0.0,
        }
    }

    /// Adds one block of samples.
    pub(crate) fn add(&mut self, problem: &Problem, start: usize, block: &Block, sums: Sums) {
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
        let mut moving = Vec::with_capacity(p);
        // In memory, where the compiler keeps the eight sums of a product in one vector.
        let mut partial = vec![[0.0; 8]; p];
        for axis in 0..3 {
            let weight = problem.axis_weights[axis];
            if weight == 0.0 {
                continue;
            }
            let residual = problem.residual(axis, start, block, &mask);
            self.cost += weight * dot(&residual, &residual);
            self.weight += weight * mask.iter().sum::<f64>();
            moving.clear();
            let moves = |k: &usize| block.columns[*k][axis].iter().any(|v| *v != 0.0);
            moving.extend((0..p).filter(moves));
            for (rank, k) in moving.iter().enumerate() {
                let column = &block.columns[*k][axis];
                // The residual is zero where the mask is.
                self.gradient[*k] += weight * dot(column, &residual);
                if sums == Sums::Gradient {
                    continue;
                }
                let masked: Lanes = std::array::from_fn(|i| column[i] * mask[i]);
                for (j, sums) in moving[..=rank].iter().zip(&mut partial) {
                    *sums = eight_sums(&masked, &block.columns[*j][axis]);
                }
                for (j, sums) in moving[..=rank].iter().zip(&partial) {
                    self.gram[(*k, *j)] += weight * together(sums);
                }
            }
        }
    }

    /// Adds one block of samples with noise that has a slow part: residual and columns go through
    /// its filter first.
    pub(super) fn add_whitened(
        &mut self,
        problem: &Problem,
        start: usize,
        block: &Block,
        sums: Sums,
        whitening: &mut Whitening,
    ) {
        wide(AddingWhitened {
            normal: self,
            problem,
            start,
            block,
            sums,
            whitening,
        });
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    fn add_block_whitened(
        &mut self,
        problem: &Problem,
        start: usize,
        block: &Block,
        sums: Sums,
        whitening: &mut Whitening,
    ) {
        let p = self.gradient.len();
        let mask = problem.mask(start, block.len);
        whitening.advance(problem, start, block.len, &mask);
        for axis in 0..3 {
            if problem.axis_weights[axis] == 0.0 {
                continue;
            }
            let raw = problem.residual(axis, start, block, &mask);
            let (white, residual) = whitening.whiten(axis, &block.columns[..p], &raw, block.len);
            self.cost += dot(residual, residual);
            self.weight += mask.iter().sum::<f64>();
            for k in 0..p {
                self.gradient[k] += dot(&white[k], residual);
                if sums == Sums::Gradient {
                    continue;
                }
                for j in 0..=k {
                    self.gram[(k, j)] += dot(&white[k], &white[j]);
                }
            }
        }
    }

    /// Adds rows of observations of any kind, which are in units of their noise already.
    pub(super) fn add_rows(&mut self, rows: &RowBlock, sums: Sums) {
        let p = self.gradient.len();
        for axis in 0..3 {
            let count = rows.rows[axis].iter().filter(|there| **there).count();
            if count == 0 {
                continue;
            }
            let residual = &rows.left[axis];
            self.cost += dot(residual, residual);
            self.weight += count as f64;
            for k in 0..p {
                let column = &rows.columns[k][axis];
                if column.iter().all(|v| *v == 0.0) {
                    continue;
                }
                self.gradient[k] += dot(column, residual);
                if sums == Sums::Gradient {
                    continue;
                }
                for j in 0..=k {
                    self.gram[(k, j)] += dot(column, &rows.columns[j][axis]);
                }
            }
        }
    }

    /// Mirrors the lower triangle, in which the sums are kept, to the upper.
    pub(crate) fn complete(&mut self) {
        self.gram.fill_upper_triangle_with_lower_triangle();
    }
}

/// The filter of noise with a slow part on its way through the samples (see [`super::noise`]).
pub(super) struct Whitening {
    sigma: [f64; 3],
    slow: [f64; 3],
    tau: f64,
    before: f64,
    /// The last time between two samples, and its decay: most are alike.
    decay_at_step: (f64, f64),
    variance: [f64; 3],
    /// One for each axis and column, the residual last.
    state: [Vec<f64>; 3],
    step: [[Step; LANES]; 3],
    /// The last step of each axis, with its decay and the variance behind it.
    last: [LastStep; 3],
    counts: [bool; LANES],
    /// The last block after the filter, the residual last.
    white: Vec<Lanes>,
}

/// A step with the decay and the variance of which it was made: along equal steps of time both settle.
#[derive(Clone, Copy)]
struct LastStep {
    decay: f64,
    variance: f64,
    step: Step,
    variance_after: f64,
}

impl Whitening {
    /// For so many columns; `None` where the noise is white.
    pub(super) fn new(noise: Option<&Noise>, columns: usize) -> Option<Self> {
        let noise = noise?;
        let slow = noise.slow?;
        let none = LastStep {
            decay: f64::NAN,
            variance: f64::NAN,
            step: Step::default(),
            variance_after: f64::NAN,
        };
        Some(Self {
            sigma: noise.sigma_mm,
            slow: slow.rms_mm,
            tau: slow.time_constant_s,
            before: f64::NAN,
            decay_at_step: (f64::NAN, f64::NAN),
            variance: slow.rms_mm.map(|s| s * s),
            state: std::array::from_fn(|_| vec![0.0; columns + 1]),
            step: [[Step::default(); LANES]; 3],
            last: [none; 3],
            counts: [false; LANES],
            white: vec![[0.0; LANES]; columns + 1],
        })
    }

    /// The steps of the next samples.
    fn advance(&mut self, problem: &Problem, start: usize, len: usize, mask: &Lanes) {
        for i in 0..len {
            self.counts[i] = mask[i] != 0.0;
            if !self.counts[i] {
                continue;
            }
            let time = problem.time(start + i);
            let apart = time - self.before;
            if apart != self.decay_at_step.0 {
                self.decay_at_step = (apart, decayed(apart, self.tau));
            }
            let decay = self.decay_at_step.1;
            self.before = time;
            for axis in 0..3 {
                let (variance, last) = (&mut self.variance[axis], &mut self.last[axis]);
                if decay != last.decay || *variance != last.variance {
                    let mut after = *variance;
                    let step = Step::after(decay, self.sigma[axis], self.slow[axis], &mut after);
                    *last = LastStep {
                        decay,
                        variance: *variance,
                        step,
                        variance_after: after,
                    };
                }
                *variance = last.variance_after;
                self.step[axis][i] = last.step;
            }
        }
    }

    /// Whitens the columns and the residual of a block along one axis.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    fn whiten(
        &mut self,
        axis: usize,
        columns: &[Lanes3],
        residual: &Lanes,
        len: usize,
    ) -> (&[Lanes], &Lanes) {
        let last = columns.len();
        let raw = |k: usize| columns.get(k).map_or(residual, |column| &column[axis]);
        for first in (0..=last).step_by(TOGETHER) {
            // The columns behind the last are those of the residual again, and are not kept.
            let own: [&Lanes; TOGETHER] = std::array::from_fn(|c| raw(first + c));
            let kept = (last + 1 - first).min(TOGETHER);
            let mut state = [0.0; TOGETHER];
            state[..kept].copy_from_slice(&self.state[axis][first..first + kept]);
            let mut white = [[0.0; LANES]; TOGETHER];
            for i in (0..len).filter(|i| self.counts[*i]) {
                let step = &self.step[axis][i];
                for c in 0..TOGETHER {
                    let decayed = step.decay * state[c];
                    let new = own[c][i] - decayed;
                    state[c] = decayed + step.gain * new;
                    white[c][i] = new * step.inverse_spread;
                }
            }
            self.state[axis][first..first + kept].copy_from_slice(&state[..kept]);
            self.white[first..first + kept].copy_from_slice(&white[..kept]);
        }
        let (white, residual) = self.white.split_at(last);
        (white, &residual[0])
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

/// The loop of [`Normal::add_whitened`].
struct AddingWhitened<'a, 'p> {
    normal: &'a mut Normal,
    problem: &'a Problem<'p>,
    start: usize,
    block: &'a Block<'a>,
    sums: Sums,
    whitening: &'a mut Whitening,
}

impl Loop for AddingWhitened<'_, '_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        self.normal.add_block_whitened(
            self.problem,
            self.start,
            self.block,
            self.sums,
            self.whitening,
        );
    }
}

/// Scalar product over the lanes, in eight running sums so that it can be vectorised.
#[inline(always)]
#[allow(clippy::inline_always, reason = "a part of a wide loop")]
pub(crate) fn dot(a: &Lanes, b: &Lanes) -> f64 {
    in_memory(&eight_sums(a, b))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "a part of a wide loop")]
fn eight_sums(a: &Lanes, b: &Lanes) -> [f64; 8] {
    let mut sums = [0.0; 8];
    for i in 0..LANES / 8 {
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += a[8 * i + k] * b[8 * i + k];
        }
    }
    sums
}

/// Not inlined: that the sums have to lie in memory side by side is what makes the compiler keep them in
/// one vector.
#[inline(never)]
fn in_memory(sums: &[f64; 8]) -> f64 {
    together(sums)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "a part of a wide loop")]
fn together(sums: &[f64; 8]) -> f64 {
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]))
}
