//! A search for what is missing, as the window keeps it: the diagnosis of one session, and the model's term of each name
//! that was found.

use std::sync::Arc;

use crate::diagnosis::{DiagnoseError, Diagnosis, FoundEffect, Options, Progress};
use crate::effects::Term;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::jobs::Watch;
use crate::pipeline::diagnose;

#[derive(Debug, Clone)]
pub(crate) struct Search {
    /// The session that was searched.
    pub(crate) loaded_session: Arc<LoadedSession>,
    /// What was found, or why there is no answer.
    pub(crate) answer: Result<Diagnosis, String>,
}

only_itself!(Search);

impl Search {
    /// Searches. Takes its time.
    pub(crate) fn of(loaded_session: Arc<LoadedSession>, watch: &Watch) -> Self {
        let answer = diagnose(
            &loaded_session.session,
            &Options::default(),
            &progress_callback(watch),
        );
        let answer = answer.map_err(|error| match error {
            DiagnoseError::Cancelled => say!("it was cancelled").to_owned(),
            other => other.to_string(),
        });
        Self {
            loaded_session,
            answer,
        }
    }
}

/// Passes on how far a search is, and whether it was cancelled.
pub(crate) fn progress_callback(watch: &Watch) -> impl Fn(&Progress) -> bool {
    |progress| {
        watch.done(match progress {
            Progress::Checking => 0.02,
            Progress::Preparing => 0.1,
            Progress::Searching { found, percent } => {
                watch.found(found);
                0.25 + 0.45 * f64::from(*percent) / 100.0
            }
            Progress::Comparing => 0.7,
            Progress::Planning => 0.85,
        });
        !watch.stopped()
    }
}

/// The terms of everything that a search found, each in its place, and last the smooth correction
/// of what no name explains.
pub(crate) fn terms(diagnosis: &Diagnosis) -> Vec<Option<Term>> {
    let found = diagnosis.found.iter().map(|f| term_of(diagnosis, f));
    let smooth = diagnosis.correction();
    found.chain(smooth.map(|c| Some(c.term.clone()))).collect()
}

/// The model's term of a name that was found. Names may come twice with another setting (two
/// orders of a gear); the setting is their first parameter then.
pub(crate) fn term_of(diagnosis: &Diagnosis, found: &FoundEffect) -> Option<Term> {
    let first = found.parameters.first().map_or(0.0, |p| p.value);
    let robot = &diagnosis.model.robot;
    let distance = |term: &Term| {
        let parameters = term.parameters_on(robot.joints[term.joint].kind);
        parameters.first().map_or(0.0, |p| (p.value - first).abs())
    };
    let terms = diagnosis.model.terms().iter();
    let same = terms.filter(|term| {
        let about = term.effect.about();
        about.id == found.effect && found.joint.is_none_or(|joint| joint == term.joint + 1)
    });
    same.min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .cloned()
}
