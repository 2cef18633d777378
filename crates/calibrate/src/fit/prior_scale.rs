//! The widths of the weak priors of a robot's zero offsets and links, and of its tool and frame, estimated from its
//! own (empirical Bayes).
//!
//! A prior states what any robot may be off by. Of one that its maker has calibrated all of it is smaller by tens, and
//! few poses close to each other, fitted with the wide prior, turn noise into angles that lead far off elsewhere, and
//! any error into a move of the tool. So the widths are shrunk by the factor of the largest marginal likelihood
//! (empirical Bayes), over the equations at a solution x, with N, g and the cost e² of the samples alone and P(c) = s²
//! diag(1/(c σ)²):
//!
//! ```text
//! 2 ln L(c, s²) = (hᵀ A⁻¹ h − xᵀ P x − e²)/s² − ln det A + ln det P − m ln s²,   A = N + P,   h = g − P x
//! ```
//!
//! With many poses the samples determine everything, whatever the width is.
//!
//! Source: D. J. C. `MacKay`, *Bayesian interpolation*, Neural Computation 4, 1992.

use nalgebra::{DMatrix, DVector};

use crate::model::Model;

use super::normal::Normal;
use super::priors::{Priors, group};

/// Factors that are tried, each half of the one before it, of zero offsets down to 1.6 mrad and of links down to the
/// machining error of any robot: 0.13 mm, 0.25 mrad.
const HALVINGS: [&[u8]; 2] = [&[0, 1, 2, 3, 4, 5], &[0, 1, 2, 3]];
/// Of tool and frame, each a quarter of the one before it, down to 0.8 mm of a tool. A fit has the widest: its samples
/// determine the tool, and a narrower prior would attribute a part of it to the rest. What no sample shows is averaged
/// over all of them.
const OF_SET_UP: &[u8] = &[0, 2, 4, 6];
/// Alternatives with a smaller weight change no figure that is reported.
const LEAST_SHARE: f64 = 1e-3;
/// Variances that are tried besides the one of a fit, each twice the one before it.
const DOUBLINGS: std::ops::RangeInclusive<i8> = -8..=4;

/// The widths of the priors of a robot's zero offsets, links and set-up, and the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Widths {
    /// Logarithms of the factors, of zero offsets, of links, and of tool and frame.
    pub(super) ln_scale: [f64; 3],
    /// Variance of a coordinate of weight one.
    pub(super) variance: f64,
}

/// The likeliest; `normal` are the equations with these priors, of so many rows.
pub(super) fn likeliest(
    priors: &Priors,
    model: &Model,
    normal: &Normal,
    rows: usize,
) -> Option<Widths> {
    let mut best: Option<(Widths, f64)> = None;
    for (widths, likelihood) in likelihoods(priors, model, normal, rows, &[0])? {
        // The wider one, where the samples do not distinguish them.
        if best.is_none_or(|best| likelihood > best.1 + 1e-6) {
            best = Some((widths, likelihood));
        }
    }
    best.map(|best| best.0)
}

/// All that are possible, each with its weight, by the same likelihood: few poses leave the width itself uncertain,
/// and that adds to the uncertainty of the rest.
pub(super) fn possible(
    priors: &Priors,
    model: &Model,
    normal: &Normal,
    rows: usize,
) -> Option<Vec<([f64; 3], f64)>> {
    let all = likelihoods(priors, model, normal, rows, OF_SET_UP)?;
    let most = all
        .iter()
        .map(|own| own.1)
        .fold(f64::NEG_INFINITY, f64::max);
    let mut shares: Vec<([f64; 3], f64)> = Vec::new();
    for (widths, likelihood) in all {
        let share = (likelihood - most).exp();
        match shares.iter_mut().find(|own| own.0 == widths.ln_scale) {
            Some(own) => own.1 += share,
            None => shares.push((widths.ln_scale, share)),
        }
    }
    let sum: f64 = shares.iter().map(|own| own.1).sum();
    shares.retain_mut(|own| {
        own.1 /= sum;
        own.1 > LEAST_SHARE
    });
    Some(shares)
}

