//! The restricted likelihood of a noise given the columns of a fit (Patterson & Thompson 1971).
//!
//! The frame of a setup, and whatever else affects a stretch of the samples only, has columns that are zero everywhere
//! else. Where there are many stretches their columns are eliminated one stretch after the other ([`stretches`]), so
//! that a session of many setups costs what its samples cost; otherwise all columns go through the filter ([`whole`]).
//! Repeatability correlates the axes: then all columns go through the filter along all axes at once.

mod stretches;
mod summed;
mod whole;

use nalgebra::{DMatrix, DVector};

use crate::fit::regression::Rows;
use crate::linear::gram;
use crate::rounding;

use stretches::Stretches;
pub(super) use summed::NoiseShape;
use summed::Summed;
use whole::Whole;

/// The restricted likelihood of noise given the columns of a fit.
pub(super) struct Restricted<'r> {
    rows: &'r Rows<'r>,
    pub(super) axes: Vec<usize>,
    columns: Columns,
    /// Columns and residual along all axes, where it is known how rows move with the joints.
    together: Option<DMatrix<f64>>,
}

enum Columns {
    Whole(Whole),
    Stretches(Stretches),
}

impl<'r> Restricted<'r> {
    pub(super) fn new(rows: &'r Rows<'r>, residual: &DVector<f64>, columns: &DMatrix<f64>) -> Self {
        let products = columns.ncols() * columns.ncols() * columns.nrows();
        if rows.moves().is_some() && products <= MOST_PRODUCTS {
            let whole = Whole::new(rows, residual, columns);
            return Self {
                rows,
                axes: rows.axes.clone(),
                together: Some(whole.together()),
                columns: Columns::Whole(whole),
            };
        }
        let by_stretch = Stretches::of(rows, residual, columns).map(Columns::Stretches);
        Self {
            rows,
            axes: rows.axes.clone(),
            columns: by_stretch
                .unwrap_or_else(|| Columns::Whole(Whole::new(rows, residual, columns))),
            together: None,
        }
    }

    /// How far a row moves with the joints, root mean square over samples, mm for each rad; `None` where that is not
    /// known.
    pub(super) fn lever_mm(&self) -> Option<f64> {
        self.together.as_ref()?;
        let moves = self.rows.moves()?;
        let lever = moves.levers.norm() / (self.rows.len().max(1) as f64).sqrt();
        (lever > 0.0).then_some(lever)
    }

    /// Shortest and longest time constant that the samples can determine. What does not come back within the session
    /// cannot be distinguished from an offset and a drift of the frame, which are effects.
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

    fn summed(&self, shape: NoiseShape) -> Option<Summed> {
        if shape.joints_rad > 0.0 {
            let mut white = self.together.clone()?;
            let filter = shape.noise().filter(self.rows);
            filter.whiten(white.as_mut_slice());
            return Some(Summed {
                gram: gram(&white),
                ln_determinant: filter.ln_determinant(),
            });
        }
        match &self.columns {
            Columns::Whole(whole) => Some(whole.summed(self.rows, shape)),
            Columns::Stretches(stretches) => stretches.summed(self.rows, shape),
        }
    }

    fn rank(&self) -> usize {
        match &self.columns {
            Columns::Whole(whole) => whole.rank(),
            Columns::Stretches(stretches) => stretches.rank(),
        }
    }

    fn freedom(&self) -> f64 {
        ((self.rows.len() as f64) - self.rank() as f64).max(1.0)
    }

    /// Residual standard deviation, in units of σ.
    pub(super) fn scale(&self, shape: NoiseShape) -> f64 {
        let solved = self.summed(shape).and_then(|summed| summed.solved());
        solved.map_or(0.0, |solved| (solved.rss / self.freedom()).sqrt())
    }

    /// Variance along each axis in units of σ², with its degrees of freedom.
    pub(super) fn spread(&self, shape: NoiseShape) -> Vec<(f64, f64)> {
        let spread = match &self.columns {
            _ if shape.joints_rad > 0.0 => self.spread_by_differences(shape),
            Columns::Whole(whole) => whole.spread(self.rows, shape),
            Columns::Stretches(_) => self.spread_by_differences(shape),
        };
        let n = self.rows.samples.len() as f64;
        spread.unwrap_or_else(|| vec![(1.0, n); self.axes.len()])
    }

    /// The same by differences: where `σ` along an axis grows, the residual sum of squares falls by twice that of the
    /// axis, and the determinant grows by twice the freedom.
    fn spread_by_differences(&self, shape: NoiseShape) -> Option<Vec<(f64, f64)>> {
        let at = |axis: usize, by: f64| {
            let mut shape = shape;
            shape.sigma[axis] *= by.exp();
            let summed = self.summed(shape)?;
            let solved = summed.solved()?;
            let ln_determinant = solved.ln_determinant() + summed.ln_determinant;
            Some((solved.rss, ln_determinant))
        };
        let one = |axis: &usize| {
            let (more, less) = (
                at(*axis, rounding::DIFFERENCE)?,
                at(*axis, -rounding::DIFFERENCE)?,
            );
            let by = 4.0 * rounding::DIFFERENCE;
            let freedom = ((more.1 - less.1) / by).max(1.0);
            let square = ((less.0 - more.0) / by).max(0.0);
            Some((square / freedom, freedom))
        };
        self.axes.iter().map(one).collect()
    }

