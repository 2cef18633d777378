//! What predicts without a name on a robot with several joints: gravity, conditions, harmonics, smooth curves, gear
//! orders ([`families`](super::families)), each family with a strength that the samples set and shrunk to nothing where
//! it brings nothing ([`groups`](super::groups)). It is there only where it predicts cells of the workspace better, by
//! more than noise does.

use crate::effects::Term;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::side_by_side::Threads;
use crate::text::Text;

use super::design::Design;
use super::{BEYOND_DOUBT, LIKELIER};

/// The gain on unseen samples has to be so many times its own standard deviation …
const SURE: f64 = 2.5;
/// … or so many where the samples are beyond doubt: of few samples a few that were far off make the gain of all
/// uncertain …
const SURE_ENOUGH: f64 = 1.5;
/// … and this share of the error at least.
const WORTH: f64 = 0.005;

/// What predicts, fitted to some samples.
pub(crate) struct FittedFamilies {
    pub(crate) terms: Vec<Term>,
    /// In cells of the workspace, without and with it, mm.
    pub(crate) held_out_mm: [f64; 2],
    pub(crate) over: Vec<Text>,
}

/// The families that predict beside a model and a noise, if any do.
pub(crate) fn fitted(
    problem: &Problem,
    noise: &Noise,
    model: &Model,
    threads: Threads,
) -> Option<FittedFamilies> {
    let mut design = Design::new(problem, noise, model, threads)?;
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
    let mut gains = design.gains(&unseen, &strengths)?;
    for family in 0..strengths.len() {
        if strengths[family] > 0.0 {
            let mut without = strengths.clone();
            without[family] = 0.0;
            let rest = design.gains(&unseen, &without);
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
