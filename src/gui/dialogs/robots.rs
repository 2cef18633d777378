//! The library of robots and one's own: found by typing, drawn as they are chosen, saved; and a session that is
//! simulated of one of them.

use std::sync::Arc;

use egui::{
    Align, Button, ComboBox, DragValue, Key, Layout, Modifiers, Role, ScrollArea, Sense, TextEdit,
    Ui, Vec2, WidgetInfo, vec2,
};

use crate::gui::core::robot_table::RobotTable;
use crate::gui::core::setup::SetupForm;
use crate::gui::core::simulate::{Chosen, Form, SimulatedRobot, field};
use crate::gui::style::space;
use crate::gui::view::{Camera, NextAction, Sheet, What};
use crate::gui::widgets::{self, Buttons, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::robot_alone;
use crate::kinematics::JointKind;
use crate::language::spoken;
use crate::present::robots_v1::figure;
use crate::robots::{LibraryRobot, find, source};
use crate::text::Template;

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
            Self::Library(robot) => robot
                .reach_mm
                .map_or(String::new(), |mm| format!("{mm} mm")),
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
    pub(super) fn made(self) -> Option<Arc<SimulatedRobot>> {
        match self {
            Self::Own(table) => SimulatedRobot::typed(table),
            Self::Library(robot) => Some(SimulatedRobot::of(robot)),
        }
    }
}

