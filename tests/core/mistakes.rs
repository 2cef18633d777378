//! Whatever mistake is put into a session: what `verify` finds on it is what was said, or the model is refused; and
//! what is made from a model makes the robot better, and with the sign turned doubles its error.
//!
//! Every session of the repository gets mistakes of setting up; five arms and one axis are simulated by
//! `hidden_robot`, which shares no code with the program, and driven through the same mistakes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::cases::every_case;
use crate::gate::{figure_of, sessions};
use crate::hidden_robot::{Hidden, apart};
use crate::rig::Random;
use truepose::effects::JointValues;
use truepose::model::{Calibration, read_model};
use truepose::pipeline::{self, Method, hand_out, identify_checked};
use truepose::programs::{ProgramFrames, Request, find};
use truepose::sessions::{Samples, Session, load, parse};

const DEG: f64 = std::f64::consts::PI / 180.0;

/// What somebody does wrong to a session; false where the session has nothing that it could be done to.
type Mistake = (&'static str, fn(&mut Session, usize) -> bool);

/// A joint other than the first, where there is one.
fn joint(session: &Session, pick: usize) -> usize {
    let n = session.robot.joints.len();
    if n < 2 { 0 } else { 1 + pick % (n - 1) }
}

fn scaled(session: &mut Session, by: f64) -> bool {
    let samples = &mut session.samples;
    let columns = [&mut samples.x_mm, &mut samples.y_mm].into_iter();
    let mut any = false;
    for value in columns.chain(&mut samples.z_mm).flatten() {
        any |= value.is_finite();
        *value *= by;
    }
    any
}

fn columns(samples: &mut Samples) -> Vec<&mut Vec<f64>> {
    let Samples {
        x_mm,
        y_mm,
        z_mm,
        orientation_wxyz,
        observed,
        ..
    } = samples;
    let measured = [x_mm, y_mm].into_iter().chain(z_mm);
    let turned = orientation_wxyz.iter_mut().flatten();
    let observed = [
        &mut observed.distance_mm,
        &mut observed.azimuth,
        &mut observed.elevation,
    ];
    measured
        .chain(turned)
        .chain(observed.into_iter().flatten())
        .collect()
}

fn exchanged(indices: Option<&mut Vec<Option<u32>>>) -> bool {
    let mut any = false;
    for index in indices.into_iter().flatten().flatten() {
        any |= *index < 2;
        *index = [1, 0].get(*index as usize).copied().unwrap_or(*index);
    }
    any
}

/// From half of the rows on, what these columns have of the first of a column of names is more by so much.
fn moved<T: Copy + Into<Option<u32>>>(
    names: Option<&Vec<T>>,
    columns: [Option<&mut Vec<f64>>; 2],
    by: f64,
) -> bool {
    let mut any = false;
    for column in columns.into_iter().flatten() {
        let half = column.len() / 2;
        for (row, value) in column.iter_mut().enumerate().skip(half) {
            if names.is_none_or(|names| names[row].into() == Some(0)) && value.is_finite() {
                *value += by;
                any = true;
            }
        }
    }
    any
}

const MISTAKES: [Mistake; 30] = [
    ("inches", |s, _| scaled(s, 1.0 / 25.4)),
    ("metres", |s, _| scaled(s, 1e-3)),
    ("x and y exchanged", |s, _| {
        let samples = &mut s.samples;
        std::mem::swap(&mut samples.x_mm, &mut samples.y_mm);
        true
    }),
    ("mirrored", |s, _| {
        s.samples.y_mm.iter_mut().for_each(|y| *y = -*y);
        true
    }),
    ("sign of a joint", |s, pick| {
        let joint = joint(s, pick);
        s.samples.q[joint].iter_mut().for_each(|q| *q = -*q);
        true
    }),
    ("home of a joint", |s, pick| {
        let joint = joint(s, pick);
        s.samples.q[joint].iter_mut().for_each(|q| *q += 90.0 * DEG);
        true
    }),
    ("half a turn", |s, pick| {
        let joint = joint(s, pick);
        s.samples.q[joint]
            .iter_mut()
            .for_each(|q| *q += 180.0 * DEG);
        true
    }),
    ("joints exchanged", |s, pick| {
        let (n, joint) = (s.robot.joints.len(), joint(s, pick));
        s.samples.q.swap(joint, (joint + 1) % n);
        n > 1
    }),
    ("joints in another order", |s, _| {
        s.samples.q.rotate_left(1);
        s.robot.joints.len() > 2
    }),
    ("a joint in degrees for radians", |s, pick| {
        let joint = joint(s, pick);
        s.samples.q[joint].iter_mut().for_each(|q| *q *= DEG);
        true
    }),
    ("joints coupled", |s, pick| {
        let joint = joint(s, pick);
        if joint == 0 {
            return false;
        }
        let (before, from) = s.samples.q.split_at_mut(joint);
        for (q, other) in from[0].iter_mut().zip(&before[joint - 1]) {
            *q += other;
        }
        true
    }),
    ("rows slipped", |s, pick| {
        let from = s.samples.len() / 3 + pick;
        for column in columns(&mut s.samples) {
            if from < column.len() {
                column[from..].rotate_left(1);
            }
        }
        s.samples.len() > 20
    }),
    ("a file pasted below itself", |s, _| {
        let half = s.samples.len() / 2;
        for column in columns(&mut s.samples) {
            column.copy_within(..half, half);
        }
        for q in &mut s.samples.q {
            q.copy_within(..half, half);
        }
        half > 3
    }),
    ("targets exchanged", |s, _| {
        let mut any = false;
        for index in s.samples.target.iter_mut().flatten() {
            any |= *index < 2;
            *index = [1, 0].get(*index as usize).copied().unwrap_or(*index);
        }
        any
    }),
    ("sockets exchanged", |s, _| {
        exchanged(s.samples.observed.socket.as_mut())
    }),
    ("anchors exchanged", |s, _| {
        exchanged(s.samples.observed.anchor.as_mut())
    }),
    ("stations exchanged", |s, _| {
        exchanged(s.samples.observed.station.as_mut())
    }),
    ("a target knocked half way through", |s, _| {
        let samples = &mut s.samples;
        let columns = [Some(&mut samples.x_mm), Some(&mut samples.y_mm)];
        moved(samples.target.as_ref(), columns, 2.0)
    }),
    ("an anchor moved half way through", |s, _| {
        let observed = &mut s.samples.observed;
        let columns = [observed.distance_mm.as_mut(), None];
        moved(observed.anchor.as_ref(), columns, 3.0)
    }),
    ("a station turned half way through", |s, _| {
        let observed = &mut s.samples.observed;
        let columns = [observed.azimuth.as_mut(), observed.elevation.as_mut()];
        moved(observed.station.as_ref(), columns, 4e-3)
    }),
    ("a socket elsewhere than stated", |s, _| {
        let mut stated = s.instrument.references.sockets.iter_mut();
        let place = stated.find_map(|socket| socket.position_mm.as_mut());
        place.map(|place| place.x += 4.0).is_some()
    }),
    ("an anchor elsewhere than stated", |s, _| {
        let mut stated = s.instrument.references.anchors.iter_mut();
        let place = stated.find_map(|anchor| anchor.position_mm.as_mut());
        place.map(|place| place.y -= 4.0).is_some()
    }),
    ("a plane elsewhere than stated", |s, _| {
        let mut stated = s.instrument.references.planes.iter_mut();
        let known = stated.find_map(|plane| plane.stated.as_mut());
        known.map(|(_, distance)| *distance += 3.0).is_some()
    }),
    ("a joint's sign and metres", |s, pick| {
        let joint = joint(s, pick);
        s.samples.q[joint].iter_mut().for_each(|q| *q = -*q);
        scaled(s, 1e-3)
    }),
    ("two homes", |s, pick| {
        let (n, one) = (s.robot.joints.len(), joint(s, pick));
        for joint in [one, (one + 1) % n] {
            s.samples.q[joint].iter_mut().for_each(|q| *q += 90.0 * DEG);
        }
        n > 1
    }),
    ("the values of a motor", |s, pick| {
        let one = joint(s, pick);
        s.samples.q[one].iter_mut().for_each(|q| *q *= 101.0);
        true
    }),
    ("one coordinate in metres", |s, pick| {
        let samples = &mut s.samples;
        let columns = [&mut samples.x_mm, &mut samples.y_mm];
        let mut columns: Vec<_> = columns.into_iter().chain(&mut samples.z_mm).collect();
        let one = pick % columns.len();
        columns[one].iter_mut().for_each(|v| *v *= 0.001);
        true
    }),
    ("the tool of another robot", |s, _| {
        s.robot.base_from_tool.translation.vector.x += 80.0;
        s.robot.base_from_tool.translation.vector.z -= 35.0;
        true
    }),
    ("orientation the other way", |s, _| {
        let Some([_, x, y, z]) = &mut s.samples.orientation_wxyz else {
            return false;
        };
        for value in [x, y, z].into_iter().flatten() {
            *value = -*value;
        }
        true
    }),
    ("conditions in another unit", |s, _| {
        let samples = &mut s.samples;
        let conditions = samples
            .speed
            .iter_mut()
            .flatten()
            .chain(&mut samples.load_kg);
        let mut any = false;
        for value in conditions.flatten() {
            any = true;
            *value *= -1000.0;
        }
        any
    }),
];

/// So many mistakes are put into every session, one each; with `EVERY_CASE` in the environment all of them (some
/// minutes more).
const EACH: usize = 1;
/// Longer sessions are the same kinds with more samples.
const LONGEST: usize = 130;
/// But for a mistake that no shorter one can have.
const LONGEST_OF_ALL: usize = 1000;

fn identified(session: &Session) -> Option<(Calibration, f64)> {
    let method = Method::default();
    let found = identify_checked(session, &method, JointValues::Commanded).ok()?;
    Some((found.calibration, found.identification.gap.after.rms_mm))
}

#[test]
fn verify_gives_what_was_said_whatever_mistake_is_in_a_session() {
    let mut put = [0; MISTAKES.len()];
    let mut handed_out = 0;
    let (each, longest) = if every_case() {
        (MISTAKES.len(), LONGEST_OF_ALL)
    } else {
        (EACH, LONGEST)
    };
    for path in sessions() {
        let sound = load(&path).unwrap().session;
        let long = sound.samples.len();
        if long > LONGEST_OF_ALL {
            continue;
        }
        let mut given = 0;
        // What was put in least often so far comes first: few sessions have sockets or stations.
        let mut order: Vec<usize> = (0..MISTAKES.len()).collect();
        order.sort_by_key(|at| put[*at]);
        for at in order {
            let (name, make) = MISTAKES[at];
            let mut session = sound.clone();
            let enough = given == each || long > longest && put[at] > 0;
            if enough || !make(&mut session, at) {
                continue;
            }
            given += 1;
            put[at] += 1;
            let what = format!("{}: {name}", path.display());
            let Some((calibration, said)) = identified(&session) else {
                continue;
            };
            // What makes its own session worse than the nominal robot is not handed out.
            let Ok(verified) = hand_out(&calibration, &session) else {
                continue;
            };
            handed_out += 1;
            let read = read_model(&verified.document()).unwrap();
            assert_eq!(read.set_up, calibration.set_up, "{what}");
            let (found, within) = figure_of(&read, &session);
            assert!(
                (found - said).abs() <= within * said.max(1e-6),
                "{what}: {found} mm, and {said} was said; {:?}",
                calibration.set_up
            );
        }
    }
    assert!(put.iter().all(|count| *count > 0), "{put:?}");
    assert!(
        2 * handed_out > put.iter().sum::<usize>(),
        "{handed_out} of {put:?}"
    );
}

/// A robot on paper: joints as (turns, axis, point, from, to), the tool at home.
type Drawn = (
    &'static str,
    &'static [(bool, [f64; 3], [f64; 3], f64, f64)],
    [f64; 3],
);

const ARMS: [Drawn; 5] = [
    (
        "six",
        &[
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], -160.0, 160.0),
            (true, [0.0, 1.0, 0.0], [0.0, 0.0, 300.0], -80.0, 100.0),
            (true, [0.0, 1.0, 0.0], [0.0, 0.0, 600.0], -100.0, 60.0),
            (true, [1.0, 0.0, 0.0], [0.0, 0.0, 670.0], -150.0, 150.0),
            (true, [0.0, 1.0, 0.0], [320.0, 0.0, 670.0], -110.0, 110.0),
            (true, [1.0, 0.0, 0.0], [320.0, 0.0, 670.0], -170.0, 170.0),
        ],
        [400.0, 0.0, 670.0],
    ),
    (
        "parallel",
        &[
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], -170.0, 170.0),
            (true, [0.0, -1.0, 0.0], [0.0, 0.0, 160.0], -140.0, -10.0),
            (true, [0.0, -1.0, 0.0], [-450.0, 0.0, 160.0], -130.0, 130.0),
            (true, [0.0, -1.0, 0.0], [-860.0, 0.0, 160.0], -160.0, 160.0),
            (
                true,
                [0.0, 0.0, -1.0],
                [-860.0, -120.0, 160.0],
                -160.0,
                160.0,
            ),
            (
                true,
                [0.0, -1.0, 0.0],
                [-860.0, -120.0, 60.0],
                -170.0,
                170.0,
            ),
        ],
        [-860.0, -200.0, 60.0],
    ),
    (
        "seven",
        &[
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], -160.0, 160.0),
            (true, [0.0, 1.0, 0.0], [0.0, 0.0, 330.0], -100.0, 100.0),
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 330.0], -160.0, 160.0),
            (true, [0.0, -1.0, 0.0], [0.0, 0.0, 720.0], -100.0, 100.0),
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 720.0], -160.0, 160.0),
            (true, [0.0, 1.0, 0.0], [0.0, 0.0, 1110.0], -100.0, 100.0),
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 1110.0], -170.0, 170.0),
        ],
        [0.0, 0.0, 1230.0],
    ),
    (
        "scara",
        &[
            (true, [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], -130.0, 130.0),
            (true, [0.0, 0.0, 1.0], [310.0, 0.0, 0.0], -140.0, 140.0),
            (false, [0.0, 0.0, -1.0], [560.0, 0.0, 0.0], 0.0, 180.0),
            (true, [0.0, 0.0, -1.0], [560.0, 0.0, 0.0], -170.0, 170.0),
        ],
        [560.0, 0.0, 120.0],
    ),
    (
        "positioner",
        &[
            (true, [0.0, 1.0, 0.0], [0.0, 0.0, 500.0], -80.0, 80.0),
            (true, [0.0, 0.02, 1.0], [0.0, 0.0, 620.0], -170.0, 170.0),
        ],
        [180.0, 40.0, 640.0],
    ),
];
const TARGETS: [[f64; 3]; 3] = [[10.0, 5.0, 70.0], [75.0, -20.0, 35.0], [-45.0, 60.0, 50.0]];

