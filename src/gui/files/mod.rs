//! Reading and writing, as the background tasks do it: through the library, like the terminal. Here a session or a
//! model is read or made, with everything that follows from it; also those that come with the program.

use std::fmt::Display;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

use egui::{Color32, ColorImage};

use crate::atomic::{
    StagedFile, WriteError, commit_both, refuse_to_replace_inputs, write_atomically,
};
use crate::export::{Document, Job};
use crate::fonts;
use crate::gui::cache::cloud::Cloud;
use crate::gui::cache::{IdentifiedAnswer, PreviewRequest};
use crate::gui::core::answer::{self, LoadedModel, Search};
use crate::gui::core::compensated::Compensated;
use crate::gui::core::disk::{EXAMPLES, FileChange, Fingerprint, name_of};
use crate::gui::core::document::{self, plain};
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::core::simulate::Form;
use crate::gui::file_state::Stated;
use crate::gui::import_draft::{Companion, ImportDraft, ROBOTS, TABLES, listed};
use crate::gui::jobs::Watch;
use crate::gui::view::{Message, What};
use crate::language::{self, finding};
use crate::pipeline::{self, load_model};
use crate::programs::LANGUAGES;
use crate::progress::{Cancelled, Progress, ProgressSpan, ReadError, unwatched};
use crate::report::exported::sidecar_of;
use crate::report::{ExportedTable, Extras, Kind};
use crate::sessions::{Loaded, Replacing, Session, samples_path};
use crate::text::{Template, spoken};

pub(crate) use crate::pipeline::is_model;

/// Whether a file is a robot program by its name: one whose ending a table of measurements does not have as well.
pub(crate) fn is_program(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| {
        let program = LANGUAGES.iter().any(|l| l.extensions.contains(&&*ending));
        program && !TABLES.contains(&&*ending)
    })
}

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    format!("{}.json", plain(&session.name))
}

#[derive(Debug)]
pub(crate) enum Opened {
    /// A session was read or made.
    Session(Arc<LoadedSession>),
    /// A model was read.
    Model(Arc<LoadedModel>),
    /// A file that an instrument wrote was looked at.
    Foreign(Box<ImportDraft>),
}

/// Reads a session or a model: its key `format` says which it is.
pub(crate) fn open(path: &Path, watch: &Watch) -> Result<Opened, Message> {
    if is_model(path) {
        return match load_model(path) {
            Ok(calibration) => Ok(Opened::Model(Arc::new(LoadedModel::new(calibration, path)))),
            Err(rejected) => Err(not_opened(path.display(), &rejected.into())),
        };
    }
    let report_progress = watch.progress_callback();
    let progress = Progress::new(&report_progress);
    let whole = progress.whole();
    match ImportDraft::of(path, whole) {
        None => {}
        Some(Ok(foreign)) => return Ok(Opened::Foreign(Box::new(foreign))),
        Some(Err(error)) => {
            return Err(not_read(path.display(), &error));
        }
    }
    let loaded = pipeline::load_watched(path, whole.part(0.0, READING).watch());
    let loaded_session = loaded.and_then(|loaded| {
        watch.doing(say!(
            "checking {samples} samples",
            samples = loaded.session.samples.len()
        ));
        let origin = Origin::File(path.to_path_buf());
        let part = whole.part(READING, 1.0);
        Ok(looked_through(loaded, origin, part)?)
    });
    loaded_session
        .map(Opened::Session)
        .map_err(|error| not_opened(path.display(), &error))
}

/// Everything that follows from a session that was read.
fn looked_through(
    loaded: Loaded,
    origin: Origin,
    part: ProgressSpan<'_>,
) -> Result<Arc<LoadedSession>, Cancelled> {
    let in_a_file = !loaded.session.samples.line.is_empty();
    let samples_file = loaded.files.last().filter(|_| in_a_file).cloned();
    let findings = loaded.findings;
    let mut loaded_session =
        LoadedSession::watched(loaded.session, findings, origin, part.part(0.0, 0.6))?;
    loaded_session.files = loaded
        .files
        .iter()
        .filter_map(|f| Fingerprint::of(f))
        .collect();
    loaded_session.samples_file = samples_file.filter(|_| !loaded_session.files.is_empty());
    // Made here, so that the window never waits for it.
    Cloud::of(&loaded_session);
    part.reached(1.0)?;
    Ok(Arc::new(loaded_session))
}

