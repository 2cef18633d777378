//! Files that are dropped on the window.

use std::path::PathBuf;

use egui::{Align2, Id, LayerId, Order, Ui};

use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::workbench::Command;

/// Opens what was dropped, and says so while it is held over the window.
pub(crate) fn show(ui: &Ui, commands: &mut Vec<Command>) {
    let (held, dropped) = ui.input(|input| {
        let files = input.raw.dropped_files.iter();
        let paths: Vec<PathBuf> = files.map(|file| file.path().to_path_buf()).collect();
        (!input.raw.hovered_files.is_empty(), paths)
    });
    if !dropped.is_empty() {
        commands.push(Command::Drop(dropped));
    }
    if held {
        let palette = Palette::of(ui);
        let layer = LayerId::new(Order::Foreground, Id::unique("dropped"));
        let painter = ui.ctx().layer_painter(layer);
        let rect = ui.ctx().content_rect();
        painter.rect_filled(rect, 0.0, palette.veil);
        let card = egui::Rect::from_center_size(rect.center(), egui::vec2(320.0, 88.0));
        painter.rect_filled(card, 10.0, palette.surface);
        painter.text(
            card.center(),
            Align2::CENTER_CENTER,
            say!("Drop the file to open it"),
            strong(size::HEADING),
            palette.accent,
        );
    }
}
