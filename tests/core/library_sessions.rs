//! Sessions that are broken in the ways that public fields allow, for `library`.

#![allow(
    clippy::semicolon_if_nothing_returned,
    clippy::manual_is_multiple_of,
    clippy::cast_possible_truncation,
    clippy::assigning_clones,
    reason = "tables of what is broken, a line each"
)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use nalgebra::{Point3, Unit, Vector3};
use truepose::effects::JointValues;
use truepose::kinematics::{
    Axis, Follows, Joint, JointKind, LinkMass, Pose, Range, Robot, RobotSource,
};
use truepose::model::Calibration;
use truepose::pipeline::{self, Method};
use truepose::sessions::{
    Pointing, Region, Samples, Session, Setups, Sigma, SocketDistance, Tracker, UnknownColumn,
};

pub(crate) const COMMANDED: JointValues = JointValues::Commanded;

pub(crate) fn arm(joints: usize) -> Robot {
    let joint = |k: usize| {
        let along = [Vector3::z(), Vector3::y()][k % 2];
        let axis = Axis::through(along, Point3::new(60.0 * k as f64, 0.0, 100.0 * k as f64));
        let mut joint = Joint::new(format!("j{k}"), JointKind::Revolute, axis.unwrap());
        joint.limits = Some(Range {
            from: -2.0,
            to: 2.0,
        });
        joint
    };
    Robot {
        name: "arm".to_owned(),
        joints: (0..joints).map(joint).collect(),
        base_from_tool: Pose::translation(250.0 + 60.0 * joints as f64, 0.0, 300.0),
        gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
        source: RobotSource::Axes,
    }
}

/// Measured with every column that a session may have.
pub(crate) fn sound(joints: usize) -> Session {
    let (robot, rows) = (arm(joints), 24);
    let value =
        |row: usize, joint: usize| 2.0 * ((row as f64 * (2.0 + joint as f64).sqrt()).fract() - 0.5);
    let q: Vec<Vec<f64>> = (0..rows)
        .map(|row| (0..joints).map(|joint| value(row, joint)).collect())
        .collect();
    let seen = |(row, q): (usize, &Vec<f64>)| {
        let off: Vec<f64> = q.iter().map(|q| q + 0.002).collect();
        let at = robot.point_in_base(&off, &Point3::origin());
        let scatter = |of: f64| 0.02 * (row as f64 * of).sin();
        at + Vector3::new(scatter(12.9), scatter(7.7), scatter(5.1))
    };
    let points: Vec<Point3<f64>> = q.iter().enumerate().map(seen).collect();
    let mut session = Session::new(robot.clone(), &q, &points).unwrap();
    let samples = &mut session.samples;
    let side = |row: usize| if row % 2 == 0 { 1.0 } else { -1.0 };
    samples.dir = vec![Some((0..rows).map(side).collect()); joints];
    samples.time_s = Some((0..rows).map(|row| 5.0 * row as f64).collect());
    samples.load_kg = Some(vec![0.0; rows]);
    samples.temperature_c = Some(vec![21.0; rows]);
    session.instrument.sigma_mm = Some(Sigma::Overall(0.02));
    session.checked().unwrap()
}

pub(crate) fn calibrated(session: &Session) -> Calibration {
    pipeline::identify(session, &Method::default(), COMMANDED)
        .unwrap()
        .1
}

