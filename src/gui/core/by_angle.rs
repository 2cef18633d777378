//! What lies where along joint 1: samples sorted once by its angle, so that in every frame of a drag
//! regions are counted and corrected by a few searches each, however many samples there are.
//!
//! ```text
//! samples in (a, b) = C(b) − C(a),   C the number of samples below an angle
//! S(k) = Σ i<k (1, ΔPx, l1·ΔPy, l1², |ΔP|²),   a region from place a to place b has S(b) − S(a)
//! ```
//!
//! Samples on a boundary are counted one angle at a time, by the rule of [`crate::sessions::division`].
//! ΔP = nominal − measured along the radial direction at home and a quarter turn further, as in
//! `fit::plane::sum_by_region`, with which a test compares it.

use crate::effects::inputs::reflectors_at_home;
use crate::effects::{JointFrame, JointValues};
use crate::fit::gap::Deviations;
use crate::fit::plane::RegionSums;
use crate::fit::problem::Problem;
use crate::lanes::{dot, minus};
use crate::sessions::regions::Assignment;
use crate::sessions::{Region, Session};

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

    /// Samples from one angle up to, but not at, another.
    pub(crate) fn between(&self, from_rad: f64, to_rad: f64) -> Count {
        let from = self.at_rad.partition_point(|q| *q < from_rad);
        let to = self.at_rad.partition_point(|q| *q < to_rad).max(from);
        self.below[to].minus(self.below[from])
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

/// Sums of 1, ΔPx, l1·ΔPy, l1², |ΔP|².
type Sums = [f64; 5];

/// What regions hold, for any boundaries at once: running sums over the samples by angle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RegionTotals {
    /// Angles of all samples that have one, ascending, rad.
    q: Vec<f64>,
    /// Sums over the samples to be fitted before each place; one more than angles.
    sums: Vec<Sums>,
}

/// What a region holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RegionContents {
    /// Samples in it, whether they are fitted or not.
    pub(crate) samples: usize,
    /// Sums over those to be fitted.
    pub(crate) sums: RegionSums,
}

impl RegionContents {
    /// Δθ in rad and Δl1 in mm, and the root mean square of what they leave in the plane, mm;
    /// `None` where nothing is to be fitted.
    pub(crate) fn correction(&self) -> Option<(f64, f64, f64)> {
        let sums = &self.sums;
        if sums.samples == 0 {
            return None;
        }
        let (theta, l1_mm) = sums.correction();
        let n = sums.samples as f64;
        let left = sums.square - n * l1_mm * l1_mm - sums.l1_l1 * theta * theta;
        Some((theta, l1_mm, (left.max(0.0) / n).sqrt()))
    }
}

impl RegionTotals {
    /// Sorts the samples of a session with a single joint that turns.
    pub(crate) fn new(session: &Session, frame: &JointFrame, before: &Deviations) -> Self {
        let problem = Problem::new(session, JointValues::Commanded);
        let [x, y] = frame.plane_of_motion();
        let radii = reflectors_at_home(session).into_iter().map(|home| {
            let arm = minus(home, frame.origin_mm);
            dot(arm, x).hypot(dot(arm, y))
        });
        let radii: Vec<f64> = radii.collect();
        let angles = (0_u32..).zip(&session.samples.q[0]);
        let mut order: Vec<(f64, u32)> = angles
            .filter(|(_, q)| !q.is_nan())
            .map(|(sample, q)| (*q, sample))
            .collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let targets = session.samples.target.as_deref();
        let mut sums = Vec::with_capacity(order.len() + 1);
        let mut sum = [0.0; 5];
        sums.push(sum);
        for (_, sample) in &order {
            let sample = *sample as usize;
            if problem.used[sample] {
                let e: [f64; 3] = std::array::from_fn(|axis| before.axes_mm[axis][sample]);
                let l1 = radii[targets.map_or(0, |t| t[sample] as usize)];
                let (dx, dy) = (-dot(e, x), -dot(e, y));
                let more = [1.0, dx, l1 * dy, l1 * l1, dx * dx + dy * dy];
                for (sum, more) in sum.iter_mut().zip(more) {
                    *sum += more;
                }
            }
            sums.push(sum);
        }
        Self {
            q: order.into_iter().map(|(q, _)| q).collect(),
            sums,
        }
    }

