//! Sections and blocks as cards: what an answer says, in the window's look; what the window adds to a section
//! (buttons, the explanation of an effect) is put below it by the caller. And what several panels show: names of
//! effects and parameters, problems of the data with what mends them, and what no name explains.

use std::fmt::Debug;
use std::time::Duration;

use egui::{
    Button, Color32, Grid, Id, Popup, PopupKind, Response, RichText, TextStyle, TextWrapMode, Ui,
    WidgetText, vec2,
};

use crate::diagnosis::{Correction, Detectability, Diagnosis};
use crate::effects::{Term, find};
use crate::explain::{Block, Detail, Section, problems_of_data};
use crate::fit::{Estimate, RegionResult};
use crate::gui::charts::{About, effect};
use crate::gui::style::{Palette, size, space, strong};

use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::language::spoken;
use crate::model::Model;
use crate::present::limits::sight;
use crate::present::names::{parameter_in_english as parameter, title_on};
use crate::present::numbers::with_minus_signs;
use crate::present::table::{Cell, Column, Table};
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;
use crate::units::deg_from_rad;

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

/// The least room for words that break, points: a long word in small letters.
const WORDS: f32 = 76.0;

/// A table, wide ones in small letters; where it is wider than the panel its words break, and where that is not enough
/// its rows stand one below the other.
fn table(ui: &mut Ui, index: usize, table: &Table) {
    // Intervals below their values are as small wherever they are.
    let in_two_lines = table
        .rows
        .iter()
        .flatten()
        .any(|cell| cell.shown.contains('\n'));
    let small = table.columns.len() > WIDE || in_two_lines;
    let room = ui.available_width();
    let whole = widths_of(ui, table, small);
    if together(&whole, small) <= room {
        return grid(ui, index, table, &whole, small);
    }
    let mut broken = table.clone();
    for column in &mut broken.columns {
        column.heading = column.heading.replace(' ', "\n");
    }
    let mut widths = widths_of(ui, &broken, true);
    let short = (together(&widths, true) - room).max(0.0);
    let columns = broken.columns.iter().zip(&mut widths);
    let words = columns.filter_map(|(column, width)| (!column.right).then_some(width));
    match words.max_by(|a, b| a.total_cmp(b)) {
        Some(widest) if *widest - short >= WORDS.min(*widest) => {
            *widest -= short;
            grid(ui, index, &broken, &widths, true);
        }
        _ => one_below_the_other(ui, table),
    }
}

/// Size of its letters, and how far apart its columns are at least, points.
const fn letters(small: bool) -> (f32, f32) {
    if small {
        (size::SMALL, 5.0)
    } else {
        (size::BODY, 12.0)
    }
}

/// As wide as the panel, so that tables below each other have their last columns below each other.
fn grid(ui: &mut Ui, index: usize, table: &Table, widths: &[f32], small: bool) {
    let (letters, apart) = letters(small);
    let spare = (ui.available_width() - together(widths, small)).max(0.0);
    let gaps = table.columns.len().saturating_sub(1).max(1);
    let apart = apart + (spare / gaps as f32).floor();
    let muted = Palette::of(ui).muted;
    let aligned = |ui: &mut Ui, column: &Column, width: f32, text: RichText| {
        if column.right {
            return widgets::cell_right(ui, text);
        }
        let words = |ui: &mut Ui| {
            ui.set_max_width(width);
            ui.add(egui::Label::new(text).wrap())
        };
        let across = egui::Layout::left_to_right(egui::Align::Center);
        ui.with_layout(across, words).inner
    };
    let grid = Grid::new(("table of an answer", index)).spacing([apart, 4.0]);
    grid.min_col_width(0.0).show(ui, |ui| {
        for (column, width) in table.columns.iter().zip(widths) {
            let heading = RichText::new(&column.heading).size(size::SMALL);
            aligned(ui, column, *width, heading.color(muted));
        }
        ui.end_row();
        for row in &table.rows {
            for ((cell, column), width) in row.iter().zip(&table.columns).zip(widths) {
                let text = RichText::new(with_minus_signs(&cell.shown)).size(letters);
                aligned(ui, column, *width, text);
            }
            ui.end_row();
        }
    });
}

/// How wide columns and what is between them are at least, points.
fn together(widths: &[f32], small: bool) -> f32 {
    widths.iter().sum::<f32>() + letters(small).1 * widths.len().saturating_sub(1) as f32
}

/// How much room each column takes without a line that breaks, points.
fn widths_of(ui: &Ui, table: &Table, small: bool) -> Vec<f32> {
    let (letters, _) = letters(small);
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
        let widest = cells.fold(width(&column.heading, size::SMALL), f32::max);
        widest.ceil()
    });
    columns.collect()
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
        1 => say!("Add the effect to the model").to_owned(),
        n => say!("Add all {n} effects to the model", n),
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

