//! `URScript` (Universal Robots): lists of joint values and poses `p[…]` in moves, or given to a name
//! that moves go to.
//!
//! ```text
//! movej([q1, …, q6])      rad
//! movel(p[x, y, z, rx, ry, rz])   m, rotation vector in rad
//! ```
//!
//! A pose has no configuration; `get_inverse_kin(p[…], [near])` says one.

use std::collections::BTreeMap;

use crate::kinematics::JointKind;

use super::axes::Axes;
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::target::{Problem, Program, Remark, Shape, Target};
use super::text::Text;
use super::tokens::{Dialect, Kind, Words, words};

const DIALECT: Dialect = Dialect {
    comment: Some(b'#'),
    strings: b"\"",
    bits: false,
};

/// mm in a metre.
const METRE: f64 = 1000.0;

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let moves = ["movej(", "movel(", "movep(", "movec(", "servoj("];
    moves.iter().any(|m| text.contains(m))
        || text.lines().any(|l| l.trim_start().starts_with("def "))
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    if (0..axes.joints()).any(|j| axes.kind(j) == JointKind::Prismatic) {
        let found = "a model with a sliding joint";
        return Err(vec![Problem::new(
            0,
            found,
            "turning joints, which URScript gives in rad",
        )]);
    }
    let tokens = words(text, text.start()..text.bytes.len(), DIALECT).map_err(|p| vec![p])?;
    let mut reader = Reader {
        words: Words { text, tokens },
        axes,
        program: Program::default(),
        problems: Vec::new(),
        assigned: BTreeMap::new(),
        moves: Vec::new(),
        uses: BTreeMap::new(),
    };
    reader.collect();
    reader.run();
    if reader.problems.is_empty() {
        Ok(reader.finished())
    } else {
        Err(reader.problems)
    }
}

/// What a literal is.
#[derive(Clone)]
enum Literal {
    Pose(Vec<Number>),
    List(Vec<Number>),
    /// A list of which an element is worked out at run time.
    RunTime,
}

enum Goal {
    Inline(usize),
    Named(String),
}

struct Reader<'t, 'a> {
    words: Words<'t, 'a>,
    axes: &'t Axes,
    program: Program,
    problems: Vec<Problem>,
    /// Names with the literals that are given to them: the word where each begins.
    assigned: BTreeMap<String, Vec<(usize, Literal)>>,
    moves: Vec<(usize, Goal, Option<Vec<f64>>)>,
    /// Where names are used elsewhere than as a target.
    uses: BTreeMap<String, usize>,
}

impl Reader<'_, '_> {
    /// Finds what names are given: `global p1 = p[…]`.
    fn collect(&mut self) {
        for k in 0..self.words.tokens.len() {
            let is_name = self.words.kind(k) == Some(Kind::Name);
            let given = self.words.is_sign(k + 1, b'=') && !self.words.is_sign(k + 2, b'=');
            let inside =
                k > 0 && (self.words.is_sign(k - 1, b'(') || self.words.is_sign(k - 1, b','));
            if !is_name || !given || inside {
                continue;
            }
            match self.literal(k + 2) {
                Ok(Some((literal, _))) => {
                    let name = self.words.spelled(k);
                    self.assigned.entry(name).or_default().push((k, literal));
                }
                Ok(None) => {}
                Err(problem) => self.problems.push(problem),
            }
        }
    }

