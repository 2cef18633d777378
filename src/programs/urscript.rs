//! `URScript` (Universal Robots): lists of joint values and poses `p[…]` in moves, or given to a name
//! that moves go to.
//!
//! ```text
//! movej([q1, …, q6])      rad
//! movel(p[x, y, z, rx, ry, rz])   m, rotation vector in rad
//! ```
//!
//! A pose has no configuration; `get_inverse_kin(p[…], [near])` says one.

mod literals;

use crate::text::Template;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::kinematics::JointKind;

use super::axes::Axes;
use super::moves::{Goal, Moves};
use super::number::Number;
use super::program::Program;
use super::referred::{Referred, declare};
use super::target::{Problem, Remark, Shape, Target};
use super::text::Text;
use super::tokens::{Dialect, Kind, Source, Words};

use literals::{Assigned, Literal, assigned, frame_of, literal};

const DIALECT: Dialect = Dialect {
    comment: Some(b'#'),
    strings: b"\"",
    bits: false,
};

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let moves = ["movej(", "movel(", "movep(", "movec(", "servoj("];
    moves.iter().any(|m| text.contains(m))
        || text.lines().any(|l| l.trim_start().starts_with("def "))
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    if (0..axes.joints()).any(|j| axes.kind(j) == JointKind::Prismatic) {
        let found = text!("a model with a sliding joint");
        return Err(vec![Problem::new(
            0,
            found,
            text!("turning joints, which URScript gives in rad"),
        )]);
    }
    let source = Source::new(text, DIALECT, phrase!("the end of the file"));
    let words = source.words(text.start()..text.bytes.len());
    let words = words.map_err(|problem| vec![problem])?;
    let mut problems = Vec::new();
    let mut reader = UrscriptReader {
        assigned: assigned(&words, &mut problems),
        words,
        axes,
        program: Program::default(),
        problems,
        moves: Moves::default(),
        goals: Vec::new(),
        uses: BTreeMap::new(),
        tool: Referred::Unsaid,
        blocks: Vec::new(),
        functions: 0,
        unsure: false,
    };
    reader.run();
    if reader.problems.is_empty() {
        Ok(reader.finished())
    } else {
        Err(reader.problems)
    }
}

struct UrscriptReader<'t, 'a> {
    words: Words<'t, 'a>,
    axes: &'t Axes,
    program: Program,
    problems: Vec<Problem>,
    assigned: Assigned,
    moves: Moves,
    /// Names that moves go to, in their order, and near which joint values.
    goals: Vec<(String, Option<Vec<f64>>)>,
    /// Where names are used elsewhere than as a target.
    uses: BTreeMap<String, usize>,
    /// The tool that was set last.
    tool: Referred,
    /// Blocks that are open: of a function the tool outside of it, `None` for a branch or a loop.
    blocks: Vec<Option<Referred>>,
    /// Functions so far.
    functions: usize,
    /// Whether a tool is set in a branch or a loop.
    unsure: bool,
}

impl UrscriptReader<'_, '_> {
    fn run(&mut self) {
        let mut k = 0;
        while k < self.words.len() {
            let name = self.words.spelled(k);
            let called = self.words.is_sign(k + 1, b'(');
            if self.words.kind(k) == Some(Kind::Name) && called && targets_of(&name) > 0 {
                k = self.motion(k, &name, targets_of(&name));
                continue;
            }
            match name.as_str() {
                "if" | "while" | "for" => self.blocks.push(None),
                "def" | "thread" | "sec" => {
                    self.blocks.push(Some(self.tool.clone()));
                    if self.functions > 0 {
                        self.tool = Referred::Unknown(CALLER.into());
                    }
                    self.functions += 1;
                }
                "end" => {
                    if let Some(Some(tool)) = self.blocks.pop() {
                        self.tool = tool;
                    }
                }
                "set_payload" | "set_target_payload" | "set_payload_mass" if called => {
                    if let Some(Ok((kg, _))) = self.words.number(k + 2) {
                        let at = self.words.at(k);
                        self.program.loads.state(kg.value, at, &name);
                    }
                }
                "set_tcp" if called => {
                    self.unsure |= self.blocks.contains(&None);
                    self.tool = self.tool_at(k + 2);
                }
                _ => {}
            }
            if self.words.kind(k) == Some(Kind::Name) && !self.words.is_sign(k + 1, b'=') {
                let at = self.words.at(k);
                self.uses.entry(name).or_insert(at);
            }
            k += 1;
        }
    }

