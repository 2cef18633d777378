//! From the columns of a foreign file to a session: commands, targets, the base frame, and a note
//! that says where everything came from.

use crate::text::Text;
use std::ops::ControlFlow;
use std::path::PathBuf;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::importers::clock::ClockOffset;
use crate::importers::companion_file::file_in_words;
use crate::importers::join::Motion;
use crate::importers::matching::Matching;
use crate::importers::profile::ByHeading;
use crate::importers::reference::Alignment;
use crate::importers::settings::{ColumnGuess, Inspection, Question, Reading};
use crate::importers::{read, upwards};
use crate::kinematics::{JointKind, Robot};
use crate::progress::{Part, Progress, ReadError, unwatched};
use crate::sessions::Session;
use crate::sessions::columns::Quantity;

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
    /// How commands find their measurements.
    pub matching: Matching,
    /// Which points of a recording become samples, matched by time.
    pub motion: Motion,
    /// What to add to a measured time to get the time of the commands, s; `None`: it is found.
    pub clock_offset_s: Option<f64>,
    /// What the columns of the commands are, in the words of [`Reading::columns`]; empty: their
    /// headings say.
    pub commands_columns: Vec<String>,
    /// What columns of such commands were said to be, by their headings: from a profile.
    pub commands_by_heading: ByHeading,
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
            matching: Matching::Order,
            motion: Motion::Auto,
            clock_offset_s: None,
            commands_columns: Vec::new(),
            commands_by_heading: ByHeading::default(),
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
    pub lonely_measurements: Vec<String>,
    /// Commands without a measurement, in words.
    pub lonely_commands: Vec<String>,
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
    /// What the columns of the commands are taken for; empty without such a file.
    pub commands_columns: Vec<ColumnGuess>,
    /// How commands were matched; `None` if the measured file has them.
    pub matched: Option<Matched>,
    /// How the points came into the base frame; `None` if they were taken as they are.
    pub alignment: Option<Alignment>,
}

/// Imports a file.
///
/// # Errors
/// [`Rejected`] with every question that is open and every problem, each with its place.
pub fn import(bytes: &[u8], settings: &Settings<'_>) -> Result<Imported, Rejected> {
    import_watched(bytes, settings, unwatched).map_err(ReadError::rejected)
}

/// As [`import`]. `watch` hears now and then which part is done (0 to 1), and may break it off.
///
/// # Errors
/// As [`import`], and [`ReadError::Cancelled`].
pub fn import_watched(
    bytes: &[u8],
    settings: &Settings<'_>,
    watch: impl Fn(f64) -> ControlFlow<()>,
) -> Result<Imported, ReadError> {
    let progress = Progress::new(&watch);
    let imported = import_in(bytes, settings, progress.whole());
    // What was cut short is not to be judged by what is missing of it.
    progress.whole().check()?;
    let imported = imported?;
    progress.whole().reached(1.0)?;
    Ok(imported)
}

fn import_in(bytes: &[u8], settings: &Settings<'_>, part: Part<'_>) -> Result<Imported, ReadError> {
    let reading = suited(&settings.reading, settings.robot)?;
    let (inspection, columns) = read(bytes, &reading, part.part(0.0, 0.7));
    part.reached(0.7)?;
    let mut findings = inspection.findings.clone();
    let Some(mut columns) = columns else {
        findings.extend(inspection.questions.iter().map(Question::as_diagnostic));
        return Err(Rejected::of(findings).into());
    };
    let mut job = Job {
        settings,
        reading: &reading,
        place: reading.place(),
        findings,
        said: Vec::new(),
        commands_columns: Vec::new(),
        part: part.part(0.7, 0.95),
    };
    job.say_source(bytes, &inspection);
    let recorded = columns.commands.take();
    let by_time = match settings.commands {
        Some(_) => settings.matching == Matching::Time,
        None => recorded.is_some(),
    };
    if settings.reference.is_some() || by_time {
        job.lost_become_missing(&mut columns);
    }
    if reading.z_up {
        upwards::turn_up(&mut columns);
        job.said.push(text!(
            "turned so that z points up: (x, y, z) became (x, -z, y)"
        ));
    } else if inspection.kind.is_some_and(|kind| kind.asks.y_up) && settings.reference.is_none() {
        let found = text!(
            "these files have y upwards, and the coordinates are taken as they are: --z-up turns them, --reference aligns them"
        );
        job.warn(found, Text::default());
    }
    job.axis_to_points(&mut columns)?;
    let named = columns.find(Quantity::Target).is_some();
    let mut targets = job.targets(&columns)?;
    let (columns, alignment) = job.in_base_frame(columns)?;
    let (mut columns, matched) = job.with_commands(columns, recorded, &targets)?;
    if settings.targets.is_none() && !named {
        // The commands may be the first to name one.
        targets = job.targets(&columns)?;
    }
    job.directions(&mut columns, matched.as_ref());
    part.reached(0.95)?;
    let session = job.session(columns, targets)?;
    Ok(Imported {
        session,
        findings: job.findings,
        inspection,
        commands_columns: job.commands_columns,
        matched,
        alignment,
    })
}

