//! Another explanation of the same samples.

use crate::effects::Term;

use super::fit::Fit;

/// Log-odds within which the samples cannot rule a rival out: about 20 : 1.
/// A drift or step of the frame is held against slow noise with the same odds: both are
/// movements of the frame, and the set of equivalent names cannot hold the noise
/// (`hidden_effects component`, λ = 100: named or in the set 90 % of 98, then 99 % of 210;
/// `slow`: no more of the machine is named).
pub(crate) const UNDECIDED: f64 = 3.0;

/// Another explanation.
#[derive(Debug, Clone)]
pub(crate) struct Rival {
    /// What it replaces.
    pub(crate) removed: Vec<Term>,
    pub(crate) instead: Vec<Term>,
    /// The refitted model.
    pub(crate) fit: Fit,
}

impl Rival {
    /// Whether it differs by name, not only by setting.
    pub(crate) fn other_names(&self) -> bool {
        let names = |terms: &[Term]| {
            let mut names: Vec<(&str, usize)> = terms.iter().map(name).collect();
            names.sort_unstable();
            names.dedup();
            names
        };
        names(&self.removed) != names(&self.instead)
    }

    /// The settings by which it differs, where the names are the same.
    pub(crate) fn other_settings(&self) -> Vec<f64> {
        if self.other_names() {
            return Vec::new();
        }
        self.instead
            .iter()
            .map(crate::diagnosis::candidates::value)
            .collect()
    }
}

pub(crate) fn name(term: &Term) -> (&'static str, usize) {
    (term.effect.about().id, term.joint)
}
