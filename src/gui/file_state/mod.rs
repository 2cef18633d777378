//! What outlives the window: preferences, recent files and what the reports of machines state, in one small file of the
//! data folder; in `recovery` what is not saved, kept against a crash.

pub(crate) mod recovery;

use std::path::{Path, PathBuf};
use std::time::SystemTime;
use std::{fs, io};

use serde::{Deserialize, Serialize};

use crate::atomic::{WriteError, write_atomically};
use crate::diagnostic::Place;
use crate::gui::core::robot_table::RobotTable;
use crate::gui::view::Preferences;

use crate::report::{Details, Logo};
use crate::sessions::Session;
use crate::text::spoken;

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
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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
}

/// This file was opened or saved: it is the first of the recent ones.
pub(crate) fn use_recent(recent: &mut Vec<PathBuf>, path: PathBuf) {
    recent.retain(|other| *other != path);
    recent.insert(0, path);
    recent.truncate(MOST_RECENT);
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
    FORMAT.clone_into(&mut settings.format);
    let document = serde_json::to_vec_pretty(&settings).map_err(|e| failed(e.into()))?;
    write_atomically(&path, true, |output| output.write_all(&document))
}

/// Report details as they stand in the window: the logo is a path until a report is written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Stated {
    /// The texts and the rule; the tolerance is the document's, and the one from last time here.
    pub(crate) details: Details,
    /// Path of the logo, as it is typed; may be empty.
    pub(crate) logo: String,
}

impl Stated {
    /// What a report is written with.
    ///
    /// # Errors
    /// If the logo cannot be used.
    pub(crate) fn complete(&self) -> Result<Details, String> {
        let path = self.logo.trim();
        let logo = (!path.is_empty()).then(|| {
            let read = Logo::read(Path::new(path));
            read.map_err(|found| {
                say!(
                    "Logo {found}; expected {expected}",
                    found = crate::language::spoken(&found),
                    expected = spoken(Logo::EXPECTED)
                )
            })
        });
        Ok(Details {
            logo: logo.transpose()?,
            // The document's counts.
            tolerance_mm: None,
            ..self.details.clone()
        })
    }
}

/// Machines that are remembered.
const MOST: usize = 200;

/// A machine as it was stated last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Machine {
    /// Name of its robot.
    robot: String,
    /// Name of the session for which it was stated.
    session: String,
    /// Folder of that session; empty where it was in no file.
    folder: PathBuf,
    #[serde(default)]
    logo: String,
    /// A `truepose-details/1` document.
    details: serde_json::Value,
}

impl Machine {
    /// What was entered for a session in this folder; no folder where the session has no file.
    pub(crate) fn new(session: &Session, folder: &Path, stated: &Stated) -> Self {
        let document = serde_json::from_str(&stated.details.document());
        Self {
            robot: session.robot.name.clone(),
            session: session.name.clone(),
            folder: folder.to_owned(),
            logo: stated.logo.clone(),
            details: document.unwrap_or_default(),
        }
    }

    fn stated(&self) -> Option<Stated> {
        let text = self.details.to_string();
        Some(Stated {
            details: Details::parse(Place::default(), &text).ok()?,
            logo: self.logo.clone(),
        })
    }

    fn serial(&self) -> &str {
        self.details["machine_serial"].as_str().unwrap_or_default()
    }
}

/// The machines with this one in front, in place of what was stated of it before.
pub(crate) fn remember(machines: &mut Vec<Machine>, machine: Machine) {
    let same = |other: &Machine| other.robot == machine.robot && other.serial() == machine.serial();
    machines.retain(|other| !same(other));
    machines.insert(0, machine);
    machines.truncate(MOST);
}

/// What is proposed for a session in this folder.
pub(crate) fn proposed(machines: &[Machine], of: &Session, folder: &Path) -> Stated {
    let (robot, instrument) = (&of.robot.name, &of.instrument.name);
    let here: Vec<&Machine> = machines.iter().filter(|m| m.robot == *robot).collect();
    let in_folder = |m: &&&Machine| !m.folder.as_os_str().is_empty() && m.folder == folder;
    let same: Vec<&Machine> = here.iter().filter(in_folder).copied().collect();
    let all = if same.is_empty() { here } else { same };
    let own = all.iter().find(|m| m.session == of.name);
    let one = all.iter().all(|m| m.serial() == all[0].serial());
    let newest = all.first().filter(|_| one);
    if let Some(mut stated) = own.or(newest).and_then(|machine| machine.stated()) {
        if own.is_none() {
            // They belong to one report.
            stated.details.report_number.clear();
            stated.details.date.clear();
        }
        return stated;
    }
    let last = machines.first().and_then(Machine::stated);
    let last = last.unwrap_or_default().details;
    let mut details = Details {
        machine: robot.clone(),
        operator: last.operator,
        ..Details::default()
    };
    if instrument.is_empty() || *instrument == last.instrument {
        details.instrument = last.instrument;
        details.instrument_serial = last.instrument_serial;
        details.instrument_calibrated = last.instrument_calibrated;
    } else {
        details.instrument.clone_from(instrument);
    }
    Stated {
        details,
        logo: String::new(),
    }
}

