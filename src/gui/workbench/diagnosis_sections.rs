//! What a diagnosis says, kept until it is another one or is to be said otherwise: it is shown in every frame.

use std::sync::Arc;

use super::Workbench;
use crate::explain::{Detail, Section, diagnosis};
use crate::present::numbers::notation;
use crate::text::current;

impl Workbench {
    /// What the diagnosis of the open session says; nothing where there is none.
    pub(crate) fn diagnosis_sections(&self) -> Arc<[Section]> {
        let (Some(search), Some(found)) = (self.searched.as_ref(), self.diagnosis()) else {
            return Arc::default();
        };
        let voice = (self.units(), current(), notation());
        let mut said = self.spoken_sections.0.borrow_mut();
        let kept = said
            .take()
            .filter(|(whose, how, _)| Arc::ptr_eq(whose, search) && *how == voice);
        let (_, _, sections) = said.insert(kept.unwrap_or_else(|| {
            let sections = diagnosis(found, Detail::window(voice.0)).into();
            (Arc::clone(search), voice, sections)
        }));
        Arc::clone(sections)
    }
}
