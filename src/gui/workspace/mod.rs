//! The workspace on the screen, with what the pointer does in it: sectors, nominal path, the robot,
//! measured points, error vectors.

pub(crate) mod handles;
mod layout;
mod legend;
mod model;
mod pen;
mod pointer;
mod robot;
mod scene;
mod space;
mod toolbar;

pub(crate) use layout::nearest;
pub(crate) use model::judged;
pub(crate) use pointer::{hover, marked, sample_menu};
pub(crate) use space::robot_alone;
pub(crate) use toolbar::show as bar;

use egui::text::{LayoutJob, TextFormat};
use egui::{
    ColorImage, Context, FontId, Id, Pos2, Rect, Response, Role, Stroke, Ui, Vec2, WidgetInfo, vec2,
};
use egui_plot::Axis;

use crate::gui::cache::cloud::Cloud;
use crate::gui::plots::{self, Drawing, axis, steps_in};
use crate::gui::style::{Palette, size};
use crate::gui::view::Step;
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;

use handles::Handles;
use legend::Notes;
use model::Shown;
use pen::{Camera, Pen};
use robot::Drawn;

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let (seen, pass) = (
        ui.available_rect_before_wrap(),
        ui.ctx().cumulative_pass_nr(),
    );
    ui.data_mut(|data| data.insert_temp(picture_id(), (seen, pass)));
    if workbench.view.in_space() {
        space::show(ui, workbench, toolbar::posing(ui));
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
    let bounds = layout::bounds(shown);
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
    let drawn = plots::show(ui, plot, |plot| {
        plot.add(Drawing::new(
            "workspace",
            bounds,
            |ui, transform, shapes| {
                let transform = *transform;
                let camera = Camera { facing, transform };
                let mut pen = Pen::new(ui.painter(), &palette);
                scene::plane(&mut pen, workbench, shown, robot, editing, &camera);
                shapes.append(&mut pen.shapes);
            },
        ));
    });
    let (response, transform) = (drawn.response, drawn.transform);
    let camera = Camera { facing, transform };
    let frame = camera.frame();
    tell_plot_size(
        workbench,
        layout::fitted(bounds, [frame.width(), frame.height()].map(f64::from)),
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
            at: &|angle| camera.at_flat(dial.at(angle, layout::HANDLE * dial.radius_mm)),
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

/// Samples that are looked at: the cloud's order shows the whole in every beginning.
const SOME: usize = 500;

/// What a plane and space show alike: samples and robot, what is said of them, and where there is room for the scale.
struct Seen {
    shown: Shown,
    robot: Option<Drawn>,
    notes: Notes,
    scale: Option<Rect>,
}

impl Seen {
    /// As the workbench has it, with the rows over the plot.
    fn of(ui: &mut Ui, workbench: &Workbench) -> Self {
        let (shown, robot) = (Shown::of(workbench), Drawn::of(workbench));
        let notes = Notes::recall(ui, &shown);
        let scale = legend::show(ui, workbench, &shown, robot.as_ref(), &notes.lines);
        Self {
            shown,
            robot,
            notes,
            scale,
        }
    }

    /// What lies over the plot, and what the pointer is on.
    fn finish(
        &self,
        ui: &mut Ui,
        workbench: &Workbench,
        camera: &Camera,
        (response, pointer): (&Response, Option<Pos2>),
    ) {
        self.notes.keep(ui, &self.shown, &camera.transform);
        over(ui, workbench, self, camera);
        let under = pointer.and_then(|at| pointer::under(workbench, &self.shown, camera, at));
        hover(response, workbench, under);
    }
}

fn over(ui: &mut Ui, workbench: &Workbench, seen: &Seen, camera: &Camera) {
    let all = &seen.shown;
    if let Some(room) = seen.scale {
        // The legend stands above the plot.
        let mut above = ui.new_child(egui::UiBuilder::new().max_rect(room));
        above.set_clip_rect(room.expand(40.0));
        legend::scale_in(&above, room, workbench, all, camera);
    }
    let Some(robot) = &seen.robot else {
        return;
    };
    let view = &workbench.view;
    // Only needed where something is written.
    let crowd = if view.selected.is_some() && view.hovered.is_none() {
        vector_points(workbench, all, camera)
    } else {
        Vec::new()
    };
    let written = robot.asked_for && view.hovered.is_none();
    values(ui, camera, robot, written, &crowd, &Palette::of(ui));
}

/// Points on the vectors of some samples, so many that a crowd is seen.
fn vector_points(workbench: &Workbench, all: &Shown, camera: &Camera) -> Vec<Pos2> {
    let loaded_session = workbench.loaded_session();
    let cloud = Cloud::of(loaded_session);
    let samples = cloud.samples.iter().take(SOME);
    let points = samples.flat_map(|sample| {
        let sample = *sample as usize;
        let (at, e) = (
            loaded_session.measured(sample),
            model::shown(workbench, sample),
        );
        [0.0, 0.5, 1.0].map(|part| {
            let more = part * (all.magnification - 1.0);
            camera.at([0, 1, 2].map(|k| at[k] + more * e[k]))
        })
    });
    points
        .filter(|p| p.x.is_finite() && p.y.is_finite())
        .collect()
}

/// The joint values beside the tool, where they are least in the way; only said, not `written`,
/// where the card at the pointer has them.
fn values(
    ui: &mut Ui,
    camera: &Camera,
    drawn: &Drawn,
    written: bool,
    obstacles: &[Pos2],
    palette: &Palette,
) {
    const MOST: usize = 8;
    let says = drawn.describe();
    let frame = camera.frame();
    let chain = drawn.corners_mm.iter();
    let chain: Vec<Pos2> = chain.map(|p| camera.at(p.coords.into())).collect();
    let tool = chain.last().copied();
    let Some(tool) = tool.filter(|t| written && frame.contains(*t)) else {
        label(
            ui,
            Rect::from_min_size(frame.left_top(), Vec2::splat(1.0)),
            &says,
        );
        return;
    };
    let font = FontId::proportional(size::SMALL);
    let mut text = LayoutJob::default();
    let mut row = |words: String, color| {
        let line = if text.is_empty() {
            words
        } else {
            format!("\n{words}")
        };
        text.append(&line, 0.0, TextFormat::simple(font.clone(), color));
    };
    if let Some(sample) = drawn.sample {
        row(say!("sample {sample}", sample = sample + 1), palette.muted);
    }
    for (name, value) in drawn.values.iter().take(MOST) {
        row(format!("{name} {value}"), palette.text);
    }
    if drawn.values.len() > MOST {
        let more = drawn.values.len() - MOST;
        row(say!("and {more} more", more), palette.muted);
    }
    if let Some(real) = &drawn.real {
        let what = if real.identified {
            say!("identified")
        } else {
            say!("measured")
        };
        row(
            format!("{what} × {}", trimmed(real.times, 2)),
            palette.muted,
        );
    }
    let text = ui.painter().layout_job(text);
    let card = text.size() + vec2(12.0, 6.0);
    let places = layout::everywhere(tool, card, 16.0, frame);
    let along = |pair: &[Pos2]| {
        let (from, to) = (pair[0], pair[1]);
        (0..=8_u8).map(move |k| from.lerp(to, f32::from(k) / 8.0))
    };
    let chain: Vec<Pos2> = chain.windows(2).flat_map(along).collect();
    let Some(place) = layout::freest(&places, frame, &[obstacles, &chain, &chain, &chain]) else {
        label(ui, Rect::from_center_size(tool, Vec2::splat(1.0)), &says);
        return;
    };
    let painter = ui.painter().with_clip_rect(frame);
    painter.rect(
        place,
        4.0,
        palette.surface.gamma_multiply(0.9),
        Stroke::new(1.0, palette.line),
        egui::StrokeKind::Inside,
    );
    painter.galley(place.min + vec2(6.0, 3.0), text, palette.text);
    label(ui, place, &says);
}

/// A line for screen readers.
fn label(ui: &Ui, place: Rect, says: &str) {
    let id = ui.scope_id().with("robot");
    let response = ui.interact(place, id, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, says));
}

/// The points has to be another by this share for vectors to be drawn for it.
const ANOTHER: f64 = 0.03;

/// Says over how many points the workspace is drawn where all of it is in sight, where that has changed.
fn tell_plot_size(workbench: &Workbench, points_per_mm: f64) {
    let points = 2.0 * workbench.loaded_session().overview.radius_mm * points_per_mm;
    let known = workbench.view.plot_size;
    if points.is_finite() && points > 0.0 && (points / known - 1.0).abs() > ANOTHER {
        workbench.then(move |bench| bench.view.plot_size = points);
    }
}
