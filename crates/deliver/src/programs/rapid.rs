//! RAPID (ABB): `jointtarget`, `robtarget`, in declarations, arrays and moves.
//!
//! ```text
//! jointtarget  [[rax_1 … rax_6], [eax_a … eax_f]]                      degrees (mm)
//! robtarget    [[x, y, z], [q1 … q4], [cf1, cf4, cf6, cfx], [eax_a … eax_f]]   mm
//! ```
//!
//! `cf1`, `cf4`, `cf6` are the quadrants of axes 1, 4 and 6. `cfx` says in bit 0 that axis 5 is
//! negative, in bit 1 that the wrist is behind the lower arm, in bit 2 that it is behind axis 1. An
//! external axis that is not there has 9E9. In a file with `ConfJ \Off` (`ConfL \Off` for lines) and never
//! `\On` a motion comes in the configuration that is nearest to where it starts, whatever its target states: the calls
//! between the switch and the motion are not followed.
//!
//! ```text
//! tooldata   [robhold, [[x, y, z], [q1 … q4]], …]                      on the flange
//! wobjdata   [robhold, ufprog, ufmec, [[x, y, z], [q1 … q4]], [[x, y, z], [q1 … q4]]]   user · object frame
//! ```

mod targets;

use super::axes::Axes;
use super::program::Program;
use super::program::not_in_numbers;
use super::referred::{BASE, MODE, Referred, Set, TOOL};
use super::target::Problem;
use super::text::Text;
use super::walk::{Constant, Declared, Walk, walked};
use super::words::{Dialect, Kind, List, Value, Words, is_one_of};

use targets::{computed, external, held, mass, target};

static DIALECT: Dialect = Dialect {
    comments: b"!",
    strings: b"\"",
    cased: false,
    end: phrase!("the end of the file"),
    ends,
    lists: *b"[]",
    keyed: false,
    part: phrase!("a number"),
    elements: *b"{}",
};

/// Heads of routines and blocks end without a semicolon, labels with their colon.
fn ends(words: &Words, next: Option<Kind>, breaks: bool) -> bool {
    let last = words.len() - 1;
    if words.is_sign(last, b';') || is_label(words) && next != Some(Kind::Sign(b'=')) {
        return true;
    }
    // `%%% VERSION:1 LANGUAGE:ENGLISH %%%` before a module.
    if (0..3).all(|k| words.is_sign(k, b'%')) {
        return last > 5 && (last - 2..last).all(|k| words.is_sign(k, b'%'));
    }
    let first = words.name(usize::from(words.name(0) == "local"));
    match first.as_str() {
        "if" | "elseif" => words.name(last) == "then",
        "for" | "while" => words.name(last) == "do",
        "case" | "default" => words.is_sign(last, b':'),
        "proc" | "func" if words.is_sign(last, b')') => words.is_closed(),
        "module" | "proc" | "func" | "trap" | "test" | "record" => breaks && words.is_closed(),
        _ if last > 0 => false,
        "else" | "error" | "undo" | "backward" => true,
        name => name.starts_with("end"),
    }
}

/// `again:`
fn is_label(words: &Words) -> bool {
    words.len() == 2 && words.is_sign(1, b':') && words.is_name(0) && words.name(0) != "default"
}

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
    axes.check_own("eax_a to eax_f")?;
    let pieces = [(text.start()..text.bytes.len(), &DIALECT, statement as _)];
    walked(
        text,
        axes,
        &pieces,
        |walk| walk.program.declare_no_tool("tool0"),
        |spelled| not_in_numbers(spelled),
    )
}

