//! A table without a robot, to be made a session: what its columns are taken for stands over their
//! first rows, what is not known is asked, and nothing is guessed in silence. What the import would
//! bring stands at the end before it is done.

mod columns;
mod file;

use std::sync::Arc;

use egui::{Key, Label, ProgressBar, RadioButton, RichText, ScrollArea, TextEdit, Ui};

use crate::diagnostic::Severity;
use crate::explain::{Detail, imported};
use crate::kinematics::{JointKind, Robot};
use crate::language;
use crate::present::units::Units;
use crate::text::{capital, length, spoken};

use crate::gui::core::disk::{EXAMPLES, name_of};
use crate::gui::core::robot_table::RobotTable;
use crate::gui::import_draft::{
    Companion, ImportDraft, InspectedDraft, LOOKING, RobotFrom, in_the_windows_words,
};
use crate::gui::style::{Palette, size, space};
use crate::gui::views::{blocks, session};
use crate::gui::widgets::{self, Does, Forms, Words};
use crate::gui::workbench::Workbench;

use super::robots::{self, Robot as ListedRobot};
use super::setup;

/// Width of the sheet, points.
const WIDTH: f32 = 780.0;
/// What stands around the part that scrolls, points.
const AROUND: f32 = 244.0;
/// The least height of that, points.
const LEAST: f32 = 150.0;
/// Width of the field in which a robot is looked for, points.
const LIST: f32 = 300.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, draft: &mut ImportDraft) {
    let window = ui.ctx().content_rect();
    let name = name_of(&draft.path);
    widgets::head(ui, WIDTH, say!("Import {name}", name));
    ui.hint(file::found_out(draft));
    let (seen, asked) = (Arc::clone(&draft.seen), draft.answers.clone());
    let height = (window.height() - AROUND).max(LEAST);
    // Another file begins at its head.
    let area = ScrollArea::vertical().id_salt(&draft.path);
    area.max_height(height).show(ui, |ui| {
        // Beside what scrolls, not over it.
        ui.set_width(ui.available_width() - f32::from(space::PANEL));
        file::show(ui, draft);
        columns::show(ui, draft);
        file::questions(ui, draft);
        for finding in seen.inspection.findings.iter().take(MOST) {
            line(ui, finding.severity, &in_the_windows_words(finding));
        }
        robot(ui, workbench, draft);
        file::commanded(ui, draft, workbench);
        file::order_of_rows(ui, &mut draft.answers);
        file::base_frame(ui, draft, workbench);
        file::reflectors(ui, draft, workbench);
        result(ui, &seen, workbench.units());
        widgets::focus_in_sight(ui);
    });
    let missing = draft.hindrance();
    let same = draft.answers == asked;
    foot(
        ui,
        workbench,
        same && !draft.is_up_to_date(),
        missing.as_deref(),
    );
    if widgets::ended(ui, workbench, (say!("Import"), missing.is_none())) {
        workbench.then(Workbench::import);
    }
}

/// Where the look at the file stands, or what is in the way of the import.
fn foot(ui: &mut Ui, workbench: &Workbench, cancelled: bool, missing: Option<&str>) {
    ui.horizontal(|ui| {
        if let Some(running) = workbench.looking() {
            ui.hint(capital(spoken(LOOKING)));
            if let Some(part) = running.progress() {
                let bar = ProgressBar::new(part).desired_width(120.0);
                ui.add(bar.desired_height(8.0).fill(Palette::of(ui).accent));
            }
            ui.small_button(say!("Stop looking"))
                .does(workbench, Workbench::cancel_look);
            widgets::look_again_soon(ui);
        } else if cancelled {
            ui.hint(capital(say!("it was cancelled")));
            ui.button(say!("Look again"))
                .does(workbench, Workbench::keep_looking);
        } else if let Some(missing) = missing {
            let text = RichText::new(missing).size(size::NOTE).weak();
            ui.add(Label::new(text).truncate()).on_hover_text(missing);
        }
    });
}

/// Lines of findings, of reasons and of notes that are shown.
const MOST: usize = 8;

/// What the import would bring or why it is refused, once there is nothing left to ask.
fn result(ui: &mut Ui, seen: &InspectedDraft, units: Units) {
    let trial = match &seen.trial {
        None => return,
        Some(Ok(trial)) => trial,
        Some(Err(because)) => {
            ui.section(say!("To fix"));
            return errors(ui, because);
        }
    };
    let (gap, matched) = (trial.loaded_session.gap_before, trial.matched.as_ref());
    let (samples, detail) = (trial.loaded_session.len(), Detail::window(units));
    let section = imported(samples, gap, matched, trial.alignment.as_ref(), detail);
    ui.section(&section.title);
    blocks::show(ui, &section.blocks);
    let mut notes: Vec<_> = trial.loaded_session.findings.iter().collect();
    notes.sort_by_key(|note| std::cmp::Reverse(note.severity));
    for note in notes.into_iter().take(MOST) {
        line(ui, note.severity, &in_the_windows_words(note));
    }
}

