//! Which samples share a pose: those that were measured one after the other with the same commands. The robot has not
//! moved between them, so that what it does not repeat is the same in all of them, whichever reflector, instrument or
//! kind of measurement saw it. They are no independent evidence of the robot.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::Samples;
use super::measuring_order::measuring_order;

/// For each sample the number of its pose, in the order of measuring; `None` where every sample has its own. With a
/// joint that moves while it is measured every sample is a pose.
pub fn poses(samples: &Samples) -> Option<Vec<u32>> {
    let n = samples.len();
    let clock = samples.time_s.as_deref().filter(|times| times.len() == n);
    let order = measuring_order(clock);
    let at = |k: usize| order.as_ref().map_or(k, |order| order[k]);
    let mut of = vec![0; n];
    let mut pose = 0;
    for k in 1..n {
        pose += u32::from(!stands_still(samples, at(k - 1), at(k)));
        of[at(k)] = pose;
    }
    (pose as usize + 1 < n).then_some(of)
}

/// Some samples by their poses.
#[derive(Debug, Clone)]
pub struct ByPose {
    /// The first sample of each pose.
    pub first: Vec<usize>,
    /// For each sample which of these it belongs to.
    of: Vec<usize>,
}

impl ByPose {
    /// Of so many samples with these poses; without any, each is one.
    pub fn of(pose: Option<&[u32]>, samples: usize) -> Self {
        let Some(pose) = pose else {
            return Self {
                first: (0..samples).collect(),
                of: (0..samples).collect(),
            };
        };
        let mut known = BTreeMap::new();
        let mut first = Vec::new();
        let of = pose.iter().enumerate().map(|(sample, pose)| {
            *known.entry(pose).or_insert_with(|| {
                first.push(sample);
                first.len() - 1
            })
        });
        let of = of.collect();
        Self { first, of }
    }

    /// By where the robot was sent, however often it came back there.
    pub fn of_places(q: &[Cow<[f64]>], samples: usize) -> Self {
        let mut known = BTreeMap::new();
        let place = |sample: usize| -> u32 {
            let own: Vec<u64> = q.iter().map(|q| (q[sample] + 0.0).to_bits()).collect();
            let next = u32::try_from(known.len()).unwrap_or(u32::MAX);
            *known.entry(own).or_insert(next)
        };
        let places: Vec<u32> = (0..samples).map(place).collect();
        Self::of(Some(&places), samples)
    }

    /// The samples of each pose.
    pub fn samples(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new(); self.first.len()];
        for (sample, pose) in self.of.iter().enumerate() {
            all[*pose].push(sample);
        }
        all
    }

    /// What part each sample is of its pose.
    pub fn shares(&self) -> Vec<f64> {
        let counts: Vec<f64> = self.samples().iter().map(|own| own.len() as f64).collect();
        self.of.iter().map(|pose| 1.0 / counts[*pose]).collect()
    }

    /// What each sample has of what was worked out for the poses.
    pub fn to_samples<T: Copy>(&self, of_poses: &[T]) -> Vec<T> {
        self.of.iter().map(|pose| of_poses[*pose]).collect()
    }
}

/// Whether the robot has not moved from one sample to the next, as far as the commands say.
fn stands_still(samples: &Samples, before: usize, now: usize) -> bool {
    let at = |column: &Vec<f64>, sample: usize| column.get(sample).copied().unwrap_or(f64::NAN);
    let both = |column: &Vec<f64>| (at(column, before), at(column, now));
    let same = |q: &Vec<f64>| at(q, before) == at(q, now);
    // An unknown side is any.
    let from_other_side = |dir: &Vec<f64>| matches!(both(dir), (a, b) if a * b < 0.0);
    let moves = |speed: &Vec<f64>| matches!(both(speed), (a, b) if a.abs() > 0.0 || b.abs() > 0.0);
    let loaded = |load: &Vec<f64>| matches!(both(load), (a, b) if (a - b).abs() > 0.0);
    samples.q.iter().all(same)
        && !samples.dir.iter().flatten().any(from_other_side)
        && !samples.speed.iter().flatten().any(moves)
        && !samples.load_kg.iter().any(loaded)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(q: &[f64]) -> Samples {
        Samples {
            q: vec![q.to_vec()],
            x_mm: vec![0.0; q.len()],
            y_mm: vec![0.0; q.len()],
            ..Samples::default()
        }
    }

    #[test]
    fn consecutive_samples_with_the_same_commands_share_a_pose() {
        let mut three = samples(&[0.1, 0.1, 0.2, 0.2, 0.2, 0.1]);
        assert_eq!(poses(&three), Some(vec![0, 0, 1, 1, 1, 2]));
        assert_eq!(poses(&samples(&[0.1, 0.2, 0.1, 0.2])), None);
        assert_eq!(poses(&samples(&[])), None);
        // Turned round, another load, or on the move.
        three.dir = vec![Some(vec![f64::NAN, 1.0, 1.0, -1.0, -1.0, -1.0])];
        assert_eq!(poses(&three), Some(vec![0, 0, 1, 2, 2, 3]));
        three.load_kg = Some(vec![0.0, 3.0, 3.0, 3.0, 3.0, 3.0]);
        assert_eq!(poses(&three), Some(vec![0, 1, 2, 3, 3, 4]));
        three.speed = vec![Some(vec![0.3; 6])];
        assert_eq!(poses(&three), None);
        // A missing command is no other.
        assert_eq!(poses(&samples(&[f64::NAN, f64::NAN])), None);
    }

    #[test]
    fn what_is_worked_out_for_poses_holds_for_all_their_samples() {
        let by_pose = ByPose::of(Some(&[4, 4, 7, 4, 9]), 5);
        assert_eq!(by_pose.first, [0, 2, 4]);
        assert_eq!(
            by_pose.to_samples(&['a', 'b', 'c']),
            ['a', 'a', 'b', 'a', 'c']
        );
        assert_eq!(ByPose::of(None, 3).to_samples(&[5, 6, 7]), [5, 6, 7]);
        let q = [
            Cow::from(vec![0.5, 0.0, 0.5, -0.0]),
            Cow::from(vec![1.0; 4]),
        ];
        let places = ByPose::of_places(&q, 4);
        assert_eq!(places.first, [0, 1]);
        assert_eq!(places.to_samples(&['a', 'b']), ['a', 'b', 'a', 'b']);
        assert_eq!(places.samples(), [[0, 2], [1, 3]]);
        assert_eq!(places.shares(), [0.5; 4]);
    }

    /// Sorted by angle, what was measured in two visits lies side by side; the clock tells them apart.
    #[test]
    fn a_file_that_was_sorted_has_the_poses_of_its_clock() {
        let values = [0.1, 0.2, 0.3].map(|q| [q; 4]).concat();
        let times = [0.0, 20.0, 40.0].map(|t| [t, t + 9.0, t + 70.0, t + 79.0]);
        let mut sorted = samples(&values);
        sorted.time_s = Some(times.concat());
        let of = poses(&sorted).unwrap();
        assert_eq!(of[0], of[1]);
        assert_eq!(of[2], of[3]);
        assert_ne!(of[1], of[2]);
        sorted.time_s = None;
        let of = poses(&sorted).unwrap();
        assert_eq!(of[0], of[3]);
    }
}
