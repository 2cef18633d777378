//! Finds the table in a text: the separator, the lines before it, the header, and the decimal sign.
//!
//! The separator is the one that cuts most of the first lines into the same number of cells of which
//! most are numbers. The table starts with the first such line; the header is the last line before
//! it that has as many cells and no numbers. A line of units below the header belongs to it.

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::quoted;
use crate::importers::decimals::{Decimal, Decision, Votes, shape};
use crate::importers::headings::understand;
use crate::importers::role::Role;
use crate::importers::rows::{OpenQuote, Row, Rows, Separator};
use crate::importers::settings::{About, Question};
use crate::importers::units;
use crate::progress::ProgressSpan;
use crate::sessions::columns::Unit;
use crate::text::Text;

/// Lines that are looked at for the separator and the start of the table.
const LOOKED_AT: usize = 400;
/// Columns that a table may have.
pub(crate) const MOST_COLUMNS: usize = 1024;
/// Lines before the table that are kept, the last ones.
const SHOWN: usize = 20;

/// A table that was found in a text.
#[derive(Clone)]
pub(crate) struct Grid<'a> {
    pub(crate) separator: Separator,
    /// Lines before the table, but for the header.
    pub(crate) preamble: Vec<Vec<String>>,
    /// Headings and their line, if there are any; a line of units is already joined in.
    pub(crate) header: Option<(u64, Vec<String>)>,
    /// Number of cells in a row.
    pub(crate) width: usize,
    /// Stands before the first row.
    body: Rows<'a>,
    /// The work that going through all rows belongs to.
    part: Option<ProgressSpan<'a>>,
}

/// The complaint about an open quote.
pub(crate) fn open_quote(file: &Place, quote: OpenQuote) -> Diagnostic {
    let place = file.clone().at_line(quote.line);
    let found = text!("a quote that is not closed");
    Diagnostic::error(place, found, text!("a second quote, or none"))
}

impl<'a> Grid<'a> {
    /// Finds the table.
    pub(crate) fn find(
        text: &'a str,
        separator: Option<Separator>,
        header: Option<u64>,
        file: &Place,
    ) -> Result<Self, Box<Diagnostic>> {
        let candidates = match separator {
            Some(separator) => vec![separator],
            None => Separator::ALL.to_vec(),
        };
        let mut best: Option<(f64, Separator, usize, usize)> = None;
        let mut quote = None;
        for separator in candidates {
            let head = Head::read(text, separator);
            quote = quote.or(head.open_quote);
            if let Some((quality, width, numbers)) = head.quality()
                && best.is_none_or(|(other, ..)| quality > other)
            {
                best = Some((quality, separator, width, numbers));
            }
        }
        // A single column has no separator; a tabulator cuts nothing that may be in it.
        let single = || Head::read(text, Separator::Tab).is_single();
        if best.is_none() && separator.is_none() && quote.is_none() && single() {
            best = Some((0.0, Separator::Tab, 1, 1));
        }
        let Some((_, separator, width, numbers)) = best else {
            if let Some(quote) = quote {
                return Err(Box::new(open_quote(file, quote)));
            }
            let found = text!("no table: no line of cells of which one is a number");
            let expected = text!("rows of cells between tabs, semicolons, commas or spaces");
            return Err(Box::new(Diagnostic::error(file.clone(), found, expected)));
        };
        if width > MOST_COLUMNS {
            let found = text!(one "{count} column", "{count} columns", count = width);
            let expected = text!("a table of at most {most} columns", most = MOST_COLUMNS);
            return Err(Box::new(Diagnostic::error(file.clone(), found, expected)));
        }
        let found = Self::with(text, separator, width, numbers)
            .map_err(|quote| Box::new(open_quote(file, quote)))?;
        match header {
            None => Ok(found),
            Some(0) => Ok(Self {
                header: None,
                ..found
            }),
            Some(line) => found.below(text, line, file),
        }
    }

