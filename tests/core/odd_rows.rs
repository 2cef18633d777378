//! Rows that are not what they say: a pose that was missed, joints that are counted together, a robot that stands at its
//! limit, a servo of another scale. Each is said, or left out, and no cause is named for it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::Vector3;
use truepose::diagnosis::{Diagnosis, FoundEffect, Options, Verdict};
use truepose::effects::{Term, find};
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, Setups, parse};
use truepose::simulation::{simulate, unwatched};

use crate::few_poses::{anywhere, measured};
use crate::rig::Random;

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

/// Poses all over, and in eight rows that follow one another the same one.
fn with_eight_shots(random: &mut Random, of: [f64; 6]) -> Vec<[f64; 6]> {
    let mut rows: Vec<_> = (0..90).map(|_| anywhere(random, 1.0)).collect();
    rows[40..48].fill(of);
    rows
}

/// A column of waves, steps or curves follows the only pose that lies where it does something.
#[test]
fn eight_shots_at_a_pose_that_was_missed_are_no_curve() {
    for seed in 1..=3 {
        let mut random = Random(seed);
        let mut at = anywhere(&mut random, 0.8);
        at[1] = 72.0;
        let rows = with_eight_shots(&mut random, at);
        let (_, mut session) = measured(&rows, &mut random, seed);
        for q in &mut session.samples.q[1][40..48] {
            *q += 0.6_f64.to_radians();
        }
        let answer = diagnosed(&session);
        assert_eq!(answer.verdict, Verdict::Noise, "{seed}");
        assert!(answer.found.is_empty() && answer.unnamed.is_none());
        let apart: Vec<usize> = answer.outliers.iter().map(|o| o.sample).collect();
        assert!((40..48).all(|row| apart.contains(&row)), "{apart:?}");
        assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
    }
}

#[test]
fn joints_that_are_counted_together_are_seen_where_one_moves_at_a_time() {
    let mut random = Random(5);
    let still = anywhere(&mut random, 0.2);
    let mut rows = Vec::new();
    for joint in 0..6 {
        for k in 0..13 {
            let mut q = still;
            q[joint] = f64::from(10 * k - 60);
            rows.push(q);
        }
    }
    let (_, mut session) = measured(&rows, &mut random, 5);
    let [_, second, third, ..] = session.samples.q.as_mut_slice() else {
        panic!("six joints");
    };
    for (third, second) in third.iter_mut().zip(second) {
        *third += *second;
    }
    let answer = diagnosed(&session);
    let said: Vec<String> = answer
        .data_problems
        .iter()
        .map(|problem| problem.what.to_string())
        .collect();
    let coupled = "joints 2 and 3 are coupled (parallelogram) but were taken for uncoupled";
    assert_eq!(said, [coupled]);
    assert!(
        answer.data_problems[0]
            .evidence
            .contains("a tenth of the samples")
    );
    assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
}

/// The commands go on beyond the limit: the instrument was not locked, and no row had been there before.
#[test]
fn a_robot_at_the_limit_of_a_joint_stood_still() {
    let mut random = Random(7);
    let mut at = anywhere(&mut random, 0.8);
    at[1] = 110.0;
    let rows = with_eight_shots(&mut random, at);
    let (_, mut session) = measured(&rows, &mut random, 7);
    for (k, q) in session.samples.q[1][40..48].iter_mut().enumerate() {
        *q += (2.0 * (k + 1) as f64).to_radians();
    }
    let answer = diagnosed(&session);
    let said = answer.data_problems[0].what.to_string();
    assert_eq!(
        said,
        "the robot stood still in 8 samples: 41, 42, 43, 44, 45, 46, 47, 48"
    );
    assert_eq!(answer.data_problems.len(), 1);
}

/// A hobby servo whose pulses were taken for degrees.
#[test]
fn the_only_joint_may_have_another_scale() {
    for scale in [0.465, 1.6] {
        let (mut x, mut y, mut q) = (Vec::new(), Vec::new(), Vec::new());
        let mut random = Random(3);
        for k in 0..60 {
            let told = f64::from(3 * (k % 20));
            let turned = (scale * told + 1.5_f64).to_radians();
            q.push(told);
            x.push(200.0 * turned.cos() + 0.02 * random.normal());
            y.push(200.0 * turned.sin() + 0.02 * random.normal());
        }
        let text = format!(
            r#"{{"format":"truepose-session/1","name":"servo","robot":{{"name":"servo","joints":[{{"name":"j","kind":
            "revolute","axis":[0,0,1],"point_mm":[0,0,0]}}],"tool":{{"position_mm":[200,0,0],"quaternion_wxyz":[1,0,0,0]}}}},
            "instrument":{{"name":"camera","sigma_mm":0.02}},
            "samples":{{"columns":{{"q1_deg":{q:?},"x_mm":{x:?},"y_mm":{y:?}}}}}}}"#
        );
        let answer = diagnosed(&parse(text.as_bytes()).unwrap().session);
        let said = answer.data_problems[0].what.to_string();
        let start = format!("joint 1 moves {scale:.3}");
        assert!(said.starts_with(&start), "{said}");
        assert!(answer.gap.end_mm < 0.05 && answer.found.is_empty());
    }
}

