//! Reading and writing, as the background tasks do it: through the library, like the terminal.

use std::fmt::Display;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::atomic::{
    Prepared, WriteError, commit_both, refuse_to_replace_inputs, write_atomically,
};
use crate::diagnostic::Diagnostic;
use crate::export::{Document, Job, find};
pub(crate) use crate::model::format_v1::is_model;
use crate::model::format_v1::{load_model, write_model};
use crate::progress::{Cancelled, Part, Progress, ReadError, unwatched};
use crate::sessions::{self, Loaded, Replacing, Session};

use super::document::plain;
use super::foreign::{Beside, Foreign};
use super::given::Given;
use super::keeping::disk::{Fate, Print};
use super::preview::Wanted;
use super::simulate::Form;
use super::subject::{Origin, Subject};
use super::tasks::{Report, Watch, What};
use super::view::Message;

/// A session that comes with the program.
pub(crate) struct Example {
    /// Its name in the menu.
    pub(crate) name: &'static str,
    /// What it is.
    pub(crate) what: &'static str,
    document: &'static [u8],
    samples: &'static [u8],
}

impl Example {
    /// Document and samples.
    pub(crate) fn files(&self) -> (&'static [u8], &'static [u8]) {
        (self.document, self.samples)
    }
}

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        name: "Lamp commissioning",
        what: "two reflectors, both sides, noise, while the machine warms up",
        document: include_bytes!("../../sessions/lamp-commissioning.json"),
        samples: include_bytes!("../../sessions/lamp-commissioning.csv"),
    },
    Example {
        name: "The paper's 30 samples",
        what: "six regions of five samples, without noise",
        document: include_bytes!("../../sessions/paper-30.json"),
        samples: include_bytes!("../../sessions/paper-30.csv"),
    },
    Example {
        name: "The paper's full run",
        what: "361 samples, every half degree",
        document: include_bytes!("../../sessions/paper-run.json"),
        samples: include_bytes!("../../sessions/paper-run.csv"),
    },
];

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<Subject> {
    let example = &EXAMPLES[0];
    let loaded = sessions::parse_with_csv(example.document, example.samples);
    let loaded = loaded.expect("a test reads every bundled session");
    Arc::new(Subject::new(
        loaded.session,
        loaded.findings,
        Origin::Bundled,
    ))
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Report {
    let Some(example) = EXAMPLES.get(index) else {
        return Report::Opened(Err(Message {
            wrong: true,
            title: "There is no such example".to_owned(),
            details: vec!["The examples are in the File menu".to_owned()],
        }));
    };
    let loaded = sessions::parse_with_csv(example.document, example.samples);
    let nobody = Progress::new(&unwatched);
    let subject = loaded.map_err(ReadError::from);
    let subject = subject.and_then(|l| Ok(looked_through(l, Origin::Bundled, nobody.whole())?));
    Report::Opened(subject.map_err(|error| not_read(example.name, "opened", &error)))
}

/// Everything that follows from a session that was read.
fn looked_through(
    loaded: Loaded,
    origin: Origin,
    part: Part<'_>,
) -> Result<Arc<Subject>, Cancelled> {
    let in_a_file = !loaded.session.samples.line.is_empty();
    let samples_file = loaded.files.last().filter(|_| in_a_file).cloned();
    let findings = loaded.findings;
    let mut subject = Subject::watched(loaded.session, findings, origin, part.part(0.0, 0.6))?;
    subject.files = loaded.files.iter().filter_map(|f| Print::of(f)).collect();
    subject.samples_file = samples_file.filter(|_| !subject.files.is_empty());
    part.reached(0.8)?;
    if subject.single_revolute() {
        // Sorted here, so that the window never waits for it.
        subject.angles();
    }
    part.reached(1.0)?;
    Ok(Arc::new(subject))
}

/// Says that a file was not opened, or not read.
fn not_read(name: impl Display, done: &str, error: &ReadError) -> Message {
    Message {
        wrong: true,
        title: format!("{name} could not be {done}; nothing was changed"),
        details: match error {
            ReadError::Rejected(rejected) => listed(&rejected.diagnostics),
            ReadError::Cancelled(_) => vec![CANCELLED.to_owned()],
        },
    }
}

/// Why something was not read or written.
const CANCELLED: &str = "it was cancelled";

/// Reads a session or a model: its key `format` says which it is.
pub(crate) fn open(path: &Path, watch: &Watch) -> Report {
    if is_model(path) {
        return Report::OpenedModel(match load_model(path) {
            Ok(calibration) => Ok(Arc::new(Given::new(calibration, path))),
            Err(rejected) => Err(not_read(path.display(), "opened", &rejected.into())),
        });
    }
    let told = watch.told();
    let progress = Progress::new(&told);
    let whole = progress.whole();
    match Foreign::of(path, whole) {
        None => {}
        Some(Ok(foreign)) => return Report::Foreign(Box::new(foreign)),
        Some(Err(error)) => {
            return Report::Opened(Err(not_read(path.display(), "read", &error)));
        }
    }
    let loaded = sessions::load_watched(path, whole.part(0.0, READING).watch());
    let subject = loaded.and_then(|loaded| {
        watch.doing(format!("checking {} samples", loaded.session.samples.len()));
        let origin = Origin::File(path.to_path_buf());
        Ok(looked_through(loaded, origin, whole.part(READING, 1.0))?)
    });
    Report::Opened(subject.map_err(|error| not_read(path.display(), "opened", &error)))
}

/// Which part of opening a session it is to read it; the rest is to look through it.
const READING: f64 = 0.4;

/// Findings as lines, no more than can be read.
fn listed(findings: &[Diagnostic]) -> Vec<String> {
    const MOST: usize = 8;
    let mut lines: Vec<String> = findings
        .iter()
        .take(MOST)
        .map(ToString::to_string)
        .collect();
    if findings.len() > MOST {
        lines.push(format!("and {} more", findings.len() - MOST));
    }
    lines
}

/// Makes a session by simulation.
pub(crate) fn simulate(form: &Form, watch: &Watch) -> Report {
    Report::Opened(match form.session(watch.told()) {
        Ok(session) => {
            let subject = Subject::new(session, Vec::new(), Origin::Simulated);
            Ok(Arc::new(subject))
        }
        Err(problems) => Err(Message {
            wrong: true,
            title: "The simulation needs other numbers".to_owned(),
            details: problems,
        }),
    })
}

/// What saving may replace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Replace {
    /// Nothing.
    Nothing,
    /// What has that name: the user was asked. But not what changed since it was read.
    Named,
    /// The files that the session came from, and no others.
    Own,
    /// Whatever is there: the user was asked about that as well.
    Whatever,
}

