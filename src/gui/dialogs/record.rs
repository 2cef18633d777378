//! The record of a machine: what its report states besides its measurements, and what became of it, its parameters by
//! session with their intervals and what changed beyond its uncertainty.

use egui::{Checkbox, ComboBox, Grid, Id, RichText, ScrollArea, TextEdit, Ui};

use crate::compensation::decision::Rule;
use crate::gui::core::disk::name_of;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{About, What};
use crate::gui::views::{self, blocks};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::history::{Order, RobotHistory};
use crate::present::history::{CHANGED, entries, parameters};
use crate::present::table::Table;
use crate::report::Details;
use crate::text::spoken;

/// Widest, points.
const WIDE: f32 = 900.0;
/// The newest sessions stand side by side.
const MOST: usize = 12;

pub(super) fn history(ui: &mut Ui, workbench: &Workbench) {
    let Some(past) = workbench.past() else {
        return workbench.then(move |bench| bench.show_sheet(None));
    };
    widgets::wide(ui, WIDE);
    let id = Id::unique("history of a machine");
    let open = &workbench.loaded_session().session.robot.name;
    let chosen: String = ui
        .data(|data| data.get_temp(id))
        .unwrap_or_else(|| open.clone());
    let all = &past.history.robots;
    let found = all.iter().find(|one| one.robot == chosen);
    let Some(robot) = found.or(all.first()) else {
        return workbench.then(move |bench| bench.show_sheet(None));
    };
    widgets::heading(ui, &say!("History of {robot}", robot = robot.robot));
    let name = name_of(&past.folder);
    let says = match robot.ordered_by {
        Order::Time => say!(
            "Sessions and models of the folder {folder}, by the time of the first sample",
            folder = name
        ),
        Order::Name => say!(
            "Sessions and models of the folder {folder}, by file name, numbers in it by their value",
            folder = name
        ),
    };
    widgets::hint(ui, says);
    if all.len() > 1 {
        let names: Vec<&str> = all.iter().map(|one| one.robot.as_str()).collect();
        let now = names.iter().position(|name| *name == robot.robot);
        if let Some(next) = list(ui, say!("Robot"), &names, now.unwrap_or(0)) {
            ui.data_mut(|data| data.insert_temp(id, names[next].to_owned()));
        }
    }
    over_time(ui, robot);
    for file in &past.history.not_read {
        widgets::wrong(ui, &crate::language::spoken(file.describe()));
    }
    if widgets::done_beside(ui, say!("Other folder…"), true, workbench) {
        workbench.then(Workbench::choose_folder);
    }
}

/// All sessions: their errors, and their parameters.
fn over_time(ui: &mut Ui, robot: &RobotHistory) {
    widgets::section(ui, say!("Errors"));
    table(ui, "errors", &entries(robot));
    let last = robot.entries.len();
    let shown: Vec<usize> = (last.saturating_sub(MOST)..last).collect();
    let all = parameters(robot, &shown);
    if all.rows.is_empty() {
        return widgets::hint(ui, say!("No parameter was identified"));
    }
    widgets::section(ui, say!("Parameters"));
    table(ui, "parameters", &all);
    let mut says = say!(
        "± half the 95 % interval; {mark} changed by more than its interval",
        mark = CHANGED
    );
    if shown.len() < last {
        let of = say!(
            "the last {shown} of {all} sessions",
            shown = shown.len(),
            all = last
        );
        says += &format!("; {of}");
    }
    widgets::hint(ui, says);
}

/// A list with its name before it; what was chosen.
fn list(ui: &mut Ui, name: &str, all: &[&str], now: usize) -> Option<usize> {
    let mut chosen = None;
    widgets::form_row(ui, name, |ui| {
        let shown = all.get(now).copied().unwrap_or_default();
        let list = ComboBox::from_id_salt(name).selected_text(shown);
        let offered = all.iter().enumerate();
        chosen = widgets::list(ui, name, list.width(320.0), offered, now);
    });
    chosen.filter(|k| *k != now)
}

fn table(ui: &mut Ui, id: &str, table: &Table) {
    let palette = Palette::of(ui);
    let window = ui.ctx().content_rect().height();
    let area = ScrollArea::both().id_salt(id).max_height(0.32 * window);
    area.auto_shrink([false, true]).show(ui, |ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let look = (size::SMALL, f32::from(space::PANEL));
        blocks::grid(
            ui,
            id,
            table,
            look,
            |shown| {
                if shown.contains(CHANGED) {
                    palette.before
                } else {
                    palette.text
                }
            },
            |_, _| (),
        );
    });
}

