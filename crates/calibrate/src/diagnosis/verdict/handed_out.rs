//! The model that a diagnosis hands out: of the fits of a search the first whose model is no worse than that of
//! `identify`, in its RMS error and in that of samples that no fit has seen.
//!
//! A shape that no name explains is fitted together with the names, so that it does not distort their values. It is no
//! part of the model: where it contains a constant (a curve over the whole of a joint does, and a slope over a
//! temperature that is far from 20 °C) the values run away from it, and are right only together with it. So the
//! candidates are, in this order,
//!
//! 1. the values fitted with the shapes, where these change the model's error by no more than they lower
//!    the residuals themselves,
//!
//! ```text
//! e²(with shapes) − e²(names) ≤ e²(names) − e²(names and shapes)
//! ```
//!
//! 2. the values of the names alone,
//! 3. the same before their sizes were corrected for the selection,
//! 4. the same with fewer names, the last that was found left out first,
//! 5. the model of `identify` itself.
//!
//! Nor is a model better where it is worse at most samples and better at a few that are far off: rows that belong to
//! other rows have the largest deviations, and they dominate the sum of squares. Where samples were set aside and
//! nothing was found, the identification without them is handed out in place of the one with them.
//!
//! Names of several joints that cancel each other at the samples and run away over the joint ranges
//! (`run_away`) are left out as well.
//!
//! Where no name is handed out, the outliers are those of `identify`, and the noise floor that of its model.
//!
//! Every comparison is over the same samples and the same folds. Intervals are those of the fit with the shapes where
//! it may be used at all, extended to contain the value that is handed out.

use std::borrow::Cow;

use crate::effects::Term;
use crate::fit::gap::{lengths_mm, rms_mm};
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::model::Model;
use crate::numeric::median;
use crate::thresholds::{GROSS_SHARE, size_mm};

use super::divergent_terms::runs_away;
use super::unseen::{self, Procedure};
use super::values::{Values, corrected_for_selection};
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::prepare::PreparedSearch;

/// The median deviation of the model may be so many times that of `identify`: more is no scatter.
const MOST_TIMES_MEDIAN: f64 = 1.25;
/// Where nothing was found the identification without the samples set aside replaces it if the median deviation is
/// below this share of that with them: they had distorted it.
const GAINS_OF_MEDIAN: f64 = 0.9;

/// The model that is handed out.
pub(crate) struct HandedOut<'a> {
    /// Its model, values and intervals.
    pub(crate) values: Values<'a>,
    /// RMS error of the model of `identify`, mm.
    pub(crate) identified_mm: f64,
    /// RMS error of the model, mm: never above that of `identify`.
    pub(crate) end_mm: f64,
    /// Cross-validated RMS errors of both, mm; `None` with too few samples.
    pub(crate) held_out_mm: Option<[f64; 2]>,
    /// Names that were found and are not handed out, as the model is no better with them.
    pub(crate) dropped: Vec<Term>,
}

/// One way to values, with its errors.
struct WayToValues<'a> {
    values: Values<'a>,
    end_mm: f64,
    held_out_mm: Option<f64>,
}

/// Chooses. `problem` holds all samples that may be fitted; the fits are the names alone and the names with the
/// shapes; `judged` are the values that the verdict is about, with the shapes where those may be used, and `order` the
/// names in the order found.
pub(crate) fn choose<'a>(
    prepared: &PreparedSearch<'a>,
    problem: &Problem<'a>,
    [names, with_shapes]: [&Fit; 2],
    judged: &Values<'a>,
    order: &[Term],
    stopped: bool,
) -> HandedOut<'a> {
    let regression = &prepared.regression;
    let base_fit = regression.fit(&regression.base, &[]);
    let identified = identified(prepared, problem);
    let against = Against {
        prepared,
        problem,
        rms_mm: rms_mm(problem, &identified),
        median_mm: median_mm(problem, &identified),
        held_out_mm: unseen::of(prepared, &base_fit, Procedure::Identify),
    };
    let candidate = |values: Values<'a>, fit: &Fit, procedure| WayToValues {
        end_mm: rms_mm(problem, &values.model),
        held_out_mm: unseen::of_model(prepared, &values.model)
            .or_else(|| unseen::of(prepared, fit, procedure)),
        values,
    };
    let no_worse = |c: &WayToValues| against.is_no_worse(c);
    let handed_out = |own, dropped| against.handed_out(own, dropped);
    let has_shapes = judged.has_shapes();
    let found = regression.added(names).len();
    let raw = if has_shapes || judged.is_corrected() {
        Values::of(prepared, problem, names, stopped)
    } else {
        judged.clone()
    };
    let corrected = if has_shapes {
        corrected_for_selection(prepared, names, raw.clone())
    } else {
        judged.clone()
    };
    let distinguished = has_shapes && is_distinguishable(judged, &corrected);
    // Intervals of what is handed out.
    let unsure = if distinguished { judged } else { &corrected };
    if distinguished {
        let own = candidate(judged.clone(), with_shapes, Procedure::WithShapes);
        if no_worse(&own) {
            return handed_out(own, Vec::new());
        }
    }
    if found == 0 && has_set_aside(problem) {
        let own = candidate(
            corrected.clone().with_intervals_of(unsure),
            names,
            Procedure::Names,
        );
        if against.gains(&own) {
            // Unseen samples are predicted by the same procedure, without the others.
            return HandedOut {
                held_out_mm: own.held_out_mm.map(|own| [own, own]),
                ..handed_out(own, Vec::new())
            };
        }
    }
    if found > 0 {
        for values in [corrected.clone(), raw] {
            let own = candidate(values.with_intervals_of(unsure), names, Procedure::Names);
            if no_worse(&own) {
                return handed_out(own, Vec::new());
            }
        }
    }
    for kept in (1..order.len().min(found)).rev() {
        let dropped = &order[kept..];
        let fewer = without(prepared, names, dropped);
        let values = Values::of(prepared, problem, &fewer, stopped);
        let values = corrected_for_selection(prepared, &fewer, values);
        let own = candidate(values, &fewer, Procedure::Names);
        if no_worse(&own) {
            return handed_out(own, dropped.to_vec());
        }
    }
    let problem = &if found == 0 {
        Cow::Borrowed(problem)
    } else {
        counted_as_by_identify(prepared, problem)
    };
    let of_base = if found == 0 {
        unsure.clone()
    } else {
        Values::of(prepared, problem, &base_fit, stopped)
    };
    let all = regression.added(names).into_iter().cloned().collect();
    let of_names = || Values::of(prepared, problem, &base_fit, stopped);
    let values = of_base.at(&identified).unwrap_or_else(of_names);
    let own = WayToValues {
        end_mm: rms_mm(problem, &values.model),
        held_out_mm: against.held_out_mm,
        values,
    };
    HandedOut {
        // The same model: both have the same residuals.
        identified_mm: own.end_mm,
        ..handed_out(own, all)
    }
}

