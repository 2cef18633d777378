//! Set-up errors as changes of the samples that undo them: the register of hypotheses, simplest first. Any of them may
//! hold for a part of the rows alone.

use crate::effects::JointValues;
use crate::fit::base_model;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::correct::divisor;
use crate::sessions::correction::{GRADIAN_DEG, TRAVEL_UNITS_MM, TURN_DEG};
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Template, Text};
use crate::units::{deg_from_rad, rad_from_deg};

use super::fits::trial;
use super::motor_values::{likely_ratios, likely_scales};

/// A change of the samples: what is wrong, what to do, and the correction.
pub(super) struct Change {
    pub(super) what: Text,
    pub(super) proposal: Text,
    pub(super) corrections: Vec<SessionCorrection>,
}

impl Change {
    fn new(what: Text, proposal: Text, correction: SessionCorrection) -> Self {
        Self {
            what,
            proposal,
            corrections: vec![correction],
        }
    }

    /// The same with the changes that are equivalent to it in these samples.
    pub(super) fn with_equivalents(what: Text, twins: &[Text]) -> Text {
        if twins.is_empty() {
            return what;
        }
        text!(
            "{what}; in these samples the same as: {others}",
            what,
            others = Text::listed(twins, "; ")
        )
    }
}

/// Axes whose directions agree so well are parallel: cos 8°.
const PARALLEL: f64 = 0.99;

/// Whether a fit may put the instrument anywhere: then the home of the first joint is the measuring frame.
pub(super) fn frame_is_free(session: &Session) -> bool {
    base_model::is_arm(session) || session.samples.setups.is_some()
}

/// Every change that makes sense for a robot.
pub(super) fn changes(session: &Session, values: JointValues) -> Vec<Change> {
    let residual_mm = |scaled: &Session| {
        let end = trial(scaled, values, frame_is_free(session))?;
        Some(end.within_mm(super::thresholds::HALF))
    };
    let mut all = plain(session, frame_is_free(session));
    all.extend(driven(session));
    let motors = likely_ratios(session, values, residual_mm).into_iter();
    all.extend(motors.map(|(joint, ratio)| values_of_a_motor(joint, ratio)));
    let scales = likely_scales(session, values, residual_mm).into_iter();
    all.extend(scales.map(scale_is_wrong));
    all
}

/// Every change that may hold for a part of the rows.
pub(super) fn of_rows(session: &Session) -> Vec<Change> {
    let mut all = plain(session, true);
    all.push(Change::new(
        text!("the measured points are in another frame"),
        text!("align the instrument, or give these samples another `setup`"),
        SessionCorrection::FreeFrame,
    ));
    // What has several changes is another's twin, and read-back values are of all rows.
    all.retain(|change| matches!(change.corrections.as_slice(), [correction] if *correction != SessionCorrection::TakeReadBack));
    all
}

/// The changes that are tried whatever the values are.
fn plain(session: &Session, frame_is_free: bool) -> Vec<Change> {
    let mut all: Vec<Change> = (0..session.robot.joints.len()).map(sign).collect();
    all.extend(exchanged(session));
    all.extend(coupled(session));
    all.extend(homes(session, frame_is_free));
    all.extend(units(session));
    if frame_is_free || session.samples.z_mm.is_none() {
        all.push(axes_exchanged(session));
    } else {
        all.extend(orders_of_axes());
    }
    all
}

/// A joint counts the other way round.
pub(super) fn sign(joint: usize) -> Change {
    let (number, factor) = (joint + 1, -1.0);
    Change::new(
        text!("joint {joint} counts the other way round", joint = number),
        text!(
            "reverse the sign of joint {joint} in the robot's description or in the samples",
            joint = number
        ),
        SessionCorrection::ScaleJoint { joint, factor },
    )
}

/// Two joints are exchanged.
pub(super) fn exchange(first: usize, second: usize) -> Change {
    let (a, b) = (first + 1, second + 1);
    Change::new(
        text!("joints {a} and {b} are exchanged", a, b),
        text!("exchange the columns of joints {a} and {b}", a, b),
        SessionCorrection::ExchangeJoints { first, second },
    )
}

