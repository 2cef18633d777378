//! A file that an instrument wrote, before it is a session: what a person said about it, and what
//! was seen with that.
//!
//! Every change of what was said is looked at in the background: the file is read again, the robot
//! and the files beside it too, and where nothing is left to ask the whole import is tried. So the
//! sheet shows what an import would bring before it is pressed, and pressing it only takes that.

mod answers;

pub(crate) use answers::{Companion, ImportAnswers, ROBOTS, RobotFrom, TABLES};

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::jobs::Watch;
use crate::importers::{
    self, Alignment, ColumnGuess, IMPORTERS, Inspection, Matched, Settings, inspect_watched,
};
use crate::kinematics::Robot;
use crate::pipeline::import_watched;
use crate::progress::{Cancelled, Progress, ProgressSpan, ReadError};
use crate::sessions::files::open;
use crate::text::{Template, capital, spoken};

/// A file that is longer, in bytes, is not read into memory.
const LONGEST: u64 = 1 << 30;

/// What is said until the file was looked at with everything that was said.
pub(crate) const LOOKING: Template = phrase!("looking at the file");

/// What was seen with what was said.
#[derive(Debug)]
pub(crate) struct InspectedDraft {
    /// What had been said then.
    pub(crate) answers: ImportAnswers,
    /// What was found out about the file.
    pub(crate) inspection: Inspection,
    /// The robot, or why there is none; `None` while it is not stated which.
    pub(crate) robot: Option<Result<Robot, Vec<String>>>,
    /// What the import brings, or why it is refused; `None` while something is open.
    pub(crate) trial: Option<Result<Trial, Vec<String>>>,
    /// Whether only the file of the commands is missing, which is no error yet.
    lacks_commands: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct ImportDraft {
    pub(crate) path: PathBuf,
    bytes: Arc<Vec<u8>>,
    /// What a person said.
    pub(crate) answers: ImportAnswers,
    /// What was typed to find a robot.
    pub(crate) robot_search: String,
    /// What was seen last.
    pub(crate) seen: Arc<InspectedDraft>,
    /// The meanings of the columns that the user has looked at.
    confirmed: Option<Vec<String>>,
}

impl PartialEq for ImportDraft {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bytes, &other.bytes)
            && Arc::ptr_eq(&self.seen, &other.seen)
            && self.answers == other.answers
            && self.robot_search == other.robot_search
            && self.confirmed == other.confirmed
    }
}

