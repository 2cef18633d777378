//! A component of the deviation over the value of a joint, time, load or temperature, before and
//! after. Of many samples the extremes in each column of the screen are shown.

use super::{About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown};
use crate::gui::cache::{Column, Envelope, Work};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::{Over, Scale, Variable};
use crate::gui::core::regions::boundaries;
use crate::gui::core::scale::{FEW, stride, thinned};
use crate::gui::help::{self, Word};
use crate::numeric::whole;
use crate::present::chart::{
    Axis, Chart, ColourRole, Deviation, Entry, Form, Item, LegendSymbol, Mark, Series,
};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};
use crate::text::{Template, within};

/// Of so many samples near the pointer at most; more stand on one another.
pub(super) const MOST_NEAR: usize = 400;
/// Width of a column, points.
const COLUMN: f64 = 2.0;
/// More samples in sight than this are shown by their extremes.
const MOST_DOTS: usize = 600;

/// A component of the deviation, mm, over a quantity of the samples.
pub(crate) struct Along {
    variable: Variable,
    about: About,
}

const fn along(variable: Variable, id: &'static str, names: [Template; 2], word: Word) -> Along {
    let [short, name] = names;
    let about = About {
        id,
        short,
        name,
        word,
        of: ChartChoice::Joint,
    };
    Along { variable, about }
}

pub(crate) static ANGLE: Along = along(
    Variable::Joint,
    "deviation",
    [phrase!("angle"), phrase!("Deviation over angle")],
    help::DEVIATION,
);
pub(crate) static TIME: Along = along(
    Variable::Time,
    "deviation over time",
    [phrase!("time"), phrase!("Deviation over time")],
    help::OVER_TIME,
);
pub(crate) static LOAD: Along = along(
    Variable::Load,
    "deviation over load",
    [phrase!("load"), phrase!("Deviation over load")],
    help::OVER_LOAD,
);
pub(crate) static TEMPERATURE: Along = along(
    Variable::Temperature,
    "deviation over temperature",
    [
        phrase!("temperature"),
        phrase!("Deviation over temperature"),
    ],
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

    fn work(&self, scene: &Scene) -> Option<Work> {
        let over = self.over(scene);
        let key = vec![over.joint];
        (scene.usable().len() > FEW)
            .then(|| Work::new(self.about.id, key, move |given| Envelope::of(given, over)))
    }

    fn show<'a>(&self, scene: &'a Scene) -> Result<Shown<'a>, ChartPlaceholder> {
        let drawn = DrawnDeviations::of(scene, self.over(scene));
        if drawn.is_missing() {
            let [title, why] = drawn.over.needs();
            return Err(ChartPlaceholder::new(title, why));
        }
        let component = scene.component.name();
        let name = match self.variable {
            Variable::Joint => say!("deviation chart, {component}", component),
            _ => say!(
                "{chart} chart, {component}",
                chart = within(self.about.name()),
                component
            ),
        };
        let number = |mm: f64| significant(scene.units.length_value(mm), 3);
        let extent = drawn.extent();
        let mut chart = drawn.deviation(&number, extent);
        let many = drawn.envelope.filter(|envelope| {
            let [[from, _], [to, _]] = chart.bounds;
            are_many(envelope, [from, to].map(|x| drawn.scale.value_at(x)))
        });
        chart.note = drawn.note(many.is_some());
        if many.is_some() {
            // Columns have no sides.
            chart
                .legend
                .retain(|e| !matches!(e.sign, LegendSymbol::Mark(form) if form != Form::Disc));
        }
        Ok(Shown {
            description: drawn.describe(extent),
            chart,
            name,
            pointed: HoverTarget::Samples(Box::new(drawn)),
        })
    }

    /// Every sample: inner units, in measuring order.
    fn numbers(&self, scene: &Scene) -> Table {
        let drawn = DrawnDeviations::of(scene, self.over(scene));
        let component = scene.component.name();
        let along = drawn.over.heading(&scene.loaded_session);
        let [before, after] = ["before", "after"].map(|when| format!("{component} {when}, mm"));
        let mut table = Table::new(["sample", &along, "side", &before, &after]);
        for sample in scene.usable() {
            let dot = drawn.dot(sample);
            let x = drawn.over.cell(&scene.loaded_session, dot.x);
            let [x, side, before] = [x, dot.side, dot.before_mm].map(Cell::from);
            table.row([(sample + 1).into(), x, side, before, dot.after_mm.into()]);
        }
        table
    }
}

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dot {
    /// Where it stands along the chart, inner units; NaN where that is not known.
    pub(super) x: f64,
    /// The component of the nominal robot's deviation, mm.
    pub(super) before_mm: f64,
    /// The component of what is left, mm.
    pub(super) after_mm: Option<f64>,
    /// Side from which the joint came; 0 where it is not known.
    pub(super) side: f64,
}

