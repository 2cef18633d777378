//! Step 5: what the controller needs, seen before it is saved.

use egui::{DragValue, RichText, ScrollArea, Ui};

use crate::explain::{self, Block, Detail, Exported, Section, Topic};
use crate::export::{EXPORTERS, find};
use crate::gui::cache::{ExportPreview, StandardsFigures};
use crate::gui::core::document::ExportChoice;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{About, Sheet, Step, What};
use crate::gui::views::blocks;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::language::spoken;

use super::blocks::in_words;

/// Where an own step begins, degrees or mm.
const FIRST_STEP: f64 = 1.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() {
        widgets::hint(
            ui,
            say!("There is nothing to export yet: the table comes from the identified robot"),
        );
    } else {
        not_added(ui, workbench);
        export(ui, workbench);
        targets(ui, workbench);
    }
    reports(ui, workbench);
}

/// Found effects that the table would leave uncorrected.
fn not_added(ui: &mut Ui, workbench: &Workbench) {
    let missing = workbench.not_added();
    if missing.is_empty() {
        return;
    }
    let names = missing.iter().map(|term| {
        let about = term.effect.about();
        let joint = about.per_joint.then_some(term.joint + 1);
        in_words(about.id, joint, workbench)
    });
    let names = names.collect::<Vec<_>>().join("; ");
    let says = say!(
        "Found, but not in the model, so not corrected: {names}",
        names
    );
    ui.label(RichText::new(says).color(Palette::of(ui).warning));
    if widgets::secondary(ui, &blocks::add_all(missing.len())).clicked() {
        workbench.then(move |bench| bench.add(&missing));
    }
}

/// The report: of the session, and of the model that is exported.
fn reports(ui: &mut Ui, workbench: &Workbench) {
    let measured = !workbench.loaded_session().is_empty();
    let identified = workbench.answer().is_some();
    if !measured && !identified {
        return;
    }
    widgets::section(ui, say!("Report"));
    let report = |ui: &mut Ui, text: &str, about| {
        if widgets::secondary(ui, text).clicked() {
            let what = What::Report(about);
            workbench.then(move |bench| bench.choose_where_to_export(what));
        }
    };
    if measured {
        widgets::secondary(ui, say!("Report details…"))
            .does(workbench, |bench| bench.show_sheet(Some(Sheet::DETAILS)));
        report(ui, say!("Report…"), About::Session);
        let says = if workbench.diagnosis().is_some() {
            say!("HTML or PDF: what was measured, the effects found, the open points")
        } else {
            say!("HTML or PDF: the session is diagnosed first, which takes a while")
        };
        widgets::hint(ui, says);
    }
    if identified {
        let text = if measured {
            say!("Report of the model…")
        } else {
            say!("Report…")
        };
        report(ui, text, About::Model);
    }
}

fn export(ui: &mut Ui, workbench: &Workbench) {
    let choice = workbench.document().export;
    widgets::section(ui, say!("Format"));
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let robot = &workbench.loaded_session().session.robot;
        for format in EXPORTERS.iter().filter(|format| (format.suits)(robot)) {
            let response = ui.radio(format.id == choice.format, spoken(format.title));
            if response.clicked() && format.id != choice.format {
                workbench.then(move |bench| {
                    bench.choose_export(ExportChoice {
                        format: format.id,
                        ..choice
                    });
                });
            }
        }
    });
    // A description of the robot is about all joints and has no steps.
    if find(choice.format).is_some_and(|format| format.rules.is_some()) {
        widgets::section(ui, say!("Table"));
        joint_and_step(ui, workbench, choice);
    }
    match workbench.export() {
        None if workbench.is_unprepared() => {
            widgets::hint(ui, say!("The preparation of the table was cancelled"));
            widgets::secondary(ui, say!("Prepare the table"))
                .does(workbench, Workbench::prepare_again);
        }
        None => widgets::hint(ui, say!("The table is being prepared")),
        Some(Err(because)) => {
            let color = Palette::of(ui).outside;
            ui.label(RichText::new(because).color(color));
            if is_refused_for_an_arm(workbench) {
                widgets::hint(
                    ui,
                    say!(
                        "Corrected targets and programs take all of the model: “Compensate…” below, or choose another format"
                    ),
                );
            } else {
                // What the format cannot hold is switched off here, or left out of the fit.
                super::gap::switches(ui, workbench);
                widgets::secondary(ui, say!("Go to identify"))
                    .does(workbench, move |bench| bench.view.step = Step::Identify);
            }
        }
        Some(Ok(made)) => {
            if let Some(table) = &made.export.reads_as {
                let entries = table.forward.places().len();
                widgets::fact_of(ui, phrase!("entries"), entries.to_string());
            }
            widgets::section(ui, say!("Also"));
            let what = if made.export.reads_as.is_some() {
                say!("Copy table")
            } else {
                say!("Copy text")
            };
            if widgets::secondary(ui, what).clicked() {
                ui.copy_text(text_of(made));
            }
            widgets::secondary(ui, say!("Save model…")).does(workbench, move |bench| {
                bench.choose_where_to_export(What::Model);
            });
        }
    }
}

