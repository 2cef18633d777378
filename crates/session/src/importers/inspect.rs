//! From the bytes of a file to its columns: which format it is, what was found out, and what is to be asked.

use crate::diagnostic::{Diagnostic, Severity};
use crate::progress::{Cancelled, Progress, ProgressSpan, unwatched};
use std::borrow::Cow;
use std::ops::ControlFlow;

use super::columns::Columns;
use super::formats;
use super::formats::{IMPORTERS, Importer, KnownBy, Suits, Trial};
use super::settings::{About, Inspection, ReadContext, Reading};
use crate::tables::encoding::{self, Encoding};

/// Looks at a file: what it is, what its columns are taken for, and what has to be answered before
/// it can be imported. Without a kind in `reading` one is proposed.
pub fn inspect(bytes: &[u8], reading: &Reading) -> Inspection {
    let progress = Progress::new(&unwatched);
    read(bytes, reading, progress.whole()).0
}

/// As [`inspect`]. `watch` hears now and then which part is done (0 to 1), and may break it off. A
/// file is gone through until it is understood; how often shows only on the way.
///
/// # Errors
/// [`Cancelled`].
pub fn inspect_watched(
    bytes: &[u8],
    reading: &Reading,
    watch: impl Fn(f64) -> ControlFlow<()>,
) -> Result<Inspection, Cancelled> {
    let progress = Progress::new(&watch);
    let (inspection, _) = read(bytes, reading, progress.whole());
    progress.whole().reached(1.0)?;
    Ok(inspection)
}

/// Reads a file as far as it goes; the columns are there if nothing is left to ask or to mend. What
/// was cancelled means nothing.
pub(super) fn read(
    bytes: &[u8],
    reading: &Reading,
    part: ProgressSpan<'_>,
) -> (Inspection, Option<Columns>) {
    let mut found = Inspection::default();
    let is_binary = |importer: &&Importer| match importer.known_by {
        KnownBy::Bytes(is) => {
            reading.kind == Some(*importer) || reading.kind.is_none() && is(bytes)
        }
        _ => false,
    };
    let binary = IMPORTERS.iter().copied().find(is_binary);
    let decoded = if binary.is_some() {
        Ok((Cow::Borrowed(""), Encoding::Binary))
    } else {
        encoding::decode(bytes, &reading.place(), &mut found.findings)
    };
    let (text, encoding) = match decoded {
        Ok(decoded) => decoded,
        Err(error) => {
            found.findings.push(*error);
            return (found, None);
        }
    };
    found.encoding = encoding;
    let known = binary.or(reading.kind);
    let importer = known.unwrap_or_else(|| proposed(&text, reading, part));
    found.kind = Some(importer);
    let mut context = ReadContext {
        found,
        ..ReadContext::new(&text, bytes, reading, part)
    };
    let columns = (importer.read)(&mut context).filter(|_| !context.is_open());
    (context.found, columns)
}

/// The format that a text looks like: each is asked whether it has anything against the file, the
/// pickier ones first.
pub(super) fn proposed(text: &str, reading: &Reading, part: ProgressSpan<'_>) -> &'static Importer {
    let is_like = |importer: &&Importer| match importer.known_by {
        KnownBy::Text(is) => is(text),
        _ => false,
    };
    if let Some(importer) = IMPORTERS.iter().copied().find(is_like) {
        return importer;
    }
    let mut asked: Vec<(u8, &'static Importer, Suits)> = IMPORTERS
        .iter()
        .filter_map(|&importer| match importer.known_by {
            KnownBy::Reading { turn, suits } => Some((turn, importer, suits)),
            KnownBy::Bytes(_) | KnownBy::Text(_) => None,
        })
        .collect();
    asked.sort_by_key(|(turn, ..)| *turn);
    let tried = |importer: &Importer| {
        let mut context = ReadContext::new(text, text.as_bytes(), reading, part);
        let read = (importer.read)(&mut context);
        let found = context.found;
        let asks_for_columns = found.questions.iter().any(|q| q.about == About::Columns);
        let is_error = |finding: &Diagnostic| finding.severity == Severity::Error;
        let headings = found.columns.into_iter().map(|column| column.heading);
        Trial {
            is_sound: !asks_for_columns && !found.findings.iter().any(is_error),
            headings: found.header_line.map(|_| headings.collect()),
            is_complete: read.is_some(),
        }
    };
    let suited = asked
        .iter()
        .find(|(_, importer, suits)| suits(&tried(importer)));
    // Of a table that nothing suits, a table's questions are asked.
    suited.map_or(&formats::csv::IMPORTER, |(_, importer, _)| importer)
}
