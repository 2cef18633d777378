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

use std::collections::BTreeMap;

use crate::kinematics::configuration::Statement;

use super::axes::{Axes, MOST_OWN, Slot};
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::target::{Mark, Problem, Program, Remark, Shape, Target};
use super::text::Text;
use super::tokens::{Dialect, Kind, Words, words};

const DIALECT: Dialect = Dialect {
    comment: Some(b'!'),
    strings: b"\"",
    bits: false,
};

/// An external axis from here on is none.
const NOT_THERE: f64 = 8.9e9;

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
    if axes.own() > MOST_OWN {
        return Err(vec![Problem::new(
            0,
            format!("a model with {} axes of its own", axes.own()),
            "at most 6; external axes are called eax_a to eax_f in the model",
        )]);
    }
    let tokens = words(text, text.start()..text.bytes.len(), DIALECT).map_err(|p| vec![p])?;
    let mut reader = Reader {
        words: Words { text, tokens },
        axes,
        program: Program::default(),
        problems: Vec::new(),
        by_name: BTreeMap::new(),
        moves: Vec::new(),
        changed: Vec::new(),
        frames: BTreeMap::new(),
    };
    reader.run();
    if reader.problems.is_empty() {
        Ok(reader.finished())
    } else {
        Err(reader.problems)
    }
}

/// What a move goes to.
enum Goal {
    /// A target that stands in the move.
    Inline(usize),
    /// A target by its name.
    Named(String),
}

struct Reader<'t, 'a> {
    words: Words<'t, 'a>,
    axes: &'t Axes,
    program: Program,
    problems: Vec<Problem>,
    /// Targets by their names in small letters.
    by_name: BTreeMap<String, Vec<usize>>,
    moves: Vec<(usize, Goal)>,
    /// Names that something is assigned to at run time, and where.
    changed: Vec<(String, usize)>,
    /// Work objects that moves name, and where first.
    frames: BTreeMap<String, usize>,
}

/// A list in brackets, as it was written.
enum Tree {
    List(Vec<Tree>, usize),
    Number(Number),
    /// Something that is worked out at run time.
    Other,
}

impl Reader<'_, '_> {
    fn run(&mut self) {
        let mut k = 0;
        while k < self.words.tokens.len() {
            k = match self.words.name(k) {
                Some(name) if name == "robtarget" || name == "jointtarget" => {
                    self.declaration(k, name == "robtarget")
                }
                Some(name) if is_move(&name) => self.motion(k, &name),
                Some(name) => self.other_name(k, name),
                None if self.words.is_sign(k, b'[') => self.loose_list(k),
                None => k + 1,
            };
        }
    }

    /// `robtarget name{3} := value;`
    fn declaration(&mut self, k: usize, pose: bool) -> usize {
        let Some(name) = self.words.name(k + 1) else {
            return k + 1;
        };
        let spelled = self.words.spelled(k + 1);
        let mut k = k + 2;
        let mut array = false;
        if self.words.is_sign(k, b'{') {
            array = true;
            k = self.behind(k, b'{', b'}');
        }
        if !(self.words.is_sign(k, b':') && self.words.is_sign(k + 1, b'=')) {
            // Without a value, or a parameter of a procedure.
            return k;
        }
        k += 2;
        if !self.words.is_sign(k, b'[') {
            self.changed.push((name, self.words.at(k)));
            return k;
        }
        let (tree, end) = match self.list(k) {
            Ok(list) => list,
            Err(problem) => {
                self.problems.push(problem);
                return self.next_statement(k);
            }
        };
        self.declared(&tree, &name, &spelled, pose, array);
        if !self.words.is_sign(end, b';') {
            let problem = Problem::new(
                self.words.at(end),
                self.found(end),
                format!("; behind {spelled}"),
            );
            self.problems.push(problem);
        }
        end
    }

    fn declared(&mut self, tree: &Tree, name: &str, spelled: &str, pose: bool, array: bool) {
        if array {
            if let Tree::List(elements, _) = tree {
                for (index, element) in elements.iter().enumerate() {
                    let spelled = format!("{spelled}{{{}}}", index + 1);
                    self.declared(element, name, &spelled, pose, is_array(element, pose));
                }
            }
            return;
        }
        match self.target(tree, spelled, Some(pose)) {
            Ok(Some(target)) => {
                self.program.targets.push(target);
                let index = self.program.targets.len() - 1;
                self.by_name.entry(name.to_owned()).or_default().push(index);
            }
            Ok(None) => self.computed(tree, spelled),
            Err(problem) => self.problems.push(problem),
        }
    }

