//! Routines that move to what they are handed: `PROC pick(robtarget p) … MoveL p …`, called as `pick p10;`.
//!
//! What motions do with a parameter they do with every target that a call of this file hands to it. A base or a tool
//! that comes from the caller is not known.

use super::{Declared, Goal, Name, Said, Walk};
use crate::programs::referred::Referred;
use crate::programs::words::{Kind, Words};
use crate::text::Text as Sentence;

pub(super) fn from_the_caller(spelled: &str) -> Sentence {
    text!(
        "{spelled} is a parameter: its value comes from the caller",
        spelled
    )
}

impl Walk<'_> {
    /// The parameters of the routine whose name is word `k`: the names behind it that one of these signs follows.
    pub(super) fn parameters(&mut self, words: &Words, k: usize, follow: &[u8]) {
        let follows =
            |j: usize| matches!(words.kind(j), Some(Kind::Sign(sign)) if follow.contains(&sign));
        let mut required = Vec::new();
        for j in (k + 1..words.len()).filter(|j| words.is_name(*j) && follows(j + 1)) {
            let name = words.name(j);
            self.declare(&name, Declared::Parameter, false);
            // `\num n|num m` are given by their names, in any number.
            let own = (k + 1..j).rev().take_while(|i| !words.is_sign(*i, b','));
            if !own.into_iter().any(|i| words.is_sign(i, b'\\')) {
                required.push(self.owner(&name));
            }
        }
        if self.first {
            let known = &mut self.facts.parameters;
            known
                .entry(words.name(k).into())
                .and_modify(Vec::clear)
                .or_insert(required);
        }
    }

    /// What a call hands over, whose arguments begin at word `k`.
    pub(crate) fn hand_over(&mut self, routine: &str, words: &Words, mut k: usize) {
        let parameters = self.facts.parameters.get(routine);
        for parameter in parameters.cloned().unwrap_or_default() {
            // `\quick, p10`: what is optional may stand before.
            while words.is_sign(k, b'\\') {
                k = words.until(k + 1, b",;)") + 1;
            }
            // An argument may stand in brackets of its own.
            let open = (k..words.len())
                .take_while(|j| words.is_sign(*j, b'('))
                .count();
            k += open;
            let end = words.until(k, b",;)\\");
            let name = words.element(k).unwrap_or_else(|| words.name(k));
            let whole = words.behind_element(k).unwrap_or(k + 1) == end;
            if words.is_name(k) && whole && self.knows(&name) {
                let index = self.owner(&name);
                self.handed.insert([parameter, index]);
                self.handed_at.insert(words.at(k));
                self.go(Goal::Handed(index), words.at(k), &[], None);
            }
            k = words.until(end + open, b",;)") + 1;
        }
    }

    pub(super) fn is_handed_to(&self, parameter: u32) -> bool {
        let mut handed = self.handed.range([parameter, 0]..=[parameter, u32::MAX]);
        handed.next().is_some()
    }

    /// A base or a tool, unless it is one that the caller chooses.
    pub(super) fn unless_parameter(&self, what: Referred) -> Referred {
        match what {
            Referred::Named(name) if self.declared(&name) == Declared::Parameter => {
                Referred::Unknown(from_the_caller(&name.to_string()))
            }
            what => what,
        }
    }

    /// What holds of a parameter holds of what is handed to it, which may be a parameter as well.
    pub(super) fn follow_parameters(&mut self) {
        let names = &mut self.facts.names;
        let is_parameter = |name: &Name| name.declared == Declared::Parameter;
        let (on, last): (Vec<[u32; 2]>, Vec<_>) =
            (self.handed.iter()).partition(|[_, name]| is_parameter(&names[*name as usize]));
        let mut hand = |edges: &[[u32; 2]]| {
            let mut more = false;
            for [parameter, name] in edges.iter().filter(|[from, to]| from != to) {
                let of = std::mem::take(&mut names[*parameter as usize]);
                more |= names[*name as usize].follow(&of);
                names[*parameter as usize] = of;
            }
            more
        };
        while hand(&on) {}
        hand(&last);
    }
}

impl Name {
    /// What holds of a parameter to which this name is handed; whether that says more of it.
    fn follow(&mut self, parameter: &Name) -> bool {
        let known = |name: &Name| {
            let said = name.said.as_deref();
            let said = said.map(|said| {
                let (relative, mentioned) = (said.relative.is_some(), said.mentioned.is_some());
                [relative, mentioned, said.blocked.is_some()]
            });
            (
                name.used,
                name.kept,
                name.ways,
                name.changed.is_some(),
                said,
            )
        };
        let before = known(self);
        self.used |= parameter.used;
        self.kept = self.kept.max(parameter.kept);
        self.ways.join(parameter.ways);
        self.changed = self.changed.or(parameter.changed);
        if let Some(of) = &parameter.said {
            let said: &mut Said = self.said.get_or_insert_default();
            said.relative = said.relative.take().or_else(|| of.relative.clone());
            said.mentioned = said.mentioned.take().or_else(|| of.mentioned.clone());
            said.blocked = said.blocked.or(of.blocked);
        }
        known(self) != before
    }
}
