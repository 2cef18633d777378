//! Files as their sources write them, through the terminal: joints without points, angles, headings of other
//! programs, and names that clash. The robot is a pan and tilt head of exact geometry, worked out here.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fmt::Write as _;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};
use truepose::sessions::{Session, load};

/// Pan about z, then tilt about −y through (0, 0, 400); the tool 250 mm in front of it.
fn robot() -> String {
    json!({
        "name": "head",
        "joints": [
            { "name": "shoulder_pan_joint", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
            { "name": "tilt", "kind": "revolute", "axis": [0, -1, 0], "point_mm": [0, 0, 400] }
        ],
        "tool": { "position_mm": [250, 0, 400], "quaternion_wxyz": [1, 0, 0, 0] }
    })
    .to_string()
}

/// Where the tool is, mm, and the matrix of its orientation, row by row: Rz(pan) Ry(−tilt).
fn tool(pan: f64, tilt: f64) -> ([f64; 3], [[f64; 3]; 3]) {
    let ((sp, cp), (st, ct)) = (pan.sin_cos(), tilt.sin_cos());
    let matrix = [
        [cp * ct, -sp, -cp * st],
        [sp * ct, cp, -sp * st],
        [st, 0.0, ct],
    ];
    let at = |row: usize| 250.0 * matrix[row][0];
    ([at(0), at(1), 400.0 + at(2)], matrix)
}

/// Pan and tilt in rad, in measuring order.
fn poses() -> Vec<[f64; 2]> {
    let pan = [0.0, 0.4, 0.9, 0.9, 0.2, -0.6, -1.1, -0.3];
    let tilt = [0.1, 0.1, 0.5, -0.2, -0.4, 0.3, 0.6, 0.6];
    pan.into_iter().zip(tilt).map(|(p, t)| [p, t]).collect()
}

struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Self {
        let desk = Self(tempfile::tempdir().unwrap());
        desk.put("robot.json", &robot());
        desk
    }

    fn put(&self, name: &str, text: &str) {
        std::fs::write(self.0.path().join(name), text).unwrap();
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn run(&self, arguments: &str) -> Output {
        let mut command = crate::program::truepose();
        let words = arguments.split_whitespace();
        command
            .current_dir(self.path())
            .args(words)
            .output()
            .unwrap()
    }

    /// Imports a file that is to be accepted; the session and what was said.
    fn import(&self, arguments: &str) -> (Session, String) {
        let done = self.run(&format!("import {arguments} --robot robot.json --force"));
        let said = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(0), "{arguments}: {said}");
        let out = arguments
            .split_whitespace()
            .skip_while(|word| *word != "--out")
            .nth(1)
            .unwrap();
        (load(self.path().join(out)).unwrap().session, said)
    }

    /// Imports a file that is to be refused; what was said.
    fn refused(&self, arguments: &str) -> String {
        let done = self.run(&format!(
            "import {arguments} --robot robot.json --out refused.json"
        ));
        let said = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{arguments}: {said}");
        assert!(!self.path().join("refused.json").exists());
        said
    }
}

/// A table of these columns over all poses.
fn table(header: &str, row: impl Fn(usize, [f64; 2]) -> String) -> String {
    let mut text = header.to_owned();
    for (index, pose) in poses().into_iter().enumerate() {
        if !text.is_empty() {
            text.push('\n');
        }
        text += &row(index, pose);
    }
    text + "\n"
}

fn xyz(pose: [f64; 2]) -> String {
    let [x, y, z] = tool(pose[0], pose[1]).0;
    format!("{x:.9},{y:.9},{z:.9}")
}

/// Largest distance of a session's joint values from the poses, rad.
fn off_the_commands(session: &Session) -> f64 {
    let poses = poses();
    assert_eq!(session.samples.len(), poses.len());
    let off = |(row, pose): (usize, &[f64; 2])| {
        let apart = |joint: usize| (session.samples.q[joint][row] - pose[joint]).abs();
        apart(0).max(apart(1))
    };
    poses.iter().enumerate().map(off).fold(0.0, f64::max)
}

/// Largest distance of a session's points from where the tool was, mm.
fn off_the_points(session: &Session) -> f64 {
    let z_mm = session.samples.z_mm.as_ref().unwrap();
    let off = |(row, pose): (usize, [f64; 2])| {
        let [x, y, z] = tool(pose[0], pose[1]).0;
        let (dx, dy, dz) = (
            session.samples.x_mm[row] - x,
            session.samples.y_mm[row] - y,
            z_mm[row] - z,
        );
        (dx * dx + dy * dy + dz * dz).sqrt()
    };
    poses().into_iter().enumerate().map(off).fold(0.0, f64::max)
}

/// Largest distance of a session's orientations from those of the tool, as matrices.
fn off_the_orientations(session: &Session) -> f64 {
    let parts = session.samples.orientation_wxyz.as_ref().unwrap();
    let off = |(row, pose): (usize, [f64; 2])| {
        let [w, x, y, z] = [0, 1, 2, 3].map(|part: usize| parts[part][row]);
        let matrix = [
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ];
        let truth = tool(pose[0], pose[1]).1;
        let apart = matrix
            .iter()
            .flatten()
            .zip(truth.iter().flatten())
            .map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max)
    };
    poses().into_iter().enumerate().map(off).fold(0.0, f64::max)
}

