//! The corrected commands of targets: those that bring the real tool where the nominal robot would have
//! put it, in the same configuration, within the limits, under the load that is stated. Position and
//! orientation are met where the joints allow both, else the position. External axes stay where they are.
//!
//! A target that is singular, beyond the limits, or would change its configuration is left, and named.

use std::borrow::Cow;

use crate::compensation::Compensation;
use crate::compensation::pose::{Reached, commands_for_poses, tool_poses};
use crate::effects::Inputs;
use crate::kinematics::{Pose, Robot};

use super::answer::{Left, Reason, Written};
use super::axes::Axes;
use super::compensate::{Request, measured_frame};
use super::configuration::leaves_its_sides;
use super::resolve::{Resolved, beyond_a_limit};
use super::sequence::Sequence;
use super::target::{Program, Target};

/// More than this of a position or an orientation is not reached, mm and rad.
const REACHED: [f64; 2] = [1e-4, 1e-7];
/// The corrected commands of every target that could be resolved.
pub(super) fn corrected(
    request: &Request,
    program: &Program,
    axes: &Axes,
    conditions: &Sequence,
    results: &[Result<Resolved, Left>],
) -> Vec<Result<Written, Left>> {
    let robot = &request.calibration.model.robot;
    let mut compensation = Compensation::new(request.calibration);
    let frame = measured_frame(request.calibration).filter(|_| request.measured_frame);
    if let Some(frame) = frame {
        compensation.robot = compensation.robot.with_term(frame.clone());
    }
    let good: Vec<usize> = (0..results.len()).filter(|k| results[*k].is_ok()).collect();
    let all: Vec<&Resolved> = results.iter().flatten().collect();
    let inputs = conditions.inputs(&good, &all, robot);
    let wanted: Vec<Pose> = all.iter().map(|r| r.pose).collect();
    let reached = reached(&compensation, &inputs, &wanted, axes);
    let before = if compensation.regional.is_some() {
        wanted.clone()
    } else {
        tool_poses(&compensation.robot, &inputs)
    };
    let mut answers: Vec<Option<Result<Written, Left>>> = results
        .iter()
        .map(|r| r.as_ref().err().cloned().map(Err))
        .collect();
    for (i, k) in good.iter().copied().enumerate() {
        let commanded = all[i].q.clone();
        let checked = check(robot, &program.targets[k], &commanded, &reached[i], axes);
        answers[k] = Some(checked.map(|()| Written {
            commanded,
            corrected: reached[i].q.clone(),
            dir: conditions.dir(k),
            load_kg: conditions.load_kg(k),
            position_mm: [
                (before[i].translation.vector - wanted[i].translation.vector).norm(),
                reached[i].position_mm,
            ],
            rotation_rad: [
                before[i].rotation.angle_to(&wanted[i].rotation),
                reached[i].rotation_rad,
            ],
        }));
    }
    answers.into_iter().flatten().collect()
}

/// By the model, or by the paper's method.
fn reached(
    compensation: &Compensation,
    inputs: &Inputs,
    wanted: &[Pose],
    axes: &Axes,
) -> Vec<Reached> {
    if compensation.regional.is_none() {
        return commands_for_poses(&compensation.robot, inputs, wanted, &axes.free());
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
        })
        .collect()
}

/// Whether corrected commands may be written.
fn check(
    robot: &Robot,
    target: &Target,
    commanded: &[f64],
    reached: &Reached,
    axes: &Axes,
) -> Result<(), Left> {
    if reached.singular {
        let says = "it is singular: a small correction would take a large move of the joints";
        return Err(Left::new(Reason::Singular, says));
    }
    if !reached.settled {
        let says = "no correction was found that settles: it is near a singular pose";
        return Err(Left::new(Reason::Singular, says));
    }
    if let Some(says) = beyond_a_limit(robot, &reached.q) {
        return Err(Left::new(
            Reason::Unreachable,
            format!("{says} with its correction"),
        ));
    }
    let whole = axes.free().len() >= 6 && robot.mobility() == 6;
    if whole && (reached.position_mm > REACHED[0] || reached.rotation_rad > REACHED[1]) {
        let says = format!(
            "the real tool does not reach it: {:.4} mm and {:.4} mrad are left",
            reached.position_mm,
            1e3 * reached.rotation_rad
        );
        return Err(Left::new(Reason::Unreachable, says));
    }
    if leaves_its_sides(target, robot, commanded, &reached.q) {
        let says = "its correction would lead into another configuration";
        return Err(Left::new(Reason::Singular, says));
    }
    Ok(())
}
