//! The bar for finding and naming hidden effects, measured on sessions that an independent rig
//! makes (`tests/support/rig.rs`, which shares no code with the model).
//!
//! `cargo run --release --example hidden_effects [SESSIONS PER CELL] [ROW]`

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

#[path = "../tests/support/rig.rs"]
mod rig;

use rig::{Design, Hidden, Kind, NAMES, Random, Rig, Shot};
use truepose::diagnosis::next_poses::NextPose;
use truepose::diagnosis::{Allowed, Diagnosis, Options, Verdict, diagnose};

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

fn row(name: &str, good: usize, of: usize, bar: &str) {
    let share = good as f64 / of.max(1) as f64;
    println!("| {name} | {good}/{of} = {:.1} % | {bar} |", 100.0 * share);
}

fn false_alarms(n: usize) {
    let kinds = [
        (Kind::Gauss, "Gaussian"),
        (Kind::Tails, "heavy-tailed"),
        (Kind::Correlated, "correlated in time"),
        (Kind::Unequal, "unequal axes"),
        (Kind::Outliers, "2 % outliers"),
        (Kind::Quantised, "quantised"),
    ];
    for (kind, name) in kinds {
        let mut alarms = 0;
        for k in 0..n {
            let mut random = Random(1 + 7919 * k as u64);
            let design = Design {
                kind,
                reflectors: 1 + k % 2,
                samples: [120, 60, 200, 30][k % 4],
                ..design(&mut random, "")
            };
            let rig = hidden(&design, &[], 0.0, &mut random);
            alarms += usize::from(diagnosed(&rig, &[]).verdict != Verdict::Noise);
        }
        row(&format!("false alarms, {name}"), alarms, n, "≤ 1 %");
    }
}

fn single_names() -> impl Iterator<Item = &'static str> {
    let aliased = ["lost-motion", "instrument-scale"];
    NAMES.into_iter().filter(move |id| !aliased.contains(id))
}

fn one_effect(n: usize) {
    for (lambda, bar) in [(200.0, "≥ 99 %"), (100.0, "≥ 97 %"), (40.0, "≥ 75 %")] {
        let (mut exact, mut covered, mut parameters, mut close, mut of) = (0, 0, 0, 0, 0);
        for id in single_names() {
            for k in 0..n {
                let mut random = Random(77 + id.len() as u64 + 104_729 * k as u64);
                let design = design(&mut random, id);
                let rig = hidden(&design, &[id], lambda, &mut random);
                let answer = diagnosed(&rig, &[]);
                of += 1;
                if names(&answer) != [id] || answer.unexplained.present {
                    continue;
                }
                exact += 1;
                let truth = [
                    ("offset_deg", rig.offset.to_degrees()),
                    ("delta_mm", rig.length),
                ];
                for estimate in &answer.identified {
                    let value = truth.iter().find(|t| t.0 == estimate.name);
                    if let (Some((_, value)), Some([low, high])) = (value, estimate.ci95) {
                        parameters += 1;
                        covered += usize::from(low <= *value && *value <= high);
                    }
                }
                let held_out = answer.held_out.gaps.map_or(0.0, |g| g.end_mm);
                close += usize::from(held_out <= 1.03 * answer.floor.mm);
            }
        }
        row(&format!("one effect, λ = {lambda}: exact"), exact, of, bar);
        row(
            "  95 % intervals of zero offset and link length cover",
            covered,
            parameters,
            "93–97 %",
        );
        row(
            "  held-out gap within 1.03 of the stated floor",
            close,
            exact,
            "on average",
        );
    }
}

