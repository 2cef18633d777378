//! The container: records with lengths, some of them in compressed chunks.
//!
//! ```text
//! magic  (opcode u8, length u64, content)*  magic
//! ```
//!
//! The crate `mcap` reads the records. Only what brings messages is looked at (schemas, channels,
//! messages, the chunks around them); the index at the end is not needed, so that a recording whose
//! end was cut off gives everything before the cut. No record may be longer than the file.
//!
//! Chunks are unpacked here and not by the crate: its own decoders are C behind `unsafe`, which no
//! fuzzer of this repository would look into, and it would not say where a broken chunk starts.
//! Source: the MCAP specification, version 0.

use crate::document::number::quoted;
use crate::text::{Template, Text};
use std::collections::BTreeMap;
use std::io::Read;

use mcap::records::Record;
use mcap::records::op::{CHANNEL, CHUNK, MESSAGE, SCHEMA};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{MAGIC, McapError, parse_record};

/// Bytes of a record before its content: its opcode and its length.
const RECORD_HEAD: usize = 9;
/// A chunk that would become longer is refused: recorders write some megabytes.
const LONGEST_CHUNK: u64 = 1 << 28;

/// Bytes of a type's name.
const LONGEST_TYPE: usize = 1 << 10;

/// A topic of the recording.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
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
    pub(super) found: Text,
    pub(super) expected: Template,
    /// What stands before it is sound, as where a recording was cut off.
    pub(super) is_cut: bool,
}

impl Broken {
    fn new(byte: usize, found: impl Into<Text>, expected: Template) -> Self {
        Self {
            byte,
            found: found.into(),
            expected,
            is_cut: false,
        }
    }

    /// What the crate's reader refuses at a byte: where the end is missing, or a record is longer
    /// than everything that is there, the recording is cut off.
    fn refused(byte: usize, error: &McapError) -> Self {
        match error {
            McapError::UnexpectedEof | McapError::RecordTooLarge { .. } | McapError::BadMagic => {
                Self {
                    is_cut: true,
                    ..Self::new(byte, text!("the recording is cut off"), WHOLE)
                }
            }
            _ => Self::record(byte),
        }
    }

    fn record(byte: usize) -> Self {
        Self::new(byte, text!("a record that cannot be read"), WHOLE)
    }

    fn chunk(byte: usize, error: impl Into<Text>) -> Self {
        let found = text!(
            "a chunk that cannot be unpacked ({error})",
            error = error.into()
        );
        Self::new(byte, found, WHOLE)
    }
}

const WHOLE: Template = phrase!("a whole MCAP file");

/// Goes through a file once.
#[derive(Debug, Default)]
pub(super) struct Reader {
    /// Channels in the order in which they were announced.
    pub(super) channels: Vec<Channel>,
    /// Place in `channels` of each of them: a recording may announce as many as it has records.
    places: BTreeMap<Channel, usize>,
    /// Place in `channels` of a channel's number.
    numbers: BTreeMap<u16, usize>,
    schemas: BTreeMap<u16, String>,
}

/// Takes a record by its opcode, its content and where it starts; `false` stops the reading.
type EachRecord<'e> = dyn FnMut(u8, &[u8], usize) -> Result<bool, Broken> + 'e;

