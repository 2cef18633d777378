//! A calibration: the model that came out of a session, how sure it is, and how it came about.

use nalgebra::DMatrix;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::kinematics::Range;
use crate::sessions::{Region, Target};
use crate::text::Text;
use crate::units::LARGEST_NUMBER;

use super::{Model, SetUp};

/// The paper's correction for one region: what to add, not what the robot does.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RegionalCorrection {
    /// The region's name.
    pub name: String,
    /// Lower end, rad.
    pub from_rad: f64,
    /// Upper end, rad.
    pub to_rad: f64,
    /// Number of samples it rests on.
    pub samples: usize,
    /// Δθ: to be added to the joint command, rad.
    pub theta_rad: f64,
    /// Δl1: to be added to the position along the radius at home, mm.
    pub l1_mm: f64,
}

impl RegionalCorrection {
    /// The region that it holds in.
    pub fn region(&self) -> Region {
        Region {
            name: self.name.clone(),
            from_rad: self.from_rad,
            to_rad: self.to_rad,
        }
    }
}

/// One step of the way from the nominal robot to the model.
#[derive(Debug, Clone, PartialEq)]
pub struct ResidualStep {
    /// What was done.
    pub what: String,
    /// The RMS error after it, mm.
    pub gap_mm: f64,
    /// The RMS error on samples that no fit has seen, mm.
    pub held_out_mm: Option<f64>,
    /// The RMS error on runs that no fit has seen, at values of the joint that it has seen, mm; where there are
    /// several runs.
    pub runs_held_out_mm: Option<f64>,
    /// The RMS error at values of the only joint that no fit has seen, mm; where their neighbours do not predict them.
    pub values_held_out_mm: Option<f64>,
}

/// The conditions that a session covered; `None` where it does not state them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Conditions {
    /// Loads at the tool's origin, kg.
    pub load_kg: Option<Range>,
    /// Temperatures, °C.
    pub temperature_c: Option<Range>,
}

/// A model with its covariance, its history and the hash of the samples that it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// Name of the session.
    pub session: String,
    /// Robot and effects.
    pub model: Model,
    /// Covariance of the model's coefficients, in inner units; `None` where there is none.
    pub covariance: Option<DMatrix<f64>>,
    /// The paper's corrections; empty for an exact model.
    pub regions: Vec<RegionalCorrection>,
    /// Reflectors of the session.
    pub targets: Vec<Target>,
    /// Those of them that samples show, counted from 0; `None`: all.
    pub measured_targets: Option<Vec<usize>>,
    /// Range of every joint in the measured samples, rad or mm.
    pub measured: Vec<Range>,
    /// For every joint the step in which it was measured, rad or mm; 0 where steps were uneven. `None`: of no joint
    /// they were equal.
    pub measured_steps: Option<Vec<f64>>,
    /// Least and largest load of the measured samples, kg; `None`: the session does not state it.
    pub load_kg: Option<[f64; 2]>,
    /// Tolerance of the session, mm.
    pub tolerance_mm: Option<f64>,
    /// Hash of the model whose table was active while the session was measured. Such a calibration contains the
    /// residual, and no table is made from it: it would lack what the active one does.
    pub compensated_by: Option<String>,
    /// Corrections of the session's set-up: the conventions of the controller and the instrument. Everything
    /// else here is as it is after them.
    pub set_up: SetUp,
    /// Conditions of the measured samples.
    pub conditions: Conditions,
    /// Samples of the session, counted from 0, that the fit set aside as suspected outliers; `None` where that
    /// is not known.
    pub set_aside: Option<Vec<usize>>,
    /// The RMS error, step by step; the first is the nominal robot's.
    pub history: Vec<ResidualStep>,
    /// Hash of the samples that it came from.
    pub samples_hash: String,
    /// Version of the program that made it.
    pub program_version: String,
}

