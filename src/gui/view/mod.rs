//! How the window looks at the document. Nothing here changes what is saved, and nothing here can
//! be undone.

use std::path::{Path, PathBuf};

use egui::{Context, ThemePreference, Vec2};
use serde::{Deserialize, Serialize};

use crate::gui::core::disk::{FileChange, name_of};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::overview::ROOM;
use crate::gui::core::setup::SetupForm;
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::ImportDraft;
use crate::present::numbers::Notation;
use crate::present::units::{AngleUnit, LengthUnit};
use crate::text::{Language, current};

mod camera;
pub(crate) use camera::{Ball, Camera, Facing, Plane};

named! {
    /// The steps of the work, in order.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
    pub(crate) enum Step {
        /// What was measured.
        #[default]
        Session = say!("Session"),
        /// Where the joint gets corrections of its own.
        Regions = say!("Regions"),
        /// What the robot really is.
        Identify = say!("Identify"),
        /// What is missing.
        Gap = say!("Diagnose"),
        /// What the controller needs.
        Export = say!("Export"),
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Step {
    /// The steps for a robot. Regions are a method for a single joint that turns.
    pub(crate) fn offered(single_revolute: bool) -> &'static [Self] {
        const WITHOUT_REGIONS: [Step; 4] = [Step::Session, Step::Identify, Step::Gap, Step::Export];
        if single_revolute {
            &Self::ALL
        } else {
            &WITHOUT_REGIONS
        }
    }
}

/// What the right-hand side shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Side {
    /// What was identified.
    #[default]
    Results,
    Samples,
}

/// A file that is open and is not on the disk as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OnDisk {
    pub(crate) path: PathBuf,
    /// What became of it.
    pub(crate) change: FileChange,
}

/// Counts up when a plot is to fit the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Fitted {
    /// The upper plot.
    pub(crate) workspace: u64,
    /// The charts.
    pub(crate) charts: u64,
}

/// One of the two in the middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Front {
    #[default]
    Workspace,
    Chart,
}

#[derive(Debug, Clone, PartialEq, Default)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "what is shown or not, each on its own"
)]
pub(crate) struct ViewState {
    pub(crate) step: Step,
    /// The plane of the workspace plot.
    pub(crate) plane: Plane,
    /// Whether the workspace is looked at in three dimensions instead.
    pub(crate) in_space: bool,
    /// From where the space is looked at.
    pub(crate) camera: Camera,
    /// How much longer than real error vectors are drawn; `None`: so that they are readable.
    pub(crate) magnification: Option<f64>,
    /// The workspace is drawn over so many points where all of it is in sight.
    pub(crate) plot_size: f64,
    /// From 0, before, to 1, after.
    pub(crate) blend: f32,
    /// Whether the heat map is shown.
    pub(crate) heat: bool,
    /// The component that charts show.
    pub(crate) component: Component,
    /// Whether the chart leaves out the deviation before, so that what is left can be seen.
    pub(crate) only_after: bool,
    /// The sample under the pointer, wherever that is.
    pub(crate) hovered: Option<usize>,
    pub(crate) selected: Option<usize>,
    /// Samples that a finding is about, in ascending order.
    pub(crate) marked: Vec<usize>,
    /// What the right-hand side shows.
    pub(crate) side: Side,
    /// How its samples are sorted.
    pub(crate) sorting: Sorting,
    /// The chart by its name; `None`: what suits the step.
    pub(crate) chart: Option<&'static str>,
    /// What is shown where there is no room for both.
    pub(crate) front: Front,
    /// The joint that charts are about, counted from 0.
    pub(crate) joint: usize,
    /// The found effect whose curve is charted, by its place in the answer.
    pub(crate) effect: usize,
    /// Whether the right-hand side is open; `None`: where there is room for it.
    pub(crate) results: Option<bool>,
    /// Units, digits, colours, size of text.
    pub(crate) preferences: Preferences,
    /// The sheet over the window.
    pub(crate) sheet: Option<Sheet>,
    /// Whether the window may close although something is not saved.
    pub(crate) leaving: bool,
    /// What the user has to know.
    pub(crate) message: Option<Message>,
    /// How often the plots were to fit the view.
    pub(crate) fitted: Fitted,
}

impl ViewState {
    /// Shows the workspace in this plane, and brings it into sight.
    pub(crate) fn look_in(&mut self, plane: Plane) {
        self.plane = plane;
        self.in_space = false;
        self.front = Front::Workspace;
    }

    /// The same in space; from where it begins, where it is looked at already.
    pub(crate) fn look_in_space(&mut self) {
        if self.in_space {
            self.camera = Camera::default();
        }
        self.in_space = true;
        self.front = Front::Workspace;
    }

