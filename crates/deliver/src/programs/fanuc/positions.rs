//! Positions of `/POS`: joint values, or a pose with its user frame, tool and configuration.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::kinematics::configuration::Statement;

use super::super::axes::{Axes, Slot};
use super::super::number::{Number, Span};
use super::super::pose::{Frame, Orientation};
use super::super::target::{Problem, Remark, Shape, Target};
use super::super::walk::{Constant, Declared, Walk};
use super::super::words::{Kind, Words};
use super::wording::in_english;
use crate::text::Text;

/// A number with its unit; without a number: `********`, never taught.
type Value = (Option<Number>, &'static str);

/// What a position says of one group of axes.
#[derive(Default)]
struct Group {
    at: usize,
    values: BTreeMap<String, Value>,
    /// Their numbers.
    frame: String,
    tool: String,
    configuration: Option<Range<usize>>,
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
        return Err(Problem::new(at, found, text!("each once")));
    }
    k += 2;
    let (mut first, mut others) = (None, None);
    loop {
        let number = group_number(words, k);
        let (group, end) = group(words, k + if number.is_some() { 2 } else { 0 })?;
        match number {
            Some(number) if number != 1 => others = Some((number, group.at)),
            _ => first = Some(group),
        }
        k = end;
        if group_number(words, k).is_none() {
            break;
        }
    }
    words.expect(k, b'}')?;
    // It is said once.
    if let Some((number, at)) = others.filter(|_| walk.program.notes.is_empty()) {
        let text = text!("positions of group {number} are left as they are", number);
        walk.program.notes.push(Remark { at, text });
    }
    let Some(group) = first else {
        return Ok(());
    };
    let numbers = [group.frame.clone(), group.tool.clone()];
    walk.constant(&key, Constant::Position(Box::new(numbers)));
    if group.values.values().any(|(number, _)| number.is_none()) {
        walk.left(at, text!("{name} was never taught", name));
        return Ok(());
    }
    // `RX … RR`: where the tool is seen from the part that the robot holds.
    if group.values.contains_key("rx") {
        let says = text!(
            "the tool stands and the robot moves the part ({sign})",
            sign = "RTCP"
        );
        walk.left(at, says);
        return Ok(());
    }
    let mut target = target(walk.axes, words, &group, &name, at)?;
    target.outside = walk.outside(std::array::from_fn(|k| {
        let (number, _) = group.values.get(&format!("e{}", k + 1))?;
        Some((*number)?.value)
    }));
    walk.declare(&key, Declared::Target, true);
    walk.value(&key, None, target);
    Ok(())
}

/// `GPn:`
fn group_number(words: &Words, k: usize) -> Option<u32> {
    let name = words.name(k);
    let number = name.strip_prefix("gp")?.parse().ok()?;
    words.is_sign(k + 1, b':').then_some(number)
}

/// The group that begins at word `k`, and the word behind it.
fn group(words: &Words, mut k: usize) -> Result<(Group, usize), Problem> {
    let mut group = Group {
        at: words.at(k),
        ..Group::default()
    };
    while words.is_name(k) && group_number(words, k).is_none() {
        let (key, at) = (in_english(words.name(k)), words.at(k));
        k += 1;
        if words.is_sign(k, b':') {
            match key.as_str() {
                "config" if words.kind(k + 1) == Some(Kind::String) => {
                    group.configuration = Some(words.range(k + 1));
                }
                "uf" => group.frame = words.spelled(k + 1),
                "ut" => group.tool = words.spelled(k + 1),
                _ => {}
            }
            k += 2;
            if key != "config" && words.is_sign(k - 1, b'-') {
                k += 1;
            }
        } else {
            words.expect(k, b'=')?;
            let (value, end) = value(words, k + 1)?;
            k = end;
            if group.values.insert(key.clone(), value).is_some() {
                let found = text!("{name} a second time", name = key.to_uppercase());
                return Err(Problem::new(at, found, text!("each once")));
            }
        }
        // Between the lines of a group the comma may be missing.
        if words.is_sign(k, b',') {
            k += 1;
        } else if !(words.is_sign(k, b'}') || words.is_name(k)) {
            return Err(words.problem(k, Text::verbatim("',' '}'")));
        }
    }
    Ok((group, k))
}

fn value(words: &Words, k: usize) -> Result<(Value, usize), Problem> {
    let stars = (k..words.len()).take_while(|k| words.is_sign(*k, b'*'));
    let (number, end) = match (stars.count(), words.number(k)) {
        (0, None) => return Err(words.problem(k, text!("a number"))),
        (0, Some(read)) => {
            let (number, end) = read?;
            (Some(number), end)
        }
        (stars, _) => (None, k + stars),
    };
    let unit = match words.name(end).as_str() {
        "deg" => "deg",
        "mm" => "mm",
        _ => return Err(words.problem(end, text!("deg or mm"))),
    };
    Ok(((number, unit), end + 1))
}

