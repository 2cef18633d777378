//! The one walk through the statements of a program, the same for every language.
//!
//! A value is a target only when it is proven to be one: its name is declared as a target (or it stands in a
//! motion itself), a motion goes to it in absolute terms, and base, tool and mode are known at that motion.
//! A language says what its statements declare, set and move to; scopes, branches, loops and calls are followed here.
//! The file is gone through twice by the same rules: which names are declared where, and which routines
//! set something, is known before the first motion is looked at.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::text::Text as Sentence;

use super::answer::Reason;
use super::axes::{Axes, Slot};
use super::program::Program;
use super::referred::{FrameAndTool, Referred, UsedPairs};
use super::target::{Outside, Problem, Remark, Target};
use super::text::Text;
use super::words::{Dialect, Words, statements};

/// Base (work object, frame), tool, and what else keeps poses from being where they are written.
pub(super) const BASE: usize = 0;
pub(super) const TOOL: usize = 1;
pub(super) const MODE: usize = 2;

/// Blocks in blocks, and routines in routines.
const DEEPEST: usize = 64;

/// How one statement of a language is taken.
pub(super) type Grammar = fn(&mut Walk, &Words) -> Result<(), Problem>;

/// What holds at a statement, and since which one.
#[derive(Clone, Default)]
struct Known {
    what: Referred,
    since: u32,
}

type State = [Known; 3];

/// A branch or a loop that is open.
struct Block {
    entry: State,
    exits: Vec<State>,
    /// Whether one of its branches is always taken.
    whole: bool,
    loops: bool,
    /// The first motion in it, and the statement that opens it.
    motions: usize,
    statement: u32,
}

/// A routine that is open: what was before it.
struct Routine {
    scope: usize,
    name: String,
    state: State,
    blocks: Vec<Block>,
    /// Whether its handler of errors has begun.
    handles: bool,
}

/// Names of a routine, or of the file.
#[derive(Default)]
struct Scope {
    parent: usize,
    names: BTreeMap<String, usize>,
}

/// What a name was declared as.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) enum Declared {
    /// Not in this file.
    #[default]
    Nowhere,
    Target,
    /// Its value comes from the caller.
    Parameter,
    /// Something else, of this type.
    Other(String),
}

/// What a constant that is no target says.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Constant {
    /// A load, kg.
    Load(f64),
    /// External axes.
    External(Outside),
    /// Numbers of tool and base, and whether the tool stands.
    Frames([Option<f64>; 2], bool),
    /// Joint values, in the file's unit.
    List(Vec<f64>),
    /// Numbers of frame and tool of a position.
    Position([String; 2]),
}

/// A name, its values that may be targets, and how motions go to it.
#[derive(Default)]
struct Name {
    declared: Declared,
    /// The first of its values; nearly every name has just this one.
    first: Option<usize>,
    others: Vec<usize>,
    /// The array that it is an element of.
    whole: Option<usize>,
    ways: UsedPairs,
    /// Whether a motion goes to it, and whether one did the first time through.
    used: bool,
    was_used: bool,
    said: Option<Box<Said>>,
}

/// What few names have: why they are no targets, and joint values near which a motion wants them.
#[derive(Default, Clone)]
struct Said {
    near: Option<Vec<f64>>,
    changed: Option<usize>,
    relative: Option<Sentence>,
    blocked: Option<Sentence>,
    mentioned: Option<(usize, Sentence)>,
}

/// What a motion goes to.
enum Goal {
    Inline(usize),
    Name(usize),
    /// An element of an array that is chosen at run time, or a name that the goal is worked out from.
    Part(usize),
}

struct Motion {
    goal: Goal,
    at: usize,
    way: u32,
    since: [u32; 3],
    /// How the name is spelled, where the file has no values for it.
    spelled: Option<Box<str>>,
}

