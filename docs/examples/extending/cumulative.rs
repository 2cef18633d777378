//! How many samples deviate by no more than a length: each sample's length of what is left over its
//! share of all, in ascending order.
//!
//! ```text
//! share_i = i / n,      |e|_1 ≤ |e|_2 ≤ …
//! ```

use super::{ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown};
use crate::gui::help::Word;
use crate::present::chart::{Axis, Chart, ColourRole, Entry, Item, LEAST_SPAN, LegendSymbol};
use crate::present::table::{Cell, Table};

pub(crate) static CUMULATIVE: ChartKind = ChartKind::new(
    "cumulative deviations",
    Word {
        name: phrase!("Cumulative deviations"),
        means: phrase!(
            "The share of the samples whose deviation is no larger than a length: where the curve passes 95 % is the deviation that one of twenty samples exceeds"
        ),
    },
    ChartChoice::Component,
    show,
    numbers,
);

/// Lengths in ascending order, mm.
struct Sorted(Vec<f64>);

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let sorted = Sorted::of_what_is_left(scene);
    if sorted.0.is_empty() {
        return Err(ChartPlaceholder::new(
            say!("No sample can be counted"),
            say!("Every sample lacks a joint value or a coordinate"),
        ));
    }
    Ok(Shown::new(
        sorted.drawn(scene),
        say!("cumulative deviations"),
    ))
}

fn numbers(scene: &Scene) -> Table {
    let mut table = Table::headed("share | deviation, mm");
    let sorted = Sorted::of_what_is_left(scene).0;
    for (i, mm) in sorted.iter().enumerate() {
        table.row([
            Cell::from((i + 1) as f64 / sorted.len() as f64),
            (*mm).into(),
        ]);
    }
    table
}

impl Sorted {
    fn of_what_is_left(scene: &Scene) -> Self {
        let (before, after) = scene.values(&scene.usable().collect::<Vec<_>>());
        Self::of(after.unwrap_or(before))
    }

    fn of(values: Vec<f64>) -> Self {
        let mut sizes: Vec<f64> = values.into_iter().map(f64::abs).collect();
        sizes.retain(|size| size.is_finite());
        sizes.sort_unstable_by(f64::total_cmp);
        Self(sizes)
    }

    /// The length that this share of the samples does not exceed, mm.
    fn at(&self, share: f64) -> f64 {
        let count = (share * self.0.len() as f64).ceil() as usize;
        self.0[count.clamp(1, self.0.len()) - 1]
    }

    fn drawn(&self, scene: &Scene) -> Chart {
        let value = |mm: f64| scene.units.length_value(mm);
        let most = self.0.last().copied().unwrap_or(0.0).max(LEAST_SPAN);
        let n = self.0.len() as f64;
        let point = |(i, mm): (usize, &f64)| [value(*mm), 100.0 * (i + 1) as f64 / n];
        Chart {
            title: say!("share of the samples over their deviation").to_owned(),
            across: Axis::numbers(say!(
                "deviation, {units}",
                units = scene.units.length_name()
            )),
            upwards: Axis::numbers(say!("samples, %")),
            bounds: [[0.0, 0.0], [value(1.05 * most), 105.0]],
            items: vec![Item::Line(
                self.0.iter().enumerate().map(point).collect(),
                ColourRole::After,
                1.6,
                false,
            )],
            legend: vec![Entry::after(LegendSymbol::Line)],
            note: say!(
                "95 % of the samples deviate by {at} or less",
                at = scene.units.length(self.at(0.95))
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nineteen_of_twenty_are_no_larger() {
        let sorted = Sorted::of((1..=20).map(|k| -f64::from(k)).collect());
        assert!((sorted.at(0.95) - 19.0).abs() < 1e-12);
        assert!((sorted.at(1.0) - 20.0).abs() < 1e-12);
    }
}
