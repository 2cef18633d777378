//! The frames that a program gives its poses in (work objects, `$BASE`, `UF`) and its tools: where the
//! file declares them, a pose is taken in its frame and of its tool; where it cannot be known, it is left.
//!
//! ```text
//! base_from_model_tool = base_from_frame · X · tool_from_model
//! tool_from_model      = (flange_from_tool)⁻¹ · flange_from_model
//! ```
//!
//! X is the pose as the file writes it. A declared frame is in the robot's base. A pose that names no
//! frame is in the one that the caller states, and so is one whose frame is declared elsewhere, if it is
//! the only such frame and the caller states one. What holds of a program's tools and frames is settled
//! before ([`super::program_frames`]).

use crate::text::Text;
use std::collections::{BTreeMap, BTreeSet};

use crate::kinematics::Pose;

use super::answer::Reason;
use super::program::Program;
use super::program_frames::{Reading, ToolReading};
use super::referred::{Declared, FrameAndTool, Placed, Placement, Referred, UsedPairs};
use super::target::{Remark, Shape};
use super::used_frames::Used;

/// What is known of a program's frames and tools as a whole.
struct Known<'a> {
    program: &'a Program,
    reading: &'a Reading,
    /// Frames that are declared elsewhere.
    elsewhere: usize,
    /// Tools of poses, as they are spelled.
    tools: BTreeSet<&'a Referred>,
}

/// Says of every target how its pose is to be read, or that it is left.
pub(super) fn place(program: &mut Program, reading: &Reading) {
    let known = Known::of(program, reading);
    // Every pair of frame and tool is read once, however many targets there are.
    let mut read: BTreeMap<(bool, PairNumbers), Result<Placed, Text>> = BTreeMap::new();
    let mut all = Vec::with_capacity(program.targets.len());
    for target in &program.targets {
        let pose = matches!(target.shape, Shape::Pose(_));
        let placed = read
            .entry((pose, target.ways.0))
            .or_insert_with(|| known.placed(target.ways, pose).map(Placed::new));
        all.push(placed.clone());
    }
    let notes = known.taken();
    for (target, placed) in program.targets.iter_mut().zip(all) {
        if let Some(says) = &reading.carried
            && matches!(target.shape, Shape::Pose(_))
        {
            target.leave(Reason::External, says.clone());
        }
        match placed {
            Ok(placed) => target.placed = placed,
            Err(says) => target.leave(Reason::Frame, says),
        }
    }
    program.notes.extend(notes);
}

type PairNumbers = [Option<u32>; 2];

impl<'a> Known<'a> {
    fn of(program: &'a Program, reading: &'a Reading) -> Self {
        let used = Used::of(program);
        let elsewhere = |frame: &&Referred| match frame {
            Referred::Named(name) => !program.frames.contains_key(&**name),
            _ => false,
        };
        let frames: BTreeSet<&Referred> = used.poses.iter().map(|way| &way.frame).collect();
        Self {
            program,
            reading,
            elsewhere: frames.into_iter().filter(elsewhere).count(),
            tools: (used.poses.iter().map(|way| &way.tool))
                .filter(|tool| !matches!(tool, Referred::Unknown(_)))
                .collect(),
        }
    }

    /// Frames and tools that are taken as the file declares them.
    fn taken(&self) -> Vec<Remark> {
        let tools = matches!(
            self.reading.tool,
            ToolReading::Named(_) | ToolReading::Declared { .. }
        );
        let mut taken: BTreeSet<(usize, Text)> = BTreeSet::new();
        for way in Used::of(self.program).poses {
            let kinds = [
                (
                    &way.frame,
                    &self.program.frames,
                    true,
                    self.reading.all_frames.is_none(),
                ),
                (&way.tool, &self.program.tools, false, tools),
            ];
            for (referred, names, is_frame, as_declared) in kinds {
                if let Referred::Named(name) = referred
                    && let Some(Declared {
                        at, pose: Ok(_), ..
                    }) = names.get(&**name)
                    && as_declared
                {
                    let says = if is_frame {
                        text!(
                            "frame {name} is taken as it is declared here",
                            name = &**name
                        )
                    } else {
                        text!(
                            "tool {name} is taken as it is declared here",
                            name = &**name
                        )
                    };
                    taken.insert((*at, says));
                }
            }
        }
        let remarks = taken
            .into_iter()
            .map(|(at, says)| Remark { at, text: says });
        remarks.collect()
    }

    fn tools_in_words(&self) -> String {
        let all: Vec<String> = self.tools.iter().map(ToString::to_string).collect();
        all.join(", ")
    }

