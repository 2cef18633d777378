//! Runs after ISO 230-2: an axis goes to the same targets several times, from both sides, and its
//! own position is measured.
//!
//! Long: a row for each measurement, with target, direction, run and position. Wide: a row for each
//! target, and a column for each run and direction, whose heading says both (`Run 1 +`, `2↓`). A
//! position may be given as the deviation from its target; then a heading says so, or the numbers
//! leave no doubt and the program says so.
//!
//! Time goes run by run; within a run of a wide table upwards first, and then downwards.

use crate::diagnostic::Diagnostic;
use crate::importers::case::{Case, direction, extent, fixed};
use crate::importers::columns::{Column, Columns};
use crate::importers::decimals::{Decimal, value};
use crate::importers::grid::{Complaints, Grid};
use crate::importers::headings::{Role, words_and_unit};
use crate::importers::settings::{About, ColumnGuess, Known};
use crate::importers::units::{self, AngleUnit, LengthUnit, Word};
use crate::sessions::Lines;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::number::quoted;
use crate::sessions::table::Cells;

/// What a column of the table is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Target,
    Direction,
    Run,
    /// Measured, in a long table.
    Position,
    /// Measured less target, in a long table.
    Deviation,
    /// Measured in this run, with this direction.
    Of {
        run: u64,
        dir: f64,
    },
    Other,
}

/// One measurement, in the order of the file.
#[derive(Debug, Clone, Copy)]
struct Measurement {
    run: u64,
    dir: f64,
    target: f64,
    measured: f64,
    line: u64,
}

/// Reads the runs of an axis.
pub(crate) fn read(case: &mut Case<'_>) -> Option<Columns> {
    let grid = case.grid()?;
    let headings = headings(&grid);
    let parts = parts(case, &grid, &headings)?;
    let said = &case.reading.columns;
    case.found.columns = headings
        .iter()
        .zip(&parts)
        .enumerate()
        .map(|(k, (heading, part))| ColumnGuess {
            heading: heading.clone(),
            known: match (said.get(k), heading.as_str()) {
                (Some(word), heading) if word != heading => Known::Said,
                (_, "") => Known::FromContent,
                _ => Known::FromHeading,
            },
            meaning: match part {
                Part::Target => "target".to_owned(),
                Part::Direction => "direction".to_owned(),
                Part::Run => "run".to_owned(),
                Part::Position => "position".to_owned(),
                Part::Deviation => "deviation".to_owned(),
                Part::Of { run, dir } => {
                    format!("run {run} {}", if *dir < 0.0 { "-" } else { "+" })
                }
                Part::Other => "-".to_owned(),
            },
        })
        .collect();
    let is_number = |index: usize| {
        !matches!(
            parts.get(index),
            None | Some(Part::Direction | Part::Run | Part::Other)
        )
    };
    let place = case.place.clone();
    let found = &mut case.found;
    let decimal = grid.decimal(
        case.reading.decimal,
        &is_number,
        &place,
        &mut found.questions,
        &mut found.findings,
    );
    case.found.decimal = decimal;
    let units = units_of(case, &grid, &headings, &parts);
    let (decimal, units) = (decimal?, units?);
    let list = measurements(case, &grid, &parts, decimal);
    case.found.rows = list.len();
    if list.is_empty() && !case.is_open() {
        case.refuse("no measurement", "at least one");
    }
    if case.is_open() {
        return None;
    }
    let is_wide = parts.iter().any(|part| matches!(part, Part::Of { .. }));
    let is_deviation = deviations(case, &parts, &list, units)?;
    Some(columns(case, &in_order(list, is_wide), is_deviation, units))
}