/// The button that adds a smooth correction.
fn correction(ui: &mut Ui, workbench: &Workbench, found: &Correction) {
    // It is what the names leave: without them it would correct something else.
    let mut terms = workbench.not_added();
    terms.push(found.term.clone());
    let says = [
        say!("Add smooth correction"),
        say!("smooth correction in the model"),
    ];
    in_the_model(ui, workbench, terms, says);
}

/// Adds terms to the model, or switches the last of them on and off there.
pub(super) fn in_the_model(
    ui: &mut Ui,
    workbench: &Workbench,
    terms: Vec<Term>,
    [add, there]: [&str; 2],
) {
    let Some(term) = terms.last() else { return };
    let mut added = workbench.document().added.iter();
    if let Some(index) = added.position(|a| a.term.same_column(term)) {
        let mut on = workbench.document().added[index].on;
        if ui.checkbox(&mut on, there).changed() {
            workbench.then(move |bench| bench.switch(index, on));
        }
    } else {
        widgets::secondary(ui, add).does(workbench, move |bench| bench.add(&terms));
    }
}

/// The smooth corrections of a model, beside its parameters.
pub(super) fn smooth_corrections(ui: &mut Ui, model: &Model) {
    for _ in model.terms().iter().filter(|t| t.curve.is_some()) {
        widgets::card(ui, |ui| {
            widgets::bold(ui, say!("Unexplained"));
            widgets::hint(
                ui,
                say!(
                    "A smooth curve without a name. Outside the measured range its end values are held, and nothing is known"
                ),
            );
        });
    }
}

// What is copied from the window: tables as text for a spreadsheet (tabs between the columns, full
// digits, the decimal sign that the user chose).

/// A button that copies a table.
pub(super) fn button(ui: &mut Ui, of: &str, text: impl FnOnce() -> String) {
    ui.add_space(space::TIGHT);
    let id = ui.scope_id().with(("copied", of));
    let copied = is_recent(ui, id);
    // Higher than the rows of a dense table: it is pressed, not read. As wide as its longest text.
    let says = if copied {
        say!("Copied")
    } else {
        say!("Copy table")
    };
    let button = Button::new(RichText::new(says).size(size::SMALL));
    let button = ui.add(button.min_size(vec2(78.0, 22.0)));
    let name = if copied {
        say!("Copied table of {of}", of)
    } else {
        say!("Copy table of {of}", of)
    };
    widgets::label(&button, name);
    if button.clicked() {
        ui.copy_text(text());
        remember(ui, id);
    }
}

/// How long a copy says that it was made, s.
const SAID: f64 = 2.0;

fn remember(ui: &Ui, id: Id) {
    let now = ui.input(|input| input.time);
    ui.data_mut(|data| data.insert_temp(id, now));
    ui.ctx().request_repaint();
}

/// Whether this was copied a moment ago.
fn is_recent(ui: &Ui, id: Id) -> bool {
    let copied: Option<f64> = ui.data(|data| data.get_temp(id));
    let now = ui.input(|input| input.time);
    let left = copied.map(|copied| copied + SAID - now);
    let Some(left) = left.filter(|left| (0.0..=SAID).contains(left)) else {
        return false;
    };
    ui.ctx()
        .request_repaint_after(Duration::from_secs_f64(left));
    true
}

/// The mark in a chart's bar that copies its numbers.
pub(super) fn chart_button(ui: &mut Ui, about: &About, workbench: &Workbench) {
    let id = about.id;
    let says = say!("Copy numbers: {of}", of = about.name().to_lowercase());
    let button = widgets::icon_button(ui, widgets::COPY, &says).on_hover_text(&says);
    button.does(workbench, move |bench| bench.copy_numbers(id));
    if is_recent(ui, id_of(about.id)) {
        // What lies beneath it can be clicked all the same.
        Popup::from_response(&button)
            .kind(PopupKind::Tooltip)
            .interactable(false)
            .show(|ui| ui.label(say!("Copied")));
    }
}

/// Copies a chart's numbers, which were made in the background.
pub(crate) fn chart(ui: &Ui, workbench: &mut Workbench) {
    if let Some((chart, text)) = workbench.take_copied() {
        ui.copy_text(text);
        remember(ui, id_of(chart));
    }
}

fn id_of(chart: &str) -> Id {
    Id::unique("copied").with(chart)
}

/// The title of an effect: what is copied is English, as files are.
fn effect_title(id: &str) -> &str {
    find(id).map_or(id, |effect| effect.about().title.english())
}

/// The columns of a parameter with its interval.
const PARAMETER: &str = "effect | joint | parameter | value | 95 % from | 95 % to | unit";

