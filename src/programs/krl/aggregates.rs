//! Aggregates of KRL, `{X 1, Y 2, …}`: their components, and what they are.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::kinematics::Pose;

use super::super::axes::Slot;
use super::super::number::Number;
use super::super::pose::{Frame, Orientation};
use super::super::target::Problem;
use super::super::tokens::{Kind, Value, Words};

/// What a name was declared as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    Axes,
    Pose,
    Frame,
}

pub(super) fn type_of(name: &str) -> Option<Type> {
    match name {
        "e6axis" | "axis" => Some(Type::Axes),
        "e6pos" | "pos" => Some(Type::Pose),
        "frame" => Some(Type::Frame),
        _ => None,
    }
}

/// The components of an aggregate by their names in small letters.
pub(super) struct Aggregate {
    pub(super) at: usize,
    pub(super) components: BTreeMap<String, Component>,
    /// The type that it states itself: `{E6AXIS: A1 …}`.
    pub(super) stated: Option<Type>,
}

pub(super) enum Component {
    Number(Number),
    /// A whole number, where it stands, and its digits between quotes (0: decimal).
    Bits(u32, Range<usize>, usize),
    RunTime,
}

impl Aggregate {
    pub(super) fn number(&self, key: &str) -> Option<Number> {
        match self.components.get(key) {
            Some(Component::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// X, Y, Z, A, B, C as a pose.
    pub(super) fn pose(&self) -> Option<Pose> {
        let numbers: Option<Vec<Number>> = ["x", "y", "z", "a", "b", "c"]
            .iter()
            .map(|k| self.number(k))
            .collect();
        Frame::of_degrees(&numbers?, Orientation::ZyxDegrees)?.pose()
    }

    /// Refuses components that do not belong to it; external axes belong to everything.
    pub(super) fn only(&self, name: &str, keys: &[&str]) -> Result<(), Problem> {
        let external = ["e1", "e2", "e3", "e4", "e5", "e6"];
        for (key, component) in &self.components {
            if !keys.contains(&key.as_str()) && !external.contains(&key.as_str()) {
                let at = match component {
                    Component::Number(number) => number.range().start,
                    Component::Bits(_, range, _) => range.start,
                    Component::RunTime => self.at,
                };
                let found = text!(
                    "component {component} in {name}",
                    component = key.to_uppercase(),
                    name
                );
                let expected = text!("one of {names}", names = keys.join(", ").to_uppercase());
                return Err(Problem::new(at, found, expected));
            }
        }
        Ok(())
    }

    /// S or T: a whole number, decimal or in bits.
    pub(super) fn whole(
        &self,
        key: &str,
        name: &str,
    ) -> Result<Option<(u32, Range<usize>, usize)>, Problem> {
        match self.components.get(key) {
            Some(Component::Bits(value, range, digits)) => {
                Ok(Some((*value, range.clone(), *digits)))
            }
            Some(Component::Number(number)) => {
                let value = number.value;
                if !(0.0..=255.0).contains(&value) || value.fract() != 0.0 {
                    let found = text!(
                        "{component} {value} in {name}",
                        component = key.to_uppercase(),
                        value,
                        name
                    );
                    return Err(Problem::new(
                        number.range().start,
                        found,
                        text!("a whole number from 0 to 255"),
                    ));
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a whole number up to 255"
                )]
                let whole = value as u32;
                Ok(Some((whole, number.range(), 0)))
            }
            _ => Ok(None),
        }
    }
}

pub(super) fn axis_name(slot: Slot) -> String {
    match slot {
        Slot::Own(k) => format!("a{}", k + 1),
        Slot::External(k) => format!("e{}", k + 1),
    }
}

pub(super) fn kind_of(aggregate: &Aggregate) -> Type {
    let axes = aggregate.components.keys().any(|key| {
        let mut letters = key.bytes();
        letters.next() == Some(b'a') && letters.next().is_some()
    });
    if axes { Type::Axes } else { Type::Pose }
}

/// The aggregate that begins at word `k`, and the word behind it.
pub(super) fn aggregate(words: &Words, k: usize) -> Result<(Aggregate, usize), Problem> {
    let at = words.at(k);
    let mut aggregate = Aggregate {
        at,
        components: BTreeMap::new(),
        stated: None,
    };
    let mut k = k + 1;
    if words.is_sign(k + 1, b':') {
        aggregate.stated = words.name(k).and_then(|name| type_of(&name));
        k += 2;
    }
    loop {
        let Some(key) = words.name(k) else {
            return Err(words.problem(k, text!("the name of a component")));
        };
        let key_at = words.at(k);
        let (component, end) = component(words, k + 1)?;
        if aggregate
            .components
            .insert(key.clone(), component)
            .is_some()
        {
            let found = text!("{component} a second time", component = key.to_uppercase());
            return Err(Problem::new(key_at, found, text!("every component once")));
        }
        match words.kind(end) {
            Some(Kind::Sign(b',')) => k = end + 1,
            Some(Kind::Sign(b'}')) => return Ok((aggregate, end + 1)),
            _ => return Err(words.problem(end, text!("a comma or }"))),
        }
    }
}

fn component(words: &Words, k: usize) -> Result<(Component, usize), Problem> {
    if words.kind(k) == Some(Kind::Bits) {
        return bits(words, k);
    }
    Ok(match words.value(k, b",}", phrase!("a value"))? {
        (Value::Number(number), end) => (Component::Number(number), end),
        (Value::RunTime(_), end) => (Component::RunTime, end),
    })
}

/// `'B010'` or `'H1F'`.
fn bits(words: &Words, k: usize) -> Result<(Component, usize), Problem> {
    let spelled = words.spelled(k);
    let inside = spelled.trim_matches('\'');
    let (base, digits) = match inside.as_bytes().first() {
        Some(b'B' | b'b') => (2, &inside[1..]),
        Some(b'H' | b'h') => (16, &inside[1..]),
        _ => (10, inside),
    };
    match u32::from_str_radix(digits, base) {
        Ok(value) if value <= 255 => {
            let range = words.range(k).unwrap_or_default();
            let binary = if base == 2 { digits.len() } else { 0 };
            Ok((Component::Bits(value, range, binary), k + 1))
        }
        _ => {
            let expected = text!("a binary number such as 'B010'");
            Err(Problem::new(
                words.at(k),
                crate::text::Text::verbatim(spelled),
                expected,
            ))
        }
    }
}
