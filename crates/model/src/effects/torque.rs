//! Gravity's torque about a joint, as a function of the joint's angle.
//!
//! The torque about an axis (direction ω, point c) of a weight m g at x is ω·((x − c) × m g). As the joint turns
//! everything behind it rigidly, torque and slope at θ are those of the first moment Σ m (x − c), turned by θ.

use super::block::Block;
use super::gravity::{first_moment, first_moment_slope, seen_by, seen_by_slope};
use crate::kinematics::JointKind;
use crate::lanes::{cross, dot, turned};
use crate::sincos::sin_cos_small as sin_cos;

/// The torque about a turning joint at its command, N·m; about a sliding one none.
pub(super) fn torque_nm(block: &Block, joint: usize, lane: usize) -> f64 {
    if block.robot.joints[joint].kind == JointKind::Prismatic {
        return 0.0;
    }
    let torque = Torque::of(block, joint, lane);
    torque.at(block.command(joint, lane)).0
}

/// How often Newton's method may correct; it squares the error each time, and the wind-up is a
/// small part of a radian.
pub(super) const NEWTON_STEPS: usize = 4;

/// Gravity's torque about a joint as a function of that joint's angle.
#[derive(Clone, Copy)]
pub(super) struct Torque {
    /// First moment Σ m (x − c) of what hangs behind the joint, the joint itself at zero, kg·m.
    pub(super) moment: [f64; 3],
    /// Direction of the joint's axis.
    pub(super) axis: [f64; 3],
    /// Gravity as the joint sees it, turned back by the joints before it, m/s².
    pub(super) gravity: [f64; 3],
}

impl Torque {
    /// The torque about a joint for one sample of a block.
    pub(super) fn of(block: &Block, joint: usize, lane: usize) -> Self {
        let axis = &block.robot.joints[joint].axis;
        Self {
            moment: first_moment(block, joint, lane),
            axis: axis.direction.into_inner().into(),
            gravity: seen_by(block, joint, lane),
        }
    }

    /// The torque as a wave of the joint's angle: what of the moment is along the axis has no part in it.
    pub(super) fn wave(&self) -> TorqueWave {
        let of = |moment| dot(self.axis, cross(moment, self.gravity));
        TorqueWave {
            sine: of(cross(self.axis, self.moment)),
            cosine: of(self.moment),
        }
    }

    /// Torque in N·m and its slope in N·m/rad.
    pub(super) fn at(&self, theta: f64) -> (f64, f64) {
        self.wave().at(theta)
    }

    /// The derivative of the torque by the command of another joint, N·m/rad or N·m/mm: a joint
    /// behind moves what hangs on it, one before turns gravity as this joint sees it.
    pub(super) fn by_other(
        &self,
        block: &Block,
        joint: usize,
        other: usize,
        lane: usize,
        theta: f64,
    ) -> f64 {
        let (sin, cos) = sin_cos(theta);
        let (moment, gravity) = if other > joint {
            let slope = first_moment_slope(block, joint, other, lane);
            (slope, self.gravity)
        } else {
            (self.moment, seen_by_slope(block, joint, other, lane))
        };
        dot(
            self.axis,
            cross(turned(moment, self.axis, sin, cos), gravity),
        )
    }
}

/// A torque over the angle of its joint, N·m.
#[derive(Clone, Copy)]
pub(super) struct TorqueWave {
    pub(super) sine: f64,
    pub(super) cosine: f64,
}

impl TorqueWave {
    /// Torque and its slope in N·m/rad.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of wide loops")]
    pub(super) fn at(self, theta: f64) -> (f64, f64) {
        let (sin, cos) = sin_cos(theta);
        let tau = self.sine * sin + self.cosine * cos;
        (tau, self.sine * cos - self.cosine * sin)
    }
}
