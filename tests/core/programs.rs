//! Targets corrected in place, judged by a hidden robot that shares no code with the program and by
//! readers of the languages that share none either: what was written is driven, and the tool has to be
//! where the drawing says.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::hidden_robot::{Hidden, Matrix, apart, times};
use truepose::compensation::{VerifiedCalibration, verify};
use truepose::effects::{Inputs, JointValues};
use truepose::fit::identify_exact;
use truepose::kinematics::Pose;
use truepose::pipeline;
use truepose::programs::{
    Answer, Beside, CompensateError, ModelTool, ProgramFrames, Reason, Request, find, language_of,
};
use truepose::sessions::load;

const DEG: f64 = std::f64::consts::PI / 180.0;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs")
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).unwrap()
}

fn hidden(robot: &str) -> (Hidden, serde_json::Value) {
    let all: serde_json::Value = serde_json::from_slice(&bytes("hidden.json")).unwrap();
    (Hidden::new(&all[robot]), all[robot].clone())
}

fn identified(name: &str, effects: &[&str]) -> VerifiedCalibration {
    let session = load(folder().join(name)).unwrap().session;
    let effects: Vec<String> = effects.iter().map(|e| (*e).to_owned()).collect();
    let answer = identify_exact(&session, &effects, JointValues::Commanded).unwrap();
    let inputs = Inputs::new(&session, JointValues::Commanded);
    pipeline::hand_out(&answer.calibration(&session, &inputs), &session).unwrap()
}

fn arm() -> &'static VerifiedCalibration {
    static ARM: OnceLock<VerifiedCalibration> = OnceLock::new();
    let effects = ["joint-zero-offset", "link-length", "joint-compliance"];
    ARM.get_or_init(|| identified("arm.json", &effects))
}

pub(crate) fn request<'a>(
    calibration: &'a VerifiedCalibration,
    bytes: &'a [u8],
    language: &str,
) -> Request<'a> {
    Request {
        calibration,
        bytes,
        language: find(language).unwrap(),
        file: None,
        beside: Vec::new(),
        load_kg: 0.0,
        start: None,
        frame: None,
        tool: None,
        frames: ProgramFrames::as_declared(),
        measured_frame: false,
    }
}

fn compensated(language: &str, bytes: &[u8]) -> Answer {
    pipeline::compensate(&request(arm(), bytes, language)).unwrap()
}

fn rows(value: &serde_json::Value, key: &str) -> Vec<Vec<f64>> {
    serde_json::from_value(value[key].clone()).unwrap()
}

fn radians(degrees: &[f64]) -> Vec<f64> {
    degrees.iter().map(|v| v * DEG).collect()
}

/// Drives the hidden robot with corrected joint values: 2 µm and 10 µrad are rounding and what the
/// identification leaves; with the sign turned round the error doubles.
fn assert_arrives(robot: &Hidden, q: &[f64], corrected: &[f64], load_kg: f64, what: &str) {
    let wanted = robot.nominal(q);
    let before = apart(&robot.real(q, load_kg), &wanted);
    let after = apart(&robot.real(corrected, load_kg), &wanted);
    assert!(before.0 > 0.2, "{what}: nothing to correct");
    assert!(
        after.0 < 2e-3,
        "{what}: {} mm are left of {}",
        after.0,
        before.0
    );
    assert!(
        after.1 < 1e-5,
        "{what}: {} rad are left of {}",
        after.1,
        before.1
    );
    let turned: Vec<f64> = q.iter().zip(corrected).map(|(q, u)| 2.0 * q - u).collect();
    let doubled = apart(&robot.real(&turned, load_kg), &wanted).0;
    assert!(
        (doubled / before.0 - 2.0).abs() < 0.2,
        "{what}: {doubled} of {}",
        before.0
    );
}

/// The digits, signs and points of a text, as numbers: all that a plain reader needs.
fn numbers(text: &str) -> Vec<f64> {
    let mut numbers = Vec::new();
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        let power = word.ends_with(['E', 'e']) && "+-".contains(c);
        if c.is_ascii_digit() || ".-".contains(c) || ("Ee".contains(c) && !word.is_empty()) || power
        {
            word.push(c);
        } else if !word.is_empty() {
            if let Ok(value) = word.parse() {
                numbers.push(value);
            }
            word.clear();
        }
    }
    numbers
}

fn from_quaternion(at: &[f64], q: &[f64]) -> Matrix {
    let norm = q.iter().map(|v| v * v).sum::<f64>().sqrt();
    let [w, x, y, z] = [0, 1, 2, 3].map(|k: usize| q[k] / norm);
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
            at[0],
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
            at[1],
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
            at[2],
        ],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// `R_z(a) R_y(b) R_x(c)`, degrees.
fn from_zyx(at: &[f64], [a, b, c]: [f64; 3]) -> Matrix {
    let half = |v: f64| (0.5 * v * DEG).sin_cos();
    let ((sa, ca), (sb, cb), (sc, cc)) = (half(a), half(b), half(c));
    let q = [
        ca * cb * cc + sa * sb * sc,
        ca * cb * sc - sa * sb * cc,
        ca * sb * cc + sa * cb * sc,
        sa * cb * cc - ca * sb * sc,
    ];
    from_quaternion(at, &q)
}

fn from_vector(at: &[f64], v: &[f64]) -> Matrix {
    let angle = v.iter().map(|v| v * v).sum::<f64>().sqrt();
    let s = (0.5 * angle).sin() / angle;
    from_quaternion(at, &[(0.5 * angle).cos(), v[0] * s, v[1] * s, v[2] * s])
}

/// Everything of two texts but their numbers is the same.
fn assert_only_numbers_changed(before: &[u8], after: &[u8]) {
    let strip = |bytes: &[u8]| -> Vec<u8> {
        let digits = |b: &&u8| !b.is_ascii_digit() && **b != b'.' && **b != b'-';
        bytes.iter().filter(digits).copied().collect()
    };
    assert_eq!(strip(before), strip(after));
}

#[test]
fn a_table_of_joint_values_brings_the_tool_where_the_drawing_has_it() {
    let (robot, value) = hidden("arm");
    let before = bytes("joints.csv");
    let answer = compensated("csv", &before);
    assert_eq!(answer.left(), 0);
    let text = String::from_utf8(answer.bytes).unwrap();
    assert!(text.starts_with('\u{feff}') && text.ends_with("\r\n"));
    let loads: Vec<f64> = serde_json::from_value(value["load_kg"].clone()).unwrap();
    for ((k, q), line) in rows(&value, "q_deg")
        .iter()
        .enumerate()
        .zip(text.lines().skip(1))
    {
        let cells: Vec<&str> = line.split(';').collect();
        assert_eq!(
            (cells[0], cells[8], cells.len()),
            (&*format!("P{k}"), "\"a", 10)
        );
        let corrected: Vec<f64> = cells[1..7]
            .iter()
            .map(|c| c.replace(',', ".").parse::<f64>().unwrap() * DEG)
            .collect();
        assert_arrives(&robot, &radians(q), &corrected, loads[k], line);
    }
}

#[test]
fn a_table_of_poses_does_too() {
    let (robot, value) = hidden("arm");
    let path = rows(&value, "path_deg");
    let loads: Vec<f64> = serde_json::from_value(value["load_kg"].clone()).unwrap();
    let before = bytes("poses.csv");
    let answer = pipeline::compensate(&Request {
        start: Some(radians(&path[0])),
        ..request(arm(), &before, "csv")
    });
    let answer = answer.unwrap();
    assert_eq!(answer.left(), 0);
    let text = String::from_utf8(answer.bytes).unwrap();
    for ((k, q), line) in path.iter().enumerate().zip(text.lines().skip(1)) {
        let cells = numbers(line);
        let pose = from_quaternion(&cells[..3], &cells[3..7]);
        let q = radians(q);
        let corrected = robot.nominal_inverse(&pose, &q);
        assert_arrives(&robot, &q, &corrected, loads[k], line);
    }
    // Without a start nothing says which joint values the first pose means, nor the ones after it.
    let without = compensated("csv", &before);
    assert_eq!(without.left(), path.len());
    assert_eq!(without.bytes, before);
    let reasons = without
        .targets
        .iter()
        .map(|t| t.result.as_ref().unwrap_err().reason);
    assert!(reasons.into_iter().all(|r| r == Reason::Ambiguous));
}

