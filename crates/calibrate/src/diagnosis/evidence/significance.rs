//! The significance of a gain: with k columns against ν = m − p − k degrees of freedom
//!
//! ```text
//! p = P(Beta(ν/2, k/2) < 1 − R²),   R² = gain / rss
//! ```
//!
//! (the F test, written in R²). For k = 2 this is (1 − R²)^(ν/2) exactly; for the others a table
//! over x = −ν/2 ln(1 − R²) is filled once and read by linear interpolation.

use std::cell::RefCell;
use std::rc::Rc;

use statrs::function::beta::ln_beta;

use super::bisection::bisected;
use crate::distributions::beta_below;

const STEP: f64 = 0.25;
const LAST: usize = 240;

/// −ln p for one number of columns.
#[derive(Debug, Clone)]
pub(crate) struct Significance {
    half_nu: f64,
    half_k: f64,
    table: Vec<f64>,
}

/// Tables of tests that were made: making one takes longer than reading it.
#[derive(Debug, Default)]
pub(crate) struct Tests(RefCell<Vec<(usize, u64, Rc<Significance>)>>);

impl Tests {
    /// The test for `columns` against so many degrees of freedom.
    pub(crate) fn of(&self, columns: usize, freedom: f64) -> Rc<Significance> {
        let mut known = self.0.borrow_mut();
        let key = freedom.to_bits();
        let at = known.iter().position(|k| (k.0, k.1) == (columns, key));
        if let Some(at) = at {
            return Rc::clone(&known[at].2);
        }
        let test = Rc::new(Significance::new(columns, freedom));
        known.push((columns, key, Rc::clone(&test)));
        test
    }
}

impl Significance {
    /// For `columns` against the remaining `freedom` degrees of freedom.
    pub(crate) fn new(columns: usize, freedom: f64) -> Self {
        let mut new = Self {
            half_nu: 0.5 * freedom.max(1.0),
            half_k: 0.5 * columns as f64,
            table: Vec::new(),
        };
        if columns != 2 {
            new.table = (0..=LAST).map(|i| new.exact(STEP * i as f64)).collect();
        }
        new
    }

    /// −ln p of a share R² of the residual.
    pub(crate) fn of(&self, r2: f64) -> f64 {
        let x = -self.half_nu * (-r2.min(1.0)).ln_1p();
        if !x.is_finite() {
            return 1e6;
        }
        if self.table.is_empty() {
            return x.max(0.0);
        }
        let at = (x / STEP).max(0.0);
        let below = at.floor() as usize;
        if below >= LAST {
            return self.exact(x);
        }
        let part = at - below as f64;
        self.table[below] * (1.0 - part) + self.table[below + 1] * part
    }

    /// The share R² that a gain has to reach for a given −ln p.
    pub(crate) fn share_for(&self, minus_ln_p: f64) -> f64 {
        bisected([0.0, 1.0 - 1e-12], |r2| self.of(r2) < minus_ln_p)
    }

    fn exact(&self, x: f64) -> f64 {
        let remaining = (-x / self.half_nu).exp();
        if remaining >= 1.0 {
            return 0.0;
        }
        let p = beta_below(self.half_nu, self.half_k, x / self.half_nu);
        if p > 1e-250 {
            return -p.ln();
        }
        // The leading term of the series for a small tail.
        let ln_left = -x / self.half_nu;
        let series = self.half_nu * ln_left + (self.half_k - 1.0) * (-remaining).ln_1p()
            - self.half_nu.ln()
            - ln_beta(self.half_nu, self.half_k);
        -series
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_columns_are_exact_and_others_follow_the_f_distribution() {
        let two = Significance::new(2, 100.0);
        assert!((two.of(0.2) + 50.0 * 0.8_f64.ln()).abs() < 1e-12);
        // scipy.stats.f.sf(0.1 / (0.9 / 99), 1, 99) = 0.00127486…
        let one = Significance::new(1, 99.0);
        let p = (-one.of(0.1)).exp();
        assert!((p - 0.001274).abs() < 2e-5, "{p}");
    }

    #[test]
    fn the_share_is_the_inverse() {
        let three = Significance::new(3, 200.0);
        let share = three.share_for(12.0);
        assert!((three.of(share) - 12.0).abs() < 1e-6);
    }
}
