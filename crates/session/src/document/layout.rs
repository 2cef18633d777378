//! How a document looks: one key per line, short arrays on theirs, whole numbers without `.0`.

use std::io::{Result, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};

/// Writes a document with a line feed at its end.
///
/// # Errors
/// What writing to `output` says.
pub(crate) fn write_document(mut output: impl Write, document: &impl Serialize) -> Result<()> {
    let layout = Layout(PrettyFormatter::new());
    document.serialize(&mut Serializer::with_formatter(&mut output, layout))?;
    output.write_all(b"\n")
}

/// A document as text.
///
/// # Panics
/// Never: writing to memory does not fail.
pub fn text_of(document: &impl Serialize) -> String {
    let mut text = Vec::new();
    write_document(&mut text, document).expect("writing to memory does not fail");
    String::from_utf8(text).expect("JSON is UTF-8")
}

/// As `serde_json` lays out objects, with arrays on their line.
struct Layout(PrettyFormatter<'static>);

impl Formatter for Layout {
    fn begin_array_value<W: Write + ?Sized>(&mut self, to: &mut W, first: bool) -> Result<()> {
        if first { Ok(()) } else { to.write_all(b", ") }
    }

    fn begin_object<W: Write + ?Sized>(&mut self, to: &mut W) -> Result<()> {
        self.0.begin_object(to)
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, to: &mut W, first: bool) -> Result<()> {
        self.0.begin_object_key(to, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, to: &mut W) -> Result<()> {
        self.0.begin_object_value(to)
    }

    fn end_object_value<W: Write + ?Sized>(&mut self, to: &mut W) -> Result<()> {
        self.0.end_object_value(to)
    }

    fn end_object<W: Write + ?Sized>(&mut self, to: &mut W) -> Result<()> {
        self.0.end_object(to)
    }

    fn write_f64<W: Write + ?Sized>(&mut self, to: &mut W, value: f64) -> Result<()> {
        write_number(to, value)
    }
}

/// Writes a finite number with the fewest digits that read back as the same double; `1e300` is not
/// spelled out.
pub(crate) fn write_number<W: Write + ?Sized>(to: &mut W, value: f64) -> Result<()> {
    let size = value.abs();
    if size == 0.0 || (1e-7..1e17).contains(&size) {
        write!(to, "{value}")
    } else {
        write!(to, "{value:e}")
    }
}
