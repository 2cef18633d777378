//! Bytes replaced in place.

use std::ops::Range;

use crate::kinematics::Robot;

use super::convention::Convention;
use super::edit::Edit;
use super::target::{Shape, Target};

/// The edits that put corrected joint values into a target.
pub(super) fn edits(
    target: &Target,
    robot: &Robot,
    convention: Convention<'_>,
    q: &[f64],
) -> Vec<Edit> {
    let mut raw = q.to_vec();
    convention.to_raw(&mut raw);
    let numbers: Vec<(&super::Number, f64, usize)> = match &target.shape {
        Shape::Joints {
            numbers,
            scales: inner,
            decimals,
        } => {
            let values = numbers.iter().zip(inner.iter()).zip(&raw);
            let values = values.map(|((number, inner), q)| (number, q / inner, *decimals));
            values.collect()
        }
        Shape::Pose(frame) => frame.values(&target.placed.written(&robot.base_from_tool(q))),
    };
    let mut edits = Vec::new();
    for (number, value, decimals) in numbers {
        let Some(text) = number.written(value, decimals) else {
            continue;
        };
        let Range { start, end } = number.range();
        if let Some(digits) = number.detached_digits() {
            // What stands between sign and digits, a line break perhaps, stays.
            let unsigned = text.trim_start_matches('-');
            let (sign, text) = text.split_at(text.len() - unsigned.len());
            edits.extend([(start..start + 1, sign), (digits..end, text)].map(Edit::new));
        } else {
            edits.push(Edit::new((start..end, &text)));
        }
    }
    edits.extend(super::configuration::edits(target, robot, q));
    edits
}

/// The file with its edits, which come target by target; they must not overlap, and targets do not lie in
/// each other.
pub(super) fn applied(bytes: &[u8], targets: impl Iterator<Item = Vec<Edit>>) -> Vec<u8> {
    let mut written = Vec::with_capacity(bytes.len() + bytes.len() / 4);
    let mut at = 0;
    for mut edits in targets {
        edits.sort_by_key(|edit| edit.range.start);
        for edit in edits {
            written.extend_from_slice(&bytes[at..edit.range.start]);
            written.extend_from_slice(edit.text.as_bytes());
            at = edit.range.end;
        }
    }
    written.extend_from_slice(&bytes[at..]);
    written.shrink_to_fit();
    written
}
