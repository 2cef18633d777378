//! Joint compliance: `θ = q + C·τ(θ)`, τ gravity's torque about the joint at its true angle.
//!
//! Where the joint's torque was measured it is that torque, at the angle where the joint stands, and
//! nothing of the load and the masses is needed: C is then a plain factor. Else
//! the torque is that of the load, which hangs at the tool's origin, and of the links whose
//! masses are given. With the joint turned by θ the lever turns, so the equation is implicit;
//! Newton's method solves it. The other joints stand at their commands: what their own errors
//! change in the torque is of second order.
//!
//! The torque about an axis (direction ω, point c) of a weight m g at x is ω·((x − c) × m g). As
//! the joint turns everything behind it rigidly, torque and slope at θ are those of the first
//! moment Σ m (x − c), turned by θ.

use super::about::{About, Form, Over, Quantity};
use super::block::{Block, Turned};
use super::gravity::{first_moment, first_moment_slope, seen_by, seen_by_slope};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Survey};
use crate::kinematics::JointKind;
use crate::lanes::{LANES, cross, dot, turned};
use crate::sincos::sin_cos_small as sin_cos;

mod unknown_masses;

const ABOUT: About = About {
    id: "joint-compliance",
    title: phrase!("Joint compliance"),
    form: Form::Plain(&[Quantity::new(
        "compliance_urad_per_nm",
        Unit::MICRORADIAN_PER_NM,
    )]),
    equation: "θ = q + C·τ(θ), τ the measured torque, else gravity's about the joint",
    source: "a joint as a torsion spring; Khalil & Dombre, Modeling, Identification and Control of Robots, ch. 9",
    cause: phrase!("reducer, bearing and shaft wind up under the weight that hangs on the joint"),
    over: Over::Load,
    never_negative: true,
    implausible_above: Some(1000.0),
    usual_size: phrase!("1 to 100 µrad/(N·m)"),
    confused_with: phrase!("encoder eccentricity under a single load: a second load parts them"),
    check: phrase!(
        "the payload entered in the controller; stiffness of the reducer in its data sheet"
    ),
    needs: &[Need::REVOLUTE, TORQUE],
    of_other_joints: true,
    ..About::PLAIN
};

/// A torque about the joint: measured, or gravity's on what is known to hang there.
const TORQUE: Need = Need {
    what: phrase!(
        "a measured torque of the joint, or gravity across its axis with a load or link masses"
    ),
    unmet: |survey, joint| {
        let own = &survey.joints[joint];
        // Of several joints the sag can be fitted whatever weighs on them.
        let several = survey.joints.len() > 1;
        let weightless = !several && survey.largest_load_kg <= 0.0 && !survey.link_masses;
        let reason = match own.torque_range_nm {
            Some(range) if range > 0.0 => return None,
            Some(_) => text!("the measured torque never changed"),
            None if !survey.gravity => text!("the direction of gravity is not given"),
            None if !own.gravity_lever => {
                text!("gravity is along the axis and has no torque about it")
            }
            None if weightless => text!("neither a load nor a link mass is given"),
            None => return None,
        };
        Some(reason)
    },
    idle: |offered| {
        let weight = offered.load || offered.link_masses;
        match (offered.gravity, weight) {
            (true, true) => None,
            (true, false) => Some("the scenario has no load, and no link a mass"),
            (false, _) => Some("the robot has no gravity"),
        }
    },
};

pub(super) static JOINT_COMPLIANCE: Effect = Effect {
    // The form with fewer parameters first: a model's file tells the form by its parameters.
    other_forms: &[&unknown_masses::SAG, &unknown_masses::WITH_LOAD],
    takes_form,
    ..Effect::new(ABOUT, act)
};

fn takes_form(survey: &Survey, joint: usize) -> Option<&'static Effect> {
    let measured = survey.joints[joint].torque_range_nm.is_some();
    if survey.joints.len() == 1 || survey.link_masses || measured {
        return None;
    }
    let told_by_load = survey.loads >= 2 && survey.largest_load_kg > 0.0;
    Some(if told_by_load {
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
const NEWTON_STEPS: usize = 4;

/// Gravity's torque about a joint as a function of that joint's angle.
#[derive(Clone, Copy)]
struct Torque {
    /// First moment Σ m (x − c) of what hangs behind the joint, the joint itself at zero, kg·m.
    moment: [f64; 3],
    /// Direction of the joint's axis.
    axis: [f64; 3],
    /// Gravity as the joint sees it, turned back by the joints before it, m/s².
    gravity: [f64; 3],
}

impl Torque {
    /// The torque about a joint for one sample of a block.
    fn of(block: &Block, joint: usize, lane: usize) -> Self {
        let axis = &block.robot.joints[joint].axis;
        Self {
            moment: first_moment(block, joint, lane),
            axis: axis.direction.into_inner().into(),
            gravity: seen_by(block, joint, lane),
        }
    }

    /// The torque as a wave of the joint's angle: what of the moment is along the axis has no part in it.
    fn wave(&self) -> Wave {
        let of = |moment| dot(self.axis, cross(moment, self.gravity));
        Wave {
            sine: of(cross(self.axis, self.moment)),
            cosine: of(self.moment),
        }
    }

    /// Torque in N·m and its slope in N·m/rad.
    fn at(&self, theta: f64) -> (f64, f64) {
        self.wave().at(theta)
    }

    /// What a moment's product with is its torque at an angle, where gravity is that of this one.
    fn arm(&self, theta: f64) -> [f64; 3] {
        let (sin, cos) = sin_cos(theta);
        turned(cross(self.gravity, self.axis), self.axis, -sin, cos)
    }

    /// The derivative of the torque by the command of another joint, N·m/rad or N·m/mm: a joint
    /// behind moves what hangs on it, one before turns gravity as this joint sees it.
    fn by_other(&self, block: &Block, joint: usize, other: usize, lane: usize, theta: f64) -> f64 {
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
struct Wave {
    sine: f64,
    cosine: f64,
}

impl Wave {
    /// Torque and its slope in N·m/rad.
    fn at(self, theta: f64) -> (f64, f64) {
        let (sin, cos) = sin_cos(theta);
        let tau = self.sine * sin + self.cosine * cos;
        (tau, self.sine * cos - self.cosine * sin)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::effects::{Inputs, JointValues};
    use crate::kinematics::JointKind;
    use crate::kinematics::testing::{beside, robot_and_pose};
    use crate::sessions::{Instrument, Samples, Session, Target};
    use proptest::prelude::*;

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
                    robot.gravity_torque_nm(&beside(&q, joint, by), load_kg, joint).unwrap()
                });
                let expected = 0.5 * (behind - before);
                prop_assert!((slope - expected).abs() < 1e-9 * (1.0 + slope.abs()));
            }
        }
    }
}
