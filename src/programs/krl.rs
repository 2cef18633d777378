//! KRL (KUKA): `E6AXIS`, `AXIS`, `E6POS` and `POS`, in data lists, assignments and motions.
//!
//! ```text
//! {A1 …, A2 …, …, A6 …, E1 …}                       degrees (mm)
//! {X …, Y …, Z …, A …, B …, C …, S …, T …, E1 …}    mm, degrees: R_z(A) R_y(B) R_x(C)
//! ```
//!
//! `T` has one bit for each axis A1 … A6, set where the axis is below zero. Of `S` the lowest bit is
//! read: the wrist is behind axis 1; what its other bits say differs from arm to arm, and `T` tells the
//! same poses apart. A `FRAME` is no target. `$BASE` and `$TOOL` hold from where they are set to the end
//! of the routine (`held`).

mod active_frames;
mod aggregates;

use std::collections::BTreeMap;

use crate::kinematics::configuration::Statement;

use super::axes::Axes;
use super::moves::{Goal, Moves};
use super::number::Number;
use super::pose::{Frame, Orientation};
use super::program::Program;
use super::target::{Mark, Problem, Remark, Shape, Signs, Target};
use super::text::Text;
use super::tokens::{Dialect, Source, Words};

use active_frames::ActiveFrames;
use aggregates::{Aggregate, Type, aggregate, axis_name, kind_of, type_of};

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
    axes.check_own("E1 to E6")?;
    // Line by line: a statement ends with its line.
    let source = Source::new(text, DIALECT, phrase!("the end of the line"));
    let mut lines = Vec::new();
    let mut problems = Vec::new();
    for line in text.lines() {
        if text.bytes[line.clone()]
            .trim_ascii_start()
            .starts_with(b"&")
        {
            continue;
        }
        match source.words(line) {
            Ok(words) if words.len() == 0 => {}
            Ok(words) => lines.push(words),
            Err(problem) => problems.push(problem),
        }
    }
    let mut program = Program::default();
    let held = ActiveFrames::of(&lines, &mut program);
    let mut reader = KrlReader {
        axes,
        types: declared_types(&lines),
        program,
        moves: Moves::default(),
        held: ActiveFrames::default(),
    };
    for (line, held) in lines.iter().zip(held) {
        reader.held = held;
        if let Err(problem) = reader.line(line) {
            problems.push(problem);
        }
    }
    if problems.is_empty() {
        Ok(reader.moves.finish(reader.program, |spelled| {
            text!("{spelled} has its values elsewhere", spelled)
        }))
    } else {
        Err(problems)
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

struct KrlReader<'x> {
    axes: &'x Axes,
    types: BTreeMap<String, Type>,
    program: Program,
    moves: Moves,
    /// Base and tool at the line that is read.
    held: ActiveFrames,
}

