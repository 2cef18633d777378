//! Accuracy and repeatability as the standards state them, before and after.

use crate::language::spoken;
use egui::{Grid, RichText, Ui};

use crate::gui::cache::identified::{StandardsFigures, as_text};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};
use crate::present::standards::Group;

use super::copies;

/// Shows them, where there is something measured.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let Some(figures) = workbench.figures() else {
        return;
    };
    widgets::card(ui, |ui| {
        widgets::bold(ui, say!("Accuracy and repeatability"));
        match &figures.made {
            None => widgets::hint(ui, say!("The figures are being computed")),
            Some(Err(because)) => widgets::hint(ui, because),
            Some(Ok(made)) => tables(ui, made),
        }
    });
}

fn tables(ui: &mut Ui, made: &StandardsFigures) {
    if made.groups.iter().any(|group| !group.rows.is_empty()) {
        copies::button(ui, say!("figures"), || as_text(made));
    }
    let mut explained = "";
    for group in &made.groups {
        let title = spoken(&group.title);
        widgets::section(ui, &format!("{title}, {}", group.standard));
        if !group.rows.is_empty() {
            widgets::hint(ui, spoken(&group.conditions));
        }
        if !group.rows.is_empty() {
            table(ui, group);
            if group.standard != explained {
                widgets::hint(ui, legend(group));
                explained = group.standard;
            }
        }
        for line in &group.missing {
            widgets::hint(ui, say!("missing: {line}", line = spoken(line)));
        }
    }
    for line in &made.notes {
        widgets::hint(ui, spoken(line));
    }
}

/// What the symbols of a table are called; what each means in full is said at the symbol.
fn legend(group: &Group) -> String {
    let sides = |symbol: &str| symbol.ends_with(['↑', '↓']);
    let rows = group.rows.iter().filter(|row| !sides(row.symbol));
    let mut names: Vec<String> = rows
        .map(|row| format!("{} {}", row.symbol, spoken(row.name)))
        .collect();
    if group.rows.iter().any(|row| sides(row.symbol)) {
        names.push(say!("↑ positive approach, ↓ negative approach").to_owned());
    }
    names.join(" · ")
}

fn table(ui: &mut Ui, group: &Group) {
    let palette = Palette::of(ui);
    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
    Grid::new(("standards", group.title.to_string()))
        .num_columns(3)
        .spacing([20.0, 3.0])
        .show(ui, |ui| {
            let measured = say!("measured, {group}", group = group.unit);
            for head in ["", &measured, say!("corrected")] {
                let head = RichText::new(head).size(size::SMALL).color(palette.muted);
                widgets::cell_right(ui, head);
            }
            ui.end_row();
            for row in &group.rows {
                let before = group.shown(row.before);
                let after = row.after.map_or_else(|| "–".to_owned(), |v| group.shown(v));
                ui.label(row.symbol).on_hover_ui(|ui| {
                    ui.set_max_width(space::TIP);
                    widgets::bold(ui, spoken(row.name));
                    ui.label(help::figure(row.symbol).unwrap_or_default());
                });
                widgets::cell_right(ui, RichText::new(before));
                widgets::cell_right(ui, RichText::new(after).font(strong(size::BODY)));
                ui.end_row();
            }
        });
}
