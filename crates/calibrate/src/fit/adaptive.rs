//! Adaptive regions: the division of the sorted samples that minimises
//!
//! ```text
//! Σ over regions ( cost / σ² + 3 ln 2n )
//! ```
//!
//! where a region's cost is the residual of |ΔP|² after its own constant correction (7), and each region pays for its
//! two corrections and its boundary by the Bayesian information criterion (Schwarz 1978; Jackson et al. 2005 for the
//! optimal partition). Dynamic programming over the boundaries finds the best division of all; a long session is first
//! gathered into cells of neighbouring samples, so that the work is linear in the samples.
//!
//! A region costs four numbers of the report and hides the cause: an effect that explains the whole range is always
//! the better answer, and the exact method searches for it.

use truepose_session::refusal::Refusal;

use super::plane::Plane;
use super::problem::Problem;
use crate::effects::JointValues;
use crate::sessions::division::{DEFAULT_REGIONS, RegionChoice, between, range_to_divide, uniform};
use crate::sessions::{Region, Session, Sigma};
use crate::{budget, fewest, rounding};

/// The regions that a choice means for a session with one joint.
///
/// # Errors
/// [`Refusal`] where the choice makes no sense for the session.
pub fn regions_of(choice: &RegionChoice, session: &Session) -> Result<Vec<Region>, Refusal> {
    match choice {
        RegionChoice::FromSession if session.regions.is_empty() => {
            uniform(session, DEFAULT_REGIONS)
        }
        RegionChoice::FromSession => Ok(session.regions.clone()),
        RegionChoice::Uniform(number) => uniform(session, *number),
        RegionChoice::Boundaries(boundaries) => between(boundaries),
        RegionChoice::Given(regions) => Ok(regions.clone()),
        RegionChoice::Adaptive => adaptive(session.whole()?.as_ref()),
    }
}

/// The regions that the samples ask for, over the joint's limits, else over the data's range.
fn adaptive(session: &Session) -> Result<Vec<Region>, Refusal> {
    let range = range_to_divide(session)?;
    let problem = Problem::new(session, JointValues::Commanded);
    let plane = Plane::new(&problem);
    let mut samples: Vec<Sample> = Vec::with_capacity(problem.samples());
    plane.each_sample(&problem.used, |i, dx, dy, l1| {
        let q = problem.inputs.q[0][i];
        samples.push(Sample { q, dx, dy, l1 });
    });
    samples.sort_by(|a, b| a.q.total_cmp(&b.q));
    let variance = noise_variance(session, &samples);
    let cells = gather(&samples);
    let price = 3.0 * (2.0 * samples.len().max(1) as f64).ln();
    let cuts = best_cuts(&cells, variance, price);
    let inner = cuts
        .iter()
        .map(|k| 0.5 * (cells[k - 1].last_q + cells[*k].first_q));
    let inner = inner.filter(|q| *q > range.from && *q < range.to);
    let boundaries: Vec<f64> = [range.from]
        .into_iter()
        .chain(inner)
        .chain([range.to])
        .collect();
    between(&boundaries)
}

/// A sample in the plane of motion.
#[derive(Debug, Clone, Copy)]
struct Sample {
    q: f64,
    dx: f64,
    dy: f64,
    l1: f64,
}

/// Neighbouring samples that stay together, as the sums from which a correction's cost follows.
#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    first_q: f64,
    last_q: f64,
    sums: SegmentSums,
}

/// Sums over samples.
#[derive(Debug, Clone, Copy, Default)]
struct SegmentSums {
    n: f64,
    dx: f64,
    l1_dy: f64,
    l1_l1: f64,
    square: f64,
}

impl SegmentSums {
    fn of(s: &Sample) -> Self {
        Self {
            n: 1.0,
            dx: s.dx,
            l1_dy: s.l1 * s.dy,
            l1_l1: s.l1 * s.l1,
            square: s.dx * s.dx + s.dy * s.dy,
        }
    }

