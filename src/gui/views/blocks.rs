//! Sections and blocks as cards: what an answer says, in the window's look; what the window adds to a section
//! (buttons, the explanation of an effect) is put below it by the caller. And what several panels show: names of
//! effects and parameters, problems of the data with what mends them, and what no name explains.

use egui::{Color32, FontId, Grid, Response, RichText, Ui};

use crate::diagnosis::Diagnosis;
use crate::effects::Term;
use crate::explain::{Block, Detail, Section, problems_of_data};
use crate::gui::charts::effect;
use crate::gui::style::{Palette, size, strong};
use crate::text::capital;

use crate::gui::widgets::{self, Buttons, Does, Words};
use crate::gui::workbench::Workbench;
use crate::language::spoken;
use crate::model::Model;
use crate::present::names::title_on;
use crate::present::numbers::with_minus_signs;
use crate::present::table::{Column, Table};
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;

/// A section's title: the name of something, or an answer, which is large and in this colour. What it returns can be
/// explained.
pub(crate) fn title(ui: &mut Ui, section: &Section, answer: Option<Color32>) -> Response {
    let text = RichText::new(&section.title);
    let text = match answer {
        None => text.font(strong(size::BODY)),
        Some(color) => text.font(strong(size::HEADING)).color(color),
    };
    ui.add(egui::Label::new(text).wrap())
}

/// A section as a card.
pub(super) fn card(ui: &mut Ui, section: &Section) {
    widgets::card(ui, |ui| {
        title(ui, section, None);
        show(ui, &section.blocks);
    });
}

/// What stands out, in this colour.
pub(super) fn bold_in(ui: &mut Ui, text: &str, color: Color32) {
    let text = RichText::new(text).font(strong(size::BODY)).color(color);
    ui.add(egui::Label::new(text).wrap());
}

