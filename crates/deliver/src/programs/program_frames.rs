//! Which tool, base and load hold for a program: its own, those of the model, or ones that the caller gives.
//!
//! A controller brings the tool that the *program* declares to the poses of the program; a model was
//! identified for the tool of its *session*. If they differ and the difference is not noticed, other joint
//! values are solved than the controller will take, and the corrected program is worse than it need be.
//! So the numbers of the program are compared with the model's, and a difference is a question
//! ([`Difference`]) until the caller answers it ([`ProgramFrames`]).
//!
//! ```text
//! flange_from_tool (program)  against  flange_from_model_tool   within 0.05 mm and 0.01°
//! base_from_frame  (program)  against  the identity             the same
//! load (program)              against  the loads of the session
//! ```
//!
//! The model's tool is on the flange where its robot is described by Denavit–Hartenberg rows with a tool
//! behind them; of other robots the frame of the tool is taken for the flange, unless the caller says where
//! on the flange it is ([`ModelTool::OnFlange`]).

use crate::kinematics::Pose;
use crate::text::Text as Sentence;

/// What holds where the program's number is not the model's.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Precedence<T> {
    /// It is not settled: a difference is refused.
    #[default]
    Unsettled,
    /// The model's, whatever the program says.
    Model,
    /// The program's, as it writes it.
    Program,
    /// This one, whatever the program says.
    Given(T),
}

/// What external axes do that differ between targets and that the model does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ExternalAxes {
    /// It is not said, and asked.
    #[default]
    Asked,
    /// They carry the robot: of poses nothing is known without them in the model.
    CarryRobot,
    /// They move something else (a positioner, a gripper): the robot's base stands.
    Other,
}

/// Which tool, base and load hold for a program. The default settles nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ProgramFrames {
    /// Pose of the tool (TCP) on the flange. `Model`: the program's tool is the model's.
    pub tool: Precedence<Pose>,
    /// Pose of the frame of the poses (work object, base, user frame) in the robot's base. `Model`: the
    /// base itself.
    pub frame: Precedence<Pose>,
    /// Load at the tool's origin, kg. `Model`: [`crate::programs::Request::load_kg`].
    pub load: Precedence<f64>,
    /// What external axes do that differ between targets.
    pub external: ExternalAxes,
}

impl ProgramFrames {
    /// The program's tool is the model's, its frames are as it declares them, and the load is the caller's:
    /// nothing is compared.
    pub fn as_declared() -> Self {
        Self {
            tool: Precedence::Model,
            frame: Precedence::Program,
            load: Precedence::Model,
            ..Self::default()
        }
    }

    /// Everything as in the model.
    pub fn as_modelled() -> Self {
        Self {
            tool: Precedence::Model,
            frame: Precedence::Model,
            load: Precedence::Model,
            ..Self::default()
        }
    }

    /// Everything as the program writes it.
    pub fn as_programmed() -> Self {
        Self {
            tool: Precedence::Program,
            frame: Precedence::Program,
            load: Precedence::Program,
            ..Self::default()
        }
    }
}

named! {
    /// What of a program can differ from the model.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum DifferingNumber {
        /// The tool on the flange.
        Tool = "tool",
        /// The frame of the poses in the base.
        Frame = "frame",
        /// The load.
        Load = "load",
        /// An external axis.
        External = "external",
    }
    /// Its name, which is also that of the option that settles it.
    pub fn name;
}

/// A number of the program that is not the model's.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// What differs.
    pub what: DifferingNumber,
    /// Where the program says it: line and column, from 1.
    pub place: (u64, u64),
    /// What the program calls it.
    pub name: String,
    /// The program's value, in words.
    pub program: Sentence,
    /// The model's value, in words.
    pub model: Sentence,
}

impl Difference {
    /// In a sentence.
    pub fn describe(&self) -> Sentence {
        let (line, column) = self.place;
        // A name that is only the numbers again says nothing.
        let named = !self.name.starts_with('{') && !self.name.starts_with("p[");
        let (name, program, model) = (&self.name, &self.program, &self.model);
        let says = match self.what {
            DifferingNumber::Tool | DifferingNumber::Frame | DifferingNumber::Load => {
                let what = match self.what {
                    DifferingNumber::Tool if !named => text!("the tool"),
                    DifferingNumber::Frame if !named => text!("the frame"),
                    _ => Sentence::verbatim(name),
                };
                text!(
                    "{name} is {program} in the program and {model} in the model",
                    name = what,
                    program,
                    model
                )
            }
            DifferingNumber::External => text!(
                "the external axis {name} is at {program}, and the model does not have it",
                name,
                program
            ),
        };
        text!("line {line}, column {column}: {says}", line, column, says)
    }
}

displays_what_it_says!(Difference);

/// How the tool of poses is to be read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ToolReading {
    /// The only tool of the file is the model's.
    OnlyOne,
    /// The tool of this name is the model's; others are as they are declared.
    Named(String),
    /// Tools are as they are declared, the model's is here on the flange; `lenient`: the only tool of a file
    /// that has no numbers is the model's.
    Declared {
        /// Pose of the model's tool on the flange.
        model: Pose,
        lenient: bool,
    },
    /// Every pose is of one tool: where the model's tool is in it.
    Given(Pose),
}

/// How a program is to be read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reading {
    /// Frame of the poses for which the file declares none, in the base.
    pub(super) stated: Option<Pose>,
    /// One frame for all poses, whatever the file declares.
    pub(super) all_frames: Option<Pose>,
    pub(super) tool: ToolReading,
    /// Load where the file says none for a target, kg.
    pub(super) load_kg: f64,
    /// Why poses are not known: an axis carries the robot that the model does not have.
    pub(super) carried: Option<Sentence>,
    /// What was settled, in words.
    pub(super) notes: Vec<Sentence>,
}

/// Several differences, for a message: a line for each, and how to settle them.
#[derive(Debug, Clone, PartialEq)]
pub struct Differences(pub Vec<Difference>);

impl Differences {
    /// A line for each, and how to settle them.
    pub fn describe(&self) -> Sentence {
        let any = |what| self.0.iter().any(|d| d.what == what);
        let options = [
            (DifferingNumber::Tool, "--tool X,Y,Z,A,B,C"),
            (DifferingNumber::Frame, "--frame X,Y,Z,A,B,C"),
            (DifferingNumber::Load, "--load KG"),
        ];
        let own = options.into_iter().filter(|(what, _)| any(*what));
        let own: Vec<&str> = own.map(|(_, option)| option).collect();
        let held = (!own.is_empty()).then(|| {
            text!(
                "choose which holds: {options}, --as-programmed (as the program writes it) or --as-modelled (as in the model, whatever the program says)",
                options = own.join(", ")
            )
        });
        let external = any(DifferingNumber::External).then(|| {
            text!("say what the axis moves: --external carries-robot (a rail under the robot) or --external other (a positioner, a gripper)")
        });
        let each = self.0.iter().map(Difference::describe);
        Sentence::listed(each.chain(held).chain(external), "\n")
    }
}

displays_what_it_says!(Differences);

/// Which of a program's tools is the one of the model.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelTool {
    /// The tool of this name.
    Named(String),
    /// The one that sits here on the flange.
    OnFlange(Pose),
}
