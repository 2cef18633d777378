//! The RMS error on samples that no fit has seen: those that the session or an option marks, else
//! cross-fitted.

use crate::fewest;
use crate::fit::base_model;
use crate::fit::gap::{Spread, lengths_mm};
use crate::model::Model;

use super::values::Values;
use crate::answers::diagnosis::{Gaps, HeldOut};
use crate::diagnosis::evidence::{Fit, Folds, Regression};
use crate::diagnosis::search::prepare::PreparedSearch;

/// The procedure by which a fit becomes the model that predicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Procedure {
    /// As `identify` does it.
    Identify,
    /// Its names alone.
    Names,
    /// Its names, with its shapes fitted with them; the shapes predict nothing.
    WithShapes,
}

/// RMS error of a fit on unseen samples, mm; `None` with too few of them.
pub(crate) fn of(prepared: &PreparedSearch, fit: &Fit, procedure: Procedure) -> Option<f64> {
    let problem = &prepared.problem;
    if held_out_samples(prepared).contains(&true) {
        let model = match procedure {
            Procedure::Identify => prepared.base.clone(),
            Procedure::Names | Procedure::WithShapes => {
                Values::of(prepared, problem, fit, false).model
            }
        };
        return Some(rms_apart_mm(prepared, &lengths_mm(problem, &model)));
    }
    let of_folds = |folds: &Folds, regression: &Regression, fit: &Fit| match procedure {
        Procedure::WithShapes => folds.rms_mm_of_the_model(regression, fit),
        Procedure::Identify | Procedure::Names => folds.rms_mm(regression, fit),
    };
    let enough = prepared.folds.are_enough();
    enough.then(|| prepared.unseen_mm(fit, of_folds))
}

/// The same of a finished model, where the session holds samples out that no fit has seen.
pub(crate) fn of_model(prepared: &PreparedSearch, model: &Model) -> Option<f64> {
    let only_by_file =
        !prepared.locked.contains(&true) && held_out_samples(prepared).contains(&true);
    only_by_file.then(|| rms_apart_mm(prepared, &lengths_mm(&prepared.problem, model)))
}

/// Samples that a session or an option holds out.
pub(crate) fn held_out_samples(prepared: &PreparedSearch) -> Vec<bool> {
    let problem = &prepared.problem;
    let by_file = problem.session.samples.held_out.as_deref();
    let is_apart =
        |i: usize| problem.usable[i] && (prepared.locked[i] || by_file.is_some_and(|h| h[i]));
    (0..problem.usable.len()).map(is_apart).collect()
}

/// Whether the error on unseen samples is cross-validated.
pub(super) fn is_cross_fitted(prepared: &PreparedSearch) -> bool {
    !held_out_samples(prepared).contains(&true)
}

/// RMS residual of the held-out samples, mm; outliers are suspected here as they are elsewhere.
pub(super) fn rms_apart_mm(prepared: &PreparedSearch, residual_mm: &[f64]) -> f64 {
    let apart = held_out_samples(prepared);
    let mut lengths: Vec<f64> = (0..apart.len())
        .filter(|i| apart[*i])
        .map(|i| residual_mm[i])
        // Of a row that measures no length.
        .filter(|length| !length.is_nan())
        .collect();
    lengths.sort_by(f64::total_cmp);
    let count = lengths.len();
    let limit = 5.0 * lengths.get(count / 2).copied().unwrap_or(f64::NAN);
    let spread = Spread::of(
        residual_mm,
        |i| apart[i],
        |i| count >= fewest::TO_JUDGE && residual_mm[i] > limit,
    );
    spread.map_or(0.0, |s| s.rms_mm)
}

/// The errors on unseen samples; `found_mm` are those after identification and with what was found.
pub(crate) fn held_out(
    prepared: &PreparedSearch,
    nominal_mm: &[f64],
    found_mm: Option<[f64; 2]>,
) -> HeldOut {
    let regression = &prepared.regression;
    let problem = &prepared.problem;
    let gaps = |start_mm: f64| {
        found_mm.map(|[identified_mm, end_mm]| Gaps {
            start_mm,
            identified_mm,
            end_mm,
        })
    };
    let count = held_out_samples(prepared)
        .into_iter()
        .filter(|apart| *apart)
        .count();
    if count > 0 {
        let how = if prepared.locked.contains(&true) && base_model::is_arm(problem.session) {
            text!("cells of the workspace that were held out of every step")
        } else if prepared.locked.contains(&true) {
            text!("sectors of joint 1 that were held out of every step")
        } else {
            text!("the samples that the session marks as held out; no fit touched them")
        };
        return HeldOut {
            how,
            samples: count,
            gaps: gaps(rms_apart_mm(prepared, nominal_mm)),
        };
    }
    if !prepared.folds.are_enough() {
        return HeldOut::none(text!("too few samples to hold any out"));
    }
    if !prepared.folds.predict_poses {
        return HeldOut::none(text!("the robot was in too few poses to hold any out"));
    }
    let rows = &regression.rows;
    let (raw, _) = rows.extract(&prepared.nominal);
    HeldOut {
        how: prepared.folds.how.clone(),
        samples: rows.lengths(),
        gaps: gaps(rows.rms_mm(&raw)),
    }
}
