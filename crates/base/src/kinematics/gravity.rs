//! Gravity's torque about a joint, of the load and of the links.
//!
//! ```text
//! τ_j = −∂U/∂q_j = Σ m_k g · ∂c_k/∂q_j,   U = −Σ m_k g · c_k(q)
//! ∂c_k/∂q_j = n_j × (c_k − a_j)  (revolute)   or   n_j  (prismatic)
//! ```
//!
//! over the masses behind the joint: the link of joint k is carried by joints 1…k, the load, which
//! hangs at the tool's origin, by all. A positive torque turns (or pushes) the joint positive. Masses
//! in kg, g in m/s², and lengths come from mm: a revolute joint has N·m, a prismatic one N.
//!
//! Source: Lynch & Park, *Modern Robotics*, 2017, section 8.1.

use nalgebra::{Point3, Vector3};

use crate::units::MM_PER_M;

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::Robot;

/// A mass where it is at the pose in question.
struct PosedMass {
    /// m g, N.
    weight_n: Vector3<f64>,
    /// In the base frame, mm.
    at_mm: Point3<f64>,
    /// The last joint that moves it, from 0.
    carried_by: usize,
}

impl Robot {
    /// Gravity's torque about joint `joint` (from 0) at `q`, of a load at the tool's origin and of
    /// the known links from that joint on: N·m, or N for a prismatic joint. `None` where gravity is
    /// not known, or there is no such joint.
    pub fn gravity_torque_nm(&self, q: &[f64], load_kg: f64, joint: usize) -> Option<f64> {
        let masses = self.masses(q, load_kg)?;
        let twist = *self.joint_twists(q).get(joint)?;
        let power: f64 = masses
            .iter()
            .filter(|mass| mass.carried_by >= joint)
            .map(|mass| mass.weight_n.dot(&twist.velocity_at(&mass.at_mm)))
            .sum();
        Some(power * self.torque_unit(joint))
    }

    fn torque_unit(&self, joint: usize) -> f64 {
        match self.joints[joint].kind {
            JointKind::Revolute => 1.0 / MM_PER_M,
            JointKind::Prismatic => 1.0,
        }
    }

    fn masses(&self, q: &[f64], load_kg: f64) -> Option<Vec<PosedMass>> {
        let gravity = self.gravity_m_s2?;
        let motions = self.motions_from_home(q);
        let mass = |mass_kg: f64, motion: &Pose, at_home: &Point3<f64>, carried_by| PosedMass {
            weight_n: gravity * mass_kg,
            at_mm: motion * at_home,
            carried_by,
        };
        let links = self.joints.iter().enumerate().filter_map(|(index, joint)| {
            let link = joint.link?;
            let motion = &motions[index + 1];
            Some(mass(link.mass_kg, motion, &link.centre_mm, index))
        });
        let last = self.joints.len().checked_sub(1)?;
        let tool = Point3::from(self.base_from_tool.translation.vector);
        let load = mass(load_kg, &motions[last + 1], &tool, last);
        Some(links.chain(std::iter::once(load)).collect())
    }
}

/// The potential energy of load and links, N·mm, which the tests differentiate.
#[cfg(test)]
fn potential_n_mm(robot: &Robot, q: &[f64], load_kg: f64) -> f64 {
    let masses = robot.masses(q, load_kg).unwrap();
    let energy = |mass: &PosedMass| -mass.weight_n.dot(&mass.at_mm.coords);
    masses.iter().map(energy).sum()
}

#[cfg(test)]
mod tests {
    use super::super::testing::{robot_and_pose, with_joint_moved};
    use super::super::{Axis, Joint, LinkMass};
    use super::*;
    use proptest::prelude::*;

    const STEP: f64 = 1e-5;

    proptest! {
        #[test]
        fn the_torque_is_minus_the_slope_of_the_potential_energy(
            (robot, q) in robot_and_pose(), load in 0.0..20.0_f64,
        ) {
            for joint in 0..q.len() {
                let energy = |by| potential_n_mm(&robot, &with_joint_moved(&q, joint, by), load);
                let slope = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
                let torque = robot.gravity_torque_nm(&q, load, joint).unwrap();
                // N·mm per rad is a thousandth of a N·m; N·mm per mm is N.
                let expected = -slope * robot.torque_unit(joint);
                prop_assert!((torque - expected).abs() < 1e-4 * (1.0 + expected.abs()));
            }
        }
    }

    #[test]
    fn a_level_arm_of_one_metre_with_ten_kilograms_has_minus_ninety_eight_newton_metres() {
        // About −y, a positive angle lifts the arm; gravity pulls it down, so the torque is negative.
        let axis = Axis::through(-Vector3::y(), Point3::origin()).unwrap();
        let mut robot = Robot {
            name: "arm".to_owned(),
            joints: vec![Joint::new("shoulder", JointKind::Revolute, axis)],
            base_from_tool: Pose::translation(1000.0, 0.0, 0.0),
            gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
            source: crate::kinematics::RobotSource::Axes,
        };
        let torque = |robot: &Robot, q: f64| robot.gravity_torque_nm(&[q], 10.0, 0);
        assert!((torque(&robot, 0.0).unwrap() + 98.1).abs() < 1e-12);
        let upright = std::f64::consts::FRAC_PI_2;
        assert!(torque(&robot, upright).unwrap().abs() < 1e-12);
        robot.joints[0].link = Some(LinkMass {
            mass_kg: 4.0,
            centre_mm: Point3::new(500.0, 0.0, 0.0),
        });
        assert!((torque(&robot, 0.0).unwrap() + 98.1 + 19.62).abs() < 1e-12);
        robot.gravity_m_s2 = None;
        assert_eq!(torque(&robot, 0.0), None);
    }

    #[test]
    fn a_lift_carries_the_weight_in_newtons_and_links_before_it_do_not_count() {
        let vertical = Axis::through(Vector3::z(), Point3::origin()).unwrap();
        let level = Axis::through(Vector3::x(), Point3::origin()).unwrap();
        let mut before = Joint::new("slide", JointKind::Prismatic, level);
        before.link = Some(LinkMass {
            mass_kg: 50.0,
            centre_mm: Point3::origin(),
        });
        let robot = Robot {
            name: "gantry".to_owned(),
            joints: vec![before, Joint::new("lift", JointKind::Prismatic, vertical)],
            base_from_tool: Pose::identity(),
            gravity_m_s2: Some(Vector3::new(0.0, 0.0, -10.0)),
            source: crate::kinematics::RobotSource::Axes,
        };
        let force = robot.gravity_torque_nm(&[0.0, 100.0], 3.0, 1).unwrap();
        assert!((force + 30.0).abs() < 1e-12);
        assert_eq!(robot.gravity_torque_nm(&[0.0, 100.0], 3.0, 0), Some(0.0));
    }
}
