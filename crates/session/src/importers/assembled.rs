//! The last step: columns become samples, by the code that reads sessions.

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Rejected, Severity};
use crate::importers::columns::{COORDINATES, Column, Columns};
use crate::importers::job::Job;
use crate::importers::role::Role;
use crate::sessions::columns::{Heading, Quantity, Unit};
use crate::sessions::files::assemble;
use crate::sessions::files::assemble::Declared;
use crate::sessions::layout::{Layout, REMARKS};
use crate::sessions::table::Table;
use crate::sessions::{Instrument, Session, Target, validation};
use crate::tables::Cells;

impl Job<'_> {
    /// A measured position of an axis becomes the point to which the nominal robot would carry the
    /// tool then: the radius is nominal, only the axis was measured.
    pub(crate) fn axis_to_points(&mut self, columns: &mut Columns) -> Result<(), Rejected> {
        let robot = self.settings.robot;
        let is_axis = |column: &Column| matches!(column.role, Role::Axis(_));
        let Some(at) = columns.list.iter().position(is_axis) else {
            return Ok(());
        };
        let column = columns.list.remove(at);
        let (Role::Axis(joint), Cells::Numbers(values)) = (column.role, column.cells) else {
            return Ok(());
        };
        if values.iter().any(|value| value.is_infinite()) {
            let found = text!("a number that overflows");
            return self.refuse(found, text!("a number that a double can hold"));
        }
        let mut q = vec![0.0; robot.joint_count()];
        let mut points: Vec<Point3<f64>> = Vec::new();
        let mut moved: f64 = 0.0;
        for value in &values {
            q[joint] = *value;
            let point = robot.point_in_base(&q, &Point3::origin());
            points.push(point);
            moved = moved.max((point - points[0]).norm());
        }
        if values.len() > 1 && moved < 1e-9 {
            return self.refuse(
                text!(
                    "the tool lies on the axis of joint {joint}: it does not move",
                    joint = joint + 1
                ),
                text!("a tool off the axis, in the robot"),
            );
        }
        columns.put_places(&points);
        let rows = columns.rows();
        for other in (0..robot.joint_count()).filter(|other| *other != joint) {
            let unit = Unit::inner(robot.joints[other].kind);
            let home = vec![0.0; rows];
            columns.put(Column::made(Quantity::Commanded(other), unit, home));
        }
        if robot.joint_count() > 1 {
            self.note(text!(
                "joints other than {joint} are taken to stand at home",
                joint = joint + 1
            ));
        }
        self.say(text!(
            "only the position of joint {joint} was measured: x, y, z are where the nominal robot carries its tool at that position, so that the radius is nominal",
            joint = joint + 1
        ));
        Ok(())
    }

    /// Makes the session.
    pub(crate) fn session(
        &mut self,
        mut columns: Columns,
        targets: Vec<Target>,
    ) -> Result<Session, Rejected> {
        self.check_joints(&columns, &self.place)?;
        if let Some(column) = columns.list.iter().find(|column| overflows(column)) {
            let place = self.place.clone().in_field(column.name.clone());
            return self.refuse_at(
                place,
                text!("a number that overflows"),
                text!("a number that a double can hold"),
            );
        }
        let references = self.references(&mut columns)?;
        complete_coordinates(&mut columns);
        let numbers: Vec<u64> = columns.list.iter().map(|column| column.number).collect();
        let table = table(columns, self.settings.robot.joint_count());
        let names = table.names.clone();
        let lines = table.line.clone();
        let place = self.place.clone();
        let locate = |column: usize, row: usize| {
            let place = match lines.get(row) {
                Some(line) => place.clone().at_line(line),
                None => place.clone(),
            };
            let place = match numbers.get(column) {
                Some(0) | None => place,
                Some(number) => place.at_column(*number),
            };
            place.in_field(names[column].as_str())
        };
        let mut findings = Vec::new();
        let declared = Declared {
            targets: &targets,
            references: &references,
        };
        let mut samples = assemble::samples(table, declared, &locate, &place, &mut findings);
        samples.follow(&self.settings.robot.joints);
        let is_error = |finding: &Diagnostic| finding.severity == Severity::Error;
        let mut session = Session {
            name: self.settings.name.clone(),
            note: self
                .sentences
                .iter()
                .map(|said| format!("{said}."))
                .collect::<Vec<_>>()
                .join("\n"),
            robot: self.settings.robot.clone(),
            targets,
            instrument: Instrument {
                references,
                ..Instrument::default()
            },
            tolerance_mm: None,
            regions: Vec::new(),
            compensated_by: None,
            samples,
            path: None,
        };
        if !findings.iter().any(is_error) {
            findings.extend(validation::findings(&session, &place));
        }
        if findings.iter().any(is_error) {
            return self.refused(findings);
        }
        self.findings.append(&mut findings);
        // The lines are those of the foreign file, not of the one that will be saved.
        session.samples.line = crate::sessions::Lines::default();
        Ok(session)
    }
}