/// Whose robot was measured.
fn robot(ui: &mut Ui, workbench: &Workbench, draft: &mut ImportDraft) {
    ui.section(say!("Robot model"));
    let choose = |ui: &mut Ui, draft: &mut ImportDraft, one: RobotFrom, text: &str| {
        let chosen = draft.answers.robot.is_like(&one);
        if ui.radio(chosen, text).clicked() && !chosen {
            draft.answers.robot = one;
        }
    };
    let here = &workbench.loaded_session().session.robot;
    let text = say!("that of the open session, {here}", here = here.name);
    let here = RobotFrom::Here(Box::new(here.clone()));
    choose(ui, draft, here, &text);
    listed(ui, workbench, draft);
    choose(ui, draft, RobotFrom::File, say!("from this file"));
    let hint = say!("a robot, a session, or a URDF file");
    file::path(ui, Companion::Robot, hint, draft, workbench);
    if draft.answers.is_of_links() {
        let [base, tip] = &mut draft.answers.links;
        for (row, label, link) in [
            (&capital(say!("base")), say!("Link of the base"), base),
            (&say!("Tip").to_owned(), say!("Link of the tool"), tip),
        ] {
            let field = TextEdit::singleline(link);
            ui.form_row(row, |ui| drop(ui.named(label, field)));
        }
    }
    let typed = RobotFrom::Typed(Box::new(RobotTable::one_axis()));
    choose(ui, draft, typed, say!("one axis or more, typed here"));
    if let RobotFrom::Typed(typed) = &mut draft.answers.robot {
        setup::table(ui, typed);
    }
    for (k, example) in EXAMPLES.iter().enumerate() {
        let text = say!("that of the example {example}", example = example.name());
        choose(ui, draft, RobotFrom::Example(k), &text);
    }
    match &draft.seen.robot {
        None => {}
        Some(Ok(robot)) => ui.hint(in_words(robot)),
        Some(Err(because)) => errors(ui, because),
    }
}

fn errors(ui: &mut Ui, because: &[String]) {
    for says in because {
        line(ui, Severity::Error, says);
    }
}

/// So many robots are offered for what was typed.
const OFFERED: usize = 8;

/// One of the library, or one's own, found by typing.
fn listed(ui: &mut Ui, workbench: &Workbench, draft: &mut ImportDraft) {
    let robot = &mut draft.answers.robot;
    let chosen = matches!(robot, RobotFrom::Listed(..));
    let search = &mut draft.robot_search;
    if !chosen && *robot != RobotFrom::Open {
        search.clear();
    }
    let field = ui.horizontal(|ui| {
        // Which one is chosen by typing: a press here would have to guess it.
        let radio = RadioButton::new(chosen, say!("one of the library"));
        ui.add_enabled(chosen, radio);
        let field = TextEdit::singleline(search).hint_text(robots::examples());
        ui.named(say!("Find a robot"), field.desired_width(LIST))
    });
    let field = field.inner;
    if field.gained_focus() {
        widgets::select_all(ui, field.id, search);
    }
    if field.changed() {
        // Another is looked for.
        *robot = RobotFrom::Open;
    } else if chosen {
        return;
    }
    if search.trim().is_empty() {
        return;
    }
    let found = ListedRobot::found(workbench.typed_robots(), search);
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let mut taken = found.first().copied().filter(|_| entered);
    ui.horizontal_wrapped(|ui| {
        for robot in found.iter().take(OFFERED) {
            if ui.small_button(robot.title()).clicked() {
                taken = Some(*robot);
            }
        }
        match found.len().checked_sub(OFFERED) {
            _ if found.is_empty() => ui.hint(say!("No robot has this name")),
            Some(more @ 1..) => ui.hint(say!("and {more} more", more)),
            _ => {}
        }
    });
    if let Some((made, title)) = taken.and_then(|taken| Some((taken.made()?, taken.title()))) {
        *search = title;
        *robot = RobotFrom::Listed(Box::new(made.robot.clone()));
    }
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

fn line(ui: &mut Ui, severity: Severity, says: &str) {
    session::finding(ui, severity, |ui| {
        ui.label(RichText::new(says).small());
    });
}
