//! KRL (KUKA): `E6AXIS`, `AXIS`, `E6POS`, `POS` and `FRAME`, in data lists, assignments and motions.
//!
//! ```text
//! {A1 …, A2 …, …, A6 …, E1 …}                       degrees (mm)
//! {X …, Y …, Z …, A …, B …, C …, S …, T …, E1 …}    mm, degrees: R_z(A) R_y(B) R_x(C)
//! ```
//!
//! `T` has one bit for each axis A1 … A6, set where the axis is below zero. Of `S` the lowest bit is
//! read: the wrist is behind axis 1; what its other bits say differs from arm to arm, and `T` tells the
//! same poses apart. `$BASE`, `$TOOL` and `$IPO_MODE` hold from where they are set; motions of inline forms
//! take them from the `FDAT` of their point ([`frames`]).

mod frames;

use crate::kinematics::configuration::Statement;

use super::axes::{Axes, Slot};
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::program::Program;
use super::referred::declare_none;
use super::target::{Mark, Outside, Problem, Shape, Signs, Target};
use super::text::Text;
use super::walk::{Declared, Walk, walked};
use super::words::{Dialect, Kind, List, Value, Words, is_of_name};

use frames::{AGGREGATES, POSE};
use std::collections::BTreeSet;
use std::ops::Range;

const DIALECT: Dialect = Dialect {
    // Lines of the editor begin with &.
    comments: b";&",
    strings: b"\"",
    bits: true,
    cased: false,
    end: phrase!("the end of the line"),
    ends: |_, _, breaks| breaks,
};

const AXES: [&str; 6] = ["a1", "a2", "a3", "a4", "a5", "a6"];
const EXTERNAL: [&str; 6] = ["e1", "e2", "e3", "e4", "e5", "e6"];

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes).to_uppercase();
    let mut lines = text.lines().map(str::trim_start);
    lines.any(|line| {
        line.starts_with("&ACCESS")
            || (line.starts_with("DEF ") && !line.trim_end().ends_with(':'))
            || line.starts_with("DEFDAT ")
            || line.starts_with("GLOBAL DEF")
            || line.contains("E6POS ")
            || line.contains("E6AXIS ")
            || line.starts_with("PTP {")
            || line.starts_with("LIN {")
    })
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    axes.check_own("E1 to E6")?;
    let pieces = [(text.start()..text.bytes.len(), &DIALECT, statement as _)];
    walked(
        text,
        axes,
        &pieces,
        |walk| {
            declare_none(&mut walk.program.tools, "$nullframe");
            walk.has_modules(data_lists(text));
        },
        |spelled| text!("{spelled} has its values elsewhere", spelled),
    )
}

/// The data lists of a text that has several: each is that of the routine of its name and of those that follow it.
fn data_lists(text: &Text) -> BTreeSet<String> {
    let name = |line: Range<usize>| {
        let line = text.bytes[line].trim_ascii_start();
        let (word, rest) = line.split_at_checked(7)?;
        let rest = rest.trim_ascii_start();
        let end = rest.iter().position(|b| !is_of_name(*b));
        let name = String::from_utf8_lossy(&rest[..end.unwrap_or(rest.len())]);
        // What the system's list has is known everywhere.
        let own = word.eq_ignore_ascii_case(b"defdat ") && !name.eq_ignore_ascii_case("$config");
        own.then(|| name.to_lowercase())
    };
    let names: BTreeSet<String> = text.lines().filter_map(name).collect();
    if names.len() > 1 {
        names
    } else {
        BTreeSet::new()
    }
}

