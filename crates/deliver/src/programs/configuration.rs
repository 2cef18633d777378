//! Numbers of a configuration that change where a corrected joint crosses a border.

use crate::kinematics::Robot;
use crate::kinematics::configuration::{Statement, quadrant_of, turns_of};

use super::edit::Edit;
use super::target::{Mark, Signs, Target};

/// What has to be written for a target's configuration at the corrected values.
pub(super) fn edits(target: &Target, robot: &Robot, q: &[f64]) -> Vec<Edit> {
    let agrees = |statement: &Statement| statement.agrees(robot, q) != Some(false);
    let still = |joint: u8| {
        let about = |s: &&Statement| match s {
            Statement::Quadrant { joint: j, .. }
            | Statement::Turns { joint: j, .. }
            | Statement::Negative { joint: j, .. } => *j == joint,
            _ => false,
        };
        target
            .posture()
            .configuration
            .iter()
            .filter(about)
            .all(agrees)
    };
    let edit = |mark: &Mark| match mark {
        Mark::Quadrant { span, joint } => (!still(*joint)).then(|| Edit {
            range: span.range(),
            text: quadrant_of(q[usize::from(*joint)]).to_string(),
        }),
        Mark::Turns { span, joint } => (!still(*joint)).then(|| Edit {
            range: span.range(),
            text: turns_of(q[usize::from(*joint)]).to_string(),
        }),
        Mark::Signs(signs) => {
            let Signs {
                range,
                joints,
                value,
                binary_digits,
            } = &**signs;
            let mut now = *value;
            for (bit, joint) in joints.iter().enumerate() {
                if let Some(joint) = joint
                    && !still(*joint)
                {
                    now ^= 1 << bit;
                }
            }
            (now != *value).then(|| Edit {
                range: range.clone(),
                text: match binary_digits {
                    0 => now.to_string(),
                    digits => format!("'B{now:0digits$b}'"),
                },
            })
        }
    };
    target.posture().marks.iter().filter_map(edit).collect()
}

/// Whether corrected values have left the sides that the target stated and the values before had.
pub(super) fn leaves_its_sides(
    target: &Target,
    robot: &Robot,
    before: &[f64],
    now: &[f64],
) -> bool {
    let sides = target
        .posture()
        .configuration
        .iter()
        .filter(|s| !s.is_certain());
    let mut left = sides.filter(|s| s.agrees(robot, before) == Some(true));
    left.any(|s| s.agrees(robot, now) == Some(false))
}
