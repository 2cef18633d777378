//! What few poses do not show is said: sessions whose poses hold a joint, or follow one line, and that hold out poses
//! over the joint ranges. Made from rotations alone.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{Isometry3, Point3, Rotation3, Vector3};

use crate::rig::Random;
use truepose::compensation::NotHandedOut;
use truepose::diagnosis::{Options, Verdict};
use truepose::effects::{JointValues, Term, find};
use truepose::model::{Calibration, Model};
use truepose::pipeline::{Identified, Method, diagnose, hand_out, identify_checked};
use truepose::sessions::{Session, parse};

/// A robot and its instrument.
#[derive(Clone, Copy)]
struct Rig {
    /// Where the elbow goes when it is sent there.
    elbow: fn(f64) -> f64,
    /// How far zeros, elbow and tool are off: 1 is some mrad and some mm, 0 a robot as it was drawn.
    worn: f64,
    /// Whether the noise of the instrument is stated.
    stated: bool,
}

const USUAL: Rig = Rig {
    elbow: |sent| sent,
    worn: 1.0,
    stated: true,
};

/// A slide, a column, two axes across it and a tool, seen by an instrument that stands anywhere.
fn point(q: [f64; 4], worn: f64, seen_from: &Isometry3<f64>) -> Point3<f64> {
    let turned = |axis: Vector3<f64>, at: [f64; 3], angle: f64| {
        let at = Vector3::from(at);
        let turn = Rotation3::new(axis * angle);
        Isometry3::from_parts((at - turn * at).into(), turn.into())
    };
    let column = turned(Vector3::z(), [0.0; 3], q[1] + 0.003 * worn);
    let tilt = turned(Vector3::y(), [0.0, 0.0, 400.0], q[2] - 0.002 * worn);
    let elbow = turned(
        Vector3::y(),
        [500.0 + 1.2 * worn, 0.0, 400.0 - 1.2 * worn],
        q[3] + 0.004 * worn,
    );
    let slid = Isometry3::translation(q[0], 0.0, 0.0);
    seen_from
        * (slid
            * column
            * tilt
            * elbow
            * Point3::new(900.0 + 3.0 * worn, -4.0 * worn, 450.0 + 5.0 * worn))
}

/// 40 poses of these joint values, with 200 held out over the ranges, 0.02 mm of noise.
fn session(
    poses: impl Fn(&mut Random) -> [f64; 4],
    seen_from: &Isometry3<f64>,
    rig: Rig,
) -> Session {
    let mut random = Random(5);
    let mut columns = vec![Vec::new(); 7];
    let mut part = Vec::new();
    for k in 0..240 {
        let q = if k < 40 {
            poses(&mut random)
        } else {
            anywhere(&mut random)
        };
        let at = point([q[0], q[1], q[2], (rig.elbow)(q[3])], rig.worn, seen_from);
        let values = [
            q[0],
            q[1].to_degrees(),
            q[2].to_degrees(),
            q[3].to_degrees(),
        ];
        let measured = at.coords.map(|x| x + 0.02 * random.normal());
        for (column, value) in columns.iter_mut().zip(values.iter().chain(measured.iter())) {
            column.push(*value);
        }
        part.push(if k < 40 { "fit" } else { "held-out" });
    }
    let joint = |name: &str, kind: &str, axis: [f64; 3], at: [f64; 3], limits: [f64; 2]| serde_json::json!({ "name": name, "kind": kind, "axis": axis, "point_mm": at, "limits": limits });
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "few poses",
        "robot": { "name": "on a slide",
            "tool": { "position_mm": [900, 0, 450], "quaternion_wxyz": [1, 0, 0, 0] },
            "joints": [
                joint("slide", "prismatic", [1.0, 0.0, 0.0], [0.0; 3], [0.0, 1000.0]),
                joint("column", "revolute", [0.0, 0.0, 1.0], [0.0; 3], [-90.0, 90.0]),
                joint("tilt", "revolute", [0.0, 1.0, 0.0], [0.0, 0.0, 400.0], [-60.0, 60.0]),
                joint("elbow", "revolute", [0.0, 1.0, 0.0], [500.0, 0.0, 400.0], [-60.0, 60.0]) ] },
        "instrument": if rig.stated {
            serde_json::json!({ "name": "tracker", "sigma_mm": 0.02 })
        } else {
            serde_json::json!({ "name": "tracker" })
        },
        "samples": { "columns": {
            "q1_mm": columns[0], "q2_deg": columns[1], "q3_deg": columns[2], "q4_deg": columns[3],
            "x_mm": columns[4], "y_mm": columns[5], "z_mm": columns[6],
            "setup": vec!["S1"; part.len()], "use": part } } });
    parse(document.to_string().as_bytes()).unwrap().session
}

/// Identified from 40 poses of these joint values.
fn identified(poses: impl Fn(&mut Random) -> [f64; 4], seen_from: &Isometry3<f64>) -> Identified {
    let session = session(poses, seen_from, USUAL);
    identify_checked(&session, &Method::default(), JointValues::Commanded).unwrap()
}

fn anywhere(random: &mut Random) -> [f64; 4] {
    let turn = |random: &mut Random, most: f64| random.between(-most, most).to_radians();
    [
        random.between(0.0, 1000.0),
        turn(random, 90.0),
        turn(random, 60.0),
        turn(random, 60.0),
    ]
}

