//! Hidden effects from a rig that shares no code with the model (`support/rig.rs`): what was
//! hidden has to be named, noise has to be left alone, and what cannot be decided has to be said.
//! The full table of rates comes from `cargo run --release --example hidden_effects`.

use crate::rig::{Design, Hidden, Kind, NAMES, Random, Rig};
use truepose::diagnosis::{Allowed, Diagnosis, Options, Progress, Stopped, Verdict};
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, parse};

fn session(rig: &Rig) -> Session {
    parse(rig.json("hidden").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn diagnosed(rig: &Rig, options: &Options) -> Diagnosis {
    diagnose(&session(rig), options, &|_| true).expect("a diagnosis")
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    let mut names: Vec<_> = answer.found.iter().map(|f| f.effect).collect();
    names.sort_unstable();
    names
}

fn without(ids: &[&str]) -> Options {
    Options {
        allowed: Allowed {
            without: ids.iter().map(|id| (*id).to_owned()).collect(),
            only: None,
        },
        ..Options::default()
    }
}

fn measured(design: &Design, ids: &[&str], lambda: f64, seed: u64) -> Rig {
    Rig::measured(design, ids, lambda, seed).0
}

#[test]
fn every_effect_is_named_by_its_own_name_alone() {
    // Lost motion may stand as backlash, and a scale of the instrument as an offset of the base.
    let decidable = NAMES
        .iter()
        .filter(|id| !["lost-motion", "instrument-scale"].contains(id));
    for (k, id) in decidable.enumerate() {
        let design = Design {
            gravity_across: *id == "joint-compliance",
            shuffled: k % 2 == 0,
            ..Design::default()
        };
        let rig = measured(&design, &[id], 200.0, 40 + k as u64);
        let answer = diagnosed(&rig, &Options::default());
        assert_eq!(names(&answer), [*id], "{:?}", rig.hidden);
        assert_eq!(answer.verdict, Verdict::Explained);
        let [before, after] = answer.found[0].held_out_mm.expect("120 samples");
        assert!(after < before, "{id}: {before} → {after}");
        let floor = answer.floor.mm;
        assert!(answer.gap.end_mm < 1.15 * floor, "{id}: {:?}", answer.gap);
    }
}

#[test]
fn noise_of_every_kind_is_left_alone() {
    let kinds = [
        Kind::Gauss,
        Kind::Tails,
        Kind::Correlated,
        Kind::Unequal,
        Kind::Outliers,
        Kind::Quantised,
    ];
    for kind in kinds {
        for (seed, shuffled) in [(1, true), (2, false)] {
            let design = Design {
                shuffled,
                kind,
                ..Design::default()
            };
            let answer = diagnosed(&measured(&design, &[], 0.0, seed), &Options::default());
            assert_eq!(
                answer.verdict,
                Verdict::Noise,
                "{kind:?}: {:?}",
                names(&answer)
            );
        }
    }
}

#[test]
fn three_effects_at_once_are_named_exactly() {
    let design = Design {
        samples: 200,
        reflectors: 2,
        ..Design::default()
    };
    for (seed, ids) in [
        (7, ["axis-tilt", "backlash", "thermal-growth"]),
        (
            8,
            ["frame-drift", "gear-transmission-error", "tracking-lag"],
        ),
    ] {
        let rig = measured(&design, &ids, 250.0, seed);
        let answer = diagnosed(&rig, &Options::default());
        assert_eq!(names(&answer), ids, "{:?}", rig.hidden);
    }
}

#[test]
fn what_no_catalogue_has_is_flagged_and_not_named() {
    let design = Design {
        samples: 240,
        ..Design::default()
    };
    for id in ["bump", "plateau", "sawtooth"] {
        let rig = measured(&design, &[id], 400.0, 11);
        let answer = diagnosed(&rig, &Options::default());
        assert_eq!(
            answer.verdict,
            Verdict::Unexplained,
            "{:?}: {:?}",
            rig.hidden,
            names(&answer)
        );
        assert!(answer.unexplained.place.is_some());
        assert!(answer.unexplained.rms_mm > 0.01);
    }
}

#[test]
fn an_effect_without_its_name_is_flagged() {
    for id in [
        "axis-wobble",
        "backlash",
        "joint-scale",
        "thermal-growth",
        "tracking-lag",
    ] {
        let rig = measured(&Design::default(), &[id], 400.0, 21);
        let answer = diagnosed(&rig, &without(&[id]));
        assert!(answer.unexplained.present, "{id}: {:?}", names(&answer));
    }
}

#[test]
fn at_one_speed_backlash_and_tracking_lag_are_both_possible_and_poses_decide() {
    let design = Design {
        one_speed: true,
        ..Design::default()
    };
    let rig = measured(&design, &["tracking-lag"], 200.0, 31);
    let answer = diagnosed(&rig, &Options::default());
    let mut both: Vec<&str> = names(&answer);
    let others = answer.equivalent.iter().flat_map(|e| &e.instead);
    both.extend(others.map(String::as_str));
    assert!(
        both.contains(&"backlash") && both.contains(&"tracking-lag"),
        "{both:?}"
    );
    assert!(!answer.next_poses.is_empty());
    let speeds: Vec<f64> = answer
        .next_poses
        .iter()
        .filter_map(|p| p.speed.as_ref().map(|s| s[0].to_degrees().abs()))
        .collect();
    assert!(speeds.iter().any(|s| (s - 10.0).abs() > 1.0), "{speeds:?}");
}

#[test]
fn approached_from_one_side_backlash_is_not_testable_and_the_answer_says_why() {
    let design = Design {
        one_way: true,
        ..Design::default()
    };
    let answer = diagnosed(&measured(&design, &[], 0.0, 3), &Options::default());
    let reason = answer
        .not_testable
        .iter()
        .find(|n| n.effect == "backlash")
        .expect("listed");
    assert!(reason.because.contains("same side"), "{}", reason.because);
}

#[test]
fn tiny_planar_and_noise_free_sessions_answer_sensibly() {
    for samples in [1, 2, 3, 5, 12, 30] {
        let design = Design {
            samples,
            ..Design::default()
        };
        let answer = diagnosed(&measured(&design, &[], 0.0, 17), &Options::default());
        assert_eq!(answer.verdict, Verdict::Noise, "{samples} samples");
    }
    let rig = measured(&Design::default(), &["encoder-two-cycle"], 200.0, 6);
    let mut planar = session(&rig);
    planar.samples.z_mm = None;
    let answer = diagnose(&planar, &Options::default(), &|_| true).expect("a diagnosis");
    assert_eq!(names(&answer), ["encoder-two-cycle"]);
    let quiet = Design {
        sigma_mm: 1e-9,
        ..Design::default()
    };
    let mut random = Random(4);
    let mut rig = Rig::new(&quiet, &mut random);
    rig.hidden = vec![Hidden::Backlash(4e-4), Hidden::TwoCycle(2e-4, 1.0)];
    rig.measure(&mut random);
    let answer = diagnosed(&rig, &Options::default());
    assert_eq!(names(&answer), ["backlash", "encoder-two-cycle"]);
}

/// The practice sessions lie beside the project; without them there is nothing to test.
#[test]
fn practice_sessions_are_diagnosed_as_they_were_made() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/practice");
    if !folder.is_dir() {
        eprintln!("skipped: ../shared/practice is not there");
        return;
    }
    let mut tried = 0;
    for entry in std::fs::read_dir(&folder).expect("readable") {
        let path = entry.expect("readable").path();
        let stem = path
            .file_stem()
            .and_then(|s| s.to_str())
            .unwrap_or("")
            .to_owned();
        if path.extension().is_none_or(|e| e != "json") || stem == "truth" {
            continue;
        }
        let session = truepose::sessions::load(&path)
            .expect("a good session")
            .session;
        let answer = diagnose(&session, &Options::default(), &|_| true).expect("a diagnosis");
        tried += 1;
        let (kind, hidden) = stem.split_once('-').expect("kind-what");
        match kind {
            "one" if hidden == "way-only" => {
                let mut blocked = answer.not_testable.iter();
                assert!(blocked.any(|n| n.effect == "backlash"));
                assert_eq!(answer.verdict, Verdict::Noise);
            }
            "one" => assert_eq!(names(&answer), [hidden], "{stem}"),
            "three" => {
                let mut expected: Vec<&str> = hidden.split('+').collect();
                expected.sort_unstable();
                assert_eq!(names(&answer), expected, "{stem}");
            }
            "nothing" => assert_eq!(answer.verdict, Verdict::Noise, "{stem}"),
            "alias" => {
                assert!(!answer.equivalent.is_empty(), "{stem}");
                assert!(!answer.next_poses.is_empty(), "{stem}");
            }
            _ => {
                assert!(
                    answer.unexplained.present && answer.unexplained.place.is_some(),
                    "{stem}"
                );
                assert!(answer.found.is_empty(), "{stem}: {:?}", names(&answer));
            }
        }
    }
    assert!(tried > 0, "no session in {}", folder.display());
}

#[test]
fn values_come_from_all_fit_samples_and_held_out_rows_touch_nothing() {
    // Kept from the search and then fitted: the same model as without the option.
    let rig = measured(&Design::default(), &["encoder-two-cycle"], 400.0, 12);
    let whole = diagnosed(&rig, &Options::default());
    let locked = Options {
        held_out: Some(0.25),
        ..Options::default()
    };
    let answer = diagnosed(&rig, &locked);
    assert_eq!(names(&whole), names(&answer));
    assert_eq!(answer.held_out.samples, 30);
    let unseen = answer.held_out.gaps.expect("30 samples are held out");
    assert!(unseen.end_mm < unseen.identified_mm);
    let (all, again) = (whole.model.coefficients(), answer.model.coefficients());
    for (a, b) in all.iter().zip(&again) {
        assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()), "{all:?} {again:?}");
    }
    for (a, b) in whole.found[0]
        .parameters
        .iter()
        .zip(&answer.found[0].parameters)
    {
        assert!((a.value - b.value).abs() < 1e-6, "{a:?} {b:?}");
    }
    assert!((whole.gap.end_mm - answer.gap.end_mm).abs() < 1e-9);

    // Rows that the session marks are never fitted, whatever they say.
    let mut rig = rig;
    let mut random = Random(3);
    rig.measure_unseen(&mut random);
    let good = diagnosed(&rig, &locked);
    assert!((good.found[0].parameters[0].value - whole.found[0].parameters[0].value).abs() < 1e-6);
    for i in (0..rig.measured.len()).filter(|i| rig.held_out[*i]) {
        rig.measured[i][0] += 3.0;
    }
    let bad = diagnosed(&rig, &locked);
    assert_eq!(good.model.coefficients(), bad.model.coefficients());
    let gaps = bad.held_out.gaps.expect("150 samples are held out");
    assert!(gaps.end_mm > 2.0, "{gaps:?}");
}