fn three_effects(n: usize) {
    let pool: Vec<&str> = single_names()
        .filter(|id| *id != "joint-compliance")
        .collect();
    let mut exact = 0;
    for k in 0..n {
        let mut random = Random(5 + 15_485_863 * k as u64);
        let design = Design {
            samples: 200,
            reflectors: 2,
            span_deg: 170.0,
            ..design(&mut random, "")
        };
        let mut ids: Vec<&str> = Vec::new();
        while ids.len() < 3 {
            let id = pool[random.below(pool.len())];
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
        let rig = hidden(&design, &ids, 200.0, &mut random);
        ids.sort_unstable();
        let answer = diagnosed(&rig, &[]);
        exact += usize::from(names(&answer) == ids && !answer.unexplained.present);
    }
    row(
        "three effects, λ = 200, two reflectors: exact",
        exact,
        n,
        "≥ 95 %",
    );
}

/// One radius, or one speed: said, in the set, and resolved by the proposed poses: those of the
/// first answer, and those of up to three answers one after the other. Beside it a uniform grid
/// with the same new reflector and speeds, and twice as many poses.
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
        let (mut said, mut inside) = (0, 0);
        let (mut first, mut resolved) = ((0, 0), (0, 0));
        let mut grids = [0; GRIDS.len()];
        for k in 0..n {
            let mut random = Random(3 + 49_979_687 * k as u64);
            let design = Design {
                one_speed: conditions,
                conditions,
                span_deg: 170.0,
                ..design(&mut random, "")
            };
            let rig = hidden(&design, &truth, 400.0, &mut random);
            let answer = diagnosed(&rig, &[]);
            let exact = names(&answer) == truth;
            said += usize::from(!answer.equivalent.is_empty());
            let reached = answer
                .equivalent
                .iter()
                .any(|e| reaches(&answer, e, &truth));
            inside += usize::from(exact || reached);
            // Round after round: measure, diagnose again.
            let (mut extended, mut again, mut poses) = (rig.clone(), answer.clone(), 0);
            for round in 0..3 {
                if again.next_poses.is_empty() || decided(&again, &truth) {
                    break;
                }
                poses += again.next_poses.len();
                extended = measured_more(&extended, &again.next_poses, &mut random);
                again = diagnosed(&extended, &[]);
                if round == 0 {
                    first.0 += usize::from(decided(&again, &truth));
                    first.1 += poses;
                }
            }
            resolved.0 += usize::from(decided(&again, &truth));
            resolved.1 += poses;
            for (grid, count) in grids.iter_mut().zip(GRIDS) {
                let uniform = uniform(&answer.next_poses, count);
                let gridded = diagnosed(&measured_more(&rig, &uniform, &mut random), &[]);
                *grid += usize::from(decided(&gridded, &truth));
            }
        }
        row(
            &format!("{name}, {}: said", truth.join(" + ")),
            said,
            n,
            "≥ 95 %",
        );
        row("  truth in the set", inside, n, "≥ 99 %");
        let mean = |poses: usize| poses as f64 / n as f64;
        row(
            &format!(
                "  resolved by the first {:.1} proposed poses",
                mean(first.1)
            ),
            first.0,
            n,
            "≥ 95 %",
        );
        row(
            &format!(
                "  resolved by {:.1} poses in up to three rounds",
                mean(resolved.1)
            ),
            resolved.0,
            n,
            "≥ 95 %",
        );
        for (grid, count) in grids.into_iter().zip(GRIDS) {
            row(
                &format!("  resolved by a uniform grid of {count}"),
                grid,
                n,
                "for comparison",
            );
        }
    }
}

/// Poses of the uniform grids that are held against the proposals.
const GRIDS: [usize; 8] = [3, 4, 6, 8, 12, 16, 24, 36];

/// The truth, alone.
fn decided(answer: &Diagnosis, truth: &[&str]) -> bool {
    names(answer) == truth && answer.equivalent.is_empty() && !answer.unexplained.present
}

