//! The exported table as a curve: what is added to each command, for each side.

use super::{ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown};
use crate::compensation::SortedTable;
use crate::export::ReadBack;
use crate::gui::cache::ExportPreview;
use crate::gui::core::overview::{MOST_POINTS, stride, thinned};
use crate::gui::core::quantity::Scale;
use crate::gui::help;
use crate::gui::view::Step;
use crate::kinematics::JointKind;
use crate::numeric::extent;
use crate::present::chart::{Axis, Chart, ColourRole, Item, LEAST_SPAN};
use crate::present::table::{Table, cell};
use crate::present::units::Units;

pub(crate) static CORRECTION: ChartKind = ChartKind {
    name: phrase!("correction table"),
    is_offered: |scene| {
        let alone = scene.loaded_session.is_empty();
        let step = scene.step == Step::Export || alone;
        // A description of the robot has no curve; then the samples are more to look at.
        let shows = |made: &ExportPreview| step && (alone || made.export.reads_as.is_some());
        scene.preview.as_deref().is_some_and(shows)
    },
    suits: |_| true,
    ..ChartKind::new(
        "correction table",
        help::CORRECTION,
        ChartChoice::All,
        show,
        numbers,
    )
};

/// The export and the table that it holds; `None` where it has none.
fn table(scene: &Scene) -> Option<(&ExportPreview, &ReadBack)> {
    let made = scene.preview.as_deref()?;
    Some((made, made.export.reads_as.as_ref()?))
}

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let none = say!("This format describes the robot itself and has no table");
    let (made, table) = table(scene).ok_or(ChartPlaceholder::new(none, ""))?;
    let chart = chart(&made.joint, table, scene.units);
    Ok(Shown::new(chart, say!("correction table as a curve")))
}

/// Every entry.
fn numbers(scene: &Scene) -> Table {
    let Some((made, read)) = table(scene) else {
        return Table::default();
    };
    let unit = read.kind.unit();
    let along = format!("{}, {unit}", cell(&made.joint));
    let mut table = Table::new([&along, "side", &format!("correction, {unit}")]);
    for (side, column) in [(1.0, &read.forward), (-1.0, &read.reverse)] {
        for (at, value) in column.places().iter().zip(column.values()) {
            table.row([*at, side, *value]);
        }
    }
    table
}

/// Points of one curve: commanded value and correction, as many times as large as in the table's unit.
fn curve(column: &SortedTable, factor: f64) -> Vec<[f64; 2]> {
    let every = stride(column.values().len(), MOST_POINTS / 4);
    let all = column.places().iter().zip(column.values()).step_by(every);
    all.map(|(at, value)| [factor * at, factor * value])
        .collect()
}

/// What the upward axis has to show: zero, every correction, and no less than can be read. A
/// constant correction is a straight line then, not the noise of its last digit.
fn span<'p>(points: impl Iterator<Item = &'p [f64; 2]>, least: f64) -> [f64; 2] {
    let [low, high] = extent(points.map(|p| p[1]).chain([0.0]));
    let more = 0.5 * (least - (high - low)).max(0.0);
    [low - more, high + more]
}

fn chart(joint: &str, table: &ReadBack, units: Units) -> Chart {
    let scale = Scale::of_joint(units, table.kind == JointKind::Revolute);
    let factor = scale.shown(table.kind.to_base_units(1.0));
    let (forward, reverse) = (curve(&table.forward, factor), curve(&table.reverse, factor));
    let [low, high] = span(forward.iter().chain(&reverse), factor * LEAST_SPAN);
    let from = forward.first().map_or(0.0, |p| p[0]);
    let to = forward.last().map_or(1.0, |p| p[0]).max(from + 1e-6);
    let (beside, by) = (0.03 * (to - from), 0.2 * (high - low));
    let every = stride(table.forward.values().len(), MOST_POINTS / 4);
    let mut items = Vec::new();
    let says = if table.forward == table.reverse {
        say!("the same for both directions")
    } else {
        items.push(Item::Line(reverse, ColourRole::Before, 2.0, true));
        say!("solid: approach + · dashed: approach −")
    };
    let notes = std::iter::once(says.to_owned()).chain(thinned(
        every,
        phrase!("one point in {stride} shown"; stride),
    ));
    items.push(Item::Line(forward, ColourRole::After, 2.0, false));
    Chart {
        title: say!("correction table").to_owned(),
        across: scale.axis(joint),
        upwards: Axis::numbers(say!("correction, {unit}", unit = scale.unit)),
        bounds: [[from - beside, low - by], [to + beside, high + by]],
        items,
        legend: Vec::new(),
        note: notes.collect::<Vec<_>>().join(" · "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_table_is_shown_from_zero() {
        let table = [[0.0, 0.3614], [1.0, 0.3614 + 1e-15]];
        let [low, high] = span(table.iter(), LEAST_SPAN);
        assert_eq!(low, 0.0);
        assert!((high - 0.3614).abs() < 1e-12);
        let [low, high] = span([[0.0, 1e-17], [1.0, -1e-17]].iter(), LEAST_SPAN);
        assert!(high - low >= 0.999 * LEAST_SPAN, "{low} {high}");
    }
}
