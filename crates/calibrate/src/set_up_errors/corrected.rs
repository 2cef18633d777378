//! What was corrected in memory goes with the samples: a model that is fitted to them carries it.

use crate::sessions::{Corrected, Session, SessionCorrection, hash_of_samples};
use std::borrow::Cow;

use super::DataProblem;

impl<'a> CorrectedSession<'a> {
    /// A session as it is, or with the corrections that were `made`; `raw` is what was read.
    pub(super) fn new(
        raw: &Session,
        mut session: Cow<'a, Session>,
        problems: Vec<DataProblem>,
        made: Vec<SessionCorrection>,
    ) -> Self {
        if let Cow::Owned(better) = &mut session
            && raw.samples.corrected.is_none()
            && !made.is_empty()
        {
            better.samples.corrected = Some(Corrected {
                by: made,
                raw_hash: hash_of_samples(raw),
            });
        }
        Self { session, problems }
    }
}

/// The corrections of these problems, which were made.
pub(super) fn made_for(problems: &[DataProblem]) -> impl Iterator<Item = SessionCorrection> + '_ {
    problems.iter().filter_map(|problem| problem.mend.clone())
}

/// A session with its set-up errors corrected, and what they were.
#[derive(Debug, Clone)]
pub struct CorrectedSession<'a> {
    /// The session to go on with.
    pub session: Cow<'a, Session>,
    /// What was wrong.
    pub problems: Vec<DataProblem>,
}