#[test]
fn joint_values_alone_are_a_session_of_a_ball_in_sockets() {
    let desk = Desk::new();
    let names = ["S1", "S2"];
    desk.put(
        "franka.csv",
        &table("q1,q2,socket", |k, [p, t]| {
            format!("{p},{t},{}", names[k % 2])
        }),
    );
    let (session, said) = desk
        .import("franka.csv --as csv --angle-unit rad --socket-distances S1-S2=400 --out s.json");
    assert!(off_the_commands(&session) < 1e-12);
    let references = &session.instrument.references;
    assert_eq!(references.sockets.len(), 2);
    assert_eq!(references.socket_distances[0].between, [0, 1]);
    assert!(session.samples.x_mm.iter().all(|x| x.is_nan()));
    assert!(said.contains("to be fitted: 'S1', 'S2'"), "{said}");
    // One socket for all rows, and a table without a header.
    desk.put("bare.txt", &table("", |_, [p, t]| format!("{p} {t}")));
    let (session, _) = desk
        .import("bare.txt --as csv --angle-unit rad --columns q1,q2 --socket cup --out bare.json");
    assert_eq!(session.instrument.references.sockets[0].name, "cup");
    let refused = desk.refused("bare.txt --as csv --angle-unit rad --columns q1,q2");
    assert!(refused.contains("2 columns and no header"), "{refused}");
    // Touches, with words for the columns.
    desk.put(
        "touch.csv",
        &table("a;b;flat", |k, [p, t]| format!("{p};{t};P{}", k % 3)),
    );
    let (session, _) =
        desk.import("touch.csv --as csv --columns q1_rad,q2_rad,plane --out touch.json");
    assert_eq!(session.instrument.references.planes.len(), 3);
    let answer = desk.run("identify touch.json --json");
    assert_eq!(
        answer.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&answer.stderr)
    );
}

#[test]
fn distances_with_their_anchors_and_a_single_coordinate_are_enough() {
    let desk = Desk::new();
    desk.put(
        "distances.csv",
        &table("q1_rad,q2_rad,distance_mm,anchor", |k, pose| {
            let [x, y, z] = tool(pose[0], pose[1]).0;
            let far = ((x - 500.0).powi(2) + y * y + z * z).sqrt();
            format!("{},{},{far},A{}", pose[0], pose[1], k % 2)
        }),
    );
    desk.put("known.csv", "name,x_mm,y_mm,z_mm\nA0,500,0,0\nA1,500,0,0\n");
    let (session, _) = desk.import("distances.csv --as csv --reference known.csv --out d.json");
    let anchors = &session.instrument.references.anchors;
    assert!(
        anchors.iter().all(|anchor| anchor.position_mm.is_some()),
        "{anchors:?}"
    );
    // A dial gauge over the table: z only.
    desk.put(
        "height.csv",
        &table("q1_rad,q2_rad,z_mm", |_, pose| {
            format!("{},{},{}", pose[0], pose[1], tool(pose[0], pose[1]).0[2])
        }),
    );
    let (session, _) = desk.import("height.csv --as csv --out h.json");
    assert!(session.samples.x_mm.iter().all(|x| x.is_nan()));
    assert!((session.samples.z_mm.unwrap()[2] - tool(0.9, 0.5).0[2]).abs() < 1e-9);
}

