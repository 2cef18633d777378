//! Which targets the motions of a program go to, in which frame and with which tool.

use std::collections::BTreeMap;

use super::frames::{Referred, Use};
use super::target::{Program, Remark, Target};

/// What a motion goes to.
pub(super) enum Goal {
    /// A target that stands in the motion, by its index.
    Inline(usize),
    /// A target by its name, and how that is spelled.
    Named(String, String),
    /// A name that the goal is worked out from at run time.
    Mentioned(String),
}

/// One motion.
pub(super) struct Move {
    pub(super) at: usize,
    pub(super) goal: Goal,
    pub(super) frame: Referred,
    pub(super) tool: Referred,
}

/// The targets of a program by name, and its motions in the order of the file.
#[derive(Default)]
pub(super) struct Moves {
    by_name: BTreeMap<String, Vec<usize>>,
    all: Vec<Move>,
    /// Names that something is assigned to at run time, how they are spelled, and where.
    changed: Vec<(String, String, usize)>,
}

impl Moves {
    /// Keeps a target under its name, as motions name it; its index.
    pub(super) fn target(
        &mut self,
        program: &mut Program,
        name: Option<&str>,
        target: Target,
    ) -> usize {
        program.targets.push(target);
        let index = program.targets.len() - 1;
        if let Some(name) = name {
            self.by_name.entry(name.to_owned()).or_default().push(index);
        }
        index
    }

    pub(super) fn push(&mut self, at: usize, goal: Goal, frame: Referred, tool: Referred) {
        self.all.push(Move {
            at,
            goal,
            frame,
            tool,
        });
    }

    /// A name that is assigned to at run time.
    pub(super) fn changed(&mut self, spelled: String, at: usize) {
        self.changed.push((spelled.to_lowercase(), spelled, at));
    }

    /// The program with its visits, the frames that its targets are used in, and what is not corrected.
    /// `elsewhere`: what there is to say of a name that the file gives no values.
    pub(super) fn finish(self, mut program: Program, elsewhere: &str) -> Program {
        let mut visits = Vec::new();
        for one in self.all {
            let targets: Vec<usize> = match &one.goal {
                Goal::Inline(index) => {
                    visits.push(*index);
                    vec![*index]
                }
                Goal::Named(name, spelled) => match self.by_name.get(name).map(Vec::as_slice) {
                    Some([index]) => {
                        visits.push(*index);
                        vec![*index]
                    }
                    // An array, or a name that is given several values.
                    Some(several) => several.to_vec(),
                    None => {
                        let says = format!("{spelled} {elsewhere}");
                        program.at_run_time.push(Remark { at: one.at, says });
                        Vec::new()
                    }
                },
                Goal::Mentioned(name) => self.by_name.get(name).cloned().unwrap_or_default(),
            };
            program.uses.extend(targets.into_iter().map(|target| Use {
                target,
                frame: one.frame.clone(),
                tool: one.tool.clone(),
            }));
        }
        program.visits.extend(visits);
        for (name, spelled, at) in self.changed {
            if self.by_name.contains_key(&name) {
                let says = format!("{spelled} is changed at run time");
                program.at_run_time.push(Remark { at, says });
            }
            let unknown = || Err(format!("{spelled} is changed at run time"));
            for declared in [&mut program.frames, &mut program.tools] {
                if let Some(declared) = declared.get_mut(&name) {
                    declared.pose = unknown();
                }
            }
        }
        program
    }
}
