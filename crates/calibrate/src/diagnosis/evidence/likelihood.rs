//! The evidence of a fit: an approximate marginal likelihood (Schwarz 1978) with every name equally likely a priori:
//!
//! ```text
//! ln E = −(m/2) ln rss − (k/2) ln m − Σ ln(settings tried) − (shapes) ln 20
//! ```

use nalgebra::{DMatrix, DVector};

use crate::effects::{Form, Owner, Setting, Term, stated, stated_orders};
use crate::kinematics::{JointKind, Robot};
use crate::linear::Basis;
use crate::model::Model;
use crate::model::shapes::Shape;
use crate::{odds, rounding};

use super::fit::Fit;
use super::regression::Regression;
use crate::diagnosis::candidates::Placed;

/// Every name pays for being one of the twenty of the catalogue (ln 20): a set of names is as simple
/// as it is small.
pub(crate) const EFFECT_PRIOR_PENALTY: f64 = 3.0;
/// A shape pays as a name does, and has to be this much likelier besides, as a logarithm: thirty times …
/// Calibrated (`hidden_effects unknown`, `strange`): compared with two names a shape is simpler.
const PRICE_OF_A_SHAPE: f64 = 3.5 + EFFECT_PRIOR_PENALTY;
/// … and this much more for each setting that is fitted finely.
/// Derived: half the logarithm of the number of resolved settings between two points of a scan
/// (some twenty).
const PRICE_OF_A_SETTING: f64 = 1.5;

pub(super) fn price_of_owner(term: &Term) -> f64 {
    match term.effect.about().owner {
        Owner::Instrument => odds::LIKELY.nats(),
        Owner::Robot | Owner::Session => 0.0,
    }
}

pub(super) fn price_of(shape: &Shape) -> f64 {
    PRICE_OF_A_SHAPE + PRICE_OF_A_SETTING * shape.refined() as f64
}

/// The largest plausible size of a term, in the unit of its coefficients.
fn plausible(term: &Term) -> f64 {
    let about = term.effect.about();
    let size = about.form.quantities().first();
    match (about.implausible_above, size) {
        (Some(limit), Some(size)) => limit * size.unit.scale,
        _ => f64::INFINITY,
    }
}

/// Whether a term has a size so many times as large as what is implausible. For prismatic joints no limit is known:
/// their sizes have other units, and other names.
pub(crate) fn is_beyond(robot: &Robot, term: &Term, times: f64) -> bool {
    let about = term.effect.about();
    let sizes = about.form.quantities();
    let kind = robot.joints.get(term.joint).map(|joint| joint.kind);
    let parameters = term.parameters_on(kind.unwrap_or(JointKind::Revolute));
    about.implausible_above.is_some_and(|limit| {
        parameters.iter().any(|own| {
            let is_size = sizes.iter().any(|size| size.name == own.name);
            is_size && own.value.abs() > times * limit
        })
    })
}

