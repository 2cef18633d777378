//! Regions: divided where the samples ask for it, and their boundaries while they are typed.

use std::sync::Arc;

use crate::gui::core::boundaries::{End, Typed};
use crate::gui::core::document::{Decision, adapt};
use crate::gui::core::edit::Edit;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::jobs::Kind;
use crate::sessions::Region;

use super::{Command, Workbench};

/// Regions, what decided for them, and of which session.
type Adapted = (Arc<LoadedSession>, Result<(Vec<Region>, Decision), String>);

/// Looks where the samples ask for regions. Takes its time with many samples.
pub(super) fn adapted(loaded_session: Arc<LoadedSession>) -> Adapted {
    let made = adapt(&loaded_session.session);
    (loaded_session, made)
}

impl Workbench {
    /// Looks where the samples ask for regions.
    pub(super) fn adapt(&mut self) {
        let loaded_session = Arc::clone(self.loaded_session());
        if loaded_session.is_empty() || !loaded_session.single_revolute() {
            return self.complain(
                say!("This change cannot be made"),
                vec![
                    say!("regions divide what was measured with a single joint that turns")
                        .to_owned(),
                ],
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
            // Another session is open now: the answer is about the old one.
            return;
        }
        match made {
            Ok((regions, decision)) => {
                let edit = Edit::Adapt(regions.into(), decision);
                self.execute(Command::Edit(edit));
            }
            Err(because) => {
                self.complain(say!("This change cannot be made"), vec![because]);
            }
        }
    }

    /// Keeps what is typed for an end of a region, or forgets it.
    pub(super) fn type_boundary(&mut self, region: String, end: End, text: Option<String>) {
        let here = |t: &Typed| t.region == region && t.end == end;
        self.view.typed.retain(|t| !here(t));
        if let Some(text) = text {
            self.view.typed.push(Typed { region, end, text });
        }
        self.forget_typed();
    }

    /// What is typed stays with its region whatever that is called.
    pub(super) fn keep_typed(&mut self, edit: &Edit) {
        if let Edit::Rename(region, _) = edit {
            let regions = &self.history.present().regions;
            let lost = |name: &String| regions.iter().all(|r| r.name != *name);
            if let Some(renamed) = regions.get(*region) {
                for typed in self.view.typed.iter_mut().filter(|t| lost(&t.region)) {
                    typed.region.clone_from(&renamed.name);
                }
            }
        }
        self.forget_typed();
    }

    /// Nothing is typed for a region that is gone.
    pub(super) fn forget_typed(&mut self) {
        let regions = &self.history.present().regions;
        let there = |t: &Typed| regions.iter().any(|r| r.name == t.region);
        self.view.typed.retain(there);
    }
}
