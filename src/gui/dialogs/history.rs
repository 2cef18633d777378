//! What became of a machine: its parameters by session with their intervals, what changed beyond its
//! uncertainty, and two sessions side by side, as before and after a repair.

use egui::{Button, ComboBox, Grid, Id, RichText, ScrollArea, Ui, vec2};

use crate::gui::core::disk::name_of;
use crate::gui::plots::{chart, figure};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command, Workbench};
use crate::history::{Entry, Order, RobotHistory};
use crate::present::history::{
    CHANGED, Row, chart as chart_of, compared, entries, parameters, rows, short_name, source,
};
use crate::present::numbers::mm;
use crate::present::table::Table;
use crate::text::filled;

/// Widest, points.
const WIDE: f32 = 900.0;
/// Height of the chart, points.
const CHART: f32 = 170.0;
const LOWEST_CHART: f32 = 90.0;
/// The newest sessions stand side by side; the chart has all of them.
const MOST: usize = 12;

/// What is looked at.
#[derive(Debug, Clone, Default, PartialEq)]
struct Choice {
    robot: String,
    /// Two sessions side by side, rather than all.
    two: bool,
    /// Their places; `None`: the newest and the one before.
    ends: [Option<usize>; 2],
    /// The parameter that is charted; `None`: the first that changed.
    row: Option<usize>,
}

pub(super) fn history(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(past) = workbench.past() else {
        return commands.push(Command::no_sheet());
    };
    ui.set_width(WIDE.min(ui.ctx().content_rect().width() - 96.0));
    let id = Id::unique("history of a machine");
    let open = &workbench.loaded_session().session.robot.name;
    let blank = || Choice {
        robot: open.clone(),
        ..Choice::default()
    };
    let mut choice: Choice = ui.data(|data| data.get_temp(id)).unwrap_or_else(blank);
    let all = &past.history.robots;
    let found = all.iter().find(|one| one.robot == choice.robot);
    let Some(robot) = found.or(all.first()) else {
        return commands.push(Command::no_sheet());
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
            choice = Choice {
                robot: names[next].to_owned(),
                two: choice.two,
                ..Choice::default()
            };
        }
    }
    let ways = [
        (false, say!("All sessions")),
        (true, say!("Before and after")),
    ];
    widgets::choice(ui, &ways, &mut choice.two);
    if choice.two {
        before_and_after(ui, robot, &mut choice);
    } else {
        over_time(ui, workbench, robot, &mut choice);
    }
    for file in &past.history.not_read {
        widgets::wrong(ui, &crate::language::spoken(file.describe()));
    }
    ui.data_mut(|data| data.insert_temp(id, choice));
    if widgets::done_beside(ui, say!("Other folder…"), true, commands) {
        commands.push(Command::Ask(Asked::Folder));
    }
}

/// All sessions: their errors, their parameters, and one of these as a chart.
fn over_time(ui: &mut Ui, workbench: &Workbench, robot: &RobotHistory, choice: &mut Choice) {
    widgets::section(ui, say!("Errors"));
    table(ui, "errors", &entries(robot), None);
    let rows = rows(robot);
    let is_changed = |row: &Row<'_>| row.values.iter().flatten().any(|value| value.changed);
    let changed = || rows.iter().position(is_changed);
    let mut charted = choice.row.or_else(changed).unwrap_or(0);
    let Some(row) = rows.get(charted).or(rows.first()) else {
        return widgets::hint(ui, say!("No parameter was identified"));
    };
    widgets::section(ui, say!("Parameters"));
    let last = robot.entries.len();
    let shown: Vec<usize> = (last.saturating_sub(MOST)..last).collect();
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    let all = parameters(robot, &shown);
    table(ui, "parameters", &all, Some((&mut charted, &names)));
    if rows.get(charted).is_some_and(|now| now.name != row.name) {
        choice.row = Some(charted);
    }
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
    widgets::section(ui, &row.name);
    let chart = chart_of(robot, row);
    let height = (CHART - 0.8 * missing_height(ui)).max(LOWEST_CHART);
    let room = vec2(ui.available_width(), height);
    let layout = egui::Layout::top_down(egui::Align::Min);
    ui.allocate_ui_with_layout(room, layout, |ui| {
        ui.set_min_height(height);
        chart::legend(ui, &chart, None, &mut Vec::new());
        let id = (&*row.name, false, workbench.view().fitted.charts);
        let (response, _) = chart::show(ui, id, &chart, |_, _| {});
        figure(
            &response,
            &say!("{parameter} over the sessions", parameter = row.name),
            String::new(),
        );
    });
}

