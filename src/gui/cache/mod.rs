//! What is worked out once, in the background, so that no frame looks at all samples; and what plots of many samples
//! stand on: the heat map, what the charts are made of. A few samples are simply looked at
//! anew in every frame, so that nothing has to be waited for.
//!
//! A chart of many samples shows what lies between the smallest and the largest deviation in each column
//! of pixels. Samples are sorted by what the chart stands over once, for each side from which it came; while the view
//! stands still the columns are those of the frame before.

pub(crate) mod cloud;
pub(crate) mod heat;
pub(crate) mod identified;

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex};

use cloud::Uncertain;
use heat::Heat;
use identified::IdentifiedAnswer;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::Over;
use crate::gui::view::Plane;
use crate::numeric::single;

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

/// Smallest and largest of values, if there are any; what is not finite is passed over.
fn extremes(values: &[f32]) -> Option<[f64; 2]> {
    let finite = values.iter().filter(|v| v.is_finite());
    let nothing = [f32::INFINITY, f32::NEG_INFINITY];
    let [low, high] = finite.fold(nothing, |[a, b], v| [a.min(*v), b.max(*v)]);
    (low <= high).then(|| [low, high].map(f64::from))
}

/// Samples that the joint reached from one side.
#[derive(Debug, Clone, PartialEq)]
struct Track {
    side: f64,
    samples: Vec<u32>,
    x: Vec<f64>,
    before: Vec<f32>,
    after: Option<Vec<f32>>,
}

/// A column: from where to where along the chart, and what lies in it, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Column {
    /// From this value of what the chart stands over to that.
    pub(crate) x: [f64; 2],
    /// Smallest and largest deviation before.
    pub(crate) before_mm: Option<[f64; 2]>,
    /// Smallest and largest of what is left.
    pub(crate) after_mm: Option<[f64; 2]>,
}

impl Column {
    /// Around samples: place along the chart, deviation before, deviation after.
    pub(crate) fn around(samples: impl Iterator<Item = (f64, f64, Option<f64>)>) -> Option<Self> {
        let known = |mm: f64| mm.is_finite().then_some([mm; 2]);
        let one = |(x, before, after): (f64, f64, Option<f64>)| Self {
            x: [x; 2],
            before_mm: known(before),
            after_mm: after.and_then(known),
        };
        samples.map(one).reduce(Self::with)
    }

    /// Both, and all between them.
    fn with(self, other: Self) -> Self {
        Self {
            x: [self.x[0].min(other.x[0]), self.x[1].max(other.x[1])],
            before_mm: widest(self.before_mm, other.before_mm),
            after_mm: widest(self.after_mm, other.after_mm),
        }
    }
}

/// A chart of many samples: what lies between the extremes in each column of pixels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Envelope {
    tracks: Vec<Track>,
    /// Everything.
    extent: Option<Column>,
    last: Last,
}

/// Columns, where they are asked for, and how many.
type Asked = ([f64; 2], usize, Arc<[Column]>);

/// The columns that were asked for last. A frame asks for those of the frame before unless the view
/// moves: a boundary that is dragged beside the chart costs it no search.
#[derive(Debug, Default)]
struct Last(Mutex<Option<Asked>>);

impl Clone for Last {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Last {
    /// It follows from the samples.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Envelope {
    /// Sorts the samples of a session.
    pub(crate) fn of(inputs: ChartInputs<'_>, over: Over) -> Self {
        let ChartInputs {
            loaded_session,
            answer,
            component,
        } = inputs;
        let usable = &loaded_session.overview.usable;
        let track = |side: f64| {
            let x = |sample: u32| over.of(loaded_session, sample as usize);
            let of_side = |sample: &u32| {
                over.side(loaded_session, *sample as usize) == side && x(*sample).is_finite()
            };
            let mut samples: Vec<u32> = usable.iter().copied().filter(of_side).collect();
            samples.sort_unstable_by(|a, b| x(*a).total_cmp(&x(*b)).then(a.cmp(b)));
            let values = |deviation: &dyn Fn(usize) -> [f64; 3]| {
                let value = |sample: &u32| {
                    let sample = *sample as usize;
                    single(loaded_session.component(deviation(sample), sample, component))
                };
                samples.iter().map(value).collect()
            };
            Track {
                side,
                x: samples.iter().map(|sample| x(*sample)).collect(),
                before: values(&|sample| loaded_session.deviation_before(sample)),
                after: answer.map(|answer| values(&|sample| answer.deviation_after(sample))),
                samples,
            }
        };
        let tracks = [-1.0, 0.0, 1.0].into_iter().map(track);
        let tracks: Vec<Track> = tracks.filter(|t| !t.samples.is_empty()).collect();
        let whole = tracks.iter().map(|t| {
            let last = t.x.len() - 1;
            t.column([t.x[0], t.x[last]], 0, last + 1)
        });
        Self {
            extent: whole.reduce(Column::with),
            tracks,
            last: Last::default(),
        }
    }

    /// Smallest and largest value along the chart, and of the deviations before and after.
    pub(crate) fn extent(&self) -> Option<Column> {
        self.extent
    }

    /// How many samples have a place along the chart.
    pub(crate) fn placed(&self) -> usize {
        self.tracks.iter().map(|t| t.samples.len()).sum()
    }

    /// How many samples are between two values along the chart.
    pub(crate) fn count(&self, x: [f64; 2]) -> usize {
        let ranges = self.tracks.iter().map(|t| t.range(x));
        ranges.map(|(from, to)| to - from).sum()
    }

