//! Keyboard and mouse: what can be pressed, and what it does.

use crate::text::spoken;
use egui::{Align, Label, Layout, RichText, ScrollArea, TextStyle, Ui, vec2};

use crate::gui::actions;
use crate::gui::plots::gestures;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::ends::done;

/// Widest, and what is beside it, points.
const WIDE: f32 = 760.0;
const BESIDE: f32 = 96.0;
/// Height of everything but the list, and least height of that, points.
const OTHER: f32 = 190.0;
const LEAST: f32 = 120.0;

pub(super) fn show(ui: &mut Ui, _: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(WIDE.min(ui.ctx().content_rect().width() - BESIDE));
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
    let mouse = gestures::GESTURES.map(|(how, what)| (spoken(how).to_owned(), spoken(what)));
    // The button stays in sight.
    let high = (ui.ctx().content_rect().height() - OTHER).max(LEAST);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        ui.columns(2, |columns| {
            for (column, part) in columns.iter_mut().zip(all.chunks(rows)) {
                key_rows(column, part);
            }
        });
        ui.add_space(space::ROW);
        ui.label(RichText::new(say!("The mouse, in the plots")).font(strong(size::BODY)));
        key_rows(ui, &mouse);
    });
    done(ui, commands);
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
