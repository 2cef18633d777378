//! From the columns of a foreign file to a session: commands, targets, the base frame, and a note
//! that says where everything came from.

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::importers::companion_file::file_in_words;
use crate::importers::inspect::read;
use crate::importers::matching::Matching;
use crate::importers::settings::{Inspection, Question, Reading};
use crate::importers::upwards;
use crate::kinematics::{JointKind, Robot};
use crate::progress::{Progress, ProgressSpan, ReadError, unwatched};
use crate::sessions::columns::Quantity;
use crate::text::Text;
use std::ops::ControlFlow;

use super::job::{Imported, Job, Settings};

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

fn import_in(
    bytes: &[u8],
    settings: &Settings<'_>,
    part: ProgressSpan<'_>,
) -> Result<Imported, ReadError> {
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
        sentences: Vec::new(),
        part: part.part(0.7, 0.95),
    };
    job.say_source(bytes, &inspection);
    let recorded = columns.commands.take();
    let by_time = match settings.commands {
        Some(_) => settings.matching == Some(Matching::Time),
        None => recorded.is_some(),
    };
    job.lost_become_missing(&mut columns, settings.reference.is_some() || by_time);
    if reading.z_up {
        upwards::turn_up(&mut columns);
        job.sentences.push(text!(
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
        matched,
        alignment,
    })
}

/// The reading with what the robot tells.
fn suited(reading: &Reading, robot: &Robot) -> Result<Reading, Rejected> {
    let Some(joint) = robot.joints.get(reading.joint) else {
        let found = text!("joint {joint} does not exist", joint = reading.joint + 1);
        let expected = text!(
            "a joint of the robot, from 1 to {kinds}",
            kinds = robot.joint_count()
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

impl Job<'_> {
    pub(super) fn say_source(&mut self, bytes: &[u8], inspection: &Inspection) {
        let kind = inspection.kind.map_or("", |kind| kind.id);
        let mut read = vec![Text::verbatim(inspection.encoding.name())];
        read.extend(inspection.separator.map(|s| s.name().into()));
        read.extend(inspection.decimal.map(|d| d.name().into()));
        if !inspection.unit.is_empty() {
            read.push(text!("unit {unit}", unit = &inspection.unit));
        }
        self.sentences.push(text!(
            "imported from {bytes} as {kind}: {read}",
            bytes = file_in_words(self.reading.file.as_ref(), bytes),
            kind,
            read = Text::listed(read, ", ")
        ));
    }
}
