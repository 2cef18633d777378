//! What is charted: a chart is one file and one line of the register. It says what it is called, when it
//! is offered, what the background works out for it, and makes of a [`Scene`] (document and answer, how they
//! are looked at, what was worked out) a [`Chart`], which the window, a picture and a table for a spreadsheet
//! show. Nothing here draws.

use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::gui::cache::{ExportPreview, IdentifiedAnswer};
use crate::gui::core::answer::Answer;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::search::Search;
use crate::gui::help::Word;
use crate::gui::view::Step;
use crate::present::chart::{Chart, ColourRole, Entry, Item, LegendSymbol, Lengths};
use crate::present::numbers::Notation;
use crate::present::table::Table;
use crate::present::units::Units;
use crate::text::{Language, Template, capital, spoken};

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
    const fn new(id: &'static str, name: Template, word: Word, of: ChartChoice) -> Self {
        Self { id, name, word, of }
    }

    pub(crate) fn name(&self) -> String {
        capital(spoken(self.name))
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
    /// What is seen, in words.
    pub(crate) description: String,
    pub(crate) pointed: HoverTarget,
}

/// Before, 0, or after, 1.
pub(crate) type When = usize;

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