/// What was learnt the first time through.
#[derive(Default)]
struct Facts {
    scopes: Vec<Scope>,
    names: Vec<Name>,
    /// By the module that declares them.
    constants: BTreeMap<(usize, String), Constant>,
    /// Names that are set as a base or a tool.
    tools: BTreeSet<String>,
    /// Names that are of an outer routine, if that has them.
    weak: Vec<(usize, String)>,
    /// What routines set, and who is called by whom.
    sets: BTreeMap<String, [bool; 3]>,
    calls: BTreeSet<(String, String)>,
    /// Whether anything in the file is set to something.
    any: [bool; 3],
    /// Routines that may run at any statement, and what they set.
    anytime: BTreeSet<String>,
    interrupted: [bool; 3],
}

/// The walk as a language sees it.
pub(super) struct Walk<'x> {
    pub(super) axes: &'x Axes,
    pub(super) program: Program,
    facts: Facts,
    /// Whether this is the first time through.
    first: bool,
    scopes: usize,
    scope: usize,
    /// The names of the module that is open; the file's, where it has none.
    module: usize,
    modules: BTreeMap<String, usize>,
    routines: usize,
    open: Vec<Routine>,
    state: State,
    blocks: Vec<Block>,
    statement: u32,
    motions: Vec<Motion>,
    /// Names that are changed at run time.
    changes: BTreeSet<String>,
}

/// The program of some pieces of a file, each with its dialect and grammar. `prepare`: what is known before.
pub(super) fn walked(
    text: &Text,
    axes: &Axes,
    pieces: &[(Range<usize>, &Dialect, Grammar)],
    prepare: impl Fn(&mut Walk),
    elsewhere: fn(&str) -> Sentence,
) -> Result<Program, Vec<Problem>> {
    let mut facts = Facts {
        scopes: vec![Scope::default()],
        ..Facts::default()
    };
    let mut problems = Vec::new();
    for first in [true, false] {
        let mut walk = Walk {
            axes,
            program: Program::default(),
            facts,
            first,
            scopes: 1,
            scope: 0,
            module: 0,
            modules: BTreeMap::new(),
            routines: 0,
            open: Vec::new(),
            state: State::default(),
            blocks: Vec::new(),
            statement: 0,
            motions: Vec::new(),
            changes: BTreeSet::new(),
        };
        prepare(&mut walk);
        for (range, dialect, grammar) in pieces {
            statements(text, range.clone(), dialect, |words| {
                walk.statement += 1;
                let taken = words.and_then(|words| grammar(&mut walk, words));
                problems.extend(taken.err().filter(|_| !first));
            });
        }
        if !first {
            let program = walk.finished(elsewhere);
            return if problems.is_empty() {
                Ok(program)
            } else {
                Err(problems)
            };
        }
        facts = walk.facts;
        facts.close();
    }
    Err(problems)
}

impl Facts {
    /// What routines set goes to those that call them; names forget their values.
    fn close(&mut self) {
        let setting = self.sets.iter().filter(|(_, set)| set.contains(&true));
        let mut open: Vec<(String, [bool; 3])> =
            setting.map(|(name, set)| (name.clone(), *set)).collect();
        while let Some((called, set)) = open.pop() {
            let from = (called, String::new());
            for (_, caller) in self
                .calls
                .range(&from..)
                .take_while(|(own, _)| *own == from.0)
            {
                let own = self.sets.entry(caller.clone()).or_default();
                let more = [0, 1, 2].map(|k: usize| own[k] | set[k]);
                if more != *own {
                    *own = more;
                    open.push((caller.clone(), more));
                }
            }
        }
        for set in self.anytime.iter().filter_map(|name| self.sets.get(name)) {
            self.interrupted = [0, 1, 2].map(|k: usize| self.interrupted[k] | set[k]);
        }
        for (scope, name) in std::mem::take(&mut self.weak) {
            let mut outer = scope;
            while outer != 0 {
                outer = self.scopes[outer].parent;
                if self.scopes[outer].names.contains_key(&name) {
                    self.scopes[scope].names.remove(&name);
                    break;
                }
            }
        }
        for name in &mut self.names {
            *name = Name {
                declared: std::mem::take(&mut name.declared),
                whole: name.whole,
                was_used: name.used,
                ..Name::default()
            };
        }
    }
}

