//! The conditions of the poses of a robot with several joints: from which side every joint comes, with which load, how
//! warm, so that they determine most of the effects in addition to the geometry.
//!
//! Loads and temperatures follow a schedule in four stretches; which pose is measured in which stretch, and from which sides, is
//! chosen by the information about every effect of the catalogue (D-optimality, `exchange`).
//! Within a stretch the poses are put into a short way. All are measured at standstill, after a separate approach that
//! is as long for every pose ([`approach`]).

use super::decision::WIDEST;
use crate::{fewest, rounding};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::arm::Arm;
use super::candidate::Candidate;
use super::covariance::inverse;
use super::every_effect::every_effect;
use super::exchange::{Criterion, choose};
use super::first_measurement::{LOADS, WARMTHS};
use super::imagined::{SECONDS_PER_POSE, shown};
use super::information::Information;
use super::needs::WARMING_C;
use super::path;
use super::rows::free;
use crate::diagnosis::NextPose;
use crate::effects::{Setting, Term};
use crate::kinematics::{Joint, JointKind, Range};
use crate::model::Model;

/// Sides of approach that are tried for each pose, and of many poses.
const SIDES: [usize; 2] = [4, 2];
const MANY: usize = 120;

/// How far before a pose the approach to it begins, rad or mm: 5° or 10 mm, within a quarter of the
/// range.
pub fn approach(joint: &Joint, range: Option<Range>) -> f64 {
    let usual = match joint.kind {
        JointKind::Revolute => joint.kind.to_base_units(5.0),
        JointKind::Prismatic => 10.0,
    };
    range.map_or(usual, |r| usual.min(0.25 * (r.to - r.from)))
}

/// The poses in measuring order, each with its conditions.
pub(crate) fn conditioned(arm: &Arm, poses: &[Candidate]) -> Vec<NextPose> {
    let varied = arm.load_kg.is_some() || arm.heats;
    let stretches = if poses.len() >= fewest::TO_SEARCH && varied {
        LOADS.len()
    } else {
        1
    };
    let mut slots = ConditionedPoses::new(arm, poses, stretches);
    let order = choose(&mut slots, poses.len());
    let robot = &arm.session.robot;
    let at_home = |range: &Range| 0.0_f64.clamp(range.from, range.to);
    let mut here: Vec<f64> = arm.ranges.iter().map(at_home).collect();
    let mut all: Vec<&Candidate> = Vec::new();
    for stretch in 0..stretches {
        let inside = order.iter().filter(|k| slots.place(**k).1 == stretch);
        let own: Vec<&Candidate> = inside.map(|k| &slots.candidates[*k]).collect();
        let places: Vec<&[f64]> = own.iter().map(|c| &c.q[..]).collect();
        let way = path::short(robot, &places, &here);
        all.extend(way.into_iter().map(|k| own[k]));
        if let Some(last) = all.last() {
            here.clone_from(&last.q);
        }
    }
    let (writing, why) = (arm.writing(true), text!("joint values that tell most"));
    let poses = all.into_iter().map(|c| writing.pose(c, why.clone()));
    poses.collect()
}

/// Poses under all conditions that are offered.
struct ConditionedPoses {
    /// Pose after pose from some sides, each in every stretch.
    candidates: Vec<Candidate>,
    information: Information,
    used: Vec<bool>,
    free_in_stretch: Vec<usize>,
}

impl ConditionedPoses {
    fn new(arm: &Arm, poses: &[Candidate], stretches: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(arm.seed ^ 0x51de);
        let mut candidates = Vec::new();
        let sides = SIDES[usize::from(poses.len() > MANY)];
        for own in poses {
            let mut dir = vec![1.0; own.q.len()];
            for side in 0..sides {
                for d in &mut dir {
                    // Every other one is the opposite of that before.
                    *d = match side % 2 {
                        1 => -*d,
                        _ if random.random::<bool>() => 1.0,
                        _ => -1.0,
                    };
                }
                let dir = possible(arm, &own.q, &dir);
                for s in 0..stretches {
                    let warmth = if arm.heats { WARMTHS[s] } else { 0.0 };
                    candidates.push(Candidate {
                        dir: dir.clone(),
                        load_kg: arm.load_kg.map_or(0.0, |kg| kg * LOADS[s]),
                        above_20_c: WARMING_C * warmth,
                        ..own.clone()
                    });
                }
            }
        }
        let n = poses.len();
        Self {
            information: information(arm, &candidates, [n, stretches]),
            used: vec![false; n],
            free_in_stretch: (0..stretches)
                .map(|s| (s + 1) * n / stretches - s * n / stretches)
                .collect(),
            candidates,
        }
    }

