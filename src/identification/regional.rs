//! The paper's identification: constant corrections of angle and radius, region by region.
//!
//! ```text
//! ΔP = P_nominal − P_actual = M Δρ,   M = [[0, 1], [l1, 0]],   Δρ = (Δθ, Δl1)        (5), (6)
//! Δρ_i = (Nᵀ N)⁻¹ Nᵀ ΔQ_i,   N the rows M of the region's samples                    (7)
//! ```
//!
//! so Δl1 is the mean of ΔPx and Δθ that of ΔPy over l1. x is the radial direction at home, y a
//! quarter turn further; l1 is the reflector's distance from the axis.
//!
//! (5) drops the rotation between the lamp's frame and the base frame, so that one constant error
//! looks different in every region. The method is kept because reports compare against it;
//! [`identify_exact`](super::identify_exact) is the one to use.

use crate::effects::JointValues;
use crate::effects::inputs::reflectors_at_home;
use crate::effects::term::JointFrame;
use crate::kinematics::JointKind;
use crate::lanes::{LANES, Lanes, add_scaled, dot, minus};
use crate::model::{Model, RegionalCorrection};
use crate::sessions::{Region, Session};
use crate::sincos::sin_cos_lanes;
use crate::wide::{Loop, wide};

use super::IdentifyError;
use super::exact::{left_out, outliers};
use super::gap::{Deviations, Spread};
use super::outcome::{Gap, Identification, Quality, RegionResult};
use super::problem::Problem;
use super::regions::{Assignment, RegionChoice};
use super::robust::suspects;
use super::uncertainty::half_width_factor;

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
    let plane = Plane::new(problem.session);
    let assignment = Assignment::new(regions);
    // A slot for each region and target, so that l1 is the same throughout a slot; after the
    // regions one for samples in none, and one for samples that do not count.
    let slots = regions.len() + 2;
    let mut copies = vec![[[0.0; 4]; COPIES]; slots * plane.homes.len()];
    wide(Summing {
        plane: &plane,
        problem,
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

/// Neighbouring lanes add to different copies of a sum, so that one addition need not wait for
/// the one before it.
const COPIES: usize = 4;

/// The loop of [`sum_by_region`].
struct Summing<'a> {
    plane: &'a Plane,
    problem: &'a Problem<'a>,
    assignment: &'a Assignment<'a>,
    slots: usize,
    copies: &'a mut [[[f64; 4]; COPIES]],
}

impl Loop for Summing<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let mut places = [0; LANES];
        let uncounted = self.slots - 1;
        self.plane.each_block(self.problem, |start, len, block| {
            self.assignment.regions_of(&block.q, &mut places);
            let used = &self.problem.used[start..start + len];
            for (lane, used) in used.iter().enumerate() {
                let place = if *used { places[lane] } else { uncounted };
                let (dx, dy) = (block.dx[lane], block.dy[lane]);
                let slot = place + self.slots * block.target[lane];
                let sums = &mut self.copies[slot][lane % COPIES];
                let add = [1.0, dx, dy, dx * dx + dy * dy];
                for (sum, value) in sums.iter_mut().zip(add) {
                    *sum += value;
                }
            }
        });
    }
}

/// The plane in which a single axis moves a reflector.
struct Plane {
    origin: [f64; 3],
    x: [f64; 3],
    y: [f64; 3],
    /// In-plane coordinates of every reflector at home, and its distance from the axis.
    homes: Vec<(f64, f64, f64)>,
}

/// A block of samples in the plane: the angle, ΔP = nominal − measured, and l1.
struct PlaneBlock {
    q: Lanes,
    dx: Lanes,
    dy: Lanes,
    target: [usize; LANES],
}

impl Default for PlaneBlock {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            q: zero,
            dx: zero,
            dy: zero,
            target: [0; LANES],
        }
    }
}

impl Plane {
    fn new(session: &Session) -> Self {
        let frame = JointFrame::new(&session.robot, 0);
        // A tool on the axis has no radius; any direction across the axis will do.
        let (x, y) = if frame.radius_mm > 0.0 {
            (frame.radial, frame.tangential)
        } else {
            (frame.across_1, frame.across_2)
        };
        let homes = reflectors_at_home(session).into_iter().map(|home| {
            let arm = minus(home, frame.origin_mm);
            let (a, b) = (dot(arm, x), dot(arm, y));
            (a, b, a.hypot(b))
        });
        Self {
            origin: frame.origin_mm,
            x,
            y,
            homes: homes.collect(),
        }
    }

