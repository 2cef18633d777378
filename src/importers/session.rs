//! From the columns of a foreign file to a session: commands, targets, the base frame, and a note
//! that says where everything came from.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use nalgebra::{Point3, Quaternion, UnitQuaternion};
use sha2::{Digest, Sha256};

use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::importers::case::Case;
use crate::importers::clock::ClockOffset;
use crate::importers::columns::{Column, Columns};
use crate::importers::headings::Role;
use crate::importers::join::{self, Motion, Timing};
use crate::importers::matching::{self, Matching, Pairs, listed};
use crate::importers::reference::{Alignment, Landmark, align};
use crate::importers::settings::{About, Inspection, Reading};
use crate::importers::{csv, optitrack, read, text, tracker};
use crate::kinematics::{JointKind, Robot};
use crate::sessions::assemble;
use crate::sessions::columns::{Heading, Layout, Quantity, Unit, check_joint};
use crate::sessions::format_v1::read::default_targets;
use crate::sessions::number::quoted;
use crate::sessions::table::{Cells, Table};
use crate::sessions::{Instrument, Session, Target, validation};

/// A file beside the measured one.
#[derive(Debug, Clone)]
pub struct Companion<'a> {
    /// What it holds.
    pub bytes: &'a [u8],
    /// Its name, for messages and the note.
    pub file: Option<PathBuf>,
}

impl Companion<'_> {
    fn place(&self) -> Place {
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
    let reading = suited(&settings.reading, settings.robot)?;
    let (inspection, columns) = read(bytes, &reading);
    let mut findings = inspection.findings.clone();
    let Some(mut columns) = columns else {
        findings.extend(
            inspection
                .questions
                .iter()
                .map(|question| question.as_diagnostic()),
        );
        return Err(Rejected {
            diagnostics: findings,
        });
    };
    let mut job = Job {
        settings,
        reading: &reading,
        place: reading.place(),
        findings,
        said: Vec::new(),
    };
    job.say_source(bytes, &inspection);
    if reading.z_up {
        optitrack::turn_up(&mut columns);
        job.said
            .push("turned so that z points up: (x, y, z) became (x, -z, y)".to_owned());
    } else if inspection.kind == Some(super::Kind::Optitrack) && settings.reference.is_none() {
        job.warn(
            "Motive exports with y upwards: the coordinates are taken as they are",
            "--z-up, or --reference",
        );
    }
    job.axis_to_points(&mut columns)?;
    let targets = job.targets(&columns)?;
    let (columns, alignment) = job.into_base(columns)?;
    let (columns, matched) = job.with_commands(columns, &targets)?;
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
        let found = format!("joint {} does not exist", reading.joint + 1);
        let expected = format!("--joint from 1 to {}", robot.joint_count());
        return Err(Rejected::because(Diagnostic::error(
            Place::default(),
            found,
            expected,
        )));
    };
    let mut reading = reading.clone();
    reading.slides = joint.kind == JointKind::Prismatic;
    let reach = robot.base_from_tool.translation.vector.norm();
    reading.reach_mm = reading
        .reach_mm
        .or(Some(reach).filter(|reach| *reach > 0.0));
    Ok(reading)
}

struct Job<'s> {
    settings: &'s Settings<'s>,
    reading: &'s Reading,
    place: Place,
    findings: Vec<Diagnostic>,
    /// Sentences of the note.
    said: Vec<String>,
}