/// The headings; a second line of headings above is joined in: runs above directions.
fn headings(grid: &Grid<'_>) -> Vec<String> {
    let Some((_, names)) = &grid.header else {
        return vec![String::new(); grid.width];
    };
    let mut names: Vec<String> = names.clone();
    names.resize(grid.width, String::new());
    let has_run = names
        .iter()
        .any(|name| name.chars().any(|c| c.is_ascii_digit()));
    let above = grid.preamble.last().filter(|above| {
        above.len() + 1 >= names.len() && above.iter().filter(|cell| !cell.is_empty()).count() > 1
    });
    if let (false, Some(above)) = (has_run, above) {
        let mut last = "";
        for (name, above) in names.iter_mut().zip(above) {
            if !above.is_empty() {
                last = above;
            }
            format!("{last} {name}").trim().clone_into(name);
        }
    }
    names
}

/// What each column is.
fn parts(case: &mut Case<'_>, grid: &Grid<'_>, headings: &[String]) -> Option<Vec<Part>> {
    let given = &case.reading.columns;
    let parts: Vec<Part> = if !given.is_empty() {
        let mut parts: Vec<Part> = given.iter().map(|word| part_of(word)).collect();
        parts.resize(grid.width, Part::Other);
        parts
    } else if grid.header.is_some() {
        let mut seen: Vec<f64> = Vec::new();
        let mut parts: Vec<Part> = headings.iter().map(|heading| part_of(heading)).collect();
        // Without a number the columns of one direction are counted.
        for part in &mut parts {
            if let Part::Of { run, dir } = part {
                seen.push(*dir);
                if *run == 0 {
                    *run = seen.iter().filter(|other| *other == dir).count() as u64;
                }
            }
        }
        parts
    } else if grid.width == 4 {
        case.note("no header: the columns are taken as target, direction, run, position");
        vec![Part::Target, Part::Direction, Part::Run, Part::Position]
    } else {
        let says = format!("{} columns and no header", grid.width);
        case.ask(About::Columns, says, &["target,direction,run,position"]);
        return None;
    };
    let count = |wanted: fn(&Part) -> bool| parts.iter().filter(|part| wanted(part)).count();
    let targets = count(|part| *part == Part::Target);
    let long = count(|part| matches!(part, Part::Position | Part::Deviation));
    let wide = count(|part| matches!(part, Part::Of { .. }));
    if targets != 1 || (long == 0 && wide == 0) || long > 1 || (long > 0 && wide > 0) {
        let names: Vec<String> = headings.iter().map(|heading| quoted(heading)).collect();
        let says = format!(
            "{targets} columns of targets and {} of positions among {}",
            long + wide,
            names.join(", ")
        );
        let long = "target,direction,run,position";
        let wide = "target,\"run 1 +\",\"run 1 -\"";
        case.ask(About::Columns, says, &[long, wide]);
        return None;
    }
    Some(parts)
}

fn part_of(heading: &str) -> Part {
    let plain = heading.trim().to_lowercase();
    let (words, _) = words_and_unit(&plain);
    let has = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
    // A heading of one run says its number, its direction, or both.
    if let Some(dir) = direction_in(&plain) {
        let digits: String = plain
            .chars()
            .skip_while(|c| !c.is_ascii_digit())
            .take_while(char::is_ascii_digit)
            .take(6)
            .collect();
        return Part::Of {
            run: digits.parse().unwrap_or(0),
            dir,
        };
    }
    if has(&["deviation", "dev", "error", "err", "abweichung", "fehler"]) {
        Part::Deviation
    } else if has(&["direction", "dir", "richtung", "approach"]) {
        Part::Direction
    } else if has(&["run", "cycle", "lauf", "zyklus", "repeat"]) {
        Part::Run
    } else if has(&[
        "target",
        "nominal",
        "soll",
        "sollposition",
        "commanded",
        "setpoint",
    ]) {
        Part::Target
    } else if has(&[
        "position",
        "actual",
        "measured",
        "ist",
        "istposition",
        "reading",
    ]) {
        Part::Position
    } else {
        Part::Other
    }
}

