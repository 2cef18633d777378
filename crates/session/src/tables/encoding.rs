//! From a file's bytes to text: which encoding it is in.
//!
//! UTF-8 and UTF-16 say what they are: by a byte order mark, by being valid, or by a zero in every
//! other byte. What is neither is taken as Windows-1252, which every byte is valid in, and that is
//! said. A file with zero bytes in it is no text.

use crate::text::{Template, Text};
use std::borrow::Cow;

use encoding_rs::{Encoding as Decoder, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::diagnostic::{Diagnostic, Place};

named! {
    /// How a file's characters are stored.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Encoding {
        /// UTF-8, with or without a byte order mark.
        #[default]
        Utf8 = "UTF-8",
        /// UTF-16, low byte first.
        Utf16Le = "UTF-16 LE",
        /// UTF-16, high byte first.
        Utf16Be = "UTF-16 BE",
        /// What is not valid as anything else.
        Windows1252 = "Windows-1252",
        /// No text.
        Binary = "binary",
    }
    /// What it is called.
    pub fn name;
}

/// What a byte order mark says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    Utf8,
    Utf16Le,
    Utf16Be,
    Utf32,
}

/// The byte order mark of a file and its length.
pub fn mark(bytes: &[u8]) -> Option<(Mark, usize)> {
    Some(match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => (Mark::Utf32, 4),
        [0xff, 0xfe, ..] => (Mark::Utf16Le, 2),
        [0xfe, 0xff, ..] => (Mark::Utf16Be, 2),
        [0xef, 0xbb, 0xbf, ..] => (Mark::Utf8, 3),
        _ => return None,
    })
}

/// How much of a file without a byte order mark is looked at for UTF-16.
const LOOKED_AT: usize = 1024;

/// The text of a file, or an error that says where it stops being one.
pub(crate) fn decode<'a>(
    bytes: &'a [u8],
    file: &Place,
    findings: &mut Vec<Diagnostic>,
) -> Result<(Cow<'a, str>, Encoding), Box<Diagnostic>> {
    let refused = |found: Text| Box::new(Diagnostic::error(file.clone(), found, EXPECTED));
    if bytes.trim_ascii().is_empty() {
        return Err(refused(text!("an empty file")));
    }
    if let Some(refused) = super::foreign::refused(bytes, file) {
        return Err(refused);
    }
    let (text, encoding) = match mark(bytes) {
        Some((Mark::Utf32, _)) => {
            return Err(refused(text!("a file in {encoding}", encoding = "UTF-32")));
        }
        Some((Mark::Utf16Le, mark)) => (utf_16(&bytes[mark..], UTF_16LE, file)?, Encoding::Utf16Le),
        Some((Mark::Utf16Be, mark)) => (utf_16(&bytes[mark..], UTF_16BE, file)?, Encoding::Utf16Be),
        Some((Mark::Utf8, mark)) => utf_8_or_windows(&bytes[mark..], file, findings),
        None => match zeros(bytes) {
            [0, 0] => utf_8_or_windows(bytes, file, findings),
            [even, odd] => {
                let (decoder, encoding) = if odd > even {
                    (UTF_16LE, Encoding::Utf16Le)
                } else {
                    (UTF_16BE, Encoding::Utf16Be)
                };
                // A stray zero is no UTF-16: nearly every other byte of a table has to be one.
                if 3 * even.max(odd) < bytes.len().min(LOOKED_AT) || bytes.len() % 2 == 1 {
                    (String::from_utf8_lossy(bytes), Encoding::Utf8)
                } else {
                    let found = text!(
                        "no byte order mark, read as {encoding}",
                        encoding = encoding.name()
                    );
                    findings.push(Diagnostic::note(file.clone(), found));
                    (utf_16(bytes, decoder, file)?, encoding)
                }
            }
        },
    };
    if let Some(line) = too_long(text.as_bytes()) {
        let place = file.clone().at_line(line);
        let found = text!(
            "a line of more than {longest_line} bytes",
            longest_line = LONGEST_LINE
        );
        return Err(Box::new(Diagnostic::error(place, found, EXPECTED)));
    }
    match memchr::memchr(0, text.as_bytes()) {
        None if text.trim().is_empty() => Err(refused(text!("an empty file"))),
        None => Ok((text, encoding)),
        Some(at) => {
            let place = file.clone().at_line(line_of(&text, at));
            Err(Box::new(Diagnostic::error(
                place,
                text!("a zero byte"),
                EXPECTED,
            )))
        }
    }
}

/// A line of a table is shorter than this; what is longer is something else, and would take many
/// times its size as cells.
pub(super) const LONGEST_LINE: usize = 1 << 22;