/// The home position of a joint is off by so many degrees.
pub(super) fn home(joint: usize, degrees: f64) -> Change {
    let (number, turn) = (joint + 1, format!("{degrees}°"));
    Change::new(
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

fn turned_home(joint: usize, degrees: f64) -> SessionCorrection {
    SessionCorrection::TurnHome {
        joint,
        by_rad: rad_from_deg(degrees),
    }
}

/// The values of a joint are so many times too large.
fn values_of_a_motor(joint: usize, ratio: f64) -> Change {
    let factor = 1.0 / ratio;
    Change::new(
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
        SessionCorrection::ScaleJoint { joint, factor },
    )
}

/// The only joint moves so many times what its values state.
fn scale_is_wrong(factor: f64) -> Change {
    let scale = format!("{factor:.4}");
    Change::new(
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

fn exchanged(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let mut all = Vec::new();
    for first in 0..joints.len() {
        // A slide in millimetres and a turn in degrees are not exchanged by accident.
        let others = (first + 1..joints.len()).filter(|j| joints[*j].kind == joints[first].kind);
        all.extend(others.map(|second| exchange(first, second)));
    }
    let read = &session.samples.q_read;
    if base_model::is_arm(session) && read.iter().all(Option::is_some) {
        all.push(Change::new(
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

fn turns(robot: &Robot, joint: usize) -> bool {
    robot.joints[joint].kind == JointKind::Revolute
}

/// Whether a joint turns about an axis parallel to that of the joint before.
pub(super) fn is_parallel_to_the_one_before(robot: &Robot, joint: usize) -> bool {
    let both_turn = joint > 0 && turns(robot, joint - 1) && turns(robot, joint);
    both_turn && directions(robot, joint).abs() >= PARALLEL
}

/// Cosine between a joint's axis and the one before.
fn directions(robot: &Robot, joint: usize) -> f64 {
    let direction = |joint: usize| robot.joints[joint].axis.direction.into_inner();
    direction(joint - 1).dot(&direction(joint))
}

/// The value of the joint before, times ±1, is missing in the value of a joint.
pub(super) fn parallelogram(robot: &Robot, joint: usize, factor: f64) -> Change {
    let (a, b) = (joint, joint + 1);
    let what = if factor * directions(robot, joint) < 0.0 {
        text!(
            "joints {a} and {b} are coupled (parallelogram) but were taken for uncoupled",
            a,
            b
        )
    } else {
        text!(
            "joints {a} and {b} are uncoupled but were taken for coupled (parallelogram)",
            a,
            b
        )
    };
    in_the_value(what, joint - 1, joint, factor)
}

/// Gears and belts of a wrist, or of a joint whose motor is in the base, drive a joint by the value of any other that
/// turns; neighbouring parallel ones are a parallelogram.
fn driven(session: &Session) -> Vec<Change> {
    let robot = &session.robot;
    let mut all = Vec::new();
    for joint in (1..robot.joints.len()).filter(|j| turns(robot, *j)) {
        let is_parallelogram =
            |from: usize| from + 1 == joint && is_parallel_to_the_one_before(robot, joint);
        for from in (0..joint).filter(|j| turns(robot, *j) && !is_parallelogram(*j)) {
            let (a, b) = (from + 1, joint + 1);
            let what = text!(
                "joints {a} and {b} are coupled but were taken for uncoupled",
                a,
                b
            );
            all.extend([-1.0, 1.0].map(|factor| in_the_value(what.clone(), from, joint, factor)));
        }
    }
    all
}

/// A joint's value holds another's.
fn in_the_value(what: Text, from: usize, joint: usize, factor: f64) -> Change {
    let (a, b) = (from + 1, joint + 1);
    let proposal = if factor < 0.0 {
        text!("subtract joint {a} in the value of joint {b}", a, b)
    } else {
        text!("add joint {a} in the value of joint {b}", a, b)
    };
    let correction = SessionCorrection::CoupleJoint {
        joint,
        from,
        factor,
    };
    Change::new(what, proposal, correction)
}

fn homes(session: &Session, frame_is_free: bool) -> Vec<Change> {
    let robot = &session.robot;
    let mut all = Vec::new();
    for joint in (usize::from(frame_is_free)..robot.joints.len()).filter(|j| turns(robot, *j)) {
        all.extend([90.0, -90.0, 180.0].map(|turn| home(joint, turn)));
    }
    // The home of joint 1 is the frame, so its neighbour's twin is a home alone.
    for joint in 2..robot.joints.len().saturating_sub(1) {
        let (before, after) = (joint - 1, joint + 1);
        if turns(robot, before) && turns(robot, after) {
            all.push(Change {
                what: text!(
                    "the home positions of joints {a} and {b} are off by 180°",
                    a = before + 1,
                    b = after + 1
                ),
                proposal: Text::default(),
                corrections: vec![turned_home(before, 180.0), turned_home(after, 180.0)],
            });
        }
    }
    all
}

/// A unit that is taken for another: what values in it are multiplied by, its name, and that of the other.
type Mistaken = (f64, Template, Template);

fn mistaken_angles() -> [Mistaken; 4] {
    let (degrees, radians) = (phrase!("degrees"), phrase!("radians"));
    [
        (rad_from_deg(1.0), degrees, radians),
        (deg_from_rad(1.0), radians, degrees),
        (GRADIAN_DEG, phrase!("gradians"), degrees),
        (TURN_DEG, phrase!(in "angle", "turns"), degrees),
    ]
}

fn mistaken_lengths() -> [Mistaken; 4] {
    let (inches, millimetres) = (phrase!("inches"), phrase!("millimetres"));
    [
        (1000.0, phrase!("metres"), millimetres),
        (0.001, phrase!("micrometres"), millimetres),
        (25.4, inches, millimetres),
        (1.0 / 25.4, millimetres, inches),
    ]
}

fn units(session: &Session) -> Vec<Change> {
    let joints = &session.robot.joints;
    let mut all = Vec::new();
    if joints
        .iter()
        .filter(|j| j.kind == JointKind::Revolute)
        .count()
        > 1
    {
        all.extend(mistaken_angles().map(|(factor, unit, other)| {
            Change::new(
                text!(
                    "the values of all joints are in {unit} but were read as {other}",
                    unit,
                    other
                ),
                text!("correct the unit in the headings of the joints"),
                SessionCorrection::ScaleJoints { factor },
            )
        }));
    }
    for (joint, own) in joints.iter().enumerate() {
        let mistaken = match own.kind {
            JointKind::Revolute => mistaken_angles(),
            JointKind::Prismatic => {
                TRAVEL_UNITS_MM.map(|(factor, unit)| (factor, unit, phrase!("millimetres")))
            }
        };
        all.extend(mistaken.map(|(factor, unit, other)| {
            Change::new(
                text!(
                    "the values of joint {joint} are in {unit} but were read as {other}",
                    joint = joint + 1,
                    unit,
                    other
                ),
                correct_the_unit_of(format!("q{}", joint + 1)),
                SessionCorrection::ScaleJoint { joint, factor },
            )
        }));
    }
    all.extend(mistaken_lengths().map(|(factor, unit, other)| {
        Change::new(
            text!(
                "the measured coordinates are in {unit} but were read as {other}",
                unit,
                other
            ),
            text!("correct the unit in the headings of x, y and z"),
            SessionCorrection::ScaleLengths(factor),
        )
    }));
    for (axis, name) in ["x", "y", "z"]
        .into_iter()
        .enumerate()
        .take(session.samples.axes())
    {
        let into_millimetres = mistaken_lengths().into_iter().take(3);
        all.extend(into_millimetres.map(|(factor, unit, _)| {
            Change::new(
                text!(
                    "the measured {axis} is in {unit} but was read as millimetres",
                    axis = name,
                    unit
                ),
                correct_the_unit_of(name.to_owned()),
                SessionCorrection::ScaleCoordinate { axis, factor },
            )
        }));
    }
    all
}

fn correct_the_unit_of(column: String) -> Text {
    text!("correct the unit in the heading of {column}", column)
}

/// Whether a correction changes the unit of one coordinate.
pub(super) fn is_of_one_coordinate(correction: &SessionCorrection) -> bool {
    matches!(correction, SessionCorrection::ScaleCoordinate { .. })
}

/// Two of the measured axes are exchanged. Two pairs exchanged are a turn of the frame, so that only one exchange, or
/// a sign, is needed.
pub(super) fn axes_exchanged(session: &Session) -> Change {
    let what = if session.samples.z_mm.is_some() {
        text!("two of the measured axes are swapped (such as x and y), or one of them is reversed")
    } else {
        text!(
            "the measured axes {axes} are swapped",
            axes = phrase!("x and y")
        )
    };
    Change::new(
        what,
        text!("exchange the headings of the measured columns, or reverse one of them"),
        SessionCorrection::Reorder([1, 0, 2]),
    )
}

/// Orders of the measured axes where the frame is that of the robot.
fn orders_of_axes() -> [Change; 5] {
    [
        ([1, 0, 2], phrase!("x and y")),
        ([0, 2, 1], phrase!("y and z")),
        ([2, 1, 0], phrase!("x and z")),
        ([1, 2, 0], phrase!("x, y and z (read as y, z, x)")),
        ([2, 0, 1], phrase!("x, y and z (read as z, x, y)")),
    ]
    .map(|(order, axes)| {
        Change::new(
            text!("the measured axes {axes} are swapped", axes),
            text!("exchange the headings of the measured columns"),
            SessionCorrection::Reorder(order),
        )
    })
}
