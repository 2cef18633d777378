//! What tasks bring back.

use std::path::PathBuf;
use std::sync::Arc;

use crate::fonts::Found;
use crate::gui::cache::backdrop::Backdrop;
use crate::gui::cache::figures::Figures;
use crate::gui::cache::outcome::Outcome;
use crate::gui::cache::preview::Preview;
use crate::gui::core::given::Given;
use crate::gui::core::search::Search;
use crate::gui::core::subject::Subject;
use crate::gui::files::Saved;
use crate::gui::foreign::{Beside, Foreign, Look};
use crate::gui::keeping::recovery::LeftBehind;
use crate::gui::keeping::watcher::Seen;
use crate::gui::view::{Message, What};
use crate::gui::workbench::Adapted;

/// What a task brings back.
#[derive(Debug)]
pub(crate) enum Report {
    /// A session was read or made.
    Opened(Result<Arc<Subject>, Message>),
    /// A file that an instrument wrote was looked at.
    Foreign(Box<Foreign>),
    /// It was looked at again, with what was said since.
    Looked(Box<(Foreign, Look)>),
    /// A file beside it was chosen; `None`: cancelled, or there is no dialog on this system.
    ChosenBeside(Beside, Option<PathBuf>),
    /// A model was read.
    OpenedModel(Result<Arc<Given>, Message>),
    /// A path was chosen to open; `None`: cancelled, or there is no dialog on this system.
    ChosenToOpen(Option<PathBuf>),
    /// A path was chosen to save to.
    ChosenToSave(Option<PathBuf>),
    /// A session was written, or not.
    Saved(Box<Saved>),
    /// Preferences, recent files or what is not saved were kept, or not.
    Kept(Result<(), String>),
    /// What windows that are gone have left behind.
    LeftBehind(Vec<LeftBehind>),
    /// Something was seen on the disk.
    Seen(Seen),
    /// A session has grown.
    Extended(Box<Extended>),
    /// A question was answered.
    Answered(Box<Outcome>),
    /// The joint's range was divided where the samples ask for it.
    Adapted(Box<Adapted>),
    /// A session was searched.
    Searched(Box<Search>),
    /// What plots of many samples stand on was worked out.
    Drawn(Box<Backdrop>),
    /// An export was prepared.
    Prepared(Box<Preview>),
    /// An export was written.
    Exported(Result<PathBuf, Message>),
    /// A measuring list was written.
    Listed(Result<PathBuf, Message>),
    /// A report or a picture was written, or not.
    Written(Message),
    /// The standards' figures were worked out.
    Figured(Box<Figures>),
    /// A path was chosen to export to.
    ChosenToExport(What, Option<PathBuf>),
    /// Fonts were looked through for letters.
    Lettered(Box<Found>),
    /// The task itself failed: a bug.
    Broken,
}

/// A session that has grown, with the answer to what was asked of it.
#[derive(Debug)]
pub(crate) struct Extended {
    /// Before.
    pub(crate) from: Arc<Subject>,
    /// After.
    pub(crate) to: Arc<Subject>,
    /// The answer, where something was asked.
    pub(crate) outcome: Option<Outcome>,
}
