//! Programs whose tool, base or load is not the model's, targets near singular poses, and large programs:
//! judged by a hidden robot that shares no code with the program.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::hidden_robot::{Hidden, Matrix, apart, times};
use truepose::compensation::VerifiedCalibration;
use truepose::effects::{Inputs, JointValues};
use truepose::fit::identify_exact;
use truepose::kinematics::{Pose, pose_from_parts};
use truepose::pipeline;
use truepose::programs::{
    Answer, CompensateError, DifferingNumber, ModelTool, Precedence, ProgramFrames, Request, find,
};
use truepose::sessions::load;

const DEG: f64 = std::f64::consts::PI / 180.0;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs")
}

fn hidden() -> (Hidden, Vec<Vec<f64>>) {
    let text = std::fs::read(folder().join("hidden.json")).unwrap();
    let all: serde_json::Value = serde_json::from_slice(&text).unwrap();
    let shown: Vec<Vec<f64>> = serde_json::from_value(all["arm"]["q_deg"].clone()).unwrap();
    let q = shown.iter().map(|q| q.iter().map(|v| v * DEG).collect());
    (Hidden::new(&all["arm"]), q.collect())
}

fn arm() -> &'static VerifiedCalibration {
    static ARM: OnceLock<VerifiedCalibration> = OnceLock::new();
    ARM.get_or_init(|| {
        let session = load(folder().join("arm.json")).unwrap().session;
        let effects = ["joint-zero-offset", "link-length", "joint-compliance"].map(str::to_owned);
        let answer = identify_exact(&session, &effects, JointValues::Commanded).unwrap();
        let inputs = Inputs::new(&session, JointValues::Commanded);
        pipeline::hand_out(&answer.calibration(&session, &inputs), &session).unwrap()
    })
}

fn corrected(
    language: &str,
    program: &str,
    frames: ProgramFrames,
    tool: Option<ModelTool>,
) -> Result<Answer, CompensateError> {
    pipeline::compensate(&Request {
        calibration: arm(),
        bytes: program.as_bytes(),
        language: find(language).unwrap(),
        file: None,
        beside: Vec::new(),
        load_kg: 0.0,
        start: None,
        frame: None,
        tool,
        frames,
        measured_frame: false,
    })
}

/// A tool of 40, 0, 120 mm that is turned by 30° about y.
fn gun() -> (Matrix, Pose) {
    let (s, c) = (30.0 * DEG).sin_cos();
    let (half_s, half_c) = (15.0 * DEG).sin_cos();
    let matrix = [
        [c, 0.0, s, 40.0],
        [0.0, 1.0, 0.0, 0.0],
        [-s, 0.0, c, 120.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let pose = pose_from_parts([40.0, 0.0, 120.0], [half_c, 0.0, half_s, 0.0]).unwrap();
    (matrix, pose)
}

/// x, y, z and A, B, C of `R_z(A) R_y(B) R_x(C)`, as KRL writes a pose.
fn krl(m: &Matrix) -> String {
    let b = (-m[2][0]).atan2(m[0][0].hypot(m[1][0])) / DEG;
    let a = m[1][0].atan2(m[0][0]) / DEG;
    let c = m[2][1].atan2(m[2][2]) / DEG;
    format!(
        "X {:.6},Y {:.6},Z {:.6},A {a:.8},B {b:.8},C {c:.8}",
        m[0][3], m[1][3], m[2][3]
    )
}

fn from_krl(line: &str) -> Matrix {
    let value = |key: &str| -> f64 {
        let rest = &line[line.find(&format!("{key} ")).unwrap() + 2..];
        let end = rest.find([',', '}']).unwrap();
        rest[..end].parse().unwrap()
    };
    let [a, b, c] = ["A", "B", "C"].map(|k| value(k) * DEG);
    let turn = |i: usize, j: usize, angle: f64| -> Matrix {
        let mut m: Matrix =
            std::array::from_fn(|r| std::array::from_fn(|k| f64::from(u8::from(r == k))));
        (m[i][i], m[i][j]) = (angle.cos(), -angle.sin());
        (m[j][i], m[j][j]) = (angle.sin(), angle.cos());
        m
    };
    let mut m = times(&times(&turn(0, 1, a), &turn(2, 0, b)), &turn(1, 2, c));
    for (row, key) in m.iter_mut().zip(["X", "Y", "Z"]) {
        row[3] = value(key);
    }
    m
}

/// Poses of the gun, in a base, as a KRL program; T says the configuration.
fn program(robot: &Hidden, q: &[Vec<f64>], base: &str) -> String {
    let (gun, _) = gun();
    let mut text = format!("DEF m()\n$TOOL={{{}}}\n{base}", krl(&gun));
    for q in q {
        let bits = q.iter().enumerate().map(|(k, v)| u32::from(*v < 0.0) << k);
        let pose = times(&robot.nominal(q), &gun);
        text += &format!("PTP {{{},T {}}}\n", krl(&pose), bits.sum::<u32>());
    }
    text + "END\n"
}

/// How far the gun on the real robot is from each pose of the program, mm and rad.
fn misses(robot: &Hidden, q: &[Vec<f64>], answer: &Answer) -> Vec<(f64, f64)> {
    let (gun, pose) = gun();
    let back = pose.inverse().to_homogeneous();
    let back: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| back[(i, j)]));
    let text = String::from_utf8(answer.bytes.clone()).unwrap();
    let lines = text.lines().filter(|line| line.starts_with("PTP"));
    let all = lines.zip(q).map(|(line, q)| {
        let flange = times(&from_krl(line), &back);
        let u = robot.nominal_inverse(&flange, q);
        apart(
            &times(&robot.real(&u, 0.0), &gun),
            &times(&robot.nominal(q), &gun),
        )
    });
    all.collect()
}

