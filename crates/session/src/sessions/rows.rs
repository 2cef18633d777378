//! Samples taken away from, or put behind, others: every column at once, so that they stay as long
//! as each other.

use super::domain::{Samples, Session, Setups, UnknownColumn};
use super::references::ObservedColumns;
use crate::tables::Lines;

impl Samples {
    /// Takes samples away; `rows` count from 0, in any order. Rows that are not there are passed
    /// over. Lines stay those of the file.
    pub fn remove(&mut self, rows: &[usize]) {
        let mut kept: Vec<Option<usize>> = (0..self.len()).map(Some).collect();
        for &row in rows {
            if let Some(kept) = kept.get_mut(row) {
                *kept = None;
            }
        }
        kept.retain(Option::is_some);
        self.select(&kept);
    }

    /// These samples in this order, which count from 0; where there is none an empty one, measured of the
    /// first target and in the first setup.
    #[doc(hidden)]
    pub fn select(&mut self, rows: &[Option<usize>]) {
        *self = self.selected(rows);
    }

    /// The same of samples that stay: a few of many are taken without a copy of all.
    pub(crate) fn selected(&self, rows: &[Option<usize>]) -> Self {
        let numbers = |column: &Vec<f64>| picked(column, rows, f64::NAN);
        let perhaps = |column: &Option<Vec<f64>>| column.as_ref().map(numbers);
        let columns = |columns: &[Option<Vec<f64>>]| columns.iter().map(perhaps).collect();
        let names = |column: &Option<Vec<Option<u32>>>| {
            let column = column.as_ref();
            column.map(|column| picked(column, rows, None))
        };
        let marks = |column: &Option<Vec<bool>>| {
            let column = column.as_ref();
            column.map(|column| picked(column, rows, false))
        };
        let mut line = Lines::default();
        if !self.line.is_empty() {
            for row in rows {
                line.add(row.and_then(|row| self.line.get(row)).unwrap_or(0), 1);
            }
        }
        let observed = &self.observed;
        Self {
            q: self.q.iter().map(numbers).collect(),
            q_read: columns(&self.q_read),
            x_mm: numbers(&self.x_mm),
            y_mm: numbers(&self.y_mm),
            z_mm: perhaps(&self.z_mm),
            orientation_wxyz: self
                .orientation_wxyz
                .as_ref()
                .map(|parts| parts.each_ref().map(numbers)),
            observed: ObservedColumns {
                distance_mm: perhaps(&observed.distance_mm),
                anchor: names(&observed.anchor),
                azimuth: perhaps(&observed.azimuth),
                elevation: perhaps(&observed.elevation),
                station: names(&observed.station),
                plane: names(&observed.plane),
                socket: names(&observed.socket),
            },
            target: self.target.as_ref().map(|all| picked(all, rows, 0)),
            dir: columns(&self.dir),
            speed: columns(&self.speed),
            torque_nm: columns(&self.torque_nm),
            joint_temperature_c: columns(&self.joint_temperature_c),
            load_kg: perhaps(&self.load_kg),
            temperature_c: perhaps(&self.temperature_c),
            time_s: perhaps(&self.time_s),
            setups: self.setups.as_ref().map(|setups| Setups {
                names: setups.names.clone(),
                index: picked(&setups.index, rows, 0),
            }),
            held_out: marks(&self.held_out),
            excluded: marks(&self.excluded),
            corrected: self.corrected.clone(),
            unknown: self
                .unknown
                .iter()
                .map(|column| UnknownColumn {
                    name: column.name.clone(),
                    cells: picked(&column.cells, rows, String::new()),
                })
                .collect(),
            line,
        }
    }
}

fn picked<T: Clone>(column: &[T], rows: &[Option<usize>], empty: T) -> Vec<T> {
    let one = |row: &Option<usize>| {
        row.and_then(|row| column.get(row))
            .unwrap_or(&empty)
            .clone()
    };
    rows.iter().map(one).collect()
}

impl Session {
    /// The session with some of its samples; see [`Samples::selected`].
    #[doc(hidden)]
    #[must_use]
    pub fn of_rows(&self, rows: &[Option<usize>]) -> Self {
        Self {
            name: self.name.clone(),
            note: self.note.clone(),
            robot: self.robot.clone(),
            targets: self.targets.clone(),
            instrument: self.instrument.clone(),
            tolerance_mm: self.tolerance_mm,
            regions: self.regions.clone(),
            compensated_by: self.compensated_by.clone(),
            samples: self.samples.selected(rows),
            path: self.path.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::sessions::{Samples, parse_with_csv};

    const HEAD: &str = "q1_deg,x_mm,y_mm,z_mm,dir1,target,time_s,setup,use,operator\n";
    const ROWS: [&str; 4] = [
        "1,2,3,4,1,T1,0,a,fit,Ann\n",
        "2,,3,4,-1,T2,1,b,held-out,\n",
        "3,2,3,,0,T1,,a,fit,Bob\n",
        "4,2,3,4,1,T2,3,c,fit,Ann\n",
    ];

    fn samples(rows: &[&str]) -> Samples {
        let document = br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[{"name":"pan",
            "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
            "targets":{"T1":[0,0,0],"T2":[1,2,3]},"samples":{"file":"s.csv"}}"#;
        let csv = format!("{HEAD}{}", rows.concat());
        let mut samples = parse_with_csv(document, csv.as_bytes())
            .unwrap()
            .session
            .samples;
        samples.line = crate::sessions::Lines::default();
        samples
    }

    /// NaN equals NaN here.
    fn same(a: &Samples, b: &Samples) -> bool {
        format!("{a:?}") == format!("{b:?}")
    }

    #[test]
    fn removed_samples_leave_the_others_as_they_were() {
        let mut left = samples(&ROWS);
        left.remove(&[3, 1, 99]);
        let mut expected = samples(&[ROWS[0], ROWS[2]]);
        // Setups keep their names although some are empty now.
        expected.setups.as_mut().unwrap().names = vec!["a".into(), "b".into(), "c".into()];
        assert!(same(&left, &expected), "{left:?}");
    }

    #[test]
    fn lines_of_the_file_stay_with_their_samples() {
        let document = br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[{"name":"pan",
            "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
            "samples":{"file":"s.csv"}}"#;
        let csv = b"q1_deg,x_mm,y_mm\n1,2,3\n\n2,2,3\n3,2,3\n";
        let mut samples = parse_with_csv(document, csv).unwrap().session.samples;
        samples.remove(&[1]);
        assert_eq!(samples.line.get(0), Some(2));
        assert_eq!(samples.line.get(1), Some(5));
    }
}
