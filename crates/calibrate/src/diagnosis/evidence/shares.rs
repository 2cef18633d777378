//! Nested cross-validation: the poses are dealt into shares, and each share is predicted by what the others chose.
//!
//! The gain of the best of many choices is biased upwards on the samples that chose it. Where the whole choice is
//! repeated without the samples that judge it, the gain there is unbiased (nested cross-validation: Varma & Simon
//! 2006, BMC Bioinformatics 7:91).

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::fit::regression::Rows;
use crate::sessions::poses::ByPose;

/// Into so many shares the poses are dealt.
pub(crate) const SHARES: usize = 10;

/// The share of each sample: places are dealt in an order that has nothing to do with theirs in the file, all samples of
/// one together.
pub(crate) fn dealt(rows: &Rows) -> Vec<usize> {
    let places = ByPose::of_places(&rows.inputs.q, rows.samples.len());
    let mut order: Vec<usize> = (0..places.first.len()).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(0));
    let mut share = vec![0; order.len()];
    for (rank, place) in order.into_iter().enumerate() {
        share[place] = rank % SHARES;
    }
    places.to_samples(&share)
}

/// The gain on unseen samples.
pub(crate) struct Gains {
    pub(crate) before_mm: f64,
    pub(crate) after_mm: f64,
    /// The gain in units of its standard deviation.
    pub(crate) sigmas: f64,
}

impl Gains {
    /// Of the squares of every sample without and with it, mm².
    pub(crate) fn of(rows: &Rows, squares: &[[f64; 2]]) -> Self {
        let count = rows.lengths().max(1) as f64;
        let rms = |k: usize| (squares.iter().map(|s| s[k]).sum::<f64>() / count).sqrt();
        // The rows of a pose share the error of repeatability: a pose is one observation.
        let poses = ByPose::of(rows.inputs.pose.as_deref(), squares.len()).samples();
        let gained = |i: &usize| squares[*i][0] - squares[*i][1];
        let of_pose = |own: &Vec<usize>| own.iter().map(gained).sum();
        let gains: Vec<f64> = poses.iter().map(of_pose).collect();
        let n = gains.len();
        let mean = gains.iter().sum::<f64>() / n as f64;
        let spread = gains.iter().map(|g| (g - mean).powi(2)).sum::<f64>();
        let sigma = (spread / (n * n) as f64).sqrt().max(f64::MIN_POSITIVE);
        Self {
            before_mm: rms(0),
            after_mm: rms(1),
            sigmas: mean / sigma,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::unrepeated;
    use crate::fit::problem::Problem;

    #[test]
    fn rows_of_a_pose_are_in_one_share_and_every_share_has_as_many_poses() {
        let session = unrepeated(0.0, 1);
        let problem = Problem::new(&session, JointValues::Commanded);
        let share = dealt(&Rows::of(&problem));
        let mut poses = [0; SHARES];
        for pose in share.chunks(3) {
            assert!(pose.iter().all(|s| *s == pose[0]));
            poses[pose[0]] += 1;
        }
        assert_eq!(poses, [6; SHARES]);
    }
}
