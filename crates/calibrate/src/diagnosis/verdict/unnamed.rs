//! The rest that has no name and predicts poses that no fit has seen.
//!
//! A name is reported where it is proven; a model that is handed out contains whatever predicts. After the search, a
//! smooth rest is fitted in addition to the geometry and the names of a robot with several joints
//! ([`crate::diagnosis::rest`]).

use crate::effects::Term;
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;

use super::named::Figures;
use super::unseen;
use super::values::Values;
use crate::answers::diagnosis::Unnamed;
use crate::diagnosis::rest::arm::{self, FittedFamilies};
use crate::diagnosis::search::prepare::PreparedSearch;
/// Values with what predicts without a name, where it does, and their figures.
pub(super) fn with_rest<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    figures: &Figures,
) -> Option<(Values<'a>, Figures, Unnamed)> {
    let arm = base_model::is_arm(values.problem.session);
    let options = prepared.options();
    if options.without_unnamed || !arm {
        return None;
    }
    let mut now = figures.clone();
    let gaps = now.held_out.gaps.as_mut()?;
    let found = fitted(prepared, values)?;
    let share = share_unseen(prepared, values, &found)?;
    let held_out_mm = [gaps.end_mm, gaps.end_mm * share];
    let with = values.with_unnamed(&found.terms);
    let [before, after] = [values.rms_mm(), with.rms_mm()];
    let end_mm = now.gap.end_mm - before + after;
    let better = after < before && end_mm <= now.gap.identified_mm;
    if !better || share >= 1.0 || held_out_mm[1] > gaps.identified_mm {
        return None;
    }
    now.gap.end_mm = end_mm;
    gaps.end_mm = held_out_mm[1];
    let unnamed = Unnamed {
        rms_mm: (before * before - after * after).max(0.0).sqrt(),
        held_out_mm,
        over: found.over,
        curve: None,
    };
    Some((with, now, unnamed))
}

/// The error on unseen samples with it as a share of that without it; `None` where there is none to add
/// without samples that are locked away.
fn share_unseen(prepared: &PreparedSearch, values: &Values, found: &FittedFamilies) -> Option<f64> {
    if !unseen::held_out_samples(prepared).contains(&true) {
        return Some(found.held_out_mm[1] / found.held_out_mm[0]);
    }
    let seen = values.on(&prepared.problem);
    let terms = if prepared.locked.contains(&true) {
        fitted(prepared, &seen)?.terms
    } else {
        found.terms.clone()
    };
    let rms = |terms: &[Term]| {
        let model = seen.with_unnamed(terms).model;
        unseen::rms_apart_mm(prepared, &lengths_mm(&prepared.problem, &model))
    };
    Some(rms(&terms) / rms(&[]).max(f64::MIN_POSITIVE))
}

fn fitted(prepared: &PreparedSearch, values: &Values) -> Option<FittedFamilies> {
    let regression = &prepared.regression;
    let (noise, threads) = (&regression.noise, regression.threads);
    arm::fitted(&values.problem, noise, &values.model, threads)
}
