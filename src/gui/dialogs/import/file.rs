//! How the file is read: what wrote it, what separates its cells, the decimal sign, the header, the
//! units; what it leaves open; and the files beside it.

use std::collections::BTreeMap;

use egui::{Button, ComboBox, DragValue, TextEdit, Ui};

use crate::explain::Block;
use crate::gui::import_draft::{
    Companion, ImportAnswers, ImportDraft, RobotFrom, in_the_sheets_words,
};
use crate::gui::style::{Palette, space};
use crate::gui::views::blocks;
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::importers::{
    About, Alignment, AngleUnit, Decimal, EULER, IMPORTERS, Importer, LengthUnit, Matching,
    OwnOption, Question, Questions, Reading, Separator, TimeUnit,
};
use crate::language::spoken;
use crate::present::table::{Cell, Column, Table};

/// The file in a line: rows, separator, encoding, unit.
pub(super) fn found_out(now: &ImportDraft) -> String {
    let found = &now.seen.inspection;
    let mut parts = vec![say!(one "{count} row", "{count} rows", count = found.rows)];
    parts.extend(
        found
            .separator
            .map(|s| say!("separated by {separator}", separator = spoken(s.name()))),
    );
    parts.extend(found.decimal.map(|d| spoken(d.name())));
    parts.push(match found.header_line {
        Some(line) => say!("header in line {line}", line),
        None => say!("no header").to_owned(),
    });
    parts.push(found.encoding.name().to_owned());
    if !found.unit.is_empty() {
        parts.push(say!("unit: {found}", found = spoken(&found.unit)));
    }
    parts.join(" · ")
}

/// Width of the list of formats, and of the field of an option, points.
const SOURCE: f32 = 430.0;
const OPTION: f32 = 300.0;

/// The rows of the form.
pub(super) fn show(ui: &mut Ui, draft: &mut ImportDraft) {
    let ImportDraft { answers, seen, .. } = draft;
    let found = &seen.inspection;
    ui.form_row(say!("Session"), |ui| {
        let field = TextEdit::singleline(&mut answers.name).desired_width(OPTION);
        ui.named(say!("Name of the session"), field);
    });
    let reading = &mut answers.reading;
    let kind = reading.kind.or(found.kind);
    let asks = kind.map_or(Questions::TABLE, |importer| importer.asks);
    ui.form_row(say!("Source"), |ui| {
        let title = |importer: &Importer| spoken(importer.title);
        let width = SOURCE.min(ui.available_width());
        let list = ComboBox::from_id_salt("what wrote it").width(width);
        let list = list.selected_text(kind.map_or_else(String::new, title));
        let offered = IMPORTERS.iter().map(|one| (Some(*one), title(one)));
        let chosen = widgets::list(ui, say!("What wrote the file"), list, offered, kind);
        if chosen.is_some_and(|chosen| chosen != kind) {
            reading.kind = chosen.flatten();
            reading.columns.clear();
        }
    });
    if asks.table {
        let separators = [
            (Some(Separator::Comma), say!("commas")),
            (Some(Separator::Semicolon), say!("semicolons")),
            (Some(Separator::Tab), say!("tabs")),
            (Some(Separator::Spaces), say!("spaces")),
        ];
        let said = (&mut reading.separator, found.separator);
        one_of(ui, say!("Separated by"), &separators, said);
        header(ui, found.header_line, &mut reading.header);
    }
    let signs = [(Some(Decimal::Point), "1.5"), (Some(Decimal::Comma), "1,5")];
    let said = (&mut reading.decimal, found.decimal);
    one_of(ui, say!("Decimal sign"), &signs, said);
    let units = [
        (None, say!("as the headings say")),
        (Some(AngleUnit::Degrees), say!("degrees")),
        (Some(AngleUnit::Radians), say!("radians")),
        (Some(AngleUnit::Gradians), "gon"),
        (Some(AngleUnit::Revolutions), say!("revolutions")),
    ];
    ui.choice_row(say!("Angles in"), &units, &mut reading.angle_unit);
    let units = [
        (None, say!("as the file says")),
        (Some(LengthUnit::Millimetres), "mm"),
        (Some(LengthUnit::Metres), "m"),
        (Some(LengthUnit::Inches), say!("inches")),
    ];
    ui.choice_row(say!("Lengths in"), &units, &mut reading.unit);
    if asks.y_up || reading.z_up {
        let says = say!("y points up: turn it so that z does");
        ui.checkbox(&mut reading.z_up, says);
    }
    if asks.names {
        names(ui, &found.names, &mut reading.names);
    }
    if asks.joint {
        let mut joint = reading.joint + 1;
        let field = DragValue::new(&mut joint).range(1..=64);
        ui.number(say!("Joint measured"), "", field);
        reading.joint = joint - 1;
    }
    own_options(ui, kind, reading);
}

/// One of some values, which is as it was found until a person says another.
fn one_of<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    offered: &[(Option<T>, &str)],
    (said, found): (&mut Option<T>, Option<T>),
) {
    ui.form_row(name, |ui| {
        if let Some(chosen) = ui.segmented(offered, said.or(found)) {
            *said = chosen;
        }
    });
}

