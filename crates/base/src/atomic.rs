//! Atomic output: files that are written whole or not at all.
//!
//! A file is first written under a temporary name in its folder, brought to the disk, and only then renamed: a rename
//! is atomic. A full disk, a failure half way or a kill leaves what was there before. (SIGKILL may leave the
//! unfinished file, whose name starts with `.truepose-`; nothing reads it, and the next write into the folder removes
//! it: see [`unfinished`](crate::unfinished).)
//!
//! What an output may replace is decided here too: never an input, and another file only by force.

use crate::text::Text;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use tempfile::{Builder, NamedTempFile};

use crate::progress::Cancelled;
use crate::unfinished::{self, List};

/// Why an output was not written.
#[derive(Debug)]
pub enum WriteError {
    /// The output would replace an input.
    ReplacesInput {
        /// The refused output.
        output: PathBuf,
        /// The input that is the same file.
        input: PathBuf,
    },
    /// The file exists, and replacing it was not allowed.
    Exists(PathBuf),
    /// It is a directory or a device.
    NotAFile(PathBuf),
    /// Two outputs of one command are the same file.
    SameName(PathBuf),
    /// The watcher asked to stop before the file had its name.
    Cancelled(PathBuf),
    /// The system refused.
    Io {
        /// The output.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

impl WriteError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::ReplacesInput { output, input } => text!(
                "{output}: would replace the input {input}; choose another name",
                output = output.display().to_string(),
                input = input.display().to_string()
            ),
            Self::Exists(file) => text!(
                "{file}: exists already; --force replaces it",
                file = file.display().to_string()
            ),
            Self::NotAFile(file) => text!(
                "{file}: is not a regular file and cannot be replaced",
                file = file.display().to_string()
            ),
            Self::SameName(file) => text!(
                "{file}: is the name of two outputs; choose another name",
                file = file.display().to_string()
            ),
            Self::Cancelled(file) => text!("{file}: cancelled", file = file.display().to_string()),
            Self::Io { path, source } => text!(
                "{file}: {source}",
                file = path.display().to_string(),
                source = source.to_string()
            ),
        }
    }
}

displays_what_it_says!(WriteError);

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}

impl WriteError {
    /// Whether the arguments are wrong (rather than the disk, say).
    pub fn is_refusal(&self) -> bool {
        !matches!(self, Self::Io { .. } | Self::Cancelled(_))
    }
}

/// Refuses an output that would replace an input, whatever names the two go by.
///
/// # Errors
/// [`WriteError::ReplacesInput`] for the first such input.
pub fn refuse_to_replace_inputs(output: &Path, inputs: &[&Path]) -> Result<(), WriteError> {
    match inputs.iter().find(|&&input| same_file(output, input)) {
        Some(input) => Err(WriteError::ReplacesInput {
            output: output.to_path_buf(),
            input: input.to_path_buf(),
        }),
        None => Ok(()),
    }
}

/// Refuses two outputs of one command that are the same file.
///
/// # Errors
/// [`WriteError::SameName`].
pub fn refuse_one_file_for_two(first: &Path, second: &Path) -> Result<(), WriteError> {
    if same_file(first, second) {
        return Err(WriteError::SameName(second.to_path_buf()));
    }
    Ok(())
}

/// Writes a file whole or not at all; an existing one is replaced only with `force`.
///
/// # Errors
/// See [`WriteError`]; an error of `write` is passed on, and the old file, if any, stays. So does it
/// where `write` ends with [`Cancelled`].
pub fn write_atomically(
    path: &Path,
    force: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    StagedFile::write(path, force, write)?.commit()
}

/// A file that is on the disk but does not have its name yet. Dropped, it leaves no trace.
pub struct StagedFile {
    file: TemporaryFile,
    /// As the user named it.
    named: PathBuf,
    /// Its path, links resolved.
    path: PathBuf,
    force: bool,
}