pub(crate) type Change = (&'static str, fn(&mut Session));

/// None of these can be computed with.
pub(crate) const BROKEN: &[Change] = &[
    ("no joints", |s| s.robot.joints.clear()),
    ("more joints than columns", |s| {
        s.robot.joints.push(s.robot.joints[0].clone());
    }),
    ("more joints than a robot has", |s| {
        s.robot.joints = vec![s.robot.joints[0].clone(); 101];
    }),
    ("no samples of a joint", |s| {
        s.samples = Samples {
            x_mm: vec![0.0],
            y_mm: vec![0.0],
            ..Samples::default()
        }
    }),
    ("no q", |s| s.samples.q.clear()),
    ("short q", |s| s.samples.q[0].truncate(3)),
    ("long q", |s| s.samples.q[0].push(1.0)),
    ("more q", |s| s.samples.q.push(s.samples.q[0].clone())),
    ("short x", |s| s.samples.x_mm.truncate(2)),
    ("no x", |s| s.samples.x_mm.clear()),
    ("short y", |s| s.samples.y_mm.truncate(2)),
    ("short z", |s| s.samples.z_mm = Some(vec![1.0])),
    ("short dir", |s| s.samples.dir[0] = Some(vec![1.0])),
    ("more dir", |s| s.samples.dir.push(None)),
    ("a direction of 7", |s| {
        s.samples.dir[0] = Some(vec![7.0; s.samples.len()])
    }),
    ("short speed", |s| s.samples.speed[0] = Some(vec![1.0])),
    ("short q_read", |s| s.samples.q_read[0] = Some(vec![1.0])),
    ("more torque", |s| s.samples.torque_nm = vec![None; 40]),
    ("short torque", |s| {
        s.samples.torque_nm = vec![Some(vec![1.0])]
    }),
    ("short warmth", |s| {
        s.samples.joint_temperature_c = vec![Some(vec![1.0])]
    }),
    ("short load", |s| s.samples.load_kg = Some(vec![1.0])),
    ("short temperature", |s| {
        s.samples.temperature_c = Some(vec![])
    }),
    ("short time", |s| s.samples.time_s = Some(vec![0.0])),
    ("short held out", |s| s.samples.held_out = Some(vec![true])),
    ("short excluded", |s| s.samples.excluded = Some(vec![false])),
    ("short target", |s| s.samples.target = Some(vec![0])),
    ("a target that is none", |s| {
        s.samples.target = Some(vec![7; s.samples.len()])
    }),
    ("short orientation", |s| {
        s.samples.orientation_wxyz = Some([vec![1.0], vec![], vec![], vec![]]);
    }),
    ("setups without names", |s| {
        s.samples.setups = Some(Setups {
            names: vec![],
            index: vec![0; s.samples.len()],
        });
    }),
    ("short setups", |s| {
        s.samples.setups = Some(Setups {
            names: vec!["a".into()],
            index: vec![],
        });
    }),
    ("a thousand setups", |s| {
        let (names, index) = (
            (0..1000).map(|k| k.to_string()).collect(),
            vec![0; s.samples.len()],
        );
        s.samples.setups = Some(Setups { names, index });
    }),
    ("short distance", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0])
    }),
    ("an anchor that is none", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0; s.samples.len()]);
        s.samples.observed.anchor = Some(vec![Some(9); s.samples.len()]);
    }),
    ("a plane that is none", |s| {
        s.samples.observed.plane = Some(vec![Some(0); s.samples.len()])
    }),
    ("a station that is none", |s| {
        s.samples.observed.station = Some(vec![Some(0); s.samples.len()])
    }),
    ("a socket that is none", |s| {
        s.samples.observed.socket = Some(vec![Some(0); s.samples.len()])
    }),
    ("short unknown", |s| {
        s.samples.unknown = vec![UnknownColumn {
            name: "u".into(),
            cells: vec![],
        }];
    }),
    ("sockets that are none", |s| {
        s.instrument.references.socket_distances = vec![SocketDistance {
            between: [3, 4],
            distance_mm: 1.0,
        }];
    }),
    ("a pointing that points nowhere", |s| {
        let axis = Unit::new_unchecked(Vector3::zeros());
        s.instrument.references.pointing = Some(Pointing {
            axis,
            stations: Some(vec![9]),
        });
    }),
    ("a tolerance of NaN", |s| s.tolerance_mm = Some(f64::NAN)),
    ("a negative tolerance", |s| s.tolerance_mm = Some(-1.0)),
    ("a noise of NaN", |s| {
        s.instrument.sigma_mm = Some(Sigma::Overall(f64::NAN))
    }),
    ("no noise", |s| {
        s.instrument.sigma_mm = Some(Sigma::Overall(0.0))
    }),
    ("a negative noise", |s| {
        s.instrument.sigma_mm = Some(Sigma::PerAxis([0.0, 1.0, -1.0]))
    }),
    ("no noise of targets", |s| {
        s.instrument.targets_sigma_mm = Some(0.0)
    }),
    ("no noise of orientations", |s| {
        s.instrument.sigma_orientation = Some(0.0)
    }),
    ("a tracker of NaN", |s| {
        let position_mm = Point3::new(f64::NAN, 0.0, 0.0);
        s.instrument.tracker = Some(Tracker {
            sigma_range_mm: 0.0,
            sigma_angle: f64::NAN,
            position_mm,
        });
    }),
    ("a target of NaN", |s| s.targets[0].position_mm.x = f64::NAN),
    ("a target far away", |s| s.targets[0].position_mm.x = 1e300),
    ("gravity of NaN", |s| {
        s.robot.gravity_m_s2 = Some(Vector3::repeat(f64::NAN))
    }),
    ("an axis of NaN", |s| {
        s.robot.joints[0].axis.point_mm.x = f64::NAN
    }),
    ("an axis far away", |s| {
        s.robot.joints[0].axis.point_mm.x = 1e160
    }),
    ("an axis without a direction", |s| {
        s.robot.joints[0].axis.direction = Unit::new_unchecked(Vector3::zeros());
    }),
    ("a tool of NaN", |s| {
        s.robot.base_from_tool = Pose::translation(f64::NAN, 0.0, 0.0)
    }),
    ("limits of NaN", |s| {
        s.robot.joints[0].limits = Some(Range {
            from: f64::NAN,
            to: 1.0,
        })
    }),
    ("limits the wrong way round", |s| {
        s.robot.joints[0].limits = Some(Range {
            from: 1.0,
            to: -1.0,
        })
    }),
    ("a link of NaN", |s| {
        s.robot.joints[0].link = Some(LinkMass {
            mass_kg: f64::NAN,
            centre_mm: Point3::origin(),
        });
    }),
    ("a joint that follows itself", |s| {
        s.robot.joints[0].follows = Some(Follows {
            of: 0,
            ratio: 1.0,
            offset: 0.0,
        });
    }),
    ("a joint that follows none", |s| {
        s.robot.joints[0].follows = Some(Follows {
            of: 33,
            ratio: 1.0,
            offset: 0.0,
        });
    }),
    ("a region of NaN", |s| {
        s.regions = vec![Region {
            name: "a".into(),
            from_rad: f64::NAN,
            to_rad: 1.0,
        }];
    }),
    ("an infinite q", |s| s.samples.q[0][1] = f64::INFINITY),
    ("an infinite x", |s| s.samples.x_mm[1] = f64::NEG_INFINITY),
    ("a z far away", |s| {
        s.samples.z_mm.as_mut().unwrap()[1] = 1e300
    }),
    ("an infinite time", |s| {
        s.samples.time_s.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite load", |s| {
        s.samples.load_kg.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite temperature", |s| {
        s.samples.temperature_c.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite speed", |s| {
        s.samples.speed[0] = Some(vec![f64::INFINITY; s.samples.len()])
    }),
];

