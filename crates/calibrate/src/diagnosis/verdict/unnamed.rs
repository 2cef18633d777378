//! The rest that has no name and predicts poses that no fit has seen.
//!
//! A name is reported where it is proven; a model that is handed out contains whatever predicts. After the search, a
//! smooth rest is fitted in addition to the geometry and the names of a robot with several joints, or of a single one
//! that carries several reflectors: these show how it is turned ([`crate::diagnosis::rest`]).

use crate::effects::Term;
use crate::fit::base_model;
use crate::fit::gap::{lengths_mm, rms_mm};
use crate::model::Model;

use super::named::Figures;
use super::repeating::sets_many_aside;
use super::unseen;
use super::values::Values;
use crate::answers::diagnosis::Unnamed;
use crate::diagnosis::rest::arm::{self, FittedFamilies};
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{is_gross, size_mm};

/// Values with what predicts without a name, where it does, and their figures; `curve` is that over a single joint, in
/// addition to which it predicts.
pub(super) fn with_rest<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    figures: &Figures,
    curve: Option<&Term>,
) -> Option<(Values<'a>, Figures, Unnamed)> {
    let problem = &values.problem;
    let arm = base_model::is_arm(problem.session);
    if prepared.options().without_unnamed || !arm && problem.inputs.reflector_places() < 2 {
        return None;
    }
    // No single joint turns what it carries so far: what is gross is of the rows or of the set-up.
    let left_mm = rms_mm(problem, &beside(&values.model, curve));
    if !arm && (is_gross(left_mm, size_mm(prepared)) || sets_many_aside(problem)) {
        return None;
    }
    let mut now = figures.clone();
    let gaps = now.held_out.gaps.as_mut()?;
    let found = fitted(prepared, values, curve)?;
    let share = share_unseen(prepared, values, &found, curve)?;
    let held_out_mm = [gaps.end_mm, gaps.end_mm * share];
    let with = values.with_unnamed(&found.terms, curve);
    let rms = |model: &Model| rms_mm(problem, &beside(model, curve));
    let [before, after] = [&values.model, &with.model].map(rms);
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
fn share_unseen(
    prepared: &PreparedSearch,
    values: &Values,
    found: &FittedFamilies,
    curve: Option<&Term>,
) -> Option<f64> {
    if !unseen::held_out_samples(prepared).contains(&true) {
        return Some(found.held_out_mm[1] / found.held_out_mm[0]);
    }
    let seen = values.on(&prepared.problem);
    let terms = if prepared.locked.contains(&true) {
        fitted(prepared, &seen, curve)?.terms
    } else {
        found.terms.clone()
    };
    let rms = |terms: &[Term]| {
        let model = beside(&seen.with_unnamed(terms, curve).model, curve);
        unseen::rms_apart_mm(prepared, &lengths_mm(&prepared.problem, &model))
    };
    Some(rms(&terms) / rms(&[]).max(f64::MIN_POSITIVE))
}

fn fitted(
    prepared: &PreparedSearch,
    values: &Values,
    curve: Option<&Term>,
) -> Option<FittedFamilies> {
    let regression = &prepared.regression;
    let (noise, threads) = (&regression.noise, regression.threads);
    arm::fitted(
        &values.problem,
        noise,
        &beside(&values.model, curve),
        threads,
    )
}

/// A model with a curve in it.
fn beside(model: &Model, curve: Option<&Term>) -> Model {
    curve.map_or_else(|| model.clone(), |curve| model.with_term(curve.clone()))
}
