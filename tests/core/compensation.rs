//! Compensation closes the loop: a robot that is told the corrected commands goes where the nominal
//! one would, but for what no joint can remove.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::exporting::admitted;
use proptest::prelude::*;
use truepose::compensation::{
    Compensation, Conditions, JointTable, Remainder, Side, Verification, VerifiedCalibration,
    verify,
};
use truepose::effects::{Inputs, JointValues};
use truepose::fit::{identify_exact, identify_regional};
use truepose::model::model_hash;
use truepose::model::{Calibration, Model};
use truepose::pipeline;
use truepose::sessions::RegionChoice;
use truepose::sessions::Session;
use truepose::simulation::{
    Poses, Scenario, Stop, load_scenario, parse_scenario, simulate, unwatched,
};
use truepose::units::{deg_from_rad, rad_from_deg};

fn column(effects: &str, rest: &str) -> Scenario {
    let text = format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"r","joints":[{{"name":"pan","kind":"revolute",
        "axis":[0,0,1],"point_mm":[0,0,0],"limits":[-90,90]}}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[0,0,-9.81]}},
        "poses":{{"sweep":{{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":6,"both_ways":true}}}},
        "effects":[{effects}]{rest}}}"#
    );
    parse_scenario(text.as_bytes()).unwrap().scenario
}

fn play(scenario: &Scenario) -> Session {
    simulate(scenario, scenario.seed, unwatched).unwrap().0
}

fn exact(session: &Session, effects: &[&str]) -> Calibration {
    let effects: Vec<String> = effects.iter().map(|e| (*e).to_owned()).collect();
    let found = identify_exact(session, &effects, JointValues::default()).unwrap();
    found.calibration(session, &Inputs::new(session, JointValues::default()))
}

fn regional(session: &Session) -> (Calibration, truepose::fit::Identification) {
    let found =
        identify_regional(session, &RegionChoice::FromSession, JointValues::default()).unwrap();
    let inputs = Inputs::new(session, JointValues::default());
    (found.calibration(session, &inputs), found)
}

fn bundled(name: &str) -> Scenario {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/");
    load_scenario(format!("{folder}{name}.scenario.json"))
        .unwrap()
        .scenario
}

const SEVERAL: &str = r#"
    {"effect":"joint-zero-offset","joint":1,"parameters":{"offset_deg":-3}},
    {"effect":"joint-scale","joint":1,"parameters":{"scale_ppm":400}},
    {"effect":"encoder-eccentricity","joint":1,"parameters":{"amplitude_deg":0.1,"phase_deg":40}},
    {"effect":"backlash","joint":1,"parameters":{"width_deg":0.05}},
    {"effect":"link-length","joint":1,"parameters":{"delta_mm":-5}}"#;
const THEIR_NAMES: [&str; 5] = [
    "joint-zero-offset",
    "joint-scale",
    "encoder-eccentricity",
    "backlash",
    "link-length",
];

/// The scenario with its commands corrected, as a controller with the table would do it.
fn corrected(scenario: &Scenario, table: &JointTable) -> Scenario {
    let session = play(scenario);
    let (forward, reverse) = (table.lookup(Side::Forward), table.lookup(Side::Reverse));
    let q = &session.samples.q[0];
    let dir = session.samples.dir[0].as_ref().unwrap();
    let stops = q.iter().zip(dir).map(|(q, side)| Stop {
        q: vec![
            q + if *side > 0.0 {
                forward.at(*q)
            } else {
                reverse.at(*q)
            },
        ],
        dir: Some(vec![*side]),
    });
    let mut corrected = scenario.clone();
    corrected.poses = Poses::List(stops.collect());
    corrected.robot.joints[0].limits = None;
    corrected
}

#[test]
fn the_corrected_robot_is_off_along_the_radius_and_nowhere_else() {
    let scenario = column(SEVERAL, "");
    let calibration = exact(&play(&scenario), &THEIR_NAMES);
    let table = JointTable::new(&admitted(&calibration), 0, 6.0, Conditions::default()).unwrap();
    let commanded = play(&scenario).samples;
    let reached = play(&corrected(&scenario, &table)).samples;
    for i in 0..reached.len() {
        let q = commanded.q[0][i];
        let e = [
            reached.x_mm[i] - 250.0 * q.cos(),
            reached.y_mm[i] - 250.0 * q.sin(),
        ];
        let along = e[0] * q.cos() + e[1] * q.sin();
        let around = e[1] * q.cos() - e[0] * q.sin();
        assert!((along + 5.0).abs() < 1e-9, "{along}");
        assert!(around.abs() < 1e-9, "{around}");
    }
}

