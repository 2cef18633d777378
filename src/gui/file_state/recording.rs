//! A recording of what an instrument's software sends: what is wanted, and how it stands.
//!
//! It runs on a thread of its own until the window ends it. Only the latest state is kept, and the
//! window is woken once until it has read it: memory is bounded however seldom it looks.

use std::fs::OpenOptions;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use crate::explain::clean;
use crate::language::spoken;
use crate::present::numbers::grouped;
use crate::recorder::Recorder;
use crate::recorder::live::{State, record};
use crate::recorder::source::Address;
use crate::text::Text;

/// What is wanted, as it is typed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct RecordingRequest {
    /// `tcp://HOST:PORT` or `udp://:PORT`.
    pub(crate) address: String,
    /// Headings between commas; empty: the stream begins with them.
    pub(crate) columns: String,
    /// The table that the lines go to.
    pub(crate) path: PathBuf,
}

impl RecordingRequest {
    pub(crate) fn columns(&self) -> Vec<String> {
        let columns = self.columns.split([',', ';']).map(str::trim);
        let columns = columns.filter(|name| !name.is_empty());
        columns.map(str::to_owned).collect()
    }

    /// Why it cannot be recorded. Asks the disk whether the files are there already.
    pub(crate) fn problem(&self) -> Option<String> {
        if let Err(wrong) = Address::parse(self.address.trim()) {
            return Some(crate::language::spoken(wrong));
        }
        let path = &self.path;
        if path.extension().is_none_or(|ending| ending != "csv") {
            return Some(say!(
                "{path}: expected a name that ends in .csv",
                path = path.display()
            ));
        }
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Some(say!(
                "{folder}: folder not found",
                folder = folder.display()
            ));
        }
        let there = [path.clone(), self.session()];
        let there = there.iter().find(|path| path.exists())?;
        Some(say!(
            "{path} exists already: nothing is replaced by a recording",
            path = there.display()
        ))
    }

    /// The session that its lines become samples of.
    pub(crate) fn session(&self) -> PathBuf {
        self.path.with_extension("json")
    }
}

/// The first name of a recording that is free in a folder.
pub(crate) fn free_name(folder: &Path) -> PathBuf {
    let names = (1..1000).map(|k| folder.join(format!("recording {k}.csv")));
    let free = |path: &PathBuf| !path.exists() && !path.with_extension("json").exists();
    let mut names = names.filter(free);
    names.next().unwrap_or_else(|| folder.join("recording.csv"))
}

/// How it stands.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Heard {
    pub(crate) state: State,
    /// Lines in the table.
    pub(crate) recorded: u64,
    /// Lines that were left out, and why the last of them was.
    pub(crate) refused: u64,
    pub(crate) last_refused: Option<Text>,
    /// How often the connection ended or broke.
    pub(crate) breaks: u64,
    /// It is over: it was stopped, or this is wrong.
    pub(crate) over: Option<Result<(), String>>,
}

impl Heard {
    /// The last line that was left out, and why.
    pub(crate) fn last_refused(&self) -> Option<String> {
        let last = spoken(self.last_refused.as_ref()?);
        Some(clean(&last.replace(char::REPLACEMENT_CHARACTER, "?")))
    }

    /// In a line.
    pub(crate) fn describe(&self) -> String {
        let recorded = usize::try_from(self.recorded).unwrap_or(usize::MAX);
        let lines = say!(one "{count} line", "{count} lines", count = grouped(recorded));
        let state = match &self.state {
            State::Connecting => say!("connecting").to_owned(),
            State::Connected => say!("connected").to_owned(),
            State::Waiting(why) => say!(
                "not connected, tries again: {why}",
                why = crate::language::spoken(why)
            ),
        };
        let mut said = vec![say!("recording").to_owned(), lines];
        if self.refused > 0 {
            said.push(say!("{count} excluded", count = self.refused));
        }
        said.push(state);
        said.join(" · ")
    }
}

/// Between the thread and the window.
#[derive(Debug, Default)]
struct Shared {
    heard: Mutex<Heard>,
    stopped: AtomicBool,
    /// Whether the window was told, and has not looked yet.
    reported: AtomicBool,
}

/// A thread that records; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Recording {
    pub(crate) wanted: RecordingRequest,
    shared: Arc<Shared>,
}

/// A recording, as the window knows it.
#[derive(Debug)]
pub(crate) struct UnderWay {
    pub(crate) recording: Recording,
    pub(crate) heard: Heard,
    /// Whether its session was made already.
    pub(crate) opened: bool,
}

impl Recording {
    /// Begins; `tell` says to the window that it should look.
    pub(crate) fn start(
        wanted: RecordingRequest,
        tell: impl Fn() + Send + 'static,
    ) -> Result<Self, String> {
        let address = Address::parse(wanted.address.trim()).map_err(crate::language::spoken)?;
        let shared = Arc::new(Shared::default());
        let (own, path, columns) = (Arc::clone(&shared), wanted.path.clone(), wanted.columns());
        let listen = move || {
            let over = listened(&address, path, columns, &own, &tell);
            if let Ok(mut heard) = own.heard.lock() {
                heard.over = Some(over);
            }
            tell();
        };
        let thread = std::thread::Builder::new().name("truepose recording".to_owned());
        thread.spawn(listen).map_err(|error| error.to_string())?;
        Ok(Self { wanted, shared })
    }

    /// How it stands now.
    pub(crate) fn look(&self) -> Heard {
        self.shared.reported.store(false, Ordering::Relaxed);
        let heard = self.shared.heard.lock();
        heard.map_or_else(|_| Heard::default(), |heard| heard.clone())
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        self.shared.stopped.store(true, Ordering::Relaxed);
    }
}

fn listened(
    address: &Address,
    path: PathBuf,
    columns: Vec<String>,
    shared: &Shared,
    tell: &impl Fn(),
) -> Result<(), String> {
    let open = move || OpenOptions::new().write(true).create_new(true).open(path);
    let mut recorder = Recorder::new(open, columns);
    let done = record(address, &mut recorder, u64::MAX, &mut |standing| {
        if let Ok(mut heard) = shared.heard.lock() {
            let before = heard.clone();
            heard.state.clone_from(&standing.state);
            heard.recorded = standing.recorded;
            heard.refused = standing.refused;
            heard.breaks = standing.breaks;
            if let Some(last) = standing.left_out.last() {
                heard.last_refused = Some(last.clone());
            }
            if *heard != before && !shared.reported.swap(true, Ordering::Relaxed) {
                tell();
            }
        }
        if shared.stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    if let Some(file) = recorder.out() {
        file.sync_all().map_err(|error| error.to_string())?;
    }
    done.map(drop).map_err(|error| error.to_string())
}
