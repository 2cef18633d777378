//! What the report states besides its measurements.

use egui::{Checkbox, Grid, RichText, TextEdit, Ui};

use crate::compensation::decision::Rule;
use crate::gui::core::edit::Edit;
use crate::gui::language::named;
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
    widgets::heading(ui, say!("details-report-details"));
    widgets::hint(ui, say!("details-stated-at-the-head"));
    let before = workbench.stated();
    let mut stated = before.clone();
    let muted = Palette::of(ui).muted;
    Grid::new("report details")
        .num_columns(2)
        .spacing([f32::from(space::PANEL), space::TIGHT])
        .show(ui, |ui| {
            for line in Details::LINES {
                let hint = if line.key == "date" {
                    say!("details-such-as-a-date")
                } else {
                    ""
                };
                let name = named("details-field", line.key, line.name);
                text(ui, name, (line.of)(&mut stated.details), hint);
                ui.end_row();
            }
            let name = say!("details-logo");
            ui.label(RichText::new(name).color(muted));
            ui.horizontal(|ui| {
                let width = ui.available_width() - 86.0;
                let hint = say!("details-a-png-file");
                field(ui, name, &mut stated.logo, hint, width);
                if ui.button(say!("import-choose")).clicked() {
                    commands.push(Command::ChooseLogo);
                }
            });
            ui.end_row();
            history(ui, workbench, &mut stated.without_history);
            ui.end_row();
        });
    widgets::section(ui, say!("details-pass-or-fail"));
    views::session::tolerance(ui, workbench, commands);
    let now = workbench.document().tolerance_mm;
    if let (None, Some(last)) = (now, stated.details.tolerance_mm) {
        let says = say!("details-last-time-it-was", last = last);
        ui.horizontal(|ui| {
            ui.label(RichText::new(says).size(size::SMALL).color(muted));
            if ui.small_button(say!("details-use-it")).clicked() {
                commands.push(Command::Edit(Edit::Tolerance(Some(last))));
            }
        });
    }
    let rules = [
        (None, say!("details-not-decided")),
        (Some(Rule::Iso14253), "ISO 14253-1"),
        (Some(Rule::Simple), say!("details-simple-acceptance")),
    ];
    widgets::form_row(ui, say!("details-decision-rule"), |ui| {
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
        let report =
            columns[0].add_enabled_ui(measured, |ui| widgets::other(ui, say!("common-report")));
        if report.inner.clicked() {
            commands.push(Command::Sheet(None));
            commands.push(Command::ChooseWhereToExport(What::Report(About::Session)));
        }
        // Enter ends what is typed into one of many fields.
        if widgets::primary(&mut columns[1], say!("common-done")).clicked() {
            commands.push(Command::Sheet(None));
        }
    });
}

/// Whether the report says what became of the machine.
fn history(ui: &mut Ui, workbench: &Workbench, without: &mut bool) {
    ui.label(RichText::new(say!("details-history")).color(Palette::of(ui).muted));
    let in_file = workbench.folder().is_some();
    let mut with = in_file && !*without;
    let text = if in_file {
        say!("details-compare-the-sessions")
    } else {
        say!("details-save-the-session-first")
    };
    let switch = ui.add_enabled(in_file, Checkbox::new(&mut with, text));
    if switch.changed() {
        *without = !with;
    }
}

/// What choosing a rule means.
fn about(rule: Option<Rule>) -> &'static str {
    match rule {
        None => say!("details-the-reader-decides"),
        Some(Rule::Iso14253) => say!("details-pass-with-its-uncertainty"),
        Some(Rule::Simple) => say!("details-pass-without-its-uncertainty"),
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
