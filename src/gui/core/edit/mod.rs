//! Changes of the document: `apply` makes the next document of one.

mod apply;
mod regions;

use crate::text::Template;
use std::sync::Arc;

use crate::diagnosis::SessionCorrection;
use crate::effects::Term;
use crate::sessions::Region;

use super::boundary_entry::Joint;
use super::division::Decision;
use super::document::{Choices, ExportChoice, Method};
use super::loaded_model::LoadedModel;
use super::loaded_session::LoadedSession;
use super::setup::SetupForm;

#[derive(Debug, Clone)]
pub(crate) enum Edit {
    Open(Arc<LoadedSession>),
    /// A model: beside the open session, or by itself.
    OpenModel {
        loaded_model: Arc<LoadedModel>,
        /// Whether the open session is one of its robot.
        of_open_session: bool,
    },
    /// So many regions of the same width.
    Divide(usize),
    /// Move a boundary (counted in ascending order) to this angle, rad.
    MoveBoundary(usize, f64),
    /// Put a boundary exactly there, rad: it was typed.
    PlaceBoundary(Joint, f64),
    /// What the adaptive division decided.
    Adapt(Arc<[Region]>, Decision),
    /// Go on with the regions as they are, by hand.
    KeepRegions,
    /// Cut a region in half.
    Split(usize),
    /// Make one region of this and the one after it.
    Join(usize),
    /// Take a region away: where it was nothing is corrected.
    Delete(usize),
    /// Another name for a region.
    Rename(usize, String),
    /// The regions that the session brings along.
    RegionsOfSession,
    Method(Method),
    /// Fit this effect, or leave it out.
    Effect(&'static str, bool),
    /// How far a position may be off, mm.
    Tolerance(Option<f64>),
    /// Another table.
    Export(ExportChoice),
    /// Add what a search found to the exact fit.
    Add(Vec<Term>),
    /// Switch an added effect (counted in the order in which they were added) on or off.
    Switch(usize, bool),
    /// Another description of the robot, its reflectors and the instrument.
    Setup(Box<SetupForm>),
    /// Take these samples out of every fit and figure, or in again.
    Exclude(Vec<usize>, bool),
    /// Take mistakes of setting up back, one after the other.
    Correct(Vec<SessionCorrection>),
    /// What a window that is gone has left behind.
    Recover(Arc<LoadedSession>, Choices),
    /// Identify from now on, as it is chosen.
    Identify,
    /// Identify from now on, by this method.
    IdentifyBy(Method),
}

impl Edit {
    /// What the menu calls it, after "Undo".
    pub(crate) fn what(&self) -> Template {
        match self {
            Self::Open(_) => phrase!("open session"),
            Self::OpenModel { .. } => phrase!("open model"),
            Self::Divide(_) => phrase!("divide into regions"),
            Self::MoveBoundary(..) | Self::PlaceBoundary(..) => phrase!("move boundary"),
            Self::Adapt(..) => phrase!("divide adaptively"),
            Self::KeepRegions => phrase!("keep the regions"),
            Self::Split(_) => phrase!("split region"),
            Self::Join(_) => phrase!("merge regions"),
            Self::Delete(_) => phrase!("delete region"),
            Self::Rename(..) => phrase!("rename region"),
            Self::RegionsOfSession => phrase!("take regions from session"),
            Self::Method(_) => phrase!("choose method"),
            Self::Effect(..) => phrase!("choose effects"),
            Self::Tolerance(_) => phrase!("set tolerance"),
            Self::Export(_) => phrase!("choose table"),
            Self::Add(_) => phrase!("add to model"),
            Self::Switch(_, true) => phrase!("switch effect on"),
            Self::Switch(_, false) => phrase!("switch effect off"),
            Self::Setup(_) => phrase!("edit robot and instrument"),
            Self::Exclude(_, true) => phrase!("exclude samples"),
            Self::Exclude(_, false) => phrase!("include samples"),
            Self::Correct(_) => phrase!("correct data"),
            Self::Recover(..) => phrase!("restore"),
            Self::Identify | Self::IdentifyBy(_) => phrase!("identify"),
        }
    }
}
