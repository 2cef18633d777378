//! A rival: an alternative explanation of the same samples.

use crate::effects::Term;

use super::fit::Fit;

/// Another explanation.
#[derive(Debug, Clone)]
pub(crate) struct Rival {
    /// The terms that it replaces.
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