    /// Calls `see` with (first sample, number of samples, ΔP) for every block. Samples that cannot
    /// be used are among them.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn each_block(&self, problem: &Problem, mut see: impl FnMut(usize, usize, &PlaneBlock)) {
        let samples = &problem.session.samples;
        let q = &problem.inputs.q[0];
        let target = problem.inputs.target.as_deref();
        let flat = self.x == [1.0, 0.0, 0.0] && self.y == [0.0, 1.0, 0.0];
        let mut block = PlaneBlock::default();
        let (a0, b0, _) = self.homes[0];
        let (mut a, mut b) = ([a0; LANES], [b0; LANES]);
        for start in (0..q.len()).step_by(LANES) {
            let len = (q.len() - start).min(LANES);
            block.q[..len].copy_from_slice(&q[start..start + len]);
            let (sin, cos) = sin_cos_lanes(&block.q);
            if let Some(target) = target {
                for lane in 0..len {
                    block.target[lane] = target[start + lane] as usize;
                    (a[lane], b[lane], _) = self.homes[block.target[lane]];
                }
            }
            let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
            x[..len].copy_from_slice(&samples.x_mm[start..start + len]);
            y[..len].copy_from_slice(&samples.y_mm[start..start + len]);
            if flat {
                for lane in 0..LANES {
                    x[lane] -= self.origin[0];
                    y[lane] -= self.origin[1];
                }
            } else {
                for lane in 0..len {
                    let z = samples
                        .z_mm
                        .as_ref()
                        .map_or(self.origin[2], |z| z[start + lane]);
                    let arm = minus([x[lane], y[lane], z], self.origin);
                    (x[lane], y[lane]) = (dot(arm, self.x), dot(arm, self.y));
                }
            }
            for lane in 0..LANES {
                block.dx[lane] = a[lane] * cos[lane] - b[lane] * sin[lane] - x[lane];
                block.dy[lane] = a[lane] * sin[lane] + b[lane] * cos[lane] - y[lane];
            }
            see(start, len, &block);
        }
    }

    /// Calls `see` with (sample, ΔPx, ΔPy, l1) for every usable sample.
    fn each_sample(&self, problem: &Problem, mut see: impl FnMut(usize, f64, f64, f64)) {
        self.each_block(problem, |start, len, block| {
            for lane in (0..len).filter(|lane| problem.usable[start + lane]) {
                let l1 = self.homes[block.target[lane]].2;
                see(start + lane, block.dx[lane], block.dy[lane], l1);
            }
        });
    }

    /// A deviation in the plane as a vector in the measuring frame: −ΔP.
    fn deviation(&self, dx: f64, dy: f64) -> [f64; 3] {
        add_scaled(self.x.map(|v| -v * dx), self.y, -dy)
    }
}

/// The paper's identification of a session with a single revolute joint.
///
/// # Errors
/// Another robot, regions that make no sense, or no sample to fit.
pub fn identify_regional(
    session: &Session,
    choice: &RegionChoice,
    values: JointValues,
) -> Result<Identification, IdentifyError> {
    single_revolute_joint(session)?;
    let regions = choice.resolve(session)?;
    let mut problem = Problem::new(session, values);
    problem.axis_weights = [1.0, 1.0, 0.0];
    if problem.samples() == 0 {
        return Err(IdentifyError::NothingToFit);
    }
    let (sums, outside) = sum_by_region(&problem, &regions);
    let corrections: Vec<(f64, f64)> = sums.iter().map(RegionSums::correction).collect();

    let assignment = Assignment::new(&regions);
    let plane = Plane::new(session);
    let blank = || Deviations {
        axes_mm: std::array::from_fn(|_| vec![f64::NAN; session.samples.len()]),
        length_mm: vec![f64::NAN; session.samples.len()],
    };
    let (mut before, mut after) = (blank(), blank());
    plane.each_sample(&problem, |i, dx, dy, l1| {
        if let Some(region) = assignment.region_of(problem.inputs.q[0][i]) {
            // (8): the corrected position is q + M Δρ.
            let (theta, l1_mm) = corrections[region];
            put(&mut before, i, plane.deviation(dx, dy));
            put(&mut after, i, plane.deviation(dx - l1_mm, dy - l1 * theta));
        }
    });
    let suspected = suspects(&problem, &after);
    let results = regions
        .iter()
        .zip(&sums)
        .enumerate()
        .filter(|(_, (_, s))| s.samples > 0);
    let results = results.map(|(k, (region, sums))| {
        let inside =
            |i: usize| problem.fit[i] && assignment.region_of(problem.inputs.q[0][i]) == Some(k);
        region_result(region, sums, &before, &after, &inside, &suspected)
    });
    let results: Vec<RegionResult> = results.collect();
    let gap_over = |counts: &dyn Fn(usize) -> bool| {
        let outlier = |i: usize| suspected[i];
        Some(Gap {
            before: Spread::of(&before.length_mm, counts, outlier)?,
            after: Spread::of(&after.length_mm, counts, outlier)?,
            samples: (0..suspected.len())
                .filter(|i| counts(*i) && !after.length_mm[*i].is_nan())
                .count(),
        })
    };
    let gap = gap_over(&|i| problem.fit[i]).ok_or(IdentifyError::NothingToFit)?;
    let held_out = session.samples.held_out.as_deref();
    Ok(Identification {
        session: session.name.clone(),
        method: "regional",
        samples: session.samples.len(),
        model: Model::nominal(session.robot.clone()),
        covariance: None,
        parameters: Vec::new(),
        not_identifiable: Vec::new(),
        gap,
        held_out: held_out.and_then(|h| gap_over(&|i| problem.usable[i] && h[i])),
        outliers: outliers(&after, &suspected),
        left_out: left_out(session),
        noise_mm: None,
        quality: Quality {
            stopped: "solved directly",
            converged: true,
            passes: 1,
            coefficients: 2 * results.len(),
            rank: 2 * results.len(),
            condition: 1.0,
        },
        notes: notes(session, &regions, &sums, outside),
        regions: results,
    })
}

