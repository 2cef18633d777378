//! How the cells of a file stand in its lines.

use std::fmt;
use std::ops::Range;

use crate::text::Template;

/// What stands between two cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// A tabulator.
    Tab,
    /// ;
    Semicolon,
    /// ,
    Comma,
    /// One or more spaces or tabulators.
    Spaces,
}

impl Separator {
    /// All of them; the earlier one is taken where two fit alike.
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Spaces];

    /// What it is called.
    pub fn name(self) -> Template {
        match self {
            Self::Tab => phrase!("tabs"),
            Self::Semicolon => phrase!("semicolons"),
            Self::Comma => phrase!("commas"),
            Self::Spaces => phrase!("spaces"),
        }
    }

    /// The one that a line of headings uses most; commas where it uses none.
    #[doc(hidden)]
    pub fn of_headings(line: &[u8]) -> Self {
        let count = |sign: u8| memchr::memchr_iter(sign, line).count();
        let mut best = (Self::Comma, count(b','));
        for (separator, sign) in [(Self::Semicolon, b';'), (Self::Tab, b'\t')] {
            if count(sign) > best.1 {
                best = (separator, count(sign));
            }
        }
        best.0
    }
}

impl fmt::Display for Separator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name(), f)
    }
}

/// What ends cells and lines, and which lines are none of a table.
#[derive(Debug, Clone, Copy)]
pub struct Dialect {
    pub(crate) separator: Separator,
    /// Whether a carriage return ends a line as well as a line feed.
    returns_end_lines: bool,
    /// Signs with which lines begin that are passed over.
    pub(crate) comments: &'static [&'static str],
    /// Whether a quoted cell may go on in the next line.
    quotes_span_lines: bool,
    /// From so many bytes on no quote within a quoted cell is doubled: an open quote must not swallow the file.
    pub(crate) longest_quote: usize,
    /// Whether only a line with nothing in it is blank, and blanks belong to their cells.
    pub(super) keeps_blanks: bool,
}

/// Samples of a session: RFC 4180.
pub(crate) const SAMPLES: Dialect = Dialect {
    separator: Separator::Comma,
    returns_end_lines: false,
    comments: &[],
    quotes_span_lines: true,
    longest_quote: usize::MAX,
    keeps_blanks: true,
};

impl Dialect {
    /// A table that a program or an instrument wrote, perhaps with remarks (`#`, `//`, `%`, `!`, and `;` where it
    /// separates nothing) among its lines.
    pub(crate) fn of_instruments(separator: Separator) -> Self {
        let comments: &[&str] = match separator {
            Separator::Semicolon => &["#", "//", "%", "!"],
            _ => &["#", "//", "%", "!", ";"],
        };
        Self {
            comments,
            quotes_span_lines: true,
            ..Self::of_lines(separator)
        }
    }

    /// A table in which every line is a row: a slip in one must not take the next one with it.
    pub fn of_lines(separator: Separator) -> Self {
        Self {
            separator,
            returns_end_lines: true,
            comments: &[],
            quotes_span_lines: false,
            longest_quote: 1 << 16,
            keeps_blanks: false,
        }
    }

    /// Whether this byte may stand before the quote of a cell.
    #[inline]
    pub(super) fn is_indent(self, byte: u8) -> bool {
        byte == b' ' || byte == b'\t' && self.separator != Separator::Tab
    }

    /// Whether blanks separate, many as one.
    #[inline]
    pub(super) fn is_of_spaces(self) -> bool {
        self.separator == Separator::Spaces
    }

    /// Where the line from `at` ends.
    #[inline]
    pub(super) fn line_end(self, bytes: &[u8], at: usize) -> usize {
        let rest = &bytes[at..];
        let end = if self.returns_end_lines {
            memchr::memchr2(b'\n', b'\r', rest)
        } else {
            memchr::memchr(b'\n', rest)
        };
        end.map_or(bytes.len(), |end| at + end)
    }

