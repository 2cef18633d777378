//! Lists and poses of `URScript` that are written out: `[q1, …]`, `p[x, y, z, rx, ry, rz]`.

use std::collections::BTreeMap;

use super::super::number::Number;
use super::super::pose::{Frame, Orientation};
use super::super::target::Problem;
use super::super::tokens::{Kind, Value, Words};

/// mm in a metre.
const METRE: f64 = 1000.0;

#[derive(Clone)]
pub(super) enum Literal {
    Pose(Vec<Number>),
    List(Vec<Number>),
    /// A list of which an element is worked out at run time.
    RunTime,
}

/// The literal that begins at word `k`, and the word behind it.
pub(super) fn literal(words: &Words, k: usize) -> Result<Option<(Literal, usize)>, Problem> {
    let is_pose = words.bytes(k) == b"p" && words.is_sign(k + 1, b'[');
    let open = k + usize::from(is_pose);
    if !words.is_sign(open, b'[') {
        return Ok(None);
    }
    let mut numbers = Vec::new();
    let mut run_time = false;
    let mut k = open + 1;
    loop {
        // An empty list is a list of nothing.
        let empty = words.is_sign(k, b']') && k == open + 1;
        let end = if empty {
            run_time = true;
            k
        } else {
            let (value, end) = words.value(k, b",)]", phrase!("a number"))?;
            match value {
                Value::Number(number) => numbers.push(number),
                Value::RunTime(_) => run_time = true,
            }
            end
        };
        match words.kind(end) {
            Some(Kind::Sign(b',')) => k = end + 1,
            Some(Kind::Sign(b']')) => {
                let literal = match (run_time, is_pose) {
                    (true, _) => Literal::RunTime,
                    (false, true) => Literal::Pose(numbers),
                    (false, false) => Literal::List(numbers),
                };
                return Ok(Some((literal, end + 1)));
            }
            _ => return Err(words.problem(end, text!("a comma or ]"))),
        }
    }
}

/// x, y, z in m and a rotation vector in rad; `None` of another count.
pub(super) fn frame_of(numbers: &[Number]) -> Option<Frame> {
    let [x, y, z, rx, ry, rz] = numbers else {
        return None;
    };
    Some(Frame {
        position: [*x, *y, *z],
        mm: [METRE; 3],
        turn: vec![*rx, *ry, *rz],
        orientation: Orientation::RotationVector,
    })
}

/// Names with the literals that are given to them: the word where each begins.
pub(super) type Assigned = BTreeMap<String, Vec<(usize, Literal)>>;

/// What names are given: `global p1 = p[…]`.
pub(super) fn assigned(words: &Words, problems: &mut Vec<Problem>) -> Assigned {
    let mut assigned = Assigned::new();
    for k in 0..words.len() {
        let is_name = words.kind(k) == Some(Kind::Name);
        let given = words.is_sign(k + 1, b'=') && !words.is_sign(k + 2, b'=');
        let inside = k > 0 && (words.is_sign(k - 1, b'(') || words.is_sign(k - 1, b','));
        if !is_name || !given || inside {
            continue;
        }
        match literal(words, k + 2) {
            Ok(Some((literal, _))) => {
                let name = words.spelled(k);
                assigned.entry(name).or_default().push((k, literal));
            }
            Ok(None) => {}
            Err(problem) => problems.push(problem),
        }
    }
    assigned
}
