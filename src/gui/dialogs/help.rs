//! What this program is and what can be done in it: by its keys, by a word of its name, and what the words mean.

use egui::{
    Align, Button, Context, Key, Label, Layout, Modifiers, Response, RichText, Role, ScrollArea,
    TextEdit, TextStyle, Ui, WidgetInfo, vec2,
};

use crate::text::spoken;

use crate::gui::actions::{self, Action, WindowState};
use crate::gui::charts::CHARTS;
use crate::gui::plots;
use crate::gui::style::{Palette, size, space};
use crate::gui::view::PaletteInput;
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};

pub(super) fn about(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, 400.0);
    widgets::heading(ui, "truepose");
    widgets::hint(
        ui,
        say!("version {version}", version = env!("CARGO_PKG_VERSION")),
    );
    ui.label(say!("Calibrates a robot at commissioning: finds where measurement and simulation disagree, and writes what the controller needs"));
    widgets::hint(
        ui,
        say!("Everything in this window can be done in the terminal too: truepose --help"),
    );
    widgets::hint(
        ui,
        say!("Type: Inter, by the Inter project authors, SIL Open Font License 1.1"),
    );
    widgets::done(ui, workbench);
}

/// Widest, points.
const WIDE: f32 = 760.0;
/// Height of everything but the list, and least height of that, points.
const OTHER: f32 = 190.0;
const LEAST: f32 = 120.0;

/// Keyboard and mouse: what can be pressed, and what it does.
pub(super) fn keys(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, WIDE);
    widgets::heading(ui, say!("Keyboard and mouse"));
    let next = actions::in_words(ui.ctx(), widgets::NEXT);
    let others: [(&str, &str); 8] = [
        (&next, say!("press the filled button: what comes next")),
        ("← →", say!("move the boundary that has the focus")),
        ("Shift+← →", say!("move it further")),
        (
            "← → ↑ ↓ + −",
            say!("orbit and zoom the 3-D view that has the focus"),
        ),
        ("Tab, Shift+Tab", say!("next control, the one before")),
        (say!("Space or Enter"), say!("press it")),
        (
            "Ctrl++, Ctrl+−, Ctrl+0",
            say!("larger, smaller, usual text"),
        ),
        ("Esc", say!("close a sheet")),
    ];
    let all = actions::ALL.iter().map(|action| action.help(ui.ctx()));
    let others = others.map(|(keys, what)| (keys.to_owned(), what));
    let all: Vec<_> = all.chain(others).collect();
    let rows = all.len().div_ceil(2);
    let mouse = plots::GESTURES.map(|(how, what)| (spoken(how).to_owned(), spoken(what)));
    // The button stays in sight.
    let high = (ui.ctx().content_rect().height() - OTHER).max(LEAST);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        ui.columns(2, |columns| {
            for (column, part) in columns.iter_mut().zip(all.chunks(rows)) {
                key_rows(column, part);
            }
        });
        ui.add_space(space::ROW);
        widgets::bold(ui, say!("The mouse, in the plots"));
        key_rows(ui, &mouse);
    });
    widgets::done(ui, workbench);
}

/// Keys in a column as wide as the longest of them, and what they do behind it, on as many lines as that takes.
fn key_rows(ui: &mut Ui, rows: &[(String, &str)]) {
    const BETWEEN: f32 = 16.0;
    let muted = Palette::of(ui).muted;
    let font = TextStyle::Body.resolve(ui.style());
    let width = |keys: &str| widgets::width_of(ui, keys, font.clone());
    let wide = rows.iter().map(|(keys, _)| width(keys)).fold(0.0, f32::max);
    widgets::dense(ui);
    ui.spacing_mut().item_spacing = vec2(BETWEEN, 6.0);
    for (keys, what) in rows {
        ui.horizontal_top(|ui| {
            let cell = vec2(wide, ui.spacing().interact_size.y);
            ui.allocate_ui_with_layout(cell, Layout::left_to_right(Align::Min), |ui| {
                ui.set_min_width(wide);
                ui.label(RichText::new(keys).color(muted));
            });
            ui.vertical(|ui| ui.add(Label::new(*what).wrap()));
        });
    }
}

