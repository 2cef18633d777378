//! Files of sessions: those that come with the program; and what one on the disk looked like when it was read, and
//! whether it still does: time, length and, where these differ, a hash. A file that was only touched has not changed.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::sessions::files::bundled::{BUNDLED, Bundled};
use crate::text::{Template, spoken};

use sha2::{Digest, Sha256};

/// The last part of a path, to be shown; all of it where it has no such part.
pub(crate) fn name_of(path: &Path) -> Cow<'_, str> {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
}

/// How a file looked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fingerprint {
    pub(crate) path: PathBuf,
    modified: Option<SystemTime>,
    length: u64,
    hash: [u8; 32],
}

/// What became of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileChange {
    /// It has other contents.
    Changed,
    /// It is not there, or cannot be read any more.
    Vanished,
}

impl Fingerprint {
    /// How a file looks now; `None` where it cannot be read.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let (modified, length) = outside(path)?;
        let hash = Sha256::digest(fs::read(path).ok()?).into();
        Some(Self {
            path: path.to_path_buf(),
            modified,
            length,
            hash,
        })
    }

    /// What became of the file since. A file that has the same contents as then is the same,
    /// whatever its time says.
    pub(crate) fn look(&self) -> Option<FileChange> {
        let Some((modified, length)) = outside(&self.path) else {
            return Some(FileChange::Vanished);
        };
        if modified.is_some() && modified == self.modified && length == self.length {
            return None;
        }
        match fs::read(&self.path).map(Sha256::digest) {
            Err(_) => Some(FileChange::Vanished),
            Ok(hash) if hash[..] == self.hash => None,
            Ok(_) => Some(FileChange::Changed),
        }
    }
}

fn outside(path: &Path) -> Option<(Option<SystemTime>, u64)> {
    let metadata = fs::metadata(path).ok()?;
    let is_file = metadata.is_file();
    is_file.then(|| (metadata.modified().ok(), metadata.len()))
}

/// A session that comes with the program: keys of what is said of it, and its files.
pub(crate) struct Example {
    name: Template,
    /// What is in it.
    pub(crate) what: Template,
    /// Document and samples.
    pub(crate) files: &'static Bundled,
}

impl Example {
    /// Its name in the menu.
    pub(crate) fn name(&self) -> &'static str {
        spoken(self.name)
    }
}

/// The arm of `docs/first-arm.md`.
static ARM: Bundled = Bundled {
    name: "arm",
    document: include_bytes!("../../../sessions/arm/arm.json"),
    samples: include_bytes!("../../../sessions/arm/arm.csv"),
};

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 5] = [
    Example {
        name: phrase!("Lamp commissioning"),
        what: phrase!("two reflectors, both sides, noise, while the machine warms up"),
        files: &BUNDLED[0],
    },
    Example {
        name: phrase!("The paper's 30 samples"),
        what: phrase!("six regions of five samples, without noise"),
        files: &BUNDLED[1],
    },
    Example {
        name: phrase!("The paper's full run"),
        what: phrase!("361 samples, every half degree"),
        files: &BUNDLED[2],
    },
    Example {
        name: phrase!("A six-axis arm"),
        what: phrase!("90 poses, one reflector, each joint from both sides"),
        files: &ARM,
    },
    Example {
        name: phrase!("A slide with a lead error"),
        what: phrase!("runs in both directions along a screw"),
        files: &BUNDLED[3],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_touched_is_the_same_and_one_with_other_bytes_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        fs::write(&path, "1,2").unwrap();
        let print = Fingerprint::of(&path).unwrap();
        assert_eq!(print.look(), None);
        let later = SystemTime::UNIX_EPOCH + std::time::Duration::from_hours(1);
        fs::File::options()
            .write(true)
            .open(&path)
            .unwrap()
            .set_modified(later)
            .unwrap();
        assert_eq!(print.look(), None);
        // As long, and at the same time to the last tick: the time says nothing here.
        fs::write(&path, "1,3").unwrap();
        assert_eq!(print.look(), Some(FileChange::Changed));
        fs::remove_file(&path).unwrap();
        assert_eq!(print.look(), Some(FileChange::Vanished));
        assert!(Fingerprint::of(&path).is_none());
    }
}
