//! An answer to a question, made ready for drawing.

use std::sync::Arc;

use crate::gui::core::answer::Answer;
use crate::gui::core::document::Question;
use crate::gui::core::identify::answer;
use crate::gui::core::loaded_session::Subject;
use crate::gui::core::overview::Readable;
use crate::gui::jobs::Watch;
use crate::numeric::Ascending;

use super::cloud::{Cloud, Remainder};

/// An answer to a question.
#[derive(Debug, Clone)]
pub(crate) struct Outcome {
    pub(crate) question: Question,
    /// The answer, or why there is none.
    pub(crate) answer: Result<Answer, String>,
    /// What follows from it for drawing.
    pub(crate) after: Option<After>,
}

/// What every frame needs to know of an answer, worked out once.
#[derive(Debug, Clone)]
pub(crate) struct After {
    /// What is left, as it is uploaded.
    pub(crate) remainder: Arc<Remainder>,
    /// Ascending of what is left.
    pub(crate) lengths: Ascending,
    /// What decides at which magnification what is left can be read.
    pub(crate) readable: Readable,
}

impl After {
    fn new(subject: &Subject, answer: &Answer) -> Self {
        let remainder = Cloud::of(subject).remainder(&answer.after_mm, &answer.suspected);
        Self {
            remainder: Arc::new(remainder),
            lengths: Ascending::new(&answer.lengths_mm),
            readable: Readable::new(subject.overview.radius_mm, &answer.lengths_mm),
        }
    }
}

/// Only itself.
impl PartialEq for Outcome {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Outcome {
    /// Works the answer out. Takes its time with many samples.
    pub(crate) fn of(question: Question, watch: &Watch) -> Self {
        let answer = answer(&question, watch);
        let after = answer.as_ref().ok();
        let after = after.map(|answer| After::new(&question.subject, answer));
        Self {
            question,
            answer,
            after,
        }
    }
}
