//! The significance and the odds of a name given the other names of a fit.

use crate::effects::Term;

use super::prepare::PreparedSearch;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Significance;

/// The significance and the odds of one term given the others.
#[derive(Debug, Clone)]
pub(crate) struct Worth {
    /// The fit without it.
    pub(crate) reduced: Fit,
    /// −ln p on the scale of the family-wise test.
    pub(crate) minus_ln_p: f64,
    /// Logarithm of how much likelier the fit is with it.
    pub(crate) ln_odds: f64,
}

/// The significance and the odds of a term given the others of a fit.
pub(crate) fn worth(prepared: &PreparedSearch, fit: &Fit, term: &Term) -> Worth {
    let regression = &prepared.regression;
    let reduced = regression.without_term(fit, term);
    let rank = fit.basis.rank().saturating_sub(reduced.basis.rank()).max(1);
    let freedom = (regression.m() - fit.basis.rank() as f64).max(2.0);
    let share = ((reduced.rss - fit.rss) / reduced.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
    let tried = regression.price_of_term(term);
    let mut minus_ln_p = Significance::new(rank, freedom).of(share) - 0.5 * tried;
    // Orders of one gear are tested together: that none of them exists is one null hypothesis.
    let together = regression.together(fit, term);
    if together.len() > 1 {
        let gone = |t: &Term| together.iter().any(|own| own.same_column(t));
        let without = regression.fit(&fit.model.without(gone), &fit.shapes);
        let rank = fit.basis.rank().saturating_sub(without.basis.rank()).max(1);
        let share = (1.0 - fit.rss / without.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
        minus_ln_p = minus_ln_p.max(Significance::new(rank, freedom).of(share));
    }
    Worth {
        minus_ln_p,
        ln_odds: fit.ln_evidence - reduced.ln_evidence,
        reduced,
    }
}
