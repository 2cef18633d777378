//! A table without a robot, to be made a session: what its columns are taken for stands over their
//! first rows, what is not known is asked, and nothing is guessed in silence.

use egui::{ComboBox, Grid, RichText, ScrollArea, TextEdit, Ui};

use crate::diagnostic::Severity;
use crate::gui::commands::{Command, Workbench};
use crate::gui::files::EXAMPLES;
use crate::gui::foreign::{Foreign, RobotFrom};
use crate::gui::tokens::{Palette, size, space, strong};
use crate::gui::view::Sheet;
use crate::gui::widgets;
use crate::importers::{About, AngleUnit, Decimal, LengthUnit, Matching, Question, Separator};

/// Rows that are shown.
const ROWS: usize = 4;

/// Shows the sheet.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, now: &Foreign, commands: &mut Vec<Command>) {
    ui.set_width(720.0);
    let name = now.path.file_name().unwrap_or_default().to_string_lossy();
    widgets::heading(ui, &format!("Import {name}"));
    widgets::hint(ui, found_out(now));
    let mut next = now.clone();
    ScrollArea::vertical().max_height(470.0).show(ui, |ui| {
        // Beside what scrolls, not over it.
        ui.set_width(ui.available_width() - f32::from(space::PANEL));
        dialect(ui, &mut next);
        columns(ui, &mut next);
        for question in &now.inspection.questions {
            widgets::card(ui, |ui| ask(ui, question, &mut next));
        }
        findings(ui, now);
        robot(ui, workbench, &mut next);
        commanded(ui, &mut next);
        for line in &now.refused {
            widgets::wrong(ui, line);
        }
    });
    let missing = next.missing();
    if let Some(missing) = missing {
        widgets::hint(ui, missing);
    }
    if super::sheets::buttons(ui, "Import", missing.is_none(), commands) {
        commands.push(Command::Import(Box::new(next)));
    } else if next.reading != now.reading {
        commands.push(Command::Inspect(Box::new(next)));
    } else if next != *now {
        commands.push(Command::Sheet(Some(Sheet::Import(Box::new(next)))));
    }
}

fn found_out(now: &Foreign) -> String {
    let found = &now.inspection;
    let mut parts = vec![format!("{} rows", found.rows)];
    parts.extend(found.separator.map(|s| format!("separated by {s}")));
    parts.push(found.encoding.to_string());
    if !found.unit.is_empty() {
        parts.push(format!("unit: {}", found.unit));
    }
    parts.join(" · ")
}

fn dialect(ui: &mut Ui, next: &mut Foreign) {
    let found = &next.inspection;
    let separators = [
        (Some(Separator::Comma), "commas"),
        (Some(Separator::Semicolon), "semicolons"),
        (Some(Separator::Tab), "tabs"),
        (Some(Separator::Spaces), "spaces"),
    ];
    let separator = next.reading.separator.or(found.separator);
    widgets::form_row(ui, "Separated by", |ui| {
        if let Some(chosen) = widgets::segmented(ui, &separators, separator) {
            next.reading.separator = chosen;
        }
    });
    let decimal = next.reading.decimal.or(next.inspection.decimal);
    let signs = [(Some(Decimal::Point), "1.5"), (Some(Decimal::Comma), "1,5")];
    widgets::form_row(ui, "Decimal sign", |ui| {
        if let Some(chosen) = widgets::segmented(ui, &signs, decimal) {
            next.reading.decimal = chosen;
        }
    });
    let units = [
        (None, "as the file says"),
        (Some(LengthUnit::Millimetres), "mm"),
        (Some(LengthUnit::Metres), "m"),
        (Some(LengthUnit::Inches), "inches"),
    ];
    widgets::form_row(ui, "Lengths in", |ui| {
        if let Some(chosen) = widgets::segmented(ui, &units, next.reading.unit) {
            next.reading.unit = chosen;
        }
    });
}

/// What a column can be, in the words of a session.
const MEANINGS: [&str; 23] = [
    "-",
    "name",
    "group",
    "target",
    "q1_deg",
    "q2_deg",
    "q3_deg",
    "q4_deg",
    "q5_deg",
    "q6_deg",
    "q1_rad",
    "q1_mm",
    "x",
    "y",
    "z",
    "x_mm",
    "y_mm",
    "z_mm",
    "dir1",
    "load_kg",
    "temperature_c",
    "time_s",
    "setup",
];