/// How saving went.
#[derive(Debug)]
pub(crate) struct Saved {
    /// The document that was saved.
    pub(crate) document: Arc<crate::gui::document::Document>,
    /// The file.
    pub(crate) path: PathBuf,
    /// The files as they look now, the document first; or why there are none.
    pub(crate) result: Result<Vec<Print>, NotSaved>,
}

/// Why a session was not saved.
#[derive(Debug)]
pub(crate) enum NotSaved {
    /// This file changed since it was read.
    Changed(PathBuf),
    /// Something else.
    Because(Message),
}

/// Writes a session: the document, and its samples beside it. `known` are the files that it came
/// from, as they looked then: what changed since is replaced only where that was asked for.
pub(crate) fn save(
    document: Arc<crate::gui::document::Document>,
    path: &Path,
    replace: Replace,
    mut known: Vec<Print>,
    watch: &Watch,
) -> Report {
    let path = if path.extension().is_none() {
        path.with_extension("json")
    } else {
        path.to_path_buf()
    };
    let outputs = [path.clone(), sessions::samples_path(&path)];
    let changed = outputs.iter().find(|output| {
        let print = known.iter_mut().find(|k| same_file(&k.path, output));
        print.is_some_and(|print| print.look() == Some(Fate::Changed))
    });
    let result = if let (Some(changed), true) = (changed, replace != Replace::Whatever) {
        Err(NotSaved::Changed(changed.clone()))
    } else {
        let is_own = |output: &PathBuf| known.iter().any(|k| same_file(&k.path, output));
        let force = match replace {
            Replace::Nothing => false,
            Replace::Named | Replace::Whatever => true,
            Replace::Own => outputs.iter().all(|o| is_own(o) || !o.exists()),
        };
        let replacing = Replacing { force, inputs: &[] };
        let session = document.session_to_save();
        match sessions::save_watched(&session, &path, replacing, watch.told()) {
            Ok(_) => Ok(outputs.iter().filter_map(|o| Print::of(o)).collect()),
            Err(error) => Err(NotSaved::Because(Message {
                wrong: true,
                title: format!("{} could not be saved", path.display()),
                details: vec![
                    advice(&error),
                    "What was there before is there still".to_owned(),
                ],
            })),
        }
    };
    Report::Saved(Box::new(Saved {
        document,
        path,
        result,
    }))
}

