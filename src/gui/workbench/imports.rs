//! A foreign file: what is said about it, what is seen then, and the session that it becomes.

use std::path::PathBuf;
use std::sync::Arc;

use super::{Command, Workbench};
use crate::gui::cache::cloud::Cloud;
use crate::gui::core::edit::Edit;
use crate::gui::files;
use crate::gui::import_draft::{Companion, ImportAnswers, ImportDraft, InspectedDraft};
use crate::gui::jobs::{Kind, Running, Watch};
use crate::gui::view::Sheet;

impl Workbench {
    fn import_draft(&mut self) -> Option<&mut ImportDraft> {
        match &mut self.view.sheet {
            Some(Sheet::Import(foreign)) => Some(foreign),
            _ => None,
        }
    }

    /// Takes what was said, and looks at the file with it.
    pub(super) fn say(&mut self, answers: ImportAnswers) {
        if let Some(foreign) = self.import_draft() {
            foreign.answers = answers;
        }
        self.keep_looking();
    }

    /// The look at a foreign file that is under way.
    pub(crate) fn looking(&self) -> Option<&Running> {
        self.jobs.running(Kind::Looks)
    }

    /// Cancels that look, whatever else is under way.
    pub(super) fn cancel_look(&mut self) {
        self.jobs.cancel(|kind| kind == Kind::Looks);
    }

    /// Asks for a file beside it.
    pub(super) fn choose_beside(&mut self, which: Companion) {
        let measured = self.import_draft().map(|foreign| foreign.path.clone());
        let ask = move || files::choose_beside(which, measured.as_deref());
        self.choose(
            say!("waiting for a file to be chosen"),
            ask,
            move |bench, path| bench.take_beside(which, path),
        );
    }

    /// One look at a time; when it is done, the next with what was said meanwhile.
    fn keep_looking(&mut self) {
        if self.looking().is_some() {
            return;
        }
        let Some(foreign) = self.import_draft().filter(|f| !f.is_up_to_date()) else {
            return;
        };
        let foreign = foreign.clone();
        let work = move |watch: &Watch| {
            let seen = foreign.look(watch);
            if let Ok(InspectedDraft {
                trial: Some(Ok(trial)),
                ..
            }) = &seen
            {
                // Made here, so that the window never waits for it.
                Cloud::of(&trial.loaded_session);
            }
            (seen, foreign)
        };
        self.jobs.start(
            Kind::Looks,
            say!("looking at the file"),
            work,
            |bench: &mut Self, (seen, of)| {
                // A cancelled one has no result.
                if let Ok(seen) = seen {
                    bench.take_looked(&of, seen);
                }
            },
        );
    }

    fn take_looked(&mut self, of: &ImportDraft, seen: InspectedDraft) {
        if let Some(foreign) = self.import_draft() {
            foreign.take(of, seen);
        }
        self.keep_looking();
    }

    /// Takes a file that was chosen; the field is there to type it where no dialog is.
    fn take_beside(&mut self, which: Companion, path: Option<PathBuf>) {
        if let (Some(foreign), Some(path)) = (self.import_draft(), path) {
            foreign.answers.choose(which, &path);
        }
        self.keep_looking();
    }

    pub(super) fn confirm_columns(&mut self) {
        if let Some(foreign) = self.import_draft() {
            foreign.confirm();
        }
    }

    /// Opens the session that the sheet shows.
    pub(super) fn import(&mut self) {
        let result = self.import_draft().and_then(|foreign| {
            let trial = foreign.result()?;
            Some(Arc::clone(&trial.loaded_session))
        });
        if let Some(loaded_session) = result {
            self.view.sheet = None;
            self.execute(Command::Edit(Edit::Open(loaded_session)));
        }
    }
}
