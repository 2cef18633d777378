//! A specification test: whether the common error of the rows of a pose is noise of the robot, or an error that the
//! model lacks.
//!
//! With [`noise`](super::noise) of joints that do not repeat, a fit gives rows that move little with them more weight,
//! as the differences between the reflectors of a pose. A sag that the model lacks looks the same, is present in every
//! pose, and then that fit leaves it uncorrected. Both weightings estimate the same coefficients where the noise is
//! specified correctly; where they do not agree it is not (Hausman, Econometrica 46, 1978):
//!
//! ```text
//! F = ((RSS_weighted − RSS_alike) / p) / (RSS_alike / (m − p)) ~ F(p, m − p),   m: numbers of poses, not of rows
//! ```
//!
//! Then all rows have the same weight, and the intervals come from the gradients of the poses (cluster-robust
//! covariance, Liang and Zeger, Biometrika 73, 1986):
//!
//! ```text
//! C = (JᵀJ)⁻¹ (Σ_pose gᵢ gᵢᵀ) (JᵀJ)⁻¹,   gᵢ = Jᵢᵀ rᵢ
//! ```

use nalgebra::DMatrix;

use super::gap::lengths_mm;
use super::noise::Noise;
use super::problem::Problem;
use super::solver::{Solution, solve};
use crate::distributions::f_tail;
use crate::model::Model;
use crate::odds;
use crate::sessions::poses::ByPose;

/// A fit in which all rows count alike, and its covariance.
pub(super) struct Alike {
    pub(super) solution: Solution,
    pub(super) covariance: DMatrix<f64>,
}

/// The fit with equal weights where that given joints that do not repeat differs from it. The problem is left with
/// noise that all rows have alike.
pub(super) fn alike(problem: &mut Problem, weighted: &Solution) -> Option<Alike> {
    problem.noise.as_ref().filter(|n| n.joints_rad > 0.0)?;
    let used: Vec<usize> = (0..problem.used.len())
        .filter(|i| problem.used[*i])
        .collect();
    let pose = problem.inputs.select(&used).pose;
    let poses = ByPose::of(pose.as_deref(), used.len()).first.len();
    let rss_weighted = rss(problem, &weighted.model);
    let variance = rss_weighted / problem.rows() as f64;
    let mut trial = problem.clone();
    trial.set_noise(&Noise::white(variance.sqrt()), &weighted.model);
    let solution = solve(&trial, &weighted.model);
    let p = solution.spectrum.rank() as f64;
    let numbers = (poses * trial.axes()) as f64;
    let alike = rss(&trial, &solution.model) / (numbers - p);
    let f = (rss_weighted - alike * (numbers - p)) / p / alike;
    if numbers <= p
        || !f.is_finite()
        || f <= 0.0
        || f_tail(f, p, numbers - p) > odds::CLEAR.chance()
    {
        return None;
    }
    // The spectrum is that of rows in units of the noise.
    let inverse = solution.spectrum.inverse() / variance;
    let pulls = pulls(&trial, &solution.model);
    // Of few poses their own pulls are too small, as any residual is.
    let few = numbers / (numbers - p);
    let covariance = &inverse * (&pulls * pulls.transpose()) * &inverse * few;
    *problem = trial;
    Some(Alike {
        solution,
        covariance,
    })
}

/// Sum of the squared residuals of the samples that count, mm².
fn rss(problem: &Problem, model: &Model) -> f64 {
    let each = lengths_mm(problem, model).into_iter().zip(&problem.used);
    each.filter(|(_, used)| **used).map(|(mm, _)| mm * mm).sum()
}

/// Of each pose, a column: the sum over its rows of their derivatives times their residuals.
fn pulls(problem: &Problem, model: &Model) -> DMatrix<f64> {
    let inputs = &problem.inputs;
    let by_pose = ByPose::of(inputs.pose.as_deref(), inputs.len());
    let mut pose_of = vec![0; inputs.len()];
    for (pose, samples) in by_pose.samples().into_iter().enumerate() {
        for sample in samples {
            pose_of[sample] = pose;
        }
    }
    let mut pulls = DMatrix::zeros(model.coefficient_count(), by_pose.first.len());
    model.visit(inputs, true, |start, block| {
        let mask = problem.mask(start, block.len);
        for axis in (0..3).filter(|axis| problem.axis_weights[*axis] > 0.0) {
            let residual = problem.residual(axis, start, block, &mask);
            for i in 0..block.len {
                let mut pull = pulls.column_mut(pose_of[start + i]);
                for (pull, column) in pull.iter_mut().zip(&block.columns) {
                    *pull += column[axis][i] * residual[i];
                }
            }
        }
    });
    pulls
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::base_model;
    use crate::fit::example::unrepeated;

    /// The contrary is tested on an arm that sags (`unnamed.rs`).
    #[test]
    fn joints_that_do_not_repeat_are_believed() {
        for seed in 1..=6 {
            let session = unrepeated(2e-4, seed);
            let mut problem = Problem::new(&session, JointValues::Commanded);
            let start = base_model::start(&session, &problem, |_| true);
            let weighted = base_model::fit(&mut problem, &start, true).solution;
            assert!(problem.noise.as_ref().unwrap().joints_rad > 0.0);
            assert!(alike(&mut problem, &weighted).is_none(), "{seed}");
        }
    }
}
