//! What is charted: a chart is one file and one line of the register. It says what it is called, when it
//! is offered, what the background works out for it, and makes of a [`Scene`] (document and answer, how they
//! are looked at, what was worked out) a [`Chart`], which the window, a picture and a table for a spreadsheet
//! show. Nothing here draws.

use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::gui::cache::points::{Points, PointsOfBoth, When, at};
use crate::gui::cache::{ExportPreview, IdentifiedAnswer};
use crate::gui::core::answer::Answer;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::{Over, Scale};
use crate::gui::core::search::Search;
use crate::gui::help::Word;
use crate::gui::view::{Plane, Step};
use crate::present::chart::{Chart, ColourRole, Entry, Form, Item, LegendSymbol, Lengths, Mark};
use crate::present::numbers::{Notation, grouped};
use crate::present::table::Table;
use crate::present::units::Units;
use crate::text::{Language, Template, spoken};

macro_rules! register {
    ($($file:ident: $($chart:ident),*;)*) => {
        $(pub(crate) mod $file;)*
        /// Every chart, in the order in which they are offered. The first is shown where nothing
        /// suits better.
        pub(crate) static CHARTS: &[&dyn ChartKind] = &[$($(&$file::$chart),*),*];
    };
}

register! {
    deviation: ANGLE, TIME, LOAD, TEMPERATURE;
    polar: Polar;
    orders: Orders;
    histogram: Histogram;
    gap: Gap;
    axis_test: OfAxis;
    effect: Effect;
    correction: Correction;
}

/// What a chart says of itself.
#[derive(Clone, Copy)]
pub(crate) struct About {
    /// What it is: what its picture is called, as it stands within a sentence.
    pub(crate) id: &'static str,
    /// Its name where there is little room.
    short: Template,
    name: Template,
    /// What its question mark explains; the glossary lists it.
    pub(crate) word: Word,
    /// What is chosen for it.
    pub(crate) of: ChartChoice,
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

impl About {
    /// `names` are that of the list and that of the plot.
    const fn new(id: &'static str, names: [Template; 2], word: Word, of: ChartChoice) -> Self {
        let [short, name] = names;
        Self {
            id,
            short,
            name,
            word,
            of,
        }
    }

    /// Its name where there is little room.
    pub(crate) fn short(&self) -> &'static str {
        spoken(self.short)
    }

    pub(crate) fn name(&self) -> &'static str {
        spoken(self.name)
    }
}

/// A chart.
pub(crate) trait ChartKind: Sync {
    fn about(&self) -> About;

    /// Whether there is anything to show, or at least something to say.
    fn is_offered(&self, scene: &Scene) -> bool {
        !scene.loaded_session.is_empty()
    }

    /// Whether it is what the step is about: it is shown without a choice of the user.
    fn suits(&self, _: &Scene) -> bool {
        false
    }

    /// Takes its time with many samples.
    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder>;

    /// What it shows, for a spreadsheet.
    fn numbers(&self, scene: &Scene) -> Table;
}

/// The chart of this name.
pub(crate) fn find(id: &str) -> Option<&'static dyn ChartKind> {
    CHARTS.iter().copied().find(|chart| chart.about().id == id)
}

/// What stands in the place of a chart that cannot be shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ChartPlaceholder {
    /// In one line.
    pub(crate) title: String,
    /// What to log or to do, and what for.
    pub(crate) why: &'static str,
}

impl ChartPlaceholder {
    pub(crate) fn new(title: impl Into<String>, why: &'static str) -> Self {
        let title = title.into();
        Self { title, why }
    }
}

/// A chart as it is of a scene, and what the pointer finds on it.
pub(crate) struct Shown {
    pub(crate) chart: Chart,
    /// How it is called for those who do not see it.
    pub(crate) name: String,
    /// What is seen, in words.
    pub(crate) description: String,
    pub(crate) pointed: HoverTarget,
}

