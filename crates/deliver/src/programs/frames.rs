//! The frames that a program gives its poses in (work objects, `$BASE`, `UF`) and its tools: where the
//! file declares them, a pose is taken in its frame and of its tool; where it cannot be known, it is left.
//!
//! ```text
//! base_from_model_tool = base_from_frame · X · tool_from_model
//! tool_from_model      = (flange_from_tool)⁻¹ · flange_from_model
//! ```
//!
//! X is the pose as the file writes it. A frame is in the controller's base: the robot's, of FANUC its world. A pose that names no
//! frame is in the one that the caller states, and so is one whose frame is declared elsewhere, if it is
//! the only such frame and the caller states one. What holds of a program's tools and frames is settled
//! before ([`super::program_frames`]).

use super::program::not_in_numbers;
use std::collections::{BTreeMap, BTreeSet};

use crate::kinematics::Pose;
use crate::text::Text;

use super::answer::Reason;
use super::program::Program;
use super::program_frames::{Reading, ToolReading};
use super::referred::{BASE, Declared, Placed, Placement, Referred, TOOL, UsedPairs, Way};
use super::target::Remark;

/// What is known of a program's frames and tools as a whole.
struct Known<'a> {
    program: &'a Program,
    reading: &'a Reading,
    /// The ways of poses.
    poses: Vec<&'a Way>,
    /// Frames that are declared elsewhere.
    elsewhere: usize,
    /// Tools of poses, as they are spelled.
    tools: BTreeSet<&'a Referred>,
}

/// Says of every target how its pose is to be read, or that it is left.
pub(super) fn place(program: &mut Program, reading: &Reading) {
    let known = Known::of(program, reading);
    // Every pair of frame and tool is read once, however many targets there are.
    let mut read: BTreeMap<(bool, UsedPairs), Result<Placed, Text>> = BTreeMap::new();
    let all = program.targets.iter().map(|target| {
        let (pose, ways) = (target.is_pose(), target.ways);
        let placed = read.entry((pose, ways));
        let placed = placed.or_insert_with(|| known.placed(ways, pose).map(Placed::new));
        placed.clone()
    });
    let all: Vec<_> = all.collect();
    let notes = known.taken();
    for (target, placed) in program.targets.iter_mut().zip(all) {
        if let Some(says) = reading.carried.as_ref().filter(|_| target.is_pose()) {
            target.leave(Reason::External, says.clone());
        }
        match placed {
            Ok(placed) => target.placed = placed,
            Err(says) => target.leave(Reason::Frame, says),
        }
    }
    program.notes.extend(notes);
}

impl<'a> Known<'a> {
    fn of(program: &'a Program, reading: &'a Reading) -> Self {
        let [poses, _] = program.used();
        let elsewhere = |frame: &&Referred| {
            matches!(frame, Referred::Named(_)) && program.declaration(BASE, frame).is_none()
        };
        let frames: BTreeSet<&Referred> = poses.iter().map(|way| &way[BASE]).collect();
        let tools = poses.iter().map(|way| &way[TOOL]);
        Self {
            program,
            reading,
            elsewhere: frames.into_iter().filter(elsewhere).count(),
            tools: tools
                .filter(|tool| !matches!(tool, Referred::Unknown(_)))
                .collect(),
            poses,
        }
    }

    /// Frames and tools that are taken as the file declares them.
    fn taken(&self) -> Vec<Remark> {
        let tools = matches!(
            self.reading.tool,
            ToolReading::Named(_) | ToolReading::Declared { .. }
        );
        let as_declared = [self.reading.all_frames.is_none(), tools];
        let mut taken: BTreeSet<(usize, Text)> = BTreeSet::new();
        for way in &self.poses {
            for part in [BASE, TOOL].into_iter().filter(|part| as_declared[*part]) {
                if let Referred::Named(name) = &way[part]
                    && let Some(declared) = self.program.declaration(part, &way[part])
                    && declared.pose.is_ok()
                {
                    let name = &**name;
                    let says = text!("{name} is taken as it is declared here", name);
                    taken.insert((declared.at, says));
                }
            }
        }
        let remark = |(at, text)| Remark { at, text };
        taken.into_iter().map(remark).collect()
    }

