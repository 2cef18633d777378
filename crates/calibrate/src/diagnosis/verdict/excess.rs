//! The excess of the residuals over the noise.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::{odds, thresholds};

/// A smaller excess counts where noise does as much in one session of a thousand, if it is above the digits that a stated
/// σ has, 3 %.
const LEAST_EXCESS: f64 = 1.03;

/// The residuals compared with the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Excess {
    /// White noise as found over the floor.
    pub(crate) ratio: f64,
    /// Chance of as much from noise alone.
    pub(crate) p: f64,
    /// The kind of measurement that shows it, where there are several.
    pub(crate) kind: Option<&'static str>,
}

impl Excess {
    pub(super) fn is_more_than_noise(&self) -> bool {
        self.ratio > thresholds::NOTICEABLE && self.p < odds::LIKELY.chance()
            || self.ratio > LEAST_EXCESS && self.p < odds::CLEAR.chance()
    }
}

/// Chance of a mean square so many times the expected one, which is itself estimated with so many degrees of freedom:
/// with infinitely many where it is stated.
pub(super) fn excess_of(ratio2: f64, freedom: f64, known_from: f64, kurtosis: f64) -> Excess {
    // Wilson & Hilferty's cube root makes χ² nearly normal, and a ratio of two as well (Paulson
    // 1942); heavy tails widen it.
    let own = (kurtosis - 1.0) / freedom.max(1.0) / 9.0;
    let other = (kurtosis - 1.0) / known_from.max(1.0) / 9.0;
    let root = ratio2.max(0.0).cbrt();
    let z = (root * (1.0 - other) - (1.0 - own)) / (own + root * root * other).sqrt();
    let p = Normal::new(0.0, 1.0).map_or(1.0, |n| n.sf(z));
    Excess {
        ratio: ratio2.max(0.0).sqrt(),
        p,
        kind: None,
    }
}
