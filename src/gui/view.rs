//! How the window looks at the document. Nothing here changes what is saved, and nothing here can
//! be undone.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::foreign::Foreign;
use super::keeping::disk::Fate;
use super::placing::Typed;
use super::preferences::Preferences;
use super::setup::SetupForm;
use super::simulate::Form;
use super::subject::Component;
use super::tasks::What;

/// The steps of the work, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) enum Step {
    /// What was measured.
    #[default]
    Session,
    /// Where the joint gets corrections of its own.
    Regions,
    /// What the robot really is.
    Identify,
    /// What is missing.
    Gap,
    /// What the controller needs.
    Export,
}

impl Step {
    /// All steps that exist.
    pub(crate) const ALL: [Self; 5] = [
        Self::Session,
        Self::Regions,
        Self::Identify,
        Self::Gap,
        Self::Export,
    ];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Session => "Session",
            Self::Regions => "Regions",
            Self::Identify => "Identify",
            Self::Gap => "Find the gap",
            Self::Export => "Export",
        }
    }

    /// The step after it.
    pub(crate) fn next(self) -> Option<Self> {
        let here = Self::ALL.iter().position(|step| *step == self)?;
        Self::ALL.get(here + 1).copied()
    }
}

/// The plane that the workspace is looked at in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Plane {
    /// From above.
    #[default]
    Xy,
    /// From the side.
    Xz,
    /// From the front.
    Yz,
}

impl Plane {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Xy, Self::Xz, Self::Yz];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Xy => "x y",
            Self::Xz => "x z",
            Self::Yz => "y z",
        }
    }

    /// The axes that it shows: to the right, and up.
    pub(crate) fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Xz => [0, 2],
            Self::Yz => [1, 2],
        }
    }

    /// The axis that it looks along.
    pub(crate) fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

/// What the upper plot shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Aspect {
    /// Where the robot was, in a plane.
    #[default]
    Plane,
    /// The deviation around the joint's angle.
    Around,
}

/// Unit of lengths on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum LengthUnit {
    /// Millimetres.
    #[default]
    Millimetre,
    /// Micrometres.
    Micrometre,
    /// Inches.
    Inch,
}

/// Unit of angles on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AngleUnit {
    /// Degrees.
    #[default]
    Degree,
    /// Radians.
    Radian,
}

/// What the right-hand side shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Side {
    /// What was identified.
    #[default]
    Results,
    /// Sample by sample.
    Samples,
}

/// What is charted below the workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chart {
    /// The deviation over the value of a joint.
    Angle,
    /// Over time.
    Time,
    /// Over the load.
    Load,
    /// Over the temperature.
    Temperature,
    /// How large the deviation is at each whole number of cycles per turn.
    Orders,
    /// How many samples deviate by how much.
    Histogram,
    /// The gap, step by step.
    Gap,
    /// What a found effect does, through what is left without it.
    Effect,
    /// The table that is exported.
    Table,
}

impl Chart {
    /// All of them, in the order in which they are offered.
    pub(crate) const ALL: [Self; 9] = [
        Self::Angle,
        Self::Time,
        Self::Load,
        Self::Temperature,
        Self::Orders,
        Self::Histogram,
        Self::Gap,
        Self::Effect,
        Self::Table,
    ];

    /// Its name where there is little room.
    pub(crate) fn short(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Time => "time",
            Self::Load => "load",
            Self::Temperature => "temperature",
            Self::Orders => "orders",
            Self::Histogram => "histogram",
            Self::Gap => "gap",
            Self::Effect => "effect",
            Self::Table => "table",
        }
    }

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Angle => "Deviation over angle",
            Self::Time => "Deviation over time",
            Self::Load => "Deviation over load",
            Self::Temperature => "Deviation over temperature",
            Self::Orders => "Order spectrum",
            Self::Histogram => "Histogram",
            Self::Gap => "Gap by step",
            Self::Effect => "Effect's own curve",
            Self::Table => "Correction table",
        }
    }

    /// Whether it shows one component of the deviation.
    pub(crate) fn has_components(self) -> bool {
        !matches!(self, Self::Gap | Self::Table)
    }
}

/// What the colour of an error vector says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Colouring {
    /// Before or after.
    #[default]
    State,
    /// The deviation's length.
    Deviation,
    /// Where it points to.
    Direction,
    /// The load.
    Load,
    /// The temperature.
    Temperature,
    /// The time.
    Time,
}

impl Colouring {
    /// All of them.
    pub(crate) const ALL: [Self; 6] = [
        Self::State,
        Self::Deviation,
        Self::Direction,
        Self::Load,
        Self::Temperature,
        Self::Time,
    ];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::State => "before and after",
            Self::Deviation => "deviation",
            Self::Direction => "direction",
            Self::Load => "load",
            Self::Temperature => "temperature",
            Self::Time => "time",
        }
    }

    /// The condition that it shows, in the order of [`crate::gui::layers::Cloud`].
    pub(crate) fn condition(self) -> Option<usize> {
        match self {
            Self::Load => Some(0),
            Self::Temperature => Some(1),
            Self::Time => Some(2),
            Self::State | Self::Deviation | Self::Direction => None,
        }
    }
}

