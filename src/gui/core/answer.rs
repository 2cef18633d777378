//! What an identification answers.

use crate::compensation::Verification;
use crate::fit::Identification;
use crate::model::Calibration;

/// An identification, and what is left of every sample's deviation.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) identification: Identification,
    /// The model that goes with it, to be saved and exported.
    pub(crate) calibration: Calibration,
    /// Where the model was read from, if it was.
    pub(crate) loaded: Option<Loaded>,
    /// What is left of the deviations, mm; NaN for samples that cannot be used.
    pub(crate) after_mm: [Vec<f64>; 3],
    /// Their lengths, mm.
    pub(crate) lengths_mm: Vec<f64>,
    /// Suspected outliers.
    pub(crate) suspected: Vec<bool>,
}

/// What there is to say about a model that was read from a file.
#[derive(Debug, Clone)]
pub(crate) struct Loaded {
    pub(crate) file: String,
    /// What it does on the session; `None` where nothing was measured.
    pub(crate) verification: Option<Verification>,
}

impl Answer {
    /// What is left of a sample's deviation, mm.
    pub(crate) fn deviation_after(&self, sample: usize) -> [f64; 3] {
        std::array::from_fn(|axis| self.after_mm[axis][sample])
    }
}