    pub(crate) fn select(&mut self, sample: Option<usize>) {
        self.selected = sample;
        self.marked.clear();
    }

    /// Chooses these samples: a finding is about them.
    pub(crate) fn mark(&mut self, samples: Vec<usize>) {
        self.selected = samples.first().copied();
        self.marked = samples;
        self.side = Side::Samples;
    }

    /// Everything in sight again, in all plots.
    pub(crate) fn fit(&mut self) {
        self.fitted.charts += 1;
        self.fit_workspace();
    }

    pub(crate) fn fit_workspace(&mut self) {
        self.fitted.workspace += 1;
        self.camera = self.camera.fitted();
    }

    /// Leaves out what a session of so many samples does not have.
    pub(crate) fn stay_within(&mut self, samples: usize) {
        let there = |sample: &usize| *sample < samples;
        self.hovered = self.hovered.filter(there);
        self.selected = self.selected.filter(there);
        self.marked.retain(there);
    }

    /// The samples that are chosen.
    pub(crate) fn chosen(&self) -> Vec<usize> {
        if self.marked.is_empty() {
            self.selected.into_iter().collect()
        } else {
            self.marked.clone()
        }
    }

    /// The axes of the view of the workspace: in space those in the base frame.
    pub(crate) fn facing(&self) -> Facing {
        if self.in_space {
            self.camera.facing()
        } else {
            self.plane.facing()
        }
    }

    pub(crate) fn new() -> Self {
        Self {
            plot_size: ROOM,
            blend: 1.0,
            ..Self::default()
        }
    }
}

/// How the rows of the samples are sorted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Sorting {
    /// By which column; the first is the order of measuring.
    pub(crate) by: usize,
    pub(crate) descending: bool,
}

/// A sheet over the window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sheet {
    /// A path to write to, as it is typed.
    Path {
        what: What,
        path: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// A simulation, as it is filled in.
    Simulate(Form),
    /// A robot as it is typed, with what it was measured with.
    Setup {
        form: Box<SetupForm>,
        /// As it was opened.
        opened: Box<SetupForm>,
    },
    /// Whether what was typed on this one is discarded.
    Discard(Box<Self>),
    /// What is lost if this is done now.
    Unsaved(NextAction),
    /// This file is not what it was when it was read: whether to replace it all the same.
    Overwrite(PathBuf),
    /// A file that an instrument wrote.
    Import(Box<ImportDraft>),
    About,
    /// Targets that were corrected.
    Compensation,
    /// What the report states besides its measurements.
    Details,
    Preferences,
    /// What windows that are gone have left behind.
    Recovery,
    /// The library of robots.
    Robots,
    /// The glossary.
    Words,
}

impl Sheet {
    /// A robot that is typed, as it is opened.
    pub(crate) fn set_up(form: SetupForm) -> Self {
        let form = Box::new(form);
        Self::Setup {
            opened: form.clone(),
            form,
        }
    }

    /// The sheet that it was opened from: what one comes back to without an answer.
    pub(crate) fn before(&self) -> Option<Self> {
        match self {
            Self::Simulate(form) if form.is_of_the_lamp() => None,
            Self::Setup { form, .. } if form.measured.is_some() => None,
            Self::Simulate(_) | Self::Setup { .. } => Some(Self::Robots),
            Self::Discard(typed) => Some((**typed).clone()),
            _ => None,
        }
    }

    /// Where Escape leads: what was typed is not discarded without a question.
    pub(crate) fn escaped(&self) -> Option<Self> {
        let typed = match self {
            Self::Simulate(form) => *form != form.untouched(),
            Self::Setup { form, opened } => form != opened,
            _ => false,
        };
        if typed {
            Some(Self::Discard(Box::new(self.clone())))
        } else {
            self.before()
        }
    }

    /// Whether it has many fields: Escape leaves the one that is typed into, and only then the sheet.
    pub(crate) fn is_a_form(&self) -> bool {
        matches!(
            self,
            Self::Simulate(_) | Self::Setup { .. } | Self::Import(_) | Self::Details
        )
    }

    /// Whether it holds what was typed or chosen in it. A click beside it, which may be meant for something else, does
    /// not close it; Escape and *Cancel* do.
    pub(crate) fn holds_entries(&self) -> bool {
        !matches!(
            self,
            Self::About | Self::Preferences | Self::Robots | Self::Words
        )
    }
}

/// What is done next, when nothing is in the way any more.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum NextAction {
    Leave,
    Open(PathBuf),
    Example(usize),
    Simulate(Form),
}

/// A message to the user: an error that stays, or a notice that goes by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    /// Whether something went wrong.
    pub(crate) wrong: bool,
    /// In one line.
    pub(crate) title: String,
    /// What exactly, and what to do next; one line each.
    pub(crate) details: Vec<String>,
    /// The file that was written.
    pub(crate) file: Option<PathBuf>,
}

