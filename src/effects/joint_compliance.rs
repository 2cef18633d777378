//! Joint compliance: `θ = q + C·τ(θ)`, τ gravity's torque about the joint at its true angle.
//!
//! The torque is that of the load, which hangs at the tool's origin, and of the links whose
//! masses are given. With the joint turned by θ the lever turns, so the equation is implicit;
//! Newton's method solves it. The other joints stand at their commands: what their own errors
//! change in the torque is of second order.
//!
//! The torque about an axis (direction ω, point c) of a weight m g at x is ω·((x − c) × m g). As
//! the joint turns everything behind it rigidly, torque and slope at θ are those of the first
//! moment Σ m (x − c), turned by θ.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};
use crate::kinematics::{Joint, JointKind, Robot};
use crate::lanes::{LANES, add_scaled, cross, dot, minus, turned};
use crate::sincos::sin_cos_small as sin_cos;

/// See the module.
pub(super) struct JointCompliance;

const ABOUT: About = About {
    id: "joint-compliance",
    title: "Joint compliance",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "compliance_urad_per_nm",
        inner: 1e-6,
    }]),
    setting: Setting::None,
    equation: "θ = q + C·τ(θ), τ gravity's torque about the joint",
    source: "a joint as a torsion spring; Khalil & Dombre, Modeling, Identification and Control of Robots, ch. 9",
    cause: "reducer, bearing and shaft wind up under the weight that hangs on the joint",
    over: Over::Load,
    never_negative: true,
    implausible_above: Some(1000.0),
    usual_size: "1 to 100 µrad/(N·m)",
    confused_with: "encoder eccentricity under a single load: a second load parts them",
    check: "the payload entered in the controller; stiffness of the reducer in its data sheet",
};

