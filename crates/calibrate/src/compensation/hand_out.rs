//! The gate: what leaves the program is made from a [`VerifiedCalibration`], and only this module makes one, of a
//! calibration whose error on the very session that it came from is the one that was stated.

use std::ops::Deref;
use std::path::Path;

use crate::diagnostic::Rejected;
use crate::effects::Inputs;
use crate::model::{Calibration, ResidualStep, format_v1};
use crate::numeric::median;
use crate::sessions::Session;
use crate::text::Text;
use crate::text::length;
use crate::thresholds::NOTHING_MM;
use crate::{fewest, rounding, thresholds};

use super::verification::{Verification, VerifyError};
use super::verify::verify;

/// It may be so many times the nominal robot's: where the robot is as it was drawn, a fit that weighs the
/// coordinates unlike each other gains nothing and loses this much at most.
const MOST_TIMES_NOMINAL: f64 = 1.05;

/// Why a calibration is not handed out.
#[derive(Debug, Clone, PartialEq)]
pub enum NotHandedOut {
    /// Its error is not the one that was stated.
    OtherThanSaid {
        /// Verified, mm.
        found_mm: f64,
        /// Stated, mm.
        said_mm: f64,
    },
    /// The robot is better without it.
    WorseThanNominal {
        /// Verified, mm.
        found_mm: f64,
        /// Of the nominal robot, mm.
        nominal_mm: f64,
    },
    /// Samples that it has not seen are farther from it than from the nominal robot.
    MissesHeldOut {
        /// Median deviation of them from the model, mm.
        found_mm: f64,
        /// From the nominal robot, mm.
        nominal_mm: f64,
    },
    /// An effect that was added to it made it worse.
    WorseThanIdentified {
        /// Stated, mm.
        said_mm: f64,
        /// Of the identification, mm.
        identified_mm: f64,
    },
    /// It predicts nothing somewhere.
    PredictsNothing(Vec<f64>),
    /// It is of another robot.
    Verify(VerifyError),
}

impl NotHandedOut {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::OtherThanSaid { found_mm, said_mm } => text!(
                "on the session that it came from the model leaves an RMS error of {found_mm}, and its file states {said_mm}: it is not written",
                found_mm = length(found_mm, 6),
                said_mm = length(said_mm, 6)
            ),
            Self::WorseThanNominal {
                found_mm,
                nominal_mm,
            } => text!(
                "on the session that it came from the model leaves an RMS error of {found_mm}, and the nominal robot {nominal_mm}: it is not written",
                found_mm = length(found_mm, 6),
                nominal_mm = length(nominal_mm, 6)
            ),
            Self::MissesHeldOut {
                found_mm,
                nominal_mm,
            } => text!(
                "half of the held-out samples are {found_mm} off with the model and more, and {nominal_mm} with the nominal robot: it is not written; measure more of the joint ranges",
                found_mm = length(found_mm, 6),
                nominal_mm = length(nominal_mm, 6)
            ),
            Self::WorseThanIdentified {
                said_mm,
                identified_mm,
            } => text!(
                "the model leaves an RMS error of {said_mm}, and the identification that it began with {identified_mm}: it is not written",
                said_mm = length(said_mm, 6),
                identified_mm = length(identified_mm, 6)
            ),
            Self::PredictsNothing(given) => text!(
                "the model predicts no position at joint values {values} (rad, mm): it is not written",
                values = format!("{:?}", given)
            ),
            Self::Verify(inner) => inner.describe(),
        }
    }
}

displays_what_it_says!(NotHandedOut);

impl std::error::Error for NotHandedOut {}

impl From<VerifyError> for NotHandedOut {
    fn from(error: VerifyError) -> Self {
        Self::Verify(error)
    }
}

/// A calibration that was verified on its own session, or read from the file of one that was. Files of models,
/// tables, corrected programs, descriptions of robots and reports are made from it and from nothing else. It can
/// be read like the [`Calibration`] that it is and not be changed.
#[derive(Debug, Clone, PartialEq)]
pub struct VerifiedCalibration(Calibration);

impl Deref for VerifiedCalibration {
    type Target = Calibration;

    fn deref(&self) -> &Calibration {
        &self.0
    }
}

impl VerifiedCalibration {
    /// A calibration, verified on the raw session that it came from.
    ///
    /// # Errors
    /// See [`NotHandedOut`].
    pub fn on(calibration: &Calibration, session: &Session) -> Result<Self, NotHandedOut> {
        let session = &*session.whole().map_err(VerifyError::from)?;
        let fits = calibration.with_its_own_covariance();
        calibration.sound().and(fits).map_err(VerifyError::from)?;
        predicts_everywhere(calibration)?;
        // The paper's method speaks of the plane of motion and of its regions.
        if calibration.regions.is_empty() {
            no_worse_than_identified(&calibration.history)?;
            as_said_and_no_worse_than_nominal(calibration, session)?;
        }
        let verified = Self(calibration.clone());
        // What its file would not be read for is no model.
        Self::read(&verified.document()).map_err(VerifyError::from)?;
        Ok(verified)
    }

