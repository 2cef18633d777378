//! The final test of a set of names: each given the others, with the null of this very fit. A name that was added
//! early may gain nothing given those that came later.

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use super::settle::needed;
use super::steps::{Next, Step, steps};
use super::worth::worth;
use super::{aliases, own_evidence};
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::{Cancelled, Progress, Watch};
use crate::odds;

/// Takes out, worst first, every name that is not significant on its own.
pub(crate) fn test(
    prepared: &PreparedSearch,
    found: &mut SearchResult,
    watch: Watch,
) -> Result<(), Cancelled> {
    found.fit = tested(prepared, found.fit.clone(), watch)?;
    Ok(())
}

/// A fit without the names that are not significant on their own.
pub(crate) fn tested(
    prepared: &PreparedSearch,
    mut fit: Fit,
    watch: Watch,
) -> Result<Fit, Cancelled> {
    let regression = &prepared.regression;
    loop {
        if !watch(&Progress::Comparing) {
            return Err(Cancelled);
        }
        let unseen = prepared.folds.rms(regression, &fit);
        let terms = regression.added(&fit).into_iter();
        let mut worths: Vec<_> = terms.map(|t| (worth(prepared, &fit, t), t)).collect();
        // The first that is not significant is the worst of them: the others are not tested.
        worths.sort_by(|a, b| a.0.ln_odds.total_cmp(&b.0.ln_odds));
        let worst = worths.into_iter().find_map(|(worth, term)| {
            let unlikely = worth.ln_odds < needed(&fit, term).max(0.0);
            let improbable =
                || regression.chance_in_noise(worth.minus_ln_p, &fit) > odds::TAKEN.chance();
            let useless = || prepared.folds.rms(regression, &worth.reduced) <= unseen;
            (unlikely || improbable() || useless()).then_some(worth.reduced)
        });
        let Some(reduced) = worst else {
            return Ok(fit);
        };
        fit = reduced;
    }
}

/// Logarithms of odds that differ by less are equal: neither fit is better.
pub(crate) const EQUALLY_LIKELY: f64 = 1e-3;

/// Whether a rival is likelier than a fit by more than rounding.
pub(crate) fn is_likelier(rival: &Fit, fit: &Fit) -> bool {
    rival.ln_evidence > fit.ln_evidence + EQUALLY_LIKELY
}

/// Whether a rival is likelier than a fit, and remains so without those of its names that are not significant on their
/// own.
pub(crate) fn exceeds_when_tested(prepared: &PreparedSearch, rival: &Fit, fit: &Fit) -> bool {
    let tested = || tested(prepared, rival.clone(), &|_| true);
    is_likelier(rival, fit) && tested().is_ok_and(|rival| is_likelier(&rival, fit))
}

/// Exchanges names for likelier ones, which a noise that changed since the search or a name that was
/// taken out may have made of them; whether it did.
pub(crate) fn exchanged(prepared: &PreparedSearch, found: &mut SearchResult) -> bool {
    let regression = &prepared.regression;
    let mut changed = false;
    for _ in 0..3 {
        let mut rivals = aliases::rivals(regression, &found.fit).into_iter();
        let fits = |r: &crate::diagnosis::evidence::rival::Rival| {
            regression.added(&r.fit).len() <= prepared.cap()
        };
        let Some(rival) = rivals.find(fits) else {
            break;
        };
        if !is_likelier(&rival.fit, &found.fit) {
            break;
        }
        found.fit = rival.fit;
        changed = true;
    }
    changed
}

