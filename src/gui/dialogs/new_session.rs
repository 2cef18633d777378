//! A session that is made here by simulation, of a robot of the library or one that was typed.

use crate::gui::workbench::Workbench;
use egui::{Align, Button, ComboBox, DragValue, Layout, ScrollArea, Ui, vec2};

use crate::kinematics::JointKind;
use crate::text::{Template, spoken};

use crate::gui::core::simulate::{Chosen, Form, field};
use crate::gui::style::space;
use crate::gui::view::Sheet;
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};

/// Wide enough for an effect with a joint and three numbers in one row, points.
const WIDTH: f32 = 640.0;

/// Width of the names of effects, points.
const NAMES: f32 = 168.0;
/// Height of the list of effects, at least and at most, and of everything else in the sheet.
const LIST: [f32; 2] = [190.0, 420.0];
const OTHER: f32 = 610.0;

pub(super) fn simulation(ui: &mut Ui, form: &mut Form, workbench: &Workbench) {
    widgets::wide(ui, WIDTH);
    ui.heading(&form.robot.title);
    ui.hint(say!(
        "Random poses within the joint limits, three reflectors at the tool, speeds, loads and a warm-up mixed. The effects below are hidden in the robot: identification and diagnosis should find them"
    ));
    if form.is_of_the_lamp() {
        ui.secondary(say!("Another robot…"))
            .does(workbench, move |bench| {
                bench.show_sheet(Some(Sheet::Robots));
            });
    }
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
    ends(ui, form, workbench);
}

/// What is wrong as a whole, and the buttons; what was changed stays in the sheet.
fn ends(ui: &mut Ui, form: &Form, workbench: &Workbench) {
    if !form.problems().is_empty() {
        ui.hint(say!("Correct the fields marked above first"));
    }
    let ready = form.problem().is_none();
    let form = form.clone();
    match ui.foot([(say!("Cancel"), true), (say!("Simulate"), ready)]) {
        Some(0) => workbench.then(|bench| bench.show_sheet(Sheet::Simulate(form).before())),
        Some(_) => workbench.then(|bench| bench.simulate(form)),
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
    ui.number(spoken(name), unit, value);
    fault(ui, wrong, name.english());
}

fn effects(ui: &mut Ui, form: &mut Form, wrong: &Wrong) {
    let mut gone = None;
    let kinds: Vec<JointKind> = (1..=form.joints()).map(|j| form.joint_kind(j)).collect();
    let window = ui.ctx().content_rect().height();
    let high = (window - OTHER).clamp(LIST[0], LIST[1]);
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