/// Hands every record from a byte on to `each`; whether all of them were wanted.
fn records(
    bytes: &[u8],
    from: usize,
    options: LinearReaderOptions,
    each: &mut EachRecord<'_>,
) -> Result<bool, Broken> {
    let options = options
        .with_skip_start_magic(true)
        .with_emit_chunks(true)
        .with_record_length_limit(bytes.len());
    let mut reader = LinearReader::new_with_options(options);
    let (mut rest, mut at) = (&bytes[from..], from);
    while let Some(event) = reader.next_event() {
        match event.map_err(|error| Broken::refused(at, &error))? {
            LinearReadEvent::ReadRequest(wanted) => {
                let (next, behind) = rest.split_at(wanted.min(rest.len()));
                reader.insert(next.len()).copy_from_slice(next);
                reader.notify_read(next.len());
                rest = behind;
            }
            LinearReadEvent::Record { opcode, data } => {
                if !each(opcode, data, at)? {
                    return Ok(false);
                }
                at += RECORD_HEAD + data.len();
            }
        }
    }
    Ok(true)
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
        if !bytes.starts_with(MAGIC) {
            let expected =
                phrase!("the bytes 89 4D 43 41 50 30 0D 0A, with which MCAP files start");
            return Err(Broken::new(0, text!("not an MCAP file"), expected));
        }
        let whole = LinearReaderOptions::default();
        let read = records(bytes, MAGIC.len(), whole, &mut |opcode, content, at| {
            let share = at as f64 / bytes.len() as f64;
            if opcode == CHUNK {
                self.chunk(content, at, share, each)
            } else {
                self.record(opcode, content, at, share, each)
            }
        });
        read.map(|_| ())
    }

    /// Hands the messages of a chunk on. A chunk within a chunk is passed over: none may be there.
    fn chunk(
        &mut self,
        content: &[u8],
        byte: usize,
        share: f64,
        each: &mut dyn FnMut(&[Channel], &Message<'_>, f64) -> bool,
    ) -> Result<bool, Broken> {
        let unpacked = unpacked(content, byte)?;
        let options = LinearReaderOptions::default().with_skip_end_magic(true);
        let read = records(&unpacked, 0, options, &mut |opcode, content, _| {
            self.record(opcode, content, byte, share, each)
        });
        // Where in the unpacked records says nothing about the file.
        read.map_err(|broken| Broken::chunk(byte, broken.found))
    }

    fn record(
        &mut self,
        opcode: u8,
        content: &[u8],
        byte: usize,
        share: f64,
        each: &mut dyn FnMut(&[Channel], &Message<'_>, f64) -> bool,
    ) -> Result<bool, Broken> {
        // What brings no messages is not even parsed.
        if !matches!(opcode, CHANNEL | MESSAGE | SCHEMA) {
            return Ok(true);
        }
        match parsed(opcode, content, byte)? {
            Record::Schema { header, .. } => {
                // Every channel has a copy of it.
                if header.name.len() > LONGEST_TYPE {
                    return Err(Broken::record(byte));
                }
                self.schemas.insert(header.id, header.name);
            }
            Record::Channel(channel) => self.channel(channel),
            Record::Message { header, data } => {
                let number = header.channel_id;
                let Some(&channel) = self.numbers.get(&number) else {
                    return Err(Broken::record(byte));
                };
                let message = Message {
                    channel,
                    log_time_ns: header.log_time,
                    data: &data,
                    byte,
                };
                return Ok(each(&self.channels, &message, share));
            }
            _ => {}
        }
        Ok(true)
    }

    fn channel(&mut self, announced: mcap::records::Channel) {
        let type_name = self.schemas.get(&announced.schema_id);
        let channel = Channel {
            topic: announced.topic,
            encoding: announced.message_encoding,
            type_name: type_name.cloned().unwrap_or_default(),
        };
        // The same channel may be announced in every chunk, and by several writers.
        let place = self.places.get(&channel).copied().unwrap_or_else(|| {
            let place = self.channels.len();
            self.places.insert(channel.clone(), place);
            self.channels.push(channel);
            place
        });
        self.numbers.insert(announced.id, place);
    }
}

fn parsed(opcode: u8, content: &[u8], byte: usize) -> Result<Record<'_>, Broken> {
    if !texts_fit(opcode, content) {
        return Err(Broken::record(byte));
    }
    parse_record(opcode, content).map_err(|error| Broken::refused(byte, &error))
}

/// Whether every text of a record is as long as it says: the crate takes memory for a text before it
/// looks, and four bytes can announce 4 GiB.
fn texts_fit(opcode: u8, content: &[u8]) -> bool {
    /// What stands behind a text that begins with its length.
    fn behind(rest: &[u8]) -> Option<&[u8]> {
        let (length, rest) = rest.split_first_chunk::<4>()?;
        rest.get(usize::try_from(u32::from_le_bytes(*length)).ok()?..)
    }
    // Where the first text stands, how many there are, and whether a map of texts follows.
    let (first, count, map) = match opcode {
        SCHEMA => (2, 2, false),
        CHANNEL => (4, 2, true),
        CHUNK => (28, 1, false),
        _ => return true,
    };
    let mut rest = content.get(first..);
    for _ in 0..count {
        rest = rest.and_then(behind);
    }
    match rest {
        None => false,
        Some(_) if !map => true,
        Some(rest) => {
            let Some(after) = behind(rest) else {
                return false;
            };
            let mut inside = Some(&rest[4..rest.len() - after.len()]);
            while let Some(texts) = inside.filter(|texts| !texts.is_empty()) {
                inside = behind(texts);
            }
            inside.is_some()
        }
    }
}

