//! What is written beside the session: tables, models and measuring lists, reports and pictures, files
//! of targets that the shown model corrects. What they are called, and how they are written.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::compensation::decision::FittedErrors;
use crate::export::find;
use crate::gui::cache::identified::{Figures, PreviewRequest};
use crate::gui::charts;
use crate::gui::core::answer::Search;
use crate::gui::core::compensated::{Compensated, CompensationRequest, MOST_KG};
use crate::gui::core::disk::name_of;
use crate::gui::core::document::plain;
use crate::gui::files;
use crate::gui::files::reporting::{self, Source};
use crate::gui::jobs::{Kind, Watch};
use crate::gui::view::{About, Plot, Sheet, Step, What};
use crate::kinematics::Robot;
use crate::pipeline::measuring_list;
use crate::report::exported::sidecar_of;
use crate::robots::named;
use crate::sessions::{robot_document, samples_path};

use super::background::no_file_was_chosen;
use super::{Command, Workbench};

impl Workbench {
    /// What an export's file is called unless the user says otherwise.
    pub(crate) fn name_of(&self, what: What) -> String {
        let document = self.document();
        let session = &document.loaded_session.session.name;
        match what {
            What::Table => document.export.file_name(session),
            What::Model => format!("{}.model.json", plain(session)),
            What::Poses => format!("{}-next-poses.csv", plain(session)),
            What::Report(About::Session) => {
                format!("{}-report.html", plain(session))
            }
            What::Report(About::Model) => {
                format!("{}-model-report.html", plain(session))
            }
            What::Picture(plot) => plot.file_name(session, "svg"),
            What::Numbers(chart) => Plot::Chart(chart).file_name(session, "csv"),
            What::Robot(id) => format!("{id}.json"),
            What::TypedRobot => {
                let name = self
                    .file_state
                    .robots
                    .first()
                    .map(|table| table.name.as_str());
                format!("{}.json", plain(name.unwrap_or_default()))
            }
            What::Targets => {
                let path = self.compensated().map(Compensated::proposed_path);
                path.unwrap_or_default().display().to_string()
            }
        }
    }

    /// What is exported by this name: `table`, `model`, `poses`, `report`, `report of the model` or `targets`; a plot
    /// by its own; `data of` a chart.
    pub(crate) fn export_named(name: &str) -> Option<What> {
        Some(match name {
            "table" => What::Table,
            "model" => What::Model,
            "poses" => What::Poses,
            "report" => What::Report(About::Session),
            "report of the model" => What::Report(About::Model),
            "targets" => What::Targets,
            _ => {
                if let Some(chart) = name.strip_prefix("data of ") {
                    return Some(What::Numbers(charts::find(chart)?.about().id));
                }
                let chart = charts::find(name).map(|chart| Plot::Chart(chart.about().id));
                let plots = [Plot::Workspace, Plot::Space, Plot::Polar];
                let mut all = plots.into_iter().chain(chart);
                What::Picture(all.find(|plot| plot.name() == name)?)
            }
        })
    }

    /// A table was saved: what is to be entered in the controller names this file from now on.
    pub(super) fn remember_name(&mut self, path: &Path) {
        let choice = self.document().export;
        let ending = find(choice.format).map(|format| format.extension);
        let name = path.file_name().and_then(|name| name.to_str());
        let is_table = path.extension().and_then(|e| e.to_str()) == ending;
        if let (true, Some(name)) = (is_table, name) {
            self.saved_as = Some((choice, name.to_owned()));
        }
    }