fn statement(walk: &mut Walk, words: &Words) -> Result<(), Problem> {
    let mut k = 0;
    while matches!(words.name(k).as_str(), "global" | "public") {
        k += 1;
    }
    let first = words.name(k);
    let deep = |says| Problem::new(words.at(k), text!("blocks in blocks"), says);
    match first.as_str() {
        "def" | "deffct" => {
            // A routine without an end ends here.
            while walk.depth() > 0 {
                walk.end_routine();
            }
            let open = words.until(k, b"(");
            let parameter = |j: &usize| words.is_name(*j) && words.is_sign(j + 1, b':');
            let parameters: Vec<String> = (open..words.len())
                .filter(parameter)
                .map(|j| words.name(j))
                .collect();
            let main = walk.routines() == 0;
            let name = words.name(open.saturating_sub(1));
            walk.enter_module(&name);
            walk.begin_routine(&name, &parameters, main).map_err(deep)?;
        }
        "end" | "endfct" => walk.end_routine(),
        "if" | "switch" | "spline" | "ptp_spline" => {
            walk.begin_block(false).map_err(deep)?;
            for (part, what) in frames::with(walk, words) {
                walk.set(part, what);
            }
        }
        "for" | "while" | "loop" | "repeat" => walk.begin_block(true).map_err(deep)?,
        "case" => walk.alternative(false),
        "else" | "default" => walk.alternative(true),
        "endif" | "endswitch" | "endfor" | "endwhile" | "endloop" | "until" | "endspline" => {
            walk.end_block();
        }
        "defdat" => {
            while walk.depth() > 0 {
                walk.end_routine();
            }
            walk.enter_module(&words.name(k + 1));
        }
        "interrupt" | "trigger" => {
            let does = (k..words.len()).find(|j| words.name(*j) == "do");
            if let Some(j) = does.filter(|j| words.is_sign(j + 2, b'(')) {
                walk.anytime(&words.name(j + 1));
                call(walk, words, j + 1);
            }
        }
        "struc" | "enum" | "signal" | "ext" | "extfct" => {}
        "bas" => frames::bas(walk, words),
        name if is_motion(name) => return motion(walk, words, name),
        name if name == "decl"
            || type_of(name).is_some()
            || is_plain(name) && words.is_name(k + 1) =>
        {
            return declaration(walk, words, k);
        }
        _ if words.is_sign(k + 1, b':') && words.len() == k + 2 => walk.label(),
        name => {
            if let Some(equals) = words.assigns(k) {
                return assignment(walk, words, k, equals, None);
            }
            if words.is_sign(k + 1, b'(') && !is_word(name) {
                call(walk, words, k);
            }
            walk.mention_all(words, k + 1..words.len(), &words.spelled(k));
        }
    }
    Ok(())
}

/// `PICK( )`
fn call(walk: &mut Walk, words: &Words, k: usize) {
    let command = words.spelled(k);
    if !walk.call(&words.name(k), &command) {
        walk.routine_elsewhere(words.at(k), &command);
    }
}

/// `DECL GLOBAL E6POS P1={…}, P2[10]`
fn declaration(walk: &mut Walk, words: &Words, k: usize) -> Result<(), Problem> {
    let mut k = k;
    let mut global = false;
    while matches!(words.name(k).as_str(), "decl" | "global" | "const") {
        global |= words.name(k) == "global";
        k += 1;
    }
    let (kind, spelled) = (words.name(k), words.spelled(k));
    while words.is_name(k + 1) {
        let declared = match type_of(&kind) {
            // A frame is a target only where a motion goes to it.
            Some(_) if kind == "frame" => Declared::Nowhere,
            Some(_) => Declared::Target,
            None => Declared::Other(spelled.clone()),
        };
        walk.declare(&words.name(k + 1), declared, global);
        if let Some(equals) = words.assigns(k + 1) {
            assignment(walk, words, k + 1, equals, type_of(&kind))?;
        }
        k = words.until(k + 1, b",");
    }
    Ok(())
}

/// `XP1 = {…}`, `XP1.X = …`, `P[3]={…}`; `declared`: whether it was just declared as a pose, or as axes.
fn assignment(
    walk: &mut Walk,
    words: &Words,
    k: usize,
    equals: usize,
    declared: Option<bool>,
) -> Result<(), Problem> {
    let list = if words.is_sign(equals + 1, b'{') {
        // Checked in any case, since what is broken there keeps the file from being loaded.
        let (list, end) = words.list(equals + 1, AGGREGATES, 0)?;
        Some((list, end))
    } else {
        None
    };
    let (name, spelled) = (words.name(k), words.shown(k, equals));
    // Another name may be declared behind this one.
    let end = words.until(equals + 1, b",");
    if frames::sets(walk, words, (k, equals, end), list.as_ref()) {
        return Ok(());
    }
    let known = walk.declared(&name);
    let component = (k..equals).any(|j| words.is_sign(j, b'.'));
    let element = words.element(k, *b"[]");
    let own = element.as_deref().unwrap_or(&name);
    match list {
        Some((list, behind)) if !component && behind == end => {
            if matches!(known, Declared::Other(_)) {
                return Ok(());
            }
            let has = |keys: &[&str]| list.parts.iter().any(|part| keys.contains(&&*part.key));
            let foreign = |part: &super::words::Part| {
                ![&AXES[..], &POSE, &EXTERNAL].concat().contains(&&*part.key)
            };
            // Of a name that is declared elsewhere it may be anything.
            if known == Declared::Nowhere && list.parts.iter().any(foreign) {
                return Ok(());
            }
            let pose = declared.unwrap_or(!has(&AXES));
            if known == Declared::Nowhere && has(&["s", "t"]) {
                // Nothing but a target has a status.
                walk.declare(&name, Declared::Target, true);
            }
            if let Some(target) = target(walk, words, &list, &spelled, pose)? {
                walk.value(own, element.is_some().then_some(&name), target);
            }
        }
        _ => {
            walk.changed(own, &words.spelled(k), words.at(k));
            walk.mention_all(words, equals + 1..end, &spelled);
        }
    }
    Ok(())
}

