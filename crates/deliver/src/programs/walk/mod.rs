//! The one walk through the statements of a program, the same for every language.
//!
//! A value is a target only when it is proven to be one: its name is declared as a target (or it stands in a
//! motion itself), a motion goes to it in absolute terms, and base, tool and mode are known at that motion.
//! A language says what its statements declare, set and move to; scopes, branches, loops and calls are followed here.
//! The file is gone through twice by the same rules: which names are declared where, and which routines
//! set something, is known before the first motion is looked at.

mod flow;
mod names;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::text::Text as Sentence;

use crate::programs::answer::Reason;
use crate::programs::axes::Axes;
use crate::programs::program::Program;
use crate::programs::referred::{FrameAndTool, Referred, UsedPairs};
use crate::programs::target::{Outside, Problem, Remark, Target};
use crate::programs::text::Text;
use crate::programs::words::{Dialect, Words, statements};

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
