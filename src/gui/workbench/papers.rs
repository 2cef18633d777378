//! Reports, pictures and the standards' figures: what is written about a session.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::cache::identified::Figures;
use crate::gui::files;
use crate::gui::files::reporting::{self, Source};
use crate::gui::jobs::Watch;
use crate::gui::view::{About, Plot, Step};
use crate::report::exported::sidecar_of;
use crate::sessions::samples_path;

use super::Workbench;

impl Workbench {
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
                let of_this = |s: &&Arc<_>| self.is_search_of_this(s);
                let searched = self.searched.as_ref().filter(of_this).cloned();
                let in_use = self.identified.clone().filter(|_| self.answer().is_some());
                Source::Session(Arc::clone(self.history.present()), searched, in_use)
            }
            _ => {
                return self.complain(
                    say!("There is nothing to report yet"),
                    vec![say!("Open a session, or identify the robot first").to_owned()],
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

    fn is_search_of_this(&self, search: &crate::gui::core::search::Search) -> bool {
        Arc::ptr_eq(&search.loaded_session, self.loaded_session()) && search.answer.is_ok()
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
        if !wanted || self.loaded_session().is_empty() || self.answer().is_none() {
            return;
        }
        let floor_mm = self.diagnosis().map(|found| found.floor.mm);
        let Some(outcome) = self.identified.clone() else {
            return;
        };
        let there = self.figures.as_ref().is_some_and(|f| {
            f.made.is_none() || f.floor_mm == floor_mm && Arc::ptr_eq(&f.identified, &outcome)
        });
        if there {
            return;
        }
        self.figures = Some(Figures {
            identified: Arc::clone(&outcome),
            floor_mm,
            made: None,
        });
        self.jobs.quietly(
            move || Figures::of(outcome, floor_mm),
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
}
