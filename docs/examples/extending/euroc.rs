//! A trajectory as the EuRoC data sets have it: `#timestamp [ns], p_x [m], p_y, p_z, q_w, q_x, q_y, q_z`,
//! with commas; further columns (speeds, biases) are ignored. The quaternion's real part comes first.

use crate::importers::columns::Columns;
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions};
use crate::importers::reader::fixed;
use crate::importers::role::Role;
use crate::importers::settings::{Known, ReadContext};
use crate::importers::units::LengthUnit;
use crate::sessions::columns::{Quantity, Unit};

pub(crate) static IMPORTER: Importer = Importer {
    id: "euroc",
    title: phrase!("a EuRoC trajectory: time in nanoseconds, position, quaternion"),
    asks: Questions {
        columns: Meanings::Fixed,
        ..Questions::TABLE
    },
    options: &[],
    known_by: KnownBy::Text(|text| text.starts_with("#timestamp")),
    read,
};

/// Reads a trajectory.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    if grid.width < 8 {
        let found = text!(one "{count} column", "{count} columns", count = grid.width);
        let expected = text!("8: timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z");
        context.refuse(found, expected);
        return None;
    }
    let unit = context.reading.unit.unwrap_or(LengthUnit::Metres);
    let position = |quantity| fixed(quantity, unit.unit());
    let part = |part| fixed(Quantity::Orientation(part), Unit::Fixed);
    let mut roles = vec![
        Role::Time(Some(1e-9)),
        position(Quantity::X),
        position(Quantity::Y),
        position(Quantity::Z),
        part(0),
        part(1),
        part(2),
        part(3),
    ];
    roles.resize(grid.width, Role::Kept);
    let columns = context.columns(&grid, roles);
    for column in &mut context.found.columns {
        column.confidence = Known::Certain;
    }
    context.found.unit = text!("{unit}, as the format has it", unit = unit.symbol());
    columns
}
