//! What is about to change the document: a file that an instrument wrote, from what is said about it to the session
//! that it becomes; regions where the samples ask for them.

use std::sync::Arc;

use crate::sessions::Region;
use crate::text::spoken;

use crate::gui::core::disk::name_of;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::regions::{Counts, Decision, adapt};
use crate::gui::files;
use crate::gui::import_draft::{Companion, ImportDraft, InspectedDraft, LOOKING};
use crate::gui::jobs::{Kind, Running, Watch};
use crate::gui::view::{Message, Sheet};

use super::Workbench;

impl Workbench {
    fn import_draft(&mut self) -> Option<&mut ImportDraft> {
        match &mut self.view.sheet {
            Some(Sheet::Import(foreign)) => Some(foreign),
            _ => None,
        }
    }

    /// Shows a file that an instrument wrote; with what had been said of it when it was left.
    pub(super) fn ask_about(&mut self, draft: Box<ImportDraft>) {
        let left = &mut self.file_state.left_draft;
        let draft = match left.take_if(|left| left.is_of_the_file_of(&draft)) {
            Some(mut before) => {
                // The files beside it may have changed.
                before.seen = draft.seen;
                Box::new(before)
            }
            None => draft,
        };
        self.view.sheet = Some(Sheet::Import(draft));
        self.keep_looking();
    }

    /// The sheet is closed without an import: what was said is kept for when the file is opened again.
    pub(super) fn leave_draft(&mut self) {
        self.cancel_look();
        let left = self.import_draft().filter(|draft| draft.holds_answers());
        let Some(left) = left.map(|draft| draft.clone()) else {
            return;
        };
        self.view.message = Some(Message::done(
            say!("{file} was not imported", file = name_of(&left.path)),
            vec![say!("What was entered is kept: open it again to go on").to_owned()],
        ));
        self.file_state.left_draft = Some(left);
    }

    /// The look at a foreign file that is under way.
    pub(crate) fn looking(&self) -> Option<&Running> {
        self.jobs.running(Kind::Looks)
    }

    /// Cancels that look, whatever else is under way.
    pub(crate) fn cancel_look(&mut self) {
        self.jobs.cancel(|kind| kind == Kind::Looks);
    }

    /// Asks for a file beside it.
    pub(crate) fn choose_beside(&mut self, which: Companion) {
        let measured = self.import_draft().map(|foreign| foreign.path.clone());
        let of = measured.clone();
        let ask = move || files::choose_beside(which, measured.as_deref());
        self.choose(ask, move |bench, path| {
            // The field is there to type it where no dialog is.
            if let (Some(draft), Some(path)) = (bench.import_draft(), path)
                && Some(&draft.path) == of.as_ref()
            {
                let path = path.to_string_lossy().into_owned();
                draft.answers.choose(which, path);
            }
            bench.keep_looking();
        });
    }

    /// One look at a time; when it is done, the next with what was said meanwhile.
    pub(crate) fn keep_looking(&mut self) {
        if self.looking().is_some() {
            return;
        }
        let Some(foreign) = self.import_draft().filter(|f| !f.is_up_to_date()) else {
            return;
        };
        let foreign = foreign.clone();
        let work = move |watch: &Watch| {
            let seen = foreign.look(watch);
            if let Ok(InspectedDraft {
                trial: Some(Ok(trial)),
                ..
            }) = &seen
            {
                // Made here, so that the window never waits for it.
                trial.loaded_session.cloud();
            }
            (seen, foreign)
        };
        self.jobs.start(
            Kind::Looks,
            spoken(LOOKING),
            work,
            |bench: &mut Self, (seen, of)| {
                // A cancelled one has no result.
                let Ok(seen) = seen else { return };
                if let Some(draft) = bench.import_draft() {
                    draft.take(&of, seen);
                }
                bench.keep_looking();
            },
        );
    }

    /// Opens the session that the sheet shows.
    pub(crate) fn import(&mut self) {
        let result = self.import_draft().and_then(|foreign| {
            let trial = foreign.result()?;
            Some(Arc::clone(&trial.loaded_session))
        });
        if let Some(loaded_session) = result {
            self.view.sheet = None;
            self.file_state.left_draft = None;
            self.replace(|document| document.open(loaded_session));
        }
    }
}

/// Regions, what decided for them, and of which session.
type Adapted = (Arc<LoadedSession>, Result<(Vec<Region>, Decision), String>);

/// Looks where the samples ask for regions. Takes its time with many samples.
pub(super) fn adapted(loaded_session: Arc<LoadedSession>) -> Adapted {
    let made = adapt(&loaded_session.session);
    (loaded_session, made)
}

impl Workbench {
    /// The samples of each region, and those in none.
    pub(crate) fn counted(&self) -> Arc<Counts> {
        let (loaded_session, regions) = (self.loaded_session(), &self.document().regions);
        let of = (Arc::clone(loaded_session), Arc::clone(regions));
        let count = || Arc::new(loaded_session.counted(regions));
        self.derived.counted.get(of, count)
    }

    /// Looks where the samples ask for regions.
    pub(crate) fn adapt(&mut self) {
        let loaded_session = Arc::clone(self.loaded_session());
        if loaded_session.is_empty() || !loaded_session.single_revolute() {
            return self.complain(
                say!("This change cannot be made"),
                [say!(
                    "regions divide what was measured with a single joint that turns"
                )],
            );
        }
        self.jobs.start(
            Kind::Once,
            say!("looking where regions are needed"),
            move |_| adapted(loaded_session),
            Self::take_adapted,
        );
    }

    pub(super) fn take_adapted(&mut self, (loaded_session, made): Adapted) {
        if !Arc::ptr_eq(&loaded_session, self.loaded_session()) {
            return self.is_of_another(say!("This change cannot be made"));
        }
        match made {
            Ok((regions, decision)) => self.edit(|document| document.adapt(regions, decision)),
            Err(because) => {
                self.complain(say!("This change cannot be made"), vec![because]);
            }
        }
    }
}
