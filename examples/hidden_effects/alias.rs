//! Designs that cannot decide, and the poses that do.

use truepose::diagnosis::Diagnosis;
use truepose::diagnosis::NextPose;

use crate::cells::row;
use crate::rig::{Design, Random, Rig, Shot};
use crate::{design, diagnosed, hidden, names, reaches};

/// One radius, or one speed: said, in the set, and resolved by the proposed poses: those of the
/// first answer, and those of up to three answers one after the other. Beside it a uniform grid
/// with the same new reflector and speeds, and twice as many poses.
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
