//! The gap on samples that no fit has seen: those that the session or an option marks, else
//! cross-fitted.

use crate::fit::base_model;
use crate::fit::gap::{Deviations, Spread, deviations};

use super::prepare::Prepared;
use super::regression::Fit;
use super::values::Values;
use crate::answers::diagnosis::{Gaps, HeldOut};

pub(crate) fn held_out(
    prepared: &Prepared,
    base: &Fit,
    fit: &Fit,
    nominal: &Deviations,
) -> HeldOut {
    let regression = &prepared.regression;
    let problem = &prepared.problem;
    let by_file = problem.session.samples.held_out.as_deref();
    let apart =
        |i: usize| problem.usable[i] && (prepared.locked[i] || by_file.is_some_and(|h| h[i]));
    let count = (0..problem.usable.len()).filter(|i| apart(*i)).count();
    if count > 0 {
        let how = if prepared.locked.contains(&true) && base_model::is_arm(problem.session) {
            "cells of the workspace that were locked away from everything"
        } else if prepared.locked.contains(&true) {
            "sectors of joint 1 that were locked away from everything"
        } else {
            "the samples that the session marks as held out; no fit touched them"
        };
        let rms = |d: &Deviations| {
            // Samples far off are suspected here as they are elsewhere.
            let mut lengths: Vec<f64> = (0..d.length_mm.len())
                .filter(|i| apart(*i))
                .map(|i| d.length_mm[i])
                .filter(|length| !length.is_nan())
                .collect();
            lengths.sort_by(f64::total_cmp);
            if lengths.is_empty() {
                return 0.0;
            }
            let limit = 5.0 * lengths[lengths.len() / 2];
            let spread = Spread::of(&d.length_mm, apart, |i| {
                count >= 8 && d.length_mm[i] > limit
            });
            spread.map_or(0.0, |s| s.rms_mm)
        };
        let seen = |fit: &Fit| Values::of(prepared, problem, fit, false).model;
        return HeldOut {
            how: how.to_owned(),
            samples: count,
            gaps: Some(Gaps {
                start_mm: rms(nominal),
                identified_mm: rms(&deviations(problem, &prepared.base)),
                end_mm: rms(&deviations(problem, &seen(fit))),
            }),
        };
    }
    if !prepared.folds.say_something() {
        return HeldOut {
            how: "too few samples to hold any out".to_owned(),
            samples: 0,
            gaps: None,
        };
    }
    let rows = &regression.rows;
    let (raw, _) = rows.extract(&prepared.nominal);
    // What a fit of names alone predicts; a shape beside them is not part of the model.
    HeldOut {
        how: prepared.folds.how.clone(),
        samples: rows.lengths(),
        gaps: Some(Gaps {
            start_mm: rows.rms_mm(&raw),
            identified_mm: prepared.folds.rms_mm(regression, base),
            end_mm: prepared.folds.rms_mm(regression, fit),
        }),
    }
}
