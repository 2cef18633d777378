//! The Common Data Representation, in which ROS 2 writes its messages (OMG DDS-XTypes 1.3, 7.4).
//!
//! Four bytes say the byte order and the version; every number is aligned to its size, counted from
//! behind them (in version 2 to four bytes at most). Strings carry their length and a zero at the
//! end, sequences their count.

use crate::text::Text;

/// What is wrong, in words.
pub(super) type Wrong = Text;

/// What is said of a message that is not as its type has it.
pub(super) fn not_whole() -> Wrong {
    text!("fields that are not those of its type")
}

/// Fields one after the other, none beyond the end.
#[derive(Debug, Clone)]
pub(super) struct Cdr<'a> {
    body: &'a [u8],
    at: usize,
    is_little: bool,
    /// Largest alignment, bytes.
    largest: usize,
}

impl<'a> Cdr<'a> {
    /// Reads the four bytes at the start.
    pub(super) fn new(data: &'a [u8]) -> Result<Self, Wrong> {
        let Some((head, body)) = data.split_at_checked(4) else {
            return Err(not_whole());
        };
        let (is_little, largest) = match (head[0], head[1]) {
            (0, 0) => (false, 8),
            (0, 1) => (true, 8),
            (0, 6) => (false, 4),
            (0, 7) => (true, 4),
            _ => return Err(not_whole()),
        };
        Ok(Self {
            body,
            at: 0,
            is_little,
            largest,
        })
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], Wrong> {
        let end = self.at.checked_add(length);
        let bytes = end.and_then(|end| self.body.get(self.at..end));
        let bytes = bytes.ok_or_else(not_whole)?;
        self.at += length;
        Ok(bytes)
    }

    fn number<const N: usize>(&mut self) -> Result<[u8; N], Wrong> {
        self.at = self.at.next_multiple_of(N.min(self.largest));
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N)?);
        if !self.is_little {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// An unsigned number of 32 bits.
    pub(super) fn u32(&mut self) -> Result<u32, Wrong> {
        self.number().map(u32::from_le_bytes)
    }

    /// A number of 32 bits.
    pub(super) fn i32(&mut self) -> Result<i32, Wrong> {
        self.number().map(i32::from_le_bytes)
    }

    /// A floating-point number of 64 bits.
    pub(super) fn f64(&mut self) -> Result<f64, Wrong> {
        self.number().map(f64::from_le_bytes)
    }

    /// How many elements of at least so many bytes follow.
    pub(super) fn count(&mut self, smallest: usize) -> Result<usize, Wrong> {
        let count = self.u32()? as usize;
        let left = self.body.len() - self.at.min(self.body.len());
        if count > left / smallest {
            return Err(not_whole());
        }
        Ok(count)
    }

    /// A text, without the zero at its end.
    pub(super) fn text(&mut self) -> Result<String, Wrong> {
        let length = self.count(1)?;
        let bytes = self.take(length)?;
        let bytes = bytes.strip_suffix(b"\0").unwrap_or(bytes);
        let text = std::str::from_utf8(bytes).map_err(|_| not_whole())?;
        Ok(text.to_owned())
    }

    /// A sequence of numbers.
    pub(super) fn numbers(&mut self) -> Result<Vec<f64>, Wrong> {
        let count = self.count(8)?;
        (0..count).map(|_| self.f64()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders_and_alignments_give_the_same() {
        // The number stands at the next multiple of 8, of the second version at the next of 4.
        let little = b"\0\x01\0\0\x04\0\0\0arm\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\xf8\x3f";
        let big = b"\0\0\0\0\0\0\0\x04arm\0\0\0\0\x01\0\0\0\0\x3f\xf8\0\0\0\0\0\0";
        let second = b"\0\x07\0\0\x04\0\0\0arm\0\x01\0\0\0\0\0\0\0\0\0\xf8\x3f";
        for bytes in [&little[..], &big[..], &second[..]] {
            let mut cdr = Cdr::new(bytes).unwrap();
            assert_eq!(cdr.text().unwrap(), "arm");
            assert_eq!(cdr.numbers().unwrap(), [1.5], "{bytes:?}");
            assert!(cdr.f64().is_err(), "beyond the end");
        }
    }

    #[test]
    fn counts_are_not_believed() {
        let mut cdr = Cdr::new(b"\0\x01\0\0\xff\xff\xff\xff").unwrap();
        assert!(cdr.clone().text().is_err());
        assert!(cdr.numbers().unwrap_err().contains("fields that are not"));
        assert!(Cdr::new(b"\0\x03\0\0").is_err());
        assert!(Cdr::new(b"\0").is_err());
    }
}
