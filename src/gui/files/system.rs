//! What the system does with files: its dialogs that choose them, its programs that show them, and what
//! is said where it did not read or write one.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::atomic::WriteError;
use crate::gui::import_draft::{Companion, ROBOTS, TABLES};
use crate::gui::view::What;
use crate::language;
use crate::programs::LANGUAGES;
use rfd::FileDialog;

use crate::text::{Template, capital, spoken};

/// Asks the user for a file of one of these kinds, beside this one.
fn pick(near: Option<&Path>, title: &str, kinds: &[(&str, &[&str])]) -> Option<PathBuf> {
    let dialog = dialog_beside(near).set_title(title);
    let with = |dialog, (name, endings): &(&str, &[&str])| of_kind(dialog, name, endings);
    let dialog = kinds.iter().fold(dialog, with);
    dialog.add_filter(say!("All files"), &["*"]).pick_file()
}

/// Offers files of a kind, with their endings.
fn of_kind(dialog: FileDialog, name: &str, endings: &[&str]) -> FileDialog {
    let all: Vec<String> = endings.iter().map(|ending| format!("*.{ending}")).collect();
    dialog.add_filter(format!("{name} ({})", all.join(", ")), endings)
}

/// Asks the user for a session, a model or measurements.
pub(crate) fn choose_to_open(near: Option<&Path>) -> Option<PathBuf> {
    let kinds: [(&str, &[&str]); 2] = [
        (say!("Sessions and models"), &["json"]),
        (spoken(MEASUREMENTS), TABLES),
    ];
    pick(near, say!("Open"), &kinds)
}

/// Asks the user for a table of targets or a robot program.
pub(crate) fn choose_targets(near: Option<&Path>) -> Option<PathBuf> {
    let all = LANGUAGES.iter().flat_map(|l| l.extensions);
    let all: Vec<&str> = all.copied().collect();
    let mut kinds = vec![(say!("Targets and programs"), &*all)];
    kinds.extend(LANGUAGES.iter().map(|l| (l.title, l.extensions)));
    pick(near, say!("Targets and programs"), &kinds)
}

/// Asks the user for a file of the controller beside a program.
pub(crate) fn choose_declarations(program: &Path) -> Option<PathBuf> {
    pick(Some(program), say!("Files of the controller"), &[])
}

/// Asks the user for a file that an export starts from.
pub(crate) fn choose_reference(near: Option<&Path>) -> Option<PathBuf> {
    pick(near, say!("File that the export starts from"), &[])
}

/// Asks the user for a picture for the head of a report.
pub(crate) fn choose_logo(near: Option<&Path>) -> Option<PathBuf> {
    let dialog = dialog_beside(near).set_title(say!("Logo"));
    of_kind(dialog, say!("Picture"), &["png"]).pick_file()
}

/// Asks the user for a file that an instrument wrote.
pub(crate) fn choose_to_import(near: Option<&Path>) -> Option<PathBuf> {
    let kinds = [(spoken(MEASUREMENTS), TABLES)];
    pick(near, say!("Import"), &kinds)
}

/// Asks the user for a file that goes with a measured one, beside that.
pub(crate) fn choose_beside(which: Companion, measured: Option<&Path>) -> Option<PathBuf> {
    let kind = if which == Companion::Robot {
        (say!("Robots and sessions"), ROBOTS)
    } else {
        (say!("Measurements"), TABLES)
    };
    pick(measured, which.name(), &[kind])
}

const MEASUREMENTS: Template = phrase!("Measurements");

/// A dialog that begins in the folder of this file.
fn dialog_beside(file: Option<&Path>) -> FileDialog {
    let dialog = FileDialog::new();
    match file.and_then(Path::parent).filter(|folder| folder.is_dir()) {
        Some(folder) => dialog.set_directory(folder),
        None => dialog,
    }
}

/// Asks the user where to export to.
pub(crate) fn choose_to_export(what: What, path: &Path) -> Option<PathBuf> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let dialog = dialog_beside(Some(path)).set_file_name(name);
    let dialog = dialog.set_title(what.title());
    let ending = path.extension().and_then(|ending| ending.to_str());
    let table = capital(say!("table"));
    let dialog = match what {
        What::Report(_) => {
            let dialog = of_kind(dialog, say!("Report"), &["html", "pdf"]);
            of_kind(dialog, say!("Report"), &["pdf"])
        }
        What::Picture(plot) => of_kind(dialog, say!("Picture"), &[plot.ending()]),
        What::Session => of_kind(dialog, say!("Session"), &["json"]),
        What::Model => of_kind(dialog, say!("Model"), &["json"]),
        What::Robot(_) | What::TypedRobot => of_kind(dialog, &capital(say!("robot")), &["json"]),
        What::Poses => of_kind(dialog, &table, &["csv"]),
        What::Table => of_kind(dialog, &table, ending.as_slice()),
        What::Targets => of_kind(dialog, say!("Targets"), ending.as_slice()),
    };
    dialog.save_file()
}

/// What opens a file with the system's program for it, or shows it in its folder. The path is one
/// argument: no shell reads it.
fn command(path: &Path, in_folder: bool) -> Command {
    let (program, select) = match std::env::consts::OS {
        "windows" => ("explorer", Some("/select,")),
        "macos" => ("open", Some("-R")),
        _ => ("xdg-open", None),
    };
    let mut command = Command::new(program);
    match select {
        _ if !in_folder => command.arg(path),
        Some(select) => command.arg(select).arg(path),
        None => command.arg(path.parent().unwrap_or(path)),
    };
    command
}

/// Opens a file with the system's program for it, or shows it in its folder. Takes its time.
///
/// # Errors
/// The system has no program for it, in words.
pub(crate) fn open_outside(path: &Path, in_folder: bool) -> Result<(), String> {
    let mut command = command(path, in_folder);
    let quiet = command.stdin(Stdio::null()).stdout(Stdio::null());
    match quiet.stderr(Stdio::null()).status() {
        // The explorer answers 1 although it has opened.
        Ok(status) if status.success() || cfg!(target_os = "windows") => Ok(()),
        Ok(_) => Err(say!("the system has no program for it").to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

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
            return language::spoken(error.describe());
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
        _ => return language::spoken(error.describe()),
    };
    format!("{what_to_do} ({source})")
}

/// How a file's name ends, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    Some(ending.to_ascii_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_one_argument_whatever_is_in_it() {
        let path = Path::new("/tmp/a b; rm -rf $HOME & 'c'.html");
        for in_folder in [false, true] {
            let command = command(path, in_folder);
            let last = command.get_args().last().expect("the path");
            assert!(last == path.as_os_str() || last == "/tmp", "{last:?}");
            let program = command.get_program().to_string_lossy().into_owned();
            assert!(["xdg-open", "open", "explorer"].contains(&&*program));
        }
    }
}
