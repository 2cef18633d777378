//! Robots in: every way in which a session may describe one. URDF and MJCF against the `mujoco`,
//! `yourdfpy` and `pinocchio` packages (`tests/reference/robots_in.py` made the numbers), rows and
//! what stands beside a description against what it means.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use serde::Deserialize;
use truepose::kinematics::{
    DescriptionFormat, JointKind, Robot, RobotSource, robot_from_file, robot_from_mjcf,
    robot_from_urdf,
};
use truepose::sessions::{Replacing, load, parse, parse_robot, save};

#[derive(Deserialize)]
struct Case {
    format: String,
    text: Option<String>,
    file: Option<String>,
    base: String,
    tip: String,
    joints: Vec<JointCase>,
    poses: Vec<PoseCase>,
}

#[derive(Deserialize)]
struct JointCase {
    name: String,
    kind: String,
    /// Degrees or mm.
    limits: Option<[f64; 2]>,
}

#[derive(Deserialize)]
struct PoseCase {
    q: Vec<f64>,
    position_mm: [f64; 3],
    rotation: [[f64; 3]; 3],
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots")
}

fn cases() -> Vec<Case> {
    let text = std::fs::read_to_string(folder().join("in.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn robot_of(case: &Case) -> Robot {
    let (base, tip) = (&case.base, &case.tip);
    let file = Path::new("case.xml");
    match (&case.text, &case.file) {
        (Some(text), _) if case.format == "urdf" => robot_from_urdf(text, file, base, tip),
        (Some(text), _) => robot_from_mjcf(text, file, base, tip),
        (None, file) => {
            let path = folder().join(file.as_deref().unwrap());
            robot_from_file(&path, None, base, tip).map(|read| read.robot)
        }
    }
    .unwrap()
}

#[test]
fn other_peoples_programs_put_the_tip_in_the_same_place() {
    let mut poses = 0;
    for (number, case) in cases().iter().enumerate() {
        let robot = robot_of(case);
        assert_eq!(robot.joints.len(), case.joints.len(), "case {number}");
        for (joint, wanted) in robot.joints.iter().zip(&case.joints) {
            assert_eq!(joint.name, wanted.name, "case {number}");
            assert_eq!(joint.kind.name(), wanted.kind, "case {number}");
            let limits = joint
                .limits
                .map(|l| [joint.kind.to_display(l.from), joint.kind.to_display(l.to)]);
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
            match (limits, wanted.limits) {
                (None, None) => {}
                (Some(a), Some(b)) => assert!(a.iter().zip(&b).all(near), "{a:?} {b:?}"),
                (a, b) => panic!("case {number}, {}: {a:?} {b:?}", joint.name),
            }
        }
        for pose in &case.poses {
            let tool = robot.base_from_tool(&pose.q);
            let off = tool.translation.vector - nalgebra::Vector3::from(pose.position_mm);
            // 1e-9 of a metre would be 1e-6.
            assert!(off.norm() < 1e-9, "case {number}: {off}");
            let rotation = tool.rotation.to_rotation_matrix();
            for (row, wanted) in pose.rotation.iter().enumerate() {
                for (column, wanted) in wanted.iter().enumerate() {
                    let off = (rotation[(row, column)] - wanted).abs();
                    assert!(off < 1e-12, "case {number}: {off}");
                }
            }
            poses += 1;
        }
        let frames = robot.link_frames();
        for (frame, joint) in frames.iter().zip(&robot.joints) {
            assert!((frame.translation.vector - joint.axis.point_mm.coords).norm() < 1e-9);
        }
        assert!(matches!(robot.source, RobotSource::Links(_)));
    }
    assert!(poses > 200, "{poses}");
}

#[test]
fn an_included_file_counts_among_the_inputs() {
    let path = folder().join("including.xml");
    let read = robot_from_file(&path, Some(DescriptionFormat::Mjcf), "world", "tip").unwrap();
    let names: Vec<&str> = read
        .files
        .iter()
        .map(|file| file.file_name().unwrap().to_str().unwrap())
        .collect();
    assert_eq!(names, ["including.xml", "settings.xml", "arm.xml"]);
    let wrong = robot_from_file(&path, Some(DescriptionFormat::Urdf), "world", "tip");
    assert!(wrong.unwrap_err().to_string().contains("expected <robot>"));
}

#[test]
fn an_include_that_leads_out_of_the_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("ä model.xml");
    for (name, part) in [
        ("../x.xml", "leads elsewhere"),
        ("/etc/passwd", "leads elsewhere"),
        ("gone.xml", "gone.xml"),
        ("ä model.xml", "second time"),
    ] {
        let text = format!("<mujoco>\r\n<include file=\"{name}\"/></mujoco>");
        std::fs::write(&model, format!("\u{feff}{text}")).unwrap();
        let refused = robot_from_file(&model, None, "world", "tip").unwrap_err();
        let message = refused.to_string();
        assert!(
            message.contains("ä model.xml, line 2, column 10"),
            "{message}"
        );
        assert!(
            message.contains(part) && message.contains("expected"),
            "{message}"
        );
    }
}

/// A robot object on its own.
fn parsed(text: &str) -> Result<Robot, String> {
    parse_robot(text.as_bytes())
        .map(|read| read.robot)
        .map_err(|rejected| rejected.to_string())
}

const ROWS: &str = r#"{"name":"scara","dh":[
 {"a_mm":300,"alpha_deg":0,"d_mm":200,"theta_deg":0,"convention":"standard"},
 {"a_mm":250,"alpha_deg":180,"d_mm":0,"theta_deg":0,"convention":"standard","kind":"revolute"},
 {"a_mm":0,"alpha_deg":0,"d_mm":50,"theta_deg":90,"convention":"standard","kind":"prismatic"},
 {"a_mm":0,"alpha_deg":0,"d_mm":0,"theta_deg":0,"convention":"standard"}],
 "limits":[[-130,130],null,[0,180],null],
 "masses":[{"mass_kg":4,"centre_mm":[150,0,200]},null,{"mass_kg":null,"centre_mm":null},null],
 "gravity_m_s2":[0,0,-9.81]}"#;

