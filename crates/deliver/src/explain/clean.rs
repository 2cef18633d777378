//! Texts of users, so that they cannot make an answer read differently than it is.

use crate::language::spoken;
use crate::text::Text;

/// Longest name of a user that a report repeats, characters.
const LONGEST: usize = 400;
/// Longest note: where the samples came from is part of what is signed.
const LONGEST_NOTE: usize = 8000;

/// A user's text as it can be shown: control characters and those that turn the direction of what
/// follows are written as codes, so that a name cannot make a report read differently than it is.
pub fn clean(text: &str) -> String {
    clean_to(text, LONGEST)
}

/// The same for a note, which may be long and have lines of its own. A hash is shown by its first
/// digits, as hashes are compared by people; the note itself keeps the whole.
pub fn clean_note(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines: Vec<String> = lines
        .map(|line| clean_to(&with_short_hashes(line), LONGEST_NOTE))
        .collect();
    let mut note = lines.join("\n");
    if let Some((end, _)) = note.char_indices().nth(LONGEST_NOTE) {
        note.truncate(end);
        note.push('…');
    }
    note
}

/// Runs of 64 hexadecimal digits, which is what SHA-256 looks like, cut to their first twelve.
fn with_short_hashes(line: &str) -> String {
    let mut shown = String::with_capacity(line.len());
    let mut rest = line;
    while !rest.is_empty() {
        let digits = rest.bytes().take_while(u8::is_ascii_hexdigit).count();
        let others = rest[digits..].find(|c: char| c.is_ascii_hexdigit());
        let end = others.map_or(rest.len(), |others| digits + others);
        if digits == 64 {
            shown.push_str(&rest[..12]);
            shown.push('…');
            shown.push_str(&rest[digits..end]);
        } else {
            shown.push_str(&rest[..end]);
        }
        rest = &rest[end..];
    }
    shown
}

/// A sentence with a user's names in it, in the language of this thread.
pub(crate) fn cleaned(text: impl Into<Text>) -> String {
    clean_to(&spoken(text), LONGEST_NOTE)
}

fn clean_to(text: &str, longest: usize) -> String {
    let mut shown = String::with_capacity(text.len());
    for (k, c) in text.chars().enumerate() {
        if k == longest {
            shown.push('…');
            break;
        }
        match c {
            '\n' | '\r' | '\t' | '\u{2028}' | '\u{2029}' => shown.push(' '),
            c if c.is_control() || turns_direction(c) => {
                shown.push_str(&format!("[U+{:04X}]", u32::from(c)));
            }
            c => shown.push(c),
        }
    }
    shown
}

fn turns_direction(c: char) -> bool {
    matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_turn_the_text_after_it() {
        assert_eq!(clean("a\u{202e}b\u{0}c\nd"), "a[U+202E]b[U+0000]c d");
        assert_eq!(clean(&"x".repeat(5000)).chars().count(), LONGEST + 1);
        assert_eq!(clean_note(&"x".repeat(5000)), "x".repeat(5000));
        assert_eq!(clean_note("a\u{202e}b\n\n c\r\nd\te"), "a[U+202E]b\nc\nd e");
        assert!(clean_note(&"x".repeat(50_000)).ends_with("x…"));
        assert_eq!(
            clean_note(&"x\n".repeat(50_000)).chars().count(),
            LONGEST_NOTE + 1
        );
        assert_eq!(clean("Prüfung Ось 检"), "Prüfung Ось 检");
    }

    #[test]
    fn a_note_shows_the_first_digits_of_a_hash() {
        let hash = "0123456789abcdef".repeat(4);
        let note = clean_note(&format!(
            "from a.txt (sha256 {hash}): UTF-8.\nnot {hash}0 ü"
        ));
        assert_eq!(
            note,
            format!("from a.txt (sha256 0123456789ab…): UTF-8.\nnot {hash}0 ü")
        );
    }
}
