//! What has to hold of a session before anything is computed with it, however it was made.
//!
//! A session that was read holds it by construction; one that a caller filled in field by field may not. Every
//! function of this library that takes a [`Session`] asks here first ([`Session::whole`]): what can refuse does, in
//! the words in which a file would be refused, and what cannot answers with nothing.

use crate::text::Text;
use std::borrow::Cow;

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::ranges::{SMALLEST_SIGMA, short};
use crate::kinematics::JointKind;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::domain::{Samples, Session, Sigma, default_targets};
use crate::sessions::validation;
use crate::units::{LARGEST_JOINT_VALUE, LARGEST_LENGTH_MM, rad_from_deg};

impl Session {
    /// The session itself where it is whole, as one that was read is; else completed.
    ///
    /// # Errors
    /// [`Rejected`] where it cannot be computed with.
    #[doc(hidden)]
    pub fn whole(&self) -> Result<Cow<'_, Self>, Rejected> {
        let mut whole = Cow::Borrowed(self);
        if lacks_columns(self) {
            complete(whole.to_mut());
        }
        let findings = findings(&whole);
        if findings.is_empty() {
            Ok(whole)
        } else {
            Err(Rejected::of(findings))
        }
    }
}

/// Everything for which nothing can be computed with a session.
pub(super) fn findings(session: &Session) -> Vec<Diagnostic> {
    let mut findings = inconsistent(session);
    findings.extend(session.robot.out_of_range(&Place::default()));
    validation::sizes(session, &Place::default(), &mut findings);
    validation::free_targets(session, &Place::default(), &mut findings);
    if findings.is_empty() {
        findings = out_of_range(session);
    }
    findings
}

/// Columns for each joint that every session has, even where nothing was recorded.
fn lacks_columns(session: &Session) -> bool {
    let joints = session.robot.joints.len();
    let samples = &session.samples;
    let columns = [&samples.q_read, &samples.dir, &samples.speed];
    session.targets.is_empty() || columns.iter().any(|columns| columns.is_empty()) && joints > 0
}

/// Completes a session by what may be left out: a target, columns that were not recorded.
pub(super) fn complete(session: &mut Session) {
    let joints = session.robot.joints.len();
    let samples = &mut session.samples;
    for columns in [&mut samples.q_read, &mut samples.dir, &mut samples.speed] {
        if columns.is_empty() {
            columns.resize(joints, None);
        }
    }
    if session.targets.is_empty() {
        session.targets = default_targets();
    }
}

/// A problem of a field of a session that no file holds.
pub(super) fn error(field: &str, found: Text, expected: Text) -> Diagnostic {
    Diagnostic::error(Place::default().in_field(field), found, expected)
}

/// Whether the samples are a table: columns of one length, of joints that there are, and indices of what is
/// declared. That is all that can be asked of a session that is only to be written.
///
/// # Errors
/// [`Rejected`] with everything that is not so.
pub(super) fn columns_fit(session: &Session) -> Result<(), Rejected> {
    let joints = session.robot.joints.len();
    let findings: Vec<Diagnostic> = columns_of_joints(&session.samples)
        .into_iter()
        .filter(|(_, count, _)| *count > joints)
        .map(|(field, count, _)| more_columns(field, count, joints))
        .chain(unequal(session))
        .collect();
    if findings.is_empty() {
        Ok(())
    } else {
        Err(Rejected::of(findings))
    }
}

