//! What may have gone wrong in setting up, as changes of the session.

use nalgebra::Isometry3;

use crate::effects::{JointValues, Term, joint_zero};
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::model::rigid_motion::best_rigid_motion;
use crate::sessions::Mend;
use crate::sessions::Session;
use crate::units::{deg_from_rad, rad_from_deg};

/// A hypothesis: what is wrong, what to do, and how the data would read without it.
pub(super) struct Hypothesis {
    pub(super) what: String,
    pub(super) proposal: String,
    pub(super) mend: Mend,
}

/// A joint whose sign is wrong: what, what to do, and the change.
pub(super) fn other_way_round(joint: usize) -> (String, String, Mend) {
    let (number, factor) = (joint + 1, -1.0);
    (
        format!("joint {number} counts the other way round"),
        format!("reverse the sign of joint {number} in the robot's description or in the samples"),
        Mend::ScaleJoint { joint, factor },
    )
}

#[allow(
    clippy::too_many_lines,
    reason = "a list of hypotheses reads best in one piece"
)]
pub(super) fn hypotheses(session: &Session) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    let mut push = |what: String, proposal: String, mend: Mend| {
        all.push(Hypothesis {
            what,
            proposal,
            mend,
        });
    };
    for joint in 0..session.robot.joints.len() {
        let number = joint + 1;
        let (what, proposal, mend) = other_way_round(joint);
        push(what, proposal, mend);
        if session.robot.joints[joint].kind != JointKind::Revolute {
            continue;
        }
        for (factor, what) in [
            (rad_from_deg(1.0), "are in degrees but were read as radians"),
            (deg_from_rad(1.0), "are in radians but were read as degrees"),
        ] {
            push(
                format!("the values of joint {number} {what}"),
                format!("correct the unit in the heading of q{number}"),
                Mend::ScaleJoint { joint, factor },
            );
        }
        for turn in [90.0, -90.0, 180.0] {
            push(
                format!("the home position of joint {number} is off by {turn}°"),
                format!("add {turn}° to joint {number} at home, or home the joint again"),
                Mend::TurnHome {
                    joint,
                    by_rad: rad_from_deg(turn),
                },
            );
        }
    }
    let units = [
        (1000.0, "in metres but were read as millimetres"),
        (0.001, "in micrometres or were multiplied by 1000"),
        (25.4, "in inches but were read as millimetres"),
        (1.0 / 25.4, "in millimetres but were read as inches"),
    ];
    for (factor, what) in units {
        push(
            format!("the measured coordinates are {what}"),
            "correct the unit in the headings of x, y and z".to_owned(),
            Mend::ScaleLengths(factor),
        );
    }
    if session.samples.z_mm.is_some() {
        for (order, what) in [
            ([1, 0, 2], "x and y"),
            ([0, 2, 1], "y and z"),
            ([2, 1, 0], "x and z"),
            ([1, 2, 0], "x, y and z (read as y, z, x)"),
            ([2, 0, 1], "x, y and z (read as z, x, y)"),
        ] {
            push(
                format!("the measured axes {what} are swapped"),
                "exchange the headings of the measured columns".to_owned(),
                Mend::Reorder(order),
            );
        }
    } else {
        push(
            "the measured axes x and y are swapped".to_owned(),
            "exchange the headings of the measured columns".to_owned(),
            Mend::Reorder([1, 0, 2]),
        );
    }
    if let Some(frame) = misaligned_frame(session) {
        let t = frame.translation.vector;
        let turn = deg_from_rad(frame.rotation.angle());
        push(
            "the measuring frame was never aligned with the robot's base".to_owned(),
            format!(
                "align the instrument (turned by {turn:.2}°, moved by {:.2}, {:.2}, {:.2} mm), or give the samples a `setup` column so that the frame is fitted",
                t.x, t.y, t.z
            ),
            Mend::FreeFrame,
        );
    }
    all
}

/// The rigid motion between the robot and the measurement, where the frame is not fitted anyway
/// and the motion is too large for an effect.
fn misaligned_frame(session: &Session) -> Option<Isometry3<f64>> {
    if session.samples.setups.is_some() {
        return None;
    }
    let problem = Problem::new(session, JointValues::Commanded);
    let terms = (0..session.robot.joints.len()).map(|j| Term::absent(joint_zero(), j, 0.0));
    let start = Model::new(session.robot.clone(), terms.collect());
    let fitted = solve(&problem, &start).model;
    let predicted = fitted.predict(&problem.inputs);
    let motion = best_rigid_motion(session, &predicted, |i| problem.usable[i])?;
    let turned = motion.rotation.angle() > rad_from_deg(LEAST_TURN_DEG);
    let moved = motion.translation.vector.norm() > LEAST_MOVE_MM;
    (turned || moved).then_some(motion)
}

/// Ten times what is usual for a tilt or an offset of the base.
pub(super) const LEAST_TURN_DEG: f64 = 1.5;
pub(super) const LEAST_MOVE_MM: f64 = 60.0;
