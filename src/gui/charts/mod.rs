//! What is charted: a chart is one file and one line of the register. It says what it is called, when it
//! is offered, and makes of a [`Scene`] (document and answer, how they are looked at, what was worked out) a
//! [`Chart`], which the window, a picture and a table for a spreadsheet show. Nothing here draws.

use std::borrow::Cow;
use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::gui::cache::{ExportPreview, IdentifiedAnswer};
use crate::gui::core::answer::Answer;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::Over;
use crate::gui::core::search::Search;
use crate::gui::help::Word;
use crate::gui::view::Step;
use crate::numeric::whole;
use crate::present::chart::{Chart, ColourRole, Entry, Form, Item, LegendSymbol, Lengths, Mark};
use crate::present::numbers::{Notation, grouped};
use crate::present::table::Table;
use crate::present::units::Units;
use crate::text::{Language, Template, capital, spoken};

macro_rules! register {
    ($($file:ident: $($chart:ident),*;)*) => {
        $(pub(crate) mod $file;)*
        /// Every chart, in the order in which they are offered. The first is shown where nothing
        /// suits better.
        pub(crate) static CHARTS: &[&ChartKind] = &[$($(&$file::$chart),*),*];
    };
}

register! {
    deviation: ANGLE, TIME, LOAD, TEMPERATURE;
    polar: POLAR;
    orders: ORDERS;
    histogram: HISTOGRAM;
    gap: GAP;
    axis_test: OF_AXIS;
    effect: EFFECT;
    correction: CORRECTION;
}

/// A chart.
pub(crate) struct ChartKind {
    /// What it is: what its picture is called, as it stands within a sentence.
    pub(crate) id: &'static str,
    name: Template,
    /// What its question mark explains; the glossary lists it.
    pub(crate) word: Word,
    /// What is chosen for it.
    pub(crate) of: ChartChoice,
    /// Whether there is anything to show, or at least something to say.
    pub(crate) is_offered: fn(&Scene) -> bool,
    /// Whether it is what the step is about: it is shown without a choice of the user.
    pub(crate) suits: fn(&Scene) -> bool,
    /// Takes its time with many samples.
    pub(crate) show: fn(&Scene) -> Result<Shown, ChartPlaceholder>,
    /// What it shows, for a spreadsheet.
    pub(crate) numbers: fn(&Scene) -> Table,
}

/// What is chosen for a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ChartChoice {
    /// Nothing: it shows all there is.
    All,
    /// A component of the deviation.
    Component,
    /// A joint.
    Axis,
    /// A component, and a joint.
    Joint,
}

impl ChartKind {
    /// One of measured samples that is shown where it is chosen.
    const fn new(
        id: &'static str,
        word: Word,
        of: ChartChoice,
        show: fn(&Scene) -> Result<Shown, ChartPlaceholder>,
        numbers: fn(&Scene) -> Table,
    ) -> Self {
        Self {
            id,
            name: word.name,
            word,
            of,
            is_offered: |scene| !scene.loaded_session.is_empty(),
            suits: |_| false,
            show,
            numbers,
        }
    }

    pub(crate) fn name(&self) -> String {
        capital(spoken(self.name))
    }
}

/// The chart of this name.
pub(crate) fn find(id: &str) -> Option<&'static ChartKind> {
    CHARTS.iter().copied().find(|chart| chart.id == id)
}

/// What stands in the place of a chart that cannot be shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ChartPlaceholder {
    /// In one line.
    pub(crate) title: String,
    /// What to log or to do, and what for.
    pub(crate) why: String,
}

impl ChartPlaceholder {
    pub(crate) fn new(title: impl Into<String>, why: impl Into<String>) -> Self {
        let (title, why) = (title.into(), why.into());
        Self { title, why }
    }
}

/// A chart as it is of a scene, and what the pointer finds on it.
pub(crate) struct Shown {
    pub(crate) chart: Chart,
    /// How it is called for those who do not see it.
    pub(crate) name: String,
    /// Samples, each series in the place of the marks of its colour. The last that has a sample rings it.
    pub(crate) series: Vec<Series>,
    /// What is said about places along the chart.
    pub(crate) bars: Vec<Bar>,
}

impl Shown {
    /// With samples at their places.
    fn of(
        chart: Chart,
        name: String,
        stages: &[Stage],
        place: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Self {
        let series = stages.iter();
        let series = series.map(|one| Series::new(one, chart.bounds, &place));
        Self {
            series: series.collect(),
            ..Self::new(chart, name)
        }
    }

    fn new(chart: Chart, name: impl Into<String>) -> Self {
        Self {
            chart,
            name: name.into(),
            series: Vec::new(),
            bars: Vec::new(),
        }
    }

    /// What is drawn between two places along the chart: of many samples some.
    pub(crate) fn in_sight(&self, x: [f64; 2]) -> impl Iterator<Item = Cow<'_, Item>> {
        self.chart.items.iter().map(move |item| {
            let mut series = self.series.iter();
            let series = series.find(|one| Some(one.role) == item.colour_role());
            match (item, series) {
                (Item::Marks(_, role, filled), Some(series)) => {
                    let marks = series.in_sight(x).iter().map(|s| series.marks[*s as usize]);
                    Cow::Owned(Item::Marks(marks.collect(), *role, *filled))
                }
                _ => Cow::Borrowed(item),
            }
        })
    }

