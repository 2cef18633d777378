//! What a person said about a file that an instrument wrote, and whose robot was measured: the open
//! session's, an example's, one in a file, or one that is typed.

use std::path::Path;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::importers::{Matching, Reading};
use crate::kinematics::{Robot, robot_from_file};
use crate::pipeline;
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
    /// First and last link of a robot in a file of links.
    pub(crate) links: [String; 2],
    /// The files beside the measured one, in the order of [`Companion`]; as they are typed.
    pub(crate) files: [String; 4],
    /// How commands find their measurements; `None`: as their names suggest.
    pub(crate) matching: Option<Matching>,
    /// What to add to a measured time, s; `None`: it is found.
    pub(crate) clock_offset_s: Option<f64>,
    /// Whether the rows are in the order in which they were measured: where a joint came from follows.
    pub(crate) in_measuring_order: bool,
    /// Whether the alignment may scale.
    pub(crate) scale: bool,
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
    /// What it is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Robot => say!("File of the robot"),
            Self::Commands => say!("File of the commands"),
            Self::Reference => say!("File of the known points"),
            Self::Targets => say!("File of the reflectors"),
        }
    }
}

impl ImportAnswers {
    /// Nothing but which file it is.
    pub(crate) fn about(path: &Path) -> Self {
        let name = path.file_stem().unwrap_or_default();
        Self {
            name: name.to_string_lossy().into_owned(),
            reading: Reading {
                file: Some(path.to_path_buf()),
                ..Reading::default()
            },
            ..Self::default()
        }
    }

    /// The path of a file beside the measured one; empty: there is none.
    pub(crate) fn file(&self, which: Companion) -> &str {
        self.files[which as usize].trim()
    }

    /// Takes a file that was chosen.
    pub(crate) fn choose(&mut self, which: Companion, typed: String) {
        if which == Companion::Robot {
            self.robot = RobotFrom::File;
        }
        self.files[which as usize] = typed;
    }

    /// Whether the robot is in a file of links: URDF or MJCF.
    pub(crate) fn is_of_links(&self) -> bool {
        let ending = Path::new(self.file(Companion::Robot)).extension();
        let of_links =
            |e: &std::ffi::OsStr| e.eq_ignore_ascii_case("urdf") || e.eq_ignore_ascii_case("xml");
        self.robot == RobotFrom::File && ending.is_some_and(of_links)
    }

    /// The robot, or why there is none; `None` while it is not said which.
    pub(crate) fn robot(&self) -> Option<Result<Robot, Rejected>> {
        let path = Path::new(self.file(Companion::Robot));
        match &self.robot {
            RobotFrom::Open => None,
            RobotFrom::Here(robot) | RobotFrom::Listed(robot) => Some(Ok(Robot::clone(robot))),
            RobotFrom::Example(index) => {
                let files = EXAMPLES[*index % EXAMPLES.len()].files;
                let loaded = pipeline::parse_with_csv(files.document, files.samples);
                Some(loaded.map(|loaded| loaded.session.robot))
            }
            RobotFrom::File if path.as_os_str().is_empty() => None,
            RobotFrom::File if self.is_of_links() => {
                let [base, tip] = &self.links;
                let read = robot_from_file(path, None, base.trim(), tip.trim());
                Some(read.map(|described| described.robot))
            }
            RobotFrom::File => Some(from_file(path)),
            RobotFrom::Typed(typed) => Some(off_its_axis(typed).map_err(|because| {
                let place = Place::default();
                Rejected::because(Diagnostic::error(place, because, Text::default()))
            })),
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
    /// One of the library or one's own.
    Listed(Box<Robot>),
    /// The one in the file of the robot: a robot, a session with one, or links between which its chain lies.
    File,
    /// Typed as a table.
    Typed(Box<RobotTable>),
}

impl RobotFrom {
    /// Whether both are of one kind, and of examples the same.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Example(one), Self::Example(other)) => one == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
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