#[test]
fn a_watcher_can_stop_the_search() {
    let rig = measured(&Design::default(), &["backlash"], 400.0, 9);
    let stopped = diagnose(&session(&rig), &Options::default(), &|progress| {
        !matches!(progress, Progress::Searching { .. })
    });
    assert!(stopped.is_err());
}

#[test]
fn a_search_that_is_stopped_says_what_is_proven_until_then_where_that_is_wanted() {
    let rig = measured(
        &Design::default(),
        &["backlash", "encoder-eccentricity"],
        400.0,
        9,
    );
    let options = Options {
        keep_when_stopped: true,
        ..Options::default()
    };
    let asked = std::cell::Cell::new(0);
    let stopped = diagnose(&session(&rig), &options, &|progress| {
        let found = matches!(progress, Progress::Searching { found, .. } if !found.is_empty());
        asked.set(asked.get() + usize::from(found));
        !found
    })
    .expect("the answer until then");
    assert_eq!(asked.get(), 1, "who said no is not asked again");
    assert!(!stopped.found.is_empty());
    for found in &stopped.found {
        assert!(["backlash", "encoder-eccentricity"].contains(&found.effect));
    }
    assert_eq!(stopped.stopped, Some(Stopped::Asked));
    assert!(stopped.unexplained.present);
    assert!(
        stopped
            .unexplained
            .description
            .to_string()
            .starts_with("the search was stopped")
    );
    assert_eq!(stopped.verdict, Verdict::PartlyExplained);
    assert!(stopped.next_poses.is_empty());
}

