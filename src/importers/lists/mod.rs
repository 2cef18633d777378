//! Lists as programs print them, read as a table: a bracketed row a line, lists of lists (JSON, Python,
//! numpy, MATLAB), YAML sequences and mappings, `ros2 topic echo` of joint states.
//!
//! ```text
//! text → tree of lists and mappings → rows of cells → the same rows as comma-separated lines
//! ```
//!
//! The rows are written on the lines on which they begin, so that every message names the right place.
//! What is no such text as a whole stays as it is.

mod tree;

use crate::text::Text;
use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::importers::headings::understand;
use crate::importers::role::Role;
use crate::tables::decimals::shape;
use tree::Node;

/// A text of lists as a text of rows.
pub(crate) struct Listed {
    pub(crate) text: String,
    /// What was made of it, for a note.
    pub(crate) note: Text,
}

/// One row: where it begins, what it is called, its headings if it brings them, its cells.
#[derive(Debug, Clone, Default)]
struct Row {
    line: u64,
    key: Option<String>,
    headings: Vec<String>,
    cells: Vec<String>,
}

/// The rows of a text of lists; the text itself where it is none.
pub(crate) fn as_rows<'a>(text: Cow<'a, str>, says: &mut Option<Text>) -> Cow<'a, str> {
    match read(&text) {
        Some(listed) => {
            *says = Some(listed.note);
            Cow::Owned(listed.text)
        }
        None => text,
    }
}

fn read(text: &str) -> Option<Listed> {
    if let Some(listed) = rows_in_one_line(text) {
        return Some(listed);
    }
    let nodes = tree::parse(text)?;
    let mut rows = Vec::new();
    for node in &nodes {
        gather(node, None, &mut rows);
    }
    rows.retain(|row| !row.cells.is_empty());
    // Words with their values, one below the other, are the head of something else.
    if let [only] = &rows[..]
        && !only.headings.is_empty()
        && !only.cells.iter().all(|cell| shape(cell).is_some())
    {
        return None;
    }
    let numbers = rows
        .iter()
        .flat_map(|row| &row.cells)
        .filter(|cell| shape(cell).is_some());
    numbers.count().checked_sub(1)?;
    rows = of_one_kind(rows);
    let transposed = columns(&rows);
    let rows = transposed.unwrap_or(rows);
    Some(written(&rows))
}

/// `1 2 3; 4 5 6`: rows between semicolons, where they are all that there is.
fn rows_in_one_line(text: &str) -> Option<Listed> {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let (line, None) = (lines.next()?, lines.next()) else {
        return None;
    };
    let rows: Vec<Vec<&str>> = line
        .split(';')
        .map(|row| {
            row.split_whitespace()
                .map(|cell| cell.trim_end_matches(','))
                .collect()
        })
        .filter(|row: &Vec<&str>| !row.is_empty())
        .collect();
    let width = rows.first()?.len();
    let numbers = rows.iter().flatten().all(|cell| shape(cell).is_some());
    if rows.len() < 2 || width < 2 || !numbers || rows.iter().any(|row| row.len() != width) {
        return None;
    }
    let rows: Vec<Row> = rows
        .iter()
        .map(|cells| Row {
            line: 1,
            cells: cells.iter().map(|&cell| cell.to_owned()).collect(),
            ..Row::default()
        })
        .collect();
    Some(written(&rows))
}

/// Words under which a list of joints' names stands, and one of their values.
const NAMES: [&str; 3] = ["name", "names", "joint_names"];
const VALUES: [&str; 8] = [
    "position",
    "positions",
    "joint_positions",
    "joints",
    "q",
    "joint_values",
    "values",
    "point",
];

fn scalars(node: &Node) -> Option<Vec<String>> {
    let Node::List(items, _) = node else {
        return None;
    };
    let cells: Option<Vec<String>> = items
        .iter()
        .map(|item| match item {
            Node::Scalar(text, _) => Some(text.clone()),
            _ => None,
        })
        .collect();
    cells.filter(|cells| !cells.is_empty())
}

fn is_text(cells: &[String]) -> bool {
    cells.iter().all(|cell| shape(cell).is_none())
}

