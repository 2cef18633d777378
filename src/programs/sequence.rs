//! The circumstances of every target: load, temperature, speed, and the side from which each joint comes.
//!
//! A side that is not stated follows from the target before, in the order in which the file's motions
//! name them; a joint that does not move keeps its side. A target that is gone to from several sides
//! has none.

use std::borrow::Cow;

use crate::effects::Inputs;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::kinematics::Robot;

use super::answer::Left;
use super::resolve::Resolved;
use super::target::{Program, Remark};

/// A joint that moves less than this (rad or mm) does not move.
const STANDS: f64 = 1e-9;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sequence {
    targets: Vec<There>,
    /// What there is to say about targets.
    pub(super) remarks: Vec<Remark>,
}

/// The circumstances of one target, by joint where they are a joint's.
#[derive(Debug, Clone, PartialEq)]
struct There {
    dir: Vec<f64>,
    travel: Vec<f64>,
    speed: Vec<f64>,
    load_kg: f64,
    temperature_c: f64,
}

/// One visit of a target.
#[derive(Clone)]
struct Visit {
    q: Vec<f64>,
    dir: Vec<f64>,
    travel: Vec<f64>,
}

impl Sequence {
    /// The circumstances of a program's targets; `load_kg` where the file says none.
    pub(super) fn new(
        program: &Program,
        resolved: &[Result<Resolved, Left>],
        load_kg: f64,
    ) -> Self {
        let targets = &program.targets;
        let mut first: Vec<Option<Visit>> = vec![None; targets.len()];
        let mut remarks = Vec::new();
        let mut before: Option<Visit> = None;
        let mut visited = vec![false; targets.len()];
        for k in &program.visits {
            visited[*k] = true;
        }
        let others = (0..targets.len()).filter(|k| !visited[*k]);
        let order = program.visits.iter().copied().chain(others);
        for k in order {
            let Ok(resolved) = &resolved[k] else {
                // From where it is not known the next one is reached from an unknown side.
                before = None;
                continue;
            };
            // What no motion of the file names may come from anywhere.
            let from = before.as_ref().filter(|_| visited[k]);
            let stated = &targets[k].circumstances.dir;
            let visit = visit(&resolved.q, stated, from);
            match &mut first[k] {
                Some(known) => {
                    let mut several = false;
                    for (known, now) in known.dir.iter_mut().zip(&visit.dir) {
                        several |= *known != *now && *known != 0.0;
                        if *known != *now {
                            *known = 0.0;
                        }
                    }
                    if several {
                        let says = format!(
                            "{} is gone to from several sides; effects of the side are left out",
                            targets[k].name
                        );
                        let at = targets[k].at;
                        remarks.push(Remark { at, says });
                    }
                }
                none => *none = Some(visit.clone()),
            }
            before = Some(visit);
        }
        remarks.dedup();
        let there = |(k, first): (usize, Option<Visit>)| {
            let joints = resolved[k].as_ref().map_or(0, |r| r.q.len());
            let unknown = || (vec![0.0; joints], vec![f64::INFINITY; joints]);
            let (dir, travel) = first.map_or_else(unknown, |visit| (visit.dir, visit.travel));
            let stated = &targets[k].circumstances;
            let speed = |j: usize| stated.speed.get(j).copied().flatten().unwrap_or(0.0);
            There {
                dir,
                travel,
                speed: (0..joints).map(speed).collect(),
                load_kg: stated.load_kg.unwrap_or(load_kg),
                temperature_c: stated.temperature_c.unwrap_or(REFERENCE_TEMPERATURE_C),
            }
        };
        Self {
            targets: first.into_iter().enumerate().map(there).collect(),
            remarks,
        }
    }

    /// Side from which each joint comes to a target.
    pub(super) fn dir(&self, target: usize) -> Vec<f64> {
        self.targets[target].dir.clone()
    }

    /// Load at a target, kg.
    pub(super) fn load_kg(&self, target: usize) -> f64 {
        self.targets[target].load_kg
    }

    /// Some targets as a model takes them.
    pub(super) fn inputs(
        &self,
        targets: &[usize],
        resolved: &[&Resolved],
        robot: &Robot,
    ) -> Inputs<'static> {
        let joints = robot.joints.len();
        let column = |of: &dyn Fn(&There) -> f64| -> Vec<f64> {
            targets.iter().map(|k| of(&self.targets[*k])).collect()
        };
        let q = (0..joints).map(|j| resolved.iter().map(|r| r.q[j]).collect());
        let home = robot.base_from_tool.translation.vector.into();
        let mut inputs = Inputs::at_poses(q.collect(), vec![home]);
        for j in 0..joints {
            inputs.dir[j] = Some(Cow::Owned(column(&|there| there.dir[j])));
            inputs.speed[j] = Some(Cow::Owned(column(&|there| there.speed[j])));
            inputs.travel[j] = Some(column(&|there| there.travel[j]));
        }
        inputs.load_kg = Some(Cow::Owned(column(&|there| there.load_kg)));
        inputs.above_20_c = Some(column(&|there| {
            there.temperature_c - REFERENCE_TEMPERATURE_C
        }));
        inputs
    }
}

fn visit(q: &[f64], stated: &[Option<f64>], before: Option<&Visit>) -> Visit {
    let mut visit = Visit {
        q: q.to_vec(),
        dir: vec![0.0; q.len()],
        travel: vec![f64::INFINITY; q.len()],
    };
    for j in 0..q.len() {
        let way = before.map(|before| q[j] - before.q[j]);
        let followed = match way {
            Some(way) if way > STANDS => 1.0,
            Some(way) if way < -STANDS => -1.0,
            _ => before.map_or(0.0, |before| before.dir[j]),
        };
        visit.dir[j] = stated.get(j).copied().flatten().unwrap_or(followed);
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