/// True joint values to those that the session and its programs have, and back; rad and mm.
struct Convention {
    name: &'static str,
    to_raw: fn(&mut [f64]),
    from_raw: fn(&mut [f64]),
    seen: fn([f64; 3]) -> [f64; 3],
}

const SAME: fn(&mut [f64]) = |_| {};
const AS_IT_IS: fn([f64; 3]) -> [f64; 3] = |p| p;

const CONVENTIONS: [Convention; 7] = [
    Convention {
        name: "none",
        to_raw: SAME,
        from_raw: SAME,
        seen: AS_IT_IS,
    },
    Convention {
        name: "joint 2 reversed",
        to_raw: |q| q[1] = -q[1],
        from_raw: |q| q[1] = -q[1],
        seen: AS_IT_IS,
    },
    Convention {
        name: "home of the last joint",
        to_raw: |q| *q.last_mut().unwrap() -= 90.0 * DEG,
        from_raw: |q| *q.last_mut().unwrap() += 90.0 * DEG,
        seen: AS_IT_IS,
    },
    Convention {
        name: "joints 1 and 2 exchanged",
        to_raw: |q| q.swap(0, 1),
        from_raw: |q| q.swap(0, 1),
        seen: AS_IT_IS,
    },
    Convention {
        name: "inches",
        to_raw: SAME,
        from_raw: SAME,
        seen: |p| p.map(|v| v / 25.4),
    },
    Convention {
        name: "metres",
        to_raw: SAME,
        from_raw: SAME,
        seen: |p| p.map(|v| v / 1000.0),
    },
    Convention {
        name: "x and y exchanged",
        to_raw: SAME,
        from_raw: SAME,
        seen: |[x, y, z]| [y, x, z],
    },
];

