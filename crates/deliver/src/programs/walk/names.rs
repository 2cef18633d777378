//! The names of a program: what each is declared as, what its values are, and what is said of it.

use std::ops::Range;

use super::{Constant, Declared, Name, Said, Walk};
use crate::programs::axes::Slot;
use crate::programs::target::{Outside, Target};
use crate::programs::words::Words;

impl Walk<'_> {
    /// A name of this scope (`outer`: of the file) that is declared here.
    pub(crate) fn declare(&mut self, name: &str, declared: Declared, outer: bool) {
        let index = self.own(if outer { 0 } else { self.scope }, name);
        let known = &mut self.name(index).declared;
        if *known == Declared::Nowhere {
            *known = declared;
        }
    }

    /// A name that is given a value here: one of this routine, unless an outer one has it.
    pub(crate) fn given(&mut self, name: &str) {
        if self.first {
            let index = self.own(self.scope, name);
            self.name(index).weak = true;
        }
    }

    /// Whether motions go to a name.
    pub(crate) fn is_gone_to(&self, name: &str) -> bool {
        self.of(name).is_some_and(|name| name.was_used)
    }

    fn own(&mut self, scope: usize, name: &str) -> u32 {
        let names = &mut self.facts.scopes[scope].names;
        if let Some(index) = names.get(name) {
            return *index;
        }
        let index = u32::try_from(self.facts.names.len()).unwrap_or(u32::MAX);
        names.insert(name.into(), index);
        self.facts.names.push(Name::default());
        index
    }

    pub(super) fn name(&mut self, index: u32) -> &mut Name {
        &mut self.facts.names[index as usize]
    }

    pub(super) fn said(&mut self, index: u32) -> &mut Said {
        self.name(index).said.get_or_insert_default()
    }

    /// The name as it is seen from here.
    fn of(&self, name: &str) -> Option<&Name> {
        let index = self.facts.seen(self.scope, name)?;
        Some(&self.facts.names[index as usize])
    }

    /// The same; a name that is declared nowhere is one of the whole file.
    pub(super) fn owner(&mut self, name: &str) -> u32 {
        let seen = self.facts.seen(self.scope, name);
        seen.unwrap_or_else(|| self.own(0, name))
    }

    /// What a name is declared as, seen from here.
    pub(crate) fn declared(&self, name: &str) -> Declared {
        self.of(name)
            .map_or(Declared::Nowhere, |name| name.declared)
    }

    /// Whether the file says something of a name that is seen from here.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.of(name).is_some()
    }

    /// Whether a name has a value already.
    pub(crate) fn has_value(&self, name: &str) -> bool {
        self.of(name).is_some_and(|name| !name.values.is_empty())
    }

    /// Whether a pose that no motion goes to is to be told: the names are known, and it is no tool.
    pub(crate) fn is_told(&self, name: &str) -> bool {
        !self.first && self.facts.held.get(&*name.to_lowercase()) != Some(&true)
    }

    /// Whether a base or a tool of the file has this name; of others nothing is kept that is worked out at run time.
    pub(crate) fn is_held(&self, name: &str) -> bool {
        self.facts.held.contains_key(&*name.to_lowercase())
    }

    /// What a constant says that is no target.
    pub(crate) fn constant(&mut self, name: &str, constant: Constant) {
        let name = (self.module, name.to_lowercase().into());
        // Of a name with several values none is known.
        let known = match self.facts.constants.get(&name) {
            Some(known) if *known != constant => Constant::List(Box::default()),
            _ => constant,
        };
        self.facts.constants.insert(name, known);
    }

    pub(crate) fn constant_of(&self, name: &str) -> Option<&Constant> {
        let name: Box<str> = name.to_lowercase().into();
        let of = |module| self.facts.constants.get(&(module, name.clone()));
        of(self.module).or_else(|| of(0))
    }

    /// A value of a name that may be a target; `array`: of which the name is an element.
    pub(crate) fn value(&mut self, name: &str, array: Option<&str>, target: Target) {
        let index = match array {
            None => self.owner(name),
            Some(array) => {
                let whole = self.owner(array);
                // Elements are where the array is.
                let here = self.facts.scopes[self.scope].names.get(array) == Some(&whole);
                let element = self.own(if here { self.scope } else { 0 }, name);
                self.name(element).whole = Some(whole);
                element
            }
        };
        let target = self.target(target);
        self.name(index).values.push(target);
    }

    pub(super) fn target(&mut self, mut target: Target) -> usize {
        target.shrink();
        self.program.targets.push(target);
        self.program.targets.len() - 1
    }

    /// The number of where external axes are that the model does not have.
    pub(crate) fn outside(&mut self, mut axes: Outside) -> u32 {
        for (k, axis) in axes.iter_mut().enumerate() {
            *axis = axis.filter(|_| self.axes.joint(Slot::External(k)).is_none());
        }
        self.program.outside(axes)
    }

    /// A name whose value is worked out at run time, where it is spelled at word `k`.
    pub(crate) fn changed(&mut self, name: &str, words: &Words, k: usize) {
        let index = self.owner(name);
        let name = self.name(index);
        name.changed = name.changed.or(words.span(k));
    }

    /// A target that a relative motion uses.
    pub(crate) fn relative(&mut self, name: &str, command: &str) {
        let index = self.owner(name);
        let relative = &mut self.said(index).relative;
        relative.get_or_insert_with(|| command.into());
    }

    /// A target that is used, but not as what a motion goes to.
    pub(crate) fn mention(&mut self, name: &str, at: usize, by: &str) {
        if self.handed_at.contains(&at) {
            return;
        }
        if let Some(index) = self.facts.seen(self.scope, name) {
            let mentioned = &mut self.said(index).mentioned;
            mentioned.get_or_insert_with(|| (at, by.into()));
        }
    }

    /// Every name among some words.
    pub(crate) fn mention_all(&mut self, words: &Words, range: Range<usize>, by: &str) {
        for k in range.filter(|k| words.is_name(*k)) {
            self.mention(&words.name(k), words.at(k), by);
        }
    }
}
