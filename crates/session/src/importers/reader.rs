//! One file being read: what is given, what was found out, and the cells of a table whose columns
//! are known.

use super::settings::ReadContext;
use crate::diagnostic::{Diagnostic, Place, Severity};
use crate::document::number::{NotANumber, quoted};
use crate::importers::columns::{COORDINATES, Column, Columns, below};
use crate::importers::matching::listed_names;
use crate::importers::options::{PLANE, SOCKET};
use crate::importers::role::{Role, has};
use crate::importers::settings::{About, ColumnGuess, Known, Question};
use crate::importers::times::{Kinds, extent};
use crate::importers::units::AngleUnit;
use crate::importers::{euler, headings, joint_names, units};
use crate::sessions::Lines;
use crate::sessions::columns::{BESIDE_POINTS, Quantity, Unit};
use crate::tables::decimals::{Decimal, value};
use crate::tables::{Cells, Names};
use crate::tables::{Complaints, Grid, Words};
use crate::text::{Template, Text};

/// Rows that are kept to be shown.
pub(crate) const SHOWN_ROWS: usize = 8;
/// The word for a column that is what its heading says.
const AUTO: &str = "auto";
/// Headings that a message lists.
pub(crate) const SHOWN_HEADINGS: usize = 12;
/// Names that are kept to be shown.
const SHOWN_NAMES: usize = 100;
/// What `--columns` takes.
const COLUMNS: Template =
    phrase!("name, group, -, auto, or a session's columns such as x, x_mm, q1_deg, time_s");

/// The words that tell the header of a table.
const WORDS: Words = Words {
    is_heading: |cell| !matches!(headings::understand(cell), Role::Kept),
    is_unit: |cell| units::word(cell).is_some(),
};

impl<'a> ReadContext<'a> {
    pub(crate) fn ask(&mut self, about: About, says: impl Into<Text>, answers: &[&str]) {
        let place = self.place.clone();
        self.found
            .questions
            .push(Question::new(about, place, says, answers));
    }

    pub(crate) fn note(&mut self, found: impl Into<Text>) {
        let place = self.place.clone();
        self.found.findings.push(Diagnostic::note(place, found));
    }

    pub(crate) fn warn(&mut self, found: impl Into<Text>, expected: impl Into<Text>) {
        let place = self.place.clone();
        self.found
            .findings
            .push(Diagnostic::warning(place, found, expected));
    }

    pub(crate) fn refuse(&mut self, found: impl Into<Text>, expected: impl Into<Text>) {
        let place = self.place.clone();
        self.found
            .findings
            .push(Diagnostic::error(place, found, expected));
    }

    /// Whether something stands in the way.
    pub(crate) fn is_open(&self) -> bool {
        let errors = |finding: &Diagnostic| finding.severity == Severity::Error;
        !self.found.questions.is_empty() || self.found.findings.iter().any(errors)
    }

    /// Whether nothing stands in the way, which a file without samples does.
    pub(crate) fn has_samples(&mut self) -> bool {
        if self.found.rows == 0 && !self.is_open() {
            self.refuse(text!("no sample"), text!("at least one"));
        }
        !self.is_open()
    }

