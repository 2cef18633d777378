//! The frames that a program gives its poses in (work objects, `$BASE`, `UF`) and its tools: where the
//! file declares them, a pose is taken in its frame and of its tool; where it cannot be known, it is left.
//!
//! ```text
//! base_from_model_tool = base_from_frame · X · tool_from_model
//! tool_from_model      = (flange_from_tool)⁻¹ · flange_from_model
//! ```
//!
//! X is the pose as the file writes it. A declared frame stands in the robot's base. A pose that names no
//! frame is in the one that the caller states, and so is one whose frame is declared elsewhere, if it is
//! the only such frame and the caller states one. A file with one tool has the model's; with several the
//! caller says which one that is, or where it sits on the flange.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::UnitQuaternion;

use crate::kinematics::Pose;
use crate::kinematics::inverse::Goal;

use super::answer::{Left, Reason};
use super::compensate::CompensateError;
use super::target::{Program, Remark, Shape};

/// What a motion, or a position, says of its frame or tool.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) enum Referred {
    /// Nothing.
    #[default]
    Unsaid,
    /// The one of this name, in small letters.
    Named(String),
    /// One that is chosen at run time, in words.
    Unknown(String),
}

impl Referred {
    pub(super) fn named(spelled: impl AsRef<str>) -> Self {
        Self::Named(spelled.as_ref().to_lowercase())
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
            Self::Named(name) => f.write_str(name),
            Self::Unknown(says) => f.write_str(says),
        }
    }
}

/// That a motion goes to a target in a frame with a tool.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Use {
    pub(super) target: usize,
    pub(super) frame: Referred,
    pub(super) tool: Referred,
}

/// A frame or a tool that the file declares: where, and its pose (in the base, on the flange) or why that
/// is not known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Declared {
    pub(super) at: usize,
    pub(super) pose: Result<Pose, String>,
}

/// Frames or tools by their names in small letters.
pub(super) type Names = BTreeMap<String, Declared>;

/// Keeps a declaration; of a name that is declared twice nothing is known.
pub(super) fn declare(names: &mut Names, spelled: &str, at: usize, pose: Result<Pose, String>) {
    let twice = Err(format!("{spelled} is declared several times"));
    names
        .entry(spelled.to_lowercase())
        .and_modify(|known| {
            if known.pose != pose {
                known.pose = twice;
            }
        })
        .or_insert(Declared { at, pose });
}

/// Which of a program's tools is the one of the model.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelTool {
    /// The tool of this name.
    Named(String),
    /// The one that sits here on the flange.
    OnFlange(Pose),
}

/// How the poses of a target are to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub(super) base_from_frame: Pose,
    pub(super) tool_from_model: Pose,
}

/// What is known of a program's frames and tools as a whole.
struct Known<'a> {
    program: &'a Program,
    stated: Option<Pose>,
    /// Frames that are declared elsewhere.
    elsewhere: usize,
    /// Tools of poses, as they are spelled.
    tools: BTreeSet<Referred>,
    model_tool: Option<&'a ModelTool>,
}

/// Says of every target how its pose is to be read, or that it is left.
///
/// # Errors
/// If the model's tool has a name that the program does not use.
pub(super) fn place(
    program: &mut Program,
    stated: Option<Pose>,
    model_tool: Option<&ModelTool>,
) -> Result<(), CompensateError> {
    let is_pose = |k: usize| matches!(program.targets[k].shape, Shape::Pose(_));
    let of_poses: Vec<&Use> = program.uses.iter().filter(|u| is_pose(u.target)).collect();
    let elsewhere = |frame: &&Referred| match frame {
        Referred::Named(name) => !program.frames.contains_key(name),
        _ => false,
    };
    let frames: BTreeSet<&Referred> = of_poses.iter().map(|u| &u.frame).collect();
    let known = Known {
        program,
        stated,
        elsewhere: frames.into_iter().filter(elsewhere).count(),
        tools: of_poses.iter().map(|u| u.tool.clone()).collect(),
        model_tool,
    };
    if let Some(ModelTool::Named(name)) = model_tool {
        known.check_name(name)?;
    }
    let mut placed = Vec::new();
    let mut taken: BTreeSet<(usize, String)> = BTreeSet::new();
    for k in 0..program.targets.len() {
        let mut uses: Vec<&Use> = program.uses.iter().filter(|u| u.target == k).collect();
        uses.dedup_by(|a, b| a.frame == b.frame && a.tool == b.tool);
        placed.push(if is_pose(k) {
            known.placed(&uses)
        } else {
            Ok(Placed::stated(None))
        });
        for one in uses.iter().filter(|_| is_pose(k)) {
            let kinds = [
                (&one.frame, &program.frames, "frame"),
                (&one.tool, &program.tools, "tool"),
            ];
            for (referred, names, what) in kinds {
                if let Referred::Named(name) = referred
                    && let Some(Declared { at, pose: Ok(_) }) = names.get(name)
                    && (what == "frame" || model_tool.is_some())
                {
                    taken.insert((
                        *at,
                        format!("{what} {name} is taken as it is declared here"),
                    ));
                }
            }
        }
    }
    for (target, placed) in program.targets.iter_mut().zip(placed) {
        match placed {
            Ok(placed) => target.placed = placed,
            Err(says) => target.left = Some(Left::new(Reason::Frame, says)),
        }
    }
    let notes = taken.into_iter().map(|(at, says)| Remark { at, says });
    program.notes.extend(notes);
    Ok(())
}

