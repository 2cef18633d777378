//! Files as instruments write them, imported by the program and by the library. The files in
//! `tests/data/imports` are made by `make.py` there, from a robot whose zero is off by −0.35° and
//! whose arm is 248.6 mm long instead of 250.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};
use std::process::Output;

use proptest::prelude::*;
use serde_json::Value;
use truepose::importers::{
    About, Companion, Decimal, Imported, LengthUnit, Matching, Reading, Settings, find, import,
    inspect,
};
use truepose::kinematics::Robot;
use truepose::sessions::{Session, load, load_robot, parse, parse_robot, write_inline};

const OFFSET_DEG: f64 = -0.35;
const RADIUS_MM: f64 = 248.6;

fn data(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/imports");
    folder.join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(data(name)).expect("the file is in the repository")
}

fn robot() -> Robot {
    load_robot(data("robot.json")).expect("a sound robot").robot
}

fn reading(kind: &str) -> Reading {
    Reading {
        kind: find(kind),
        file: Some(PathBuf::from("measured.txt")),
        ..Reading::default()
    }
}

fn companion(bytes: &[u8]) -> Companion<'_> {
    Companion {
        bytes,
        file: Some(PathBuf::from("beside.csv")),
    }
}

fn imported(bytes: &[u8], settings: &Settings<'_>) -> Imported {
    import(bytes, settings).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn refusal(bytes: &[u8], settings: &Settings<'_>) -> String {
    match import(bytes, settings) {
        Ok(_) => panic!("it was accepted"),
        Err(rejected) => rejected.to_string(),
    }
}

/// Largest distance between the session's points and where the real robot was, mm.
fn off_the_truth(session: &Session) -> f64 {
    let samples = &session.samples;
    let z_mm = samples.z_mm.as_ref().expect("points in space");
    let distance = |i: usize| {
        let theta = samples.q[0][i] + OFFSET_DEG.to_radians();
        let (x, y) = (RADIUS_MM * theta.cos(), RADIUS_MM * theta.sin());
        let d = [samples.x_mm[i] - x, samples.y_mm[i] - y, z_mm[i] - 300.0];
        d.iter().map(|d| d * d).sum::<f64>().sqrt()
    };
    // A frame without a position has no distance.
    (0..samples.len()).map(distance).fold(0.0, f64::max)
}

fn findings(imported: &Imported) -> String {
    let findings = imported.findings.iter().map(ToString::to_string);
    findings.collect::<Vec<String>>().join("\n")
}

#[test]
fn a_german_table_in_utf_16_with_a_preamble_and_a_line_of_units_is_read() {
    let robot = robot();
    let done = imported(
        &bytes("column-utf16.csv"),
        &Settings::new(reading("csv"), &robot),
    );
    let samples = &done.session.samples;
    assert_eq!(samples.len(), 13);
    assert!(
        off_the_truth(&done.session) < 1e-4,
        "{}",
        off_the_truth(&done.session)
    );
    assert_eq!(samples.temperature_c.as_ref().unwrap()[12], 23.0);
    let remarks = samples
        .unknown
        .iter()
        .find(|column| column.name == "Bemerkung")
        .unwrap();
    assert_eq!(remarks.cells[3], "warm; neu \"gesetzt\"");
    for part in [
        "UTF-16 LE",
        "semicolons",
        "decimal comma",
        "sha256 69dea2c3",
    ] {
        assert!(done.session.note.contains(part), "{}", done.session.note);
    }
}

#[test]
fn tracker_text_is_aligned_by_its_reference_points_and_matched_by_names_that_recur() {
    let robot = robot();
    let (reference, commands) = (bytes("reference.txt"), bytes("commands-by-name.csv"));
    let mut settings = Settings::new(reading("tracker"), &robot);
    settings.reference = Some(companion(&reference));
    settings.commands = Some(companion(&commands));
    settings.matching = Some(Matching::Name);
    // The file does not say that it is in inches, and nobody guesses.
    let question = refusal(&bytes("sa.txt"), &settings);
    assert!(
        question.contains("--unit mm or m or in") && question.contains("inches would suit"),
        "{question}"
    );
    settings.reading.unit = Some(LengthUnit::Inches);
    let done = imported(&bytes("sa.txt"), &settings);
    assert_eq!(done.session.samples.len(), 14);
    assert!(
        off_the_truth(&done.session) < 2e-4,
        "{}",
        off_the_truth(&done.session)
    );
    let dir = done.session.samples.dir[0].as_ref().unwrap();
    assert!(dir[..7].iter().all(|d| *d == 1.0) && dir[7..].iter().all(|d| *d == -1.0));
    let alignment = done.alignment.as_ref().unwrap();
    let out: Vec<&str> = alignment.outliers().map(|r| r.name.as_str()).collect();
    assert_eq!(out, ["R3"], "its reflector was not seated");
    assert!((alignment.residuals[2].vector_mm.norm() - 10.16).abs() < 0.01);
    assert!(alignment.rms_mm < 1e-4);
    let said = findings(&done);
    for part in [
        "'stray' (line 24)",
        "'A+80' (line 16)",
        "'R3' has a residual of 10.160 mm",
        "5 measurements of reference points",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn runs_of_an_axis_are_read_wide_and_long_with_positions_or_deviations() {
    let robot = robot();
    let wide = imported(
        &bytes("iso230-wide.csv"),
        &Settings::new(reading("iso230"), &robot),
    )
    .session;
    let long = imported(
        &bytes("iso230-long.txt"),
        &Settings::new(reading("iso230"), &robot),
    )
    .session;
    for session in [&wide, &long] {
        let samples = &session.samples;
        assert_eq!(samples.len(), 70, "7 targets, 5 runs, both sides");
        let dir = samples.dir[0].as_ref().unwrap();
        for i in 0..70 {
            let (run, within) = (i / 14 + 1, i % 14);
            let step = if within < 7 { within } else { 13 - within };
            let target = -90.0 + 30.0 * step as f64;
            let side = if within < 7 { 1.0 } else { -1.0 };
            assert_eq!(dir[i], side);
            assert!((samples.q[0][i].to_degrees() - target).abs() < 1e-9);
            let error =
                0.01 * (2.0 * target).to_radians().sin() + 0.002 * side + 0.0001 * run as f64;
            let measured = samples.y_mm[i].atan2(samples.x_mm[i]).to_degrees();
            assert!((measured - target - error).abs() < 1e-5, "{i}");
            let radius = samples.x_mm[i].hypot(samples.y_mm[i]);
            assert!((radius - 250.0).abs() < 1e-9, "the radius is nominal");
        }
        assert!(
            session.note.contains("the radius is nominal"),
            "{}",
            session.note
        );
    }
}

#[test]
fn a_recording_of_cameras_finds_the_clock_of_the_controller_and_averages_its_stops() {
    let robot = robot();
    let log = bytes("controller-log.csv");
    let mut settings = Settings::new(reading("optitrack"), &robot);
    settings.commands = Some(companion(&log));
    settings.matching = Some(Matching::Time);
    settings.reading.z_up = true;
    let done = imported(&bytes("motive.csv"), &settings);
    let clock = done.matched.as_ref().unwrap().clock.unwrap();
    let sigma = clock.sigma_s.expect("it was found, not given");
    assert!((clock.offset_s - 8.25).abs() < 4.0 * sigma, "{clock:?}");
    assert!(sigma < 0.002, "{clock:?}");
    let samples = &done.session.samples;
    assert_eq!(samples.len(), 10, "the robot stopped ten times");
    let stops: Vec<f64> = samples.q[0]
        .iter()
        .map(|q| q.to_degrees().round())
        .collect();
    assert_eq!(
        stops,
        [0.0, 30.0, -20.0, 55.0, 10.0, -45.0, 70.0, -5.0, 40.0, -60.0]
    );
    assert!(
        off_the_truth(&done.session) < 1e-3,
        "{}",
        off_the_truth(&done.session)
    );
    let dir = samples.dir[0].as_ref().unwrap();
    assert_eq!(dir[..4], [0.0, 1.0, -1.0, 1.0], "from the commanded motion");
    assert_eq!(samples.load_kg.as_ref().unwrap()[0], 3.0);
    assert_eq!(samples.load_kg.as_ref().unwrap()[9], 5.0);
    let [w, x, y, z] = samples.orientation_wxyz.as_ref().unwrap();
    let norm = w[3] * w[3] + x[3] * x[3] + y[3] * y[3] + z[3] * z[3];
    assert!((norm - 1.0).abs() < 1e-9);
    assert!(findings(&done).contains("occluded in 4 of 360 frames, first in line 109"));

    // Of the frames in which nothing moved only the first: there is no stop to average then.
    let motive = String::from_utf8(bytes("motive.csv")).unwrap();
    let place = |line: &str| line.splitn(3, ',').nth(2).map(str::to_owned);
    let mut moving: Vec<&str> = motive.lines().collect();
    moving.dedup_by(|line, before| {
        line.starts_with(char::is_numeric) && place(line) == place(before)
    });
    let all = imported(moving.join("\n").as_bytes(), &settings);
    let kept = all.session.samples.len();
    assert!(
        kept > 50,
        "{kept} samples in motion, of which no stop is made"
    );
    assert!(!all.session.samples.incomplete().is_empty(), "occluded");
    let speed = all.session.samples.speed[0].as_ref().unwrap();
    assert!(
        speed
            .iter()
            .any(|speed| (speed.to_degrees() - 30.0).abs() < 1e-6)
    );
    // 30 °/s and a clock that is good to a millisecond: a tenth of a millimetre.
    assert!(
        off_the_truth(&all.session) < 0.3,
        "{}",
        off_the_truth(&all.session)
    );
}

#[test]
fn several_things_in_a_recording_are_asked_for() {
    let robot = robot();
    let text = String::from_utf8(bytes("motive.csv")).unwrap();
    let two = text.replace(",Marker,Marker,Marker", ",Rigid Body,Rigid Body,Rigid Body");
    let found = inspect(two.as_bytes(), &reading("optitrack"));
    let question = found
        .questions
        .iter()
        .find(|q| q.about == About::Name)
        .expect("it asks");
    assert_eq!(question.answers, ["Lamp", "Lamp:Marker1", "Unlabeled 7"]);
    let mut settings = Settings::new(reading("optitrack"), &robot);
    settings.reading.names = vec!["Lump".to_owned()];
    assert!(refusal(two.as_bytes(), &settings).contains("'Lump'; expected one of 'Lamp'"));
    settings.reading.names = vec!["Lamp".to_owned(), "Unlabeled 7".to_owned()];
    let message = refusal(two.as_bytes(), &settings);
    assert!(
        message.contains("several targets") && message.contains("--targets"),
        "{message}"
    );
}

#[test]
fn a_trajectory_is_read_with_its_quaternion_in_the_order_of_a_session() {
    let robot = robot();
    let commands = bytes("commands-in-order.csv");
    let mut settings = Settings::new(reading("tum"), &robot);
    settings.commands = Some(companion(&commands));
    let done = imported(&bytes("trajectory.txt"), &settings);
    assert!(
        off_the_truth(&done.session) < 1e-4,
        "{}",
        off_the_truth(&done.session)
    );
    let samples = &done.session.samples;
    let [w, _, _, z] = samples.orientation_wxyz.as_ref().unwrap();
    for i in 0..7 {
        let angle = 2.0 * z[i].atan2(w[i]);
        assert!((angle - samples.q[0][i] - OFFSET_DEG.to_radians()).abs() < 1e-6);
    }
    assert_eq!(samples.time_s.as_ref().unwrap()[1], 1714744216.1);
    // One command too few is said with what differs.
    settings.commands = Some(companion(&commands[..commands.len() - 4]));
    let message = refusal(&bytes("trajectory.txt"), &settings);
    assert!(
        message.contains("7 measurements and 6 commands") && message.contains("line 10"),
        "{message}"
    );
}

#[test]
fn a_unit_is_asked_for_with_what_the_numbers_suggest() {
    let robot = robot();
    let text = b"q1_deg,X,Y\n-90,0,-0.25\n90,0,0.25\n0,0.25,0\n";
    let message = refusal(text, &Settings::new(reading("csv"), &robot));
    for part in [
        "spread over 0.5",
        "metres would suit",
        "--unit mm or m or in",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let mut settings = Settings::new(reading("csv"), &robot);
    settings.reading.unit = Some(LengthUnit::Metres);
    assert_eq!(
        imported(text, &settings).session.samples.x_mm,
        [0.0, 0.0, 250.0]
    );
    let named = b"Units: Inches\nq1_deg,X,Y\n-90,0,-10\n90,0,10\n";
    let done = imported(named, &Settings::new(reading("csv"), &robot));
    assert_eq!(done.session.samples.y_mm, [-254.0, 254.0]);
    assert!(findings(&done).contains("the unit is Inches, from the lines before the table"));
}

#[test]
fn a_comma_that_may_be_either_is_asked_about() {
    let robot = robot();
    let text = b"q1_deg;x_mm;y_mm\n1;1,234;5,678\n2;9,012;3,456\n";
    let mut settings = Settings::new(reading("csv"), &robot);
    let message = refusal(text, &settings);
    for part in [
        "measured.txt, line 2, column 2",
        "'1,234' is 1.234 with a decimal comma, or 1234",
        "--decimal , or .",
    ] {
        assert!(message.contains(part), "{message}");
    }
    settings.reading.decimal = Some(Decimal::Comma);
    assert_eq!(
        imported(text, &settings).session.samples.x_mm,
        [1.234, 9.012]
    );
    settings.reading.decimal = Some(Decimal::Point);
    assert_eq!(
        imported(text, &settings).session.samples.x_mm,
        [1234.0, 9012.0]
    );
}

#[test]
fn what_is_wrong_is_named_by_line_and_column() {
    let robot = robot();
    let csv = |text: &str| refusal(text.as_bytes(), &Settings::new(reading("csv"), &robot));
    for (text, part) in [
        (
            "q1_deg,x_mm,y_mm\n1,2,3\n1,2,abc\n",
            "line 3, column 3, y_mm: 'abc'; expected a number",
        ),
        (
            "q1_deg,x_mm,y_mm\n1,2,3\n1,2,nan\n",
            "line 3, column 3, y_mm: 'nan'; expected a finite number",
        ),
        (
            "q1_deg,x_mm,y_mm\n1,2,3\n1,2\n",
            "line 3: 2 cells; expected 3 between commas",
        ),
        (
            "q1_deg;x_mm;y_mm\n1;2,5;3\n1;2.5;3\n",
            "'2,5' here and '2.5' in line 3",
        ),
        (
            "q1_deg,x_mm,y_mm\n1,2,\"3\n",
            "line 2: a quote that is not closed",
        ),
        (
            "1,2,3\n1,2,3\n",
            "3 columns and no header; expected --columns",
        ),
        (
            "q1_deg,x_mm,x_m,y_mm\n1,2,3,4\n",
            "columns 2 'x_mm' and 3 'x_m' could both be x",
        ),
        ("q1_deg,a,b\n1,2,3\n", "no column is x, y, z for certain"),
        ("q2_deg,x_mm,y_mm\n1,2,3\n", "no column 'q1'"),
        (
            "q1_deg,q2_deg,x_mm,y_mm\n1,2,3,4\n",
            "joint 2 does not exist",
        ),
        ("q1_mm,x_mm,y_mm\n1,2,3\n", "not one of joint 1"),
        (
            "q1_deg,x_mm,y_mm,dir1\n1,2,3,left\n",
            "'left'; expected 1, -1 or 0",
        ),
        ("hello world\n", "no table"),
        ("", "an empty file"),
    ] {
        let message = csv(text);
        assert!(message.contains(part), "{part}: {message}");
    }
    let tum = |text: &str| refusal(text.as_bytes(), &Settings::new(reading("tum"), &robot));
    assert!(tum("1 2 3 4 5 6 7\n").contains("7 columns; expected timestamp tx ty"));
    assert!(
        tum("1 2 3 4 0 0 0 1\n2 2 3 x 0 0 0 1\n")
            .contains("line 2, column 4: 'x'; expected a number")
    );
    let motive = |text: &str| {
        refusal(
            text.as_bytes(),
            &Settings::new(reading("optitrack"), &robot),
        )
    };
    assert!(motive("a,b\n1,2\n").contains("line 1: 'a'; expected an export of Motive"));
    let bad = String::from_utf8(bytes("motive.csv"))
        .unwrap()
        .replace("0.300000", "0.3oo000");
    assert!(motive(&bad).contains("line 9, column 8: '0.3oo000'; expected a number"));
    let iso = |text: &str| refusal(text.as_bytes(), &Settings::new(reading("iso230"), &robot));
    assert!(iso("Target [mm],Run 1 +\n0,0\n1,1\n").contains("not one of joint 1"));
    assert!(iso("Target,Run 1 +\n0,0\n1,1\n").contains("--angle-unit deg or rad"));
    assert!(iso("Target [deg],Run 1 + [deg]\n0,5\n90,1\n").contains("of the travel away"));
    // All on a line: the axis has another scale, unless a unit has it.
    let line = |scale: f64| {
        let rows = (0..8).map(|k| format!("{},{}\n", 10 * k, scale * f64::from(10 * k)));
        format!("Target [deg],Run 1 + [deg]\n{}", rows.collect::<String>())
    };
    let settings = Settings::new(reading("iso230"), &robot);
    assert!(import(line(0.465).as_bytes(), &settings).is_ok());
    assert!(iso(&line(1.0 / 0.9)).contains("of the travel away"));
}

/// The file of a laser's own software: sections, in µm.
#[test]
fn runs_in_sections_are_read_as_the_software_of_the_laser_writes_them() {
    let file = "HEADER::\r\nVersion no: 2\r\nTARGET DATA::\r\nFiletype: Linear\r\nTarget-count: 3\r\nTargets :\r\n    \
                0.0000   100.0000\r\n  200.0000\r\nFlags: 0 0 0\r\nUSER-TEXT::\r\nMachine: Mill 4\r\nRUNS::\r\nRun-count: \
                2\r\nDEVIATIONS::\r\nRun Target Data:\r\n   1     1      0.0000\r\n   1     2      1.2000\r\n   1     3      \
                2.4000\r\n   2     3      3.0000\r\n   2     2      1.9000\r\n   2     1      0.9000\r\nENVIRONMENT::\r\nAir 20.1 \
                20.2 20.3\r\nEOF::\r\n";
    let slide = parse_robot(ROBOT).expect("a sound robot").robot;
    let mut lift = Settings::new(reading("iso230"), &slide);
    lift.reading.joint = 1;
    let samples = imported(file.as_bytes(), &lift).session.samples;
    assert_eq!(samples.q[1], [0.0, 100.0, 200.0, 200.0, 100.0, 0.0]);
    assert_eq!(
        samples.dir[1].as_deref(),
        Some(&[1.0, 1.0, 1.0, -1.0, -1.0, -1.0][..])
    );
    let z = samples.z_mm.as_ref().unwrap();
    let wanted = [300.0, 400.0012, 500.0024, 500.003, 400.0019, 300.0009];
    let off = z.iter().zip(wanted).map(|(z, wanted)| (z - wanted).abs());
    assert!(off.fold(0.0, f64::max) < 1e-9, "{z:?}");
    let says = refusal(file.as_bytes(), &Settings::new(reading("iso230"), &slide));
    assert!(
        says.contains("whose unit is not stated") && says.contains("as a table"),
        "{says}"
    );
    let says = refusal(
        file.replace("   2     2  ", "   2     7  ").as_bytes(),
        &lift,
    );
    assert!(
        says.contains("line 20: target number 7; expected 1 to 3"),
        "{says}"
    );
}

#[test]
fn columns_without_a_header_are_named_by_the_person() {
    let robot = robot();
    let mut settings = Settings::new(reading("csv"), &robot);
    settings.reading.columns = ["name", "q1_deg", "-", "x_m", "y_m"]
        .map(str::to_owned)
        .to_vec();
    let done = imported(b"A 0 9 0.25 0\nB 90 9 0 0.25\n", &settings);
    assert_eq!(done.session.samples.y_mm, [0.0, 250.0]);
    settings.reading.columns = vec!["furlong".to_owned()];
    assert!(refusal(b"1 2\n3 4\n", &settings).contains("'furlong' among the columns given"));
    // Of two points behind a name neither is the measured one for certain.
    let both = b"P1 250 0.5 10 250.25 0.75 10.5\nP2 0.5 250 10 0.75 250.25 10.5\n";
    let tracker = Settings::new(reading("tracker"), &robot);
    let message = refusal(both, &tracker);
    assert!(message.contains("7 columns and no header"), "{message}");
}

#[test]
fn reference_points_that_fix_nothing_are_refused() {
    let robot = robot();
    let mut settings = Settings::new(reading("csv"), &robot);
    let measured = b"name,q1_deg,x_mm,y_mm,z_mm\nA,0,0,0,1\nB,0,100,0,1\nC,0,200,0,1\nP,1,1,2,3\n";
    let line = b"name,x_mm,y_mm,z_mm\nA,5,5,5\nB,5,105,5\nC,5,205,5\n";
    settings.reference = Some(companion(line));
    assert!(refusal(measured, &settings).contains("the points lie on one line"));
    let few = b"name,x_mm,y_mm,z_mm\nA,5,5,5\nB,5,105,5\nX,5,205,5\n";
    settings.reference = Some(companion(few));
    let message = refusal(measured, &settings);
    assert!(
        message.contains("2 points with a name") && message.contains("not measured: 'X'"),
        "{message}"
    );
    let twice = b"name,x_mm,y_mm,z_mm\nA,5,5,5\nA,5,105,5\n";
    settings.reference = Some(companion(twice));
    assert!(refusal(measured, &settings).contains("beside.csv, line 3: 'A' a second time"));
}

#[test]
fn an_inspection_shows_what_was_found_and_what_is_asked() {
    let found = inspect(&bytes("column-utf16.csv"), &Reading::default());
    assert_eq!(found.kind, find("csv"));
    assert_eq!((found.header_line, found.rows), (Some(5), 13));
    let meanings: Vec<&str> = found.columns.iter().map(|c| c.meaning.as_str()).collect();
    assert_eq!(
        meanings,
        [
            "name",
            "q1_deg",
            "x_mm",
            "y_mm",
            "z_mm",
            "temperature_c",
            "-"
        ]
    );
    assert_eq!(found.first_rows[0][1], "-90,0");
    assert!(
        found.questions.is_empty() && found.findings.is_empty(),
        "{found:?}"
    );
    for (file, kind) in [
        ("sa.txt", "tracker"),
        ("iso230-wide.csv", "iso230"),
        ("iso230-long.txt", "iso230"),
        ("motive.csv", "optitrack"),
        ("trajectory.txt", "tum"),
    ] {
        assert_eq!(
            inspect(&bytes(file), &Reading::default()).kind,
            find(kind),
            "{file}"
        );
    }
    let found = inspect(&bytes("sa.txt"), &Reading::default());
    assert_eq!(found.questions.len(), 1);
    assert_eq!(found.questions[0].about, About::Unit);
    assert_eq!(found.questions[0].answers, ["mm", "m", "in"]);
}

#[test]
fn a_lost_reflector_is_no_point_once_points_are_moved() {
    let robot = robot();
    let mut settings = Settings::new(reading("csv"), &robot);
    let text =
        b"name,q1_deg,x_mm,y_mm,z_mm\nA,0,0,0,1\nB,0,100,0,1\nC,0,0,100,1\nP,1,0,0,0\nQ,1,9,9,9\n";
    let known = b"name,x_mm,y_mm,z_mm\nA,5,5,5\nB,105,5,5\nC,5,105,5\n";
    settings.reference = Some(companion(known));
    let done = imported(text, &settings);
    assert!(
        findings(&done).contains("lost the reflector (0, 0, 0) in 1 measurement: 'P' (line 5)")
    );
    assert_eq!(done.session.samples.incomplete(), [0]);
    assert!((done.session.samples.z_mm.as_ref().unwrap()[1] - 13.0).abs() < 1e-9);
}

#[test]
fn numbers_that_overflow_are_refused() {
    let robot = robot();
    let csv = |text: &str| refusal(text.as_bytes(), &Settings::new(reading("csv"), &robot));
    assert!(csv("q1_deg,x_m,y_mm\n1,1e308,3\n").contains("a number that overflows"));
    assert!(csv("q1_deg,x_mm,y_mm\n1,1e309,3\n").contains("a number that a double can hold"));
    let mut settings = Settings::new(reading("csv"), &robot);
    settings.matching = Some(Matching::Time);
    settings.commands = Some(companion(b"time_s,q1_deg\n0,0\n1,1\n2,2\n3,1\n4,0\n"));
    let far = "time_s,x_mm,y_mm,z_mm\n0,1e200,0,1\n1,0,-1e308,1\n2,0,0,1e308\n3,0,5,1\n4,1,1,1\n";
    assert!(refusal(far.as_bytes(), &settings).contains("--clock-offset"));
}

fn program(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .output()
        .expect("the program starts")
}

#[test]
fn the_program_imports_into_a_session_that_it_can_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let path = |name: &str| data(name).to_str().unwrap().to_owned();
    let (sa, robot, out) = (path("sa.txt"), path("robot.json"), at("s ü.json"));
    let (reference, commands) = (path("reference.txt"), path("commands-by-name.csv"));
    let base = [
        "import", &sa, "--as", "tracker", "--robot", &robot, "--out", &out,
    ];
    let asked = program(&base);
    assert_eq!(asked.status.code(), Some(2));
    assert!(!Path::new(&out).exists(), "nothing is written");
    let rest = [
        "--unit",
        "in",
        "--reference",
        &reference,
        "--commands",
        &commands,
        "--match",
        "name",
        "--json",
    ];
    let all: Vec<&str> = base.iter().chain(&rest).copied().collect();
    let done = program(&all);
    let message = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(0), "{message}");
    let answer: Value = serde_json::from_slice(&done.stdout).expect("exactly one JSON document");
    assert_eq!(answer["format"], "truepose-import/1");
    assert_eq!(answer["samples"], 14);
    assert_eq!(answer["matched"]["by"], "name");
    assert_eq!(answer["reference"]["points"][2]["left_out"], true);
    assert_eq!(answer["reference"]["points"][0]["left_out"], false);
    let loaded = load(&out).expect("it can be read");
    // What the program wrote itself is no news to it.
    for finding in &loaded.findings {
        let is_own = finding.found.to_string().contains("'name'")
            || finding.found.to_string().contains("'group'");
        assert!(!is_own, "{finding}");
    }
    let loaded = loaded.session;
    let kept: Vec<&str> = loaded
        .samples
        .unknown
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    assert_eq!(kept, ["group", "name", "column 6"]);
    assert!(off_the_truth(&loaded) < 2e-4);
    // Whoever signs the report reads the note, not the terminal: what was left out stands in it.
    let lines: Vec<&str> = loaded.note.lines().collect();
    for said in [
        "commands matched: name",
        "reference point 'R3' has a residual of 10.160 mm: excluded from the alignment",
        "measurements without a command: 'stray' (line 24)",
        "commands without a measurement: 'A+80' (line 16)",
    ] {
        assert!(
            lines.iter().any(|line| line.contains(said)),
            "{said}: {}",
            loaded.note
        );
    }
    // It is not replaced, and never is an input.
    assert_eq!(program(&all).status.code(), Some(2));
    let own = at("measured.csv");
    std::fs::copy(data("column-utf16.csv"), &own).unwrap();
    let session = at("measured.json");
    let over = [
        "import", &own, "--as", "csv", "--robot", &robot, "--out", &session, "--force",
    ];
    let beside = program(&over);
    assert_eq!(beside.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&beside.stderr).contains("measured.samples.csv"));
    assert_eq!(std::fs::read(&own).unwrap(), bytes("column-utf16.csv"));
}

#[test]
fn a_million_rows_take_seconds() {
    use std::fmt::Write;
    let robot = robot();
    let rows: u32 = 1_000_000;
    let mut text = "name;q1_deg;x_mm;y_mm;z_mm\n".to_owned();
    for i in 0..rows {
        let q = f64::from(i % 180) - 90.0;
        writeln!(text, "P{i};{q};{},5;{},25;300", i % 250, i % 77).unwrap();
    }
    let done = imported(text.as_bytes(), &Settings::new(reading("csv"), &robot));
    assert_eq!(done.session.samples.len(), 1_000_000);
    assert_eq!(done.inspection.decimal, Some(Decimal::Comma));
}

/// The robot of the property tests, in a document of its own.
const ROBOT: &[u8] = br#"{"name":"r","joints":[
{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]},
{"name":"lift","kind":"prismatic","axis":[0,0,1],"point_mm":[0,0,0]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}"#;

