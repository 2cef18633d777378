//! Tests of the URDF reader: a robot worked out by hand, every refusal, and noise.

use super::*;
use crate::kinematics::Range;
use proptest::prelude::*;

const ARM: &str = r#"<?xml version="1.0"?>
<robot name="two links" xmlns:xacro="http://ros.org/wiki/xacro">
  <material name="grey"><color rgba="1 1 broken 1"/></material>
  <link name="world"/>
  <link name="base"><visual><geometry><mesh/></geometry></visual></link>
  <link name="upper">
    <inertial><origin xyz="0.1 0 0"/><mass value="4"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <link name="camera"><inertial><origin xyz="0 0 0.1"/><mass value="4"/></inertial></link>
  <link name="slide"/>
  <link name="tool"><inertial><mass value="0.5"/></inertial></link>
  <joint name="stand" type="fixed">
    <origin xyz="0 0 0.4" rpy="0 0 1.5707963267948966"/><parent link="world"/><child link="base"/><axis xyz="0 0 0"/>
  </joint>
  <joint name="pan" type="revolute">
    <origin xyz="0.1 0 0"/><parent link="base"/><child link="upper"/><axis xyz="0 0 2"/>
    <limit lower="-1.5" upper="1.5" effort="1"/>
  </joint>
  <joint name="eye" type="fixed"><origin xyz="0.3 0 0"/><parent link="upper"/><child link="camera"/></joint>
  <joint name="reach" type="prismatic">
    <origin xyz="0.25 0 0" rpy="0 1.5707963267948966 0"/><parent link="upper"/><child link="slide"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.2" effort="1" velocity="1"/>
  </joint>
  <joint name="mount" type="fixed"><origin xyz="0 0 0.05"/><parent link="slide"/><child link="tool"/></joint>
  <gazebo><plugin name="x"><joint>pan</joint></plugin></gazebo>
</robot>"#;

fn read(text: &str, base: &str, tip: &str) -> Result<Robot, Rejected> {
    robot_from_urdf(text, Path::new("arm.urdf"), base, tip)
}

fn refusal(text: &str) -> String {
    read(text, "world", "tool").unwrap_err().to_string()
}

#[test]
fn an_arm_worked_out_by_hand_is_read_so() {
    let robot = read(ARM, "world", "tool").unwrap();
    assert_eq!(robot.name, "two links");
    let [pan, reach] = &robot.joints[..] else {
        panic!("two joints move");
    };
    assert_eq!((pan.name.as_str(), pan.kind), ("pan", JointKind::Revolute));
    assert!((pan.axis.point_mm - Point3::new(0.0, 100.0, 400.0)).norm() < 1e-12);
    assert!((pan.axis.direction.into_inner() - Vector3::z()).norm() < 1e-15);
    assert_eq!(
        pan.limits,
        Some(Range {
            from: -1.5,
            to: 1.5
        })
    );
    assert_eq!(reach.kind, JointKind::Prismatic);
    assert!((reach.axis.direction.into_inner() - Vector3::y()).norm() < 1e-15);
    assert_eq!(
        reach.limits,
        Some(Range {
            from: 0.0,
            to: 200.0
        })
    );
    let tool = robot.base_from_tool.translation.vector;
    assert!((tool - Vector3::new(0.0, 400.0, 400.0)).norm() < 1e-12);
}

