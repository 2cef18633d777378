//! The normal equations with the error of repeatability: residual and columns go through the filter of
//! [`joints`](super::noise::joints), sample by sample along all axes, before they are summed.

use crate::effects::block::Block;
use crate::lanes::{LANES, Lanes};

use super::levers::Levers;
use super::noise::joints::{Predictor, whitened};
use super::normal::{Normal, Sums, dot};
use super::problem::Problem;

/// The filter on its way through the samples.
pub(super) struct Unrepeated<'p> {
    levers: &'p Levers,
    predictor: Predictor,
    /// One after the other of each column, the residual last.
    states: Vec<f64>,
    row: Vec<f64>,
    /// The last block after the filter along each axis, the residual last.
    white: [Vec<Lanes>; 3],
}

impl<'p> Unrepeated<'p> {
    /// For so many columns; `None` where the joints repeat.
    pub(super) fn new(problem: &'p Problem, columns: usize) -> Option<Self> {
        let noise = problem.noise.as_ref().filter(|n| n.joints_rad > 0.0)?;
        let levers = problem.levers.as_deref()?;
        let predictor = Predictor::new(noise, levers.joints());
        Some(Self {
            levers,
            states: vec![0.0; predictor.states * (columns + 1)],
            row: vec![0.0; predictor.width()],
            white: std::array::from_fn(|_| vec![[0.0; LANES]; columns + 1]),
            predictor,
        })
    }

    fn whiten(&mut self, problem: &Problem, start: usize, block: &Block, mask: &Lanes) {
        let last = self.white[0].len() - 1;
        let residual: [Lanes; 3] =
            std::array::from_fn(|axis| problem.residual(axis, start, block, mask));
        for white in self.white.iter_mut().flatten() {
            white.fill(0.0);
        }
        let poses = problem.inputs.pose.as_deref();
        for i in (0..block.len).filter(|i| mask[*i] != 0.0) {
            let sample = start + i;
            let pose = poses.map_or(sample, |poses| poses[sample] as usize);
            let passage = self.predictor.advance(problem.time(sample), pose);
            for states in self.states.chunks_mut(self.predictor.states) {
                self.predictor.pass(passage, states);
            }
            for axis in (0..3).filter(|axis| problem.axis_weights[*axis] > 0.0) {
                let lever = self.levers.of(sample, axis);
                self.predictor
                    .take(axis, |joint| lever[joint], &mut self.row);
                let each = self.states.chunks_mut(self.predictor.states).enumerate();
                for (k, states) in each {
                    let value = if k == last {
                        residual[axis][i]
                    } else {
                        block.columns[k][axis][i]
                    };
                    self.white[axis][k][i] = whitened(&self.row, states, value);
                }
            }
        }
    }
}

