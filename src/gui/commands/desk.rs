//! Files: what is on the disk, what is not, what changed there, and what would be lost.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::document::{Document, Question};
use crate::gui::edit::Edit;
use crate::gui::files::{self, NotSaved, Replace, Saved};
use crate::gui::keeping::disk::{Fate, Print};
use crate::gui::keeping::recovery::{self, Keeper, Kept, LeftBehind};
use crate::gui::keeping::settings::{self, Recent};
use crate::gui::keeping::watcher::{Order, Seen};
use crate::gui::subject::{Origin, Subject};
use crate::gui::tasks::Report;
use crate::gui::view::{Message, OnDisk, Sheet, Then};

use super::{Command, Workbench};

/// Documents that are remembered as standing in a file.
const MOST_ON_FILE: usize = 64;

/// Where an opening stands on the disk.
#[derive(Debug, Clone)]
struct Place {
    path: PathBuf,
    /// As they looked when they were last read or written.
    files: Vec<Print>,
    samples: Option<PathBuf>,
}

/// See the module.
#[derive(Default)]
pub(super) struct Desk {
    home: Option<PathBuf>,
    keeper: Option<Keeper>,
    left_behind: Vec<LeftBehind>,
    /// Restored, and to be removed as soon as this window keeps it itself.
    restored: Vec<LeftBehind>,
    recent: Vec<PathBuf>,
    missing: Vec<PathBuf>,
    places: BTreeMap<u64, Place>,
    /// Documents that stand in a file, or need none.
    on_file: Vec<Arc<Document>>,
    /// What was asked of the model that was written last.
    model_on_file: Option<Question>,
    then: Option<Then>,
    /// The document as recovery has it.
    kept: Option<Arc<Document>>,
    /// The opening whose samples file is followed.
    pub(super) followed: Option<u64>,
    /// How many samples came while it was followed.
    came: usize,
}

/// What would be lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Losses {
    /// The session, or changes of it.
    pub(crate) session: bool,
    /// The model.
    pub(crate) model: bool,
}

impl Losses {
    /// Whether there is something.
    pub(crate) fn any(self) -> bool {
        self.session || self.model
    }
}

impl Workbench {
    /// Keeps preferences, recent files and what is not saved in this folder, and looks what it
    /// holds.
    pub(crate) fn at_home(&mut self, home: PathBuf) {
        let (settings, damaged) = settings::read(&home);
        self.view.preferences = settings.preferences;
        self.desk.recent = settings.recent;
        let keeper = Keeper::new(&home);
        let mut details = Vec::new();
        details.extend(damaged.map(|says| format!("Preferences could not be read: {says}")));
        match keeper {
            Ok(keeper) => self.desk.keeper = Some(keeper),
            Err(error) => details.push(format!(
                "What is not saved cannot be kept against a crash: {}: {error}",
                home.display()
            )),
        }
        if !details.is_empty() {
            self.complain("Not everything could be set up", details);
        }
        self.tasks.order(Order::Recent(self.desk.recent.clone()));
        let folder = home.clone();
        self.tasks
            .quietly(move || Report::LeftBehind(recovery::left_behind(&folder)));
        self.desk.home = Some(home);
    }

    /// Leaves nothing behind: the window closes as it should.
    pub(crate) fn tidy(&mut self) {
        if let Some(keeper) = self.desk.keeper.take() {
            keeper.tidy();
        }
    }

    /// Recent files, newest first, and whether each is there.
    pub(crate) fn recent(&self) -> impl Iterator<Item = (&Path, bool)> {
        let missing = |path: &PathBuf| self.desk.missing.contains(path);
        let recent = self.desk.recent.iter();
        recent.map(move |path| (path.as_path(), !missing(path)))
    }

    /// What windows that are gone have left behind.
    pub(crate) fn left_behind(&self) -> &[LeftBehind] {
        &self.desk.left_behind
    }

    /// The file that the session stands in.
    pub(crate) fn file(&self) -> Option<&Path> {
        let place = self.desk.places.get(&self.subject().lineage);
        place.map(|place| place.path.as_path())
    }

    /// The file with its samples, if they are in one: it can be followed.
    pub(crate) fn samples_file(&self) -> Option<&Path> {
        let place = self.desk.places.get(&self.subject().lineage);
        place.and_then(|place| place.samples.as_deref())
    }

