//! Which calibrations correct commands at all: not one that was measured with a table active, and not one with a gross
//! residual. A column in another unit, rows that belong to other rows, a sign that changes half way give errors of the
//! robot's size; values that were fitted to them are no robot's, and a table made of them increases the error.

use super::{TableError, VerifiedCalibration};
use crate::thresholds::{GROSS_SHARE, PLAUSIBLE_SHARE, size_of};

/// A gross residual has to be smaller than that of the nominal robot by at least this. (Derived: a servo with a degree
/// of play has a residual of sin 1° = 0.017 of its reach, and its zeros are worth correcting.)
const SHARE_OF_NOMINAL: f64 = 0.5;

impl VerifiedCalibration {
    /// That commands may be corrected with it: what every table, program and description asks first.
    ///
    /// # Errors
    /// [`TableError::AlreadyCompensated`] and [`TableError::Gross`].
    pub fn may_correct(&self) -> Result<(), TableError> {
        if let Some(hash) = &self.compensated_by {
            return Err(TableError::AlreadyCompensated(hash.clone()));
        }
        let [nominal, .., last] = &self.history[..] else {
            return Ok(());
        };
        let travelled = self.measured.iter().map(|range| [range.from, range.to]);
        let size_mm = size_of(&self.model.robot, &self.targets, travelled);
        let left_mm = last.gap_mm;
        let gains = left_mm < SHARE_OF_NOMINAL * nominal.gap_mm;
        if left_mm > PLAUSIBLE_SHARE * size_mm || left_mm > GROSS_SHARE * size_mm && !gains {
            return Err(TableError::Gross { left_mm, size_mm });
        }
        Ok(())
    }
}
