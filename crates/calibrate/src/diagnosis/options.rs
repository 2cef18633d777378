//! The options of a diagnosis.

use crate::effects::JointValues;

use super::DiagnoseError;
use super::candidates::table::Allowed;

/// The options of a diagnosis.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Names that may be used.
    pub allowed: Allowed,
    /// Most effects to add; at most a tenth of the number of samples anyway.
    pub max_effects: Option<usize>,
    /// Share of the samples to lock away from everything.
    pub held_out: Option<f64>,
    /// Seed of the random numbers with which poses are proposed.
    pub seed: u64,
    /// Joint values to start from.
    pub joint_values: JointValues,
    /// Whether a search that the watcher stops answers with what was found until then, marked as such; else
    /// [`DiagnoseError::Cancelled`].
    pub keep_when_stopped: bool,
    /// Whether the model holds names and geometry only, and nothing that predicts without a name.
    pub without_unnamed: bool,
    /// On how many threads independent parts of a search are done; `None`: on two where the machine has them. The
    /// answer is the same to the last bit.
    pub threads: Option<usize>,
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), DiagnoseError> {
        let named = self.allowed.without.iter();
        for id in named.chain(self.allowed.only.iter().flatten()) {
            if crate::effects::find(id).is_none() {
                return Err(DiagnoseError::UnknownEffect(id.clone()));
            }
        }
        match self.held_out {
            Some(share) if !(share > 0.0 && share < 1.0) => Err(DiagnoseError::Option(text!(
                "--held-out is {share}; expected a share above 0 and below 1, such as 0.25",
                share
            ))),
            _ => Ok(()),
        }
    }
}