/// Says that a file was not opened.
fn not_opened(name: impl Display, error: &ReadError) -> Message {
    let title = say!("{name} could not be opened; nothing was changed", name);
    Message::wrong(title, why(error))
}

/// Says that a file was not read.
fn not_read(name: impl Display, error: &ReadError) -> Message {
    let title = say!("{name} could not be read; nothing was changed", name);
    Message::wrong(title, why(error))
}

fn why(error: &ReadError) -> Vec<String> {
    match error {
        ReadError::Rejected(rejected) => listed(rejected.diagnostics.iter().map(finding).collect()),
        ReadError::Cancelled(_) => vec![cancelled()],
    }
}

/// Which part of opening a session it is to read it; the rest is to look through it.
const READING: f64 = 0.4;

/// Makes a session by simulation.
pub(crate) fn simulate(form: &Form, watch: &Watch) -> Result<Opened, Message> {
    match form.session(watch.progress_callback()) {
        Ok((session, hidden)) => {
            let mut loaded_session = LoadedSession::new(session, Vec::new(), Origin::Simulated);
            loaded_session.hidden = Some(hidden.into());
            Cloud::of(&loaded_session);
            Ok(Opened::Session(Arc::new(loaded_session)))
        }
        Err(problems) => Err(Message::wrong(
            say!("The simulation needs other numbers").to_owned(),
            problems.iter().map(language::spoken).collect(),
        )),
    }
}

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<LoadedSession> {
    let example = &EXAMPLES[0];
    let (document, samples) = example.files();
    let loaded = pipeline::parse_with_csv(document, samples);
    let loaded = loaded.expect("a test reads every bundled session");
    Arc::new(LoadedSession::new(
        loaded.session,
        loaded.findings,
        Origin::Bundled,
    ))
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Result<Opened, Message> {
    let Some(example) = EXAMPLES.get(index) else {
        return Err(Message::wrong(
            say!("There is no such example").to_owned(),
            vec![say!("The examples are in the File menu").to_owned()],
        ));
    };
    let (document, samples) = example.files();
    let loaded = pipeline::parse_with_csv(document, samples);
    let progress = Progress::new(&unwatched);
    let loaded_session = loaded.map_err(ReadError::from);
    let loaded_session =
        loaded_session.and_then(|l| Ok(looked_through(l, Origin::Bundled, progress.whole())?));
    loaded_session
        .map(Opened::Session)
        .map_err(|error| not_opened(example.name(), &error))
}

// What the system does with files: its dialogs that choose them, its programs that show them, and what
// is said where it did not read or write one.

/// Asks the user for a file of one of these kinds, beside this one.
fn pick(near: Option<&Path>, title: &str, kinds: &[(&str, &[&str])]) -> Option<PathBuf> {
    let dialog = dialog_beside(near).set_title(title);
    let with = |dialog: rfd::FileDialog, (name, endings): &(&str, &[&str])| {
        dialog.add_filter(*name, endings)
    };
    let dialog = kinds.iter().fold(dialog, with);
    dialog.add_filter(say!("All files"), &["*"]).pick_file()
}

/// Asks the user for a session, a model or measurements.
pub(crate) fn choose_to_open(near: Option<&Path>) -> Option<PathBuf> {
    let kinds: [(&str, &[&str]); 2] = [
        (say!("Sessions and models (*.json)"), &["json"]),
        (spoken(MEASUREMENTS), TABLES),
    ];
    pick(near, say!("Open session, model or measurements"), &kinds)
}

/// Asks the user for a table of targets or a robot program.
pub(crate) fn choose_targets(near: Option<&Path>) -> Option<PathBuf> {
    let all = LANGUAGES.iter().flat_map(|l| l.extensions);
    let all: Vec<&str> = all.copied().collect();
    let mut kinds = vec![(say!("Targets and programs"), &*all)];
    kinds.extend(LANGUAGES.iter().map(|l| (l.title, l.extensions)));
    pick(near, say!("Targets or program to correct"), &kinds)
}

/// Asks the user for a folder of sessions.
pub(crate) fn choose_folder(near: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(near).set_title(say!("Folder with the sessions of a machine"));
    dialog.pick_folder()
}

/// Asks the user for a picture for the head of a report.
pub(crate) fn choose_logo(near: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(near).set_title(say!("Logo of the report"));
    dialog
        .add_filter(say!("PNG pictures"), &["png"])
        .pick_file()
}

/// Asks the user for a file that an instrument wrote.
pub(crate) fn choose_to_import(near: Option<&Path>) -> Option<PathBuf> {
    let kinds = [(spoken(MEASUREMENTS), TABLES)];
    pick(near, say!("Import measurements"), &kinds)
}

/// Asks the user for a file that goes with a measured one, beside that.
pub(crate) fn choose_beside(which: Companion, measured: Option<&Path>) -> Option<PathBuf> {
    let title = match which {
        Companion::Robot => say!("Robot model"),
        Companion::Commands => say!("Commanded positions"),
        Companion::Reference => say!("Reference points (base frame)"),
        Companion::Targets => say!("Reflectors in the tool frame"),
    };
    let kind = if which == Companion::Robot {
        (say!("Robots and sessions (*.json, *.urdf, *.xml)"), ROBOTS)
    } else {
        (say!("Tables (*.csv, *.txt, *.tsv, *.dat, *.asc)"), TABLES)
    };
    pick(measured, title, &[kind])
}

const MEASUREMENTS: Template = phrase!("Measurements (*.csv, *.txt, *.tsv, *.dat, *.asc)");

/// A dialog that begins in the folder of this file.
fn dialog_beside(file: Option<&Path>) -> rfd::FileDialog {
    let dialog = rfd::FileDialog::new();
    match file.and_then(Path::parent).filter(|folder| folder.is_dir()) {
        Some(folder) => dialog.set_directory(folder),
        None => dialog,
    }
}

/// A dialog that begins in the folder where the file belongs, with its name.
fn dialog_at(path: &Path) -> rfd::FileDialog {
    let name = path.file_name().unwrap_or_default();
    dialog_beside(Some(path)).set_file_name(name.to_string_lossy())
}

/// Asks the user where to export to.
pub(crate) fn choose_to_export(what: What, path: &Path) -> Option<PathBuf> {
    let dialog = dialog_at(path).set_title(what.title());
    let dialog = match what {
        What::Report(_) => dialog
            .add_filter(say!("HTML or PDF (*.html, *.pdf)"), &["html", "pdf"])
            .add_filter(say!("PDF (*.pdf)"), &["pdf"]),
        What::Picture(plot) => {
            let ending = plot.ending();
            dialog.add_filter(say!("Picture (*.{ending})", ending), &[ending])
        }
        What::Session => dialog.add_filter(say!("Session (*.json)"), &["json"]),
        What::Model => dialog.add_filter(say!("Model (*.json)"), &["json"]),
        What::Robot(_) | What::TypedRobot => dialog.add_filter(say!("Robot (*.json)"), &["json"]),
        What::Poses | What::Numbers(_) => dialog.add_filter(say!("CSV table (*.csv)"), &["csv"]),
        What::Table | What::Targets => match path.extension().and_then(|ending| ending.to_str()) {
            Some(ending) => {
                let name = if what == What::Table {
                    say!("Table")
                } else {
                    say!("Targets")
                };
                dialog.add_filter(format!("{name} (*.{ending})"), &[ending])
            }
            None => dialog,
        },
    };
    dialog.save_file()
}

/// What opens a file with the system's program for it, or shows it in its folder. The path is one
/// argument: no shell reads it.
fn command(path: &Path, in_folder: bool) -> Command {
    let folder = path.parent().unwrap_or(path);
    if cfg!(target_os = "windows") {
        let mut command = Command::new("explorer");
        if in_folder {
            command.arg("/select,");
        }
        command.arg(path);
        command
    } else if cfg!(target_os = "macos") {
        let mut command = Command::new("open");
        if in_folder {
            command.arg("-R");
        }
        command.arg(path);
        command
    } else {
        let mut command = Command::new("xdg-open");
        command.arg(if in_folder { folder } else { path });
        command
    }
}

/// Opens a file with the system's program for it, or shows it in its folder. Takes its time.
///
/// # Errors
/// The system has no program for it, in words.
pub(crate) fn open_outside(path: &Path, in_folder: bool) -> Result<(), String> {
    let mut command = command(path, in_folder);
    let quiet = command.stdin(Stdio::null()).stdout(Stdio::null());
    match quiet.stderr(Stdio::null()).status() {
        // The explorer answers 1 although it has opened.
        Ok(status) if status.success() || cfg!(target_os = "windows") => Ok(()),
        Ok(_) => Err(say!("the system has no program for it").to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

/// Why something was not read or written.
pub(crate) fn cancelled() -> String {
    say!("it was cancelled").to_owned()
}

/// What the system says, and what to do about it.
pub(super) fn advice(error: &WriteError) -> String {
    let source = match error {
        WriteError::Io { source, .. } => source,
        WriteError::Exists(path) => {
            return say!(
                "{path} exists already; allow replacing it, or choose another name",
                path = path.display()
            );
        }
        WriteError::NotAFile(path) => {
            return say!(
                "{path} is a folder or a device and cannot be replaced; choose another name",
                path = path.display()
            );
        }
        WriteError::ReplacesInput { .. } | WriteError::SameName(_) => {
            return language::spoken(error.describe());
        }
        WriteError::Cancelled(_) => return cancelled(),
    };
    let what_to_do = match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            say!("the disk is full: make room on it, or save to another disk")
        }
        ErrorKind::ReadOnlyFilesystem => say!("the disk can only be read: save to another disk"),
        ErrorKind::PermissionDenied => say!("no permission to write there: save to another folder"),
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            say!("folder not found: choose another, or create it first")
        }
        ErrorKind::InvalidFilename => {
            say!("the name is too long or has a character that is not allowed: choose another name")
        }
        _ => return language::spoken(error.describe()),
    };
    format!("{what_to_do} ({source})")
}

/// How a file's name ends, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    Some(ending.to_ascii_lowercase())
}

