//! What sets base, tool and mode of a KRL program: `$BASE`, `$TOOL`, `$IPO_MODE`, `BAS(#…)`, the `FDAT` of inline
//! forms, and `WITH` of splines.

use crate::kinematics::Pose;
use crate::programs::program::not_in_numbers;
use crate::text::Text;

use super::super::pose::{Frame, Orientation};
use super::super::referred::{BASE, MODE, Referred, Set, TOOL};
use super::super::walk::{Constant, Walk};
use super::super::words::{Kind, List, Value, Words};

pub(super) const POSE: [&str; 8] = ["x", "y", "z", "a", "b", "c", "s", "t"];

/// X, Y, Z, A, B, C, where all are written out.
pub(super) fn frame(list: &List) -> Option<Frame> {
    let [x, y, z, a, b, c, ..] = POSE.map(|key| list.number(key));
    let numbers = [x?, y?, z?, a?, b?, c?];
    Some(Frame::of_degrees(numbers, Orientation::ZyxDegrees))
}

/// `BAS(#BASE,3)`
pub(super) fn bas(walk: &mut Walk, words: &Words) {
    if !words.is_sign(2, b'#') || !words.is_sign(4, b',') {
        return;
    }
    let number = words.shown(5, words.until(5, b")"));
    match words.name(3).as_str() {
        "base" => walk.set(BASE, numbered("BASE_DATA", &number, Referred::Unsaid)),
        "tool" => walk.set(TOOL, numbered("TOOL_DATA", &number, null_tool())),
        "ex_base" => {
            let command = words.shown(0, words.len());
            let says = text!("the base moves with an external axis ({command})", command);
            walk.set(BASE, Referred::Unknown(says));
        }
        _ => {}
    }
}

/// Which part of the way a variable of the system sets.
fn part_of(name: &str) -> Option<usize> {
    match name {
        "$base" => Some(BASE),
        "$tool" => Some(TOOL),
        "$ipo_mode" => Some(MODE),
        _ => None,
    }
}

/// What an assignment from word `k` says of base, tool, mode or load; whether that is all. A list of numbers that may
/// be a base or a tool is kept.
pub(super) fn sets(
    walk: &mut Walk,
    words: &Words,
    (k, equals, end): (usize, usize, usize),
    list: Option<&(List, usize)>,
) -> bool {
    let (name, shown) = (words.name(k), words.shown(k, equals));
    let component = (k..equals).any(|j| words.is_sign(j, b'.'));
    match (name.as_str(), part_of(&name)) {
        (_, Some(part)) if component && part != MODE => {
            let says = text!("{name} is set", name = shown);
            walk.set(part, Referred::Unknown(says));
        }
        (_, Some(part)) => {
            let what = value(walk, words, (equals + 1, end), part, list);
            walk.set(part, what);
        }
        ("$load" | "load_data", _) if !component => {
            if let Some(kg) = list.and_then(|(list, _)| list.number("m")) {
                walk.program.loads.state(kg.value, words.at(k), &shown);
            }
        }
        // A part of it may be that of any of the three.
        ("fdat_act", _) if component => {
            for part in [BASE, TOOL, MODE] {
                let says = text!("{name} is set", name = &shown);
                walk.set(part, Referred::Unknown(says));
            }
        }
        ("fdat_act", _) => {
            let set = match list.and_then(|(list, _)| frames_of(words, list)) {
                Some(here) => as_numbered(&here, &shown),
                None => by_numbers(walk, &words.spelled(equals + 1)),
            };
            for (part, what) in set {
                walk.set(part, what);
            }
        }
        _ if component => return false,
        _ => {
            if let Some((list, _)) = list {
                numbers(walk, words, &name, list, equals);
            }
            let target = |list: &List| ["s", "t", "a1"].iter().any(|key| list.get(key).is_some());
            let pose = match list {
                Some((list, _)) if target(list) => return false,
                Some((list, _)) => pose_of(list, &shown),
                None if !walk.is_held(&shown) => return false,
                None => Err(not_in_numbers(&shown)),
            };
            for part in [BASE, TOOL] {
                walk.program
                    .declare(part, &shown, words.at(k), pose.clone());
            }
            return false;
        }
    }
    true
}

/// The numbers of tool and base that are declared with a name; of a data list alone they say how inline forms go to
/// the point of that name.
fn numbers(walk: &mut Walk, words: &Words, name: &str, list: &List, equals: usize) {
    let Some(frames) = frames_of(words, list) else {
        return;
    };
    walk.constant(name, Constant::Frames(Box::new(frames)));
    let point = format!("x{}", name.trim_start_matches('f'));
    if walk.routines == 0 && name.starts_with('f') && walk.knows(&point) {
        let changes = by_numbers(walk, name);
        walk.go_to_name((&point, &point), words.at(equals), None, &changes);
    }
}

