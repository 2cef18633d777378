//! The CSV export of `OptiTrack` Motive, format 1.2x.
//!
//! A line of keys and values, a blank line, lines for type, name, ID (and parent) of what each
//! column belongs to, a line that says Rotation or Position, and then
//! `Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,…`. Quaternions are x, y, z, w; an empty cell is an
//! occlusion; y points upwards unless the export was told otherwise.

use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::importers::columns::{COORDINATES, Column, Columns};
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions};
use crate::importers::matching::listed_names;
use crate::importers::reader::{CellReader, SHOWN_HEADINGS, SHOWN_ROWS, fixed};
use crate::importers::role::Role;
use crate::importers::settings::{About, ColumnGuess, ReadContext, wrong_value};
use crate::importers::units::{self, LengthUnit, Word};
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::layout::no_column;
use crate::tables::decimals::{Decimal, Decision, Votes};
use crate::tables::{Cells, Names};
use crate::tables::{Complaints, MOST_COLUMNS, open_quote};
use crate::tables::{Dialect, Separator, TextRow, TextRows};
use crate::text::{Template, Text};

/// Cells of a row that are kept to be shown.
const SHOWN_CELLS: usize = 32;
/// Lines between the first one and that of the frames.
const MOST_HEADER_LINES: usize = 16;

const EXPORT: Template = phrase!(
    "an export of Motive with its header (Format Version, types, names, Position, Frame), in the coordinate space Global and with the rotation type Quaternion"
);

pub(crate) static IMPORTER: Importer = Importer {
    id: "optitrack",
    title: phrase!("OptiTrack Motive"),
    asks: Questions {
        table: false,
        columns: Meanings::Fixed,
        y_up: true,
        names: true,
        ..Questions::TABLE
    },
    options: &[],
    known_by: KnownBy::Text(is_likely),
    read,
};

/// Something that Motive tracks.
#[derive(Debug, Clone, PartialEq)]
struct Tracked {
    kind: String,
    name: String,
    /// Columns of x, y, z.
    position: [Option<usize>; 3],
    /// Columns of w, x, y, z.
    orientation: [Option<usize>; 4],
}

/// Whether a text starts as these files do.
fn is_likely(text: &str) -> bool {
    text.trim_start()
        .trim_start_matches('"')
        .starts_with("Format Version")
}

/// Reads what was tracked.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    // A spreadsheet may have saved it again, in the signs of its language.
    let first_line = context.text.trim_start().lines().next().unwrap_or_default();
    let separator = Separator::of_headings(first_line.as_bytes());
    context.found.separator = Some(separator);
    let mut rows = TextRows::new(context.text, Dialect::of_instruments(separator));
    let keys = key_line(context, &mut rows)?;
    let (tracked, frame_line) = header(context, &mut rows)?;
    context.found.header_line = Some(frame_line);
    let unit = unit(context, &keys);
    let chosen = choose(context, &tracked);
    let mut first_rows = rows.first(SHOWN_ROWS);
    for row in &mut first_rows {
        row.truncate(SHOWN_CELLS);
    }
    context.found.first_rows = first_rows;
    let mut votes = Votes::default();
    for (row, line) in context.found.first_rows.iter().zip(frame_line + 1..) {
        for (column, cell) in row.iter().enumerate() {
            votes.add(cell, line, column + 1);
        }
    }
    let decimal = match votes.decide() {
        Decision::Is(decimal) => decimal,
        _ if separator == Separator::Comma => Decimal::Point,
        _ => Decimal::Comma,
    };
    let decimal = context.reading.decimal.unwrap_or(decimal);
    context.found.decimal = Some(decimal);
    let with_orientation = rotation_is_quaternion(context, &keys);
    if value_of(&keys, "coordinate space")
        .is_some_and(|space| !space.eq_ignore_ascii_case("global"))
    {
        context.warn(
            text!("coordinates that are not in the global space"),
            EXPORT,
        );
    }
    let (Some(unit), Some(chosen)) = (unit, chosen) else {
        return None;
    };
    let columns = frames(context, rows, &chosen, with_orientation, unit);
    context.found.columns = ColumnGuess::certain(&columns).collect();
    context.has_samples().then_some(columns)
}

fn key_line(
    context: &mut ReadContext<'_>,
    rows: &mut TextRows<'_>,
) -> Option<Vec<(String, String)>> {
    let mut row = TextRow::default();
    if !(next(context, rows, &mut row)? && is_likely(&row.cells[0])) {
        let place = context.place.clone().at_line(row.line.max(1));
        let found = row.cells.first().map_or("", |cell| cell.as_ref());
        let found = Text::verbatim(quoted(found));
        let wrong = Diagnostic::error(place, found, EXPORT);
        context.found.findings.push(wrong);
        return None;
    }
    let pairs = row.cells.chunks(2).map(|pair| {
        let value = pair.get(1).map_or("", |value| value.as_ref());
        (pair[0].to_lowercase(), value.to_owned())
    });
    let pairs: Vec<(String, String)> = pairs.collect();
    context.found.preamble = pairs
        .iter()
        .map(|(key, value)| format!("{key}: {value}"))
        .collect();
    Some(pairs)
}

