//! A fingerprint of what was measured on which robot.
//!
//! A model carries it, so that a table can be traced to its samples. It is SHA-256 over a canonical
//! form: robot and samples in inner units, each column with its name and length, every number as
//! the eight bytes of its double, −0 as 0 and every missing value as the same NaN. The order of
//! columns in the file, their units as far as they round alike, inline or not, names and notes do
//! not matter; any change of a value does.

use sha2::{Digest, Sha256};

use crate::document::number::hexadecimal;
use crate::sessions::domain::{Samples, Session};
use crate::sessions::references::ObservedColumns;

/// The hash of a session's robot, targets and samples: 64 hexadecimal digits.
///
/// Samples that were corrected in memory keep the hash of what was read.
pub fn hash_of_samples(session: &Session) -> String {
    if let Some(corrected) = &session.samples.corrected {
        return corrected.raw_hash.clone();
    }
    let mut canonical = Canonical(Sha256::new());
    canonical.label("truepose-samples/1");
    robot(&mut canonical, session);
    samples(&mut canonical, &session.samples);
    hexadecimal(&canonical.0.finalize())
}

fn robot(canonical: &mut Canonical, session: &Session) {
    for joint in &session.robot.joints {
        canonical.label(joint.kind.name());
        canonical.numbers("axis", joint.axis.direction.as_slice());
        canonical.numbers("point", joint.axis.point_mm.coords.as_slice());
        if let Some(link) = &joint.link {
            canonical.numbers("mass", &[link.mass_kg]);
            canonical.numbers("centre", link.centre_mm.coords.as_slice());
        }
    }
    let tool = &session.robot.base_from_tool;
    let turn = tool.rotation.quaternion();
    canonical.numbers("tool", tool.translation.vector.as_slice());
    canonical.numbers("turn", &[turn.w, turn.i, turn.j, turn.k]);
    if let Some(gravity) = &session.robot.gravity_m_s2 {
        canonical.numbers("gravity", gravity.as_slice());
    }
    for target in &session.targets {
        canonical.numbers("target", target.position_mm.coords.as_slice());
    }
}

fn samples(canonical: &mut Canonical, samples: &Samples) {
    for q in &samples.q {
        canonical.numbers("q", q);
    }
    for (name, columns) in [
        ("q_read", &samples.q_read),
        ("dir", &samples.dir),
        ("speed", &samples.speed),
    ] {
        for column in columns {
            canonical.column(name, column.as_deref());
        }
    }
    // Columns that came later count where they are there, so that older hashes stay.
    for (name, columns) in [
        ("torque", &samples.torque_nm),
        ("joint temperature", &samples.joint_temperature_c),
    ] {
        for (joint, column) in columns.iter().enumerate() {
            if let Some(column) = column {
                canonical.numbers(&format!("{name} {joint}"), column);
            }
        }
    }
    canonical.numbers("x", &samples.x_mm);
    canonical.numbers("y", &samples.y_mm);
    canonical.column("z", samples.z_mm.as_deref());
    for part in samples.orientation_wxyz.iter().flatten() {
        canonical.numbers("orientation", part);
    }
    // What older sessions do not have leaves no trace in their hashes.
    observed(canonical, &samples.observed);
    canonical.column("load", samples.load_kg.as_deref());
    canonical.column("temperature", samples.temperature_c.as_deref());
    canonical.column("time", samples.time_s.as_deref());
    canonical.indices("target", samples.target.as_deref());
    let setups = samples
        .setups
        .as_ref()
        .map(|setups| setups.index.as_slice());
    canonical.indices("setup", setups);
    let held_out: Option<Vec<u32>> = samples.held_out.as_ref().map(|held_out| {
        held_out
            .iter()
            .map(|held_out| u32::from(*held_out))
            .collect()
    });
    canonical.indices("held out", held_out.as_deref());
    if let Some(excluded) = &samples.excluded {
        let excluded: Vec<u32> = excluded.iter().map(|out| u32::from(*out)).collect();
        canonical.indices("excluded", Some(&excluded));
    }
}

fn observed(canonical: &mut Canonical, observed: &ObservedColumns) {
    for column in observed.numbers() {
        if let Some(values) = column.values {
            canonical.numbers(column.label, values);
        }
    }
    for column in observed.names() {
        if let Some(values) = column.values {
            let index = values.iter().map(|i| i.map_or(0, |i| i + 1));
            canonical.indices(column.label, Some(&index.collect::<Vec<u32>>()));
        }
    }
}

/// Feeds the hash in an unambiguous form: name, length, values.
struct Canonical(Sha256);

impl Canonical {
    fn label(&mut self, label: &str) {
        self.0.update((label.len() as u64).to_le_bytes());
        self.0.update(label.as_bytes());
    }

    fn numbers(&mut self, name: &str, values: &[f64]) {
        self.label(name);
        self.0.update((values.len() as u64).to_le_bytes());
        let mut bytes = Vec::with_capacity(8 * values.len().min(4096));
        for chunk in values.chunks(4096) {
            bytes.clear();
            for &value in chunk {
                // Adding 0 turns −0 into 0.
                let value = if value.is_nan() {
                    f64::NAN
                } else {
                    value + 0.0
                };
                bytes.extend_from_slice(&value.to_bits().to_le_bytes());
            }
            self.0.update(&bytes);
        }
    }

    fn column(&mut self, name: &str, values: Option<&[f64]>) {
        match values {
            Some(values) => self.numbers(name, values),
            None => self.label("none"),
        }
    }

    fn indices(&mut self, name: &str, values: Option<&[u32]>) {
        let Some(values) = values else {
            return self.label("none");
        };
        self.label(name);
        self.0.update((values.len() as u64).to_le_bytes());
        for value in values {
            self.0.update(value.to_le_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::parse_with_csv;

    const DOCUMENT: &str = r#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":
        [{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
        "tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"samples":{"file":"s.csv"}}"#;

    fn hash(csv: &str) -> String {
        let loaded = parse_with_csv(DOCUMENT.as_bytes(), csv.as_bytes()).unwrap();
        hash_of_samples(&loaded.session)
    }

    #[test]
    fn the_hash_sees_values_and_not_how_they_are_written() {
        let plain = hash("q1_deg,x_mm,y_mm,load_kg\n0,250.0,1,\n");
        assert_eq!(plain, hash("y_mm,load_kg,x_m,q1_rad\r\n1.0,,0.25,-0\r\n"));
        assert_ne!(
            plain,
            hash("q1_deg,x_mm,y_mm,load_kg\n0,250.00000000000003,1,\n")
        );
        assert_ne!(plain, hash("q1_deg,x_mm,y_mm,load_kg\n0,250.0,1,0\n"));
        assert_ne!(plain, hash("q1_deg,x_mm,y_mm\n0,250.0,1\n"));
    }

    #[test]
    fn the_hash_is_the_same_in_every_version() {
        // From tests/reference/sample_hash.py.
        let known = "d89449f7a5134c413bfddc8e1b48d8c1acb6aa3ae05e3c22bb9fde24febcdc1d";
        assert_eq!(hash("q1_deg,x_mm,y_mm\n0,250,0\n90,0,250\n"), known);
    }
}