    /// Finds the table and notes what it looks like.
    pub(crate) fn grid(&mut self) -> Option<Grid<'a>> {
        let (separator, header) = (self.reading.separator, self.reading.header);
        match Grid::find(self.text, separator, header, &WORDS, &self.place) {
            Ok(grid) => {
                self.found.separator = Some(grid.separator);
                self.found.preamble = grid.preamble.iter().map(|line| line.join(" ")).collect();
                self.found.header_line = grid.header.as_ref().map(|header| header.0);
                self.found.first_rows = grid.first_rows(SHOWN_ROWS);
                Some(grid.watched(self.part))
            }
            Err(error) => {
                self.found.findings.push(*error);
                None
            }
        }
    }

    /// The roles that the person gave, one for each column; `None` if there are none, or wrong ones.
    /// A column that is said to be what it was found to be is one of `found`, or what its heading
    /// says.
    pub(crate) fn given_roles(
        &mut self,
        grid: &Grid<'_>,
        found: Option<&[Role]>,
    ) -> Option<Vec<Role>> {
        let width = grid.width;
        let headings = grid.headings();
        let words = self.reading.columns.clone();
        if words.is_empty() {
            return None;
        }
        if words
            .iter()
            .all(|word| Role::from_word(word.trim()) == Some(Role::Left))
        {
            self.refuse(text!("--columns leaves every column out"), COLUMNS);
        }
        let open = words
            .iter()
            .zip(headings)
            .map(|(word, heading)| match word.trim() {
                AUTO => heading.clone(),
                _ => String::new(),
            });
        let by_heading = self.roles_of(grid, &open.collect::<Vec<String>>());
        let mut roles = Vec::new();
        for (index, word) in words.iter().enumerate() {
            let role = match word.trim() {
                AUTO => match found.and_then(|found| found.get(index)) {
                    Some(role) => Some(*role),
                    None => by_heading.get(index).copied().or(Some(Role::Kept)),
                },
                word => Role::from_word(word),
            };
            let Some(role) = role else {
                self.refuse(
                    text!("{word} among the columns given", word = quoted(word)),
                    COLUMNS,
                );
                return None;
            };
            roles.push(role);
        }
        if roles.len() > width {
            let found = text!(
                "{roles} columns given for a table of {width}",
                roles = roles.len(),
                width
            );
            self.refuse(
                found,
                text!("at most as many as the table has; - leaves one out"),
            );
            return None;
        }
        roles.resize(width, Role::Left);
        Some(roles)
    }

    /// Reads the cells of a table whose columns have these roles. `None` while something is asked
    /// or wrong.
    pub(crate) fn columns(&mut self, grid: &Grid<'a>, mut roles: Vec<Role>) -> Option<Columns> {
        let convention = self.ask_about_angles(&mut roles);
        let headings = grid.headings();
        let heading = |index: usize| heading_at(headings, index);
        let stamp = parts_of_a_stamp(&roles);
        let mut single = roles.clone();
        if let Some([_, nanoseconds]) = stamp {
            single[nanoseconds] = Role::Left;
        }
        self.ask_about_twins(&single, headings);
        let is_number = |index: usize| roles.get(index).is_some_and(|role| role.is_number());
        let decimal = self.decimal_sign(grid, &is_number);
        // While the sign is being asked for, a comma is good enough to know how far points spread.
        let mut reader = CellReader::new(&roles, decimal.unwrap_or(Decimal::Comma));
        let mut complaints = Complaints::default();
        let asked = !self.found.questions.is_empty();
        let all: Vec<usize> = (0..roles.len()).collect();
        if decimal.is_some() || asked {
            grid.each_row(&self.place, &mut complaints, |row, complaints| {
                reader.read(row, &all, headings, &self.place, complaints);
            });
        }
        // While the sign is asked for, what does not fit the one that is tried says nothing.
        if decimal.is_some() {
            complaints.into(&self.place, &mut self.found.findings);
        }
        let (mut cells, lines, times) = (reader.cells, reader.lines, reader.times);
        self.found.rows = lines.len();
        self.found.names = distinct(&roles, &cells);
        if let Some(stamp) = stamp {
            joined(stamp, &mut cells);
            roles = single;
        }
        self.settle_units(grid, &mut roles, &cells);
        self.settle_times(&mut roles, &mut cells, &times, headings);
        let words = &self.reading.columns;
        self.found.columns = roles
            .iter()
            .enumerate()
            .map(|(index, role)| ColumnGuess {
                heading: heading(index).to_owned(),
                meaning: role.to_string(),
                confidence: match words.get(index) {
                    Some(word) if word.trim() != AUTO => Known::Said,
                    None if !words.is_empty() => Known::Said,
                    _ if joint_names::is_one(heading(index), &self.reading.joints) => {
                        Known::Certain
                    }
                    _ => Known::by_heading(heading(index)),
                },
            })
            .collect();
        if !self.has_samples() {
            return None;
        }
        let list = roles
            .into_iter()
            .zip(cells)
            .enumerate()
            .filter_map(|(index, (role, cells))| {
                let name = match (heading(index), role.quantity()) {
                    ("", Some(quantity)) => quantity.heading(None),
                    ("", None) => role.to_string(),
                    (heading, _) => heading.to_owned(),
                };
                Some(Column {
                    name,
                    number: index as u64 + 1,
                    role,
                    cells: cells?,
                })
            })
            .collect();
        let mut columns = Columns {
            list,
            lines,
            ..Columns::default()
        };
        if let Some(convention) = convention {
            self.note(convention.describe());
            euler::to_quaternions(&mut columns, convention);
        }
        Some(columns)
    }

    /// Two columns for one quantity: only a person can say which is meant.
    fn ask_about_twins(&mut self, roles: &[Role], headings: &[String]) {
        let heading = |index: usize| heading_at(headings, index);
        for (index, role) in roles.iter().enumerate() {
            let same = |other: &Role| match role.quantity() {
                Some(quantity) => other.quantity() == Some(quantity),
                None => match (role, other) {
                    (Role::Turn(one, _), Role::Turn(other, _)) => one == other,
                    _ => *role == Role::Point && *other == Role::Point,
                },
            };
            if let Some(first) = roles[..index].iter().position(same) {
                let says = text!(
                    "columns {first} {first_heading} and {index} {heading} could both be {role}",
                    first = first + 1,
                    first_heading = quoted(heading(first)),
                    index = index + 1,
                    heading = quoted(heading(index)),
                    role = role.to_string()
                );
                self.ask(About::Columns, says, &[]);
                return;
            }
        }
    }

    /// Gives every quantity its unit, or asks for it.
    fn settle_units(&mut self, grid: &Grid<'_>, roles: &mut [Role], cells: &[Option<Cells>]) {
        let slides = |joint: usize| self.reading.joints.get(joint).is_some_and(|joint| joint.1);
        let position = |q: Quantity| match q {
            Quantity::X | Quantity::Y | Quantity::Z | Quantity::Distance => true,
            Quantity::Commanded(joint) | Quantity::ReadBack(joint) | Quantity::Speed(joint) => {
                slides(joint)
            }
            _ => false,
        };
        let comments = grid.comments.iter().map(std::slice::from_ref);
        let before: Vec<&[String]> = grid
            .preamble
            .iter()
            .map(Vec::as_slice)
            .chain(comments)
            .collect();
        let named = units::of_preamble(&before, |unit| matches!(unit, Unit::Length(_)));
        let mut spread: f64 = 0.0;
        let (mut lacks_length, mut lacks_angle, mut says_length) = (false, false, None);
        for (role, cells) in roles.iter().zip(cells) {
            match (role, cells) {
                (Role::Turn(_, None), Some(_)) => lacks_angle = true,
                (Role::Known(quantity, None), Some(Cells::Numbers(values))) => {
                    if position(*quantity) {
                        lacks_length = true;
                        // How far joints travel says nothing of where the points are.
                        if !matches!(
                            quantity,
                            Quantity::Commanded(_) | Quantity::ReadBack(_) | Quantity::Speed(_)
                        ) {
                            spread = spread.max(extent(values));
                        }
                    } else {
                        lacks_angle = true;
                    }
                }
                (Role::Known(quantity, Some(unit)), _) if position(*quantity) => {
                    says_length = Some(*unit);
                }
                _ => {}
            }
        }
        let given = self.reading.unit.map(|unit| (unit.unit(), unit.symbol()));
        let length = match (given, &named) {
            (Some((unit, symbol)), named) => {
                if let Some((text, other)) = named
                    && *other != unit
                {
                    self.another_unit(text, symbol);
                }
                self.found.unit = text!("{unit}, as stated", unit = symbol);
                Some(unit)
            }
            (None, Some((text, unit))) => {
                self.found.unit = text!("{unit}, from the lines before the table", unit = text);
                Some(*unit)
            }
            (None, None) => None,
        };
        if let Some(heading) = says_length {
            if let Some((unit, symbol)) = given
                && !lacks_length
                && unit != heading
            {
                self.another_unit(symbol, heading.suffix().unwrap_or_default());
            }
            self.found.unit = text!("from the headings");
        }
        if lacks_length && length.is_none() {
            let says = text!(
                "the unit of {roles} is not stated: {reach_mm}",
                roles = lengths_in_words(roles),
                reach_mm = units::hint(spread, self.reading.reach_mm)
            );
            self.ask(About::Unit, says, &["mm", "m", "in"]);
        } else if lacks_length && given.is_none() {
            self.note(text!("the unit is {unit}", unit = &self.found.unit));
        }
        let by_file = units::of_preamble(&before, |unit| matches!(unit, Unit::Angle(_)));
        let angle = self.reading.angle_unit.map(AngleUnit::unit);
        let angle = angle.or(by_file.map(|(_, unit)| unit));
        if lacks_angle && angle.is_none() {
            let says = text!("the unit of the angles is not stated");
            self.ask(About::AngleUnit, says, &["deg", "rad"]);
        }
        for role in roles {
            if let Role::Turn(_, unit @ None) = role {
                *unit = angle;
            }
            if let Role::Known(quantity, unit @ None) = role {
                *unit = if position(*quantity) { length } else { angle };
            }
        }
    }

    /// Warns that one of two units is used.
    pub(crate) fn another_unit(&mut self, other: &str, used: &str) {
        self.warn(
            text!("another unit is named: {unit}", unit = other),
            text!(
                "the same unit in the file and as stated; {unit} is used",
                unit = used
            ),
        );
    }

    /// Something measured has to be there: a coordinate, an orientation, or what another kind of
    /// measurement needs.
    pub(crate) fn require_position(&mut self, grid: &Grid<'_>, roles: &[Role]) -> bool {
        let mut any = COORDINATES.into_iter().chain(BESIDE_POINTS);
        let turns = roles.iter().any(|role| matches!(role, Role::Turn(..)));
        // All rows may belong to one socket, or touch one plane.
        let named = [SOCKET, PLANE]
            .iter()
            .any(|name| self.reading.options.contains_key(name));
        let is_there = turns || named || any.any(|wanted| has(roles, wanted));
        if !is_there {
            self.ask_for(grid, "x, y, z");
        }
        is_there
    }

    /// Asks which column is this.
    pub(crate) fn ask_for(&mut self, grid: &Grid<'_>, quantity: &str) {
        let says = match &grid.header {
            None => {
                text!(one "{count} column and no header", "{count} columns and no header", count = grid.width)
            }
            Some((_, names)) => {
                let names = names.iter().map(|name| quoted(name));
                text!(
                    "no column is {quantity} for certain among {names}",
                    quantity,
                    names = listed_names(names, SHOWN_HEADINGS)
                )
            }
        };
        self.ask(About::Columns, says, &[]);
    }
}

