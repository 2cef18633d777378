//! Positions of `/POS`: joint values, or a pose with its user frame, tool and configuration.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::kinematics::configuration::Statement;

use super::super::axes::{Axes, Slot};
use super::super::number::{Number, Span};
use super::super::pose::{Frame, Orientation};
use super::super::target::{Mark, Outside, Problem, Remark, Shape, Target};
use super::super::walk::{Constant, Declared, Walk};
use super::super::words::{Kind, Words};
use crate::text::Text;

/// A value of a group.
enum Value {
    Number(Number, &'static str),
    /// `********`: never taught.
    Nothing,
}

/// One position, `P[n:"name"]{ … };`
pub(super) fn position(walk: &mut Walk, words: &Words) -> Result<(), Problem> {
    let at = words.at(0);
    if words.bytes(0) != b"P" {
        return Err(words.problem(0, Text::verbatim("P[…]{ … };")));
    }
    words.expect(1, b'[')?;
    let number: u64 = (words.spelled(2).parse())
        .map_err(|_| words.problem(2, text!("the number of the position")))?;
    let mut k = 3;
    let key = format!("p[{number}]");
    let mut name = format!("P[{number}]");
    if words.is_sign(k, b':') {
        if words.kind(k + 1) == Some(Kind::String) {
            name = format!("P[{number}:{}]", words.spelled(k + 1).trim_matches('"'));
        }
        k = words.until(k + 1, b"]");
    }
    words.expect(k, b']')?;
    words.expect(k + 1, b'{')?;
    if walk.has_value(&key) {
        let found = text!("{name} a second time", name);
        return Err(Problem::new(at, found, text!("every position once")));
    }
    let reader = Reader {
        words,
        axes: walk.axes,
    };
    let (first, others, end) = reader.groups(k + 2)?;
    words.expect(end, b'}')?;
    if let Some((number, at)) = others
        && !walk
            .program
            .notes
            .iter()
            .any(|n| n.text.to_string().contains("of group"))
    {
        let text = text!("positions of group {number} are left as they are", number);
        walk.program.notes.push(Remark { at, text });
    }
    let Some((group, begins)) = first else {
        return Ok(());
    };
    walk.constant(
        &key,
        Constant::Position([group.frame.clone(), group.tool.clone()]),
    );
    if group.values.values().any(|v| matches!(v, Value::Nothing)) {
        walk.left(at, text!("{name} was never taught", name));
        return Ok(());
    }
    let mut target = reader.target(&group, &name, at, begins)?;
    let outside: Outside =
        std::array::from_fn(|k| match group.values.get(&format!("e{}", k + 1)) {
            Some(Value::Number(number, _)) => Some(number.value),
            _ => None,
        });
    target.outside = walk.outside(outside);
    walk.declare(&key, Declared::Target, true);
    walk.value(&key, None, target);
    Ok(())
}

struct Reader<'r, 't, 'a> {
    words: &'r Words<'t, 'a>,
    axes: &'r Axes,
}

impl Reader<'_, '_, '_> {
    /// Every group of a position: the first with where it begins, the number of another, and the word behind them.
    #[allow(clippy::type_complexity, reason = "what a position consists of")]
    fn groups(
        &self,
        k: usize,
    ) -> Result<(Option<(Group, usize)>, Option<(u32, usize)>, usize), Problem> {
        let (mut first, mut others) = (None, None);
        let mut k = k;
        loop {
            let number = self.group_number(k).unwrap_or(1);
            if self.group_number(k).is_some() {
                k += 2;
            }
            let begins = self.words.at(k);
            let (group, end) = self.group(k)?;
            k = end;
            if number == 1 {
                first = Some((group, begins));
            } else {
                others = Some((number, begins));
            }
            if self.group_number(k).is_none() {
                return Ok((first, others, k));
            }
        }
    }

    /// `GPn:`
    fn group_number(&self, k: usize) -> Option<u32> {
        let name = self.words.name(k);
        let number = name.strip_prefix("gp")?.parse().ok()?;
        self.words.is_sign(k + 1, b':').then_some(number)
    }

    fn group(&self, k: usize) -> Result<(Group, usize), Problem> {
        let mut group = Group::default();
        let mut k = k;
        while self.words.is_name(k) {
            let key = self.words.name(k);
            if self.group_number(k).is_some() {
                break;
            }
            let at = self.words.at(k);
            k += 1;
            if self.words.is_sign(k, b':') {
                match key.as_str() {
                    "config" if self.words.kind(k + 1) == Some(Kind::String) => {
                        group.configuration = Some(self.words.range(k + 1));
                    }
                    "uf" => group.frame = self.words.spelled(k + 1),
                    "ut" => group.tool = self.words.spelled(k + 1),
                    _ => {}
                }
                k += 2;
                if key != "config" && self.words.is_sign(k - 1, b'-') {
                    k += 1;
                }
            } else {
                self.words.expect(k, b'=')?;
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
            let ends = self.words.is_sign(k, b'}') || self.words.is_name(k);
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
        let unit = match self.words.name(end).as_str() {
            "deg" => "deg",
            "mm" => "mm",
            _ => return Err(self.words.problem(end, text!("deg or mm"))),
        };
        let value = value.map_or(Value::Nothing, |number| Value::Number(number, unit));
        Ok((value, end + 1))
    }

    fn target(
        &self,
        group: &Group,
        name: &str,
        at: usize,
        begins: usize,
    ) -> Result<Target, Problem> {
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
                    Text::verbatim(unit),
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
            return self.axes.joint_target(name, at, of_axis);
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
        let frame = Frame::of_degrees(&numbers?, Orientation::XyzFixedDegrees);
        let frame = frame.ok_or_else(|| {
            let expected = text!("J1 to J6 or X, Y, Z, W, P, R");
            Problem::new(begins, Text::verbatim(name), expected)
        })?;
        let mut target = Target::new(name, at, Shape::Pose(Box::new(frame)));
        target.posture_mut().external = self.axes.external(of_axis)?;
        if let Some(range) = &group.configuration {
            self.configuration(range.clone(), &mut target)?;
        }
        Ok(target)
    }

    /// `'N U T, 0, 0, 0'`
    fn configuration(&self, range: Range<usize>, target: &mut Target) -> Result<(), Problem> {
        let problem = || {
            let found = Text::verbatim(self.words.text.shown(range.clone()));
            Problem::new(
                range.start,
                found,
                text!("a configuration such as 'N U T, 0, 0, 0'"),
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
    /// Their numbers.
    frame: String,
    tool: String,
    configuration: Option<Range<usize>>,
}
