//! What may have gone wrong in setting up, as changes of the session.

use crate::text::Text;
use nalgebra::Isometry3;

use crate::effects::{JointValues, Term, joint_zero};
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::model::rigid_motion::best_rigid_motion;
use crate::sessions::Session;
use crate::sessions::SessionCorrection;
use crate::sessions::correct::divisor;
use crate::sessions::correction::{GRADIAN_DEG, TRAVEL_UNITS_MM, TURN_DEG};
use crate::units::{deg_from_rad, rad_from_deg};

use super::motor_values::{likely_ratios, likely_scales};

/// The values of a joint are so many times too large.
pub(super) fn values_of_a_motor(joint: usize, ratio: f64) -> (Text, Text, SessionCorrection) {
    let factor = 1.0 / ratio;
    let correction = SessionCorrection::ScaleJoint { joint, factor };
    (
        text!(
            "the values of joint {joint} are {ratio} times too large: those of its motor, or counts of an encoder",
            joint = joint + 1,
            ratio = divisor(factor)
        ),
        text!(
            "write the angle of the joint itself to {column}, or divide its values by {ratio}",
            column = format!("q{}", joint + 1),
            ratio = divisor(factor)
        ),
        correction,
    )
}

/// The only joint moves so many times what its values say.
fn scale_is_wrong(factor: f64) -> (Text, Text, SessionCorrection) {
    let scale = format!("{factor:.4}");
    (
        text!(
            "joint 1 moves {scale} times as far as its values say: its scale is wrong",
            scale = scale.clone()
        ),
        text!(
            "enter the scale of the joint in the controller, or multiply its values by {scale}",
            scale
        ),
        SessionCorrection::ScaleJoint { joint: 0, factor },
    )
}

/// A hypothesis: what is wrong, what to do, and how the data would read without it.
pub(super) struct Hypothesis {
    pub(super) what: Text,
    pub(super) proposal: Text,
    pub(super) mend: SessionCorrection,
}

/// A joint whose sign is wrong: what, what to do, and the change.
pub(super) fn other_way_round(joint: usize) -> (Text, Text, SessionCorrection) {
    let (number, factor) = (joint + 1, -1.0);
    (
        text!("joint {joint} counts the other way round", joint = number),
        text!(
            "reverse the sign of joint {joint} in the robot's description or in the samples",
            joint = number
        ),
        SessionCorrection::ScaleJoint { joint, factor },
    )
}

/// The home position of a joint is off by so many degrees.
pub(super) fn home_off_by(joint: usize, degrees: f64) -> (Text, Text, SessionCorrection) {
    let (number, turn) = (joint + 1, format!("{degrees}°"));
    (
        text!(
            "the home position of joint {joint} is off by {turn}",
            joint = number,
            turn = turn.clone()
        ),
        text!(
            "add {turn} to joint {joint} at home, or home the joint again",
            turn,
            joint = number
        ),
        turned_home(joint, degrees),
    )
}

pub(super) fn turned_home(joint: usize, degrees: f64) -> SessionCorrection {
    SessionCorrection::TurnHome {
        joint,
        by_rad: rad_from_deg(degrees),
    }
}

/// Units of a joint's values that were mistaken: a factor, and what is said of it.
pub(super) fn mistaken_units(kind: JointKind, joint: usize) -> Vec<(f64, Text)> {
    match kind {
        JointKind::Revolute => mistaken_angles(joint).into(),
        JointKind::Prismatic => mistaken_travels(joint).into(),
    }
}

fn mistaken_travels(joint: usize) -> [(f64, Text); 4] {
    TRAVEL_UNITS_MM.map(|(factor, unit)| {
        let what = text!(
            "the values of joint {joint} are in {unit} but were read as millimetres",
            joint,
            unit
        );
        (factor, what)
    })
}

fn mistaken_angles(joint: usize) -> [(f64, Text); 4] {
    [
        (
            rad_from_deg(1.0),
            text!(
                "the values of joint {joint} are in degrees but were read as radians",
                joint
            ),
        ),
        (
            deg_from_rad(1.0),
            text!(
                "the values of joint {joint} are in radians but were read as degrees",
                joint
            ),
        ),
        (
            GRADIAN_DEG,
            text!(
                "the values of joint {joint} are in gradians but were read as degrees",
                joint
            ),
        ),
        (
            TURN_DEG,
            text!(
                "the values of joint {joint} are in turns but were read as degrees",
                joint
            ),
        ),
    ]
}

/// The same of all joints that turn.
pub(super) fn mistaken_angles_of_all() -> [(f64, Text); 4] {
    [
        (
            rad_from_deg(1.0),
            text!("the values of all joints are in degrees but were read as radians"),
        ),
        (
            deg_from_rad(1.0),
            text!("the values of all joints are in radians but were read as degrees"),
        ),
        (
            GRADIAN_DEG,
            text!("the values of all joints are in gradians but were read as degrees"),
        ),
        (
            TURN_DEG,
            text!("the values of all joints are in turns but were read as degrees"),
        ),
    ]
}

