//! `URScript` (Universal Robots): lists of joint values and poses `p[…]` in moves, or given to a name
//! that moves go to.
//!
//! ```text
//! movej([q1, …, q6])      rad
//! movel(p[x, y, z, rx, ry, rz])   m, rotation vector in rad
//! ```
//!
//! A pose has no configuration; `get_inverse_kin(p[…], [near])` says one.

use super::program::not_in_numbers;
use crate::kinematics::{JointKind, Pose};

use super::axes::Axes;
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::program::Program;
use super::referred::{MODE, Referred, TOOL};
use super::target::{Problem, Shape, Target};
use super::text::Text;
use super::walk::{Constant, Declared, Walk, walked};
use super::words::{Dialect, Kind, Words, is_one_of};

static DIALECT: Dialect = Dialect {
    comments: b"#",
    strings: b"\"",
    cased: true,
    end: phrase!("the end of the file"),
    ends,
    lists: *b"[]",
    keyed: false,
    part: phrase!("a number"),
    // Which element of a list is moved to is never known.
    elements: [0; 2],
};

/// mm in a metre.
const METRE: f64 = 1000.0;

/// With its line, unless a bracket is open; heads of blocks with their colon.
fn ends(words: &Words, _: Option<Kind>, breaks: bool) -> bool {
    let head = matches!(
        words.bytes(0),
        b"if" | b"elif" | b"else" | b"while" | b"for" | b"def" | b"thread" | b"sec"
    );
    words.is_closed() && (breaks || head && words.is_sign(words.len() - 1, b':'))
}

pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let moves = ["movej(", "movel(", "movep(", "movec(", "servoj("];
    moves.iter().any(|m| text.contains(m))
        || text.lines().any(|l| l.trim_start().starts_with("def "))
}

pub(super) fn read(text: &Text, axes: &Axes) -> Result<Program, Vec<Problem>> {
    if (0..axes.joints()).any(|j| axes.kind(j) == JointKind::Prismatic) {
        let found = text!("a model with a sliding joint");
        let expected = text!("turning joints, which URScript gives in rad");
        return Err(vec![Problem::new(0, found, expected)]);
    }
    let pieces = [(text.start()..text.bytes.len(), &DIALECT, statement as _)];
    walked(
        text,
        axes,
        &pieces,
        |_| {},
        |spelled| not_in_numbers(spelled),
    )
}

fn statement(walk: &mut Walk, words: &Words) -> Result<(), Problem> {
    let scope = words.name(0);
    let k = usize::from(matches!(scope.as_str(), "global" | "local"));
    match words.name(k).as_str() {
        kind @ ("def" | "thread" | "sec") => {
            if kind == "thread" {
                walk.anytime(&words.name(1));
            }
            return walk.begin_routine(words, 1, b",)=", walk.routines == 0);
        }
        "end" if walk.in_block() => walk.end_block(),
        "end" => walk.end_routine(),
        "if" => walk.begin_block(false)?,
        "while" | "for" => walk.begin_block(true)?,
        "elif" => walk.alternative(false),
        "else" => walk.alternative(true),
        _ if words.is_name(k) && words.is_sign(k + 1, b'=') && !words.is_sign(k + 2, b'=') => {
            return assignment(walk, words, k, &scope);
        }
        // `q[5] = q[5] + 0.1`
        name if words.is_sign(k + 1, b'[') && words.assigns(k).is_some() => {
            walk.changed(name, words, k);
        }
        _ => {}
    }
    expression(walk, words, 0)
}

/// `global p1 = p[…]`
fn assignment(walk: &mut Walk, words: &Words, k: usize, scope: &str) -> Result<(), Problem> {
    let (name, at) = (words.name(k), words.at(k));
    match scope {
        "global" | "local" => walk.declare(&name, Declared::Nowhere, scope == "global"),
        _ => walk.given(&name),
    }
    let (pose, numbers) = match literal(words, k + 2)? {
        Some((pose, Some(numbers), end)) if end == words.len() => (pose, numbers),
        other => {
            walk.changed(&name, words, k);
            return expression(walk, words, other.map_or(k + 2, |(.., end)| end));
        }
    };
    let values = numbers.iter().map(|number| number.value).collect();
    walk.constant(&constant(pose, &name), Constant::List(values));
    if !walk.is_gone_to(&name) {
        if pose && walk.is_told(&name) {
            let says = text!("{name} is a pose that no move of this file uses", name);
            walk.left(at, says);
        }
        return Ok(());
    }
    match target(walk.axes, pose, &numbers, at, &name) {
        Ok(target) => walk.value(&name, None, target),
        Err(problem) => {
            // A list that is no target of a move after all.
            let found = problem.found;
            walk.left(at, text!("{name} is not corrected: {found}", name, found));
        }
    }
    Ok(())
}

