//! The plane in which a single axis moves its reflectors, and the sums over it from which the
//! paper's corrections follow.
//!
//! x is the radial direction at home, y a quarter turn further; ΔP = nominal − measured, and l1 is
//! the reflector's distance from the axis.

use crate::effects::JointFrame;
use crate::effects::inputs::reflectors_at_home;
use crate::lanes::{LANES, Lanes, TOGETHER, add_scaled, dot, minus};
use crate::sessions::Region;
use crate::sincos::sin_cos_all;
use crate::wide::{Loop, wide};

use super::problem::Problem;
use crate::sessions::regions::Assignment;

/// Sums of one region, from which its least squares follow.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RegionSums {
    /// Number of samples.
    pub samples: usize,
    /// Σ ΔPx, mm.
    pub dx: f64,
    /// Σ l1·ΔPy, mm².
    pub l1_dy: f64,
    /// Σ l1², mm².
    pub l1_l1: f64,
    /// Σ |ΔP|², mm².
    pub square: f64,
}

impl RegionSums {
    /// Adds sums of 1, ΔPx, ΔPy and |ΔP|² over samples with the same l1.
    fn add(&mut self, [samples, dx, dy, square]: [f64; 4], l1: f64) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a sum of ones: a whole number from 0 to the number of samples"
        )]
        let counted = samples as usize;
        self.samples += counted;
        self.dx += dx;
        self.l1_dy += l1 * dy;
        self.l1_l1 += l1 * l1 * samples;
        self.square += square;
    }

    /// Δθ in rad and Δl1 in mm, by (7).
    pub fn correction(&self) -> (f64, f64) {
        let theta = if self.l1_l1 > 0.0 {
            self.l1_dy / self.l1_l1
        } else {
            0.0
        };
        (theta, self.dx / self.samples as f64)
    }
}

/// Sums over all samples that count, one for each region, and the number of samples in none.
pub fn sum_by_region(problem: &Problem, regions: &[Region]) -> (Vec<RegionSums>, usize) {
    let plane = Plane::new(problem);
    let assignment = Assignment::new(regions);
    // A slot for each region and target, so that l1 is the same throughout a slot; after the
    // regions one for samples in none, and one for samples that do not count.
    let slots = regions.len() + 2;
    let mut copies = vec![[[0.0; 4]; TOGETHER]; slots * plane.homes.len()];
    wide(Summing {
        plane: &plane,
        used: &problem.used,
        assignment: &assignment,
        slots,
        copies: &mut copies,
    });
    let mut sums = vec![RegionSums::default(); slots];
    for (slot, copies) in copies.iter().enumerate() {
        let l1 = plane.homes[slot / slots].2;
        for copy in copies {
            sums[slot % slots].add(*copy, l1);
        }
    }
    let outside = sums[regions.len()].samples;
    sums.truncate(regions.len());
    (sums, outside)
}

/// The loop of [`sum_by_region`].
struct Summing<'a> {
    plane: &'a Plane<'a>,
    used: &'a [bool],
    assignment: &'a Assignment<'a>,
    slots: usize,
    copies: &'a mut [[[f64; 4]; TOGETHER]],
}

impl Loop for Summing<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let mut places = [0; LANES];
        let uncounted = self.slots - 1;
        let mut block = PlaneBlock::default();
        for start in (0..self.used.len()).step_by(LANES) {
            self.plane.fill(start, &mut block);
            self.assignment.regions_of(&block.q, &mut places);
            let used = &self.used[start..start + block.len];
            for (lane, used) in used.iter().enumerate() {
                let place = if *used { places[lane] } else { uncounted };
                let (dx, dy) = (block.dx[lane], block.dy[lane]);
                let slot = place + self.slots * block.target[lane];
                let sums = &mut self.copies[slot][lane % TOGETHER];
                let add = [1.0, dx, dy, dx * dx + dy * dy];
                for (sum, value) in sums.iter_mut().zip(add) {
                    *sum += value;
                }
            }
        }
    }
}

/// The plane in which a single axis moves its reflectors, and the samples in it.
pub(super) struct Plane<'a> {
    origin: [f64; 3],
    x: [f64; 3],
    y: [f64; 3],
    /// Whether x and y are those of the measuring frame.
    flat: bool,
    /// In-plane coordinates of every reflector at home, and its distance from the axis.
    homes: Vec<(f64, f64, f64)>,
    q: &'a [f64],
    measured: [&'a [f64]; 2],
    measured_z: Option<&'a [f64]>,
    target: Option<&'a [u32]>,
}

