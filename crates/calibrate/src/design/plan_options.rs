//! The options of a plan.

use nalgebra::Point3;
use std::f64::consts::PI;

use crate::diagnosis::{DiagnoseError, Options};
use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::ranges::SMALLEST_SIGMA;
use crate::effects::{CATALOGUE, Effect};
use crate::kinematics::Robot;
use crate::text::Text;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER};

/// Poses that are proposed in addition to a session, and ways of measuring that are tried, at most.
pub(super) const PROPOSED: usize = 24;
/// Poses that shrink the intervals of a session, where nothing else is asked.
pub(super) const POSES_IN_ADDITION: usize = 20;
/// Poses of a first measurement of several joints, where no number is given, besides some for each joint.
pub(super) const POSES_OF_AN_ARM: usize = 40;
/// Poses that a plan holds at most.
pub(crate) const MOST_POSES: usize = 2000;

/// Joints of a robot for which poses are planned: the work grows with their square and more.
pub(crate) const MOST_JOINTS: usize = 30;

/// An effect, and its joint counted from 0.
pub(crate) type OnJoint = (&'static Effect, usize);

/// What the plan is to do.
#[derive(Debug, Clone, Default)]
pub struct PlanOptions {
    /// Number of poses; by default as many as are needed.
    pub poses: Option<usize>,
    /// Two effects to distinguish, as `ID` or `ID:JOINT`.
    pub separate: Option<[String; 2]>,
    /// Noise of the instrument, mm; for a session its own where it is not given.
    pub sigma_mm: Option<f64>,
    /// Heaviest load that the robot may carry for a test, kg.
    pub load_kg: Option<f64>,
    /// As many poses as bring the 95th percentile of the expected error over the joint ranges below
    /// this, mm.
    pub accuracy_mm: Option<f64>,
    /// The place of the instrument that measures a robot, base frame, mm.
    pub instrument_mm: Option<Point3<f64>>,
    /// A target is seen within this angle of where it faces, rad; by default from everywhere.
    pub cone_rad: Option<f64>,
    /// How a session is diagnosed.
    pub diagnosis: Options,
}

impl PlanOptions {
    /// Whether the options make sense for this robot, and a plan for it comes to an end.
    pub(crate) fn check(&self, robot: &Robot) -> Result<(), DiagnoseError> {
        let problem = self.problem();
        if let Some(text) = problem.or_else(|| self.not_for(robot)) {
            return Err(DiagnoseError::Option(text));
        }
        let is_place = |p: &Point3<f64>| p.iter().all(|x| x.abs() <= LARGEST_LENGTH_MM);
        let refused = |field: &'static str, found: Text, expected: Text| {
            let place = Place::default().in_field(field);
            let wrong = Diagnostic::error(place, found, expected);
            Err(Rejected::because(wrong).into())
        };
        if !self.instrument_mm.as_ref().is_none_or(is_place) {
            let found = text!("a position that is not finite or too large");
            let expected = text!("three lengths of at most 10 000 000 mm");
            return refused("instrument_mm", found, expected);
        }
        self.diagnosis.check()?;
        if robot.joints.is_empty() {
            return refused(
                "robot.joints",
                text!("no joints"),
                text!("at least one joint"),
            );
        }
        match robot.out_of_range(&Place::default()) {
            problems if problems.is_empty() => Ok(()),
            problems => Err(Rejected::of(problems).into()),
        }
    }

    /// A number that makes no sense.
    fn problem(&self) -> Option<Text> {
        let above_zero = |v: f64, most: f64| v > 0.0 && v <= most;
        let is_length = |v: f64| above_zero(v, LARGEST_LENGTH_MM);
        if let Some(accuracy) = self.accuracy_mm {
            if !is_length(accuracy) {
                return Some(text!(
                    "--accuracy is {accuracy}; expected a length above 0 in mm, such as 0.1",
                    accuracy
                ));
            }
            if self.poses.is_some() {
                return Some(text!(
                    "--poses and --accuracy both say how many poses there are; expected one of them"
                ));
            }
        }
        if let Some(cone) = self.cone_rad.filter(|cone| !above_zero(*cone, PI)) {
            return Some(text!(
                "--cone is {cone}; expected an angle above 0 and up to 180 degrees, such as 60",
                // The user wrote degrees: what the conversion adds is not theirs.
                cone = (cone.to_degrees() * 1e9).round() / 1e9
            ));
        }
        if let Some(poses) = self.poses.filter(|n| *n == 0 || *n > MOST_POSES) {
            return Some(text!(
                "--poses is {poses}; expected a whole number from 1 to {most}",
                poses,
                most = MOST_POSES
            ));
        }
        let is_sigma = |s: f64| is_length(s) && s >= SMALLEST_SIGMA;
        if let Some(sigma) = self.sigma_mm.filter(|s| !is_sigma(*s)) {
            return Some(text!(
                "--sigma is {sigma}; expected a length above 0 in mm, such as 0.03",
                sigma
            ));
        }
        let is_load = |l: f64| above_zero(l, LARGEST_NUMBER);
        let load = self.load_kg.filter(|l| !is_load(*l))?;
        Some(text!(
            "--load is {load}; expected a mass above 0 in kg, such as 3",
            load
        ))
    }

    /// A request that does not exist for this robot.
    fn not_for(&self, robot: &Robot) -> Option<Text> {
        let joints = robot.joints.len();
        if joints > MOST_JOINTS {
            return Some(text!(
                "a robot with {joints} joints; poses are planned for at most {most}",
                joints,
                most = MOST_JOINTS
            ));
        }
        let arm = joints > 1;
        let option = if self.accuracy_mm.is_some() && !(arm && self.separate.is_none()) {
            "--accuracy"
        } else if !arm && (self.instrument_mm.is_some() || self.cone_rad.is_some()) {
            "--instrument or --cone"
        } else {
            return None;
        };
        Some(text!(
            "{option} is for robots with several joints, measured without --separate; this plan has neither",
            option
        ))
    }

    /// The two effects, found in the catalogue.
    pub(crate) fn between(&self, robot: &Robot) -> Result<Option<[OnJoint; 2]>, DiagnoseError> {
        let joints = robot.joints.len();
        let Some([one, other]) = &self.separate else {
            return Ok(None);
        };
        let named = |given: &String| -> Result<OnJoint, DiagnoseError> {
            let (id, joint) = given.split_once(':').unwrap_or((given, "1"));
            let mut catalogue = CATALOGUE.iter().copied();
            let effect = catalogue
                .find(|effect| effect.about().id == id)
                .ok_or_else(|| DiagnoseError::UnknownEffect(id.to_owned()))?;
            let number = joint.parse::<usize>().ok();
            let joint = number.filter(|j| (1..=joints).contains(j)).ok_or_else(|| {
                DiagnoseError::Option(text!(
                    "--separate {given}: expected an effect, or an effect and a joint from 1 to {joints} such as backlash:1",
                    given,
                    joints
                ))
            })?;
            Ok((effect, joint - 1))
        };
        let two = [named(one)?, named(other)?];
        let [first, second] = two.map(|(effect, joint)| (effect.about().id, joint));
        if first == second {
            return Err(DiagnoseError::Option(text!(
                "--separate {one},{other}: expected two different effects",
                one,
                other = one
            )));
        }
        Ok(Some(two))
    }
}
