//! A text of lists and mappings as a tree: YAML in blocks and in brackets, as much of both as programs
//! print for poses, and the brackets of Python, numpy and MATLAB.
//!
//! Anchors, tags, strings over several lines and other parts of YAML are not read: such a text is no
//! list here, and stays as it is.

/// Lists in lists that are followed.
const DEEPEST: usize = 32;

/// A value and the line on which it begins.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    Scalar(String, u64),
    List(Vec<Node>, u64),
    Map(Vec<(String, Node)>, u64),
}

/// All values of a text; `None` where it is anything else than lists and mappings.
pub(super) fn parse(text: &str) -> Option<Vec<Node>> {
    let lines = lines_of(text);
    let first = lines.iter().find(|line| !line.text.is_empty())?;
    let opens = first.text.starts_with(['[', '(', '{']) || called(first.text).is_some();
    if opens {
        return Flow::new(&lines).all();
    }
    let starts = first.text.starts_with("- ") || first.text == "-" || key_of(first.text).is_some();
    if !starts {
        return None;
    }
    let mut all = Vec::new();
    for document in lines.split(|line| line.text == "---" || line.text == "...") {
        let lines: Vec<Line> = document
            .iter()
            .filter(|line| !line.text.is_empty())
            .copied()
            .collect();
        let mut block = Block {
            lines: &lines,
            at: 0,
        };
        while block.at < lines.len() {
            let indent = lines[block.at].indent;
            all.push(block.node(indent, 0)?);
        }
    }
    let has_list = |node: &Node| !matches!(node, Node::Scalar(..));
    all.iter().any(has_list).then_some(all)
}

/// A line without its indentation and comment.
#[derive(Debug, Clone, Copy)]
struct Line<'a> {
    number: u64,
    indent: usize,
    text: &'a str,
}

fn lines_of(text: &str) -> Vec<Line<'_>> {
    let lines = text.lines().enumerate().map(|(index, line)| {
        let plain = without_comment(line);
        let indent = plain.len() - plain.trim_start().len();
        Line {
            number: index as u64 + 1,
            indent,
            text: plain.trim(),
        }
    });
    lines.collect()
}

/// A comment begins a line, or stands behind a space.
fn without_comment(line: &str) -> &str {
    let trimmed = line.trim_start();
    if trimmed.starts_with(['#', '%']) || trimmed.starts_with("//") {
        return "";
    }
    let mut quote = None;
    let mut before = ' ';
    for (at, c) in line.char_indices() {
        match (quote, c) {
            (None, '"' | '\'') if !before.is_alphanumeric() => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            (None, '#' | '%') if before.is_whitespace() => return &line[..at],
            _ => {}
        }
        before = c;
    }
    line
}

/// `name = [` or `array([`: what stands behind the name.
fn called(text: &str) -> Option<&str> {
    let name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let rest = text.trim_start_matches(name);
    if rest.len() == text.len() {
        return None;
    }
    let rest = rest.trim_start();
    let rest = match rest.strip_prefix('=') {
        Some(rest) => rest.trim_start(),
        None => rest,
    };
    if rest.starts_with(['[', '(']) {
        return Some(rest);
    }
    // `q = np.array([`
    let inner = rest.trim_start_matches(name);
    (inner.len() < rest.len() && inner.starts_with('(')).then_some(inner)
}

/// The key of `key: value` and its value.
fn key_of(text: &str) -> Option<(String, &str)> {
    let (key, rest) = if let quote @ ('"' | '\'') = text.chars().next()? {
        let end = text[1..].find(quote)?;
        (
            &text[1..=end],
            text[end + 2..].trim_start().strip_prefix(':')?,
        )
    } else {
        let at = text
            .find(": ")
            .or_else(|| text.ends_with(':').then(|| text.len() - 1))?;
        (&text[..at], &text[at + 1..])
    };
    let sound =
        !key.is_empty() && key.len() < 200 && !key.contains(['[', ']', '{', '}', ',', ';', '\t']);
    sound.then(|| (key.trim().to_owned(), rest.trim()))
}

/// Sequences and mappings by indentation.
struct Block<'a> {
    lines: &'a [Line<'a>],
    at: usize,
}