    /// Which pose a candidate is, and in which stretch.
    fn place(&self, candidate: usize) -> (usize, usize) {
        let of_pose = self.candidates.len() / self.used.len().max(1);
        (candidate / of_pose, candidate % self.free_in_stretch.len())
    }
}

/// Sides from which the approach begins within the limits.
fn possible(arm: &Arm, q: &[f64], dir: &[f64]) -> Vec<f64> {
    let joints = arm.session.robot.joints.iter().zip(&arm.ranges);
    let one = |((joint, range), (q, dir)): ((&Joint, &Range), (&f64, &f64))| {
        let from = q - dir * approach(joint, Some(*range));
        if from < range.from {
            -1.0
        } else if from > range.to {
            1.0
        } else {
            *dir
        }
    };
    joints.zip(q.iter().zip(dir)).map(one).collect()
}

impl Criterion for ConditionedPoses {
    fn worths(&self) -> Vec<f64> {
        let of = |k: usize| {
            let (pose, stretch) = self.place(k);
            let free = !self.used[pose] && self.free_in_stretch[stretch] > 0;
            // Where nothing more can be gained the pose is measured nevertheless.
            if free {
                self.information.gain(k).max(rounding::WRITTEN)
            } else {
                0.0
            }
        };
        (0..self.candidates.len()).map(of).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.information.take(candidate);
        let (pose, stretch) = self.place(candidate);
        self.used[pose] = true;
        self.free_in_stretch[stretch] -= 1;
    }
}

/// The information of the candidates on geometry and effects, added to what was measured.
fn information(arm: &Arm, candidates: &[Candidate], [poses, stretches]: [usize; 2]) -> Information {
    let mut whole = arm.with(candidates, true);
    let before = arm.session.samples.len();
    let mut middle_s = 0.0;
    if let Some(time_s) = &mut whole.samples.time_s {
        // Times are those of the stretches, not of so many candidates.
        let start = time_s.get(before).copied().unwrap_or(0.0);
        let each = SECONDS_PER_POSE * poses as f64;
        for (to, stretch) in time_s[before..].iter_mut().zip((0..stretches).cycle()) {
            *to = start + each * (stretch as f64 + 0.5) / stretches as f64;
        }
        middle_s = start + 0.5 * each;
    }
    let of_base = |t: &Term| arm.base.terms().iter().any(|b| b.same_column(t));
    let effects = every_effect(&arm.session.robot, &arm.ranges, middle_s);
    let effects = effects.terms().iter().filter(|t| {
        let about = t.effect.about();
        // How far the joints travel before a pose is not known yet.
        !about.role.is_of_every_calibration() && about.setting != Setting::Fade && !of_base(t)
    });
    let all = arm.base.terms().iter().chain(effects).cloned().collect();
    let model = Model::new(arm.session.robot.clone(), all);
    let (rows, prior) = shown(&whole, &model);
    let mut known = arm.prior_information(&model);
    let squares = rows.squares();
    let of_effects = free(&model).enumerate();
    for (to, _) in of_effects.filter(|(_, (_, term, _))| !of_base(term)) {
        let mean = squares[to] / rows.difference.len().max(1) as f64;
        known[(to, to)] = if mean > 0.0 {
            mean / (WIDEST * WIDEST)
        } else {
            1.0
        };
    }
    rows.add_to(&mut known, 0..before);
    Information::new(rows.from(before), inverse(&(known + prior)))
}
