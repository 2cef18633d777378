//! A program as statements, and each statement as a plain list of tokens; comments are left out.

use std::ops::Range;

use crate::text::Template;

use super::number::{Number, Span};
use super::target::Problem;
use super::text::Text;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or a keyword.
    Name,
    /// Digits, a point, an exponent: a number, or an attempt at one. It has no sign of its own.
    Digits,
    /// A string with its quotes.
    String,
    /// One sign.
    Sign(u8),
}

/// What it is, and its bytes.
type Token = (Kind, Range<usize>);

/// How a language writes comments, strings, lists and the ends of its statements.
pub(super) struct Dialect {
    /// Each begins a comment that goes to the end of the line.
    pub(super) comments: &'static [u8],
    /// Quotes of strings; two inside are one that belongs to the string.
    pub(super) strings: &'static [u8],
    /// Whether capitals tell names apart.
    pub(super) cased: bool,
    /// What stands behind a statement, for messages.
    pub(super) end: Template,
    /// Whether a statement ends behind its last token: what follows, and whether on another line.
    pub(super) ends: fn(&Words, Option<Kind>, bool) -> bool,
    /// Brackets of lists, and whether each part begins with its name: `{X 1, Y 2}`.
    pub(super) lists: [u8; 2],
    pub(super) keyed: bool,
    /// What was expected where a part of a list is missing.
    pub(super) part: Template,
    /// Brackets of the number of an element.
    pub(super) elements: [u8; 2],
}

/// One statement.
pub(super) struct Words<'t, 'a> {
    pub(super) text: &'t Text<'a>,
    dialect: &'static Dialect,
    tokens: Vec<Token>,
    /// Brackets that are open behind the last token.
    depth: usize,
}

/// Hands out every statement of some bytes, one after the other; a string that does not end on its line is a problem.
pub(super) fn statements(
    text: &Text,
    range: Range<usize>,
    dialect: &'static Dialect,
    mut each: impl FnMut(Result<&Words, Problem>),
) {
    let bytes = &text.bytes[..range.end];
    let empty = || Words {
        text,
        dialect,
        tokens: Vec::new(),
        depth: 0,
    };
    let mut words = empty();
    let mut at = range.start;
    let mut next = token(bytes, at, dialect);
    loop {
        let one = match next {
            Ok(Some(one)) => one,
            Ok(None) => break,
            Err(problem) => {
                at = end_of_line(bytes, problem.at);
                each(Err(problem));
                words = empty();
                next = token(bytes, at, dialect);
                continue;
            }
        };
        at = one.1.end;
        words.push(one);
        if words.len() > LONGEST_STATEMENT {
            let most = LONGEST_STATEMENT;
            let found = text!("a statement of more than {most} words", most);
            let problem = Problem::new(words.at(0), found, text!("one that ends"));
            return each(Err(problem));
        }
        next = token(bytes, at, dialect);
        let follows = next.as_ref().ok().and_then(Option::as_ref);
        let until = follows.map_or(bytes.len(), |(_, range)| range.start);
        let breaks = bytes[at..until].iter().any(|b| matches!(b, b'\n' | b'\r'));
        if (dialect.ends)(&words, follows.map(|(kind, _)| *kind), breaks) {
            each(Ok(&words));
            words.tokens.clear();
            words.depth = 0;
        }
    }
    if !words.tokens.is_empty() {
        each(Ok(&words));
    }
}

/// Words of a statement are held together: those of an array of 20 000 targets, and no file of any size.
const LONGEST_STATEMENT: usize = 1_000_000;

/// Names are kept and spoken of again and again; those of the languages have at most 32 letters, or no limit (`URScript`).
const LONGEST_NAME: usize = 1000;

