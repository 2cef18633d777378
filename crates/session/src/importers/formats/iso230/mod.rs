//! Runs after ISO 230-2: an axis goes to the same targets several times, from both sides, and its
//! own position is measured.
//!
//! Long: a row for each measurement, with target, direction, run and position. Wide: a row for each
//! target, and a column for each run and direction, whose heading says both (`Run 1 +`, `2↓`). A
//! position may be given as the deviation from its target; then a heading says so, or the numbers
//! leave no doubt and the program says so. The file of a laser's own software is read too ([`sections`]).
//!
//! Time goes run by run; within a run of a wide table upwards first, and then downwards.

mod in_units;
mod parts;
mod sections;

use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns};
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions};
use crate::importers::reader::{SIDES, direction};
use crate::importers::role::Role;
use crate::importers::settings::{ColumnGuess, Known, ReadContext};
use crate::importers::times::extent;
use crate::sessions::Lines;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::correction::{GRADIAN_DEG, LARGEST_SCALE, SCALE_FAR_FROM_ONE};
use crate::tables::Cells;
use crate::tables::decimals::{Decimal, value};
use crate::tables::{Complaints, Grid};
use crate::text::{Template, Text};

use in_units::{Units, units_of};
use parts::{Measurement, TableColumn, headings, parts};

pub(crate) static IMPORTER: Importer = Importer {
    id: "iso230",
    title: phrase!("an ISO 230-2 run: targets and positions of one axis"),
    asks: Questions {
        columns: Meanings::Own(&[
            ("target", "target position"),
            ("direction", "direction of approach"),
            ("run", "run"),
            ("position", "measured position"),
            ("deviation", "deviation from the target"),
        ]),
        joint: true,
        ..Questions::TABLE
    },
    options: &[],
    known_by: KnownBy::headed(3),
    read,
};

/// Reads the runs of an axis.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    if sections::is_one(context.text) {
        let list = sections::runs(context);
        context.found.rows = list.len();
        let has_samples = context.has_samples();
        return has_samples.then(|| columns(context, &list, true, sections::UNITS));
    }
    let grid = context.grid()?;
    let headings = headings(&grid);
    let parts = parts(context, &grid, &headings)?;
    let said = &context.reading.columns;
    context.found.columns = headings
        .iter()
        .zip(&parts)
        .enumerate()
        .map(|(k, (heading, part))| ColumnGuess {
            heading: heading.clone(),
            confidence: match (said.get(k), heading.as_str()) {
                (Some(word), heading) if word != heading => Known::Said,
                (_, "") => Known::FromContent,
                _ => Known::FromHeading,
            },
            meaning: match part {
                TableColumn::Target => "target".to_owned(),
                TableColumn::Direction => "direction".to_owned(),
                TableColumn::Run => "run".to_owned(),
                TableColumn::Position => "position".to_owned(),
                TableColumn::Deviation => "deviation".to_owned(),
                TableColumn::Of { run, dir } => {
                    format!("run {run} {}", if *dir < 0.0 { "-" } else { "+" })
                }
                TableColumn::Other => "-".to_owned(),
            },
        })
        .collect();
    let is_number = |index: usize| {
        !matches!(
            parts.get(index),
            None | Some(TableColumn::Direction | TableColumn::Run | TableColumn::Other)
        )
    };
    let decimal = context.decimal_sign(&grid, &is_number);
    let units = units_of(context, &grid, &headings, &parts);
    let (decimal, units) = (decimal?, units?);
    let list = measurements(context, &grid, &parts, decimal);
    context.found.rows = list.len();
    if !context.has_samples() {
        return None;
    }
    let is_wide = parts
        .iter()
        .any(|part| matches!(part, TableColumn::Of { .. }));
    let is_deviation = deviations(context, &parts, &list, units)?;
    Some(columns(
        context,
        &in_order(list, is_wide),
        is_deviation,
        units,
    ))
}

