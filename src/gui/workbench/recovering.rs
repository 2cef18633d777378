//! What is not saved, kept against a crash: when it is written, and how it comes back.

use std::path::Path;
use std::sync::Arc;

use crate::gui::core::edit::Edit;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::file_state::recovery::{self, OrphanedRecovery, SavedDocument};
use crate::gui::view::{Message, Sheet};

use super::{Command, Workbench};

impl Workbench {
    /// Whether recovery lags behind the document.
    pub(crate) fn recovery_lags(&self) -> bool {
        let now = self.history.present();
        let kept = self.file_state.kept.as_ref();
        self.file_state.recovery_file.is_some()
            && match (kept, self.at_risk().any()) {
                (Some(kept), true) => !Arc::ptr_eq(kept, now),
                (Some(_), false) | (None, true) => true,
                (None, false) => !self.file_state.restored.is_empty(),
            }
    }

    /// Writes what is not saved to this window's recovery file, or removes it where all is saved.
    pub(super) fn keep_recovery(&mut self) {
        let Some(path) = self
            .file_state
            .recovery_file
            .as_ref()
            .map(|k| k.path().to_path_buf())
        else {
            return;
        };
        if !self.recovery_lags() {
            return;
        }
        if !self.at_risk().any() {
            self.file_state.kept = None;
            let restored = std::mem::take(&mut self.file_state.restored);
            let work = move || {
                // What was restored is saved: both can go.
                let _ = std::fs::remove_file(&path);
                restored.into_iter().for_each(OrphanedRecovery::remove);
            };
            self.jobs.quietly(work, |_, ()| ());
            return;
        }
        let document = Arc::clone(self.history.present());
        self.file_state.kept = Some(Arc::clone(&document));
        let file = self.file().map(Path::to_path_buf);
        let restored = std::mem::take(&mut self.file_state.restored);
        let work = move || {
            let written = recovery::write(&path, &SavedDocument::of(&document, file));
            if written.is_ok() {
                restored.into_iter().for_each(OrphanedRecovery::remove);
            }
            written.map_err(|e| e.to_string())
        };
        self.jobs.quietly(work, Self::take_kept);
    }

    pub(super) fn take_left_behind(&mut self, left: Vec<OrphanedRecovery>) {
        self.file_state.orphaned = left;
        if !self.file_state.orphaned.is_empty() && self.view.sheet.is_none() {
            self.view.sheet = Some(Sheet::RECOVERY);
        }
    }

    /// Brings back what was left behind.
    pub(super) fn restore(&mut self, index: usize) {
        if index >= self.file_state.orphaned.len() {
            return;
        }
        let left = self.file_state.orphaned.remove(index);
        self.close_recovery();
        match &left.kept {
            Ok(kept) => {
                let mut session = kept.session.clone();
                session.path.clone_from(&kept.file);
                let origin = Origin::Recovered(kept.file.clone());
                let loaded_session = Arc::new(LoadedSession::new(session, Vec::new(), origin));
                let edit = Edit::Recover(loaded_session, kept.choices());
                self.execute(Command::Edit(edit));
                self.file_state.restored.push(left);
                self.keep_recovery();
                self.view.message = Some(Message::done(
                    say!("Restored; it is not saved yet").to_owned(),
                    Vec::new(),
                ));
            }
            Err(because) => {
                let because = because.clone();
                let aside = left.put_aside();
                self.complain(
                    say!("What was left behind is damaged and cannot be restored"),
                    vec![
                        because,
                        say!("It is kept as {aside}", aside = aside.display()),
                    ],
                );
            }
        }
    }

    /// Discards what was left behind.
    pub(super) fn discard_left(&mut self, index: usize) {
        if index < self.file_state.orphaned.len() {
            let left = self.file_state.orphaned.remove(index);
            if left.kept.is_ok() {
                left.remove();
            } else {
                left.put_aside();
            }
        }
        self.close_recovery();
    }

    pub(super) fn discard_all_left(&mut self) {
        while !self.file_state.orphaned.is_empty() {
            self.discard_left(0);
        }
    }

    fn close_recovery(&mut self) {
        if self.file_state.orphaned.is_empty() && self.view.sheet == Some(Sheet::RECOVERY) {
            self.view.sheet = None;
        }
    }
}
