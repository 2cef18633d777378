//! What holds where: base, tool and mode through routines, branches, loops, labels and calls.

use std::collections::{BTreeMap, BTreeSet};

use super::{Block, Known, Routine, Scope, State, Walk};
use crate::programs::referred::{BASE, MODE, Referred, TOOL};
use crate::programs::target::Problem;
use crate::programs::words::Words;

/// Blocks in blocks, and routines in routines.
const DEEPEST: usize = 64;

impl Walk<'_> {
    /// Base, tool or mode from here on.
    pub(crate) fn set(&mut self, part: usize, what: Referred) {
        let what = self.unless_parameter(what);
        if what != Referred::Unsaid {
            self.facts.any[part] = true;
            for routine in &self.open {
                if let Some(sets) = self.facts.sets.get_mut(&*routine.name) {
                    sets[part] = true;
                }
            }
        }
        // After a handler the routine goes on from any of its statements.
        self.facts.interrupted[part] |= self.open.iter().any(|routine| routine.handles);
        if let Referred::Named(name) = &what {
            self.facts.held.insert((**name).into(), true);
        }
        self.state[part] = self.known(what);
    }

    fn known(&self, what: Referred) -> Known {
        let since = self.statement;
        Known { what, since }
    }

    /// A command that shifts the poses after it.
    pub(crate) fn shift(&mut self, at: usize, command: &str) {
        let says = text!("{name} shifts the poses after it", name = command);
        self.left(at, says.clone());
        self.set(MODE, Referred::Unknown(says));
    }

    /// Where a jump may come from any place: what is set somewhere is not known.
    pub(crate) fn label(&mut self) {
        for part in [BASE, TOOL, MODE] {
            if self.facts.any[part] {
                self.state[part] = self.in_a_branch();
            }
        }
    }

    fn in_a_branch(&self) -> Known {
        self.known(Referred::Unknown(text!("it is set in a branch or a loop")))
    }

    /// A routine that may run at any statement: an interrupt, a thread.
    pub(crate) fn anytime(&mut self, name: &str) {
        self.facts.anytime.insert(name.to_owned());
    }

    /// The handler of errors of the routine that is open begins.
    pub(crate) fn handler(&mut self) {
        if let Some(routine) = self.open.last_mut() {
            routine.handles = true;
        }
    }

    /// What holds of a part.
    pub(crate) fn held(&self, part: usize) -> &Referred {
        &self.state[part].what
    }

    /// A call; whether the routine is one of this file.
    pub(crate) fn call(&mut self, name: &str, spelled: &str) -> bool {
        if self.first && !self.open.is_empty() {
            self.facts.calls.insert((name.into(), self.scope));
        }
        let Some(sets) = self.facts.sets.get(name).copied() else {
            return false;
        };
        for part in [BASE, TOOL, MODE] {
            if sets[part] {
                let says = text!("{spelled} sets it", spelled);
                self.set(part, Referred::Unknown(says));
            }
        }
        true
    }

    /// Modules whose names are their own, before any statement.
    pub(crate) fn has_modules(&mut self, names: BTreeSet<String>) {
        for name in names {
            if self.first {
                self.facts.scopes.push(Scope::default());
            }
            self.modules.insert(name, self.scopes);
            self.scopes += 1;
        }
    }

    /// From here on names are those of this module, if it is one.
    pub(crate) fn enter_module(&mut self, name: &str) {
        self.module = self.modules.get(name).copied().unwrap_or(self.module);
        self.scope = self.module;
    }

    fn not_too_deep(&self, open: usize) -> Result<(), Problem> {
        if open < DEEPEST {
            return Ok(());
        }
        let found = text!("blocks in blocks");
        Err(Problem::new(
            self.at,
            found,
            text!("at most {most} deep", most = DEEPEST),
        ))
    }

    /// A routine begins, whose name is word `k`; its parameters are the names behind it that one of these signs follows.
    /// `main`: what is set before it holds in it.
    pub(crate) fn begin_routine(
        &mut self,
        words: &Words,
        k: usize,
        follow_parameters: &[u8],
        main: bool,
    ) -> Result<(), Problem> {
        self.not_too_deep(self.open.len())?;
        let name = words.name(k);
        if self.first {
            self.facts.scopes.push(Scope {
                parent: self.scope,
                routine: name.as_str().into(),
                names: BTreeMap::new(),
            });
            self.facts.sets.entry(name.as_str().into()).or_default();
        }
        self.open.push(Routine {
            scope: self.scope,
            name,
            state: self.state.clone(),
            blocks: std::mem::take(&mut self.blocks),
            handles: false,
        });
        self.scope = self.scopes;
        self.scopes += 1;
        self.routines += 1;
        self.parameters(words, k, follow_parameters);
        for part in [BASE, TOOL, MODE] {
            if !main {
                self.state[part].what = if self.facts.any[part] && !self.first {
                    Referred::Unknown(text!("another routine of this file sets it"))
                } else {
                    Referred::Unsaid
                };
            }
            self.state[part].since = self.statement;
        }
        Ok(())
    }

    /// Routines and modules that are open.
    pub(crate) fn depth(&self) -> usize {
        self.open.len()
    }

    /// Whether a block of the routine is open.
    pub(crate) fn in_block(&self) -> bool {
        !self.blocks.is_empty()
    }

    pub(crate) fn end_routine(&mut self) {
        if let Some(routine) = self.open.pop() {
            self.scope = routine.scope;
            self.state = routine.state;
            self.blocks = routine.blocks;
        }
    }

    /// All routines that are open end.
    pub(crate) fn end_routines(&mut self) {
        while !self.open.is_empty() {
            self.end_routine();
        }
    }

    /// A branch or a loop begins.
    pub(crate) fn begin_block(&mut self, loops: bool) -> Result<(), Problem> {
        self.not_too_deep(self.blocks.len())?;
        self.blocks.push(Block {
            entry: self.state.clone(),
            exits: Vec::new(),
            whole: false,
            loops,
            motions: self.motions.len(),
            statement: self.statement,
        });
        Ok(())
    }

    /// Another branch of the block; `last`: what is taken if no other is.
    pub(crate) fn alternative(&mut self, last: bool) {
        if let Some(block) = self.blocks.last_mut() {
            let left = std::mem::replace(&mut self.state, block.entry.clone());
            // Of branches that leave the same nothing more is kept.
            if block.exits.last().is_none_or(|exit| !same(exit, &left)) {
                block.exits.push(left);
            }
            block.whole |= last;
        }
    }

    pub(crate) fn end_block(&mut self) {
        let Some(block) = self.blocks.pop() else {
            return;
        };
        let mut exits = block.exits;
        if block.loops || !block.whole {
            exits.push(block.entry.clone());
        }
        for part in [BASE, TOOL, MODE] {
            let own = &self.state[part].what;
            if exits.iter().all(|exit| exit[part].what == *own) {
                continue;
            }
            let unknown = self.in_a_branch();
            // The second time through a loop holds what the first left.
            if block.loops {
                let mut known = BTreeMap::new();
                for motion in &mut self.motions[block.motions..] {
                    if motion.since[part] < block.statement {
                        let ways = &mut self.program.ways;
                        motion.way = *known.entry(motion.way).or_insert_with_key(|way| {
                            let mut way = ways.get(*way).clone();
                            way[part] = unknown.what.clone();
                            ways.of(way)
                        });
                    }
                }
            }
            self.state[part] = unknown;
        }
    }
}

fn same(a: &State, b: &State) -> bool {
    a.iter().zip(b).all(|(a, b)| a.what == b.what)
}
