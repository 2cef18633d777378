//! Step 1: what was measured, on what, and what was found while it was read.

use std::path::PathBuf;

use egui::{Align, DragValue, Layout, Response, RichText, TextEdit, Ui};

use crate::diagnostic::{Diagnostic, Severity};
use crate::gui::actions;
use crate::gui::core::disk::name_of;
use crate::gui::core::quantity::joint_value;
use crate::gui::core::setup::SetupForm;
use crate::gui::import_draft::in_the_windows_words;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Sheet, Step};
use crate::gui::widgets::{self, Buttons, Does, Forms, Words, or_none};
use crate::gui::workbench::Workbench;
use crate::language;
use crate::present::numbers::grouped;
use crate::present::units::LengthUnit;
use crate::sessions::Sigma;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    ui.section(say!("Measured"));
    facts(ui, workbench);
    tolerance(ui, workbench, Ui::number);
    if ui
        .secondary(&widgets::dots(say!("Robot and instrument")))
        .clicked()
    {
        let form = SetupForm::of(&workbench.loaded_session().session);
        workbench.then(move |bench| bench.show_sheet(Some(Sheet::set_up(form))));
    }
    findings(ui, workbench);
    ui.section(say!("Another session or model"));
    actions::OPEN.button(ui, workbench);
    path_field(ui, workbench);
    actions::NEW.button(ui, workbench);
    actions::ROBOTS.button(ui, workbench);
    recent(ui, workbench);
}

/// Files that were opened before, newest first.
fn recent(ui: &mut Ui, workbench: &Workbench) {
    const MOST: usize = 5;
    let recent: Vec<_> = workbench.recent().take(MOST).collect();
    if recent.is_empty() {
        return;
    }
    ui.section(say!("Recent files"));
    ui.spacing_mut().item_spacing.y = space::TIGHT;
    for path in recent {
        let link = ui.link(name_of(path).as_ref());
        let link = link.on_hover_text(path.display().to_string());
        let path = path.clone();
        link.does(workbench, |bench| bench.open_file(path));
    }
}

fn facts(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    let session = &loaded_session.session;
    let (units, joints) = (workbench.units(), &session.robot.joints);
    ui.fact(say!("robot"), &session.robot.name);
    if let [joint] = joints.as_slice() {
        let (from, to) = loaded_session.travel();
        let [from, to] = [from, to].map(|q| joint_value(units, joint.kind, q));
        let says = format!("{}, {from} … {to}", joint.name);
        ui.fact(say!("joint"), says);
    } else {
        ui.fact(say!("joints"), joints.len().to_string());
    }
    if loaded_session.is_empty() {
        ui.fact(say!("samples"), "0");
        return;
    }
    let mut samples = grouped(loaded_session.len());
    for (n, what) in [
        (loaded_session.overview.held_out, say!("held out")),
        (loaded_session.overview.excluded, say!("excluded")),
    ] {
        if n > 0 {
            samples += &format!(", {} {what}", grouped(n));
        }
    }
    ui.fact(say!("samples"), samples);
    if let Some(kinds) = &loaded_session.overview.kinds {
        ui.fact(say!("measured"), language::spoken(kinds));
    }
    if session.targets.len() > 1 {
        ui.fact(say!("reflectors"), session.targets.len().to_string());
    }
    if !session.instrument.name.is_empty() {
        ui.fact(say!("instrument"), &session.instrument.name);
    }
    let sigma = match session.instrument.sigma_mm {
        None => "–".to_owned(),
        Some(Sigma::Overall(sigma)) => units.length(sigma),
        Some(Sigma::PerAxis([x, y, z])) => units.length(((x * x + y * y + z * z) / 3.0).sqrt()),
    };
    ui.fact(say!("noise, one σ"), sigma);
    if session.samples.z_mm.is_none() {
        ui.fact(say!("coordinates"), "x, y");
    }
    if session.compensated_by.is_some() {
        ui.fact(say!("compensated"), say!("yes: this shows what is left"));
    }
}

