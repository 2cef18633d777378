//! XML documents as lists of elements with their places.
//!
//! The elements of a document, and of the documents that it includes, are in one flat list, so that nesting as deep as
//! the file is long is only a long list. Line and column are computed where a message needs them. What is no
//! well-formed XML is refused with its place; so are numbers that are not finite.

use std::ops::Range;
use std::path::{Path, PathBuf};

use roxmltree::{Node, ParsingOptions};

use super::xml_budget;
use super::xml_source::{Piece, Source};
use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::guard;
use crate::text::Text;

/// Files larger than this, in bytes, are no robot descriptions.
const LARGEST_FILE: u64 = 64 << 20;
/// Documents with more elements and texts than this are no robot descriptions; each wants some 150 bytes.
const MOST_NODES: u32 = 100_000;
/// So many files may be included, and so many elements name the content of another.
pub(super) const MOST_FILES: usize = 64;

/// An element, as places in its text.
#[derive(Debug)]
struct Element {
    /// Its name without a prefix; empty for elements of another vocabulary.
    name: Piece,
    /// In [`Document::attributes`].
    attributes: Range<u32>,
    /// The elements in it, in the order of the file.
    children: Vec<usize>,
    source: u32,
    at: u32,
}

#[derive(Debug)]
struct Attribute {
    name: Piece,
    value: Piece,
    at: u32,
}

#[derive(Debug)]
pub(super) struct Document {
    sources: Vec<Source>,
    elements: Vec<Element>,
    attributes: Vec<Attribute>,
}

/// The outermost element of a document.
pub(super) const ROOT: usize = 0;

/// The content of the file where something else is expected.
pub(super) type XmlProblem = (Text, Text);

/// Finds the text of an included file by the name that the document gives it.
pub(super) type Include<'a> = &'a dyn Fn(&str) -> Result<(PathBuf, String), XmlProblem>;

impl Document {
    /// The document `text`, which came from `file`.
    ///
    /// # Errors
    /// What is not well formed, with its place.
    pub(super) fn parse(text: &str, file: &Path) -> Result<Self, Rejected> {
        let mut document = Self {
            sources: Vec::new(),
            elements: Vec::new(),
            attributes: Vec::new(),
        };
        document.add(text, file)?;
        Ok(document)
    }