const SECONDS_OF_A_DAY: u64 = 86_400;

/// Today at UTC, as ISO 8601 writes it: what a report is proposed. `None` where the clock stands before 1970.
#[allow(
    clippy::disallowed_methods,
    reason = "the window may read the clock, the core may not"
)]
pub(crate) fn today() -> Option<String> {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    Some(date_of(since.ok()?.as_secs() / SECONDS_OF_A_DAY))
}

/// The date so many days after 1 January 1970, in the Gregorian calendar: years begin with March, so that the day that
/// not every year has is its last (H. Hinnant, chrono-Compatible Low-Level Date Algorithms, `civil_from_days`).
fn date_of(day: u64) -> String {
    let day = day + 719_468;
    let (era, of_era) = (day / 146_097, day % 146_097);
    let year = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = (from_march + 2) % 12 + 1;
    let year = 400 * era + year + u64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
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
            change(&folder, |kept| use_recent(&mut kept.recent, name.into())).unwrap();
        }
        let (settings, says) = read(&folder).unwrap();
        assert_eq!(settings.preferences, inches);
        assert_eq!(settings.recent, [PathBuf::from("a.json"), "b.json".into()]);
        assert!(says.is_none());
    }

    #[test]
    fn the_list_has_an_end() {
        let list = (0..30).fold(Vec::new(), |list, k| {
            let mut list = list;
            use_recent(&mut list, format!("{k}").into());
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
    fn numbers_that_make_no_sense_are_brought_into_range() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"{"format":"truepose-settings/1","preferences":{"decimals":200,"zoom":1e9}}"#;
        fs::write(file(folder.path()), text).unwrap();
        let preferences = read(folder.path()).unwrap().0.preferences;
        assert!(preferences.zoom <= 3.0 && preferences.decimals.is_none_or(|d| d <= 6));
    }
}

#[cfg(test)]
mod tests_of_machines {
    use super::*;

    fn named(name: &str) -> Session {
        let mut session = crate::gui::files::first_example().session.clone();
        session.name = name.to_owned();
        session.instrument.name = "tracker".to_owned();
        session
    }

    fn made(session: &str, folder: &str, stated: &Stated) -> Machine {
        Machine::new(&named(session), Path::new(folder), stated)
    }

    fn proposed(machines: &[Machine], session: &str, folder: &str) -> Stated {
        super::proposed(machines, &named(session), Path::new(folder))
    }

    fn stated(serial: &str) -> Stated {
        let mut stated = Stated::default();
        stated.details.machine_serial = serial.to_owned();
        stated.details.report_number = "R-1".to_owned();
        stated.details.operator = "A. Meier".to_owned();
        stated.details.instrument = "tracker".to_owned();
        stated.details.instrument_serial = "T-4".to_owned();
        stated
    }

    #[test]
    fn a_machine_is_known_by_its_robot_and_another_ones_serial_number_is_never_proposed() {
        let mut machines = Vec::new();
        remember(&mut machines, made("before", "/a", &stated("L-17")));
        let again = proposed(&machines, "before", "/a");
        assert_eq!(
            again,
            stated("L-17"),
            "the same session has its number back"
        );
        let next = proposed(&machines, "after", "/elsewhere").details;
        assert_eq!((&*next.machine_serial, &*next.report_number), ("L-17", ""));

        remember(&mut machines, made("first", "/b", &stated("L-18")));
        let serial = |session, folder| {
            let stated = proposed(&machines, session, folder).details;
            (
                stated.machine_serial,
                stated.operator,
                stated.instrument_serial,
            )
        };
        let known = ("A. Meier".to_owned(), "T-4".to_owned());
        assert_eq!(serial("after", "/a").0, "L-17");
        assert_eq!(serial("after", "/b").0, "L-18");
        let (machine, operator, instrument) = serial("after", "/c");
        assert_eq!((machine, (operator, instrument)), (String::new(), known));
    }

    #[test]
    fn what_is_stated_again_takes_the_place_of_what_was_stated() {
        let mut machines = Vec::new();
        for k in 0..2 * MOST {
            let serial = format!("L-{}", k % (MOST + 10));
            remember(&mut machines, made("s", "", &stated(&serial)));
        }
        assert_eq!(machines.len(), MOST);
        let mut other = named("s");
        other.instrument.name = "camera".to_owned();
        other.robot.name = "arm".to_owned();
        let details = super::proposed(&machines, &other, Path::new("")).details;
        assert_eq!((&*details.instrument, &*details.machine), ("camera", "arm"));
        assert!(details.instrument_serial.is_empty(), "another instrument's");
    }

    #[test]
    fn days_are_counted_over_leap_years_and_centuries() {
        // `date -u -d @$((86400 * DAY)) +%F`
        for (day, date) in [
            (0, "1970-01-01"),
            (58, "1970-02-28"),
            (59, "1970-03-01"),
            (789, "1972-02-29"),
            (11_016, "2000-02-29"),
            (11_322, "2000-12-31"),
            (11_323, "2001-01-01"),
            (20_780, "2026-11-23"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(date_of(day), date, "{day}");
        }
        assert!(today().is_some_and(|date| date.as_str() > "2026-01-01"));
    }
}
