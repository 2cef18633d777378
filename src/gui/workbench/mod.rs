//! What there is, and what is done with it.
//!
//! Panels and plots are drawn from a [`Workbench`] as it was when the frame began. What the user does there they leave
//! in it ([`Workbench::then`]) as a change of its plain state, which is made once the frame is drawn: none is drawn half
//! before and half after a change. What follows from the state is asked for after each change.

mod answers;
mod background;
mod charts;
mod drafts;
mod exports;
mod machine;
mod on_disk;
#[cfg(test)]
mod tests;
mod unsaved;
/// What the tests of the window do at random; no release has it.
#[cfg(debug_assertions)]
#[path = "../../../tests/support/walk/mod.rs"]
pub mod walk;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use egui::{Color32, ColorImage, TextureHandle};

use crate::compensation::decision::FittedErrors;
use crate::explain::Section;
use crate::gui::cache::heat::Heat;
use crate::gui::cache::{
    ExportPreview, IdentifiedAnswer, Memo, PlotInputs, PreviewRequest, StandardsFigures,
};
use crate::gui::charts::effect::Sketches;
use crate::gui::charts::{ChartPlaceholder, Scene, Shown};
use crate::gui::core::answer::Question;
use crate::gui::core::compensated::Compensated;
use crate::gui::core::disk::Fingerprint;
use crate::gui::core::document::{Changed, Document, ExportChoice, Method};
use crate::gui::core::history::History;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::regions::Counts;
use crate::gui::core::search::Search;
use crate::gui::file_state::recovery::{LeftBehind, RecoveryFile};
use crate::gui::file_state::{Settings, Stated};
use crate::gui::files;
use crate::gui::import_draft::ImportDraft;
use crate::gui::jobs::{Jobs, Slot};
use crate::gui::view::{
    Camera, Message, NextAction, OnDisk, Plane, Preferences, Sheet, Sorting, Step, ViewState,
};
use crate::present::numbers::Notation;
use crate::present::units::Units;
use crate::sessions::Region;
use crate::text::{Language, spoken};

/// What answers in place of the system's dialogs: for tests, which cannot press anything in one.
pub(crate) type Chooser = Arc<dyn Fn() -> Option<PathBuf> + Send + Sync>;

/// A change of a workbench.
pub(crate) type Change = Box<dyn FnOnce(&mut Workbench)>;

/// Document, view, answer and jobs.
pub(crate) struct Workbench {
    pub(super) history: History,
    /// The session that the window began with, not opened by the user.
    pub(super) first: Arc<LoadedSession>,
    pub(super) file_state: FileState,
    /// How it is looked at.
    pub(crate) view: ViewState,
    pub(super) derived: Derived,
    /// What is to be done once the frame is drawn.
    pub(super) changes: RefCell<Vec<Change>>,
    pub(super) dragging: bool,
    /// What waits for a picture of the workspace, and whether one was asked for; the picture as soon as it is there.
    pub(super) waiting: Option<(Change, bool)>,
    pub(super) picture: Option<ColorImage>,
    pub(super) chooser: Option<Chooser>,
    pub(crate) jobs: Jobs<Self>,
}

type Figures = Result<StandardsFigures, String>;
/// A chart, or why there is none.
type Charted = Result<Shown, ChartPlaceholder>;
/// A session, and how it is divided.
type Divided = (Arc<LoadedSession>, Arc<[Region]>);

/// What the background has worked out about the document, and works out.
#[derive(Default)]
pub(super) struct Derived {
    pub(super) identified: Slot<Question, Arc<IdentifiedAnswer>>,
    pub(super) searched: Option<Arc<Search>>,
    /// The session that is being searched: only that one can be given its answer.
    pub(super) searching: Option<Arc<LoadedSession>>,
    /// What a search that was stopped had found until then, and in which session.
    pub(super) stopped: Option<(Arc<LoadedSession>, Vec<String>)>,
    pub(super) preview: Slot<PreviewRequest, Result<Arc<ExportPreview>, String>>,
    /// The error over a plane.
    pub(super) heat: Slot<(PlotInputs, Plane), Option<Arc<Heat>>>,
    /// The standards' figures, by the errors of a diagnosis where there is one.
    pub(super) figures: Slot<(PlotInputs, Option<FittedErrors>), Figures>,
    /// The curves of what a search found.
    pub(super) sketches: Slot<Arc<Search>, Sketches>,
    pub(super) chart: Slot<(&'static str, Arc<Scene>), Arc<Charted>>,
    pub(super) compensated: Option<Arc<Compensated>>,
    /// What became of files on the disk.
    pub(super) on_disk: Slot<Look, Looked>,
    /// The document as recovery has it, where something of it is not saved.
    pub(super) recovery: Slot<Option<Arc<Document>>, ()>,
    /// What a diagnosis says, and how it is said.
    pub(super) sections: Memo<(Arc<Search>, Voice), Arc<[Section]>>,
    /// The samples of each region, and those in none.
    pub(super) counted: Memo<Divided, Arc<Counts>>,
    pub(super) heat_picture: Memo<HeatLook, TextureHandle>,
    /// The samples in the order of their rows.
    pub(super) order: Memo<(PlotInputs, Sorting), Arc<[u32]>>,
}

/// A table or a model that was written.
pub(crate) struct Exported {
    pub(super) path: PathBuf,
    /// What its model answers.
    pub(super) of: Question,
    pub(super) choice: ExportChoice,
}

/// A look at the disk.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Look {
    pub(super) number: u64,
    pub(super) files: Vec<Fingerprint>,
    pub(super) recent: Vec<PathBuf>,
}

