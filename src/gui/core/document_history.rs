//! What became of the machines of a folder.

use std::path::PathBuf;

use crate::history::History;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Past {
    pub(crate) folder: PathBuf,
    pub(crate) history: History,
}