fn single_revolute_joint(session: &Session) -> Result<(), IdentifyError> {
    let refuse = |why: String| Err(IdentifyError::NotASingleRevoluteJoint(why));
    let joints = &session.robot.joints;
    if joints.len() != 1 {
        return refuse(format!("this robot has {} joints", joints.len()));
    }
    if joints[0].kind != JointKind::Revolute {
        return refuse("this robot's joint slides".to_owned());
    }
    let along = joints[0].axis.direction.into_inner();
    if session.samples.z_mm.is_none() && along.z.abs() < 1.0 - 1e-6 {
        return refuse("z was not measured, and the joint does not turn about z".to_owned());
    }
    Ok(())
}

fn put(deviations: &mut Deviations, sample: usize, e: [f64; 3]) {
    for (column, value) in deviations.axes_mm.iter_mut().zip(e) {
        column[sample] = value;
    }
    deviations.length_mm[sample] = dot(e, e).sqrt();
}

fn region_result(
    region: &Region,
    sums: &RegionSums,
    before: &Deviations,
    after: &Deviations,
    inside: &dyn Fn(usize) -> bool,
    suspected: &[bool],
) -> RegionResult {
    let (theta_rad, l1_mm) = sums.correction();
    let n = sums.samples as f64;
    let left = sums.square - n * l1_mm * l1_mm - sums.l1_l1 * theta_rad * theta_rad;
    let freedom = (2 * sums.samples).saturating_sub(2);
    let half = |scale: f64| {
        (freedom > 0).then(|| {
            let variance = left.max(0.0) / freedom as f64 / scale;
            half_width_factor(freedom) * variance.sqrt()
        })
    };
    let interval = |value: f64, half: Option<f64>| half.map(|h| [value - h, value + h]);
    let outlier = |i: usize| suspected[i];
    let rms = |d: &Deviations| Spread::of(&d.length_mm, inside, outlier).map_or(0.0, |s| s.rms_mm);
    RegionResult {
        correction: RegionalCorrection {
            name: region.name.clone(),
            from_rad: region.from_rad,
            to_rad: region.to_rad,
            samples: sums.samples,
            theta_rad,
            l1_mm,
        },
        theta_ci95: if sums.l1_l1 > 0.0 {
            interval(theta_rad, half(sums.l1_l1))
        } else {
            None
        },
        l1_ci95: interval(l1_mm, half(n)),
        rms_before_mm: rms(before),
        rms_after_mm: rms(after),
    }
}

fn notes(
    session: &Session,
    regions: &[Region],
    sums: &[RegionSums],
    outside: usize,
) -> Vec<String> {
    let mut notes = Vec::new();
    if session.samples.z_mm.is_some() {
        notes.push(
            "z is not used: the method works in the plane in which the axis moves the tool"
                .to_owned(),
        );
    }
    notes.push(
        "corrections are constant in the base frame within a region: one constant error of the \
         joint looks different in every region, and a part of it stays; the exact method has \
         neither limit"
            .to_owned(),
    );
    let empty: Vec<&str> = regions
        .iter()
        .zip(sums)
        .filter(|(_, s)| s.samples == 0)
        .map(|(r, _)| r.name.as_str())
        .collect();
    if !empty.is_empty() {
        notes.push(format!(
            "no sample in region {}: no correction there",
            empty.join(", ")
        ));
    }
    if outside > 0 {
        notes.push(format!(
            "{outside} samples lie in no region and were not used"
        ));
    }
    notes
}