/// What it has found.
pub(crate) struct Looked {
    pub(super) change: Option<OnDisk>,
    pub(super) missing: Vec<PathBuf>,
}

impl Workbench {
    /// A workbench with a session on it.
    pub(crate) fn new(loaded_session: Arc<LoadedSession>, jobs: Jobs<Self>) -> Self {
        let mut workbench = Self {
            first: Arc::clone(&loaded_session),
            file_state: FileState::default(),
            history: History::new(Document::new(loaded_session)),
            view: ViewState::new(),
            derived: Derived::default(),
            changes: RefCell::default(),
            dragging: false,
            waiting: None,
            picture: None,
            chooser: None,
            jobs,
        };
        workbench.stands_in(Vec::new());
        workbench.look_along_the_axis();
        workbench
    }
}

/// Where an opening stands on the disk.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// The content that the file had when it was read or written.
    pub(super) document: Arc<Document>,
    /// Its files as they looked when they were last read or written: the document, and the samples where they are in one.
    /// None: it needs no file, being an example or a model.
    pub(super) files: Vec<Fingerprint>,
}

/// Files: where openings stand on the disk, what changed there, and what outlives the window.
#[derive(Default)]
pub(super) struct FileState {
    pub(super) home: Option<PathBuf>,
    /// What outlives the window; its preferences are those of the view.
    pub(super) settings: Settings,
    pub(super) recovery_file: Option<RecoveryFile>,
    /// What a window that is gone has left behind.
    pub(super) left_behind: Option<LeftBehind>,

    /// The date that is proposed for reports.
    pub(super) today: Option<String>,
    /// What was typed for the report of an opening.
    pub(super) stated: BTreeMap<u64, Stated>,
    pub(super) places: BTreeMap<u64, Place>,
    /// Counts how often the disk was to be looked at.
    pub(super) looks: u64,
    /// What became of files, as it was read and put aside.
    pub(super) dismissed: Option<(Vec<Fingerprint>, OnDisk)>,

    /// The import that was left without being done, with what was said.
    pub(super) left_draft: Option<ImportDraft>,
    /// Tables and models that were written, the newest last.
    pub(super) exported: Vec<Exported>,
    /// What is done once a file is written, and whether everything that would be lost is saved before.
    pub(super) then: Option<(NextAction, bool)>,
}

/// A map, and how it is looked at: the blend, the upper end of its scale, mm, and what it stands on.
pub(super) type HeatLook = (Arc<Heat>, f32, f64, Color32);
/// How it is said.
pub(super) type Voice = (Units, Language, Notation);

impl Workbench {
    pub(crate) fn document(&self) -> &Document {
        self.history.present()
    }

    pub(crate) fn loaded_session(&self) -> &Arc<LoadedSession> {
        &self.document().loaded_session
    }

    pub(crate) fn units(&self) -> Units {
        Units {
            length: self.view.preferences.length,
            angle: self.view.preferences.angle,
        }
    }

