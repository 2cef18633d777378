//! Tables of targets: joint values (`q1_deg` …) or poses (`x_mm`, `y_mm`, `z_mm`, `qw`, `qx`, `qy`, `qz`), with
//! what else is known of each (`load_kg`, `temperature_c`, `dir1` …, `speed1_deg_s` …).
//!
//! Commas, semicolons or tabs between cells; with semicolons or tabs a decimal comma as well. Other
//! columns are left as they are. Rows of nothing but empty cells are no targets.

use crate::text::Template;
use std::ops::Range;
use std::sync::Arc;

use crate::kinematics::JointKind;
use crate::sessions::columns::{Heading, Quantity, Unit};

use super::axes::Axes;
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::program::Program;
use super::target::{Circumstances, Problem, Remark, Shape, Target};
use super::text::Text;
use crate::tables::{Cell, Dialect, OpenQuote, Row, Rows, Separator, trimmed};

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = Text::new(bytes);
    let Some(header) = first_line(&text) else {
        return false;
    };
    let line = text.shown(header).to_lowercase();
    let mut names = line
        .split([',', ';', '\t'])
        .map(|n| n.trim().trim_matches('"'));
    names.any(|name| name.starts_with("q1_") || name == "x_mm" || name == "x_m")
}

/// The first line that is not blank.
fn first_line(text: &Text) -> Option<Range<usize>> {
    let is_blank = |line: &Range<usize>| text.bytes[line.clone()].trim_ascii().is_empty();
    text.lines().find(|line| !is_blank(line))
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    let Some(first) = first_line(text) else {
        let expected = text!("a header, with q1_deg … or x_mm, y_mm, z_mm …");
        return Err(vec![Problem::new(0, text!("an empty table"), expected)]);
    };
    let separator = Separator::of_headings(&text.bytes[first]);
    let mut rows = Rows::new(text.bytes, text.start(), Dialect::of_lines(separator));
    let mut row = Row::default();
    rows.next(&mut row)
        .map_err(|quote| vec![not_closed(quote)])?;
    let header = row.number;
    let columns = header_columns(text, &row, axes).map_err(|problem| vec![problem])?;
    let mut table = Table {
        text,
        axes,
        columns,
        joints: Vec::new(),
        scales: Arc::default(),
        comma: separator != Separator::Comma,
    };
    let joints = (0..axes.joints()).filter_map(|joint| table.of(Quantity::Commanded(joint)));
    let (joints, inner): (Vec<usize>, Vec<f64>) = joints.unzip();
    (table.joints, table.scales) = (joints, inner.into());
    let mut program = table.layout(row.start).map_err(|problem| vec![problem])?;
    let mut problems = Vec::new();
    // A large table has hundreds of thousands: room for each, and row by row.
    program.targets.reserve_exact(text.lines().len());
    loop {
        match rows.next(&mut row) {
            Ok(true) => {}
            Ok(false) => break,
            Err(quote) => {
                problems.push(not_closed(quote));
                continue;
            }
        }
        match table.target(row.number - header, &row) {
            Ok(target) => program.targets.push(target),
            Err(problem) => problems.push(problem),
        }
    }
    program.visits = (0..program.targets.len()).collect();
    if problems.is_empty() {
        Ok(program)
    } else {
        Err(problems)
    }
}

fn not_closed(quote: OpenQuote) -> Problem {
    let found = text!("a quote that is not closed");
    Problem::new(quote.at, found, text!("a closing quote"))
}

/// What each column holds, and how many inner units (mm, rad) one of its is; `None`: left as it is.
type Columns = Vec<Option<(Quantity, f64)>>;

fn header_columns(text: &Text, header: &Row, axes: &Axes) -> Result<Columns, Problem> {
    let mut columns: Columns = Vec::new();
    for cell in &header.cells {
        let cell = content(text, *cell);
        let name = text.shown(cell.clone());
        let column = column(&name, axes).map_err(|expected| {
            Problem::new(
                cell.start,
                text!("the column {name}", name = &name),
                expected,
            )
        })?;
        let same = |other: &Option<(Quantity, f64)>| {
            other.zip(column).is_some_and(|((a, _), (b, _))| a == b)
        };
        if columns.iter().any(same) {
            let found = text!("{name} a second time", name = &name);
            return Err(Problem::new(cell.start, found, text!("each once")));
        }
        columns.push(column);
    }
    Ok(columns)
}

