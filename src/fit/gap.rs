//! The gap between a model and the measurement: root mean square of the length of the deviation,
//! e = measured − predicted, in mm, over three coordinates (two in a planar session).
//!
//! Suspected outliers count in the largest deviation and not in the root mean square.

pub use crate::answers::errors::Spread;
use crate::model::Model;
use crate::observations::figures;

use super::problem::Problem;

/// Deviation of every sample, as columns, mm; NaN where a sample cannot be used.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Deviations {
    /// Along x, y and z of the measuring frame; z is zero in a planar session.
    pub axes_mm: [Vec<f64>; 3],
    /// Lengths.
    pub length_mm: Vec<f64>,
}

/// Deviations of a session's samples from a model.
pub fn deviations(problem: &Problem, model: &Model) -> Deviations {
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
