//! Reading and writing, as the background tasks do it: through the library, like the terminal.

mod dialogs;
mod examples;
mod exporting;
mod opening;
mod pictures;
pub(crate) mod reporting;
mod saving;

pub(crate) use dialogs::{choose_beside, choose_to_export, choose_to_open, choose_to_save};
pub(crate) use examples::{first_example, open_example};
pub(crate) use exporting::{can_be_written, export, not_written, saved, write_list, write_one};
pub(crate) use opening::{Opened, open, simulate};
pub(crate) use pictures::write_picture;
pub(crate) use saving::{NotSaved, Replace, Saved, save};

pub(crate) use crate::model::format_v1::is_model;

use std::io::ErrorKind;
use std::path::Path;

use crate::atomic::WriteError;
use crate::sessions::Session;

use crate::gui::core::document::plain;

/// Why something was not read or written.
const CANCELLED: &str = "it was cancelled";

/// What the system says, and what to do about it.
fn advice(error: &WriteError) -> String {
    let source = match error {
        WriteError::Io { source, .. } => source,
        WriteError::Exists(path) => {
            return format!(
                "{} exists already; allow replacing it, or choose another name",
                path.display()
            );
        }
        WriteError::NotAFile(path) => {
            return format!(
                "{} is a folder or a device and cannot be replaced; choose another name",
                path.display()
            );
        }
        WriteError::ReplacesInput { .. } | WriteError::SameName(_) => return error.to_string(),
        WriteError::Cancelled(_) => return CANCELLED.to_owned(),
    };
    let what_to_do = match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "the disk is full: make room on it, or save to another disk"
        }
        ErrorKind::ReadOnlyFilesystem => "the disk can only be read: save to another disk",
        ErrorKind::PermissionDenied => "nothing may be written there: save to another folder",
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            "the folder is not there: choose another, or make it first"
        }
        ErrorKind::InvalidFilename => {
            "the name is too long, or has a sign in it that no name may have: choose another name"
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

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    format!("{}.json", plain(&session.name))
}