/// The rig with these poses measured after the others.
fn measured_more(rig: &Rig, poses: &[NextPose], random: &mut Random) -> Rig {
    let mut rig = rig.clone();
    let last = rig.shots.last().map_or(0.0, |s| s.time);
    let mut shots = Vec::new();
    for (i, pose) in poses.iter().enumerate() {
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
    rig.measure_more(shots, random);
    rig
}

/// So many poses at equal steps over the travel: both sides, both reflectors where a new one was
/// proposed, standstill and both new speeds where speeds were, all in turn.
fn uniform(proposed: &[NextPose], count: usize) -> Vec<NextPose> {
    let Some(like) = proposed
        .iter()
        .find(|p| p.target_mm.is_some())
        .or(proposed.first())
    else {
        return Vec::new();
    };
    let fast = |p: &NextPose| p.speed.as_ref().map_or(0.0, |s| s[0].abs());
    let speeds: &[f64] = if proposed.iter().any(|p| fast(p) > 0.0) {
        &[0.0, 10.0, 30.0]
    } else {
        &[0.0]
    };
    let mut conditions = Vec::new();
    for new_reflector in [true, false] {
        for speed in speeds {
            for dir in [-1.0, 1.0] {
                let mut pose = like.clone();
                if !new_reflector {
                    (pose.target, pose.target_mm) = (Some("T1".to_owned()), None);
                }
                if like.target_mm.is_none() && !new_reflector {
                    continue;
                }
                pose.dir = vec![dir];
                pose.speed = like
                    .speed
                    .as_ref()
                    .map(|_| vec![(dir * speed).to_radians()]);
                conditions.push(pose);
            }
        }
    }
    let step = 340.0 / count.max(1) as f64;
    let pose = |k: usize| NextPose {
        q: vec![(-170.0 + step * (k as f64 + 0.5)).to_radians()],
        ..conditions[k % conditions.len()].clone()
    };
    (0..count).map(pose).collect()
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

fn unknown(n: usize) {
    for id in ["bump", "sawtooth", "plateau"] {
        let (mut flagged, mut named) = (0, 0);
        for k in 0..n {
            let mut random = Random(9 + 32_452_843 * k as u64);
            let design = Design {
                samples: 240,
                ..design(&mut random, "")
            };
            let rig = hidden(&design, &[id], 400.0, &mut random);
            let answer = diagnosed(&rig, &[]);
            flagged += usize::from(answer.unexplained.present);
            let gear = names(&answer)
                .iter()
                .all(|f| *f == "gear-transmission-error");
            named += usize::from(!(answer.found.is_empty() || id == "sawtooth" && gear));
        }
        row(
            &format!("unknown {id}, λ = 400: flagged"),
            flagged,
            n,
            "≥ 95 %",
        );
        row("  named", named, n, "≤ 5 %");
    }
}

fn one_name_left_out(n: usize) {
    let (mut all, mut of) = (0, 0);
    for id in single_names() {
        let mut flagged = 0;
        for k in 0..n {
            let mut random = Random(77 + id.len() as u64 + 104_729 * k as u64);
            let design = design(&mut random, id);
            let rig = hidden(&design, &[id], 400.0, &mut random);
            flagged += usize::from(diagnosed(&rig, &[id]).unexplained.present);
        }
        row(
            &format!("without {id}, λ = 400: flagged"),
            flagged,
            n,
            "≥ 90 %",
        );
        (all, of) = (all + flagged, of + n);
    }
    row("without its name, all: flagged", all, of, "≥ 90 %");
}

/// Name and measurement of a row of the table.
type Row = (&'static str, fn(usize));

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let n = arguments.first().and_then(|n| n.parse().ok()).unwrap_or(25);
    let only = arguments.get(1).map(String::as_str);
    println!("| what | measured | bar |\n| --- | --- | --- |");
    let rows: [Row; 6] = [
        ("noise", false_alarms),
        ("one", one_effect),
        ("three", three_effects),
        ("alias", aliases),
        ("unknown", unknown),
        ("without", one_name_left_out),
    ];
    for (name, measure) in rows {
        if only.is_none_or(|only| only == name) {
            measure(n);
        }
    }
}
