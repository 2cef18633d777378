//! A component of the deviation around the angle of the joint, as circles of a ballbar test are shown: so many
//! divisions from the nominal circle, the division from 1, 2, 5 × 10ⁿ:
//!
//! ```text
//! r = N + e / division,   |e| ≤ 5 divisions
//! ```
//!
//! Source: ISO 230-4 (circular tests), where e is the radial deviation of a circular path.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::deviation::{ANGLE, Seen, describe, note, role};
use super::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown, When,
};
use crate::gui::core::loaded_session::Component;
use crate::gui::help;
use crate::numeric::whole;
use crate::present::chart::{
    Axis, Chart, ChartText, ColourRole, Entry, Form, Item, LegendSymbol, Mark, Ticks, decade,
};
use crate::present::drawing::Anchor;
use crate::present::numbers::trimmed;
use crate::present::table::Table;

/// Radius of the nominal circle, divisions.
const NOMINAL: f64 = 8.0;
/// The largest deviation is at most so many divisions long.
const MOST_DIVISIONS: f64 = 5.0;
/// A smaller division than this would show rounding, mm.
const LEAST_MM: f64 = 1e-5;
/// Room for the names of the spokes, divisions.
const ROOM: f64 = 1.9;
/// Spokes and chords of circles are so many parts of a turn.
const SPOKES: u32 = 12;
const CHORDS: u32 = 180;
/// Angles this close are one, rad: the line goes through the mean of their deviations.
const SAME_RAD: f64 = 0.005;
/// Over a wider gap there is no line, rad.
const GAP_RAD: f64 = 0.45;

pub(crate) struct Polar;

impl ChartKind for Polar {
    fn about(&self) -> About {
        let name = help::POLAR.name;
        About::new("polar", name, help::POLAR, ChartChoice::Component)
    }

    /// A deviation of several joints belongs to no single angle, and a length closes no circle.
    fn is_offered(&self, scene: &Scene) -> bool {
        scene.loaded_session.single_revolute() && !scene.loaded_session.is_empty()
    }

    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder> {
        let over = ANGLE.over(scene);
        let drawn = Drawn::of(Seen::of(scene, over));
        let component = scene.component.name();
        let samples = scene.usable().len();
        let division = drawn.scale();
        Ok(Shown {
            name: say!(
                "polar view, {component}, {samples} samples, {polar}",
                component,
                samples,
                polar = division
            ),
            description: describe(&drawn.of, over),
            chart: drawn.chart(division),
            pointed: HoverTarget::Samples(Box::new(drawn)),
        })
    }

    fn numbers(&self, scene: &Scene) -> Table {
        ANGLE.numbers(scene)
    }
}

struct Drawn {
    of: Seen,
    division_mm: f64,
    /// So many divisions inside the nominal circle and outside.
    divisions: [f64; 2],
}

impl Drawn {
    fn of(of: Seen) -> Self {
        let scene = &of.scene;
        let [low, high] = of.extent().map_or([0.0; 2], |[_, mm]| mm);
        let [low, high] = [low.min(0.0), high.max(0.0)];
        // Round in the unit in which it is written.
        let per_mm = scene.units.length_value(1.0);
        let division_mm = round_up(high.max(-low) * per_mm / MOST_DIVISIONS) / per_mm;
        let division_mm = division_mm.max(LEAST_MM);
        let most = |mm: f64| (mm / division_mm - 1e-9).ceil();
        Self {
            divisions: [-low, high].map(|mm| most(mm).clamp(1.0, MOST_DIVISIONS)),
            of,
            division_mm,
        }
    }

    /// `1 division = 0.5 mm`.
    fn scale(&self) -> String {
        let units = self.of.scene.units;
        say!(
            "1 division = {length} {unit}",
            length = trimmed(units.length_value(self.division_mm), 6),
            unit = units.length_name()
        )
    }

    /// So many divisions from the nominal circle, never on the other side of the middle.
    fn place(q: f64, divisions: f64) -> [f64; 2] {
        let (sin, cos) = q.sin_cos();
        [cos, sin].map(|way| way * (NOMINAL + divisions).max(0.0))
    }

    fn at(&self, q: f64, mm: f64) -> [f64; 2] {
        Self::place(q, mm / self.division_mm)
    }

    /// A circle so many divisions from the nominal one.
    fn circle(divisions: f64, role: ColourRole, width: f32, dashed: bool) -> Item {
        let at = |k| Self::place(TAU * f64::from(k) / f64::from(CHORDS), divisions);
        Item::Line((0..=CHORDS).map(at).collect(), role, width, dashed)
    }

    /// The tolerance, divisions: both ways for a component, outwards for a length; no wider than what is in sight.
    fn band(&self) -> Option<[f64; 2]> {
        let tolerance = self.of.scene.document.tolerance_mm? / self.division_mm;
        let [low, high] = self.divisions.map(|most| tolerance.min(most + 0.5));
        let is_length = self.of.scene.component == Component::Length;
        Some([if is_length { 0.0 } else { -low }, high])
    }

