//! What an identification answers.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::compensation::Verification;
use crate::effects::Role;
use crate::fit::Identification;
use crate::model::{Calibration, Model};

/// An identification, and what is left of every sample's deviation.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) identification: Identification,
    /// The model that goes with it, to be saved and exported.
    pub(crate) calibration: Calibration,
    /// Problems of the data; what is mechanical was corrected before the fit.
    pub(crate) data_problems: Vec<DataProblem>,
    /// Where the model was read from, if it was.
    pub(crate) loaded: Option<LoadedModelSummary>,
    /// What is left of the deviations, mm; NaN for samples that cannot be used.
    pub(crate) after_mm: [Vec<f64>; 3],
    /// Their lengths, mm.
    pub(crate) lengths_mm: Vec<f64>,
    /// Suspected outliers.
    pub(crate) suspected: Vec<bool>,
}

/// What there is to say about a model that was read from a file.
#[derive(Debug, Clone)]
pub(crate) struct LoadedModelSummary {
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

/// The pose of the base in the measuring frame (of the first setup) after a model, where the instrument was
/// never brought into the base frame: turned by more than 0.02 rad or moved by more than `far_mm`.
/// Points of the base frame become points of the measuring frame.
pub(crate) fn measuring_from_base(model: &Model, far_mm: f64) -> Option<Isometry3<f64>> {
    const TURNED: f64 = 0.02;
    let mut terms = model.terms().iter();
    let frame = terms.find(|t| t.effect.about().role == Role::FreeFrame && t.setting == 0.0)?;
    let [a, b, c, x, y, z] = frame.coefficients[..] else {
        return None;
    };
    let turn = Vector3::new(a, b, c);
    let shift = Vector3::new(x, y, z);
    let far = turn.norm() > TURNED || shift.norm() > far_mm;
    let rotation = UnitQuaternion::from_scaled_axis(turn);
    far.then(|| Isometry3::from_parts(Translation3::from(shift), rotation))
}