/// An arm whose links, zeros and tool are off by what a workshop leaves.
fn hidden(arm: &Drawn, random: &mut Random) -> Hidden {
    let (_, joints, tool) = arm;
    let at =
        |p: [f64; 3]| serde_json::json!([1, 0, 0, p[0], 0, 1, 0, p[1], 0, 0, 1, p[2], 0, 0, 0, 1]);
    let mut link = |first: bool| {
        if first {
            return at([0.0; 3]);
        }
        // Small turns in the order z, y, x, exact rotations all the same.
        let [a, b, c] = [0; 3].map(|_| 0.5e-3 * random.normal());
        let ((sa, ca), (sb, cb), (sc, cc)) = (a.sin_cos(), b.sin_cos(), c.sin_cos());
        let [x, y, z] = [0; 3].map(|_| 0.3 * random.normal());
        serde_json::json!([
            cc * cb,
            cc * sb * sa - sc * ca,
            cc * sb * ca + sc * sa,
            x,
            sc * cb,
            sc * sb * sa + cc * ca,
            sc * sb * ca - cc * sa,
            y,
            -sb,
            cb * sa,
            cb * ca,
            z,
            0,
            0,
            0,
            1
        ])
    };
    let links: Vec<_> = (0..joints.len()).map(|i| link(i == 0)).collect();
    let zeros: Vec<f64> = joints
        .iter()
        .enumerate()
        .map(|(i, joint)| match (i, joint.0) {
            (0, _) => 0.0,
            (_, true) => 0.2 * DEG * random.normal(),
            (_, false) => 0.4 * random.normal(),
        })
        .collect();
    let off = tool.map(|v| v + random.normal());
    let described = joints.iter().map(|(turns, axis, point, ..)| {
        let length = axis.iter().map(|v| v * v).sum::<f64>().sqrt();
        serde_json::json!({ "kind": if *turns { "revolute" } else { "prismatic" },
            "axis": axis.map(|v| v / length), "point": point })
    });
    Hidden::new(&serde_json::json!({
        "joints": described.collect::<Vec<_>>(), "links": links, "zeros": zeros,
        "compliance": vec![0.0; joints.len()], "tool": at(off), "nominal_tool": at(*tool) }))
}

