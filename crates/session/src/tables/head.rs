//! What the first lines of a text are like: how much of a table they are with a separator, and which of them is the
//! header.

use super::decimals::shape;
use super::dialect::{Dialect, Separator};
use super::rows::{OpenQuote, TextRow, TextRows};

/// Lines that are looked at for the separator and the start of the table.
pub(super) const LOOKED_AT: usize = 400;

/// Words that the reader of the table knows.
pub(crate) struct Words {
    /// Of a heading.
    pub(crate) is_heading: fn(&str) -> bool,
    /// Of a unit.
    pub(crate) is_unit: fn(&str) -> bool,
}

/// What programs write where a number is missing tells no heading from a row.
fn is_number(cell: &str) -> bool {
    const MISSING: [&str; 6] = ["nan", "-nan", "inf", "-inf", "null", "none"];
    shape(cell).is_some() || MISSING.iter().any(|word| cell.eq_ignore_ascii_case(word))
}

/// The first of the lines before the table that is a row of it, below a line of known headings: a row that lacks most
/// of its values does not look like one.
pub(super) fn rows_below_header(
    before: &[(u64, Vec<String>)],
    width: usize,
    words: &Words,
) -> Option<usize> {
    let is_row = |cells: &[String]| {
        cells.len() == width
            && cells.iter().any(|cell| is_number(cell))
            && !cells.iter().any(|cell| (words.is_heading)(cell))
    };
    let rows = before.iter().rev().take_while(|(_, cells)| is_row(cells));
    let first = before.len() - rows.count();
    let (_, above) = before.get(first.checked_sub(1)?)?;
    let is_header = above.len() == width
        && !above.iter().any(|cell| is_number(cell))
        && above.iter().any(|cell| (words.is_heading)(cell));
    (is_header && first < before.len()).then_some(first)
}

/// A cell that is a number with its unit, such as `12.5 mm`.
pub(super) fn with_unit_in_cell<'a>(text: &'a str, words: &Words) -> Option<&'a str> {
    let cells = text
        .lines()
        .take(LOOKED_AT)
        .flat_map(|line| line.split([';', '\t', ',']));
    cells.map(str::trim).find(|cell| {
        let digits = cell.trim_end_matches(|c: char| !c.is_ascii_digit());
        let unit = cell[digits.len()..].trim();
        !unit.is_empty() && shape(digits).is_some() && (words.is_unit)(unit)
    })
}

pub(super) fn numbers_in(row: &TextRow<'_>) -> usize {
    row.cells.iter().filter(|cell| is_number(cell)).count()
}

/// What the first lines are like with one separator.
pub(super) struct Head {
    /// Cells and numbers of each line.
    lines: Vec<(usize, usize)>,
    pub(super) open_quote: Option<OpenQuote>,
}

impl Head {
    pub(super) fn read(text: &str, separator: Separator) -> Self {
        let mut rows = TextRows::new(text, Dialect::of_instruments(separator));
        let mut row = TextRow::default();
        let mut head = Self {
            lines: Vec::new(),
            open_quote: None,
        };
        while head.lines.len() < LOOKED_AT {
            match rows.next(&mut row) {
                Ok(true) => head.lines.push((row.cells.len(), numbers_in(&row))),
                Ok(false) => break,
                Err(quote) => {
                    head.open_quote = Some(quote);
                    break;
                }
            }
        }
        head
    }

    /// Whether this is a column of numbers below a heading.
    pub(super) fn is_single(&self) -> bool {
        let numbers = self.lines.iter().filter(|line| **line == (1, 1)).count();
        numbers > 0 && numbers + 1 >= self.lines.len()
    }

    /// How much of a table this is, with its number of columns and of number columns: over the
    /// lines of the best width, the sum of numbers² / cells, which favours many numbers and few
    /// other cells.
    pub(super) fn quality(&self) -> Option<(f64, usize, usize)> {
        let mut widths: Vec<usize> = self.lines.iter().map(|line| line.0).collect();
        widths.sort_unstable();
        widths.dedup();
        let of_width = |width: usize| {
            let mut numbers: Vec<usize> = self
                .lines
                .iter()
                .filter(|line| line.0 == width && line.1 > 0)
                .map(|line| line.1)
                .collect();
            numbers.sort_unstable();
            let typical = *numbers.get(numbers.len() / 2)?;
            let sum: f64 = numbers.iter().map(|&n| (n * n) as f64 / width as f64).sum();
            Some((sum, width, typical))
        };
        let tables = widths.into_iter().filter(|width| *width > 1);
        tables
            .filter_map(of_width)
            .reduce(|best, next| if next.0 > best.0 { next } else { best })
    }
}

