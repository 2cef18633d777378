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
    if let Some(apart) = apart(prepared) {
        let how = if prepared.locked.contains(&true) && base_model::is_arm(problem.session) {
            "cells of the workspace that were locked away from everything"
        } else if prepared.locked.contains(&true) {
            "sectors of joint 1 that were locked away from everything"
        } else {
            "the samples that the session marks as held out; no fit touched them"
        };
        let rms = |d: &Deviations| rms_apart(d, &apart);
        let seen = |fit: &Fit| Values::of(prepared, problem, fit, false).model;
        return HeldOut {
            how: how.to_owned(),
            samples: apart.iter().filter(|a| **a).count(),
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

/// The samples that no fit has seen, as the session or an option marks them; `None` where none is.
pub(super) fn apart(prepared: &Prepared) -> Option<Vec<bool>> {
    let problem = &prepared.problem;
    let by_file = problem.session.samples.held_out.as_deref();
    let apart =
        |i: usize| problem.usable[i] && (prepared.locked[i] || by_file.is_some_and(|h| h[i]));
    let all: Vec<bool> = (0..problem.usable.len()).map(apart).collect();
    all.contains(&true).then_some(all)
}

/// Root mean square length of these samples' deviations, mm; samples far off are suspected here as they are
/// elsewhere.
pub(super) fn rms_apart(d: &Deviations, apart: &[bool]) -> f64 {
    let own = d.length_mm.iter().zip(apart);
    let mut lengths: Vec<f64> = own.filter(|(_, a)| **a).map(|(l, _)| *l).collect();
    let Some(middle) = lengths.len().checked_sub(1).map(|last| last.div_ceil(2)) else {
        return 0.0;
    };
    lengths.sort_by(f64::total_cmp);
    let limit = 5.0 * lengths[middle];
    let far = |i: usize| lengths.len() >= 8 && d.length_mm[i] > limit;
    Spread::of(&d.length_mm, |i| apart[i], far).map_or(0.0, |s| s.rms_mm)
}