    pub(super) fn export_to(&mut self, what: What, path: PathBuf, replace: bool) {
        match what {
            What::Report(about) => return self.write_report(about, path, replace),
            What::Picture(plot) => return self.write_picture(plot, path, replace),
            What::Numbers(chart) => return self.write_numbers(chart, path, replace),
            What::Targets => return self.write_targets(path, replace),
            What::Robot(id) => {
                let robot = named(id).ok().map(|found| found.robot.clone());
                return self.write_robot(robot, path, replace);
            }
            What::TypedRobot => {
                let table = self.file_state.robots.first();
                let robot = table.and_then(|table| table.robot().ok());
                return self.write_robot(robot, path, replace);
            }
            What::Table | What::Model | What::Poses => {}
        }
        if what == What::Poses {
            let Some(diagnosis) = self.diagnosis() else {
                return self.complain(
                    say!("There is no measuring list yet"),
                    [say!("Run the diagnosis first")],
                );
            };
            let list = measuring_list(&diagnosis.next_poses, &self.loaded_session().session.robot);
            let work = move |path: &Path, _: &Watch| files::write_list(list, path, replace);
            self.write(path, work, Self::take_written);
            return;
        }
        // From what is shown, but under the name that was chosen.
        let Some(outcome) = self.shown_outcome() else {
            return self.complain(
                say!("There is nothing to export yet"),
                [say!("Identify the robot first")],
            );
        };
        let choice = self.document().export;
        let work = move |path: &Path, _: &Watch| {
            let wanted = PreviewRequest {
                identified: outcome,
                choice,
                name: None,
            };
            files::export(&wanted, what, path, replace)
        };
        self.write(path, work, Self::take_exported);
    }

    /// Writes what a chart shows as a table.
    fn write_numbers(&mut self, chart: &str, path: PathBuf, replace: bool) {
        let Some(numbers) = self.numbers_of(chart) else {
            return;
        };
        let work = move |path: &Path, _: &Watch| files::write_list(numbers().csv(), path, replace);
        self.write(path, work, Self::take_written);
    }

    /// Writes a robot as a file of its own.
    fn write_robot(&mut self, robot: Option<Robot>, path: PathBuf, replace: bool) {
        let Some(robot) = robot else {
            return;
        };
        let document = robot_document(&robot);
        let work = move |path: &Path, _: &Watch| files::write_list(document, path, replace);
        self.write(path, work, Self::take_written);
    }

