//! What is worked out once, in the background, so that no frame looks at all samples; and what plots of many samples
//! stand on: the heat map, what the charts are made of. A few samples are simply looked at
//! anew in every frame, so that nothing has to be waited for.

pub(crate) mod cloud;
pub(crate) mod heat;
pub(crate) mod identified;

use std::any::Any;
use std::cell::RefCell;
use std::fmt;
use std::sync::Arc;

use cloud::Uncertain;
use heat::Heat;
use identified::{IdentifiedAnswer, figures};

use crate::compensation::decision::FittedErrors;
use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::Quantity;
use crate::gui::jobs::Follows;
use crate::gui::view::Plane;

/// The session and the answer that something is worked out for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlotInputs {
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) identified: Option<Arc<IdentifiedAnswer>>,
}

/// Something that was worked out.
#[derive(Debug)]
pub(crate) struct Made {
    pub(crate) inputs: PlotInputs,
    pub(crate) result: ChartResult,
}

impl Follows for Made {
    type Of = PlotInputs;

    fn of(&self) -> &PlotInputs {
        &self.inputs
    }
}

/// What was worked out last, and of what: the same is not worked out again.
#[derive(Debug)]
pub(crate) struct Memo<K, V>(RefCell<Option<(K, V)>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(RefCell::new(None))
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    pub(crate) fn get(&self, of: K, make: impl FnOnce() -> V) -> V {
        let last = self.0.take().filter(|(before, _)| *before == of);
        let (of, made) = last.unwrap_or_else(|| (of, make()));
        self.0.replace(Some((of, made.clone())));
        made
    }
}

impl PlotInputs {
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.identified.as_ref()?.answer.as_ref().ok()
    }

    /// Samples that can be used.
    pub(crate) fn usable(&self) -> Vec<usize> {
        let usable = self.loaded_session.overview.usable.iter();
        usable.map(|sample| *sample as usize).collect()
    }

    /// A component of some samples' deviations before, and after where it is known.
    pub(crate) fn values(
        &self,
        samples: &[usize],
        component: Component,
    ) -> (Vec<f64>, Option<Vec<f64>>) {
        let of = |deviation: &dyn Fn(usize) -> [f64; 3]| {
            let value = |i: &usize| self.loaded_session.component(deviation(*i), *i, component);
            samples.iter().map(value).collect::<Vec<f64>>()
        };
        let before = of(&|i| self.loaded_session.deviation_before(i));
        let after = self
            .answer()
            .map(|answer| of(&|i| answer.deviation_after(i)));
        (before, after)
    }
}

/// What came of it.
pub(crate) type ChartResult = Arc<dyn Any + Send + Sync>;

type Make = dyn Fn(&PlotInputs) -> ChartResult + Send + Sync;

/// What it is that is worked out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum WorkKey {
    /// The error over a plane.
    Heat(Plane),
    /// How sure the model is at each sample.
    Uncertain,
    /// The standards' figures.
    Figures(Option<FittedErrors>),
    /// Where samples are over two quantities.
    Places([Quantity; 2]),
    /// What a chart of this name has of a component, and of what else tells it from others.
    Chart(&'static str, Component, Vec<usize>),
}

/// Something that is worked out in the background. Two are the same if they have the same key.
#[derive(Clone)]
pub(crate) struct Work {
    pub(crate) key: WorkKey,
    make: Arc<Make>,
}

impl Work {
    pub(crate) fn new<T: Any + Send + Sync>(
        key: WorkKey,
        make: impl Fn(&PlotInputs) -> T + Send + Sync + 'static,
    ) -> Self {
        let make = Arc::new(move |given: &PlotInputs| Arc::new(make(given)) as ChartResult);
        Self { key, make }
    }

    /// Works it out. Takes its time with many samples.
    pub(crate) fn made(&self, inputs: PlotInputs) -> Made {
        Made {
            result: (self.make)(&inputs),
            inputs,
        }
    }

    /// The standards' figures, by the errors of a diagnosis where there is one.
    pub(crate) fn figures(diagnosed: Option<FittedErrors>) -> Self {
        let make = move |given: &PlotInputs| {
            figures(&given.loaded_session.session, given.answer(), diagnosed)
        };
        Self::new(WorkKey::Figures(diagnosed), make)
    }

    /// The heat map of a plane.
    pub(crate) fn heat(plane: Plane) -> Self {
        let make = move |given: &PlotInputs| {
            let heat = Heat::of(&given.loaded_session, given.answer(), plane);
            heat.map(Arc::new)
        };
        Self::new(WorkKey::Heat(plane), make)
    }

    /// How sure the model is at each sample.
    pub(crate) fn uncertain() -> Self {
        let make = |given: &PlotInputs| {
            let uncertain = Uncertain::of(&given.loaded_session, given.answer()?);
            uncertain.map(Arc::new)
        };
        Self::new(WorkKey::Uncertain, make)
    }
}

impl PartialEq for Work {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl fmt::Debug for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.key.fmt(f)
    }
}
