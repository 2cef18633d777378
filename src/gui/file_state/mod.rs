//! What outlives the window.
//!
//! - here: preferences and recent files, in one small file of the data folder;
//! - `machines`: what the reports of machines state;
//! - `recovery`: what is not saved, kept against a crash.

pub(crate) mod machines;
pub(crate) mod recovery;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize};

use crate::atomic::{WriteError, write_atomically};

use crate::gui::core::robot_table::RobotTable;
use crate::gui::preferences::Preferences;
use crate::gui::view::Panes;

use machines::Machine;

/// The folder where this user's programs keep their data, and this program's in it; `None` where
/// the system names none.
pub(crate) fn home() -> Option<PathBuf> {
    eframe::storage_dir("truepose")
}

/// Recent files that are kept.
const MOST_RECENT: usize = 10;
const FORMAT: &str = "truepose-settings/1";

/// Preferences, recent files, and from which URDF the robot of a saved session is drawn: one small
/// JSON document in the data folder, read when the window opens and written whole whenever something in
/// it changes.
///
/// Several windows share it. Each reads the document again before it changes its own part, so that
/// the last word counts for a preference and the recent files are those of all windows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Settings {
    format: String,
    /// How numbers and colours are shown.
    #[serde(default)]
    pub(crate) preferences: Preferences,
    /// Files that were opened or saved, newest first.
    #[serde(default)]
    pub(crate) recent: Vec<PathBuf>,
    /// What the reports of machines state, newest first.
    #[serde(default)]
    pub(crate) machines: Vec<Machine>,
    /// Robots that were typed, newest first.
    #[serde(default)]
    pub(crate) robots: Vec<RobotTable>,
    /// Workspace and charts as they were arranged.
    #[serde(default, deserialize_with = "panes")]
    pub(crate) panes: Panes,
}

/// Panes as they were kept; the usual ones where they cannot be read, which costs nothing else.
fn panes<'de, D: Deserializer<'de>>(reader: D) -> Result<Panes, D::Error> {
    let kept = serde_json::Value::deserialize(reader)?;
    Ok(serde_json::from_value(kept).unwrap_or_default())
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            format: FORMAT.to_owned(),
            preferences: Preferences::default(),
            recent: Vec::new(),
            machines: Vec::new(),
            robots: Vec::new(),
            panes: Panes::default(),
        }
    }
}

/// A change of the recent files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Recent {
    /// This file was opened or saved.
    Used(PathBuf),
    /// This one is not wanted in the list.
    Forgotten(PathBuf),
}

impl Recent {
    pub(crate) fn apply(&self, recent: &mut Vec<PathBuf>) {
        match self {
            Self::Used(path) => {
                recent.retain(|other| other != path);
                recent.insert(0, path.clone());
                recent.truncate(MOST_RECENT);
            }
            Self::Forgotten(path) => recent.retain(|other| other != path),
        }
    }
}

fn file(folder: &Path) -> PathBuf {
    folder.join("settings.json")
}

/// What was kept; the defaults where nothing was, or where it is damaged. Then the second is a sentence about it, and
/// the document stays under a name of its own.
///
/// # Errors
/// It is there and cannot be read, or be put aside: it may be whole, and must not be written over.
pub(crate) fn read(folder: &Path) -> io::Result<(Settings, Option<String>)> {
    let path = file(folder);
    let bytes = match fs::read(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Ok((Settings::default(), None));
        }
        bytes => bytes?,
    };
    match serde_json::from_slice::<Settings>(&bytes) {
        Ok(mut settings) if settings.format == FORMAT => {
            settings.preferences = settings.preferences.sound();
            Ok((settings, None))
        }
        _ => {
            let aside = unused(folder);
            fs::rename(&path, &aside)?;
            let aside = aside.display();
            let says = say!("they were damaged and are kept as {aside}", aside);
            Ok((Settings::default(), Some(says)))
        }
    }
}

/// A name for damaged settings that no earlier ones have.
fn unused(folder: &Path) -> PathBuf {
    let numbers = (2..).map(|number| format!("settings.damaged-{number}.json"));
    let names = std::iter::once("settings.damaged.json".to_owned()).chain(numbers);
    let mut paths = names.map(|name| folder.join(name));
    paths.find(|path| !path.exists()).unwrap_or_default()
}

