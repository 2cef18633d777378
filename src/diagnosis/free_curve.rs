//! A free curve over a joint as the rival of every sum of names that follow nothing but its value:
//! a kink, levels by sector or a chirp can be made up of enough harmonics, and are none.
//!
//! The curve is a Gaussian process along the joint's motion, along its radius and along its axis
//! ([`super::smooth`]); its likelihood, with the curve integrated out, stands beside that of the
//! names. Where it is likelier, the names that only make it up are withdrawn.

use crate::effects::{Over, Term};

use super::prepare::Prepared;
use super::regression::{Fit, PRICE_OF_A_NAME, Regression};
use super::search::Found;
use super::smooth;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// What the curve pays: as a name for being there, and a factor of e for each of its numbers (length,
/// size, roughness). Names are as many as they are; no further preference is needed.
const PRICE: f64 = PRICE_OF_A_NAME + 3.0;
/// The names that a curve may stand for are at least so many columns: fewer are simpler than a curve.
const FEWEST_COLUMNS: usize = 3;
/// Pieces of the curve that takes the names' place in the fit, at most.
const MOST_PIECES: usize = 60;

/// Holds a free curve over each joint against the names; where it is likelier it takes their place.
pub(crate) fn rival(prepared: &Prepared, found: &mut Found) {
    let regression = &prepared.regression;
    for joint in 0..prepared.survey.joints.len() {
        let fit = &found.fit;
        let made_up: Vec<Term> = regression
            .added(fit)
            .into_iter()
            .filter(|t| follows_only(t, joint))
            .cloned()
            .collect();
        let columns: usize = made_up
            .iter()
            .map(|t| t.coefficients.len() + settings(t))
            .sum();
        let over_joint = |s: &super::regression::Placed| s.shape.variable == Variable::Joint(joint);
        let shapes = fit.shapes.iter().filter(|s| over_joint(s)).count();
        if columns < FEWEST_COLUMNS && shapes == 0 || made_up.is_empty() {
            continue;
        }
        let model = fit
            .model
            .without(|t| made_up.iter().any(|m| m.same_column(t)));
        let kept = fit.shapes.iter().filter(|s| !over_joint(s)).cloned();
        let rest = regression.fit(&model, kept.collect());
        let Some(curve) = smooth::free_curve(prepared, &rest.model, joint) else {
            continue;
        };
        let likelihood = rest.ln_evidence + curve.ln_odds - PRICE;
        if likelihood > fit.ln_evidence {
            let pieces = curve.freedom.clamp(4, MOST_PIECES);
            found.fit = with_curve(regression, &rest, joint, pieces, likelihood);
        }
    }
}

/// The free curve that takes the place of a slow part of the noise, beside the names that do not
/// follow the same joint: what comes back at the same value of the joint is no frame that wanders,
/// however quickly both change. `None` where no curve is as likely as what was found.
pub(crate) fn instead_of_slow(white: &Prepared, found: &Found) -> Option<Found> {
    let regression = &white.regression;
    let mut best: Option<Fit> = None;
    for joint in 0..white.survey.joints.len() {
        let made_up: Vec<Term> = regression
            .added(&found.fit)
            .into_iter()
            .filter(|t| follows_only(t, joint))
            .cloned()
            .collect();
        let model = found
            .fit
            .model
            .without(|t| made_up.iter().any(|m| m.same_column(t)));
        let rest = regression.fit(&model, Vec::new());
        let Some(curve) = smooth::free_curve(white, &rest.model, joint) else {
            continue;
        };
        let likelihood = rest.ln_evidence + curve.ln_odds - PRICE;
        let before = best
            .as_ref()
            .map_or(found.fit.ln_evidence, |b| b.ln_evidence);
        if likelihood > before {
            let pieces = curve.freedom.clamp(4, MOST_PIECES);
            best = Some(with_curve(regression, &rest, joint, pieces, likelihood));
        }
    }
    best.map(|fit| Found {
        fit,
        names_only: regression.fit(&found.names_only.model, Vec::new()),
        other_ends: Vec::new(),
        base_misfit: false,
    })
}

/// Whether an effect is a function of this joint's value alone.
fn follows_only(term: &Term, joint: usize) -> bool {
    let about = term.effect.about();
    about.over == Over::Angle && (term.joint == joint || !about.per_joint)
}

fn settings(term: &Term) -> usize {
    usize::from(crate::effects::term::setting_quantity(term.effect.about().setting).is_some())
}

fn with_curve(
    regression: &Regression,
    rest: &Fit,
    joint: usize,
    pieces: usize,
    ln_evidence: f64,
) -> Fit {
    let mut shapes = rest.shapes.clone();
    shapes.push(regression.placed(Shape {
        variable: Variable::Joint(joint),
        direction: Direction::Tangential(joint),
        profile: Profile::Curve { pieces },
        tried: 1.0,
    }));
    let mut fit = regression.fit(&rest.model, shapes);
    let credit = ln_evidence - fit.ln_evidence;
    if let Some(curve) = fit.shapes.last_mut() {
        curve.credit = credit;
    }
    fit.ln_evidence = ln_evidence;
    fit
}
