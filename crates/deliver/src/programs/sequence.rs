//! The circumstances of every target: load, temperature, speed, and the side from which each joint comes.
//!
//! A side that is not stated follows from the target before, in the order in which the file's motions
//! name them; a joint that does not move keeps its side. A target that is gone to from several sides
//! has none.

use std::borrow::Cow;

use crate::effects::Inputs;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::kinematics::Robot;

use super::answer::SkippedTarget;
use super::convention::Convention;
use super::program::Program;
use super::resolve::Resolved;
use super::target::{Remark, Target};

/// A joint that moves less than this (rad or mm) does not move.
const STANDS: f64 = 1e-9;

/// Load, temperature, speed and approach of every target. Joint by joint for each target, one target after the other.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sequence<'m> {
    joints: usize,
    convention: Convention<'m>,
    /// +1, −1, 0 unknown.
    dir: Vec<i8>,
    /// Since the last reversal, rad or mm.
    travel: Vec<f64>,
    /// Where the file says none, kg.
    load_kg: f64,
    /// What there is to say about targets.
    pub(super) remarks: Vec<Remark>,
}

/// One visit of a target.
struct Visit {
    q: Vec<f64>,
    dir: Vec<i8>,
    travel: Vec<f64>,
}

impl<'m> Sequence<'m> {
    /// The circumstances of a program's targets; `load_kg` where the file says none.
    pub(super) fn new(
        program: &Program,
        resolved: &[Result<Resolved, SkippedTarget>],
        joints: usize,
        convention: Convention<'m>,
        load_kg: f64,
    ) -> Self {
        let targets = &program.targets;
        let mut sequence = Self {
            joints,
            convention,
            dir: vec![0; joints * targets.len()],
            travel: vec![f64::INFINITY; joints * targets.len()],
            load_kg,
            remarks: Vec::new(),
        };
        let mut known = vec![false; targets.len()];
        let mut before: Option<Visit> = None;
        let mut visited = vec![false; targets.len()];
        for k in &program.visits {
            visited[*k] = true;
        }
        let others = (0..targets.len()).filter(|k| !visited[*k]);
        for k in program.visits.iter().copied().chain(others) {
            let Ok(resolved) = &resolved[k] else {
                // From where it is not known the next one is reached from an unknown side.
                before = None;
                continue;
            };
            // What no motion of the file names may come from anywhere.
            let from = before.as_ref().filter(|_| visited[k]);
            let visit = sequence.visit(&resolved.q, &targets[k], from);
            let own = k * joints..(k + 1) * joints;
            if known[k] {
                let mut several = false;
                for (known, now) in sequence.dir[own].iter_mut().zip(&visit.dir) {
                    several |= *known != *now && *known != 0;
                    if *known != *now {
                        *known = 0;
                    }
                }
                if several {
                    let says = text!(
                        "{targets} is approached from several sides; effects of the side are excluded",
                        targets = &targets[k].name
                    );
                    let at = targets[k].at;
                    sequence.remarks.push(Remark { at, text: says });
                }
            } else {
                known[k] = true;
                sequence.dir[own.clone()].copy_from_slice(&visit.dir);
                sequence.travel[own].copy_from_slice(&visit.travel);
            }
            before = Some(visit);
        }
        sequence.remarks.dedup();
        sequence
    }

    /// Side from which each joint comes to a target.
    pub(super) fn dir(&self, target: usize) -> Vec<i8> {
        self.dir[target * self.joints..(target + 1) * self.joints].to_vec()
    }

    /// Load at a target, kg.
    pub(super) fn load_kg(&self, target: &Target) -> f64 {
        target.circumstances().load_kg.unwrap_or(self.load_kg)
    }

    /// Some targets as a model takes them.
    pub(super) fn inputs(
        &self,
        targets: &[Target],
        indices: &[usize],
        q: Vec<Vec<f64>>,
        robot: &Robot,
    ) -> Inputs<'static> {
        let column =
            |of: &dyn Fn(usize) -> f64| -> Vec<f64> { indices.iter().map(|k| of(*k)).collect() };
        let home = robot.base_from_tool.translation.vector.into();
        let mut inputs = Inputs::at_poses(q, vec![home]);
        for j in 0..self.joints {
            let at = |k: usize| k * self.joints + j;
            let speed = |k: usize| {
                let speed = targets[k].circumstances().speed.get(j);
                speed.copied().flatten().unwrap_or(0.0)
            };
            inputs.dir[j] = Some(Cow::Owned(column(&|k| f64::from(self.dir[at(k)]))));
            inputs.speed[j] = Some(Cow::Owned(column(&speed)));
            inputs.travel[j] = Some(column(&|k| self.travel[at(k)]));
        }
        inputs.load_kg = Some(Cow::Owned(column(&|k| self.load_kg(&targets[k]))));
        inputs.above_20_c = Some(column(&|k| {
            let stated = targets[k].circumstances().temperature_c;
            stated.unwrap_or(REFERENCE_TEMPERATURE_C) - REFERENCE_TEMPERATURE_C
        }));
        inputs
    }

    fn visit(&self, q: &[f64], target: &Target, before: Option<&Visit>) -> Visit {
        let mut stated = target.circumstances().dir.clone();
        self.convention.sides_to_model(&mut stated);
        let mut visit = Visit {
            q: q.to_vec(),
            dir: vec![0; q.len()],
            travel: vec![f64::INFINITY; q.len()],
        };
        for j in 0..q.len() {
            let way = before.map(|before| q[j] - before.q[j]);
            let followed = match way {
                Some(way) if way > STANDS => 1,
                Some(way) if way < -STANDS => -1,
                _ => before.map_or(0, |before| before.dir[j]),
            };
            let stated = stated.get(j).copied().flatten();
            visit.dir[j] = match stated {
                Some(side) if side > 0.0 => 1,
                Some(side) if side < 0.0 => -1,
                _ => followed,
            };
            if let (Some(way), Some(before)) = (way, before) {
                visit.travel[j] = if visit.dir[j] == before.dir[j] {
                    before.travel[j] + way.abs()
                } else {
                    way.abs()
                };
            }
        }
        visit
    }
}
