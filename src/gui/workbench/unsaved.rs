//! What is not saved: what would be lost, what is asked before it is, and how it is saved; how it is kept
//! against a crash, and comes back.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::core::disk::EXAMPLES;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::file_state::recovery::{self, LeftBehind, SavedDocument};
use crate::gui::files::{self, NotSaved, Opened, Replace, Saved};
use crate::gui::jobs::{Kind, Running, Watch};
use crate::gui::view::{Message, NextAction, Sheet, What};
use crate::gui::workbench::{Place, Workbench};

/// What would be lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Losses {
    /// The session, or changes of it.
    pub(crate) session: bool,
    pub(crate) model: bool,
}

impl Losses {
    /// Whether there is something.
    pub(crate) fn any(self) -> bool {
        self.session || self.model
    }
}

impl Workbench {
    /// Whether something would be lost that a session's file can hold.
    pub(crate) fn unsaved(&self) -> bool {
        let now = self.document();
        if now.loaded_session.is_empty() {
            return false;
        }
        let same = |saved: &Document| {
            now.regions == saved.regions
                && now.tolerance_mm == saved.tolerance_mm
                && Arc::ptr_eq(&now.loaded_session, &saved.loaded_session)
        };
        !self.place().is_some_and(|place| same(&place.document))
    }

    /// What would be lost if the session were closed now. The session that the window began with
    /// is an example: what was tried on it can be tried again.
    pub(crate) fn at_risk(&self) -> Losses {
        let document = self.document();
        let example = self.loaded_session().lineage == self.first.lineage
            || self.loaded_session().origin == Origin::Bundled;
        let asked = self.question().filter(|_| document.loaded_model.is_none());
        Losses {
            session: self.unsaved(),
            model: !example
                && self.answer().is_some()
                && asked.is_some_and(|asked| {
                    self.file_state.exported.iter().all(|one| one.of != asked)
                }),
        }
    }

    /// The file that is being written.
    pub(crate) fn writing(&self) -> Option<&Running> {
        self.jobs.running(Kind::Writes)
    }

    /// Does it, unless something would be lost: then asks first.
    pub(crate) fn ask_then(&mut self, then: NextAction) {
        if let (NextAction::Leave, Some(writing)) = (&then, self.writing()) {
            // Leaving does not depend on a file being chosen.
            let title = say!(
                "The window closes when this is done: {what}",
                what = writing.what
            );
            self.view.message = Some(Message::done(title, Vec::new()));
            let all = matches!(self.file_state.then, Some((_, true)));
            self.file_state.then = Some((then, all));
            return;
        }
        if self.at_risk().any() {
            self.view.sheet = Some(Sheet::Unsaved(then));
        } else {
            self.go(then);
        }
    }

    pub(crate) fn go(&mut self, then: NextAction) {
        self.file_state.then = None;
        self.view.sheet = None;
        match then {
            NextAction::Leave => self.view.leaving = true,
            NextAction::Open(path) => {
                let what = say!("reading {path}", path = path.display());
                self.open(what, move |watch| files::open(&path, watch));
            }
            NextAction::Example(index) => {
                let what = say!("reading {path}", path = EXAMPLES[index].name());
                self.open(what, move |_| files::open_example(index));
            }
            NextAction::Simulate(form) => {
                self.open(say!("simulating"), move |watch| {
                    files::simulate(&form, watch)
                });
            }
        }
    }

    /// Opens what was dropped: one file, or a session with its samples.
    pub(crate) fn drop_files(&mut self, mut paths: Vec<PathBuf>) {
        if self.asking().is_some() {
            return;
        }
        // Beside targets that are shown, others may be dropped.
        let sheet = self.view.sheet.as_ref();
        let form = sheet.filter(|sheet| **sheet != Sheet::Compensation);
        if form.is_some_and(Sheet::holds_entries) {
            let first = say!("Finish or cancel the form, then drop the file again");
            return self.complain(first, None::<&str>);
        }
        let is_document = |path: &&PathBuf| {
            let ending = path.extension();
            ending.is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
        };
        let session = paths.iter().find(is_document).cloned();
        if let Some(session) = session {
            paths.retain(|path| *path == session || path.file_stem() != session.file_stem());
        }
        match &paths[..] {
            [] => {}

            [file] => self.open_file(file.clone()),
            _ => self.complain(
                say!("Drop one file at a time: a session, a model, a robot program, or a table of measurements"),
                None::<&str>,
            ),
        }
    }

    /// Brings another session.
    pub(super) fn open(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Result<Opened, Message> + Send + 'static,
    ) {
        self.jobs.start(Kind::Opens, what, work, Self::take_opened);
    }

    /// Saves what would be lost, then does it.
    pub(crate) fn save_then(&mut self, then: NextAction) {
        self.view.sheet = None;
        self.file_state.then = Some((then, true));
        if self.at_risk().session {
            self.save();
        } else {
            self.choose_where_to_export(What::Model);
        }
    }

    /// Something was written: what was to be done then. Where all was to be saved first, that is what comes next.
    pub(super) fn resume(&mut self) {
        match self.file_state.then.take() {
            Some((then, true)) if self.at_risk().any() => self.save_then(then),
            Some((then, _)) => self.ask_then(then),
            None => {}
        }
    }

