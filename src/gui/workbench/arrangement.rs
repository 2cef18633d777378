//! Which panels there are.

use std::mem::discriminant;

use crate::gui::view::Arrangement;

use super::Workbench;

impl Workbench {
    /// Which panels there are now.
    pub(crate) fn arrangement(&self) -> Arrangement {
        let view = self.view();
        Arrangement {
            view: (view.step, view.side, view.part, view.aspect, view.results),
            language: view.preferences.language,
            chart: self.chart().about().id,
            sheet: view.sheet.as_ref().map(discriminant),
            message: view.message.clone(),
            has: [
                view.on_disk.is_some(),
                self.answer().is_some(),
                self.searching().is_some(),
                self.searched().is_some(),
                self.export().is_some(),
            ],
            session: self.subject().lineage,
        }
    }
}
