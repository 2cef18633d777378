//! The columns of a foreign file once they are read: every format ends here.

use crate::diagnostic::Place;
use crate::importers::role::Role;
use crate::sessions::Lines;
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::{Cells, Names};
use nalgebra::{Point3, Quaternion};

/// The coordinates of a measured point.
pub(crate) const COORDINATES: [Quantity; 3] = [Quantity::X, Quantity::Y, Quantity::Z];

/// The place in the column with this heading, if it has one.
pub(crate) fn below(place: Place, heading: &str) -> Place {
    match heading {
        "" => place,
        heading => place.in_field(heading),
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// Its heading in the file, or what it is.
    pub(crate) name: String,
    /// Its number in the file, counted from 1.
    pub(crate) number: u64,
    pub(crate) role: Role,
    pub(crate) cells: Cells,
}

impl Column {
    /// A column of numbers that a reader made itself, in inner units or degrees.
    pub(crate) fn made(quantity: Quantity, unit: Unit, values: Vec<f64>) -> Self {
        Self {
            name: quantity.heading(Some(unit)),
            number: 0,
            role: Role::Known(quantity, Some(unit)),
            cells: Cells::Numbers(values),
        }
    }

    /// A column that a reader made itself, and that nothing uses.
    pub(crate) fn kept(name: &str, cells: Vec<String>) -> Self {
        Self {
            name: name.to_owned(),
            number: 0,
            role: Role::Kept,
            cells: Cells::Text(cells),
        }
    }

    /// A column of names that a reader made itself.
    pub(crate) fn named(quantity: Quantity, names: Names) -> Self {
        Self {
            name: quantity.heading(None),
            number: 0,
            role: Role::Known(quantity, Some(Unit::Fixed)),
            cells: Cells::Names(names),
        }
    }

    /// The numbers in inner units.
    pub(crate) fn in_base_units(&self) -> Option<Vec<f64>> {
        let factor = match self.role {
            Role::Known(_, Some(unit)) | Role::Turn(_, Some(unit)) => unit.factor(),
            Role::Known(_, None) | Role::Time(_) | Role::Axis(_) => 1.0,
            _ => return None,
        };
        match &self.cells {
            Cells::Numbers(values) => Some(values.iter().map(|value| value * factor).collect()),
            _ => None,
        }
    }
}

/// All columns of a file, of the same length.
#[derive(Debug, Clone, Default)]
pub(crate) struct Columns {
    pub(crate) list: Vec<Column>,
    /// The line of each row.
    pub(crate) lines: Lines,
    /// Where the robot was over time, where the file has recorded that too.
    pub(crate) commands: Option<Box<Columns>>,
}

impl Columns {
    pub(crate) fn rows(&self) -> usize {
        self.list.first().map_or(0, |column| column.cells.len())
    }

    pub(crate) fn find(&self, quantity: Quantity) -> Option<&Column> {
        let is = |column: &&Column| column.role.quantity() == Some(quantity);
        self.list.iter().find(is)
    }

    /// A quantity's numbers in inner units.
    pub(crate) fn numbers(&self, quantity: Quantity) -> Option<Vec<f64>> {
        self.find(quantity)?.in_base_units()
    }

    /// The text of each row in the column with this role.
    pub(crate) fn texts(&self, role: Role) -> Option<Vec<&str>> {
        let column = self.list.iter().find(|column| column.role == role)?;
        match &column.cells {
            Cells::Text(cells) => Some(cells.iter().map(String::as_str).collect()),
            Cells::Names(Names { list, index, .. }) => {
                let name = |&i: &u32| list[i as usize].as_str();
                Some(index.iter().map(name).collect())
            }
            Cells::Numbers(_) => None,
        }
    }

    /// The name of one measured point.
    pub(crate) fn point(&self, row: usize) -> Option<&str> {
        let column = self.list.iter().find(|column| column.role == Role::Point)?;
        match &column.cells {
            Cells::Text(cells) => cells.get(row).map(String::as_str),
            _ => None,
        }
    }

    /// The names of the measured points.
    pub(crate) fn points(&self) -> Option<Vec<&str>> {
        self.texts(Role::Point)
    }

    /// The rows that are listed, in that order.
    pub(crate) fn only(self, rows: &[usize]) -> Self {
        let mut lines = Lines::default();
        if !self.lines.is_empty() {
            for &row in rows {
                lines.add(self.lines.get(row).unwrap_or(0), 1);
            }
        }
        let list = self
            .list
            .into_iter()
            .map(|column| Column {
                cells: only(column.cells, rows),
                ..column
            })
            .collect();
        Self {
            list,
            lines,
            commands: self.commands,
        }
    }

    /// The measured coordinates of each row, mm; NaN where one is missing, `None` without one of the columns.
    pub(crate) fn places(&self) -> Option<Vec<Point3<f64>>> {
        let [x, y, z] = COORDINATES.map(|quantity| self.numbers(quantity));
        let (x, y, z) = (x?, y?, z?);
        let points = x.iter().zip(&y).zip(&z);
        Some(points.map(|((x, y), z)| Point3::new(*x, *y, *z)).collect())
    }

    /// Puts coordinates, mm, in the place of those that there are.
    pub(crate) fn put_places(&mut self, places: &[Point3<f64>]) {
        for (axis, quantity) in COORDINATES.into_iter().enumerate() {
            let values = places.iter().map(|place| place[axis]).collect();
            self.put(Column::made(quantity, Unit::Length(1.0), values));
        }
    }

    /// The measured orientation of each row; NaN where one is missing, `None` without one of the columns.
    pub(crate) fn orientations(&self) -> Option<Vec<Quaternion<f64>>> {
        let [w, x, y, z] = [0, 1, 2, 3].map(|part| self.numbers(Quantity::Orientation(part)));
        let (w, x, y, z) = (w?, x?, y?, z?);
        let of = |row: usize| Quaternion::new(w[row], x[row], y[row], z[row]);
        Some((0..w.len()).map(of).collect())
    }

    /// Puts orientations in the place of those that there are.
    pub(crate) fn put_orientations(&mut self, all: &[Quaternion<f64>]) {
        let parts: [fn(&Quaternion<f64>) -> f64; 4] = [|q| q.w, |q| q.i, |q| q.j, |q| q.k];
        for (part, of) in parts.into_iter().enumerate() {
            let (quantity, values) = (Quantity::Orientation(part), all.iter().map(of).collect());
            self.put(Column::made(quantity, Unit::Fixed, values));
        }
    }

    /// Gives all rows one name, where no column has one.
    pub(crate) fn name_all(&mut self, quantity: Quantity, name: &str) {
        if self.find(quantity).is_none() {
            let mut names = Names::default();
            for _ in 0..self.rows() {
                names.push(name);
            }
            self.list.push(Column::named(quantity, names));
        }
    }

    /// Puts numbers where no column has this quantity.
    pub(crate) fn put_missing(
        &mut self,
        quantity: Quantity,
        unit: Unit,
        values: impl FnOnce() -> Vec<f64>,
    ) {
        if self.find(quantity).is_none() {
            self.put(Column::made(quantity, unit, values()));
        }
    }

    /// Puts a column in the place of the one with the same quantity, or behind the others.
    pub(crate) fn put(&mut self, column: Column) {
        let same = |other: &&mut Column| {
            other.role.quantity().is_some() && other.role.quantity() == column.role.quantity()
        };
        match self.list.iter_mut().find(same) {
            Some(old) => *old = column,
            None => self.list.push(column),
        }
    }
}

fn only(cells: Cells, rows: &[usize]) -> Cells {
    match cells {
        Cells::Numbers(values) => Cells::Numbers(rows.iter().map(|&row| values[row]).collect()),
        Cells::Text(mut cells) => {
            let take = |&row: &usize| std::mem::take(&mut cells[row]);
            Cells::Text(rows.iter().map(take).collect())
        }
        Cells::Names(names) => {
            let mut taken = Names::default();
            for &row in rows {
                taken.push(&names.list[names.index[row] as usize]);
            }
            Cells::Names(taken)
        }
    }
}
