//! Files: where an opening stands on the disk, what changed there, and what outlives the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::core::disk::{FileChange, Fingerprint};
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::file_state::recovery::{self, LeftBehind, RecoveryFile, SavedDocument};
use crate::gui::file_state::{self, Settings};
use crate::gui::files::{self, NotSaved, Opened, Replace, Saved};
use crate::gui::jobs::{Kind, Running, Watch};
use crate::gui::view::{Message, NextAction, OnDisk, Sheet, What};
use crate::gui::workbench::{Place, Workbench};

impl Workbench {
    /// Keeps preferences, recent files and what is not saved in this folder, and looks what it
    /// holds.
    pub(crate) fn at_home(&mut self, home: PathBuf) {
        let (settings, damaged) = file_state::read(&home).unwrap_or_else(|error| {
            let says = say!("{error}; they are left as they are", error);
            (Settings::default(), Some(says))
        });
        self.view.preferences = settings.preferences;
        self.file_state.settings = settings;
        let keeper = RecoveryFile::new(&home);
        let mut details = Vec::new();
        details.extend(damaged.map(|says| say!("Preferences could not be read: {says}", says)));
        match keeper {
            Ok(keeper) => self.file_state.recovery_file = Some(keeper),
            Err(error) => details.push(say!(
                "What is not saved cannot be kept against a crash: {home}: {error}",
                home = home.display(),
                error
            )),
        }
        if !details.is_empty() {
            self.complain(say!("Not everything could be set up"), details);
        }
        self.look_at_disk();
        self.file_state.home = Some(home);
        self.look_for_left_behind();
    }

    /// Leaves nothing behind: the window closes as it should.
    pub(crate) fn tidy(&mut self) {
        if let Some(keeper) = self.file_state.recovery_file.take() {
            keeper.tidy();
        }
    }

    /// Recent files that are there, newest first.
    pub(crate) fn recent(&self) -> impl Iterator<Item = &PathBuf> {
        let there = |path: &&PathBuf| !self.file_state.missing.contains(path);
        self.file_state.settings.recent.iter().filter(there)
    }

    /// What a window that is gone has left behind.
    pub(crate) fn left_behind(&self) -> Option<&LeftBehind> {
        self.file_state.left_behind.as_ref()
    }

    /// Where the session stands on the disk.
    fn place(&self) -> Option<&Place> {
        self.file_state.places.get(&self.loaded_session().lineage)
    }