/// The columns of seconds and of nanoseconds that are one time (`stamp.sec` and `stamp.nanosec` of ROS).
fn parts_of_a_stamp(roles: &[Role]) -> Option<[usize; 2]> {
    let times = roles
        .iter()
        .enumerate()
        .filter_map(|(index, role)| match role {
            Role::Time(unit) => Some((index, *unit)),
            _ => None,
        });
    let mut times: Vec<(usize, Option<f64>)> = times.collect();
    times.sort_by(|a, b| b.1.partial_cmp(&a.1).unwrap_or(std::cmp::Ordering::Equal));
    match times.as_slice() {
        [(seconds, Some(1.0)), (nanoseconds, Some(1e-9))] => Some([*seconds, *nanoseconds]),
        _ => None,
    }
}

/// Adds what is in the second column, s, to the first.
fn joined([seconds, nanoseconds]: [usize; 2], cells: &mut [Option<Cells>]) {
    let parts = cells[nanoseconds].take();
    if let (Some(Cells::Numbers(whole)), Some(Cells::Numbers(parts))) = (&mut cells[seconds], parts)
    {
        for (time, part) in whole.iter_mut().zip(parts) {
            *time += part;
        }
    }
}

/// The lengths that a table has.
fn lengths_in_words(roles: &[Role]) -> Text {
    if has(roles, Quantity::Distance) && !has(roles, Quantity::X) {
        text!("the distances")
    } else {
        Text::verbatim("x, y, z")
    }
}

