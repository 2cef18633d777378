//! A table without a robot, to be made a session: what its columns are taken for stands over their
//! first rows, what is not known is asked, and nothing is guessed in silence. What the import would
//! bring stands at the end before it is done.

mod columns;
mod file;

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{
    Align, DragValue, FontId, Key, Layout, ProgressBar, RadioButton, Response, RichText,
    ScrollArea, TextEdit, Ui, vec2,
};

use crate::diagnostic::Severity;
use crate::kinematics::{JointKind, Robot};
use crate::language;
use crate::present::units::Units;
use crate::text::{length, spoken};

use crate::gui::core::disk::{EXAMPLES, name_of};
use crate::gui::core::robot_table::RobotTable;
use crate::gui::import_draft::{
    Companion, ImportAnswers, ImportDraft, LOOKING, RobotFrom, Trial, in_the_windows_words,
};
use crate::gui::jobs::Running;
use crate::gui::style::{Palette, size, space};
use crate::gui::views::blocks;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

use super::robots::{self, Robot as ListedRobot};

/// Width of the sheet, points.
const WIDTH: f32 = 780.0;
/// What stands around the part that scrolls, points.
const AROUND: f32 = 228.0;
/// The least height of that, points.
const LEAST: f32 = 150.0;
/// Width of the field in which a robot is looked for, points.
const LIST: f32 = 300.0;
/// Two lines of what is in the way, points.
const FOOT: f32 = 34.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, now: &ImportDraft) {
    let window = ui.ctx().content_rect();
    widgets::wide(ui, WIDTH);
    let name = name_of(&now.path);
    widgets::heading(ui, &say!("Import {name}", name));
    widgets::hint(ui, file::found_out(now));
    let mut next = now.answers.clone();
    let height = (window.height() - AROUND).max(LEAST);
    // Another file begins at its head.
    let of_this = Arc::as_ptr(&now.neighbours).addr();
    let area = ScrollArea::vertical().id_salt(of_this).max_height(height);
    let scrolled = area.show(ui, |ui| {
        // Beside what scrolls, not over it.
        ui.set_width(ui.available_width() - f32::from(space::PANEL));
        file::show(ui, now, &mut next);
        columns::show(ui, now, &mut next, workbench);
        file::questions(ui, now, &mut next);
        let mut reason_in_sight = findings(ui, now);
        reason_in_sight |= robot(ui, workbench, now, &mut next);
        file::commanded(ui, now, &mut next, workbench);
        file::order_of_rows(ui, &mut next);
        file::base_frame(ui, now, &mut next, workbench);
        let open = &workbench.loaded_session().session.targets;
        file::reflectors(ui, open, now, &mut next, workbench);
        reason_in_sight |= result(ui, now, workbench.units());
        widgets::focus_in_sight(ui);
        (ui.max_rect().width(), reason_in_sight)
    });
    let (width, reason_in_sight) = scrolled.inner;
    let missing = if next == now.answers {
        // The reason too, unless it can be read above.
        now.hindrance().map(|(says, reason)| match reason {
            Some(reason) if !reason_in_sight => format!("{says}: {reason}"),
            _ => says.to_owned(),
        })
    } else {
        Some(spoken(LOOKING).to_owned())
    };
    // Always as high: what is above keeps its place.
    let room = vec2(ui.available_width(), FOOT);
    ui.allocate_ui_with_layout(room, Layout::top_down(Align::Min), |ui| {
        ui.set_min_height(FOOT);
        foot(ui, workbench, (now, &next), missing.as_deref());
    });
    // They end where what is above them ends.
    let pressed = ui.scope(|ui| {
        ui.set_max_width(width);
        widgets::sheet_buttons_without_enter(ui, say!("Import"), missing.is_none(), workbench)
    });
    if pressed.inner {
        workbench.then(Workbench::import);
    } else if next != now.answers {
        workbench.then(move |bench| bench.say(next));
    }
}

