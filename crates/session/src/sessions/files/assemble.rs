//! From the cells of a table to samples in inner units.
//!
//! Here a cell gets its meaning: units become mm and rad, names become indices, and what a number
//! cannot be (a direction of 2, a target that is not declared) is said with its place.

use crate::text::Text;
use std::collections::BTreeMap;

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::quoted;
use crate::document::ranges::short;
use crate::kinematics::Joint;
use crate::progress::ProgressSpan;
use crate::sessions::columns::{Heading, Quantity, ValueRange};
use crate::sessions::domain::{Samples, Setups, Target, UnknownColumn};
use crate::sessions::layout::Layout;
use crate::sessions::observed;
use crate::sessions::observed::{Locate, PlacedColumn};
use crate::sessions::references::References;
use crate::sessions::table::Table;
use crate::tables::{Cells, Names, SampleTable};

/// What the session declares and samples name.
#[derive(Clone, Copy)]
pub(crate) struct Declared<'a> {
    pub(crate) targets: &'a [Target],
    pub(crate) references: &'a References,
}

/// Reads the CSV file of a session, told as `part` of something: its headings are those of the robot's joints and of
/// what was measured. `None` when the headings already make no sense, or when it was cancelled; otherwise the table is
/// whole only if `findings` got no error.
pub(crate) fn table(
    bytes: &[u8],
    file: &Place,
    joints: Option<&[Joint]>,
    findings: &mut Vec<Diagnostic>,
    part: ProgressSpan<'_>,
) -> Option<Table> {
    let table = SampleTable::open(bytes, file, findings)?;
    let header = file.clone().at_line(1);
    let place = |index: usize| {
        let column = header.clone().at_column(index as u64 + 1);
        column.in_field(table.names[index].as_str())
    };
    let layout = Layout::read(&table.names, joints, &header, &place, findings);
    let kinds = layout.headings.iter().map(Heading::cells);
    let (columns, line) = table.rows(kinds, file, findings, part).ok()?;
    Some(Table {
        layout,
        names: table.names,
        columns,
        line,
    })
}

/// Makes samples of the rows of a text file, and says of each on which line it stands.
pub(crate) fn rows(
    mut table: Table,
    declared: Declared<'_>,
    file: &Place,
    findings: &mut Vec<Diagnostic>,
) -> Samples {
    let lines = std::mem::take(&mut table.line);
    let names = table.names.clone();
    let locate = |column: usize, row: usize| {
        let place = match lines.get(row) {
            Some(line) => file.clone().at_line(line),
            None => file.clone(),
        };
        let place = place.at_column(column as u64 + 1);
        place.in_field(names[column].as_str())
    };
    let mut samples = samples(table, declared, &locate, file, findings);
    samples.line = lines;
    samples
}

/// Names that each stand once: several columns may be without a heading, and a document has every key once.
#[derive(Default)]
struct OwnNames {
    /// What is taken, with the last number that was given to it.
    taken: BTreeMap<String, usize>,
}

impl OwnNames {
    fn of(&mut self, heading: &str) -> String {
        let mut name = heading.to_owned();
        while self.taken.contains_key(&name) {
            let number = self.taken.entry(heading.to_owned()).or_insert(1);
            *number += 1;
            name = if heading.is_empty() {
                format!("({number})")
            } else {
                format!("{heading} ({number})")
            };
        }
        self.taken.insert(name.clone(), 1);
        name
    }
}

