//! Lines of a stream, put down as a CSV file that grows by whole lines.
//!
//! An instrument or a controller sends a line of text for each measurement. Every line that is
//! complete goes to the file before the next bytes are waited for, so that a reader of the growing file
//! (the window is one) and one after a power cut find whole lines only. The file begins with headings:
//! the stream's own first line, or those that a person gives. Cells between semicolons, tabs or
//! spaces come out between commas, with a decimal point. [`source`] connects, [`record`] listens.

pub mod source;

use crate::tables::as_cell;
use crate::text::Text;
use std::io::{self, Write};

use crate::document::number::quoted;
use source::{Connection, Received};

/// A line is shorter, bytes.
const LONGEST_LINE: usize = 1 << 20;
/// So many lines that are left out are named; the others are counted.
const NAMED: u64 = 20;

/// Why a stream cannot be recorded.
#[derive(Debug)]
pub enum RecordError {
    /// The first line holds numbers, and their headings are not stated.
    NoHeadings {
        /// The first line.
        found: String,
    },
    /// The headings that were given are more or fewer than the cells.
    Width {
        /// Counted from 1.
        line: u64,
        /// Cells of the line.
        cells: usize,
        /// Headings that were given.
        headings: usize,
    },
    /// No line ends.
    LongLine {
        /// Counted from 1.
        line: u64,
    },
    /// The file cannot be written.
    Io(io::Error),
    /// The connection broke.
    Broken(io::Error),
}

impl RecordError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::NoHeadings { found } => text!(
                "line 1 of the stream: {found}: no headings; expected --columns with what each cell is, such as --columns time_s,x_mm,y_mm,z_mm",
                found
            ),
            Self::Width {
                line,
                cells,
                headings,
            } => text!(
                one "line {line} of the stream: {count} cell; expected {headings}, as many as --columns has", "line {line} of the stream: {count} cells; expected {headings}, as many as --columns has",
                line,
                count = cells,
                headings
            ),
            Self::LongLine { line } => text!(
                "line {line} of the stream: longer than a megabyte; expected lines of text",
                line
            ),
            Self::Io(error) => text!(
                "cannot write the recording: {error}",
                error = error.to_string()
            ),
            Self::Broken(_) => text!("the stream was interrupted"),
        }
    }
}

displays_what_it_says!(RecordError);

impl std::error::Error for RecordError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) | Self::Broken(error) => Some(error),
            _ => None,
        }
    }
}

impl From<io::Error> for RecordError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl RecordError {
    /// Whether the stream or the arguments are wrong (rather than the disk, say).
    pub fn is_refusal(&self) -> bool {
        !matches!(self, Self::Io(_) | Self::Broken(_))
    }
}

/// Puts the lines of a stream into a CSV file. `open` makes the file when the first line of it is known: a stream that brings
/// nothing leaves nothing.
pub struct Recorder<F, W> {
    open: Option<F>,
    out: Option<W>,
    /// Headings that a person gave; empty: the stream's own.
    own_headings: Vec<String>,
    form: Option<Form>,
    /// The start of a line that is not complete.
    pending: Vec<u8>,
    /// Lines of the stream so far.
    lines: u64,
    recorded: u64,
    /// Whether the headings are in the file.
    headed: bool,
    /// Bytes of the whole lines that are in the file.
    whole_bytes: u64,
    complaints: Vec<Text>,
    refused: u64,
}

/// What the lines of a stream are like.
struct Form {
    separator: Separator,
    headings: Vec<String>,
}

#[derive(Clone, Copy, PartialEq)]
enum Separator {
    Sign(char),
    Spaces,
}

impl Separator {
    fn of(line: &str) -> Self {
        let signs = [';', '\t', ',']
            .into_iter()
            .find(|sign| line.contains(*sign));
        signs.map_or(Self::Spaces, Self::Sign)
    }

    fn cells(self, line: &str) -> Vec<String> {
        let plain = |cell: &str| {
            let cell = cell.trim().trim_matches('"');
            match self {
                Self::Sign(',') => cell.to_owned(),
                _ => with_point(cell),
            }
        };
        match self {
            Self::Sign(sign) => line.split(sign).map(plain).collect(),
            Self::Spaces => line.split_whitespace().map(plain).collect(),
        }
    }
}

/// No datagram is longer, bytes.
const BLOCK: usize = 1 << 16;

