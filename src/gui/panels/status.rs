//! The bar at the bottom: where the work stands, and what runs in the background.

use egui::{Align, Layout, RichText, Spinner, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::edit::Edit;
use crate::gui::tokens::{Palette, size};

/// Where the work stands, in one line.
pub(crate) fn line(workbench: &Workbench) -> String {
    let subject = workbench.subject();
    if subject.is_empty() {
        return format!(
            "model of {} · open a session measured on this robot to see what the model does",
            subject.session.robot.name
        );
    }
    let units = workbench.units();
    let count = subject.len();
    let samples = if count == 1 { "sample" } else { "samples" };
    let unit = units.length_name();
    let mm = |mm: f64| units.length_number(mm);
    let gap = match (workbench.answer(), &subject.gap_before) {
        (Some(answer), _) => {
            let gap = &answer.identification.gap;
            let (before, after) = (mm(gap.before.rms_mm), mm(gap.after.rms_mm));
            format!("gap {before} → {after} {unit}")
        }
        (None, Some(gap)) => format!("gap {} {unit}", mm(gap.rms_mm)),
        (None, None) => "no sample can be used".to_owned(),
    };
    format!("{count} {samples} · {gap}")
}

/// What there is to say while nothing runs.
fn idle(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let small = |text: String| RichText::new(text).size(size::SMALL + 0.5);
    if workbench.is_declined() {
        if ui.small_button("Identify again").clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        ui.label(small("the identification was cancelled".to_owned()).color(palette.warning));
    } else if let Some(came) = workbench.following() {
        if ui.small_button("Stop following").clicked() {
            commands.push(Command::Follow(false));
        }
        let says = format!("following the file · {came} new");
        ui.label(small(says).color(palette.accent));
    }
}

/// Shows the bar.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    ui.horizontal_centered(|ui| {
        ui.label(RichText::new(line(workbench)).size(size::SMALL + 0.5));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let Some(task) = workbench.tasks().newest() else {
                return idle(ui, workbench, commands);
            };
            if ui.small_button("Cancel").clicked() {
                commands.push(Command::Cancel);
            }
            let what = RichText::new(&task.what);
            ui.label(what.size(size::SMALL + 0.5).color(palette.muted));
            match task.progress() {
                Some(part) => {
                    let bar = egui::ProgressBar::new(part).desired_width(120.0);
                    ui.add(bar.desired_height(8.0).fill(palette.accent));
                }
                None => {
                    ui.add(Spinner::new().size(14.0).color(palette.accent));
                }
            }
        });
    });
}