fn columns(ui: &mut Ui, next: &mut Foreign) {
    let guesses = next.inspection.columns.clone();
    if guesses.is_empty() {
        return;
    }
    widgets::section(ui, "Columns: what each is, its heading, and the first rows");
    let palette = Palette::of(ui);
    let mut changed = None;
    ScrollArea::horizontal().id_salt("columns").show(ui, |ui| {
        Grid::new("columns of the file")
            .spacing([10.0, 4.0])
            .show(ui, |ui| {
                for (k, guess) in guesses.iter().enumerate() {
                    let meaning = match guess.meaning.as_str() {
                        "" | "-" => "left out",
                        other => other,
                    };
                    let list = ComboBox::from_id_salt(("meaning", k))
                        .width(84.0)
                        .selected_text(meaning)
                        .show_ui(ui, |ui| {
                            for offered in MEANINGS {
                                let text = if offered == "-" { "left out" } else { offered };
                                if ui
                                    .selectable_label(guess.meaning == offered, text)
                                    .clicked()
                                {
                                    changed = Some((k, offered));
                                }
                            }
                        });
                    let label = format!("Meaning of column {}", k + 1);
                    ui.ctx()
                        .accesskit_node_builder(list.response.id, |node| node.set_label(label));
                }
                ui.end_row();
                for guess in &guesses {
                    ui.label(RichText::new(&guess.heading).font(strong(size::SMALL)));
                }
                ui.end_row();
                for cells in next.inspection.first_rows.iter().take(ROWS) {
                    for k in 0..guesses.len() {
                        let cell = cells.get(k).map_or("", String::as_str);
                        ui.label(RichText::new(cell).size(size::SMALL).color(palette.muted));
                    }
                    ui.end_row();
                }
            });
    });
    if let Some((k, meaning)) = changed {
        let words = guesses.iter().map(|guess| match guess.meaning.as_str() {
            "" => "-".to_owned(),
            other => other.to_owned(),
        });
        next.reading.columns = words.collect();
        meaning.clone_into(&mut next.reading.columns[k]);
    }
}

fn ask(ui: &mut Ui, question: &Question, next: &mut Foreign) {
    let palette = Palette::of(ui);
    let says = RichText::new(&question.says).color(palette.warning);
    ui.add(egui::Label::new(says).wrap());
    if question.answers.is_empty() {
        widgets::hint(ui, "Choose it in the table above");
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for answer in &question.answers {
            if ui.button(format!("It is {answer}")).clicked() {
                answered(next, question.about, answer);
            }
        }
    });
}

fn answered(next: &mut Foreign, about: About, answer: &str) {
    let reading = &mut next.reading;
    match about {
        About::Unit => {
            reading.unit = LengthUnit::ALL.into_iter().find(|u| u.symbol() == answer);
        }
        About::AngleUnit => {
            let units = [AngleUnit::Degrees, AngleUnit::Radians];
            reading.angle_unit = units.into_iter().find(|u| u.symbol() == answer);
        }
        About::Decimal => {
            reading.decimal = Some(if answer == "," {
                Decimal::Comma
            } else {
                Decimal::Point
            });
        }
        About::Name => reading.names = vec![answer.to_owned()],
        About::Kind => reading.kind = crate::importers::find(answer).map(|i| i.kind),
        About::Columns => {
            reading.columns = answer.split(',').map(|w| w.trim().to_owned()).collect();
        }
    }
}

fn findings(ui: &mut Ui, now: &Foreign) {
    let palette = Palette::of(ui);
    for finding in now.inspection.findings.iter().take(8) {
        let color = match finding.severity {
            Severity::Note => palette.muted,
            Severity::Warning => palette.warning,
            Severity::Error => palette.outside,
        };
        let text = RichText::new(finding.to_string())
            .size(size::SMALL)
            .color(color);
        ui.add(egui::Label::new(text).wrap());
    }
}

fn robot(ui: &mut Ui, workbench: &Workbench, next: &mut Foreign) {
    widgets::section(ui, "Which robot was measured");
    let here = &workbench.subject().session.robot;
    let is = |robot: &RobotFrom, other: &RobotFrom| {
        std::mem::discriminant(robot) == std::mem::discriminant(other)
    };
    let open = RobotFrom::Here(Box::new(here.clone()));
    let text = format!("that of the open session, {}", here.name);
    if ui.radio(is(&next.robot, &open), text).clicked() {
        next.robot = open;
    }
    for (k, example) in EXAMPLES.iter().enumerate() {
        let one = RobotFrom::Example(k);
        let text = format!("that of the example {}", example.name);
        if ui.radio(next.robot == one, text).clicked() {
            next.robot = one;
        }
    }
    let mut path = match &next.robot {
        RobotFrom::File(path) => path.clone(),
        _ => String::new(),
    };
    let file = RobotFrom::File(path.clone());
    ui.horizontal(|ui| {
        if ui
            .radio(is(&next.robot, &file), "the one in this file")
            .clicked()
        {
            next.robot = file;
        }
        let field = TextEdit::singleline(&mut path)
            .hint_text("a robot or a session")
            .desired_width(f32::INFINITY);
        let field = ui.add(field);
        ui.ctx()
            .accesskit_node_builder(field.id, |node| node.set_label("File of the robot"));
        if field.changed() {
            next.robot = RobotFrom::File(path);
        }
    });
}

fn commanded(ui: &mut Ui, next: &mut Foreign) {
    widgets::section(ui, "Where the robot was sent, if the table does not say it");
    let field = TextEdit::singleline(&mut next.commands)
        .hint_text("path of a table with the commands")
        .desired_width(f32::INFINITY);
    let field = ui.add(field);
    ui.ctx()
        .accesskit_node_builder(field.id, |node| node.set_label("File of the commands"));
    if next.commands.trim().is_empty() {
        return;
    }
    let ways = [
        (Matching::Order, "by order"),
        (Matching::Name, "by name"),
        (Matching::Time, "by time"),
    ];
    widgets::form_row(ui, "Matched", |ui| {
        if let Some(matching) = widgets::segmented(ui, &ways, next.matching) {
            next.matching = matching;
        }
    });
    ui.add_space(space::TIGHT);
}
