//! Whether what the rows of a pose share is noise of the robot, or an error that the model lacks.
//!
//! [`noise`](super::noise) lets the joints not repeat, and a fit beside that trusts rows that move little with them more, as
//! the differences between the reflectors of a pose. A sag that the model lacks looks the same, is
//! there in every pose, and then the fit leaves it all where it was. Both weightings estimate the same coefficients where
//! the noise is what it is said to be; where they do not agree it is not (Hausman, Econometrica 46, 1978):
//!
//! ```text
//! F = ((RSS_beside − RSS_alike) / p) / (RSS_alike / (m − p)) ~ F(p, m − p),   m: numbers of poses, not of rows
//! ```
//!
//! Then all rows count alike, and the intervals come from what each pose pulls (Liang and Zeger, Biometrika 73, 1986):
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

/// That fit where the one beside joints that do not repeat is another. The problem leaves with noise that all rows have
/// alike.
pub(super) fn alike(problem: &mut Problem, beside: &Solution) -> Option<Alike> {
    problem.noise.as_ref().filter(|n| n.joints_rad > 0.0)?;
    let used: Vec<usize> = (0..problem.used.len())
        .filter(|i| problem.used[*i])
        .collect();
    let pose = problem.inputs.select(&used).pose;
    let poses = ByPose::of(pose.as_deref(), used.len()).first.len();
    let rss_beside = rss(problem, &beside.model);
    let variance = rss_beside / problem.rows() as f64;
    let mut trial = problem.clone();
    trial.set_noise(&Noise::white(variance.sqrt()), &beside.model);
    let solution = solve(&trial, &beside.model);
    let p = solution.spectrum.rank() as f64;
    let numbers = (poses * trial.axes()) as f64;
    let alike = rss(&trial, &solution.model) / (numbers - p);
    let f = (rss_beside - alike * (numbers - p)) / p / alike;
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

/// Sum of the squares that a model leaves of the samples that count, mm².
fn rss(problem: &Problem, model: &Model) -> f64 {
    let each = lengths_mm(problem, model).into_iter().zip(&problem.used);
    each.filter(|(_, used)| **used).map(|(mm, _)| mm * mm).sum()
}

/// Of each pose, a column: the sum over its rows of their derivatives times what is left of them.
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

    /// What they are not is tested on an arm that sags (`unnamed.rs`).
    #[test]
    fn joints_that_do_not_repeat_are_believed() {
        for seed in 1..=6 {
            let session = unrepeated(2e-4, seed);
            let mut problem = Problem::new(&session, JointValues::Commanded);
            let start = base_model::start(&session, &problem, |_| true);
            let beside = base_model::fit(&mut problem, &start, true).solution;
            assert!(problem.noise.as_ref().unwrap().joints_rad > 0.0);
            assert!(alike(&mut problem, &beside).is_none(), "{seed}");
        }
    }
}