#[test]
fn the_papers_numbers_of_a_verification() {
    let session = play(&bundled("paper-30"));
    let calibration = exact(&session, &["joint-zero-offset", "link-length"]);
    let found = verify(&calibration, &session).unwrap();
    // |250 − 245 e^(−3°i)| by the law of cosines.
    let nominal = (250.0_f64.powi(2) + 245.0_f64.powi(2)
        - 2.0 * 250.0 * 245.0 * 3.0_f64.to_radians().cos())
    .sqrt();
    assert!((found.nominal.rms_mm - nominal).abs() < 1e-9);
    assert!(found.model.max_mm < 1e-9);
    let compensated = found.compensated.unwrap();
    assert!((compensated.gap.rms_mm - 5.0).abs() < 1e-9);
    assert!((compensated.cannot_be_removed_by_joints_mm - 5.0).abs() < 1e-9);
    assert_eq!(found.within_tolerance, None);
}

#[test]
fn what_stays_is_said_in_the_words_of_the_controllers_data() {
    let calibration = exact(&play(&column(SEVERAL, "")), &THEIR_NAMES);
    let q: Vec<f64> = (-90..=90).map(|d| rad_from_deg(f64::from(d))).collect();
    let home = vec![[250.0, 0.0, 300.0]];
    let inputs = Conditions::default().inputs(vec![q], Side::Forward, home);
    let remainder = Remainder::new(&calibration, &inputs);
    assert!((remainder.rms_mm - 5.0).abs() < 1e-9);
    let [radial, axial] = remainder.radial_axial_mm.unwrap();
    assert!((radial - 5.0).abs() < 1e-9 && axial < 1e-12);
    let [share] = &remainder.shares[..] else {
        panic!("{:?}", remainder.shares);
    };
    assert_eq!(share.effect, "link-length");
    assert!(
        share.remedy.contains("from 250.0000 mm to 245.0000 mm"),
        "{}",
        share.remedy
    );
}

#[test]
fn a_session_under_this_models_table_is_not_compensated_again() {
    let scenario = column(SEVERAL, "");
    let calibration = exact(&play(&scenario), &THEIR_NAMES);
    let table = JointTable::new(&admitted(&calibration), 0, 1.0, Conditions::default()).unwrap();
    // The robot was told q + c by the controller; the session holds q.
    let mut session = play(&corrected(&scenario, &table));
    session.samples.q = play(&scenario).samples.q;
    session.compensated_by = Some(model_hash(&calibration));
    let found = verify(&calibration, &session).unwrap();
    assert_eq!(found.compensated, None);
    assert!(
        (found.nominal.rms_mm - 5.0).abs() < 1e-5,
        "{:?}",
        found.nominal
    );
    assert!(found.model.max_mm < 1e-5, "{:?}", found.model);
    assert!(
        found.notes[0].contains("not compensated a second time"),
        "{:?}",
        found.notes
    );

    session.compensated_by = Some("another".to_owned());
    let found = verify(&calibration, &session).unwrap();
    assert_eq!(found.compensated, None);
    assert!(
        found.notes[0].contains("another model's table"),
        "{:?}",
        found.notes
    );
}

#[test]
fn a_regional_model_verifies_as_it_was_identified() {
    let session = play(&bundled("paper-30"));
    let (calibration, identified) = regional(&session);
    let found = verify(&calibration, &session).unwrap();
    assert!((found.nominal.rms_mm - identified.gap.before.rms_mm).abs() < 1e-9);
    assert!((found.model.rms_mm - identified.gap.after.rms_mm).abs() < 1e-9);
    // The joint turns towards q_c; what is off the circle stays.
    let compensated = found.compensated.unwrap();
    assert!(compensated.cannot_be_removed_by_joints_mm > 4.0);
    assert!(compensated.gap.rms_mm > found.model.rms_mm);
    assert!(compensated.gap.rms_mm < 0.5 * found.nominal.rms_mm);
}

