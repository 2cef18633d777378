//! Looking at a file and importing it tell how far they are, and can be cancelled wherever they do.

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::{Companion, Reading, Settings, import, import_watched};
use super::{IMPORTERS, inspect, inspect_watched};
use crate::kinematics::{Axis, Joint, JointKind, Robot, pose_from_parts};
use crate::progress::ReadError;
use crate::watching::{assert_grows, no_at, report_to};

/// Rows enough for several looks at the watcher.
const ROWS: u32 = 12_000;

fn robot() -> Robot {
    Robot {
        name: "axis".to_owned(),
        joints: vec![Joint {
            name: "pan".to_owned(),
            kind: JointKind::Revolute,
            axis: Axis::through(Vector3::z(), Point3::origin()).unwrap(),
            limits: None,
            link: None,
            follows: None,
            gear_ratio: None,
        }],
        base_from_tool: pose_from_parts([250.0, 0.0, 300.0], [1.0, 0.0, 0.0, 0.0]).unwrap(),
        gravity_m_s2: None,
        source: crate::kinematics::RobotSource::Axes,
    }
}

fn table(heading: &str, columns: &[f64]) -> String {
    let mut text = format!("{heading}\n");
    for row in 0..ROWS {
        let cells: Vec<String> = columns
            .iter()
            .map(|c| format!("{:.6}", c + f64::from(row % 997) * 0.01))
            .collect();
        writeln!(text, "{}", cells.join(",")).unwrap();
    }
    text
}

#[test]
fn a_file_is_looked_at_with_or_without_its_kind() {
    let text = table("q1_deg,x_mm,y_mm,z_mm", &[1.0, 250.0, 0.5, 300.0]);
    let text_formats = IMPORTERS
        .iter()
        .copied()
        .filter(|importer| importer.asks.table);
    for kind in text_formats.map(Some).chain([None]) {
        let reading = Reading {
            kind,
            ..Reading::default()
        };
        let look = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
            inspect_watched(text.as_bytes(), &reading, watch)
        };
        let (shares, found) = report_to(look);
        assert_grows(&shares);
        assert_eq!(found.unwrap(), inspect(text.as_bytes(), &reading));
        for number in 0..shares.len() {
            assert!(look(&no_at(number)).is_err(), "{kind:?} {number}");
        }
    }
}

#[test]
fn an_import_that_is_cancelled_is_no_import_that_is_refused() {
    let measured = table("x_mm,y_mm,z_mm", &[250.0, 0.5, 300.0]);
    let commands = table("q1_deg", &[1.0]);
    let robot = robot();
    let settings = Settings {
        commands: Some(Companion {
            bytes: commands.as_bytes(),
            file: None,
        }),
        ..Settings::new(Reading::default(), &robot)
    };
    let (shares, imported) = report_to(|w| import_watched(measured.as_bytes(), &settings, w));
    assert_grows(&shares);
    assert!(shares.len() > 10, "{shares:?}");
    let unwatched = import(measured.as_bytes(), &settings).unwrap();
    assert_eq!(imported.unwrap().session, unwatched.session);
    for number in 0..shares.len() {
        let cut = import_watched(measured.as_bytes(), &settings, no_at(number));
        assert!(matches!(cut, Err(ReadError::Cancelled(_))), "{number}");
    }
}

#[test]
fn what_is_wrong_is_refused_with_or_without_somebody_who_watches() {
    let text = table("a,b,c", &[1.0, 250.0, 0.5]);
    let robot = robot();
    let settings = Settings::new(Reading::default(), &robot);
    let (_, watched) = report_to(|w| import_watched(text.as_bytes(), &settings, w));
    let Err(ReadError::Rejected(watched)) = watched else {
        panic!("{watched:?}");
    };
    let unwatched = import(text.as_bytes(), &settings).unwrap_err();
    assert_eq!(watched.to_string(), unwatched.to_string());
}
