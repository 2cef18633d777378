//! Everything that can be done, by a word of its name: typed, chosen with the arrows, done with Enter.

use egui::{
    Button, Key, Modifiers, Response, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo,
};

use crate::gui::actions::{self, Action, WindowState};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};

/// What was typed, and which of the actions that fit is chosen.
#[derive(Clone, Default)]
struct PaletteInput {
    text: String,
    chosen: usize,
}

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(460.0);
    let ctx = ui.ctx().clone();
    let id = ui.scope_id().with("typed command");
    let before: Option<PaletteInput> = ui.data(|data| data.get_temp(id));
    let first = before.is_none();
    let mut typed = before.unwrap_or_default();
    let [up, down, enter] = [Key::ArrowUp, Key::ArrowDown, Key::Enter]
        .map(|key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)));
    let field = TextEdit::singleline(&mut typed.text).hint_text(say!("what to do"));
    let room = egui::vec2(ui.available_width(), space::PRIMARY);
    let field = ui.add_sized(room, field.align(egui::Align2::LEFT_CENTER));
    widgets::label(&field, say!("Command"));
    if first || !field.has_focus() {
        field.request_focus();
    }
    if field.changed() {
        typed.chosen = 0;
    }
    let now = WindowState {
        ctx: &ctx,
        workbench,
    };
    let fitting: Vec<(&Action, String)> = fitting(now, &typed.text);
    let last = fitting.len().saturating_sub(1);
    typed.chosen = (typed.chosen + usize::from(down)).min(last);
    typed.chosen = typed.chosen.saturating_sub(usize::from(up));
    let mut done = None;
    ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for (k, (action, name)) in fitting.iter().enumerate() {
            let row = row(ui, now, action, name, k == typed.chosen);
            if k == typed.chosen && (up || down) {
                row.scroll_to_me(None);
            }
            let meant = row.clicked() || enter && k == typed.chosen;
            if meant && action.enabled(now) {
                done = Some(action.command(now));
            }
        }
        if fitting.is_empty() {
            widgets::hint(ui, say!("No command has this in its name"));
        }
    });
    if done.is_some() || ui.input(|i| i.key_pressed(Key::Escape)) {
        // Next time it begins anew.
        typed = PaletteInput::default();
    }
    ui.data_mut(|data| data.insert_temp(id, typed));
    if let Some(command) = done {
        commands.extend([Command::View(ViewChange::Sheet(None)), command]);
    }
}

/// What has every word that was typed in its name or in what the list of keys says of it.
fn fitting<'a>(now: WindowState<'_>, typed: &str) -> Vec<(&'a Action, String)> {
    let typed = typed.to_lowercase();
    let named = actions::ALL
        .iter()
        .map(|action| (action, action.label(now)));
    let fits = |(action, name): &(&Action, String)| {
        let said = format!("{name} {}", action.help(now.ctx).1).to_lowercase();
        // The palette itself is open, and what has no name has its keys only.
        !name.is_empty()
            && !action.keys(now.ctx).is_empty()
            && action.help(now.ctx) != actions::PALETTE.help(now.ctx)
            && typed.split_whitespace().all(|word| said.contains(word))
    };
    named.filter(fits).collect()
}

fn row(ui: &mut Ui, now: WindowState<'_>, action: &Action, name: &str, chosen: bool) -> Response {
    let enabled = action.enabled(now);
    let button = Button::selectable(chosen, name).shortcut_text(action.keys(now.ctx));
    let room = egui::vec2(ui.available_width(), space::CONTROL);
    let row = ui.add_enabled(enabled, button.min_size(room));
    row.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, enabled, chosen, name));
    if chosen {
        let ring = egui::Stroke::new(1.0, Palette::of(ui).outline);
        let inside = egui::StrokeKind::Inside;
        ui.painter()
            .rect_stroke(row.rect, space::ROUND, ring, inside);
    }
    if !enabled {
        let because = RichText::new(action.first()).size(size::SMALL);
        ui.indent(name, |ui| ui.label(because.color(Palette::of(ui).muted)));
    }
    row
}
