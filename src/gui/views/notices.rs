//! What the user has to know, over the plots: a file that changed on the disk, and what went wrong.

use egui::{Align, Frame, Layout, Margin, Panel, RichText, ScrollArea, Ui};

use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::workbench::{Command, Workbench};

use super::disk;

/// It takes this part of the middle at most; what is longer scrolls.
const MOST: f32 = 0.3;

/// What the user has to know: never so much that the plots have no room.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let most = MOST * ui.available_height();
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
