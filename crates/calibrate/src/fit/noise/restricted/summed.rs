//! The inputs and results of the restricted likelihood of a noise.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::fit::noise::{Noise, Slow};

/// White part, slow part in units of it.
#[derive(Clone, Copy)]
pub(in crate::fit::noise) struct NoiseShape {
    pub(in crate::fit::noise) tau: f64,
    /// Variances of the slow part along the axes.
    pub(in crate::fit::noise) ratio: [f64; 3],
    /// Standard deviations of the white part.
    pub(in crate::fit::noise) sigma: [f64; 3],
    /// The error of repeatability.
    pub(in crate::fit::noise) joints_rad: f64,
}

impl NoiseShape {
    /// The noise of this shape.
    pub(super) fn noise(self) -> Noise {
        let rms = |axis: usize| self.ratio[axis].sqrt() * self.sigma[axis];
        Noise {
            sigma_mm: self.sigma,
            slow: self.ratio.iter().any(|r| *r > 0.0).then(|| Slow {
                rms_mm: [rms(0), rms(1), rms(2)],
                time_constant_s: self.tau,
            }),
            joints_rad: self.joints_rad,
            ..Noise::white(1.0)
        }
    }

    pub(in crate::fit::noise) fn white(sigma: [f64; 3]) -> Self {
        Self {
            tau: 0.0,
            ratio: [0.0; 3],
            sigma,
            joints_rad: 0.0,
        }
    }
}

/// Products of whitened columns and the residual, which is the last, and the logarithm of what the noise and the
/// columns that were taken out before multiply the likelihood by, times −2.
pub(super) struct Summed {
    pub(super) gram: DMatrix<f64>,
    pub(super) ln_determinant: f64,
}

/// Factor of the columns' products, the step to the residual, and the residual sum of squares.
pub(super) struct Solved {
    pub(super) factor: Cholesky<f64, nalgebra::Dyn>,
    pub(super) step: DVector<f64>,
    pub(super) rss: f64,
}

impl Summed {
    pub(super) fn solved(&self) -> Option<Solved> {
        let p = self.gram.ncols() - 1;
        let inner = self.gram.view((0, 0), (p, p)).into_owned();
        let pull = self.gram.view((0, p), (p, 1)).column(0).into_owned();
        let factor = inner.cholesky()?;
        let step = factor.solve(&pull);
        let rss = (self.gram[(p, p)] - step.dot(&pull)).max(0.0);
        Some(Solved { factor, step, rss })
    }
}

impl Solved {
    pub(super) fn ln_determinant(&self) -> f64 {
        let l = self.factor.l_dirty();
        (0..l.ncols()).map(|k| 2.0 * l[(k, k)].ln()).sum()
    }
}
