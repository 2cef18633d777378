//! Files that are no tables, by how they begin: what they are, and what is read in their place.

use crate::diagnostic::{Diagnostic, Place};
use crate::text::{Template, Text};

/// Lines that are looked at for a document that is no table.
const LOOKED_AT: usize = 400;

const AS_TABLE: Template =
    phrase!("a table with one row for each measurement (CSV), or a recording of ROS 2 (MCAP)");
const AS_CSV: Template = phrase!("its sheet saved as CSV (UTF-8)");
const AS_MCAP: Template =
    phrase!("a recording in MCAP, which `mcap convert` makes of it, with --as mcap");
const UNPACKED: Template = phrase!("the file that is packed in it");

/// What a file is, where it is known and no table.
pub(crate) fn refused(bytes: &[u8], file: &Place) -> Option<Box<Diagnostic>> {
    let (found, expected) = by_first_bytes(bytes).or_else(|| by_text(bytes))?;
    Some(Box::new(Diagnostic::error(
        file.clone(),
        Text::from(found),
        expected,
    )))
}

fn by_first_bytes(bytes: &[u8]) -> Option<(Template, Template)> {
    let workbook = phrase!("a workbook of a spreadsheet program or an archive, not a text");
    let packed = phrase!("a packed file");
    let all: [(&[u8], Template, Template); 14] = [
        (b"PK\x03\x04", workbook, AS_CSV),
        (b"\xd0\xcf\x11\xe0", workbook, AS_CSV),
        (b"#ROSBAG V", phrase!("a bag of ROS 1"), AS_MCAP),
        (
            b"SQLite format 3\0",
            phrase!("a database of SQLite, such as a bag of ROS 2"),
            AS_MCAP,
        ),
        (
            b"\x89MCAP",
            phrase!("a recording in MCAP, not a table"),
            phrase!("--as mcap"),
        ),
        (b"\x89HDF\r\n", phrase!("an HDF5 file"), AS_TABLE),
        (b"\x93NUMPY", phrase!("an array of NumPy"), AS_TABLE),
        (
            b"MATLAB 5.0 MAT-file",
            phrase!("a file of MATLAB"),
            AS_TABLE,
        ),
        (b"PAR1", phrase!("a Parquet file"), AS_TABLE),
        (b"%PDF-", phrase!("a PDF"), AS_TABLE),
        (b"\x1f\x8b", packed, UNPACKED),
        (b"\x28\xb5\x2f\xfd", packed, UNPACKED),
        (b"\xfd7zXZ", packed, UNPACKED),
        (b"BZh9", packed, UNPACKED),
    ];
    let known = all.into_iter().find(|(start, ..)| bytes.starts_with(start));
    // A C3D recording says where its parameters are, then P.
    let c3d = || match bytes {
        [2..=0x1f, b'P', rest @ ..] if rest.contains(&0) => {
            Some((phrase!("a C3D recording"), AS_TABLE))
        }
        _ => None,
    };
    known
        .map(|(_, found, expected)| (found, expected))
        .or_else(c3d)
}

fn by_text(bytes: &[u8]) -> Option<(Template, Template)> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = start.trim_ascii_start();
    let is_json = || {
        let mut values = serde_json::Deserializer::from_slice(text).into_iter();
        matches!(values.next(), Some(Ok(serde::de::IgnoredAny)))
    };
    let found = match text.first()? {
        b'{' | b'[' if is_json() => phrase!("a JSON document, not a table"),
        b'[' if is_printed(text) => phrase!("numbers in brackets, as a program prints an array"),
        b'<' => phrase!("a document of XML or HTML, not a table"),
        _ if is_yaml(text) => phrase!("a document of keys and values (YAML), not a table"),
        _ => return None,
    };
    Some((found, AS_TABLE))
}

/// `[[ 0.1 0.2]`, which is no heading with a unit.
fn is_printed(text: &[u8]) -> bool {
    let inner = text.iter().find(|byte| !matches!(byte, b'[' | b' '));
    inner.is_some_and(|byte| matches!(byte, b'0'..=b'9' | b'-' | b'+' | b'.'))
}

/// Whether nearly all lines are `key: value`, `- item` or `---`.
fn is_yaml(text: &[u8]) -> bool {
    let is_key = |word: &str| {
        let word = word.trim_matches(['\'', '"']);
        word.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && word
                .chars()
                .all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/'))
    };
    let (mut lines, mut keys, mut others) = (0, 0, 0);
    for line in text.split(|byte| matches!(byte, b'\n' | b'\r')) {
        let Ok(line) = std::str::from_utf8(line) else {
            return false;
        };
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', '%']) {
            continue;
        }
        lines += 1;
        let item = line.strip_prefix("- ").unwrap_or(line);
        match item.split_once(':') {
            Some((key, value)) if is_key(key) && (value.is_empty() || value.starts_with(' ')) => {
                keys += 1;
            }
            _ if item.len() < line.len() || matches!(line, "-" | "---" | "...") => {}
            _ => others += 1,
        }
        if lines == LOOKED_AT {
            break;
        }
    }
    keys > 1 && 4 * others <= lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_preamble_of_keys_above_a_table_is_no_document() {
        let table = "Operator: A. B.\nDate: 2024-05-01\nUnit: mm\nx;y;z\n1;2;3\n1;2;3\n";
        assert!(by_text(table.as_bytes()).is_none());
        for text in ["[mm] x y\n1 2 3\n", "- 1 2\n- 3 4\n", "a: 1\n1 2\n"] {
            assert!(by_text(text.as_bytes()).is_none(), "{text}");
        }
        assert!(by_text(b"---\na: 1\nb:\n  - 2\n  - 3\nc: 4\n").is_some());
        assert!(by_text(b"[{\"x\": 1}]").is_some());
    }
}
