//! Which line of its file each row is on.
//!
//! Rows follow each other line by line, but for a blank line here and a line feed in quotes there:
//! only the places where a row is not on the line after its predecessor's are kept. The million
//! rows of a regular file take as much memory as one.

/// The line of each row, counted from 1; empty where rows have no lines (inline, simulated).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Lines {
    /// Ordered by row; no run goes on where the one before it ends.
    runs: Vec<Run>,
    rows: usize,
}

/// Rows on consecutive lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Run {
    first_row: usize,
    first_line: u64,
}

impl Run {
    fn line(self, row: usize) -> u64 {
        self.first_line + (row - self.first_row) as u64
    }
}

impl Lines {
    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether rows have no lines, or there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// The line of a row (counted from 0).
    #[must_use]
    pub fn get(&self, row: usize) -> Option<u64> {
        if row >= self.rows {
            return None;
        }
        let after = self.runs.partition_point(|run| run.first_row <= row);
        Some(self.runs.get(after.checked_sub(1)?)?.line(row))
    }

    /// Appends `count` rows that start on `line` and the lines after it.
    pub(crate) fn add(&mut self, line: u64, count: usize) {
        let goes_on = |run: &Run| run.line(self.rows) == line;
        if count > 0 && !self.runs.last().is_some_and(goes_on) {
            self.runs.push(Run {
                first_row: self.rows,
                first_line: line,
            });
        }
        self.rows += count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_found_however_its_neighbours_came() {
        let lines = [2, 3, 4, 6, 7, 100, 102, 103];
        let mut one_by_one = Lines::default();
        for line in lines {
            one_by_one.add(line, 1);
        }
        let mut in_runs = Lines::default();
        for (line, count) in [(2, 2), (4, 1), (6, 2), (9, 0), (100, 1), (102, 2)] {
            in_runs.add(line, count);
        }
        assert_eq!(one_by_one, in_runs);
        assert_eq!(in_runs.runs.len(), 4);
        let back: Vec<u64> = (0..).map_while(|row| in_runs.get(row)).collect();
        assert_eq!(back, lines);
    }
}
