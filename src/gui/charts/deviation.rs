//! A component of the deviation over the value of a joint, time, load or temperature, before and after. Of many samples
//! one stands for all in its small cell of the chart, until few are in sight.

use std::sync::Arc;

use super::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown, When,
};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::{Over, Scale, Variable};
use crate::gui::core::regions::boundaries;
use crate::gui::help::{self, Word};
use crate::numeric::whole;
use crate::present::chart::{
    Chart, ColourRole, Deviation, Form, Item, LEAST_SPAN, LegendSymbol, Mark, Series,
};
use crate::present::numbers::{grouped, significant};
use crate::present::table::{Cell, Table};
use crate::text::{Template, within};

/// A component of the deviation, mm, over a quantity of the samples.
pub(crate) struct Along {
    variable: Variable,
    about: About,
}

const fn along(variable: Variable, id: &'static str, name: Template, word: Word) -> Along {
    let about = About::new(id, name, word, ChartChoice::Joint);
    Along { variable, about }
}

pub(crate) static ANGLE: Along = along(
    Variable::Joint,
    "deviation",
    phrase!("Deviation over angle"),
    help::DEVIATION,
);
pub(crate) static TIME: Along = along(
    Variable::Time,
    "deviation over time",
    phrase!("Deviation over time"),
    help::OVER_TIME,
);
pub(crate) static LOAD: Along = along(
    Variable::Load,
    "deviation over load",
    phrase!("Deviation over load"),
    help::OVER_LOAD,
);
pub(crate) static TEMPERATURE: Along = along(
    Variable::Temperature,
    "deviation over temperature",
    phrase!("Deviation over temperature"),
    help::OVER_TEMPERATURE,
);

impl Along {
    pub(super) fn over(&self, scene: &Scene) -> Over {
        Over {
            variable: self.variable,
            joint: scene.joint(),
        }
    }
}

impl ChartKind for Along {
    fn about(&self) -> About {
        self.about
    }

    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder> {
        let over = self.over(scene);
        let missing = || {
            let [title, why] = over.needs();
            ChartPlaceholder::new(title, why)
        };
        over.column(&scene.loaded_session).ok_or_else(missing)?;
        let seen = Seen::of(scene, over);
        let extent = seen.extent().ok_or_else(missing)?;
        let component = scene.component.name();
        let name = match self.variable {
            Variable::Joint => say!("deviation chart, {component}", component),
            _ => say!(
                "{chart} chart, {component}",
                chart = within(&self.about.name()),
                component
            ),
        };
        Ok(Shown {
            description: describe(&seen, over),
            chart: chart(&seen, over, extent),
            name,
            pointed: HoverTarget::Samples(Box::new(seen)),
        })
    }

    /// Every sample: inner units, in measuring order.
    fn numbers(&self, scene: &Scene) -> Table {
        let over = self.over(scene);
        let session = &scene.loaded_session;
        let component = scene.component.name();
        let along = over.heading(session);
        let [before, after] = ["before", "after"].map(|when| format!("{component} {when}, mm"));
        let mut table = Table::new(["sample", &along, "side", &before, &after]);
        for sample in scene.usable() {
            let [before, after] = [0, 1].map(|when| scene.value(when, sample));
            let x = over.cell(session, over.of(session, sample));
            let side = session.side(over.joint, sample);
            let numbers = [x, side, before, after].map(Cell::from);
            table.row([Cell::from(sample + 1)].into_iter().chain(numbers));
        }
        table
    }
}

fn chart(seen: &Seen, over: Over, [x, mm]: [[f64; 2]; 2]) -> Chart {
    let scene = &seen.scene;
    // Regions divide the angle of joint 1.
    let divided = over.variable == Variable::Joint && over.joint == 0;
    let boundaries = boundaries(&scene.document.regions);
    let boundaries = boundaries.iter().filter(|_| divided);
    let scale = &seen.scales[0];
    let sign = LegendSymbol::Mark(Form::Disc);
    // The marks themselves are those in sight.
    let series = scene.legend(sign).into_iter().map(|entry| Series {
        entry,
        samples: Vec::new(),
    });
    let name = scene.component.name();
    let label = over.label(&scene.loaded_session);
    let number = |mm: f64| significant(scene.units.length_value(mm), 3);
    let made = Deviation {
        component: name,
        is_length: scene.component == Component::Length,
        across: scale.axis(&label),
        lengths: scene.lengths(&number),
        x: x.map(|x| scale.shown(x)),
        mm,
        sides: seen.has_sides(),
        tolerance_mm: scene.document.tolerance_mm,
        floor_mm: None,
        boundaries: boundaries.map(|b| scale.shown(b.at_rad)).collect(),
        series: series.collect(),
    };
    made.chart(
        say!("{name} deviation over {label}", name, label),
        note(seen, over),
    )
}

