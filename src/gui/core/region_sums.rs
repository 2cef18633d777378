//! What regions hold, for any boundaries at once: samples sorted by the angle of the joint, with
//! running sums of what the paper's corrections follow from.
//!
//! ```text
//! S(k) = Σ i<k (1, ΔPx, l1·ΔPy, l1², |ΔP|²),   a region from place a to place b has S(b) − S(a)
//! ```
//!
//! Sorting costs n log n once, in the background; then a dragged boundary costs a few searches for
//! each region, however many samples there are. ΔP = nominal − measured along the radial direction
//! at home and a quarter turn further, as in `fit::plane::sum_by_region`, with which a
//! test compares it.

use crate::effects::inputs::reflectors_at_home;
use crate::effects::{JointFrame, JointValues};
use crate::fit::gap::Deviations;
use crate::fit::plane::RegionSums;
use crate::fit::problem::Problem;
use crate::lanes::{dot, minus};
use crate::sessions::{Region, Session};

use super::angles::pieces;

/// Sums of 1, ΔPx, l1·ΔPy, l1², |ΔP|².
type Sums = [f64; 5];

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
    use super::*;
    use crate::fit::plane::sum_by_region;
    use crate::gui::testing::workbench;
    use crate::sessions::regions::Assignment;
    use crate::sessions::regions::testing::regions;

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