/// Whatever is called from word `k` on.
fn expression(walk: &mut Walk, words: &Words, k: usize) -> Result<(), Problem> {
    let by = words.spelled(k);
    let mut k = k;
    while k < words.len() {
        let name = words.name(k);
        if !words.is_name(k) || !words.is_sign(k + 1, b'(') {
            walk.mention(&name, words.at(k), &by);
            k += 1;
            continue;
        }
        match name.as_str() {
            "movec" => {
                k = motion(walk, words, k, &name, 2)?;
                continue;
            }
            "movej" | "movel" | "movep" | "servoj" | "servol" | "optimovej" | "optimovel" => {
                k = motion(walk, words, k, &name, 1)?;
                continue;
            }
            "set_payload" | "set_target_payload" | "set_payload_mass" => {
                if let Some(Ok((kg, _))) = words.number(k + 2) {
                    walk.program.loads.state(kg.value, words.at(k), &name);
                }
            }
            "set_tcp" => {
                let tool = tool_at(walk, words, k + 2);
                walk.set(TOOL, tool);
                return Ok(());
            }
            "track_conveyor_linear" | "track_conveyor_circular" | "path_offset_enable" => {
                walk.shift(words.at(k), &name);
            }
            "stop_conveyor_tracking" | "path_offset_disable" => walk.set(MODE, Referred::Unsaid),
            _ => {
                walk.call(&name, &name);
                walk.hand_over(&name, words, k + 2);
            }
        }
        k += 2;
    }
    Ok(())
}

/// The tool that is set by a pose or its name.
fn tool_at(walk: &mut Walk, words: &Words, k: usize) -> Referred {
    let shown = words.shown(k, words.until(k, b",)"));
    let values = values(walk, words, k, (true, &shown)).unwrap_or_default();
    let pose = pose_of(&values);
    let pose = pose.ok_or_else(|| not_in_numbers(&shown));
    walk.program.declare(TOOL, &shown, words.at(k), pose);
    Referred::named(shown)
}

/// The numbers of a pose or of joint values, written out or by a name; none of anything else.
fn values(
    walk: &Walk,
    words: &Words,
    k: usize,
    (pose, name): (bool, &str),
) -> Result<Vec<f64>, Problem> {
    if let Some((is_pose, Some(numbers), _)) = literal(words, k)?
        && is_pose == pose
    {
        return Ok(numbers.iter().map(|number| number.value).collect());
    }
    let key = constant(pose, name);
    match walk.constant_of(&key) {
        Some(Constant::List(values)) => Ok(values.to_vec()),
        _ => Ok(Vec::new()),
    }
}

/// The name of a constant: a pose and joint values may have the same.
fn constant(pose: bool, name: &str) -> String {
    format!("{}{name}", if pose { "p" } else { "" })
}

fn pose_of(values: &[f64]) -> Option<Pose> {
    let [x, y, z, rx, ry, rz] = *values else {
        return None;
    };
    let at = nalgebra::Vector3::new(x, y, z) * METRE;
    let turn = Orientation::RotationVector.read(&[rx, ry, rz])?;
    Some(Pose::from_parts(at.into(), turn))
}

/// A move to as many targets; the word behind the last.
fn motion(
    walk: &mut Walk,
    words: &Words,
    k: usize,
    command: &str,
    targets: usize,
) -> Result<usize, Problem> {
    let mut k = k + 2;
    for left in (0..targets).rev() {
        // `a=1.2, pose=p[…]`
        while words.is_name(k) && words.is_sign(k + 1, b'=') {
            let comma = words.until(k, b",)");
            // Some arguments say how it goes, and not whereto.
            let whereto = !is_one_of(&words.name(k), "a v t r mode gain lookahead_time");
            if whereto || !words.is_sign(comma, b',') {
                k += 2;
                break;
            }
            k = comma + 1;
        }
        k = goal(walk, words, k, command)?;
        let comma = words.is_sign(k, b',');
        if left > 0 && !comma {
            let expected = text!("a comma and the next point of {command}", command);
            return Err(words.problem(k, expected));
        }
        if !comma && !words.is_sign(k, b')') {
            return Err(words.problem(k, crate::text::Text::verbatim("',' ')'")));
        }
        k += usize::from(left > 0);
    }
    Ok(k)
}