/// What has to be said.
pub(super) fn note(seen: &Seen, over: Over) -> String {
    let mut notes = Vec::new();
    let session = &seen.scene.loaded_session;
    let component = seen.scene.component;
    let polar = [Component::Tangential, Component::Radial, Component::Axial];
    if let [first, _, ..] = &session.session.robot.joints[..]
        && polar.contains(&component)
    {
        // The axis below may be another joint's.
        notes.push(say!(
            "{component} to {first}",
            component = component.name(),
            first = first.name
        ));
    }
    let never_changes = seen.extent().is_none_or(|[x, _]| x[0] == x[1]);
    if never_changes && over.variable != Variable::Joint {
        let what = over.label(session);
        notes.push(say!("the {quantity} never changes", quantity = what));
    }
    notes.extend(seen.notes());
    notes.join(" · ")
}

/// What is seen, in words.
pub(super) fn describe(seen: &Seen, over: Over) -> String {
    let scene = &seen.scene;
    let units = scene.units;
    let Some([x, _]) = seen.extent() else {
        return say!("no sample to show").to_owned();
    };
    let mut says = say!(
        "{component} deviation of {samples} samples over {label} from {from} to {to}",
        component = scene.component.name(),
        samples = seen.points(0).samples.len(),
        label = over.label(&scene.loaded_session),
        from = seen.scales[0].describe(x[0]),
        to = seen.scales[0].describe(x[1])
    );
    for (when, name) in [say!("before"), say!("after")].into_iter().enumerate() {
        if let Some([_, mm]) = seen.points(when).extent {
            let [from, to] = mm.map(|mm| units.length(mm));
            let between = say!("{from} to {to}", from, to);
            says += &format!(", {name} {between}");
        }
    }
    if let Some(tolerance) = scene.document.tolerance_mm {
        let tolerance = say!("tolerance {tolerance}", tolerance = units.length(tolerance));
        says += &format!(", {tolerance}");
    }
    says
}

/// Where a sample is, inner units; NaN where that is not known.
fn place(scene: &Scene, over: Over, when: When, sample: usize) -> [f64; 2] {
    let x = over.of(&scene.loaded_session, sample);
    [x, scene.value(when, sample)]
}

/// Samples as a chart shows them: a component of the deviation over a quantity, before and after.
pub(crate) struct Seen {
    pub(crate) scene: Arc<Scene>,
    pub(crate) over: Over,
    pub(crate) scales: [Scale; 2],
    /// Before, and after.
    points: [Points; 2],
}

impl Seen {
    pub(crate) fn of(scene: &Arc<Scene>, over: Over) -> Self {
        let across = |span| over.scale(&scene.loaded_session, scene.units, span);
        // What rounding alone scatters is one cell high.
        let least = [0.0, LEAST_SPAN];
        let points = |when| {
            let known = when == 0 || scene.answer().is_some();
            let usable = scene.loaded_session.overview.usable.iter();
            let usable = usable.filter(|_| known).copied();
            Points::of(usable, |sample| place(scene, over, when, sample), least)
        };
        let mut seen = Self {
            scene: Arc::clone(scene),
            over,
            scales: [across(0.0), Scale::length(scene.units)],
            points: [0, 1].map(points),
        };
        let span = seen.extent().map_or(0.0, |[x, _]| x[1] - x[0]);
        seen.scales[0] = across(span);
        seen
    }

    /// What is drawn: before, after, or both.
    pub(crate) fn whens(&self) -> impl Iterator<Item = When> + use<> {
        let after = self.scene.answer().is_some();
        let before = !(after && self.scene.only_after);
        [(0, before), (1, after)]
            .into_iter()
            .filter_map(|(when, seen)| seen.then_some(when))
    }

    pub(crate) fn points(&self, when: When) -> &Points {
        &self.points[when]
    }

    /// Smallest and largest value across and upwards of what is drawn, inner units.
    pub(crate) fn extent(&self) -> Option<[[f64; 2]; 2]> {
        let all = self.whens().filter_map(|when| self.points(when).extent);
        all.reduce(|a, b| [0, 1].map(|k| [a[k][0].min(b[k][0]), a[k][1].max(b[k][1])]))
    }

    /// Where a sample is, inner units.
    pub(crate) fn place(&self, when: When, sample: usize) -> [f64; 2] {
        place(&self.scene, self.over, when, sample)
    }

