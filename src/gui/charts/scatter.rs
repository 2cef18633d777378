//! Any two quantities of the samples over each other, before and after where one of them is a
//! deviation. Of many samples one is drawn for each small cell of the chart, until few are in sight.

use std::borrow::Cow;

use crate::gui::cache::{ChartInputs, Work};
use crate::gui::charts::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown,
};
use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::{Quantity, Scale};
use crate::gui::core::scale::FEW;
use crate::gui::help::Word;
use crate::numeric::whole;
use crate::present::chart::{Axis, Chart, ColourRole, Entry, Form, Item, LegendSymbol, Mark};
use crate::present::numbers::{grouped, trimmed};
use crate::present::table::{Cell, Table};

/// Space around the marks, as a part of their extent.
const MARGIN: f64 = 0.04;

pub(crate) struct Scatter;

/// What stands across and upwards: as chosen, else the deviation as it is seen from above.
pub(crate) fn axes(scene: &Scene) -> [Quantity; 2] {
    let first = [Component::X, Component::Y].map(Quantity::Deviation);
    let joints = scene.loaded_session.session.robot.joints.len();
    scene.axes.unwrap_or(first).map(|axis| axis.within(joints))
}

/// What can be chosen, and how it is called.
pub(crate) fn named(scene: &Scene) -> Vec<(Quantity, String)> {
    let offered = Quantity::offered(&scene.loaded_session).into_iter();
    offered
        .map(|q| (q, q.name(&scene.loaded_session)))
        .collect()
}

/// What is shown at present.
struct Drawn<'a> {
    scene: &'a Scene,
    axes: [Quantity; 2],
    scales: [Scale; 2],
    cloud: Cow<'a, Cloud>,
    /// Whether a point is elsewhere after the identification.
    changes: bool,
}

impl<'a> Drawn<'a> {
    /// `None`: the background is at it.
    fn of(scene: &'a Scene) -> Option<Self> {
        let axes = axes(scene);
        let cloud = match scene.found() {
            Some(cloud) => Cow::Borrowed(cloud),
            None if scene.usable().len() > FEW => return None,
            None => Cow::Owned(Cloud::of(chart_inputs(scene), axes)),
        };
        let mut drawn = Self {
            scene,
            axes,
            scales: axes.map(|axis| axis.scale(&scene.loaded_session, scene.units, 0.0)),
            cloud,
            changes: axes.iter().any(|axis| axis.changes()),
        };
        let extent = drawn.extent();
        drawn.scales = [0, 1].map(|k| {
            let span = extent.map_or(0.0, |extent| extent[k][1] - extent[k][0]);
            axes[k].scale(&scene.loaded_session, scene.units, span)
        });
        Some(drawn)
    }

    /// What is drawn: before, after, or both.
    fn seen(&self) -> impl Iterator<Item = When> + use<> {
        let after = self.changes && self.scene.answer().is_some();
        let before = !(after && self.scene.only_after());
        [(0, before), (1, after)]
            .into_iter()
            .filter_map(|(when, seen)| seen.then_some(when))
    }

    fn points(&self, when: When) -> &Points {
        &self.cloud.0[when]
    }

    fn extent(&self) -> Option<[[f64; 2]; 2]> {
        let all = self.seen().filter_map(|when| self.points(when).extent);
        all.reduce(|a, b| [0, 1].map(|k| [a[k][0].min(b[k][0]), a[k][1].max(b[k][1])]))
    }

    fn place(&self, when: When, sample: usize) -> [f64; 2] {
        at(
            &self.scene.loaded_session,
            self.scene.answer(),
            self.axes,
            when,
            sample,
        )
    }

