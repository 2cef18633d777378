//! Sessions that come with the program, in it and beside it.

use std::path::{Path, PathBuf};

/// A session that comes with the program.
pub struct Bundled {
    /// Its name, without an ending.
    pub name: &'static str,
    pub document: &'static [u8],
    pub samples: &'static [u8],
}

macro_rules! bundled {
    ($name:literal) => {
        Bundled {
            name: $name,
            document: include_bytes!(concat!("../../../sessions/", $name, ".json")),
            samples: include_bytes!(concat!("../../../sessions/", $name, ".csv")),
        }
    };
}

/// All of them; the window opens on the first.
pub const BUNDLED: [Bundled; 4] = [
    bundled!("lamp-commissioning"),
    bundled!("paper-30"),
    bundled!("paper-run"),
    bundled!("slide-lead-error"),
];

/// Where `truepose integrate` puts them, below the prefix.
pub(crate) const FOLDER: &str = "share/truepose/sessions";

/// The first of them as a file: in the source tree, beside the program, or in the home folder.
fn on_disk() -> Option<PathBuf> {
    let file = format!("{}.json", BUNDLED[0].name);
    let beside = std::env::current_exe().ok().and_then(|program| {
        let prefix = program.canonicalize().ok()?.parent()?.parent()?.to_owned();
        Some(prefix.join(FOLDER))
    });
    let home = std::env::var_os("HOME").map(|home| Path::new(&home).join(".local").join(FOLDER));
    let folders = [Some(PathBuf::from("sessions")), beside, home];
    let mut files = folders
        .into_iter()
        .flatten()
        .map(|folder| folder.join(&file));
    files.find(|file| file.exists())
}

/// The command that does the main job in the terminal, on a session that comes with the program; where none lies there as a
/// file, with the command that puts them there.
pub fn job_in_the_terminal() -> String {
    let Some(session) = on_disk() else {
        let prefix = if cfg!(any(windows, target_os = "macos")) {
            " --prefix FOLDER"
        } else {
            ""
        };
        return format!(
            "truepose identify SESSION --json\nsessions to try are written by: truepose integrate{prefix}"
        );
    };
    identify(&session)
}

/// The command that identifies a session, for a shell.
pub fn identify(session: &Path) -> String {
    let session = session.display().to_string();
    if session.contains(' ') {
        format!("truepose identify \"{session}\" --json")
    } else {
        format!("truepose identify {session} --json")
    }
}