impl ImportDraft {
    /// Reads a file if it is none of the program's own: those begin like one. `None`: it is.
    /// Told as this part of something.
    pub(crate) fn of(path: &Path, part: ProgressSpan<'_>) -> Option<Result<Self, ReadError>> {
        let ending = path.extension();
        if ending.is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            return None;
        }
        // The reader of sessions says why a file cannot be read.
        let length = std::fs::metadata(path).ok()?.len();
        if length > LONGEST {
            let found = text!("{length} MB", length = length / 1_000_000);
            let expected =
                text!("a table of at most 1000 MB: export fewer points, or cut it into parts");
            let place = Place::file(path);
            let refused = Rejected::because(Diagnostic::error(place, found, expected));
            return Some(Err(refused.into()));
        }
        let bytes = match open::read_document_in(path, part.part(0.0, 0.1)) {
            Ok(bytes) => bytes,
            Err(ReadError::Rejected(_)) => return None,
            Err(cancelled) => return Some(Err(cancelled)),
        };
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let is_own = start.trim_ascii_start().first() == Some(&b'{');
        (!is_own).then(|| Self::read(path, bytes, part.part(0.1, 1.0)))
    }

    fn read(path: &Path, bytes: Vec<u8>, part: ProgressSpan<'_>) -> Result<Self, ReadError> {
        let answers = ImportAnswers::about(path);
        let seen = InspectedDraft::of(&bytes, path, &answers, part)?;
        if seen.inspection.kind.is_none() {
            // Not even text: there is nothing that anybody could say about it.
            let diagnostics = seen.inspection.findings;
            return Err(Rejected { diagnostics }.into());
        }
        Ok(Self {
            path: path.to_path_buf(),
            bytes: Arc::new(bytes),
            answers,
            robot_search: String::new(),
            seen: Arc::new(seen),
            confirmed: None,
        })
    }

    /// Whether the user answered or confirmed something that would be lost with it.
    pub(crate) fn holds_answers(&self) -> bool {
        self.answers != ImportAnswers::about(&self.path) || self.confirmed.is_some()
    }

    /// Whether this is the same file with the same contents.
    pub(crate) fn is_of_the_file_of(&self, other: &Self) -> bool {
        self.path == other.path && self.bytes == other.bytes
    }

    /// Looks again, with what was said since.
    ///
    /// # Errors
    /// Cancelled.
    pub(crate) fn look(&self, watch: &Watch) -> Result<InspectedDraft, Cancelled> {
        let report_progress = watch.progress_callback();
        let progress = Progress::new(&report_progress);
        InspectedDraft::of(&self.bytes, &self.path, &self.answers, progress.whole())
    }

    /// Takes what was seen, if it was seen of this file.
    pub(crate) fn take(&mut self, other: &Self, seen: InspectedDraft) {
        if Arc::ptr_eq(&self.bytes, &other.bytes) {
            self.seen = Arc::new(seen);
        }
    }

    /// Whether what is seen belongs to what is said.
    pub(crate) fn is_up_to_date(&self) -> bool {
        self.seen.answers == self.answers
    }

    /// Whether columns are only guessed and not confirmed.
    pub(crate) fn asks_for_confirmation(&self) -> bool {
        let columns = &self.seen.inspection.columns;
        columns.iter().any(crate::importers::ColumnGuess::is_guess)
            && self.confirmed.as_ref() != Some(&self.meanings())
    }

    /// The user has looked at the columns.
    pub(crate) fn confirm(&mut self) {
        self.confirmed = Some(self.meanings());
    }

    fn meanings(&self) -> Vec<String> {
        let columns = self.seen.inspection.columns.iter();
        columns.map(|column| column.meaning.clone()).collect()
    }

    /// Why the import is not possible yet, in words, with the first reason that was found; `None`: it is possible.
    pub(crate) fn hindrance(&self) -> Option<String> {
        let inspection = &self.seen.inspection;
        let is_wrong = |finding: &&Diagnostic| finding.severity == Severity::Error;
        let wrong = inspection.findings.iter().find(is_wrong);
        let mut reason = None;
        let says = if !self.is_up_to_date() {
            spoken(LOOKING)
        } else if !inspection.questions.is_empty() {
            say!("Answer what is asked above first")
        } else if let Some(wrong) = wrong {
            reason = Some(in_the_sheets_words(&wrong.to_string()));
            say!("The file cannot be read like this")
        } else if self.asks_for_confirmation() {
            say!("Look at the columns above, and confirm them")
        } else if self.answers.name.trim().is_empty() {
            say!("Give the session a name")
        } else if self.answers.robot == RobotFrom::Open {
            say!("Choose the robot that was measured")
        } else {
            match (&self.seen.robot, &self.seen.trial) {
                (None, _) => say!("Say which file the robot is in"),
                (Some(Err(because)), _) => {
                    reason = because.first().cloned();
                    say!("The robot cannot be read like this")
                }
                (_, Some(Ok(_))) => return None,
                (_, Some(Err(because))) => {
                    reason = because.first().cloned();
                    say!("To fix")
                }
                (_, None) if self.seen.lacks_commands => {
                    say!("Choose the file of the commanded positions: this one has none")
                }
                (_, None) => spoken(LOOKING),
            }
        };
        let reason = reason.map(|reason| format!(": {reason}"));
        Some(capital(says) + &reason.unwrap_or_default())
    }

    /// What it makes of the file, where that went well.
    pub(crate) fn trial(&self) -> Option<&Trial> {
        self.seen.trial.as_ref()?.as_ref().ok()
    }

    /// What the import brings, if nothing stands in its way.
    pub(crate) fn result(&self) -> Option<&Trial> {
        self.trial().filter(|_| self.hindrance().is_none())
    }
}

