//! The bar for finding and naming hidden effects, measured on sessions that an independent rig
//! makes (`tests/support/rig.rs`, which shares no code with the model).
//!
//! `cargo run --release --no-default-features --example hidden_effects [SESSIONS PER CELL] [ROW]`
//!
//! With `DETAILS` in the environment every session that went wrong is told on the error stream.

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]
#![allow(
    unreachable_pub,
    reason = "the parts of this program are modules of one example"
)]

#[path = "hidden_effects/absorbed.rs"]
mod absorbed;
#[path = "hidden_effects/cells.rs"]
mod cells;
#[path = "hidden_effects/known.rs"]
mod known;
#[path = "hidden_effects/noise.rs"]
mod noise;
#[path = "../tests/support/rig.rs"]
mod rig;
#[path = "hidden_effects/unknown.rs"]
mod unknown;

use cells::row;
use rig::{Design, Hidden, NAMES, Random, Rig, Shot};
use truepose::diagnosis::{Allowed, Diagnosis, Options, diagnose};

fn diagnosed(rig: &Rig, without: &[&str]) -> Diagnosis {
    let loaded = truepose::sessions::parse(rig.json("hidden").as_bytes()).expect("a good session");
    let options = Options {
        allowed: Allowed {
            without: without.iter().map(|id| (*id).to_owned()).collect(),
            only: None,
        },
        ..Options::default()
    };
    diagnose(&loaded.session, &options, &|_| true).expect("a diagnosis")
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    let mut names: Vec<_> = answer.found.iter().map(|f| f.effect).collect();
    names.sort_unstable();
    names
}

/// A design as they come; some effects need a full turn or gravity across the axis to be told.
fn design(random: &mut Random, id: &str) -> Design {
    let needs_a_turn = [
        "joint-scale",
        "encoder-eccentricity",
        "base-offset",
        "bearing-runout",
    ];
    let half = random.unit() < 0.5 && !needs_a_turn.contains(&id);
    Design {
        span_deg: if half { 90.0 } else { 170.0 },
        shuffled: random.unit() < 0.5,
        gravity_across: id == "joint-compliance",
        ..Design::default()
    }
}

fn hidden(design: &Design, ids: &[&str], lambda: f64, random: &mut Random) -> Rig {
    let mut rig = Rig::new(design, random);
    for id in ids {
        let effect = Hidden::random(id, random, design);
        let effect = rig.sized(&effect, lambda);
        rig.hidden.push(effect);
    }
    rig.measure(random);
    rig
}

fn single_names() -> impl Iterator<Item = &'static str> {
    let aliased = ["lost-motion", "instrument-scale"];
    NAMES.into_iter().filter(move |id| !aliased.contains(id))
}

/// One radius, or one speed: said, in the set, and resolved by the proposed poses.
fn aliases(n: usize) {
    for (name, truth, conditions) in [
        (
            "one radius",
            vec!["base-offset", "encoder-eccentricity"],
            false,
        ),
        ("one speed", vec!["backlash"], true),
        ("one speed", vec!["tracking-lag"], true),
    ] {
        let (mut said, mut inside, mut resolved, mut poses) = (0, 0, 0, 0);
        for k in 0..n {
            let mut random = Random(3 + 49_979_687 * k as u64);
            let design = Design {
                one_speed: conditions,
                conditions,
                span_deg: 170.0,
                ..design(&mut random, "")
            };
            let mut rig = hidden(&design, &truth, 400.0, &mut random);
            let answer = diagnosed(&rig, &[]);
            let exact = names(&answer) == truth;
            said += usize::from(!answer.equivalent.is_empty());
            inside += usize::from(
                exact
                    || answer
                        .equivalent
                        .iter()
                        .any(|e| reaches(&answer, e, &truth)),
            );
            poses += answer.next_poses.len();
            let last = rig.shots.last().map_or(0.0, |s| s.time);
            let mut shots = Vec::new();
            for (i, pose) in answer.next_poses.iter().enumerate() {
                let target = pose.target_mm.map_or_else(
                    || usize::from(pose.target.as_deref() == Some("T2")),
                    |mm| {
                        if rig.targets.len() == 1 {
                            rig.targets.push(mm);
                        }
                        1
                    },
                );
                shots.push(Shot {
                    q: pose.q[0],
                    dir: pose.dir[0],
                    speed: pose.speed.as_ref().map_or(0.0, |s| s[0]),
                    load: pose.load_kg.unwrap_or(0.0),
                    warmth: pose.temperature_c.map_or(0.0, |t| t - 20.0),
                    time: last + 6.0 * (i + 1) as f64,
                    travel: f64::INFINITY,
                    target,
                });
            }
            rig.measure_more(shots, &mut random);
            let again = diagnosed(&rig, &[]);
            resolved += usize::from(names(&again) == truth && again.equivalent.is_empty());
        }
        row(
            &format!("{name}, {}: said", truth.join(" + ")),
            said,
            n,
            "≥ 95 %",
        );
        row("  truth in the set", inside, n, "≥ 99 %");
        row("  resolved by the proposed poses", resolved, n, "≥ 95 %");
        println!(
            "|   poses proposed on average | {:.1} | |",
            poses as f64 / n as f64
        );
    }
}

/// Whether the exchange leads from what was found to the truth.
fn reaches(answer: &Diagnosis, rival: &truepose::diagnosis::Equivalent, truth: &[&str]) -> bool {
    let mut set: Vec<&str> = names(answer);
    for gone in &rival.explanation {
        if let Some(at) = set.iter().position(|id| id == gone) {
            set.remove(at);
        }
    }
    set.extend(rival.instead.iter().copied());
    set.sort_unstable();
    set == truth
}

/// Name and measurement of a row of the table.
type Row = (&'static str, fn(usize));

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let n = arguments.first().and_then(|n| n.parse().ok()).unwrap_or(25);
    let only = arguments.get(1).map(String::as_str);
    println!("| what | measured | bar |\n| --- | --- | --- |");
    let rows: [Row; 6] = [
        ("noise", noise::false_alarms),
        ("one", known::one_effect),
        ("three", known::three_effects),
        ("alias", aliases),
        ("unknown", unknown::unknown),
        ("without", unknown::one_name_left_out),
    ];
    for (name, measure) in rows {
        if only.is_none_or(|only| only == name) {
            measure(n);
        }
    }
}