    fn run(&mut self) {
        let mut k = 0;
        while k < self.words.tokens.len() {
            let name = self.words.spelled(k);
            let called = self.words.is_sign(k + 1, b'(');
            if self.words.kind(k) == Some(Kind::Name) && called && targets_of(&name) > 0 {
                k = self.motion(k, &name, targets_of(&name));
                continue;
            }
            if self.words.kind(k) == Some(Kind::Name) && !self.words.is_sign(k + 1, b'=') {
                let at = self.words.at(k);
                self.uses.entry(name).or_insert(at);
            }
            k += 1;
        }
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
                let expected = format!(", and the next point of {command}");
                let problem = Problem::new(self.words.at(k), self.found(k), expected);
                self.problems.push(problem);
                return k;
            }
            if !comma && !self.words.is_sign(k, b')') {
                let problem = Problem::new(self.words.at(k), self.found(k), ", or )");
                self.problems.push(problem);
                return k + 1;
            }
            k += usize::from(comma && wanted > 0);
        }
        k
    }

    /// One target of a move; the word behind it.
    fn goal(&mut self, k: usize, command: &str) -> Result<usize, Problem> {
        let at = self.words.at(k);
        if let Some((literal, end)) = self.literal(k)? {
            match self.target(&literal, at, &format!("target of {command}"), None)? {
                Some(index) => self.moves.push((at, Goal::Inline(index), None)),
                None => self.run_time(
                    at,
                    format!("the target of {command} is worked out at run time"),
                ),
            }
            return Ok(end);
        }
        let end = self.argument_end(k);
        if end == k {
            return Err(Problem::new(
                at,
                self.found(k),
                format!("the target of {command}"),
            ));
        }
        if end >= self.words.tokens.len() {
            let found = self.found(end);
            return Err(Problem::new(
                self.words.at(end),
                found,
                ") at the end of the move",
            ));
        }
        if self.words.spelled(k) == "get_inverse_kin" && self.words.is_sign(k + 1, b'(') {
            return self.inverse(k + 2, end, command);
        }
        let is_name = self.words.kind(k) == Some(Kind::Name);
        if is_name && end == k + 1 {
            let name = self.words.spelled(k);
            self.moves.push((at, Goal::Named(name), None));
        } else {
            for j in k..end {
                if self.words.kind(j) == Some(Kind::Name) {
                    let at = self.words.at(j);
                    self.uses.entry(self.words.spelled(j)).or_insert(at);
                }
            }
            let what = self
                .words
                .text
                .shown(at..self.words.tokens[end - 1].range.end);
            self.run_time(
                at,
                format!("{command} goes to {what}, which is worked out at run time"),
            );
        }
        Ok(end)
    }

    /// `get_inverse_kin(pose, near)`: the pose is the target, and what is near says which solution.
    fn inverse(&mut self, k: usize, end: usize, command: &str) -> Result<usize, Problem> {
        let at = self.words.at(k);
        let first_end = match self.literal(k)? {
            Some((_, behind)) => behind,
            None => self.argument_end(k),
        };
        let near = if self.words.is_sign(first_end, b',') {
            self.near(first_end + 1)?
        } else {
            None
        };
        if let Some((literal, _)) = self.literal(k)? {
            match self.target(&literal, at, &format!("target of {command}"), near.clone())? {
                Some(index) => self.moves.push((at, Goal::Inline(index), None)),
                None => self.run_time(
                    at,
                    format!("the target of {command} is worked out at run time"),
                ),
            }
        } else if self.words.kind(k) == Some(Kind::Name) && first_end == k + 1 {
            let name = self.words.spelled(k);
            self.moves.push((at, Goal::Named(name), near));
        } else {
            self.run_time(
                at,
                format!("the target of {command} is worked out at run time"),
            );
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
        if let Some((Literal::List(numbers), _)) = self.literal(k)? {
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
        near: Option<Vec<f64>>,
    ) -> Result<Option<usize>, Problem> {
        let shape = match literal {
            Literal::RunTime => return Ok(None),
            Literal::Pose(numbers) => {
                let [x, y, z, rx, ry, rz] = &numbers[..] else {
                    let found = format!("a pose of {} numbers", numbers.len());
                    return Err(Problem::new(at, found, "p[x, y, z, rx, ry, rz]"));
                };
                Shape::Pose(Frame {
                    position: [x.clone(), y.clone(), z.clone()],
                    mm: [METRE; 3],
                    turn: vec![rx.clone(), ry.clone(), rz.clone()],
                    orientation: Orientation::RotationVector,
                })
            }
            Literal::List(numbers) => {
                let joints = self.axes.joints();
                if numbers.len() != joints {
                    let found = format!("a list of {} numbers", numbers.len());
                    let expected = format!("{joints}, one for each joint of the model");
                    return Err(Problem::new(at, found, expected));
                }
                Shape::Joints {
                    numbers: numbers.clone(),
                    inner: vec![1.0; joints],
                    decimals: 7,
                }
            }
        };
        let mut target = Target::new(name, at, shape);
        target.near = near;
        self.program.targets.push(target);
        Ok(Some(self.program.targets.len() - 1))
    }

    /// The literal that begins at word `k`, and the word behind it.
    fn literal(&self, k: usize) -> Result<Option<(Literal, usize)>, Problem> {
        let is_pose = self.words.bytes(k) == b"p" && self.words.is_sign(k + 1, b'[');
        let open = k + usize::from(is_pose);
        if !self.words.is_sign(open, b'[') {
            return Ok(None);
        }
        let mut numbers = Vec::new();
        let mut run_time = false;
        let mut k = open + 1;
        loop {
            let (number, end) = self.element(k)?;
            match number {
                Some(number) => numbers.push(number),
                None => run_time = true,
            }
            match self.words.kind(end) {
                Some(Kind::Sign(b',')) => k = end + 1,
                Some(Kind::Sign(b']')) => {
                    let literal = match (run_time, is_pose) {
                        (true, _) => Literal::RunTime,
                        (false, true) => Literal::Pose(numbers),
                        (false, false) => Literal::List(numbers),
                    };
                    return Ok(Some((literal, end + 1)));
                }
                _ => {
                    let found = self.found(end);
                    return Err(Problem::new(self.words.at(end), found, ", or ]"));
                }
            }
        }
    }

    fn element(&self, k: usize) -> Result<(Option<Number>, usize), Problem> {
        if let Some(read) = self.words.number(k) {
            let (number, end) = read?;
            match self.words.kind(end) {
                Some(Kind::Sign(b'+' | b'-' | b'*' | b'/')) => {}
                _ => return Ok((Some(number), end)),
            }
        }
        let end = self.argument_end(k);
        // An empty list is a list of nothing.
        if end == k && !(self.words.is_sign(k, b']') && self.words.is_sign(k.wrapping_sub(1), b'['))
        {
            return Err(Problem::new(self.words.at(k), self.found(k), "a number"));
        }
        Ok((None, end))
    }

    /// Where an argument or an element ends: at a comma or a bracket that was not opened in it.
    fn argument_end(&self, k: usize) -> usize {
        let mut depth = 0_usize;
        let mut k = k;
        while let Some(kind) = self.words.kind(k) {
            match kind {
                Kind::Sign(b',' | b')' | b']') if depth == 0 => break,
                Kind::Sign(b'[' | b'(') => depth += 1,
                Kind::Sign(b']' | b')') => depth -= 1,
                _ => {}
            }
            k += 1;
        }
        k
    }

    fn run_time(&mut self, at: usize, says: String) {
        self.program.at_run_time.push(Remark { at, says });
    }

    fn found(&self, k: usize) -> String {
        if k < self.words.tokens.len() {
            format!("'{}'", self.words.spelled(k))
        } else {
            "the end of the file".to_owned()
        }
    }

    fn finished(mut self) -> Program {
        let mut by_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        let moves = std::mem::take(&mut self.moves);
        for (at, goal, near) in moves {
            let name = match goal {
                Goal::Inline(index) => {
                    self.program.visits.push(index);
                    continue;
                }
                Goal::Named(name) => name,
            };
            if !by_name.contains_key(&name) {
                let targets = self.named(&name, near.as_deref());
                by_name.insert(name.clone(), targets);
            }
            match by_name.get(&name).map(Vec::as_slice) {
                Some([index]) => self.program.visits.push(*index),
                Some([]) | None => {
                    let says =
                        format!("{name} is worked out at run time, or has its values elsewhere");
                    self.run_time(at, says);
                }
                Some(_) => {}
            }
        }
        for (name, at) in std::mem::take(&mut self.uses) {
            if by_name
                .get(&name)
                .is_some_and(|targets| !targets.is_empty())
            {
                let says = format!("{name} is used here as well, with its corrected values");
                self.program.notes.push(Remark { at, says });
            }
        }
        let unused: Vec<Remark> = self
            .assigned
            .iter()
            .filter(|(name, _)| !by_name.contains_key(*name))
            .flat_map(|(name, given)| given.iter().map(move |one| (name, one)))
            .filter(|(_, (_, literal))| matches!(literal, Literal::Pose(_)))
            .map(|(name, (k, _))| Remark {
                at: self.words.at(*k),
                says: format!("{name} is a pose that no move of this file goes to"),
            })
            .collect();
        self.program.at_run_time.extend(unused);
        self.in_order()
    }

    /// The targets of a name.
    fn named(&mut self, name: &str, near: Option<&[f64]>) -> Vec<usize> {
        let mut targets = Vec::new();
        for (k, literal) in self.assigned.get(name).cloned().unwrap_or_default() {
            let at = self.words.at(k);
            match self.target(&literal, at, name, near.map(<[f64]>::to_vec)) {
                Ok(Some(index)) => targets.push(index),
                Ok(None) => {}
                Err(problem) => {
                    // A list that is no target of a move after all.
                    let says = format!("{name} is not corrected: {}", problem.found);
                    self.run_time(at, says);
                }
            }
        }
        targets
    }

    /// Targets by their places in the file.
    fn in_order(self) -> Program {
        let mut program = self.program;
        let mut order: Vec<usize> = (0..program.targets.len()).collect();
        order.sort_by_key(|k| program.targets[*k].at);
        let mut place = vec![0; order.len()];
        for (now, before) in order.iter().enumerate() {
            place[*before] = now;
        }
        program.targets = order.iter().map(|k| program.targets[*k].clone()).collect();
        for visit in &mut program.visits {
            *visit = place[*visit];
        }
        program
    }
}

/// How many targets a move has.
fn targets_of(name: &str) -> usize {
    match name {
        "movej" | "movel" | "movep" | "servoj" | "servol" => 1,
        "movec" => 2,
        _ => 0,
    }
}
