//! Exports in the hands of programs that other people wrote. Each is run where it is installed and
//! skipped aloud where it is not: `check_urdf` (liburdfdom-tools), yourdfpy and pinocchio, blark,
//! LinuxCNC. The C compiler's turn is beside the header's own tests.

use crate::controllers;

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::exporting::{admitted, export, identified, joined, known, one_joint, text};
use crate::rig::{Design, Hidden, Random, Rig};
use truepose::effects::Term;
use truepose::export::{Export, gap_after_export};
use truepose::kinematics::robot_from_urdf;
use truepose::model::{Calibration, Model};
use truepose::sessions::parse;

fn saved(export: &Export, folder: &Path) -> PathBuf {
    let path = folder.join(&export.documents[0].name);
    std::fs::write(&path, &export.documents[0].bytes).expect("it can be written");
    path
}

fn reference(script: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/reference")
        .join(script)
}

/// What a program prints; `None` where it is not there, or says that something else is missing.
fn ran(command: &mut Command, input: &str) -> Option<String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let pipes = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let Ok(mut child) = pipes.spawn() else {
        eprintln!("skipped: {program} is not installed");
        return None;
    };
    let mut stdin = child.stdin.take().expect("it is piped");
    // A program that is missing a module ends before it reads.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if said.contains("ModuleNotFoundError") || said.contains("command not found") {
        eprintln!("skipped: {program}: {}", said.lines().last().unwrap_or(""));
        return None;
    }
    assert!(output.status.success(), "{program}: {said}");
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

type Vec3 = [f64; 3];

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// An arm of three turning joints (one without ends) and a slide, on paper.
struct Arm {
    /// Axis, point, whether it turns, offset in rad or mm.
    joints: [(Vec3, Vec3, bool, f64); 4],
    base: Vec3,
}

const TOOL: Vec3 = [620.0, 40.0, 410.0];

impl Arm {
    fn new() -> Self {
        Self {
            joints: [
                ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0], true, 0.004),
                ([0.0, 1.0, 0.0], [30.0, 0.0, 400.0], true, -0.007),
                ([0.6, 0.0, 0.8], [350.0, 10.0, 400.0], false, 0.8),
                ([1.0, 0.0, 0.0], [400.0, 0.0, 415.0], true, 0.011),
            ],
            base: [0.7, -0.4, 0.25],
        }
    }

    /// The tool's origin at these commands, by Rodrigues' formula, mm.
    fn tool(&self, q: &[f64]) -> Vec3 {
        let mut p = TOOL;
        for ((axis, point, turns, offset), q) in self.joints.iter().zip(q).rev() {
            let by = q + offset;
            if !turns {
                p = std::array::from_fn(|k| p[k] + by * axis[k]);
                continue;
            }
            let r: Vec3 = std::array::from_fn(|k| p[k] - point[k]);
            let (s, c) = by.sin_cos();
            let along: f64 = (0..3).map(|k| axis[k] * r[k]).sum();
            let x = cross(*axis, r);
            p = std::array::from_fn(|k| {
                point[k] + r[k] * c + x[k] * s + axis[k] * along * (1.0 - c)
            });
        }
        std::array::from_fn(|k| p[k] + self.base[k])
    }

    /// Its calibration, with something that no URDF can carry.
    fn calibration(&self) -> Calibration {
        let mut joints = String::new();
        for (k, (axis, point, turns, _)) in self.joints.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            let (kind, limits) = match (turns, k) {
                (true, 3) => ("revolute", String::new()),
                (true, _) => ("revolute", r#","limits":[-120,120]"#.to_owned()),
                (false, _) => ("prismatic", r#","limits":[0,300]"#.to_owned()),
            };
            let _ = write!(
                joints,
                r#"{comma}{{"name":"a{} & b","kind":"{kind}","axis":{axis:?},"point_mm":{point:?}{limits}}}"#,
                k + 1
            );
        }
        let text = format!(
            r#"{{"format":"truepose-session/1","name":"arm","robot":{{"name":"arm <1>","joints":[{joints}],
            "tool":{{"position_mm":{TOOL:?},"quaternion_wxyz":[0.5,0.5,0.5,0.5]}}}},"tolerance_mm":0.2,
            "samples":{{"columns":{{"q1_deg":[0],"q2_deg":[0],"q3_mm":[0],"q4_deg":[0],"x_mm":[0],"y_mm":[0],"z_mm":[0]}}}}}}"#
        );
        let session = parse(text.as_bytes()).expect("a good session").session;
        let mut calibration = known(&session, &[]);
        let mut terms: Vec<Term> = Vec::new();
        for (k, (_, _, turns, offset)) in self.joints.iter().enumerate() {
            let given = if *turns {
                ("offset_deg", offset.to_degrees())
            } else {
                ("offset_mm", *offset)
            };
            terms.push(
                Term::from_parameters("joint-zero-offset", k + 1, &[given], 4).expect("a term"),
            );
        }
        let [x, y, z] = self.base;
        let base = [("x_mm", x), ("y_mm", y), ("z_mm", z)];
        terms.push(Term::from_parameters("base-offset", 1, &base, 4).expect("a term"));
        let width = [("width_deg", 0.03)];
        terms.push(Term::from_parameters("backlash", 2, &width, 4).expect("a term"));
        calibration.model = Model::new(session.robot.clone(), terms);
        calibration
    }
}

