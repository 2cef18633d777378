//! Tables of targets: joint values (`q1_deg` …) or poses (`x_mm`, `y_mm`, `z_mm`, `qw`, `qx`, `qy`, `qz`), with
//! what else is known of each (`load_kg`, `temperature_c`, `dir1` …, `speed1_deg_s` …).
//!
//! Commas, semicolons or tabs between cells; with semicolons or tabs a decimal comma as well. Other
//! columns are left as they are. Rows of nothing but empty cells are no targets.

use std::ops::Range;

use crate::kinematics::JointKind;

use super::axes::Axes;
use super::number::{NoNumber, Number};
use super::pose::{Frame, Orientation};
use super::target::{Problem, Program, Remark, Shape, Target};
use super::text::Text;

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = Text::new(bytes);
    let Some(header) = text
        .lines()
        .find(|l| !text.bytes[l.clone()].trim_ascii().is_empty())
    else {
        return false;
    };
    let line = text.shown(header).to_lowercase();
    let mut names = line
        .split([',', ';', '\t'])
        .map(|n| n.trim().trim_matches('"'));
    names.any(|name| name.starts_with("q1_") || name == "x_mm" || name == "x_m")
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    /// A joint's value; rad or mm in one of its unit.
    Joint(usize, f64),
    /// x, y or z; mm in one of its unit.
    Position(usize, f64),
    /// qw, qx, qy or qz.
    Turn(usize),
    Load,
    Temperature,
    Direction(usize),
    /// rad/s or mm/s in one of its unit.
    Speed(usize, f64),
    Other,
}