/// Widest, points.
const DETAILS_WIDE: f32 = 640.0;

pub(super) fn details(ui: &mut Ui, workbench: &Workbench) {
    widgets::wide(ui, DETAILS_WIDE);
    widgets::heading(ui, say!("Report details"));
    widgets::hint(
        ui,
        say!(
            "Stated at the head of the report and remembered for this machine; an empty field becomes a line to fill in by hand"
        ),
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
                    say!("such as 22 Nov 2026")
                } else {
                    ""
                };
                text(ui, spoken(line.name), (line.of)(&mut stated.details), hint);
                ui.end_row();
            }
            let name = say!("Logo");
            ui.label(RichText::new(name).color(muted));
            ui.horizontal(|ui| {
                let width = ui.available_width() - 86.0;
                let hint = say!("a PNG file");
                field(ui, name, &mut stated.logo, hint, width);
                ui.button(say!("Choose…"))
                    .does(workbench, Workbench::choose_logo);
            });
            ui.end_row();
            with_history(ui, workbench, &mut stated.without_history);
            ui.end_row();
            // In the same columns as what is above it.
            let decided = RichText::new(say!("Pass or fail"));
            ui.label(decided.font(strong(size::SMALL)).color(muted));
            ui.end_row();
            views::session::tolerance(ui, workbench, widgets::number_in_a_grid);
            ui.end_row();
            ui.label(RichText::new(say!("Decision rule")).color(muted));
            let rules = [
                (None, say!("not decided")),
                (Some(Rule::Iso14253), "ISO 14253-1"),
                (Some(Rule::Simple), say!("simple acceptance")),
            ];
            widgets::choice(ui, &rules, &mut stated.details.rule);
            ui.end_row();
        });
    let now = workbench.document().tolerance_mm;
    if let (None, Some(last)) = (now, stated.details.tolerance_mm) {
        let says = say!("Last time it was {last} mm", last);
        ui.horizontal(|ui| {
            ui.label(RichText::new(says).size(size::SMALL).color(muted));
            ui.small_button(say!("Use it"))
                .does(workbench, move |bench| {
                    bench.edit(phrase!("set tolerance"), |document| {
                        document.set_tolerance(Some(last))
                    });
                });
        });
    }
    widgets::hint(ui, about(stated.details.rule));
    views::results::decision(ui, workbench);
    if stated != before {
        workbench.then(move |bench| bench.state(stated));
    }
    ui.add_space(space::ROW);
    ui.columns(2, |columns| {
        let measured = !workbench.loaded_session().is_empty();
        let report = columns[0].add_enabled_ui(measured, |ui| widgets::other(ui, say!("Report…")));
        if report.inner.clicked() {
            workbench.then(move |bench| bench.show_sheet(None));
            workbench.then(move |bench| bench.choose_where_to_export(What::Report(About::Session)));
        }
        // Enter ends what is typed into one of many fields.
        widgets::primary(&mut columns[1], say!("Done"))
            .does(workbench, move |bench| bench.show_sheet(None));
    });
}

/// Whether the report says what became of the machine.
fn with_history(ui: &mut Ui, workbench: &Workbench, without: &mut bool) {
    ui.label(RichText::new(say!("History of the machine")).color(Palette::of(ui).muted));
    let in_file = workbench.folder().is_some();
    let mut with = in_file && !*without;
    let text = if in_file {
        say!("Compare the sessions of this robot in the folder of the session")
    } else {
        say!("The session is in no folder yet: save it first")
    };
    let switch = ui.add_enabled(in_file, Checkbox::new(&mut with, text));
    if switch.changed() {
        *without = !with;
    }
}

/// What choosing a rule means.
fn about(rule: Option<Rule>) -> &'static str {
    match rule {
        None => say!("The report states the errors and leaves the decision to its reader"),
        Some(Rule::Iso14253) => say!(
            "Pass where the largest deviation and its uncertainty together are within the tolerance, fail where the deviation without its uncertainty is above it; between them neither is proven"
        ),
        Some(Rule::Simple) => say!(
            "Pass where the largest deviation is within the tolerance; the uncertainty is stated and does not count (JCGM 106, 8.2)"
        ),
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
    widgets::label(&field, name);
}
