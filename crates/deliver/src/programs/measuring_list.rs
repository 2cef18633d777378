//! Poses to measure next, for people and for controllers: a CSV table with the column names of a session,
//! so that what comes back from the instrument can be appended to it column by column, or a program of
//! joint moves.
//!
//! Of the table only the columns that matter are there. A reflector that the session does not have stands with
//! its place in the tool frame; why a pose is worth measuring stands last.

use std::fmt::Write as _;

use crate::kinematics::Robot;

use super::{Stop, stops};
use crate::design::approach;
use crate::diagnosis::NextPose;
use crate::refusal::Refusal;
use crate::tables::as_cell;

/// The poses as a program of joint moves in `language` (`rapid`, `krl`, `urscript`): each is approached
/// from its side over a stretch of its own, and the robot waits there. What changes by hand (load, target,
/// temperature) stands in the comments, and so does what is measured in motion.
///
/// # Errors
/// A language in which no such programs are written, or that the robot's joints do not fit.
pub fn measuring_program(
    poses: &[NextPose],
    robot: &Robot,
    language: &str,
) -> Result<String, Refusal> {
    let stop = |pose: &NextPose| {
        let mut from = pose.q.clone();
        for ((from, dir), joint) in from.iter_mut().zip(&pose.dir).zip(&robot.joints) {
            *from -= dir * approach(joint, joint.limits);
            if let Some(limits) = joint.limits {
                *from = from.clamp(limits.from, limits.to);
            }
        }
        Stop {
            from: (from != pose.q).then_some(from),
            q: pose.q.clone(),
            comment: circumstances(pose, robot),
        }
    };
    let all: Vec<Stop> = poses.iter().map(stop).collect();
    let title = format!(
        "{}: {} poses to measure, by truepose",
        robot.name,
        poses.len()
    );
    stops(language, robot, &title, &all)
}

/// What has to be seen to before a pose.
fn circumstances(pose: &NextPose, robot: &Robot) -> String {
    let mut says: Vec<String> = Vec::new();
    says.extend(
        pose.target
            .as_ref()
            .map(|target| format!("target {target}")),
    );
    says.extend(pose.load_kg.map(|load| format!("load {load} kg")));
    says.extend(
        pose.temperature_c
            .map(|at| format!("at about {at:.0} degrees C")),
    );
    let speeds = pose.speed.iter().flatten().zip(&robot.joints).enumerate();
    says.extend(
        speeds
            .filter(|(_, (speed, _))| **speed != 0.0)
            .map(|(j, (speed, joint))| {
                let unit = joint.kind.unit();
                format!(
                    "in motion, joint {} at {:.1} {unit}/s",
                    j + 1,
                    joint.kind.to_display(*speed)
                )
            }),
    );
    says.join(", ")
}

type Cell<'a> = Box<dyn Fn(&NextPose) -> String + 'a>;

/// The table, with a heading line.
pub fn measuring_list(poses: &[NextPose], robot: &Robot) -> String {
    let mut columns: Vec<(String, Cell)> = Vec::new();
    for (j, joint) in robot.joints.iter().enumerate() {
        let (unit, kind) = (joint.kind.unit(), joint.kind);
        let outer = move |v: f64| number(kind.to_display(v));
        columns.push((
            format!("q{}_{unit}", j + 1),
            Box::new(move |p| p.q.get(j).map_or_else(String::new, |q| outer(*q))),
        ));
        if poses
            .iter()
            .any(|p| p.dir.get(j).is_some_and(|d| *d != 0.0))
        {
            columns.push((
                format!("dir{}", j + 1),
                Box::new(move |p| p.dir.get(j).map_or_else(String::new, |d| number(*d))),
            ));
        }
        if poses.iter().any(|p| p.speed.is_some()) {
            let speed = move |p: &NextPose| p.speed.as_ref().and_then(|s| s.get(j).copied());
            columns.push((
                format!("speed{}_{unit}_s", j + 1),
                Box::new(move |p| speed(p).map_or_else(String::new, outer)),
            ));
        }
    }
    let mut optional = |name: &str, value: fn(&NextPose) -> Option<String>| {
        if poses.iter().any(|p| value(p).is_some()) {
            let cell: Cell = Box::new(move |p| value(p).unwrap_or_default());
            columns.push((name.to_owned(), cell));
        }
    };
    optional("target", |p| {
        p.target.as_deref().map(|name| as_cell(name).into_owned())
    });
    optional("load_kg", |p| p.load_kg.map(number));
    optional("temperature_c", |p| p.temperature_c.map(number));
    optional("target_x_mm", |p| p.target_mm.map(|t| number(t[0])));
    optional("target_y_mm", |p| p.target_mm.map(|t| number(t[1])));
    optional("target_z_mm", |p| p.target_mm.map(|t| number(t[2])));
    optional("why", |p| Some(as_cell(&p.why.to_string()).into_owned()));
    let headings: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = headings.join(",");
    text.push('\n');
    for pose in poses {
        let cells: Vec<String> = columns.iter().map(|(_, cell)| cell(pose)).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

/// Without the last digits that a conversion of units leaves.
fn number(value: f64) -> String {
    let rounded = (value * 1e9).round() / 1e9;
    format!("{}", rounded + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(q_deg: f64, target: Option<&str>) -> NextPose {
        NextPose {
            q: vec![q_deg.to_radians()],
            dir: vec![-1.0],
            target: target.map(str::to_owned),
            target_mm: None,
            speed: None,
            load_kg: None,
            temperature_c: None,
            why: crate::text::Text::verbatim("separates a, b"),
        }
    }

    #[test]
    fn it_has_the_columns_of_a_session_and_only_those_that_matter() {
        let session = concat!(env!("CARGO_MANIFEST_DIR"), "/../../sessions/paper-30.json");
        let robot = crate::sessions::load(session)
            .expect("bundled")
            .session
            .robot;
        let text = measuring_list(&[pose(45.0, Some("T2")), pose(-30.0, None)], &robot);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "q1_deg,dir1,target,why");
        assert_eq!(lines[1], "45,-1,T2,\"separates a, b\"");
        assert_eq!(lines[2], "-30,-1,,\"separates a, b\"");
    }
}