/// Two sessions: what was, what is, and whether that is a change.
fn before_and_after(ui: &mut Ui, robot: &RobotHistory, choice: &mut Choice) {
    let names: Vec<String> = robot.entries.iter().map(title).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let newest = names.len().saturating_sub(1);
    let usual = [newest.saturating_sub(1), newest];
    let mut ends = [0, 1].map(|k| choice.ends[k].unwrap_or(usual[k]).min(newest));
    for (k, says) in [say!("Before"), say!("After")].into_iter().enumerate() {
        if let Some(next) = list(ui, says, &names, ends[k]) {
            choice.ends[k] = Some(next);
            ends[k] = next;
        }
    }
    let Some(both) = compared(robot, ends[0], ends[1]) else {
        return;
    };
    if both.rows.is_empty() {
        return widgets::hint(ui, say!("They have no parameter in common"));
    }
    let changed = both.rows.iter().filter(|row| {
        row.last()
            .is_some_and(|cell| cell.shown.starts_with(CHANGED))
    });
    let says = say!(
        "{changed} of {all} parameters changed by more than the 95 % interval of the difference",
        changed = changed.count(),
        all = both.rows.len()
    );
    widgets::bold(ui, says);
    table(ui, "before and after", &both, None);
    for (end, key) in ends
        .into_iter()
        .zip([phrase!("Before: RMS error {nominal} nominal, {identified} after identification"; nominal, identified), phrase!("After: RMS error {nominal} nominal, {identified} after identification"; nominal, identified)])
    {
        let entry = &robot.entries[end];
        let [nominal, identified] = [entry.before_mm, entry.after_mm].map(mm);
        widgets::hint(ui, filled(key, &[("nominal", &nominal), ("identified", &identified)]));
    }
}

fn title(entry: &Entry) -> String {
    format!("{} ({})", short_name(entry), source(entry))
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

/// What the window lacks of the height from which two tables, a chart and the buttons have room: they give way.
fn missing_height(ui: &Ui) -> f32 {
    (800.0 - ui.ctx().content_rect().height()).clamp(0.0, 200.0)
}

/// A table; where its rows have names, one of them can be chosen.
fn table(ui: &mut Ui, id: &str, table: &Table, mut choice: Option<(&mut usize, &[&str])>) {
    let palette = Palette::of(ui);
    let window = ui.ctx().content_rect().height();
    ScrollArea::both()
        .id_salt(id)
        .max_height(0.32 * window - 0.85 * missing_height(ui))
        .auto_shrink([false, true])
        .show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
            let grid = Grid::new(id)
                .striped(true)
                .spacing([f32::from(space::PANEL), space::TIGHT]);
            grid.show(ui, |ui| {
                for column in &table.columns {
                    let head = RichText::new(&column.heading).font(strong(size::SMALL));
                    cell(ui, column.right, head);
                }
                ui.end_row();
                for (k, row) in table.rows.iter().enumerate() {
                    for (column, one) in table.columns.iter().zip(row) {
                        let is_changed = one.shown.contains(CHANGED);
                        let color = if is_changed {
                            palette.before
                        } else {
                            palette.text
                        };
                        let text = RichText::new(&one.shown).size(size::SMALL).color(color);
                        match &mut choice {
                            Some((chosen, names)) if names.get(k) == Some(&&*one.shown) => {
                                let button = Button::selectable(**chosen == k, text);
                                if ui.add(button).clicked() {
                                    **chosen = k;
                                }
                            }
                            _ => cell(ui, column.right, text),
                        }
                    }
                    ui.end_row();
                }
            });
        });
}

fn cell(ui: &mut Ui, right: bool, text: RichText) {
    if right {
        widgets::cell_right(ui, text);
    } else {
        ui.label(text);
    }
}
