//! A recording of what an instrument's software sends: what is wanted, and how it stands.

use std::path::{Path, PathBuf};

use crate::explain::clean;
use crate::language::spoken;
use crate::present::numbers::grouped;
use crate::recorder::live::State;
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
