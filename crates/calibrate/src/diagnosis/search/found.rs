//! The result of a search.

use crate::diagnosis::evidence::Fit;
use crate::effects::Term;

/// The end of the search.
pub(crate) struct SearchResult {
    /// The model with everything that is accepted.
    pub(crate) fit: Fit,
    /// The best model of names alone.
    pub(crate) named_effects_only: Fit,
    /// Whether the names were withdrawn, as the geometry of several joints does not fit.
    pub(crate) base_misfit: bool,
    /// Waves that equal steps cannot distinguish from slower ones, which their names have no setting for.
    pub(crate) withdrawn: Vec<Term>,
    /// Ends of other searches, under another noise, that the samples do not rule out.
    pub(crate) other_ends: Vec<Fit>,
}

impl SearchResult {
    /// The ends of a search, of everything and of names alone, of which nothing else is known yet.
    pub(super) fn of(fit: Fit, named_effects_only: Fit) -> Self {
        Self {
            fit,
            named_effects_only,
            base_misfit: false,
            withdrawn: Vec::new(),
            other_ends: Vec::new(),
        }
    }
}