/// Reads every measured cell.
fn measurements(
    context: &mut ReadContext<'_>,
    grid: &Grid<'_>,
    parts: &[TableColumn],
    decimal: Decimal,
) -> Vec<Measurement> {
    let mut list = Vec::new();
    let mut complaints = Complaints::default();
    let mut empty = 0;
    let place = context.place.clone();
    grid.each_row(&place, &mut complaints, |row, complaints| {
        let cell = |index: usize| row.cells.get(index).map_or("", |cell| cell.as_ref());
        let mut wrong = |index: usize, expected: Template| {
            complaints.add(|| {
                let place = place.clone().at_line(row.line).at_column(index as u64 + 1);
                Diagnostic::error(place, Text::verbatim(quoted(cell(index))), expected)
            });
        };
        let (mut target, mut dir, mut run) = (None, 0.0, 1);
        for (index, part) in parts.iter().enumerate() {
            match part {
                TableColumn::Target => match value(cell(index), decimal) {
                    Ok(number) => target = Some(number),
                    Err(_) => wrong(index, phrase!("a number")),
                },
                TableColumn::Direction => match direction(cell(index)) {
                    Some(number) => dir = number,
                    None => wrong(index, SIDES),
                },
                TableColumn::Run => match cell(index).parse() {
                    Ok(number) => run = number,
                    Err(_) => wrong(index, phrase!("a number")),
                },
                _ => {}
            }
        }
        for (index, part) in parts.iter().enumerate() {
            let (run, dir) = match part {
                TableColumn::Position | TableColumn::Deviation => (run, dir),
                TableColumn::Of { run, dir } => (*run, *dir),
                _ => continue,
            };
            if cell(index).is_empty() {
                empty += 1;
                continue;
            }
            match (value(cell(index), decimal), target) {
                (Ok(measured), Some(target)) => list.push(Measurement {
                    run,
                    dir,
                    target,
                    measured,
                    line: row.line,
                }),
                (Ok(_), None) => {}
                (Err(_), _) => wrong(
                    index,
                    phrase!("a finite number, or an empty cell where it is missing"),
                ),
            }
        }
    });
    complaints.into(&place, &mut context.found.findings);
    if empty > 0 {
        context.note(text!(
            one "{count} cell is empty: not measured, excluded",
            "{count} cells are empty: not measured, excluded",
            count = empty
        ));
    }
    list
}

/// What is smaller than this share of the travel are deviations of an axis and no positions.
const DEVIATIONS_SHARE: f64 = 0.02;
/// Fewer positions lie on a line by accident.
const FEWEST_ON_A_LINE: usize = 6;

const NEAR: Template = phrase!("positions near their targets, in the same unit, or deviations");

/// Whether deviations stand in the place of positions.
fn deviations(
    context: &mut ReadContext<'_>,
    parts: &[TableColumn],
    list: &[Measurement],
    units: Units,
) -> Option<bool> {
    if parts.contains(&TableColumn::Deviation) {
        return Some(true);
    }
    let targets: Vec<f64> = list
        .iter()
        .map(|m| m.target * units.target.factor())
        .collect();
    let travel = extent(&targets);
    let largest = |of: &dyn Fn(f64, f64) -> f64| {
        let each = list.iter().zip(&targets);
        let each = each.map(|(m, target)| of(m.measured * units.measured.factor(), *target).abs());
        each.fold(0.0, f64::max)
    };
    let off = largest(&|measured, target| measured - target);
    if travel == 0.0 || off <= SCALE_FAR_FROM_ONE * travel {
        return Some(false);
    }
    if largest(&|measured, _| measured) <= DEVIATIONS_SHARE * travel {
        context.warn(
            text!("the measured values are far too small for positions: they are taken as deviations from the targets"),
            NEAR,
        );
        return Some(true);
    }
    let measured = list.iter().map(|m| m.measured * units.measured.factor());
    if let Some(scale) = scale_of(&targets, &measured.collect::<Vec<f64>>()) {
        context.warn(
            text!(
                "the measured positions follow {scale} times their targets: the scale of the axis is taken to be wrong",
                scale = format!("{scale:.3}")
            ),
            NEAR,
        );
        return Some(false);
    }
    context.refuse(
        text!(
            "measured positions are up to {travel} % of the travel away from their targets",
            travel = format!("{:.1}", 100.0 * off / travel)
        ),
        NEAR,
    );
    None
}

