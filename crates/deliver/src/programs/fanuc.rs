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
//! joints 1, 4 and 6. A move goes to a position in the frame and with the tool that the position names; the
//! controller stops where `UFRAME_NUM` and `UTOOL_NUM` are others. User frames are in the world, whose origin is on
//! axis 1 where it passes axis 2 at the robot's zero, and whose axes are those of the base. A controller whose
//! language is German lists its words in German ([`wording`]).

mod frames;
mod positions;
mod wording;

use super::program::not_in_numbers;
use crate::kinematics::Pose;
use nalgebra::UnitQuaternion;
use std::ops::Range;

use super::axes::Axes;
use super::program::Program;
use super::referred::{BASE, MODE, Referred, Set, TOOL};
use super::target::Problem;
use super::text::Text;
use super::walk::{Constant, Grammar, Walk, walked};
use super::words::{Dialect, Kind, Words, is_one_of};
use wording::{Wording, in_english};

/// Positions end with their bracket and a semicolon.
static POSITIONS: Dialect = Dialect {
    comments: b"",
    strings: b"\"'",
    end: phrase!("the end of /POS"),
    ends: |words, next, _| {
        let last = words.len() - 1;
        let behind = words.is_sign(last, b'}') && next != Some(Kind::Sign(b';'));
        words.is_closed() && (behind || words.is_sign(last, b';'))
    },
    ..MOVES
};

/// Moves end with a semicolon, or with their line unless the next begins with a colon.
static MOVES: Dialect = Dialect {
    comments: b"!",
    strings: b"",
    cased: false,
    end: phrase!("the end of the line"),
    ends: |words, next, breaks| {
        words.is_sign(words.len() - 1, b';') || breaks && next != Some(Kind::Sign(b':'))
    },
    // It has no lists.
    lists: [0; 2],
    keyed: false,
    part: phrase!("a number"),
    elements: [0; 2],
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
    let [attributes, tracks, moves, positions] = sections(text);
    let motion: Grammar = match Wording::of(text, attributes).map_err(|problem| vec![problem])? {
        Wording::English => |walk, words| motion(walk, words, |_| true),
        Wording::German => |walk, words| motion(walk, words, wording::is_known_in_german),
    };
    let pieces = [
        (positions, &POSITIONS, positions::position as _),
        (moves, &MOVES, motion),
    ];
    walked(
        text,
        axes,
        &pieces,
        |walk| {
            walk.program.declare_no_tool("UT 0");
            if let Some(shoulder) = axes.shoulder_mm() {
                walk.program.base_from_world =
                    Pose::from_parts(shoulder.into(), UnitQuaternion::identity());
            }
            frames::declare(&mut walk.program, text);
            if !tracks.is_empty() {
                let says = text!("the program tracks a conveyor, which moves its frame");
                walk.set(MODE, Referred::Unknown(says));
            }
        },
        |spelled| text!("{spelled} is not in /POS, or not a target", spelled),
    )
}

/// The lines of `/ATTR`, where a conveyor is named that the program tracks, the lines of `/MN`, and those of `/POS`.
fn sections(text: &Text) -> [Range<usize>; 4] {
    let mut found = [0..0, 0..0, 0..0, 0..0];
    let mut section = None;
    for line in text.lines() {
        let bytes = text.bytes[line.clone()].trim_ascii();
        if bytes.starts_with(b"/") && !bytes.starts_with(b"//") {
            let heads: [&[u8]; 4] = [b"/ATTR", b"/APPL", b"/MN", b"/POS"];
            section = heads.iter().position(|head| bytes.starts_with(head));
            if let Some(section) = section.filter(|section| *section != 1) {
                found[section] = line.end..line.end;
            }
        } else if bytes.starts_with(b"[*SYSTEM*]") {
            // Of a backup that is read with it.
            section = None;
        } else if section == Some(1) {
            let schedule = bytes.strip_prefix(b"LINE_TRACK_SCHEDULE_NUMBER");
            if schedule.is_some_and(|rest| rest.iter().any(|b| matches!(b, b'1'..=b'9'))) {
                found[1] = line;
            }
        } else if let Some(section) = section {
            found[section].end = line.end;
        }
    }
    found
}