#[test]
fn angles_are_orientations_once_their_order_is_said() {
    let desk = Desk::new();
    // Rz(pan) Ry(−tilt): a about z, b about y, c about x, about moving axes.
    let angles = |[p, t]: [f64; 2]| {
        format!(
            "{p},{t},{},{},{},{}",
            xyz([p, t]),
            p.to_degrees(),
            -t.to_degrees(),
            0.0
        )
    };
    desk.put(
        "kuka.csv",
        &table(
            "q1_rad,q2_rad,x_mm,y_mm,z_mm,rz_deg,ry_deg,rx_deg",
            |_, pose| angles(pose),
        ),
    );
    let asked = desk.refused("kuka.csv --as csv");
    assert!(asked.contains("--euler xyz-fixed or zyx-moving"), "{asked}");
    let asked = desk.refused("kuka.csv --as csv --euler zyx");
    assert!(asked.contains("--euler zyx-fixed or zyx-moving"), "{asked}");
    for order in ["zyx-moving", "xyz-fixed", "rpy"] {
        let (session, said) =
            desk.import(&format!("kuka.csv --as csv --euler {order} --out k.json"));
        assert!(off_the_orientations(&session) < 1e-9, "{order}");
        assert!(off_the_points(&session) < 1e-6);
        assert!(said.contains("R = Rz · Ry · Rx"), "{said}");
    }
    let (session, _) = desk.import("kuka.csv --as csv --euler xyz-moving --out k.json");
    assert!(
        off_the_orientations(&session) > 0.1,
        "another order is another orientation"
    );
    // zyz, by turn: Rz(pan) Ry(−tilt) Rz(0).
    desk.put(
        "zyz.csv",
        &table(
            "q1_rad,q2_rad,x_mm,y_mm,z_mm,euler1_deg,euler2_deg,euler3_deg",
            |_, pose| angles(pose),
        ),
    );
    let (session, _) = desk.import("zyz.csv --as csv --euler zyz-moving --out z.json");
    assert!(off_the_orientations(&session) < 1e-9);
    // Rotation vectors: of a pan alone they are along z.
    desk.put(
        "rotvec.csv",
        "q1_rad,q2_rad,x_mm,y_mm,z_mm,rx,ry,rz\n0.5,0,219.395640472593,119.856384651051,400,0,0,0.5\n0.1,0,249,25,400,0,0,\n",
    );
    let (session, _) =
        desk.import("rotvec.csv --as csv --euler rotvec --angle-unit rad --out r.json");
    let parts = session.samples.orientation_wxyz.unwrap();
    assert!(
        (parts[0][0] - 0.25_f64.cos()).abs() < 1e-12
            && (parts[3][0] - 0.25_f64.sin()).abs() < 1e-12
    );
    assert!(
        parts.iter().all(|part| part[1].is_nan()),
        "a row without an angle has no orientation"
    );
    // Left out with a word.
    let (session, _) =
        desk.import("kuka.csv --as csv --columns auto,auto,auto,auto,auto,-,-,- --out k.json");
    assert!(session.samples.orientation_wxyz.is_none());
}

#[test]
fn the_robots_own_joint_names_are_certain_and_other_headings_are_asked_for() {
    let desk = Desk::new();
    let row = |_: usize, pose: [f64; 2]| format!("1.5,{},{},{},0.2", pose[0], pose[1], xyz(pose));
    let header = "stamp,shoulder_pan_joint,tilt,polaris_position_x,polaris_position_y,polaris_position_z,polaris_error";
    desk.put("a.csv", &table(header, row));
    let asked = desk.refused("a.csv --as csv --angle-unit rad --unit mm");
    assert!(asked.contains("'polaris_position_x' as x"), "{asked}");
    assert!(asked.contains("--columns"), "{asked}");
    let (session, _) =
        desk.import("a.csv --as csv --angle-unit rad --unit mm --confirm --out a.json");
    assert!(off_the_commands(&session) < 1e-12);
    assert!(off_the_points(&session) < 1e-6);
    // `measurement_x` says by itself what it is.
    desk.put(
        "m.csv",
        &table(
            "shoulder_pan_joint,tilt,measurement_x,measurement_y,measurement_z",
            |_, pose| format!("{},{},{}", pose[0], pose[1], xyz(pose)),
        ),
    );
    let (session, _) = desk.import("m.csv --as csv --angle-unit rad --unit mm --out m.json");
    assert!(off_the_points(&session) < 1e-6);
}

#[test]
fn commands_come_without_a_header() {
    let desk = Desk::new();
    desk.put(
        "measured.csv",
        &table("x_mm,y_mm,z_mm", |_, pose| xyz(pose)),
    );
    let tables = [
        table("", |_, [p, t]| format!("{p}, {t}")),
        table("", |_, [p, t]| format!("{p};{t}")),
        table("", |_, [p, t]| format!("{p} {t}")),
    ];
    for commands in tables {
        desk.put("commands.txt", &commands);
        let (session, said) = desk
            .import("measured.csv --as csv --commands commands.txt --angle-unit rad --out s.json");
        assert!(off_the_commands(&session) < 1e-12, "{commands}");
        assert!(off_the_points(&session) < 1e-6);
        assert!(said.contains("--in-measuring-order"), "{said}");
    }
    desk.put("wide.txt", &table("", |_, [p, t]| format!("{p} {t} 0")));
    let asked = desk.refused("measured.csv --as csv --commands wide.txt --angle-unit rad");
    assert!(asked.contains("3 columns and no header"), "{asked}");
    let (session, _) = desk.import(
        "measured.csv --as csv --commands wide.txt --commands-columns q1,q2,- --angle-unit rad --out s.json",
    );
    assert!(off_the_commands(&session) < 1e-12);
}

#[test]
fn rows_in_measuring_order_say_from_which_side_each_joint_came() {
    let desk = Desk::new();
    desk.put(
        "measured.csv",
        &table("x_mm,y_mm,z_mm", |_, pose| xyz(pose)),
    );
    desk.put(
        "commands.csv",
        &table("q1_rad,q2_rad", |_, [p, t]| format!("{p},{t}")),
    );
    let (session, said) = desk
        .import("measured.csv --as csv --commands commands.csv --in-measuring-order --out s.json");
    let dir = |joint: usize| session.samples.dir[joint].clone().unwrap();
    assert_eq!(dir(0), [0.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0]);
    assert_eq!(dir(1), [0.0, 0.0, 1.0, -1.0, -1.0, 1.0, 1.0, 1.0]);
    assert!(said.contains("as stated"), "{said}");
    let (session, said) = desk.import("measured.csv --as csv --commands commands.csv --out s.json");
    assert!(
        session.samples.dir.iter().all(Option::is_none),
        "nothing is derived silently"
    );
    assert!(said.contains("--in-measuring-order derives it"), "{said}");
}

