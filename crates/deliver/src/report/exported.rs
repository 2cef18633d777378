//! Tables that were written for a controller, as a report names them: the file with its hash, and
//! what `FILE.meta.json` beside it says it came from.

use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::text::Text;

use crate::document::number::hexadecimal;
use crate::guard::read_regular;

/// Longest table, bytes.
const MOST_BYTES: u64 = 256 << 20;

/// A table file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportedTable {
    /// Name of the file, without its folder.
    pub name: String,
    /// SHA-256 of the file, hexadecimal.
    pub hash: String,
    /// Its format.
    pub format: String,
    /// The joint, as it is named.
    pub joint: String,
    /// Hash of the model that it came from.
    pub model_hash: String,
    /// Hash of the samples that the model came from.
    pub samples_hash: String,
}

/// Why a table cannot be named in a report.
#[derive(Debug, Clone, PartialEq)]
pub enum TableFileError {
    /// A file cannot be read.
    Unreadable {
        /// Which file.
        path: PathBuf,
        /// Why.
        because: Text,
    },
    /// The sidecar is not one.
    NoSidecar {
        /// Which file.
        path: PathBuf,
        /// Line of the problem.
        line: usize,
        /// Column of the problem.
        column: usize,
        /// What was expected.
        what: Text,
    },
}

impl TableFileError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::Unreadable { path, because } => of_file(path, because.clone()),
            Self::NoSidecar {
                path,
                line,
                column,
                what,
            } => of_file(
                path,
                text!(
                    "line {line}, column {column}: {says}",
                    line,
                    column,
                    says = what
                ),
            ),
        }
    }
}

/// What is said of a file.
fn of_file(path: &Path, says: Text) -> Text {
    Text::listed([Text::verbatim(path.display().to_string()), says], ": ")
}

displays_what_it_says!(TableFileError);

impl std::error::Error for TableFileError {}

impl ExportedTable {
    /// Reads a table and the sidecar beside it.
    ///
    /// # Errors
    /// If one of the two cannot be read, or the sidecar is not `truepose-table/1`.
    pub fn read(path: &Path) -> Result<Self, TableFileError> {
        let read = |path: &Path| {
            read_regular(path, MOST_BYTES).map_err(|(found, _)| TableFileError::Unreadable {
                path: path.to_path_buf(),
                because: found,
            })
        };
        let bytes = read(path)?;
        let sidecar_path = sidecar_of(path);
        let text = read(&sidecar_path)?;
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&text);
        let refuse = |line: usize, column: usize, what: Text| TableFileError::NoSidecar {
            path: sidecar_path.clone(),
            line,
            column,
            what,
        };
        let meta: Value = serde_json::from_slice(text).map_err(|e| {
            refuse(
                e.line(),
                e.column(),
                text!("expected JSON: {error}", error = e.to_string()),
            )
        })?;
        if meta["format"] != "truepose-table/1" {
            return Err(refuse(
                1,
                1,
                text!("expected \"format\": \"truepose-table/1\""),
            ));
        }
        let word = |key: &str| meta[key].as_str().unwrap_or_default().to_owned();
        let joint = meta["joint"]
            .as_u64()
            .map_or_else(String::new, |j| format!("{j} "));
        Ok(Self {
            name: path
                .file_name()
                .map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
            hash: hexadecimal(&Sha256::digest(&bytes)),
            format: word("table_format"),
            joint: format!("{joint}({})", word("joint_name")),
            model_hash: word("model_hash"),
            samples_hash: word("samples_hash"),
        })
    }
}

/// `FILE.meta.json`.
pub fn sidecar_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".meta.json");
    PathBuf::from(name)
}