/// Takes the header out of the lines before the table.
pub(super) fn take_header(
    before: &mut Vec<(u64, Vec<String>)>,
    width: usize,
    words: &Words,
) -> Option<(u64, Vec<String>)> {
    let fits = |cells: &[String]| {
        let filled = cells
            .iter()
            .rposition(|cell| !cell.is_empty())
            .map_or(0, |at| at + 1);
        let numbers = cells.iter().filter(|cell| is_number(cell)).count();
        // A line of one or two words is a remark, unless the table is as narrow.
        cells.len() >= width.saturating_sub(1).max(1)
            && (filled > 2 || filled + 1 >= width)
            && 2 * numbers < filled.max(1)
    };
    let (line, mut cells) = before.pop_if(|(_, cells)| fits(cells))?;
    // `X;Y;Z`, then `mm;mm;mm`. A column called `M` or `In` alone is no line of units.
    if are_units(&cells, words)
        && let Some((line, names)) = before.pop_if(|(_, cells)| fits(cells))
    {
        return Some((line, with_units(&names, &cells)));
    }
    cells.resize(cells.len().max(width), String::new());
    Some((line, cells))
}

fn plain_unit(cell: &str) -> &str {
    cell.trim_matches(['[', ']', '(', ')'])
}

fn are_units(cells: &[String], words: &Words) -> bool {
    let is_unit = |cell: &String| {
        let plain = plain_unit(cell);
        cell.is_empty() || plain == "-" || (words.is_unit)(plain)
    };
    cells.iter().filter(|cell| !cell.is_empty()).count() > 1 && cells.iter().all(is_unit)
}

/// Headings with the units below them.
fn with_units(names: &[String], units: &[String]) -> Vec<String> {
    let joined = names.iter().enumerate().map(|(index, name)| {
        match units.get(index).map(|cell| plain_unit(cell)) {
            None | Some("" | "-") => name.clone(),
            Some(unit) => format!("{name} [{unit}]"),
        }
    });
    joined.collect()
}

/// The cells of a comment as those of a table with this separator; a unit in brackets belongs to what is before it.
fn cells_of(comment: &str, separator: Separator) -> Vec<String> {
    let mut row = TextRow::default();
    let mut rows = TextRows::new(comment, Dialect::of_instruments(separator));
    if rows.next(&mut row) != Ok(true) {
        return Vec::new();
    }
    let mut cells: Vec<String> = Vec::new();
    for cell in row.owned() {
        match cells.last_mut() {
            Some(last) if separator == Separator::Spaces && cell.starts_with(['[', '(']) => {
                last.push_str(&cell);
            }
            _ => cells.push(cell),
        }
    }
    cells
}

/// `# name x y z`, `%time,field.x,…`: a header behind a comment sign, if its words are known, with the separator of
/// the table or another. Where the first cells are names it may begin with what comes behind them.
pub(super) fn header_in_comments(
    comments: &[(u64, &str)],
    separator: Separator,
    first: &TextRow<'_>,
    words: &Words,
) -> Option<(u64, Vec<String>)> {
    let width = first.cells.len();
    let is_named = first.cells.first().is_some_and(|cell| !is_number(cell));
    let separators = || std::iter::once(separator).chain(Separator::ALL);
    comments.iter().rev().find_map(|(line, comment)| {
        separators().find_map(|own| {
            let mut cells = cells_of(comment, own);
            let known = cells.iter().filter(|cell| (words.is_heading)(cell)).count();
            // In a sentence one word may be that of a heading.
            let enough = if own == Separator::Spaces {
                width.min(2)
            } else {
                1
            };
            if cells.len() + 1 == width && is_named && known >= enough {
                cells.insert(0, "name".to_owned());
            }
            let fits = cells.len() == width
                && known >= enough
                && !cells.iter().any(|cell| is_number(cell));
            fits.then_some((*line, cells))
        })
    })
}

/// The headings with the units that a comment behind them states for each: `# [mm] [mm] [deg]`.
pub(super) fn with_units_in_comments(
    (line, names): (u64, Vec<String>),
    comments: &[(u64, &str)],
    separator: Separator,
    words: &Words,
) -> (u64, Vec<String>) {
    let units = comments
        .iter()
        .filter(|(at, _)| *at > line)
        .find_map(|(_, comment)| {
            let separators = std::iter::once(separator).chain(Separator::ALL);
            let mut cut = separators.map(|own| match own {
                // No unit has its brackets behind another.
                Separator::Spaces => comment.split_whitespace().map(str::to_owned).collect(),
                own => cells_of(comment, own),
            });
            cut.find(|cells| cells.len() == names.len() && are_units(cells, words))
        });
    let names = units.map_or(names.clone(), |units| with_units(&names, &units));
    (line, names)
}
