//! What may have gone wrong in setting up a robot with several joints, simplest first.

use crate::effects::JointValues;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::Session;
use crate::sessions::SessionCorrection;
use crate::text::Text;

use super::hypotheses::{
    correct_coordinate, correct_heading, home_off_by, mistaken_angles_of_all, mistaken_coordinates,
    mistaken_lengths, mistaken_units, other_way_round, turned_home, values_of_a_motor,
};
use super::motor_values::likely_ratios;
use super::trial::trial;

/// A change of the samples: what is wrong, what to do, and what takes it back.
pub(super) struct Change {
    pub(super) what: Text,
    pub(super) proposal: Text,
    pub(super) mends: Vec<SessionCorrection>,
}

/// Axes whose directions agree so well are parallel: cos 8°.
const PARALLEL: f64 = 0.99;

/// Every change that makes sense for a robot.
pub(super) fn changes(session: &Session, values: JointValues) -> Vec<Change> {
    let mut all = signs(session);
    all.extend(exchanged(session));
    all.extend(coupled(session));
    all.extend(homes(session));
    all.extend(units(session));
    all.extend(measured(session));
    all.extend(driven(session));
    let motors = likely_ratios(session, values, |scaled| {
        trial(scaled, values, true).map(|end| end.median_mm())
    });
    let motors = motors
        .into_iter()
        .map(|(joint, ratio)| values_of_a_motor(joint, ratio));
    all.extend(motors.map(|(what, proposal, mend)| one(what, proposal, mend)));
    all
}

/// Every change that may hold for a part of the rows, simplest first.
pub(super) fn of_rows(session: &Session) -> Vec<Change> {
    let mut all = signs(session);
    all.extend(units(session));
    all.extend(homes(session));
    all.extend(measured(session));
    all.extend(exchanged(session));
    all.extend(coupled(session));
    all.push(one(
        text!("the measured points are in another frame"),
        text!("align the instrument, or give these samples another `setup`"),
        SessionCorrection::FreeFrame,
    ));
    // What has several changes is another's twin, and read-back values are of all rows.
    all.retain(|change| matches!(change.mends.as_slice(), [mend] if *mend != SessionCorrection::TakeReadBack));
    all
}

fn one(what: Text, proposal: Text, mend: SessionCorrection) -> Change {
    Change {
        what,
        proposal,
        mends: vec![mend],
    }
}

fn signs(session: &Session) -> Vec<Change> {
    (0..session.robot.joints.len()).map(sign).collect()
}

/// A joint counts the other way round.
pub(super) fn sign(joint: usize) -> Change {
    let (what, proposal, mend) = other_way_round(joint);
    one(what, proposal, mend)
}

/// Two joints are exchanged.
pub(super) fn exchange(first: usize, second: usize) -> Change {
    let (a, b) = (first + 1, second + 1);
    one(
        text!("joints {a} and {b} are exchanged", a, b),
        text!("exchange the columns of joints {a} and {b}", a, b),
        SessionCorrection::ExchangeJoints { first, second },
    )
}

/// The home position of a joint is off by so many degrees.
pub(super) fn home(joint: usize, degrees: f64) -> Change {
    let (what, proposal, mend) = home_off_by(joint, degrees);
    one(what, proposal, mend)
}

fn exchanged(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let mut all = Vec::new();
    for first in 0..joints.len() {
        for second in first + 1..joints.len() {
            // A slide in millimetres and a turn in degrees are not exchanged by accident.
            if joints[first].kind != joints[second].kind {
                continue;
            }
            all.push(exchange(first, second));
        }
    }
    let read = &session.samples.q_read;
    if !read.is_empty() && read.iter().all(Option::is_some) {
        all.push(one(
            text!("the measured points follow the joint values that were read back, not the commanded ones"),
            text!("start from the values read back (--joint-values read), and check where the commands come from"),
            SessionCorrection::TakeReadBack,
        ));
    }
    all
}

/// A parallelogram drives an arm's joint 3 from the base: its value holds that of joint 2.
fn coupled(session: &Session) -> Vec<Change> {
    let robot = &session.robot;
    let joints = 1..robot.joints.len();
    let parallel = joints.filter(|joint| is_parallel_to_the_one_before(robot, *joint));
    let coupled = parallel.flat_map(|joint| {
        let along = directions(robot, joint).signum();
        [-along, along].map(|factor| parallelogram(robot, joint, factor))
    });
    coupled.collect()
}

/// Whether a joint turns about an axis parallel to that of the joint before.
pub(super) fn is_parallel_to_the_one_before(robot: &Robot, joint: usize) -> bool {
    let turns = |joint: usize| robot.joints[joint].kind == JointKind::Revolute;
    joint > 0 && turns(joint - 1) && turns(joint) && directions(robot, joint).abs() >= PARALLEL
}

/// Cosine between a joint's axis and the one before.
fn directions(robot: &Robot, joint: usize) -> f64 {
    let direction = |joint: usize| robot.joints[joint].axis.direction.into_inner();
    direction(joint - 1).dot(&direction(joint))
}

