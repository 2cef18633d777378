//! What the workbench keeps beside the document and the view: where openings stand on the disk, and
//! what it has asked of the background.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::explain::Section;
use crate::gui::cache::identified::PreviewRequest;
use crate::gui::cache::plot_cache::PlotInputs;
use crate::gui::core::disk::Fingerprint;
use crate::gui::core::document::{Document, Question};
use crate::gui::core::robot_table::RobotTable;
use crate::gui::core::search::Search;
use crate::gui::file_state::machines::{Machine, Stated};
use crate::gui::file_state::recording::UnderWay;
use crate::gui::file_state::recovery::{OrphanedRecovery, RecoveryFile};
use crate::gui::file_state::settings::DrawnFrom;
use crate::gui::jobs::Latest;
use crate::gui::view::NextAction;
use crate::history::History;
use crate::present::numbers::Notation;
use crate::present::units::Units;
use crate::text::Language;

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
    /// Whose meshes saved sessions are drawn from, newest first.
    pub(super) meshes: Vec<DrawnFrom>,
    pub(super) recording: Option<UnderWay>,
    /// The session of a recording, which is followed once it is open.
    pub(super) to_follow: Option<PathBuf>,
    /// Sessions that were compared.
    pub(super) past: Option<Arc<Past>>,
    /// What was typed for the report of an opening.
    pub(super) stated: BTreeMap<u64, Stated>,
    pub(super) missing: Vec<PathBuf>,
    pub(super) places: BTreeMap<u64, Place>,
    /// Number of the last order of files to look at.
    pub(super) watch_order: u64,
    /// Documents that stand in a file, or need none.
    pub(super) on_file: Vec<Arc<Document>>,
    /// What was asked of the model that was written last.
    pub(super) model_on_file: Option<Question>,
    pub(super) then: Option<NextAction>,
    /// The document as recovery has it.
    pub(super) kept: Option<Arc<Document>>,
    /// The opening whose samples file is followed.
    pub(super) followed: Option<u64>,
    /// How many samples came while it was followed.
    pub(super) came: usize,
}

/// What is asked faster than it is answered.
#[derive(Default)]
pub(super) struct PendingQueries {
    pub(super) questions: Latest<Question>,
    pub(super) previews: Latest<PreviewRequest>,
    pub(super) plots: Latest<PlotInputs>,
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
    pub(crate) history: History,
}