/// Changes what is kept: read anew before, as another window may have changed it, and written whole.
pub(crate) fn change(folder: &Path, change: impl FnOnce(&mut Settings)) -> Result<(), WriteError> {
    let path = file(folder);
    let failed = |source| WriteError::Io {
        path: path.clone(),
        source,
    };
    fs::create_dir_all(folder).map_err(failed)?;
    let (mut settings, _) = read(folder).map_err(failed)?;
    change(&mut settings);
    let document = serde_json::to_vec_pretty(&settings).map_err(|e| failed(e.into()))?;
    write_atomically(&path, true, |output| output.write_all(&document))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::units::LengthUnit;

    #[test]
    fn what_is_kept_comes_back_and_two_windows_share_it() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("data");
        let inches = Preferences {
            length: LengthUnit::Inch,
            ..Preferences::default()
        };
        change(&folder, |kept| kept.preferences = inches).unwrap();
        for name in ["a.json", "b.json", "a.json"] {
            let used = Recent::Used(name.into());
            change(&folder, |kept| used.apply(&mut kept.recent)).unwrap();
        }
        let (settings, says) = read(&folder).unwrap();
        assert_eq!(settings.preferences, inches);
        assert_eq!(settings.recent, [PathBuf::from("a.json"), "b.json".into()]);
        assert!(says.is_none());
        let forgotten = Recent::Forgotten("a.json".into());
        change(&folder, |kept| forgotten.apply(&mut kept.recent)).unwrap();
        assert_eq!(read(&folder).unwrap().0.recent, [PathBuf::from("b.json")]);
        assert_eq!(read(&folder).unwrap().0.preferences, inches);
    }

    #[test]
    fn the_list_has_an_end() {
        let list = (0..30).fold(Vec::new(), |list, k| {
            let mut list = list;
            Recent::Used(format!("{k}").into()).apply(&mut list);
            list
        });
        assert_eq!(list.len(), MOST_RECENT);
        assert_eq!(list[0], PathBuf::from("29"));
    }

    #[test]
    fn a_damaged_file_costs_the_preferences_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let all = [
            "",
            "{",
            "[]",
            "\u{0}",
            r#"{"format":"truepose-settings/9"}"#,
        ];
        for damaged in all {
            fs::write(file(folder.path()), damaged).unwrap();
            let (settings, says) = read(folder.path()).unwrap();
            assert_eq!(settings, Settings::default());
            assert!(
                says.is_some_and(|says| says.contains("damaged")),
                "{damaged}"
            );
        }
        let mut kept: Vec<String> = fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| fs::read_to_string(entry.unwrap().path()).unwrap())
            .collect();
        kept.sort();
        let mut all = all.map(str::to_owned);
        all.sort();
        assert_eq!(kept, all, "none took the place of another");
        assert_eq!(read(folder.path()).unwrap().1, None, "said once");
    }

    #[test]
    fn panes_that_cannot_be_read_cost_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let kept = |panes: &str| {
            let text = format!(
                r#"{{"format":"truepose-settings/1","preferences":{{"decimals":2}},"panes":{panes}}}"#
            );
            fs::write(file(folder.path()), text).unwrap();
            let (settings, says) = read(folder.path()).unwrap();
            assert!(says.is_none(), "{panes}");
            assert_eq!(settings.preferences.decimals, Some(2), "{panes}");
            settings.panes.sound(|_| true)
        };
        for damaged in [
            "null",
            "7",
            r#"{"root":{"beside":[]}}"#,
            r#"{"root":"pane"}"#,
        ] {
            assert_eq!(kept(damaged), Panes::default(), "{damaged}");
        }
        let chart = r#"{"pane":{"shows":{"chart":{"chart":"histogram"}}}}"#;
        let workspace = r#"{"pane":{"shows":"workspace"}}"#;
        let panes = kept(&format!(
            r#"{{"root":{{"beside":[{{"share":null,"tile":{chart}}},{{"share":-1,"tile":{workspace}}}]}}}}"#
        ));
        assert_eq!(panes, Panes::default(), "a share is a number");
        let panes = kept(&format!(
            r#"{{"root":{{"beside":[{{"share":2,"tile":{chart}}},{{"share":-1,"tile":{workspace}}}]}}}}"#
        ));
        assert_eq!(panes.charts().count(), 1);
        assert!(panes.outline().starts_with('['), "side by side");
    }

    #[test]
    fn numbers_that_make_no_sense_are_brought_into_range() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"{"format":"truepose-settings/1","preferences":{"decimals":200,"zoom":1e9}}"#;
        fs::write(file(folder.path()), text).unwrap();
        let preferences = read(folder.path()).unwrap().0.preferences;
        assert!(preferences.zoom <= 3.0 && preferences.decimals.is_none_or(|d| d <= 6));
    }
}
