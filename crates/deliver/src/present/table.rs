//! Tables, built once and written by all: as aligned text in the terminal, with tabs for the clipboard,
//! as HTML and PDF in the report.

use super::numbers::plain_number;
use crate::tables::as_cell;

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// What stands over it, with its unit.
    pub heading: String,
    /// Whether it stands to the right, as numbers do.
    pub right: bool,
}

impl Column {
    /// A column of words.
    pub fn words(heading: impl Into<String>) -> Self {
        Self {
            heading: heading.into(),
            right: false,
        }
    }

    /// A column of numbers.
    pub fn numbers(heading: impl Into<String>) -> Self {
        Self {
            heading: heading.into(),
            right: true,
        }
    }
}

/// What stands in a column of a row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cell {
    /// What a person reads.
    pub shown: String,
    /// What a spreadsheet computes with; `None` for text.
    pub value: Option<f64>,
}

impl From<String> for Cell {
    fn from(shown: String) -> Self {
        Self { shown, value: None }
    }
}

impl From<&str> for Cell {
    fn from(shown: &str) -> Self {
        shown.to_owned().into()
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        count.to_string().into()
    }
}

/// A number for a spreadsheet.
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self {
            shown: String::new(),
            value: Some(value),
        }
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Self {
        cell.map_or_else(Self::default, Into::into)
    }
}

impl Cell {
    /// A number as a person reads it, with the value behind it; a dash where there is none.
    pub fn number(value: Option<f64>, shown: impl FnOnce(f64) -> String) -> Self {
        let dash = || "–".to_owned();
        Self {
            shown: value.map_or_else(dash, shown),
            value: Some(value.unwrap_or(f64::NAN)),
        }
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// Rows, each with one cell per column.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table with these columns.
    pub fn of(columns: impl IntoIterator<Item = Column>) -> Self {
        Self {
            columns: columns.into_iter().collect(),
            rows: Vec::new(),
        }
    }

    /// An empty table; a heading that starts with `>` is that of a column of numbers.
    pub fn new<T: AsRef<str>>(headings: impl IntoIterator<Item = T>) -> Self {
        let column = |heading: T| {
            let right = heading.as_ref().strip_prefix('>');
            Column {
                heading: right.unwrap_or(heading.as_ref()).to_owned(),
                right: right.is_some(),
            }
        };
        Self {
            columns: headings.into_iter().map(column).collect(),
            rows: Vec::new(),
        }
    }

    /// The same, the headings in one line with ` | ` between them.
    pub fn headed(headings: impl AsRef<str>) -> Self {
        Self::new(headings.as_ref().split(" | "))
    }

    /// Adds a row.
    pub fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// As text for the terminal: columns as wide as their widest cell, two spaces between them, `indent`
    /// before each line, and an ASCII minus sign, as other programs read it.
    pub fn aligned(&self, indent: usize) -> String {
        let headings = self.columns.iter().map(|column| column.heading.as_str());
        let shown = |row: &'_ Vec<Cell>| -> Vec<String> {
            row.iter()
                .map(|cell| cell.shown.replace('−', "-"))
                .collect()
        };
        let mut lines: Vec<Vec<String>> = vec![headings.map(str::to_owned).collect()];
        lines.extend(self.rows.iter().map(shown));
        let length = |line: &Vec<String>, k: usize| line.get(k).map_or(0, |c| width(c));
        let widths = (0..self.columns.len())
            .map(|k| lines.iter().map(|line| length(line, k)).max().unwrap_or(0));
        let widths: Vec<usize> = widths.collect();
        let mut text = String::new();
        for line in &lines {
            let mut row = " ".repeat(indent);
            for ((cell, wide), column) in line.iter().zip(&widths).zip(&self.columns) {
                let blanks = " ".repeat(wide - width(cell));
                row += &if column.right {
                    format!("{blanks}{cell}  ")
                } else {
                    format!("{cell}{blanks}  ")
                };
            }
            text += row.trim_end();
            text.push('\n');
        }
        text
    }

    /// As a CSV file (RFC 4180), numbers with all their digits: commas between the columns, or semicolons
    /// where the user writes decimals with a comma, as spreadsheets then read it.
    pub fn csv(&self) -> String {
        let comma = plain_number(0.5).contains(',');
        let between = if comma { ";" } else { "," };
        let quoted = |text: &str| as_cell(&cell(text)).into_owned();
        let line = |cells: Vec<String>| cells.join(between) + "\n";
        let headings = self.columns.iter().map(|column| quoted(&column.heading));
        let mut text = line(headings.collect());
        for row in &self.rows {
            let cells = row.iter().map(|one| match one.value {
                Some(value) => plain_number(value),
                None => quoted(&one.shown),
            });
            text += &line(cells.collect());
        }
        text
    }

    /// As text for a spreadsheet: tabs between the columns, numbers with all their digits and the decimal
    /// sign that the user chose, nothing where a number is not finite.
    pub fn tabbed(&self) -> String {
        let headings = self.columns.iter().map(|column| column.heading.clone());
        let mut lines = vec![headings.collect::<Vec<_>>().join("\t")];
        for row in &self.rows {
            let cells = row.iter().map(|one| match one.value {
                Some(value) => plain_number(value),
                None => cell(&one.shown),
            });
            lines.push(cells.collect::<Vec<_>>().join("\t"));
        }
        lines.join("\n") + "\n"
    }
}

/// How many columns of a terminal a text takes: letters of East Asian scripts take two.
#[doc(hidden)]
pub fn width(text: &str) -> usize {
    let wide = |c: char| {
        matches!(c,
            '\u{1100}'..='\u{115f}' | '\u{2e80}'..='\u{303e}' | '\u{3041}'..='\u{a4cf}' | '\u{ac00}'..='\u{d7a3}'
            | '\u{f900}'..='\u{faff}' | '\u{fe30}'..='\u{fe6f}' | '\u{ff00}'..='\u{ff60}' | '\u{ffe0}'..='\u{ffe6}'
            | '\u{20000}'..='\u{3fffd}')
    };
    text.chars().map(|c| 1 + usize::from(wide(c))).sum()
}

/// A user's text as one cell of a table with tabs; a spreadsheet must not take it for a formula.
pub fn cell(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.starts_with(['=', '+', '-', '@']) {
        format!("'{text}")
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["name", ">value, mm"]);
        table.row([
            Cell::from("=sum"),
            Cell::number(Some(-1.23456), |v| format!("−{:.1}", -v)),
        ]);
        table.row([Cell::from("größer"), Cell::number(None, |v| v.to_string())]);
        table
    }

    #[test]
    fn text_stands_in_columns() {
        let lines = [
            "  name    value, mm",
            "  =sum         -1.2",
            "  größer          –",
        ];
        assert_eq!(table().aligned(2), lines.join("\n") + "\n");
    }

    #[test]
    fn wide_letters_take_two_columns() {
        let mut table = Table::new(["误差", ">mm"]);
        table.row(["ab", "1"]);
        assert_eq!(table.aligned(0), "误差  mm\nab     1\n");
    }

    #[test]
    fn a_csv_file_has_quotes_around_what_has_commas() {
        assert_eq!(
            table().csv(),
            "name,\"value, mm\"\n'=sum,-1.23456\ngrößer,\n"
        );
    }

    #[test]
    fn a_spreadsheet_gets_every_digit_and_no_formula() {
        assert_eq!(
            table().tabbed(),
            "name\tvalue, mm\n'=sum\t-1.23456\ngrößer\t\n"
        );
    }
}