/// So many options of a format are shown at once.
const FEW_OPTIONS: usize = 2;

/// What only this format can be told.
fn own_options(ui: &mut Ui, kind: Option<&Importer>, reading: &mut Reading) {
    let own = kind.map_or(&[][..], |importer| importer.options).iter();
    // Where there are such angles they are asked about.
    let own = own.filter(|option| option.name != EULER || reading.options.contains_key(EULER));
    let own: Vec<&OwnOption> = own.collect();
    let mut all = |ui: &mut Ui| {
        for option in &own {
            own_option(ui, option, &mut reading.options);
        }
    };
    // Of several few are needed: below them the columns, which always are, would be out of sight.
    if own.len() > FEW_OPTIONS {
        let title = say!("More options of this kind of file");
        ui.folded(title, all);
    } else {
        all(ui);
    }
}

/// An option that only this format has.
fn own_option(ui: &mut Ui, option: &OwnOption, given: &mut BTreeMap<&'static str, String>) {
    let title = spoken(option.title);
    let mut value = given.get(option.name).cloned().unwrap_or_default();
    ui.form_row(&title, |ui| {
        if option.values.is_empty() {
            let field = TextEdit::singleline(&mut value).desired_width(OPTION);
            ui.named(title.as_str(), field);
            return;
        }
        let ways: Vec<(&str, &str)> = option.values.iter().map(|v| (*v, *v)).collect();
        let said = option.values.iter().copied().find(|v| *v == value);
        if let Some(chosen) = ui.segmented(&ways, said.unwrap_or_default()) {
            chosen.clone_into(&mut value);
        }
    });
    if option.values.is_empty() {
        ui.hint(spoken(option.help));
    }
    if value.trim().is_empty() {
        given.remove(option.name);
    } else {
        given.insert(option.name, value);
    }
}

/// Where the header is: as it was found, nowhere, or in a line.
fn header(ui: &mut Ui, found: Option<u64>, header: &mut Option<u64>) {
    let line = found.unwrap_or(1);
    let ways = [
        (None, say!("as found")),
        (Some(0), say!("none")),
        (Some(line), say!("in line")),
    ];
    ui.form_row(say!("Header"), |ui| {
        let now = header.map(|own| if own == 0 { 0 } else { line });
        *header = ui.segmented(&ways, now).unwrap_or(*header);
        if let Some(line @ 1..) = header {
            let field = DragValue::new(line).range(1..=1_000_000);
            ui.cell_number(say!("Line of the header"), "", 64.0, field);
        }
    });
}

/// Rigid bodies or markers to take.
fn names(ui: &mut Ui, offered: &[String], taken: &mut Vec<String>) {
    ui.form_row(say!("Take"), |ui| {
        ui.horizontal_wrapped(|ui| {
            for name in offered {
                let mut on = taken.contains(name);
                if ui.checkbox(&mut on, name).changed() {
                    taken.retain(|other| other != name);
                    if on {
                        taken.push(name.clone());
                    }
                }
            }
        });
    });
}

/// What only a person can say, with the possible answers as buttons.
pub(super) fn questions(ui: &mut Ui, draft: &mut ImportDraft) {
    for question in &draft.seen.inspection.questions {
        widgets::card(ui, |ui| ask(ui, question, &mut draft.answers.reading));
    }
}

fn ask(ui: &mut Ui, question: &Question, reading: &mut Reading) {
    let says = in_the_sheets_words(&spoken(&question.text));
    ui.colored_label(Palette::of(ui).warning, says);
    if question.answers.is_empty() {
        ui.hint(say!("Choose it in the table above"));
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for answer in &question.answers {
            if ui.button(say!("It is {answer}", answer)).clicked() {
                answered(reading, question.about, answer);
            }
        }
    });
}

fn answered(reading: &mut Reading, about: About, answer: &str) {
    match about {
        About::Unit => reading.unit = LengthUnit::of(answer),
        About::AngleUnit => reading.angle_unit = AngleUnit::of(answer),
        About::TimeUnit => reading.time_unit = TimeUnit::of(answer),
        About::Decimal => {
            let comma = Some(Decimal::Comma).filter(|_| answer == ",");
            reading.decimal = comma.or(Some(Decimal::Point));
        }
        About::Name => reading.names = vec![answer.to_owned()],
        About::Own(name) => {
            reading.options.insert(name, answer.to_owned());
        }
        About::Columns => {
            reading.columns = answer.split(',').map(|w| w.trim().to_owned()).collect();
        }
    }
}

