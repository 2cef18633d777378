//! Joint compliance of an arm whose link masses are not stated: `θ = q + C·τ_load(θ) + σ(θ)`.
//!
//! The deflection under the links' own weight is linear in their first moments. Everything behind a joint k turns with
//! it, so that k adds a vector perpendicular to its axis (the component along the axis belongs to the joint before
//! it), turned by the joints between:
//!
//! ```text
//! σ = ω·(R(θ) Σ_k R_{i+1} … R_k (u_k a_k + v_k b_k) × g/|g|),   k = i, i + 1, i + 2
//! ```
//!
//! with `a_k`, `b_k` perpendicular to axis k at home. u and v are compliance times moment times |g|: the angle by
//! which the joint sags where that part is horizontal. Parts farther out than two joints are light and near; they
//! count with the second. C is determined by the load alone, which therefore has to change; where it does not, the sag
//! is what can be fitted ([`SAG`]), and C stays unknown.
//!
//! Source: Khalil & Dombre, ch. 9 (base parameters of gravity); Nubiola & Bonev 2013.

use crate::effects::about::{About, Form, Quantity};
use crate::effects::block::{Block, TurnedLanes};
use crate::effects::gravity::{first_moments, seen_by_all, seen_by_slope};
use crate::effects::inputs::Inputs;
use crate::effects::joint_frame::JointFrame;
use crate::effects::rest::UNIT_SAGS;
use crate::effects::units::Unit;
use crate::effects::{Effect, Figure, Placed};
use crate::kinematics::{JointKind, Robot};
use crate::lanes::{LANES, Lanes3, add_scaled, cross, dot, in_all_lanes, turn_lanes, turned};
use crate::sincos::{sin_cos_lanes, sin_cos_small as sin_cos};
use crate::wide::{Loop, wide};

use crate::effects::torque::{NEWTON_STEPS, Torque, TorqueWave};

use super::about::ABOUT;

/// Joints whose parts count, the joint itself among them.
const PARTS: usize = 3;

/// C from a load that changes, and what the links weigh.
pub(super) static WITH_LOAD: Effect = Effect {
    figures: figures::<{ 1 + UNIT_SAGS }>,
    ..Effect::new(ABOUT_WITH_LOAD, act::<{ 1 + UNIT_SAGS }>)
};
/// What links and an unchanging load weigh together: C is in every moment.
pub(super) static SAG: Effect = Effect {
    figures: figures::<UNIT_SAGS>,
    ..Effect::new(ABOUT_SAG, act::<UNIT_SAGS>)
};

const QUANTITIES: &[Quantity] = &[
    Quantity::new("compliance_urad_per_nm", Unit::MICRORADIAN_PER_NM),
    Quantity::new("moment_1_u_mrad", Unit::MILLIRADIAN),
    Quantity::new("moment_1_v_mrad", Unit::MILLIRADIAN),
    Quantity::new("moment_2_u_mrad", Unit::MILLIRADIAN),
    Quantity::new("moment_2_v_mrad", Unit::MILLIRADIAN),
    Quantity::new("moment_3_u_mrad", Unit::MILLIRADIAN),
    Quantity::new("moment_3_v_mrad", Unit::MILLIRADIAN),
];
const MOMENTS: &[Quantity] = match QUANTITIES.split_first() {
    Some((_, moments)) => moments,
    None => &[],
};

const ABOUT_WITH_LOAD: About = About {
    form: Form::Plain(QUANTITIES),
    equation: "θ = q + C·τ(θ), τ gravity's torque: of the load, and of links by moments that are fitted",
    ..ABOUT
};

const ABOUT_SAG: About = About {
    form: Form::Plain(MOMENTS),
    equation: "θ = q + σ(θ), σ what links and load sag, by moments that are fitted",
    // A moment may point anywhere.
    non_negative: false,
    // Ten times what 100 µrad/(N·m) sag under 50 N·m.
    implausible_above: Some(50.0),
    ..ABOUT
};

fn figures<const N: usize>(me: &Placed, robot: &Robot, inputs: &Inputs) -> Vec<Figure> {
    let sag = ("sag_rms_mrad", Some(1e3 * sag_rms::<N>(me, robot, inputs)));
    if with_load(N) {
        return vec![sag];
    }
    vec![("compliance_urad_per_nm", None), sag]
}

