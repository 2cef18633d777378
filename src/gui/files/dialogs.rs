//! The system's dialogs for files.

use crate::gui::language::text;
use std::path::{Path, PathBuf};

use crate::gui::import_draft::{Beside, ROBOTS, TABLES};
use crate::gui::view::What;
use crate::programs::LANGUAGES;

/// Asks the user for a session, a model or measurements, beside this file.
pub(crate) fn choose_to_open(beside: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(beside)
        .set_title(say!("dialog-open-session-model-or-measurements"))
        .add_filter(say!("dialog-sessions-and-models-json"), &["json"])
        .add_filter(text(MEASUREMENTS), TABLES)
        .add_filter(say!("dialog-all-files"), &["*"]);
    dialog.pick_file()
}

/// Asks the user for a table of targets or a robot program.
pub(crate) fn choose_targets(beside: Option<&Path>) -> Option<PathBuf> {
    let all: Vec<&str> = LANGUAGES
        .iter()
        .flat_map(|l| l.extensions)
        .copied()
        .collect();
    let mut dialog = dialog_beside(beside)
        .set_title(say!("dialog-targets-or-program-to-correct"))
        .add_filter(say!("common-targets-and-programs"), &all);
    for language in LANGUAGES {
        dialog = dialog.add_filter(language.title, language.extensions);
    }
    dialog
        .add_filter(say!("dialog-all-files"), &["*"])
        .pick_file()
}

/// Asks the user for a folder of sessions.
pub(crate) fn choose_folder(beside: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(beside).set_title(say!("dialog-folder-with-the-sessions"));
    dialog.pick_folder()
}

/// Asks the user for a picture for the head of a report.
pub(crate) fn choose_logo(beside: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(beside).set_title(say!("dialog-logo-of-the-report"));
    dialog
        .add_filter(say!("dialog-png-pictures"), &["png"])
        .pick_file()
}

/// Asks the user for a file that an instrument wrote, beside this file.
pub(crate) fn choose_to_import(beside: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(beside)
        .set_title(say!("dialog-import-measurements"))
        .add_filter(text(MEASUREMENTS), TABLES)
        .add_filter(say!("dialog-all-files"), &["*"]);
    dialog.pick_file()
}

/// Asks the user for a file that goes with a measured one, beside that.
pub(crate) fn choose_beside(which: Beside, measured: Option<&Path>) -> Option<PathBuf> {
    let title = match which {
        Beside::Robot => say!("common-which-robot-was-measured"),
        Beside::Commands => say!("dialog-where-the-robot-was-sent"),
        Beside::Reference => say!("dialog-points-known-in-the-base"),
        Beside::Targets => say!("dialog-reflectors-in-the-tool-frame"),
    };
    let (name, kinds) = if which == Beside::Robot {
        (say!("dialog-robots-and-sessions-json-urdf"), ROBOTS)
    } else {
        (say!("dialog-tables-csv-txt-tsv-dat"), TABLES)
    };
    let dialog = dialog_beside(measured)
        .set_title(title)
        .add_filter(name, kinds)
        .add_filter(say!("dialog-all-files"), &["*"]);
    dialog.pick_file()
}

const MEASUREMENTS: &str = "dialog-measurements-csv-txt-tsv-dat";

/// A dialog that begins in the folder of this file.
fn dialog_beside(file: Option<&Path>) -> rfd::FileDialog {
    let dialog = rfd::FileDialog::new();
    match file.and_then(Path::parent).filter(|folder| folder.is_dir()) {
        Some(folder) => dialog.set_directory(folder),
        None => dialog,
    }
}

/// A dialog that begins in the folder where the file belongs, with its name.
fn dialog_at(path: &Path) -> rfd::FileDialog {
    let name = path.file_name().unwrap_or_default();
    dialog_beside(Some(path)).set_file_name(name.to_string_lossy())
}

/// Asks the user where to save.
pub(crate) fn choose_to_save(path: &Path) -> Option<PathBuf> {
    let dialog = dialog_at(path)
        .set_title(say!("common-save-session"))
        .add_filter(say!("dialog-session-json"), &["json"]);
    dialog.save_file()
}

/// Asks the user where to export to.
pub(crate) fn choose_to_export(what: What, path: &Path) -> Option<PathBuf> {
    let title = match what {
        What::Table => say!("common-save-table"),
        What::Model => say!("common-save-model-2"),
        What::Poses => say!("common-save-measuring-list"),
        What::Report(_) => say!("common-save-report"),
        What::Picture(_) => say!("common-save-picture"),
        What::Targets => say!("common-save-corrected-file"),
        What::Robot(_) => say!("robots-save-robot-file-2"),
    };
    let dialog = dialog_at(path).set_title(title);
    let dialog = match what {
        What::Report(_) => dialog
            .add_filter(say!("dialog-html-or-pdf-html-pdf"), &["html", "pdf"])
            .add_filter(say!("dialog-pdf"), &["pdf"]),
        What::Picture(_) => dialog
            .add_filter(say!("dialog-svg-or-png-picture"), &["svg", "png"])
            .add_filter(say!("dialog-png-pictures"), &["png"]),
        What::Model => dialog.add_filter(say!("dialog-model-json"), &["json"]),
        What::Robot(_) => dialog.add_filter(say!("robots-robot-json"), &["json"]),
        What::Poses => dialog.add_filter(say!("dialog-csv-table-csv"), &["csv"]),
        What::Table | What::Targets => match path.extension().and_then(|ending| ending.to_str()) {
            Some(ending) => {
                let name = if what == What::Table {
                    say!("common-table-2")
                } else {
                    say!("dialog-targets")
                };
                dialog.add_filter(format!("{name} (*.{ending})"), &[ending])
            }
            None => dialog,
        },
    };
    dialog.save_file()
}
