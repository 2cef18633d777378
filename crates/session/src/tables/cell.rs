//! One cell: where its content is, and what ends it.
//!
//! A cell whose first sign is a quote goes to the closing one, over line ends if need be, and `""` in it is a quote.
//! A quote anywhere else is a sign like others, because an inch is written so.

use std::borrow::Cow;
use std::ops::Range;

use super::dialect::{Dialect, trimmed};

/// A cell as it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Its content, without the quotes around it.
    pub start: usize,
    pub end: usize,
    pub(crate) quotes: Quotes,
    /// What ends it: a separator, a line end, or the end of everything.
    pub(crate) stop: usize,
}

/// The quotes of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quotes {
    None,
    /// Around it.
    Around,
    /// Around it, and doubled ones in it.
    Doubled,
    /// Nothing closes the first one.
    Open,
}

/// A text as a cell of a table with commas or semicolons (RFC 4180): in quotes where it would not come back without.
pub fn as_cell(text: &str) -> Cow<'_, str> {
    let spaced = text.starts_with([' ', '\t']) || text.ends_with([' ', '\t']);
    if spaced || text.contains([',', ';', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

impl Cell {
    /// The cell that begins at `at`.
    #[inline]
    pub(crate) fn read(bytes: &[u8], at: usize, dialect: Dialect) -> Self {
        let indent = bytes[at..].iter();
        let start = at + indent.take_while(|byte| dialect.is_indent(**byte)).count();
        if bytes.get(start) == Some(&b'"') {
            return Self::quoted(bytes, start + 1, dialect);
        }
        // Where spaces separate, those before a cell are none of it.
        let start = if dialect.is_of_spaces() { start } else { at };
        let stop = dialect.stop(bytes, start);
        Self {
            start,
            end: stop,
            quotes: Quotes::None,
            stop,
        }
    }

    /// The cell whose content starts at `start`, behind its quote.
    fn quoted(bytes: &[u8], start: usize, dialect: Dialect) -> Self {
        let reach = dialect.reach_of_quote(bytes, start);
        let mut quotes = Quotes::Around;
        let mut at = start;
        loop {
            let quote = memchr::memchr(b'"', &bytes[at..reach]);
            let quote = quote.filter(|_| at - start < dialect.longest_quote);
            let Some(end) = quote.map(|offset| at + offset) else {
                return Self {
                    start,
                    end: reach,
                    quotes: Quotes::Open,
                    stop: reach,
                };
            };
            if bytes.get(end + 1) != Some(&b'"') {
                let stop = dialect.stop(bytes, end + 1);
                return Self {
                    start,
                    end,
                    quotes,
                    stop,
                };
            }
            quotes = Quotes::Doubled;
            at = end + 2;
        }
    }

    /// The cell without the blanks around it.
    #[inline]
    pub(super) fn trimmed(self, bytes: &[u8]) -> Self {
        let Range { start, end } = trimmed(bytes, self.start..self.end);
        Self { start, end, ..self }
    }

    /// Whether there is nothing in it.
    #[inline]
    pub(crate) fn is_empty(self, bytes: &[u8]) -> bool {
        self.start == self.end && self.behind_quote(bytes).is_empty()
    }

    /// What it says, together with what stands behind its closing quote.
    #[inline]
    pub(crate) fn text(self, text: &str) -> Cow<'_, str> {
        if self.quotes == Quotes::None {
            Cow::Borrowed(&text[self.start..self.end])
        } else {
            self.text_of_quoted(text)
        }
    }

    #[cold]
    fn text_of_quoted(self, text: &str) -> Cow<'_, str> {
        let content = &text[self.start..self.end];
        let behind = self.behind_quote(text.as_bytes());
        if behind.is_empty() && self.quotes != Quotes::Doubled {
            return Cow::Borrowed(content);
        }
        let mut plain = content.replace("\"\"", "\"");
        if !behind.is_empty() {
            plain.push_str(&text[self.end + 1..behind.end]);
        }
        Cow::Owned(plain)
    }

    /// Its content, with its doubled quotes as single ones.
    pub(crate) fn content(self, bytes: &[u8]) -> Cow<'_, [u8]> {
        let content = &bytes[self.start..self.end];
        if self.quotes != Quotes::Doubled {
            return Cow::Borrowed(content);
        }
        let mut plain = content.to_vec();
        // The second one of each two.
        let mut is_second = false;
        plain.retain(|byte| {
            is_second = *byte == b'"' && !is_second;
            !is_second
        });
        Cow::Owned(plain)
    }

    /// What stands between its closing quote and its end, without the blanks around it.
    pub fn behind_quote(self, bytes: &[u8]) -> Range<usize> {
        match self.quotes {
            Quotes::None | Quotes::Open => self.stop..self.stop,
            Quotes::Around | Quotes::Doubled => trimmed(bytes, self.end + 1..self.stop),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::dialect::{SAMPLES, Separator};
    use super::*;

    fn first(text: &str, dialect: Dialect) -> (String, Quotes, usize) {
        let cell = Cell::read(text.as_bytes(), 0, dialect);
        (cell.text(text).into_owned(), cell.quotes, cell.stop)
    }

    #[test]
    fn a_cell_ends_where_its_dialect_says() {
        let of = |separator| Dialect::of_instruments(separator);
        for (text, dialect, content, quotes, stop) in [
            ("a;b,c", of(Separator::Comma), "a;b", Quotes::None, 3),
            ("a;b,c", of(Separator::Semicolon), "a", Quotes::None, 1),
            ("a\rb", of(Separator::Comma), "a", Quotes::None, 1),
            ("a\rb\n", SAMPLES, "a\rb", Quotes::None, 3),
            ("  a b", of(Separator::Spaces), "a", Quotes::None, 3),
            (
                " \"a,\"\"b\"\"\" ,c",
                of(Separator::Comma),
                "a,\"b\"",
                Quotes::Doubled,
                11,
            ),
            ("\"a\"b ,c", of(Separator::Comma), "ab", Quotes::Around, 5),
            ("\t\"a,b\"", of(Separator::Comma), "a,b", Quotes::Around, 6),
            ("12\",3", of(Separator::Comma), "12\"", Quotes::None, 3),
            ("\"a,b", of(Separator::Comma), "a,b", Quotes::Open, 4),
            ("\"a\n\"b", of(Separator::Comma), "a\nb", Quotes::Around, 5),
            (
                "\"a\n\"b",
                Dialect::of_lines(Separator::Comma),
                "a",
                Quotes::Open,
                2,
            ),
        ] {
            let found = first(text, dialect);
            assert_eq!(found, (content.to_owned(), quotes, stop), "{text:?}");
        }
    }

    #[test]
    fn bytes_and_text_of_a_cell_say_the_same() {
        for text in [
            "\"\"\"\"",
            "\"a\"\"\"\"b\"",
            "\"\"",
            "\"a\"",
            "\"\"\"é\"\"\"",
        ] {
            let cell = Cell::read(text.as_bytes(), 0, SAMPLES);
            assert_eq!(
                cell.content(text.as_bytes()),
                cell.text(text).as_bytes(),
                "{text}"
            );
        }
    }
}
