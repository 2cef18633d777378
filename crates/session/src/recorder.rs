//! Lines of a stream, put down as a CSV file that grows by whole lines.
//!
//! An instrument or a controller sends a line of text for each measurement. Every line that is
//! complete goes to the file before the next bytes are waited for, so that a reader of the growing file
//! and one after a power cut find whole lines only. The file begins with headings: the stream's own first
//! line, or those that a person gives. Cells between semicolons, tabs or spaces come out between commas,
//! with a decimal point. [`source`] connects, [`record`] listens.

pub mod source;

use crate::tables::as_cell;
use crate::text::Text;
use std::io::{self, BufRead, Read};

use crate::document::number::quoted;

/// A line is shorter than this.
const LONGEST_LINE: usize = 1 << 20;

/// Lines that are left out and named; the others are counted.
const NAMED: u64 = 20;

/// Why recording ended.
#[derive(Debug)]
pub enum RecordError {
    /// The stream is no table.
    Refused(Text),
    /// The recording cannot be written.
    Io(io::Error),
    /// The connection was lost.
    Broken(io::Error),
}

impl RecordError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::Refused(says) => says.clone(),
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
            Self::Refused(_) => None,
        }
    }
}

/// Puts text at the end of the recording.
pub type Put<'p> = &'p mut dyn FnMut(&str) -> io::Result<()>;

/// What was recorded so far.
#[derive(Debug, Default)]
pub struct Recorder {
    /// Those that a person gave, then those of the file.
    headings: Vec<String>,
    /// What stands between cells, once a line has shown it.
    separator: Option<Separator>,
    /// Lines that have come.
    lines: u64,
    /// Lines of measurements in the file.
    pub recorded: u64,
    /// Lines that were left out.
    pub refused: u64,
    /// Bytes in the file, up to the end of its last whole line.
    pub whole_bytes: u64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Separator {
    Sign(char),
    Spaces,
}

impl Separator {
    fn of(line: &str) -> Self {
        let signs = [';', '\t', ','].into_iter();
        let mut signs = signs.filter(|sign| line.contains(*sign));
        signs.next().map_or(Self::Spaces, Self::Sign)
    }

    fn cells(self, line: &str) -> Vec<String> {
        let plain = |cell: &str| {
            let cell = cell.trim().trim_matches('"');
            let with_point = cell.replacen(',', ".", 1);
            if self != Self::Sign(',') && with_point.parse::<f64>().is_ok() {
                with_point
            } else {
                cell.to_owned()
            }
        };
        match self {
            Self::Sign(sign) => line.split(sign).map(plain).collect(),
            Self::Spaces => line.split_whitespace().map(plain).collect(),
        }
    }
}

/// Records what comes until the stream ends, or so many lines are in the file. `hear` hears of lines that are left out.
///
/// # Errors
/// [`RecordError`]; what was sound before it is in the file.
pub fn record(
    stream: &mut dyn BufRead,
    recorder: &mut Recorder,
    most: u64,
    put: Put<'_>,
    hear: &mut dyn FnMut(Text),
) -> Result<(), RecordError> {
    let mut line = Vec::new();
    while recorder.recorded < most {
        line.clear();
        let mut limited = stream.take(LONGEST_LINE as u64 + 1);
        let came = limited.read_until(b'\n', &mut line);
        if line.pop_if(|last| *last == b'\n').is_some() {
            recorder.line(&line, put)?.into_iter().for_each(&mut *hear);
            continue;
        }
        if line.len() > LONGEST_LINE {
            return Err(RecordError::Refused(text!(
                "line {line} of the stream: longer than a megabyte; expected lines of text",
                line = recorder.lines + 1
            )));
        }
        if !line.trim_ascii().is_empty() {
            recorder.lines += 1;
            let cut = quoted(&String::from_utf8_lossy(&line));
            let says = recorder.left_out(text!("{found}: no line end", found = cut));
            says.into_iter().for_each(hear);
        }
        return came.map(|_| ()).map_err(RecordError::Broken);
    }
    Ok(())
}

impl Recorder {
    /// A recorder of a table with these headings; none: those of the stream.
    pub fn new(headings: Vec<String>) -> Self {
        Self {
            headings,
            ..Self::default()
        }
    }

    /// Takes a line without its end; what there is to say where it is left out.
    fn line(&mut self, bytes: &[u8], put: Put<'_>) -> Result<Option<Text>, RecordError> {
        self.lines += 1;
        let bytes = match self.lines {
            1 => bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            _ => bytes,
        };
        let Ok(line) = std::str::from_utf8(bytes) else {
            let because = text!("bytes that are not {encoding}", encoding = "UTF-8");
            return Ok(self.left_out(because));
        };
        let line = line.trim();
        if line.is_empty() {
            return Ok(None);
        }
        let Some(separator) = self.separator else {
            return self.first(line, put);
        };
        let cells = separator.cells(line);
        if cells.len() != self.headings.len() {
            let found = text!(
                one "{count} cell below {headings} headings",
                "{count} cells below {headings} headings",
                count = cells.len(),
                headings = self.headings.len()
            );
            let says = text!("{found}: {name}", found, name = quoted(line));
            return Ok(self.left_out(says));
        }
        // Headings that come again.
        if cells != self.headings {
            self.put(&cells, put)?;
            self.recorded += 1;
        }
        Ok(None)
    }