/// Where the look at the file stands, or what is in the way of the import.
fn foot(
    ui: &mut Ui,
    workbench: &Workbench,
    (now, next): (&ImportDraft, &ImportAnswers),
    missing: Option<&str>,
) {
    if let Some(running) = workbench.looking() {
        looking(ui, running, workbench);
    } else if *next == now.answers && !now.is_up_to_date() {
        ui.horizontal(|ui| {
            widgets::hint(ui, say!("Looking at the file was cancelled"));
            if ui.button(say!("Look again")).clicked() {
                let next = next.clone();
                workbench.then(|bench| bench.say(next));
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
fn looking(ui: &mut Ui, running: &Running, workbench: &Workbench) {
    ui.horizontal(|ui| {
        widgets::hint(ui, spoken(LOOKING));
        if let Some(part) = running.progress() {
            let bar = ProgressBar::new(part).desired_width(120.0);
            ui.add(bar.desired_height(8.0).fill(Palette::of(ui).accent));
        }
        ui.small_button(say!("Stop looking"))
            .does(workbench, Workbench::cancel_look);
    });
    widgets::look_again_soon(ui);
}

/// What is wrong with the file, and what to know about it. Whether an error can be read where it stands.
fn findings(ui: &mut Ui, now: &ImportDraft) -> bool {
    let mut error_in_sight = false;
    for finding in now.seen.inspection.findings.iter().take(8) {
        let says = in_the_windows_words(finding);
        let shown = line(ui, finding.severity, &says);
        error_in_sight |= finding.severity == Severity::Error && in_sight(ui, &shown);
    }
    error_in_sight
}

/// Whether all of it is within what scrolls.
fn in_sight(ui: &Ui, shown: &Response) -> bool {
    ui.clip_rect().contains_rect(shown.rect)
}

/// Lines of the result that are shown.
const MOST: usize = 8;

/// What the import would bring or why it is refused, once there is nothing left to ask. Whether the reason of a refusal
/// can be read where it stands.
fn result(ui: &mut Ui, now: &ImportDraft, units: Units) -> bool {
    // As high as it ever was for this file: the fields above keep their place while it changes.
    let id = ui.scope_id().with(("highest result", &now.path));
    let highest: f32 = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let shown = ui.scope(|ui| {
        ui.set_min_height(highest);
        contents(ui, now, units)
    });
    let height = shown.response.rect.height().max(highest);
    ui.data_mut(|data| data.insert_temp(id, height));
    shown.inner
}

fn contents(ui: &mut Ui, now: &ImportDraft, units: Units) -> bool {
    let mut reason_in_sight = false;
    match &now.seen.trial {
        None => {}
        Some(Ok(trial)) => {
            widgets::section(ui, &trial.brings(units).title);
            brings(ui, trial, units);
        }
        Some(Err(because)) => {
            widgets::section(ui, say!("To fix"));
            for says in because {
                let shown = line(ui, Severity::Error, says);
                reason_in_sight |= in_sight(ui, &shown);
            }
        }
    }
    reason_in_sight
}

fn brings(ui: &mut Ui, trial: &Trial, units: Units) {
    let section = trial.brings(units);
    blocks::show(ui, &section.blocks);
    let mut notes: Vec<_> = trial.notes.iter().collect();
    notes.sort_by_key(|(severity, _)| std::cmp::Reverse(*severity == Severity::Warning));
    for (severity, note) in notes.iter().take(MOST) {
        line(ui, *severity, note);
    }
}

/// Whose robot was measured. Whether what is wrong with it can be read where it stands.
fn robot(ui: &mut Ui, workbench: &Workbench, now: &ImportDraft, next: &mut ImportAnswers) -> bool {
    widgets::section(ui, say!("Robot model"));
    let here = &workbench.loaded_session().session.robot;
    let is = |robot: &RobotFrom, other: &RobotFrom| {
        std::mem::discriminant(robot) == std::mem::discriminant(other)
    };
    let open = RobotFrom::Here(Box::new(here.clone()));
    let text = say!("that of the open session, {here}", here = here.name);
    if ui.radio(is(&next.robot, &open), text).clicked() {
        next.robot = open;
    }
    listed(ui, workbench, next);
    let file = RobotFrom::Open.of_file(String::new());
    if ui
        .radio(is(&next.robot, &file), say!("from this file"))
        .clicked()
        && !is(&next.robot, &file)
    {
        next.robot = file;
    }
    let mut path = match &next.robot {
        RobotFrom::File { path, .. } => path.clone(),
        _ => String::new(),
    };
    let field = (
        say!("File of the robot"),
        say!("a robot, a session, or a URDF file"),
    );
    if file::path(ui, field, &mut path, (Companion::Robot, now), workbench) {
        next.robot = next.robot.of_file(path);
    }
    if let RobotFrom::File { path, base, tip } = &mut next.robot
        && RobotFrom::is_urdf(path)
    {
        for (row, label, link) in [
            (say!("Base"), say!("Link of the base"), base),
            (say!("Tip"), say!("Link of the tool"), tip),
        ] {
            widgets::form_row(ui, row, |ui| {
                let field = ui.add(TextEdit::singleline(link).hint_text(say!("name of a link")));
                widgets::label(&field, label);
            });
        }
    }
    let typed = matches!(next.robot, RobotFrom::Typed(_));
    if ui
        .radio(typed, say!("one axis that turns, typed here"))
        .clicked()
        && !typed
    {
        next.robot = RobotFrom::Typed(Box::new(RobotTable::one_axis()));
    }
    if let RobotFrom::Typed(typed) = &mut next.robot {
        axis(ui, typed);
    }
    for (k, example) in EXAMPLES.iter().enumerate() {
        let one = RobotFrom::Example(k);
        let text = say!("that of the example {example}", example = example.name());
        if ui.radio(next.robot == one, text).clicked() {
            next.robot = one;
        }
    }
    let mut error_in_sight = false;
    match &now.seen.robot {
        None => {}
        Some(Ok(robot)) => widgets::hint(ui, in_words(robot)),
        Some(Err(because)) => {
            for says in because {
                let shown = line(ui, Severity::Error, says);
                error_in_sight |= in_sight(ui, &shown);
            }
        }
    }
    error_in_sight
}

/// So many robots are offered for what was typed.
const OFFERED: usize = 8;

/// What was typed to find a robot, and which one had been chosen by it.
#[derive(Clone, Default)]
struct RobotSearch {
    text: String,
    chosen: Option<String>,
}

/// One of the library, or one's own, found by typing.
fn listed(ui: &mut Ui, workbench: &Workbench, next: &mut ImportAnswers) {
    let mut chosen = match &next.robot {
        RobotFrom::Listed(title, _) => Some(title.clone()),
        _ => None,
    };
    let id = ui.scope_id().with("robot that was looked for");
    let mut search: RobotSearch = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if chosen != search.chosen {
        search.text = chosen.clone().unwrap_or_default();
        search.chosen.clone_from(&chosen);
    }
    let field = ui.horizontal(|ui| {
        // Which one is chosen by typing: a press here would have to guess it.
        let radio = RadioButton::new(chosen.is_some(), say!("one of the library"));
        ui.add_enabled(chosen.is_some(), radio);
        let field = TextEdit::singleline(&mut search.text).hint_text(robots::examples());
        let field = ui.add(field.desired_width(LIST));
        widgets::label(&field, say!("Find a robot"));
        field
    });
    let field = field.inner;
    if field.gained_focus() {
        widgets::select_all(ui, field.id, &search.text);
    }
    if field.changed() && chosen.is_some() {
        // Another is looked for.
        next.robot = RobotFrom::Open;
        (chosen, search.chosen) = (None, None);
    }
    if !search.text.trim().is_empty() && chosen.as_ref() != Some(&search.text) {
        let found = ListedRobot::found(workbench.typed_robots(), &search.text);
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        let mut taken = found.first().copied().filter(|_| entered);
        ui.horizontal_wrapped(|ui| {
            for robot in found.iter().take(OFFERED) {
                if ui.small_button(robot.title()).clicked() {
                    taken = Some(*robot);
                }
            }
            match found.len().checked_sub(OFFERED) {
                _ if found.is_empty() => widgets::hint(ui, say!("No robot has this name")),
                Some(more @ 1..) => widgets::hint(ui, say!("and {more} more", more)),
                _ => {}
            }
        });
        if let Some((robot, title)) = taken.and_then(|taken| Some((taken.robot()?, taken.title())))
        {
            next.robot = RobotFrom::Listed(title, Box::new(robot));
        }
    }
    ui.data_mut(|data| data.insert_temp(id, search));
}

/// One axis that turns: its name, where it stands, where the tool is, how far it goes.
fn axis(ui: &mut Ui, typed: &mut RobotTable) {
    widgets::form_row(ui, say!("Name"), |ui| {
        let field = ui.add(TextEdit::singleline(&mut typed.name));
        widgets::label(&field, say!("Name of the robot"));
    });
    let xyz = ["x", "y", "z"];
    let row = &mut typed.rows[0];
    let (axis, point) = row.numbers.split_at_mut(3);
    numbers(ui, say!("Axis at home"), (say!("Axis"), ""), &xyz, axis);
    let (name, unit) = (say!("Point on it, mm"), "mm");
    numbers(ui, name, (say!("Point"), unit), &xyz, point);
    let name = say!("Tool at home, mm");
    numbers(ui, name, (say!("Tool"), unit), &xyz, &mut typed.tool[..3]);
    let (name, ends) = (say!("Travel, °"), [say!("from"), say!("to")]);
    let travel = row.travel.get_or_insert([-180.0, 180.0]);
    numbers(ui, name, (say!("Travel"), "°"), &ends, travel);
    let mut down = typed.gravity.is_some();
    ui.checkbox(&mut down, say!("gravity points along −z"));
    typed.gravity = down.then_some([0.0, 0.0, -9.81]);
}

fn numbers(ui: &mut Ui, row: &str, (name, unit): (&str, &str), parts: &[&str], values: &mut [f64]) {
    widgets::form_row(ui, row, |ui| {
        for (part, value) in parts.iter().zip(values) {
            let field = DragValue::new(value).speed(1.0).max_decimals(6);
            widgets::cell_number(ui, &format!("{name} {part}"), unit, 90.0, field);
        }
    });
}

fn in_words(robot: &Robot) -> String {
    let turning = |joint: &&crate::kinematics::Joint| joint.kind == JointKind::Revolute;
    let turns = robot.joints.iter().filter(turning).count();
    let count = robot.joint_count();
    let joints = match (count, turns) {
        (1, 1) => say!("one joint that turns").to_owned(),
        (1, 0) => say!("one joint that slides").to_owned(),
        (count, turns) => say!("{count} joints, {turns} of which turn", count, turns),
    };
    let reach = robot.base_from_tool.translation.vector.norm();
    say!(
        "{robot}: {joints}, tool {reach} from the base",
        robot = robot.name,
        joints,
        reach = language::spoken(length(reach, 0))
    )
}

/// A finding as a line; its kind is a word as well as a colour.
fn line(ui: &mut Ui, severity: Severity, says: &str) -> Response {
    let palette = Palette::of(ui);
    let (text, color) = match severity {
        Severity::Note => (says.to_owned(), palette.muted),
        Severity::Warning => (say!("Warning: {says}", says), palette.warning),
        Severity::Error => (say!("Error: {says}", says), palette.outside),
    };
    let text = RichText::new(text);
    ui.add(egui::Label::new(text.size(size::SMALL).color(color)).wrap())
}