/// Where the robot was sent.
pub(super) fn commanded(ui: &mut Ui, draft: &mut ImportDraft, workbench: &Workbench) {
    ui.section(say!("Commanded positions, if the table does not have them"));
    let hint = say!("a table with q1_deg, … and perhaps name, time_s, dir1, load_kg");
    path(ui, Companion::Commands, hint, draft, workbench);
    if draft.answers.file(Companion::Commands).is_empty() {
        return;
    }
    let ways = [
        (Some(Matching::Order), say!("by order")),
        (Some(Matching::Name), say!("by name")),
        (Some(Matching::Time), say!("by time")),
    ];
    // By default as the import has found it, once it could be tried.
    let matched = draft.trial().and_then(|trial| trial.matched.as_ref());
    let found = matched.map(|matched| matched.by);
    let offset = matched.and_then(|matched| matched.clock);
    let offset = offset.map_or(0.0, |clock| clock.offset_s);
    let answers = &mut draft.answers;
    one_of(ui, say!("Matched"), &ways, (&mut answers.matching, found));
    if answers.matching != Some(Matching::Time) {
        return;
    }
    ui.form_row(say!("Clocks apart by"), |ui| {
        let ways = [
            (true, say!("found from the motion")),
            (false, say!("typed")),
        ];
        let found = answers.clock_offset_s.is_none();
        if let Some(found) = ui.segmented(&ways, found) {
            answers.clock_offset_s = (!found).then_some(offset);
        }
        if let Some(offset) = &mut answers.clock_offset_s {
            let name = say!("Seconds to add to a measured time");
            let field = DragValue::new(offset).speed(0.01).max_decimals(6);
            ui.cell_number(name, "s", 110.0, field.suffix(" s"));
        }
    });
}

/// Whether the rows say from where each joint came.
pub(super) fn order_of_rows(ui: &mut Ui, answers: &mut ImportAnswers) {
    if answers.matching != Some(Matching::Time) {
        ui.checkbox(
            &mut answers.in_measuring_order,
            say!("the rows are in the order in which they were measured"),
        );
    }
}

/// Points that bring the instrument's frame into the base frame.
pub(super) fn base_frame(ui: &mut Ui, draft: &mut ImportDraft, workbench: &Workbench) {
    ui.section(say!(
        "Reference points (base frame), if the instrument has a frame of its own"
    ));
    let hint = say!("a table with name, x_mm, y_mm, z_mm; the same names as in the measured file");
    path(ui, Companion::Reference, hint, draft, workbench);
    if draft.answers.file(Companion::Reference).is_empty() {
        return;
    }
    ui.checkbox(&mut draft.answers.scale, say!("fit a scale too"));
    let trial = draft.trial();
    if let Some(alignment) = trial.and_then(|trial| trial.alignment.as_ref()) {
        residuals(ui, alignment);
    }
}

/// How far each point is off after the alignment.
fn residuals(ui: &mut Ui, alignment: &Alignment) {
    const MOST: usize = 60;
    let left_out = alignment.outliers().count();
    if left_out > 0 {
        ui.hint(say!(
            "{left_out} excluded: measured or surveyed wrongly, or moved since",
            left_out
        ));
    }
    if (alignment.scale - 1.0).abs() > 0.0 {
        let ppm = 1e6 * (alignment.scale - 1.0);
        ui.hint(say!(
            "scaled by {scale} ({ppm} ppm)",
            scale = format!("{:.6}", alignment.scale),
            ppm = format!("{ppm:+.1}")
        ));
    }
    let heads = [say!("residual, mm"), "x", "y", "z"];
    let mut columns = vec![Column::words(say!("point"))];
    columns.extend(heads.map(Column::numbers));
    columns.push(Column::words(""));
    let mut table = Table::of(columns);
    for residual in alignment.residuals.iter().take(MOST) {
        let v = residual.vector_mm;
        let number = |mm: f64| Cell::number(Some(mm), |mm| format!("{mm:.4}"));
        let mut cells = vec![Cell::from(residual.name.as_str())];
        cells.extend([v.norm(), v.x, v.y, v.z].map(number));
        cells.push(residual.is_outlier.then(|| say!("excluded")).into());
        table.row(cells);
    }
    blocks::show(ui, &[Block::Table(table)]);
}

/// Where the reflectors sit.
pub(super) fn reflectors(ui: &mut Ui, draft: &mut ImportDraft, workbench: &Workbench) {
    ui.section(say!("Reflectors in the tool frame, if there are several"));
    let hint =
        say!("a table with name, x_mm, y_mm, z_mm; without it one sits at the tool's origin");
    path(ui, Companion::Targets, hint, draft, workbench);
}

/// A field for the path of a file, with a button that asks for it.
pub(super) fn path(
    ui: &mut Ui,
    which: Companion,
    hint: &str,
    draft: &mut ImportDraft,
    workbench: &Workbench,
) {
    let row = egui::Layout::right_to_left(egui::Align::Center);
    let room = egui::vec2(ui.available_width(), space::CONTROL);
    ui.allocate_ui_with_layout(room, row, |ui| {
        let choose = say!("Choose…");
        let button = ui.named(format!("{choose} {}", which.name()), Button::new(choose));
        button.does(workbench, move |bench| bench.choose_beside(which));
        let typed = &mut draft.answers.files[which as usize];
        let field = TextEdit::singleline(typed).hint_text(hint);
        let field = ui.add_sized([ui.available_width(), space::CONTROL], field);
        widgets::label(&field, which.name());
        if field.changed() && which == Companion::Robot {
            draft.answers.robot = RobotFrom::File;
        }
    });
}
