//! Text of a laser tracker or of `SpatialAnalyzer`: `Point,X,Y,Z` or `Group,Point,X,Y,Z`, without a
//! header; the person who exported it chose the fields.
//!
//! Names come first. A first column of whole numbers before columns with fractions holds names too
//! (points are often numbered). Where the columns do not tell, the person does.

use crate::importers::columns::{COORDINATES, Columns};
use crate::importers::formats::{EULER_OPTION, Importer, KnownBy, Questions};
use crate::importers::headings::{Words, is_among};
use crate::importers::role::{Role, has};
use crate::importers::settings::ReadContext;
use crate::sessions::columns::Quantity;
use crate::tables::decimals::{Shape, shape};
use crate::tables::{Complaints, Grid};

pub(crate) static IMPORTER: Importer = Importer {
    id: "tracker",
    title: phrase!("a laser tracker or SpatialAnalyzer: names, x, y, z"),
    asks: Questions::TABLE,
    options: &[EULER_OPTION],
    known_by: KnownBy::Reading {
        turn: 5,
        suits: |trial| trial.is_sound,
    },
    read,
};

/// From so many numbers on there may be a second point, nominal and measured, or an orientation: which is which is asked.
const TWO_POINTS: usize = 6;

/// Whether a comment says that points are given by angles.
fn is_spherical(comment: &str) -> bool {
    const WORDS: Words = "theta phi azimuth elevation zenith az el zen hz v spherical cylindrical polar range dist distance";
    let words = comment.to_lowercase();
    let words = words.split(|c: char| !c.is_alphanumeric());
    words.filter(|word| is_among(word, WORDS)).count() > 1
}

/// What all cells of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Empty,
    Whole,
    Fraction,
    Text,
}

/// Reads measured points.
pub(crate) fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    // Some programs can be told to write a header: then it says.
    let says_otherwise =
        grid.header.is_some() || grid.comments.iter().any(|line| is_spherical(line));
    // What was said of columns that have headings is all that is asked for.
    let is_said = grid.header.is_some() && !context.reading.columns.is_empty();
    let by_header = if is_said {
        None
    } else {
        roles_by_header(&grid, context)
    };
    let found = by_header.or_else(|| {
        let kinds = kinds(&grid, context);
        let names = names_before(&kinds).filter(|_| !says_otherwise)?;
        let numbers = kinds[names..]
            .iter()
            .take_while(|kind| **kind != Kind::Text);
        (numbers.count() < TWO_POINTS).then(|| roles(names, grid.width))
    });
    let roles = match (context.given_roles(&grid, found.as_deref()), found) {
        (Some(given), _) => given,
        (None, _) if !context.reading.columns.is_empty() => return None,
        (None, Some(found)) => found,
        (None, None) if context.is_open() => return None,
        (None, None) => {
            context.ask_for(&grid, "x, y, z");
            vec![Role::Left; grid.width]
        }
    };
    if roles.iter().any(|role| *role != Role::Left) {
        context.require_position(&grid, &roles);
    }
    context.columns(&grid, roles)
}

/// What a header says, if it says where x and y are.
fn roles_by_header(grid: &Grid<'_>, context: &mut ReadContext<'_>) -> Option<Vec<Role>> {
    let (_, names) = grid.header.as_ref()?;
    if context.reading.columns.is_empty() && context.ask_about_count(grid, names) {
        return None;
    }
    let roles = context.roles_of(grid, names);
    (has(&roles, Quantity::X) && has(&roles, Quantity::Y)).then_some(roles)
}

/// What the columns are over the whole file.
fn kinds(grid: &Grid<'_>, context: &ReadContext<'_>) -> Vec<Kind> {
    let mut kinds = vec![Kind::Empty; grid.width];
    // What is wrong with rows is said when they are read.
    let mut ignored = Complaints::default();
    grid.each_row(&context.place, &mut ignored, |row, _| {
        for (kind, cell) in kinds.iter_mut().zip(&row.cells) {
            if *kind == Kind::Text || cell.is_empty() {
                continue;
            }
            let is = match shape(cell) {
                Some(Shape::Whole) => Kind::Whole,
                Some(_) => Kind::Fraction,
                None => Kind::Text,
            };
            *kind = is.max(*kind);
        }
    });
    kinds
}

/// How many columns of names stand before x, y and z.
fn names_before(kinds: &[Kind]) -> Option<usize> {
    let text = kinds.iter().take_while(|kind| **kind == Kind::Text).count();
    let numbers = kinds[text..]
        .iter()
        .take_while(|kind| **kind != Kind::Text)
        .count();
    let is_whole = |at: usize| kinds.get(at) == Some(&Kind::Whole);
    let fractions_from = |at: usize| {
        (at..at + 3).all(|at| kinds.get(at).is_some_and(|kind| *kind != Kind::Text))
            && (at..at + 3).any(|at| kinds.get(at) == Some(&Kind::Fraction))
    };
    match (text, numbers) {
        (_, 0..3) => None,
        (0, 3) => Some(0),
        // x, y, z and then a number more: only a first column without fractions is a name.
        (0, 4) => is_whole(0).then_some(1),
        (0, _) => match (is_whole(0), is_whole(1)) {
            (true, false) => Some(1),
            (true, true) if fractions_from(2) && !is_whole(2) => Some(2),
            _ => None,
        },
        (text, 3) => Some(text),
        // A group, and points with numbers for names; or a tool number behind the coordinates.
        (text, _) => Some(
            if is_whole(text) && fractions_from(text + 1) && !is_whole(text + 1) {
                text + 1
            } else {
                text
            },
        ),
    }
}

fn roles(names: usize, width: usize) -> Vec<Role> {
    (0..width)
        .map(|index| match index {
            index if index + 1 == names => Role::Point,
            index if index + 2 == names => Role::Group,
            index if index < names => Role::Kept,
            index => match COORDINATES.get(index - names) {
                Some(quantity) => Role::Known(*quantity, None),
                None => Role::Kept,
            },
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_before_the_coordinates() {
        use Kind::{Fraction as F, Text as T, Whole as W};
        for (kinds, names) in [
            (&[F, F, F][..], Some(0)),
            (&[W, W, W], Some(0)),
            (&[T, F, F, F], Some(1)),
            (&[T, W, W, W], Some(1)),
            (&[T, T, F, F, F], Some(2)),
            (&[T, W, F, F, F], Some(2)),
            (&[T, T, T, F, F, F, F], Some(3)),
            (&[T, F, F, F, F, T], Some(1)),
            (&[W, F, F, F], Some(1)),
            (&[W, F, F, F, F], Some(1)),
            (&[W, W, F, F, F], Some(2)),
            (&[F, F, F, F], None),
            (&[T, F, F], None),
            (&[F, T, F, F], None),
            (&[W, W, W, F, F], None),
        ] {
            assert_eq!(names_before(kinds), names, "{kinds:?}");
        }
    }
}
