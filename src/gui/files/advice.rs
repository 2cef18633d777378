//! What is said where a file was not read or written, and what to do about it.

use crate::language::spoken;
use std::io::ErrorKind;
use std::path::Path;

use crate::atomic::WriteError;

/// Why something was not read or written.
pub(crate) fn cancelled() -> String {
    say!("it was cancelled").to_owned()
}

/// What the system says, and what to do about it.
pub(super) fn advice(error: &WriteError) -> String {
    let source = match error {
        WriteError::Io { source, .. } => source,
        WriteError::Exists(path) => {
            return say!(
                "{path} exists already; allow replacing it, or choose another name",
                path = path.display()
            );
        }
        WriteError::NotAFile(path) => {
            return say!(
                "{path} is a folder or a device and cannot be replaced; choose another name",
                path = path.display()
            );
        }
        WriteError::ReplacesInput { .. } | WriteError::SameName(_) => {
            return spoken(error.describe());
        }
        WriteError::Cancelled(_) => return cancelled(),
    };
    let what_to_do = match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            say!("the disk is full: make room on it, or save to another disk")
        }
        ErrorKind::ReadOnlyFilesystem => say!("the disk can only be read: save to another disk"),
        ErrorKind::PermissionDenied => say!("no permission to write there: save to another folder"),
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            say!("folder not found: choose another, or create it first")
        }
        ErrorKind::InvalidFilename => {
            say!("the name is too long or has a character that is not allowed: choose another name")
        }
        _ => return spoken(error.describe()),
    };
    format!("{what_to_do} ({source})")
}

/// How a file's name ends, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    Some(ending.to_ascii_lowercase())
}