fn random_poses(count: usize) -> Vec<[f64; 4]> {
    let mut random = Random(11);
    let mut turn = || random.between(-2.0, 2.0);
    (0..count)
        .map(|_| [turn(), turn(), 75.0 * (turn() + 2.0), turn()])
        .collect()
}

#[test]
fn the_urdf_of_an_arm_leads_where_the_arm_leads() {
    let arm = Arm::new();
    let made = export(&arm.calibration(), "urdf", None);
    let robot = robot_from_urdf(&text(&made), Path::new("arm.urdf"), "base_link", "tool0")
        .expect("it can be read");
    for q in random_poses(50) {
        let (tool, wanted) = (robot.base_from_tool(&q).translation.vector, arm.tool(&q));
        let off = (0..3)
            .map(|k| (tool[k] - wanted[k]).abs())
            .fold(0.0, f64::max);
        assert!(off < 1e-9, "{q:?}: {tool} {wanted:?}");
    }
    let says = joined(&made.notes);
    assert!(
        says.contains("backlash of joint 2 has no place in a URDF: it leaves"),
        "{says}"
    );
    assert_eq!(robot.joints[0].name, "a1 & b");
}

#[test]
fn independent_readers_put_the_tool_of_the_urdf_in_the_same_place() {
    let arm = Arm::new();
    let folder = tempfile::tempdir().expect("a folder");
    let path = saved(&export(&arm.calibration(), "urdf", None), folder.path());
    let poses = random_poses(20);
    let lines: Vec<String> = poses
        .iter()
        .map(|[a, b, c, d]| format!("{a} {b} {} {d}", c / 1e3))
        .collect();
    let names: Vec<String> = (1..=4).map(|k| format!("a{k} & b")).collect();
    let mut python = Command::new("python3");
    python
        .arg(reference("urdf_fk.py"))
        .arg(&path)
        .arg("tool0")
        .arg(names.join(","));
    let Some(printed) = ran(&mut python, &lines.join("\n")) else {
        return;
    };
    for reader in ["yourdfpy", "pinocchio"] {
        let rows: Vec<&str> = printed.lines().filter(|l| l.starts_with(reader)).collect();
        if rows.is_empty() {
            eprintln!("skipped: {reader} is not installed");
            continue;
        }
        assert_eq!(rows.len(), poses.len(), "{reader}");
        for (row, q) in rows.iter().zip(&poses) {
            let wanted = arm.tool(q);
            for (cell, wanted) in row.split(' ').skip(1).zip(wanted) {
                let metres: f64 = cell.parse().expect("a number");
                assert!(
                    (metres * 1e3 - wanted).abs() < 1e-9,
                    "{reader} at {q:?}: {row}"
                );
            }
        }
    }
}

#[test]
fn check_urdf_takes_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = saved(
        &export(&Arm::new().calibration(), "urdf", None),
        folder.path(),
    );
    if let Some(printed) = ran(Command::new("check_urdf").arg(path), "") {
        assert!(printed.contains("Successfully Parsed XML"), "{printed}");
    }
}

#[test]
fn a_tilted_column_that_was_measured_becomes_a_urdf_that_leaves_the_noise() {
    let mut random = Random(3);
    let design = Design {
        reflectors: 2,
        conditions: false,
        sigma_mm: 1e-6,
        ..Design::default()
    };
    let mut rig = Rig::new(&design, &mut random);
    rig.hidden = vec![
        Hidden::Tilt(8e-4, -5e-4),
        Hidden::BaseOffset([0.4, -0.3, 0.1]),
    ];
    rig.measure(&mut random);
    let session = parse(rig.json("tilted").as_bytes())
        .expect("a good session")
        .session;
    let effects = [
        "joint-zero-offset",
        "link-length",
        "axis-tilt",
        "base-offset",
    ];
    let made = export(&identified(&session, &effects), "urdf", None);
    // The rig's own geometry, which shares no code with the model.
    let robot = robot_from_urdf(&text(&made), Path::new("t.urdf"), "base_link", "tool0")
        .expect("it can be read");
    for shot in rig.shots.iter().filter(|shot| shot.target == 0) {
        let wanted = rig.point(shot, &rig.hidden);
        let tool = robot.base_from_tool(&[shot.q]).translation.vector;
        let off = (0..3)
            .map(|k| (tool[k] - wanted[k]).abs())
            .fold(0.0, f64::max);
        assert!(off < 1e-5, "{tool} {wanted:?}");
    }
    let calibration = identified(&session, &effects);
    let gap = gap_after_export(&calibration, &session, &made).expect("a gap");
    assert!(gap.max_mm < 1e-5, "{gap:?}");
}

