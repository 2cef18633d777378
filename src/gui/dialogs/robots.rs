//! The library of robots and one's own: found by typing, drawn as they are chosen, simulated, saved.

use egui::{
    Align, Button, Grid, Key, Layout, Modifiers, RichText, Role, ScrollArea, Sense, TextEdit, Ui,
    Vec2, WidgetInfo, vec2,
};

use crate::gui::core::robot_table::{RobotTable, Row, TableForm};
use crate::gui::core::simulate::{self, Form, SimulatedRobot};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Camera, Sheet, What};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::robot_alone;
use crate::kinematics;
use crate::language::spoken;
use crate::present::robots_v1::figure;
use crate::robots::{LibraryRobot, find, library, source};

/// Width of the list, and where there is little room, points.
const LIST: f32 = 320.0;
const LEAST_LIST: f32 = 220.0;
/// Width of the robot, at least and at most, and as a share of the window.
const PICTURE: [f32; 2] = [360.0, 620.0];
const SHARE: f32 = 0.35;
/// Height of both, at least and at most, and of everything else in the sheet.
const HEIGHT: [f32; 2] = [300.0, 600.0];
const OTHER: f32 = 420.0;
/// Height of what is known of the robot, points.
const FACTS: f32 = 110.0;

/// Width of the list, and size of the robot with what is known of it: a large window has more room for it.
fn sizes(ui: &Ui) -> (f32, Vec2) {
    let window = ui.ctx().content_rect();
    let most = widgets::room_of_a_sheet(ui).x - f32::from(space::PANEL);
    let list = LIST.min(most - PICTURE[0]).max(LEAST_LIST);
    let wide = (SHARE * window.width()).clamp(PICTURE[0], PICTURE[1]);
    let high = (window.height() - OTHER).clamp(HEIGHT[0], HEIGHT[1]);
    (list, vec2(wide.min(most - list), high))
}

/// What was typed, which robot is chosen, and from where it is seen.
#[derive(Clone, Default)]
struct RobotsInput {
    text: String,
    chosen: String,
    camera: Camera,
    /// When it was last shown, in passes of the window: a gap means that it was closed since.
    shown: u64,
}

