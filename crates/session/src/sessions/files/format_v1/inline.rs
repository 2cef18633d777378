//! Samples inside the document: `"columns": { "q1_deg": [...], "x_mm": [...] }`.
//!
//! The names are the headings of a CSV file, null is an empty cell, and texts stand in quotes.

use crate::diagnostic::Place;
use crate::document::{Fields, Member, Node, Path, Source, Value, element_offset};
use crate::kinematics::Joint;
use crate::sessions::layout::Layout;
use crate::sessions::table::Table;
use crate::tables::CellKind;
use crate::tables::Lines;
use crate::tables::{Cells, Names};

/// A table and where its columns stand in the document, so that a finding can name its place.
pub(crate) struct Inline {
    pub(crate) table: Table,
    /// Name and first byte of each array.
    columns: Vec<(String, usize)>,
}

impl Inline {
    /// Takes the place of each cell from the document.
    pub(crate) fn locator<'a>(
        &self,
        source: &'a Source<'a>,
    ) -> impl Fn(usize, usize) -> Place + use<'a> {
        let columns = self.columns.clone();
        move |column, row| {
            let (name, at) = &columns[column];
            source
                .place(element_offset(source, *at, row))
                .in_field(format!("samples.columns.{name}[{row}]"))
        }
    }
}

/// Reads the columns; what is wrong with them goes to the findings.
pub(crate) fn read(
    fields: &mut Fields<'_>,
    node: Node,
    joints: Option<&[Joint]>,
) -> Option<Inline> {
    let samples = Path::Root.key("samples");
    let path = &samples.key("columns");
    let at = node.at;
    let Value::Object(members) = node.value else {
        fields.mismatch(
            &node,
            path,
            text!("an object with an array for each column"),
        );
        return None;
    };
    let names: Vec<String> = members
        .iter()
        .map(|member| member.key.trim().to_owned())
        .collect();
    let mut findings = Vec::new();
    let layout = {
        let place = |index: usize| {
            let member: &Member = &members[index];
            fields.place(member.key_at, &path.key(&member.key))
        };
        Layout::read(
            &names,
            joints,
            &fields.place(at, path),
            &place,
            &mut findings,
        )
    };
    fields.findings.append(&mut findings);
    let mut columns = Vec::new();
    let mut cells = Vec::new();
    for (member, heading) in members.into_iter().zip(&layout.headings) {
        let path = &path.key(&member.key);
        columns.push((member.key.clone(), member.node.at));
        cells.push(column(fields, member.node, path, heading.cells()));
    }
    let cells: Vec<Cells> = cells.into_iter().collect::<Option<_>>()?;
    let rows = cells.first().map_or(0, Cells::len);
    let same = cells
        .iter()
        .zip(&columns)
        .fold(true, |same, (cells, (name, at))| {
            if cells.len() != rows {
                let found = text!(one "{count} value", "{count} values", count = cells.len());
                let expected = text!("{rows}, as many as samples", rows);
                fields.error(*at, &path.key(name), found, expected);
            }
            same && cells.len() == rows
        });
    same.then_some(Inline {
        table: Table {
            layout,
            names,
            columns: cells,
            line: Lines::default(),
        },
        columns,
    })
}

fn column(fields: &mut Fields<'_>, node: Node, path: &Path<'_>, kind: CellKind) -> Option<Cells> {
    let expected = match kind {
        CellKind::Number => phrase!("an array of numbers (null where one is missing)"),
        CellKind::Name => phrase!("an array of texts (null where one is missing)"),
        CellKind::Text => phrase!("an array"),
    };
    match (kind, node.value) {
        (CellKind::Number, Value::Numbers(values)) => {
            if let Some(row) = values.iter().position(|value| value.is_infinite()) {
                let expected = text!("a number that a double can hold");
                let found = text!("a number that overflows");
                fields.element_error(node.at, path, row, found, expected);
                return None;
            }
            Some(Cells::Numbers(values))
        }
        (CellKind::Name | CellKind::Text, Value::Numbers(values)) => {
            // Names such as 1, 2, 3 are written without quotes easily enough.
            let cell = |value: &f64| (!value.is_nan()).then(|| value.to_string());
            let cells = values.iter().map(cell).map(Option::unwrap_or_default);
            Some(text_cells(kind, cells))
        }
        (_, Value::List(list)) => {
            let is_right = |cell: &Value| match cell {
                Value::Null => true,
                Value::Text(_) => kind != CellKind::Number,
                Value::Number(_) => kind != CellKind::Name,
                _ => kind == CellKind::Text,
            };
            let mut cells = list.iter().enumerate();
            let wrong = cells.find(|(_, cell)| !is_right(&cell.value));
            if let Some((index, first)) = wrong {
                let found = first.value.describe();
                fields.error(first.at, &path.index(index), found, expected);
                return None;
            }
            Some(match kind {
                CellKind::Number => Cells::Numbers(vec![f64::NAN; list.len()]),
                _ => text_cells(kind, list.iter().map(|cell| plain_text(&cell.value))),
            })
        }
        (_, value) => {
            fields.mismatch(&Node { at: node.at, value }, path, expected);
            None
        }
    }
}

fn text_cells(kind: CellKind, cells: impl Iterator<Item = String>) -> Cells {
    if kind == CellKind::Text {
        return Cells::Text(cells.collect());
    }
    let mut names = Names::default();
    for cell in cells {
        names.push(&cell);
    }
    Cells::Names(names)
}

fn plain_text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::Text(text) => text.clone(),
        other => other.describe().to_string(),
    }
}