/// What is shown at present.
pub(super) struct DrawnDeviations<'a> {
    pub(super) scene: &'a Scene,
    over: Over,
    scale: Scale,
    /// The extremes of many samples, as soon as they are known.
    pub(super) envelope: Option<&'a Envelope>,
    /// Samples in measuring order, perhaps thinned; none where their extremes are shown instead.
    pub(super) dots: Vec<Dot>,
    /// One dot for so many samples.
    stride: usize,
    /// How many samples have no place along the chart.
    unplaced: usize,
}

impl<'a> DrawnDeviations<'a> {
    pub(super) fn of(scene: &'a Scene, over: Over) -> Self {
        let envelope: Option<&Envelope> = scene.found();
        let count = scene.usable().len();
        // Of many a few, until their extremes are known.
        let stride = stride(count, FEW);
        let mut drawn = Self {
            scene,
            over,
            scale: over.scale(&scene.loaded_session, scene.units, 0.0),
            envelope,
            dots: Vec::new(),
            stride,
            unplaced: envelope.map_or(0, |e| count - e.placed()),
        };
        if envelope.is_none() {
            let dots = scene.usable().step_by(stride).map(|s| drawn.dot(s));
            let (dots, unplaced): (Vec<Dot>, Vec<Dot>) = dots.partition(|dot| dot.x.is_finite());
            (drawn.dots, drawn.unplaced) = (dots, stride * unplaced.len());
        }
        let span = drawn.extent().map_or(0.0, |all| all.x[1] - all.x[0]);
        drawn.scale = over.scale(&scene.loaded_session, scene.units, span);
        drawn
    }

    pub(super) fn dot(&self, sample: usize) -> Dot {
        let loaded_session = &*self.scene.loaded_session;
        let of = |e: [f64; 3]| loaded_session.component(e, sample, self.scene.component);
        Dot {
            x: self.over.of(loaded_session, sample),
            before_mm: of(loaded_session.deviation_before(sample)),
            after_mm: self.scene.answer().map(|a| of(a.deviation_after(sample))),
            side: self.over.side(loaded_session, sample),
        }
    }

    /// Whether no sample has a place along the chart. Of many the background knows.
    fn is_missing(&self) -> bool {
        match self.envelope {
            Some(envelope) => envelope.placed() == 0,
            None => self.over.is_missing(&self.scene.loaded_session),
        }
    }

    /// Smallest and largest place along the chart and deviation of everything.
    pub(super) fn extent(&self) -> Option<Column> {
        match self.envelope {
            Some(envelope) => envelope.extent(),
            None => Column::around(self.dots.iter().map(|d| (d.x, d.before_mm, d.after_mm))),
        }
    }