    /// The file that the session stands in.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.place()?.path.as_deref()
    }

    /// The folder where new files of what is open belong: beside its own file, or beside the one
    /// that it came from.
    pub(crate) fn folder(&self) -> Option<PathBuf> {
        let came_from = match &self.loaded_session().origin {
            Origin::File(path) | Origin::Imported(path) | Origin::Model(path) => Some(path),
            Origin::Recovered(path) => path.as_ref(),
            Origin::Bundled | Origin::Simulated => None,
        };
        let given = self
            .document()
            .loaded_model
            .as_ref()
            .map(|given| &given.path);
        let near = self.file().or(came_from.or(given).map(PathBuf::as_path))?;
        std::path::absolute(near).ok()?.parent().map(PathBuf::from)
    }

    /// Where a file of this name is written, wherever the program was started.
    pub(crate) fn placed(&self, name: &Path) -> PathBuf {
        match self.folder() {
            Some(folder) => folder.join(name),
            None => std::path::absolute(name).unwrap_or_else(|_| name.to_path_buf()),
        }
    }

    /// Where the session is saved unless the user says otherwise.
    pub(crate) fn proposed_path(&self) -> PathBuf {
        match self.file() {
            Some(own) => std::path::absolute(own).unwrap_or_else(|_| own.to_path_buf()),
            None => self.placed(files::file_name_for(&self.loaded_session().session).as_ref()),
        }
    }

    /// Opens the sheet on which a path to write to is typed.
    pub(crate) fn type_path(&mut self, what: What) {
        let path = self.placed(self.name_of(what).as_ref());
        self.view.sheet = Some(Sheet::Path {
            what,
            path: path.display().to_string(),
            replace: false,
        });
    }

    /// The file with its samples, if they are in one.
    pub(crate) fn samples_file(&self) -> Option<&Path> {
        self.place().and_then(|place| place.samples.as_deref())
    }

    /// What is open stands in these files, or needs none.
    pub(super) fn stands_at(
        &mut self,
        path: Option<PathBuf>,
        files: Vec<Fingerprint>,
        samples: Option<PathBuf>,
    ) {
        let document = Arc::clone(self.history.present());
        let lineage = document.loaded_session.lineage;
        let place = Place {
            path,
            document,
            files,
            samples,
        };
        self.file_state.places.insert(lineage, place);
    }

    /// A session or a model was opened.
    pub(super) fn opened(&mut self) {
        let loaded_session = Arc::clone(self.loaded_session());
        match &loaded_session.origin {
            Origin::File(path) => {
                let (files, samples) = (&loaded_session.files, &loaded_session.samples_file);
                self.stands_at(Some(path.clone()), files.clone(), samples.clone());
                self.use_recent(path.clone());
            }
            Origin::Bundled | Origin::Model(_) => self.stands_at(None, Vec::new(), None),
            Origin::Simulated | Origin::Recovered(_) | Origin::Imported(_) => {}
        }
        self.arrived();
    }

    /// Another opening is looked at now: what was made of the one before is none of its.
    pub(super) fn arrived(&mut self) {
        self.derived.compensated = None;
        self.file_state.saved_as = None;
        if let Some(Sheet::Path { .. } | Sheet::COMPENSATION) = self.view.sheet {
            self.view.sheet = None;
            self.cancel_pending_action();
        }
        self.forget_looks();
        self.look_at_disk();
    }

    /// What is known of the files is not what it was: a look that is under way says nothing any more, and what was
    /// dismissed is said again.
    pub(super) fn forget_looks(&mut self) {
        self.file_state.look += 1;
        self.file_state.dismissed = None;
        self.view.on_disk = None;
    }

    /// This file was opened or saved.
    pub(crate) fn use_recent(&mut self, path: PathBuf) {
        // Seen from another folder tomorrow, it has to be the same file.
        let path = std::path::absolute(&path).unwrap_or(path);
        self.keep(move |kept| file_state::use_recent(&mut kept.recent, path.clone()));
        self.look_at_disk();
    }

    /// Reads the session's file again. Undo brings back what was here.
    pub(crate) fn reload(&mut self) {
        self.view.on_disk = None;
        let Some((path, files)) = self
            .place()
            .and_then(|place| Some((place.path.clone()?, place.files.clone())))
        else {
            return;
        };
        self.file_state.then = None;
        self.view.sheet = None;
        let what = say!("reading {path}", path = path.display());
        let work = move |watch: &Watch| {
            // What is not there cannot be read again; it can be written again.
            match files.into_iter().find(|file| !file.path.exists()) {
                Some(gone) => Err(gone.path),
                None => Ok(files::open(&path, watch)),
            }
        };
        self.jobs.start(
            Kind::Opens,
            what,
            work,
            |bench: &mut Self, opened| match opened {
                Ok(opened) => bench.take_opened(opened),
                Err(path) => {
                    let change = FileChange::Vanished;
                    bench.view.on_disk = Some(OnDisk { path, change });
                }
            },
        );
    }

    /// Looks in the background whether the files of what is open are what they were, and which of the recent ones are
    /// there. What this window is writing itself is not looked at.
    pub(crate) fn look_at_disk(&mut self) {
        let own = self.place().filter(|_| self.writing().is_none());
        let files = own.map_or_else(Vec::new, |place| place.files.clone());
        let (number, recent) = (
            self.file_state.look,
            self.file_state.settings.recent.clone(),
        );
        let work = move || Looked {
            number,
            change: changed(&files),
            missing: recent.into_iter().filter(|path| !path.exists()).collect(),
        };
        self.jobs.quietly(work, Self::take_look);
    }

    pub(super) fn take_look(&mut self, looked: Looked) {
        self.file_state.missing = looked.missing;
        // Compared with what was known before this window opened or wrote a file.
        if looked.number == self.file_state.look {
            if looked.change.is_none() {
                self.file_state.dismissed = None;
            }
            let dismissed = &self.file_state.dismissed;
            self.view.on_disk = looked.change.filter(|now| Some(now) != dismissed.as_ref());
        }
    }

    /// Changes what outlives the window, here and in this user's folder, where there is one.
    pub(super) fn keep(&mut self, change: impl Fn(&mut Settings) + Send + 'static) {
        change(&mut self.file_state.settings);
        if let Some(home) = self.file_state.home.clone() {
            let work = move || file_state::change(&home, change).map_err(|e| e.to_string());
            self.jobs.quietly(work, Self::take_kept);
        }
    }

    pub(super) fn take_kept(&mut self, kept: Result<(), String>) {
        if let Err(because) = kept {
            self.complain(
                say!("Not everything could be saved for recovery"),
                vec![
                    because,
                    say!("The session is as it was; save it under a name of your own").to_owned(),
                ],
            );
        }
    }
}

