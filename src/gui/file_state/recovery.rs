//! What is not saved, kept against a crash.
//!
//! While a document has changes that no file holds, it is written to a file of its own in the data
//! folder: one line that says what follows, with its hash, then the session as a
//! document. A window holds a lock on its file for as long as it lives; the system gives the lock
//! back when the program ends, however it ends. A file whose lock is free was left behind, and
//! the next window offers the newest. Two windows never touch the same file.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::atomic::{WriteError, write_atomically};
use crate::document::number::hexadecimal;
use crate::effects::{self, CATALOGUE, Term, form_with};
use crate::gui::core::document::{Added, Document, Method};
use crate::gui::core::loaded_session::LoadedSession;
use crate::kinematics::Robot;
use crate::pipeline;
use crate::sessions::Session;

const FORMAT: &str = "truepose-recovery/1";
const ENDING: &str = "recovery";

/// This window's own file.
#[derive(Debug)]
pub(crate) struct RecoveryFile {
    path: PathBuf,
    /// Held, never read.
    _lock: File,
}

/// What stands in the first line.
#[derive(Debug, Serialize, Deserialize)]
struct Header {
    format: String,
    sha256: String,
    #[serde(flatten)]
    about: About,
}

/// What is kept of a document beside its session: how it was identified. Names that no effect has do not count.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct About {
    /// The file that the session was opened from, if there is one.
    pub(crate) file: Option<PathBuf>,
    identified: bool,
    regional: bool,
    /// Effects of the exact fit.
    effects: Vec<String>,
    /// Effects that a search found and that were added to it.
    #[serde(default)]
    added: Vec<SavedTerm>,
}

/// An effect that was added, as it is kept. A smooth correction is not: its curve belongs to a search.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedTerm {
    effect: String,
    joint: usize,
    setting: f64,
    coefficients: Vec<f64>,
    on: bool,
}

impl SavedTerm {
    fn of(added: &Added) -> Option<Self> {
        let term = &added.term;
        (term.curve.is_none() && term.rest.is_none()).then(|| Self {
            effect: term.effect.about().id.to_owned(),
            joint: term.joint,
            setting: term.setting,
            coefficients: term.coefficients.clone(),
            on: added.on,
        })
    }

    /// The effect on this robot; `None` where it cannot be one of its.
    fn added(&self, robot: &Robot) -> Option<Added> {
        let effect = effects::find(&self.effect)?;
        let effect = form_with(effect, |form| {
            form.about().form.coefficients() == self.coefficients.len()
        });
        let mut term = Term::absent(effect, self.joint, self.setting);
        let fits = self.joint < robot.joints.len()
            && self.coefficients.len() == term.coefficients.len()
            && self.coefficients.iter().all(|c| c.is_finite())
            && self.setting.is_finite();
        term.coefficients.clone_from(&self.coefficients);
        fits.then_some(Added { term, on: self.on })
    }
}

/// What is to be kept of a document.
#[derive(Debug, Clone)]
pub(crate) struct SavedDocument {
    /// The session with the changes.
    pub(crate) session: Session,
    pub(crate) about: About,
}

impl SavedDocument {
    /// What is to be kept of this document.
    pub(crate) fn of(document: &Document, file: Option<PathBuf>) -> Self {
        Self {
            session: document.session_to_save(),
            about: About {
                file,
                // A model that was read from a file stands in that.
                identified: document.identified && document.loaded_model.is_none(),
                regional: document.method == Method::Regional,
                effects: document.effects.iter().map(|e| (*e).to_owned()).collect(),
                added: document.added.iter().filter_map(SavedTerm::of).collect(),
            },
        }
    }
}

impl About {
    /// Brings a session that a window that is gone has left behind into a document, as it was identified.
    pub(crate) fn restore(&self, document: &mut Document, loaded_session: Arc<LoadedSession>) {
        document.open(loaded_session);
        document.loaded_model = None;
        document.identified = self.identified;
        if self.regional && document.loaded_session.single_revolute() {
            document.method = Method::Regional;
        }
        let all = CATALOGUE.iter().map(|effect| effect.about().id);
        let chosen = all.filter(|id| self.effects.iter().any(|e| e == id));
        document.effects = chosen.collect();
        let robot = &document.loaded_session.session.robot;
        let added = self.added.iter().filter_map(|one| one.added(robot));
        document.added = added.collect();
    }
}

/// A document that a window left behind, with the lock of its file: no other window offers it.
#[derive(Debug)]
pub(crate) struct LeftBehind {
    pub(crate) own: RecoveryFile,
    /// When it was written.
    pub(crate) when: Option<SystemTime>,
    pub(crate) kept: SavedDocument,
}

impl RecoveryFile {
    /// A file of its own for this window.
    pub(crate) fn new(folder: &Path) -> io::Result<Self> {
        let folder = folder.join("recovery");
        fs::create_dir_all(&folder)?;
        // A unique name, from the system's own source of such names.
        let lock = tempfile::Builder::new()
            .prefix("window-")
            .suffix(".lock")
            .tempfile_in(&folder)?;
        let (file, lock_path) = lock.keep().map_err(|failure| failure.error)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::Error(error) => error,
            TryLockError::WouldBlock => io::ErrorKind::WouldBlock.into(),
        })?;
        Ok(Self {
            path: lock_path.with_extension(ENDING),
            _lock: file,
        })
    }

    /// Where it keeps what is not saved.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Leaves nothing behind: the window closes as it should.
    pub(crate) fn tidy(&self) {
        let _ = fs::remove_file(&self.path);
        let _ = fs::remove_file(self.path.with_extension("lock"));
    }
}

