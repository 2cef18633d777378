//! The time of a step. The interval of `time_s` is that between the samples around the likeliest time; its uncertainty
//! is the posterior over all times that were tried, each as likely a priori:
//!
//! ```text
//! ln w(t) = −(m/2) ln(1 − gain(t)/RSS)
//! ```
//!
//! with the gain of a step at `t` over a fit without it, in m whitened rows (a uniform change point; Smith 1975).

use crate::effects::{Setting, Term};

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::search::Worth;
use crate::diagnosis::search::prepare::PreparedSearch;

/// The probability outside on either side.
const TAIL: f64 = 0.025;

/// Times between which the step lies with 95 %, s; `None` for an effect that is no step.
pub(crate) fn within_s(prepared: &PreparedSearch, term: &Term, worth: &Worth) -> Option<[f64; 2]> {
    let about = term.effect.about();
    if about.setting != Setting::Time {
        return None;
    }
    let regression = &prepared.regression;
    let scores = regression.scan(&worth.reduced, CandidateSubset::Names);
    let mut tried: Vec<(f64, f64)> = scores
        .iter()
        .filter_map(|score| {
            let other = regression.table.candidates[score.candidate].what.term()?;
            let same = other.effect.about().id == about.id && other.joint == term.joint;
            let share = (score.gain / worth.reduced.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-12);
            same.then(|| (other.setting, -0.5 * regression.m() * (-share).ln_1p()))
        })
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (first, last) = central(&tried)?;
    // A step can have been anywhere between the samples, or the times tried, around it.
    let clock = prepared.problem.inputs.time_s.as_deref()?;
    let sample = |found: Option<f64>, or: f64| found.unwrap_or(or);
    let before = clock.iter().copied().filter(|t| *t < tried[first].0);
    let after = clock.iter().copied().filter(|t| *t >= tried[last].0);
    let mut from = sample(before.max_by(f64::total_cmp), tried[first].0);
    let mut to = sample(after.min_by(f64::total_cmp), tried[last].0);
    if let Some(earlier) = first.checked_sub(1) {
        from = from.min(tried[earlier].0.midpoint(tried[first].0));
    }
    if let Some(later) = tried.get(last + 1) {
        to = to.max(tried[last].0.midpoint(later.0));
    }
    Some([from, to])
}

/// The first and the last of those that hold all but [`TAIL`] on either side.
fn central(tried: &[(f64, f64)]) -> Option<(usize, usize)> {
    let most = tried.iter().map(|t| t.1).max_by(f64::total_cmp)?;
    let weights: Vec<f64> = tried.iter().map(|t| (t.1 - most).exp()).collect();
    let total: f64 = weights.iter().sum();
    let outside = |in_order: &mut dyn Iterator<Item = &f64>| {
        let mut sum = 0.0;
        in_order
            .take_while(|w| {
                sum += **w;
                sum < TAIL * total
            })
            .count()
    };
    let first = outside(&mut weights.iter());
    let last = weights.len() - 1 - outside(&mut weights.iter().rev());
    (first <= last).then_some((first, last))
}

#[cfg(test)]
mod tests {
    use super::central;

    #[test]
    fn what_is_left_out_is_less_than_a_fortieth_on_either_side() {
        let sure = [(0.0, 0.0), (1.0, 50.0), (2.0, 0.0)];
        assert_eq!(central(&sure), Some((1, 1)));
        // A hundred times alike: the first two and the last two hold 2 % each, the third is needed.
        let alike: Vec<(f64, f64)> = (0..100).map(|t| (f64::from(t), 3.0)).collect();
        assert_eq!(central(&alike), Some((2, 97)));
        assert_eq!(central(&[]), None);
    }
}
