//! Dialogs of the system in which a file is chosen, one at a time.

use std::path::{Path, PathBuf};

use crate::gui::files;
use crate::gui::jobs::{Kind, Running};
use crate::gui::view::{Message, What};
use crate::gui::workbench::{Chooser, Workbench};

impl Workbench {
    /// Asks for a file to open.
    pub(crate) fn choose_file(&mut self, ask: fn(Option<&Path>) -> Option<PathBuf>) {
        let says = say!("waiting for a file to be chosen");
        self.choose_near(says, ask, |bench, path| match path {
            Some(path) => bench.open_file(path),
            // Cancelled, or there is no dialog on this system: the two look alike.
            None => bench.view.message = Some(no_file_was_chosen()),
        });
    }

    /// Asks for something beside the file in hand, or the latest.
    pub(super) fn choose_near(
        &mut self,
        what: &str,
        ask: fn(Option<&Path>) -> Option<PathBuf>,
        then: impl FnOnce(&mut Self, Option<PathBuf>) + Send + 'static,
    ) {
        let near = self.file().map(Path::to_path_buf);
        let near = near.or_else(|| Some(self.recent().next()?.clone()));
        self.choose(what, move || ask(near.as_deref()), then);
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
            bench.type_path(what);
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