    /// What is seen, in words.
    pub(crate) fn description(&self) -> String {
        let chart = &self.chart;
        let legend = chart.legend.iter().map(|entry| &*entry.name);
        let legend = legend.collect::<Vec<_>>().join(", ");
        let mut says = vec![&*chart.title, &legend, &chart.note];
        says.retain(|one| !one.is_empty());
        says.join("; ")
    }
}

/// Before, 0, or after, 1.
pub(crate) type When = usize;

/// A bar, or what stands in its place.
pub(crate) struct Bar {
    /// From where to where along the chart.
    pub(crate) x: [f64; 2],
    pub(crate) title: String,
    pub(crate) lines: Vec<(String, String)>,
    /// The samples that a click marks, in ascending order.
    pub(crate) samples: Vec<usize>,
}

/// Samples of one colour, and their marks.
type Stage = (ColourRole, Vec<(usize, Mark)>);

/// Cells across and upwards, in which one of many samples is drawn.
const CELLS: [usize; 2] = [160, 60];

/// As many in sight are all drawn.
const MOST_MARKS: usize = 1500;

/// Samples of one colour. Of many one stands for all in its small cell of the chart, until few are in sight.
pub(crate) struct Series {
    role: ColourRole,
    /// Of every sample of the session; NaN where it is not shown.
    marks: Vec<Mark>,
    /// Those that are shown, from the left to the right.
    shown: Vec<u32>,
    /// One for each cell in which there are any; all where they are few.
    drawn: Vec<u32>,
}

impl Series {
    /// Of these samples, each at its place, on a chart of these bounds.
    fn new(
        (role, placed): &Stage,
        [low, high]: [[f64; 2]; 2],
        place: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Self {
        let nowhere = Mark {
            at: [f64::NAN; 2],
            form: Form::Disc,
        };
        let count = placed.iter().map(|(sample, _)| sample + 1).max();
        let mut marks = vec![nowhere; count.unwrap_or(0)];
        for (sample, mark) in placed {
            let at = place(mark.at);
            marks[*sample] = Mark { at, ..*mark };
        }
        let finite = |(_, mark): &(u32, &Mark)| mark.at.iter().all(|v| v.is_finite());
        let shown = (0_u32..).zip(&marks).filter(finite);
        let mut shown: Vec<u32> = shown.map(|(sample, _)| sample).collect();
        let at = |sample: u32| marks[sample as usize].at;
        shown.sort_by(|a, b| at(*a)[0].total_cmp(&at(*b)[0]));
        let mut drawn = shown.clone();
        if drawn.len() > MOST_MARKS {
            let mut taken = vec![false; CELLS[0] * CELLS[1]];
            drawn.retain(|sample| {
                let [x, y] = [0, 1].map(|k| {
                    let part = (at(*sample)[k] - low[k]) / (high[k] - low[k]);
                    whole((part * CELLS[k] as f64).floor().max(0.0)).min(CELLS[k] - 1)
                });
                !std::mem::replace(&mut taken[x + CELLS[0] * y], true)
            });
        }
        Self {
            role: *role,
            marks,
            shown,
            drawn,
        }
    }

    /// Where a sample is.
    pub(crate) fn at(&self, sample: usize) -> Option<[f64; 2]> {
        let mark = self.marks.get(sample)?;
        mark.at.iter().all(|v| v.is_finite()).then_some(mark.at)
    }

    /// Those to be drawn between two places along the chart.
    pub(crate) fn in_sight(&self, x: [f64; 2]) -> &[u32] {
        let within = |samples: &[u32]| {
            let across = |sample: &u32| self.marks[*sample as usize].at[0];
            let from = samples.partition_point(|s| across(s) < x[0]);
            from..samples.partition_point(|s| across(s) <= x[1]).max(from)
        };
        let all = within(&self.shown);
        if all.len() <= MOST_MARKS {
            return &self.shown[all];
        }
        &self.drawn[within(&self.drawn)]
    }
}

/// What is said of samples that are not all drawn, or of which not `all` are shown.
fn not_drawn(series: &[Series], all: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let Some(last) = series.last() else {
        return notes;
    };
    let (drawn, shown) = (last.drawn.len(), last.shown.len());
    if drawn < shown {
        notes.push(say!(
            "{drawn} of {all} points shown: zoom in for more",
            drawn = grouped(drawn),
            all = grouped(shown)
        ));
    }
    if shown < all {
        notes.push(say!(
            one "{count} sample has no value and is not shown",
            "{count} samples have no value and are not shown",
            count = all - shown
        ));
    }
    notes
}

/// Document and answer, and how they are looked at: all that a chart follows from. It lasts by itself: the window goes
/// on while one is made of it.
#[derive(Clone, PartialEq)]
pub(crate) struct Scene {
    pub(crate) document: Arc<Document>,
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) step: Step,
    /// The found effect whose curve is charted, by its place in the answer.
    pub(crate) effect: usize,
    /// Whether the deviation before is left out, so that what is left can be seen.
    pub(crate) only_after: bool,
    /// The component of the deviation that the chart shows.
    pub(crate) component: Component,
    /// The joint that it is about, counted from 0.
    pub(crate) joint: usize,
    pub(crate) units: Units,
    /// What has an answer.
    pub(crate) identified: Option<Arc<IdentifiedAnswer>>,
    /// The search of this session.
    pub(crate) search: Option<Arc<Search>>,
    /// The export as it would be written.
    pub(crate) preview: Option<Arc<ExportPreview>>,
    /// How words and numbers are written.
    pub(crate) written: (Language, Notation),
}