/// What the pointer finds on a chart.
pub(crate) enum HoverTarget {
    Nothing,
    Samples(Box<dyn Samples>),
    Bars(Box<dyn Bars>),
}

/// Samples on a chart.
pub(crate) trait Samples: Send + Sync {
    /// Where a sample's marks are; the last is the one that is ringed.
    fn marks(&self, sample: usize) -> Vec<[f64; 2]>;

    /// Those whose marks may be between two places along the chart and upwards.
    fn near(&self, x: [f64; 2], y: [f64; 2]) -> Vec<usize>;

    /// What is drawn between two places along the chart, beside what is drawn in any case.
    fn in_sight(&self, _: [f64; 2]) -> Vec<Item> {
        Vec::new()
    }
}

/// What the pointer finds on bars.
pub(crate) trait Bars: Send + Sync {
    /// What is said about a place along the chart.
    fn at(&self, x: f64) -> Option<Facts>;

    /// From where to where the bar of a sample goes.
    fn of(&self, _: usize) -> Option<[f64; 2]> {
        None
    }
}

/// What is said about a bar.
pub(crate) struct Facts {
    pub(crate) title: String,
    pub(crate) lines: Vec<(String, String)>,
    /// The samples that a click marks.
    pub(crate) samples: Vec<usize>,
}

/// Document and answer, and how they are looked at: all that a chart follows from. It lasts by itself: the window goes
/// on while one is made of it.
#[derive(Clone, PartialEq)]
pub(crate) struct Scene {
    pub(crate) document: Arc<Document>,
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) step: Step,
    /// The plane of the workspace.
    pub(crate) plane: Plane,
    /// The found effect whose curve is charted, by its place in the answer.
    pub(crate) effect: usize,
    /// Whether the deviation before is left out where there is another.
    pub(crate) after_alone: bool,
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

    /// A component of some samples' deviations before, and after where it is known.
    fn values(&self, samples: &[usize]) -> (Vec<f64>, Option<Vec<f64>>) {
        let session = &self.loaded_session;
        let of = |deviation: &dyn Fn(usize) -> [f64; 3]| {
            let value = |i: &usize| session.component(deviation(*i), *i, self.component);
            samples.iter().map(value).collect::<Vec<f64>>()
        };
        let before = of(&|i| session.deviation_before(i));
        let after = self.answer();
        (
            before,
            after.map(|answer| of(&|i| answer.deviation_after(i))),
        )
    }

    pub(crate) fn diagnosis(&self) -> Option<&Diagnosis> {
        self.search.as_ref()?.answer.as_ref().ok()
    }

    /// Whether charts leave out the deviation before, so that what is left can be seen.
    pub(crate) fn only_after(&self) -> bool {
        self.after_alone && self.answer().is_some()
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

/// Samples as a chart shows them: a component of the deviation over a quantity, before and after.
pub(crate) struct Seen {
    pub(crate) scene: Arc<Scene>,
    pub(crate) over: Over,
    pub(crate) scales: [Scale; 2],
    pub(crate) cloud: PointsOfBoth,
}

impl Seen {
    pub(crate) fn of(scene: &Arc<Scene>, over: Over) -> Self {
        let (loaded_session, what) = (&scene.loaded_session, (over, scene.component));
        let cloud = PointsOfBoth::of(loaded_session, scene.answer(), what);
        let across = |span| over.scale(loaded_session, scene.units, span);
        let mut seen = Self {
            scene: Arc::clone(scene),
            over,
            scales: [across(0.0), Scale::length(scene.units)],
            cloud,
        };
        let span = seen.extent().map_or(0.0, |[x, _]| x[1] - x[0]);
        seen.scales[0] = across(span);
        seen
    }

    /// What is drawn: before, after, or both.
    pub(crate) fn whens(&self) -> impl Iterator<Item = When> + use<> {
        let after = self.scene.answer().is_some();
        let before = !(after && self.scene.only_after());
        [(0, before), (1, after)]
            .into_iter()
            .filter_map(|(when, seen)| seen.then_some(when))
    }

    pub(crate) fn points(&self, when: When) -> &Points {
        &self.cloud.0[when]
    }

    /// Smallest and largest value across and upwards of what is drawn, inner units.
    pub(crate) fn extent(&self) -> Option<[[f64; 2]; 2]> {
        let all = self.whens().filter_map(|when| self.points(when).extent);
        all.reduce(|a, b| [0, 1].map(|k| [a[k][0].min(b[k][0]), a[k][1].max(b[k][1])]))
    }

    /// Where a sample is, inner units.
    pub(crate) fn place(&self, when: When, sample: usize) -> [f64; 2] {
        let (session, answer) = (&self.scene.loaded_session, self.scene.answer());
        at(
            session,
            answer,
            (self.over, self.scene.component),
            when,
            sample,
        )
    }

    pub(crate) fn form(&self, sample: usize) -> Form {
        Form::of_side(self.over.side(&self.scene.loaded_session, sample))
    }

    /// Whether any mark points to a side.
    pub(crate) fn has_sides(&self) -> bool {
        let drawn = &self.points(0).drawn;
        drawn
            .iter()
            .any(|sample| self.form(*sample as usize) != Form::Disc)
    }

    /// What is not drawn.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let points = self.points(self.whens().last().unwrap_or(0));
        let (drawn, all) = (points.drawn.len(), points.samples.len());
        if drawn < all {
            notes.push(say!(
                "{drawn} of {all} points shown: zoom in for more",
                drawn = grouped(drawn),
                all = grouped(all)
            ));
        }
        let unplaced = self.scene.usable().len() - all;
        if unplaced > 0 {
            notes.push(say!(
                one "{count} sample has no value and is not shown",
                "{count} samples have no value and are not shown",
                count = unplaced
            ));
        }
        notes
    }

    /// Those that are drawn between two places along the chart.
    fn between(&self, when: When, x: [f64; 2]) -> &[u32] {
        let x = x.map(|x| self.scales[0].value_at(x));
        let across = |sample: u32| self.place(when, sample as usize)[0];
        self.points(when).between(x, across)
    }
}

