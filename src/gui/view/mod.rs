//! How the window looks at the document. Nothing here changes what is saved, and nothing here can
//! be undone.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
use std::path::{Path, PathBuf};

use egui::Id;
use egui_tiles::{Container, Linear, LinearDir, SimplificationOptions, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

use crate::gui::core::disk::{FileChange, name_of};
use crate::gui::core::document::plain;
use crate::gui::core::loaded_session::Component;
use crate::gui::core::overview::ROOM;
use crate::gui::core::quantity::Quantity;
use crate::gui::core::robot_table::{RobotTable, SetupForm};
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::ImportDraft;
use crate::gui::preferences::Preferences;
use crate::lanes::dot;
use crate::language::known_words;

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

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ViewState {
    pub(crate) step: Step,
    /// The plane of the workspace plot.
    pub(crate) plane: Plane,
    /// Whether that plane is shown, or the space.
    pub(crate) aspect: Aspect,
    /// From where the space is looked at.
    pub(crate) camera: Camera,
    /// How much longer than real error vectors are drawn; `None`: so that they are readable.
    pub(crate) magnification: Option<f64>,
    /// The workspace is drawn over so many points where all of it is in sight.
    pub(crate) plot_size: f64,
    /// From 0, before, to 1, after.
    pub(crate) blend: f32,
    /// What the colour of error vectors says.
    pub(crate) colouring: Colouring,
    /// Whether the heat map is shown.
    pub(crate) heat: bool,
    /// So many samples can be drawn at once.
    pub(crate) most_drawn: usize,
    /// The component that is looked at, where a chart has none of its own.
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
    /// Workspace and charts.
    pub(crate) panes: Panes,
    /// The joint that charts are about that have none of their own, counted from 0.
    pub(crate) joint: usize,
    /// The found effect whose curve is charted, by its place in the answer.
    pub(crate) effect: usize,
    /// Whether the right-hand side is open; `None`: where there is room for it.
    pub(crate) results: Option<bool>,
    /// Units, digits, colours, size of text.
    pub(crate) preferences: Preferences,
    /// Robot and instrument as they are being typed, while that makes no robot.
    pub(crate) setup: Option<Box<SetupForm>>,
    /// An open file that is not what it was.
    pub(crate) on_disk: Option<OnDisk>,
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
        self.look(Aspect::Plane);
    }

    /// The same in space, from this side if one is named.
    pub(crate) fn look_from(&mut self, from: Option<Standard>) {
        self.look(Aspect::Space);
        if let Some(from) = from {
            self.camera = self.camera.seen_from(from);
        }
    }

    fn look(&mut self, aspect: Aspect) {
        self.aspect = aspect;
        self.panes.activate(self.panes.workspace());
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

    /// Whether the workspace is looked at in three dimensions.
    pub(crate) fn in_space(&self) -> bool {
        self.aspect == Aspect::Space
    }

    /// The axes of the view of the workspace: in space those in the base frame.
    pub(crate) fn facing(&self) -> Facing {
        if self.in_space() {
            self.camera.facing()
        } else {
            self.plane.facing()
        }
    }
}

impl ViewState {
    pub(crate) fn new() -> Self {
        Self {
            plot_size: ROOM,
            blend: 1.0,
            most_drawn: usize::MAX,
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
    /// A robot, as its table is typed.
    RobotTable {
        table: Box<RobotTable>,
        /// As it was opened.
        opened: Box<RobotTable>,
    },
    /// Whether what was typed on this one is discarded.
    Discard(Box<Self>),
    /// What is lost if this is done now.
    Unsaved(NextAction),
    /// This file is not what it was when it was read: whether to replace it all the same.
    Overwrite(PathBuf),
    /// A file that an instrument wrote.
    Import(Box<ImportDraft>),
    /// One that keeps nothing of its own: its file in `dialogs`.
    Named(&'static str),
}

impl Sheet {
    /// Targets that were corrected.
    pub(crate) const COMPENSATION: Self = Self::Named("compensation");
    /// What the report states besides its measurements.
    pub(crate) const DETAILS: Self = Self::Named("details");
    /// What became of the machine.
    pub(crate) const HISTORY: Self = Self::Named("history");
    /// The library of robots.
    pub(crate) const ROBOTS: Self = Self::Named("robots");
    /// What windows that are gone have left behind.
    pub(crate) const RECOVERY: Self = Self::Named("recovery");

    /// The sheet that it was opened from: what one comes back to without an answer.
    pub(crate) fn before(&self) -> Option<Self> {
        match self {
            Self::Simulate(form) if form.is_of_the_lamp() => None,
            Self::Simulate(_) | Self::RobotTable { .. } => Some(Self::ROBOTS),
            Self::Discard(typed) => Some((**typed).clone()),
            _ => None,
        }
    }

    /// Where Escape leads: what was typed is not discarded without a question.
    pub(crate) fn escaped(&self) -> Option<Self> {
        let typed = match self {
            Self::Simulate(form) => *form != form.untouched(),
            Self::RobotTable { table, opened } => table != opened,
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
            Self::Simulate(_) | Self::RobotTable { .. } | Self::Import(_) | &Self::DETAILS
        )
    }

    /// Whether it holds what was typed or chosen in it. A click beside it, which may be meant for something else, does
    /// not close it; Escape and *Cancel* do.
    pub(crate) fn holds_entries(&self) -> bool {
        match self {
            Self::Named(name) => ["compensation", "details", "recovery"].contains(name),
            _ => true,
        }
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
    /// What the chart of this name shows, as a table.
    Numbers(&'static str),
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
            Self::Numbers(_) => say!("Save data"),
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

    /// Its name in the language of the window.
    pub(crate) fn title(self) -> String {
        known_words("plot", self.name()).unwrap_or_else(|| self.name().to_owned())
    }

    /// What its file is called unless the user says otherwise.
    pub(crate) fn file_name(self, session: &str, ending: &str) -> String {
        let session = plain(session);
        format!("{session}-{}.{ending}", plain(self.name()))
    }
}

// What stands in the middle of the window: the workspace and charts, as tiles beside and below each other.
//
// The tiles are kept beside the preferences, so what is read is looked through before it is shown: one workspace, not
// too many charts, each tile in one place.

/// Charts at once, at most.
const MOST_CHARTS: usize = 6;

/// The workspace's share of what it shares with the first chart.
const WORKSPACE: f32 = 0.66;

/// A pane by its tile, which it keeps while it is moved.
pub(crate) type Key = TileId;

/// What stands in a pane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Pane {
    Workspace,
    Chart(ChartPane),
}

/// How a chart is looked at.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct ChartPane {
    /// The chart by its name; `None`: what suits the step.
    pub(crate) chart: Option<String>,
    /// `None`: that of the view.
    pub(crate) component: Option<Component>,
    /// The joint that it is about, counted from 0; `None`: that of the view.
    pub(crate) joint: Option<usize>,
    /// What a scatter has across and upwards; `None`: as it begins.
    pub(crate) axes: Option<[Quantity; 2]>,
    /// Counts up when it is to show everything.
    #[serde(skip)]
    pub(crate) fitted: u64,
}

/// An edge of a pane, or of the whole middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    Left,
    Right,
    Top,
    Bottom,
}

impl Edge {
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Top, Self::Bottom];

    fn direction(self) -> LinearDir {
        match self {
            Self::Left | Self::Right => LinearDir::Horizontal,
            Self::Top | Self::Bottom => LinearDir::Vertical,
        }
    }
}

/// All panes, and which of them the keys are for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Panes {
    pub(crate) tree: Tree<Pane>,
    /// The pane that keys are for; without one it is the workspace.
    #[serde(skip)]
    active: Option<Key>,
    /// The chart that was active last.
    #[serde(skip)]
    chart: Option<Key>,
    /// Whether a line between them is being pulled.
    #[serde(skip)]
    pub(crate) pulled: bool,
}

impl Default for Panes {
    /// The workspace, and below it the chart that suits the step.
    fn default() -> Self {
        let mut tiles = Tiles::default();
        let workspace = tiles.insert_pane(Pane::Workspace);
        let chart = tiles.insert_pane(Pane::Chart(ChartPane::default()));
        let both = Linear::new_binary(LinearDir::Vertical, [workspace, chart], WORKSPACE);
        let root = tiles.insert_container(both);
        Self {
            tree: Tree::new(Id::unique("panes"), root, tiles),
            active: None,
            chart: None,
            pulled: false,
        }
    }
}

impl Panes {
    /// As they were kept, with those charts only that are `known`; the usual ones where they cannot be shown.
    pub(crate) fn sound(mut self, known: impl Fn(&str) -> bool) -> Self {
        if !self.can_be_shown() {
            return Self::default();
        }
        self.tree.tiles.recompute_next_tile_id();
        let is_gone = |chart: &ChartPane| !chart.chart.as_deref().is_none_or(&known);
        let gone = self.charts().filter(|(_, chart)| is_gone(chart));
        for key in gone.map(|(key, _)| key).collect::<Vec<_>>() {
            self.close(key);
        }
        self
    }

    /// Whether there is one workspace, not too many charts, and each tile in one place.
    fn can_be_shown(&self) -> bool {
        let tiles = &self.tree.tiles;
        let mut seen: Vec<Key> = self.tree.root.into_iter().collect();
        let mut is_new = |key: Key| {
            let new = !seen.contains(&key);
            seen.push(key);
            new
        };
        let each_once = tiles.iter().all(|(key, tile)| match tile {
            Tile::Pane(_) => key.0 < 1 << 32,
            Tile::Container(Container::Linear(linear)) => {
                let mut shares = linear.shares.iter();
                key.0 < 1 << 32
                    && shares.all(|(_, share)| (1e-3..1e3).contains(share))
                    && linear.children.iter().all(|child| is_new(*child))
            }
            Tile::Container(Container::Tabs(_) | Container::Grid(_)) => false,
        });
        each_once && {
            let all = self.panes();
            let charts = self.charts().count();
            all.len() == charts + 1 && charts <= MOST_CHARTS
        }
    }

    /// All panes, from the left to the right and down.
    pub(crate) fn panes(&self) -> Vec<(Key, &Pane)> {
        let mut all = Vec::new();
        let mut open: Vec<Key> = self.tree.root.into_iter().collect();
        while let Some(key) = open.pop() {
            match self.tree.tiles.get(key) {
                Some(Tile::Pane(pane)) => all.push((key, pane)),
                Some(Tile::Container(split)) => open.extend(split.children_vec().iter().rev()),
                None => {}
            }
        }
        all
    }

    /// All charts.
    pub(crate) fn charts(&self) -> impl Iterator<Item = (Key, &ChartPane)> {
        self.panes()
            .into_iter()
            .filter_map(|(key, pane)| match pane {
                Pane::Chart(chart) => Some((key, chart)),
                Pane::Workspace => None,
            })
    }

    pub(crate) fn pane(&self, key: Key) -> Option<&Pane> {
        self.tree.tiles.get_pane(&key)
    }

    /// The chart in a pane, to be changed.
    pub(crate) fn chart_mut(&mut self, key: Key) -> Option<&mut ChartPane> {
        match self.tree.tiles.get_mut(key)? {
            Tile::Pane(Pane::Chart(chart)) => Some(chart),
            Tile::Pane(Pane::Workspace) | Tile::Container(_) => None,
        }
    }

    /// The chart in a pane shows everything again.
    pub(crate) fn fit(&mut self, key: Key) {
        if let Some(pane) = self.chart_mut(key) {
            pane.fitted += 1;
        }
    }

    pub(crate) fn workspace(&self) -> Key {
        let all = self.panes();
        let workspace = all.iter().find(|(_, pane)| **pane == Pane::Workspace);
        workspace.map_or(TileId::from_u64(0), |(key, _)| *key)
    }

    /// The pane that keys are for.
    pub(crate) fn active(&self) -> Key {
        let active = self.active.filter(|key| self.pane(*key).is_some());
        active.unwrap_or_else(|| self.workspace())
    }

    /// The chart that is active, or was so last.
    pub(crate) fn active_chart(&self) -> Option<(Key, &ChartPane)> {
        let last = self.charts().find(|(key, _)| Some(*key) == self.chart);
        last.or_else(|| self.charts().next())
    }

    pub(crate) fn activate(&mut self, key: Key) {
        match self.pane(key) {
            Some(Pane::Workspace) => self.active = Some(key),
            Some(Pane::Chart(_)) => (self.active, self.chart) = (Some(key), Some(key)),
            None => {}
        }
    }

    /// The next pane becomes the active one.
    pub(crate) fn activate_next(&mut self) {
        let keys: Vec<Key> = self.panes().iter().map(|(key, _)| *key).collect();
        let here = keys.iter().position(|key| *key == self.active());
        let next = here.map_or(0, |here| (here + 1) % keys.len());
        self.activate(keys[next]);
    }

    /// Whether there is room for another chart.
    pub(crate) fn has_room(&self) -> bool {
        self.charts().count() < MOST_CHARTS
    }

    /// Puts a chart at an edge of a pane, in half of its room.
    pub(crate) fn split(&mut self, key: Key, edge: Edge, chart: ChartPane) {
        if !self.has_room() || self.pane(key).is_none() {
            return;
        }
        let new = self.tree.tiles.insert_pane(Pane::Chart(chart));
        self.put(new, 0.5, key, edge);
        self.activate(new);
    }

    /// Takes a chart away; its neighbours take its room.
    pub(crate) fn close(&mut self, key: Key) {
        let keys: Vec<Key> = self.charts().map(|(key, _)| key).collect();
        let Some(here) = keys.iter().position(|chart| *chart == key) else {
            return;
        };
        let next = keys.get(here + 1).or(keys[..here].last());
        self.tree.remove_recursively(key);
        self.simplify();
        self.activate(next.copied().unwrap_or_else(|| self.workspace()));
    }

    /// Puts a pane at an edge of the whole middle.
    pub(crate) fn move_to(&mut self, key: Key, edge: Edge) {
        let parent = self.tree.tiles.parent_of(key);
        let Some(split) = parent.and_then(|parent| self.container(parent)) else {
            return;
        };
        split.remove_child(key);
        self.simplify();
        let share = match self.pane(key) {
            Some(Pane::Workspace) => WORKSPACE,
            _ => 1.0 - WORKSPACE,
        };
        if let Some(root) = self.tree.root {
            self.put(key, share, root, edge);
        }
        self.activate(key);
    }

    /// Puts a tile at an edge of another, with this share of what that has.
    fn put(&mut self, new: Key, share: f32, at: Key, edge: Edge) {
        let parent = self.tree.tiles.parent_of(at);
        let (children, first) = match edge {
            Edge::Left | Edge::Top => ([new, at], share),
            Edge::Right | Edge::Bottom => ([at, new], 1.0 - share),
        };
        let both = Linear::new_binary(edge.direction(), children, first);
        let both = self.tree.tiles.insert_container(both);
        if let Some(split) = parent.and_then(|parent| self.container(parent)) {
            let _ = split.replace_child(at, both);
        } else {
            self.tree.root = Some(both);
        }
        self.simplify();
    }

    fn container(&mut self, key: Key) -> Option<&mut Container> {
        match self.tree.tiles.get_mut(key)? {
            Tile::Container(container) => Some(container),
            Tile::Pane(_) => None,
        }
    }

    /// Nothing is alone in a split, and no split stands within one of its own direction.
    fn simplify(&mut self) {
        self.tree.simplify(&SimplificationOptions::default());
    }

    /// Takes tiles that were dragged.
    pub(crate) fn take(&mut self, tree: Tree<Pane>) {
        let next = Self { tree, ..*self };
        if next.can_be_shown() {
            *self = next;
        }
    }

    /// Whether the panes are as they are by default.
    pub(crate) fn are_usual(&self) -> bool {
        self.outline() == Self::default().outline()
    }

    /// Panes, splits and shares in words, whatever their tiles are called: `(workspace 0.66 chart 0.34)` where one
    /// stands below the other, with square brackets side by side.
    pub(crate) fn outline(&self) -> String {
        self.tree
            .root
            .map_or(String::new(), |root| self.outline_of(root))
    }

    fn outline_of(&self, key: Key) -> String {
        match self.tree.tiles.get(key) {
            Some(Tile::Pane(Pane::Workspace)) => "workspace".to_owned(),
            Some(Tile::Pane(Pane::Chart(chart))) if *chart == ChartPane::default() => {
                "chart".to_owned()
            }
            Some(Tile::Pane(Pane::Chart(chart))) => chart.chart.clone().unwrap_or_default(),
            Some(Tile::Container(Container::Linear(linear))) => {
                let shares = linear.shares.split(&linear.children, 1.0);
                let parts = linear.children.iter().zip(shares);
                let parts =
                    parts.map(|(child, share)| format!("{} {share:.2}", self.outline_of(*child)));
                let parts = parts.collect::<Vec<_>>().join(" ");
                match linear.dir {
                    LinearDir::Horizontal => format!("[{parts}]"),
                    LinearDir::Vertical => format!("({parts})"),
                }
            }
            _ => String::new(),
        }
    }
}

// From where the workspace is looked at, on a plane or in three dimensions, and what its colours say.
//
// The projection is parallel, so that lengths across the line of sight can be read everywhere. With
// azimuth a and elevation e the unit vectors of the view are, in the base frame (z up),
//
// ```text
// towards = (cos e cos a, cos e sin a, sin e)      from the workspace towards the viewer
// right   = (−sin a, cos a, 0)
// up      = towards × right
// ```
//
// so that z never leans to the side. The view fits a sphere around everything that is drawn: the
// scale stays the same while the camera orbits.

/// Axes of a view: orthogonal unit vectors, right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facing {
    /// To the right on the screen.
    pub(crate) right: [f64; 3],
    /// Up on the screen.
    pub(crate) up: [f64; 3],
    /// Out of the screen, towards the viewer.
    pub(crate) towards: [f64; 3],
}

