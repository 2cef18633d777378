//! Motions: what they go to, and what becomes of names and targets by that.

use crate::programs::program::not_in_numbers;
use std::collections::BTreeSet;
use std::ops::Range;

use super::parameters::from_the_caller;
use super::{Declared, Goal, Motion, Name, Said, Walk};
use crate::programs::answer::Reason;
use crate::programs::program::Program;
use crate::programs::referred::{BASE, MODE, Referred, Set, TOOL};
use crate::programs::target::{Remark, Target};
use crate::programs::words::Words;
use crate::text::Text as Sentence;

impl Walk<'_> {
    /// Something in the file that is not corrected, and why.
    pub(crate) fn left(&mut self, at: usize, says: Sentence) {
        if !self.first {
            self.program.at_run_time.push(Remark { at, text: says });
        }
    }

    pub(super) fn go(&mut self, goal: Goal, at: usize, changes: &[Set], spelled: Option<&str>) {
        let mut way = self.state.clone().map(|known| known.what);
        let mut since = [0, 1, 2].map(|part: usize| self.state[part].since);
        for part in [BASE, TOOL, MODE] {
            if self.facts.interrupted[part] && !self.first {
                let says = text!("an interrupt or a handler of errors sets it");
                way[part] = Referred::Unknown(says);
            }
        }
        for (part, what) in changes {
            if let Referred::Named(name) = what {
                self.facts.held.entry((**name).into()).or_default();
            }
            way[*part] = self.unless_parameter(what.clone());
            since[*part] = self.statement;
        }
        self.motions.push(Motion {
            goal,
            at,
            way: self.program.ways.of(way),
            since,
            nearest: self.nearest,
            spelled: spelled.map(Into::into),
        });
    }

    /// That motions along lines (else of joints) keep the configurations of their goals, or do not, somewhere in the file.
    pub(crate) fn keeps(&mut self, along: bool, keeps: bool) {
        let known = &mut self.facts.keeps[usize::from(along)];
        // A file that says both is read as if it kept them: a target that then cannot have its own is left.
        *known = Some(keeps || known.unwrap_or(false));
    }

    /// The goals of a motion along a line, or of joints.
    pub(crate) fn moves<T>(&mut self, along: bool, goals: impl FnOnce(&mut Self) -> T) -> T {
        self.nearest = self.facts.keeps[usize::from(along)] == Some(false);
        let done = goals(self);
        self.nearest = false;
        done
    }

    /// A motion to a target that stands in it; `changes`: what the motion says itself.
    pub(crate) fn go_to(&mut self, target: Target, changes: &[Set]) {
        let at = target.at;
        let index = self.target(target);
        self.go(Goal::Inline(index), at, changes, None);
    }

    /// A motion to a name, as the language tells names apart and as it is spelled.
    pub(crate) fn go_to_name(
        &mut self,
        (name, spelled): (&str, &str),
        at: usize,
        near: Option<Vec<f64>>,
        changes: &[Set],
    ) {
        let index = self.owner(name);
        self.name(index).used = true;
        if near.is_some() {
            let said = self.said(index);
            said.near = said.near.take().or(near);
        }
        self.go(Goal::Name(index), at, changes, Some(spelled));
    }

    /// A motion to a part of a name that is chosen at run time (`absolute`), or to what is worked out from it.
    pub(crate) fn go_to_part(&mut self, name: &str, at: usize, absolute: bool, changes: &[Set]) {
        let index = self.owner(name);
        self.name(index).used |= absolute;
        self.go(Goal::Part(index), at, changes, absolute.then_some(name));
    }

    /// A motion to what these words say: a name, an element of an array, or what is worked out at run time.
    pub(crate) fn go_to_words(
        &mut self,
        words: &Words,
        range: Range<usize>,
        command: &str,
        near: Option<Vec<f64>>,
        changes: &[Set],
    ) {
        let (k, at) = (range.start, words.at(range.start));
        let name = words.name(k);
        if words.is_name(k) && range.len() == 1 {
            self.go_to_name((&name, &words.spelled(k)), at, near, changes);
        } else if words.is_name(k) && words.behind_element(k).is_some_and(|end| end >= range.end) {
            match words.element(k).filter(|element| self.knows(element)) {
                Some(element) => self.go_to_name((&element, &element), at, near, changes),
                None => self.go_to_part(&name, at, true, changes),
            }
        } else {
            self.go_to_worked_out(words, range, command, changes);
        }
    }

    /// A motion to what is worked out at run time, perhaps from names.
    pub(crate) fn go_to_worked_out(
        &mut self,
        words: &Words,
        range: Range<usize>,
        command: &str,
        changes: &[Set],
    ) {
        let at = words.at(range.start);
        let target = words.shown(range.start, range.end);
        let says = not_in_numbers(target);
        self.left(at, says);
        // A function uses what is in its brackets.
        let by = if words.is_sign(range.start + 1, b'(') {
            words.spelled(range.start)
        } else {
            command.to_owned()
        };
        for k in range {
            let name = words.name(k);
            if self.knows(&name) {
                self.go_to_part(&name, at, false, changes);
                self.mention(&name, at, &by);
            }
        }
    }

    /// A call of what is not in the file.
    pub(crate) fn routine_elsewhere(&mut self, at: usize, command: &str) {
        let says = text!(
            "{command} is another routine's: its motions are not in this file",
            command
        );
        self.left(at, says);
    }

    /// The program: what motions go to is applied to the targets, and what is not proven is left.
    pub(super) fn finished(mut self, elsewhere: fn(&str) -> Sentence) -> Program {
        let valued = |name: &&Name| !name.values.is_empty();
        let arrays = self.facts.names.iter().filter(valued);
        let arrays: BTreeSet<u32> = arrays.filter_map(|name| name.whole).collect();
        for motion in std::mem::take(&mut self.motions) {
            let index = match motion.goal {
                Goal::Inline(index) => {
                    let target = &mut self.program.targets[index];
                    target.ways.add(motion.way);
                    if motion.nearest {
                        target.forget_configuration();
                    }
                    if let Referred::Unknown(says) = &self.program.ways.get(motion.way)[MODE] {
                        target.leave(Reason::Frame, says.clone());
                    }
                    self.program.visits.push(index);
                    continue;
                }
                Goal::Handed(index) => {
                    if let [only] = self.name(index).values[..] {
                        self.program.visits.push(only);
                    }
                    continue;
                }
                Goal::Name(index) | Goal::Part(index) => index,
            };
            let is_part = matches!(motion.goal, Goal::Part(_));
            let mode = &self.program.ways.get(motion.way)[MODE];
            if matches!(mode, Referred::Unknown(_)) {
                self.said(index).blocked.get_or_insert(motion.way);
            }
            let handed = self.is_handed_to(index);
            let name = self.name(index);
            name.ways.add(motion.way);
            name.kept = name.kept.max(Some(!motion.nearest));
            match name.values[..] {
                [only] if !is_part => self.program.visits.push(only),
                [] if handed || is_part && arrays.contains(&index) => {}
                [] => {
                    if let Some(spelled) = motion.spelled {
                        let says = self.without_values(index, &spelled, elsewhere);
                        self.left(motion.at, says);
                    }
                }
                _ => {}
            }
        }
        self.follow_parameters();
        self.judge();
        for name in &self.facts.names {
            let Some(span) = name.changed else { continue };
            let spelled = self.text.shown(span.range());
            for declared in &mut self.program.declared {
                if let Some(declared) = declared.get_mut(&spelled.to_lowercase()) {
                    let spelled = &spelled;
                    declared.pose = Err(text!("{spelled} is changed at run time", spelled));
                }
            }
        }
        self.program.sort();
        self.program
    }

    /// Why a name that motions go to has no values in the file.
    fn without_values(
        &self,
        index: u32,
        spelled: &str,
        elsewhere: fn(&str) -> Sentence,
    ) -> Sentence {
        match self.facts.names[index as usize].declared {
            Declared::Parameter => from_the_caller(spelled),
            Declared::Target => not_in_numbers(spelled),
            Declared::Other(kind) => text!(
                "{spelled} is declared as {kind}, which is no target",
                spelled,
                kind = kind.map_or_else(String::new, |kind| self.text.shown(kind.range()))
            ),
            Declared::Nowhere => elsewhere(spelled),
        }
    }

    /// What the motions say of names is said of their values.
    fn judge(&mut self) {
        let names = self.facts.scopes.iter().flat_map(|scope| &scope.names);
        let set = names.filter(|(name, _)| self.facts.held.get(*name) == Some(&true));
        let as_frame: BTreeSet<u32> = set.map(|(_, index)| *index).collect();
        for (index, name) in (0..).zip(&self.facts.names) {
            let Some(one) = name.values.first() else {
                continue;
            };
            let whole = name.whole.map(|whole| &self.facts.names[whole as usize]);
            let both = || [Some(name), whole].into_iter().flatten();
            let said =
                |of: fn(&Said) -> Option<&str>| both().find_map(|name| of(name.said.as_deref()?));
            let used = both().any(|name| name.used);
            let left = if let Some(command) = said(|said| said.relative.as_deref()) {
                let says = text!("{command} is a relative motion", command);
                Some((Reason::Relative, says))
            } else if both().any(|name| name.changed.is_some()) {
                Some((Reason::Changed, text!("its value is changed at run time")))
            } else if !used {
                let says = match said(|said| Some(&*said.mentioned.as_ref()?.1)) {
                    Some(command) => text!(
                        "no motion of this file goes to it: {says}",
                        says = text!("{command} uses it", command)
                    ),
                    None => text!("no motion of this file goes to it"),
                };
                Some((Reason::Unused, says))
            } else if as_frame.contains(&index) {
                Some((Reason::Frame, text!("it is a base or a tool as well")))
            } else {
                let blocked = both().find_map(|name| name.said.as_ref()?.blocked);
                match blocked.map(|way| &self.program.ways.get(way)[MODE]) {
                    Some(Referred::Unknown(says)) => Some((Reason::Frame, says.clone())),
                    _ => None,
                }
            };
            let own = name.said.as_deref();
            let mentioned = own.and_then(|said| Some(said.mentioned.as_ref()?.0));
            if let Some(at) = mentioned.filter(|_| left.is_none()) {
                let name = &self.program.targets[*one].name;
                let text = text!(
                    "{name} is used here as well, with its corrected values",
                    name
                );
                self.program.notes.push(Remark { at, text });
            }
            // Where nothing says that it is a target at all, it is none.
            let undeclared = !used && both().all(|name| name.declared == Declared::Nowhere);
            for value in &name.values {
                let target = &mut self.program.targets[*value];
                both().for_each(|name| target.ways.join(name.ways));
                if both().filter_map(|name| name.kept).max() == Some(false) {
                    target.forget_configuration();
                }
                if let Some(near) = own.and_then(|said| said.near.as_ref()) {
                    target.posture_mut().near = Some(near.clone());
                }
                if let Some((reason, says)) = &left {
                    target.is_none = undeclared && *reason != Reason::Relative;
                    target.leave(*reason, says.clone());
                }
            }
        }
    }
}
