//! Poses to measure next, as terminal, window and report list them.

use super::numbers::trimmed;
use super::table::{Column, Table};
use crate::diagnosis::NextPose;
use crate::kinematics::Robot;
use crate::text::{by_titles, current};

fn headed() -> Table {
    Table::headed(say!("pose | from | reflector | conditions | why"))
}

/// The poses in order: joint values, the side from which each joint comes (+ from below, − from above),
/// the reflector, what else is to be seen to, and why.
pub fn table(poses: &[NextPose], robot: &Robot) -> Table {
    let mut table = headed();
    for k in 0..poses.len() {
        let pose = values_of(&poses[k].q, robot, "").join(" ");
        let rest = [sides(&poses[k].dir)]
            .into_iter()
            .chain(after_sides(poses, k, robot));
        table.row([pose].into_iter().chain(rest));
    }
    table
}

/// The same with a column for each joint, its value with its side, and without columns that would be empty: for
/// places where letters are equally wide.
pub(crate) fn table_by_joint(poses: &[NextPose], robot: &Robot) -> Table {
    let joints = (1..=robot.joints.len()).map(|joint| say!("joint {joint}", joint));
    let columns = [Column::numbers("")].into_iter();
    let columns = columns.chain(joints.map(Column::numbers));
    let columns = columns.chain(headed().columns.split_off(2));
    let mut table = Table::of(columns);
    for (k, pose) in poses.iter().enumerate() {
        let values = values_of(&pose.q, robot, "").into_iter().zip(&pose.dir);
        let values = values.map(|(value, dir)| format!("{value} {}", side(*dir)));
        let values = [(k + 1).to_string()].into_iter().chain(values);
        table.row(values.chain(after_sides(poses, k, robot)));
    }
    let first = 1 + robot.joints.len();
    for column in (first..first + 2).rev() {
        if table.rows.iter().all(|row| row[column].shown.is_empty()) {
            table.columns.remove(column);
            for row in &mut table.rows {
                row.remove(column);
            }
        }
    }
    table
}

/// Values of all joints with their units.
fn values_of(values: &[f64], robot: &Robot, per: &str) -> Vec<String> {
    let each = values.iter().zip(&robot.joints).map(|(value, joint)| {
        let value = trimmed(joint.kind.to_display(*value), 2);
        format!("{value}{}{per}", joint.kind.sign())
    });
    each.collect()
}

/// Reflector, conditions and reason of a pose.
fn after_sides(poses: &[NextPose], k: usize, robot: &Robot) -> [String; 3] {
    let pose = &poses[k];
    let mut conditions = match pose.speed.as_deref() {
        None => Vec::new(),
        Some(still) if still.iter().all(|speed| *speed == 0.0) => vec![say!("at rest").to_owned()],
        Some(speeds) => values_of(speeds, robot, "/s"),
    };
    let load = pose.load_kg.map(|kg| format!("{} kg", trimmed(kg, 2)));
    let temperature = pose.temperature_c.map(|t| format!("{} °C", trimmed(t, 1)));
    let again = poses[..k].iter().any(|earlier| pose.repeats(earlier));
    let again = again.then(|| say!("second time").to_owned());
    conditions.extend(load.into_iter().chain(temperature).chain(again));
    [
        pose.target.clone().unwrap_or_default(),
        conditions.join(", "),
        pose.why.spoken_with(current(), by_titles()),
    ]
}

/// From which side each joint comes: + from below, − from above.
pub(crate) fn sides(dir: &[f64]) -> String {
    let sides = dir.iter().map(|dir| side(*dir));
    sides.collect::<Vec<_>>().join(" ")
}

fn side(dir: f64) -> &'static str {
    match dir {
        d if d > 0.0 => "+",
        d if d < 0.0 => "−",
        _ => say!("any"),
    }
}

/// Where each reflector is to be mounted that the session does not have.
pub fn new_reflectors(poses: &[NextPose]) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in poses {
        let (Some(name), Some(at)) = (&pose.target, pose.target_mm) else {
            continue;
        };
        let [x, y, z] = at.map(|mm| trimmed(mm, 2));
        let line = say!(
            "{name} is a new reflector: mount it at {place} in the tool frame, and survey where it really is",
            name,
            place = format!("({x}, {y}, {z}) mm")
        );
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}
