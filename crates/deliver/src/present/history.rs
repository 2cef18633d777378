//! How a robot changed from session to session, as tables.
//!
//! Values are in the units of the files. What belongs to the measuring set-up is left out.

use std::path::Path;

use super::chart::shortened;
use super::names::{parameter, title_on};
use super::numbers::{grouped, plain, with_interval};
use super::table::{Cell, Column, Table};
use crate::fit::Estimate;
use crate::history::{Change, Entry, RobotHistory, Source, is_of_set_up, is_same};

/// What stands behind a value that changed by more than its interval.
pub const CHANGED: &str = "●";

/// A parameter through all entries of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<'a> {
    /// Its name, with effect, joint and place.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its value in each entry; `None` where an entry has none.
    pub values: Vec<Option<Value>>,
    of: &'a Estimate,
}

/// A value with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// The value.
    pub value: f64,
    /// Its interval; `None` where it is not determined.
    pub ci95: Option<[f64; 2]>,
    /// Whether it changed by more than its interval since the entry of the same source before.
    pub changed: bool,
}

/// The parameters of a robot, in the order in which they occur.
pub fn rows(robot: &RobotHistory) -> Vec<Row<'_>> {
    let mut rows: Vec<Row<'_>> = Vec::new();
    let all = robot.entries.iter().flat_map(|entry| &entry.parameters);
    let joints = all.filter_map(|one| one.joint).max().unwrap_or(1);
    for (k, entry) in robot.entries.iter().enumerate() {
        let own = entry.parameters.iter().enumerate();
        for (p, one) in own.filter(|(_, one)| !is_of_set_up(one)) {
            let there = rows.iter().position(|row| is_same(row.of, one));
            let at = there.unwrap_or_else(|| {
                rows.push(Row {
                    name: name(one, joints),
                    unit: parameter(one.name).1,
                    values: vec![None; robot.entries.len()],
                    of: one,
                });
                rows.len() - 1
            });
            let is_changed = |c: &Change| c.parameter == p && c.is_significant();
            rows[at].values[k] = Some(Value {
                value: one.value,
                ci95: one.ci95,
                changed: entry.changes.iter().any(is_changed),
            });
        }
    }
    rows
}

/// A parameter's name with all that tells it from others.
fn name(one: &Estimate, joints: usize) -> String {
    let mut name = title_on(one.effect, one.joint, joints);
    for place in [&one.setup, &one.target, &one.place].into_iter().flatten() {
        name += &format!(", {place}");
    }
    format!("{name}: {}", parameter(one.name).0)
}

/// What an entry comes from, in words.
pub fn source(entry: &Entry) -> &'static str {
    match entry.source {
        Source::Session => say!("Session"),
        Source::Model => say!("Model"),
    }
}

/// An entry's name where there is little room: its file without the ending.
pub fn short_name(entry: &Entry) -> String {
    let stem = Path::new(&entry.file).file_stem();
    stem.map_or_else(
        || entry.file.clone(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}

/// Sessions and models with their errors, the earliest first.
pub fn entries(robot: &RobotHistory) -> Table {
    let mut table = Table::headed(say!(
        "Session | From | >Samples | >RMS error nominal, mm | >Model, mm | >With the earliest, mm | >Changed"
    ));
    let dash = || "–".to_owned();
    for entry in &robot.entries {
        let changed = entry.changes.iter().filter(|c| c.is_significant()).count();
        table.row([
            short_name(entry),
            source(entry).to_owned(),
            entry.samples.map_or_else(dash, grouped),
            plain(entry.before_mm),
            plain(entry.after_mm),
            entry.with_first_mm.map_or_else(dash, plain),
            if entry.changes.is_empty() {
                dash()
            } else {
                say!(
                    "{inside} of {all}",
                    inside = changed,
                    all = entry.changes.len()
                )
            },
        ]);
    }
    table
}

/// Parameters through these entries.
pub fn parameters(robot: &RobotHistory, shown: &[usize]) -> Table {
    let heads = shown.iter().filter_map(|k| robot.entries.get(*k));
    let heads = heads.map(|entry| Column::numbers(shortened(&short_name(entry), 24)));
    let mut table = Table::headed(say!("Parameter | Unit"));
    table.columns.extend(heads);
    for row in rows(robot) {
        let cells = shown.iter().map(|k| row.values.get(*k).copied().flatten());
        let cells = cells.map(|value| Cell::number(value.map(|v| v.value), |_| describe(value)));
        let fixed = [row.name.into(), row.unit.into()];
        table.row(fixed.into_iter().chain(cells));
    }
    table
}

fn describe(value: Option<Value>) -> String {
    let Some(value) = value else {
        return "–".to_owned();
    };
    let [shown, half, _] = with_interval(value.value, value.ci95);
    let changed = if value.changed { CHANGED } else { "" };
    format!("{shown} {half} {changed}").trim_end().to_owned()
}
