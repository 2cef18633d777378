//! Accuracy and repeatability as the standards state them: a section for each axis and one for the poses.

use super::{Block, Section, cleaned};
use crate::present::standards::{Group, groups};
use crate::standards::Standards;

/// At most so many series of an axis, and what else there is to say.
pub(crate) fn standards(standards: &Standards, series: usize) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    let groups = groups(standards, series);
    // Joints of which nothing can be said for one reason stand together.
    let is_alike = |a: &Group, b: &Group| {
        let silent = a.rows.is_empty() && b.rows.is_empty();
        silent && a.standard == b.standard && a.missing == b.missing
    };
    for alike in groups.chunk_by(is_alike) {
        let titles: Vec<String> = alike.iter().map(|group| cleaned(&group.title)).collect();
        sections.push(of_group(&alike[0], &titles.join(", ")));
    }
    if !standards.notes.is_empty() {
        let notes = standards.notes.iter().map(cleaned).collect();
        sections.push(Section::new(say!("Notes"), vec![Block::List(notes)]));
    }
    sections
}

fn of_group(group: &Group, title: &str) -> Section {
    let mut blocks = Vec::new();
    if !group.rows.is_empty() {
        blocks.push(Block::Text(cleaned(&group.conditions)));
        blocks.push(Block::Table(group.table()));
    }
    if !group.missing.is_empty() {
        blocks.push(Block::List(group.missing.iter().map(cleaned).collect()));
    }
    Section::new(format!("{title}, {}", group.standard), blocks)
}