    /// The reading of a target that motions go to so; in words where it is not known. Of joint values only
    /// the tool matters: it says which point is to be right.
    fn placed(&self, ways: UsedPairs, pose: bool) -> Result<Placement, Text> {
        let one = match ways.0.map(|way| way.map(|way| self.program.ways.get(way))) {
            [Some(one), None] => Some(one),
            [Some(one), Some(other)] if pose => {
                return Err(if one.frame == other.frame {
                    text!(
                        "motions go to it with the tools {a} and {b}",
                        a = one.tool.to_string(),
                        b = other.tool.to_string()
                    )
                } else {
                    text!(
                        "motions go to it with the frames {a} and {b}",
                        a = one.frame.to_string(),
                        b = other.frame.to_string()
                    )
                });
            }
            _ => None,
        };
        // Whatever it goes to, a tool that stands is not the model's.
        let tools = ways.iter().map(|way| &self.program.ways.get(way).tool);
        let named = tools.filter_map(|tool| match tool {
            Referred::Named(name) => self.program.tools.get(&**name),
            _ => None,
        });
        if let Some(says) = named
            .filter(|tool| tool.stands)
            .find_map(|tool| tool.pose.clone().err())
        {
            return Err(says);
        }
        if !pose {
            return Ok(Placement {
                base_from_frame: Pose::identity(),
                tool_from_model: self.tool_of_joints(one),
            });
        }
        let unsaid = FrameAndTool::new(Default::default());
        let Some(one) = one else {
            return Ok(Placement {
                base_from_frame: self.frame(&unsaid.frame)?,
                tool_from_model: match self.reading.tool {
                    ToolReading::Given(tool_from_model) => tool_from_model,
                    _ => Pose::identity(),
                },
            });
        };
        Ok(Placement {
            base_from_frame: self.frame(&one.frame)?,
            tool_from_model: self.tool(&one.tool)?,
        })
    }

    fn frame(&self, referred: &Referred) -> Result<Pose, Text> {
        let stated = self.reading.stated.unwrap_or_else(Pose::identity);
        let name = match referred {
            Referred::Unsaid => return Ok(stated),
            Referred::Unknown(says) => {
                return Err(text!("its frame is not known: {says}", says));
            }
            Referred::Named(name) => name,
        };
        match self.program.frames.get(&**name) {
            Some(Declared { pose: Ok(pose), .. }) => Ok(self.reading.all_frames.unwrap_or(*pose)),
            Some(Declared {
                pose: Err(says), ..
            }) => Err(says.clone()),
            None if self.reading.stated.is_some() && self.elsewhere == 1 => Ok(stated),
            None => Err(text!(
                "its frame {name} is declared elsewhere: --frame says where it is in the base (one frame in \
                 a file)",
                name = name.to_string()
            )),
        }
    }

    fn on_flange(&self, name: &str) -> Result<Pose, Text> {
        match self.program.tools.get(&name.to_lowercase()) {
            Some(declared) => declared.pose.clone(),
            None => Err(text!("its tool {name} is declared elsewhere", name)),
        }
    }

    fn tool(&self, referred: &Referred) -> Result<Pose, Text> {
        if let ToolReading::Given(tool_from_model) = self.reading.tool {
            return Ok(tool_from_model);
        }
        if let Referred::Unknown(says) = referred {
            return Err(text!("its tool is not known: {says}", says));
        }
        let model = match &self.reading.tool {
            ToolReading::Given(tool_from_model) => return Ok(*tool_from_model),
            ToolReading::OnlyOne if self.tools.len() <= 1 => return Ok(Pose::identity()),
            ToolReading::OnlyOne => {
                let all = self.tools_in_words();
                return Err(text!(
                    "poses of this file are of several tools ({all}): --tool says which one is the model's",
                    all
                ));
            }
            ToolReading::Named(name) if referred.is(name) => return Ok(Pose::identity()),
            ToolReading::Named(name) => self.on_flange(name)?,
            ToolReading::Declared { model, lenient } => {
                // One tool of which the file has no numbers is the model's.
                let one = self.tools.len() <= 1;
                let known = match referred {
                    Referred::Named(name) => self.program.tools.contains_key(&**name),
                    _ => false,
                };
                if *lenient && one && !known {
                    return Ok(Pose::identity());
                }
                *model
            }
        };
        let own = match referred {
            Referred::Named(name) => self.on_flange(name)?,
            _ => return Err(text!("which tool it is of is not stated")),
        };
        Ok(own.inverse() * model)
    }

    /// The tool of joint values; where it is not known the model's.
    fn tool_of_joints(&self, way: Option<&FrameAndTool>) -> Pose {
        let own = match (&self.reading.tool, way) {
            (ToolReading::Given(tool_from_model), _) => return *tool_from_model,
            (ToolReading::OnlyOne, _) | (_, None) => return Pose::identity(),
            (_, Some(way)) => &way.tool,
        };
        let none = match own {
            Referred::Named(name) => (self.program.tools.get(&**name)).is_none_or(|t| t.is_none),
            _ => true,
        };
        if none {
            return Pose::identity();
        }
        self.tool(own).unwrap_or_else(|_| Pose::identity())
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
