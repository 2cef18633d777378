//! Tables of a report: as wide as their content wants, broken over pages between rows.

use crate::present::chart::FULL_WIDTH;
use crate::present::drawing::{Anchor, Drawing, GROUND, INK, Item, Label, MUTED, RULE};
use crate::report::document::Table;
use crate::report::fonts::breakable;

use super::flow::{BOTTOM, Flow, LEFT, PAGE, TOP};

const PADDING: f64 = 4.5;
/// Lines of a cell that are shown, so that a row fits on a page.
const MOST_LINES: usize = 40;

/// Rows of a table that stay with its head, and with its last row.
const FEWEST_ROWS: usize = 2;
/// A table that takes no more of a page than this stands on one.
const MOST_WHOLE: f64 = 0.5;

impl Flow<'_> {
    pub(super) fn table_layout(&self, table: &Table) -> TableLayout {
        let widths = self.column_widths(table);
        let headings = table.columns.iter().map(|column| &*column.heading);
        let head = self.cells(headings, &widths, true);
        let cells = |row: &Vec<crate::present::table::Cell>| {
            let shown = row.iter().map(|cell| &*cell.shown);
            self.cells(shown, &widths, false)
        };
        let rows = table.rows.iter().map(cells).collect();
        TableLayout { widths, head, rows }
    }

    /// A table: its head on every page that it reaches, never alone, and no row by itself at the end.
    pub(super) fn table(&mut self, table: &Table) {
        let layout = self.table_layout(table);
        self.room_for(layout.least_height().min(BOTTOM - TOP));
        let TableLayout { widths, head, rows } = layout;
        let heights: Vec<f64> = rows.iter().map(|row| row_height(row)).collect();
        let head_height = row_height(&head);
        let breaks = table_breaks(
            &heights,
            BOTTOM - self.y - head_height,
            BOTTOM - TOP - head_height,
        );
        self.row(&head, &widths, table, true);
        for (k, cells) in rows.iter().enumerate() {
            if breaks.contains(&k) {
                self.pages.push(Drawing::new(PAGE[0], PAGE[1]));
                self.y = TOP;
                self.row(&head, &widths, table, true);
            }
            self.row(cells, &widths, table, false);
        }
        self.y += 8.0;
    }

    fn cells<'t>(
        &self,
        row: impl Iterator<Item = &'t str>,
        widths: &[f64],
        bold: bool,
    ) -> Vec<Vec<String>> {
        let wrap = |(text, width): (&str, &f64)| {
            let mut lines = self.fonts.wrapped(text, 8.2, bold, width - 2.0 * PADDING);
            if lines.len() > MOST_LINES {
                lines.truncate(MOST_LINES);
                lines.push("…".to_owned());
            }
            lines
        };
        row.zip(widths).map(wrap).collect()
    }

    fn row(&mut self, cells: &[Vec<String>], widths: &[f64], table: &Table, head: bool) {
        let height = row_height(cells);
        let y = self.y;
        let page = self.page();
        if head {
            page.items
                .push(Item::Box([LEFT, y], [FULL_WIDTH, height], GROUND));
        }
        let mut x = LEFT;
        for ((lines, width), column) in cells.iter().zip(widths).zip(&table.columns) {
            for (k, line) in lines.iter().enumerate() {
                let base = y + 2.6 + 11.0 * (k as f64 + 0.5) + 8.2 * 0.35;
                let (at, anchor) = if column.right {
                    ([x + width - PADDING, base], Anchor::End)
                } else {
                    ([x + PADDING, base], Anchor::Start)
                };
                let mut label = Label::new(at, line.clone(), 8.2, INK).anchored(anchor);
                label.bold = head;
                page.text(label);
            }
            x += width;
        }
        self.y += height;
        let y = self.y;
        self.rule(
            y,
            if head { 0.7 } else { 0.4 },
            if head { MUTED } else { RULE },
        );
    }

    /// As wide as the content wants, where there is room; else the widest give way.
    fn column_widths(&self, table: &Table) -> Vec<f64> {
        let wide = |text: &str, bold: bool| self.fonts.width(text, 8.2, bold) + 2.0 * PADDING + 0.5;
        let natural: Vec<f64> = (0..table.columns.len())
            .map(|k| {
                let cells = table.rows.iter().filter_map(|row| row.get(k));
                let widest = cells
                    .map(|cell| wide(&cell.shown, false))
                    .fold(0.0, f64::max);
                // A heading may break over two lines.
                let heading = &table.columns[k].heading;
                let words = heading
                    .split(' ')
                    .flat_map(breakable)
                    .map(|w| wide(w, true));
                widest
                    .max(words.fold(0.0, f64::max))
                    .max(wide(heading, true) * 0.6)
            })
            .collect();
        let total: f64 = natural.iter().sum();
        if total <= FULL_WIDTH {
            let each = (FULL_WIDTH - total) / natural.len().max(1) as f64;
            return natural.iter().map(|w| w + each).collect();
        }
        // Columns below the share that is left to the others keep their width.
        let mut share = FULL_WIDTH / natural.len() as f64;
        for _ in 0..natural.len() {
            let narrow: f64 = natural.iter().filter(|w| **w <= share).sum();
            let others = natural.iter().filter(|w| **w > share).count();
            if others == 0 {
                break;
            }
            share = (FULL_WIDTH - narrow) / others as f64;
        }
        natural.iter().map(|w| w.min(share)).collect()
    }
}