/// The value of the joint before, times ±1, is missing in the value of a joint.
pub(super) fn parallelogram(robot: &Robot, joint: usize, factor: f64) -> Change {
    let (before, number) = (joint, joint + 1);
    let what = if factor * directions(robot, joint) < 0.0 {
        text!(
            "joints {a} and {b} are coupled (parallelogram) but were taken for uncoupled",
            a = before,
            b = number
        )
    } else {
        text!(
            "joints {a} and {b} are uncoupled but were taken for coupled (parallelogram)",
            a = before,
            b = number
        )
    };
    one(
        what,
        in_the_value(factor, before, number),
        SessionCorrection::CoupleJoint {
            joint,
            from: joint - 1,
            factor,
        },
    )
}

/// Gears and belts of a wrist, or of a joint whose motor stands in the base, drive a joint by the value of any
/// other that turns; neighbouring parallel ones are a parallelogram.
fn driven(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let turning = |j: usize| joints[j].kind == JointKind::Revolute;
    let is_parallelogram = |from: usize, joint: usize| {
        from + 1 == joint && is_parallel_to_the_one_before(&session.robot, joint)
    };
    let mut all = Vec::new();
    for joint in (1..joints.len()).filter(|j| turning(*j)) {
        for from in (0..joint).filter(|j| turning(*j) && !is_parallelogram(*j, joint)) {
            let (before, number) = (from + 1, joint + 1);
            for factor in [-1.0, 1.0] {
                all.push(one(
                    text!(
                        "joints {a} and {b} are coupled but were taken for uncoupled",
                        a = before,
                        b = number
                    ),
                    in_the_value(factor, before, number),
                    SessionCorrection::CoupleJoint {
                        joint,
                        from,
                        factor,
                    },
                ));
            }
        }
    }
    all
}

fn homes(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let turning = |j: usize| joints[j].kind == JointKind::Revolute;
    let mut all = Vec::new();
    for joint in (1..joints.len()).filter(|j| turning(*j)) {
        all.extend([90.0, -90.0, 180.0].map(|turn| home(joint, turn)));
    }
    // The home of joint 1 is the frame, so its neighbour's twin is a home alone.
    for joint in 2..joints.len().saturating_sub(1) {
        let (before, after) = (joint - 1, joint + 1);
        if turning(before) && turning(after) {
            all.push(Change {
                what: text!(
                    "the home positions of joints {a} and {b} are off by 180°",
                    a = before + 1,
                    b = after + 1
                ),
                proposal: Text::default(),
                mends: vec![turned_home(before, 180.0), turned_home(after, 180.0)],
            });
        }
    }
    all
}

fn units(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let turning = joints.iter().filter(|j| j.kind == JointKind::Revolute);
    let mut all = Vec::new();
    if turning.count() > 1 {
        for (factor, what) in mistaken_angles_of_all() {
            all.push(one(
                what,
                text!("correct the unit in the headings of the joints"),
                SessionCorrection::ScaleJoints { factor },
            ));
        }
    }
    for (joint, own) in joints.iter().enumerate() {
        for (factor, what) in mistaken_units(own.kind, joint + 1) {
            all.push(one(
                what,
                correct_heading(joint + 1),
                SessionCorrection::ScaleJoint { joint, factor },
            ));
        }
    }
    all
}

/// What to do where a joint's value holds another's.
fn in_the_value(factor: f64, before: usize, number: usize) -> Text {
    if factor < 0.0 {
        text!(
            "subtract joint {a} in the value of joint {b}",
            a = before,
            b = number
        )
    } else {
        text!(
            "add joint {a} in the value of joint {b}",
            a = before,
            b = number
        )
    }
}

fn measured(session: &Session) -> Vec<Change> {
    let mut all = Vec::new();
    for (factor, what) in mistaken_lengths() {
        all.push(one(
            what,
            text!("correct the unit in the headings of x, y and z"),
            SessionCorrection::ScaleLengths(factor),
        ));
    }
    for (axis, factor, what) in mistaken_coordinates(session) {
        all.push(one(
            what,
            correct_coordinate(axis),
            SessionCorrection::ScaleCoordinate { axis, factor },
        ));
    }
    all.push(axes_exchanged(session));
    all
}

/// Two of the measured axes are exchanged. Two pairs exchanged are a turn of the frame: what is left is one exchange,
/// or a sign.
pub(super) fn axes_exchanged(session: &Session) -> Change {
    let free = session.samples.z_mm.is_some();
    let what = if free {
        text!("two of the measured axes are swapped (such as x and y), or one of them is reversed")
    } else {
        text!(
            "the measured axes {axes} are swapped",
            axes = phrase!("x and y")
        )
    };
    one(
        what,
        text!("exchange the headings of the measured columns, or reverse one of them"),
        SessionCorrection::Reorder([1, 0, 2]),
    )
}
