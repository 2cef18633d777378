//! Sections and blocks as cards: what an answer says, in the window's look; what the window adds to a section
//! (buttons, the explanation of an effect) is put below it by the caller. And what several panels show: names of
//! effects and parameters, problems of the data with what mends them, and what no name explains.

use std::fmt::Debug;

use egui::{Color32, Grid, Response, RichText, TextStyle, TextWrapMode, Ui, WidgetText};

use crate::diagnosis::{Correction, Diagnosis};
use crate::effects::Term;
use crate::explain::{Block, Detail, Section, problems_of_data};
use crate::kinematics::JointKind;
use crate::language::spoken;
use crate::model::Model;
use crate::present::names::title_on;
use crate::present::numbers::{significant, trimmed, with_minus_signs};
use crate::present::table::{Column, Table};
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;
use crate::units::deg_from_rad;

use crate::gui::charts::effect;
use crate::gui::style::{Palette, size, strong};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

/// How a section's title looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Title {
    /// As the name of something.
    Plain,
    /// As an answer, in this colour.
    Large(Color32),
}

/// A section's title; what it returns can be explained.
pub(crate) fn title(ui: &mut Ui, section: &Section, look: Title) -> Response {
    let text = RichText::new(&section.title);
    let text = match look {
        Title::Plain => text.font(strong(size::BODY)),
        Title::Large(color) => text.font(strong(size::HEADING)).color(color),
    };
    ui.add(egui::Label::new(text).wrap())
}

/// What belongs to it.
pub(crate) fn show(ui: &mut Ui, blocks: &[Block]) {
    for (index, block) in blocks.iter().enumerate() {
        match block {
            Block::Heading(text) => {
                ui.label(RichText::new(text).font(strong(size::SMALL)));
            }
            Block::Text(text) => widgets::hint(ui, with_minus_signs(text)),
            Block::Warning(text) => {
                let text = RichText::new(with_minus_signs(text)).color(Palette::of(ui).warning);
                ui.add(egui::Label::new(text).wrap());
            }
            Block::List(points) => {
                for point in points {
                    widgets::hint(ui, with_minus_signs(point));
                }
            }
            Block::Facts(facts) => {
                for (name, value) in facts {
                    widgets::fact(ui, name, with_minus_signs(value));
                }
            }
            Block::Table(own) => table(ui, index, own),
            // What is drawn or signed is for paper: the window has its own charts.
            Block::Plot(..) | Block::Sign(_) => {}
        }
    }
}

/// The same, its lists as what must not be overlooked.
pub(crate) fn warned(ui: &mut Ui, blocks: &[Block]) {
    for block in blocks {
        match block {
            Block::List(points) => {
                for point in points {
                    widgets::wrong(ui, &with_minus_signs(point));
                }
            }
            other => show(ui, std::slice::from_ref(other)),
        }
    }
}

/// Columns of a table from which on it is wide.
const WIDE: usize = 5;

/// A table, wide ones in small letters; where it is wider than the panel, its rows one below the other.
fn table(ui: &mut Ui, index: usize, table: &Table) {
    // Intervals below their values are as small wherever they are.
    let in_two_lines = table
        .rows
        .iter()
        .flatten()
        .any(|cell| cell.shown.contains('\n'));
    let (letters, apart) = if table.columns.len() > WIDE || in_two_lines {
        (size::SMALL, 5.0)
    } else {
        (size::BODY, 12.0)
    };
    let spare = ui.available_width() - width_of(ui, table, letters, apart);
    if spare < 0.0 {
        return one_below_the_other(ui, table);
    }
    // As wide as the panel, so that tables below each other have their last columns below each other.
    let gaps = table.columns.len().saturating_sub(1).max(1);
    let apart = apart + (spare / gaps as f32).floor();
    let muted = Palette::of(ui).muted;
    let aligned = |ui: &mut Ui, column: &Column, text: RichText| {
        if column.right {
            widgets::cell_right(ui, text)
        } else {
            ui.label(text)
        }
    };
    let grid = Grid::new(("table of an answer", index)).spacing([apart, 4.0]);
    grid.min_col_width(0.0).show(ui, |ui| {
        for column in &table.columns {
            let heading = RichText::new(&column.heading).size(size::SMALL);
            aligned(ui, column, heading.color(muted));
        }
        ui.end_row();
        for row in &table.rows {
            for (cell, column) in row.iter().zip(&table.columns) {
                let text = RichText::new(with_minus_signs(&cell.shown)).size(letters);
                aligned(ui, column, text);
            }
            ui.end_row();
        }
    });
}