    /// Reads a document behind the elements that are there already; its root element is the answer.
    fn add(&mut self, text: &str, file: &Path) -> Result<usize, Rejected> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut own = Source::new(text, file);
        xml_budget::check(text).map_err(|(at, found, expected)| {
            Rejected::because(Diagnostic::error(own.place(at), found, expected))
        })?;
        let options = ParsingOptions {
            allow_dtd: true,
            nodes_limit: MOST_NODES.saturating_sub(index(self.elements.len())),
            ..ParsingOptions::default()
        };
        let tree = roxmltree::Document::parse_with_options(text, options).map_err(|error| {
            let at = error.pos();
            let place = Place::file(file).at_line(u64::from(at.row));
            Rejected::because(Diagnostic::error(
                place.at_column(u64::from(at.col)),
                Text::verbatim(without_place(&error.to_string())),
                text!("well-formed XML"),
            ))
        })?;
        let source = index(self.sources.len());
        let root = self.elements.len();
        // Which element of the list each node became; parents come before their children.
        let mut place_of = vec![u32::MAX; tree.root().descendants().count()];
        for node in tree.root().descendants().filter(Node::is_element) {
            let place = self.elements.len();
            place_of[node.id().get_usize()] = index(place);
            let element = self.read(&node, &mut own, source);
            self.elements.push(element);
            if let Some(parent) = node.parent_element() {
                let parent = place_of[parent.id().get_usize()];
                self.elements[parent as usize].children.push(place);
            }
        }
        self.sources.push(own);
        Ok(root)
    }

    fn read(&mut self, node: &Node<'_, '_>, own: &mut Source, source: u32) -> Element {
        // Names with a prefix belong to another vocabulary.
        let foreign = node.tag_name().namespace().is_some_and(|uri| {
            let default = node.default_namespace();
            default != Some(uri)
        });
        let at = node.range().start;
        let name = node.tag_name().name();
        let first = self.attributes.len();
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            self.attributes.push(Attribute {
                name: own.piece(attribute.name(), attribute.range_qname()),
                value: own.piece(attribute.value(), attribute.range_value()),
                at: index(attribute.range().start),
            });
        }
        // Texts between tags, a few words at most where anything is read of them.
        let content = node.first_child().filter(Node::is_text);
        let content = content.and_then(|text| Some((text.text()?, text.range())));
        if let Some((text, range)) = content.filter(|(text, _)| !text.trim().is_empty()) {
            self.attributes.push(Attribute {
                name: Piece::EMPTY,
                value: own.piece(text, range),
                at: index(at),
            });
        }
        Element {
            name: if foreign {
                Piece::EMPTY
            } else {
                own.piece(name, at + 1..at + 1 + name.len())
            },
            attributes: index(first)..index(self.attributes.len()),
            children: Vec::new(),
            source,
            at: index(at),
        }
    }

    /// Puts the children of the included documents in the place of the `include` elements. A file is included once at
    /// most.
    ///
    /// # Errors
    /// Files that cannot be had, are included twice, or are not well formed.
    pub(super) fn follow_includes(&mut self, include: Include<'_>) -> Result<(), Rejected> {
        let mut index = 0;
        while index < self.elements.len() {
            let mut place = 0;
            while place < self.elements[index].children.len() {
                let child = self.elements[index].children[place];
                if self.name(child) != "include" {
                    place += 1;
                    continue;
                }
                let root = self.included(child, include)?;
                let inside = std::mem::take(&mut self.elements[root].children);
                self.elements[index].children.splice(place..=place, inside);
            }
            index += 1;
        }
        Ok(())
    }

    fn included(&mut self, element: usize, include: Include<'_>) -> Result<usize, Rejected> {
        let name = self.required(element, "file")?.to_owned();
        let refuse = |document: &Self, (found, expected): XmlProblem| {
            let place = document.attribute_place(element, "file");
            Rejected::because(Diagnostic::error(place, found, expected))
        };
        if self.sources.len() > MOST_FILES {
            let found = text!("more included files than that");
            return Err(refuse(
                self,
                (found, text!("at most {most}", most = MOST_FILES)),
            ));
        }
        let (file, text) = include(&name).map_err(|mistake| refuse(self, mistake))?;
        if self.sources.iter().any(|source| source.file == file) {
            let found = text!("'{name}' for the second time", name);
            return Err(refuse(self, (found, text!("each file included once"))));
        }
        let so_far: usize = self.sources.iter().map(Source::length).sum();
        if so_far + text.len() > usize::try_from(LARGEST_FILE).unwrap_or(usize::MAX) {
            let found = text!("'{name}', with which the files have more than 64 MiB", name);
            return Err(refuse(self, (found, text!("at most 64 MiB in all"))));
        }
        self.add(&text, &file)
    }

    /// The files that it was read from.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.sources.iter().map(|s| s.file.clone()).collect()
    }

    /// The name of an element without a prefix; empty for one of another vocabulary.
    pub(super) fn name(&self, index: usize) -> &str {
        let element = &self.elements[index];
        self.sources[element.source as usize].text(element.name)
    }

    /// The elements in an element, in the order of the file.
    pub(super) fn inside(&self, index: usize) -> &[usize] {
        &self.elements[index].children
    }

    /// The children of an element with this name.
    pub(super) fn children<'d>(
        &'d self,
        index: usize,
        name: &'d str,
    ) -> impl Iterator<Item = usize> + 'd {
        let children = self.inside(index).iter().copied();
        children.filter(move |child| self.name(*child) == name)
    }

    fn named(&self, index: usize, name: &str) -> Option<&Attribute> {
        let element = &self.elements[index];
        let source = &self.sources[element.source as usize];
        let Range { start, end } = element.attributes;
        let attributes = self.attributes[start as usize..end as usize].iter();
        let mut attributes = attributes.filter(|attribute| source.text(attribute.name) == name);
        attributes.next()
    }

    /// The value of an attribute.
    pub(super) fn attribute(&self, index: usize, name: &str) -> Option<&str> {
        let source = &self.sources[self.elements[index].source as usize];
        let attribute = self.named(index, name)?;
        Some(source.text(attribute.value))
    }

    /// The text between the tags of an element, without blanks around it.
    pub(super) fn content(&self, index: usize) -> Option<&str> {
        self.attribute(index, "").map(str::trim)
    }

    /// The value of an attribute that has to be there.
    ///
    /// # Errors
    /// It is not.
    pub(super) fn required(&self, index: usize, name: &str) -> Result<&str, Rejected> {
        self.attribute(index, name).ok_or_else(|| {
            let element = self.name(index);
            let found = text!("<{element}> without {name}", element, name);
            self.refuse(
                index,
                found,
                text!("<{element} {name}=\"…\">", element, name),
            )
        })
    }

    /// The place of an element.
    pub(super) fn place(&self, index: usize) -> Place {
        let element = &self.elements[index];
        self.place_of(element.source, element.at)
    }

    fn attribute_place(&self, index: usize, name: &str) -> Place {
        let element = &self.elements[index];
        let at = self.named(index, name).map_or(element.at, |a| a.at);
        self.place_of(element.source, at)
    }

    fn place_of(&self, source: u32, at: u32) -> Place {
        self.sources[source as usize].place(at as usize)
    }

    /// A refusal at an element.
    pub(super) fn refuse(
        &self,
        index: usize,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) -> Rejected {
        Rejected::because(Diagnostic::error(self.place(index), found, expected))
    }

    /// A refusal of an attribute's value.
    pub(super) fn refuse_value(
        &self,
        index: usize,
        name: &str,
        expected: impl Into<Text>,
    ) -> Rejected {
        let value = self.attribute(index, name).unwrap_or_default();
        let element = self.name(index);
        let found = text!(
            "{name}=\"{value}\" in <{element}>",
            name,
            value = short(value),
            element
        );
        let place = self.attribute_place(index, name);
        // What xacro puts its values into was not put through it.
        let expected = if value.contains("${") || value.contains("$(") {
            text!("what xacro makes of the file: xacro FILE.urdf.xacro > FILE.urdf")
        } else {
            expected.into()
        };
        Rejected::because(Diagnostic::error(place, found, expected))
    }

    /// `N` finite numbers, where the attribute is there.
    ///
    /// # Errors
    /// Another count, or something that is no finite number.
    pub(super) fn numbers<const N: usize>(
        &self,
        index: usize,
        name: &str,
    ) -> Result<Option<[f64; N]>, Rejected> {
        self.numbers_within(index, name, is_in_range)
    }

    /// The same, by another idea of what a number may be.
    ///
    /// # Errors
    /// As [`Document::numbers`].
    pub(super) fn numbers_within<const N: usize>(
        &self,
        index: usize,
        name: &str,
        good: fn(f64) -> bool,
    ) -> Result<Option<[f64; N]>, Rejected> {
        let Some(text) = self.attribute(index, name) else {
            return Ok(None);
        };
        let mut numbers = [0.0; N];
        let mut count = 0;
        for part in text.split_ascii_whitespace() {
            let number = part.parse::<f64>().ok().filter(|x| good(*x));
            let (Some(number), Some(place)) = (number, numbers.get_mut(count)) else {
                count = usize::MAX;
                break;
            };
            *place = number;
            count += 1;
        }
        if count == N {
            return Ok(Some(numbers));
        }
        let expected = match N {
            1 => text!("one finite number"),
            count => text!("{count} finite numbers with spaces between", count),
        };
        let expected = if text.split_ascii_whitespace().any(is_too_large) {
            text!("{expected}, each of at most 1 000 000", expected)
        } else {
            expected
        };
        Err(self.refuse_value(index, name, expected))
    }

    /// One finite number, where the attribute is there.
    ///
    /// # Errors
    /// As [`Document::numbers`].
    pub(super) fn number(&self, index: usize, name: &str) -> Result<Option<f64>, Rejected> {
        Ok(self.numbers::<1>(index, name)?.map(|[number]| number))
    }
}