/// The direction that a heading such as `Run 1 +`, `2↓` or `R3 fwd` names.
fn direction_in(heading: &str) -> Option<f64> {
    let name = heading.split(['[', '(']).next().unwrap_or_default().trim();
    let numbered = name.chars().any(|c| c.is_ascii_digit());
    let words = name.split([' ', '_', '-', ',', ';', '.']);
    let by_word = words
        .filter(|word| word.chars().any(char::is_alphabetic) && word.chars().count() > 1)
        .find_map(direction);
    let last = name.chars().last();
    let by_sign = last
        .filter(|c| !c.is_alphanumeric())
        .and_then(|c| direction(&c.to_string()));
    // `position -` says nothing; `1 -` and `run -` do.
    let is_run = numbered || name.contains("run") || name.chars().count() == 1;
    by_word.or_else(|| by_sign.filter(|_| is_run))
}

/// Units of targets and of what was measured.
#[derive(Debug, Clone, Copy)]
struct Units {
    target: Unit,
    measured: Unit,
}

fn units_of(
    case: &mut Case<'_>,
    grid: &Grid<'_>,
    headings: &[String],
    parts: &[Part],
) -> Option<Units> {
    let suits = |unit: &Unit| match unit {
        Unit::Length(_) => case.reading.slides,
        Unit::Angle(_) => !case.reading.slides,
        Unit::Fixed => false,
    };
    let in_heading = |index: usize| match words_and_unit(&headings.get(index)?.to_lowercase()).1? {
        Word::Unit(unit) => Some(unit),
        _ => None,
    };
    let mut target = None;
    let mut measured = None;
    let mut strange = None;
    for (index, part) in parts.iter().enumerate() {
        let unit = in_heading(index);
        if let Some(unit) = unit.filter(|unit| !suits(unit))
            && !matches!(part, Part::Other | Part::Direction | Part::Run)
        {
            strange = Some((index, unit));
        }
        match part {
            Part::Target => target = unit,
            Part::Position | Part::Deviation | Part::Of { .. } => measured = measured.or(unit),
            Part::Direction | Part::Run | Part::Other => {}
        }
    }
    if let Some((index, _)) = strange {
        let (kind, expected) = if case.reading.slides {
            ("an angle for a sliding joint", "a length")
        } else {
            ("a length for a joint that turns", "an angle")
        };
        case.refuse(format!("{}: {kind}", quoted(&headings[index])), expected);
        return None;
    }
    let in_preamble = grid.preamble.iter().find_map(|line| {
        let words = line.iter().flat_map(|cell| cell.split([' ', ':', '=']));
        let mut words = words.skip_while(|word| !word.to_lowercase().starts_with("unit"));
        words.next()?;
        words.take(3).find_map(|word| match units::word(word)? {
            Word::Unit(unit) => Some(unit),
            _ => None,
        })
    });
    let given = if case.reading.slides {
        case.reading.unit.map(LengthUnit::unit)
    } else {
        case.reading.angle_unit.map(AngleUnit::unit)
    };
    // What holds for the targets holds for the positions, but for deviations nothing follows.
    let default = given.or(in_preamble.filter(suits));
    let target_unit = target.or(default);
    let is_deviation = parts.contains(&Part::Deviation);
    let inherited = if is_deviation { None } else { target };
    let measured_unit = measured.or(default).or(inherited);
    let (Some(target), Some(measured)) = (target_unit, measured_unit) else {
        let (about, answers): (_, &[&str]) = if case.reading.slides {
            (About::Unit, &["mm", "m", "in"])
        } else {
            (About::AngleUnit, &["deg", "rad"])
        };
        let says = "the unit of the targets or of the positions is not said";
        case.ask(about, says, answers);
        return None;
    };
    let from = match default {
        Some(_) => "as was said",
        None => "from the headings",
    };
    from.clone_into(&mut case.found.unit);
    Some(Units { target, measured })
}

