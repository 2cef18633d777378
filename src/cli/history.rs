//! `truepose history`: what became of the robots of a folder.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use truepose::fit::Estimate;
use truepose::history::{Change, Entry, History as Told, RobotHistory, Source, history};

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
            output::json(&Answer::new(&told))
        } else {
            output::text(&in_words(&told))
        }
    }
}

/// `truepose-history/1`.
#[derive(Serialize)]
struct Answer<'a> {
    format: &'static str,
    robots: Vec<Robot<'a>>,
    not_read: Vec<NotRead<'a>>,
}

#[derive(Serialize)]
struct NotRead<'a> {
    file: &'a str,
    because: &'a str,
}

#[derive(Serialize)]
struct Robot<'a> {
    robot: &'a str,
    ordered_by: &'static str,
    entries: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    file: &'a str,
    kind: &'static str,
    session: &'a str,
    samples: Option<usize>,
    samples_hash: &'a str,
    compensated_by: Option<&'a str>,
    gap: Gap,
    parameters: Vec<Parameter<'a>>,
    changes: Vec<Difference<'a>>,
}

#[derive(Serialize)]
struct Gap {
    before_mm: Option<f64>,
    after_mm: Option<f64>,
    with_first_mm: Option<f64>,
}

#[derive(Serialize)]
struct Parameter<'a> {
    #[serde(flatten)]
    which: Which<'a>,
    value: f64,
    ci95: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct Which<'a> {
    effect: &'static str,
    joint: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    setup: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<&'a str>,
    name: &'static str,
}

#[derive(Serialize)]
struct Difference<'a> {
    #[serde(flatten)]
    which: Which<'a>,
    since: &'a str,
    from: f64,
    to: f64,
    difference: f64,
    ci95: Option<[f64; 2]>,
    significant: bool,
}

impl<'a> Answer<'a> {
    fn new(told: &'a Told) -> Self {
        let robot = |robot: &'a RobotHistory| Robot {
            robot: &robot.robot,
            ordered_by: robot.ordered_by.in_words(),
            entries: robot.entries.iter().map(Row::new).collect(),
        };
        Self {
            format: "truepose-history/1",
            robots: told.robots.iter().map(robot).collect(),
            not_read: told
                .not_read
                .iter()
                .map(|file| NotRead {
                    file: &file.file,
                    because: &file.because,
                })
                .collect(),
        }
    }
}

fn kind(entry: &Entry) -> &'static str {
    match entry.source {
        Source::Session => "session",
        Source::Model => "model",
    }
}

impl<'a> Row<'a> {
    fn new(entry: &'a Entry) -> Self {
        let known = |value: f64| Some(value).filter(|value| value.is_finite());
        let difference = |change: &'a Change| Difference {
            which: Which::of(&entry.parameters[change.parameter]),
            since: &change.since,
            from: change.from,
            to: entry.parameters[change.parameter].value,
            difference: change.difference,
            ci95: change.ci95,
            significant: change.is_significant(),
        };
        Self {
            file: &entry.file,
            kind: kind(entry),
            session: &entry.session,
            samples: entry.samples,
            samples_hash: &entry.samples_hash,
            compensated_by: entry.compensated_by.as_deref(),
            gap: Gap {
                before_mm: known(entry.before_mm),
                after_mm: known(entry.after_mm),
                with_first_mm: entry.with_first_mm,
            },
            parameters: entry
                .parameters
                .iter()
                .map(|estimate| Parameter {
                    which: Which::of(estimate),
                    value: estimate.value,
                    ci95: estimate.ci95,
                })
                .collect(),
            changes: entry.changes.iter().map(difference).collect(),
        }
    }
}

impl<'a> Which<'a> {
    fn of(estimate: &'a Estimate) -> Self {
        Self {
            effect: estimate.effect,
            joint: estimate.joint,
            setup: estimate.setup.as_deref(),
            target: estimate.target.as_deref(),
            place: estimate.place.as_deref(),
            name: estimate.name,
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
        kind(entry),
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
        // As many digits as the interval carries.
        let digits = digits(half);
        text += &format!(
            "    {}{joint}{target}{place} {}: {:.digits$} → {:.digits$} ({:+.digits$} ± {half:.digits$})\n",
            estimate.effect, estimate.name, change.from, estimate.value, change.difference
        );
    }
    text
}

/// Decimals with which two digits of an uncertainty show.
fn digits(half: f64) -> usize {
    (0..9)
        .find(|&digits| half * 10_f64.powi(digits) >= 10.0)
        .map_or(9, |d| d.unsigned_abs() as usize)
}