impl Scene {
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.identified.as_ref()?.answer.as_ref().ok()
    }

    /// The component of a sample's deviation, before or after, mm; NaN where that is not known.
    fn value(&self, when: When, sample: usize) -> f64 {
        let deviation = match when {
            0 => Some(self.loaded_session.deviation_before(sample)),
            _ => self.answer().map(|answer| answer.deviation_after(sample)),
        };
        let value = |e| self.loaded_session.component(e, sample, self.component);
        deviation.map_or(f64::NAN, value)
    }

    /// The same of some samples before, and after where it is known.
    fn values(&self, samples: &[usize]) -> (Vec<f64>, Option<Vec<f64>>) {
        let of = |when| samples.iter().map(|i| self.value(when, *i)).collect();
        (of(0), self.answer().map(|_| of(1)))
    }

    /// Samples over a quantity in inner units, before, after or both as they are shown, each stage in its colour.
    fn stages(&self, over: Over) -> Vec<Stage> {
        let (session, after) = (&self.loaded_session, self.answer().is_some());
        let mark = |when: When, sample: usize| Mark {
            at: [over.of(session, sample), self.value(when, sample)],
            form: Form::of_side(session.side(over.joint, sample)),
        };
        let marks = |when| self.usable().map(move |s| (s, mark(when, s))).collect();
        let before = !(after && self.only_after);
        let before = before.then(|| (ColourRole::Before, marks(0)));
        let after = after.then(|| (ColourRole::After, marks(1)));
        before.into_iter().chain(after).collect()
    }

    pub(crate) fn diagnosis(&self) -> Option<&Diagnosis> {
        self.search.as_ref()?.answer.as_ref().ok()
    }

    /// The joint that charts are about.
    pub(crate) fn joint(&self) -> usize {
        let joints = self.loaded_session.session.robot.joints.len();
        self.joint.min(joints.saturating_sub(1))
    }

    pub(crate) fn usable(&self) -> impl ExactSizeIterator<Item = usize> {
        self.loaded_session
            .overview
            .usable
            .iter()
            .map(|s| *s as usize)
    }

    /// What was before, and what is after where there is an answer, each with this sign.
    pub(crate) fn legend(&self, sign: LegendSymbol) -> Vec<Entry> {
        let after = self.answer().map(|_| Entry::after(sign));
        [Entry::before(sign)].into_iter().chain(after).collect()
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

/// What noise does, in a legend.
fn of_noise(name: &str) -> Entry {
    Entry::new(name, LegendSymbol::Line, ColourRole::Noise, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_are_called_differently() {
        for (k, chart) in CHARTS.iter().enumerate() {
            let (id, name) = (chart.id, chart.name());
            let same = |other: &&&ChartKind| other.id == id || other.name() == name;
            assert_eq!(CHARTS.iter().filter(same).count(), 1, "{id}");
            assert!(find(id).is_some_and(|found| found.name() == name), "{k}");
        }
    }

    #[test]
    fn every_file_of_the_folder_is_registered() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/gui/charts");
        let code = std::fs::read_to_string(format!("{folder}/mod.rs")).expect("this file");
        for entry in std::fs::read_dir(folder).expect("the folder") {
            let path = entry.expect("an entry").path();
            let file = path.file_stem().and_then(|s| s.to_str()).expect("a name");
            let there = file == "mod" || code.contains(&format!("    {file}: "));
            assert!(there, "{file} is not in the register");
        }
    }

    #[test]
    fn of_many_one_is_drawn_for_each_cell_and_all_where_few_are_in_sight() {
        let n = 200_000;
        let mark = |i: usize| Mark {
            at: [i as f64, ((i * 7919) % 1000) as f64],
            form: Form::Disc,
        };
        let stage = (ColourRole::Before, (0..n).map(|i| (i, mark(i))).collect());
        let of = |high: f64| Series::new(&stage, [[0.0; 2], [n as f64, high]], |at| at);
        let series = of(1000.0);
        let cells = CELLS[0] * CELLS[1];
        assert!((cells / 2..=cells).contains(&series.drawn.len()));
        assert_eq!(series.in_sight([0.0, 1e9]), series.drawn);
        assert_eq!(series.in_sight([1000.0, 1099.0]).len(), 100);
        assert!(series.in_sight([5.0, 4.0]).is_empty());
        // Within what counts as nothing there is one row of cells.
        assert_eq!(of(1e9).drawn.len(), CELLS[0]);
    }
}
