//! The `conditions` object: speeds, loads, temperature, time.

use super::values::FLAG;
use crate::document::Value;
use crate::document::kinds::{NUMBER, positive};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::kinematics::{JointKind, Robot};
use crate::simulation::scenario::{Circumstances, Temperature};
use crate::text::Template;

/// One number or several.
const VALUES: Kind<Vec<f64>> = Kind {
    expected: phrase!("a number, or an array of numbers"),
    read: |at| match &at.node.value {
        Value::Number(value) if value.is_finite() => Some(vec![*value]),
        Value::Numbers(values) if values.iter().all(|v| v.is_finite()) => Some(values.clone()),
        _ => at.wrong(),
    },
    write: |values| values.as_slice().into(),
};

pub(super) fn conditions(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Circumstances> {
    let slides = robot.joints.iter().all(|j| j.kind == JointKind::Prismatic);
    let kind = if slides {
        JointKind::Prismatic
    } else {
        JointKind::Revolute
    };
    let mut circumstances = Circumstances::default();
    let good = at.fill(&mut circumstances, |o, own| {
        o.usual("speed_deg_s", &mut own.speeds, &VALUES);
        o.usual("speed_mm_s", &mut own.speeds, &VALUES);
        own.speeds
            .iter_mut()
            .for_each(|v| *v = kind.to_base_units(*v));
        o.usual("load_kg", &mut own.loads_kg, &VALUES);
        o.optional("temperature_c", &mut own.temperature, &TEMPERATURE);
        let key = "joint_temperatures_c";
        if o.given(key) {
            let all = &mut own.joint_temperatures;
            let read = |at: &mut Cursor<'_, '_>| of_joints(at, robot);
            o.with(key, all, OF_JOINTS, read, |_| None);
        }
        o.usual("torques", &mut own.torques, &FLAG);
        let time = positive(phrase!("a time above 0 s"));
        o.optional("seconds_per_pose", &mut own.seconds_per_pose, &time);
    });
    good.then_some(circumstances)
}

const TEMPERATURE: Kind<Temperature> = Kind {
    expected: VALUES.expected,
    read: |at| match &at.node.value {
        Value::Object(_) => (WARM_UP.read)(at),
        _ => (VALUES.read)(at).map(Temperature::Values),
    },
    write: |own| match own {
        Temperature::Values(values) => (VALUES.write)(values),
        Temperature::WarmUp { .. } => (WARM_UP.write)(own),
    },
};

/// `{ from, to, time_constant_s }`.
const WARM_UP: Kind<Temperature> = Kind {
    expected: OF_JOINTS,
    read: |at| {
        let blank = Temperature::WarmUp {
            from_c: 0.0,
            to_c: 0.0,
            time_constant_s: 0.0,
        };
        at.object(blank, warm_up)
    },
    write: |own| written(own.clone(), warm_up),
};

fn warm_up(o: &mut Object<'_, '_>, own: &mut Temperature) {
    if let Temperature::WarmUp {
        from_c,
        to_c,
        time_constant_s,
    } = own
    {
        o.required("from", from_c, &NUMBER);
        o.required("to", to_c, &NUMBER);
        o.required("time_constant_s", time_constant_s, &NUMBER);
    }
}

const OF_JOINTS: Template =
    phrase!("an array with an object (from, to, time_constant_s) or null for each joint");

/// One warm-up or null for each joint, from the first on.
fn of_joints(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Vec<Option<Temperature>>> {
    match &at.node.value {
        Value::List(entries) if entries.len() <= robot.joints.len() => at.list_by(|at| {
            at.expected = OF_JOINTS.into();
            match at.node.value {
                Value::Null => Some(None),
                _ => (WARM_UP.read)(at).map(Some),
            }
        }),
        _ => at.wrong(),
    }
}
