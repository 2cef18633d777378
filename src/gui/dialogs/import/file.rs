//! How the file is read: what wrote it, what separates its cells, the decimal sign, the header, the
//! units; what it leaves open; and the files beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use egui::{ComboBox, DragValue, Grid, RichText, TextEdit, Ui};

use crate::gui::core::disk::name_of;
use crate::gui::import_draft::{Companion, ImportAnswers, ImportDraft, in_the_sheets_words};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::importers::{
    About, Alignment, AngleUnit, Decimal, EULER, IMPORTERS, Importer, LengthUnit, Matching,
    OwnOption, Question, Questions, Reading, Separator, TimeUnit,
};
use crate::language::{self, spoken};
use crate::sessions::Target;
use crate::text::{length, stretch};

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
    parts.push(found.encoding.to_string());
    if !found.unit.is_empty() {
        parts.push(say!("unit: {found}", found = spoken(&found.unit)));
    }
    parts.join(" · ")
}

/// With less room what stands in one row stands in two, points.
const ONE_ROW: f32 = 660.0;

/// Two answers with their names, side by side where there is room.
fn two_in_a_row(
    ui: &mut Ui,
    (name, first): (&str, impl FnOnce(&mut Ui)),
    (caption, second): (&str, impl FnOnce(&mut Ui)),
) {
    if ui.available_width() >= ONE_ROW * stretch() {
        widgets::form_row(ui, name, |ui| {
            first(ui);
            widgets::caption(ui, caption);
            second(ui);
        });
    } else {
        widgets::form_row(ui, name, first);
        widgets::form_row(ui, caption, second);
    }
}

/// Width of the list of formats, points.
const SOURCE: f32 = 430.0;