/// A session with some coordinates only has empty columns for the others; x and y without z are a
/// planar session.
fn complete_coordinates(columns: &mut Columns) {
    let all = COORDINATES;
    let has = all.map(|quantity| columns.find(quantity).is_some());
    if matches!(has, [true, true, _] | [false, false, false]) {
        return;
    }
    let rows = columns.rows();
    for quantity in all {
        columns.put_missing(quantity, Unit::Length(1.0), || vec![f64::NAN; rows]);
    }
}

/// Whether a number became infinite on the way.
fn overflows(column: &Column) -> bool {
    matches!(&column.cells, Cells::Numbers(values) if values.iter().any(|value| value.is_infinite()))
}

/// The columns as a session's reader would have them.
fn table(columns: Columns, joints: usize) -> Table {
    let mut table = Table {
        layout: Layout {
            headings: Vec::new(),
            joints,
        },
        names: Vec::new(),
        columns: Vec::new(),
        line: columns.lines,
    };
    for column in columns.list {
        let (heading, cells) = match column.role {
            Role::Known(quantity, unit) => (
                Heading::Known(quantity, unit.unwrap_or(Unit::Fixed)),
                column.cells,
            ),
            Role::Time(_) => (Heading::Known(Quantity::Time, Unit::Fixed), column.cells),
            Role::Point | Role::Group | Role::Kept => match column.cells {
                Cells::Text(cells) => {
                    let cells = cells.into_iter().map(|cell| plain(cell, true)).collect();
                    (Heading::Unknown { hint: None }, Cells::Text(cells))
                }
                _ => continue,
            },
            Role::Left | Role::Axis(_) | Role::Turn(..) => continue,
        };
        let mut name = match column.role {
            Role::Point => REMARKS[0].to_owned(),
            Role::Group => REMARKS[1].to_owned(),
            _ => plain(column.name, false),
        };
        if matches!(heading, Heading::Unknown { .. }) {
            name = own_name(name, column.number, &table.names);
        }
        table.layout.headings.push(heading);
        table.names.push(name);
        table.columns.push(cells);
    }
    table
}

/// Text that a CSV file brings back as it is.
fn plain(text: String, with_line_feeds: bool) -> String {
    if !text.contains(|c: char| c.is_control()) {
        return text;
    }
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let keeps = |c: char| !c.is_control() || c == '\t' || (c == '\n' && with_line_feeds);
    text.chars()
        .map(|c| if keeps(c) { c } else { ' ' })
        .collect::<String>()
        .trim()
        .to_owned()
}

/// A heading that no other column has and that a session does not take for one of its own.
fn own_name(name: String, number: u64, others: &[String]) -> String {
    let base = match name.as_str() {
        "" | "-" => format!("column {number}"),
        _ => name,
    };
    let is_free = |name: &String| {
        !others.contains(name) && matches!(Heading::read(name), Heading::Unknown { .. })
    };
    if is_free(&base) {
        return base;
    }
    let numbered = (2..).map(|count: u32| format!("{base} ({count})"));
    numbered.into_iter().find(is_free).unwrap_or(base)
}
