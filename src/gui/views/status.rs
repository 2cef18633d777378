//! The bar at the bottom: where the work stands, and what runs in the background.

use egui::{Align, Layout, RichText, Spinner, Ui};

use crate::diagnosis::FloorFrom;
use crate::fonts;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Letters, Task, Workbench};
use crate::language::spoken;
use crate::present::numbers::grouped;
use crate::recorder::live::State;

/// Where the work stands, in one line.
fn line(workbench: &Workbench) -> String {
    let loaded_session = workbench.loaded_session();
    if loaded_session.is_empty() {
        return say!(
            "model of {robot} · open a session measured on this robot to see what the model does",
            robot = loaded_session.session.robot.name
        );
    }
    let units = workbench.units();
    let samples =
        say!(one "{count} sample", "{count} samples", count = grouped(loaded_session.len()));
    let unit = units.length_name();
    let mm = |mm: f64| units.length_number(mm);
    let gap = match (workbench.answer(), &loaded_session.gap_before) {
        (Some(answer), _) => {
            let gap = &answer.identification.gap;
            let mut gaps = vec![gap.before.rms_mm];
            // What the identification left, where effects were added to it since.
            let added = workbench.document().in_the_model().next().is_some();
            gaps.extend(
                workbench
                    .diagnosis()
                    .filter(|_| added)
                    .map(|d| d.gap.identified_mm),
            );
            gaps.push(gap.after.rms_mm);
            let gaps: Vec<String> = gaps.into_iter().map(mm).collect();
            say!(
                "RMS error {gaps} {unit}",
                gaps = gaps.join(" → "),
                unit = unit
            )
        }
        (None, Some(gap)) => say!("RMS error {rms} {unit}", rms = mm(gap.rms_mm), unit = unit),
        (None, None) => say!("no sample can be used").to_owned(),
    };
    let floor = match (workbench.diagnosis(), loaded_session.coverage.floor_mm) {
        (Some(d), _) => Some((d.floor.mm, floor_from(d.floor.from))),
        (None, Some(mm)) => Some((mm, say!("instrument"))),
        (None, None) => None,
    };
    let floor = floor.map_or_else(String::new, |(floor_mm, from)| {
        let floor = say!(
            "floor {floor} {unit} ({from})",
            floor = mm(floor_mm),
            unit = unit,
            from = from
        );
        format!(" · {floor}")
    });
    format!("{samples} · {gap}{floor}")
}

/// Where a noise floor comes from, in a word.
fn floor_from(from: FloorFrom) -> &'static str {
    match from {
        FloorFrom::Repeats => say!("repeats"),
        FloorFrom::Instrument => say!("instrument"),
        FloorFrom::Estimated => say!("estimated"),
    }
}

/// What there is to say while nothing runs.
fn idle(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let small = |text: String| RichText::new(text).size(size::NOTE);
    if workbench.is_declined() {
        if ui.small_button(say!("Identify again")).clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        ui.label(small(say!("the identification was cancelled").to_owned()).color(palette.warning));
    } else if let Some(came) = workbench.following() {
        if ui.small_button(say!("Stop following")).clicked() {
            commands.push(Command::Follow(false));
        }
        let says = say!("following the file · {came} new", came = came);
        ui.label(small(says).color(palette.accent));
    } else if !workbench.characters().unshown.is_empty() {
        if ui.small_button(say!("Understood")).clicked() {
            commands.push(Command::Letters(Letters::Dismiss));
        }
        let says = spoken(fonts::cannot_be_shown(&workbench.characters().unshown));
        let says = small(says).color(palette.warning);
        ui.add(egui::Label::new(says).truncate());
    }
}

/// What is recorded from an instrument, where something is; it counts more than what runs besides.
fn recording(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) -> bool {
    let Some((_, heard)) = workbench.recording() else {
        return false;
    };
    let palette = Palette::of(ui);
    if ui.small_button(say!("Stop recording")).clicked() {
        commands.push(Command::Stop(Task::Recording));
    }
    let color = match heard.state {
        State::Waiting(_) => palette.warning,
        _ => palette.accent,
    };
    let says = RichText::new(heard.describe())
        .size(size::NOTE)
        .color(color);
    let label = ui.add(egui::Label::new(says).truncate());
    if let Some(last) = heard.last_refused() {
        label.on_hover_text(last);
    }
    true
}

/// Room for what runs in the background, points.
const BUSY: f32 = 420.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    ui.horizontal_centered(|ui| {
        let status = line(workbench);
        // What runs has its place at the right whatever is said at the left.
        let busy = workbench.jobs().newest().is_some() || workbench.recording().is_some();
        let room = ui.available_width() - if busy { BUSY } else { 0.0 };
        let line = egui::Label::new(RichText::new(&status).size(size::NOTE)).truncate();
        let high = ui.available_height();
        let left = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(room, high), left, |ui| ui.add(line));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if recording(ui, workbench, commands) {
                return;
            }
            let Some(task) = workbench.jobs().newest() else {
                return idle(ui, workbench, commands);
            };
            if ui.small_button(say!("Cancel")).clicked() {
                commands.push(Command::Stop(Task::Newest));
            }
            let what = RichText::new(task.describe());
            ui.label(what.size(size::NOTE).color(palette.muted));
            match task.progress() {
                Some(part) => {
                    let bar = egui::ProgressBar::new(part).desired_width(120.0);
                    ui.add(bar.desired_height(8.0).fill(palette.accent));
                    widgets::look_again_soon(ui);
                }
                None => {
                    ui.add(Spinner::new().size(14.0).color(palette.accent));
                }
            }
        });
    });
}