// Writing sessions, tables, models, lists and pictures, whole or not at all.

/// What saving may replace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Replace {
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
    pub(crate) document: Arc<document::Document>,
    pub(crate) path: PathBuf,
    /// The files as they look now, the document first; or why there are none.
    pub(crate) result: Result<Vec<Fingerprint>, NotSaved>,
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
    document: Arc<document::Document>,
    path: &Path,
    replace: Replace,
    mut known: Vec<Fingerprint>,
    watch: &Watch,
) -> Saved {
    let path = if path.extension().is_none() {
        path.with_extension("json")
    } else {
        path.to_path_buf()
    };
    let outputs = [path.clone(), samples_path(&path)];
    let changed = outputs.iter().find(|output| {
        let print = known.iter_mut().find(|k| same_file(&k.path, output));
        print.is_some_and(|print| print.look() == Some(FileChange::Changed))
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
        match pipeline::save_watched(&session, &path, replacing, watch.progress_callback()) {
            Ok(_) => Ok(outputs.iter().filter_map(|o| Fingerprint::of(o)).collect()),
            Err(error) => Err(NotSaved::Because(Message::wrong(
                say!("{path} could not be saved", path = path.display()),
                vec![
                    advice(&error),
                    say!("What was there before is there still").to_owned(),
                ],
            ))),
        }
    };
    Saved {
        document,
        path,
        result,
    }
}

fn same_file(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Writes a table with what stands beside it, or a model: all of it, or nothing.
pub(crate) fn export(
    wanted: &PreviewRequest,
    what: What,
    path: &Path,
    replace: bool,
) -> Result<PathBuf, Message> {
    let written =
        documents(wanted, what, path).and_then(|documents| write_all(&documents, path, replace));
    written
        .map(|()| path.to_path_buf())
        .map_err(|problem| not_written(path, problem))
}

fn documents(wanted: &PreviewRequest, what: What, path: &Path) -> Result<Vec<Document>, String> {
    let name = path.file_name().and_then(|name| name.to_str());
    let name = name.ok_or(say!("expected the name of a file, in UTF-8"))?;
    let choice = wanted.choice;
    let verified = wanted.identified.handed_out()?;
    if what == What::Model {
        return Ok(vec![Document {
            name: name.to_owned(),
            bytes: pipeline::write_model(&verified).into_bytes(),
        }]);
    }
    // Not as it is shown: the documents say what the file is called.
    let job = Job {
        joint: choice.joint,
        step: choice.step,
        ..Job::new(&verified, name)
    };
    let session = &wanted.identified.question.loaded_session.session;
    let export = pipeline::export_for(choice.format, &job, session)
        .map_err(|e| language::spoken(e.describe()))?;
    Ok(export.export.documents)
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
        return Err(advice(&WriteError::Exists(there.clone())));
    }
    // All of them are on the disk before the first has its name.
    let write = |(place, document): (&PathBuf, &Document)| {
        StagedFile::write(place, replace, |file| file.write_all(&document.bytes))
    };
    let written: Result<Vec<StagedFile>, WriteError> =
        places.iter().zip(documents).map(write).collect();
    let mut written = written.map_err(|error| advice(&error))?;
    let committed = if written.len() == 2
        && let (Some(second), Some(first)) = (written.pop(), written.pop())
    {
        commit_both(first, second)
    } else {
        written.into_iter().try_for_each(StagedFile::commit)
    };
    committed.map_err(|error| advice(&error))
}

/// Writes a measuring list.
pub(crate) fn write_list(list: String, path: &Path, replace: bool) -> Message {
    let document = Document {
        name: String::new(),
        bytes: list.into_bytes(),
    };
    told(path, write_all(&[document], path, replace), Vec::new())
}

/// Writes corrected targets, and what was changed beside them.
pub(crate) fn write_targets(
    compensated: &Compensated,
    path: &Path,
    replace: bool,
    inputs: &[PathBuf],
) -> Message {
    let sidecar_path = sidecar_of(path);
    let name = name_of(&sidecar_path);
    let written = match &compensated.result {
        Err(not_corrected) => Err(not_corrected.problems.join("\n")),
        Ok(corrected) => can_be_written(path, replace, inputs).and_then(|()| {
            let documents = [
                Document {
                    name: String::new(),
                    bytes: corrected.answer.bytes.clone(),
                },
                Document {
                    name: name.into_owned(),
                    bytes: corrected.sidecar.clone(),
                },
            ];
            write_all(&documents, path, replace)
        }),
    };
    told(path, written, Vec::new())
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
            Err(say!("folder not found: choose another, or create it first").to_owned())
        }
        _ => Ok(()),
    }
}