impl Placed {
    /// In the frame that the caller states, of the model's tool.
    pub(super) fn stated(frame: Option<Pose>) -> Self {
        Self {
            base_from_frame: frame.unwrap_or_else(Pose::identity),
            tool_from_model: Pose::identity(),
        }
    }

    /// Where a pose of the file puts the model's tool, in the robot's base.
    pub(super) fn goal(&self, written: &Goal) -> Goal {
        let rotation = written.rotation.unwrap_or_else(UnitQuaternion::identity);
        let pose = Pose::from_parts(written.position_mm.coords.into(), rotation);
        let pose = self.base_from_frame * pose * self.tool_from_model;
        Goal {
            position_mm: pose.translation.vector.into(),
            rotation: written.rotation.map(|_| pose.rotation),
        }
    }

    /// What the file writes for a pose of the model's tool in the robot's base.
    pub(super) fn written(&self, pose: &Pose) -> Pose {
        self.base_from_frame.inverse() * pose * self.tool_from_model.inverse()
    }
}

impl Known<'_> {
    fn check_name(&self, name: &str) -> Result<(), CompensateError> {
        let known = self.program.tools.contains_key(&name.to_lowercase());
        if known || self.tools.iter().any(|tool| tool.is(name)) {
            return Ok(());
        }
        Err(CompensateError::Tool {
            found: name.to_owned(),
            expected: self.tools_in_words(),
        })
    }

    fn tools_in_words(&self) -> String {
        let all: Vec<String> = self.tools.iter().map(ToString::to_string).collect();
        all.join(", ")
    }

    /// The reading of a pose that motions use so; in words where it is not known.
    fn placed(&self, uses: &[&Use]) -> Result<Placed, String> {
        match uses {
            [] => Ok(Placed::stated(self.stated)),
            [one] => Ok(Placed {
                base_from_frame: self.frame(&one.frame)?,
                tool_from_model: self.tool(&one.tool)?,
            }),
            [one, other, ..] => {
                let (what, a, b) = if one.frame == other.frame {
                    ("tools", &one.tool, &other.tool)
                } else {
                    ("frames", &one.frame, &other.frame)
                };
                Err(format!("motions go to it with the {what} {a} and {b}"))
            }
        }
    }

    fn frame(&self, referred: &Referred) -> Result<Pose, String> {
        let stated = self.stated.unwrap_or_else(Pose::identity);
        let name = match referred {
            Referred::Unsaid => return Ok(stated),
            Referred::Unknown(says) => return Err(format!("its frame is not known: {says}")),
            Referred::Named(name) => name,
        };
        match self.program.frames.get(name) {
            Some(declared) => declared.pose.clone(),
            None if self.stated.is_some() && self.elsewhere == 1 => Ok(stated),
            None => Err(format!(
                "its frame {name} is declared elsewhere: --frame says where it stands (one frame in a file)"
            )),
        }
    }

    fn tool(&self, referred: &Referred) -> Result<Pose, String> {
        let on_flange = |name: &str| match self.program.tools.get(&name.to_lowercase()) {
            Some(declared) => declared.pose.clone(),
            None => Err(format!("its tool {name} is declared elsewhere")),
        };
        if let Referred::Unknown(says) = referred {
            return Err(format!("its tool is not known: {says}"));
        }
        let model = match self.model_tool {
            None if self.tools.len() <= 1 => return Ok(Pose::identity()),
            None => {
                let all = self.tools_in_words();
                return Err(format!(
                    "poses of this file are of several tools ({all}): --tool says which one is the model's"
                ));
            }
            Some(ModelTool::Named(name)) if referred.is(name) => return Ok(Pose::identity()),
            Some(ModelTool::Named(name)) => on_flange(name)?,
            Some(ModelTool::OnFlange(pose)) => *pose,
        };
        let own = match referred {
            Referred::Named(name) => on_flange(name)?,
            _ => return Err("which tool it is of is not said".to_owned()),
        };
        Ok(own.inverse() * model)
    }
}
