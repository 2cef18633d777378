//! What a simulation has put in, the identification takes out again.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use proptest::prelude::*;
use truepose::effects::JointValues;
use truepose::fit::{Identification, identify_exact};
use truepose::sessions::Session;
use truepose::simulation::{Truth, parse_scenario, simulate, unwatched};

/// A column with two reflectors and every condition.
fn session(effects: &str, noise: &str, seed: u64) -> (Session, Truth) {
    let text = format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"r","joints":[{{"name":"pan","kind":"revolute",
        "axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180],"mass_kg":4,"centre_mm":[120,0,0]}}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[0,0,-9.81]}},
        "targets":{{"T1":[0,0,0],"T2":[120,0,40]}},
        "poses":{{"sweep":{{"joint":1,"from_deg":-175,"to_deg":175,"step_deg":7,"both_ways":true,"order":"random"}}}},
        "conditions":{{"speed_deg_s":[0,5,20],"load_kg":[0,3,6],"temperature_c":{{"from":20,"to":26,"time_constant_s":300}},"seconds_per_pose":6}},
        "effects":[{effects}]{noise}}}"#
    );
    let scenario = parse_scenario(text.as_bytes()).unwrap().scenario;
    simulate(&scenario, seed, unwatched).unwrap()
}

fn identify(session: &Session, truth: &Truth) -> Identification {
    let ids = truth.effects.iter().map(|t| t.effect.about().id.to_owned());
    identify_exact(session, &ids.collect::<Vec<_>>(), JointValues::default()).unwrap()
}

fn offset_and_length(offset_deg: f64, delta_mm: f64) -> String {
    format!(
        r#"{{"effect":"joint-zero-offset","joint":1,"parameters":{{"offset_deg":{offset_deg}}}}},
           {{"effect":"link-length","joint":1,"parameters":{{"delta_mm":{delta_mm}}}}}"#
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn without_noise_offset_and_length_come_back_exactly_from_far_away(
        offset_deg in -30.0..30.0f64,
        share in -0.2..0.2f64,
    ) {
        let delta_mm = 250.0 * share;
        let (session, truth) = session(&offset_and_length(offset_deg, delta_mm), "", 1);
        let found = identify(&session, &truth);
        prop_assert!(found.gap.after.max_mm < 1e-9, "{:?}", found.gap);
        prop_assert!((found.parameters[0].value - offset_deg).abs() < 1e-11);
        prop_assert!((found.parameters[1].value - delta_mm).abs() < 1e-9);
    }
}

const SEVERAL: &str = r#"
    {"effect":"joint-zero-offset","joint":1,"parameters":{"offset_deg":-0.4}},
    {"effect":"joint-scale","joint":1,"parameters":{"scale_ppm":300}},
    {"effect":"encoder-eccentricity","joint":1,"parameters":{"amplitude_deg":0.05,"phase_deg":40}},
    {"effect":"backlash","joint":1,"parameters":{"width_deg":0.05}},
    {"effect":"tracking-lag","joint":1,"parameters":{"delay_s":0.01}},
    {"effect":"thermal-zero-drift","joint":1,"parameters":{"deg_per_degc":0.004}},
    {"effect":"link-length","joint":1,"parameters":{"delta_mm":-1.2}},
    {"effect":"tool-lateral-offset","joint":1,"parameters":{"delta_mm":0.3}},
    {"effect":"link-droop","parameters":{"mm_per_kg":0.02}},
    {"effect":"axis-tilt","joint":1,"parameters":{"about_x_mrad":0.5,"about_y_mrad":-0.7}},
    {"effect":"base-offset","parameters":{"x_mm":0.4,"y_mm":-0.3,"z_mm":0.1}}"#;

#[test]
fn without_noise_eleven_effects_come_back_together() {
    let (session, truth) = session(SEVERAL, "", 1);
    let found = identify(&session, &truth);
    assert!(found.gap.after.max_mm < 1e-9, "{:?}", found.gap);
    for (term, true_value) in truth.effects.iter().flat_map(|t| {
        t.parameters()
            .into_iter()
            .map(move |p| (t.effect.about().id, p))
    }) {
        let estimate = found
            .parameters
            .iter()
            .find(|p| p.effect == term && p.name == true_value.name)
            .unwrap();
        let off = (estimate.value - true_value.value).abs();
        assert!(
            off < 1e-7 * true_value.value.abs().max(1.0),
            "{term} {estimate:?}"
        );
    }
}

#[test]
fn under_noise_the_intervals_hold_the_truth_about_as_often_as_they_say() {
    let noise = r#","noise":{"sigma_mm":0.03}"#;
    let (mut inside, mut all) = (0_u32, 0_u32);
    for seed in 0..40 {
        let (session, truth) = session(SEVERAL, noise, seed);
        let found = identify(&session, &truth);
        for term in &truth.effects {
            for parameter in term.parameters() {
                let id = term.effect.about().id;
                let of = |p: &&truepose::fit::Estimate| p.effect == id && p.name == parameter.name;
                let [low, high] = found.parameters.iter().find(of).unwrap().ci95.unwrap();
                all += 1;
                inside += u32::from(low <= parameter.value && parameter.value <= high);
            }
        }
    }
    // 600 intervals; parameters of one session go together, so the bounds are wide.
    let share = f64::from(inside) / f64::from(all);
    assert!((0.91..=0.985).contains(&share), "{inside} of {all}");
}

#[test]
fn outliers_are_found_and_do_not_spoil_the_answer() {
    let rest = r#","noise":{"sigma_mm":0.01},"outliers":{"share":0.03,"mm":2}"#;
    let (session, truth) = session(&offset_and_length(-3.0, -5.0), rest, 4);
    let found = identify(&session, &truth);
    let mut suspected: Vec<usize> = found.outliers.iter().map(|o| o.sample).collect();
    suspected.sort_unstable();
    assert_eq!(suspected, truth.outliers);
    assert!((found.parameters[1].value + 5.0).abs() < 0.005);
}

#[test]
fn a_fade_between_the_scanned_ones_comes_back_with_an_interval_that_holds_it() {
    let effects = |fade: f64| {
        format!(
            r#"{{"effect":"lost-motion","joint":1,"parameters":{{"width_deg":0.08,"fade_deg":{fade}}}}}"#
        )
    };
    for fade in [4.0, 10.0, 37.0] {
        let (exact, truth) = session(&effects(fade), "", 1);
        let found = identify(&exact, &truth);
        assert!(found.gap.after.max_mm < 1e-9, "{fade}: {:?}", found.gap);
        assert_eq!(found.parameters[0].name, "fade_deg");
        assert!((found.parameters[0].value - fade).abs() < 1e-6);
        let (noisy, truth) = session(
            &effects(fade),
            r#","noise":{"sigma_mm":0.03,"kind":"gauss"}"#,
            2,
        );
        let found = identify(&noisy, &truth);
        let [low, high] = found.parameters[0].ci95.unwrap();
        assert!(
            low < fade && fade < high && high - low > 1e-3,
            "{fade}: {low} … {high}"
        );
        assert!(high - low < fade, "{fade}: {low} … {high}");
    }
}
