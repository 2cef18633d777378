//! Reflectors: those of a session or of a first measurement, and where another one helps. It may be on a bar of
//! at most [`REACH_MM`].

use nalgebra::{Point3, Vector3};

use crate::effects::JointFrame;
use crate::kinematics::{Joint, JointKind, Robot};
use crate::sessions::Target;

/// How far from the first reflector a second one can be held, mm: a light bar on the flange.
pub(crate) const REACH_MM: f64 = 300.0;

/// Places for a second reflector within reach of the first, the likeliest to help first: further
/// out and higher, across the first axis, and in towards it. None where there are two already, or nothing turns.
pub(crate) fn other_reflectors(robot: &Robot, targets: &[Target]) -> Vec<Target> {
    let turns = |j: &Joint| j.kind == JointKind::Revolute;
    let first = robot.joints.iter().position(turns);
    let Some(first) = first.filter(|_| targets.len() < 2) else {
        return Vec::new();
    };
    let frame = JointFrame::new(robot, first);
    let [outward, _] = frame.plane_of_motion();
    let (outward, along) = (Vector3::from(outward), Vector3::from(frame.along));
    let across = along.cross(&outward);
    let shifts = [
        outward * 0.9 + along * 0.4,
        outward * 0.3 + across * 0.85 + along * 0.4,
        outward * -0.9 + along * 0.4,
    ];
    let first = targets
        .first()
        .map_or_else(Vector3::zeros, |t| t.position_mm.coords);
    let mut name = format!("T{}", targets.len() + 1);
    while targets.iter().any(|t| t.name == name) {
        name.push('n');
    }
    let at = |shift: Vector3<f64>| {
        let in_tool = robot.base_from_tool.rotation.inverse() * (shift * REACH_MM);
        Target {
            name: name.clone(),
            position_mm: (first + in_tool).map(|v| (v / 5.0).round() * 5.0).into(),
        }
    };
    shifts.into_iter().map(at).collect()
}

/// The reflectors of a first measurement: the tool's origin and one more, where something turns.
pub(crate) fn reflectors(robot: &Robot) -> Vec<Target> {
    let mut targets = vec![Target {
        name: "T1".to_owned(),
        position_mm: Point3::origin(),
    }];
    targets.extend(other_reflectors(robot, &targets).into_iter().next());
    targets
}
