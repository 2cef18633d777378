//! A trajectory in the format of the TUM RGB-D benchmark: `timestamp tx ty tz qx qy qz qw`, in
//! seconds and metres, comments behind `#`. The quaternion's real part comes last.

use crate::importers::columns::Columns;
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions, Trial};
use crate::importers::reader::fixed;
use crate::importers::role::Role;
use crate::importers::settings::{Known, ReadContext};
use crate::importers::units::LengthUnit;
use crate::sessions::columns::{Quantity, Unit};

/// The columns as the format calls them.
const NAMES: [&str; 8] = ["timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"];

pub(crate) static IMPORTER: Importer = Importer {
    id: "tum",
    title: phrase!("a TUM trajectory: time, position, quaternion"),
    asks: Questions {
        columns: Meanings::Fixed,
        ..Questions::TABLE
    },
    options: &[],
    known_by: KnownBy::Reading { turn: 0, suits },
    read,
};

/// The format's own names, behind a comment sign, are no header of a table.
fn suits(trial: &Trial) -> bool {
    let headings = trial.headings.as_ref();
    trial.is_sound && trial.is_complete && headings.is_none_or(|names| names.iter().eq(NAMES))
}

/// Reads a trajectory.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    if grid.width != 8 {
        let found = text!(one "{count} column", "{count} columns", count = grid.width);
        context.refuse(found, text!("8: timestamp tx ty tz qx qy qz qw"));
        return None;
    }
    let unit = context.reading.unit.unwrap_or(LengthUnit::Metres);
    if unit != LengthUnit::Metres {
        let found = text!(
            "lengths are taken in {symbol}, as stated",
            symbol = unit.symbol()
        );
        context.warn(found, text!("m, which the format has"));
    }
    let position = |quantity| fixed(quantity, unit.unit());
    let part = |part| fixed(Quantity::Orientation(part), Unit::Fixed);
    let roles = vec![
        Role::Time(1.0),
        position(Quantity::X),
        position(Quantity::Y),
        position(Quantity::Z),
        part(1),
        part(2),
        part(3),
        part(0),
    ];
    let columns = context.columns(&grid, roles);
    for column in &mut context.found.columns {
        column.confidence = Known::Certain;
    }
    context.found.unit = text!("{unit}, as the format has it", unit = unit.symbol());
    columns
}
