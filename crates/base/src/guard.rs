//! The one way to a file that a file or a person names: a regular file, no longer than its reader
//! takes, and where a document names it, in the document's folder or below.
//!
//! A session often comes from another machine. A device, a folder or a pipe is refused before it is
//! opened, because opening a pipe waits for ever and reading a device never ends; what grows while it
//! is read is read no further than it may be long.

use crate::text::{Template, Text};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use crate::diagnostic::unreadable;

/// What was found and what was expected.
pub type Refusal = (Text, Text);

/// Opens a regular file and returns its length.
pub fn open_regular(path: &Path) -> Result<(File, u64), Refusal> {
    let failed = |error: &io::Error| (unreadable(error), text!("a file that can be read"));
    // Looked at before it is opened, and once more after, lest it was exchanged in between.
    let before = fs::metadata(path).map_err(|error| failed(&error))?;
    regular(&before)?;
    let file = File::open(path).map_err(|error| failed(&error))?;
    let after = file.metadata().map_err(|error| failed(&error))?;
    regular(&after)?;
    Ok((file, after.len()))
}

fn regular(metadata: &fs::Metadata) -> Result<(), Refusal> {
    if metadata.is_file() {
        return Ok(());
    }
    let found = if metadata.is_dir() {
        text!("a directory")
    } else {
        text!("a device or a pipe")
    };
    Err((found, text!("a regular file")))
}

/// The whole of a regular file of at most so many bytes.
pub fn read_regular(path: &Path, most: u64) -> Result<Vec<u8>, Refusal> {
    let (file, length) = open_regular(path)?;
    let too_long = |found: Text| (found, text!("a file of at most {most} bytes", most));
    if length > most {
        return Err(too_long(
            text!(one "{count} byte", "{count} bytes", count = length),
        ));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    let read = file.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|error| (unreadable(&error), text!("a file that can be read")))?;
    if bytes.len() as u64 > most {
        return Err(too_long(text!("a file that grows")));
    }
    Ok(bytes)
}

/// The path of what a document in `folder` calls `name`: there or below it, links resolved.
/// `whose` is what the folder is called: "the session's folder".
pub fn below(folder: &Path, name: &str, whose: Template) -> Result<PathBuf, Refusal> {
    let expected = text!("a file in {folder} or below it", folder = whose);
    let refused = |found: Text| {
        let found = text!("{found}: {name}", found, name);
        (found, expected.clone())
    };
    let relative = Path::new(name);
    if name.is_empty() || name.contains('\0') {
        return Err(refused(text!("not a file name")));
    }
    for component in relative.components() {
        match component {
            Component::Normal(_) | Component::CurDir => {}
            Component::ParentDir => return Err(refused(text!("a path that leads upwards"))),
            Component::RootDir | Component::Prefix(_) => {
                return Err(refused(text!("an absolute path")));
            }
        }
    }
    let path = folder.join(relative);
    let failed = |error: &io::Error| refused(unreadable(error));
    // A symbolic link may lead elsewhere.
    let real = fs::canonicalize(&path).map_err(|error| failed(&error))?;
    let real_folder = fs::canonicalize(folder).map_err(|error| failed(&error))?;
    if !real.starts_with(&real_folder) {
        return Err(refused(text!(
            "a link that leaves {folder}",
            folder = whose
        )));
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOSE: Template = phrase!("the session's folder");

    #[test]
    fn a_name_leads_into_the_folder_or_nowhere() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        fs::create_dir_all(inner.join("deep")).unwrap();
        fs::write(inner.join("deep/a.txt"), "a").unwrap();
        fs::write(folder.path().join("b.txt"), "b").unwrap();
        assert!(below(&inner, "./deep/a.txt", WHOSE).is_ok());
        for (name, found) in [
            ("", "not a file name"),
            ("a\0", "not a file name"),
            ("../b.txt", "leads upwards"),
            ("deep/../../b.txt", "leads upwards"),
            ("/etc/passwd", "absolute"),
            ("none.txt", "no such file"),
        ] {
            let (says, expected) = below(&inner, name, WHOSE).unwrap_err();
            assert!(says.to_string().contains(found), "{name:?}: {says}");
            assert_eq!(
                expected.to_string(),
                "a file in the session's folder or below it"
            );
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../b.txt", inner.join("out.txt")).unwrap();
            let (says, _) = below(&inner, "out.txt", WHOSE).unwrap_err();
            assert!(
                says.to_string()
                    .contains("a link that leaves the session's folder"),
                "{says}"
            );
        }
    }

    #[test]
    fn only_regular_files_are_read_and_only_short_ones() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "abcd").unwrap();
        assert_eq!(read_regular(&path, 4).unwrap(), b"abcd");
        assert!(
            read_regular(&path, 3)
                .unwrap_err()
                .0
                .to_string()
                .contains("4 bytes")
        );
        let (says, _) = read_regular(folder.path(), 4).unwrap_err();
        assert!(says.to_string().contains("a directory"), "{says}");
        #[cfg(unix)]
        {
            let (says, _) = read_regular(Path::new("/dev/zero"), 4).unwrap_err();
            assert!(says.to_string().contains("a device"), "{says}");
        }
    }
}
