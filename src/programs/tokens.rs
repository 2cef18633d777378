//! Words of a program: names, numbers, strings and signs, each with its bytes. Comments are left out.

use std::cell::RefCell;
use std::ops::Range;

use crate::text::Template;

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

/// One word; a long program has millions of them, so that it is small.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token {
    start: u32,
    /// What it is in the lowest bits; above them its length, or which sign it is.
    rest: u32,
}

/// Bits of a token that say what it is.
const KIND_BITS: u32 = 3;
/// Bytes of the longest word.
const LONGEST: u32 = u32::MAX >> KIND_BITS;

impl Token {
    /// `None` beyond 4 GiB, or of a word that is longer than half of one.
    fn new(kind: Kind, range: Range<usize>) -> Option<Self> {
        let start = u32::try_from(range.start).ok()?;
        let length = u32::try_from(range.len()).ok()?;
        let (kind, above) = match kind {
            Kind::Name => (0, length),
            Kind::Digits => (1, length),
            Kind::String => (2, length),
            Kind::Bits => (3, length),
            Kind::Sign(sign) => (4, u32::from(sign)),
        };
        let rest = above << KIND_BITS | kind;
        (above <= LONGEST).then_some(Self { start, rest })
    }

    pub(super) fn kind(self) -> Kind {
        match self.rest & ((1 << KIND_BITS) - 1) {
            0 => Kind::Name,
            1 => Kind::Digits,
            2 => Kind::String,
            3 => Kind::Bits,
            // What was put there is a byte.
            _ => Kind::Sign(u8::try_from(self.rest >> KIND_BITS).unwrap_or_default()),
        }
    }

    /// Its bytes.
    pub(super) fn range(self) -> Range<usize> {
        let start = self.start as usize;
        let length = match self.kind() {
            Kind::Sign(_) => 1,
            _ => (self.rest >> KIND_BITS) as usize,
        };
        start..start + length
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

/// A file that is read word by word. Words are not kept, as a long program has millions of them: marks say where every
/// so-manieth begins, and the words behind a mark are read again when they are asked for.
pub(super) struct Source<'t, 'a> {
    text: &'t Text<'a>,
    dialect: Dialect,
    /// What stands behind the last word, for messages.
    end: Template,
    recent: RefCell<Recent>,
}

/// Words between two marks.
const BETWEEN_MARKS: usize = 64;
/// Stretches of words that are kept: where a reader is, where it looks ahead, and a place that it comes back to.
const KEPT: usize = 4;

/// The stretches that were read last.
#[derive(Default)]
struct Recent {
    stretches: [Stretch; KEPT],
    oldest: usize,
}

/// The words behind a mark.
#[derive(Default)]
struct Stretch {
    bytes: Range<usize>,
    tokens: Vec<Token>,
}

impl<'t, 'a> Source<'t, 'a> {
    pub(super) fn new(text: &'t Text<'a>, dialect: Dialect, end: Template) -> Self {
        Self {
            text,
            dialect,
            end,
            recent: RefCell::default(),
        }
    }

    /// The words of some bytes; `Err` where a string does not end on its line.
    pub(super) fn words(&'t self, range: Range<usize>) -> Result<Words<'t, 'a>, Problem> {
        let (mut count, mut marks) = (0, Vec::new());
        let mut at = range.start;
        while let Some(token) = self.next(at..range.end)? {
            if count > 0 && count % BETWEEN_MARKS == 0 {
                marks.push(token.start);
            }
            count += 1;
            at = token.range().end;
        }
        Ok(Words {
            source: self,
            range,
            marks,
            count,
        })
    }

    /// The first word of some bytes.
    fn next(&self, range: Range<usize>) -> Result<Option<Token>, Problem> {
        let bytes = &self.text.bytes[..range.end];
        let dialect = self.dialect;
        let mut at = range.start;
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
            let token = Token::new(kind, at..end);
            let too_long = || Problem::new(at, text!("a longer program"), text!("at most 4 GiB"));
            return token.map(Some).ok_or_else(too_long);
        }
        Ok(None)
    }

    /// A word behind a mark, of words that end where these bytes do.
    fn behind_mark(&self, bytes: Range<usize>, k: usize) -> Option<Token> {
        let mut recent = self.recent.borrow_mut();
        if let Some(known) = recent.stretches.iter().find(|s| s.bytes == bytes) {
            return known.tokens.get(k).copied();
        }
        let oldest = recent.oldest;
        recent.oldest = (oldest + 1) % KEPT;
        let stretch = &mut recent.stretches[oldest];
        stretch.tokens.clear();
        let mut at = bytes.start;
        // That there are no problems is known since the words were counted.
        while let Ok(Some(token)) = self.next(at..bytes.end)
            && stretch.tokens.len() < BETWEEN_MARKS
        {
            stretch.tokens.push(token);
            at = token.range().end;
        }
        stretch.bytes = bytes;
        stretch.tokens.get(k).copied()
    }
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
    source: &'t Source<'t, 'a>,
    range: Range<usize>,
    marks: Vec<u32>,
    count: usize,
}

/// A value in a list.
pub(super) enum Value {
    Number(Number),
    /// Something that is worked out at run time, and where it stands.
    RunTime(usize),
}

impl<'t, 'a> Words<'t, 'a> {
    /// The file.
    pub(super) fn text(&self) -> &'t Text<'a> {
        self.source.text
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    fn token(&self, k: usize) -> Option<Token> {
        if k >= self.count {
            return None;
        }
        let mark = (k / BETWEEN_MARKS).checked_sub(1);
        let start = mark.map_or(self.range.start, |mark| self.marks[mark] as usize);
        let bytes = start..self.range.end;
        self.source.behind_mark(bytes, k % BETWEEN_MARKS)
    }

    /// A word's place in the file.
    pub(super) fn range(&self, k: usize) -> Option<Range<usize>> {
        self.token(k).map(Token::range)
    }

    /// A word's bytes.
    pub(super) fn bytes(&self, k: usize) -> &'t [u8] {
        let text: &'t [u8] = self.source.text.bytes;
        self.range(k).map_or(&[], |range| &text[range])
    }

