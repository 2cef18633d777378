//! Poses that are proposed where something else than points is measured: that they decide, and that they
//! can be measured as the session was. The sessions are made here by plain trigonometry, or by numpy.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::PathBuf;

use serde_json::{Value, json};
use truepose::diagnosis::{Diagnosis, NextPose, Options};
use truepose::effects::Inputs;
use truepose::inside::reflectors_at_home;
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, load, parse};

const ANCHORS: [(&str, [f64; 3]); 3] = [
    ("A1", [1500.0, 0.0, 200.0]),
    ("A2", [0.0, 1600.0, 500.0]),
    ("A3", [-1200.0, -900.0, 900.0]),
];
const SPEED: f64 = 20.0;

/// What is wrong with one rotary axis about z.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Hidden {
    /// s.
    Lag(f64),
    /// Width, degrees.
    Backlash(f64),
}

/// Angle and signed speed in degrees (per second), and the anchor.
type Row = (f64, f64, usize);

/// Uniform numbers from 0 to 1 (a linear congruence); the sum of twelve is near enough to a normal one.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// Sixty distances at one speed in both directions, where a lag and a backlash are the same.
fn rows(random: &mut Random) -> Vec<Row> {
    let one = |random: &mut Random| {
        let q = (10.0 * (340.0 * random.next() - 170.0)).round() / 10.0;
        let side = if random.next() < 0.5 { -1.0 } else { 1.0 };
        let drawn = 3.0 * random.next();
        let anchor = [1.0, 2.0].iter().filter(|limit| drawn > **limit).count();
        (q, side * SPEED, anchor)
    };
    (0..60).map(|_| one(random)).collect()
}

fn session(rows: &[Row], hidden: Hidden, seed: u64) -> Session {
    let mut random = Random(seed);
    let mut distance = |(q, speed, anchor): &Row| {
        let off = match hidden {
            Hidden::Lag(seconds) => -seconds * speed,
            Hidden::Backlash(width) => -0.5 * width * side_of(*speed),
        };
        let (sin, cos) = (q + 0.2 + off).to_radians().sin_cos();
        let at = [420.0 * cos - 60.0 * sin, 420.0 * sin + 60.0 * cos, 350.0];
        let from = ANCHORS[*anchor].1;
        let square: f64 = (0..3).map(|k| (at[k] - from[k]).powi(2)).sum();
        let exact: f64 = square.sqrt() + 0.03 * random.normal();
        (exact * 1e5).round() / 1e5
    };
    let distances: Vec<f64> = rows.iter().map(&mut distance).collect();
    let column = |f: &dyn Fn(&Row) -> Value| rows.iter().map(f).collect::<Vec<_>>();
    let anchors = ANCHORS.iter().map(|(name, at)| {
        let anchor = json!({ "position_mm": at, "offset_mm": 0 });
        ((*name).to_owned(), anchor)
    });
    let text = json!({
        "format": "truepose-session/1",
        "name": "distances",
        "robot": {
            "name": "turntable",
            "joints": [{ "name": "J1", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] }],
            "tool": { "position_mm": [420, 60, 350], "quaternion_wxyz": [1, 0, 0, 0] },
        },
        "targets": { "T": [0, 0, 0] },
        "instrument": { "name": "draw-wire", "sigma_distance_mm": 0.03 },
        "anchors": anchors.collect::<serde_json::Map<_, _>>(),
        "samples": { "columns": {
            "q1_deg": column(&|r| json!(r.0)),
            "dir1": column(&|r| json!(side_of(r.1))),
            "speed1_deg_s": column(&|r| json!(r.1)),
            "anchor": column(&|r| json!(ANCHORS[r.2].0)),
            "distance_mm": distances,
        } },
    });
    parse(text.to_string().as_bytes()).unwrap().session
}

fn side_of(speed: f64) -> f64 {
    if speed < 0.0 { -1.0 } else { 1.0 }
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

fn ids(answer: &Diagnosis) -> Vec<&'static str> {
    answer.found.iter().map(|f| f.effect).collect()
}

/// The row that a proposed pose asks for, which says from where it is measured.
fn asked(pose: &NextPose) -> Row {
    let anchor = |name: &str| pose.why.contains(&format!("measure distance {name}"));
    let index = ANCHORS.iter().position(|(name, _)| anchor(name));
    // A turntable that stands is measured as it arrived.
    let speed = pose.speed.as_ref().map_or(0.0, |s| s[0].to_degrees());
    let signed = if speed == 0.0 {
        pose.dir[0] * 1e-9
    } else {
        speed
    };
    (pose.q[0].to_degrees(), signed, index.unwrap())
}

#[test]
fn proposed_distances_tell_a_lag_from_a_backlash_in_one_round() {
    for (seed, hidden) in [
        (1, Hidden::Lag(0.02)),
        (2, Hidden::Lag(0.02)),
        (3, Hidden::Backlash(0.8)),
        (4, Hidden::Backlash(0.8)),
    ] {
        let truth = match hidden {
            Hidden::Lag(_) => "tracking-lag",
            Hidden::Backlash(_) => "backlash",
        };
        let mut rows = rows(&mut Random(seed));
        let answer = diagnosed(&session(&rows, hidden, seed + 100));
        let instead = answer.equivalent.iter().flat_map(|e| &e.instead);
        let set: Vec<&str> = ids(&answer)
            .into_iter()
            .chain(instead.map(String::as_str))
            .collect();
        for name in ["tracking-lag", "backlash"] {
            assert!(set.contains(&name), "{hidden:?}: {set:?}");
        }
        assert!(!answer.next_poses.is_empty(), "{hidden:?}");
        rows.extend(answer.next_poses.iter().map(asked));
        let answer = diagnosed(&session(&rows, hidden, seed + 100));
        assert_eq!(ids(&answer), [truth], "{hidden:?}");
        assert!(
            answer.equivalent.is_empty(),
            "{hidden:?}: {:?}",
            answer.equivalent
        );
    }
}

/// A ball is measured in its sockets and nowhere else: every proposed pose has it in the one it names.
#[test]
fn poses_that_are_proposed_for_sockets_are_in_them() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations");
    let session = load(folder.join("six-socket.json")).unwrap().session;
    let answer = diagnosed(&session);
    assert!(!answer.next_poses.is_empty());
    for pose in &answer.next_poses {
        let q = pose.q.iter().map(|q| vec![*q]).collect();
        let at = answer
            .model
            .predict(&Inputs::at_poses(q, reflectors_at_home(&session)));
        let sockets = &session.instrument.references.sockets;
        let mut named = sockets.iter();
        let own = named
            .find(|s| pose.why.contains(&format!("measure socket {}", s.name)))
            .unwrap();
        let place = own.position_mm.unwrap();
        let off: f64 = (0..3).map(|k| (at.get(0)[k] - place[k]).powi(2)).sum();
        assert!(
            off.sqrt() < 0.5,
            "{}: {:.3} mm beside it",
            own.name,
            off.sqrt()
        );
    }
}

/// The ways of measuring are taken from the first samples of each; that a person took these out says
/// nothing of the poses to come.
#[test]
fn poses_are_proposed_though_the_samples_they_are_like_were_excluded() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations");
    let mut session = load(folder.join("six-socket.json")).unwrap().session;
    let out = (0..session.samples.len()).map(|sample| sample < 12);
    session.samples.excluded = Some(out.collect());
    assert!(!diagnosed(&session).next_poses.is_empty());
}