impl Calibration {
    /// Where the targets that were measured are at home, base frame, mm.
    #[doc(hidden)]
    pub fn measured_places(&self) -> Vec<[f64; 3]> {
        let tool = self.model.robot.base_from_tool;
        let is_measured = |k: usize| {
            let measured = self.measured_targets.as_ref();
            measured.is_none_or(|measured| measured.contains(&k))
        };
        let targets = self.targets.iter().enumerate();
        let measured = targets.filter(|(k, _)| is_measured(*k));
        measured
            .map(|(_, target)| (tool * target.position_mm).coords.into())
            .collect()
    }

    /// What has to hold before anything is computed with it: one that was identified or read holds it, one that
    /// a caller filled in may not.
    ///
    /// # Errors
    /// [`Rejected`] with everything that no robot has.
    #[doc(hidden)]
    pub fn sound(&self) -> Result<(), Rejected> {
        let robot = &self.model.robot;
        let joints = robot.joints.len();
        let mut findings = robot.out_of_range(&Place::default());
        let mut wrong = |field: &str, found: Text, expected: Text| {
            let place = Place::default().in_field(field);
            findings.push(Diagnostic::error(place, found, expected));
        };
        if joints == 0 {
            let expected = text!("at least one joint");
            wrong("robot.joints", text!("no joints"), expected);
        }
        for term in self.model.terms() {
            let about = term.effect.about();
            let field = format!("effects.{}", about.id);
            if term.joint >= joints {
                let joint = term.joint.saturating_add(1);
                wrong(
                    &field,
                    text!("joint {joint}", joint),
                    text!("a joint from 1 to {joints}", joints),
                );
            }
            let (found, expected) = (term.coefficients.len(), about.form.coefficients());
            if found != expected {
                wrong(
                    &field,
                    text!(one "{count} coefficient", "{count} coefficients", count = found),
                    Text::verbatim(expected.to_string()),
                );
            }
            let mut numbers = term.coefficients.iter().chain([&term.setting]);
            if !numbers.all(|value| value.is_finite()) {
                let found = text!("a number that is not finite");
                wrong(
                    &field,
                    found,
                    text!("finite coefficients and a finite setting"),
                );
            }
        }
        if self.measured.len() > joints {
            let found = text!(one "{count} range", "{count} ranges", count = self.measured.len());
            wrong(
                "measured",
                found,
                text!("at most {joints}, one for each joint", joints),
            );
        }
        let is_value = |value: f64| value.abs() <= LARGEST_NUMBER;
        let is_range = |range: &Range| is_value(range.from) && is_value(range.to);
        if !self.measured.iter().all(is_range) {
            let found = text!("a range that is not finite or too large");
            wrong(
                "measured",
                found,
                text!("joint values within a robot's range"),
            );
        }
        let is_place = |target: &Target| target.position_mm.iter().all(|x| x.is_finite());
        if !self.targets.iter().all(is_place) {
            let expected = text!("three finite lengths in mm");
            wrong("targets", text!("a position that is not finite"), expected);
        }
        if findings.is_empty() {
            Ok(())
        } else {
            Err(Rejected::of(findings))
        }
    }

    /// What else has to hold before it is handed out: its covariance is that of its coefficients.
    ///
    /// # Errors
    /// [`Rejected`] where it is another model's.
    #[doc(hidden)]
    pub fn with_its_own_covariance(&self) -> Result<(), Rejected> {
        let coefficients = self.model.coefficient_count();
        let (rows, columns) = match &self.covariance {
            Some(covariance) => covariance.shape(),
            None => return Ok(()),
        };
        if (rows, columns) == (coefficients, coefficients) {
            return Ok(());
        }
        let place = Place::default().in_field("covariance");
        let found = text!("{rows} by {columns} numbers", rows, columns);
        let expected = text!(
            "{coefficients} by {coefficients}, as many as coefficients",
            coefficients
        );
        Err(Rejected::because(Diagnostic::error(place, found, expected)))
    }
}
