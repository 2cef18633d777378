//! Whether the samples speak for a name, or what is known beforehand of the geometry does.
//!
//! Where few poses show the geometry, the base is held by how far off links, zero offsets and tools usually are.
//! A robot that is farther off then leaves an error that a name may take up: one that the geometry would take up
//! as well, were it not held. So every name is tested once more with the geometry known ten times less well. What
//! is left of it has to be as improbable by chance as before.

use super::forward::CHANCE_OF_A_STEP;
use super::prepare::PreparedSearch;
use super::worth::worth;
use crate::diagnosis::evidence::Fit;
use crate::effects::Term;

/// So many times less is taken to be known of the geometry: no robot is ten times as far off as others are.
const LESS: f64 = 10.0;

/// The name, of those of a fit, for which the samples themselves speak least, where they do not speak for it.
pub(super) fn least_proven(prepared: &PreparedSearch, fit: &Fit) -> Option<Term> {
    let regression = &prepared.regression;
    let terms = regression.added(fit);
    if regression.prior_rows().is_empty() || terms.is_empty() {
        return None;
    }
    let open = regression.with_less_known(LESS);
    let fitted = open.fit(&fit.model, &fit.shapes);
    let proven = |term: &Term| worth(&open, &fitted, term).minus_ln_p;
    let all = terms.into_iter().map(|term| (proven(term), term));
    let (least, term) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (regression.chance_in_noise(least, fit) > CHANCE_OF_A_STEP).then(|| term.clone())
}
