//! The picture of a laser: the deviation of one axis over its position, a line for each run and direction, what the
//! table corrects through them with its band, and what is left as predicted with the table.

use super::{Axis, Chart, ColourRole, Entry, Form, Item, LEAST_SPAN, LegendSymbol, Mark};
use crate::present::units::in_unit;
use crate::standards::{AxisTest, CurvePoint, Position, Positioning, Series};

/// Which deviations are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisStage {
    /// As measured, with what the table corrects.
    Measured,
    /// As predicted with the table.
    Predicted,
    /// Both.
    Both,
}

/// What such a chart is made of.
#[derive(Clone)]
pub struct AxisDeviation<'a> {
    /// The axis.
    pub axis: &'a AxisTest,
    /// Which of its series.
    pub series: &'a Series,
    /// Which deviations.
    pub stage: AxisStage,
    /// What it stands over.
    pub across: Axis,
    /// What the axis across shows for a commanded position in degrees or mm.
    pub position: &'a dyn Fn(f64) -> f64,
    /// What deviations are shown in: the unit, and units in one of the axis' own.
    pub unit: (&'a str, f64),
}

/// One run in one direction: commanded positions and deviations, in the order of the positions.
fn runs(positions: &[Position]) -> impl Iterator<Item = (f64, Vec<[f64; 2]>)> {
    let of = |p: &Position, side: f64| {
        if side > 0.0 {
            p.up.clone()
        } else {
            p.down.clone()
        }
    };
    [1.0, -1.0].into_iter().flat_map(move |side| {
        let most = positions.iter().map(|p| of(p, side).len()).max();
        (0..most.unwrap_or(0)).map(move |run| {
            let at = |p: &Position| of(p, side).get(run).map(|e| [p.commanded, *e]);
            (side, positions.iter().filter_map(at).collect())
        })
    })
}

impl AxisDeviation<'_> {
    /// The chart; zero is always on it.
    pub fn chart(&self, title: String, note: String) -> Chart {
        let corrected = self.series.corrected.as_deref();
        let before = (self.stage != AxisStage::Predicted).then_some(&self.series.deviations[..]);
        let after = corrected.filter(|_| self.stage != AxisStage::Measured);
        let curve = self.series.curve.as_ref().filter(|_| before.is_some());
        let shown = |[at, e]: [f64; 2]| [(self.position)(at), e * self.unit.1];
        let mut items = Vec::new();
        let mut points: Vec<[f64; 2]> = Vec::new();
        for side in curve.iter().flat_map(|curve| &curve.sides) {
            let band = |p: &CurvePoint| {
                let half = p.half_width?;
                let [at, low] = shown([p.commanded, p.deviation - half]);
                Some([at, low, shown([p.commanded, p.deviation + half])[1]])
            };
            let band: Option<Vec<[f64; 3]>> = side.iter().map(band).collect();
            if let Some(band) = band.filter(|band| band.len() > 1) {
                points.extend(
                    band.iter()
                        .flat_map(|[at, low, high]| [[*at, *low], [*at, *high]]),
                );
                items.push(Item::Ribbon(band, ColourRole::Curve));
            }
        }
        let stages = [(before, ColourRole::Before), (after, ColourRole::After)];
        let stages = stages
            .into_iter()
            .filter_map(|(all, role)| Some((all?, role)));
        for (positions, role) in stages {
            for (side, run) in runs(positions) {
                let run: Vec<[f64; 2]> = run.into_iter().map(shown).collect();
                points.extend(&run);
                let form = Form::of_side(side);
                let marks = run.iter().map(|at| Mark { at: *at, form }).collect();
                items.push(Item::Line(run, role, 0.8, side < 0.0));
                items.push(Item::Marks(marks, role, role == ColourRole::After));
            }
        }
        for (side, dashed) in curve.iter().flat_map(|c| c.sides.iter().zip([false, true])) {
            let line: Vec<[f64; 2]> = side
                .iter()
                .map(|p| shown([p.commanded, p.deviation]))
                .collect();
            points.extend(&line);
            if !line.is_empty() {
                items.push(Item::Line(line, ColourRole::Curve, 2.4, dashed));
            }
        }
        let bounds = bounds(&points);
        let zero = vec![[bounds[0][0], 0.0], [bounds[1][0], 0.0]];
        items.insert(0, Item::Line(zero, ColourRole::Reference, 1.0, false));
        Chart {
            title,
            across: self.across.clone(),
            upwards: Axis::numbers(in_unit(say!("deviation"), self.unit.0)),
            bounds,
            legend: self.legend(after.is_some(), &items),
            items,
            note,
        }
    }

    fn legend(&self, after: bool, items: &[Item]) -> Vec<Entry> {
        let mut legend = Vec::new();
        if self.stage != AxisStage::Predicted {
            let before = Entry::before(LegendSymbol::Line);
            legend.push(Entry {
                filled: true,
                may_go: after,
                ..before
            });
        }
        if after {
            let name = say!("with the table, predicted");
            legend.push(Entry::new(
                name,
                LegendSymbol::Line,
                ColourRole::After,
                true,
            ));
        }
        let has = |side: fn(&Position) -> &Vec<f64>| {
            let mut all = self.series.deviations.iter();
            all.any(|p| !side(p).is_empty())
        };
        let way =
            |name: &str, form| Entry::new(name, LegendSymbol::Mark(form), ColourRole::Noise, false);
        if has(|p| &p.up) {
            legend.push(way(say!("approach +"), Form::Forwards));
        }
        if has(|p| &p.down) {
            legend.push(way(say!("approach −"), Form::Backwards));
        }
        let curve = |item: &Item| item.colour_role() == Some(ColourRole::Curve);
        if items.iter().any(curve) {
            let name = say!("what the table corrects, with 95 % band");
            legend.push(Entry::new(
                name,
                LegendSymbol::Line,
                ColourRole::Curve,
                true,
            ));
        }
        legend
    }
}