#[test]
fn rapid_is_changed_in_its_targets_and_nowhere_else() {
    let (robot, value) = hidden("arm");
    let before = bytes("cell.mod");
    let answer = compensated("rapid", &before);
    assert_eq!(answer.left(), 0);
    assert_eq!(answer.at_run_time.len(), 1, "{:?}", answer.at_run_time);
    assert_only_numbers_changed(&before, &answer.bytes);
    let text = String::from_utf8(answer.bytes).unwrap();
    let declared: Vec<&str> = text.lines().filter(|l| l.contains("CONST")).collect();
    for (q, line) in rows(&value, "q_deg").iter().zip(&declared) {
        let (q, all) = (radians(q), numbers(&line[line.find(":=").unwrap()..]));
        let corrected = if line.contains("jointtarget") {
            radians(&all[..6])
        } else {
            assert_eq!(all[7], (q[0] / (90.0 * DEG)).floor(), "{line}");
            robot.nominal_inverse(&from_quaternion(&all[..3], &all[3..7]), &q)
        };
        assert_arrives(&robot, &q, &corrected, 0.0, line);
    }
    let comment = |text: &str| text.lines().nth(1).unwrap().to_owned();
    assert_eq!(comment(&text), comment(&String::from_utf8(before).unwrap()));
}

#[test]
fn krl_is_changed_in_its_targets_and_nowhere_else() {
    let (robot, value) = hidden("arm");
    let before = bytes("cell.src");
    let answer = compensated("krl", &before);
    assert_eq!(answer.left(), 0);
    assert_eq!(answer.at_run_time.len(), 2, "{:?}", answer.at_run_time);
    assert_only_numbers_changed(&before, &answer.bytes);
    let text = String::from_utf8(answer.bytes).unwrap();
    let is_target = |l: &&str| l.starts_with("PTP {") || (l.starts_with("XP") && l.contains('{'));
    let lines: Vec<&str> = text.lines().filter(is_target).collect();
    assert_eq!(lines.len(), 16);
    for (q, line) in rows(&value, "q_deg").iter().zip(lines) {
        let q = radians(q);
        let component = |name: &str| -> f64 {
            let at = line.find(&format!("{name} ")).unwrap() + name.len() + 1;
            numbers(&line[at..line[at..].find([',', '}']).unwrap() + at])[0]
        };
        let corrected = if line.starts_with("PTP") {
            (1..7).map(|k| component(&format!("A{k}")) * DEG).collect()
        } else {
            let at = ["{X", ",Y", ",Z"].map(component);
            let turn = [",A", ",B", ",C"].map(component);
            robot.nominal_inverse(&from_zyx(&at, turn), &q)
        };
        assert_arrives(&robot, &q, &corrected, 0.0, line);
    }
}

#[test]
fn urscript_is_changed_in_its_targets_and_nowhere_else() {
    let (robot, value) = hidden("arm");
    let before = bytes("cell.script");
    let answer = compensated("urscript", &before);
    assert_eq!(answer.left(), 0, "{:?}", answer.targets);
    assert_eq!(answer.at_run_time.len(), 1, "{:?}", answer.at_run_time);
    assert_only_numbers_changed(&before, &answer.bytes);
    let text = String::from_utf8(answer.bytes).unwrap();
    let shown = rows(&value, "q_deg");
    let mut k = 0;
    for line in text
        .lines()
        .filter(|l| !l.contains('#') && !l.contains("pose_trans"))
    {
        let Some(open) = line.find('[') else { continue };
        let list = &line[open..line.find(']').unwrap()];
        let (q, values) = (radians(&shown[k]), numbers(list));
        let corrected = if line[..open].ends_with('p') {
            let at: Vec<f64> = values[..3].iter().map(|v| v * 1000.0).collect();
            robot.nominal_inverse(&from_vector(&at, &values[3..]), &q)
        } else {
            values
        };
        assert_arrives(&robot, &q, &corrected, 0.0, line);
        k += usize::from(!line.contains("global"));
    }
    assert_eq!(k, 16);
}

#[test]
fn fanuc_is_changed_in_its_positions_and_nowhere_else() {
    let (robot, value) = hidden("arm");
    let before = bytes("cell.ls");
    let answer = compensated("fanuc-ls", &before);
    assert_eq!(answer.left(), 0, "{:?}", answer.targets);
    assert_eq!(answer.at_run_time.len(), 1, "{:?}", answer.at_run_time);
    assert_only_numbers_changed(&before, &answer.bytes);
    // A name in Latin-1 comes back as it was.
    assert!(answer.bytes.contains(&0xe9));
    let text: String = answer.bytes.iter().map(|b| char::from(*b)).collect();
    let positions = text.split("/POS").nth(1).unwrap().split("};");
    for (q, position) in rows(&value, "q_deg").iter().zip(positions) {
        let q = radians(q);
        let field = |name: &str| -> f64 {
            let at = position.find(name).unwrap() + name.len();
            numbers(
                &position[at..at
                    + position[at..]
                        .find(" deg")
                        .or(position[at..].find("  mm"))
                        .unwrap()],
            )[0]
        };
        let corrected = if position.contains("J1=") {
            (1..7).map(|k| field(&format!("J{k}=")) * DEG).collect()
        } else {
            // The world begins at the height of axis 2.
            let mut at = ["X =", "Y =", "Z ="].map(field);
            at[2] += 290.0;
            let [w, p, r] = ["W =", "P =", "R ="].map(field);
            robot.nominal_inverse(&from_zyx(&at, [r, p, w]), &q)
        };
        assert_arrives(&robot, &q, &corrected, 0.0, position);
    }
}