/// Says how the writing of a file went.
fn told(path: &Path, written: Result<(), String>, details: Vec<String>) -> Message {
    match written {
        Ok(()) => Message::saved(path, details),
        Err(problem) => not_written(path, problem),
    }
}

/// Says that a file was not written.
pub(crate) fn not_written(path: &Path, problem: String) -> Message {
    Message::wrong(
        say!("{path} was not written", path = path.display()),
        vec![
            problem,
            say!("What was there before is there still").to_owned(),
        ],
    )
}

/// Makes a picture, and writes it under a name with its ending, where none of `inputs` stands.
pub(crate) fn write_picture(
    picture: impl FnOnce() -> Result<Vec<u8>, String>,
    (path, form): (&Path, &str),
    replace: bool,
    inputs: &[PathBuf],
    watch: &Watch,
) -> Message {
    let make = || {
        if ending(path).as_deref() != Some(form) {
            return Err(say!(
                "expected a file name that ends in .{ending}",
                ending = form
            ));
        }
        can_be_written(path, replace, inputs)?;
        write_one(path, replace, &picture()?, watch)
    };
    told(path, make(), Vec::new())
}

/// An image as a file.
pub(crate) fn png(image: &ColorImage) -> Result<Vec<u8>, String> {
    let [width, height] = image
        .size
        .map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let rgba: Vec<u8> = image.pixels.iter().flat_map(Color32::to_array).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let written = encoder.write_header();
    let written = written.and_then(|mut writer| writer.write_image_data(&rgba));
    written.map(|()| bytes).map_err(|error| error.to_string())
}