/// Columns of joints: their field, their number, and whether all joints have one.
fn columns_of_joints(samples: &Samples) -> [(&'static str, usize, bool); 6] {
    let warmth = samples.joint_temperature_c.len();
    [
        ("samples.q", samples.q.len(), true),
        ("samples.q_read", samples.q_read.len(), true),
        ("samples.dir", samples.dir.len(), true),
        ("samples.speed", samples.speed.len(), true),
        ("samples.torque_nm", samples.torque_nm.len(), false),
        ("samples.joint_temperature_c", warmth, false),
    ]
}

fn more_columns(field: &str, count: usize, joints: usize) -> Diagnostic {
    let expected = text!("at most {joints}, one for each joint", joints);
    error(
        field,
        text!(one "{count} column", "{count} columns", count),
        expected,
    )
}

/// Columns of another number than the joints, of another length than the others, and indices of what is not
/// declared.
fn inconsistent(session: &Session) -> Vec<Diagnostic> {
    let (samples, joints) = (&session.samples, session.robot.joints.len());
    let mut findings = Vec::new();
    if joints == 0 {
        let expected = text!("at least one joint");
        findings.push(error("robot.joints", text!("no joints"), expected));
    }
    for (field, count, of_all) in columns_of_joints(samples) {
        if of_all && count != joints {
            let expected = text!("{joints}, one for each joint", joints);
            findings.push(error(
                field,
                text!(one "{count} column", "{count} columns", count),
                expected,
            ));
        } else if count > joints {
            findings.push(more_columns(field, count, joints));
        }
    }
    findings.extend(unequal(session));
    findings
}

/// Columns of another length than the points', and indices of what is not declared.
fn unequal(session: &Session) -> Vec<Diagnostic> {
    let samples = &session.samples;
    let rows = samples.x_mm.len();
    let mut findings = Vec::new();
    for (field, length) in lengths(samples) {
        if length != rows {
            let expected = text!("{rows}, as many as points (x_mm)", rows);
            findings.push(error(
                field,
                text!(one "{count} value", "{count} values", count = length),
                expected,
            ));
        }
    }
    let (targets, references) = (&session.targets, &session.instrument.references);
    let observed = &samples.observed;
    let beyond = |index: &Option<Vec<Option<u32>>>, count: usize| {
        index
            .iter()
            .flatten()
            .flatten()
            .any(|k| *k as usize >= count)
    };
    let target = samples.target.iter().flatten();
    let setups = samples.setups.as_ref();
    let sockets = references.sockets.len();
    let mut between = references.socket_distances.iter().flat_map(|d| d.between);
    let pointing = references.pointing.as_ref();
    let mut pointed = pointing
        .and_then(|p| p.stations.as_ref())
        .into_iter()
        .flatten();
    for (field, wrong) in [
        (
            "instrument.references.socket_distances",
            between.any(|socket| socket >= sockets),
        ),
        (
            "instrument.references.pointing",
            pointed.any(|station| *station >= references.stations.len()),
        ),
        (
            "samples.target",
            target.copied().any(|k| k as usize >= targets.len()),
        ),
        (
            "samples.setups",
            setups.is_some_and(|s| s.index.iter().any(|k| *k as usize >= s.names.len())),
        ),
        (
            "samples.observed.anchor",
            beyond(&observed.anchor, references.anchors.len()),
        ),
        (
            "samples.observed.station",
            beyond(&observed.station, references.stations.len()),
        ),
        (
            "samples.observed.plane",
            beyond(&observed.plane, references.planes.len()),
        ),
        (
            "samples.observed.socket",
            beyond(&observed.socket, references.sockets.len()),
        ),
    ] {
        if wrong {
            let found = text!("an index of nothing that is declared");
            findings.push(error(field, found, text!("indices that count from 0")));
        }
    }
    findings
}

/// Every column that there is, with its number of values.
fn lengths(samples: &Samples) -> Vec<(&'static str, usize)> {
    let mut all = vec![("samples.y_mm", samples.y_mm.len())];
    all.extend(samples.q.iter().map(|column| ("samples.q", column.len())));
    let mut add = |field: &'static str, column: Option<&Vec<f64>>| {
        all.extend(column.map(|column| (field, column.len())));
    };
    for (field, columns) in [
        ("samples.q_read", &samples.q_read),
        ("samples.dir", &samples.dir),
        ("samples.speed", &samples.speed),
        ("samples.torque_nm", &samples.torque_nm),
        ("samples.joint_temperature_c", &samples.joint_temperature_c),
    ] {
        for column in columns {
            add(field, column.as_ref());
        }
    }
    let observed = &samples.observed;
    for (field, column) in [
        ("samples.z_mm", &samples.z_mm),
        ("samples.load_kg", &samples.load_kg),
        ("samples.temperature_c", &samples.temperature_c),
        ("samples.time_s", &samples.time_s),
    ] {
        add(field, column.as_ref());
    }
    for column in observed.numbers() {
        add(column.field, column.values.as_ref());
    }
    for part in samples.orientation_wxyz.iter().flatten() {
        add("samples.orientation_wxyz", Some(part));
    }
    let counted = |field, length: Option<usize>| length.map(|length| (field, length));
    let setups = samples.setups.as_ref().map(|setups| setups.index.len());
    all.extend(
        [
            counted("samples.target", samples.target.as_ref().map(Vec::len)),
            counted("samples.setups", setups),
            counted("samples.held_out", samples.held_out.as_ref().map(Vec::len)),
            counted("samples.excluded", samples.excluded.as_ref().map(Vec::len)),
            counted(
                "samples.observed.anchor",
                observed.anchor.as_ref().map(Vec::len),
            ),
            counted(
                "samples.observed.station",
                observed.station.as_ref().map(Vec::len),
            ),
            counted(
                "samples.observed.plane",
                observed.plane.as_ref().map(Vec::len),
            ),
            counted(
                "samples.observed.socket",
                observed.socket.as_ref().map(Vec::len),
            ),
        ]
        .into_iter()
        .flatten(),
    );
    all.extend(
        samples
            .unknown
            .iter()
            .map(|c| ("samples.unknown", c.cells.len())),
    );
    all
}