/// The reading with what the robot tells.
fn suited(reading: &Reading, robot: &Robot) -> Result<Reading, Rejected> {
    let Some(joint) = robot.joints.get(reading.joint) else {
        let found = text!("joint {joint} does not exist", joint = reading.joint + 1);
        let expected = text!(
            "--joint from 1 to {joint_count}",
            joint_count = robot.joint_count()
        );
        return Err(Rejected::because(Diagnostic::error(
            Place::default(),
            found,
            expected,
        )));
    };
    let mut reading = reading.clone();
    reading.slides = joint.kind == JointKind::Prismatic;
    reading.joints = robot
        .joints
        .iter()
        .map(|joint| (joint.name.clone(), joint.kind == JointKind::Prismatic))
        .collect();
    let reach = robot.base_from_tool.translation.vector.norm();
    reading.reach_mm = reading
        .reach_mm
        .or(Some(reach).filter(|reach| *reach > 0.0));
    Ok(reading)
}

/// An import at work.
pub(crate) struct Job<'s> {
    pub(crate) settings: &'s Settings<'s>,
    pub(crate) reading: &'s Reading,
    pub(crate) place: Place,
    pub(crate) findings: Vec<Diagnostic>,
    /// Sentences of the note.
    pub(crate) said: Vec<Text>,
    /// What the columns of the commands are taken for.
    pub(crate) commands_columns: Vec<ColumnGuess>,
    /// The work that reading the files beside it is a part of.
    pub(crate) part: Part<'s>,
}

impl Job<'_> {
    /// Refuses for these reasons, with everything that was found before.
    pub(crate) fn refused<T>(&self, diagnostics: Vec<Diagnostic>) -> Result<T, Rejected> {
        let mut all = self.findings.clone();
        all.extend(diagnostics);
        Err(Rejected::of(all))
    }

    /// Refuses for one reason.
    pub(crate) fn refuse<T>(
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

    pub(crate) fn warn(&mut self, found: impl Into<Text>, expected: impl Into<Text>) {
        self.findings
            .push(Diagnostic::warning(self.place.clone(), found, expected));
    }

    /// Warns of what did not come into the session, and has its note say it: whoever signs reads
    /// the note, not the terminal.
    pub(crate) fn left_out(&mut self, place: Place, found: Text) {
        self.said.push(found.clone());
        self.findings
            .push(Diagnostic::warning(place, found, Text::default()));
    }

    fn say_source(&mut self, bytes: &[u8], inspection: &Inspection) {
        let kind = inspection.kind.map_or("", |kind| kind.id);
        let mut said = text!(
            "imported from {bytes} as {kind}: {encoding}",
            bytes = file_in_words(self.reading.file.as_ref(), bytes),
            kind = kind,
            encoding = inspection.encoding.to_string()
        );
        if let Some(separator) = inspection.separator {
            said += text!(", {separator}", separator = separator.to_string());
        }
        if let Some(decimal) = inspection.decimal {
            said += text!(", {decimal}", decimal = decimal.to_string());
        }
        if !inspection.unit.is_empty() {
            said += text!(", unit {unit}", unit = &inspection.unit);
        }
        self.said.push(said);
    }
}