    fn deviation(&self, number: &dyn Fn(f64) -> String, all: Option<Column>) -> Chart {
        let scene = self.scene;
        let x = all.map_or([-1.0, 1.0], |all| all.x);
        let both = all.map_or([None; 2], |all| {
            [all.before_mm.filter(|_| !scene.only_after()), all.after_mm]
        });
        let mm = both.into_iter().flatten();
        let mm = mm.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        // Regions divide the angle of joint 1.
        let divided = self.over.variable == Variable::Joint && self.over.joint == 0;
        let boundaries = boundaries(&scene.document.regions);
        let boundaries = boundaries.iter().filter(|_| divided);
        let samples = |value: &dyn Fn(&Dot) -> Option<f64>| {
            let dots = self.dots.iter();
            dots.filter_map(|d| Some((self.scale.shown(d.x), value(d)?, d.side)))
                .collect()
        };
        let sign = LegendSymbol::Mark(Form::Disc);
        let mut series = vec![Series {
            entry: Entry::before(sign),
            samples: samples(&|d| (!scene.only_after()).then_some(d.before_mm)),
        }];
        if scene.answer().is_some() {
            series.push(Series {
                entry: Entry::after(sign),
                samples: samples(&|d| d.after_mm),
            });
        }
        let name = scene.component.name();
        let label = self.over.label(&scene.loaded_session);
        let made = Deviation {
            component: name,
            is_length: scene.component == Component::Length,
            across: Axis::turning(format!("{label}, {}", self.scale.unit), self.scale.degrees),
            lengths: scene.lengths(number),
            x: x.map(|x| self.scale.shown(x)),
            mm: mm.unwrap_or_default(),
            sides: self.envelope.is_some_and(Envelope::sides)
                || self.dots.iter().any(|d| d.side != 0.0),
            tolerance_mm: scene.document.tolerance_mm,
            floor_mm: None,
            boundaries: boundaries.map(|b| self.scale.shown(b.at_rad)).collect(),
            series,
        };
        made.chart(
            say!("{name} deviation over {label}", name, label),
            String::new(),
        )
    }

    /// What has to be said.
    pub(super) fn note(&self, many: bool) -> String {
        let mut notes = Vec::new();
        let component = self.scene.component;
        let polar = [Component::Tangential, Component::Radial, Component::Axial];
        if let [first, _, ..] = &self.scene.loaded_session.session.robot.joints[..]
            && polar.contains(&component)
        {
            // The axis below may be another joint's.
            notes.push(say!(
                "{component} to {first}",
                component = component.name(),
                first = first.name
            ));
        }
        let never_changes = self.extent().is_none_or(|all| all.x[0] == all.x[1]);
        if never_changes && self.over.variable != Variable::Joint {
            let what = self.over.label(&self.scene.loaded_session);
            notes.push(say!("the {quantity} never changes", quantity = what));
        }
        if many {
            notes.push(say!("min–max in each column").to_owned());
        } else if self.envelope.is_none() {
            notes.extend(thinned(
                self.stride,
                phrase!("one point in {stride} shown"; stride),
            ));
        }
        if self.unplaced > 0 {
            notes.push(say!(
                one "{count} sample has no value and is not shown",
                "{count} samples have no value and are not shown",
                count = self.unplaced
            ));
        }
        notes.join(" · ")
    }

    /// What is seen, in words.
    pub(super) fn describe(&self, all: Option<Column>) -> String {
        let units = self.scene.units;
        let between = |mm: [f64; 2]| {
            say!(
                "{from} to {to}",
                from = units.length(mm[0]),
                to = units.length(mm[1])
            )
        };
        let Some(all) = all else {
            return say!("no sample to show").to_owned();
        };
        let mut says = say!(
            "{component} deviation of {samples} samples over {label} from {from} to {to}",
            component = self.scene.component.name(),
            samples = self.scene.usable().len() - self.unplaced,
            label = self.over.label(&self.scene.loaded_session),
            from = self.scale.describe(all.x[0]),
            to = self.scale.describe(all.x[1])
        );
        for (name, mm) in [
            (say!("before"), all.before_mm),
            (say!("after"), all.after_mm),
        ] {
            if let Some(mm) = mm {
                says += &format!(", {name} {}", between(mm));
            }
        }
        if let Some(tolerance) = self.scene.document.tolerance_mm {
            let tolerance = say!("tolerance {tolerance}", tolerance = units.length(tolerance));
            says += &format!(", {tolerance}");
        }
        says
    }