    /// The samples between two values along the chart, thinned to about `most`.
    pub(crate) fn samples(&self, x: [f64; 2], most: usize) -> impl Iterator<Item = usize> {
        let step = self.count(x).div_ceil(most).max(1);
        let of_track = move |t: &Track| {
            let (from, to) = t.range(x);
            let samples: Vec<u32> = t.samples[from..to].iter().copied().step_by(step).collect();
            samples
        };
        let samples = self.tracks.iter().flat_map(of_track);
        samples.map(|sample| sample as usize)
    }

    /// The columns of each side between two values along the chart; those without a sample are left out.
    pub(crate) fn columns(&self, x: [f64; 2], number: usize) -> Arc<[Column]> {
        let Ok(mut last) = self.last.0.lock() else {
            return self.searched(x, number).into();
        };
        if let Some((of, many, columns)) = &*last
            && (*of, *many) == (x, number)
        {
            return Arc::clone(columns);
        }
        let columns: Arc<[Column]> = self.searched(x, number).into();
        *last = Some((x, number, Arc::clone(&columns)));
        columns
    }

    fn searched(&self, [low, high]: [f64; 2], number: usize) -> Vec<Column> {
        let width = (high - low) / number as f64;
        let mut columns = Vec::new();
        if !(width > 0.0 && width.is_finite()) {
            return columns;
        }
        for track in &self.tracks {
            let mut from = track.x.partition_point(|x| *x < low);
            for k in 0..number {
                let end = low + width * (k + 1) as f64;
                let to = from + track.x[from..].partition_point(|x| *x < end);
                if to > from {
                    columns.push(track.column([end - width, end], from, to));
                }
                from = to;
            }
        }
        columns
    }

    /// Whether samples came from different sides.
    pub(crate) fn sides(&self) -> bool {
        self.tracks.iter().any(|t| t.side != 0.0)
    }
}

impl Track {
    fn range(&self, [low, high]: [f64; 2]) -> (usize, usize) {
        let from = self.x.partition_point(|x| *x < low);
        let to = self.x.partition_point(|x| *x <= high);
        (from, to.max(from))
    }

    fn column(&self, x: [f64; 2], from: usize, to: usize) -> Column {
        Column {
            x,
            before_mm: extremes(&self.before[from..to]),
            after_mm: self.after.as_ref().and_then(|a| extremes(&a[from..to])),
        }
    }
}

fn widest(a: Option<[f64; 2]>, b: Option<[f64; 2]>) -> Option<[f64; 2]> {
    match (a, b) {
        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use crate::gui::core::loaded_session::Component;
    use crate::gui::core::quantity::Variable;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    use super::*;

    const ANGLE: Over = Over {
        variable: Variable::Joint,
        joint: 0,
    };

    fn chart_inputs(workbench: &Workbench, component: Component) -> ChartInputs<'_> {
        ChartInputs {
            loaded_session: workbench.loaded_session(),
            answer: workbench.answer(),
            component,
        }
    }

    #[test]
    fn columns_hold_what_the_samples_hold() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        let loaded_session = workbench.loaded_session();
        let envelope = Envelope::of(chart_inputs(&workbench, Component::Radial), ANGLE);
        let all = envelope.extent().expect("there are samples");
        let columns = envelope.columns([all.x[0], all.x[1] + 1e-9], 7);
        for side in [-1.0, 1.0] {
            let of_side = |i: &usize| loaded_session.side(*i) == side;
            for sample in (0..loaded_session.len()).filter(of_side) {
                let x = loaded_session.q(sample);
                let e = loaded_session.deviation_before(sample);
                let mm = loaded_session.component(e, sample, Component::Radial);
                let holds = |c: &&Column| {
                    let [low, high] = c.before_mm.expect("a column has samples");
                    c.x[0] <= x && x <= c.x[1] && low - 1e-6 <= mm && mm <= high + 1e-6
                };
                assert!(columns.iter().any(|c| holds(&c)), "{sample}");
            }
        }
        assert!(columns.len() <= 14 && columns.iter().all(|c| c.after_mm.is_some()));
        assert_eq!(envelope.count(all.x), loaded_session.len());
        assert_eq!(
            envelope.samples(all.x, 10_000).count(),
            loaded_session.len()
        );
        assert!(envelope.samples(all.x, 20).count() <= 22);
    }

    #[test]
    fn an_envelope_of_nothing_is_empty() {
        let envelope = Envelope {
            tracks: Vec::new(),
            extent: None,
            last: Last::default(),
        };
        assert_eq!(envelope.extent(), None);
        assert!(envelope.columns([0.0, 1.0], 10).is_empty());
        assert!(envelope.columns([0.0, 0.0], 10).is_empty());
    }

    #[test]
    fn columns_are_searched_again_only_where_something_else_is_asked() {
        let workbench = workbench();
        let envelope = Envelope::of(chart_inputs(&workbench, Component::Tangential), ANGLE);
        let all = envelope.extent().expect("there are samples").x;
        let first = envelope.columns(all, 50);
        assert!(Arc::ptr_eq(&first, &envelope.columns(all, 50)));
        for (x, number) in [(all, 51), ([all[0], 0.5 * all[1]], 50), (all, 50)] {
            let found = envelope.columns(x, number);
            assert_eq!(found[..], envelope.searched(x, number)[..]);
        }
        assert_eq!(envelope.columns(all, 50), first);
        // Each copy remembers for itself, and is the same.
        let copy = envelope.clone();
        assert!(!Arc::ptr_eq(
            &copy.columns(all, 50),
            &envelope.columns(all, 50)
        ));
        assert!(copy == envelope);
    }
}