    fn shown(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.scales[k].shown(at[k]))
    }

    fn colour_role(&self, when: When) -> (ColourRole, bool) {
        match when {
            0 if !self.changes => (ColourRole::Curve, true),
            0 => (ColourRole::Before, false),
            _ => (ColourRole::After, true),
        }
    }

    fn names(&self) -> [String; 2] {
        self.axes.map(|axis| axis.name(&self.scene.loaded_session))
    }

    fn chart(&self, extent: [[f64; 2]; 2]) -> Chart {
        let [x, y] = [0, 1].map(|k| {
            let [low, high] = extent[k].map(|v| self.scales[k].shown(v));
            let span = high - low;
            let around = if span > 0.0 { MARGIN * span } else { 0.5 };
            [low - around, high + around]
        });
        let names = self.names();
        let axis = |k: usize| {
            let Scale { unit, degrees, .. } = &self.scales[k];
            let name = &names[k];
            let label = if unit.is_empty() {
                name.clone()
            } else {
                format!("{name}, {unit}")
            };
            Axis::turning(label, *degrees)
        };
        // Where nothing deviates.
        let zero = |k: usize, ends: [f64; 2]| {
            let deviates = self.axes[k].changes() && ends[0] < 0.0 && ends[1] > 0.0;
            let line = if k == 0 {
                [[0.0, y[0]], [0.0, y[1]]]
            } else {
                [[x[0], 0.0], [x[1], 0.0]]
            };
            deviates.then(|| Item::Line(line.to_vec(), ColourRole::Reference, 1.0, true))
        };
        let mut items: Vec<Item> = zero(0, x).into_iter().chain(zero(1, y)).collect();
        let sign = LegendSymbol::Mark(Form::Disc);
        let mut legend = Vec::new();
        if self.changes {
            legend.push(Entry::before(sign));
            if self.scene.answer().is_some() {
                legend.push(Entry::after(sign));
                // The marks themselves are those in sight.
                items.push(Item::Marks(Vec::new(), ColourRole::After, true));
            }
        } else {
            legend.push(Entry::new(say!("samples"), sign, ColourRole::Curve, true));
        }
        Chart {
            title: say!(
                "{upwards} over {across}",
                upwards = names[1],
                across = names[0]
            ),
            across: axis(0),
            upwards: axis(1),
            bounds: [[x[0], y[0]], [x[1], y[1]]],
            items,
            legend,
            note: self.note(),
        }
    }

    fn note(&self) -> String {
        let mut notes = Vec::new();
        let last = self.seen().last().unwrap_or(0);
        let points = self.points(last);
        if let Some(r) = points.correlation {
            notes.push(say!("correlation r = {r}", r = trimmed(r, 2)));
        }
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
        notes.join(" · ")
    }

    fn describe(&self, extent: [[f64; 2]; 2]) -> String {
        let names = self.names();
        let [x, y] = [0, 1].map(|k| extent[k].map(|v| self.scales[k].describe(v)));
        say!(
            "{samples} samples, {across} from {x0} to {x1}, {upwards} from {y0} to {y1}",
            samples = self.points(0).samples.len(),
            across = names[0],
            upwards = names[1],
            x0 = x[0],
            x1 = x[1],
            y0 = y[0],
            y1 = y[1]
        )
    }

    /// Those that are drawn between two places along the chart.
    fn between(&self, when: When, x: [f64; 2]) -> &[u32] {
        let x = x.map(|x| self.scales[0].value_at(x));
        let across = |sample: u32| self.place(when, sample as usize)[0];
        self.points(when).between(x, across).0
    }
}

fn chart_inputs(scene: &Scene) -> ChartInputs<'_> {
    ChartInputs {
        loaded_session: &scene.loaded_session,
        answer: scene.answer(),
        component: scene.component,
    }
}

impl ChartKind for Scatter {
    fn about(&self) -> About {
        About {
            id: "scatter",
            short: phrase!("scatter"),
            name: phrase!("Scatter"),
            word: Word {
                name: phrase!("Scatter"),
                means: phrase!(
                    "Any two quantities of the samples over each other, one mark for each sample. A band or a curve says that one follows the other, and r how nearly along a line: near 1 or −1 they go together, near 0 they do not"
                ),
            },
            of: ChartChoice::Quantities,
        }
    }

    fn work(&self, scene: &Scene) -> Option<Work> {
        let axes = axes(scene);
        // Letter by letter: a key is made of numbers.
        let key = format!("{axes:?}").bytes().map(usize::from).collect();
        let work = || Work::new(self.about().id, key, move |given| Cloud::of(given, axes));
        (scene.usable().len() > FEW).then(work)
    }