/// The tolerance, to be typed.
pub(crate) fn tolerance(
    ui: &mut Ui,
    workbench: &Workbench,
    shown: fn(&mut Ui, &str, &str, DragValue<'_>) -> Response,
) {
    // The largest that makes sense on any robot.
    const LARGEST_MM: f64 = 1000.0;
    let units = workbench.units();
    let one_mm = units.length_value(1.0);
    let unit = units.length_name();
    let now = one_mm * workbench.document().tolerance_mm.unwrap_or(0.0);
    let mut tolerance = now;
    let written = ui.style().number_formatter.clone();
    let field = DragValue::new(&mut tolerance)
        .range(0.0..=one_mm * LARGEST_MM)
        .speed(0.005 * one_mm)
        .max_decimals(match units.length {
            LengthUnit::Millimetre => 4,
            LengthUnit::Micrometre => 1,
            LengthUnit::Inch => 6,
        })
        .custom_formatter(|value, decimals| {
            let number = (value > 0.0).then(|| written.format(value, decimals));
            number.unwrap_or_else(|| say!("none").to_owned())
        })
        .suffix(if now > 0.0 {
            format!(" {unit}")
        } else {
            String::new()
        });
    let name = format!("{unit}{}", or_none());
    shown(ui, say!("tolerance"), &name, field);
    if tolerance != now {
        let tolerance = (tolerance > 0.0).then_some(tolerance / one_mm);
        workbench.edits(move |document| document.set_tolerance(tolerance));
    }
}

fn findings(ui: &mut Ui, workbench: &Workbench) {
    const MOST: usize = 50;
    let findings = &workbench.loaded_session().findings;
    if findings.is_empty() {
        return;
    }
    ui.section(&say!("Import log: {count}", count = findings.len()));
    ui.scope(|ui| {
        // Rows are as high as their text, the first of a finding too.
        ui.spacing_mut().interact_size.y = 0.0;
        // What was left out or assumed first.
        let mut sorted: Vec<&Diagnostic> = findings.iter().collect();
        sorted.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        for finding in sorted.into_iter().take(MOST) {
            finding_line(ui, finding, workbench);
        }
    });
    if findings.len() > MOST {
        ui.hint(say!("and {more} more", more = findings.len() - MOST));
    }
}

/// What was found, behind its kind: a word as well as a colour.
pub(crate) fn finding(ui: &mut Ui, severity: Severity, contents: impl FnOnce(&mut Ui)) {
    let palette = Palette::of(ui);
    let (mark, color) = match severity {
        Severity::Note => (say!("note"), palette.muted),
        Severity::Warning => (say!("warning"), palette.warning),
        Severity::Error => (say!("error"), palette.outside),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(mark).font(strong(size::SMALL)).color(color));
        contents(ui);
    });
}

fn finding_line(ui: &mut Ui, found: &Diagnostic, workbench: &Workbench) {
    finding(ui, found.severity, |ui| {
        let text = in_the_windows_words(&found.clone().without_folder());
        let text = RichText::new(text).small();
        if found.samples.is_empty() {
            ui.label(text);
            return;
        }
        let link = ui.link(text).on_hover_text(say!("Show these samples"));
        let samples = found.samples.clone();
        link.does(workbench, |bench| bench.view.mark(samples));
    });
}

/// A path can always be typed: not every system has a dialog.
fn path_field(ui: &mut Ui, workbench: &Workbench) {
    let id = ui.scope_id().with("typed path");
    let mut typed: String = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let room = egui::vec2(ui.available_width(), space::CONTROL);
    let from_the_right = Layout::right_to_left(Align::Center);
    ui.allocate_ui_with_layout(room, from_the_right, |ui| {
        let button = egui::Button::new(say!("Open"));
        let pressed = ui.add_enabled(!typed.trim().is_empty(), button).clicked();
        let field = TextEdit::singleline(&mut typed)
            .hint_text(say!("type a path"))
            .align(egui::Align2::LEFT_CENTER);
        let field = ui.add_sized(ui.available_size(), field);
        widgets::label(&field, say!("Path of a session or model"));
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        let path = typed.trim();
        if (entered || pressed) && !path.is_empty() {
            let path = PathBuf::from(path);
            workbench.then(move |bench| bench.open_file(path));
        }
    });
    ui.data_mut(|data| data.insert_temp(id, typed));
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    let step = if workbench.document().loaded_model.is_some() {
        Step::Export
    } else if loaded_session.single_revolute() {
        Step::Regions
    } else {
        Step::Identify
    };
    actions::go_on(ui, workbench, step);
}
