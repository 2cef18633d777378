//! The forecast of a measurement: the expected error of the model over the joint ranges, and how well the poses
//! determine its parameters.
//!
//! ```text
//! error(q) = √ tr J(q) C J(q)ᵀ,   index = (∏ σ_i)^(1/L) / √n
//! ```
//!
//! σ are the singular values of the Jacobian of n poses, mm for a step of a parameter of 1 mm, or of an
//! angle that moves the far end of the robot by 1 mm (Borm & Menq 1991); L of them are not zero where
//! everything is measured that can be. What is stated of the targets' places is a measurement; the weak
//! priors are none.

use nalgebra::DMatrix;

use super::plan::{ExpectedError, Forecast};
use super::rows::{Rows, free};
use crate::fit::problem::Problem;
use crate::fit::ranges::over_the_ranges;
use crate::model::Model;
use crate::observations::KINDS;
use crate::rounding;

/// What a model does over the joint ranges.
pub(crate) struct Workspace {
    /// Derivatives of the target's place at each pose, mm.
    rows: Rows,
    /// A step of each parameter that moves things by 1 mm.
    steps: Vec<f64>,
    /// Noise of a point, mm.
    unit_mm: f64,
    /// Combinations of parameters that are shown at all.
    shown: usize,
}

impl Workspace {
    /// `everything` is the information of all that can be measured.
    pub(crate) fn new(problem: &Problem, model: &Model, everything: &DMatrix<f64>) -> Self {
        let inputs = over_the_ranges(problem);
        let all = Rows::of_points([model; 2], &inputs, &[0, 1, 2], [1.0; 3]);
        let reach = model.robot.longest_lever_mm();
        let steps = free(model).map(|(_, term, k)| {
            let kind = model.robot.joints[term.joint].kind;
            if term.effect.about().form.turns(k, kind) {
                1.0 / reach
            } else {
                1.0
            }
        });
        let columns: Vec<usize> = free(model).map(|own| own.0).collect();
        let sigma = KINDS[0].sigma(&problem.session.instrument);
        let mut workspace = Self {
            rows: all.only(&columns),
            steps: steps.collect(),
            unit_mm: sigma.unwrap_or(KINDS[0].about().usual_sigma),
            shown: 0,
        };
        let squares = workspace.squares(everything);
        let least = rounding::LAST_BITS * squares.first().unwrap_or(&0.0);
        workspace.shown = squares.iter().filter(|s| **s > least).count();
        workspace
    }

    /// Squared singular values in mm², the largest first, of an information matrix.
    fn squares(&self, gram: &DMatrix<f64>) -> Vec<f64> {
        let p = self.steps.len();
        if p == 0 {
            return Vec::new();
        }
        let mm = self.unit_mm * self.unit_mm;
        let scaled = DMatrix::from_fn(p, p, |i, j| {
            gram[(i, j)] * self.steps[i] * self.steps[j] * mm
        });
        let mut squares = crate::decompose::eigen(scaled)
            .eigenvalues
            .as_slice()
            .to_vec();
        squares.sort_by(|a, b| b.total_cmp(a));
        squares
    }

    pub(crate) fn error(&self, covariance: &DMatrix<f64>) -> ExpectedError {
        let products = covariance * &self.rows.columns;
        let of = |pose: usize| {
            let (first, size) = self.rows.place(pose);
            let trace = self.rows.of(pose).dot(&products.columns(first, size));
            trace.max(0.0).sqrt()
        };
        let mut all: Vec<f64> = (0..self.rows.len()).map(of).collect();
        all.sort_by(f64::total_cmp);
        let square: f64 = all.iter().map(|e| e * e).sum();
        ExpectedError {
            rms_mm: (square / all.len().max(1) as f64).sqrt(),
            p95_mm: all.get(all.len() * 95 / 100).copied().unwrap_or(0.0),
        }
    }

    /// `gram`: the information of `count` poses.
    pub(crate) fn forecast(
        &self,
        covariance: &DMatrix<f64>,
        gram: &DMatrix<f64>,
        count: usize,
    ) -> Forecast {
        let squares = self.squares(gram);
        let own = &squares[..self.shown];
        let all_shown = own.iter().all(|s| *s > rounding::LAST_BITS * own[0]) && self.shown > 0;
        let mean = own.iter().map(|s| 0.5 * s.max(1e-300).ln()).sum::<f64>() / own.len() as f64;
        Forecast {
            error: self.error(covariance),
            observability: if all_shown {
                mean.exp() / (count.max(1) as f64).sqrt()
            } else {
                0.0
            },
        }
    }
}
