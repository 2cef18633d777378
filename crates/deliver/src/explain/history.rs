//! What became of a machine: its sessions and models in their order, what changed, its parameters side by side.

use super::{Block, Detail, Section};
use crate::history::Order;
use crate::history::RobotHistory;
use crate::present::history::{CHANGED, entries, parameters};

/// Sessions whose values stand side by side on a page.
const MOST: usize = 4;

/// The section of one robot.
#[doc(hidden)]
pub fn history(robot: &RobotHistory, detail: Detail) -> Section {
    let last = robot.entries.len();
    let shown: Vec<usize> = (last.saturating_sub(MOST)..last).collect();
    let blocks = vec![
        Block::Text(
            match robot.ordered_by {
                Order::Time => say!(
                    "Every session is identified in the same way (full model with its usual effects), by the time of the first sample"
                ),
                Order::Name => say!(
                    "Every session is identified in the same way (full model with its usual effects), by file name, numbers in it by their value"
                ),
            }
            .to_owned(),
        ),
        Block::Table(entries(robot)),
        Block::Text(say!(
            "Parameters of the last {shown} with half their 95 % intervals; {mark}: changed by more than the interval of the difference since the one before",
            shown = shown.len(),
            mark = CHANGED
        )),
        Block::Table(parameters(robot, &shown)),
    ];
    // A report is about one robot, which it names before; the terminal lists all of a folder.
    let title = if detail.brief {
        robot.robot.clone()
    } else {
        say!("History of the machine").to_owned()
    };
    Section::new(title, blocks)
}