/// Numbers beyond any robot's range; a missing value is NaN, and nothing is infinite.
fn out_of_range(session: &Session) -> Vec<Diagnostic> {
    let mut findings = cells(session);
    let is_place = |p: &Point3<f64>| p.iter().all(|x| x.abs() <= LARGEST_LENGTH_MM);
    let mut place = |field: String, at: &Point3<f64>| {
        if !is_place(at) {
            let found = text!("a position that is not finite or too large");
            let expected = text!("three lengths of at most 10 000 000 mm");
            findings.push(error(&field, found, expected));
        }
    };
    for target in &session.targets {
        place(format!("targets.{}", target.name), &target.position_mm);
    }
    let instrument = &session.instrument;
    let references = &instrument.references;
    let anchors = references.anchors.iter().map(|a| (&a.name, a.position_mm));
    let stations = references.stations.iter();
    let stations = stations.map(|s| (&s.name, s.position_mm));
    let sockets = references.sockets.iter().map(|s| (&s.name, s.position_mm));
    for (name, at) in anchors.chain(stations).chain(sockets) {
        if let Some(at) = at {
            place(format!("instrument.references.{name}"), &at);
        }
    }
    if let Some(tracker) = &instrument.tracker {
        place("instrument.tracker".to_owned(), &tracker.position_mm);
    }
    findings.extend(noise(session));
    findings.extend(references_out_of_range(session));
    findings.extend(regions(session));
    findings
}

/// The first value of each column that is out of its range.
fn cells(session: &Session) -> Vec<Diagnostic> {
    let joints = &session.robot.joints;
    let mut findings = Vec::new();
    for quantity in Quantity::all(joints.len()) {
        let unit = match quantity {
            Quantity::Commanded(joint) | Quantity::ReadBack(joint)
                if joints[joint].kind == JointKind::Revolute =>
            {
                Unit::Angle(1.0)
            }
            _ => Unit::Fixed,
        };
        let (largest, expected) = if let Quantity::Direction(_) = quantity {
            (1.0, phrase!("1, -1 or 0 (unknown)"))
        } else {
            let range = quantity.range(unit);
            (range.largest, range.expected)
        };
        let values = session.samples.numbers(quantity).unwrap_or_default();
        // Without a way out, so that a column of millions is compared many at a time.
        if !values
            .iter()
            .fold(false, |out, v| out | (v.abs() > largest))
        {
            continue;
        }
        if let Some(row) = values.iter().position(|value| value.abs() > largest) {
            let field = quantity.heading(Some(quantity.written_in(joints)));
            let found = text!(
                "sample {row}: {value}",
                row = row + 1,
                value = short(values[row])
            );
            findings.push(error(&field, found, expected.into()));
        }
    }
    findings
}

