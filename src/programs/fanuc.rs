//! FANUC LS, the listing of a TP program: positions of group 1 in `/POS`, moves in `/MN`.
//!
//! ```text
//! P[1:"name"]{
//!    GP1:
//!     UF : 0, UT : 1,
//!     J1= 0.000 deg, …, J6= 0.000 deg, E1= 0.000 mm
//! };
//! ```
//!
//! or `CONFIG : 'N U T, 0, 0, 0', X = … mm, Y, Z, W = … deg, P, R` with `R_z(R) R_y(P) R_x(W)`. In `CONFIG`
//! N means that joint 5 is negative (F: positive), U and D say on which side of the lower arm the wrist
//! is, T and B on which side of axis 1, both against the robot's zero; the numbers are whole turns of
//! joints 1, 4 and 6.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::kinematics::JointKind;
use crate::kinematics::configuration::Statement;

use super::axes::{Axes, MOST_OWN, Slot};
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::target::{Mark, Problem, Program, Remark, Shape, Target};
use super::text::Text;
use super::tokens::{Dialect, Kind, Words, words};

const DIALECT: Dialect = Dialect {
    comment: None,
    strings: b"\"'",
    bits: false,
};

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|b| *b == b'\n' || *b == b'\r');
    lines.any(|line| {
        let line = line.trim_ascii();
        line.starts_with(b"/PROG") || line.starts_with(b"/POS")
    })
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    if axes.own() > MOST_OWN {
        return Err(vec![Problem::new(
            0,
            format!("a model with {} axes of its own", axes.own()),
            "at most 6; external axes are called E1 to E3 in the model",
        )]);
    }
    let mut program = Program::default();
    let mut problems = Vec::new();
    let (moves, positions) = sections(text);
    let by_number = match positions {
        Some(range) => match words(text, range, DIALECT) {
            Ok(tokens) => {
                let words = Words { text, tokens };
                let mut reader = Positions {
                    words,
                    axes,
                    program: &mut program,
                    problems: &mut problems,
                    by_number: BTreeMap::new(),
                };
                reader.run();
                reader.by_number
            }
            Err(problem) => {
                problems.push(problem);
                BTreeMap::new()
            }
        },
        None => BTreeMap::new(),
    };
    for line in moves {
        motion(text, line, &by_number, &mut program);
    }
    if problems.is_empty() {
        Ok(program)
    } else {
        Err(problems)
    }
}

/// The lines of `/MN`, and the bytes of `/POS`.
fn sections(text: &Text) -> (Vec<Range<usize>>, Option<Range<usize>>) {
    let mut moves = Vec::new();
    let mut positions: Option<Range<usize>> = None;
    let mut section: &[u8] = b"";
    for line in text.lines() {
        let bytes = text.bytes[line.clone()].trim_ascii();
        if bytes.starts_with(b"/") && !bytes.starts_with(b"//") {
            section = if bytes.starts_with(b"/POS") {
                positions = Some(line.end..line.end);
                b"/POS"
            } else {
                bytes
            };
        } else if section.starts_with(b"/MN") {
            moves.push(line);
        } else if section == b"/POS"
            && let Some(positions) = &mut positions
        {
            positions.end = line.end;
        }
    }
    (moves, positions)
}

/// One line of `/MN`: which positions it moves to.
fn motion(
    text: &Text,
    line: Range<usize>,
    by_number: &BTreeMap<u64, usize>,
    program: &mut Program,
) {
    let bytes = &text.bytes[line.clone()];
    // The number of the line, up to its colon.
    let label = bytes
        .iter()
        .position(|b| !(b.is_ascii_digit() || b.is_ascii_whitespace()));
    let Some(label) = label.filter(|k| bytes[*k] == b':') else {
        return;
    };
    let at = line.start + label + 1;
    let rest = bytes[label + 1..].trim_ascii();
    if rest.starts_with(b"!") || rest.starts_with(b"//") || rest.starts_with(b"--") {
        return;
    }
    let shown = String::from_utf8_lossy(rest).into_owned();
    let upper = shown.to_uppercase();
    let has_letter = matches!(rest, [b'J' | b'L' | b'C' | b'A' | b'S', b' ' | b'P', ..]);
    let goes_on = upper.starts_with("P[") && !upper.contains('=');
    if !has_letter && !goes_on {
        if let Some(number) = position_numbers(&upper.replace(' ', "")).first()
            && upper.replace(' ', "").starts_with(&format!("P[{number}]="))
        {
            let says = format!("P[{number}] is changed at run time");
            program.at_run_time.push(Remark { at, says });
        }
        return;
    }
    let motion = upper.split(';').next().unwrap_or_default();
    let words: Vec<&str> = motion.split([' ', ',']).collect();
    let by = words
        .iter()
        .find(|w| matches!(**w, "INC" | "OFFSET" | "TOOL_OFFSET"));
    if motion.contains(" PR[") || motion.starts_with("PR[") {
        let says = "a move to a position register, whose value is set at run time".to_owned();
        program.at_run_time.push(Remark { at, says });
    }
    for number in position_numbers(motion) {
        let Some(index) = by_number.get(&number) else {
            let says = format!("P[{number}] is not in /POS, or not a target");
            program.at_run_time.push(Remark { at, says });
            continue;
        };
        match by {
            Some(&"INC") => {
                let says = format!("P[{number}] is a way from where the robot is (INC)");
                program.targets[*index].left = Some(says);
            }
            Some(offset) => {
                let says = format!("the move to P[{number}] is shifted at run time ({offset})");
                program.at_run_time.push(Remark { at, says });
                program.visits.push(*index);
            }
            None => program.visits.push(*index),
        }
    }
}