/// Reads the next row; `None`, and said, where a quote is open.
fn next<'t>(
    context: &mut ReadContext<'_>,
    rows: &mut TextRows<'t>,
    row: &mut TextRow<'t>,
) -> Option<bool> {
    let read = rows.next(row);
    read.map_err(|quote| {
        let wrong = open_quote(&context.place, quote);
        context.found.findings.push(wrong);
    })
    .ok()
}

fn value_of<'k>(keys: &'k [(String, String)], key: &str) -> Option<&'k str> {
    let found = keys.iter().find(|(other, _)| other == key)?;
    Some(found.1.as_str()).filter(|value| !value.is_empty())
}

/// The unit of length, by the file or by the person.
fn unit(context: &mut ReadContext<'_>, keys: &[(String, String)]) -> Option<Unit> {
    let named = value_of(keys, "length units");
    let by_file = named.and_then(units::word).and_then(|word| match word {
        Word::Unit(unit @ Unit::Length(_)) => Some(unit),
        _ => None,
    });
    let given = context.reading.unit;
    match (by_file, given) {
        (Some(unit), given) => {
            let unit_named = named.unwrap_or_default();
            context.found.unit =
                text!("{unit}, from the lines before the table", unit = unit_named);
            if given.is_some_and(|given| given.unit() != unit) {
                let stated = given.map_or("", LengthUnit::symbol);
                context.another_unit(stated, unit_named);
            }
            Some(unit)
        }
        (None, Some(given)) => {
            context.found.unit = text!("{unit}, as stated", unit = given.symbol());
            Some(given.unit())
        }
        (None, None) => {
            context.ask(
                About::Unit,
                text!("the first line has no Length Units"),
                &["mm", "m", "in"],
            );
            None
        }
    }
}

fn rotation_is_quaternion(context: &mut ReadContext<'_>, keys: &[(String, String)]) -> bool {
    let rotation = value_of(keys, "rotation type").unwrap_or("Quaternion");
    let is = rotation.eq_ignore_ascii_case("quaternion");
    if !is {
        let found = text!(
            "rotations as {rotation}: the orientation is excluded",
            rotation = quoted(rotation)
        );
        context.warn(found, EXPORT);
    }
    is
}

/// The lines down to that of the frames: what is tracked, in the order of the columns.
fn header(context: &mut ReadContext<'_>, rows: &mut TextRows<'_>) -> Option<(Vec<Tracked>, u64)> {
    let mut lines: Vec<Vec<String>> = Vec::new();
    let mut row = TextRow::default();
    let frame_line = loop {
        let is_there = next(context, rows, &mut row)?;
        if is_there && row.cells[0].eq_ignore_ascii_case("frame") {
            break row.line;
        }
        if !is_there || lines.len() == MOST_HEADER_LINES {
            context.refuse(text!("no line that starts with Frame"), EXPORT);
            return None;
        }
        lines.push(row.owned());
    };
    let axes: Vec<String> = row.cells.iter().map(|cell| cell.to_lowercase()).collect();
    if axes.len() > 64 * MOST_COLUMNS {
        let most = 64 * MOST_COLUMNS;
        context.refuse(
            text!(one "{count} column", "{count} columns", count = axes.len()),
            text!("a table of at most {most} columns", most),
        );
        return None;
    }
    // Newer exports name the lines; in older ones they are type, name, ID in this order.
    let labelled = |label: &str| {
        lines.iter().position(|line| {
            line.iter()
                .take(2)
                .any(|cell| cell.eq_ignore_ascii_case(label))
        })
    };
    let what = lines.len().saturating_sub(1);
    let names_line = labelled("name").or_else(|| (what >= 2).then_some(1));
    let kinds_line = labelled("type").or_else(|| (what >= 1).then_some(0));
    let cell = |line: Option<usize>, column: usize| {
        let line = line.and_then(|line| lines.get(line));
        line.and_then(|line| line.get(column))
            .map_or("", String::as_str)
    };
    let mut tracked: Vec<Tracked> = Vec::new();
    for (column, axis) in axes.iter().enumerate().skip(2) {
        let (kind, name) = (cell(kinds_line, column), cell(names_line, column));
        let is_same = |other: &Tracked| other.kind == kind && other.name == name;
        // The columns of one thing stand side by side.
        if !tracked.last().is_some_and(is_same) {
            tracked.push(Tracked {
                kind: kind.to_owned(),
                name: name.to_owned(),
                position: [None; 3],
                orientation: [None; 4],
            });
        }
        let Some(last) = tracked.last_mut() else {
            continue;
        };
        let place = ["x", "y", "z"].iter().position(|other| other == axis);
        match (
            cell(Some(what), column).to_lowercase().as_str(),
            place,
            axis.as_str(),
        ) {
            ("position", Some(place), _) => last.position[place] = Some(column),
            ("rotation", Some(place), _) => last.orientation[place + 1] = Some(column),
            ("rotation", None, "w") => last.orientation[0] = Some(column),
            _ => {}
        }
    }
    tracked.retain(|thing| thing.position.iter().all(Option::is_some));
    Some((tracked, frame_line))
}