#[test]
fn equation_8_moves_the_position_by_the_regions_correction() {
    let session = play(&bundled("paper-30"));
    let (calibration, _) = regional(&session);
    let compensation = Compensation::new(&calibration);
    let regional = compensation.regional.as_ref().unwrap();
    let at = regional.corrections_at(&[rad_from_deg(42.0)])[0].unwrap();
    let home = [250.0, 0.0, 300.0];
    let [x, y, z] = regional.position_correction(at, home);
    assert_eq!((x, z), (at.l1_mm, 0.0));
    assert!((y - 250.0 * at.theta_rad).abs() < 1e-12);
    // The paper's row of 42°: actual 190.401, 154.184, compensated 184.507, 166.591. What is added
    // to y there differs from 250 Δθ by the printed digits only.
    assert!((190.401 + x - 184.507).abs() < 2e-3 && (154.184 + y - 166.591).abs() < 2e-3);
    // Outside all regions nothing is known and nothing is done.
    assert_eq!(regional.corrections_at(&[rad_from_deg(91.0)]), vec![None]);
}

#[test]
fn a_verification_holds_for_another_session_of_the_same_robot() {
    let noise =
        r#","noise":{"sigma_mm":0.01},"tolerance_mm":0.1,"conditions":{"seconds_per_pose":6}"#;
    let drift = r#",{"effect":"frame-drift","parameters":{"x_mm_per_h":9}}"#;
    let first = column(&format!("{SEVERAL}{drift}"), noise);
    let names = [&THEIR_NAMES[..], &["frame-drift"]].concat();
    let calibration = exact(&play(&first), &names);
    let own = verify(&calibration, &play(&first)).unwrap();
    assert!(own.model.rms_mm < 0.02, "{:?}", own.model);

    // Another day: no drift, another order.
    let mut second = column(SEVERAL, noise);
    second.seed = 9;
    let found = verify(&calibration, &play(&second)).unwrap();
    assert!(found.model.rms_mm < 0.025, "{:?}", found.model);
    assert!(
        found.notes.iter().any(|n| n.contains("frame-drift")),
        "{:?}",
        found.notes
    );
    let within = found.within_tolerance.unwrap();
    assert_eq!((within.before, within.after, within.of), (0, 62, 62));
}

#[test]
fn another_robot_is_refused() {
    let calibration = exact(&play(&column(SEVERAL, "")), &["joint-zero-offset"]);
    let mut session = play(&column("", ""));
    session.robot.joints[0].kind = truepose::kinematics::JointKind::Prismatic;
    let refused = verify(&calibration, &session).unwrap_err().to_string();
    assert!(refused.contains("different robots"), "{refused}");
}

fn arm(effects: &str) -> Scenario {
    let joint = |name: &str, axis: &str, point: &str| {
        format!(
            r#"{{"name":"{name}","kind":"revolute","axis":{axis},"point_mm":{point},"limits":[-120,120]}}"#
        )
    };
    let text = format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"arm","joints":[{},{},{}],
        "tool":{{"position_mm":[650,0,400],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[0,0,-9.81]}},
        "poses":{{"random":{{"count":150}}}},"effects":[{effects}]}}"#,
        joint("a", "[0,0,1]", "[0,0,0]"),
        joint("b", "[0,1,0]", "[0,0,400]"),
        joint("c", "[0,1,0]", "[350,0,400]"),
    );
    parse_scenario(text.as_bytes()).unwrap().scenario
}

#[test]
fn an_arm_reaches_its_points_and_its_tables_hold_each_joints_own_part() {
    let effects = r#"{"effect":"joint-zero-offset","joint":1,"parameters":{"offset_deg":0.5}},
        {"effect":"joint-zero-offset","joint":3,"parameters":{"offset_deg":-0.3}},
        {"effect":"backlash","joint":3,"parameters":{"width_deg":0.06}},
        {"effect":"base-offset","parameters":{"x_mm":1,"y_mm":-0.5,"z_mm":0.3}}"#;
    let scenario = arm(effects);
    let session = play(&scenario);
    let calibration = Calibration {
        model: Model::new(scenario.robot.clone(), scenario.effects.clone()),
        // That of the fit is of other coefficients.
        covariance: None,
        ..exact(&session, &["joint-zero-offset"])
    };
    let found: Verification = verify(&calibration, &session).unwrap();
    let compensated = found.compensated.unwrap();
    assert!(found.nominal.rms_mm > 3.0, "{found:?}");
    // All but the poses near full stretch are reached exactly.
    assert!(compensated.gap.rms_mm < 0.3, "{compensated:?}");

    let table = JointTable::new(&admitted(&calibration), 2, 10.0, Conditions::default()).unwrap();
    for (forward, reverse) in table.forward.iter().zip(&table.reverse) {
        assert!((deg_from_rad(*forward) - 0.33).abs() < 1e-9, "{forward}");
        assert!((deg_from_rad(*reverse) - 0.27).abs() < 1e-9, "{reverse}");
    }
    assert!(
        table.notes.iter().any(|n| n.contains("kinematic data")),
        "{:?}",
        table.notes
    );
    let silent = JointTable::new(&admitted(&calibration), 1, 10.0, Conditions::default()).unwrap();
    assert!(silent.forward.iter().all(|c| c.abs() < 1e-12));
}

