//! The targets of a file, corrected in place.
//!
//! It is read, every target gets its frame, its tool and the joint values that it means, and its corrected
//! commands ([`super::corrected`]); the numbers of those are written, and what was written is read back
//! before it is given out. Everything else keeps its bytes.

use std::collections::BTreeMap;

use nalgebra::{Rotation3, Vector3};

use crate::effects::Term;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::kinematics::{Axis, Joint, Robot};
use crate::text::Text as Sentence;

use super::answer::{Answer, Outcome, Reason, SkippedTarget, Written};
use super::axes::Axes;
use super::convention::Convention;
use super::corrected::corrected;
use super::program::Program;
use super::program_frames::Reading;
use super::request::{Beside, CompensateError, Request, measured_frame};
use super::resolve::{Resolved, Resolver, left};
use super::settle::settled;
use super::target::{Remark, Shape, Target};
use super::text::Text;
use super::{frames, rewrite, sequence};

/// What is read back may differ from what was meant by rounding of numbers, mm and rad, per number.
const ROUNDING: f64 = 1e-3;

/// Corrects the targets of a file.
///
/// # Errors
/// See [`CompensateError`].
pub fn compensate(request: &Request) -> Result<Answer, CompensateError> {
    let joined = Joined::of(request);
    if joined.files.is_empty() {
        return of_whole(request, usize::MAX);
    }
    let whole = Request {
        bytes: &joined.bytes,
        ..request.clone()
    };
    let mut answer = match of_whole(&whole, request.bytes.len()) {
        Ok(answer) => answer,
        Err(CompensateError::Rejected(mut rejected)) => {
            let places = rejected.diagnostics.iter().map(|one| one.place.line);
            let others = places.filter_map(|line| joined.file_of(line?));
            if let Some(foreign) = others.map(|(file, _)| *file).find(|file| !file.named) {
                // What is wrong with a file that merely lies there is none of this one's.
                let mut fewer = request.clone();
                fewer.beside.retain(|file| file.path != foreign.path);
                return compensate(&fewer);
            }
            for one in &mut rejected.diagnostics {
                if let Some((file, above)) = one.place.line.and_then(|line| joined.file_of(line)) {
                    one.place.line = one.place.line.map(|line| line - above);
                    one.place.file = Some(file.path.to_path_buf());
                }
            }
            return Err(CompensateError::Rejected(rejected));
        }
        Err(CompensateError::Differs(mut differences)) => {
            for one in &mut differences.0 {
                if let Some((file, above)) = joined.file_of(one.place.0) {
                    one.place.0 -= above;
                    one.name = format!("{} ({})", one.name, file.path.display());
                }
            }
            return Err(CompensateError::Differs(differences));
        }
        Err(other) => return Err(other),
    };
    answer
        .bytes
        .truncate(answer.bytes.len() - (joined.bytes.len() - request.bytes.len()));
    answer
        .targets
        .retain(|target| joined.is_own(target.place.0));
    for remarks in [&mut answer.at_run_time, &mut answer.remarks] {
        remarks.retain(|(line, ..)| joined.is_own(*line));
    }
    for (file, _) in &joined.files {
        answer.notes.push(text!(
            "{file} is read with it: what is set and gone to there holds; its own targets are corrected where it is given itself",
            file = file.path.display().to_string()
        ));
    }
    Ok(answer)
}

/// A file and those that are read with it, one after the other.
struct Joined<'r> {
    bytes: Vec<u8>,
    /// Each with the lines above it.
    files: Vec<(Beside<'r>, u64)>,
}

impl<'r> Joined<'r> {
    fn of(request: &Request<'r>) -> Self {
        let mut joined = Self {
            bytes: request.bytes.to_vec(),
            files: Vec::new(),
        };
        let mut above = Text::new(request.bytes).lines().len() as u64;
        for file in &request.beside {
            let bytes = &file.bytes[Text::new(file.bytes).start()..];
            joined.bytes.push(b'\n');
            joined.bytes.extend_from_slice(bytes);
            joined.files.push((*file, above));
            above += Text::new(bytes).lines().len() as u64;
        }
        joined
    }

