//! A table without a robot, to be made a session: what its columns are taken for stands over their
//! first rows, what is not known is asked, and nothing is guessed in silence. What the import would
//! bring stands at the end before it is done.

mod columns;
mod companion_file;
mod file;
mod parts;
mod robot;

use egui::text::LayoutJob;
use egui::{Align, FontId, Layout, ProgressBar, ScrollArea, Ui, vec2};

use crate::diagnostic::Severity;
use crate::gui::import_draft::{ImportAnswers, ImportDraft, LOOKING, Trial, in_the_sheets_words};
use crate::gui::jobs::Running;
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::views::blocks;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Task, Workbench};
use crate::language;
use crate::present::units::Units;
use crate::text::spoken;

/// Width of the sheet, points.
const WIDTH: f32 = 780.0;
/// What stands around the part that scrolls, points.
const AROUND: f32 = 228.0;
/// Two lines of what is in the way, points.
const FOOT: f32 = 34.0;

pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    now: &ImportDraft,
    commands: &mut Vec<Command>,
) {
    let window = ui.ctx().content_rect();
    ui.set_width(WIDTH.min(window.width() - 80.0));
    let name = now.path.file_name().unwrap_or_default().to_string_lossy();
    widgets::heading(ui, &say!("Import {name}", name = name));
    widgets::hint(ui, file::found_out(now));
    let mut next = now.answers.clone();
    let height = (window.height() - AROUND).max(200.0);
    let scrolled = ScrollArea::vertical().max_height(height).show(ui, |ui| {
        // Beside what scrolls, not over it.
        ui.set_width(ui.available_width() - f32::from(space::PANEL));
        file::show(ui, now, &mut next);
        columns::show(ui, now, &mut next, commands);
        file::questions(ui, now, &mut next);
        findings(ui, now);
        robot::show(ui, workbench, now, &mut next, commands);
        companion_file::commanded(ui, now, &mut next, commands);
        companion_file::base_frame(ui, now, &mut next, commands);
        companion_file::reflectors(ui, now, &mut next, commands);
        result(ui, now, workbench.units());
        widgets::focus_in_sight(ui);
        ui.max_rect().width()
    });
    let missing = if next == now.answers {
        now.missing()
    } else {
        Some(spoken(LOOKING).to_owned())
    };
    // Always as high: what is above keeps its place.
    let room = vec2(ui.available_width(), FOOT);
    ui.allocate_ui_with_layout(room, Layout::top_down(Align::Min), |ui| {
        ui.set_min_height(FOOT);
        foot(ui, workbench, (now, &next), missing.as_deref(), commands);
    });
    // They end where what is above them ends.
    let pressed = ui.scope(|ui| {
        ui.set_max_width(scrolled.inner);
        super::ends::buttons_without_enter(ui, say!("Import"), missing.is_none(), commands)
    });
    if pressed.inner {
        commands.push(Command::Import);
    } else if next != now.answers {
        commands.push(Command::Say(Box::new(next)));
    }
}

/// Where the look at the file stands, or what is in the way of the import.
fn foot(
    ui: &mut Ui,
    workbench: &Workbench,
    (now, next): (&ImportDraft, &ImportAnswers),
    missing: Option<&str>,
    commands: &mut Vec<Command>,
) {
    if let Some(running) = workbench.looking() {
        looking(ui, running, commands);
    } else if *next == now.answers && !now.is_up_to_date() {
        ui.horizontal(|ui| {
            widgets::hint(ui, say!("Looking at the file was cancelled"));
            if ui.button(say!("Look again")).clicked() {
                commands.push(Command::Say(Box::new(next.clone())));
            }
        });
    } else if let Some(missing) = missing {
        let font = FontId::proportional(size::NOTE);
        let muted = Palette::of(ui).muted;
        let mut job = LayoutJob::simple(missing.to_owned(), font, muted, ui.available_width());
        job.wrap.max_rows = 2;
        ui.label(job).on_hover_text(missing);
    }
}

/// How far looking at the file is.
fn looking(ui: &mut Ui, running: &Running, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        widgets::hint(ui, spoken(LOOKING));
        if let Some(part) = running.progress() {
            let bar = ProgressBar::new(part).desired_width(120.0);
            ui.add(bar.desired_height(8.0).fill(Palette::of(ui).accent));
        }
        if ui.small_button(say!("Stop looking")).clicked() {
            commands.push(Command::Stop(Task::Import));
        }
    });
    widgets::look_again_soon(ui);
}

/// What is wrong with the file, and what to know about it.
fn findings(ui: &mut Ui, now: &ImportDraft) {
    for finding in now.seen.inspection.findings.iter().take(8) {
        parts::line(
            ui,
            finding.severity,
            &in_the_sheets_words(&language::finding(finding)),
        );
    }
}

/// Lines of the result that are shown.
const MOST: usize = 8;

/// What the import would bring or why it is refused, once there is nothing left to ask.
fn result(ui: &mut Ui, now: &ImportDraft, units: Units) {
    // As high as it ever was for this file: the fields above keep their place while it changes.
    let id = ui.scope_id().with(("highest result", &now.path));
    let highest: f32 = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let shown = ui.scope(|ui| {
        ui.set_min_height(highest);
        contents(ui, now, units);
    });
    let height = shown.response.rect.height().max(highest);
    ui.data_mut(|data| data.insert_temp(id, height));
}

fn contents(ui: &mut Ui, now: &ImportDraft, units: Units) {
    match &now.seen.trial {
        None => {}
        Some(Ok(trial)) => {
            widgets::section(ui, &trial.brings(units).title);
            brings(ui, trial, units);
        }
        Some(Err(because)) => {
            widgets::section(ui, say!("To fix"));
            for line in because {
                parts::line(ui, Severity::Error, line);
            }
        }
    }
}

fn brings(ui: &mut Ui, trial: &Trial, units: Units) {
    let section = trial.brings(units);
    blocks::show(ui, &section.blocks);
    let mut notes: Vec<_> = trial.notes.iter().collect();
    notes.sort_by_key(|(severity, _)| std::cmp::Reverse(*severity == Severity::Warning));
    for (severity, note) in notes.iter().take(MOST) {
        parts::line(ui, *severity, note);
    }
}