/// The scale of an axis that moves far more or less than it is told: all positions lie on a line over their targets (off
/// it by less than deviations are taken for positions), whose slope no mistaken unit has.
fn scale_of(targets: &[f64], measured: &[f64]) -> Option<f64> {
    let n = targets.len() as f64;
    let mean = |of: &[f64]| of.iter().sum::<f64>() / n;
    let [about, at] = [mean(targets), mean(measured)];
    let both = || {
        targets
            .iter()
            .zip(measured)
            .map(|(t, m)| (t - about, m - at))
    };
    let slope = both().map(|(t, m)| t * m).sum::<f64>() / both().map(|(t, _)| t * t).sum::<f64>();
    let off = both()
        .map(|(t, m)| (m - slope * t).abs())
        .fold(0.0, f64::max);
    let is_line = targets.len() >= FEWEST_ON_A_LINE
        && off <= DEVIATIONS_SHARE * slope.abs() * extent(targets);
    let is_unit = [GRADIAN_DEG, 1.0 / GRADIAN_DEG]
        .iter()
        .any(|unit| (slope / unit - 1.0).abs() < 0.01);
    (is_line && !is_unit && (1.0 / LARGEST_SCALE..LARGEST_SCALE).contains(&slope.abs()))
        .then_some(slope)
}

/// In the order in which it was measured.
fn in_order(mut list: Vec<Measurement>, is_wide: bool) -> Vec<Measurement> {
    if is_wide {
        // Upwards with rising targets, then downwards with falling ones.
        list.sort_by(|a, b| {
            let run = a.run.cmp(&b.run).then(b.dir.total_cmp(&a.dir));
            let target = a.target.total_cmp(&b.target);
            run.then(if a.dir < 0.0 {
                target.reverse()
            } else {
                target
            })
        });
    } else {
        list.sort_by_key(|measurement| measurement.run);
    }
    list
}

fn columns(
    context: &ReadContext<'_>,
    list: &[Measurement],
    is_deviation: bool,
    units: Units,
) -> Columns {
    let joint = context.reading.joint;
    let of = |get: fn(&Measurement) -> f64| list.iter().map(get).collect::<Vec<f64>>();
    let position = |m: &Measurement| {
        let measured = m.measured * units.measured.factor();
        let target = if is_deviation {
            m.target * units.target.factor()
        } else {
            0.0
        };
        target + measured
    };
    let mut lines = Lines::default();
    for measurement in list {
        lines.add(measurement.line, 1);
    }
    let commanded = Quantity::Commanded(joint);
    let mut columns = vec![
        Column::made(commanded, units.target, of(|m| m.target)),
        Column {
            name: "position".to_owned(),
            number: 0,
            role: Role::Axis(joint),
            cells: Cells::Numbers(list.iter().map(position).collect()),
        },
        Column::kept("run", list.iter().map(|m| m.run.to_string()).collect()),
    ];
    let dir = of(|m| m.dir);
    if dir.iter().any(|dir| *dir != 0.0) {
        columns.push(Column::made(Quantity::Direction(joint), Unit::Fixed, dir));
    }
    Columns {
        list: columns,
        lines,
        ..Columns::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_table_is_put_into_the_order_of_measuring() {
        let at = |run, dir, target| Measurement {
            run,
            dir,
            target,
            measured: 0.0,
            line: 0,
        };
        let list = vec![
            at(1, 1.0, 0.0),
            at(1, -1.0, 0.0),
            at(2, 1.0, 0.0),
            at(1, 1.0, 9.0),
            at(1, -1.0, 9.0),
            at(2, 1.0, 9.0),
        ];
        let order: Vec<(u64, f64, f64)> = in_order(list, true)
            .iter()
            .map(|m| (m.run, m.dir, m.target))
            .collect();
        assert_eq!(
            order,
            [
                (1, 1.0, 0.0),
                (1, 1.0, 9.0),
                (1, -1.0, 9.0),
                (1, -1.0, 0.0),
                (2, 1.0, 0.0),
                (2, 1.0, 9.0)
            ]
        );
    }
}
