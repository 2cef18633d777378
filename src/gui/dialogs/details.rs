//! What the report states besides its measurements.

use egui::{Grid, RichText, TextEdit, Ui};

use crate::compensation::decision::Rule;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::{About, What};
use crate::gui::views;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::report::Details;

/// Widest, points.
const WIDE: f32 = 560.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(WIDE.min(ui.ctx().content_rect().width() - 96.0));
    widgets::heading(ui, "Report details");
    widgets::hint(
        ui,
        "Stated at the head of the report, and remembered for this machine; what is empty is a line \
         to fill in by hand",
    );
    let before = workbench.stated();
    let mut stated = before.clone();
    let muted = Palette::of(ui).muted;
    Grid::new("report details")
        .num_columns(2)
        .spacing([f32::from(space::PANEL), space::TIGHT])
        .show(ui, |ui| {
            for line in Details::LINES {
                let hint = if line.key == "date" {
                    "such as 22 Nov 2026"
                } else {
                    ""
                };
                text(ui, line.name, (line.of)(&mut stated.details), hint);
                ui.end_row();
            }
            ui.label(RichText::new("Logo").color(muted));
            ui.horizontal(|ui| {
                let width = ui.available_width() - 86.0;
                field(ui, "Logo", &mut stated.logo, "a PNG file", width);
                if ui.button("Choose…").clicked() {
                    commands.push(Command::ChooseLogo);
                }
            });
            ui.end_row();
        });
    widgets::section(ui, "Pass or fail");
    views::session::tolerance(ui, workbench, commands);
    let now = workbench.document().tolerance_mm;
    if let (None, Some(last)) = (now, stated.details.tolerance_mm) {
        let says = format!("Last time it was {last} mm");
        ui.horizontal(|ui| {
            ui.label(RichText::new(says).size(size::SMALL).color(muted));
            if ui.small_button("Use it").clicked() {
                commands.push(Command::Edit(Edit::Tolerance(Some(last))));
            }
        });
    }
    let rules = [
        (None, "not decided"),
        (Some(Rule::Iso14253), "ISO 14253-1"),
        (Some(Rule::Simple), "simple acceptance"),
    ];
    widgets::form_row(ui, "Decision rule", |ui| {
        if let Some(rule) = widgets::segmented(ui, &rules, stated.details.rule) {
            stated.details.rule = rule;
        }
    });
    widgets::hint(ui, about(stated.details.rule));
    views::results::decision(ui, workbench);
    if stated != before {
        commands.push(Command::State(Box::new(stated)));
    }
    ui.add_space(space::ROW);
    ui.columns(2, |columns| {
        let measured = !workbench.subject().is_empty();
        let report = columns[0].add_enabled_ui(measured, |ui| widgets::other(ui, "Report…"));
        if report.inner.clicked() {
            commands.push(Command::Sheet(None));
            commands.push(Command::ChooseWhereToExport(What::Report(About::Session)));
        }
        // Enter ends what is typed into one of many fields.
        if widgets::primary(&mut columns[1], "Done").clicked() {
            commands.push(Command::Sheet(None));
        }
    });
}

/// What a rule says, for whoever has to choose one.
fn about(rule: Option<Rule>) -> &'static str {
    match rule {
        None => "The report states the errors and leaves the decision to its reader",
        Some(Rule::Iso14253) => {
            "Pass where the largest deviation and its uncertainty together are within the tolerance, \
             fail where the deviation without its uncertainty is above it; between them neither is proven"
        }
        Some(Rule::Simple) => {
            "Pass where the largest deviation is within the tolerance; the uncertainty is stated \
             and does not count (JCGM 106, 8.2)"
        }
    }
}

/// A text with its name before it.
fn text(ui: &mut Ui, name: &str, value: &mut String, hint: &str) {
    ui.label(RichText::new(name).color(Palette::of(ui).muted));
    field(ui, name, value, hint, ui.available_width());
}

fn field(ui: &mut Ui, name: &str, value: &mut String, hint: &str, width: f32) {
    let edit = TextEdit::singleline(value).hint_text(hint).char_limit(400);
    let field = ui.add(edit.desired_width(width.max(120.0)));
    let name = name.to_owned();
    ui.ctx()
        .accesskit_node_builder(field.id, |node| node.set_label(name));
}
