//! What an import is given, what it makes, and the work between.

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::importers::clock::ClockOffset;
use crate::importers::matching::Matching;
use crate::importers::reference::Alignment;
use crate::importers::settings::{Inspection, Reading};
use crate::kinematics::Robot;
use crate::progress::ProgressSpan;
use crate::sessions::Session;
use crate::text::Text;
use std::path::PathBuf;

/// A file beside the measured one.
#[derive(Debug, Clone)]
pub struct Companion<'a> {
    /// What it holds.
    pub bytes: &'a [u8],
    /// Its name, for messages and the note.
    pub file: Option<PathBuf>,
}

impl Companion<'_> {
    pub(crate) fn place(&self) -> Place {
        self.file.as_ref().map(Place::file).unwrap_or_default()
    }
}

/// What makes a session of a measured file.
#[derive(Debug, Clone)]
pub struct Settings<'a> {
    /// What is known about the measured file.
    pub reading: Reading,
    /// The robot that was measured.
    pub robot: &'a Robot,
    /// The session's name.
    pub name: String,
    /// Where the robot was sent; not needed if the measured file says it.
    pub commands: Option<Companion<'a>>,
    /// How commands find their measurements; `None`: by name where both have the same names in another order, else by
    /// order.
    pub matching: Option<Matching>,
    /// What to add to a measured time to get the time of the commands, s; `None`: it is found.
    pub clock_offset_s: Option<f64>,
    /// What the columns of the commands are, in the words of [`Reading::columns`]; empty: their
    /// headings say.
    pub commands_columns: Vec<String>,
    /// Whether the rows are in the order in which they were measured, so that the side from which a
    /// joint came follows from the row before.
    pub in_measuring_order: bool,
    /// Points that are known in the base frame, by name.
    pub reference: Option<Companion<'a>>,
    /// Whether the alignment may scale.
    pub scale: bool,
    /// Reflectors in the tool frame, by name.
    pub targets: Option<Companion<'a>>,
}

impl<'a> Settings<'a> {
    /// Nothing but the file and the robot.
    pub fn new(reading: Reading, robot: &'a Robot) -> Self {
        Self {
            reading,
            robot,
            name: "imported".to_owned(),
            commands: None,
            matching: None,
            clock_offset_s: None,
            commands_columns: Vec::new(),
            in_measuring_order: false,
            reference: None,
            scale: false,
            targets: None,
        }
    }
}

/// How measurements and commands came together.
#[derive(Debug, Clone, PartialEq)]
pub struct Matched {
    /// By what.
    pub by: Matching,
    /// Number of samples.
    pub samples: usize,
    /// Measurements without a command, in words.
    pub lonely_measurements: Vec<Text>,
    /// Commands without a measurement, in words.
    pub lonely_commands: Vec<Text>,
    /// How far the clocks are apart, matched by time.
    pub clock: Option<ClockOffset>,
}

/// A session made of a foreign file.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The session, ready to be saved.
    pub session: Session,
    /// Notes and warnings; no errors.
    pub findings: Vec<Diagnostic>,
    /// What was found out about the measured file.
    pub inspection: Inspection,
    /// How commands were matched; `None` if the measured file has them.
    pub matched: Option<Matched>,
    /// How the points came into the base frame; `None` if they were taken as they are.
    pub alignment: Option<Alignment>,
}

/// An import at work.
pub(crate) struct Job<'s> {
    pub(crate) settings: &'s Settings<'s>,
    pub(crate) reading: &'s Reading,
    pub(crate) place: Place,
    pub(crate) findings: Vec<Diagnostic>,
    /// Sentences of the note.
    pub(crate) sentences: Vec<Text>,
    /// The work that reading the files beside it is a part of.
    pub(crate) part: ProgressSpan<'s>,
}

impl Job<'_> {
    /// Refuses for these reasons, with everything that was found before.
    pub(crate) fn refused<T>(&self, diagnostics: Vec<Diagnostic>) -> Result<T, Rejected> {
        let mut all = self.findings.clone();
        all.extend(diagnostics);
        Err(Rejected::of(all))
    }

    /// Refuses for one reason, in the measured file.
    pub(crate) fn refuse<T>(
        &self,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) -> Result<T, Rejected> {
        self.refuse_at(self.place.clone(), found, expected)
    }

    /// Refuses for one reason.
    pub(crate) fn refuse_at<T>(
        &self,
        place: Place,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) -> Result<T, Rejected> {
        self.refused(vec![Diagnostic::error(place, found, expected)])
    }

    pub(crate) fn note(&mut self, found: impl Into<Text>) {
        self.findings
            .push(Diagnostic::note(self.place.clone(), found));
    }

    /// Notes what the note of the session says as well.
    pub(crate) fn say(&mut self, said: Text) {
        self.note(said.clone());
        self.sentences.push(said);
    }

    pub(crate) fn warn(&mut self, found: impl Into<Text>, expected: impl Into<Text>) {
        self.findings
            .push(Diagnostic::warning(self.place.clone(), found, expected));
    }

    /// Warns of what did not come into the session, and has its note say it: the one who signs reads
    /// the note, not the terminal.
    pub(crate) fn left_out(&mut self, place: Place, found: Text) {
        self.sentences.push(found.clone());
        self.findings
            .push(Diagnostic::warning(place, found, Text::default()));
    }
}
