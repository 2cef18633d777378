//! The corrected robot as a chain, for every format that describes one.
//!
//! [`Corrected`] says which chain the model is, as far as it is one. The zero offsets of its joints
//! go into the geometry of the file or into the controller, never into both: with `taken` what the
//! controller takes of each joint,
//!
//! ```text
//! file(q + taken) = corrected(q)
//! ```
//!
//! A format writes `file`; what it wrote is read back and counted again as the controller drives
//! it. Where the format can say everything, that has to lead where the model leads; what it cannot
//! say is stated in mm.

use super::corrected::{Corrected, differences};
use super::options::Zeros;
use super::poses::poses;
use super::{ExportError, Job};
use crate::compensation::{Compensation, Side};
use crate::effects::{Stage, Term};
use crate::fit::expected::uncertainties_mm;
use crate::fit::unseen::nothing_held;
use crate::kinematics::quaternion::log;
use crate::kinematics::{JointKind, Pose, Robot, RobotSource};
use crate::lanes::dot;
use crate::model::Model;
use crate::text::length;

/// A file that is read back leads to the same place up to this, mm.
const SAME_MM: f64 = 1e-9;
/// Where axes or targets are kilometres away the last digits are lost: this share of the way.
const ROUNDING: f64 = 1e-13;

pub(super) struct Chain {
    pub(super) corrected: Corrected,
    /// How far each joint stands beyond its command at home, rad or mm.
    pub(super) offsets: Vec<f64>,
    /// What of that the controller takes.
    pub(super) taken: Vec<f64>,
    pub(super) zeros: Zeros,
    /// What the file describes.
    pub(super) robot: Robot,
    /// The frame behind each joint at home in it, base frame.
    pub(super) frames: Vec<Pose>,
    /// The axis of each joint in that frame.
    pub(super) axes: Vec<nalgebra::Vector3<f64>>,
}

impl Chain {
    /// The chain of a model.
    ///
    /// # Errors
    /// A model that a chain cannot be made of.
    pub(super) fn new(job: &Job, zeros: Zeros) -> Result<Self, ExportError> {
        Self::taking(job, zeros, |offsets| {
            Ok(match zeros {
                Zeros::Origins => vec![0.0; offsets.len()],
                Zeros::Controller => offsets.to_vec(),
            })
        })
    }

    /// The chain of a model of which the controller takes what `take` says of the zero offsets.
    ///
    /// # Errors
    /// A model that a chain cannot be made of, and what `take` refuses.
    pub(super) fn taking(
        job: &Job,
        zeros: Zeros,
        take: impl FnOnce(&[f64]) -> Result<Vec<f64>, ExportError>,
    ) -> Result<Self, ExportError> {
        let calibration = job.calibration;
        calibration.may_correct()?;
        if !calibration.regions.is_empty() {
            return Err(ExportError::Refused(text!(
                "a correction by regions is not a geometry; identify the full model for a description of the robot"
            )));
        }
        surer_than_nominal(job)?;
        let corrected = Corrected::new(job);
        let offsets = zero_offsets(job, &corrected);
        let taken = take(&offsets)?;
        let nominal = &calibration.model.robot;
        let back: Vec<f64> = taken.iter().map(|value| -value).collect();
        let motions = corrected.robot.motions_from_home(&back);
        let mut robot = corrected.robot.rehomed(&back);
        for (joint, nominal) in robot.joints.iter_mut().zip(&nominal.joints) {
            // The controller counts its limits in its own values.
            joint.limits = nominal.limits;
        }
        let nominal_frames = nominal.link_frames();
        let axis = |(k, frame): (usize, &Pose)| {
            let direction = nominal.joints[k].axis.direction.into_inner();
            frame.rotation.inverse() * direction
        };
        let axes = nominal_frames.iter().enumerate().map(axis).collect();
        let at = |(k, frame): (usize, &Pose)| motions[k + 1] * corrected.moved[k] * frame;
        let frames: Vec<Pose> = nominal_frames.iter().enumerate().map(at).collect();
        robot.source = RobotSource::Links(frames.clone());
        Ok(Self {
            corrected,
            offsets,
            taken,
            zeros,
            robot,
            frames,
            axes,
        })
    }