impl Job<'_> {
    fn refused<T>(&self, diagnostics: Vec<Diagnostic>) -> Result<T, Rejected> {
        let mut all = self.findings.clone();
        all.extend(diagnostics);
        Err(Rejected { diagnostics: all })
    }

    fn refuse<T>(
        &self,
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Result<T, Rejected> {
        self.refused(vec![Diagnostic::error(place, found, expected)])
    }

    fn note(&mut self, found: impl Into<String>) {
        self.findings
            .push(Diagnostic::note(self.place.clone(), found));
    }

    fn warn(&mut self, found: impl Into<String>, expected: impl Into<String>) {
        self.findings
            .push(Diagnostic::warning(self.place.clone(), found, expected));
    }

    fn say_source(&mut self, bytes: &[u8], inspection: &Inspection) {
        let kind = inspection.kind.map_or("", super::Kind::id);
        let mut said = format!(
            "imported from {} as {kind}: {}",
            file_in_words(self.reading.file.as_ref(), bytes),
            inspection.encoding
        );
        if let Some(separator) = inspection.separator {
            said += &format!(", {separator}");
        }
        if let Some(decimal) = inspection.decimal {
            said += &format!(", {decimal}");
        }
        if !inspection.unit.is_empty() {
            said += &format!(", unit {}", inspection.unit);
        }
        self.said.push(said);
    }

    /// A measured position of an axis becomes the point to which the nominal robot would carry the
    /// tool then: the radius is nominal, only the axis was measured.
    fn axis_to_points(&mut self, columns: &mut Columns) -> Result<(), Rejected> {
        let robot = self.settings.robot;
        let is_axis = |column: &Column| matches!(column.role, Role::Axis(_));
        let Some(at) = columns.list.iter().position(is_axis) else {
            return Ok(());
        };
        let column = columns.list.remove(at);
        let (Role::Axis(joint), Cells::Numbers(values)) = (column.role, column.cells) else {
            return Ok(());
        };
        let mut q = vec![0.0; robot.joint_count()];
        let mut points = [Vec::new(), Vec::new(), Vec::new()];
        let mut moved: f64 = 0.0;
        let mut first = None;
        for value in &values {
            q[joint] = *value;
            let point = robot.point_in_base(&q, &Point3::origin());
            let start: Point3<f64> = *first.get_or_insert(point);
            moved = moved.max((point - start).norm());
            for (list, coordinate) in points.iter_mut().zip(point.coords.iter()) {
                list.push(*coordinate);
            }
        }
        if values.len() > 1 && moved < 1e-9 {
            return self.refuse(
                self.place.clone(),
                format!(
                    "the tool lies on the axis of joint {}: it does not move",
                    joint + 1
                ),
                "a tool off the axis, in the robot",
            );
        }
        for (quantity, list) in [Quantity::X, Quantity::Y, Quantity::Z]
            .into_iter()
            .zip(points)
        {
            columns.put(Column::made(quantity, Unit::Length(1.0), list));
        }
        let rows = columns.rows();
        for other in (0..robot.joint_count()).filter(|other| *other != joint) {
            let unit = match robot.joints[other].kind {
                JointKind::Revolute => Unit::Angle(1.0),
                JointKind::Prismatic => Unit::Length(1.0),
            };
            columns.put(Column::made(
                Quantity::Commanded(other),
                unit,
                vec![0.0; rows],
            ));
        }
        if robot.joint_count() > 1 {
            self.note(format!(
                "joints other than {} are taken to stand at home",
                joint + 1
            ));
        }
        let said = format!(
            "only the position of joint {} was measured: x, y, z are where the nominal robot carries its tool at that position, so that the radius is nominal",
            joint + 1
        );
        self.note(said.clone());
        self.said.push(said);
        Ok(())
    }

    /// Reads a file beside the measured one.
    fn companion(
        &mut self,
        companion: &Companion<'_>,
        what: &str,
        header: &str,
        reader: fn(&mut Case<'_>) -> Option<Columns>,
    ) -> Result<Columns, Rejected> {
        let mut findings = Vec::new();
        let decoded = text::decode(companion.bytes, &companion.place(), &mut findings);
        let (text, encoding) = match decoded {
            Ok(decoded) => decoded,
            Err(error) => return self.refused(vec![error]),
        };
        let read_with = |decimal| {
            let reading = Reading {
                file: companion.file.clone(),
                unit: self.reading.unit,
                angle_unit: self.reading.angle_unit,
                reach_mm: self.reading.reach_mm,
                decimal,
                ..Reading::default()
            };
            let mut case = Case {
                text: &text,
                reading: &reading,
                place: companion.place(),
                found: Inspection::default(),
            };
            let columns = reader(&mut case);
            let columns = columns.filter(|_| !case.is_open());
            (case.found, columns)
        };
        let (mut found, mut columns) = read_with(None);
        let asks = found
            .questions
            .iter()
            .any(|question| question.about == About::Decimal);
        // What was said about the measured file holds here only where this file cannot tell.
        if asks && self.reading.decimal.is_some() {
            (found, columns) = read_with(self.reading.decimal);
        }
        findings.append(&mut found.findings);
        let Some(columns) = columns else {
            findings.extend(found.questions.iter().map(|question| {
                let mut diagnostic = question.as_diagnostic();
                if question.about == About::Columns {
                    diagnostic.expected = format!("a header such as {header}");
                }
                diagnostic
            }));
            return self.refused(findings);
        };
        self.findings.append(&mut findings);
        self.said.push(format!(
            "{what} from {}: {encoding}",
            file_in_words(companion.file.as_ref(), companion.bytes)
        ));
        Ok(columns)
    }

    /// Points with their names, mm.
    fn named_points(
        &mut self,
        companion: &Companion<'_>,
        what: &str,
    ) -> Result<BTreeMap<String, Point3<f64>>, Rejected> {
        let columns = self.companion(companion, what, "name,x_mm,y_mm,z_mm", tracker::read)?;
        let place = companion.place();
        let (Some(names), Some(points)) = (columns.points(), points_of(&columns)) else {
            return self.refuse(
                place,
                "no names, or not all of x, y and z",
                "name,x_mm,y_mm,z_mm",
            );
        };
        let mut named = BTreeMap::new();
        for (row, (name, point)) in names.iter().zip(points).enumerate() {
            let place = match columns.lines.get(row) {
                Some(line) => place.clone().at_line(line),
                None => place.clone(),
            };
            if name.is_empty() || point.coords.iter().any(|v| !v.is_finite()) {
                return self.refuse(
                    place,
                    "a point without a name or a coordinate",
                    "name, x, y and z",
                );
            }
            if named.insert((*name).to_owned(), point).is_some() {
                return self.refuse(
                    place,
                    format!("{} a second time", quoted(name)),
                    "each name once",
                );
            }
        }
        Ok(named)
    }

    /// Reflectors: those of the file that was given, or one at the tool's origin.
    fn targets(&mut self, columns: &Columns) -> Result<Vec<Target>, Rejected> {
        if let Some(companion) = &self.settings.targets {
            let named = self.named_points(companion, "targets")?;
            let targets = named
                .into_iter()
                .map(|(name, position_mm)| Target { name, position_mm });
            return Ok(targets.collect());
        }
        let used = columns.texts(Role::Known(Quantity::Target, Some(Unit::Fixed)));
        let used: BTreeSet<&str> = used
            .unwrap_or_default()
            .into_iter()
            .filter(|name| !name.is_empty())
            .collect();
        let used: Vec<&str> = used.into_iter().collect();
        match used[..] {
            [] => Ok(default_targets()),
            [name] => {
                self.note(format!(
                    "target {} is taken to sit at the tool's origin",
                    quoted(name)
                ));
                Ok(vec![at_origin(name)])
            }
            _ => {
                let names: Vec<String> = used.iter().map(|name| quoted(name)).collect();
                let found = format!(
                    "several targets, and nothing says where they sit: {}",
                    listed(&names)
                );
                self.refuse(
                    self.place.clone(),
                    found,
                    "--targets with their names and positions in the tool frame",
                )
            }
        }
    }

    /// Brings the points into the base frame, if points are known there.
    fn into_base(&mut self, columns: Columns) -> Result<(Columns, Option<Alignment>), Rejected> {
        let Some(companion) = &self.settings.reference else {
            return Ok((columns, None));
        };
        let known = self.named_points(companion, "reference points")?;
        let place = companion.place();
        let (Some(names), Some(points)) = (columns.points(), points_of(&columns)) else {
            return self.refuse(
                self.place.clone(),
                "no names, or not all of x, y and z",
                "names and points in space to align by",
            );
        };
        let is_there = |point: &Point3<f64>| point.coords.iter().all(|v| v.is_finite());
        let landmarks: Vec<Landmark> = names
            .iter()
            .zip(&points)
            .filter(|(_, point)| is_there(point))
            .filter_map(|(name, point)| {
                let known = known.get(*name)?;
                Some(Landmark {
                    name: (*name).to_owned(),
                    measured: *point,
                    known: *known,
                })
            })
            .collect();
        let measured: BTreeSet<&str> = landmarks
            .iter()
            .map(|landmark| landmark.name.as_str())
            .collect();
        let missing: Vec<String> = known
            .keys()
            .filter(|name| !measured.contains(name.as_str()))
            .map(|name| quoted(name))
            .collect();
        let alignment = match align(&landmarks, self.settings.scale) {
            Ok(alignment) => alignment,
            Err(error) => {
                let found = if missing.is_empty() {
                    error.to_string()
                } else {
                    format!("{error}; not measured: {}", listed(&missing))
                };
                return self.refuse(
                    place,
                    found,
                    "at least 3 points that are not on one line, with the same names in both files",
                );
            }
        };
        if !missing.is_empty() {
            let found = format!(
                "reference points that were not measured: {}",
                listed(&missing)
            );
            self.findings.push(Diagnostic::warning(
                place.clone(),
                found,
                "they are left out",
            ));
        }
        self.say_alignment(&alignment, &place);
        // The points that fix the frame are no poses of the robot, unless a command says so.
        let commanded = self.commanded_names();
        let is_pose = |name: &&str| !known.contains_key(*name) || commanded.contains(*name);
        let rows: Vec<usize> = (0..names.len())
            .filter(|&row| is_pose(&names[row]))
            .collect();
        if rows.is_empty() {
            return self.refuse(
                self.place.clone(),
                "nothing but reference points",
                "measured poses as well",
            );
        }
        let dropped = names.len() - rows.len();
        if dropped > 0 {
            self.note(format!(
                "{dropped} measurements of reference points are no samples"
            ));
        }
        Ok((
            aligned(columns, &points, &alignment).only(&rows),
            Some(alignment),
        ))
    }

    /// Names in the commands; what is wrong with them is said when they are matched.
    fn commanded_names(&mut self) -> BTreeSet<String> {
        let by_name = self.settings.matching == Matching::Name;
        let Some(companion) = self.settings.commands.as_ref().filter(|_| by_name) else {
            return BTreeSet::new();
        };
        let (findings, said) = (self.findings.len(), self.said.len());
        let columns = self.companion(companion, "commands", "q1_deg", csv::read_any);
        self.findings.truncate(findings);
        self.said.truncate(said);
        let names = columns
            .as_ref()
            .ok()
            .and_then(Columns::points)
            .unwrap_or_default();
        names.into_iter().map(str::to_owned).collect()
    }

    fn say_alignment(&mut self, alignment: &Alignment, place: &Place) {
        let kept = alignment.residuals.len() - alignment.outliers().count();
        let mut said = format!(
            "brought into the base frame by {kept} reference points, which fit with {:.4} mm (root mean square)",
            alignment.rms_mm
        );
        if self.settings.scale {
            said += &format!(
                ", scaled by {:.6} ({:+.1} ppm)",
                alignment.scale,
                1e6 * (alignment.scale - 1.0)
            );
        }
        let worst = alignment
            .residuals
            .iter()
            .filter(|residual| !residual.is_outlier);
        let worst = worst.max_by(|a, b| a.vector_mm.norm().total_cmp(&b.vector_mm.norm()));
        let found = match worst {
            Some(worst) => format!(
                "{said}; the largest {:.4} mm at {}",
                worst.vector_mm.norm(),
                quoted(&worst.name)
            ),
            None => said.clone(),
        };
        self.findings.push(Diagnostic::note(place.clone(), found));
        for outlier in alignment.outliers() {
            let found = format!(
                "reference point {} is {:.3} mm off",
                quoted(&outlier.name),
                outlier.vector_mm.norm()
            );
            self.findings.push(Diagnostic::warning(
                place.clone(),
                found,
                "it is left out of the alignment",
            ));
        }
        if !self.settings.scale && (alignment.best_scale - 1.0).abs() > 1e-3 {
            let found = format!(
                "the reference points would fit better scaled by {:.5}",
                alignment.best_scale
            );
            let expected = "the right unit in both files, or --scale";
            self.findings
                .push(Diagnostic::warning(place.clone(), found, expected));
        }
        self.said.push(said);
    }

    /// Adds the commands.
    fn with_commands(
        &mut self,
        columns: Columns,
        targets: &[Target],
    ) -> Result<(Columns, Option<Matched>), Rejected> {
        let joints = self.settings.robot.joint_count();
        let own: Vec<usize> = (0..joints)
            .filter(|&joint| columns.find(Quantity::Commanded(joint)).is_some())
            .collect();
        let Some(companion) = &self.settings.commands else {
            if let Some(joint) = (0..joints).find(|joint| !own.contains(joint)) {
                let found = format!("nothing says where joint {} was sent", joint + 1);
                let expected = format!(
                    "--commands with a column q{}_deg, or such a column in the measured file",
                    joint + 1
                );
                return self.refuse(self.place.clone(), found, expected);
            }
            return Ok((columns, None));
        };
        if let Some(joint) = own.first() {
            let found = format!(
                "commands are given, and the measured file has those of joint {} too",
                joint + 1
            );
            return self.refuse(self.place.clone(), found, "one of the two");
        }
        let header: Vec<String> = (1..=joints).map(|joint| format!("q{joint}_deg")).collect();
        let commands = self.companion(companion, "commands", &header.join(","), csv::read_any)?;
        let place = companion.place();
        if let Some(joint) =
            (0..joints).find(|&joint| commands.find(Quantity::Commanded(joint)).is_none())
        {
            let found = format!("no column for the commanded value of joint {}", joint + 1);
            return self.refuse(
                place,
                found,
                format!("a header such as {}", header.join(",")),
            );
        }
        if let Some(wrong) = self.joints_checked(&commands, &place) {
            return self.refused(wrong);
        }
        let by = self.settings.matching;
        let mut matched = Matched {
            by,
            samples: 0,
            lonely_measurements: Vec::new(),
            lonely_commands: Vec::new(),
            clock: None,
        };
        let (columns, left) = match by {
            Matching::Order => match matching::by_order(&columns, &commands) {
                Ok(pairs) => matching::join(columns, commands, &pairs),
                Err((found, expected)) => return self.refuse(self.place.clone(), found, expected),
            },
            Matching::Name => match matching::by_name(&columns, &commands) {
                Ok(pairs) => {
                    self.say_lonely(&pairs, &place);
                    let joined = matching::join(columns, commands, &pairs);
                    matched.lonely_measurements = pairs.lonely_measured;
                    matched.lonely_commands = pairs.lonely_commands;
                    joined
                }
                Err((found, expected)) => return self.refuse(self.place.clone(), found, expected),
            },
            Matching::Time => {
                let (columns, left, clock) = self.by_time(columns, commands, targets, &place)?;
                matched.clock = Some(clock);
                (columns, left)
            }
        };
        if !left.is_empty() {
            let found = format!(
                "both files have {}: the measured ones are taken",
                left.join(", ")
            );
            self.note(found);
        }
        matched.samples = columns.rows();
        self.said.push(format!("commands matched by {}", by.id()));
        Ok((columns, Some(matched)))
    }

    fn say_lonely(&mut self, pairs: &Pairs, commands: &Place) {
        if !pairs.lonely_measured.is_empty() {
            let found = format!(
                "{} measurements without a command: {}",
                pairs.lonely_measured.len(),
                listed(&pairs.lonely_measured)
            );
            self.warn(found, "they are left out");
        }
        if !pairs.lonely_commands.is_empty() {
            let found = format!(
                "{} commands without a measurement: {}",
                pairs.lonely_commands.len(),
                listed(&pairs.lonely_commands)
            );
            self.findings.push(Diagnostic::warning(
                commands.clone(),
                found,
                "they are left out",
            ));
        }
    }

    fn by_time(
        &mut self,
        columns: Columns,
        commands: Columns,
        targets: &[Target],
        place: &Place,
    ) -> Result<(Columns, Vec<String>, ClockOffset), Rejected> {
        let positions: Vec<Point3<f64>> = targets.iter().map(|target| target.position_mm).collect();
        let used = columns.texts(Role::Known(Quantity::Target, Some(Unit::Fixed)));
        let index = |name: &str| {
            targets
                .iter()
                .position(|target| target.name == name)
                .unwrap_or(0)
        };
        let used: Vec<usize> = used.unwrap_or_default().into_iter().map(index).collect();
        let timing = Timing {
            motion: self.settings.motion,
            offset_s: self.settings.clock_offset_s,
        };
        let robot = self.settings.robot;
        let done = join::by_time(
            columns,
            commands,
            robot,
            (&positions, &used),
            timing,
            (&self.place, place),
        );
        let done = match done {
            Ok(done) => done,
            Err(error) => return self.refused(vec![error]),
        };
        let clock = done.clock;
        let said = match clock.sigma_s {
            Some(sigma) => format!(
                "the clocks are {:+.4} s apart (command less measurement; standard deviation {sigma:.4} s, {:.3} mm left)",
                clock.offset_s, clock.rms_mm
            ),
            None => format!("the clocks are {:+.4} s apart, as was said", clock.offset_s),
        };
        self.note(said.clone());
        self.said.push(said);
        self.findings.extend(done.findings);
        Ok((done.columns, done.left, clock))
    }

    /// Joints that do not exist, and units that do not suit them.
    fn joints_checked(&self, columns: &Columns, place: &Place) -> Option<Vec<Diagnostic>> {
        let kinds: Vec<JointKind> = self
            .settings
            .robot
            .joints
            .iter()
            .map(|joint| joint.kind)
            .collect();
        let mut findings = Vec::new();
        for column in &columns.list {
            if let Role::Known(quantity, Some(unit)) = column.role {
                let place = place.clone().in_field(column.name.clone());
                check_joint(quantity, unit, &kinds, place, &mut findings);
            }
        }
        (!findings.is_empty()).then_some(findings)
    }

    fn session(&mut self, columns: Columns, targets: Vec<Target>) -> Result<Session, Rejected> {
        if let Some(wrong) = self.joints_checked(&columns, &self.place) {
            return self.refused(wrong);
        }
        let numbers: Vec<u64> = columns.list.iter().map(|column| column.number).collect();
        let table = table(columns, self.settings.robot.joint_count());
        let names = table.names.clone();
        let lines = table.line.clone();
        let place = self.place.clone();
        let locate = |column: usize, row: usize| {
            let place = match lines.get(row) {
                Some(line) => place.clone().at_line(line),
                None => place.clone(),
            };
            let place = match numbers.get(column) {
                Some(0) | None => place,
                Some(number) => place.at_column(*number),
            };
            place.in_field(names[column].as_str())
        };
        let mut findings = Vec::new();
        let samples = assemble::samples(table, &targets, &locate, &place, &mut findings);
        let is_error = |finding: &Diagnostic| finding.severity == Severity::Error;
        let mut session = Session {
            name: self.settings.name.clone(),
            note: self.said.join(".\n") + ".",
            robot: self.settings.robot.clone(),
            targets,
            instrument: Instrument::default(),
            tolerance_mm: None,
            regions: Vec::new(),
            compensated_by: None,
            samples,
            path: None,
        };
        if !findings.iter().any(is_error) {
            findings.extend(validation::findings(&session, &place));
        }
        if findings.iter().any(is_error) {
            return self.refused(findings);
        }
        self.findings.append(&mut findings);
        // The lines are those of the foreign file, not of the one that will be saved.
        session.samples.line = crate::sessions::Lines::default();
        Ok(session)
    }
}

fn at_origin(name: &str) -> Target {
    Target {
        name: name.to_owned(),
        position_mm: Point3::origin(),
    }
}

/// A file by its name and what is in it.
fn file_in_words(file: Option<&PathBuf>, bytes: &[u8]) -> String {
    let name = file.and_then(|file| file.file_name());
    let name = name.map_or("a file".into(), |name| name.to_string_lossy());
    let digest = Sha256::digest(bytes);
    let hash: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{name} (sha256 {hash})")
}

/// Points in mm, if all three coordinates are there.
fn points_of(columns: &Columns) -> Option<Vec<Point3<f64>>> {
    let x = columns.numbers(Quantity::X)?;
    let y = columns.numbers(Quantity::Y)?;
    let z = columns.numbers(Quantity::Z)?;
    let points = x.iter().zip(&y).zip(&z);
    Some(points.map(|((x, y), z)| Point3::new(*x, *y, *z)).collect())
}

/// The columns with points and orientations in the base frame.
fn aligned(mut columns: Columns, points: &[Point3<f64>], alignment: &Alignment) -> Columns {
    let points: Vec<Point3<f64>> = points
        .iter()
        .map(|point| alignment.to_base(point))
        .collect();
    for (axis, quantity) in [Quantity::X, Quantity::Y, Quantity::Z]
        .into_iter()
        .enumerate()
    {
        let values = points.iter().map(|point| point[axis]).collect();
        columns.put(Column::made(quantity, Unit::Length(1.0), values));
    }
    let parts: Vec<Vec<f64>> = (0..4)
        .filter_map(|part| columns.numbers(Quantity::Orientation(part)))
        .collect();
    if let [w, x, y, z] = &parts[..] {
        let rotation: UnitQuaternion<f64> = alignment.base_from_instrument.rotation;
        let turned: Vec<Quaternion<f64>> = (0..w.len())
            .map(|row| rotation.into_inner() * Quaternion::new(w[row], x[row], y[row], z[row]))
            .collect();
        let part = |of: fn(&Quaternion<f64>) -> f64| turned.iter().map(of).collect();
        let parts: [Vec<f64>; 4] = [part(|q| q.w), part(|q| q.i), part(|q| q.j), part(|q| q.k)];
        for (part, values) in parts.into_iter().enumerate() {
            columns.put(Column::made(
                Quantity::Orientation(part),
                Unit::Fixed,
                values,
            ));
        }
    }
    columns
}

/// The columns as a session's reader would have them.
fn table(columns: Columns, joints: usize) -> Table {
    let mut table = Table {
        layout: Layout {
            headings: Vec::new(),
            joints,
        },
        names: Vec::new(),
        columns: Vec::new(),
        line: columns.lines,
    };
    for column in columns.list {
        let (heading, cells) = match column.role {
            Role::Known(quantity, unit) => (
                Heading::Known(quantity, unit.unwrap_or(Unit::Fixed)),
                column.cells,
            ),
            Role::Time(_) => (Heading::Known(Quantity::Time, Unit::Fixed), column.cells),
            Role::Point | Role::Group | Role::Kept => match column.cells {
                Cells::Text(cells) => {
                    let cells = cells.into_iter().map(|cell| plain(cell, true)).collect();
                    (Heading::Unknown { hint: None }, Cells::Text(cells))
                }
                _ => continue,
            },
            Role::Left | Role::Axis(_) => continue,
        };
        let mut name = plain(column.name, false);
        if matches!(heading, Heading::Unknown { .. }) {
            name = own_name(name, column.number, &table.names);
        }
        table.layout.headings.push(heading);
        table.names.push(name);
        table.columns.push(cells);
    }
    table
}

/// Text that a CSV file brings back as it is.
fn plain(text: String, with_line_feeds: bool) -> String {
    if !text.contains(|c: char| c.is_control()) {
        return text;
    }
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let keeps = |c: char| !c.is_control() || c == '\t' || (c == '\n' && with_line_feeds);
    text.chars()
        .map(|c| if keeps(c) { c } else { ' ' })
        .collect::<String>()
        .trim()
        .to_owned()
}

/// A heading that no other column has and that a session does not take for one of its own.
fn own_name(name: String, number: u64, others: &[String]) -> String {
    let base = match name.as_str() {
        "" | "-" => format!("column {number}"),
        _ => name,
    };
    let is_free = |name: &String| {
        !others.contains(name) && matches!(Heading::read(name), Heading::Unknown { .. })
    };
    if is_free(&base) {
        return base;
    }
    let numbered = (2..).map(|count: u32| format!("{base} ({count})"));
    numbered.into_iter().find(is_free).unwrap_or(base)
}
