//! The CSV export of `OptiTrack` Motive, format 1.2x.
//!
//! A line of keys and values, a blank line, lines for type, name, ID (and parent) of what each
//! column belongs to, a line that says Rotation or Position, and then
//! `Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,…`. Quaternions are x, y, z, w; an empty cell is an
//! occlusion; y points upwards unless the export was told otherwise.

use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns};
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions};
use crate::importers::matching::listed_names_up_to;
use crate::importers::reader::{fixed, number};
use crate::importers::role::Role;
use crate::importers::settings::{About, ColumnGuess, Known, ReadContext};
use crate::importers::units::{self, LengthUnit, Word};
use crate::sessions::Lines;
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::decimals::{Decimal, Decision, Votes};
use crate::tables::{Cells, Names};
use crate::tables::{Complaints, MOST_COLUMNS, open_quote};
use crate::tables::{Dialect, Separator, TextRow, TextRows};
use crate::text::{Template, Text};

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
        joint: false,
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
    context.found.first_rows = first_rows(&rows);
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
    let frames = frames(context, rows, &chosen, with_orientation);
    if context.found.rows == 0 && !context.is_open() {
        context.refuse(text!("no sample"), text!("at least one"));
    }
    let columns = frames.into_columns(&chosen, unit);
    context.found.columns = columns
        .list
        .iter()
        .map(|column| ColumnGuess {
            heading: column.name.clone(),
            meaning: column.role.to_string(),
            confidence: Known::Certain,
        })
        .collect();
    (!context.is_open()).then_some(columns)
}

