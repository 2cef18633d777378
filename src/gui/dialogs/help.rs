//! What this program is, what can be done in it by keys and mouse, and what the words mean.

use egui::{Align, Label, Layout, RichText, ScrollArea, TextStyle, Ui, vec2};

use crate::text::spoken;

use crate::gui::actions;
use crate::gui::charts::CHARTS;
use crate::gui::plots;
use crate::gui::style::{Palette, space};
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
