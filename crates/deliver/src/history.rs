//! How a robot changes from one session to the next: the sessions and models of a folder, in order.
//!
//! Every session is identified anew in the same way (the exact fit with its default effects), so that
//! like is compared with like; a model counts with the values that it holds. A parameter has changed
//! where the difference is larger than the interval of that difference,
//!
//! ```text
//! |b − a| > √(h_a² + h_b²),   h: half of the 95 % confidence interval
//! ```
//!
//! What belongs to the measuring set-up (the frame of the instrument) is new in every session and is
//! never a change. No clock and no date of a file is asked: order comes from what the documents hold.

use std::collections::BTreeMap;
use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::compensation::verify;
use crate::diagnostic::{Diagnostic, Place, Rejected, unreadable};
use crate::effects::{Inputs, JointValues, Setting, find};
use crate::fit::uncertainty::{all_estimates, normal_95};
use crate::fit::{DEFAULT_EFFECTS, Estimate, Identification, identify_exact};
use crate::model::Calibration;
use crate::model::format_v1::load_model;
use crate::progress::{Progress, ReadError, unwatched};
use crate::sessions::files::open;
use crate::sessions::load;
use crate::sessions::{Session, hash_of_samples};
use crate::text::Text;

/// Everything that a folder tells.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Robots by name.
    pub robots: Vec<RobotHistory>,
    /// Sessions and models that cannot be read or identified, and why.
    pub not_read: Vec<NotRead>,
}

/// A file that tells nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotRead {
    /// Its name in the folder.
    pub file: String,
    /// Why.
    pub because: Text,
}

impl NotRead {
    /// In a sentence.
    pub fn describe(&self) -> Text {
        text!(
            "{file} is excluded: {because}",
            file = &self.file,
            because = &self.because
        )
    }
}

/// What became of one robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotHistory {
    /// Its name.
    pub robot: String,
    /// By what its entries are ordered.
    pub ordered_by: Order,
    /// Sessions and models, the earliest first.
    pub entries: Vec<Entry>,
}

/// By what entries are ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// By `time_s` of the first sample: every session counts it from 1970.
    Time,
    /// By file name; numbers in it by their value.
    Name,
}

impl Order {
    /// In words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Time => "by the time of the first sample",
            Self::Name => "by file name, numbers in it by their value",
        }
    }
}

named! {
    /// What an entry comes from.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Source {
        /// A session that was identified for this.
        Session = "session",
        /// A model as it was saved.
        Model = "model",
    }
    /// Its name.
    pub fn name;
}

/// One session or model.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its file's name in the folder.
    pub file: String,
    /// What it is.
    pub source: Source,
    /// The session's name.
    pub session: String,
    /// Number of samples; `None` for a model.
    pub samples: Option<usize>,
    /// Hash of the samples.
    pub samples_hash: String,
    /// Hash of the model whose table was active while measuring.
    pub compensated_by: Option<String>,
    /// RMS error of the nominal robot, mm.
    pub before_mm: f64,
    /// RMS error of the model, mm.
    pub after_mm: f64,
    /// RMS error of the robot's earliest model or identification on this session, mm; `None` for a
    /// model, and where it cannot be compared.
    pub with_first_mm: Option<f64>,
    /// Values with their intervals.
    pub parameters: Vec<Estimate>,
    /// Differences from the entry of the same source before this one.
    pub changes: Vec<Change>,
}

/// How a parameter differs from what it was.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Which parameter: its place in the entry's `parameters`.
    pub parameter: usize,
    /// File of the entry that it is compared with.
    pub since: String,
    /// What it was, in the parameter's unit.
    pub from: f64,
    /// How much it is more, in the parameter's unit.
    pub difference: f64,
    /// 95 % confidence interval of the difference; `None` where one of the two is not determined.
    pub ci95: Option<[f64; 2]>,
}

impl Change {
    /// Whether the difference is larger than its interval, and more than rounding.
    pub fn is_significant(&self) -> bool {
        // Without noise the intervals are those of rounding.
        let is_rounding = self.difference.abs() <= 1e-9 * self.from.abs().max(1.0);
        !is_rounding && self.ci95.is_some_and(|[from, to]| from > 0.0 || to < 0.0)
    }
}

