use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::*;
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot};
use crate::sessions::domain::{Instrument, Region, Samples, Setups, Sigma, Target, UnknownColumn};
use crate::sessions::load;
use crate::sessions::{Lines, ObservedColumns, parse};
use crate::units::rad_from_deg;

/// A number as files hold it, or a missing one.
fn cell() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -1e4..1e4f64,
        2 => (-100_000..100_000i32).prop_map(|v| f64::from(v) / 1000.0),
        // Of any size down to the smallest; larger ones are refused.
        1 => prop::num::f64::NORMAL.prop_map(|v| if v.abs() < 1e5 { v } else { 1.0 / v }),
        1 => Just(f64::NAN),
        1 => Just(-0.0),
    ]
}

fn column(rows: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(cell(), rows)
}

fn angles(rows: usize) -> impl Strategy<Value = Vec<f64>> {
    column(rows).prop_map(|column| column.into_iter().map(rad_from_deg).collect())
}

fn optional_column(rows: usize) -> impl Strategy<Value = Option<Vec<f64>>> {
    prop::option::of(column(rows))
}

fn any_samples(rows: usize) -> impl Strategy<Value = Samples> {
    let joints = (angles(rows), column(rows), prop::option::of(angles(rows)));
    let measured = (column(rows), column(rows), optional_column(rows));
    let conditions = (
        prop::option::of(prop::collection::vec(
            prop::sample::select(vec![-1.0, 0.0, 1.0, f64::NAN]),
            rows,
        )),
        optional_column(rows),
        optional_column(rows),
        optional_column(rows),
    );
    let labels = (
        prop::option::of(prop::collection::vec(0..2u32, rows)),
        prop::option::of(prop::collection::vec(any::<bool>(), rows)),
        prop::collection::vec("[ a-c,\"\n\té]{0,4}", rows),
        any::<bool>(),
    );
    (joints, measured, conditions, labels).prop_map(
        move |(joints, measured, conditions, labels)| {
            let (q1, q2, q1_read) = joints;
            let (mut x_mm, mut y_mm, z_mm) = measured;
            // At least one sample can be used.
            let (mut q1, mut q2) = (q1, q2);
            for column in [&mut q1, &mut q2, &mut x_mm, &mut y_mm] {
                column[0] = 1.5;
            }
            let (dir, speed2, load_kg, time_s) = conditions;
            let (target, held_out, remarks, with_setups) = labels;
            Samples {
                q: vec![q1, q2],
                q_read: vec![q1_read, None],
                orientation_wxyz: None,
                observed: ObservedColumns::default(),
                target,
                dir: vec![None, dir],
                speed: vec![None, speed2],
                torque_nm: vec![None, load_kg.clone()],
                joint_temperature_c: vec![load_kg.clone(), None],
                load_kg,
                temperature_c: None,
                time_s,
                setups: with_setups.then(|| Setups {
                    names: vec!["first, north".to_owned()],
                    index: vec![0; rows],
                }),
                // A column that holds nothing out and excludes something only excludes.
                excluded: held_out
                    .as_ref()
                    .filter(|held_out: &&Vec<bool>| rows > 1 && held_out.contains(&true))
                    .map(|_| (0..rows).map(|row| row % 3 == 1).collect()),
                held_out,
                corrected: None,
                unknown: vec![UnknownColumn {
                    name: "remark".to_owned(),
                    cells: remarks,
                }],
                line: Lines::default(),
                x_mm,
                y_mm,
                z_mm,
            }
        },
    )
}

fn any_session() -> impl Strategy<Value = Session> {
    let vector = || prop::array::uniform3(-1e3..1e3f64);
    let robot = (
        vector(),
        vector(),
        vector(),
        prop::option::of(0.0..50.0f64),
        any::<bool>(),
    );
    (robot, (1..20usize).prop_flat_map(any_samples), "\\PC{0,8}").prop_map(
        |(robot, samples, name)| {
            let (axis, point, turn, mass, with_gravity) = robot;
            let joint = |kind, limits: [f64; 2]| Joint {
                name: format!("{kind:?} \"1\""),
                kind,
                axis: Axis {
                    direction: Unit::new_normalize(
                        Vector3::from(axis) + Vector3::new(0.0, 0.0, 3e3),
                    ),
                    point_mm: Point3::from(point),
                },
                limits: Some(Range {
                    from: limits[0],
                    to: limits[1],
                }),
                link: mass.map(|mass_kg| LinkMass {
                    mass_kg,
                    centre_mm: Point3::from(point),
                }),
                follows: None,
                gear_ratio: None,
            };
            Session {
                name,
                note: "two\nlines".to_owned(),
                robot: Robot {
                    name: "r".to_owned(),
                    joints: vec![
                        joint(
                            JointKind::Revolute,
                            [rad_from_deg(-170.5), rad_from_deg(33.3)],
                        ),
                        joint(JointKind::Prismatic, [-0.1, 812.7]),
                    ],
                    base_from_tool: Pose::from_parts(
                        Vector3::from(point).into(),
                        UnitQuaternion::from_scaled_axis(Vector3::from(turn) * 1e-3),
                    ),
                    gravity_m_s2: with_gravity.then(|| Vector3::new(0.0, 0.1, -9.81)),
                    source: crate::kinematics::RobotSource::Axes,
                },
                targets: vec![
                    Target {
                        name: "T 1".to_owned(),
                        position_mm: Point3::from(turn),
                    },
                    Target {
                        name: "b,\"".to_owned(),
                        position_mm: Point3::origin(),
                    },
                ],
                instrument: Instrument {
                    name: "tracker".to_owned(),
                    sigma_mm: Some(Sigma::PerAxis([0.01, 0.02, 0.03])),
                    targets_sigma_mm: None,
                    ..Instrument::default()
                },
                tolerance_mm: Some(0.2),
                regions: vec![Region {
                    name: "1".to_owned(),
                    from_rad: 0.0,
                    to_rad: rad_from_deg(30.1),
                }],
                compensated_by: None,
                samples,
                path: None,
            }
        },
    )
}

