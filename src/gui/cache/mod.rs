//! What is worked out once, in the background, so that no frame looks at all samples; and what plots of many samples
//! stand on: the heat map, what the charts are made of. A few samples are simply looked at
//! anew in every frame, so that nothing has to be waited for.

pub(crate) mod charts;
pub(crate) mod cloud;
pub(crate) mod heat;
pub(crate) mod identified;

use std::sync::Arc;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::view::Plane;

use charts::{ChartInputs, ChartResult, Work};
use cloud::Uncertain;
use heat::Heat;
use identified::IdentifiedAnswer;

/// What a backdrop is made of.
#[derive(Debug, Clone, PartialEq)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each says whether one thing is shown"
)]
pub(crate) struct PlotInputs {
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) identified: Option<Arc<IdentifiedAnswer>>,
    /// The plane of the workspace.
    pub(crate) plane: Plane,
    /// Whether the heat map is shown.
    pub(crate) heat: bool,
    /// Whether colour says how sure the model is.
    pub(crate) uncertain: bool,
    /// What the charts need, each of its own component.
    pub(crate) charts: Vec<(Component, Work)>,
}

impl PlotInputs {
    fn answer(&self) -> Option<&Answer> {
        self.identified.as_ref()?.answer.as_ref().ok()
    }

    fn chart_inputs(&self, component: Component) -> ChartInputs<'_> {
        ChartInputs {
            loaded_session: &self.loaded_session,
            answer: self.answer(),
            component,
        }
    }

    /// Whether there is anything to work out.
    pub(crate) fn any(&self) -> bool {
        self.heat || self.uncertain || !self.charts.is_empty()
    }
}

#[derive(Debug, Clone)]
pub(crate) struct PlotCache {
    /// What it was made of.
    pub(crate) inputs: PlotInputs,
    /// The error over the plane.
    pub(crate) heat: Option<Arc<Heat>>,
    /// How sure the model is at each sample.
    pub(crate) uncertain: Option<Arc<Uncertain>>,
    /// What the charts are made of, in the scenery's order.
    pub(crate) charted: Vec<ChartResult>,
}

impl PlotCache {
    /// What was worked out for a chart.
    pub(crate) fn charted_for(&self, wanted: &(Component, Work)) -> Option<&ChartResult> {
        let here = self.inputs.charts.iter().position(|one| one == wanted)?;
        self.charted.get(here)
    }

    /// Works it out; what the last one has already is taken from there.
    pub(crate) fn of(scenery: PlotInputs, last: Option<&Self>) -> Self {
        let last = last.filter(|l| l.inputs.loaded_session == scenery.loaded_session);
        let same_plane = last.filter(|l| l.inputs.plane == scenery.plane);
        let same_answer = last.filter(|l| l.inputs.identified == scenery.identified);
        let heat_of = same_answer.filter(|_| same_plane.is_some());
        let loaded_session = &*scenery.loaded_session;
        let heat = heat_of.and_then(|l| l.heat.clone()).or_else(|| {
            let wanted = scenery.heat.then(|| {
                let heat = Heat::of(loaded_session, scenery.answer(), scenery.plane)?;
                Some(Arc::new(heat))
            });
            wanted.flatten()
        });
        let known = same_answer.and_then(|l| l.uncertain.clone());
        let uncertain = known.or_else(|| {
            let answer = scenery.answer().filter(|_| scenery.uncertain)?;
            Uncertain::of(loaded_session, answer).map(Arc::new)
        });
        let charted = scenery.charts.iter().map(|wanted| {
            let known = same_answer.and_then(|last| last.charted_for(wanted));
            known
                .cloned()
                .unwrap_or_else(|| wanted.1.done(scenery.chart_inputs(wanted.0)))
        });
        let charted = charted.collect();
        Self {
            inputs: scenery,
            heat,
            uncertain,
            charted,
        }
    }
}
