//! Sessions that come with the program, in it and beside it.

use std::path::{Path, PathBuf};

/// A session that comes with the program.
pub(crate) struct Bundled {
    /// Its name, without an ending.
    pub(crate) name: &'static str,
    pub(crate) document: &'static [u8],
    pub(crate) samples: &'static [u8],
}

macro_rules! bundled {
    ($name:literal) => {
        Bundled {
            name: $name,
            document: include_bytes!(concat!("../../sessions/", $name, ".json")),
            samples: include_bytes!(concat!("../../sessions/", $name, ".csv")),
        }
    };
}

/// All of them; the window opens on the first.
pub(crate) const BUNDLED: [Bundled; 3] = [
    bundled!("lamp-commissioning"),
    bundled!("paper-30"),
    bundled!("paper-run"),
];

/// Where `truepose integrate` puts them, below the prefix.
pub(crate) const FOLDER: &str = "share/truepose/sessions";

/// The first of them as a file: in the source tree, beside the program, or in the home folder.
pub(crate) fn on_disk() -> Option<PathBuf> {
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
