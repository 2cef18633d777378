//! The grammar.

use crate::text::{Template, Text};
use std::collections::BTreeSet;

use super::{Member, Node, Source, Value};
use crate::diagnostic::{Diagnostic, Rejected};
use crate::document::number::{NotANumber, any_decimal, plain_decimal, quoted};
use crate::progress::{Cancelled, ProgressSpan, ReadError};

/// No sound document nests deeper than this, and the stack is finite.
const DEEPEST: usize = 64;

/// Bytes between two looks at the watcher.
const AT_ONCE: usize = 1 << 18;

/// Why reading ends early.
enum Stop {
    /// A syntax error: where, what is there, what should be.
    Wrong {
        at: usize,
        found: Text,
        expected: Template,
    },
    /// Cancelled.
    Cancelled(Cancelled),
}

use Stop::Wrong;

type Parsed<T> = Result<T, Stop>;

/// Reads a whole document, told as `part` of something.
///
/// # Errors
/// The first syntax error; after it nothing in the document can be trusted. Or that it was
/// cancelled.
pub(crate) fn parse(source: &Source<'_>, part: ProgressSpan<'_>) -> Result<Node, ReadError> {
    let mut parser = Parser::new(source, 0, Some(part));
    let document = parser.value().and_then(|node| {
        parser.skip_space();
        if parser.at < parser.bytes.len() {
            return Err(parser.wrong(phrase!("the end of the document")));
        }
        Ok(node)
    });
    let document = document.map_err(|stop| match stop {
        Wrong {
            at,
            found,
            expected,
        } => Rejected::because(Diagnostic::error(source.place(at), found, expected)).into(),
        Stop::Cancelled(cancelled) => ReadError::from(cancelled),
    })?;
    part.reached(1.0)?;
    Ok(document)
}

/// Where the element with this index starts in the array that starts at `at` of a document that
/// was read without an error.
pub(crate) fn element_offset(source: &Source<'_>, at: usize, index: usize) -> usize {
    let mut parser = Parser::new(source, at + 1, None);
    for _ in 0..index {
        if parser.value().is_err() {
            return at;
        }
        parser.skip_space();
        parser.at += 1;
    }
    parser.skip_space();
    parser.at
}

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
    depth: usize,
    part: Option<ProgressSpan<'a>>,
    /// Where the watcher is told next.
    tell_at: usize,
}

impl<'a> Parser<'a> {
    fn new(source: &Source<'a>, at: usize, part: Option<ProgressSpan<'a>>) -> Self {
        Self {
            bytes: source.text.as_bytes(),
            at,
            depth: 0,
            part,
            tell_at: if part.is_some() { 0 } else { usize::MAX },
        }
    }

    /// Tells how far it is, now and then.
    #[inline]
    fn tell(&mut self) -> Parsed<()> {
        if self.at < self.tell_at {
            return Ok(());
        }
        self.tell_at = self.at + AT_ONCE;
        let told = self
            .part
            .map(|part| part.counted(self.at, self.bytes.len()));
        told.unwrap_or(Ok(())).map_err(Stop::Cancelled)
    }