    /// What each of these regions holds; they may overlap, and leave gaps.
    pub(crate) fn held(&self, regions: &[Region]) -> Vec<RegionContents> {
        let mut held = vec![(0, [0.0; 5]); regions.len()];
        pieces(&self.q, regions, |owner, from, to| {
            let (samples, sums) = &mut held[owner];
            *samples += to - from;
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += self.sums[to][k] - self.sums[from][k];
            }
        });
        let held = held.into_iter();
        held.map(|(samples, sums)| RegionContents {
            samples,
            sums: region_sums(sums),
        })
        .collect()
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a sum of ones: a whole number from 0 to the number of samples"
)]
fn region_sums([samples, dx, l1_dy, l1_l1, square]: Sums) -> RegionSums {
    RegionSums {
        samples: samples as usize,
        dx,
        l1_dy,
        l1_l1,
        square,
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use crate::fit::plane::sum_by_region;
    use crate::gui::testing::workbench;
    use crate::sessions::regions::Assignment;
    use crate::sessions::regions::testing::regions;
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

    /// Divisions of every kind; many boundaries are where samples are.
    fn divisions() -> Vec<Vec<Region>> {
        vec![
            regions(&[(-90.0, 90.0)]),
            regions(&[(-90.0, -30.0), (-30.0, 0.0), (0.0, 27.0), (27.0, 90.0)]),
            regions(&[(0.0, 45.0), (-45.0, 0.0)]),
            regions(&[(-60.5, -10.0), (10.0, 33.3)]),
            // Overlapping, and one within another.
            regions(&[(-90.0, 30.0), (-30.0, 60.0), (-3.0, 3.0)]),
            regions(&[(100.0, 120.0)]),
            regions(&[]),
        ]
    }

    #[test]
    fn every_division_has_the_sums_that_looking_at_every_sample_finds() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let totals = loaded_session.region_totals();
        let mut problem = Problem::new(&loaded_session.session, JointValues::Commanded);
        problem.axis_weights = [1.0, 1.0, 0.0];
        for regions in divisions() {
            let (expected, _) = sum_by_region(&problem, &regions);
            let found = totals.held(&regions);
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(found.sums.samples, expected.samples, "{regions:?}");
                let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + b.abs());
                assert!(near(found.sums.dx, expected.dx), "{found:?} {expected:?}");
                assert!(near(found.sums.l1_dy, expected.l1_dy));
                assert!(near(found.sums.l1_l1, expected.l1_l1));
                assert!(near(found.sums.square, expected.square));
            }
        }
    }

    #[test]
    fn samples_are_counted_as_one_by_one() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let totals = loaded_session.region_totals();
        for regions in divisions() {
            let assignment = Assignment::new(&regions);
            let mut counts = vec![0; regions.len()];
            for q in &loaded_session.session.samples.q[0] {
                if let Some(region) = assignment.region_of(*q) {
                    counts[region] += 1;
                }
            }
            let found = totals.held(&regions).into_iter().map(|held| held.samples);
            assert_eq!(found.collect::<Vec<_>>(), counts, "{regions:?}");
        }
    }

    #[test]
    fn the_corrections_are_those_of_the_identification() {
        use crate::fit::identify_regional;
        use crate::sessions::division::RegionChoice;
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let regions = regions(&[(-90.0, -30.0), (-30.0, 27.0), (27.0, 90.0)]);
        let totals = loaded_session.region_totals();
        let choice = RegionChoice::Given(regions.clone());
        let whole = identify_regional(&loaded_session.session, &choice, JointValues::Commanded)
            .expect("it can be identified");
        for (held, result) in totals.held(&regions).iter().zip(&whole.regions) {
            let (theta, l1_mm, left_mm) = held.correction().expect("there are samples");
            assert!((theta - result.correction.theta_rad).abs() < 1e-12);
            assert!((l1_mm - result.correction.l1_mm).abs() < 1e-9);
            assert!(
                (left_mm - result.rms_after_mm).abs() < 1e-6,
                "{left_mm} {result:?}"
            );
        }
    }
}
