//! A foreign file: what is said about it, what is seen then, and the session that it becomes.

use std::path::PathBuf;
use std::sync::Arc;

use super::{Command, Workbench};
use crate::gui::core::edit::Edit;
use crate::gui::foreign::{Beside, Foreign, Look, Said};
use crate::gui::jobs::Report;
use crate::gui::view::Sheet;
use crate::progress::Cancelled;

impl Workbench {
    fn foreign(&mut self) -> Option<&mut Foreign> {
        match &mut self.view.sheet {
            Some(Sheet::Import(foreign)) => Some(foreign),
            _ => None,
        }
    }

    /// Takes what was said, and looks at the file with it.
    pub(super) fn say(&mut self, said: Said) {
        if let Some(foreign) = self.foreign() {
            foreign.said = said;
        }
        self.keep_looking();
    }

    /// One look at a time; when it is done, the next with what was said meanwhile.
    fn keep_looking(&mut self) {
        if self.tasks.looking().is_some() {
            return;
        }
        let Some(foreign) = self.foreign().filter(|f| !f.is_up_to_date()) else {
            return;
        };
        let foreign = foreign.clone();
        self.tasks.look("looking at the file", move |watch| {
            match foreign.look(watch) {
                Ok(seen) => Report::Looked(Box::new((foreign, seen))),
                // Nobody takes it.
                Err(Cancelled) => Report::Kept(Ok(())),
            }
        });
    }

    pub(super) fn take_looked(&mut self, looked: (Foreign, Look)) {
        let (of, seen) = looked;
        if let Some(foreign) = self.foreign() {
            foreign.take(&of, seen);
        }
        self.keep_looking();
    }

    /// Takes a file that was chosen; the field is there to type it where no dialog is.
    pub(super) fn take_beside(&mut self, which: Beside, path: Option<PathBuf>) {
        if let (Some(foreign), Some(path)) = (self.foreign(), path) {
            foreign.said.choose(which, &path);
        }
        self.keep_looking();
    }

    pub(super) fn confirm_columns(&mut self) {
        if let Some(foreign) = self.foreign() {
            foreign.confirm();
        }
    }

    /// Opens the session that the sheet shows.
    pub(super) fn import(&mut self) {
        let result = self.foreign().and_then(|foreign| {
            let trial = foreign.result()?;
            Some(Arc::clone(&trial.subject))
        });
        if let Some(subject) = result {
            self.view.sheet = None;
            self.execute(Command::Edit(Edit::Open(subject)));
        }
    }
}
