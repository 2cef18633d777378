//! What charts are made of: document and answer, how they are looked at, and what the background has
//! worked out.

use std::any::Any;
use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::gui::cache::charts::ChartResult;
use crate::gui::cache::identified::{ExportPreview, IdentifiedAnswer};
use crate::gui::core::answer::Answer;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::Quantity;
use crate::gui::core::search::Search;
use crate::gui::view::ViewState;
use crate::present::chart::Lengths;
use crate::present::units::Units;

/// Document, answer and view, as charts need them.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) document: &'a Document,
    pub(crate) loaded_session: &'a Arc<LoadedSession>,
    pub(crate) view: &'a ViewState,
    /// The component of the deviation that the chart shows.
    pub(crate) component: Component,
    /// The joint that it is about, counted from 0.
    pub(crate) joint: usize,
    /// What a scatter has across and upwards.
    pub(crate) axes: Option<[Quantity; 2]>,
    pub(crate) units: Units,
    pub(crate) answer: Option<&'a Answer>,
    /// The search of this session.
    pub(crate) search: Option<&'a Arc<Search>>,
    /// The export as it would be written.
    pub(crate) made: Option<&'a ExportPreview>,
    /// What the background has worked out for the chart.
    pub(crate) worked_out: Option<&'a (dyn Any + Send + Sync)>,
}

impl<'a> Scene<'a> {
    pub(crate) fn component(&self) -> Component {
        self.component
    }

    pub(crate) fn diagnosis(&self) -> Option<&'a Diagnosis> {
        self.search?.answer.as_ref().ok()
    }

    /// Whether charts leave out the deviation before, so that what is left can be seen.
    pub(crate) fn only_after(&self) -> bool {
        self.view.only_after && self.answer.is_some()
    }

    /// The joint that charts are about.
    pub(crate) fn joint(&self) -> usize {
        let joints = self.loaded_session.session.robot.joints.len();
        self.joint.min(joints.saturating_sub(1))
    }

    /// What the background has worked out, if it is that.
    pub(crate) fn found<T: Any>(&self) -> Option<&'a T> {
        self.worked_out?.downcast_ref()
    }

    /// Samples that can be used.
    pub(crate) fn usable(&self) -> impl ExactSizeIterator<Item = usize> + use<'a> {
        self.loaded_session
            .overview
            .usable
            .iter()
            .map(|s| *s as usize)
    }

    /// How lengths are written, a number by `number`.
    pub(crate) fn lengths<'n>(&self, number: &'n dyn Fn(f64) -> String) -> Lengths<'n> {
        Lengths {
            unit: self.units.length_name(),
            per_mm: self.units.length_value(1.0),
            number,
        }
    }
}

/// The same by itself: the window goes on while something is made of it.
pub(crate) struct HeldScene {
    pub(crate) document: Document,
    pub(crate) view: ViewState,
    pub(crate) component: Component,
    pub(crate) joint: usize,
    pub(crate) axes: Option<[Quantity; 2]>,
    pub(crate) units: Units,
    pub(crate) identified: Option<Arc<IdentifiedAnswer>>,
    pub(crate) search: Option<Arc<Search>>,
    pub(crate) made: Option<ExportPreview>,
    pub(crate) worked_out: Option<ChartResult>,
}

impl HeldScene {
    pub(crate) fn scene(&self) -> Scene<'_> {
        let outcome = self.identified.as_deref();
        Scene {
            document: &self.document,
            loaded_session: &self.document.loaded_session,
            view: &self.view,
            component: self.component,
            joint: self.joint,
            axes: self.axes,
            units: self.units,
            answer: outcome.and_then(|outcome| outcome.answer.as_ref().ok()),
            search: self.search.as_ref(),
            made: self.made.as_ref(),
            worked_out: self.worked_out.as_deref(),
        }
    }
}