/// The records of a chunk, unpacked and held against their checksum.
fn unpacked(content: &[u8], byte: usize) -> Result<Vec<u8>, Broken> {
    let Record::Chunk { header, data } = parsed(CHUNK, content, byte)? else {
        return Ok(Vec::new());
    };
    let length = header.uncompressed_size;
    if length > LONGEST_CHUNK {
        return Err(Broken::chunk(
            byte,
            Text::verbatim(format!("{length} B > 256 MiB")),
        ));
    }
    let records = match header.compression.as_str() {
        "" => Ok(data.to_vec()),
        "lz4" => all_of(lz4_flex::frame::FrameDecoder::new(&*data), length),
        "zstd" => match ruzstd::decoding::StreamingDecoder::new(&*data) {
            Ok(decoder) => all_of(decoder, length),
            Err(error) => Err(error.to_string()),
        },
        other => Err(quoted(other)),
    };
    let records = records.map_err(|error| Broken::chunk(byte, Text::verbatim(error)))?;
    let checksum = header.uncompressed_crc;
    if records.len() as u64 != length || checksum != 0 && crc32fast::hash(&records) != checksum {
        return Err(Broken::chunk(
            byte,
            text!("its length or its checksum is another one"),
        ));
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
        chunk.extend(crc32fast::hash(&records).to_le_bytes());
        chunk.extend(text(""));
        chunk.extend((records.len() as u64).to_le_bytes());
        chunk.extend(&records);
        let footer = framed(2, &[0; 20]);
        [
            MAGIC,
            &framed(1, &[0; 8]),
            &framed(6, &chunk),
            &footer,
            MAGIC,
        ]
        .concat()
    }

    #[test]
    fn a_text_that_announces_more_than_its_record_holds_is_refused_before_memory_is_taken() {
        let long = u32::MAX.to_le_bytes();
        let whole = [&[7, 0, 1, 0][..], &text("/t"), &text("cdr")].concat();
        let map = |inside: &[u8]| {
            let length = u32::try_from(inside.len()).unwrap().to_le_bytes();
            [&whole[..], &length, inside].concat()
        };
        let pair = [text("key"), text("value")].concat();
        assert!(texts_fit(CHANNEL, &map(&pair)) && texts_fit(CHANNEL, &map(&[])));
        for (opcode, content) in [
            (SCHEMA, [&[1, 0][..], &long].concat()),
            (SCHEMA, [&[1, 0][..], &text("p/msg/T"), &long].concat()),
            (CHANNEL, [&whole[..], &long].concat()),
            (CHANNEL, map(&long)),
            (CHANNEL, map(&pair[..pair.len() - 1])),
            (CHUNK, [&[0; 28][..], &long, b"lz4"].concat()),
        ] {
            let refused = parsed(opcode, &content, 8).unwrap_err();
            assert_eq!(refused, Broken::record(8), "{opcode}");
        }
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
            broken.found.to_string().contains("checksum") && !broken.is_cut,
            "{broken:?}"
        );
        assert_eq!(broken.byte, 8 + 9 + 8, "where the chunk starts");
    }

    /// A file of these records, without a summary.
    fn of_records(records: &[&[u8]]) -> Vec<u8> {
        let end = [&framed(2, &[0; 20])[..], MAGIC].concat();
        [MAGIC, &records.concat(), &end].concat()
    }

    #[test]
    fn what_brings_no_messages_may_be_anything() {
        let whole = small();
        let chunk = &whole[8 + 9 + 8..whole.len() - 8 - 29];
        // Attachment, metadata, statistics and an opcode of a later version, all too short.
        for opcode in [9, 11, 12, 200] {
            let (seen, read) = messages(&of_records(&[&framed(opcode, b"x"), chunk]));
            assert_eq!((seen.len(), read), (1, Ok(())), "{opcode}");
        }
    }

    #[test]
    fn records_that_say_nothing_are_refused_with_their_byte() {
        let no_text = [&[1, 0, 1, 0, 0, 0, 255, 0, 0, 0, 0][..], &text("")].concat();
        for (schema, says) in [
            (&b"\x01"[..], "a record that cannot be read"),
            (&no_text, "a record that cannot be read"),
        ] {
            let broken = messages(&of_records(&[&framed(3, schema)])).1.unwrap_err();
            assert!(
                broken.found.to_string().contains(says) && broken.byte == 8 && !broken.is_cut,
                "{broken:?}"
            );
        }
    }

    #[test]
    fn a_chunk_within_a_chunk_is_passed_over() {
        let whole = small();
        let inner = &whole[8 + 9 + 8..whole.len() - 8 - 29];
        let mut outer = vec![0; 16];
        outer.extend((inner.len() as u64).to_le_bytes());
        outer.extend([0; 4]);
        outer.extend(text(""));
        outer.extend((inner.len() as u64).to_le_bytes());
        outer.extend(inner);
        let (seen, read) = messages(&of_records(&[&framed(6, &outer)]));
        assert_eq!((seen.len(), read), (0, Ok(())));
    }
}
