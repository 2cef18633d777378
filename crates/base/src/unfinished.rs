//! Files that are being written and do not have their names yet.
//!
//! Every such file is listed here from the moment that it exists until it has its name or is gone, so
//! that a program that is asked to end can remove them. Listing and existing change together: the list
//! stays locked from before a file is made until it is in the list, and from before a rename until it
//! is out of it. So no end comes between the two renames of a session either; only what cannot be
//! caught (SIGKILL, a power failure) can.
//!
//! The remains of a killed program are removed at the next write into that folder: the process of its name does not
//! exist any more, and nothing holds its lock.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// What the names of unfinished files begin with.
const PREFIX: &str = ".truepose-";

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The list, locked: as long as it is held no file of it comes or goes, and the program does not end
/// at a signal.
pub(crate) struct List(MutexGuard<'static, Vec<PathBuf>>);

impl List {
    pub(crate) fn locked() -> Self {
        // After the panic of a thread the list is as it was: whole.
        Self(UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// A file in `folder` under a temporary name, with the permissions that `builder` has.
    pub(crate) fn make(
        &mut self,
        folder: &Path,
        builder: &mut Builder<'_, '_>,
    ) -> io::Result<NamedTempFile> {
        let file = builder.tempfile_in(folder)?;
        // Held while the file is open; the system releases it when the process ends, however. Where a file system has
        // no locks the number of the process alone shows whose it is.
        let _ = file.as_file().try_lock();
        self.0.push(file.path().to_path_buf());
        Ok(file)
    }

    /// Names one that was made otherwise.
    pub(crate) fn add(&mut self, path: &Path) {
        self.0.push(path.to_path_buf());
    }

    /// It has its name, or is gone.
    pub(crate) fn forget(&mut self, path: &Path) {
        self.0.retain(|listed| listed != path);
    }
}

/// What the names of this process's unfinished files begin with.
pub(crate) fn prefix() -> String {
    format!("{PREFIX}{}-", process::id())
}

/// Removes every unfinished file of this process and keeps others from being made. Only for a program
/// that ends.
pub fn remove_all() {
    let mut list = List::locked();
    for path in list.0.drain(..) {
        // What has gone already needs no removal.
        let _ = fs::remove_file(path);
    }
    // Never unlocked again: a thread that still works must not make another one.
    std::mem::forget(list);
}

/// Removes the remains of processes that do not exist any more from a folder.
pub(crate) fn remove_stale(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let owner = name.to_str().and_then(owner);
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_file && owner.is_some_and(|owner| !is_running(owner)) {
            let path = entry.path();
            // A process of another machine or container that shares the folder holds its lock.
            let free = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
            if free {
                let _ = fs::remove_file(path);
            }
        }
    }
}

/// The process that a file's name belongs to.
fn owner(name: &str) -> Option<u32> {
    let (owner, rest) = name.strip_prefix(PREFIX)?.split_once('-')?;
    let unfinished = [".tmp", ".old"].iter().any(|end| rest.ends_with(end));
    owner.parse().ok().filter(|_| unfinished)
}

/// Whether a process of this number may exist; where the system does not report it, it may.
fn is_running(process: u32) -> bool {
    let all = Path::new("/proc");
    let known = all.join(process::id().to_string()).exists();
    // Without such a list the lock alone decides.
    known && all.join(process.to_string()).exists() || process == process::id()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_no_process_holds_any_more_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        // No process has this number: it is above the largest that Linux gives.
        let dead = format!("{PREFIX}4194305-abc.tmp");
        let held = format!("{PREFIX}4194306-abc.tmp");
        let own = format!("{}abc.tmp", prefix());
        let others = [
            ".truepose-abc.tmp",
            ".truepose-4194305-abc.csv",
            "4194305-a.tmp",
        ];
        for name in others.iter().copied().chain([&*dead, &held, &own]) {
            fs::write(path(name), "x").unwrap();
        }
        let holds = File::open(path(&held)).unwrap();
        holds.try_lock().unwrap();
        remove_stale(folder.path());
        assert!(!path(&dead).exists());
        for name in others.iter().copied().chain([&*held, &own]) {
            assert!(path(name).exists(), "{name}");
        }
    }
}
