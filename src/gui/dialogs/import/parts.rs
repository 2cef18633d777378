//! What the parts of the import sheet are made of.

use egui::{RichText, TextEdit, Ui};
use std::path::{Path, PathBuf};

use crate::diagnostic::Severity;
use crate::gui::import_draft::{Companion, ImportDraft};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command};

/// A finding as a line; its kind is a word as well as a colour.
pub(super) fn line(ui: &mut Ui, severity: Severity, says: &str) {
    let palette = Palette::of(ui);
    let (text, color) = match severity {
        Severity::Note => (says.to_owned(), palette.muted),
        Severity::Warning => (say!("Warning: {says}", says = says), palette.warning),
        Severity::Error => (say!("Error: {says}", says = says), palette.outside),
    };
    let text = RichText::new(text);
    ui.add(egui::Label::new(text.size(size::SMALL).color(color)).wrap());
}

/// A field for the path of a file, with a button that asks for it.
pub(super) fn path(
    ui: &mut Ui,
    (label, hint): (&str, &str),
    typed: &mut String,
    (which, now): (Companion, &ImportDraft),
    commands: &mut Vec<Command>,
) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        let text = egui::WidgetText::from(say!("Choose…"));
        let text = text.into_galley(ui, None, f32::INFINITY, egui::TextStyle::Button);
        let button = text.size().x + 2.0 * ui.spacing().button_padding.x;
        let room = ui.available_width() - button - ui.spacing().item_spacing.x;
        let field = TextEdit::singleline(typed).hint_text(hint);
        let field = ui.add_sized([room.max(80.0), space::CONTROL], field);
        name(ui, &field, label);
        changed = field.changed();
        let button = ui.button(say!("Choose…"));
        name(ui, &button, &say!("Choose: {label}", label = label));
        if button.clicked() {
            commands.push(Command::Ask(Asked::Beside(which)));
        }
    });
    if !typed.trim().is_empty() {
        let is_this = |(of, path): &&(Companion, PathBuf)| {
            *of == which && path.as_path() == Path::new(typed.as_str())
        };
        if now.taken.iter().any(|one| is_this(&one)) {
            let says = say!("Taken because its name is that of the file");
            widgets::hint(ui, says);
        }
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        for path in now.neighbours.suiting(which) {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            let text = say!("Use {file} from the same folder", file = file);
            let link = ui.link(RichText::new(text).size(size::SMALL));
            name(
                ui,
                &link,
                &say!("Use {file}: {label}", file = file, label = label),
            );
            if link.clicked() {
                *typed = path.display().to_string();
                changed = true;
            }
        }
    });
    changed
}

/// Gives a control the name under which it is read out.
pub(super) fn name(ui: &Ui, response: &egui::Response, label: &str) {
    let label = label.to_owned();
    ui.ctx()
        .accesskit_node_builder(response.id, |node| node.set_label(label));
}