/// A declaration, a label, heads and ends of routines and blocks; anything else is an instruction.
fn statement(walk: &mut Walk, words: &Words) -> Result<(), Problem> {
    let before = |k: &usize| is_one_of(&words.name(*k), "local task const pers var");
    let k = (0..words.len()).take_while(before).count();
    let has = |names: &str| (0..k).any(|j| is_one_of(&words.name(j), names));
    if has("const pers var") {
        return declaration(walk, words, k, has("local"));
    }
    match words.name(k).as_str() {
        _ if is_label(words) => walk.label(),
        "module" | "record" => walk.begin_routine(words, words.len(), b"", true)?,
        word @ ("proc" | "func" | "trap") => {
            let k = k + if word == "func" { 2 } else { 1 };
            let name = words.name(k);
            if word == "trap" {
                walk.anytime(&name);
            }
            walk.begin_routine(words, k, b",)|{\\", name == "main")?;
        }
        "endmodule" | "endproc" | "endfunc" | "endtrap" | "endrecord" => walk.end_routine(),
        "if" if words.name(words.len() - 1) != "then" => {
            // `IF condition instruction;`
            let moves = |j: &usize| is_move(&words.name(*j)) || is_mode(&words.name(*j)).is_some();
            let Some(own) = (k + 1..words.len()).find(moves) else {
                walk.mention_all(words, k + 1..words.len(), "IF");
                return Ok(());
            };
            walk.begin_block(false)?;
            let taken = instruction(walk, words, own);
            walk.end_block();
            return taken;
        }
        "if" | "test" => walk.begin_block(false)?,
        "for" | "while" => walk.begin_block(true)?,
        "elseif" | "case" => walk.alternative(false),
        "else" | "default" => walk.alternative(true),
        "error" if words.len() == 1 => walk.handler(),
        "endif" | "endfor" | "endwhile" | "endtest" => walk.end_block(),
        _ => return instruction(walk, words, k),
    }
    Ok(())
}

/// `CONST robtarget name{3} := value;`
fn declaration(walk: &mut Walk, words: &Words, k: usize, local: bool) -> Result<(), Problem> {
    let kind = words.name(k);
    let (name, spelled, at) = (words.name(k + 1), words.spelled(k + 1), words.at(k + 1));
    let target = matches!(kind.as_str(), "robtarget" | "jointtarget");
    let held_part = match kind.as_str() {
        "tooldata" => Some(TOOL),
        "wobjdata" => Some(BASE),
        _ => None,
    };
    // What a module declares is known in the whole file, unless it is its own.
    let declared = if target {
        Declared::Target
    } else {
        Declared::Other(words.span(k))
    };
    walk.declare(&name, declared, !local && walk.depth() <= 1);
    let behind = words.behind_element(k + 1);
    let (array, equals) = (behind.is_some(), behind.unwrap_or(k + 2));
    let valued = words.is_sign(equals, b':') && words.is_sign(equals + 1, b'=');
    if !valued || !words.is_sign(equals + 2, b'[') {
        if let Some(part) = held_part {
            let says = not_in_numbers(&spelled);
            walk.program.declare(part, &spelled, at, Err(says));
        } else if valued && target {
            walk.changed(&name, words, k + 1);
        }
        return Ok(());
    }
    if !(target || held_part.is_some() || matches!(kind.as_str(), "loaddata" | "extjoint")) {
        return Ok(());
    }
    let (list, end) = words.list(equals + 2)?;
    match (held_part, kind.as_str()) {
        (Some(part), _) => {
            let pose = held(words, &list, &spelled, part == TOOL)?;
            let declared = walk.program.declare(part, &spelled, at, pose);
            if part == TOOL {
                declared.mass_kg = mass(list.parts.get(2).and_then(|part| part.value.list()));
                declared.stands = list.word(words, 0) == "false";
            }
        }
        (_, "loaddata") => {
            if let Some(kg) = mass(Some(&list)) {
                walk.constant(&name, Constant::Load(kg));
            }
        }
        (_, "extjoint") => {
            let numbers = list.numbers().map(<[_; 6]>::try_from);
            if let Some(Ok(numbers)) = numbers {
                walk.constant(&name, Constant::External(Box::new(numbers.map(external))));
            }
        }
        (_, kind) => {
            let pose = kind == "robtarget";
            values(walk, words, &list, [&name, &spelled], None, (pose, array))?;
        }
    }
    if words.is_sign(end, b';') {
        return Ok(());
    }
    Err(words.problem(end, crate::text::Text::verbatim("';'")))
}

