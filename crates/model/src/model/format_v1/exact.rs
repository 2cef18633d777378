//! The numbers that the program computes with, and whether they are those that people read.

use nalgebra::{Quaternion, Unit, UnitQuaternion};

use crate::document::kinds::{NUMBER, components, wxyz};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::effects::term::setting_quantity;
use crate::effects::{Setting, Term};
use crate::kinematics::{Joint, Range, Robot};
use crate::rounding;
use crate::sessions::files::format_v1::robot::ROBOT;
use crate::sessions::validation;
use crate::text::{Template, Text};

pub(super) const DISAGREES: Template =
    phrase!("the value that the readable keys give: edit both, or remove the exact one");

/// Whether an exact number is the readable one up to conversion.
pub(super) fn agrees(exact: f64, readable: f64) -> bool {
    (exact - readable).abs() <= rounding::COMPUTED * readable.abs().max(1e-3)
}

/// The exact number in place of the readable one.
pub(super) fn exact(o: &mut Object<'_, '_>, key: &'static str, own: &mut f64) {
    let readable = *own;
    o.required(key, own, &NUMBER);
    if o.is_read() && !agrees(*own, readable) {
        o.error_in(key, Text::verbatim(own.to_string()), DISAGREES);
    }
}

/// Exact numbers in place of readable ones.
fn exact_each<const N: usize>(at: &mut Cursor<'_, '_>, readable: [f64; N]) -> Option<[f64; N]> {
    let exact = at.numbers::<N>()?;
    if exact.iter().zip(&readable).all(|(a, b)| agrees(*a, *b)) {
        return Some(exact);
    }
    at.error(text!("{exact}", exact = format!("{exact:?}")), DISAGREES)
}

/// A robot that a model can be of.
pub(super) fn robot_of(at: &mut Cursor<'_, '_>) -> Option<Robot> {
    let robot = ROBOT.read(at.fields, at.node, at.path)?;
    let place = at.fields.place(at.node.at, at.path);
    validation::robot(&robot, &place, &mut at.fields.findings);
    (!at.fields.has_errors()).then_some(robot)
}

/// What of a robot the session's form may round or normalise.
pub(super) fn exact_robot(o: &mut Object<'_, '_>, robot: &mut Robot) {
    if o.needs("joints", phrase!("an array")) {
        let expected = text!("an array of {joints} objects", joints = robot.joints.len());
        let own = robot.joints.clone();
        let element = text!("an object with axis and limits_inner");
        let read =
            |at: &mut Cursor<'_, '_>| at.each(own, element, |own, at| at.fill(own, exact_joint));
        let write = |all: &Vec<Joint>| {
            let one = |own: &Joint| written(own.clone(), exact_joint);
            Some(all.iter().map(one).collect())
        };
        o.with("joints", &mut robot.joints, expected, read, write);
    }
    let key = "tool_quaternion_wxyz";
    if o.needs(key, phrase!("4 numbers")) {
        let turn = &mut robot.base_from_tool.rotation;
        let readable = [turn.w, turn.i, turn.j, turn.k];
        let read = |at: &mut Cursor<'_, '_>| {
            let [w, x, y, z] = exact_each(at, readable)?;
            Some(UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)))
        };
        o.with(key, turn, phrase!("4 numbers"), read, |turn| {
            Some(wxyz(turn))
        });
    }
}

fn exact_joint(o: &mut Object<'_, '_>, own: &mut Joint) {
    if o.needs("axis", phrase!("3 numbers")) {
        let direction = &mut own.axis.direction;
        let readable = direction.into_inner().into();
        let read = |at: &mut Cursor<'_, '_>| {
            let exact = exact_each(at, readable)?;
            Some(Unit::new_unchecked(exact.into()))
        };
        o.with("axis", direction, phrase!("3 numbers"), read, |d| {
            Some(components(d))
        });
    }
    let readable = own.limits.map(|limits| [limits.from, limits.to]);
    let mut limits = readable.filter(|_| !o.is_read());
    o.usual_or_null("limits_inner", &mut limits, &TWO);
    let same = match (limits, readable) {
        (None, None) => true,
        (Some([from, to]), Some([a, b])) => agrees(from, a) && agrees(to, b) && from < to,
        _ => false,
    };
    if o.has_read_well() && !same {
        let found = text!("{limits}", limits = format!("{limits:?}"));
        o.error_in("limits_inner", found, DISAGREES);
    }
    own.limits = limits.map(|[from, to]| Range { from, to });
}

const TWO: Kind<[f64; 2]> = Kind {
    expected: phrase!("2 numbers"),
    read: |at| at.numbers(),
    write: |two| (*two).into(),
};

/// Larger than any parameter, in whatever unit: a sum of squares stays finite, and the exact coefficients of a model
/// that is written can be read.
pub(super) const LARGEST: f64 = 1.0 / f64::EPSILON;

/// The exact numbers of an effect in place of the readable ones.
pub(super) fn exact_term(o: &mut Object<'_, '_>, term: &mut Term) {
    let (setting, readable) = (term.effect.about().setting, term.setting);
    o.required("setting", &mut term.setting, &NUMBER);
    // A model from before the effect had a setting means the usual one.
    if matches!(setting, Setting::Listed(_)) && term.setting == 0.0 {
        term.setting = readable;
    }
    if setting_quantity(setting).is_some() && !agrees(term.setting, readable) {
        let found = Text::verbatim(term.setting.to_string());
        o.error_in("setting", found, DISAGREES);
    }
    let readable = term.coefficients.clone();
    let expected = text!("an array of {readable} numbers", readable = readable.len());
    let read = |at: &mut Cursor<'_, '_>| {
        let sound = |v: &f64| v.abs() <= LARGEST;
        let exact = at
            .column()
            .filter(|all| all.len() == readable.len() && all.iter().all(sound));
        let exact = exact.or_else(|| at.wrong())?;
        let scale = readable.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let near = |(a, b): (&f64, &f64)| {
            (a - b).abs() <= rounding::COMPUTED * scale.max(rounding::COMPUTED)
        };
        if exact.iter().zip(&readable).all(near) {
            return Some(exact.to_vec());
        }
        at.error(text!("{exact}", exact = format!("{exact:?}")), DISAGREES)
    };
    let write = |all: &Vec<f64>| Some(all.as_slice().into());
    if o.needs("coefficients", &expected) {
        let own = &mut term.coefficients;
        o.with("coefficients", own, expected, read, write);
    }
}
