//! What is done in the background, and what becomes of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::core::answer::Question;
use crate::gui::core::document::ExportChoice;
use crate::gui::files::{self, Opened};
use crate::gui::jobs::{Kind, Running};
use crate::gui::view::{Message, What};
use crate::gui::workbench::{Exported, Workbench};

impl Workbench {
    /// The search that is under way.
    pub(crate) fn searching(&self) -> Option<&Running> {
        self.jobs.running(Kind::Searches)
    }

    /// Takes what was done in the background. Whether there was anything.
    pub(crate) fn receive(&mut self) -> bool {
        let mut any = false;
        loop {
            let arrived = self.jobs.poll();
            if arrived.is_empty() {
                return any;
            }
            any = true;
            for (kind, outcome) in arrived {
                self.execute(|bench| match outcome {
                    Some(take) => take(bench),
                    None => bench.broke_off(kind),
                });
            }
        }
    }

    /// Stops the search. The names that it had found until then stay in sight, and a diagnosis that was complete
    /// stays what it was: what is stopped half-way answers nothing.
    pub(crate) fn stop_search(&mut self) {
        let found = self.jobs.running(Kind::Searches).map(Running::found);
        self.jobs.cancel(|kind| kind == Kind::Searches);
        let searched = self.derived.searching.take();
        self.derived.stopped = searched.zip(found);
    }

    /// Stops the search where it is about other samples than those that are here now, or what it began from was
    /// undone.
    pub(super) fn stop_search_of_others(&mut self) {
        let here =
            |searched| Arc::ptr_eq(searched, self.loaded_session()) && self.document().identified;
        let searched = self.derived.searching.as_ref();
        if searched.is_some_and(|one| !here(one)) {
            self.stop_search();
            let title = say!("The diagnosis was stopped: what it was about has changed").to_owned();
            let again = say!("Run diagnosis again").to_owned();
            self.view.message = Some(Message::done(title, vec![again]));
        }
    }

    /// Names that a search of the open session had found when it was stopped.
    pub(crate) fn stopped(&self) -> Option<&[String]> {
        let (loaded_session, found) = self.derived.stopped.as_ref()?;
        Arc::ptr_eq(loaded_session, self.loaded_session()).then_some(found)
    }

    /// Drops the newest job that the status bar names; what was to be done after it is not wanted any more either.
    pub(crate) fn cancel_newest(&mut self) {
        self.cancel_pending_action();
        if self
            .jobs
            .newest()
            .is_some_and(|job| job.kind == Kind::Searches)
        {
            return self.stop_search();
        }
        if let Some(kind) = self.jobs.cancel(Kind::has_a_name) {
            self.decline(kind);
        }
    }

    /// Nothing comes of a job of this kind.
    fn decline(&mut self, kind: Kind) {
        match kind {
            Kind::Identifies => self.derived.identified.decline(),
            Kind::Prepares => self.derived.preview.decline(),
            Kind::Searches => self.derived.searching = None,
            Kind::Quiet => {
                self.derived.heat.decline();
                self.derived.figures.decline();
                self.derived.sketches.decline();
                self.derived.chart.decline();
                self.derived.on_disk.decline();
                self.derived.recovery.decline();
            }
            _ => {}
        }
    }

    /// Gives the memory of what was worked out before back elsewhere: with many samples that takes
    /// longer than a frame may.
    pub(super) fn let_go(&mut self, before: Option<impl Send + 'static>) {
        const MANY: usize = 100_000;
        if before.is_some() && self.loaded_session().len() > MANY {
            self.jobs.quietly(move || drop(before), |_, ()| ());
        }
    }

    pub(super) fn take_opened(&mut self, opened: Result<Opened, Message>) {
        match opened {
            Ok(Opened::Session(loaded_session)) => {
                self.replace(|document| document.open(loaded_session));
            }
            Ok(Opened::Foreign(draft)) => self.ask_about(draft),
            Ok(Opened::Model(given)) => {
                let beside = self.has_a_session_for(&given);
                self.replace(|document| document.open_model(given, beside));
            }
            Err(message) => self.take_written(message),
        }
    }

    /// A table or a model was written, of the answer to this question, or not.
    pub(super) fn take_exported(&mut self, message: Message, of: Question, choice: ExportChoice) {
        if let Some(path) = message.file.clone() {
            let exported = &mut self.file_state.exported;
            exported.retain(|other| other.path != path);
            exported.push(Exported { path, of, choice });
        }
        self.take_written(message);
    }

    /// Something was written, or not: what was to be done then is done, or is not.
    pub(super) fn take_written(&mut self, message: Message) {
        let written = !message.wrong;
        self.view.message = Some(message);
        if written {
            self.resume();
        } else {
            self.cancel_pending_action();
        }
    }

    /// Opens a file, or a folder, with the system's program for it.
    pub(crate) fn open_outside(&mut self, path: PathBuf) {
        self.jobs.quietly(
            move || files::open_outside(&path).map_err(|because| (path, because)),
            |bench: &mut Self, opened| {
                if let Err((path, because)) = opened {
                    let title = say!("{path} was not opened", path = path.display());
                    bench.complain(&title, vec![because]);
                }
            },
        );
    }

    /// What was worked out is about another session than the one that is open now, and is not taken.
    pub(super) fn is_of_another(&mut self, title: &str) {
        self.complain(
            title,
            [say!(
                "The session is another one now: ask for it again where it is still wanted"
            )],
        );
    }

    fn broke_off(&mut self, kind: Kind) {
        self.decline(kind);
        self.complain(
            say!("Something went wrong inside the program"),
            [say!(
                "Nothing was changed; save your work, and please report what you did last"
            )],
        );
    }

    // Dialogs of the system in which a file is chosen, one at a time.

    /// Asks for a file to open.
    pub(crate) fn choose_file(&mut self, ask: fn(Option<&Path>) -> Option<PathBuf>) {
        self.choose_near(ask, Self::open_file);
    }

    /// Asks for something beside the file in hand, or the latest.
    pub(super) fn choose_near(
        &mut self,
        ask: fn(Option<&Path>) -> Option<PathBuf>,
        then: impl FnOnce(&mut Self, PathBuf) + Send + 'static,
    ) {
        let near = self.file().map(Path::to_path_buf);
        let near = near.or_else(|| Some(self.recent().next()?.clone()));
        self.choose(move || ask(near.as_deref()), |bench, path| match path {
            Some(path) => then(bench, path),
            // Cancelled, or there is no dialog on this system: the two look alike.
            None => bench.view.message = Some(Message::done(
                say!("No file was chosen"),
                vec![say!("If no dialog appeared, drop the file on the window, or type its path in the Session step").to_owned()],
            )),
        });
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
        let proposed = path.clone();
        let ask = move || files::choose_to_export(what, &path);
        self.choose(ask, move |bench, path| match path {
            // The dialog has asked.
            Some(path) => write(bench, path, true),
            None => bench.type_path(what, &proposed),
        });
    }

    /// Waits for the system's dialog, of which there is one at a time.
    pub(super) fn choose(
        &mut self,
        ask: impl FnOnce() -> Option<PathBuf> + Send + 'static,
        then: impl FnOnce(&mut Self, Option<PathBuf>) + Send + 'static,
    ) {
        if self.asking().is_some() {
            return;
        }
        let instead = self.chooser.clone();
        let ask = move || instead.map_or_else(ask, |chosen| chosen());
        let what = say!("waiting for a file to be chosen");
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
}
