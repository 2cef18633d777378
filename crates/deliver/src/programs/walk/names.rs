//! The names of a program: what each is declared as, what its values are, and what is said of it.

use std::ops::Range;

use super::{Constant, Declared, Name, Said, Walk};
use crate::programs::axes::Slot;
use crate::programs::target::{Outside, Target};
use crate::programs::words::Words;

impl Walk<'_> {
    /// A name of this scope (`outer`: of the file) that is declared here.
    pub(in crate::programs) fn declare(&mut self, name: &str, declared: Declared, outer: bool) {
        let scope = if outer { 0 } else { self.scope };
        let name = self.own(scope, name);
        let known = &mut self.facts.names[name].declared;
        if *known == Declared::Nowhere {
            *known = declared;
        }
    }

    /// A name that is given a value here: one of this routine, unless an outer one has it.
    pub(in crate::programs) fn given(&mut self, name: &str) {
        if self.first {
            self.own(self.scope, name);
            self.facts.weak.push((self.scope, name.to_owned()));
        }
    }

    /// Whether motions go to a name.
    pub(in crate::programs) fn is_gone_to(&self, name: &str) -> bool {
        self.seen(name)
            .is_some_and(|name| self.facts.names[name].was_used)
    }

    pub(super) fn own(&mut self, scope: usize, name: &str) -> usize {
        let names = &mut self.facts.scopes[scope].names;
        if let Some(index) = names.get(name) {
            return *index;
        }
        names.insert(name.to_owned(), self.facts.names.len());
        self.facts.names.push(Name::default());
        self.facts.names.len() - 1
    }

    /// The name as it is seen from here.
    pub(super) fn seen(&self, name: &str) -> Option<usize> {
        let mut scope = self.scope;
        loop {
            let found = self.facts.scopes[scope].names.get(name);
            if found.is_some() || scope == 0 {
                return found.copied();
            }
            scope = self.facts.scopes[scope].parent;
        }
    }

    /// The same; a name that is declared nowhere is one of the whole file.
    pub(super) fn owner(&mut self, name: &str) -> usize {
        match self.seen(name) {
            Some(index) => index,
            None => self.own(0, name),
        }
    }

    /// What a name is declared as, seen from here.
    pub(in crate::programs) fn declared(&self, name: &str) -> Declared {
        let seen = self
            .seen(name)
            .map(|seen| self.facts.names[seen].declared.clone());
        seen.unwrap_or_default()
    }

    /// Whether the file says something of a name that is seen from here.
    pub(in crate::programs) fn knows(&self, name: &str) -> bool {
        self.seen(name).is_some()
    }

    /// Whether a name has a value already.
    pub(in crate::programs) fn has_value(&self, name: &str) -> bool {
        self.seen(name)
            .is_some_and(|name| self.facts.names[name].first.is_some())
    }

    /// Whether a pose that no motion goes to is to be told: the names are known, and it is no tool.
    pub(in crate::programs) fn is_told(&self, name: &str) -> bool {
        !self.first && !self.facts.tools.contains(&name.to_lowercase())
    }

    /// Routines and modules that are open.
    pub(in crate::programs) fn depth(&self) -> usize {
        self.open.len()
    }

    /// The number of where external axes are that the model does not have.
    pub(in crate::programs) fn outside(&mut self, axes: Outside) -> u32 {
        let own = |k: usize| self.axes.joint(Slot::External(k)).is_none();
        let outside = std::array::from_fn(|k| axes[k].filter(|_| own(k)));
        self.program.outside(outside)
    }

    /// What a constant says that is no target.
    pub(in crate::programs) fn constant(&mut self, name: &str, constant: Constant) {
        let name = (self.module, name.to_lowercase());
        // Of a name with several values none is known.
        let several = |known: &Constant| *known != constant;
        let known = match self.facts.constants.get(&name) {
            Some(known) if several(known) => Constant::List(Vec::new()),
            _ => constant,
        };
        self.facts.constants.insert(name, known);
    }

    pub(in crate::programs) fn constant_of(&self, name: &str) -> Option<&Constant> {
        let mut name = (self.module, name.to_lowercase());
        let known = self.facts.constants.get(&name);
        known.or_else(|| {
            name.0 = 0;
            self.facts.constants.get(&name)
        })
    }

    /// A value of a name that may be a target; `array`: of which the name is an element.
    pub(in crate::programs) fn value(&mut self, name: &str, array: Option<&str>, target: Target) {
        let name = match array {
            None => self.owner(name),
            Some(array) => {
                let whole = self.owner(array);
                // Elements are where the array is.
                let scopes = [self.scope, 0];
                let at = scopes
                    .into_iter()
                    .find(|scope| self.facts.scopes[*scope].names.get(array) == Some(&whole));
                let element = self.own(at.unwrap_or(0), name);
                self.facts.names[element].whole = Some(whole);
                element
            }
        };
        let index = self.target(target);
        let name = &mut self.facts.names[name];
        match name.first {
            None => name.first = Some(index),
            Some(_) => name.others.push(index),
        }
    }

    pub(super) fn target(&mut self, mut target: Target) -> usize {
        target.shrink();
        self.program.targets.push(target);
        self.program.targets.len() - 1
    }

    /// A name whose value is worked out at run time.
    pub(in crate::programs) fn changed(&mut self, name: &str, spelled: &str, at: usize) {
        let name = self.owner(name);
        self.said(name).changed.get_or_insert(at);
        self.changes.insert(spelled.to_owned());
    }

    pub(super) fn said(&mut self, name: usize) -> &mut Said {
        self.facts.names[name].said.get_or_insert_default()
    }

    /// A target that a relative motion uses.
    pub(in crate::programs) fn relative(&mut self, name: &str, command: &str) {
        let name = self.owner(name);
        let says = text!("{command} is a relative motion", command);
        self.said(name).relative.get_or_insert(says);
    }

    /// A target that is used, but not as what a motion goes to.
    pub(in crate::programs) fn mention(&mut self, name: &str, at: usize, by: &str) {
        let Some(name) = self.seen(name) else {
            return;
        };
        self.said(name)
            .mentioned
            .get_or_insert_with(|| (at, text!("{command} uses it", command = by)));
    }

    /// Every name among some words.
    pub(in crate::programs) fn mention_all(
        &mut self,
        words: &Words,
        range: Range<usize>,
        by: &str,
    ) {
        for k in range {
            if words.is_name(k) {
                self.mention(&words.name(k), words.at(k), by);
            }
        }
    }
}
