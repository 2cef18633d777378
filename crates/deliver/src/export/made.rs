//! What an export has made.

use crate::kinematics::Robot;
use crate::text::Text;

use super::read_back::ReadBack;
use super::residual_error::ResidualError;

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// Its name, without a folder.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Document {
    /// A file under the name that was asked for, and beside it what its numbers mean.
    pub(super) fn with_sidecar(name: &str, bytes: Vec<u8>, sidecar: Vec<u8>) -> Vec<Self> {
        let document = |name: String, bytes| Self { name, bytes };
        vec![
            document(name.to_owned(), bytes),
            document(format!("{name}.meta.json"), sidecar),
        ]
    }
}

/// What an exporter has made. The first document is the one that was asked for, the others stand
/// beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The documents.
    pub documents: Vec<Document>,
    /// What the first document says when it is read back; `None` for formats without a table.
    pub reads_as: Option<ReadBack>,
    /// The robot that the first document describes, where it describes one.
    pub robot: Option<Robot>,
    /// What the controller leaves over the measured range; `None` for formats without a table.
    pub left: Option<ResidualError>,
    /// What the numbers of the first document mean: their sign, an example, what to enter.
    pub meaning: Vec<Text>,
    /// What the user should know.
    pub notes: Vec<Text>,
    /// Those of the notes that are about what is not correctable by joint commands over the measured range; where the
    /// same is stated of a session they are left out.
    pub stays: Vec<Text>,
}
