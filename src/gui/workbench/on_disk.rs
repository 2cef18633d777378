//! Files: where an opening stands on the disk, what changed there, and what outlives the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::charts::find;
use crate::gui::core::disk::{FileChange, Fingerprint};
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::file_state::recovery::{self, OrphanedRecovery, RecoveryFile};
use crate::gui::file_state::watcher::{Order, Seen, Watched, Watcher};
use crate::gui::file_state::{self, Recent, Settings};
use crate::gui::files;
use crate::gui::jobs::{Jobs, Kind, Runner, Watch};
use crate::gui::view::{OnDisk, Sheet};

use super::state::Place;
use super::{Command, Workbench};

impl Workbench {
    /// Keeps preferences, recent files and what is not saved in this folder, and looks what it
    /// holds.
    pub(crate) fn at_home(&mut self, home: PathBuf) {
        let (settings, damaged) = file_state::read(&home);
        self.view.preferences = settings.preferences;
        self.view.panes = settings.panes.sound(|chart| find(chart).is_some());
        self.file_state.recent = settings.recent;
        self.file_state.machines = settings.machines;
        self.file_state.robots = settings.robots;
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
        self.order(Order::Recent(self.file_state.recent.clone()));
        let folder = home.clone();
        self.jobs
            .quietly(move || recovery::orphaned(&folder), Self::take_left_behind);
        self.file_state.home = Some(home);
    }

    /// Leaves nothing behind: the window closes as it should.
    pub(crate) fn tidy(&mut self) {
        if let Some(keeper) = self.file_state.recovery_file.take() {
            keeper.tidy();
        }
    }

    /// Recent files, newest first, and whether each is there.
    pub(crate) fn recent(&self) -> impl Iterator<Item = (&Path, bool)> {
        let missing = |path: &PathBuf| self.file_state.missing.contains(path);
        let recent = self.file_state.recent.iter();
        recent.map(move |path| (path.as_path(), !missing(path)))
    }

    /// What windows that are gone have left behind.
    pub(crate) fn orphaned(&self) -> &[OrphanedRecovery] {
        &self.file_state.orphaned
    }

