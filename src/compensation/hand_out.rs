//! The gate: a model leaves the program as a document that this function makes, and it makes none of a model
//! that is not what was said of it on the very session that it came from.

use crate::effects::Inputs;
use crate::model::{Calibration, write_model};
use crate::sessions::Session;

use super::verification::{VerifyError, verify};

/// The error on its own session may be so many times what was said: suspected outliers, and samples that lack
/// a condition, are judged in one place and not in the other. A convention that is lost is far beyond.
const MOST_TIMES: f64 = 2.0;
/// Below this nothing is said, mm.
const NOTHING_MM: f64 = 1e-3;
/// With more samples a part of them tells as much.
const MOST_SAMPLES: usize = 20_000;

/// Why a model is not handed out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotHandedOut {
    /// It does something else than was said.
    #[error(
        "on the session that it came from the model leaves an RMS error of {found_mm:.6} mm, and {said_mm:.6} mm \
         was said: it is not written"
    )]
    OtherThanSaid {
        /// Verified, mm.
        found_mm: f64,
        /// Said, mm.
        said_mm: f64,
    },
    /// It predicts nothing somewhere.
    #[error("the model predicts no position at joint values {0:?} (rad, mm): it is not written")]
    PredictsNothing(Vec<f64>),
    /// It is of another robot.
    #[error(transparent)]
    Verify(#[from] VerifyError),
}

/// The document of a model, from the raw session that it came from.
///
/// # Errors
/// See [`NotHandedOut`].
pub fn hand_out(calibration: &Calibration, session: &Session) -> Result<String, NotHandedOut> {
    predicts_everywhere(calibration)?;
    let said_mm = calibration.history.last().map(|step| step.gap_mm);
    // The paper's method speaks of the plane of motion and of its regions.
    if let Some(said_mm) = said_mm.filter(|_| calibration.regions.is_empty())
        && session.samples.len() <= MOST_SAMPLES
    {
        let verified = verify(calibration, session)?;
        let trimmed = verified.trimmed.map(|trimmed| trimmed.model_mm);
        let found_mm = trimmed.unwrap_or(verified.model.rms_mm);
        if found_mm > MOST_TIMES * said_mm + NOTHING_MM {
            return Err(NotHandedOut::OtherThanSaid { found_mm, said_mm });
        }
    }
    Ok(write_model(calibration))
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