/// The reference of a way to values: the model of `identify`, over the same samples and folds.
struct Against<'p, 'a> {
    prepared: &'p PreparedSearch<'a>,
    problem: &'p Problem<'a>,
    rms_mm: f64,
    median_mm: f64,
    /// Cross-validated RMS error; `None` with too few samples.
    held_out_mm: Option<f64>,
}

impl<'a> Against<'_, 'a> {
    fn is_no_worse(&self, own: &WayToValues) -> bool {
        let (model, problem) = (&own.values.model, self.problem);
        let held_out = match (own.held_out_mm, self.held_out_mm) {
            (Some(own), Some(identified)) => own <= identified,
            _ => true,
        };
        let has_names = model.terms().len() > self.prepared.regression.base.terms().len();
        let gross = has_names && own.end_mm > GROSS_SHARE * size_mm(problem.session);
        held_out
            && !gross
            && own.end_mm <= self.rms_mm
            && median_mm(problem, model) <= MOST_TIMES_MEDIAN * self.median_mm
            && runs_away(problem, model).is_none()
    }

    /// Whether the identification without the samples set aside shows that they had distorted it.
    fn gains(&self, own: &WayToValues) -> bool {
        let median_mm = median_mm(self.problem, &own.values.model);
        own.end_mm < self.rms_mm && median_mm < GAINS_OF_MEDIAN * self.median_mm
    }

    fn handed_out(&self, own: WayToValues<'a>, dropped: Vec<Term>) -> HandedOut<'a> {
        HandedOut {
            values: own.values,
            identified_mm: self.rms_mm,
            end_mm: own.end_mm,
            held_out_mm: own
                .held_out_mm
                .zip(self.held_out_mm)
                .map(|(end, id)| [id, end]),
            dropped,
        }
    }
}

/// The model of `identify` on all samples that may be fitted.
fn identified(prepared: &PreparedSearch, problem: &Problem) -> Model {
    if prepared.locked.contains(&true) {
        let mut plain = problem.clone();
        plain.noise = None;
        return solve(&plain, &prepared.base).model;
    }
    prepared.base.clone()
}

/// The problem with only those samples set aside that `identify` sets aside: an outlier of a fit with names that are
/// not handed out need not be one without them.
fn counted_as_by_identify<'p, 'a>(
    prepared: &PreparedSearch,
    problem: &'p Problem<'a>,
) -> Cow<'p, Problem<'a>> {
    if problem.observed.is_some() || prepared.locked.contains(&true) {
        return Cow::Borrowed(problem);
    }
    let mut now = problem.clone();
    now.set_counted(prepared.as_identified.counted().to_vec());
    Cow::Owned(now)
}

/// Whether any sample was set aside as a suspected outlier.
fn has_set_aside(problem: &Problem) -> bool {
    let samples = problem.to_fit().iter().zip(problem.counted());
    samples
        .into_iter()
        .any(|(to_fit, counted)| *to_fit && !*counted)
}

/// The median deviation over the same samples, mm.
fn median_mm(problem: &Problem, model: &Model) -> f64 {
    let residual_mm = lengths_mm(problem, model);
    let samples = residual_mm.iter().zip(&problem.used);
    let used = samples.filter(|(_, used)| **used);
    median(used.map(|(mm, _)| *mm)).unwrap_or(0.0)
}

/// Whether shapes can be distinguished from the model that they were fitted with: they raise its error by no more than
/// they lower the residuals beyond all that the model can do itself.
fn is_distinguishable(with_shapes: &Values, names: &Values) -> bool {
    let square = |mm: f64| mm * mm;
    let alone = square(names.rms_mm());
    let taken = square(with_shapes.rms_mm()) - alone;
    let shown = alone - square(with_shapes.rms_with_shapes_mm());
    taken <= shown
}

/// The fit of a set of names without some of them.
pub(crate) fn without(prepared: &PreparedSearch, names: &Fit, dropped: &[Term]) -> Fit {
    let is_dropped = |term: &Term| dropped.iter().any(|d| d.same_column(term));
    let model = names.model.without(is_dropped);
    prepared.regression.fit(&model, &[])
}
