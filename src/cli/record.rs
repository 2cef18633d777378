//! `truepose record`: a stream of lines, as a CSV file that grows.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;

use crate::recorder::{RecordError, Recorder};

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
}

/// Where lines come from.
enum Source {
    Tcp(TcpStream),
    Udp(UdpSocket),
}

impl Record {
    pub(crate) fn run(self) -> Result<(), Failure> {
        if !output::is_standard_output(Some(&self.out)) {
            output::can_be_written(&self.out, self.force)?;
        }
        let mut source = Source::open(&self.source)?;
        output::messages(&[format!(
            "recording {} to {}; Ctrl-C ends it, and every line that is complete is in the file",
            self.source,
            self.out.display()
        )]);
        let (out, force) = (self.out.clone(), self.force);
        let columns = self.columns.iter().map(|name| name.trim().to_owned());
        let mut recorder = Recorder::new(move || open(&out, force), columns.collect());
        let most = self.lines.unwrap_or(u64::MAX);
        let done = source.record(&mut recorder, most);
        output::messages(&recorder.complaints());
        output::messages(&[format!("{} lines recorded", recorder.recorded())]);
        done?;
        if let Some(Out::File(file)) = recorder.out() {
            file.sync_all().context("cannot write the recording")?;
        }
        if recorder.recorded() == 0 {
            return Err(Failure::WrongInput(format!(
                "{}: the stream ended without a measurement; expected lines of text",
                self.source
            )));
        }
        Ok(())
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        if error.is_refusal() {
            Self::WrongInput(error.to_string())
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

impl Source {
    fn open(source: &str) -> Result<Self, Failure> {
        let expected = "expected tcp://HOST:PORT or udp://:PORT";
        let wrong = || Failure::WrongInput(format!("{source}: no such source; {expected}"));
        let (kind, address) = source.split_once("://").ok_or_else(wrong)?;
        let port = address.rsplit_once(':').ok_or_else(wrong)?.1;
        if port.parse::<u16>().is_err() {
            let found =
                format!("{source}: {port:?} is no port; {expected}, with PORT from 0 to 65535");
            return Err(Failure::WrongInput(found));
        }
        match kind {
            "tcp" => {
                let stream = TcpStream::connect(address);
                let stream = stream.with_context(|| format!("{source}: cannot connect"))?;
                Ok(Self::Tcp(stream))
            }
            "udp" => {
                let address = match address.strip_prefix(':') {
                    Some(port) => format!("0.0.0.0:{port}"),
                    None => address.to_owned(),
                };
                let socket = UdpSocket::bind(&address);
                let socket = socket.with_context(|| format!("{source}: cannot listen"))?;
                // Port 0 is any: whoever sends has to know which.
                if let (Ok(here), "0") = (socket.local_addr(), port) {
                    output::messages(&[format!("listening on {here}")]);
                }
                Ok(Self::Udp(socket))
            }
            _ => Err(wrong()),
        }
    }

    /// Records until the stream ends or has brought enough.
    fn record<F: FnOnce() -> io::Result<Out>>(
        &mut self,
        recorder: &mut Recorder<F, Out>,
        most: u64,
    ) -> Result<(), Failure> {
        // No datagram is longer.
        let mut bytes = vec![0; 1 << 16];
        while recorder.recorded() < most {
            let read = match self {
                Self::Tcp(stream) => stream.read(&mut bytes),
                Self::Udp(socket) => socket.recv(&mut bytes),
            };
            let count = match read {
                Ok(count) => count,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => {
                    return Err(Failure::Failed(
                        anyhow::Error::new(error).context("the stream broke off"),
                    ));
                }
            };
            if count == 0 && matches!(self, Self::Tcp(_)) {
                recorder.end_of_stream();
                return Ok(());
            }
            recorder.take(&bytes[..count], most)?;
            if matches!(self, Self::Udp(_)) {
                recorder.end_of_message(most)?;
            }
            output::messages(&recorder.complaints());
        }
        Ok(())
    }
}
