//! The columns of a session as they go into a file: headings, and values in outer units.

use serde::Serialize;
use serde::ser::{SerializeSeq, Serializer};

use crate::document::degrees;
use crate::kinematics::JointKind;
use crate::sessions::domain::{Session, Setups, Target};
use crate::sessions::references::References;

/// From an inner to an outer unit.
type Conversion = fn(f64) -> f64;

/// A heading and its cells.
pub(crate) struct Column<'a> {
    pub(crate) name: String,
    pub(crate) values: Values<'a>,
}

/// The cells of a column.
#[derive(Clone, Copy)]
pub(crate) enum Values<'a> {
    /// NaN is an empty cell; `outside` makes outer units of inner ones.
    Numbers {
        values: &'a [f64],
        outside: Conversion,
    },
    Targets(&'a [u32], &'a [Target]),
    Setups(&'a Setups),
    /// Held out, and excluded.
    Use([Option<&'a [bool]>; 2]),
    Text(&'a [String]),
    /// Indices into what the session declares; nothing is an empty cell.
    References(&'a [Option<u32>], &'a References, NameOf),
}

/// The name of what stands at an index.
type NameOf = fn(&References, usize) -> &str;

impl<'a> Values<'a> {
    /// Numbers whose outer unit is the inner one.
    fn plain(values: &'a [f64]) -> Self {
        Self::Numbers {
            values,
            outside: |value| value,
        }
    }

    /// A cell that is not a number.
    pub(crate) fn text(self, row: usize) -> &'a str {
        match self {
            Self::Numbers { .. } => "",
            Self::Targets(index, targets) => targets
                .get(index[row] as usize)
                .map_or("", |target| &target.name),
            Self::Setups(setups) => setups
                .names
                .get(setups.index[row] as usize)
                .map_or("", String::as_str),
            Self::Use(marks) => match marks.map(|all| all.is_some_and(|all| all[row])) {
                [false, false] => "fit",
                [true, false] => "held-out",
                [false, true] => "excluded",
                [true, true] => "held-out-excluded",
            },
            Self::Text(cells) => &cells[row],
            Self::References(index, all, name) => {
                index[row].map_or("", |index| name(all, index as usize))
            }
        }
    }

    fn len(self) -> usize {
        match self {
            Self::Numbers { values, .. } => values.len(),
            Self::Targets(index, _) => index.len(),
            Self::Setups(setups) => setups.index.len(),
            Self::Use(uses) => uses.into_iter().flatten().next().map_or(0, <[bool]>::len),
            Self::Text(cells) => cells.len(),
            Self::References(index, ..) => index.len(),
        }
    }
}

impl Serialize for Values<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.len()))?;
        for row in 0..self.len() {
            match self {
                Self::Numbers { values, .. } if values[row].is_nan() => list.serialize_element(&()),
                Self::Numbers { values, outside } => list.serialize_element(&outside(values[row])),
                other => list.serialize_element(other.text(row)),
            }?;
        }
        list.end()
    }
}

/// Columns that are being collected.
struct Columns<'a>(Vec<Column<'a>>);

impl<'a> Columns<'a> {
    fn add(&mut self, name: String, values: Values<'a>) {
        self.0.push(Column { name, values });
    }
}

/// Columns of measurements other than points.
fn observed<'a>(session: &'a Session, columns: &mut Columns<'a>) {
    let own = &session.samples.observed;
    let all = &session.instrument.references;
    let plain: Conversion = |value| value;
    let numbers: [(&str, _, Conversion); 3] = [
        ("distance_mm", &own.distance_mm, plain),
        ("azimuth_deg", &own.azimuth, degrees),
        ("elevation_deg", &own.elevation, degrees),
    ];
    for (name, values, outside) in numbers {
        if let Some(values) = values {
            columns.add(name.to_owned(), Values::Numbers { values, outside });
        }
    }
    let names: [(&str, _, NameOf); 4] = [
        ("anchor", &own.anchor, |all, i| &all.anchors[i].name),
        ("station", &own.station, |all, i| &all.stations[i].name),
        ("plane", &own.plane, |all, i| &all.planes[i].name),
        ("socket", &own.socket, |all, i| &all.sockets[i].name),
    ];
    for (name, index, name_of) in names {
        if let Some(index) = index {
            columns.add(name.to_owned(), Values::References(index, all, name_of));
        }
    }
}

