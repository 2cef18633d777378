//! Files that other programs show: the system's own program for a file, or its folder.

use std::path::Path;
use std::process::{Command, Stdio};

/// What opens a file with the system's program for it, or shows it in its folder. The path is one
/// argument: no shell reads it.
fn command(path: &Path, in_folder: bool) -> Command {
    let folder = path.parent().unwrap_or(path);
    if cfg!(target_os = "windows") {
        let mut command = Command::new("explorer");
        if in_folder {
            command.arg("/select,");
        }
        command.arg(path);
        command
    } else if cfg!(target_os = "macos") {
        let mut command = Command::new("open");
        if in_folder {
            command.arg("-R");
        }
        command.arg(path);
        command
    } else {
        let mut command = Command::new("xdg-open");
        command.arg(if in_folder { folder } else { path });
        command
    }
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
