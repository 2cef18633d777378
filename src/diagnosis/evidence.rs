//! The evidence: residuals and columns of the samples that count, one row for each measured
//! coordinate, whitened so that every row has noise of about one.
//!
//! ```text
//! w_i = (e_i/σ_axis − ρ^g e_{i−1}/σ_axis) / √(1 − ρ^{2g}),   g the step from the sample before
//! ```
//!
//! Rows go axis by axis, within an axis in measuring order. σ is the instrument's where it names
//! one for each axis; otherwise one for all, unless the residuals of a rich fit show that the
//! axes differ. ρ, the correlation from one sample to the next, is the one that makes that rich
//! fit likeliest (restricted likelihood, Patterson & Thompson 1971): a rich fit, so that an effect
//! in an ordered sweep is not taken for correlation; restricted, so that what the fit swallows is
//! not held against ρ.

use nalgebra::{DMatrix, DVector};

use crate::effects::Inputs;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::sessions::Sigma;

use super::linear::{Basis, small_cholesky};

/// Which samples and axes have rows.
#[derive(Debug, Clone)]
pub struct Rows {
    /// Samples, in measuring order, as indices into the problem.
    pub samples: Vec<usize>,
    /// Measured axes.
    pub axes: Vec<usize>,
    /// Those samples as the effects take them.
    pub inputs: Inputs<'static>,
    measured_mm: Vec<Vec<f64>>,
}

impl Rows {
    /// The samples of a problem that count.
    pub fn of(problem: &Problem) -> Self {
        let samples: Vec<usize> = (0..problem.used.len())
            .filter(|i| problem.used[*i])
            .collect();
        let axes: Vec<usize> = (0..3).filter(|a| problem.axis_weights[*a] > 0.0).collect();
        let all = &problem.session.samples;
        let measured = |axis: &usize| {
            let column = match axis {
                0 => &all.x_mm[..],
                1 => &all.y_mm[..],
                _ => all.z_mm.as_deref().unwrap_or(&[]),
            };
            samples.iter().map(|i| column[*i]).collect()
        };
        Self {
            measured_mm: axes.iter().map(measured).collect(),
            inputs: problem.inputs.select(&samples),
            samples,
            axes,
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.samples.len() * self.axes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Residuals (measured − predicted) and the columns of every coefficient, mm.
    pub fn extract(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.samples.len();
        let mut residual = DVector::zeros(self.len());
        let mut columns = DMatrix::zeros(self.len(), model.coefficient_count());
        model.visit(&self.inputs, true, |start, block| {
            for (a, axis) in self.axes.iter().enumerate() {
                let row = a * n + start;
                for i in 0..block.len {
                    residual[row + i] = self.measured_mm[a][start + i] - block.point[*axis][i];
                }
                for (k, column) in block.columns.iter().enumerate() {
                    let mut own = columns.column_mut(k);
                    own.as_mut_slice()[row..row + block.len]
                        .copy_from_slice(&column[*axis][..block.len]);
                }
            }
        });
        (residual, columns)
    }

    /// Points that the model predicts, in the order of the samples.
    pub fn points(&self, model: &Model) -> Vec<[f64; 3]> {
        let predicted = model.predict(&self.inputs);
        (0..self.samples.len()).map(|i| predicted.get(i)).collect()
    }

    /// A column of one value for each sample along one axis.
    pub fn column(&self, value: impl Fn(usize, usize) -> f64) -> DVector<f64> {
        let n = self.samples.len();
        DVector::from_fn(self.len(), |row, _| value(row % n, self.axes[row / n]))
    }
}

/// What the noise looks like.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// Standard deviation along x, y, z, mm.
    pub sigma_mm: [f64; 3],
    /// Correlation from one sample to the next.
    pub rho: f64,
    /// Whether the axes were found, or said, to differ.
    pub unequal: bool,
    /// How much likelier ρ makes the residuals, twice the logarithm.
    pub rho_evidence: f64,
}

/// A smaller ρ than this, or a gain in likelihood below [`RHO_EVIDENCE`], is taken for none.
const LEAST_RHO: f64 = 0.05;
const RHO_EVIDENCE: f64 = 3.0;
/// Twice the logarithm of a likelihood ratio (two degrees of freedom) from which on the axes differ.
const UNEQUAL_EVIDENCE: f64 = 16.0;
/// Ratios beyond this are something that the model lacks, not noise.
const MOST_UNEQUAL: f64 = 10.0;
const FEWEST_SAMPLES: usize = 20;

impl Noise {
    /// From a raw residual and the raw columns of a rich fit.
    pub fn estimate(
        problem: &Problem,
        rows: &Rows,
        residual: &DVector<f64>,
        rich: &DMatrix<f64>,
    ) -> Self {
        let mut noise = Self {
            sigma_mm: [1.0; 3],
            rho: 0.0,
            unequal: false,
            rho_evidence: 0.0,
        };
        // The same span, well conditioned, whatever ρ and σ are.
        let rich = &Basis::new(rich).q;
        if let Some(Sigma::PerAxis(sigma)) = problem.session.instrument.sigma_mm {
            noise.sigma_mm = sigma;
            noise.unequal = true;
        }
        let enough = rows.samples.len() >= FEWEST_SAMPLES;
        if enough && !noise.unequal {
            noise.balance_axes(rows, residual, rich);
        }
        if enough {
            noise.estimate_rho(rows, residual, rich);
        }
        let (s2, _) = noise.restricted(rows, residual, rich);
        let scale = s2.sqrt().max(SMALLEST_SIGMA_MM);
        noise.sigma_mm = noise.sigma_mm.map(|s| s * scale);
        noise
    }