    /// The calibration of a model file in memory, which [`document`](Self::document) made once.
    ///
    /// # Errors
    /// Everything in it that is no model.
    pub fn read(text: &str) -> Result<Self, Rejected> {
        format_v1::read_model(text).map(Self)
    }

    /// The calibration of a model file.
    ///
    /// # Errors
    /// Everything in it that is no model.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Rejected> {
        format_v1::load_model(path).map(Self)
    }

    /// The text of its model file.
    pub fn document(&self) -> String {
        truepose_model::write_model(&self.0)
    }
}

/// That what was found beyond the identification makes it no worse, on its samples and cross-validated.
fn no_worse_than_identified(history: &[ResidualStep]) -> Result<(), NotHandedOut> {
    let [_, identified, .., last] = history else {
        return Ok(());
    };
    let pairs = [
        (Some(identified.gap_mm), Some(last.gap_mm)),
        (identified.held_out_mm, last.held_out_mm),
    ];
    for (identified_mm, said_mm) in pairs {
        if let (Some(identified_mm), Some(said_mm)) = (identified_mm, said_mm)
            && said_mm > identified_mm * (1.0 + rounding::COMPUTED) + rounding::COMPUTED
        {
            return Err(NotHandedOut::WorseThanIdentified {
                said_mm,
                identified_mm,
            });
        }
    }
    Ok(())
}

fn as_said_and_no_worse_than_nominal(
    calibration: &Calibration,
    session: &Session,
) -> Result<(), NotHandedOut> {
    // NaN is not within.
    let within = |found_mm: f64, most_mm: f64| found_mm <= most_mm + NOTHING_MM;
    let verified = verify(calibration, session)?;
    // Both without the suspected outliers, which make any model and the nominal robot look alike.
    let trimmed = verified.trimmed.map(|t| [t.nominal_mm, t.model_mm]);
    let whole = [verified.nominal.rms_mm, verified.model.rms_mm];
    let [nominal_mm, found_mm] = trimmed.unwrap_or(whole);
    let said_mm = calibration.history.last().map(|step| step.gap_mm);
    if let Some(said_mm) = said_mm
        && !within(found_mm, thresholds::WITHIN * said_mm)
    {
        return Err(NotHandedOut::OtherThanSaid { found_mm, said_mm });
    }
    if !within(found_mm, MOST_TIMES_NOMINAL * nominal_mm) {
        return Err(NotHandedOut::WorseThanNominal {
            found_mm,
            nominal_mm,
        });
    }
    predicts_what_is_held_out(&verified, session)
}

/// That what the session holds out is no farther from the model than from the nominal robot: few poses close to each
/// other show little of a robot, and a model that follows them may lead far off elsewhere. Half of them may be gross
/// errors.
fn predicts_what_is_held_out(
    verified: &Verification,
    session: &Session,
) -> Result<(), NotHandedOut> {
    let Some(held_out) = session.samples.held_out.as_deref() else {
        return Ok(());
    };
    let median_mm = |lengths_mm: &[f64]| {
        let apart = lengths_mm.iter().zip(held_out).filter(|own| *own.1);
        // Not every measurement has a length.
        let apart = apart.map(|own| *own.0).filter(|mm| mm.is_finite());
        (apart.clone().count() >= fewest::TO_JUDGE).then(|| median(apart))?
    };
    let nominal_mm = median_mm(&verified.before.length_mm);
    let found_mm = median_mm(&verified.after.length_mm);
    match (found_mm, nominal_mm) {
        (Some(found_mm), Some(nominal_mm))
            if found_mm > thresholds::WITHIN * nominal_mm + NOTHING_MM =>
        {
            Err(NotHandedOut::MissesHeldOut {
                found_mm,
                nominal_mm,
            })
        }
        _ => Ok(()),
    }
}

/// That positions are finite at both ends of every joint's range, and at home.
fn predicts_everywhere(calibration: &Calibration) -> Result<(), NotHandedOut> {
    let robot = &calibration.model.robot;
    let range = |joint: usize| {
        let measured = calibration.measured.get(joint).copied();
        let range = robot.joints[joint].limits.or(measured);
        range.map_or([0.0; 3], |range| [range.from, 0.0, range.to])
    };
    let q = (0..robot.joints.len()).map(|joint| range(joint).to_vec());
    let tool: [f64; 3] = robot.base_from_tool.translation.vector.into();
    let mut inputs = Inputs::at_poses(q.collect(), vec![tool]);
    inputs.setup = Some(vec![0.0; 3]);
    let predicted = calibration.model.predict(&inputs);
    for pose in 0..3 {
        if !predicted.get(pose).iter().all(|v| v.is_finite()) {
            let q = inputs.q.iter().map(|q| q[pose]).collect();
            return Err(NotHandedOut::PredictsNothing(q));
        }
    }
    Ok(())
}
