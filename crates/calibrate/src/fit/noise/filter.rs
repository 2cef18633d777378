//! The Kalman filter that whitens columns at a cost linear in the number of samples; its equations are in [the parent
//! module](super).

use super::joints::{JointFilter, decayed};
use crate::lanes::TOGETHER;

/// The step of the filter of an axis at one sample.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Step {
    /// The decay of the state since the sample before.
    pub decay: f64,
    /// The gain: the share of the innovation that goes into the state.
    pub gain: f64,
    /// One over the standard deviation of the innovation.
    pub inverse_spread: f64,
}

#[derive(Debug, Clone)]
pub(super) enum Axis {
    White(f64),
    Slow(Vec<Step>),
}

/// Whitens columns, axis by axis.
#[derive(Debug, Clone)]
pub struct Filter {
    pub(super) axes: Vec<Axis>,
    pub(super) samples: usize,
    /// Where rows of a pose share the error of repeatability: this in the place of the axes.
    pub(super) joints: Option<JointFilter>,
}

impl Filter {
    /// Whitens columns of rows, one column after the other, an axis after the other in each.
    pub fn whiten(&self, values: &mut [f64]) {
        if let Some(joints) = &self.joints {
            return joints.whiten(values);
        }
        self.through(values, |steps, columns, at| {
            let mut state = [0.0; TOGETHER];
            for (k, step) in steps.iter().enumerate() {
                for (column, state) in columns.chunks_mut(at.1).zip(&mut state) {
                    let value = &mut column[at.0 + k];
                    let new = *value - step.decay * *state;
                    *state = step.decay * *state + step.gain * new;
                    *value = new * step.inverse_spread;
                }
            }
        });
    }

    /// The transposed of [`whiten`](Self::whiten): `Lᵀz` where that gives `L y`.
    ///
    /// ```text
    /// y_k = z_k/√S_k + K_k λ_k,   λ_(k−1) = a_k (λ_k − y_k),   from the last sample back
    /// ```
    pub fn whiten_transposed(&self, values: &mut [f64]) {
        if let Some(joints) = &self.joints {
            return joints.whiten_transposed(values);
        }
        self.through(values, |steps, columns, at| {
            let mut later = [0.0; TOGETHER];
            for (k, step) in steps.iter().enumerate().rev() {
                for (column, later) in columns.chunks_mut(at.1).zip(&mut later) {
                    let value = &mut column[at.0 + k];
                    *value = *value * step.inverse_spread + step.gain * *later;
                    *later = step.decay * (*later - *value);
                }
            }
        });
    }

    /// Scales what is white, and passes the others on: their steps, some columns, the row of an axis's first sample
    /// and the number of rows.
    fn through(&self, values: &mut [f64], slow: impl Fn(&[Step], &mut [f64], (usize, usize))) {
        let n = self.samples;
        let m = n * self.axes.len();
        if m == 0 {
            return;
        }
        for columns in values.chunks_mut(m * TOGETHER) {
            for (a, axis) in self.axes.iter().enumerate() {
                match axis {
                    Axis::White(scale) => {
                        for column in columns.chunks_mut(m) {
                            for value in &mut column[a * n..(a + 1) * n] {
                                *value *= scale;
                            }
                        }
                    }
                    Axis::Slow(steps) => slow(steps, columns, (a * n, m)),
                }
            }
        }
    }

    /// Logarithm of the determinant of the covariance that the filter takes out.
    pub fn ln_determinant(&self) -> f64 {
        if let Some(joints) = &self.joints {
            return joints.ln_determinant();
        }
        let one = |axis: &Axis| match axis {
            Axis::White(scale) => -2.0 * self.samples as f64 * scale.ln(),
            Axis::Slow(steps) => steps.iter().map(|s| -2.0 * s.inverse_spread.ln()).sum(),
        };
        self.axes.iter().map(one).sum()
    }
}

/// The steps of a filter; see the module.
pub(super) fn steps(times: &[f64], tau: f64, sigma: f64, rms: f64) -> Vec<Step> {
    let mut variance = rms * rms;
    let mut before = f64::NAN;
    let step = |time: &f64| {
        let decay = decayed(*time - before, tau);
        before = *time;
        Step::after(decay, sigma, rms, &mut variance)
    };
    times.iter().map(step).collect()
}

impl Step {
    /// The next step; `variance` is that of the state, before and after.
    #[inline]
    pub(crate) fn after(decay: f64, sigma: f64, rms: f64, variance: &mut f64) -> Self {
        let (s2, white) = (rms * rms, sigma * sigma);
        let predicted = decay * decay * *variance + s2 * (1.0 - decay * decay);
        let spread = predicted + white;
        *variance = predicted * white / spread;
        Self {
            decay,
            gain: predicted / spread,
            inverse_spread: 1.0 / spread.sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use crate::fit::noise::{Noise, Slow};

    /// The whitening of the filter is that of the dense covariance's Cholesky factor.
    #[test]
    fn the_filter_whitens_as_the_dense_covariance_does() {
        let times = [0.0, 2.0, 3.0, 3600.0, 3601.0, 3.0, 9.0];
        let (tau, sigma, rms) = (5.0, 0.3, 0.7);
        // The sixth sample comes after a restart.
        let part = |k: usize| usize::from(k >= 5);
        let covariance = DMatrix::from_fn(7, 7, |i, j| {
            let together = if part(i) == part(j) {
                let apart: f64 = times[i] - times[j];
                rms * rms * (-apart.abs() / tau).exp()
            } else {
                0.0
            };
            together + if i == j { sigma * sigma } else { 0.0 }
        });
        let noise = Noise {
            sigma_mm: [sigma; 3],
            slow: Some(Slow {
                rms_mm: [rms; 3],
                time_constant_s: tau,
            }),
            ..Noise::white(1.0)
        };
        let filter = noise.filter_over(&times, &[0]);
        let y = DVector::from_fn(7, |k, _| (k as f64 + 1.0).sin());
        let mut white = y.clone();
        filter.whiten(white.as_mut_slice());
        let factor = covariance.clone().cholesky().unwrap();
        let expected = factor.l().solve_lower_triangular(&y).unwrap();
        assert!((white - expected).norm() < 1e-9);
        assert!((filter.ln_determinant() - covariance.determinant().ln()).abs() < 1e-9);
        // ⟨Lᵀz, y⟩ = ⟨z, L y⟩
        let z = DVector::from_fn(7, |k, _| (k as f64 * 1.7).cos());
        let mut turned = z.clone();
        filter.whiten_transposed(turned.as_mut_slice());
        let mut white = y.clone();
        filter.whiten(white.as_mut_slice());
        assert!((turned.dot(&y) - z.dot(&white)).abs() < 1e-9);
    }
}
