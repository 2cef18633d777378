//! Lists in brackets: targets, tools and work objects of RAPID, as they are written.

use crate::kinematics::configuration::Statement;
use crate::kinematics::{Pose, pose_from_parts};

use super::super::axes::{Axes, Slot};
use super::super::number::Number;
use super::super::pose::{Frame, Orientation};
use super::super::target::{Mark, Problem, Shape, Target};
use super::super::tokens::{Kind, Value, Words};

/// An external axis from here on is none.
const NOT_THERE: f64 = 8.9e9;

/// Lists in lists that a target or an array of targets needs, and some more.
const DEEPEST: usize = 16;

/// A list in brackets, as it was written.
pub(super) enum Tree {
    List(Vec<Tree>, usize),
    Number(Number),
    /// Something else, and its first word: a name, or what is worked out at run time.
    Other(usize),
}

impl Tree {
    pub(super) fn list(&self) -> Option<&[Tree]> {
        match self {
            Self::List(elements, _) => Some(elements),
            _ => None,
        }
    }
}

/// Reads the lists of a module.
#[derive(Clone, Copy)]
pub(super) struct Lists<'r, 't, 'a> {
    pub(super) words: &'r Words<'t, 'a>,
    pub(super) axes: &'r Axes,
}

impl Lists<'_, '_, '_> {
    /// The list that begins at word `k`, and the word behind it.
    pub(super) fn list(&self, k: usize, depth: usize) -> Result<(Tree, usize), Problem> {
        let at = self.words.at(k);
        if depth > DEEPEST {
            return Err(Problem::new(
                at,
                text!("brackets in brackets"),
                text!("at most 16 deep"),
            ));
        }
        let mut elements = Vec::new();
        let mut k = k + 1;
        if self.words.is_sign(k, b']') {
            return Ok((Tree::List(elements, at), k + 1));
        }
        loop {
            let (element, end) = if self.words.is_sign(k, b'[') {
                self.list(k, depth + 1)?
            } else {
                match self.words.value(k, b",];", phrase!("a number"))? {
                    (Value::Number(number), end) => (Tree::Number(number), end),
                    (Value::RunTime(k), end) => (Tree::Other(k), end),
                }
            };
            elements.push(element);
            match self.words.kind(end) {
                Some(Kind::Sign(b',')) => k = end + 1,
                Some(Kind::Sign(b']')) => return Ok((Tree::List(elements, at), end + 1)),
                None | Some(Kind::Sign(b';')) => {
                    let found = text!("{end} in a list", end = self.words.found(end));
                    return Err(Problem::new(
                        self.words.at(end),
                        found,
                        text!("a closing ] at its end"),
                    ));
                }
                Some(_) => return Err(self.words.problem(end, text!("a comma or ]"))),
            }
        }
    }

    /// The pose of a tool on the flange, or of a work object in the base; in words why there is none.
    pub(super) fn held(
        &self,
        tree: &Tree,
        spelled: &str,
        tool: bool,
    ) -> Result<Pose, crate::text::Text> {
        let is = |tree: &Tree, value: &str| match tree {
            Tree::Other(k) => self.words.name(*k).as_deref() == Some(value),
            _ => false,
        };
        match tree.list() {
            Some([hold, frame, ..]) if tool => {
                if !is(hold, "true") {
                    return Err(text!("{spelled} does not sit on the robot", spelled));
                }
                pose_of(frame)
            }
            Some([hold, fixed, _, user, object]) if !tool => {
                if !is(hold, "false") || !is(fixed, "true") {
                    return Err(text!(
                        "{spelled} is moved by the robot or by another unit",
                        spelled
                    ));
                }
                pose_of(user).zip(pose_of(object)).map(|(u, o)| u * o)
            }
            _ => None,
        }
        .ok_or_else(|| text!("{spelled} is not written out in numbers", spelled))
    }

    /// A target of a list; `None` where a part of it is worked out at run time. `pose`: what it has
    /// to be; without, anything that is no target is `Ok(None)`.
    pub(super) fn target(
        &self,
        tree: &Tree,
        name: &str,
        pose: Option<bool>,
    ) -> Result<Option<Target>, Problem> {
        let Tree::List(parts, at) = tree else {
            return Ok(None);
        };
        let (sizes, expected): (&[usize], _) = if pose.unwrap_or(parts.len() == 4) {
            (
                &[3, 4, 4, 6],
                text!(
                    "a robtarget: [[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [eax_a … eax_f]]"
                ),
            )
        } else {
            (
                &[6, 6],
                text!("a jointtarget: [[rax_1 … rax_6], [eax_a … eax_f]]"),
            )
        };
        if parts.len() != sizes.len() {
            let found = text!(one "{count} part in {name}", "{count} parts in {name}", count = parts.len(), name);
            return Err(Problem::new(*at, found, expected));
        }
        let mut numbers: Vec<Vec<Number>> = Vec::new();
        for (part, size) in parts.iter().zip(sizes) {
            let (elements, at) = match part {
                Tree::List(elements, at) => (elements, *at),
                Tree::Number(number) => {
                    let found = text!("a number in {name}", name);
                    return Err(Problem::new(number.range().start, found, expected));
                }
                Tree::Other(_) => return Ok(None),
            };
            if elements.len() != *size {
                let found = text!(
                    one "{count} number in {name}", "{count} numbers in {name}",
                    count = elements.len(),
                    name
                );
                return Err(Problem::new(
                    at,
                    found,
                    text!("{size}, as in {expected}", size, expected),
                ));
            }
            let mut own = Vec::new();
            for element in elements {
                match element {
                    Tree::Number(number) => own.push(*number),
                    Tree::List(_, at) => {
                        let expected = text!("a number, as in {expected}", expected);
                        return Err(Problem::new(*at, text!("a list in {name}", name), expected));
                    }
                    Tree::Other(_) => return Ok(None),
                }
            }
            numbers.push(own);
        }
        if numbers.len() == 4 {
            self.robtarget(&numbers, name, *at).map(Some)
        } else {
            let target = self.axes.joint_target(name, *at, |slot| match slot {
                Slot::Own(k) => Ok(numbers[0][k]),
                Slot::External(k) => external_axis(&numbers[1][k], name).cloned(),
            });
            target.map(Some)
        }
    }

    fn robtarget(&self, parts: &[Vec<Number>], name: &str, at: usize) -> Result<Target, Problem> {
        let [position, turn, configuration, external] = parts else {
            return Err(Problem::new(
                at,
                text!("a part is missing"),
                text!("a robtarget"),
            ));
        };
        let whole = |number: &Number| {
            #[allow(clippy::cast_possible_truncation, reason = "compared with itself")]
            let whole = number.value as i16;
            if f64::from(whole) == number.value && whole.abs() < 1000 {
                Ok(whole)
            } else {
                let found = text!(
                    "{value} in the configuration of {name}",
                    value = number.value,
                    name
                );
                Err(Problem::new(
                    number.range().start,
                    found,
                    text!("a whole number"),
                ))
            }
        };
        let frame = Frame {
            position: [0, 1, 2].map(|k: usize| position[k]),
            mm: [1.0; 3],
            turn: turn.clone(),
            orientation: Orientation::Quaternion,
        };
        if frame.goal().is_none() {
            let found = text!("a quaternion of no length in {name}", name);
            return Err(Problem::new(
                turn[0].range().start,
                found,
                text!("an orientation"),
            ));
        }
        let mut target = Target::new(name, at, Shape::Pose(Box::new(frame)));
        for (number, axis) in configuration.iter().zip([0, 3, 5]) {
            let quadrant = whole(number)?;
            let Some(joint) = self.axes.numbered(Slot::Own(axis)) else {
                continue;
            };
            target
                .posture_mut()
                .configuration
                .push(Statement::Quadrant { joint, quadrant });
            target.posture_mut().marks.push(Mark::Quadrant {
                span: number.span(),
                joint,
            });
        }
        let cfx = whole(&configuration[3])?;
        if (0..8).contains(&cfx) && self.axes.own() == 6 {
            if let Some(joint) = self.axes.numbered(Slot::Own(4)) {
                let negative = cfx & 1 != 0;
                target
                    .posture_mut()
                    .configuration
                    .push(Statement::WristNegative { joint, negative });
            }
            target
                .posture_mut()
                .configuration
                .push(Statement::ElbowTurned(cfx & 2 != 0));
            target
                .posture_mut()
                .configuration
                .push(Statement::Behind(cfx & 4 != 0));
        }
        target.posture_mut().external = self.axes.external(|slot| match slot {
            Slot::Own(k) | Slot::External(k) => external_axis(&external[k], name).cloned(),
        })?;
        Ok(target)
    }
}