    /// What was to be done after saving is not done.
    pub(super) fn cancel_pending_action(&mut self) {
        self.file_state.then = None;
    }

    /// Saves to the session's own file, or asks for one.
    pub(crate) fn save(&mut self) {
        self.save_over(Replace::Own);
    }

    /// The same, although the file changed since it was read.
    pub(crate) fn save_despite(&mut self) {
        self.save_over(Replace::Whatever);
    }

    fn save_over(&mut self, replace: Replace) {
        match self.file().map(Path::to_path_buf) {
            Some(path) => self.save_document(Arc::clone(self.history.present()), &path, replace),
            None => self.choose_where_to_export(What::Session),
        }
    }

    /// Saves this to a file.
    pub(super) fn save_document(&mut self, document: Arc<Document>, path: &Path, replace: Replace) {
        self.view.sheet = None;
        let known = self.file_state.places.get(&document.loaded_session.lineage);
        let known = known.map_or_else(Vec::new, |place| place.files.clone());
        let (what, path) = (
            say!("writing {path}", path = path.display()),
            path.to_path_buf(),
        );
        let work = move |watch: &Watch| files::save(document, &path, replace, known, watch);
        self.jobs.start(Kind::Writes, what, work, Self::take_saved);
    }

    pub(super) fn take_saved(&mut self, saved: Saved) {
        let Saved {
            document,
            path,
            result,
        } = saved;
        match result {
            Err(NotSaved::Changed(changed)) => {
                self.view.sheet = Some(Sheet::Overwrite(changed));
            }
            Err(NotSaved::Because(message)) => {
                self.cancel_pending_action();
                self.view.message = Some(message);
            }
            Ok(prints) => {
                let lineage = document.loaded_session.lineage;
                let place = Place {
                    document,
                    files: prints,
                };
                self.file_state.places.insert(lineage, place);
                let says = say!("What was identified is not in it: “Save model…” keeps that");
                let details = self.at_risk().model.then(|| says.to_owned());
                self.view.message = Some(Message::saved(&path, Vec::from_iter(details)));
                self.use_recent(path);
                self.resume();
            }
        }
    }

    /// Keeps what is not saved in this window's recovery file, or removes it where all is saved: once a gesture is over.
    pub(crate) fn keep_recovery(&mut self) {
        let keeper = self.file_state.recovery_file.as_ref();
        let Some(keeper) = keeper.filter(|_| !self.dragging) else {
            return;
        };
        let path = keeper.path().to_path_buf();
        let at_risk = self.at_risk().any();
        let document = at_risk.then(|| Arc::clone(self.history.present()));
        if !self.derived.recovery.want(&document) {
            return;
        }
        let file = self.file().map(Path::to_path_buf);
        let work = move || {
            let kept = if let Some(document) = &document {
                recovery::write(&path, &SavedDocument::of(document, file))
            } else {
                let _ = std::fs::remove_file(&path);
                Ok(())
            };
            (document, kept.map_err(|e| e.to_string()))
        };
        self.jobs
            .quietly(work, |bench: &mut Self, (document, kept)| {
                bench.derived.recovery.take(document, ());
                bench.take_kept(kept);
            });
    }

    /// Looks for unsaved work of windows that ended without warning, and offers to restore it.
    pub(super) fn look_for_left_behind(&mut self) {
        let Some(home) = self.file_state.home.clone() else {
            return;
        };
        let work = move || recovery::left_behind(&home);
        self.jobs
            .quietly(work, |bench: &mut Self, left| match left {
                None => {}
                Some(Ok(left)) => {
                    bench.file_state.left_behind = Some(left);
                    if bench.view.sheet.is_none() {
                        bench.view.sheet = Some(Sheet::Recovery);
                    }
                }
                Some(Err((aside, because))) => {
                    bench.complain(
                        say!("What was left behind is damaged and cannot be restored"),
                        vec![
                            because,
                            say!("It is kept as {aside}", aside = aside.display()),
                        ],
                    );
                    bench.look_for_left_behind();
                }
            });
    }

    /// Brings back what was left behind.
    pub(crate) fn restore(&mut self) {
        self.view.sheet = None;
        let Some(LeftBehind { own, kept, .. }) = self.file_state.left_behind.take() else {
            return;
        };
        let SavedDocument { mut session, about } = kept;
        session.path.clone_from(&about.file);
        let origin = Origin::Recovered(about.file.clone());
        let loaded_session = Arc::new(LoadedSession::new(session, Vec::new(), origin));
        self.replace(|document| about.restore(document, loaded_session));
        // It is this window's from now on.
        if let Some(other) = self.file_state.recovery_file.replace(own) {
            other.tidy();
        }
        let title = say!("Restored; it is not saved yet");
        self.view.message = Some(Message::done(title, Vec::new()));
    }

    /// Discards what was left behind, and offers what is next.
    pub(crate) fn discard_left_behind(&mut self) {
        self.view.sheet = None;
        if let Some(left) = self.file_state.left_behind.take() {
            left.own.tidy();
        }
        self.look_for_left_behind();
    }
}