    #[inline]
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    #[inline]
    fn skip_space(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\n' | b'\r' | b'\t')) {
            self.at += 1;
        }
    }

    #[cold]
    fn wrong(&self, expected: Template) -> Stop {
        self.wrong_at(self.at, expected)
    }

    #[cold]
    fn wrong_at(&self, at: usize, expected: Template) -> Stop {
        let rest = self.bytes.get(at..).unwrap_or_default();
        let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-._".contains(byte);
        let word = rest.iter().take_while(|byte| is_word(byte)).count();
        let found = if rest.is_empty() {
            text!("the end of the file")
        } else if word > 0 {
            Text::verbatim(quoted(&String::from_utf8_lossy(&rest[..word])))
        } else {
            let first = String::from_utf8_lossy(&rest[..rest.len().min(4)]);
            Text::verbatim(quoted(&first.chars().take(1).collect::<String>()))
        };
        Wrong {
            at,
            found,
            expected,
        }
    }

    fn value(&mut self) -> Parsed<Node> {
        self.tell()?;
        self.skip_space();
        let at = self.at;
        let value = match self.peek() {
            Some(b'{') => self.nested(Self::object)?,
            Some(b'[') => self.nested(Self::array)?,
            Some(b'"') => Value::Text(self.text()?),
            Some(b'-' | b'0'..=b'9') => Value::Number(self.number()?),
            Some(b't') => self.word("true", Value::Bool(true))?,
            Some(b'f') => self.word("false", Value::Bool(false))?,
            Some(b'n') => self.word("null", Value::Null)?,
            _ => return Err(self.wrong(phrase!("a JSON value"))),
        };
        Ok(Node { at, value })
    }

    fn nested(&mut self, read: fn(&mut Self) -> Parsed<Value>) -> Parsed<Value> {
        if self.depth == DEEPEST {
            return Err(Wrong {
                at: self.at,
                found: text!("more than {most} levels of nesting", most = DEEPEST),
                expected: phrase!("a session or a robot, which have fewer"),
            });
        }
        self.depth += 1;
        self.at += 1;
        let value = read(self)?;
        self.depth -= 1;
        Ok(value)
    }

    fn word(&mut self, word: &str, value: Value) -> Parsed<Value> {
        if !self.bytes[self.at..].starts_with(word.as_bytes()) {
            return Err(self.wrong(phrase!("a JSON value")));
        }
        self.at += word.len();
        Ok(value)
    }

    fn object(&mut self) -> Parsed<Value> {
        let mut members: Vec<Member> = Vec::new();
        let mut keys = BTreeSet::new();
        self.skip_space();
        if self.peek() == Some(b'}') {
            self.at += 1;
            return Ok(Value::Object(members));
        }
        loop {
            self.skip_space();
            let key_at = self.at;
            if self.peek() != Some(b'"') {
                return Err(self.wrong(phrase!("a key in double quotes")));
            }
            let key = self.text()?;
            if !keys.insert(key.clone()) {
                return Err(Wrong {
                    at: key_at,
                    found: text!("the key {key} a second time", key = quoted(&key)),
                    expected: phrase!("every key once"),
                });
            }
            self.skip_space();
            if self.peek() != Some(b':') {
                return Err(self.wrong(phrase!("':' after the key")));
            }
            self.at += 1;
            let node = self.value()?;
            members.push(Member { key, key_at, node });
            self.skip_space();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b'}') => {
                    self.at += 1;
                    return Ok(Value::Object(members));
                }
                _ => return Err(self.wrong(phrase!("',' or '}'"))),
            }
        }
    }

    fn array(&mut self) -> Parsed<Value> {
        self.skip_space();
        if self.peek() == Some(b']') {
            self.at += 1;
            return Ok(Value::List(Vec::new()));
        }
        let start = self.at;
        if let Some(numbers) = self.numbers()? {
            return Ok(Value::Numbers(numbers));
        }
        // Something else is among them: once more, with a node for each.
        self.at = start;
        let mut list = Vec::new();
        loop {
            list.push(self.value()?);
            self.skip_space();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b']') => {
                    self.at += 1;
                    return Ok(Value::List(list));
                }
                _ => return Err(self.wrong(phrase!("',' or ']'"))),
            }
        }
    }

    /// The rest of an array if it holds nothing but numbers and nulls, and not only nulls.
    fn numbers(&mut self) -> Parsed<Option<Vec<f64>>> {
        let mut numbers = Vec::new();
        let mut any = false;
        loop {
            self.tell()?;
            self.skip_space();
            match self.peek() {
                Some(b'-' | b'0'..=b'9') => {
                    any = true;
                    numbers.push(self.number()?);
                }
                Some(b'n') => {
                    self.word("null", Value::Null)?;
                    numbers.push(f64::NAN);
                }
                _ => return Ok(None),
            }
            self.skip_space();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b']') => {
                    self.at += 1;
                    return Ok(any.then_some(numbers));
                }
                _ => return Err(self.wrong(phrase!("',' or ']'"))),
            }
        }
    }

    #[inline]
    fn number(&mut self) -> Parsed<f64> {
        if let Some((value, after)) = plain_decimal(self.bytes, self.at)
            && !matches!(
                self.bytes.get(after),
                Some(b'0'..=b'9' | b'.' | b'e' | b'E' | b'+' | b'-')
            )
            && !self.has_leading_zero()
        {
            self.at = after;
            return Ok(value);
        }
        self.any_number()
    }

    /// `01` is no JSON number.
    #[inline]
    fn has_leading_zero(&self) -> bool {
        let first = self.at + usize::from(self.peek() == Some(b'-'));
        self.bytes.get(first) == Some(&b'0')
            && self.bytes.get(first + 1).is_some_and(u8::is_ascii_digit)
    }

    fn any_number(&mut self) -> Parsed<f64> {
        let start = self.at;
        let wrong =
            |parser: &Self| parser.wrong_at(start, phrase!("a JSON number such as -12.5 or 3e-4"));
        if self.has_leading_zero() {
            return Err(wrong(self));
        }
        self.at += usize::from(self.peek() == Some(b'-'));
        self.digits().ok_or_else(|| wrong(self))?;
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.digits().ok_or_else(|| wrong(self))?;
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            self.at += 1;
            self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
            self.digits().ok_or_else(|| wrong(self))?;
        }
        let text = std::str::from_utf8(&self.bytes[start..self.at]).map_err(|_| wrong(self))?;
        match any_decimal(text) {
            Ok(value) => Ok(value),
            Err(NotANumber::Overflow) => Ok(f64::INFINITY),
            Err(_) => Err(wrong(self)),
        }
    }

    /// Skips at least one digit.
    fn digits(&mut self) -> Option<()> {
        let start = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            self.at += 1;
        }
        (self.at > start).then_some(())
    }

    fn text(&mut self) -> Parsed<String> {
        let start = self.at;
        self.at += 1;
        let mut text = String::new();
        loop {
            let rest = &self.bytes[self.at..];
            let plain = rest
                .iter()
                .position(|&byte| byte == b'"' || byte == b'\\' || byte < 0x20)
                .ok_or_else(|| Wrong {
                    at: start,
                    found: text!("a text that is not closed"),
                    expected: phrase!("a closing '\"'"),
                })?;
            // The document is UTF-8, and both ends of the part are next to ASCII.
            text.push_str(&String::from_utf8_lossy(&rest[..plain]));
            self.at += plain;
            match rest[plain] {
                b'"' => {
                    self.at += 1;
                    return Ok(text);
                }
                b'\\' => text.push(self.escape()?),
                _ => {
                    return Err(Wrong {
                        at: self.at,
                        found: text!("a control character in a text"),
                        expected: phrase!("an escape such as \\n or a closing '\"'"),
                    });
                }
            }
        }
    }

    fn escape(&mut self) -> Parsed<char> {
        let at = self.at;
        self.at += 2;
        Ok(match self.bytes.get(at + 1) {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => return self.unicode_escape(at),
            _ => return Err(self.bad_escape(at)),
        })
    }

    fn unicode_escape(&mut self, at: usize) -> Parsed<char> {
        let first = self.four_hex(at)?;
        let is_high = (0xd800..0xdc00).contains(&first);
        if !is_high || !self.bytes[self.at..].starts_with(b"\\u") {
            return char::from_u32(first).ok_or_else(|| self.bad_escape(at));
        }
        self.at += 2;
        let second = self.four_hex(at)?;
        if !(0xdc00..0xe000).contains(&second) {
            return Err(self.bad_escape(at));
        }
        let code = 0x1_0000 + ((first - 0xd800) << 10) + (second - 0xdc00);
        char::from_u32(code).ok_or_else(|| self.bad_escape(at))
    }

    fn four_hex(&mut self, at: usize) -> Parsed<u32> {
        let mut code = 0;
        for _ in 0..4 {
            let digit = self.peek().and_then(|byte| char::from(byte).to_digit(16));
            code = code * 16 + digit.ok_or_else(|| self.bad_escape(at))?;
            self.at += 1;
        }
        Ok(code)
    }

    #[cold]
    fn bad_escape(&self, at: usize) -> Stop {
        let end = (at + 6).min(self.bytes.len());
        Wrong {
            at,
            found: Text::verbatim(quoted(&String::from_utf8_lossy(&self.bytes[at..end]))),
            expected: phrase!("an escape of JSON such as \\n or \\u00e9"),
        }
    }
}
