//! The expected error of a model where the robot works: the propagated uncertainty of its parameters over the joint
//! ranges, not only at the poses that were measured.
//!
//! ```text
//! var p(q) = J(q) Σ J(q)ᵀ,   expected error = √ tr var p(q)
//! ```
//!
//! Combinations that the measured poses do not determine are fixed by the gauge, and yet matter at other poses (of a
//! joint that was never moved all of it): in addition to the covariance each such combination d counts with its prior,
//!
//! ```text
//! J d = 0 at the measured poses,   var p(q) += σ_d² |J(q) d|²,   1/σ_d² = Σ_k (d_k/σ_k)²
//! ```
//!
//! unless the model and its covariance contain them already (`unseen`), which is so of all but the instrument's own.

use nalgebra::DMatrix;

pub use crate::answers::errors::Expected;
use crate::budget;
use crate::effects::Inputs;
use crate::model::Model;

use super::priors::Priors;
use super::problem::Problem;
use super::ranges::over_the_ranges;
use super::spread::spread;
use super::unseen::{Unseen, beforehand, nothing_held};

/// The expected error of a model with the covariance of its coefficients; `completed`: it holds what the samples do not
/// show as well (`unseen`).
pub(crate) fn expected_error(
    problem: &Problem,
    model: &Model,
    covariance: &DMatrix<f64>,
    completed: bool,
) -> Option<Expected> {
    let inputs = over_the_ranges(problem);
    let held = model;
    let free = completed.then(|| nothing_held(model));
    let model = free.as_ref().unwrap_or(model);
    let mut over = uncertainties_mm(model, &inputs, covariance)?;
    let mut unseen = Unseen::of(problem, held);
    if completed {
        unseen.retain_what_matters(&inputs, false);
    }
    for (own, unseen) in over.iter_mut().zip(moved_by(&unseen, problem, &inputs)) {
        *own = own.hypot(unseen);
    }
    let some = spread(&problem.used, budget::OF_A_TRIAL);
    let measured = uncertainties_mm(model, &problem.inputs.select(&some), covariance)?;
    let rms = |all: &[f64]| {
        let square: f64 = all.iter().map(|e| e * e).sum();
        (square / all.len().max(1) as f64).sqrt()
    };
    let worst = (0..over.len()).max_by(|a, b| over[*a].total_cmp(&over[*b]))?;
    Some(Expected {
        rms_mm: rms(&over),
        max_mm: over[worst],
        worst_q: inputs.q.iter().map(|q| q[worst]).collect(),
        measured_rms_mm: rms(&measured),
    })
}

/// √ tr J Σ Jᵀ of every pose, mm: one standard uncertainty of the predicted point; `None` where the
/// sizes do not fit.
pub fn uncertainties_mm(
    model: &Model,
    inputs: &Inputs,
    covariance: &DMatrix<f64>,
) -> Option<Vec<f64>> {
    let count = model.coefficient_count();
    if covariance.nrows() < count || inputs.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    model.visit(inputs, true, |_, block| {
        for i in 0..block.len {
            let mut trace = 0.0;
            for axis in 0..3 {
                for a in 0..count {
                    let ja = block.columns[a][axis][i];
                    if ja != 0.0 {
                        let along: f64 = (0..count)
                            .map(|b| covariance[(a, b)] * block.columns[b][axis][i])
                            .sum();
                        trace += ja * along;
                    }
                }
            }
            all.push(trace.max(0.0).sqrt());
        }
    });
    Some(all)
}

/// The possible moves of every pose by the combinations that the samples do not determine, mm; of a robot with several
/// joints.
pub(crate) fn unseen_mm(problem: &Problem, model: &Model, inputs: &Inputs) -> Vec<f64> {
    moved_by(&Unseen::of(problem, model), problem, inputs)
}

fn moved_by(unseen: &Unseen, problem: &Problem, inputs: &Inputs) -> Vec<f64> {
    let priors = Priors {
        aligned: problem.priors.aligned,
        ..Priors::unmeasured(None)
    };
    let sigma = beforehand(&priors, &unseen.model);
    let mut square = vec![0.0; inputs.len()];
    for (own, moved) in unseen.combinations.iter().zip(unseen.moved_mm(inputs)) {
        let known = own.iter().zip(&sigma).map(|(d, sigma)| (d / sigma).powi(2));
        let known: f64 = known.sum();
        for (square, moved) in square.iter_mut().zip(moved) {
            *square += moved * moved / known;
        }
    }
    square.into_iter().map(f64::sqrt).collect()
}