fn units(arm: &Drawn) -> Vec<(&'static str, f64)> {
    let unit = |joint: &(bool, _, _, f64, f64)| if joint.0 { ("deg", DEG) } else { ("mm", 1.0) };
    arm.1.iter().map(unit).collect()
}

fn heading(arm: &Drawn) -> Vec<String> {
    let units = units(arm).into_iter().enumerate();
    units
        .map(|(i, (unit, _))| format!("q{}_{unit}", i + 1))
        .collect()
}

/// Joint values as the controller has them, in its units.
fn raw(arm: &Drawn, convention: &Convention, q: &[f64]) -> Vec<f64> {
    let mut raw = q.to_vec();
    (convention.to_raw)(&mut raw);
    let units = units(arm).into_iter();
    raw.iter()
        .zip(units)
        .map(|(v, (_, unit))| v / unit)
        .collect()
}

fn somewhere(arm: &Drawn, random: &mut Random, share: f64) -> Vec<f64> {
    let joints = arm.1.iter().zip(units(arm));
    joints
        .map(|((_, _, _, low, high), (_, unit))| {
            let (middle, half) = ((low + high) / 2.0, share * (high - low) / 2.0);
            random.between(middle - half, middle + half) * unit
        })
        .collect()
}

/// The session that a tracker in the base frame makes of an arm.
fn measured(arm: &Drawn, robot: &Hidden, convention: &Convention, random: &mut Random) -> Session {
    let mut q_columns = vec![Vec::new(); arm.1.len()];
    let mut points = [Vec::new(), Vec::new(), Vec::new()];
    let mut names = Vec::new();
    for _ in 0..90 {
        let q = somewhere(arm, random, 1.0);
        let target = random.below(3);
        let tool = robot.real(&q, 0.0);
        let at = TARGETS[target];
        let point: [f64; 3] = std::array::from_fn(|r| {
            (0..3).map(|k| tool[r][k] * at[k]).sum::<f64>() + tool[r][3] + 0.03 * random.normal()
        });
        for (column, value) in points.iter_mut().zip((convention.seen)(point)) {
            column.push(value);
        }
        for (column, value) in q_columns.iter_mut().zip(raw(arm, convention, &q)) {
            column.push(value);
        }
        names.push(format!("T{}", target + 1));
    }
    let mut columns = serde_json::Map::new();
    for (name, column) in heading(arm).into_iter().zip(q_columns) {
        columns.insert(name, serde_json::json!(column));
    }
    for (name, column) in ["x_mm", "y_mm", "z_mm"].into_iter().zip(points) {
        columns.insert(name.to_owned(), serde_json::json!(column));
    }
    columns.insert("target".to_owned(), serde_json::json!(names));
    let joints = arm
        .1
        .iter()
        .enumerate()
        .map(|(i, (turns, axis, point, ..))| {
            serde_json::json!({ "name": format!("j{}", i + 1), "axis": axis, "point_mm": point,
            "kind": if *turns { "revolute" } else { "prismatic" }, "limits": [-400, 400] })
        });
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": arm.0,
        "robot": { "name": arm.0, "joints": joints.collect::<Vec<_>>(),
            "tool": { "position_mm": arm.2, "quaternion_wxyz": [1, 0, 0, 0] } },
        "targets": { "T1": TARGETS[0], "T2": TARGETS[1], "T3": TARGETS[2] },
        "instrument": { "name": "tracker", "sigma_mm": 0.03 },
        "samples": { "columns": columns } });
    parse(document.to_string().as_bytes()).unwrap().session
}