pub(super) fn robots(ui: &mut Ui, workbench: &Workbench) {
    let (wide, room) = sizes(ui);
    ui.set_width(wide + room.x + f32::from(space::PANEL));
    ui.heading(say!("Robots"));
    let id = ui.scope_id().with("typed robot");
    let before: Option<RobotsInput> = ui.data(|data| data.get_temp(id));
    let mut typed = before.unwrap_or_default();
    let steps = [(Key::ArrowUp, -1), (Key::ArrowDown, 1)];
    let field = TextEdit::singleline(&mut typed.text).hint_text(examples());
    let line = vec2(ui.available_width(), space::PRIMARY);
    let field = ui.add_sized(line, field.align(egui::Align2::LEFT_CENTER));
    widgets::label(&field, say!("Find a robot"));
    // What is typed or pressed is for the field, unless something else was gone to.
    if ui.memory(|memory| memory.focused().is_none()) && !field.lost_focus() {
        field.request_focus();
        widgets::select_all(ui, field.id, &typed.text);
    }
    let found = Robot::found(workbench.typed_robots(), &typed.text);
    let mut at = found.iter().position(|robot| robot.key() == typed.chosen);
    if field.changed() || at.is_none() {
        at = (!found.is_empty()).then_some(0);
    }
    let mut moved = field.changed();
    if field.has_focus() {
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
            None => ui.hint(say!("No robot has this name")),
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
    if let Some(made) = chosen.made() {
        robot_alone(ui, (&made.robot, &chosen.title()), camera, size);
    }
    match chosen {
        Robot::Library(robot) => known_of(ui, robot),
        Robot::Own(table) => {
            if let Err(problem) = table.robot() {
                ui.wrong(&spoken(&problem));
            }
            let joints = table.rows.len();
            let joints = say!(one "{count} joint", "{count} joints", count = joints);
            ui.fact(say!("kind"), joints);
            if ui.secondary(say!("Forget it")).clicked() {
                let name = table.name.clone();
                workbench.then(move |bench| bench.forget_robot(&name));
            }
        }
    }
}

/// What is known of a robot of the library.
fn known_of(ui: &mut Ui, robot: &LibraryRobot) {
    let with = |value: Option<f64>, unit: &str| match value {
        Some(_) => format!("{} {unit}", figure(value)),
        None => "–".to_owned(),
    };
    ui.fact(say!("kind"), kind(robot));
    let [reach, load] = [with(robot.reach_mm, "mm"), with(robot.payload_kg, "kg")];
    ui.fact(say!("reach, load"), format!("{reach}, {load}"));
    ui.fact(
        say!("repeatability (ISO 9283)"),
        with(robot.repeatability_mm, "mm"),
    );
    let geometry = source(&robot.sources.geometry.source);
    let geometry = geometry.map_or("", |source| source.what.as_str());
    ui.fact(say!("geometry from"), geometry);
    if !robot.not_checked.is_empty() {
        let what = spoken(robot.not_checked());
        let says = say!("Not checked against a second source: {what}", what);
        ui.caption(&says);
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

/// What is done with the one that is chosen.
fn ends(ui: &mut Ui, chosen: Option<Robot<'_>>, entered: bool, workbench: &Workbench) {
    let any = chosen.is_some();
    let pressed = ui.foot([
        (say!("Cancel"), true),
        (&*widgets::dots(say!("Robot as a table")), any),
        (&*widgets::dots(say!("Save robot file")), any),
        (&*widgets::dots(say!("Simulate")), any),
    ]);
    match (pressed, chosen) {
        (Some(0), _) => workbench.then(|bench| bench.show_sheet(None)),
        (Some(1), Some(robot)) => {
            let form = SetupForm {
                robot: robot.table(),
                measured: None,
            };
            workbench.then(|bench| bench.show_sheet(Some(Sheet::set_up(form))));
        }
        (Some(2), Some(Robot::Library(robot))) => {
            workbench.then(|bench| bench.choose_where_to_export(What::Robot(&robot.id)));
        }
        (Some(2), Some(Robot::Own(table))) => {
            let table = table.clone();
            workbench.then(|bench| bench.keep_robot(table, true));
        }
        (_, Some(robot)) if pressed.is_some() || entered => {
            if let Some(made) = robot.made() {
                workbench.then(|bench| bench.show_sheet(Some(Sheet::Simulate(Form::of(made)))));
            }
        }
        _ => {}
    }
}

// A session that is simulated of one of them.

/// Wide enough for an effect with a joint and three numbers in one row, points.
const SIMULATION: f32 = 640.0;

/// Width of the names of effects, points.
const NAMES: f32 = 168.0;
/// Height of the list of effects, at least and at most, and of everything else in the sheet.
const EFFECTS: [f32; 2] = [190.0, 420.0];
const AROUND: f32 = 610.0;

pub(super) fn simulation(ui: &mut Ui, form: &mut Form, workbench: &Workbench) {
    widgets::head(ui, SIMULATION, &form.robot.title);
    ui.hint(say!(
        "Random poses within the joint limits, three reflectors at the tool, speeds, loads and a warm-up mixed"
    ));
    let wrong = form.problems();
    ui.section(say!("Measurement"));
    let poses = DragValue::new(&mut form.poses).speed(1.0);
    number(ui, &wrong, (field::POSES, ""), poses);
    let noise = DragValue::new(&mut form.noise_mm)
        .speed(0.002)
        .max_decimals(4);
    number(ui, &wrong, (field::NOISE, "mm"), noise.suffix(" mm"));
    let seed = DragValue::new(&mut form.seed);
    ui.number(say!("random seed"), "", seed);
    ui.section(say!("Hidden effects"));
    effects(ui, form, &wrong);
    let form = form.clone();
    match ui.foot([(say!("Cancel"), true), (say!("Simulate"), wrong.is_empty())]) {
        Some(0) => workbench.then(|bench| bench.show_sheet(Sheet::Simulate(form).before())),
        Some(_) => workbench.then(|bench| bench.ask_then(NextAction::Simulate(form))),
        None => {}
    }
}

/// What is wrong, each with the field that it is about.
type Wrong = [(&'static str, String)];

/// Says what is wrong with a field, below it.
fn fault(ui: &mut Ui, wrong: &Wrong, name: &str) {
    for (_, says) in wrong.iter().filter(|(place, _)| *place == name) {
        ui.wrong(says);
    }
}

/// A field with what is wrong with it.
fn number(ui: &mut Ui, wrong: &Wrong, (name, unit): (Template, &str), value: DragValue<'_>) {
    ui.number(crate::text::spoken(name), unit, value);
    fault(ui, wrong, name.english());
}

fn effects(ui: &mut Ui, form: &mut Form, wrong: &Wrong) {
    let mut gone = None;
    let kinds: Vec<JointKind> = (1..=form.joints()).map(|j| form.joint_kind(j)).collect();
    let window = ui.ctx().content_rect().height();
    let high = (window - AROUND).clamp(EFFECTS[0], EFFECTS[1]);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        for (index, chosen) in form.effects.iter_mut().enumerate() {
            if effect(ui, chosen, &kinds) {
                gone = Some(index);
            }
            fault(ui, wrong, chosen.id);
        }
        widgets::focus_in_sight(ui);
    });
    if let Some(index) = gone {
        form.effects.remove(index);
    }
    let list =
        ComboBox::from_id_salt("add effect").selected_text(widgets::dots(say!("Add an effect")));
    let list = list.width(240.0).height(360.0).show_ui(ui, |ui| {
        for (id, title) in form.offered() {
            let another = form.another(id);
            let row = Button::selectable(false, title);
            if ui.add_enabled(another.is_some(), row).clicked() {
                form.effects.extend(another);
            }
        }
    });
    widgets::label(&list.response, say!("Add an effect"));
}

/// One effect: its joint where the robot has several, and its numbers; whether it is to be removed.
fn effect(ui: &mut Ui, chosen: &mut Chosen, kinds: &[JointKind]) -> bool {
    let title = crate::present::names::title(chosen.id);
    ui.row(|ui| {
        let remove = ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let says = say!("Remove {effect}", effect = title);
            let button = ui.named(&*says, Button::new("×").min_size(vec2(24.0, 24.0)));
            let clicked = button.on_hover_text(says).clicked();
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                // What stands below one another begins in one line.
                let name = vec2(NAMES, space::CONTROL);
                ui.allocate_ui_with_layout(name, Layout::left_to_right(Align::Center), |ui| {
                    ui.set_width(NAMES);
                    ui.add(egui::Label::new(title).wrap());
                });
                if chosen.per_joint() && kinds.len() > 1 {
                    let field = DragValue::new(&mut chosen.joint).range(1..=kinds.len());
                    ui.caption(say!("joint"));
                    let label = format!("{title} {}", say!("joint"));
                    if ui.cell_number(&label, "", 32.0, field).changed() {
                        chosen.suits(kinds[chosen.joint - 1]);
                    }
                }
                for (name, value) in &mut chosen.parameters {
                    let (words, unit) = crate::present::names::parameter(name);
                    ui.caption(&words);
                    let gap = if ["", "°"].contains(&unit) { "" } else { " " };
                    let field = DragValue::new(value).speed(0.01).max_decimals(5);
                    let field = field.suffix(format!("{gap}{unit}"));
                    let label = format!("{title} {words}");
                    ui.cell_number(&label, unit, 72.0, field);
                }
            });
            clicked
        });
        remove.inner
    })
}