#[test]
fn a_session_beside_its_own_input_gets_samples_of_another_name() {
    let desk = Desk::new();
    desk.put(
        "t1.csv",
        &table("q1_rad,q2_rad,x_mm,y_mm,z_mm", |_, pose| {
            format!("{},{},{}", pose[0], pose[1], xyz(pose))
        }),
    );
    let before = std::fs::read(desk.path().join("t1.csv")).unwrap();
    let (session, said) = desk.import("t1.csv --as csv --out t1.json");
    assert_eq!(std::fs::read(desk.path().join("t1.csv")).unwrap(), before);
    assert!(said.contains("t1.samples.csv"), "{said}");
    assert!(off_the_points(&session) < 1e-6);
}

/// A palletizer of four bars: pan about z, shoulder about y, a forearm that a linkage keeps level (it
/// mimics the shoulder), a wrist about y, a gripper with its mesh. Lengths in m; `[a, b, c]` are the
/// origins of shoulder, forearm and tool.
fn palletizer(upper: [f64; 3], fore: [f64; 3], tool: [f64; 3]) -> String {
    let three = |v: [f64; 3]| format!("{} {} {}", v[0], v[1], v[2]);
    format!(
        "<?xml version=\"1.0\"?>
<!-- as delivered; do not touch -->
<robot name=\"palletizer\">
  <link name=\"world\"/>
  <link name=\"arm_base\"><visual><geometry><mesh filename=\"package://arm/base.dae\"/></geometry></visual></link>
  <link name=\"column\"/>
  <link name=\"upper_arm\"><inertial><mass value=\"4\"/></inertial></link>
  <link name=\"forearm\"><visual><origin xyz=\"0.1 0 0\"/><geometry><box size=\"0.2 0.1 0.1\"/></geometry></visual></link>
  <link name=\"flange\"/>
  <link name=\"gripper\"/>
  <link name=\"camera\"/>
  <joint name=\"stand\" type=\"fixed\"><parent link=\"world\"/><child link=\"arm_base\"/></joint>
  <joint name=\"pan\" type=\"revolute\"><parent link=\"arm_base\"/><child link=\"column\"/><axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"1\"/></joint>
  <joint name=\"shoulder\" type=\"revolute\"><origin xyz=\"{}\" rpy=\"0 0 0\"/><parent link=\"column\"/><child link=\"upper_arm\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"1\"/></joint>
  <joint name=\"keep_level\" type=\"revolute\"><origin xyz=\"{}\"/><parent link=\"upper_arm\"/><child link=\"forearm\"/><axis xyz=\"0 1 0\"/><mimic joint=\"shoulder\" multiplier=\"-1\"/><limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"1\"/></joint>
  <joint name=\"wrist\" type=\"revolute\"><origin xyz=\"0.5 0 0\"/><parent link=\"forearm\"/><child link=\"flange\"/><axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"1\"/></joint>
  <joint name=\"mount\" type=\"fixed\"><origin xyz=\"{}\"/><parent link=\"flange\"/><child link=\"gripper\"/></joint>
  <joint name=\"eye\" type=\"fixed\"><origin xyz=\"0 0.05 0\"/><parent link=\"flange\"/><child link=\"camera\"/></joint>
</robot>
",
        three(upper),
        three(fore),
        three(tool)
    )
}

/// The tool of a palletizer, mm: the textbook's product of matrices of the file's own numbers, read back
/// by their names, with pan, shoulder and wrist in rad.
fn tool_of_urdf(text: &str, [pan, shoulder, wrist]: [f64; 3]) -> nalgebra::Vector3<f64> {
    use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};
    let joint = |name: &str| {
        let from = text.find(&format!("<joint name=\"{name}\"")).unwrap();
        &text[from..from + text[from..].find("</joint>").unwrap()]
    };
    let numbers = |element: &str, key: &str| -> Vector3<f64> {
        let Some(from) = element.find(&format!("{key}=\"")) else {
            return Vector3::zeros();
        };
        let rest = &element[from + key.len() + 2..];
        let words = rest[..rest.find('"').unwrap()].split_whitespace();
        Vector3::from_iterator(words.map(|word| word.parse().unwrap()))
    };
    let mut pose = Isometry3::identity();
    let chain = [
        ("pan", pan),
        ("shoulder", shoulder),
        ("keep_level", -shoulder),
        ("wrist", wrist),
        ("mount", 0.0),
    ];
    for (name, value) in chain {
        let element = joint(name);
        let origin = element.find("<origin").map_or("", |from| &element[from..]);
        let origin = &origin[..origin.find("/>").unwrap_or(0)];
        let rpy = numbers(origin, "rpy");
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), rpy.z)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), rpy.y)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), rpy.x);
        let at = numbers(origin, "xyz") * 1000.0;
        let axis = element
            .find("<axis")
            .map_or_else(Vector3::zeros, |from| numbers(&element[from..], "xyz"));
        pose *= Isometry3::from_parts(
            Translation3::from(at),
            UnitQuaternion::from_rotation_matrix(&turn),
        );
        pose *= Isometry3::rotation(axis * value);
    }
    pose.translation.vector
}