/// The logarithm of the likelihood of all widths that are tried, the widest first.
fn likelihoods(
    priors: &Priors,
    model: &Model,
    normal: &Normal,
    rows: usize,
    set_up: &[u8],
) -> Option<Vec<(Widths, f64)>> {
    let all: Vec<Coefficient> = coefficients(priors, model);
    let (known, free): (Vec<&Coefficient>, Vec<&Coefficient>) =
        all.iter().partition(|c| c.sigma.is_some());
    if known.iter().all(|c| c.group.is_none()) || rows <= free.len() {
        return None;
    }
    let samples = without(normal, &known, &free, (rows - free.len()) as f64)?;
    let [zeros, links] = HALVINGS;
    let halved = |halvings: &u8| -f64::from(*halvings) * std::f64::consts::LN_2;
    let mut likelihoods = Vec::new();
    for doublings in DOUBLINGS {
        let of_links = |z| links.iter().map(move |l| [z, l]);
        for [z, l] in zeros.iter().flat_map(of_links) {
            for s in set_up {
                let widths = Widths {
                    ln_scale: [z, l, s].map(halved),
                    variance: priors.variance * f64::from(doublings).exp2(),
                };
                let likelihood = samples.ln_likelihood(&known, widths);
                likelihoods.extend(likelihood.map(|own| (widths, own)));
            }
        }
    }
    Some(likelihoods)
}

/// A coefficient that is not held.
struct Coefficient {
    column: usize,
    value: f64,
    /// Of its prior, before any factor.
    sigma: Option<f64>,
    /// Its prior's weight among the equations.
    weight: f64,
    /// Whose factor its prior has ([`group`]).
    group: Option<usize>,
}

fn coefficients(priors: &Priors, model: &Model) -> Vec<Coefficient> {
    let wide = priors.of_any_robot();
    let all = model.columns().enumerate();
    all.filter(|(_, (term, k))| !term.held.contains(*k))
        .map(|(column, (term, k))| Coefficient {
            column,
            value: term.coefficients[k],
            sigma: wide.sigma(model, term, k),
            weight: priors
                .sigma(model, term, k)
                .map_or(0.0, |sigma| priors.variance / (sigma * sigma)),
            group: group(term),
        })
        .collect()
}

/// The equations of the samples alone for what has a prior, with the rest eliminated.
struct Samples {
    gram: DMatrix<f64>,
    gradient: DVector<f64>,
    cost: f64,
    /// Rows beyond the coefficients of which nothing is known.
    rows: f64,
}

fn without(
    normal: &Normal,
    known: &[&Coefficient],
    free: &[&Coefficient],
    rows: f64,
) -> Option<Samples> {
    let part = |rows: &[&Coefficient], columns: &[&Coefficient]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            let own = normal.gram[(rows[i].column, columns[j].column)];
            if rows[i].column == columns[j].column {
                own - rows[i].weight
            } else {
                own
            }
        })
    };
    let gradient = |of: &[&Coefficient]| {
        DVector::from_fn(of.len(), |i, _| {
            normal.gradient[of[i].column] + of[i].weight * of[i].value
        })
    };
    let of_priors: f64 = known.iter().map(|c| c.weight * c.value * c.value).sum();
    let (gram, right) = (part(known, known), gradient(known));
    let cost = normal.cost - of_priors;
    if free.is_empty() {
        return Some(Samples {
            gram,
            gradient: right,
            cost,
            rows,
        });
    }
    // In units in which every free coefficient has the same.
    let own = part(free, free);
    let unit = DVector::from_fn(free.len(), |i, _| own[(i, i)].max(f64::MIN_POSITIVE).sqrt());
    let scaled = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        own[(i, j)] / (unit[i] * unit[j]) + if i == j { 1e-12 } else { 0.0 }
    });
    let factor = scaled.cholesky()?;
    let mut cross = part(free, known);
    let mut right_of_free = gradient(free);
    for i in 0..free.len() {
        cross.row_mut(i).unscale_mut(unit[i]);
        right_of_free[i] /= unit[i];
    }
    let solved = factor.solve(&cross);
    Some(Samples {
        gram: gram - cross.tr_mul(&solved),
        gradient: right - solved.tr_mul(&right_of_free),
        cost: cost - right_of_free.dot(&factor.solve(&right_of_free)),
        rows,
    })
}