/// Records from a connection until it ends or as many lines as are wanted are in the file; `hear` is told what was left
/// out, several times a second.
///
/// # Errors
/// [`RecordError`]; what was recorded before stays.
pub fn record<F: FnOnce() -> io::Result<W>, W: Write>(
    mut connection: Connection,
    recorder: &mut Recorder<F, W>,
    most: u64,
    hear: &mut dyn FnMut(Vec<Text>),
) -> Result<(), RecordError> {
    let mut bytes = vec![0; BLOCK];
    while recorder.recorded() < most {
        let came = connection.read(&mut bytes);
        match came {
            Ok(Received::Nothing) => {}
            Ok(Received::Bytes(count)) => recorder.take(&bytes[..count], most)?,
            Ok(Received::Message(count)) => {
                recorder.take(&bytes[..count], most)?;
                recorder.end_of_message(most)?;
            }
            Ok(Received::End) | Err(_) => {
                recorder.end_of_stream();
                return came.map(|_| ()).map_err(RecordError::Broken);
            }
        }
        hear(recorder.complaints());
    }
    Ok(())
}

/// A number with a decimal comma gets a point; anything else stays.
fn with_point(cell: &str) -> String {
    let with_point = cell.replacen(',', ".", 1);
    if cell.contains(',') && with_point.parse::<f64>().is_ok() {
        with_point
    } else {
        cell.to_owned()
    }
}

impl<F: FnOnce() -> io::Result<W>, W: Write> Recorder<F, W> {
    /// A recorder that has seen nothing yet. `headings`: what the cells are; empty: the first line
    /// of the stream says it.
    pub fn new(open: F, headings: Vec<String>) -> Self {
        Self {
            open: Some(open),
            out: None,
            own_headings: headings,
            form: None,
            pending: Vec::new(),
            lines: 0,
            recorded: 0,
            headed: false,
            whole_bytes: 0,
            complaints: Vec::new(),
            refused: 0,
        }
    }

    /// Lines that are in the file, without the headings.
    pub fn recorded(&self) -> u64 {
        self.recorded
    }

    /// Bytes of the whole lines that are in the file: where writing failed, what is behind them is the
    /// start of a line.
    pub fn whole_bytes(&self) -> u64 {
        self.whole_bytes
    }

    /// Lines that were left out.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// What was left out since the last call, in words: the first 20 lines of a recording; from then on
    /// they are only counted.
    pub fn complaints(&mut self) -> Vec<Text> {
        std::mem::take(&mut self.complaints)
    }

    /// What the recording is written to, once something is.
    pub fn out(&self) -> Option<&W> {
        self.out.as_ref()
    }

    /// Takes the next bytes of the stream; lines that they complete are in the file afterwards, but
    /// no more than `most` in all.
    ///
    /// # Errors
    /// [`RecordError`]; what was recorded before stays.
    pub fn take(&mut self, bytes: &[u8], most: u64) -> Result<(), RecordError> {
        let mut text = String::new();
        let mut rest = bytes;
        let mut taken = Ok(());
        // Lines that are to be in the file, once the text of them is written.
        let mut planned = self.recorded;
        while let Some(end) = memchr::memchr(b'\n', rest) {
            if planned >= most || taken.is_err() {
                break;
            }
            let own = &rest[..end];
            rest = &rest[end + 1..];
            self.pending.extend_from_slice(own);
            let line = std::mem::take(&mut self.pending);
            taken = self.line(&line, &mut text, &mut planned);
        }
        if planned < most && taken.is_ok() {
            self.pending.extend_from_slice(rest);
        }
        // What was sound before something wrong is put down too.
        self.write(&text)?;
        taken?;
        if self.pending.len() > LONGEST_LINE {
            let line = self.lines + 1;
            return Err(RecordError::LongLine { line });
        }
        Ok(())
    }

    /// A message is over: what it brought is a line, also without a line feed.
    ///
    /// # Errors
    /// As [`Self::take`].
    pub fn end_of_message(&mut self, most: u64) -> Result<(), RecordError> {
        if self.pending.is_empty() {
            return Ok(());
        }
        self.take(b"\n", most)
    }

    /// The stream is over. A line that has no end may have been cut anywhere: it is left out.
    pub fn end_of_stream(&mut self) {
        if !self.pending.trim_ascii().is_empty() {
            let cut = quoted(&String::from_utf8_lossy(&self.pending));
            self.leave_out(self.lines + 1, text!("{found}: no line end", found = cut));
        }
        self.pending.clear();
    }