#[test]
#[allow(
    clippy::too_many_lines,
    reason = "one robot, from its file to the corrected one"
)]
fn a_parallelogram_is_measured_by_its_drives_and_corrected_in_its_own_file() {
    let desk = Desk::new();
    let nominal = palletizer([0.0, 0.0, 0.4], [0.0, 0.0, 0.6], [0.12, 0.0, -0.1]);
    let real = palletizer(
        [0.0004, 0.0, 0.4003],
        [-0.0006, 0.0, 0.6007],
        [0.1208, 0.0, -0.1004],
    );
    desk.put("arm.urdf", &nominal);
    let arm = json!({ "name": "palletizer", "urdf": { "file": "arm.urdf", "base": "world", "tip": "gripper" } });
    desk.put("arm.json", &arm.to_string());
    // As a controller of three drives and a tracker write it.
    let mut table = "pan,shoulder,wrist,x_mm,y_mm,z_mm\n".to_owned();
    let pose = |k: u32| {
        let share = |step: f64| (f64::from(k) * step).fract();
        [
            3.0 * share(0.618_034) - 1.5,
            1.8 * share(0.414_214) - 0.9,
            3.0 * share(0.732_051) - 1.5,
        ]
    };
    for k in 0..80 {
        let [pan, shoulder, wrist] = pose(k);
        let at = tool_of_urdf(&real, pose(k));
        let _ = writeln!(
            table,
            "{pan},{shoulder},{wrist},{:.7},{:.7},{:.7}",
            at.x, at.y, at.z
        );
    }
    desk.put("tracker.csv", &table);
    let done =
        desk.run("import tracker.csv --as csv --angle-unit rad --robot arm.json --out s.json");
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let session = load(desk.path().join("s.json")).unwrap().session;
    assert_eq!(session.robot.leading(&[0, 1, 2, 3]), [0, 1, 3]);
    let follows = |row: usize| (session.samples.q[2][row] + session.samples.q[1][row]).abs();
    assert!((0..80).all(|row| follows(row) < 1e-12));
    let done = desk.run("identify s.json --out m.json --json");
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let answer: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert!(
        answer["gap"]["after_mm"].as_f64().unwrap() < 1e-3,
        "{}",
        answer["gap"]
    );
    // The corrected file leads where the real arm is.
    let done = desk.run("export m.json --to urdf --reference arm.urdf --out corrected.urdf");
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let corrected = std::fs::read_to_string(desk.path().join("corrected.urdf")).unwrap();
    // What is in the measuring frame is in no joint: distances between poses are compared.
    let off = |text: &str| {
        let way = |text: &str, k: u32| {
            (tool_of_urdf(text, pose(k)) - tool_of_urdf(text, pose(k + 1))).norm()
        };
        let far = (100..160).map(|k| (way(text, k) - way(&real, k)).abs());
        far.fold(0.0, f64::max)
    };
    let [before, after] = [off(&nominal), off(&corrected)];
    assert!(before > 0.1 && after < 5e-3, "{before} {after}");
    // And differs from the one that was delivered in nothing but origins.
    let without_origins = |text: &str| {
        let parts = text.split("<origin ").enumerate().map(|(k, part)| {
            if k == 0 {
                part
            } else {
                &part[part.find("/>").unwrap() + 2..]
            }
        });
        parts.collect::<String>().replace(['\n', ' '], "")
    };
    assert_eq!(without_origins(&corrected), without_origins(&nominal));
    for kept in [
        "<!-- as delivered; do not touch -->",
        "package://arm/base.dae",
        "<visual><origin xyz=\"0.1 0 0\"/>",
        "<joint name=\"eye\" type=\"fixed\"><origin xyz=\"0 0.05 0\"/>",
        "<mimic joint=\"shoulder\" multiplier=\"-1\"/>",
    ] {
        assert!(corrected.contains(kept), "{kept}");
    }
    // Another robot's file is refused.
    desk.put(
        "other.urdf",
        &palletizer([0.0, 0.0, 0.4], [0.0, 0.0, 0.61], [0.12, 0.0, -0.1]),
    );
    let done = desk.run("export m.json --to urdf --reference other.urdf --out refused.urdf");
    assert_eq!(
        done.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    assert!(String::from_utf8_lossy(&done.stderr).contains("'keep_level' is elsewhere"));
    // Targets by poses: the corrected commands keep the linkage and bring the real tool there.
    let wanted = tool_of_urdf(&nominal, [0.3, 0.4, -0.5]);
    let (s, c) = ((-0.25_f64).sin(), (-0.25_f64).cos());
    let (sp, cp) = (0.15_f64.sin(), 0.15_f64.cos());
    // Rz(0.3) Ry(−0.5): the forearm is level.
    let targets = format!(
        "x_mm,y_mm,z_mm,qw,qx,qy,qz\n{},{},{},{},{},{},{}\n",
        wanted.x,
        wanted.y,
        wanted.z,
        cp * c,
        -sp * s,
        cp * s,
        sp * c
    );
    desk.put("targets.csv", &targets);
    let done = desk.run("compensate m.json targets.csv --out commands.csv --as-modelled");
    let done = if done.status.code() == Some(2) {
        desk.run("compensate m.json targets.csv --out commands.csv")
    } else {
        done
    };
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
}

/// The answer about an arm fits on a page, says one line a reason, and nothing of what never applies.
#[test]
fn the_answer_about_an_arm_fits_on_a_page() {
    let desk = Desk::new();
    let mut table = "q1_deg,q2_deg,x_mm,y_mm,z_mm\n".to_owned();
    for k in 0..60_u32 {
        let share = |step: f64| (f64::from(k) * step).fract();
        let (pan, tilt) = (3.0 * share(0.618_034) - 1.5, 1.4 * share(0.414_214) - 0.7);
        let noise = |step: f64| 0.1 * (share(step) - 0.5);
        let [x, y, z] = tool(pan + 0.001, tilt).0;
        let _ = writeln!(
            table,
            "{:.6},{:.6},{:.4},{:.4},{:.4}",
            pan.to_degrees(),
            tilt.to_degrees(),
            x + noise(0.754_877),
            y + noise(0.569_84),
            z + noise(0.302_776)
        );
    }
    desk.put("t.csv", &table);
    desk.import("t.csv --as csv --out page.json");
    let done = desk.run("diagnose page.json");
    let text = String::from_utf8(done.stdout).unwrap();
    assert!(text.lines().count() <= 45, "{text}");
    assert!(text.contains("Backlash, joints 1, 2"), "{text}");
    assert!(text.contains("detection limits (95 %)"), "{text}");
    assert!(
        !text.contains("takes its place"),
        "an effect of other robots: {text}"
    );
    let not_testable = text
        .lines()
        .skip_while(|line| !line.contains("Not testable"));
    let mut reasons: Vec<&str> = not_testable
        .skip(1)
        .take_while(|line| line.starts_with("  "))
        .filter_map(|line| line.trim().rsplit("  ").next())
        .collect();
    assert!(!reasons.is_empty(), "{text}");
    let count = reasons.len();
    reasons.sort_unstable();
    reasons.dedup();
    assert_eq!(reasons.len(), count, "one line a reason: {text}");
}

/// What is in no column that is understood, or in a comment, is not passed over without a word.
#[test]
fn nothing_of_a_table_is_dropped_without_a_word() {
    let desk = Desk::new();
    let head = "q1_rad,q2_rad,x_mm,y_mm,z_mm";
    let row = |_: usize, pose: [f64; 2]| format!("{},{},{}", pose[0], pose[1], xyz(pose));
    // What a spreadsheet writes in place of a number is no comment, names with the sign of one are told.
    let lost = |k: usize, pose: [f64; 2]| {
        let cell = if k == 3 { "#N/A" } else { "20.5" };
        format!("{cell},{}", row(k, pose))
    };
    desk.put("lost.csv", &table(&format!("temperature_c,{head}"), lost));
    let said = desk.refused("lost.csv --as csv");
    assert!(
        said.contains("line 5, column 1") && said.contains("'#N/A'"),
        "{said}"
    );
    let named = |k: usize, pose: [f64; 2]| format!("#{k},{}", row(k, pose));
    desk.put("named.csv", &table(&format!("name,{head}"), named));
    let said = desk.refused("named.csv --as csv");
    assert!(
        said.contains("lines that begin with # are comments"),
        "{said}"
    );
    // Columns that mean nothing are kept, and that is said.
    let more = |k: usize, pose: [f64; 2]| format!("{},7,{k}", row(k, pose));
    desk.put("more.csv", &table(&format!("{head},fan [counts],d"), more));
    let (_, said) = desk.import("more.csv --as csv --out more.json");
    assert!(
        said.contains("kept and not used: 'fan [counts]', 'd'"),
        "{said}"
    );
    // The two parts of a stamp are one time.
    let stamped = |k: usize, pose: [f64; 2]| {
        let (s, ns) = (1_714_744_211 + 6 * k, 500_000_000 * (k % 2));
        format!("{s},{ns},{}", row(k, pose))
    };
    desk.put(
        "stamp.csv",
        &table(
            &format!("header.stamp.sec,header.stamp.nanosec,{head}"),
            stamped,
        ),
    );
    let (session, _) = desk.import("stamp.csv --as csv --out stamp.json");
    let time_s = session.samples.time_s.unwrap();
    assert!((time_s[1] - time_s[0] - 6.5).abs() < 1e-6);
    for (heading, step) in [("stamp_ns", 6e9), ("t/min", 0.1)] {
        let timed = |k: usize, pose: [f64; 2]| format!("{},{}", k as f64 * step, row(k, pose));
        desk.put("timed.csv", &table(&format!("{heading},{head}"), timed));
        let (session, _) = desk.import("timed.csv --as csv --out timed.json");
        let time_s = session.samples.time_s.unwrap();
        assert!((time_s[7] - time_s[0] - 42.0).abs() < 1e-6, "{heading}");
    }
    let dated =
        |k: usize, pose: [f64; 2]| format!("03/04/2024 15:50:{:02},{}", 6 * k, row(k, pose));
    desk.put("dated.csv", &table(&format!("time,{head}"), dated));
    let said = desk.refused("dated.csv --as csv");
    assert!(said.contains("certain what is the day"), "{said}");
}

#[test]
fn a_quaternion_is_told_by_the_names_of_its_parts() {
    let desk = Desk::new();
    let parts = |[p, t]: [f64; 2]| {
        let ((sp, cp), (st, ct)) = ((0.5 * p).sin_cos(), (-0.5 * t).sin_cos());
        [cp * ct, -sp * st, cp * st, sp * ct]
    };
    for (names, order) in [
        ("Q0,Qx,Qy,Qz", [0, 1, 2, 3]),
        ("RotX,RotY,RotZ,RotW", [1, 2, 3, 0]),
        ("qi,qj,qk,qr", [1, 2, 3, 0]),
        ("ori_w,ori_x,ori_y,ori_z", [0, 1, 2, 3]),
        ("quat[0],quat[1],quat[2],quat[3]", [0, 1, 2, 3]),
    ] {
        let row = |_: usize, pose: [f64; 2]| {
            let own = parts(pose);
            let [a, b, c, d] = order.map(|part: usize| own[part]);
            format!("{},{},{},{a},{b},{c},{d}", pose[0], pose[1], xyz(pose))
        };
        desk.put(
            "q.csv",
            &table(&format!("j1_rad,j2_rad,x_mm,y_mm,z_mm,{names}"), row),
        );
        let (session, said) = desk.import("q.csv --as csv --out q.json");
        assert!(off_the_orientations(&session) < 1e-9, "{names}: {said}");
    }
    // The rows of a matrix are no quaternions, and are told under a heading too.
    let names: Vec<String> = (0..16).map(|k| format!("m{}{}", k / 4, k % 4)).collect();
    let row = |_: usize, pose: [f64; 2]| {
        let (at, turn) = tool(pose[0], pose[1]);
        let rows =
            (0..3).map(|k| format!("{},{},{},{}", turn[k][0], turn[k][1], turn[k][2], at[k]));
        rows.collect::<Vec<_>>().join(",") + ",0,0,0,1"
    };
    desk.put("m.csv", &table(&names.join(","), row));
    let said = desk.refused("m.csv --as csv --unit mm");
    assert!(
        said.contains("a matrix of a rotation") && !said.contains("a quaternion"),
        "{said}"
    );
    // Several points a row, by their numbers.
    let row =
        |_: usize, pose: [f64; 2]| format!("{},{},{},{}", pose[0], pose[1], xyz(pose), xyz(pose));
    desk.put(
        "two.csv",
        &table("q1_rad,q2_rad,x1_mm,y1_mm,z1_mm,x_2,y_2,z_2", row),
    );
    let said = desk.refused("two.csv --as csv");
    assert!(said.contains("2 groups of x, y, z: 1, 2"), "{said}");
}

#[test]
fn comments_in_words_contradict_what_would_be_read() {
    let desk = Desk::new();
    let row = |k: usize, pose: [f64; 2]| {
        let [x, y, z] = tool(pose[0], pose[1]).0;
        format!("{k} {} {} {} 1 0 0 0", x / 1e3, y / 1e3, z / 1e3)
    };
    desk.put(
        "t.txt",
        &table("# position (x y z), quaternion (w x y z)", row),
    );
    let said = desk.refused("t.txt --as tum");
    assert!(said.contains("the heading 'position (x y z)"), "{said}");
    let row = |_: usize, pose: [f64; 2]| format!("{},{},{}", pose[0], pose[1], xyz(pose));
    for (comment, is_one) in [
        ("# q1_deg,q2_deg,x_mm,y_mm,z_mm", false),
        ("# q1_rad,q2_rad,y_mm,x_mm,z_mm", false),
        ("# J1, J2, X, Y, Z", true),
        ("# by hand, cold, x, in, May", true),
    ] {
        desk.put(
            "c.csv",
            &table(&format!("{comment}\nq1_rad,q2_rad,x_mm,y_mm,z_mm"), row),
        );
        if is_one {
            desk.import("c.csv --as csv --out c.json");
        } else {
            let said = desk.refused("c.csv --as csv");
            assert!(said.contains("contradict each other"), "{said}");
        }
    }
    let row = |k: usize, pose: [f64; 2]| format!("P{k} {}", xyz(pose).replace(',', " "));
    for comment in ["! Name  Dist  Hz  V", "; Point R Az Zen"] {
        desk.put("s.txt", &table(comment, row));
        let said = desk.refused("s.txt --as tracker --unit mm");
        assert!(said.contains("4 columns and no header"), "{said}");
    }
}

/// KUKA's A, B, C, under headings of angles about x, y and z: the tool is turned about x as well.
#[test]
fn angles_about_z_y_x_are_named_where_they_are_said_to_be_about_x_y_z() {
    let desk = Desk::new();
    let row = |_: usize, pose: [f64; 2]| {
        format!(
            "{},{},{},{},{},0.2",
            pose[0],
            pose[1],
            xyz(pose),
            pose[0],
            -pose[1]
        )
    };
    desk.put(
        "abc.csv",
        &table("q1_rad,q2_rad,x_mm,y_mm,z_mm,rx_rad,ry_rad,rz_rad", row),
    );
    desk.import("abc.csv --as csv --euler rpy --out abc.json");
    let done = desk.run("identify abc.json --json");
    let answer: Value = serde_json::from_slice(&done.stdout).unwrap();
    let problems = answer["data_problems"].to_string();
    assert!(problems.contains("--columns …,rz,ry,rx"), "{problems}");
    desk.import("abc.csv --as csv --euler rpy --columns auto,auto,auto,auto,auto,rz_rad,ry_rad,rx_rad --out abc.json");
    let answer: Value =
        serde_json::from_slice(&desk.run("identify abc.json --json").stdout).unwrap();
    assert!(!answer["data_problems"].to_string().contains("orientations"));
}

/// Orientations that are stated in another frame than the positions are a finding with its size; a turned tool is a
/// parameter of the calibration.
#[test]
fn orientations_in_another_frame_than_the_positions_are_named() {
    let desk = Desk::new();
    let turn = |by: [f64; 4], of: [f64; 4]| {
        let ([a, b, c, d], [w, x, y, z]) = (by, of);
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ]
    };
    let angle = 20.0_f64.to_radians();
    let by = [0.36, -0.48, 0.8].map(|part: f64| part * (0.5 * angle).sin());
    let by = [(0.5 * angle).cos(), by[0], by[1], by[2]];
    let problems = |of_frame: bool| {
        let row = |_: usize, pose: [f64; 2]| {
            let ((sp, cp), (st, ct)) = ((0.5 * pose[0]).sin_cos(), (-0.5 * pose[1]).sin_cos());
            let own = [cp * ct, -sp * st, cp * st, sp * ct];
            let [w, x, y, z] = if of_frame {
                turn(by, own)
            } else {
                turn(own, by)
            };
            format!("{},{},{},{w},{x},{y},{z}", pose[0], pose[1], xyz(pose))
        };
        desk.put(
            "turned.csv",
            &table("q1_rad,q2_rad,x_mm,y_mm,z_mm,qw,qx,qy,qz", row),
        );
        desk.import("turned.csv --as csv --out turned.json");
        let done = desk.run("identify turned.json --json");
        serde_json::from_slice::<Value>(&done.stdout).unwrap()
    };
    let answer = problems(true);
    let said = answer["data_problems"].to_string();
    assert!(
        said.contains("turned by 20.00° against the positions"),
        "{said}"
    );
    // The way back, as a rotation vector.
    assert!(said.contains("(-7.20, 9.60, -16.00)°"), "{said}");
    assert!(
        answer["gap"]["after_mm"].as_f64().unwrap() < 1e-3,
        "{}",
        answer["gap"]
    );
    let answer = problems(false);
    assert!(!answer["data_problems"].to_string().contains("orientations"));
    assert!(
        answer["gap"]["after_mm"].as_f64().unwrap() < 1e-3,
        "{}",
        answer["gap"]
    );
}

