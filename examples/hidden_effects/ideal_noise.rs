//! A test that no real one can be as good as: it knows how the measuring frame wanders, its path, size
//! and time constant, and only asks whether it wanders or the base stands elsewhere in white noise of
//! any size. By exact likelihoods with dense covariances; the offset pays as any three numbers do
//! (Schwarz 1978).
//!
//! ```text
//! ln L = −½ (rᵀ C⁻¹ r + ln det C)   beside zero offset and link length, and the offset
//! ```

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::rig::noise::{Path, Slow};
use crate::rig::{Rig, Shot};

/// Whether the ideal test takes the wander of this session for a base offset.
pub fn takes_it_for_an_offset(rig: &Rig, slow: &Slow) -> bool {
    let n = rig.shots.len();
    let left = DMatrix::from_fn(n, 3, |i, axis| {
        rig.measured[i][axis] - rig.point(&rig.shots[i], &[])[axis]
    });
    let base = base_columns(rig);
    let together = wander(rig, slow);
    let sigma = rig.design.sigma_mm;
    let mut white = Sums::new(5);
    let mut wandering = Sums::new(2);
    for axis in 0..3 {
        let own = |column: usize| DVector::from_fn(n, |i, _| base[column][i][axis]);
        let still = |of: usize| DVector::from_element(n, f64::from(u8::from(of == axis)));
        let y = left.column(axis).into_owned();
        let columns = [own(0), own(1), still(0), still(1), still(2)];
        white.add(&columns, &y, 0.0);
        let share = slow.share * slow.axes[axis].powi(2);
        let covariance = DMatrix::from_fn(n, n, |i, j| {
            let own = if i == j { 1.0 - slow.share } else { 0.0 };
            sigma * sigma * (own + share * together[(i, j)])
        });
        let Some(factor) = Cholesky::new(covariance) else {
            return false;
        };
        let l = factor.l();
        let whitened = |v: &DVector<f64>| l.solve_lower_triangular(v).unwrap_or_else(|| v.clone());
        let ln_det = 2.0 * l.diagonal().iter().map(|d| d.ln()).sum::<f64>();
        wandering.add(
            &[whitened(&own(0)), whitened(&own(1))],
            &whitened(&y),
            ln_det,
        );
    }
    let rows = 3.0 * n as f64;
    let freedom = rows - 5.0;
    let with_offset =
        -0.5 * (rows * (white.left() / freedom).ln() + freedom) - 0.5 * 3.0 * rows.ln();
    with_offset > -0.5 * (wandering.left() + wandering.ln_det)
}

/// What a change of the zero offset and of the length does to every point.
fn base_columns(rig: &Rig) -> [Vec<[f64; 3]>; 2] {
    let change = |offset: f64, length: f64| {
        let mut moved = rig.clone();
        moved.offset += offset;
        moved.length += length;
        let of = |shot: &Shot| {
            let (to, from) = (moved.point(shot, &[]), rig.point(shot, &[]));
            [0, 1, 2].map(|a| (to[a] - from[a]) / (offset + length))
        };
        rig.shots.iter().map(of).collect()
    };
    [change(1e-5, 0.0), change(0.0, 1e-3)]
}

/// Covariance of the wander from sample to sample, of unit variance.
fn wander(rig: &Rig, slow: &Slow) -> DMatrix<f64> {
    let times: Vec<f64> = rig.shots.iter().map(|s| s.time).collect();
    let n = times.len();
    let all = times[n - 1] - times[0];
    let tau = slow.time_constant_s;
    let raw = DMatrix::from_fn(n, n, |i, j| {
        let apart = (times[i] - times[j]).abs();
        match slow.path {
            Path::Rough => (-apart / tau).exp(),
            Path::Smooth => {
                let h = 3.0_f64.sqrt() * apart / tau;
                (1.0 + h) * (-h).exp()
            }
            Path::Walk => 6.0 * (f64::min(times[i], times[j]) - times[0]) / all,
        }
    });
    if slow.path != Path::Walk {
        return raw;
    }
    // A walk is drawn about its own mean.
    let centre = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - 1.0 / n as f64);
    &centre * raw * &centre
}

/// Least squares of whitened rows.
struct Sums {
    normal: DMatrix<f64>,
    pull: DVector<f64>,
    square: f64,
    ln_det: f64,
}

impl Sums {
    fn new(columns: usize) -> Self {
        Self {
            normal: DMatrix::zeros(columns, columns),
            pull: DVector::zeros(columns),
            square: 0.0,
            ln_det: 0.0,
        }
    }

    fn add(&mut self, columns: &[DVector<f64>], y: &DVector<f64>, ln_det: f64) {
        for (i, a) in columns.iter().enumerate() {
            for (j, b) in columns.iter().enumerate() {
                self.normal[(i, j)] += a.dot(b);
            }
            self.pull[i] += a.dot(y);
        }
        self.square += y.dot(y);
        self.ln_det += ln_det;
    }

    /// Sum of squares that the columns leave.
    fn left(&self) -> f64 {
        let solved = self.normal.clone().svd(true, true).solve(&self.pull, 1e-12);
        self.square - solved.map_or(0.0, |x| x.dot(&self.pull))
    }
}
