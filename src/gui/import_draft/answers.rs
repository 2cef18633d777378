//! What a person said about a file that an instrument wrote, and whose robot was measured: the open
//! session's, an example's, one in a file, or one that is typed; and what lies in its folder and may belong to it.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::importers::{Matching, Reading};
use crate::kinematics::{Robot, robot_from_file};
use crate::pipeline;
use crate::sessions::Target;
use crate::text::Text;

use crate::gui::core::disk::EXAMPLES;
use crate::gui::core::robot_table::RobotTable;

/// What a person said.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ImportAnswers {
    /// What the session is called.
    pub(crate) name: String,
    /// About the measured file.
    pub(crate) reading: Reading,
    /// Whose robot was measured.
    pub(crate) robot: RobotFrom,
    /// A table with the commands, where the file has none; as it is typed.
    pub(crate) commands: String,
    /// How commands find their measurements; `None`: as their names suggest.
    pub(crate) matching: Option<Matching>,
    /// What to add to a measured time, s; `None`: it is found.
    pub(crate) clock_offset_s: Option<f64>,
    /// Whether the rows are in the order in which they were measured: where a joint came from follows.
    pub(crate) in_measuring_order: bool,
    /// Points that are known in the base frame, as it is typed.
    pub(crate) reference: String,
    /// Whether the alignment may scale.
    pub(crate) scale: bool,
    /// Reflectors in the tool frame, as it is typed.
    pub(crate) targets: String,
    /// Those of the open session, where no file says them.
    pub(crate) own_targets: Option<Vec<Target>>,
}

/// A file beside the measured one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Companion {
    Robot,
    /// Where it was sent.
    Commands,
    /// Points that are known in the base frame.
    Reference,
    /// Reflectors in the tool frame.
    Targets,
}

impl Companion {
    pub(crate) const ALL: [Self; 4] = [Self::Robot, Self::Commands, Self::Reference, Self::Targets];
}

impl ImportAnswers {
    /// The path of a file beside the measured one, as it is typed.
    pub(crate) fn path_of(&self, which: Companion) -> &str {
        match (which, &self.robot) {
            (Companion::Robot, RobotFrom::File { path, .. }) => path,
            (Companion::Robot, _) => "",
            (Companion::Commands, _) => &self.commands,
            (Companion::Reference, _) => &self.reference,
            (Companion::Targets, _) => &self.targets,
        }
    }

    /// Takes a file that was chosen.
    pub(crate) fn choose(&mut self, which: Companion, typed: String) {
        match which {
            Companion::Robot => self.robot = self.robot.of_file(typed),
            Companion::Commands => self.commands = typed,
            Companion::Reference => self.reference = typed,
            Companion::Targets => self.targets = typed,
        }
    }
}

/// Whose robot was measured.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum RobotFrom {
    /// Not stated.
    #[default]
    Open,
    /// That of the session that is open.
    Here(Box<Robot>),
    Example(usize),
    /// One of the library or one's own, by its title.
    Listed(String, Box<Robot>),
    /// The one in this file: a robot, a session with one, or a URDF file with the links between
    /// which its chain lies.
    File {
        /// The path, as it is typed.
        path: String,
        /// First link of a URDF file.
        base: String,
        /// Last link of a URDF file.
        tip: String,
    },
    /// Typed as a table.
    Typed(Box<RobotTable>),
}

/// A robot; of one axis the tool is off that axis.
fn off_its_axis(table: &RobotTable) -> Result<Robot, Text> {
    let robot = table.robot()?;
    let tool = robot.base_from_tool.translation.vector;
    if let [joint] = &robot.joints[..]
        && (tool - joint.axis.point_mm.coords)
            .cross(&joint.axis.direction)
            .norm()
            < 1e-6
    {
        return Err(text!(
            "the tool lies on the axis: say where it is at home, off the axis"
        ));
    }
    Ok(robot)
}

