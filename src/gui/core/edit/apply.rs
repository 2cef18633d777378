//! What each change makes of a document.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::diagnosis::SessionCorrection;
use crate::document::degrees;
use crate::effects::{CATALOGUE, Term};
use crate::gui::core::answer::LoadedModel;
use crate::gui::core::document::{Added, Choices, Division, Document, Method};
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::setup::SetupForm;
use crate::kinematics::JointKind;
use crate::sessions::Session;
use crate::units::rad_from_deg;

use super::Edit;
use crate::gui::core::edit;

impl Edit {
    /// Whether it asks something of the samples; the answer then takes the place of a model that
    /// was read from a file.
    fn asks_samples(&self) -> bool {
        !matches!(
            self,
            Self::Open(_)
                | Self::OpenModel { .. }
                | Self::Rename(..)
                | Self::KeepRegions
                | Self::Tolerance(_)
                | Self::Export(_)
                | Self::Setup(_)
                | Self::Recover(..)
        )
    }

    /// The document after the change; the reason where it cannot be made.
    pub(crate) fn apply(&self, document: &Document) -> Result<Document, String> {
        let mut next = document.clone();
        if self.asks_samples() {
            if document.loaded_session.is_empty() {
                return Err(say!(
                    "nothing was measured yet: open a session that was measured on this robot"
                )
                .to_owned());
            }
            next.loaded_model = None;
        }
        if let Some(next) = edit::apply_to_regions(self, document) {
            return next;
        }
        match self {
            Self::Open(loaded_session) => return Ok(opened(document, loaded_session)),
            Self::OpenModel {
                loaded_model: given,
                of_open_session: beside,
            } => return Ok(with_model(next, given, *beside)),
            Self::Method(Method::Regional) | Self::IdentifyBy(Method::Regional)
                if !document.loaded_session.single_revolute() =>
            {
                return Err(say!("regions are for a single joint that turns").to_owned());
            }
            Self::Method(method) => next.method = *method,
            Self::Effect(id, on) => next.effects = with_effect(&document.effects, id, *on),
            Self::Tolerance(tolerance_mm) => {
                if tolerance_mm.is_some_and(|t| !(t.is_finite() && t > 0.0)) {
                    return Err(say!("a tolerance is a number above 0").to_owned());
                }
                next.tolerance_mm = *tolerance_mm;
            }
            Self::Export(choice) => {
                let joints = document.loaded_session.session.robot.joints.len();
                let usable = choice
                    .step
                    .is_none_or(|step| step.is_finite() && step > 0.0);
                if !usable || choice.joint >= joints {
                    return Err(
                        say!("a table needs a joint of the robot and a step above 0").to_owned(),
                    );
                }
                next.export = *choice;
            }
            Self::Add(terms) => exactly_with(&mut next, with_terms(&document.added, terms)),
            Self::Switch(index, on) => {
                let mut added = document.added.to_vec();
                added
                    .get_mut(*index)
                    .ok_or(say!("there is no such effect"))?
                    .on = *on;
                exactly_with(&mut next, added);
            }
            Self::Setup(form) => set_up(&mut next, form)?,
            Self::Exclude(samples, out) => exclude(&mut next, samples, *out)?,
            Self::Correct(mends) => correct(&mut next, mends)?,
            Self::Recover(loaded_session, kept) => {
                return Ok(recovered(document, loaded_session, kept));
            }
            Self::Divide(_)
            | Self::MoveBoundary(..)
            | Self::Adapt(..)
            | Self::KeepRegions
            | Self::Split(_)
            | Self::Join(_)
            | Self::Delete(_)
            | Self::Rename(..)
            | Self::RegionsOfSession => {}
            Self::Identify => next.identified = true,
            Self::IdentifyBy(method) => {
                next.method = *method;
                next.identified = true;
            }
        }
        Ok(next)
    }
}

/// Another session; a model that was read from a file stays where both are of the same robot.
fn opened(document: &Document, loaded_session: &Arc<LoadedSession>) -> Document {
    let opened = Document::new(Arc::clone(loaded_session));
    let given = document.loaded_model.as_ref();
    match given.filter(|given| given.is_of(&loaded_session.session)) {
        Some(given) => opened.with_model(Arc::clone(given)),
        None => opened,
    }
}

/// What is filled in, where that makes a robot.
fn set_up(document: &mut Document, form: &SetupForm) -> Result<(), String> {
    let session = &document.loaded_session.session;
    // Compared as it is filled in: missing cells are never equal.
    if *form == SetupForm::of(session) {
        return Ok(());
    }
    let next = form.session(session);
    let next = next.map_err(|problems| problems[0].1.clone())?;
    with_session(document, next);
    Ok(())
}