#[test]
fn gear_ratios_are_those_of_transmissions_with_one_joint() {
    let with = |transmissions: &str| {
        let text = ARM.replace("</robot>", &format!("{transmissions}</robot>"));
        let robot = read(&text, "world", "tool").unwrap();
        [robot.joints[0].gear_ratio, robot.joints[1].gear_ratio]
    };
    let ros1 = r#"<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="pan">
        <hardwareInterface>PositionJointInterface</hardwareInterface></joint>
        <actuator name="m"><mechanicalReduction> 101 </mechanicalReduction></actuator></transmission>"#;
    assert_eq!(with(ros1), [Some(101.0), None]);
    let ros2 = r#"<transmission name="t"><joint name="pan"><mechanical_reduction>-50.5</mechanical_reduction></joint>
        <actuator name="m"/></transmission>"#;
    assert_eq!(with(ros2), [Some(50.5), None]);
    for nothing in [
        "<mechanicalReduction>1</mechanicalReduction>",
        "<mechanicalReduction>many</mechanicalReduction>",
        "<mechanicalReduction/>",
    ] {
        let simulated = format!(r#"<transmission><joint name="pan"/>{nothing}</transmission>"#);
        assert_eq!(with(&simulated), [None; 2], "{nothing}");
    }
    // A slide turns nothing, and a differential has no ratio of one joint.
    let others = r#"<transmission><joint name="reach"/><mechanicalReduction>5</mechanicalReduction></transmission>
        <transmission><joint name="pan"/><joint name="reach"/><mechanicalReduction>5</mechanicalReduction></transmission>"#;
    assert_eq!(with(others), [None; 2]);
}

#[test]
fn a_links_mass_includes_what_is_fixed_to_it() {
    let robot = read(ARM, "world", "tool").unwrap();
    let upper = robot.joints[0].link.unwrap();
    assert_eq!(upper.mass_kg, 8.0);
    // Halfway between the link's own centre, 0.1 m out, and the camera's, 0.3 m out and 0.1 m up.
    assert!((upper.centre_mm - Point3::new(0.0, 300.0, 450.0)).norm() < 1e-12);
    let tool = robot.joints[1].link.unwrap();
    assert_eq!(tool.mass_kg, 0.5);
    assert!((tool.centre_mm - Point3::new(0.0, 400.0, 400.0)).norm() < 1e-12);
}

#[test]
fn the_base_may_be_any_link_above_the_tip() {
    let robot = read(ARM, "upper", "tool").unwrap();
    assert_eq!(robot.joints.len(), 1);
    assert!(robot.base_from_tool.translation.vector.norm() - 300.0 < 1e-12);
}

/// Four bars: the forearm's joint is turned back by what the upper arm turns, with an offset, and a slide
/// copies the copy.
const PARALLELOGRAM: &str = r#"<robot name="palletizer">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="lift"/><link name="tool"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1"/></joint>
  <joint name="keep" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.6"/>
    <axis xyz="0 1 0"/><mimic joint="shoulder" multiplier="-1" offset="0.1"/></joint>
  <joint name="slide" type="prismatic"><parent link="fore"/><child link="lift"/><origin xyz="0.7 0 0"/>
    <axis xyz="1 0 0"/><mimic joint="keep" multiplier="0.2"/></joint>
  <joint name="end" type="fixed"><parent link="lift"/><child link="tool"/></joint>
</robot>"#;

#[test]
fn a_mimicked_joint_in_the_chain_is_followed() {
    let robot = read(PARALLELOGRAM, "base", "tool").unwrap();
    assert_eq!(robot.leading(&[0, 1, 2]), [0]);
    for shoulder in [0.0, 0.4, -0.9] {
        let mut q = [shoulder, 9.0, 9.0];
        robot.follow(&mut q);
        let (keep, slide_mm) = (0.1 - shoulder, 200.0 * (0.1 - shoulder));
        assert!(
            (q[1] - keep).abs() < 1e-15 && (q[2] - slide_mm).abs() < 1e-12,
            "{q:?}"
        );
        // The forearm keeps its attitude: 0.1 rad, wherever the shoulder is.
        let tool = robot.base_from_tool(&q);
        let reach = 700.0 + slide_mm;
        let expected = Vector3::new(
            600.0 * f64::sin(shoulder) + reach * f64::cos(0.1),
            0.0,
            500.0 + 600.0 * f64::cos(shoulder) - reach * f64::sin(0.1),
        );
        assert!((tool.translation.vector - expected).norm() < 1e-9);
        // Counted from another home the coupling is the same.
        let at = [0.3, -0.2, 5.0];
        let other = robot.rehomed(&at);
        let mut counted = [shoulder - at[0], 0.0, 0.0];
        other.follow(&mut counted);
        let apart = other.base_from_tool(&counted).translation.vector - expected;
        assert!(apart.norm() < 1e-9, "{apart}");
    }
    for (mimic, told) in [
        (r#"<mimic joint="keep"/>"#, "mimics 'keep', which mimics it"),
        (r#"<mimic joint="slide"/>"#, "which mimics it"),
        ("<mimic/>", "joint"),
    ] {
        let text = PARALLELOGRAM.replace(
            r#"<mimic joint="shoulder" multiplier="-1" offset="0.1"/>"#,
            mimic,
        );
        let refused = read(&text, "base", "tool").unwrap_err().to_string();
        assert!(refused.contains(told), "{refused}");
    }
}

#[test]
fn every_refusal_names_the_file_and_what_was_expected() {
    let with = |from: &str, to: &str| {
        assert!(ARM.contains(from), "{from}");
        refusal(&ARM.replacen(from, to, 1))
    };
    let cases = [
        (refusal("not xml at all"), "line 1"),
        (refusal(&ARM[..ARM.len() - 9]), "well-formed XML"),
        (
            with("type=\"revolute\"", "type=\"floating\""),
            "a floating joint",
        ),
        (
            with("type=\"revolute\"", "type=\"planar\""),
            "a planar joint",
        ),
        (with("type=\"revolute\"", "type=\"bendy\""), "bendy"),
        (with("0 0 2", "0 0 0"), "zero length"),
        (with("0 0 2", "0 0 nan"), "line 16"),
        (
            with("<limit lower=\"-1.5\"", "<mimic joint=\"gripper\"/><limit"),
            "mimics 'gripper', which is not between base and tip",
        ),
        (
            with("<parent link=\"base\"/>", "<parent link=\"gone\"/>"),
            "'gone' that is not in the file",
        ),
        (
            with("<parent link=\"base\"/>", "<parent link=\"tool\"/>"),
            "no chain of joints",
        ),
        (with("<parent link=\"base\"/>", ""), "without <parent>"),
        (
            with("link name=\"camera\"", "link name=\"upper\""),
            "two links called 'upper'",
        ),
        (
            with("<child link=\"camera\"/>", "<child link=\"slide\"/>"),
            "hangs on",
        ),
        (with("xyz=\"0 0 0.4\"", "xyz=\"0 0 1e306\""), "expected"),
    ];
    for (message, part) in cases {
        assert!(message.starts_with("arm.urdf"), "{message}");
        assert!(message.contains(part), "{part}: {message}");
        assert!(message.contains("expected"), "{message}");
    }
    let unknown = read(ARM, "wold", "tool").unwrap_err().to_string();
    assert!(unknown.contains("no link 'wold' for the base; expected one of 'world'"));
    let upside_down = read(ARM, "tool", "world").unwrap_err().to_string();
    assert!(upside_down.contains("no chain of joints from 'tool' to 'world'"));
    let still = read(ARM, "slide", "tool").unwrap_err().to_string();
    assert!(still.contains("without a moving joint"));
}

#[test]
fn a_file_that_is_missing_or_a_folder_or_binary_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let binary = folder.path().join("binary.urdf");
    std::fs::write(&binary, [0xff, 0xfe, 0x00]).unwrap();
    let missing = folder.path().join("missing.urdf");
    for path in [folder.path(), &binary, &missing] {
        let refused = crate::kinematics::robot_from_file(path, None, "a", "b").unwrap_err();
        assert_eq!(refused.diagnostics[0].place.file.as_deref(), Some(path));
    }
    let good = folder.path().join("arm.urdf");
    std::fs::write(&good, ARM).unwrap();
    assert!(crate::kinematics::robot_from_file(&good, None, "world", "tool").is_ok());
}

/// Pieces that XML readers stumble over.
fn shard() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<String>(),
        Just("<".to_owned()),
        Just("/>".to_owned()),
        Just("\"".to_owned()),
        Just("&#0;".to_owned()),
        Just("&lol;".to_owned()),
        Just("<![CDATA[".to_owned() + &"]".repeat(300) + ">"),
        Just(" xmlns=\"\" ".to_owned()),
        Just(" xmlns:a='b' a:c='d' ".to_owned()),
        Just("<a:link name='x'/>".to_owned()),
        Just("<limit/>".to_owned()),
        Just("<origin xyz='1 2 3'/>".to_owned()),
        Just("<!DOCTYPE a [ <!ENTITY b 'c'> ]>".to_owned()),
        Just(" limit=\"1\" ".to_owned()),
        Just("inf".to_owned()),
        Just("1e308".to_owned()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn no_damage_makes_it_panic(
        cuts in prop::collection::vec((0.0..1.0_f64, 0usize..60, shard()), 1..4),
    ) {
        let mut text = ARM.to_owned();
        for (at, length, shard) in cuts {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ at < 1")]
            let start = text.floor_char_boundary((at * text.len() as f64) as usize);
            let end = text.ceil_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end, &shard);
        }
        // Whatever it answers, it answers; and a robot that it accepts has only finite numbers.
        if let Ok(robot) = read(&text, "world", "tool") {
            prop_assert!(robot.base_from_tool.translation.vector.iter().all(|x| x.is_finite()));
        }
    }
}