/// How much room a table takes without a line that breaks, points.
fn width_of(ui: &Ui, table: &Table, letters: f32, apart: f32) -> f32 {
    let width = |text: &str, letters: f32| {
        let text = WidgetText::from(RichText::new(text).size(letters));
        let galley = text.into_galley(
            ui,
            Some(TextWrapMode::Extend),
            f32::INFINITY,
            TextStyle::Body,
        );
        galley.size().x
    };
    let columns = table.columns.iter().enumerate().map(|(k, column)| {
        let cells = table.rows.iter().filter_map(|row| row.get(k));
        let cells = cells.map(|cell| width(&with_minus_signs(&cell.shown), letters));
        cells.fold(width(&column.heading, size::SMALL), f32::max) + apart
    });
    columns.sum::<f32>() - apart
}

/// Each row: what it is, and below it what its other columns hold.
fn one_below_the_other(ui: &mut Ui, table: &Table) {
    let in_a_line = |text: &str| with_minus_signs(text).replace('\n', " ");
    for row in &table.rows {
        let mut cells = row.iter().zip(&table.columns);
        if let Some((first, column)) = cells.next() {
            // A number alone says nothing; a name says what it is. Nothing stands for the name above.
            let name = in_a_line(&first.shown);
            let name = if name.starts_with(|c: char| c.is_ascii_digit()) {
                format!("{} {name}", in_a_line(&column.heading))
            } else {
                name
            };
            if !name.trim().is_empty() {
                ui.label(RichText::new(name.trim()).font(strong(size::SMALL)));
            }
        }
        let rest = cells.filter(|(cell, _)| !["", "–"].contains(&cell.shown.as_str()));
        let rest = rest.map(|(cell, column)| {
            let (heading, cell) = (in_a_line(&column.heading), in_a_line(&cell.shown));
            // The unit of a column is behind its number, as in a sentence.
            match heading.split_once(", ").filter(|_| column.right) {
                Some((heading, unit)) => format!("{heading} {cell} {unit}"),
                None => format!("{heading} {cell}"),
            }
        });
        let rest = rest.collect::<Vec<_>>().join("; ");
        widgets::hint(ui, if rest.is_empty() { "–" } else { &rest });
    }
}

/// What the button says that adds every found effect.
pub(super) fn add_all(n: usize) -> String {
    match n {
        1 => say!("Add it to the model").to_owned(),
        n => say!("Add all {n} to the model", n),
    }
}

/// The title of an effect, with its joint where the robot has several.
pub(super) fn in_words(id: &str, joint: Option<usize>, workbench: &Workbench) -> String {
    title_on(
        id,
        joint,
        workbench.loaded_session().session.robot.joints.len(),
    )
}

/// Shows what an effect does, in the chart.
pub(super) fn curve_link(ui: &mut Ui, workbench: &Workbench, index: usize) {
    let view = &workbench.view;
    let shown = workbench.shows(effect::ID) && view.effect == index;
    let button = ui.add_enabled_ui(!shown, |ui| widgets::secondary(ui, say!("Show its curve")));
    button
        .inner
        .does(workbench, move |bench| bench.show_effect(index));
}

/// A card for each problem of the data; what is mechanical was corrected before the fit that is shown below.
pub(super) fn problems(
    ui: &mut Ui,
    problems: &[DataProblem],
    detail: Detail,
    workbench: &Workbench,
) {
    // Before the cards: of many the last is out of sight.
    mend_all(ui, problems, workbench);
    let sections = problems_of_data(problems, detail);
    for (section, problem) in sections.iter().zip(problems) {
        widgets::card(ui, |ui| {
            title(ui, section, Title::Large(Palette::of(ui).outside));
            show(ui, &section.blocks);
            of_problem(ui, problem, workbench);
        });
    }
}