    /// The first line tells what stands between cells, and may be the headings.
    fn first(&mut self, line: &str, put: Put<'_>) -> Result<Option<Text>, RecordError> {
        let separator = Separator::of(line);
        let cells = separator.cells(line);
        let is_heading = !cells.iter().any(|cell| cell.parse::<f64>().is_ok());
        let own = !self.headings.is_empty();
        if !own && !is_heading {
            return Err(RecordError::Refused(text!(
                "line 1 of the stream: {found}: no headings; expected --columns with what each cell is, such as --columns time_s,x_mm,y_mm,z_mm",
                found = quoted(line)
            )));
        }
        if own && cells.len() != self.headings.len() {
            return Err(RecordError::Refused(text!(
                one "line {line} of the stream: {count} cell; expected {headings}, as many as --columns has",
                "line {line} of the stream: {count} cells; expected {headings}, as many as --columns has",
                line = self.lines,
                count = cells.len(),
                headings = self.headings.len()
            )));
        }
        if !own {
            self.headings.clone_from(&cells);
        }
        self.put(&self.headings.clone(), put)?;
        self.separator = Some(separator);
        if !is_heading {
            self.put(&cells, put)?;
            self.recorded += 1;
        } else if own {
            return Ok(self.left_out(text!("the stream's own headings")));
        }
        Ok(None)
    }

    /// Puts a row down.
    fn put(&mut self, cells: &[String], put: Put<'_>) -> Result<(), RecordError> {
        let cells: Vec<_> = cells.iter().map(|cell| as_cell(cell)).collect();
        let row = cells.join(",") + "\n";
        put(&row).map_err(RecordError::Io)?;
        self.whole_bytes += row.len() as u64;
        Ok(())
    }

    fn left_out(&mut self, because: Text) -> Option<Text> {
        self.refused += 1;
        (self.refused <= NAMED).then(|| {
            text!(
                "line {line} of the stream is excluded: {because}",
                line = self.lines,
                because
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records a stream that comes in pieces.
    fn recorded(pieces: &[&[u8]], headings: &[&str]) -> (String, Vec<String>, Option<RecordError>) {
        let headings = headings.iter().map(|&heading| heading.to_owned()).collect();
        let mut recorder = Recorder::new(headings);
        let (text, complaints, wrong) = heard(pieces, &mut recorder, u64::MAX);
        assert_eq!(recorder.whole_bytes, text.len() as u64);
        (text, complaints, wrong)
    }

    fn heard(
        pieces: &[&[u8]],
        recorder: &mut Recorder,
        most: u64,
    ) -> (String, Vec<String>, Option<RecordError>) {
        let (mut text, mut complaints) = (String::new(), Vec::new());
        let mut put = |row: &str| {
            text.push_str(row);
            Ok(())
        };
        let mut hear = |says: Text| complaints.push(says.to_string());
        let mut stream = io::BufReader::new(Pieces(pieces));
        let wrong = record(&mut stream, recorder, most, &mut put, &mut hear).err();
        (text, complaints, wrong)
    }

    struct Pieces<'p>(&'p [&'p [u8]]);

    impl Read for Pieces<'_> {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            let Some((first, rest)) = self.0.split_first() else {
                return Ok(0);
            };
            self.0 = rest;
            bytes[..first.len()].copy_from_slice(first);
            Ok(first.len())
        }
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
        let endless = vec![b'1'; LONGEST_LINE + 1];
        let endless: Vec<&[u8]> = endless.chunks(4096).collect();
        for (stream, headings, says) in [
            (&[b"1,2,3\n" as &[u8]][..], &[][..], "no headings"),
            (
                &[b"1,2,3\n"],
                &["x_mm", "y_mm"],
                "line 1 of the stream: 3 cells; expected 2",
            ),
            (&endless, &[], "line 1 of the stream: longer"),
        ] {
            let (text, _, wrong) = recorded(stream, headings);
            assert!(text.is_empty());
            let Some(RecordError::Refused(wrong)) = wrong else {
                panic!("{wrong:?}");
            };
            assert!(wrong.to_string().contains(says), "{wrong}");
        }
    }

    #[test]
    fn what_is_counted_is_in_the_file() {
        let mut stream = "x_mm,y_mm\n".to_owned();
        for k in 0..50 {
            stream += &format!("{k},1\n");
        }
        // A disk with room for so many bytes.
        for room in 0..stream.len() {
            let mut disk = Vec::new();
            let mut put = |row: &str| {
                let fits = (room - disk.len()).min(row.len());
                disk.extend_from_slice(&row.as_bytes()[..fits]);
                if fits < row.len() {
                    return Err(io::ErrorKind::StorageFull.into());
                }
                Ok(())
            };
            let mut recorder = Recorder::default();
            let mut all = stream.as_bytes();
            let failed = record(&mut all, &mut recorder, u64::MAX, &mut put, &mut |_| {});
            assert!(matches!(failed, Err(RecordError::Io(_))), "{room}");
            let whole = memchr::memrchr(b'\n', &disk).map_or(0, |end| end + 1);
            let lines = memchr::memchr_iter(b'\n', &disk).count() as u64;
            assert_eq!(recorder.recorded, lines.saturating_sub(1), "{room}");
            assert_eq!(recorder.whole_bytes, whole as u64, "{room}");
        }
    }

    #[test]
    fn rubbish_is_counted_and_not_repeated() {
        let rubbish = format!("x,y\n{}1,2\n", "what is this\n".repeat(100_000));
        let pieces: Vec<&[u8]> = rubbish.as_bytes().chunks(4096).collect();
        let mut recorder = Recorder::default();
        let (_, said, wrong) = heard(&pieces, &mut recorder, u64::MAX);
        assert!(wrong.is_none());
        assert_eq!(
            (recorder.recorded, recorder.refused, said.len()),
            (1, 100_000, 20)
        );
    }

    #[test]
    fn it_stops_after_as_many_lines_as_are_wanted() {
        let mut recorder = Recorder::default();
        let (text, ..) = heard(&[b"x\n1\n2\n3\n"], &mut recorder, 2);
        assert_eq!((recorder.recorded, &*text), (2, "x\n1\n2\n"));
    }
}
