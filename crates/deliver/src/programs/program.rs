//! What a reader finds in a file as a whole: its targets, and the frames, tools and loads that hold for them.

use std::collections::BTreeMap;

use super::referred::{FrameToolPairs, Names};
use super::stated_load::StatedLoads;
use super::target::{Outside, Remark, Target};

/// A file with its targets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// In the order of the file.
    pub targets: Vec<Target>,
    /// The targets in the order in which the file's motions name them, as far as it names them.
    pub visits: Vec<usize>,
    /// Motions and values that the file computes at run time, or takes from elsewhere: not corrected.
    pub at_run_time: Vec<Remark>,
    /// What else there is to know.
    pub notes: Vec<Remark>,
    /// In which frames and with which tools motions go to the targets.
    pub(super) ways: FrameToolPairs,
    /// Loads that the file states.
    pub(super) loads: StatedLoads,
    /// Frames that the file declares, in the robot's base.
    pub(super) frames: Names,
    /// Tools that the file declares, on the flange.
    pub(super) tools: Names,
    /// External axes that the model does not have, as targets say where they are; each way once.
    pub(super) outside: Vec<Outside>,
    outside_index: BTreeMap<[Option<u64>; 6], u32>,
}

impl Program {
    /// Puts the targets that are kept into the order of the file.
    pub(super) fn sorted(&mut self, kept: &[bool]) {
        let mut order: Vec<usize> = (0..self.targets.len()).filter(|k| kept[*k]).collect();
        order.sort_by_key(|k| self.targets[*k].at);
        let mut place = vec![usize::MAX; kept.len()];
        for (now, before) in order.iter().enumerate() {
            place[*before] = now;
        }
        let mut keep = kept.iter();
        self.targets.retain(|_| keep.next() == Some(&true));
        self.targets.sort_by_key(|target| target.at);
        self.visits.retain(|index| kept[*index]);
        for index in &mut self.visits {
            *index = place[*index];
        }
    }

    /// The number of a way in which external axes are that the model does not have; 0: none is said.
    pub(super) fn outside(&mut self, axes: Outside) -> u32 {
        if axes == Outside::default() {
            return 0;
        }
        let key = axes.map(|axis| axis.map(f64::to_bits));
        *self.outside_index.entry(key).or_insert_with(|| {
            self.outside.push(axes);
            u32::try_from(self.outside.len()).unwrap_or(0)
        })
    }

    /// Every target in the order in which they are gone to: as the motions name them, the others
    /// after them in the order of the file.
    pub(super) fn order(&self) -> Vec<usize> {
        let mut seen = vec![false; self.targets.len()];
        let all = self.visits.iter().copied().chain(0..self.targets.len());
        all.filter(|k| !std::mem::replace(&mut seen[*k], true))
            .collect()
    }
}
