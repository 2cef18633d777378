//! What is asked of a diagnosis.

use crate::diagnosis::{Diagnosis, Options, Watch};
use crate::paper::RegionalStart;
use crate::pipeline;
use crate::sessions::Session;
use clap::ValueEnum;

use super::failure::Failure;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Start {
    /// One model for the whole range
    Exact,
    /// The paper's constant corrections by region
    Regional,
}

/// What is asked of each session.
pub(crate) struct IdentificationTask {
    pub(super) options: Options,
    pub(super) start: Start,
}

impl IdentificationTask {
    /// The diagnosis of a session, and the regional model that it started from where asked for.
    pub(crate) fn of(
        &self,
        session: &Session,
        watch: Watch,
    ) -> Result<(Diagnosis, Option<RegionalStart>), Failure> {
        let answer = pipeline::diagnose(session, &self.options, watch)?;
        let values = self.options.joint_values;
        let start = match self.start {
            Start::Exact => None,
            Start::Regional => Some(pipeline::regional_start(session, &answer, values)?),
        };
        Ok((answer, start))
    }
}
