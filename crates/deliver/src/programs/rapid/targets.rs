//! Lists in brackets: targets, tools and work objects of RAPID, as they are written.

use crate::kinematics::Pose;
use crate::kinematics::configuration::Statement;
use crate::programs::program::not_in_numbers;
use crate::text::Text as Sentence;

use super::super::axes::{Axes, Slot};
use super::super::number::Number;
use super::super::pose::{Frame, Orientation};
use super::super::target::{Problem, Shape, Target};
use super::super::walk::{Constant, Walk};
use super::super::words::{List, Value, Words};

/// An external axis from here on is none.
const NOT_THERE: f64 = 8.9e9;

/// Where an external axis is, if it is there.
pub(super) fn external(number: Number) -> Option<f64> {
    Some(number.value).filter(|value| value.abs() < NOT_THERE)
}

/// The pose of a tool on the flange, or of a work object in the base; in words why there is none.
pub(super) fn held(
    words: &Words,
    list: &List,
    spelled: &str,
    tool: bool,
) -> Result<Result<Pose, Sentence>, Problem> {
    let pose = match &list.parts[..] {
        [_, frame, ..] if tool => {
            if list.word(words, 0) != "true" {
                return Ok(Err(text!("{spelled} does not sit on the robot", spelled)));
            }
            pose_of(&frame.value, spelled)?
        }
        [_, _, _, user, object] if !tool => {
            if list.word(words, 0) != "false" || list.word(words, 1) != "true" {
                let says = text!(
                    "{spelled} is moved by the robot or by another unit",
                    spelled
                );
                return Ok(Err(says));
            }
            let user = pose_of(&user.value, spelled)?;
            let object = pose_of(&object.value, spelled)?;
            user.zip(object).map(|(user, object)| user * object)
        }
        _ => None,
    };
    Ok(pose.ok_or_else(|| not_in_numbers(spelled)))
}

/// `[[x, y, z], [q1, q2, q3, q4]]`
fn pose_of(value: &Value, spelled: &str) -> Result<Option<Pose>, Problem> {
    let numbers = |list: &List| -> Option<Vec<Vec<Number>>> {
        list.parts
            .iter()
            .map(|part| part.value.list()?.numbers())
            .collect()
    };
    let numbers = value.list().and_then(numbers);
    let Some([position, turn]) = numbers.as_deref() else {
        return Ok(None);
    };
    let ([x, y, z], 4) = (&position[..], turn.len()) else {
        return Ok(None);
    };
    let frame = frame_of([*x, *y, *z], turn.clone());
    check_length(&frame, spelled)?;
    Ok(frame.pose())
}

fn frame_of(position: [Number; 3], turn: Vec<Number>) -> Frame {
    Frame {
        position,
        mm: [1.0; 3],
        turn,
        orientation: Orientation::Quaternion,
    }
}

/// A quaternion that is no unit is a slip of the keyboard.
fn check_length(frame: &Frame, name: &str) -> Result<(), Problem> {
    let Some((at, length)) = frame.wrong_length() else {
        return Ok(());
    };
    let length = format!("{length:.4}");
    let found = in_the(text!("a length of {length}", length), name);
    Err(Problem::new(
        at,
        found,
        text!("a length of {length}", length = 1),
    ))
}

/// The mass of `[mass, [centre], [axes], ix, iy, iz]`, kg.
pub(super) fn mass(load: Option<&List>) -> Option<f64> {
    let first = load?.parts.first()?;
    first.value.number().map(|number| number.value)
}

fn counted(count: usize) -> Sentence {
    text!(one "{count} value", "{count} values", count)
}

fn in_the(component: Sentence, name: &str) -> Sentence {
    text!("{component} in {name}", component, name)
}

pub(super) fn computed(spelled: &str) -> Sentence {
    not_in_numbers(spelled)
}

