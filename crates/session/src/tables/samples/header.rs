//! The first line, and what a file looks like that is no session CSV at all.

use crate::text::{Template, Text};

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{any_decimal, quoted};
use crate::tables::encoding::{Mark, mark};

use super::cells::{Sample, Stop, UTF_8};

/// A session has fewer columns, with every quantity of a hundred joints.
const MOST_COLUMNS: usize = 10_000;

/// As much as tells what a file is.
const START: usize = 1 << 18;

/// Reads the headings, and where the next line starts; `None`, with the reason in `findings`, when the file is
/// something else.
pub(super) fn read(
    bytes: &[u8],
    file: &Place,
    findings: &mut Vec<Diagnostic>,
) -> Option<(Vec<String>, usize)> {
    let mut at = match mark(bytes) {
        Some((Mark::Utf8, length)) => length,
        _ => 0,
    };
    let start = &bytes[at..bytes.len().min(at + START)];
    if let Some(diagnostic) = something_else(start, file) {
        findings.push(diagnostic);
        return None;
    }
    let mut names = Vec::new();
    loop {
        let cell = Sample::read(bytes, at);
        match cell.text() {
            Ok(_) if names.len() == MOST_COLUMNS => {
                findings.push(Diagnostic::error(
                    file.clone().at_line(1),
                    text!(one "{count} column", "{count} columns", count = MOST_COLUMNS + 1),
                    text!("a table of at most {most} columns", most = MOST_COLUMNS),
                ));
                return None;
            }
            Ok(text) if cell.line_feeds == 0 => names.push(text.trim().to_owned()),
            Ok(text) => {
                let place = file.clone().at_line(1).at_column(names.len() as u64 + 1);
                findings.push(Diagnostic::error(
                    place,
                    Text::verbatim(quoted(text)),
                    text!("a heading on one line"),
                ));
                return None;
            }
            Err((found, expected)) => {
                let place = file.clone().at_line(1).at_column(names.len() as u64 + 1);
                findings.push(Diagnostic::error(place, found, expected));
                return None;
            }
        }
        at = cell.after;
        if cell.stop == Stop::Line {
            break;
        }
    }
    wrong_dialect(&names, file, findings).then_some((names, at))
}

/// Recognises what is no text by its first bytes.
fn something_else(start: &[u8], file: &Place) -> Option<Diagnostic> {
    let error = |found: Text, expected: Template| {
        Some(Diagnostic::error(file.clone().at_line(1), found, expected))
    };
    if start.trim_ascii().is_empty() {
        return error(
            text!("an empty file"),
            phrase!("a CSV file: headings and one line per sample"),
        );
    }
    match mark(start) {
        Some((Mark::Utf16Le | Mark::Utf16Be, _)) => {
            return error(text!("a file in {encoding}", encoding = "UTF-16"), UTF_8);
        }
        Some((Mark::Utf32, _)) => {
            return error(text!("a file in {encoding}", encoding = "UTF-32"), UTF_8);
        }
        Some((Mark::Utf8, _)) | None => {}
    }
    let nul = memchr::memchr(0, start)?;
    if nul <= 1 && start.len() > 3 && start[(nul + 1) % 2].is_ascii_graphic() {
        return error(text!("a file in {encoding}", encoding = "UTF-16"), UTF_8);
    }
    error(
        text!("a zero byte"),
        phrase!("a CSV file: headings and one line per sample"),
    )
}

/// Whether the headings are separated as they should be; says what to do if not.
fn wrong_dialect(names: &[String], file: &Place, findings: &mut Vec<Diagnostic>) -> bool {
    let place = file.clone().at_line(1);
    if let [only] = names {
        for (separator, called) in [(';', "semicolons"), ('\t', "tabs")] {
            if only.contains(separator) {
                findings.push(Diagnostic::error(
                    place,
                    text!(
                        "headings separated by {called}: {only}",
                        called,
                        only = quoted(only)
                    ),
                    text!(
                        "commas (and decimal points); `truepose import FILE --as csv` reads other \
                     separators and decimal commas"
                    ),
                ));
                return false;
            }
        }
    }
    if names.iter().all(|name| any_decimal(name).is_ok()) {
        findings.push(Diagnostic::error(
            place,
            text!(
                "numbers in the first line: {names}",
                names = quoted(&names.join(","))
            ),
            text!(
                "headings such as q1_deg,x_mm,y_mm,z_mm; `truepose import FILE --as tracker` reads \
             files without headings"
            ),
        ));
        return false;
    }
    true
}
