//! Why there is no report.

use crate::compensation::NotHandedOut;
use crate::compensation::verification::VerifyError;
use crate::diagnosis::DiagnoseError;
use crate::text::Text;

/// Why there is no report.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// The session cannot be diagnosed.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// The model cannot be held against the session.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// The model does not do what was said of it.
    #[error(transparent)]
    NotHandedOut(#[from] NotHandedOut),
}

impl ReportError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::Diagnose(error) => error.describe(),
            Self::Verify(error) => error.describe(),
            Self::NotHandedOut(error) => error.describe(),
        }
    }
}
