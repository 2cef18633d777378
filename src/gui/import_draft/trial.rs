//! An import that is tried: the session it makes, or why it is refused, in the sheet's words.

use crate::text::{Template, spoken};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::answers::ImportAnswers;
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::explain::{Detail, Section, imported};
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::importers::{Alignment, Companion, IMPORTERS, Matched, Settings};
use crate::kinematics::Robot;
use crate::pipeline::import_watched;
use crate::present::units::Units;
use crate::progress::{ProgressSpan, ReadError};
use crate::sessions::Target;
use crate::sessions::files::open;
use crate::tables::as_cell;

/// What an import brings.
#[derive(Debug)]
pub(crate) struct Trial {
    /// The session, ready to be opened.
    pub(crate) loaded_session: Arc<LoadedSession>,
    /// How commands found their measurements.
    pub(crate) matched: Option<Matched>,
    /// How the points came into the base frame.
    pub(crate) alignment: Option<Alignment>,
    /// Warnings and notes, in words.
    pub(crate) notes: Vec<(Severity, String)>,
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
        let commands = read(&answers.commands)?;
        let reference = read(&answers.reference)?;
        let targets = read(&answers.targets)?;
        let own_targets = answers
            .own_targets
            .as_ref()
            .map(|targets| table_of(targets));
        let own_targets = own_targets
            .as_ref()
            .map(|bytes| Companion { bytes, file: None });
        let settings = Settings {
            name: answers.name.trim().to_owned(),
            commands: commands.as_ref().map(companion),
            matching: answers.matching,
            clock_offset_s: answers.clock_offset_s,
            reference: reference.as_ref().map(companion),
            scale: answers.scale && reference.is_some(),
            in_measuring_order: answers.in_measuring_order,
            targets: targets.as_ref().map(companion).or(own_targets),
            ..Settings::new(answers.reading.clone(), robot)
        };
        let imported = import_watched(bytes, &settings, part.part(0.0, 0.6).watch())?;
        let findings = imported.findings;
        let notes = findings
            .iter()
            .map(|finding| (finding.severity, in_the_windows_words(finding)))
            .collect();
        let origin = Origin::Imported(path.to_path_buf());
        let looking = part.part(0.6, 1.0);
        let loaded_session = LoadedSession::watched(imported.session, findings, origin, looking)?;
        Ok(Self {
            loaded_session: Arc::new(loaded_session),
            matched: imported.matched,
            alignment: imported.alignment,
            notes,
        })
    }
}

impl Trial {
    /// What it brings, as it is said everywhere.
    pub(crate) fn brings(&self, units: Units) -> Section {
        let loaded_session = &self.loaded_session;
        imported(
            loaded_session.len(),
            loaded_session.gap_before,
            self.matched.as_ref(),
            self.alignment.as_ref(),
            Detail::window(units),
        )
    }
}

/// Reflectors as a file of them has them.
fn table_of(targets: &[Target]) -> Vec<u8> {
    let row = |target: &Target| {
        let [x, y, z] = target.position_mm.coords.into();
        format!("{},{x},{y},{z}\n", as_cell(&target.name))
    };
    let rows: String = targets.iter().map(row).collect();
    format!("name,x_mm,y_mm,z_mm\n{rows}").into_bytes()
}

type File = (PathBuf, Vec<u8>);

fn read(typed: &str) -> Result<Option<File>, Rejected> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Ok(None);
    }
    let path = PathBuf::from(typed);
    let bytes = open::read_document(&path)?;
    Ok(Some((path, bytes)))
}

fn companion((path, bytes): &File) -> Companion<'_> {
    Companion {
        bytes,
        file: Some(path.clone()),
    }
}

/// Findings as lines, errors first and no more than can be read.
pub(super) fn in_words(findings: &[Diagnostic]) -> Vec<String> {
    const MOST: usize = 8;
    let is_error = |finding: &&Diagnostic| finding.severity == Severity::Error;
    let errors: Vec<&Diagnostic> = findings.iter().filter(is_error).collect();
    let shown = errors.iter().take(MOST);
    let mut lines: Vec<String> = shown.map(|finding| in_the_windows_words(finding)).collect();
    if errors.len() > MOST {
        lines.push(say!(in "common", "and {more} more", more = errors.len() - MOST));
    }
    lines
}

/// What an option of the command line, with a value that is the same in every language, is called on the sheet.
const OPTIONS: [(&str, Template); 16] = [
    (
        "--in-measuring-order",
        phrase!("“the rows are in the order in which they were measured”"),
    ),
    ("--clock-offset", phrase!("“Clocks apart by”")),
    ("--match order", phrase!("“Matched” by order")),
    ("--match name", phrase!("“Matched” by name")),
    ("--match", phrase!("“Matched”")),
    ("--commands", phrase!("a file of commands")),
    ("--targets", phrase!("a file of reflectors")),
    ("--reference", phrase!("a file of known points")),
    ("--angle-unit", phrase!("“Angles in”")),
    ("--separator", phrase!("“Separated by”")),
    ("--decimal", phrase!("“Decimal sign”")),
    ("--columns", phrase!("the columns above as")),
    ("--z-up", phrase!("“y points up”")),
    ("--scale", phrase!("“fit a scale too”")),
    ("--joint", phrase!("“Joint measured”")),
    ("--unit", phrase!("“Lengths in”")),
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
    let said = OPTIONS
        .iter()
        .fold(sentence.to_owned(), |said, (option, field)| {
            said.replace(option, spoken(*field))
        });
    // Options that one format has, the longer names first: one may begin like another.
    let own = IMPORTERS.iter().flat_map(|importer| importer.options);
    let mut own: Vec<_> = own.map(|option| (option.name, option.title)).collect();
    own.sort_by_key(|(name, _)| std::cmp::Reverse(name.len()));
    own.into_iter().fold(said, |said, (name, title)| {
        said.replace(&format!("--{name}"), &format!("“{}”", spoken(title)))
    })
}