    /// Where a word begins; behind the last one where the last ends.
    pub(super) fn at(&self, k: usize) -> usize {
        match self.range(k) {
            Some(range) => range.start,
            None => self.end(),
        }
    }

    /// Where the last word ends.
    fn end(&self) -> usize {
        let last = self.count.checked_sub(1).and_then(|last| self.range(last));
        last.map_or(0, |range| range.end)
    }

    pub(super) fn kind(&self, k: usize) -> Option<Kind> {
        self.token(k).map(Token::kind)
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
        let range = self.at(k)..self.at(digits) + self.bytes(digits).len();
        let read = Number::read(self.text().bytes, range.clone(), false);
        Some(match read {
            Ok(number) => Ok((number, digits + 1)),
            Err(reason) => Err(Problem::new(
                range.start,
                text!("'{range}'", range = self.text().shown(range)),
                reason.expected(),
            )),
        })
    }

    /// What stands at a word, for messages.
    pub(super) fn found(&self, k: usize) -> crate::text::Text {
        if k < self.count {
            crate::text::Text::verbatim(format!("'{}'", self.spelled(k)))
        } else {
            self.source.end.into()
        }
    }

    /// That something else was expected at a word.
    pub(super) fn problem(&self, k: usize, expected: impl Into<crate::text::Text>) -> Problem {
        Problem::new(self.at(k), self.found(k), expected)
    }

    /// The text from a word to the one before `end`.
    pub(super) fn shown(&self, k: usize, end: usize) -> String {
        let Some(first) = self.range(k) else {
            return String::new();
        };
        let last = self.range(end.max(k + 1) - 1);
        let end = last.map_or_else(|| self.end(), |last| last.end);
        self.text().shown(first.start..end)
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
        let source = Source::new(&text, RAPID, phrase!("the end of the file"));
        let words = source.words(0..text.bytes.len()).unwrap();
        (0..words.len()).map(|k| words.spelled(k)).collect()
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
        let source = Source::new(&text, RAPID, phrase!("the end of the file"));
        let problem = source.words(0..10).err().unwrap();
        assert_eq!(problem.at, 3);
    }
}
