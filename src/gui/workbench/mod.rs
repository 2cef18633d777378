//! Everything that can be done, and the one place that does it.
//!
//! Panels and plots read the [`Workbench`] and send [`Command`]s; [`Workbench::execute`] is the
//! only function that changes anything.

mod answers;
mod arrangement;
mod background;
mod charts;
mod command;
mod compensating;
mod details;
mod dividing;
mod exports;
mod follow;
mod font_fallback;
#[cfg(test)]
mod how_far;
mod imports;
mod leaving;
mod papers;
mod past;
mod recording;
mod recovering;
mod recovery_writer;
mod robots;
mod said;
mod state;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod under_way;
#[cfg(test)]
mod walk;

use crate::text::spoken;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(crate) use command::{Command, of_field};

use state::{FileState, PendingQueries, SpokenSections};

use crate::gui::cache::figures::Figures;
use crate::gui::cache::identified::IdentifiedAnswer;
use crate::gui::cache::plot_cache::PlotCache;
use crate::gui::cache::preview::Preview;
use crate::gui::core::compensated::Compensated;
use crate::gui::core::document::{Document, ExportChoice, Question};
use crate::gui::core::edit::Edit;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::search::Search;
use crate::gui::core::undo::History;
use crate::gui::file_state::settings::Recent;
use crate::gui::file_state::watcher::Watcher;
use crate::gui::files::{self, Replace};
use crate::gui::jobs::{Jobs, Kind};
use crate::gui::preferences::Preferences;
use crate::gui::style::font_fallback::Characters;
use crate::gui::view::{
    Aspect, Camera, Message, NextAction, Plane, Plot, Sheet, Side, Step, ViewState,
};
use crate::present::drawing::Drawing;
use crate::present::units::Units;
use crate::sessions::Samples;

/// A plot that is drawn in the background: the drawing and what it shows, or why there is none.
pub(crate) type Draw = Box<dyn FnOnce() -> Result<(Drawing, String), String> + Send>;

/// Who knows how plots are drawn: the views, which stand above the workbench.
pub(crate) type Drawer = fn(&Workbench, Plot) -> Draw;

/// Document, view, answer and jobs.
pub(crate) struct Workbench {
    history: History<Document>,
    /// The session that the window began with, not opened by the user.
    first: Arc<LoadedSession>,
    file_state: FileState,
    /// A question that was cancelled: it is not asked again by itself.
    declined: Option<Question>,
    /// Whether samples are being put behind those that are there.
    extending: bool,
    /// Samples that came meanwhile, and whether they take the place of all others.
    waiting_samples: Option<(Samples, bool)>,
    view: ViewState,
    identified: Option<Arc<IdentifiedAnswer>>,
    searched: Option<Arc<Search>>,
    /// A chart and its numbers, ready to be copied.
    copied: Option<(&'static str, String)>,
    said: SpokenSections,
    /// What a search that was stopped had found until then, and in which session.
    stopped: Option<(Arc<LoadedSession>, Vec<String>)>,
    preview: Option<Preview>,
    plot_cache: Option<Arc<PlotCache>>,
    compensated: Option<Arc<Compensated>>,
    /// Files that were exported from this session, the newest last, each with what its model answers.
    exported: Vec<(PathBuf, Option<Question>)>,
    /// The name under which this export was saved last.
    saved_as: Option<(ExportChoice, String)>,
    figures: Option<Figures>,
    letters: Characters,
    draw: Drawer,
    jobs: Jobs<Self>,
    asked: PendingQueries,
    watcher: Watcher,
}

impl Workbench {
    /// A workbench with a session on it.
    pub(crate) fn new(subject: Arc<LoadedSession>, jobs: Jobs<Self>, draw: Drawer) -> Self {
        let first = Arc::clone(&subject);
        let history = History::new(Document::new(subject));
        let mut workbench = Self {
            first,
            file_state: FileState::default(),
            declined: None,
            extending: false,
            waiting_samples: None,
            history,
            view: ViewState::default(),
            identified: None,
            searched: None,
            copied: None,
            said: SpokenSections::default(),
            stopped: None,
            preview: None,
            plot_cache: None,
            compensated: None,
            exported: Vec::new(),
            saved_as: None,
            figures: None,
            letters: Characters::default(),
            draw,
            asked: PendingQueries::default(),
            watcher: Self::watcher(&jobs),
            jobs,
        };
        workbench.remember_on_file(Arc::clone(workbench.history.present()));
        workbench.look_along_the_axis();
        workbench
    }

