//! What repeats and no name explains, in the model without a name. The independent rig (`support/rig.rs`) hides a
//! bump, a sawtooth or a plateau, which no catalogue has; what the correction is worth is measured
//! against the rig's own geometry, without noise, at poses that were not in the session.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::process::Output;

use crate::rig::{Design, Hidden, Kind, Random, Rig, Shot};
use truepose::compensation::{Conditions, JointTable, Side, verify};
use truepose::diagnosis::{Allowed, Correction, Diagnosis, Options};
use truepose::effects::Knots;
use truepose::effects::{Curve, Inputs, JointValues, Term};
use truepose::fit::identify_exact;
use truepose::inside::Problem;
use truepose::inside::solve;
use truepose::model::Model;
use truepose::model::read_model;
use truepose::pipeline::diagnose;
use truepose::pipeline::hand_out;
use truepose::sessions::{Session, parse};

fn session(rig: &Rig) -> Session {
    parse(rig.json("hidden").as_bytes()).unwrap().session
}

fn corrected(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

/// Names and base alone.
fn plain(session: &Session) -> Diagnosis {
    let options = Options {
        without_unnamed: true,
        ..Options::default()
    };
    diagnose(session, &options, &|_| true).unwrap()
}

fn correction(d: &Diagnosis) -> &Correction {
    d.correction().expect("something repeats")
}

fn measured(design: &Design, hidden: &[(&str, f64)], seed: u64) -> Rig {
    let mut random = Random(seed);
    let mut rig = Rig::new(design, &mut random);
    for (id, lambda) in hidden {
        let hidden = Hidden::random(id, &mut random, design);
        let hidden = rig.sized(&hidden, *lambda);
        rig.hidden.push(hidden);
    }
    rig.measure(&mut random);
    rig
}

fn design() -> Design {
    Design {
        samples: 240,
        ..Design::default()
    }
}

/// The floor: 0.03 mm on three axes.
const FLOOR_MM: f64 = 0.052;

/// Poses between those of the session, at rest, from one side, with nothing in the hand.
fn elsewhere() -> Vec<Shot> {
    let shot = |deg: i32| Shot {
        q: (f64::from(deg) + 0.37).to_radians(),
        dir: 1.0,
        speed: 0.0,
        load: 0.0,
        warmth: 0.0,
        time: 0.0,
        travel: f64::INFINITY,
        target: 0,
    };
    (-165..165).map(shot).collect()
}

/// Root mean square distance of a model from the rig's own geometry, mm.
fn off_the_truth(rig: &Rig, model: &Model) -> f64 {
    let shots = elsewhere();
    let q = shots.iter().map(|s| s.q).collect();
    let mut inputs = Inputs::at_poses(vec![q], vec![[250.0, 0.0, 300.0]]);
    inputs.dir[0] = Some(vec![1.0; shots.len()].into());
    let predicted = model.predict(&inputs);
    let square = |(i, shot): (usize, &Shot)| -> f64 {
        let (is, says) = (rig.point(shot, &rig.hidden), predicted.get(i));
        (0..3).map(|k| (is[k] - says[k]).powi(2)).sum()
    };
    let sum: f64 = shots.iter().enumerate().map(square).sum();
    (sum / shots.len() as f64).sqrt()
}

/// λ is (rms / σ)² of all samples: 400 of 240 samples and σ = 0.03 mm.
const BUMP_MM: f64 = 0.0387;

#[test]
fn the_size_of_what_is_left_is_in_mm_whatever_the_noise() {
    for (kind, seed) in [
        (Kind::Gauss, 11),
        (Kind::Sluggish, 12),
        (Kind::Sluggish, 13),
    ] {
        let design = Design { kind, ..design() };
        let d = corrected(&session(&measured(&design, &[("bump", 400.0)], seed)));
        assert!(d.unexplained.present, "{kind:?} {seed}");
        let share = d.unexplained.rms_mm / BUMP_MM;
        assert!((0.7..1.4).contains(&share), "{kind:?} {seed}: {share}");
    }
}

#[test]
fn unseen_samples_come_near_the_floor_and_the_model_near_the_truth() {
    for id in ["bump", "plateau", "sawtooth"] {
        for (lambda, near) in [(400.0, 1.06), (4000.0, 1.30)] {
            let rig = measured(&design(), &[(id, lambda)], 13);
            let d = corrected(&session(&rig));
            let found = correction(&d);
            let [before, after] = found.held_out_mm;
            assert!(before > 1.15 * FLOOR_MM, "{id} {lambda}: {before}");
            assert!(after < near * FLOOR_MM, "{id} {lambda}: {after}");
            let with = d.model.with_term(found.term.clone());
            let [rough, smooth] = [&d.model, &with].map(|m| off_the_truth(&rig, m));
            assert!(smooth < 0.5 * rough, "{id} {lambda}: {rough} → {smooth}");
            // It is no name: the answer says the same as without it.
            let plain = plain(&session(&rig));
            assert_eq!(plain.unnamed, None);
            assert_eq!((plain.verdict, &plain.found), (d.verdict, &d.found));
            assert_eq!(plain.model, d.model);
            assert!(d.gap.end_mm <= plain.gap.end_mm);
        }
    }
}

#[test]
fn a_name_keeps_its_value_when_everything_is_fitted_again_beside_it() {
    let rig = measured(&design(), &[("bump", 1500.0), ("backlash", 300.0)], 21);
    let session = session(&rig);
    let d = corrected(&session);
    assert!(
        d.found.iter().any(|f| f.effect == "backlash"),
        "{:?}",
        d.found
    );
    let with = d.model.with_term(correction(&d).term.clone());
    let problem = Problem::new(&session, JointValues::Commanded);
    let [before, after] = [&d.model, &with].map(|m| solve(&problem, m).model.coefficients());
    assert_eq!(before.len(), after.len(), "nothing of it is solved for");
    let covariance = d.identification.covariance.as_ref().unwrap();
    let own = d.model.columns();
    let own = own
        .enumerate()
        .find(|(_, (term, _))| term.effect.about().id == "backlash");
    let (k, _) = own.unwrap();
    let sigma = covariance[(k, k)].sqrt();
    let (a, b) = (d.model.coefficients()[k], after[k]);
    assert!((a - b).abs() < 0.5 * sigma, "{a} {b} ± {sigma}");
}

#[test]
fn noise_of_every_kind_gets_no_correction() {
    for (kind, shuffled) in [
        (Kind::Gauss, false),
        (Kind::Tails, true),
        (Kind::Correlated, false),
        (Kind::Quantised, true),
    ] {
        let design = Design {
            kind,
            shuffled,
            samples: 120,
            ..Design::default()
        };
        let session = session(&measured(&design, &[], 5));
        let d = corrected(&session);
        assert_eq!(d.unnamed, None, "{kind:?}");
        assert_eq!(d.calibration(&session).model, d.model);
    }
}

#[test]
fn what_follows_time_is_no_part_of_it() {
    // Not a drift of the frame: without its names that is a frame that wanders.
    let rig = measured(&design(), &[("thermal-zero-drift", 1500.0)], 3);
    let without = [
        "frame-drift",
        "frame-shift",
        "thermal-growth",
        "thermal-zero-drift",
    ];
    let options = Options {
        allowed: Allowed {
            without: without.map(str::to_owned).to_vec(),
            only: None,
        },
        ..Options::default()
    };
    let d = diagnose(&session(&rig), &options, &|_| true).unwrap();
    assert!(d.unexplained.present);
    assert_eq!(d.unnamed, None);
}

#[test]
fn too_few_values_of_the_joint_are_no_curve() {
    // Four places, sixty times each, and a step between them.
    let mut rig = measured(&design(), &[], 9);
    rig.hidden = vec![Hidden::Plateau(1e-3, 0.1, 1.3)];
    for (k, shot) in rig.shots.iter_mut().enumerate() {
        shot.q = -2.4 + 1.4 * (k % 4) as f64;
    }
    rig.measure(&mut Random(4));
    let d = corrected(&session(&rig));
    assert_eq!(d.unnamed, None);
}

#[test]
fn a_table_with_it_brings_the_real_robot_closer() {
    let one_way = Design {
        one_way: true,
        ..design()
    };
    let rig = measured(&one_way, &[("bump", 2000.0)], 11);
    let session = session(&rig);
    let d = corrected(&session);
    let plain = plain(&session);
    // Root mean square of how far the real robot, told the corrected commands, is off around its
    // axis, mm.
    let off = |d: &Diagnosis| -> f64 {
        let calibration = d.calibration(&session);
        let table = JointTable::new(
            &hand_out(&calibration, &session).unwrap(),
            0,
            1.0,
            Conditions::default(),
        )
        .unwrap();
        let table = table.lookup(Side::Forward);
        let shots = elsewhere();
        let square = |shot: &Shot| -> f64 {
            let mut told = *shot;
            told.q += table.at(shot.q);
            let p = rig.point(&told, &rig.hidden);
            (p[1] * shot.q.cos() - p[0] * shot.q.sin()).powi(2)
        };
        (shots.iter().map(square).sum::<f64>() / shots.len() as f64).sqrt()
    };
    let (without, with) = (off(&plain), off(&d));
    assert!(with < 0.3 * without, "{without} → {with}");
    let verified = verify(&d.calibration(&session), &session).unwrap();
    assert!(verified.model.rms_mm < 1.02 * FLOOR_MM, "{verified:?}");
    // The end of the measured range is held over the rest of the limits.
    let calibration = d.calibration(&session);
    let table = JointTable::new(
        &hand_out(&calibration, &session).unwrap(),
        0,
        1.0,
        Conditions::default(),
    )
    .unwrap();
    assert_eq!(table.forward[0], table.forward[5]);
    let part = |note: &&truepose::text::Text| note.contains("unexplained smooth correction");
    assert_eq!(
        table.notes.iter().filter(part).count(),
        1,
        "{:?}",
        table.notes
    );
}

#[test]
fn the_table_of_an_arms_joint_takes_the_part_along_its_motion() {
    let text = r#"{"format":"truepose-session/1","name":"arm","robot":{"name":"arm","joints":[
        {"name":"a","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-90,90]},
        {"name":"b","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,400],"limits":[-90,90]},
        {"name":"c","kind":"revolute","axis":[0,1,0],"point_mm":[300,0,400],"limits":[-90,90]}],
        "tool":{"position_mm":[550,0,400],"quaternion_wxyz":[1,0,0,0]}},
        "samples":{"columns":{"q1_deg":[-60,0,60,20],"q2_deg":[-60,60,0,10],"q3_deg":[30,60,-60,5],
        "x_mm":[0,0,0,0],"y_mm":[0,0,0,0],"z_mm":[0,0,0,0]}}}"#;
    let mut session = parse(text.as_bytes()).unwrap().session;
    let knots = Knots {
        from: -1.0,
        to: 1.0,
        period: None,
        count: 11,
    };
    let wave: Vec<f64> = knots
        .places()
        .iter()
        .map(|q| 2e-3 * (3.0 * q).sin())
        .collect();
    let none = Vec::new;
    let values = [
        wave.clone(),
        vec![0.3; 11],
        vec![-0.2; 11],
        none(),
        none(),
        none(),
    ];
    let sigma = values.clone().map(|v| vec![0.0; v.len()]);
    let curve = Curve::new(knots, values, sigma).unwrap();
    // A robot that has the wave and nothing else.
    let commands = Inputs::new(&session, JointValues::Commanded);
    let wave = Term::unexplained(1, curve.clone());
    let points = Model::new(session.robot.clone(), vec![wave]).predict(&commands);
    drop(commands);
    let samples = &mut session.samples;
    (samples.x_mm, samples.y_mm) = (points.x_mm, points.y_mm);
    samples.z_mm = Some(points.z_mm);
    let inputs = Inputs::new(&session, JointValues::Commanded);
    let nothing: [String; 0] = [];
    let identified = identify_exact(&session, &nothing, JointValues::Commanded).unwrap();
    let mut calibration = identified.calibration(&session, &inputs);
    calibration.model = calibration
        .model
        .with_term(Term::unexplained(1, curve.clone()));
    let verified = hand_out(&calibration, &session);
    let table = |joint| {
        JointTable::new(
            verified.as_ref().unwrap(),
            joint,
            5.0,
            Conditions::default(),
        )
        .unwrap()
    };
    let own = table(1);
    for (q, by) in own.commanded_outer.iter().zip(&own.forward) {
        // Outside the samples the end of their range is held.
        let q = q.clamp(-60.0, 60.0).to_radians();
        assert!((by + curve.at(q + by, 1.0)[0]).abs() < 1e-9, "{q}: {by}");
    }
    assert!(own.forward.iter().any(|v| v.abs() > 1e-3));
    for other in [0, 2] {
        assert!(table(other).forward.iter().all(|v| *v == 0.0));
    }
}

