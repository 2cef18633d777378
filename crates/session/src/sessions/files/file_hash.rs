//! The hash of a samples file, which the session's document holds: so a document that another's samples
//! came to lie beside says so.
//!
//! SHA-256 of the bytes, carriage returns left out: what only ends its lines differently holds the same
//! samples. Files that the program writes have none, so that `sha256sum` gives the same.

use std::cell::RefCell;
use std::io::{self, Read, Write};

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

/// A reader that hashes what passes, where that is wanted.
pub(crate) struct HashedInput<'a, R> {
    input: R,
    hash: &'a RefCell<Option<Sha256>>,
}

impl<'a, R> HashedInput<'a, R> {
    pub(crate) fn new(input: R, hash: &'a RefCell<Option<Sha256>>) -> Self {
        Self { input, hash }
    }
}

impl<R: Read> Read for HashedInput<'_, R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(bytes)?;
        if let Some(hash) = self.hash.borrow_mut().as_mut() {
            add(hash, &bytes[..read]);
        }
        Ok(read)
    }
}

/// A hash to be filled, where `wanted`.
pub(crate) fn begun(wanted: bool) -> RefCell<Option<Sha256>> {
    RefCell::new(wanted.then(Sha256::new))
}

/// What it came to: 64 hexadecimal digits.
pub(crate) fn ended(hash: RefCell<Option<Sha256>>) -> Option<String> {
    hash.into_inner().map(|hash| hexadecimal(&hash.finalize()))
}
