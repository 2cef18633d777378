//! A file in large blocks that end where a line ends.

use std::io::{self, Read};

use crate::document::number::PADDING;

/// Large enough that calls cost nothing, small enough to stay in a processor's second cache.
const BLOCK: usize = 256 << 10;

/// No sample has a line this long.
pub(super) const LONGEST_LINE: usize = 64 << 20;

/// Reads ahead of the rows.
pub(super) struct Blocks<R> {
    input: R,
    /// `filled` bytes, then at least [`PADDING`] that are no digits.
    buffer: Vec<u8>,
    filled: usize,
    /// The input has no more.
    at_end: bool,
    /// A line did not fit into the largest buffer.
    endless: bool,
    /// Nothing was consumed of the last block: it has to grow.
    stuck: bool,
}

/// Complete lines.
pub(super) struct Lines<'a> {
    /// The lines and, beyond `end`, what must not be looked at but may be loaded.
    pub(super) bytes: &'a [u8],
    /// Where the last complete line ends.
    pub(super) end: usize,
    /// Whether the input ends here.
    pub(super) last: bool,
}

impl<R: Read> Blocks<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input,
            buffer: vec![0; BLOCK + PADDING],
            filled: 0,
            at_end: false,
            endless: false,
            stuck: false,
        }
    }

    /// What was read so far and not consumed; reads the first block where nothing was.
    pub(super) fn peek(&mut self) -> io::Result<&[u8]> {
        self.fill()?;
        Ok(&self.buffer[..self.filled])
    }

    /// The complete lines that are at hand; `None` at the end of the input.
    pub(super) fn next_rows(&mut self) -> io::Result<Option<Lines<'_>>> {
        loop {
            if self.stuck && !self.grow() {
                return Ok(None);
            }
            self.fill()?;
            if self.filled == 0 {
                return Ok(None);
            }
            let end = if self.at_end {
                Some(self.filled)
            } else {
                memchr::memrchr(b'\n', &self.buffer[..self.filled]).map(|at| at + 1)
            };
            if let Some(end) = end {
                return Ok(Some(Lines {
                    bytes: &self.buffer,
                    end,
                    last: self.at_end,
                }));
            }
            self.stuck = true;
        }
    }

    /// The first bytes are done with.
    pub(super) fn consume(&mut self, used: usize) {
        self.stuck = used == 0;
        self.buffer.copy_within(used..self.filled, 0);
        self.filled -= used;
        self.clear_padding();
    }

    /// About how many rows the whole input has, judged by the lines that are at hand.
    pub(super) fn rows_to_expect(&self, bytes: Option<u64>) -> usize {
        /// Whatever the file says of its size, more than this is not reserved in advance.
        const MOST: u64 = 4 << 20;
        let sample = &self.buffer[..self.filled];
        let lines = memchr::memchr_iter(b'\n', sample).count().max(1) as u64;
        let bytes = bytes.unwrap_or(0).max(self.filled as u64);
        let rows = (u128::from(bytes) * u128::from(lines)) / (self.filled as u128).max(1);
        let rows = u64::try_from(rows).unwrap_or(MOST);
        // A little more than expected, so that the columns are not moved for the last few rows.
        usize::try_from((rows + rows / 64 + 16).min(MOST)).unwrap_or(0)
    }

    /// The line that did not fit, given the number of the line that was to come next.
    pub(super) fn endless_line(&self, next: u64) -> Option<u64> {
        self.endless.then_some(next)
    }

    /// Doubles the buffer; false when it is as large as it may be.
    fn grow(&mut self) -> bool {
        self.stuck = false;
        if self.buffer.len() > LONGEST_LINE {
            self.endless = true;
            return false;
        }
        self.buffer.resize(2 * self.buffer.len(), 0);
        true
    }

    fn fill(&mut self) -> io::Result<()> {
        // Two bytes are kept for the line feed that a last line may lack.
        let room = self.buffer.len() - PADDING - 1;
        while !self.at_end && self.filled < room {
            match self.input.read(&mut self.buffer[self.filled..room]) {
                Ok(0) => {
                    self.at_end = true;
                    if self.filled > 0 && self.buffer[self.filled - 1] != b'\n' {
                        self.buffer[self.filled] = b'\n';
                        self.filled += 1;
                    }
                }
                Ok(read) => self.filled += read,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        self.clear_padding();
        Ok(())
    }

    fn clear_padding(&mut self) {
        let end = (self.filled + PADDING).min(self.buffer.len());
        self.buffer[self.filled..end].fill(0);
    }
}