/// Metres, angles and kilograms of a robot: what is beyond 10⁶ is none of them, and lengths in mm are
/// checked once more where the chain is built.
fn is_in_range(number: f64) -> bool {
    number.abs() <= crate::units::LARGEST_NUMBER
}

fn is_too_large(text: &str) -> bool {
    text.parse::<f64>()
        .is_ok_and(|number| number.is_finite() && !is_in_range(number))
}

/// A place in a list or a text, both of which have their limits.
fn index(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

/// A message without the place at its end, which is written in front of it.
fn without_place(message: &str) -> String {
    match message.rsplit_once(" at ") {
        Some((what, place)) if place.bytes().all(|b| b.is_ascii_digit() || b == b':') => {
            what.to_owned()
        }
        _ => message.to_owned(),
    }
}

/// The beginning of a long value.
fn short(value: &str) -> String {
    const SHOWN: usize = 60;
    if value.chars().count() <= SHOWN {
        return value.to_owned();
    }
    let start: String = value.chars().take(SHOWN).collect();
    format!("{start}…")
}

/// A robot description as text.
pub(super) fn read_text(path: &Path) -> Result<String, XmlProblem> {
    let bytes = guard::read_regular(path, LARGEST_FILE).map_err(|(found, expected)| {
        let found = if expected.to_string() == "a regular file" {
            text!("{found}, not a regular file", found)
        } else {
            found
        };
        let readable = text!("a robot description of at most 64 MiB that can be read");
        (found, readable)
    })?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err((
            text!("a file in {encoding}", encoding = "UTF-16"),
            text!("UTF-8"),
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let head = String::from_utf8_lossy(&error.as_bytes()[..error.as_bytes().len().min(200)])
            .into_owned();
        let declared = head.split_once("encoding=").and_then(|(_, rest)| {
            let quote = rest.chars().next()?;
            rest[quote.len_utf8()..]
                .split(quote)
                .next()
                .map(str::to_owned)
        });
        let found = match declared {
            Some(encoding) if !encoding.eq_ignore_ascii_case("utf-8") => {
                text!(
                    "a file that is declared as {encoding}",
                    encoding = short(&encoding)
                )
            }
            _ => Text::verbatim(error.utf8_error().to_string()),
        };
        (
            found,
            text!("UTF-8: save it so, and declare encoding=\"UTF-8\" in its first line"),
        )
    })
}

/// The included file `name` of a document in `folder`: a file there or below.
pub(super) fn read_included(folder: &Path, name: &str) -> Result<(PathBuf, String), XmlProblem> {
    let path = guard::below(folder, name, phrase!("the folder of the document"));
    let path = path.map_err(|(found, expected)| {
        let says = found.to_string();
        let leads = says.contains("leads upwards") || says.starts_with("an absolute path");
        let found = if leads {
            text!("an include that leads elsewhere, {found}", found)
        } else {
            found
        };
        (found, expected)
    })?;
    let text = read_text(&path)
        .map_err(|(found, expected)| (text!("{found}: {name}", found, name), expected))?;
    Ok((path, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Document, Rejected> {
        Document::parse(text, Path::new("r.xml"))
    }

    #[test]
    fn a_mistake_is_told_with_line_and_column() {
        for (text, place) in [
            ("<robot>\n<link name='a'>\n </joint></robot>", "line 3"),
            ("<robot>\n<link name=a/></robot>", "line 2"),
            ("<robot>\n\n<link name='a' name='b'/></robot>", "line 3"),
            ("", "line 1"),
            ("<robot/>\n<robot/>", "line 2"),
            ("<robot/><!-- no end", "line 1"),
        ] {
            let message = parse(text).unwrap_err().to_string();
            assert!(message.starts_with("r.xml, line "), "{message}");
            assert!(message.contains(place), "{message}");
        }
        let document = parse("<robot>\r\n  <axis xyz='0 0 x'/></robot>").unwrap();
        let message = document.numbers::<3>(1, "xyz").unwrap_err().to_string();
        let expected =
            "r.xml, line 2, column 9: xyz=\"0 0 x\" in <axis>; expected 3 finite numbers";
        assert!(message.starts_with(expected), "{message}");
    }

    #[test]
    fn vectors_have_as_many_finite_numbers_as_they_have_components() {
        for xyz in [
            "0 0",
            "0 0 1 2",
            "0 0 nan",
            "0 0 inf",
            "0 a 1",
            "",
            "1e999 0 0",
        ] {
            let document = parse(&format!("<axis xyz='{xyz}'/>")).unwrap();
            assert!(document.numbers::<3>(0, "xyz").is_err(), "{xyz}");
        }
        let document = parse("<axis xyz=' 1\t-2.5e-3\n 0 '/>").unwrap();
        let read = document.numbers::<3>(0, "xyz").unwrap();
        assert_eq!(read, Some([1.0, -2.5e-3, 0.0]));
        assert_eq!(document.numbers::<3>(0, "rpy").unwrap(), None);
    }

    #[test]
    fn nesting_as_deep_as_the_file_is_long_is_only_a_long_list() {
        let deep = "<a>".repeat(90_000);
        let back = "</a>".repeat(90_000);
        let document = parse(&format!("<robot>{deep}{back}</robot>")).unwrap();
        assert_eq!(document.elements.len(), 90_001);
    }

    #[test]
    fn more_elements_than_a_robot_has_are_refused() {
        let many = "<a/>".repeat(100_001);
        let message = parse(&format!("<robot>{many}</robot>")).unwrap_err();
        assert!(message.to_string().contains("nodes limit"), "{message}");
    }

    #[test]
    fn values_are_those_of_the_text_with_entities_and_escapes_written_out() {
        let text =
            "<!DOCTYPE r [<!ENTITY e 'links'>]><r a='&e; &lt;' b = \"x\ty\" c=''><s d='é'/></r>";
        let document = parse(text).unwrap();
        let value = |element, name| document.attribute(element, name);
        assert_eq!(value(0, "a"), Some("links <"));
        assert_eq!(value(0, "b"), Some("x y"));
        assert_eq!((value(0, "c"), value(0, "d")), (Some(""), None));
        assert_eq!((value(1, "d"), document.name(1)), (Some("é"), "s"));
        let prefixed = parse("<x:r xmlns:x='u' xmlns='u'/>").unwrap();
        assert_eq!(prefixed.name(0), "r");
    }

    #[test]
    fn elements_and_attributes_with_a_prefix_are_somebody_elses() {
        let text = "<robot xmlns:x='u'><x:link name='a'/><link x:name='b'/></robot>";
        let document = parse(text).unwrap();
        assert_eq!(document.children(0, "link").collect::<Vec<_>>(), [2]);
        assert_eq!(document.attribute(2, "name"), None);
    }

    #[test]
    fn what_is_included_stands_in_place_of_the_include() {
        let include = |name: &str| match name {
            "a" => Ok((PathBuf::from("a"), "<r><x/><include file='b'/></r>".into())),
            "b" => Ok((PathBuf::from("b"), "<r><y/></r>".into())),
            "loop" => Ok((
                PathBuf::from("loop"),
                "<r><include file='loop'/></r>".into(),
            )),
            _ => Err((Text::verbatim(name), Text::verbatim("a file"))),
        };
        let read = |text: &str| {
            let mut document = parse(text).unwrap();
            document.follow_includes(&include).map(|()| document)
        };
        let document = read("<m><w/><include file='a'/><z/></m>").unwrap();
        let children = document.inside(0).iter();
        let names: Vec<&str> = children.map(|c| document.name(*c)).collect();
        assert_eq!(names, ["w", "x", "y", "z"]);
        assert_eq!(document.files().len(), 3);
        for wrong in ["loop", "gone"] {
            let message = read(&format!("<m>\n<include file='{wrong}'/></m>"));
            assert!(message.unwrap_err().to_string().contains(".xml, line 2") || wrong == "loop");
        }
    }
}
