//! Joint compliance: `θ = q + C·τ(θ)`, τ gravity's torque about the joint at its true angle.
//!
//! Where the joint's torque was measured it is that torque, at the angle of the joint, and nothing of the load and the
//! masses is needed: C is then a plain factor. Else the torque is that of the load, which hangs at the tool's origin,
//! and of the links whose masses are given. With the joint turned by θ the lever turns, so the equation is implicit;
//! Newton's method solves it. The other joints are at their commands: the effect of their own errors on the torque is
//! of second order.
//!
//! The torque about an axis (direction ω, point c) of a weight m g at x is ω·((x − c) × m g). As
//! the joint turns everything behind it rigidly, torque and slope at θ are those of the first
//! moment Σ m (x − c), turned by θ.

use super::block::{Block, Turned};
use super::torque::{NEWTON_STEPS, Torque};
use super::{Effect, Placed, Survey};
use crate::lanes::LANES;
use about::ABOUT;

mod about;
mod unknown_masses;

pub(super) static JOINT_COMPLIANCE: Effect = Effect {
    // The form with fewer parameters first: a model's file is read by its parameters.
    other_forms: &[&unknown_masses::SAG, &unknown_masses::WITH_LOAD],
    takes_form,
    ..Effect::new(ABOUT, act)
};

fn takes_form(survey: &Survey, joint: usize) -> Option<&'static Effect> {
    let measured = survey.joints[joint].torque_range_nm.is_some();
    if survey.joints.len() == 1 || survey.link_masses || measured {
        return None;
    }
    let determined_by_load = survey.loads >= 2 && survey.largest_load_kg > 0.0;
    Some(if determined_by_load {
        &unknown_masses::WITH_LOAD
    } else {
        &unknown_masses::SAG
    })
}

fn act(me: &Placed, block: &mut Block) {
    let compliance = me.coefficients[0];
    let torques: [Torque; LANES] = std::array::from_fn(|i| Torque::of(block, me.joint, i));
    let measured: [Option<f64>; LANES] = std::array::from_fn(|i| block.torque_nm(me.joint, i));
    block.turn(me, |start, at| {
        if let Some(tau) = measured[at.lane] {
            return Turned {
                value: start + compliance * tau,
                by_input: 1.0,
                by_coefficient: [tau],
            };
        }
        let torque = torques[at.lane].wave();
        let mut theta = start;
        for _ in 0..NEWTON_STEPS {
            let (tau, slope) = torque.at(theta);
            theta -= (theta - start - compliance * tau) / (1.0 - compliance * slope);
        }
        let (tau, slope) = torque.at(theta);
        let gain = 1.0 / (1.0 - compliance * slope);
        Turned {
            value: theta,
            by_input: gain,
            by_coefficient: [tau * gain],
        }
    });
    if block.by_command() {
        let joints = block.robot.joints.len();
        for other in (0..joints).filter(|k| *k != me.joint) {
            let slopes = std::array::from_fn(|i| {
                if measured[i].is_some() {
                    return 0.0;
                }
                let theta = block.value(me.joint, i);
                let torque = &torques[i];
                let gain = 1.0 / (1.0 - compliance * torque.at(theta).1);
                let by_other = torque.by_other(block, me.joint, other, i, theta);
                compliance * by_other * gain
            });
            block.turn_by_command_of(me, other, &slopes);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::effects::gravity::{first_moments, seen_by_all};
    use crate::effects::{Inputs, JointValues};
    use crate::kinematics::JointKind;
    use crate::sessions::{Instrument, Samples, Session, Target};
    use crate::testing::{robot_and_pose, with_joint_moved};
    use proptest::prelude::*;

    /// A session with so many samples from a pose on, each a step from the one before, under growing loads.
    pub(super) fn some_samples(
        robot: crate::kinematics::Robot,
        q: &[f64],
        load_kg: f64,
        count: usize,
    ) -> Session {
        let mut session = session(robot, q, load_kg);
        let steps = || (0..count).map(|k| k as f64);
        let samples = &mut session.samples;
        let moved = q.iter().map(|q| steps().map(|k| q + 0.37 * k).collect());
        samples.q = moved.collect();
        samples.load_kg = Some(steps().map(|k| load_kg + k).collect());
        samples.x_mm = vec![0.0; count];
        samples.y_mm = vec![0.0; count];
        session
    }

    /// A session with one sample.
    fn session(robot: crate::kinematics::Robot, q: &[f64], load_kg: f64) -> Session {
        let joints = q.len();
        Session {
            name: String::new(),
            note: String::new(),
            robot,
            targets: vec![Target {
                name: "tool".to_owned(),
                position_mm: nalgebra::Point3::origin(),
            }],
            instrument: Instrument::default(),
            tolerance_mm: None,
            regions: Vec::new(),
            compensated_by: None,
            samples: Samples {
                q: q.iter().map(|q| vec![*q]).collect(),
                q_read: vec![None; joints],
                x_mm: vec![0.0],
                y_mm: vec![0.0],
                dir: vec![None; joints],
                speed: vec![None; joints],
                load_kg: Some(vec![load_kg]),
                ..Samples::default()
            },
            path: None,
        }
    }

    proptest! {
        #[test]
        fn all_lanes_at_once_have_the_bits_of_each(
            (robot, q) in robot_and_pose(), load_kg in 0.0..20.0_f64
        ) {
            let session = some_samples(robot.clone(), &q, load_kg, 5);
            let inputs = Inputs::new(&session, JointValues::Commanded);
            let mut block = Block::new(&robot, 0, false);
            block.load(&inputs, 0);
            for joint in 0..q.len() {
                let (moments, gravity) = (first_moments(&block, joint), seen_by_all(&block, joint));
                for lane in 0..5 {
                    let own = Torque::of(&block, joint, lane);
                    prop_assert_eq!(moments.map(|of| of[lane]), own.moment);
                    prop_assert_eq!(gravity.map(|of| of[lane]), own.gravity);
                }
            }
        }

        /// The kinematics find the torque by virtual power, from twists; here it is a first
        /// moment that turns with the joint.
        #[test]
        fn the_torque_agrees_with_the_one_of_the_kinematics(
            (robot, q) in robot_and_pose(), load_kg in 0.0..20.0_f64
        ) {
            let session = session(robot.clone(), &q, load_kg);
            let inputs = Inputs::new(&session, JointValues::Commanded);
            let mut block = Block::new(&robot, 0, false);
            block.load(&inputs, 0);
            for (joint, angle) in q.iter().enumerate() {
                if robot.joints[joint].kind == JointKind::Prismatic {
                    continue;
                }
                let (torque, slope) = Torque::of(&block, joint, 0).at(*angle);
                let expected = robot.gravity_torque_nm(&q, load_kg, joint).unwrap();
                let scale = 1.0 + expected.abs();
                prop_assert!((torque - expected).abs() < 1e-9 * scale, "{torque} {expected}");
                // A sinusoid of the joint's own angle: half the difference a quarter turn to each side.
                let [before, behind] = [-FRAC_PI_2, FRAC_PI_2].map(|by| {
                    robot.gravity_torque_nm(&with_joint_moved(&q, joint, by), load_kg, joint).unwrap()
                });
                let expected = 0.5 * (behind - before);
                prop_assert!((slope - expected).abs() < 1e-9 * (1.0 + slope.abs()));
            }
        }
    }
}
