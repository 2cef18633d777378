//! KRL (KUKA): `E6AXIS`, `AXIS`, `E6POS` and `POS`, in data lists, assignments and motions.
//!
//! ```text
//! {A1 …, A2 …, …, A6 …, E1 …}                       degrees (mm)
//! {X …, Y …, Z …, A …, B …, C …, S …, T …, E1 …}    mm, degrees: R_z(A) R_y(B) R_x(C)
//! ```
//!
//! `T` has one bit for each axis A1 … A6, set where the axis is below zero. Of `S` the lowest bit is
//! read: the wrist is behind axis 1; what its other bits say differs from arm to arm, and `T` tells the
//! same poses apart. A `FRAME` is no target.

use std::collections::BTreeMap;

use crate::kinematics::configuration::Statement;

use super::axes::{Axes, MOST_OWN, Slot};
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::target::{Mark, Problem, Program, Remark, Shape, Target};
use super::text::Text;
use super::tokens::{Dialect, Kind, Words, words};

const DIALECT: Dialect = Dialect {
    comment: Some(b';'),
    strings: b"\"",
    bits: true,
};

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
    if axes.own() > MOST_OWN {
        return Err(vec![Problem::new(
            0,
            format!("a model with {} axes of its own", axes.own()),
            "at most 6; external axes are called E1 to E6 in the model",
        )]);
    }
    // Line by line: a statement ends with its line.
    let mut lines = Vec::new();
    let mut problems = Vec::new();
    for line in text.lines() {
        if text.bytes[line.clone()]
            .trim_ascii_start()
            .starts_with(b"&")
        {
            continue;
        }
        match words(text, line, DIALECT) {
            Ok(tokens) if tokens.is_empty() => {}
            Ok(tokens) => lines.push(Words { text, tokens }),
            Err(problem) => problems.push(problem),
        }
    }
    let mut reader = Reader {
        axes,
        types: declared_types(&lines),
        program: Program::default(),
        problems,
        by_name: BTreeMap::new(),
        motions: Vec::new(),
        changed: Vec::new(),
    };
    for line in &lines {
        if let Err(problem) = reader.line(line) {
            reader.problems.push(problem);
        }
    }
    if reader.problems.is_empty() {
        Ok(reader.finished())
    } else {
        Err(reader.problems)
    }
}

/// What a name was declared as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Type {
    Axes,
    Pose,
    Frame,
}

fn type_of(name: &str) -> Option<Type> {
    match name {
        "e6axis" | "axis" => Some(Type::Axes),
        "e6pos" | "pos" => Some(Type::Pose),
        "frame" => Some(Type::Frame),
        _ => None,
    }
}

/// Names that the file declares, in small letters.
fn declared_types(lines: &[Words]) -> BTreeMap<String, Type> {
    let mut types = BTreeMap::new();
    for words in lines {
        let mut k = 0;
        while matches!(words.name(k).as_deref(), Some("decl" | "global" | "const")) {
            k += 1;
        }
        let Some(declared) = words.name(k).and_then(|name| type_of(&name)) else {
            continue;
        };
        // E6POS P1, P2[10]
        while let Some(name) = words.name(k + 1) {
            types.insert(name, declared);
            k += 2;
            while words.kind(k).is_some() && !words.is_sign(k, b',') && !words.is_sign(k, b'=') {
                k += 1;
            }
            if !words.is_sign(k, b',') {
                break;
            }
        }
    }
    types
}

/// The components of an aggregate by their names in small letters.
struct Aggregate {
    at: usize,
    components: BTreeMap<String, Component>,
    /// The type that it states itself: `{E6AXIS: A1 …}`.
    stated: Option<Type>,
}

enum Component {
    Number(Number),
    /// A whole number, where it stands, and its digits between quotes (0: decimal).
    Bits(u32, std::ops::Range<usize>, usize),
    RunTime,
}

enum Goal {
    Inline(usize),
    Named(String, String),
}

struct Reader<'x> {
    axes: &'x Axes,
    types: BTreeMap<String, Type>,
    program: Program,
    problems: Vec<Problem>,
    by_name: BTreeMap<String, Vec<usize>>,
    motions: Vec<(usize, Goal)>,
    changed: Vec<(String, usize)>,
}

