//! `truepose history`: what became of the robots of a folder.

use std::path::PathBuf;

use clap::Args;

use crate::history::{Change, Entry, History as Told, Order, Source};
use crate::language::spoken;
use crate::pipeline::history;
use crate::present::history_v1::document;
use crate::present::numbers::decimals_of;

use super::failure::Failure;
use super::output;
use super::words::{effect, line, parameter};

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
            .map(|file| {
                say!(
                    "{file} is excluded: {because}",
                    file = file.file,
                    because = spoken(&file.because)
                )
            })
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
        let order = match robot.ordered_by {
            Order::Time => say!(in "chart-word", "by the time of the first sample"),
            Order::Name => say!(in "chart-word", "by file name, numbers in it by their value"),
        };
        text += &format!("{} ({order})\n", robot.robot);
        for entry in &robot.entries {
            text += &entry_in_words(entry);
        }
    }
    text
}

fn entry_in_words(entry: &Entry) -> String {
    let source = match entry.source {
        Source::Session => say!(in "history-cell", "session"),
        Source::Model => say!(in "history-cell", "model"),
    };
    let source = match entry.samples {
        Some(samples) => say!(
            "{source}, {samples} samples",
            source = source,
            samples = samples
        ),
        None => source.to_owned(),
    };
    let errors = say!(
        "{file} ({source}): RMS error {nominal} mm nominal, {identified} mm after identification",
        file = entry.file,
        source = source,
        nominal = format!("{:.4}", entry.before_mm),
        identified = format!("{:.4}", entry.after_mm)
    );
    let mut text = format!("  {errors}");
    if let Some(first) = entry.with_first_mm {
        let first = format!("{first:.4}");
        text += &say!(", {first} mm with the earliest", first = first);
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
    let changed_of = say!(
        "changed since {since} by more than the interval: {changed} of {all} parameters",
        since = since,
        changed = changed.len(),
        all = entry.changes.len()
    );
    line(&mut text, format!("    {changed_of}"));
    for change in changed {
        line(&mut text, changed_in_words(entry, change));
    }
    text
}

fn changed_in_words(entry: &Entry, change: &Change) -> String {
    let estimate = &entry.parameters[change.parameter];
    let name = match estimate.joint {
        Some(joint) => format!("{} {joint}", estimate.effect),
        None => estimate.effect.to_owned(),
    };
    let places = [&estimate.target, &estimate.place].into_iter().flatten();
    let places = places.fold(String::new(), |all, place| all + " " + place);
    let half = change.ci95.map_or(f64::NAN, |[from, to]| 0.5 * (to - from));
    let digits = decimals_of(half, 2);
    format!(
        "    {}{places} {}: {:.digits$} → {:.digits$} ({:+.digits$} ± {half:.digits$})",
        effect(&name),
        parameter(estimate.name),
        change.from,
        estimate.value,
        change.difference
    )
}
