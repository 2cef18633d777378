//! Which targets the motions of a program go to, in which frame and with which tool.
//!
//! A name may have many values and many motions: what the motions say of it is kept once for the name,
//! not once for every pair of a motion and a value, so that the work grows with the file and not with
//! its square.

use crate::text::Text;
use std::collections::BTreeMap;

use super::program::Program;
use super::referred::{FrameAndTool, Referred, UsedPairs};
use super::target::{Remark, Target};

/// What a motion goes to.
pub(super) enum Goal {
    /// A target that stands in the motion, by its index.
    Inline(usize),
    /// A target by its name, and how that is spelled.
    Named(String, String),
    /// A name that the goal is worked out from at run time.
    Mentioned(String),
}

/// One motion to a name.
struct Move {
    at: usize,
    /// The name in [`Moves::names`].
    name: usize,
    /// Whether the goal is only worked out from the name.
    mentioned: bool,
    /// How the name is spelled, where the file has not given it values before.
    spelled: Option<Box<str>>,
}

/// What a motion went to, in the order of the file.
enum MotionVisit {
    Inline(usize),
    Move(Move),
}

/// A name, the targets that are its values, and how motions go to it.
#[derive(Default)]
struct Named {
    /// The first of its values; nearly every name has just this one.
    first: Option<usize>,
    others: Vec<usize>,
    ways: UsedPairs,
}

impl Named {
    fn add(&mut self, target: usize) {
        match self.first {
            None => self.first = Some(target),
            Some(_) => self.others.push(target),
        }
    }

    fn targets(&self) -> impl Iterator<Item = usize> + '_ {
        self.first.iter().chain(&self.others).copied()
    }
}

/// The targets of a program by name, and its motions in the order of the file.
#[derive(Default)]
pub(super) struct Moves {
    by_name: BTreeMap<String, usize>,
    names: Vec<Named>,
    all: Vec<MotionVisit>,
    /// Names that something is assigned to at run time, how they are spelled, and where.
    changed: Vec<(String, String, usize)>,
}

impl Moves {
    /// Keeps a target under its name, as motions name it; its index.
    pub(super) fn target(
        &mut self,
        program: &mut Program,
        name: Option<&str>,
        mut target: Target,
    ) -> usize {
        target.shrink();
        program.targets.push(target);
        let index = program.targets.len() - 1;
        if let Some(name) = name {
            let name = self.name(name);
            self.names[name].add(index);
        }
        index
    }

    fn name(&mut self, name: &str) -> usize {
        if let Some(index) = self.by_name.get(name) {
            return *index;
        }
        self.names.push(Named::default());
        let index = self.names.len() - 1;
        self.by_name.insert(name.to_owned(), index);
        index
    }

    /// A motion, in a frame and with a tool.
    pub(super) fn push(
        &mut self,
        program: &mut Program,
        at: usize,
        goal: Goal,
        frame: &Referred,
        tool: &Referred,
    ) {
        let way = program.ways.of(FrameAndTool {
            frame: frame.clone(),
            tool: tool.clone(),
        });
        let (name, spelled, mentioned) = match goal {
            Goal::Inline(index) => {
                program.targets[index].ways.add(way);
                return self.all.push(MotionVisit::Inline(index));
            }
            Goal::Named(name, spelled) => (name, Some(spelled), false),
            Goal::Mentioned(name) => (name, None, true),
        };
        let name = self.name(&name);
        let named = &mut self.names[name];
        named.ways.add(way);
        let spelled = spelled.filter(|_| named.first.is_none());
        self.all.push(MotionVisit::Move(Move {
            at,
            name,
            mentioned,
            spelled: spelled.map(String::into_boxed_str),
        }));
    }

    /// A name that is assigned to at run time.
    pub(super) fn changed(&mut self, spelled: String, at: usize) {
        self.changed.push((spelled.to_lowercase(), spelled, at));
    }

    /// The program with its visits, the frames that its targets are used in, and what is not corrected.
    /// `elsewhere`: what there is to say of a name that the file gives no values.
    pub(super) fn finish(self, mut program: Program, elsewhere: fn(&str) -> Text) -> Program {
        for visit in self.all {
            let one = match visit {
                MotionVisit::Inline(index) => {
                    program.visits.push(index);
                    continue;
                }
                MotionVisit::Move(one) => one,
            };
            let named = &self.names[one.name];
            match (named.first, one.spelled) {
                _ if one.mentioned => {}
                (Some(index), _) if named.others.is_empty() => program.visits.push(index),
                (None, Some(spelled)) => {
                    let says = elsewhere(&spelled);
                    program.at_run_time.push(Remark {
                        at: one.at,
                        text: says,
                    });
                }
                // An array, or a name that is given several values.
                _ => {}
            }
        }
        for named in &self.names {
            for target in named.targets() {
                program.targets[target].ways.join(named.ways);
            }
        }
        for (name, spelled, at) in self.changed {
            let known = self.by_name.get(&name);
            if known.is_some_and(|known| self.names[*known].first.is_some()) {
                let says = text!("{spelled} is changed at run time", spelled = &*spelled);
                program.at_run_time.push(Remark { at, text: says });
            }
            let unknown = || {
                Err(text!(
                    "{spelled} is changed at run time",
                    spelled = &*spelled
                ))
            };
            for declared in [&mut program.frames, &mut program.tools] {
                if let Some(declared) = declared.get_mut(&name) {
                    declared.pose = unknown();
                }
            }
        }
        program
    }
}