/// One line of joint values in every language, and which numbers of such a line they are.
fn lines_of_two(q: &[f64], k: usize) -> [(&'static str, String, [usize; 2]); 5] {
    let (a, b) = (q[0], q[1]);
    let [first, second] = [a, b].map(f64::to_radians);
    let none = "[9E9,9E9,9E9,9E9,9E9,9E9]";
    [
        ("csv", format!("{a},{b}"), [0, 1]),
        (
            "rapid",
            format!("MoveAbsJ [[{a},{b},0,0,0,0],{none}],v9,fine,t;"),
            [0, 1],
        ),
        ("krl", format!("PTP {{A1 {a},A2 {b}}}"), [1, 3]),
        (
            "urscript",
            format!("movej([{first:.12},{second:.12}])"),
            [0, 1],
        ),
        (
            "fanuc-ls",
            format!("P[{}]{{ J1= {a} deg, J2= {b} deg }};", k + 1),
            [2, 4],
        ),
    ]
}

#[test]
fn two_joints_bring_the_tool_as_near_as_they_can_in_every_language() {
    let calibration = identified("positioner.json", &["joint-zero-offset", "link-length"]);
    let (robot, value) = hidden("positioner");
    let floors: Vec<f64> = serde_json::from_value(value["floor_mm"].clone()).unwrap();
    let all = rows(&value, "q_deg");
    for (language, head) in [
        ("csv", "q1_deg,q2_deg\n"),
        ("rapid", "\n"),
        ("krl", "\n"),
        ("urscript", "\n"),
        ("fanuc-ls", "/POS\n"),
    ] {
        // What no motion goes to is no target: those of a listing stand before its positions.
        let goes = |k: usize| format!(" {k}:J P[{k}] 9% FINE ;");
        let moves: Vec<String> = (1..=all.len()).map(goes).collect();
        let moves = format!("/MN\n{}\n", moves.join("\n"));
        let head = match language {
            "fanuc-ls" => format!("{moves}{head}"),
            _ => head.to_owned(),
        };
        let line = |(k, q): (usize, &Vec<f64>)| {
            let mut lines = lines_of_two(q, k).into_iter();
            let own = lines.find(|l| l.0 == language).unwrap();
            (own.1, own.2)
        };
        let lines: Vec<(String, [usize; 2])> = all.iter().enumerate().map(line).collect();
        let program: Vec<&str> = lines.iter().map(|l| l.0.as_str()).collect();
        let before = format!("{head}{}\n", program.join("\n"));
        let request = request(&calibration, before.as_bytes(), language);
        let answer = pipeline::compensate(&request).unwrap();
        assert_eq!(answer.targets.len(), all.len(), "{language}");
        assert_eq!(answer.left(), 0, "{language}: {:?}", answer.targets);
        let text = String::from_utf8(answer.bytes).unwrap();
        let mut most = 0.0_f64;
        for (k, line) in text.lines().skip(head.lines().count()).enumerate() {
            let shown = numbers(line);
            let shown = lines[k].1.map(|at| shown[at]);
            let corrected = match language {
                "urscript" => shown.to_vec(),
                _ => radians(&shown),
            };
            let (q, floor) = (radians(&all[k]), floors[k]);
            let wanted = robot.nominal(&q);
            let left = |q: &[f64]| apart(&robot.real(q, 0.0), &wanted).0;
            assert!(floor > 0.05, "{line}: the joints cannot reach everything");
            let after = left(&corrected);
            assert!(after <= 1.05 * floor, "{line}: {after} of {floor}");
            // What the joints can correct doubles with the sign reversed, but for what is left of it and, where they
            // are nearly singular, for their curvature.
            let reversed: Vec<f64> = q.iter().zip(&corrected).map(|(q, u)| 2.0 * q - u).collect();
            let beyond = |q: &[f64]| (left(q).powi(2) - floor.powi(2)).max(0.0).sqrt();
            let (once, twice) = (beyond(&q), beyond(&reversed));
            let off = (twice - 2.0 * once).abs();
            most = most.max(once);
            let left = beyond(&corrected);
            assert!(off <= left + 0.2 * once, "{line}: {once} {twice} {left}");
        }
        assert!(most > 0.7, "{language}: nothing to correct");
    }
}

#[test]
fn what_cannot_be_corrected_is_named_with_its_line_and_left() {
    let table =
        b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n10,20,-30,40,50,60\n10,20,-30,40,0,60\n\
        10,109.999,-30,40,50,60\n10,300,0,0,50,0\n";
    let answer = compensated("csv", table);
    let reasons: Vec<Option<Reason>> = answer
        .targets
        .iter()
        .map(|t| t.result.as_ref().err().map(|l| l.reason))
        .collect();
    // A stretched wrist is no reason to leave a target: its position is corrected.
    assert_eq!(reasons[..2], [None, None]);
    let stretched = answer.targets[1].result.as_ref().unwrap();
    assert!(stretched.position_mm[0] > 0.2 && stretched.position_mm[1] < 1e-4);
    assert!(
        stretched.rotation_rad[1] > 1e-6
            && stretched.rotation_rad[1] < stretched.rotation_rad[0] + 1e-3
    );
    assert_eq!(reasons[3], Some(Reason::Unreachable));
    let places: Vec<u64> = answer.targets.iter().map(|t| t.place.0).collect();
    assert_eq!(places, [2, 3, 4, 5]);
    let lines = |bytes: &[u8]| -> Vec<String> {
        String::from_utf8(bytes.to_vec())
            .unwrap()
            .lines()
            .map(str::to_owned)
            .collect()
    };
    let (before, after) = (lines(table), lines(&answer.bytes));
    assert_ne!((&before[1], &before[2]), (&after[1], &after[2]));
    assert_eq!(before[4], after[4]);
}

#[test]
fn programs_without_targets_come_back_byte_for_byte() {
    let programs: [(&str, &[u8]); 7] = [
        (
            "rapid",
            b"\xef\xbb\xbfMODULE m\r\n! caf\xe9 [[1,2\r\n TPWrite \"[[\";\r\nENDMODULE",
        ),
        (
            "krl",
            b"&ACCESS R\r\nDEF m()\r\n;PTP {A1\r\n$BASE={X 1,Y 2,Z 3,A 0,B 0,C 0}\r\nEND\r\n",
        ),
        (
            "urscript",
            b"def m():\n  # movej([1,2\n  textmsg(\"p[1,\")\n  set_tcp(p[0,0,0.1,0,0,0])\nend\n",
        ),
        (
            "fanuc-ls",
            b"/PROG M\r\n/MN\r\n   1:  !J P[1] ;\r\n/POS\r\n/END\r\n",
        ),
        ("csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\r\n"),
        ("krl", b""),
        ("urscript", b""),
    ];
    for (language, program) in programs {
        let answer = compensated(language, program);
        assert!(
            answer.targets.is_empty(),
            "{language}: {:?}",
            answer.targets
        );
        assert_eq!(answer.bytes, program, "{language}");
    }
}

/// Language, program, line and column of what is wrong, and a word of what was expected.
#[rustfmt::skip]
const BROKEN: [(&str, &[u8], u64, u64, &str); 43] = [
    ("csv", b"", 1, 1, "a header"),
    ("rapid", b"CONST jointtarget j:=[[1,2,3,4,5],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 23, "6"),
    ("rapid", b"CONST jointtarget j:=[[1,2,3,4,5,6]];", 1, 22, "jointtarget"),
    ("rapid", b"\nCONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9];", 2, 62, "]"),
    ("rapid", b"CONST jointtarget j:=[[1,2,3,4..5,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 30, "number"),
    ("rapid", b"CONST jointtarget j:=[[1,2 3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 28, "]"),
    ("rapid", b"CONST jointtarget j:=[[1,,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 26, "number"),
    ("rapid", b"CONST jointtarget j:=[[1,2,3,4,5,1E999],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 34, "larger"),
    ("rapid", b"CONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]\nMoveJ j;", 2, 1, "';'"),
    ("rapid", b"CONST robtarget p:=[[1,2,3],[1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 29, "4"),
    ("rapid", b"CONST robtarget p:=[[1,2,3],[0,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 30, "a length of 1"),
    ("rapid", b"CONST robtarget p:=[[1,2,3],[1,0,0,0],[0.5,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];", 1, 40, "whole"),
    ("rapid", b"CONST robtarget p:=[1,2,3,4];", 1, 21, "robtarget"),
    ("rapid", b"MoveJ [[1,2,3],[1,0,0,0]],v1,fine,tool0;", 1, 8, "6"),
    ("rapid", b"MoveJ p1,v1,fine,tool0\nMoveJ p2,v1,fine,tool0;", 2, 1, "';'"),
    ("rapid", b"TPWrite \"never closed;\n", 1, 9, "\""),
    ("krl", b"PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6", 1, 35, "}"),
    ("krl", b"PTP {A1 1,A2 2,A3 3,A4 4,A5 5 A6 6}", 1, 31, "}"),
    ("krl", b"PTP {A1 1,A1 2,A3 3,A4 4,A5 5,A6 6}", 1, 11, "once"),
    ("krl", b"PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6.0.0}", 1, 34, "number"),
    ("krl", b"PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A9 6}", 1, 34, "A1"),
    ("krl", b"PTP {X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 1.5}", 1, 36, "whole"),
    ("krl", b"PTP {X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 'B012'}", 1, 36, "binary"),
    ("krl", b"CIRC {X 1,Y 2,Z 3,A 0,B 0,C 0} {X 1,Y 2,Z 3,A 0,B 0,C 0}", 1, 32, "a comma"),
    ("krl", b"DEF m()\nPTP\n", 2, 4, "target"),
    ("krl", b"DECL E6AXIS P={X 1,Y 2,Z 3,A 0,B 0,C 0}", 1, 30, "A1"),
    ("krl", b"PTP {A1 ,A2 2,A3 3,A4 4,A5 5,A6 6}", 1, 9, "value"),
    ("urscript", b"movej([1,2,3,4,5])", 1, 7, "6"),
    ("urscript", b"movel(p[1,2,3,4,5])", 1, 7, "rx"),
    ("urscript", b"movej([1,2,3,4,5,6)", 1, 19, "]"),
    ("urscript", b"\n movej([1,2,3,4,5,6]", 2, 21, ")"),
    ("urscript", b"movej([1,2,3,4,5,6e])", 1, 18, "number"),
    ("urscript", b"movej()", 1, 7, "target"),
    ("urscript", b"movec(p[1,2,3,0,0,0])", 1, 21, "next"),
    ("fanuc-ls", b"/POS\nP[1]{\n J1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 5 deg\n};", 3, 2, "J6"),
    ("fanuc-ls", b"/POS\nP[1]{\n J1= 1 mm, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 5 deg, J6= 6 deg\n};", 3, 6, "deg"),
    ("fanuc-ls", b"/POS\nP[1]{\n J1 1 deg\n};", 3, 5, "="),
    ("fanuc-ls", b"/POS\nP[1]{\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 0 deg, P = 0 deg\n};", 3, 2, "R"),
    ("fanuc-ls", b"/POS\nP[1]{\n CONFIG : 'Q U T, 0, 0, 0', X = 1 mm, Y = 2 mm, Z = 3 mm, W = 0 deg, P = 0 deg, R = 0 deg\n};", 3, 11, "N U T"),
    ("csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n1,2,3,4,5,nan\n", 2, 11, "number"),
    ("csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg\n1,2,3,4,5\n", 1, 1, "each joint"),
    ("csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,note\n1,2,3,4,5,6,\"a\n1,2,3,4,5,6,b\"\n", 2, 13, "a closing quote"),
    ("csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n1,2,3,4,5,\"6\"7\n", 2, 11, "number"),
];

#[test]
fn broken_programs_are_refused_with_line_and_column() {
    for (language, program, line, column, expected) in BROKEN {
        let shown = String::from_utf8_lossy(program);
        let refused = match pipeline::compensate(&request(arm(), program, language)) {
            Err(CompensateError::Rejected(rejected)) => rejected,
            other => panic!("{shown}: {other:?}"),
        };
        let first = &refused.diagnostics[0];
        let place = (first.place.line, first.place.column);
        assert_eq!(place, (Some(line), Some(column)), "{shown}: {refused}");
        assert!(
            first.expected.to_string().contains(expected),
            "{shown}: {refused}"
        );
    }
}

#[test]
fn a_language_is_told_by_its_ending_or_its_looks() {
    for (name, language) in [
        ("cell.mod", "rapid"),
        ("cell.src", "krl"),
        ("cell.script", "urscript"),
        ("cell.ls", "fanuc-ls"),
        ("joints.csv", "csv"),
        ("poses.csv", "csv"),
    ] {
        let bytes = bytes(name);
        let of = |name: &str| language_of(Path::new(name), &bytes).map(|l| l.id);
        assert_eq!(of(name), Some(language));
        assert_eq!(of("cell.txt"), Some(language), "{name} by its looks");
    }
    assert!(language_of(Path::new("x.bin"), b"nothing known").is_none());
}

#[test]
fn directions_follow_from_the_motions_of_a_program() {
    let program = b"CONST jointtarget a:=[[0,10,-20,30,40,50],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        CONST jointtarget b:=[[5,5,-20,30,40,50],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        MoveAbsJ b,v1,fine,tool0; MoveAbsJ a,v1,fine,tool0;\n";
    let answer = compensated("rapid", program);
    let dir = |k: usize| answer.targets[k].result.as_ref().unwrap().dir.clone();
    assert_eq!(
        dir(1),
        [0; 6],
        "the first move comes from nobody knows where"
    );
    assert_eq!(dir(0), [-1, 1, 0, 0, 0, 0]);
}

#[test]
fn quadrants_and_turns_follow_a_joint_across_its_border() {
    // Joint 4 stands just beside zero and is corrected across it, one way or the other.
    let (robot, _) = hidden("arm");
    let mut seen = 0;
    for degrees in [0.02, -0.02] {
        let q = radians(&[20.0, 10.0, -15.0, degrees, 40.0, 30.0]);
        let at = robot.nominal(&q);
        let row = |k: usize| [at[0][k], at[1][k], at[2][k]];
        let b = (-at[2][0]).atan2(at[0][0].hypot(at[1][0])) / DEG;
        let (a, c) = (
            at[1][0].atan2(at[0][0]) / DEG,
            at[2][1].atan2(at[2][2]) / DEG,
        );
        let [x, y, z] = row(3);
        let turn = usize::from(degrees < 0.0) << 3 | 1 << 2;
        let program =
            format!("PTP {{X {x:.6},Y {y:.6},Z {z:.6},A {a:.7},B {b:.7},C {c:.7},S 0,T {turn}}}\n");
        let answer = compensated("krl", program.as_bytes());
        let corrected = &answer.targets[0].result.as_ref().unwrap().corrected;
        let text = String::from_utf8(answer.bytes).unwrap();
        let written = numbers(&text[text.find("T ").unwrap()..])[0];
        let expected = f64::from(4 + 8 * u8::from(corrected[3] < 0.0));
        assert_eq!(written, expected, "{text}");
        seen += usize::from((corrected[3] < 0.0) != (degrees < 0.0));
    }
    assert_eq!(seen, 1, "one of the two crosses");
}

#[test]
fn verify_carries_joints_and_links_over_to_another_tool() {
    let mut session = load(folder().join("arm.json")).unwrap().session;
    // The same samples, said to be of targets that sit elsewhere on the tool, and some of them only.
    for target in &mut session.targets {
        target.position_mm += nalgebra::Vector3::new(3.0, -5.0, 2.0);
    }
    let keep = 40;
    session.samples.x_mm[keep..].fill(f64::NAN);
    let verified = verify(arm(), &session).unwrap();
    assert!(verified.nominal.rms_mm > 4.0);
    // The own errors of the targets are not carried over: each was up to a tenth of a mm.
    assert!(verified.model.rms_mm < 0.15, "{}", verified.model.rms_mm);
    assert!(
        verified.notes.iter().any(|n| n.contains("other targets")),
        "{:?}",
        verified.notes
    );
    let same = verify(arm(), &load(folder().join("arm.json")).unwrap().session).unwrap();
    assert!(same.notes.is_empty(), "{:?}", same.notes);
}

/// The inverse of a rigid motion.
fn back(m: &Matrix) -> Matrix {
    let mut out = [[0.0; 4]; 4];
    for i in 0..3 {
        for j in 0..3 {
            out[i][j] = m[j][i];
            out[i][3] -= m[j][i] * m[j][3];
        }
    }
    out[3][3] = 1.0;
    out
}

fn place(m: &Matrix) -> [f64; 3] {
    [m[0][3], m[1][3], m[2][3]]
}

/// w, x, y, z of a rotation, by its rotation vector.
fn quaternion(m: &Matrix) -> [f64; 4] {
    let v = vector(m);
    let angle = v.iter().map(|v| v * v).sum::<f64>().sqrt();
    let s = if angle > 0.0 {
        (0.5 * angle).sin() / angle
    } else {
        0.0
    };
    [(0.5 * angle).cos(), v[0] * s, v[1] * s, v[2] * s]
}

/// The rotation vector of a rotation by less than half a turn.
fn vector(m: &Matrix) -> [f64; 3] {
    let twice = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let sine = 0.5 * twice.iter().map(|v| v * v).sum::<f64>().sqrt();
    let angle = sine.atan2(0.5 * (m[0][0] + m[1][1] + m[2][2] - 1.0));
    twice.map(|v| 0.5 * v * angle / sine)
}

/// A, B, C of `R_z(a) R_y(b) R_x(c)`, degrees.
fn zyx(m: &Matrix) -> [f64; 3] {
    let b = (-m[2][0]).atan2(m[0][0].hypot(m[1][0]));
    [m[1][0].atan2(m[0][0]), b, m[2][1].atan2(m[2][2])].map(|v| v / DEG)
}

/// A fixture in the base, the model's tool on the flange and another tool.
fn held() -> [Matrix; 3] {
    [
        from_zyx(&[310.0, -120.0, 95.0], [25.0, -10.0, 40.0]),
        from_zyx(&[30.0, -15.0, 160.0], [10.0, 35.0, -20.0]),
        from_zyx(&[-55.0, 20.0, 240.0], [-70.0, 15.0, 30.0]),
    ]
}

/// What a controller calls a pose of the model's tool: in a frame, of one of its tools.
fn written_in(pose: &Matrix, frame: &Matrix, [model, tool]: [&Matrix; 2]) -> Matrix {
    times(&times(&back(frame), pose), &times(&back(model), tool))
}

fn model_tool() -> ModelTool {
    let [_, model, _] = held();
    let (at, q) = (place(&model), quaternion(&model));
    ModelTool::OnFlange(truepose::kinematics::pose_from_parts(at, q).unwrap())
}

fn with_tool(language: &str, program: &str, tool: Option<ModelTool>) -> Answer {
    let request = Request {
        tool,
        ..request(arm(), program.as_bytes(), language)
    };
    pipeline::compensate(&request).unwrap()
}

/// Every pose that was corrected arrives in its frame with its tool; `left`: which are left, with words.
fn assert_held(
    answer: &Answer,
    q: &[Vec<f64>],
    frames: &[(Matrix, Matrix)],
    read: impl Fn(&str, usize) -> Matrix,
    left: &[(usize, &str)],
) {
    let (robot, _) = hidden("arm");
    let model = held()[1];
    let text = String::from_utf8(answer.bytes.clone()).unwrap();
    for (k, target) in answer.targets.iter().enumerate() {
        match (&target.result, left.iter().find(|(index, _)| *index == k)) {
            (Err(found), Some((_, word))) => {
                assert_eq!(found.reason, Reason::Frame, "{}", found.explanation);
                assert!(
                    found.explanation.to_string().contains(word),
                    "{}: {}",
                    target.name,
                    found.explanation
                );
            }
            (Ok(_), None) => {
                let (frame, tool) = &frames[k];
                let pose = times(frame, &read(&text, k));
                let pose = times(&pose, &times(&back(tool), &model));
                let corrected = robot.nominal_inverse(&pose, &q[k]);
                assert_arrives(&robot, &q[k], &corrected, 0.0, &target.name);
            }
            (found, expected) => panic!("{}: {found:?}, expected {expected:?}", target.name),
        }
    }
}

/// The poses of `cell.*` are every second one.
fn every_second() -> Vec<Vec<f64>> {
    let (_, value) = hidden("arm");
    rows(&value, "q_deg")
        .iter()
        .step_by(2)
        .map(|q| radians(q))
        .collect()
}

/// A module with a pose for each frame and tool, the fixture as a user frame with an object frame in it.
fn rapid_module(q: &[Vec<f64>], frames: &[(Matrix, Matrix)]) -> String {
    let (robot, _) = hidden("arm");
    let [fixture, gun, pen] = held();
    let user = from_zyx(&[100.0, 40.0, -30.0], [15.0, 5.0, -25.0]);
    let object = times(&back(&user), &fixture);
    let parts = |m: &Matrix| {
        let ([x, y, z], [w, i, j, k]) = (place(m), quaternion(m));
        format!("[{x:.6},{y:.6},{z:.6}],[{w:.10},{i:.10},{j:.10},{k:.10}]")
    };
    let [gun_parts, pen_parts, user, object] = [gun, pen, user, object].map(|m| parts(&m));
    let mut program = format!(
        "MODULE m\nPERS tooldata tGun:=[TRUE,[{gun_parts}],[1,[0,0,9],[1,0,0,0],0,0,0]];\n\
         PERS tooldata tPen:=[TRUE,[{pen_parts}],[1,[0,0,9],[1,0,0,0],0,0,0]];\n\
         PERS wobjdata fix:=[FALSE,TRUE,\"\",[{user}],[{object}]];\n\
         PERS wobjdata held:=[TRUE,TRUE,\"\",[{user}],[{object}]];\n"
    );
    let cell = String::from_utf8(bytes("cell.mod")).unwrap();
    let declared = cell.lines().filter(|l| l.contains("CONST robtarget"));
    for (k, ((frame, tool), line)) in frames.iter().zip(declared).enumerate() {
        let x = written_in(&robot.nominal(&q[k]), frame, [&gun, tool]);
        let (x, configuration) = (parts(&x), line.split("],").nth(2).unwrap());
        let external = "[9E9,9E9,9E9,9E9,9E9,9E9]";
        program += &format!("CONST robtarget p{k}:=[{x},{configuration}],{external}];\n");
    }
    program
        + "PROC main()\nMoveL p0,v9,fine,tGun\\WObj:=fix;\nMoveJ p1,v9\\T:=2,z10,tPen\\WObj:=fix;\n\
        MoveL p2,v9,fine,tGun;\nMoveL p3,v9,fine,tool0\\WObj:=wobj0;\nMoveL p4,v9,fine,tGun\\WObj:=far;\n\
        MoveL p5,v9,fine,tGun\\WObj:=held;\nENDPROC\nENDMODULE\n"
}

#[test]
fn rapid_poses_are_corrected_in_their_work_objects_and_of_their_tools() {
    let ([fixture, gun, pen], q) = (held(), every_second());
    let unit = from_zyx(&[0.0; 3], [0.0; 3]);
    let frames = [
        (fixture, gun),
        (fixture, pen),
        (unit, gun),
        (unit, unit),
        (fixture, gun),
        (fixture, gun),
    ];
    let program = rapid_module(&q, &frames);
    let read = |text: &str, k: usize| {
        let line = text
            .lines()
            .find(|l| l.contains(&format!("robtarget p{k}:=")))
            .unwrap();
        let all = numbers(&line[line.find(":=").unwrap()..]);
        from_quaternion(&all[..3], &all[3..7])
    };
    let left = [
        (4, "far is declared elsewhere"),
        (5, "held is moved by the robot"),
    ];
    let answer = with_tool("rapid", &program, Some(ModelTool::Named("tgun".to_owned())));
    assert_held(&answer, &q, &frames, read, &left);
    assert_eq!(answer.targets[4].place, (10, 21));
    // Where the model's tool sits on the flange says as much as its name.
    assert_held(
        &with_tool("rapid", &program, Some(model_tool())),
        &q,
        &frames,
        read,
        &left,
    );
    // Where nothing says which tool is the model's, no pose is.
    let unsaid = with_tool("rapid", &program, None);
    assert_eq!(
        (unsaid.left(), unsaid.bytes),
        (6, program.clone().into_bytes())
    );
    // A frame that is declared elsewhere may be stated.
    let (at, turn) = (place(&fixture), quaternion(&fixture));
    let request = Request {
        frame: Some(truepose::kinematics::pose_from_parts(at, turn).unwrap()),
        tool: Some(model_tool()),
        ..request(arm(), program.as_bytes(), "rapid")
    };
    let answer = pipeline::compensate(&request).unwrap();
    assert!(answer.targets[4].result.is_ok(), "{:?}", answer.targets[4]);
    // What is changed at run time is not known, nor is what two moves go to differently.
    for (change, word) in [
        ("fix.oframe.trans.x:=3;", "fix is changed at run time"),
        ("MoveL p0,v9,fine,tGun;", "with fix and none"),
        (
            "MoveL Offs(p0,0,0,9),v9,fine,tPen\\WObj:=fix;",
            "with tGun and tPen",
        ),
    ] {
        let changed = program.replace("ENDPROC", &format!("{change}\nENDPROC"));
        let answer = with_tool("rapid", &changed, Some(model_tool()));
        let found = answer.targets[0].result.as_ref().unwrap_err();
        assert_eq!(found.reason, Reason::Frame);
        assert!(
            found.explanation.to_string().contains(word),
            "{}",
            found.explanation
        );
    }
}

#[test]
fn krl_poses_are_corrected_in_the_base_and_of_the_tool_that_is_set() {
    let (robot, _) = hidden("arm");
    let [fixture, gun, pen] = held();
    let q = every_second();
    let parts = |m: &Matrix| {
        let ([x, y, z], [a, b, c]) = (place(m), zyx(m));
        format!("X {x:.6},Y {y:.6},Z {z:.6},A {a:.8},B {b:.8},C {c:.8}")
    };
    let cell = String::from_utf8(bytes("cell.src")).unwrap();
    let configurations: Vec<&str> = cell
        .lines()
        .filter(|l| l.starts_with("XP"))
        .map(|l| &l[l.find("S ").unwrap()..])
        .collect();
    let unit = from_zyx(&[0.0; 3], [0.0; 3]);
    let frames = [
        (fixture, gun),
        (fixture, pen),
        (unit, gun),
        (fixture, gun),
        (fixture, gun),
        (unit, unit),
        (fixture, gun),
    ];
    let mut program = format!(
        "DEF m()\nDECL FRAME FIX\nFIX={{{}}}\nPEN={{FRAME: {}}}\n",
        parts(&fixture),
        parts(&pen)
    );
    for (k, (frame, tool)) in frames.iter().enumerate() {
        let x = written_in(&robot.nominal(&q[k]), frame, [&gun, tool]);
        program += &format!("XP{k}={{{},{}\n", parts(&x), configurations[k]);
    }
    let gun_set = format!("$TOOL={{{}}}", parts(&gun));
    program += &format!(
        "{gun_set}\n$BASE=FIX\nPTP XP0\n$TOOL=PEN\nLIN XP1\n{gun_set}\n$BASE=$NULLFRAME\nLIN XP2\n\
         $BASE=BASE_DATA[4]\nLIN XP3\nIF A==1 THEN\n$BASE=FIX\nLIN XP4\nENDIF\nLIN XP6\n$TOOL=$NULLFRAME\n\
         $BASE=$NULLFRAME\nLIN XP5\nEND\n"
    );
    let read = |text: &str, k: usize| {
        let line = text
            .lines()
            .find(|l| l.starts_with(&format!("XP{k}=")))
            .unwrap();
        let all = numbers(
            line[line.find('{').unwrap()..]
                .replace(['X', 'Y', 'Z', 'A', 'B', 'C'], "")
                .as_str(),
        );
        from_zyx(&all[..3], [all[3], all[4], all[5]])
    };
    let left = [(3, "BASE_DATA[4] is declared elsewhere"), (6, "branch")];
    let answer = with_tool("krl", &program, Some(model_tool()));
    assert_held(&answer, &q, &frames, read, &left);
    assert_eq!(
        with_tool("krl", &program, None).left(),
        7,
        "two tools and the flange"
    );
    // The other way to say the numbers of base and tool.
    let inline = "DEF m()\nDECL FDAT F1={TOOL_NO 1,BASE_NO 2}\nBASE_DATA[2]={X 1,Y 2,Z 3,A 0,B 0,C 0}\nFDAT_ACT=F1\n\
        PTP {X 162.2216,Y 61.7095,Z 586.1627,A -141.3534,B -26.4136,C -46.7269,S 0,T 18}\nEND\n";
    for (program, shift) in [
        (inline.to_owned(), 1.0),
        (inline.replace("_NO 2", "_NO 0"), 0.0),
    ] {
        let answer = with_tool("krl", &program, None);
        let written = answer.targets[0].result.as_ref();
        let place = written.map(|w| robot.nominal(&w.commanded)[0][3]);
        assert!((place.unwrap() - 162.2216 - shift).abs() < 1e-6, "{shift}");
    }
}

#[test]
fn urscript_poses_are_those_of_the_tool_that_is_set() {
    let (robot, _) = hidden("arm");
    let [_, gun, pen] = held();
    let (q, unit) = (every_second(), from_zyx(&[0.0; 3], [0.0; 3]));
    let parts = |m: &Matrix| {
        let (at, v) = (place(m).map(|v| v / 1000.0), vector(m));
        format!(
            "p[{:.9}, {:.9}, {:.9}, {:.9}, {:.9}, {:.9}]",
            at[0], at[1], at[2], v[0], v[1], v[2]
        )
    };
    let frames = [(unit, gun), (unit, pen), (unit, gun)];
    let mut program = format!(
        "def m():\n  pen = {}\n  set_tcp({})\n",
        parts(&pen),
        parts(&gun)
    );
    for (k, (frame, tool)) in frames.iter().enumerate() {
        let x = written_in(&robot.nominal(&q[k]), frame, [&gun, tool]);
        program +=
            &["", "  set_tcp(pen)\n", "  # back\n  set_tcp(GUN)\n"][k].replace("GUN", &parts(&gun));
        program += &format!(
            "  movel(get_inverse_kin({}, qnear={:.6?}))\n",
            parts(&x),
            q[k]
        );
    }
    program += "end\n";
    let read = |text: &str, k: usize| {
        let line = text.lines().filter(|l| l.contains("movel")).nth(k).unwrap();
        let all = numbers(&line[line.find('[').unwrap()..]);
        let at: Vec<f64> = all[..3].iter().map(|v| v * 1000.0).collect();
        from_vector(&at, &all[3..6])
    };
    assert_held(
        &with_tool("urscript", &program, Some(model_tool())),
        &q,
        &frames,
        read,
        &[],
    );
    let word = "several tools";
    assert_held(
        &with_tool("urscript", &program, None),
        &q,
        &frames,
        read,
        &[(0, word), (1, word), (2, word)],
    );
    // Behind a branch nobody knows which holds, before it and where it is set again it is known.
    let branch = program.replace("  set_tcp(pen)", "  if a:\n  set_tcp(pen)\n  end");
    let answer = with_tool("urscript", &branch, Some(model_tool()));
    assert_held(&answer, &q, &frames, read, &[(1, "branch")]);
    // One tool is the model's.
    let one = program.replace("  set_tcp(pen)\n", "");
    let answer = with_tool("urscript", &one, None);
    for k in [0, 2] {
        assert!(answer.targets[k].result.is_ok(), "{:?}", answer.targets[k]);
    }
}

#[test]
fn fanuc_positions_of_other_user_frames_and_tools_are_left() {
    let cell: String = bytes("cell.ls")
        .iter()
        .map(|b| char::from(*b))
        .filter(char::is_ascii)
        .collect();
    // The frame of number 1 stands elsewhere: in the controller.
    let framed = cell.replacen("UF : 0", "UF : 1", 1);
    let answer = with_tool("fanuc-ls", &framed, None);
    let found = answer.targets[0].result.as_ref().unwrap_err();
    assert_eq!(
        (found.reason, answer.left()),
        (Reason::Frame, 1),
        "{}",
        found.explanation
    );
    assert_eq!(answer.targets[0].place, (24, 1));
    let request = Request {
        frame: Some(Pose::identity()),
        ..request(arm(), framed.as_bytes(), "fanuc-ls")
    };
    assert_eq!(pipeline::compensate(&request).unwrap().left(), 0);
    // With two tools the model's has to be named; positions of the other are left.
    let tools = cell.replacen("UT : 1", "UT : 2", 1);
    assert_eq!(with_tool("fanuc-ls", &tools, None).left(), 8, "every pose");
    let answer = with_tool(
        "fanuc-ls",
        &tools,
        Some(ModelTool::Named("UT 1".to_owned())),
    );
    assert_eq!(answer.left(), 1);
    let error = pipeline::compensate(&Request {
        tool: Some(ModelTool::Named("UT 7".to_owned())),
        ..request_of(&tools)
    });
    assert!(error.unwrap_err().to_string().contains("no such tool"));
}

/// A listing of one pose with a configuration, `KONFIG` where the controller speaks German.
fn listed(head: &str, word: &str, configuration: &str) -> String {
    format!(
        "/PROG A\n/ATTR\n{head}\n/MN\n 1:J P[1] 9% CNT100 ;\n/POS\nP[1]{{ GP1: UF : 0, UT : 1, {word} : \
         '{configuration}', X = 162.222 mm, Y = 61.710 mm, Z = 296.163 mm, W = -46.7269 deg, P = -26.4136 deg, \
         R = -141.3534 deg }};\n"
    )
}

#[test]
fn fanuc_configurations_of_a_german_listing_are_those_of_the_english_one() {
    for configuration in ["N U T, 0, 0, 0", "F U T, 0, 0, 0"] {
        let values = |head, word| {
            let answer = compensated("fanuc-ls", listed(head, word, configuration).as_bytes());
            answer.targets[0].result.as_ref().unwrap().commanded.clone()
        };
        let english = values("OWNER = X;", "CONFIG");
        assert_eq!(values("EIGN. = X;", "KONFIG"), english);
        // Joint 5 of the arm is on the side that the letter says.
        assert_eq!(
            english[4] < 0.0,
            configuration.starts_with('N'),
            "{english:?}"
        );
    }
}

/// A KRL program and a listing that go to the same place: the world of a FANUC begins on axis 1 at the height of
/// axis 2, 290 mm above the base of this arm.
#[test]
fn fanuc_poses_are_in_the_world_of_the_controller() {
    let krl = "PTP {X 162.222,Y 61.710,Z 586.163,A -141.3534,B -26.4136,C -46.7269,S 0,T 18}\n";
    let start = Some(vec![2.2, 0.5, -0.1, -0.6, -0.4, -2.7]);
    let of = |language, text: &str| {
        let request = Request {
            start: start.clone(),
            ..request(arm(), text.as_bytes(), language)
        };
        pipeline::compensate(&request).unwrap()
    };
    let krl = of("krl", krl);
    let listing = of(
        "fanuc-ls",
        &listed("OWNER = X;", "CONFIG", "N U T, 0, 0, 0"),
    );
    let values = |answer: &Answer| answer.targets[0].result.clone().map(|w| w.commanded);
    let (a, b) = (values(&krl), values(&listing));
    let off = a
        .iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(a, b)| (a - b).abs());
    assert!(a.is_ok() && off.fold(0.0, f64::max) < 1e-9, "{a:?} {b:?}");
    let notes: Vec<String> = listing.notes.iter().map(ToString::to_string).collect();
    assert!(
        notes.iter().any(|note| note.contains("Z 290 mm")),
        "{notes:?}"
    );
}

/// Tools and user frames as a backup lists them: a frame is in the world.
#[test]
fn fanuc_frames_and_tools_come_from_the_backup_of_the_controller() {
    let system = "[*SYSTEM*]$MNUFRAME  Storage: SHADOW  Access: RW  : ARRAY[1,9] OF POSITION\n    [1,1] = \n  \
                  Group: 1   Config: N D B, 0, 0, 0\n  X:   100.000   Y:      .000   Z:    50.000\n  W:     0.000   P:     \
                  0.000   R:     0.000\n[*SYSTEM*]$MNUTOOL  Storage: SHADOW  Access: RW  : ARRAY[2,9] OF POSITION\n    \
                  [1,1] = \n  Group: 1   Config: N D B, 0, 0, 0\n  X:     0.000   Y:     0.000   Z:     0.000\n  W:     \
                  0.000   P:     0.000   R:     0.000\n    [2,1] = \n  Group: 1   Config: N D B, 0, 0, 0\n  X:     9.000   Y:     \
                  0.000   Z:     0.000\n  W:     0.000   P:     0.000   R:     0.000\n[*SYSTEM*]$MNUTOOLNUM  Storage: \
                  SHADOW\n    [1,1] = 7\n";
    let in_world = listed("OWNER = X;", "CONFIG", "N U T, 0, 0, 0");
    let in_frame = in_world
        .replace("UF : 0", "UF : 1")
        .replace("X = 162.222", "X = 62.222")
        .replace("Z = 296.163", "Z = 246.163");
    let beside = vec![Beside {
        path: Path::new("SYSFRAME.VA"),
        bytes: system.as_bytes(),
        named: true,
    }];
    let corrected = |text: &str, beside: Vec<Beside>| {
        let request = Request {
            beside,
            frames: ProgramFrames::as_programmed(),
            ..request(arm(), text.as_bytes(), "fanuc-ls")
        };
        pipeline::compensate(&request).unwrap()
    };
    let alone = corrected(&in_frame, Vec::new());
    assert_eq!(
        alone.targets[0].result.as_ref().unwrap_err().reason,
        Reason::Frame
    );
    let [one, other] = [&in_world, &in_frame].map(|text| corrected(text, beside.clone()));
    let values = |answer: &Answer| answer.targets[0].result.clone().unwrap().commanded;
    let off = values(&one)
        .iter()
        .zip(values(&other))
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(off < 1e-9, "{off}");
    assert!(!String::from_utf8(other.bytes).unwrap().contains("MNUTOOL"));
}

/// Tools and bases of the controller's own list, and what is wrong with it.
#[test]
fn krl_tools_and_bases_come_from_the_list_of_the_controller() {
    let program = "DEF m()\nBAS(#TOOL,2)\nBAS(#BASE,1)\nLIN {X 62.222,Y 61.710,Z 536.163,A -141.3534,B -26.4136,C \
                   -46.7269,S 0,T 18}\nEND\n";
    let list = "DEFDAT $CONFIG\nBASE_DATA[1]={x 100.0,y 0.0,z 50.0,a 0.0,b 0.0,c 0.0}\nTOOL_DATA[2]={x 0.0,y 0.0,z \
                0.0,a 0.0,b 0.0,c 0.0}\nENDDAT\n";
    let corrected = |list: Option<&str>| {
        let beside = list.map(|list| Beside {
            path: Path::new("$config.dat"),
            bytes: list.as_bytes(),
            named: true,
        });
        pipeline::compensate(&Request {
            beside: beside.into_iter().collect(),
            frames: ProgramFrames::as_programmed(),
            start: Some(vec![2.2, 0.5, -0.1, -0.6, -0.4, -2.7]),
            ..request(arm(), program.as_bytes(), "krl")
        })
    };
    let alone = corrected(None).unwrap();
    assert_eq!(
        alone.targets[0].result.as_ref().unwrap_err().reason,
        Reason::Frame
    );
    let answer = corrected(Some(list)).unwrap();
    assert_eq!(
        (answer.targets.len(), answer.left()),
        (1, 0),
        "{:?}",
        answer.targets
    );
    assert_eq!(
        String::from_utf8_lossy(&answer.bytes).matches('\n').count(),
        5
    );
    // What is wrong with the list is said with its own place.
    let wrong = corrected(Some("DEFDAT $CONFIG\nDECL E6POS XP={X 1,Y 2,Z\nENDDAT\n"));
    let says = wrong.unwrap_err().to_string();
    assert!(says.starts_with("$config.dat, line 2"), "{says}");
}

#[test]
fn a_fanuc_listing_in_another_language_is_refused_with_what_to_do() {
    let text = listed(
        "PROPRIETARIO = X;\nGRUPO = 1,*,*,*,*;",
        "CONFIG",
        "N U T, 0, 0, 0",
    );
    let error = pipeline::compensate(&request_of(&text))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("line 3, column 1") && error.contains("PROPRIETARIO"),
        "{error}"
    );
    assert!(error.contains("English"), "{error}");
}

fn request_of(program: &str) -> Request<'_> {
    request(arm(), program.as_bytes(), "fanuc-ls")
}

/// Runs the program; its status, output and messages.
fn truepose(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = crate::program::truepose().args(arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

/// The model of the arm in a file, as the command identifies it.
fn model_in(out: &Path) -> String {
    let model = out.join("arm.model.json").to_str().unwrap().to_owned();
    let session = folder().join("arm.json");
    let effects = "joint-zero-offset,link-length,joint-compliance";
    let session = session.to_str().unwrap();
    let (status, _, said) = truepose(&["identify", session, "--effects", effects, "--out", &model]);
    assert_eq!(status, Some(0), "{said}");
    model
}

#[test]
fn the_command_corrects_under_the_load_that_is_stated() {
    let out = tempfile::tempdir().unwrap();
    let file = |name: &str| out.path().join(name).to_str().unwrap().to_owned();
    let model = model_in(out.path());
    // Under the load of --load every target arrives.
    let (robot, value) = hidden("arm");
    let (cell, loaded) = (folder().join("cell.script"), file("loaded.script"));
    let cell = cell.to_str().unwrap();
    let (status, summary, said) =
        truepose(&["compensate", &model, cell, "--out", &loaded, "--load", "4"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(summary.contains("20 of 20 targets corrected"), "{summary}");
    let text = std::fs::read_to_string(&loaded).unwrap();
    let moves: Vec<&str> = text
        .lines()
        .filter(|l| l.contains("movej(["))
        .filter(|l| !l.contains('#'))
        .collect();
    let q: Vec<Vec<f64>> = rows(&value, "q_deg")
        .iter()
        .skip(1)
        .step_by(2)
        .map(|q| radians(q))
        .collect();
    let inline: Vec<Vec<f64>> = moves
        .iter()
        .map(|line| numbers(&line[line.find('[').unwrap()..line.find(']').unwrap()]))
        .collect();
    assert!(inline.len() >= 4);
    for corrected in &inline {
        let near = |q: &&Vec<f64>| q.iter().zip(corrected).all(|(a, b)| (a - b).abs() < 0.05);
        let commanded = rows(&value, "q_deg")
            .iter()
            .map(|q| radians(q))
            .collect::<Vec<_>>();
        let commanded = commanded.iter().chain(&q).find(near).unwrap();
        assert_arrives(&robot, commanded, corrected, 4.0, "under load");
    }
    let sidecar: serde_json::Value =
        serde_json::from_slice(&std::fs::read(file("loaded.script.meta.json")).unwrap()).unwrap();
    assert_eq!(sidecar["format"], "truepose-compensation/1");
    assert!(
        sidecar["targets"]
            .as_array()
            .unwrap()
            .iter()
            .all(|t| t["load_kg"] == 4.0)
    );
}

#[test]
fn the_command_names_what_it_leaves_with_its_line_and_says_so_with_its_status() {
    let out = tempfile::tempdir().unwrap();
    let file = |name: &str| out.path().join(name).to_str().unwrap().to_owned();
    let (model, cell) = (model_in(out.path()), folder().join("cell.script"));
    let cell = cell.to_str().unwrap();
    // A stretched wrist is corrected in position, and what is left of its orientation is said; unreachable and
    // ambiguous targets are named with line and reason, status 1.
    let table = file("left.csv");
    let rows = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n10,20,-30,40,50,60\n10,20,-30,40,0,60\n10,300,0,0,50,0\n";
    std::fs::write(&table, rows).unwrap();
    let (status, summary, said) =
        truepose(&["compensate", &model, &table, "--out", &file("left.out.csv")]);
    assert_eq!(status, Some(1), "{said}");
    assert!(summary.contains("2 of 3 targets corrected"), "{summary}");
    assert!(
        summary.contains("Orientation corrected in part: 1, ")
            && summary.contains("line 3, column 1: row 2: "),
        "{summary}"
    );
    assert!(
        said.lines()
            .any(|l| l.contains("line 4") && l.contains("(unreachable)")),
        "{said}"
    );
    let poses = file("poses.csv");
    std::fs::write(&poses, bytes("poses.csv")).unwrap();
    let (status, _, said) = truepose(&[
        "compensate",
        &model,
        &poses,
        "--out",
        &file("poses.out.csv"),
    ]);
    assert_eq!(status, Some(1));
    assert!(
        said.contains("line 2") && said.contains("(ambiguous)"),
        "{said}"
    );

    // A broken file: status 2, line and column, and nothing is written.
    let broken = file("broken.src");
    std::fs::write(&broken, "DEF m()\nPTP {A1 1,A1 2}\n").unwrap();
    let written = file("broken.out.src");
    let (status, _, said) = truepose(&["compensate", &model, &broken, "--out", &written]);
    assert_eq!(status, Some(2), "{said}");
    assert!(
        said.contains("line 2, column 11") && !Path::new(&written).exists(),
        "{said}"
    );
    let (status, _, said) = truepose(&[
        "compensate",
        &model,
        cell,
        "--out",
        &written,
        "--tool",
        "gripper",
    ]);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("no such tool"), "{said}");
}

#[test]
fn a_data_list_is_read_with_its_program_and_each_is_corrected_alone() {
    let out = tempfile::tempdir().unwrap();
    let file = |name: &str| out.path().join(name).to_str().unwrap().to_owned();
    let model = model_in(out.path());
    let axes = "A1 106,A2 65,A3 -25,A4 -63,A5 -53,A6 -18";
    let data =
        format!("DEFDAT cell\nDECL E6AXIS XP1={{{axes}}}\nDECL E6AXIS XP2={{{axes}}}\nENDDAT\n");
    let program = format!("DEF cell()\nPTP XP1\nPTP_REL XP2\nPTP {{{axes}}}\nEND\n");
    std::fs::write(file("cell.dat"), &data).unwrap();
    let run = |name: &str| {
        truepose(&[
            "compensate",
            &model,
            &file(name),
            "--out",
            &file("out"),
            "--force",
            "--json",
        ])
    };
    // Alone nothing says that anything goes to its points.
    let (status, _, said) = run("cell.dat");
    assert_eq!(status, Some(1), "{said}");
    assert!(
        said.contains("XP1: no motion of this file goes to it")
            || said.contains("no motion of this file"),
        "{said}"
    );
    std::fs::write(file("cell.src"), &program).unwrap();
    let corrected = |name: &str| {
        let (status, json, said) = run(name);
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        let targets = json["targets"].as_array().unwrap();
        let targets: Vec<(String, bool)> = targets
            .iter()
            .map(|t| {
                (
                    t["name"].as_str().unwrap().to_owned(),
                    t["corrected"] == true,
                )
            })
            .collect();
        (
            status,
            targets,
            json["at_run_time"].as_array().unwrap().len(),
            std::fs::read_to_string(file("out")).unwrap(),
            said,
        )
    };
    let (status, targets, listed, written, said) = corrected("cell.dat");
    assert_eq!(
        targets,
        [("XP1".to_owned(), true), ("XP2".to_owned(), false)]
    );
    assert_eq!((status, listed), (Some(1), 0), "{said}");
    assert!(said.contains("PTP_REL is a relative motion"), "{said}");
    assert!(written.starts_with("DEFDAT") && written.ends_with("ENDDAT\n") && written != data);
    let (status, targets, listed, written, said) = corrected("cell.src");
    assert_eq!(targets, [("target of PTP".to_owned(), true)]);
    assert_eq!((status, listed), (Some(0), 1), "{said}");
    assert!(
        written.starts_with("DEF cell()\nPTP XP1\n")
            && written.ends_with("END\n")
            && written != program
    );
    // Neither is written over, and one that is broken does not keep the other from being read.
    let over = truepose(&[
        "compensate",
        &model,
        &file("cell.src"),
        "--out",
        &file("cell.dat"),
        "--force",
    ]);
    assert_eq!(over.0, Some(2), "{}", over.2);
    std::fs::write(file("cell.dat"), "DECL E6AXIS XP1={A1 1,A1 2}\n").unwrap();
    assert_eq!(
        corrected("cell.src").1,
        [("target of PTP".to_owned(), true)]
    );
}