    /// The same table with its header in this line, and everything below it as rows.
    fn below(self, text: &'a str, line: u64, file: &Place) -> Result<Self, Box<Diagnostic>> {
        let mut rows = Rows::new(text, self.separator);
        let mut row = Row::default();
        let mut before: Vec<Vec<String>> = Vec::new();
        loop {
            match rows.next(&mut row) {
                Ok(true) if row.line < line => {
                    before.push(row.cells.iter().map(ToString::to_string).collect());
                    if before.len() > 2 * SHOWN {
                        before.drain(..SHOWN);
                    }
                }
                Ok(true) if row.line == line => break,
                Ok(_) => {
                    let place = file.clone().at_line(line);
                    let found = text!("no line of cells to be the header");
                    let expected = text!("the number of a line that is not blank and no comment");
                    return Err(Box::new(Diagnostic::error(place, found, expected)));
                }
                Err(quote) => return Err(Box::new(open_quote(file, quote))),
            }
        }
        before.drain(..before.len().saturating_sub(SHOWN));
        let mut names: Vec<String> = row.cells.iter().map(ToString::to_string).collect();
        names.resize(names.len().max(self.width), String::new());
        Ok(Self {
            preamble: before,
            header: Some((line, names)),
            body: rows,
            ..self
        })
    }

    /// Finds the start of a table with so many cells in a row and so many numbers among them.
    fn with(
        text: &'a str,
        separator: Separator,
        width: usize,
        numbers: usize,
    ) -> Result<Self, OpenQuote> {
        let enough = numbers.div_ceil(2).max(1);
        let mut rows = Rows::new(text, separator);
        let mut row = Row::default();
        let mut before: Vec<(u64, Vec<String>)> = Vec::new();
        let body = loop {
            let start = rows.clone();
            if !rows.next(&mut row)? {
                break start;
            }
            if row.cells.len() == width && numbers_in(&row) >= enough {
                break start;
            }
            let cells = row.cells.iter().map(ToString::to_string).collect();
            before.push((row.line, cells));
            // Only the last lines can be a header.
            if before.len() > LOOKED_AT {
                before.drain(..LOOKED_AT / 2);
            }
        };
        let header = take_header(&mut before, width).or_else(|| {
            let (line, comment) = rows.comment?;
            header_in_comment(comment, separator, width).map(|cells| (line, cells))
        });
        before.drain(..before.len().saturating_sub(SHOWN));
        Ok(Self {
            separator,
            preamble: before.into_iter().map(|(_, cells)| cells).collect(),
            header,
            width,
            body,
            part: None,
        })
    }

    /// Going through all rows is told as a pass of this part of the work.
    pub(crate) fn watched(self, part: ProgressSpan<'a>) -> Self {
        let part = Some(part);
        Self { part, ..self }
    }

