//! `LeRobot`'s calibration of the motors of a hobby arm, with the zero offsets in it, and a URDF that
//! agrees with it.
//!
//! ```text
//! Feetech:    present = actual − homing_offset
//! Dynamixel:  present = actual + homing_offset        4096 ticks a turn, at most ±2047
//! degrees = (present − (range_min + range_max)/2) · 360/4095
//! ```
//!
//! A joint that stands `offset` beyond its command is to show as much more: the homing offset takes
//! the whole ticks of it, the middle of the range (where `LeRobot` has its zero) stays where it is.
//! What is left below half a tick is in the origins of the URDF beside the calibration, so that
//! every part of an offset is in one of the two and none in both. A URDF of the same arm for another
//! motor calibration is another one: two users' zeros are never the same.
//!
//! Source: `src/lerobot/motors/motors_bus.py`, `feetech.py` and `dynamixel.py` of `LeRobot`.

mod calibration;

use calibration::{Motor, TICKS_PER_TURN, read_calibration};

use super::chain::{Chain, differences_over_range, rms};
use super::description::{Written, finish};
use super::names::Names;
use super::options::{Asked, Motors, Zeros};
use super::urdf;
use super::{Export, ExportError, Exporter, Format, Job};
use crate::compensation::Compensation;
use crate::kinematics::{Joint, JointKind, Robot};
use crate::text::Text;
use crate::text::length;

pub use calibration::lerobot_calibration;

pub(super) const FORMAT: Format = Format {
    id: "lerobot",
    title: phrase!("LeRobot motor calibration and URDF"),
    extension: "json",
    rules: None,
    suits: all_turn,
    exporter: &LeRobot,
};

struct LeRobot;

/// What a servo's register holds: a sign and eleven bits.
const MOST_TICKS: i64 = 2047;

fn all_turn(robot: &Robot) -> bool {
    let turns = |joint: &Joint| joint.kind == JointKind::Revolute;
    robot.joints.len() > 1 && robot.joints.iter().all(turns)
}

impl Exporter for LeRobot {
    fn asks(&self, _robot: &Robot) -> Asked {
        Asked {
            zeros: Some(Zeros::Controller),
            motors: true,
            reference: true,
            ..Asked::default()
        }
    }

    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let nominal = &job.calibration.model.robot;
        let slides = |joint: &&Joint| joint.kind == JointKind::Prismatic;
        if let Some(joint) = nominal.joints.iter().find(slides) {
            return Err(ExportError::Refused(text!(
                "joint '{joint}' slides, and the servos of LeRobot turn; use urdf",
                joint = &joint.name
            )));
        }
        let (mut motors, mut notes) = present(job)?;
        let places = motors_of_joints(&motors, nominal)?;
        let zeros = job.options.zeros.unwrap_or(Zeros::Controller);
        let tick = std::f64::consts::TAU / TICKS_PER_TURN as f64;
        let chain = Chain::taking(job, zeros, |offsets| {
            Ok(offsets
                .iter()
                .map(|offset| match zeros {
                    Zeros::Controller => (offset / tick).round() * tick + 0.0,
                    Zeros::Origins => 0.0,
                })
                .collect())
        })?;
        let mut moved = Vec::new();
        for (taken, place) in chain.taken.iter().zip(&places) {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "offsets of a joint are within a turn: whole numbers below 4096"
            )]
            let ticks = (taken / tick).round() as i64;
            move_zero(&mut motors[*place], ticks, job.options.motors)?;
            if ticks != 0 {
                moved.push(format!("{} by {ticks:+}", motors[*place].name));
            }
        }
        if !moved.is_empty() {
            notes.push(text!(
                "the motors show more than before, in ticks: {motors}; their ranges move by as much with it: keep away from the stops until you have tried it",
                motors = moved.join(", ")
            ));
        }
        let all = Compensation::new(job.calibration).robot;
        let alone = rms(&differences_over_range(
            job,
            &all,
            &nominal.rehomed(&chain.taken),
        ));
        notes.push(text!(
            "the calibration by itself, with the nominal URDF, leaves {left} over the measured range (level: zeros)",
            left = length(alone, 4)
        ));
        let names = Names::new(&chain.robot);
        let text = urdf::write(job, &chain, &names);
        let robot = urdf::read(&text, &names)?;
        chain.check(job, &robot)?;
        notes.extend(names.notes());
        let calibration = calibration::write(&motors);
        if read_calibration(calibration.as_bytes(), "written")
            .map_err(|error| ExportError::ReadBack(error.to_string()))?
            != motors
        {
            return Err(ExportError::ReadBack("the calibration".to_owned()));
        }
        let written = Written {
            companions: vec![(".urdf", text)],
            units: "ticks, 4096 a turn; the URDF in metres and radians",
            sign: match job.options.motors {
                Motors::Feetech => {
                    phrase!(
                        "Feetech: present = actual − homing_offset; a joint that stands beyond its command gets a smaller homing_offset"
                    )
                }
                Motors::Dynamixel => {
                    phrase!(
                        "Dynamixel: present = actual + homing_offset; a joint that stands beyond its command gets a larger homing_offset"
                    )
                }
            },
            ends: Some(names.ends()),
            in_the_controller: vec![text!(
                "the calibration by itself carries the zeros; the URDF beside it carries the rest and agrees with this motor calibration only"
            )],
            zeros: Some(match zeros {
                Zeros::Controller => {
                    text!(
                        "the zero offsets are in homing_offset of this calibration, in whole ticks, and the rest of them in the URDF beside it: nothing else is to take them"
                    )
                }
                Zeros::Origins => {
                    text!(
                        "the zero offsets are in the URDF beside this calibration, which is as it was"
                    )
                }
            }),
            notes,
            ..Written::of(FORMAT.id, calibration, robot)
        };
        finish(job, &chain, written)
    }
}

