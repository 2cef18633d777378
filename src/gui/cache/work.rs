//! What a chart is made of, worked out in the background when something changes: no frame looks at
//! all samples. Which chart it is for only that chart knows.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};

/// What is worked out: samples, the newest answer, the component that is looked at.
#[derive(Clone, Copy)]
pub(crate) struct ChartInputs<'a> {
    pub(crate) loaded_session: &'a LoadedSession,
    pub(crate) answer: Option<&'a Answer>,
    pub(crate) component: Component,
}

impl ChartInputs<'_> {
    /// The component of some samples' deviations before, and after where it is known.
    pub(crate) fn values(self, samples: &[usize]) -> (Vec<f64>, Option<Vec<f64>>) {
        let of = |deviation: &dyn Fn(usize) -> [f64; 3]| {
            let value = |i: &usize| {
                self.loaded_session
                    .component(deviation(*i), *i, self.component)
            };
            samples.iter().map(value).collect::<Vec<f64>>()
        };
        let before = of(&|i| self.loaded_session.deviation_before(i));
        let after = self.answer.map(|answer| of(&|i| answer.deviation_after(i)));
        (before, after)
    }
}

/// What came of it.
pub(crate) type ChartResult = Arc<dyn Any + Send + Sync>;

type Make = dyn Fn(ChartInputs<'_>) -> ChartResult + Send + Sync;

/// What a chart has computed for one key. Two are the same if they are of one chart and have the same key.
#[derive(Clone)]
pub(crate) struct Work {
    chart: &'static str,
    key: Vec<usize>,
    make: Arc<Make>,
}

impl Work {
    pub(crate) fn new<T: Any + Send + Sync>(
        chart: &'static str,
        key: Vec<usize>,
        make: impl Fn(ChartInputs<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        let make = Arc::new(move |inputs: ChartInputs<'_>| Arc::new(make(inputs)) as ChartResult);
        Self { chart, key, make }
    }

    /// Works it out. Takes its time with many samples.
    pub(crate) fn done(&self, inputs: ChartInputs<'_>) -> ChartResult {
        (self.make)(inputs)
    }
}

impl PartialEq for Work {
    fn eq(&self, other: &Self) -> bool {
        (self.chart, &self.key) == (other.chart, &other.key)
    }
}

impl fmt::Debug for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:?}", self.chart, self.key)
    }
}
