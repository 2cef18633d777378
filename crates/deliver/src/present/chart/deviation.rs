//! The deviation of samples over the value of a joint, time, load or temperature.

use super::{Axis, Chart, ColourRole, Entry, Form, Item, LegendSymbol, Lengths, Mark};

/// The smallest span of a chart's upward axis, mm or degrees: below it the labels, which have four
/// decimals, would all be the same, and what filled the chart would be rounding.
pub const LEAST_SPAN: f64 = 1e-3;

/// Samples at one stage of the work.
#[derive(Debug, Clone)]
pub struct Series {
    /// How it is called.
    pub entry: Entry,
    /// Where each sample is along the chart, its deviation in mm, and the side from which the joint
    /// came.
    pub samples: Vec<(f64, f64, f64)>,
}

/// What such a chart is made of.
#[derive(Clone)]
pub struct Deviation<'a> {
    /// What the component of the deviation is called.
    pub component: &'a str,
    /// Whether it is its length, which has no sign.
    pub is_length: bool,
    /// What it stands over.
    pub across: Axis,
    /// How lengths are written.
    pub lengths: Lengths<'a>,
    /// From where to where along the chart, in what the axis shows.
    pub x: [f64; 2],
    /// Smallest and largest deviation, mm.
    pub mm: [f64; 2],
    /// Whether the side from which the joint came is known.
    pub sides: bool,
    /// The tolerance: both ways for a component, from zero for a length. It is left out where it
    /// would cover everything.
    pub tolerance_mm: Option<f64>,
    /// The noise floor; left out where it is beyond the chart.
    pub floor_mm: Option<f64>,
    /// Places that divide the chart.
    pub boundaries: Vec<f64>,
    /// The samples, bottom first.
    pub series: Vec<Series>,
}

impl Deviation<'_> {
    /// The chart, with a margin around what it has to show; zero is always on it.
    pub fn chart(&self, title: String, note: String) -> Chart {
        let [x, mm] = self.extent();
        let value = |mm: f64| mm * self.lengths.per_mm;
        let mut items = Vec::new();
        let mut legend: Vec<Entry> = self.series.iter().map(|s| s.entry.clone()).collect();
        if self.sides {
            let way = |name: &str, form| {
                Entry::new(name, LegendSymbol::Mark(form), ColourRole::Noise, false)
            };
            legend.push(way(say!("approach +"), Form::Forwards));
            legend.push(way(say!("approach −"), Form::Backwards));
        }
        if let Some(tolerance) = self.tolerance_mm {
            let low = if self.is_length { 0.0 } else { -tolerance };
            if low > mm[0] || tolerance < mm[1] {
                let band = [low.max(mm[0]), tolerance.min(mm[1])].map(value);
                items.push(Item::Band(band, ColourRole::Tolerance));
                let name = say!("tolerance");
                legend.push(Entry::new(
                    name,
                    LegendSymbol::Band,
                    ColourRole::Tolerance,
                    true,
                ));
            }
        }
        for at in &self.boundaries {
            let line = mm.map(|mm| [*at, value(mm)]).to_vec();
            items.push(Item::Line(line, ColourRole::Reference, 0.6, true));
        }
        let across = |mm: f64| x.map(|x| [x, value(mm)]).to_vec();
        items.push(Item::Line(across(0.0), ColourRole::Reference, 1.0, false));
        if let Some(floor) = self.floor_mm.filter(|floor| *floor < mm[1]) {
            items.push(Item::Line(across(floor), ColourRole::Noise, 1.4, true));
            let name = format!(
                "{} {} {}",
                say!("noise floor"),
                (self.lengths.number)(floor),
                self.lengths.unit
            );
            legend.push(Entry::new(
                name,
                LegendSymbol::Line,
                ColourRole::Noise,
                false,
            ));
        }
        for one in &self.series {
            let mark = |(x, mm, side): &(f64, f64, f64)| Mark {
                at: [*x, value(*mm)],
                form: Form::of_side(*side),
            };
            let marks = one.samples.iter().map(mark).collect();
            items.push(Item::Marks(marks, one.entry.role, one.entry.filled));
        }
        Chart {
            title,
            across: self.across.clone(),
            upwards: Axis::numbers(format!("{}, {}", self.component, self.lengths.unit)),
            bounds: [[x[0], value(mm[0])], [x[1], value(mm[1])]],
            items,
            legend,
            note,
        }
    }

    /// What it has to show, with a margin.
    fn extent(&self) -> [[f64; 2]; 2] {
        let margin = |[low, high]: [f64; 2], part: f64, least: f64| {
            let by = (part * (high - low)).max(least);
            [low - by, high + by]
        };
        let [from, to] = self.x;
        let mm = [self.mm[0].min(0.0), self.mm[1].max(0.0)];
        [
            margin(self.x, 0.03, 1e-3 + 1e-9 * from.abs().max(to.abs())),
            margin(mm, 0.08, 0.5 * LEAST_SPAN),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(mm: [f64; 2], tolerance_mm: f64) -> Chart {
        let number = |mm: f64| mm.to_string();
        let made = Deviation {
            component: "radial",
            is_length: false,
            across: Axis::numbers("time, s"),
            lengths: Lengths {
                unit: "mm",
                per_mm: 1.0,
                number: &number,
            },
            x: [0.0, 1.0],
            mm,
            sides: false,
            tolerance_mm: Some(tolerance_mm),
            floor_mm: None,
            boundaries: Vec::new(),
            series: Vec::new(),
        };
        made.chart(String::new(), String::new())
    }

    fn band(chart: &Chart) -> Option<[f64; 2]> {
        chart.items.iter().find_map(|item| match item {
            Item::Band(band, _) => Some(*band),
            _ => None,
        })
    }

    #[test]
    fn rounding_noise_does_not_fill_the_chart() {
        let [[_, low], [_, high]] = chart([-2e-14, 3e-14], 0.2).bounds;
        assert!(high - low >= LEAST_SPAN, "{low} {high}");
    }

    #[test]
    fn a_tolerance_wider_than_the_chart_is_not_drawn() {
        assert_eq!(band(&chart([-0.01, 0.01], 0.2)), None);
        assert_eq!(band(&chart([-10.0, 10.0], 0.2)), Some([-0.2, 0.2]));
    }
}