/// One target of a move; the word behind it.
fn goal(walk: &mut Walk, words: &Words, k: usize, command: &str) -> Result<usize, Problem> {
    let end = words.until(k, b",)]");
    if end == k {
        return Err(words.problem(k, text!("the target of {command}", command)));
    }
    // `get_inverse_kin(pose, near)`: the pose is the target, and what is near says which solution.
    let inverse = words.name(k) == "get_inverse_kin" && words.is_sign(k + 1, b'(');
    let from = if inverse { k + 2 } else { k };
    let here = literal(words, from)?;
    let behind = match &here {
        Some((.., behind)) => *behind,
        None if inverse => words.until(from, b",)]"),
        None => end,
    };
    if end >= words.len() && here.is_none() {
        return Err(words.problem(end, crate::text::Text::verbatim("')'")));
    }
    let mut near = None;
    if inverse && words.is_sign(behind, b',') {
        // `[…]`, a name with such a list, or either as `qnear=…`.
        let named = words.is_sign(behind + 2, b'=');
        let k = behind + if named { 3 } else { 1 };
        let values = values(walk, words, k, (false, &words.name(k)))?;
        near = Some(values).filter(|values| values.len() == walk.axes.joints());
    }
    let end = if inverse { end } else { behind };
    let follows = words.kind(behind);
    let whole = inverse || matches!(follows, None | Some(Kind::Sign(b',' | b')')));
    match here {
        Some((pose, Some(numbers), _)) if whole => {
            let (at, name) = (words.at(from), format!("target of {command}"));
            let mut target = target(walk.axes, pose, &numbers, at, &name)?;
            if near.is_some() {
                target.posture_mut().near = near;
            }
            walk.go_to(target, &[]);
        }
        Some(_) => {
            let spelled = words.shown(k, end);
            walk.left(words.at(k), not_in_numbers(spelled));
        }
        None => {
            let name = words.is_name(from) && behind == from + 1;
            let range = if name { from..behind } else { k..end };
            walk.go_to_words(words, range, command, near, &[]);
        }
    }
    Ok(end)
}

/// Whether a list is a pose, its numbers (`None` where one is worked out at run time), and the word behind it.
type Literal = (bool, Option<Vec<Number>>, usize);

/// The list that begins at word `k`.
fn literal(words: &Words, k: usize) -> Result<Option<Literal>, Problem> {
    let is_pose = words.bytes(k) == b"p" && words.is_sign(k + 1, b'[');
    let open = k + usize::from(is_pose);
    if !words.is_sign(open, b'[') {
        return Ok(None);
    }
    let (list, end) = words.list(open)?;
    let numbers = list.numbers().filter(|numbers| !numbers.is_empty());
    Ok(Some((is_pose, numbers, end)))
}

fn target(
    axes: &Axes,
    pose: bool,
    numbers: &[Number],
    at: usize,
    name: &str,
) -> Result<Target, Problem> {
    let (count, joints) = (numbers.len(), axes.joints());
    let shape = match *numbers {
        [x, y, z, rx, ry, rz] if pose => Shape::Pose(Box::new(Frame {
            position: [x, y, z],
            mm: [METRE; 3],
            turn: vec![rx, ry, rz],
            orientation: Orientation::RotationVector,
        })),
        _ if pose => {
            let found = text!(one "a list of {count} number", "a list of {count} numbers", count);
            return Err(Problem::new(
                at,
                found,
                crate::text::Text::verbatim("p[x, y, z, rx, ry, rz]"),
            ));
        }
        _ if count == joints => Shape::Joints {
            numbers: numbers.to_vec(),
            scales: vec![1.0; joints].into(),
            decimals: 7,
        },
        _ => {
            let found = text!(one "a list of {count} number", "a list of {count} numbers", count);
            let expected = text!("{joints}, one for each joint of the model", joints);
            return Err(Problem::new(at, found, expected));
        }
    };
    Ok(Target::new(name, at, shape))
}
