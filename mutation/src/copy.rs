//! The copy that is changed: what git knows of the working tree.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;

/// Makes it anew, and keeps its build folder.
pub fn make(home: &Path) -> Outcome<PathBuf> {
    let copy = home.join("target/mutation/tree");
    let listed = Command::new("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .current_dir(home)
        .output()
        .map_err(|e| format!("git: {e}"))?;
    for folder in ["crates", "src", "tests"] {
        let _ = std::fs::remove_dir_all(copy.join(folder));
    }
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    for name in names.split('\0').filter(|name| !name.is_empty()) {
        let (from, to) = (home.join(name), copy.join(name));
        let folder = to.parent().unwrap_or(&copy);
        let made = std::fs::create_dir_all(folder);
        // Crates link to the folders of what they include. What was deleted and is still known to git is not there.
        let made = if let Ok(linked) = from.read_link() {
            made.and_then(|()| std::os::unix::fs::symlink(linked, &to))
        } else if from.is_file() {
            made.and_then(|()| std::fs::copy(&from, &to).map(|_| ()))
        } else {
            continue;
        };
        made.map_err(|e| format!("{name}: {e}"))?;
    }
    copy.canonicalize()
        .map_err(|e| format!("{}: {e}", copy.display()))
}
