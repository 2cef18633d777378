//! What lies where along joint 1: samples sorted once by its angle, so that in every frame of a drag
//! regions are counted by a few searches each, however many samples there are.
//!
//! ```text
//! samples in (a, b) = C(b) − C(a),   C the number of samples below an angle
//! ```
//!
//! Samples on a boundary are counted one angle at a time, by the rule of [`crate::sessions::division`].

use crate::sessions::Region;
use crate::sessions::regions::Assignment;

/// Angles this close to a boundary are looked at one by one, rad: who owns them is decided within
/// a billionth.
const NEAR_RAD: f64 = 1e-8;

/// How many samples lie where along the joint.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Angles {
    /// Every angle at which there is a sample, ascending, rad.
    at_rad: Vec<f64>,
    /// Samples at all angles before it: one entry more than there are angles.
    below: Vec<Count>,
}

/// Numbers of samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Count {
    /// All of them, whether they can be used or not.
    pub(crate) all: usize,
    /// Those that a fit uses.
    pub(crate) fitted: usize,
}

impl Count {
    fn plus(self, other: Self) -> Self {
        Self {
            all: self.all + other.all,
            fitted: self.fitted + other.fitted,
        }
    }

    fn minus(self, other: Self) -> Self {
        Self {
            all: self.all - other.all,
            fitted: self.fitted - other.fitted,
        }
    }
}

impl Angles {
    /// Sorts the samples by their angle, rad; those without one are left out.
    pub(crate) fn new(q_rad: &[f64], is_fitted: impl Fn(usize) -> bool) -> Self {
        let known = (0..q_rad.len()).filter(|i| q_rad[*i].is_finite());
        let mut order: Vec<usize> = known.collect();
        order.sort_unstable_by(|a, b| q_rad[*a].total_cmp(&q_rad[*b]));
        let mut angles = Self {
            at_rad: Vec::new(),
            below: vec![Count::default()],
        };
        let mut sum = Count::default();
        for i in order {
            sum = sum.plus(Count {
                all: 1,
                fitted: usize::from(is_fitted(i)),
            });
            if angles.at_rad.last() == Some(&q_rad[i]) {
                angles.below.pop();
            } else {
                angles.at_rad.push(q_rad[i]);
            }
            angles.below.push(sum);
        }
        angles
    }

    /// All samples that have an angle.
    pub(crate) fn total(&self) -> Count {
        self.below.last().copied().unwrap_or_default()
    }

    /// The samples of each region.
    pub(crate) fn by_region(&self, regions: &[Region]) -> Vec<Count> {
        let mut counts = vec![Count::default(); regions.len()];
        pieces(&self.at_rad, regions, |owner, from, to| {
            counts[owner] = counts[owner].plus(self.below[to].minus(self.below[from]));
        });
        counts
    }
}

/// Divides ascending angles at the boundaries of regions, which may overlap and leave gaps. Calls
/// `see` with each region that owns the angles from one place to before another; angles close to a
/// boundary are decided one by one.
fn pieces(angles: &[f64], regions: &[Region], mut see: impl FnMut(usize, usize, usize)) {
    let assignment = Assignment::new(regions);
    let ends = regions.iter().flat_map(|r| [r.from_rad, r.to_rad]);
    let mut ends: Vec<f64> = ends.filter(|end| !end.is_nan()).collect();
    ends.sort_unstable_by(f64::total_cmp);
    let mut place = 0;
    let mut see = |from: usize, to: usize| {
        // All of them lie on the same side of every boundary.
        if from < to
            && let Some(owner) = assignment.region_of(angles[from])
        {
            see(owner, from, to);
        }
    };
    for end in ends {
        let below = angles.partition_point(|q| *q < end - NEAR_RAD).max(place);
        see(place, below);
        place = below;
        let near = angles.partition_point(|q| *q <= end + NEAR_RAD);
        while place < near {
            let here = angles[place];
            let next = place + angles[place..].partition_point(|q| *q <= here);
            see(place, next);
            place = next;
        }
    }
    see(place, angles.len());
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use crate::sessions::regions::Assignment;
    use crate::units::rad_from_deg;

    use super::*;

    #[test]
    fn regions_have_the_samples_that_the_identification_gives_them() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        for round in 0..200 {
            let mut angle = || rad_from_deg(f64::from(random.random_range(-40_i32..40)) * 3.0);
            // Whole steps: many samples on boundaries, gaps, and overlaps now and then.
            let mut ends: Vec<f64> = (0..8).map(|_| angle()).collect();
            // Some are off by a rounding, on either side of what still counts as on the boundary.
            let beside = [0.0, -5e-10, 5e-10, -1.5e-9, 1.5e-9];
            let q: Vec<f64> = (0..300)
                .map(|i| {
                    let missing = i % 50 == 0;
                    if missing {
                        f64::NAN
                    } else {
                        angle() + beside[i % 5]
                    }
                })
                .collect();
            ends.sort_by(f64::total_cmp);
            let all = ends.windows(2).enumerate().map(|(k, pair)| Region {
                name: k.to_string(),
                from_rad: pair[0],
                to_rad: pair[1],
            });
            let mut regions: Vec<Region> = all.filter(|r| r.from_rad < r.to_rad).collect();
            if round % 3 == 0 && regions.len() > 2 {
                regions.remove(1);
            }
            if round % 2 == 0 {
                regions.reverse();
            }
            if round % 7 == 0
                && let Some(region) = regions.first_mut()
            {
                region.to_rad += 0.2;
            }
            let assignment = Assignment::new(&regions);
            let mut expected = vec![Count::default(); regions.len()];
            for (i, q) in q.iter().enumerate() {
                if let Some(region) = assignment.region_of(*q) {
                    expected[region].all += 1;
                    expected[region].fitted += usize::from(i % 3 != 0);
                }
            }
            let angles = Angles::new(&q, |i| i % 3 != 0);
            assert_eq!(angles.by_region(&regions), expected, "round {round}");
            assert_eq!(angles.total().all, 294);
        }
    }
}