#[test]
fn a_model_from_a_file_compensates_the_same() {
    let calibration = exact(&play(&bundled("lamp-commissioning")), &THEIR_NAMES);
    let verified = admitted(&calibration);
    let read = VerifiedCalibration::read(&verified.document()).unwrap();
    let table =
        |c: &VerifiedCalibration| JointTable::new(c, 0, 5.0, Conditions::default()).unwrap();
    assert_eq!(table(&read), table(&verified));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_other_command_comes_closer(
        values in prop::array::uniform6(-1.0..1.0f64),
        q_deg in -80.0..80.0f64,
        by_deg in -0.01..0.01f64,
    ) {
        let [offset, delta, x, y, runout, scale] = values;
        let effects = format!(
            r#"{{"effect":"joint-zero-offset","joint":1,"parameters":{{"offset_deg":{}}}}},
               {{"effect":"joint-scale","joint":1,"parameters":{{"scale_ppm":{}}}}},
               {{"effect":"link-length","joint":1,"parameters":{{"delta_mm":{}}}}},
               {{"effect":"bearing-runout","joint":1,"parameters":{{"order":3,"amplitude_mm":{}}}}},
               {{"effect":"base-offset","parameters":{{"x_mm":{x},"y_mm":{y}}}}}"#,
            30.0 * offset, 500.0 * scale, 40.0 * delta, 0.1 * runout.abs(),
        );
        let scenario = column(&effects, r#","targets":{"A":[0,0,0],"B":[60,20,0]}"#);
        let calibration = Calibration {
            model: Model::new(scenario.robot.clone(), scenario.effects.clone()),
            ..exact(&play(&scenario), &["joint-zero-offset"])
        };
        let compensation = Compensation::new(&calibration);
        let homes = compensation.reflectors_at_home.clone();
        let q = rad_from_deg(q_deg);
        let off = |correction: f64| {
            let mut sum = 0.0;
            for (k, _) in homes.iter().enumerate() {
                let mut inputs = Conditions::default().inputs(vec![vec![q]], Side::Forward, homes.clone());
                inputs.target = Some(vec![u32::try_from(k).unwrap()].into());
                let reached = compensation.reached(&inputs, &[vec![correction]]).get(0);
                let nominal = compensation.nominal.predict(&inputs).get(0);
                sum += (0..3).map(|a| (reached[a] - nominal[a]).powi(2)).sum::<f64>();
            }
            sum
        };
        let inputs = Conditions::default().inputs(vec![vec![q]], Side::Forward, homes.clone());
        let best = compensation.joint_corrections(&inputs)[0][0];
        prop_assert!(off(best) <= off(best + rad_from_deg(by_deg)) + 1e-9);
    }
}

/// Such a session shows what is left; nothing compensates it a second time.
#[test]
fn no_table_is_made_from_what_another_table_left() {
    let mut session = play(&column("", ""));
    session.compensated_by = Some("0123abcd".to_owned());
    let calibration = exact(&session, &["joint-zero-offset", "link-length"]);
    let refused =
        JointTable::new(&admitted(&calibration), 0, 1.0, Conditions::default()).unwrap_err();
    assert!(refused.to_string().contains("0123abcd"), "{refused}");
    let text = pipeline::hand_out(&calibration, &session)
        .unwrap()
        .document();
    let back = truepose::model::read_model(&text).unwrap();
    assert_eq!(back.compensated_by, calibration.compensated_by);
}
