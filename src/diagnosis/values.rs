//! Values of the parameters with their intervals, from all samples that may be fitted.
//!
//! A search looks at a part of a long session, and at none of the samples that an option locks
//! away; the names that it found are fitted once more to all of them:
//!
//! ```text
//! C = s² (Aᵀ A)⁻¹ · (n_searched / n_all) · (1 + r)/(1 − r)
//! ```
//!
//! with s and A from the whitened rows. Up to [`MOST_WHITENED`] samples all rows are whitened and
//! the two last factors are 1; beyond, the values come from plain least squares, and r is the
//! correlation from one residual to the next over all samples (its effect on a slowly varying
//! column; Priestley 1981, §5.3).

use nalgebra::DMatrix;

use crate::effects::{Setting, Term};
use crate::identification::gap::{Deviations, deviations};
use crate::identification::problem::Problem;
use crate::identification::solver::solve;
use crate::identification::uncertainty::{estimates, half_width_factor};
use crate::identification::{DEFAULT_EFFECTS, Estimate, base_model};
use crate::model::Model;

use super::arena::{Arena, Fit};
use super::prepare::Prepared;

/// With more samples than this the fit to all of them is plain least squares.
const MOST_WHITENED: usize = 6000;

/// A model fitted to all samples that count, and how sure its coefficients are.
pub(super) struct Values {
    pub(super) model: Model,
    /// Of the coefficients, inner units.
    pub(super) covariance: DMatrix<f64>,
    /// Coefficients that the samples determine.
    determined: Vec<usize>,
    freedom: usize,
}

impl Values {
    /// The names of a fit, fitted to the samples of a problem that count.
    pub(super) fn of(prepared: &Prepared, problem: &Problem, fit: &Fit) -> Self {
        let searched = &prepared.arena;
        let count = problem.samples();
        if count == searched.rows.samples.len() && problem.used == searched.problem.used {
            return Self::of_fit(searched, fit);
        }
        if count <= MOST_WHITENED {
            let all = searched.on(problem.clone());
            return Self::of_fit(&all, &all.fit(&fit.model, Vec::new()));
        }
        let model = solve(problem, &fit.model).model;
        let part = Self::of_fit(searched, fit);
        let r = correlation(problem, &deviations(problem, &model));
        let thinning = searched.rows.samples.len() as f64 / count as f64;
        Self {
            model,
            covariance: part.covariance * (thinning * (1.0 + r) / (1.0 - r)),
            ..part
        }
    }

    fn of_fit(arena: &Arena, fit: &Fit) -> Self {
        let scale = arena.scale(fit);
        let own = fit.model.coefficient_count();
        let all = fit.basis.inverse_gram() * (scale * scale);
        Self {
            model: fit.model.clone(),
            covariance: all.view((0, 0), (own, own)).into_owned(),
            determined: fit.basis.kept.clone(),
            freedom: (arena.m() - fit.basis.rank() as f64).max(0.0) as usize,
        }
    }

    /// Of its coefficients; `None` where it has none.
    pub(super) fn covariance(&self) -> Option<DMatrix<f64>> {
        (self.covariance.nrows() > 0).then(|| self.covariance.clone())
    }

    /// Estimates of one of its terms.
    pub(super) fn parameters_of(&self, arena: &Arena, term: &Term) -> Vec<Estimate> {
        let mut first = 0;
        let mut own_term = term;
        for other in self.model.terms() {
            if other.same_column(term) {
                own_term = other;
                break;
            }
            first += other.coefficients.len();
        }
        let size = own_term.coefficients.len();
        let undetermined: Vec<bool> = (first..first + size)
            .map(|k| !self.determined.contains(&k))
            .collect();
        let own = self.covariance.view((first, first), (size, size));
        let kind = self.model.robot.joints[term.joint].kind;
        let mut all = estimates(
            own_term,
            (self.freedom > 0).then_some(&own.into_owned()),
            half_width_factor(self.freedom),
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

    /// Estimates of what belongs to every calibration.
    pub(super) fn identified(&self, arena: &Arena) -> Vec<Estimate> {
        let several = self.model.robot.joints.len() > 1;
        let base = |t: &&Term| {
            let id = t.effect.about().id;
            DEFAULT_EFFECTS.contains(&id) || several && base_model::belongs(id)
        };
        let terms = self.model.terms().iter().filter(base);
        terms
            .flat_map(|term| self.parameters_of(arena, term))
            .collect()
    }
}

/// Mean correlation from one residual to the next, over the axes; at least 0.
fn correlation(problem: &Problem, left: &Deviations) -> f64 {
    let (mut together, mut own) = (0.0, 0.0);
    for (axis, values) in left.axes_mm.iter().enumerate() {
        if problem.axis_weights[axis] <= 0.0 {
            continue;
        }
        for i in 1..values.len() {
            if problem.used[i] && problem.used[i - 1] {
                together += values[i] * values[i - 1];
                own += 0.5 * (values[i] * values[i] + values[i - 1] * values[i - 1]);
            }
        }
    }
    if own > 0.0 {
        (together / own).clamp(0.0, 0.99)
    } else {
        0.0
    }
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