fn same_file(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// What the system says, and what to do about it.
fn advice(error: &WriteError) -> String {
    let source = match error {
        WriteError::Io { source, .. } => source,
        WriteError::Exists(path) => {
            return format!(
                "{} exists already; allow replacing it, or choose another name",
                path.display()
            );
        }
        WriteError::NotAFile(path) => {
            return format!(
                "{} is a folder or a device and cannot be replaced; choose another name",
                path.display()
            );
        }
        WriteError::ReplacesInput { .. } | WriteError::SameName(_) => return error.to_string(),
        WriteError::Cancelled(_) => return CANCELLED.to_owned(),
    };
    let what_to_do = match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "the disk is full: make room on it, or save to another disk"
        }
        ErrorKind::ReadOnlyFilesystem => "the disk can only be read: save to another disk",
        ErrorKind::PermissionDenied => "nothing may be written there: save to another folder",
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            "the folder is not there: choose another, or make it first"
        }
        ErrorKind::InvalidFilename => {
            "the name is too long, or has a sign in it that no name may have: choose another name"
        }
        _ => return error.to_string(),
    };
    format!("{what_to_do} ({source})")
}

/// Asks the user for a session file.
pub(crate) fn choose_to_open() -> Report {
    let dialog = rfd::FileDialog::new()
        .set_title("Open session, model or measurements")
        .add_filter("Sessions and models", &["json"])
        .add_filter("Measurements", TABLES)
        .add_filter("All files", &["*"]);
    Report::ChosenToOpen(dialog.pick_file())
}

/// Asks the user for a file beside a measured one.
pub(crate) fn choose_beside(which: Beside) -> Report {
    let (title, kinds): (_, &[&str]) = match which {
        Beside::Robot => ("Which robot was measured", &["json", "urdf", "xml"]),
        Beside::Commands => ("Where the robot was sent", TABLES),
        Beside::Reference => ("Points known in the base frame", TABLES),
        Beside::Targets => ("Reflectors in the tool frame", TABLES),
    };
    let dialog = rfd::FileDialog::new()
        .set_title(title)
        .add_filter("Files of this kind", kinds)
        .add_filter("All files", &["*"]);
    Report::ChosenBeside(which, dialog.pick_file())
}

/// Endings of files with tables.
const TABLES: &[&str] = &["csv", "txt", "tsv", "dat", "asc"];

/// Asks the user where to save.
pub(crate) fn choose_to_save(name: &str) -> Report {
    let dialog = rfd::FileDialog::new()
        .set_title("Save session")
        .set_file_name(name)
        .add_filter("Session", &["json"]);
    Report::ChosenToSave(dialog.save_file())
}

/// Asks the user where to export to.
pub(crate) fn choose_to_export(what: What, name: &str) -> Report {
    let title = match what {
        What::Table => "Save table",
        What::Model => "Save model",
        What::Poses => "Save measuring list",
        What::Report(_) => "Save report",
        What::Picture(_) => "Save picture",
    };
    let dialog = rfd::FileDialog::new().set_title(title).set_file_name(name);
    let dialog = match what {
        What::Report(_) => dialog
            .add_filter("HTML or PDF", &["html", "pdf"])
            .add_filter("PDF", &["pdf"]),
        What::Picture(_) => dialog.add_filter("SVG", &["svg"]),
        _ => dialog,
    };
    Report::ChosenToExport(what, dialog.save_file())
}

/// Writes a table with what stands beside it, or a model: all of it, or nothing.
pub(crate) fn export(wanted: &Wanted, what: What, path: &Path, replace: bool) -> Report {
    let written =
        documents(wanted, what, path).and_then(|documents| write_all(&documents, path, replace));
    Report::Exported(match written {
        Ok(()) => Ok(path.to_path_buf()),
        Err(problem) => Err(not_written(path, problem)),
    })
}

/// Writes a measuring list.
pub(crate) fn write_list(list: String, path: &Path, replace: bool) -> Report {
    let document = Document {
        name: String::new(),
        bytes: list.into_bytes(),
    };
    Report::Listed(match write_all(&[document], path, replace) {
        Ok(()) => Ok(path.to_path_buf()),
        Err(problem) => Err(not_written(path, problem)),
    })
}