fn key_line(
    context: &mut ReadContext<'_>,
    rows: &mut TextRows<'_>,
) -> Option<Vec<(String, String)>> {
    let mut row = TextRow::default();
    match rows.next(&mut row) {
        Ok(true) if is_likely(&row.cells[0]) => {}
        Ok(_) => {
            let place = context.place.clone().at_line(row.line.max(1));
            let found = row.cells.first().map_or("", |cell| cell.as_ref());
            context.found.findings.push(Diagnostic::error(
                place,
                Text::verbatim(quoted(found)),
                EXPORT,
            ));
            return None;
        }
        Err(quote) => {
            context
                .found
                .findings
                .push(open_quote(&context.place, quote));
            return None;
        }
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
        match rows.next(&mut row) {
            Ok(true) if row.cells[0].eq_ignore_ascii_case("frame") => break row.line,
            Ok(true) if lines.len() < MOST_HEADER_LINES => {
                lines.push(row.owned());
            }
            Err(quote) => {
                context
                    .found
                    .findings
                    .push(open_quote(&context.place, quote));
                return None;
            }
            Ok(_) => {
                context.refuse(text!("no line that starts with Frame"), EXPORT);
                return None;
            }
        }
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
            let mut called = tracked.iter().filter(|thing| thing.name == *name);
            // A body and its own marker may be called alike.
            let body = tracked
                .iter()
                .filter(is_body)
                .find(|thing| thing.name == *name);
            if let Some(thing) = body.or_else(|| called.next()) {
                chosen.push(thing.clone());
            } else {
                let found = text!("--{option}: {found}", option = "name", found = quoted(name));
                let expected = text!("one of {names}", names = listed(&names));
                context.refuse(found, expected);
            }
        }
        return (chosen.len() == context.reading.names.len()).then_some(chosen);
    }
    let bodies: Vec<&Tracked> = tracked.iter().filter(is_body).collect();
    match (&bodies[..], tracked) {
        ([body], _) => Some(vec![(*body).clone()]),
        ([], [only]) => Some(vec![only.clone()]),
        (_, []) => {
            context.refuse(text!("no column of positions"), EXPORT);
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
    const SHOWN: usize = 12;
    let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
    listed_names_up_to(&names, SHOWN)
}

fn first_rows(rows: &TextRows<'_>) -> Vec<Vec<String>> {
    const ROWS: usize = 8;
    const CELLS: usize = 32;
    let mut rows = rows.clone();
    let mut row = TextRow::default();
    let mut first = Vec::new();
    while first.len() < ROWS && rows.next(&mut row) == Ok(true) {
        let cells = row.cells.iter().take(CELLS).map(ToString::to_string);
        first.push(cells.collect());
    }
    first
}

/// The cells of the chosen columns: a row for each frame and each thing.
#[derive(Default)]
struct Frames {
    frame: Vec<String>,
    time_s: Vec<f64>,
    position: [Vec<f64>; 3],
    orientation: Option<[Vec<f64>; 4]>,
    names: Names,
    lines: Lines,
}

fn frames(
    context: &mut ReadContext<'_>,
    rows: TextRows<'_>,
    chosen: &[Tracked],
    with_orientation: bool,
) -> Frames {
    let turned = |thing: &Tracked| thing.orientation.iter().all(Option::is_some);
    let with_orientation = with_orientation && chosen.iter().all(turned);
    let mut frames = Frames {
        orientation: with_orientation.then(Default::default),
        ..Frames::default()
    };
    let mut complaints = Complaints::default();
    let mut occluded = vec![0usize; chosen.len()];
    let mut first_occluded = None;
    let place = context.place.clone();
    let decimal = context.found.decimal.unwrap_or(Decimal::Point);
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
        let line = row.line;
        let mut read = |column: usize, role: Role| {
            let cell = row.cells.get(column).map_or("", |cell| cell.as_ref());
            if cell.is_empty() {
                return f64::NAN;
            }
            number(cell, role, decimal).unwrap_or_else(|expected| {
                let place = place.clone().at_line(line).at_column(column as u64 + 1);
                complaints.add(|| Diagnostic::error(place, Text::verbatim(quoted(cell)), expected));
                f64::NAN
            })
        };
        let time = read(1, Role::Time(Some(1.0)));
        for (index, thing) in chosen.iter().enumerate() {
            frames.frame.push(row.cells[0].to_string());
            frames.time_s.push(time);
            frames.names.push(&thing.name);
            frames.lines.add(line, 1);
            let mut missing = false;
            for (values, column) in frames.position.iter_mut().zip(thing.position) {
                let value = column.map_or(f64::NAN, |at| read(at, fixed(Quantity::X, Unit::Fixed)));
                missing |= value.is_nan();
                values.push(value);
            }
            if let Some(parts) = &mut frames.orientation {
                for (values, column) in parts.iter_mut().zip(thing.orientation) {
                    let role = fixed(Quantity::Orientation(0), Unit::Fixed);
                    values.push(column.map_or(f64::NAN, |at| read(at, role)));
                }
            }
            if missing {
                occluded[index] += 1;
                first_occluded.get_or_insert(line);
            }
        }
    }
    context.found.rows = frames.frame.len();
    complaints.into(&place, &mut context.found.findings);
    for (thing, count) in chosen.iter().zip(occluded).filter(|(_, count)| *count > 0) {
        let found = text!(
            "{thing} was occluded in {count} of {chosen} frames, first in line {unwrap_or}: these have no position",
            thing = quoted(&thing.name),
            count,
            chosen = frames.frame.len() / chosen.len(),
            unwrap_or = first_occluded.unwrap_or(0)
        );
        context.warn(found, Text::default());
    }
    frames
}

impl Frames {
    fn into_columns(self, chosen: &[Tracked], unit: Unit) -> Columns {
        let numbers = |quantity, unit, values| Column::made(quantity, unit, values);
        let mut list = Vec::new();
        let coordinates = [Quantity::X, Quantity::Y, Quantity::Z];
        for (quantity, values) in coordinates.into_iter().zip(self.position) {
            list.push(numbers(quantity, unit, values));
        }
        if let Some(parts) = self.orientation {
            for (part, values) in parts.into_iter().enumerate() {
                list.push(numbers(Quantity::Orientation(part), Unit::Fixed, values));
            }
        }
        if chosen.len() > 1 {
            list.push(Column::named(Quantity::Target, self.names));
        }
        list.push(Column {
            role: Role::Time(Some(1.0)),
            ..numbers(Quantity::Time, Unit::Fixed, self.time_s)
        });
        list.push(Column {
            name: "frame".to_owned(),
            number: 1,
            role: Role::Kept,
            cells: Cells::Text(self.frame),
        });
        Columns {
            list,
            lines: self.lines,
            commands: None,
            directions: None,
        }
    }
}
