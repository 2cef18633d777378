//! Names that imitate one that a run leaves out (`--without`). What that name would explain as well is not explained
//! by the other alone: the answer reports it as unexplained.

use crate::diagnosis::search::NEEDED;
use crate::effects::{CATALOGUE, Effect, Term, form_in};
use crate::fit::scan;

use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;

/// A name that is reported, and one that was left out and explains as much.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StandIn {
    pub(crate) named: String,
    pub(crate) withheld: &'static str,
}

/// The first name of a fit in whose place one that was left out is as likely.
pub(crate) fn stand_in(prepared: &PreparedSearch, fit: &Fit) -> Option<StandIn> {
    let allowed = &prepared.options().allowed;
    let withheld = || CATALOGUE.iter().filter(|e| !allowed.exists(e.about().id));
    withheld().next()?;
    let regression = &prepared.regression;
    regression.added(fit).into_iter().find_map(|term| {
        let reduced = regression.without_term(fit, term);
        let as_likely = |effect: &&&'static Effect| {
            // What a name becomes in the limit is no other name.
            effect.about().family() != term.effect.about().family()
                && evidence_with(prepared, &reduced, effect)
                    .is_some_and(|with| with > fit.ln_evidence - NEEDED)
        };
        let other = withheld().find(as_likely)?;
        Some(StandIn {
            named: term.name_on(&regression.base.robot),
            withheld: other.about().id,
        })
    })
}

/// The largest evidence of a fit with an effect more, over its joints and settings.
fn evidence_with(prepared: &PreparedSearch, reduced: &Fit, effect: &'static Effect) -> Option<f64> {
    let (regression, survey) = (&prepared.regression, &prepared.survey);
    let about = effect.about();
    let joints = if about.per_joint {
        survey.joints.len()
    } else {
        1
    };
    let of_joint = |joint: usize| -> Option<f64> {
        let exists = (effect.exists_on)(joint, survey.joints[joint].kind);
        if !exists || effect.obstacle(survey, joint).is_some() {
            return None;
        }
        let term = Term::absent(form_in(effect, survey, joint), joint, 0.0);
        let settings = scan::settings(&regression.problem, &term);
        let tried = (settings.len() as f64).max(1.0);
        let at = |setting: f64| Term {
            setting,
            ..term.clone()
        };
        let best = best_of(regression, reduced, settings.into_iter().map(at))?;
        Some(
            regression
                .fit(&reduced.model.with_term(best), &reduced.shapes)
                .ln_evidence
                - tried.ln(),
        )
    };
    (0..joints).filter_map(of_joint).max_by(f64::total_cmp)
}

/// The term that would lower the sum of squares most.
fn best_of(
    regression: &Regression,
    reduced: &Fit,
    terms: impl Iterator<Item = Term>,
) -> Option<Term> {
    let there = |t: &Term| reduced.model.terms().iter().any(|o| o.same_column(t));
    let gains = terms
        .filter(|t| !there(t))
        .map(|t| (regression.gain_of_term(reduced, &t), t));
    let best = gains.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(best.1)
}
