//! From text to a tree. `serde_json` judges the grammar and reads texts; what it accepted is walked
//! through once more, for where each value starts.

use std::collections::BTreeSet;

use serde::de::{Deserialize, IgnoredAny};

use super::{Member, Node, Source, Value};
use crate::diagnostic::{Diagnostic, Rejected};
use crate::document::number::{ONCE, quoted};
use crate::progress::{Cancelled, Progress, ProgressSpan, ReadError, unwatched};
use crate::text::{Template, Text};

/// No sound document nests deeper than this, and the stack is finite.
const DEEPEST: i32 = 64;

/// Bytes between two looks at the watcher.
const AT_ONCE: usize = 1 << 18;

/// Reads a whole document, told as `part` of something.
///
/// # Errors
/// The first syntax error; after it nothing in the document can be trusted. Or that it was
/// cancelled.
pub(crate) fn parse(source: &Source<'_>, part: ProgressSpan<'_>) -> Result<Node, ReadError> {
    source.read::<IgnoredAny>(0, source.text.len())?;
    let document = Walk::new(source, part, 0).node()?;
    part.reached(1.0)?;
    Ok(document)
}

/// Where the element with this index starts in the array that starts at `at` of a document that
/// was read without an error.
pub(crate) fn element_offset(source: &Source<'_>, at: usize, index: usize) -> usize {
    let progress = Progress::new(&unwatched);
    let mut walk = Walk::new(source, progress.whole(), at + 1);
    for _ in 0..index {
        if walk.node().is_err() {
            break;
        }
    }
    walk.skip();
    walk.at
}

/// A walk through a document whose grammar is right.
struct Walk<'s> {
    source: &'s Source<'s>,
    part: ProgressSpan<'s>,
    at: usize,
    depth: i32,
    /// Where the watcher is told next.
    tell_at: usize,
}

impl<'s> Walk<'s> {
    fn new(source: &'s Source<'s>, part: ProgressSpan<'s>, at: usize) -> Self {
        let (depth, tell_at) = (0, 0);
        Self {
            source,
            part,
            at,
            depth,
            tell_at,
        }
    }

    /// Tells how far it is, now and then.
    fn tell(&mut self) -> Result<(), Cancelled> {
        if self.at < self.tell_at {
            return Ok(());
        }
        self.tell_at = self.at + AT_ONCE;
        self.part.counted(self.at, self.source.text.len())
    }

    fn byte(&self) -> u8 {
        let byte = self.source.text.as_bytes().get(self.at);
        byte.copied().unwrap_or_default()
    }

    /// Skips what stands between values.
    fn skip(&mut self) {
        while matches!(self.byte(), b' ' | b'\n' | b'\r' | b'\t' | b',' | b':') {
            self.at += 1;
        }
    }

    fn node(&mut self) -> Result<Node, ReadError> {
        self.tell()?;
        self.skip();
        let at = self.at;
        let level = i32::from(matches!(self.byte(), b'{' | b'['));
        self.depth += level;
        if self.depth > DEEPEST {
            self.source.check_depth()?;
        }
        let value = match self.byte() {
            b'{' => {
                let mut keys = BTreeSet::new();
                Value::Object(self.all(|walk| walk.member(&mut keys))?)
            }
            b'[' => match self.numbers()? {
                Some(numbers) => Value::Numbers(numbers),
                None => Value::List(self.all(Self::node)?),
            },
            b'"' => Value::Text(self.text()?),
            b't' | b'f' => Value::Bool(self.word() == "true"),
            b'n' => {
                self.at += 4;
                Value::Null
            }
            _ => Value::Number(self.number()),
        };
        self.depth -= level;
        Ok(Node { at, value })
    }

    /// Everything in an array or an object.
    fn all<T>(
        &mut self,
        mut read: impl FnMut(&mut Self) -> Result<T, ReadError>,
    ) -> Result<Vec<T>, ReadError> {
        let mut all = Vec::new();
        self.at += 1;
        self.skip();
        while !matches!(self.byte(), b']' | b'}') {
            all.push(read(self)?);
            self.skip();
        }
        self.at += 1;
        Ok(all)
    }

    fn member(&mut self, keys: &mut BTreeSet<String>) -> Result<Member, ReadError> {
        let key_at = self.at;
        let key = self.text()?;
        if !keys.insert(key.clone()) {
            let found = text!("{name} a second time", name = quoted(&key));
            return Err(self.source.wrong(key_at, found, ONCE));
        }
        let node = self.node()?;
        Ok(Member { key, key_at, node })
    }

    fn text(&mut self) -> Result<String, ReadError> {
        let start = self.at;
        self.at += 1;
        while self.byte() != b'"' {
            self.at += 1 + usize::from(self.byte() == b'\\');
        }
        self.at += 1;
        self.source.read(start, self.at)
    }

    fn word(&mut self) -> &str {
        let rest = &self.source.text[self.at..];
        let length = rest.bytes().take_while(|byte| is_of_word(*byte)).count();
        self.at += length;
        &rest[..length]
    }

    /// What overflows is infinite.
    fn number(&mut self) -> f64 {
        self.word().parse().unwrap_or(f64::NAN)
    }

