//! The language in which a controller lists its programs.
//!
//! A controller lists the words of a program in the language of its pendant; `/PROG`, `/MN` and `/POS`, the letters
//! of motions and configurations and `UF`, `UT`, `GP1` are the same in all of them. The German words are those of
//! listings that were printed in both languages, 312 programs of three robots; of German motions only words that
//! were seen there are known.

use std::ops::Range;

use super::super::target::Problem;
use super::super::text::Text;
use super::super::words::is_one_of;

/// The language of a listing.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wording {
    English,
    German,
}

/// Attributes that differ between languages, as English and as German controllers name them.
const ATTRIBUTES: [(Wording, &str); 2] = [
    (
        Wording::English,
        "owner comment prog_size create modified file_name line_count memory_size protect default_group control_code \
         pause_request",
    ),
    (
        Wording::German,
        "eign. kommentar erstell datei_name zeilen speichergr. schutz default_grup kontrollcode halt_anfrage",
    ),
];

/// Attributes that are called the same in every language.
const COMMON: &str = "version task_priority local_registers";

/// Words whose meaning is asked for, in German and in English.
const GERMAN: [(&str, &str); 12] = [
    ("konfig", "config"),
    ("wkz_num", "utool_num"),
    ("wkz", "utool"),
    ("wkz_offset", "tool_offset"),
    ("benutzer_num", "uframe_num"),
    ("benutzer", "uframe"),
    ("traglst", "payload"),
    ("aufruf", "call"),
    ("label", "lbl"),
    ("wenn", "if"),
    ("sonst", "else"),
    ("ist", "select"),
];

/// Further words of German motions: how fast, how near, what is done on the way.
const OF_MOTIONS: &str = "j l c a p pr fine sek mm cm deg max_geschw zeit weg vor sps db interrupt lbl call offset tool_offset";

/// A word of a listing as an English controller lists it.
pub(super) fn in_english(word: String) -> String {
    let known = GERMAN.iter().find(|(german, _)| *german == word);
    known.map_or(word, |(_, english)| (*english).to_owned())
}

/// Whether a word of a German motion, in English where it is translated, is one of those that are known: `CNT100` is
/// `CNT`.
pub(super) fn is_known_in_german(word: &str) -> bool {
    let word = word.trim_end_matches(|c: char| c.is_ascii_digit());
    is_one_of(word, OF_MOTIONS) || is_one_of(word, "cnt acc")
}

impl Wording {
    /// By the names of the attributes; English where none is written.
    pub(super) fn of(text: &Text, attributes: Range<usize>) -> Result<Self, Problem> {
        let mut unknown = None;
        for line in text.lines() {
            if !(attributes.start..attributes.end).contains(&line.start) {
                continue;
            }
            let Some(name) = attribute(&text.bytes[line.clone()]) else {
                continue;
            };
            let of = |(_, names): &&(Self, &str)| is_one_of(&name.to_lowercase(), names);
            if let Some((wording, _)) = ATTRIBUTES.iter().find(of) {
                return Ok(*wording);
            }
            if !is_one_of(&name.to_lowercase(), COMMON) {
                unknown = unknown.or(Some((line.start, name)));
            }
        }
        match unknown {
            None => Ok(Self::English),
            Some((at, name)) => Err(Problem::new(
                at,
                text!("{name}, a listing in a language that is not read", name),
                text!("English or German: set the pendant to English and save the program again"),
            )),
        }
    }
}

/// `NAME = …;`
fn attribute(line: &[u8]) -> Option<String> {
    let equals = line.iter().position(|b| *b == b'=')?;
    let name = String::from_utf8_lossy(line[..equals].trim_ascii()).into_owned();
    let is_one = line.trim_ascii().ends_with(b";")
        && !name.is_empty()
        && !name.contains(char::is_whitespace);
    is_one.then_some(name)
}