    /// The reading of a target that motions go to so; in words where it is not known. Of joint values only
    /// the tool matters: it says which point is to be right.
    fn placed(&self, ways: UsedPairs, pose: bool) -> Result<Placement, Text> {
        let [one, other] = ways.0.map(|way| Some(self.program.ways.get(way?)));
        if let (true, Some(one), Some(other)) = (pose, one, other) {
            let differ = if one[BASE] == other[BASE] { TOOL } else { BASE };
            let (a, b) = (one[differ].to_string(), other[differ].to_string());
            return Err(text!("motions go to it with {a} and {b}", a, b));
        }
        // Whatever it goes to, a tool that stands is not the model's.
        for way in [one, other].into_iter().flatten() {
            if let Some(tool) = self.program.declaration(TOOL, &way[TOOL])
                && tool.stands
            {
                tool.pose.clone()?;
            }
        }
        if !pose {
            let only = one.filter(|_| other.is_none());
            return Ok(Placement {
                base_from_frame: Pose::identity(),
                tool_from_model: self.tool_of_joints(only),
            });
        }
        Ok(Placement {
            base_from_frame: self.program.base_from_world
                * self.frame(one.map_or(&Referred::Unsaid, |way| &way[BASE]))?,
            tool_from_model: match (one, &self.reading.tool) {
                (Some(way), _) => self.tool(&way[TOOL])?,
                (None, ToolReading::Given(tool_from_model)) => *tool_from_model,
                (None, _) => Pose::identity(),
            },
        })
    }

    fn frame(&self, referred: &Referred) -> Result<Pose, Text> {
        let stated = self.reading.stated.unwrap_or_else(Pose::identity);
        match (referred, self.program.declaration(BASE, referred)) {
            (Referred::Unsaid, _) => Ok(stated),
            (Referred::Unknown(says), _) => Err(text!(
                "{name} is not known: {says}",
                name = text!("the frame"),
                says
            )),
            (_, Some(Declared { pose: Ok(pose), .. })) => {
                Ok(self.reading.all_frames.unwrap_or(*pose))
            }
            (_, Some(Declared { pose, .. })) => pose.clone(),
            _ if self.reading.stated.is_some() && self.elsewhere == 1 => Ok(stated),
            (Referred::Named(name), None) => Err(text!(
                "its frame {name} is declared elsewhere: --frame says where it is in the base (one frame in \
                 a file)",
                name = name.to_string()
            )),
        }
    }

    fn on_flange(&self, name: &str) -> Result<Pose, Text> {
        match self.program.declared[TOOL].get(&name.to_lowercase()) {
            Some(declared) => declared.pose.clone(),
            None => Err(not_in_numbers(name)),
        }
    }

    fn tool(&self, referred: &Referred) -> Result<Pose, Text> {
        let one = self.tools.len() <= 1;
        let declared = self.program.declaration(TOOL, referred).is_some();
        let model = match (&self.reading.tool, referred) {
            (ToolReading::Given(tool_from_model), _) => return Ok(*tool_from_model),
            (_, Referred::Unknown(says)) => {
                return Err(text!(
                    "{name} is not known: {says}",
                    name = text!("the tool"),
                    says
                ));
            }
            (ToolReading::OnlyOne, _) if one => return Ok(Pose::identity()),
            (ToolReading::OnlyOne, _) => {
                let all: Vec<String> = self.tools.iter().map(ToString::to_string).collect();
                return Err(text!(
                    "poses of this file are of several tools ({all}): --tool says which one is the model's",
                    all = all.join(", ")
                ));
            }
            (ToolReading::Named(name), own) if own.is(name) => return Ok(Pose::identity()),
            (ToolReading::Named(name), _) => self.on_flange(name)?,
            // One tool of which the file has no numbers is the model's.
            (ToolReading::Declared { lenient: true, .. }, _) if one && !declared => {
                return Ok(Pose::identity());
            }
            (ToolReading::Declared { model, .. }, _) => *model,
        };
        match referred {
            Referred::Named(name) => Ok(self.on_flange(name)?.inverse() * model),
            _ => Err(text!("which tool it is of is not stated")),
        }
    }

    /// The tool of joint values; where it is not known the model's.
    fn tool_of_joints(&self, way: Option<&Way>) -> Pose {
        let tool = match (&self.reading.tool, way) {
            (ToolReading::Given(tool_from_model), _) => return *tool_from_model,
            (ToolReading::OnlyOne, _) | (_, None) => return Pose::identity(),
            (_, Some(way)) => &way[TOOL],
        };
        match self.program.declaration(TOOL, tool) {
            Some(declared) if !declared.is_none => self.tool(tool).unwrap_or_default(),
            _ => Pose::identity(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_ways_that_differ_are_kept_and_no_more() {
        let mut ways = UsedPairs::default();
        for way in [4, 4, 7, 9, 4] {
            ways.add(way);
        }
        assert_eq!(ways.iter().collect::<Vec<_>>(), [4, 7]);
        let mut other = UsedPairs::default();
        other.join(ways);
        assert_eq!(other, ways);
    }
}
