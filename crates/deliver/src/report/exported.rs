//! Tables that were written for a controller, as a report names them: the file with its hash, and
//! what `FILE.meta.json` beside it says it came from.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::diagnostic::{Place, Rejected};
use crate::document::number::hexadecimal;
use crate::document::{Fields, Value, optional};
use crate::sessions::files::open::{as_text, read_document};

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
    pub fn read(path: &Path) -> Result<Self, Rejected> {
        let bytes = read_document(path)?;
        let sidecar = sidecar_of(path);
        let text = read_document(&sidecar)?;
        let place = Place::file(&sidecar);
        let (mut fields, root) = Fields::open(place.clone(), as_text(&text, &place)?)?;
        let is_one = fields.of_format(&root, "truepose-table/1").map(|_| ());
        fields.finish(is_one)?;
        let members = match &root.value {
            Value::Object(members) => members.as_slice(),
            _ => &[],
        };
        let word = |key: &str| match optional(members, key).map(|node| &node.value) {
            Some(Value::Text(text)) => text.clone(),
            Some(Value::Number(number)) => format!("{number} "),
            _ => String::new(),
        };
        let name = path.file_name().unwrap_or_default();
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            hash: hexadecimal(&Sha256::digest(&bytes)),
            format: word("table_format"),
            joint: format!("{}({})", word("joint"), word("joint_name")),
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