/// Keeps it in this file, whole or not at all.
pub(crate) fn write(path: &Path, kept: &SavedDocument) -> Result<(), WriteError> {
    let failed = |source| WriteError::Io {
        path: path.to_path_buf(),
        source,
    };
    let mut document = Vec::new();
    pipeline::write_inline(&kept.session, &mut document).map_err(failed)?;
    let header = Header {
        format: FORMAT.to_owned(),
        about: kept.about.clone(),
        sha256: hexadecimal(&Sha256::digest(&document)),
    };
    let header = serde_json::to_vec(&header).map_err(|e| failed(e.into()))?;
    write_atomically(path, true, |output| {
        output.write_all(&header)?;
        output.write_all(b"\n")?;
        output.write_all(&document)
    })
}

fn read(path: &Path) -> Result<SavedDocument, String> {
    let bytes = fs::read(path).map_err(|e| e.to_string())?;
    let end = memchr::memchr(b'\n', &bytes).ok_or(say!("its first line cannot be read"))?;
    let (first, document) = (&bytes[..end], &bytes[end + 1..]);
    let header: Header =
        serde_json::from_slice(first).map_err(|_| say!("its first line cannot be read"))?;
    if header.format != FORMAT {
        return Err(say!("expected the format {format}", format = FORMAT));
    }
    if hexadecimal(&Sha256::digest(document)) != header.sha256 {
        return Err(say!("its contents do not agree with their hash").to_owned());
    }
    let loaded = pipeline::parse(document).map_err(|e| e.to_string())?;
    Ok(SavedDocument {
        session: loaded.session,
        about: header.about,
    })
}

/// The newest document that a window left behind that is gone. What cannot be read is put aside, so that it is not
/// offered again: where it is then, and what is wrong with it. Locks without anything beside them are cleared away.
pub(crate) fn left_behind(folder: &Path) -> Option<Result<LeftBehind, (PathBuf, String)>> {
    let entries = fs::read_dir(folder.join("recovery")).ok()?;
    let paths = entries.flatten().map(|entry| entry.path());
    let locks = paths.filter(|path| path.extension().is_some_and(|ending| ending == "lock"));
    let mut free = Vec::new();
    for lock in locks {
        let Ok(file) = File::options().write(true).open(&lock) else {
            continue;
        };
        // Its window is still open.
        if file.try_lock().is_err() {
            continue;
        }
        match fs::metadata(lock.with_extension(ENDING)) {
            Ok(about) => free.push((about.modified().ok(), lock, file)),
            Err(_) => {
                let _ = fs::remove_file(lock);
            }
        }
    }
    let (when, lock, file) = free.into_iter().max_by_key(|(when, ..)| *when)?;
    let path = lock.with_extension(ENDING);
    Some(match read(&path) {
        Ok(kept) => Ok(LeftBehind {
            own: RecoveryFile { path, _lock: file },
            when,
            kept,
        }),
        Err(because) => {
            let aside = path.with_extension("damaged");
            let moved = fs::rename(&path, &aside);
            let _ = fs::remove_file(lock);
            Err((if moved.is_ok() { aside } else { path }, because))
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::files::first_example;

    fn kept() -> SavedDocument {
        let document = Document::new(first_example());
        SavedDocument::of(&document, Some("a b.json".into()))
    }

    /// A window that keeps something and is killed.
    fn killed(folder: &Path) -> PathBuf {
        let keeper = RecoveryFile::new(folder).unwrap();
        write(keeper.path(), &kept()).unwrap();
        keeper.path().to_path_buf()
    }

    #[test]
    fn what_a_killed_window_kept_is_there_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        killed(folder.path());
        let left = left_behind(folder.path()).unwrap().unwrap();
        let found = &left.kept;
        assert_eq!(found.session.samples.x_mm, kept().session.samples.x_mm);
        assert_eq!(found.session.regions, kept().session.regions);
        assert_eq!(found.about.file, Some("a b.json".into()));
        let again = left_behind(folder.path());
        assert!(again.is_none(), "offered to one window only");
        left.own.tidy();
        assert!(left_behind(folder.path()).is_none());
        let entries = fs::read_dir(folder.path().join("recovery")).unwrap();
        assert_eq!(entries.count(), 0);
    }

    #[test]
    fn a_window_that_lives_keeps_its_file_to_itself() {
        let folder = tempfile::tempdir().unwrap();
        let (one, two) = (
            RecoveryFile::new(folder.path()).unwrap(),
            RecoveryFile::new(folder.path()).unwrap(),
        );
        assert_ne!(one.path(), two.path());
        write(one.path(), &kept()).unwrap();
        write(two.path(), &kept()).unwrap();
        assert!(left_behind(folder.path()).is_none());
        drop(one);
        assert!(left_behind(folder.path()).is_some());
        two.tidy();
        assert!(!two.path().exists());
    }

    #[test]
    fn damage_anywhere_is_noticed_and_the_file_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = killed(folder.path());
        let whole = fs::read(&path).unwrap();
        left_behind(folder.path()).unwrap().unwrap().own.tidy();
        let first_line = memchr::memchr(b'\n', &whole).unwrap();
        let cuts = [
            0,
            5,
            first_line,
            first_line + 1,
            whole.len() / 2,
            whole.len() - 1,
        ];
        let mut flipped = whole.clone();
        flipped[whole.len() / 2] ^= 1;
        let damaged = cuts.map(|cut| whole[..cut].to_vec());
        for bytes in damaged.into_iter().chain([flipped]) {
            let path = killed(folder.path());
            fs::write(&path, &bytes).unwrap();
            let (aside, _) = left_behind(folder.path()).unwrap().unwrap_err();
            assert_eq!(fs::read(&aside).unwrap(), bytes);
            assert!(left_behind(folder.path()).is_none(), "said once");
        }
    }
}