    /// Everything that the open session, its model and its tables stand in: no paper replaces it.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        let mut inputs: Vec<PathBuf> = self
            .loaded_session()
            .files
            .iter()
            .map(|f| f.path.clone())
            .collect();
        if let Some(file) = self.file() {
            inputs.extend([file.to_path_buf(), samples_path(file)]);
        }
        inputs.extend(self.samples_file().map(PathBuf::from));
        inputs.extend(
            self.document()
                .loaded_model
                .as_ref()
                .map(|given| given.path.clone()),
        );
        for (table, _) in &self.exported {
            inputs.extend([table.clone(), sidecar_of(table)]);
        }
        inputs
    }

    pub(super) fn write_report(&mut self, about: About, path: PathBuf, replace: bool) {
        let source = match (about, &self.identified, self.answer()) {
            (About::Model, Some(outcome), Some(_)) => Source::Model(Arc::clone(outcome)),
            (About::Session, ..) if !self.loaded_session().is_empty() => {
                let answered = |search: &&Arc<Search>| search.answer.is_ok();
                let searched = self.search_of_this().filter(answered).cloned();
                let in_use = self.shown_outcome();
                Source::Session(Arc::clone(self.history.present()), searched, in_use)
            }
            _ => {
                return self.complain(
                    say!("There is nothing to report yet"),
                    [say!("Open a session, or identify the robot first")],
                );
            }
        };
        let stated = self.stated();
        let folder = self.folder().filter(|_| !stated.without_history);
        let robot = self.loaded_session().session.robot.name.clone();
        let wanted = reporting::ReportRequest {
            source,
            past: folder.map(|folder| (folder, robot)),
            stated,
            tables: self.exported().cloned().collect(),
            inputs: self.inputs(),
        };
        let work =
            move |path: &Path, watch: &Watch| reporting::write(&wanted, path, replace, watch);
        self.write(path, work, Self::take_written);
    }

    pub(super) fn write_picture(&mut self, plot: Plot, path: PathBuf, replace: bool) {
        let (draw, inputs) = ((self.draw)(self, plot), self.inputs());
        let work = move |path: &Path, watch: &Watch| {
            files::write_picture(draw, path, replace, &inputs, watch)
        };
        self.write(path, work, Self::take_written);
    }

    /// The standards' figures of what is shown; while newer ones are worked out, the ones before.
    pub(crate) fn figures(&self) -> Option<&Figures> {
        self.answer()?;
        let figures = self.figures.as_ref()?;
        let same = Arc::ptr_eq(
            &figures.identified.question.loaded_session,
            self.loaded_session(),
        );
        same.then_some(figures)
    }

    /// Asks for the figures that the export step shows; one at a time, in the background.
    pub(super) fn keep_figuring(&mut self) {
        // A decision stands in the results of every step.
        let wanted = self.view.step == Step::Export || self.rule_and_tolerance().is_some();
        if !wanted || self.loaded_session().is_empty() {
            return;
        }
        let Some(outcome) = self.shown_outcome() else {
            return;
        };
        let diagnosed = self.diagnosis().map(FittedErrors::from);
        let there = self.figures.as_ref().is_some_and(|f| {
            f.made.is_none() || f.diagnosed == diagnosed && Arc::ptr_eq(&f.identified, &outcome)
        });
        if there {
            return;
        }
        self.figures = Some(Figures {
            identified: Arc::clone(&outcome),
            diagnosed,
            made: None,
        });
        self.jobs.quietly(
            move || Figures::of(outcome, diagnosed),
            |bench: &mut Self, figures| {
                bench.figures = Some(figures);
                // What is shown may be another answer by now.
                bench.keep_figuring();
            },
        );
    }

    /// A task broke off: it may have been the one that everybody waits for.
    pub(super) fn stop_figuring(&mut self) {
        if let Some(figures) = self.figures.as_mut().filter(|f| f.made.is_none()) {
            figures.made = Some(Err(say!("The figures could not be computed").to_owned()));
        }
    }

    /// The file of targets that was corrected last.
    pub(crate) fn compensated(&self) -> Option<&Compensated> {
        self.compensated.as_deref()
    }

    /// Asks for a file of targets.
    pub(super) fn choose_targets(&mut self) {
        let near = self.file().map(Path::to_path_buf);
        let ask = move || files::choose_targets(near.as_deref());
        self.choose(
            say!("waiting for a file to be chosen"),
            ask,
            |bench, path| match path {
                Some(path) => bench.execute(Command::Compensate(CompensationRequest::new(path))),
                None => bench.view.message = Some(no_file_was_chosen()),
            },
        );
    }

    /// Corrects the targets of a file by the model that is shown.
    pub(super) fn compensate(&mut self, mut wanted: CompensationRequest) {
        let Some(outcome) = self.shown_outcome() else {
            return self.complain(
                say!("There is no model to correct targets by"),
                [say!("Identify the robot first, or open a model")],
            );
        };
        // What is typed is within the field's range; a command need not be.
        wanted.load_kg = match wanted.load_kg {
            load if load.is_nan() => 0.0,
            load => load.clamp(0.0, MOST_KG),
        };
        let model = self.name_of(What::Model);
        let name = name_of(&wanted.path);
        let says = say!("correcting the targets of {name}", name);
        let work = move |_: &Watch| {
            Some(match outcome.handed_out() {
                Ok(verified) => Compensated::of(&verified, &model, wanted),
                Err(says) => Compensated::refused(wanted, says),
            })
        };
        self.jobs
            .start(Kind::Once, says, work, |bench: &mut Self, compensated| {
                bench.compensated = compensated.map(Arc::new);
                if bench.compensated.is_some() {
                    bench.view.sheet = Some(Sheet::COMPENSATION);
                }
            });
    }

    /// Writes the corrected targets, and what was changed beside them.
    pub(super) fn write_targets(&mut self, path: PathBuf, replace: bool) {
        let Some(compensated) = self.compensated.clone() else {
            return self.complain(
                say!("There are no corrected targets yet"),
                [say!("Choose a table of targets or a robot program first")],
            );
        };
        let mut inputs = self.inputs();
        inputs.push(compensated.wanted.path.clone());
        let work = move |path: &Path, _: &Watch| {
            files::write_targets(&compensated, path, replace, &inputs)
        };
        self.write(path, work, Self::take_written);
    }
}
