//! Whether what the rows of a pose share is noise of the robot, or an error that the model lacks.
//!
//! Where several reflectors are measured in one pose, [`noise`](super::noise) lets the joints not repeat, and a fit beside that
//! trusts the differences between the reflectors more than where the pose is. A sag that the model lacks looks the same, is
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

use nalgebra::{DMatrix, DVector};

use super::noise::Noise;
use super::problem::Problem;
use super::regression::Rows;
use super::solver::{Solution, solve};
use crate::distributions::f_tail;

/// By chance noise that is what it is said to be is taken for another in one of a thousand sessions.
const CHANCE: f64 = 1e-3;

/// A fit in which all rows count alike, and its covariance.
pub(super) struct Alike {
    pub(super) solution: Solution,
    pub(super) covariance: DMatrix<f64>,
}

/// That fit where the one beside joints that do not repeat is another. The problem leaves with noise that all rows have
/// alike.
pub(super) fn alike(problem: &mut Problem, beside: &Solution) -> Option<Alike> {
    problem
        .noise
        .as_ref()
        .filter(|noise| noise.joints_rad > 0.0)?;
    let rows = Rows::of(problem);
    let poses = rows.inputs.pose.clone()?;
    let pose_of = |row: usize| poses[row % poses.len()];
    let rss_beside = rows.residual(&beside.model).norm_squared();
    let white = Noise::white((rss_beside / rows.len() as f64).sqrt());
    let mut trial = problem.clone();
    trial.set_noise(&white, &beside.model);
    let solution = solve(&trial, &beside.model);
    let (left, columns) = rows.extract(&solution.model);
    let rss = left.norm_squared();
    let mut pulls = std::collections::BTreeMap::<u32, DVector<f64>>::new();
    for row in 0..rows.len() {
        let none = || DVector::zeros(columns.ncols());
        let pull = pulls.entry(pose_of(row)).or_insert_with(none);
        pull.axpy(left[row], &columns.row(row).transpose(), 1.0);
    }
    let p = solution.spectrum.rank() as f64;
    let rest = (pulls.len() * trial.axes()) as f64 - p;
    let f = (rss_beside - rss) / p / (rss / rest);
    if rest <= 0.0 || f <= 0.0 || f_tail(f, p, rest) > CHANCE {
        return None;
    }
    // The spectrum is that of rows in units of the noise.
    let unit = white.sigma_mm[0].powi(2);
    let inverse = solution.spectrum.inverse();
    let of_pull = |pull: &DVector<f64>| &inverse * pull / unit;
    let steps = pulls.values().map(of_pull);
    let none = DMatrix::zeros(columns.ncols(), columns.ncols());
    let sum = steps.fold(none, |sum, step| sum + &step * step.transpose());
    // Of few poses their own pulls are too small, as any residual is.
    let count = pulls.len() as f64;
    let covariance = sum * (count * trial.axes() as f64 / rest);
    drop(rows);
    *problem = trial;
    Some(Alike {
        solution,
        covariance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::unrepeated;
    use crate::fit::{base_model, base_model::Fitted};
    use crate::sessions::Session;

    fn fitted(session: &Session) -> (f64, Option<f64>) {
        let mut problem = Problem::new(session, JointValues::Commanded);
        let start = base_model::start(session, &problem, |_| true);
        let Fitted { solution, .. } = base_model::fit(&mut problem, &start, true);
        let rows = Rows::of(&problem);
        let left = |model: &crate::model::Model| rows.residual(model).norm_squared();
        let beside = left(&solution.model);
        let alike = alike(&mut problem.clone(), &solution);
        (beside, alike.map(|alike| left(&alike.solution.model)))
    }

    /// Joints that do not repeat are believed; a sag that is there in every pose is none of that.
    #[test]
    fn joints_that_do_not_repeat_are_told_from_a_sag() {
        for seed in 1..=6 {
            assert!(fitted(&unrepeated(2e-4, seed)).1.is_none(), "{seed}");
        }
        let mut session = unrepeated(2e-5, 1);
        let tilt = session.samples.q[0].clone();
        let z = session.samples.z_mm.as_mut().unwrap();
        for (z, q) in z.iter_mut().zip(tilt) {
            *z -= 0.8 * (2.0 * q).cos() + 0.5 * (3.0 * q).sin();
        }
        let (beside, alike) = fitted(&session);
        assert!(
            alike.is_none_or(|alike| alike <= beside),
            "{alike:?} {beside}"
        );
    }
}
