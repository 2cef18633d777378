//! A samples file that something else goes on writing: only what is new is read.
//!
//! Between two looks the reader keeps how far it has read, and the last bytes before that place. A
//! file that is longer and has the same bytes there has grown; anything else (shorter, other bytes,
//! another heading) was rewritten and is read anew. A line counts when its line feed is there: what
//! is still being written waits for the next look.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::diagnostic::{Diagnostic, Place, Rejected, Severity, unreadable};
use crate::kinematics::Joint;
use crate::progress::{Progress, unwatched};
use crate::sessions::domain::{Samples, Session, Target};
use crate::sessions::files::assemble;
use crate::sessions::files::assemble::Declared;
use crate::sessions::files::open;
use crate::sessions::references::References;

/// As many bytes before the place that was read to are remembered.
const REMEMBERED: usize = 4096;

/// What a look at the file shows.
#[derive(Debug, Clone, PartialEq)]
pub enum Growth {
    /// No complete line is new.
    Nothing,
    /// These samples are new.
    More(Samples),
    /// The file was rewritten (or is read for the first time): these are all its samples.
    Anew(Samples),
}

/// A samples file that is being recorded, read as it grows.
#[derive(Debug, Clone)]
pub struct Growing {
    path: PathBuf,
    joints: Vec<Joint>,
    targets: Vec<Target>,
    references: References,
    /// The line of headings, with its line feed.
    heading: Vec<u8>,
    /// Everything before this was read.
    read_to: u64,
    /// The bytes just before that.
    last: Vec<u8>,
    /// Number of line feeds before that.
    lines: u64,
}

