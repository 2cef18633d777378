//! The report's plots as drawings; the window saves the same ones as SVG.
//!
//! - [`workspace`](fn@workspace): where the points are and, magnified, how far off.
//! - [`deviation`]: the length of the deviation over a joint's value, a chart for each stage.
//! - [`gap`]: the gap step by step.
//!
//! At most some thousand marks are drawn, whatever the number of samples; the largest deviation is
//! always among them.

mod stages;
mod workspace;

use stages::thinned;
pub use stages::{Stage, Stages};
pub use workspace::workspace;

use crate::model::ResidualStep;
use crate::present::chart;
use crate::present::chart::panel::padded;
use crate::present::chart::{Axis, Deviation, Entry, FULL_WIDTH, LegendSymbol, Lengths, Series};
use crate::present::drawing::Drawing;

use crate::present::numbers::{plain, short};

/// Marks in a chart.
const MOST: usize = 1200;
/// Height of a chart of several, points.
const HEIGHT: f64 = 92.0;

/// One chart below the other, each with its own scale.
pub fn deviation(stages: &Stages) -> Drawing {
    let finite = stages.values.iter().filter(|v| v.is_finite());
    let x = padded(
        finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
            [a.min(*v), b.max(*v)]
        }),
    );
    let mut sheet = Drawing::new(FULL_WIDTH, 0.0);
    for stage in &stages.stages {
        let lengths = &stage.deviations.length_mm;
        let usable = stage.usable();
        let largest = usable.iter().map(|i| lengths[*i]).fold(0.0, f64::max);
        let kept = thinned(&usable, MOST, |i| lengths[i]);
        let sample = |i: usize| (stages.values[i], lengths[i], stages.side[i]);
        let sign = LegendSymbol::Mark(chart::Form::Disc);
        let made = Deviation {
            component: say!("length"),
            is_length: true,
            across: Axis::turning(&stages.over, stages.in_degrees),
            lengths: Lengths {
                unit: "mm",
                per_mm: 1.0,
                number: &short,
            },
            x,
            mm: [0.0, largest],
            sides: stages.side.iter().any(|side| *side != 0.0),
            tolerance_mm: stages.tolerance_mm,
            floor_mm: stages.floor_mm,
            boundaries: Vec::new(),
            series: vec![Series {
                entry: Entry::new(say!("measured"), sign, stage.role, true),
                samples: kept.into_iter().map(sample).collect(),
            }],
        };
        let mut chart = made.chart(stage.name.clone(), String::new());
        // The title says what the marks are.
        chart.legend.remove(0);
        let drawing = chart.in_page(HEIGHT);
        sheet.place(&drawing, [0.0, sheet.height]);
        sheet.height += drawing.height;
    }
    sheet
}

/// The gap step by step.
pub fn gap(steps: &[ResidualStep], floor_mm: Option<f64>, tolerance_mm: Option<f64>) -> Drawing {
    let lengths = Lengths {
        unit: "mm",
        per_mm: 1.0,
        number: &plain,
    };
    let chart = chart::gap(steps, &[], floor_mm, tolerance_mm, lengths);
    chart.map_or_else(Drawing::default, |chart| chart.in_page(chart.height()))
}
