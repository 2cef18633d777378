//! What is said with confidence stands against its rivals: other orders behind equal steps, orders beside
//! each other, a name that a run leaves out. Sessions are made from exact geometry here, by nothing of the program.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::TAU;

use truepose::diagnosis::{Allowed, Diagnosis, Options, Verdict};
use truepose::pipeline;
use truepose::report::{Extras, html};
use truepose::sessions::{Session, parse};

const RADIUS: f64 = 320.0;
const HEIGHT: f64 = 210.0;
const SIGMA: f64 = 0.02;

/// One sample: the command in degrees, when and in what it was measured.
#[derive(Clone, Copy)]
struct At {
    q_deg: f64,
    time_s: f64,
    warm_c: f64,
}

/// Normal deviates of a fixed sequence (Box & Muller on a linear congruence).
struct Normal(u64);

impl Normal {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        (-2.0 * self.unit().ln()).sqrt() * (TAU * self.unit()).cos()
    }
}

fn equal_steps() -> Vec<At> {
    let up = (0..69).map(|k| 5.0 * f64::from(k) - 170.0);
    let all: Vec<f64> = up.clone().chain(up.rev()).collect();
    timed(&all)
}

fn uneven(count: i32) -> Vec<At> {
    let one = |k: i32| 340.0 * (f64::from(k) * 0.754_877_666).fract() - 170.0;
    timed(&(0..count).map(one).collect::<Vec<_>>())
}

fn timed(angles: &[f64]) -> Vec<At> {
    let one = |(k, q_deg): (usize, &f64)| {
        let time_s = 8.0 * k as f64;
        At {
            q_deg: *q_deg,
            time_s,
            warm_c: 20.0 + 4.0 * (1.0 - (-time_s / 900.0).exp()),
        }
    };
    angles.iter().enumerate().map(one).collect()
}

/// A session of one axis: `turn` is what the axis does beside the command, rad, `shift` what the frame does, mm.
fn session(
    samples: &[At],
    seed: u64,
    turn: impl Fn(&At) -> f64,
    shift: impl Fn(&At) -> [f64; 3],
) -> Session {
    let mut normal = Normal(seed);
    let mut columns: [Vec<String>; 6] = Default::default();
    for at in samples {
        let angle = at.q_deg.to_radians() + turn(at);
        let moved = shift(at);
        let point = [
            (RADIUS + 0.1) * angle.cos() + moved[0],
            (RADIUS + 0.1) * angle.sin() + moved[1],
            HEIGHT + moved[2],
        ];
        columns[0].push(at.q_deg.to_string());
        for (axis, value) in point.iter().enumerate() {
            columns[axis + 1].push(format!("{:.6}", value + SIGMA * normal.next()));
        }
        columns[4].push(at.time_s.to_string());
        columns[5].push(format!("{:.3}", at.warm_c));
    }
    let [q, x, y, z, t, w] = columns.map(|c| c.join(","));
    let text = format!(
        r#"{{"format":"truepose-session/1","name":"rivals","robot":{{"name":"axis","joints":[
        {{"name":"a","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180]}}],
        "tool":{{"position_mm":[{RADIUS},0,{HEIGHT}],"quaternion_wxyz":[1,0,0,0]}}}},
        "instrument":{{"name":"tracker","sigma_mm":{SIGMA}}},"samples":{{"columns":{{"q1_deg":[{q}],
        "x_mm":[{x}],"y_mm":[{y}],"z_mm":[{z}],"time_s":[{t}],"temperature_c":[{w}]}}}}}}"#
    );
    parse(text.as_bytes()).unwrap().session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnosed_without(session, &[])
}

fn diagnosed_without(session: &Session, without: &[&str]) -> Diagnosis {
    let options = Options {
        allowed: Allowed {
            without: without.iter().map(|id| (*id).to_owned()).collect(),
            only: None,
        },
        ..Options::default()
    };
    truepose::pipeline::diagnose(session, &options, &|_| true).unwrap()
}

fn wave(order: f64, amplitude_deg: f64) -> impl Fn(&At) -> f64 {
    move |at| amplitude_deg.to_radians() * (order * at.q_deg.to_radians() + 1.1).sin()
}