    /// Goes through the rows; `each` gets the row, already checked for its width. Rows that are too
    /// long or too short are complained about, and passed over.
    pub(crate) fn each_row(
        &self,
        file: &Place,
        complaints: &mut Complaints,
        mut each: impl FnMut(&Row<'a>, &mut Complaints),
    ) {
        let mut rows = self.body.clone();
        if let Some(part) = self.part {
            rows = rows.in_pass_of(part);
        }
        let mut row = Row::default();
        loop {
            match rows.next(&mut row) {
                Ok(true) => {}
                Ok(false) => return,
                Err(quote) => {
                    complaints.findings.push(open_quote(file, quote));
                    return;
                }
            }
            // Cells that a program puts behind the last one are empty.
            if row.cells.len() >= self.width && row.filled() <= self.width {
                each(&row, complaints);
            } else {
                let found = match row.cells.len() {
                    1 => text!("1 cell, {cells}", cells = quoted(&row.cells[0])),
                    count => text!(one "{count} cell", "{count} cells", count = count),
                };
                let expected = text!(
                    "{width} between {separator}, as in the rows before",
                    width = self.width,
                    separator = self.separator.name()
                );
                complaints
                    .add(|| Diagnostic::error(file.clone().at_line(row.line), found, expected));
            }
        }
    }

    /// The first rows as they stand.
    pub(crate) fn first_rows(&self, count: usize) -> Vec<Vec<String>> {
        let mut rows = self.body.clone();
        let mut row = Row::default();
        let mut first = Vec::new();
        while first.len() < count && rows.next(&mut row) == Ok(true) {
            first.push(row.cells.iter().map(ToString::to_string).collect());
        }
        first
    }

    /// Which decimal sign the number columns have, by all of their cells.
    pub(crate) fn decimal(
        &self,
        given: Option<Decimal>,
        is_number: &dyn Fn(usize) -> bool,
        file: &Place,
        questions: &mut Vec<Question>,
        findings: &mut Vec<Diagnostic>,
    ) -> Option<Decimal> {
        if given.is_some() {
            return given;
        }
        let mut votes = Votes::default();
        // What is wrong with rows is said when they are read.
        let mut ignored = Complaints::default();
        self.each_row(file, &mut ignored, |row, _| {
            for (index, cell) in row.cells.iter().take(self.width).enumerate() {
                if is_number(index) && cell.bytes().any(|byte| byte == b',' || byte == b'.') {
                    votes.add(cell, row.line, index + 1);
                }
            }
        });
        let place = |example: &crate::importers::decimals::Example| {
            let place = file.clone().at_line(example.line);
            place.at_column(example.column as u64)
        };
        match votes.decide() {
            Decision::Is(decimal) => Some(decimal),
            Decision::Ask(example) => {
                let says = text!(
                    "{cell} is {decimal} with a decimal comma, or {grouped} with a comma between thousands, and no other number tells",
                    cell = quoted(&example.cell),
                    decimal = example.cell.replace(',', "."),
                    grouped = example.cell.replace(',', "")
                );
                questions.push(Question::new(
                    About::Decimal,
                    place(&example),
                    says,
                    &[",", "."],
                ));
                None
            }
            Decision::Mixed(point, comma) => {
                let found = text!(
                    "{cell} here and {other} in line {line}: a decimal point and a decimal comma",
                    cell = quoted(&comma.cell),
                    other = quoted(&point.cell),
                    line = point.line
                );
                let expected = text!(
                    "one decimal sign in the whole file, or --decimal if one of the two separates thousands"
                );
                findings.push(Diagnostic::error(place(&comma), found, expected));
                None
            }
        }
    }

    /// The unit that a line before the table names.
    pub(crate) fn unit_in_preamble(&self) -> Option<(String, Unit)> {
        let mut named = self
            .preamble
            .iter()
            .filter_map(|cells| units::named_in_preamble(cells));
        let first = named.next()?;
        // Two different units name none.
        named.all(|other| other.1 == first.1).then_some(first)
    }
}

/// Complaints about the rows of one file, the first ones in full.
#[derive(Debug, Default)]
pub(crate) struct Complaints {
    pub(crate) findings: Vec<Diagnostic>,
    more: usize,
}

impl Complaints {
    const MOST: usize = 20;

    pub(crate) fn add(&mut self, complaint: impl FnOnce() -> Diagnostic) {
        if self.findings.len() < Self::MOST {
            self.findings.push(complaint());
        } else {
            self.more += 1;
        }
    }