fn joint_and_step(ui: &mut Ui, workbench: &Workbench, choice: ExportChoice) {
    let joints = &workbench.loaded_session().session.robot.joints;
    let mut next = choice;
    if joints.len() > 1 {
        let mut joint = choice.joint + 1;
        let field = DragValue::new(&mut joint).range(1..=joints.len());
        widgets::number(ui, say!("joint"), "", field);
        next.joint = joint - 1;
    }
    let unit = joints[choice.joint].kind.sign();
    let mut own = choice.step.is_some();
    if ui.checkbox(&mut own, say!("Custom step")).changed() {
        next.step = own.then_some(FIRST_STEP);
    }
    if let Some(step) = &mut next.step {
        let field = DragValue::new(step)
            .range(0.001..=90.0)
            .speed(0.02)
            .max_decimals(4)
            .suffix(unit);
        widgets::number(ui, say!("step"), unit.trim(), field);
    }
    if next != choice {
        workbench.then(move |bench| bench.choose_export(next));
    }
}

/// The table as the controller gets it.
fn text_of(made: &ExportPreview) -> String {
    let first = made.export.documents.first();
    first.map_or_else(String::new, |document| {
        String::from_utf8_lossy(&document.bytes).into_owned()
    })
}

/// What the export does and what it is: the right-hand side in this step.
pub(crate) fn preview(ui: &mut Ui, workbench: &Workbench) {
    match workbench.export() {
        Some(Ok(made)) => made_preview(ui, workbench, made),
        // Why stands at the left, beside what can be done instead.
        Some(Err(_)) => widgets::hint(ui, say!("No preview: this export is refused")),
        None if workbench.answer().is_none() => super::coverage::show(ui, workbench),
        None if workbench.is_unprepared() => {
            widgets::hint(ui, say!("The preparation of the table was cancelled"));
        }
        None => widgets::hint(ui, say!("The table is being prepared")),
    }
    standards(ui, workbench);
}

fn made_preview(ui: &mut Ui, workbench: &Workbench, made: &ExportPreview) {
    let measured = !workbench.loaded_session().is_empty();
    let identified = workbench.answer().filter(|_| measured);
    let exported = Exported {
        export: &made.export,
        error: made.error,
        nominal: workbench.loaded_session().gap_before,
        identified_mm: identified.map(|answer| answer.identification.gap.after.rms_mm),
        remainder: Some(&made.remainder),
    };
    let sections = explain::table(&exported, Detail::window(workbench.units()));
    let (answer, more): (Vec<Section>, Vec<Section>) = sections
        .into_iter()
        .partition(|section| section.topic == Topic::Answer);
    for section in answer {
        widgets::card(ui, |ui| leaves(ui, &section));
    }
    widgets::card(ui, |ui| {
        let name = made
            .export
            .documents
            .first()
            .map_or("", |d| d.name.as_str());
        widgets::bold(ui, name);
        // What the sign means stands with the numbers, the rest on demand.
        if let Some(Block::List(lines)) = more.first().and_then(|section| section.blocks.first()) {
            blocks::show(ui, &[Block::List(lines[..1].to_vec())]);
        }
        text(ui, &text_of(made));
        for section in &more {
            widgets::folded(ui, &section.title, size::SMALL, |ui| {
                blocks::show(ui, &section.blocks);
            });
        }
    });
}

