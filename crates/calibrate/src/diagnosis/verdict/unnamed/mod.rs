//! What predicts poses that no fit has seen and has no name.
//!
//! A name is said for what is proven; a model that is handed out holds whatever predicts. After the
//! search, whatever names are left, a rest is fitted beside the geometry and the names of a robot with
//! several joints: gravity, conditions, harmonics, smooth curves, gear orders ([`families`]), each family
//! with a strength that the samples set and shrunk to nothing where it brings nothing ([`strengths`]).
//! It is added only where it predicts cells of the workspace better, by more than noise does.

mod design;
mod families;
mod orders;
mod products;
mod strengths;

use crate::effects::Term;
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::text::Text;

use super::named::Figures;
use super::unseen;
use super::values::Values;
use crate::answers::diagnosis::Unnamed;
use crate::diagnosis::search::prepare::PreparedSearch;
use design::Design;
/// The gain on unseen samples has to be so many times its own standard deviation …
const SURE: f64 = 2.5;
/// … or so many where the samples are so much likelier with it, as a logarithm, that no noise does that: of few
/// samples a few that were far off make the gain of all uncertain …
const SURE_ENOUGH: f64 = 1.5;
const BEYOND_DOUBT: f64 = 50.0;
/// … and this share of the error at least.
const WORTH: f64 = 0.005;
/// No family: the samples have to be so much likelier with all of them, as a logarithm.
const LIKELIER: f64 = 6.0;

/// Values with what predicts without a name, where it does, and their figures.
pub(super) fn beside<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    figures: &Figures,
) -> Option<(Values<'a>, Figures, Unnamed)> {
    let arm = base_model::is_arm(values.problem.session);
    let options = prepared.options();
    if options.without_unnamed || options.names_one_by_one || !arm {
        return None;
    }
    let mut now = figures.clone();
    let gaps = now.held_out.gaps.as_mut()?;
    let found = fitted(prepared, &values.problem, &values.model)?;
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
        fitted(prepared, &seen.problem, &seen.model)?.terms
    } else {
        found.terms.clone()
    };
    let rms = |terms: &[Term]| {
        let model = seen.with_unnamed(terms).model;
        unseen::rms_apart_mm(prepared, &lengths_mm(&prepared.problem, &model))
    };
    Some(rms(&terms) / rms(&[]).max(f64::MIN_POSITIVE))
}

/// What predicts, fitted to some samples.
struct FittedFamilies {
    terms: Vec<Term>,
    /// In cells of the workspace, without and with it, mm.
    held_out_mm: [f64; 2],
    over: Vec<Text>,
}

fn fitted(prepared: &PreparedSearch, problem: &Problem, model: &Model) -> Option<FittedFamilies> {
    let mut design = Design::new(
        problem,
        &prepared.regression.noise,
        model,
        prepared.regression.threads,
    )?;
    let mut strengths = design.strengths()?;
    while let Some((joint, order)) = design.next_order(&strengths.0) {
        design.add_order(joint, order);
        strengths = design.strengths()?;
    }
    let (mut strengths, likelier) = strengths;
    if likelier < LIKELIER {
        return None;
    }
    // A family that does not help on unseen cells goes.
    let unseen = design.unseen()?;
    let mut gains = unseen.gains(&strengths)?;
    for family in 0..strengths.len() {
        if strengths[family] > 0.0 {
            let mut without = strengths.clone();
            without[family] = 0.0;
            let rest = unseen.gains(&without);
            if let Some(rest) = rest.filter(|rest| rest.after_mm <= gains.after_mm) {
                (strengths, gains) = (without, rest);
            }
        }
    }
    let worth = gains.after_mm < (1.0 - WORTH) * gains.before_mm;
    let sure = if likelier > BEYOND_DOUBT {
        SURE_ENOUGH
    } else {
        SURE
    };
    if !worth || gains.sigmas < sure || !gains.after_mm.is_finite() {
        return None;
    }
    let (terms, over) = design.terms(&strengths)?;
    Some(FittedFamilies {
        terms,
        held_out_mm: [gains.before_mm, gains.after_mm],
        over,
    })
}
