//! What of a URDF document matters to kinematics, as a document of its own.
//!
//! URDF files carry meshes, materials, plug-ins of simulators, and mistakes in all of them. The
//! crate that reads URDF (`urdf-rs`) refuses a file for a mistake in a mesh, says nothing of lines,
//! and can be made to panic or to overflow the stack by namespaces and deep nesting. So the
//! document is scanned here first, in one pass and without recursion: what is not well formed is
//! refused with its line, the few elements of interest are checked and written out anew, at most
//! four levels deep and without namespaces, and only they reach the crate.

use std::fmt::Write;

/// A mistake and where it stands, counted from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Mistake {
    pub(super) line: u64,
    pub(super) found: String,
    pub(super) expected: String,
}

/// An element that is open while the scan goes on.
struct Open<'a> {
    name: &'a str,
    line: u64,
    kept: bool,
}

/// The part of `text` that describes links and joints, or the first mistake.
pub(super) fn kinematic_part(text: &str) -> Result<String, Mistake> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut scan = Scan {
        rest: text,
        line: 1,
    };
    let mut open: Vec<Open<'_>> = Vec::new();
    let mut kept = String::new();
    let mut root_seen = false;

    while scan.skip_to_tag() {
        let line = scan.line;
        if scan.skip_if("<!--", "-->")?
            || scan.skip_if("<![CDATA[", "]]>")?
            || scan.skip_if("<?", "?>")?
            || scan.skip_if("<!DOCTYPE", ">")?
        {
            continue;
        }
        if scan.rest.starts_with("</") {
            let name = scan.end_tag()?;
            match open.pop() {
                Some(last) if last.name == name => {
                    if last.kept {
                        push(&mut kept, format_args!("</{name}>\n"));
                    }
                }
                Some(last) => {
                    return Err(mistake(
                        line,
                        format!("</{name}>"),
                        format!("</{}>, opened in line {}", last.name, last.line),
                    ));
                }
                None => return Err(mistake(line, format!("</{name}>"), "an element to close")),
            }
            continue;
        }
        let tag = scan.start_tag()?;
        if open.is_empty() {
            if root_seen {
                return Err(mistake(
                    line,
                    format!("a second root element <{}>", tag.name),
                    "the end of the file",
                ));
            }
            if tag.name != "robot" {
                return Err(mistake(
                    line,
                    format!("<{}>", tag.name),
                    "<robot>, as a URDF file begins",
                ));
            }
            root_seen = true;
        }
        let keep = open.last().is_none_or(|parent| parent.kept) && is_wanted(&open, tag.name);
        if keep {
            tag.check_numbers()?;
            tag.write_to(&mut kept);
        }
        if tag.closed {
            if keep {
                push(&mut kept, format_args!("</{}>\n", tag.name));
            }
        } else {
            open.push(Open {
                name: tag.name,
                line,
                kept: keep,
            });
        }
    }
    match open.pop() {
        Some(last) => Err(mistake(
            last.line,
            format!("<{}> is never closed", last.name),
            format!("</{}> before the end of the file", last.name),
        )),
        None if !root_seen => Err(mistake(1, "no element", "a URDF document with <robot>")),
        None => Ok(kept),
    }
}

fn is_wanted(open: &[Open<'_>], name: &str) -> bool {
    let parent = open.last().map(|open| open.name);
    match (open.len(), parent) {
        (0, _) => name == "robot",
        (1, _) => matches!(name, "link" | "joint"),
        (2, Some("link")) => name == "inertial",
        (2, Some("joint")) => {
            matches!(
                name,
                "origin" | "parent" | "child" | "axis" | "limit" | "mimic"
            )
        }
        // The inertia itself is not needed here: gravity asks for mass and centre only.
        (3, Some("inertial")) => matches!(name, "origin" | "mass"),
        _ => false,
    }
}

/// A start tag as it stands in the file.
struct Tag<'a> {
    name: &'a str,
    line: u64,
    attributes: Vec<(&'a str, &'a str)>,
    /// Whether it is its own end tag.
    closed: bool,
}

