//! Keyboard and mouse: what can be pressed, and what it does.

use crate::text::spoken;
use egui::{Grid, RichText, Ui};

use crate::gui::actions;
use crate::gui::plots::gestures;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::ends::done;

pub(super) fn show(ui: &mut Ui, _: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(600.0);
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
    ui.columns(2, |columns| {
        for (column, part) in columns.iter_mut().zip(all.chunks(rows)) {
            key_rows(column, part);
        }
    });
    ui.add_space(space::ROW);
    ui.label(RichText::new(say!("The mouse, in the plots")).font(strong(size::BODY)));
    let mouse = gestures::GESTURES.map(|(how, what)| (spoken(how).to_owned(), spoken(what)));
    key_rows(ui, &mouse);
    done(ui, commands);
}

fn key_rows(ui: &mut Ui, rows: &[(String, &str)]) {
    let muted = Palette::of(ui).muted;
    widgets::dense(ui);
    Grid::new(("shortcuts", rows.len(), rows.first().map(|(keys, _)| keys)))
        .num_columns(2)
        .spacing([16.0, 6.0])
        .show(ui, |ui| {
            for (keys, what) in rows {
                ui.label(RichText::new(keys).color(muted));
                ui.label(*what);
                ui.end_row();
            }
        });
}
