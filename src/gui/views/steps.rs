//! The left-hand side: the steps, the controls of the chosen one, and what to do next.

use egui::{Panel, Ui, UiBuilder};

use crate::gui::style::layout::Layout;
use crate::gui::style::tokens::space;
use crate::gui::widgets::{self, StepRow};
use crate::gui::workbench::{Command, ViewChange, Workbench};

use super::{StepView, export, gap, identify, regions, session};

/// Every step.
static STEPS: [StepView; 5] = [
    session::STEP,
    regions::STEP,
    identify::STEP,
    gap::STEP,
    export::STEP,
];

/// The button at the foot stands no lower than this below the top of its panel, points.
const HIGHEST: f32 = 960.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, room: Layout, commands: &mut Vec<Command>) {
    // On a high screen the button at the foot would be far from what it belongs to.
    let mut rect = ui.available_rect_before_wrap();
    rect.set_height(rect.height().min(HIGHEST));
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        all(ui, workbench, room, commands);
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, room: Layout, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let now = workbench.view().step;
    let view_of = |step| STEPS.iter().find(|view| view.step == step);
    let chosen = view_of(now).unwrap_or(&STEPS[0]);
    let offered = workbench.steps().iter().filter_map(|step| view_of(*step));
    for (index, view) in offered.enumerate() {
        let step = view.step;
        let (caption, progress) = (view.state)(workbench);
        let selected = now == step;
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
            commands.push(Command::View(ViewChange::GoTo(step)));
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
            (chosen.next)(ui, workbench, commands);
        });
    widgets::scroll(ui, ("controls", chosen.step.name()), |ui| {
        (chosen.show)(ui, workbench, commands);
    });
}