    fn computed(&mut self, tree: &Tree, spelled: &str) {
        let at = match tree {
            Tree::List(_, at) => *at,
            Tree::Number(number) => number.range.start,
            Tree::Other => return,
        };
        self.program.at_run_time.push(Remark {
            at,
            says: format!("{spelled} has values that are worked out at run time"),
        });
    }

    /// A target of a list; `None` where a part of it is worked out at run time. `pose`: what it has
    /// to be; without, anything that is no target is `Ok(None)`.
    fn target(
        &self,
        tree: &Tree,
        name: &str,
        pose: Option<bool>,
    ) -> Result<Option<Target>, Problem> {
        let Tree::List(parts, at) = tree else {
            return Ok(None);
        };
        let sizes: &[usize] = if pose.unwrap_or(parts.len() == 4) {
            &[3, 4, 4, 6]
        } else {
            &[6, 6]
        };
        let expected = || {
            if sizes.len() == 4 {
                "a robtarget: [[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [eax_a … eax_f]]"
            } else {
                "a jointtarget: [[rax_1 … rax_6], [eax_a … eax_f]]"
            }
        };
        if parts.len() != sizes.len() {
            let found = format!("{} parts in {name}", parts.len());
            return Err(Problem::new(*at, found, expected()));
        }
        let mut numbers: Vec<Vec<Number>> = Vec::new();
        for (part, size) in parts.iter().zip(sizes) {
            let Tree::List(elements, at) = part else {
                return match part {
                    Tree::Number(number) => {
                        let found = format!("a number in {name}");
                        Err(Problem::new(number.range.start, found, expected()))
                    }
                    _ => Ok(None),
                };
            };
            if elements.len() != *size {
                let found = format!("{} numbers in {name}", elements.len());
                return Err(Problem::new(
                    *at,
                    found,
                    format!("{size}, as in {}", expected()),
                ));
            }
            let mut own = Vec::new();
            for element in elements {
                match element {
                    Tree::Number(number) => own.push(number.clone()),
                    Tree::List(_, at) => {
                        let found = format!("a list in {name}");
                        return Err(Problem::new(
                            *at,
                            found,
                            format!("a number, as in {}", expected()),
                        ));
                    }
                    Tree::Other => return Ok(None),
                }
            }
            numbers.push(own);
        }
        if numbers.len() == 4 {
            self.robtarget(&numbers, name, *at).map(Some)
        } else {
            self.jointtarget(&numbers, name, *at).map(Some)
        }
    }

    fn jointtarget(&self, parts: &[Vec<Number>], name: &str, at: usize) -> Result<Target, Problem> {
        let mut numbers = Vec::new();
        for joint in 0..self.axes.joints() {
            let number = match self.axes.slot(joint) {
                Slot::Own(k) => &parts[0][k],
                Slot::External(k) => external_axis(&parts[1][k], name)?,
            };
            numbers.push(number.clone());
        }
        let shape = Shape::Joints {
            numbers,
            inner: self.axes.inner_of_degrees(),
            decimals: 5,
        };
        Ok(Target::new(name, at, shape))
    }