/// Where a report comes from.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    /// A session, with its search if there was one, and the model in use if there is one.
    Session(
        Arc<document::Document>,
        Option<Arc<Search>>,
        Option<Arc<IdentifiedAnswer>>,
    ),
    Model(Arc<IdentifiedAnswer>),
}

/// A report to be written.
#[derive(Debug, Clone)]
pub(crate) struct ReportRequest {
    /// Where it comes from.
    pub(crate) source: Source,
    /// What the certificate states besides its measurements.
    pub(crate) stated: Stated,
    /// Tables that were exported from this session.
    pub(crate) tables: Vec<PathBuf>,
    /// Files that it may not replace.
    pub(crate) inputs: Vec<PathBuf>,
}

/// Writes it, whole or not at all.
pub(crate) fn write_report(
    wanted: &ReportRequest,
    path: &Path,
    replace: bool,
    watch: &Watch,
) -> Message {
    let mut details = Vec::new();
    let written = make(wanted, path, replace, watch, &mut details);
    told(path, written, details)
}

fn make(
    wanted: &ReportRequest,
    path: &Path,
    replace: bool,
    watch: &Watch,
    details: &mut Vec<String>,
) -> Result<(), String> {
    let kind = Kind::of(path).map_err(language::spoken)?;
    // A long search is not begun for a file that cannot be written.
    can_be_written(path, replace, &wanted.inputs)?;
    let extras = Extras {
        details: wanted.stated.complete()?,
        tables: named_tables(&wanted.tables, details),
    };
    let report = match &wanted.source {
        Source::Model(outcome) => pipeline::report_of_model(&*outcome.handed_out()?, &extras),
        Source::Session(document, searched, in_use) => {
            let session = document.session_to_save();
            let options = answer::options();
            let there = searched.as_ref().and_then(|s| s.answer.as_ref().ok());
            let made;
            let found = if let Some(found) = there {
                // The tolerance may have been changed since: it decides nothing in a search.
                found
            } else {
                details.push(say!("The diagnosis was run for it").to_owned());
                made = pipeline::diagnose(&session, &options, &answer::progress_callback(watch))
                    .map_err(|e| language::spoken(e.describe()))?;
                &made
            };
            let in_use = in_use.as_ref().filter(|o| o.answer.is_ok());
            let in_use = in_use.map(|o| o.handed_out()).transpose()?;
            pipeline::report_of_diagnosis(&session, found, in_use.as_deref(), &options, &extras)
                .map_err(|e| language::spoken(e.describe()))?
        }
    };
    let written = pipeline::write_report(&report, kind).map_err(|e| e.to_string())?;
    if !written.unshown.is_empty() {
        let says = language::spoken(fonts::cannot_be_shown(&written.unshown));
        details.push(say!(
            "Some letters are written in it as codes: {says}",
            says
        ));
    }
    write_one(path, replace, &written.bytes, watch)
}

