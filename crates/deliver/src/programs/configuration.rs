//! Numbers of a configuration that change where a corrected joint crosses a border.

use crate::kinematics::Robot;
use crate::kinematics::configuration::{Statement, quadrant_of, turns_of};

use super::edit::Edit;
use super::target::{Mark, Target};

/// What has to be written for a target's configuration at the corrected values.
pub(super) fn edits(target: &Target, robot: &Robot, q: &[f64]) -> Vec<Edit> {
    let stated = &target.posture().configuration;
    let crossed = |statement: &Statement| statement.agrees(robot, q) == Some(false);
    let edit = |mark: &Mark| match *mark {
        Mark::Of(index, span) => {
            let text = match &stated[index] {
                statement if !crossed(statement) => return None,
                Statement::Quadrant { joint, .. } => quadrant_of(q[usize::from(*joint)]),
                Statement::Turns { joint, .. } => turns_of(q[usize::from(*joint)]),
                _ => return None,
            };
            Some(Edit::new((span.range(), &text.to_string())))
        }
        Mark::Signs {
            span,
            value,
            binary_digits: digits,
        } => {
            let signs = stated
                .iter()
                .filter(|s| matches!(s, Statement::Negative { .. }));
            let changed = signs
                .enumerate()
                .filter(|(_, statement)| crossed(statement));
            let now = changed.fold(value, |now, (bit, _)| now ^ 1 << bit);
            let text = match digits {
                0 => now.to_string(),
                digits => format!("'B{now:0digits$b}'"),
            };
            (now != value).then(|| Edit::new((span.range(), &text)))
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
