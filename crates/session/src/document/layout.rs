//! How a document looks: one key per line, short arrays on theirs, whole numbers without `.0`.

use std::io;

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// Writes a document with a line feed at its end.
///
/// # Errors
/// What writing to `output` says.
pub(crate) fn write_document(output: impl io::Write, document: &impl Serialize) -> io::Result<()> {
    let mut output = output;
    document.serialize(&mut Serializer::with_formatter(
        &mut output,
        Layout::default(),
    ))?;
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

/// The state of the layout.
#[derive(Debug, Default)]
struct Layout {
    depth: usize,
    empty: bool,
}

impl Layout {
    fn indent<W: io::Write + ?Sized>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        for _ in 0..self.depth {
            writer.write_all(b"  ")?;
        }
        Ok(())
    }
}

impl Formatter for Layout {
    fn begin_array_value<W: io::Write + ?Sized>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        if first {
            Ok(())
        } else {
            writer.write_all(b", ")
        }
    }

    fn begin_object<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        self.empty = true;
        writer.write_all(b"{")
    }

    fn begin_object_key<W: io::Write + ?Sized>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.empty = false;
        if !first {
            writer.write_all(b",")?;
        }
        self.indent(writer)
    }

    fn begin_object_value<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn end_object<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth -= 1;
        if !self.empty {
            self.indent(writer)?;
        }
        self.empty = false;
        writer.write_all(b"}")
    }

    fn write_f64<W: io::Write + ?Sized>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write_number(writer, value)
    }
}

/// Writes a finite number with the fewest digits that read back as the same double; `1e300` is not
/// spelled out.
pub(crate) fn write_number<W: io::Write + ?Sized>(writer: &mut W, value: f64) -> io::Result<()> {
    let size = value.abs();
    if size == 0.0 || (1e-7..1e17).contains(&size) {
        write!(writer, "{value}")
    } else {
        write!(writer, "{value:e}")
    }
}
