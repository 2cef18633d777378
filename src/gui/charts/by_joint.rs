//! A component of the deviation over every joint at once, before and after: a panel for each joint, from
//! the smallest to the largest value that was measured, all at one height. What depends on one joint shows
//! in its panel and is spread over the others.

use super::{About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::overview::{FEW, stride, thinned};
use crate::gui::help::Word;
use crate::numeric::extent;
use crate::present::chart::{Axis, Deviation, Entry, Form, LegendSymbol, Series, Ticks, shortened};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};

/// The share of a panel that its marks have.
const FILLED: f64 = 0.88;
/// Letters of a joint's name below its panel.
const MOST_LETTERS: usize = 8;

pub(crate) struct ByJoint;

/// Where the samples are: joint by joint the smallest and the largest value, inner units.
struct Panels<'a> {
    scene: &'a Scene,
    ranges: Vec<[f64; 2]>,
    stride: usize,
}

impl<'a> Panels<'a> {
    fn of(scene: &'a Scene) -> Self {
        // Of many samples a frame looks at those that it shows.
        let stride = stride(scene.usable().len(), FEW);
        let range = |q: &Vec<f64>| {
            let shown = scene.usable().step_by(stride);
            extent(shown.map(|i| q[i]))
        };
        Self {
            ranges: scene
                .loaded_session
                .session
                .samples
                .q
                .iter()
                .map(range)
                .collect(),
            stride,
            scene,
        }
    }

    /// Samples that are shown.
    fn shown(&self) -> impl Iterator<Item = usize> {
        self.scene.usable().step_by(self.stride)
    }

    /// Where a sample stands along the chart in the panel of a joint.
    fn at(&self, joint: usize, sample: usize) -> Option<f64> {
        let [low, high] = self.ranges[joint];
        let q = self.scene.loaded_session.session.samples.q[joint][sample];
        let part = if high > low {
            (q - low) / (high - low)
        } else {
            0.5
        };
        let at = joint as f64 + 0.5 + FILLED * (part - 0.5);
        at.is_finite().then_some(at)
    }

    /// The component before and after, mm.
    fn values(&self, sample: usize) -> (f64, Option<f64>) {
        let scene = self.scene;
        let of = |e: [f64; 3]| scene.loaded_session.component(e, sample, scene.component);
        let after = scene.answer().map(|a| of(a.deviation_after(sample)));
        (of(scene.loaded_session.deviation_before(sample)), after)
    }

    /// Marks of all samples in all panels.
    fn series(&self, entry: Entry, value: impl Fn((f64, Option<f64>)) -> Option<f64>) -> Series {
        let marks = self.shown().flat_map(|sample| {
            let mm = value(self.values(sample)).filter(|mm| mm.is_finite());
            (0..self.ranges.len()).filter_map(move |joint| {
                let dir = self.scene.loaded_session.session.samples.dir[joint].as_ref();
                let side = dir.map_or(0.0, |dir| dir[sample]);
                Some((self.at(joint, sample)?, mm?, side))
            })
        });
        Series {
            entry,
            samples: marks.collect(),
        }
    }
}

impl ChartKind for ByJoint {
    fn about(&self) -> About {
        let names = [phrase!("joints"), phrase!("Deviation by joint")];
        let word = Word {
            name: phrase!("Deviation by joint"),
            means: phrase!(
                "The deviation over every joint, each from its smallest to its largest value. A curve in one panel is an error of that joint"
            ),
        };
        About::new("deviation by joint", names, word, ChartChoice::Component)
    }

    fn is_offered(&self, scene: &Scene) -> bool {
        scene.loaded_session.session.robot.joints.len() > 1 && !scene.loaded_session.is_empty()
    }