/// A target, or each of an array of them.
fn values(
    walk: &mut Walk,
    words: &Words,
    list: &List,
    [name, spelled]: [&str; 2],
    whole: Option<&str>,
    (pose, array): (bool, bool),
) -> Result<(), Problem> {
    if !array {
        match target(walk, words, list, spelled, Some(pose))? {
            Ok(target) => walk.value(name, whole, target),
            Err(says) => walk.left(list.at, says),
        }
        return Ok(());
    }
    for (index, part) in list.parts.iter().enumerate() {
        let [name_of, spelled_of] = [name, spelled].map(|name| format!("{name}{{{}}}", index + 1));
        match &part.value {
            Value::List(list) => {
                let parts = if pose { 4 } else { 2 };
                let nested = list.first_list().and_then(List::first_list).is_some();
                let array = list.parts.len() != parts && nested;
                let (names, whole) = ([&*name_of, &*spelled_of], whole.or(Some(name)));
                values(walk, words, list, names, whole, (pose, array))?;
            }
            Value::Other(range) => {
                walk.mention_all(words, range.clone(), &spelled_of);
                walk.left(words.at(range.start), computed(&spelled_of));
            }
            Value::Number(_) => {}
        }
    }
    Ok(())
}

/// A move, an assignment, or a call.
fn instruction(walk: &mut Walk, words: &Words, k: usize) -> Result<(), Problem> {
    let (name, command) = (words.name(k), words.spelled(k));
    if is_move(&name) {
        return motion(walk, words, k, &name);
    }
    let equals = words.assigns(k);
    if let Some(equals) = equals.filter(|equals| words.is_sign(equals - 1, b':')) {
        return assignment(walk, words, k, equals);
    }
    match is_mode(&name) {
        Some(true) => walk.shift(words.at(k), &name),
        Some(false) => walk.set(MODE, Referred::Unsaid),
        None if name == "moveextj" => {
            let says = text!("{command} moves external axes only", command = &command);
            walk.left(words.at(k), says);
        }
        None if name == "gripload" => gripped(walk, words, k + 1),
        None if matches!(name.as_str(), "confj" | "confl") => {
            walk.keeps(name == "confl", words.name(k + 2) != "off");
        }
        None => {
            let alone = words.is_name(k) && words.is_sign(k + 1, b';');
            let alone = alone && !is_one_of(&name, INSTRUCTIONS);
            // `%"name" + NumToStr(n, 0)%;`
            let by_name = words.is_sign(k, b'%') && !words.is_sign(k + 1, b'%');
            let own = walk.call(&name, &command);
            walk.hand_over(&name, words, k + 1);
            if !own && alone || by_name {
                walk.routine_elsewhere(words.at(k), &words.shown(k, words.until(k, b";")));
            }
        }
    }
    walk.mention_all(words, k + 1..words.len(), &command);
    Ok(())
}

/// A load that is stated by its name.
fn gripped(walk: &mut Walk, words: &Words, k: usize) {
    let load = words.spelled(k);
    if let Some(Constant::Load(kg)) = walk.constant_of(&load).cloned() {
        walk.program.loads.state(kg, words.at(k), &load);
    }
}

/// `name := …` and `name.trans.x := …`: a target, or what changes one at run time.
fn assignment(walk: &mut Walk, words: &Words, k: usize, equals: usize) -> Result<(), Problem> {
    let (name, spelled) = (words.name(k), words.spelled(k));
    // An element of an array is known by its number.
    let element = words.element(k).filter(|_| words.is_sign(k + 4, b':'));
    let own = element.as_deref().unwrap_or(&name);
    let component = (k..equals).any(|j| words.is_sign(j, b'.'));
    let may_be = matches!(walk.declared(&name), Declared::Target | Declared::Nowhere);
    if words.is_sign(equals + 1, b'[') && !component && may_be {
        let (list, _) = words.list(equals + 1)?;
        // Any other list is no target and no problem.
        if let Ok(Ok(target)) = target(walk, words, &list, &spelled, None) {
            walk.value(own, element.is_some().then_some(&name), target);
            return Ok(());
        }
    }
    walk.changed(own, words, k);
    walk.mention_all(words, equals + 1..words.len(), &spelled);
    Ok(())
}