    fn write(&mut self, text: &str) -> Result<(), RecordError> {
        if text.is_empty() {
            return Ok(());
        }
        if let Some(open) = self.open.take() {
            self.out = Some(open()?);
        }
        let Some(out) = &mut self.out else {
            return Ok(());
        };
        let mut rest = text.as_bytes();
        let mut failed = None;
        while !rest.is_empty() {
            match out.write(rest) {
                Ok(0) => failed = Some(io::ErrorKind::WriteZero.into()),
                Ok(count) => rest = &rest[count..],
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => failed = Some(error),
            }
            if failed.is_some() {
                break;
            }
        }
        let flushed = out.flush();
        // What is counted is in the file: a disk that is full takes the start of a line.
        let written = &text.as_bytes()[..text.len() - rest.len()];
        let whole = memchr::memrchr(b'\n', written).map_or(0, |end| end + 1);
        let mut lines = memchr::memchr_iter(b'\n', &written[..whole]).count() as u64;
        if !self.headed && lines > 0 {
            self.headed = true;
            lines -= 1;
        }
        self.recorded += lines;
        self.whole_bytes += whole as u64;
        match failed {
            Some(error) => Err(error.into()),
            None => Ok(flushed?),
        }
    }

    fn line(
        &mut self,
        bytes: &[u8],
        text: &mut String,
        planned: &mut u64,
    ) -> Result<(), RecordError> {
        self.lines += 1;
        let number = self.lines;
        let bytes = match number {
            1 => bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            _ => bytes,
        };
        let Ok(line) = std::str::from_utf8(bytes) else {
            self.leave_out(
                number,
                text!("bytes that are not {encoding}", encoding = "UTF-8"),
            );
            return Ok(());
        };
        let line = line.trim();
        if line.is_empty() {
            return Ok(());
        }
        let Some(form) = &self.form else {
            return self.first(line, text, planned);
        };
        let cells = form.separator.cells(line);
        if cells == form.headings {
            return Ok(());
        }
        if cells.len() != form.headings.len() {
            let found = other_width(cells.len(), form.headings.len());
            let says = text!("{found}: {name}", found, name = quoted(line));
            self.leave_out(number, says);
            return Ok(());
        }
        push_row(&cells, text);
        *planned += 1;
        Ok(())
    }

    /// The first line says what the lines are like.
    fn first(
        &mut self,
        line: &str,
        text: &mut String,
        planned: &mut u64,
    ) -> Result<(), RecordError> {
        let separator = Separator::of(line);
        let cells = separator.cells(line);
        let is_heading = !cells.iter().any(|cell| cell.parse::<f64>().is_ok());
        let headings = if self.own_headings.is_empty() {
            if !is_heading {
                let found = quoted(line);
                return Err(RecordError::NoHeadings { found });
            }
            cells.clone()
        } else {
            self.own_headings.clone()
        };
        if cells.len() != headings.len() {
            return Err(RecordError::Width {
                line: self.lines,
                cells: cells.len(),
                headings: headings.len(),
            });
        }
        push_row(&headings, text);
        self.form = Some(Form {
            separator,
            headings,
        });
        if !is_heading {
            push_row(&cells, text);
            *planned += 1;
        } else if !self.own_headings.is_empty() {
            self.leave_out(self.lines, text!("the stream's own headings"));
        }
        Ok(())
    }

    fn leave_out(&mut self, line: u64, because: Text) {
        let says = text!(
            "line {line} of the stream is excluded: {because}",
            line,
            because
        );
        self.refused += 1;
        if self.refused <= NAMED {
            self.complaints.push(says);
        }
    }
}

fn other_width(count: usize, headings: usize) -> Text {
    text!(one "{count} cell below {headings} headings", "{count} cells below {headings} headings", count, headings)
}

