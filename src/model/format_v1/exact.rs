//! The numbers that the program computes with, and whether they are those that people read.

use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use std::path::Path as FilePath;

use crate::effects::term::setting_quantity;
use crate::effects::{Setting, Term};
use crate::kinematics::{Range, Robot};
use crate::sessions::format_v1::robot;
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::sessions::validation;

/// Exact and readable numbers may differ by this part through conversion, not by more.
const AGREES: f64 = 1e-9;
pub(super) const DISAGREES: &str =
    "the value that the readable keys give: edit both, or remove the exact one";

/// Whether an exact number is the readable one up to conversion.
pub(super) fn agrees(exact: f64, readable: f64) -> bool {
    (exact - readable).abs() <= AGREES * readable.abs().max(1e-3)
}

/// The robot, with the exact numbers in place of the readable ones.
pub(super) fn robot_of(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    folder: Option<&FilePath>,
) -> Option<Robot> {
    let path = &Path::Root;
    let expected = "an object that describes the robot";
    let node = fields.required(members, at, path, "robot", expected)?;
    let mut robot = robot::read(fields, node, &path.key("robot"), folder)?;
    let place = fields.place(node.at, &path.key("robot"));
    validation::robot(&robot, &place, &mut fields.findings);
    if fields.has_errors() {
        return None;
    }
    let Some(exact) = optional(members, "robot_exact") else {
        return Some(robot);
    };
    let path = &path.key("robot_exact");
    let members = fields.object(
        exact,
        path,
        "an object with joints and tool_quaternion_wxyz",
    )?;
    let joints = fields.required(members, exact.at, path, "joints", "an array")?;
    let list = match &joints.value {
        Value::List(list) if list.len() == robot.joints.len() => list,
        _ => {
            let expected = format!("an array of {} objects", robot.joints.len());
            fields.mismatch(joints, &path.key("joints"), &expected);
            return None;
        }
    };
    for (index, (joint, node)) in robot.joints.iter_mut().zip(list).enumerate() {
        let joints = path.key("joints");
        let path = &joints.index(index);
        let members = fields.object(node, path, "an object with axis and limits_inner")?;
        let axis = fields.required_numbers::<3>(members, node.at, path, "axis", "3 numbers")?;
        let readable = joint.axis.direction.into_inner();
        if !axis.iter().zip(&readable).all(|(a, b)| agrees(*a, *b)) {
            fields.error(node.at, &path.key("axis"), format!("{axis:?}"), DISAGREES);
        }
        joint.axis.direction = Unit::new_unchecked(Vector3::from(axis));
        let limits = match optional(members, "limits_inner") {
            None => None,
            Some(node) => {
                Some(fields.numbers::<2>(node, &path.key("limits_inner"), "2 numbers")?)
            }
        };
        let same = match (limits, joint.limits) {
            (None, None) => true,
            (Some([from, to]), Some(l)) => agrees(from, l.from) && agrees(to, l.to) && from < to,
            _ => false,
        };
        if !same {
            let found = format!("{limits:?}");
            fields.error(node.at, &path.key("limits_inner"), found, DISAGREES);
        }
        joint.limits = limits.map(|[from, to]| Range { from, to });
    }
    let key = "tool_quaternion_wxyz";
    let exact_turn = fields.required_numbers::<4>(members, exact.at, path, key, "4 numbers")?;
    let readable = robot.base_from_tool.rotation.quaternion();
    let readable = [readable.w, readable.i, readable.j, readable.k];
    if !exact_turn
        .iter()
        .zip(&readable)
        .all(|(a, b)| agrees(*a, *b))
    {
        fields.error(
            exact.at,
            &path.key(key),
            format!("{exact_turn:?}"),
            DISAGREES,
        );
    }
    let [w, x, y, z] = exact_turn;
    robot.base_from_tool.rotation = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
    Some(robot)
}

/// An effect with its exact numbers in place of the readable ones.
pub(super) fn exact_term(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    mut term: Term,
) -> Option<Term> {
    let members = fields.object(node, path, "an object with setting and coefficients")?;
    let setting = fields.required_number(members, node.at, path, "setting")?;
    let about = term.effect.about();
    let shown = setting_quantity(about.setting);
    // A model from before the effect had a setting means the usual one.
    let before = matches!(about.setting, Setting::Listed(_)) && setting == 0.0;
    let setting = if before { term.setting } else { setting };
    if shown.is_some() && !agrees(setting, term.setting) {
        fields.error(
            node.at,
            &path.key("setting"),
            setting.to_string(),
            DISAGREES,
        );
        return None;
    }
    let key = "coefficients";
    let wanted = term.coefficients.len();
    let expected = format!("an array of {wanted} numbers");
    let list = fields.required(members, node.at, path, key, &expected)?;
    let coefficients = match &list.value {
        Value::Numbers(values)
            if values.len() == wanted && values.iter().all(|v| v.is_finite()) =>
        {
            values
        }
        _ => {
            fields.mismatch(list, &path.key(key), &expected);
            return None;
        }
    };
    let scale = term
        .coefficients
        .iter()
        .fold(0.0_f64, |m, v| m.max(v.abs()));
    let near =
        |(exact, readable): (&f64, &f64)| (exact - readable).abs() <= AGREES * scale.max(1e-9);
    if !coefficients.iter().zip(&term.coefficients).all(near) {
        fields.error(
            list.at,
            &path.key(key),
            format!("{coefficients:?}"),
            DISAGREES,
        );
        return None;
    }
    term.setting = setting;
    term.coefficients.clone_from(coefficients);
    Some(term)
}
