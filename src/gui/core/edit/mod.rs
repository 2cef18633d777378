//! Changes of the document, what those of its regions make of it; `apply` has all others, `history` keeps them.

mod apply;
mod history;

pub(crate) use history::History;

use std::sync::Arc;

use crate::diagnosis::SessionCorrection;
use crate::document::degrees;
use crate::effects::Term;
use crate::fit::regions_of;
use crate::language::spoken;
use crate::sessions::Region;
use crate::sessions::division::RegionChoice;
use crate::text::Template;
use crate::units::rad_from_deg;

use super::answer::LoadedModel;
use super::boundaries;
use super::document::{Choices, Decision, Division, Document, ExportChoice, Method};
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
            Self::MoveBoundary(..) => phrase!("move boundary"),
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

/// The document after a change of its regions; `None` for a change of something else.
fn apply_to_regions(edit: &Edit, document: &Document) -> Option<Result<Document, String>> {
    Some(match edit {
        Edit::Rename(region, name) => renamed(document, *region, name),
        Edit::KeepRegions => {
            let mut next = document.clone();
            next.division = Division::Given;
            Ok(next)
        }
        _ => divided(edit, document)?.and_then(|(regions, division)| {
            let mut next = document.clone();
            next.loaded_model = None;
            by_regions(&mut next, regions)?;
            next.division = division;
            Ok(next)
        }),
    })
}

/// The regions after a change of them, and how they came about.
fn divided(edit: &Edit, document: &Document) -> Option<Result<(Vec<Region>, Division), String>> {
    let loaded_session = &document.loaded_session;
    let resolved = |choice: RegionChoice| {
        let regions = regions_of(&choice, &loaded_session.session);
        regions.map_err(|e| spoken(e.describe()))
    };
    let by_hand = |regions: Option<Vec<Region>>, otherwise: &str| {
        let regions = regions.ok_or_else(|| otherwise.to_owned())?;
        Ok((regions, Division::Given))
    };
    let all = &document.regions;
    Some(match edit {
        Edit::Divide(number) => {
            resolved(RegionChoice::Uniform(*number)).map(|regions| (regions, Division::Even))
        }
        Edit::RegionsOfSession => {
            resolved(RegionChoice::FromSession).map(|regions| (regions, Division::Given))
        }
        Edit::Adapt(regions, decision) => {
            Ok((regions.to_vec(), Division::Adaptive(decision.clone())))
        }
        Edit::MoveBoundary(boundary, to_rad) => by_hand(
            boundaries::moved(all, *boundary, *to_rad, loaded_session.travel()),
            say!("the boundary cannot be moved there"),
        ),
        Edit::Split(region) => by_hand(
            boundaries::split(all, *region),
            say!("the region is too narrow to be split"),
        ),
        Edit::Join(region) => by_hand(
            boundaries::joined(all, *region),
            say!(
                "no region begins where this one ends; enter the end of this region as the start of the next one first"
            ),
        ),
        Edit::Delete(region) => by_hand(
            boundaries::without(all, *region),
            say!("the last region stays: without one nothing is corrected"),
        ),
        _ => return None,
    })
}

fn renamed(document: &Document, region: usize, name: &str) -> Result<Document, String> {
    let name = name.trim();
    if name.is_empty() {
        return Err(say!("a region needs a name").to_owned());
    }
    let taken = |(k, r): (usize, &Region)| k != region && r.name == name;
    if document.regions.iter().enumerate().any(taken) {
        return Err(say!(
            "another region is called {name}; choose another name",
            name
        ));
    }
    let mut regions = document.regions.to_vec();
    let renamed = regions
        .get_mut(region)
        .ok_or(say!("there is no such region"))?;
    name.clone_into(&mut renamed.name);
    let mut next = document.clone();
    next.regions = regions.into();
    Ok(next)
}

/// Regions that are worked on are regions that are wanted: the answer follows them at once.
fn by_regions(document: &mut Document, regions: Vec<Region>) -> Result<(), String> {
    if !document.loaded_session.single_revolute() {
        return Err(say!("regions are for a single joint that turns").to_owned());
    }
    // Exactly as a file will have them: what is saved is read again to the last bit.
    let as_saved = |region: Region| Region {
        from_rad: rad_from_deg(degrees(region.from_rad)),
        to_rad: rad_from_deg(degrees(region.to_rad)),
        ..region
    };
    let regions: Vec<Region> = regions.into_iter().map(as_saved).collect();
    // Regions that stay as they are stay the same to everything that looks at them.
    if document.regions[..] != regions[..] {
        document.regions = Arc::from(regions);
    }
    document.method = Method::Regional;
    document.identified = true;
    Ok(())
}