/// An entry before it is compared.
struct Read {
    entry: Entry,
    calibration: Calibration,
    loaded: Option<Session>,
    start_s: Option<f64>,
}

/// A time from here on is one that counts from 1970: 9 September 2001.
const EPOCH_S: f64 = 1e9;

#[derive(Deserialize)]
struct Tag {
    format: String,
}

/// Reads the sessions and models of a folder, not those of folders in it.
///
/// # Errors
/// The folder cannot be read, or nothing in it is a session or a model.
pub fn history(folder: &Path) -> Result<History, Rejected> {
    history_watched(folder, &unwatched).map_err(ReadError::rejected)
}

/// As [`history`]. `watch` hears after each file which part is done (0 to 1), and may break it off.
///
/// # Errors
/// As [`history`], and if `watch` breaks it off.
pub fn history_watched(
    folder: &Path,
    watch: &dyn Fn(f64) -> ControlFlow<()>,
) -> Result<History, ReadError> {
    let progress = Progress::new(watch);
    let whole = progress.whole();
    let mut not_read = Vec::new();
    let mut read = Vec::new();
    let documents = documents(folder)?;
    for (k, path) in documents.iter().enumerate() {
        whole.counted(k, documents.len())?;
        let Ok(bytes) = open::read_document(path) else {
            continue;
        };
        let file = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let entry = match source_of(&bytes) {
            Some(Source::Session) => of_session(path, &file),
            Some(Source::Model) => of_model(path, &file),
            None => continue,
        };
        match entry {
            Ok(entry) => read.push(entry),
            Err(because) => not_read.push(NotRead { file, because }),
        }
    }
    if read.is_empty() {
        let found = match &not_read[..] {
            [] => text!("no session and no model"),
            [first, ..] => text!(
                "no session and no model that can be read: {because}",
                because = &first.because
            ),
        };
        let expected =
            text!("a folder with truepose-session/1 or truepose-model/1 documents (*.json)");
        let place = Place::file(folder);
        return Err(Rejected::because(Diagnostic::error(place, found, expected)).into());
    }
    let mut robots: BTreeMap<String, Vec<Read>> = BTreeMap::new();
    for entry in read {
        let robot = entry.calibration.model.robot.name.clone();
        robots.entry(robot).or_default().push(entry);
    }
    let robots = robots
        .into_iter()
        .map(|(robot, read)| compared(robot, read));
    Ok(History {
        robots: robots.collect(),
        not_read,
    })
}

/// What a document is by its key `format`; of a damaged one, what it was meant to be.
fn source_of(bytes: &[u8]) -> Option<Source> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is = |source: &Source| {
        let name = format!("truepose-{}/", source.name());
        match serde_json::from_slice::<Tag>(start) {
            Ok(Tag { format }) => format.starts_with(&name),
            Err(error) if error.is_data() => false,
            Err(_) => memchr::memmem::find(start, name.as_bytes()).is_some(),
        }
    };
    [Source::Session, Source::Model].into_iter().find(is)
}

/// The JSON files of a folder by name.
fn documents(folder: &Path) -> Result<Vec<PathBuf>, Rejected> {
    let wrong = |error: io::Error| {
        let found = match error.kind() {
            io::ErrorKind::NotFound => text!("no such folder"),
            io::ErrorKind::NotADirectory => text!("a file"),
            _ => unreadable(&error),
        };
        Rejected::because(Diagnostic::error(
            Place::file(folder),
            found,
            text!("a folder"),
        ))
    };
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let is_json = path
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("json"));
        if is_json && path.is_file() {
            paths.push(path);
        }
    }
    paths.sort_by_cached_key(|path| as_people_count(&path.to_string_lossy()));
    Ok(paths)
}