impl Regression<'_> {
    pub(crate) fn ln_evidence(
        &self,
        model: &Model,
        shapes: &[Placed],
        rss: f64,
        rank: usize,
    ) -> f64 {
        let m = self.m();
        let base_basis = |t: &Term| self.base.terms().iter().any(|b| b.same_column(t));
        let names = model.terms().iter().map(|t| {
            let name = if base_basis(t) {
                0.0
            } else {
                EFFECT_PRIOR_PENALTY
            };
            name + self.price_of_term(t)
        });
        let anonymous = shapes
            .iter()
            .map(|s| s.shape.tried.max(1.0).ln() + price_of(&s.shape));
        -0.5 * m * self.rounded(rss).ln()
            - 0.5 * rank as f64 * m.ln()
            - names.sum::<f64>()
            - anonymous.sum::<f64>()
            + shapes.iter().map(|s| s.credit).sum::<f64>()
            + self.ln_noise
    }

    /// The correction of the complexity penalty of the terms that were added: a vector with one non-zero component has
    /// the information of one column and not of three. Each pays for its best subset of components, and for the choice
    /// of it. A term that cannot be negative and is pays for all columns, and so does a size beyond what is plausible
    /// that the samples leave more uncertain than that: it cancels another one.
    pub(super) fn subset_selection_credit(&self, model: &Model, basis: &Basis, rss: f64) -> f64 {
        let mut first = 0;
        let mut subset_selection_credit = 0.0;
        let mut covariance: Option<DMatrix<f64>> = None;
        for term in model.terms() {
            let own = first..first + term.coefficients.len();
            first = own.end;
            if self.base.terms().iter().any(|b| b.same_column(term)) {
                continue;
            }
            if term.effect.about().non_negative && term.coefficients[0] < 0.0 {
                return f64::NEG_INFINITY;
            }
            let vector = matches!(term.effect.about().form, Form::Plain(q) if q.len() > 1);
            if !vector && is_beyond(&self.base.robot, term, 1.0) {
                let all = covariance.get_or_insert_with(|| basis.inverse_gram());
                let scale = self.rounded(rss) / self.m();
                let of_own = own.clone().filter(|k| basis.kept.contains(k));
                let deviation = of_own.map(|k| (all[(k, k)] * scale).sqrt());
                if deviation.fold(0.0, f64::max) > plausible(term) {
                    return f64::NEG_INFINITY;
                }
            }
            if vector && term.effect.about().non_negative {
                // The component that the effect is named for has to be present: the others alone are something else.
                let all = covariance.get_or_insert_with(|| basis.inverse_gram());
                let variance = all[(own.start, own.start)] * self.rounded(rss) / self.m();
                let clear = term.coefficients[0].powi(2) > odds::CLEAR.chi_square() * variance;
                if !basis.kept.contains(&own.start) || !clear {
                    return f64::NEG_INFINITY;
                }
            }
            if term.effect.about().no_component_negative
                && term.coefficients.iter().any(|size| *size < 0.0)
            {
                let all = covariance.get_or_insert_with(|| basis.inverse_gram());
                let scale = self.rounded(rss) / self.m();
                let is_clear = |(size, k): (&f64, usize)| {
                    *size < 0.0
                        && basis.kept.contains(&k)
                        && size.powi(2) > odds::CLEAR.chi_square() * all[(k, k)] * scale
                };
                if term.coefficients.iter().zip(own.clone()).any(is_clear) {
                    return f64::NEG_INFINITY;
                }
            }
            // Components that the samples do not determine have no penalty.
            let own: Vec<usize> = own.filter(|k| basis.kept.contains(k)).collect();
            if !vector || own.len() < 2 {
                continue;
            }
            let first = first - term.coefficients.len();
            let all = covariance.get_or_insert_with(|| basis.inverse_gram());
            let best = subsets(own.len())
                .filter_map(|dropped| {
                    let at: Vec<usize> = dropped.iter().map(|k| own[*k]).collect();
                    let c = all.select_rows(&at).select_columns(&at);
                    let b = DVector::from_iterator(
                        at.len(),
                        at.iter().map(|k| term.coefficients[k - first]),
                    );
                    let lost = b.dot(&c.cholesky()?.solve(&b));
                    Some(
                        -0.5 * self.m() * (lost / self.rounded(rss)).ln_1p()
                            + 0.5 * at.len() as f64 * self.m().ln()
                            - choices(own.len(), at.len()),
                    )
                })
                .fold(0.0, f64::max);
            subset_selection_credit += best;
        }
        subset_selection_credit
    }

    /// A sum of squares is no more precise than the rounding of the numbers in a file.
    pub(crate) fn rounded(&self, rss: f64) -> f64 {
        let rounding: f64 = self
            .rows
            .axes
            .iter()
            .map(|a| (rounding::WRITTEN / self.noise.sigma_mm[*a]).powi(2))
            .sum();
        rss + rounding * self.rows.samples.len() as f64
    }

    /// The penalty of an order that is not whole: that of a number that is fitted.
    pub(crate) fn price_of_a_fraction(&self) -> f64 {
        PRICE_OF_A_SETTING + 0.5 * self.m().ln()
    }

    /// Whether a term is an order that follows from the gear ratio of its joint.
    pub(crate) fn is_stated(&self, term: &Term) -> bool {
        stated(&self.base.robot, term).is_some()
    }

    /// A term and those that are tested together with it: of an order that follows from the gear ratio, the others of
    /// that gear in the fit.
    pub(crate) fn together(&self, fit: &Fit, term: &Term) -> Vec<Term> {
        if !self.is_stated(term) {
            return vec![term.clone()];
        }
        let added = self.added(fit).into_iter();
        let same = |t: &&Term| t.joint == term.joint && self.is_stated(t);
        added.filter(same).cloned().collect()
    }

    pub(crate) fn price_of_term(&self, term: &Term) -> f64 {
        price_of_owner(term) + self.price_of_setting(term)
    }

    fn price_of_setting(&self, term: &Term) -> f64 {
        if term.effect.about().setting == Setting::None {
            return 0.0;
        }
        if self.is_stated(term) {
            return (stated_orders(&self.base.robot, term.joint).count() as f64).ln();
        }
        let fraction =
            if term.setting.fract() != 0.0 && term.effect.about().setting.takes_fractions() {
                self.price_of_a_fraction()
            } else {
                0.0
            };
        let mut same = self.table.candidates.iter().filter(|c| {
            c.what.term().is_some_and(|t| {
                let same = t.effect.about().id == term.effect.about().id;
                same && t.joint == term.joint && !self.is_stated(t)
            })
        });
        fraction + same.next().map_or(0.0, |c| c.tried.ln())
    }
}

/// Every choice of at least one of so few things.
pub(super) fn subsets(of: usize) -> impl Iterator<Item = Vec<usize>> {
    (1_usize..1 << of).map(move |mask| (0..of).filter(|k| mask >> k & 1 == 1).collect())
}

/// Logarithm of the number of ways to choose `some` of `of` components.
pub(crate) fn choices(of: usize, some: usize) -> f64 {
    let ways = (0..some).map(|k| (of - k) as f64 / (k + 1) as f64);
    ways.product::<f64>().ln()
}
