//! What may have gone wrong in setting up a robot with several joints, simplest first.

use crate::kinematics::JointKind;
use crate::sessions::Session;
use crate::sessions::SessionCorrection;
use crate::text::Text;
use crate::units::rad_from_deg;

use super::hypotheses::{
    correct_heading, mistaken_angles_of_all, mistaken_lengths, mistaken_units, other_way_round,
};

/// A change of the samples: what is wrong, what to do, and what takes it back.
pub(super) struct Change {
    pub(super) what: Text,
    pub(super) proposal: Text,
    pub(super) mends: Vec<SessionCorrection>,
}

/// Axes whose directions agree so well are parallel: cos 8°.
const PARALLEL: f64 = 0.99;

/// Every change that makes sense for a robot.
pub(super) fn changes(session: &Session) -> Vec<Change> {
    let mut all = signs(session);
    all.extend(exchanged(session));
    all.extend(coupled(session));
    all.extend(homes(session));
    all.extend(units(session));
    all.extend(measured(session));
    all.extend(driven(session));
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
    let joints = 0..session.robot.joints.len();
    let sign = |(what, proposal, mend)| one(what, proposal, mend);
    joints.map(other_way_round).map(sign).collect()
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
            let (a, b) = (first + 1, second + 1);
            all.push(one(
                text!("joints {a} and {b} are exchanged", a = a, b = b),
                text!("exchange the columns of joints {a} and {b}", a = a, b = b),
                SessionCorrection::ExchangeJoints { first, second },
            ));
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
    let joints = &session.robot.joints;
    let mut all = Vec::new();
    for joint in 1..joints.len() {
        let pair = [&joints[joint - 1], &joints[joint]];
        let [a, b] = pair.map(|j| j.axis.direction.into_inner());
        let turning = pair.iter().all(|j| j.kind == JointKind::Revolute);
        if !turning || a.dot(&b).abs() < PARALLEL {
            continue;
        }
        let (before, number) = (joint, joint + 1);
        let coupled = text!(
            "joints {a} and {b} are coupled (parallelogram) but were taken for uncoupled",
            a = before,
            b = number
        );
        let uncoupled = text!(
            "joints {a} and {b} are uncoupled but were taken for coupled (parallelogram)",
            a = before,
            b = number
        );
        for (factor, what) in [(-1.0, coupled), (1.0, uncoupled)] {
            let factor = factor * a.dot(&b).signum();
            all.push(one(
                what,
                in_the_value(factor, before, number),
                SessionCorrection::CoupleJoint {
                    joint,
                    from: joint - 1,
                    factor,
                },
            ));
        }
    }
    all
}

/// Gears and belts of a wrist, or of a joint whose motor stands in the base, drive a joint by the value of any
/// other that turns; neighbouring parallel ones are a parallelogram.
fn driven(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let turning = |j: usize| joints[j].kind == JointKind::Revolute;
    let is_parallelogram = |from: usize, joint: usize| {
        let [a, b] = [from, joint].map(|j| joints[j].axis.direction.into_inner());
        from + 1 == joint && a.dot(&b).abs() >= PARALLEL
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
    let turned = |joint: usize, degrees: f64| SessionCorrection::TurnHome {
        joint,
        by_rad: rad_from_deg(degrees),
    };
    let mut all = Vec::new();
    for joint in (1..joints.len()).filter(|j| turning(*j)) {
        let number = joint + 1;
        for turn in [90.0, -90.0, 180.0] {
            all.push(one(
                text!(
                    "the home position of joint {joint} is off by {turn}",
                    joint = number,
                    turn = format!("{turn}°")
                ),
                text!(
                    "add {turn} to joint {joint} at home, or home the joint again",
                    turn = format!("{turn}°"),
                    joint = number
                ),
                turned(joint, turn),
            ));
        }
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
                mends: vec![turned(before, 180.0), turned(after, 180.0)],
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
    // Two pairs exchanged are a turn of the frame: what is left is one exchange, or a sign.
    let free = session.samples.z_mm.is_some();
    let what = if free {
        text!("two of the measured axes are swapped (such as x and y), or one of them is reversed")
    } else {
        text!(
            "the measured axes {axes} are swapped",
            axes = phrase!("x and y")
        )
    };
    all.push(one(
        what,
        text!("exchange the headings of the measured columns, or reverse one of them"),
        SessionCorrection::Reorder([1, 0, 2]),
    ));
    all
}
