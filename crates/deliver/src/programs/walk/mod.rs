//! The one walk through the statements of a program, the same for every language.
//!
//! A value is a target only when it is proven to be one: its name is declared as a target (or it stands in a
//! motion itself), a motion goes to it in absolute terms, and base, tool and mode are known at that motion.
//! A language says what its statements declare, set and move to; scopes, branches, loops and calls are followed here.
//! The file is gone through twice by the same rules: which names are declared where, and which routines
//! set something, is known before the first motion is looked at.

mod flow;
mod motions;
mod names;
mod parameters;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::text::Text as Sentence;

use crate::programs::axes::Axes;
use crate::programs::number::Span;
use crate::programs::program::Program;
use crate::programs::referred::{Referred, UsedPairs};
use crate::programs::target::{Outside, Problem};
use crate::programs::text::Text;
use crate::programs::words::{Dialect, Words, statements};

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
    routine: Box<str>,
    names: BTreeMap<Box<str>, u32>,
}

/// What a name was declared as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Declared {
    /// Not in this file.
    #[default]
    Nowhere,
    Target,
    /// Its value comes from the caller.
    Parameter,
    /// Something else, of the type that stands here.
    Other(Option<Span>),
}

/// What a constant that is no target says.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Constant {
    /// A load, kg.
    Load(f64),
    /// External axes.
    External(Box<Outside>),
    /// Numbers of base and tool, and whether the tool stands.
    Frames(Box<([Option<f64>; 2], bool)>),
    /// Joint values, or a pose, in the file's unit.
    List(Box<[f64]>),
    /// Numbers of frame and tool of a position.
    Position(Box<[String; 2]>),
}

/// A name, its values that may be targets, and how motions go to it. A program has as many as it has room for:
/// what few of them have stands apart.
#[derive(Default)]
struct Name {
    declared: Declared,
    values: Vec<usize>,
    /// The array that it is an element of.
    whole: Option<u32>,
    ways: UsedPairs,
    /// Whether a motion goes to it, and whether one did the first time through.
    used: bool,
    was_used: bool,
    /// Whether it is the one of an outer routine, if that has it.
    weak: bool,
    /// Whether a motion keeps its configuration, of those that go to it.
    kept: Option<bool>,
    /// Where its value is worked out at run time.
    changed: Option<Span>,
    said: Option<Box<Said>>,
}

/// What few names have: why they are no targets, and joint values near which a motion wants them.
#[derive(Default)]
struct Said {
    near: Option<Vec<f64>>,
    /// The command of a relative motion that uses it.
    relative: Option<Box<str>>,
    /// What else uses it, and where.
    mentioned: Option<(usize, Box<str>)>,
    /// The way of a motion whose mode keeps poses from being where they are written.
    blocked: Option<u32>,
}

/// What a motion goes to.
enum Goal {
    Inline(usize),
    Name(u32),
    /// An element of an array that is chosen at run time, or a name that the goal is worked out from.
    Part(u32),
    /// A name that a call hands to a parameter: it is gone to where the parameter is.
    Handed(u32),
}

struct Motion {
    goal: Goal,
    at: usize,
    way: u32,
    since: [u32; 3],
    /// Whether it comes as it is nearest, whatever configuration its goal states.
    nearest: bool,
    /// How the name is spelled, where the file has no values for it.
    spelled: Option<Box<str>>,
}

/// What was learnt the first time through.
#[derive(Default)]
struct Facts {
    scopes: Vec<Scope>,
    names: Vec<Name>,
    /// By the module that declares them.
    constants: BTreeMap<(usize, Box<str>), Constant>,
    /// Names of bases and tools, and whether a statement sets them.
    held: BTreeMap<Box<str>, bool>,
    /// What routines set, and who is called from which scope.
    sets: BTreeMap<Box<str>, [bool; 3]>,
    calls: BTreeSet<(Box<str>, usize)>,
    /// Parameters of routines in their order, without those that are optional; none of routines of one name.
    parameters: BTreeMap<Box<str>, Vec<u32>>,
    /// Whether motions keep the configurations of their goals, those of joints and those along lines, where the file
    /// says so.
    keeps: [Option<bool>; 2],
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
    text: &'x Text<'x>,
    facts: Facts,
    /// Whether this is the first time through.
    first: bool,
    scopes: usize,
    scope: usize,
    /// The names of the module that is open; the file's, where it has none.
    module: usize,
    modules: BTreeMap<String, usize>,
    /// Routines so far.
    pub(super) routines: usize,
    open: Vec<Routine>,
    state: State,
    blocks: Vec<Block>,
    statement: u32,
    /// Where the statement begins.
    at: usize,
    motions: Vec<Motion>,
    /// A parameter, and a name that a call hands to it.
    handed: BTreeSet<[u32; 2]>,
    /// Where those names stand.
    handed_at: BTreeSet<usize>,
    /// Whether the motion that is read comes as it is nearest.
    nearest: bool,
}

/// The program of some pieces of a file, each with its dialect and grammar. `prepare`: what is known before.
pub(super) fn walked(
    text: &Text,
    axes: &Axes,
    pieces: &[(Range<usize>, &'static Dialect, Grammar)],
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
            text,
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
            at: 0,
            motions: Vec::new(),
            handed: BTreeSet::new(),
            handed_at: BTreeSet::new(),
            nearest: false,
        };
        prepare(&mut walk);
        for (range, dialect, grammar) in pieces {
            statements(text, range.clone(), dialect, |words| {
                walk.statement += 1;
                let taken = words.and_then(|words| {
                    walk.at = words.at(0);
                    grammar(&mut walk, words)
                });
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
        walk.follow_parameters();
        facts = walk.facts;
        facts.close();
    }
    Err(problems)
}

impl Facts {
    /// What routines set goes to those that call them; names forget their values.
    fn close(&mut self) {
        let setting = self.sets.iter().filter(|(_, set)| set.contains(&true));
        let mut open: Vec<Box<str>> = setting.map(|(name, _)| name.clone()).collect();
        while let Some(called) = open.pop() {
            let set = self.sets[&called];
            let calls = self.calls.range((called.clone(), 0)..);
            for (_, scope) in calls.take_while(|(own, _)| *own == called) {
                let caller = &self.scopes[*scope].routine;
                let own = self.sets.entry(caller.clone()).or_default();
                let more = [0, 1, 2].map(|k: usize| own[k] | set[k]);
                if more != *own {
                    *own = more;
                    open.push(caller.clone());
                }
            }
        }
        for set in self
            .anytime
            .iter()
            .filter_map(|name| self.sets.get(&**name))
        {
            self.interrupted = [0, 1, 2].map(|k: usize| self.interrupted[k] | set[k]);
        }
        for scope in 1..self.scopes.len() {
            let mut own = std::mem::take(&mut self.scopes[scope].names);
            let outer = self.scopes[scope].parent;
            own.retain(|name, index| {
                !self.names[*index as usize].weak || self.seen(outer, name).is_none()
            });
            self.scopes[scope].names = own;
        }
        for name in &mut self.names {
            *name = Name {
                declared: name.declared,
                whole: name.whole,
                was_used: name.used,
                ..Name::default()
            };
        }
    }

    /// The name as it is seen from a scope.
    fn seen(&self, mut scope: usize, name: &str) -> Option<u32> {
        loop {
            let found = self.scopes[scope].names.get(name);
            if found.is_some() || scope == 0 {
                return found.copied();
            }
            scope = self.scopes[scope].parent;
        }
    }
}