    fn at(&self, x: f64, mm: f64) -> [f64; 2] {
        [self.scale.shown(x), self.scene.units.length_value(mm)]
    }
}

/// Whether what is in sight between two values along the chart is shown by its extremes.
fn are_many(envelope: &Envelope, x: [f64; 2]) -> bool {
    envelope.count(x) > MOST_DOTS
}

impl Samples for DrawnDeviations<'_> {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let dot = self.dot(sample);
        if !dot.x.is_finite() {
            return Vec::new();
        }
        let before = (!self.scene.only_after()).then_some(dot.before_mm);
        let both = before.into_iter().chain(dot.after_mm);
        both.map(|mm| self.at(dot.x, mm)).collect()
    }

    fn near(&self, x: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        match self.envelope {
            None => self.scene.usable().step_by(self.stride).collect(),
            Some(envelope) => {
                let x = x.map(|x| self.scale.value_at(x));
                envelope.samples(x, MOST_NEAR).collect()
            }
        }
    }

    fn in_sight(&self, x: [f64; 2], points: f64) -> Vec<Item> {
        let Some(envelope) = self.envelope else {
            return Vec::new();
        };
        let x = x.map(|x| self.scale.value_at(x));
        let alone = self.scene.only_after();
        if are_many(envelope, x) {
            let number = whole((points / COLUMN).ceil().min(8192.0)).max(1);
            let columns = envelope.columns(x, number);
            let bars = |mm: &dyn Fn(&Column) -> Option<[f64; 2]>| {
                let bar = |c: &Column| {
                    let mm = mm(c)?;
                    Some([0, 1].map(|k| self.at(c.x[k], mm[k])))
                };
                columns.iter().filter_map(bar).collect()
            };
            let before = bars(&|c| c.before_mm.filter(|_| !alone));
            return vec![
                Item::Columns(before, ColourRole::Before, false),
                Item::Columns(bars(&|c| c.after_mm), ColourRole::After, true),
            ];
        }
        let dots: Vec<Dot> = envelope
            .samples(x, MOST_DOTS)
            .map(|s| self.dot(s))
            .collect();
        let marks = |value: &dyn Fn(&Dot) -> Option<f64>| {
            let mark = |dot: &Dot| {
                let at = self.at(dot.x, value(dot)?);
                let form = Form::of_side(dot.side);
                Some(Mark { at, form })
            };
            dots.iter().filter_map(mark).collect()
        };
        let before = marks(&|d| Some(d.before_mm).filter(|_| !alone));
        vec![
            Item::Marks(before, ColourRole::Before, false),
            Item::Marks(marks(&|d| d.after_mm), ColourRole::After, true),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    fn dots(workbench: &Workbench) -> Vec<Dot> {
        let scene = workbench.scene_of(&ANGLE);
        DrawnDeviations::of(&scene, ANGLE.over(&scene)).dots
    }

    #[test]
    fn the_components_of_a_deviation_have_its_length() {
        let mut workbench = workbench();
        let mut of = |component: Component| {
            workbench.execute(|bench| bench.view.component = component);
            dots(&workbench)[5].before_mm
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
        let dots = dots(&workbench);
        let mean = dots.iter().map(|d| d.before_mm).sum::<f64>() / dots.len() as f64;
        let expected = -245.0 * 3.0_f64.to_radians().sin();
        assert!((mean - expected).abs() < 0.2, "{mean} {expected}");
    }

    #[test]
    fn what_is_left_is_there_once_it_is_identified_and_can_be_looked_at_alone() {
        let mut workbench = workbench();
        let left = |workbench: &Workbench| {
            let dots = dots(workbench);
            dots.iter().filter(|d| d.after_mm.is_some()).count()
        };
        let high = |workbench: &Workbench| {
            let scene = workbench.scene_of(&ANGLE);
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
}