fn gather(node: &Node, key: Option<&str>, rows: &mut Vec<Row>) {
    match node {
        Node::Scalar(..) => {}
        Node::List(items, line) => {
            if let Some(cells) = scalars(node) {
                rows.push(Row {
                    line: *line,
                    key: key.map(str::to_owned),
                    cells,
                    ..Row::default()
                });
                return;
            }
            // A name and its list.
            if let [Node::Scalar(name, _), list] = &items[..]
                && let Some(cells) = scalars(list)
            {
                rows.push(Row {
                    line: *line,
                    key: Some(name.clone()),
                    cells,
                    ..Row::default()
                });
                return;
            }
            for item in items {
                gather(item, key, rows);
            }
        }
        Node::Map(entries, line) => gather_map(entries, *line, rows),
    }
}

/// The leaves of a mapping: scalars under their path, and everything that is a list.
fn leaves<'a>(
    entries: &'a [(String, Node)],
    path: &str,
    scalar: &mut Vec<(String, String)>,
    lists: &mut Vec<(String, &'a Node)>,
) {
    for (key, node) in entries {
        let name = match path {
            "" => key.clone(),
            path => format!("{path}_{key}"),
        };
        match node {
            Node::Scalar(text, _) => scalar.push((name, text.clone())),
            Node::List(..) => lists.push((name, node)),
            Node::Map(inner, _) => leaves(inner, &name, scalar, lists),
        }
    }
}

fn gather_map(entries: &[(String, Node)], line: u64, rows: &mut Vec<Row>) {
    let (mut scalar, mut lists) = (Vec::new(), Vec::new());
    leaves(entries, "", &mut scalar, &mut lists);
    lists.retain(|(_, node)| !matches!(node, Node::List(items, _) if items.is_empty()));
    if lists.is_empty() {
        if scalar.len() > 1 {
            let (headings, cells) = scalar.into_iter().unzip();
            rows.push(Row {
                line,
                headings,
                cells,
                ..Row::default()
            });
        }
        return;
    }
    // Joint states: their names and as many values.
    let last = |path: &str| {
        path.rsplit_once('.')
            .map_or(path, |(_, last)| last)
            .to_owned()
    };
    let names = lists.iter().find_map(|(key, node)| {
        let cells = scalars(node).filter(|cells| is_text(cells))?;
        NAMES.contains(&last(key).as_str()).then_some(cells)
    });
    if let Some(names) = names {
        let values = VALUES.iter().find_map(|wanted| {
            let (_, node) = lists.iter().find(|(key, _)| last(key) == *wanted)?;
            scalars(node).filter(|cells| cells.len() == names.len())
        });
        if let Some(values) = values {
            let mut row = Row {
                line,
                headings: names,
                cells: values,
                ..Row::default()
            };
            if let Some(time) = stamp(&scalar) {
                row.headings.insert(0, "time_s".to_owned());
                row.cells.insert(0, time);
            }
            rows.push(row);
            return;
        }
    }
    // A name and one list of numbers.
    if let [(_, list)] = &lists[..]
        && let Some(cells) = scalars(list)
    {
        let is_name = |(key, _): &&(String, String)| {
            matches!(key.as_str(), "name" | "id" | "label" | "pose" | "point")
        };
        rows.push(Row {
            line,
            key: scalar.iter().find(is_name).map(|(_, name)| name.clone()),
            cells,
            ..Row::default()
        });
        return;
    }
    for (key, list) in lists {
        gather(list, Some(&key), rows);
    }
}

/// The time of a message's header, s.
fn stamp(scalar: &[(String, String)]) -> Option<String> {
    let of = |names: [&str; 2]| {
        let found = scalar
            .iter()
            .find(|(key, _)| names.iter().any(|name| key.ends_with(name)));
        found.and_then(|(_, text)| text.parse::<u64>().ok())
    };
    let seconds = of(["stamp_sec", "stamp_secs"])?;
    let nanoseconds = of(["stamp_nanosec", "stamp_nsecs"])?;
    (nanoseconds < 1_000_000_000).then(|| format!("{seconds}.{nanoseconds:09}"))
}