/// A target of a list, or why it is none: a part of it is worked out at run time. `pose`: what it has
/// to be; without, the number of its parts says it.
pub(super) fn target(
    walk: &mut Walk,
    words: &Words,
    list: &List,
    name: &str,
    pose: Option<bool>,
) -> Result<Result<Target, Sentence>, Problem> {
    let pose = pose.unwrap_or(list.parts.len() == 4);
    let (sizes, expected): (&[usize], _) = if pose {
        (
            &[3, 4, 4, 6],
            "robtarget [[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [eax_a … eax_f]]",
        )
    } else {
        (&[6, 6], "jointtarget [[rax_1 … rax_6], [eax_a … eax_f]]")
    };
    let expected = Sentence::verbatim(expected);
    let count = list.parts.len();
    if count != sizes.len() {
        let found = in_the(counted(count), name);
        return Err(Problem::new(list.at, found, expected));
    }
    let mut numbers: Vec<Vec<Number>> = Vec::new();
    let mut named = None;
    for (k, (part, size)) in list.parts.iter().zip(sizes).enumerate() {
        let list = match &part.value {
            Value::List(list) => list,
            Value::Number(number) => {
                let found = in_the(text!("a number"), name);
                return Err(Problem::new(number.range().start, found, expected));
            }
            // External axes are often a constant: they stay as they are.
            Value::Other(range) if k + 1 == sizes.len() && range.len() == 1 => {
                named = Some(words.spelled(range.start));
                continue;
            }
            Value::Other(_) => return Ok(Err(computed(name))),
        };
        let count = list.parts.len();
        if count != *size {
            let found = in_the(counted(count), name);
            let expected = text!("{size}, as in {expected}", size, expected);
            return Err(Problem::new(list.at, found, expected));
        }
        if let Some(inner) = list.parts.iter().find_map(|part| part.value.list()) {
            let found = in_the(Sentence::verbatim("[…]"), name);
            return Err(Problem::new(inner.at, found, expected));
        }
        let Some(own) = list.numbers() else {
            return Ok(Err(computed(name)));
        };
        numbers.push(own);
    }
    let last = sizes.len() - 1;
    let outside = match &named {
        None => std::array::from_fn(|k| external(numbers[last][k])),
        Some(axes) => match walk.constant_of(axes) {
            // The model's own are read with the target.
            Some(Constant::External(_)) if walk.axes.own() < walk.axes.joints() => {
                return Ok(Err(computed(name)));
            }
            Some(Constant::External(known)) => **known,
            _ => {
                return Ok(Err(not_in_numbers(axes)));
            }
        },
    };
    let number = |slot| match slot {
        Slot::Own(k) => Ok(numbers[0][k]),
        Slot::External(k) => external_axis(numbers[last][k], name),
    };
    let mut target = if let [position, turn, configuration, ..] = &numbers[..] {
        let frame = frame_of([0, 1, 2].map(|k: usize| position[k]), turn.clone());
        check_length(&frame, name)?;
        let mut target = Target::new(name, list.at, Shape::Pose(Box::new(frame)));
        configure(walk.axes, configuration, &mut target)?;
        target.posture_mut().external = walk.axes.external(number)?;
        target
    } else {
        walk.axes.joint_target(name, list.at, number)?
    };
    target.outside = walk.outside(outside);
    Ok(Ok(target))
}

/// `[cf1, cf4, cf6, cfx]`
fn configure(axes: &Axes, numbers: &[Number], target: &mut Target) -> Result<(), Problem> {
    let whole = |number: &Number, name: &str| {
        #[allow(clippy::cast_possible_truncation, reason = "compared with itself")]
        let whole = number.value as i16;
        if f64::from(whole) == number.value && whole.abs() < 1000 {
            return Ok(whole);
        }
        let found = in_the(Sentence::verbatim(number.value.to_string()), name);
        let expected = text!("a whole number");
        Err(Problem::new(number.range().start, found, expected))
    };
    for (number, axis) in numbers.iter().zip([0, 3, 5]) {
        let quadrant = whole(number, &target.name)?;
        if let Some(joint) = axes.numbered(Slot::Own(axis)) {
            let statement = Statement::Quadrant { joint, quadrant };
            target.posture_mut().marked(statement, number.span());
        }
    }
    let cfx = whole(&numbers[3], &target.name)?;
    if (0..8).contains(&cfx) && axes.own() == 6 {
        let states = &mut target.posture_mut().configuration;
        states.extend(axes.numbered(Slot::Own(4)).map(|joint| {
            let negative = cfx & 1 != 0;
            Statement::WristNegative { joint, negative }
        }));
        states.push(Statement::ElbowTurned(cfx & 2 != 0));
        states.push(Statement::Behind(cfx & 4 != 0));
    }
    Ok(())
}

/// The value of an external axis that the model has.
fn external_axis(number: Number, name: &str) -> Result<Number, Problem> {
    if external(number).is_some() {
        return Ok(number);
    }
    let found = text!("{name} leaves an external axis out", name);
    let expected = text!("its value: the model has that axis");
    Err(Problem::new(number.range().start, found, expected))
}
