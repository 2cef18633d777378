//! Positions of `/POS`: joint values, or a pose with its user frame, tool and configuration.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::kinematics::configuration::Statement;

use super::super::axes::{Axes, Slot};
use super::super::number::{Number, Span};
use super::super::pose::{Frame, Orientation};
use super::super::target::{Mark, Problem, Remark, Shape, Target};
use super::super::tokens::{Kind, Words};
use crate::programs::program::Program;
use crate::programs::referred::{FrameAndTool, Referred};

/// A value of a group.
enum Value {
    Number(Number, &'static str),
    /// `********`: never taught.
    Nothing,
}

pub(super) struct Positions<'t, 'a, 'p> {
    pub(super) words: Words<'t, 'a>,
    pub(super) axes: &'t Axes,
    pub(super) program: &'p mut Program,
    pub(super) problems: &'p mut Vec<Problem>,
    pub(super) by_number: BTreeMap<u64, usize>,
}

impl Positions<'_, '_, '_> {
    pub(super) fn run(&mut self) {
        let mut k = 0;
        while k < self.words.len() {
            match self.position(k) {
                Ok(end) => k = end,
                Err(problem) => {
                    self.problems.push(problem);
                    // The next position is read all the same.
                    k += 1;
                    while k < self.words.len()
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
            return Err(self
                .words
                .problem(k, crate::text::Text::verbatim("P[…]{ … };")));
        }
        self.expect(k + 1, b'[')?;
        let number: u64 = (self.words.spelled(k + 2).parse()).map_err(|_| {
            self.words
                .problem(k + 2, text!("the number of the position"))
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
            k = self.words.until(k + 1, b"]");
        }
        self.expect(k, b']')?;
        self.expect(k + 1, b'{')?;
        if self.by_number.contains_key(&number) {
            return Err(Problem::new(
                at,
                text!("{name} a second time", name),
                text!("every position once"),
            ));
        }
        let (target, end) = self.groups(k + 2, &name, at)?;
        if let Some(target) = target {
            self.program.targets.push(target);
            self.by_number
                .insert(number, self.program.targets.len() - 1);
        }
        self.expect(end, b'}')?;
        Ok(end + 1 + usize::from(self.words.is_sign(end + 1, b';')))
    }

    fn expect(&self, k: usize, sign: u8) -> Result<(), Problem> {
        if self.words.is_sign(k, sign) {
            return Ok(());
        }
        let expected = crate::text::Text::verbatim(char::from(sign));
        Err(self.words.problem(k, expected))
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
                if let Some(target) = &mut target {
                    target.ways.add(self.program.ways.of(FrameAndTool {
                        frame: group.frame,
                        tool: group.tool,
                    }));
                }
            } else if !self
                .program
                .notes
                .iter()
                .any(|n| n.text.to_string().contains("of group"))
            {
                let says = text!("positions of group {number} are left as they are", number);
                self.program.notes.push(Remark {
                    at: begins,
                    text: says,
                });
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
                match key.as_str() {
                    "config" if self.words.kind(k + 1) == Some(Kind::String) => {
                        group.configuration = self.words.range(k + 1);
                    }
                    // The frame of number 0 is the world.
                    "uf" if self.words.bytes(k + 1) != b"0" => {
                        group.frame = Referred::named(format!("UF {}", self.words.spelled(k + 1)));
                    }
                    "ut" => {
                        group.tool = Referred::named(format!("UT {}", self.words.spelled(k + 1)));
                    }
                    _ => {}
                }
                k += 2;
                if key != "config" && self.words.is_sign(k - 1, b'-') {
                    k += 1;
                }
            } else {
                self.expect(k, b'=')?;
                let (value, end) = self.value(k + 1)?;
                k = end;
                if group.values.insert(key.clone(), value).is_some() {
                    let found = text!("{component} a second time", component = key.to_uppercase());
                    return Err(Problem::new(at, found, text!("every value once")));
                }
            }
            if self.words.is_sign(k, b',') {
                k += 1;
                continue;
            }
            // Between the lines of a group the comma may be missing.
            let ends = self.words.is_sign(k, b'}') || self.words.kind(k) == Some(Kind::Name);
            if !ends {
                return Err(self.words.problem(k, text!("a comma or }")));
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
                .unwrap_or_else(|| Err(self.words.problem(k, text!("a number"))));
            let (number, end) = read?;
            (Some(number), end)
        };
        let unit = match self.words.name(end).as_deref() {
            Some("deg") => "deg",
            Some("mm") => "mm",
            _ => return Err(self.words.problem(end, text!("deg or mm"))),
        };
        let value = value.map_or(Value::Nothing, |number| Value::Number(number, unit));
        Ok((value, end + 1))
    }

    fn target(
        &mut self,
        group: &Group,
        name: &str,
        at: usize,
        begins: usize,
    ) -> Result<Option<Target>, Problem> {
        if group.values.values().any(|v| matches!(v, Value::Nothing)) {
            let says = text!("{name} was never taught", name);
            self.program.at_run_time.push(Remark { at, text: says });
            return Ok(None);
        }
        let number = |key: &str, unit: &str| match group.values.get(key) {
            Some(Value::Number(number, found)) if *found == unit => Ok(*number),
            Some(Value::Number(number, found)) => {
                let found = text!(
                    "{component} in {found} in {name}",
                    component = key.to_uppercase(),
                    found,
                    name
                );
                Err(Problem::new(
                    number.range().start,
                    found,
                    crate::text::Text::verbatim(unit),
                ))
            }
            _ => {
                let found = text!(
                    "{name} without {component}",
                    name,
                    component = key.to_uppercase()
                );
                Err(Problem::new(
                    begins,
                    found,
                    text!("J1 to J6 or X, Y, Z, W, P, R"),
                ))
            }
        };
        let of_axis = |slot: Slot| {
            let joint = self.axes.joint(slot).unwrap_or_default();
            let unit = self.axes.kind(joint).unit();
            match slot {
                Slot::Own(k) => number(&format!("j{}", k + 1), unit),
                Slot::External(k) => number(&format!("e{}", k + 1), unit),
            }
        };
        let known = ["x", "y", "z", "w", "p", "r"];
        for (key, value) in &group.values {
            let axis = key
                .strip_prefix(['j', 'e'])
                .is_some_and(|n| n.parse::<u8>().is_ok());
            if !axis && !known.contains(&key.as_str()) {
                let at = match value {
                    Value::Number(number, _) => number.range().start,
                    Value::Nothing => begins,
                };
                let found = text!(
                    "{component} in {name}",
                    component = key.to_uppercase(),
                    name
                );
                return Err(Problem::new(
                    at,
                    found,
                    text!("J1 to J9, E1 to E3 or X, Y, Z, W, P, R"),
                ));
            }
        }
        if !group.values.contains_key("x") {
            return self.axes.joint_target(name, at, of_axis).map(Some);
        }
        let all = [
            ("x", "mm"),
            ("y", "mm"),
            ("z", "mm"),
            ("w", "deg"),
            ("p", "deg"),
            ("r", "deg"),
        ];
        let numbers: Result<Vec<Number>, Problem> = all
            .into_iter()
            .map(|(key, unit)| number(key, unit))
            .collect();
        let Some(frame) = Frame::of_degrees(&numbers?, Orientation::XyzFixedDegrees) else {
            return Ok(None);
        };
        let mut target = Target::new(name, at, Shape::Pose(Box::new(frame)));
        target.posture_mut().external = self.axes.external(of_axis)?;
        if let Some(range) = &group.configuration {
            self.configuration(range.clone(), &mut target)?;
        }
        Ok(Some(target))
    }

    /// `'N U T, 0, 0, 0'`
    fn configuration(&self, range: Range<usize>, target: &mut Target) -> Result<(), Problem> {
        let problem = || {
            let found = crate::text::Text::verbatim(self.words.text().shown(range.clone()));
            Problem::new(
                range.start,
                found,
                text!("a configuration such as 'N U T, 0, 0, 0'"),
            )
        };
        let inside = range.start + 1..range.end - 1;
        let bytes = &self.words.text().bytes[inside.clone()];
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
        let fifth = self.axes.numbered(Slot::Own(4));
        match (*wrist, fifth) {
            (b"N" | b"F", Some(joint)) => {
                let negative = *wrist == b"N";
                target
                    .posture_mut()
                    .configuration
                    .push(Statement::WristNegative { joint, negative });
            }
            (b"N" | b"F", None) => {}
            _ => return Err(problem()),
        }
        for letter in rest {
            match *letter {
                b"U" | b"D" => target
                    .posture_mut()
                    .configuration
                    .push(Statement::ElbowTurned(*letter == b"D")),
                b"T" | b"B" => target
                    .posture_mut()
                    .configuration
                    .push(Statement::Behind(*letter == b"B")),
                // Of arms with other shapes.
                b"L" | b"R" => {}
                _ => return Err(problem()),
            }
        }
        for (part, axis) in parts.zip([0, 3, 5]) {
            let digits = part.trim_ascii();
            let turns: i16 = std::str::from_utf8(digits)
                .ok()
                .and_then(|d| d.parse().ok())
                .ok_or_else(problem)?;
            let blanks = part.len() - part.trim_ascii_start().len();
            let span = Span::of(&(at + blanks..at + blanks + digits.len()));
            if let Some((joint, span)) = self.axes.numbered(Slot::Own(axis)).zip(span) {
                target
                    .posture_mut()
                    .configuration
                    .push(Statement::Turns { joint, turns });
                target.posture_mut().marks.push(Mark::Turns { span, joint });
            }
            at += part.len() + 1;
        }
        Ok(())
    }
}

#[derive(Default)]
struct Group {
    values: BTreeMap<String, Value>,
    frame: Referred,
    tool: Referred,
    configuration: Option<Range<usize>>,
}