/// An axis that was swept forth and back at uneven steps, with three errors that are smooth over a turn and another home
/// from sample 70 on.
fn swept(seed: u64, home_deg: f64) -> Session {
    let mut random = Random(seed);
    let mut there: Vec<f64> = (0..160).map(|_| random.between(-170.0, 170.0)).collect();
    there[..80].sort_by(f64::total_cmp);
    there[80..].sort_by(|a, b| b.total_cmp(a));
    let size = |random: &mut Random| random.between(0.01, 0.05);
    let (once, twice) = (size(&mut random), size(&mut random));
    let phases = [0, 1].map(|_| random.between(0.0, std::f64::consts::TAU));
    let scale = random.between(1e-4, 5e-4);
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for (k, q) in there.iter().enumerate() {
        let wave = |order: f64, phase: f64| (order * q.to_radians() + phase).sin();
        let home = if k < 70 { 0.0 } else { home_deg };
        let off = once * wave(1.0, phases[0]) + twice * wave(2.0, phases[1]) + scale * q + home;
        let turned = (q + off).to_radians();
        x.push(320.0 * turned.cos() + 0.02 * random.normal());
        y.push(320.0 * turned.sin() + 0.02 * random.normal());
    }
    let time: Vec<f64> = (0..160).map(|k| 8.0 * f64::from(k)).collect();
    let text = format!(
        r#"{{"format":"truepose-session/1","name":"swept","robot":{{"name":"axis","joints":[{{"name":"j","kind":
        "revolute","axis":[0,0,1],"point_mm":[0,0,0]}}],"tool":{{"position_mm":[320,0,0],"quaternion_wxyz":[1,0,0,0]}}}},
        "instrument":{{"name":"tracker","sigma_mm":0.02}},
        "samples":{{"columns":{{"q1_deg":{there:?},"x_mm":{x:?},"y_mm":{y:?},"time_s":{time:?}}}}}}}"#
    );
    parse(text.as_bytes()).unwrap().session
}

/// Along a sweep a step in time is one over the value: what is smooth over the joint is no home that moved, and a home
/// that moved is found at its sample beside it. (Of forty seeds these four had a home that moved while what repeats over
/// the joint was no rival of a step.)
#[test]
fn a_smooth_error_of_a_sweep_is_no_home_that_moved() {
    for seed in [5, 14, 34, 39] {
        let said = |home_deg: f64| -> Vec<String> {
            let answer = diagnosed(&swept(seed, home_deg));
            let all = answer.data_problems.iter();
            all.map(|problem| problem.what.to_string()).collect()
        };
        assert_eq!(said(0.0), [""; 0], "{seed}");
        let moved = said(0.1);
        assert_eq!(moved.len(), 1, "{seed}: {moved:?}");
        assert!(moved[0].ends_with("at sample 71"), "{seed}: {moved:?}");
    }
}

/// On a wall the load turns the first joint, and no other joint as on the floor.
#[test]
fn a_robot_on_a_wall_is_not_one_on_the_floor() {
    for (across, said) in [(true, 1), (false, 0)] {
        let mut random = Random(11);
        let rows: Vec<_> = (0..90).map(|_| anywhere(&mut random, 1.0)).collect();
        let (mut scenario, _) = measured(&rows, &mut random, 11);
        let g = if across { Vector3::x() } else { -Vector3::z() };
        scenario.robot.gravity_m_s2 = Some(9.81 * g);
        scenario.circumstances.loads_kg = vec![0.0, 15.0, 30.0];
        let gives = find("joint-compliance").unwrap();
        for (joint, rad_per_nm) in [1.5e-6, 2e-6, 2.5e-6].into_iter().enumerate() {
            let mut term = Term::absent(gives, joint, 0.0);
            term.coefficients[0] = rad_per_nm;
            scenario.effects.push(term);
        }
        let (mut session, ..) = simulate(&scenario, 11, unwatched).unwrap();
        session.robot.gravity_m_s2 = Some(-9.81 * Vector3::z());
        let answer = diagnosed(&session);
        let problems: Vec<String> = answer
            .data_problems
            .iter()
            .map(|problem| problem.what.to_string())
            .collect();
        assert_eq!(problems.len(), said, "{problems:?}");
        for what in &problems {
            assert!(what.starts_with("gravity runs along (1.00, "), "{what}");
        }
        let other = |effect: &&FoundEffect| effect.effect != "joint-compliance";
        assert!(
            !answer.found.iter().any(|e| other(&e)),
            "{:?}",
            answer.found
        );
        assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
    }
}

