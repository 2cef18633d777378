//! Step 5: what the controller needs, seen before it is saved.

use egui::{Button, DragValue, RichText, ScrollArea, Ui};

use crate::explain::{self, Block, Detail, Exported, Section, Topic};
use crate::export::{EXPORTERS, Motors, Zeros, find};
use crate::gui::actions;
use crate::gui::cache::{ExportPreview, StandardsFigures};
use crate::gui::core::disk::name_of;
use crate::gui::core::document::ExportChoice;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{About, Step, What};
use crate::gui::views::{blocks, copies};
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::kinematics::DhConvention;
use crate::language::spoken;
use crate::text::capital;

use super::blocks::in_words;

/// Where an own step begins, degrees or mm.
const FIRST_STEP: f64 = 1.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() {
        ui.hint(say!("There is nothing to export yet"));
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
    let names = missing.iter().map(|term| in_words(term, workbench));
    let names = names.collect::<Vec<_>>().join("; ");
    let says = say!(
        "Found, but not in the model, so not corrected: {names}",
        names
    );
    ui.colored_label(Palette::of(ui).warning, says);
    let add = ui.secondary(&blocks::add_all(missing.len()));
    add.does(workbench, move |bench| bench.edit(|d| d.add(&missing)));
}

/// The report: of the session, and of the model that is exported.
fn reports(ui: &mut Ui, workbench: &Workbench) {
    let measured = !workbench.loaded_session().is_empty();
    let identified = workbench.answer().is_some();
    if !measured && !identified {
        return;
    }
    ui.section(say!("Report"));
    if measured {
        actions::REPORT_DETAILS.button(ui, workbench);
        actions::REPORT.button(ui, workbench);
        if workbench.diagnosis().is_none() {
            ui.hint(say!(
                "HTML or PDF: the session is diagnosed first, which takes a while"
            ));
        }
    }
    if identified {
        let what = What::Report(About::Model);
        let report = ui.secondary(&widgets::dots(say!("Report of the model")));
        report.does(workbench, move |bench| bench.choose_where_to_export(what));
    }
}

fn export(ui: &mut Ui, workbench: &Workbench) {
    let choice = &workbench.document().export;
    ui.section(say!("Format"));
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let robot = &workbench.loaded_session().session.robot;
        for format in EXPORTERS.iter().filter(|format| (format.suits)(robot)) {
            let response = ui.radio(format.id == choice.format, spoken(format.title));
            let format = format.id;
            if response.clicked() && format != choice.format {
                let choice = ExportChoice {
                    format,
                    ..choice.clone()
                };
                workbench.edits(move |document| document.choose_export(choice));
            }
        }
    });
    // A description of the robot is about all joints and has no steps.
    if find(choice.format).is_some_and(|format| format.rules.is_some()) {
        ui.section(&capital(say!("table")));
        joint_and_step(ui, workbench, choice);
    } else {
        of_the_robot(ui, workbench, choice);
    }
    match workbench.export() {
        None if workbench.is_unprepared() => {
            ui.hint(capital(say!("it was cancelled")));
            let again = ui.secondary(say!("Prepare the table"));
            again.does(workbench, Workbench::prepare_again);
        }
        None => ui.hint(say!("The table is being prepared")),
        Some(Err(because)) => {
            ui.colored_label(Palette::of(ui).outside, because);
            if is_refused_for_an_arm(workbench) {
                ui.hint(say!(
                    "Corrected targets and programs take all of the model: “Compensate…” below, or choose another format"
                ));
            } else {
                // What the format cannot hold is switched off here, or left out of the fit.
                super::gap::switches(ui, workbench);
                let back = ui.secondary(say!("Change the model"));
                back.does(workbench, |bench| bench.view.step = Step::Identify);
            }
        }
        Some(Ok(made)) => {
            if let Some(table) = &made.export.reads_as {
                let entries = table.forward.places().len();
                ui.fact(say!("entries"), entries.to_string());
            }
            ui.add_space(space::ROW);
            if ui.secondary(say!("Copy text")).clicked() {
                ui.copy_text(text_of(made));
            }
            actions::SAVE_MODEL.button(ui, workbench);
        }
    }
}

/// What a description of the robot is asked for: what of the model the file takes, and what the controller does.
fn of_the_robot(ui: &mut Ui, workbench: &Workbench, choice: &ExportChoice) {
    let Some(format) = find(choice.format) else {
        return;
    };
    let asked = format.asks(&workbench.loaded_session().session.robot);
    let mut next = choice.clone();
    if let Some(usual) = asked.zeros {
        let offered = [
            (Zeros::Origins, say!("origins")),
            (Zeros::Controller, say!("controller")),
        ];
        ui.weak(say!("zero offsets")).on_hover_text(say!(
            "Who takes the zero offsets of the joints of a corrected robot, the geometry of the file or the controller, never both"
        ));
        next.zeros = ui
            .segmented(&offered, choice.zeros.unwrap_or(usual))
            .or(next.zeros);
    }
    if let Some(usual) = asked.convention {
        let offered = [
            (DhConvention::Standard, say!("standard")),
            (DhConvention::Modified, say!("modified")),
        ];
        ui.weak(say!("Convention of DH rows"));
        let now = choice.convention.unwrap_or(usual);
        next.convention = ui.segmented(&offered, now).or(next.convention);
    }
    if asked.motors {
        ui.weak(say!("servos"));
        ui.choice(
            &Motors::ALL.map(|(name, motors)| (motors, name)),
            &mut next.motors,
        );
    }
    if asked.reference {
        ui.weak(say!("File that the export starts from")).on_hover_text(say!(
            "The URDF that the robot was read from, to be changed in place with its names and meshes; the motor calibration of lerobot that was active while measuring"
        ));
        if let Some(path) = &choice.reference {
            let name = name_of(path);
            let without = Button::new(format!("× {name}"));
            if ui.named(say!("Without {name}", name), without).clicked() {
                next.reference = None;
            }
        }
        let choose = ui.secondary(say!("Choose…"));
        choose.does(workbench, Workbench::choose_reference);
    }
    if next != *choice {
        workbench.edits(move |document| document.choose_export(next));
    }
}