impl RobotFrom {
    /// The one in this file; the links that were typed stay.
    #[must_use]
    pub(crate) fn of_file(&self, path: String) -> Self {
        let (base, tip) = match self {
            Self::File { base, tip, .. } => (base.clone(), tip.clone()),
            _ => (String::new(), String::new()),
        };
        Self::File { path, base, tip }
    }

    /// Whether both are of one kind, and of examples the same.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Example(one), Self::Example(other)) => one == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// Whether this is a file of links: URDF or MJCF.
    pub(crate) fn is_urdf(path: &str) -> bool {
        let ending = Path::new(path.trim()).extension();
        ending.is_some_and(|e| e.eq_ignore_ascii_case("urdf") || e.eq_ignore_ascii_case("xml"))
    }

    /// The robot, or why there is none; `None` while it is not said which.
    pub(crate) fn robot(&self) -> Option<Result<Robot, Rejected>> {
        match self {
            Self::Open => None,
            Self::Here(robot) | Self::Listed(_, robot) => Some(Ok(Robot::clone(robot))),
            Self::Example(index) => {
                let files = EXAMPLES[*index % EXAMPLES.len()].files;
                let loaded = pipeline::parse_with_csv(files.document, files.samples);
                Some(loaded.map(|loaded| loaded.session.robot))
            }
            Self::File { path, .. } if path.trim().is_empty() => None,
            Self::File { path, base, tip } if Self::is_urdf(path) => {
                let path = Path::new(path.trim());
                let read = robot_from_file(path, None, base.trim(), tip.trim());
                Some(read.map(|described| described.robot))
            }
            Self::File { path, .. } => Some(from_file(Path::new(path.trim()))),
            Self::Typed(typed) => Some(off_its_axis(typed).map_err(|because| {
                let place = Place::default();
                Rejected::because(Diagnostic::error(place, because, Text::default()))
            })),
        }
    }
}

/// A robot by itself, or a session that has one.
fn from_file(path: &Path) -> Result<Robot, Rejected> {
    pipeline::load_robot(path)
        .map(|loaded| loaded.robot)
        .or_else(|rejected| match pipeline::load(path) {
            Ok(loaded) => Ok(loaded.session.robot),
            Err(_) => Err(rejected),
        })
}

/// Endings of files with tables.
pub(crate) const TABLES: &[&str] = &["csv", "txt", "tsv", "dat", "asc"];
/// Endings of files with a robot.
pub(crate) const ROBOTS: &[&str] = &["json", "urdf", "xml"];

/// A folder with more files than this is no folder of one measurement.
const MOST: usize = 400;
/// So many are offered for one purpose.
const OFFERED: usize = 3;

/// Files beside a measured one, in the order of their names.
#[derive(Debug, Default)]
pub(crate) struct Neighbours(Vec<PathBuf>);

impl Neighbours {
    /// Of this file.
    pub(crate) fn of(path: &Path) -> Self {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        let Ok(entries) = std::fs::read_dir(folder.unwrap_or(Path::new("."))) else {
            return Self::default();
        };
        let paths = entries.take(MOST).flatten().map(|entry| entry.path());
        let is_other = |other: &PathBuf| other.file_name() != path.file_name() && other.is_file();
        let mut all: Vec<PathBuf> = paths.filter(is_other).collect();
        all.sort();
        Self(all)
    }

    /// Those whose name is that of the measured file with a word behind it (`run-commands.csv` of
    /// `run.csv`), a robot's also with its ending alone (`run.json`): one for each purpose at most.
    pub(crate) fn named_alike(&self, measured: &Path) -> Vec<(Companion, PathBuf)> {
        let own = text(measured.file_stem());
        let taken = |which: Companion| {
            let (endings, words) = known_by(which);
            let alike = |path: &&PathBuf| {
                let name = text(path.file_stem());
                let Some(more) = name.strip_prefix(&own) else {
                    return false;
                };
                let word = more.strip_prefix(['-', '_', ' ', '.']);
                let named = word.is_some_and(|word| words.iter().any(|w| word.starts_with(w)));
                let bare = which == Companion::Robot && more.is_empty();
                endings.contains(&&*text(path.extension())) && (named || bare)
            };
            let reads = |path: &&PathBuf| {
                let robot = || RobotFrom::Open.of_file(path.display().to_string()).robot();
                which != Companion::Robot || robot().is_some_and(|robot| robot.is_ok())
            };
            let mut all = self.0.iter().filter(alike).filter(reads);
            let one = all.next()?;
            // Of two nothing says which.
            all.next().is_none().then(|| (which, one.clone()))
        };
        Companion::ALL.into_iter().filter_map(taken).collect()
    }

