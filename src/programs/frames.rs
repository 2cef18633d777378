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
use std::sync::Arc;

use nalgebra::UnitQuaternion;

use crate::kinematics::Pose;
use crate::kinematics::inverse::Goal;

use super::answer::{Left, Reason};
use super::program_frames::{Reading, ToolReading};
use super::target::{Program, Remark, Shape};

/// What a motion, or a position, says of its frame or tool.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) enum Referred {
    /// Nothing.
    #[default]
    Unsaid,
    /// The one of this name, in small letters.
    Named(Arc<str>),
    /// One that is chosen at run time, in words.
    Unknown(Text),
}

impl Referred {
    pub(super) fn named(spelled: impl AsRef<str>) -> Self {
        Self::Named(spelled.as_ref().to_lowercase().into())
    }

    /// Whether it has this name, whatever its capitals.
    pub(super) fn is(&self, name: &str) -> bool {
        *self == Self::named(name)
    }
}

impl std::fmt::Display for Referred {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unsaid => f.write_str("none"),
            Self::Named(says) => f.write_str(says),
            Self::Unknown(says) => std::fmt::Display::fmt(says, f),
        }
    }
}

/// The frame and the tool of a motion.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Way {
    pub(super) frame: Referred,
    pub(super) tool: Referred,
}

/// Every frame and tool that motions of a program have, each pair once.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct AllWays {
    all: Vec<Way>,
    index: BTreeMap<Way, u32>,
}

impl AllWays {
    /// The number of a frame and a tool.
    pub(super) fn of(&mut self, way: Way) -> u32 {
        if let Some(index) = self.index.get(&way) {
            return *index;
        }
        let index = u32::try_from(self.all.len()).unwrap_or(u32::MAX);
        self.index.insert(way.clone(), index);
        self.all.push(way);
        index
    }

    fn get(&self, index: u32) -> &Way {
        &self.all[index as usize]
    }

    /// Changes the tool of every motion.
    pub(super) fn set_tools(&mut self, tool: &Referred) {
        for way in &mut self.all {
            way.tool = tool.clone();
        }
    }
}

/// In which ways motions go to a target: the first two that differ tell whether it is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Ways([Option<u32>; 2]);

impl Ways {
    pub(super) fn add(&mut self, way: u32) {
        match self.0 {
            [None, _] => self.0[0] = Some(way),
            [Some(first), None] if first != way => self.0[1] = Some(way),
            _ => {}
        }
    }

    pub(super) fn join(&mut self, other: Self) {
        for way in other.0.into_iter().flatten() {
            self.add(way);
        }
    }

    fn iter(self) -> impl Iterator<Item = u32> {
        self.0.into_iter().flatten()
    }
}

/// A frame or a tool that the file declares: where, and its pose (in the base, on the flange) or why that
/// is not known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Declared {
    pub(super) at: usize,
    pub(super) pose: Result<Pose, Text>,
    /// Mass of a tool that is declared with one, kg.
    pub(super) mass_kg: Option<f64>,
    /// Whether it is the language's own name for "none": it says nothing.
    pub(super) is_none: bool,
}

/// Frames or tools by their names in small letters.
pub(super) type Names = BTreeMap<String, Declared>;

/// Keeps a declaration; of a name that is declared twice differently nothing is known.
pub(super) fn declare(names: &mut Names, spelled: &str, at: usize, pose: Result<Pose, Text>) {
    names
        .entry(spelled.to_lowercase())
        .and_modify(|known| {
            if known.pose != pose {
                known.pose = Err(text!(
                    "{spelled} is declared several times",
                    spelled = spelled
                ));
            }
        })
        .or_insert(Declared {
            at,
            pose,
            mass_kg: None,
            is_none: false,
        });
}

/// Declares the language's own name for the flange, or for the base.
pub(super) fn declare_none(names: &mut Names, spelled: &str) {
    let none = Declared {
        at: 0,
        pose: Ok(Pose::identity()),
        mass_kg: None,
        is_none: true,
    };
    names.insert(spelled.to_lowercase(), none);
}

/// Which of a program's tools is the one of the model.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelTool {
    /// The tool of this name.
    Named(String),
    /// The one that sits here on the flange.
    OnFlange(Pose),
}

/// How the pose of a target is to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placement {
    pub(super) base_from_frame: Pose,
    pub(super) tool_from_model: Pose,
}

/// The same, shared by the targets that are read alike; `None`: in the base, of the model's tool.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Placed(Option<Arc<Placement>>);

impl Placed {
    fn new(placement: Placement) -> Self {
        let nothing = Placement::stated(None);
        Self((placement != nothing).then(|| Arc::new(placement)))
    }

    pub(super) fn get(&self) -> Placement {
        self.0
            .as_deref()
            .copied()
            .unwrap_or_else(|| Placement::stated(None))
    }