/// The tables with their hashes; what cannot be named any more is said.
fn named_tables(paths: &[PathBuf], details: &mut Vec<String>) -> Vec<ExportedTable> {
    let mut tables = Vec::new();
    // A model has no sidecar; it is no table.
    for path in paths.iter().filter(|path| sidecar_of(path).exists()) {
        match ExportedTable::read(path) {
            Ok(table) => {
                details.push(say!(
                    "Names the table {table} with its hash",
                    table = table.name
                ));
                tables.push(table);
            }
            Err(because) => details.push(say!(
                "A table is not named in it: {because}",
                because = language::spoken(because.describe())
            )),
        }
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::disk::EXAMPLES;
    use crate::watching::{assert_grows, no_at, report_to};

    #[test]
    fn looking_through_a_session_can_be_cancelled_wherever_it_tells_how_far_it_is() {
        let example = &EXAMPLES[1];
        let through = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
            let loaded = {
                let (document, samples) = example.files();
                pipeline::parse_with_csv(document, samples)
            };
            let progress = Progress::new(watch);
            looked_through(loaded.unwrap(), Origin::Bundled, progress.whole())
        };
        let (shares, loaded_session) = report_to(through);
        assert_grows(&shares);
        assert_eq!(loaded_session.map(|s| s.len()).ok(), Some(30));
        for number in 0..shares.len() {
            assert!(through(&no_at(number)).is_err(), "{number}");
        }
    }

    #[test]
    fn every_bundled_session_can_be_read() {
        for (index, example) in EXAMPLES.iter().enumerate() {
            assert!(open_example(index).is_ok(), "{}", example.name());
        }
    }
}

