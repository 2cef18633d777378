//! `truepose diagnose` of many sessions: a line of JSON for each, or one table over the machines.
//!
//! A session that cannot be diagnosed stops nothing: its line says why, and the exit status is 1 (2
//! where none could be diagnosed). Lines come in the order of the arguments and are the same on any
//! number of threads. No more sessions than threads are in memory at a time.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Error;

use crate::diagnosis::Diagnosis;
use crate::language::finding;
use crate::pipeline::{load, sessions_of_folder};
use crate::present::diagnosis_v1::document;
use crate::present::json::{Json, keyed};
use crate::present::names::word;
use crate::present::numbers::grouped;
use crate::present::table::Table;
use crate::sessions::Session;
use crate::text::{choose, current};

use super::asked::IdentificationTask;
use super::failure::Failure;
use super::in_order::in_order;
use super::output;
use super::words::{effect, effects};

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
            names: found.map(|f| named(d, f.effect, f.joint)).collect(),
            errors_mm: [d.gap.start_mm, d.gap.end_mm, d.floor.mm],
        }
    }
}

/// A name, of several joints with its joint, counted from 1.
fn named(d: &Diagnosis, effect: &str, joint: Option<usize>) -> String {
    match joint.filter(|_| d.model.robot.joints.len() > 1) {
        Some(joint) => format!("{effect} {joint}"),
        None => effect.to_owned(),
    }
}

/// Diagnoses the sessions that the arguments name, `jobs` at a time. A folder stands for its sessions.
pub(crate) fn run(
    arguments: &[PathBuf],
    asked: &IdentificationTask,
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
    let language = current();
    let work = |k: usize| {
        choose(language);
        one(&files[k], asked, &stopped)
    };
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
    summary.exit_status()
}

/// Diagnoses one session, unless the command is stopped meanwhile.
fn one(path: &Path, asked: &IdentificationTask, stopped: &AtomicBool) -> Answer {
    let mut findings = Vec::new();
    let told = guarded(path, || {
        let loaded = load(path)?;
        findings.extend(loaded.findings.iter().map(finding));
        let session = &loaded.session;
        let (answer, start) = asked.of(session, &|_| !stopped.load(Ordering::Relaxed))?;
        let document = document(&answer, session, start.as_ref());
        Ok((document, Row::of(&answer, session)))
    });
    let file = path.display().to_string();
    let (document, row) = match told {
        Ok((document, row)) => (document, Ok(row)),
        Err(failure) => {
            // A document is English; the table's reader is told in the language of this thread.
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
    let broke_down = |_| {
        let file = path.display();
        let text = text!("{file}: the diagnosis failed", file = file.to_string());
        Err(Error::msg(text).into())
    };
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(broke_down)
}

/// What became of all sessions so far.
struct Summary {
    table: Table,
    diagnosed: usize,
    /// How many there are of each verdict, and of each name.
    verdicts: BTreeMap<&'static str, usize>,
    names: BTreeMap<String, usize>,
    machines: BTreeSet<String>,
    failed: usize,
    /// Whether the program failed in one, rather than an input being wrong.
    broke_down: bool,
}

impl Summary {
    fn new() -> Self {
        Self {
            table: Table::headed(say!(
                "file | machine | verdict | found | >nominal, mm | >with found effects | >noise floor"
            )),
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
                output::messages(&[failure.spoken()]);
                self.failed += 1;
                self.broke_down |= matches!(failure, Failure::Failed(_));
                self.table.row([file.as_str(), "", say!("not diagnosed")]);
                return;
            }
        };
        self.diagnosed += 1;
        let verdict = word(row.verdict);
        let names = effects(&row.names, ", ");
        let mut cells = vec![file, row.machine.clone(), verdict, names];
        cells.extend(row.errors_mm.map(|mm| format!("{mm:.4}")));
        self.table.row(cells);
        *self.verdicts.entry(row.verdict).or_default() += 1;
        self.machines.insert(row.machine);
        for name in row.names {
            *self.names.entry(name).or_default() += 1;
        }
    }

    fn in_words(&self) -> String {
        let verdicts = self.verdicts.iter().map(|(name, count)| (*name, *count));
        let names = self
            .names
            .iter()
            .map(|(name, count)| (name.as_str(), *count));
        let sessions =
            say!(one "{count} session", "{count} sessions", count = grouped(self.diagnosed));
        let machines =
            say!(one "{count} machine", "{count} machines", count = grouped(self.machines.len()));
        let all = say!(
            "{sessions} of {machines}: {verdicts}",
            sessions,
            machines,
            verdicts = counted(verdicts, |verdict| word(verdict).into())
        );
        let mut text = self.table.aligned(0);
        text += &format!("\n{all}\n");
        if !self.names.is_empty() {
            let found = say!("found: {effects}", effects = counted(names, effect));
            text += &format!("{found}\n");
        }
        text
    }

    /// The exit status: see the module.
    fn exit_status(&self) -> Result<(), Failure> {
        let text = text!(
            "{failed} of {all} sessions could not be diagnosed",
            failed = self.failed,
            all = self.diagnosed + self.failed
        );
        match self.failed {
            0 => Ok(()),
            _ if self.diagnosed == 0 && !self.broke_down => Err(Failure::WrongInput(text)),
            _ => Err(Error::msg(text).into()),
        }
    }
}

/// How often each name occurs, the most frequent first.
fn counted<'a>(
    counts: impl Iterator<Item = (&'a str, usize)>,
    name_of: impl Fn(&'a str) -> Cow<'a, str>,
) -> String {
    let mut counts: Vec<_> = counts.collect();
    counts.sort_by_key(|(_, count)| Reverse(*count));
    let each = counts
        .into_iter()
        .map(|(name, count)| format!("{} {count}", name_of(name)));
    each.collect::<Vec<_>>().join(", ")
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
        assert_eq!(broken, Err("s.json: the diagnosis failed".to_owned()));
    }
}
