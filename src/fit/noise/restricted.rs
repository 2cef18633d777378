//! The restricted likelihood of a noise beside the columns of a fit (Patterson & Thompson 1971).

use crate::fit::regression::Rows;
use crate::linear::{Basis, cholesky, gram};
use nalgebra::{Cholesky, DMatrix, DVector};
use std::cell::RefCell;
use std::rc::Rc;

use super::{Noise, Slow};

/// Products of whitened columns along one axis.
pub(super) struct AxisSums {
    gram: DMatrix<f64>,
    ln_determinant: f64,
}

/// The restricted likelihood of noise beside the columns of a fit.
pub(super) struct Restricted<'r> {
    rows: &'r Rows<'r>,
    pub(super) axes: Vec<usize>,
    /// For each axis its rows of columns and residual.
    parts: Vec<DMatrix<f64>>,
    p: usize,
    /// The last sums: neighbouring noises differ along one axis only, and a second search for the slow
    /// part asks for those of the first.
    evaluated: RefCell<Vec<Known>>,
}

/// Axis, time constant and variance, and their sums.
type Known = ((usize, u64, u64), Rc<AxisSums>);

/// Numbers of the sums that are kept (32 MiB).
const MOST_KNOWN: usize = 4 << 20;

impl<'r> Restricted<'r> {
    pub(super) fn new(rows: &'r Rows<'r>, residual: &DVector<f64>, columns: &DMatrix<f64>) -> Self {
        // The same span, well conditioned, whatever the noise is.
        let basis = Basis::new(columns).q;
        let p = basis.ncols();
        let mut all = basis.insert_column(p, 0.0);
        all.set_column(p, residual);
        let n = rows.samples.len();
        let part = |a: usize| all.rows(a * n, n).into_owned();
        Self {
            rows,
            axes: rows.axes.clone(),
            parts: (0..rows.axes.len()).map(part).collect(),
            p,
            evaluated: RefCell::new(Vec::new()),
        }
    }

    /// Shortest and longest time constant that the samples can tell. What does not come back
    /// within the session cannot be told from an offset and a drift of the frame, which are effects.
    pub(super) fn times(&self) -> (f64, f64) {
        let times = &self.rows.times;
        let mut apart: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        apart.retain(|d| *d > 0.0);
        apart.sort_by(f64::total_cmp);
        let Some(middle) = apart.get(apart.len() / 2).copied() else {
            return (1.0, 1.0);
        };
        let total: f64 = apart.iter().sum();
        (middle, total.max(middle))
    }

    /// White part 1, slow part of these variances.
    pub(super) fn sums(&self, tau: f64, ratio: [f64; 3]) -> Vec<Rc<AxisSums>> {
        let parts = self.parts.iter().zip(&self.axes).enumerate();
        parts
            .map(|(at, (part, axis))| {
                let ratio = ratio[*axis];
                let tau = if ratio > 0.0 { tau } else { 0.0 };
                let same = |known: &&Known| known.0 == (at, tau.to_bits(), ratio.to_bits());
                if let Some((_, sums)) = self.evaluated.borrow().iter().find(same) {
                    return Rc::clone(sums);
                }
                let sums = Rc::new(self.sums_along(*axis, part, tau, ratio));
                let mut known = self.evaluated.borrow_mut();
                let full = (known.len() + 1) * sums.gram.len() > MOST_KNOWN;
                if full && !known.is_empty() {
                    known.remove(0);
                }
                let key = (at, tau.to_bits(), ratio.to_bits());
                known.push((key, Rc::clone(&sums)));
                sums
            })
            .collect()
    }

    fn sums_along(&self, axis: usize, part: &DMatrix<f64>, tau: f64, ratio: f64) -> AxisSums {
        let mut noise = Noise::white(1.0);
        if ratio > 0.0 {
            noise.slow = Some(Slow {
                rms_mm: [ratio.sqrt(); 3],
                time_constant_s: tau,
            });
        }
        let filter = noise.filter_over(&self.rows.times, &[axis]);
        let mut white = part.clone();
        filter.whiten(white.as_mut_slice());
        AxisSums {
            gram: gram(&white),
            ln_determinant: filter.ln_determinant(),
        }
    }

