//! Why there is no identification.

use crate::text::Text;

/// Why an identification could not be made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum IdentifyError {
    /// No effect of this name.
    UnknownEffect(String),
    /// Every sample is held out or cannot be used.
    NothingToFit,
    /// The paper's method is for one revolute joint.
    NotASingleRevoluteJoint(Text),
    /// The regions make no sense.
    Regions(truepose_session::refusal::Refusal),
    /// The session is no whole one: columns of different lengths, more joints than a robot has.
    Rejected(crate::diagnostic::Rejected),
    /// The caller cancelled.
    Cancelled,
}

impl IdentifyError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::UnknownEffect(effect) => text!(
                "no effect is called '{effect}'; `truepose effects` lists them",
                effect
            ),
            Self::NothingToFit => text!(
                "no sample can be fitted: every one is held out, or lacks a joint value or a coordinate"
            ),
            Self::NotASingleRevoluteJoint(because) => text!(
                "regional identification is for a single revolute joint; {because}",
                because
            ),
            Self::Regions(given) => given.describe(),
            Self::Rejected(inner) => inner.describe(),
            Self::Cancelled => text!("the identification was cancelled"),
        }
    }
}

displays_what_it_says!(IdentifyError);

impl std::error::Error for IdentifyError {}

impl From<truepose_session::refusal::Refusal> for IdentifyError {
    fn from(error: truepose_session::refusal::Refusal) -> Self {
        Self::Regions(error)
    }
}

impl From<crate::diagnostic::Rejected> for IdentifyError {
    fn from(error: crate::diagnostic::Rejected) -> Self {
        Self::Rejected(error)
    }
}
