//! Accuracy and repeatability as the standards state them: a section for each axis and one for the poses.

use super::{Block, Section, cleaned};
use crate::present::standards::{Group, groups};
use crate::standards::Standards;

/// At most so many series of an axis, and what else there is to say.
#[doc(hidden)]
pub fn standards(standards: &Standards, series: usize) -> Vec<Section> {
    let mut sections: Vec<Section> = groups(standards, series).iter().map(of_group).collect();
    if !standards.notes.is_empty() {
        let notes = standards.notes.iter().map(cleaned).collect();
        sections.push(Section::new(say!("Notes"), vec![Block::List(notes)]));
    }
    sections
}

fn of_group(group: &Group) -> Section {
    let mut blocks = Vec::new();
    if !group.rows.is_empty() {
        blocks.push(Block::Text(cleaned(&group.conditions)));
        blocks.push(Block::Table(group.table()));
    }
    if !group.missing.is_empty() {
        blocks.push(Block::List(group.missing.iter().map(cleaned).collect()));
    }
    let title = format!("{}, {}", cleaned(&group.title), group.standard);
    Section::new(title, blocks)
}