    /// The tool that is set by a pose or its name.
    fn tool_at(&mut self, k: usize) -> Referred {
        let end = self.words.until(k, b",)");
        let shown = self.words.shown(k, end);
        let here = literal(&self.words, k)
            .ok()
            .flatten()
            .map(|(literal, _)| literal);
        let given = match self.assigned.get(&shown).map(Vec::as_slice) {
            Some([(_, literal)]) => Some(literal.clone()),
            _ => None,
        };
        let pose = match here.or(given) {
            Some(Literal::Pose(numbers)) => frame_of(&numbers).and_then(|frame| frame.pose()),
            _ => None,
        };
        let pose =
            pose.ok_or_else(|| text!("{shown} is not written out in numbers", shown = &shown));
        declare(&mut self.program.tools, &shown, self.words.at(k), pose);
        Referred::named(shown)
    }

    fn go(&mut self, at: usize, goal: Goal) {
        let frame = Referred::Unsaid;
        self.moves
            .push(&mut self.program, at, goal, &frame, &self.tool);
    }

    fn go_to_name(&mut self, k: usize, near: Option<Vec<f64>>) {
        let name = self.words.spelled(k);
        self.go(self.words.at(k), Goal::Named(name.clone(), name.clone()));
        self.goals.push((name, near));
    }

    fn motion(&mut self, k: usize, command: &str, mut wanted: usize) -> usize {
        let mut k = k + 2;
        while wanted > 0 {
            wanted -= 1;
            match self.goal(k, command) {
                Ok(end) => k = end,
                Err(problem) => {
                    self.problems.push(problem);
                    return k + 1;
                }
            }
            let comma = self.words.is_sign(k, b',');
            if wanted > 0 && !comma {
                let expected = text!("a comma and the next point of {command}", command);
                self.problems.push(self.words.problem(k, expected));
                return k;
            }
            if !comma && !self.words.is_sign(k, b')') {
                self.problems
                    .push(self.words.problem(k, text!("a comma or )")));
                return k + 1;
            }
            k += usize::from(comma && wanted > 0);
        }
        k
    }

    /// One target of a move; the word behind it.
    fn goal(&mut self, k: usize, command: &str) -> Result<usize, Problem> {
        let at = self.words.at(k);
        if let Some((literal, end)) = literal(&self.words, k)? {
            self.inline(&literal, at, command, None)?;
            return Ok(end);
        }
        let end = self.words.until(k, b",)]");
        if end == k {
            return Err(self
                .words
                .problem(k, text!("the target of {command}", command)));
        }
        if end >= self.words.len() {
            return Err(self
                .words
                .problem(end, text!("a closing ) at the end of the move")));
        }
        if self.words.spelled(k) == "get_inverse_kin" && self.words.is_sign(k + 1, b'(') {
            return self.inverse(k + 2, end, command);
        }
        if self.words.kind(k) == Some(Kind::Name) && end == k + 1 {
            self.go_to_name(k, None);
        } else {
            for j in k..end {
                if self.words.kind(j) == Some(Kind::Name) {
                    let at = self.words.at(j);
                    self.uses.entry(self.words.spelled(j)).or_insert(at);
                }
            }
            let what = self.words.shown(k, end);
            self.run_time(
                at,
                text!(
                    "{command} goes to {target}, which is computed at run time",
                    command,
                    target = what
                ),
            );
        }
        Ok(end)
    }

    /// A target that stands in the move.
    fn inline(
        &mut self,
        literal: &Literal,
        at: usize,
        command: &str,
        near: Option<Vec<f64>>,
    ) -> Result<(), Problem> {
        match self.target(literal, at, &format!("target of {command}"), None, near)? {
            Some(index) => self.go(at, Goal::Inline(index)),
            None => self.run_time_goal(at, command),
        }
        Ok(())
    }

    fn run_time_goal(&mut self, at: usize, command: &str) {
        let says = text!("the target of {command} is computed at run time", command);
        self.run_time(at, says);
    }

    /// `get_inverse_kin(pose, near)`: the pose is the target, and what is near says which solution.
    fn inverse(&mut self, k: usize, end: usize, command: &str) -> Result<usize, Problem> {
        let at = self.words.at(k);
        let literal = literal(&self.words, k)?;
        let behind = literal
            .as_ref()
            .map_or_else(|| self.words.until(k, b",)]"), |(_, end)| *end);
        let near = if self.words.is_sign(behind, b',') {
            self.near(behind + 1)?
        } else {
            None
        };
        if let Some((literal, _)) = literal {
            self.inline(&literal, at, command, near)?;
        } else if self.words.kind(k) == Some(Kind::Name) && behind == k + 1 {
            self.go_to_name(k, near);
        } else {
            self.run_time_goal(at, command);
        }
        Ok(end)
    }

