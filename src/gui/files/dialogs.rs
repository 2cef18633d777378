//! The system's dialogs for files.

use std::path::{Path, PathBuf};

use crate::gui::import_draft::Beside;
use crate::gui::view::What;
use crate::programs::LANGUAGES;

/// Asks the user for a session file.
pub(crate) fn choose_to_open() -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new()
        .set_title("Open session, model or measurements")
        .add_filter("Sessions and models", &["json"])
        .add_filter("Measurements", TABLES)
        .add_filter("All files", &["*"]);
    dialog.pick_file()
}

/// Asks the user for a table of targets or a robot program.
pub(crate) fn choose_targets() -> Option<PathBuf> {
    let all: Vec<&str> = LANGUAGES
        .iter()
        .flat_map(|l| l.extensions)
        .copied()
        .collect();
    let mut dialog = rfd::FileDialog::new()
        .set_title("Targets or program to correct")
        .add_filter("Targets and programs", &all);
    for language in LANGUAGES {
        dialog = dialog.add_filter(language.title, language.extensions);
    }
    dialog.add_filter("All files", &["*"]).pick_file()
}

/// Asks the user for a file beside a measured one.
pub(crate) fn choose_beside(which: Beside) -> Option<PathBuf> {
    let (title, kinds): (_, &[&str]) = match which {
        Beside::Robot => ("Which robot was measured", &["json", "urdf", "xml"]),
        Beside::Commands => ("Where the robot was sent", TABLES),
        Beside::Reference => ("Points known in the base frame", TABLES),
        Beside::Targets => ("Reflectors in the tool frame", TABLES),
    };
    let dialog = rfd::FileDialog::new()
        .set_title(title)
        .add_filter("Files of this kind", kinds)
        .add_filter("All files", &["*"]);
    dialog.pick_file()
}

/// Endings of files with tables.
const TABLES: &[&str] = &["csv", "txt", "tsv", "dat", "asc"];

/// A dialog that begins in the folder where the file belongs, with its name.
fn dialog_at(path: &Path) -> rfd::FileDialog {
    let name = path.file_name().unwrap_or_default();
    let dialog = rfd::FileDialog::new().set_file_name(name.to_string_lossy());
    match path.parent().filter(|folder| folder.is_dir()) {
        Some(folder) => dialog.set_directory(folder),
        None => dialog,
    }
}

/// Asks the user where to save.
pub(crate) fn choose_to_save(path: &Path) -> Option<PathBuf> {
    let dialog = dialog_at(path)
        .set_title("Save session")
        .add_filter("Session", &["json"]);
    dialog.save_file()
}

/// Asks the user where to export to.
pub(crate) fn choose_to_export(what: What, path: &Path) -> Option<PathBuf> {
    let title = match what {
        What::Table => "Save table",
        What::Model => "Save model",
        What::Poses => "Save measuring list",
        What::Report(_) => "Save report",
        What::Picture(_) => "Save picture",
        What::Targets => "Save corrected file",
    };
    let dialog = dialog_at(path).set_title(title);
    let dialog = match what {
        What::Report(_) => dialog
            .add_filter("HTML or PDF", &["html", "pdf"])
            .add_filter("PDF", &["pdf"]),
        What::Picture(_) => dialog.add_filter("SVG", &["svg"]),
        _ => dialog,
    };
    dialog.save_file()
}
