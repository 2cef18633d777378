//! A file that an instrument wrote, before it is a session: what was found out about it, what a
//! person said, and whose robot it is.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::diagnostic::Rejected;
use crate::importers::{Companion, Inspection, Matching, Reading, Settings, import, inspect};
use crate::kinematics::Robot;
use crate::sessions::{self, files};

use super::files::EXAMPLES;
use super::subject::{Origin, Subject};

/// Whose robot was measured.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum RobotFrom {
    /// Nobody has said.
    Open,
    /// That of the session that is open.
    Here(Box<Robot>),
    /// That of an example.
    Example(usize),
    /// The one in this file: a robot, or a session with one.
    File(String),
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Foreign {
    /// The file.
    pub(crate) path: PathBuf,
    bytes: Arc<Vec<u8>>,
    /// What a person said.
    pub(crate) reading: Reading,
    /// What was found out.
    pub(crate) inspection: Inspection,
    /// Whose robot was measured.
    pub(crate) robot: RobotFrom,
    /// A table with the commands, where the file has none; as it is typed.
    pub(crate) commands: String,
    /// How commands find their measurements.
    pub(crate) matching: Matching,
    /// Why it was refused last.
    pub(crate) refused: Vec<String>,
}

/// Whether a file is none of the program's own: it does not even begin like one.
pub(crate) fn is_foreign(path: &Path) -> bool {
    if path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json"))
    {
        return false;
    }
    let Ok(bytes) = files::read_document(path) else {
        // The reader of sessions says why it cannot be read.
        return false;
    };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    bytes.trim_ascii_start().first().is_some_and(|b| *b != b'{')
}

impl Foreign {
    /// Reads a file and looks what it is.
    pub(crate) fn read(path: &Path) -> Result<Self, Rejected> {
        let bytes = Arc::new(files::read_document(path)?);
        let reading = Reading {
            file: Some(path.to_path_buf()),
            ..Reading::default()
        };
        Ok(Self {
            path: path.to_path_buf(),
            inspection: inspect(&bytes, &reading),
            reading,
            bytes,
            robot: RobotFrom::Open,
            commands: String::new(),
            matching: Matching::default(),
            refused: Vec::new(),
        })
    }

    /// Looks again, with what was said since.
    #[must_use]
    pub(crate) fn looked_at(mut self) -> Self {
        self.inspection = inspect(&self.bytes, &self.reading);
        self.refused.clear();
        self
    }

    /// What stands in the way of an import, in words; `None`: nothing that is known yet.
    pub(crate) fn missing(&self) -> Option<&'static str> {
        if !self.inspection.questions.is_empty() {
            return Some("Answer what is asked above first");
        }
        match &self.robot {
            RobotFrom::Open => Some("Say whose robot was measured"),
            RobotFrom::File(path) if path.trim().is_empty() => {
                Some("Say which file the robot is in")
            }
            _ => None,
        }
    }

    /// The session, or the same with why there is none.
    pub(crate) fn import(mut self) -> Result<Subject, Box<Self>> {
        match self.session() {
            Ok(subject) => Ok(subject),
            Err(because) => {
                self.refused = because;
                Err(Box::new(self))
            }
        }
    }

    fn session(&self) -> Result<Subject, Vec<String>> {
        let said = |rejected: &Rejected| {
            let all = rejected.diagnostics.iter().take(8);
            all.map(ToString::to_string).collect::<Vec<_>>()
        };
        let robot = self.robot().map_err(|rejected| said(&rejected))?;
        let mut settings = Settings::new(self.reading.clone(), &robot);
        let name = self.path.file_stem().unwrap_or_default();
        settings.name = name.to_string_lossy().into_owned();
        settings.matching = self.matching;
        let commands = self.commands.trim();
        let companion;
        if !commands.is_empty() {
            let path = PathBuf::from(commands);
            companion = files::read_document(&path).map_err(|rejected| said(&rejected))?;
            settings.commands = Some(Companion {
                bytes: &companion,
                file: Some(path),
            });
        }
        let imported = import(&self.bytes, &settings).map_err(|rejected| said(&rejected))?;
        let mut findings = imported.findings;
        if let Some(matched) = imported.matched {
            let lonely = matched
                .lonely_measurements
                .iter()
                .chain(&matched.lonely_commands);
            let place = crate::diagnostic::Place::file(&self.path);
            findings.extend(
                lonely.map(|says| crate::diagnostic::Diagnostic::warning(place.clone(), says, "")),
            );
        }
        let origin = Origin::Imported(self.path.clone());
        Ok(Subject::new(imported.session, findings, origin))
    }

    fn robot(&self) -> Result<Robot, Rejected> {
        match &self.robot {
            RobotFrom::Here(robot) => Ok(Robot::clone(robot)),
            RobotFrom::Example(index) => {
                let (document, samples) = EXAMPLES[*index % EXAMPLES.len()].files();
                Ok(sessions::parse_with_csv(document, samples)?.session.robot)
            }
            RobotFrom::Open => sessions::load_robot("").map(|loaded| loaded.robot),
            RobotFrom::File(path) => {
                let path = Path::new(path.trim());
                // A robot by itself, or a session that has one.
                sessions::load_robot(path)
                    .map(|loaded| loaded.robot)
                    .or_else(|rejected| match sessions::load(path) {
                        Ok(loaded) => Ok(loaded.session.robot),
                        Err(_) => Err(rejected),
                    })
            }
        }
    }
}