/// With `N` coefficients, C first where there is one more than the parts have.
fn act<const N: usize>(me: &Placed, block: &mut Block) {
    let parts = Parts::of(block.robot, me.joint);
    let mut lanes = TurnedLanes::<N>::zero();
    wide(Sagging {
        me,
        parts: &parts,
        block,
        lanes: &mut lanes,
    });
    block.take_turn(me, &lanes);
    if block.by_command() {
        let sags: [Sag<N>; LANES] = std::array::from_fn(|lane| Sag::of(block, me, &parts, lane));
        let joints = block.robot.joints.len();
        for other in (0..joints).filter(|k| *k != me.joint) {
            let slopes = std::array::from_fn(|lane| {
                let theta = block.value(me.joint, lane);
                let whole = &sags[lane].whole;
                let gain = 1.0 / (1.0 - whole.at(theta).1);
                let compliance = if with_load(N) {
                    me.coefficients[0]
                } else {
                    0.0
                };
                let load = sags[lane]
                    .load
                    .by_other(block, me.joint, other, lane, theta);
                let links = links_by_other::<N>(whole, block, me, other, lane, theta);
                (compliance * load + links) * gain
            });
            block.turn_by_command_of(me, other, &slopes);
        }
    }
}

/// The angles of the joint in all lanes of a block, with the derivatives: those of [`Sag`] lane by lane.
struct Sagging<'s, 'b, const N: usize> {
    me: &'s Placed,
    parts: &'s Parts,
    block: &'s Block<'b>,
    lanes: &'s mut TurnedLanes<N>,
}

impl<const N: usize> Loop for Sagging<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            me,
            parts,
            block,
            lanes,
        } = self;
        let axis: [f64; 3] = block.robot.joints[me.joint]
            .axis
            .direction
            .into_inner()
            .into();
        let gravity = seen_by_all(block, me.joint);
        let vector = |of: &Lanes3, i: usize| [of[0][i], of[1][i], of[2][i]];
        let mut by = [[[0.0; LANES]; 3]; N];
        let first = if with_load(N) {
            by[0] = first_moments(block, me.joint);
            1
        } else {
            0
        };
        parts.carried_in_all(block, &mut by[first..]);
        let mut per_g = [0.0; LANES];
        for i in 0..LANES {
            per_g[i] = 1.0 / length(vector(&gravity, i)).max(f64::MIN_POSITIVE);
        }
        for lanes in by[first..].iter_mut().flatten() {
            for i in 0..LANES {
                lanes[i] *= per_g[i];
            }
        }
        let mut moment = [[0.0; LANES]; 3];
        for (coefficient, part) in me.coefficients.iter().zip(&by) {
            for (moment, part) in moment.iter_mut().zip(part) {
                for (moment, part) in moment.iter_mut().zip(part) {
                    *moment += part * coefficient;
                }
            }
        }
        let starts = block.values(me.joint);
        let mut arms = [[0.0; LANES]; 3];
        let [arm_x, arm_y, arm_z] = &mut arms;
        for i in 0..LANES {
            let (gravity, moment) = (vector(&gravity, i), vector(&moment, i));
            let torque = |moment| dot(axis, cross(moment, gravity));
            let wave = TorqueWave {
                sine: torque(cross(axis, moment)),
                cosine: torque(moment),
            };
            let start = starts[i];
            let mut theta = start;
            for _ in 0..NEWTON_STEPS {
                let (angle, slope) = wave.at(theta);
                theta -= (theta - start - angle) / (1.0 - slope);
            }
            lanes.value[i] = theta;
            lanes.by_input[i] = 1.0 / (1.0 - wave.at(theta).1);
            // What a moment's product with is its torque at this angle.
            let (sin, cos) = sin_cos(theta);
            [arm_x[i], arm_y[i], arm_z[i]] = turned(cross(gravity, axis), axis, -sin, cos);
        }
        for (to, by) in lanes.by_coefficient.iter_mut().zip(&by) {
            for i in 0..LANES {
                to[i] = dot(vector(by, i), vector(&arms, i)) * lanes.by_input[i];
            }
        }
    }
}

/// What winds the joint up in one sample.
struct Sag<const N: usize> {
    /// As an angle, rad.
    whole: Torque,
    /// The load's torque, N·m.
    load: Torque,
    /// Moments by each coefficient: the load's where C is one, and one for each direction of a part. The reference for
    /// all lanes at once.
    #[cfg(test)]
    by: [[f64; 3]; N],
}