/// Takes what the person named, or the only rigid body, or the only marker.
fn choose(context: &mut ReadContext<'_>, tracked: &[Tracked]) -> Option<Vec<Tracked>> {
    const SHOWN: usize = 100;
    let is_body = |thing: &&Tracked| thing.kind.eq_ignore_ascii_case("rigid body");
    let names: Vec<&str> = tracked.iter().map(|thing| thing.name.as_str()).collect();
    context.found.names = names
        .iter()
        .take(SHOWN)
        .map(|&name| name.to_owned())
        .collect();
    if !context.reading.names.is_empty() {
        let mut chosen = Vec::new();
        for name in &context.reading.names {
            let called = || tracked.iter().filter(|thing| thing.name == *name);
            // A body and its own marker may be called alike.
            if let Some(thing) = called().find(is_body).or_else(|| called().next()) {
                chosen.push(thing.clone());
            } else {
                let expected = text!("one of {names}", names = listed(&names));
                context.refuse(wrong_value("name", name), expected);
            }
        }
        return (chosen.len() == context.reading.names.len()).then_some(chosen);
    }
    let bodies: Vec<&Tracked> = tracked.iter().filter(is_body).collect();
    match (&bodies[..], tracked) {
        ([body], _) => Some(vec![(*body).clone()]),
        ([], [only]) => Some(vec![only.clone()]),
        (_, []) => {
            context.refuse(no_column("Position"), EXPORT);
            None
        }
        _ => {
            let says = text!(
                "several things are tracked: {names}",
                names = listed(&names)
            );
            let answers: Vec<&str> = names.iter().take(SHOWN).copied().collect();
            context.ask(About::Name, says, &answers);
            None
        }
    }
}

fn listed(names: &[&str]) -> Text {
    listed_names(names.iter().map(|name| quoted(name)), SHOWN_HEADINGS)
}

/// A row for each frame and each thing.
fn frames(
    context: &mut ReadContext<'_>,
    rows: TextRows<'_>,
    chosen: &[Tracked],
    with_orientation: bool,
    unit: Unit,
) -> Columns {
    let turned = |thing: &Tracked| thing.orientation.iter().all(Option::is_some);
    let with_orientation = with_orientation && chosen.iter().all(turned);
    let mut roles = COORDINATES.map(|quantity| fixed(quantity, unit)).to_vec();
    if with_orientation {
        roles.extend([0, 1, 2, 3].map(|part| fixed(Quantity::Orientation(part), Unit::Fixed)));
    }
    roles.extend([Role::Time(Some(1.0)), Role::Kept]);
    let places = chosen.iter().map(|thing| {
        let turn = thing.orientation.iter().filter(|_| with_orientation);
        let parts = thing.position.iter().chain(turn).flatten();
        parts.copied().chain([1, 0]).collect()
    });
    let places: Vec<Vec<usize>> = places.collect();
    let place = context.place.clone();
    let decimal = context.found.decimal.unwrap_or(Decimal::Point);
    let mut reader = CellReader::new(&roles, decimal);
    let mut complaints = Complaints::default();
    let mut names = Names::default();
    let mut rows = rows.in_pass_of(context.part);
    let mut row = TextRow::default();
    loop {
        match rows.next(&mut row) {
            Ok(true) => {}
            Ok(false) => break,
            Err(quote) => {
                complaints.findings.push(open_quote(&place, quote));
                break;
            }
        }
        for (thing, places) in chosen.iter().zip(&places) {
            names.push(&thing.name);
            reader.read(&row, places, &[], &place, &mut complaints);
        }
    }
    complaints.into(&place, &mut context.found.findings);
    let (lines, cells) = (reader.lines, reader.cells);
    let column = |(role, cells): (&Role, Option<Cells>)| {
        let name = match role {
            Role::Kept => "frame".to_owned(),
            role => role.to_string(),
        };
        Some(Column {
            name,
            number: 0,
            role: *role,
            cells: cells?,
        })
    };
    let mut columns = Columns {
        list: roles.iter().zip(cells).filter_map(column).collect(),
        lines,
        ..Columns::default()
    };
    if chosen.len() > 1 {
        columns.list.push(Column::named(Quantity::Target, names));
    }
    say_occluded(context, &columns, chosen);
    columns
}

fn say_occluded(context: &mut ReadContext<'_>, columns: &Columns, chosen: &[Tracked]) {
    let points = columns.places().unwrap_or_default();
    context.found.rows = points.len();
    for (first, thing) in chosen.iter().enumerate() {
        let own = (first..points.len()).step_by(chosen.len());
        let occluded = own.filter(|row| points[*row].iter().any(|v| v.is_nan()));
        let occluded: Vec<usize> = occluded.collect();
        if let [row, ..] = occluded[..] {
            let found = text!(
                "{thing} was occluded in {count} of {chosen} frames, first in line {line}: these have no position",
                thing = quoted(&thing.name),
                count = occluded.len(),
                chosen = points.len() / chosen.len(),
                line = columns.lines.get(row).unwrap_or(0)
            );
            context.warn(found, Text::default());
        }
    }
}
