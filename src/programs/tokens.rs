//! Words of a program: names, numbers, strings and signs, each with its bytes. Comments are left out.

use crate::text::Template;
use std::ops::Range;

use super::number::Number;
use super::target::Problem;
use super::text::Text;

/// What a word is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or a keyword.
    Name,
    /// Digits, a point, an exponent: a number, or an attempt at one. It has no sign of its own.
    Digits,
    /// A string with its quotes.
    String,
    /// A binary or hexadecimal number in quotes (KRL).
    Bits,
    /// One sign.
    Sign(u8),
}

/// One word; a long program has millions of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    start: u32,
    end: u32,
}

impl Token {
    /// `None` beyond 4 GiB.
    fn new(kind: Kind, range: Range<usize>) -> Option<Self> {
        let start = u32::try_from(range.start).ok()?;
        let end = u32::try_from(range.end).ok()?;
        Some(Self { kind, start, end })
    }

    /// Its bytes.
    pub(super) fn range(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// What differs between languages.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dialect {
    /// Begins a comment that goes to the end of the line.
    pub(super) comment: Option<u8>,
    /// Quotes of strings; two inside are one that belongs to the string.
    pub(super) strings: &'static [u8],
    /// Whether single quotes hold bits.
    pub(super) bits: bool,
}

/// The words of some bytes of a file; `Err` where a string does not end on its line.
pub(super) fn words(
    text: &Text,
    range: Range<usize>,
    dialect: Dialect,
) -> Result<Vec<Token>, Problem> {
    let bytes = &text.bytes[..range.end];
    let mut at = range.start;
    let mut tokens = Vec::new();
    while at < bytes.len() {
        let byte = bytes[at];
        if byte.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        if Some(byte) == dialect.comment {
            at = line_end(bytes, at);
            continue;
        }
        let (kind, end) = if dialect.strings.contains(&byte) {
            (Kind::String, string_end(bytes, at)?)
        } else if dialect.bits && byte == b'\'' {
            (Kind::Bits, string_end(bytes, at)?)
        } else if byte.is_ascii_digit() || (byte == b'.' && digit_at(bytes, at + 1)) {
            (Kind::Digits, number_end(bytes, at))
        } else if is_of_name(byte) {
            (Kind::Name, end_of(bytes, at, is_of_name))
        } else {
            (Kind::Sign(byte), at + 1)
        };
        let token = Token::new(kind, at..end)
            .ok_or_else(|| Problem::new(at, text!("a longer program"), text!("at most 4 GiB")))?;
        tokens.push(token);
        at = end;
    }
    Ok(tokens)
}

fn is_of_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$' || byte >= 0x80
}

fn digit_at(bytes: &[u8], at: usize) -> bool {
    bytes.get(at).is_some_and(u8::is_ascii_digit)
}

fn end_of(bytes: &[u8], at: usize, belongs: impl Fn(u8) -> bool) -> usize {
    let rest = bytes[at..].iter().position(|b| !belongs(*b));
    rest.map_or(bytes.len(), |n| at + n)
}

fn line_end(bytes: &[u8], at: usize) -> usize {
    end_of(bytes, at, |b| b != b'\n' && b != b'\r')
}

/// A number with everything that sticks to it, so that a slip of the keyboard is seen as one.
fn number_end(bytes: &[u8], at: usize) -> usize {
    let mut end = at;
    while end < bytes.len() {
        let byte = bytes[end];
        let power = matches!(bytes[end.saturating_sub(1)], b'e' | b'E')
            && matches!(byte, b'+' | b'-')
            && end > at
            && bytes[at..end - 1]
                .iter()
                .all(|b| b.is_ascii_digit() || *b == b'.');
        if !(is_of_name(byte) || byte == b'.' || power) {
            break;
        }
        end += 1;
    }
    end
}

fn string_end(bytes: &[u8], at: usize) -> Result<usize, Problem> {
    let quote = bytes[at];
    let mut end = at + 1;
    while end < bytes.len() && !matches!(bytes[end], b'\n' | b'\r') {
        if bytes[end] == quote {
            if bytes.get(end + 1) != Some(&quote) {
                return Ok(end + 1);
            }
            end += 1;
        }
        end += 1;
    }
    Err(Problem::new(
        at,
        text!("a string that does not end on its line"),
        text!("{char} at its end", char = quote as char),
    ))
}

/// Words that are read one after the other.
pub(super) struct Words<'t, 'a> {
    pub(super) text: &'t Text<'a>,
    pub(super) tokens: Vec<Token>,
    /// What stands behind the last word, for messages.
    pub(super) end: crate::text::Template,
}

/// A value in a list.
pub(super) enum Value {
    Number(Number),
    /// Something that is worked out at run time, and where it stands.
    RunTime(usize),
}

impl Words<'_, '_> {
    /// A word's bytes.
    pub(super) fn bytes(&self, k: usize) -> &[u8] {
        self.tokens
            .get(k)
            .map_or(&[][..], |token| &self.text.bytes[token.range()])
    }

    /// Where a word begins; behind the last one where the last ends.
    pub(super) fn at(&self, k: usize) -> usize {
        match self.tokens.get(k) {
            Some(token) => token.range().start,
            None => self.tokens.last().map_or(0, |token| token.range().end),
        }
    }