type Sample = ([f64; 2], [f64; 3], f64);

fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let number = || {
        prop_oneof![
            -1e4..1e4f64,
            (-100_000..100_000i32).prop_map(|v| f64::from(v) / 100.0),
        ]
    };
    let sample = (
        prop::array::uniform2(number()),
        prop::array::uniform3(number()),
        number(),
    );
    prop::collection::vec(sample, 1..30)
}

/// One number that cannot be read in two ways, so that no file of the property tests is ambiguous.
fn decided(mut samples: Vec<Sample>) -> Vec<Sample> {
    samples[0].0[0] = 0.5;
    samples
}

fn written(samples: &[Sample], separator: &str, comma: bool, end: &str) -> String {
    let number = |value: f64| {
        let text = format!("{value:?}");
        if comma { text.replace('.', ",") } else { text }
    };
    let head = [
        "Point Name",
        "J1 [deg]",
        "J2 (mm)",
        "X [mm]",
        "Y [mm]",
        "Z [mm]",
        "Time (s)",
    ];
    let mut text = format!("Report of a tracker{end}{}{end}", head.join(separator));
    for (i, (q, p, t)) in samples.iter().enumerate() {
        let cells = [q[0], q[1], p[0], p[1], p[2], *t].map(number);
        text += &format!("P{i}{separator}{}{end}", cells.join(separator));
    }
    text
}