fn stands_anywhere() -> Isometry3<f64> {
    Isometry3::new(
        Vector3::new(2500.0, -1800.0, 700.0),
        Vector3::new(0.4, -1.1, 1.9),
    )
}

/// Root mean square at the fitted poses, at those held out, and what was expected there, mm.
fn errors(answer: &Identified) -> [f64; 3] {
    let identification = &answer.identification;
    let held_out = identification.held_out.as_ref().unwrap();
    let expected = identification.expected.as_ref().unwrap();
    [
        identification.gap.after.rms_mm,
        held_out.after.rms_mm,
        expected.rms_mm,
    ]
}

#[test]
fn a_joint_that_was_never_moved_is_no_joint_that_is_known() {
    let held = |random: &mut Random| {
        let [slide, column, tilt, _] = anywhere(random);
        [slide, column, tilt, 0.3]
    };
    let [fitted, unseen, expected] = errors(&identified(held, &stands_anywhere()));
    assert!(fitted < 0.05, "{fitted}");
    assert!(
        unseen > 10.0 * fitted,
        "where the elbow is was not seen: {unseen}"
    );
    assert!(expected > unseen / 3.0, "{expected} of {unseen}");
    let all = identified(anywhere, &stands_anywhere());
    let [fitted, unseen, expected] = errors(&all);
    assert!(
        unseen < 0.1 && expected < 0.1,
        "{fitted} {unseen} {expected}"
    );
    assert!(!all.identification.expected.unwrap().extrapolates());
}

#[test]
fn along_a_line_an_instrument_stays_where_the_line_is_seen_from() {
    let along = |random: &mut Random| [random.between(0.0, 1000.0), 0.2, -0.3, 0.4];
    let answer = identified(along, &stands_anywhere());
    let [fitted, unseen, expected] = errors(&answer);
    assert!(fitted < 0.05, "{fitted}");
    assert!(expected > unseen / 3.0, "{expected} of {unseen}");
    assert!(answer.identification.expected.unwrap().extrapolates());
}

/// An elbow that was held at one angle while the model was fitted, and that turns the other way round.
#[test]
fn what_the_samples_held_out_alone_show_is_no_noise() {
    let held = |random: &mut Random| {
        let [slide, column, tilt, _] = anywhere(random);
        [slide, column, tilt, 0.3]
    };
    let verdict = |elbow| {
        let rig = Rig {
            elbow,
            stated: false,
            ..USUAL
        };
        let session = session(held, &stands_anywhere(), rig);
        let answer = diagnose(&session, &Options::default(), &|_| true).unwrap();
        (answer.verdict, answer.unexplained.description.to_string())
    };
    let (right, says) = verdict(|sent| sent);
    assert_eq!(right, Verdict::Noise, "{says}");
    let (wrong, says) = verdict(|sent| 0.6 - sent);
    assert_eq!(wrong, Verdict::Unexplained, "{says}");
    assert!(says.contains("half of the held-out samples"), "{says}");
}

/// A model that moves the elbow twice as far as it is sent, about the one angle at which it was held while the model was
/// fitted: on the fitted samples nothing of it is seen.
#[test]
fn a_model_that_leads_off_where_nothing_was_fitted_is_not_written() {
    let held = |random: &mut Random| {
        let [slide, column, tilt, _] = anywhere(random);
        [slide, column, tilt, 0.3]
    };
    let session = session(held, &stands_anywhere(), USUAL);
    let answer = identify_checked(&session, &Method::default(), JointValues::Commanded).unwrap();
    let good = answer.calibration;
    hand_out(&good, &session).unwrap();
    let with = |id: &str, value: f64| {
        let mut term = Term::absent(find(id).unwrap(), 3, 0.0);
        term.coefficients[0] = value;
        term
    };
    let mut terms = good.model.terms().to_vec();
    let zero = |term: &&mut Term| term.effect.about().id == "joint-zero-offset" && term.joint == 3;
    match terms.iter_mut().find(zero) {
        Some(own) => own.coefficients[0] -= 0.3,
        None => terms.push(with("joint-zero-offset", -0.3)),
    }
    terms.push(with("joint-scale", 1.0));
    let bent = Calibration {
        model: Model::new(good.model.robot.clone(), terms),
        covariance: None,
        ..good
    };
    let refused = hand_out(&bent, &session).unwrap_err();
    assert!(
        matches!(refused, NotHandedOut::MissesHeldOut { .. }),
        "{refused}"
    );
}

/// Poses within a degree of each other show next to nothing of zeros and links: what any robot may be off by, 50 mrad and
/// 1 mm, lets the noise turn the joints of a good one.
#[test]
fn poses_close_to_each_other_leave_a_good_robot_as_it_is() {
    let close = |random: &mut Random| {
        let turn = |random: &mut Random, at: f64| at + random.between(-0.02, 0.02);
        [
            random.between(490.0, 510.0),
            turn(random, 0.2),
            turn(random, -0.3),
            turn(random, 0.4),
        ]
    };
    let rig = Rig { worn: 0.0, ..USUAL };
    let session = session(close, &stands_anywhere(), rig);
    let answer = identify_checked(&session, &Method::default(), JointValues::Commanded).unwrap();
    let [fitted, unseen, _] = errors(&answer);
    let nominal = answer.identification.held_out.unwrap().before.rms_mm;
    assert!(fitted < 0.05, "{fitted}");
    assert!(unseen < 0.5, "{unseen}, and the nominal robot {nominal}");
}