#[test]
fn what_stands_in_the_way_of_a_sidecar_leaves_the_output_as_it_was_and_unknown_gears_are_none() {
    let desk = Desk::new();
    let row = |_: usize, pose: [f64; 2]| format!("{},{},{}", pose[0], pose[1], xyz(pose));
    desk.put("t.csv", &table("q1_rad,q2_rad,x_mm,y_mm,z_mm", row));
    desk.import("t.csv --as csv --out s.json");
    assert_eq!(
        desk.run("identify s.json --out m.json").status.code(),
        Some(0)
    );
    desk.put("table.csv", "as it was\n");
    std::fs::create_dir(desk.path().join("table.csv.meta.json")).unwrap();
    let done = desk.run("export m.json --to csv --out table.csv --force");
    assert_eq!(done.status.code(), Some(2));
    let left = std::fs::read_to_string(desk.path().join("table.csv")).unwrap();
    assert_eq!(left, "as it was\n");
    let dh = json!({ "a_mm": 100, "alpha_deg": 90, "d_mm": 0, "theta_deg": 0, "convention": "standard", "kind": "revolute" });
    let robot = json!({ "name": "two", "dh": [dh, dh], "gear_ratios": [null, null] });
    desk.put("two.json", &robot.to_string());
    let done = desk.run("import t.csv --as csv --robot two.json --out two-s.json");
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
}
