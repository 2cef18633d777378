//! Why there is no diagnosis.

use crate::text::Text;

use super::Cancelled;

/// Why there is no diagnosis, or no plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DiagnoseError {
    /// No effect of this name.
    UnknownEffect(String),
    /// A robot, an option, or options together, that make no sense or ask for what cannot be done.
    Option(Text),
    /// Every sample is held out or cannot be used.
    NothingToFit,
    /// The session is no whole one: columns of different lengths, more joints than a robot has.
    Rejected(crate::diagnostic::Rejected),
    /// The watcher asked to stop.
    Cancelled,
}

impl DiagnoseError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::UnknownEffect(effect) => text!(
                "no effect is called '{effect}'; `truepose effects` lists them",
                effect
            ),
            Self::Option(problem) => problem.clone(),
            Self::NothingToFit => text!(
                "no sample can be fitted: every one is held out, or lacks a joint value or a measured point (x_mm, y_mm)"
            ),
            Self::Rejected(inner) => inner.describe(),
            Self::Cancelled => text!("stopped"),
        }
    }
}

displays_what_it_says!(DiagnoseError);

impl std::error::Error for DiagnoseError {}

impl From<crate::diagnostic::Rejected> for DiagnoseError {
    fn from(error: crate::diagnostic::Rejected) -> Self {
        Self::Rejected(error)
    }
}

impl From<Cancelled> for DiagnoseError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