fn of_session(path: &Path, file: &str) -> Result<Read, Text> {
    let session = load(path).map_err(|rejected| rejected.describe())?.session;
    let values = JointValues::Commanded;
    let identified = identify_exact(&session, &DEFAULT_EFFECTS.map(str::to_owned), values);
    let identification = identified.map_err(|error| error.describe())?;
    let calibration = identification.calibration(&session, &Inputs::new(&session, values));
    let Identification {
        parameters, gap, ..
    } = identification;
    let times = session.samples.time_s.iter().flatten();
    let start_s = times.copied().find(|time| *time >= EPOCH_S);
    Ok(Read {
        entry: Entry {
            file: file.to_owned(),
            source: Source::Session,
            session: session.name.clone(),
            samples: Some(session.samples.len()),
            samples_hash: hash_of_samples(&session),
            compensated_by: session.compensated_by.clone(),
            before_mm: gap.before.rms_mm,
            after_mm: gap.after.rms_mm,
            with_first_mm: None,
            parameters,
            changes: Vec::new(),
        },
        calibration,
        loaded: Some(session),
        start_s,
    })
}

fn of_model(path: &Path, file: &str) -> Result<Read, Text> {
    let calibration = load_model(path).map_err(|rejected| rejected.describe())?;
    let steps = &calibration.history;
    let gap = |step: Option<&crate::model::ResidualStep>| step.map_or(f64::NAN, |step| step.gap_mm);
    Ok(Read {
        entry: Entry {
            file: file.to_owned(),
            source: Source::Model,
            session: calibration.session.clone(),
            samples: None,
            samples_hash: calibration.samples_hash.clone(),
            compensated_by: calibration.compensated_by.clone(),
            before_mm: gap(steps.first()),
            after_mm: gap(steps.last()),
            with_first_mm: None,
            parameters: all_estimates(&calibration, normal_95()),
            changes: Vec::new(),
        },
        calibration,
        loaded: None,
        start_s: None,
    })
}

/// Orders the entries of one robot and compares each with the one before it.
fn compared(robot: String, mut read: Vec<Read>) -> RobotHistory {
    let is_session = |read: &&Read| read.entry.source == Source::Session;
    let has_time = |read: &Read| read.start_s.is_some();
    let sessions = read.iter().filter(is_session).count();
    let ordered_by = if sessions > 1 && read.iter().filter(is_session).all(has_time) {
        Order::Time
    } else {
        Order::Name
    };
    if ordered_by == Order::Time {
        // A model belongs to the session that it came from; one whose session is not here comes last.
        let start_of: BTreeMap<String, Option<f64>> = read
            .iter()
            .filter(is_session)
            .map(|read| (read.entry.samples_hash.clone(), read.start_s))
            .collect();
        for read in &mut read {
            let own = start_of.get(&read.entry.samples_hash).copied().flatten();
            read.start_s = read.start_s.or(own).or(Some(f64::INFINITY));
        }
        let start = |read: &Read| read.start_s.unwrap_or(f64::INFINITY);
        // The sort is stable: what came at one time stays in the order of names.
        read.sort_by(|a, b| start(a).total_cmp(&start(b)));
    }
    for at in 0..read.len() {
        let source = read[at].entry.source;
        let before = read[..at]
            .iter()
            .rposition(|other| other.entry.source == source);
        if let Some(before) = before {
            read[at].entry.changes = changes(&read[before].entry, &read[at].entry);
        }
        if at > 0
            && let Some(session) = &read[at].loaded
        {
            let verified = verify(&read[0].calibration, session).ok();
            read[at].entry.with_first_mm = verified.map(|verified| verified.model.rms_mm);
        }
    }
    RobotHistory {
        robot,
        ordered_by,
        entries: read.into_iter().map(|read| read.entry).collect(),
    }
}

/// Whether a parameter belongs to the measuring set-up, which is new in every session.
fn is_of_set_up(estimate: &Estimate) -> bool {
    find(estimate.effect).is_some_and(|effect| effect.about().setting == Setting::Setup)
}

/// Whether two estimates are of one parameter.
fn is_same(a: &Estimate, b: &Estimate) -> bool {
    (a.effect, a.joint, a.name) == (b.effect, b.joint, b.name)
        && (&a.setup, &a.target, &a.place) == (&b.setup, &b.target, &b.place)
}

