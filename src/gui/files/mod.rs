//! Reading and writing, as the background tasks do it: through the library, like the terminal. Here a session or a
//! model is read or made, with everything that follows from it; also those that come with the program.

mod system;
pub(crate) mod writing;

pub(crate) use crate::pipeline::is_model;
pub(crate) use system::{
    cancelled, choose_beside, choose_declarations, choose_logo, choose_reference, choose_targets,
    choose_to_export, choose_to_import, choose_to_open, open_outside,
};
#[cfg(test)]
pub(crate) use writing::not_written;
pub(crate) use writing::{NotSaved, Replace, Saved, png, save};

use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

use crate::language::{finding, spoken};
use crate::pipeline::{self, load_model};
use crate::programs::LANGUAGES;
use crate::progress::{Cancelled, Progress, ProgressSpan, ReadError, unwatched};
use crate::sessions::{Loaded, Session};

use crate::gui::core::answer::LoadedModel;
use crate::gui::core::disk::{EXAMPLES, Fingerprint};
use crate::gui::core::document::plain;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::{ImportDraft, TABLES, listed};
use crate::gui::jobs::Watch;
use crate::gui::view::Message;

/// Whether a file is a robot program by its name: one whose ending a table of measurements does not have as well.
pub(crate) fn is_program(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| {
        let program = LANGUAGES.iter().any(|l| l.extensions.contains(&&*ending));
        program && !TABLES.contains(&&*ending)
    })
}

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    format!("{}.json", plain(&session.name))
}

#[derive(Debug)]
pub(crate) enum Opened {
    /// A session was read or made.
    Session(Arc<LoadedSession>),
    /// A model was read.
    Model(Arc<LoadedModel>),
    /// A file that an instrument wrote was looked at.
    Foreign(Box<ImportDraft>),
}

/// Reads a session or a model: its key `format` says which it is.
pub(crate) fn open(path: &Path, watch: &Watch) -> Result<Opened, Message> {
    let failed = |error: ReadError| not_opened(path.display(), &error);
    if is_model(path) {
        let calibration = load_model(path).map_err(|rejected| failed(rejected.into()))?;
        let path = path.to_path_buf();
        return Ok(Opened::Model(Arc::new(LoadedModel { calibration, path })));
    }
    let report_progress = watch.progress_callback();
    let progress = Progress::new(&report_progress);
    let whole = progress.whole();
    if let Some(foreign) = ImportDraft::of(path, whole) {
        let foreign = foreign.map_err(failed)?;
        return Ok(Opened::Foreign(Box::new(foreign)));
    }
    let loaded = pipeline::load_watched(path, whole.part(0.0, READING).watch());
    let loaded_session = loaded.and_then(|loaded| {
        watch.doing(say!(
            "checking {samples} samples",
            samples = loaded.session.samples.len()
        ));
        let origin = Origin::File(path.to_path_buf());
        let part = whole.part(READING, 1.0);
        Ok(looked_through(loaded, origin, part)?)
    });
    loaded_session.map(Opened::Session).map_err(failed)
}

/// Everything that follows from a session that was read.
fn looked_through(
    loaded: Loaded,
    origin: Origin,
    part: ProgressSpan<'_>,
) -> Result<Arc<LoadedSession>, Cancelled> {
    let findings = loaded.findings;
    let mut loaded_session =
        LoadedSession::watched(loaded.session, findings, origin, part.part(0.0, 0.6))?;
    loaded_session.files = loaded
        .files
        .iter()
        .filter_map(|f| Fingerprint::of(f))
        .collect();
    // Made here, so that the window never waits for it.
    loaded_session.cloud();
    part.reached(1.0)?;
    Ok(Arc::new(loaded_session))
}

/// Says that a file was not opened.
fn not_opened(name: impl Display, error: &ReadError) -> Message {
    let title = say!("{name} could not be opened; nothing was changed", name);
    let why = match error {
        ReadError::Rejected(rejected) => listed(rejected.diagnostics.iter().map(finding).collect()),
        ReadError::Cancelled(_) => vec![cancelled()],
    };
    Message::wrong(title, why)
}

/// Which part of opening a session it is to read it; the rest is to look through it.
const READING: f64 = 0.4;

/// Makes a session by simulation.
pub(crate) fn simulate(form: &Form, watch: &Watch) -> Result<Opened, Message> {
    match form.session(watch.progress_callback()) {
        Ok((session, hidden)) => {
            let mut loaded_session = LoadedSession::new(session, Vec::new(), Origin::Simulated);
            loaded_session.hidden = Some(hidden.into());
            loaded_session.cloud();
            Ok(Opened::Session(Arc::new(loaded_session)))
        }
        Err(problems) => Err(Message::wrong(
            say!("The simulation needs other numbers").to_owned(),
            problems.iter().map(spoken).collect(),
        )),
    }
}

/// A bundled session.
fn example(index: usize) -> Result<Arc<LoadedSession>, ReadError> {
    let files = EXAMPLES[index].files;
    let loaded = pipeline::parse_with_csv(files.document, files.samples)?;
    let progress = Progress::new(&unwatched);
    Ok(looked_through(loaded, Origin::Bundled, progress.whole())?)
}

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<LoadedSession> {
    example(0).expect("a test reads every bundled session")
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Result<Opened, Message> {
    example(index)
        .map(Opened::Session)
        .map_err(|error| not_opened(EXAMPLES[index].name(), &error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::disk::EXAMPLES;
    use crate::watching::{assert_grows, no_at, report_to};

    #[test]
    fn looking_through_a_session_can_be_cancelled_wherever_it_tells_how_far_it_is() {
        let example = &EXAMPLES[1];
        let through = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
            let loaded = pipeline::parse_with_csv(example.files.document, example.files.samples);
            let progress = Progress::new(watch);
            looked_through(loaded.unwrap(), Origin::Bundled, progress.whole())
        };
        let (shares, loaded_session) = report_to(through);
        assert_grows(&shares);
        assert_eq!(loaded_session.map(|s| s.len()).ok(), Some(30));
        for number in 0..shares.len() {
            assert!(through(&no_at(number)).is_err(), "{number}");
        }
    }

    #[test]
    fn every_bundled_session_can_be_read() {
        for (index, example) in EXAMPLES.iter().enumerate() {
            assert!(open_example(index).is_ok(), "{}", example.name());
        }
    }
}
