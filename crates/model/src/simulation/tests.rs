use proptest::prelude::*;

use super::*;
use crate::sessions::regions::Assignment;
use crate::units::{deg_from_rad, rad_from_deg};

const ROBOT: &str = r#""robot":{"name":"r","joints":[{"name":"pan","kind":"revolute","axis":[0,0,1],
    "point_mm":[0,0,0],"limits":[-90,90]}],"tool":{"position_mm":[250,0,300],
    "quaternion_wxyz":[1,0,0,0]},"gravity_m_s2":[0,0,-9.81]}"#;

fn scenario(rest: &str) -> Scenario {
    let text = format!("{{\"format\":\"truepose-scenario/1\",{ROBOT},{rest}}}");
    parse_scenario(text.as_bytes()).unwrap().scenario
}

fn session(rest: &str) -> (Session, Truth) {
    simulate(&scenario(rest), 1, unwatched).unwrap()
}

fn degrees(column: &[f64]) -> Vec<f64> {
    column
        .iter()
        .map(|v| (deg_from_rad(*v) * 1e6).round() / 1e6)
        .collect()
}

#[test]
fn a_sweep_goes_there_and_back_and_says_from_which_side() {
    let (session, _) = session(
        r#""poses":{"sweep":{"joint":1,"from_deg":-6,"to_deg":6,"step_deg":6,"both_ways":true,"repeats":2}},
           "conditions":{"speed_deg_s":5,"seconds_per_pose":2}"#,
    );
    let samples = &session.samples;
    let once = [-6.0, 0.0, 6.0, 6.0, 0.0, -6.0];
    assert_eq!(degrees(&samples.q[0]), [once, once].concat());
    let sides = [1.0, 1.0, 1.0, -1.0, -1.0, -1.0];
    assert_eq!(samples.dir[0], Some([sides, sides].concat()));
    let speeds: Vec<f64> = sides.iter().map(|s| s * rad_from_deg(5.0)).collect();
    assert_eq!(samples.speed[0].as_ref().unwrap()[..6], speeds);
    assert_eq!(samples.time_s.as_ref().unwrap()[..3], [0.0, 2.0, 4.0]);
    assert_eq!(samples.load_kg, None);
}

#[test]
fn a_shuffled_sweep_has_every_stop_and_comes_from_where_it_was() {
    let (session, _) = session(
        r#""poses":{"sweep":{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":10,"both_ways":true,"repeats":3,"order":"random"}}"#,
    );
    let q = &session.samples.q[0];
    let dir = session.samples.dir[0].as_ref().unwrap();
    assert_eq!(q.len(), 19 * 6);
    for i in 1..q.len() {
        assert_ne!(q[i], q[i - 1], "sample {i} repeats the stop before it");
        assert_eq!(dir[i], (q[i] - q[i - 1]).signum());
    }
    let mut sorted = degrees(q);
    sorted.sort_by(f64::total_cmp);
    let expected = (-9..=9).flat_map(|k| [10.0 * f64::from(k); 6]);
    assert_eq!(sorted, expected.collect::<Vec<_>>());
}

#[test]
fn every_combination_of_conditions_occurs_equally_often() {
    let (session, _) = session(
        r#""targets":{"A":[0,0,0],"B":[10,0,0]},
           "poses":{"sweep":{"joint":1,"from_deg":-90,"to_deg":88,"step_deg":2}},
           "conditions":{"speed_deg_s":[0,5,20],"load_kg":[0,3,6]}"#,
    );
    let samples = &session.samples;
    let load = samples.load_kg.as_ref().unwrap();
    let speed = degrees(samples.speed[0].as_ref().unwrap());
    for (kg, deg_s) in [(0.0, 0.0), (3.0, 20.0), (6.0, 5.0)] {
        let both = load
            .iter()
            .zip(&speed)
            .filter(|(l, s)| **l == kg && **s == deg_s);
        assert_eq!(both.count(), 20, "{kg} kg at {deg_s}°/s");
    }
    assert_eq!(samples.target.as_ref().unwrap()[..4], [0, 1, 0, 1]);
}

#[test]
fn the_machine_warms_up_as_it_is_told() {
    let (session, _) = session(
        r#""poses":{"sweep":{"joint":1,"from_deg":0,"to_deg":60,"step_deg":60}},
           "conditions":{"temperature_c":{"from":20,"to":26,"time_constant_s":600},"seconds_per_pose":600}"#,
    );
    let temperature = session.samples.temperature_c.unwrap();
    assert_eq!(temperature[0], 20.0);
    assert!((temperature[1] - (26.0 - 6.0 / std::f64::consts::E)).abs() < 0.005);
}