/// A problem of the data: the samples that it is about, and its correction.
pub(super) fn of_problem(ui: &mut Ui, problem: &DataProblem, workbench: &Workbench) {
    if !problem.samples.is_empty() && ui.link(say!("Show these samples")).clicked() {
        let samples = problem.samples.clone();
        workbench.then(move |bench| bench.view.mark(samples));
    }
    let Some(mend) = &problem.mend else {
        return;
    };
    if widgets::secondary(ui, &spoken(mend.describe())).clicked() {
        correct(workbench, vec![mend.clone()]);
    }
}

/// All of them at once, where there are several.
pub(super) fn mend_all(ui: &mut Ui, problems: &[DataProblem], workbench: &Workbench) {
    let mends: Vec<_> = problems.iter().filter_map(|p| p.mend.clone()).collect();
    if mends.len() > 1 {
        let text = say!("Correct all {mends}", mends = mends.len());
        if widgets::secondary(ui, &text).clicked() {
            correct(workbench, in_order(mends));
        }
    }
}

fn correct(workbench: &Workbench, mends: Vec<SessionCorrection>) {
    workbench.edits(phrase!("correct data"), move |document| {
        document.correct(&mends)
    });
}

/// Samples are removed last, all at once: until then they have their numbers.
fn in_order(mends: Vec<SessionCorrection>) -> Vec<SessionCorrection> {
    let mut rows = Vec::new();
    let mut ordered = Vec::new();
    for mend in mends {
        match mend {
            SessionCorrection::Remove(some) => rows.extend(some),
            other => ordered.push(other),
        }
    }
    rows.sort_unstable();
    rows.dedup();
    if !rows.is_empty() {
        ordered.push(SessionCorrection::Remove(rows));
    }
    ordered
}

/// What the window can do about what a search could not name.
pub(super) fn unexplained(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    if let Some(found) = d.correction() {
        correction(ui, workbench, found);
        curve_link(ui, workbench, d.found.len());
    }
}

/// Where a smooth correction is measured, and the button that adds it.
fn correction(ui: &mut Ui, workbench: &Workbench, found: &Correction) {
    range(
        ui,
        workbench.loaded_session().session.robot.joints[found.term.joint].kind,
        &found.term,
    );
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&found.term)) {
        None => {
            if widgets::secondary(ui, say!("Add smooth correction")).clicked() {
                // It is what the names leave: without them it would correct something else.
                let mut terms = workbench.not_added();
                terms.push(found.term.clone());
                workbench.then(move |bench| bench.add(&terms));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            let checkbox = ui.checkbox(&mut on, say!("smooth correction in the model"));
            if checkbox.changed() {
                workbench.then(move |bench| bench.switch(index, on));
            }
        }
    }
}

/// Where the curve of a term is measured; outside nothing is known.
fn range(ui: &mut Ui, kind: JointKind, term: &Term) {
    let Some(curve) = term.curve() else { return };
    let (unit, outer): (&str, fn(f64) -> f64) = match kind {
        JointKind::Revolute => ("°", deg_from_rad),
        JointKind::Prismatic => (" mm", |v| v),
    };
    let knots = curve.knots();
    let between = [knots.from, knots.to].map(|v| format!("{}{unit}", trimmed(outer(v), 2)));
    widgets::fact_of(ui, phrase!("measured"), between.join(" … "));
    let most = |size: f64, unit: &str| format!("{}{unit}", significant(size, 2));
    let [motion, radial, axial] = curve.largest();
    let parts = [
        (say!("largest along the motion"), outer(motion), unit),
        (say!("largest along the radius"), radial, " mm"),
        (say!("largest along the axis"), axial, " mm"),
    ];
    for (name, size, unit) in parts {
        if size > 0.0 {
            widgets::fact(ui, name, most(size, unit));
        }
    }
    widgets::hint(
        ui,
        say!(
            "A smooth curve without a name. Outside the measured range its end values are held, and nothing is known"
        ),
    );
}

/// The smooth corrections of a model, beside its parameters.
pub(super) fn smooth_corrections(ui: &mut Ui, model: &Model) {
    for term in model.terms().iter().filter(|t| t.curve.is_some()) {
        widgets::card(ui, |ui| {
            widgets::bold(ui, say!("Unexplained"));
            range(ui, model.robot.joints[term.joint].kind, term);
        });
    }
}
