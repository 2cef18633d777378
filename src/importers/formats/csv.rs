//! Any table: what its columns are is said by its header, or by the person.

use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::families;
use crate::importers::formats::{EULER_OPTION, Importer, KnownBy, Questions};
use crate::importers::joint_names::understand;
use crate::importers::options::{PLANE_OPTION, SOCKET_DISTANCES_OPTION, SOCKET_OPTION};
use crate::importers::role::Role;
use crate::importers::settings::{About, ReadContext};
use crate::sessions::columns::{Heading, Quantity};
use crate::tables::Grid;
use crate::tables::decimals::shape;

pub(crate) static IMPORTER: Importer = Importer {
    id: "csv",
    title: phrase!("any program: a table with a header, or with columns chosen below"),
    asks: Questions::TABLE,
    options: &[
        EULER_OPTION,
        SOCKET_OPTION,
        PLANE_OPTION,
        SOCKET_DISTANCES_OPTION,
    ],
    known_by: KnownBy::Reading {
        turn: 2,
        suits: |trial| trial.is_sound && trial.headings.is_some(),
    },
    read,
};

/// Reads a table of measured points.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let (grid, roles) = table(context, true)?;
    let headings = match &grid.header {
        Some((_, names)) => {
            let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
            names.join(", ")
        }
        None => String::new(),
    };
    let complete = context.require_position(&roles, &headings);
    let columns = context.columns(&grid, roles);
    columns.filter(|_| complete)
}

/// Reads a table in which no column is required: commands. Without a header, as many columns as the
/// robot has joints are the joints in their order, a column of names before them.
pub(crate) fn read_any(context: &mut ReadContext<'_>) -> Option<Columns> {
    let (grid, roles) = table(context, false)?;
    context.columns(&grid, roles)
}

/// Finds the table and what its columns are.
fn table<'a>(context: &mut ReadContext<'a>, measured: bool) -> Option<(Grid<'a>, Vec<Role>)> {
    let grid = context.grid()?;
    let roles = match (context.given_roles(&grid, None), &grid.header) {
        (Some(roles), _) => roles,
        (None, Some((_, names))) if context.reading.columns.is_empty() => {
            let mut roles: Vec<Role> = names
                .iter()
                .map(|name| understand(name, &context.reading.joints))
                .collect();
            // A column that a separator at the end of each line makes is no column.
            for (role, name) in roles.iter_mut().zip(names) {
                if name.is_empty() {
                    *role = Role::Left;
                }
            }
            roles.truncate(grid.width);
            if measured {
                // While a kind is looked for, a table of distances is that of an instrument for them.
                if context.found.kind.is_some() {
                    own_references(names, &mut roles);
                }
                let names = &names[..names.len().min(roles.len())];
                if let Some(proposed) = families::proposed(names, &roles) {
                    propose(context, names, &roles, &proposed);
                    roles = proposed;
                }
            }
            roles
        }
        (None, None) if !measured && context.reading.columns.is_empty() => {
            headerless_commands(context, &grid)
        }
        (None, _) => {
            if context.reading.columns.is_empty() {
                let says = text!(one "{count} column and no header", "{count} columns and no header", count = grid.width);
                context.ask(About::Columns, says, &[]);
            }
            vec![Role::Left; grid.width]
        }
    };
    Some((grid, roles))
}

/// A session's own columns of measurements other than points are such columns where the table has no
/// points: beside points, a distance or the name of a plane may be anything.
fn own_references(names: &[String], roles: &mut [Role]) {
    let has = |wanted| {
        roles
            .iter()
            .any(|role: &Role| role.quantity() == Some(wanted))
    };
    if has(Quantity::X) || has(Quantity::Y) || has(Quantity::Z) {
        return;
    }
    for (role, name) in roles.iter_mut().zip(names) {
        if let Heading::Known(quantity, unit) = Heading::read(&name.trim().to_lowercase())
            && quantity.needs_a_reference()
        {
            *role = Role::Known(quantity, Some(unit));
        }
    }
}

/// Asks whether what was proposed is right, unless that was said.
fn propose(context: &mut ReadContext<'_>, names: &[String], roles: &[Role], proposed: &[Role]) {
    let changed: Vec<String> = (names.iter().zip(proposed).zip(roles))
        .filter(|((_, proposed), role)| proposed != role)
        .map(|((name, proposed), _)| format!("{} as {proposed}", quoted(name)))
        .collect();
    let says = text!(
        "columns that may be what was measured: {changed}",
        changed = changed.join(", ")
    );
    if context.reading.confirmed {
        context.note(text!("{says}; taken so, as was confirmed", says));
        return;
    }
    let words: Vec<String> = proposed.iter().map(ToString::to_string).collect();
    context.ask(About::Columns, says, &[&words.join(",")]);
}

/// Commands without a header: the joints in their order.
fn headerless_commands(context: &mut ReadContext<'_>, grid: &Grid<'_>) -> Vec<Role> {
    let joints = context.reading.joints.len();
    let is_text = |cells: &Vec<String>| cells.first().is_some_and(|cell| shape(cell).is_none());
    let first = context.found.first_rows.first().is_some_and(is_text);
    let joint = |joint| Role::Known(Quantity::Commanded(joint), None);
    let roles: Vec<Role> = match grid.width.checked_sub(joints) {
        Some(0) if joints > 0 && !first => (0..joints).map(joint).collect(),
        Some(1) if joints > 0 && first => std::iter::once(Role::Point)
            .chain((0..joints).map(joint))
            .collect(),
        _ => {
            let says = text!(
                "{width} columns and no header, for a robot of {joints} joints",
                width = grid.width,
                joints
            );
            context.ask(About::Columns, says, &[]);
            return vec![Role::Left; grid.width];
        }
    };
    let words: Vec<String> = roles.iter().map(ToString::to_string).collect();
    context.note(text!(
        "no header: the columns are taken as {words}",
        words = words.join(", ")
    ));
    roles
}