/// One of the list.
#[derive(Clone, Copy)]
pub(super) enum Robot<'w> {
    Own(&'w RobotTable),
    Library(&'static LibraryRobot),
}

impl<'w> Robot<'w> {
    /// What the list has of this text: one's own first.
    pub(super) fn found(own: &'w [RobotTable], text: &str) -> Vec<Self> {
        let words = text.to_lowercase();
        let has = |table: &&RobotTable| {
            let name = table.name.to_lowercase();
            words.split_whitespace().all(|word| name.contains(word))
        };
        let own = own.iter().filter(has).map(Self::Own);
        own.chain(find(text).into_iter().map(Self::Library))
            .collect()
    }

    /// By what it is told from the others.
    fn key(self) -> String {
        match self {
            Self::Own(table) => format!("own {}", table.name),
            Self::Library(robot) => robot.id.clone(),
        }
    }

    pub(super) fn title(self) -> String {
        match self {
            Self::Own(table) => table.name.clone(),
            Self::Library(robot) => robot.title(),
        }
    }

    /// What stands behind its title.
    fn subtitle(self) -> String {
        match self {
            Self::Own(_) => say!("typed").to_owned(),
            Self::Library(robot) => {
                let reach = robot.reach_mm;
                reach.map_or(String::new(), |mm| format!("{mm} mm"))
            }
        }
    }

    fn table(self) -> RobotTable {
        match self {
            Self::Own(table) => table.clone(),
            Self::Library(robot) => {
                let mut table = RobotTable::of(&robot.robot);
                table.name = robot.title();
                table
            }
        }
    }

    /// Itself; none where what was typed is no robot yet.
    pub(super) fn robot(self) -> Option<kinematics::Robot> {
        match self {
            Self::Own(table) => table.robot().ok(),
            Self::Library(robot) => Some(robot.robot.clone()),
        }
    }

    fn form(self) -> Option<Form> {
        let robot = match self {
            Self::Own(table) => SimulatedRobot::typed(table)?,
            Self::Library(robot) => SimulatedRobot::of(robot),
        };
        Some(Form::of(robot))
    }
}

pub(super) fn robots(ui: &mut Ui, workbench: &Workbench) {
    let (wide, room) = sizes(ui);
    ui.set_width(wide + room.x + f32::from(space::PANEL));
    widgets::heading(ui, say!("Robots"));
    widgets::hint(
        ui,
        say!(
            "{count} common robots with their nominal geometry: type a maker, a model or a kind",
            count = library().len()
        ),
    );
    let id = ui.scope_id().with("typed robot");
    let before: Option<RobotsInput> = ui.data(|data| data.get_temp(id));
    let mut typed = before.unwrap_or_default();
    let pass = ui.ctx().cumulative_pass_nr();
    let first = pass > typed.shown + 1;
    typed.shown = pass;
    let steps = [(Key::ArrowUp, -1), (Key::ArrowDown, 1)];
    let field = TextEdit::singleline(&mut typed.text).hint_text(examples());
    let line = vec2(ui.available_width(), space::PRIMARY);
    let field = ui.add_sized(line, field.align(egui::Align2::LEFT_CENTER));
    widgets::label(&field, say!("Find a robot"));
    if first {
        field.request_focus();
        widgets::select_all(ui, field.id, &typed.text);
    }
    let found = Robot::found(workbench.typed_robots(), &typed.text);
    let mut at = found.iter().position(|robot| robot.key() == typed.chosen);
    if field.changed() || at.is_none() {
        at = (!found.is_empty()).then_some(0);
    }
    let mut moved = field.changed();
    if field.has_focus() || first {
        for (key, way) in steps {
            if ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)) {
                at = at.map(|at| at.saturating_add_signed(way).min(found.len() - 1));
                moved = true;
            }
        }
    }
    let mut chosen = at.map(|at| found[at]);
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = f32::from(space::PANEL);
        if let Some(clicked) = list(ui, vec2(wide, room.y), (&found, chosen), moved) {
            chosen = Some(clicked);
        }
        ui.vertical(|ui| match chosen {
            Some(robot) => described(ui, robot, room, &mut typed.camera, workbench),
            None => widgets::hint(ui, say!("No robot has this name")),
        });
    });
    typed.chosen = chosen.map_or_else(String::new, Robot::key);
    // On a button it presses that.
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    ends(ui, chosen, entered || widgets::entered(ui), workbench);
    if ui.input(|i| i.key_pressed(Key::Escape)) {
        // Next time it begins anew.
        typed = RobotsInput::default();
    }
    ui.data_mut(|data| data.insert_temp(id, typed));
}

/// What may be typed to find a robot.
pub(super) fn examples() -> &'static str {
    say!("such as ur5e, kuka kr 6, scara")
}

/// The robots that were found; which was clicked.
fn list<'w>(
    ui: &mut Ui,
    size: Vec2,
    (found, chosen): (&[Robot<'w>], Option<Robot<'w>>),
    moved: bool,
) -> Option<Robot<'w>> {
    let chosen = chosen.map(Robot::key);
    let mut clicked = None;
    let scroll = ScrollArea::vertical()
        .id_salt("robots")
        .max_height(size.y)
        .auto_shrink(false);
    // Below each other, beside the picture.
    let down = Layout::top_down(Align::Min);
    ui.allocate_ui_with_layout(size, down, |ui| {
        ui.set_width(size.x);
        scroll.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for robot in found {
                let on = chosen.as_ref() == Some(&robot.key());
                let title = robot.title();
                let button = Button::selectable(on, title.as_str()).shortcut_text(robot.subtitle());
                // The arrows choose among them: the focus does not go through all of them.
                let button = button.sense(Sense::CLICK);
                let row = ui.add(button.min_size(vec2(ui.available_width(), space::CONTROL)));
                row.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, true, on, &title));
                if on && moved {
                    row.scroll_to_me(None);
                }
                if row.clicked() {
                    clicked = Some(*robot);
                }
            }
        });
    });
    clicked
}