/// n of every `P[n]` and `P[n:name]`, other registers left out.
fn position_numbers(line: &str) -> Vec<u64> {
    let bytes = line.as_bytes();
    let mut numbers = Vec::new();
    for (k, _) in line.match_indices("P[") {
        if k > 0 && (bytes[k - 1].is_ascii_alphanumeric() || bytes[k - 1] == b'_') {
            // A motion's letter may touch it: `JP[1]`, but not `VP[1]`.
            if k != 1 || !matches!(bytes[0], b'J' | b'L' | b'C' | b'A' | b'S') {
                continue;
            }
        }
        let digits = &line[k + 2..];
        let end = digits
            .bytes()
            .position(|b| !b.is_ascii_digit())
            .unwrap_or(digits.len());
        if let Ok(number) = digits[..end].parse() {
            numbers.push(number);
        }
    }
    numbers
}

/// A value of a group.
enum Value {
    Number(Number, &'static str),
    /// `********`: never taught.
    Nothing,
}

struct Positions<'t, 'a, 'p> {
    words: Words<'t, 'a>,
    axes: &'t Axes,
    program: &'p mut Program,
    problems: &'p mut Vec<Problem>,
    by_number: BTreeMap<u64, usize>,
}

impl Positions<'_, '_, '_> {
    fn run(&mut self) {
        let mut k = 0;
        while k < self.words.tokens.len() {
            match self.position(k) {
                Ok(end) => k = end,
                Err(problem) => {
                    self.problems.push(problem);
                    // The next position is read all the same.
                    k += 1;
                    while k < self.words.tokens.len()
                        && !(self.words.bytes(k) == b"P" && self.words.is_sign(k + 1, b'['))
                    {
                        k += 1;
                    }
                }
            }
        }
    }

    /// `P[n:"name"]{ … };`
    fn position(&mut self, k: usize) -> Result<usize, Problem> {
        let at = self.words.at(k);
        if self.words.bytes(k) != b"P" {
            return Err(Problem::new(at, self.found(k), "P[…]{ … };"));
        }
        self.expect(k + 1, b'[', "[")?;
        let number: u64 = self.words.spelled(k + 2).parse().map_err(|_| {
            let found = self.found(k + 2);
            Problem::new(self.words.at(k + 2), found, "the number of the position")
        })?;
        let mut k = k + 3;
        let mut name = format!("P[{number}]");
        if self.words.is_sign(k, b':') {
            if self.words.kind(k + 1) == Some(Kind::String) {
                name = format!(
                    "P[{number}:{}]",
                    self.words.spelled(k + 1).trim_matches('"')
                );
            }
            k += 1;
            while self.words.kind(k).is_some() && !self.words.is_sign(k, b']') {
                k += 1;
            }
        }
        self.expect(k, b']', "]")?;
        self.expect(k + 1, b'{', "{")?;
        if self.by_number.contains_key(&number) {
            return Err(Problem::new(
                at,
                format!("{name} a second time"),
                "every position once",
            ));
        }
        let (target, end) = self.groups(k + 2, &name, at)?;
        if let Some(target) = target {
            self.program.targets.push(target);
            self.by_number
                .insert(number, self.program.targets.len() - 1);
        }
        self.expect(end, b'}', "} at the end of the position")?;
        Ok(end + 1 + usize::from(self.words.is_sign(end + 1, b';')))
    }

    fn expect(&self, k: usize, sign: u8, expected: &str) -> Result<(), Problem> {
        if self.words.is_sign(k, sign) {
            return Ok(());
        }
        Err(Problem::new(self.words.at(k), self.found(k), expected))
    }

    /// Every group of a position; the target of group 1.
    fn groups(
        &mut self,
        k: usize,
        name: &str,
        at: usize,
    ) -> Result<(Option<Target>, usize), Problem> {
        let mut target = None;
        let mut k = k;
        let mut first = true;
        while first || self.group_number(k).is_some() {
            let number = self.group_number(k).unwrap_or(1);
            if self.group_number(k).is_some() {
                k += 2;
            }
            let begins = self.words.at(k);
            let (group, end) = self.group(k)?;
            k = end;
            first = false;
            if number == 1 {
                target = self.target(&group, name, at, begins)?;
            } else if !self
                .program
                .notes
                .iter()
                .any(|n| n.says.contains("of group"))
            {
                let says = format!("positions of group {number} are left as they are");
                self.program.notes.push(Remark { at: begins, says });
            }
        }
        Ok((target, k))
    }

    /// `GPn:`
    fn group_number(&self, k: usize) -> Option<u32> {
        let name = self.words.name(k)?;
        let number = name.strip_prefix("gp")?.parse().ok()?;
        self.words.is_sign(k + 1, b':').then_some(number)
    }

    fn group(&self, k: usize) -> Result<(Group, usize), Problem> {
        let mut group = Group::default();
        let mut k = k;
        while let Some(key) = self.words.name(k) {
            if self.group_number(k).is_some() {
                break;
            }
            let at = self.words.at(k);
            k += 1;
            if self.words.is_sign(k, b':') {
                // UF, UT and CONFIG.
                if key == "config" && self.words.kind(k + 1) == Some(Kind::String) {
                    group.configuration = Some(self.words.tokens[k + 1].range.clone());
                }
                k += 2;
                if key != "config" && self.words.is_sign(k - 1, b'-') {
                    k += 1;
                }
            } else {
                self.expect(k, b'=', "= or :")?;
                let (value, end) = self.value(k + 1)?;
                k = end;
                if group.values.insert(key.clone(), value).is_some() {
                    let found = format!("{} a second time", key.to_uppercase());
                    return Err(Problem::new(at, found, "every value once"));
                }
            }
            if self.words.is_sign(k, b',') {
                k += 1;
                continue;
            }
            // Between the lines of a group the comma may be missing.
            let ends = self.words.is_sign(k, b'}') || self.words.kind(k) == Some(Kind::Name);
            if !ends {
                return Err(Problem::new(self.words.at(k), self.found(k), ", or }"));
            }
        }
        Ok((group, k))
    }

    fn value(&self, k: usize) -> Result<(Value, usize), Problem> {
        let (value, end) = if self.words.is_sign(k, b'*') {
            let mut end = k;
            while self.words.is_sign(end, b'*') {
                end += 1;
            }
            (None, end)
        } else {
            let read = self
                .words
                .number(k)
                .unwrap_or_else(|| Err(Problem::new(self.words.at(k), self.found(k), "a number")));
            let (number, end) = read?;
            (Some(number), end)
        };
        let unit = match self.words.name(end).as_deref() {
            Some("deg") => "deg",
            Some("mm") => "mm",
            _ => {
                let found = self.found(end);
                return Err(Problem::new(self.words.at(end), found, "deg or mm"));
            }
        };
        let value = value.map_or(Value::Nothing, |number| Value::Number(number, unit));
        Ok((value, end + 1))
    }

    fn found(&self, k: usize) -> String {
        if k < self.words.tokens.len() {
            format!("'{}'", self.words.spelled(k))
        } else {
            "the end of /POS".to_owned()
        }
    }

    fn target(
        &mut self,
        group: &Group,
        name: &str,
        at: usize,
        begins: usize,
    ) -> Result<Option<Target>, Problem> {
        if group.values.values().any(|v| matches!(v, Value::Nothing)) {
            let says = format!("{name} was never taught");
            self.program.at_run_time.push(Remark { at, says });
            return Ok(None);
        }
        let number = |key: &str, unit: &str| match group.values.get(key) {
            Some(Value::Number(number, found)) if *found == unit => Ok(number.clone()),
            Some(Value::Number(number, found)) => {
                let found = format!("{} in {found} in {name}", key.to_uppercase());
                Err(Problem::new(number.range.start, found, unit.to_owned()))
            }
            _ => {
                let found = format!("{name} without {}", key.to_uppercase());
                Err(Problem::new(begins, found, "J1 to J6 or X, Y, Z, W, P, R"))
            }
        };
        let of_joint = |joint: usize| {
            let unit = match self.axes.kind(joint) {
                JointKind::Revolute => "deg",
                JointKind::Prismatic => "mm",
            };
            let key = match self.axes.slot(joint) {
                Slot::Own(k) => format!("j{}", k + 1),
                Slot::External(k) => format!("e{}", k + 1),
            };
            number(&key, unit)
        };
        let known = ["x", "y", "z", "w", "p", "r"];
        for (key, value) in &group.values {
            let axis = key
                .strip_prefix(['j', 'e'])
                .is_some_and(|n| n.parse::<u8>().is_ok());
            if !axis && !known.contains(&key.as_str()) {
                let at = match value {
                    Value::Number(number, _) => number.range.start,
                    Value::Nothing => begins,
                };
                let found = format!("{} in {name}", key.to_uppercase());
                return Err(Problem::new(
                    at,
                    found,
                    "J1 to J9, E1 to E3 or X, Y, Z, W, P, R",
                ));
            }
        }
        if !group.values.contains_key("x") {
            let numbers: Result<Vec<Number>, Problem> =
                (0..self.axes.joints()).map(of_joint).collect();
            let shape = Shape::Joints {
                numbers: numbers?,
                inner: self.axes.inner_of_degrees(),
                decimals: 5,
            };
            return Ok(Some(Target::new(name, at, shape)));
        }
        let frame = Frame {
            position: [number("x", "mm")?, number("y", "mm")?, number("z", "mm")?],
            mm: [1.0; 3],
            turn: vec![
                number("w", "deg")?,
                number("p", "deg")?,
                number("r", "deg")?,
            ],
            orientation: Orientation::XyzFixedDegrees,
        };
        let mut target = Target::new(name, at, Shape::Pose(frame));
        for joint in 0..self.axes.joints() {
            if let Slot::External(_) = self.axes.slot(joint) {
                let inner = self.axes.kind(joint).inner(of_joint(joint)?.value);
                target.external.push((joint, inner));
            }
        }
        if let Some(range) = &group.configuration {
            self.configuration(range.clone(), &mut target)?;
        }
        Ok(Some(target))
    }

    /// `'N U T, 0, 0, 0'`
    fn configuration(&self, range: Range<usize>, target: &mut Target) -> Result<(), Problem> {
        let problem = || {
            let found = self.words.text.shown(range.clone());
            Problem::new(
                range.start,
                found,
                "a configuration such as 'N U T, 0, 0, 0'",
            )
        };
        let inside = range.start + 1..range.end - 1;
        let bytes = &self.words.text.bytes[inside.clone()];
        let mut parts = bytes.split(|b| *b == b',');
        let letters = parts.next().unwrap_or_default();
        let mut at = inside.start + letters.len() + 1;
        let [wrist, rest @ ..] = &letters
            .split(u8::is_ascii_whitespace)
            .filter(|l| !l.is_empty())
            .collect::<Vec<_>>()[..]
        else {
            return Err(problem());
        };
        let fifth = self.axes.joint(Slot::Own(4));
        match (*wrist, fifth) {
            (b"N" | b"F", Some(joint)) => {
                let negative = *wrist == b"N";
                target
                    .configuration
                    .push(Statement::WristNegative { joint, negative });
            }
            (b"N" | b"F", None) => {}
            _ => return Err(problem()),
        }
        for letter in rest {
            match *letter {
                b"U" | b"D" => target
                    .configuration
                    .push(Statement::ElbowTurned(*letter == b"D")),
                b"T" | b"B" => target
                    .configuration
                    .push(Statement::Behind(*letter == b"B")),
                // Of arms with other shapes.
                b"L" | b"R" => {}
                _ => return Err(problem()),
            }
        }
        for (part, axis) in parts.zip([0, 3, 5]) {
            let digits = part.trim_ascii();
            let turns: i64 = std::str::from_utf8(digits)
                .ok()
                .and_then(|d| d.parse().ok())
                .ok_or_else(problem)?;
            let blanks = part.len() - part.trim_ascii_start().len();
            if let Some(joint) = self.axes.joint(Slot::Own(axis)) {
                target.configuration.push(Statement::Turns { joint, turns });
                target.marks.push(Mark::Turns {
                    range: at + blanks..at + blanks + digits.len(),
                    joint,
                });
            }
            at += part.len() + 1;
        }
        Ok(())
    }
}

#[derive(Default)]
struct Group {
    values: BTreeMap<String, Value>,
    configuration: Option<Range<usize>>,
}