impl Reader<'_> {
    fn line(&mut self, words: &Words) -> Result<(), Problem> {
        let mut k = 0;
        while k < words.tokens.len() {
            if let Some(name) = words.name(k)
                && is_motion(&name)
                && k == 0
            {
                return self.motion(words, &name);
            }
            if words.is_sign(k, b'=') && !words.is_sign(k + 1, b'=') && k > 0 {
                return self.assignment(words, k);
            }
            k += 1;
        }
        Ok(())
    }

    /// `XP1 = {…}`, `DECL E6POS XP1={…}`, `XP1.X = …`, `P[3]={…}`
    fn assignment(&mut self, words: &Words, equals: usize) -> Result<(), Problem> {
        // The name in front, an index and components between.
        let mut k = equals - 1;
        let mut component = false;
        if words.is_sign(k, b']') {
            while k > 0 && !words.is_sign(k, b'[') {
                k -= 1;
            }
            k = k.saturating_sub(1);
        }
        while k >= 2 && words.is_sign(k - 1, b'.') {
            component = true;
            k -= 2;
        }
        let Some(name) = words.name(k) else {
            return Ok(());
        };
        let at = words.at(k);
        let spelled = words.text.shown(at..words.tokens[equals - 1].range.end);
        if name == "$base" || name == "$tool" {
            self.program.notes.push(Remark {
                at,
                says: format!(
                    "{spelled} is set here; poses are read in the stated frame, of the model's tool"
                ),
            });
        }
        if !words.is_sign(equals + 1, b'{') {
            self.changed.push((name, at));
            return Ok(());
        }
        if component || name.starts_with('$') {
            // Checked, since what is broken there keeps the file from being loaded.
            aggregate(words, equals + 1)?;
            self.changed.push((name, at));
            return Ok(());
        }
        let (aggregate, _) = aggregate(words, equals + 1)?;
        let declared = self.types.get(&name).copied().or(aggregate.stated);
        if let Some(index) = self.aggregate_target(&aggregate, &spelled, declared)? {
            self.by_name.entry(name).or_default().push(index);
        }
        Ok(())
    }

    fn motion(&mut self, words: &Words, name: &str) -> Result<(), Problem> {
        let command = words.spelled(0);
        let at = words.at(1);
        if name.ends_with("_rel") {
            self.run_time(
                at,
                format!("{command} moves by a way from where the robot is"),
            );
            return Ok(());
        }
        let mut wanted = if name.contains("circ") { 2 } else { 1 };
        let mut k = 1;
        while wanted > 0 && k < words.tokens.len() {
            wanted -= 1;
            let at = words.at(k);
            if words.is_sign(k, b'{') {
                let (aggregate, end) = aggregate(words, k)?;
                k = end;
                if self.is_composed(words, k, at, &command) {
                    return Ok(());
                }
                let spelled = format!("target of {command}");
                let declared = aggregate.stated.or(Some(kind_of(&aggregate)));
                if let Some(index) = self.aggregate_target(&aggregate, &spelled, declared)? {
                    self.motions.push((at, Goal::Inline(index)));
                }
            } else if let Some(goal) = words.name(k) {
                let spelled = words.spelled(k);
                k += 1;
                if words.is_sign(k, b'[') || words.is_sign(k, b'.') || words.is_sign(k, b'(') {
                    let says = format!(
                        "{command} goes to an element of {spelled}, which is chosen at run time"
                    );
                    self.run_time(at, says);
                    return Ok(());
                }
                if self.is_composed(words, k, at, &command) {
                    return Ok(());
                }
                self.motions.push((at, Goal::Named(goal, spelled)));
            } else {
                let found = found(words, k);
                return Err(Problem::new(at, found, format!("the target of {command}")));
            }
            if wanted > 0 {
                if !words.is_sign(k, b',') {
                    let found = found(words, k);
                    let expected = format!(", and the end point of {command}");
                    return Err(Problem::new(words.at(k), found, expected));
                }
                k += 1;
            }
        }
        if words.tokens.len() == 1 {
            let found = "nothing".to_owned();
            return Err(Problem::new(at, found, format!("the target of {command}")));
        }
        Ok(())
    }

    /// Whether a target is multiplied by another frame: `XP1:XOFFSET`.
    fn is_composed(&mut self, words: &Words, k: usize, at: usize, command: &str) -> bool {
        let composed = words.is_sign(k, b':');
        if composed {
            let says =
                format!("{command} goes to a product of frames, which is worked out at run time");
            self.run_time(at, says);
        }
        composed
    }

    fn run_time(&mut self, at: usize, says: String) {
        self.program.at_run_time.push(Remark { at, says });
    }

    /// Keeps the target of an aggregate, if it is one.
    fn aggregate_target(
        &mut self,
        aggregate: &Aggregate,
        name: &str,
        declared: Option<Type>,
    ) -> Result<Option<usize>, Problem> {
        let has = |key: &str| aggregate.components.contains_key(key);
        let looks = if has("s") || has("t") {
            Some(Type::Pose)
        } else if has("a1") {
            Some(Type::Axes)
        } else {
            None
        };
        let target = match declared.or(looks) {
            Some(Type::Axes) => self.axis_target(aggregate, name)?,
            Some(Type::Pose) => self.pose_target(aggregate, name)?,
            Some(Type::Frame) | None => return Ok(None),
        };
        let Some(target) = target else {
            let says = format!(
                "{name} takes some of its components from where the robot is, or works them out at run time"
            );
            self.run_time(aggregate.at, says);
            return Ok(None);
        };
        self.program.targets.push(target);
        Ok(Some(self.program.targets.len() - 1))
    }

    fn axis_target(&self, aggregate: &Aggregate, name: &str) -> Result<Option<Target>, Problem> {
        aggregate.only(name, "an axis", &["a1", "a2", "a3", "a4", "a5", "a6"])?;
        let mut numbers = Vec::new();
        for joint in 0..self.axes.joints() {
            match aggregate.components.get(&axis_name(self.axes.slot(joint))) {
                Some(Component::Number(number)) => numbers.push(number.clone()),
                _ => return Ok(None),
            }
        }
        let shape = Shape::Joints {
            numbers,
            inner: self.axes.inner_of_degrees(),
            decimals: 5,
        };
        Ok(Some(Target::new(name, aggregate.at, shape)))
    }

    fn pose_target(&self, aggregate: &Aggregate, name: &str) -> Result<Option<Target>, Problem> {
        let keys = ["x", "y", "z", "a", "b", "c", "s", "t"];
        aggregate.only(name, "a pose", &keys)?;
        let mut numbers = Vec::new();
        for key in &keys[..6] {
            match aggregate.components.get(*key) {
                Some(Component::Number(number)) => numbers.push(number.clone()),
                _ => return Ok(None),
            }
        }
        let frame = Frame {
            position: [0, 1, 2].map(|k: usize| numbers[k].clone()),
            mm: [1.0; 3],
            turn: numbers[3..].to_vec(),
            orientation: Orientation::ZyxDegrees,
        };
        let mut target = Target::new(name, aggregate.at, Shape::Pose(frame));
        for joint in 0..self.axes.joints() {
            if let Slot::External(_) = self.axes.slot(joint) {
                let key = axis_name(self.axes.slot(joint));
                let Some(Component::Number(number)) = aggregate.components.get(&key) else {
                    return Ok(None);
                };
                let inner = self.axes.kind(joint).inner(number.value);
                target.external.push((joint, inner));
            }
        }
        if let Some((value, range, binary_digits)) = aggregate.whole("t", name)? {
            let joints: Vec<_> = (0..MOST_OWN)
                .map(|k| self.axes.joint(Slot::Own(k)))
                .collect();
            for (bit, joint) in joints.iter().enumerate() {
                if let Some(joint) = *joint {
                    let negative = value >> bit & 1 != 0;
                    target
                        .configuration
                        .push(Statement::Negative { joint, negative });
                }
            }
            target.marks.push(Mark::Signs {
                range,
                joints,
                value,
                binary_digits,
            });
        }
        if let Some((value, ..)) = aggregate.whole("s", name)? {
            target.configuration.push(Statement::Behind(value & 1 != 0));
        }
        Ok(Some(target))
    }

    fn finished(mut self) -> Program {
        for (at, goal) in self.motions {
            match goal {
                Goal::Inline(index) => self.program.visits.push(index),
                Goal::Named(name, spelled) => match self.by_name.get(&name).map(Vec::as_slice) {
                    Some([index]) => self.program.visits.push(*index),
                    Some(_) => {}
                    None => self.program.at_run_time.push(Remark {
                        at,
                        says: format!("{spelled} has its values elsewhere"),
                    }),
                },
            }
        }
        for (name, at) in self.changed {
            if self.by_name.contains_key(&name) {
                let says = format!("{} is changed at run time", name.to_uppercase());
                self.program.at_run_time.push(Remark { at, says });
            }
        }
        self.program
    }
}

