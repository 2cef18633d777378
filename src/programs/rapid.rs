//! RAPID (ABB): `jointtarget`, `robtarget`, in declarations, arrays and moves.
//!
//! ```text
//! jointtarget  [[rax_1 … rax_6], [eax_a … eax_f]]                      degrees (mm)
//! robtarget    [[x, y, z], [q1 … q4], [cf1, cf4, cf6, cfx], [eax_a … eax_f]]   mm
//! ```
//!
//! `cf1`, `cf4`, `cf6` are the quadrants of axes 1, 4 and 6. `cfx` says in bit 0 that axis 5 is
//! negative, in bit 1 that the wrist is behind the lower arm, in bit 2 that it is behind axis 1. An
//! external axis that is not there has 9E9.
//!
//! ```text
//! tooldata   [robhold, [[x, y, z], [q1 … q4]], …]                      on the flange
//! wobjdata   [robhold, ufprog, ufmec, [[x, y, z], [q1 … q4]], [[x, y, z], [q1 … q4]]]   user · object frame
//! ```

mod lists;

use std::collections::BTreeMap;

use super::axes::Axes;
use super::moves::{Goal, Moves};
use super::program::Program;
use super::referred::{Names, Referred, declare, declare_none};
use super::target::{Problem, Remark};
use super::text::Text;
use super::tokens::{Dialect, Kind, Source, Words};

use lists::{Lists, Tree, is_array, mass};

const DIALECT: Dialect = Dialect {
    comment: Some(b'!'),
    strings: b"\"",
    bits: false,
};

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes).to_lowercase();
    let starts = text.lines().map(str::trim_start);
    let mut said = starts.map(|line| {
        line.starts_with("module ")
            || line.starts_with("%%%")
            || line.contains(" robtarget ")
            || line.contains(" jointtarget ")
    });
    said.any(|said| said)
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    axes.check_own("eax_a to eax_f")?;
    let source = Source::new(text, DIALECT, phrase!("the end of the file"));
    let words = source.words(text.start()..text.bytes.len());
    let mut reader = RapidReader {
        words: words.map_err(|problem| vec![problem])?,
        axes,
        program: Program::default(),
        problems: Vec::new(),
        moves: Moves::default(),
        loads: BTreeMap::new(),
        gripped: Vec::new(),
    };
    declare_none(&mut reader.program.tools, "tool0");
    reader.run();
    for (name, at) in std::mem::take(&mut reader.gripped) {
        if let Some(kg) = reader.loads.get(&name.to_lowercase()) {
            reader.program.loads.state(*kg, at, &name);
        }
    }
    if reader.problems.is_empty() {
        Ok(reader.moves.finish(reader.program, |spelled| {
            text!("{spelled} is declared elsewhere", spelled)
        }))
    } else {
        Err(reader.problems)
    }
}

struct RapidReader<'t, 'a> {
    words: Words<'t, 'a>,
    axes: &'t Axes,
    program: Program,
    problems: Vec<Problem>,
    moves: Moves,
    /// Masses of `loaddata`, kg, by name.
    loads: BTreeMap<String, f64>,
    /// What `GripLoad` names, and where.
    gripped: Vec<(String, usize)>,
}

impl<'t, 'a> RapidReader<'t, 'a> {
    fn run(&mut self) {
        let mut k = 0;
        while k < self.words.len() {
            k = match self.words.name(k).as_deref() {
                Some(
                    kind @ ("robtarget" | "jointtarget" | "tooldata" | "wobjdata" | "loaddata"),
                ) => self.declaration(k, kind),
                Some("gripload") if self.words.kind(k + 1) == Some(Kind::Name) => {
                    let one = (self.words.spelled(k + 1), self.words.at(k + 1));
                    self.gripped.push(one);
                    k + 2
                }
                Some(name) if is_move(name) => self.motion(k, name),
                Some(name) => {
                    if SHIFTS.contains(&name) {
                        let says = text!("{name} shifts the poses after it", name);
                        self.run_time(self.words.at(k), says);
                    }
                    self.other_name(k)
                }
                None if self.words.is_sign(k, b'[') => self.loose_list(k),
                None => k + 1,
            };
        }
    }