/// The first token from a byte on.
fn token(bytes: &[u8], mut at: usize, dialect: &Dialect) -> Result<Option<Token>, Problem> {
    while let Some(byte) = bytes.get(at).copied() {
        if byte.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        if dialect.comments.contains(&byte) {
            at = end_of_line(bytes, at);
            continue;
        }
        let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        let (kind, end) = if dialect.strings.contains(&byte) {
            (Kind::String, string_end(bytes, at)?)
        } else if digit(at) || (byte == b'.' && digit(at + 1)) {
            (Kind::Digits, number_end(bytes, at))
        } else if is_of_name(byte) {
            let end = end_of(bytes, at, is_of_name);
            if end - at > LONGEST_NAME {
                let count = (end - at).to_string();
                let found = text!("a name of {count} characters", count);
                let expected = text!("at most {most}", most = LONGEST_NAME);
                return Err(Problem::new(at, found, expected));
            }
            (Kind::Name, end)
        } else {
            (Kind::Sign(byte), at + 1)
        };
        return Ok(Some((kind, at..end)));
    }
    Ok(None)
}

/// Whether a name is one of these, between blanks.
pub(super) fn is_one_of(name: &str, all: &str) -> bool {
    all.split(' ').any(|known| known == name)
}

pub(super) fn is_of_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$' || byte >= 0x80
}

fn end_of(bytes: &[u8], at: usize, belongs: impl Fn(u8) -> bool) -> usize {
    let rest = bytes[at..].iter().position(|b| !belongs(*b));
    rest.map_or(bytes.len(), |n| at + n)
}

fn end_of_line(bytes: &[u8], at: usize) -> usize {
    end_of(bytes, at, |b| b != b'\n' && b != b'\r')
}

/// A number with everything that sticks to it, so that a slip of the keyboard is seen as one.
fn number_end(bytes: &[u8], at: usize) -> usize {
    let mut end = at;
    while let Some(byte) = bytes.get(end) {
        // The sign of an exponent, where digits and points stand before the e.
        let plain = |b: &u8| b.is_ascii_digit() || *b == b'.';
        let power = matches!(byte, b'+' | b'-')
            && matches!(bytes[end - 1], b'e' | b'E')
            && bytes[at..end - 1].iter().all(plain);
        if !(is_of_name(*byte) || *byte == b'.' || power) {
            break;
        }
        end += 1;
    }
    end
}

fn string_end(bytes: &[u8], at: usize) -> Result<usize, Problem> {
    let quote = bytes[at];
    let mut end = at + 1;
    while let Some(byte) = bytes.get(end).filter(|b| !matches!(b, b'\n' | b'\r')) {
        end += 1;
        if *byte == quote {
            if bytes.get(end) != Some(&quote) {
                return Ok(end);
            }
            end += 1;
        }
    }
    let found = text!("a string that does not end on its line");
    let expected = text!("{char} at its end", char = char::from(quote));
    Err(Problem::new(at, found, expected))
}

/// A value as it is written.
pub(super) enum Value {
    Number(Number),
    List(List),
    /// Something else, a name or what is worked out at run time: its words.
    Other(Range<usize>),
}

/// A list in brackets.
pub(super) struct List {
    pub(super) at: usize,
    /// The type that it states itself, in small letters: `{E6AXIS: A1 …}`.
    pub(super) stated: Option<String>,
    pub(super) parts: Vec<Part>,
}

/// A part of a list, with its name in small letters if it has one.
pub(super) struct Part {
    pub(super) key: String,
    pub(super) value: Value,
}

impl List {
    pub(super) fn get(&self, key: &str) -> Option<&Value> {
        let part = self.parts.iter().find(|part| part.key == key);
        part.map(|part| &part.value)
    }

    pub(super) fn number(&self, key: &str) -> Option<Number> {
        self.get(key).and_then(Value::number)
    }

    /// Its first part, if that is a list.
    pub(super) fn first_list(&self) -> Option<&Self> {
        self.parts.first()?.value.list()
    }

    /// The name that its part begins with, where that is neither a number nor a list.
    pub(super) fn word(&self, words: &Words, part: usize) -> String {
        match self.parts.get(part).map(|part| &part.value) {
            Some(Value::Other(range)) => words.name(range.start),
            _ => String::new(),
        }
    }

