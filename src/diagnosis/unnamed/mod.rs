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
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::model::Model;

use super::prepare::Prepared;
use super::regression::Fit;
use super::values::Values;
use crate::answers::diagnosis::{Gaps, HeldOut, Unnamed};
use design::Design;

/// Below this number of rows beyond what the geometry takes nothing is said.
const FEWEST_ROWS: usize = 60;
/// The gain on unseen samples has to be so many times its own standard deviation …
const SURE: f64 = 2.5;
/// … and this share of the error at least.
const WORTH: f64 = 0.005;
/// No family: the samples have to be so much likelier with all of them, as a logarithm.
const LIKELIER: f64 = 6.0;

/// Adds what predicts without a name to the values of a fit; the gaps with it take the place of those of the
/// names alone.
pub(super) fn add(
    prepared: &Prepared,
    fit: &Fit,
    values: &mut Values,
    gap: &mut Gaps,
    held_out: &mut HeldOut,
) -> Option<Unnamed> {
    let wanted = !prepared.options().without_unnamed && base_model::is_arm(values.problem.session);
    let found = wanted.then(|| fitted(prepared, &values.problem, &values.model))??;
    let held = unseen(prepared, fit, held_out, &found)?;
    let rms_before = values.rms_mm();
    let before = values.clone();
    values.take_unnamed(&found.terms);
    let after = values.rms_mm();
    let left = (rms_before * rms_before - after * after).max(0.0).sqrt();
    let end = gap.end_mm - rms_before + after;
    if after >= rms_before || end > gap.identified_mm {
        *values = before;
        return None;
    }
    gap.end_mm = end;
    if let Some(gaps) = &mut held_out.gaps {
        gaps.end_mm = held[1];
    }
    Some(Unnamed {
        rms_mm: left,
        held_out_mm: held,
        over: found.over,
    })
}

/// Errors on unseen samples without and with it, mm; `None` where it does not help there.
fn unseen(prepared: &Prepared, fit: &Fit, held_out: &HeldOut, found: &Fitted) -> Option<[f64; 2]> {
    let gaps = held_out.gaps?;
    let problem = &prepared.problem;
    let Some(apart) = super::unseen::apart(prepared) else {
        // The folds of the search, where it looked at all samples, else those of more of them.
        let end = gaps.end_mm * found.held_out_mm[1] / found.held_out_mm[0];
        return (end <= gaps.identified_mm).then_some([gaps.end_mm, end]);
    };
    let seen = |model: &Model| super::unseen::rms_apart(&deviations(problem, model), &apart);
    let mut values = Values::of(prepared, problem, fit, false);
    let before = seen(&values.model);
    let terms = if prepared.locked.contains(&true) {
        fitted(prepared, problem, &values.model)?.terms
    } else {
        found.terms.clone()
    };
    values.take_unnamed(&terms);
    let after = seen(&values.model);
    let end = gaps.end_mm * after / before.max(f64::MIN_POSITIVE);
    (after < before && end <= gaps.identified_mm).then_some([gaps.end_mm, end])
}

/// What predicts, fitted to some samples.
struct Fitted {
    terms: Vec<Term>,
    /// In cells of the workspace, without and with it, mm.
    held_out_mm: [f64; 2],
    over: Vec<String>,
}

fn fitted(prepared: &Prepared, problem: &Problem, model: &Model) -> Option<Fitted> {
    let mut design = Design::new(problem, &prepared.regression.noise, model)?;
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
    let mut gains = design.gains(&strengths)?;
    for family in 0..strengths.len() {
        if strengths[family] > 0.0 {
            let mut without = strengths.clone();
            without[family] = 0.0;
            let rest = design.gains(&without);
            if let Some(rest) = rest.filter(|rest| rest.after_mm <= gains.after_mm) {
                (strengths, gains) = (without, rest);
            }
        }
    }
    let worth = gains.after_mm < (1.0 - WORTH) * gains.before_mm;
    if !worth || gains.sigmas < SURE || !gains.after_mm.is_finite() {
        return None;
    }
    let (terms, over) = design.terms(&strengths)?;
    Some(Fitted {
        terms,
        held_out_mm: [gains.before_mm, gains.after_mm],
        over,
    })
}