    /// Where a pose of the file puts the model's tool, in the robot's base.
    pub(super) fn goal(&self, written: &Goal) -> Goal {
        let rotation = written.rotation.unwrap_or_else(UnitQuaternion::identity);
        let pose = Pose::from_parts(written.position_mm.coords.into(), rotation);
        let placement = self.get();
        let pose = placement.base_from_frame * pose * placement.tool_from_model;
        Goal {
            position_mm: pose.translation.vector.into(),
            rotation: written.rotation.map(|_| pose.rotation),
        }
    }

    /// What the file writes for a pose of the model's tool in the robot's base.
    pub(super) fn written(&self, pose: &Pose) -> Pose {
        let placement = self.get();
        placement.base_from_frame.inverse() * pose * placement.tool_from_model.inverse()
    }
}

impl Placement {
    /// In the frame that the caller states, of the model's tool.
    fn stated(frame: Option<Pose>) -> Self {
        Self {
            base_from_frame: frame.unwrap_or_else(Pose::identity),
            tool_from_model: Pose::identity(),
        }
    }
}

/// The ways in which motions go to poses, and to targets of joint values.
pub(super) struct Used<'p> {
    /// Of poses.
    pub(super) poses: Vec<&'p Way>,
    /// Of joint values.
    pub(super) joints: Vec<&'p Way>,
}

impl<'p> Used<'p> {
    pub(super) fn of(program: &'p Program) -> Self {
        let mut used = [BTreeSet::new(), BTreeSet::new()];
        for target in &program.targets {
            let which = usize::from(matches!(target.shape, Shape::Joints { .. }));
            used[which].extend(target.ways.iter());
        }
        let [poses, joints] = used.map(|used| {
            let ways = used.into_iter().map(|way| program.ways.get(way));
            ways.collect()
        });
        Self { poses, joints }
    }
}

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
    let mut read: BTreeMap<(bool, Ways2), Result<Placed, Text>> = BTreeMap::new();
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
        match placed {
            Ok(placed) => target.placed = placed,
            Err(says) => target.left = Some(Box::new(Left::new(Reason::Frame, says))),
        }
    }
    program.notes.extend(notes);
}

type Ways2 = [Option<u32>; 2];

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
            tools: used.poses.iter().map(|way| &way.tool).collect(),
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
                    phrase!("frame"),
                    self.reading.all_frames.is_none(),
                ),
                (&way.tool, &self.program.tools, phrase!("tool"), tools),
            ];
            for (referred, names, what, as_declared) in kinds {
                if let Referred::Named(name) = referred
                    && let Some(Declared {
                        at, pose: Ok(_), ..
                    }) = names.get(&**name)
                    && as_declared
                {
                    taken.insert((
                        *at,
                        text!(
                            "{what} {name} is taken as it is declared here",
                            what = what,
                            name = &**name
                        ),
                    ));
                }
            }
        }
        let remarks = taken.into_iter().map(|(at, says)| Remark { at, says });
        remarks.collect()
    }

    fn tools_in_words(&self) -> String {
        let all: Vec<String> = self.tools.iter().map(ToString::to_string).collect();
        all.join(", ")
    }

    /// The reading of a target that motions go to so; in words where it is not known. Of joint values only
    /// the tool matters: it says which point is to be right.
    fn placed(&self, ways: Ways, pose: bool) -> Result<Placement, Text> {
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
        if !pose {
            return Ok(Placement {
                base_from_frame: Pose::identity(),
                tool_from_model: self.tool_of_joints(one),
            });
        }
        let unsaid = Way {
            frame: Referred::Unsaid,
            tool: Referred::Unsaid,
        };
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
                return Err(text!("its frame is not known: {says}", says = says));
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
                name = name
            )),
        }
    }

    fn on_flange(&self, name: &str) -> Result<Pose, Text> {
        match self.program.tools.get(&name.to_lowercase()) {
            Some(declared) => declared.pose.clone(),
            None => Err(text!("its tool {name} is declared elsewhere", name = name)),
        }
    }

    fn tool(&self, referred: &Referred) -> Result<Pose, Text> {
        if let ToolReading::Given(tool_from_model) = self.reading.tool {
            return Ok(tool_from_model);
        }
        if let Referred::Unknown(says) = referred {
            return Err(text!("its tool is not known: {says}", says = says));
        }
        let model = match &self.reading.tool {
            ToolReading::Given(tool_from_model) => return Ok(*tool_from_model),
            ToolReading::OnlyOne if self.tools.len() <= 1 => return Ok(Pose::identity()),
            ToolReading::OnlyOne => {
                let all = self.tools_in_words();
                return Err(text!(
                    "poses of this file are of several tools ({all}): --tool says which one is the model's",
                    all = all
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
            _ => return Err(text!("which tool it is of is not said")),
        };
        Ok(own.inverse() * model)
    }

    /// The tool of joint values; where it is not known the model's.
    fn tool_of_joints(&self, way: Option<&Way>) -> Pose {
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
        let mut ways = Ways::default();
        for way in [4, 4, 7, 9, 4] {
            ways.add(way);
        }
        assert_eq!(ways.iter().collect::<Vec<_>>(), [4, 7]);
        let mut other = Ways::default();
        other.join(ways);
        assert_eq!(other, ways);
    }
}