/// The rows of the form.
pub(super) fn show(ui: &mut Ui, now: &ImportDraft, next: &mut ImportAnswers) {
    let found = &now.seen.inspection;
    widgets::form_row(ui, say!("Session"), |ui| {
        let field = TextEdit::singleline(&mut next.name).desired_width(300.0);
        let field = ui.add(field);
        widgets::label(&field, say!("Name of the session"));
    });
    let reading = &mut next.reading;
    let kind = reading.kind.or(found.kind);
    let asks = kind.map_or(Questions::TABLE, |importer| importer.asks);
    widgets::form_row(ui, say!("Source"), |ui| {
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
        let separator = reading.separator.or(found.separator);
        let Reading {
            separator: said,
            header: line,
            ..
        } = &mut *reading;
        two_in_a_row(
            ui,
            (say!("Separated by"), |ui: &mut Ui| {
                if let Some(chosen) = widgets::segmented(ui, &separators, separator) {
                    *said = chosen;
                }
            }),
            (say!("header"), |ui: &mut Ui| {
                header(ui, found.header_line, line);
            }),
        );
    }
    let decimal = reading.decimal.or(found.decimal);
    let signs = [(Some(Decimal::Point), "1.5"), (Some(Decimal::Comma), "1,5")];
    let units = [
        (None, say!("as the headings say")),
        (Some(AngleUnit::Degrees), say!("degrees")),
        (Some(AngleUnit::Radians), say!("radians")),
        (Some(AngleUnit::Gradians), "gon"),
        (Some(AngleUnit::Revolutions), say!("revolutions")),
    ];
    let Reading {
        decimal: said,
        angle_unit,
        ..
    } = &mut *reading;
    two_in_a_row(
        ui,
        (say!("Decimal sign"), |ui: &mut Ui| {
            if let Some(chosen) = widgets::segmented(ui, &signs, decimal) {
                *said = chosen;
            }
        }),
        (say!("angles in"), |ui: &mut Ui| {
            widgets::choice(ui, &units, angle_unit);
        }),
    );
    let units = [
        (None, say!("as the file says")),
        (Some(LengthUnit::Millimetres), "mm"),
        (Some(LengthUnit::Metres), "m"),
        (Some(LengthUnit::Inches), say!("inches")),
    ];
    widgets::choice_row(ui, say!("Lengths in"), &units, &mut reading.unit);
    if asks.y_up || reading.z_up {
        ui.checkbox(
            &mut reading.z_up,
            say!("y points up: turn it so that z does"),
        );
    }
    if asks.names {
        names(ui, &found.names, &mut reading.names);
    }
    if asks.joint {
        let mut joint = reading.joint as u64 + 1;
        let field = DragValue::new(&mut joint).range(1..=64);
        if widgets::number(ui, say!("Joint measured"), "", field).changed() {
            reading.joint = usize::try_from(joint).map_or(0, |joint| joint.saturating_sub(1));
        }
    }
    own_options(ui, kind, reading);
}

/// So many options of a format are shown at once.
const FEW_OPTIONS: usize = 2;

/// What only this format can be told.
fn own_options(ui: &mut Ui, kind: Option<&Importer>, reading: &mut Reading) {
    let own = kind.map_or(&[][..], |importer| importer.options).iter();
    // Where there are such angles they are asked about.
    let own = own.filter(|option| option.name != EULER || reading.options.contains_key(EULER));
    let own: Vec<&OwnOption> = own.collect();
    // Of several few are needed: below them the columns, which always are, would be out of sight.
    if own.len() > FEW_OPTIONS {
        widgets::folded(
            ui,
            say!("More options of this kind of file"),
            size::SMALL,
            |ui| {
                for option in own {
                    own_option(ui, option, &mut reading.options);
                }
            },
        );
    } else {
        for option in own {
            own_option(ui, option, &mut reading.options);
        }
    }
}

/// An option that only this format has.
fn own_option(ui: &mut Ui, option: &OwnOption, given: &mut BTreeMap<&'static str, String>) {
    let (title, help) = (spoken(option.title), spoken(option.help));
    widgets::form_row(ui, &title, |ui| {
        let mut value = given.get(option.name).cloned().unwrap_or_default();
        let before = value.clone();
        if option.values.is_empty() {
            let field = TextEdit::singleline(&mut value).desired_width(OPTION);
            let field = ui.add(if help_fits(ui, &help) {
                field.hint_text(help.as_str())
            } else {
                field
            });
            widgets::label(&field, title.as_str());
        } else {
            let ways: Vec<(&str, &str)> = option.values.iter().map(|v| (*v, *v)).collect();
            let said = option.values.iter().copied().find(|v| *v == value);
            if let Some(chosen) = widgets::segmented(ui, &ways, said.unwrap_or_default()) {
                chosen.clone_into(&mut value);
            }
        }
        if value.trim().is_empty() {
            given.remove(option.name);
        } else if value != before {
            given.insert(option.name, value);
        }
    });
    // What has no room in the field stands below it.
    if option.values.is_empty() && !help_fits(ui, &help) {
        widgets::hint(ui, help);
    }
}

/// Width of the field of an option, points.
const OPTION: f32 = 300.0;

/// Whether what an option takes can be said within its field.
fn help_fits(ui: &Ui, help: &str) -> bool {
    let body = egui::TextStyle::Body.resolve(ui.style());
    widgets::width_of(ui, help, body) + 2.0 * space::ROW <= OPTION
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Header {
    Found,
    None,
    Line,
}

/// Where the header is: as it was found, nowhere, or in a line.
fn header(ui: &mut Ui, found: Option<u64>, header: &mut Option<u64>) {
    let now = match header {
        None => Header::Found,
        Some(0) => Header::None,
        Some(_) => Header::Line,
    };
    let ways = [
        (Header::Found, say!("as found")),
        (Header::None, say!("none")),
        (Header::Line, say!("in line")),
    ];
    if let Some(chosen) = widgets::segmented(ui, &ways, now) {
        *header = match chosen {
            Header::Found => None,
            Header::None => Some(0),
            Header::Line => Some(found.unwrap_or(1)),
        };
    }
    if let Some(line @ 1..) = header {
        let field = DragValue::new(line).range(1..=1_000_000);
        widgets::cell_number(ui, say!("Line of the header"), "", 64.0, field);
    }
}

/// Rigid bodies or markers to take.
fn names(ui: &mut Ui, offered: &[String], taken: &mut Vec<String>) {
    widgets::form_row(ui, say!("Take"), |ui| {
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
pub(super) fn questions(ui: &mut Ui, now: &ImportDraft, next: &mut ImportAnswers) {
    for question in &now.seen.inspection.questions {
        widgets::card(ui, |ui| ask(ui, question, next));
    }
}

fn ask(ui: &mut Ui, question: &Question, next: &mut ImportAnswers) {
    let palette = Palette::of(ui);
    let says = RichText::new(in_the_sheets_words(&spoken(&question.text))).color(palette.warning);
    ui.add(egui::Label::new(says).wrap());
    if question.answers.is_empty() {
        widgets::hint(ui, say!("Choose it in the table above"));
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for answer in &question.answers {
            if ui.button(say!("It is {answer}", answer)).clicked() {
                answered(next, question.about, answer);
            }
        }
    });
}

fn answered(next: &mut ImportAnswers, about: About, answer: &str) {
    let reading = &mut next.reading;
    match about {
        About::Unit => reading.unit = LengthUnit::of(answer),
        About::AngleUnit => reading.angle_unit = AngleUnit::of(answer),
        About::TimeUnit => reading.time_unit = TimeUnit::of(answer),
        About::Decimal => {
            reading.decimal = Some(if answer == "," {
                Decimal::Comma
            } else {
                Decimal::Point
            });
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
pub(super) fn commanded(
    ui: &mut Ui,
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Commanded positions, if the table does not have them");
    let field = (
        say!("File of the commands"),
        say!("a table with q1_deg, … and perhaps name, time_s, dir1, load_kg"),
    );
    widgets::section(ui, title);
    let which = (Companion::Commands, now);
    path(ui, field, &mut next.commands, which, workbench);
    if next.commands.trim().is_empty() {
        return;
    }
    let ways = [
        (Some(Matching::Order), say!("by order")),
        (Some(Matching::Name), say!("by name")),
        (Some(Matching::Time), say!("by time")),
    ];
    // By default as the import has found it, once it could be tried.
    let tried = now.trial().and_then(|trial| trial.matched.as_ref());
    let found = tried.map(|matched| matched.by);
    let matching = next.matching.or(found);
    widgets::form_row(ui, say!("Matched"), |ui| {
        if let Some(chosen) = widgets::segmented(ui, &ways, matching) {
            next.matching = chosen;
        }
    });
    if next.matching != Some(Matching::Time) {
        return;
    }
    let trial = now.trial();
    let clock = trial.and_then(|t| t.matched.as_ref()?.clock);
    widgets::form_row(ui, say!("Clocks apart by"), |ui| {
        let found = next.clock_offset_s.is_none();
        let ways = [
            (true, say!("found from the motion")),
            (false, say!("typed")),
        ];
        if let Some(found) = widgets::segmented(ui, &ways, found) {
            next.clock_offset_s = (!found).then(|| clock.map_or(0.0, |clock| clock.offset_s));
        }
        if let Some(offset) = &mut next.clock_offset_s {
            let field = DragValue::new(offset)
                .speed(0.01)
                .max_decimals(6)
                .suffix(" s");
            widgets::cell_number(
                ui,
                say!("Seconds to add to a measured time"),
                "s",
                110.0,
                field,
            );
        }
    });
    if let Some(clock) = clock {
        let says = match clock.sigma_s {
            Some(sigma) => say!(
                "The measured clock needs {offset_s} s to agree with the commands, ± {sigma} s (95 %); {rms} are left",
                offset_s = format!("{:+.4}", clock.offset_s),
                sigma = format!("{:.4}", 1.96 * sigma),
                rms = language::spoken(length(clock.rms_mm, 3))
            ),
            None => say!(
                "With {offset_s} s added, {rms} are left between path and measurements",
                offset_s = format!("{:+.4}", clock.offset_s),
                rms = language::spoken(length(clock.rms_mm, 3))
            ),
        };
        widgets::hint(ui, says);
    }
}

/// Whether the rows say from where each joint came.
pub(super) fn order_of_rows(ui: &mut Ui, next: &mut ImportAnswers) {
    if next.matching != Some(Matching::Time) {
        ui.checkbox(
            &mut next.in_measuring_order,
            say!("the rows are in the order in which they were measured"),
        )
        .on_hover_text(say!(
            "The side from which each joint came follows from the row before, so that backlash can be tested"
        ));
    }
}

/// Points that bring the instrument's frame into the base frame.
pub(super) fn base_frame(
    ui: &mut Ui,
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Reference points (base frame), if the instrument has a frame of its own");
    let field = (
        say!("File of the known points"),
        say!("a table with name, x_mm, y_mm, z_mm; the same names as in the measured file"),
    );
    widgets::section(ui, title);
    let which = (Companion::Reference, now);
    path(ui, field, &mut next.reference, which, workbench);
    if next.reference.trim().is_empty() {
        return;
    }
    ui.checkbox(&mut next.scale, say!("fit a scale too"));
    let trial = now.trial();
    if let Some(alignment) = trial.and_then(|trial| trial.alignment.as_ref()) {
        residuals(ui, alignment);
    }
}

/// How far each point is off after the alignment.
fn residuals(ui: &mut Ui, alignment: &Alignment) {
    let palette = Palette::of(ui);
    let left_out = alignment.outliers().count();
    let used = alignment.residuals.len() - left_out;
    let rms = language::spoken(length(alignment.rms_mm, 4));
    let says = if left_out > 0 {
        say!(
            "{used} points fit with {rms} (root mean square), {left_out} excluded: measured or surveyed wrongly, or moved since",
            used,
            rms,
            left_out
        )
    } else {
        say!("{used} points fit with {rms} (root mean square)", used, rms)
    };
    widgets::hint(ui, says);
    if (alignment.scale - 1.0).abs() > 0.0 {
        let ppm = 1e6 * (alignment.scale - 1.0);
        widgets::hint(
            ui,
            say!(
                "scaled by {scale} ({ppm} ppm)",
                scale = format!("{:.6}", alignment.scale),
                ppm = format!("{ppm:+.1}")
            ),
        );
    }
    ui.scope(|ui| {
        widgets::dense(ui);
        let grid = Grid::new("residuals of the alignment").striped(true);
        grid.spacing([18.0, 2.0]).show(ui, |ui| {
            for heading in [
                say!("point"),
                say!("residual, mm"),
                say!("in x"),
                say!("in y"),
                say!("in z"),
                "",
            ] {
                ui.label(RichText::new(heading).font(strong(size::SMALL)));
            }
            ui.end_row();
            for residual in alignment.residuals.iter().take(60) {
                let color = if residual.is_outlier {
                    palette.outside
                } else {
                    palette.text
                };
                let v = residual.vector_mm;
                let cell = |text: String| RichText::new(text).size(size::SMALL).color(color);
                ui.label(cell(residual.name.clone()));
                ui.label(cell(format!("{:.4}", v.norm())));
                for part in [v.x, v.y, v.z] {
                    ui.label(cell(format!("{part:+.4}")));
                }
                let word = if residual.is_outlier {
                    say!("excluded")
                } else {
                    ""
                };
                ui.label(cell(word.to_owned()));
                ui.end_row();
            }
        });
    });
}

/// Where the reflectors sit.
pub(super) fn reflectors(
    ui: &mut Ui,
    open: &[Target],
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Reflectors in the tool frame, if there are several");
    let field = (
        say!("File of the reflectors"),
        say!("a table with name, x_mm, y_mm, z_mm; without it one sits at the tool's origin"),
    );
    widgets::section(ui, title);
    let which = (Companion::Targets, now);
    path(ui, field, &mut next.targets, which, workbench);
    if open.len() > 1 && next.targets.trim().is_empty() {
        let names: Vec<&str> = open.iter().map(|target| &*target.name).collect();
        let text = say!(
            "those of the open session: {names}",
            names = names.join(", ")
        );
        let mut taken = next.own_targets.is_some();
        if ui.checkbox(&mut taken, text).changed() {
            next.own_targets = taken.then(|| open.to_vec());
        }
    } else {
        next.own_targets = None;
    }
}

/// A field for the path of a file, with a button that asks for it.
pub(super) fn path(
    ui: &mut Ui,
    (label, hint): (&str, &str),
    typed: &mut String,
    (which, now): (Companion, &ImportDraft),
    workbench: &Workbench,
) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        let text = egui::WidgetText::from(say!("Choose…"));
        let text = text.into_galley(ui, None, f32::INFINITY, egui::TextStyle::Button);
        let button = text.size().x + 2.0 * ui.spacing().button_padding.x;
        let room = ui.available_width() - button - ui.spacing().item_spacing.x;
        let field = TextEdit::singleline(typed).hint_text(hint);
        let field = ui.add_sized([room.max(80.0), space::CONTROL], field);
        widgets::label(&field, label);
        changed = field.changed();
        let button = ui.button(say!("Choose…"));
        widgets::label(&button, say!("Choose: {label}", label));
        button.does(workbench, move |bench| bench.choose_beside(which));
    });
    if !typed.trim().is_empty() {
        let is_this = |(of, path): &&(Companion, PathBuf)| {
            *of == which && path.as_path() == Path::new(typed.as_str())
        };
        if now.taken.iter().any(|one| is_this(&one)) {
            let says = say!("Taken because its name is that of the file");
            widgets::hint(ui, says);
        }
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        for path in now.neighbours.suiting(which) {
            let file = name_of(path);
            let text = say!("Use {file} from the same folder", file);
            let link = ui.link(RichText::new(text).size(size::SMALL));
            widgets::label(&link, say!("Use {file}: {label}", file, label));
            if link.clicked() {
                *typed = path.display().to_string();
                changed = true;
            }
        }
    });
    changed
}
