//! Rows that are not what they say: a pose that was missed, joints that are counted together, a robot that stands at its
//! limit, a servo of another scale. Each is said, or left out, and no cause is named for it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, parse};

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
