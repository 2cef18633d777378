//! The names that a search ends with, on all samples that may be fitted: their values, the model that is handed out, and
//! its figures.

use std::borrow::Cow;

use crate::effects::Term;
use crate::fit::gap::{deviations, lengths_mm, over_fitted, suspects};
use crate::fit::problem::Problem;
use crate::observations::figures::outliers_given;

use super::handed_out;
use super::unseen::held_out;
use super::values::{Values, corrected_for_selection};
use crate::answers::diagnosis::{Gaps, HeldOut};
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::SearchResult as SearchEnd;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{Step, steps};

/// The errors of a model: over the samples that were fitted, and over those that no fit has seen.
#[derive(Clone)]
pub(super) struct Figures {
    pub(super) gap: Gaps,
    pub(super) held_out: HeldOut,
}

/// The names that a search ends with, on all samples that may be fitted.
pub(super) struct Named<'a> {
    /// The fit of the names alone, and of those that are handed out.
    pub(super) alone: Fit,
    pub(super) handed_out: Fit,
    /// The values that the verdict is about, and those that are handed out.
    pub(super) judged: Values<'a>,
    pub(super) values: Values<'a>,
    pub(super) figures: Figures,
    pub(super) steps: Vec<Step>,
    /// Names that were found and are not handed out.
    pub(super) dropped: Vec<Term>,
}

impl<'a> Named<'a> {
    pub(super) fn of(prepared: &PreparedSearch<'a>, end: &SearchEnd) -> Self {
        let regression = &prepared.regression;
        let with_shapes = &end.fit;
        let base = regression.fit(&regression.base, &[]);
        // The model has names only, as near to the samples as names can come; what no name explains is separate.
        let alone = if with_shapes.shapes.is_empty() {
            with_shapes.clone()
        } else {
            regression.fit(&with_shapes.model, &[])
        };
        let nominal_mm = lengths_mm(&prepared.problem, &prepared.nominal);
        // Unseen samples have done their part: values come from all samples that may be fitted.
        let problem = with_unlocked(prepared, with_shapes);
        let capped = prepared.is_capped(end);
        let fits = [&alone, with_shapes];
        let judged = values(prepared, &problem, fits, capped);
        let mut steps = steps(prepared, &base, &alone);
        let order: Vec<Term> = steps.iter().map(|step| step.term.clone()).collect();
        let own = handed_out::choose(prepared, &problem, fits, &judged, &order, capped);
        let start = over_fitted(&own.values.problem, &nominal_mm);
        let gap = Gaps {
            start_mm: start.map_or(0.0, |s| s.rms_mm),
            identified_mm: own.identified_mm,
            end_mm: own.end_mm,
        };
        steps.retain(|step| !own.dropped.iter().any(|d| d.same_column(&step.term)));
        meet(&mut steps, &gap);
        Self {
            handed_out: without_dropped(prepared, &alone, &own.dropped),
            figures: Figures {
                held_out: held_out(prepared, &nominal_mm, own.held_out_mm),
                gap,
            },
            values: own.values,
            dropped: own.dropped,
            alone,
            judged,
            steps,
        }
    }

    pub(super) fn is_dropped(&self, term: &Term) -> bool {
        self.dropped.iter().any(|d| d.same_column(term))
    }
}

/// One figure, one name: the first name starts from the model of `identify`, whose noise may be another than that of
/// the search, and the last one ends at the model that is handed out.
fn meet(steps: &mut [Step], gap: &Gaps) {
    if let Some(first) = steps.first_mut() {
        first.gap_mm[0] = gap.identified_mm;
    }
    if let Some(last) = steps.last_mut() {
        last.gap_mm[1] = gap.end_mm;
    }
}

/// The fit of the names that are handed out.
fn without_dropped(prepared: &PreparedSearch, fit: &Fit, dropped: &[Term]) -> Fit {
    if dropped.is_empty() {
        return fit.clone();
    }
    handed_out::without(prepared, fit, dropped)
}

/// Values of the names, from a fit of them alone or with the shapes.
fn values<'a>(
    prepared: &PreparedSearch,
    problem: &Problem<'a>,
    [alone, with_shapes]: [&Fit; 2],
    capped: bool,
) -> Values<'a> {
    // A shape over a joint of several absorbs a part of their geometry, which then predicts nothing without it.
    let several = prepared.regression.base.robot.joints.len() > 1;
    let of_kinds = problem.observed.is_some();
    let without = (several || of_kinds) && !with_shapes.shapes.is_empty();
    let own = if without { alone } else { with_shapes };
    let values = Values::of(prepared, problem, own, capped || without);
    corrected_for_selection(prepared, with_shapes, values)
}

/// All samples that may be fitted, those that an option locked away as well, without the outliers of the model.
fn with_unlocked<'p, 'a>(prepared: &'p PreparedSearch<'a>, fit: &Fit) -> Cow<'p, Problem<'a>> {
    if !prepared.locked.contains(&true) {
        return Cow::Borrowed(&*prepared.problem);
    }
    let model = &Values::of(prepared, &prepared.problem, fit, false).model;
    let mut all = (*prepared.problem).clone();
    all.take_in(&prepared.locked, |all| match &all.observed {
        Some(layer) => outliers_given(layer, model),
        None => suspects(all, &deviations(all, model)),
    });
    Cow::Owned(all)
}