/// The figures of ISO 230-2 in one line, as measured and as predicted with the table; `number` writes one in the
/// axis' own unit.
pub fn axis_figures(series: &Series, unit: &str, number: &dyn Fn(f64) -> String) -> String {
    let of = |p: &Positioning| {
        [
            ("A", p.accuracy_of_both),
            ("R", p.repeatability_of_both),
            ("E", p.systematic_of_both),
            ("B", p.reversal),
            ("M", p.mean_range),
        ]
    };
    let before = of(&series.before);
    let after = series.after.as_ref().map(of);
    let figure = |k: usize| {
        let (symbol, value) = before[k];
        let value = number(value?);
        let after = after.as_ref().and_then(|all| all[k].1);
        Some(after.map_or_else(
            || format!("{symbol} {value}"),
            |after| format!("{symbol} {value} → {}", number(after)),
        ))
    };
    let figures: Vec<String> = (0..before.len()).filter_map(figure).collect();
    if figures.is_empty() {
        return String::new();
    }
    format!("ISO 230-2, {unit}: {}", figures.join(" · "))
}

/// Smallest and largest corner of all points and zero, with a margin.
fn bounds(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let ends = |k: usize| {
        let all = points.iter().map(|p| p[k]).filter(|v| v.is_finite());
        all.fold(None, |ends: Option<[f64; 2]>, v| {
            Some(ends.map_or([v; 2], |[a, b]| [a.min(v), b.max(v)]))
        })
    };
    let [from, to] = ends(0).unwrap_or([0.0, 1.0]);
    let [low, high] = ends(1).unwrap_or_default();
    let [low, high] = [low.min(0.0), high.max(0.0)];
    let beside = (0.03 * (to - from)).max(1e-3);
    // A chart of tenths of a micrometre is no narrower than what is left: only rounding is no picture.
    let by = (0.08 * (high - low)).max(0.05 * LEAST_SPAN);
    [[from - beside, low - by], [to + beside, high + by]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::JointKind;
    use crate::standards::{Fixed, TableCurve};

    fn position(commanded: f64, up: &[f64], down: &[f64]) -> Position {
        Position {
            commanded,
            up: up.to_vec(),
            down: down.to_vec(),
        }
    }

    fn axis(corrected: bool) -> AxisTest {
        let deviations = vec![
            position(0.0, &[1.0, 1.2], &[3.0, 3.2]),
            position(10.0, &[2.0, 2.2], &[4.0]),
        ];
        let left = vec![
            position(0.0, &[-0.1, 0.1], &[-0.1, 0.1]),
            position(10.0, &[-0.1, 0.1], &[0.0]),
        ];
        let point = |commanded, deviation| CurvePoint {
            commanded,
            deviation,
            half_width: Some(0.5),
        };
        let curve = TableCurve {
            sides: [
                vec![point(0.0, 1.1), point(10.0, 2.1)],
                vec![point(0.0, 3.1), point(10.0, 4.0)],
            ],
        };
        let series = Series {
            fixed: Fixed::default(),
            before: Positioning::new(&deviations),
            after: corrected.then(|| Positioning::new(&left)),
            deviations,
            corrected: corrected.then_some(left),
            curve: corrected.then_some(curve),
            missing: Vec::new(),
        };
        AxisTest {
            joint: 0,
            name: "x".to_owned(),
            kind: JointKind::Prismatic,
            unit: "mm",
            position_unit: "mm",
            series: vec![series],
            more: 0,
            missing: None,
        }
    }

    fn chart(axis: &AxisTest, stage: AxisStage) -> Chart {
        let made = AxisDeviation {
            axis,
            series: &axis.series[0],
            stage,
            across: Axis::numbers("x, mm"),
            position: &|at| at,
            unit: ("µm", 1000.0),
        };
        made.chart(String::new(), String::new())
    }

    /// The lines in a role: dashed or not, and their points.
    fn lines(chart: &Chart, of: ColourRole) -> Vec<(bool, Vec<[f64; 2]>)> {
        let line = |item: &Item| match item {
            Item::Line(points, role, _, dashed) if *role == of => Some((*dashed, points.clone())),
            _ => None,
        };
        chart.items.iter().filter_map(line).collect()
    }

    #[test]
    fn each_run_is_a_line_and_directions_differ_without_colour() {
        let chart = chart(&axis(false), AxisStage::Both);
        let expected = vec![
            (false, vec![[0.0, 1000.0], [10.0, 2000.0]]),
            (false, vec![[0.0, 1200.0], [10.0, 2200.0]]),
            (true, vec![[0.0, 3000.0], [10.0, 4000.0]]),
            (true, vec![[0.0, 3200.0]]),
        ];
        assert_eq!(lines(&chart, ColourRole::Before), expected);
        let forms: Vec<Form> = chart
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Marks(marks, ..) => Some(marks[0].form),
                _ => None,
            })
            .collect();
        let [up, down] = [Form::Forwards, Form::Backwards];
        assert_eq!(forms, [up, up, down, down]);
        assert_eq!(lines(&chart, ColourRole::Curve), vec![]);
    }

    #[test]
    fn the_band_is_around_the_curve_and_what_is_left_can_be_seen_alone() {
        let axis = axis(true);
        let both = chart(&axis, AxisStage::Both);
        let bands: Vec<&Vec<[f64; 3]>> = both
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Ribbon(places, ColourRole::Curve) => Some(places),
                _ => None,
            })
            .collect();
        assert_eq!(bands.len(), 2);
        let [at, low, high] = bands[0][0];
        assert!(at == 0.0 && (low - 600.0).abs() < 1e-9 && (high - 1600.0).abs() < 1e-9);
        assert_eq!(lines(&both, ColourRole::Curve).len(), 2);
        assert_eq!(lines(&both, ColourRole::After).len(), 4);
        let left = chart(&axis, AxisStage::Predicted);
        assert_eq!(lines(&left, ColourRole::Before), vec![]);
        assert_eq!(lines(&left, ColourRole::Curve), vec![]);
        assert!(left.bounds[1][1] < 0.1 * both.bounds[1][1]);
        let measured = chart(&axis, AxisStage::Measured);
        assert_eq!(lines(&measured, ColourRole::After), vec![]);
    }

    #[test]
    fn figures_stand_before_and_as_predicted() {
        let number = |value: f64| format!("{value:.1}");
        let of = |corrected| axis_figures(&axis(corrected).series[0], "mm", &number);
        assert_eq!(of(false), "ISO 230-2, mm: E 2.9 · B 2.0 · M 0.9");
        assert!(of(true).contains("B 2.0 → 0.0"), "{}", of(true));
    }
}