/// Root mean square distance of the tool from where the drawing has it, mm: as it is, with a corrected program, and
/// with what that adds taken off; and the middle of how many times the error each target has with that. `None` where no
/// program is made.
fn driven(
    arm: &Drawn,
    robot: &Hidden,
    convention: &Convention,
    (calibration, session): (&Calibration, &Session),
    random: &mut Random,
) -> Option<([f64; 3], f64)> {
    let verified = hand_out(calibration, session).ok()?;
    let wanted: Vec<Vec<f64>> = (0..16).map(|_| somewhere(arm, random, 0.25)).collect();
    let row = |q: &Vec<f64>| {
        let cells: Vec<String> = raw(arm, convention, q)
            .iter()
            .map(|v| format!("{v:.6}"))
            .collect();
        cells.join(",")
    };
    let rows: Vec<String> = wanted.iter().map(row).collect();
    let text = format!("{}\n{}\n", heading(arm).join(","), rows.join("\n"));
    let request = Request {
        calibration: &verified,
        bytes: text.as_bytes(),
        language: find("csv").unwrap(),
        file: None,
        beside: Vec::new(),
        load_kg: 0.0,
        start: None,
        frame: None,
        tool: None,
        // The tracker measures in the base frame; without it the height along the first axis would be the drawing's.
        measured_frame: true,
        frames: ProgramFrames::default(),
    };
    let answer = pipeline::compensate(&request).ok()?;
    let written = String::from_utf8(answer.bytes.clone()).unwrap();
    let mut squares = [0.0; 3];
    let mut times = Vec::new();
    let rows = written.lines().skip(1).zip(&wanted).zip(&answer.targets);
    for ((line, q), target) in rows {
        // What stays as it is near a singular wrist is said, and is no correction.
        if target.result.is_err() {
            continue;
        }
        let cells = line.split(',').zip(units(arm));
        let mut told: Vec<f64> = cells
            .map(|(v, (_, unit))| v.parse::<f64>().unwrap() * unit)
            .collect();
        (convention.from_raw)(&mut told);
        let turned: Vec<f64> = q.iter().zip(&told).map(|(q, u)| 2.0 * q - u).collect();
        let goal = robot.nominal(q);
        let off = [q, &told, &turned].map(|q| apart(&robot.real(q, 0.0), &goal).0);
        for (square, off) in squares.iter_mut().zip(off) {
            *square += off * off;
        }
        times.push(off[2] / off[0]);
    }
    assert!(
        2 * times.len() > wanted.len(),
        "{} are corrected",
        times.len()
    );
    times.sort_by(f64::total_cmp);
    let middle = times[times.len() / 2];
    Some((
        squares.map(|square| (square / times.len() as f64).sqrt()),
        middle,
    ))
}