    /// Logarithm, up to a constant, with the common size profiled out.
    pub(super) fn likelihood(&self, shape: NoiseShape) -> f64 {
        self.likelihood_and_scale(shape).0
    }

    /// The same with that size, in units of σ.
    pub(super) fn likelihood_and_scale(&self, shape: NoiseShape) -> (f64, f64) {
        let known = self.summed(shape);
        let solved = known.and_then(|summed| Some((summed.solved()?, summed.ln_determinant)));
        let Some((solved, ln_determinant)) = solved else {
            return (f64::NEG_INFINITY, 0.0);
        };
        let freedom = self.freedom();
        let variance = (solved.rss / freedom).max(rounding::WRITTEN * rounding::WRITTEN);
        let ln_determinant = solved.ln_determinant() + ln_determinant;
        let ln = -0.5 * (freedom * variance.ln() + ln_determinant);
        (ln, variance.sqrt())
    }
}

/// Products of columns along all axes, at most, for one noise: a tenth of a second. With more, as of many setups, what the
/// robot does not repeat is not looked for.
const MOST_PRODUCTS: usize = 200_000_000;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::sweep;
    use crate::fit::problem::Problem;

    const TAU: f64 = 40.0;
    const RATIO: [f64; 3] = [2.0, 0.0, 0.5];
    const SIGMA: [f64; 3] = [0.05, 0.02, 0.11];
    const SHAPE: NoiseShape = NoiseShape {
        tau: TAU,
        ratio: RATIO,
        sigma: SIGMA,
        joints_rad: 0.0,
    };

    fn ln_determinant(a: &DMatrix<f64>) -> f64 {
        let root = a.clone().cholesky().unwrap().l();
        2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>()
    }

    /// Its results given three columns in samples at irregular times, and the same from dense matrices: ν, V⁻¹, P =
    /// V⁻¹ − V⁻¹X(XᵀV⁻¹X)⁻¹XᵀV⁻¹, the restricted likelihood and P y.
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
        let decayed = &inverse * &x;
        let information = x.transpose() * &decayed;
        let known = information.clone().try_inverse().unwrap();
        let projection = &inverse - &decayed * known * decayed.transpose();
        let freedom = 3.0 * n as f64 - 3.0;
        let variance = residual.dot(&(&projection * &residual)) / freedom;
        let ln = ln_determinant(&covariance) + ln_determinant(&information);
        let likelihood = -0.5 * (freedom * variance.ln() + ln);
        look(&restricted, &covariance, &projection, &residual, likelihood);
    }

    #[test]
    fn the_likelihood_is_that_of_dense_matrices() {
        compared(|restricted, _, projection, residual, expected| {
            let likelihood = restricted.likelihood(SHAPE);
            assert!(
                (likelihood - expected).abs() < 1e-8,
                "{likelihood} {expected}"
            );
            let freedom = residual.len() as f64 - 3.0;
            let scale = (residual.dot(&(projection * residual)) / freedom).sqrt();
            assert!((restricted.scale(SHAPE) / scale - 1.0).abs() < 1e-9);
        });
    }

    /// `tests/reference/restricted_likelihood.py`.
    #[test]
    fn the_likelihood_is_that_of_scipy() {
        let from_scipy =
            include_str!("../../../../../../tests/reference/restricted_likelihood.json");
        let expected: serde_json::Value = serde_json::from_str(from_scipy).unwrap();
        let near = |own: f64, name: &str| {
            let expected = expected[name].as_f64().unwrap();
            assert!((own / expected - 1.0).abs() < 1e-9, "{own} {expected}");
        };
        compared(|restricted, _, _, _, _| {
            near(restricted.likelihood(SHAPE), "ln_likelihood");
            near(restricted.scale(SHAPE), "scale");
        });
    }

    #[test]
    fn each_axis_has_its_variance_with_what_the_columns_take_of_it() {
        compared(|restricted, covariance, projection, residual, _| {
            let spread = restricted.spread(SHAPE);
            let n = residual.len() / 3;
            // V P y are the residuals of the fit, V P the residual-maker matrix.
            let residuals = covariance * (projection * residual);
            let kept = covariance * projection;
            for (axis, (variance, freedom)) in spread.into_iter().enumerate() {
                let own = covariance.view((axis * n, axis * n), (n, n)).into_owned();
                let of_axis = residuals.rows(axis * n, n).into_owned();
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