/// Tests a set as it will be reported: a name that another alone exceeds in its place is replaced by it, and one with
/// which the error on unseen samples does not fall is taken out.
pub(crate) fn test_as_reported(
    prepared: &PreparedSearch,
    found: &mut SearchResult,
    watch: Watch,
) -> Result<(), Cancelled> {
    let regression = &prepared.regression;
    let base = regression.fit(&regression.base, &[]);
    // Where the budget is spent as many are exchanged as there are names, and not tested again.
    let mut in_haste = regression.added(&found.fit).len();
    loop {
        if !watch(&Progress::Comparing) {
            return Err(Cancelled);
        }
        let spent = regression.work.is_spent();
        if (!spent || in_haste > 0)
            && let Some(likelier) = one_exchanged(prepared, &found.fit)
        {
            found.fit = likelier;
            if spent {
                in_haste -= 1;
            } else {
                test(prepared, found, watch)?;
            }
            continue;
        }
        if let Some(term) = own_evidence::least_proven(prepared, &found.fit) {
            found.fit = regression.without_term(&found.fit, &term);
            continue;
        }
        // As the model keeps them: names alone.
        let alone = if found.fit.shapes.is_empty() {
            found.fit.clone()
        } else {
            regression.fit(&found.fit.model, &[])
        };
        // Of several kinds of measurement the error in mm is not all of it.
        let of_kinds = regression.rows.observed().is_some();
        let idle = |step: &Step| {
            let held_out = if of_kinds {
                step.held_out
            } else {
                step.held_out_mm
            };
            held_out.is_some_and(|h| h[1] >= h[0])
        };
        let steps = steps(prepared, &base, &alone);
        if let Some(step) = steps.into_iter().rev().find(idle) {
            found.fit = regression.without_term(&found.fit, &step.term);
        } else {
            return Ok(());
        }
    }
}

/// What would be reported where a search ends with a fit: names that are significant on their own, each likelier than
/// another in its place.
pub(crate) fn reportable(prepared: &PreparedSearch, fit: Fit) -> Option<Fit> {
    let watch: Watch = &|_| true;
    let names = fit.clone();
    let mut found = SearchResult::of(tested(prepared, fit, watch).ok()?, names);
    test_as_reported(prepared, &mut found, watch).ok()?;
    Some(found.fit)
}

/// The fit with the likeliest other name in the place of one, where that is likelier.
fn one_exchanged(prepared: &PreparedSearch, fit: &Fit) -> Option<Fit> {
    let regression = &prepared.regression;
    let likelier = regression.added(fit).into_iter().filter_map(|term| {
        let worth = worth(prepared, fit, term);
        Next::than(prepared, fit, term, &worth)?.fit
    });
    let best = likelier.max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence))?;
    is_likelier(&best, fit).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::candidates::table::CandidateKind;
    use crate::diagnosis::tests::eccentric;

    /// What is reported of a search that would have ended with this set of names.
    fn reported_of(names: &[&str]) -> Vec<&'static str> {
        let session = eccentric(15, 0.03);
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let mut fit = regression.fit(&regression.base, &[]);
        for name in names {
            let named =
                |what: &CandidateKind| what.term().is_some_and(|t| t.effect.about().id == *name);
            let candidates = &regression.table.candidates;
            let what = &candidates.iter().find(|c| named(&c.what)).unwrap().what;
            fit = regression.with(&fit, what);
        }
        let mut found = SearchResult::of(fit.clone(), fit);
        test_as_reported(&prepared, &mut found, &|_| true).unwrap();
        let added = regression.added(&found.fit);
        added.iter().map(|t| t.effect.about().id).collect()
    }

    #[test]
    fn a_name_gives_way_to_a_likelier_one() {
        assert_eq!(
            reported_of(&["encoder-two-cycle"]),
            ["encoder-eccentricity"]
        );
    }

    #[test]
    fn a_name_with_which_unseen_samples_are_predicted_no_better_is_not_said() {
        let names = ["encoder-eccentricity", "encoder-two-cycle"];
        assert_eq!(reported_of(&names), ["encoder-eccentricity"]);
    }

    #[test]
    fn what_is_right_stays() {
        let names = ["encoder-eccentricity"];
        assert_eq!(reported_of(&names), names);
    }
}
