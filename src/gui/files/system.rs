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

use crate::text::{Template, spoken};

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
    pick(near, say!("Logo"), &[(say!("Picture"), &["png"])])
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
    let endings: &[&str] = match what {
        What::Report(_) => &["html", "pdf"],
        _ => ending.as_slice(),
    };
    let dialog = of_kind(dialog, what.title(), endings);
    dialog.save_file()
}

/// What opens a file, or a folder, with the system's program for it. The path is one argument: no shell reads it.
fn command(path: &Path) -> Command {
    let mut command = Command::new(match std::env::consts::OS {
        "windows" => "explorer",
        "macos" => "open",
        _ => "xdg-open",
    });
    command.arg(path);
    command
}

/// Opens a file, or a folder, with the system's program for it. Takes its time.
///
/// # Errors
/// The system has no program for it, in words.
pub(crate) fn open_outside(path: &Path) -> Result<(), String> {
    let mut command = command(path);
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
        let command = command(path);
        let all: Vec<_> = command.get_args().collect();
        assert_eq!(all, [path.as_os_str()]);
        let program = command.get_program().to_string_lossy().into_owned();
        assert!(["xdg-open", "open", "explorer"].contains(&&*program));
    }
}