impl<'a> Block<'a> {
    fn here(&self) -> Option<Line<'a>> {
        self.lines.get(self.at).copied()
    }

    /// The value that begins here, at this indentation.
    fn node(&mut self, indent: usize, depth: usize) -> Option<Node> {
        let line = self.here()?;
        if depth > DEEPEST || line.indent != indent {
            return None;
        }
        if line.text == "-" || line.text.starts_with("- ") {
            return self.sequence(indent, depth);
        }
        if line.text.starts_with(['[', '{', '(']) {
            return self.flow(line.text);
        }
        if key_of(line.text).is_some() {
            return self.mapping(indent, depth, None);
        }
        None
    }

    fn sequence(&mut self, indent: usize, depth: usize) -> Option<Node> {
        let number = self.here()?.number;
        let mut items = Vec::new();
        while let Some(line) = self.here().filter(|line| line.indent == indent) {
            let Some(rest) = line.text.strip_prefix('-') else {
                break;
            };
            if !(rest.is_empty() || rest.starts_with(' ')) {
                return None;
            }
            items.push(self.item(line, rest, depth + 1)?);
        }
        Some(Node::List(items, number))
    }

    /// What stands behind a dash.
    fn item(&mut self, line: Line<'a>, rest: &'a str, depth: usize) -> Option<Node> {
        if depth > DEEPEST {
            return None;
        }
        let text = rest.trim_start();
        if text.is_empty() {
            self.at += 1;
            let next = self.here().filter(|next| next.indent > line.indent)?;
            return self.node(next.indent, depth);
        }
        let inner = line.indent + 1 + (rest.len() - text.len());
        if text == "-" || text.starts_with("- ") {
            // A sequence that begins on the line of its own dash.
            let mut items = vec![self.item(
                Line {
                    indent: inner,
                    text,
                    ..line
                },
                &text[1..],
                depth + 1,
            )?];
            if let Some(next) = self.here().filter(|next| next.indent == inner)
                && next.text.starts_with('-')
                && let Node::List(more, _) = self.sequence(inner, depth + 1)?
            {
                items.extend(more);
            }
            return Some(Node::List(items, line.number));
        }
        if text.starts_with(['[', '{', '(']) {
            return self.flow(text);
        }
        if key_of(text).is_some() {
            return self.mapping(inner, depth, Some(text));
        }
        self.at += 1;
        Some(Node::Scalar(unquoted(text), line.number))
    }

    /// A mapping; `first` is its first entry where that stands behind a dash.
    fn mapping(&mut self, indent: usize, depth: usize, first: Option<&'a str>) -> Option<Node> {
        let number = self.here()?.number;
        let mut entries = Vec::new();
        let mut first = first;
        while let Some(line) = self.here() {
            let text = match first.take() {
                Some(text) => text,
                None if line.indent == indent && !line.text.starts_with("- ") => line.text,
                None => break,
            };
            let (key, value) = key_of(text)?;
            if value.starts_with(['[', '{', '(']) {
                entries.push((key, self.flow(value)?));
                continue;
            }
            self.at += 1;
            if !value.is_empty() {
                entries.push((key, Node::Scalar(unquoted(value), line.number)));
                continue;
            }
            // A sequence may stand at the indentation of its key.
            let below = self.here().filter(|next| {
                next.indent > indent
                    || next.indent == indent && (next.text == "-" || next.text.starts_with("- "))
            });
            let node = match below {
                Some(next) => self.node(next.indent, depth + 1)?,
                None => Node::Scalar(String::new(), line.number),
            };
            entries.push((key, node));
        }
        Some(Node::Map(entries, number))
    }

    /// A value in brackets, which may go over several lines.
    fn flow(&mut self, text: &'a str) -> Option<Node> {
        let number = self.here()?.number;
        let mut lines = vec![Line {
            number,
            indent: 0,
            text,
        }];
        let mut open = balance(text);
        self.at += 1;
        while open > 0 {
            let line = self.here()?;
            open += balance(line.text);
            lines.push(line);
            self.at += 1;
        }
        let all = Flow::new(&lines).all()?;
        <[Node; 1]>::try_from(all).ok().map(|[node]| node)
    }
}

/// Opened less closed brackets.
fn balance(text: &str) -> i64 {
    let sign = |c| match c {
        '[' | '(' | '{' => 1,
        ']' | ')' | '}' => -1,
        _ => 0,
    };
    text.chars().map(sign).sum()
}

fn unquoted(text: &str) -> String {
    let inner = |quote: char| {
        text.strip_prefix(quote)
            .and_then(|text| text.strip_suffix(quote))
    };
    inner('"')
        .or_else(|| inner('\''))
        .unwrap_or(text)
        .to_owned()
}

/// Values in brackets.
struct Flow {
    tokens: Vec<(Token, u64)>,
    at: usize,
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Open(char),
    Close,
    Comma,
    Semicolon,
    Colon,
    LineEnd,
    Word(String),
}

impl Flow {
    fn new(lines: &[Line<'_>]) -> Self {
        let mut tokens = Vec::new();
        for line in lines {
            let text = called(line.text).unwrap_or(line.text);
            tokens_of(text, line.number, &mut tokens);
            tokens.push((Token::LineEnd, line.number));
        }
        Self { tokens, at: 0 }
    }

    fn here(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|(token, _)| token)
    }

