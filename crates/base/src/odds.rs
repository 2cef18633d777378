//! Levels of evidence, each by how seldom noise alone reaches it.

use statrs::distribution::{ContinuousCDF, Normal};

/// Noise alone does as much in one session of so many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnceIn(pub f64);

/// Two explanations within this are both open. (`hidden_effects component`, λ = 100: named or in the set 90 % of 98,
/// then 99 % of 210; with a drift or a step of the frame compared with slow noise by the same, no more of the machine
/// is named.)
pub const OPEN: OnceIn = OnceIn(20.0);
/// What one look at the data is taken for granted by.
pub const LIKELY: OnceIn = OnceIn(100.0);
/// What is taken for present. A search takes a step for each effect that is present: with three of them a right answer
/// gets a wrong addition in less than one session of a hundred, and most of the one in a hundred for false alarms
/// remains for what a simulation does not contain (tails, drifts, correlation).
pub const TAKEN: OnceIn = OnceIn(500.0);
/// What is reported although nobody asked.
pub const CLEAR: OnceIn = OnceIn(1000.0);
/// What is rare a priori, as one session in a hundred has it, and has to be clear nevertheless.
pub const RARE: OnceIn = OnceIn(1e5);
/// No noise does that, nor what the noise is taken to be and is not.
pub const BEYOND_DOUBT: OnceIn = OnceIn(1e13);

impl OnceIn {
    /// The chance of it.
    pub fn chance(self) -> f64 {
        1.0 / self.0
    }

    /// The logarithm of the odds.
    pub fn nats(self) -> f64 {
        self.0.ln()
    }

    /// The value that χ² with one degree of freedom, a square over its variance, is above with this chance.
    pub fn chi_square(self) -> f64 {
        Normal::standard().inverse_cdf(0.5 * self.chance()).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_a_chance_a_logarithm_and_a_square() {
        assert!((OPEN.chance() - 0.05).abs() < 1e-15);
        assert!((OPEN.nats() - 2.995_732).abs() < 1e-6);
        assert!((OPEN.chi_square() - 3.841_459).abs() < 1e-6);
        assert!((CLEAR.chi_square() - 10.827_566).abs() < 1e-6);
    }
}