#[test]
fn rows_may_slide_and_what_stands_beside_them_counts() {
    let robot = parsed(ROWS).unwrap();
    assert_eq!(robot.joints[2].kind, JointKind::Prismatic);
    // Down by 50 at home and by the joint's value: its z points down.
    let tool = robot
        .base_from_tool(&[0.0, 0.0, 30.0, 0.0])
        .translation
        .vector;
    assert!(
        (tool - nalgebra::Vector3::new(550.0, 0.0, 120.0)).norm() < 1e-9,
        "{tool}"
    );
    let limits = robot.joints[2].limits.unwrap();
    assert_eq!([limits.from, limits.to], [0.0, 180.0]);
    assert!((robot.joints[0].limits.unwrap().to - 130_f64.to_radians()).abs() < 1e-15);
    assert_eq!(robot.joints[1].limits, None);
    let masses: Vec<Option<f64>> = robot
        .joints
        .iter()
        .map(|j| j.link.map(|l| l.mass_kg))
        .collect();
    assert_eq!(masses, [Some(4.0), None, None, None]);
    assert_eq!(
        robot.gravity_m_s2,
        Some(nalgebra::Vector3::new(0.0, 0.0, -9.81))
    );

    let tool = r#""tool":{"position_mm":[600,0,100],"quaternion_wxyz":[0,1,0,0]},"limits""#;
    let with_tool = parsed(&ROWS.replacen("\"limits\"", tool, 1)).unwrap();
    assert_eq!(with_tool.base_from_tool.translation.vector.x, 600.0);
    assert_eq!(with_tool.joints[0].axis, robot.joints[0].axis);
    let base = r#""base":{"position_mm":[0,0,1000],"quaternion_wxyz":[1,0,0,0]},"limits""#;
    let raised = parsed(&ROWS.replacen("\"limits\"", base, 1)).unwrap();
    let lift = raised.base_from_tool.translation.vector - robot.base_from_tool.translation.vector;
    assert!((lift - nalgebra::Vector3::new(0.0, 0.0, 1000.0)).norm() < 1e-9);
    let nothing = ROWS.replacen("[{\"mass_kg\":4,\"centre_mm\":[150,0,200]},null,{\"mass_kg\":null,\"centre_mm\":null},null]", "[null,null,null,null]", 1);
    assert!(
        parsed(&nothing)
            .unwrap()
            .joints
            .iter()
            .all(|joint| joint.link.is_none())
    );
}