#[test]
fn lost_motion_beside_another_effect_is_proved_on_unseen_samples() {
    let design = Design {
        samples: 200,
        span_deg: 170.0,
        reflectors: 2,
        ..Design::default()
    };
    for seed in 1..=4 {
        let rig = measured(&design, &["lost-motion", "axis-tilt"], 400.0, seed);
        let answer = diagnosed(&rig, &Options::default());
        let names = names(&answer);
        assert!(names.contains(&"axis-tilt"), "{seed}: {names:?}");
        let turns = ["lost-motion", "backlash"];
        assert!(
            turns.iter().any(|id| names.contains(id)),
            "{seed}: {names:?}"
        );
    }
}

/// A step of the frame imitates a slow drift so well that neighbouring times of one step must not be all
/// that is tried beside it: sessions of the row "one component, frame drift" in which they once were.
#[test]
fn a_drift_that_a_step_imitates_stands_in_the_set() {
    for (case, k) in [(6_u64, 8_u64), (5, 24)] {
        let mut random = Random(307 + 141_650_939 * k + 7 * case);
        let _ = random.unit();
        let design = Design {
            samples: [120, 200][usize::from(k % 2 == 1)],
            shuffled: random.unit() < 0.5,
            ..Design::default()
        };
        let mut rig = Rig::new(&design, &mut random);
        let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let _ = random.unit();
        let drift = match case {
            5 => [1e-5 * sign, 0.0, 0.0],
            _ => [0.0, 0.0, 1e-5 * sign],
        };
        rig.hidden = vec![rig.sized(&Hidden::Drift(drift), 100.0)];
        rig.measure(&mut random);
        let answer = diagnosed(&rig, &Options::default());
        let rivals = answer.equivalent.iter().flat_map(|e| &e.instead);
        let mut set = names(&answer).into_iter().chain(rivals.map(String::as_str));
        assert!(
            set.any(|id| id == "frame-drift"),
            "{case} {k}: {:?}",
            names(&answer)
        );
    }
}
