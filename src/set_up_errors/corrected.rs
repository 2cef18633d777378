//! What was corrected in memory goes with the samples: a model that is fitted to them carries it.

use std::borrow::Cow;

use crate::model::SetUp;
use crate::sessions::{Corrected, Session, hash_of_samples};

use super::{DataProblem, Mended};

impl<'a> Mended<'a> {
    /// A session as it stands, or without its set-up errors; `raw` is what was read.
    pub(super) fn new(
        raw: &Session,
        mut session: Cow<'a, Session>,
        problems: Vec<DataProblem>,
    ) -> Self {
        if let Cow::Owned(better) = &mut session
            && raw.samples.corrected.is_none()
        {
            let made = problems.iter().filter_map(|problem| problem.mend.clone());
            let set_up = SetUp::new(made);
            if !set_up.is_empty() {
                better.samples.corrected = Some(Corrected {
                    by: set_up.corrections().to_vec(),
                    raw_hash: hash_of_samples(raw),
                });
            }
        }
        Self { session, problems }
    }
}