/// Takes samples out of every fit and figure, or in again.
fn exclude(document: &mut Document, samples: &[usize], out: bool) -> Result<(), String> {
    let loaded_session = &document.loaded_session;
    let of_session = &loaded_session.session.samples;
    let mut excluded: BTreeSet<usize> = of_session.excluded_by_hand().into_iter().collect();
    for sample in samples.iter().filter(|sample| **sample < of_session.len()) {
        if out {
            excluded.insert(*sample);
        } else {
            excluded.remove(sample);
        }
    }
    let held_out = of_session.held_out.as_deref();
    let counts = |i: usize| {
        loaded_session.usable[i] && !excluded.contains(&i) && !held_out.is_some_and(|h| h[i])
    };
    if out && !(0..of_session.len()).any(counts) {
        return Err(say!("no sample would be left to fit").to_owned());
    }
    let whole = loaded_session.made_of().map(|(whole, _)| Arc::clone(whole));
    let whole = whole.unwrap_or_else(|| Arc::clone(loaded_session));
    let excluded: Vec<usize> = excluded.into_iter().collect();
    document.loaded_session = Arc::new(LoadedSession::excluding(&whole, &excluded));
    Ok(())
}

/// Takes mistakes back, one after the other.
fn correct(document: &mut Document, mends: &[SessionCorrection]) -> Result<(), String> {
    let mut session = document.loaded_session.session.clone();
    for mend in mends {
        mend.apply(&mut session);
    }
    as_saved(&mut session);
    let left = session.samples.len();
    if session.samples.incomplete().len() == left {
        return Err(say!("no sample would be left").to_owned());
    }
    let same_rows = left == document.loaded_session.len();
    with_session(document, session);
    if !same_rows {
        let mut loaded_session = LoadedSession::clone(&document.loaded_session);
        // Samples have other numbers now.
        for finding in &mut loaded_session.findings {
            finding.samples.clear();
        }
        document.loaded_session = Arc::new(loaded_session);
    }
    Ok(())
}

/// Angles that were computed become those that a file will have: what is saved is read again to
/// the last bit.
fn as_saved(session: &mut Session) {
    let turns = |k: usize| session.robot.joints[k].kind == JointKind::Revolute;
    let turning: Vec<usize> = (0..session.robot.joints.len())
        .filter(|k| turns(*k))
        .collect();
    let samples = &mut session.samples;
    for k in turning {
        for q in samples.q[k]
            .iter_mut()
            .chain(samples.q_read[k].iter_mut().flatten())
        {
            *q = rad_from_deg(degrees(*q));
        }
    }
}

/// The same document with another description of the robot, or other samples.
fn with_session(document: &mut Document, session: Session) {
    let loaded_session = LoadedSession::with(&document.loaded_session, session);
    if document
        .loaded_model
        .as_ref()
        .is_some_and(|g| !g.is_of(&loaded_session.session))
    {
        document.loaded_model = None;
    }
    if !loaded_session.single_revolute() {
        document.regions = Arc::from([]);
        document.division = Division::Given;
        document.method = Method::Exact;
    }
    document.loaded_session = Arc::new(loaded_session);
}

/// What was left behind, with the choices that were made.
fn recovered(document: &Document, loaded_session: &Arc<LoadedSession>, kept: &Choices) -> Document {
    let mut next = opened(document, loaded_session);
    next.loaded_model = None;
    next.identified = kept.identified;
    if loaded_session.single_revolute() {
        next.method = kept.method;
    }
    let all = CATALOGUE.iter().map(|effect| effect.about().id);
    next.effects = all
        .filter(|id| kept.effects.iter().any(|e| e == id))
        .collect();
    next.added = kept.added.clone().into();
    next
}

/// A model beside the open session, or by itself.
fn with_model(document: Document, loaded_model: &Arc<LoadedModel>, beside: bool) -> Document {
    let beneath = if beside {
        document
    } else {
        Document::new(Arc::new(loaded_model.alone()))
    };
    beneath.with_model(Arc::clone(loaded_model))
}

/// What is added is wanted: the exact fit follows at once.
fn exactly_with(document: &mut Document, added: Vec<Added>) {
    document.added = added.into();
    document.method = Method::Exact;
    document.identified = true;
}

/// What was added before, and these terms, all of them switched on.
fn with_terms(before: &[Added], terms: &[Term]) -> Vec<Added> {
    let mut added = before.to_vec();
    for term in terms {
        match added.iter_mut().find(|a| a.term.same_column(term)) {
            Some(there) => there.on = true,
            None => added.push(Added {
                term: term.clone(),
                on: true,
            }),
        }
    }
    added
}

fn with_effect(effects: &[&'static str], id: &str, on: bool) -> Vec<&'static str> {
    let chosen = |other: &str| {
        if other == id {
            on
        } else {
            effects.contains(&other)
        }
    };
    let all = CATALOGUE.iter().map(|effect| effect.about().id);
    all.filter(|other| chosen(other)).collect()
}
