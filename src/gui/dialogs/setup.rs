//! A robot that is typed: axes or Denavit–Hartenberg rows in a table, the robot drawn beside it; that of the open session
//! with its reflectors and its instrument.

use egui::{Button, CollapsingHeader, Grid, RichText, ScrollArea, TextEdit, Ui, vec2};
use nalgebra::Point3;

use crate::gui::core::robot_table::{RobotTable, Row, TableForm};
use crate::gui::core::setup::{Measured, SetupForm};
use crate::gui::core::simulate::{self, SimulatedRobot};
use crate::gui::help;
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Camera, Sheet};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::sessions::{Session, Sigma, Target};

use super::robots::drawn;

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
    widgets::heading(ui, heading);
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
                rows(ui, typed, measured.is_none());
                folded(ui, say!("Masses of links"), |ui| {
                    masses(ui, &mut typed.rows);
                });
                if let Some(measured) = measured {
                    let session = &workbench.loaded_session().session;
                    folded(ui, say!("Reflectors"), |ui| targets(ui, measured, session));
                    folded(ui, say!("Instrument"), |ui| instrument(ui, measured));
                }
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
    let problem = form.problem();
    if let Some(problem) = &problem {
        widgets::wrong(ui, problem);
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
        widgets::question(ui, help::AXIS);
    });
}

/// The joints, one in a row; whether there may be more and fewer of them: a session has a value of each.
fn rows(ui: &mut Ui, typed: &mut RobotTable, any: bool) {
    let muted = Palette::of(ui).muted;
    let heads = typed.form.numbers();
    let mut gone = None;
    let several = any && typed.rows.len() > 1;
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
    let room = any && typed.rows.len() < RobotTable::MOST_JOINTS;
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
            if row == say!("Tool") {
                widgets::question(ui, help::TOOL);
            }
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
    widgets::form_row(ui, say!("Gravity"), |ui| {
        let mut known = typed.gravity.is_some();
        if ui.checkbox(&mut known, say!("is known, m/s²")).changed() {
            typed.gravity = known.then_some([0.0, 0.0, -9.81]);
        }
        if let Some(gravity) = &mut typed.gravity {
            widgets::numbers(ui, (say!("Gravity"), ""), &XYZ, gravity, (NUMBER, 0.01));
        }
    });
}

fn folded(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).show(ui, contents);
}

/// What of each link is carried: its mass and where its centre is.
fn masses(ui: &mut Ui, rows: &mut [Row]) {
    widgets::caption(ui, say!("kg, and the centre at home in the base frame, mm"));
    for (k, row) in rows.iter_mut().enumerate() {
        let n = k + 1;
        widgets::form_row(ui, &row.name, |ui| {
            let mut known = row.link.is_some();
            let field = ui.checkbox(&mut known, "");
            widgets::label(&field, say!("The mass of link {n} is known", n));
            if field.changed() {
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
    widgets::caption(ui, say!("in the tool frame, mm"));
    let (count, free) = (
        measured.targets.len(),
        measured.last_target_is_free(session),
    );
    for (k, target) in measured.targets.iter_mut().enumerate() {
        let n = k + 1;
        ui.horizontal(|ui| {
            let name = ui.add_sized(NAME, TextEdit::singleline(&mut target.name));
            widgets::label(&name, say!("Name of reflector {n}", n));
            let at = target.position_mm.coords.as_mut_slice();
            let name = say!("Reflector {n}", n);
            widgets::numbers(ui, (&name, "mm"), &XYZ, at, (NUMBER, 0.1));
        });
    }
    if free && ui.link(say!("Remove the last reflector")).clicked() {
        measured.targets.pop();
    }
    if ui.link(say!("Add a reflector")).clicked() {
        measured.targets.push(Target {
            name: format!("T{}", count + 1),
            position_mm: Point3::origin(),
        });
    }
}

fn instrument(ui: &mut Ui, measured: &mut Measured) {
    widgets::form_row(ui, say!("Name"), |ui| {
        let name = ui.add(TextEdit::singleline(&mut measured.instrument));
        widgets::label(&name, say!("Name of the instrument"));
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
    widgets::form_row(ui, say!("noise, one σ, mm"), |ui| {
        if let Some(kind) = widgets::segmented(ui, &kinds, kind) {
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
        widgets::numbers(ui, (say!("Noise"), "mm"), parts, values, (NUMBER, 0.001));
        widgets::question(ui, help::NOISE);
    });
}

fn ends(ui: &mut Ui, form: &SetupForm, sound: bool, workbench: &Workbench) {
    ui.add_space(space::ROW);
    let of_session = form.measured.is_some();
    ui.columns(3, |columns| {
        let back = (!of_session).then_some(Sheet::ROBOTS);
        widgets::other(&mut columns[0], say!("Cancel"))
            .does(workbench, move |bench| bench.show_sheet(back));
        let save = |ui: &mut Ui| widgets::other(ui, say!("Save robot file…"));
        let save = columns[1].add_enabled_ui(sound, save).inner;
        let text = if of_session {
            say!("Use it here")
        } else {
            say!("Simulate…")
        };
        let primary = |ui: &mut Ui| widgets::primary(ui, text);
        let primary = columns[2].add_enabled_ui(sound, primary).inner;
        let table = form.robot.clone();
        if save.clicked() {
            workbench.then(move |bench| {
                bench.show_sheet(None);
                bench.keep_robot(table, true);
            });
        } else if primary.clicked() && of_session {
            let form = form.clone();
            workbench.then(move |bench| {
                bench.show_sheet(None);
                bench.edit(phrase!("edit robot and instrument"), |document| {
                    document.set_up(&form)
                });
            });
        } else if let (true, Some(robot)) = (primary.clicked(), SimulatedRobot::typed(&table)) {
            let form = simulate::Form::of(robot);
            workbench.then(move |bench| {
                bench.keep_robot(table, false);
                bench.show_sheet(Some(Sheet::Simulate(form)));
            });
        }
    });
}