impl Aggregate {
    /// Refuses components that do not belong to it; external axes belong to everything.
    fn only(&self, name: &str, what: &str, keys: &[&str]) -> Result<(), Problem> {
        let external = ["e1", "e2", "e3", "e4", "e5", "e6"];
        for (key, component) in &self.components {
            if !keys.contains(&key.as_str()) && !external.contains(&key.as_str()) {
                let at = match component {
                    Component::Number(number) => number.range.start,
                    Component::Bits(_, range, _) => range.start,
                    Component::RunTime => self.at,
                };
                let found = format!("component {} in {name}", key.to_uppercase());
                let expected = format!("a component of {what}: {}", keys.join(", ").to_uppercase());
                return Err(Problem::new(at, found, expected));
            }
        }
        Ok(())
    }

    /// S or T: a whole number, decimal or in bits.
    fn whole(
        &self,
        key: &str,
        name: &str,
    ) -> Result<Option<(u32, std::ops::Range<usize>, usize)>, Problem> {
        match self.components.get(key) {
            Some(Component::Bits(value, range, digits)) => {
                Ok(Some((*value, range.clone(), *digits)))
            }
            Some(Component::Number(number)) => {
                let value = number.value;
                if !(0.0..=255.0).contains(&value) || value.fract() != 0.0 {
                    let found = format!("{} {value} in {name}", key.to_uppercase());
                    return Err(Problem::new(
                        number.range.start,
                        found,
                        "a whole number from 0 to 255",
                    ));
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a whole number up to 255"
                )]
                let whole = value as u32;
                Ok(Some((whole, number.range.clone(), 0)))
            }
            _ => Ok(None),
        }
    }
}

