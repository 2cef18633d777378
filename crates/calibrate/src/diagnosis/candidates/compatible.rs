//! Names that may be in one model.

use crate::effects::Term;

/// Whether a name may be added to those in a model: not to the one that it becomes in the limit, and two of a kind
/// need different settings.
pub(crate) fn compatible(there: &[&Term], term: &Term) -> bool {
    let about = |t: &Term| t.effect.about();
    let in_limit = |a: &Term, b: &Term| {
        let has_limit = about(a).becomes.or(about(b).becomes).is_some();
        has_limit && about(a).family() == about(b).family()
    };
    !there
        .iter()
        .any(|t| t.joint == term.joint && (t.same_column(term) || in_limit(t, term)))
}