    fn robtarget(&self, parts: &[Vec<Number>], name: &str, at: usize) -> Result<Target, Problem> {
        let [position, turn, configuration, external] = parts else {
            return Err(Problem::new(at, "a part is missing", "a robtarget"));
        };
        let whole = |number: &Number| {
            #[allow(clippy::cast_possible_truncation, reason = "compared with itself")]
            let whole = number.value as i64;
            if whole as f64 == number.value && whole.abs() < 1000 {
                Ok(whole)
            } else {
                let found = format!("{} in the configuration of {name}", number.value);
                Err(Problem::new(number.range.start, found, "a whole number"))
            }
        };
        let frame = Frame {
            position: [0, 1, 2].map(|k: usize| position[k].clone()),
            mm: [1.0; 3],
            turn: turn.clone(),
            orientation: Orientation::Quaternion,
        };
        if frame.goal().is_none() {
            let found = format!("a quaternion of no length in {name}");
            return Err(Problem::new(turn[0].range.start, found, "an orientation"));
        }
        let mut target = Target::new(name, at, Shape::Pose(frame));
        for (number, axis) in configuration.iter().zip([0, 3, 5]) {
            let quadrant = whole(number)?;
            let Some(joint) = self.axes.joint(Slot::Own(axis)) else {
                continue;
            };
            target
                .configuration
                .push(Statement::Quadrant { joint, quadrant });
            target.marks.push(Mark::Quadrant {
                range: number.range.clone(),
                joint,
            });
        }
        let cfx = whole(&configuration[3])?;
        if (0..8).contains(&cfx) && self.axes.own() == 6 {
            if let Some(joint) = self.axes.joint(Slot::Own(4)) {
                let negative = cfx & 1 != 0;
                target
                    .configuration
                    .push(Statement::WristNegative { joint, negative });
            }
            target
                .configuration
                .push(Statement::ElbowTurned(cfx & 2 != 0));
            target.configuration.push(Statement::Behind(cfx & 4 != 0));
        }
        for joint in 0..self.axes.joints() {
            if let Slot::External(k) = self.axes.slot(joint) {
                let value = external_axis(&external[k], name)?.value;
                target
                    .external
                    .push((joint, self.axes.kind(joint).inner(value)));
            }
        }
        Ok(target)
    }

    /// A list that stands in no declaration and no move: an assignment, or a parameter.
    fn loose_list(&mut self, k: usize) -> usize {
        match self.list(k) {
            Ok((tree, end)) => {
                let name = self.assigned_before(k);
                let spelled = name.clone().unwrap_or_else(|| "a target".to_owned());
                // Any other list is no target and no problem.
                if let Ok(Some(target)) = self.target(&tree, &spelled, None) {
                    self.program.targets.push(target);
                    let index = self.program.targets.len() - 1;
                    if let Some(name) = name {
                        self.by_name
                            .entry(name.to_lowercase())
                            .or_default()
                            .push(index);
                    }
                }
                end
            }
            Err(problem) => {
                self.problems.push(problem);
                self.next_statement(k)
            }
        }
    }

    /// The name in front of `:= [`.
    fn assigned_before(&self, k: usize) -> Option<String> {
        let before = k.checked_sub(3)?;
        let assigned = self.words.is_sign(k - 1, b'=') && self.words.is_sign(k - 2, b':');
        let is_name = self.words.kind(before) == Some(Kind::Name);
        (assigned && is_name).then(|| self.words.spelled(before))
    }

    /// `name := …` and `name.trans.x := …` change a target at run time.
    fn other_name(&mut self, k: usize, name: String) -> usize {
        let mut next = k + 1;
        if self.words.is_sign(next, b'{') {
            next = self.behind(next, b'{', b'}');
        }
        let mut component = false;
        while self.words.is_sign(next, b'.') && self.words.kind(next + 1) == Some(Kind::Name) {
            component = true;
            next += 2;
        }
        let assigned = self.words.is_sign(next, b':') && self.words.is_sign(next + 1, b'=');
        let literal = self.words.is_sign(next + 2, b'[') && !component;
        if assigned && !literal {
            self.changed.push((name, self.words.at(k)));
            return next + 2;
        }
        k + 1
    }

    fn motion(&mut self, k: usize, name: &str) -> usize {
        let circle = name.starts_with("movec") || matches!(name, "triggc" | "arcc" | "arccend");
        let mut wanted = if circle { 2 } else { 1 };
        let command = self.words.spelled(k);
        let mut k = k + 1;
        // Up to the end of the move, argument by argument.
        while k < self.words.tokens.len() && !self.words.is_sign(k, b';') {
            let end = self.argument_end(k);
            let next_move = |j: &usize| self.words.name(*j).is_some_and(|n| is_move(&n));
            if let Some(j) = (k..end).find(next_move) {
                let problem = Problem::new(
                    self.words.at(j),
                    self.found(j),
                    format!("; at the end of the {command} before it"),
                );
                self.problems.push(problem);
                return j;
            }
            if self.words.is_sign(k, b'\\') {
                self.switch(k);
            } else if wanted > 0 {
                wanted -= 1;
                self.goal(k, end, &command);
            } else if let Some(at) = (k..end).find(|j| self.words.is_sign(*j, b'\\')) {
                self.switch(at);
            }
            k = end + usize::from(self.words.is_sign(end, b','));
            if end >= self.words.tokens.len() {
                break;
            }
        }
        k
    }