    /// The file read with it in which a line is, and the lines above that file.
    fn file_of(&self, line: u64) -> Option<(&Beside<'r>, u64)> {
        let found = self.files.iter().rfind(|(_, above)| line > *above)?;
        Some((&found.0, found.1))
    }

    fn is_own(&self, line: u64) -> bool {
        self.file_of(line).is_none()
    }
}

/// The same for a file of which only so many bytes are to be corrected.
fn of_whole(request: &Request, own: usize) -> Result<Answer, CompensateError> {
    let calibration = request.calibration;
    calibration.may_correct()?;
    let robot = &calibration.model.robot;
    if let Some(start) = &request.start
        && start.len() != robot.joints.len()
    {
        return Err(CompensateError::Refused(text!(
            "{found} joint values to start from; expected {expected}, one for each joint of the model",
            found = start.len(),
            expected = robot.joints.len()
        )));
    }
    if let Some(option) = request.no_number() {
        return Err(CompensateError::Refused(text!(
            "{option}: expected finite numbers within a robot's range",
            option
        )));
    }
    if request.measured_frame && measured_frame(calibration).is_none() {
        return Err(CompensateError::Refused(text!(
            "the model knows no measuring frame that was brought into the robot's base: --measured-frame has no meaning for it"
        )));
    }
    let axes = Axes::new(robot);
    let mut program = request.language.read(request.bytes, &axes, request.file)?;
    let reading = settled(&program, &Text::new(request.bytes), request)?;
    frames::place(&mut program, &reading);
    let convention = Convention::of(calibration);
    let results = resolved(request, &program, &axes, convention);
    let mut conditions = sequence::Sequence::new(
        &program,
        &results,
        robot.joints.len(),
        convention,
        reading.load_kg,
    );
    let mut corrected = corrected(request, &program, &axes, &conditions, results);
    for (target, result) in program.targets.iter().zip(&mut corrected) {
        if target.at >= own {
            *result = left(Reason::Unused, Sentence::default());
        }
    }
    let bytes = written(request, &program, robot, convention, &corrected);
    let text = Text::new(request.bytes);
    let placed = |remarks: Vec<Remark>| {
        let remarks = remarks.into_iter().map(|remark| {
            let (line, column) = text.place(remark.at);
            (line, column, remark.text)
        });
        let mut remarks: Vec<_> = remarks.collect();
        remarks.sort();
        remarks
    };
    let notes = notes(request, &reading, &program);
    let mut remarks = placed(std::mem::take(&mut program.notes));
    remarks.extend(placed(std::mem::take(&mut conditions.remarks)));
    let at_run_time = placed(std::mem::take(&mut program.at_run_time));
    drop(conditions);
    // What was read is not needed any more: a large file is not held twice.
    let mut left = BTreeMap::new();
    let heads = program.targets.into_iter().zip(&corrected).enumerate();
    let heads = heads.map(|(k, (target, result))| {
        if result.is_err() {
            left.insert(k, target.shape.values());
        }
        let is_pose = matches!(target.shape, Shape::Pose(_));
        (target.name, text.place(target.at), is_pose)
    });
    let heads: Vec<(String, (u64, u64), bool)> = heads.collect();
    let targets = heads.into_iter().zip(corrected);
    let targets = targets.map(|((name, place, is_pose), result)| Outcome {
        name,
        place,
        is_pose,
        result,
    });
    let targets: Vec<Outcome> = targets.collect();
    read_back(
        request,
        &reading,
        &axes,
        convention,
        (&targets, &left),
        &bytes,
    )?;
    let targets = targets.into_iter().map(|mut target| {
        if let Ok(written) = &mut target.result {
            // What is said of a target is in the values of the file.
            convention.to_raw(&mut written.commanded);
            convention.to_raw(&mut written.corrected);
        }
        target
    });
    let targets = targets.collect();
    Ok(Answer {
        bytes,
        targets,
        at_run_time,
        remarks,
        notes,
    })
}

/// The joint values that every target means, in the order of the file.
fn resolved(
    request: &Request,
    program: &Program,
    axes: &Axes,
    convention: Convention<'_>,
) -> Vec<Result<Resolved, SkippedTarget>> {
    let robot = &request.calibration.model.robot;
    let mut resolver = Resolver::new(robot, axes, convention, request.start.clone());
    let nothing = |_| left(Reason::Ambiguous, Sentence::default());
    let mut results: Vec<_> = (0..program.targets.len()).map(nothing).collect();
    for k in program.order() {
        results[k] = resolver.resolve(&program.targets[k]);
    }
    results
}

