//! Any table: what its columns are is said by its header, or by the person.

use crate::document::number::quoted;
use crate::importers::columns::{COORDINATES, Columns};
use crate::importers::families;
use crate::importers::formats::{EULER_OPTION, Importer, KnownBy, Questions};
use crate::importers::headings::understand;
use crate::importers::matching::listed_names;
use crate::importers::options::{PLANE_OPTION, SOCKET_DISTANCES_OPTION, SOCKET_OPTION};
use crate::importers::reader::SHOWN_HEADINGS;
use crate::importers::role::{Proposal, Role, has};
use crate::importers::settings::{About, ReadContext};
use crate::sessions::columns::{Heading, Quantity};
use crate::tables::decimals::{shape, value_alone};
use crate::tables::{Grid, Separator};

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
    known_by: KnownBy::headed(2),
    read,
};

/// Reads a table of measured points.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let (grid, roles) = table(context, true)?;
    let complete = context.is_open() || context.require_position(&grid, &roles);
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
            if context.ask_about_count(&grid, names) {
                let nothing = vec![Role::Left; grid.width];
                return Some((grid, nothing));
            }
            let mut roles = context.roles_of(&grid, names);
            // A column that a separator at the end of each line makes is no column.
            for (role, name) in roles.iter_mut().zip(names) {
                if name.is_empty() {
                    *role = Role::Left;
                }
            }
            context.ask_about_lost_times(&roles, names);
            if measured {
                // While a kind is looked for, a table of distances is that of an instrument for them.
                if context.found.kind.is_some() {
                    own_references(names, &mut roles);
                }
                let names = &names[..names.len().min(roles.len())];
                match families::proposed(names, &roles) {
                    Proposal::None => {}
                    Proposal::One(proposed) => {
                        propose(context, names, &roles, &proposed);
                        roles = proposed;
                    }
                    Proposal::Several(groups) => {
                        let says = text!(
                            "{count} groups of x, y, z: {groups}; one of them is what was measured, or a row holds several points: then one point a row is expected, with its name in a column target",
                            count = groups.len(),
                            groups = listed_names(&groups, SHOWN_HEADINGS)
                        );
                        context.ask(About::Columns, says, &[]);
                    }
                }
                if !has(&roles, Quantity::X) && is_matrix(context, &grid) {
                    refuse_matrix(context, &grid);
                }
            }
            refuse_contradiction(context, &grid, names, &roles);
            roles
        }
        (None, None) if !measured && context.reading.columns.is_empty() => {
            headerless_commands(context, &grid)
        }
        (None, _) => {
            let cut = headings_of_fewer(&grid);
            if let Some(headings) = cut {
                context.refuse(
                    text!("{headings} headings above rows of {width} cells: commas stand between cells and in numbers", headings, width = grid.width),
                    text!("a file with semicolons or tabs between cells, or with decimal points"),
                );
            } else if is_matrix(context, &grid) {
                refuse_matrix(context, &grid);
            } else if context.reading.columns.is_empty() {
                context.ask_for(&grid, "");
            }
            vec![Role::Left; grid.width]
        }
    };
    Some((grid, roles))
}

fn refuse_matrix(context: &mut ReadContext<'_>, grid: &Grid<'_>) {
    context.refuse(
        text!("{width} columns, of which the numbers are a matrix of a rotation and a position in every row", width = grid.width),
        text!("a position and an orientation: x,y,z,qw,qx,qy,qz or x,y,z,rx,ry,rz"),
    );
}

/// A comment above the heading that says of every column what it is, and of one something else.
fn refuse_contradiction(
    context: &mut ReadContext<'_>,
    grid: &Grid<'_>,
    names: &[String],
    roles: &[Role],
) {
    let Some(comment) = &grid.said_before else {
        return;
    };
    let said: Vec<Role> = comment.iter().map(|cell| understand(cell)).collect();
    let contradicts = |(said, role): (&Role, &Role)| match (said, role) {
        (Role::Known(one, unit), Role::Known(other, own)) => {
            one != other || unit.is_some() && own.is_some() && unit != own
        }
        (Role::Time(Some(unit)), Role::Time(Some(own))) => unit != own,
        _ => said.quantity() != role.quantity(),
    };
    if !said.contains(&Role::Kept) && said.iter().zip(roles).any(contradicts) {
        context.refuse(
            text!(
                "the heading {heading} and a comment above it, {comment}, contradict each other",
                heading = quoted(&names.join(", ")),
                comment = quoted(&comment.join(", "))
            ),
            text!("one of the two"),
        );
    }
}

/// How many headings stand above a table with more cells in a row, as decimal commas make them of a table with commas.
fn headings_of_fewer(grid: &Grid<'_>) -> Option<usize> {
    let above = grid.preamble.last()?;
    let are_words = above.len() > 1
        && above
            .iter()
            .all(|cell| !cell.is_empty() && shape(cell).is_none());
    (grid.separator == Separator::Comma && are_words && above.len() < grid.width)
        .then_some(above.len())
}

/// Whether the last 12 or 16 cells of the first rows are the three or four rows of a pose as a matrix.
fn is_matrix(context: &ReadContext<'_>, grid: &Grid<'_>) -> bool {
    let is_pose = |row: &Vec<String>| {
        let cells = if grid.width >= 16 { 16 } else { 12 };
        let numbers = row
            .iter()
            .skip(grid.width.saturating_sub(cells))
            .map(|cell| value_alone(cell));
        let m: Vec<f64> = numbers.collect();
        let product = |a: usize, b: usize| (0..3).map(|k| m[4 * a + k] * m[4 * b + k]).sum::<f64>();
        let unit = |a: usize, b: usize| (product(a, b) - f64::from(u8::from(a == b))).abs() < 0.01;
        m.len() == cells && (0..3).all(|a| (0..=a).all(|b| unit(a, b)))
    };
    let rows = &context.found.first_rows;
    !rows.is_empty() && rows.iter().all(is_pose)
}

/// A session's own columns of measurements other than points are such columns where the table has no
/// points: beside points, a distance or the name of a plane may be anything.
fn own_references(names: &[String], roles: &mut [Role]) {
    if COORDINATES.into_iter().any(|axis| has(roles, axis)) {
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
        context.note(says);
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
            context.ask_for(grid, "");
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