fn motion(walk: &mut Walk, words: &Words, name: &str) -> Result<(), Problem> {
    let command = words.spelled(0);
    let behind = (1..words.len())
        .find(|k| words.name(*k) == "with")
        .unwrap_or(words.len());
    if name.ends_with("_rel") {
        walk.left(
            words.at(1),
            text!("{command} is a relative motion", command = &command),
        );
        for k in (1..behind).filter(|k| words.is_name(*k)) {
            walk.relative(&words.name(k), &command);
        }
        return Ok(());
    }
    let changes = frames::with(walk, words);
    let expected = || text!("the target of {command}", command = &command);
    if words.len() == 1 {
        return Err(words.problem(1, expected()));
    }
    let mut k = 1;
    let goals = if name.contains("circ") { 2 } else { 1 };
    for goal in 0..goals {
        let at = words.at(k);
        if goal > 0 {
            if !words.is_sign(k, b',') {
                let says = text!("a comma and the end point of {command}", command = &command);
                return Err(words.problem(k, says));
            }
            k += 1;
        }
        let from = k;
        let mut inline = None;
        if words.is_sign(k, b'{') {
            let (list, end) = words.list(k, AGGREGATES, 0)?;
            (inline, k) = (Some(list), end);
        } else if words.is_name(k) {
            k += 1;
            if words.is_sign(k, b'[') {
                k = words.until(k + 1, b"]") + 1;
            }
        } else {
            return Err(words.problem(k, expected()));
        }
        let at = if goal > 0 { words.at(from) } else { at };
        if words.is_sign(k, b':') || words.is_sign(k, b'.') || words.is_sign(k, b'(') {
            let end = words.until(k, b",").min(behind);
            walk.go_to_worked_out(words, from..end, &command, &changes);
            k = end;
        } else if let Some(list) = inline {
            let pose = match list.stated.as_deref().and_then(type_of) {
                Some(pose) => pose,
                None => !list
                    .parts
                    .iter()
                    .any(|part| part.key.len() > 1 && part.key.starts_with('a')),
            };
            if let Some(target) = target(walk, words, &list, &format!("target of {command}"), pose)?
            {
                walk.go_to(target, &changes);
            }
        } else {
            let (name, spelled) = (words.name(from), words.spelled(from));
            match words
                .element(from, *b"[]")
                .filter(|element| walk.knows(element))
            {
                Some(element) => walk.go_to_name((&element, &element), at, None, &changes),
                None if k > from + 1 => walk.go_to_part(&name, at, true, &changes),
                None => walk.go_to_name((&name, &spelled), at, None, &changes),
            }
        }
    }
    Ok(())
}

/// The target of an aggregate; `None`, with a remark, where it is not whole.
fn target(
    walk: &mut Walk,
    words: &Words,
    list: &List,
    name: &str,
    pose: bool,
) -> Result<Option<Target>, Problem> {
    let keys: &[&str] = if pose { &POSE } else { &AXES };
    let foreign = list.parts.iter();
    let foreign =
        foreign.filter(|part| !keys.contains(&&*part.key) && !EXTERNAL.contains(&&*part.key));
    // The first by its name, wherever it stands.
    if let Some(part) = foreign.min_by_key(|part| &part.key) {
        let at = match &part.value {
            Value::Number(number) => number.range().start,
            Value::Other(range) => words.at(range.start),
            Value::List(list) => list.at,
        };
        let found = text!(
            "component {component} in {name}",
            component = part.key.to_uppercase(),
            name
        );
        let expected = text!("one of {names}", names = keys.join(", ").to_uppercase());
        return Err(Problem::new(at, found, expected));
    }
    let number = |slot| {
        let key = match slot {
            Slot::Own(k) => format!("a{}", k + 1),
            Slot::External(k) => format!("e{}", k + 1),
        };
        list.number(&key).ok_or(())
    };
    let made = if pose {
        let numbers: Option<Vec<Number>> = POSE[..6].iter().map(|key| list.number(key)).collect();
        let frame = numbers.and_then(|n| Frame::of_degrees(&n, Orientation::ZyxDegrees));
        let external = walk.axes.external(number);
        frame.zip(external.ok()).map(|(frame, external)| {
            let mut target = Target::new(name, list.at, Shape::Pose(Box::new(frame)));
            target.posture_mut().external = external;
            target
        })
    } else {
        walk.axes.joint_target(name, list.at, number).ok()
    };
    let Some(mut target) = made else {
        let says = text!(
            "{name} takes some of its components from where the robot is, or computes them at run time",
            name
        );
        walk.left(list.at, says);
        return Ok(None);
    };
    let outside: Outside = EXTERNAL.map(|key| list.number(key).map(|number| number.value));
    target.outside = walk.outside(outside);
    if pose {
        configuration(walk.axes, words, list, name, &mut target)?;
    }
    Ok(Some(target))
}