/// The session as text in which every bit of every number shows, NaN too.
fn shown(session: &Session) -> String {
    let mut plain = session.clone();
    plain.path = None;
    plain.samples.line = Lines::default();
    format!("{plain:?}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_session_that_is_saved_and_loaded_is_the_same_to_the_last_bit(session in any_session()) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a session.json");
        save(&session, &path, Replacing::default()).unwrap();
        let loaded = load(&path).map_err(|e| TestCaseError::fail(e.to_string()))?.session;
        prop_assert_eq!(shown(&loaded), shown(&session));
        prop_assert_eq!(
            crate::sessions::hash_of_samples(&loaded),
            crate::sessions::hash_of_samples(&session)
        );
    }

    #[test]
    fn an_inline_session_is_the_same_too(session in any_session()) {
        let mut document = Vec::new();
        write_inline(&session, &mut document).unwrap();
        let loaded = parse(&document).map_err(|e| TestCaseError::fail(e.to_string()))?.session;
        prop_assert_eq!(shown(&loaded), shown(&session));
    }
}

fn small() -> Session {
    let document = r#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":
        [{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-95.3,90]}],
        "tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
        "samples":{"columns":{"q1_deg":[95.3,-60],"x_mm":[1.25,2],"y_mm":[3,null]}}}"#;
    parse(document.as_bytes()).unwrap().session
}

#[test]
fn what_is_saved_reads_well() {
    let mut document = Vec::new();
    write_inline(&small(), &mut document).unwrap();
    let expected = r#"{
  "format": "truepose-session/1",
  "name": "s",
  "robot": {
    "name": "r",
    "joints": [{
      "name": "pan",
      "kind": "revolute",
      "axis": [0, 0, 1],
      "point_mm": [0, 0, 0],
      "limits": [-95.3, 90]
    }],
    "tool": {
      "position_mm": [250, 0, 300],
      "quaternion_wxyz": [1, 0, 0, 0]
    }
  },
  "compensated_by": null,
  "samples": {
    "columns": {
      "q1_deg": [95.3, -60],
      "x_mm": [1.25, 2],
      "y_mm": [3, null]
    }
  }
}
"#;
    assert_eq!(String::from_utf8(document).unwrap(), expected);
    let mut csv = Vec::new();
    write_csv(&small(), &mut csv).unwrap();
    assert_eq!(
        String::from_utf8(csv).unwrap(),
        "q1_deg,x_mm,y_mm\n95.3,1.25,3\n-60,2,\n"
    );
}

#[test]
fn neither_file_of_an_existing_pair_is_replaced_without_force() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    std::fs::write(folder.path().join("s.csv"), "mine").unwrap();
    assert!(matches!(
        save(&small(), &path, Replacing::default()),
        Err(WriteError::Exists(_))
    ));
    assert!(
        !path.exists(),
        "nothing is written when one of the two is refused"
    );
    let force = Replacing {
        force: true,
        inputs: &[],
    };
    save(&small(), &path, force).unwrap();
    assert_eq!(load(&path).unwrap().session.samples.q, small().samples.q);
}

#[test]
fn an_input_is_not_replaced_even_by_force() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    save(&small(), &path, Replacing::default()).unwrap();
    let csv = samples_path(&path);
    for input in [&path, &csv] {
        let replacing = Replacing {
            force: true,
            inputs: &[input],
        };
        assert!(matches!(
            save(&small(), &path, replacing),
            Err(WriteError::ReplacesInput { .. })
        ));
    }
    let replacing = Replacing {
        force: true,
        inputs: &[],
    };
    assert!(matches!(
        save(&small(), &csv, replacing),
        Err(WriteError::SameName(_))
    ));
}

/// Spreadsheets write commas behind the last heading, and people a heading twice.
#[test]
fn columns_without_a_heading_of_their_own_are_kept_and_read_again() {
    let document = r#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[
        {"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
        "tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"instrument":{"name":"i","sigma_mm":0.1},
        "samples":{"file":"s.csv"}}"#;
    let table =
        "q1_deg,x_mm,y_mm,z_mm,by,by,,,by (2)\n1,250,4,300,a,b,c,d,e\n2,250,8,300,a,b,c,d,e\n";
    let session = crate::sessions::parse_with_csv(document.as_bytes(), table.as_bytes())
        .unwrap()
        .session;
    let names = |session: &Session| -> Vec<String> {
        let unknown = session.samples.unknown.iter();
        unknown.map(|column| column.name.clone()).collect()
    };
    assert_eq!(names(&session), ["by", "by (2)", "", "(2)", "by (2) (2)"]);
    let mut written = Vec::new();
    write_inline(&session, &mut written).unwrap();
    let again = parse(&written).unwrap().session;
    assert_eq!(names(&again), names(&session));
    assert_eq!(again.samples.unknown[3].cells, ["d", "d"]);
}