    fn show<'a>(&self, scene: &'a Scene) -> Result<Shown<'a>, ChartPlaceholder> {
        let panels = Panels::of(scene);
        let sign = LegendSymbol::Mark(Form::Disc);
        let before = |v: (f64, Option<f64>)| (!scene.only_after()).then_some(v.0);
        let mut series = vec![panels.series(Entry::before(sign), before)];
        if scene.answer().is_some() {
            series.push(panels.series(Entry::after(sign), |v| v.1));
        }
        let mm = extent(series.iter().flat_map(|s| &s.samples).map(|mark| mark.1));
        if mm[0] > mm[1] {
            let why = say!("Every sample needs its joint values and what was measured");
            return Err(ChartPlaceholder::new(say!("No sample to show"), why));
        }
        let joints = panels.ranges.len();
        let names = scene.loaded_session.session.robot.joints.iter().enumerate();
        let names = names.map(|(k, joint)| (k as f64 + 0.5, shortened(&joint.name, MOST_LETTERS)));
        let name = scene.component.name();
        let number = |mm: f64| significant(scene.units.length_value(mm), 3);
        let made = Deviation {
            component: name,
            is_length: scene.component == Component::Length,
            across: Axis {
                label: say!("joint, each over the range shown").to_owned(),
                ticks: Ticks::Words(names.collect()),
            },
            lengths: scene.lengths(&number),
            x: [0.0, joints as f64],
            mm,
            sides: series.iter().any(|s| s.samples.iter().any(|m| m.2 != 0.0)),
            tolerance_mm: scene.document.tolerance_mm,
            floor_mm: None,
            boundaries: (1..joints).map(|joint| joint as f64).collect(),
            series,
        };
        let note = thinned(
            panels.stride,
            phrase!("one point in {stride} shown"; stride),
        )
        .unwrap_or_default();
        Ok(Shown {
            chart: made.chart(say!("{name} deviation by joint", name), note),
            name: say!("deviation by joint, {name}", name),
            description: say!(
                "{name} deviation of {samples} samples over {joints} joints, {from} to {to}",
                name,
                samples = scene.usable().len(),
                joints,
                from = scene.units.length(mm[0]),
                to = scene.units.length(mm[1])
            ),
            pointed: HoverTarget::Samples(Box::new(panels)),
        })
    }

    /// Every sample: joint values in degrees or mm.
    fn numbers(&self, scene: &Scene) -> Table {
        let session = &scene.loaded_session.session;
        let component = scene.component.name();
        let joints = || session.robot.joints.iter();
        let heads = joints().map(|joint| format!("{}, {}", joint.name, joint.kind.sign().trim()));
        let others = ["before", "after"].map(|when| format!("{component} {when}, mm"));
        let first = std::iter::once("sample".to_owned());
        let mut table = Table::new(first.chain(heads).chain(others));
        let panels = Panels::of(scene);
        for sample in scene.usable() {
            let (before, after) = panels.values(sample);
            let mut cells = vec![Cell::from(sample + 1)];
            let values = joints().zip(&session.samples.q);
            cells.extend(values.map(|(joint, q)| Cell::from(joint.kind.to_display(q[sample]))));
            cells.extend([before.into(), after.into()]);
            table.rows.push(cells);
        }
        table
    }
}

impl Samples for Panels<'_> {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let (before, after) = self.values(sample);
        let before = (!self.scene.only_after()).then_some(before);
        let heights: Vec<f64> = [before, after].into_iter().flatten().collect();
        let joints = (0..self.ranges.len()).filter_map(|joint| self.at(joint, sample));
        joints
            .flat_map(|x| heights.iter().map(move |mm| (x, *mm)))
            .map(|(x, mm)| [x, self.scene.units.length_value(mm)])
            .collect()
    }

    fn near(&self, [from, to]: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        let here = |sample: &usize| {
            let mut joints = 0..self.ranges.len();
            joints.any(|joint| {
                self.at(joint, *sample)
                    .is_some_and(|x| from <= x && x <= to)
            })
        };
        self.shown().filter(here).collect()
    }
}
