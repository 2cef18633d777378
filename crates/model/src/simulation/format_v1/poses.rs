//! The `poses` object: a sweep, a list, or random ones.

use super::values::{FLAG, WHOLE};
use crate::document::kinds::NUMBER;
use crate::document::object::{Cursor, Kind};
use crate::document::optional;
use crate::kinematics::{JointKind, Robot};
use crate::simulation::scenario::{Order, Poses, Stop, Sweep};
use crate::text::Text;

pub(super) fn poses(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Poses> {
    let keys = ["sweep", "list", "random"];
    let members = at.members()?;
    at.fields.unknown_keys(members, at.path, &keys);
    let given = keys
        .into_iter()
        .filter(|key| optional(members, key).is_some());
    let given: Vec<&str> = given.collect();
    let [key] = given[..] else {
        let found = match given.len() {
            0 => text!("no poses"),
            _ => Text::verbatim(given.join(" and ")),
        };
        return at.error(found, phrase!("one of sweep, list or random"));
    };
    at.under(members, key, phrase!(""), |at| match key {
        "sweep" => sweep(at, robot).map(Poses::Sweep),
        "list" => {
            at.expected = phrase!("an array of objects with q_deg").into();
            at.list_by(|at| stop(at, robot)).map(Poses::List)
        }
        _ => {
            at.expected = phrase!("an object with count").into();
            let count = at.object(0, |o, count| {
                o.required_as("count", phrase!("a number of poses"), count, &WHOLE);
            })?;
            usize::try_from(count).ok().map(Poses::Random)
        }
    })
}

fn sweep(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Sweep> {
    at.expected = phrase!("an object with joint, from_deg, to_deg and step_deg").into();
    let mut sweep = Sweep {
        joint: 0,
        from: 0.0,
        to: 0.0,
        step: 0.0,
        both_ways: false,
        repeats: 1,
        order: Order::Sweep,
    };
    let good = at.fill(&mut sweep, |o, own| {
        let (mut joint, mut repeats) = (1, 1);
        o.usual("joint", &mut joint, &WHOLE);
        let index = usize::try_from(joint).ok().and_then(|j| j.checked_sub(1));
        let found = index.and_then(|index| robot.joints.get(index));
        if found.is_none() {
            let expected = text!("a joint from 1 to {joints}", joints = robot.joints.len());
            o.error_in("joint", Text::verbatim(joint.to_string()), expected);
        }
        o.end_if_wrong();
        own.joint = index.unwrap_or_default();
        let kind = found.map_or(JointKind::Revolute, |found| found.kind);
        let values = [
            (["from_deg", "from_mm"], &mut own.from),
            (["to_deg", "to_mm"], &mut own.to),
            (["step_deg", "step_mm"], &mut own.step),
        ];
        for ([deg, mm], value) in values {
            o.know(deg);
            o.know(mm);
            let slides = kind == JointKind::Prismatic;
            let key = if slides && o.is_given(mm) { mm } else { deg };
            o.required(key, value, &NUMBER);
            *value = kind.to_base_units(*value);
        }
        o.usual("both_ways", &mut own.both_ways, &FLAG);
        o.usual("repeats", &mut repeats, &WHOLE);
        own.repeats = usize::try_from(repeats).unwrap_or(usize::MAX);
        o.usual("order", &mut own.order, &ORDER);
    });
    good.then_some(sweep)
}

const ORDER: Kind<Order> = Kind {
    expected: phrase!("\"sweep\" or \"random\""),
    read: |at| at.one_of(&[Order::Sweep, Order::Random], order),
    write: |own| order(*own).into(),
};

fn order(own: Order) -> &'static str {
    match own {
        Order::Sweep => "sweep",
        Order::Random => "random",
    }
}

fn stop(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Stop> {
    at.expected = phrase!("an object with q_deg, and dir where it is known").into();
    let members = at.members()?;
    at.fields.unknown_keys(members, at.path, &["q_deg", "dir"]);
    let joints = robot.joints.len();
    let expected = text!("an array of {joints} numbers, one for each joint", joints);
    let each = |at: &mut Cursor<'_, '_>| {
        let sound = |all: &&[f64]| all.len() == joints && all.iter().all(|v| v.is_finite());
        let all = at.column().filter(sound).or_else(|| at.wrong());
        all.map(<[f64]>::to_vec)
    };
    let dir = at.under_if(members, "dir", &expected, |at| {
        let dir = each(at)?;
        if dir.iter().all(|d| [-1.0, 0.0, 1.0].contains(d)) {
            return Some(dir);
        }
        at.expected = text!("1, -1 or 0 (unknown) for each joint");
        at.wrong()
    });
    let q = at.under(members, "q_deg", expected, each);
    let (q, dir) = (q?, dir?);
    let kinds = robot.joints.iter().map(|j| j.kind).zip(q);
    let q = kinds.map(|(kind, q)| kind.to_base_units(q)).collect();
    Some(Stop { q, dir })
}