/// Where the content of a cell is, without the blanks around it; those in quotes are none of it here. Something behind
/// its closing quote makes it one with its quotes.
fn content(text: &Text, cell: Cell) -> Range<usize> {
    let behind = cell.behind_quote(text.bytes);
    if behind.is_empty() {
        trimmed(text.bytes, cell.start..cell.end)
    } else {
        cell.start - 1..behind.end
    }
}

/// What a heading means; an error says what was expected.
fn column(name: &str, axes: &Axes) -> Result<Option<(Quantity, f64)>, crate::text::Text> {
    let (quantity, unit) = match Heading::read(name) {
        Heading::Known(quantity, unit) => (quantity, unit),
        // A slip in the name of a joint value would leave a target as it is.
        Heading::Unknown { hint: Some(hint) } if name.starts_with('q') => {
            return Err(crate::text::Text::verbatim(hint));
        }
        Heading::Unknown { .. } => return Ok(None),
    };
    let joint = match quantity {
        Quantity::Commanded(joint) | Quantity::Speed(joint) | Quantity::Direction(joint) => joint,
        Quantity::X | Quantity::Y | Quantity::Z | Quantity::Orientation(_) => {
            return Ok(Some((quantity, unit.factor())));
        }
        Quantity::Load | Quantity::Temperature => return Ok(Some((quantity, 1.0))),
        _ => return Ok(None),
    };
    if joint >= axes.joints() {
        return Err(text!("joints 1 to {joints}", joints = axes.joints()));
    }
    let fits = match unit {
        Unit::Angle(_) => axes.kind(joint) == JointKind::Revolute,
        Unit::Length(_) => axes.kind(joint) == JointKind::Prismatic,
        Unit::Fixed => true,
    };
    if fits {
        Ok(Some((quantity, unit.factor())))
    } else {
        Err(text!(
            "q{joint}_{unit}",
            joint = joint + 1,
            unit = axes.kind(joint).unit()
        ))
    }
}

struct Table<'x> {
    text: &'x Text<'x>,
    axes: &'x Axes,
    columns: Columns,
    /// The columns of the joint values, in the order of the joints, and rad or mm in one of their units.
    joints: Vec<usize>,
    scales: Arc<[f64]>,
    /// Whether a decimal comma is possible.
    comma: bool,
}

const POSITION: [Quantity; 3] = [Quantity::X, Quantity::Y, Quantity::Z];