/// The cells of a parameter with its interval.
fn estimate(one: &Estimate) -> Vec<Cell> {
    let (name, unit) = parameter(one.name);
    let [from, to] = ends(one.ci95);
    let (effect, value) = (effect_title(one.effect).into(), one.value.into());
    vec![
        effect,
        one.joint.into(),
        name.into(),
        value,
        from,
        to,
        unit.into(),
    ]
}

fn ends(interval: Option<[f64; 2]>) -> [Cell; 2] {
    interval.map_or_else(Default::default, |ends| ends.map(Cell::from))
}

/// Every parameter with its interval.
pub(super) fn parameters(estimates: &[Estimate]) -> String {
    let mut table = Table::headed(PARAMETER);
    table.rows = estimates.iter().map(estimate).collect();
    table.tabbed()
}

/// What was found, parameter by parameter, each with the evidence of its name.
pub(super) fn found(d: &Diagnosis) -> String {
    let mut table = Table::headed(format!(
        "{PARAMETER} | noise alone, 1 of | odds over the next candidate | share | RMS error before, mm \
         | RMS error after, mm | cross-validated before, mm | cross-validated after, mm"
    ));
    for found in &d.found {
        for one in &found.parameters {
            let mut cells = estimate(one);
            let odds = [
                (1.0 / found.p_familywise.p).round(),
                found.odds_over_next,
                found.share,
            ];
            cells.extend(odds.into_iter().chain(found.gap_mm).map(Cell::from));
            cells.extend(ends(found.held_out_mm));
            table.rows.push(cells);
        }
    }
    table.tabbed()
}

/// How large each effect could be without having been seen; an empty size was not to be seen at all.
pub(super) fn limits(d: &Diagnosis) -> String {
    let mut table = Table::headed("effect | joint | parameter | detection limit (95 %) | unit");
    for limit in &d.not_found {
        for (full, size) in &limit.sizes {
            let (name, unit) = parameter(full);
            let size = match sight(limit.effect, full, *size) {
                Detectability::Above(size) => Some(size),
                Detectability::AtAnySize => Some(0.0),
                Detectability::AtNoSize => None,
            };
            let joint = limit.joint.map(|joint| joint + 1);
            let effect = Cell::from(effect_title(limit.effect));
            table.row([effect, joint.into(), name.into(), size.into(), unit.into()]);
        }
    }
    table.tabbed()
}

/// Sample by sample: what was commanded and measured, and how far that is from the simulation.
pub(super) fn samples(workbench: &Workbench) -> String {
    let loaded_session = workbench.loaded_session();
    let (session, answer) = (&loaded_session.session, workbench.answer());
    let mut heads = vec!["sample".to_owned()];
    let joints = session.robot.joints.iter().enumerate();
    heads.extend(joints.map(|(j, joint)| format!("q{}, {}", j + 1, joint.kind.unit())));
    let others = "reflector | x, mm | y, mm | z, mm | before, mm | after, mm";
    heads.extend(others.split(" | ").map(str::to_owned));
    let mut table = Table::new(heads);
    let samples = &session.samples;
    for sample in 0..loaded_session.len() {
        let mut cells = vec![Cell::from(sample + 1)];
        let joints = session.robot.joints.iter().zip(&samples.q);
        cells.extend(joints.map(|(joint, q)| Cell::from(joint.kind.to_display(q[sample]))));
        let target = samples
            .target
            .as_ref()
            .map(|target| target[sample] as usize);
        let target = target.and_then(|target| session.targets.get(target));
        cells.push(target.map(|target| target.name.as_str()).into());
        let z = samples.z_mm.as_ref().map_or(f64::NAN, |z| z[sample]);
        let before = loaded_session.before.length_mm[sample];
        let after = answer.map_or(f64::NAN, |answer| answer.lengths_mm[sample]);
        let numbers = [samples.x_mm[sample], samples.y_mm[sample], z, before, after];
        cells.extend(numbers.map(Cell::from));
        table.rows.push(cells);
    }
    table.tabbed()
}

/// Every region's correction with its intervals.
pub(super) fn regions(results: &[RegionResult]) -> String {
    let mut table = Table::headed(
        "region | from, deg | to, deg | samples | dtheta, rad | 95 % from \
 | 95 % to | dl1, mm | 95 % from | 95 % to | RMS error before, mm | RMS error after, mm",
    );
    for result in results {
        let c = &result.correction;
        let [theta_from, theta_to] = ends(result.theta_ci95);
        let [l1_from, l1_to] = ends(result.l1_ci95);
        table.row([
            c.name.as_str().into(),
            deg_from_rad(c.from_rad).into(),
            deg_from_rad(c.to_rad).into(),
            c.samples.into(),
            c.theta_rad.into(),
            theta_from,
            theta_to,
            c.l1_mm.into(),
            l1_from,
            l1_to,
            result.rms_before_mm.into(),
            Cell::from(result.rms_after_mm),
        ]);
    }
    table.tabbed()
}
