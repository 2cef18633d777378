//! An answer to a question, made ready for drawing.

use crate::language::spoken;
use std::sync::{Arc, OnceLock};

use crate::compensation::VerifiedCalibration;

use crate::gui::core::answer::Answer;
use crate::gui::core::document::{Question, QuestionDetails};
use crate::gui::core::identify::answer;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::overview::Readable;
use crate::gui::jobs::Watch;
use crate::numeric::Ascending;
use crate::pipeline;

use super::cloud::{Cloud, Remainder};

/// An answer to a question.
#[derive(Debug, Clone)]
pub(crate) struct IdentifiedAnswer {
    pub(crate) question: Question,
    /// The answer, or why there is none.
    pub(crate) answer: Result<Answer, String>,
    /// What follows from it for drawing.
    pub(crate) after: Option<AnswerSummary>,
    /// What files are made of, or why none are; worked out when it is first asked for.
    handed_out: OnceLock<Result<Arc<VerifiedCalibration>, String>>,
}

/// What every frame needs to know of an answer, worked out once.
#[derive(Debug, Clone)]
pub(crate) struct AnswerSummary {
    /// What is left, as it is uploaded.
    pub(crate) remainder: Arc<Remainder>,
    /// Ascending of what is left.
    pub(crate) lengths: Ascending,
    /// What decides at which magnification what is left can be read.
    pub(crate) readable: Readable,
}

impl AnswerSummary {
    fn new(loaded_session: &LoadedSession, answer: &Answer) -> Self {
        let remainder = Cloud::of(loaded_session).remainder(&answer.after_mm, &answer.suspected);
        Self {
            remainder: Arc::new(remainder),
            lengths: Ascending::new(&answer.lengths_mm),
            readable: Readable::new(loaded_session.overview.radius_mm, &answer.lengths_mm),
        }
    }
}

/// Only itself.
impl PartialEq for IdentifiedAnswer {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl IdentifiedAnswer {
    /// Works the answer out. Takes its time with many samples.
    pub(crate) fn of(question: Question, watch: &Watch) -> Self {
        let answer = answer(&question, watch);
        let after = answer.as_ref().ok();
        let after = after.map(|answer| AnswerSummary::new(&question.loaded_session, answer));
        Self {
            question,
            answer,
            after,
            handed_out: OnceLock::new(),
        }
    }

    /// The model that files are made of: verified on the session that it came from, or read from a file.
    /// Takes its time with many samples.
    pub(crate) fn handed_out(&self) -> Result<Arc<VerifiedCalibration>, String> {
        let verified = || {
            let answer = self.answer.as_ref().map_err(Clone::clone)?;
            if let QuestionDetails::Given(given) = &self.question.asks {
                return Ok(Arc::new(given.calibration.clone()));
            }
            let session = &self.question.loaded_session.session;
            let verified = pipeline::hand_out(&answer.calibration, session);
            verified
                .map(Arc::new)
                .map_err(|error| spoken(error.describe()))
        };
        self.handed_out.get_or_init(verified).clone()
    }
}
