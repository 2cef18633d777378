//! What became of a machine: its sessions and models in their order, and what changed.

use super::{Block, Section};
use crate::history::{Order, RobotHistory};
use crate::present::history::entries;

/// The section of one robot.
#[doc(hidden)]
pub fn history(robot: &RobotHistory) -> Section {
    let how = match robot.ordered_by {
        Order::Time => say!(
            "Every session is identified in the same way (full model with its usual effects), by the time of the first sample"
        ),
        Order::Name => say!(
            "Every session is identified in the same way (full model with its usual effects), by file name, numbers in it by their value"
        ),
    };
    let changed = say!(
        "Changed by: the difference since the one before with half its 95 % interval, where it is larger than that"
    );
    let blocks = vec![
        Block::text(how),
        Block::Table(entries(robot)),
        Block::text(changed),
    ];
    Section::new(robot.robot.clone(), blocks)
}