/// Reads every measured cell.
fn measurements(
    case: &mut Case<'_>,
    grid: &Grid<'_>,
    parts: &[Part],
    decimal: Decimal,
) -> Vec<Measurement> {
    let mut list = Vec::new();
    let mut complaints = Complaints::default();
    let mut empty = 0;
    let place = case.place.clone();
    grid.each_row(&place, &mut complaints, |row, complaints| {
        let cell = |index: usize| row.cells.get(index).map_or("", |cell| cell.as_ref());
        let mut wrong = |index: usize, expected: &str| {
            complaints.add(|| {
                let place = place.clone().at_line(row.line).at_column(index as u64 + 1);
                Diagnostic::error(place, quoted(cell(index)), expected)
            });
        };
        let (mut target, mut dir, mut run) = (None, 0.0, 1);
        for (index, part) in parts.iter().enumerate() {
            match part {
                Part::Target => match value(cell(index), decimal) {
                    Ok(number) => target = Some(number),
                    Err(_) => wrong(index, "the target as a number"),
                },
                Part::Direction => match direction(cell(index)) {
                    Some(number) => dir = number,
                    None => wrong(index, "+ or -, 1 or -1, forward or backward"),
                },
                Part::Run => match cell(index).parse() {
                    Ok(number) => run = number,
                    Err(_) => wrong(index, "the number of the run"),
                },
                _ => {}
            }
        }
        for (index, part) in parts.iter().enumerate() {
            let (run, dir) = match part {
                Part::Position | Part::Deviation => (run, dir),
                Part::Of { run, dir } => (*run, *dir),
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
                    "a number, or an empty cell where it was not measured",
                ),
            }
        }
    });
    complaints.into(&place, &mut case.found.findings);
    if empty > 0 {
        case.note(format!("{empty} cells are empty: not measured, left out"));
    }
    list
}

/// Whether deviations stand in the place of positions.
fn deviations(
    case: &mut Case<'_>,
    parts: &[Part],
    list: &[Measurement],
    units: Units,
) -> Option<bool> {
    if parts.contains(&Part::Deviation) {
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
    if travel == 0.0 || off <= 0.1 * travel {
        return Some(false);
    }
    if largest(&|measured, _| measured) <= 0.02 * travel {
        case.warn(
            "the measured values are far too small for positions: they are taken as deviations from the targets",
            "a heading with the word deviation, or positions",
        );
        return Some(true);
    }
    case.refuse(
        format!(
            "measured positions are up to {:.1} % of the travel away from their targets",
            100.0 * off / travel
        ),
        "positions near their targets, in the same unit, or deviations",
    );
    None
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

fn columns(case: &Case<'_>, list: &[Measurement], is_deviation: bool, units: Units) -> Columns {
    let joint = case.reading.joint;
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
        Column {
            name: "run".to_owned(),
            number: 0,
            role: Role::Kept,
            cells: Cells::Text(list.iter().map(|m| m.run.to_string()).collect()),
        },
    ];
    let dir = of(|m| m.dir);
    if dir.iter().any(|dir| *dir != 0.0) {
        columns.push(Column {
            name: format!("dir{}", joint + 1),
            number: 0,
            role: fixed(Quantity::Direction(joint), Unit::Fixed),
            cells: Cells::Numbers(dir),
        });
    }
    Columns {
        list: columns,
        lines,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_of_runs_name_run_and_direction() {
        let of = |run, dir| Part::Of { run, dir };
        for (heading, part) in [
            ("Run 1 +", of(1, 1.0)),
            ("Run 12 - [deg]", of(12, -1.0)),
            ("2↓", of(2, -1.0)),
            ("R3 fwd", of(3, 1.0)),
            ("run1-backward", of(1, -1.0)),
            ("+", of(0, 1.0)),
            ("Lauf 2 vor", of(2, 1.0)),
            ("Target [deg]", Part::Target),
            ("Position (°)", Part::Position),
            ("Deviation [arcsec]", Part::Deviation),
            ("Direction", Part::Direction),
            ("Cycle", Part::Run),
            ("Remark", Part::Other),
        ] {
            assert_eq!(part_of(heading), part, "{heading}");
        }
    }

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