    /// `robtarget name{3} := value;`
    fn declaration(&mut self, k: usize, kind: &str) -> usize {
        if self.words.kind(k + 1) != Some(Kind::Name) {
            return k + 1;
        }
        let (at, spelled) = (self.words.at(k + 1), self.words.spelled(k + 1));
        let mut k = k + 2;
        let array = self.words.is_sign(k, b'{');
        if array {
            k = self.words.until(k + 1, b"}") + 1;
        }
        let valued = self.words.is_sign(k, b':') && self.words.is_sign(k + 1, b'=');
        k += if valued { 2 } else { 0 };
        if !valued || !self.words.is_sign(k, b'[') {
            // Without a value, or a parameter of a procedure.
            if kind == "loaddata" {
                return k;
            }
            if let Some(names) = self.names(kind) {
                declare(
                    names,
                    &spelled,
                    at,
                    Err(text!(
                        "{spelled} has no value in this file",
                        spelled = &spelled
                    )),
                );
            } else if valued {
                self.moves.changed(spelled, self.words.at(k));
            }
            return k;
        }
        let (tree, end) = match self.lists().list(k, 0) {
            Ok(list) => list,
            Err(problem) => {
                self.problems.push(problem);
                return self.words.until(k, b";");
            }
        };
        if kind == "loaddata" {
            if let Some(kg) = mass(Some(&tree)) {
                self.loads.insert(spelled.to_lowercase(), kg);
            }
            return end;
        }
        let pose = self.lists().held(&tree, &spelled, kind == "tooldata");
        if let Some(names) = self.names(kind) {
            declare(names, &spelled, at, pose);
            let load = tree.list().and_then(|parts| parts.get(2));
            if let Some(declared) = names.get_mut(&spelled.to_lowercase())
                && kind == "tooldata"
            {
                declared.mass_kg = mass(load);
            }
        } else {
            self.declared(&tree, &spelled, &spelled, kind == "robtarget", array);
        }
        if !self.words.is_sign(end, b';') {
            let problem = self
                .words
                .problem(end, text!("a semicolon behind {spelled}", spelled));
            self.problems.push(problem);
        }
        end
    }

    /// Where what is declared is kept, unless it is a target.
    fn names(&mut self, kind: &str) -> Option<&mut Names> {
        match kind {
            "tooldata" => Some(&mut self.program.tools),
            "wobjdata" => Some(&mut self.program.frames),
            _ => None,
        }
    }

    fn declared(&mut self, tree: &Tree, name: &str, spelled: &str, pose: bool, array: bool) {
        if array {
            for (index, element) in tree.list().unwrap_or_default().iter().enumerate() {
                let spelled = format!("{spelled}{{{}}}", index + 1);
                self.declared(element, name, &spelled, pose, is_array(element, pose));
            }
            return;
        }
        match self.lists().target(tree, spelled, Some(pose)) {
            Ok(Some(target)) => {
                self.moves
                    .target(&mut self.program, Some(&name.to_lowercase()), target);
            }
            Ok(None) => {
                let at = match tree {
                    Tree::List(_, at) => *at,
                    Tree::Number(number) => number.range().start,
                    Tree::Other(k) => self.words.at(*k),
                };
                self.run_time(
                    at,
                    text!(
                        "{spelled} has values that are computed at run time",
                        spelled
                    ),
                );
            }
            Err(problem) => self.problems.push(problem),
        }
    }

    /// A list that stands in no declaration and no move: an assignment, or a parameter.
    fn loose_list(&mut self, k: usize) -> usize {
        let (tree, end) = match self.lists().list(k, 0) {
            Ok(list) => list,
            Err(problem) => {
                self.problems.push(problem);
                return self.words.until(k, b";");
            }
        };
        // The name in front of `:= [`.
        let assigned = k >= 3
            && self.words.is_sign(k - 1, b'=')
            && self.words.is_sign(k - 2, b':')
            && self.words.kind(k - 3) == Some(Kind::Name);
        let name = assigned.then(|| self.words.spelled(k - 3));
        // Any other list is no target and no problem.
        match self
            .lists()
            .target(&tree, name.as_deref().unwrap_or("a target"), None)
        {
            Ok(Some(target)) => {
                let name = name.map(|name| name.to_lowercase());
                self.moves
                    .target(&mut self.program, name.as_deref(), target);
            }
            _ => {
                if let Some(name) = name {
                    self.moves.changed(name, self.words.at(k - 3));
                }
            }
        }
        end
    }

    /// `name := …` and `name.trans.x := …` change a target at run time.
    fn other_name(&mut self, k: usize) -> usize {
        let mut next = k + 1;
        if self.words.is_sign(next, b'{') {
            next = self.words.until(next + 1, b"}") + 1;
        }
        let mut component = false;
        while self.words.is_sign(next, b'.') && self.words.kind(next + 1) == Some(Kind::Name) {
            component = true;
            next += 2;
        }
        let assigned = self.words.is_sign(next, b':') && self.words.is_sign(next + 1, b'=');
        let literal = self.words.is_sign(next + 2, b'[') && !component;
        if assigned && !literal {
            self.moves.changed(self.words.spelled(k), self.words.at(k));
            return next + 2;
        }
        k + 1
    }