impl Facing {
    /// The same view with each of its axes exchanged.
    pub(crate) fn map(self, of: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self {
            right: of(self.right),
            up: of(self.up),
            towards: of(self.towards),
        }
    }

    /// A point or vector as it is seen: to the right and up, mm.
    pub(crate) fn flat(&self, p: [f64; 3]) -> [f64; 2] {
        [dot(self.right, p), dot(self.up, p)]
    }

    /// How near to the viewer a point is, mm; the larger the nearer.
    pub(crate) fn nearness(&self, p: [f64; 3]) -> f64 {
        dot(self.towards, p)
    }

    /// Smallest and largest corner of a box as it is seen, mm. `ends` are the box's corners with
    /// the smallest and with the largest coordinates.
    pub(crate) fn flat_box(&self, ends: [[f64; 3]; 2]) -> [[f64; 2]; 2] {
        let mut seen = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in 0..8_usize {
            let p = self.flat([0, 1, 2].map(|k| ends[corner >> k & 1][k]));
            for k in 0..2 {
                seen[0][k] = seen[0][k].min(p[k]);
                seen[1][k] = seen[1][k].max(p[k]);
            }
        }
        seen
    }
}

named! {
    /// A view that has a name.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(crate) enum Standard {
        Isometric = say!("isometric"),
        /// Against z, x to the right.
        Top = say!("top"),
        /// Against x, y to the right.
        Front = say!("front"),
        /// Along y, x to the right.
        Side = say!("side"),
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Standard {
    /// Azimuth and elevation, rad.
    fn angles(self) -> [f64; 2] {
        match self {
            // The three axes look equally long: tan e = 1/√2.
            Self::Isometric => [-FRAC_PI_4, 0.5_f64.sqrt().atan()],
            Self::Top => [-FRAC_PI_2, FRAC_PI_2],
            Self::Front => [0.0, 0.0],
            Self::Side => [-FRAC_PI_2, 0.0],
        }
    }
}

/// A ball around everything that is drawn, mm of the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ball {
    pub(crate) centre_mm: [f64; 3],
    pub(crate) radius_mm: f64,
}

