//! Files: open, save, follow.

use egui::{Button, RichText, Ui};

use crate::gui::actions;
use crate::gui::actions::Action;
use crate::gui::core::examples::EXAMPLES;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::workbench::Command;

use super::items::{Menu, named};

pub(super) fn show(ui: &mut Ui, menu: &mut Menu<'_>) {
    let workbench = menu.workbench;
    ui.set_min_width(260.0);
    menu.item(ui, "Open…", Action::Open, true);
    recent(ui, menu);
    ui.menu_button("Examples", |ui| {
        for (index, example) in EXAMPLES.iter().enumerate() {
            let keys = actions::keys(ui.ctx(), Action::Example(index));
            let button = ui.add(Button::new(example.name).shortcut_text(keys));
            let button = named(button, example.name);
            if button.on_hover_text(example.what).clicked() {
                menu.commands.push(Command::OpenExample(index));
                ui.close();
            }
        }
    });
    menu.item(ui, "New by simulation…", Action::New, true);
    ui.separator();
    let measured = !workbench.subject().is_empty();
    menu.item(ui, "Save session", Action::Save, measured);
    menu.item(ui, "Save session as…", Action::SaveAs, measured);
    let keys = actions::keys(ui.ctx(), Action::SaveToPath);
    let to_path = Button::new("Save session to path…").shortcut_text(keys);
    if named(ui.add_enabled(measured, to_path), "Save session to path…").clicked() {
        menu.commands.push(workbench.typed_path());
        ui.close();
    }
    ui.separator();
    let answered = workbench.answer().is_some();
    menu.item(ui, "Save model…", Action::SaveModel, answered);
    menu.item(ui, "Save table…", Action::SaveTable, answered);
    ui.separator();
    let has_file = workbench.file().is_some();
    menu.item(ui, "Read the file again", Action::Reload, has_file);
    let follows = workbench.following().is_some();
    let (text, can) = if follows {
        ("Stop following the file", true)
    } else {
        (
            "Follow the file as it grows",
            workbench.samples_file().is_some(),
        )
    };
    let keys = actions::keys(ui.ctx(), Action::Follow);
    let button = Button::new(text).shortcut_text(keys);
    if named(ui.add_enabled(can, button), text).clicked() {
        menu.commands.push(Command::Follow(!follows));
        ui.close();
    }
    ui.separator();
    menu.item(ui, "Quit", Action::Quit, true);
}

/// Files that were opened before. One that is not there any more says so, and can be taken out.
fn recent(ui: &mut Ui, menu: &mut Menu<'_>) {
    let workbench = menu.workbench;
    let recent: Vec<_> = workbench.recent().collect();
    if recent.is_empty() {
        ui.add_enabled(false, Button::new("Recent files"));
        return;
    }
    ui.menu_button("Recent files", |ui| {
        ui.set_min_width(300.0);
        for (k, (path, there)) in recent.iter().enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str());
            let name = name.to_string_lossy();
            let folder = path.parent().map(|f| f.display().to_string());
            ui.horizontal(|ui| {
                let keys = if k == 0 {
                    actions::keys(ui.ctx(), Action::OpenLatest)
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
                    let says = RichText::new("not there any more").size(size::SMALL);
                    ui.label(says.color(warning));
                    if ui.small_button(format!("Forget {name}")).clicked() {
                        menu.commands.push(Command::Forget(path.to_path_buf()));
                    }
                }
            });
        }
    });
}
