//! Values of the parameters with their intervals.

use nalgebra::DMatrix;

use crate::effects::{Setting, Term};
use crate::identification::uncertainty::{estimates, half_width_factor};
use crate::identification::{DEFAULT_EFFECTS, Estimate};
use crate::model::Model;

use super::arena::{Arena, Fit};

/// `s² (Aᵀ A)⁻¹` of the final fit, its model's coefficients first.
pub(super) fn covariance(arena: &Arena, fit: &Fit) -> DMatrix<f64> {
    let scale = arena.scale(fit);
    fit.basis.inverse_gram() * (scale * scale)
}

pub(super) fn covariance_of_model(all: &DMatrix<f64>, model: &Model) -> Option<DMatrix<f64>> {
    let own = model.coefficient_count();
    (own > 0 && all.nrows() >= own).then(|| all.view((0, 0), (own, own)).into_owned())
}

pub(super) fn parameters_of(
    arena: &Arena,
    fit: &Fit,
    covariance: &DMatrix<f64>,
    term: &Term,
) -> Vec<Estimate> {
    let mut first = 0;
    for other in fit.model.terms() {
        if other.same_column(term) {
            break;
        }
        first += other.coefficients.len();
    }
    let size = term.coefficients.len();
    let freedom = (arena.m() - fit.basis.rank() as f64).max(0.0) as usize;
    let undetermined: Vec<bool> = (first..first + size)
        .map(|k| !fit.basis.kept.contains(&k))
        .collect();
    let own = covariance.view((first, first), (size, size)).into_owned();
    let thinning = thinning(arena);
    let factor = half_width_factor(freedom) * thinning;
    let kind = fit.model.robot.joints[term.joint].kind;
    let mut all = estimates(
        term,
        (freedom > 0).then_some(&own),
        factor,
        &undetermined,
        kind,
    );
    if term.effect.about().setting == Setting::Time
        && let Some(time) = all.first_mut()
    {
        time.ci95 = Some(around(arena, term.setting));
    }
    all
}

/// Values come from all samples, the covariance from the part that was searched.
fn thinning(arena: &Arena) -> f64 {
    let all = arena.all_samples.max(1) as f64;
    (arena.rows.samples.len() as f64 / all).sqrt().min(1.0)
}

/// Times of the samples around a step.
fn around(arena: &Arena, time: f64) -> [f64; 2] {
    let times = arena.problem.inputs.time_s.as_deref().unwrap_or(&[]);
    let before = times.iter().copied().filter(|t| *t < time);
    let after = times.iter().copied().filter(|t| *t >= time);
    [
        before.fold(f64::NEG_INFINITY, f64::max).max(-1e300),
        after.fold(f64::INFINITY, f64::min).min(1e300),
    ]
}

pub(super) fn identified_parameters(
    arena: &Arena,
    fit: &Fit,
    covariance: &DMatrix<f64>,
) -> Vec<Estimate> {
    let base = |t: &&Term| DEFAULT_EFFECTS.contains(&t.effect.about().id);
    let terms = fit.model.terms().iter().filter(base);
    terms
        .flat_map(|term| parameters_of(arena, fit, covariance, term))
        .collect()
}