/// Of rows under several keys that recur (`position`, `velocity`) those of one: of the values, else of
/// the first. Keys that all rows share say nothing.
fn of_one_kind(mut rows: Vec<Row>) -> Vec<Row> {
    let keys: Vec<&String> = rows.iter().filter_map(|row| row.key.as_ref()).collect();
    let distinct: BTreeSet<&String> = keys.iter().copied().collect();
    if keys.len() < rows.len() || distinct.len() == keys.len() {
        return rows;
    }
    let wanted = VALUES
        .iter()
        .find(|wanted| distinct.iter().any(|key| key == *wanted));
    let wanted = wanted.map_or_else(|| keys[0].clone(), |wanted| (*wanted).to_owned());
    rows.retain(|row| row.key.as_ref() == Some(&wanted));
    for row in &mut rows {
        row.key = None;
    }
    rows
}

/// Lists under headings of a table are its columns.
fn columns(rows: &[Row]) -> Option<Vec<Row>> {
    let length = rows.first()?.cells.len();
    let is_heading = |row: &Row| {
        let key = row.key.as_deref();
        row.cells.len() == length && key.is_some_and(|key| understand(key) != Role::Kept)
    };
    if rows.len() < 2 || !rows.iter().all(is_heading) {
        return None;
    }
    let headings: Vec<String> = rows.iter().filter_map(|row| row.key.clone()).collect();
    let row = |at: usize| Row {
        line: rows[0].line + at as u64,
        headings: headings.clone(),
        cells: rows.iter().map(|column| column.cells[at].clone()).collect(),
        ..Row::default()
    };
    Some((0..length).map(row).collect())
}

