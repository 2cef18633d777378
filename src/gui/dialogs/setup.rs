//! A robot that is typed: axes or Denavit–Hartenberg rows in a table, the robot drawn beside it; that of the open session
//! with its reflectors and its instrument.

use egui::{Button, Checkbox, Grid, RichText, ScrollArea, TextEdit, Ui, vec2};
use nalgebra::Point3;

use crate::gui::core::robot_table::{RobotTable, Row, TableForm};
use crate::gui::core::setup::{Measured, SetupForm};
use crate::gui::core::simulate::{self, SimulatedRobot};
use crate::gui::help;
use crate::gui::style::{size, space};
use crate::gui::view::{Camera, Sheet};
use crate::gui::widgets::{self, Buttons, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::sessions::{Session, Sigma, Target};
use crate::text::capital;

use crate::gui::workspace::robot_alone;

/// Width of the table with axes and of that with rows, points.
const AXES: f32 = 708.0;
const DH: f32 = 594.0;
/// Width of the robot, at least and at most.
const TYPED_PICTURE: [f32; 2] = [230.0, 460.0];
/// Height of both, at least and at most, and of everything else in the sheet.
const TYPED_HEIGHT: [f32; 2] = [300.0, 520.0];
const TYPED_OTHER: f32 = 500.0;
const XYZ: [&str; 3] = ["x", "y", "z"];
/// A number, the name of a joint and how it moves: all of one height.
const NUMBER: f32 = 54.0;
const NAME: [f32; 2] = [76.0, 28.0];
const MOVES: [f32; 2] = [54.0, 28.0];

pub(super) fn show(ui: &mut Ui, form: &mut SetupForm, workbench: &Workbench) {
    let SetupForm {
        robot: typed,
        measured,
    } = form;
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
    let heading = if measured.is_some() {
        say!("Robot and instrument")
    } else {
        say!("Robot as a table")
    };
    ui.heading(heading);
    head(ui, typed);
    let made = typed.robot();
    ui.with_layout(layout, |ui| {
        ui.spacing_mut().item_spacing.x = f32::from(space::PANEL);
        let down = egui::Layout::top_down(egui::Align::Min);
        ui.allocate_ui_with_layout(vec2(wide, high), down, |ui| {
            ui.set_width(wide);
            let scroll = ScrollArea::both().id_salt("rows").auto_shrink(false);
            scroll.max_height(high).show(ui, |ui| {
                rows(ui, typed, measured.is_none());
                ui.collapsing(say!("Masses of links"), |ui| masses(ui, &mut typed.rows));
                if let Some(measured) = measured {
                    let session = &workbench.loaded_session().session;
                    ui.collapsing(capital(say!("reflectors")), |ui| {
                        targets(ui, measured, session);
                    });
                    ui.collapsing(capital(say!("instrument")), |ui| instrument(ui, measured));
                }
                widgets::focus_in_sight(ui);
            });
        });
        ui.vertical(|ui| {
            let id = ui.scope_id().with("camera");
            let mut camera: Camera = ui.data(|data| data.get_temp(id)).unwrap_or_default();
            if let Ok(robot) = &made {
                let named = (robot, typed.name.trim());
                robot_alone(ui, named, &mut camera, vec2(picture, high));
            }
            ui.data_mut(|data| data.insert_temp(id, camera));
        });
    });
    frames(ui, typed);
    let problem = form.problem();
    if let Some(problem) = &problem {
        ui.wrong(problem);
    }
    ends(ui, form, problem.is_none(), workbench);
}

/// The robot within another sheet.
pub(super) fn table(ui: &mut Ui, typed: &mut RobotTable) {
    head(ui, typed);
    ScrollArea::horizontal().show(ui, |ui| rows(ui, typed, true));
    frames(ui, typed);
}

/// Name of the robot, and in which terms it is typed.
fn head(ui: &mut Ui, typed: &mut RobotTable) {
    ui.form_row(&capital(say!("name")), |ui| {
        let field = TextEdit::singleline(&mut typed.name);
        ui.named(say!("Name of the robot"), field);
    });
    ui.form_row(say!("Joints as"), |ui| {
        let forms = [
            (TableForm::Axes, say!("axes")),
            (TableForm::Standard, say!("DH rows")),
            (TableForm::Modified, say!("modified DH rows")),
        ];
        let form = ui.segmented(&forms, typed.form);
        if let Some(turned) = form.and_then(|form| typed.turned_into(form)) {
            *typed = turned;
        }
        ui.question(help::AXIS);
    });
}

/// The joints, one in a row; whether there may be more and fewer of them: a session has a value of each.
fn rows(ui: &mut Ui, typed: &mut RobotTable, any: bool) {
    let heads = typed.form.numbers();
    let mut gone = None;
    let several = any && typed.rows.len() > 1;
    Grid::new("joints")
        .min_col_width(0.0)
        .spacing(vec2(4.0, 4.0))
        .show(ui, |ui| {
            for head in ["", say!("joint"), say!("moves")] {
                ui.caption(head);
            }
            for (name, unit) in heads {
                let name = heading(name);
                let text = if unit.is_empty() {
                    name.to_owned()
                } else {
                    format!("{name}, {unit}")
                };
                // No wider than the numbers below it.
                ui.label(RichText::new(text).size(size::TINY).weak());
            }
            for head in [say!("from"), say!("to"), ""] {
                ui.caption(head);
            }
            ui.end_row();
            for (index, row) in typed.rows.iter_mut().enumerate() {
                let number = index + 1;
                ui.caption(&number.to_string());
                joint(ui, number, row, heads);
                let remove = Button::new("×").min_size(vec2(24.0, NAME[1]));
                let remove = ui.add_enabled(several, remove);
                widgets::label(
                    &remove,
                    say!(
                        "Remove {effect}",
                        effect = say!("joint {joint}", joint = number)
                    ),
                );
                if remove.clicked() {
                    gone = Some(index);
                }
                ui.end_row();
            }
        });
    if let Some(index) = gone {
        typed.remove(index);
    }
    let room = any && typed.rows.len() < RobotTable::MOST_JOINTS;
    let add = ui.add_enabled(room, Button::new(say!("Add a joint")));
    if add.clicked() {
        typed.add();
    }
}

fn heading(name: &'static str) -> &'static str {
    match name {
        "axis x" => say!("axis x"),
        "point x" => say!("point x"),
        // The second and third of three stand behind the heading of the first.
        "axis y" | "point y" => "y",
        "axis z" | "point z" => "z",
        sign => sign,
    }
}

/// One joint: its name, whether it turns, its numbers and its travel.
fn joint(ui: &mut Ui, number: usize, row: &mut Row, heads: &[(&'static str, &'static str)]) {
    let named = |what: &str| format!("{}: {what}", say!("joint {joint}", joint = number));
    let name = ui.add_sized(NAME, TextEdit::singleline(&mut row.name));
    widgets::label(&name, named(say!("name")));
    let moves = if row.slides {
        say!(in "joint", "slides")
    } else {
        say!(in "joint", "turns")
    };
    let kind = ui.add_sized(MOVES, Button::new(moves));
    widgets::label(&kind, named(moves));
    row.slides ^= kind.clicked();
    for (value, (name, unit)) in row.numbers.iter_mut().zip(heads) {
        cell(ui, &named(name), unit, value);
    }
    let unit = row.unit();
    let mut travel = row.travel.is_some();
    let [mut from, mut to] = row.travel.unwrap_or([-180.0, 180.0]);
    // Each a row of its own height: what is switched off or unknown would else hang below the others.
    for (end, value) in [(say!("from"), &mut from), (say!("to"), &mut to)] {
        ui.horizontal(|ui| {
            if !travel {
                ui.disable();
            }
            cell(ui, &named(end), unit, value);
        });
    }
    let name = say!("The travel of joint {joint} is known", joint = number);
    let known = ui.named(name.clone(), Checkbox::without_text(&mut travel));
    known.on_hover_text(name);
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
        ui.form_row(row, |ui| {
            let (at, turned) = values.split_at_mut(3);
            widgets::numbers(ui, (row, "mm"), &signs[..3], at, (NUMBER, 1.0));
            widgets::numbers(ui, (row, "°"), &signs[3..], turned, (NUMBER, 1.0));
            if row == capital(say!("tool")) {
                ui.question(help::TOOL);
            }
        });
    };
    if typed.form != TableForm::Axes {
        six(ui, say!("Base of the rows"), &mut typed.base);
    }
    six(ui, &capital(say!("tool")), &mut typed.tool);
    ui.hint(say!(
        "x, y, z in mm; A, B, C in degrees about z, the new y and the new x"
    ));
    ui.form_row(&capital(say!("gravity")), |ui| {
        let mut known = typed.gravity.is_some();
        if ui.checkbox(&mut known, say!("is known, m/s²")).changed() {
            typed.gravity = known.then_some([0.0, 0.0, -9.81]);
        }
        if let Some(gravity) = &mut typed.gravity {
            widgets::numbers(
                ui,
                (&capital(say!("gravity")), ""),
                &XYZ,
                gravity,
                (NUMBER, 0.01),
            );
        }
    });
}

/// What of each link is carried: its mass and where its centre is.
fn masses(ui: &mut Ui, rows: &mut [Row]) {
    ui.caption(say!("kg, and the centre at home in the base frame, mm"));
    for (k, row) in rows.iter_mut().enumerate() {
        let n = k + 1;
        ui.form_row(&row.name, |ui| {
            let mut known = row.link.is_some();
            let name = say!("The mass of link {n} is known", n);
            if ui.named(name, Checkbox::without_text(&mut known)).changed() {
                let [.., x, y, z] = row.numbers;
                row.link = known.then_some((1.0, [x, y, z]));
            }
            if let Some((mass, centre_mm)) = &mut row.link {
                cell(ui, &say!("Mass {n}", n), "kg", mass);
                let name = say!("Centre {n}", n);
                widgets::numbers(ui, (&name, "mm"), &XYZ, centre_mm, (NUMBER, 1.0));
            }
        });
    }
}

fn targets(ui: &mut Ui, measured: &mut Measured, session: &Session) {
    ui.caption(say!("in the tool frame, mm"));
    let free = measured.last_target_is_free(session);
    for (k, target) in measured.targets.iter_mut().enumerate() {
        let n = k + 1;
        ui.horizontal(|ui| {
            let name = ui.add_sized(NAME, TextEdit::singleline(&mut target.name));
            let at = target.position_mm.coords.as_mut_slice();
            let of = say!("Reflector {n}", n);
            widgets::numbers(ui, (&of, "mm"), &XYZ, at, (NUMBER, 0.1));
            widgets::label(&name, of);
        });
    }
    if free && ui.link(say!("Remove the last reflector")).clicked() {
        measured.targets.pop();
    }
    if ui.link(say!("Add a reflector")).clicked() {
        let name = format!("T{}", measured.targets.len() + 1);
        let position_mm = Point3::origin();
        measured.targets.push(Target { name, position_mm });
    }
}

fn instrument(ui: &mut Ui, measured: &mut Measured) {
    ui.form_row(&capital(say!("name")), |ui| {
        let field = TextEdit::singleline(&mut measured.instrument);
        ui.named(say!("Name of the instrument"), field);
    });
    let (kind, size) = match measured.sigma {
        None => (0, 0.03),
        Some(Sigma::Overall(sigma)) => (1, sigma),
        Some(Sigma::PerAxis([x, y, z])) => (3, ((x * x + y * y + z * z) / 3.0).sqrt()),
    };
    let kinds = [
        (0, say!("unknown")),
        (1, say!("one number")),
        (3, "x, y, z"),
    ];
    ui.form_row(&format!("{}, mm", say!("noise, one σ")), |ui| {
        if let Some(kind) = ui.segmented(&kinds, kind) {
            measured.sigma = match kind {
                0 => None,
                1 => Some(Sigma::Overall(size)),
                _ => Some(Sigma::PerAxis([size; 3])),
            };
        }
        let (parts, values) = match &mut measured.sigma {
            None => (&[][..], &mut [][..]),
            Some(Sigma::Overall(sigma)) => (&[""][..], std::slice::from_mut(sigma)),
            Some(Sigma::PerAxis(sigma)) => (&XYZ[..], &mut sigma[..]),
        };
        widgets::numbers(
            ui,
            (&capital(say!("noise")), "mm"),
            parts,
            values,
            (NUMBER, 0.001),
        );
        ui.question(help::NOISE);
    });
}

fn ends(ui: &mut Ui, form: &SetupForm, sound: bool, workbench: &Workbench) {
    let of_session = form.measured.is_some();
    let primary = if of_session {
        say!("Use it here").to_owned()
    } else {
        widgets::dots(say!("Simulate"))
    };
    let cancel = (say!("Cancel"), true);
    let buttons = [
        cancel,
        (&*widgets::dots(say!("Save robot file")), sound),
        (&*primary, sound),
    ];
    let (Some(pressed), form) = (ui.foot(buttons), form.clone()) else {
        return;
    };
    workbench.then(move |bench| {
        bench.show_sheet((pressed == 0 && !of_session).then_some(Sheet::Robots));
        match pressed {
            0 => {}
            1 => bench.keep_robot(form.robot, true),
            _ if of_session => bench.edit(|document| document.set_up(&form)),
            _ => {
                let robot = SimulatedRobot::typed(&form.robot);
                bench.keep_robot(form.robot, false);
                let form = robot.map(simulate::Form::of);
                bench.show_sheet(form.map(Sheet::Simulate));
            }
        }
    });
}