impl Normal {
    /// Adds one block of samples with noise that rows of a pose share.
    pub(super) fn add_with_joint_noise(
        &mut self,
        problem: &Problem,
        start: usize,
        block: &Block,
        sums: Sums,
        unrepeated: &mut Unrepeated,
    ) {
        let mask = problem.mask(start, block.len);
        unrepeated.whiten(problem, start, block, &mask);
        for axis in (0..3).filter(|axis| problem.axis_weights[*axis] > 0.0) {
            let Some((residual, white)) = unrepeated.white[axis].split_last() else {
                continue;
            };
            self.cost += dot(residual, residual);
            self.weight += mask.iter().sum::<f64>();
            for (k, own) in white.iter().enumerate() {
                self.gradient[k] += dot(own, residual);
                if sums == Sums::Gradient {
                    continue;
                }
                for (j, other) in white[..=k].iter().enumerate() {
                    self.gram[(k, j)] += dot(own, other);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::base_model;
    use crate::fit::estimator::fit_without_outliers;
    use crate::fit::estimator::noise_given;
    use crate::fit::example::unrepeated;
    use crate::fit::noise::{Noise, Slow};
    use crate::fit::regression::Rows;
    use crate::fit::solver::equations_at;

    /// Sums sample by sample are the products of rows that were whitened as a whole.
    #[test]
    fn sums_are_the_products_of_whitened_rows() {
        let session = unrepeated(1e-4, 1);
        let mut problem = Problem::new(&session, JointValues::Commanded);
        let start = base_model::start(&session, &problem, |_| true);
        let solution = fit_without_outliers(&mut problem, &start);
        let slow = Slow {
            rms_mm: [0.05, 0.02, 0.0],
            time_constant_s: 9.0,
        };
        for slow in [None, Some(slow)] {
            let noise = Noise {
                sigma_mm: [0.02, 0.03, 0.01],
                joints_rad: 2e-4,
                slow,
                ..Noise::white(1.0)
            };
            problem.levers = None;
            problem.set_noise(&noise, &solution.model);
            problem.used[4] = false;
            let normal = equations_at(&problem, &solution);
            let rows = Rows::of(&problem).seen_by(&solution.model);
            let (residual, columns) = rows.extract(&solution.model);
            let white = noise.whitened(&rows, &columns);
            let white_residual = noise.whitened_vector(&rows, &residual);
            let mut expected = Normal::new(columns.ncols());
            problem.priors.add(&solution.model, &mut expected);
            let gram = &expected.gram + white.tr_mul(&white);
            let gradient = &expected.gradient + white.tr_mul(&white_residual);
            assert!((&normal.gram - &gram).norm() < 1e-9 * gram.norm());
            assert!(
                (&normal.gradient - &gradient).norm()
                    < 1e-9 * gradient.norm().max(gram.norm() * 1e-6)
            );
            assert!(
                (normal.cost - expected.cost - white_residual.norm_squared()).abs()
                    < 1e-6 * normal.cost
            );
        }
    }

    /// The rows of a pose show both the repeatability of the robot and the noise of the instrument; a robot that
    /// repeats, the latter alone.
    #[test]
    fn what_the_joints_do_not_repeat_is_told_from_the_instrument() {
        for (joints_rad, seed) in [(2e-4, 1), (5e-5, 2), (0.0, 3), (0.0, 4)] {
            let session = unrepeated(joints_rad, seed);
            let mut problem = Problem::new(&session, JointValues::Commanded);
            let start = base_model::start(&session, &problem, |_| true);
            let solution = fit_without_outliers(&mut problem, &start);
            let noise = noise_given(&problem, &solution.model, &[]);
            if joints_rad == 0.0 {
                assert_eq!(noise.joints_rad, 0.0, "{seed}");
                continue;
            }
            // 120 errors of joints: their spread is known to 6.5 %.
            let ratio = noise.joints_rad / joints_rad;
            assert!((0.8..1.25).contains(&ratio), "{ratio}");
            let white = noise.total_mm(&[0, 1, 2]) / 0.02;
            assert!((0.9..1.1).contains(&white), "{white}");
        }
    }

    /// So do the three coordinates of a single reflector: how far a joint moves it, and which way, differs from pose
    /// to pose. Fifteen sessions in which the robot repeats show none of it, and the instrument keeps its stated
    /// noise.
    #[test]
    fn one_reflector_tells_what_the_joints_do_not_repeat() {
        let noise_of = |joints_rad: f64, seed: u64| {
            let mut session = unrepeated(joints_rad, seed);
            let first: Vec<Option<usize>> = (0..60).map(|pose| Some(3 * pose)).collect();
            session.samples.select(&first);
            let mut problem = Problem::new(&session, JointValues::Commanded);
            assert!(problem.inputs.pose.is_none());
            let start = base_model::start(&session, &problem, |_| true);
            let solution = fit_without_outliers(&mut problem, &start);
            noise_given(&problem, &solution.model, &[])
        };
        for (joints_rad, seed) in [(2e-4, 1), (1e-3, 2)] {
            let noise = noise_of(joints_rad, seed);
            let ratio = noise.joints_rad / joints_rad;
            assert!((0.75..1.3).contains(&ratio), "{ratio}");
            let white = noise.total_mm(&[0, 1, 2]);
            assert!((0.02..0.03).contains(&white), "{white}");
        }
        for seed in 3..18 {
            assert_eq!(noise_of(0.0, seed).joints_rad, 0.0, "{seed}");
        }
    }
}