impl Ball {
    /// The ball around these points, mm; those that are not finite do not count.
    pub(crate) fn around(points: &[[f64; 3]]) -> Self {
        let ends = |of: fn(f64, f64) -> f64, start: f64| {
            let finite = points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
            finite.fold([start; 3], |a, p| [0, 1, 2].map(|k| of(a[k], p[k])))
        };
        let (low, high) = (
            ends(f64::min, f64::INFINITY),
            ends(f64::max, f64::NEG_INFINITY),
        );
        if low[0] > high[0] {
            return Self {
                centre_mm: [0.0; 3],
                radius_mm: 1.0,
            };
        }
        let centre_mm = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let from_centre = |p: &[f64; 3]| {
            let off = [0, 1, 2].map(|k| p[k] - centre_mm[k]);
            dot(off, off).sqrt()
        };
        let far = points.iter().map(from_centre).filter(|d| d.is_finite());
        Self {
            centre_mm,
            radius_mm: far.fold(1.0, f64::max),
        }
    }
}

/// Azimuth and elevation for each point that is dragged, rad.
const TURN: f64 = 0.008;
/// The smallest and the largest zoom.
const ZOOM: [f64; 2] = [0.1, 1e5];
/// The ball takes this part of the plot.
const FILLED: f64 = 0.96;