/// Noise and tolerance beyond any instrument.
fn noise(session: &Session) -> Vec<Diagnostic> {
    let instrument = &session.instrument;
    let sigma = match instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => vec![sigma],
        Some(Sigma::PerAxis(each)) => each.to_vec(),
        None => Vec::new(),
    };
    let mut given: Vec<(&str, f64)> = sigma.into_iter().map(|s| ("sigma_mm", s)).collect();
    let mut add = |field, value: Option<f64>| given.extend(value.map(|value| (field, value)));
    add("targets_sigma_mm", instrument.targets_sigma_mm);
    add("sigma_orientation", instrument.sigma_orientation);
    add("sigma_distance_mm", instrument.sigma_distance_mm);
    add("sigma_direction", instrument.sigma_direction);
    add("sigma_touch_mm", instrument.sigma_touch_mm);
    let tracker = instrument.tracker;
    add("tracker.sigma_range_mm", tracker.map(|t| t.sigma_range_mm));
    add("tracker.sigma_angle", tracker.map(|t| t.sigma_angle));
    // Angles are read in millionths, with rounding.
    let is_sigma = |value: f64| (1e-7 * SMALLEST_SIGMA..=LARGEST_LENGTH_MM).contains(&value);
    let wrong = given.into_iter().filter(|(_, value)| !is_sigma(*value));
    let mut findings: Vec<Diagnostic> = wrong
        .map(|(field, value)| {
            let expected = text!("a number above 0, of an instrument");
            error(
                &format!("instrument.{field}"),
                Text::verbatim(short(value)),
                expected,
            )
        })
        .collect();
    if let Some(tolerance_mm) = session.tolerance_mm
        && !(tolerance_mm > 0.0 && tolerance_mm <= LARGEST_LENGTH_MM)
    {
        let expected = text!("a length above 0 mm");
        findings.push(error(
            "tolerance_mm",
            Text::verbatim(short(tolerance_mm)),
            expected,
        ));
    }
    findings
}

/// What places have beside where they are.
fn references_out_of_range(session: &Session) -> Vec<Diagnostic> {
    let references = &session.instrument.references;
    let is_length = |mm: f64| mm.abs() <= LARGEST_LENGTH_MM;
    let is_direction = |v: &nalgebra::Vector3<f64>| (v.norm() - 1.0).abs() <= 1e-6;
    let mut offsets = references.anchors.iter();
    let offsets = offsets.all(|anchor| anchor.offset_mm.is_none_or(is_length));
    let attitudes = references.stations.iter().all(|station| {
        let attitude = station.attitude;
        attitude.is_none_or(|turn| (turn.coords.norm() - 1.0).abs() <= 1e-6)
    });
    let planes = references.planes.iter().all(|plane| {
        let known = plane.stated.as_ref();
        known.is_none_or(|(normal, mm)| is_direction(normal) && is_length(*mm))
    });
    let mut distances = references.socket_distances.iter();
    let distances = distances.all(|distance| is_length(distance.distance_mm));
    let pointing = references.pointing.as_ref();
    let pointing = pointing.is_none_or(|pointing| is_direction(&pointing.axis));
    let all = [
        (
            offsets,
            "anchors",
            phrase!("offsets of at most 10 000 000 mm"),
        ),
        (
            attitudes,
            "stations",
            phrase!("attitudes that are unit quaternions"),
        ),
        (
            planes,
            "planes",
            phrase!("unit normals, and lengths of at most 10 000 000 mm"),
        ),
        (
            distances,
            "socket_distances",
            phrase!("lengths of at most 10 000 000 mm"),
        ),
        (pointing, "pointing", phrase!("a unit vector")),
    ];
    let wrong = all.into_iter().filter(|(fits, ..)| !fits);
    wrong
        .map(|(_, field, expected)| {
            let field = format!("instrument.references.{field}");
            error(&field, text!("a number that cannot be"), expected.into())
        })
        .collect()
}

fn regions(session: &Session) -> Option<Diagnostic> {
    let largest = rad_from_deg(LARGEST_JOINT_VALUE);
    let wrong = session.regions.iter().find(|region| {
        let (from, to) = (region.from_rad, region.to_rad);
        // Written so that a NaN is refused too.
        !(from < to && from.abs() <= largest && to.abs() <= largest)
    })?;
    let found = text!(
        "a region from {from_rad} to {to_rad} rad",
        from_rad = wrong.from_rad,
        to_rad = wrong.to_rad
    );
    let expected = text!("a region from the smaller to the larger value");
    Some(error("regions", found, expected))
}