/// Everything that can be done, by a word of its name: typed, chosen with the arrows, done with Enter.
pub(super) fn palette(ui: &mut Ui, workbench: &Workbench, typed: &mut PaletteInput) {
    widgets::wide(ui, 460.0);
    let ctx = ui.ctx().clone();
    let [up, down, enter] = [Key::ArrowUp, Key::ArrowDown, Key::Enter]
        .map(|key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)));
    let field = TextEdit::singleline(&mut typed.text).hint_text(say!("what to do"));
    let room = egui::vec2(ui.available_width(), space::PRIMARY);
    let field = ui.add_sized(room, field.align(egui::Align2::LEFT_CENTER));
    widgets::label(&field, say!("Command"));
    if !field.has_focus() {
        field.request_focus();
    }
    if field.changed() {
        typed.chosen = 0;
    }
    let now = WindowState::of(&ctx, workbench);
    let fitting: Vec<(&Action, String)> = fitting(&ctx, &now, &typed.text);
    let last = fitting.len().saturating_sub(1);
    typed.chosen = (typed.chosen + usize::from(down)).min(last);
    typed.chosen = typed.chosen.saturating_sub(usize::from(up));
    let mut done = None;
    ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for (k, (action, name)) in fitting.iter().enumerate() {
            let row = row(ui, &now, action, name, k == typed.chosen);
            if k == typed.chosen && (up || down) {
                row.scroll_to_me(None);
            }
            let meant = row.clicked() || enter && k == typed.chosen;
            if meant && action.enabled(&now) {
                done = Some(*action);
            }
        }
        if fitting.is_empty() {
            widgets::hint(ui, say!("No command has this in its name"));
        }
    });
    if let Some(action) = done {
        workbench.then(|bench| bench.show_sheet(None));
        action.ask_for(&now);
    }
}

/// What has every word that was typed in its name or in what the list of keys says of it.
fn fitting<'a>(ctx: &Context, now: &WindowState<'_>, typed: &str) -> Vec<(&'a Action, String)> {
    let typed = typed.to_lowercase();
    let named = actions::ALL
        .iter()
        .map(|action| (action, action.label(now)));
    let fits = |(action, name): &(&Action, String)| {
        let said = format!("{name} {}", action.help(ctx).1).to_lowercase();
        // The palette itself is open, and what has no name has its keys only.
        !name.is_empty()
            && !action.keys(ctx).is_empty()
            && action.help(ctx) != actions::PALETTE.help(ctx)
            && typed.split_whitespace().all(|word| said.contains(word))
    };
    named.filter(fits).collect()
}

fn row(ui: &mut Ui, now: &WindowState<'_>, action: &Action, name: &str, chosen: bool) -> Response {
    let enabled = action.enabled(now);
    let button = Button::selectable(chosen, name).shortcut_text(action.keys(ui.ctx()));
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

/// Height of what stands around the list, points.
const REST: f32 = 240.0;

/// What the words mean, all of them.
pub(super) fn words(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, 520.0);
    widgets::heading(ui, say!("Glossary"));
    widgets::hint(
        ui,
        say!("The same is shown beside the numbers, where the pointer rests on a name"),
    );
    ui.add_space(space::TIGHT);
    let high = (ui.ctx().content_rect().height() - REST).clamp(120.0, 460.0);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        let charts = CHARTS.iter().map(|chart| chart.about().word);
        let charts = charts.filter(|word| !help::ALL.contains(word));
        for word in help::ALL.iter().copied().chain(charts) {
            widgets::bold(ui, word.name());
            ui.add(egui::Label::new(word.means()).wrap());
            ui.add_space(space::ROW);
        }
    });
    widgets::done(ui, workbench);
}
