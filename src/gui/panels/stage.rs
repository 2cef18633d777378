//! The middle: what the user has to know, the workspace, and the deviation below it.

use egui::{Align, ComboBox, Frame, Layout, Margin, Panel, RichText, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::pictures::Plot;
use crate::gui::plots::{correction, deviation, picture, waterfall, workspace};
use crate::gui::subject::Component;
use crate::gui::tokens::{Palette, size, space, strong};
use crate::gui::view::{Lower, Step};
use crate::gui::widgets::{self, caption, title};

use super::disk;

/// Shows the middle.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    disk::show(ui, workbench, commands);
    message(ui, workbench, commands);
    let palette = Palette::of(ui);
    let height = ui.available_height();
    let view = workbench.view();
    let part = |margin| Frame::NONE.fill(palette.surface).inner_margin(margin);
    Panel::bottom("deviation")
        .resizable(true)
        .default_size((0.34 * height).max(172.0))
        .size_range(172.0..=(0.7 * height).max(180.0))
        .frame(part(Margin::same(12)))
        .show(ui, |ui| {
            let alone = workbench.subject().is_empty();
            let table = view.step == Step::Export || alone;
            let waterfall = offers_waterfall(workbench) && view.lower == Lower::Waterfall;
            let made = workbench.export().and_then(Result::ok).filter(|_| table);
            // A description of the robot has no curve; then the samples are more to look at.
            if let Some(made) = made.filter(|made| alone || made.export.reads_as.is_some()) {
                ui.horizontal(|ui| {
                    title(ui, "Correction table");
                    caption(ui, &correction::caption(made));
                });
                correction::show(ui, workbench, made);
            } else if waterfall {
                ui.horizontal(|ui| {
                    lower(ui, workbench, commands);
                    caption(ui, "root mean square over the samples that were fitted");
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        picture(ui, Plot::Waterfall, commands);
                    });
                });
                waterfall::show(ui, workbench);
            } else {
                chart_bar(ui, workbench, commands);
                deviation::show(ui, workbench, commands);
            }
        });
    part(Margin::same(12)).show(ui, |ui| {
        workspace::bar(ui, workbench, commands);
        workspace::show(ui, workbench, commands);
    });
}

fn message(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(message) = &workbench.view().message else {
        return;
    };
    let palette = Palette::of(ui);
    let color = if message.wrong {
        palette.outside
    } else {
        palette.within
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

/// The step that finds the gap shows it step by step.
fn offers_waterfall(workbench: &Workbench) -> bool {
    workbench.view().step == Step::Gap && workbench.answer().is_some()
}

/// Which of the two lower plots.
fn lower(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let offered = [
        (Lower::Waterfall, "Gap by step"),
        (Lower::Deviation, "Deviation"),
    ];
    if let Some(lower) = widgets::segmented(ui, &offered, workbench.view().lower) {
        commands.push(Command::Lower(lower));
    }
    ui.add_space(space::ROW);
}

/// From this width on the components stand side by side, points.
const WIDE: f32 = 512.0;

/// The components as a list, where there is no room for them side by side.
fn component_list(
    ui: &mut Ui,
    offered: &[(Component, &str)],
    current: Component,
) -> Option<Component> {
    let mut chosen = None;
    let list = ComboBox::from_id_salt("component").selected_text(current.name());
    let list = list.show_ui(ui, |ui| {
        for (component, name) in offered {
            if ui.selectable_label(*component == current, *name).clicked() {
                chosen = Some(*component);
            }
        }
    });
    ui.ctx()
        .accesskit_node_builder(list.response.id, |node| node.set_label("Component"));
    chosen
}

fn chart_bar(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = workbench.view();
    let planar = workbench.subject().session.samples.z_mm.is_none();
    ui.horizontal(|ui| {
        if offers_waterfall(workbench) {
            lower(ui, workbench, commands);
        } else {
            title(ui, "Deviation");
        }
        let offered = Component::ALL
            .iter()
            .filter(|c| !(planar && c.out_of_plane()));
        let offered: Vec<_> = offered.map(|c| (*c, c.name())).collect();
        let chosen = if ui.available_width() < WIDE {
            component_list(ui, &offered, view.component)
        } else {
            widgets::segmented(ui, &offered, view.component)
        };
        if let Some(component) = chosen {
            commands.push(Command::Component(component));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if !workbench.subject().is_empty() {
                picture(ui, Plot::Deviation, commands);
            }
            if workbench.answer().is_some() {
                let shown = [(false, "both"), (true, "only after")];
                if let Some(only) = widgets::segmented(ui, &shown, view.only_after) {
                    commands.push(Command::OnlyAfter(only));
                }
            }
        });
    });
}