    /// `\WObj:=name`
    fn switch(&mut self, k: usize) {
        let mut k = k;
        while self.words.is_sign(k, b'\\') {
            let is_frame = self.words.name(k + 1).is_some_and(|n| n == "wobj");
            let value = k + 4;
            if is_frame && self.words.name(value).is_some_and(|n| n != "wobj0") {
                let spelled = self.words.spelled(value);
                let at = self.words.at(value);
                self.frames.entry(spelled).or_insert(at);
            }
            k += 2;
            while k < self.words.tokens.len()
                && !self.words.is_sign(k, b'\\')
                && !self.words.is_sign(k, b',')
                && !self.words.is_sign(k, b';')
            {
                k += 1;
            }
        }
    }

    fn goal(&mut self, k: usize, end: usize, command: &str) {
        let at = self.words.at(k);
        if self.words.is_sign(k, b'[') {
            let read = self.list(k).and_then(|(tree, behind)| {
                // Switches of the move may follow its target.
                if behind != end && !self.words.is_sign(behind, b'\\') {
                    let found = self.found(behind);
                    return Err(Problem::new(self.words.at(behind), found, ", or ;"));
                }
                self.target(&tree, &format!("target of {command}"), None)
            });
            match read {
                Ok(Some(target)) => {
                    self.program.targets.push(target);
                    let index = self.program.targets.len() - 1;
                    self.moves.push((at, Goal::Inline(index)));
                }
                Ok(None) => self.run_time(
                    at,
                    format!("the target of {command} is worked out at run time"),
                ),
                Err(problem) => self.problems.push(problem),
            }
            return;
        }
        let alone = k + 1 == end || self.words.is_sign(k + 1, b'\\');
        match self.words.name(k) {
            Some(name) if alone => self.moves.push((at, Goal::Named(name))),
            Some(_) => {
                let what = self
                    .words
                    .text
                    .shown(at..self.words.tokens[end - 1].range.end);
                self.run_time(
                    at,
                    format!("{command} goes to {what}, which is worked out at run time"),
                );
            }
            None => {}
        }
    }

    fn run_time(&mut self, at: usize, says: String) {
        self.program.at_run_time.push(Remark { at, says });
    }

    /// Where an argument ends: at a comma or a semicolon outside brackets.
    fn argument_end(&self, k: usize) -> usize {
        let mut depth = 0_usize;
        let mut k = k;
        while let Some(kind) = self.words.kind(k) {
            match kind {
                Kind::Sign(b'[' | b'(' | b'{') => depth += 1,
                Kind::Sign(b']' | b')' | b'}') => depth = depth.saturating_sub(1),
                Kind::Sign(b',') if depth == 0 => break,
                Kind::Sign(b';') => break,
                _ => {}
            }
            k += 1;
        }
        k
    }

    fn next_statement(&self, k: usize) -> usize {
        let rest = k..self.words.tokens.len();
        rest.into_iter()
            .find(|j| self.words.is_sign(*j, b';'))
            .unwrap_or(self.words.tokens.len())
    }

    /// Behind a pair of brackets.
    fn behind(&self, k: usize, open: u8, close: u8) -> usize {
        let mut depth = 0_usize;
        for j in k..self.words.tokens.len() {
            if self.words.is_sign(j, open) {
                depth += 1;
            } else if self.words.is_sign(j, close) {
                depth -= 1;
                if depth == 0 {
                    return j + 1;
                }
            }
        }
        self.words.tokens.len()
    }

    fn found(&self, k: usize) -> String {
        if k < self.words.tokens.len() {
            format!("'{}'", self.words.spelled(k))
        } else {
            "the end of the file".to_owned()
        }
    }

    /// The list that begins at word `k`, and the word behind it.
    fn list(&self, k: usize) -> Result<(Tree, usize), Problem> {
        self.nested(k, 0)
    }

