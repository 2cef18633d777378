//! The workspace on the screen, with what the pointer does in it: sectors, nominal path, the robot,
//! measured points, error vectors.

use egui::{
    ColorImage, Context, Id, Popup, PopupCloseBehavior, Pos2, Rect, Response, RichText, Role,
    Slider, Ui, WidgetInfo, vec2,
};
use egui_plot::Axis;
use pen::{Camera, Pen};
use pointer::{Seen, tell_plot_size};

use crate::gui::core::overview::Readable;
use crate::gui::plots::{self, axis, picture, steps_in};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Plane, Plot, Step};
use crate::gui::widgets::{self, Buttons, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::model::{magnification as magnification_of, readable, room};
use crate::present::numbers::significant;

mod fitting;
mod in_space;
mod legend;
mod model;
mod pen;
mod pointer;
mod robot;
mod scene;

pub(crate) use fitting::nearest;
pub(crate) use in_space::robot_alone;
pub(crate) use model::judged;
pub(crate) use pointer::{Handles, boundary_handles, grab, hover, marked};

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let (seen, pass) = (
        ui.available_rect_before_wrap(),
        ui.ctx().cumulative_pass_nr(),
    );
    ui.data_mut(|data| data.insert_temp(picture_id(), (seen, pass)));
    if workbench.view.in_space {
        in_space::show(ui, workbench);
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

fn plane(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let view = &workbench.view;
    let units = workbench.units();
    let unit = units.length_name();
    let [mut across, upwards] = view
        .plane
        .axes()
        .map(|axis| format!("{}, {unit}", ["x", "y", "z"][axis]));
    // In a low plot the axis below goes without its name, which the bar says as well.
    if ui.available_height() < legend::LOW {
        across.clear();
    }
    let per_mm = units.length_value(1.0);
    let hints = |side, name| axis(side, name, &palette, move |mm| units.length_value(mm));
    let editing = view.step == Step::Regions && !workbench.loaded_session().is_empty();
    let seen = Seen::of(ui, workbench);
    let (shown, robot) = (&seen.shown, seen.robot.as_ref());
    let bounds = fitting::bounds(shown);
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
        grab(ui, workbench);
    }
    let (response, transform) = plots::show(ui, plot, bounds, |painter, transform| {
        let transform = *transform;
        let camera = Camera { facing, transform };
        let pen = Pen {
            painter,
            palette: &palette,
        };
        scene::plane(pen, workbench, shown, robot, editing, &camera);
        Vec::new()
    });
    let camera = Camera { facing, transform };
    let frame = camera.frame();
    tell_plot_size(
        workbench,
        fitting::fitted(bounds, [frame.width(), frame.height()].map(f64::from)),
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
            at: &|angle| camera.at_flat(dial.at(angle, fitting::HANDLE * dial.radius_mm)),
            angle: &|at, near| {
                let point = transform.value_from_position(at);
                dial.angle_of([point.x, point.y], near)
            },
            frame,
            name: |at| say!("boundary at {at}", at),
        };
        boundary_handles(ui, workbench, &handles);
    }
}

// The bar over the workspace plot: from where it is looked at, what is shown, and how: from before to after, how long
// vectors are, the heat map, what colour says; the side in space.

/// Something else that stands in the bar.
pub(crate) type ExtraControls = fn(&mut Ui, &Workbench);

/// Shows the bar, in as many rows as it takes; `extra` stands at its beginning.
pub(crate) fn bar(ui: &mut Ui, workbench: &Workbench, extra: Option<ExtraControls>) {
    let drawn = !workbench.loaded_session().is_empty();
    let usual = ui.spacing().interact_size.y;
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = space::ROW_HEIGHT;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().interact_size.y = usual;
            if let Some(extra) = extra {
                extra(ui, workbench);
            }
            ways(ui, workbench);
            if drawn && workbench.answer().is_some() {
                blend(ui, workbench);
            }
            if drawn {
                display(ui, workbench);
            }
            if plots::fit(ui, say!("Fit to view")) {
                workbench.then(|bench| bench.view.fit_workspace());
            }
            if drawn {
                picture(ui, Plot::Workspace, workbench);
            }
        });
    });
}