/// The same of measured coordinates.
pub(super) fn mistaken_lengths() -> [(f64, Text); 4] {
    [
        (
            1000.0,
            text!("the measured coordinates are in metres but were read as millimetres"),
        ),
        (
            0.001,
            text!("the measured coordinates are in micrometres or were multiplied by 1000"),
        ),
        (
            25.4,
            text!("the measured coordinates are in inches but were read as millimetres"),
        ),
        (
            1.0 / 25.4,
            text!("the measured coordinates are in millimetres but were read as inches"),
        ),
    ]
}

/// What to do where a joint's values have another unit.
pub(super) fn correct_heading(joint: usize) -> Text {
    text!(
        "correct the unit in the heading of {column}",
        column = format!("q{joint}")
    )
}

/// The same of one of them: which, the factor, and what is said of it.
pub(super) fn mistaken_coordinates(session: &Session) -> Vec<(usize, f64, Text)> {
    let axes = ["x", "y", "z"].into_iter().enumerate();
    let units = [
        (1000.0, phrase!("metres")),
        (0.001, phrase!("micrometres")),
        (25.4, phrase!("inches")),
    ];
    let of = |(axis, name): (usize, &'static str)| {
        units.map(|(factor, unit)| {
            let what = text!(
                "the measured {axis} is in {unit} but was read as millimetres",
                axis = name,
                unit
            );
            (axis, factor, what)
        })
    };
    axes.take(session.samples.axes()).flat_map(of).collect()
}

/// Whether a correction changes the unit of one coordinate.
pub(super) fn is_of_one_coordinate(mend: &SessionCorrection) -> bool {
    matches!(mend, SessionCorrection::ScaleCoordinate { .. })
}

/// By how much what corrections leave is multiplied before it is compared with what there was: where the points become
/// larger, the measure does. One coordinate counts in units of all also where it becomes smaller: a slide along an axis
/// whose coordinate shrinks to nothing is explained by anything.
pub(super) fn change_of_measure(mends: &[SessionCorrection], before_mm: f64, after_mm: f64) -> f64 {
    let ratio = before_mm / after_mm.max(1e-12);
    if mends.iter().any(is_of_one_coordinate) {
        ratio
    } else {
        ratio.min(1.0)
    }
}

/// What to do where one of the measured coordinates has another unit.
pub(super) fn correct_coordinate(axis: usize) -> Text {
    let name = ["x", "y", "z"][axis.min(2)];
    text!("correct the unit in the heading of {column}", column = name)
}

#[allow(
    clippy::too_many_lines,
    reason = "a list of hypotheses reads best in one piece"
)]
pub(super) fn hypotheses(
    session: &Session,
    values: JointValues,
    left: impl Fn(&Session) -> Option<f64>,
) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    let mut push = |what: Text, proposal: Text, mend: SessionCorrection| {
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
        let kind = session.robot.joints[joint].kind;
        for (factor, what) in mistaken_units(kind, number) {
            push(
                what,
                correct_heading(number),
                SessionCorrection::ScaleJoint { joint, factor },
            );
        }
        if kind != JointKind::Revolute {
            continue;
        }
        for turn in [90.0, -90.0, 180.0] {
            let (what, proposal, mend) = home_off_by(joint, turn);
            push(what, proposal, mend);
        }
    }
    for (joint, ratio) in likely_ratios(session, values, &left) {
        let (what, proposal, mend) = values_of_a_motor(joint, ratio);
        push(what, proposal, mend);
    }
    for factor in likely_scales(session, values, &left) {
        let (what, proposal, mend) = scale_is_wrong(factor);
        push(what, proposal, mend);
    }
    for (factor, what) in mistaken_lengths() {
        push(
            what,
            text!("correct the unit in the headings of x, y and z"),
            SessionCorrection::ScaleLengths(factor),
        );
    }
    for (axis, factor, what) in mistaken_coordinates(session) {
        push(
            what,
            correct_coordinate(axis),
            SessionCorrection::ScaleCoordinate { axis, factor },
        );
    }
    if session.samples.z_mm.is_some() {
        for (order, what) in [
            ([1, 0, 2], phrase!("x and y")),
            ([0, 2, 1], phrase!("y and z")),
            ([2, 1, 0], phrase!("x and z")),
            ([1, 2, 0], phrase!("x, y and z (read as y, z, x)")),
            ([2, 0, 1], phrase!("x, y and z (read as z, x, y)")),
        ] {
            push(
                text!("the measured axes {axes} are swapped", axes = what),
                text!("exchange the headings of the measured columns"),
                SessionCorrection::Reorder(order),
            );
        }
    } else {
        push(
            text!(
                "the measured axes {axes} are swapped",
                axes = phrase!("x and y")
            ),
            text!("exchange the headings of the measured columns"),
            SessionCorrection::Reorder([1, 0, 2]),
        );
    }
    if let Some(frame) = misaligned_frame(session) {
        let t = frame.translation.vector;
        let turn = deg_from_rad(frame.rotation.angle());
        push(
            text!("the measuring frame was never aligned with the robot's base"),
            text!(
                "align the instrument (turned by {turn}, moved by {shift}), or give the samples a `setup` column so that the frame is fitted",
                turn = format!("{turn:.2}°"),
                shift = format!("{:.2}, {:.2}, {:.2} mm", t.x, t.y, t.z)
            ),
            SessionCorrection::FreeFrame,
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
