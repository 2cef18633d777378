//! Everything that can be done, and the one place that does it.
//!
//! Panels and plots read the [`Workbench`] and send [`Command`]s; [`Workbench::execute`] is the
//! only function that changes anything.

mod answers;
mod asking;
mod background;
mod charts;
mod command;
mod drafts;
mod exports;
mod machine;
mod on_disk;
mod state;
#[cfg(test)]
mod tests;
mod unsaved;
/// What the tests of the window do at random; no release has it.
#[cfg(debug_assertions)]
#[path = "../../../tests/support/walk/mod.rs"]
pub mod walk;

use std::path::Path;
use std::sync::Arc;

use crate::gui::core::compensated::CompensationRequest;
use crate::gui::core::document::Document;
use crate::gui::core::edit::{Edit, History};
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::file_state::Recent;
use crate::gui::files::{self, Replace};
use crate::gui::preferences::Preferences;
use crate::gui::view::{
    Aspect, Camera, Message, NextAction, Plane, Plot, Sheet, Side, Step, ViewState, What,
};
use crate::present::units::Units;
use crate::text::spoken;

pub(crate) use command::{Asked, Command, LeftBehind, Task, ViewChange, of_field};
pub(crate) use state::Workbench;

impl Workbench {
    pub(crate) fn document(&self) -> &Document {
        self.history.present()
    }