/// Numbers of base and tool, and whether the tool stands.
type Numbers = ([Option<f64>; 2], bool);

fn frames_of(words: &Words, list: &List) -> Option<Numbers> {
    let own = ["base_no", "tool_no"].map(|key| list.number(key).map(|number| number.value));
    let tcp = match list.get("ipo_frame") {
        Some(Value::Other(range)) => words.name(range.start + 1) == "tcp",
        _ => false,
    };
    (own != [None; 2]).then_some((own, tcp))
}

/// What a motion, or a spline, says behind WITH.
pub(super) fn with(walk: &mut Walk, words: &Words) -> Vec<Set> {
    let mut set = Vec::new();
    let with = (0..words.len()).find(|k| words.name(*k) == "with");
    let mut k = with.map_or(words.len(), |with| with + 1);
    while k < words.len() {
        let end = words.until(k, b",");
        let part = part_of(&words.name(k)).filter(|_| words.is_sign(k + 1, b'='));
        if let Some(part) = part {
            // Inline forms name the numbers of their point: STOOL2(FP1), SBASE(FP1.BASE_NO).
            let what = if words.is_sign(k + 3, b'(') {
                let own = by_numbers(walk, &words.spelled(k + 4));
                own[part].1.clone()
            } else {
                let list = words.list(k + 2).ok();
                let list = list.filter(|_| words.is_sign(k + 2, b'{'));
                value(walk, words, (k + 2, end), part, list.as_ref())
            };
            set.push((part, what));
        }
        k = end + 1;
    }
    set
}

/// What `$BASE`, `$TOOL` or `$IPO_MODE` is set to.
fn value(
    walk: &mut Walk,
    words: &Words,
    (k, end): (usize, usize),
    part: usize,
    list: Option<&(List, usize)>,
) -> Referred {
    let shown = words.shown(k, end);
    if part == MODE {
        return mode(&shown);
    }
    if let Some((list, behind)) = list
        && *behind == end
    {
        let pose = pose_of(list, &shown);
        walk.program.declare(part, &shown, words.at(k), pose);
        return Referred::named(shown);
    }
    let indexed = words.is_sign(k + 1, b'[') && words.kind(k + 2) == Some(Kind::Digits);
    if words.is_name(k) && (end == k + 1 || indexed && end == k + 4) {
        let referred = Referred::named(shown);
        // The null frame is the world.
        let world = part == BASE && referred.is("$nullframe");
        return if world { Referred::Unsaid } else { referred };
    }
    Referred::Unknown(not_in_numbers(shown))
}

/// How a motion is interpolated: of the tool in the base, or of the part at a tool that stands.
fn mode(shown: &str) -> Referred {
    match shown.to_lowercase().as_str() {
        "#base" => Referred::Unsaid,
        "#tcp" => Referred::Unknown(text!(
            "the tool stands and the robot moves the part ({sign})",
            sign = "#TCP"
        )),
        _ => Referred::Unknown(not_in_numbers(shown)),
    }
}

fn pose_of(list: &List, spelled: &str) -> Result<Pose, Text> {
    let pose = frame(list).and_then(|frame| frame.pose());
    pose.ok_or_else(|| not_in_numbers(spelled))
}

/// Base, tool and mode of `FDAT_ACT = name`, by the numbers that `name` is declared with.
fn by_numbers(walk: &Walk, name: &str) -> [Set; 3] {
    match walk.constant_of(name) {
        Some(Constant::Frames(known)) => as_numbered(known, name),
        _ => as_numbered(&([None; 2], false), name),
    }
}

fn as_numbered((numbers, tcp): &Numbers, name: &str) -> [Set; 3] {
    let of = |number: Option<f64>, table: &str, zero: Referred| match number {
        Some(number) => numbered(table, &number.to_string(), zero),
        None => Referred::Unknown(not_in_numbers(name)),
    };
    [
        (BASE, of(numbers[0], "BASE_DATA", Referred::Unsaid)),
        (TOOL, of(numbers[1], "TOOL_DATA", null_tool())),
        (MODE, mode(if *tcp { "#tcp" } else { "#base" })),
    ]
}

/// The base or tool of a number; 0 is none.
fn numbered(table: &str, number: &str, zero: Referred) -> Referred {
    match number.parse::<u32>() {
        Ok(0) => zero,
        Ok(number) => Referred::named(format!("{table}[{number}]")),
        Err(_) => Referred::Unknown(not_in_numbers(format!("{table}[{number}]"))),
    }
}

/// The tool that is the flange itself.
fn null_tool() -> Referred {
    Referred::named("$NULLFRAME")
}
