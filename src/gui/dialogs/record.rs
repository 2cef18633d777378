//! The record of a machine: what its report states besides its measurements, and what changed from session to session
//! beyond its uncertainty.

use egui::{Grid, RichText, TextEdit, Ui};

use crate::compensation::decision::Rule;
use crate::gui::style::{size, space, strong};
use crate::gui::view::{About, What};
use crate::gui::views::{results, session};
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::report::Details;
use crate::text::spoken;

/// Widest, points.
const DETAILS_WIDE: f32 = 640.0;

pub(super) fn details(ui: &mut Ui, workbench: &Workbench) {
    widgets::head(ui, DETAILS_WIDE, say!("Report details"));
    ui.hint(say!(
        "Stated at the head of the report and remembered for this machine; an empty field becomes a line to fill in by hand"
    ));
    let before = workbench.stated();
    let mut stated = before.clone();
    Grid::new("report details")
        .num_columns(2)
        .spacing([f32::from(space::PANEL), space::TIGHT])
        .show(ui, |ui| {
            for line in Details::LINES {
                let (name, value) = (spoken(line.name), (line.of)(&mut stated.details));
                ui.weak(name);
                let wide = ui.available_width();
                field(ui, name, value, wide);
                ui.end_row();
            }
            let name = say!("Logo");
            ui.weak(name);
            ui.horizontal(|ui| {
                let width = ui.available_width() - 86.0;
                field(ui, name, &mut stated.logo, width);
                ui.button(say!("Choose…"))
                    .does(workbench, Workbench::choose_logo);
            });
            ui.end_row();
            // In the same columns as what is above it.
            let decided = RichText::new(say!("Pass or fail"));
            ui.label(decided.font(strong(size::SMALL)).weak());
            ui.end_row();
            session::tolerance(ui, workbench, Ui::number_in_a_grid);
            ui.end_row();
            ui.weak(say!("Decision rule"));
            let rules = [
                (None, say!("Not decided")),
                (Some(Rule::Iso14253), "ISO 14253-1"),
                (Some(Rule::Simple), say!("simple acceptance")),
            ];
            ui.choice(&rules, &mut stated.details.rule);
            ui.end_row();
        });
    if let Some(rule) = stated.details.rule {
        ui.hint(about(rule));
    }
    results::decision(ui, workbench);
    if stated != before {
        workbench.then(move |bench| bench.state(stated));
    }
    // Enter ends what is typed into one of many fields.
    let measured = !workbench.loaded_session().is_empty();
    let pressed = ui.foot([
        (&*widgets::dots(say!("Report")), measured),
        (say!("Done"), true),
    ]);
    if let Some(pressed) = pressed {
        workbench.then(|bench| bench.show_sheet(None));
        if pressed == 0 {
            workbench.then(|bench| bench.choose_where_to_export(What::Report(About::Session)));
        }
    }
}

/// What choosing a rule means.
fn about(rule: Rule) -> &'static str {
    match rule {
        Rule::Iso14253 => say!(
            "Pass where the largest deviation and its uncertainty together are within the tolerance, fail where the deviation without its uncertainty is above it; between them neither is proven"
        ),
        Rule::Simple => say!(
            "Pass where the largest deviation is within the tolerance; the uncertainty is stated and does not count (JCGM 106, 8.2)"
        ),
    }
}

fn field(ui: &mut Ui, name: &str, value: &mut String, width: f32) {
    let edit = TextEdit::singleline(value).char_limit(400);
    ui.named(name, edit.desired_width(width.max(120.0)));
}
