//! The middle: what the user has to know, the workspace, and the chart below it. Where there is no
//! room for both, one of them, and a switch between them.

use egui::{Align, Frame, Layout, Margin, Panel, PanelState, RichText, ScrollArea, Ui};

use crate::gui::preferences::Preferences;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::view::Part;
use crate::gui::workbench::{Command, Workbench};
use crate::gui::{widgets, workspace};

use super::{chart, disk};

/// The least height of the chart with its bar, and of the workspace with its own, points: as much
/// of a window as the user pulls, or makes smaller afterwards, both can be read.
const LOWEST: f32 = 254.0;
const WORKSPACE: f32 = 300.0;
/// What the user has to know takes this part of the middle at most; what is longer scrolls.
const NOTICES: f32 = 0.3;
/// The chart's share of the middle until somebody pulls it.
const SHARE: f32 = 0.34;
/// The chart's panel.
const CHART: &str = "deviation";

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let height = ui.available_height();
    notices(ui, workbench, commands, NOTICES * height);
    let palette = Palette::of(ui);
    let left = ui.available_height();
    let part = |margin| Frame::NONE.fill(palette.surface).inner_margin(margin);
    if left < LOWEST + WORKSPACE {
        part(Margin::same(12)).show(ui, |ui| one(ui, workbench, commands));
        return;
    }
    let share = keep_share(ui, workbench, left, commands);
    let shown = Panel::bottom(CHART)
        .resizable(true)
        .default_size((share * left).max(LOWEST))
        .size_range(LOWEST..=(left - WORKSPACE).max(LOWEST))
        .frame(part(Margin::same(12)))
        .show(ui, |ui| {
            chart::show(ui, workbench, commands);
        });
    let edge = shown.response.rect.center_top();
    for k in [-1.0, 0.0, 1.0] {
        let at = edge + egui::vec2(6.0 * k, 0.0);
        ui.painter().circle_filled(at, 1.5, palette.nominal);
    }
    part(Margin::same(12)).show(ui, |ui| {
        workspace::bar(ui, workbench, None, commands);
        workspace::show(ui, workbench, commands);
    });
}

/// Workspace or chart, where both would be too low to be read.
fn one(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let shown = workbench.view().part;
    if shown == Part::Workspace {
        workspace::bar(ui, workbench, Some(switch), commands);
        workspace::show(ui, workbench, commands);
    } else {
        widgets::row(ui, |ui| switch(ui, workbench, commands));
        chart::show(ui, workbench, commands);
    }
}

fn switch(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let parts = [
        (Part::Workspace, say!("Workspace")),
        (Part::Chart, say!("Chart")),
    ];
    if let Some(part) = widgets::segmented(ui, &parts, workbench.view().part) {
        commands.push(Command::Part(part));
    }
}

/// The chart keeps its share of the middle when the window gets another size: what is right on a
/// laptop would be a strip on a large screen. A share that was pulled is remembered.
fn keep_share(ui: &Ui, workbench: &Workbench, height: f32, commands: &mut Vec<Command>) -> f32 {
    let preferences = workbench.view().preferences;
    let wanted = preferences.sizes.chart.unwrap_or(SHARE);
    let id = ui.scope_id().with(CHART);
    let Some(mut state) = PanelState::load(ui.ctx(), id) else {
        return wanted;
    };
    let now = state.outer_rect.height();
    let kept: Option<Share> = ui.data_mut(|data| data.get_temp(id));
    let mut kept = kept.unwrap_or(Share {
        of: height,
        share: wanted,
        chart: None,
    });
    if kept.of == height {
        // What is not as it was left was pulled.
        if kept.chart.is_some_and(|before| (before - now).abs() > 0.5) {
            kept.share = now / height;
        }
        kept.chart = Some(now);
    } else {
        state.outer_rect.set_height(kept.share * height);
        ui.data_mut(|data| data.insert_persisted(id, state));
        kept.of = height;
        kept.chart = None;
    }
    ui.data_mut(|data| data.insert_temp(id, kept));
    if (kept.share - wanted).abs() > 1e-3 && !ui.input(|i| i.pointer.any_down()) {
        let mut sizes = preferences.sizes;
        sizes.chart = Some(kept.share);
        commands.push(Command::Prefer(Preferences {
            sizes,
            ..preferences
        }));
    }
    kept.share
}

/// The chart's share of the middle as it was wanted, whatever there was room for since.
#[derive(Clone, Copy)]
struct Share {
    /// Height of the middle, points.
    of: f32,
    share: f32,
    /// Height of the chart in the frame before; `None` where it has just been set.
    chart: Option<f32>,
}

/// What the user has to know: never so much that the plots have no room.
fn notices(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>, most: f32) {
    let view = workbench.view();
    let wrong = view.message.as_ref().is_some_and(|m| m.wrong);
    if !wrong && view.on_disk.is_none() {
        return;
    }
    Panel::top("notices")
        .resizable(false)
        .frame(Frame::NONE.fill(Palette::of(ui).inset))
        .show(ui, |ui| {
            let scroll = ScrollArea::vertical()
                .max_height(most)
                .auto_shrink([false, true]);
            scroll.show(ui, |ui| {
                disk::show(ui, workbench, commands);
                message(ui, workbench, commands);
            });
        });
}

fn message(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(message) = workbench.view().message.as_ref().filter(|m| m.wrong) else {
        return;
    };
    let color = Palette::of(ui).outside;
    let frame = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
    frame.show(ui, |ui| {
        ui.horizontal_top(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
                if ui.button(say!("Dismiss")).clicked() {
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