impl Samples for Seen {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let places = self.whens().map(|when| self.place(when, sample));
        let known = places.filter(|at| at.iter().all(|v| v.is_finite()));
        known
            .map(|at| [0, 1].map(|k| self.scales[k].shown(at[k])))
            .collect()
    }

    fn near(&self, x: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        let near = self.whens().flat_map(|when| self.between(when, x));
        near.map(|sample| *sample as usize).collect()
    }

    fn in_sight(&self, x: [f64; 2]) -> Vec<Item> {
        let marks = |when: When| {
            let here = self.between(when, x).iter().map(|sample| *sample as usize);
            let mark = |sample: usize| {
                let at = self.place(when, sample);
                Mark {
                    at: [0, 1].map(|k| self.scales[k].shown(at[k])),
                    form: self.form(sample),
                }
            };
            let (stands, filled) = role(when);
            Item::Marks(here.map(mark).collect(), stands, filled)
        };
        self.whens().map(marks).collect()
    }
}

/// The colour of marks before and after, and whether they are filled.
pub(crate) const fn role(when: When) -> (ColourRole, bool) {
    match when {
        0 => (ColourRole::Before, false),
        _ => (ColourRole::After, true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_are_called_differently() {
        for (k, chart) in CHARTS.iter().enumerate() {
            let (id, name) = (chart.about().id, chart.about().name());
            let same =
                |other: &&&dyn ChartKind| other.about().id == id || other.about().name() == name;
            assert_eq!(CHARTS.iter().filter(same).count(), 1, "{id}");
            assert!(
                find(id).is_some_and(|found| found.about().name() == name),
                "{k}"
            );
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
}