    /// Whether all parts have one of these names.
    pub(super) fn has_only(&self, names: &[&[&str]]) -> bool {
        let known = |part: &Part| names.iter().any(|names| names.contains(&&*part.key));
        self.parts.iter().all(known)
    }

    /// Its numbers, if all parts are.
    pub(super) fn numbers(&self) -> Option<Vec<Number>> {
        self.parts.iter().map(|part| part.value.number()).collect()
    }
}

impl Value {
    pub(super) fn number(&self) -> Option<Number> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Where it begins.
    pub(super) fn at(&self, words: &Words) -> usize {
        match self {
            Self::Number(number) => number.range().start,
            Self::Other(range) => words.at(range.start),
            Self::List(list) => list.at,
        }
    }

    pub(super) fn list(&self) -> Option<&List> {
        match self {
            Self::List(list) => Some(list),
            _ => None,
        }
    }
}

/// Lists in lists that a target or an array of targets needs, and some more.
const DEEPEST: usize = 16;

impl<'t> Words<'t, '_> {
    fn push(&mut self, token: Token) {
        match token.0 {
            Kind::Sign(b'[' | b'(' | b'{') => self.depth += 1,
            Kind::Sign(b']' | b')' | b'}') => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
        self.tokens.push(token);
    }

    pub(super) fn len(&self) -> usize {
        self.tokens.len()
    }

    /// Whether all brackets are closed.
    pub(super) fn is_closed(&self) -> bool {
        self.depth == 0
    }

    /// A word's bytes.
    pub(super) fn bytes(&self, k: usize) -> &'t [u8] {
        let token = self.tokens.get(k);
        token.map_or(&[], |(_, range)| &self.text.bytes[range.clone()])
    }

    pub(super) fn range(&self, k: usize) -> Range<usize> {
        let end = self.tokens.last().map_or(0, |(_, range)| range.end);
        self.tokens
            .get(k)
            .map_or(end..end, |(_, range)| range.clone())
    }

    /// Where a word stands, in a file of at most 4 GiB.
    pub(super) fn span(&self, k: usize) -> Option<Span> {
        Span::of(&self.range(k))
    }

    /// Where a word begins; behind the last one where the last ends.
    pub(super) fn at(&self, k: usize) -> usize {
        self.range(k).start
    }

    pub(super) fn kind(&self, k: usize) -> Option<Kind> {
        self.tokens.get(k).map(|(kind, _)| *kind)
    }

    pub(super) fn is_sign(&self, k: usize, sign: u8) -> bool {
        self.kind(k) == Some(Kind::Sign(sign))
    }

    pub(super) fn is_name(&self, k: usize) -> bool {
        self.kind(k) == Some(Kind::Name)
    }

    /// A name, in small letters where capitals mean nothing; empty where there is none.
    pub(super) fn name(&self, k: usize) -> String {
        match self.kind(k) {
            Some(Kind::Name) if self.dialect.cased => self.spelled(k),
            Some(Kind::Name) => self.spelled(k).to_lowercase(),
            _ => String::new(),
        }
    }

    /// A word as it is spelled.
    pub(super) fn spelled(&self, k: usize) -> String {
        String::from_utf8_lossy(self.bytes(k)).into_owned()
    }

    /// The text from a word to the one before `end`: what is spoken of, so not much more than a name.
    pub(super) fn shown(&self, k: usize, end: usize) -> String {
        let range = self.at(k)..self.range(end.max(k + 1) - 1).end;
        if range.len() <= LONGEST_NAME {
            return self.text.shown(range);
        }
        self.text.shown(range.start..range.start + LONGEST_NAME) + "…"
    }

    /// A number, with its sign if it has one, that begins at word `k`: the number and the word behind
    /// it. `None` where there is none; an attempt at one is a problem.
    pub(super) fn number(&self, k: usize) -> Option<Result<(Number, usize), Problem>> {
        let signed = self.is_sign(k, b'-') || self.is_sign(k, b'+');
        let digits = k + usize::from(signed);
        if self.kind(digits) != Some(Kind::Digits) {
            return None;
        }
        let range = self.at(k)..self.range(digits).end;
        let read = Number::read(self.text.bytes, range.clone(), false);
        let wrong = |expected| {
            let found =
                crate::text::Text::verbatim(format!("'{}'", self.text.shown(range.clone())));
            Problem::new(range.start, found, expected)
        };
        Some(read.map(|number| (number, digits + 1)).map_err(wrong))
    }

    /// `name[3]`, with a number, if word `k` is that.
    pub(super) fn element(&self, k: usize) -> Option<String> {
        let [open, close] = self.dialect.elements;
        let digits = self.kind(k + 2) == Some(Kind::Digits);
        let is = self.is_sign(k + 1, open) && digits && self.is_sign(k + 3, close);
        let (open, close) = (char::from(open), char::from(close));
        is.then(|| format!("{}{open}{}{close}", self.name(k), self.spelled(k + 2)))
    }

    /// The word behind the brackets of an element that open behind word `k`.
    pub(super) fn behind_element(&self, k: usize) -> Option<usize> {
        let [open, close] = self.dialect.elements;
        let is = self.is_sign(k + 1, open);
        is.then(|| self.until(k + 2, &[close]) + 1)
    }

    /// That something else was expected at a word.
    pub(super) fn problem(&self, k: usize, expected: impl Into<crate::text::Text>) -> Problem {
        let found = if k < self.len() {
            crate::text::Text::verbatim(format!("'{}'", self.spelled(k)))
        } else {
            self.dialect.end.into()
        };
        Problem::new(self.at(k), found, expected)
    }

    /// That a sign stands at a word.
    pub(super) fn expect(&self, k: usize, sign: u8) -> Result<(), Problem> {
        if self.is_sign(k, sign) {
            return Ok(());
        }
        Err(self.problem(k, crate::text::Text::verbatim(char::from(sign))))
    }

    /// The first word from `k` on that is one of the signs, outside of brackets that open on the way.
    pub(super) fn until(&self, k: usize, signs: &[u8]) -> usize {
        let mut depth = 0_usize;
        for j in k..self.len() {
            if let Some(Kind::Sign(sign)) = self.kind(j) {
                // A statement's end ends everything.
                if signs.contains(&sign) && (depth == 0 || sign == b';') {
                    return j;
                }
                match sign {
                    b'[' | b'(' | b'{' => depth += 1,
                    b']' | b')' | b'}' => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
        }
        self.len().max(k)
    }

    /// The word with `=` of an assignment (RAPID: `:=`), outside of brackets and before a comma.
    pub(super) fn assigns(&self, k: usize) -> Option<usize> {
        let equals = self.until(k, b"=,");
        let compared = matches!(self.kind(equals + 1), Some(Kind::Sign(b'=')))
            || equals > 0
                && matches!(
                    self.kind(equals - 1),
                    Some(Kind::Sign(b'=' | b'<' | b'>' | b'!'))
                );
        (self.is_sign(equals, b'=') && equals > k && !compared).then_some(equals)
    }

    /// The list that begins with a bracket at word `k`, and the word behind it.
    pub(super) fn list(&self, k: usize) -> Result<(List, usize), Problem> {
        self.list_in(k, 0)
    }

    fn value(&self, k: usize, depth: usize) -> Result<(Value, usize), Problem> {
        let [open, close] = self.dialect.lists;
        if self.is_sign(k, open) {
            let (list, end) = self.list_in(k, depth)?;
            return Ok((Value::List(list), end));
        }
        if let Some(read) = self.number(k) {
            let (number, end) = read?;
            // A sum or a product is worked out at run time.
            if !matches!(self.kind(end), Some(Kind::Sign(b'+' | b'-' | b'*' | b'/'))) {
                return Ok((Value::Number(number), end));
            }
        }
        let end = self.until(k, &[b',', close, b';']);
        if end == k {
            return Err(self.problem(k, self.dialect.part));
        }
        Ok((Value::Other(k..end), end))
    }

    fn list_in(&self, k: usize, depth: usize) -> Result<(List, usize), Problem> {
        let (keyed, close) = (self.dialect.keyed, self.dialect.lists[1]);
        let mut list = List {
            at: self.at(k),
            stated: None,
            parts: Vec::new(),
        };
        if depth > DEEPEST {
            let found = text!("blocks in blocks");
            return Err(Problem::new(
                list.at,
                found,
                text!("at most {most} deep", most = DEEPEST),
            ));
        }
        let mut k = k + 1;
        if keyed && self.is_sign(k + 1, b':') {
            list.stated = Some(self.name(k));
            k += 2;
        } else if !keyed && self.is_sign(k, close) {
            return Ok((list, k + 1));
        }
        loop {
            let mut key = String::new();
            if keyed {
                key = self.name(k);
                if key.is_empty() {
                    return Err(self.problem(k, text!("the name of a component")));
                }
                // No type has more components, and a list of strangers is not searched again and again.
                if list.parts.iter().rev().take(64).any(|part| part.key == key) {
                    let component = key.to_uppercase();
                    let found = text!("{name} a second time", name = component);
                    let expected = text!("each once");
                    return Err(Problem::new(self.at(k), found, expected));
                }
                k += 1;
            }
            let (value, end) = self.value(k, depth + 1)?;
            list.parts.push(Part { key, value });
            if self.is_sign(end, close) {
                return Ok((list, end + 1));
            }
            if !self.is_sign(end, b',') {
                let expected = match close {
                    b']' => "',' ']'",
                    _ => "',' '}'",
                };
                return Err(self.problem(end, crate::text::Text::verbatim(expected)));
            }
            k = end + 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    static RAPID: Dialect = Dialect {
        comments: b"!",
        strings: b"\"",
        cased: false,
        end: phrase!("the end of the file"),
        ends: |words, _, _| words.is_sign(words.len() - 1, b';'),
        lists: *b"[]",
        keyed: false,
        part: phrase!("a number"),
        elements: *b"{}",
    };

    fn spelled(source: &str) -> Vec<Vec<String>> {
        let text = Text::new(source.as_bytes());
        let mut all = Vec::new();
        statements(&text, 0..source.len(), &RAPID, |words| {
            let words = words.unwrap();
            all.push((0..words.len()).map(|k| words.spelled(k)).collect());
        });
        all
    }

    #[test]
    fn comments_are_left_out_and_strings_stay_whole() {
        assert_eq!(
            spelled("p:=[1.5,-2E+3]; ! [9]\nx \"a \"\"[b]\"\" c\""),
            [
                vec!["p", ":", "=", "[", "1.5", ",", "-", "2E+3", "]", ";"],
                vec!["x", "\"a \"\"[b]\"\" c\""]
            ]
        );
    }

    #[test]
    fn an_exponent_belongs_to_its_number_and_a_difference_does_not() {
        assert_eq!(spelled("1-2"), [["1", "-", "2"]]);
        assert_eq!(spelled("1E-2-3"), [["1E-2", "-", "3"]]);
        assert_eq!(spelled("1.2.3"), [["1.2.3"]]);
    }

    #[test]
    fn a_statement_without_end_is_one_problem() {
        let source = "1,".repeat(LONGEST_STATEMENT);
        let text = Text::new(source.as_bytes());
        let mut all = Vec::new();
        statements(&text, 0..source.len(), &RAPID, |words| {
            all.push(words.err().map(|problem| problem.at));
        });
        assert_eq!(all, [Some(0)]);
    }

    #[test]
    fn a_string_without_end_is_a_problem_at_its_quote_and_the_next_line_is_read() {
        let text = Text::new(b"ab \"cd\nef\"\ng;");
        let (mut problems, mut good) = (Vec::new(), 0);
        statements(&text, 0..13, &RAPID, |words| match words {
            Ok(_) => good += 1,
            Err(problem) => problems.push(problem.at),
        });
        assert_eq!((problems, good), (vec![3, 9], 1));
    }
}