    /// `MoveL p1, v100, fine, tGun\WObj:=fixture;`, argument by argument.
    fn motion(&mut self, k: usize, name: &str) -> usize {
        let circle = name.starts_with("movec") || matches!(name, "triggc" | "arcc" | "arccend");
        let command = self.words.spelled(k);
        let mut arguments = Vec::new();
        let mut k = k + 1;
        while k < self.words.len() && !self.words.is_sign(k, b';') {
            let end = self.words.until(k, b",;");
            let next_move = |j: &usize| self.words.name(*j).is_some_and(|n| is_move(&n));
            if let Some(j) = (k..end).find(next_move) {
                let expected = text!("a semicolon at the end of the {command} before it", command);
                self.problems.push(self.words.problem(j, expected));
                return j;
            }
            // A switch at the beginning is no argument: `\Conc, p1, …`.
            if !self.words.is_sign(k, b'\\') {
                arguments.push((k, end));
            }
            k = end + usize::from(self.words.is_sign(end, b','));
        }
        let goals = if circle { 2 } else { 1 };
        let (frame, tool) = self.held_in(name, &arguments, goals);
        for (k, end) in arguments.into_iter().take(goals) {
            self.goal(k, end, &command, &frame, &tool);
        }
        k
    }

    /// The work object and the tool of a move.
    fn held_in(
        &self,
        name: &str,
        arguments: &[(usize, usize)],
        goals: usize,
    ) -> (Referred, Referred) {
        // Goals, speed, zone, tool; of other processes the tool is the last.
        let place = if name.starts_with("move") {
            goals + 2
        } else {
            arguments.len().saturating_sub(1)
        };
        let Some(&(k, end)) = arguments.get(place) else {
            return (Referred::Unsaid, Referred::Unsaid);
        };
        let alone = |k: usize, end: usize| self.words.kind(k) == Some(Kind::Name) && end == k + 1;
        let of = |k: usize, end: usize| {
            if alone(k, end) {
                Referred::named(self.words.spelled(k))
            } else {
                Referred::Unknown(text!(
                    "{name} is computed at run time",
                    name = self.words.shown(k, end)
                ))
            }
        };
        let tool = of(k, self.words.until(k, b"\\,;"));
        let is_frame = |j: &usize| {
            self.words.is_sign(*j, b'\\') && self.words.name(*j + 1).is_some_and(|n| n == "wobj")
        };
        // The switch may stand behind a later argument as well.
        let last = arguments.last().map_or(end, |(_, end)| *end);
        let frame = match (k..last).find(is_frame) {
            Some(j) => of(j + 4, self.words.until(j + 4, b"\\,;")),
            None => Referred::Unsaid,
        };
        if frame.is("wobj0") {
            (Referred::Unsaid, tool)
        } else {
            (frame, tool)
        }
    }

    fn goal(&mut self, k: usize, end: usize, command: &str, frame: &Referred, tool: &Referred) {
        let at = self.words.at(k);
        let mut go = |goal| {
            self.moves.push(&mut self.program, at, goal, frame, tool);
        };
        // Switches of the move may follow its target.
        let alone = k + 1 == end || self.words.is_sign(k + 1, b'\\');
        if self.words.kind(k) == Some(Kind::Name) {
            if alone {
                let spelled = self.words.spelled(k);
                return go(Goal::Named(spelled.to_lowercase(), spelled));
            }
            for j in k..end {
                if let Some(name) = self.words.name(j) {
                    go(Goal::Mentioned(name));
                }
            }
            let what = self.words.shown(k, end);
            return self.run_time(
                at,
                text!(
                    "{command} goes to {target}, which is computed at run time",
                    command,
                    target = what
                ),
            );
        }
        if !self.words.is_sign(k, b'[') {
            return;
        }
        let read = self.lists().list(k, 0).and_then(|(tree, behind)| {
            if behind != end && !self.words.is_sign(behind, b'\\') {
                return Err(self.words.problem(behind, text!("a comma or a semicolon")));
            }
            self.lists()
                .target(&tree, &format!("target of {command}"), None)
        });
        match read {
            Ok(Some(target)) => {
                let index = self.moves.target(&mut self.program, None, target);
                let goal = Goal::Inline(index);
                self.moves.push(&mut self.program, at, goal, frame, tool);
            }
            Ok(None) => self.run_time(
                at,
                text!("the target of {command} is computed at run time", command),
            ),
            Err(problem) => self.problems.push(problem),
        }
    }

    fn lists(&self) -> Lists<'_, 't, 'a> {
        Lists {
            words: &self.words,
            axes: self.axes,
        }
    }

    fn run_time(&mut self, at: usize, says: crate::text::Text) {
        self.program.at_run_time.push(Remark { at, text: says });
    }
}

/// Instructions that shift all poses after them at run time.
const SHIFTS: [&str; 3] = ["pdispset", "pdispon", "eoffsset"];

/// Instructions that move to a target that is their first argument.
fn is_move(name: &str) -> bool {
    const MOVES: &str = "movej movel movec moveabsj movejdo moveldo movecdo movejao movelao movecao movejgo movelgo \
        movecgo movejsync movelsync movecsync triggj triggl triggc arcl arcc arclstart arclend \
        arccend spotl spotj";
    MOVES.split(' ').any(|known| known == name)
}