fn heading_at(headings: &[String], index: usize) -> &str {
    headings.get(index).map_or("", String::as_str)
}

/// Distinct names of points, in the order in which they come.
fn distinct(roles: &[Role], cells: &[Option<Cells>]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (role, cells) in roles.iter().zip(cells) {
        if let (Role::Point, Some(Cells::Text(cells))) = (role, cells) {
            for cell in cells {
                if names.len() >= SHOWN_NAMES {
                    break;
                }
                if !names.contains(cell) {
                    names.push(cell.clone());
                }
            }
        }
    }
    names
}

/// Reads cells by the roles of their columns.
pub(crate) struct CellReader<'a> {
    roles: &'a [Role],
    decimal: Decimal,
    pub(crate) cells: Vec<Option<Cells>>,
    times: Vec<Kinds>,
    pub(crate) lines: Lines,
}

impl<'a> CellReader<'a> {
    pub(crate) fn new(roles: &'a [Role], decimal: Decimal) -> Self {
        let empty = |role: &Role| match role {
            Role::Left => None,
            Role::Point | Role::Group | Role::Kept => Some(Cells::Text(Vec::new())),
            Role::Known(quantity, _) if quantity.is_named() => Some(Cells::Names(Names::default())),
            Role::Known(..) | Role::Time(_) | Role::Axis(_) | Role::Turn(..) => {
                Some(Cells::Numbers(Vec::new()))
            }
        };
        Self {
            roles,
            decimal,
            cells: roles.iter().map(empty).collect(),
            times: vec![Kinds::default(); roles.len()],
            lines: Lines::default(),
        }
    }