/// Direction, distance and centre of the three-dimensional view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Camera {
    /// About z, from x, rad.
    pub(crate) azimuth_rad: f64,
    /// Above the plane of x and y, rad, from −π/2 to π/2.
    pub(crate) elevation_rad: f64,
    /// 1: everything fits.
    pub(crate) zoom: f64,
    /// The point that is in the middle of the plot and that the camera orbits about, from the middle
    /// of everything, mm.
    pub(crate) offset_mm: [f64; 3],
}

impl Default for Camera {
    fn default() -> Self {
        Self::from(Standard::Isometric)
    }
}

impl From<Standard> for Camera {
    fn from(view: Standard) -> Self {
        let [azimuth_rad, elevation_rad] = view.angles();
        Self {
            azimuth_rad,
            elevation_rad,
            zoom: 1.0,
            offset_mm: [0.0; 3],
        }
    }
}

impl Camera {
    pub(crate) fn facing(&self) -> Facing {
        let (sin_a, cos_a) = self.azimuth_rad.sin_cos();
        let (sin_e, cos_e) = self.elevation_rad.sin_cos();
        Facing {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            towards: [cos_e * cos_a, cos_e * sin_a, sin_e],
        }
    }

    /// The named view that this is, if it is one.
    pub(crate) fn standard(&self) -> Option<Standard> {
        Standard::ALL.into_iter().find(|view| {
            let [azimuth, elevation] = view.angles();
            (self.azimuth_rad - azimuth).abs() < 1e-9
                && (self.elevation_rad - elevation).abs() < 1e-9
        })
    }