/// The ways to look at the workspace.
fn ways(ui: &mut Ui, workbench: &Workbench) {
    let view = &workbench.view;
    let planes = Plane::ALL.map(|plane| ((false, plane), plane.name()));
    let space = ((true, view.plane), say!("3-D"));
    let views = [planes[0], planes[1], planes[2], space];
    if widgets::width_of_segments(ui, &views) > ui.available_size_before_wrap().x {
        ui.end_row();
    }
    match ui.segmented(&views, (view.in_space, view.plane)) {
        Some((false, plane)) => workbench.then(move |bench| bench.view.look_in(plane)),
        Some((true, _)) => workbench.then(|bench| bench.view.look_in_space()),
        None => {}
    }
}

fn display_says() -> String {
    format!("{} …", say!("display"))
}

/// How vectors, map and colours are drawn.
fn display(ui: &mut Ui, workbench: &Workbench) {
    let button = ui.button(RichText::new(display_says()).small());
    let menu = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    menu.show(|ui| {
        ui.spacing_mut().item_spacing = vec2(space::ROW, space::ROW);
        ui.row(|ui| magnification(ui, workbench));
        if let Some(after) = workbench.answer() {
            ui.row(|ui| scale_for(ui, workbench, after.readable));
        }
        let mut heat = workbench.view.heat;
        let text = RichText::new(say!("heat map")).small();
        if !workbench.view.in_space && ui.checkbox(&mut heat, text).changed() {
            workbench.then(move |bench| bench.view.heat = heat);
        }
    });
}

/// From before to after. What stands at the end that is shown is written stronger.
fn blend(ui: &mut Ui, workbench: &Workbench) {
    /// How long the slider is; and two buttons with signs, which stand behind it with that of the display.
    const SLIDER: [f32; 2] = [32.0, 64.0];
    const SIGNS: f32 = 56.0;
    let mut blend = workbench.view.blend;
    let font = egui::FontId::proportional(size::SMALL);
    let words = [say!("before"), say!("after"), &display_says()];
    let words = words.map(|word| widgets::width_of(ui, word, font.clone()));
    let between = 5.0 * ui.spacing().item_spacing.x + 2.0 * ui.spacing().button_padding.x;
    let room = ui.available_size_before_wrap().x - words.iter().sum::<f32>() - between - SIGNS;
    if room < SLIDER[0] {
        ui.end_row();
    }
    let end = |ui: &mut Ui, text: &str, shown: bool| {
        let text = RichText::new(text).small();
        ui.label(if shown { text.strong() } else { text.weak() });
    };
    end(ui, say!("before"), blend <= 0.0);
    let control = Slider::new(&mut blend, 0.0..=1.0).show_value(false);
    let room = room.clamp(SLIDER[0], SLIDER[1]);
    let slider = slider(ui, say!("From before to after"), room, control);
    if slider.changed() {
        workbench.then(move |bench| bench.view.blend = blend);
    }
    end(ui, say!("after"), blend >= 1.0);
}

/// A slider of this name, finer than those of forms.
fn slider(ui: &mut Ui, name: &str, long: f32, slider: Slider<'_>) -> Response {
    let usual = ui.spacing().clone();
    ui.spacing_mut().slider_width = long;
    ui.spacing_mut().interact_size.y = 18.0;
    let response = ui.named(name, slider);
    *ui.spacing_mut() = usual;
    response
}

/// How long the vectors are drawn.
fn magnification(ui: &mut Ui, workbench: &Workbench) {
    let now = magnification_of(workbench);
    ui.caption(say!("vectors"));
    let mut factor = now;
    let control = Slider::new(&mut factor, 1.0..=100_000.0);
    let control = control.logarithmic(true).show_value(false);
    let slider = slider(ui, say!("vectors"), 60.0, control);
    if slider.changed() && factor != now {
        workbench.then(move |bench| bench.view.magnification = Some(factor));
    }
    ui.caption(&format!("× {}", significant(now, 2)));
}

/// Whose lengths vectors and colours are made for.
fn scale_for(ui: &mut Ui, workbench: &Workbench, after: Readable) {
    let loaded_session = workbench.loaded_session();
    let room = room(workbench);
    let [before, left] = [loaded_session.overview.readable, after].map(|r| r.magnification(room));
    let now = magnification_of(workbench);
    ui.caption(say!("scale for"));
    let options = [(Some(before), say!("before")), (Some(left), say!("after"))];
    match ui.segmented(&options, Some(now)) {
        Some(Some(factor)) if factor == readable(workbench) => {
            workbench.then(move |bench| bench.view.magnification = None);
        }
        Some(factor) => workbench.then(move |bench| bench.view.magnification = factor),
        None => {}
    }
}
