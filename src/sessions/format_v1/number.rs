//! Numbers with the fewest digits that read back as the same double.

use std::io;

/// Writes a finite number; `1e300` is not spelled out.
pub(crate) fn write<W: io::Write + ?Sized>(writer: &mut W, value: f64) -> io::Result<()> {
    let size = value.abs();
    if size == 0.0 || (1e-7..1e17).contains(&size) {
        write!(writer, "{value}")
    } else {
        write!(writer, "{value:e}")
    }
}