/// The rows as lines.
fn written(rows: &[Row]) -> Listed {
    let mut headings: Vec<String> = Vec::new();
    if rows.iter().all(|row| !row.headings.is_empty()) {
        for heading in rows.iter().flat_map(|row| &row.headings) {
            if !headings.contains(heading) {
                headings.push(heading.clone());
            }
        }
    }
    let named = headings.is_empty() && rows.iter().all(|row| row.key.is_some());
    let (mut text, mut line) = (String::new(), 1);
    let mut put = |at: u64, cells: &mut dyn Iterator<Item = &str>| {
        while line < at {
            text.push('\n');
            line += 1;
        }
        for (index, cell) in cells.enumerate() {
            if index > 0 {
                text.push(',');
            }
            if cell.contains([',', '"', '\n', ' ', '#']) {
                text.push('"');
                text.push_str(&cell.replace('"', "\"\""));
                text.push('"');
            } else {
                text.push_str(cell);
            }
        }
        text.push('\n');
        line += 1;
    };
    let first = rows.first().map_or(1, |row| row.line);
    if !headings.is_empty() {
        put(
            first.saturating_sub(1).max(1),
            &mut headings.iter().map(String::as_str),
        );
    }
    for row in rows {
        if headings.is_empty() {
            let name = row.key.as_deref().filter(|_| named);
            put(
                row.line,
                &mut name.into_iter().chain(row.cells.iter().map(String::as_str)),
            );
        } else {
            let cell = |heading: &String| {
                let at = row.headings.iter().position(|own| own == heading);
                at.and_then(|at| row.cells.get(at))
                    .map_or("", String::as_str)
            };
            put(row.line, &mut headings.iter().map(cell));
        }
    }
    let width = rows
        .first()
        .map_or(0, |row| row.cells.len() + usize::from(named));
    Listed {
        text,
        note: text!(
            "lists, read as a table of {rows} rows and {columns} columns",
            rows = rows.len(),
            columns = width
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines of what is made of a text, without blank ones.
    fn rows(text: &str) -> Option<Vec<String>> {
        let listed = read(text)?;
        let lines = listed.text.lines().filter(|line| !line.is_empty());
        Some(lines.map(str::to_owned).collect())
    }

    #[test]
    fn lists_are_read_however_they_are_printed() {
        let expected = ["0.1,-0.2,3e-1", "1,2,3"].map(str::to_owned).to_vec();
        for text in [
            "[0.1, -0.2, 3e-1]\n[1, 2, 3]\n",
            "# poses\n[0.1 -0.2 3e-1]\n[1 2 3]\n",
            "[[0.1, -0.2, 3e-1], [1, 2, 3]]",
            "[[ 0.1 -0.2\n   3e-1]\n [1 2 3]]\n",
            "q = [0.1 -0.2 3e-1; 1 2 3];\n",
            "q = [0.1 -0.2 3e-1\n 1 2 3];\n",
            "array([[0.1, -0.2, 3e-1],\n       [1, 2, 3]], dtype=float32)\n",
            "- [0.1, -0.2, 3e-1]\n- [1, 2, 3]  # home\n",
            "- - 0.1\n  - -0.2\n  - 3e-1\n- - 1\n  - 2\n  - 3\n",
            "-\n  - 0.1\n  - -0.2\n  - 3e-1\n-\n  - 1\n  - 2\n  - 3\n",
            "poses:\n  - [0.1, -0.2, 3e-1]\n  - [1, 2, 3]\n",
            "poses:\n- position: [0.1, -0.2, 3e-1]\n  velocity: [0, 0, 0]\n- position: [1, 2, 3]\n  velocity: [0, 0, 0]\n",
            "{\"poses\": [[0.1, -0.2, 3e-1],\n[1, 2, 3]]}",
            "0.1 -0.2 3e-1; 1 2 3",
            "(0.1, -0.2, 3e-1),\n(1, 2, 3)\n",
        ] {
            assert_eq!(rows(text).as_ref(), Some(&expected), "{text}");
        }
    }

    #[test]
    fn names_and_headings_come_along() {
        for (text, expected) in [
            ("P1: [1, 2]\nP2: [3, 4]\n", vec!["P1,1,2", "P2,3,4"]),
            (
                "- name: P1\n  joints: [1, 2]\n- name: P2\n  joints: [3, 4]\n",
                vec!["P1,1,2", "P2,3,4"],
            ),
            (
                "- {x_mm: 1, y_mm: 2}\n- {x_mm: 3, y_mm: 4}\n",
                vec!["x_mm,y_mm", "1,2", "3,4"],
            ),
            (
                "- x_mm: 1\n  y_mm: 2\n- x_mm: 3\n  y_mm: 4\n",
                vec!["x_mm,y_mm", "1,2", "3,4"],
            ),
            (
                "q1_deg: [1, 2, 3]\nx_mm: [4, 5, 6]\n",
                vec!["q1_deg,x_mm", "1,4", "2,5", "3,6"],
            ),
            (
                "header:\n  stamp:\n    sec: 12\n    nanosec: 5000000\n  frame_id: ''\nname:\n- pan\n- tilt\nposition:\n- 0.1\n- 0.2\nvelocity: []\n---\nheader:\n  stamp:\n    sec: 13\n    nanosec: 0\nname:\n- pan\n- tilt\nposition:\n- 0.3\n- 0.4\n---\n",
                vec![
                    "time_s,pan,tilt",
                    "12.005000000,0.1,0.2",
                    "13.000000000,0.3,0.4",
                ],
            ),
        ] {
            let expected: Vec<String> = expected.into_iter().map(str::to_owned).collect();
            assert_eq!(rows(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn rows_stay_on_their_lines() {
        let listed = read("# a\n\n[1, 2]\n# b\n[3, 4]\n").unwrap();
        assert_eq!(listed.text, "\n\n1,2\n\n3,4\n");
    }

    #[test]
    fn tables_and_prose_stay_as_they_are() {
        for text in [
            "x,y\n1,2\n3,4\n",
            "Units: mm\nx;y;z\n1;2;3\n",
            "[X] [Y] [Z]\n1 2 3\n",
            "-0.1 0.2 0.3\n-0.4 0.5 0.6\n",
            "hello\nworld\n",
            "[1, 2\n",
            "Report: 12\nDate: today\n",
            "",
            "P1 1 2 3\n",
            "1;2;3\n4;5;6\n",
        ] {
            assert!(rows(text).is_none(), "{text}");
        }
        let deep = "[".repeat(100_000);
        assert!(rows(&deep).is_none());
        assert!(rows(&"- ".repeat(100_000)).is_none());
    }
}