    pub(crate) fn loaded_session(&self) -> &Arc<LoadedSession> {
        &self.document().loaded_session
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
            Command::Ask(Asked::WhereToExport(What::Picture(Plot::Workspace)))
            | Command::ExportTo {
                what: What::Picture(Plot::Workspace),
                ..
            } if self.picture.is_none() => self.wait_for_picture(command),
            Command::Edit(edit) => self.edit(&edit, false),
            Command::Drag(edit) => self.edit(&edit, true),
            Command::EndDrag => self.history.finish_gesture(),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            // A robot program has nothing to be opened: its targets are corrected.
            Command::OpenFile(path) if files::is_program(&path) => {
                self.compensate(CompensationRequest::new(path));
            }
            Command::OpenFile(path) => self.ask_then(NextAction::Open(path)),
            Command::Drop(paths) => self.drop_files(paths),
            Command::OpenExample(index) => self.ask_then(NextAction::Example(index)),
            Command::Leave => self.ask_then(NextAction::Leave),
            Command::Do(then) => self.go(then),
            Command::SaveThen(then) => self.save_then(then),
            Command::Save | Command::Ask(Asked::WhereToSave) | Command::SaveAs { .. }
                if self.loaded_session().is_empty() =>
            {
                self.complain(
                    say!("There is no session to save"),
                    [say!("A model by itself is saved in the Export step")],
                );
            }
            Command::Say(said) => self.say(*said),
            Command::ConfirmColumns => self.confirm_columns(),
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
            Command::Reload => self.reload(),
            Command::KeepRecovery => self.keep_recovery(),
            Command::LookAtDisk => self.look_at_disk(),
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
            Command::Compensate(wanted) => self.compensate(wanted),
            Command::Simulate(form) => {
                if let Some(problem) = form.problem() {
                    self.complain(say!("The simulation needs other numbers"), vec![problem]);
                } else {
                    self.ask_then(NextAction::Simulate(form));
                }
            }
            Command::Adapt => self.adapt(),
            Command::Search => self.search(),
            Command::Prepare => self.asked.previews.resume(),
            Command::OpenOutside { path, in_folder } => self.open_outside(path, in_folder),
            Command::Prefer(preferences) => {
                self.view.preferences = preferences.sound();
                self.keep_preferences();
            }
            Command::View(change) => self.look(change),
            Command::Ask(asked) => self.ask_for(asked),
            Command::Stop(task) => self.stop(task),
            Command::Left(LeftBehind::Restore(index)) => self.restore(index),
            Command::Left(LeftBehind::Discard(index)) => self.discard_left(index),
            Command::Left(LeftBehind::DiscardAll) => self.discard_all_left(),
        }
        if !self.steps().contains(&self.view.step) {
            // Another robot has no regions.
            self.view.step = Step::Identify;
        }
        self.stop_search_of_others();
        self.refresh_answer();
        self.keep_preparing();
        self.keep_drawing();
    }

    /// Asks for a file or a folder.
    fn ask_for(&mut self, asked: Asked) {
        match asked {
            Asked::File => self.choose_file(files::choose_to_open),
            Asked::WhereToSave => self.choose_where_to_save(),
            Asked::Beside(which) => self.choose_beside(which),
            Asked::Import => self.choose_file(files::choose_to_import),
            Asked::WhereToExport(what) => self.choose_where_to_export(what),
            Asked::Folder => self.choose_folder(),
            Asked::Logo => self.choose_logo(),
            Asked::Targets => self.choose_targets(),
        }
    }

    /// Stops what is under way.
    fn stop(&mut self, task: Task) {
        match task {
            Task::Search => self.stop_search(),
            Task::Import => self.cancel_look(),
            Task::Dialog => self.stop_asking(),
            Task::Newest => {
                // What was to be done after it is not wanted any more either.
                self.cancel_pending_action();
                self.cancel_newest();
            }
        }
    }

    /// Looks at the document in another way.
    fn look(&mut self, change: ViewChange) {
        let view = &mut self.view;
        match change {
            ViewChange::GoTo(step) => view.step = step,
            ViewChange::Look(plane) => {
                view.plane = plane;
                view.look(Aspect::Plane);
            }
            ViewChange::LookFrom(from) => {
                view.look(Aspect::Space);
                if let Some(from) = from {
                    view.camera = view.camera.seen_from(from);
                }
            }
            ViewChange::Turn(camera) => view.camera = camera.sound(),
            ViewChange::Pose(q) => view.pose = q,
            ViewChange::Magnify(factor) => {
                view.magnification = factor.filter(|f| f.is_finite() && *f > 0.0);
            }
            ViewChange::PlotSize(size) if size.is_finite() => {
                view.plot_size = size.clamp(20.0, 1e5);
            }
            ViewChange::Blend(t) if t.is_finite() => view.blend = t.clamp(0.0, 1.0),
            ViewChange::Colour(colouring) => view.colouring = colouring,
            ViewChange::Heat(shown) => view.heat = shown,
            ViewChange::Component(component) => view.component = component,
            ViewChange::OnlyAfter(only) => view.only_after = only,
            ViewChange::Hover(sample) => view.hovered = sample,
            ViewChange::Select(sample) => {
                view.selected = sample;
                view.pose = None;
                view.marked.clear();
            }
            ViewChange::Mark(samples) => {
                view.selected = samples.first().copied();
                view.pose = None;
                view.marked = samples;
                view.side = Side::Samples;
            }
            ViewChange::Side(side) => view.side = side,
            ViewChange::Panes(panes) => self.arrange(*panes),
            ViewChange::Pull(panes) => view.panes = *panes,
            ViewChange::Activate(key) => view.panes.activate(key),
            ViewChange::ActivateNext => view.panes.activate_next(),
            ViewChange::ChartJoint(joint) => view.joint = joint,
            ViewChange::ShowEffect(index) => self.show_effect(index),
            ViewChange::Results(open) => view.results = Some(open),
            ViewChange::Resize(sizes) => {
                let preferences = Preferences {
                    sizes,
                    ..view.preferences
                };
                view.preferences = preferences.sound();
            }
            ViewChange::Draft(form) => view.setup = form,
            ViewChange::KeepMine => self.file_state.dismissed = view.on_disk.take(),
            ViewChange::Sheet(sheet) => self.show_sheet(sheet),
            ViewChange::Dismiss => view.message = None,
            ViewChange::Fit => {
                view.fitted.everywhere();
                view.camera = view.camera.fitted();
            }
            ViewChange::FitWorkspace => {
                view.fitted.workspace += 1;
                view.camera = view.camera.fitted();
            }
            ViewChange::FitChart(key) => {
                if let Some(pane) = view.panes.chart_mut(key) {
                    pane.fitted += 1;
                }
            }
            // No number.
            ViewChange::PlotSize(_) | ViewChange::Blend(_) => {}
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
                Some(Sheet::Import(_)) => self.leave_draft(),
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
        if matches!(edit, Edit::Identify | Edit::IdentifyBy(_)) {
            self.asked.questions.resume();
        }
        if !Arc::ptr_eq(&before, self.loaded_session()) {
            self.view.marked.clear();
            self.after_travel(before.lineage);
        }
        if before.lineage != self.loaded_session().lineage {
            self.exported.clear();
            self.leave_effects();
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

    fn complain(&mut self, title: &str, details: impl IntoIterator<Item = impl Into<String>>) {
        let details = details.into_iter().map(Into::into).collect();
        self.view.message = Some(Message::wrong(title, details));
    }
}
