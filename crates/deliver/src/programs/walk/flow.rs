//! What holds where: base, tool and mode through routines, branches, loops, labels and calls.

use std::collections::{BTreeMap, BTreeSet};

use super::{BASE, Block, DEEPEST, Declared, Known, MODE, Routine, Scope, State, TOOL, Walk};
use crate::programs::referred::Referred;
use crate::text::Text as Sentence;

impl Walk<'_> {
    /// Base, tool or mode from here on.
    pub(in crate::programs) fn set(&mut self, part: usize, what: Referred) {
        if what != Referred::Unsaid {
            self.facts.any[part] = true;
            for routine in self.open.iter().map(|routine| &routine.name) {
                if let Some(sets) = self.facts.sets.get_mut(routine) {
                    sets[part] = true;
                }
            }
        }
        // After a handler the routine goes on from any of its statements.
        self.facts.interrupted[part] |= self.open.iter().any(|routine| routine.handles);
        if let Referred::Named(name) = &what {
            self.facts.tools.insert((**name).to_owned());
        }
        self.state[part] = Known {
            what,
            since: self.statement,
        };
    }

    /// Where a jump may come from any place: what is set somewhere is not known.
    pub(in crate::programs) fn label(&mut self) {
        for part in [BASE, TOOL, MODE]
            .into_iter()
            .filter(|part| self.facts.any[*part])
        {
            self.state[part] = Known {
                what: Referred::Unknown(text!("it is set in a branch or a loop")),
                since: self.statement,
            };
        }
    }

    /// A routine that may run at any statement: an interrupt, a thread.
    pub(in crate::programs) fn anytime(&mut self, name: &str) {
        self.facts.anytime.insert(name.to_owned());
    }

    /// The handler of errors of the routine that is open begins.
    pub(in crate::programs) fn handler(&mut self) {
        if let Some(routine) = self.open.last_mut() {
            routine.handles = true;
        }
    }

    /// What holds of a part.
    pub(in crate::programs) fn held(&self, part: usize) -> &Referred {
        &self.state[part].what
    }

    /// A call; whether the routine is one of this file.
    pub(in crate::programs) fn call(&mut self, name: &str, spelled: &str) -> bool {
        if let Some(routine) = self.open.last() {
            let call = (name.to_owned(), routine.name.clone());
            self.facts.calls.insert(call);
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
    pub(in crate::programs) fn has_modules(&mut self, names: BTreeSet<String>) {
        for name in names {
            if self.first {
                self.facts.scopes.push(Scope::default());
            }
            self.modules.insert(name, self.scopes);
            self.scopes += 1;
        }
    }

    /// From here on names are those of this module, if it is one; the one before, to go back to.
    pub(in crate::programs) fn enter_module(&mut self, name: &str) -> usize {
        let module = self.modules.get(name).copied().unwrap_or(self.module);
        self.return_to(module)
    }

    pub(in crate::programs) fn return_to(&mut self, module: usize) -> usize {
        self.scope = module;
        std::mem::replace(&mut self.module, module)
    }

    /// A routine begins; its parameters.
    pub(in crate::programs) fn begin_routine(
        &mut self,
        name: &str,
        parameters: &[String],
        main: bool,
    ) -> Result<(), Sentence> {
        if self.open.len() >= DEEPEST {
            return Err(text!("at most 64 deep"));
        }
        if self.first {
            let parent = self.scope;
            let names = BTreeMap::new();
            self.facts.scopes.push(Scope { parent, names });
            self.facts.sets.entry(name.to_owned()).or_default();
        }
        self.open.push(Routine {
            scope: self.scope,
            name: name.to_owned(),
            state: self.state.clone(),
            blocks: std::mem::take(&mut self.blocks),
            handles: false,
        });
        self.scope = self.scopes;
        self.scopes += 1;
        self.routines += 1;
        for parameter in parameters {
            self.declare(parameter, Declared::Parameter, false);
        }
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

    /// Routines so far.
    pub(in crate::programs) fn routines(&self) -> usize {
        self.routines
    }

    /// Whether a block of the routine is open.
    pub(in crate::programs) fn in_block(&self) -> bool {
        !self.blocks.is_empty()
    }

    pub(in crate::programs) fn end_routine(&mut self) {
        if let Some(routine) = self.open.pop() {
            self.scope = routine.scope;
            self.state = routine.state;
            self.blocks = routine.blocks;
        }
    }

    /// A branch or a loop begins.
    pub(in crate::programs) fn begin_block(&mut self, loops: bool) -> Result<(), Sentence> {
        if self.blocks.len() >= DEEPEST {
            return Err(text!("at most 64 deep"));
        }
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
    pub(in crate::programs) fn alternative(&mut self, last: bool) {
        if let Some(block) = self.blocks.last_mut() {
            let left = std::mem::replace(&mut self.state, block.entry.clone());
            // Of branches that leave the same nothing more is kept.
            if block.exits.last().is_none_or(|exit| !same(exit, &left)) {
                block.exits.push(left);
            }
            block.whole |= last;
        }
    }

    pub(in crate::programs) fn end_block(&mut self) {
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
            let says = text!("it is set in a branch or a loop");
            let unknown = Referred::Unknown(says);
            // The second time through a loop holds what the first left.
            if block.loops {
                let mut known = BTreeMap::new();
                for motion in &mut self.motions[block.motions..] {
                    if motion.since[part] < block.statement {
                        let ways = &mut self.program.ways;
                        motion.way = *known
                            .entry(motion.way)
                            .or_insert_with_key(|way| ways.of(ways.get(*way).with(part, &unknown)));
                    }
                }
            }
            self.state[part] = Known {
                what: unknown,
                since: self.statement,
            };
        }
    }
}

fn same(a: &State, b: &State) -> bool {
    a.iter().zip(b).all(|(a, b)| a.what == b.what)
}
