//! `truepose history`: what became of the robots of a folder.

use std::path::PathBuf;

use clap::Args;

use crate::history::{Change, Entry, History as Told};
use crate::pipeline::history;
use crate::present::history_v1::document;
use crate::present::numbers::decimals_of;

use super::failure::Failure;
use super::output;

/// Compare the sessions and models of a folder: how parameters and errors change over time
#[derive(Debug, Args)]
pub(crate) struct History {
    /// Folder with sessions and models; folders in it are not looked into
    folder: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl History {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let told = history(&self.folder)?;
        let not_read = told.not_read.iter();
        let lines: Vec<String> = not_read
            .map(|file| format!("{} is excluded: {}", file.file, file.because))
            .collect();
        output::messages(&lines);
        if self.json {
            output::json(&document(&told))
        } else {
            output::text(&in_words(&told))
        }
    }
}

fn in_words(told: &Told) -> String {
    let mut text = String::new();
    for robot in &told.robots {
        text += &format!("{} ({})\n", robot.robot, robot.ordered_by.in_words());
        for entry in &robot.entries {
            text += &entry_in_words(entry);
        }
    }
    text
}

fn entry_in_words(entry: &Entry) -> String {
    let samples = entry
        .samples
        .map_or_else(String::new, |n| format!(", {n} samples"));
    let mut text = format!(
        "  {} ({}{samples}): RMS error {:.4} mm nominal, {:.4} mm after identification",
        entry.file,
        entry.source.name(),
        entry.before_mm,
        entry.after_mm
    );
    if let Some(first) = entry.with_first_mm {
        text += &format!(", {first:.4} mm with the earliest");
    }
    text += "\n";
    let Some(since) = entry.changes.first().map(|change| &change.since) else {
        return text;
    };
    let changed: Vec<&Change> = entry
        .changes
        .iter()
        .filter(|c| c.is_significant())
        .collect();
    let (count, of) = (changed.len(), entry.changes.len());
    text += &format!(
        "    changed since {since} by more than the interval: {count} of {of} parameters\n"
    );
    for change in changed {
        let estimate = &entry.parameters[change.parameter];
        let joint = estimate
            .joint
            .map_or_else(String::new, |joint| format!(" {joint}"));
        let target = estimate
            .target
            .as_ref()
            .map_or_else(String::new, |t| format!(" {t}"));
        let place = estimate.place.as_ref();
        let place = place.map_or_else(String::new, |place| format!(" {place}"));
        let half = change.ci95.map_or(f64::NAN, |[from, to]| 0.5 * (to - from));
        let digits = decimals_of(half, 2);
        text += &format!(
            "    {}{joint}{target}{place} {}: {:.digits$} → {:.digits$} ({:+.digits$} ± {half:.digits$})\n",
            estimate.effect, estimate.name, change.from, estimate.value, change.difference
        );
    }
    text
}
