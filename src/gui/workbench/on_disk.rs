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
        let came_from = match &self.loaded_session().origin {
            Origin::File(path) | Origin::Imported(path) | Origin::Model(path) => Some(path),
            Origin::Recovered(path) => path.as_ref(),
            Origin::Bundled | Origin::Simulated => None,
        };
        let given = self.document().loaded_model.as_ref();
        let other = came_from.or(given.map(|given| &given.path));
        let near = self.file().or(other.map(PathBuf::as_path))?;
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
    pub(crate) fn type_path(&mut self, what: What, path: &Path) {
        self.show_sheet(Some(Sheet::Path {
            what,
            path: path.display().to_string(),
            replace: false,
        }));
    }

    /// The file with its samples, if they are in one.
    pub(crate) fn samples_file(&self) -> Option<&Path> {
        Some(&self.place()?.files.get(1)?.path)
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
        self.file_state.saved_as = None;
        if let Some(Sheet::Path { .. } | Sheet::Compensation) = self.view.sheet {
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
        let files = self.place().map(|place| place.files.clone());
        let files = files.unwrap_or_default();
        let Some(path) = files.first().map(|file| file.path.clone()) else {
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