#[test]
fn a_foreign_tool_is_a_question_and_every_answer_to_it_is_kept() {
    let (robot, q) = hidden();
    let text = program(&robot, &q, "");
    let refused = corrected("krl", &text, ProgramFrames::default(), None);
    let Err(CompensateError::Differs(found)) = refused else {
        panic!("{refused:?}");
    };
    let says = found.to_string();
    assert_eq!(found.0.len(), 1);
    assert_eq!(
        (found.0[0].what, found.0[0].place),
        (DifferingNumber::Tool, (2, 7))
    );
    for part in [
        "X 40, Y 0, Z 120 mm",
        "B 30°",
        "X 0, Y 0, Z 0 mm",
        "--tool",
        "--as-modelled",
    ] {
        assert!(says.contains(part), "{part} in {says}");
    }
    // As the program writes it, or as it is given: the gun goes where the nominal robot would put it.
    let given = ProgramFrames {
        tool: Precedence::Given(gun().1),
        ..ProgramFrames::default()
    };
    for frames in [given, ProgramFrames::as_programmed()] {
        let answer = corrected("krl", &text, frames, None).unwrap();
        assert_eq!(answer.left(), 0);
        for (mm, rad) in misses(&robot, &q, &answer) {
            assert!(mm < 3e-3 && rad < 1e-5, "{mm} mm, {rad} rad");
        }
    }
    // Taken for the model's, as before, it misses.
    let answer = corrected("krl", &text, ProgramFrames::as_modelled(), None).unwrap();
    let worst = misses(&robot, &q, &answer)
        .iter()
        .map(|m| m.0)
        .fold(0.0, f64::max);
    assert!(worst > 0.3, "{worst}");
    assert!(
        answer
            .notes
            .iter()
            .any(|n| n.contains("taken for the model's"))
    );
    // Of a model whose tool is the gun, nothing differs.
    let own = Some(ModelTool::OnFlange(gun().1));
    assert!(corrected("krl", &text, ProgramFrames::default(), own).is_ok());
}

#[test]
fn a_base_that_is_not_the_robots_is_a_question() {
    let (robot, q) = hidden();
    let text = program(&robot, &q, "$BASE={X 100,Y -20,Z 5,A 90,B 0,C 0}\n");
    let tool = Precedence::Given(gun().1);
    let only_tool = ProgramFrames {
        tool,
        ..ProgramFrames::default()
    };
    let refused = corrected("krl", &text, only_tool, None);
    let Err(CompensateError::Differs(found)) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(found.0[0].what, DifferingNumber::Frame);
    assert!(found.to_string().contains("--frame"), "{found}");
    for frame in [
        Precedence::Program,
        Precedence::Model,
        Precedence::Given(Pose::identity()),
    ] {
        let settled = ProgramFrames { frame, ..only_tool };
        assert!(corrected("krl", &text, settled, None).is_ok(), "{frame:?}");
    }
}