struct Row {
    /// The cells without blanks and quotes.
    cells: Vec<Range<usize>>,
    line: Range<usize>,
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    let lines = text
        .lines()
        .filter(|l| !text.bytes[l.clone()].trim_ascii().is_empty());
    let mut lines = lines.peekable();
    let Some(first) = lines.peek() else {
        let expected = "a header, with q1_deg … or x_mm, y_mm, z_mm …";
        return Err(vec![Problem::new(0, "an empty table", expected)]);
    };
    let separator = separator(&text.bytes[first.clone()]);
    let mut problems = Vec::new();
    let mut rows = Vec::new();
    for line in lines {
        match cells(text, line, separator) {
            Ok(row) => rows.push(row),
            Err(problem) => problems.push(problem),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let header = rows.remove(0);
    let columns = header_columns(text, &header, axes).map_err(|problem| vec![problem])?;
    let table = Table {
        text,
        axes,
        columns,
        comma: separator != b',',
    };
    let mut program = table.layout(&header).map_err(|problem| vec![problem])?;
    for (k, row) in rows.iter().enumerate() {
        if row.cells.iter().all(Range::is_empty) {
            continue;
        }
        match table.target(k + 1, row) {
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

/// The separator that the header uses most.
fn separator(header: &[u8]) -> u8 {
    let count = |sign: u8| memchr::memchr_iter(sign, header).count();
    let mut best = b',';
    for sign in [b';', b'\t'] {
        if count(sign) > count(best) {
            best = sign;
        }
    }
    best
}

fn cells(text: &Text, line: Range<usize>, separator: u8) -> Result<Row, Problem> {
    let bytes = text.bytes;
    let mut cells = Vec::new();
    let mut at = line.start;
    loop {
        let start = at;
        let mut quoted = false;
        while at < line.end && (quoted || bytes[at] != separator) {
            if bytes[at] == b'"' {
                quoted = !quoted;
            }
            at += 1;
        }
        if quoted {
            return Err(Problem::new(
                start,
                "a cell that is not closed",
                "\" at its end",
            ));
        }
        cells.push(inside(bytes, start..at));
        if at >= line.end {
            return Ok(Row { cells, line });
        }
        at += 1;
    }
}

/// A cell without the blanks around it and its quotes.
fn inside(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let trimmed = |range: Range<usize>| {
        let cell = &bytes[range.clone()];
        let front = cell.len() - cell.trim_ascii_start().len();
        if front == cell.len() {
            return range.start..range.start;
        }
        range.start + front..range.start + front + cell.trim_ascii().len()
    };
    let range = trimmed(range);
    let quoted = range.len() >= 2 && bytes[range.start] == b'"' && bytes[range.end - 1] == b'"';
    if quoted {
        trimmed(range.start + 1..range.end - 1)
    } else {
        range
    }
}

fn header_columns(text: &Text, header: &Row, axes: &Axes) -> Result<Vec<Column>, Problem> {
    let mut columns: Vec<Column> = Vec::new();
    for cell in &header.cells {
        let name = text.shown(cell.clone());
        let column = column(&name, axes)
            .map_err(|(found, expected)| Problem::new(cell.start, found, expected))?;
        let same = |other: &Column| match (other, &column) {
            (Column::Joint(a, _), Column::Joint(b, _))
            | (Column::Position(a, _), Column::Position(b, _))
            | (Column::Speed(a, _), Column::Speed(b, _)) => a == b,
            (Column::Other, _) => false,
            (a, b) => *a == *b,
        };
        if columns.iter().any(same) {
            let found = format!("the column {name} a second time");
            return Err(Problem::new(cell.start, found, "every quantity once"));
        }
        columns.push(column);
    }
    Ok(columns)
}

/// What a heading means; an error says what was found and what was expected.
fn column(name: &str, axes: &Axes) -> Result<Column, (String, String)> {
    let joint_of = |digits: &str| -> Result<Option<usize>, (String, String)> {
        let Ok(number) = digits.parse::<usize>() else {
            return Ok(None);
        };
        if number == 0 || number > axes.joints() {
            let found = format!("the column {name}");
            return Err((found, format!("joints 1 to {}", axes.joints())));
        }
        Ok(Some(number - 1))
    };
    let length = |unit: &str| match unit {
        "mm" => Some(1.0),
        "m" => Some(1000.0),
        "um" => Some(1e-3),
        "in" => Some(25.4),
        _ => None,
    };
    let of_kind = |joint: usize, unit: &str| {
        let inner = match (axes.kind(joint), unit) {
            (JointKind::Revolute, "deg") => Some(crate::units::rad_from_deg(1.0)),
            (JointKind::Revolute, "rad") => Some(1.0),
            (JointKind::Prismatic, unit) => length(unit),
            _ => None,
        };
        let unit = axes.kind(joint).unit();
        inner.ok_or_else(|| {
            (
                format!("the column {name}"),
                format!("q{}_{unit}", joint + 1),
            )
        })
    };
    if let Some(axis) = ["x", "y", "z"].iter().position(|a| {
        name.strip_prefix(a)
            .and_then(|n| n.strip_prefix('_'))
            .is_some_and(|u| length(u).is_some())
    }) {
        let unit = length(&name[2..]).unwrap_or(1.0);
        return Ok(Column::Position(axis, unit));
    }
    if let Some(part) = ["qw", "qx", "qy", "qz"].iter().position(|q| *q == name) {
        return Ok(Column::Turn(part));
    }
    match name {
        "load_kg" => return Ok(Column::Load),
        "temperature_c" => return Ok(Column::Temperature),
        _ => {}
    }
    if let Some(joint) = name
        .strip_prefix("dir")
        .map(joint_of)
        .transpose()?
        .flatten()
    {
        return Ok(Column::Direction(joint));
    }
    if let Some((digits, unit)) = name.strip_prefix("speed").and_then(|n| n.split_once('_'))
        && let Some(joint) = joint_of(digits)?
    {
        let unit = unit.strip_suffix("_s").unwrap_or(unit);
        return Ok(Column::Speed(joint, of_kind(joint, unit)?));
    }
    if let Some((digits, unit)) = name.strip_prefix('q').and_then(|n| n.split_once('_'))
        && !unit.starts_with("read")
        && let Some(joint) = joint_of(digits)?
    {
        return Ok(Column::Joint(joint, of_kind(joint, unit)?));
    }
    Ok(Column::Other)
}

struct Table<'x> {
    text: &'x Text<'x>,
    axes: &'x Axes,
    columns: Vec<Column>,
    /// Whether a decimal comma is possible.
    comma: bool,
}

impl Table<'_> {
    fn of_joint(&self, joint: usize) -> Option<(usize, f64)> {
        self.columns.iter().enumerate().find_map(|(k, c)| match c {
            Column::Joint(j, inner) if *j == joint => Some((k, *inner)),
            _ => None,
        })
    }

    fn place(&self, wanted: impl Fn(&Column) -> bool) -> Option<usize> {
        self.columns.iter().position(wanted)
    }

    fn is_of_joints(&self) -> bool {
        self.columns.iter().any(|c| matches!(c, Column::Joint(..)))
    }

    /// Checks that the columns make targets, and says what they are.
    fn layout(&self, header: &Row) -> Result<Program, Problem> {
        let at = header.line.start;
        let mut program = Program::default();
        let has = |c: &Column| self.columns.contains(c);
        if self.is_of_joints() {
            for joint in 0..self.axes.joints() {
                if self.of_joint(joint).is_none() {
                    let name = format!("q{}_{}", joint + 1, self.axes.kind(joint).unit());
                    return Err(Problem::new(
                        at,
                        format!("no column {name}"),
                        "one for each joint",
                    ));
                }
            }
            if self.place(|c| matches!(c, Column::Position(..))).is_some() {
                program.notes.push(Remark {
                    at,
                    says: "the targets are the joint values; x, y, z are left as they are"
                        .to_owned(),
                });
            }
            return Ok(program);
        }
        for (axis, name) in ["x_mm", "y_mm", "z_mm"].iter().enumerate() {
            if self
                .place(|c| matches!(c, Column::Position(a, _) if *a == axis))
                .is_none()
            {
                let found = format!("no column {name}");
                let expected = "q1_deg, … or x_mm, y_mm, z_mm with qw, qx, qy, qz";
                return Err(Problem::new(at, found, expected));
            }
        }
        let turns = (0..4).filter(|k| has(&Column::Turn(*k))).count();
        if turns != 0 && turns != 4 {
            return Err(Problem::new(at, "an orientation in part", "qw, qx, qy, qz"));
        }
        if turns == 0 && self.axes.joints() > 3 {
            let found = "positions without qw, qx, qy, qz";
            return Err(Problem::new(
                at,
                found,
                "an orientation, for a robot with more than three joints",
            ));
        }
        Ok(program)
    }

    fn target(&self, number: usize, row: &Row) -> Result<Target, Problem> {
        if row.cells.len() != self.columns.len() {
            let found = format!("{} cells", row.cells.len());
            let expected = format!("{}, as in the heading", self.columns.len());
            return Err(Problem::new(row.line.start, found, expected));
        }
        let number_at = |k: usize| self.number(row.cells[k].clone());
        let shape = if self.is_of_joints() {
            let mut numbers = Vec::new();
            let mut inner = Vec::new();
            for joint in 0..self.axes.joints() {
                if let Some((k, unit)) = self.of_joint(joint) {
                    numbers.push(number_at(k)?);
                    inner.push(unit);
                }
            }
            // 10⁻⁷ rad is 10⁻⁴ mm at a metre.
            let degrees = inner.iter().all(|unit| (*unit - 1.0).abs() > 0.5);
            Shape::Joints {
                numbers,
                inner,
                decimals: if degrees { 6 } else { 7 },
            }
        } else {
            Shape::Pose(self.pose(row)?)
        };
        let mut target = Target::new(format!("row {number}"), row.line.start, shape);
        let joints = self.axes.joints();
        target.circumstances.dir = vec![None; joints];
        target.circumstances.speed = vec![None; joints];
        for (k, column) in self.columns.iter().enumerate() {
            if row.cells[k].is_empty() {
                continue;
            }
            let circumstances = &mut target.circumstances;
            match column {
                Column::Load => circumstances.load_kg = Some(number_at(k)?.value),
                Column::Temperature => circumstances.temperature_c = Some(number_at(k)?.value),
                Column::Speed(joint, unit) => {
                    circumstances.speed[*joint] = Some(number_at(k)?.value * unit);
                }
                Column::Direction(joint) => {
                    let value = number_at(k)?;
                    if ![-1.0, 0.0, 1.0].contains(&value.value) {
                        let found = format!("dir{} {}", joint + 1, value.value);
                        return Err(Problem::new(value.range.start, found, "1, -1 or 0"));
                    }
                    // 0: not stated, so that it follows from the target before.
                    circumstances.dir[*joint] = (value.value != 0.0).then_some(value.value);
                }
                _ => {}
            }
        }
        Ok(target)
    }

    fn pose(&self, row: &Row) -> Result<Frame, Problem> {
        let mut position = Vec::new();
        let mut mm = [1.0; 3];
        for (axis, mm) in mm.iter_mut().enumerate() {
            for (k, column) in self.columns.iter().enumerate() {
                if let Column::Position(a, unit) = column
                    && *a == axis
                {
                    position.push(self.number(row.cells[k].clone())?);
                    *mm = *unit;
                }
            }
        }
        let mut turn = Vec::new();
        for part in 0..4 {
            if let Some(k) = self.place(|c| *c == Column::Turn(part)) {
                turn.push(self.number(row.cells[k].clone())?);
            }
        }
        let orientation = if turn.is_empty() {
            Orientation::Free
        } else {
            Orientation::Quaternion
        };
        let frame = Frame {
            position: [0, 1, 2].map(|k: usize| position[k].clone()),
            mm,
            turn,
            orientation,
        };
        if frame.goal().is_none() {
            let at = frame.turn.first().map_or(row.line.start, |n| n.range.start);
            return Err(Problem::new(
                at,
                "a quaternion of no length",
                "an orientation",
            ));
        }
        Ok(frame)
    }

    fn number(&self, range: Range<usize>) -> Result<Number, Problem> {
        let bytes = self.text.bytes;
        let has_comma = self.comma && bytes[range.clone()].contains(&b',');
        let problem = |reason: NoNumber| {
            let shown = self.text.shown(range.clone());
            let found = if shown.is_empty() {
                "an empty cell".to_owned()
            } else {
                format!("'{shown}'")
            };
            let expected = match reason {
                NoNumber::Malformed => "a number",
                NoNumber::TooLarge => "a number that is not larger than any machine",
            };
            Problem::new(range.start, found, expected)
        };
        Number::read(bytes, range.clone(), has_comma).map_err(problem)
    }
}
