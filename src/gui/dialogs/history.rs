//! What became of a machine: its sessions, and its parameters by session with their intervals and what changed beyond
//! its uncertainty.

use egui::{ComboBox, Id, ScrollArea, Ui};

use crate::gui::core::disk::name_of;
use crate::gui::style::{Palette, size, space};
use crate::gui::views::blocks;
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::history::{Order, RobotHistory};
use crate::present::history::{CHANGED, entries, parameters};
use crate::present::table::Table;

/// Widest, points.
const WIDE: f32 = 900.0;
/// The newest sessions stand side by side.
const MOST: usize = 12;

pub(super) fn history(ui: &mut Ui, workbench: &Workbench) {
    let Some(past) = workbench.past() else {
        return workbench.then(move |bench| bench.show_sheet(None));
    };
    widgets::wide(ui, WIDE);
    let id = Id::unique("history of a machine");
    let open = &workbench.loaded_session().session.robot.name;
    let chosen: String = ui
        .data(|data| data.get_temp(id))
        .unwrap_or_else(|| open.clone());
    let all = &past.history.robots;
    let found = all.iter().find(|one| one.robot == chosen);
    let Some(robot) = found.or(all.first()) else {
        return workbench.then(move |bench| bench.show_sheet(None));
    };
    widgets::heading(ui, &say!("History of {robot}", robot = robot.robot));
    let name = name_of(&past.folder);
    let says = match robot.ordered_by {
        Order::Time => say!(
            "Sessions and models of the folder {folder}, by the time of the first sample",
            folder = name
        ),
        Order::Name => say!(
            "Sessions and models of the folder {folder}, by file name, numbers in it by their value",
            folder = name
        ),
    };
    widgets::hint(ui, says);
    if all.len() > 1 {
        let names: Vec<&str> = all.iter().map(|one| one.robot.as_str()).collect();
        let now = names.iter().position(|name| *name == robot.robot);
        if let Some(next) = list(ui, say!("Robot"), &names, now.unwrap_or(0)) {
            ui.data_mut(|data| data.insert_temp(id, names[next].to_owned()));
        }
    }
    over_time(ui, robot);
    for file in &past.history.not_read {
        widgets::wrong(ui, &crate::language::spoken(file.describe()));
    }
    if widgets::done_beside(ui, say!("Other folder…"), true, workbench) {
        workbench.then(Workbench::choose_folder);
    }
}

/// All sessions: their errors, and their parameters.
fn over_time(ui: &mut Ui, robot: &RobotHistory) {
    widgets::section(ui, say!("Errors"));
    table(ui, "errors", &entries(robot));
    let last = robot.entries.len();
    let shown: Vec<usize> = (last.saturating_sub(MOST)..last).collect();
    let all = parameters(robot, &shown);
    if all.rows.is_empty() {
        return widgets::hint(ui, say!("No parameter was identified"));
    }
    widgets::section(ui, say!("Parameters"));
    table(ui, "parameters", &all);
    let mut says = say!(
        "± half the 95 % interval; {mark} changed by more than its interval",
        mark = CHANGED
    );
    if shown.len() < last {
        let of = say!(
            "the last {shown} of {all} sessions",
            shown = shown.len(),
            all = last
        );
        says += &format!("; {of}");
    }
    widgets::hint(ui, says);
}

/// A list with its name before it; what was chosen.
fn list(ui: &mut Ui, name: &str, all: &[&str], now: usize) -> Option<usize> {
    let mut chosen = None;
    widgets::form_row(ui, name, |ui| {
        let shown = all.get(now).copied().unwrap_or_default();
        let list = ComboBox::from_id_salt(name).selected_text(shown);
        let offered = all.iter().enumerate();
        chosen = widgets::list(ui, name, list.width(320.0), offered, now);
    });
    chosen.filter(|k| *k != now)
}

fn table(ui: &mut Ui, id: &str, table: &Table) {
    let palette = Palette::of(ui);
    let window = ui.ctx().content_rect().height();
    let area = ScrollArea::both().id_salt(id).max_height(0.32 * window);
    area.auto_shrink([false, true]).show(ui, |ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let look = (size::SMALL, f32::from(space::PANEL));
        blocks::grid(ui, id, table, look, |shown| {
            if shown.contains(CHANGED) {
                palette.before
            } else {
                palette.text
            }
        });
    });
}
