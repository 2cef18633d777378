//! Messages: an error is shown until it is dismissed, a task that is done for some seconds.

use std::path::{Path, PathBuf};

/// A message to the user: an error that stays, or a notice that goes by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    /// Whether something went wrong.
    pub(crate) wrong: bool,
    /// In one line.
    pub(crate) title: String,
    /// What exactly, and what to do next; one line each.
    pub(crate) details: Vec<String>,
    /// The file that was written.
    pub(crate) file: Option<PathBuf>,
}

impl Message {
    /// Something went wrong.
    pub(crate) fn wrong(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: true,
            ..Self::done(title, details)
        }
    }

    /// Something was done.
    pub(crate) fn done(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: false,
            title: title.into(),
            details,
            file: None,
        }
    }

    /// A file was written.
    pub(crate) fn saved(path: &Path, details: Vec<String>) -> Self {
        let name = path.file_name().unwrap_or(path.as_os_str());
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        Self {
            file: Some(whole),
            ..Self::done(say!("Saved {name}", name = name.to_string_lossy()), details)
        }
    }
}