fn joint_and_step(ui: &mut Ui, workbench: &Workbench, choice: &ExportChoice) {
    let joints = &workbench.loaded_session().session.robot.joints;
    let mut next = choice.clone();
    if joints.len() > 1 {
        let mut joint = choice.joint + 1;
        let field = DragValue::new(&mut joint).range(1..=joints.len());
        ui.number(say!("joint"), "", field);
        next.joint = joint - 1;
    }
    let unit = joints[choice.joint].kind.sign();
    let mut own = choice.step.is_some();
    if ui.checkbox(&mut own, say!("Custom step")).changed() {
        next.step = own.then_some(FIRST_STEP);
    }
    if let Some(step) = &mut next.step {
        let field = DragValue::new(step).range(0.001..=90.0).speed(0.02);
        let field = field.max_decimals(4).suffix(unit);
        ui.number(say!("step"), unit.trim(), field);
    }
    if next != *choice {
        workbench.edits(move |document| document.choose_export(next));
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
        None if workbench.answer().is_none() => super::results::beforehand(ui, workbench),
        None if !workbench.is_unprepared() => ui.hint(say!("The table is being prepared")),
        // Why there is none stands at the left, beside what can be done instead.
        _ => {}
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
        let first = made.export.documents.first();
        ui.bold(first.map_or("", |document| &document.name));
        // What the sign means stands with the numbers, the rest on demand.
        if let Some(Block::List(lines)) = more.first().and_then(|section| section.blocks.first()) {
            blocks::show(ui, &[Block::List(lines[..1].to_vec())]);
        }
        text(ui, &text_of(made));
        for section in &more {
            ui.folded(&section.title, |ui| blocks::show(ui, &section.blocks));
        }
    });
}

/// The figure that counts is large, the others are below it.
fn leaves(ui: &mut Ui, section: &Section) {
    ui.weak(&section.title);
    let [Block::Facts(facts), rest @ ..] = &section.blocks[..] else {
        return blocks::show(ui, &section.blocks);
    };
    if let Some((_, left)) = facts.first() {
        let left = RichText::new(left).font(strong(size::DISPLAY));
        ui.label(left.color(Palette::of(ui).after));
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
        ui.hint(say!(one "and {count} more line", "and {count} more lines", count = more));
    }
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() {
        return actions::go_on(ui, workbench, Step::Identify);
    }
    let format = find(workbench.document().export.format);
    let title = format.map_or(say!("table"), |f| f.extension);
    let says = say!("Save as .{title}…", title);
    let ready = matches!(workbench.export(), Some(Ok(_))) || workbench.is_unprepared();
    if is_refused_for_an_arm(workbench) {
        let compensate = ui.primary(say!("Compensate…"));
        return compensate.does(workbench, Workbench::choose_targets);
    }
    let save = ui.add_enabled_ui(ready, |ui| ui.primary(&says)).inner;
    save.does(workbench, |bench| bench.choose_where_to_export(What::Table));
}

/// Whether what was chosen cannot hold the model of a robot with several joints: corrected targets can.
fn is_refused_for_an_arm(workbench: &Workbench) -> bool {
    let joints = &workbench.loaded_session().session.robot.joints;
    joints.len() > 1 && matches!(workbench.export(), Some(Err(_)))
}

/// Targets and programs: what is corrected where the controller takes no table.
fn targets(ui: &mut Ui, workbench: &Workbench) {
    ui.section(say!("Targets and programs"));
    // One button of a name: where nothing else is ready it is the main one.
    if !is_refused_for_an_arm(workbench) && ui.secondary(say!("Compensate…")).clicked() {
        workbench.then(Workbench::choose_targets);
    }
    ui.hint(say!(
        "A table of targets (CSV), RAPID, KRL, URScript or FANUC LS: its targets are corrected in place, and what changes is shown before anything is saved"
    ));
}

/// Accuracy and repeatability as the standards state them, before and after, where there is something measured.
fn standards(ui: &mut Ui, workbench: &Workbench) {
    if workbench.answer().is_none() || workbench.loaded_session().is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        ui.bold(say!("Accuracy and repeatability"));
        match workbench.figures() {
            None => ui.hint(say!("Computing…")),
            Some(Err(because)) => ui.hint(because),
            Some(Ok(made)) => tables(ui, workbench, made),
        }
    });
}

fn tables(ui: &mut Ui, workbench: &Workbench, made: &StandardsFigures) {
    let sections = explain::standards(&made.standards, 1);
    let tables = || sections.iter().flat_map(|section| &section.blocks);
    let table = |block: &Block| match block {
        Block::Table(table) => Some(table.tabbed()),
        _ => None,
    };
    if tables().any(|block| table(block).is_some()) {
        copies::button(ui, workbench, say!("figures"), || {
            tables().filter_map(table).collect()
        });
    }
    for section in &sections {
        ui.section(&section.title);
        ui.push_id(&section.title, |ui| blocks::show(ui, &section.blocks));
    }
}