impl Effect for JointCompliance {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        if let Some(reason) = survey.not_revolute(joint) {
            return Some(reason);
        }
        if !survey.gravity {
            return Some("the direction of gravity is not given".to_owned());
        }
        if !survey.joints[joint].gravity_lever {
            return Some("gravity is along the axis and has no torque about it".to_owned());
        }
        let weightless = survey.largest_load_kg <= 0.0 && !survey.link_masses;
        weightless.then(|| "neither a load nor a link mass is given".to_owned())
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let compliance = me.coefficients[0];
        let torques: [Torque; LANES] = std::array::from_fn(|i| Torque::of(block, me.joint, i));
        block.turn_by_index(me, |start, i| {
            let torque = &torques[i];
            let mut theta = start;
            for _ in 0..NEWTON_STEPS {
                let (tau, slope) = torque.at(theta);
                theta -= (theta - start - compliance * tau) / (1.0 - compliance * slope);
            }
            let (tau, slope) = torque.at(theta);
            let gain = 1.0 / (1.0 - compliance * slope);
            Turned {
                to: theta,
                carry: gain,
                by: [tau * gain],
            }
        });
        if block.by_command() {
            let joints = block.robot.joints.len();
            for other in (0..joints).filter(|k| *k != me.joint) {
                let slopes = std::array::from_fn(|i| {
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
}

/// How often Newton's method may correct; it squares the error each time, and the wind-up is a
/// small part of a radian.
const NEWTON_STEPS: usize = 4;

/// Gravity's torque about a joint as a function of that joint's angle.
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
        let robot = block.robot;
        let joints = &robot.joints;
        let axis = &joints[joint].axis;
        let origin = axis.point_mm.coords.into();
        let mut moment = [0.0; 3];
        for (mass_kg, at_mm, behind) in weights(robot, block.load_kg(lane)) {
            if behind <= joint {
                continue;
            }
            let at_mm = (joint + 1..behind)
                .rev()
                .fold(at_mm, |x, k| moved(&joints[k], x, block.command(k, lane)));
            moment = add_scaled(moment, minus(at_mm, origin), mass_kg * MM);
        }
        let gravity = robot.gravity_m_s2.map_or([0.0; 3], Into::into);
        let gravity = (0..joint).fold(gravity, |g, k| {
            let (sin, cos) = sin_cos(block.command(k, lane));
            match joints[k].kind {
                JointKind::Revolute => turned(g, direction(&joints[k]), -sin, cos),
                JointKind::Prismatic => g,
            }
        });
        Self {
            moment,
            axis: axis.direction.into_inner().into(),
            gravity,
        }
    }

    /// Torque in N·m and its slope in N·m/rad.
    fn at(&self, theta: f64) -> (f64, f64) {
        let (sin, cos) = sin_cos(theta);
        let moment = turned(self.moment, self.axis, sin, cos);
        let tau = dot(self.axis, cross(moment, self.gravity));
        let slope = dot(self.axis, cross(cross(self.axis, moment), self.gravity));
        (tau, slope)
    }

    /// The derivative of the torque by the command of another joint, N·m/rad or N·m/mm: a joint
    /// behind moves what hangs on it, one before turns gravity as this joint sees it.
    fn by_other(&self, block: &Block, joint: usize, other: usize, lane: usize, theta: f64) -> f64 {
        let joints = &block.robot.joints;
        let (sin, cos) = sin_cos(theta);
        if other > joint {
            let moment = moment_by(block, joint, other, lane);
            let moment = turned(moment, self.axis, sin, cos);
            return dot(self.axis, cross(moment, self.gravity));
        }
        if joints[other].kind == JointKind::Prismatic {
            return 0.0;
        }
        let before = block.robot.gravity_m_s2.map_or([0.0; 3], Into::into);
        let slope = (0..joint).fold(before, |g, k| {
            let (sin, cos) = sin_cos(block.command(k, lane));
            let turned = match joints[k].kind {
                JointKind::Revolute => turned(g, direction(&joints[k]), -sin, cos),
                JointKind::Prismatic => g,
            };
            if k == other {
                cross(turned, direction(&joints[k]))
            } else {
                turned
            }
        });
        let moment = turned(self.moment, self.axis, sin, cos);
        dot(self.axis, cross(moment, slope))
    }
}

/// The derivative of the first moment about a joint by the command of one behind it, kg·m/rad or
/// kg·m/mm.
fn moment_by(block: &Block, joint: usize, other: usize, lane: usize) -> [f64; 3] {
    let robot = block.robot;
    let joints = &robot.joints;
    let mut moment = [0.0; 3];
    for (mass_kg, at_mm, behind) in weights(robot, block.load_kg(lane)) {
        if behind <= other {
            continue;
        }
        let start = (other..behind)
            .rev()
            .fold(at_mm, |x, k| moved(&joints[k], x, block.command(k, lane)));
        let axis = direction(&joints[other]);
        let slope = match joints[other].kind {
            JointKind::Revolute => {
                let origin = joints[other].axis.point_mm.coords.into();
                cross(axis, minus(start, origin))
            }
            JointKind::Prismatic => axis,
        };
        // A direction is only turned by the joints between.
        let slope = (joint + 1..other).rev().fold(slope, |v, k| {
            let (sin, cos) = sin_cos(block.command(k, lane));
            match joints[k].kind {
                JointKind::Revolute => turned(v, direction(&joints[k]), sin, cos),
                JointKind::Prismatic => v,
            }
        });
        moment = add_scaled(moment, slope, mass_kg * MM);
    }
    moment
}

/// One metre in a millimetre.
const MM: f64 = 1e-3;

/// The weights that hang on a robot: mass, kg; place at home, mm; behind how many joints. The load
/// comes last.
fn weights(robot: &Robot, load_kg: f64) -> impl Iterator<Item = (f64, [f64; 3], usize)> + '_ {
    let links = robot.joints.iter().enumerate().filter_map(|(k, joint)| {
        let link = joint.link?;
        Some((link.mass_kg, link.centre_mm.coords.into(), k + 1))
    });
    let tool = robot.base_from_tool.translation.vector.into();
    links.chain([(load_kg, tool, robot.joints.len())])
}

fn direction(joint: &Joint) -> [f64; 3] {
    joint.axis.direction.into_inner().into()
}

fn moved(joint: &Joint, x: [f64; 3], value: f64) -> [f64; 3] {
    match joint.kind {
        JointKind::Revolute => {
            let origin = joint.axis.point_mm.coords.into();
            let (sin, cos) = sin_cos(value);
            add_scaled(
                turned(minus(x, origin), direction(joint), sin, cos),
                origin,
                1.0,
            )
        }
        JointKind::Prismatic => add_scaled(x, direction(joint), value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Inputs, JointValues};
    use crate::kinematics::testing::robot_and_pose;
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
                let gradient = robot.gravity_torque_gradient(&q, load_kg, joint).unwrap();
                prop_assert!((slope - gradient[joint]).abs() < 1e-9 * (1.0 + slope.abs()));
            }
        }
    }
}