    /// Gram matrix of all axes, its factor, and the step to the residual.
    fn solved(
        &self,
        sums: &[Rc<AxisSums>],
        sigma: &[f64; 3],
    ) -> Option<(Cholesky<f64, nalgebra::Dyn>, DVector<f64>, f64)> {
        let p = self.p;
        let mut total = DMatrix::zeros(p + 1, p + 1);
        for (own, axis) in sums.iter().zip(&self.axes) {
            total += &own.gram / sigma[*axis].powi(2);
        }
        let inner = total.view((0, 0), (p, p)).into_owned();
        let pull = total.view((0, p), (p, 1)).column(0).into_owned();
        let factor = cholesky(inner)?;
        let step = factor.solve(&pull);
        let left = total[(p, p)] - step.dot(&pull);
        Some((factor, step, left.max(0.0)))
    }

    fn freedom(&self) -> f64 {
        ((self.rows.len() as f64) - self.p as f64).max(1.0)
    }

    /// Standard deviation that is left, in units of σ.
    pub(super) fn scale(&self, sums: &[Rc<AxisSums>], sigma: &[f64; 3]) -> f64 {
        let solved = self.solved(sums, sigma);
        solved.map_or(0.0, |(_, _, left)| (left / self.freedom()).sqrt())
    }

    /// Variance along each axis in units of σ², with its degrees of freedom.
    pub(super) fn spread(&self, sums: &[Rc<AxisSums>], sigma: &[f64; 3]) -> Vec<(f64, f64)> {
        let p = self.p;
        let n = self.rows.samples.len() as f64;
        let Some((factor, step, _)) = self.solved(sums, sigma) else {
            return vec![(1.0, n); self.axes.len()];
        };
        let inverse = factor.inverse();
        let one = |(own, axis): (&Rc<AxisSums>, &usize)| {
            let weight = 1.0 / sigma[*axis].powi(2);
            let inner = own.gram.view((0, 0), (p, p)).into_owned();
            let pull = own.gram.view((0, p), (p, 1)).column(0).into_owned();
            let square = own.gram[(p, p)] - 2.0 * step.dot(&pull) + step.dot(&(&inner * &step));
            // Both are symmetric: the trace of their product.
            let spent = inverse.dot(&inner) * weight;
            let freedom = (n - spent).max(1.0);
            (square.max(0.0) * weight / freedom, freedom)
        };
        sums.iter().zip(&self.axes).map(one).collect()
    }

    /// Logarithm, up to a constant, with the common size profiled out.
    pub(super) fn likelihood(&self, sums: &[Rc<AxisSums>], sigma: &[f64; 3]) -> f64 {
        let Some((factor, _, left)) = self.solved(sums, sigma) else {
            return f64::NEG_INFINITY;
        };
        let freedom = self.freedom();
        let variance = (left / freedom).max(SMALLEST_SIGMA_MM * SMALLEST_SIGMA_MM);
        let l = factor.l_dirty();
        let inner: f64 = (0..self.p).map(|k| 2.0 * l[(k, k)].ln()).sum();
        let n = self.rows.samples.len() as f64;
        let outer: f64 = sums
            .iter()
            .zip(&self.axes)
            .map(|(own, axis)| own.ln_determinant + 2.0 * n * sigma[*axis].ln())
            .sum();
        -0.5 * (freedom * variance.ln() + inner + outer)
    }
}

