//! Detection limits: how large an effect would have had to be to be seen, with a chance of 95 %,
//! by the same search in the same samples.
//!
//! A candidate is detected if its gain exceeds the family-wise threshold c (in units of the noise). An effect of size
//! a along a coefficient has a noncentrality λ = a² G, G its Gram matrix projected orthogonal to the model; the limit
//! is the a whose λ takes a noncentral χ² with k degrees of freedom over c in 95 of 100 sessions.

pub(crate) use crate::answers::limits::Limit;
use crate::effects::{Form, Quantity, Setting};
use crate::odds;

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::evidence::{bisected, weight_of};

/// Limits of every name that was tried and is not in the model.
pub(crate) fn limits(regression: &Regression, fit: &Fit) -> Vec<Limit> {
    let around = regression.projections(fit, CandidateSubset::Names);
    let freedom = regression.m() - fit.basis.rank() as f64;
    let scale = regression.scale(fit).max(1e-300);
    let threshold = regression.minus_ln_p_for(odds::TAKEN.chance(), fit);
    let mut groups: Vec<(&'static str, usize, Vec<usize>)> = Vec::new();
    for (index, candidate) in regression.table.candidates.iter().enumerate() {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let id = term.effect.about().id;
        match groups.iter_mut().find(|g| g.0 == id && g.1 == term.joint) {
            Some(group) => group.2.push(index),
            None => groups.push((id, term.joint, vec![index])),
        }
    }
    let there = regression.added(fit);
    let is_there = |id: &str, joint: usize| {
        there
            .iter()
            .any(|t| t.effect.about().id == id && t.joint == joint)
    };
    let mut limits = Vec::new();
    for (id, joint, members) in groups {
        if is_there(id, joint) {
            continue;
        }
        let mut all: Vec<Vec<(&'static str, f64)>> = Vec::new();
        for index in members {
            let candidate = &regression.table.candidates[index];
            let Some(term) = candidate.what.term() else {
                continue;
            };
            let k = candidate.size;
            let (factor, rank) = around.factor(candidate);
            let nu = freedom - rank as f64;
            if rank == 0 || nu < 2.0 {
                continue;
            }
            let test = regression.tests.of(rank, nu);
            let share = test.share_for(threshold + weight_of(candidate));
            let critical = gain_of(share, freedom);
            let size = noncentrality(critical, rank).sqrt() * scale;
            let energy = |i: usize| -> f64 { (0..=i).map(|j| factor[i * k + j].powi(2)).sum() };
            let kind = regression.base.robot.joints[joint].kind;
            let above = |quantity: &Quantity, energy: f64| {
                let on = quantity.on(kind);
                (on.name, size / energy.sqrt() / on.unit.scale)
            };
            let sizes = match term.effect.about().form {
                Form::Plain(quantities) => {
                    let each = quantities.iter().enumerate();
                    each.map(|(i, q)| above(q, energy(i))).collect()
                }
                Form::Fading(quantity) => vec![above(&quantity, energy(0))],
                Form::Harmonic(quantity) => {
                    // The phase that is hardest to detect: the smaller eigenvalue of the 2 × 2.
                    let (a, d) = (energy(0), energy(1));
                    let b = factor[0] * factor[k];
                    let mean = 0.5 * (a + d);
                    let smaller = mean - (0.25 * (a - d) * (a - d) + b * b).sqrt();
                    vec![above(&quantity, smaller.max(1e-300))]
                }
            };
            all.push(sizes);
            if term.effect.about().setting == Setting::None {
                break;
            }
        }
        if let Some(sizes) = typical_worst(&all) {
            let per_joint = crate::effects::find(id).is_some_and(|e| e.about().per_joint);
            limits.push(Limit {
                effect: id,
                joint: per_joint.then_some(joint),
                sizes,
            });
        }
    }
    limits
}

/// The gain, in units of the residual noise, of a candidate that explains this share of a sum of squares.
pub(super) fn gain_of(share: f64, freedom: f64) -> f64 {
    freedom * share / (1.0 - share).max(f64::EPSILON)
}

/// Nine in ten settings have a limit no larger; the very worst order may be one that the poses
/// cannot show at all.
fn typical_worst(all: &[Vec<(&'static str, f64)>]) -> Option<Vec<(&'static str, f64)>> {
    let first = all.first()?;
    let sizes = first.iter().enumerate().map(|(i, (name, _))| {
        let mut own: Vec<f64> = all.iter().map(|sizes| sizes[i].1).collect();
        own.sort_by(f64::total_cmp);
        (*name, own[(own.len() * 9 / 10).min(own.len() - 1)])
    });
    Some(sizes.collect())
}

/// λ with which a noncentral χ²(k) is above `critical` with a chance of 95 %, by Sankaran's
/// approximation (1963).
fn noncentrality(critical: f64, k: usize) -> f64 {
    let k = k as f64;
    let chance_below = |lambda: f64| {
        let s = k + lambda;
        let t = k + 2.0 * lambda;
        let u = k + 3.0 * lambda;
        let h = 1.0 - 2.0 * s * u / (3.0 * t * t);
        let p = t / (s * s);
        let m = (h - 1.0) * (1.0 - 3.0 * h);
        let mean = 1.0 + h * p * (h - 1.0 - 0.5 * (2.0 - h) * m * p);
        let deviation = h * (2.0 * p).sqrt() * (1.0 + 0.5 * m * p);
        let z = ((critical / s).powf(h) - mean) / deviation;
        0.5 * statrs::function::erf::erfc(-z / std::f64::consts::SQRT_2)
    };
    let widest = 4.0 * critical + 100.0;
    bisected([0.0, widest], |lambda| {
        chance_below(lambda) > odds::OPEN.chance()
    })
}

#[cfg(test)]
mod tests {
    use super::noncentrality;
    use crate::answers::limits::Detectability;

    #[test]
    fn absurd_sizes_are_no_limits() {
        assert_eq!(Detectability::of(0.013), Detectability::Above(0.013));
        assert_eq!(Detectability::of(0.0), Detectability::AtAnySize);
        assert_eq!(Detectability::of(3e-14), Detectability::AtAnySize);
        for size in [1e250, f64::INFINITY, f64::NAN] {
            assert_eq!(Detectability::of(size), Detectability::AtNoSize, "{size}");
        }
    }

    #[test]
    fn one_column_needs_the_threshold_and_1_645_more() {
        // For k = 1, √χ² is |N(√λ, 1)|: √λ = √c + 1.645.
        let lambda = noncentrality(20.0, 1);
        assert!(
            (lambda.sqrt() - (20.0_f64.sqrt() + 1.645)).abs() < 0.02,
            "{lambda}"
        );
    }
}
