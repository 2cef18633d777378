//! Which frames and tools the poses of a program refer to.

use std::collections::BTreeSet;

use super::program::Program;
use super::referred::FrameAndTool;
use super::target::Shape;

/// The ways in which motions go to poses, and to targets of joint values.
pub(super) struct Used<'p> {
    /// Of poses.
    pub(super) poses: Vec<&'p FrameAndTool>,
    /// Of joint values.
    pub(super) joints: Vec<&'p FrameAndTool>,
}

impl<'p> Used<'p> {
    pub(super) fn of(program: &'p Program) -> Self {
        let mut used = [BTreeSet::new(), BTreeSet::new()];
        for target in program
            .targets
            .iter()
            .filter(|target| target.left.is_none())
        {
            let which = usize::from(matches!(target.shape, Shape::Joints { .. }));
            used[which].extend(target.ways.iter());
        }
        let [poses, joints] = used.map(|used| {
            let ways = used.into_iter().map(|way| program.ways.get(way));
            ways.collect()
        });
        Self { poses, joints }
    }
}
