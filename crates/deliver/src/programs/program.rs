//! What a reader finds in a file as a whole: its targets, and the frames, tools and loads that hold for them.

use crate::text::Argument;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use super::referred::{Declared, Names, Referred, TOOL, Way, Ways};
use super::stated_load::StatedLoads;
use super::target::{Outside, Remark, Target};
use crate::kinematics::Pose;
use crate::text::Text;

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
    pub(super) ways: Ways,
    /// Loads that the file states.
    pub(super) loads: StatedLoads,
    /// Where the controller's own base is in the robot's base.
    pub(super) base_from_world: Pose,
    /// Frames that the file declares, in the controller's base, and tools, on the flange.
    pub(super) declared: [Names; 2],
    /// External axes that the model does not have, as targets say where they are; each way once.
    pub(super) outside: Vec<Outside>,
    outside_index: BTreeMap<[Option<u64>; 6], u32>,
}

impl Program {
    /// Keeps the declaration of a frame or a tool; of a name that is declared twice differently nothing is known.
    pub(super) fn declare(
        &mut self,
        part: usize,
        spelled: &str,
        at: usize,
        pose: Result<Pose, Text>,
    ) -> &mut Declared {
        match self.declared[part].entry(spelled.to_lowercase()) {
            Entry::Vacant(own) => own.insert(Declared::new(at, pose)),
            Entry::Occupied(known) => {
                let known = known.into_mut();
                if known.pose != pose {
                    known.pose = Err(text!("{spelled} is declared several times", spelled));
                }
                known
            }
        }
    }

    /// Declares the language's own name for the flange.
    pub(super) fn declare_no_tool(&mut self, spelled: &str) {
        self.declare(TOOL, spelled, 0, Ok(Pose::identity())).is_none = true;
    }

    /// What the file declares of a frame or a tool.
    pub(super) fn declaration(&self, part: usize, referred: &Referred) -> Option<&Declared> {
        match referred {
            Referred::Named(name) => self.declared[part].get(&**name),
            _ => None,
        }
    }

    /// The ways in which motions go to poses, and to targets of joint values.
    pub(super) fn used(&self) -> [Vec<&Way>; 2] {
        let mut used = [BTreeSet::new(), BTreeSet::new()];
        for target in self.targets.iter().filter(|target| target.left.is_none()) {
            used[usize::from(!target.is_pose())].extend(target.ways.iter());
        }
        used.map(|used| used.into_iter().map(|way| self.ways.get(way)).collect())
    }

    /// Leaves out what is no target, and puts the others into the order of the file.
    pub(super) fn sort(&mut self) {
        let kept = |k: &usize| !self.targets[*k].is_none;
        let mut order: Vec<usize> = (0..self.targets.len()).filter(kept).collect();
        order.sort_by_key(|k| self.targets[*k].at);
        let mut place = vec![None; self.targets.len()];
        for (now, before) in order.into_iter().enumerate() {
            place[before] = Some(now);
        }
        self.targets.retain(|target| !target.is_none);
        self.targets.sort_by_key(|target| target.at);
        let visits = self.visits.iter().filter_map(|k| place[*k]);
        self.visits = visits.collect();
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

/// What is said of a value that the file does not write out in numbers.
pub(super) fn not_in_numbers(spelled: impl Into<Argument>) -> crate::text::Text {
    let spelled: Argument = spelled.into();
    text!(
        "{spelled} is computed at run time, or has its values elsewhere",
        spelled
    )
}
