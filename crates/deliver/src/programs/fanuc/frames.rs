//! `SYSFRAME.VA`: tools and user frames of a controller, as its backup lists them.
//!
//! ```text
//! [*SYSTEM*]$MNUTOOL  Storage: SHADOW  Access: RW  : ARRAY[4,29] OF POSITION
//!     [1,2] =
//!   Group: 1   Config: N D B, 0, 0, 0
//!   X:    12.500   Y:     0.000   Z:   240.000
//!   W:     0.000   P:    90.000   R:     0.000
//! ```
//!
//! The first number is the group, the second that of the tool (`$MNUTOOL`) or the user frame (`$MNUFRAME`).

use super::super::pose::Orientation;
use super::super::program::Program;
use super::super::referred::{BASE, TOOL};
use super::super::text::Text;
use crate::kinematics::Pose;

/// Declares what a backup that is read with the program says.
pub(super) fn declare(program: &mut Program, text: &Text) {
    let mut part = None;
    let mut entry = None;
    for line in text.lines() {
        let bytes = String::from_utf8_lossy(&text.bytes[line.clone()]);
        let mut words = bytes.split_whitespace();
        let Some(first) = words.next() else { continue };
        if let Some(name) = first.strip_prefix("[*SYSTEM*]") {
            part = match name {
                "$MNUTOOL" => Some((TOOL, "UT")),
                "$MNUFRAME" => Some((BASE, "UF")),
                _ => None,
            };
            entry = None;
        } else if part.is_some() && first.starts_with('[') {
            let number = first.strip_prefix("[1,").and_then(|n| n.strip_suffix(']'));
            entry = number.map(|number| (number.to_owned(), line.start, Vec::new()));
        } else if let (Some((part, short)), Some((number, at, values))) = (part, &mut entry)
            && matches!(first, "X:" | "W:")
        {
            values.extend(words.filter_map(|word| word.parse::<f64>().ok()));
            if let [x, y, z, w, p, r] = values[..]
                && let Some(turn) = Orientation::XyzFixedDegrees.read(&[w, p, r])
            {
                let pose = Pose::from_parts([x, y, z].into(), turn);
                program.declare(part, &format!("{short} {number}"), *at, Ok(pose));
            }
        }
    }
}