#[cfg(test)]
mod system_tests {
    use super::*;

    #[test]
    fn a_path_is_one_argument_whatever_is_in_it() {
        let path = Path::new("/tmp/a b; rm -rf $HOME & 'c'.html");
        for in_folder in [false, true] {
            let command = command(path, in_folder);
            let last = command.get_args().last().expect("the path");
            assert!(last == path.as_os_str() || last == "/tmp", "{last:?}");
            let program = command.get_program().to_string_lossy().into_owned();
            assert!(["xdg-open", "open", "explorer"].contains(&&*program));
        }
    }
}

#[cfg(test)]
mod writing_tests {
    use super::*;
    use crate::gui::files::first_example;

    fn wanted() -> ReportRequest {
        ReportRequest {
            source: Source::Session(
                Arc::new(document::Document::new(first_example())),
                None,
                None,
            ),
            stated: Stated::default(),
            tables: Vec::new(),
            inputs: Vec::new(),
        }
    }

    fn files_in(folder: &Path) -> usize {
        std::fs::read_dir(folder).expect("it can be listed").count()
    }

    #[test]
    fn a_cancelled_report_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let watch = Watch::default();
        watch.stop();
        write_report(&wanted(), &folder.path().join("report.pdf"), false, &watch);
        assert_eq!(files_in(folder.path()), 0);
    }

    #[test]
    fn a_file_that_is_cancelled_at_its_end_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("report.html");
        let watch = Watch::default();
        watch.stop();
        assert!(write_one(&path, false, b"text", &watch).is_err());
        assert_eq!(files_in(folder.path()), 0);
        let watch = Watch::default();
        assert_eq!(write_one(&path, false, b"text", &watch), Ok(()));
        assert_eq!(files_in(folder.path()), 1);
    }

    #[test]
    fn a_file_that_cannot_be_written_is_refused_before_the_search() {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, says) in [
            ("report.txt", ".html or .pdf"),
            ("report", ".html or .pdf"),
            ("not there/report.pdf", "folder not found"),
        ] {
            let watch = Watch::default();
            let message = write_report(&wanted(), &folder.path().join(name), false, &watch);
            assert!(
                message.wrong && message.details[0].contains(says),
                "{message:?}"
            );
            assert!(!watch.begun(), "the search was not begun");
        }
    }
}