impl Walk<'_> {
    /// Something in the file that is not corrected, and why.
    pub(super) fn left(&mut self, at: usize, says: Sentence) {
        self.program.at_run_time.push(Remark { at, text: says });
    }

    /// A name of this scope (`outer`: of the file) that is declared here.
    pub(super) fn declare(&mut self, name: &str, declared: Declared, outer: bool) {
        let scope = if outer { 0 } else { self.scope };
        let name = self.own(scope, name);
        let known = &mut self.facts.names[name].declared;
        if *known == Declared::Nowhere {
            *known = declared;
        }
    }

    /// A name that is given a value here: one of this routine, unless an outer one has it.
    pub(super) fn given(&mut self, name: &str) {
        if self.first {
            self.own(self.scope, name);
            self.facts.weak.push((self.scope, name.to_owned()));
        }
    }

    /// Whether motions go to a name.
    pub(super) fn is_gone_to(&self, name: &str) -> bool {
        self.seen(name)
            .is_some_and(|name| self.facts.names[name].was_used)
    }

    fn own(&mut self, scope: usize, name: &str) -> usize {
        let names = &mut self.facts.scopes[scope].names;
        if let Some(index) = names.get(name) {
            return *index;
        }
        names.insert(name.to_owned(), self.facts.names.len());
        self.facts.names.push(Name::default());
        self.facts.names.len() - 1
    }

    /// The name as it is seen from here.
    fn seen(&self, name: &str) -> Option<usize> {
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
    fn owner(&mut self, name: &str) -> usize {
        match self.seen(name) {
            Some(index) => index,
            None => self.own(0, name),
        }
    }

    /// What a name is declared as, seen from here.
    pub(super) fn declared(&self, name: &str) -> Declared {
        let seen = self
            .seen(name)
            .map(|seen| self.facts.names[seen].declared.clone());
        seen.unwrap_or_default()
    }

    /// Whether the file says something of a name that is seen from here.
    pub(super) fn knows(&self, name: &str) -> bool {
        self.seen(name).is_some()
    }

    /// Whether a name has a value already.
    pub(super) fn has_value(&self, name: &str) -> bool {
        self.seen(name)
            .is_some_and(|name| self.facts.names[name].first.is_some())
    }

    /// Whether a pose that no motion goes to is to be told: the names are known, and it is no tool.
    pub(super) fn is_told(&self, name: &str) -> bool {
        !self.first && !self.facts.tools.contains(&name.to_lowercase())
    }

    /// Routines and modules that are open.
    pub(super) fn depth(&self) -> usize {
        self.open.len()
    }

    /// The number of where external axes are that the model does not have.
    pub(super) fn outside(&mut self, axes: Outside) -> u32 {
        let own = |k: usize| self.axes.joint(Slot::External(k)).is_none();
        let outside = std::array::from_fn(|k| axes[k].filter(|_| own(k)));
        self.program.outside(outside)
    }

    /// What a constant says that is no target.
    pub(super) fn constant(&mut self, name: &str, constant: Constant) {
        let name = (self.module, name.to_lowercase());
        // Of a name with several values none is known.
        let several = |known: &Constant| *known != constant;
        let known = match self.facts.constants.get(&name) {
            Some(known) if several(known) => Constant::List(Vec::new()),
            _ => constant,
        };
        self.facts.constants.insert(name, known);
    }

    pub(super) fn constant_of(&self, name: &str) -> Option<&Constant> {
        let mut name = (self.module, name.to_lowercase());
        let known = self.facts.constants.get(&name);
        known.or_else(|| {
            name.0 = 0;
            self.facts.constants.get(&name)
        })
    }

    /// A value of a name that may be a target; `array`: of which the name is an element.
    pub(super) fn value(&mut self, name: &str, array: Option<&str>, target: Target) {
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

    fn target(&mut self, mut target: Target) -> usize {
        target.shrink();
        self.program.targets.push(target);
        self.program.targets.len() - 1
    }

    /// A name whose value is worked out at run time.
    pub(super) fn changed(&mut self, name: &str, spelled: &str, at: usize) {
        let name = self.owner(name);
        self.said(name).changed.get_or_insert(at);
        self.changes.insert(spelled.to_owned());
    }

    fn said(&mut self, name: usize) -> &mut Said {
        self.facts.names[name].said.get_or_insert_default()
    }

    /// A target that a relative motion uses.
    pub(super) fn relative(&mut self, name: &str, command: &str) {
        let name = self.owner(name);
        let says = text!("{command} is a relative motion", command);
        self.said(name).relative.get_or_insert(says);
    }

    /// A target that is used, but not as what a motion goes to.
    pub(super) fn mention(&mut self, name: &str, at: usize, by: &str) {
        let Some(name) = self.seen(name) else {
            return;
        };
        self.said(name)
            .mentioned
            .get_or_insert_with(|| (at, text!("{command} uses it", command = by)));
    }

    /// Every name among some words.
    pub(super) fn mention_all(&mut self, words: &Words, range: Range<usize>, by: &str) {
        for k in range {
            if words.is_name(k) {
                self.mention(&words.name(k), words.at(k), by);
            }
        }
    }

    fn way(&mut self, changes: &[(usize, Referred)]) -> u32 {
        let mut parts = self.state.clone().map(|known| known.what);
        for part in [BASE, TOOL, MODE] {
            if self.facts.interrupted[part] && !self.first {
                let says = text!("an interrupt or a handler of errors sets it");
                parts[part] = Referred::Unknown(says);
            }
        }
        for (part, what) in changes {
            parts[*part] = what.clone();
        }
        self.program.ways.of(FrameAndTool::new(parts))
    }

    fn go(&mut self, goal: Goal, at: usize, changes: &[(usize, Referred)], spelled: Option<&str>) {
        let way = self.way(changes);
        let mut since = [0, 1, 2].map(|part: usize| self.state[part].since);
        for (part, _) in changes {
            since[*part] = self.statement;
        }
        self.motions.push(Motion {
            goal,
            at,
            way,
            since,
            spelled: spelled.map(Into::into),
        });
    }

    /// A motion to a target that stands in it; `changes`: what the motion says itself.
    pub(super) fn go_to(&mut self, target: Target, changes: &[(usize, Referred)]) {
        let at = target.at;
        let index = self.target(target);
        self.go(Goal::Inline(index), at, changes, None);
    }

    /// A motion to a name, as it is spelled and as the language tells names apart.
    pub(super) fn go_to_name(
        &mut self,
        (name, spelled): (&str, &str),
        at: usize,
        near: Option<Vec<f64>>,
        changes: &[(usize, Referred)],
    ) {
        let name = self.owner(name);
        let own = &mut self.facts.names[name];
        own.used = true;
        if near.is_some() {
            let said = own.said.get_or_insert_default();
            said.near = said.near.take().or(near);
        }
        self.go(Goal::Name(name), at, changes, Some(spelled));
    }

    /// A motion to a part of a name that is chosen at run time (`absolute`), or to what is worked out from it.
    pub(super) fn go_to_part(
        &mut self,
        name: &str,
        at: usize,
        absolute: bool,
        changes: &[(usize, Referred)],
    ) {
        let index = self.owner(name);
        self.facts.names[index].used |= absolute;
        self.go(Goal::Part(index), at, changes, absolute.then_some(name));
    }

    /// A motion to what is worked out at run time, perhaps from names.
    pub(super) fn go_to_worked_out(
        &mut self,
        words: &Words,
        range: Range<usize>,
        command: &str,
        changes: &[(usize, Referred)],
    ) {
        let at = words.at(range.start);
        let target = words.shown(range.start, range.end);
        let says = text!(
            "{command} goes to {target}, which is computed at run time",
            command,
            target
        );
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
    pub(super) fn routine_elsewhere(&mut self, at: usize, command: &str) {
        let says = text!(
            "{command} is another routine's: its motions are not in this file",
            command
        );
        self.left(at, says);
    }

    /// Base, tool or mode from here on.
    pub(super) fn set(&mut self, part: usize, what: Referred) {
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
            self.facts.tools.insert(name.to_string());
        }
        self.state[part] = Known {
            what,
            since: self.statement,
        };
    }

    /// Where a jump may come from any place: what is set somewhere is not known.
    pub(super) fn label(&mut self) {
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
    pub(super) fn anytime(&mut self, name: &str) {
        self.facts.anytime.insert(name.to_owned());
    }

    /// The handler of errors of the routine that is open begins.
    pub(super) fn handler(&mut self) {
        if let Some(routine) = self.open.last_mut() {
            routine.handles = true;
        }
    }

    /// What holds of a part.
    pub(super) fn held(&self, part: usize) -> &Referred {
        &self.state[part].what
    }

    /// A call; whether the routine is one of this file.
    pub(super) fn call(&mut self, name: &str, spelled: &str) -> bool {
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
    pub(super) fn has_modules(&mut self, names: BTreeSet<String>) {
        for name in names {
            if self.first {
                self.facts.scopes.push(Scope::default());
            }
            self.modules.insert(name, self.scopes);
            self.scopes += 1;
        }
    }

    /// From here on names are those of this module, if it is one; the one before, to go back to.
    pub(super) fn enter_module(&mut self, name: &str) -> usize {
        let module = self.modules.get(name).copied().unwrap_or(self.module);
        self.return_to(module)
    }

    pub(super) fn return_to(&mut self, module: usize) -> usize {
        self.scope = module;
        std::mem::replace(&mut self.module, module)
    }

    /// A routine begins; its parameters.
    pub(super) fn begin_routine(
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
    pub(super) fn routines(&self) -> usize {
        self.routines
    }

    /// Whether a block of the routine is open.
    pub(super) fn in_block(&self) -> bool {
        !self.blocks.is_empty()
    }

    pub(super) fn end_routine(&mut self) {
        if let Some(routine) = self.open.pop() {
            self.scope = routine.scope;
            self.state = routine.state;
            self.blocks = routine.blocks;
        }
    }

    /// A branch or a loop begins.
    pub(super) fn begin_block(&mut self, loops: bool) -> Result<(), Sentence> {
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
    pub(super) fn alternative(&mut self, last: bool) {
        if let Some(block) = self.blocks.last_mut() {
            let left = std::mem::replace(&mut self.state, block.entry.clone());
            // Of branches that leave the same nothing more is kept.
            if block.exits.last().is_none_or(|exit| !same(exit, &left)) {
                block.exits.push(left);
            }
            block.whole |= last;
        }
    }

    pub(super) fn end_block(&mut self) {
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

    /// The program: what motions go to is applied to the targets, and what is not proven is left.
    fn finished(mut self, elsewhere: fn(&str) -> Sentence) -> Program {
        let names = self.facts.names.iter();
        let arrays = names.filter(|name| name.first.is_some());
        let arrays: BTreeSet<usize> = arrays.filter_map(|name| name.whole).collect();
        for motion in std::mem::take(&mut self.motions) {
            let spelled = motion.spelled.unwrap_or_default();
            let mode = match &self.program.ways.get(motion.way).mode {
                Referred::Unknown(says) => Some(says.clone()),
                _ => None,
            };
            match motion.goal {
                Goal::Inline(index) => {
                    let target = &mut self.program.targets[index];
                    target.ways.add(motion.way);
                    if let Some(says) = mode {
                        target.leave(Reason::Frame, says);
                    }
                    self.program.visits.push(index);
                }
                Goal::Part(name) => {
                    self.gone_to(name, motion.way, mode);
                    let has_values =
                        arrays.contains(&name) || self.facts.names[name].first.is_some();
                    if !has_values && !spelled.is_empty() {
                        self.left(motion.at, self.without_values(name, &spelled, elsewhere));
                    }
                }
                Goal::Name(name) => {
                    self.gone_to(name, motion.way, mode);
                    let own = &self.facts.names[name];
                    match own.first {
                        Some(index) if own.others.is_empty() => self.program.visits.push(index),
                        Some(_) => {}
                        None => {
                            self.left(motion.at, self.without_values(name, &spelled, elsewhere));
                        }
                    }
                }
            }
        }
        self.judged();
        for spelled in &self.changes {
            for declared in [&mut self.program.frames, &mut self.program.tools] {
                if let Some(declared) = declared.get_mut(&spelled.to_lowercase()) {
                    declared.pose = Err(text!("{spelled} is changed at run time", spelled));
                }
            }
        }
        let kept: Vec<bool> = self.program.targets.iter().map(|t| !t.is_none).collect();
        self.program.sorted(&kept);
        self.program
    }

    /// Why a name that motions go to has no values in the file.
    fn without_values(
        &self,
        name: usize,
        spelled: &str,
        elsewhere: fn(&str) -> Sentence,
    ) -> Sentence {
        match &self.facts.names[name].declared {
            Declared::Parameter => text!(
                "{spelled} is a parameter: its value comes from the caller",
                spelled
            ),
            Declared::Target => text!("{spelled} gets its value at run time", spelled),
            Declared::Other(kind) => text!(
                "{spelled} is declared as {kind}, which is no target",
                spelled,
                kind = &**kind
            ),
            Declared::Nowhere => elsewhere(spelled),
        }
    }

    fn gone_to(&mut self, name: usize, way: u32, mode: Option<Sentence>) {
        self.facts.names[name].ways.add(way);
        if let Some(says) = mode {
            self.said(name).blocked.get_or_insert(says);
        }
    }

    /// What the motions say of names is said of their values.
    fn judged(&mut self) {
        let frames = std::mem::take(&mut self.facts.tools);
        let as_frame: BTreeSet<usize> = (self.facts.scopes.iter())
            .flat_map(|scope| &scope.names)
            .filter(|(name, _)| frames.contains(*name))
            .map(|(_, index)| *index)
            .collect();
        for index in 0..self.facts.names.len() {
            let name = &self.facts.names[index];
            let whole = name.whole.map(|whole| &self.facts.names[whole]);
            let mut ways = name.ways;
            ways.join(whole.map(|whole| whole.ways).unwrap_or_default());
            let used = name.used || whole.is_some_and(|whole| whole.used);
            let said = [Some(name), whole].map(|name| name?.said.as_deref());
            let first = |of: fn(&Said) -> Option<Sentence>| said.into_iter().flatten().find_map(of);
            let changed = said
                .into_iter()
                .flatten()
                .any(|said| said.changed.is_some());
            let left = if let Some(says) = first(|said| said.relative.clone()) {
                Some((Reason::Relative, says))
            } else if changed {
                Some((Reason::Changed, text!("its value is changed at run time")))
            } else if !used {
                let mentioned = said
                    .into_iter()
                    .flatten()
                    .find_map(|said| said.mentioned.clone());
                let says = match mentioned {
                    Some((_, says)) => text!("no motion of this file goes to it: {says}", says),
                    None => text!("no motion of this file goes to it"),
                };
                Some((Reason::Unused, says))
            } else if as_frame.contains(&index) {
                Some((Reason::Frame, text!("it is a base or a tool as well")))
            } else {
                first(|said| said.blocked.clone()).map(|says| (Reason::Frame, says))
            };
            let near = name.said.as_ref().and_then(|said| said.near.clone());
            let nowhere = |name: &Name| name.declared == Declared::Nowhere;
            let undeclared = !used && nowhere(name) && whole.is_none_or(nowhere);
            let values: Vec<usize> = name.first.iter().chain(&name.others).copied().collect();
            let mentioned = used
                .then(|| name.said.as_ref()?.mentioned.clone())
                .flatten();
            if let Some((at, _)) = mentioned.filter(|_| left.is_none() && !values.is_empty()) {
                let spelled = self.program.targets[values[0]].name.clone();
                let says = text!(
                    "{name} is used here as well, with its corrected values",
                    name = spelled
                );
                self.program.notes.push(Remark { at, text: says });
            }
            for value in values {
                let target = &mut self.program.targets[value];
                target.ways.join(ways);
                if near.is_some() {
                    target.posture_mut().near.clone_from(&near);
                }
                if let Some((reason, says)) = &left {
                    // Nothing says that it is a target at all.
                    target.is_none = undeclared && *reason != Reason::Relative;
                    target.leave(*reason, says.clone());
                }
            }
        }
    }
}

fn same(a: &State, b: &State) -> bool {
    a.iter().zip(b).all(|(a, b)| a.what == b.what)
}