fn still(_: &At) -> [f64; 3] {
    [0.0; 3]
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    answer.found.iter().map(|f| f.effect).collect()
}

/// The order that is said, and those that it may be as well.
fn orders(answer: &Diagnosis) -> Vec<f64> {
    let own = answer.found.iter().flat_map(|f| &f.parameters);
    let own = own.filter(|p| p.name == "order").map(|p| p.value);
    let others = answer.equivalent.iter().flat_map(|e| e.orders.clone());
    let mut all: Vec<f64> = own.chain(others).collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn behind_equal_steps_every_order_is_said_and_uneven_poses_part_them() {
    let samples = equal_steps();
    let answer = diagnosed(&session(&samples, 5, wave(88.0, 0.02), still));
    assert_eq!(names(&answer), ["gear-transmission-error"]);
    let wanted = [
        16.0, 56.0, 88.0, 128.0, 160.0, 200.0, 232.0, 272.0, 304.0, 344.0,
    ];
    assert_eq!(orders(&answer), wanted);
    let alias = &answer.equivalent[0];
    assert_eq!(alias.explanation, alias.instead);
    assert!(alias.separate_by.contains("88") || alias.separate_by.contains("16"));
    let said = answer
        .data_problems
        .iter()
        .any(|p| p.what.to_string() == "equal steps");
    assert!(said, "{:?}", answer.data_problems);

    // Measured as proposed, the order is right and alone.
    assert!(!answer.next_poses.is_empty());
    let last = samples.last().unwrap().time_s;
    let angles = answer.next_poses.iter().map(|p| p.q[0].to_degrees());
    let more = angles.enumerate().map(|(k, q_deg)| At {
        q_deg: (q_deg * 10.0).round() / 10.0,
        time_s: last + 8.0 * (k as f64 + 1.0),
        warm_c: 24.0,
    });
    let all: Vec<At> = samples.iter().copied().chain(more).collect();
    let again = diagnosed(&session(&all, 6, wave(88.0, 0.02), still));
    assert_eq!(orders(&again), [88.0]);
    assert_eq!(again.verdict, Verdict::Explained);
}

#[test]
fn behind_equal_steps_a_wave_once_a_turn_says_which_gears_look_the_same() {
    let said = |answer: &Diagnosis| answer.found[0].explanation.to_string();
    for order in [1.0, 73.0] {
        let measured = session(&equal_steps(), 5, wave(order, 0.02), still);
        let answer = diagnosed(&measured);
        assert_eq!(names(&answer), ["encoder-eccentricity"]);
        let note = "equal steps of 5.00° a gear error of 71, 73, 143, 145 …";
        assert!(said(&answer).contains(note));
        // Not in the JSON alone: every answer has the same sections.
        let (options, extras) = (Options::default(), Extras::default());
        let report = pipeline::report_of_diagnosis(&measured, &answer, None, &options, &extras);
        assert!(html(&report.unwrap()).contains(note));
    }
    let answer = diagnosed(&session(&uneven(140), 5, wave(1.0, 0.02), still));
    assert_eq!(names(&answer), ["encoder-eccentricity"]);
    assert!(!said(&answer).contains("steps"), "{}", said(&answer));
}

#[test]
fn at_uneven_poses_an_order_has_no_other() {
    let answer = diagnosed(&session(&uneven(140), 5, wave(88.0, 0.02), still));
    assert_eq!(orders(&answer), [88.0]);
    assert!(answer.equivalent.is_empty());
}

#[test]
fn a_name_does_not_stand_in_for_one_that_is_left_out() {
    // Without the eccentricity the drawn circle may still be somewhere else: whatever is said, it is not all.
    let turn = wave(1.0, 0.03);
    let session = session(&uneven(140), 5, turn, still);
    let answer = diagnosed_without(&session, &["encoder-eccentricity"]);
    assert!(answer.unexplained.present || !answer.equivalent.is_empty());
    let answer = diagnosed_without(&session, &["frame-drift"]);
    assert_eq!(names(&answer), ["encoder-eccentricity"]);
    assert!(
        !answer.unexplained.present,
        "{}",
        answer.unexplained.description
    );
}