fn encoded(text: &str, encoding: usize) -> Vec<u8> {
    match encoding {
        0 => text.as_bytes().to_vec(),
        1 => [b"\xef\xbb\xbf".as_slice(), text.as_bytes()].concat(),
        2 => [0xfeff]
            .into_iter()
            .chain(text.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect(),
        _ => [0xfeff]
            .into_iter()
            .chain(text.encode_utf16())
            .flat_map(u16::to_be_bytes)
            .collect(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn what_is_written_in_any_dialect_comes_back_to_the_last_bit(
        samples in samples().prop_map(decided),
        separator in 0..3usize,
        comma in any::<bool>(),
        crlf in any::<bool>(),
        encoding in 0..4usize,
    ) {
        let robot = parse_robot(ROBOT).expect("a sound robot").robot;
        let separator = ["\t", ";", ","][separator];
        let comma = comma && separator != ",";
        let end = if crlf { "\r\n" } else { "\n" };
        let bytes = encoded(&written(&samples, separator, comma, end), encoding);
        let done = import(&bytes, &Settings::new(reading("csv"), &robot));
        let done = done.map_err(|e| TestCaseError::fail(e.to_string()))?;
        let back = &done.session.samples;
        for (i, (q, p, t)) in samples.iter().enumerate() {
            // As a session's own reader has it: one multiplication by the unit.
            prop_assert_eq!(back.q[0][i].to_bits(), (q[0] * 1f64.to_radians()).to_bits());
            prop_assert_eq!(back.q[1][i].to_bits(), q[1].to_bits());
            prop_assert_eq!(back.x_mm[i].to_bits(), p[0].to_bits());
            prop_assert_eq!(back.y_mm[i].to_bits(), p[1].to_bits());
            prop_assert_eq!(back.z_mm.as_ref().expect("z")[i].to_bits(), p[2].to_bits());
            prop_assert_eq!(back.time_s.as_ref().expect("time")[i].to_bits(), t.to_bits());
        }
        let mut document = Vec::new();
        write_inline(&done.session, &mut document).expect("memory does not fail");
        let again = parse(&document).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(again.session.samples.len(), samples.len());
    }

    #[test]
    fn a_trajectory_comes_back(samples in samples()) {
        let robot = parse_robot(ROBOT).expect("a sound robot").robot;
        let mut text = String::from("# a comment\n");
        let mut commands = String::from("q1_deg,q2_mm\n");
        for (q, p, t) in &samples {
            text += &format!("{t:?} {:?} {:?} {:?} 0 0 0 1\n", p[0], p[1], p[2]);
            commands += &format!("{:?},{:?}\n", q[0], q[1]);
        }
        let mut settings = Settings::new(reading("tum"), &robot);
        settings.commands = Some(companion(commands.as_bytes()));
        let done = import(text.as_bytes(), &settings).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let back = &done.session.samples;
        for (i, (q, p, t)) in samples.iter().enumerate() {
            prop_assert_eq!(back.q[1][i].to_bits(), q[1].to_bits());
            prop_assert_eq!(back.x_mm[i].to_bits(), (p[0] * 1000.0).to_bits());
            prop_assert_eq!(back.time_s.as_ref().expect("time")[i].to_bits(), t.to_bits());
            prop_assert_eq!(back.orientation_wxyz.as_ref().expect("turned")[0][i], 1.0);
        }
    }
}

#[test]
fn a_header_and_single_columns_can_be_said_and_the_others_stay_what_they_are() {
    let text = b"exported 2026\nTime [ms];X [cm];Y [cm];q1_deg\n0;24;6;1\n7;8;9;10\n";
    let found = inspect(text, &reading("csv"));
    assert_eq!(found.header_line, Some(2));
    let known = found
        .columns
        .iter()
        .map(truepose::importers::ColumnGuess::is_guess);
    let known: Vec<bool> = known.collect();
    assert_eq!(known, [true, true, true, false], "q1_deg is no guess");
    // One column is said: a time in ms and lengths in cm stay what they are.
    let said = Reading {
        columns: ["auto", "auto", "auto", "-"].map(str::to_owned).to_vec(),
        ..reading("csv")
    };
    let again = inspect(text, &said);
    assert_eq!(again.columns[..3], found.columns[..3]);
    assert_eq!(again.columns[3].meaning, "-");
    assert!(again.questions.is_empty(), "{:?}", again.questions);
    // A header in another line, or none.
    let below = Reading {
        header: Some(3),
        ..reading("csv")
    };
    let below = inspect(text, &below);
    assert_eq!((below.header_line, below.rows), (Some(3), 1));
    let none = Reading {
        header: Some(0),
        ..reading("csv")
    };
    assert_eq!(inspect(text, &none).header_line, None);
    let nowhere = Reading {
        header: Some(99),
        ..reading("csv")
    };
    let nowhere = inspect(text, &nowhere);
    let says = nowhere.findings[0].to_string();
    assert!(says.contains("line 99"), "{says}");
}

#[test]
fn commands_may_be_the_first_to_name_the_reflectors() {
    let robot = robot();
    let measured = b"name,x_mm,y_mm,z_mm\na,248,0,300\nb,247,20,300\n";
    let with = |commands: &[u8]| {
        let mut settings = Settings::new(reading("csv"), &robot);
        settings.matching = Some(Matching::Name);
        settings.commands = Some(companion(commands));
        import(measured, &settings).map_err(|rejected| rejected.to_string())
    };
    let one = with(b"name,q1_deg,target\na,0,T1\nb,5,T1\n").expect("one reflector");
    assert_eq!(one.session.targets[0].name, "T1");
    let two = with(b"name,q1_deg,target\na,0,T1\nb,5,T2\n").expect_err("two of them");
    assert!(
        two.contains("several targets whose positions are not stated"),
        "{two}"
    );
}

#[test]
fn commands_in_another_order_find_their_measurements_by_name_unless_the_order_is_asked_for() {
    let robot = robot();
    let measured = b"name,x_mm,y_mm,z_mm\nP1,250,0,300\nP2,240,60,300\nP3,220,110,300\n";
    let commands = b"name,q1_deg\nP3,26\nP1,0\nP2,14\n";
    let mut settings = Settings::new(reading("csv"), &robot);
    settings.commands = Some(companion(commands));
    let done = import(measured, &settings).expect("it is read");
    let degrees = |session: &truepose::sessions::Session| -> Vec<f64> {
        let q = session.samples.q[0].iter();
        q.map(|q| q.to_degrees().round()).collect()
    };
    assert_eq!(degrees(&done.session), [0.0, 14.0, 26.0]);
    let warns = |done: &truepose::importers::Imported| {
        let mut findings = done.findings.iter().map(ToString::to_string);
        findings.any(|finding| finding.contains("the same names in another order"))
    };
    assert!(!warns(&done));
    settings.matching = Some(Matching::Order);
    let done = import(measured, &settings).expect("it is read");
    assert_eq!(degrees(&done.session), [26.0, 0.0, 14.0]);
    assert!(warns(&done));
}