    fn show<'a>(&self, scene: &'a Scene) -> Result<Shown<'a>, ChartPlaceholder> {
        let drawn = Drawn::of(scene).ok_or_else(ChartPlaceholder::yet)?;
        let Some(extent) = drawn.extent() else {
            return Err(ChartPlaceholder::new(
                say!("No sample has both quantities"),
                say!("Choose others across or upwards"),
            ));
        };
        let [across, upwards] = drawn.names();
        Ok(Shown {
            chart: drawn.chart(extent),
            name: say!("scatter, {upwards} over {across}", upwards, across),
            description: drawn.describe(extent),
            pointed: HoverTarget::Samples(Box::new(drawn)),
        })
    }

    /// Every sample, in measuring order.
    fn numbers(&self, scene: &Scene) -> Table {
        let axes = axes(scene);
        let changes = axes.iter().any(|axis| axis.changes());
        let whens: &[When] = if changes { &[0, 1] } else { &[0] };
        let mut heads = vec!["sample".to_owned()];
        for when in whens {
            let name = ["before", "after"][*when];
            heads.extend(axes.map(|axis| {
                let heading = axis.heading(&scene.loaded_session);
                match (heading.split_once(", "), axis.changes()) {
                    (Some((what, unit)), true) => format!("{what} {name}, {unit}"),
                    _ => heading,
                }
            }));
        }
        // What does not change stands there once.
        let mut kept = Vec::new();
        for (k, head) in heads.iter().enumerate() {
            if heads.iter().position(|one| one == head) == Some(k) {
                kept.push(k);
            }
        }
        let mut table = Table::new(kept.iter().map(|k| heads[*k].clone()));
        for sample in scene.usable() {
            let mut cells = vec![Cell::from(sample + 1)];
            for when in whens {
                let here = at(&scene.loaded_session, scene.answer(), axes, *when, sample);
                let here = [0, 1].map(|k| axes[k].cell(&scene.loaded_session, here[k]));
                cells.extend(here.map(Cell::from));
            }
            table.row(kept.iter().map(|k| cells[*k].clone()));
        }
        table
    }
}

impl Samples for Drawn<'_> {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let places = self.seen().map(|when| self.place(when, sample));
        let known = places.filter(|at| at.iter().all(|v| v.is_finite()));
        known.map(|at| self.shown(at)).collect()
    }

    fn near(&self, x: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        let near = self.seen().flat_map(|when| self.between(when, x));
        near.map(|sample| *sample as usize).collect()
    }

    fn in_sight(&self, x: [f64; 2], _: f64) -> Vec<Item> {
        let marks = |when: When| {
            let here = self.between(when, x).iter();
            let mark = |sample: &u32| Mark {
                at: self.shown(self.place(when, *sample as usize)),
                form: Form::Disc,
            };
            let (stands, filled) = self.colour_role(when);
            Item::Marks(here.map(mark).collect(), stands, filled)
        };
        self.seen().map(marks).collect()
    }
}

/// Cells across and upwards, in which one of many samples is drawn.
const CELLS: [usize; 2] = [160, 90];

/// As many in sight are all drawn.
const MOST_MARKS: usize = 1500;

/// Before, 0, or after, 1.
pub(super) type When = usize;

/// Where a sample is, inner units; NaN where that is not known.
pub(super) fn at(
    loaded_session: &LoadedSession,
    answer: Option<&Answer>,
    axes: [Quantity; 2],
    when: When,
    sample: usize,
) -> [f64; 2] {
    axes.map(|axis| {
        let (before, after) = axis.of(loaded_session, answer, sample);
        if when == 0 {
            before
        } else {
            after.unwrap_or(f64::NAN)
        }
    })
}

/// Samples that have both quantities, before and after.
#[derive(Clone, Default)]
pub(super) struct Cloud(pub(super) [Points; 2]);

#[derive(Clone, Default)]
pub(super) struct Points {
    /// From the left to the right.
    pub(super) samples: Vec<u32>,
    /// One for each cell in which there are any; all where they are few.
    pub(super) drawn: Vec<u32>,
    /// Smallest and largest value across and upwards.
    pub(super) extent: Option<[[f64; 2]; 2]>,
    /// Pearson's correlation, where both quantities change.
    pub(super) correlation: Option<f64>,
}

impl Cloud {
    pub(super) fn of(inputs: ChartInputs<'_>, axes: [Quantity; 2]) -> Self {
        Self([0, 1].map(|when| {
            let place =
                |sample: usize| at(inputs.loaded_session, inputs.answer, axes, when, sample);
            let known = when == 0 || inputs.answer.is_some() && axes.iter().any(|a| a.changes());
            let usable = inputs
                .loaded_session
                .overview
                .usable
                .iter()
                .filter(|_| known);
            Points::of(usable.copied(), place)
        }))
    }
}