    pub(crate) fn document(&self) -> &Document {
        self.history.present()
    }

    pub(crate) fn loaded_session(&self) -> &Arc<LoadedSession> {
        &self.document().subject
    }

    /// How it is looked at.
    pub(crate) fn view(&self) -> &ViewState {
        &self.view
    }

    pub(crate) fn units(&self) -> Units {
        Units {
            length: self.view.preferences.length,
            angle: self.view.preferences.angle,
        }
    }

    /// The steps that the robot has, in order.
    pub(crate) fn steps(&self) -> &'static [Step] {
        Step::offered(self.loaded_session().single_revolute())
    }

    pub(crate) fn undoes(&self) -> Option<&'static str> {
        self.history.undoes().map(spoken)
    }

    pub(crate) fn redoes(&self) -> Option<&'static str> {
        self.history.redoes().map(spoken)
    }

    pub(crate) fn execute(&mut self, command: Command) {
        match command {
            Command::Edit(edit) => self.edit(&edit, false),
            Command::Drag(edit) => self.edit(&edit, true),
            Command::EndDrag => self.history.finish_gesture(),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            Command::ChooseFile => self.choose_file(files::choose_to_open),
            // A robot program has nothing to be opened: its targets are corrected.
            Command::OpenFile(path) if files::is_program(&path) => self.compensate_file(path),
            Command::OpenFile(path) => self.ask_then(NextAction::Open(path)),
            Command::Drop(paths) => self.drop_files(paths),
            Command::OpenExample(index) => self.ask_then(NextAction::Example(index)),
            Command::Leave => self.ask_then(NextAction::Leave),
            Command::Do(then) => self.go(then),
            Command::SaveThen(then) => self.save_then(then),
            Command::Save | Command::ChooseWhereToSave | Command::SaveAs { .. }
                if self.loaded_session().is_empty() =>
            {
                self.complain(
                    say!("There is no session to save"),
                    vec![say!("A model by itself is saved in the Export step").to_owned()],
                );
            }
            Command::ChooseWhereToSave => self.choose_where_to_save(),
            Command::Say(said) => self.say(*said),
            Command::ConfirmColumns => self.confirm_columns(),
            Command::ChooseBeside(which) => self.choose_beside(which),
            Command::Import => self.import(),
            Command::Save => self.save_here(),
            Command::SaveAs { path, replace } => {
                let replace = if replace {
                    Replace::Named
                } else {
                    Replace::Nothing
                };
                self.save_to(&self.placed(&path), replace);
            }
            Command::SaveDespite => {
                if let Some(path) = self.file().map(Path::to_path_buf) {
                    self.save_to(&path, Replace::Whatever);
                }
            }
            Command::Forget(path) => self.use_recent(Recent::Forgotten(path)),
            Command::Restore(index) => self.restore(index),
            Command::DiscardLeft(index) => self.discard_left(index),
            Command::DiscardAllLeft => self.discard_all_left(),
            Command::ChooseImport => self.choose_file(files::choose_to_import),
            Command::Reload => self.reload(),
            Command::Follow(on) => self.follow(on),
            Command::KeepRecovery => self.keep_recovery(),
            Command::LookAtDisk => self.look_at_disk(),
            Command::ChooseWhereToExport(what) => self.choose_where_to_export(what),
            Command::ExportTo {
                what,
                path,
                replace,
            } => {
                self.view.sheet = None;
                self.export_to(what, self.placed(&path), replace);
            }
            Command::CopyNumbers(chart) => self.copy_numbers(chart),
            Command::State(stated) => self.state(*stated),
            Command::KeepRobot { table, save } => self.keep_robot(*table, save),
            Command::ForgetRobot(name) => self.forget_robot(&name),
            Command::CompareSessions(folder) => self.compare_sessions(folder),
            Command::ChooseFolder => self.choose_folder(),
            Command::Record(wanted) => self.record(*wanted),
            Command::StopRecording => self.stop_recording(),
            Command::ChooseLogo => self.choose_logo(),
            Command::ChooseTargets => self.choose_targets(),
            Command::Compensate(wanted) => self.compensate(wanted),
            Command::Simulate(form) => {
                if let Some(problem) = form.problem() {
                    self.complain(say!("The simulation needs other numbers"), vec![problem]);
                } else {
                    self.ask_then(NextAction::Simulate(form));
                }
            }
            Command::FindLetters(wanted) => self.find_letters(wanted, true),
            Command::FindNamesOfLanguages => self.find_names_of_languages(),
            Command::DismissLetters => self.dismiss_letters(),
            Command::Adapt => self.adapt(),
            Command::Search => self.search(),
            Command::StopSearch => self.stop_search(),
            Command::OpenOutside { path, in_folder } => self.open_outside(path, in_folder),
            Command::StopLooking => self.cancel_look(),
            Command::Cancel => {
                // What was to be done after it is not wanted any more either.
                self.cancel_pending_action();
                self.cancel_newest();
            }
            other => self.look(other),
        }
        if !self.steps().contains(&self.view.step) {
            // Another robot has no regions.
            self.view.step = Step::Identify;
        }
        self.refresh_answer();
        self.keep_preparing();
        self.keep_drawing();
    }

    fn look(&mut self, command: Command) {
        let view = &mut self.view;
        match command {
            Command::GoTo(step) => view.step = step,
            Command::Look(plane) => {
                view.plane = plane;
                view.look(Aspect::Plane);
            }
            Command::LookFrom(from) => {
                view.look(Aspect::Space);
                if let Some(from) = from {
                    view.camera = view.camera.seen_from(from);
                }
            }
            Command::Turn(camera) => view.camera = camera.sound(),
            Command::Pose(q) => view.pose = q,
            Command::LookAround => view.look(Aspect::Around),
            Command::Magnify(factor) => {
                view.magnification = factor.filter(|f| f.is_finite() && *f > 0.0);
            }
            Command::PlotSize(size) if size.is_finite() => view.plot_size = size.clamp(20.0, 1e5),
            Command::Blend(t) if t.is_finite() => view.blend = t.clamp(0.0, 1.0),
            Command::Colour(colouring) => view.colouring = colouring,
            Command::Heat(shown) => view.heat = shown,
            Command::Canvas(canvas) => view.canvas = canvas,
            Command::Component(component) => view.component = component,
            Command::OnlyAfter(only) => view.only_after = only,
            Command::Hover(sample) => view.hovered = sample,
            Command::Select(sample) => {
                view.selected = sample;
                view.pose = None;
                view.marked.clear();
            }
            Command::Mark(samples) => {
                view.selected = samples.first().copied();
                view.pose = None;
                view.marked = samples;
                view.side = Side::Samples;
            }
            Command::Side(side) => view.side = side,
            Command::Panes(panes) => self.arrange(*panes),
            Command::Pull(panes) => view.panes = *panes,
            Command::Activate(key) => view.panes.activate(key),
            Command::ActivateNext => view.panes.activate_next(),
            Command::ChartJoint(joint) => view.joint = joint,
            Command::ShowEffect(index) => self.show_effect(index),
            Command::Results(open) => view.results = Some(open),
            Command::Prefer(preferences) => {
                view.preferences = preferences.sound();
                self.keep_preferences();
            }
            Command::Resize(sizes) => {
                let preferences = Preferences {
                    sizes,
                    ..view.preferences
                };
                view.preferences = preferences.sound();
            }
            Command::Draft(form) => view.setup = form,
            Command::KeepMine => view.on_disk = None,
            Command::Sheet(sheet) => self.show_sheet(sheet),
            Command::Type { region, end, text } => self.type_boundary(region, end, text),
            Command::Dismiss => view.message = None,
            Command::Fit => {
                view.fitted.everywhere();
                view.camera = view.camera.fitted();
            }
            Command::FitWorkspace => {
                view.fitted.workspace += 1;
                view.camera = view.camera.fitted();
            }
            Command::FitChart(key) => {
                if let Some(pane) = view.panes.chart_mut(key) {
                    pane.fitted += 1;
                }
            }
            _ => {}
        }
        self.forget_missing_samples();
    }

    fn show_sheet(&mut self, sheet: Option<Sheet>) {
        if sheet.is_none() {
            match &self.view.sheet {
                // Closing the question cancels what it was about.
                Some(
                    Sheet::Unsaved(_)
                    | Sheet::Overwrite(_)
                    | Sheet::SavePath { .. }
                    | Sheet::ExportPath { .. },
                ) => self.cancel_pending_action(),
                Some(Sheet::Import(_)) => self.cancel_look(),
                _ => {}
            }
        }
        if self.view.sheet == Some(Sheet::DETAILS) {
            self.keep_stated();
        }
        self.view.sheet = sheet;
    }

    fn edit(&mut self, edit: &Edit, within_gesture: bool) {
        let before = Arc::clone(self.loaded_session());
        match edit.apply(self.document()) {
            Err(because) => {
                self.complain(say!("This change cannot be made"), vec![because]);
            }
            Ok(next) if within_gesture => self.history.change_within_gesture(next, edit.what()),
            Ok(next) => self.history.change(next, edit.what()),
        }
        self.view.setup = None;
        self.keep_typed(edit);
        if matches!(edit, Edit::Identify | Edit::IdentifyBy(_)) {
            self.declined = None;
        }
        if !Arc::ptr_eq(&before, self.loaded_session()) {
            self.view.marked.clear();
            self.after_travel(before.lineage);
        }
        if before.lineage != self.loaded_session().lineage {
            // A search of the session that was left answers nothing any more.
            self.jobs.cancel(|kind| kind == Kind::Searches);
            self.exported.clear();
            self.compensated = None;
            self.saved_as = None;
            self.look_along_the_axis();
            self.view.step = Step::Session;
            self.view.fitted.everywhere();
            self.view.message = None;
            self.opened();
        }
    }

    /// Back or forth in the history.
    fn travel(&mut self, way: fn(&mut History<Document>) -> bool) {
        let before = self.loaded_session().lineage;
        way(&mut self.history);
        self.after_travel(before);
    }

    /// After a change that may have brought another session.
    fn after_travel(&mut self, lineage_before: u64) {
        self.view.setup = None;
        self.forget_typed();
        self.forget_missing_samples();
        if self.loaded_session().lineage != lineage_before {
            self.arrived();
        }
    }

    fn forget_missing_samples(&mut self) {
        let samples = self.loaded_session().len();
        let there = |sample: &usize| *sample < samples;
        self.view.hovered = self.view.hovered.filter(there);
        self.view.selected = self.view.selected.filter(there);
        self.view.marked.retain(there);
        let joints = self.loaded_session().session.robot.joint_count();
        let a_pose = |q: &Vec<f64>| q.len() == joints && q.iter().all(|v| v.is_finite());
        self.view.pose = self.view.pose.take().filter(a_pose);
    }

    /// Looks at the workspace in the plane in which joint 1 turns; with several joints in space, as
    /// no plane shows them.
    fn look_along_the_axis(&mut self) {
        let along = self.loaded_session().joint.along;
        let several = self.loaded_session().session.robot.joint_count() > 1;
        self.view.aspect = if several {
            Aspect::Space
        } else {
            Aspect::Plane
        };
        self.view.camera = Camera::default();
        self.view.pose = None;
        let steepest = (0..3).max_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()));
        self.view.plane = Plane::ALL
            .into_iter()
            .find(|plane| Some(plane.normal()) == steepest)
            .unwrap_or_default();
    }

    fn complain(&mut self, title: &str, details: Vec<String>) {
        self.view.message = Some(Message::wrong(title, details));
    }
}
