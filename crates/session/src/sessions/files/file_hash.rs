//! The hash of a samples file, which the session's document holds: so a document that another's samples
//! came to lie beside says so.
//!
//! SHA-256 of the bytes, carriage returns left out: what only ends its lines differently holds the same
//! samples. Files that the program writes have none, so that `sha256sum` gives the same.

use std::io::{self, Write};

use sha2::{Digest, Sha256};

use crate::document::number::hexadecimal;

fn add(hash: &mut Sha256, bytes: &[u8]) {
    for part in bytes.split(|byte| *byte == b'\r') {
        hash.update(part);
    }
}

/// A writer that hashes what passes.
pub(crate) struct Hashed<'a> {
    output: &'a mut dyn Write,
    hash: Sha256,
}

impl<'a> Hashed<'a> {
    pub(crate) fn new(output: &'a mut dyn Write) -> Self {
        Self {
            output,
            hash: Sha256::new(),
        }
    }

    /// 64 hexadecimal digits.
    pub(crate) fn finish(self) -> String {
        hexadecimal(&self.hash.finalize())
    }
}

impl Write for Hashed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.output.write(bytes)?;
        add(&mut self.hash, &bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

/// The hash of these bytes: 64 hexadecimal digits.
pub(crate) fn of(bytes: &[u8]) -> String {
    let mut hash = Sha256::new();
    add(&mut hash, bytes);
    hexadecimal(&hash.finalize())
}
