//! One hidden effect in each session that `tests/reference/effects_as_data.py` simulated with numpy,
//! which shares no code with the program: it has to be named, with its joint and its values.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::PathBuf;

use truepose::diagnosis::{Diagnosis, FoundEffect, Options};
use truepose::effects::{Inputs, JointValues};
use truepose::fit::{DEFAULT_EFFECTS, Estimate, identify_exact};
use truepose::model::Model;
use truepose::pipeline::{self, diagnose};
use truepose::present::diagnosis_v1;
use truepose::sessions::{Session, load};
use truepose::simulation::{parse_scenario, simulate, unwatched};

fn session(name: &str) -> Session {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/effects");
    load(folder.join(format!("{name}.json"))).unwrap().session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

/// The only name that was found.
fn only(answer: &Diagnosis) -> &FoundEffect {
    let names: Vec<_> = answer.found.iter().map(|f| (f.effect, f.joint)).collect();
    assert_eq!(names.len(), 1, "{names:?}");
    assert!(!answer.unexplained.present, "{:?}", answer.unexplained);
    &answer.found[0]
}

/// A parameter with its interval; the truth lies within one and a half times of it.
fn agrees(found: &FoundEffect, name: &str, truth: f64) {
    let own = found.parameters.iter().find(|p| p.name == name).unwrap();
    let half = own.ci95.map_or(0.0, |[low, high]| 0.5 * (high - low));
    let off = (own.value - truth).abs();
    assert!(
        off <= 1.5 * half,
        "{name}: {} ± {half}, not {truth}",
        own.value
    );
    assert!(half < 0.25 * truth.abs(), "{name} ± {half}");
}

#[test]
fn the_pitch_error_of_a_screw_is_named_with_its_lead() {
    let session = session("screw-pitch");
    let answer = diagnosed(&session);
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("screw-pitch", Some(1)));
    agrees(found, "lead_mm", 16.0);
    agrees(found, "amplitude_mm", 0.035);
    agrees(found, "phase_deg", 70.0);
}

#[test]
fn a_foundation_that_gives_way_is_named_with_both_its_springs() {
    let answer = diagnosed(&session("foundation-compliance"));
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("foundation-compliance", None));
    agrees(found, "about_x_urad_per_nm", 4.0);
    agrees(found, "about_y_urad_per_nm", 2.0);
}

/// The same deviations the other way round: a base that leans against its load is none.
#[test]
fn a_foundation_has_no_negative_springs() {
    let mut session = session("foundation-compliance");
    let effects = DEFAULT_EFFECTS.map(str::to_owned);
    let identified = identify_exact(&session, &effects, JointValues::Commanded).unwrap();
    let predicted = identified
        .model
        .predict(&Inputs::new(&session, JointValues::Commanded));
    let samples = &mut session.samples;
    let z = samples.z_mm.as_mut().unwrap();
    for (i, z) in z.iter_mut().enumerate() {
        let [x_mm, y_mm, z_mm] = predicted.get(i);
        samples.x_mm[i] = 2.0 * x_mm - samples.x_mm[i];
        samples.y_mm[i] = 2.0 * y_mm - samples.y_mm[i];
        *z = 2.0 * z_mm - *z;
    }
    let answer = diagnosed(&session);
    let mut names = answer.found.iter().map(|found| found.effect);
    assert!(
        names.all(|name| name != "foundation-compliance"),
        "{:?}",
        answer.found
    );
}

#[test]
fn a_coupling_is_named_with_the_joint_that_it_comes_from() {
    let answer = diagnosed(&session("wrist-coupling"));
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("wrist-coupling", Some(3)));
    agrees(found, "from_joint", 1.0);
    agrees(found, "ratio", 0.0006);
}

#[test]
fn a_measured_torque_shows_wind_up_without_any_mass() {
    let mut session = session("measured-torque");
    let answer = diagnosed(&session);
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("joint-compliance", Some(2)));
    agrees(found, "compliance_urad_per_nm", 1.5);

    // Without the sensor the load tells how much the joint gives, and what the links make of it is
    // fitted as their moments: nothing else is named for it.
    session.samples.torque_nm.clear();
    let answer = diagnosed(&session);
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("joint-compliance", Some(2)));
    agrees(found, "compliance_urad_per_nm", 1.5);
    // An identification of what was found has the same form of it.
    let mut effects: Vec<String> = DEFAULT_EFFECTS.iter().map(|id| (*id).to_owned()).collect();
    effects.push(found.effect.to_owned());
    let fitted = identify_exact(&session, &effects, JointValues::Commanded).expect("identified");
    let of_joint_2 = |p: &&Estimate| p.effect == found.effect && p.joint == Some(2);
    let names: Vec<&str> = fitted
        .parameters
        .iter()
        .filter(of_joint_2)
        .map(|p| p.name)
        .collect();
    assert!(names.contains(&"moment_1_u_mrad"), "{names:?}");
    assert!(!answer.unexplained.present, "{:?}", answer.unexplained);

    // Without a load either it is still what the links make of it that is named; how much the joint
    // gives for a torque is not known then, and what the loads did is left.
    session.samples.load_kg = None;
    let answer = diagnosed(&session);
    let [found] = &answer.found[..] else {
        panic!("{:?}", answer.found);
    };
    assert_eq!((found.effect, found.joint), ("joint-compliance", Some(2)));
    assert!(answer.unexplained.present);
    let mut names = found.parameters.iter().map(|p| p.name);
    assert!(names.all(|name| name.starts_with("moment")));
    let document =
        serde_json::to_value(diagnosis_v1::document(&answer, &session, None)).expect("JSON");
    let parameters = document["found"][0]["parameters"]
        .as_array()
        .expect("a list");
    let value = |name: &str| {
        let own = parameters.iter().find(|p| p["name"] == name);
        own.expect("a parameter")["value"].clone()
    };
    assert!(value("compliance_urad_per_nm").is_null());
    assert!(value("sag_rms_mrad").as_f64().is_some_and(|sag| sag > 0.05));
}