/// One statement of `/MN`; a motion with a word that is not known goes where nobody can say.
#[allow(clippy::unnecessary_wraps, reason = "as every grammar is called")]
fn motion(walk: &mut Walk, words: &Words, is_known: fn(&str) -> bool) -> Result<(), Problem> {
    let mut k = usize::from(words.kind(0) == Some(Kind::Digits));
    if !words.is_sign(k, b':') && k > 0 {
        return Ok(());
    }
    // A comment hides the semicolon of its line, so that the colon of the next may follow; lines need no numbers.
    k += (k..words.len())
        .take_while(|j| words.is_sign(*j, b':'))
        .count();
    let (first, at) = (in_english(words.name(k)), words.at(k));
    let letter = is_one_of(&first, "j l c a s") && words.is_name(k + 1);
    let touching = is_one_of(&first, "jp lp cp ap sp");
    let goes_on = first == "p" && words.assigns(k).is_none();
    if !(letter || touching || goes_on) {
        instruction(walk, words, k);
        return Ok(());
    }
    // Names outside of brackets: goals, and how the move is changed.
    let mut own = Vec::new();
    let mut j = k;
    while j < words.len() {
        if words.is_name(j) {
            own.push((j, in_english(words.name(j))));
        }
        let open = words.is_sign(j, b'[') || words.is_sign(j, b'(');
        j = if open {
            words.until(j + 1, b"])") + 1
        } else {
            j + 1
        };
    }
    let first_of = |names: &str| {
        own.iter()
            .map(|(_, name)| name)
            .find(|name| is_one_of(name, names))
    };
    let unknown = own
        .iter()
        .map(|(_, name)| name)
        .find(|name| !is_known(name));
    let by = first_of("inc offset tool_offset voffset").or(unknown);
    let mut mode = walk.held(MODE).clone();
    if first_of("coord").is_some() {
        mode = Referred::Unknown(text!("another group moves its frame (COORD)"));
    }
    if first_of("rtcp").is_some() {
        mode = Referred::Unknown(text!(
            "the tool stands and the robot moves the part ({sign})",
            sign = "RTCP"
        ));
    }
    for (j, name) in own.iter().filter(|(j, _)| words.is_sign(j + 1, b'[')) {
        let j = *j;
        if name == "pr" && !words.is_sign(j.saturating_sub(1), b',') {
            let says = not_in_numbers("PR[…]");
            walk.left(at, says);
        }
        if !(name == "p" || touching && j == k) {
            continue;
        }
        let Ok(number) = words.spelled(j + 2).parse::<u64>() else {
            let target = j..words.until(j + 2, b"]") + 1;
            walk.go_to_worked_out(words, target, &words.spelled(k), &[]);
            continue;
        };
        let (key, spelled) = (format!("p[{number}]"), format!("P[{number}]"));
        let changes = held_in(walk, &key, mode.clone());
        match by.map(|by| by.to_uppercase()) {
            Some(inc) if inc == "INC" => walk.relative(&key, &inc),
            Some(offset) => {
                let says = text!(
                    "the move to P[{number}] is shifted at run time ({offset})",
                    number,
                    offset = &offset
                );
                walk.left(at, says);
                walk.go_to_part(&key, at, false, &changes);
                walk.mention(&key, at, &offset);
            }
            None => walk.go_to_name((&key, &spelled), at, None, &changes),
        }
    }
    Ok(())
}

/// What a part of the way is called in positions, and the variable that has to agree with it.
fn called(part: usize) -> (&'static str, &'static str) {
    match part {
        TOOL => ("UT", "UTOOL_NUM"),
        _ => ("UF", "UFRAME_NUM"),
    }
}

/// Frame, tool and mode of a move to a position.
fn held_in(walk: &Walk, key: &str, mode: Referred) -> [Set; 3] {
    let [frame, tool] = match walk.constant_of(key) {
        Some(Constant::Position(numbers)) => (**numbers).clone(),
        _ => [String::new(), String::new()],
    };
    let own = |part: usize, number: &str| {
        let (short, variable) = called(part);
        // The frame of number 0 is the world.
        let is_none = number.is_empty() || part == BASE && number == "0";
        let named = Referred::named(format!("{short} {number}"));
        match walk.held(part) {
            Referred::Named(held) if !number.is_empty() && *walk.held(part) != named => {
                let held = held.trim_start_matches(char::is_alphabetic).trim();
                Referred::Unknown(text!(
                    "{variable} is {held} at the move, and the position is of {short} {number}",
                    variable,
                    held,
                    short,
                    number
                ))
            }
            _ if is_none => Referred::Unsaid,
            _ => named,
        }
    };
    [
        (BASE, own(BASE, &frame)),
        (TOOL, own(TOOL, &tool)),
        (MODE, mode),
    ]
}

/// `UTOOL[n]=…`, `UFRAME_NUM=…`, `PAYLOAD[n]`, `P[n]=…`, calls, and where lines are jumped to.
fn instruction(walk: &mut Walk, words: &Words, k: usize) {
    let (first, at) = (in_english(words.name(k)), words.at(k));
    let number = words.spelled(k + 2);
    let indexed = words.is_sign(k + 1, b'[');
    let part = if first.starts_with("utool") {
        TOOL
    } else {
        BASE
    };
    let named = format!("{} {number}", called(part).0);
    match first.as_str() {
        "utool" | "uframe" if indexed => {
            let name = first.to_uppercase();
            let says = not_in_numbers(format!("{name}[{number}]"));
            walk.program.declare(part, &named, at, Err(says.clone()));
            walk.left(at, says);
        }
        "utool_num" | "uframe_num" => {
            let known = words.is_sign(k + 1, b'=') && words.kind(k + 2) == Some(Kind::Digits);
            let named = known.then(|| Referred::named(named));
            walk.set(part, named.unwrap_or_default());
        }
        "payload" if indexed => {
            let says = text!(
                "PAYLOAD[{n}] has its mass in the controller: --load says it",
                n = &number
            );
            walk.left(at, says);
        }
        "p" if indexed => walk.changed(&format!("p[{number}]").to_lowercase(), words, k),
        "call" | "run" => {
            let command = words.shown(k, words.until(k, b";("));
            walk.routine_elsewhere(at, &command);
            forget(walk);
        }
        // `Touch Offset PR[1]`, `Track TAST[1]`, each up to its `End`.
        "touch" | "track" => {
            if words.name(words.len().saturating_sub(2)) == "end" {
                walk.set(MODE, Referred::Unsaid);
            } else {
                walk.shift(at, &words.spelled(k));
            }
        }
        // What was set before is not known where lines come together; the positions say it all the same.
        "lbl" | "if" | "else" | "endif" | "for" | "endfor" | "select" => forget(walk),
        _ => {
            // `PR[1]=P[1]`
            for j in k..words.len() {
                if words.name(j) == "p" && words.is_sign(j + 1, b'[') {
                    let key = format!("p[{}]", words.spelled(j + 2));
                    walk.mention(&key, words.at(j), &words.shown(k, words.until(k, b"=;")));
                }
            }
        }
    }
}

fn forget(walk: &mut Walk) {
    walk.set(BASE, Referred::Unsaid);
    walk.set(TOOL, Referred::Unsaid);
}
