//! Dialogs of the system: one at a time, and what one was opened for is kept with it. Until it is answered the window
//! takes no commands.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::files::{self, Replace};
use crate::gui::jobs::{Kind, Running};
use crate::gui::view::{Message, Sheet, What};

use super::Workbench;
use super::state::Chooser;

impl Workbench {
    /// Asks for a file to open, beside the one in hand.
    pub(crate) fn choose_file(&mut self, ask: fn(Option<&Path>) -> Option<PathBuf>) {
        let near = self.file().map(Path::to_path_buf);
        let near = near.or_else(|| Some(self.recent().next()?.0.to_path_buf()));
        self.choose(
            say!("waiting for a file to be chosen"),
            move || ask(near.as_deref()),
            |bench, path| match path {
                Some(path) => bench.open_file(path),
                // Cancelled, or there is no dialog on this system: the two look alike.
                None => bench.view.message = Some(no_file_was_chosen()),
            },
        );
    }

    /// Asks where to save the session: that one is saved, whatever is open by then.
    pub(crate) fn choose_where_to_save(&mut self) {
        if self.has_nothing_to_save() {
            return;
        }
        let path = self.proposed_path();
        let document = Arc::clone(self.history.present());
        let ask = move || files::choose_to_save(&path);
        self.choose(
            say!("waiting for a file name"),
            ask,
            move |bench, path| match path {
                // The dialog has asked.
                Some(path) => bench.save_document(document, &path, Replace::Named),
                None => bench.type_path_to_save(),
            },
        );
    }

    /// Asks where to export to: what is there now is written, whatever is open by then.
    pub(crate) fn choose_where_to_export(&mut self, what: What) {
        if self.needs_picture(what) {
            return self.wait_for_picture(move |bench| bench.choose_where_to_export(what));
        }
        let Some(write) = self.prepared(what) else {
            return;
        };
        let path = self.placed(self.name_of(what).as_ref());
        let ask = move || files::choose_to_export(what, &path);
        self.choose(say!("waiting for a file name"), ask, move |bench, path| {
            if let Some(path) = path {
                // The dialog has asked.
                return write(bench, path, true);
            }
            let path = bench.placed(bench.name_of(what).as_ref());
            bench.view.sheet = Some(Sheet::ExportPath {
                what,
                path: path.display().to_string(),
                replace: false,
            });
        });
    }

    /// Waits for the system's dialog, of which there is one at a time.
    pub(super) fn choose(
        &mut self,
        what: &str,
        ask: impl FnOnce() -> Option<PathBuf> + Send + 'static,
        then: impl FnOnce(&mut Self, Option<PathBuf>) + Send + 'static,
    ) {
        if self.asking().is_some() {
            return;
        }
        let instead = self.chooser.clone();
        let ask = move || instead.map_or_else(ask, |chosen| chosen());
        self.jobs.start(Kind::Asks, what, move |_| ask(), then);
    }

    /// The dialog of the system that is open: until it is answered the window takes no commands.
    pub(crate) fn asking(&self) -> Option<&Running> {
        self.jobs.running(Kind::Asks)
    }

    /// Goes on without an answer: a dialog that the system does not show must not hold the window for ever.
    pub(crate) fn stop_asking(&mut self) {
        self.cancel_pending_action();
        self.jobs.cancel(|kind| kind == Kind::Asks);
    }

    /// Takes this for the answer of every dialog of the system.
    pub(crate) fn choose_by(&mut self, chooser: Chooser) {
        self.chooser = Some(chooser);
    }
}

/// Cancelled, or there is no dialog on this system.
pub(super) fn no_file_was_chosen() -> Message {
    Message::done(
        say!("No file was chosen").to_owned(),
        vec![say!("If no dialog appeared, drop the file on the window, or type its path in the Session step").to_owned()],
    )
}