fn configuration(
    axes: &Axes,
    words: &Words,
    list: &List,
    name: &str,
    target: &mut Target,
) -> Result<(), Problem> {
    let posture = target.posture_mut();
    if let Some((value, range, binary_digits)) = whole(words, list, "t", name)? {
        let joints = axes.own_numbered();
        for (bit, joint) in joints.iter().enumerate() {
            if let Some(joint) = *joint {
                let negative = value >> bit & 1 != 0;
                posture
                    .configuration
                    .push(Statement::Negative { joint, negative });
            }
        }
        posture.marks.push(Mark::Signs(Box::new(Signs {
            range,
            joints,
            value,
            binary_digits,
        })));
    }
    if let Some((value, ..)) = whole(words, list, "s", name)? {
        posture
            .configuration
            .push(Statement::Behind(value & 1 != 0));
    }
    Ok(())
}

/// S or T: a whole number, decimal or in bits (`'B010'`, `'H1F'`); where it stands, and its digits between quotes
/// (0: decimal).
fn whole(
    words: &Words,
    list: &List,
    key: &str,
    name: &str,
) -> Result<Option<(u32, Range<usize>, usize)>, Problem> {
    match list.get(key) {
        Some(Value::Number(number)) => {
            let value = number.value;
            if !(0.0..=255.0).contains(&value) || value.fract() != 0.0 {
                let component = key.to_uppercase();
                let found = text!("{component} {value} in {name}", component, value, name);
                let expected = text!("a whole number from 0 to 255");
                return Err(Problem::new(number.range().start, found, expected));
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number up to 255"
            )]
            let whole = value as u32;
            Ok(Some((whole, number.range(), 0)))
        }
        Some(Value::Other(range)) if words.kind(range.start) == Some(Kind::Bits) => {
            let spelled = words.spelled(range.start);
            let inside = spelled.trim_matches('\'');
            let (base, digits) = match inside.as_bytes().first() {
                Some(b'B' | b'b') => (2, &inside[1..]),
                Some(b'H' | b'h') => (16, &inside[1..]),
                _ => (10, inside),
            };
            match u32::from_str_radix(digits, base) {
                Ok(value) if value <= 255 => {
                    let binary = if base == 2 { digits.len() } else { 0 };
                    Ok(Some((value, words.range(range.start), binary)))
                }
                _ => {
                    let expected = text!("a binary number such as 'B010'");
                    let found = crate::text::Text::verbatim(spelled);
                    Err(Problem::new(words.at(range.start), found, expected))
                }
            }
        }
        _ => Ok(None),
    }
}

/// Whether values of a type are poses, or axes; `None`: no targets.
fn type_of(name: &str) -> Option<bool> {
    match name {
        "e6axis" | "axis" => Some(false),
        "e6pos" | "pos" | "frame" => Some(true),
        _ => None,
    }
}

/// Types that stand before a name without `DECL`.
fn is_plain(name: &str) -> bool {
    matches!(name, "int" | "real" | "bool" | "char" | "const")
}

/// Statements of the language that look like calls.
fn is_word(name: &str) -> bool {
    matches!(
        name,
        "wait" | "return" | "pulse" | "anin" | "anout" | "cwrite" | "cread" | "swrite"
    )
}

fn is_motion(name: &str) -> bool {
    const MOTIONS: &str = "ptp lin circ sptp slin scirc spl ptp_rel lin_rel circ_rel sptp_rel slin_rel scirc_rel \
        spl_rel";
    MOTIONS.split(' ').any(|known| known == name)
}