/// The first line that is too long.
pub(super) fn too_long(text: &[u8]) -> Option<u64> {
    if text.len() <= LONGEST_LINE {
        return None;
    }
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).zip(1..);
    let mut long = lines.filter(|(line, _)| line.len() > LONGEST_LINE);
    long.next().map(|(_, number)| number)
}

const EXPECTED: Template = phrase!("a table as text, in UTF-8, UTF-16 or Windows-1252");

/// Zeros at even and at odd places near the start.
fn zeros(bytes: &[u8]) -> [usize; 2] {
    let mut count = [0; 2];
    for (index, byte) in bytes.iter().take(LOOKED_AT).enumerate() {
        count[index % 2] += usize::from(*byte == 0);
    }
    count
}

fn utf_16<'a>(
    bytes: &'a [u8],
    decoder: &'static Decoder,
    file: &Place,
) -> Result<Cow<'a, str>, Box<Diagnostic>> {
    if let Some(text) = decoder.decode_without_bom_handling_and_without_replacement(bytes) {
        return Ok(text);
    }
    let (text, _) = decoder.decode_without_bom_handling(bytes);
    let at = text.find('\u{fffd}').unwrap_or(text.len());
    Err(Box::new(Diagnostic::error(
        file.clone().at_line(line_of(&text, at)),
        text!("bytes that are not {encoding}", encoding = "UTF-16"),
        EXPECTED,
    )))
}

fn utf_8_or_windows<'a>(
    bytes: &'a [u8],
    file: &Place,
    findings: &mut Vec<Diagnostic>,
) -> (Cow<'a, str>, Encoding) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), Encoding::Utf8),
        Err(error) => {
            let (text, _) = WINDOWS_1252.decode_without_bom_handling(bytes);
            let before = &bytes[..error.valid_up_to()];
            let line = memchr::memchr_iter(b'\n', before).count() as u64 + 1;
            findings.push(Diagnostic::warning(
                file.clone().at_line(line),
                text!("bytes that are not UTF-8: the file is read as Windows-1252"),
                text!("UTF-8, if letters other than a to z look wrong"),
            ));
            (text, Encoding::Windows1252)
        }
    }
}

/// The line, counted from 1, that a byte is on.
fn line_of(text: &str, at: usize) -> u64 {
    let before = &text.as_bytes()[..at.min(text.len())];
    memchr::memchr_iter(b'\n', before).count() as u64 + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Result<(String, Encoding, usize), String> {
        let mut findings = Vec::new();
        decode(bytes, &Place::file("f.txt"), &mut findings)
            .map(|(text, encoding)| (text.into_owned(), encoding, findings.len()))
            .map_err(|error| error.to_string())
    }

    fn utf_16(text: &str, to_bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(to_bytes).collect()
    }

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "Prüfung µm\r\n1,5;2,5\r\n";
        let with_bom = |bom: &[u8], bytes: Vec<u8>| [bom, &bytes].concat();
        let little = utf_16(text, u16::to_le_bytes);
        let big = utf_16(text, u16::to_be_bytes);
        let windows = b"Pr\xfcfung \xb5m\r\n1,5;2,5\r\n".to_vec();
        for (bytes, encoding, said) in [
            (text.as_bytes().to_vec(), Encoding::Utf8, 0),
            (
                with_bom(b"\xef\xbb\xbf", text.as_bytes().to_vec()),
                Encoding::Utf8,
                0,
            ),
            (with_bom(b"\xff\xfe", little.clone()), Encoding::Utf16Le, 0),
            (with_bom(b"\xfe\xff", big.clone()), Encoding::Utf16Be, 0),
            (little, Encoding::Utf16Le, 1),
            (big, Encoding::Utf16Be, 1),
            (windows, Encoding::Windows1252, 1),
        ] {
            assert_eq!(read(&bytes), Ok((text.to_owned(), encoding, said)));
        }
    }

    #[test]
    fn what_is_no_text_is_refused_with_its_line() {
        let cut = [
            b"\xff\xfe".as_slice(),
            &utf_16("a\nb", u16::to_le_bytes),
            b"x",
        ]
        .concat();
        for (bytes, message) in [
            (cut.as_slice(), "f.txt, line 2: bytes that are not UTF-16"),
            (b"a\nb\nc\0d\n", "f.txt, line 3: a zero byte"),
            (b" \r\n", "f.txt: an empty file"),
            (b"\xef\xbb\xbf", "f.txt: an empty file"),
            (b"\xff\xfe\0\0a\0\0\0", "f.txt: a file in UTF-32"),
        ] {
            let error = read(bytes).unwrap_err();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
