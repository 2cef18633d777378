//! Everything that can be done, and the one place that does it.
//!
//! Panels and plots read the [`Workbench`] and send [`Command`]s; [`Workbench::execute`] is the
//! only function that changes anything.

mod charts;
mod command;
mod desk;
mod follow;
mod papers;
mod reports;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(crate) use command::Command;

use desk::Desk;

use crate::diagnosis::{Diagnosis, measuring_list};
use crate::gui::backdrop::{Backdrop, Scenery};
use crate::gui::document::{Document, Method, Question};
use crate::gui::edit::Edit;
use crate::gui::figures::Figures;
use crate::gui::files::{self, Replace};
use crate::gui::given::Given;
use crate::gui::keeping::settings::Recent;
use crate::gui::layers::{Heat, Nearest};
use crate::gui::outcome::{After, Answer, Outcome};
use crate::gui::preview::{Made, Preview, Wanted};
use crate::gui::reporting::About;
use crate::gui::search::Search;
use crate::gui::subject::Subject;
use crate::gui::tasks::{Report, Tasks, What};
use crate::gui::undo::History;
use crate::gui::units::Units;
use crate::gui::view::{Aspect, Canvas, Message, Plane, Sheet, Side, Step, Then, ViewState};
use crate::sessions::Samples;

/// Document, view, answer and tasks.
pub(crate) struct Workbench {
    history: History<Document>,
    /// The session that nobody opened: the window began with it.
    first: Arc<Subject>,
    desk: Desk,
    /// A question that was cancelled: it is not asked again by itself.
    declined: Option<Question>,
    /// Whether samples are being put behind those that are there.
    extending: bool,
    /// Samples that came meanwhile, and whether they take the place of all others.
    waiting_samples: Option<(Samples, bool)>,
    view: ViewState,
    outcome: Option<Arc<Outcome>>,
    searched: Option<Arc<Search>>,
    preview: Option<Preview>,
    backdrop: Option<Arc<Backdrop>>,
    /// Files that were exported from this session, the newest last.
    exported: Vec<PathBuf>,
    figures: Option<Figures>,
    tasks: Tasks,
}

impl Workbench {
    /// A workbench with a session on it.
    pub(crate) fn new(subject: Arc<Subject>, tasks: Tasks) -> Self {
        let first = Arc::clone(&subject);
        let history = History::new(Document::new(subject));
        let mut workbench = Self {
            first,
            desk: Desk::default(),
            declined: None,
            extending: false,
            waiting_samples: None,
            history,
            view: ViewState::default(),
            outcome: None,
            searched: None,
            preview: None,
            backdrop: None,
            exported: Vec::new(),
            figures: None,
            tasks,
        };
        workbench.remember_on_file(Arc::clone(workbench.history.present()));
        workbench.look_along_the_axis();
        workbench
    }

    /// The document.
    pub(crate) fn document(&self) -> &Document {
        self.history.present()
    }

    /// The session.
    pub(crate) fn subject(&self) -> &Arc<Subject> {
        &self.document().subject
    }

    /// How it is looked at.
    pub(crate) fn view(&self) -> &ViewState {
        &self.view
    }

    /// The chosen units.
    pub(crate) fn units(&self) -> Units {
        Units {
            length: self.view.preferences.length,
            angle: self.view.preferences.angle,
        }
    }

    /// The tasks.
    pub(crate) fn tasks(&self) -> &Tasks {
        &self.tasks
    }

