//! Which base and tool a KRL program has at each of its lines.
//!
//! `$BASE` and `$TOOL` (and the numbers of `FDAT_ACT`, which motions of inline forms take theirs from) hold
//! from where they are set to the end of the routine. In branches and loops that set one they are known
//! from there to the next word that branches, and after the block they are not. A routine after the
//! first of a file that sets one takes them from its caller.

use crate::text::Text;
use std::collections::BTreeMap;

use crate::kinematics::Pose;

use crate::programs::referred::{Names, Referred, declare, declare_none};

use super::super::tokens::{Kind, Words};
use super::aggregates::{Aggregate, aggregate};
use crate::programs::program::Program;

/// Base and tool of motions.
#[derive(Debug, Clone, Default)]
pub(super) struct ActiveFrames {
    pub(super) base: Referred,
    pub(super) tool: Referred,
}

/// What a line sets: base, tool.
type Set = [Option<Referred>; 2];

impl ActiveFrames {
    /// Base and tool at each line; what the file declares of them goes to the program.
    pub(super) fn of(lines: &[Words], program: &mut Program) -> Vec<Self> {
        declare_none(&mut program.tools, "$nullframe");
        let numbers = numbers_of(lines);
        let sets: Vec<Set> = lines
            .iter()
            .map(|line| set_by(line, &numbers, program))
            .collect();
        let any = which_set(&sets);
        let mut held = Self::default();
        let mut all = Vec::with_capacity(lines.len());
        let (mut depth, mut routines, mut unsure) = (0_usize, 0_usize, [false; 2]);
        for (k, line) in lines.iter().enumerate() {
            let word = line.name(0).unwrap_or_default();
            let first = if word == "global" {
                line.name(1).unwrap_or_default()
            } else {
                word
            };
            match first.as_str() {
                "def" | "deffct" => {
                    routines += 1;
                    held = Self::default();
                    if routines > 1 {
                        held.unknown(any, &text!("another routine of this file sets it"));
                    }
                }
                "if" | "switch" | "for" | "while" | "loop" | "repeat" => {
                    if depth == 0 {
                        let end = end_of_block(lines, k);
                        unsure = which_set(&sets[k..end]);
                    }
                    depth += 1;
                }
                "endif" | "endswitch" | "endfor" | "endwhile" | "endloop" | "until" => {
                    depth = depth.saturating_sub(1);
                }
                _ => {}
            }
            if branches(&first) {
                held.unknown(unsure, &text!("it is set in a branch or a loop"));
            }
            let [base, tool] = &sets[k];
            held.base = base.clone().unwrap_or(held.base);
            held.tool = tool.clone().unwrap_or(held.tool);
            all.push(held.clone());
        }
        all
    }

    fn unknown(&mut self, [base, tool]: [bool; 2], says: &Text) {
        if base {
            self.base = Referred::Unknown(says.clone());
        }
        if tool {
            self.tool = Referred::Unknown(says.clone());
        }
    }
}

/// Whether some lines set the base, and the tool.
fn which_set(sets: &[Set]) -> [bool; 2] {
    [0, 1].map(|which: usize| sets.iter().any(|set| set[which].is_some()))
}

fn branches(word: &str) -> bool {
    const WORDS: &str = "if else endif switch case default endswitch for endfor while endwhile loop endloop repeat \
        until";
    WORDS.split(' ').any(|known| known == word)
}

/// The line behind a block that begins at a line.
fn end_of_block(lines: &[Words], from: usize) -> usize {
    let mut depth = 0_usize;
    for (k, line) in lines.iter().enumerate().skip(from) {
        match line.name(0).as_deref() {
            Some("if" | "switch" | "for" | "while" | "loop" | "repeat") => depth += 1,
            Some("endif" | "endswitch" | "endfor" | "endwhile" | "endloop" | "until") => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return k + 1;
        }
    }
    lines.len()
}

/// What a line sets or declares.
fn set_by(line: &Words, numbers: &Numbers, program: &mut Program) -> Set {
    // BAS(#BASE,3)
    if line.name(0).as_deref() == Some("bas") && line.is_sign(2, b'#') && line.is_sign(4, b',') {
        let number = line.shown(5, line.until(5, b")"));
        return match line.name(3).as_deref() {
            Some("base") => [Some(numbered("BASE_DATA", &number, Referred::Unsaid)), None],
            Some("tool") => [None, Some(numbered("TOOL_DATA", &number, null_tool()))],
            _ => [None, None],
        };
    }
    let Some(equals) = (1..line.len()).find(|k| line.is_sign(*k, b'=')) else {
        return [None, None];
    };
    if line.is_sign(equals + 1, b'=') {
        return [None, None];
    }
    // Behind DECL, FRAME and the like stands the name, perhaps with an index.
    let mut k = equals - 1;
    if line.is_sign(k, b']') {
        while k > 0 && !line.is_sign(k, b'[') {
            k -= 1;
        }
        k = k.saturating_sub(1);
    }
    let component = k > 0 && line.is_sign(k - 1, b'.');
    let name = if component && k >= 2 {
        line.name(k - 2)
    } else {
        line.name(k)
    };
    let which = match name.as_deref() {
        Some("$base") => 0,
        Some("$tool") => 1,
        Some("$load" | "load_data") if !component => {
            if line.is_sign(equals + 1, b'{')
                && let Ok((load, _)) = aggregate(line, equals + 1)
                && let Some(kg) = load.number("m")
            {
                let name = line.shown(k, equals);
                program.loads.state(kg.value, line.at(k), &name);
            }
            return [None, None];
        }
        Some("fdat_act") => return set_by_numbers(&line.spelled(equals + 1), numbers),
        Some(_) if !component => {
            declare_aggregate(line, k, equals, program);
            return [None, None];
        }
        _ => return [None, None],
    };
    let names = if which == 0 {
        &mut program.frames
    } else {
        &mut program.tools
    };
    let referred = if component {
        Referred::Unknown(text!(
            "{name} is set",
            name = line.shown(k.saturating_sub(2), equals)
        ))
    } else {
        value(line, equals + 1, names)
    };
    let mut set = [None, None];
    // The null frame is the world.
    let world = which == 0 && referred.is("$nullframe");
    set[which] = Some(if world { Referred::Unsaid } else { referred });
    set
}