    fn plus(&self, o: &Self, sign: f64) -> Self {
        Self {
            n: self.n + sign * o.n,
            dx: self.dx + sign * o.dx,
            l1_dy: self.l1_dy + sign * o.l1_dy,
            l1_l1: self.l1_l1 + sign * o.l1_l1,
            square: self.square + sign * o.square,
        }
    }

    /// The residual of Σ |ΔP|² after the least-squares correction (7).
    fn cost(&self) -> f64 {
        let along = if self.n > 0.0 {
            self.dx * self.dx / self.n
        } else {
            0.0
        };
        let around = if self.l1_l1 > 0.0 {
            self.l1_dy * self.l1_dy / self.l1_l1
        } else {
            0.0
        };
        (self.square - along - around).max(0.0)
    }
}

/// Samples at one angle stay together, and so do neighbours where there are too many.
fn gather(samples: &[Sample]) -> Vec<Cell> {
    let least = samples.len().div_ceil(budget::SAMPLES);
    let mut cells: Vec<Cell> = Vec::new();
    for sample in samples {
        let sums = SegmentSums::of(sample);
        match cells.last_mut() {
            Some(cell) if sample.q == cell.last_q || cell.sums.n < least as f64 => {
                cell.last_q = sample.q;
                cell.sums = cell.sums.plus(&sums, 1.0);
            }
            _ => cells.push(Cell {
                first_q: sample.q,
                last_q: sample.q,
                sums,
            }),
        }
    }
    cells
}

/// Places at which the cells are cut, ascending.
fn best_cuts(cells: &[Cell], variance: f64, price: f64) -> Vec<usize> {
    let mut before = vec![SegmentSums::default()];
    for cell in cells {
        before.push(before[before.len() - 1].plus(&cell.sums, 1.0));
    }
    let m = cells.len();
    // best[k]: the smallest sum for the first k cells; from[k]: where their last region begins.
    let mut best = vec![f64::INFINITY; m + 1];
    let mut from = vec![0; m + 1];
    best[0] = 0.0;
    for end in 1..=m {
        for start in 0..end {
            let inside = before[end].plus(&before[start], -1.0);
            let too_few = inside.n < fewest::NO_ACCIDENT as f64 && !(start == 0 && end == m);
            if too_few || best[start].is_infinite() {
                continue;
            }
            let sum = best[start] + inside.cost() / variance + price;
            if sum < best[end] {
                best[end] = sum;
                from[end] = start;
            }
        }
    }
    let mut cuts = Vec::new();
    let mut end = m;
    while end > 0 && best[end].is_finite() {
        end = from[end];
        if end > 0 {
            cuts.push(end);
        }
    }
    cuts.reverse();
    cuts
}

/// Noise of a coordinate, mm²: the instrument's, or what neighbours in angle differ by, whichever
/// is larger. Neighbours differ by the noise and by how far the deviation goes on between them;
/// finer than that no region can follow it.
fn noise_variance(session: &Session, samples: &[Sample]) -> f64 {
    let stated = match session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => sigma,
        Some(Sigma::PerAxis(sigma)) => f64::midpoint(sigma[0].powi(2), sigma[1].powi(2)).sqrt(),
        None => 0.0,
    };
    stated
        .max(seen_noise(samples))
        .max(rounding::WRITTEN)
        .powi(2)
}

