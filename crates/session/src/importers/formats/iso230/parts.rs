//! What the columns of such a table are.

use crate::document::number::quoted;
use crate::importers::headings::{Words, is_among, words_and_unit};
use crate::importers::reader::direction;
use crate::importers::settings::{About, ReadContext};
use crate::tables::Grid;

/// One measurement, in the order of the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measurement {
    pub(super) run: u64,
    /// Side from which the target was approached: +1, −1, 0 unknown.
    pub(super) dir: f64,
    pub(super) target: f64,
    /// Position, or deviation from the target.
    pub(super) measured: f64,
    pub(super) line: u64,
}

/// What a column of the table is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TableColumn {
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

/// The headings; a second line of headings above is joined in: runs above directions.
pub(super) fn headings(grid: &Grid<'_>) -> Vec<String> {
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

/// The words for the columns of a long table, and of a wide one.
const LONG: &str = "target,direction,run,position";
const WIDE: &str = "target,\"run 1 +\",\"run 1 -\"";

/// What each column is.
pub(super) fn parts(
    context: &mut ReadContext<'_>,
    grid: &Grid<'_>,
    headings: &[String],
) -> Option<Vec<TableColumn>> {
    let given = &context.reading.columns;
    let parts: Vec<TableColumn> = if !given.is_empty() {
        let mut parts: Vec<TableColumn> = given.iter().map(|word| part_of(word)).collect();
        parts.resize(grid.width, TableColumn::Other);
        parts
    } else if grid.header.is_some() {
        let mut seen: Vec<f64> = Vec::new();
        let mut parts: Vec<TableColumn> = headings.iter().map(|heading| part_of(heading)).collect();
        // Without a number the columns of one direction are counted.
        for part in &mut parts {
            if let TableColumn::Of { run, dir } = part {
                seen.push(*dir);
                if *run == 0 {
                    *run = seen.iter().filter(|other| *other == dir).count() as u64;
                }
            }
        }
        parts
    } else if grid.width == 4 {
        context.note(text!(
            "no header: the columns are taken as {words}",
            words = LONG.replace(',', ", ")
        ));
        LONG.split(',').map(part_of).collect()
    } else {
        let says = text!(one "{count} column and no header", "{count} columns and no header", count = grid.width);
        context.ask(About::Columns, says, &[LONG, WIDE]);
        return None;
    };
    let count = |wanted: fn(&TableColumn) -> bool| parts.iter().filter(|part| wanted(part)).count();
    let targets = count(|part| *part == TableColumn::Target);
    let long = count(|part| matches!(part, TableColumn::Position | TableColumn::Deviation));
    let wide = count(|part| matches!(part, TableColumn::Of { .. }));
    if targets != 1 || (long == 0 && wide == 0) || long > 1 || (long > 0 && wide > 0) {
        let names: Vec<String> = headings.iter().map(|heading| quoted(heading)).collect();
        let says = text!(
            "{targets} columns of targets and {wide} of positions among {names}",
            targets,
            wide = long + wide,
            names = names.join(", ")
        );
        let long = match grid.width {
            2 => "target,position",
            _ => LONG,
        };
        context.ask(About::Columns, says, &[long, WIDE]);
        return None;
    }
    Some(parts)
}

fn part_of(heading: &str) -> TableColumn {
    let plain = heading.trim().to_lowercase();
    let (words, _) = words_and_unit(&plain);
    let has = |list: Words| words.iter().any(|word| is_among(word, list));
    // A heading of one run says its number, its direction, or both.
    if let Some(dir) = direction_in(&plain) {
        let digits: String = plain
            .chars()
            .skip_while(|c| !c.is_ascii_digit())
            .take_while(char::is_ascii_digit)
            .take(6)
            .collect();
        return TableColumn::Of {
            run: digits.parse().unwrap_or(0),
            dir,
        };
    }
    if has("deviation dev error err abweichung fehler") {
        TableColumn::Deviation
    } else if has("direction dir richtung approach") {
        TableColumn::Direction
    } else if has("run cycle lauf zyklus repeat") {
        TableColumn::Run
    } else if has(TARGET) {
        TableColumn::Target
    } else if has(POSITION) {
        TableColumn::Position
    } else {
        TableColumn::Other
    }
}

/// Words for where the axis was sent.
const TARGET: Words = "target nominal soll sollposition sollwert commanded command cmd desired demand demanded setpoint set";
/// Words for where it was measured. A reference is either, and is asked for.
const POSITION: Words =
    "position actual act measured meas measurement ist istposition istwert reading read encoder";

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_of_runs_name_run_and_direction() {
        let of = |run, dir| TableColumn::Of { run, dir };
        for (heading, part) in [
            ("Run 1 +", of(1, 1.0)),
            ("Run 12 - [deg]", of(12, -1.0)),
            ("2↓", of(2, -1.0)),
            ("R3 fwd", of(3, 1.0)),
            ("run1-backward", of(1, -1.0)),
            ("+", of(0, 1.0)),
            ("Lauf 2 vor", of(2, 1.0)),
            ("Target [deg]", TableColumn::Target),
            ("Position (°)", TableColumn::Position),
            ("desired", TableColumn::Target),
            ("theta_cmd", TableColumn::Target),
            ("angle_set", TableColumn::Target),
            ("Pan encoder", TableColumn::Position),
            ("ref_angle", TableColumn::Other),
            ("Deviation [arcsec]", TableColumn::Deviation),
            ("Direction", TableColumn::Direction),
            ("Cycle", TableColumn::Run),
            ("Remark", TableColumn::Other),
        ] {
            assert_eq!(part_of(heading), part, "{heading}");
        }
    }
}
