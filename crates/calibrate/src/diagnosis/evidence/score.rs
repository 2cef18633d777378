//! The score of a candidate given a fit.

use crate::diagnosis::candidates::table::Candidate;

/// The score of one candidate given a fit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Score {
    pub(crate) candidate: usize,
    /// By how much the sum of squares would fall.
    pub(crate) gain: f64,
    /// −ln p, less what the settings tried cost: the scale of the family-wise test.
    pub(crate) minus_ln_p: f64,
    /// Change of the logarithm of the evidence.
    pub(crate) ln_odds: f64,
}

/// The penalty of a candidate in the family-wise test for the settings of its kind: the square root of their number,
/// so that plain effects keep power in spite of the hundreds of gear orders; shapes pay three times as much as names.
pub(crate) fn weight_of(candidate: &Candidate) -> f64 {
    let anonymous = if candidate.named() { 0.0 } else { 3.0_f64.ln() };
    0.5 * candidate.tried.max(1.0).ln() + anonymous
}

/// Likeliest first; what is equally likely stays in the order of the catalogue.
pub(crate) fn by_odds(scores: &mut [Score]) {
    let key = |s: &Score| (s.ln_odds * 1e5).round();
    scores.sort_by(|a, b| {
        key(b)
            .total_cmp(&key(a))
            .then(a.candidate.cmp(&b.candidate))
    });
}
