//! Tables that were written for a controller, as a report names them: the file with its hash, and
//! what `FILE.meta.json` beside it says it came from.

use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::text::Text;

use crate::document::number::hexadecimal;
use crate::guard::read_regular;
use crate::refusal::Refusal;

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

impl ExportedTable {
    /// Reads a table and the sidecar beside it.
    ///
    /// # Errors
    /// If one of the two cannot be read, or the sidecar is not `truepose-table/1`.
    pub fn read(path: &Path) -> Result<Self, Refusal> {
        let refuse = |path: &Path, says: Text| {
            Refusal(Text::listed(
                [Text::verbatim(path.display().to_string()), says],
                ": ",
            ))
        };
        let read =
            |path: &Path| read_regular(path, MOST_BYTES).map_err(|(found, _)| refuse(path, found));
        let bytes = read(path)?;
        let sidecar = sidecar_of(path);
        let text = read(&sidecar)?;
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&text);
        let at = |line: usize, column: usize, says: Text| {
            refuse(
                &sidecar,
                text!("line {line}, column {column}: {says}", line, column, says),
            )
        };
        let meta: Value = serde_json::from_slice(text).map_err(|e| {
            let says = text!("expected JSON: {error}", error = e.to_string());
            at(e.line(), e.column(), says)
        })?;
        if meta["format"] != "truepose-table/1" {
            return Err(at(1, 1, text!("expected \"format\": \"truepose-table/1\"")));
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
