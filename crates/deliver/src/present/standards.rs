//! The figures of the standards, as terminal, window and report show them.

use super::numbers::fixed;
use super::table::{Cell, Table};
use crate::standards::axis::{AxisTest, Series};
use crate::standards::pose::PoseTest;
use crate::standards::{Positioning, Standards, at_least};
use crate::text::{Template, Text, spoken};

/// The figures of one test.
#[derive(Debug, Clone, Default)]
pub struct Group {
    /// What was tested, a joint or the poses, as a heading.
    pub title: Text,
    /// After which standard.
    pub standard: &'static str,
    /// Unit of the figures.
    pub unit: &'static str,
    /// Under which conditions.
    pub conditions: Text,
    /// The figures that there are.
    pub rows: Vec<FigureRow>,
    /// Why others are missing.
    pub missing: Vec<Text>,
}

/// One figure, in the unit of its group.
#[derive(Debug, Clone)]
pub struct FigureRow {
    /// Its symbol in the standard.
    pub symbol: &'static str,
    /// What it is.
    pub name: Template,
    /// As measured.
    pub before: f64,
    /// With corrected commands.
    pub after: Option<f64>,
}

impl Group {
    /// A figure as it is shown: to 0.1 µm or 0.1″.
    pub fn shown(&self, value: f64) -> String {
        fixed(value, if self.unit == "mm" { 4 } else { 1 })
    }

    /// The figures as a table.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::headed(say!(
            "Symbol | Figure | >As measured, {unit} | >Corrected commands",
            unit = self.unit
        ));
        for row in &self.rows {
            let number = |value| Cell::number(value, |v| self.shown(v));
            table.row([
                row.symbol.into(),
                spoken(row.name).into(),
                number(Some(row.before)),
                number(row.after),
            ]);
        }
        table
    }
}

/// One group for each of at most `most` series of an axis, and one for the poses; axes without a figure for one and the
/// same reason are one group.
pub fn groups(standards: &Standards, most: usize) -> Vec<Group> {
    let axes = standards.axes.iter().flat_map(|axis| of_axis(axis, most));
    let all = axes.chain([of_poses(&standards.poses, standards.compensated)]);
    let all: Vec<Group> = all.collect();
    let together = |alike: &[Group]| match alike {
        [first, .., last] => Group {
            title: Text::listed([&first.title, &last.title], " … "),
            ..first.clone()
        },
        one => one[0].clone(),
    };
    all.chunk_by(is_missing_alike).map(together).collect()
}

/// Whether neither has a figure, after one standard and for one reason.
fn is_missing_alike(one: &Group, other: &Group) -> bool {
    let without = one.rows.is_empty() && other.rows.is_empty();
    without && one.standard == other.standard && one.missing == other.missing
}

fn of_axis(axis: &AxisTest, most: usize) -> Vec<Group> {
    let empty = Group {
        title: text!(
            "Joint {joint} ({name})",
            joint = axis.joint + 1,
            name = &axis.name
        ),
        standard: "ISO 230-2",
        unit: axis.unit,
        missing: axis.missing.iter().cloned().collect(),
        ..Group::default()
    };
    let shown = axis.series.iter().take(most);
    let mut groups: Vec<Group> = shown.map(|one| of_series(axis, one, &empty)).collect();
    if groups.is_empty() {
        groups.push(empty);
    }
    let more = axis.more + axis.series.len().saturating_sub(most);
    if let (1.., Some(last)) = (more, groups.last_mut()) {
        last.missing
            .push(text!("{more} more series under other conditions", more));
    }
    groups
}

fn of_series(axis: &AxisTest, series: &Series, empty: &Group) -> Group {
    let [up, down] = series.before.fewest_runs();
    let after = series.after.as_ref().map(Positioning::rows);
    let rows = series.before.rows().into_iter().enumerate();
    let row = |(k, (symbol, name, before)): (usize, (_, _, Option<f64>))| {
        let after = after.as_ref().and_then(|rows| rows[k].2);
        before.map(|before| FigureRow {
            symbol,
            name,
            before,
            after,
        })
    };
    Group {
        conditions: text!(
            "{conditions}; {positions} positions, each approached {up} in positive and {down} in negative direction",
            conditions = series.fixed.in_words(axis),
            positions = series.before.positions.len(),
            up = at_least(up),
            down = at_least(down)
        ),
        rows: rows.filter_map(row).collect(),
        missing: [&empty.missing[..], &series.missing[..]].concat(),
        ..empty.clone()
    }
}

fn of_poses(test: &PoseTest, compensated: bool) -> Group {
    let before = test.largest(false).rows();
    let after = test.largest(true).rows();
    let row = |((symbol, name, before), (_, _, after)): ((_, _, Option<f64>), (_, _, _))| {
        let after: Option<f64> = after;
        before.map(|before| FigureRow {
            symbol,
            name,
            before,
            after: after.filter(|_| compensated),
        })
    };
    let [poses, turned, paths] = [test.poses.len(), test.variations.len(), test.paths.len()];
    Group {
        title: text!("Poses"),
        standard: "ISO 9283",
        unit: "mm",
        conditions: text!(
            one "{count} pose with two cycles or more, {turned} from several directions, {paths} paths; the largest of each figure", "{count} poses with two cycles or more, {turned} from several directions, {paths} paths; the largest of each figure",
            count = poses,
            turned,
            paths
        ),
        rows: before.into_iter().zip(after).filter_map(row).collect(),
        missing: test.missing.clone(),
    }
}
