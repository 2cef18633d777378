//! The loads that a program states, by where in the file they begin to hold.

use std::collections::BTreeMap;

/// A load that a program states.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StatedLoad {
    pub(super) at: usize,
    pub(super) name: String,
}

/// Loads that a program states, by kg (its bits), each with where it is stated first.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct StatedLoads(pub(super) BTreeMap<u64, StatedLoad>);

impl StatedLoads {
    /// Keeps a load in kg; one below zero is a controller's way to say that none is set.
    pub(super) fn state(&mut self, kg: f64, at: usize, name: &str) {
        if kg.is_finite() && kg >= 0.0 {
            let name = name.to_owned();
            let bits = (kg + 0.0).to_bits();
            self.0.entry(bits).or_insert(StatedLoad { at, name });
        }
    }

    /// From the smallest; the bits of what is not negative are in its order.
    pub(super) fn all(&self) -> Vec<(f64, &StatedLoad)> {
        let all = self.0.iter();
        all.map(|(bits, load)| (f64::from_bits(*bits), load))
            .collect()
    }
}