    /// How many samples came since the file is followed; `None` where it is not.
    pub(crate) fn following(&self) -> Option<usize> {
        let here = self.desk.followed == Some(self.subject().lineage);
        here.then_some(self.desk.came)
    }

    /// Whether something would be lost that a session's file can hold.
    pub(crate) fn unsaved(&self) -> bool {
        let now = self.document();
        if now.subject.is_empty() {
            return false;
        }
        let same = |saved: &Arc<Document>| {
            now.regions == saved.regions
                && now.tolerance_mm == saved.tolerance_mm
                && Arc::ptr_eq(&now.subject, &saved.subject)
        };
        !self.desk.on_file.iter().any(same)
    }

    /// What would be lost if the session were closed now. The session that the window began with
    /// is an example: what was tried on it can be tried again.
    pub(crate) fn at_risk(&self) -> Losses {
        let document = self.document();
        let example = self.subject().lineage == self.first.lineage
            || self.subject().origin == Origin::Bundled;
        let asked = document.question().filter(|_| document.given.is_none());
        Losses {
            session: self.unsaved(),
            model: !example
                && self.answer().is_some()
                && asked.is_some()
                && asked != self.desk.model_on_file,
        }
    }

    /// Does it, unless something would be lost: then asks first.
    pub(super) fn ask_then(&mut self, then: Then) {
        if self.at_risk().any() {
            self.view.sheet = Some(Sheet::Unsaved(then));
        } else {
            self.go(then);
        }
    }

    /// Does it.
    pub(super) fn go(&mut self, then: Then) {
        self.desk.then = None;
        self.view.sheet = None;
        match then {
            Then::Leave => self.view.leaving = true,
            Then::Open(path) => {
                let what = format!("reading {}", path.display());
                self.tasks.start(what, move |_| files::open(&path));
            }
            Then::Example(index) => {
                self.tasks
                    .start("reading an example", move |_| files::open_example(index));
            }
            Then::Simulate(form) => {
                self.tasks
                    .start("simulating", move |watch| files::simulate(&form, watch));
            }
        }
    }

    /// Saves what would be lost, then does it.
    pub(super) fn save_then(&mut self, then: Then) {
        self.view.sheet = None;
        self.desk.then = Some(then);
        if self.at_risk().session {
            self.execute(Command::Save);
        } else {
            let what = crate::gui::tasks::What::Model;
            self.execute(Command::ChooseWhereToExport(what));
        }
    }

    /// Something was written: what was to be done then, if nothing else would be lost.
    pub(super) fn go_on(&mut self) {
        if let Some(then) = self.desk.then.take() {
            self.ask_then(then);
        }
    }

    /// What was to be done after saving is not done.
    pub(super) fn stay(&mut self) {
        self.desk.then = None;
    }

    /// Saves to the session's own file, or asks for one.
    pub(super) fn save_here(&mut self) {
        match self.file().map(Path::to_path_buf) {
            Some(path) => self.save_to(&path, Replace::Own),
            None => self.execute(Command::ChooseWhereToSave),
        }
    }

    /// Saves to a file.
    pub(super) fn save_to(&mut self, path: &Path, replace: Replace) {
        self.view.sheet = None;
        let document = Arc::clone(self.history.present());
        let known = self.desk.places.get(&document.subject.lineage);
        let known = known.map_or_else(Vec::new, |place| place.files.clone());
        let (what, path) = (format!("saving {}", path.display()), path.to_path_buf());
        self.tasks
            .start(what, move |_| files::save(document, &path, replace, known));
    }

    pub(super) fn take_saved(&mut self, saved: Saved) {
        let Saved {
            document,
            path,
            result,
        } = saved;
        match result {
            Err(NotSaved::Changed(changed)) => self.view.sheet = Some(Sheet::Overwrite(changed)),
            Err(NotSaved::Because(message)) => {
                self.stay();
                self.view.message = Some(message);
            }
            Ok(prints) => {
                let samples = prints.get(1).map(|print| print.path.clone());
                let place = Place {
                    path: path.clone(),
                    files: prints,
                    samples,
                };
                // What stood in its file before does not stand there any more.
                let lineage = document.subject.lineage;
                self.desk.on_file.retain(|d| d.subject.lineage != lineage);
                self.remember_on_file(document);
                self.desk.places.insert(lineage, place);
                self.view.on_disk = None;
                self.watch_files();
                self.use_recent(Recent::Used(path.clone()));
                self.view.message = Some(Message {
                    wrong: false,
                    title: format!("Saved {}", path.display()),
                    details: Vec::new(),
                });
                self.go_on();
            }
        }
    }

