//! What noise alone did to a search, as far as it was simulated.

use crate::linear::Basis;
use nalgebra::DVector;
use std::sync::Arc;

use super::trials::{CHUNK, Tail};

/// Largest −ln p of simulated residuals, kept for each model.
#[derive(Debug, Default)]
pub(crate) struct Familywise {
    pub(super) null: Vec<Null>,
}

/// What noise alone did to the search beside one model, so far.
#[derive(Debug)]
pub(super) struct Null {
    pub(crate) rank: usize,
    /// Of the model that it was made for.
    pub(super) fingerprint: Vec<u64>,
    /// Whether it is the same whatever the seed.
    pub(super) seedless: bool,
    pub(crate) basis: Arc<Basis>,
    /// What the signs of are flipped; `None` where the residuals are Gaussian.
    pub(super) flipped: Option<DVector<f32>>,
    /// Largest first.
    pub(crate) largest: Vec<f64>,
    /// The simulated tail of Gaussian residuals.
    pub(super) tail: Option<Tail>,
}

/// Chances between these are worth more simulations …
pub(crate) const CLOSE: [f64; 2] = [4e-4, 0.04];

/// … and on the way to what is tested at the end those within so many standard errors of what is asked for.
const CLOSE_ON_THE_WAY: f64 = 2.5;

/// Beyond what one of so many simulations reaches the tail is extrapolated.
const TAIL_SHARE: usize = 50;

/// … where as many as reach it have at most this chance to if noise does not.
const ODD: f64 = 1e-4;

impl Null {
    pub(super) fn has_a_chunk(&self) -> bool {
        self.largest.len() >= CHUNK
    }

    /// Whether more simulations, up to so many, would not change what it says of this −ln p.
    pub(super) fn has_p(&self, minus_ln_p: f64, most: usize) -> bool {
        let [from, to] = CLOSE;
        let is_close = |p: f64| p > from && p < to;
        self.has_a_chunk()
            && (self.tail.is_some()
                || self.largest.len() >= most
                || !is_close(self.chance(minus_ln_p)))
    }

    /// Whether the chance is clearly above or below this one. Of n simulations the tail begins at the n/50th:
    /// that is its standard error, one over the root of n/50.
    pub(crate) fn is_apart(&self, minus_ln_p: f64, chance: f64) -> bool {
        let error = (TAIL_SHARE as f64 / self.largest.len().max(1) as f64).sqrt();
        let apart = || (self.chance(minus_ln_p) / chance).ln().abs();
        self.has_a_chunk() && apart() > CLOSE_ON_THE_WAY * error
    }

    /// Whether so many simulations reach it as would be [`ODD`] if their chance were not above this one: of
    /// n at least k with a chance of at most (n·chance)ᵏ/k!.
    pub(super) fn surely_reaches(&self, minus_ln_p: f64, chance: f64) -> bool {
        let above = self.above(minus_ln_p);
        let expected = self.largest.len() as f64 * chance;
        let odds = (1..=above).map(|k| expected / k as f64);
        above > 0 && odds.product::<f64>() < ODD
    }

    /// How many simulations reach it.
    pub(crate) fn above(&self, minus_ln_p: f64) -> usize {
        self.largest.partition_point(|s| *s >= minus_ln_p)
    }

    /// The chance of a −ln p as large: counted, and beyond the largest fiftieth ([`TAIL_SHARE`]) by the tail
    /// chance(s) = share · exp(−(s − quantile)).
    pub(crate) fn chance(&self, minus_ln_p: f64) -> f64 {
        if let Some(tail) = self.tail.as_ref().filter(|t| minus_ln_p >= t.from) {
            return tail.chance(minus_ln_p);
        }
        let count = self.largest.len();
        let above = self.above(minus_ln_p);
        let rank = (count / TAIL_SHARE).max(1);
        let counted = above as f64 / count as f64;
        if above > rank {
            return counted;
        }
        let share = rank as f64 / count as f64;
        let from_tail = share * (self.largest[rank - 1] - minus_ln_p).exp();
        from_tail.max(counted.min(3.0 * from_tail))
    }

    /// Takes what some more simulated residuals reached.
    pub(crate) fn add_simulated(&mut self, largest: Vec<f64>) {
        self.largest.extend(largest);
        self.largest.sort_by(|a, b| b.total_cmp(a));
    }
}
