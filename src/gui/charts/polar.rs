//! A component of the deviation around the angle of the joint, as circles of a ballbar test are shown: so many
//! divisions from the nominal circle, the division from 1, 2, 5 × 10ⁿ:
//!
//! ```text
//! r = N + e / division,   |e| ≤ 5 divisions
//! ```
//!
//! Source: ISO 230-4 (circular tests), where e is the radial deviation of a circular path.

use std::f64::consts::TAU;

use super::deviation::{note, numbers};
use super::{ChartChoice, ChartKind, Scene, Shown};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::help;
use crate::numeric::extent;
use crate::present::chart::{
    Axis, Chart, ChartText, ColourRole, Entry, Form, Item, LegendSymbol, Ticks, decade,
};
use crate::present::drawing::Anchor;
use crate::present::numbers::trimmed;

/// Radius of the nominal circle, divisions.
const NOMINAL: f64 = 8.0;
/// So many rings inside it and outside: the largest deviation is at most so many divisions long.
const RINGS: i8 = 5;
/// A smaller division than this would show rounding, mm.
const LEAST_MM: f64 = 1e-5;
/// Room for the names of the spokes, divisions.
const ROOM: f64 = 1.9;
/// Spokes and chords of circles are so many parts of a turn.
const SPOKES: u32 = 12;
const CHORDS: u32 = 180;

pub(crate) static POLAR: ChartKind = ChartKind {
    // A deviation of several joints belongs to no single angle, and a length closes no circle.
    is_offered: |scene| scene.loaded_session.single_revolute() && !scene.loaded_session.is_empty(),
    ..ChartKind::new(
        "polar",
        help::POLAR,
        ChartChoice::Component,
        |scene| Ok(show(scene)),
        |scene| numbers(scene, Variable::Joint),
    )
};

/// So many divisions from the nominal circle, never on the other side of the middle.
fn place(q: f64, divisions: f64) -> [f64; 2] {
    let (sin, cos) = q.sin_cos();
    [cos, sin].map(|way| way * (NOMINAL + divisions).max(0.0))
}

/// A circle so many divisions from the nominal one.
fn circle(divisions: f64, role: ColourRole, width: f32, dashed: bool) -> Item {
    let at = |k| place(TAU * f64::from(k) / f64::from(CHORDS), divisions);
    Item::Line((0..=CHORDS).map(at).collect(), role, width, dashed)
}

/// Rings, spokes with their angles, and the nominal circle.
fn rings(scene: &Scene) -> Vec<Item> {
    let thin = ColourRole::Reference;
    let most = f64::from(RINGS);
    let all = (-RINGS..=RINGS).map(|k| circle(k.into(), thin, 0.5, false));
    let mut items: Vec<Item> = all.collect();
    for k in 0..SPOKES {
        let q = TAU * f64::from(k) / f64::from(SPOKES);
        let ends = [-most, most].map(|at| place(q, at));
        items.push(Item::Line(ends.to_vec(), thin, 0.5, false));
        // Angles as joints have them: from −180° to 180°.
        let turn = if 2 * k > SPOKES { TAU } else { 0.0 };
        items.push(Item::Word(ChartText {
            at: place(q, most + 0.5 * ROOM),
            text: scene.units.angle(q - turn),
            anchor: Anchor::Middle,
            below: false,
        }));
    }
    items.push(circle(0.0, thin, 1.75, false));
    items
}

/// The division for these deviations, mm: round in the unit in which it is written.
fn division_mm(scene: &Scene, [low, high]: [f64; 2]) -> f64 {
    let per_mm = scene.units.length_value(1.0);
    let largest = high.max(-low) * per_mm;
    (round_up(largest / f64::from(RINGS)) / per_mm).max(LEAST_MM)
}

/// The tolerance, divisions: both ways for a component, outwards for a length; no wider than what is in sight.
fn band(scene: &Scene, division_mm: f64) -> Option<[f64; 2]> {
    let tolerance = scene.document.tolerance_mm? / division_mm;
    let high = tolerance.min(f64::from(RINGS) + 0.5);
    let is_length = scene.component == Component::Length;
    Some([if is_length { 0.0 } else { -high }, high])
}

fn show(scene: &Scene) -> Shown {
    let variable = Variable::Joint;
    let stages = scene.stages(Over { variable, joint: 0 });
    let all = || stages.iter().flat_map(|(_, marks)| marks);
    let division_mm = division_mm(scene, extent(all().map(|(_, mark)| mark.at[1])));
    let division = say!(
        "1 division = {length} {unit}",
        length = trimmed(scene.units.length_value(division_mm), 6),
        unit = scene.units.length_name()
    );
    let mut items = rings(scene);
    let entry = |name: &str, sign, role| Entry::new(name, sign, role, false);
    let mut legend = scene.legend(LegendSymbol::Mark(Form::Disc));
    let marks = |(role, _): &_| Item::Marks(Vec::new(), *role, *role == ColourRole::After);
    let ring = Entry::new(&*division, LegendSymbol::Line, ColourRole::Reference, true);
    legend.insert(0, ring);
    if all().any(|(_, mark)| mark.form != Form::Disc) {
        let way = |name, form| entry(name, LegendSymbol::Mark(form), ColourRole::Noise);
        legend.push(way(say!("approach +"), Form::Forwards));
        legend.push(way(say!("approach −"), Form::Backwards));
    }
    if let Some(band) = band(scene, division_mm) {
        let role = ColourRole::Tolerance;
        items.extend(band.map(|at| circle(at, role, 1.0, true)));
        legend.push(entry(say!("tolerance"), LegendSymbol::Line, role));
    }
    items.extend(stages.iter().map(marks));
    let out = NOMINAL + f64::from(RINGS) + ROOM;
    let axis = || Axis {
        label: String::new(),
        ticks: Ticks::Plane,
    };
    let component = scene.component.name();
    let chart = Chart {
        title: say!("{component} deviation around the angle", component),
        across: axis(),
        upwards: axis(),
        bounds: [[-out; 2], [out; 2]],
        items,
        legend,
        note: String::new(),
    };
    let samples = scene.usable().len();
    let name = say!(
        "polar view, {component}, {samples} samples, {polar}",
        component,
        samples,
        polar = division
    );
    let mut shown = Shown::of(chart, name, &stages, |[q, mm]| place(q, mm / division_mm));
    shown.chart.note = note(scene, None, &shown.series);
    shown
}

