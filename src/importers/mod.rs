//! Files that instruments write, made into sessions.
//!
//! ```text
//! bytes → text → rows → grid (separator, header, decimal sign) → one reader per format → columns
//! columns + commands (by order, name or time) + reference points → session
//! ```
//!
//! Nothing is guessed silently. [`inspect`] says what was found out about a file and what only a
//! person can answer; the answers go into [`Reading`], and [`import`] makes the session or refuses
//! with every reason and its place. The command line and the window ask the same questions.
//!
//! A new format is one file like `tum.rs` and one line in [`IMPORTERS`].

mod assembled;
mod averages;
mod base;
mod beside;
mod case;
mod clock;
mod clock_text;
mod columns;
mod commanded;
mod csv;
mod decimals;
mod grid;
mod headings;
mod iso230;
mod join;
mod matching;
mod optitrack;
mod path;
mod reference;
mod rows;
mod session;
mod settings;
mod text;
mod tracker;
mod tum;
mod units;
#[cfg(test)]
mod watched;

pub use clock::ClockOffset;
pub use decimals::Decimal;
pub use join::Motion;
pub use matching::Matching;
pub use reference::{AlignError, Alignment, Landmark, Residual, align};
pub use rows::Separator;
pub use session::{Companion, Imported, Matched, Settings, import, import_watched};
pub use settings::{About, ColumnGuess, Inspection, Kind, Known, Question, Reading};
pub use text::Encoding;
pub use units::{AngleUnit, LengthUnit};

use case::Case;
use columns::Columns;

use std::ops::ControlFlow;

use crate::diagnostic::{Diagnostic, Severity};
use crate::progress::{Cancelled, Part, Progress, unwatched};

/// A format that instruments write.
pub struct Importer {
    /// Which one.
    pub kind: Kind,
    /// What it is, for lists.
    pub about: &'static str,
    read: fn(&mut Case<'_>) -> Option<Columns>,
}

/// All of them.
pub const IMPORTERS: [Importer; 5] = [
    Importer {
        kind: Kind::Csv,
        about: "any table with a header, or with --columns",
        read: csv::read,
    },
    Importer {
        kind: Kind::Tracker,
        about: "laser tracker or SpatialAnalyzer text: names, x, y, z",
        read: tracker::read,
    },
    Importer {
        kind: Kind::Iso230,
        about: "ISO 230-2 runs of one axis, long or wide",
        read: iso230::read,
    },
    Importer {
        kind: Kind::Optitrack,
        about: "OptiTrack Motive CSV 1.2x",
        read: optitrack::read,
    },
    Importer {
        kind: Kind::Tum,
        about: "TUM trajectory",
        read: tum::read,
    },
];

/// The format with this name.
pub fn find(id: &str) -> Option<&'static Importer> {
    IMPORTERS.iter().find(|importer| importer.kind.id() == id)
}

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
fn read(bytes: &[u8], reading: &Reading, part: Part<'_>) -> (Inspection, Option<Columns>) {
    let place = reading.place();
    let mut found = Inspection::default();
    let (text, encoding) = match text::decode(bytes, &place, &mut found.findings) {
        Ok(decoded) => decoded,
        Err(error) => {
            found.findings.push(*error);
            return (found, None);
        }
    };
    found.encoding = encoding;
    let kind = reading
        .kind
        .unwrap_or_else(|| proposed(&text, reading, part));
    found.kind = Some(kind);
    let mut case = Case {
        text: &text,
        reading,
        place,
        found,
        part,
    };
    let importer = IMPORTERS.iter().find(|importer| importer.kind == kind);
    let columns = importer.and_then(|importer| (importer.read)(&mut case));
    let columns = columns.filter(|_| !case.is_open());
    (case.found, columns)
}

/// The kind that a text looks like.
fn proposed(text: &str, reading: &Reading, part: Part<'_>) -> Kind {
    if optitrack::is_likely(text) {
        return Kind::Optitrack;
    }
    // Each reader is asked whether it has anything against the file, the pickier ones first.
    let silent = |kind: Kind| {
        let importer = IMPORTERS.iter().find(|importer| importer.kind == kind);
        let mut case = Case {
            text,
            reading,
            place: reading.place(),
            found: Inspection::default(),
            part,
        };
        let read = importer.and_then(|importer| (importer.read)(&mut case));
        let asks_for_columns = case
            .found
            .questions
            .iter()
            .any(|q| q.about == About::Columns);
        let errors = |finding: &Diagnostic| finding.severity == Severity::Error;
        let is_sound = !asks_for_columns && !case.found.findings.iter().any(errors);
        let names = case
            .found
            .columns
            .iter()
            .map(|column| column.heading.as_str());
        // The format's own names, behind a comment sign, are no header of a table.
        let has_header = case.found.header_line.is_some() && !names.eq(tum::NAMES);
        (is_sound, has_header, read.is_some())
    };
    if let (true, false, true) = silent(Kind::Tum) {
        return Kind::Tum;
    }
    if let (true, true, _) = silent(Kind::Csv) {
        return Kind::Csv;
    }
    if let (true, true, _) = silent(Kind::Iso230) {
        return Kind::Iso230;
    }
    if let (true, ..) = silent(Kind::Tracker) {
        return Kind::Tracker;
    }
    Kind::Csv
}
