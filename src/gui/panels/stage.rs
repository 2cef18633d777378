//! The middle: what the user has to know, the workspace, and the chart below it.

use egui::{Align, Frame, Layout, Margin, Panel, PanelState, RichText, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::plots::workspace;
use crate::gui::tokens::{Palette, size, strong};

use super::{charts, disk};

/// The least height of the chart with its bar, and of the workspace with its own, points: as much
/// of a window as the user pulls, or makes smaller afterwards, neither vanishes.
const LOWEST: f32 = 182.0;
const WORKSPACE: f32 = 256.0;
/// The chart's panel.
const CHART: &str = "deviation";

/// Shows the middle.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    disk::show(ui, workbench, commands);
    message(ui, workbench, commands);
    let palette = Palette::of(ui);
    let height = ui.available_height();
    let part = |margin| Frame::NONE.fill(palette.surface).inner_margin(margin);
    keep_share(ui, height);
    Panel::bottom(CHART)
        .resizable(true)
        .default_size((0.34 * height).max(LOWEST))
        .size_range(LOWEST..=(height - WORKSPACE).max(LOWEST))
        .frame(part(Margin::same(12)))
        .show(ui, |ui| {
            charts::show(ui, workbench, commands);
        });
    part(Margin::same(12)).show(ui, |ui| {
        workspace::bar(ui, workbench, commands);
        workspace::show(ui, workbench, commands);
    });
}

/// The chart keeps its share of the middle when the window gets another size: what is right on a
/// laptop would be a strip on a large screen.
fn keep_share(ui: &Ui, height: f32) {
    let id = ui.scope_id().with(CHART);
    let before: Option<f32> = ui.data_mut(|data| data.get_temp(id));
    ui.data_mut(|data| data.insert_temp(id, height));
    let (Some(before), Some(mut state)) = (before, PanelState::load(ui.ctx(), id)) else {
        return;
    };
    if before > 0.0 && before != height {
        let share = state.outer_rect.height() * height / before;
        state.outer_rect.set_height(share);
        ui.data_mut(|data| data.insert_persisted(id, state));
    }
}

fn message(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(message) = &workbench.view().message else {
        return;
    };
    let palette = Palette::of(ui);
    let color = if message.wrong {
        palette.outside
    } else {
        // Neither praise nor blame: what was done, or that nothing was.
        palette.text
    };
    let frame = Frame::NONE
        .fill(palette.inset)
        .inner_margin(Margin::symmetric(14, 10));
    Panel::top("message")
        .resizable(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
                    if ui.button("Dismiss").clicked() {
                        commands.push(Command::Dismiss);
                    }
                    ui.with_layout(Layout::top_down(Align::Min), |ui| {
                        ui.spacing_mut().item_spacing.y = 3.0;
                        let title = RichText::new(&message.title);
                        let title = title.font(strong(size::BODY)).color(color);
                        ui.add(egui::Label::new(title).wrap());
                        for line in &message.details {
                            ui.add(egui::Label::new(RichText::new(line).size(size::NOTE)).wrap());
                        }
                    });
                });
            });
        });
}