    pub(super) fn remember_on_file(&mut self, document: Arc<Document>) {
        self.desk.on_file.push(document);
        if self.desk.on_file.len() > MOST_ON_FILE {
            self.desk.on_file.remove(0);
        }
    }

    /// The model stands in a file.
    pub(super) fn model_is_on_file(&mut self) {
        self.desk.model_on_file = self.document().question();
    }

    /// A session or a model was opened.
    pub(super) fn opened(&mut self) {
        let subject = Arc::clone(self.subject());
        match &subject.origin {
            Origin::File(path) => {
                let place = Place {
                    path: path.clone(),
                    files: subject.files.clone(),
                    samples: subject.samples_file.clone(),
                };
                self.desk.places.insert(subject.lineage, place);
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
    }

    /// Another opening is looked at now.
    pub(super) fn arrived(&mut self) {
        self.view.on_disk = None;
        if self
            .desk
            .followed
            .is_some_and(|f| f != self.subject().lineage)
        {
            self.follow(false);
        }
        self.watch_files();
    }

    fn watch_files(&mut self) {
        let place = self.desk.places.get(&self.subject().lineage);
        let files = place.map_or_else(Vec::new, |place| place.files.clone());
        self.tasks.order(Order::Files(files));
    }

    /// Keeps a change of the recent files.
    pub(super) fn use_recent(&mut self, recent: Recent) {
        // Seen from another folder tomorrow, it has to be the same file.
        let recent = match recent {
            Recent::Used(path) => Recent::Used(std::path::absolute(&path).unwrap_or(path)),
            forgotten @ Recent::Forgotten(_) => forgotten,
        };
        self.desk.recent = settings::with_recent(&self.desk.recent, &recent);
        self.tasks.order(Order::Recent(self.desk.recent.clone()));
        if let Some(home) = self.desk.home.clone() {
            self.tasks.quietly(move || {
                Report::Kept(settings::keep_recent(&home, &recent).map_err(|e| e.to_string()))
            });
        }
    }

    /// Keeps the preferences for tomorrow.
    pub(super) fn keep_preferences(&mut self) {
        let preferences = self.view.preferences;
        if let Some(home) = self.desk.home.clone() {
            self.tasks.quietly(move || {
                let kept = settings::keep_preferences(&home, preferences);
                Report::Kept(kept.map_err(|e| e.to_string()))
            });
        }
    }

    /// Whether recovery lags behind the document.
    pub(crate) fn recovery_lags(&self) -> bool {
        let now = self.history.present();
        let kept = self.desk.kept.as_ref();
        self.desk.keeper.is_some()
            && match (kept, self.unsaved()) {
                (Some(kept), true) => !Arc::ptr_eq(kept, now),
                (Some(_), false) | (None, true) => true,
                (None, false) => !self.desk.restored.is_empty(),
            }
    }

    /// Writes what is not saved to this window's recovery file, or removes it where all is saved.
    pub(super) fn keep_recovery(&mut self) {
        let Some(path) = self.desk.keeper.as_ref().map(|k| k.path().to_path_buf()) else {
            return;
        };
        if !self.recovery_lags() {
            return;
        }
        if !self.unsaved() {
            self.desk.kept = None;
            let restored = std::mem::take(&mut self.desk.restored);
            self.tasks.quietly(move || {
                // What was restored is saved: nobody needs either.
                let _ = std::fs::remove_file(&path);
                restored.into_iter().for_each(LeftBehind::remove);
                Report::Kept(Ok(()))
            });
            return;
        }
        let document = Arc::clone(self.history.present());
        self.desk.kept = Some(Arc::clone(&document));
        let file = self.file().map(Path::to_path_buf);
        let restored = std::mem::take(&mut self.desk.restored);
        self.tasks.quietly(move || {
            let written = recovery::write(&path, &Kept::of(&document, file));
            if written.is_ok() {
                restored.into_iter().for_each(LeftBehind::remove);
            }
            Report::Kept(written.map_err(|e| e.to_string()))
        });
    }

    pub(super) fn take_left_behind(&mut self, left: Vec<LeftBehind>) {
        self.desk.left_behind = left;
        if !self.desk.left_behind.is_empty() && self.view.sheet.is_none() {
            self.view.sheet = Some(Sheet::Recover);
        }
    }

    /// Brings back what was left behind.
    pub(super) fn restore(&mut self, index: usize) {
        if index >= self.desk.left_behind.len() {
            return;
        }
        let left = self.desk.left_behind.remove(index);
        self.close_recovery();
        match &left.kept {
            Ok(kept) => {
                let mut session = kept.session.clone();
                session.path.clone_from(&kept.file);
                let origin = Origin::Recovered(kept.file.clone());
                let subject = Arc::new(Subject::new(session, Vec::new(), origin));
                let edit = Edit::Recover(subject, Box::new(kept.clone()));
                self.execute(Command::Edit(edit));
                self.desk.restored.push(left);
                self.keep_recovery();
                self.view.message = Some(Message {
                    wrong: false,
                    title: "Restored; it is not saved yet".to_owned(),
                    details: Vec::new(),
                });
            }
            Err(because) => {
                let because = because.clone();
                let aside = left.put_aside();
                self.complain(
                    "What was left behind is damaged and cannot be restored",
                    vec![because, format!("It is kept as {}", aside.display())],
                );
            }
        }
    }

    /// Nobody wants what was left behind.
    pub(super) fn discard_left(&mut self, index: usize) {
        if index < self.desk.left_behind.len() {
            let left = self.desk.left_behind.remove(index);
            if left.kept.is_ok() {
                left.remove();
            } else {
                left.put_aside();
            }
        }
        self.close_recovery();
    }

    fn close_recovery(&mut self) {
        if self.desk.left_behind.is_empty() && self.view.sheet == Some(Sheet::Recover) {
            self.view.sheet = None;
        }
    }

    /// Reads the session's file again. Undo brings back what was here.
    pub(super) fn reload(&mut self) {
        self.view.on_disk = None;
        if let Some(path) = self.file().map(Path::to_path_buf) {
            self.go(Then::Open(path));
        }
    }

    pub(super) fn take_seen(&mut self, seen: Seen) {
        match seen {
            Seen::Missing(missing) => self.desk.missing = missing,
            Seen::Fate(path, fate) => {
                let place = self.desk.places.get(&self.subject().lineage);
                let ours = place.is_some_and(|p| p.files.iter().any(|f| f.path == path));
                let worse = self
                    .view
                    .on_disk
                    .as_ref()
                    .is_none_or(|shown| shown.fate == Fate::Changed);
                if ours && worse {
                    self.view.on_disk = Some(OnDisk { path, fate });
                }
            }
            Seen::Read(print) => {
                for place in self.desk.places.values_mut() {
                    let same = place.files.iter_mut().find(|f| f.path == print.path);
                    if let Some(file) = same {
                        *file = print.clone();
                    }
                }
            }
            Seen::Grew(growth) => self.take_growth(*growth),
        }
    }

    pub(super) fn take_kept(&mut self, kept: Result<(), String>) {
        if let Err(because) = kept {
            self.complain(
                "Not everything could be kept for tomorrow",
                vec![
                    because,
                    "The session is as it was; save it under a name of your own".to_owned(),
                ],
            );
        }
    }

    /// Counts samples that came.
    pub(super) fn count_new(&mut self, samples: usize) {
        self.desk.came += samples;
    }

    /// Begins or ends to count samples that come.
    pub(super) fn set_followed(&mut self, lineage: Option<u64>) {
        self.desk.followed = lineage;
        self.desk.came = 0;
    }

    /// Everything that stood in a file and was about `from` is about `to` now.
    pub(super) fn grow_on_file(&mut self, from: &Arc<Subject>, to: &Arc<Subject>) {
        for document in &mut self.desk.on_file {
            if Arc::ptr_eq(&document.subject, from) {
                let mut grown = Document::clone(document);
                grown.subject = Arc::clone(to);
                *document = Arc::new(grown);
            }
        }
    }
}
