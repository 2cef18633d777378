//! Tables, models and measuring lists: what they are called, and how they are written.

use std::path::{Path, PathBuf};

use crate::export::find;
use crate::gui::cache::identified::PreviewRequest;
use crate::gui::core::compensated::Compensated;
use crate::gui::core::document::plain;
use crate::gui::files;
use crate::gui::jobs::Watch;
use crate::gui::view::{About, Plot, What};
use crate::kinematics::Robot;
use crate::pipeline::measuring_list;
use crate::robots::named;
use crate::sessions::robot_document;

use super::Workbench;

impl Workbench {
    /// What an export's file is called unless the user says otherwise.
    pub(crate) fn name_of(&self, what: What) -> String {
        let document = self.document();
        let session = &document.loaded_session.session.name;
        match what {
            What::Table => document.export.file_name(session),
            What::Model => format!("{}.model.json", plain(session)),
            What::Poses => format!("{}-next-poses.csv", plain(session)),
            What::Report(About::Session) => {
                format!("{}-report.html", plain(session))
            }
            What::Report(About::Model) => {
                format!("{}-model-report.html", plain(session))
            }
            What::Picture(plot) => plot.file_name(session, "svg"),
            What::Numbers(chart) => Plot::Chart(chart).file_name(session, "csv"),
            What::Robot(id) => format!("{id}.json"),
            What::TypedRobot => {
                let name = self
                    .file_state
                    .robots
                    .first()
                    .map(|table| table.name.as_str());
                format!("{}.json", plain(name.unwrap_or_default()))
            }
            What::Targets => {
                let path = self.compensated().map(Compensated::proposed_path);
                path.unwrap_or_default().display().to_string()
            }
        }
    }

    /// A table was saved: what is to be entered in the controller names this file from now on.
    pub(super) fn remember_name(&mut self, path: &Path) {
        let choice = self.document().export;
        let ending = find(choice.format).map(|format| format.extension);
        let name = path.file_name().and_then(|name| name.to_str());
        let is_table = path.extension().and_then(|e| e.to_str()) == ending;
        if let (true, Some(name)) = (is_table, name) {
            self.saved_as = Some((choice, name.to_owned()));
        }
    }

    pub(super) fn export_to(&mut self, what: What, path: PathBuf, replace: bool) {
        match what {
            What::Report(about) => return self.write_report(about, path, replace),
            What::Picture(plot) => return self.write_picture(plot, path, replace),
            What::Numbers(chart) => return self.write_numbers(chart, path, replace),
            What::Targets => return self.write_targets(path, replace),
            What::Robot(id) => {
                let robot = named(id).ok().map(|found| found.robot.clone());
                return self.write_robot(robot, path, replace);
            }
            What::TypedRobot => {
                let table = self.file_state.robots.first();
                let robot = table.and_then(|table| table.robot().ok());
                return self.write_robot(robot, path, replace);
            }
            What::Table | What::Model | What::Poses => {}
        }
        if what == What::Poses {
            let Some(diagnosis) = self.diagnosis() else {
                return self.complain(
                    say!("There is no measuring list yet"),
                    vec![say!("Run the diagnosis first").to_owned()],
                );
            };
            let list = measuring_list(&diagnosis.next_poses, &self.loaded_session().session.robot);
            let work = move |path: &Path, _: &Watch| files::write_list(list, path, replace);
            self.write(path, work, Self::take_written);
            return;
        }
        // From what is shown, but under the name that was chosen.
        let (Some(outcome), Some(_)) = (self.identified.clone(), self.answer()) else {
            return self.complain(
                say!("There is nothing to export yet"),
                vec![say!("Identify the robot first").to_owned()],
            );
        };
        let choice = self.document().export;
        let work = move |path: &Path, _: &Watch| {
            let wanted = PreviewRequest {
                identified: outcome,
                choice,
                name: None,
            };
            files::export(&wanted, what, path, replace)
        };
        self.write(path, work, Self::take_exported);
    }

    /// Writes what a chart shows as a table.
    fn write_numbers(&mut self, chart: &str, path: PathBuf, replace: bool) {
        let Some(numbers) = self.numbers_of(chart) else {
            return;
        };
        let work = move |path: &Path, _: &Watch| files::write_list(numbers().csv(), path, replace);
        self.write(path, work, Self::take_written);
    }

    /// Writes a robot as a file of its own.
    fn write_robot(&mut self, robot: Option<Robot>, path: PathBuf, replace: bool) {
        let Some(robot) = robot else {
            return;
        };
        let document = robot_document(&robot);
        let work = move |path: &Path, _: &Watch| files::write_list(document, path, replace);
        self.write(path, work, Self::take_written);
    }
}