    fn nested(&self, k: usize, depth: usize) -> Result<(Tree, usize), Problem> {
        let at = self.words.at(k);
        if depth > DEEPEST {
            return Err(Problem::new(at, "brackets in brackets", "at most 16 deep"));
        }
        let unclosed = |k: usize| {
            let found = format!("{} in a list", self.found(k));
            Problem::new(self.words.at(k), found, "] at its end")
        };
        let mut elements = Vec::new();
        let mut k = k + 1;
        if self.words.is_sign(k, b']') {
            return Ok((Tree::List(elements, at), k + 1));
        }
        loop {
            let (element, end) = if self.words.is_sign(k, b'[') {
                self.nested(k, depth + 1)?
            } else {
                self.element(k)?
            };
            elements.push(element);
            match self.words.kind(end) {
                Some(Kind::Sign(b',')) => k = end + 1,
                Some(Kind::Sign(b']')) => return Ok((Tree::List(elements, at), end + 1)),
                None | Some(Kind::Sign(b';')) => return Err(unclosed(end)),
                Some(_) => {
                    let found = self.found(end);
                    return Err(Problem::new(self.words.at(end), found, ", or ]"));
                }
            }
        }
    }

    fn element(&self, k: usize) -> Result<(Tree, usize), Problem> {
        if let Some(read) = self.words.number(k) {
            let (number, end) = read?;
            match self.words.kind(end) {
                // A sum or a product is worked out at run time.
                Some(Kind::Sign(b'+' | b'-' | b'*' | b'/')) => {}
                _ => return Ok((Tree::Number(number), end)),
            }
        }
        let mut end = k;
        let mut depth = 0_usize;
        while let Some(kind) = self.words.kind(end) {
            match kind {
                Kind::Sign(b',' | b']') if depth == 0 => break,
                Kind::Sign(b';') => break,
                Kind::Sign(b'(' | b'{' | b'[') => depth += 1,
                Kind::Sign(b')' | b'}' | b']') => depth = depth.saturating_sub(1),
                _ => {}
            }
            end += 1;
        }
        if end == k {
            let found = self.found(k);
            return Err(Problem::new(self.words.at(k), found, "a number"));
        }
        Ok((Tree::Other, end))
    }

    fn finished(mut self) -> Program {
        for (at, goal) in self.moves {
            match goal {
                Goal::Inline(index) => self.program.visits.push(index),
                Goal::Named(name) => match self.by_name.get(&name).map(Vec::as_slice) {
                    Some([index]) => self.program.visits.push(*index),
                    // An array, or a name that is given several values.
                    Some(_) => {}
                    None => self.program.at_run_time.push(Remark {
                        at,
                        says: format!("{name} is declared elsewhere"),
                    }),
                },
            }
        }
        for (name, at) in self.changed {
            if self.by_name.contains_key(&name) {
                let says = format!("{name} is changed at run time");
                self.program.at_run_time.push(Remark { at, says });
            }
        }
        for (name, at) in self.frames {
            let says =
                format!("moves use the work object {name}; poses are read in the stated frame");
            self.program.notes.push(Remark { at, says });
        }
        self.program
    }
}

/// The value of an external axis that the model has.
fn external_axis<'n>(number: &'n Number, name: &str) -> Result<&'n Number, Problem> {
    if number.value.abs() < NOT_THERE {
        return Ok(number);
    }
    let found = format!("{name} leaves an external axis out");
    let expected = "its value: the model has that axis";
    Err(Problem::new(number.range.start, found, expected))
}

/// Lists in lists that a target or an array of targets needs, and some more.
const DEEPEST: usize = 16;

/// Whether an element of an array of targets is an array again.
fn is_array(tree: &Tree, pose: bool) -> bool {
    let Tree::List(parts, _) = tree else {
        return false;
    };
    let Some(Tree::List(first, _)) = parts.first() else {
        return false;
    };
    let of_target = if pose { 4 } else { 2 };
    parts.len() != of_target && matches!(first.first(), Some(Tree::List(..)))
}

/// Instructions that move to a target that is their first argument.
fn is_move(name: &str) -> bool {
    const MOVES: [&str; 26] = [
        "movej",
        "movel",
        "movec",
        "moveabsj",
        "movejdo",
        "moveldo",
        "movecdo",
        "movejao",
        "movelao",
        "movecao",
        "movejgo",
        "movelgo",
        "movecgo",
        "movejsync",
        "movelsync",
        "movecsync",
        "triggj",
        "triggl",
        "triggc",
        "arcl",
        "arcc",
        "arclstart",
        "arclend",
        "arccend",
        "spotl",
        "spotj",
    ];
    MOVES.contains(&name)
}
