//! The container: records with lengths, some of them in compressed chunks.
//!
//! ```text
//! magic  (opcode u8, length u64, content)*  magic
//! ```
//!
//! Numbers are little-endian. Only what brings messages is read (schemas, channels, messages, the
//! chunks around them); the index at the end is not needed, so that a recording whose end was cut
//! off gives everything before the cut. No length is believed before it was held against what is
//! there. Source: the MCAP specification, version 0.

use std::collections::BTreeMap;
use std::io::Read;

/// With which every file starts and ends.
pub(super) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
/// A chunk that would become longer is refused: recorders write some megabytes.
const LONGEST_CHUNK: u64 = 1 << 28;

/// A topic of the recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Channel {
    pub(super) topic: String,
    /// How its messages are encoded, such as `cdr`.
    pub(super) encoding: String,
    /// The type of its messages, such as `sensor_msgs/msg/JointState`; empty without a schema.
    pub(super) type_name: String,
}

/// A message of a topic.
pub(super) struct Message<'a> {
    /// Which channel, by its place in [`Reader::channels`].
    pub(super) channel: usize,
    /// When it was recorded, ns.
    pub(super) log_time_ns: u64,
    pub(super) data: &'a [u8],
    /// Where its record or its chunk starts in the file.
    pub(super) byte: usize,
}

/// What is wrong with a file, and at which byte.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Broken {
    pub(super) byte: usize,
    pub(super) found: String,
    pub(super) expected: &'static str,
    /// What stands before it is sound, as where a recording was cut off.
    pub(super) is_cut: bool,
}

impl Broken {
    fn new(byte: usize, found: impl Into<String>, expected: &'static str) -> Self {
        Self {
            byte,
            found: found.into(),
            expected,
            is_cut: false,
        }
    }

    fn cut(byte: usize) -> Self {
        Self {
            is_cut: true,
            ..Self::new(byte, "the recording is cut off", "a whole MCAP file")
        }
    }
}

/// Goes through a file once.
#[derive(Debug, Default)]
pub(super) struct Reader {
    /// Channels in the order in which they were announced.
    pub(super) channels: Vec<Channel>,
    /// Place in `channels` of a channel's number.
    numbers: BTreeMap<u16, usize>,
    schemas: BTreeMap<u16, String>,
}

/// Fields of a record, one after the other.
struct Fields<'a> {
    rest: &'a [u8],
    /// Where the record starts in the file.
    byte: usize,
}

impl<'a> Fields<'a> {
    fn take(&mut self, length: usize) -> Result<&'a [u8], Broken> {
        match self.rest.split_at_checked(length) {
            Some((head, rest)) => {
                self.rest = rest;
                Ok(head)
            }
            None => Err(Broken::new(
                self.byte,
                "a record that is shorter than its fields",
                "records as the MCAP specification has them",
            )),
        }
    }

    fn number<const N: usize>(&mut self) -> Result<u64, Broken> {
        let mut bytes = [0; 8];
        bytes[..N].copy_from_slice(self.take(N)?);
        Ok(u64::from_le_bytes(bytes))
    }

    fn short(&mut self) -> Result<u16, Broken> {
        let bytes = self.take(2)?;
        Ok(u16::from_le_bytes([bytes[0], bytes[1]]))
    }

    fn text(&mut self) -> Result<String, Broken> {
        let length = usize::try_from(self.number::<4>()?).unwrap_or(usize::MAX);
        let bytes = self.take(length)?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }
}

/// The record at a place: opcode, content, and where the next one starts.
fn record(bytes: &[u8], at: usize) -> Option<(u8, &[u8], usize)> {
    let head = bytes.get(at..at.checked_add(9)?)?;
    let mut length = [0; 8];
    length.copy_from_slice(&head[1..]);
    let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
    let end = at.checked_add(9)?.checked_add(length)?;
    Some((head[0], bytes.get(at + 9..end)?, end))
}