/// The calibration that was active while measuring.
fn present(job: &Job) -> Result<(Vec<Motor>, Vec<Text>), ExportError> {
    if let Some(reference) = job.options.reference {
        let motors = read_calibration(reference.bytes, reference.name)
            .map_err(|rejected| ExportError::Refused(rejected.describe()))?;
        return Ok((motors, Vec::new()));
    }
    let joints = job.calibration.model.robot.joints.iter().enumerate();
    let motor = |(k, joint): (usize, &Joint)| Motor {
        name: joint.name.clone(),
        id: i64::try_from(k + 1).unwrap_or(i64::MAX),
        drive_mode: 0,
        homing_offset: 0,
        range_min: 0,
        range_max: TICKS_PER_TURN - 1,
    };
    let says = text!(
        "no calibration was given: the homing offsets count from 0, and ids and ranges are placeholders; give the one that was active while measuring with --reference"
    );
    Ok((joints.map(motor).collect(), vec![says]))
}

/// Which motor drives which joint: by name, else by id.
fn motors_of_joints(motors: &[Motor], robot: &Robot) -> Result<Vec<usize>, ExportError> {
    let of = |joint: &Joint| {
        let by_name = motors.iter().position(|motor| motor.name == joint.name);
        let id = joint.name.parse::<i64>().ok();
        by_name.or_else(|| motors.iter().position(|motor| Some(motor.id) == id))
    };
    let places = robot.joints.iter().map(|joint| {
        of(joint).ok_or_else(|| {
            let known: Vec<&str> = motors.iter().map(|motor| motor.name.as_str()).collect();
            ExportError::Refused(text!(
                "no motor is called '{joint}' in the calibration, which has {motors}; name the joints of the robot as its motors",
                joint = &joint.name,
                motors = known.join(", ")
            ))
        })
    });
    places.collect()
}

/// Makes a motor show this many ticks more.
fn move_zero(motor: &mut Motor, ticks: i64, motors: Motors) -> Result<(), ExportError> {
    motor.homing_offset += match motors {
        Motors::Feetech => -ticks,
        Motors::Dynamixel => ticks,
    };
    if motor.homing_offset.abs() <= MOST_TICKS {
        return Ok(());
    }
    Err(ExportError::Refused(text!(
        "{motor}: a homing_offset of {offset} does not fit into the servo, which takes ±{most}; remount its horn so that the joint's zero is nearer the middle of the encoder, calibrate the motors again, and measure again",
        motor = &motor.name,
        offset = motor.homing_offset,
        most = MOST_TICKS
    )))
}