#[test]
fn noise_has_the_root_mean_square_that_was_asked_for() {
    for kind in ["gauss", "t4", "ar1"] {
        let (session, truth) = session(&format!(
            r#""poses":{{"sweep":{{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":0.01}}}},
               "noise":{{"sigma_mm":0.03,"kind":"{kind}"}}"#,
        ));
        let z = session.samples.z_mm.as_ref().unwrap();
        for (measured, exact) in [
            (&session.samples.x_mm, &truth.exact.x_mm),
            (&session.samples.y_mm, &truth.exact.y_mm),
            (z, &truth.exact.z_mm),
        ] {
            let noise: Vec<f64> = measured.iter().zip(exact).map(|(m, e)| m - e).collect();
            let n = noise.len() as f64;
            let rms = (noise.iter().map(|e| e * e).sum::<f64>() / n).sqrt();
            assert!((rms / 0.03 - 1.0).abs() < 0.1, "{kind}: {rms}");
            let neighbours: f64 = noise.windows(2).map(|w| w[0] * w[1]).sum();
            let correlation = neighbours / n / (rms * rms);
            let expected = if kind == "ar1" { 0.7 } else { 0.0 };
            assert!(
                (correlation - expected).abs() < 0.05,
                "{kind}: {correlation}"
            );
        }
    }
}

#[test]
fn outliers_are_as_many_and_as_far_as_they_should_be() {
    let (session, truth) = session(
        r#""poses":{"sweep":{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":1}},"planar":true,
           "outliers":{"share":0.05,"mm":0.4}"#,
    );
    assert_eq!(session.samples.z_mm, None);
    assert_eq!(truth.outliers.len(), 9);
    for i in 0..session.samples.len() {
        let dx = session.samples.x_mm[i] - truth.exact.x_mm[i];
        let dy = session.samples.y_mm[i] - truth.exact.y_mm[i];
        let expected = if truth.outliers.contains(&i) {
            0.4
        } else {
            0.0
        };
        assert!((dx.hypot(dy) - expected).abs() < 1e-12);
    }
}

#[test]
fn another_noise_does_not_change_the_poses_and_another_seed_does() {
    let rest = |sigma: f64| {
        format!(
            r#""poses":{{"sweep":{{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":5,"order":"random"}}}},
               "noise":{{"sigma_mm":{sigma}}}"#
        )
    };
    let play = |sigma, seed| {
        simulate(&scenario(&rest(sigma)), seed, unwatched)
            .unwrap()
            .0
    };
    assert_eq!(play(0.1, 7), play(0.1, 7));
    assert_eq!(play(0.1, 7).samples.q, play(0.2, 7).samples.q);
    assert_ne!(play(0.1, 7).samples.q, play(0.1, 8).samples.q);
    assert_ne!(play(0.1, 7).samples.x_mm, play(0.2, 7).samples.x_mm);
}

