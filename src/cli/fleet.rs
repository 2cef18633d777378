//! `truepose diagnose` of many sessions: a line of JSON for each, or one table over the machines.
//!
//! A session that cannot be diagnosed stops nothing: its line says why, and the exit status is 1 (2
//! where none could be diagnosed). Lines come in the order of the arguments and are the same on any
//! number of threads. No more sessions than threads are in memory at a time.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::anyhow;

use crate::diagnosis::Diagnosis;
use crate::pipeline::{load, sessions_of_folder};
use crate::present::diagnosis_v1::document;
use crate::present::json::{Json, keyed};
use crate::present::numbers::number_of;
use crate::present::table::Table;
use crate::sessions::Session;

use super::diagnose::{Asked, named};
use super::failure::Failure;
use super::in_order::in_order;
use super::output;

/// What is said of one session.
struct Answer {
    file: String,
    /// Notes and warnings of reading it.
    findings: Vec<String>,
    /// As a line of JSON.
    line: String,
    row: Result<Row, Failure>,
}

/// A row of the table.
struct Row {
    machine: String,
    verdict: &'static str,
    names: Vec<String>,
    /// RMS error of the nominal robot and with the found effects, and the noise floor, mm.
    errors_mm: [f64; 3],
}

impl Row {
    fn of(d: &Diagnosis, session: &Session) -> Self {
        let found = d.found.iter();
        Self {
            machine: session.robot.name.clone(),
            verdict: d.verdict.name(),
            names: found
                .map(|f| named(d, f.effect, f.joint.map(|joint| joint - 1)))
                .collect(),
            errors_mm: [d.gap.start_mm, d.gap.end_mm, d.floor.mm],
        }
    }
}

/// Diagnoses the sessions that the arguments name, `jobs` at a time. A folder stands for its sessions.
pub(crate) fn run(
    arguments: &[PathBuf],
    asked: &Asked,
    jobs: Option<NonZeroUsize>,
    json_lines: bool,
) -> Result<(), Failure> {
    let mut files = Vec::new();
    for path in arguments {
        if path.is_dir() {
            files.extend(sessions_of_folder(path)?);
        } else {
            files.push(path.clone());
        }
    }
    let cores = std::thread::available_parallelism();
    let jobs = jobs.or(cores.ok()).map_or(1, usize::from);
    let stopped = AtomicBool::new(false);
    let work = |k: usize| one(&files[k], asked, &stopped);
    let mut summary = Summary::new();
    let ended = in_order(files.len(), jobs, &work, &mut |answer: Answer| {
        output::messages(&answer.findings);
        let written = if json_lines {
            output::line(&answer.line)
        } else {
            Ok(true)
        };
        summary.add(answer.file, answer.row);
        if let Ok(true) = written {
            return ControlFlow::Continue(());
        }
        stopped.store(true, Ordering::Relaxed);
        ControlFlow::Break(written.map(|_| ()))
    });
    if let ControlFlow::Break(ended) = ended {
        return ended;
    }
    if !json_lines {
        output::text(&summary.in_words())?;
    }
    summary.outcome()
}

/// Diagnoses one session, unless the command is stopped meanwhile.
fn one(path: &Path, asked: &Asked, stopped: &AtomicBool) -> Answer {
    let mut findings = Vec::new();
    let told = guarded(path, || {
        let loaded = load(path)?;
        findings.extend(loaded.findings.iter().map(ToString::to_string));
        let session = &loaded.session;
        let (answer, start) = asked.of(session, &|_| !stopped.load(Ordering::Relaxed))?;
        let document = document(&answer, session, start.as_ref());
        Ok((document, Row::of(&answer, session)))
    });
    let file = path.display().to_string();
    let (document, row) = match told {
        Ok((document, row)) => (document, Ok(row)),
        Err(failure) => {
            let because = Json::from(failure.to_string());
            (keyed([("error", because)]), Err(failure))
        }
    };
    let document = keyed([("file", Json::from(&file))]).with(document);
    Answer {
        file,
        findings,
        line: serde_json::to_string(&document).unwrap_or_default(),
        row,
    }
}

/// Does the work for one session. A fault of the program in it must not take the answers of the others along.
fn guarded<T>(path: &Path, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    let broke_down = |_| Err(anyhow!("{}: the diagnosis broke down", path.display()).into());
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(broke_down)
}

/// What became of all sessions so far.
struct Summary {
    table: Table,
    diagnosed: usize,
    /// How many there are of each verdict, and of each name.
    verdicts: BTreeMap<String, usize>,
    names: BTreeMap<String, usize>,
    machines: BTreeSet<String>,
    failed: usize,
    /// Whether the program failed in one, rather than an input being wrong.
    broke_down: bool,
}

impl Summary {
    fn new() -> Self {
        let headings = ["file", "machine", "verdict", "found"];
        let errors = [">nominal, mm", ">with found effects", ">noise floor"];
        Self {
            table: Table::new(headings.into_iter().chain(errors)),
            diagnosed: 0,
            verdicts: BTreeMap::new(),
            names: BTreeMap::new(),
            machines: BTreeSet::new(),
            failed: 0,
            broke_down: false,
        }
    }

    fn add(&mut self, file: String, row: Result<Row, Failure>) {
        let row = match row {
            Ok(row) => row,
            Err(failure) => {
                output::messages(&[&failure]);
                self.failed += 1;
                self.broke_down |= matches!(failure, Failure::Failed(_));
                self.table.row([file.as_str(), "", "not diagnosed"]);
                return;
            }
        };
        self.diagnosed += 1;
        *self.verdicts.entry(row.verdict.to_owned()).or_default() += 1;
        let names = row.names.join(", ");
        let mut cells = vec![file, row.machine.clone(), row.verdict.to_owned(), names];
        cells.extend(row.errors_mm.map(|mm| format!("{mm:.4}")));
        self.table.row(cells);
        self.machines.insert(row.machine);
        for name in row.names {
            *self.names.entry(name).or_default() += 1;
        }
    }

    fn in_words(&self) -> String {
        let counted = |counts: &BTreeMap<String, usize>| {
            let mut counts: Vec<(&String, &usize)> = counts.iter().collect();
            counts.sort_by_key(|(_, count)| Reverse(**count));
            let each = counts.iter().map(|(name, count)| format!("{name} {count}"));
            each.collect::<Vec<_>>().join(", ")
        };
        let mut text = self.table.aligned(0);
        text += &format!(
            "\n{} of {}: {}\n",
            number_of(self.diagnosed, "session"),
            number_of(self.machines.len(), "machine"),
            counted(&self.verdicts)
        );
        if !self.names.is_empty() {
            text += &format!("found: {}\n", counted(&self.names));
        }
        text
    }

    /// The exit status: see the module.
    fn outcome(&self) -> Result<(), Failure> {
        let text = format!(
            "{} of {} sessions could not be diagnosed",
            self.failed,
            self.diagnosed + self.failed
        );
        match self.failed {
            0 => Ok(()),
            _ if self.diagnosed == 0 && !self.broke_down => Err(Failure::WrongInput(text)),
            _ => Err(anyhow!(text).into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_that_breaks_the_program_has_a_failure_of_its_own() {
        let said = |work: fn() -> Result<u8, Failure>| guarded(Path::new("s.json"), work);
        assert!(matches!(said(|| Ok(3)), Ok(3)));
        let broken = said(|| panic!("a fault of the program"));
        let broken = broken.map_err(|failure| failure.to_string());
        assert_eq!(broken, Err("s.json: the diagnosis broke down".to_owned()));
    }
}