/// A block of samples in the plane.
pub(super) struct PlaneBlock {
    /// Number of samples; the lanes behind them mean nothing.
    pub(super) len: usize,
    /// Joint angle, rad.
    q: Lanes,
    /// ΔP along x, mm.
    pub(super) dx: Lanes,
    /// ΔP along y, mm.
    pub(super) dy: Lanes,
    /// Index of the reflector.
    target: [usize; LANES],
}

impl Default for PlaneBlock {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            len: 0,
            q: zero,
            dx: zero,
            dy: zero,
            target: [0; LANES],
        }
    }
}

impl<'a> Plane<'a> {
    /// The plane of a session with a single revolute joint.
    pub(super) fn new(problem: &'a Problem) -> Self {
        let session = problem.session;
        let frame = JointFrame::new(&session.robot, 0);
        let [x, y] = frame.plane_of_motion();
        let homes = reflectors_at_home(session).into_iter().map(|home| {
            let arm = minus(home, frame.origin_mm);
            let (a, b) = (dot(arm, x), dot(arm, y));
            (a, b, a.hypot(b))
        });
        Self {
            origin: frame.origin_mm,
            x,
            y,
            flat: x == [1.0, 0.0, 0.0] && y == [0.0, 1.0, 0.0],
            homes: homes.collect(),
            q: &problem.inputs.q[0],
            measured: [&session.samples.x_mm, &session.samples.y_mm],
            measured_z: session.samples.z_mm.as_deref(),
            target: problem.inputs.target.as_deref(),
        }
    }

    /// Fills a block with the samples from `start` on. Samples that cannot be used are among them.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    pub(super) fn fill(&self, start: usize, block: &mut PlaneBlock) {
        let len = (self.q.len() - start).min(LANES);
        block.len = len;
        block.q[..len].copy_from_slice(&self.q[start..start + len]);
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        sin_cos_all(&block.q, &mut sin, &mut cos);
        let x = &self.measured[0][start..start + len];
        let y = &self.measured[1][start..start + len];
        if self.flat {
            for (lane, (x, y)) in x.iter().zip(y).enumerate() {
                block.dx[lane] = self.origin[0] - x;
                block.dy[lane] = self.origin[1] - y;
            }
        } else {
            for (lane, (x, y)) in x.iter().zip(y).enumerate() {
                let z = self.measured_z.map_or(self.origin[2], |z| z[start + lane]);
                let arm = minus([*x, *y, z], self.origin);
                block.dx[lane] = -dot(arm, self.x);
                block.dy[lane] = -dot(arm, self.y);
            }
        }
        if let Some(target) = self.target {
            for lane in 0..len {
                block.target[lane] = target[start + lane] as usize;
                let (a, b, _) = self.homes[block.target[lane]];
                block.dx[lane] += a * cos[lane] - b * sin[lane];
                block.dy[lane] += a * sin[lane] + b * cos[lane];
            }
        } else {
            let (a, b, _) = self.homes[0];
            for lane in 0..LANES {
                block.dx[lane] += a * cos[lane] - b * sin[lane];
                block.dy[lane] += a * sin[lane] + b * cos[lane];
            }
        }
    }

    /// Calls `see` with (sample, ΔPx, ΔPy, l1) for every sample that `counts` picks.
    pub(super) fn each_sample(&self, counts: &[bool], mut see: impl FnMut(usize, f64, f64, f64)) {
        let mut block = PlaneBlock::default();
        for start in (0..self.q.len()).step_by(LANES) {
            self.fill(start, &mut block);
            for lane in (0..block.len).filter(|lane| counts[start + lane]) {
                let l1 = self.homes[block.target[lane]].2;
                see(start + lane, block.dx[lane], block.dy[lane], l1);
            }
        }
    }

    /// A deviation in the plane as a vector in the measuring frame: −ΔP.
    pub(super) fn deviation(&self, dx: f64, dy: f64) -> [f64; 3] {
        add_scaled(self.x.map(|v| -v * dx), self.y, -dy)
    }
}