/// These can be: what is missing is missing.
pub(crate) const STRANGE: &[Change] = &[
    ("nothing", |_| ()),
    ("no samples", |s| {
        s.samples.remove(&(0..s.samples.len()).collect::<Vec<_>>())
    }),
    ("no targets", |s| s.targets.clear()),
    ("no dir", |s| s.samples.dir.clear()),
    ("no speed", |s| s.samples.speed.clear()),
    ("no q_read", |s| s.samples.q_read.clear()),
    ("no z", |s| s.samples.z_mm = None),
    ("no x that is known", |s| s.samples.x_mm.fill(f64::NAN)),
    ("no q that is known", |s| s.samples.q[0].fill(f64::NAN)),
    ("no time that is known", |s| {
        s.samples.time_s.as_mut().unwrap().fill(f64::NAN)
    }),
    ("one point", |s| s.samples.x_mm.fill(7.0)),
    ("all held out", |s| {
        s.samples.held_out = Some(vec![true; s.samples.len()])
    }),
    ("all excluded", |s| {
        s.samples.excluded = Some(vec![true; s.samples.len()])
    }),
    ("a setup for each sample", |s| {
        let (names, index) = (0..s.samples.len() as u32)
            .map(|k| (k.to_string(), k))
            .unzip();
        s.samples.setups = Some(Setups { names, index });
    }),
    ("no orientation", |s| {
        let none = vec![0.0; s.samples.len()];
        s.samples.orientation_wxyz = Some([none.clone(), none.clone(), none.clone(), none]);
    }),
    ("distances without an anchor", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0; s.samples.len()]);
    }),
    ("names that are none", |s| {
        s.name = "\u{0}\u{7}".repeat(5000);
        s.robot.name = String::new();
        s.robot.joints[0].name = "<script>".to_owned();
    }),
];