    /// What undo takes back.
    pub(crate) fn undoes(&self) -> Option<&'static str> {
        self.history.undoes()
    }

    /// What redo brings back.
    pub(crate) fn redoes(&self) -> Option<&'static str> {
        self.history.redoes()
    }

    /// Whether a model can be held against the open session: both are of the same robot. The
    /// session that the window began with counts only where the model came from it.
    fn has_a_session_for(&self, given: &Given) -> bool {
        let subject = self.subject();
        if Arc::ptr_eq(subject, &self.first) {
            given.came_from(&subject.session)
        } else {
            !subject.is_empty() && given.is_of(&subject.session)
        }
    }

    /// The newest answer for the present session, or why there is none. While a newer question is
    /// being answered it is the answer to the one before.
    pub(crate) fn outcome(&self) -> Option<&Outcome> {
        let document = self.document();
        self.outcome.as_deref().filter(|outcome| {
            let question = &outcome.question;
            document.identified
                && Arc::ptr_eq(&question.subject, &document.subject)
                && document.question().is_some_and(|asked| {
                    std::mem::discriminant(&asked.asks) == std::mem::discriminant(&question.asks)
                })
        })
    }

    /// The newest answer.
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.outcome().and_then(|o| o.answer.as_ref().ok())
    }

    /// What follows from the newest answer, for drawing.
    pub(crate) fn after(&self) -> Option<&After> {
        self.outcome().and_then(|o| o.after.as_ref())
    }

    fn backdrop(&self) -> Option<&Backdrop> {
        let backdrop = self.backdrop.as_deref()?;
        Arc::ptr_eq(&backdrop.scenery.subject, self.subject()).then_some(backdrop)
    }

    /// Which sample is where in the plane; `None` where they are few, or while it is being found
    /// out.
    pub(crate) fn nearest(&self) -> Option<&Nearest> {
        let seen = |b: &&Backdrop| b.scenery.plane == self.view.plane;
        self.backdrop().filter(seen)?.nearest.as_deref()
    }

    /// The heat map, if it is shown. While a newer one is being made it is the one before.
    pub(crate) fn heat(&self) -> Option<&Arc<Heat>> {
        let seen = |b: &&Backdrop| self.view.heat && b.scenery.plane == self.view.plane;
        self.backdrop().filter(seen)?.heat.as_ref()
    }

    /// Samples that are drawn where not all can be; `None` where they are few, or until they are
    /// chosen.
    pub(crate) fn thinned(&self) -> Option<&[u32]> {
        let seen = |b: &&Backdrop| b.scenery.plane == self.view.plane;
        let thinned = self.backdrop().filter(seen)?.thinned.as_deref()?;
        Some(&thinned.samples)
    }

    /// The export as it would be written, or why there is none. While a newer one is being made it
    /// is the one before.
    pub(crate) fn export(&self) -> Option<Result<&Made, &String>> {
        self.answer()?;
        let preview = self.preview.as_ref()?;
        let same = Arc::ptr_eq(&preview.wanted.outcome.question.subject, self.subject());
        same.then_some(preview.made.as_ref())
    }

    /// The file that was exported last, of this session.
    pub(crate) fn exported(&self) -> Option<&PathBuf> {
        self.exported.last()
    }

    /// Whether the identification was cancelled: nobody asks again by himself.
    pub(crate) fn is_declined(&self) -> bool {
        self.declined.is_some() && self.document().question() == self.declined
    }

    /// Whether the answer that is shown belongs to the document as it is.
    #[cfg(test)]
    pub(crate) fn settled(&self) -> bool {
        match (self.document().question(), &self.outcome) {
            (None, _) => true,
            (Some(asked), Some(outcome)) => outcome.question == asked,
            (Some(_), None) => false,
        }
    }

    /// Does it.
    pub(crate) fn execute(&mut self, command: Command) {
        match command {
            Command::Edit(edit) => self.edit(&edit, false),
            Command::Drag(edit) => self.edit(&edit, true),
            Command::EndDrag => self.history.finish_gesture(),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            Command::ChooseFile => {
                self.tasks.start("waiting for a file to be chosen", |_| {
                    files::choose_to_open()
                });
            }
            Command::OpenFile(path) => self.ask_then(Then::Open(path)),
            Command::OpenExample(index) => self.ask_then(Then::Example(index)),
            Command::Leave => self.ask_then(Then::Leave),
            Command::Do(then) => self.go(then),
            Command::SaveThen(then) => self.save_then(then),
            Command::Save | Command::ChooseWhereToSave | Command::SaveAs { .. }
                if self.subject().is_empty() =>
            {
                self.complain(
                    "There is no session to save",
                    vec!["A model by itself is saved in the Export step".to_owned()],
                );
            }
            Command::ChooseWhereToSave => {
                let name = files::file_name_for(&self.document().subject.session);
                self.tasks.start("waiting for a file name", move |_| {
                    files::choose_to_save(&name)
                });
            }
            Command::Inspect(foreign) => {
                // What was typed meanwhile is not lost while it is looked at.
                self.view.sheet = Some(Sheet::Import(foreign.clone()));
                self.tasks.start("looking at the file", move |_| {
                    Report::Foreign(Box::new(foreign.looked_at()))
                });
            }
            Command::Import(foreign) => {
                self.tasks
                    .start("importing", move |_| match foreign.import() {
                        Ok(subject) => Report::Opened(Ok(Arc::new(subject))),
                        Err(refused) => Report::Foreign(refused),
                    });
            }
            Command::Save => self.save_here(),
            Command::SaveAs { path, replace } => {
                let replace = if replace {
                    Replace::Named
                } else {
                    Replace::Nothing
                };
                self.save_to(&path, replace);
            }
            Command::SaveDespite => {
                if let Some(path) = self.file().map(Path::to_path_buf) {
                    self.save_to(&path, Replace::Whatever);
                }
            }
            Command::Forget(path) => self.use_recent(Recent::Forgotten(path)),
            Command::Restore(index) => self.restore(index),
            Command::DiscardLeft(index) => self.discard_left(index),
            Command::Reload => self.reload(),
            Command::Follow(on) => self.follow(on),
            Command::KeepRecovery => self.keep_recovery(),
            Command::LookAtDisk => self.tasks.look_at_disk(),
            Command::ChooseWhereToExport(what) => {
                let name = self.name_of(what);
                self.tasks.start("waiting for a file name", move |_| {
                    files::choose_to_export(what, &name)
                });
            }
            Command::ExportTo {
                what,
                path,
                replace,
            } => {
                self.view.sheet = None;
                self.export_to(what, path, replace);
            }
            Command::Simulate(form) => {
                if let Some(problem) = form.problem() {
                    self.complain("The simulation needs other numbers", vec![problem]);
                } else {
                    self.ask_then(Then::Simulate(form));
                }
            }
            Command::Search => self.search(),
            Command::StopSearch => self.tasks.cancel_search(),
            Command::Cancel => {
                if let Some(question) = self.tasks.cancel_newest() {
                    self.declined = Some(question);
                }
            }
            other => self.look(other),
        }
        self.keep_asking();
        self.keep_preparing();
        self.keep_drawing();
    }

    fn look(&mut self, command: Command) {
        let view = &mut self.view;
        match command {
            Command::GoTo(step) => view.step = step,
            Command::Look(plane) => (view.plane, view.aspect) = (plane, Aspect::Plane),
            Command::LookAround => view.aspect = Aspect::Around,
            Command::Magnify(factor) => {
                view.magnification = factor.filter(|f| f.is_finite() && *f > 0.0);
            }
            Command::Blend(t) if t.is_finite() => view.blend = t.clamp(0.0, 1.0),
            Command::Colour(colouring) => view.colouring = colouring,
            Command::Heat(shown) => view.heat = shown,
            Command::Canvas(canvas) => view.canvas = canvas,
            Command::Component(component) => view.component = component,
            Command::OnlyAfter(only) => view.only_after = only,
            Command::Hover(sample) => view.hovered = sample,
            Command::Select(sample) => {
                view.selected = sample;
                view.marked.clear();
            }
            Command::Mark(samples) => {
                view.selected = samples.first().copied();
                view.marked = samples;
                view.side = Side::Samples;
            }
            Command::Side(side) => view.side = side,
            Command::Chart(chart) => self.choose_chart(chart),
            Command::ChartJoint(joint) => view.joint = joint,
            Command::ShowEffect(index) => self.show_effect(index),
            Command::Prefer(preferences) => {
                view.preferences = preferences.sound();
                self.keep_preferences();
            }
            Command::Draft(form) => view.setup = form,
            Command::KeepMine => view.on_disk = None,
            Command::Sheet(sheet) => {
                if matches!(
                    (&self.view.sheet, &sheet),
                    (
                        Some(
                            Sheet::Unsaved(_)
                                | Sheet::Overwrite(_)
                                | Sheet::SavePath { .. }
                                | Sheet::ExportPath { .. }
                        ),
                        None
                    )
                ) {
                    // Whoever closes the question wants neither.
                    self.stay();
                }
                self.view.sheet = sheet;
            }
            Command::Dismiss => view.message = None,
            Command::Fit => view.fitted += 1,
            _ => {}
        }
        self.forget_missing_samples();
    }

    fn edit(&mut self, edit: &Edit, within_gesture: bool) {
        let before = Arc::clone(self.subject());
        match edit.apply(self.document()) {
            Err(because) => self.complain("This change cannot be made", vec![because]),
            Ok(next) if within_gesture => self.history.change_within_gesture(next, edit.what()),
            Ok(next) => self.history.change(next, edit.what()),
        }
        self.view.setup = None;
        if matches!(edit, Edit::Identify | Edit::IdentifyBy(_)) {
            self.declined = None;
        }
        if !Arc::ptr_eq(&before, self.subject()) {
            self.view.marked.clear();
            self.after_travel(before.lineage);
        }
        if before.lineage != self.subject().lineage {
            self.exported.clear();
            self.look_along_the_axis();
            self.view.step = Step::Session;
            self.view.fitted += 1;
            self.view.message = None;
            self.opened();
        }
    }

    /// Back or forth in the history.
    fn travel(&mut self, way: fn(&mut History<Document>) -> bool) {
        let before = self.subject().lineage;
        way(&mut self.history);
        self.after_travel(before);
    }

    /// After a change that may have brought another session.
    fn after_travel(&mut self, lineage_before: u64) {
        self.view.setup = None;
        self.forget_missing_samples();
        if self.subject().lineage != lineage_before {
            self.arrived();
        }
    }

    fn forget_missing_samples(&mut self) {
        let samples = self.subject().len();
        let there = |sample: &usize| *sample < samples;
        self.view.hovered = self.view.hovered.filter(there);
        self.view.selected = self.view.selected.filter(there);
        self.view.marked.retain(there);
    }

    /// Looks at the workspace in the plane in which joint 1 turns.
    fn look_along_the_axis(&mut self) {
        let along = self.subject().joint.along;
        self.view.aspect = Aspect::Plane;
        let steepest = (0..3).max_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()));
        self.view.plane = Plane::ALL
            .into_iter()
            .find(|plane| Some(plane.normal()) == steepest)
            .unwrap_or_default();
    }

    fn complain(&mut self, title: &str, details: Vec<String>) {
        self.view.message = Some(Message {
            wrong: true,
            title: title.to_owned(),
            details,
        });
    }

    /// What an export's file is called unless the user says otherwise.
    pub(crate) fn name_of(&self, what: What) -> String {
        let document = self.document();
        let session = &document.subject.session.name;
        match what {
            What::Table => document.export.file_name(session),
            What::Model => format!("{}.model.json", crate::gui::document::plain(session)),
            What::Poses => format!("{}-next-poses.csv", crate::gui::document::plain(session)),
            What::Report(About::Session) => {
                format!("{}-report.html", crate::gui::document::plain(session))
            }
            What::Report(About::Model) => {
                format!("{}-model-report.html", crate::gui::document::plain(session))
            }
            What::Picture(plot) => plot.file_name(session),
        }
    }

    /// What a search of the open session found, or why it found nothing out.
    pub(crate) fn searched(&self) -> Option<Result<&Diagnosis, &String>> {
        let search = self.searched.as_ref()?;
        Arc::ptr_eq(&search.subject, self.subject()).then_some(search.answer.as_ref())
    }

    /// The diagnosis of the open session.
    pub(crate) fn diagnosis(&self) -> Option<&Diagnosis> {
        self.searched().and_then(Result::ok)
    }

    /// A search begins where the exact identification ends.
    fn search(&mut self) {
        if self.subject().is_empty() {
            return self.complain(
                "There is nothing to search yet",
                vec!["Open a session that was measured on this robot".to_owned()],
            );
        }
        let document = self.document();
        let exact =
            document.identified && document.method == Method::Exact && document.given.is_none();
        if !exact {
            self.edit(&Edit::IdentifyBy(Method::Exact), false);
        }
        self.tasks.search(Arc::clone(self.subject()));
    }

    fn export_to(&mut self, what: What, path: PathBuf, replace: bool) {
        match what {
            What::Report(about) => return self.write_report(about, path, replace),
            What::Picture(plot) => return self.write_picture(plot, path, replace),
            What::Table | What::Model | What::Poses => {}
        }
        if what == What::Poses {
            let Some(diagnosis) = self.diagnosis() else {
                return self.complain(
                    "There is no measuring list yet",
                    vec!["Search for the gap first, in step 4".to_owned()],
                );
            };
            let list = measuring_list(&diagnosis.next_poses, &self.subject().session.robot);
            let says = format!("writing {}", path.display());
            self.tasks
                .start(says, move |_| files::write_list(list, &path, replace));
            return;
        }
        // From what is shown, but under the name that was chosen.
        let (Some(outcome), Some(_)) = (self.outcome.clone(), self.answer()) else {
            return self.complain(
                "There is nothing to export yet",
                vec!["Identify the robot first, in step 3".to_owned()],
            );
        };
        let choice = self.document().export;
        let says = format!("writing {}", path.display());
        self.tasks.start(says, move |_| {
            let wanted = Wanted { outcome, choice };
            files::export(wanted, what, &path, replace)
        });
    }

    /// Asks for the preview that the export step shows.
    fn keep_preparing(&mut self) {
        self.keep_figuring();
        // A model by itself has nothing to show but its table.
        let shown = self.view.step == Step::Export || self.subject().is_empty();
        if !shown || self.answer().is_none() {
            return;
        }
        let Some(outcome) = self.outcome.clone() else {
            return;
        };
        let choice = self.document().export;
        let wanted = Wanted { outcome, choice };
        let made = self.preview.as_ref().is_some_and(|p| p.wanted == wanted);
        if !made && !self.tasks.is_wanted(&wanted) {
            self.tasks.prepare(wanted);
        }
    }

    /// Asks for what the plots stand on, if it is not there and not on its way.
    fn keep_drawing(&mut self) {
        let outcome = self.outcome.clone().filter(|_| self.outcome().is_some());
        let scenery = Scenery {
            subject: Arc::clone(self.subject()),
            outcome,
            plane: self.view.plane,
            heat: self.view.heat,
            thins: self.view.canvas == Canvas::Shapes,
            polar: self.view.polar(),
            component: self.view.component,
            chart: self.charting(),
        };
        let there = self.backdrop.as_ref().is_some_and(|b| b.scenery == scenery);
        if scenery.any() && !there && !self.tasks.is_drawn(&scenery) {
            self.tasks.draw(scenery, self.backdrop.clone());
        }
    }

    /// Asks for the answer that the document wants, if it is not there and not on its way.
    fn keep_asking(&mut self) {
        let Some(question) = self.document().question() else {
            return;
        };
        let answered = self
            .outcome
            .as_ref()
            .is_some_and(|o| o.question == question);
        let declined = self.declined.as_ref() == Some(&question);
        if !answered && !declined && !self.tasks.is_asked(&question) {
            self.declined = None;
            self.tasks.ask(Question {
                live: self.following().is_some(),
                ..question
            });
        }
    }
}
