//! `truepose record`: a stream of lines, as a CSV file that grows.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;

use crate::language::spoken;
use crate::recorder::source::{Address, Connection};
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
        let connection = self.connect(&address)?;
        output::messages(&[say!(
            "recording {source} to {file}; Ctrl-C ends it, and every line that is complete is in the file",
            source = self.source,
            file = self.out.display()
        )]);
        let (out, force) = (self.out.clone(), self.force);
        let columns = self.columns.iter().map(|name| name.trim().to_owned());
        let mut recorder = Recorder::new(move || open(&out, force), columns.collect());
        let most = self.lines.unwrap_or(u64::MAX);
        let say = |excluded: Vec<Text>| {
            output::messages(&excluded.iter().map(spoken).collect::<Vec<_>>());
        };
        let done = record(connection, &mut recorder, most, &mut say.clone());
        say(recorder.complaints());
        if let (Err(_), Some(Out::File(file))) = (&done, recorder.out()) {
            // Where the disk is full the start of a line stands behind the last whole one. What
            // cannot be cut off either is left as it is.
            let _ = file.set_len(recorder.whole_bytes());
        }
        let synced = match recorder.out() {
            Some(Out::File(file)) => file.sync_all(),
            _ => Ok(()),
        };
        let recorded = recorder.recorded();
        output::messages(&[match recorder.refused() {
            0 => say!(one "{count} line recorded", "{count} lines recorded", count = recorded),
            refused => say!(
                one "{count} line recorded, {excluded} excluded",
                "{count} lines recorded, {excluded} excluded",
                count = recorded,
                excluded = refused
            ),
        }]);
        done?;
        synced.context(text!("cannot write the recording"))?;
        if recorder.recorded() == 0 {
            let text = text!("the stream ended without a measurement; expected lines of text");
            return Err(Failure::WrongAt(self.source.clone(), text));
        }
        if self.json {
            return output::json(&json!({
                "format": "truepose-recorded/1",
                "source": self.source,
                "file": self.out,
                "lines": recorder.recorded(),
                "left_out": recorder.refused(),
            }));
        }
        Ok(())
    }
}

impl Record {
    fn connect(&self, address: &Address) -> Result<Connection, Failure> {
        let failed = match address {
            Address::Tcp(_) => text!("{source}: cannot connect", source = &self.source),
            Address::Udp(_) => text!("{source}: cannot listen", source = &self.source),
        };
        let connection = address.connect();
        let connection = connection.context(failed)?;
        // Port 0 is any free one: the sender has to be configured for the one that was taken.
        if let (Some(here), true) = (connection.listens_on(), self.source.ends_with(":0")) {
            output::messages(&[say!("listening on {address}", address = here)]);
        }
        Ok(connection)
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        if error.is_refusal() {
            Self::refused(error.describe())
        } else {
            Self::Failed(error.into())
        }
    }
}

/// What is recorded to.
enum Out {
    File(File),
    Standard(io::Stdout),
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Standard(out) => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Standard(out) => out.flush(),
        }
    }
}

fn open(out: &Path, force: bool) -> io::Result<Out> {
    if out.as_os_str() == "-" {
        return Ok(Out::Standard(io::stdout()));
    }
    let mut options = OpenOptions::new();
    options.write(true);
    if force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    options.open(out).map(Out::File)
}
