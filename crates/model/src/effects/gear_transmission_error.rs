//! Gear transmission error: `θ = q + A sin(k q + φ)`, k cycles per turn: a whole number where the
//! error comes round with the joint, a gear's ratio where it does not.
//!
//! The coefficients are A cos φ and A sin φ; the order k is scanned.

use super::about::{About, Form, Quantity, Setting};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "gear-transmission-error",
    title: phrase!("Gear transmission error"),
    form: Form::Harmonic(Quantity::new("amplitude_deg", Unit::DEGREE)),
    setting: Setting::Order { from: 3, to: 360 },
    equation: "θ = q + A sin(order·q + φ)",
    source: "kinematic error of gears and strain-wave reducers, one harmonic",
    cause: phrase!("tooth or wave-generator errors in the reducer; the order tells which wheel"),
    implausible_above: Some(0.33),
    usual_size: phrase!("0.5′ to 2′"),
    confused_with: phrase!(
        "the order M − k where the poses are M equal steps of a turn: unequal steps part them"
    ),
    check: phrase!(
        "compare the order with the reducer's tooth counts, then its preload and lubrication"
    ),
    needs: &[
        Need::REVOLUTE,
        Need::values::<6>(phrase!("six values of the joint")),
    ],
    ..About::PLAIN
};

pub(super) static GEAR_TRANSMISSION_ERROR: Effect = Effect::new(ABOUT, act);

/// Cycles for a turn of the motor that the gears of robots have: the wave generator's turn, which is that of an
/// eccentric shaft, its two lobes, and twice these.
const PER_MOTOR_TURN: [f64; 3] = [1.0, 2.0, 4.0];

/// An order that a stated gear ratio asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedOrder {
    /// Cycles for a turn of the motor.
    pub per_motor_turn: f64,
    /// Turns of the motor for one of the joint.
    pub ratio: f64,
    /// Cycles for a turn of the joint.
    pub order: f64,
}

/// The orders that a joint's stated gear ratio asks for; none where none is stated.
#[doc(hidden)]
pub fn stated_orders(robot: &Robot, joint: usize) -> impl Iterator<Item = StatedOrder> {
    let ratio = robot.joints.get(joint).and_then(|joint| joint.gear_ratio);
    let all = PER_MOTOR_TURN.into_iter();
    all.filter_map(move |per_motor_turn| {
        let ratio = ratio?;
        let order = ratio * per_motor_turn;
        let Setting::Order { from, to } = ABOUT.setting else {
            return None;
        };
        let inside = order >= f64::from(from) && order <= f64::from(to);
        inside.then_some(StatedOrder {
            per_motor_turn,
            ratio,
            order,
        })
    })
}

/// Which of the orders that its joint's gear ratio asks for a term is.
#[doc(hidden)]
pub fn stated(robot: &Robot, term: &Term) -> Option<StatedOrder> {
    let mut all = stated_orders(robot, term.joint);
    let own = all.find(|stated| stated.order == term.setting);
    own.filter(|_| term.effect.about().id == ABOUT.id)
}

fn act(me: &Placed, block: &mut Block) {
    add_sine_of_the_command(me, block, me.setting);
}

/// `θ += A sin(k q + φ)`: A cos φ multiplies sin(k q), A sin φ multiplies cos(k q).
#[inline]
pub(super) fn add_sine_of_the_command(me: &Placed, block: &mut Block, order: f64) {
    let (a, b) = (me.coefficients[0], me.coefficients[1]);
    block.turn(me, |theta, at| {
        let (s, c) = sin_cos(order * at.q);
        Turned {
            value: theta + a * s + b * c,
            by_input: 1.0,
            by_coefficient: [s, c],
        }
    });
    block.turn_by_command(me, me.joint, |at| {
        let (s, c) = sin_cos(order * at.q);
        order * (a * c - b * s)
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{revolute, robot_of, z_axis_at};

    #[test]
    fn a_stated_ratio_asks_for_its_orders_within_those_that_there_are() {
        let mut robot = robot_of(vec![revolute(z_axis_at(0.0)), revolute(z_axis_at(1.0))]);
        assert_eq!(stated_orders(&robot, 0).count(), 0);
        robot.joints[0].gear_ratio = Some(100.0);
        robot.joints[1].gear_ratio = Some(62.6111);
        let orders =
            |joint| -> Vec<f64> { stated_orders(&robot, joint).map(|s| s.order).collect() };
        assert_eq!(orders(0), [100.0, 200.0]);
        assert_eq!(orders(1), [62.6111, 125.2222, 250.4444]);
        let term = Term::absent(&GEAR_TRANSMISSION_ERROR, 1, 125.2222);
        let own = stated(&robot, &term).unwrap();
        assert_eq!((own.per_motor_turn, own.ratio), (2.0, 62.6111));
        let other = Term::absent(&GEAR_TRANSMISSION_ERROR, 0, 125.2222);
        assert_eq!(stated(&robot, &other), None);
    }
}