#[test]
fn a_program_makes_every_kind_of_arm_better_and_turned_about_it_doubles_its_error() {
    let mut count = 0;
    for (at, arm) in ARMS.iter().enumerate() {
        for (k, convention) in CONVENTIONS.iter().enumerate() {
            if !(every_case() || (at + k).is_multiple_of(3)) {
                continue;
            }
            let what = format!("{}, {}", arm.0, convention.name);
            let mut random = Random((at * 31 + k) as u64);
            let robot = hidden(arm, &mut random);
            let session = measured(arm, &robot, convention, &mut random);
            let (calibration, said) = identified(&session).unwrap();
            // What is not recognised is far off, and that is what is said.
            let recognised = said < 0.1;
            let driven = driven(
                arm,
                &robot,
                convention,
                (&calibration, &session),
                &mut random,
            );
            let Some(([before, after, turned], times)) = driven else {
                continue;
            };
            if !recognised {
                assert!(after <= before, "{what}: {said} mm, {before} → {after}");
                continue;
            }
            count += 1;
            // Joints that are fewer than six correct what they can.
            let most = if arm.1.len() < 6 { 0.9 } else { 0.15 };
            assert!(after < most * before, "{what}: {before} → {after}");
            if arm.1.len() >= 6 {
                // Near a singular wrist a correction takes large moves of the joints, of which twice is not twice.
                assert!(
                    (times - 2.0).abs() < 0.2,
                    "{what}: {before} → {turned}, {times} times"
                );
            } else {
                assert!(turned > 1.1 * before, "{what}: {before} → {turned}");
            }
        }
    }
    let most = if every_case() { 25 } else { 8 };
    assert!(count > most, "{count}");
}