/// Whether a column says where a joint was sent, such as `q1_deg`.
fn is_command(column: &ColumnGuess) -> bool {
    let joint = column.meaning.strip_prefix('q');
    joint.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

impl InspectedDraft {
    fn of(
        bytes: &[u8],
        path: &Path,
        answers: &ImportAnswers,
        part: ProgressSpan<'_>,
    ) -> Result<Self, Cancelled> {
        let robot = answers.robot();
        let robot = robot.map(|robot| robot.map_err(|rejected| in_words(&rejected.diagnostics)));
        let known = robot.as_ref().and_then(|robot| robot.as_ref().ok());
        let mut reading = answers.reading.clone();
        if let Some(robot) = known {
            let reach = robot.base_from_tool.translation.vector.norm();
            reading.reach_mm = Some(reach).filter(|reach| *reach > 0.0);
        }
        // Without a robot nothing is tried.
        let inspecting = if known.is_some() { 0.3 } else { 1.0 };
        let inspection = inspect_watched(bytes, &reading, part.part(0.0, inspecting).watch())?;
        let is_wrong = |finding: &Diagnostic| finding.severity == Severity::Error;
        let is_open = !inspection.questions.is_empty() || inspection.findings.iter().any(is_wrong);
        let mut lacks_commands = false;
        let trial = match known.filter(|_| !is_open) {
            None => None,
            Some(robot) => match Trial::of(bytes, path, answers, robot, part.part(inspecting, 1.0))
            {
                Ok(trial) => Some(Ok(trial)),
                Err(ReadError::Cancelled(cancelled)) => return Err(cancelled),
                Err(ReadError::Rejected(rejected)) => {
                    let mut errors = rejected.diagnostics.iter().filter(|d| is_wrong(d));
                    lacks_commands = answers.file(Companion::Commands).is_empty()
                        && !inspection.columns.iter().any(is_command)
                        && errors.all(|error| error.expected.contains("--commands"));
                    (!lacks_commands).then(|| Err(in_words(&rejected.diagnostics)))
                }
            },
        };
        part.reached(1.0)?;
        Ok(Self {
            answers: answers.clone(),
            inspection,
            robot,
            trial,
            lacks_commands,
        })
    }
}

/// What an import brings.
#[derive(Debug)]
pub(crate) struct Trial {
    /// The session, ready to be opened.
    pub(crate) loaded_session: Arc<LoadedSession>,
    /// How commands found their measurements.
    pub(crate) matched: Option<Matched>,
    /// How the points came into the base frame.
    pub(crate) alignment: Option<Alignment>,
}

impl Trial {
    /// Tries it.
    ///
    /// # Errors
    /// Why it is refused, or that it was cancelled.
    pub(super) fn of(
        bytes: &[u8],
        path: &Path,
        answers: &ImportAnswers,
        robot: &Robot,
        part: ProgressSpan<'_>,
    ) -> Result<Self, ReadError> {
        let beside = |which| read(answers.file(which));
        let commands = beside(Companion::Commands)?;
        let reference = beside(Companion::Reference)?;
        let targets = beside(Companion::Targets)?;
        let settings = Settings {
            name: answers.name.trim().to_owned(),
            commands: commands.as_ref().map(companion),
            matching: answers.matching,
            clock_offset_s: answers.clock_offset_s,
            reference: reference.as_ref().map(companion),
            scale: answers.scale && reference.is_some(),
            in_measuring_order: answers.in_measuring_order,
            targets: targets.as_ref().map(companion),
            ..Settings::new(answers.reading.clone(), robot)
        };
        let imported = import_watched(bytes, &settings, part.part(0.0, 0.6).watch())?;
        let findings = imported.findings;
        let origin = Origin::Imported(path.to_path_buf());
        let looking = part.part(0.6, 1.0);
        let loaded_session = LoadedSession::watched(imported.session, findings, origin, looking)?;
        Ok(Self {
            loaded_session: Arc::new(loaded_session),
            matched: imported.matched,
            alignment: imported.alignment,
        })
    }
}

type File = (PathBuf, Vec<u8>);

fn read(typed: &str) -> Result<Option<File>, Rejected> {
    if typed.is_empty() {
        return Ok(None);
    }
    let path = PathBuf::from(typed);
    let bytes = open::read_document(&path)?;
    Ok(Some((path, bytes)))
}

fn companion((path, bytes): &File) -> importers::Companion<'_> {
    importers::Companion {
        bytes,
        file: Some(path.clone()),
    }
}

