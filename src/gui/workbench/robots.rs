//! Robots that were typed: remembered from one day to the next.

use super::Workbench;
use crate::gui::core::robot_table::{RobotTable, remember};
use crate::gui::file_state::settings;
use crate::gui::view::What;

impl Workbench {
    /// Robots that were typed, newest first.
    pub(crate) fn typed_robots(&self) -> &[RobotTable] {
        &self.file_state.robots
    }

    /// Remembers one, and asks for a file to save it to where that is wanted.
    pub(super) fn keep_robot(&mut self, table: RobotTable, save: bool) {
        remember(&mut self.file_state.robots, table.clone());
        if let Some(home) = self.file_state.home.clone() {
            self.jobs.quietly(
                move || settings::keep_robot(&home, table).map_err(|e| e.to_string()),
                Self::take_kept,
            );
        }
        if save {
            self.choose_where_to_export(What::TypedRobot);
        }
    }

    /// Forgets the one of this name.
    pub(super) fn forget_robot(&mut self, name: &str) {
        self.file_state.robots.retain(|own| own.name != name);
        if let Some(home) = self.file_state.home.clone() {
            let name = name.to_owned();
            self.jobs.quietly(
                move || settings::forget_robot(&home, &name).map_err(|e| e.to_string()),
                Self::take_kept,
            );
        }
    }
}