impl StagedFile {
    pub fn write(
        named: &Path,
        force: bool,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Self, WriteError> {
        let failed = |source| {
            if Cancelled::is_behind(&source) {
                return WriteError::Cancelled(named.to_path_buf());
            }
            WriteError::Io {
                path: named.to_path_buf(),
                source,
            }
        };
        let path = destination(named, force)?;
        let folder = folder_of(&path);
        unfinished::remove_stale(folder);
        let prefix = unfinished::prefix();
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        set_permissions(&mut builder);
        let file = List::locked().make(folder, &mut builder).map_err(failed)?;
        let mut unfinished = TemporaryFile(Some(file));
        let file = unfinished.file().map_err(failed)?;
        let mut buffer = BufWriter::with_capacity(1 << 16, file.as_file_mut());
        write(&mut buffer).map_err(failed)?;
        buffer.flush().map_err(failed)?;
        drop(buffer);
        if let Ok(old) = fs::metadata(&path) {
            file.as_file()
                .set_permissions(old.permissions())
                .map_err(failed)?;
        }
        file.as_file().sync_all().map_err(failed)?;
        Ok(Self {
            file: unfinished,
            named: named.to_path_buf(),
            path,
            force,
        })
    }

    /// Gives the file its name.
    pub fn commit(self) -> Result<(), WriteError> {
        let path = self.path.clone();
        self.named(&mut List::locked())?;
        sync_folder(folder_of(&path));
        Ok(())
    }

    /// Gives the file its name, which may not be on the disk yet.
    fn named(mut self, list: &mut List) -> Result<(), WriteError> {
        let Some(file) = self.file.0.take() else {
            return Ok(());
        };
        let unfinished = file.path().to_path_buf();
        let persisted = if self.force {
            file.persist(&self.path)
        } else {
            file.persist_noclobber(&self.path)
        };
        // Where it failed the file is dropped here, and gone.
        let persisted = persisted.map(drop).map_err(|failure| failure.error);
        list.forget(&unfinished);
        persisted.map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => WriteError::Exists(self.named.clone()),
            _ => WriteError::Io {
                path: self.named.clone(),
                source: error,
            },
        })
    }
}

/// A file that vanishes, and is forgotten, unless it gets its name.
struct TemporaryFile(Option<NamedTempFile>);

impl TemporaryFile {
    fn file(&mut self) -> io::Result<&mut NamedTempFile> {
        let gone = || io::Error::other("the unfinished file is gone");
        self.0.as_mut().ok_or_else(gone)
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut list = List::locked();
            list.forget(file.path());
            drop(file);
        }
    }
}

/// Renames two files, both or neither as far as the file system allows: when the second rename fails, the first file
/// gets its old content back. One folder is synchronised once, after both; two writers of one folder take turns, and
/// no signal comes between. Between the two renames SIGKILL leaves the new first and the old second: the second
/// contains which first belongs to it.
pub fn commit_both(first: StagedFile, second: StagedFile) -> Result<(), WriteError> {
    let (first_path, second_path) = (first.path.clone(), second.path.clone());
    let (folder, other) = (folder_of(&first_path), folder_of(&second_path));
    let _turn = turn_of(folder);
    let mut list = List::locked();
    // A second name for the old content; it vanishes when it is dropped.
    let mut old = Builder::new()
        .prefix(&unfinished::prefix())
        .suffix(".old")
        .make_in(folder, |path| fs::hard_link(&first_path, path))
        .ok();
    let old_path = old.as_ref().map(|old| old.path().to_path_buf());
    if let Some(path) = &old_path {
        list.add(path);
    }
    let existed = first_path.exists();
    let mut committed = first.named(&mut list);
    // Where the first fails the second is dropped at the end, when the list is free again.
    if committed.is_ok() {
        committed = second.named(&mut list);
        if committed.is_err() {
            match old.take() {
                Some(old) => drop(old.into_temp_path().persist(&first_path)),
                None if !existed => drop(fs::remove_file(&first_path)),
                None => {}
            }
        }
    }
    // Gone before it is forgotten, and forgotten before the program may end.
    drop(old);
    if let Some(path) = &old_path {
        list.forget(path);
    }
    drop(list);
    sync_folder(folder);
    if other != folder {
        sync_folder(other);
    }
    committed
}

/// Waits until no other writer gives names in this folder. A file system without locks, and a lock
/// that something holds on to, do not keep anything from being written.
fn turn_of(folder: &Path) -> Option<fs::File> {
    let file = fs::File::open(folder).ok()?;
    for _ in 0..200 {
        match file.try_lock() {
            Ok(()) => return Some(file),
            Err(fs::TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(5)),
            Err(fs::TryLockError::Error(_)) => return None,
        }
    }
    None
}

/// The path of an output, or why it is refused.
fn destination(named: &Path, force: bool) -> Result<PathBuf, WriteError> {
    match fs::metadata(named) {
        Ok(old) if !old.is_file() => Err(WriteError::NotAFile(named.to_path_buf())),
        Ok(_) if !force => Err(WriteError::Exists(named.to_path_buf())),
        // Through a link, lest the link itself is replaced.
        Ok(_) => fs::canonicalize(named).map_err(|source| WriteError::Io {
            path: named.to_path_buf(),
            source,
        }),
        Err(_) => Ok(named.to_path_buf()),
    }
}

pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A new file gets the permissions that any program's new file gets.
#[cfg(unix)]
fn set_permissions(builder: &mut Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn set_permissions(_: &mut Builder<'_, '_>) {}

/// Brings a rename to the disk, where the system has a way to. The file itself is safe already.
fn sync_folder(folder: &Path) {
    if cfg!(unix)
        && let Ok(folder) = fs::File::open(folder)
    {
        // Some file systems cannot; the rename is atomic nevertheless.
        drop(folder.sync_all());
    }
}

fn same_file(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| {
        fs::canonicalize(path).ok().or_else(|| {
            // Not there yet: its folder may be.
            let folder = fs::canonicalize(folder_of(path)).ok()?;
            Some(folder.join(path.file_name()?))
        })
    };
    match (real(a), real(b)) {
        (Some(real_a), Some(real_b)) => real_a == real_b || same_inode(&real_a, &real_b),
        _ => a == b,
    }
}

#[cfg(unix)]
fn same_inode(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(a), Ok(b)) => a.dev() == b.dev() && a.ino() == b.ino(),
        _ => false,
    }
}

#[cfg(not(unix))]
fn same_inode(_: &Path, _: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_writer_that_fails_half_way_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        fs::write(&path, "old").unwrap();
        let failure = write_atomically(&path, true, |output| {
            output.write_all(&vec![b'x'; 1 << 20])?;
            Err(io::Error::other("disk full"))
        });
        assert!(
            failure
                .unwrap_err()
                .to_string()
                .ends_with("table.csv: disk full")
        );
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names_in(folder.path()), ["table.csv"]);
    }

    #[test]
    fn an_existing_file_is_replaced_only_by_force() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        let write = |text: &'static str, force| {
            write_atomically(&path, force, |output| output.write_all(text.as_bytes()))
        };
        write("one", false).unwrap();
        assert!(matches!(write("two", false), Err(WriteError::Exists(_))));
        assert_eq!(fs::read_to_string(&path).unwrap(), "one");
        write("two", true).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "two");
        assert_eq!(names_in(folder.path()), ["a.json"]);
    }

    #[test]
    fn a_directory_is_never_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let refused = write_atomically(folder.path(), true, |_| Ok(()));
        assert!(matches!(refused, Err(WriteError::NotAFile(_))));
    }

    #[test]
    fn the_second_of_two_files_takes_the_first_back_when_it_fails() {
        let folder = tempfile::tempdir().unwrap();
        let (first, second) = (folder.path().join("s.csv"), folder.path().join("s.json"));
        fs::write(&first, "old").unwrap();
        let prepare =
            |path: &Path, force| StagedFile::write(path, force, |output| output.write_all(b"new"));
        let csv = prepare(&first, true).unwrap();
        let json = prepare(&second, false).unwrap();
        fs::write(&second, "somebody else's").unwrap();
        assert!(commit_both(csv, json).is_err());
        assert_eq!(fs::read_to_string(&first).unwrap(), "old");
        assert_eq!(names_in(folder.path()), ["s.csv", "s.json"]);
    }

    #[cfg(unix)]
    #[test]
    fn devices_links_and_permissions_are_left_as_they_are() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let write = |path: &Path| write_atomically(path, true, |output| output.write_all(b"new"));
        assert!(matches!(
            write(Path::new("/dev/null")),
            Err(WriteError::NotAFile(_))
        ));
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("file", &link).unwrap();
        write(&link).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert_eq!(
            fs::metadata(&file).unwrap().permissions().mode() & 0o777,
            0o640
        );
    }

    #[cfg(unix)]
    #[test]
    fn an_input_is_recognised_under_any_name() {
        let folder = tempfile::tempdir().unwrap();
        let input = folder.path().join("in.json");
        fs::write(&input, "{}").unwrap();
        let link = folder.path().join("link.json");
        std::os::unix::fs::symlink(&input, &link).unwrap();
        let hard = folder.path().join("hard.json");
        fs::hard_link(&input, &hard).unwrap();
        let roundabout = folder.path().join(".").join("in.json");
        for output in [&input, &link, &hard, &roundabout] {
            let refused = refuse_to_replace_inputs(output, &[&input]);
            assert!(
                matches!(refused, Err(WriteError::ReplacesInput { .. })),
                "{output:?}"
            );
        }
        let new = folder.path().join("new.json");
        assert!(refuse_to_replace_inputs(&new, &[&input]).is_ok());
        assert!(matches!(
            refuse_one_file_for_two(&new, &folder.path().join("./new.json")),
            Err(WriteError::SameName(_))
        ));
    }
}