/// What belongs to it.
pub(crate) fn show(ui: &mut Ui, blocks: &[Block]) {
    for (index, block) in blocks.iter().enumerate() {
        match block {
            Block::Heading(text) => {
                ui.label(RichText::new(text).font(strong(size::SMALL)));
            }
            Block::Text(text) => ui.hint(with_minus_signs(text)),
            Block::Warning(text) => {
                ui.colored_label(Palette::of(ui).warning, with_minus_signs(text));
            }
            Block::List(points) => {
                for point in points {
                    ui.hint(with_minus_signs(point));
                }
            }
            Block::Facts(facts) => {
                for (name, value) in facts {
                    ui.fact(name, with_minus_signs(value));
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
            Block::List(points) => points
                .iter()
                .for_each(|one| ui.wrong(&with_minus_signs(one))),
            other => show(ui, std::slice::from_ref(other)),
        }
    }
}

/// Columns of a table from which on it is wide.
const WIDE: usize = 5;

/// A table, wide ones in small letters; where it is wider than the panel its rows stand one below the other.
fn table(ui: &mut Ui, index: usize, table: &Table) {
    // Intervals below their values are as small wherever they are.
    let mut cells = table.rows.iter().flatten();
    let in_two_lines = cells.any(|cell| cell.shown.contains('\n'));
    let (letters, apart) = if table.columns.len() > WIDE || in_two_lines {
        (size::SMALL, 5.0)
    } else {
        (size::BODY, 12.0)
    };
    let width = |text: &str, size| widgets::width_of(ui, text, FontId::proportional(size));
    let columns = table.columns.iter().enumerate().map(|(k, column)| {
        let cells = table.rows.iter().filter_map(|row| row.get(k));
        let cells = cells.map(|cell| width(&with_minus_signs(&cell.shown), letters));
        cells
            .fold(width(&column.heading, size::SMALL), f32::max)
            .ceil()
    });
    let gaps = table.columns.len().saturating_sub(1).max(1) as f32;
    let spare = ui.available_width() - columns.sum::<f32>() - apart * gaps;
    if spare < 0.0 {
        return one_below_the_other(ui, table);
    }
    let cell = |ui: &mut Ui, column: &Column, text: RichText| {
        if column.right {
            widgets::cell_right(ui, text)
        } else {
            ui.label(text)
        }
    };
    // As wide as the panel, so that tables below each other have their last columns below each other.
    let spacing = [apart + (spare / gaps).floor(), 4.0];
    let grid = Grid::new(("table of an answer", index)).spacing(spacing);
    grid.min_col_width(0.0).show(ui, |ui| {
        for column in &table.columns {
            cell(ui, column, RichText::new(&column.heading).small().weak());
        }
        ui.end_row();
        for row in &table.rows {
            for (one, column) in row.iter().zip(&table.columns) {
                let text = RichText::new(with_minus_signs(&one.shown)).size(letters);
                cell(ui, column, text);
            }
            ui.end_row();
        }
    });
}

/// Each row: what it is, and below it what its other columns hold.
fn one_below_the_other(ui: &mut Ui, table: &Table) {
    let in_a_line = |text: &str| with_minus_signs(text).replace('\n', " ");
    for row in &table.rows {
        let mut cells = row.iter().zip(&table.columns);
        let first = cells.next();
        let facts = cells.filter(|(cell, _)| !["", "–"].contains(&&*cell.shown));
        let facts: Vec<_> = facts.collect();
        if facts.is_empty() && row.len() > 1 {
            continue;
        }
        if let Some((first, column)) = first {
            let name = in_a_line(&first.shown);
            // A number alone says nothing; a name says what it is.
            let name = if name.starts_with(|c: char| c.is_ascii_digit()) {
                format!("{} {name}", in_a_line(&column.heading))
            } else {
                name
            };
            // Nothing stands for the name above.
            if !name.is_empty() {
                ui.label(RichText::new(name).font(strong(size::SMALL)));
            }
        }
        for (cell, column) in facts {
            ui.fact(&in_a_line(&column.heading), in_a_line(&cell.shown));
        }
    }
}

/// What the button says that adds every found effect.
pub(super) fn add_all(n: usize) -> String {
    match n {
        1 => say!("Add the effect to the model").to_owned(),
        n => say!("Add all {n} effects to the model", n),
    }
}

/// The title of a term's effect, with its joint where the robot has several.
pub(super) fn in_words(term: &Term, workbench: &Workbench) -> String {
    let about = term.effect.about();
    let joint = about.per_joint.then_some(term.joint + 1);
    let joints = &workbench.loaded_session().session.robot.joints;
    title_on(about.id, joint, joints.len())
}

/// Shows what an effect does, in the chart.
pub(super) fn curve_link(ui: &mut Ui, workbench: &Workbench, index: usize) {
    let view = &workbench.view;
    let shown = workbench.shows(effect::ID) && view.effect == index;
    let link = |ui: &mut Ui| ui.secondary(say!("Show its curve"));
    let link = ui.add_enabled_ui(!shown, link).inner;
    link.does(workbench, move |bench| bench.show_effect(index));
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
            title(ui, section, Some(Palette::of(ui).outside));
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
    if let Some(mend) = &problem.mend
        && ui.secondary(&spoken(mend.describe())).clicked()
    {
        correct(workbench, vec![mend.clone()]);
    }
}

/// All of them at once, where there are several.
pub(super) fn mend_all(ui: &mut Ui, problems: &[DataProblem], workbench: &Workbench) {
    let mends: Vec<_> = problems.iter().filter_map(|p| p.mend.clone()).collect();
    if mends.len() > 1 {
        let text = say!("Correct all {mends}", mends = mends.len());
        if ui.secondary(&text).clicked() {
            correct(workbench, in_order(mends));
        }
    }
}

fn correct(workbench: &Workbench, mends: Vec<SessionCorrection>) {
    workbench.edits(move |document| document.correct(&mends));
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
    let own = d.unnamed_terms();
    // It is what the names leave: without them it would correct something else.
    let names = workbench.not_added();
    if d.correction().is_some() {
        let says = [
            say!("Add smooth correction"),
            say!("smooth correction in the model"),
        ];
        in_the_model(ui, workbench, names, own, says);
        curve_link(ui, workbench, d.found.len());
    } else {
        in_the_model(
            ui,
            workbench,
            names,
            own,
            [&capital(say!("add to model")), say!("in the model")],
        );
    }
}

/// Adds terms to the model, with others that belong to them; or switches them on and off there.
pub(super) fn in_the_model(
    ui: &mut Ui,
    workbench: &Workbench,
    others: Vec<Term>,
    own: Vec<Term>,
    [add, there]: [&str; 2],
) {
    let added = workbench.document().added.iter().enumerate();
    let is_own = |term: &Term| own.iter().any(|own| own.same_column(term));
    let added: Vec<_> = added.filter(|(_, added)| is_own(&added.term)).collect();
    if let [(_, first), ..] = added[..] {
        let mut on = first.on;
        let all: Vec<usize> = added.iter().map(|(index, _)| *index).collect();
        if ui.checkbox(&mut on, there).changed() {
            workbench.edits(move |document| document.switch(&all, on));
        }
    } else if !own.is_empty() {
        let terms = [others, own].concat();
        ui.secondary(add)
            .does(workbench, move |bench| bench.edit(|d| d.add(&terms)));
    }
}

/// The smooth corrections of a model, beside its parameters.
pub(super) fn smooth_corrections(ui: &mut Ui, model: &Model) {
    for _ in model.terms().iter().filter(|t| t.curve.is_some()) {
        widgets::card(ui, |ui| {
            ui.bold(capital(say!("unexplained")));
            ui.hint(say!(
                "A smooth curve without a name. Outside the measured range its end values are held, and nothing is known"
            ));
        });
    }
}
