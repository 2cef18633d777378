//! The files of the walk for an arm, as a tracker and a controller would have written them: the same
//! samples as `sessions/arm/arm.json` holds, measured in the tracker's own frame.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::Point3;
use truepose::diagnostic::Rejected;
use truepose::sessions::{Session, load};

use super::files::base_from_tracker;

/// `(name, text)` of each file, from the session in this folder.
///
/// # Errors
/// The session cannot be read.
pub fn from_session(folder: &Path) -> Result<Vec<(&'static str, String)>, Rejected> {
    let session = load(folder.join("arm.json"))?.session;
    let text = std::fs::read_to_string(folder.join("arm.json")).unwrap_or_default();
    Ok(vec![
        ("tracker.csv", tracker(&session)),
        ("commands.csv", commands(&session)),
        ("robot.json", robot(&text)),
    ])
}

/// As a German workplace exports it: semicolons, decimal commas, the unit in the heading.
fn tracker(session: &Session) -> String {
    let tracker_from_base = base_from_tracker().inverse();
    let samples = &session.samples;
    let z = samples.z_mm.as_ref();
    let mut text = String::from("Punkt;Aufstellung;X [mm];Y [mm];Z [mm]\n");
    for row in 0..samples.len() {
        let z = z.map_or(0.0, |z| z[row]);
        let p = tracker_from_base * Point3::new(samples.x_mm[row], samples.y_mm[row], z);
        let line = format!("P{:03};Halle 4;{:.4};{:.4};{:.4}", row + 1, p.x, p.y, p.z);
        let _ = writeln!(text, "{}", line.replace('.', ","));
    }
    text
}

fn commands(session: &Session) -> String {
    let samples = &session.samples;
    let joints = samples.q.len();
    let mut text = String::from("name");
    for (what, unit) in [("q", "_deg"), ("dir", "")] {
        for joint in 1..=joints {
            let _ = write!(text, ",{what}{joint}{unit}");
        }
    }
    text.push('\n');
    for row in 0..samples.len() {
        let _ = write!(text, "P{:03}", row + 1);
        for q in &samples.q {
            let _ = write!(text, ",{}", (q[row].to_degrees() * 1e6).round() / 1e6);
        }
        for dir in &samples.dir {
            let _ = write!(text, ",{}", dir.as_ref().map_or(0.0, |dir| dir[row]));
        }
        text.push('\n');
    }
    text
}

/// The robot of the session's document, as it stands there.
fn robot(document: &str) -> String {
    let document: serde_json::Value = serde_json::from_str(document).unwrap_or_default();
    let robot = serde_json::to_string_pretty(&document["robot"]);
    robot.unwrap_or_default() + "\n"
}
