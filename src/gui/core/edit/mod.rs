//! Changes of the document, what those of its regions make of it (`apply` has all others), and their history.

mod apply;

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

/// Entries that are kept; the oldest goes first.
const MOST_ENTRIES: usize = 200;

#[derive(Debug, Clone)]
struct Entry<D> {
    document: Arc<D>,
    what: Template,
}

/// Undo and redo: whole documents, one entry for each finished gesture.
///
/// Documents share what did not change behind `Arc`s, so that keeping many costs little. While a
/// gesture (a drag) is under way the document changes many times; only its state before the
/// gesture is kept.
#[derive(Debug, Clone)]
pub(crate) struct History<D> {
    present: Arc<D>,
    past: Vec<Entry<D>>,
    future: Vec<Entry<D>>,
    /// The document before the gesture that is under way.
    gesture: Option<Entry<D>>,
}

impl<D: PartialEq> History<D> {
    /// A history that starts here.
    pub(crate) fn new(document: D) -> Self {
        Self {
            present: Arc::new(document),
            past: Vec::new(),
            future: Vec::new(),
            gesture: None,
        }
    }

    /// The document as it is now.
    pub(crate) fn present(&self) -> &Arc<D> {
        &self.present
    }

    /// A finished change.
    pub(crate) fn change(&mut self, document: D, what: Template) {
        self.finish_gesture();
        if *self.present == document {
            return;
        }
        let document = std::mem::replace(&mut self.present, Arc::new(document));
        self.keep(Entry { document, what });
    }

    /// A change within a gesture; the first one begins it.
    pub(crate) fn change_within_gesture(&mut self, document: D, what: Template) {
        if self.gesture.as_ref().is_some_and(|g| g.what != what) {
            self.finish_gesture();
        }
        if *self.present == document {
            return;
        }
        let document = std::mem::replace(&mut self.present, Arc::new(document));
        self.gesture.get_or_insert(Entry { document, what });
    }

    /// Ends the gesture that is under way: one entry, unless it came back to where it began.
    pub(crate) fn finish_gesture(&mut self) {
        if let Some(entry) = self.gesture.take()
            && *entry.document != *self.present
        {
            self.keep(entry);
        }
    }

    fn keep(&mut self, entry: Entry<D>) {
        self.past.push(entry);
        self.future.clear();
        if self.past.len() > MOST_ENTRIES {
            self.past.remove(0);
        }
    }

    /// What the next undo takes back.
    pub(crate) fn undoes(&self) -> Option<Template> {
        let open = self.gesture.as_ref().or(self.past.last());
        open.map(|entry| entry.what)
    }

    /// What the next redo brings back.
    pub(crate) fn redoes(&self) -> Option<Template> {
        self.future.last().map(|entry| entry.what)
    }

    /// Takes the last change back. Whether there was one.
    pub(crate) fn undo(&mut self) -> bool {
        self.finish_gesture();
        step(&mut self.present, &mut self.past, &mut self.future)
    }

    /// Brings the last undone change back. Whether there was one.
    pub(crate) fn redo(&mut self) -> bool {
        self.finish_gesture();
        step(&mut self.present, &mut self.future, &mut self.past)
    }
}

/// The newest entry of one side is the present one now, which is kept on the other. Whether there was one.
fn step<D>(present: &mut Arc<D>, from: &mut Vec<Entry<D>>, to: &mut Vec<Entry<D>>) -> bool {
    let Some(Entry { document, what }) = from.pop() else {
        return false;
    };
    let document = std::mem::replace(present, document);
    to.push(Entry { document, what });
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A name that no person reads.
    fn step(name: &'static str) -> Template {
        Template::new("", name, "")
    }

    #[test]
    fn a_gesture_is_one_entry_however_many_steps_it_has() {
        let mut history = History::new(0);
        for k in 1..=50 {
            history.change_within_gesture(k, step("drag"));
        }
        history.finish_gesture();
        assert_eq!(history.undoes(), Some(step("drag")));
        assert!(history.undo());
        assert_eq!(**history.present(), 0);
        assert!(!history.undo());
        assert!(history.redo());
        assert_eq!(**history.present(), 50);
    }

    #[test]
    fn a_gesture_that_comes_back_leaves_no_entry() {
        let mut history = History::new(7);
        history.change_within_gesture(8, step("drag"));
        history.change_within_gesture(7, step("drag"));
        history.finish_gesture();
        assert_eq!(history.undoes(), None);
    }

    #[test]
    fn undo_in_the_middle_of_a_gesture_takes_the_gesture_back() {
        let mut history = History::new(1);
        history.change(2, step("type"));
        history.change_within_gesture(3, step("drag"));
        assert!(history.undo());
        assert_eq!(**history.present(), 2);
    }

    #[test]
    fn a_new_change_after_undo_forgets_what_was_undone() {
        let mut history = History::new(1);
        history.change(2, step("a"));
        history.undo();
        history.change(3, step("b"));
        assert!(!history.redo());
        assert_eq!(**history.present(), 3);
    }

    #[test]
    fn the_history_does_not_grow_without_end() {
        let mut history = History::new(0);
        for k in 1..=2 * MOST_ENTRIES {
            history.change(k, step("count"));
        }
        let mut undone = 0;
        while history.undo() {
            undone += 1;
        }
        assert_eq!(undone, MOST_ENTRIES);
    }
}
