//! What has to hold of a session before anything is computed with it, however it was made.
//!
//! A session that was read holds it by construction; one that a caller filled in field by field may not. Every
//! function of this library that takes a [`Session`] asks here first ([`Session::whole`]): what can refuse does, with
//! the name of the field, and what cannot answers with nothing.

use std::borrow::Cow;

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::ranges::{SMALLEST_SIGMA, short};
use crate::kinematics::JointKind;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::domain::{Region, Session, Sigma, Tracker, default_targets};
use crate::sessions::references::{Anchor, Plane, Station};
use crate::sessions::validation;
use crate::text::Text;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER, rad_from_deg};

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
    let mut findings = columns_of_joints(session, true);
    if session.robot.joints.is_empty() {
        findings.push(error("robot.joints", text!("no joints"), Text::default()));
    }
    findings.extend(unequal(session));
    findings.extend(session.robot.out_of_range(&Place::default()));
    validation::sizes(session, &Place::default(), &mut findings);
    validation::free_targets(session, &Place::default(), &mut findings);
    if findings.is_empty() {
        findings = cells(session);
        findings.extend(out_of_range(session));
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
    let mut findings = columns_of_joints(session, false);
    findings.extend(unequal(session));
    if findings.is_empty() {
        Ok(())
    } else {
        Err(Rejected::of(findings))
    }
}

/// Columns of joints that are more than the joints, or fewer where each joint has to have one.
fn columns_of_joints(session: &Session, each: bool) -> Vec<Diagnostic> {
    let (samples, joints) = (&session.samples, session.robot.joints.len());
    let counts = [
        ("samples.q", samples.q.len(), each),
        ("samples.q_read", samples.q_read.len(), each),
        ("samples.dir", samples.dir.len(), each),
        ("samples.speed", samples.speed.len(), each),
        ("samples.torque_nm", samples.torque_nm.len(), false),
        (
            "samples.joint_temperature_c",
            samples.joint_temperature_c.len(),
            false,
        ),
    ];
    let wrong = counts
        .into_iter()
        .filter(|(_, count, each)| *count > joints || *each && *count != joints);
    let wrong = wrong.map(|(field, count, _)| {
        let found = text!(one "{count} column", "{count} columns", count);
        error(field, found, text!("{joints}, one for each joint", joints))
    });
    wrong.collect()
}

/// Columns of another length than the points', and indices of what is not declared.
fn unequal(session: &Session) -> Vec<Diagnostic> {
    let (samples, observed) = (&session.samples, &session.samples.observed);
    let (joints, references) = (&session.robot.joints, &session.instrument.references);
    let rows = samples.x_mm.len();
    let numbers = Quantity::all(joints.len()).filter_map(|quantity| {
        let values = samples.numbers(quantity)?;
        let heading = quantity.heading(Some(quantity.written_in(joints)));
        Some((heading, values.len()))
    });
    let mut lengths: Vec<(String, usize)> = numbers.collect();
    let mut beyond = Vec::new();
    let mut index = |field: &str, length: usize, most: Option<usize>, declared: usize| {
        lengths.push((field.to_owned(), length));
        if most.is_some_and(|most| most >= declared) {
            beyond.push(field.to_owned());
        }
    };
    let largest = |index: &[u32]| index.iter().max().map(|k| *k as usize);
    if let Some(own) = &samples.target {
        index(
            "samples.target",
            own.len(),
            largest(own),
            session.targets.len(),
        );
    }
    if let Some(own) = &samples.setups {
        index(
            "samples.setups",
            own.index.len(),
            largest(&own.index),
            own.names.len(),
        );
    }
    for column in observed.names() {
        if let Some(own) = column.values {
            let most = own.iter().flatten().max().map(|k| *k as usize);
            let field = format!("samples.observed.{}", column.label);
            let declared = references.named(column.quantity).len();
            index(&field, own.len(), most, declared);
        }
    }
    for own in samples.held_out.iter().chain(&samples.excluded) {
        index("samples.use", own.len(), None, 0);
    }
    for own in &samples.unknown {
        index("samples.unknown", own.cells.len(), None, 0);
    }
    let between = references
        .socket_distances
        .iter()
        .flat_map(|d| d.between)
        .max();
    if between.is_some_and(|most| most >= references.sockets.len()) {
        beyond.push("instrument.references.socket_distances".to_owned());
    }
    let pointed = references.pointing.iter().flat_map(|p| &p.stations);
    if pointed
        .flatten()
        .any(|station| *station >= references.stations.len())
    {
        beyond.push("instrument.references.pointing".to_owned());
    }
    let lengths = lengths.into_iter().filter(|(_, length)| *length != rows);
    let lengths = lengths.map(|(field, length)| {
        let found = text!(one "{count} value", "{count} values", count = length);
        error(&field, found, text!("{rows}, as many as samples", rows))
    });
    let beyond = beyond.into_iter().map(|field| {
        let found = text!("an index of nothing that is declared");
        error(&field, found, Text::default())
    });
    lengths.chain(beyond).collect()
}