impl Samples {
    fn ln_likelihood(&self, known: &[&Coefficient], widths: Widths) -> Option<f64> {
        let count = known.len();
        let variance = widths.variance;
        let sigma = DVector::from_fn(count, |i, _| {
            let wide = known[i].sigma.unwrap_or(f64::INFINITY);
            let own = known[i].group;
            own.map_or(wide, |own| wide * widths.ln_scale[own].exp())
        });
        let value = DVector::from_fn(count, |i, _| known[i].value / sigma[i]);
        // With every coefficient in units of its prior P is s² times one.
        let a = DMatrix::from_fn(count, count, |i, j| {
            let one = if i == j { 1.0 } else { 0.0 };
            self.gram[(i, j)] * sigma[i] * sigma[j] / variance + one
        });
        let h = DVector::from_fn(count, |i, _| {
            self.gradient[i] * sigma[i] / variance - value[i]
        });
        let factor = a.cholesky()?;
        let diagonal = factor.l_dirty().diagonal();
        let ln_det: f64 = 2.0 * diagonal.iter().map(|d| d.ln()).sum::<f64>();
        let gain = h.dot(&factor.solve(&h));
        let of_noise = self.rows * variance.ln() + self.cost / variance;
        let likelihood = 0.5 * (gain - value.norm_squared() - ln_det - of_noise);
        likelihood.is_finite().then_some(likelihood)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of linear equations the measured values are normal: `y ~ N(0, s² I + J diag((c σ)²) Jᵀ)`.
    #[test]
    fn the_likelihood_is_that_of_the_measured_values_themselves() {
        let jacobian = DMatrix::from_fn(7, 4, |i, j| ((3 * i + 5 * j) as f64).sin() + 0.2);
        let measured = DVector::from_fn(7, |i, _| ((i * i) as f64).cos() * 0.8);
        // Nothing is known of the third; equations at some place, with the priors of other widths.
        let sigma = [Some(0.5), Some(2.0), None, Some(0.1)];
        let group = [Some(0), Some(1), None, Some(2)];
        let value = DVector::from_vec(vec![0.3, -0.2, 0.7, 0.05]);
        let weight = [1.5, 0.4, 0.0, 9.0];
        let all: Vec<Coefficient> = (0..4)
            .map(|column| Coefficient {
                column,
                value: value[column],
                sigma: sigma[column],
                weight: weight[column],
                group: group[column],
            })
            .collect();
        let residual = &measured - &jacobian * &value;
        let mut normal = Normal::new(4);
        normal.gram = jacobian.tr_mul(&jacobian);
        normal.gradient = jacobian.tr_mul(&residual);
        normal.cost = residual.norm_squared();
        for k in 0..4 {
            normal.gram[(k, k)] += weight[k];
            normal.gradient[k] -= weight[k] * value[k];
            normal.cost += weight[k] * value[k] * value[k];
        }
        let (known, free): (Vec<&Coefficient>, Vec<&Coefficient>) =
            all.iter().partition(|c| c.sigma.is_some());
        let samples = without(&normal, &known, &free, 6.0).unwrap();
        let density = |widths: Widths| {
            let own = |k: usize| {
                // Nothing known: as wide as the digits bear.
                let scale = group[k].map_or(1.0, |own: usize| widths.ln_scale[own].exp());
                sigma[k].map_or(1e4, |sigma| scale * sigma)
            };
            let wide = DMatrix::from_fn(7, 4, |i, k| jacobian[(i, k)] * own(k));
            let spread = &wide * wide.transpose() + DMatrix::identity(7, 7) * widths.variance;
            let factor = spread.cholesky().unwrap();
            let ln_det: f64 = 2.0 * factor.l().diagonal().map(f64::ln).sum();
            -0.5 * (ln_det + measured.dot(&factor.solve(&measured)))
        };
        let widths = |zeros: f64, links: f64, variance: f64| Widths {
            ln_scale: [zeros, links, 0.5 * zeros],
            variance,
        };
        let [first, second] = [widths(0.0, 0.0, 0.3), widths(-1.4, -0.7, 0.05)];
        let own = |at| samples.ln_likelihood(&known, at).unwrap();
        let (found, exact) = (own(first) - own(second), density(first) - density(second));
        assert!((found - exact).abs() < 1e-5, "{found} {exact}");
    }
}