/// The robot, and what is known of it.
fn described(
    ui: &mut Ui,
    chosen: Robot<'_>,
    room: Vec2,
    camera: &mut Camera,
    workbench: &Workbench,
) {
    ui.spacing_mut().item_spacing.y = space::TIGHT;
    let size = vec2(room.x, room.y - FACTS);
    drawn(ui, chosen.robot().as_ref(), &chosen.title(), size, camera);
    match chosen {
        Robot::Library(robot) => known_of(ui, robot),
        Robot::Own(table) => {
            if let Err(problem) = table.robot() {
                widgets::wrong(ui, &spoken(&problem));
            }
            let joints = table.rows.len();
            let joints = say!(one "{count} joint", "{count} joints", count = joints);
            widgets::fact_of(ui, phrase!("kind"), joints);
            widgets::hint(ui, say!("Typed here, and remembered on this computer"));
            if widgets::secondary(ui, say!("Forget it")).clicked() {
                let name = table.name.clone();
                workbench.then(move |bench| bench.forget_robot(&name));
            }
        }
    }
}

/// A robot at its zero, where what was typed is one.
pub(super) fn drawn(
    ui: &mut Ui,
    robot: Option<&kinematics::Robot>,
    name: &str,
    size: Vec2,
    camera: &mut Camera,
) {
    if let Some(robot) = robot {
        let name = say!("{robot} at its zero", robot = name);
        robot_alone(ui, (robot, &name), camera, size);
    }
}

/// What is known of a robot of the library.
fn known_of(ui: &mut Ui, robot: &LibraryRobot) {
    let with = |value: Option<f64>, unit: &str| match value {
        Some(_) => format!("{} {unit}", figure(value)),
        None => "–".to_owned(),
    };
    widgets::fact_of(ui, phrase!("kind"), kind(robot));
    let [reach, load] = [with(robot.reach_mm, "mm"), with(robot.payload_kg, "kg")];
    widgets::fact_of(ui, phrase!("reach, load"), format!("{reach}, {load}"));
    widgets::fact_of(
        ui,
        phrase!("repeatability (ISO 9283)"),
        with(robot.repeatability_mm, "mm"),
    );
    let geometry = source(&robot.sources.geometry.source);
    let geometry = geometry.map_or("", |source| source.what.as_str());
    widgets::fact_of(ui, phrase!("geometry from"), geometry);
    if !robot.not_checked.is_empty() {
        let what = spoken(robot.not_checked());
        let says = say!("Not checked against a second source: {what}", what);
        let muted = Palette::of(ui).muted;
        ui.add(egui::Label::new(RichText::new(says).small().color(muted)).wrap());
    }
}

/// Its kind in the language of the window.
fn kind(robot: &LibraryRobot) -> String {
    use crate::robots::RobotKind;
    let says = match robot.kind {
        RobotKind::SixJoints => say!("six joints"),
        RobotKind::OffsetWrist => say!("six joints, offset wrist"),
        RobotKind::SevenJoints => say!("seven joints"),
        RobotKind::Scara => "SCARA",
        RobotKind::Positioner => say!("positioner"),
        RobotKind::RotaryAxis => say!("rotary axis"),
    };
    says.to_owned()
}