    /// The same place, looked at from a named view.
    pub(crate) fn seen_from(self, view: Standard) -> Self {
        let [azimuth_rad, elevation_rad] = view.angles();
        Self {
            azimuth_rad,
            elevation_rad,
            ..self
        }
    }

    /// The same direction, everything in sight.
    pub(crate) fn fitted(self) -> Self {
        Self {
            zoom: 1.0,
            offset_mm: [0.0; 3],
            ..self
        }
    }

    /// Only numbers that can be drawn: azimuth within half a turn, elevation within a quarter.
    pub(crate) fn sound(self) -> Self {
        let or = |value: f64, other: f64| if value.is_finite() { value } else { other };
        let azimuth = or(self.azimuth_rad, 0.0);
        Self {
            azimuth_rad: azimuth - TAU * (azimuth / TAU).round(),
            elevation_rad: or(self.elevation_rad, 0.0).clamp(-FRAC_PI_2, FRAC_PI_2),
            zoom: or(self.zoom, 1.0).clamp(ZOOM[0], ZOOM[1]),
            offset_mm: self.offset_mm.map(|v| or(v, 0.0)),
        }
    }

    /// Points on the screen for each mm, in a plot of this size in points.
    pub(crate) fn points_per_mm(&self, ball: &Ball, size: [f64; 2]) -> f64 {
        let half = 0.5 * size[0].min(size[1]).max(1.0);
        self.zoom * FILLED * half / ball.radius_mm
    }

    /// Smallest and largest corner of what a plot of this size (points) shows, mm to the right and
    /// up from the projected origin.
    pub(crate) fn bounds(&self, ball: &Ball, size: [f64; 2]) -> [[f64; 2]; 2] {
        let scale = self.points_per_mm(ball, size);
        let middle = [0, 1, 2].map(|k| ball.centre_mm[k] + self.offset_mm[k]);
        let middle = self.facing().flat(middle);
        let half = size.map(|side| 0.5 * side.max(1.0) / scale);
        [
            [middle[0] - half[0], middle[1] - half[1]],
            [middle[0] + half[0], middle[1] + half[1]],
        ]
    }

    /// After a drag by so many points to the right and down: what is near follows the pointer.
    pub(crate) fn orbited(self, [right, down]: [f64; 2]) -> Self {
        Self {
            azimuth_rad: self.azimuth_rad - TURN * right,
            elevation_rad: self.elevation_rad + TURN * down,
            ..self
        }
        .sound()
    }

    /// After a drag by so many mm to the right and up: everything follows the pointer.
    pub(crate) fn panned(self, [right, up]: [f64; 2]) -> Self {
        let facing = self.facing();
        Self {
            offset_mm: [0, 1, 2]
                .map(|k| self.offset_mm[k] - right * facing.right[k] - up * facing.up[k]),
            ..self
        }
        .sound()
    }