impl KrlReader<'_> {
    fn line(&mut self, words: &Words) -> Result<(), Problem> {
        let mut k = 0;
        while k < words.len() {
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
        let (at, spelled) = (words.at(k), words.shown(k, equals));
        if !words.is_sign(equals + 1, b'{') {
            self.moves.changed(words.spelled(k), at);
            return Ok(());
        }
        // Checked in any case, since what is broken there keeps the file from being loaded.
        let (aggregate, _) = aggregate(words, equals + 1)?;
        if component || name.starts_with('$') {
            self.moves.changed(words.spelled(k), at);
            return Ok(());
        }
        let declared = self.types.get(&name).copied().or(aggregate.stated);
        self.aggregate_target(&aggregate, &spelled, Some(&name), declared)?;
        Ok(())
    }

    fn go(&mut self, at: usize, goal: Goal) {
        let ActiveFrames { base, tool } = self.held.clone();
        self.moves.push(&mut self.program, at, goal, &base, &tool);
    }

    fn motion(&mut self, words: &Words, name: &str) -> Result<(), Problem> {
        let command = words.spelled(0);
        let at = words.at(1);
        if name.ends_with("_rel") {
            self.run_time(at, text!("{command} is a relative motion", command));
            return Ok(());
        }
        let mut wanted = if name.contains("circ") { 2 } else { 1 };
        let mut k = 1;
        while wanted > 0 && k < words.len() {
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
                if let Some(index) = self.aggregate_target(&aggregate, &spelled, None, declared)? {
                    self.go(at, Goal::Inline(index));
                }
            } else if let Some(goal) = words.name(k) {
                let spelled = words.spelled(k);
                k += 1;
                if words.is_sign(k, b'[') || words.is_sign(k, b'.') || words.is_sign(k, b'(') {
                    let says = text!(
                        "{command} goes to an element of {spelled}, which is chosen at run time",
                        command,
                        spelled
                    );
                    self.run_time(at, says);
                    self.go(at, Goal::Mentioned(goal));
                    return Ok(());
                }
                if self.is_composed(words, k, at, &command) {
                    self.go(at, Goal::Mentioned(goal));
                    return Ok(());
                }
                self.go(at, Goal::Named(goal, spelled));
            } else {
                return Err(words.problem(k, text!("the target of {command}", command)));
            }
            if wanted > 0 {
                if !words.is_sign(k, b',') {
                    return Err(
                        words.problem(k, text!("a comma and the end point of {command}", command))
                    );
                }
                k += 1;
            }
        }
        if words.len() == 1 {
            let found = text!("nothing");
            return Err(Problem::new(
                at,
                found,
                text!("the target of {command}", command),
            ));
        }
        Ok(())
    }

    /// Whether a target is multiplied by another frame: `XP1:XOFFSET`.
    fn is_composed(&mut self, words: &Words, k: usize, at: usize, command: &str) -> bool {
        let composed = words.is_sign(k, b':');
        if composed {
            let says = text!(
                "{command} goes to a product of frames, which is computed at run time",
                command
            );
            self.run_time(at, says);
        }
        composed
    }

    fn run_time(&mut self, at: usize, says: crate::text::Text) {
        self.program.at_run_time.push(Remark { at, text: says });
    }

    /// Keeps the target of an aggregate, if it is one.
    fn aggregate_target(
        &mut self,
        aggregate: &Aggregate,
        name: &str,
        key: Option<&str>,
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
            let says = text!(
                "{name} takes some of its components from where the robot is, or computes them at run time",
                name
            );
            self.run_time(aggregate.at, says);
            return Ok(None);
        };
        Ok(Some(self.moves.target(&mut self.program, key, target)))
    }

    fn axis_target(&self, aggregate: &Aggregate, name: &str) -> Result<Option<Target>, Problem> {
        aggregate.only(name, &["a1", "a2", "a3", "a4", "a5", "a6"])?;
        let number = |slot| aggregate.number(&axis_name(slot)).ok_or(());
        Ok(self.axes.joint_target(name, aggregate.at, number).ok())
    }

    fn pose_target(&self, aggregate: &Aggregate, name: &str) -> Result<Option<Target>, Problem> {
        let keys = ["x", "y", "z", "a", "b", "c", "s", "t"];
        aggregate.only(name, &keys)?;
        let numbers: Option<Vec<Number>> = keys[..6].iter().map(|k| aggregate.number(k)).collect();
        let Some(numbers) = numbers else {
            return Ok(None);
        };
        let Some(frame) = Frame::of_degrees(&numbers, Orientation::ZyxDegrees) else {
            return Ok(None);
        };
        let mut target = Target::new(name, aggregate.at, Shape::Pose(Box::new(frame)));
        let number = |slot| aggregate.number(&axis_name(slot)).ok_or(());
        match self.axes.external(number) {
            Ok(external) => target.posture_mut().external = external,
            Err(()) => return Ok(None),
        }
        if let Some((value, range, binary_digits)) = aggregate.whole("t", name)? {
            let joints = self.axes.own_numbered();
            for (bit, joint) in joints.iter().enumerate() {
                if let Some(joint) = *joint {
                    let negative = value >> bit & 1 != 0;
                    target
                        .posture_mut()
                        .configuration
                        .push(Statement::Negative { joint, negative });
                }
            }
            target.posture_mut().marks.push(Mark::Signs(Box::new(Signs {
                range,
                joints,
                value,
                binary_digits,
            })));
        }
        if let Some((value, ..)) = aggregate.whole("s", name)? {
            target
                .posture_mut()
                .configuration
                .push(Statement::Behind(value & 1 != 0));
        }
        Ok(Some(target))
    }
}

fn is_motion(name: &str) -> bool {
    const MOTIONS: &str = "ptp lin circ sptp slin scirc spl ptp_rel lin_rel circ_rel sptp_rel slin_rel scirc_rel \
        spl_rel";
    MOTIONS.split(' ').any(|known| known == name)
}