    /// The steps that the robot has, in order.
    pub(crate) fn steps(&self) -> &'static [Step] {
        Step::offered(self.loaded_session().single_revolute())
    }

    /// Goes to one of them.
    pub(crate) fn go_to(&mut self, index: usize) {
        self.view.step = self.steps().get(index).copied().unwrap_or(self.view.step);
    }

    pub(crate) fn undoes(&self) -> Option<&'static str> {
        self.history.undoes().map(spoken)
    }

    pub(crate) fn redoes(&self) -> Option<&'static str> {
        self.history.redoes().map(spoken)
    }

    /// Does this once the frame is drawn.
    pub(crate) fn then(&self, change: impl FnOnce(&mut Self) + Send + 'static) {
        self.changes.borrow_mut().push(Box::new(change));
    }

    /// Makes the changes that were left in it. Whether there were any.
    pub(crate) fn make_changes(&mut self) -> bool {
        let changes = std::mem::take(self.changes.get_mut());
        let any = !changes.is_empty();
        for change in changes {
            self.execute(change);
        }
        any
    }

    /// Does this, and asks for what follows from it.
    pub(crate) fn execute(&mut self, change: impl FnOnce(&mut Self)) {
        change(self);
        if !self.steps().contains(&self.view.step) {
            // Another robot has no regions.
            self.view.step = Step::Identify;
        }
        self.view.stay_within(self.loaded_session().len());
        self.stop_search_of_others();
        self.keep_watching();
        self.refresh_answer();
        self.keep_preparing();
        self.keep_drawing();
    }

    /// A robot program has nothing to be opened: its targets are corrected.
    pub(crate) fn open_file(&mut self, path: PathBuf) {
        if files::is_program(&path) {
            self.compensate_file(path);
        } else {
            self.ask_then(NextAction::Open(path));
        }
    }

    /// Shows numbers, colours and text like this, tomorrow as well.
    pub(crate) fn prefer(&mut self, preferences: Preferences) {
        self.view.preferences = preferences.sound();
        let preferences = self.view.preferences;
        self.keep(move |kept| kept.preferences = preferences);
    }

    pub(crate) fn show_sheet(&mut self, sheet: Option<Sheet>) {
        if sheet.is_none() {
            match &self.view.sheet {
                // Closing the question cancels what it was about.
                Some(Sheet::Unsaved(_) | Sheet::Overwrite(_) | Sheet::Path { .. }) => {
                    self.cancel_pending_action();
                }
                Some(Sheet::Import(_)) => self.leave_draft(),
                _ => {}
            }
        }
        if self.view.sheet == Some(Sheet::Details) {
            self.keep_stated();
        }
        self.view.sheet = sheet;
    }

    /// A change of the document; while something is dragged, part of one.
    pub(crate) fn edit(&mut self, change: impl FnOnce(&mut Document) -> Changed) {
        let before = Arc::clone(self.loaded_session());
        let mut next = self.document().clone();
        match change(&mut next) {
            Err(because) => self.complain(say!("This change cannot be made"), vec![because]),
            Ok(()) if self.dragging => self.history.change_within_gesture(next),
            Ok(()) => self.history.change(next),
        }
        if !Arc::ptr_eq(&before, self.loaded_session()) {
            self.view.marked.clear();
            self.after_travel(before.lineage);
        }
        if before.lineage != self.loaded_session().lineage {
            // No chart stays on an effect that a session had: of another one there is none yet.
            self.view
                .chart
                .take_if(|chart| *chart == crate::gui::charts::effect::ID);
            self.look_along_the_axis();
            self.view.step = Step::Session;
            self.view.fit();
            self.view.message = None;
            self.opened();
        }
    }

    /// One that can be made in any case.
    pub(crate) fn replace(&mut self, change: impl FnOnce(&mut Document)) {
        self.edit(|document| {
            change(document);
            Ok(())
        });
    }

    /// Makes one once the frame is drawn.
    pub(crate) fn edits(&self, change: impl FnOnce(&mut Document) -> Changed + Send + 'static) {
        self.then(move |bench| bench.edit(change));
    }

    /// Identifies from now on, by this method or as it is chosen.
    pub(crate) fn identify(&mut self, method: Option<Method>) {
        self.edit(|document| document.identify(method));
        self.derived.identified.resume();
    }

    /// Whether something is dragged at present: all that it changes is one change.
    pub(crate) fn drag(&mut self, dragging: bool) {
        self.dragging = dragging;
        if !dragging {
            self.history.finish_gesture();
        }
    }

    pub(crate) fn undo(&mut self) {
        self.travel(History::undo);
    }

    pub(crate) fn redo(&mut self) {
        self.travel(History::redo);
    }

    /// Back or forth in the history.
    fn travel(&mut self, way: fn(&mut History) -> bool) {
        let before = self.loaded_session().lineage;
        way(&mut self.history);
        self.after_travel(before);
    }

    /// After a change that may have brought another session.
    fn after_travel(&mut self, lineage_before: u64) {
        if self.loaded_session().lineage != lineage_before {
            // What is being typed is about the robot that was here.
            let of_session = |sheet: &mut Sheet| matches!(sheet, Sheet::Setup { form, .. } if form.measured.is_some());
            self.view.sheet.take_if(of_session);
            self.arrived();
        }
    }

    /// Looks at the workspace in the plane in which joint 1 turns; with several joints in space, as
    /// no plane shows them.
    fn look_along_the_axis(&mut self) {
        let along = self.loaded_session().joint.along;
        self.view.in_space = self.loaded_session().session.robot.joint_count() > 1;
        self.view.camera = Camera::default();
        let steepest = (0..3).max_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()));
        self.view.plane = Plane::ALL
            .into_iter()
            .find(|plane| Some(plane.normal()) == steepest)
            .unwrap_or_default();
    }

    fn complain(&mut self, title: &str, details: impl IntoIterator<Item = impl Into<String>>) {
        let details = details.into_iter().map(Into::into).collect();
        self.view.message = Some(Message::wrong(title, details));
    }
}