    pub(super) fn kind(&self, k: usize) -> Option<Kind> {
        self.tokens.get(k).map(|token| token.kind)
    }

    pub(super) fn is_sign(&self, k: usize, sign: u8) -> bool {
        self.kind(k) == Some(Kind::Sign(sign))
    }

    /// A name in small letters.
    pub(super) fn name(&self, k: usize) -> Option<String> {
        let is_name = self.kind(k) == Some(Kind::Name);
        is_name.then(|| self.spelled(k).to_lowercase())
    }

    /// A word as it is spelled.
    pub(super) fn spelled(&self, k: usize) -> String {
        String::from_utf8_lossy(self.bytes(k)).into_owned()
    }

    /// A number, with its sign if it has one, that begins at word `k`: the number and the word behind
    /// it. `None` where there is none; an attempt at one is a problem.
    pub(super) fn number(&self, k: usize) -> Option<Result<(Number, usize), Problem>> {
        let signed = self.is_sign(k, b'-') || self.is_sign(k, b'+');
        let digits = k + usize::from(signed);
        if self.kind(digits) != Some(Kind::Digits) {
            return None;
        }
        let range = self.at(k)..self.tokens[digits].range().end;
        let read = Number::read(self.text.bytes, range.clone(), false);
        Some(match read {
            Ok(number) => Ok((number, digits + 1)),
            Err(reason) => Err(Problem::new(
                range.start,
                text!("'{range}'", range = self.text.shown(range)),
                reason.expected(),
            )),
        })
    }

    /// What stands at a word, for messages.
    pub(super) fn found(&self, k: usize) -> crate::text::Text {
        if k < self.tokens.len() {
            crate::text::Text::verbatim(format!("'{}'", self.spelled(k)))
        } else {
            self.end.into()
        }
    }

    /// That something else was expected at a word.
    pub(super) fn problem(&self, k: usize, expected: impl Into<crate::text::Text>) -> Problem {
        Problem::new(self.at(k), self.found(k), expected)
    }

    /// The text from a word to the one before `end`.
    pub(super) fn shown(&self, k: usize, end: usize) -> String {
        let last = self.tokens.get(end.max(k + 1) - 1).or(self.tokens.last());
        match (self.tokens.get(k), last) {
            (Some(first), Some(last)) => self.text.shown(first.range().start..last.range().end),
            _ => String::new(),
        }
    }

    /// The first word from `k` on that is one of the signs, outside of brackets that open on the way.
    pub(super) fn until(&self, k: usize, signs: &[u8]) -> usize {
        let mut depth = 0_usize;
        let mut k = k;
        while let Some(kind) = self.kind(k) {
            if let Kind::Sign(sign) = kind {
                // A statement's end ends everything.
                if signs.contains(&sign) && (depth == 0 || sign == b';') {
                    break;
                }
                match sign {
                    b'[' | b'(' | b'{' => depth += 1,
                    b']' | b')' | b'}' => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
            k += 1;
        }
        k
    }

    /// The value that begins at word `k` and ends before one of the signs, and the word behind it. A sum or
    /// a product is worked out at run time.
    pub(super) fn value(
        &self,
        k: usize,
        ends: &[u8],
        expected: Template,
    ) -> Result<(Value, usize), Problem> {
        if let Some(read) = self.number(k) {
            let (number, end) = read?;
            if !matches!(self.kind(end), Some(Kind::Sign(b'+' | b'-' | b'*' | b'/'))) {
                return Ok((Value::Number(number), end));
            }
        }
        let end = self.until(k, ends);
        if end == k {
            return Err(self.problem(k, expected));
        }
        Ok((Value::RunTime(k), end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RAPID: Dialect = Dialect {
        comment: Some(b'!'),
        strings: b"\"",
        bits: false,
    };

    fn spelled(source: &str) -> Vec<String> {
        let text = Text::new(source.as_bytes());
        let tokens = words(&text, 0..source.len(), RAPID).unwrap();
        tokens.iter().map(|t| text.shown(t.range())).collect()
    }

    #[test]
    fn comments_are_left_out_and_strings_stay_whole() {
        assert_eq!(
            spelled("p:=[1.5,-2E+3]; ! [9]\nx \"a \"\"[b]\"\" c\""),
            [
                "p",
                ":",
                "=",
                "[",
                "1.5",
                ",",
                "-",
                "2E+3",
                "]",
                ";",
                "x",
                "\"a \"\"[b]\"\" c\""
            ]
        );
    }

    #[test]
    fn an_exponent_belongs_to_its_number_and_a_difference_does_not() {
        assert_eq!(spelled("1-2"), ["1", "-", "2"]);
        assert_eq!(spelled("1E-2-3"), ["1E-2", "-", "3"]);
        assert_eq!(spelled("1.2.3"), ["1.2.3"]);
    }

    #[test]
    fn a_string_without_end_is_a_problem_at_its_quote() {
        let text = Text::new(b"ab \"cd\nef\"");
        let problem = words(&text, 0..10, RAPID).unwrap_err();
        assert_eq!(problem.at, 3);
    }
}