fn target(
    axes: &Axes,
    words: &Words,
    group: &Group,
    name: &str,
    at: usize,
) -> Result<Target, Problem> {
    let number = |key: &str, unit: &str| {
        let component = key.to_uppercase();
        match group.values.get(key) {
            Some((Some(number), found)) if *found == unit => Ok(*number),
            Some((Some(number), found)) => {
                let found = text!("{component} in {found} in {name}", component, found, name);
                let at = number.range().start;
                Err(Problem::new(at, found, Text::verbatim(unit)))
            }
            _ => {
                let found = text!("{name} without {component}", name, component);
                let expected = text!("J1 to J6 or X, Y, Z, W, P, R");
                Err(Problem::new(group.at, found, expected))
            }
        }
    };
    let of_axis = |slot: Slot| {
        let unit = axes.kind(axes.joint(slot).unwrap_or_default()).unit();
        match slot {
            Slot::Own(k) => number(&format!("j{}", k + 1), unit),
            Slot::External(k) => number(&format!("e{}", k + 1), unit),
        }
    };
    for (key, (number, _)) in &group.values {
        let axis = key.strip_prefix(['j', 'e']);
        let axis = axis.is_some_and(|n| n.parse::<u8>().is_ok());
        if !axis && !["x", "y", "z", "w", "p", "r"].contains(&&**key) {
            let at = number.map_or(group.at, |number| number.range().start);
            let component = key.to_uppercase();
            let found = text!("{component} in {name}", component, name);
            let expected = text!("J1 to J9, E1 to E3 or X, Y, Z, W, P, R");
            return Err(Problem::new(at, found, expected));
        }
    }
    if !group.values.contains_key("x") {
        return axes.joint_target(name, at, of_axis);
    }
    let (mm, deg) = (|key| number(key, "mm"), |key| number(key, "deg"));
    let numbers = [
        mm("x")?,
        mm("y")?,
        mm("z")?,
        deg("w")?,
        deg("p")?,
        deg("r")?,
    ];
    let frame = Frame::of_degrees(numbers, Orientation::XyzFixedDegrees);
    let mut target = Target::new(name, at, Shape::Pose(Box::new(frame)));
    target.posture_mut().external = axes.external(of_axis)?;
    if let Some(range) = &group.configuration {
        configure(axes, words, range.clone(), &mut target).ok_or_else(|| {
            let found = Text::verbatim(words.text.shown(range.clone()));
            let expected = text!("a configuration such as 'N U T, 0, 0, 0'");
            Problem::new(range.start, found, expected)
        })?;
    }
    Ok(target)
}

/// `'N U T, 0, 0, 0'`; `None`: it is none.
fn configure(axes: &Axes, words: &Words, range: Range<usize>, target: &mut Target) -> Option<()> {
    let posture = target.posture_mut();
    let inside = range.start + 1..range.end - 1;
    let mut parts = words.text.bytes[inside.clone()].split(|b| *b == b',');
    let letters = parts.next()?;
    let mut at = inside.start + letters.len() + 1;
    let mut letters = letters
        .split(u8::is_ascii_whitespace)
        .filter(|l| !l.is_empty());
    let negative = match letters.next()? {
        b"N" => true,
        b"F" => false,
        _ => return None,
    };
    let wrist = axes.numbered(Slot::Own(4));
    let states = &mut posture.configuration;
    states.extend(wrist.map(|joint| Statement::WristNegative { joint, negative }));
    for letter in letters {
        match letter {
            b"U" | b"D" => states.push(Statement::ElbowTurned(letter == b"D")),
            b"T" | b"B" => states.push(Statement::Behind(letter == b"B")),
            // Of arms with other shapes.
            b"L" | b"R" => {}
            _ => return None,
        }
    }
    for (part, axis) in parts.zip([0, 3, 5]) {
        let digits = part.trim_ascii();
        let turns: i16 = std::str::from_utf8(digits).ok()?.parse().ok()?;
        let begins = at + part.len() - part.trim_ascii_start().len();
        let span = Span::of(&(begins..begins + digits.len()));
        if let Some((joint, span)) = axes.numbered(Slot::Own(axis)).zip(span) {
            posture.marked(Statement::Turns { joint, turns }, span);
        }
        at += part.len() + 1;
    }
    Some(())
}
