//! What the workbench keeps: document, view and answer; where openings stand on the disk; and what it has asked of the
//! background.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use egui::ColorImage;

use crate::explain::Section;
use crate::gui::cache::identified::{Figures, IdentifiedAnswer, Preview, PreviewRequest};
use crate::gui::cache::{PlotCache, PlotInputs};
use crate::gui::core::answer::Search;
use crate::gui::core::compensated::Compensated;
use crate::gui::core::disk::Fingerprint;
use crate::gui::core::document::{Document, ExportChoice, Question};
use crate::gui::core::history::History;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::robot_table::RobotTable;
use crate::gui::file_state::machines::{Machine, Stated};
use crate::gui::file_state::recovery::{OrphanedRecovery, RecoveryFile};
use crate::gui::import_draft::ImportDraft;
use crate::gui::jobs::{Jobs, Slot};
use crate::gui::view::{NextAction, OnDisk, ViewState};
use crate::history;
use crate::present::numbers::Notation;
use crate::present::units::Units;
use crate::text::Language;

/// What answers in place of the system's dialogs: for tests, which cannot press anything in one.
pub(crate) type Chooser = Arc<dyn Fn() -> Option<PathBuf> + Send + Sync>;

/// A change of a workbench.
pub(crate) type Change = Box<dyn FnOnce(&mut Workbench)>;

/// Document, view, answer and jobs.
pub(crate) struct Workbench {
    pub(super) history: History<Document>,
    /// The session that the window began with, not opened by the user.
    pub(super) first: Arc<LoadedSession>,
    pub(super) file_state: FileState,
    /// How it is looked at.
    pub(crate) view: ViewState,
    /// What is to be done once the frame is drawn.
    pub(super) changes: RefCell<Vec<Change>>,
    pub(super) dragging: bool,
    /// The import that was left without being done, with what was said.
    pub(super) left_draft: Option<ImportDraft>,
    pub(super) identified: Option<Arc<IdentifiedAnswer>>,
    pub(super) searched: Option<Arc<Search>>,
    /// A chart and its numbers, ready to be copied.
    pub(super) copied: Option<(&'static str, String)>,
    pub(super) spoken_sections: SpokenSections,
    /// What a search that was stopped had found until then, and in which session.
    pub(super) stopped: Option<(Arc<LoadedSession>, Vec<String>)>,
    pub(super) preview: Option<Arc<Preview>>,
    pub(super) plot_cache: Option<Arc<PlotCache>>,
    pub(super) compensated: Option<Arc<Compensated>>,
    /// Files that were exported from this session, the newest last, each with what its model answers.
    pub(super) exported: Vec<(PathBuf, Option<Question>)>,
    /// The name under which this export was saved last.
    pub(super) saved_as: Option<(ExportChoice, String)>,
    pub(super) figures: Option<Figures>,
    /// What waits for a picture of the workspace, and whether one was asked for; the picture as soon as it is there.
    pub(super) waiting: Option<(Change, bool)>,
    pub(super) picture: Option<ColorImage>,
    pub(super) chooser: Option<Chooser>,
    pub(super) jobs: Jobs<Self>,
    pub(super) asked: PendingQueries,
}

impl Workbench {
    /// A workbench with a session on it.
    pub(crate) fn new(loaded_session: Arc<LoadedSession>, jobs: Jobs<Self>) -> Self {
        let first = Arc::clone(&loaded_session);
        let history = History::new(Document::new(loaded_session));
        let mut workbench = Self {
            first,
            file_state: FileState::default(),
            history,
            view: ViewState::default(),
            changes: RefCell::default(),
            dragging: false,
            left_draft: None,
            identified: None,
            searched: None,
            copied: None,
            spoken_sections: SpokenSections::default(),
            stopped: None,
            preview: None,
            plot_cache: None,
            compensated: None,
            exported: Vec::new(),
            saved_as: None,
            figures: None,
            waiting: None,
            picture: None,
            chooser: None,
            asked: PendingQueries::default(),
            jobs,
        };
        workbench.remember_on_file(Arc::clone(workbench.history.present()));
        workbench.look_along_the_axis();
        workbench
    }
}

/// Where an opening stands on the disk.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) path: PathBuf,
    /// As they looked when they were last read or written.
    pub(super) files: Vec<Fingerprint>,
    pub(super) samples: Option<PathBuf>,
}

/// Files: where openings stand on the disk, what changed there, and what outlives the window.
#[derive(Default)]
pub(super) struct FileState {
    pub(super) home: Option<PathBuf>,
    pub(super) recovery_file: Option<RecoveryFile>,
    pub(super) orphaned: Vec<OrphanedRecovery>,
    /// Restored, and to be removed as soon as this window keeps it itself.
    pub(super) restored: Vec<OrphanedRecovery>,
    pub(super) recent: Vec<PathBuf>,
    /// The date that is proposed for reports.
    pub(super) today: Option<String>,
    /// What the reports of machines state, newest first.
    pub(super) machines: Vec<Machine>,
    /// Robots that were typed, newest first.
    pub(super) robots: Vec<RobotTable>,
    /// Sessions that were compared.
    pub(super) past: Option<Arc<Past>>,
    /// What was typed for the report of an opening.
    pub(super) stated: BTreeMap<u64, Stated>,
    pub(super) missing: Vec<PathBuf>,
    pub(super) places: BTreeMap<u64, Place>,
    /// Counts how often what is known of files was replaced.
    pub(super) look: u64,
    /// What became of a file, as it was read and put aside.
    pub(super) dismissed: Option<OnDisk>,
    /// Documents that stand in a file, or need none.
    pub(super) on_file: Vec<Arc<Document>>,
    /// What was asked of the model that was written last.
    pub(super) model_on_file: Option<Question>,
    pub(super) then: Option<NextAction>,
    /// Whether everything that would be lost is saved before that.
    pub(super) saves_all: bool,
    /// The document as recovery has it.
    pub(super) kept: Option<Arc<Document>>,
}

/// What is asked faster than it is answered.
#[derive(Default)]
pub(super) struct PendingQueries {
    pub(super) questions: Slot<Question>,
    pub(super) previews: Slot<PreviewRequest>,
    pub(super) plots: Slot<PlotInputs>,
    /// The session that is being searched: only that one can be given its answer.
    pub(super) searched: Option<Arc<LoadedSession>>,
}

/// Sections as they were said last; nothing until they are asked for.
#[derive(Debug, Default)]
pub(super) struct SpokenSections(pub(super) RefCell<Option<CachedSections>>);

/// Of which diagnosis, how it is said, and the sections.
pub(super) type CachedSections = (Arc<Search>, Voice, Arc<[Section]>);
/// How it is said.
pub(super) type Voice = (Units, Language, Notation);

/// What became of the machines of a folder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Past {
    pub(crate) folder: PathBuf,
    pub(crate) history: history::History,
}