    /// The file that the session stands in.
    pub(crate) fn file(&self) -> Option<&Path> {
        let place = self.file_state.places.get(&self.loaded_session().lineage);
        place.map(|place| place.path.as_path())
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

    /// Opens the sheet on which a path to save to is typed.
    pub(crate) fn typed_path(&self) -> Command {
        Command::sheet(Sheet::SavePath {
            path: self.proposed_path().display().to_string(),
            replace: false,
        })
    }

    /// The file with its samples, if they are in one: it can be followed.
    pub(crate) fn samples_file(&self) -> Option<&Path> {
        let place = self.file_state.places.get(&self.loaded_session().lineage);
        place.and_then(|place| place.samples.as_deref())
    }

    /// How many samples came since the file is followed; `None` where it is not.
    pub(crate) fn following(&self) -> Option<usize> {
        let here = self.file_state.followed == Some(self.loaded_session().lineage);
        here.then_some(self.file_state.came)
    }

    /// A session or a model was opened.
    pub(super) fn opened(&mut self) {
        let loaded_session = Arc::clone(self.loaded_session());
        let mut opened = None;
        match &loaded_session.origin {
            Origin::File(path) => {
                opened = Some(path.clone());
                let place = Place {
                    path: path.clone(),
                    files: loaded_session.files.clone(),
                    samples: loaded_session.samples_file.clone(),
                };
                self.file_state.places.insert(loaded_session.lineage, place);
                let path = path.clone();
                self.use_recent(Recent::Used(path));
                self.remember_on_file(Arc::clone(self.history.present()));
            }
            Origin::Bundled | Origin::Model(_) => {
                self.remember_on_file(Arc::clone(self.history.present()));
            }
            Origin::Simulated | Origin::Recovered(_) | Origin::Imported(_) => {}
        }
        self.arrived();
        self.follow_recording(opened.as_deref());
    }

    /// Another opening is looked at now.
    pub(super) fn arrived(&mut self) {
        self.view.on_disk = None;
        if self
            .file_state
            .followed
            .is_some_and(|f| f != self.loaded_session().lineage)
        {
            self.follow(false);
        }
        self.watch_files();
    }

    pub(super) fn watch_files(&mut self) {
        let place = self.file_state.places.get(&self.loaded_session().lineage);
        let files = place.map_or_else(Vec::new, |place| place.files.clone());
        self.watch_these(files);
    }

    /// Looks at no file while this window writes its own: what it writes is not a change by another
    /// program. A look that is under way already answers an order that is not the last one.
    pub(super) fn watch_nothing(&mut self) {
        self.watch_these(Vec::new());
    }

    fn watch_these(&mut self, files: Vec<Fingerprint>) {
        self.file_state.watch_order += 1;
        self.order(Order::Files(self.file_state.watch_order, files));
    }

    /// Keeps a change of the recent files.
    pub(super) fn use_recent(&mut self, recent: Recent) {
        // Seen from another folder tomorrow, it has to be the same file.
        let recent = match recent {
            Recent::Used(path) => Recent::Used(std::path::absolute(&path).unwrap_or(path)),
            forgotten @ Recent::Forgotten(_) => forgotten,
        };
        recent.apply(&mut self.file_state.recent);
        self.order(Order::Recent(self.file_state.recent.clone()));
        self.keep(move |kept| recent.apply(&mut kept.recent));
    }

    /// Keeps the preferences for tomorrow.
    pub(super) fn keep_preferences(&mut self) {
        let preferences = self.view.preferences;
        self.keep(move |kept| kept.preferences = preferences);
    }

    /// Reads the session's file again. Undo brings back what was here.
    pub(super) fn reload(&mut self) {
        self.view.on_disk = None;
        let Some(place) = self.file_state.places.get(&self.loaded_session().lineage) else {
            return;
        };
        let (path, files) = (place.path.clone(), place.files.clone());
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
                Err(gone) => {
                    let order = bench.file_state.watch_order;
                    bench.take_seen(Seen::FileChanged(order, gone, Some(FileChange::Vanished)));
                }
            },
        );
    }

    /// Begins to look at the disk, as jobs run.
    pub(super) fn watcher(jobs: &Jobs<Self>) -> Watcher {
        if jobs.runner() == Runner::AtOnce {
            return Watcher::Here(Watched::default());
        }
        let post = jobs.post();
        Watcher::on_thread(move |seen| post(Box::new(|bench: &mut Self| bench.take_seen(seen))))
    }

    /// Looks at something else on the disk from now on.
    pub(super) fn order(&mut self, order: Order) {
        let seen = self.watcher.order(order);
        self.post_seen(seen);
    }

    /// Looks at the disk now, where no thread does.
    pub(super) fn look_at_disk(&mut self) {
        let seen = self.watcher.look();
        self.post_seen(seen);
    }

    fn post_seen(&self, seen: impl IntoIterator<Item = Seen>) {
        let post = self.jobs.post();
        for seen in seen {
            post(Box::new(|bench: &mut Self| bench.take_seen(seen)));
        }
    }

    /// Whether the caller has to ask for a look at the disk from time to time.
    pub(crate) fn wants_looking(&self) -> bool {
        self.watcher.wants_looking()
    }

    pub(super) fn take_seen(&mut self, seen: Seen) {
        match seen {
            Seen::Missing(missing) => self.file_state.missing = missing,
            // Compared with what was known before this window wrote the file itself.
            Seen::FileChanged(order, ..) if order != self.file_state.watch_order => {}
            Seen::FileChanged(_, path, fate) => {
                let place = self.file_state.places.get(&self.loaded_session().lineage);
                let ours = place.is_some_and(|p| p.files.iter().any(|f| f.path == path));
                let shown = self.view.on_disk.as_ref();
                let same = shown.is_some_and(|shown| shown.path == path);
                let worse = shown.is_none_or(|shown| shown.change == FileChange::Changed);
                match fate {
                    Some(fate) if ours && (same || worse) => {
                        self.view.on_disk = Some(OnDisk { path, change: fate });
                    }
                    None if same => self.view.on_disk = None,
                    _ => {}
                }
            }
            Seen::Read(print) => {
                for place in self.file_state.places.values_mut() {
                    let same = place.files.iter_mut().find(|f| f.path == print.path);
                    if let Some(file) = same {
                        *file = print.clone();
                    }
                }
            }
            Seen::Grew(growth) => self.take_growth(*growth),
        }
    }

    /// Keeps something in this user's folder, where there is one.
    pub(super) fn keep(&mut self, change: impl FnOnce(&mut Settings) + Send + 'static) {
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

    /// Counts samples that came.
    pub(super) fn count_new(&mut self, samples: usize) {
        self.file_state.came += samples;
    }

    /// Begins or ends to count samples that come.
    pub(super) fn set_followed(&mut self, lineage: Option<u64>) {
        self.file_state.followed = lineage;
        self.file_state.came = 0;
    }

    /// Everything that stood in a file and was about `from` is about `to` now.
    pub(super) fn grow_on_file(&mut self, from: &Arc<LoadedSession>, to: &Arc<LoadedSession>) {
        for document in &mut self.file_state.on_file {
            if Arc::ptr_eq(&document.loaded_session, from) {
                let mut grown = Document::clone(document);
                grown.loaded_session = Arc::clone(to);
                *document = Arc::new(grown);
            }
        }
    }
}
