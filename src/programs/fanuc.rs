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

mod positions;

use std::collections::BTreeMap;
use std::ops::Range;

use super::answer::{Reason, SkippedTarget};
use super::axes::Axes;
use super::program::Program;
use super::referred::{declare, declare_none};
use super::target::{Problem, Remark};
use super::text::Text;
use super::tokens::{Dialect, Source};

use positions::Positions;

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
    axes.check_own("E1 to E3")?;
    let mut program = Program::default();
    declare_none(&mut program.tools, "UT 0");
    let mut problems = Vec::new();
    let (moves, positions) = sections(text);
    let source = Source::new(text, DIALECT, phrase!("the end of /POS"));
    let by_number = match positions {
        Some(range) => match source.words(range) {
            Ok(words) => {
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
        set_by(&upper, at, program);
        if let Some(number) = position_numbers(&upper.replace(' ', "")).first()
            && upper.replace(' ', "").starts_with(&format!("P[{number}]="))
        {
            let says = text!("P[{number}] is changed at run time", number);
            program.at_run_time.push(Remark { at, text: says });
        }
        return;
    }
    let motion = upper.split(';').next().unwrap_or_default();
    let words: Vec<&str> = motion.split([' ', ',']).collect();
    let by = words
        .iter()
        .find(|w| matches!(**w, "INC" | "OFFSET" | "TOOL_OFFSET"));
    if motion.contains(" PR[") || motion.starts_with("PR[") {
        let says = text!("a move to a position register, whose value is set at run time");
        program.at_run_time.push(Remark { at, text: says });
    }
    for number in position_numbers(motion) {
        let Some(index) = by_number.get(&number) else {
            let says = text!("P[{number}] is not in /POS, or not a target", number);
            program.at_run_time.push(Remark { at, text: says });
            continue;
        };
        match by {
            Some(&"INC") => {
                let says = text!(
                    "P[{number}] is relative to the robot's position (INC)",
                    number
                );
                program.targets[*index].left =
                    Some(Box::new(SkippedTarget::new(Reason::Relative, says)));
            }
            Some(offset) => {
                let says = text!(
                    "the move to P[{number}] is shifted at run time ({offset})",
                    number,
                    offset
                );
                program.at_run_time.push(Remark { at, text: says });
                program.visits.push(*index);
            }
            None => program.visits.push(*index),
        }
    }
}

/// `UTOOL[n]=…`, `UFRAME[n]=…` and `PAYLOAD[n]`: what the controller holds or a register sets.
fn set_by(line: &str, at: usize, program: &mut Program) {
    let line = line.replace(' ', "");
    let number = |name: &str| -> Option<&str> {
        let rest = line.strip_prefix(name)?.strip_prefix('[')?;
        rest.split([']', ':', ',']).next()
    };
    let kinds = [("UTOOL", "UT", true), ("UFRAME", "UF", false)];
    for (name, short, tool) in kinds {
        if let Some(n) = number(name) {
            let says = text!("{name}[{n}] is set at run time", name, n);
            let names = if tool {
                &mut program.tools
            } else {
                &mut program.frames
            };
            declare(names, &format!("{short} {n}"), at, Err(says.clone()));
            program.at_run_time.push(Remark { at, text: says });
        }
    }
    if let Some(n) = number("PAYLOAD") {
        let says = text!(
            "PAYLOAD[{n}] has its mass in the controller: --load says it",
            n
        );
        program.at_run_time.push(Remark { at, text: says });
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