/// How the parameters of one entry differ from those of another.
pub fn changes(before: &Entry, now: &Entry) -> Vec<Change> {
    let each = now
        .parameters
        .iter()
        .enumerate()
        .filter_map(|(parameter, estimate)| {
            if is_of_set_up(estimate) {
                return None;
            }
            let was = before
                .parameters
                .iter()
                .find(|other| is_same(other, estimate))?;
            let plain = estimate.value - was.value;
            let difference = if estimate.name.starts_with("phase") {
                // A phase of 359° is next to one of 1°.
                (plain + 180.0).rem_euclid(360.0) - 180.0
            } else {
                plain
            };
            let half = |e: &Estimate| e.ci95.map(|[from, to]| 0.5 * (to - from));
            let half = half(was).zip(half(estimate)).map(|(a, b)| a.hypot(b));
            Some(Change {
                parameter,
                since: before.file.clone(),
                from: was.value,
                difference,
                ci95: half.map(|half| [difference - half, difference + half]),
            })
        });
    each.collect()
}

/// A name to be sorted by, numbers in it by their value: `run 9` before `run 10`.
fn as_people_count(name: &str) -> (String, String) {
    let (mut key, mut digits) = (String::new(), String::new());
    for letter in name.chars().chain(['\0']) {
        if letter.is_ascii_digit() {
            digits.push(letter);
            continue;
        }
        if !digits.is_empty() {
            // Without zeros before them the more digits are the larger number.
            let plain = digits.trim_start_matches('0');
            key += &format!("{:05}{plain}", plain.len());
            digits.clear();
        }
        key.push(letter);
    }
    (key, name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cmp::Ordering;

    fn by_name(a: &str, b: &str) -> Ordering {
        as_people_count(a).cmp(&as_people_count(b))
    }

    #[test]
    fn names_have_one_order_however_long_their_numbers_are() {
        let long = "1".repeat(40);
        let names = [
            "run 9",
            "run 10",
            "run 010",
            &format!("run 9{long}"),
            &format!("run 10{long}"),
            "run x",
        ];
        for a in &names {
            for b in &names {
                assert_eq!(by_name(a, b), by_name(b, a).reverse(), "{a} {b}");
                for c in &names {
                    let falls =
                        by_name(a, b).is_lt() && by_name(b, c).is_lt() && !by_name(a, c).is_lt();
                    assert!(!falls, "{a} {b} {c}");
                }
            }
        }
        assert!(by_name("run 9", "run 10").is_lt());
    }

    #[test]
    fn names_are_ordered_as_people_count() {
        let mut names = [
            "run 10",
            "run 9",
            "2026-11-02",
            "2026-2-28",
            "run",
            "a",
            "run 09",
        ];
        names.sort_by(|a, b| by_name(a, b));
        let wanted = [
            "2026-2-28",
            "2026-11-02",
            "a",
            "run",
            "run 09",
            "run 9",
            "run 10",
        ];
        assert_eq!(names, wanted);
    }

    #[test]
    fn a_difference_within_its_interval_is_no_change() {
        let entry = |value: f64, half: Option<f64>, phase: f64| {
            let estimate = |name: &'static str, value: f64| Estimate {
                effect: crate::effects::CATALOGUE[0].about().id,
                joint: Some(1),
                setup: None,
                target: None,
                place: None,
                name,
                value,
                ci95: half.map(|half| [value - half, value + half]),
            };
            Entry {
                file: "f".to_owned(),
                source: Source::Session,
                session: String::new(),
                samples: None,
                samples_hash: String::new(),
                compensated_by: None,
                before_mm: 0.0,
                after_mm: 0.0,
                with_first_mm: None,
                parameters: vec![estimate("size", value), estimate("phase_deg", phase)],
                changes: Vec::new(),
            }
        };
        let of = |a: &Entry, b: &Entry| changes(a, b);
        let (a, b) = (entry(1.0, Some(0.3), 359.0), entry(1.45, Some(0.4), 1.0));
        let near = of(&a, &b);
        assert!(!near[0].is_significant(), "0.45 < √(0.3² + 0.4²)");
        assert!((near[1].difference - 2.0).abs() < 1e-9, "{near:?}");
        assert!(of(&a, &entry(1.55, Some(0.4), 0.0))[0].is_significant());
        assert!(
            !of(&a, &entry(9.0, None, 0.0))[0].is_significant(),
            "not determined"
        );
    }
}