/// The noise from the differences of neighbours, as the standard deviation of a coordinate, mm.
fn seen_noise(samples: &[Sample]) -> f64 {
    let pairs = samples.windows(2);
    let mut steps: Vec<f64> = pairs
        .flat_map(|p| [(p[1].dx - p[0].dx).abs(), (p[1].dy - p[0].dy).abs()])
        .collect();
    let middle = steps.len() / 2;
    let median = if steps.is_empty() {
        0.0
    } else {
        *steps.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    // The median of |a − b| of two Gaussian numbers is 0.954 σ.
    median / 0.954
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    fn cells(levels: &[(f64, usize)]) -> Vec<Cell> {
        let mut q = 0.0;
        let mut samples = Vec::new();
        for (level, count) in levels {
            for k in 0..*count {
                q += 0.01;
                let ripple = if k % 2 == 0 { 0.01 } else { -0.01 };
                samples.push(Sample {
                    q,
                    dx: level + ripple,
                    dy: 0.0,
                    l1: 250.0,
                });
            }
        }
        gather(&samples)
    }

    #[test]
    fn a_step_in_the_deviation_becomes_a_boundary_where_it_is() {
        let cells = cells(&[(0.0, 20), (1.0, 15), (0.2, 25)]);
        assert_eq!(best_cuts(&cells, 0.01 * 0.01, 15.0), [20, 35]);
    }

    #[test]
    fn a_constant_deviation_is_one_region() {
        assert!(best_cuts(&cells(&[(0.7, 60)]), 0.01 * 0.01, 15.0).is_empty());
    }

    #[test]
    fn samples_at_one_angle_stay_together() {
        let samples = [0.0, 0.0, 0.1, 0.1, 0.1].map(|q| Sample {
            q,
            dx: 1.0,
            dy: 0.0,
            l1: 250.0,
        });
        assert_eq!(gather(&samples).len(), 2);
    }

    #[test]
    fn the_cost_is_what_the_least_squares_correction_leaves() {
        let samples = (0..30).map(f64::from).map(|k| Sample {
            q: k,
            dx: (1.7 * k).sin(),
            dy: 0.01 * k + (2.3 * k).cos(),
            l1: 250.0 + 13.0 * (k * k % 7.0),
        });
        let samples: Vec<Sample> = samples.collect();
        let sums = |some: &[Sample]| {
            let all = some.iter().map(SegmentSums::of);
            all.fold(SegmentSums::default(), |sum, one| sum.plus(&one, 1.0))
        };
        // The sums of some are those of all without those before.
        let some = &samples[11..];
        let cost = sums(&samples).plus(&sums(&samples[..11]), -1.0).cost();
        let cost_at = |along: f64, around: f64| -> f64 {
            let one = |s: &Sample| (s.dx - along).powi(2) + (s.dy - around * s.l1).powi(2);
            some.iter().map(one).sum()
        };
        let along = some.iter().map(|s| s.dx).sum::<f64>() / some.len() as f64;
        let turned: f64 = some.iter().map(|s| s.l1 * s.dy).sum();
        let around = turned / some.iter().map(|s| s.l1 * s.l1).sum::<f64>();
        assert!((cost - cost_at(along, around)).abs() < 1e-9);
        for (more, turn) in [(0.01, 0.0), (-0.01, 0.0), (0.0, 1e-4), (0.0, -1e-4)] {
            assert!(cost_at(along + more, around + turn) > cost + 1e-4);
        }
    }

    #[test]
    fn no_region_has_too_few_samples() {
        let few = fewest::NO_ACCIDENT - 1;
        let cuts = best_cuts(&cells(&[(0.0, few), (1.0, 30)]), 0.01 * 0.01, 15.0);
        assert!(cuts.iter().all(|cut| *cut > few), "{cuts:?}");
        let cuts = best_cuts(&cells(&[(0.0, few + 1), (1.0, 30)]), 0.01 * 0.01, 15.0);
        assert_eq!(cuts, [few + 1]);
        // All samples may be fewer.
        assert!(best_cuts(&cells(&[(0.7, few)]), 0.01 * 0.01, 15.0).is_empty());
    }

    #[test]
    fn noise_is_seen_in_what_neighbours_differ_by() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
        let samples: Vec<Sample> = (0..2000)
            .map(|k| {
                let q = f64::from(k) * 1e-3;
                Sample {
                    q,
                    dx: q.sin() + 0.02 * noise(),
                    dy: q.cos() + 0.02 * noise(),
                    l1: 250.0,
                }
            })
            .collect();
        let seen = seen_noise(&samples);
        assert!((seen - 0.02).abs() < 0.001, "{seen}");
        assert!(seen_noise(&samples[..1]).abs() < f64::MIN_POSITIVE);
    }
}
