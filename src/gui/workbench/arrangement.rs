//! Which panels there are.

use std::mem::discriminant;

use crate::gui::view::Arrangement;

use super::Workbench;

impl Workbench {
    /// Which panels there are now.
    pub(crate) fn arrangement(&self) -> Arrangement {
        let view = self.view();
        let shown = view.panes.charts();
        let shown = shown.map(|(_, pane)| self.kind(pane).about().id);
        Arrangement {
            view: (view.step, view.side, view.aspect, view.results),
            language: view.preferences.language,
            panes: (view.panes.outline(), shown.collect()),
            sheet: view.sheet.as_ref().map(discriminant),
            message: view.message.clone(),
            has: [
                view.on_disk.is_some(),
                self.answer().is_some(),
                self.searching().is_some(),
                self.searched().is_some(),
                self.export().is_some(),
            ],
            session: self.loaded_session().lineage,
        }
    }
}