    /// Values one behind the other, each in brackets.
    fn all(mut self) -> Option<Vec<Node>> {
        let mut all = Vec::new();
        while let Some(token) = self.here() {
            match token {
                Token::LineEnd | Token::Comma | Token::Semicolon => self.at += 1,
                Token::Open(_) => all.push(self.value(0)?),
                Token::Word(text) if text == "---" => self.at += 1,
                _ => return None,
            }
        }
        Some(all)
    }

    fn value(&mut self, depth: usize) -> Option<Node> {
        if depth > DEEPEST {
            return None;
        }
        let (token, line) = self.tokens.get(self.at)?.clone();
        self.at += 1;
        match token {
            Token::Open('{') => self.mapping(depth, line),
            Token::Open(_) => self.list(depth, line),
            Token::Word(text) => Some(Node::Scalar(text, line)),
            _ => None,
        }
    }

    fn list(&mut self, depth: usize, line: u64) -> Option<Node> {
        let mut rows: Vec<Vec<Node>> = vec![Vec::new()];
        let (mut has_commas, mut has_rows, mut start) = (false, false, line);
        loop {
            let (token, number) = self.tokens.get(self.at)?.clone();
            match token {
                Token::Close => break,
                Token::Comma => has_commas = true,
                Token::Semicolon => {
                    has_rows = true;
                    rows.push(Vec::new());
                }
                // MATLAB ends a row of a matrix with its line; numpy breaks lines within a row.
                Token::LineEnd if depth == 0 && !has_commas => rows.push(Vec::new()),
                Token::LineEnd => {}
                Token::Colon => return None,
                Token::Word(text) if text.starts_with("dtype=") => {}
                Token::Word(_) | Token::Open(_) => {
                    if let Some(row) = rows.last_mut() {
                        if row.is_empty() {
                            start = number;
                        }
                        let node = self.value(depth + 1)?;
                        row.push(node);
                        continue;
                    }
                }
            }
            self.at += 1;
        }
        self.at += 1;
        rows.retain(|row| !row.is_empty());
        let scalar = |node: &Node| matches!(node, Node::Scalar(..));
        let are_rows =
            rows.len() > 1 && (has_rows || !has_commas) && rows.iter().flatten().all(scalar);
        if are_rows {
            let row = |cells: Vec<Node>| {
                let line = match &cells[0] {
                    Node::Scalar(_, line) => *line,
                    _ => start,
                };
                Node::List(cells, line)
            };
            return Some(Node::List(rows.into_iter().map(row).collect(), line));
        }
        let mut items: Vec<Node> = rows.into_iter().flatten().collect();
        // `array([[…]])`: brackets around one list are none.
        if let [Node::List(..)] = &items[..]
            && let Some(inner) = items.pop()
        {
            return Some(inner);
        }
        Some(Node::List(items, line))
    }

    fn mapping(&mut self, depth: usize, line: u64) -> Option<Node> {
        let mut entries = Vec::new();
        loop {
            match self.tokens.get(self.at)?.0.clone() {
                Token::Close => break,
                Token::Comma | Token::LineEnd => self.at += 1,
                Token::Word(key) => {
                    self.at += 1;
                    if self.here() != Some(&Token::Colon) {
                        return None;
                    }
                    self.at += 1;
                    while self.here() == Some(&Token::LineEnd) {
                        self.at += 1;
                    }
                    entries.push((key, self.value(depth + 1)?));
                }
                _ => return None,
            }
        }
        self.at += 1;
        Some(Node::Map(entries, line))
    }
}

fn tokens_of(text: &str, line: u64, tokens: &mut Vec<(Token, u64)>) {
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        let token = match c {
            '[' | '(' | '{' => Token::Open(c),
            ']' | ')' | '}' => Token::Close,
            ',' => Token::Comma,
            ';' => Token::Semicolon,
            ':' => Token::Colon,
            c if c.is_whitespace() => {
                rest = &rest[length..];
                continue;
            }
            '"' | '\'' => {
                let end = rest[1..].find(c).map_or(rest.len(), |end| end + 2);
                length = end;
                Token::Word(rest[..end].trim_matches(c).to_owned())
            }
            _ => {
                let ends = |c: char| c.is_whitespace() || "[](){},;:".contains(c);
                // A word may open a bracket: `array(`.
                let end = rest.find(ends).unwrap_or(rest.len());
                length = end;
                if rest[end..].starts_with('(') {
                    rest = &rest[end..];
                    continue;
                }
                Token::Word(rest[..end].to_owned())
            }
        };
        tokens.push((token, line));
        rest = &rest[length..];
    }
}