/// Says that a file was not written.
pub(crate) fn not_written(path: &Path, problem: String) -> Message {
    Message {
        wrong: true,
        title: format!("{} was not written", path.display()),
        details: vec![problem, "What was there before is there still".to_owned()],
    }
}

/// How a file's name ends, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    Some(ending.to_ascii_lowercase())
}

/// Whether a file may stand there: told before the work that it takes is begun.
pub(crate) fn can_be_written(path: &Path, replace: bool, inputs: &[PathBuf]) -> Result<(), String> {
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    refuse_to_replace_inputs(path, &inputs).map_err(|error| advice(&error))?;
    if path.exists() && !path.is_file() {
        return Err(advice(&WriteError::NotAFile(path.to_path_buf())));
    }
    if path.exists() && !replace {
        return Err(advice(&WriteError::Exists(path.to_path_buf())));
    }
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.is_dir() => {
            Err("the folder is not there: choose another, or make it first".to_owned())
        }
        _ => Ok(()),
    }
}

/// Writes one file, unless it was cancelled meanwhile.
pub(crate) fn write_one(
    path: &Path,
    replace: bool,
    bytes: &[u8],
    watch: &Watch,
) -> Result<(), String> {
    let written = write_atomically(path, replace, |file| {
        file.write_all(bytes)?;
        // Until here nothing stands under its name; what was written goes away again.
        if watch.stopped() {
            return Err(Cancelled.into());
        }
        Ok(())
    });
    written.map_err(|error| advice(&error))
}

fn documents(wanted: &Wanted, what: What, path: &Path) -> Result<Vec<Document>, String> {
    let name = path.file_name().and_then(|name| name.to_str());
    let name = name.ok_or("expected the name of a file, in UTF-8")?;
    let choice = wanted.choice;
    let answer = wanted.outcome.answer.as_ref().map_err(Clone::clone)?;
    if what == What::Model {
        return Ok(vec![Document {
            name: name.to_owned(),
            bytes: write_model(&answer.calibration).into_bytes(),
        }]);
    }
    // Not as it is shown: the documents say what the file is called.
    let job = Job {
        joint: choice.joint,
        step: choice.step,
        ..Job::new(&answer.calibration, name)
    };
    let format = find(choice.format).ok_or("there is no such format")?;
    let export = format.exporter.export(&job).map_err(|e| e.to_string())?;
    Ok(export.documents)
}

fn write_all(documents: &[Document], path: &Path, replace: bool) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let place = |k: usize, document: &Document| {
        if k == 0 {
            path.to_path_buf()
        } else {
            folder.join(&document.name)
        }
    };
    let places = documents.iter().enumerate();
    let places: Vec<PathBuf> = places.map(|(k, d)| place(k, d)).collect();
    if let Some(there) = places.iter().find(|place| !replace && place.exists()) {
        return Err(format!(
            "{} exists already; allow replacing it, or choose another name",
            there.display()
        ));
    }
    // All of them are on the disk before the first has its name.
    let write = |(place, document): (&PathBuf, &Document)| {
        Prepared::write(place, replace, |file| file.write_all(&document.bytes))
    };
    let written: Result<Vec<Prepared>, WriteError> =
        places.iter().zip(documents).map(write).collect();
    let mut written = written.map_err(|error| advice(&error))?;
    let committed = if written.len() == 2
        && let (Some(second), Some(first)) = (written.pop(), written.pop())
    {
        commit_both(first, second)
    } else {
        written.into_iter().try_for_each(Prepared::commit)
    };
    committed.map_err(|error| advice(&error))
}

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    format!("{}.json", plain(&session.name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::testing::{assert_grows, no_at, told};

    #[test]
    fn every_bundled_session_can_be_read() {
        for (index, example) in EXAMPLES.iter().enumerate() {
            let opened = open_example(index);
            assert!(matches!(opened, Report::Opened(Ok(_))), "{}", example.name);
        }
    }

    #[test]
    fn looking_through_a_session_can_be_cancelled_wherever_it_tells_how_far_it_is() {
        let example = &EXAMPLES[1];
        let through = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
            let loaded = sessions::parse_with_csv(example.document, example.samples);
            let progress = Progress::new(watch);
            looked_through(loaded.unwrap(), Origin::Bundled, progress.whole())
        };
        let (shares, subject) = told(through);
        assert_grows(&shares);
        assert_eq!(subject.map(|s| s.len()).ok(), Some(30));
        for number in 0..shares.len() {
            assert!(through(&no_at(number)).is_err(), "{number}");
        }
    }
}
