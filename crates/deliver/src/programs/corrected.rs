//! The corrected commands of targets: those that bring the real tool where the nominal robot would have
//! put it, in the same configuration, within the limits, under the load that is stated. The position is met,
//! the orientation as far as the joints allow without large moves. External axes stay where they are.
//!
//! Where a correction would take a joint beyond its limit, or over the border of the configuration, that joint
//! is held and the others bring the tool to its position. A target whose position cannot be corrected is left,
//! and named.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::compensation::Compensation;
use crate::compensation::pose::{Reached, Tools, commands_for_poses, directions, tool_poses};
use crate::effects::Inputs;
use crate::fit::expected::uncertainties_mm;
use crate::fit::unseen::nothing_held;
use crate::kinematics::configuration::Statement;
use crate::kinematics::{JointKind, Pose, Robot};
use crate::model::Calibration;
use crate::text::{length, small_angle};

use super::answer::{Reason, SkippedTarget, Written};
use super::axes::Axes;
use super::configuration::leaves_its_sides;
use super::program::Program;
use super::request::{Request, measured_frame};
use super::resolve::{Resolved, first_beyond};
use super::sequence::Sequence;
use super::target::Target;

/// More than this of a position or an orientation is not reached, mm and rad.
const REACHED: [f64; 2] = [1e-4, 1e-7];
/// So many targets go through at once.
const AT_ONCE: usize = 1024;

/// What corrects targets.
pub(super) struct Corrector<'a> {
    robot: &'a Robot,
    compensation: Compensation,
    free: Vec<usize>,
    conditions: &'a Sequence<'a>,
    targets: &'a [Target],
    tools: Vec<Pose>,
    tool_of: Vec<u32>,
    /// Whether the free joints can bring the tool to any position around it.
    positions: bool,
    /// Whether they can turn it there in any way.
    whole: bool,
    calibration: &'a Calibration,
    /// How far the nominal robot was off where it was measured, RMS, mm.
    nominal_mm: f64,
}

/// The corrected commands of every target that could be resolved.
pub(super) fn corrected(
    request: &Request,
    program: &Program,
    axes: &Axes,
    conditions: &Sequence,
    results: Vec<Result<Resolved, SkippedTarget>>,
) -> Vec<Result<Written, SkippedTarget>> {
    let robot = &request.calibration.model.robot;
    let mut compensation = Compensation::new(request.calibration);
    let frame = measured_frame(request.calibration).filter(|_| request.measured_frame);
    if let Some(frame) = frame {
        compensation.robot = compensation.robot.with_term(frame.clone());
    }
    let (tools, tool_of) = tools(robot, program);
    let free = axes.free();
    let nominal = request.calibration.history.first();
    let corrector = Corrector {
        robot,
        calibration: request.calibration,
        nominal_mm: nominal.map_or(f64::INFINITY, |nominal| nominal.gap_mm),
        compensation,
        positions: directions(robot, &free) == 3,
        whole: free.len() >= 6 && robot.mobility() == 6,
        free,
        conditions,
        targets: &program.targets,
        tools,
        tool_of,
    };
    let mut answers = Vec::with_capacity(results.len());
    let mut block = Vec::with_capacity(AT_ONCE);
    let mut first = 0;
    let mut results = results.into_iter();
    loop {
        block.extend(results.by_ref().take(AT_ONCE));
        if block.is_empty() {
            return answers;
        }
        let count = block.len();
        answers.extend(corrector.block(first, std::mem::take(&mut block)));
        first += count;
    }
}

/// The tools of a program at home, and which of them each target is of.
fn tools(robot: &Robot, program: &Program) -> (Vec<Pose>, Vec<u32>) {
    let mut known: BTreeMap<[u64; 7], u32> = BTreeMap::new();
    let mut tools = Vec::new();
    let of = program.targets.iter().map(|target| {
        let model_from_tool = target.placed.get().tool_from_model.inverse();
        let (at, turn) = (model_from_tool.translation.vector, model_from_tool.rotation);
        let key = [at.x, at.y, at.z, turn.w, turn.i, turn.j, turn.k].map(f64::to_bits);
        *known.entry(key).or_insert_with(|| {
            tools.push(robot.base_from_tool * model_from_tool);
            u32::try_from(tools.len() - 1).unwrap_or(0)
        })
    });
    let of = of.collect();
    (tools, of)
}