impl Table<'_> {
    /// The column of a quantity and its unit.
    fn of(&self, quantity: Quantity) -> Option<(usize, f64)> {
        let mut columns = self.columns.iter().enumerate();
        columns.find_map(|(k, column)| column.filter(|c| c.0 == quantity).map(|c| (k, c.1)))
    }

    fn is_of_joints(&self) -> bool {
        (0..self.axes.joints()).any(|j| self.of(Quantity::Commanded(j)).is_some())
    }

    /// Checks that the columns make targets, and says what they are.
    fn layout(&self, at: usize) -> Result<Program, Problem> {
        let wrong =
            |found: crate::text::Text, expected: Template| Err(Problem::new(at, found, expected));
        let mut program = Program::default();
        let places = POSITION.map(|quantity| self.of(quantity));
        if self.is_of_joints() {
            for joint in 0..self.axes.joints() {
                if self.of(Quantity::Commanded(joint)).is_none() {
                    let name = format!("q{}_{}", joint + 1, self.axes.kind(joint).unit());
                    return wrong(
                        text!("no column {name}", name),
                        phrase!("one for each joint"),
                    );
                }
            }
            if places.iter().any(Option::is_some) {
                program.notes.push(Remark {
                    at,
                    text: text!("the targets are the joint values; x, y, z are left as they are"),
                });
            }
            return Ok(program);
        }
        for (place, name) in places.iter().zip(["x_mm", "y_mm", "z_mm"]) {
            if place.is_none() {
                let expected = phrase!("q1_deg, … or x_mm, y_mm, z_mm with qw, qx, qy, qz");
                return wrong(text!("no column {name}", name), expected);
            }
        }
        let turns = (0..4).filter(|k| self.of(Quantity::Orientation(*k)).is_some());
        match turns.count() {
            4 => Ok(program),
            0 if self.axes.joints() <= 3 => Ok(program),
            0 => wrong(
                text!("positions without qw, qx, qy, qz"),
                phrase!("an orientation, for a robot with more than three joints"),
            ),
            _ => wrong(text!("an orientation in part"), phrase!("qw, qx, qy, qz")),
        }
    }

    fn target(&self, number: usize, row: &Row) -> Result<Target, Problem> {
        if row.cells.len() != self.columns.len() {
            let found = text!(one "{count} cell", "{count} cells", count = row.cells.len());
            let expected = text!("{columns}, as in the heading", columns = self.columns.len());
            return Err(Problem::new(row.start, found, expected));
        }
        let number_at = |k: usize| self.number(content(self.text, row.cells[k]));
        let shape = if self.is_of_joints() {
            // No larger than needed, as collecting results would make it.
            let mut numbers = Vec::with_capacity(self.joints.len());
            for k in &self.joints {
                numbers.push(number_at(*k)?);
            }
            // 10⁻⁷ rad is 10⁻⁴ mm at a metre.
            let degrees = self.scales.iter().all(|unit| (*unit - 1.0).abs() > 0.5);
            Shape::Joints {
                numbers,
                scales: Arc::clone(&self.scales),
                decimals: if degrees { 6 } else { 7 },
            }
        } else {
            Shape::Pose(Box::new(self.pose(row)?))
        };
        let mut circumstances = Circumstances::default();
        let joints = self.axes.joints();
        // Only where there are such columns: a large table has hundreds of thousands of rows.
        let mut known = self.columns.iter().flatten().map(|(quantity, _)| *quantity);
        if known.clone().any(|q| matches!(q, Quantity::Direction(_))) {
            circumstances.dir = vec![None; joints];
        }
        if known.any(|q| matches!(q, Quantity::Speed(_))) {
            circumstances.speed = vec![None; joints];
        }
        for (k, column) in self.columns.iter().enumerate() {
            let Some((quantity, unit)) = *column else {
                continue;
            };
            if content(self.text, row.cells[k]).is_empty() {
                continue;
            }
            match quantity {
                Quantity::Load => circumstances.load_kg = Some(number_at(k)?.value),
                Quantity::Temperature => circumstances.temperature_c = Some(number_at(k)?.value),
                Quantity::Speed(joint) => {
                    circumstances.speed[joint] = Some(number_at(k)?.value * unit);
                }
                Quantity::Direction(joint) => {
                    let value = number_at(k)?;
                    if ![-1.0, 0.0, 1.0].contains(&value.value) {
                        let found =
                            text!("dir{joint} {value}", joint = joint + 1, value = value.value);
                        return Err(Problem::new(
                            value.range().start,
                            found,
                            text!("1, -1 or 0 (unknown)"),
                        ));
                    }
                    // 0: not stated, so that it follows from the target before.
                    circumstances.dir[joint] = (value.value != 0.0).then_some(value.value);
                }
                _ => {}
            }
        }
        let mut target = Target::new(format!("row {number}"), row.start, shape);
        target.set_circumstances(circumstances);
        Ok(target)
    }

    fn pose(&self, row: &Row) -> Result<Frame, Problem> {
        let number = |quantity: Quantity| -> Result<Option<(Number, f64)>, Problem> {
            let place = self.of(quantity);
            place
                .map(|(k, unit)| Ok((self.number(content(self.text, row.cells[k]))?, unit)))
                .transpose()
        };
        let (mut position, mut turn) = (Vec::new(), Vec::new());
        for quantity in POSITION {
            position.extend(number(quantity)?);
        }
        for part in 0..4 {
            turn.extend(number(Quantity::Orientation(part))?.map(|(number, _)| number));
        }
        let orientation = if turn.is_empty() {
            Orientation::Free
        } else {
            Orientation::Quaternion
        };
        let frame = Frame {
            position: [0, 1, 2].map(|k: usize| position[k].0),
            mm: [0, 1, 2].map(|k: usize| position[k].1),
            turn,
            orientation,
        };
        if frame.goal().is_none() {
            let at = frame.turn.first().map_or(row.start, |n| n.range().start);
            let found = text!("zero length");
            return Err(Problem::new(at, found, text!("an orientation")));
        }
        Ok(frame)
    }

    fn number(&self, range: Range<usize>) -> Result<Number, Problem> {
        let bytes = self.text.bytes;
        let has_comma = self.comma && bytes[range.clone()].contains(&b',');
        let problem = |expected| {
            let shown = self.text.shown(range.clone());
            let found = if shown.is_empty() {
                text!("an empty cell")
            } else {
                crate::text::Text::verbatim(format!("'{shown}'"))
            };
            Problem::new(range.start, found, expected)
        };
        Number::read(bytes, range.clone(), has_comma).map_err(problem)
    }
}