fn ends(ui: &mut Ui, chosen: Option<Robot<'_>>, entered: bool, workbench: &Workbench) {
    ui.add_space(space::ROW);
    let mut simulate = false;
    ui.columns(4, |columns| {
        widgets::other(&mut columns[0], say!("Cancel"))
            .does(workbench, move |bench| bench.show_sheet(None));
        let edit = |ui: &mut Ui| widgets::other(ui, say!("As a table…"));
        let edit = columns[1].add_enabled_ui(chosen.is_some(), edit).inner;
        let edit = edit.on_hover_text(say!("Change its table, or type a robot of your own"));
        if let (true, Some(robot)) = (edit.clicked(), chosen) {
            let table = Box::new(robot.table());
            workbench.then(move |bench| {
                bench.show_sheet(Some(Sheet::RobotTable {
                    opened: table.clone(),
                    table,
                }));
            });
        }
        let save = |ui: &mut Ui| widgets::other(ui, say!("Save robot file…"));
        let save = columns[2].add_enabled_ui(chosen.is_some(), save).inner;
        match (save.clicked(), chosen) {
            (true, Some(Robot::Library(robot))) => {
                workbench.then(move |bench| bench.choose_where_to_export(What::Robot(&robot.id)));
            }
            (true, Some(Robot::Own(table))) => {
                let table = table.clone();
                workbench.then(|bench| bench.keep_robot(table, true));
            }
            _ => {}
        }
        let primary = |ui: &mut Ui| widgets::primary(ui, say!("Simulate…"));
        let primary = columns[3].add_enabled_ui(chosen.is_some(), primary).inner;
        simulate = primary.clicked();
    });
    if let (true, Some(robot)) = (simulate || entered, chosen)
        && let Some(form) = robot.form()
    {
        workbench.then(move |bench| bench.show_sheet(Some(Sheet::Simulate(form))));
    }
}

// A robot that is typed: axes or Denavit–Hartenberg rows in a table, the robot drawn beside it.

/// Width of the table with axes and of that with rows, points.
const AXES: f32 = 708.0;
const DH: f32 = 594.0;
/// Width of the robot, at least and at most.
const TYPED_PICTURE: [f32; 2] = [230.0, 460.0];
/// Height of both, at least and at most, and of everything else in the sheet.
const TYPED_HEIGHT: [f32; 2] = [300.0, 520.0];
const TYPED_OTHER: f32 = 500.0;
/// A number, the name of a joint and how it moves: all of one height.
const NUMBER: f32 = 54.0;
const NAME: [f32; 2] = [76.0, 28.0];
const MOVES: [f32; 2] = [54.0, 28.0];

pub(super) fn typed(ui: &mut Ui, typed: &mut RobotTable, workbench: &Workbench) {
    let wide = if typed.form == TableForm::Axes {
        AXES
    } else {
        DH
    };
    let (window, room) = (ui.ctx().content_rect(), widgets::room_of_a_sheet(ui).x);
    let wide = wide.min(room);
    // The same of both forms: the sheet's height does not change with it.
    let picture = (room - AXES - f32::from(space::PANEL)).clamp(TYPED_PICTURE[0], TYPED_PICTURE[1]);
    let high = (window.height() - TYPED_OTHER).clamp(TYPED_HEIGHT[0], TYPED_HEIGHT[1]);
    // Where there is no room beside the table the robot stands below it.
    let both = wide + picture + f32::from(space::PANEL);
    let (layout, whole) = if both <= room {
        (egui::Layout::left_to_right(egui::Align::Min), both)
    } else {
        (egui::Layout::top_down(egui::Align::Min), wide)
    };
    ui.set_width(whole);
    widgets::heading(ui, say!("Robot as a table"));
    widgets::hint(
        ui,
        say!(
            "Nominal geometry as the maker states it; the robot is drawn at its zero as it is typed"
        ),
    );
    head(ui, typed);
    let made = typed.robot();
    ui.with_layout(layout, |ui| {
        ui.spacing_mut().item_spacing.x = f32::from(space::PANEL);
        let down = egui::Layout::top_down(egui::Align::Min);
        ui.allocate_ui_with_layout(vec2(wide, high), down, |ui| {
            ui.set_width(wide);
            let scroll = ScrollArea::both().id_salt("rows").auto_shrink(false);
            scroll.max_height(high).show(ui, |ui| {
                rows(ui, typed);
                widgets::focus_in_sight(ui);
            });
        });
        ui.vertical(|ui| {
            let id = ui.scope_id().with("camera");
            let mut camera: Camera = ui.data(|data| data.get_temp(id)).unwrap_or_default();
            let (robot, size) = (made.as_ref().ok(), vec2(picture, high));
            drawn(ui, robot, typed.name.trim(), size, &mut camera);
            ui.data_mut(|data| data.insert_temp(id, camera));
        });
    });
    frames(ui, typed);
    if let Err(problem) = &made {
        widgets::wrong(ui, &spoken(problem));
    }
    typed_ends(ui, typed, made.is_ok(), workbench);
}

