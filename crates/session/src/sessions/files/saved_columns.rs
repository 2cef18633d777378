//! The columns of a session as they go into a file: headings, and values in outer units.

use crate::document::{Value, degrees};
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::domain::{Samples, Session, Setups, Target};

/// From an inner to an outer unit.
type Conversion = fn(f64) -> f64;

/// A heading and its cells.
pub(crate) struct Column<'a> {
    pub(crate) name: String,
    pub(crate) values: Values<'a>,
}

/// The cells of a column.
pub(crate) enum Values<'a> {
    /// NaN is an empty cell; `outside` makes outer units of inner ones.
    Numbers {
        values: &'a [f64],
        outside: Conversion,
    },
    Targets(&'a [u32], &'a [Target]),
    Setups(&'a Setups),
    /// Held out, and excluded.
    Use([Option<&'a [bool]>; 2]),
    Text(&'a [String]),
    /// Indices into the names that the session declares; nothing is an empty cell.
    References(&'a [Option<u32>], Vec<&'a str>),
}

impl<'a> Values<'a> {
    /// A cell that is not a number.
    pub(crate) fn text(&self, row: usize) -> &'a str {
        match self {
            Self::Numbers { .. } => "",
            Self::Targets(index, targets) => targets
                .get(index[row] as usize)
                .map_or("", |target| &target.name),
            Self::Setups(setups) => setups
                .names
                .get(setups.index[row] as usize)
                .map_or("", String::as_str),
            Self::Use(marks) => match marks.map(|all| all.is_some_and(|all| all[row])) {
                [false, false] => "fit",
                [true, false] => "held-out",
                [false, true] => "excluded",
                [true, true] => "held-out-excluded",
            },
            Self::Text(cells) => &cells[row],
            Self::References(index, names) => index[row].map_or("", |index| names[index as usize]),
        }
    }

    /// The cells as a document has them.
    pub(crate) fn inline(&self) -> Value {
        let rows = match self {
            Self::Numbers { values, outside } => {
                return Value::Numbers(values.iter().map(|value| outside(*value)).collect());
            }
            Self::Targets(index, _) => index.len(),
            Self::Setups(setups) => setups.index.len(),
            Self::Use(uses) => uses.iter().flatten().next().map_or(0, |all| all.len()),
            Self::Text(cells) => cells.len(),
            Self::References(index, ..) => index.len(),
        };
        (0..rows).map(|row| self.text(row)).collect()
    }
}

impl Samples {
    /// The numbers of a column, where there are any.
    pub(crate) fn numbers(&self, quantity: Quantity) -> Option<&[f64]> {
        fn of_joint(columns: &[Option<Vec<f64>>], joint: usize) -> Option<&[f64]> {
            columns.get(joint)?.as_deref()
        }
        let (samples, observed) = (self, &self.observed);
        match quantity {
            Quantity::Commanded(joint) => samples.q.get(joint).map(Vec::as_slice),
            Quantity::ReadBack(joint) => of_joint(&samples.q_read, joint),
            Quantity::Direction(joint) => of_joint(&samples.dir, joint),
            Quantity::Speed(joint) => of_joint(&samples.speed, joint),
            Quantity::Torque(joint) => of_joint(&samples.torque_nm, joint),
            Quantity::JointTemperature(joint) => of_joint(&samples.joint_temperature_c, joint),
            Quantity::X => Some(&samples.x_mm),
            Quantity::Y => Some(&samples.y_mm),
            Quantity::Z => samples.z_mm.as_deref(),
            Quantity::Orientation(part) => samples.orientation_wxyz.as_ref().map(|all| &*all[part]),
            Quantity::Load => samples.load_kg.as_deref(),
            Quantity::Temperature => samples.temperature_c.as_deref(),
            Quantity::Time => samples.time_s.as_deref(),
            other => observed.values(other),
        }
    }
}

/// Every column of the session, in the order of the contract.
pub(crate) fn columns(session: &Session) -> Vec<Column<'_>> {
    let samples = &session.samples;
    // A session of other measurements has no points at all.
    let points = [&samples.x_mm, &samples.y_mm];
    let points = points.into_iter().chain(&samples.z_mm);
    let measured = points.flatten().any(|v| !v.is_nan());
    let other = !samples.observed.is_empty() || samples.orientation_wxyz.is_some();
    let no_points = other && !measured;
    let uses = [samples.held_out.as_deref(), samples.excluded.as_deref()];
    let joints = &session.robot.joints;
    let column = |quantity: Quantity| {
        let unit = quantity.written_in(joints);
        let values = match quantity {
            Quantity::X | Quantity::Y | Quantity::Z if no_points => None,
            Quantity::Target => {
                let index = samples.target.as_ref();
                index.map(|index| Values::Targets(index, &session.targets))
            }
            Quantity::Setup => samples.setups.as_ref().map(Values::Setups),
            Quantity::Use => uses
                .iter()
                .any(Option::is_some)
                .then_some(Values::Use(uses)),
            _ => {
                let names = session.instrument.references.named(quantity);
                let index = samples.observed.indices(quantity);
                let named = index.map(|index| Values::References(index, names));
                named.or_else(|| {
                    let values = samples.numbers(quantity)?;
                    let outside = match unit {
                        Unit::Angle(_) => degrees,
                        _ => |value| value,
                    };
                    Some(Values::Numbers { values, outside })
                })
            }
        };
        let name = quantity.heading(Some(unit));
        Some(Column {
            name,
            values: values?,
        })
    };
    let unknown = samples.unknown.iter().map(|column| Column {
        name: column.name.clone(),
        values: Values::Text(&column.cells),
    });
    Quantity::all(joints.len())
        .filter_map(column)
        .chain(unknown)
        .collect()
}
