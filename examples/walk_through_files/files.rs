//! The files of the walk through a calibration, as an instrument and a controller would have
//! written them.
//!
//! The scenario beside them says what is hidden. `truepose simulate` plays it; here the tracker is
//! put somewhere in the hall, its coordinates are written in its own frame, in the layout of a
//! `SpatialAnalyzer` text export (`group, point, x, y, z`, no header, no unit), and the commands,
//! the reflectors and the surveyed points of the base go into files of their own.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion};
use truepose::diagnostic::Rejected;
use truepose::sessions::Session;
use truepose::simulation::{load_scenario, simulate, unwatched};

/// Points of the base plate, surveyed: name, base frame in mm, and how far off the instrument
/// measured each, in µm, first at the start and then at the end of the day. Somebody kicked the
/// nest of B4 between the survey and the first measurement.
const BASE: [Nest; 6] = [
    nest("B1", [450.0, 420.0, 0.0], [[4., -3., 5.], [-2., 4., -3.]]),
    nest("B2", [-430.0, 440.0, 3.0], [[-5., 2., -4.], [3., -1., 4.]]),
    nest("B3", [-460.0, -410.0, 0.0], [[2., 5., 3.], [-4., -3., -2.]]),
    nest(
        "B4",
        [440.0, -450.0, 5.0],
        [[812., -395., 6.], [809., -398., 2.]],
    ),
    nest("B5", [60.0, 520.0, 610.0], [[-3., -4., 2.], [5., 2., -5.]]),
    nest("B6", [-520.0, 30.0, 620.0], [[3., 1., -4.], [-2., -3., 3.]]),
];

/// A surveyed point.
struct Nest {
    name: &'static str,
    at_mm: [f64; 3],
    /// Measured less surveyed, at the start and at the end of the day.
    off_um: [[f64; 3]; 2],
}

const fn nest(name: &'static str, at_mm: [f64; 3], off_um: [[f64; 3]; 2]) -> Nest {
    Nest {
        name,
        at_mm,
        off_um,
    }
}

/// What the files are called, and what is in them.
pub struct Files {
    /// `(name, text)`.
    pub list: Vec<(&'static str, String)>,
}

/// Where the tracker stands.
pub fn base_from_tracker() -> Isometry3<f64> {
    Isometry3::from_parts(
        Translation3::new(1840.0, -1325.0, 412.0),
        UnitQuaternion::from_euler_angles(0.004, -0.007, 2.51),
    )
}

/// Makes them from the scenario in this folder.
///
/// # Errors
/// The scenario cannot be read.
pub fn from_scenario(folder: &Path) -> Result<Files, Rejected> {
    let scenario = load_scenario(folder.join("column.scenario.json"))?.scenario;
    let (session, _) = match simulate(&scenario, scenario.seed, unwatched) {
        Ok(made) => made,
        Err(error) => panic!("the scenario plays: {error}"),
    };
    let (commands, reflectors) = (commands(&session), reflectors(&session));
    Ok(Files {
        list: vec![
            ("tracker.txt", tracker(&session)),
            ("hurry-commands.csv", only(&commands, ",T1,0,")),
            ("one-reflector.csv", only(&reflectors, "T1,")),
            ("commands.csv", commands),
            ("reflectors.csv", reflectors),
            ("base-points.csv", base_points()),
            ("robot.json", ROBOT.to_owned()),
        ],
    })
}

/// The nominal robot, as its maker draws it.
const ROBOT: &str = r#"{
  "name": "inspection column",
  "joints": [
    { "name": "column", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0], "limits": [-160, 160], "mass_kg": 6, "centre_mm": [180, 0, 240] }
  ],
  "tool": { "position_mm": [400, 0, 260], "quaternion_wxyz": [1, 0, 0, 0] },
  "gravity_m_s2": [0, 0, -9.81]
}
"#;

fn target_name(session: &Session, row: usize) -> &str {
    let index = session.samples.target.as_ref().map_or(0, |t| t[row]);
    &session.targets[index as usize].name
}

/// The name of a measured point: its stop and its reflector.
fn point_name(session: &Session, row: usize) -> String {
    let stop = row / session.targets.len() + 1;
    format!("S{stop:03}-{}", target_name(session, row))
}

fn tracker(session: &Session) -> String {
    let tracker_from_base = base_from_tracker().inverse();
    let mut text = String::from(
        "// SpatialAnalyzer ASCII points\n// Job: inspection column, hall 4\n// Instrument::0, frame of the instrument\n",
    );
    let mut line = |group: &str, name: &str, in_base: Point3<f64>| {
        let p = tracker_from_base * in_base;
        let _ = writeln!(text, "{group},{name},{:.4},{:.4},{:.4}", p.x, p.y, p.z);
    };
    let base = |when: usize, line: &mut dyn FnMut(&str, &str, Point3<f64>)| {
        for Nest {
            name,
            at_mm: at,
            off_um,
        } in BASE
        {
            let off = off_um[when];
            let place = Point3::new(
                at[0] + off[0] / 1000.0,
                at[1] + off[1] / 1000.0,
                at[2] + off[2] / 1000.0,
            );
            line("Base", name, place);
        }
    };
    base(0, &mut line);
    let samples = &session.samples;
    let z = samples.z_mm.as_ref();
    for row in 0..samples.len() {
        let in_base = Point3::new(
            samples.x_mm[row],
            samples.y_mm[row],
            z.map_or(0.0, |z| z[row]),
        );
        line("Arm", &point_name(session, row), in_base);
        // Between two stops somebody tried the reflector in his hand.
        if row == 40 {
            line("Arm", "try", Point3::new(910.0, 300.0, 1120.0));
        }
    }
    base(1, &mut line);
    text
}

fn commands(session: &Session) -> String {
    let samples = &session.samples;
    let mut text = String::from("name,q1_deg,dir1,target,load_kg,time_s\n");
    for row in 0..samples.len() {
        let dir = samples.dir[0].as_ref().map_or(0.0, |dir| dir[row]);
        let load = samples.load_kg.as_ref().map_or(0.0, |load| load[row]);
        let time = samples.time_s.as_ref().map_or(0.0, |time| time[row]);
        let degrees = (samples.q[0][row].to_degrees() * 1e6).round() / 1e6;
        let _ = writeln!(
            text,
            "{},{degrees},{dir},{},{load},{time}",
            point_name(session, row),
            target_name(session, row),
        );
    }
    text
}

fn reflectors(session: &Session) -> String {
    let mut text = String::from("name,x_mm,y_mm,z_mm\n");
    for target in &session.targets {
        let p = target.position_mm;
        let _ = writeln!(text, "{},{},{},{}", target.name, p.x, p.y, p.z);
    }
    text
}

/// The heading and the rows with these words: what somebody in a hurry measures.
fn only(table: &str, words: &str) -> String {
    let lines = table.lines().enumerate();
    let kept = lines.filter(|(k, line)| *k == 0 || line.contains(words));
    let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
    kept.join("\n") + "\n"
}

fn base_points() -> String {
    let mut text = String::from("name,x_mm,y_mm,z_mm\n");
    for Nest {
        name, at_mm: at, ..
    } in BASE
    {
        let _ = writeln!(text, "{name},{},{},{}", at[0], at[1], at[2]);
    }
    text
}
