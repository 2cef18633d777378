//! What a model leaves of the samples: the deviations e = measured − predicted, in mm, over three coordinates
//! (two in a planar session), and which of them are suspected outliers. Their RMS error is defined in
//! `answers::rms_error`.

pub(crate) use crate::answers::errors::Spread;
use crate::model::Model;
use crate::observations::figures;
pub(crate) use crate::observations::figures::Deviations;
use crate::observations::outliers::{as_if_seen, suspected};

use super::problem::Problem;

/// With fewer samples the axes are taken as stated.
const FEWEST_TO_BALANCE: usize = 30;

/// Deviations of a session's samples from a model.
pub(crate) fn deviations(problem: &Problem, model: &Model) -> Deviations {
    if let Some(layer) = &problem.observed {
        return figures::deviations(layer, model);
    }
    let n = problem.inputs.len();
    let mut deviations = Deviations {
        axes_mm: std::array::from_fn(|_| Vec::with_capacity(n)),
        length_mm: Vec::with_capacity(n),
    };
    let samples = &problem.session.samples;
    let spatial = samples.z_mm.is_some();
    let measured = [
        Some(&samples.x_mm),
        Some(&samples.y_mm),
        samples.z_mm.as_ref(),
    ];
    model.visit(&problem.inputs, false, |start, block| {
        for i in 0..block.len {
            let usable = problem.usable[start + i];
            let mut square = 0.0;
            for axis in 0..3 {
                let e = match measured[axis] {
                    _ if !usable => f64::NAN,
                    Some(measured) => measured[start + i] - block.point[axis][i],
                    None => 0.0,
                };
                deviations.axes_mm[axis].push(e);
                if axis < 2 || spatial {
                    square += e * e;
                }
            }
            deviations.length_mm.push(square.sqrt());
        }
    });
    deviations
}

/// Like [`suspects`] beside a fit of so many coefficients, which has not seen what it left out.
pub(crate) fn suspects_beside(
    problem: &Problem,
    mut deviations: Deviations,
    rank: usize,
) -> Vec<bool> {
    if problem.session.robot.joints.len() > 1 {
        let axes = problem.axis_weights.iter().filter(|w| **w > 0.0).count();
        let used = problem.used.iter().filter(|used| **used).count();
        let factor = as_if_seen(rank, axes * used);
        for axis in &mut deviations.axes_mm {
            let unseen = axis.iter_mut().zip(&problem.used);
            for (value, _) in unseen.filter(|(_, used)| !**used) {
                *value *= factor;
            }
        }
    }
    suspects(problem, &deviations)
}

/// Marks the samples of the problem that are suspected; held-out ones are judged as well, and do
/// not count in the bulk.
pub(crate) fn suspects(problem: &Problem, deviations: &Deviations) -> Vec<bool> {
    if let Some(layer) = &problem.observed {
        // Every kind was judged beside its own bulk while it was fitted.
        return layer.samples_with(&layer.suspected);
    }
    let axes: Vec<usize> = (0..3).filter(|a| problem.axis_weights[*a] > 0.0).collect();
    let all: Vec<&[f64]> = axes.iter().map(|a| &deviations.axes_mm[*a][..]).collect();
    let balanced = problem.samples() >= FEWEST_TO_BALANCE;
    let stated = problem.axis_weights;
    let sigma: Vec<f64> = axes.iter().map(|a| 1.0 / stated[*a].sqrt()).collect();
    suspected(&all, &problem.fit, &sigma, balanced)
}