#[test]
fn a_parser_of_structured_text_reads_the_table() {
    let session = one_joint("revolute", [-90.0, 90.0]);
    let eccentric: &[(&str, f64)] = &[("amplitude_deg", 0.3), ("phase_deg", 10.0)];
    let calibration = known(&session, &[("encoder-eccentricity", eccentric)]);
    let made = export(&calibration, "twincat-nc", None);
    let folder = tempfile::tempdir().expect("a folder");
    let path = saved(&made, folder.path());
    let mut python = Command::new("python3");
    let Some(printed) = ran(python.arg(reference("structured_text.py")).arg(path), "") else {
        return;
    };
    let entries = controllers::load("twincat-nc", &text(&made)).entries();
    assert_eq!(printed.lines().count(), entries.len());
    for (line, [place, added, _]) in printed.lines().zip(entries) {
        let cells: Vec<f64> = line
            .split(' ')
            .map(|c| c.parse().expect("a number"))
            .collect();
        assert_eq!(cells, [place, added], "{line}");
    }
}

/// LinuxCNC itself, without a display, driving one joint from either side.
#[test]
fn linuxcnc_adds_what_the_controller_on_paper_adds() {
    let mut there = Command::new("linuxcnc");
    there.arg("-h").stdout(Stdio::null()).stderr(Stdio::null());
    if there.status().is_err() {
        eprintln!("skipped: LinuxCNC (package linuxcnc-uspace) is not installed");
        return;
    }
    for (kind, unit, offset, width) in [
        ("revolute", "ANGULAR", "offset_deg", "width_deg"),
        ("prismatic", "LINEAR", "offset_mm", "width_mm"),
    ] {
        let session = one_joint(kind, [-170.0, 170.0]);
        let mut effects: Vec<(&str, &[(&str, f64)])> = Vec::new();
        let (zero, play) = ([(offset, 0.4)], [(width, 0.1)]);
        effects.push(("joint-zero-offset", &zero));
        effects.push(("joint-scale", &[("scale_ppm", 900.0)]));
        effects.push(("backlash", &play));
        if kind == "revolute" {
            let waves = &[("order", 30.0), ("amplitude_deg", 0.05), ("phase_deg", 0.0)];
            effects.push(("gear-transmission-error", waves));
        }
        let made = export(&known(&session, &effects), "linuxcnc", None);
        let folder = tempfile::tempdir().expect("a folder");
        let path = saved(&made, folder.path());
        let at = [
            "-200", "-170", "-93.217", "-1.5", "0", "44.4", "120.25", "169.9", "181",
        ];
        // LinuxCNC comes with modules for the system's own Python.
        let mut python = Command::new("/usr/bin/python3");
        python
            .arg(reference("linuxcnc_comp.py"))
            .arg(path)
            .arg(unit)
            .args(at);
        let Some(printed) = ran(&mut python, "") else {
            return;
        };
        let paper = controllers::load("linuxcnc", &text(&made));
        assert_eq!(printed.lines().count(), at.len(), "{printed}");
        for line in printed.lines() {
            let cells: Vec<f64> = line
                .split(' ')
                .map(|c| c.parse().expect("a number"))
                .collect();
            for (added, side) in [(cells[1], 1.0), (cells[2], -1.0)] {
                let own = paper.sends(cells[0], side) - cells[0];
                // It looks its table up a last time while it is still creeping, some 1e-4 away.
                assert!(
                    (added - own).abs() < 2e-5,
                    "{unit} {side}: {line}, on paper {own}"
                );
            }
        }
        eprintln!(
            "LinuxCNC agrees at {} positions from both sides ({unit})",
            at.len()
        );
    }
}

/// The lines that a controller or a compiler reads.
fn without_comments(bytes: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(bytes);
    let is_comment = |line: &str| ["//", "/*", "*"].iter().any(|sign| line.starts_with(sign));
    let lines = text.lines().filter(|line| !is_comment(line.trim_start()));
    lines.map(str::to_owned).collect()
}

/// Decimal points stay points where the locale writes commas; comments alone follow the language.
#[test]
fn the_locale_does_not_reach_the_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = one_joint("revolute", [-90.0, 90.0]);
    let zero: &[(&str, f64)] = &[("offset_deg", 0.1234)];
    let model = admitted(&known(&session, &[("joint-zero-offset", zero)])).document();
    let model_path = folder.path().join("m.json");
    std::fs::write(&model_path, model).expect("it can be written");
    let suits = |format: &&truepose::export::Format| (format.suits)(&session.robot);
    for format in truepose::export::EXPORTERS.iter().filter(suits) {
        let outputs = ["C", "de_DE.UTF-8"].map(|locale| {
            let done = crate::program::truepose()
                .args(["export", "--to", format.id, "--out", "-"])
                .arg(&model_path)
                .env("LC_ALL", locale)
                .env("LC_NUMERIC", locale)
                .output()
                .expect("it runs");
            assert!(
                done.status.success(),
                "{}",
                String::from_utf8_lossy(&done.stderr)
            );
            done.stdout
        });
        let [english, german] = outputs.each_ref().map(|bytes| without_comments(bytes));
        assert_eq!(english, german, "{}", format.id);
        assert!(!outputs[0].is_empty() && !outputs[0].contains(&b'\r'));
    }
}