impl Message {
    /// Something went wrong.
    pub(crate) fn wrong(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: true,
            ..Self::done(title, details)
        }
    }

    /// Something was done.
    pub(crate) fn done(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: false,
            title: title.into(),
            details,
            file: None,
        }
    }

    /// A file was written.
    pub(crate) fn saved(path: &Path, details: Vec<String>) -> Self {
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        Self {
            file: Some(whole),
            ..Self::done(say!("Saved {name}", name = name_of(path)), details)
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum What {
    /// The session, with its samples.
    Session,
    /// The table for the controller.
    Table,
    /// The model itself.
    Model,
    /// Poses to measure next.
    Poses,
    /// The calibration report.
    Report(About),
    Picture(Plot),
    /// A table of targets or a robot program, corrected.
    Targets,
    /// A robot of the library, by its name.
    Robot(&'static str),
    /// The robot that was typed last.
    TypedRobot,
}

impl What {
    /// What saving it is called.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Session => say!("Save session"),
            Self::Table => say!("Save table"),
            Self::Model => say!("Save model"),
            Self::Poses => say!("Save measuring list"),
            Self::Report(_) => say!("Save report"),
            Self::Picture(_) => say!("Save picture"),
            Self::Targets => say!("Save corrected file"),
            Self::Robot(_) | Self::TypedRobot => say!("Save robot file"),
        }
    }
}

/// What a report is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum About {
    /// The session: what was measured, what was found, what stays open.
    Session,
    /// The model that is exported, by itself.
    Model,
}

/// A plot that can be saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Plot {
    /// Where the points are, and how far off, as it is seen.
    Workspace,
    /// The chart of this name, as it is shown.
    Chart(&'static str),
}

impl Plot {
    /// Its name, as it stands within a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Workspace => "workspace",
            Self::Chart(name) => name,
        }
    }

    /// What its file ends in: a chart is drawn, the workspace is a picture of the screen.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Workspace => "png",
            Self::Chart(_) => "svg",
        }
    }
}

// What the user wants to see: units, digits, light or dark, size of text. Kept from one day to the next by
// `file_state`.

/// Light, dark, or as the system has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Theme {
    #[default]
    System,
    /// For a bright hall.
    Light,
    /// For a dim one.
    Dark,
}

impl Theme {
    /// What egui calls it.
    pub(crate) fn preference(self) -> ThemePreference {
        match self {
            Self::System => ThemePreference::System,
            Self::Light => ThemePreference::Light,
            Self::Dark => ThemePreference::Dark,
        }
    }
}

/// Smallest and largest size of text, in parts of the usual one.
pub(crate) const ZOOM: std::ops::RangeInclusive<f32> = 0.6..=3.0;
/// The smallest window in which everything fits, points (1280 × 800 with text of 200 %, see `tests/window/sizes.rs`):
/// larger text would overlap.
const LEAST_ROOM: Vec2 = Vec2::new(640.0, 400.0);

/// The largest size of text that this window has room for.
pub(crate) fn largest_zoom(ctx: &Context) -> f32 {
    let usual = ctx.zoom_factor() * ctx.content_rect().size();
    let fits = (usual / LEAST_ROOM).min_elem();
    fits.clamp(1.0, *ZOOM.end())
}

/// Most decimals of a length.
const MOST_DECIMALS: u8 = 6;

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Preferences {
    /// `None`: that of the system, where it is offered.
    pub(crate) language: Option<Language>,
    pub(crate) length: LengthUnit,
    pub(crate) angle: AngleUnit,
    /// Decimals of lengths; `None`: as many as can be read.
    pub(crate) decimals: Option<u8>,
    /// Whether decimals follow a comma; `None`: as the language has it.
    pub(crate) comma: Option<bool>,
    /// Light or dark.
    pub(crate) theme: Theme,
    /// Size of text, in parts of the usual one.
    pub(crate) zoom: f32,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            language: None,
            length: LengthUnit::default(),
            angle: AngleUnit::default(),
            decimals: None,
            comma: None,
            theme: Theme::default(),
            zoom: 1.0,
        }
    }
}

impl Preferences {
    /// How numbers are written in the language that is spoken.
    pub(crate) fn notation(&self) -> Notation {
        Notation {
            decimals: self.decimals,
            comma: self.comma.unwrap_or(current() == Language::German),
        }
    }

    /// The same, with every number in the range that it can have.
    #[must_use]
    pub(crate) fn sound(mut self) -> Self {
        self.decimals = self.decimals.map(|d| d.min(MOST_DECIMALS));
        self.zoom = if self.zoom.is_finite() {
            self.zoom.clamp(*ZOOM.start(), *ZOOM.end())
        } else {
            1.0
        };
        self
    }
}
