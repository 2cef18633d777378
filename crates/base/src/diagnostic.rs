//! Diagnostics: what is wrong with an input, where, and what to do next.
//!
//! Bad data yields diagnostics, bugs yield panics. A reader collects every problem it can find before it gives up, so
//! that a technician corrects a file once and not ten times.

use crate::text::Text;
use std::io;
use std::path::{Path, PathBuf};

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing; nothing was left out.
    Note,
    /// Something was left out or assumed; the job can go on.
    Warning,
    /// The input cannot be used.
    Error,
}

/// Where in the input a finding is. Lines and columns count from 1; a column is a byte of a JSON
/// document and a cell of a table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Place {
    /// The file, as the user named it.
    pub file: Option<PathBuf>,
    /// Line in the file.
    pub line: Option<u64>,
    /// Column in the line.
    pub column: Option<u64>,
    /// The column's heading, or the path of a JSON key such as `robot.joints[0].axis`.
    pub field: Option<String>,
}

impl Place {
    /// A whole file.
    pub fn file(path: impl AsRef<Path>) -> Self {
        Self {
            file: Some(path.as_ref().to_path_buf()),
            ..Self::default()
        }
    }

    /// The same place, at this line.
    #[must_use]
    pub fn at_line(mut self, line: u64) -> Self {
        self.line = Some(line);
        self
    }

    /// The same place, at this column.
    #[must_use]
    pub fn at_column(mut self, column: u64) -> Self {
        self.column = Some(column);
        self
    }

    /// The same place, in this field.
    #[must_use]
    pub fn in_field(mut self, field: impl Into<String>) -> Self {
        self.field = Some(field.into());
        self
    }
}

impl Place {
    /// In words; nothing where nothing is known of it.
    pub fn describe(&self) -> Text {
        let file = self.file.as_ref();
        let parts = [
            file.map(|file| Text::verbatim(file.display().to_string())),
            self.line.map(|line| text!("line {line}", line)),
            self.column.map(|column| text!("column {column}", column)),
            self.field.as_ref().map(Text::verbatim),
        ];
        let all = parts.into_iter().flatten();
        let all = all.reduce(|all, next| text!("{first}, {next}", first = all, next));
        all.unwrap_or_default()
    }
}

displays_what_it_says!(Place);

/// One finding: what was found, what was expected, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// How much it matters.
    pub severity: Severity,
    /// Where it is.
    pub place: Place,
    /// The content of that place.
    pub found: Text,
    /// The expected content; empty for a plain note.
    pub expected: Text,
    /// The samples that it is about, counted from 0; empty where it is about none in particular.
    pub samples: Vec<usize>,
}

impl Diagnostic {
    /// A finding that makes the input unusable.
    pub fn error(place: Place, found: impl Into<Text>, expected: impl Into<Text>) -> Self {
        Self {
            severity: Severity::Error,
            place,
            found: found.into(),
            expected: expected.into(),
            samples: Vec::new(),
        }
    }

    /// The same finding with the name of its file instead of the whole path: for a person who knows
    /// which folder it is in.
    #[must_use]
    pub fn without_folder(mut self) -> Self {
        let name = self.place.file.as_deref().and_then(Path::file_name);
        if let Some(name) = name.map(PathBuf::from) {
            self.place.file = Some(name);
        }
        self
    }

    /// The same finding, about these samples (counted from 0).
    #[must_use]
    pub fn about(mut self, samples: &[usize]) -> Self {
        self.samples = samples.to_vec();
        self
    }

    /// A finding that leaves something out.
    pub fn warning(place: Place, found: impl Into<Text>, expected: impl Into<Text>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(place, found, expected)
        }
    }

    /// A finding that is only worth knowing.
    pub fn note(place: Place, found: impl Into<Text>) -> Self {
        Self {
            severity: Severity::Note,
            ..Self::error(place, found, Text::default())
        }
    }
}

impl Diagnostic {
    /// In words: where it is, what was found, and what was expected.
    pub fn describe(&self) -> Text {
        let found = if self.expected.is_empty() {
            self.found.clone()
        } else {
            text!(
                "{found}; expected {expected}",
                found = &self.found,
                expected = &self.expected
            )
        };
        match self.place.describe() {
            nowhere if nowhere.is_empty() => found,
            place => text!("{place}: {found}", place, found),
        }
    }
}

