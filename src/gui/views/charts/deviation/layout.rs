//! Where the parts of the deviation chart go.

use std::sync::Arc;

use super::model::Series;
use crate::gui::cache::charts::envelope::{Column, Envelope};
use crate::gui::core::scale::LEAST_SPAN;

/// What the chart has to show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    /// Smallest and largest value of what it stands over.
    pub(crate) x: [f64; 2],
    /// Smallest and largest deviation, mm; zero is always between them.
    pub(crate) mm: [f64; 2],
}

/// Smallest and largest place along the chart and deviation of everything; `None` where there is
/// nothing.
pub(crate) fn whole(series: &Series, envelope: Option<&Envelope>) -> Option<Column> {
    if let Some(envelope) = envelope {
        return envelope.extent();
    }
    let wider = |range: Option<[f64; 2]>, value: f64| {
        let [low, high] = range.unwrap_or([value; 2]);
        value
            .is_finite()
            .then_some([low.min(value), high.max(value)])
            .or(range)
    };
    let mut all: Option<Column> = None;
    for dot in &series.dots {
        let known = all.get_or_insert(Column {
            x: [dot.x; 2],
            before_mm: None,
            after_mm: None,
        });
        known.x = [known.x[0].min(dot.x), known.x[1].max(dot.x)];
        known.before_mm = wider(known.before_mm, dot.before_mm);
        if let Some(after) = dot.after_mm {
            known.after_mm = wider(known.after_mm, after);
        }
    }
    all
}

/// Smallest and largest place along the chart.
pub(crate) fn along(series: &Series, envelope: Option<&Envelope>) -> [f64; 2] {
    whole(series, envelope).map_or([-1.0, 1.0], |all| all.x)
}

/// The extent of a series, with a margin; of what is left alone where it is looked at alone.
pub(crate) fn extent(series: &Series, envelope: Option<&Envelope>, only_after: bool) -> Extent {
    let mut mm = [0.0_f64, 0.0_f64];
    let all = whole(series, envelope);
    if let Some(all) = all {
        let before = all
            .before_mm
            .filter(|_| !only_after || all.after_mm.is_none());
        for [low, high] in before.into_iter().chain(all.after_mm) {
            mm = [mm[0].min(low), mm[1].max(high)];
        }
    }
    let margin = |[low, high]: [f64; 2], part: f64, least: f64| {
        let by = (part * (high - low)).max(least);
        [low - by, high + by]
    };
    let x = all.map_or([-1.0, 1.0], |all| all.x);
    let least = 1e-3 + 1e-9 * x[0].abs().max(x[1].abs());
    Extent {
        x: margin(x, 0.03, least),
        mm: margin(mm, 0.08, 0.5 * LEAST_SPAN),
    }
}

/// Width of a column, points.
const COLUMN: f64 = 2.0;
/// More samples in sight than this are shown by their extremes.
const MOST_DOTS: usize = 600;

/// What a chart of many samples shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Many {
    /// Few are in sight: these.
    Samples(Vec<usize>),
    /// Extremes.
    Columns(Arc<[Column]>),
}

/// Whether what is in sight between two values along the chart is shown by its extremes.
pub(crate) fn are_many(envelope: &Envelope, x: [f64; 2]) -> bool {
    envelope.count(x) > MOST_DOTS
}

/// What is in sight between two values along the chart, in so many points of the screen.
pub(crate) fn in_sight(envelope: &Envelope, x: [f64; 2], points: f64) -> Many {
    if !are_many(envelope, x) {
        return Many::Samples(envelope.samples(x, MOST_DOTS).collect());
    }
    let columns = crate::gui::units::whole((points / COLUMN).ceil().min(8192.0)).max(1);
    Many::Columns(envelope.columns(x, columns))
}

/// The tolerance as a band, mm: both ways for a component, from zero for a length. `None` where
/// it is so wide that it would cover everything.
pub(crate) fn band(series: &Series, extent: &Extent, length: bool) -> Option<[f64; 2]> {
    let tolerance = series.tolerance_mm?;
    let low = if length { 0.0 } else { -tolerance };
    let hides_all = low <= extent.mm[0] && tolerance >= extent.mm[1];
    (!hides_all).then_some([low.max(extent.mm[0]), tolerance.min(extent.mm[1])])
}

#[cfg(test)]
mod tests {
    use super::super::model::Dot;
    use super::*;
    use crate::gui::cache::charts::over::{Over, Variable};

    fn series(values: &[(f64, f64, Option<f64>)]) -> Series {
        let dot = |(sample, &(x, before_mm, after_mm)): (usize, &(f64, f64, Option<f64>))| Dot {
            sample,
            x,
            before_mm,
            after_mm,
            side: 0.0,
        };
        Series {
            dots: values.iter().enumerate().map(dot).collect(),
            stride: 1,
            over: Over {
                variable: Variable::Joint,
                joint: 0,
            },
            boundaries_rad: Vec::new(),
            unplaced: 0,
            tolerance_mm: Some(0.2),
        }
    }

    #[test]
    fn what_is_left_can_be_looked_at_alone() {
        let series = series(&[(0.0, 10.0, Some(0.1)), (1.0, 12.0, Some(-0.1))]);
        assert!(extent(&series, None, false).mm[1] > 12.0);
        let alone = extent(&series, None, true).mm;
        assert!(alone[1] < 0.2 && alone[0] > -0.2, "{alone:?}");
    }

    #[test]
    fn an_empty_chart_has_an_extent() {
        let extent = extent(&series(&[]), None, false);
        assert!(extent.x[0] < extent.x[1] && extent.mm[0] < extent.mm[1]);
    }

    #[test]
    fn rounding_noise_does_not_fill_the_chart() {
        let exact = series(&[(0.0, 0.0, Some(3e-14)), (1.0, 0.0, Some(-2e-14))]);
        let [low, high] = extent(&exact, None, true).mm;
        assert!(high - low >= LEAST_SPAN, "{low} {high}");
    }

    #[test]
    fn a_tolerance_wider_than_the_chart_is_not_drawn() {
        let small = series(&[(0.0, 0.01, None), (1.0, -0.01, None)]);
        assert_eq!(band(&small, &extent(&small, None, false), false), None);
        let large = series(&[(0.0, 10.0, None), (1.0, -10.0, None)]);
        assert_eq!(
            band(&large, &extent(&large, None, false), false),
            Some([-0.2, 0.2])
        );
    }
}
