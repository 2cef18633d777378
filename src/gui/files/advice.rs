//! What is said where a file was not read or written, and what to do about it.

use std::io::ErrorKind;
use std::path::Path;

use crate::atomic::WriteError;

/// Why something was not read or written.
pub(crate) fn cancelled() -> String {
    say!("file-it-was-cancelled").to_owned()
}

/// What the system says, and what to do about it.
pub(super) fn advice(error: &WriteError) -> String {
    let source = match error {
        WriteError::Io { source, .. } => source,
        WriteError::Exists(path) => {
            return say!("file-exists-already-allow-replacing", path = path.display());
        }
        WriteError::NotAFile(path) => {
            return say!("file-is-a-folder-or", path = path.display());
        }
        WriteError::ReplacesInput { .. } | WriteError::SameName(_) => return error.to_string(),
        WriteError::Cancelled(_) => return cancelled(),
    };
    let what_to_do = match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            say!("file-the-disk-is-full-make")
        }
        ErrorKind::ReadOnlyFilesystem => say!("file-the-disk-can-only-be"),
        ErrorKind::PermissionDenied => say!("file-nothing-may-be-written-there"),
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            say!("file-the-folder-is-not-there")
        }
        ErrorKind::InvalidFilename => {
            say!("file-the-name-is-too-long")
        }
        _ => return error.to_string(),
    };
    format!("{what_to_do} ({source})")
}

/// How a file's name ends, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    Some(ending.to_ascii_lowercase())
}
