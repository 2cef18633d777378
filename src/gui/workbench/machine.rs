//! The record of the machine: what its report states, whether it is within its tolerance and what became
//! of it, and robots that were typed. Remembered from one day to the next.

use crate::compensation::decision::{Outcome, Rule};
use crate::gui::core::robot_table::{RobotTable, remember};
use crate::gui::file_state::{self, Machine, Stated};
use crate::gui::files;
use crate::gui::view::What;
use crate::language::spoken;
use crate::present::decision::rests_on;

use super::Workbench;

impl Workbench {
    /// Report details: as they were typed, or as they are proposed.
    pub(crate) fn stated(&self) -> Stated {
        self.typed().cloned().unwrap_or_else(|| {
            let session = &self.loaded_session().session;
            let folder = self.folder().unwrap_or_default();
            let mut stated =
                file_state::proposed(&self.file_state.settings.machines, session, &folder);
            if let (true, Some(today)) = (stated.details.date.is_empty(), &self.file_state.today) {
                stated.details.date.clone_from(today);
            }
            stated
        })
    }

    /// What was typed for the report of what is open.
    fn typed(&self) -> Option<&Stated> {
        self.file_state.stated.get(&self.loaded_session().lineage)
    }

    /// Report details are these now; remembered once their sheet is closed.
    pub(crate) fn state(&mut self, stated: Stated) {
        self.file_state
            .stated
            .insert(self.loaded_session().lineage, stated);
    }

    /// Remembers them for the next session of this machine.
    pub(super) fn keep_stated(&mut self) {
        let Some(stated) = self.typed() else {
            return;
        };
        let folder = self.folder().unwrap_or_default();
        let machine = Machine::new(&self.loaded_session().session, &folder, stated);
        self.keep(move |kept| file_state::remember(&mut kept.machines, machine.clone()));
    }

    /// Asks for a picture.
    pub(crate) fn choose_logo(&mut self) {
        let of = self.loaded_session().lineage;
        self.choose_near(files::choose_logo, move |bench, path| {
            if bench.loaded_session().lineage == of {
                let logo = path.display().to_string();
                bench.state(Stated {
                    logo,
                    ..bench.stated()
                });
                bench.keep_stated();
            }
        });
    }

    /// Whether the robot is within its tolerance by the rule that was chosen, and what that rests on;
    /// `None` where no rule is chosen, no tolerance stated, or it is being worked out.
    pub(crate) fn decision(&self) -> Option<Result<(Outcome, String), String>> {
        let (rule, tolerance) = self.rule_and_tolerance()?;
        let measured = match self.figures()? {
            Ok(made) => made.measured.clone().map_err(spoken),
            Err(because) => Err(because.clone()),
        };
        Some(measured.map(|m| (m.decided(rule, tolerance), rests_on(&m, rule, tolerance))))
    }

    /// How many samples are within the tolerance with corrected commands, where that was worked out.
    pub(crate) fn corrected_within(&self) -> Option<usize> {
        let made = self.figures()?.as_ref().ok()?;
        made.measured.as_ref().ok()?.within?.corrected
    }

    /// Whether more samples are within the tolerance by the model than with corrected commands: marks show the model.
    pub(crate) fn model_promises_more(&self) -> bool {
        let tolerance_mm = self.document().tolerance_mm;
        let promised = tolerance_mm.and_then(|mm| Some(self.answer()?.lengths.within(mm).0));
        let kept = self.corrected_within();
        kept.zip(promised)
            .is_some_and(|(kept, promised)| kept < promised)
    }

    pub(super) fn rule_and_tolerance(&self) -> Option<(Rule, f64)> {
        Some((self.stated().details.rule?, self.document().tolerance_mm?))
    }

    /// Robots that were typed, newest first.
    pub(crate) fn typed_robots(&self) -> &[RobotTable] {
        &self.file_state.settings.robots
    }

    /// Remembers one, and asks for a file to save it to where that is wanted.
    pub(crate) fn keep_robot(&mut self, table: RobotTable, save: bool) {
        self.keep(move |kept| remember(&mut kept.robots, table.clone()));
        if save {
            self.choose_where_to_export(What::TypedRobot);
        }
    }

    /// Forgets the one of this name.
    pub(crate) fn forget_robot(&mut self, name: &str) {
        let name = name.to_owned();
        self.keep(move |kept| kept.robots.retain(|own| own.name != name));
    }
}

#[cfg(test)]
mod tests {
    use crate::gui::testing::workbench;

    #[test]
    fn the_date_of_a_report_is_proposed_and_can_be_another() {
        let mut workbench = workbench();
        assert_eq!(workbench.stated().details.date, "");
        workbench.file_state.today = Some("2026-11-23".to_owned());
        let mut stated = workbench.stated();
        assert_eq!(stated.details.date, "2026-11-23");
        stated.details.date.clear();
        workbench.state(stated);
        assert_eq!(workbench.stated().details.date, "", "it was taken away");
    }
}