impl Tag<'_> {
    fn has(&self, wanted: &str) -> bool {
        self.attributes.iter().any(|(name, _)| *name == wanted)
    }

    /// Vectors have as many numbers as they should, and all are finite. (The crate skips what is not
    /// a number, and takes NaN for one.)
    fn check_numbers(&self) -> Result<(), Mistake> {
        for (name, value) in &self.attributes {
            let (count, may_be_infinite) = match (self.name, *name) {
                ("origin" | "axis", "xyz") | ("origin", "rpy") => (3, false),
                ("origin", "quat_xyzw") => (4, false),
                ("mass", "value") | ("mimic", "multiplier" | "offset") => (1, false),
                // No limit is written as an infinite one by some exporters.
                ("limit", _) => (1, true),
                _ => continue,
            };
            let good = |part: &str| {
                part.parse::<f64>()
                    .is_ok_and(|x| x.is_finite() || (may_be_infinite && !x.is_nan()))
            };
            let mut parts = value.split_ascii_whitespace();
            if parts.clone().count() != count || !parts.all(good) {
                let expected = match count {
                    1 => "one finite number".to_owned(),
                    count => format!("{count} finite numbers with spaces between"),
                };
                return Err(mistake(
                    self.line,
                    format!("{name}=\"{value}\" in <{}>", self.name),
                    expected,
                ));
            }
        }
        Ok(())
    }

    fn write_to(&self, out: &mut String) {
        push(out, format_args!("<{}", self.name));
        for (name, value) in &self.attributes {
            // Attributes with a prefix belong to somebody else's vocabulary.
            if !name.contains(':') && *name != "xmlns" {
                push(
                    out,
                    format_args!(" {name}=\"{}\"", value.replace('"', "&quot;")),
                );
            }
        }
        // The crate insists on both; nothing here reads them, and files often leave them out.
        if self.name == "limit" && !self.has("velocity") {
            out.push_str(" velocity=\"0\"");
        }
        out.push('>');
        if self.name == "inertial" {
            out.push_str("<inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/>");
        }
    }
}

/// The text that is still to be read, which begins in `line`.
struct Scan<'a> {
    rest: &'a str,
    line: u64,
}

impl<'a> Scan<'a> {
    /// Goes to the next `<`; false at the end of the text.
    fn skip_to_tag(&mut self) -> bool {
        match self.rest.find('<') {
            Some(at) => {
                self.take(at);
                true
            }
            None => false,
        }
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.bytes().filter(|byte| *byte == b'\n').count() as u64;
        self.rest = rest;
        taken
    }

    fn skip_if(&mut self, start: &str, end: &str) -> Result<bool, Mistake> {
        let Some(inside) = self.rest.strip_prefix(start) else {
            return Ok(false);
        };
        match inside.find(end) {
            Some(at) => {
                self.take(start.len() + at + end.len());
                Ok(true)
            }
            None => Err(mistake(
                self.line,
                format!("{start} without an end"),
                format!("{end} after it"),
            )),
        }
    }

