//! What may have gone wrong in setting up a robot with several joints, simplest first.

use crate::kinematics::JointKind;
use crate::sessions::Mend;
use crate::sessions::Session;
use crate::units::{deg_from_rad, rad_from_deg};

use super::hypotheses::other_way_round;

/// A change of the samples: what is wrong, what to do, and what takes it back.
pub(super) struct Change {
    pub(super) what: String,
    pub(super) proposal: String,
    pub(super) mends: Vec<Mend>,
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

fn one(what: String, proposal: String, mend: Mend) -> Change {
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
                format!("joints {a} and {b} are exchanged"),
                format!("exchange the columns of joints {a} and {b}"),
                Mend::ExchangeJoints { first, second },
            ));
        }
    }
    let read = &session.samples.q_read;
    if !read.is_empty() && read.iter().all(Option::is_some) {
        all.push(one(
            "the measured points follow the joint values that were read back, not the commanded ones"
                .to_owned(),
            "start from the values read back (--joint-values read), and check where the commands \
             come from"
                .to_owned(),
            Mend::TakeReadBack,
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
        for (factor, what) in [
            (
                -1.0,
                "are coupled (parallelogram) but were taken for uncoupled",
            ),
            (
                1.0,
                "are uncoupled but were taken for coupled (parallelogram)",
            ),
        ] {
            let factor = factor * a.dot(&b).signum();
            let sign = if factor < 0.0 { "subtract" } else { "add" };
            all.push(one(
                format!("joints {before} and {number} {what}"),
                format!("{sign} joint {before} in the value of joint {number}"),
                Mend::CoupleJoint {
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
            for (factor, sign) in [(-1.0, "subtract"), (1.0, "add")] {
                all.push(one(
                    format!(
                        "joints {before} and {number} are coupled but were taken for uncoupled"
                    ),
                    format!("{sign} joint {before} in the value of joint {number}"),
                    Mend::CoupleJoint {
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
    let turned = |joint: usize, degrees: f64| Mend::TurnHome {
        joint,
        by_rad: rad_from_deg(degrees),
    };
    let mut all = Vec::new();
    for joint in (1..joints.len()).filter(|j| turning(*j)) {
        let number = joint + 1;
        for turn in [90.0, -90.0, 180.0] {
            all.push(one(
                format!("the home position of joint {number} is off by {turn}°"),
                format!("add {turn}° to joint {number} at home, or home the joint again"),
                turned(joint, turn),
            ));
        }
    }
    // The home of joint 1 is the frame, so its neighbour's twin is a home alone.
    for joint in 2..joints.len().saturating_sub(1) {
        let (before, after) = (joint - 1, joint + 1);
        if turning(before) && turning(after) {
            all.push(Change {
                what: format!(
                    "the home positions of joints {} and {} are off by 180°",
                    before + 1,
                    after + 1
                ),
                proposal: String::new(),
                mends: vec![turned(before, 180.0), turned(after, 180.0)],
            });
        }
    }
    all
}

fn units(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let turning: Vec<usize> = (0..joints.len())
        .filter(|j| joints[*j].kind == JointKind::Revolute)
        .collect();
    let mut all = Vec::new();
    for (factor, what) in [
        (rad_from_deg(1.0), "are in degrees but were read as radians"),
        (deg_from_rad(1.0), "are in radians but were read as degrees"),
    ] {
        if turning.len() > 1 {
            all.push(one(
                format!("the values of all joints {what}"),
                "correct the unit in the headings of the joints".to_owned(),
                Mend::ScaleJoints { factor },
            ));
        }
        for joint in &turning {
            let number = joint + 1;
            all.push(one(
                format!("the values of joint {number} {what}"),
                format!("correct the unit in the heading of q{number}"),
                Mend::ScaleJoint {
                    joint: *joint,
                    factor,
                },
            ));
        }
    }
    all
}

fn measured(session: &Session) -> Vec<Change> {
    let mut all = Vec::new();
    for (factor, what) in [
        (1000.0, "in metres but were read as millimetres"),
        (0.001, "in micrometres or were multiplied by 1000"),
        (25.4, "in inches but were read as millimetres"),
        (1.0 / 25.4, "in millimetres but were read as inches"),
    ] {
        all.push(one(
            format!("the measured coordinates are {what}"),
            "correct the unit in the headings of x, y and z".to_owned(),
            Mend::ScaleLengths(factor),
        ));
    }
    // Two pairs exchanged are a turn of the frame: what is left is one exchange, or a sign.
    let free = session.samples.z_mm.is_some();
    let what = if free {
        "two of the measured axes are swapped (such as x and y), or one of them is reversed"
    } else {
        "the measured axes x and y are swapped"
    };
    all.push(one(
        what.to_owned(),
        "exchange the headings of the measured columns, or reverse one of them".to_owned(),
        Mend::Reorder([1, 0, 2]),
    ));
    all
}