impl Reader {
    /// Hands every message to `each`, in the order of the file; `each` may stop the reading by
    /// `false`, and hears which share of the file is read.
    ///
    /// # Errors
    /// [`Broken`]; what stands before the place was handed on.
    pub(super) fn read(
        &mut self,
        bytes: &[u8],
        each: &mut dyn FnMut(&[Channel], &Message<'_>, f64) -> bool,
    ) -> Result<(), Broken> {
        if !bytes.starts_with(&MAGIC) {
            let expected = "the bytes 89 4D 43 41 50 30 0D 0A, with which MCAP files start";
            return Err(Broken::new(0, "no MCAP file", expected));
        }
        let mut at = MAGIC.len();
        loop {
            let Some((opcode, content, next)) = record(bytes, at) else {
                return Err(Broken::cut(at));
            };
            let share = at as f64 / bytes.len() as f64;
            match opcode {
                // The footer: nothing but the magic bytes follows.
                2 if bytes[next..] == MAGIC => return Ok(()),
                2 => return Err(Broken::cut(next)),
                6 => {
                    let records = chunk(content, at)?;
                    if !self.chunk_records(&records, at, share, each)? {
                        return Ok(());
                    }
                }
                _ => {
                    if !self.record(opcode, content, at, share, each)? {
                        return Ok(());
                    }
                }
            }
            at = next;
        }
    }

    fn chunk_records(
        &mut self,
        records: &[u8],
        byte: usize,
        share: f64,
        each: &mut dyn FnMut(&[Channel], &Message<'_>, f64) -> bool,
    ) -> Result<bool, Broken> {
        let mut at = 0;
        while at < records.len() {
            let Some((opcode, content, next)) = record(records, at) else {
                let found = "a chunk that ends within a record";
                return Err(Broken::new(byte, found, "whole records in every chunk"));
            };
            if !self.record(opcode, content, byte, share, each)? {
                return Ok(false);
            }
            at = next;
        }
        Ok(true)
    }

    fn record(
        &mut self,
        opcode: u8,
        content: &[u8],
        byte: usize,
        share: f64,
        each: &mut dyn FnMut(&[Channel], &Message<'_>, f64) -> bool,
    ) -> Result<bool, Broken> {
        let mut fields = Fields {
            rest: content,
            byte,
        };
        match opcode {
            3 => {
                let number = fields.short()?;
                self.schemas.insert(number, fields.text()?);
            }
            4 => self.channel(&mut fields)?,
            5 => {
                let number = fields.short()?;
                let Some(&channel) = self.numbers.get(&number) else {
                    let found = format!("a message of channel {number}, which nothing announces");
                    return Err(Broken::new(byte, found, "a channel before its messages"));
                };
                fields.number::<4>()?;
                let log_time_ns = fields.number::<8>()?;
                fields.number::<8>()?;
                let message = Message {
                    channel,
                    log_time_ns,
                    data: fields.rest,
                    byte,
                };
                return Ok(each(&self.channels, &message, share));
            }
            _ => {}
        }
        Ok(true)
    }

    fn channel(&mut self, fields: &mut Fields<'_>) -> Result<(), Broken> {
        let (number, schema) = (fields.short()?, fields.short()?);
        let (topic, encoding) = (fields.text()?, fields.text()?);
        let type_name = self.schemas.get(&schema).cloned().unwrap_or_default();
        let channel = Channel {
            topic,
            encoding,
            type_name,
        };
        // The same channel may be announced in every chunk, and by several writers.
        let known = self.channels.iter().position(|other| *other == channel);
        let place = known.unwrap_or_else(|| {
            self.channels.push(channel);
            self.channels.len() - 1
        });
        self.numbers.insert(number, place);
        Ok(())
    }
}

/// The records of a chunk, unpacked and held against their checksum.
fn chunk(content: &[u8], byte: usize) -> Result<Vec<u8>, Broken> {
    let mut fields = Fields {
        rest: content,
        byte,
    };
    fields.take(16)?;
    let length = fields.number::<8>()?;
    let checksum = fields.number::<4>()?;
    let compression = fields.text()?;
    let packed_length = usize::try_from(fields.number::<8>()?).unwrap_or(usize::MAX);
    let packed = fields.take(packed_length)?;
    if length > LONGEST_CHUNK {
        let found = format!("a chunk of {length} bytes");
        return Err(Broken::new(byte, found, "chunks of at most 256 MiB"));
    }
    let records = match compression.as_str() {
        "" => Ok(packed.to_vec()),
        "lz4" => all_of(lz4_flex::frame::FrameDecoder::new(packed), length),
        "zstd" => match ruzstd::decoding::StreamingDecoder::new(packed) {
            Ok(decoder) => all_of(decoder, length),
            Err(error) => Err(error.to_string()),
        },
        other => {
            let found = format!("a chunk with the compression '{other}'");
            return Err(Broken::new(byte, found, "none, lz4 or zstd"));
        }
    };
    let records = records.map_err(|error| {
        let found = format!("a chunk that cannot be unpacked ({error})");
        Broken::new(byte, found, "a chunk as it was recorded")
    })?;
    if records.len() as u64 != length {
        let found = format!("a chunk of {} bytes that says {length}", records.len());
        return Err(Broken::new(byte, found, "a chunk as it was recorded"));
    }
    if checksum != 0 && u64::from(crc32(&records)) != checksum {
        let found = "a chunk whose checksum does not agree";
        return Err(Broken::new(byte, found, "a chunk as it was recorded"));
    }
    Ok(records)
}

/// Everything that comes out, but no more than a byte above the length that was announced.
fn all_of(decoder: impl Read, length: u64) -> Result<Vec<u8>, String> {
    let mut unpacked = Vec::new();
    match decoder.take(length + 1).read_to_end(&mut unpacked) {
        Ok(_) => Ok(unpacked),
        Err(error) => Err(error.to_string()),
    }
}

/// CRC-32 as in zlib: polynomial EDB88320, reflected.
fn crc32(bytes: &[u8]) -> u32 {
    const fn entry(mut value: u32) -> u32 {
        let mut bit = 0;
        while bit < 8 {
            value = (value >> 1) ^ (0xedb8_8320 * (value & 1));
            bit += 1;
        }
        value
    }
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let (mut place, mut value) = (0, 0);
        while place < table.len() {
            table[place] = entry(value);
            (place, value) = (place + 1, value + 1);
        }
        table
    };
    !bytes.iter().fold(!0, |sum: u32, byte| {
        (sum >> 8) ^ TABLE[usize::from(sum.to_le_bytes()[0] ^ byte)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn framed(opcode: u8, content: &[u8]) -> Vec<u8> {
        let length = (content.len() as u64).to_le_bytes();
        [&[opcode], &length[..], content].concat()
    }

    fn text(text: &str) -> Vec<u8> {
        let length = u32::try_from(text.len()).unwrap().to_le_bytes();
        [&length[..], text.as_bytes()].concat()
    }

    fn small() -> Vec<u8> {
        let schema = [&[1, 0][..], &text("p/msg/T"), &text("ros2msg"), &text("")].concat();
        let channel = [&[7, 0, 1, 0][..], &text("/t"), &text("cdr"), &text("")].concat();
        let mut message = vec![7, 0, 0, 0, 0, 0];
        message.extend(5_u64.to_le_bytes());
        message.extend(6_u64.to_le_bytes());
        message.extend(b"data");
        let records = [framed(3, &schema), framed(4, &channel), framed(5, &message)].concat();
        let mut chunk = vec![0; 16];
        chunk.extend((records.len() as u64).to_le_bytes());
        chunk.extend(crc32(&records).to_le_bytes());
        chunk.extend(text(""));
        chunk.extend((records.len() as u64).to_le_bytes());
        chunk.extend(&records);
        let footer = framed(2, &[0; 20]);
        [
            &MAGIC[..],
            &framed(1, &[0; 8]),
            &framed(6, &chunk),
            &footer,
            &MAGIC,
        ]
        .concat()
    }

    fn messages(bytes: &[u8]) -> (Vec<String>, Result<(), Broken>) {
        let mut seen = Vec::new();
        let read = Reader::default().read(bytes, &mut |channels, message, _| {
            let Channel {
                topic, type_name, ..
            } = &channels[message.channel];
            let data = String::from_utf8_lossy(message.data);
            seen.push(format!(
                "{topic} {type_name} {} {data}",
                message.log_time_ns
            ));
            true
        });
        (seen, read)
    }

    #[test]
    fn the_checksum_is_that_of_zlib() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn a_message_in_a_chunk_is_read() {
        let (seen, read) = messages(&small());
        assert_eq!((seen, read), (vec!["/t p/msg/T 5 data".to_owned()], Ok(())));
    }

    #[test]
    fn a_cut_file_says_so_and_gives_what_it_has() {
        let whole = small();
        let (seen, read) = messages(&whole[..whole.len() - 12]);
        assert_eq!(seen.len(), 1);
        assert!(read.unwrap_err().is_cut);
        for length in 0..whole.len() {
            assert!(messages(&whole[..length]).1.is_err(), "{length}");
        }
    }

    #[test]
    fn a_changed_byte_in_a_chunk_is_noticed() {
        let mut bytes = small();
        let at = bytes.windows(4).position(|four| four == b"data").unwrap();
        bytes[at] ^= 1;
        let broken = messages(&bytes).1.unwrap_err();
        assert!(
            broken.found.contains("checksum") && !broken.is_cut,
            "{broken:?}"
        );
        assert_eq!(broken.byte, 8 + 9 + 8, "where the chunk starts");
    }
}