impl Growing {
    /// Follows the samples file of a session; nothing was read of it yet.
    pub fn new(session: &Session, samples: &Path) -> Self {
        Self {
            path: samples.to_path_buf(),
            joints: session.robot.joints.clone(),
            targets: session.targets.clone(),
            references: session.instrument.references.clone(),
            heading: Vec::new(),
            read_to: 0,
            last: Vec::new(),
            lines: 0,
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether a file of this length was read to its end.
    pub fn has_read(&self, length: u64) -> bool {
        self.read_to == length
    }

    /// Looks at the file, and reads what is new.
    ///
    /// # Errors
    /// The file cannot be read, or a complete line cannot be understood; then the next look begins
    /// at the same place.
    pub fn look(&mut self) -> Result<Growth, Rejected> {
        let place = Place::file(&self.path);
        let refused = |(found, expected): open::Refusal| {
            Rejected::because(Diagnostic::error(place.clone(), found, expected))
        };
        let failed =
            |error: io::Error| refused((unreadable(&error), text!("a file that can be read")));
        let (mut file, length) = open::open_regular(&self.path).map_err(refused)?;
        let grown = self.read_to > 0 && self.is_the_same(&mut file, length).map_err(failed)?;
        let mut next = if grown {
            self.clone()
        } else {
            self.begun_anew()
        };
        let Some(bytes) = next.read_lines(&mut file).map_err(failed)? else {
            return Ok(Growth::Nothing);
        };
        let samples = self.parse(&next, bytes.as_slice(), grown)?;
        *self = next;
        Ok(match samples {
            None => Growth::Nothing,
            Some(samples) if grown => Growth::More(samples),
            Some(samples) => Growth::Anew(samples),
        })
    }

    fn begun_anew(&self) -> Self {
        Self {
            heading: Vec::new(),
            last: Vec::new(),
            read_to: 0,
            lines: 0,
            ..self.clone()
        }
    }

    /// Whether what was read still stands there.
    fn is_the_same(&self, file: &mut File, length: u64) -> io::Result<bool> {
        if length < self.read_to {
            return Ok(false);
        }
        let mut heading = vec![0; self.heading.len()];
        let mut last = vec![0; self.last.len()];
        file.rewind()?;
        file.read_exact(&mut heading)?;
        file.seek(SeekFrom::Start(self.read_to - last.len() as u64))?;
        file.read_exact(&mut last)?;
        Ok(heading == self.heading && last == self.last)
    }

    /// Reads the complete lines from where reading ended; `None` where there is none.
    fn read_lines(&mut self, file: &mut File) -> io::Result<Option<Vec<u8>>> {
        file.seek(SeekFrom::Start(self.read_to))?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let Some(end) = memchr::memrchr(b'\n', &bytes) else {
            return Ok(None);
        };
        bytes.truncate(end + 1);
        if self.heading.is_empty() {
            let feed = memchr::memchr(b'\n', &bytes).unwrap_or(end);
            self.heading = bytes[..=feed].to_vec();
        }
        self.read_to += bytes.len() as u64;
        self.lines += memchr::memchr_iter(b'\n', &bytes).count() as u64;
        let kept = bytes.len().saturating_sub(REMEMBERED);
        self.last.extend_from_slice(&bytes[kept..]);
        let surplus = self.last.len().saturating_sub(REMEMBERED);
        self.last.drain(..surplus);
        Ok(Some(bytes))
    }

    /// The samples in `bytes`, which stand behind what `self` has read; `None` where there is none.
    fn parse(&self, next: &Self, bytes: &[u8], grown: bool) -> Result<Option<Samples>, Rejected> {
        let file = Place::file(&self.path);
        let mut findings = Vec::new();
        // The reader wants headings: a part of the file gets those of the whole.
        let heading: &[u8] = if grown { &next.heading } else { &[] };
        let input = heading.chain(bytes);
        let joints = Some(self.joints.as_slice());
        let progress = Progress::new(&unwatched);
        let table = assemble::table(input, None, &file, joints, &mut findings, progress.whole());
        let table = table.map_err(|error| {
            let error = Diagnostic::error(
                file.clone(),
                unreadable(&error),
                text!("a file that can be read"),
            );
            Rejected::because(error)
        })?;
        let further = if grown { self.lines - 1 } else { 0 };
        let samples = table.filter(|table| table.rows() > 0).map(|table| {
            let declared = Declared {
                targets: &self.targets,
                references: &self.references,
            };
            let mut samples = assemble::rows(table, declared, &file, &mut findings);
            samples.follow(&self.joints);
            samples.line = samples.line.moved_down(further);
            samples
        });
        findings.retain(|finding| finding.severity == Severity::Error);
        if findings.is_empty() {
            return Ok(samples);
        }
        for finding in &mut findings {
            finding.place.line = finding.place.line.map(|line| match line {
                1 => 1,
                line => line + further,
            });
        }
        Err(Rejected::of(findings))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::parse_with_csv;
    use std::fs;
    use std::io::Write;

    const HEAD: &str = "q1_deg,x_mm,y_mm,z_mm,time_s\n";

    fn row(k: usize) -> String {
        format!("{k},{}.5,{},300,{}\n", 2 * k, 3 * k, 6 * k)
    }

    fn session(csv: &str) -> Session {
        let document = br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[{"name":"pan",
            "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
            "samples":{"file":"s.csv"}}"#;
        parse_with_csv(document, csv.as_bytes()).unwrap().session
    }

    struct Written {
        folder: tempfile::TempDir,
    }

    impl Written {
        fn new(text: &str) -> Self {
            let folder = tempfile::tempdir().unwrap();
            let written = Self { folder };
            written.rewrite(text);
            written
        }
        fn path(&self) -> PathBuf {
            self.folder.path().join("s.csv")
        }
        fn rewrite(&self, text: &str) {
            fs::write(self.path(), text).unwrap();
        }
        fn append(&self, text: &str) {
            let mut file = fs::OpenOptions::new()
                .append(true)
                .open(self.path())
                .unwrap();
            file.write_all(text.as_bytes()).unwrap();
        }
    }

    fn more(growth: Growth) -> Samples {
        match growth {
            Growth::More(samples) => samples,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn lines_are_read_once_and_half_a_line_waits() {
        let file = Written::new(&format!("{HEAD}{}{}", row(1), row(2)));
        let mut growing = Growing::new(&session(&format!("{HEAD}{}", row(1))), &file.path());
        assert!(matches!(growing.look().unwrap(), Growth::Anew(all) if all.len() == 2));
        assert_eq!(growing.look().unwrap(), Growth::Nothing);
        let line = row(3);
        for cut in 1..line.len() {
            file.append(&line[cut - 1..cut]);
            assert_eq!(growing.look().unwrap(), Growth::Nothing, "{}", &line[..cut]);
        }
        file.append("\n");
        let new = more(growing.look().unwrap());
        assert_eq!(new.x_mm, [6.5]);
        assert_eq!(new.line.get(0), Some(4));
        file.append(&format!("{}\n{}", row(4), row(5)));
        let new = more(growing.look().unwrap());
        assert_eq!(new.x_mm, [8.5, 10.5]);
        assert_eq!(new.line.get(1), Some(7), "a blank line is a line");
    }

    #[test]
    fn the_parts_are_the_whole() {
        let file = Written::new(HEAD);
        let mut growing = Growing::new(&session(&format!("{HEAD}{}", row(1))), &file.path());
        let mut all: Option<Samples> = None;
        for k in 1..400 {
            file.append(&row(k));
            if k % 7 == 0 || k == 399 {
                match growing.look().unwrap() {
                    Growth::Anew(samples) => all = Some(samples),
                    Growth::More(samples) => all.as_mut().unwrap().append(samples),
                    Growth::Nothing => panic!("something is new"),
                }
            }
        }
        let text = fs::read_to_string(file.path()).unwrap();
        assert_eq!(all.unwrap(), session(&text).samples);
    }

    #[test]
    fn a_file_that_was_rewritten_is_read_anew() {
        let file = Written::new(&format!("{HEAD}{}{}", row(1), row(2)));
        let mut growing = Growing::new(&session(&format!("{HEAD}{}", row(1))), &file.path());
        growing.look().unwrap();
        // Shorter; then as long, with other numbers; then longer, with another heading.
        file.rewrite(&format!("{HEAD}{}", row(7)));
        assert!(matches!(growing.look().unwrap(), Growth::Anew(all) if all.x_mm == [14.5]));
        file.rewrite(&format!("{HEAD}{}", row(8)));
        assert!(matches!(growing.look().unwrap(), Growth::Anew(all) if all.x_mm == [16.5]));
        file.rewrite(&format!(
            "q1_rad,x_mm,y_mm,z_mm,time_s\n{}{}",
            row(8),
            row(9)
        ));
        assert!(matches!(growing.look().unwrap(), Growth::Anew(all) if all.len() == 2));
    }

    #[test]
    fn a_line_that_cannot_be_read_is_named_and_read_again_once_it_is_mended() {
        let start = format!("{HEAD}{}{}", row(1), row(2));
        let file = Written::new(&start);
        let mut growing = Growing::new(&session(&format!("{HEAD}{}", row(1))), &file.path());
        growing.look().unwrap();
        file.append("3,abc,1,300,4\n");
        let rejected = growing.look().unwrap_err();
        assert_eq!(rejected.diagnostics[0].place.line, Some(4));
        assert_eq!(rejected.diagnostics[0].place.field.as_deref(), Some("x_mm"));
        assert!(growing.look().is_err());
        file.rewrite(&format!("{start}{}", row(3)));
        assert_eq!(more(growing.look().unwrap()).x_mm, [6.5]);
    }

    #[test]
    fn a_file_that_vanished_or_is_empty_is_no_panic() {
        let file = Written::new("");
        let mut growing = Growing::new(&session(&format!("{HEAD}{}", row(1))), &file.path());
        assert_eq!(growing.look().unwrap(), Growth::Nothing);
        fs::remove_file(file.path()).unwrap();
        assert!(
            growing
                .look()
                .unwrap_err()
                .to_string()
                .contains("no such file")
        );
        file.rewrite(&format!(
            "\u{feff}{}",
            format!("{HEAD}{}", row(1)).replace('\n', "\r\n")
        ));
        assert!(matches!(growing.look().unwrap(), Growth::Anew(all) if all.x_mm == [2.5]));
        file.append(&row(2).replace('\n', "\r\n"));
        assert_eq!(more(growing.look().unwrap()).x_mm, [4.5]);
    }
}