    /// Those that may serve a purpose: by their ending, a table also by a word in its name.
    pub(crate) fn suiting(&self, which: Companion) -> impl Iterator<Item = &PathBuf> {
        let (endings, words) = known_by(which);
        // A robot may have any name.
        let words = if which == Companion::Robot {
            &[""]
        } else {
            words
        };
        let suits = move |path: &&PathBuf| {
            let (ending, name) = (text(path.extension()), text(path.file_stem()));
            endings.contains(&&*ending)
                && Path::new(&name).extension().is_none_or(|e| e != "meta")
                && words.iter().any(|word| name.contains(word))
        };
        self.0.iter().filter(suits).take(OFFERED)
    }
}

/// Endings of a file that serves a purpose, and words in its name.
fn known_by(which: Companion) -> (&'static [&'static str], &'static [&'static str]) {
    match which {
        Companion::Robot => (ROBOTS, &["robot", "arm", "machine"]),
        Companion::Commands => (TABLES, &["command", "pose", "joint", "sent", "program"]),
        Companion::Reference => (TABLES, &["reference", "base", "known", "datum", "fixed"]),
        Companion::Targets => (TABLES, &["target", "reflector", "smr", "marker"]),
    }
}

/// A part of a name in small letters.
fn text(part: Option<&OsStr>) -> String {
    part.map_or_else(String::new, |p| p.to_string_lossy().to_lowercase())
}

#[cfg(test)]
#[test]
fn a_file_belongs_to_another_by_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = br#"{"format": "truepose-session/1", "name": "x", "robot": {"name": "lamp",
        "joints": [{"name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0]}],
        "tool": {"position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0]}},
        "samples": {"columns": {"q1_deg": [0, 1, 2], "x_mm": [250, 250, 250], "y_mm": [0, 4.4, 8.7]}}}"#;
    for (name, text) in [
        ("run.csv", b"".as_slice()),
        ("Run-commands.csv", b"".as_slice()),
        ("run_targets.csv", b"".as_slice()),
        ("run_targets.txt", b"".as_slice()),
        ("running-reference.csv", b"".as_slice()),
        ("run.json", b"{}".as_slice()),
        ("run-robot.json", robot.as_slice()),
    ] {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let measured = folder.path().join("run.csv");
    let taken = Neighbours::of(&measured).named_alike(&measured);
    let names = ["run-robot.json", "Run-commands.csv"].map(|name| folder.path().join(name));
    let [robot, commands] = names;
    // Two tables of targets are one too many, and what is no robot is none.
    assert_eq!(
        taken,
        [(Companion::Robot, robot), (Companion::Commands, commands)]
    );
}

#[cfg(test)]
#[test]
fn files_are_offered_by_their_ending_and_tables_by_their_name() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in [
        "run.csv",
        "commands.csv",
        "arm.urdf",
        "notes.txt",
        "run.csv.meta.json",
    ] {
        std::fs::write(folder.path().join(name), "").expect("written");
    }
    let all = Neighbours::of(&folder.path().join("run.csv"));
    let names = |which| {
        let names = all.suiting(which).filter_map(|p| p.file_name());
        names
            .map(|n| n.to_string_lossy().into_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(Companion::Commands), ["commands.csv"]);
    assert_eq!(names(Companion::Robot), ["arm.urdf"]);
    assert!(names(Companion::Targets).is_empty());
}