    /// `[…]`, a name with such a list, or either as `qnear=…`.
    fn near(&self, k: usize) -> Result<Option<Vec<f64>>, Problem> {
        let k = if self.words.is_sign(k + 1, b'=') {
            k + 2
        } else {
            k
        };
        let values = |numbers: &[Number]| numbers.iter().map(|n| n.value).collect::<Vec<f64>>();
        let joints = self.axes.joints();
        if let Some((Literal::List(numbers), _)) = literal(&self.words, k)? {
            return Ok(Some(values(&numbers)).filter(|v| v.len() == joints));
        }
        let given = self.assigned.get(&self.words.spelled(k));
        Ok(match given.map(Vec::as_slice) {
            Some([(_, Literal::List(numbers))]) if numbers.len() == joints => Some(values(numbers)),
            _ => None,
        })
    }

    /// Keeps a literal as a target; `None` where a part is worked out at run time.
    fn target(
        &mut self,
        literal: &Literal,
        at: usize,
        name: &str,
        key: Option<&str>,
        near: Option<Vec<f64>>,
    ) -> Result<Option<usize>, Problem> {
        let shape = match literal {
            Literal::RunTime => return Ok(None),
            Literal::Pose(numbers) => {
                let Some(frame) = frame_of(numbers) else {
                    let found = text!(one "a pose of {count} number", "a pose of {count} numbers", count = numbers.len());
                    return Err(Problem::new(at, found, text!("p[x, y, z, rx, ry, rz]")));
                };
                Shape::Pose(Box::new(frame))
            }
            Literal::List(numbers) => {
                let joints = self.axes.joints();
                if numbers.len() != joints {
                    let found = text!(one "a list of {count} number", "a list of {count} numbers", count = numbers.len());
                    let expected = text!("{joints}, one for each joint of the model", joints);
                    return Err(Problem::new(at, found, expected));
                }
                Shape::Joints {
                    numbers: numbers.clone(),
                    scales: vec![1.0; joints].into(),
                    decimals: 7,
                }
            }
        };
        let mut target = Target::new(name, at, shape);
        if near.is_some() {
            target.posture_mut().near = near;
        }
        Ok(Some(self.moves.target(&mut self.program, key, target)))
    }

    fn run_time(&mut self, at: usize, says: crate::text::Text) {
        self.program.at_run_time.push(Remark { at, text: says });
    }

    fn finished(mut self) -> Program {
        // Whether a name that moves go to has values.
        let mut gone_to: BTreeMap<String, bool> = BTreeMap::new();
        for (name, near) in std::mem::take(&mut self.goals) {
            if let Entry::Vacant(place) = gone_to.entry(name) {
                let name = place.key().clone();
                place.insert(self.named(&name, near.as_deref()));
            }
        }
        for (name, at) in std::mem::take(&mut self.uses) {
            if gone_to.get(&name) == Some(&true) {
                let says = text!(
                    "{name} is used here as well, with its corrected values",
                    name
                );
                self.program.notes.push(Remark { at, text: says });
            }
        }
        for (name, given) in std::mem::take(&mut self.assigned) {
            let is_tool = self.program.tools.contains_key(&name.to_lowercase());
            for (k, literal) in given {
                if matches!(literal, Literal::Pose(_)) && !is_tool && !gone_to.contains_key(&name) {
                    let says = text!(
                        "{name} is a pose that no move of this file uses",
                        name = &name
                    );
                    self.run_time(self.words.at(k), says);
                }
            }
        }
        let elsewhere = |spelled: &str| {
            text!(
                "{spelled} is computed at run time, or has its values elsewhere",
                spelled
            )
        };
        let mut program = self.moves.finish(self.program, elsewhere);
        if program.tools.is_empty() {
            program.ways.set_tools(&Referred::Unsaid);
        } else if self.unsure {
            let says = text!("set_tcp is called in a branch or a loop");
            program.ways.set_tools(&Referred::Unknown(says));
        }
        program.sort();
        program
    }

    /// Keeps the targets of a name; whether there are any.
    fn named(&mut self, name: &str, near: Option<&[f64]>) -> bool {
        let mut any = false;
        for (k, literal) in self.assigned.get(name).cloned().unwrap_or_default() {
            let at = self.words.at(k);
            match self.target(&literal, at, name, Some(name), near.map(<[f64]>::to_vec)) {
                Ok(target) => any |= target.is_some(),
                Err(problem) => {
                    // A list that is no target of a move after all.
                    let says = text!(
                        "{name} is not corrected: {found}",
                        name,
                        found = problem.found
                    );
                    self.run_time(at, says);
                }
            }
        }
        any
    }
}

/// Why the tool of a function is not known.
const CALLER: Template =
    phrase!("its function may be called with any of the tools that set_tcp sets");

/// How many targets a move has.
fn targets_of(name: &str) -> usize {
    match name {
        "movej" | "movel" | "movep" | "servoj" | "servol" => 1,
        "movec" => 2,
        _ => 0,
    }
}