/// What a look at the disk has found.
pub(super) struct Looked {
    /// That of the look, by which one that is out of date is known.
    pub(super) number: u64,
    pub(super) change: Option<OnDisk>,
    pub(super) missing: Vec<PathBuf>,
}

/// The first file that is not there any more, else the first that is not what it was.
fn changed(files: &[Fingerprint]) -> Option<OnDisk> {
    let looked = files.iter().filter_map(|file| {
        let (path, change) = (file.path.clone(), file.look()?);
        Some(OnDisk { path, change })
    });
    looked.min_by_key(|now| now.change == FileChange::Changed)
}

// What is not saved: what would be lost, what is asked before it is, and how it is saved; how it is kept
// against a crash, and comes back.

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
        let same = |Place {
                        document: saved, ..
                    }: &Place| {
            now.regions == saved.regions
                && now.tolerance_mm == saved.tolerance_mm
                && Arc::ptr_eq(&now.loaded_session, &saved.loaded_session)
        };
        !self.place().is_some_and(same)
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
                && asked.is_some()
                && asked != self.file_state.model_on_file,
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
            self.file_state.then = Some(then);
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
                self.open(say!("reading an example"), move |_| {
                    files::open_example(index)
                });
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
        let form = sheet.filter(|sheet| **sheet != Sheet::COMPENSATION);
        if form.is_some_and(Sheet::holds_entries) {
            return self.complain(
                say!("What was dropped is not opened over a form"),
                [say!("Finish or cancel the form, then drop the file again")],
            );
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
            several => self.complain(
                &say!("{count} files were dropped: none was opened", count = several.len()),
                [say!("Drop one at a time: a session, a model, a robot program, or a table of measurements")],
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
        self.file_state.then = Some(then);
        self.file_state.saves_all = true;
        if self.at_risk().session {
            self.save();
        } else {
            self.choose_where_to_export(What::Model);
        }
    }

    /// Something was written: what was to be done then. Where all was to be saved first, that is what comes next.
    pub(super) fn resume(&mut self) {
        let saves = std::mem::take(&mut self.file_state.saves_all);
        match self.file_state.then.take() {
            Some(then) if saves && self.at_risk().any() => self.save_then(then),
            Some(then) => self.ask_then(then),
            None => {}
        }
    }

    /// What was to be done after saving is not done.
    pub(super) fn cancel_pending_action(&mut self) {
        self.file_state.then = None;
        self.file_state.saves_all = false;
    }

    /// Saves to the session's own file, or asks for one.
    pub(crate) fn save(&mut self) {
        match self.file().map(Path::to_path_buf) {
            Some(path) => self.save_to(&path, Replace::Own),
            None => self.choose_where_to_export(What::Session),
        }
    }

    /// The same, although the file changed since it was read.
    pub(crate) fn save_despite(&mut self) {
        if let Some(path) = self.file().map(Path::to_path_buf) {
            self.save_to(&path, Replace::Whatever);
        }
    }

    /// Saves what is open to a file.
    fn save_to(&mut self, path: &Path, replace: Replace) {
        if self.prepared(What::Session).is_some() {
            self.save_document(Arc::clone(self.history.present()), path, replace);
        }
    }

    /// Saves this to a file.
    pub(super) fn save_document(&mut self, document: Arc<Document>, path: &Path, replace: Replace) {
        self.view.sheet = None;
        let known = self.file_state.places.get(&document.loaded_session.lineage);
        let known = known.map_or_else(Vec::new, |place| place.files.clone());
        let (what, path) = (
            say!("saving {path}", path = path.display()),
            path.to_path_buf(),
        );
        self.forget_looks();
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
                self.look_at_disk();
                self.cancel_pending_action();
                self.view.message = Some(message);
            }
            Ok(prints) => {
                let samples = prints.get(1).map(|print| print.path.clone());

                let lineage = document.loaded_session.lineage;
                let place = Place {
                    path: Some(path.clone()),
                    document,
                    files: prints,
                    samples,
                };
                self.file_state.places.insert(lineage, place);
                self.forget_looks();
                let mut details = Vec::new();
                if self.at_risk().model {
                    details.push(
                        say!("What was identified is not in it: “Save model…” keeps that")
                            .to_owned(),
                    );
                }
                self.view.message = Some(Message::saved(&path, details));
                self.use_recent(path);
                self.resume();
            }
        }
    }
}