#[test]
fn a_load_beyond_those_of_the_session_is_a_question_and_one_of_them_is_taken() {
    let (_, q) = hidden();
    let joints: Vec<String> = q[0].iter().map(|v| format!("{v:.6}")).collect();
    let text = |kg: f64| {
        format!(
            "def m():\n  set_payload({kg})\n  movej([{}])\nend\n",
            joints.join(", ")
        )
    };
    let load_kg = |program: &str, frames| -> Result<f64, CompensateError> {
        let answer = corrected("urscript", program, frames, None)?;
        Ok(answer.targets[0].result.as_ref().unwrap().load_kg)
    };
    assert_eq!(arm().load_kg, Some([0.0, 5.0]));
    let unsettled = ProgramFrames::default();
    assert_eq!(load_kg(&text(2.5), unsettled).unwrap(), 2.5);
    let refused = load_kg(&text(12.0), unsettled);
    let Err(CompensateError::Differs(found)) = refused else {
        panic!("{refused:?}");
    };
    let says = found.to_string();
    assert!(
        says.contains("12 kg") && says.contains("0 to 5 kg"),
        "{says}"
    );
    let given = ProgramFrames {
        load: Precedence::Given(3.0),
        ..unsettled
    };
    assert_eq!(load_kg(&text(12.0), given).unwrap(), 3.0);
    assert_eq!(
        load_kg(&text(12.0), ProgramFrames::as_programmed()).unwrap(),
        12.0
    );
    assert_eq!(
        load_kg(&text(12.0), ProgramFrames::as_modelled()).unwrap(),
        0.0
    );
}

#[test]
fn near_a_stretched_wrist_the_position_is_right_and_no_joint_moves_far() {
    let (robot, q) = hidden();
    // Through the stretched wrist in steps of a twentieth of a degree, from each of the arm's poses.
    let mut rows = Vec::new();
    for q in q.iter().take(6) {
        for k in -60..=60 {
            let mut q = q.clone();
            q[4] = f64::from(k) * 0.05 * DEG;
            rows.push(q);
        }
    }
    let mut text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_owned();
    for q in &rows {
        let cells: Vec<String> = q.iter().map(|v| format!("{:.6}", v / DEG)).collect();
        text += &(cells.join(",") + "\n");
    }
    let answer = corrected("csv", &text, ProgramFrames::default(), None).unwrap();
    assert_eq!(answer.left(), 0);
    let (mut before, mut in_part) = (None, 0);
    for (k, (target, q)) in answer.targets.iter().zip(&rows).enumerate() {
        let written = target.result.as_ref().unwrap();
        let goal = robot.nominal(q);
        let (mm, rad) = apart(&robot.real(&written.corrected, 0.0), &goal);
        assert!(mm < 3e-3, "{k}: {mm} mm");
        // What is left of the orientation is what is said, and no more than there was.
        assert!((rad - written.rotation_rad[1]).abs() < 2e-5, "{k}");
        assert!(rad < written.rotation_rad[0] + 2e-4, "{k}: {rad}");
        in_part += usize::from(rad > 1e-5);
        let by: Vec<f64> = written
            .corrected
            .iter()
            .zip(q)
            .map(|(u, q)| u - q)
            .collect();
        let most = by.iter().map(|v| v.abs()).fold(0.0, f64::max);
        assert!(most < 0.2, "{k}: {most} rad");
        if let Some(before) = before.replace(by.clone())
            && k % 121 != 0
        {
            let change = by
                .iter()
                .zip(&before)
                .map(|(a, b): (&f64, &f64)| (a - b).abs());
            let change = change.fold(0.0, f64::max);
            assert!(change < 0.02, "{k}: a jump of {change} rad");
        }
    }
    assert!(in_part > 50, "{in_part}");
}

#[test]
fn the_same_program_four_times_as_long_takes_the_same_for_each_target() {
    let cell = std::fs::read(folder().join("cell.mod")).unwrap();
    let cell: String = cell
        .iter()
        .map(|b| char::from(*b))
        .filter(char::is_ascii)
        .collect();
    let one = corrected("rapid", &cell, ProgramFrames::default(), None).unwrap();
    let many = corrected("rapid", &cell.repeat(40), ProgramFrames::default(), None).unwrap();
    assert_eq!(many.targets.len(), 40 * one.targets.len());
    // Every repeat is corrected, and its motions are found again.
    let good = |answer: &Answer| answer.targets.iter().filter(|t| t.result.is_ok()).count();
    assert_eq!(good(&many), 40 * good(&one));
}