/// What a measuring frame's place and turn move, taken from the drawing: at the tool, and of the first axis along
/// itself, mm.
fn of_drawing(frame: &Term, robot: &Robot) -> [f64; 2] {
    let c = &frame.coefficients;
    let turn = Rotation3::new(Vector3::from_column_slice(&c[..3]));
    let shift = Vector3::from_column_slice(&c[3..6]);
    let moved = |p: Vector3<f64>| turn * p + shift - p;
    let along = |axis: &Axis| moved(axis.point_mm.coords).dot(&axis.direction).abs();
    let first = robot.joints.first();
    [
        moved(robot.base_from_tool.translation.vector).norm(),
        first.map_or(0.0, |joint| along(&joint.axis)),
    ]
}

fn written(
    request: &Request,
    program: &Program,
    robot: &Robot,
    convention: Convention<'_>,
    corrected: &[Result<Written, SkippedTarget>],
) -> Vec<u8> {
    let mut order: Vec<usize> = (0..corrected.len()).collect();
    order.sort_by_key(|k| program.targets[*k].at);
    let edits = order.into_iter().filter_map(|k| {
        let written = corrected[k].as_ref().ok()?;
        let target = &program.targets[k];
        Some(rewrite::edits(
            target,
            robot,
            convention,
            &written.corrected,
        ))
    });
    rewrite::applied(request.bytes, edits)
}

/// Reads what was written, and compares it with what was meant.
fn read_back(
    request: &Request,
    reading: &Reading,
    axes: &Axes,
    convention: Convention<'_>,
    (targets, left): (&[Outcome], &BTreeMap<usize, Vec<f64>>),
    bytes: &[u8],
) -> Result<(), CompensateError> {
    let robot = &request.calibration.model.robot;
    let wrong = |what: String| Err(CompensateError::ReadBack(what));
    let mut again = match request.language.read(bytes, axes, request.file) {
        Ok(again) => again,
        Err(error) => return wrong(error.to_string()),
    };
    frames::place(&mut again, reading);
    if again.targets.len() != targets.len() {
        return wrong(format!("{} targets", again.targets.len()));
    }
    for (k, (target, outcome)) in again.targets.iter().zip(targets).enumerate() {
        let Ok(written) = &outcome.result else {
            if left.get(&k) != Some(&target.shape.values()) {
                return wrong(format!("{} was to be left", target.name));
            }
            continue;
        };
        let off = match &target.shape {
            Shape::Joints {
                numbers,
                scales: inner,
                ..
            } => {
                let mut raw = written.corrected.clone();
                convention.to_raw(&mut raw);
                let values = numbers.iter().zip(inner.iter()).zip(&raw);
                let off = values.map(|((number, inner), q)| (number.value * inner - q).abs());
                off.fold(0.0, f64::max)
            }
            Shape::Pose(frame) => {
                let meant = robot.base_from_tool(&written.corrected);
                let Some(goal) = frame.goal().map(|goal| target.placed.goal(&goal)) else {
                    return wrong(format!("{} has no orientation", target.name));
                };
                let way = (goal.position_mm.coords - meant.translation.vector).norm();
                let turn = goal.rotation.map_or(0.0, |r| r.angle_to(&meant.rotation));
                way.max(turn)
            }
        };
        if off > ROUNDING {
            return wrong(format!("{} by {off:.6}", target.name));
        }
    }
    Ok(())
}

/// Whether joints 2 and 3 of the model are parallel, and neither counts with the other.
fn counts_the_third_joint_itself(request: &Request) -> bool {
    let joints = &request.calibration.model.robot.joints;
    let parallel = |a: &Joint, b: &Joint| a.axis.direction.dot(&b.axis.direction).abs() > 0.99;
    let [_, two, three, ..] = &joints[..] else {
        return false;
    };
    parallel(two, three) && !request.calibration.set_up.moves_joints()
}

