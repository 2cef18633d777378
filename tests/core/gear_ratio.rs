//! Gears whose ratio the robot states, on a hidden six-joint arm of plain matrices that shares no code with the program.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::unnamed::{diagnosed, session};
use truepose::diagnosis::{Diagnosis, FoundEffect, Options};
use truepose::model::read_model;
use truepose::pipeline;
use truepose::sessions::{parse_robot, robot_document};

/// Turns of the motor for one of joint 2: a table of such numbers has fractions.
const RATIO: f64 = 62.6111;

/// A wave for every turn of the wave generator, and one for each of its lobes, on joint 2.
fn geared(q: &[f64]) -> Vec<f64> {
    let mut q = q.to_vec();
    let turn = RATIO * q[1];
    q[1] += 1.2e-4 * (turn + 0.7).sin() + 1e-4 * (2.0 * turn - 0.4).cos();
    q
}

fn of_joint_2(found: &Diagnosis) -> Vec<&FoundEffect> {
    let own = |f: &&FoundEffect| f.effect == "gear-transmission-error" && f.joint == Some(2);
    found.found.iter().filter(own).collect()
}

fn order(found: &FoundEffect) -> f64 {
    found
        .parameters
        .iter()
        .find(|p| p.name == "order")
        .unwrap()
        .value
}

#[test]
fn the_orders_of_a_stated_ratio_are_named_with_it() {
    let mut measured = session(260, 11, geared);
    measured.robot.joints[1].gear_ratio = Some(RATIO);
    let found = pipeline::diagnose(&measured, &Options::default(), &|_| true).unwrap();
    let own = of_joint_2(&found);
    let mut orders: Vec<f64> = own.iter().map(|f| order(f)).collect();
    orders.sort_by(f64::total_cmp);
    assert_eq!(orders, [RATIO, 2.0 * RATIO], "{:?}", found.found);
    for found in own {
        let per_turn = if order(found) == RATIO { 1 } else { 2 };
        let says =
            format!("{per_turn} for a turn of the motor, by the stated gear ratio of {RATIO}");
        assert!(found.explanation.contains(&says), "{}", found.explanation);
        // What is stated is not fitted.
        let own = found.parameters.iter().find(|p| p.name == "order").unwrap();
        assert_eq!(own.ci95, None);
    }
    // A model keeps the ratios of its robot.
    let handed_out = pipeline::hand_out(&found.calibration(&measured), &measured).unwrap();
    let kept = read_model(&pipeline::write_model(&handed_out)).unwrap();
    assert_eq!(kept.model.robot, measured.robot);
}

#[test]
fn without_a_ratio_an_order_is_what_fits_and_nothing_is_said_of_one() {
    let measured = session(260, 11, geared);
    let found = diagnosed(&measured, true);
    for own in of_joint_2(&found) {
        let nearest = [RATIO, 2.0 * RATIO].map(|order_of| (order(own) - order_of).abs());
        assert!(
            nearest.into_iter().any(|apart| apart < 0.2),
            "{}",
            order(own)
        );
        assert!(
            !own.explanation.contains("gear ratio"),
            "{}",
            own.explanation
        );
    }
}

#[test]
fn a_ratio_that_the_samples_do_not_show_names_nothing() {
    let mut measured = session(260, 12, <[f64]>::to_vec);
    for joint in &mut measured.robot.joints {
        joint.gear_ratio = Some(101.0);
    }
    let found = diagnosed(&measured, true);
    assert!(found.found.is_empty(), "{:?}", found.found);
}

fn robot(joints: &str) -> String {
    format!(
        r#"{{"name":"r",{joints},"tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}}"#
    )
}

fn one_joint(more: &str) -> String {
    robot(&format!(
        r#""joints":[{{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]{more}}}]"#
    ))
}

#[test]
fn a_robot_states_its_ratios() {
    let ratios = |text: &str| -> Vec<Option<f64>> {
        let read = parse_robot(text.as_bytes()).unwrap();
        read.robot
            .joints
            .iter()
            .map(|joint| joint.gear_ratio)
            .collect()
    };
    assert_eq!(ratios(&one_joint("")), [None]);
    let stated = one_joint(r#","gear_ratio":100"#);
    assert_eq!(ratios(&stated), [Some(100.0)]);
    let written = robot_document(&parse_robot(stated.as_bytes()).unwrap().robot);
    assert_eq!(ratios(&written), [Some(100.0)]);
    let row = r#"{"a_mm":0,"alpha_deg":0,"d_mm":100,"theta_deg":0,"convention":"standard"}"#;
    let rows = |ratios: &str| robot(&format!(r#""dh":[{row},{row}],"gear_ratios":{ratios}"#));
    assert_eq!(ratios(&rows("[50.5, null]")), [Some(50.5), None]);
    assert_eq!(ratios(&rows("[null, null]")), [None, None]);
    for wrong in [
        one_joint(r#","gear_ratio":0"#),
        one_joint(r#","gear_ratio":-3"#),
        rows("[1]"),
        rows("[1,0]"),
    ] {
        let error = parse_robot(wrong.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("gear_ratio"), "{error}");
    }
}

#[test]
fn the_ratios_of_the_library_go_with_its_robots() {
    let puma = truepose::robots::named("puma560").unwrap();
    let own: Vec<f64> = puma
        .robot
        .joints
        .iter()
        .filter_map(|joint| joint.gear_ratio)
        .collect();
    assert_eq!(own, puma.gear_ratios);
    assert!(!own.is_empty());
}
