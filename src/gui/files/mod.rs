//! Reading and writing, as the background tasks do it: through the library, like the terminal.

mod opening;
pub(crate) mod reporting;
mod system;
mod writing;

pub(crate) use opening::{Opened, first_example, open, open_example, simulate};
pub(crate) use system::{
    cancelled, choose_beside, choose_folder, choose_logo, choose_targets, choose_to_export,
    choose_to_import, choose_to_open, choose_to_save, open_outside,
};
pub(crate) use writing::{
    NotSaved, Replace, Saved, can_be_written, export, not_written, save, saved, write_list,
    write_one, write_picture, write_targets,
};

pub(crate) use crate::pipeline::is_model;

use std::path::Path;

use crate::programs::LANGUAGES;
use crate::sessions::Session;

use crate::gui::core::document::plain;
use crate::gui::import_draft::TABLES;

/// Whether a file is a robot program by its name: one whose ending a table of measurements does not have as well.
pub(crate) fn is_program(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| {
        let program = LANGUAGES.iter().any(|l| l.extensions.contains(&&*ending));
        program && !TABLES.contains(&&*ending)
    })
}

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    format!("{}.json", plain(&session.name))
}
