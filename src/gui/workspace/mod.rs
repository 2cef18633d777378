//! The workspace on the screen, with what the pointer does in it: sectors, nominal path, the robot,
//! measured points, error vectors.

pub(crate) mod handles;
mod legend;
mod model;
mod pen;
mod pointer;
mod robot;
mod scene;
mod toolbar;

pub(crate) use model::judged;
pub(crate) use model::nearest;
pub(crate) use pointer::{hover, marked};
pub(crate) use scene::robot_alone;
pub(crate) use toolbar::show as bar;

use egui::{ColorImage, Context, Id, Pos2, Rect, Role, Ui, WidgetInfo, vec2};
use egui_plot::Axis;

use crate::gui::plots::{self, axis, steps_in};
use crate::gui::style::Palette;
use crate::gui::view::Step;
use crate::gui::workbench::Workbench;

use handles::Handles;
use pen::{Camera, Pen};
use pointer::{Seen, tell_plot_size};

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let (seen, pass) = (
        ui.available_rect_before_wrap(),
        ui.ctx().cumulative_pass_nr(),
    );
    ui.data_mut(|data| data.insert_temp(picture_id(), (seen, pass)));
    if workbench.view.in_space() {
        scene::show(ui, workbench);
    } else {
        plane(ui, workbench);
    }
}

fn picture_id() -> Id {
    Id::unique("picture of the workspace")
}

/// The workspace in a picture of the whole window, where it is shown.
pub(crate) fn in_picture(ctx: &Context, window: &ColorImage) -> Option<ColorImage> {
    /// Passes of a frame that are not shown lie between.
    const SHOWN: u64 = 16;
    let (rect, pass): (Rect, u64) = ctx.data(|data| data.get_temp(picture_id()))?;
    let all = vec2(window.size[0] as f32, window.size[1] as f32) / ctx.pixels_per_point();
    let rect = rect.intersect(Rect::from_min_size(Pos2::ZERO, all));
    let shown = rect.is_positive() && ctx.cumulative_pass_nr() <= pass + SHOWN;
    shown.then(|| window.region(&rect, Some(ctx.pixels_per_point())))
}

/// What stands at the axes of the plane.
fn axes(workbench: &Workbench) -> [String; 2] {
    let unit = workbench.units().length_name();
    let axes = workbench.view.plane.axes();
    axes.map(|axis| format!("{}, {unit}", ["x", "y", "z"][axis]))
}

fn plane(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let view = &workbench.view;
    let units = workbench.units();
    let [mut across, upwards] = axes(workbench);
    // In a low plot the axis below goes without its name, which the bar says as well.
    if ui.available_height() < legend::LOW {
        across.clear();
    }
    let per_mm = units.length_value(1.0);
    let hints = |side, name| axis(side, name, &palette, move |mm| units.length_value(mm));
    let editing = view.step == Step::Regions && !workbench.loaded_session().is_empty();
    let seen = Seen::of(ui, workbench);
    let (shown, robot) = (&seen.shown, seen.robot.as_ref());
    let bounds = model::bounds(shown);
    let plot = plots::plot(("workspace", view.plane.name(), view.fitted.workspace))
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
    let (response, transform) = plots::show(ui, plot, bounds, |painter, transform| {
        let transform = *transform;
        let camera = Camera { facing, transform };
        let mut pen = Pen::new(painter, &palette);
        scene::plane(&mut pen, workbench, shown, robot, editing, &camera);
        pen.shapes
    });
    let camera = Camera { facing, transform };
    let frame = camera.frame();
    tell_plot_size(
        workbench,
        model::fitted(bounds, [frame.width(), frame.height()].map(f64::from)),
    );
    let samples = workbench.loaded_session().overview.usable.len();
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Figure,
            true,
            say!("workspace plot, {samples} samples", samples),
        )
    });
    let pointer = response.hover_pos();
    seen.finish(ui, workbench, &camera, (&response, pointer));
    if editing && let Some(dial) = &shown.dial {
        let handles = Handles {
            at: &|angle| camera.at_flat(dial.at(angle, model::HANDLE * dial.radius_mm)),
            angle: &|at, near| {
                let point = transform.value_from_position(at);
                dial.angle_of([point.x, point.y], near)
            },
            frame,
            name: |at| say!("boundary at {at}", at),
        };
        handles::show(ui, workbench, &handles);
    }
}