    fn end_tag(&mut self) -> Result<&'a str, Mistake> {
        let line = self.line;
        let Some(at) = self.rest.find('>') else {
            return Err(mistake(line, "</ without an end", "a closing '>'"));
        };
        let tag = self.take(at + 1);
        Ok(tag[2..tag.len() - 1].trim_end())
    }

    fn start_tag(&mut self) -> Result<Tag<'a>, Mistake> {
        let line = self.line;
        self.take(1);
        let name = self.name();
        if name.is_empty() {
            return Err(mistake(
                line,
                "'<' without a name",
                "the name of an element",
            ));
        }
        let mut attributes: Vec<(&str, &str)> = Vec::new();
        loop {
            self.skip_space();
            if self.rest.starts_with('>') {
                self.take(1);
                return Ok(Tag {
                    name,
                    line,
                    attributes,
                    closed: false,
                });
            }
            if self.rest.starts_with("/>") {
                self.take(2);
                return Ok(Tag {
                    name,
                    line,
                    attributes,
                    closed: true,
                });
            }
            let (key, value) = self.attribute(name)?;
            if attributes.iter().any(|(known, _)| *known == key) {
                return Err(mistake(
                    self.line,
                    format!("attribute {key} twice in <{name}>"),
                    "each attribute once",
                ));
            }
            attributes.push((key, value));
        }
    }

    fn attribute(&mut self, element: &str) -> Result<(&'a str, &'a str), Mistake> {
        let wrong = |line| {
            mistake(
                line,
                format!("<{element}> that is not well formed"),
                "attributes as name=\"value\", then '>' or '/>'",
            )
        };
        let key = self.name();
        self.skip_space();
        if key.is_empty() || !self.rest.starts_with('=') {
            return Err(wrong(self.line));
        }
        self.take(1);
        self.skip_space();
        let Some(quote) = self.rest.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
            return Err(wrong(self.line));
        };
        self.take(1);
        let Some(length) = self.rest.find(quote) else {
            return Err(wrong(self.line));
        };
        // A '<' in a value is forbidden, and mostly means that a quote is missing further up.
        if self.rest[..length].contains('<') {
            return Err(wrong(self.line));
        }
        let value = self.take(length);
        self.take(1);
        Ok((key, value))
    }

    fn name(&mut self) -> &'a str {
        let is_end =
            |c: char| c.is_ascii_whitespace() || matches!(c, '<' | '>' | '/' | '=' | '"' | '\'');
        let length = self.rest.find(is_end).unwrap_or(self.rest.len());
        self.take(length)
    }

    fn skip_space(&mut self) {
        let length = self
            .rest
            .find(|c: char| !c.is_ascii_whitespace())
            .unwrap_or(self.rest.len());
        self.take(length);
    }
}

fn mistake(line: u64, found: impl Into<String>, expected: impl Into<String>) -> Mistake {
    Mistake {
        line,
        found: found.into(),
        expected: expected.into(),
    }
}

/// Writing into a string cannot fail.
fn push(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_plug_ins_and_comments_are_left_out() {
        let text = "<?xml version='1.0'?><!DOCTYPE robot><!-- <link> -->\n\
            <robot name='r' xmlns:x='u'><link name=\"a\" x:y='1'><visual><geometry><mesh/></geometry></visual></link>\
            <gazebo><joint name='not mine'/></gazebo><x:macro/></robot>";
        let kept = kinematic_part(text).unwrap();
        assert_eq!(
            kept,
            "<robot name=\"r\"><link name=\"a\"></link>\n</robot>\n"
        );
    }

    #[test]
    fn a_mistake_is_told_with_its_line() {
        let line_of = |text: &str| kinematic_part(text).unwrap_err().line;
        assert_eq!(line_of("<robot>\n<link name='a'>\n</joint></robot>"), 3);
        assert_eq!(line_of("<robot>\n<link name='a'>\n"), 2);
        assert_eq!(line_of("<robot>\n<link name=a/></robot>"), 2);
        assert_eq!(line_of("<robot>\n\n<link name='a' name='b'/></robot>"), 3);
        assert_eq!(line_of("\n<sdf/>"), 2);
        assert_eq!(line_of(""), 1);
        assert_eq!(line_of("<robot/>\n<robot/>"), 2);
        assert_eq!(line_of("<robot/><!-- no end"), 1);
    }

    #[test]
    fn vectors_need_as_many_finite_numbers_as_they_have_components() {
        for xyz in [
            "0 0",
            "0 0 1 2",
            "0 0 nan",
            "0 0 inf",
            "0 zero 1",
            "",
            "1e999 0 0",
        ] {
            let text = format!("<robot><joint><axis xyz='{xyz}'/></joint></robot>");
            let mistake = kinematic_part(&text).unwrap_err();
            assert!(mistake.found.contains("in <axis>"), "{xyz}");
        }
    }

    #[test]
    fn nesting_as_deep_as_the_file_is_long_is_only_a_long_list() {
        let deep = "<a>".repeat(200_000);
        let back = "</a>".repeat(200_000);
        let kept = kinematic_part(&format!("<robot>{deep}{back}</robot>")).unwrap();
        assert_eq!(kept, "<robot></robot>\n");
    }
}