/// `MoveL p1, v100, fine, tGun\WObj:=fixture;`, argument by argument.
fn motion(walk: &mut Walk, words: &Words, from: usize, name: &str) -> Result<(), Problem> {
    let circle = name.starts_with("movec") || is_one_of(name, "triggc arcc arccend");
    let command = words.spelled(from);
    let mut arguments = Vec::new();
    let mut k = from + 1;
    while k < words.len() && !words.is_sign(k, b';') {
        let end = words.until(k, b",;");
        if let Some(j) = (k..end).find(|j| is_move(&words.name(*j))) {
            let expected = crate::text::Text::verbatim("';'");
            return Err(words.problem(j, expected));
        }
        // A switch at the beginning is no argument: `\Conc, p1, …`.
        if !words.is_sign(k, b'\\') {
            arguments.push((k, end));
        }
        k = end + usize::from(words.is_sign(end, b','));
    }
    let goals = if circle { 2 } else { 1 };
    let mut changes = held_in(words, name, &arguments, goals).to_vec();
    for j in (from + 1..k).filter(|j| words.is_sign(j - 1, b'\\')) {
        match words.name(j).as_str() {
            "corr" => {
                let says = text!("{name} shifts the poses after it", name = "Corr");
                changes.push((MODE, Referred::Unknown(says)));
            }
            // The load of the whole is stated in place of the tool's.
            "tload" => gripped(walk, words, j + 3),
            _ => {}
        }
    }
    let along = !is_one_of(name, "movej movejdo movejao movejgo movejsync triggj spotj");
    walk.moves(along, |walk| {
        let mut goals = arguments.into_iter().take(goals);
        goals.try_for_each(|goal| self::goal(walk, words, goal, &command, &changes))
    })
}

/// The work object and the tool of a move.
fn held_in(words: &Words, name: &str, arguments: &[(usize, usize)], goals: usize) -> [Set; 2] {
    // Goals, speed, zone, tool; of other processes the tool is the last.
    let place = if name.starts_with("move") {
        goals + 2
    } else {
        arguments.len().saturating_sub(1)
    };
    let Some(&(k, end)) = arguments.get(place) else {
        return [(BASE, Referred::Unsaid), (TOOL, Referred::Unsaid)];
    };
    let of = |k: usize| {
        let end = words.until(k, b"\\,;");
        if words.is_name(k) && end == k + 1 {
            return Referred::named(words.spelled(k));
        }
        let name = words.shown(k, end);
        Referred::Unknown(not_in_numbers(name))
    };
    let is_frame = |j: &usize| words.is_sign(*j, b'\\') && words.name(*j + 1) == "wobj";
    // The switch may stand behind a later argument as well.
    let last = arguments.last().map_or(end, |(_, end)| *end);
    let frame = (k..last).find(is_frame).map(|j| of(j + 4));
    let frame = frame.filter(|frame| !frame.is("wobj0"));
    [(BASE, frame.unwrap_or_default()), (TOOL, of(k))]
}

fn goal(
    walk: &mut Walk,
    words: &Words,
    (k, end): (usize, usize),
    command: &str,
    changes: &[Set],
) -> Result<(), Problem> {
    let at = words.at(k);
    if words.is_sign(k, b'*') {
        let says = text!(
            "{command} goes to *, whose values are in the controller and not in the file",
            command
        );
        walk.left(at, says);
    } else if words.is_sign(k, b'[') {
        let (list, behind) = words.list(k)?;
        if behind < end && !words.is_sign(behind, b'\\') {
            return Err(words.problem(behind, crate::text::Text::verbatim("',' ';'")));
        }
        match target(walk, words, &list, &format!("target of {command}"), None)? {
            Ok(target) => walk.go_to(target, changes),
            Err(says) => walk.left(at, says),
        }
    } else {
        // Switches of the move may follow its target.
        let bare = words.until(k, b"\\").min(end);
        let behind = words.behind_element(k).unwrap_or(k + 1);
        let plain = words.is_name(k) && behind >= bare;
        let end = if plain { bare } else { end };
        walk.go_to_words(words, k..end, command, None, changes);
    }
    Ok(())
}

/// Whether an instruction shifts all poses after it, or ends that.
fn is_mode(name: &str) -> Option<bool> {
    match name {
        "pdispset" | "pdispon" => Some(true),
        "pdispoff" => Some(false),
        _ => None,
    }
}

/// Instructions without arguments.
const INSTRUCTIONS: &str = "return stop break exit exitcycle retry trynext raise startmove stopmove storepath \
    restopath clearpath tperase eoffsoff softdeact stopmovereset syncmoveundo waitrob";

/// Instructions that move to a target that is their first argument.
fn is_move(name: &str) -> bool {
    const MOVES: &str = "movej movel movec moveabsj movejdo moveldo movecdo movejao movelao movecao movejgo movelgo \
        movecgo movejsync movelsync movecsync triggj triggl triggc arcl arcc arclstart arclend \
        arccend spotl spotj";
    is_one_of(name, MOVES)
}
