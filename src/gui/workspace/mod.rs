//! The workspace on the screen, with what the pointer does in it: sectors, nominal path, the robot,
//! measured points, error vectors.

use egui::{
    ColorImage, Context, Id, Popup, PopupCloseBehavior, Pos2, Rect, RichText, Role, Slider, Ui,
    WidgetInfo, vec2,
};
use egui_plot::Axis;
use pen::{Camera, Pen};
use pointer::{Seen, tell_plot_size};

use crate::gui::core::overview::Readable;
use crate::gui::plots::{self, axis, picture, steps_in};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Aspect, Plane, Plot, Step};
use crate::gui::widgets::{self, caption, fine};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::model::{magnification as magnification_of, readable, room};
use crate::present::numbers::{significant, trimmed};

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
    if workbench.view.in_space() {
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
        let mut pen = Pen::new(painter, &palette);
        scene::plane(&mut pen, workbench, shown, robot, editing, &camera);
        pen.shapes
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
    let planes = Plane::ALL.map(|plane| ((Aspect::Plane, plane), plane.name()));
    let space = ((Aspect::Space, view.plane), say!("3-D"));
    let views = [planes[0], planes[1], planes[2], space];
    if widgets::width_of_segments(ui, &views) > ui.available_size_before_wrap().x {
        ui.end_row();
    }
    match widgets::segmented(ui, &views, (view.aspect, view.plane)) {
        Some((Aspect::Plane, plane)) => workbench.then(move |bench| bench.view.look_in(plane)),
        Some((Aspect::Space, _)) => workbench.then(|bench| bench.view.look_in_space()),
        None => {}
    }
}

/// How vectors, map and colours are drawn.
fn display(ui: &mut Ui, workbench: &Workbench) {
    let text = RichText::new(say!("display").to_owned() + " …").size(size::SMALL);
    let button = ui.button(text);
    widgets::label(&button, say!("How it is drawn"));
    let menu = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    menu.show(|ui| {
        ui.spacing_mut().item_spacing = vec2(space::ROW, space::ROW);
        widgets::row(ui, |ui| magnification(ui, workbench));
        if let Some(after) = workbench.after() {
            widgets::row(ui, |ui| scale_for(ui, workbench, after.readable));
        }
        if !workbench.view.in_space() {
            heat(ui, workbench);
        }
    });
}

/// From before to after. What stands at the end that is shown is written stronger.
fn blend(ui: &mut Ui, workbench: &Workbench) {
    /// Of the slider; and of what stands between it and its ends.
    const SLIDER: f32 = 64.0;
    const BETWEEN: f32 = 4.0 * space::ROW;
    let mut blend = workbench.view.blend;
    let palette = Palette::of(ui);
    let ends = [say!("before"), say!("after")];
    let font = egui::FontId::proportional(size::SMALL);
    let ends = ends.map(|end| widgets::width_of(ui, end, font.clone()));
    if ends.iter().sum::<f32>() + SLIDER + BETWEEN > ui.available_size_before_wrap().x {
        ui.end_row();
    }
    let end = |ui: &mut Ui, text: &str, shown: bool| {
        let text = RichText::new(text).size(size::SMALL);
        let text = if shown {
            text.color(palette.text).strong()
        } else {
            text.color(palette.muted)
        };
        ui.label(text);
    };
    end(ui, say!("before"), blend <= 0.0);
    let usual = ui.spacing().clone();
    fine(ui, SLIDER);
    let slider = ui.add(Slider::new(&mut blend, 0.0..=1.0).show_value(false));
    *ui.spacing_mut() = usual;
    widgets::label(&slider, say!("From before to after"));
    if slider.changed() {
        workbench.then(move |bench| bench.view.blend = blend);
    }
    slider.on_hover_text(blend_says(blend));
    end(ui, say!("after"), blend >= 1.0);
}

/// What the vectors, the marks and the heat map show.
fn blend_says(blend: f32) -> String {
    if blend <= 0.0 {
        say!("shown: the deviation before, measured − nominal robot").to_owned()
    } else if blend >= 1.0 {
        say!("shown: what is left after, measured − identified robot").to_owned()
    } else {
        let percent = trimmed(100.0 * f64::from(blend), 0);
        say!(
            "shown: {percent} % of the way from before to after",
            percent
        )
    }
}

/// How long the vectors are drawn.
fn magnification(ui: &mut Ui, workbench: &Workbench) {
    let now = magnification_of(workbench);
    caption(ui, say!("vectors"));
    let mut factor = now;
    fine(ui, 60.0);
    let slider = Slider::new(&mut factor, 1.0..=100_000.0)
        .logarithmic(true)
        .show_value(false);
    let slider = ui.add(slider);
    widgets::label(&slider, say!("Length of vectors"));
    if slider.changed() && factor != now {
        workbench.then(move |bench| bench.view.magnification = Some(factor));
    }
    caption(ui, &format!("× {}", significant(now, 2)));
}

/// Whose lengths vectors and colours are made for.
fn scale_for(ui: &mut Ui, workbench: &Workbench, after: Readable) {
    let loaded_session = workbench.loaded_session();
    let room = room(workbench);
    let [before, left] = [loaded_session.overview.readable, after].map(|r| r.magnification(room));
    let now = magnification_of(workbench);
    let says = say!(
        "how long vectors are drawn and where the colours of lengths end: so that the deviations before can be read, or those that are left after"
    );
    caption(ui, say!("scale for")).on_hover_text(says);
    let options = [(Some(before), say!("before")), (Some(left), say!("after"))];
    match widgets::segmented(ui, &options, Some(now)) {
        Some(Some(factor)) if factor == readable(workbench) => {
            workbench.then(move |bench| bench.view.magnification = None);
        }
        Some(factor) => workbench.then(move |bench| bench.view.magnification = factor),
        None => {}
    }
}

/// Whether the error between the samples is shown.
fn heat(ui: &mut Ui, workbench: &Workbench) {
    let mut shown = workbench.view.heat;
    let text = RichText::new(say!("heat map")).size(size::SMALL);
    let says = say!("the root mean square deviation between the samples, fading away from them");
    let checkbox = ui.checkbox(&mut shown, text).on_hover_text(says);
    widgets::label(&checkbox, say!("heat map"));
    if checkbox.changed() {
        workbench.then(move |bench| bench.view.heat = shown);
    }
}
