//! What a person said about a file that an instrument wrote.

use std::path::Path;

use crate::importers::{Matching, Motion, Reading};

use super::robot::RobotFrom;

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
    /// How commands find their measurements.
    pub(crate) matching: Matching,
    /// What becomes a sample where they are matched by time.
    pub(crate) motion: Motion,
    /// What to add to a measured time, s; `None`: it is found.
    pub(crate) clock_offset_s: Option<f64>,
    /// Points that are known in the base frame, as it is typed.
    pub(crate) reference: String,
    /// Whether the alignment may scale.
    pub(crate) scale: bool,
    /// Reflectors in the tool frame, as it is typed.
    pub(crate) targets: String,
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
    /// Takes a file that was chosen.
    pub(crate) fn choose(&mut self, which: Companion, path: &Path) {
        let typed = path.to_string_lossy().into_owned();
        match which {
            Companion::Robot => self.robot = self.robot.of_file(typed),
            Companion::Commands => self.commands = typed,
            Companion::Reference => self.reference = typed,
            Companion::Targets => self.targets = typed,
        }
    }
}
