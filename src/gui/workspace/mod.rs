//! The workspace on the screen, with what the pointer does in it: sectors, nominal path, the robot,
//! measured points, error vectors. And a plane of it as a picture.

mod display;
pub(crate) mod handles;
mod layout;
mod legend;
mod model;
mod over;
mod pointer;
mod robot;
mod scales;
mod scene;
mod space;
mod sparse;
mod toolbar;

pub(crate) use layout::nearest;
pub(crate) use model::judged;
pub(crate) use pointer::{hover, marked, sample_menu};
pub(crate) use space::{robot_alone, sheet as space_sheet};
pub(crate) use toolbar::show as bar;

use egui::{Role, Ui, WidgetInfo};
use egui_plot::{Axis, PlotPoint};

use crate::gui::plots::{Drawing, axis, gestures, steps_in};
use crate::gui::scene::paint::Camera;
use crate::gui::scene::paint::paint;
use crate::gui::scene::screen::Screen;
use crate::gui::scene::sheet::{SIZE, Sheet};
use crate::gui::style::Palette;
use crate::gui::view::{Canvas, Step};
use crate::gui::workbench::{Command, Workbench};
use crate::present::drawing;
use crate::present::numbers::trimmed;

use handles::Handles;
use legend::Notes;
use model::Shown;
use over::tell_plot_size;
use pointer::REACH;
use robot::Drawn;

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    if workbench.view().in_space() {
        space::show(ui, workbench, display::posing(ui), commands);
    } else {
        plane(ui, workbench, commands);
    }
}

/// What stands at the axes of the plane.
fn axes(workbench: &Workbench) -> [String; 2] {
    let unit = workbench.units().length_name();
    let axes = workbench.view().plane.axes();
    axes.map(|axis| format!("{}, {unit}", ["x", "y", "z"][axis]))
}

/// The plane on a sheet, and what it shows.
///
/// # Errors
/// There is nothing to draw.
pub(crate) fn plane_sheet(workbench: &Workbench) -> Result<(drawing::Drawing, String), String> {
    if workbench.loaded_session().is_empty() {
        return Err(say!("there are no samples to draw").to_owned());
    }
    let shown = Shown::on(workbench, Canvas::Shapes);
    let robot = Drawn::of(workbench);
    let facing = workbench.facing();
    let camera = Camera::showing(facing, layout::bounds(&shown), Sheet::frame(SIZE));
    let session = crate::report::document::clean(&workbench.loaded_session().session.name);
    let says = say!(
        "measured points, deviations magnified {magnification} times",
        magnification = trimmed(shown.magnification, 3)
    );
    let title = format!("{session}: {says}");
    let sheet = Sheet {
        title: title.clone(),
        axes: Some((axes(workbench), workbench.units().length_value(1.0))),
        legend: legend::on_paper(workbench, &shown, robot.as_ref(), &camera),
        notes: shown.notes(),
    };
    let scene = scene::plane(workbench, &shown, robot.as_ref(), false, &camera);
    Ok((sheet.with(&scene, &camera), title))
}

fn plane(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let view = workbench.view();
    let shown = Shown::of(workbench);
    let robot = Drawn::of(workbench);
    let bounds = layout::bounds(&shown);
    let units = workbench.units();
    let [mut across, upwards] = axes(workbench);
    // In a low plot the axis below goes without its name, which the bar says as well.
    if ui.available_height() < legend::LOW {
        across.clear();
    }
    let per_mm = units.length_value(1.0);
    let hints = |side, name| axis(side, name, &palette, move |mm| units.length_value(mm));
    let editing = view.step == Step::Regions && !workbench.loaded_session().is_empty();
    let notes = Notes::recall(ui, &shown);
    let scale = legend::show(
        ui,
        workbench,
        &shown,
        robot.as_ref(),
        &notes.lines,
        &palette,
    );
    let plot = gestures::plot(("workspace", view.plane.name(), view.fitted.workspace))
        .data_aspect(1.0)
        .set_margin_fraction(egui::Vec2::splat(0.02))
        .grid_color(palette.line)
        .x_grid_spacer(move |input| steps_in(per_mm, input.bounds, 9.0))
        .y_grid_spacer(move |input| steps_in(per_mm, input.bounds, 9.0))
        .custom_x_axes(hints(Axis::X, across))
        .custom_y_axes(hints(Axis::Y, upwards));
    let facing = workbench.facing();
    if editing {
        handles::grab(ui, workbench);
    }
    let drawn = gestures::show(ui, plot, |plot| {
        plot.add(Drawing::new(
            "workspace",
            bounds,
            |ui, transform, shapes| {
                let camera = Camera::new(facing, transform);
                let scene = scene::plane(workbench, &shown, robot.as_ref(), editing, &camera);
                let mut screen = Screen::new(ui.painter(), &palette, shapes);
                paint(&scene, &camera, &mut screen);
            },
        ));
    });
    let (response, transform) = (drawn.response, drawn.transform);
    let camera = Camera::new(facing, &transform);
    let frame = camera.frame();
    tell_plot_size(
        workbench,
        layout::fitted(bounds, [frame.width(), frame.height()].map(f64::from)),
        commands,
    );
    let samples = workbench.loaded_session().overview.usable.len();
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Figure,
            true,
            say!("workspace plot, {samples} samples", samples),
        )
    });
    let about = (&shown, robot.as_ref());
    over::show(ui, workbench, about, &camera, (notes, scale));
    let pointer = response.hover_pos();
    let under = pointer.and_then(|p| layout::under(workbench, &transform, p, REACH));
    hover(&response, workbench, under, commands);
    if editing && let Some(dial) = &shown.dial {
        let handles = Handles {
            at: &|angle| {
                let [x, y] = dial.at(angle, layout::HANDLE * dial.radius_mm);
                transform.position_from_point(&PlotPoint::new(x, y))
            },
            angle: &|at, near| {
                let point = transform.value_from_position(at);
                dial.angle_of([point.x, point.y], near)
            },
            frame,
            name: |at| say!("boundary at {at}", at),
        };
        handles::show(ui, workbench, &handles, commands);
    }
}