    fn chart(&self, division: String) -> Chart {
        let scene = &self.of.scene;
        let name = scene.component.name();
        let out = NOMINAL + self.divisions[1] + ROOM;
        let axis = || Axis {
            label: String::new(),
            ticks: Ticks::Plane,
        };
        let mut items = self.rings();
        let sign = LegendSymbol::Mark(Form::Disc);
        let ring = Entry::new(division, LegendSymbol::Line, ColourRole::Reference, true);
        let mut legend = scene.legend(sign);
        legend.insert(0, ring);
        for when in self.of.whens() {
            items.extend(self.stage(when));
        }
        if self.of.has_sides() {
            let way = |name: &str, form| {
                Entry::new(name, LegendSymbol::Mark(form), ColourRole::Noise, false)
            };
            legend.push(way(say!("approach +"), Form::Forwards));
            legend.push(way(say!("approach −"), Form::Backwards));
        }
        if self.band().is_some() {
            let role = ColourRole::Tolerance;
            let name = say!("tolerance");
            legend.push(Entry::new(name, LegendSymbol::Line, role, false));
        }
        Chart {
            title: say!("{component} deviation around the angle", component = name),
            across: axis(),
            upwards: axis(),
            bounds: [[-out; 2], [out; 2]],
            items,
            legend,
            note: note(&self.of, self.of.over),
        }
    }

    /// Rings, spokes with their angles, the tolerance and the nominal circle.
    fn rings(&self) -> Vec<Item> {
        let units = self.of.scene.units;
        let thin = ColourRole::Reference;
        let [inside, outside] = self.divisions;
        let most = |divisions: f64| 1..=whole(divisions);
        let rings = most(inside).map(|k| -(k as f64));
        let rings = rings.chain(most(outside).map(|k| k as f64));
        let mut items: Vec<Item> = rings.map(|at| Self::circle(at, thin, 0.5, false)).collect();
        for k in 0..SPOKES {
            let q = TAU * f64::from(k) / f64::from(SPOKES);
            let ends = [-inside, outside].map(|at| Self::place(q, at));
            items.push(Item::Line(ends.to_vec(), thin, 0.5, false));
            // Angles as joints have them: from −180° to 180°.
            let turn = if 2 * k > SPOKES { TAU } else { 0.0 };
            items.push(Item::Word(ChartText {
                at: Self::place(q, outside + 0.5 * ROOM),
                text: units.angle(q - turn),
                anchor: Anchor::Middle,
                below: false,
            }));
        }
        items.push(Self::circle(0.0, thin, 1.75, false));
        for at in self.band().into_iter().flatten() {
            items.push(Self::circle(at, ColourRole::Tolerance, 1.0, true));
        }
        items
    }

    /// The deviations before or after: each sample, and where all are drawn the mean at each angle.
    fn stage(&self, when: When) -> Vec<Item> {
        let (role, filled) = role(when);
        let points = self.of.points(when);
        let drawn = points.drawn.iter().map(|sample| *sample as usize);
        let mark = |sample: usize| {
            let [q, mm] = self.of.place(when, sample);
            Mark {
                at: self.at(q, mm),
                form: self.of.form(sample),
            }
        };
        let marks = Item::Marks(drawn.clone().map(mark).collect(), role, filled);
        if points.drawn.len() < points.samples.len() {
            return vec![marks];
        }
        let session = &self.of.scene.loaded_session;
        let dot = |sample: usize| {
            let [q, mm] = self.of.place(when, sample);
            (session.side(self.of.over.joint, sample), q, mm)
        };
        let line = |piece: Vec<[f64; 2]>| {
            let points = piece.iter().map(|[q, mm]| self.at(*q, *mm));
            Item::Line(points.collect(), role, 1.25, !filled)
        };
        let means = means(drawn.map(dot).collect()).into_iter();
        means.map(line).chain([marks]).collect()
    }
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

/// The mean deviation over the angle of what came from each side, in pieces without gaps.
fn means(mut values: Vec<(f64, f64, f64)>) -> Vec<Vec<[f64; 2]>> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let groups = values.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 < SAME_RAD);
    let means = groups.map(|group| {
        let mean = |of: fn(&(f64, f64, f64)) -> f64| {
            group.iter().map(of).sum::<f64>() / group.len() as f64
        };
        (group[0].0, [mean(|v| v.1), mean(|v| v.2)])
    });
    let means: Vec<(f64, [f64; 2])> = means.collect();
    let pieces = means.chunk_by(|(side, a), (other, b)| side == other && b[0] - a[0] < GAP_RAD);
    pieces
        .map(|piece| piece.iter().map(|(_, at)| *at).collect())
        .collect()
}

