//! What weighs on a joint and on the base, in the poses of a block: the load, which hangs at the
//! tool's origin, and the links whose masses are given, where the commands put them.
//!
//! From the tool to the base mass m and first moment S = Σ m x are carried along: a turning joint
//! (R, o) makes R (S − m o) + m o of it, a sliding one S + m q n.

use super::block::Block;
use crate::kinematics::{Joint, JointKind};
use crate::lanes::{add_scaled, cross, turned};
use crate::sincos::sin_cos_small as sin_cos;

/// One metre in a millimetre.
const MM: f64 = 1e-3;

/// A mass and its first moment.
#[derive(Debug, Clone, Copy, Default)]
struct Carried {
    mass_kg: f64,
    /// Σ m x, base frame, kg·mm.
    moment: [f64; 3],
}

impl Carried {
    fn add(&mut self, mass_kg: f64, at_mm: [f64; 3]) {
        self.mass_kg += mass_kg;
        self.moment = add_scaled(self.moment, at_mm, mass_kg);
    }

    /// Moved by a joint.
    fn moved(self, joint: &Joint, value: f64) -> Self {
        let along = joint.axis.direction.into_inner().into();
        let moment = match joint.kind {
            JointKind::Revolute => {
                let origin: [f64; 3] = joint.axis.point_mm.coords.into();
                let (sin, cos) = sin_cos(value);
                let arm = add_scaled(self.moment, origin, -self.mass_kg);
                add_scaled(turned(arm, along, sin, cos), origin, self.mass_kg)
            }
            JointKind::Prismatic => add_scaled(self.moment, along, self.mass_kg * value),
        };
        Self { moment, ..self }
    }

    /// What a joint carries, the joint itself at zero.
    fn by(block: &Block, joint: usize, lane: usize) -> Self {
        let robot = block.robot;
        let mut carried = Self::default();
        let tool = robot.base_from_tool.translation.vector.into();
        carried.add(block.load_kg(lane), tool);
        for (k, behind) in robot.joints.iter().enumerate().skip(joint).rev() {
            if let Some(link) = behind.link {
                carried.add(link.mass_kg, link.centre_mm.coords.into());
            }
            if k > joint {
                carried = carried.moved(behind, block.command(k, lane));
            }
        }
        carried
    }
}

/// First moment Σ m (x − c) about a point of a joint's axis of all that the joint carries, the joint
/// itself at zero, kg·m.
pub(super) fn first_moment(block: &Block, joint: usize, lane: usize) -> [f64; 3] {
    let carried = Carried::by(block, joint, lane);
    let origin = block.robot.joints[joint].axis.point_mm.coords.into();
    let arm = add_scaled(carried.moment, origin, -carried.mass_kg);
    arm.map(|v| v * MM)
}

/// Moment of all weights about the origin of the base frame, base frame, N·m; zero where gravity
/// is not known.
pub(super) fn overturning_nm(block: &Block, lane: usize) -> [f64; 3] {
    let robot = block.robot;
    let (Some(gravity), Some(first)) = (robot.gravity_m_s2, robot.joints.first()) else {
        return [0.0; 3];
    };
    let carried = Carried::by(block, 0, lane).moved(first, block.command(0, lane));
    cross(carried.moment.map(|v| v * MM), gravity.into())
}

/// Gravity as a joint sees it, turned back by the joints before it, m/s²; zero where it is not known.
pub(super) fn seen_by(block: &Block, joint: usize, lane: usize) -> [f64; 3] {
    let robot = block.robot;
    let gravity = robot.gravity_m_s2.map_or([0.0; 3], Into::into);
    (0..joint).fold(gravity, |g, k| {
        let before = &robot.joints[k];
        match before.kind {
            JointKind::Revolute => {
                let (sin, cos) = sin_cos(block.command(k, lane));
                turned(g, before.axis.direction.into_inner().into(), -sin, cos)
            }
            JointKind::Prismatic => g,
        }
    })
}
