//! Any table: what its columns are is said by its header, or by the person.

use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::formats::{Asks, Importer, KnownBy};
use crate::importers::headings::{Role, understand};
use crate::importers::reader::Case;
use crate::importers::settings::About;

pub(crate) static IMPORTER: Importer = Importer {
    id: "csv",
    plainly: "any program: a table with a header, or with columns chosen below",
    asks: Asks::TABLE,
    options: &[],
    known_by: KnownBy::Reading {
        turn: 2,
        suits: |trial| trial.is_sound && trial.headings.is_some(),
    },
    read,
};

/// Reads a table of measured points.
fn read(case: &mut Case<'_>) -> Option<Columns> {
    let (grid, roles) = table(case)?;
    let headings = match &grid.header {
        Some((_, names)) => {
            let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
            format!(" among {}", names.join(", "))
        }
        None => String::new(),
    };
    let complete = case.require_position(&roles, &headings);
    let columns = case.columns(&grid, roles);
    columns.filter(|_| complete)
}

/// Reads a table in which no column is required.
pub(crate) fn read_any(case: &mut Case<'_>) -> Option<Columns> {
    let (grid, roles) = table(case)?;
    case.columns(&grid, roles)
}

/// Finds the table and what its columns are.
fn table<'a>(case: &mut Case<'a>) -> Option<(crate::importers::grid::Grid<'a>, Vec<Role>)> {
    let grid = case.grid()?;
    let roles = match (case.given_roles(&grid, None), &grid.header) {
        (Some(roles), _) => roles,
        (None, Some((_, names))) => {
            let mut roles: Vec<Role> = names.iter().map(|name| understand(name)).collect();
            // A column that a separator at the end of each line makes is no column.
            for (role, name) in roles.iter_mut().zip(names) {
                if name.is_empty() {
                    *role = Role::Left;
                }
            }
            roles.truncate(grid.width);
            roles
        }
        (None, None) => {
            if case.reading.columns.is_empty() {
                let says = format!("{} columns and no header", grid.width);
                case.ask(About::Columns, says, &[]);
            }
            vec![Role::Left; grid.width]
        }
    };
    Some((grid, roles))
}
