//! Files that are no tables, by how they begin: what they are, and what is read in their place.

use crate::diagnostic::{Diagnostic, Place};
use crate::text::Template;

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
    let by_text = || Some((by_text(bytes)?, AS_TABLE));
    let (format, expected) = by_first_bytes(bytes).or_else(by_text)?;
    let found = text!("{format}, not a table", format);
    Some(Box::new(Diagnostic::error(file.clone(), found, expected)))
}

/// What it is called, and what is read in its place.
fn by_first_bytes(bytes: &[u8]) -> Option<(&'static str, Template)> {
    let workbook = "XLSX, ODS, ZIP";
    let all: [(&[u8], &str, Template); 14] = [
        (b"PK\x03\x04", workbook, AS_CSV),
        (b"\xd0\xcf\x11\xe0", "XLS", AS_CSV),
        (b"#ROSBAG V", "ROS 1 bag", AS_MCAP),
        (b"SQLite format 3\0", "SQLite (ROS 2 bag)", AS_MCAP),
        (b"\x89MCAP", "MCAP", phrase!("--as mcap")),
        (b"\x89HDF\r\n", "HDF5", AS_TABLE),
        (b"\x93NUMPY", "NumPy", AS_TABLE),
        (b"MATLAB 5.0 MAT-file", "MATLAB", AS_TABLE),
        (b"PAR1", "Parquet", AS_TABLE),
        (b"%PDF-", "PDF", AS_TABLE),
        (b"\x1f\x8b", "gzip", UNPACKED),
        (b"\x28\xb5\x2f\xfd", "zstd", UNPACKED),
        (b"\xfd7zXZ", "xz", UNPACKED),
        (b"BZh9", "bzip2", UNPACKED),
    ];
    let known = all.into_iter().find(|(start, ..)| bytes.starts_with(start));
    // A C3D recording says where its parameters are, then P.
    let c3d = || match bytes {
        [2..=0x1f, b'P', rest @ ..] if rest.contains(&0) => Some(("C3D", AS_TABLE)),
        _ => None,
    };
    known
        .map(|(_, format, expected)| (format, expected))
        .or_else(c3d)
}

fn by_text(bytes: &[u8]) -> Option<&'static str> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = start.trim_ascii_start();
    let is_json = || {
        let mut values = serde_json::Deserializer::from_slice(text).into_iter();
        matches!(values.next(), Some(Ok(serde::de::IgnoredAny)))
    };
    match text.first()? {
        b'{' | b'[' if is_json() => Some("JSON"),
        b'[' if is_printed(text) => Some("[[…]]"),
        b'<' => Some("XML, HTML"),
        _ if is_yaml(text) => Some("YAML"),
        _ => None,
    }
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