    /// An array of nothing but numbers and nulls (NaN), and not only nulls.
    fn numbers(&mut self) -> Result<Option<Vec<f64>>, Cancelled> {
        let (start, mut numbers) = (self.at, Vec::new());
        self.at += 1;
        loop {
            self.tell()?;
            self.skip();
            match self.byte() {
                b'-' | b'0'..=b'9' => numbers.push(self.number()),
                b'n' => {
                    self.at += 4;
                    numbers.push(f64::NAN);
                }
                b']' if numbers.iter().any(|v| !v.is_nan()) => {
                    self.at += 1;
                    return Ok(Some(numbers));
                }
                _ => {
                    self.at = start;
                    return Ok(None);
                }
            }
        }
    }
}

impl Source<'_> {
    /// What `serde_json` reads between two bytes.
    fn read<'t, T: Deserialize<'t>>(&'t self, from: usize, to: usize) -> Result<T, ReadError> {
        serde_json::from_str(&self.text[from..to]).map_err(|error| self.refusal(from, &error))
    }

    /// Refuses what nests too deeply.
    fn check_depth(&self) -> Result<(), ReadError> {
        let (mut depth, mut in_text) = (0, false);
        let mut bytes = self.text.bytes().enumerate();
        while let Some((at, byte)) = bytes.next() {
            match byte {
                b'"' => in_text = !in_text,
                b'\\' if in_text => _ = bytes.next(),
                b'[' | b'{' if !in_text => depth += 1,
                b']' | b'}' if !in_text => depth -= 1,
                _ => {}
            }
            if depth > DEEPEST {
                let found = text!(
                    "more than {most} levels of nesting",
                    most = DEEPEST as usize
                );
                let expected = phrase!("a session or a robot, which have fewer");
                return Err(self.wrong(at, found, expected));
            }
        }
        Ok(())
    }

    fn wrong(&self, at: usize, found: Text, expected: Template) -> ReadError {
        Rejected::because(Diagnostic::error(self.place(at), found, expected)).into()
    }

    /// What `serde_json` says of a part of the text, in words that have translations.
    fn refusal(&self, from: usize, error: &serde_json::Error) -> ReadError {
        if let Err(too_deep) = self.check_depth() {
            return too_deep;
        }
        let (text, end) = (self.text.as_bytes(), self.text.len());
        let lines = self.text[from..].split_inclusive('\n');
        let lines = lines.take(error.line().saturating_sub(1));
        let line = from + lines.map(str::len).sum::<usize>();
        // The byte that was looked at last.
        let last = (line + error.column()).saturating_sub(1).min(end);
        let back = |is_before: fn(u8) -> bool| {
            let before = text[..last].iter().rposition(|byte| is_before(*byte));
            before.map_or(0, |before| before + 1)
        };
        let is_last = |of: &[u8]| text.trim_ascii_end().last().is_some_and(|b| of.contains(b));
        let value = phrase!("a JSON value");
        let key = phrase!("a key in double quotes");
        let colon = phrase!("':' after the key");
        let last_text = self.text.trim_end().strip_suffix('"').unwrap_or_default();
        let before = last_text.rfind('"').map(|at| last_text[..at].trim_end());
        let ends_with_key = before.is_some_and(|before| before.ends_with(['{', ',']));
        let message = error.to_string();
        let (at, expected) = match message.split(" at line ").next().unwrap_or_default() {
            "EOF while parsing an object" if is_last(b"{,") => (end, key),
            "EOF while parsing an object" if ends_with_key => (end, colon),
            "EOF while parsing an object" => (end, phrase!("',' or '}'")),
            "EOF while parsing a list" if is_last(b"[") => (end, value),
            "EOF while parsing a list" => (end, phrase!("',' or ']'")),
            "EOF while parsing a value" => (end, value),
            "EOF while parsing a string" => {
                let found = text!("a quote that is not closed");
                let at = self.text.rfind('"').unwrap_or(last);
                return self.wrong(at, found, phrase!("a closing quote"));
            }
            "key must be a string" => (last, key),
            "expected `:`" => (last, colon),
            "expected `,` or `}`" => (last, phrase!("',' or '}'")),
            "expected `,` or `]`" => (last, phrase!("',' or ']'")),
            "trailing characters" => (last, phrase!("the end of the document")),
            "expected value" => (last, value),
            "expected ident" => (back(|byte| !is_of_word(byte)), value),
            "invalid number" => {
                let expected = phrase!("a JSON number such as -12.5 or 3e-4");
                (back(|byte| !is_of_word(byte)), expected)
            }
            says if says.starts_with("control character") => {
                let found = text!("a control character in a text");
                let expected = phrase!("an escape such as \\n or a closing '\"'");
                return self.wrong(last + 1, found, expected);
            }
            _ => {
                let at = back(|byte| byte == b'\\').saturating_sub(1);
                // The first half of a pair says more than what should have been its second.
                let is_half = |at: &usize| {
                    matches!(
                        text[*at..],
                        [b'\\', b'u', b'd', b'8' | b'9' | b'a' | b'b', ..]
                    )
                };
                let at = at.checked_sub(6).filter(is_half).unwrap_or(at);
                let found = String::from_utf8_lossy(&text[at..end.min(at + 6)]);
                let expected = phrase!("an escape of JSON such as \\n or \\u00e9");
                return self.wrong(at, Text::verbatim(quoted(&found)), expected);
            }
        };
        let rest = String::from_utf8_lossy(&text[at..]);
        let word = rest.bytes().take_while(|byte| is_of_word(*byte)).count();
        let found = match rest.chars().next() {
            None => text!("the end of the file"),
            Some(first) => Text::verbatim(quoted(&rest[..word.max(first.len_utf8())])),
        };
        self.wrong(at, found, expected)
    }
}

/// Whether it belongs to a word or a number.
fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"+-._".contains(&byte)
}
