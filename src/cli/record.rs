//! `truepose record`: a stream of lines, as a CSV file that grows.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;

use crate::language::spoken;
use crate::recorder::source::Address;
use crate::recorder::{RecordError, Recorder, record};
use crate::text::Text;

use super::failure::Failure;
use super::output;

/// Record a stream of a tracker or a controller as a CSV file, until it ends or Ctrl-C
#[derive(Debug, Args)]
pub(crate) struct Record {
    /// Where the lines come from: tcp://HOST:PORT is connected to, udp://:PORT is listened on
    source: String,
    /// Write the lines to this file as they come; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// What the cells are, where the stream does not start with a line of headings
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// Stop after so many lines
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    lines: Option<u64>,
    /// Replace a file that exists
    #[arg(long)]
    force: bool,
    /// Print one JSON document at the end of the stream, or after --lines
    #[arg(long)]
    json: bool,
}

impl Record {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(Some(&self.out));
        output::one_use_of_standard_output(to_stdout, self.json, "--out -", "--json")?;
        if !to_stdout {
            output::can_be_written(&self.out, self.force)?;
        }
        let address = Address::parse(&self.source).map_err(Failure::WrongInput)?;
        let mut stream = self.connect(&address)?;
        output::messages(&[say!(
            "recording {source} to {file}; Ctrl-C ends it, and every line that is complete is in the file",
            source = self.source,
            file = self.out.display()
        )]);
        let columns = self.columns.iter().map(|name| name.trim().to_owned());
        let mut recorder = Recorder::new(columns.collect());
        let mut file = None;
        let mut put = |row: &str| {
            if to_stdout {
                let mut out = io::stdout();
                out.write_all(row.as_bytes())?;
                return out.flush();
            }
            let out = match file.take() {
                Some(out) => out,
                None => open(&self.out, self.force)?,
            };
            file.insert(out).write_all(row.as_bytes())
        };
        let most = self.lines.unwrap_or(u64::MAX);
        let mut hear = |excluded: Text| output::messages(&[spoken(excluded)]);
        let done = record(&mut *stream, &mut recorder, most, &mut put, &mut hear);
        if let (Err(_), Some(file)) = (&done, &file) {
            // Where the disk is full the start of a line stands behind the last whole one. What
            // cannot be cut off either is left as it is.
            let _ = file.set_len(recorder.whole_bytes);
        }
        let synced = file.as_ref().map_or(Ok(()), File::sync_all);
        output::messages(&[match recorder.refused {
            0 => {
                say!(one "{count} line recorded", "{count} lines recorded", count = recorder.recorded)
            }
            refused => say!(
                one "{count} line recorded, {excluded} excluded",
                "{count} lines recorded, {excluded} excluded",
                count = recorder.recorded,
                excluded = refused
            ),
        }]);
        done?;
        synced.context(text!("cannot write the recording"))?;
        if recorder.recorded == 0 {
            let text = text!("the stream ended without a measurement; expected lines of text");
            return Err(Failure::WrongAt(self.source.clone(), text));
        }
        if self.json {
            return output::json(&json!({
                "format": "truepose-recorded/1",
                "source": self.source,
                "file": self.out,
                "lines": recorder.recorded,
                "left_out": recorder.refused,
            }));
        }
        Ok(())
    }
}

impl Record {
    fn connect(&self, address: &Address) -> Result<Box<dyn BufRead>, Failure> {
        let failed = match address {
            Address::Tcp(_) => text!("{source}: cannot connect", source = &self.source),
            Address::Udp(_) => text!("{source}: cannot listen", source = &self.source),
        };
        let (stream, here) = address.connect().context(failed)?;
        // Port 0 is any free one: the sender has to be configured for the one that was taken.
        if let (Some(here), true) = (here, self.source.ends_with(":0")) {
            output::messages(&[say!("listening on {address}", address = here)]);
        }
        Ok(stream)
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::Refused(says) => Self::refused(says),
            failed => Self::Failed(failed.into()),
        }
    }
}

fn open(out: &Path, force: bool) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true);
    if force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    options.open(out)
}
