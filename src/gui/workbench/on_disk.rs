//! Files: where an opening stands on the disk, what changed there, and what outlives the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::core::disk::{FileChange, Fingerprint};
use crate::gui::core::loaded_session::Origin;
use crate::gui::file_state::recovery::{LeftBehind, RecoveryFile};
use crate::gui::file_state::{self, Settings};
use crate::gui::files::{self};
use crate::gui::jobs::{Kind, Watch};
use crate::gui::view::{OnDisk, Sheet, What};
use crate::gui::workbench::answers::QUIETLY;
use crate::gui::workbench::{Look, Looked, Place, Workbench};

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
        self.file_state.home = Some(home);
        self.keep_watching();
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
        let looked = self.derived.on_disk.made();
        let there =
            move |path: &&PathBuf| !looked.is_some_and(|(_, now)| now.missing.contains(path));
        self.file_state.settings.recent.iter().filter(there)
    }

    /// What a window that is gone has left behind.
    pub(crate) fn left_behind(&self) -> Option<&LeftBehind> {
        self.file_state.left_behind.as_ref()
    }

    /// Where the session stands on the disk.
    pub(super) fn place(&self) -> Option<&Place> {
        self.file_state.places.get(&self.loaded_session().lineage)
    }

    /// The file that the session stands in.
    pub(crate) fn file(&self) -> Option<&Path> {
        Some(&self.place()?.files.first()?.path)
    }

    /// The folder where new files of what is open belong: beside its own file, or beside the one
    /// that it came from.
    pub(crate) fn folder(&self) -> Option<PathBuf> {
        let given = self.document().loaded_model.as_ref();
        let near = self.file().or(self.came_from());
        let near = near.or(given.map(|given| &*given.path))?;
        std::path::absolute(near).ok()?.parent().map(PathBuf::from)
    }

    /// The file that the session was read from.
    pub(crate) fn came_from(&self) -> Option<&Path> {
        match &self.loaded_session().origin {
            Origin::File(path) | Origin::Imported(path) | Origin::Model(path) => Some(path),
            Origin::Recovered(path) => path.as_deref(),
            Origin::Bundled | Origin::Simulated => None,
        }
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
    pub(crate) fn type_path(&mut self, what: What, path: &Path) {
        self.show_sheet(Some(Sheet::Path {
            what,
            path: path.display().to_string(),
            replace: false,
        }));
    }

    /// What is open stands in these files, or needs none.
    pub(super) fn stands_in(&mut self, files: Vec<Fingerprint>) {
        let document = Arc::clone(self.history.present());
        let lineage = document.loaded_session.lineage;
        self.file_state
            .places
            .insert(lineage, Place { document, files });
    }

    /// A session or a model was opened.
    pub(super) fn opened(&mut self) {
        let loaded_session = Arc::clone(self.loaded_session());
        match &loaded_session.origin {
            Origin::File(path) => {
                self.stands_in(loaded_session.files.clone());
                self.use_recent(path.clone());
            }
            Origin::Bundled | Origin::Model(_) => self.stands_in(Vec::new()),
            Origin::Simulated | Origin::Recovered(_) | Origin::Imported(_) => {}
        }
        self.arrived();
    }

    /// Another opening is looked at now: what was made of the one before is none of its.
    pub(super) fn arrived(&mut self) {
        self.derived.compensated = None;
        if let Some(Sheet::Path { .. } | Sheet::Compensation) = self.view.sheet {
            self.view.sheet = None;
            self.cancel_pending_action();
        }
        self.look_at_disk();
    }

    /// This file was opened or saved.
    pub(crate) fn use_recent(&mut self, path: PathBuf) {
        // Seen from another folder tomorrow, it has to be the same file.
        let path = std::path::absolute(&path).unwrap_or(path);
        self.keep(move |kept| file_state::use_recent(&mut kept.recent, path.clone()));
    }

    /// Reads the session's file again. Undo brings back what was here. What is not there cannot be read again, which a
    /// look at the disk says; it can be written again.
    pub(crate) fn reload(&mut self) {
        self.file_state.dismissed = None;
        self.look_at_disk();
        let files = self.place().map(|place| place.files.clone());
        let files = files.unwrap_or_default();
        let Some(path) = files.first().map(|file| file.path.clone()) else {
            return;
        };
        self.file_state.then = None;
        self.view.sheet = None;
        let what = say!("reading {path}", path = path.display());
        let work = move |watch: &Watch| {
            let there = files.iter().all(|file| file.path.exists());
            there.then(|| files::open(&path, watch))
        };
        self.jobs
            .start(Kind::Opens, what, work, |bench: &mut Self, opened| {
                if let Some(opened) = opened {
                    bench.take_opened(opened);
                }
            });
    }

    /// The disk may have changed: it is looked at once more.
    pub(crate) fn look_at_disk(&mut self) {
        self.file_state.looks += 1;
    }

    /// Compares the files of what is open with their fingerprints, and finds the recent ones that are missing, in the
    /// background.
    pub(super) fn keep_watching(&mut self) {
        let of = Look {
            number: self.file_state.looks,
            files: self.own_files().to_vec(),
            recent: self.file_state.settings.recent.clone(),
        };
        let look = |of: &Look, _: &Watch| Looked {
            change: changed(&of.files),
            missing: of.recent.iter().filter(|p| !p.exists()).cloned().collect(),
        };
        self.derive(QUIETLY, |derived| &mut derived.on_disk, of, look);
    }

    /// The files of what is open; what this window is writing itself is not looked at.
    fn own_files(&self) -> &[Fingerprint] {
        let own = self.place().filter(|_| self.writing().is_none());
        own.map_or(&[], |place| &place.files)
    }

    /// An open file that is not what it was, until that was read and put aside.
    pub(crate) fn on_disk(&self) -> Option<&OnDisk> {
        let (look, now) = self.derived.on_disk.made()?;
        let dismissed = self.file_state.dismissed.as_ref();
        let change = now.change.as_ref()?;
        let said = dismissed.is_some_and(|(files, what)| *files == look.files && what == change);
        // Compared with what was known before this window wrote a file it would say nothing of what is there now.
        (look.files == self.own_files() && !said).then_some(change)
    }

    /// Goes on with what is here, whatever is on the disk.
    pub(crate) fn keep_mine(&mut self) {
        let files = self.own_files().to_vec();
        self.file_state.dismissed = self.on_disk().map(|change| (files, change.clone()));
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

/// The first file that is not there any more, else the first that is not what it was.
fn changed(files: &[Fingerprint]) -> Option<OnDisk> {
    let looked = files.iter().filter_map(|file| {
        let (path, change) = (file.path.clone(), file.look()?);
        Some(OnDisk { path, change })
    });
    looked.min_by_key(|now| now.change == FileChange::Changed)
}