/// One load and no masses: links that weigh could bend joint 2 as an eccentric ring of it turns it, so
/// that both stand in the answer. The sag of an arm depends on joint 3 as well, which no ring does.
#[test]
fn an_eccentric_ring_and_a_sag_that_would_look_alike_stand_in_one_set() {
    let answer = diagnosed(&session("eccentric"));
    let found = only(&answer);
    assert_eq!(found.joint, Some(2));
    let rivals = answer.equivalent.iter().flat_map(|e| &e.instead);
    let set: Vec<&str> = [found.effect]
        .into_iter()
        .chain(rivals.filter_map(|rival| rival.strip_suffix(" 2")))
        .collect();
    for alike in ["joint-compliance", "encoder-eccentricity"] {
        assert!(set.contains(&alike), "{set:?}");
    }
    let answer = diagnosed(&session("sag"));
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("joint-compliance", Some(2)));
}

/// A sag without masses has moments alone: its model is read back as what it was, to the last bit.
#[test]
fn the_model_of_a_sag_is_read_back_as_it_was_written() {
    let session = session("sag");
    let answer = diagnosed(&session);
    let term = |model: &Model| {
        let mut terms = model.terms().iter();
        let own = terms.find(|t| t.effect.about().id == "joint-compliance");
        own.expect("the sag").clone()
    };
    let before = term(&answer.model);
    assert_eq!(before.coefficients.len(), 6, "moments alone");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("sag.model.json");
    let verified = pipeline::hand_out(&answer.calibration(&session), &session).expect("verified");
    let text = pipeline::write_model(&verified);
    std::fs::write(&path, text).expect("written");
    let read = pipeline::load_model(&path).expect("read");
    assert_eq!(term(&read.model).coefficients, before.coefficients);
    pipeline::verify(&read, &session).expect("compared");
}

#[test]
fn a_joints_own_temperature_counts_before_that_of_the_room() {
    let mut session = session("warm-joint");
    let answer = diagnosed(&session);
    let found = only(&answer);
    assert_eq!((found.effect, found.joint), ("thermal-zero-drift", Some(2)));
    agrees(found, "deg_per_degc", 0.0015);

    let [_, left] = found.gap_mm;
    // The room's temperature, which goes along with it a little, does not explain it.
    session.samples.joint_temperature_c.clear();
    let answer = diagnosed(&session);
    let best = answer.found.iter().map(|f| f.gap_mm[1]);
    let best = best.fold(f64::INFINITY, f64::min);
    assert!(best > 1.8 * left, "{best} {left}");
}

/// An upright arm of two joints that carries 5 kg, with conditions.
fn scenario(conditions: &str) -> String {
    format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"r","joints":[
        {{"name":"a","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}},
        {{"name":"b","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,300]}}],
        "tool":{{"position_mm":[500,0,300],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[0,0,-9.81]}},
        "poses":{{"list":[{{"q_deg":[10,0]}},{{"q_deg":[20,60]}}]}},"conditions":{conditions}}}"#
    )
}

#[test]
fn a_simulated_session_has_the_torques_and_temperatures_of_its_joints() {
    let text = scenario(
        r#"{"load_kg":5,"seconds_per_pose":10,"torques":true,
            "joint_temperatures_c":[null,{"from":20,"to":40,"time_constant_s":10}]}"#,
    );
    let scenario = parse_scenario(text.as_bytes()).unwrap().scenario;
    let (session, _) = simulate(&scenario, 1, unwatched).unwrap();
    let torque = session.samples.torque_nm[1].as_ref().unwrap();
    // Stretched out the load turns the joint down, about +y; at 60° half as much.
    let most = 5.0 * 9.81 * 0.5;
    for (torque, expected) in torque.iter().zip([most, 0.5 * most]) {
        assert!((torque - expected).abs() < 1e-9, "{torque} {expected}");
    }
    let about_gravity = session.samples.torque_nm[0].as_ref().unwrap();
    assert!(about_gravity.iter().all(|t| t.abs() < 1e-9));
    assert_eq!(session.samples.joint_temperature_c[0], None);
    let warm = session.samples.joint_temperature_c[1].as_ref().unwrap();
    assert_eq!(warm[..], [20.0, 32.64]);
}

#[test]
fn conditions_of_joints_that_make_no_sense_are_refused_with_their_place() {
    for (conditions, says) in [
        (r#"{"torques":1}"#, "torques"),
        (r#"{"joint_temperatures_c":[1,2]}"#, "joint_temperatures_c"),
        (r#"{"joint_temperatures_c":[null,{"from":20}]}"#, "to"),
        (
            r#"{"joint_temperatures_c":[null,{"from":20,"to":30,"time_constant_s":5}]}"#,
            "seconds_per_pose",
        ),
        (
            r#"{"seconds_per_pose":1,"joint_temperatures_c":[{"from":20,"to":30,"time_constant_s":0}]}"#,
            "time constant above 0 s",
        ),
    ] {
        let refused = parse_scenario(scenario(conditions).as_bytes()).unwrap_err();
        let refused = refused.to_string();
        assert!(refused.contains(says), "{conditions}: {refused}");
        assert!(refused.contains("line"), "{conditions}: {refused}");
    }
}