/// Makes samples of a table. They are usable only if `findings` got no error.
pub(crate) fn samples(
    table: Table,
    declared: Declared<'_>,
    locate: Locate<'_>,
    whole: &Place,
    findings: &mut Vec<Diagnostic>,
) -> Samples {
    let rows = table.rows();
    let joints = table.layout.joints;
    if rows == 0 {
        findings.push(Diagnostic::error(
            whole.clone(),
            text!("no sample"),
            text!("at least one"),
        ));
    }
    let missing = || vec![f64::NAN; rows];
    let mut samples = Samples {
        q: vec![Vec::new(); joints],
        q_read: vec![None; joints],
        dir: vec![None; joints],
        speed: vec![None; joints],
        torque_nm: vec![None; joints],
        joint_temperature_c: vec![None; joints],
        line: table.line,
        ..Samples::default()
    };
    let headings = table.layout.headings;
    let targets = declared.targets;
    let mut own_names = OwnNames::default();
    let columns = headings.iter().zip(table.names).zip(table.columns);
    for (index, ((heading, name), cells)) in columns.enumerate() {
        let mut column = PlacedColumn {
            index,
            locate,
            findings: &mut *findings,
        };
        match (heading, cells) {
            (Heading::Unknown { .. }, Cells::Text(cells)) => {
                let name = own_names.of(&name);
                samples.unknown.push(UnknownColumn { name, cells });
            }
            (Heading::Known(quantity, unit), Cells::Numbers(values)) => {
                let values = column.scaled(values, unit.factor());
                column.check_range(&values, quantity.range(*unit), unit.factor());
                if let Quantity::Direction(_) = quantity {
                    column.check_directions(&values);
                }
                samples.put(*quantity, values);
            }
            (Heading::Known(Quantity::Target, _), Cells::Names(cells)) => {
                let names: Vec<&str> = targets.iter().map(|target| &*target.name).collect();
                let indices = column.named(&cells, &names, names.len() == 1).into_iter();
                samples.target = Some(indices.map(Option::unwrap_or_default).collect());
            }
            (Heading::Known(Quantity::Setup, _), Cells::Names(Names { list, index, .. })) => {
                samples.setups = Some(Setups { names: list, index });
            }
            (Heading::Known(Quantity::Use, _), Cells::Names(cells)) => {
                [samples.held_out, samples.excluded] = column.uses(&cells);
            }
            (Heading::Known(quantity, _), Cells::Names(cells)) => {
                column.references(*quantity, &cells, declared.references, &mut samples);
            }
            _ => {}
        }
    }
    observed::complete(
        &mut samples.observed,
        declared.references,
        &headings,
        locate,
        findings,
    );
    let in_plane = [&samples.x_mm, &samples.y_mm];
    let planar = in_plane.iter().all(|column| !column.is_empty());
    if !planar && samples.z_mm.is_none() {
        // Not planar: no point was measured at all, or one coordinate.
        samples.z_mm = Some(missing());
    }
    // Columns that are missing although they are required were reported with the headings.
    for column in samples
        .q
        .iter_mut()
        .chain([&mut samples.x_mm, &mut samples.y_mm])
    {
        if column.len() != rows {
            *column = missing();
        }
    }
    let whole = |parts: &[Vec<f64>; 4]| parts.iter().all(|part| part.len() == rows);
    samples.orientation_wxyz = samples.orientation_wxyz.filter(whole);
    samples
}

impl Samples {
    /// Gives joints that follow others their values, where no column says them.
    pub(crate) fn follow(&mut self, joints: &[Joint]) {
        for (joint, own) in joints.iter().enumerate() {
            let Some(follows) = own.follows else {
                continue;
            };
            let (Some(leading), Some(values)) =
                (self.q.get(follows.of).cloned(), self.q.get_mut(joint))
            else {
                continue;
            };
            if values.iter().all(|value| value.is_nan()) {
                *values = leading
                    .iter()
                    .map(|q| follows.ratio * q + follows.offset)
                    .collect();
                // Where the leading joint came from, the follower did too.
                let side = self.dir.get(follows.of).cloned().flatten();
                if let (Some(side), Some(own @ None)) = (side, self.dir.get_mut(joint)) {
                    *own = Some(
                        side.iter()
                            .map(|dir| dir * follows.ratio.signum())
                            .collect(),
                    );
                }
            }
        }
    }

    /// Puts numbers in their place; a joint that does not exist was reported with the headings.
    fn put(&mut self, quantity: Quantity, values: Vec<f64>) {
        let observed = &mut self.observed;
        let (of_joints, joint) = match quantity {
            Quantity::Commanded(joint) => {
                if let Some(column) = self.q.get_mut(joint) {
                    *column = values;
                }
                return;
            }
            Quantity::X => return self.x_mm = values,
            Quantity::Y => return self.y_mm = values,
            Quantity::Orientation(part) => {
                return self.orientation_wxyz.get_or_insert_default()[part] = values;
            }
            Quantity::ReadBack(joint) => (&mut self.q_read[..], joint),
            Quantity::Direction(joint) => (&mut self.dir[..], joint),
            Quantity::Speed(joint) => (&mut self.speed[..], joint),
            Quantity::Torque(joint) => (&mut self.torque_nm[..], joint),
            Quantity::JointTemperature(joint) => (&mut self.joint_temperature_c[..], joint),
            Quantity::Z => (std::slice::from_mut(&mut self.z_mm), 0),
            Quantity::Load => (std::slice::from_mut(&mut self.load_kg), 0),
            Quantity::Temperature => (std::slice::from_mut(&mut self.temperature_c), 0),
            Quantity::Time => (std::slice::from_mut(&mut self.time_s), 0),
            other => {
                let mut columns = observed.numbers_mut().into_iter();
                let Some(column) = columns.find(|column| column.quantity == other) else {
                    return;
                };
                (std::slice::from_mut(column.values), 0)
            }
        };
        if let Some(column) = of_joints.get_mut(joint) {
            *column = Some(values);
        }
    }
}