#[test]
fn outside_the_measured_range_the_end_is_held_and_nothing_is_known() {
    let d = corrected(&session(&measured(&design(), &[("bump", 2000.0)], 11)));
    let curve = correction(&d).curve().unwrap();
    let (from, to) = (curve.knots().from, curve.knots().to);
    assert_eq!(curve.at(to + 1.0, 1.0), curve.at(to, 1.0));
    assert_eq!(curve.at(from - 1.0, -1.0), curve.at(from, -1.0));
    assert_eq!(curve.sigma_at(to + 1e-6, 0.0), None);
    let [sigma, _, _] = curve.sigma_at(0.5 * (from + to), 0.0).unwrap();
    // 240 samples of 0.03 mm at 250 mm: some 1e-4 rad each, some eight of them for each wave.
    assert!((1e-6..1e-4).contains(&sigma), "{sigma}");
}

#[test]
fn the_standard_deviation_is_that_of_the_truth() {
    let (mut inside, mut all) = (0_u32, 0_u32);
    for seed in 30..34 {
        let rig = measured(&design(), &[("bump", 2000.0)], seed);
        let d = corrected(&session(&rig));
        let Some(found) = d.correction() else {
            continue;
        };
        let with = d.model.with_term(found.term.clone());
        for shot in elsewhere().iter().step_by(10) {
            let mut inputs = Inputs::at_poses(vec![vec![shot.q]], vec![[250.0, 0.0, 300.0]]);
            inputs.dir[0] = Some(vec![1.0].into());
            let says = with.predict(&inputs).get(0);
            let is = rig.point(shot, &rig.hidden);
            let off = (is[1] - says[1]) * shot.q.cos() - (is[0] - says[0]) * shot.q.sin();
            let [sigma, _, _] = found.curve().unwrap().sigma_at(shot.q, 1.0).unwrap();
            inside += u32::from(off.abs() < 2.0 * sigma * 250.0);
            all += 1;
        }
    }
    let share = f64::from(inside) / f64::from(all);
    assert!((0.85..=1.0).contains(&share), "{inside} of {all}");
}