/// Whether C is the first of so many coefficients.
const fn with_load(coefficients: usize) -> bool {
    coefficients > UNIT_SAGS
}

impl<const N: usize> Sag<N> {
    fn of(block: &Block, me: &Placed, parts: &Parts, lane: usize) -> Self {
        let load = Torque::of(block, me.joint, lane);
        let per_g = 1.0 / length(load.gravity).max(f64::MIN_POSITIVE);
        let links = parts.carried(block, lane);
        let by: [[f64; 3]; N] = std::array::from_fn(|k| match (with_load(N), k) {
            (true, 0) => load.moment,
            (true, _) => links[k - 1].map(|v| v * per_g),
            (false, _) => links[k].map(|v| v * per_g),
        });
        let mut moment = [0.0; 3];
        for (coefficient, part) in me.coefficients.iter().zip(&by) {
            moment = add_scaled(moment, *part, *coefficient);
        }
        Self {
            whole: Torque { moment, ..load },
            load,
            #[cfg(test)]
            by,
        }
    }
}

/// What sags with a joint, as it is at home.
struct Parts {
    joint: usize,
    /// Directions across the axis of each part's joint; none where there is no such part.
    across: [Option<[[f64; 3]; 2]>; PARTS],
}

impl Parts {
    fn of(robot: &Robot, joint: usize) -> Self {
        let turns = |k: usize| {
            robot
                .joints
                .get(k)
                .is_some_and(|j| j.kind == JointKind::Revolute)
        };
        let across = std::array::from_fn(|part| {
            turns(joint + part).then(|| {
                let frame = JointFrame::new(robot, joint + part);
                [frame.across_1, frame.across_2]
            })
        });
        Self { joint, across }
    }

    /// The directions turned by the joints behind it, with the joint itself at zero, two for each part.
    fn carried(&self, block: &Block, lane: usize) -> [[f64; 3]; UNIT_SAGS] {
        let mut all = [[0.0; 3]; UNIT_SAGS];
        // From the outermost joint inwards each turns what is behind it.
        for part in (0..PARTS).rev() {
            if let Some(own) = self.across[part] {
                all[2 * part] = own[0];
                all[2 * part + 1] = own[1];
                if part > 0 {
                    let k = self.joint + part;
                    let axis = block.robot.joints[k].axis.direction.into_inner().into();
                    let (sin, cos) = sin_cos(block.command(k, lane));
                    for v in &mut all[2 * part..] {
                        *v = turned(*v, axis, sin, cos);
                    }
                }
            }
        }
        all
    }
}

impl Parts {
    /// The same in all lanes, with the same bits; a part of a wide loop.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn carried_in_all(&self, block: &Block, all: &mut [Lanes3]) {
        for part in (0..PARTS).rev() {
            let Some(own) = self.across[part] else {
                continue;
            };
            all[2 * part] = in_all_lanes(own[0]);
            all[2 * part + 1] = in_all_lanes(own[1]);
            if part > 0 {
                let k = self.joint + part;
                let axis = block.robot.joints[k].axis.direction.into_inner().into();
                let (sin, cos) = sin_cos_lanes(block.commands(k));
                for v in &mut all[2 * part..] {
                    turn_lanes(v, axis, &sin, &cos);
                }
            }
        }
    }
}