/// A row of a CSV file.
fn push_row(cells: &[String], text: &mut String) {
    for (index, cell) in cells.iter().enumerate() {
        if index > 0 {
            text.push(',');
        }
        *text += &as_cell(cell);
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records a stream that comes in pieces.
    fn recorded(pieces: &[&[u8]], headings: &[&str]) -> (String, Vec<String>, Option<RecordError>) {
        let headings = headings.iter().map(|&heading| heading.to_owned()).collect();
        let mut recorder = Recorder::new(|| Ok(Vec::new()), headings);
        let mut taken = pieces.iter().map(|piece| recorder.take(piece, u64::MAX));
        let wrong = taken.find_map(Result::err);
        recorder.end_of_stream();
        let complaints = recorder.complaints().iter().map(Text::to_string).collect();
        let text = recorder
            .out()
            .map_or("", |out| std::str::from_utf8(out).unwrap());
        (text.to_owned(), complaints, wrong)
    }

    #[test]
    fn lines_are_the_same_however_they_come() {
        let stream = b"x_mm;y_mm;name\r\n1,5;2;\"A\"\r\n\r\n-3;4,25;B, b\r\n";
        let wanted = "x_mm,y_mm,name\n1.5,2,A\n-3,4.25,\"B, b\"\n";
        for length in 1..stream.len() {
            let pieces: Vec<&[u8]> = stream.chunks(length).collect();
            let (text, complaints, wrong) = recorded(&pieces, &[]);
            assert!(complaints.is_empty() && wrong.is_none(), "{complaints:?}");
            assert_eq!(text, wanted, "{length}");
        }
    }

    #[test]
    fn what_is_no_measurement_is_left_out_aloud() {
        let stream = b"1 2 3\n4 5\n\xff 1 2\n6 7 8\n9 10 1";
        let (text, complaints, wrong) = recorded(&[stream], &["time_s", "x_mm", "y_mm"]);
        assert_eq!(text, "time_s,x_mm,y_mm\n1,2,3\n6,7,8\n");
        assert!(wrong.is_none());
        let says = complaints.join("\n");
        for part in [
            "line 2 of the stream is excluded: 2 cells below 3 headings",
            "line 3 of the stream is excluded: bytes that are not UTF-8",
            "line 5 of the stream is excluded: ",
        ] {
            assert!(says.contains(part), "{says}");
        }
    }

    #[test]
    fn a_stream_without_headings_is_refused_before_there_is_a_file() {
        let (text, _, wrong) = recorded(&[b"1,2,3\n"], &[]);
        assert!(text.is_empty() && matches!(wrong, Some(RecordError::NoHeadings { .. })));
        let (text, _, wrong) = recorded(&[b"1,2,3\n"], &["x_mm", "y_mm"]);
        assert!(text.is_empty());
        assert!(matches!(
            wrong,
            Some(RecordError::Width {
                line: 1,
                cells: 3,
                headings: 2
            })
        ));
        let endless = vec![b'1'; LONGEST_LINE + 1];
        let (_, _, wrong) = recorded(&[&endless], &[]);
        assert!(matches!(wrong, Some(RecordError::LongLine { line: 1 })));
    }

    #[test]
    fn what_is_counted_is_in_the_file() {
        /// A disk with room for so many bytes.
        struct Disk(Vec<u8>, usize);
        impl Write for Disk {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                let room = (self.1 - self.0.len()).min(bytes.len());
                if room == 0 {
                    return Err(io::ErrorKind::StorageFull.into());
                }
                self.0.extend_from_slice(&bytes[..room]);
                Ok(room)
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let mut stream = "x_mm,y_mm\n".to_owned();
        for k in 0..50 {
            stream += &format!("{k},1\n");
        }
        for room in 0..stream.len() {
            let mut recorder = Recorder::new(|| Ok(Disk(Vec::new(), room)), Vec::new());
            let pieces = stream.as_bytes().chunks(40);
            let failed = pieces
                .map(|piece| recorder.take(piece, u64::MAX))
                .find_map(Result::err);
            assert!(matches!(failed, Some(RecordError::Io(_))), "{room}");
            let held = &recorder.out().unwrap().0;
            let whole = memchr::memrchr(b'\n', held).map_or(0, |end| end + 1);
            let lines = memchr::memchr_iter(b'\n', held).count() as u64;
            assert_eq!(recorder.recorded(), lines.saturating_sub(1), "{room}");
            assert_eq!(recorder.whole_bytes(), whole as u64, "{room}");
        }
    }

    #[test]
    fn rubbish_is_counted_and_not_repeated() {
        let rubbish = format!("x,y\n{}1,2\n", "what is this\n".repeat(100_000));
        let mut recorder = Recorder::new(|| Ok(Vec::new()), Vec::new());
        let mut said = 0;
        for piece in rubbish.as_bytes().chunks(4096) {
            recorder.take(piece, u64::MAX).unwrap();
            said += recorder.complaints().len();
        }
        assert_eq!(
            (recorder.recorded(), recorder.refused(), said),
            (1, 100_000, 20)
        );
    }

    #[test]
    fn it_stops_after_as_many_lines_as_are_wanted() {
        let mut recorder = Recorder::new(|| Ok(Vec::new()), Vec::new());
        recorder.take(b"x\n1\n2\n3\n", 2).unwrap();
        assert_eq!(recorder.recorded(), 2);
        assert_eq!(recorder.out().unwrap(), b"x\n1\n2\n");
    }
}
