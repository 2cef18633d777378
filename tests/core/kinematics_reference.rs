//! The kinematics against numbers of other people's programs: Modern Robotics, pinocchio, and the
//! printed Denavit–Hartenberg matrices. `reference/kinematics.py` made them.

use std::path::Path;

use nalgebra::{DMatrix, Matrix4, Point3, Rotation3, Vector3};
use serde::Deserialize;
use truepose::kinematics::{
    Axis, DhConvention, DhRow, Joint, JointKind, Pose, Robot, robot_from_dh, robot_from_urdf,
};

/// Relative to the largest entry of what is compared.
const TOLERANCE: f64 = 1e-12;

#[derive(Deserialize)]
struct Reference {
    name: String,
    #[serde(default)]
    joints: Vec<ReferenceJoint>,
    home: Option<[[f64; 4]; 4]>,
    #[serde(default)]
    dh: Vec<ReferenceRow>,
    urdf: Option<String>,
    #[serde(default)]
    base: String,
    #[serde(default)]
    tip: String,
    gravity_m_s2: Option<[f64; 3]>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct ReferenceJoint {
    kind: String,
    axis: [f64; 3],
    point_mm: [f64; 3],
}

#[derive(Deserialize)]
struct ReferenceRow {
    a_mm: f64,
    alpha_rad: f64,
    d_mm: f64,
    theta_rad: f64,
    convention: String,
}

#[derive(Deserialize)]
struct Case {
    q: Vec<f64>,
    base_from_tool: Vec<Vec<f64>>,
    space_jacobian: Vec<Vec<f64>>,
    gravity_torque: Option<Vec<f64>>,
}

fn references() -> Vec<Reference> {
    serde_json::from_str(include_str!("../reference/kinematics.json"))
        .expect("the script writes this shape")
}

fn robot(reference: &Reference) -> Robot {
    let mut robot = if let Some(text) = &reference.urdf {
        let file = Path::new("reference.urdf");
        robot_from_urdf(text, file, &reference.base, &reference.tip)
            .expect("the reference is sound URDF")
    } else if let Some(home) = reference.home {
        robot_from_screws(reference, home)
    } else {
        let rows: Vec<DhRow> = reference.dh.iter().map(dh_row).collect();
        robot_from_dh(&*reference.name, &rows).expect("the rows are finite")
    };
    robot.gravity_m_s2 = reference.gravity_m_s2.map(Vector3::from);
    robot
}

fn robot_from_screws(reference: &Reference, home: [[f64; 4]; 4]) -> Robot {
    let joint = |given: &ReferenceJoint| {
        let kind = match given.kind.as_str() {
            "revolute" => JointKind::Revolute,
            _ => JointKind::Prismatic,
        };
        let axis = Axis::through(given.axis.into(), given.point_mm.into())
            .expect("the axes have directions");
        Joint::new("joint", kind, axis)
    };
    let home = Matrix4::from_fn(|row, column| home[row][column]);
    let rotation = Rotation3::from_matrix_unchecked(home.fixed_view::<3, 3>(0, 0).into());
    let position: Vector3<f64> = home.fixed_view::<3, 1>(0, 3).into();
    Robot {
        name: reference.name.clone(),
        joints: reference.joints.iter().map(joint).collect(),
        base_from_tool: Pose::from_parts(position.into(), rotation.into()),
        gravity_m_s2: None,
        source: truepose::kinematics::RobotSource::Axes,
    }
}

fn dh_row(row: &ReferenceRow) -> DhRow {
    DhRow {
        a_mm: row.a_mm,
        alpha_rad: row.alpha_rad,
        d_mm: row.d_mm,
        theta_rad: row.theta_rad,
        convention: match row.convention.as_str() {
            "standard" => DhConvention::Standard,
            _ => DhConvention::Modified,
        },
        kind: JointKind::Revolute,
    }
}

/// The largest difference, relative to the largest reference entry.
fn relative_difference(ours: &DMatrix<f64>, theirs: &[Vec<f64>]) -> f64 {
    let theirs = DMatrix::from_fn(theirs.len(), theirs[0].len(), |r, c| theirs[r][c]);
    assert_eq!(ours.shape(), theirs.shape());
    (ours - &theirs).amax() / theirs.amax()
}

#[test]
fn poses_and_jacobians_agree_with_other_implementations_in_every_case() {
    let mut compared = 0;
    for reference in references() {
        let robot = robot(&reference);
        for case in &reference.cases {
            let dynamic =
                |rows, columns, data: &[f64]| DMatrix::from_column_slice(rows, columns, data);
            let n = case.q.len();
            let pose = robot.base_from_tool(&case.q).to_homogeneous();
            let space = robot.space_jacobian(&case.q);
            for (what, ours, theirs) in [
                ("pose", dynamic(4, 4, pose.as_slice()), &case.base_from_tool),
                (
                    "space",
                    dynamic(6, n, space.as_slice()),
                    &case.space_jacobian,
                ),
            ] {
                let difference = relative_difference(&ours, theirs);
                let name = &reference.name;
                assert!(difference < TOLERANCE, "{name}, {what}: {difference:e}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 6 * 8 * 2);
}

#[test]
fn the_rotations_agree_in_their_own_right_and_not_only_beside_millimetres() {
    for reference in references() {
        let robot = robot(&reference);
        for case in &reference.cases {
            let rotation = robot.base_from_tool(&case.q).rotation.to_rotation_matrix();
            for row in 0..3 {
                for column in 0..3 {
                    let difference = rotation[(row, column)] - case.base_from_tool[row][column];
                    assert!(
                        difference.abs() < 2e-14,
                        "{}: {difference:e}",
                        reference.name
                    );
                }
            }
        }
    }
}

#[test]
fn a_target_goes_through_the_point_path_to_where_the_reference_pose_takes_it() {
    let target = Point3::new(12.0, -35.0, 80.0);
    for reference in references() {
        let robot = robot(&reference);
        for case in &reference.cases {
            let theirs = Matrix4::from_fn(|row, column| case.base_from_tool[row][column]);
            let theirs = theirs.transform_point(&target);
            let ours = robot.point_in_base(&case.q, &target);
            let difference = (ours - theirs).norm() / theirs.coords.norm();
            assert!(difference < 1e-11, "{}: {difference:e}", reference.name);
        }
    }
}

#[test]
fn gravitys_torques_are_pinocchios_with_the_sign_turned() {
    let mut compared = 0;
    for reference in references() {
        let robot = robot(&reference);
        for case in &reference.cases {
            let Some(theirs) = &case.gravity_torque else {
                continue;
            };
            for (joint, theirs) in theirs.iter().enumerate() {
                let ours = robot.gravity_torque_nm(&case.q, 0.0, joint).unwrap();
                assert!(
                    (ours - theirs).abs() < 1e-11,
                    "joint {joint}: {ours} {theirs}"
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 8 * 4);
}