/// What `$BASE` or `$TOOL` is set to.
fn value(line: &Words, k: usize, names: &mut Names) -> Referred {
    let shown = line.shown(k, line.len());
    if line.is_sign(k, b'{') {
        let read = aggregate(line, k).ok();
        if let Some((aggregate, end)) = read
            && end == line.len()
        {
            declare(names, &shown, line.at(k), pose_of(&aggregate, &shown));
            return Referred::named(shown);
        }
    }
    let whole = |end: usize| end == line.len();
    let indexed = line.is_sign(k + 1, b'[') && line.kind(k + 2) == Some(Kind::Digits);
    if line.kind(k) == Some(Kind::Name) && (whole(k + 1) || indexed && whole(k + 4)) {
        return Referred::named(shown);
    }
    Referred::Unknown(text!("{name} is computed at run time", name = shown))
}

/// `FIXTURE = {X …}`, `BASE_DATA[3] = {X …}`: what may be a base or a tool. A target has these components too,
/// but no base is set to one.
fn declare_aggregate(line: &Words, k: usize, equals: usize, program: &mut Program) {
    let spelled = line.shown(k, equals);
    let pose = if line.is_sign(equals + 1, b'{') {
        // With a configuration or with axes it is a target and no frame.
        let read = aggregate(line, equals + 1).ok();
        let is_frame = |read: &Aggregate| {
            let target = ["s", "t", "a1"];
            !target.iter().any(|key| read.components.contains_key(*key))
        };
        let read = read.filter(|(read, _)| is_frame(read));
        read.map(|(read, _)| pose_of(&read, &spelled))
    } else {
        Some(Err(text!(
            "{spelled} is computed at run time",
            spelled = &spelled
        )))
    };
    if let Some(pose) = pose {
        declare(&mut program.frames, &spelled, line.at(k), pose.clone());
        declare(&mut program.tools, &spelled, line.at(k), pose);
    }
}

fn pose_of(aggregate: &Aggregate, spelled: &str) -> Result<Pose, crate::text::Text> {
    let pose = aggregate.pose();
    pose.ok_or_else(|| text!("{spelled} is not written out in numbers", spelled))
}

/// The numbers of base and tool by the names, in small letters, that are declared with them.
type Numbers = BTreeMap<String, [Option<f64>; 2]>;

/// Read once for the file, because every motion of an inline form names one.
fn numbers_of(lines: &[Words]) -> Numbers {
    let mut numbers = Numbers::new();
    for line in lines {
        let equals = (1..line.len()).find(|k| line.is_sign(*k, b'='));
        let Some(equals) = equals.filter(|k| line.is_sign(*k + 1, b'{')) else {
            continue;
        };
        let (Some(name), Ok((read, _))) = (line.name(equals - 1), aggregate(line, equals + 1))
        else {
            continue;
        };
        let own = ["base_no", "tool_no"].map(|key| read.number(key).map(|number| number.value));
        if own != [None; 2] {
            numbers.entry(name).or_insert(own);
        }
    }
    numbers
}

/// Base and tool of `FDAT_ACT = name`, by the numbers that `name` is declared with.
fn set_by_numbers(name: &str, numbers: &Numbers) -> Set {
    let declared = numbers.get(&name.to_lowercase()).copied();
    let declared = declared.unwrap_or_default();
    let of = |number: Option<f64>, table: &str, zero: Referred| {
        Some(match number {
            Some(number) => numbered(table, &number.to_string(), zero),
            None => Referred::Unknown(text!("{name} has its numbers elsewhere", name)),
        })
    };
    [
        of(declared[0], "BASE_DATA", Referred::Unsaid),
        of(declared[1], "TOOL_DATA", null_tool()),
    ]
}

/// The base or tool of a number; 0 is none.
fn numbered(table: &str, number: &str, zero: Referred) -> Referred {
    match number.parse::<u32>() {
        Ok(0) => zero,
        Ok(number) => Referred::named(format!("{table}[{number}]")),
        Err(_) => Referred::Unknown(text!(
            "{name} is chosen at run time",
            name = format!("{table}[{number}]")
        )),
    }
}

/// The tool that is the flange itself.
fn null_tool() -> Referred {
    Referred::named("$NULLFRAME")
}
