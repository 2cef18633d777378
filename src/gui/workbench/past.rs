//! What became of the machine: the sessions of a folder, compared in the background.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::state::Past;
use crate::gui::files;
use crate::gui::jobs::{Kind, Watch};
use crate::gui::view::{Message, Sheet};
use crate::language::finding;
use crate::pipeline;
use crate::progress::ReadError;

use super::{Asked, Command, Workbench};

impl Workbench {
    /// The sessions that were compared last.
    pub(crate) fn past(&self) -> Option<&Past> {
        self.file_state.past.as_deref()
    }

    /// Compares the sessions that lie beside the open one; asks for a folder where it is in no file.
    pub(crate) fn compare_here(&self) -> Command {
        match self.folder() {
            Some(folder) => Command::CompareSessions(folder),
            None => Command::Ask(Asked::Folder),
        }
    }

    /// Asks for a folder of sessions.
    pub(super) fn choose_folder(&mut self) {
        let near = self.file().map(Path::to_path_buf);
        let ask = move || files::choose_folder(near.as_deref());
        self.choose(
            say!("waiting for a folder to be chosen"),
            ask,
            |bench, folder| {
                if let Some(folder) = folder {
                    bench.execute(Command::CompareSessions(folder));
                }
            },
        );
    }

    /// Compares the sessions of a folder, and shows what changed.
    pub(super) fn compare_sessions(&mut self, folder: PathBuf) {
        let says = say!(
            "comparing the sessions of {folder}",
            folder = folder.display()
        );
        let work = move |watch: &Watch| {
            let told = pipeline::history_watched(&folder, &watch.progress_callback());
            (folder, told)
        };
        self.jobs.start(
            Kind::Once,
            says,
            work,
            |bench: &mut Self, (folder, told)| match told {
                Ok(history) => {
                    bench.file_state.past = Some(Arc::new(Past { folder, history }));
                    bench.view.sheet = Some(Sheet::HISTORY);
                }
                Err(ReadError::Cancelled(_)) => {}
                Err(ReadError::Rejected(rejected)) => {
                    let lines = rejected.diagnostics.iter().take(5);
                    let title = say!("There are no sessions to compare").to_owned();
                    let details = lines.map(finding).collect();
                    bench.view.message = Some(Message::wrong(title, details));
                }
            },
        );
    }
}