/// No more lines than can be read.
pub(crate) fn listed(mut lines: Vec<String>) -> Vec<String> {
    const MOST: usize = 8;
    let more = lines.len().saturating_sub(MOST);
    lines.truncate(MOST);
    if more > 0 {
        lines.push(say!("and {more} more", more));
    }
    lines
}

/// What is wrong, no more than can be read.
pub(super) fn in_words(findings: &[Diagnostic]) -> Vec<String> {
    let is_error = |finding: &&Diagnostic| finding.severity == Severity::Error;
    let errors = findings.iter().filter(is_error);
    listed(errors.map(in_the_windows_words).collect())
}

/// What an option of the command line, with a value that is the same in every language, is called on the sheet.
const OPTIONS: [(&str, Template); 15] = [
    (
        "--in-measuring-order",
        phrase!("the rows are in the order in which they were measured"),
    ),
    ("--clock-offset", phrase!("Clocks apart by")),
    ("--match order", phrase!("by order")),
    ("--match name", phrase!("by name")),
    ("--match", phrase!("Matched")),
    ("--commands", phrase!("File of the commands")),
    ("--targets", phrase!("File of the reflectors")),
    ("--reference", phrase!("File of the known points")),
    ("--angle-unit", phrase!("Angles in")),
    ("--separator", phrase!("Separated by")),
    ("--decimal", phrase!("Decimal sign")),
    ("--z-up", phrase!("y points up: turn it so that z does")),
    ("--scale", phrase!("fit a scale too")),
    ("--joint", phrase!("Joint measured")),
    ("--unit", phrase!("Lengths in")),
];

/// A finding in the words of the window: what is only noted needs no key of the document.
pub(crate) fn in_the_windows_words(finding: &Diagnostic) -> String {
    let mut finding = finding.clone();
    let Place { file, field, .. } = &mut finding.place;
    let of_a_document = file.as_ref().and_then(|file| file.extension()) == Some("json".as_ref());
    let is_key = of_a_document || field.as_ref().is_some_and(|field| field.contains('.'));
    if finding.severity == Severity::Note && is_key {
        *field = None;
    }
    in_the_sheets_words(&crate::language::finding(&finding))
}

/// The same sentence with the names that the sheet has for the command line's options.
pub(crate) fn in_the_sheets_words(sentence: &str) -> String {
    let said = OPTIONS.iter().fold(
        sentence.replace("--columns", say!("the columns above as")),
        |said, (option, field)| said.replace(option, &format!("“{}”", spoken(*field))),
    );
    // Options that one format has, the longer names first: one may begin like another.
    let own = IMPORTERS.iter().flat_map(|importer| importer.options);
    let mut own: Vec<_> = own.map(|option| (option.name, option.title)).collect();
    own.sort_by_key(|(name, _)| std::cmp::Reverse(name.len()));
    own.into_iter().fold(said, |said, (name, title)| {
        said.replace(&format!("--{name}"), &format!("“{}”", spoken(title)))
    })
}
