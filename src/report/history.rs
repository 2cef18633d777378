//! What became of the robot since its earlier sessions.

use super::document::{Block, Section};
use crate::history::History;
use crate::present::history::{CHANGED, chart, entries, ordered_by, parameters, rows};

/// Sessions whose values stand side by side on a page.
const MOST: usize = 4;
/// Parameters that are charted: those that changed.
const CHARTS: usize = 3;

/// The section of the robot of this name, if the folder has one.
pub(super) fn section(history: &History, robot: &str) -> Option<Section> {
    let robot = history.robots.iter().find(|one| one.robot == robot)?;
    let last = robot.entries.len();
    let shown: Vec<usize> = (last.saturating_sub(MOST)..last).collect();
    let mut blocks = vec![
        Block::Text(say!(
            "Every session is identified in the same way (full model with its usual effects), {order}",
            order = ordered_by(robot.ordered_by)
        )),
        Block::Table(entries(robot)),
        Block::Text(say!(
            "Parameters of the last {shown} with half their 95 % intervals; {mark}: changed by more than the interval of the difference since the one before",
            shown = shown.len(),
            mark = CHANGED
        )),
        Block::Table(parameters(robot, &shown)),
    ];
    let rows = rows(robot);
    let changed = rows
        .iter()
        .filter(|row| row.values.iter().flatten().any(|value| value.changed));
    for row in changed.take(CHARTS) {
        let drawing = chart(robot, row).in_page(150.0);
        blocks.push(Block::Plot(
            drawing,
            say!("{parameter} over the sessions", parameter = row.name),
        ));
    }
    Some(Section::new(say!("History of the machine"), blocks))
}
