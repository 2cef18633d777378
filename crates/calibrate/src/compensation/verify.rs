//! Verification: whether a calibration has the stated error on a session.

use crate::model::Calibration;
use crate::sessions::Session;

use super::verification::{Verification, VerifyError, same_robot};

/// Compares a session with a calibration.
///
/// # Errors
/// See [`VerifyError`].
pub fn verify(calibration: &Calibration, session: &Session) -> Result<Verification, VerifyError> {
    let session = &*session.whole()?;
    calibration.sound()?;
    let notes = same_robot(calibration, session)?;
    super::conventions::verified(calibration, session, &notes)
}
