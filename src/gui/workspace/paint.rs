//! The workspace plot in egui.

use egui::{Role, Ui, WidgetInfo};
use egui_plot::Axis;

use crate::gui::plots::{Drawing, axis, gestures, steps};
use crate::gui::style::tokens::Palette;
use crate::gui::view::{Canvas, Step};
use crate::gui::workbench::{Command, Workbench};

use super::drawn::{arrows, emphasis, names_of_regions, path, points, ring, sectors};
use super::model::Scene;
use super::notes::Notes;
use super::pointer::{REACH, hover, marked};
use super::polar::Polar;
use super::robot::{self, Drawn};
use super::room::tell_room;
use super::{handles, label_layout, layers, layout, legend, toolbar};

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    if workbench.view().polar() {
        around(ui, workbench, commands);
    } else if workbench.view().in_space() {
        super::space::show(ui, workbench, toolbar::posing(ui), commands);
    } else {
        plane(ui, workbench, commands);
    }
}

/// The polar view, or why there is none.
fn around(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    match Polar::of(workbench) {
        Ok(polar) => {
            legend::polar(ui, workbench, &polar, &palette);
            super::polar::show(ui, workbench, &polar, commands);
        }
        Err(because) => {
            ui.add_space(0.3 * ui.available_height());
            ui.vertical_centered(|ui| {
                ui.set_max_width(360.0);
                ui.label(egui::RichText::new(because).color(palette.muted));
            });
            ui.allocate_space(ui.available_size());
        }
    }
}

fn plane(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let view = workbench.view();
    let scene = Scene::of(workbench);
    let robot = Drawn::of(workbench);
    let bounds = layout::bounds(&scene);
    let names = ["x", "y", "z"];
    let [right, up] = view.plane.axes();
    let units = workbench.units();
    // In a low plot the axis below goes without its name, which the bar says as well.
    let low = ui.available_height() < legend::LOW;
    let name = move |side, axis: usize| {
        if low && side == Axis::X {
            return String::new();
        }
        format!("{}, {}", names[axis], units.length_name())
    };
    let hints = |side, k: usize| {
        let name = name(side, k);
        axis(side, name, &palette, move |mm| units.length_value(mm))
    };
    let measured = !workbench.subject().is_empty();
    let editing = view.step == Step::Regions && measured;
    let regions = &workbench.document().regions;
    let notes = Notes::recall(ui, &scene);
    let scale = legend::show(ui, workbench, &scene, robot.as_ref(), &notes.said, &palette);
    let plot = gestures::plot(("workspace", view.plane.name(), view.fitted.workspace))
        .data_aspect(1.0)
        .set_margin_fraction(egui::Vec2::splat(0.02))
        .grid_color(palette.line)
        .x_grid_spacer(|input| steps(input.bounds, false, 9.0))
        .y_grid_spacer(|input| steps(input.bounds, false, 9.0))
        .custom_x_axes(hints(Axis::X, right))
        .custom_y_axes(hints(Axis::Y, up));
    let emphasised = view.hovered.or(view.selected);
    let pixels = ui.pixels_per_point();
    let shown = gestures::show(ui, plot, |plot| {
        plot.add(Drawing::new("workspace", bounds, |transform, shapes| {
            if let Some(dial) = &scene.dial {
                sectors(shapes, transform, dial, regions, &palette, editing);
            }
            layers::beneath(shapes, transform, &scene, workbench, &palette, pixels);
            path(shapes, transform, &scene, &palette);
            if let Some(robot) = &robot {
                robot::beneath(shapes, transform, robot, &palette);
            }
            if let Canvas::Layers(_) = view.canvas {
                layers::cloud(shapes, transform, &scene, workbench, &palette, pixels);
            } else {
                points(shapes, transform, &scene, &palette);
                arrows(
                    shapes,
                    transform,
                    &scene,
                    &palette,
                    workbench.answer().is_some(),
                );
            }
            for sample in marked(view, workbench.subject().len()) {
                ring(shapes, transform, workbench, sample, &palette);
            }
            if let Some(sample) = emphasised {
                emphasis(shapes, transform, &scene, workbench, sample, &palette);
            }
        }));
    });
    let (response, transform) = (shown.response, shown.transform);
    let frame = transform.frame();
    tell_room(
        workbench,
        layout::fitted(bounds, [frame.width(), frame.height()].map(f64::from)),
        commands,
    );
    let samples = workbench.subject().overview.usable.len();
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Figure,
            true,
            say!("workspace plot, {samples} samples", samples = samples),
        )
    });
    names_of_regions(ui, &scene, &transform, regions, &palette);
    notes.keep(ui, &scene, &transform);
    if let Some(room) = scale {
        legend::scale(ui, room, &scene, &transform, workbench, &palette);
    }
    if let Some(robot) = &robot {
        // Nobody asks where the crowd is while nothing is written.
        let crowd = if view.selected.is_some() && view.hovered.is_none() {
            label_layout::crowd(workbench, &scene, &transform)
        } else {
            Vec::new()
        };
        let written = robot.asked_for && view.hovered.is_none();
        robot::values(ui, &transform, robot, written, &crowd, &palette);
    }

    let pointer = response.hover_pos();
    let under = pointer.and_then(|p| layout::under(workbench, &transform, p, REACH));
    hover(&response, workbench, under, commands);
    if editing && let Some(dial) = &scene.dial {
        handles::show(ui, workbench, dial, &transform, commands);
    }
}
