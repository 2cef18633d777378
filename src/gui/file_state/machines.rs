//! What the reports of machines state: as it stands in the window, and from one day to the next, kept
//! with the settings and proposed when a session of the same machine is opened.
//!
//! A session names its robot and no serial number. Where several machines have a robot of one name, a
//! session belongs to the one whose sessions lie in its folder; where that leaves several as well,
//! nothing is proposed: another machine's serial number in a certificate is worse than none.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use crate::diagnostic::Place;
use crate::report::{Details, Logo};
use crate::text::spoken;

/// Report details as they stand in the window: the logo is a path until a report is written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Stated {
    /// The texts and the rule; the tolerance is the document's, and the one from last time here.
    pub(crate) details: Details,
    /// Path of the logo, as it is typed; may be empty.
    pub(crate) logo: String,
    /// Whether the report leaves out what became of the machine.
    pub(crate) without_history: bool,
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
    #[serde(default)]
    without_history: bool,
    /// A `truepose-details/1` document.
    details: serde_json::Value,
}

/// A session, as far as it shows of which machine it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Of<'a> {
    pub(crate) robot: &'a str,
    pub(crate) session: &'a str,
    pub(crate) folder: &'a Path,
    /// Name of the instrument in the session; may be empty.
    pub(crate) instrument: &'a str,
}

impl Machine {
    pub(crate) fn new(of: Of<'_>, stated: &Stated) -> Self {
        let document = serde_json::from_str(&stated.details.document());
        Self {
            robot: of.robot.to_owned(),
            session: of.session.to_owned(),
            folder: of.folder.to_owned(),
            logo: stated.logo.clone(),
            without_history: stated.without_history,
            details: document.unwrap_or_default(),
        }
    }

    fn stated(&self) -> Option<Stated> {
        let text = self.details.to_string();
        Some(Stated {
            details: Details::parse(Place::default(), &text).ok()?,
            logo: self.logo.clone(),
            without_history: self.without_history,
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

/// What is proposed for a session.
pub(crate) fn proposed(machines: &[Machine], of: Of<'_>) -> Stated {
    let here: Vec<&Machine> = machines.iter().filter(|m| m.robot == of.robot).collect();
    let in_folder = |m: &&&Machine| !m.folder.as_os_str().is_empty() && m.folder == of.folder;
    let same: Vec<&Machine> = here.iter().filter(in_folder).copied().collect();
    let all = if same.is_empty() { here } else { same };
    let own = all.iter().find(|m| m.session == of.session);
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
        machine: of.robot.to_owned(),
        operator: last.operator,
        ..Details::default()
    };
    if of.instrument.is_empty() || of.instrument == last.instrument {
        details.instrument = last.instrument;
        details.instrument_serial = last.instrument_serial;
        details.instrument_calibrated = last.instrument_calibrated;
    } else {
        of.instrument.clone_into(&mut details.instrument);
    }
    Stated {
        details,
        logo: String::new(),
        without_history: false,
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

/// The date so many days after 1 January 1970, in the Gregorian calendar.
fn date_of(mut day: u64) -> String {
    let is_leap = |year: u64| {
        year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
    };
    let mut year = 1970;
    loop {
        let days = if is_leap(year) { 366 } else { 365 };
        if day < days {
            break;
        }
        day -= days;
        year += 1;
    }
    let february = if is_leap(year) { 29 } else { 28 };
    let months = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 1;
    for days in months {
        if day < days {
            break;
        }
        day -= days;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", day + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of<'a>(session: &'a str, folder: &'a str) -> Of<'a> {
        Of {
            robot: "lamp",
            session,
            folder: Path::new(folder),
            instrument: "tracker",
        }
    }

    fn stated(serial: &str) -> Stated {
        let mut stated = Stated::default();
        stated.details.machine_serial = serial.to_owned();
        stated.details.report_number = "R-1".to_owned();
        stated.details.operator = "A. Meier".to_owned();
        stated.without_history = true;
        stated.details.instrument = "tracker".to_owned();
        stated.details.instrument_serial = "T-4".to_owned();
        stated
    }

    #[test]
    fn a_machine_is_known_by_its_robot_and_another_ones_serial_number_is_never_proposed() {
        let mut machines = Vec::new();
        remember(
            &mut machines,
            Machine::new(of("before", "/a"), &stated("L-17")),
        );
        let again = proposed(&machines, of("before", "/a"));
        assert_eq!(
            again,
            stated("L-17"),
            "the same session has its number back"
        );
        let next = proposed(&machines, of("after", "/elsewhere")).details;
        assert_eq!((&*next.machine_serial, &*next.report_number), ("L-17", ""));

        remember(
            &mut machines,
            Machine::new(of("first", "/b"), &stated("L-18")),
        );
        let serial = |session, folder| {
            let stated = proposed(&machines, of(session, folder)).details;
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
            remember(&mut machines, Machine::new(of("s", ""), &stated(&serial)));
        }
        assert_eq!(machines.len(), MOST);
        let other = Of {
            instrument: "camera",
            robot: "arm",
            ..of("s", "")
        };
        let details = proposed(&machines, other).details;
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