impl Points {
    pub(super) fn of(
        samples: impl Iterator<Item = u32>,
        place: impl Fn(usize) -> [f64; 2],
    ) -> Self {
        let placed = samples.map(|sample| (place(sample as usize), sample));
        let mut placed: Vec<([f64; 2], u32)> = placed
            .filter(|(at, _)| at.iter().all(|v| v.is_finite()))
            .collect();
        placed.sort_unstable_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.1.cmp(&b.1)));
        let extent = [0, 1].map(|k| crate::numeric::extent(placed.iter().map(|(at, _)| at[k])));
        let samples: Vec<u32> = placed.iter().map(|(_, sample)| *sample).collect();
        let drawn = if samples.len() > MOST_MARKS {
            one_in_each_cell(&placed, extent)
        } else {
            samples.clone()
        };
        Self {
            extent: (!samples.is_empty()).then_some(extent),
            correlation: correlation(&placed),
            samples,
            drawn,
        }
    }

    /// Those to be drawn between two values across, and whether these are all.
    pub(super) fn between(&self, x: [f64; 2], across: impl Fn(u32) -> f64) -> (&[u32], bool) {
        let within = |samples: &'_ [u32]| {
            let from = samples.partition_point(|s| across(*s) < x[0]);
            let to = samples.partition_point(|s| across(*s) <= x[1]);
            [from, to.max(from)]
        };
        let [from, to] = within(&self.samples);
        if to - from <= MOST_MARKS {
            return (&self.samples[from..to], true);
        }
        let [from, to] = within(&self.drawn);
        (
            &self.drawn[from..to],
            self.drawn.len() == self.samples.len(),
        )
    }
}

fn one_in_each_cell(placed: &[([f64; 2], u32)], extent: [[f64; 2]; 2]) -> Vec<u32> {
    let mut taken = vec![false; CELLS[0] * CELLS[1]];
    let mut drawn = Vec::new();
    for (at, sample) in placed {
        let cell = |k: usize| {
            let [low, high] = extent[k];
            let part = if high > low {
                (at[k] - low) / (high - low)
            } else {
                0.0
            };
            whole((part * CELLS[k] as f64).floor()).min(CELLS[k] - 1)
        };
        let taken = &mut taken[cell(0) + CELLS[0] * cell(1)];
        if !std::mem::replace(taken, true) {
            drawn.push(*sample);
        }
    }
    drawn
}

/// r = Σ (x − x̄)(y − ȳ) / √(Σ (x − x̄)² Σ (y − ȳ)²)
fn correlation(placed: &[([f64; 2], u32)]) -> Option<f64> {
    let n = placed.len() as f64;
    let mean = [0, 1].map(|k| placed.iter().map(|(at, _)| at[k]).sum::<f64>() / n);
    let mut sums = [0.0; 3];
    for (at, _) in placed {
        let [x, y] = [0, 1].map(|k| at[k] - mean[k]);
        sums[0] += x * x;
        sums[1] += y * y;
        sums[2] += x * y;
    }
    let r = sums[2] / (sums[0] * sums[1]).sqrt();
    (placed.len() > 2 && r.is_finite()).then_some(r)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_together_correlates_and_what_does_not_does_not() {
        let placed = |of: &dyn Fn(f64) -> f64| {
            let points = (0..100_u32).map(|i| ([f64::from(i), of(f64::from(i))], i));
            correlation(&points.collect::<Vec<_>>())
        };
        assert!(placed(&|x| 3.0 - 2.0 * x).is_some_and(|r| (r + 1.0).abs() < 1e-12));
        assert!(placed(&|x| (x - 49.5).powi(2)).is_some_and(|r| r.abs() < 1e-12));
        assert_eq!(placed(&|_| 7.0), None, "it never changes");
    }

    #[test]
    fn of_many_one_is_drawn_for_each_cell_and_all_where_few_are_in_sight() {
        let n = 200_000_u32;
        let place = |i: usize| [i as f64, ((i * 7919) % 1000) as f64];
        let points = Points::of(0..n, place);
        assert!(
            points.drawn.len() <= CELLS[0] * CELLS[1],
            "{}",
            points.drawn.len()
        );
        assert!(points.drawn.len() > CELLS[0] * CELLS[1] / 2);
        let across = |s: u32| place(s as usize)[0];
        let (all, whole) = points.between([0.0, 1e9], across);
        assert!(!whole && all.len() == points.drawn.len());
        let (few, whole) = points.between([1000.0, 1099.0], across);
        assert!(whole && few.len() == 100);
        assert_eq!(points.between([5.0, 4.0], across).0.len(), 0);
    }
}
