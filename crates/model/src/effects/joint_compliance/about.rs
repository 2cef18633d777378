//! The description of joint compliance, whatever is known of the masses.

use crate::effects::about::{About, Form, Over, Quantity};
use crate::effects::needs::Need;
use crate::effects::units::Unit;

pub(super) const ABOUT: About = About {
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
    non_negative: true,
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
            (true, false) => Some(phrase!("the scenario has no load, and no link a mass")),
            (false, _) => Some(phrase!("the robot has no gravity")),
        }
    },
};