/// Every column of the session, in the order of the contract.
pub(crate) fn columns(session: &Session) -> Vec<Column<'_>> {
    let samples = &session.samples;
    let mut columns = Columns(Vec::new());
    let plain: Conversion = |value| value;
    let joints: Vec<(&str, Conversion)> = session
        .robot
        .joints
        .iter()
        .map(|joint| match joint.kind {
            JointKind::Revolute => ("deg", degrees as Conversion),
            JointKind::Prismatic => ("mm", plain),
        })
        .collect();
    for (i, (values, &(unit, outside))) in samples.q.iter().zip(&joints).enumerate() {
        columns.add(
            format!("q{}_{unit}", i + 1),
            Values::Numbers { values, outside },
        );
    }
    for (i, (values, &(unit, outside))) in samples.q_read.iter().zip(&joints).enumerate() {
        if let Some(values) = values {
            columns.add(
                format!("q{}_read_{unit}", i + 1),
                Values::Numbers { values, outside },
            );
        }
    }
    // A session of other measurements has no points at all.
    let points = [&samples.x_mm, &samples.y_mm];
    let points = points.into_iter().chain(&samples.z_mm);
    let measured = points.flatten().any(|v| !v.is_nan());
    let other = !samples.observed.is_empty() || samples.orientation_wxyz.is_some();
    let has_points = measured || !other;
    if has_points {
        columns.add("x_mm".to_owned(), Values::plain(&samples.x_mm));
        columns.add("y_mm".to_owned(), Values::plain(&samples.y_mm));
    }
    if let Some(z_mm) = samples.z_mm.as_ref().filter(|_| has_points) {
        columns.add("z_mm".to_owned(), Values::plain(z_mm));
    }
    if let Some(parts) = &samples.orientation_wxyz {
        for (name, values) in ["qw", "qx", "qy", "qz"].into_iter().zip(parts) {
            columns.add(name.to_owned(), Values::plain(values));
        }
    }
    observed(session, &mut columns);
    if let Some(target) = &samples.target {
        columns.add(
            "target".to_owned(),
            Values::Targets(target, &session.targets),
        );
    }
    for (i, values) in samples.dir.iter().enumerate() {
        if let Some(values) = values {
            columns.add(format!("dir{}", i + 1), Values::plain(values));
        }
    }
    for (i, (values, &(unit, outside))) in samples.speed.iter().zip(&joints).enumerate() {
        if let Some(values) = values {
            columns.add(
                format!("speed{}_{unit}_s", i + 1),
                Values::Numbers { values, outside },
            );
        }
    }
    for (of_joints, name, unit) in [
        (&samples.torque_nm, "torque", "nm"),
        (&samples.joint_temperature_c, "temperature", "c"),
    ] {
        for (i, values) in of_joints.iter().enumerate() {
            if let Some(values) = values {
                columns.add(format!("{name}{}_{unit}", i + 1), Values::plain(values));
            }
        }
    }
    for (name, values) in [
        ("load_kg", &samples.load_kg),
        ("temperature_c", &samples.temperature_c),
        ("time_s", &samples.time_s),
    ] {
        if let Some(values) = values {
            columns.add(name.to_owned(), Values::plain(values));
        }
    }
    if let Some(setups) = &samples.setups {
        columns.add("setup".to_owned(), Values::Setups(setups));
    }
    let uses = [samples.held_out.as_deref(), samples.excluded.as_deref()];
    if uses.iter().any(Option::is_some) {
        columns.add("use".to_owned(), Values::Use(uses));
    }
    for column in &samples.unknown {
        columns.add(column.name.clone(), Values::Text(&column.cells));
    }
    columns.0
}