impl Samples for Drawn {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let places = self.of.whens().map(|when| self.of.place(when, sample));
        let known = places.filter(|at| at.iter().all(|v| v.is_finite()));
        known.map(|[q, mm]| self.at(q, mm)).collect()
    }

    fn near(&self, _: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        let all = self.of.whens().flat_map(|when| &self.of.points(when).drawn);
        all.map(|sample| *sample as usize).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::{lamp, workbench, workbench_on};
    use crate::gui::workbench::Workbench;

    #[test]
    fn the_largest_deviation_is_at_most_five_divisions_and_the_division_is_round() {
        for largest in [13.8, 0.05, 0.0007, 4.99, 5.0] {
            let division = round_up(largest / MOST_DIVISIONS);
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

    #[test]
    fn a_line_goes_through_the_mean_at_each_angle_and_not_over_gaps() {
        let spots = [(0.0, 1.0), (0.001, 3.0), (0.2, 4.0), (2.0, 5.0)];
        let pieces = means(spots.map(|(q, mm)| (1.0, q, mm)).to_vec());
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[0].len(), 2);
        assert!((pieces[0][0][1] - 2.0).abs() < 1e-12);
    }

    fn of<T>(workbench: &Workbench, look: impl FnOnce(&Drawn) -> T) -> T {
        let scene = Arc::new(workbench.scene());
        look(&Drawn::of(Seen::of(&scene, ANGLE.over(&scene))))
    }

    #[test]
    fn it_shows_every_sample_and_what_is_left_alone() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.component = Component::Radial);
        let marks = |workbench: &Workbench, role: ColourRole| {
            of(workbench, |drawn| {
                let items = drawn.chart(String::new()).items.into_iter();
                let marks = items.filter_map(|item| match item {
                    Item::Marks(marks, of, _) if of == role => Some(marks.len()),
                    _ => None,
                });
                marks.sum::<usize>()
            })
        };
        let all = workbench.loaded_session().len();
        assert_eq!(marks(&workbench, ColourRole::Before), all);
        let before = of(&workbench, |drawn| drawn.division_mm);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        workbench.execute(|bench| bench.view.only_after = true);
        assert!(of(&workbench, |drawn| drawn.division_mm) < before);
        assert_eq!(marks(&workbench, ColourRole::Before), 0);
        assert_eq!(marks(&workbench, ColourRole::After), all);
    }

    #[test]
    fn a_deviation_outwards_is_outside_the_nominal_circle_and_nothing_leaves_the_bounds() {
        let mut workbench = workbench();
        workbench.execute(|bench| {
            bench.edit(|document| document.set_tolerance(Some(0.2)));
        });
        of(&workbench, |drawn| {
            let radius = |at: [f64; 2]| at[0].hypot(at[1]);
            let at = drawn.at(0.3, 2.0 * drawn.division_mm);
            assert!((radius(at) - NOMINAL - 2.0).abs() < 1e-9);
            assert_eq!(radius(Drawn::place(0.3, -99.0)), 0.0);
            let chart = drawn.chart(String::new());
            let [_, [out, _]] = chart.bounds;
            for item in &chart.items {
                if let Item::Line(points, ..) = item {
                    assert!(points.iter().all(|at| radius(*at) <= out), "{points:?}");
                }
            }
        });
    }

    #[test]
    fn what_is_pointed_at_is_found_among_many_samples() {
        let mut workbench = workbench_on(lamp(0.05, &[]));
        workbench.execute(|bench| bench.show_chart("polar"));
        workbench.receive();
        of(&workbench, |drawn| {
            let points = drawn.of.points(0);
            assert!(points.drawn.len() < points.samples.len());
            for sample in [0, 17, 4_000] {
                let [x, y] = drawn.marks(sample)[0];
                let is_near = |other: &usize| {
                    let at = drawn.marks(*other)[0];
                    (at[0] - x).hypot(at[1] - y) < 0.5
                };
                let near = drawn.near([x - 0.5, x + 0.5], [y - 0.5, y + 0.5]);
                assert!(near.iter().any(is_near), "{sample}");
            }
        });
    }

    #[test]
    fn a_length_is_outside_the_circle_and_so_is_its_tolerance() {
        let mut workbench = workbench();
        workbench.execute(|bench| {
            bench.edit(|document| document.set_tolerance(Some(0.2)));
        });
        let band = |workbench: &Workbench| of(workbench, |drawn| drawn.band().expect("a band"));
        workbench.execute(|bench| bench.view.component = Component::Length);
        assert_eq!(band(&workbench)[0], 0.0);
        workbench.execute(|bench| bench.view.component = Component::Radial);
        let [low, high] = band(&workbench);
        assert!(low < 0.0 && high > 0.0);
        workbench.execute(|bench| {
            bench.edit(|document| document.set_tolerance(Some(1e9)));
        });
        let [low, high] = band(&workbench);
        assert!(-NOMINAL < low && high < NOMINAL);
    }
}