    pub(crate) fn form(&self, sample: usize) -> Form {
        Form::of_side(self.scene.loaded_session.side(self.over.joint, sample))
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

/// Cells across and upwards, in which one of many samples is drawn.
const CELLS: [usize; 2] = [160, 60];

/// As many in sight are all drawn.
const MOST_MARKS: usize = 1500;

#[derive(Clone, Default)]
pub(crate) struct Points {
    /// From the left to the right.
    pub(crate) samples: Vec<u32>,
    /// One for each cell in which there are any; all where they are few.
    pub(crate) drawn: Vec<u32>,
    /// Smallest and largest value across and upwards.
    pub(crate) extent: Option<[[f64; 2]; 2]>,
}

impl Points {
    pub(crate) fn of(
        samples: impl Iterator<Item = u32>,
        place: impl Fn(usize) -> [f64; 2],
        least: [f64; 2],
    ) -> Self {
        let placed = samples.map(|sample| (place(sample as usize), sample));
        let mut placed: Vec<([f64; 2], u32)> = placed
            .filter(|(at, _)| at.iter().all(|v| v.is_finite()))
            .collect();
        placed.sort_unstable_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.1.cmp(&b.1)));
        let extent = [0, 1].map(|k| crate::numeric::extent(placed.iter().map(|(at, _)| at[k])));
        let samples: Vec<u32> = placed.iter().map(|(_, sample)| *sample).collect();
        let drawn = if samples.len() > MOST_MARKS {
            one_in_each_cell(&placed, extent, least)
        } else {
            samples.clone()
        };
        Self {
            extent: (!samples.is_empty()).then_some(extent),
            samples,
            drawn,
        }
    }

    /// Those to be drawn between two values across.
    pub(crate) fn between(&self, x: [f64; 2], across: impl Fn(u32) -> f64) -> &[u32] {
        let within = |samples: &'_ [u32]| {
            let from = samples.partition_point(|s| across(*s) < x[0]);
            let to = samples.partition_point(|s| across(*s) <= x[1]);
            [from, to.max(from)]
        };
        let [from, to] = within(&self.samples);
        if to - from <= MOST_MARKS {
            return &self.samples[from..to];
        }
        let [from, to] = within(&self.drawn);
        &self.drawn[from..to]
    }
}

fn one_in_each_cell(
    placed: &[([f64; 2], u32)],
    extent: [[f64; 2]; 2],
    least: [f64; 2],
) -> Vec<u32> {
    let mut taken = vec![false; CELLS[0] * CELLS[1]];
    let mut drawn = Vec::new();
    for (at, sample) in placed {
        let cell = |k: usize| {
            let [low, high] = extent[k];
            let span = (high - low).max(least[k]);
            let part = if span > 0.0 {
                (at[k] - low) / span
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    /// Deviations of all samples along the angle, before or after.
    fn deviations(workbench: &Workbench, when: usize) -> Vec<f64> {
        let scene = Arc::new(workbench.scene());
        let over = ANGLE.over(&scene);
        let seen = Seen::of(&scene, over);
        let samples = seen.points(when).samples.iter();
        samples.map(|s| seen.place(when, *s as usize)[1]).collect()
    }

    #[test]
    fn the_components_of_a_deviation_have_its_length() {
        let mut workbench = workbench();
        let mut of = |component: Component| {
            workbench.execute(|bench| bench.view.component = component);
            deviations(&workbench, 0)[5]
        };
        let length = of(Component::Length);
        let polar = [Component::Tangential, Component::Radial, Component::Axial].map(&mut of);
        let cartesian = [Component::X, Component::Y, Component::Z].map(&mut of);
        for e in [polar, cartesian] {
            let found = e.iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!((found - length).abs() < 1e-12);
        }
    }

    #[test]
    fn a_zero_offset_of_minus_three_degrees_is_tangential_and_negative() {
        let workbench = workbench();
        let all = deviations(&workbench, 0);
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let expected = -245.0 * 3.0_f64.to_radians().sin();
        assert!((mean - expected).abs() < 0.2, "{mean} {expected}");
    }

    #[test]
    fn what_is_left_is_there_once_it_is_identified_and_can_be_looked_at_alone() {
        let mut workbench = workbench();
        let left = |workbench: &Workbench| deviations(workbench, 1).len();
        let high = |workbench: &Workbench| {
            let scene = Arc::new(workbench.scene());
            let shown = ANGLE.show(&scene).expect("it is shown");
            shown.chart.bounds[1][1] - shown.chart.bounds[0][1]
        };
        assert_eq!(left(&workbench), 0);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert_eq!(left(&workbench), workbench.loaded_session().len());
        let both = high(&workbench);
        workbench.execute(|bench| bench.view.only_after = true);
        assert!(high(&workbench) < 0.1 * both);
    }

    #[test]
    fn of_many_one_is_drawn_for_each_cell_and_all_where_few_are_in_sight() {
        let n = 200_000_u32;
        let place = |i: usize| [i as f64, ((i * 7919) % 1000) as f64];
        let points = Points::of(0..n, place, [0.0; 2]);
        assert!(
            points.drawn.len() <= CELLS[0] * CELLS[1],
            "{}",
            points.drawn.len()
        );
        assert!(points.drawn.len() > CELLS[0] * CELLS[1] / 2);
        let across = |s: u32| place(s as usize)[0];
        assert_eq!(points.between([0.0, 1e9], across), points.drawn);
        assert_eq!(points.between([1000.0, 1099.0], across).len(), 100);
        assert!(points.between([5.0, 4.0], across).is_empty());
        // Within what counts as nothing there is one row of cells.
        let flat = Points::of(0..n, place, [0.0, 1e9]);
        assert_eq!(flat.drawn.len(), CELLS[0]);
    }
}