#[test]
fn a_model_with_it_is_read_back_to_the_last_bit() {
    for id in ["bump", "sawtooth"] {
        let rig = measured(&design(), &[(id, 2000.0), ("backlash", 400.0)], 13);
        let session = session(&rig);
        let calibration = corrected(&session).calibration(&session);
        let text = hand_out(&calibration, &session).unwrap().document();
        let read = read_model(&text).unwrap();
        assert_eq!(read, calibration);
        assert_eq!(hand_out(&read, &session).unwrap().document(), text);
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let bits = |model: &Model| -> Vec<u64> {
            let all = model.predict(&inputs);
            let all = [all.x_mm, all.y_mm, all.z_mm].concat();
            all.into_iter().map(f64::to_bits).collect()
        };
        assert_eq!(bits(&read.model), bits(&calibration.model));
        assert!(calibration.model.terms().iter().any(|t| t.curve.is_some()));
    }
}

#[test]
fn bad_knots_are_refused_with_their_place() {
    let rig = measured(&design(), &[("sawtooth", 2000.0)], 13);
    let session = session(&rig);
    let calibration = corrected(&session).calibration(&session);
    let good = hand_out(&calibration, &session).unwrap().document();
    let mut terms = calibration.model.terms().iter();
    let own = terms.position(|t| t.curve.is_some()).unwrap();
    let key = |key: &str| {
        let start = good.find(&format!("\"{key}\":")).unwrap();
        let end = start + good[start..].find(['\n', '}']).unwrap();
        good[start..end].trim_end_matches(',').to_owned()
    };
    let motion = key("motion_inner");
    let first = motion.split(['[', ',']).nth(1).unwrap().to_owned();
    let shorter = motion.replacen(&format!("{first},"), "", 1);
    let cases = [
        (key("knots"), "\"knots\": 1".to_owned(), "curve.knots"),
        (key("knots"), "\"knots\": 2.5".to_owned(), "curve.knots"),
        (key("knots"), "\"knots\": 1e14".to_owned(), "curve.knots"),
        (
            key("to_inner"),
            "\"to_inner\": -9".to_owned(),
            "curve.to_inner",
        ),
        (
            key("from_inner"),
            "\"from_inner\": \"x\"".to_owned(),
            "curve.from_inner",
        ),
        (
            key("period_inner"),
            "\"period_inner\": 0".to_owned(),
            "curve.period_inner",
        ),
        (motion.clone(), shorter, "curve.motion_inner"),
        (
            motion.clone(),
            "\"motion_inner\": [[]]".to_owned(),
            "curve.motion_inner",
        ),
        (
            key("from_deg"),
            "\"from_deg\": 3".to_owned(),
            "parameters.from_deg",
        ),
    ];
    for (from, to, place) in cases {
        let bad = good.replacen(&from, &to, 1);
        assert_ne!(bad, good, "{from}");
        let error = read_model(&bad).unwrap_err().to_string();
        let place = format!("effects[{own}].{place}");
        assert!(error.contains(&place), "{to}: {error}");
    }
    // Without its curve it is nothing.
    let bare = r#"{ "effect": "unexplained", "joint": 1 }"#;
    let start = good.find("\"effect\": \"unexplained\"").unwrap();
    let start = good[..start].rfind('{').unwrap();
    let mut depth = 0;
    let end = good[start..].find(|c| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        depth == 0
    });
    let after = start + end.unwrap() + 1;
    let bad = format!("{}{bare}{}", &good[..start], &good[after..]);
    let error = read_model(&bad).unwrap_err().to_string();
    assert!(error.contains("no key 'curve'"), "{error}");
}

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn json(arguments: &[&str]) -> serde_json::Value {
    let output = truepose(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_terminal_adds_it_and_every_command_takes_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (session, model, plain) = (at("s.json"), at("m.json"), at("plain.json"));
    let rig = measured(&design(), &[("bump", 2000.0)], 11);
    std::fs::write(&session, rig.json("hidden")).unwrap();
    let said = json(&[
        "diagnose",
        &session,
        "--json",
        "--correct-unexplained",
        "--out",
        &model,
    ]);
    let unnamed = &said["unnamed"];
    let number = |key: &str| unnamed[key].as_f64().unwrap();
    assert!(number("held_out_after_mm") < 0.6 * number("held_out_before_mm"));
    assert_eq!(unnamed["over"], serde_json::json!(["q1_deg"]));
    assert!(unnamed["curve"]["knots"].as_f64() >= Some(4.0));
    let range = unnamed["curve"]["range_deg"].as_array().unwrap();
    assert!(range[0].as_f64() < range[1].as_f64());
    assert!(unnamed["says"].as_str().unwrap().contains("no name"));
    assert_eq!(said["held_out"]["end_mm"], unnamed["held_out_after_mm"]);
    // The option that once asked for it changes nothing.
    assert_eq!(said, json(&["diagnose", &session, "--json"]));
    let bare = json(&[
        "diagnose",
        &session,
        "--json",
        "--no-unnamed",
        "--out",
        &plain,
    ]);
    assert!(bare["unnamed"].is_null());
    let effects = |d: &serde_json::Value| -> Vec<serde_json::Value> {
        let all = d["identified"].as_array().unwrap().iter();
        all.map(|one| one["effect"].clone()).collect()
    };
    assert_eq!(effects(&bare), effects(&said));

    let gap = |model: &str| json(&["verify", model, &session, "--json"])["gap"]["model_mm"].clone();
    assert!(gap(&model).as_f64() < Some(0.6 * gap(&plain).as_f64().unwrap()));
    let table = at("t.csv");
    let output = truepose(&["export", &model, "--to", "csv", "--out", &table]);
    let says = String::from_utf8_lossy(&output.stdout);
    assert!(says.contains("unexplained smooth correction"), "{says}");
    let sidecar = std::fs::read_to_string(format!("{table}.meta.json")).unwrap();
    assert!(sidecar.contains("unexplained smooth correction"));

    // On noise it is null.
    let quiet = at("quiet.json");
    std::fs::write(&quiet, measured(&design(), &[], 2).json("quiet")).unwrap();
    assert!(json(&["diagnose", &quiet, "--json"])["unnamed"].is_null());

    // No search and no fit can have it by its name.
    let output = truepose(&["identify", &session, "--effects", "unexplained", "--json"]);
    assert!(String::from_utf8_lossy(&output.stdout).contains("finds what repeats"));
    let output = truepose(&["effects"]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("unexplained"));
}