/// Below this noise is rounding, mm.
pub(crate) const SMALLEST_SIGMA_MM: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::sweep;
    use crate::fit::problem::Problem;

    const TAU: f64 = 40.0;
    const RATIO: [f64; 3] = [2.0, 0.0, 0.5];
    const SIGMA: [f64; 3] = [0.05, 0.02, 0.11];

    fn ln_determinant(a: &DMatrix<f64>) -> f64 {
        let root = a.clone().cholesky().unwrap().l();
        2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>()
    }

    /// What it knows of the noise beside three columns in samples at irregular times, and the same from dense
    /// matrices: ν, V⁻¹, P = V⁻¹ − V⁻¹X(XᵀV⁻¹X)⁻¹XᵀV⁻¹, the restricted likelihood and P y.
    fn compared(look: impl Fn(&Restricted, &DMatrix<f64>, &DMatrix<f64>, &DVector<f64>, f64)) {
        let session = sweep([0.0, 0.0, 1.0]);
        let problem = Problem::new(&session, JointValues::Commanded);
        let rows = Rows::of(&problem);
        let n = rows.samples.len();
        let wild = |i: usize, j: usize| (((i + 3) * (2 * j + 5)) as f64 * 0.37).sin();
        let columns = DMatrix::from_fn(3 * n, 3, wild);
        let residual = DVector::from_fn(3 * n, |i, _| 0.1 * wild(i, 9));
        let restricted = Restricted::new(&rows, &residual, &columns);
        let covariance = DMatrix::from_fn(3 * n, 3 * n, |i, j| {
            let (axis, apart) = (i / n, rows.times[i % n] - rows.times[j % n]);
            let white = f64::from(u8::from(i == j));
            let slow = RATIO[axis] * (-apart.abs() / TAU).exp();
            f64::from(u8::from(axis == j / n)) * SIGMA[axis].powi(2) * (white + slow)
        });
        let inverse = covariance.clone().try_inverse().unwrap();
        let x = columns.qr().q();
        let carried = &inverse * &x;
        let information = x.transpose() * &carried;
        let known = information.clone().try_inverse().unwrap();
        let projection = &inverse - &carried * known * carried.transpose();
        let freedom = 3.0 * n as f64 - 3.0;
        let variance = residual.dot(&(&projection * &residual)) / freedom;
        let ln = ln_determinant(&covariance) + ln_determinant(&information);
        let likelihood = -0.5 * (freedom * variance.ln() + ln);
        look(&restricted, &covariance, &projection, &residual, likelihood);
    }

    #[test]
    fn the_likelihood_is_that_of_dense_matrices() {
        compared(|restricted, _, projection, residual, expected| {
            let sums = restricted.sums(TAU, RATIO);
            let likelihood = restricted.likelihood(&sums, &SIGMA);
            assert!(
                (likelihood - expected).abs() < 1e-8,
                "{likelihood} {expected}"
            );
            let freedom = residual.len() as f64 - 3.0;
            let scale = (residual.dot(&(projection * residual)) / freedom).sqrt();
            assert!((restricted.scale(&sums, &SIGMA) / scale - 1.0).abs() < 1e-9);
        });
    }

    #[test]
    fn each_axis_has_its_variance_with_what_the_columns_take_of_it() {
        compared(|restricted, covariance, projection, residual, _| {
            let spread = restricted.spread(&restricted.sums(TAU, RATIO), &SIGMA);
            let n = residual.len() / 3;
            // V P y is what the fit leaves, V P what it leaves of the rows.
            let left = covariance * (projection * residual);
            let kept = covariance * projection;
            for (axis, (variance, freedom)) in spread.into_iter().enumerate() {
                let own = covariance.view((axis * n, axis * n), (n, n)).into_owned();
                let of_axis = left.rows(axis * n, n).into_owned();
                let square = of_axis.dot(&(own.try_inverse().unwrap() * &of_axis));
                let rest: f64 = (axis * n..(axis + 1) * n).map(|k| kept[(k, k)]).sum();
                assert!((freedom - rest).abs() < 1e-8, "{freedom} {rest}");
                let expected = square / rest;
                assert!(
                    (variance / expected - 1.0).abs() < 1e-8,
                    "{axis} {variance} {expected}"
                );
            }
        });
    }
}