/// What draws whatever there is once for each sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Canvas {
    /// Shapes of egui, thinned where there are many: nothing else is there.
    #[default]
    Shapes,
    /// The graphics processor, at most so many samples.
    Layers(usize),
}

/// A sheet over the window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sheet {
    /// A path to save to, as it is typed.
    SavePath {
        /// The path.
        path: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// A path to export to, as it is typed.
    ExportPath {
        /// What is exported.
        what: What,
        /// The path.
        path: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// A simulation, as it is filled in.
    Simulate(Form),
    /// The keyboard.
    Shortcuts,
    /// What is lost if this is done now.
    Unsaved(Then),
    /// This file is not what it was when it was read: whether to replace it all the same.
    Overwrite(PathBuf),
    /// What windows that are gone have left behind.
    Recover,
    /// A file that an instrument wrote.
    Import(Box<Foreign>),
    /// Units, digits, colours, size of text.
    Preferences,
    /// What the words mean.
    Words,
    /// What this program is.
    About,
}

/// What is done next, when nothing is in the way any more.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Then {
    /// Close the window.
    Leave,
    /// Open this file.
    Open(PathBuf),
    /// Open this example.
    Example(usize),
    /// Make a session.
    Simulate(Form),
}

/// A file that is open and is not on the disk as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OnDisk {
    /// The file.
    pub(crate) path: PathBuf,
    /// What became of it.
    pub(crate) fate: Fate,
}

/// Something that the user has to know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    /// Whether something went wrong.
    pub(crate) wrong: bool,
    /// In one line.
    pub(crate) title: String,
    /// What exactly, and what to do next; one line each.
    pub(crate) details: Vec<String>,
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ViewState {
    /// The chosen step.
    pub(crate) step: Step,
    /// The plane of the workspace plot.
    pub(crate) plane: Plane,
    /// Whether that plane is shown, or the deviation around the joint's angle.
    pub(crate) aspect: Aspect,
    /// How much longer than real error vectors are drawn; `None`: so that they are readable.
    pub(crate) magnification: Option<f64>,
    /// From 0, before, to 1, after.
    pub(crate) blend: f32,
    /// What the colour of error vectors says.
    pub(crate) colouring: Colouring,
    /// Whether the heat map is shown.
    pub(crate) heat: bool,
    /// What draws them.
    pub(crate) canvas: Canvas,
    /// The component in the deviation chart.
    pub(crate) component: Component,
    /// Whether the chart leaves out the deviation before, so that what is left can be seen.
    pub(crate) only_after: bool,
    /// The sample under the pointer, wherever that is.
    pub(crate) hovered: Option<usize>,
    /// The chosen sample.
    pub(crate) selected: Option<usize>,
    /// Samples that a finding is about, in ascending order.
    pub(crate) marked: Vec<usize>,
    /// What the right-hand side shows.
    pub(crate) side: Side,
    /// What is charted; `None`: what suits the step.
    pub(crate) chart: Option<Chart>,
    /// The joint that charts are about, counted from 0.
    pub(crate) joint: usize,
    /// The found effect whose curve is charted, by its place in the answer.
    pub(crate) effect: usize,
    /// Whether the right-hand side is open; `None`: where there is room for it.
    pub(crate) results: Option<bool>,
    /// Units, digits, colours, size of text.
    pub(crate) preferences: Preferences,
    /// Robot and instrument as they are being typed, while that makes no robot.
    pub(crate) setup: Option<Box<SetupForm>>,
    /// What is typed for boundaries of regions and could not be taken over, or not yet.
    pub(crate) typed: Vec<Typed>,
    /// An open file that is not what it was.
    pub(crate) on_disk: Option<OnDisk>,
    /// The sheet over the window.
    pub(crate) sheet: Option<Sheet>,
    /// Whether the window may close although something is not saved.
    pub(crate) leaving: bool,
    /// What the user has to know.
    pub(crate) message: Option<Message>,
    /// Counts up when the plots are to show everything again.
    pub(crate) fitted: u64,
}

impl ViewState {
    /// Whether the deviation around the joint's angle is shown.
    pub(crate) fn polar(&self) -> bool {
        self.aspect == Aspect::Around
    }
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            step: Step::default(),
            plane: Plane::default(),
            aspect: Aspect::default(),
            magnification: None,
            blend: 1.0,
            colouring: Colouring::default(),
            heat: false,
            canvas: Canvas::default(),
            component: Component::default(),
            only_after: false,
            hovered: None,
            selected: None,
            marked: Vec::new(),
            side: Side::default(),
            chart: None,
            joint: 0,
            effect: 0,
            results: None,
            preferences: Preferences::default(),
            setup: None,
            typed: Vec::new(),
            on_disk: None,
            sheet: None,
            leaving: false,
            message: None,
            fitted: 0,
        }
    }
}
