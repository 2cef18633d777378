//! Files: open, save, follow.

use egui::{Button, RichText, Ui};

use crate::gui::actions::{self, OPEN_EXAMPLE, OPEN_LATEST};
use crate::gui::core::examples::EXAMPLES;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::workbench::Command;

use super::items::{Menu, named};

pub(super) fn show(ui: &mut Ui, menu: &mut Menu<'_>) {
    ui.set_min_width(260.0);
    menu.items(ui, &[actions::OPEN]);
    recent(ui, menu);
    ui.menu_button(say!("Examples"), |ui| {
        for (action, example) in OPEN_EXAMPLE.iter().zip(&EXAMPLES) {
            menu.item_about(ui, action, Some(example.what()));
        }
    });
    menu.items(ui, &[actions::IMPORT, actions::NEW, actions::ROBOTS]);
    ui.separator();
    menu.items(
        ui,
        &[actions::SAVE, actions::SAVE_AS, actions::SAVE_TO_PATH],
    );
    ui.separator();
    menu.items(
        ui,
        &[
            actions::SAVE_MODEL,
            actions::SAVE_TABLE,
            actions::COMPENSATE,
            actions::REPORT_DETAILS,
            actions::REPORT,
            actions::HISTORY,
        ],
    );
    ui.separator();
    menu.items(ui, &[actions::RELOAD, actions::FOLLOW, actions::RECORD]);
    ui.separator();
    menu.items(ui, &[actions::QUIT]);
}

/// Files that were opened before. One that is not there any more says so, and can be taken out.
fn recent(ui: &mut Ui, menu: &mut Menu<'_>) {
    let workbench = menu.workbench;
    let recent: Vec<_> = workbench.recent().collect();
    if recent.is_empty() {
        ui.add_enabled(false, Button::new(say!("Recent files")));
        return;
    }
    ui.menu_button(say!("Recent files"), |ui| {
        ui.set_min_width(300.0);
        for (k, (path, there)) in recent.iter().enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str());
            let name = name.to_string_lossy();
            let folder = path.parent().map(|f| f.display().to_string());
            ui.horizontal(|ui| {
                let keys = if k == 0 {
                    OPEN_LATEST.keys(ui.ctx())
                } else {
                    String::new()
                };
                let button = Button::new(name.clone()).shortcut_text(keys);
                let button = named(ui.add_enabled(*there, button), &name);
                let button = button.on_hover_text(path.display().to_string());
                if button.clicked() {
                    menu.commands.push(Command::OpenFile(path.to_path_buf()));
                    ui.close();
                }
                if *there {
                    let muted = Palette::of(ui).muted;
                    let folder = RichText::new(folder.unwrap_or_default());
                    let folder = folder.size(size::SMALL).color(muted);
                    ui.add(egui::Label::new(folder).truncate());
                } else {
                    let warning = Palette::of(ui).warning;
                    let says = RichText::new(say!("file not found")).size(size::SMALL);
                    ui.label(says.color(warning));
                    if ui
                        .small_button(say!("Forget {name}", name = name))
                        .clicked()
                    {
                        menu.commands.push(Command::Forget(path.to_path_buf()));
                    }
                }
            });
        }
    });
}