impl Corrector<'_> {
    /// The targets from `first` on.
    fn block(
        &self,
        first: usize,
        results: Vec<Result<Resolved, SkippedTarget>>,
    ) -> Vec<Result<Written, SkippedTarget>> {
        let good: Vec<usize> = (0..results.len()).filter(|k| results[*k].is_ok()).collect();
        let indices: Vec<usize> = good.iter().map(|k| first + k).collect();
        let all: Vec<&Resolved> = results.iter().flatten().collect();
        let joints = self.robot.joints.len();
        let q = (0..joints).map(|j| all.iter().map(|r| r.q[j]).collect());
        let inputs = self.inputs(&indices, q.collect());
        let tools = self.tools_of(&indices);
        let wanted = all.iter().zip(&indices).map(|(r, k)| {
            let model_from_tool = self.targets[*k].placed.get().tool_from_model.inverse();
            r.pose * model_from_tool
        });
        let wanted: Vec<Pose> = wanted.collect();
        let mut reached = self.reached(&inputs, &wanted, &tools);
        self.hold_joints(&indices, &all, &wanted, &mut reached);
        let before = if self.compensation.regional.is_some() {
            wanted.clone()
        } else {
            tool_poses(&self.compensation.robot, &inputs, &tools)
        };
        let unsure_mm = self.unsure_mm(&inputs);
        let mut reached = reached.into_iter().zip(before).zip(wanted).zip(unsure_mm);
        let answer = |(k, result): (usize, Result<Resolved, SkippedTarget>)| {
            let resolved = result?;
            let k = first + k;
            let next = reached.next();
            let (((reached, before), wanted), unsure_mm) = next.ok_or_else(|| {
                SkippedTarget::new(
                    Reason::Unreachable,
                    text!("no corrected commands were found"),
                )
            })?;
            let turned_before_rad = before.rotation.angle_to(&wanted.rotation);
            self.check(&self.targets[k], &resolved.q, &reached, turned_before_rad)?;
            if unsure_mm > self.nominal_mm {
                return Err(SkippedTarget::new(
                    Reason::Unseen,
                    text!(
                        "the measured poses show too little of it: there the model may be off by {unsure}, and the nominal robot was off by {nominal} where it was measured; measure near it",
                        unsure = length(unsure_mm, 3),
                        nominal = length(self.nominal_mm, 3)
                    ),
                ));
            }
            Ok(Written {
                commanded: resolved.q,
                corrected: reached.q,
                dir: self.conditions.dir(k),
                load_kg: self.conditions.load_kg(&self.targets[k]),
                position_mm: [
                    (before.translation.vector - wanted.translation.vector).norm(),
                    reached.position_mm,
                ],
                rotation_rad: [turned_before_rad, reached.rotation_rad],
            })
        };
        results.into_iter().enumerate().map(answer).collect()
    }

    /// One standard uncertainty of where the model says that each pose is, mm; zero where it has none.
    fn unsure_mm(&self, inputs: &Inputs) -> Vec<f64> {
        let model = nothing_held(&self.calibration.model);
        let covariance = self.calibration.covariance.as_ref();
        let of_model = covariance.and_then(|c| uncertainties_mm(&model, inputs, c));
        of_model.unwrap_or_else(|| vec![0.0; inputs.len()])
    }

    fn inputs(&self, indices: &[usize], q: Vec<Vec<f64>>) -> Inputs<'static> {
        self.conditions.inputs(self.targets, indices, q, self.robot)
    }

    fn tools_of(&self, indices: &[usize]) -> Tools {
        Tools {
            base_from_tool: self.tools.clone(),
            of_pose: indices.iter().map(|k| self.tool_of[*k]).collect(),
        }
    }

    /// By the model, or by the paper's method.
    fn reached(&self, inputs: &Inputs, wanted: &[Pose], tools: &Tools) -> Vec<Reached> {
        let compensation = &self.compensation;
        if compensation.regional.is_none() {
            return commands_for_poses(&compensation.robot, inputs, wanted, &self.free, tools);
        }
        let corrections = compensation.joint_corrections(inputs);
        let mut corrected = inputs.clone();
        for (q, by) in corrected.q.iter_mut().zip(&corrections) {
            for (q, by) in q.to_mut().iter_mut().zip(by) {
                *q += by;
            }
        }
        let left = crate::compensation::remainder::left_over(compensation, inputs);
        left.iter()
            .enumerate()
            .map(|(i, left)| Reached {
                q: corrected.q.iter().map(|q: &Cow<[f64]>| q[i]).collect(),
                position_mm: crate::lanes::dot(*left, *left).sqrt(),
                rotation_rad: 0.0,
                singular: false,
                settled: true,
                damped: false,
            })
            .collect()
    }

    /// Targets of which one joint would go too far are corrected by the others, that joint held.
    fn hold_joints(
        &self,
        indices: &[usize],
        resolved: &[&Resolved],
        wanted: &[Pose],
        reached: &mut [Reached],
    ) {
        if self.compensation.regional.is_some() || !self.positions {
            return;
        }
        // Which joint of which target is held at what.
        let mut held: BTreeMap<usize, Vec<(usize, f64)>> = BTreeMap::new();
        for (i, reached) in reached.iter().enumerate() {
            if !reached.settled {
                continue;
            }
            let target = &self.targets[indices[i]];
            let from = &resolved[i].q;
            let beyond = first_beyond(self.robot, &reached.q);
            let too_far = beyond.map(|b| (b.joint, b.limit)).or_else(|| {
                let joint = self.crosses(target, from, &reached.q)?;
                Some((joint, from[joint]))
            });
            if let Some((joint, value)) = too_far.filter(|(joint, _)| self.free.contains(joint)) {
                held.entry(joint).or_default().push((i, value));
            }
        }
        for (joint, cases) in held {
            let free: Vec<usize> = self.free.iter().copied().filter(|j| *j != joint).collect();
            let own: Vec<usize> = cases.iter().map(|(i, _)| indices[*i]).collect();
            let column = |j: usize| -> Vec<f64> {
                let value = |(i, value): &(usize, f64)| {
                    if j == joint {
                        *value
                    } else {
                        resolved[*i].q[j]
                    }
                };
                cases.iter().map(value).collect()
            };
            let inputs = self.inputs(&own, (0..self.robot.joints.len()).map(column).collect());
            let goals: Vec<Pose> = cases.iter().map(|(i, _)| wanted[*i]).collect();
            let robot = &self.compensation.robot;
            let again = commands_for_poses(robot, &inputs, &goals, &free, &self.tools_of(&own));
            for ((i, _), again) in cases.iter().zip(again) {
                if again.settled && again.position_mm <= REACHED[0] {
                    reached[*i] = Reached {
                        damped: true,
                        ..again
                    };
                }
            }
        }
    }

    /// The joint whose sign the target states and the correction changes.
    fn crosses(&self, target: &Target, from: &[f64], to: &[f64]) -> Option<usize> {
        if !leaves_its_sides(target, self.robot, from, to) {
            return None;
        }
        target
            .posture()
            .configuration
            .iter()
            .find_map(|statement| match statement {
                Statement::WristNegative { joint, .. } => Some(usize::from(*joint)).filter(|_| {
                    statement.agrees(self.robot, from) == Some(true)
                        && statement.agrees(self.robot, to) == Some(false)
                }),
                _ => None,
            })
    }

    /// Whether corrected commands may be written.
    fn check(
        &self,
        target: &Target,
        commanded: &[f64],
        reached: &Reached,
        turned_before_rad: f64,
    ) -> Result<(), SkippedTarget> {
        let robot = self.robot;
        if reached.singular {
            let says = text!(
                "its position is singular: a small correction would take a large move of the joints"
            );
            return Err(SkippedTarget::new(Reason::Singular, says));
        }
        if !reached.settled {
            let says = text!(
                "no correction of its position was found that settles: it is at the end of the reach"
            );
            return Err(SkippedTarget::new(Reason::Singular, says));
        }
        if let Some(beyond) = first_beyond(robot, &reached.q) {
            let [value, limit] = beyond.shown(robot);
            let says = text!(
                "with its correction joint {joint} would be at {value}, beyond its limit of {limit}",
                joint = beyond.joint + 1,
                value,
                limit
            );
            return Err(SkippedTarget::new(Reason::Unreachable, says));
        }
        let off = reached.position_mm > REACHED[0] && self.positions;
        let turned = self.whole && reached.rotation_rad > REACHED[1] && !reached.damped;
        if off || turned {
            let says = text!(
                "the real tool does not reach it: {position_mm} and {rotation_rad} are left",
                position_mm = length(reached.position_mm, 4),
                rotation_rad = small_angle(reached.rotation_rad, 4)
            );
            return Err(SkippedTarget::new(Reason::Unreachable, says));
        }
        if self.whole && reached.rotation_rad > turned_before_rad + MOST_TURNED {
            let says = text!(
                "its position is nearly singular: the correction would turn the tool by {rotation_rad}",
                rotation_rad = small_angle(reached.rotation_rad, 1)
            );
            return Err(SkippedTarget::new(Reason::Singular, says));
        }
        if leaves_its_sides(target, robot, commanded, &reached.q) {
            let says = text!("its correction would lead into another configuration");
            return Err(SkippedTarget::new(Reason::Singular, says));
        }
        let jump = robot.joints.iter().zip(commanded.iter().zip(&reached.q));
        let turned_over = jump
            .filter(|(joint, _)| joint.kind == JointKind::Revolute)
            .any(|(_, (from, to))| (to - from).abs() > MOST_TURN);
        if turned_over {
            let says = text!("its correction would turn a joint by more than a quarter turn");
            return Err(SkippedTarget::new(Reason::Singular, says));
        }
        Ok(())
    }
}

/// An orientation is given up for a position by no more than this, rad.
const MOST_TURNED: f64 = 0.02;
/// A correction that turns a joint further than this (rad) leads into another configuration.
const MOST_TURN: f64 = std::f64::consts::FRAC_PI_2;
