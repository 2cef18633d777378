//! Poses to measure next, as terminal, window and report list them.

use super::numbers::trimmed;
use super::table::{Column, Table};
use crate::diagnosis::NextPose;
use crate::kinematics::Robot;
use crate::text::current;

/// The poses in order: joint values, the side from which each joint comes (+ from below, − from above),
/// the reflector, what else is to be seen to, and why.
pub(crate) fn table(poses: &[NextPose], robot: &Robot) -> Table {
    let mut table = Table::of([
        Column::words(say!("pose")),
        Column::words(say!(in "table", "from")),
        Column::words(say!("reflector")),
        Column::words(say!("conditions")),
        Column::words(say!("why")),
    ]);
    let values = |values: &[f64], per: &str| {
        let each = values.iter().zip(&robot.joints).map(|(value, joint)| {
            let value = trimmed(joint.kind.outer(*value), 2);
            format!("{value}{}{per}", joint.kind.sign())
        });
        each.collect::<Vec<_>>()
    };
    for (k, pose) in poses.iter().enumerate() {
        let mut conditions = pose
            .speed
            .as_deref()
            .map_or_else(Vec::new, |v| values(v, "/s"));
        let load = pose.load_kg.map(|kg| format!("{} kg", trimmed(kg, 2)));
        let temperature = pose.temperature_c.map(|t| format!("{} °C", trimmed(t, 1)));
        let again = poses[..k].iter().any(|earlier| pose.repeats(earlier));
        let again = again.then(|| say!("second time").to_owned());
        conditions.extend(load.into_iter().chain(temperature).chain(again));
        table.row([
            values(&pose.q, "").join(" "),
            sides(&pose.dir),
            pose.target.clone().unwrap_or_default(),
            conditions.join(", "),
            pose.why.spoken_in(current()),
        ]);
    }
    table
}

/// From which side each joint comes: + from below, − from above.
pub(crate) fn sides(dir: &[f64]) -> String {
    let side = |dir: &f64| match *dir {
        d if d > 0.0 => "+",
        d if d < 0.0 => "−",
        _ => say!(in "side", "any"),
    };
    dir.iter().map(side).collect::<Vec<_>>().join(" ")
}

/// Where each reflector is to be mounted that the session does not have.
pub(crate) fn new_reflectors(poses: &[NextPose]) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in poses {
        let (Some(name), Some(at)) = (&pose.target, pose.target_mm) else {
            continue;
        };
        let [x, y, z] = at.map(|mm| trimmed(mm, 2));
        let line = say!(
            "{name} is a new reflector: mount it at {place} in the tool frame, and survey where it really is",
            name = name,
            place = format!("({x}, {y}, {z}) mm")
        );
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}