/// Name of the robot, and in which terms it is typed.
fn head(ui: &mut Ui, typed: &mut RobotTable) {
    widgets::form_row(ui, say!("Name"), |ui| {
        let field = ui.add(TextEdit::singleline(&mut typed.name));
        widgets::label(&field, say!("Name of the robot"));
    });
    widgets::form_row(ui, say!("Joints as"), |ui| {
        let forms = [
            (
                TableForm::Axes,
                say!("axes"),
                say!("direction and a point of each axis at home, in the base frame"),
            ),
            (
                TableForm::Standard,
                say!("DH rows"),
                say!("Denavit–Hartenberg rows, standard: the joint before the link"),
            ),
            (
                TableForm::Modified,
                say!("modified DH rows"),
                say!("Denavit–Hartenberg rows, modified: the link before the joint"),
            ),
        ];
        if let Some(form) = widgets::segmented_named(ui, &forms, typed.form)
            && let Some(turned) = typed.turned_into(form)
        {
            *typed = turned;
        }
    });
}

/// The joints, one in a row.
fn rows(ui: &mut Ui, typed: &mut RobotTable) {
    let muted = Palette::of(ui).muted;
    let heads = typed.form.numbers();
    let mut gone = None;
    let several = typed.rows.len() > 1;
    Grid::new("joints")
        .min_col_width(0.0)
        .spacing(vec2(4.0, 4.0))
        .show(ui, |ui| {
            let head = |ui: &mut Ui, text: &str| {
                ui.label(RichText::new(text).small().color(muted));
            };
            head(ui, "");
            head(ui, say!("joint"));
            head(ui, say!("moves"));
            for (name, unit) in heads {
                let name = heading(name);
                let text = if unit.is_empty() {
                    name.to_owned()
                } else {
                    format!("{name}, {unit}")
                };
                // No wider than the numbers below it.
                ui.label(RichText::new(text).size(size::TINY).color(muted));
            }
            head(ui, say!("from"));
            head(ui, say!("to"));
            head(ui, "");
            ui.end_row();
            for (index, row) in typed.rows.iter_mut().enumerate() {
                head(ui, &(index + 1).to_string());
                joint(ui, index + 1, row, heads);
                let remove =
                    ui.add_enabled(several, Button::new("×").min_size(vec2(24.0, NAME[1])));
                widgets::label(&remove, say!("Remove joint {joint}", joint = index + 1));
                if remove.clicked() {
                    gone = Some(index);
                }
                ui.end_row();
            }
        });
    if let Some(index) = gone {
        typed.remove(index);
    }
    let room = typed.rows.len() < RobotTable::MOST_JOINTS;
    if ui
        .add_enabled(room, Button::new(say!("Add a joint")))
        .clicked()
    {
        typed.add();
    }
}