#[test]
fn what_is_wrong_beside_a_description_is_refused_with_its_place() {
    for (from, to, part) in [
        ("[-130,130]", "[130,-130]", "line 6, column 12, limits[0]"),
        (
            "null,[0,180],null]",
            "null]",
            "an array with 4 entries, one for each joint",
        ),
        ("\"mass_kg\":4", "\"mass_kg\":-4", "a mass of 0 kg or more"),
        ("\"mass_kg\":4,", "", "masses[0]"),
        ("[150,0,200]", "[150,0]", "masses[0].centre_mm"),
        ("\"prismatic\"", "\"sliding\"", "dh[2].kind"),
        (
            "\"limits\":",
            "\"tool\":{},\"limits\":",
            "tool: no key 'position_mm'",
        ),
        ("\"name\"", "\"urdf\":{},\"name\"", "dh and urdf"),
    ] {
        assert!(ROWS.contains(from), "{from}");
        let message = parsed(&ROWS.replacen(from, to, 1)).unwrap_err();
        assert!(
            message.contains(part) && message.contains("expected"),
            "{part}: {message}"
        );
    }
}

#[test]
fn a_session_names_a_chain_of_an_mjcf_file_and_keeps_its_frames_when_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let case = cases()
        .into_iter()
        .find(|c| c.format == "mjcf" && c.text.is_some())
        .unwrap();
    std::fs::write(folder.path().join("arm.xml"), case.text.as_ref().unwrap()).unwrap();
    let columns: Vec<String> = case
        .joints
        .iter()
        .enumerate()
        .map(|(k, joint)| {
            let unit = if joint.kind == "revolute" {
                "deg"
            } else {
                "mm"
            };
            format!("\"q{}_{unit}\":[1]", k + 1)
        })
        .collect();
    let text = format!(
        r#"{{"format":"truepose-session/1","name":"s","robot":{{"name":"r","mjcf":{{"file":"arm.xml",
        "base":"{}","tip":"{}"}}}},"samples":{{"columns":{{{},"x_mm":[1],"y_mm":[2],"z_mm":[3]}}}}}}"#,
        case.base,
        case.tip,
        columns.join(",")
    );
    let path = folder.path().join("s.json");
    std::fs::write(&path, text).unwrap();
    let loaded = load(&path).unwrap();
    assert!(loaded.files.iter().any(|file| file.ends_with("arm.xml")));
    let robot = loaded.session.robot.clone();
    let saved = folder.path().join("saved.json");
    save(&loaded.session, &saved, Replacing::default()).unwrap();
    let again = load(&saved).unwrap().session.robot;
    let frames = robot.link_frames();
    assert!(matches!(again.source, RobotSource::Links(_)));
    for (a, b) in again.link_frames().iter().zip(&frames) {
        assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-12);
    }
    let rows = format!(
        r#"{{"format":"truepose-session/1","name":"s","robot":{ROWS},"samples":{{"columns":{{"q1_deg":[1],
        "q2_deg":[1],"q3_mm":[1],"q4_deg":[1],"x_mm":[1],"y_mm":[2],"z_mm":[3]}}}}}}"#
    );
    let session = parse(rows.as_bytes()).unwrap().session;
    save(
        &session,
        &folder.path().join("rows.json"),
        Replacing::default(),
    )
    .unwrap();
    let again = load(folder.path().join("rows.json")).unwrap().session.robot;
    assert_eq!(again, session.robot);
}
