//! A correction of some rows of a session: what went wrong for a time, in a setup, with a target.

use crate::text::Text;

use super::{Samples, Session, SessionCorrection, Setups};

/// Makes the correction in these rows. The others, and whatever is not of single rows, stay as they are.
pub(super) fn corrected(session: &mut Session, rows: &[(usize, usize)], by: &SessionCorrection) {
    if *by == SessionCorrection::FreeFrame {
        return seen_from_elsewhere(session, rows);
    }
    let mut changed = session.clone();
    by.apply(&mut changed);
    for (to, from) in columns(&mut session.samples)
        .into_iter()
        .zip(columns(&mut changed.samples))
    {
        for &(first, end) in rows {
            let end = end.min(to.len()).min(from.len());
            if first < end {
                to[first..end].copy_from_slice(&from[first..end]);
            }
        }
    }
}

/// Everything of a row that a correction of joints or of measured points may change.
fn columns(samples: &mut Samples) -> Vec<&mut Vec<f64>> {
    let Samples {
        q,
        q_read,
        dir,
        speed,
        torque_nm,
        x_mm,
        y_mm,
        z_mm,
        ..
    } = samples;
    let of_joints = [q_read, dir, speed, torque_nm].into_iter().flatten();
    q.iter_mut()
        .chain(of_joints.flatten())
        .chain([x_mm, y_mm])
        .chain(z_mm)
        .collect()
}

/// These rows are seen from another setup than the others: each of theirs becomes two.
fn seen_from_elsewhere(session: &mut Session, rows: &[(usize, usize)]) {
    if session.samples.setups.is_none() {
        SessionCorrection::FreeFrame.apply(session);
    }
    let Some(Setups { names, index }) = &mut session.samples.setups else {
        return;
    };
    let before = names.len();
    let mut new: Vec<Option<u32>> = vec![None; before];
    for &(first, end) in rows {
        for own in index.iter_mut().take(end).skip(first) {
            let of = *own as usize;
            let Some(Ok(next)) = (of < before).then(|| u32::try_from(names.len())) else {
                continue;
            };
            *own = *new[of].get_or_insert_with(|| {
                names.push(format!("{} (2)", names[of]));
                next
            });
        }
    }
}

/// Rows in ascending order as stretches, each from its first up to and without its second.
pub fn ranges(rows: &[usize]) -> Vec<(usize, usize)> {
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for &row in rows {
        match ranges.last_mut() {
            Some(last) if last.1 == row => last.1 += 1,
            _ => ranges.push((row, row + 1)),
        }
    }
    ranges
}

/// The rows for a person, counted from 1.
pub fn listed(rows: &[(usize, usize)]) -> Text {
    match rows {
        [(first, end)] if first + 1 == *end => text!("sample {sample}", sample = end),
        [(first, end)] => text!("samples {first} to {last}", first = first + 1, last = end),
        rows => text!(
            one "{count} sample",
            "{count} samples",
            count = rows.iter().map(|(first, end)| end - first).sum::<usize>()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::parse;

    fn session() -> Session {
        let document = serde_json::json!({
            "format": "truepose-session/1", "name": "s",
            "robot": { "name": "r", "joints": [
                { "name": "a", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
            ], "tool": { "position_mm": [300, 0, 100], "quaternion_wxyz": [1, 0, 0, 0] } },
            "samples": { "columns": { "q1_deg": [10, 20, 30, 40], "x_mm": [1, 2, 3, 4], "y_mm": [1, 1, 1, 1],
                "z_mm": [0, 0, 0, 0], "dir1": [1, 1, 1, 1] } },
        });
        parse(document.to_string().as_bytes())
            .expect("it is a session")
            .session
    }

    #[test]
    fn only_these_rows_are_corrected() {
        let in_rows = |by| SessionCorrection::InRows {
            rows: vec![(1, 2), (3, 9)],
            by: Box::new(by),
        };
        let mut now = session();
        in_rows(SessionCorrection::ScaleJoint {
            joint: 0,
            factor: -1.0,
        })
        .apply(&mut now);
        let degrees: Vec<f64> = now.samples.q[0]
            .iter()
            .map(|q| q.to_degrees().round())
            .collect();
        assert_eq!(degrees, [10.0, -20.0, 30.0, -40.0]);
        assert_eq!(now.samples.dir[0], Some(vec![1.0, -1.0, 1.0, -1.0]));
        in_rows(SessionCorrection::ScaleLengths(25.4)).apply(&mut now);
        assert_eq!(now.samples.x_mm, [1.0, 50.8, 3.0, 101.6]);
        in_rows(SessionCorrection::FreeFrame).apply(&mut now);
        let setups = now.samples.setups.expect("they are seen from two");
        assert_eq!(setups.index, [0, 1, 0, 1]);
        assert_eq!(setups.names, ["1", "1 (2)"]);
    }
}