    fn balance_axes(&mut self, rows: &Rows, residual: &DVector<f64>, rich: &DMatrix<f64>) {
        for _ in 0..2 {
            let basis = Basis::new(&self.whitened(rows, rich));
            let left = basis.reject(&self.whitened_vector(rows, residual));
            let n = rows.samples.len();
            let of_axis = |a: usize| {
                let own = a * n..(a + 1) * n;
                let freedom: f64 = own.clone().map(|row| 1.0 - basis.leverage(row)).sum();
                let sum: f64 = own.map(|row| left[row] * left[row]).sum();
                (sum / freedom.max(1.0), freedom)
            };
            let spread: Vec<(f64, f64)> = (0..rows.axes.len()).map(of_axis).collect();
            let freedom: f64 = spread.iter().map(|s| s.1).sum();
            let pooled = spread.iter().map(|s| s.0 * s.1).sum::<f64>() / freedom;
            if pooled.sqrt() < SMALLEST_SIGMA_MM {
                return;
            }
            let ratio = |s: f64| (s / pooled).max(1e-6);
            let evidence: f64 = spread.iter().map(|s| -s.1 * ratio(s.0).ln()).sum();
            if !self.unequal && evidence < UNEQUAL_EVIDENCE {
                return;
            }
            self.unequal = true;
            for (axis, s) in rows.axes.iter().zip(&spread) {
                self.sigma_mm[*axis] *= ratio(s.0).sqrt();
            }
            let largest = self.sigma_mm.iter().copied().fold(0.0, f64::max);
            self.sigma_mm = self.sigma_mm.map(|s| s.max(largest / MOST_UNEQUAL));
        }
    }