    /// The robot that a written chain is, driven by the commands that the controller is sent.
    pub(super) fn driven(&self, written: &Robot) -> Robot {
        written.rehomed(&self.taken)
    }

    /// How far a written chain leads from what this one is, mm, at worst of the measured range.
    pub(super) fn farthest(&self, job: &Job, written: &Robot) -> f64 {
        let all = Compensation::new(job.calibration).robot;
        let known = Model::new(all.robot, self.corrected.carried.clone());
        let off = differences_over_range(job, &known, &self.driven(written));
        let lengths = off.iter().map(|v| dot(*v, *v).sqrt());
        // NaN is the farthest.
        lengths.fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) })
    }

    /// Refuses a written chain that leads elsewhere: a bug.
    pub(super) fn check(&self, job: &Job, written: &Robot) -> Result<(), ExportError> {
        let off = self.farthest(job, written);
        let homes = Compensation::new(job.calibration).reflectors_at_home;
        let far = homes.iter().map(|home| dot(*home, *home).sqrt());
        let far_mm = far.fold(written.reach_mm(), f64::max);
        if off <= SAME_MM.max(ROUNDING * far_mm) {
            return Ok(());
        }
        Err(ExportError::ReadBack(format!(
            "it leads {off} mm elsewhere"
        )))
    }
}

/// Refuses a model that over the measured range may be off by more than the nominal robot was where it was measured: no
/// target is corrected by it either.
fn surer_than_nominal(job: &Job) -> Result<(), ExportError> {
    let calibration = job.calibration;
    let inputs = poses(job, Side::Forward);
    let covariance = calibration.covariance.as_ref();
    let model = nothing_held(&calibration.model);
    let unsure = covariance.and_then(|c| uncertainties_mm(&model, &inputs, c));
    let square: f64 = unsure.iter().flatten().map(|mm| mm * mm).sum();
    let unsure_mm = (square / inputs.len().max(1) as f64).sqrt();
    match calibration.history.first() {
        Some(nominal) if unsure_mm > nominal.gap_mm => Err(ExportError::Refused(text!(
            "the measured poses show too little of the robot: over their ranges the model may be off by {unsure}, and the nominal robot was off by {nominal} where it was measured; measure more of it",
            unsure = length(unsure_mm, 3),
            nominal = length(nominal.gap_mm, 3)
        ))),
        _ => Ok(()),
    }
}

/// What the terms of each joint's own angle turn or slide it by, at home.
fn zero_offsets(job: &Job, corrected: &Corrected) -> Vec<f64> {
    let nominal = &job.calibration.model.robot;
    let of_joint = |joint: usize| -> Vec<Term> {
        let own = |t: &&Term| t.joint == joint && t.effect.about().stage == Stage::Joint;
        corrected.carried.iter().filter(own).cloned().collect()
    };
    let offset = |joint: usize| {
        let terms = of_joint(joint);
        if terms.is_empty() {
            return 0.0;
        }
        let model = Model::new(nominal.clone(), terms);
        let Some(motion) = Corrected::motion(&model) else {
            return 0.0;
        };
        let axis = &nominal.joints[joint].axis.direction;
        match nominal.joints[joint].kind {
            JointKind::Revolute => log(&motion.rotation).dot(axis),
            JointKind::Prismatic => motion.translation.vector.dot(axis),
        }
    };
    (0..nominal.joints.len()).map(offset).collect()
}

/// Model − chain over the measured range, from both sides.
pub(super) fn differences_over_range(job: &Job, model: &Model, robot: &Robot) -> Vec<[f64; 3]> {
    let sides = [Side::Forward, Side::Reverse];
    let both = sides.map(|side| differences(&poses(job, side), model, robot));
    both.concat()
}

/// Root mean square of lengths.
pub(super) fn rms(vectors: &[[f64; 3]]) -> f64 {
    let sum: f64 = vectors.iter().map(|v| dot(*v, *v)).sum();
    (sum / vectors.len().max(1) as f64).sqrt()
}