/// The smallest of 1, 2, 5 × 10ⁿ that is not below `value`; 0 for nothing.
fn round_up(value: f64) -> f64 {
    if value <= 0.0 || !value.is_finite() {
        return 0.0;
    }
    let decade = decade(value);
    let round = [1.0, 2.0, 5.0].map(|lead| lead * decade);
    let mut enough = round.into_iter().filter(|one| *one >= value * (1.0 - 1e-9));
    enough.next().unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::{lamp, workbench, workbench_on};
    use crate::gui::workbench::Workbench;

    #[test]
    fn the_largest_deviation_is_at_most_five_divisions_and_the_division_is_round() {
        for largest in [13.8, 0.05, 0.0007, 4.99, 5.0] {
            let division = round_up(largest / f64::from(RINGS));
            let drawn = largest / division;
            assert!(drawn <= 5.0 + 1e-9 && drawn > 1.9, "{largest}: {drawn}");
            let lead = division / 10f64.powf(division.log10().floor() + 1e-12);
            let is_round = [1.0, 2.0, 5.0]
                .iter()
                .any(|l| (lead / l - 1.0).abs() < 1e-6);
            assert!(is_round, "{lead}");
        }
        assert_eq!(round_up(0.0), 0.0);
        assert_eq!(round_up(f64::NAN), 0.0);
    }

    fn shown(workbench: &Workbench) -> Shown {
        show(&workbench.scene())
    }

    #[test]
    fn it_shows_every_sample_and_what_is_left_alone() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.component = Component::Radial);
        let marks = |workbench: &Workbench| {
            let series = shown(workbench).series.into_iter();
            let all = series.map(|one| (one.role, one.shown.len()));
            all.collect::<Vec<_>>()
        };
        let division = |workbench: &Workbench| {
            let legend = shown(workbench).chart.legend;
            let number = legend[0].name.split(' ').nth(3).map(str::parse::<f64>);
            number.expect("a number").expect("a number")
        };
        let all = workbench.loaded_session().len();
        assert_eq!(marks(&workbench), [(ColourRole::Before, all)]);
        let before = division(&workbench);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        workbench.execute(|bench| bench.view.only_after = true);
        assert!(division(&workbench) < before);
        assert_eq!(marks(&workbench), [(ColourRole::After, all)]);
    }

    #[test]
    fn a_deviation_outwards_is_outside_the_nominal_circle_and_nothing_leaves_the_bounds() {
        let mut workbench = workbench();
        workbench.execute(|bench| {
            bench.edit(|document| document.set_tolerance(Some(0.2)));
        });
        let radius = |at: [f64; 2]| at[0].hypot(at[1]);
        assert!((radius(place(0.3, 2.0)) - NOMINAL - 2.0).abs() < 1e-9);
        assert_eq!(radius(place(0.3, -99.0)), 0.0);
        let chart = shown(&workbench).chart;
        let [_, [out, _]] = chart.bounds;
        for item in &chart.items {
            if let Item::Line(points, ..) = item {
                assert!(points.iter().all(|at| radius(*at) <= out), "{points:?}");
            }
        }
    }

    #[test]
    fn what_is_pointed_at_is_found_among_many_samples() {
        let mut workbench = workbench_on(lamp(0.05, &[]));
        workbench.execute(|bench| bench.show_chart("polar"));
        workbench.receive();
        let shown = shown(&workbench);
        let series = &shown.series[0];
        assert!(series.drawn.len() < series.shown.len());
        for sample in [0, 17, 4_000] {
            let [x, y] = series.at(sample).expect("it is shown");
            let is_near = |other: &u32| {
                let at = series.at(*other as usize).expect("it is shown");
                (at[0] - x).hypot(at[1] - y) < 0.5
            };
            assert!(series.in_sight([x - 0.5, x + 0.5]).iter().any(is_near));
        }
    }

    #[test]
    fn a_length_is_outside_the_circle_and_so_is_its_tolerance() {
        let mut workbench = workbench();
        let mut band_of = |component: Component, tolerance_mm: f64| {
            workbench.execute(move |bench| {
                bench.view.component = component;
                bench.edit(|document| document.set_tolerance(Some(tolerance_mm)));
            });
            band(&workbench.scene(), 0.5).expect("a band")
        };
        assert_eq!(band_of(Component::Length, 0.2)[0], 0.0);
        let [low, high] = band_of(Component::Radial, 0.2);
        assert!(low < 0.0 && high > 0.0);
        let [low, high] = band_of(Component::Radial, 1e9);
        assert!(-NOMINAL < low && high < NOMINAL);
    }
}