/// A table's columns, head and rows as they are wrapped.
pub(super) struct TableLayout {
    /// Points.
    widths: Vec<f64>,
    head: Vec<Vec<String>>,
    rows: Vec<Vec<Vec<String>>>,
}

impl TableLayout {
    /// What it needs to begin on a page: all of it, or where that would leave much of a page empty its first rows.
    pub(super) fn least_height(&self) -> f64 {
        let of = |rows: usize| {
            let rows = self.rows.iter().take(rows).map(|row| row_height(row));
            row_height(&self.head) + rows.sum::<f64>()
        };
        let whole = of(self.rows.len());
        if whole <= MOST_WHOLE * (BOTTOM - TOP) {
            whole
        } else {
            of(FEWEST_ROWS)
        }
    }
}

/// The rows before which a page begins, where so much room (points) is left on this page and so much
/// is on a whole one. The last page has at least two rows where the one before it can spare one.
fn table_breaks(heights: &[f64], first_page: f64, whole_page: f64) -> Vec<usize> {
    let mut breaks: Vec<usize> = Vec::new();
    let (mut left, mut on_this_page) = (first_page, 0);
    for (k, height) in heights.iter().enumerate() {
        if *height > left && on_this_page > 0 {
            breaks.push(k);
            (left, on_this_page) = (whole_page, 0);
        }
        left -= height;
        on_this_page += 1;
    }
    if let Some(last) = breaks.pop() {
        let before = breaks.last().copied().unwrap_or(0);
        let alone = last + 1 == heights.len() && last > before + FEWEST_ROWS;
        let fits = alone && heights[last - 1] + heights[last] <= whole_page;
        breaks.push(if fits { last - 1 } else { last });
    }
    breaks
}

fn row_height(cells: &[Vec<String>]) -> f64 {
    let lines = cells.iter().map(Vec::len).max().unwrap_or(1);
    11.0 * lines as f64 + 5.2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_breaks_where_rows_no_longer_fit_and_leaves_no_row_alone() {
        // Four rows fit on the first page, ten on another.
        assert_eq!(table_breaks(&[10.0; 4], 40.0, 100.0), Vec::<usize>::new());
        assert_eq!(table_breaks(&[10.0; 6], 40.0, 100.0), vec![4]);
        assert_eq!(table_breaks(&[10.0; 5], 40.0, 100.0), vec![3]);
        assert_eq!(table_breaks(&[10.0; 15], 40.0, 100.0), vec![4, 13]);
        // A page whose two rows are all that it has keeps them.
        assert_eq!(table_breaks(&[20.0; 3], 40.0, 100.0), vec![2]);
        // A row that is higher than a page stands on one of its own.
        assert_eq!(table_breaks(&[10.0, 500.0, 10.0], 40.0, 100.0), vec![1, 2]);
        assert_eq!(table_breaks(&[], 40.0, 100.0), Vec::<usize>::new());
    }
}