impl Workbench {
    /// Whether recovery lags behind the document.
    pub(crate) fn recovery_lags(&self) -> bool {
        let now = self.history.present();
        let kept = self.file_state.kept.as_ref();
        self.file_state.recovery_file.is_some()
            && match (kept, self.at_risk().any()) {
                (Some(kept), true) => !Arc::ptr_eq(kept, now),
                (kept, at_risk) => kept.is_some() != at_risk,
            }
    }

    /// Writes what is not saved to this window's recovery file, or removes it where all is saved.
    pub(crate) fn keep_recovery(&mut self) {
        let Some(path) = self
            .file_state
            .recovery_file
            .as_ref()
            .map(|k| k.path().to_path_buf())
        else {
            return;
        };
        if !self.recovery_lags() {
            return;
        }
        if !self.at_risk().any() {
            self.file_state.kept = None;
            let work = move || drop(std::fs::remove_file(&path));
            self.jobs.quietly(work, |_, ()| ());
            return;
        }
        let document = Arc::clone(self.history.present());
        self.file_state.kept = Some(Arc::clone(&document));
        let file = self.file().map(Path::to_path_buf);
        let work = move || {
            let written = recovery::write(&path, &SavedDocument::of(&document, file));
            written.map_err(|e| e.to_string())
        };
        self.jobs.quietly(work, Self::take_kept);
    }

    /// Looks for what windows that are gone have left behind, and offers it.
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
                        bench.view.sheet = Some(Sheet::RECOVERY);
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
        let mut session = kept.session;
        let file = kept.about.file;
        session.path.clone_from(&file);
        let origin = Origin::Recovered(file);
        let loaded_session = Arc::new(LoadedSession::new(session, Vec::new(), origin));
        self.edit(phrase!("restore"), |document| {
            document.recover(loaded_session, &kept.about.choices);
            Ok(())
        });
        // It is this window's from now on.
        if let Some(other) = self.file_state.recovery_file.replace(own) {
            other.tidy();
        }
        self.file_state.kept = None;
        self.keep_recovery();
        self.view.message = Some(Message::done(
            say!("Restored; it is not saved yet").to_owned(),
            Vec::new(),
        ));
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