#[test]
fn whoever_watches_can_stop_it() {
    let scenario =
        scenario(r#""poses":{"sweep":{"joint":1,"from_deg":-90,"to_deg":90,"step_deg":0.001}}"#);
    let mut heard = Vec::new();
    let stopped = simulate(&scenario, 1, |part| {
        heard.push(part);
        if part > 0.2 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert_eq!(stopped.unwrap_err(), SimulateError::Stopped);
    assert!(heard.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(*heard.last().unwrap() < 0.5);
}

#[test]
fn the_session_does_not_say_which_effects_were_in_it() {
    let rest = r#""poses":{"list":[{"q_deg":[30],"dir":[1]}]},
        "effects":[{"effect":"backlash","joint":1,"parameters":{"width_deg":0.05}}]"#;
    let (session, truth) = session(rest);
    let mut document = Vec::new();
    crate::sessions::write_inline(&session, &mut document).unwrap();
    assert!(!String::from_utf8(document).unwrap().contains("backlash"));
    let truth = truth.to_json();
    assert!(truth.contains("\"effect\": \"backlash\""), "{truth}");
    assert!(truth.contains("\"width_deg\": 0.05"), "{truth}");
}

#[test]
fn each_kind_of_wrong_scenario_is_refused_with_its_place() {
    let sweep = |inside: &str| format!("\"poses\":{{\"sweep\":{{{inside}}}}}");
    let fine = r#""joint":1,"from_deg":0,"to_deg":6,"step_deg":1"#;
    let cases = [
        (
            sweep(r#""joint":2,"from_deg":0,"to_deg":6,"step_deg":1"#),
            "poses.sweep.joint",
        ),
        (
            sweep(r#""joint":1,"from_deg":0,"to_deg":96,"step_deg":1"#),
            "poses.sweep.to_deg",
        ),
        (
            sweep(r#""joint":1,"from_deg":0,"to_deg":6,"step_deg":0"#),
            "poses.sweep",
        ),
        (
            sweep(r#""joint":1,"from_deg":0,"to_deg":6"#),
            "no key 'step_deg'",
        ),
        (
            sweep(r#""joint":1,"from_deg":0,"to_deg":6,"step_deg":1e-12"#),
            "samples",
        ),
        (
            sweep(&format!("{fine},\"order\":\"zigzag\"")),
            "poses.sweep.order",
        ),
        (
            sweep(&format!("{fine},\"repeats\":1.5")),
            "poses.sweep.repeats",
        ),
        ("\"poses\":{}".to_owned(), "no poses"),
        (r#""poses":{"list":[]}"#.to_owned(), "no pose"),
        (
            r#""poses":{"list":[{"q_deg":[1,2]}]}"#.to_owned(),
            "poses.list[0].q_deg",
        ),
        (
            r#""poses":{"list":[{"q_deg":[91]}]}"#.to_owned(),
            "poses.list[0]",
        ),
        (
            r#""poses":{"list":[{"q_deg":[1],"dir":[3]}]}"#.to_owned(),
            "poses.list[0].dir",
        ),
        (
            format!("{},\"noise\":{{\"sigma_mm\":-1}}", sweep(fine)),
            "noise.sigma_mm",
        ),
        (
            format!(
                "{},\"noise\":{{\"sigma_mm\":1,\"kind\":\"pink\"}}",
                sweep(fine)
            ),
            "noise.kind",
        ),
        (
            format!("{},\"outliers\":{{\"share\":2,\"mm\":1}}", sweep(fine)),
            "outliers",
        ),
        (format!("{},\"seed\":-1", sweep(fine)), "seed"),
        (
            format!(
                "{},\"conditions\":{{\"temperature_c\":{{\"from\":20,\"to\":26,\"time_constant_s\":9}}}}",
                sweep(fine)
            ),
            "conditions.seconds_per_pose",
        ),
        (
            format!(
                "{},\"effects\":[{{\"effect\":\"backlash\",\"parameters\":{{\"width\":1}}}}]",
                sweep(fine)
            ),
            "no parameter 'width'",
        ),
        (
            format!(
                "{},\"effects\":[{{\"effect\":\"backlash\",\"parameters\":{{\"width_mm\":1}}}}]",
                sweep(fine)
            ),
            "'width_mm'; expected width_deg: joint 1 turns",
        ),
        (
            format!(
                "{},\"effects\":[{{\"effect\":\"bearing-runout\",\"parameters\":{{\"order\":2,\"amplitude_mm\":-1}}}}]",
                sweep(fine)
            ),
            "an amplitude of 0 or more",
        ),
    ];
    for (rest, says) in cases {
        let text = format!("{{\"format\":\"truepose-scenario/1\",{ROBOT},\n{rest}}}");
        let refused = parse_scenario(text.as_bytes()).unwrap_err().to_string();
        assert!(
            refused.contains(says) && refused.contains("line"),
            "{rest}: {refused}"
        );
    }
}

#[test]
fn an_effect_that_cannot_show_is_said() {
    let text = format!(
        "{{\"format\":\"truepose-scenario/1\",{ROBOT},\"poses\":{{\"list\":[{{\"q_deg\":[1]}}]}},
        \"effects\":[{{\"effect\":\"frame-drift\",\"parameters\":{{\"x_mm_per_h\":1}}}}]}}"
    );
    let loaded = parse_scenario(text.as_bytes()).unwrap();
    let said = loaded.findings[0].to_string();
    assert!(said.contains("frame-drift does nothing here"), "{said}");
    assert!(said.contains("effects[0]"), "{said}");
}

#[test]
fn the_papers_boundaries_belong_to_the_regions_that_the_paper_has_them_in() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../sessions/paper-30.scenario.json"
    );
    let scenario = load_scenario(path).unwrap().scenario;
    let (session, _) = simulate(&scenario, scenario.seed, unwatched).unwrap();
    let assignment = Assignment::new(&session.regions);
    for (i, q) in session.samples.q[0].iter().enumerate() {
        assert_eq!(assignment.region_of(*q), Some(i / 5), "sample {i}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_damaged_scenario_is_refused_or_played_but_never_a_panic(
        at in any::<prop::sample::Index>(),
        junk in "[\\[\\]{}0-9eE.,:\"a-z-]{0,4}",
        which in 0..2usize,
    ) {
        let name = ["paper-30", "lamp-commissioning"][which];
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../sessions/");
        let mut text = std::fs::read_to_string(format!("{folder}{name}.scenario.json")).unwrap();
        let mut cut = at.index(text.len());
        while !text.is_char_boundary(cut) {
            cut -= 1;
        }
        text.insert_str(cut, &junk);
        if let Ok(loaded) = parse_scenario(text.as_bytes())
            && loaded.scenario.poses.stops() < 2000.0
            && let Ok((session, _)) = simulate(&loaded.scenario, 1, unwatched)
        {
            let mut document = Vec::new();
            crate::sessions::write_inline(&session, &mut document).unwrap();
            let again = crate::sessions::parse(&document);
            prop_assert!(again.is_ok(), "{}", again.unwrap_err());
        }
    }
}