displays_what_it_says!(Diagnostic);

/// An input that was refused: at least one diagnostic is an error.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Rejected {
    /// Everything that was found, in the order of the input.
    pub diagnostics: Vec<Diagnostic>,
}

impl Rejected {
    #[doc(hidden)]
    pub fn of(diagnostics: Vec<Diagnostic>) -> Self {
        Self {
            diagnostics: summarised(diagnostics),
        }
    }

    /// A refusal with a single reason.
    pub fn because(diagnostic: Diagnostic) -> Self {
        Self::of(vec![diagnostic])
    }
}

impl Rejected {
    /// In words, a line for each finding.
    pub fn describe(&self) -> Text {
        Text::listed(self.diagnostics.iter().map(Diagnostic::describe), "\n")
    }
}

displays_what_it_says!(Rejected);

/// Findings of one severity that are worth reading; the rest is counted.
const MOST_FINDINGS: usize = 200;

/// The first findings of each severity, and how many more there are: a file can be wrong in as many
/// places as it has bytes, and its reader reads none of them then.
#[doc(hidden)]
pub fn summarised(findings: Vec<Diagnostic>) -> Vec<Diagnostic> {
    if findings.len() <= MOST_FINDINGS {
        return findings;
    }
    let mut counts = [0_usize; 3];
    let mut first_more: [Option<Place>; 3] = [const { None }; 3];
    let mut kept: Vec<Diagnostic> = Vec::with_capacity(3 * MOST_FINDINGS);
    for finding in findings {
        let count = &mut counts[finding.severity as usize];
        *count += 1;
        if *count <= MOST_FINDINGS {
            kept.push(finding);
        } else {
            first_more[finding.severity as usize].get_or_insert(finding.place);
        }
    }
    for severity in [Severity::Note, Severity::Warning, Severity::Error] {
        let more = counts[severity as usize].saturating_sub(MOST_FINDINGS);
        if let Some(place) = first_more[severity as usize].take() {
            let summary = match severity {
                Severity::Note => {
                    text!(one "{count} more note like these", "{count} more notes like these", count = more)
                }
                Severity::Warning => {
                    text!(one "{count} more warning like these", "{count} more warnings like these", count = more)
                }
                Severity::Error => {
                    text!(one "{count} more error like these", "{count} more errors like these", count = more)
                }
            };
            kept.push(Diagnostic {
                severity,
                ..Diagnostic::note(place, summary)
            });
        }
    }
    kept
}

/// Why a file cannot be read.
#[doc(hidden)]
pub fn unreadable(error: &io::Error) -> Text {
    match error.kind() {
        io::ErrorKind::NotFound => text!("no such file"),
        io::ErrorKind::PermissionDenied => text!("no permission to read it"),
        _ => Text::verbatim(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_findings_are_counted_and_an_error_is_never_lost() {
        let note = |k: u64| Diagnostic::note(Place::file("a").at_line(k), Text::verbatim("odd"));
        let mut findings: Vec<Diagnostic> = (0..100_000).map(note).collect();
        findings.push(Diagnostic::error(
            Place::file("a"),
            Text::verbatim("wrong"),
            Text::verbatim("right"),
        ));
        let few = summarised(findings.clone());
        assert_eq!(few.len(), MOST_FINDINGS + 2);
        assert_eq!(few[MOST_FINDINGS].severity, Severity::Error);
        assert_eq!(
            few[MOST_FINDINGS + 1].to_string(),
            "a, line 200: 99800 more notes like these"
        );
        assert_eq!(summarised(findings[..10].to_vec()), findings[..10]);
    }

    #[test]
    fn a_diagnostic_reads_as_place_found_expected() {
        let place = Place::file("a b.csv")
            .at_line(3)
            .at_column(2)
            .in_field("x_mm");
        let found = Diagnostic::error(place, Text::verbatim("'abc'"), text!("a number"));
        assert_eq!(
            found.to_string(),
            "a b.csv, line 3, column 2, x_mm: 'abc'; expected a number"
        );
    }
}
