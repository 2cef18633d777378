//! The columns of a table, in its own units.

use std::collections::BTreeMap;

/// What kind of cells a column has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CellKind {
    Number,
    /// Few different names.
    Name,
    /// Kept as it stands.
    Text,
}

/// Few different names in many cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Names {
    /// In the order in which they first occur.
    pub(crate) list: Vec<String>,
    /// Index into `list`, one per row.
    pub(crate) index: Vec<u32>,
    /// Where each name is in `list`; only kept when a linear search would be slow.
    index_of: BTreeMap<String, u32>,
}

impl Names {
    /// Up to here looking through all names is quicker than anything else.
    const FEW: usize = 16;

    /// Appends a cell.
    pub(crate) fn push(&mut self, name: &str) {
        let last = self.index.last().copied();
        let index = match last {
            Some(last) if self.list[last as usize] == name => last,
            _ => self.intern(name),
        };
        self.index.push(index);
    }

    fn intern(&mut self, name: &str) -> u32 {
        let next = u32::try_from(self.list.len()).expect("a table has fewer than 2^32 rows");
        if self.list.len() < Self::FEW {
            let known = self.list.iter().zip(0..).find(|(other, _)| *other == name);
            if let Some((_, index)) = known {
                return index;
            }
        } else {
            if self.index_of.is_empty() {
                self.index_of = self.list.iter().cloned().zip(0..).collect();
            }
            if let Some(index) = self.index_of.get(name) {
                return *index;
            }
            self.index_of.insert(name.to_owned(), next);
        }
        self.list.push(name.to_owned());
        next
    }
}

/// The cells of one column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cells {
    /// NaN where the cell is empty; in the unit of the heading.
    Numbers(Vec<f64>),
    /// An empty name where the cell is empty.
    Names(Names),
    /// As they stand.
    Text(Vec<String>),
}

impl Cells {
    pub(crate) fn of(kind: CellKind, capacity: usize) -> Self {
        match kind {
            CellKind::Number => Self::Numbers(Vec::with_capacity(capacity)),
            CellKind::Name => Self::Names(Names::default()),
            CellKind::Text => Self::Text(Vec::new()),
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Names(names) => names.index.len(),
            Self::Text(cells) => cells.len(),
        }
    }

    /// Appends an empty cell.
    pub(crate) fn push_missing(&mut self) {
        match self {
            Self::Numbers(values) => values.push(f64::NAN),
            Self::Names(names) => names.push(""),
            Self::Text(cells) => cells.push(String::new()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_the_order_in_which_they_come() {
        let mut names = Names::default();
        let cells: Vec<String> = (0..100).map(|i| format!("T{}", (i * 7) % 40)).collect();
        for cell in &cells {
            names.push(cell);
        }
        assert_eq!(names.list.len(), 40);
        assert_eq!(names.list[..3], ["T0", "T7", "T14"]);
        let back: Vec<&String> = names
            .index
            .iter()
            .map(|&i| &names.list[i as usize])
            .collect();
        assert!(back.iter().zip(&cells).all(|(back, cell)| *back == cell));
    }
}
