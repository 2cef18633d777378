//! Tests of the MJCF reader: an arm worked out by hand, and every refusal. Against the `mujoco`
//! package: `tests/core/robots.rs`.

use super::*;

const ARM: &str = r#"<mujoco model="two">
  <compiler angle="radian" eulerseq="zyx"/>
  <default>
    <joint axis="0 1 0"/>
    <default class="sliding"><joint type="slide" axis="1 0 0" range="-0.1 0.2"/></default>
  </default>
  <worldbody>
    <body name="column" pos="0 0 0.4" euler="1.5707963267948966 0 0">
      <inertial pos="0 0 0.1" mass="3" diaginertia="1 1 1"/>
      <joint name="pan" axis="0 0 2" range="-1 1" ref="0"/>
      <frame pos="0.3 0 0">
        <body name="arm" childclass="sliding">
          <joint/>
          <geom size="0.1"/>
          <site name="tip" pos="0.1 0 0"/>
        </body>
      </frame>
    </body>
    <body name="ball"><joint type="ball"/><body name="behind"><joint name="hinge"/></body></body>
  </worldbody>
</mujoco>"#;

fn read(text: &str, base: &str, tip: &str) -> Result<Robot, Rejected> {
    robot_from_mjcf(text, Path::new("arm.xml"), base, tip)
}

#[test]
fn an_arm_worked_out_by_hand_is_read_so() {
    let robot = read(ARM, "world", "tip").unwrap();
    assert_eq!(robot.name, "two");
    let [pan, slide] = &robot.joints[..] else {
        panic!("two joints move");
    };
    assert_eq!((pan.name.as_str(), pan.kind), ("pan", JointKind::Revolute));
    assert!((pan.axis.point_mm - Point3::new(0.0, 0.0, 400.0)).norm() < 1e-12);
    let limits = pan.limits.unwrap();
    assert_eq!([limits.from, limits.to], [-1.0, 1.0]);
    let link = pan.link.unwrap();
    assert_eq!(link.mass_kg, 3.0);
    assert!((link.centre_mm - Point3::new(0.0, 0.0, 500.0)).norm() < 1e-12);
    assert_eq!(
        (slide.name.as_str(), slide.kind),
        ("joint 2", JointKind::Prismatic)
    );
    assert!((slide.axis.direction.into_inner() - Vector3::y()).norm() < 1e-15);
    let limits = slide.limits.unwrap();
    assert_eq!([limits.from, limits.to], [-100.0, 200.0]);
    // Its mass would come from a shape.
    assert_eq!(slide.link, None);
    let tool = robot.base_from_tool.translation.vector;
    assert!((tool - Vector3::new(0.0, 400.0, 400.0)).norm() < 1e-12);
}

#[test]
fn every_refusal_names_the_file_its_line_and_what_was_expected() {
    let with = |from: &str, to: &str| {
        assert!(ARM.contains(from), "{from}");
        let read = read(&ARM.replacen(from, to, 1), "world", "tip");
        read.unwrap_err().to_string()
    };
    let cases = [
        (with("<mujoco model=\"two\">", "<robot>"), "well-formed"),
        (with("radian", "grad"), "line 2, column 13: angle=\"grad\""),
        (with("zyx", "zyw"), "eulerseq"),
        (
            with("childclass=\"sliding\"", "childclass=\"gone\""),
            "line 14, column 11: a default class 'gone'",
        ),
        (with("axis=\"0 0 2\"", "axis=\"0 0 0\""), "zero length"),
        (with("axis=\"0 0 2\"", "type=\"ball\""), "a ball joint"),
        (with("axis=\"0 0 2\"", "type=\"weld\""), "type=\"weld\""),
        (with("pos=\"0.3 0 0\"", "pos=\"0.3 0\""), "line 11"),
        (
            with("pos=\"0.3 0 0\"", "euler=\"0 0 1\" zaxis=\"0 0 1\""),
            "both euler and zaxis",
        ),
        (
            with("<geom size=\"0.1\"/>", "<include file=\"x.xml\"/>"),
            "x.xml",
        ),
        (
            with(
                "</worldbody>",
                "</worldbody><equality><joint joint1=\"pan\"/></equality>",
            ),
            "follows a constant",
        ),
    ];
    for (message, part) in cases {
        assert!(message.starts_with("arm.xml, line "), "{message}");
        assert!(message.contains(part), "{part}: {message}");
        assert!(message.contains("expected"), "{message}");
    }
    for (base, tip, part) in [
        (
            "wold",
            "tip",
            "no body or site 'wold' for the base; expected one of 'world'",
        ),
        ("tip", "world", "no chain of joints from 'tip' to 'world'"),
        ("arm", "tip", "without a moving joint"),
        ("world", "behind", "a ball joint"),
        ("world", "", "no body or site ''"),
    ] {
        let message = read(ARM, base, tip).unwrap_err().to_string();
        assert!(message.contains(part), "{part}: {message}");
    }
    assert_eq!(read(ARM, "ball", "behind").unwrap().joints.len(), 1);
}