    pub(crate) fn into(self, file: &Place, findings: &mut Vec<Diagnostic>) {
        findings.extend(self.findings);
        if self.more > 0 {
            let found = text!(one "{count} more cell or row like these", "{count} more cells or rows like these", count = self.more);
            findings.push(Diagnostic::error(file.clone(), found, Text::default()));
        }
    }
}

fn is_number(cell: &str) -> bool {
    shape(cell).is_some()
}

fn numbers_in(row: &Row<'_>) -> usize {
    row.cells.iter().filter(|cell| is_number(cell)).count()
}

/// What the first lines are like with one separator.
struct Head {
    /// Cells and numbers of each line.
    lines: Vec<(usize, usize)>,
    open_quote: Option<OpenQuote>,
}

impl Head {
    fn read(text: &str, separator: Separator) -> Self {
        let mut rows = Rows::new(text, separator);
        let mut row = Row::default();
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
    fn is_single(&self) -> bool {
        let numbers = self.lines.iter().filter(|line| **line == (1, 1)).count();
        numbers > 0 && numbers + 1 >= self.lines.len()
    }

    /// How much of a table this is, with its number of columns and of number columns: over the
    /// lines of the best width, the sum of numbers² / cells, which favours many numbers and few
    /// other cells.
    fn quality(&self) -> Option<(f64, usize, usize)> {
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
fn take_header(before: &mut Vec<(u64, Vec<String>)>, width: usize) -> Option<(u64, Vec<String>)> {
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
    let is_unit = |cell: &String| {
        let plain = cell.trim_matches(['[', ']', '(', ')']);
        cell.is_empty() || plain == "-" || units::word(plain).is_some()
    };
    // `X;Y;Z`, then `mm;mm;mm`. A column called `M` or `In` alone is no line of units.
    let some = cells.iter().filter(|cell| !cell.is_empty()).count();
    let all_units = some > 1 && cells.iter().all(is_unit);
    if all_units && let Some((line, names)) = before.pop_if(|(_, cells)| fits(cells)) {
        let joined = names.iter().enumerate().map(|(index, name)| {
            match cells
                .get(index)
                .map(|cell| cell.trim_matches(['[', ']', '(', ')']))
            {
                None | Some("" | "-") => name.clone(),
                Some(unit) => format!("{name} [{unit}]"),
            }
        });
        return Some((line, joined.collect()));
    }
    cells.resize(cells.len().max(width), String::new());
    Some((line, cells))
}

/// `# name x y z`: a header behind a comment sign, if its words are known.
fn header_in_comment(comment: &str, separator: Separator, width: usize) -> Option<Vec<String>> {
    let mut row = Row::default();
    let mut rows = Rows::new(comment, separator);
    if rows.next(&mut row) != Ok(true) || row.cells.len() != width {
        return None;
    }
    let known = |cell: &&std::borrow::Cow<'_, str>| !matches!(understand(cell), Role::Kept);
    let enough = row.cells.iter().filter(known).count() >= 2;
    enough.then(|| row.cells.iter().map(ToString::to_string).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(text: &str) -> Grid<'_> {
        Grid::find(text, None, None, &Place::default()).expect("there is a table")
    }

    fn header(text: &str) -> String {
        find(text).header.expect("there is a header").1.join("|")
    }

    #[test]
    fn the_separator_is_the_one_that_makes_a_table() {
        for (text, separator, width) in [
            ("a;b;c\n1,5;2,5;3,5\n1;2;3\n", Separator::Semicolon, 3),
            ("a,b,c\n1.5,2.5,3.5\n", Separator::Comma, 3),
            (
                "P1, 1.0, 2.0, 3.0\nP2, 1.0, 2.0, 3.0\n",
                Separator::Comma,
                4,
            ),
            ("P1\t1,5\t2,5\t3,5\n", Separator::Tab, 4),
            ("P1  1,5  2,5  3,5\nP2 1 2 3\n", Separator::Spaces, 4),
            ("P 1,1.0,2.0,3.0\n", Separator::Comma, 4),
            ("P1 1,234 5,678 9,012\n", Separator::Spaces, 4),
            ("x y; z\n1 2\n3 4\n5 6\n", Separator::Spaces, 2),
        ] {
            let grid = find(text);
            assert_eq!((grid.separator, grid.width), (separator, width), "{text}");
        }
    }

    #[test]
    fn the_header_is_found_behind_a_preamble() {
        let preamble = "Report;12\nDate;2024-05-01\nOperator;A. B.\n\n";
        assert_eq!(header(&format!("{preamble}n;x;y;z\nP1;1;2;3\n")), "n|x|y|z");
        assert_eq!(
            header(&format!("{preamble}n;x;y;z\n;mm;[mm];mm\nP1;1;2;3\n")),
            "n|x [mm]|y [mm]|z [mm]"
        );
        assert_eq!(header("# name x y z\nP1 1 2 3\nP2 1 2 3\n"), "name|x|y|z");
        assert_eq!(header("n,x,y,z,\nP1,1,2,3,\n"), "n|x|y|z|");
        let grid = find("# made by hand\nP1 1 2 3\n");
        assert_eq!(grid.header, None);
    }

    #[test]
    fn a_text_without_a_table_is_no_table() {
        for text in ["hello\nworld\n", "1\nx\ny\n", "a,b\nc,d\n", "1,\"2\n"] {
            assert!(
                Grid::find(text, None, None, &Place::default()).is_err(),
                "{text}"
            );
        }
    }

    #[test]
    fn rows_of_another_width_are_named() {
        let grid = find("x,y\n1,2\n3,4,,\n5\n6,7,8\n9,1\n");
        let mut complaints = Complaints::default();
        let mut rows = 0;
        grid.each_row(&Place::default(), &mut complaints, |_, _| rows += 1);
        assert_eq!(rows, 3);
        let lines: Vec<_> = complaints.findings.iter().map(|d| d.place.line).collect();
        assert_eq!(lines, [Some(4), Some(5)]);
    }
}