/// The first value of each column that is out of its range; a missing value is NaN, and nothing is infinite.
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
            (1.0, text!("1, -1 or 0 (unknown)"))
        } else {
            let range = quantity.range(unit);
            (range.largest, range.expected())
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
            findings.push(error(&field, found, expected));
        }
    }
    findings
}

/// Fields with numbers that no file of a session holds. What is not a number fits nowhere.
fn out_of_range(session: &Session) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    let mut check = |field: &str, fits: bool| {
        if !fits {
            findings.push(error(
                field,
                text!("a number that cannot be"),
                Text::default(),
            ));
        }
    };
    let largest = rad_from_deg(LARGEST_NUMBER);
    let is_region = |region: &Region| {
        let (from, to) = (region.from_rad, region.to_rad);
        from < to && from.abs() <= largest && to.abs() <= largest
    };
    let tolerance = session.tolerance_mm;
    check(
        "targets",
        session.targets.iter().all(|t| is_place(&t.position_mm)),
    );
    check(
        "tolerance_mm",
        tolerance.is_none_or(|mm| mm > 0.0 && is_length(mm)),
    );
    check("regions", session.regions.iter().all(is_region));

    let own = &session.instrument;
    // Angles are read in millionths, with rounding.
    let is_sigma = |value: f64| (1e-7 * SMALLEST_SIGMA..=LARGEST_LENGTH_MM).contains(&value);
    let sigmas = match own.sigma_mm {
        Some(Sigma::Overall(sigma)) => vec![sigma],
        Some(Sigma::PerAxis(each)) => each.to_vec(),
        None => Vec::new(),
    };
    check("instrument.sigma_mm", sigmas.into_iter().all(is_sigma));
    for (field, sigma) in [
        ("instrument.targets_sigma_mm", own.targets_sigma_mm),
        ("instrument.sigma_orientation", own.sigma_orientation),
        ("instrument.sigma_distance_mm", own.sigma_distance_mm),
        ("instrument.sigma_direction", own.sigma_direction),
        ("instrument.sigma_touch_mm", own.sigma_touch_mm),
    ] {
        check(field, sigma.is_none_or(is_sigma));
    }
    let is_tracker = |t: Tracker| {
        is_sigma(t.sigma_range_mm) && is_sigma(t.sigma_angle) && is_place(&t.position_mm)
    };
    check("instrument.tracker", own.tracker.is_none_or(is_tracker));

    let all = &own.references;
    let is_known_place = |p: &Option<Point3<f64>>| p.as_ref().is_none_or(is_place);
    let is_unit = |norm: f64| (norm - 1.0).abs() <= 1e-6;
    let mut check =
        |field: &str, fits: bool| check(&format!("instrument.references.{field}"), fits);
    let offset = |anchor: &Anchor| anchor.offset_mm.is_none_or(is_length);
    let is_anchor = |anchor: &Anchor| is_known_place(&anchor.position_mm) && offset(anchor);
    check("anchors", all.anchors.iter().all(is_anchor));
    let is_station = |station: &Station| {
        let turn = station.attitude.as_ref();
        is_known_place(&station.position_mm) && turn.is_none_or(|q| is_unit(q.coords.norm()))
    };
    check("stations", all.stations.iter().all(is_station));
    let is_plane = |plane: &Plane| {
        let stated = plane.stated.as_ref();
        stated.is_none_or(|(normal, mm)| is_unit(normal.norm()) && is_length(*mm))
    };
    check("planes", all.planes.iter().all(is_plane));
    let mut sockets = all.sockets.iter();
    check("sockets", sockets.all(|s| is_known_place(&s.position_mm)));
    let mut distances = all.socket_distances.iter();
    check(
        "socket_distances",
        distances.all(|d| is_length(d.distance_mm)),
    );
    let pointing = all.pointing.as_ref();
    check("pointing", pointing.is_none_or(|p| is_unit(p.axis.norm())));
    findings
}

fn is_length(mm: f64) -> bool {
    mm.abs() <= LARGEST_LENGTH_MM
}

fn is_place(at: &Point3<f64>) -> bool {
    at.iter().all(|x| is_length(*x))
}
