//! What the background tasks bring back, and what becomes of it.

use std::sync::Arc;

use crate::gui::core::edit::Edit;
use crate::gui::jobs::Report;
use crate::gui::view::{Message, Sheet};

use super::{Command, Workbench};

impl Workbench {
    /// Gives the memory of what was worked out before back elsewhere: with many samples that takes
    /// longer than a frame may.
    fn let_go(&mut self, before: Option<impl Send + 'static>) {
        const MANY: usize = 100_000;
        if before.is_some() && self.subject().len() > MANY {
            self.tasks.quietly(move || {
                drop(before);
                Report::Kept(Ok(()))
            });
        }
    }

    /// Takes what the tasks have brought. Whether there was anything.
    pub(crate) fn receive(&mut self) -> bool {
        let mut any = false;
        loop {
            let reports = self.tasks.reports();
            if reports.is_empty() {
                return any;
            }
            any = true;
            for report in reports {
                self.take(report);
            }
        }
    }

    fn take(&mut self, report: Report) {
        match report {
            Report::Opened(Ok(subject)) => self.execute(Command::Edit(Edit::Open(subject))),
            Report::Foreign(foreign) => self.view.sheet = Some(Sheet::Import(foreign)),
            Report::Looked(looked) => self.take_looked(*looked),
            Report::ChosenBeside(which, path) => self.take_beside(which, path),
            Report::OpenedModel(Ok(given)) => {
                let beside = self.has_a_session_for(&given);
                self.execute(Command::Edit(Edit::OpenModel { given, beside }));
            }
            Report::Opened(Err(message))
            | Report::OpenedModel(Err(message))
            | Report::Listed(Err(message))
            | Report::Exported(Err(message)) => {
                self.stay();
                self.view.message = Some(message);
            }
            Report::Saved(saved) => self.take_saved(*saved),
            Report::Kept(kept) => self.take_kept(kept),
            Report::LeftBehind(left) => self.take_left_behind(left),
            Report::Seen(seen) => self.take_seen(seen),
            Report::Extended(extended) => self.take_extended(*extended),
            Report::ChosenToOpen(Some(path)) => self.execute(Command::OpenFile(path)),
            Report::ChosenToOpen(None) => self.no_file_was_chosen(),
            Report::ChosenToSave(Some(path)) => self.execute(Command::SaveAs {
                path,
                // The dialog has asked.
                replace: true,
            }),
            Report::ChosenToSave(None) => {
                self.view.sheet = Some(Sheet::SavePath {
                    path: self.proposed_path().display().to_string(),
                    replace: false,
                });
            }
            Report::Answered(outcome) => {
                let before = self.outcome.replace(Arc::new(*outcome));
                self.let_go(before);
                self.keep_preparing();
                self.keep_drawing();
            }
            Report::Searched(search) => {
                self.searched = Some(Arc::new(*search));
                // What is in the model may be just what was found, with the search's values.
                self.keep_asking();
                self.keep_drawing();
            }
            Report::Adapted(adapted) => self.take_adapted(*adapted),
            Report::Drawn(backdrop) => {
                let before = self.backdrop.replace(Arc::new(*backdrop));
                self.let_go(before);
            }
            Report::Prepared(preview) => self.preview = Some(*preview),
            Report::ChosenToExport(what, Some(path)) => self.execute(Command::ExportTo {
                what,
                path,
                // The dialog has asked.
                replace: true,
            }),
            Report::ChosenToExport(what, None) => {
                let path = self.placed(self.name_of(what).as_ref());
                let path = path.display().to_string();
                self.view.sheet = Some(Sheet::ExportPath {
                    what,
                    path,
                    replace: false,
                });
            }
            Report::Lettered(found) => self.letters.take(*found),
            Report::Written(message) => self.take_written(message),
            Report::Figured(figures) => {
                self.figures = Some(*figures);
                // What is shown may be another answer by now.
                self.keep_figuring();
            }
            Report::Listed(Ok(path)) => self.take_written(Message {
                wrong: false,
                title: format!("Saved {}", path.display()),
                details: Vec::new(),
            }),
            Report::Exported(Ok(path)) => {
                self.model_is_on_file();
                self.view.message = Some(Message {
                    wrong: false,
                    title: format!("Saved {}", path.display()),
                    details: Vec::new(),
                });
                self.remember_name(&path);
                self.exported.retain(|other| *other != path);
                self.exported.push(path);
                self.keep_preparing();
                self.go_on();
            }
            Report::Broken => {
                self.stop_figuring();
                self.complain(
                    "Something went wrong inside the program",
                    vec![
                        "Nothing was changed; save your work, and please report what you did last"
                            .to_owned(),
                    ],
                );
            }
        }
    }

    /// Something was written, or not: what was to be done then is done, or is not.
    fn take_written(&mut self, message: Message) {
        let written = !message.wrong;
        self.view.message = Some(message);
        if written {
            self.go_on();
        } else {
            self.stay();
        }
    }

    /// Cancelled, or there is no dialog on this system: nobody can tell the two apart.
    fn no_file_was_chosen(&mut self) {
        self.view.message = Some(Message {
            wrong: false,
            title: "No file was chosen".to_owned(),
            details: vec![
                "If no dialog appeared, drop the file on the window, or type its path in the \
                 Session step"
                    .to_owned(),
            ],
        });
    }
}
