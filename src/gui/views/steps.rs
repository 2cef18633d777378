//! The left-hand side: the steps, the controls of the chosen one, and what to do next.

use egui::{Panel, Ui, UiBuilder};

use crate::gui::core::document::Method;
use crate::gui::style::room::Room;
use crate::gui::style::tokens::space;
use crate::gui::units::number_of;
use crate::gui::view::Step;
use crate::gui::widgets::{self, Progress, StepRow};
use crate::gui::workbench::{Command, Workbench};

use super::{export, gap, identify, regions, session};

/// The button at the foot stands no lower than this below the top of its panel, points.
const HIGHEST: f32 = 960.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, room: Room, commands: &mut Vec<Command>) {
    // On a high screen the button at the foot would be far from what it belongs to.
    let mut rect = ui.available_rect_before_wrap();
    rect.set_height(rect.height().min(HIGHEST));
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        all(ui, workbench, room, commands);
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, room: Room, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 2.0;
    for (index, step) in Step::ALL.into_iter().enumerate() {
        let (caption, progress) = state(workbench, step);
        let selected = workbench.view().step == step;
        let row = StepRow {
            number: index + 1,
            name: step.name(),
            caption: &caption,
            progress,
            selected,
            low: room.low,
        };
        let row = row.show(ui);
        if row.clicked() {
            commands.push(Command::GoTo(step));
        }
    }
    ui.spacing_mut().item_spacing.y = space::ROW;
    ui.add_space(space::ROW);
    ui.separator();
    let frame = egui::Frame::NONE.inner_margin(egui::Margin::ZERO);
    Panel::bottom("next")
        .resizable(false)
        .show_separator_line(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.add_space(space::ROW);
            match workbench.view().step {
                Step::Session => session::next(ui, workbench, commands),
                Step::Regions => regions::next(ui, workbench, commands),
                Step::Identify => identify::next(ui, workbench, commands),
                Step::Gap => gap::next(ui, workbench, commands),
                Step::Export => export::next(ui, workbench, commands),
            }
        });
    let step = workbench.view().step;
    widgets::scroll(ui, ("controls", step.name()), |ui| match step {
        Step::Session => session::show(ui, workbench, commands),
        Step::Regions => regions::show(ui, workbench, commands),
        Step::Identify => identify::show(ui, workbench, commands),
        Step::Gap => gap::show(ui, workbench, commands),
        Step::Export => export::show(ui, workbench, commands),
    });
}

/// What a step has to show for itself.
fn state(workbench: &Workbench, step: Step) -> (String, Progress) {
    let document = workbench.document();
    let done = |done: bool| {
        if done { Progress::Done } else { Progress::Open }
    };
    match step {
        Step::Session if workbench.subject().is_empty() => {
            ("a model, nothing measured".to_owned(), Progress::Done)
        }
        Step::Session => {
            let samples = number_of(workbench.subject().len(), "sample");
            (samples, Progress::Done)
        }
        Step::Regions if workbench.subject().is_empty() && document.regions.is_empty() => {
            ("nothing measured".to_owned(), Progress::Open)
        }
        Step::Regions if document.regions.is_empty() => {
            ("not for this robot".to_owned(), Progress::Open)
        }
        Step::Regions => {
            let used = document.identified && document.method == Method::Regional;
            let regions = number_of(document.regions.len(), "region");
            (regions, done(used))
        }
        Step::Identify => {
            let caption = match (document.identified, document.method) {
                _ if document.given.is_some() => "model from a file".to_owned(),
                (false, _) => "not yet".to_owned(),
                (true, Method::Regional) => "by region".to_owned(),
                (true, Method::Exact) => {
                    let n = document.effects.len();
                    let effects = if n == 1 { "effect" } else { "effects" };
                    format!("exact, {n} {effects}")
                }
            };
            (caption, done(workbench.answer().is_some()))
        }
        Step::Gap => gap::state(workbench),
        Step::Export => match workbench.exported().and_then(|path| path.file_name()) {
            Some(name) => (name.to_string_lossy().into_owned(), Progress::Done),
            None => ("not yet".to_owned(), Progress::Open),
        },
    }
}