    /// Takes the cells of these columns, one for each role.
    pub(crate) fn read(
        &mut self,
        row: &crate::tables::TextRow<'_>,
        columns: &[usize],
        headings: &[String],
        file: &Place,
        complaints: &mut Complaints,
    ) {
        self.lines.add(row.line, 1);
        let all = self.roles.iter().zip(&mut self.cells).zip(&mut self.times);
        for (((role, cells), times), &index) in all.zip(columns) {
            let Some(cells) = cells else { continue };
            let cell = row.cells.get(index).map_or("", |cell| cell.as_ref());
            match cells {
                Cells::Text(list) => list.push(cell.to_owned()),
                Cells::Names(names) => names.push(cell),
                Cells::Numbers(values) => {
                    let read = if cell.is_empty() {
                        Ok(f64::NAN)
                    } else {
                        match *role {
                            Role::Time(unit) => times.read(cell, unit, self.decimal),
                            role => number(cell, role, self.decimal),
                        }
                    };
                    values.push(read.unwrap_or(f64::NAN));
                    if let Err(expected) = read {
                        complaints.add(|| {
                            let place = file.clone().at_line(row.line);
                            let place = place.at_column(index as u64 + 1);
                            let place = below(place, heading_at(headings, index));
                            Diagnostic::error(place, Text::verbatim(quoted(cell)), expected)
                        });
                    }
                }
            }
        }
    }
}

/// A number in a column of this role.
pub(crate) fn number(cell: &str, role: Role, decimal: Decimal) -> Result<f64, Template> {
    if let Role::Known(Quantity::Direction(_), _) = role {
        return direction(cell).ok_or(SIDES);
    }
    if let Role::Time(unit) = role {
        return Kinds::default().read(cell, unit, decimal);
    }
    value(cell, decimal).map_err(|why| match (why, decimal) {
        (NotANumber::Garbage, Decimal::Comma) => phrase!("a number with a decimal comma"),
        (why, _) => why.expected(),
    })
}

/// What a side of approach may be.
pub(crate) const SIDES: Template = phrase!("1, -1 or 0 (unknown), + or -, forward or backward");

/// The side from which a joint came, as people write it.
pub(crate) fn direction(text: &str) -> Option<f64> {
    let plain = text.trim().to_lowercase();
    match plain.as_str() {
        "+" | "+1" | "1" | "1.0" | "up" | "forward" | "fwd" | "f" | "positive" | "pos" | "cw+"
        | "↑" | "→" | "vor" | "vorwärts" | "auf" | "plus" => Some(1.0),
        "-" | "-1" | "-1.0" | "\u{2212}" | "\u{2212}1" | "\u{2013}" | "down" | "backward"
        | "back" | "bwd" | "b" | "reverse" | "rev" | "r" | "negative" | "neg" | "↓" | "←"
        | "zurück" | "rückwärts" | "ab" | "minus" => Some(-1.0),
        "0" | "0.0" | "?" => Some(0.0),
        _ => None,
    }
}

/// The unit of a table's quantity for a reader that knows it.
pub(crate) fn fixed(quantity: Quantity, unit: Unit) -> Role {
    Role::Known(quantity, Some(unit))
}
