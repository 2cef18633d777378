//! Joint compliance of an arm whose link masses are not stated: `θ = q + C·τ_load(θ) + σ(θ)`.
//!
//! What the links' own weight winds the joint up by is linear in their first moments. Everything behind
//! a joint k turns with it, so that k adds a vector across its axis (what lies along the axis the
//! joint before it has), carried by the joints between:
//!
//! ```text
//! σ = ω·(R(θ) Σ_k R_{i+1} … R_k (u_k a_k + v_k b_k) × g/|g|),   k = i, i + 1, i + 2
//! ```
//!
//! with `a_k`, `b_k` across axis k at home. u and v are compliance times moment times |g|: the angle by
//! which the joint sags where that part stands out level. Parts farther out than two joints are light
//! and near; they count with the second. C comes from the load alone, which therefore has to change.
//!
//! Source: Khalil & Dombre, ch. 9 (base parameters of gravity); Nubiola & Bonev 2013.

use crate::effects::about::{About, Form, Quantity};
use crate::effects::block::{Block, Turned};
use crate::effects::term::JointFrame;
use crate::effects::units::Unit;
use crate::effects::{Effect, Placed};
use crate::kinematics::JointKind;
use crate::lanes::{LANES, add_scaled, cross, dot, turned};
use crate::sincos::sin_cos_small as sin_cos;

use super::{NEWTON_STEPS, Torque};

/// See the module.
pub(super) struct UnknownMasses;

/// Joints whose parts count, the joint itself among them.
const PARTS: usize = 3;
/// Coefficients: C, and two for each part.
const SIZE: usize = 1 + 2 * PARTS;

const ABOUT: About = About {
    form: Form::Plain(&[
        Quantity::new("compliance_urad_per_nm", Unit::MICRORADIAN_PER_NM),
        Quantity::new("moment_1_u_mrad", Unit::MILLIRADIAN),
        Quantity::new("moment_1_v_mrad", Unit::MILLIRADIAN),
        Quantity::new("moment_2_u_mrad", Unit::MILLIRADIAN),
        Quantity::new("moment_2_v_mrad", Unit::MILLIRADIAN),
        Quantity::new("moment_3_u_mrad", Unit::MILLIRADIAN),
        Quantity::new("moment_3_v_mrad", Unit::MILLIRADIAN),
    ]),
    equation: "θ = q + C·τ(θ), τ gravity's torque: of the load, and of links by moments that are fitted",
    ..super::ABOUT
};

impl Effect for UnknownMasses {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let sags: [Sag; LANES] = std::array::from_fn(|lane| Sag::of(block, me, lane));
        block.turn(me, |start, at| {
            let sag = &sags[at.lane];
            let mut theta = start;
            for _ in 0..NEWTON_STEPS {
                let (angle, slope) = sag.whole.at(theta);
                theta -= (theta - start - angle) / (1.0 - slope);
            }
            let gain = 1.0 / (1.0 - sag.whole.at(theta).1);
            let by = |part: &Torque| part.at(theta).0 * gain;
            Turned::<SIZE> {
                value: theta,
                by_input: gain,
                by_coefficient: std::array::from_fn(|k| by(&sag.by[k])),
            }
        });
        if block.by_command() {
            let joints = block.robot.joints.len();
            for other in (0..joints).filter(|k| *k != me.joint) {
                let slopes = std::array::from_fn(|lane| {
                    let theta = block.value(me.joint, lane);
                    let whole = &sags[lane].whole;
                    let gain = 1.0 / (1.0 - whole.at(theta).1);
                    let load = sags[lane].by[0].by_other(block, me.joint, other, lane, theta);
                    let links = links_by_other(whole, block, me, other, lane, theta);
                    (me.coefficients[0] * load + links) * gain
                });
                block.turn_by_command_of(me, other, &slopes);
            }
        }
    }
}

/// What winds the joint up in one sample.
struct Sag {
    /// As an angle, rad.
    whole: Torque,
    /// By each coefficient: the load's torque, N·m, and one for each direction of a part.
    by: [Torque; SIZE],
}

impl Sag {
    fn of(block: &Block, me: &Placed, lane: usize) -> Self {
        let load = Torque::of(block, me.joint, lane);
        let per_g = 1.0 / length(load.gravity).max(f64::MIN_POSITIVE);
        let part = |k: usize| Torque {
            moment: match k {
                0 => load.moment,
                _ => direction(block, me.joint, k, lane, None).map(|v| v * per_g),
            },
            ..load
        };
        let by: [Torque; SIZE] = std::array::from_fn(part);
        let mut moment = [0.0; 3];
        for (coefficient, part) in me.coefficients.iter().zip(&by) {
            moment = add_scaled(moment, part.moment, *coefficient);
        }
        Self {
            whole: Torque { moment, ..load },
            by,
        }
    }
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The direction that belongs to a coefficient, as the joint carries it with the joint itself at zero;
/// with `slope` its derivative by the command of that joint. Zero where there is no such part.
fn direction(
    block: &Block,
    joint: usize,
    coefficient: usize,
    lane: usize,
    slope: Option<usize>,
) -> [f64; 3] {
    let robot = block.robot;
    let k = joint + (coefficient - 1) / 2;
    let turns = |k: usize| robot.joints[k].kind == JointKind::Revolute;
    let moves = slope.is_none_or(|other| other > joint && other <= k && turns(other));
    if k >= robot.joints.len() || !turns(k) || !moves {
        return [0.0; 3];
    }
    let frame = JointFrame::new(robot, k);
    let mut v = if coefficient % 2 == 1 {
        frame.across_1
    } else {
        frame.across_2
    };
    for between in (joint + 1..=k).rev().filter(|m| turns(*m)) {
        let axis = robot.joints[between].axis.direction.into_inner().into();
        let (sin, cos) = sin_cos(block.command(between, lane));
        v = turned(v, axis, sin, cos);
        if slope == Some(between) {
            v = cross(axis, v);
        }
    }
    v
}

/// The derivative of what the links sag by another joint's command.
fn links_by_other(
    whole: &Torque,
    block: &Block,
    me: &Placed,
    other: usize,
    lane: usize,
    theta: f64,
) -> f64 {
    let per_g = 1.0 / length(whole.gravity).max(f64::MIN_POSITIVE);
    let slope = (other > me.joint).then_some(other);
    let mut moment = [0.0; 3];
    for (k, coefficient) in me.coefficients.iter().enumerate().skip(1) {
        let v = direction(block, me.joint, k, lane, slope);
        moment = add_scaled(moment, v, coefficient * per_g);
    }
    let gravity = match slope {
        Some(_) => whole.gravity,
        None => super::seen_by_slope(block, me.joint, other, lane),
    };
    let (sin, cos) = sin_cos(theta);
    dot(
        whole.axis,
        cross(turned(moment, whole.axis, sin, cos), gravity),
    )
}