impl PlacedColumn<'_> {
    /// In inner units.
    fn scaled(&mut self, mut values: Vec<f64>, factor: f64) -> Vec<f64> {
        // Numbers as they are read are finite, but 1e308 m is not a finite number of mm.
        if factor == 1.0 {
            return values;
        }
        let mut overflow = false;
        for value in &mut values {
            *value *= factor;
            overflow |= value.is_infinite();
        }
        if overflow && let Some(row) = values.iter().position(|value| value.is_infinite()) {
            let place = (self.locate)(self.index, row);
            self.findings.push(Diagnostic::error(
                place,
                text!("a number that overflows"),
                text!("a number that a double can hold"),
            ));
        }
        values
    }

    /// Refuses numbers beyond any robot's range; `range` is in inner units, and `factor` leads there
    /// from the column's.
    fn check_range(&mut self, values: &[f64], range: ValueRange, factor: f64) {
        // One pass that a compiler makes wide; NaN, a missing cell, is in every range.
        let beyond = |value: f64| value.abs() > range.largest;
        if !values.iter().fold(false, |any, value| any | beyond(*value)) {
            return;
        }
        let rows = rows_where(values, beyond);
        let column = PlacedColumn {
            index: self.index,
            locate: self.locate,
            findings: &mut *self.findings,
        };
        let found = |row: usize| Text::verbatim(short(values[row] / factor));
        column.complain(&rows, &found, &range.expected());
    }

    fn check_directions(self, values: &[f64]) {
        let wrong = rows_where(values, |value| {
            !value.is_nan() && value != 0.0 && value.abs() != 1.0
        });
        self.complain(
            &wrong,
            &|row| Text::verbatim(values[row].to_string()),
            &text!("1, -1 or 0 (unknown)"),
        );
    }

    /// What the cells name, of what is declared; complains of those that name nothing that is. Where there is
    /// something to take for an empty cell, it names nothing.
    fn named(self, cells: &Names, declared: &[&str], may_be_empty: bool) -> Vec<Option<u32>> {
        let places: BTreeMap<&str, u32> = declared.iter().copied().zip(0..).collect();
        let known = cells.list.iter().map(|name| {
            let is_empty = may_be_empty && name.is_empty();
            (places.get(name.as_str()).copied(), is_empty)
        });
        let known: Vec<(Option<u32>, bool)> = known.collect();
        let of = |row: &usize| known[cells.index[*row] as usize];
        let rows = 0..cells.index.len();
        let is_wrong = |row: &usize| of(row) == (None, false);
        let wrong: Vec<usize> = rows.clone().filter(is_wrong).collect();
        let found = |row: usize| {
            let name = quoted(&cells.list[cells.index[row] as usize]);
            text!("{name} is not declared", name)
        };
        self.complain(&wrong, &found, &observed::one_of(declared));
        // What was refused must not be missed besides.
        rows.map(|row| of(&row).0.or((!of(&row).1).then_some(0)))
            .collect()
    }

    /// A column that names what measurements other than points refer to.
    fn references(
        self,
        quantity: Quantity,
        cells: &Names,
        references: &References,
        samples: &mut Samples,
    ) {
        let mut columns = samples.observed.names_mut().into_iter();
        if let Some(into) = columns.find(|column| column.quantity == quantity) {
            let declared = references.named(quantity);
            *into.values = Some(self.named(cells, &declared, true));
        }
    }

    /// Held out, and excluded. A file that excludes nothing has no marks of it.
    fn uses(self, cells: &Names) -> [Option<Vec<bool>>; 2] {
        const HELD_OUT: &str = "held-out";
        const EXCLUDED: &str = "excluded";
        // Taken in again it is held out as before.
        const BOTH: &str = "held-out-excluded";
        let of = |row: usize| cells.list[cells.index[row] as usize].as_str();
        let rows = 0..cells.index.len();
        let known = |row: &usize| matches!(of(*row), "" | "fit" | HELD_OUT | EXCLUDED | BOTH);
        let wrong: Vec<usize> = rows.clone().filter(|row| !known(row)).collect();
        let found = |row: usize| Text::verbatim(quoted(of(row)));
        self.complain(&wrong, &found, &text!("fit, held-out or excluded"));
        let marks = |name: &str| -> Vec<bool> {
            let is = |row| of(row) == name || of(row) == BOTH;
            rows.clone().map(is).collect()
        };
        let excluded = Some(marks(EXCLUDED)).filter(|all| all.contains(&true));
        let held_out = Some(marks(HELD_OUT));
        // A column that only excludes says nothing of held-out samples.
        let held_out = held_out.filter(|all| all.contains(&true) || excluded.is_none());
        [held_out, excluded]
    }
}

fn rows_where(values: &[f64], is_wrong: impl Fn(f64) -> bool) -> Vec<usize> {
    let wrong = values
        .iter()
        .enumerate()
        .filter(|(_, value)| is_wrong(**value));
    wrong.map(|(row, _)| row).collect()
}