/// By how much what the links weigh turns the joint in the poses of a session: root mean square about
/// the mean, which is a zero offset, rad.
fn sag_rms<const N: usize>(me: &Placed, robot: &Robot, inputs: &Inputs) -> f64 {
    let compliance = if with_load(N) {
        me.coefficients[0]
    } else {
        0.0
    };
    let mut block = Block::new(robot, 0, false);
    let parts = Parts::of(robot, me.joint);
    let (mut sum, mut squares) = (0.0, 0.0);
    for start in (0..inputs.len()).step_by(LANES) {
        block.load(inputs, start);
        for lane in 0..LANES.min(inputs.len() - start) {
            let sag = Sag::<N>::of(&block, me, &parts, lane);
            let theta = block.command(me.joint, lane);
            let links = sag.whole.at(theta).0 - compliance * sag.load.at(theta).0;
            sum += links;
            squares += links * links;
        }
    }
    let count = inputs.len().max(1) as f64;
    (squares / count - (sum / count).powi(2)).max(0.0).sqrt()
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The direction that belongs to one of the parts' coefficients, turned by the joints behind it, with the joint itself
/// at zero; with `slope` its derivative with respect to the command of that joint. Zero where there is no such part.
fn direction(
    block: &Block,
    joint: usize,
    coefficient: usize,
    lane: usize,
    slope: Option<usize>,
) -> [f64; 3] {
    let robot = block.robot;
    let k = joint + coefficient / 2;
    let turns = |k: usize| robot.joints[k].kind == JointKind::Revolute;
    let moves = slope.is_none_or(|other| other > joint && other <= k && turns(other));
    if k >= robot.joints.len() || !turns(k) || !moves {
        return [0.0; 3];
    }
    let frame = JointFrame::new(robot, k);
    let mut v = if coefficient.is_multiple_of(2) {
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
fn links_by_other<const N: usize>(
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
    let of_parts = me.coefficients.iter().skip(N - UNIT_SAGS);
    for (k, coefficient) in of_parts.enumerate() {
        let v = direction(block, me.joint, k, lane, slope);
        moment = add_scaled(moment, v, coefficient * per_g);
    }
    let gravity = match slope {
        Some(_) => whole.gravity,
        None => seen_by_slope(block, me.joint, other, lane),
    };
    let (sin, cos) = sin_cos(theta);
    dot(
        whole.axis,
        cross(turned(moment, whole.axis, sin, cos), gravity),
    )
}

#[cfg(test)]
mod tests {
    use super::super::tests::some_samples;
    use super::*;
    use crate::effects::JointValues;
    use crate::testing::robot_and_pose;
    use proptest::prelude::*;

    proptest! {
        /// In narrow vectors and in wide ones, and sample by sample.
        #[test]
        fn all_lanes_at_once_have_the_bits_of_each(
            (robot, q) in robot_and_pose(),
            load_kg in 0.0..20.0_f64,
            coefficients in prop::collection::vec(-1e-3..1e-3_f64, 1 + UNIT_SAGS),
        ) {
            are_the_same::<{ 1 + UNIT_SAGS }>(&robot, &q, load_kg, &coefficients)?;
            are_the_same::<UNIT_SAGS>(&robot, &q, load_kg, &coefficients[1..])?;
        }
    }

    fn are_the_same<const N: usize>(
        robot: &Robot,
        q: &[f64],
        load_kg: f64,
        coefficients: &[f64],
    ) -> Result<(), TestCaseError> {
        let session = some_samples(robot.clone(), q, load_kg, 5);
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let mut block = Block::new(robot, 0, false);
        block.load(&inputs, 0);
        for joint in (0..q.len()).filter(|k| robot.joints[*k].kind == JointKind::Revolute) {
            let me = &Placed {
                joint,
                setting: 0.0,
                coefficients: coefficients.to_vec(),
                curve: None,
                rest: None,
                first_column: 0,
                frame: JointFrame::new(robot, joint),
                down: None,
                start_s: 0.0,
            };
            let (parts, block) = (&Parts::of(robot, joint), &block);
            let (mut all, mut narrow) = (TurnedLanes::<N>::zero(), TurnedLanes::<N>::zero());
            let lanes = &mut all;
            wide(Sagging {
                me,
                parts,
                block,
                lanes,
            });
            let lanes = &mut narrow;
            Sagging {
                me,
                parts,
                block,
                lanes,
            }
            .run();
            for lane in 0..5 {
                let sag = Sag::<N>::of(block, me, parts, lane);
                let start = block.value(joint, lane);
                let mut theta = start;
                for _ in 0..NEWTON_STEPS {
                    let (angle, slope) = sag.whole.at(theta);
                    theta -= (theta - start - angle) / (1.0 - slope);
                }
                let gain = 1.0 / (1.0 - sag.whole.at(theta).1);
                let (sin, cos) = sin_cos(theta);
                let axis = sag.whole.axis;
                let arm = turned(cross(sag.whole.gravity, axis), axis, -sin, cos);
                for own in [&all, &narrow] {
                    prop_assert_eq!(own.value[lane], theta);
                    prop_assert_eq!(own.by_input[lane], gain);
                    for (by, own) in sag.by.iter().zip(&own.by_coefficient) {
                        prop_assert_eq!(own[lane], dot(*by, arm) * gain);
                    }
                }
            }
        }
        Ok(())
    }
}
