//! A component of the deviation over a quantity, before and after. Of many one stands for all in its small cell of the chart, until few
//! are in sight.

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::quantity::Over;
use crate::numeric::whole;
use crate::present::chart::LEAST_SPAN;

/// Cells across and upwards, in which one of many samples is drawn.
const CELLS: [usize; 2] = [160, 60];

/// As many in sight are all drawn.
const MOST_MARKS: usize = 1500;

/// Before, 0, or after, 1.
pub(crate) type When = usize;

/// Where a sample is, inner units; NaN where that is not known.
pub(crate) fn at(
    loaded_session: &LoadedSession,
    answer: Option<&Answer>,
    (over, component): (Over, Component),
    when: When,
    sample: usize,
) -> [f64; 2] {
    let deviation = match (when, answer) {
        (0, _) => Some(loaded_session.deviation_before(sample)),
        (_, answer) => answer.map(|answer| answer.deviation_after(sample)),
    };
    let value = deviation.map(|e| loaded_session.component(e, sample, component));
    [over.of(loaded_session, sample), value.unwrap_or(f64::NAN)]
}

/// Samples that have both quantities, before and after.
#[derive(Clone, Default)]
pub(crate) struct PointsOfBoth(pub(crate) [Points; 2]);

#[derive(Clone, Default)]
pub(crate) struct Points {
    /// From the left to the right.
    pub(crate) samples: Vec<u32>,
    /// One for each cell in which there are any; all where they are few.
    pub(crate) drawn: Vec<u32>,
    /// Smallest and largest value across and upwards.
    pub(crate) extent: Option<[[f64; 2]; 2]>,
}

impl PointsOfBoth {
    pub(crate) fn of(
        session: &LoadedSession,
        answer: Option<&Answer>,
        (over, component): (Over, Component),
    ) -> Self {
        // What rounding alone scatters is one cell high.
        let least = [0.0, LEAST_SPAN];
        Self([0, 1].map(|when| {
            let place = |sample: usize| at(session, answer, (over, component), when, sample);
            let known = when == 0 || answer.is_some();
            let usable = session.overview.usable.iter().filter(|_| known);
            Points::of(usable.copied(), place, least)
        }))
    }
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