    /// Closer by this factor about a point that is so many mm to the right of the plot's middle and
    /// above it: that point stays where it is on the screen.
    pub(crate) fn zoomed(self, factor: f64, [right, up]: [f64; 2]) -> Self {
        let next = Self {
            zoom: self.zoom * factor,
            ..self
        }
        .sound();
        let part = self.zoom / next.zoom - 1.0;
        next.panned([right * part, up * part])
    }

    /// In words: the view's name, or from which direction.
    pub(crate) fn describe(&self) -> String {
        if let Some(view) = self.standard() {
            return say!("{view} view", view = view.name());
        }
        let [azimuth, elevation] = [self.azimuth_rad, self.elevation_rad]
            .map(|a| crate::present::numbers::trimmed(a.to_degrees(), 0));
        say!(
            "seen from azimuth {azimuth}°, elevation {elevation}°",
            azimuth,
            elevation
        )
    }
}

named! {
    /// The plane that the workspace is looked at in.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub(crate) enum Plane {
        /// From above.
        #[default]
        Xy = "x y",
        /// From the side.
        Xz = "x z",
        /// From the front.
        Yz = "y z",
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Plane {
    /// The axes that it shows: to the right, and up.
    pub(crate) fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Xz => [0, 2],
            Self::Yz => [1, 2],
        }
    }

    /// Its axes in the measuring frame.
    pub(crate) fn facing(self) -> Facing {
        let unit = |axis: usize, sign: f64| [0, 1, 2].map(|k| if k == axis { sign } else { 0.0 });
        let [right, up] = self.axes();
        let sign = if self == Self::Xz { -1.0 } else { 1.0 };
        Facing {
            right: unit(right, 1.0),
            up: unit(up, 1.0),
            towards: unit(self.normal(), sign),
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
    /// The same in three dimensions.
    Space,
}

named! {
    /// What the colour of an error vector says.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub(crate) enum Colouring {
        /// Before or after.
        #[default]
        State = say!("before and after"),
        /// The deviation's length.
        Deviation = say!("deviation"),
        /// One standard uncertainty of what the model predicts.
        Uncertainty = say!("uncertainty (1σ)"),
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

#[cfg(test)]
mod panes_tests {
    use super::*;

    fn keys(panes: &Panes) -> Vec<Key> {
        panes.panes().iter().map(|(key, _)| *key).collect()
    }

    fn share(panes: &Panes, k: usize) -> f32 {
        let root = panes.tree.root.and_then(|root| panes.tree.tiles.get(root));
        let Some(Tile::Container(Container::Linear(linear))) = root else {
            panic!("a split");
        };
        linear.shares.split(&linear.children, 1.0)[k]
    }

    /// A chart that is known by its name.
    fn chart(name: &str) -> ChartPane {
        ChartPane {
            chart: Some(name.to_owned()),
            ..ChartPane::default()
        }
    }

    #[test]
    fn a_chart_is_split_off_beside_and_below_and_closed_again() {
        let mut panes = Panes::default();
        assert_eq!(panes.outline(), "(workspace 0.66 chart 0.34)");
        let [workspace, first] = keys(&panes)[..] else {
            panic!("two");
        };
        panes.split(first, Edge::Right, chart("b"));
        assert_eq!(panes.outline(), "(workspace 0.66 [chart 0.50 b 0.50] 0.34)");
        let b = panes.active();
        assert_eq!(panes.pane(b), Some(&Pane::Chart(chart("b"))));
        panes.split(b, Edge::Right, chart("c"));
        let beside = "[chart 0.50 b 0.25 c 0.25]";
        assert_eq!(panes.outline(), format!("(workspace 0.66 {beside} 0.34)"));
        panes.split(workspace, Edge::Left, chart("d"));
        let above = "[d 0.50 workspace 0.50]";
        assert_eq!(panes.outline(), format!("({above} 0.66 {beside} 0.34)"));
        for (key, _) in panes.clone().charts() {
            panes.close(key);
            assert_eq!(panes.clone().sound(|_| true), panes);
        }
        assert_eq!(panes.outline(), "workspace");
        assert_eq!(panes.active(), workspace);
        assert!(panes.active_chart().is_none());
        panes.close(workspace);
        assert_eq!(panes.outline(), "workspace", "the workspace stays");
        panes.split(workspace, Edge::Bottom, ChartPane::default());
        assert_eq!(panes.outline(), "(workspace 0.50 chart 0.50)");
    }

    #[test]
    fn shares_are_kept_where_a_pane_is_split_and_given_to_the_neighbours_where_it_is_closed() {
        let mut panes = Panes::default();
        let first = keys(&panes)[1];
        panes.split(first, Edge::Right, ChartPane::default());
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        panes.close(panes.active());
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        // Stacked, the new one has half of what it is split from.
        panes.split(first, Edge::Bottom, ChartPane::default());
        assert_eq!(keys(&panes).len(), 3);
        assert!((share(&panes, 1) - share(&panes, 2)).abs() < 1e-6);
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
    }

    #[test]
    fn a_pane_is_moved_to_any_edge_of_the_middle() {
        for (edge, outline) in [
            (Edge::Left, "[chart 0.34 workspace 0.66]"),
            (Edge::Right, "[workspace 0.66 chart 0.34]"),
            (Edge::Top, "(chart 0.34 workspace 0.66)"),
            (Edge::Bottom, "(workspace 0.66 chart 0.34)"),
        ] {
            let mut panes = Panes::default();
            panes.move_to(keys(&panes)[1], edge);
            assert_eq!(panes.outline(), outline);
            panes.move_to(TileId::from_u64(99), edge);
            assert_eq!(panes.outline(), outline);
        }
        let mut alone = Panes::default();
        alone.close(keys(&alone)[1]);
        alone.move_to(alone.workspace(), Edge::Left);
        assert_eq!(alone.outline(), "workspace");
    }

    #[test]
    fn there_are_never_too_many_charts_and_always_one_workspace() {
        let mut panes = Panes::default();
        for _ in 0..20 {
            panes.split(panes.active(), Edge::Left, ChartPane::default());
        }
        assert_eq!(panes.charts().count(), MOST_CHARTS);
        assert!(!panes.has_room());
        let of = |all: &[Pane]| {
            let mut panes = Panes::default();
            let mut tiles = Tiles::default();
            let children = all
                .iter()
                .map(|pane| tiles.insert_pane(pane.clone()))
                .collect();
            let root = tiles.insert_horizontal_tile(children);
            panes.tree = Tree::new(Id::unique("panes"), root, tiles);
            panes.sound(|name| name != "gone")
        };
        let shows = |name: &str| Pane::Chart(chart(name));
        let usual = Panes::default().outline();
        assert_eq!(of(&[]).outline(), usual);
        assert_eq!(of(&[shows("x")]).outline(), usual, "no workspace");
        let two = of(&[Pane::Workspace, shows("x"), shows("gone")]);
        assert_eq!(two.outline(), "[workspace 0.50 x 0.50]");
        let workspaces = [Pane::Workspace, Pane::Workspace];
        assert_eq!(of(&workspaces).outline(), usual);
        let mut many = vec![Pane::Workspace];
        many.extend((0..7).map(|_| shows("x")));
        assert_eq!(of(&many).outline(), usual);
        // A split that is a part of itself.
        let mut round = Panes::default();
        let root = round.tree.root.expect("a split");
        round.container(root).expect("a split").add_child(root);
        assert_eq!(round.sound(|_| true).outline(), usual);
    }

    #[test]
    fn what_is_kept_comes_back() {
        let mut panes = Panes::default();
        panes.split(panes.workspace(), Edge::Right, ChartPane::default());
        panes.split(panes.active(), Edge::Bottom, ChartPane::default());
        if let Some(chart) = panes.chart_mut(panes.active()) {
            chart.chart = Some("scatter".to_owned());
            chart.component = Some(Component::Radial);
            chart.axes = Some([Quantity::Order, Quantity::Measured(2)]);
        }
        let text = serde_json::to_string(&panes).expect("it can be written");
        let read: Panes = serde_json::from_str(&text).expect("it can be read");
        let mut read = read.sound(|_| true);
        assert_eq!(read.tree, panes.tree);
        assert!(!read.are_usual() && Panes::default().are_usual());
        read.split(read.workspace(), Edge::Left, ChartPane::default());
        assert_eq!(read.charts().count(), 4, "new tiles are others");
    }

    #[test]
    fn the_next_plot_is_the_next_in_sight_and_after_the_last_the_first() {
        let mut panes = Panes::default();
        panes.split(panes.workspace(), Edge::Right, ChartPane::default());
        let order = keys(&panes);
        panes.activate(order[0]);
        for key in order.iter().cycle().skip(1).take(7) {
            panes.activate_next();
            assert_eq!(panes.active(), *key);
        }
    }
}

#[cfg(test)]
mod camera_tests {
    //! The geometry of the camera: where points are on the screen before and after it moves.

    use super::*;

    const BALL: Ball = Ball {
        centre_mm: [100.0, -50.0, 300.0],
        radius_mm: 400.0,
    };
    const SIZE: [f64; 2] = [600.0, 400.0];

    /// Where a point is on the screen, points from the upper left corner.
    fn seen(camera: &Camera, p: [f64; 3]) -> [f64; 2] {
        let [low, high] = camera.bounds(&BALL, SIZE);
        let [x, y] = camera.facing().flat(p);
        [
            (x - low[0]) / (high[0] - low[0]) * SIZE[0],
            (high[1] - y) / (high[1] - low[1]) * SIZE[1],
        ]
    }

    fn near(a: [f64; 2], b: [f64; 2]) {
        assert!(
            (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9,
            "{a:?} {b:?}"
        );
    }

    #[test]
    fn the_axes_of_a_view_are_a_right_handed_frame_with_z_upright() {
        for (azimuth_rad, elevation_rad) in [(0.3, 0.5), (-2.0, -1.2), (3.0, 1.5)] {
            let camera = Camera {
                azimuth_rad,
                elevation_rad,
                ..Camera::default()
            };
            let Facing { right, up, towards } = camera.facing();
            let cross = [
                right[1] * up[2] - right[2] * up[1],
                right[2] * up[0] - right[0] * up[2],
                right[0] * up[1] - right[1] * up[0],
            ];
            assert!((0..3).all(|k| (cross[k] - towards[k]).abs() < 1e-12));
            assert!((dot(up, up) - 1.0).abs() < 1e-12 && right[2] == 0.0 && up[2] > 0.0);
        }
    }

    #[test]
    fn standard_views_show_the_axes_that_their_names_say() {
        let seen = |view: Standard| {
            let facing = Camera::from(view).facing();
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| facing.flat(axis))
        };
        let [x, y, z] = seen(Standard::Top);
        near(x, [1.0, 0.0]);
        near(y, [0.0, 1.0]);
        near(z, [0.0, 0.0]);
        let [x, y, z] = seen(Standard::Front);
        near(x, [0.0, 0.0]);
        near(y, [1.0, 0.0]);
        near(z, [0.0, 1.0]);
        let [x, y, z] = seen(Standard::Side);
        near(x, [1.0, 0.0]);
        near(y, [0.0, 0.0]);
        near(z, [0.0, 1.0]);
        let lengths = seen(Standard::Isometric).map(|[a, b]| a.hypot(b));
        assert!(
            lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-12),
            "{lengths:?}"
        );
        for view in Standard::ALL {
            assert_eq!(Camera::from(view).standard(), Some(view));
        }
        assert_eq!(Camera::default().orbited([3.0, 0.0]).standard(), None);
    }

    #[test]
    fn what_is_drawn_fits_from_every_side() {
        let mut camera = Camera::default();
        for _ in 0..40 {
            camera = camera.orbited([37.0, 11.0]);
            for corner in 0..8_usize {
                let side = BALL.radius_mm / 3.0_f64.sqrt();
                let p = [0, 1, 2]
                    .map(|k| BALL.centre_mm[k] + if corner >> k & 1 == 1 { side } else { -side });
                let [x, y] = seen(&camera, p);
                assert!((0.0..=SIZE[0]).contains(&x) && (0.0..=SIZE[1]).contains(&y));
            }
        }
    }

    #[test]
    fn orbiting_leaves_the_pivot_in_the_middle_and_turns_what_is_near_with_the_pointer() {
        let camera = Camera::default().panned([40.0, -25.0]);
        let pivot = [0, 1, 2].map(|k| BALL.centre_mm[k] + camera.offset_mm[k]);
        let turned = camera.orbited([50.0, 20.0]);
        near(seen(&camera, pivot), [300.0, 200.0]);
        near(seen(&turned, pivot), [300.0, 200.0]);
        let towards = camera.facing().towards;
        let front = [0, 1, 2].map(|k| pivot[k] + 100.0 * towards[k]);
        let (before, after) = (seen(&camera, front), seen(&turned, front));
        assert!(
            after[0] > before[0] && after[1] > before[1],
            "{before:?} {after:?}"
        );
        // Straight from above is as far as it goes.
        assert_eq!(camera.orbited([0.0, 1e6]).elevation_rad, FRAC_PI_2);
    }

    #[test]
    fn panning_takes_everything_along_by_as_many_points_as_the_pointer_moved() {
        let camera = Camera::default()
            .zoomed(3.0, [0.0; 2])
            .orbited([15.0, -30.0]);
        let p = [80.0, 20.0, 250.0];
        let scale = camera.points_per_mm(&BALL, SIZE);
        let moved = camera.panned([24.0 / scale, 10.0 / scale]);
        let [x, y] = seen(&camera, p);
        near(seen(&moved, p), [x + 24.0, y - 10.0]);
    }

    #[test]
    fn zooming_leaves_what_is_under_the_pointer_where_it_is() {
        let camera = Camera::default().orbited([70.0, 30.0]);
        let p = [180.0, 60.0, 410.0];
        let [x, y] = seen(&camera, p);
        let scale = camera.points_per_mm(&BALL, SIZE);
        let at = [(x - 0.5 * SIZE[0]) / scale, (0.5 * SIZE[1] - y) / scale];
        let closer = camera.zoomed(4.0, at);
        near(seen(&closer, p), [x, y]);
        assert!((closer.points_per_mm(&BALL, SIZE) / scale - 4.0).abs() < 1e-9);
        assert_eq!(
            closer.fitted().bounds(&BALL, SIZE),
            camera.fitted().bounds(&BALL, SIZE)
        );
        // No nearer than numbers go, and then nothing moves.
        assert_eq!(camera.zoomed(1e30, [0.0; 2]).zoom, ZOOM[1]);
    }

    #[test]
    fn what_is_no_number_becomes_one_that_can_be_drawn() {
        let broken = Camera {
            azimuth_rad: f64::NAN,
            elevation_rad: f64::INFINITY,
            zoom: f64::NAN,
            offset_mm: [f64::NAN, 1.0, 2.0],
        };
        let sound = broken.sound();
        assert_eq!(
            (sound.azimuth_rad, sound.elevation_rad, sound.zoom),
            (0.0, 0.0, 1.0)
        );
        assert_eq!(sound.offset_mm, [0.0, 1.0, 2.0]);
        assert_eq!(Ball::around(&[[f64::INFINITY; 3]]).radius_mm, 1.0);
    }
}