    fn estimate_rho(&mut self, rows: &Rows, residual: &DVector<f64>, rich: &DMatrix<f64>) {
        let at = |rho: f64, me: &Self| {
            let trial = Self { rho, ..me.clone() };
            trial.restricted(rows, residual, rich).1
        };
        let zero = at(0.0, self);
        let (mut best, mut likelihood) = (0.0, zero);
        for step in [0.15, 0.05] {
            let centre = best;
            for k in -3..=6_i32 {
                let rho = centre + step * f64::from(k);
                if !(0.0..=0.96).contains(&rho) || (k == 0 && step < 0.1) {
                    continue;
                }
                let value = at(rho, self);
                if value > likelihood {
                    (best, likelihood) = (rho, value);
                }
            }
            if best == 0.0 && step > 0.1 {
                // A first look at a small ρ decides whether to look closer.
                break;
            }
        }
        self.rho_evidence = 2.0 * (likelihood - zero);
        if best >= LEAST_RHO && self.rho_evidence > RHO_EVIDENCE {
            self.rho = best;
        }
    }

    /// Variance that is left, and the restricted log-likelihood, up to a constant: from the
    /// Cholesky factor of `[A r]ᵀ [A r]`, whose last pivot is what is left of the residual.
    fn restricted(&self, rows: &Rows, residual: &DVector<f64>, rich: &DMatrix<f64>) -> (f64, f64) {
        let p = rich.ncols();
        let mut all = rich.clone().insert_column(p, 0.0);
        all.set_column(p, residual);
        let white = self.whitened(rows, &all);
        let gram = white.transpose() * &white;
        let k = p + 1;
        let mut factor: Vec<f64> = (0..k * k).map(|x| gram[(x / k, x % k)]).collect();
        small_cholesky(&mut factor, k, &vec![0.0; k]);
        let ln_determinant: f64 = (0..p)
            .map(|i| 2.0 * factor[i * k + i].max(f64::MIN_POSITIVE).ln())
            .sum();
        let freedom = (rows.len() as f64 - p as f64).max(1.0);
        let s2 = factor[k * k - 1].powi(2) / freedom;
        let log = s2.max(SMALLEST_SIGMA_MM * SMALLEST_SIGMA_MM).ln();
        let likelihood =
            -0.5 * (freedom * log + ln_determinant + self.ln_determinant_of_correlation(rows));
        (s2, likelihood)
    }

    fn ln_determinant_of_correlation(&self, rows: &Rows) -> f64 {
        if self.rho == 0.0 {
            return 0.0;
        }
        let one: f64 = (1..rows.samples.len())
            .map(|k| (1.0 - self.carry(rows, k).powi(2)).ln())
            .sum();
        one * rows.axes.len() as f64
    }

    /// ρ^g between the sample at `k` and the one before it.
    fn carry(&self, rows: &Rows, k: usize) -> f64 {
        if self.rho == 0.0 {
            return 0.0;
        }
        let gap = rows.samples[k] - rows.samples[k - 1];
        self.rho.powi(i32::try_from(gap).unwrap_or(i32::MAX))
    }

    fn whiten_slice(&self, rows: &Rows, values: &mut [f64]) {
        let n = rows.samples.len();
        for (a, axis) in rows.axes.iter().enumerate() {
            let own = &mut values[a * n..(a + 1) * n];
            let scale = 1.0 / self.sigma_mm[*axis];
            for value in own.iter_mut() {
                *value *= scale;
            }
            if self.rho == 0.0 {
                continue;
            }
            for k in (1..n).rev() {
                let carry = self.carry(rows, k);
                own[k] = (own[k] - carry * own[k - 1]) / (1.0 - carry * carry).sqrt();
            }
        }
    }

    /// Whitened columns.
    pub fn whitened(&self, rows: &Rows, raw: &DMatrix<f64>) -> DMatrix<f64> {
        let mut white = raw.clone();
        let m = rows.len();
        if m > 0 {
            for column in white.as_mut_slice().chunks_mut(m) {
                self.whiten_slice(rows, column);
            }
        }
        white
    }

    /// A whitened vector.
    pub fn whitened_vector(&self, rows: &Rows, raw: &DVector<f64>) -> DVector<f64> {
        let mut white = raw.clone();
        self.whiten_slice(rows, white.as_mut_slice());
        white
    }
}

/// Below this noise is rounding, mm.
pub const SMALLEST_SIGMA_MM: f64 = 1e-6;