/// The instrument stood in other air at its second station.
#[test]
fn stations_of_different_scale_are_told_apart() {
    for (ppm, said) in [(180.0, 1), (0.0, 0)] {
        let mut random = Random(13);
        let rows: Vec<_> = (0..90).map(|_| anywhere(&mut random, 1.0)).collect();
        let (_, mut session) = measured(&rows, &mut random, 13);
        let samples = &mut session.samples;
        let late = |row: usize| row >= 50;
        // Seen from three metres and a half away.
        for row in 0..90 {
            let scale = if late(row) { 1.0 + 1e-6 * ppm } else { 1.0 };
            samples.x_mm[row] = (samples.x_mm[row] + 3500.0) * scale;
            samples.y_mm[row] *= scale;
            samples.z_mm.as_mut().unwrap()[row] *= scale;
        }
        samples.setups = Some(Setups {
            names: vec!["S1".to_owned(), "S2".to_owned()],
            index: (0..90).map(|row| u32::from(late(row))).collect(),
        });
        let answer = diagnosed(&session);
        assert_eq!(
            answer.data_problems.len(),
            said,
            "{:?}",
            answer.data_problems
        );
        for problem in &answer.data_problems {
            let what = problem.what.to_string();
            assert!(what.starts_with("the scale of setup S2 is 1"), "{what}");
        }
        assert!(answer.found.is_empty(), "{:?}", answer.found);
        assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
    }
}

/// Measurements one after another, a quarter of a minute each, of a robot that is seen from three metres and a half away.
pub(crate) fn from_afar(session: &mut Session) {
    let n = session.samples.len();
    let samples = &mut session.samples;
    samples.x_mm.iter_mut().for_each(|x| *x += 3500.0);
    samples.time_s = Some((0..n).map(|i| 15.0 * i as f64).collect());
    samples.setups = Some(Setups {
        names: vec!["S1".to_owned()],
        index: vec![0; n],
    });
}

#[test]
fn distances_that_settle_are_no_frame_that_drifts() {
    let mut random = Random(17);
    let rows: Vec<_> = (0..120).map(|_| anywhere(&mut random, 1.0)).collect();
    let (_, mut session) = measured(&rows, &mut random, 17);
    from_afar(&mut session);
    let samples = &mut session.samples;
    for row in 0..120 {
        let z = &mut samples.z_mm.as_mut().unwrap()[row];
        let [x, y] = [&mut samples.x_mm[row], &mut samples.y_mm[row]];
        let distance = (*x * *x + *y * *y + *z * *z).sqrt();
        let factor = 1.0 + 0.4 * (-(row as f64) / 40.0).exp() / distance;
        for v in [x, y, z] {
            *v *= factor;
        }
    }
    let answer = diagnosed(&session);
    let what = answer.data_problems[0].what.to_string();
    let size = what.trim_start_matches("the instrument's distances settle: 0.");
    assert!(
        size.starts_with("38") || size.starts_with("39") || size.starts_with("40"),
        "{what}"
    );
    assert!(answer.found.is_empty(), "{:?}", answer.found);
    assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
}

#[test]
fn lines_of_sight_that_bend_are_no_joint_that_turns_unevenly() {
    let mut random = Random(23);
    let rows: Vec<_> = (0..120).map(|_| anywhere(&mut random, 1.0)).collect();
    let (_, mut session) = measured(&rows, &mut random, 23);
    from_afar(&mut session);
    assert!(diagnosed(&session).data_problems.is_empty());
    let samples = &mut session.samples;
    for row in 0..120 {
        let z = &mut samples.z_mm.as_mut().unwrap()[row];
        let square = samples.x_mm[row].powi(2) + samples.y_mm[row].powi(2) + *z * *z;
        *z += 0.4 * square / (3500.0 * 3500.0);
    }
    let answer = diagnosed(&session);
    let what = answer.data_problems[0].what.to_string();
    assert!(what.starts_with("the lines of sight are bent"), "{what}");
    assert!(answer.found.is_empty(), "{:?}", answer.found);
    assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
}

#[test]
fn a_base_that_moved_and_turned_is_said_and_so_is_every_homing() {
    let mut random = Random(19);
    let rows: Vec<_> = (0..120).map(|_| anywhere(&mut random, 1.0)).collect();
    let (_, mut session) = measured(&rows, &mut random, 19);
    from_afar(&mut session);
    let mut homed = session.clone();
    for (row, q) in homed.samples.q[0].iter_mut().enumerate() {
        *q += [0.0, 0.08, -0.1, 0.06_f64][row / 30].to_radians();
    }
    let said = |session: &Session| -> Vec<String> {
        let answer = diagnosed(session);
        assert!(answer.found.is_empty(), "{:?}", answer.found);
        assert!(answer.gap.end_mm < 0.05, "{}", answer.gap.end_mm);
        let problems = answer.data_problems.iter();
        problems.map(|problem| problem.what.to_string()).collect()
    };
    let each = said(&homed);
    let at = |sample: u32| format!("at sample {sample}");
    assert!(
        each.iter()
            .zip([31, 61, 91])
            .all(|(said, from)| said.ends_with(&at(from))),
        "{each:?}"
    );
    assert!(said(&session).is_empty());
    let samples = &mut session.samples;
    for row in 70..120 {
        // 0.3 mrad about z and half a millimetre.
        samples.x_mm[row] -= 3e-4 * samples.y_mm[row];
        samples.y_mm[row] += 3e-4 * samples.x_mm[row] - 0.5;
    }
    let moved = "the robot's base or the instrument moved and turned at sample 71";
    assert_eq!(said(&session), [moved]);
}
