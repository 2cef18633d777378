//! Saves a session: the document, and its samples as a CSV file beside it.
//!
//! Both files are on the disk under names of their own before either gets its real name; then the
//! samples are renamed, then the document. What fails before leaves the old pair; a failure
//! between the two puts the old samples back. Only a kill in that instant can leave the new samples
//! beside the old document; the document holds the hash of its own, so that reading says so.
//!
//! Numbers are written with the fewest digits that read back as the same double, angles in degrees,
//! so that a session that was read saves and loads to the last bit.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::atomic::{
    StagedFile, WriteError, commit_both, refuse_one_file_for_two, refuse_to_replace_inputs,
};
use crate::document::{Member, Value, object, text_of, write_document, write_number};
use crate::kinematics::Robot;
use crate::progress::{Cancelled, Progress, ProgressSpan, unwatched};
use crate::sessions::consistency;
use crate::sessions::domain::Session;
use crate::sessions::files::file_hash::Hashed;
use crate::sessions::files::format_v1::head;
use crate::sessions::files::format_v1::robot::ROBOT;
use crate::sessions::files::saved_columns::{Values, columns};
use crate::tables::as_cell;

/// What an output may replace.
#[derive(Debug, Clone, Copy, Default)]
pub struct Replacing<'a> {
    /// Whether existing files may be replaced.
    pub force: bool,
    /// Files that the output was made from: these are never replaced.
    pub inputs: &'a [&'a Path],
}

/// A robot as a file of its own: the `robot` object of a session, which `load_robot` reads.
pub fn robot_document(robot: &Robot) -> String {
    text_of(&(ROBOT.write)(robot))
}

/// The file that holds the samples of the session document at `path`.
pub fn samples_path(path: &Path) -> PathBuf {
    path.with_extension("csv")
}

/// Saves the session as `path` and its samples as a CSV file of the same name beside it. Returns
/// the path of the CSV file.
///
/// # Errors
/// [`WriteError`]; then the files that were there before are there still.
pub fn save(
    session: &Session,
    path: &Path,
    replacing: Replacing<'_>,
) -> Result<PathBuf, WriteError> {
    save_watched(session, path, replacing, unwatched)
}

/// As [`save`]. `watch` hears now and then which part is done (0 to 1), and may break it off: until
/// it has heard 1 nothing stands under its name.
///
/// # Errors
/// As [`save`], and [`WriteError::Cancelled`].
pub fn save_watched(
    session: &Session,
    path: &Path,
    replacing: Replacing<'_>,
    watch: impl Fn(f64) -> ControlFlow<()>,
) -> Result<PathBuf, WriteError> {
    let csv = samples_path(path);
    save_pair(session, path, &csv, replacing, watch)?;
    Ok(csv)
}

/// As [`save`], with the samples in a file that is named: in the folder of the session, or below it.
///
/// # Errors
/// As [`save`].
pub fn save_with_samples(
    session: &Session,
    path: &Path,
    csv: &Path,
    replacing: Replacing<'_>,
) -> Result<(), WriteError> {
    save_pair(session, path, csv, replacing, unwatched)
}

fn save_pair(
    session: &Session,
    path: &Path,
    csv: &Path,
    replacing: Replacing<'_>,
    watch: impl Fn(f64) -> ControlFlow<()>,
) -> Result<(), WriteError> {
    let progress = Progress::new(&watch);
    let whole = progress.whole();
    refuse_one_file_for_two(path, csv)?;
    refuse_to_replace_inputs(path, replacing.inputs)?;
    refuse_to_replace_inputs(csv, replacing.inputs)?;
    let csv_name = name_of(path, csv)?;
    let fits = columns_fit(session);
    fits.map_err(|source| WriteError::Io {
        path: path.to_path_buf(),
        source,
    })?;
    let mut sha256 = String::new();
    let samples = StagedFile::write(csv, replacing.force, |output| {
        let mut hashed = Hashed::new(output);
        write_rows(session, &mut hashed, whole.part(0.0, 0.9))?;
        sha256 = hashed.finish();
        Ok(())
    })?;
    let samples_there = object! { "file": csv_name, "sha256": sha256.as_str() };
    let document = head::write(session).with(object! { "samples": samples_there });
    let document = StagedFile::write(path, replacing.force, |output| {
        write_document(output, &document)
    })?;
    let done = whole.reached(1.0);
    done.map_err(|Cancelled| WriteError::Cancelled(path.to_path_buf()))?;
    commit_both(samples, document)
}

/// How a session at `path` names its samples.
fn name_of<'a>(path: &Path, csv: &'a Path) -> Result<&'a str, WriteError> {
    let name = csv.file_name().and_then(|name| name.to_str());
    name.ok_or_else(|| WriteError::Io {
        path: path.to_path_buf(),
        source: io::Error::new(
            io::ErrorKind::InvalidFilename,
            "a file name in UTF-8 is needed",
        ),
    })
}

/// Writes the session as a single document, samples inline: what goes to standard output.
///
/// # Errors
/// What writing to `output` says.
pub fn write_inline(session: &Session, output: impl Write) -> io::Result<()> {
    columns_fit(session)?;
    let columns = columns(session).into_iter();
    let columns = columns.map(|column| Member::new(column.name, column.values.inline()));
    let samples = object! { "columns": Value::Object(columns.collect()) };
    let document = head::write(session).with(object! { "samples": samples });
    write_document(output, &document)
}

/// Writes the samples as CSV.
///
/// # Errors
/// What writing to `output` says.
pub fn write_csv(session: &Session, output: &mut dyn Write) -> io::Result<()> {
    columns_fit(session)?;
    let progress = Progress::new(&unwatched);
    write_rows(session, output, progress.whole())
}

/// Columns of different lengths are no table, and half of one is not written.
fn columns_fit(session: &Session) -> io::Result<()> {
    let rejected = |rejected| io::Error::new(io::ErrorKind::InvalidInput, rejected);
    consistency::columns_fit(session).map_err(rejected)
}

/// Rows that are written between two looks at the watcher.
const AT_ONCE: usize = 4096;

fn write_rows(session: &Session, output: &mut dyn Write, part: ProgressSpan<'_>) -> io::Result<()> {
    let columns = columns(session);
    for (index, column) in columns.iter().enumerate() {
        if index > 0 {
            output.write_all(b",")?;
        }
        write_text(output, &column.name)?;
    }
    output.write_all(b"\n")?;
    let rows = session.samples.len();
    for row in 0..rows {
        if row.is_multiple_of(AT_ONCE) {
            part.counted(row, rows)?;
        }
        for (index, column) in columns.iter().enumerate() {
            if index > 0 {
                output.write_all(b",")?;
            }
            match &column.values {
                Values::Numbers { values, outside } => {
                    if !values[row].is_nan() {
                        write_number(output, outside(values[row]))?;
                    }
                }
                _ => write_text(output, column.values.text(row))?,
            }
        }
        output.write_all(b"\n")?;
    }
    part.reached(1.0)?;
    Ok(())
}

/// A cell, in quotes where it would not come back without.
fn write_text(output: &mut dyn Write, text: &str) -> io::Result<()> {
    output.write_all(as_cell(text).as_bytes())
}

#[cfg(test)]
mod tests;
