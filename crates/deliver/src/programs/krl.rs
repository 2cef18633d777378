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

use super::program::not_in_numbers;
use std::collections::BTreeSet;
use std::ops::Range;

use crate::kinematics::configuration::Statement;

use super::axes::{Axes, Slot};
use super::number::Span;
use super::program::Program;
use super::target::{Mark, Problem, Shape, Target};
use super::text::Text;
use super::walk::{Declared, Walk, walked};
use super::words::{Dialect, Kind, List, Value, Words, is_of_name, is_one_of};

use frames::{POSE, frame};

static DIALECT: Dialect = Dialect {
    // Lines of the editor begin with &.
    comments: b";&",
    // Single quotes hold binary and hexadecimal numbers.
    strings: b"\"'",
    cased: false,
    end: phrase!("the end of the line"),
    ends: |_, _, breaks| breaks,
    lists: *b"{}",
    keyed: true,
    part: phrase!("a value"),
    elements: *b"[]",
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
            walk.program.declare_no_tool("$nullframe");
            walk.has_modules(data_lists(text));
        },
        |spelled| not_in_numbers(spelled),
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
    Some(names)
        .filter(|names| names.len() > 1)
        .unwrap_or_default()
}

fn statement(walk: &mut Walk, words: &Words) -> Result<(), Problem> {
    let before = |k: &usize| is_one_of(&words.name(*k), "global public");
    let k = (0..words.len()).take_while(before).count();
    match words.name(k).as_str() {
        "def" | "deffct" => {
            // A routine without an end ends here.
            walk.end_routines();
            let name = words.until(k, b"(").saturating_sub(1);
            let main = walk.routines == 0;
            walk.enter_module(&words.name(name));
            walk.begin_routine(words, name, b":", main)?;
        }
        "end" | "endfct" => walk.end_routine(),
        "if" | "switch" | "spline" | "ptp_spline" => {
            walk.begin_block(false)?;
            for (part, what) in frames::with(walk, words) {
                walk.set(part, what);
            }
        }
        "for" | "while" | "loop" | "repeat" => walk.begin_block(true)?,
        "case" => walk.alternative(false),
        "else" | "default" => walk.alternative(true),
        "endif" | "endswitch" | "endfor" | "endwhile" | "endloop" | "until" | "endspline" => {
            walk.end_block();
        }
        "defdat" => {
            walk.end_routines();
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
            || is_one_of(name, "int real bool char const") && words.is_name(k + 1) =>
        {
            return declaration(walk, words, k);
        }
        _ if words.is_sign(k + 1, b':') && words.len() == k + 2 => walk.label(),
        name => {
            if let Some(equals) = words.assigns(k) {
                return assignment(walk, words, k, equals, None);
            }
            if words.is_sign(k + 1, b'(') && !is_one_of(name, COMMANDS) {
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
    walk.hand_over(&words.name(k), words, k + 2);
}

/// `DECL GLOBAL E6POS P1={…}, P2[10]`
fn declaration(walk: &mut Walk, words: &Words, from: usize) -> Result<(), Problem> {
    let before = |j: &usize| is_one_of(&words.name(*j), "decl global const");
    let mut k = from + (from..words.len()).take_while(before).count();
    let global = (from..k).any(|j| words.name(j) == "global");
    let (kind, of) = (words.name(k), words.span(k));
    let pose = type_of(&kind);
    while words.is_name(k + 1) {
        let declared = match pose {
            // A frame is a target only where a motion goes to it.
            Some(_) if kind == "frame" => Declared::Nowhere,
            Some(_) => Declared::Target,
            None => Declared::Other(of),
        };
        walk.declare(&words.name(k + 1), declared, global);
        if let Some(equals) = words.assigns(k + 1) {
            assignment(walk, words, k + 1, equals, pose)?;
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
    let mut list = None;
    if words.is_sign(equals + 1, b'{') {
        // Checked in any case, since what is broken there keeps the file from being loaded.
        list = Some(words.list(equals + 1)?);
    }
    // Another name may be declared behind this one.
    let end = words.until(equals + 1, b",");
    if frames::sets(walk, words, (k, equals, end), list.as_ref()) {
        return Ok(());
    }
    let (name, spelled) = (words.name(k), words.shown(k, equals));
    let component = (k..equals).any(|j| words.is_sign(j, b'.'));
    let element = words.element(k);
    let own = element.as_deref().unwrap_or(&name);
    let Some((list, _)) = list.filter(|(_, behind)| !component && *behind == end) else {
        walk.changed(own, words, k);
        walk.mention_all(words, equals + 1..end, &spelled);
        return Ok(());
    };
    let known = walk.declared(&name);
    let foreign = !list.has_only(&[&AXES, &POSE, &EXTERNAL]);
    // Of a name that is declared elsewhere it may be anything.
    if matches!(known, Declared::Other(_)) || known == Declared::Nowhere && foreign {
        return Ok(());
    }
    let has = |keys: &[&str]| keys.iter().any(|key| list.get(key).is_some());
    if known == Declared::Nowhere && has(&["s", "t"]) {
        // Nothing but a target has a status.
        walk.declare(&name, Declared::Target, true);
    }
    let pose = declared.unwrap_or(!has(&AXES));
    if let Some(target) = target(walk, words, &list, &spelled, pose)? {
        walk.value(own, element.is_some().then_some(&name), target);
    }
    Ok(())
}

fn motion(walk: &mut Walk, words: &Words, name: &str) -> Result<(), Problem> {
    let command = words.spelled(0);
    let with = (1..words.len()).find(|k| words.name(*k) == "with");
    let behind = with.unwrap_or(words.len());
    if name.ends_with("_rel") {
        let says = text!("{command} is a relative motion", command = &command);
        walk.left(words.at(1), says);
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
    let goals = if name.contains("circ") { 2 } else { 1 };
    let mut k = 1;
    for goal in 0..goals {
        if goal > 0 {
            if !words.is_sign(k, b',') {
                let says = text!(
                    "a comma and the next point of {command}",
                    command = &command
                );
                return Err(words.problem(k, says));
            }
            k += 1;
        }
        let from = k;
        let mut inline = None;
        if words.is_sign(k, b'{') {
            let (list, end) = words.list(k)?;
            (inline, k) = (Some(list), end);
        } else if words.is_name(k) {
            k = words.behind_element(k).unwrap_or(k + 1);
        } else {
            return Err(words.problem(k, expected()));
        }
        if matches!(words.kind(k), Some(Kind::Sign(b':' | b'.' | b'('))) {
            k = words.until(k, b",").min(behind);
            walk.go_to_worked_out(words, from..k, &command, &changes);
        } else if let Some(list) = inline {
            let stated = list.stated.as_deref().and_then(type_of);
            let axis = |key: &str| key.len() > 1 && key.starts_with('a');
            let pose = stated.unwrap_or_else(|| !list.parts.iter().any(|part| axis(&part.key)));
            let name = format!("target of {command}");
            if let Some(target) = target(walk, words, &list, &name, pose)? {
                walk.go_to(target, &changes);
            }
        } else {
            walk.go_to_words(words, from..k, &command, None, &changes);
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
    let known = |key: &str| keys.contains(&key) || EXTERNAL.contains(&key);
    let foreign = list.parts.iter().filter(|part| !known(&part.key));
    // The first by its name, wherever it stands.
    if let Some(part) = foreign.min_by_key(|part| &part.key) {
        let component = part.key.to_uppercase();
        let found = text!("{component} in {name}", component, name);
        let expected = text!("one of {names}", names = keys.join(", ").to_uppercase());
        return Err(Problem::new(part.value.at(words), found, expected));
    }
    let number = |slot| match slot {
        Slot::Own(k) => list.number(&format!("a{}", k + 1)),
        Slot::External(k) => list.number(&format!("e{}", k + 1)),
    };
    let number = |slot| number(slot).ok_or(());
    let made = if pose {
        let external = walk.axes.external(number).ok();
        frame(list).zip(external).map(|(frame, external)| {
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
    target.outside = walk.outside(EXTERNAL.map(|key| Some(list.number(key)?.value)));
    if pose {
        configure(walk.axes, words, list, &mut target)?;
    }
    Ok(Some(target))
}

fn configure(axes: &Axes, words: &Words, list: &List, target: &mut Target) -> Result<(), Problem> {
    if let Some((value, span, binary_digits)) = whole(words, list, "t", &target.name)? {
        let posture = target.posture_mut();
        let joints = (0..6).filter_map(|k| Some((k, axes.numbered(Slot::Own(k))?)));
        posture.configuration.extend(joints.map(|(bit, joint)| {
            let negative = value >> bit & 1 != 0;
            Statement::Negative { joint, negative }
        }));
        posture.marks.push(Mark::Signs {
            span,
            value,
            binary_digits,
        });
    }
    if let Some((value, ..)) = whole(words, list, "s", &target.name)? {
        let behind = Statement::Behind(value & 1 != 0);
        target.posture_mut().configuration.push(behind);
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
) -> Result<Option<(u32, Span, usize)>, Problem> {
    match list.get(key) {
        Some(Value::Number(number)) => {
            let value = number.value;
            if !(0.0..=255.0).contains(&value) || value.fract() != 0.0 {
                let component = format!("{} {value}", key.to_uppercase());
                let found = text!("{component} in {name}", component, name);
                let expected = text!("a whole number from 0 to 255");
                return Err(Problem::new(number.range().start, found, expected));
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number up to 255"
            )]
            let whole = value as u32;
            Ok(Some((whole, number.span(), 0)))
        }
        Some(Value::Other(range)) if words.bytes(range.start).starts_with(b"'") => {
            let spelled = words.spelled(range.start);
            let inside = spelled.trim_matches('\'');
            let (base, digits) = match inside.as_bytes().first() {
                Some(b'B' | b'b') => (2, &inside[1..]),
                Some(b'H' | b'h') => (16, &inside[1..]),
                _ => (10, inside),
            };
            let value = u32::from_str_radix(digits, base).ok();
            let value = value.filter(|value| *value <= 255);
            let Some((value, span)) = value.zip(words.span(range.start)) else {
                let expected = text!("a binary number such as 'B010'");
                let found = crate::text::Text::verbatim(spelled);
                return Err(Problem::new(words.at(range.start), found, expected));
            };
            let binary = if base == 2 { digits.len() } else { 0 };
            Ok(Some((value, span, binary)))
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

/// Statements of the language that look like calls.
const COMMANDS: &str = "wait return pulse anin anout cwrite cread swrite";

fn is_motion(name: &str) -> bool {
    const MOTIONS: &str = "ptp lin circ sptp slin scirc spl ptp_rel lin_rel circ_rel sptp_rel slin_rel scirc_rel \
        spl_rel";
    is_one_of(name, MOTIONS)
}
