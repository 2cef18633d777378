//! Set-up errors that hold for a part of the rows: from some row on, for a time, in a setup, with a target.
//!
//! Every mistake of setting up is a change of rows ([`super::changes`]), and each may hold for some of them only: a
//! joint that counts the other way since an update, angles in radians or points in inches in one run, points in
//! another cell's frame, an encoder that slipped. One search finds which change in which rows ([`gross`]); what is too
//! small to be visible with the nominal robot is searched for with the fitted one ([`steps`]).
//!
//! Where a part differs, the session as a whole agrees with the description: only these rows are corrected, and what
//! goes out to the controller is not. Of a home that moved the last rows are valid now: those before are turned.

mod gross;
mod moved;
mod steps;

pub(super) use gross::gross;
pub(super) use steps::steps;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::diagnosis::DataProblem;
    use crate::effects::JointValues;
    use crate::sessions::{Session, SessionCorrection};
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// An arm of four joints at 36 places all over, two targets at each, noise of 0.02 mm; its zero offsets are a little off.
    fn arm() -> Session {
        let at = |k: u32, joint: u32| 120.0 * (f64::from(k + 1) * (1.7 + f64::from(joint))).sin();
        let q: Vec<f64> = (0..4 * 36).map(|i| at(i / 4, i % 4)).collect();
        arm_at(q.chunks(4), r#""A":[0,0,60],"B":[40,50,20]"#)
    }

    fn arm_at<'a>(poses: impl Iterator<Item = &'a [f64]>, targets: &str) -> Session {
        let poses: Vec<String> = poses.map(|q| format!(r#"{{"q_deg":{q:?}}}"#)).collect();
        let joint = |axis: &str, point: &str| {
            format!(r#"{{"name":"j","kind":"revolute","axis":[{axis}],"point_mm":[{point}]}}"#)
        };
        let joints = [
            joint("0,0,1", "0,0,0"),
            joint("0,1,0", "50,0,300"),
            joint("0,1,0", "50,0,700"),
            joint("1,0,0", "300,0,740"),
        ];
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"r","robot":{{"name":"r","joints":[{}],
            "tool":{{"position_mm":[600,0,740],"quaternion_wxyz":[1,0,0,0]}}}},
            "targets":{{{targets}}},"instrument":{{"name":"t","sigma_mm":0.02}},
            "poses":{{"list":[{}]}},"conditions":{{"seconds_per_pose":8}},
            "effects":[{{"effect":"joint-zero-offset","joint":3,"parameters":{{"offset_deg":0.2}}}}],
            "noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":4}}"#,
            joints.join(","),
            poses.join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        simulate(&scenario, 1, unwatched).unwrap().0
    }

    fn in_rows(first: usize, end: usize, by: SessionCorrection) -> SessionCorrection {
        SessionCorrection::InRows {
            rows: vec![(first, end)],
            by: Box::new(by),
        }
    }

    fn corrected(session: &Session, problems: &[DataProblem]) -> Session {
        let mut better = session.clone();
        let corrections = problems.iter().filter_map(|problem| problem.mend.as_ref());
        corrections.for_each(|correction| correction.apply(&mut better));
        better
    }

    fn found(session: &Session) -> (Vec<DataProblem>, Option<Session>) {
        let problems = gross(session, JointValues::Commanded);
        let corrected = corrected(session, &problems);
        (problems, (corrected != *session).then_some(corrected))
    }

    #[test]
    fn whatever_is_wrong_for_a_time_is_found_with_its_rows() {
        let right = arm();
        assert!(found(&right).1.is_none());
        let sign = SessionCorrection::ScaleJoint {
            joint: 1,
            factor: -1.0,
        };
        let unit = SessionCorrection::ScaleJoint {
            joint: 2,
            factor: 1.0_f64.to_radians(),
        };
        let inches = SessionCorrection::ScaleLengths(1.0 / 25.4);
        for (mistake, rows, said) in [
            (
                sign,
                (50, 72),
                "joint 2 counts the other way round, from sample 51 on",
            ),
            (
                unit,
                (0, 25),
                "are in radians but were read as degrees, in samples 1 to 25",
            ),
            (
                inches,
                (20, 41),
                "coordinates are in inches but were read as millimetres, in samples 21 to 41",
            ),
        ] {
            let mut wrong = right.clone();
            in_rows(rows.0, rows.1, mistake).apply(&mut wrong);
            let (problems, corrected) = found(&wrong);
            assert_eq!(problems.len(), 1, "{problems:?}");
            assert!(
                problems[0].what.contains(said),
                "{:?}",
                problems[0].what.to_string()
            );
            let corrected = corrected.expect("it was found").samples;
            for (column, own) in corrected.q.iter().zip(&right.samples.q) {
                assert!(column.iter().zip(own).all(|(a, b)| (a - b).abs() < 1e-9));
            }
            let points = corrected.x_mm.iter().zip(&right.samples.x_mm);
            assert!(points.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
        }
    }

    #[test]
    fn a_home_that_moves_is_turned_back_to_where_it_is_in_the_end() {
        let right = arm();
        assert!(steps(&right, JointValues::Commanded).is_empty());
        let mut wrong = right.clone();
        for (from, by) in [(25, 0.5_f64), (48, -0.3)] {
            let by_rad = -by.to_radians();
            in_rows(from, 72, SessionCorrection::TurnHome { joint: 2, by_rad }).apply(&mut wrong);
        }
        let problems = steps(&wrong, JointValues::Commanded);
        let better = corrected(&wrong, &problems);
        let said: Vec<String> = problems
            .iter()
            .map(|problem| problem.what.to_string())
            .collect();
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(
            said[0].starts_with("the home position of joint 3 moved by 0.")
                && said[0].ends_with("sample 26")
        );
        assert!(said[1].ends_with("sample 49"), "{said:?}");
        // All rows have one home now, that of the last.
        for (k, (q, own)) in better.samples.q[2]
            .iter()
            .zip(&right.samples.q[2])
            .enumerate()
        {
            let off = q - own - (-0.2_f64).to_radians();
            assert!(off.abs() < 2e-4, "{k} {off}");
        }
    }

    /// Eight commands that go on, at which the robot stays where it is.
    #[test]
    fn a_joint_at_its_stop_is_no_home_that_moves() {
        for (joint, first) in [(1, 22), (2, 41), (2, 17)] {
            let at =
                |k: u32, joint: u32| 120.0 * (f64::from(k + 1) * (1.7 + f64::from(joint))).sin();
            let stays = first..first + 8;
            let pose = |k: u32| if stays.contains(&k) { first } else { k };
            let q: Vec<f64> = (0..4 * 70).map(|i| at(pose(i / 4), i % 4)).collect();
            let mut session = arm_at(q.chunks(4), r#""A":[0,0,60]"#);
            for (by, row) in (1..).zip(first as usize..first as usize + 8) {
                session.samples.q[joint][row] += (2.0 * f64::from(by)).to_radians();
            }
            let problems = steps(&session, JointValues::Commanded);
            assert!(problems.is_empty(), "joint {joint}: {}", problems[0].what);
        }
    }

    /// An arm that does not come back to the same place: in each pose every joint is off by 0.02° (σ). Three
    /// reflectors are measured in each.
    fn arm_that_does_not_repeat(seed: u32, poses: u32) -> Session {
        let at = |k: u32, joint: u32| 120.0 * (f64::from(k + 1) * (1.7 + f64::from(joint))).sin();
        let mut chance = seed;
        let mut error = || {
            let sum: f64 = (0..12)
                .map(|_| {
                    chance = chance.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    f64::from(chance >> 8) / f64::from(1 << 24)
                })
                .sum();
            0.02 * (sum - 6.0)
        };
        let commanded: Vec<f64> = (0..4 * poses).map(|i| at(i / 4, i % 4)).collect();
        let went: Vec<f64> = commanded.iter().map(|q| q + error()).collect();
        let targets = r#""A":[0,0,60],"B":[40,50,20],"C":[-45,30,-15]"#;
        let mut session = arm_at(went.chunks(4), targets);
        for (joint, q) in session.samples.q.iter_mut().enumerate() {
            for (i, q) in q.iter_mut().enumerate() {
                *q = commanded[4 * (i / 3) + joint].to_radians();
            }
        }
        session
    }

    /// The error of repeatability is the same in all rows of a pose, which have the information of one.
    #[test]
    fn rows_of_a_pose_are_one_witness_of_what_moved() {
        for seed in [4, 9, 12, 14, 19, 21] {
            let session = arm_that_does_not_repeat(seed, 26 + 5 * (seed % 3));
            let problems = steps(&session, JointValues::Commanded);
            assert!(
                problems.is_empty(),
                "{seed}: {:?}",
                problems[0].what.to_string()
            );
        }
    }
}
