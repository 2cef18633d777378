//! Blunders of setting up.

use crate::sessions::Session;

use super::Options;

/// A mistake in the data, its evidence, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataProblem {
    /// What is wrong.
    pub what: String,
    /// What speaks for it.
    pub evidence: String,
    /// What to do.
    pub proposal: String,
}

/// A session with its blunders mended, and what they were.
#[derive(Debug, Clone)]
pub struct Mended<'a> {
    /// The session to go on with.
    pub session: std::borrow::Cow<'a, Session>,
    /// What was wrong.
    pub problems: Vec<DataProblem>,
}

/// Tries the blunders and mends what it finds.
pub fn mend<'a>(session: &'a Session, _: &Options) -> Mended<'a> {
    Mended {
        session: std::borrow::Cow::Borrowed(session),
        problems: Vec::new(),
    }
}