fn heading(name: &'static str) -> &'static str {
    match name {
        "axis x" => say!("axis x"),
        "point x" => say!("point x"),
        sign => sign,
    }
}

/// One joint: its name, whether it turns, its numbers and its travel.
fn joint(ui: &mut Ui, number: usize, row: &mut Row, heads: &[(&'static str, &'static str)]) {
    let name = ui.add_sized(NAME, TextEdit::singleline(&mut row.name));
    widgets::label(&name, say!("Name of joint {joint}", joint = number));
    let says = if row.slides {
        say!(in "joint", "slides")
    } else {
        say!(in "joint", "turns")
    };
    let kind = ui.add_sized(MOVES, Button::new(says));
    widgets::label(
        &kind,
        if row.slides {
            say!("Joint {joint} slides", joint = number)
        } else {
            say!("Joint {joint} turns", joint = number)
        },
    );
    if kind.clicked() {
        row.slides = !row.slides;
    }
    for (k, (value, (name, unit))) in row.numbers.iter_mut().zip(heads).enumerate() {
        // The second and third of three stand behind the heading of the first.
        let of = ["axis", "axis", "axis", "point", "point", "point"][k];
        let name = if heads.len() == 6 && name.len() == 1 {
            format!("{of} {name}")
        } else {
            (*name).to_owned()
        };
        let label = say!("{number} of joint {joint}", number = name, joint = number);
        cell(ui, &label, unit, value);
    }
    let unit = row.unit();
    let mut travel = row.travel.is_some();
    let [mut from, mut to] = row.travel.unwrap_or([-180.0, 180.0]);
    let ends = [
        (
            say!("Travel of joint {joint}, from", joint = number),
            &mut from,
        ),
        (say!("Travel of joint {joint}, to", joint = number), &mut to),
    ];
    // Each a row of its own height: what is switched off or unknown would else hang below the others.
    for (label, value) in ends {
        ui.horizontal(|ui| {
            if !travel {
                ui.disable();
            }
            cell(ui, &label, unit, value);
        });
    }
    let known = ui.checkbox(&mut travel, "");
    let known = known.on_hover_text(say!("The travel of the joint is known"));
    widgets::label(
        &known,
        say!("The travel of joint {joint} is known", joint = number),
    );
    row.travel = travel.then_some([from, to]);
}

fn cell(ui: &mut Ui, label: &str, unit: &str, value: &mut f64) {
    let value = std::slice::from_mut(value);
    widgets::numbers(ui, (label, unit), &[""], value, (NUMBER, 1.0));
}

/// Where the rows begin, where the tool is, and which way gravity points.
fn frames(ui: &mut Ui, typed: &mut RobotTable) {
    let signs = ["x", "y", "z", "A", "B", "C"];
    let six = |ui: &mut Ui, row: &str, values: &mut [f64; 6]| {
        widgets::form_row(ui, row, |ui| {
            let (at, turned) = values.split_at_mut(3);
            widgets::numbers(ui, (row, "mm"), &signs[..3], at, (NUMBER, 1.0));
            widgets::numbers(ui, (row, "°"), &signs[3..], turned, (NUMBER, 1.0));
        });
    };
    if typed.form != TableForm::Axes {
        six(ui, say!("Base of the rows"), &mut typed.base);
    }
    six(ui, say!("Tool"), &mut typed.tool);
    widgets::hint(
        ui,
        say!("x, y, z in mm; A, B, C in degrees about z, the new y and the new x"),
    );
    let mut down = typed.gravity.is_some();
    if ui
        .checkbox(&mut down, say!("gravity points along −z"))
        .changed()
    {
        typed.gravity = down.then_some([0.0, 0.0, -9.81]);
    }
}

fn typed_ends(ui: &mut Ui, typed: &RobotTable, sound: bool, workbench: &Workbench) {
    ui.add_space(space::ROW);
    ui.columns(3, |columns| {
        widgets::other(&mut columns[0], say!("Cancel")).does(workbench, move |bench| {
            bench.show_sheet(Some(Sheet::ROBOTS));
        });
        let save = |ui: &mut Ui| widgets::other(ui, say!("Save robot file…"));
        let save = columns[1].add_enabled_ui(sound, save).inner;
        let simulate = |ui: &mut Ui| widgets::primary(ui, say!("Simulate…"));
        let simulate = columns[2].add_enabled_ui(sound, simulate).inner;
        save.does(workbench, move |bench| bench.show_sheet(None));
        if save.clicked() || simulate.clicked() {
            let (table, save) = (typed.clone(), save.clicked());
            workbench.then(move |bench| bench.keep_robot(table, save));
        }
        if let (true, Some(robot)) = (simulate.clicked(), SimulatedRobot::typed(typed)) {
            let form = simulate::Form::of(robot);
            workbench.then(move |bench| bench.show_sheet(Some(Sheet::Simulate(form))));
        }
    });
}