/// What was assumed, in words.
fn notes(request: &Request, reading: &Reading, program: &Program) -> Vec<Sentence> {
    let mut notes = reading.notes.clone();
    let set_up = &request.calibration.set_up;
    if set_up.moves_joints() {
        notes.push(text!(
            "joint values are read and written as the model's session has them: {conventions}",
            conventions = set_up.describe()
        ));
    }
    let poses = program
        .targets
        .iter()
        .any(|t| matches!(t.shape, Shape::Pose(_)));
    if poses {
        notes.push(if reading.stated.is_none() {
            text!(
                "poses for which the file declares no frame are read in the robot's base frame; the tool of the controller has to be the model's where the file has one tool only"
            )
        } else {
            text!(
                "poses for which the file declares no frame are read in the frame that was stated; the tool of the controller has to be the model's where the file has one tool only"
            )
        });
    }
    let joints = program.targets.iter().any(|target| !target.is_pose());
    if joints && request.language.id == "fanuc-ls" && counts_the_third_joint_itself(request) {
        notes.push(text!(
            "joint values are read as the model counts them: J3 of many FANUC arms is counted from the horizontal (J2 + J3), and then has to be in the model's session as well"
        ));
    }
    let world = program.base_from_world.translation.vector;
    if poses && world.norm() > ROUNDING {
        let [x, y, z] = [world.x, world.y, world.z].map(|mm| (mm * 1e3).round() / 1e3);
        notes.push(text!(
            "poses and user frames are in the world of the controller, which begins on axis 1 at the height of axis 2: X {x}, Y {y}, Z {z} mm in the robot's base",
            x,
            y,
            z
        ));
    }
    if let Some(frame) = measured_frame(request.calibration) {
        notes.push(if request.measured_frame {
            text!("the robot's base is the frame in which the session was measured")
        } else {
            let [at_tool, along] = of_drawing(frame, &request.calibration.model.robot);
            let length = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
            text!(
                "the robot's base is where its first axis is; the measuring frame stands {far} and {turned} from it. \
                 The samples do not tell where the axis stands from where the frame does: {at_tool} at the tool, \
                 {along} of it along that axis, are taken from the nominal model",
                far = format!("{:.3} mm", length(&frame.coefficients[3..])),
                turned = format!("{:.3} mrad", 1e3 * length(&frame.coefficients[..3])),
                at_tool = format!("{at_tool:.3} mm"),
                along = format!("{along:.3} mm"),
            )
        });
    }
    let unstated = |t: &Target| t.circumstances().load_kg.is_none();
    if program.targets.iter().any(unstated) {
        notes.push(text!(
            "targets without a load are corrected for {load} kg",
            load = reading.load_kg
        ));
    }
    let cold = |t: &Target| t.circumstances().temperature_c.is_none();
    let terms = request.calibration.model.terms().iter();
    let mut warm = terms.filter(|t| t.effect.about().over == crate::effects::Over::Temperature);
    if program.targets.iter().any(cold) && warm.next().is_some() {
        notes.push(text!(
            "targets without a temperature are corrected for {temperature} °C",
            temperature = REFERENCE_TEMPERATURE_C
        ));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::MEASURING_FRAME;
    use crate::sessions::parse_robot;

    #[test]
    fn what_is_taken_from_the_drawing_is_told_along_the_first_axis_and_at_the_tool() {
        let robot = br#"{"name":"r","joints":[
            {"name":"a","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]},
            {"name":"b","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,300]}],
            "tool":{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}"#;
        let robot = parse_robot(robot).expect("sound").robot;
        let mut frame = Term::absent(&MEASURING_FRAME, 0, 0.0);
        frame.coefficients = vec![0.0, 0.0, 0.0, 0.4, 0.0, 0.3];
        let [at_tool, along] = of_drawing(&frame, &robot);
        assert!((along - 0.3).abs() < 1e-12 && (at_tool - 0.5).abs() < 1e-12);
        // A turn about the first axis moves the tool and not the axis.
        frame.coefficients = vec![0.0, 0.0, 1e-3, 0.0, 0.0, 0.0];
        let [at_tool, along] = of_drawing(&frame, &robot);
        assert!(along < 1e-12 && (at_tool - 0.4).abs() < 1e-6);
    }
}
