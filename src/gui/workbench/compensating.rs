//! Files of targets: chosen, corrected by the model that is shown, saved.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gui::core::compensated::{Compensated, CompensationRequest, MOST_KG};
use crate::gui::files;
use crate::gui::jobs::{Kind, Watch};
use crate::gui::view::{Sheet, What};

use super::background::no_file_was_chosen;
use super::{Command, Workbench};

impl Workbench {
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

    /// Corrects the targets of a file that was opened.
    pub(super) fn compensate_file(&mut self, path: PathBuf) {
        self.compensate(CompensationRequest::new(path));
    }

    /// Corrects the targets of a file by the model that is shown.
    pub(super) fn compensate(&mut self, mut wanted: CompensationRequest) {
        let (Some(outcome), Some(_)) = (self.identified.clone(), self.answer()) else {
            return self.complain(
                say!("There is no model to correct targets by"),
                vec![say!("Identify the robot first, or open a model").to_owned()],
            );
        };
        // What is typed is within the field's range; a command need not be.
        wanted.load_kg = match wanted.load_kg {
            load if load.is_nan() => 0.0,
            load => load.clamp(0.0, MOST_KG),
        };
        let model = self.name_of(What::Model);
        let name = wanted
            .path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        let says = say!("correcting the targets of {name}", name = name);
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
                vec![say!("Choose a table of targets or a robot program first").to_owned()],
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
