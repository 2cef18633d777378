//! What is asked of an identification: by value, so that the same is not answered twice; and where a search has answered it.

use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::effects::Term;
use crate::fit::DEFAULT_EFFECTS;
use crate::gui::core::answer::{self, LoadedModel, Search};
use crate::gui::core::loaded_session::LoadedSession;
use crate::sessions::Region;

/// What to identify, from what.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Question {
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) asks: QuestionDetails,
}

/// The part of a [`Question`] beside the session.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum QuestionDetails {
    /// Exactly these effects.
    Exact {
        effects: Vec<&'static str>,
        /// What a search found, with its settings.
        with: Vec<Term>,
        /// The search, where all of this is just what it found: its own values are the answer then.
        found: Option<RequestedSearch>,
    },
    /// A correction for each of these regions.
    Regional(Arc<[Region]>),
    /// What this model says.
    Given(Arc<LoadedModel>),
}

/// A search whose answer is asked for.
#[derive(Debug, Clone)]
pub(crate) struct RequestedSearch {
    search: Arc<Search>,
    /// Whether the smooth correction of what no name explains is asked for too.
    corrected: bool,
}

impl PartialEq for RequestedSearch {
    fn eq(&self, other: &Self) -> bool {
        let same = Arc::ptr_eq(&self.search, &other.search);
        self.corrected == other.corrected && (same || self.search.answer == other.search.answer)
    }
}

impl RequestedSearch {
    /// The search, where these terms are all that it found.
    fn all_of(search: &Arc<Search>, with: &[Term]) -> Option<Self> {
        let diagnosis = search.answer.as_ref().ok()?;
        let mut terms: Vec<Term> = answer::terms(diagnosis).into_iter().flatten().collect();
        let same = |terms: &[Term]| {
            terms.len() == with.len() && terms.iter().all(|term| with.contains(term))
        };
        let corrected = diagnosis.correction().is_some();
        let all = same(&terms);
        let all_names = corrected && terms.pop().is_some() && same(&terms);
        (all || all_names).then(|| Self {
            search: Arc::clone(search),
            corrected: corrected && all,
        })
    }

    /// What it found, with no more of the smooth correction than is asked for.
    pub(crate) fn diagnosis(&self) -> Option<Diagnosis> {
        let diagnosis = self.search.answer.as_ref().ok()?.clone();
        Some(if self.corrected {
            diagnosis
        } else {
            diagnosis.uncorrected()
        })
    }
}

impl Question {
    /// The same, answered by the search where it asks for all that the search found and nothing
    /// else. A session with set-up errors was corrected before it was searched: its own fit is another.
    pub(crate) fn found_by(mut self, search: &Arc<Search>) -> Self {
        let QuestionDetails::Exact {
            effects,
            with,
            found,
        } = &mut self.asks
        else {
            return self;
        };
        let base = effects.len() == DEFAULT_EFFECTS.len()
            && DEFAULT_EFFECTS.iter().all(|id| effects.contains(id));
        let clean = |d: &Diagnosis| d.data_problems.is_empty();
        let as_given = search.answer.as_ref().is_ok_and(clean);
        if base && as_given && Arc::ptr_eq(&search.loaded_session, &self.loaded_session) {
            *found = RequestedSearch::all_of(search, with);
        }
        self
    }
}
