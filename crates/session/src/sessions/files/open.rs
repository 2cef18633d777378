//! Opens what a session names, and nothing else.
//!
//! A session often comes from another machine. It may point to its samples in its own folder or
//! below, and only a regular file is opened (see [`guard`](crate::guard)).

use crate::text::{Template, Text};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::diagnostic::{Diagnostic, Place, Rejected, unreadable};
use crate::guard;
pub(crate) use crate::guard::Refusal;
pub use crate::guard::open_regular;
use crate::progress::{Progress, ProgressSpan, ReadError, unwatched};

/// Bytes that are read between two looks at the watcher.
const AT_ONCE: u64 = 4 << 20;

/// The whole of a file that the user named; nothing but a regular file is opened.
///
/// # Errors
/// [`Rejected`] when it is no regular file, or cannot be read.
pub fn read_document(path: &Path) -> Result<Vec<u8>, Rejected> {
    let progress = Progress::new(&unwatched);
    read_document_in(path, progress.whole()).map_err(ReadError::rejected)
}

/// As [`read_document`], told as this part of something.
///
/// # Errors
/// [`ReadError`].
pub fn read_document_in(path: &Path, part: ProgressSpan<'_>) -> Result<Vec<u8>, ReadError> {
    let refused = |(found, expected): Refusal| {
        Rejected::because(Diagnostic::error(Place::file(path), found, expected))
    };
    let (file, length) = open_regular(path).map_err(refused)?;
    let read = read_whole(file, length, part);
    part.check()?;
    let failed = |error| refused((unreadable(&error), text!("a file that can be read")));
    Ok(read.map_err(failed)?)
}

/// The whole of an opened file of about this length, told as this part of something.
pub(crate) fn read_whole(
    mut file: File,
    length: u64,
    part: ProgressSpan<'_>,
) -> io::Result<Vec<u8>> {
    let expected = usize::try_from(length).unwrap_or(0);
    let mut bytes = Vec::with_capacity(expected);
    loop {
        let read = (&mut file).take(AT_ONCE).read_to_end(&mut bytes)?;
        part.counted(bytes.len(), expected)?;
        if read == 0 {
            return Ok(bytes);
        }
    }
}

/// The path of the samples that a session in `folder` calls `name`.
pub(crate) fn samples_path(folder: &Path, name: &str) -> Result<PathBuf, Refusal> {
    guard::below(folder, name, phrase!("the session's folder"))
}

/// A JSON document as text.
pub fn as_text<'a>(bytes: &'a [u8], file: &Place) -> Result<&'a str, Rejected> {
    const EXPECTED: Template = phrase!("a JSON document in UTF-8");
    let refused = |place: Place, found: Text| {
        Err(Rejected::because(Diagnostic::error(place, found, EXPECTED)))
    };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii().is_empty() {
        return refused(file.clone(), text!("an empty file"));
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return refused(
            file.clone().at_line(1),
            text!("a file in {encoding}", encoding = "UTF-16"),
        );
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text),
        Err(error) => {
            let before = &bytes[..error.valid_up_to()];
            let line = memchr::memchr_iter(b'\n', before).count() as u64 + 1;
            let start = memchr::memrchr(b'\n', before).map_or(0, |feed| feed + 1);
            let place = file.clone().at_line(line);
            let place = place.at_column((before.len() - start) as u64 + 1);
            refused(
                place,
                text!("bytes that are not {encoding}", encoding = "UTF-8"),
            )
        }
    }
}
