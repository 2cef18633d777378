//! Designs that cannot decide, and the poses that do.

use truepose::diagnosis::Diagnosis;
use truepose::diagnosis::NextPose;

use crate::asked::{in_short, in_the_set};
use crate::cells::{count, details, in_parallel, row};
use crate::rig::{Design, Random, Rig, Shot};
use crate::{design, diagnosed, hidden, names};

/// One radius, or one speed: said, in the set, and resolved by the proposed poses: those of the
/// first answer, and those of up to three answers one after the other. With `GRIDS` in the
/// environment uniform grids with the same new reflector and speeds are measured as well.
pub fn aliases(n: usize) {
    for (name, truth, conditions) in [
        (
            "one radius",
            vec!["base-offset", "encoder-eccentricity"],
            false,
        ),
        ("one speed", vec!["backlash"], true),
        ("one speed", vec!["tracking-lag"], true),
    ] {
        let what = format!("{name}, {}", truth.join(" + "));
        if std::env::var("CASE").is_ok_and(|case| !what.contains(&case)) {
            continue;
        }
        let outcomes = in_parallel(n, |k| resolved(k, &truth, conditions));
        row(
            &format!("{what}: said"),
            count(&outcomes, |o| o.said),
            n,
            "≥ 95 %",
        );
        row(
            "  truth in the set",
            count(&outcomes, |o| o.inside),
            n,
            "≥ 99 %",
        );
        // What was not ambiguous needs no poses.
        let open: Vec<Outcome> = outcomes.into_iter().filter(|o| o.said).collect();
        let table = |what: &str, does: &dyn Fn(&Outcome) -> bool, bar: &str| {
            row(what, count(&open, does), open.len(), bar);
        };
        let rounds = |o: &Outcome, most: usize| -> usize { o.poses.iter().take(most).sum() };
        let mean = |most: usize| {
            let all: usize = open.iter().map(|o| rounds(o, most)).sum();
            all as f64 / open.len().max(1) as f64
        };
        let says = format!("  resolved by the first {:.1} proposed poses", mean(1));
        table(&says, &|o| o.decided_after == Some(1), "≥ 95 %");
        let says = format!(
            "  resolved by {:.1} poses in up to three rounds",
            mean(ROUNDS)
        );
        table(&says, &|o| o.decided_after.is_some(), "≥ 95 %");
        for (index, poses) in GRIDS.into_iter().enumerate() {
            let says = format!("  resolved by a uniform grid of {poses}");
            let does = |o: &Outcome| o.grids.get(index) == Some(&true);
            if open.iter().any(|o| !o.grids.is_empty()) {
                table(&says, &does, "for comparison");
            }
        }
    }
}

/// Rounds of measuring and diagnosing again.
const ROUNDS: usize = 3;

/// What became of one session.
struct Outcome {
    /// Whether the ambiguity was reported.
    said: bool,
    /// Whether the truth was reported, alone or among others.
    inside: bool,
    /// Poses of each round.
    poses: Vec<usize>,
    /// The number of rounds that it took.
    decided_after: Option<usize>,
    /// Whether the uniform grids decided.
    grids: Vec<bool>,
}

fn resolved(k: usize, truth: &[&str], conditions: bool) -> Outcome {
    let mut random = Random(3 + 49_979_687 * k as u64);
    let design = Design {
        one_speed: conditions,
        conditions,
        span_deg: 170.0,
        ..design(&mut random, "")
    };
    let rig = hidden(&design, truth, 400.0, &mut random);
    let answer = diagnosed(&rig, &[]);
    // Round after round: measure, diagnose again.
    let (mut extended, mut again) = (rig.clone(), answer.clone());
    let (mut poses, mut decided_after) = (Vec::new(), None);
    for round in 1..=ROUNDS {
        if again.next_poses.is_empty() {
            break;
        }
        poses.push(again.next_poses.len());
        extended = measured_more(&extended, &again.next_poses, &mut random);
        let before = again;
        again = diagnosed(&extended, &[]);
        if decided(&again, truth) {
            decided_after = Some(round);
            break;
        }
        details(|| {
            let asked: String = before.next_poses.iter().map(in_words).collect();
            format!(
                "{k} round {round} open: before {} {}\n  asked{asked}\n  after {} {}",
                in_short(&rig, &before),
                odds(&before),
                in_short(&extended, &again),
                odds(&again),
            )
        });
    }
    if poses.is_empty() {
        details(|| format!("{k}: nothing proposed: {}", in_short(&rig, &answer)));
    }
    let mut grids = Vec::new();
    if std::env::var_os("GRIDS").is_some() {
        for count in GRIDS {
            let uniform = uniform(&answer.next_poses, count);
            let gridded = diagnosed(&measured_more(&rig, &uniform, &mut random), &[]);
            grids.push(decided(&gridded, truth));
        }
    }
    Outcome {
        said: !answer.equivalent.is_empty(),
        inside: in_the_set(&answer, truth),
        poses,
        decided_after,
        grids,
    }
}

fn odds(answer: &Diagnosis) -> String {
    let odds: Vec<f64> = answer.equivalent.iter().map(|e| e.odds.ln()).collect();
    let out: Vec<usize> = answer.outliers.iter().map(|o| o.sample).collect();
    format!("ln odds {odds:.1?} outliers {out:?}")
}

fn in_words(pose: &NextPose) -> String {
    let speed = pose.speed.as_ref().map_or(0.0, |s| s[0].to_degrees());
    format!(
        " ({:.0}° {:+} {speed:.0}°/s {})",
        pose.q[0].to_degrees(),
        pose.dir[0],
        pose.target.as_deref().unwrap_or("-")
    )
}

/// Poses of the uniform grids that the proposals are compared with.
const GRIDS: [usize; 4] = [8, 12, 16, 24];

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
