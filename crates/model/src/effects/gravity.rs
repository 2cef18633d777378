//! The gravity load of a joint and of the base, in the poses of a block: the load, which hangs at the tool's origin,
//! and the links whose masses are given, where the commands put them.
//!
//! From the tool to the base mass m and first moment S = Σ m x are accumulated: a revolute joint (R, o) makes R (S − m
//! o) + m o of it, a prismatic one S + m q n.

use super::block::Block;
use crate::kinematics::{Joint, JointKind};
use crate::lanes::{
    LANES, Lanes, Lanes3, add_scaled, add_scaled_lanes, cross, in_all_lanes, turn_lanes, turned,
};
use crate::sincos::{sin_cos_lanes, sin_cos_small as sin_cos};
use crate::units::MM_PER_M;

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

    /// The first moment of what a joint supports, the joint itself at zero.
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

/// Derivative of a first moment Σ m x of all that joint `first` supports with respect to the command of a joint behind
/// it, kg·mm per rad or mm; with `itself` the joint `first` has moved as well.
fn slope(block: &Block, first: usize, other: usize, lane: usize, itself: bool) -> [f64; 3] {
    let joints = &block.robot.joints;
    let along: [f64; 3] = joints[other].axis.direction.into_inner().into();
    let carried = Carried::by(block, other, lane).moved(&joints[other], block.command(other, lane));
    let moment = match joints[other].kind {
        JointKind::Revolute => {
            let origin: [f64; 3] = joints[other].axis.point_mm.coords.into();
            cross(along, add_scaled(carried.moment, origin, -carried.mass_kg))
        }
        JointKind::Prismatic => along.map(|v| v * carried.mass_kg),
    };
    // Without a mass a moment is only turned.
    let mut slope = Carried {
        mass_kg: 0.0,
        moment,
    };
    let last = if itself { first } else { first + 1 };
    for k in (last..other).rev() {
        slope = slope.moved(&joints[k], block.command(k, lane));
    }
    slope.moment
}

/// Derivative of [`first_moment`] by the command of a joint behind, kg·m per rad or mm.
pub(super) fn first_moment_slope(
    block: &Block,
    joint: usize,
    other: usize,
    lane: usize,
) -> [f64; 3] {
    slope(block, joint, other, lane, false).map(|v| v / MM_PER_M)
}

/// Derivative of [`overturning_nm`] by the command of a joint, N·m per rad or mm.
pub(super) fn overturning_slope(block: &Block, other: usize, lane: usize) -> [f64; 3] {
    let Some(gravity) = block.robot.gravity_m_s2 else {
        return [0.0; 3];
    };
    let slope = slope(block, 0, other, lane, true);
    cross(slope.map(|v| v / MM_PER_M), gravity.into())
}

/// Derivative of [`seen_by`] by the command of a joint before, m/s² per rad or mm.
pub(super) fn seen_by_slope(block: &Block, joint: usize, other: usize, lane: usize) -> [f64; 3] {
    let joints = &block.robot.joints;
    if joints[other].kind == JointKind::Prismatic {
        return [0.0; 3];
    }
    let mut slope = seen_by(block, other + 1, lane);
    slope = cross(slope, joints[other].axis.direction.into_inner().into());
    for (k, before) in joints.iter().enumerate().take(joint).skip(other + 1) {
        if before.kind == JointKind::Revolute {
            let (sin, cos) = sin_cos(block.command(k, lane));
            slope = turned(slope, before.axis.direction.into_inner().into(), -sin, cos);
        }
    }
    slope
}

/// First moment Σ m (x − c) about a point of a joint's axis of all that the joint supports, the joint itself at zero,
/// kg·m.
pub(super) fn first_moment(block: &Block, joint: usize, lane: usize) -> [f64; 3] {
    let carried = Carried::by(block, joint, lane);
    let origin = block.robot.joints[joint].axis.point_mm.coords.into();
    let arm = add_scaled(carried.moment, origin, -carried.mass_kg);
    arm.map(|v| v / MM_PER_M)
}

/// [`first_moment`] of every lane, with the same bits; a part of wide loops.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
pub(super) fn first_moments(block: &Block, joint: usize) -> Lanes3 {
    let robot = block.robot;
    let (mut mass, mut moment) = ([0.0; LANES], in_all_lanes([0.0; 3]));
    let add = |mass: &mut Lanes, moment: &mut Lanes3, of: &Lanes, at: [f64; 3]| {
        for (mass, of) in mass.iter_mut().zip(of) {
            *mass += of;
        }
        add_scaled_lanes(moment, at, |i| of[i]);
    };
    let tool = robot.base_from_tool.translation.vector.into();
    add(&mut mass, &mut moment, block.loads_kg(), tool);
    for (k, behind) in robot.joints.iter().enumerate().skip(joint).rev() {
        if let Some(link) = behind.link {
            let own = [link.mass_kg; LANES];
            add(&mut mass, &mut moment, &own, link.centre_mm.coords.into());
        }
        if k == joint {
            continue;
        }
        let along = behind.axis.direction.into_inner().into();
        let commands = block.commands(k);
        match behind.kind {
            JointKind::Revolute => {
                let origin: [f64; 3] = behind.axis.point_mm.coords.into();
                let (sin, cos) = sin_cos_lanes(commands);
                add_scaled_lanes(&mut moment, origin, |i| -mass[i]);
                turn_lanes(&mut moment, along, &sin, &cos);
                add_scaled_lanes(&mut moment, origin, |i| mass[i]);
            }
            JointKind::Prismatic => {
                add_scaled_lanes(&mut moment, along, |i| mass[i] * commands[i]);
            }
        }
    }
    let origin = robot.joints[joint].axis.point_mm.coords.into();
    add_scaled_lanes(&mut moment, origin, |i| -mass[i]);
    moment.map(|own| own.map(|v| v / MM_PER_M))
}

/// [`seen_by`] of every lane, with the same bits; a part of wide loops.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
pub(super) fn seen_by_all(block: &Block, joint: usize) -> Lanes3 {
    let robot = block.robot;
    let mut gravity = in_all_lanes(robot.gravity_m_s2.map_or([0.0; 3], Into::into));
    for (k, before) in robot.joints.iter().enumerate().take(joint) {
        if before.kind == JointKind::Revolute {
            let (sin, cos) = sin_cos_lanes(block.commands(k));
            let back = sin.map(|sin| -sin);
            turn_lanes(
                &mut gravity,
                before.axis.direction.into_inner().into(),
                &back,
                &cos,
            );
        }
    }
    gravity
}

/// Moment of all weights about the origin of the base frame, base frame, N·m; zero where gravity
/// is not known.
pub(super) fn overturning_nm(block: &Block, lane: usize) -> [f64; 3] {
    let robot = block.robot;
    let (Some(gravity), Some(first)) = (robot.gravity_m_s2, robot.joints.first()) else {
        return [0.0; 3];
    };
    let carried = Carried::by(block, 0, lane).moved(first, block.command(0, lane));
    cross(carried.moment.map(|v| v / MM_PER_M), gravity.into())
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