    /// How far a quote at `at` may look for the one that closes it.
    pub(super) fn reach_of_quote(self, bytes: &[u8], at: usize) -> usize {
        if self.quotes_span_lines {
            bytes.len()
        } else {
            self.line_end(bytes, at)
        }
    }

    /// The next byte from `at` that ends a cell or a line, or the end.
    #[inline]
    pub(super) fn stop(self, bytes: &[u8], at: usize) -> usize {
        let rest = &bytes[at..];
        let separator = match self.separator {
            Separator::Tab => b'\t',
            Separator::Semicolon => b';',
            Separator::Comma => b',',
            Separator::Spaces => {
                let ends = |byte: &u8| matches!(byte, b' ' | b'\t' | b'\n' | b'\r');
                return rest
                    .iter()
                    .position(ends)
                    .map_or(bytes.len(), |end| at + end);
            }
        };
        let end = if self.returns_end_lines {
            memchr::memchr3(separator, b'\n', b'\r', rest)
        } else {
            memchr::memchr2(separator, b'\n', rest)
        };
        end.map_or(bytes.len(), |end| at + end)
    }

    /// Whether a line ends here.
    #[inline]
    pub(super) fn ends_line(self, bytes: &[u8], at: usize) -> bool {
        match bytes.get(at) {
            None | Some(b'\n') => true,
            Some(b'\r') => self.returns_end_lines,
            Some(_) => false,
        }
    }

    /// Line ends within a quoted cell; CRLF is one.
    pub(super) fn line_ends(self, bytes: &[u8]) -> u64 {
        let feeds = memchr::memchr_iter(b'\n', bytes).count();
        if !self.returns_end_lines {
            return feeds as u64;
        }
        let alone =
            memchr::memchr_iter(b'\r', bytes).filter(|at| bytes.get(at + 1) != Some(&b'\n'));
        (feeds + alone.count()) as u64
    }
}

/// A range without the blanks at both ends; empty at its start where it holds nothing else.
#[inline]
pub fn trimmed(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let is_blank = |byte: u8| matches!(byte, b'\t'..=b'\r' | b' ');
    let Range { mut start, mut end } = range.clone();
    while start < end && is_blank(bytes[start]) {
        start += 1;
    }
    while end > start && is_blank(bytes[end - 1]) {
        end -= 1;
    }
    if start == end {
        return range.start..range.start;
    }
    if bytes[start].is_ascii() && bytes[end - 1].is_ascii() {
        start..end
    } else {
        trimmed_of_wide(bytes, start..end)
    }
}

/// As [`trimmed`], of blanks beyond ASCII, where the bytes are UTF-8.
#[cold]
fn trimmed_of_wide(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let Ok(text) = std::str::from_utf8(&bytes[range.clone()]) else {
        return range;
    };
    let start = range.start + text.len() - text.trim_start().len();
    start..start + text.trim().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blanks_are_trimmed_as_the_standard_library_does() {
        for text in [
            "",
            " ",
            "\t a b \r\n",
            "\u{a0}1\u{3000}",
            " \u{a0} ",
            "\u{b}x\u{c}",
            "µ ",
            "é",
            "\u{1c}",
        ] {
            let range = trimmed(text.as_bytes(), 0..text.len());
            assert_eq!(&text[range], text.trim(), "{text:?}");
        }
        let latin = b" \xb5 m ";
        assert_eq!(trimmed(latin, 0..latin.len()), 1..4);
    }

    #[test]
    fn headings_tell_their_separator() {
        for (line, separator) in [
            ("a,b;c", Separator::Comma),
            ("a;b;c,d", Separator::Semicolon),
            ("a\tb", Separator::Tab),
            ("a", Separator::Comma),
        ] {
            assert_eq!(Separator::of_headings(line.as_bytes()), separator, "{line}");
        }
    }
}
