//! A trajectory in the format of the TUM RGB-D benchmark: `timestamp tx ty tz qx qy qz qw`, in
//! seconds and metres, comments behind `#`. The quaternion's real part comes last.

use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::formats::{Importer, KnownBy, Meanings, Questions, Trial};
use crate::importers::reader::fixed;
use crate::importers::role::Role;
use crate::importers::settings::{Known, ReadContext};
use crate::importers::units::{LengthUnit, TimeUnit};
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::Grid;
use crate::text::Template;

/// The columns as the format calls them.
const NAMES: [&str; 8] = ["timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"];

const COLUMNS: Template = phrase!(
    "timestamp tx ty tz qx qy qz qw in any order, or no heading; --as csv with --columns for other tables"
);

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

/// The columns as a heading says that stands over them after all, in a comment too: it may have another order, or
/// say units. A heading that is understood in part is none that can be followed.
fn as_headed(context: &mut ReadContext<'_>, grid: &Grid<'_>, own: Vec<Role>) -> Option<Vec<Role>> {
    let Some((_, names)) = &grid.header else {
        // In words the real part may come first as well.
        let real_first = |comment: &&String| {
            let words = comment.to_lowercase();
            let words = words.split(|c: char| !c.is_alphanumeric());
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            words.contains(&"wxyz") || words.windows(4).any(|four| four == ["w", "x", "y", "z"])
        };
        return match grid.comments.iter().find(real_first) {
            None => Some(own),
            Some(comment) => refuse_heading(context, comment),
        };
    };
    let mut said = context.roles_of(grid, names);
    let same = |one: &Role, other: &Role| one.quantity() == other.quantity();
    for said in &mut said {
        let by_format = own.iter().find(|own| same(own, said)).copied();
        match said {
            Role::Known(_, None) | Role::Time(None) => *said = by_format.unwrap_or(*said),
            _ => {}
        }
    }
    let is_whole = own
        .iter()
        .all(|own| said.iter().any(|said| same(own, said)));
    let agrees = own
        .iter()
        .zip(&said)
        .all(|(own, said)| *said == Role::Kept || own == said);
    if agrees {
        return Some(own);
    }
    if !is_whole {
        return refuse_heading(context, &names.join(" "));
    }
    context.note(text!(
        "the columns are those of the heading, not in the order of the format: {heading}",
        heading = quoted(&names.join(" "))
    ));
    Some(said)
}

fn refuse_heading(context: &mut ReadContext<'_>, heading: &str) -> Option<Vec<Role>> {
    let found = text!("the heading {heading}", heading = quoted(heading));
    context.refuse(found, COLUMNS);
    None
}

/// Reads a trajectory.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    if grid.width != 8 {
        let found = text!(one "{count} column", "{count} columns", count = grid.width);
        context.refuse(found, COLUMNS);
        return None;
    }
    let unit = context.reading.unit.unwrap_or(LengthUnit::Metres);
    if unit != LengthUnit::Metres {
        context.another_unit(LengthUnit::Metres.symbol(), unit.symbol());
    }
    let time = context.reading.time_unit.unwrap_or(TimeUnit::Seconds);
    let position = |quantity| fixed(quantity, unit.unit());
    let part = |part| fixed(Quantity::Orientation(part), Unit::Fixed);
    let roles = vec![
        Role::Time(Some(time.in_s())),
        position(Quantity::X),
        position(Quantity::Y),
        position(Quantity::Z),
        part(1),
        part(2),
        part(3),
        part(0),
    ];
    let roles = as_headed(context, &grid, roles)?;
    let columns = context.columns(&grid, roles);
    for column in &mut context.found.columns {
        column.confidence = Known::Certain;
    }
    context.found.unit = text!("{unit}, as the format has it", unit = unit.symbol());
    columns
}