fn axis_name(slot: Slot) -> String {
    match slot {
        Slot::Own(k) => format!("a{}", k + 1),
        Slot::External(k) => format!("e{}", k + 1),
    }
}

fn kind_of(aggregate: &Aggregate) -> Type {
    let axes = aggregate.components.keys().any(|key| {
        let mut letters = key.bytes();
        letters.next() == Some(b'a') && letters.next().is_some()
    });
    if axes { Type::Axes } else { Type::Pose }
}

/// The aggregate that begins at word `k`, and the word behind it.
fn aggregate(words: &Words, k: usize) -> Result<(Aggregate, usize), Problem> {
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
            let found = found(words, k);
            return Err(Problem::new(words.at(k), found, "the name of a component"));
        };
        let key_at = words.at(k);
        let (component, end) = component(words, k + 1)?;
        if aggregate
            .components
            .insert(key.clone(), component)
            .is_some()
        {
            let found = format!("{} a second time", key.to_uppercase());
            return Err(Problem::new(key_at, found, "every component once"));
        }
        match words.kind(end) {
            Some(Kind::Sign(b',')) => k = end + 1,
            Some(Kind::Sign(b'}')) => return Ok((aggregate, end + 1)),
            _ => {
                let found = found(words, end);
                return Err(Problem::new(words.at(end), found, ", or }"));
            }
        }
    }
}

fn component(words: &Words, k: usize) -> Result<(Component, usize), Problem> {
    if let Some(read) = words.number(k) {
        let (number, end) = read?;
        match words.kind(end) {
            Some(Kind::Sign(b'+' | b'-' | b'*' | b'/')) => {}
            _ => return Ok((Component::Number(number), end)),
        }
    } else if words.kind(k) == Some(Kind::Bits) {
        return bits(words, k);
    }
    let mut end = k;
    let mut depth = 0_usize;
    while let Some(kind) = words.kind(end) {
        match kind {
            Kind::Sign(b',' | b'}') if depth == 0 => break,
            Kind::Sign(b'{' | b'[' | b'(') => depth += 1,
            Kind::Sign(b'}' | b']' | b')') => depth = depth.saturating_sub(1),
            _ => {}
        }
        end += 1;
    }
    if end == k {
        let found = found(words, k);
        return Err(Problem::new(words.at(k), found, "a value"));
    }
    Ok((Component::RunTime, end))
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
            let range = words.tokens[k].range.clone();
            let binary = if base == 2 { digits.len() } else { 0 };
            Ok((Component::Bits(value, range, binary), k + 1))
        }
        _ => {
            let expected = "a binary number such as 'B010'";
            Err(Problem::new(words.at(k), spelled, expected))
        }
    }
}

fn found(words: &Words, k: usize) -> String {
    if k < words.tokens.len() {
        format!("'{}'", words.spelled(k))
    } else {
        "the end of the line".to_owned()
    }
}

fn is_motion(name: &str) -> bool {
    const MOTIONS: [&str; 14] = [
        "ptp",
        "lin",
        "circ",
        "sptp",
        "slin",
        "scirc",
        "spl",
        "ptp_rel",
        "lin_rel",
        "circ_rel",
        "sptp_rel",
        "slin_rel",
        "scirc_rel",
        "spl_rel",
    ];
    MOTIONS.contains(&name)
}
