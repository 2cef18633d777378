//! How a robot changed from session to session, as a table.
//!
//! Values are in the units of the files. What belongs to the measuring set-up is left out.

use std::path::Path;

use super::names::{parameter, title_on};
use super::numbers::{grouped, plain, with_interval};
use super::table::Table;
use crate::fit::Estimate;
use crate::history::{Change, Entry, RobotHistory, Source};

/// Changes of an entry that are listed; `--json` has all.
const MOST: usize = 3;

/// A parameter's name with all that tells it from others.
fn name(one: &Estimate, joints: usize) -> String {
    let mut name = title_on(one.effect, one.joint, joints);
    for place in [&one.setup, &one.target, &one.place].into_iter().flatten() {
        name += &format!(", {place}");
    }
    format!("{name}: {}", parameter(one.name).0)
}

/// What an entry comes from, in words.
fn source(entry: &Entry) -> &'static str {
    match entry.source {
        Source::Session => say!("Session"),
        Source::Model => say!("Model"),
    }
}

/// An entry's file without its ending.
fn short_name(entry: &Entry) -> String {
    let stem = Path::new(&entry.file).file_stem();
    stem.unwrap_or_default().to_string_lossy().into_owned()
}

/// Sessions and models with their errors and with what changed by more than its interval, the earliest first.
pub fn entries(robot: &RobotHistory) -> Table {
    let mut table = Table::headed(say!(
        "Session | From | >Samples | >RMS error nominal, mm | >Model, mm | >With the earliest, mm | Changed by"
    ));
    let all = robot.entries.iter().flat_map(|entry| &entry.parameters);
    let joints = all.filter_map(|one| one.joint).max().unwrap_or(1);
    let dash = || "–".to_owned();
    for entry in &robot.entries {
        let mut changes: Vec<&Change> = entry.changes.iter().collect();
        changes.retain(|change| change.is_significant());
        // Those that exceed their interval by most come first.
        let half = |change: &Change| change.ci95.map_or(f64::INFINITY, |[from, to]| to - from);
        let times = |change: &Change| change.difference.abs() / half(change);
        changes.sort_by(|a, b| times(b).total_cmp(&times(a)));
        let more = changes.len().saturating_sub(MOST);
        let said = |change: &&Change| {
            let one = &entry.parameters[change.parameter];
            let [by, half, _] = with_interval(change.difference, change.ci95);
            let (name, unit) = (name(one, joints), parameter(one.name).1);
            format!("{name} {by} {half} {unit}").trim_end().to_owned()
        };
        let mut changes: Vec<String> = changes.iter().take(MOST).map(said).collect();
        if more > 0 {
            changes.push(say!("and {more} more", more));
        }
        table.row([
            short_name(entry),
            source(entry).to_owned(),
            entry.samples.map_or_else(dash, grouped),
            plain(entry.before_mm),
            plain(entry.after_mm),
            entry.with_first_mm.map_or_else(dash, plain),
            if changes.is_empty() {
                dash()
            } else {
                changes.join("; ")
            },
        ]);
    }
    table
}