/// The figure that counts is large, the others are below it.
fn leaves(ui: &mut Ui, section: &Section) {
    let palette = Palette::of(ui);
    ui.label(RichText::new(&section.title).color(palette.muted));
    let [Block::Facts(facts), rest @ ..] = &section.blocks[..] else {
        return blocks::show(ui, &section.blocks);
    };
    if let Some((_, left)) = facts.first() {
        let left = RichText::new(left).font(strong(size::DISPLAY));
        ui.label(left.color(palette.after));
    }
    blocks::show(ui, &[Block::Facts(facts[1..].to_vec())]);
    blocks::show(ui, rest);
}

/// The first lines; a table may have a million.
fn text(ui: &mut Ui, text: &str) {
    const MOST: usize = 200;
    const HIGH: f32 = 340.0;
    ui.spacing_mut().item_spacing.y = 1.0;
    let lines: Vec<&str> = text.lines().take(MOST).collect();
    ScrollArea::both()
        .id_salt("table as text")
        .max_height(HIGH)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
            for line in &lines {
                ui.label(RichText::new(*line).monospace());
            }
        });
    let more = text.lines().count().saturating_sub(lines.len());
    if more > 0 {
        ui.add_space(space::TIGHT);
        widgets::hint(
            ui,
            say!(one "and {count} more line", "and {count} more lines", count = more),
        );
    }
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() {
        widgets::primary(ui, say!("Go to identify"))
            .does(workbench, move |bench| bench.view.step = Step::Identify);
        return;
    }
    let format = find(workbench.document().export.format);
    let title = format.map_or(say!("table"), |f| f.extension);
    let says = if format.is_some_and(|f| f.rules.is_none()) {
        say!("Save robot as .{title}…", title)
    } else {
        say!("Save table as .{title}…", title)
    };
    let ready = matches!(workbench.export(), Some(Ok(_))) || workbench.is_unprepared();
    if is_refused_for_an_arm(workbench) {
        widgets::primary(ui, say!("Compensate…")).does(workbench, Workbench::choose_targets);
        return;
    }
    let save = ui.add_enabled_ui(ready, |ui| widgets::primary(ui, &says));
    save.inner.does(workbench, move |bench| {
        bench.choose_where_to_export(What::Table);
    });
}

/// Whether what was chosen cannot hold the model of a robot with several joints: corrected targets can.
fn is_refused_for_an_arm(workbench: &Workbench) -> bool {
    let joints = &workbench.loaded_session().session.robot.joints;
    joints.len() > 1 && matches!(workbench.export(), Some(Err(_)))
}

/// Targets and programs: what is corrected where the controller takes no table.
fn targets(ui: &mut Ui, workbench: &Workbench) {
    widgets::section(ui, say!("Targets and programs"));
    // One button of a name: where nothing else is ready it is the main one.
    if !is_refused_for_an_arm(workbench) && widgets::secondary(ui, say!("Compensate…")).clicked()
    {
        workbench.then(Workbench::choose_targets);
    }
    widgets::hint(
        ui,
        say!(
            "A table of targets (CSV), RAPID, KRL, URScript or FANUC LS: its targets are corrected in place, and what changes is shown before anything is saved"
        ),
    );
}

/// Accuracy and repeatability as the standards state them, before and after, where there is something measured.
fn standards(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() || workbench.loaded_session().is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        widgets::bold(ui, say!("Accuracy and repeatability"));
        match workbench.figures() {
            None => widgets::hint(ui, say!("The figures are being computed")),
            Some(Err(because)) => widgets::hint(ui, because),
            Some(Ok(made)) => tables(ui, made),
        }
    });
}

fn tables(ui: &mut Ui, made: &StandardsFigures) {
    let sections = explain::standards(&made.standards, 1);
    let tables = || sections.iter().flat_map(|section| &section.blocks);
    let table = |block: &Block| match block {
        Block::Table(table) => Some(table.tabbed()),
        _ => None,
    };
    if tables().any(|block| table(block).is_some()) {
        blocks::button(ui, say!("figures"), || tables().filter_map(table).collect());
    }
    for section in &sections {
        widgets::section(ui, &section.title);
        ui.push_id(&section.title, |ui| blocks::show(ui, &section.blocks));
    }
}
