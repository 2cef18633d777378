//! The form of a new simulation.

use crate::text::{Template, spoken};
use egui::{Checkbox, ComboBox, DragValue, RichText, ScrollArea, Ui};

use crate::gui::core::simulate::{Chosen, Form, field};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::Sheet;
use crate::gui::widgets;
use crate::gui::workbench::Command;

pub(super) fn show(ui: &mut Ui, form: &Form, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
    widgets::heading(ui, say!("Simulate session"));
    widgets::hint(
        ui,
        say!(
            "A lamp on one turning axis, measured by a tracker. What is filled in here is what identification should find"
        ),
    );
    let mut filled = form.clone();
    let wrong = form.problems();
    ui.spacing_mut().item_spacing.x = f32::from(space::PANEL) * 1.5;
    ui.columns(2, |columns| {
        for column in columns.iter_mut() {
            column.spacing_mut().item_spacing.x = space::ROW;
        }
        robot(&mut columns[0], &mut filled, &wrong);
        measurement(&mut columns[1], &mut filled, &wrong);
    });
    ui.spacing_mut().item_spacing.x = space::ROW;
    widgets::section(ui, say!("Other effects"));
    effects(ui, &mut filled, &wrong);
    ends(ui, filled, form, commands);
}

/// What is wrong as a whole, and the buttons; what was changed stays in the sheet.
pub(super) fn ends(ui: &mut Ui, filled: Form, form: &Form, commands: &mut Vec<Command>) {
    if !form.problems().is_empty() {
        widgets::hint(
            ui,
            say!("What stands in colour above has to be another number first"),
        );
    }
    let ready = filled.problem().is_none();
    if super::ends::buttons_without_enter(ui, say!("Simulate"), ready, commands) {
        commands.push(Command::Simulate(filled));
    } else if filled != *form {
        commands.push(Command::Sheet(Some(Sheet::Simulate(filled))));
    }
}

/// What is wrong, each with the field that it is about.
pub(super) type Wrong = [(&'static str, String)];

/// Says what is wrong with a field, below it.
fn fault(ui: &mut Ui, wrong: &Wrong, name: &str) {
    for (_, says) in wrong.iter().filter(|(place, _)| *place == name) {
        widgets::wrong(ui, says);
    }
}

/// A field with what is wrong with it.
pub(super) fn number(
    ui: &mut Ui,
    wrong: &Wrong,
    (name, unit): (Template, &str),
    value: DragValue<'_>,
) {
    widgets::number(ui, spoken(name), unit, value);
    fault(ui, wrong, name.english());
}

fn robot(ui: &mut Ui, form: &mut Form, wrong: &Wrong) {
    widgets::section(ui, say!("Robot"));
    let mm = |value| {
        DragValue::new(value)
            .speed(0.1)
            .max_decimals(4)
            .suffix(" mm")
    };
    let deg = |value| {
        DragValue::new(value)
            .speed(0.05)
            .max_decimals(4)
            .suffix("°")
    };
    number(ui, wrong, (field::RADIUS, "mm"), mm(&mut form.radius_mm));
    number(ui, wrong, (field::OFFSET, "°"), deg(&mut form.offset_deg));
    number(
        ui,
        wrong,
        (field::LENGTH, "mm"),
        mm(&mut form.length_error_mm),
    );
    widgets::section(ui, say!("Tolerance"));
    number(
        ui,
        wrong,
        (field::TOLERANCE, "mm"),
        mm(&mut form.tolerance_mm),
    );
}

fn measurement(ui: &mut Ui, form: &mut Form, wrong: &Wrong) {
    widgets::section(ui, say!("Sweep"));
    let deg = |value| DragValue::new(value).speed(0.5).max_decimals(3).suffix("°");
    number(ui, wrong, (field::FROM, "°"), deg(&mut form.from_deg));
    number(ui, wrong, (field::TO, "°"), deg(&mut form.to_deg));
    number(ui, wrong, (field::STEP, "°"), deg(&mut form.step_deg));
    ui.add(Checkbox::new(&mut form.both_ways, say!("there and back")));
    widgets::section(ui, say!("Instrument"));
    let noise = DragValue::new(&mut form.noise_mm)
        .speed(0.002)
        .max_decimals(4);
    number(ui, wrong, (field::NOISE, "mm"), noise.suffix(" mm"));
    widgets::number(ui, say!("seed"), "", DragValue::new(&mut form.seed));
}

pub(super) fn effects(ui: &mut Ui, form: &mut Form, wrong: &Wrong) {
    let mut gone = None;
    ScrollArea::vertical().max_height(150.0).show(ui, |ui| {
        for (index, chosen) in form.effects.iter_mut().enumerate() {
            ui.horizontal_wrapped(|ui| {
                let title = crate::present::names::title(chosen.id);
                ui.label(title);
                if let (true, Some(robot)) = (chosen.per_joint(), &form.robot) {
                    let joints = robot.robot.joint_count();
                    let field = DragValue::new(&mut chosen.joint).range(1..=joints);
                    ui.label(say!("joint"));
                    let label = format!("{} {}", chosen.id, say!("joint"));
                    widgets::cell_number(ui, &label, "", 40.0, field);
                }
                for (name, value) in &mut chosen.parameters {
                    let muted = Palette::of(ui).muted;
                    ui.label(RichText::new(*name).size(size::SMALL).color(muted));
                    let field = DragValue::new(value).speed(0.01).max_decimals(5);
                    let label = format!("{} {name}", chosen.id);
                    widgets::cell_number(ui, &label, "", 64.0, field);
                }
                if ui.small_button(say!("Remove")).clicked() {
                    gone = Some(index);
                }
            });
            fault(ui, wrong, chosen.id);
        }
    });
    if let Some(index) = gone {
        form.effects.remove(index);
    }
    let list = ComboBox::from_id_salt("add effect")
        .selected_text(say!("Add an effect…"))
        .width(240.0)
        .show_ui(ui, |ui| {
            for (id, title) in Form::offered() {
                let there = form.effects.iter().any(|c| c.id == id);
                let button = ui.add_enabled(!there, egui::Button::new(title));
                if button.clicked()
                    && let Some(chosen) = Chosen::new(id)
                {
                    form.effects.push(chosen);
                }
            }
        });
    widgets::label(&list.response, say!("Add an effect"));
}