/// `[[x, y, z], [q1, q2, q3, q4]]`
fn pose_of(tree: &Tree) -> Option<Pose> {
    let numbers = |tree: &Tree| -> Option<Vec<f64>> {
        let value = |tree: &Tree| match tree {
            Tree::Number(number) => Some(number.value),
            _ => None,
        };
        tree.list()?.iter().map(value).collect()
    };
    let [at, turn] = tree.list()? else {
        return None;
    };
    let at: [f64; 3] = numbers(at)?.try_into().ok()?;
    let turn: [f64; 4] = numbers(turn)?.try_into().ok()?;
    pose_from_parts(at, turn).ok()
}

/// The mass of `[mass, [centre], [axes], ix, iy, iz]`, kg.
pub(super) fn mass(load: Option<&Tree>) -> Option<f64> {
    match load?.list()?.first()? {
        Tree::Number(number) => Some(number.value),
        _ => None,
    }
}

/// The value of an external axis that the model has.
fn external_axis<'n>(number: &'n Number, name: &str) -> Result<&'n Number, Problem> {
    if number.value.abs() < NOT_THERE {
        return Ok(number);
    }
    let found = text!("{name} leaves an external axis out", name);
    let expected = text!("its value: the model has that axis");
    Err(Problem::new(number.range().start, found, expected))
}

/// Whether an element of an array of targets is an array again.
pub(super) fn is_array(tree: &Tree, pose: bool) -> bool {
    let Tree::List(parts, _) = tree else {
        return false;
    };
    let Some(Tree::List(first, _)) = parts.first() else {
        return false;
    };
    let of_target = if pose { 4 } else { 2 };
    parts.len() != of_target && matches!(first.first(), Some(Tree::List(..)))
}
