//! The workspace plot in egui.

use egui::epaint::Mesh;
use egui::{Align2, CursorIcon, Pos2, Role, Shape, Stroke, Ui, WidgetInfo, pos2};
use egui_plot::{Axis, Plot, PlotPoint, PlotTransform};

use crate::gui::commands::{Command, Workbench};
use crate::gui::layers::{WEDGE, WIDTH, scale_at};
use crate::gui::plots::{Drawing, axis, marks, steps};
use crate::gui::tokens::{Palette, size};
use crate::gui::view::{Canvas, Step, ViewState};
use crate::sessions::Region;

use super::layout::{self, HANDLE, SECTOR};
use super::model::{Dial, Scene, shown};
use super::polar::Polar;
use super::robot::{self, Drawn};
use super::{card, crowd, handles, layers, legend};

/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;

/// Shows the plot in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    if workbench.view().polar() {
        around(ui, workbench, commands);
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
    let name = move |axis: usize| format!("{}, {}", names[axis], units.length_name());
    let hints = |side, k: usize| axis(side, name(k), &palette, move |mm| units.length_value(mm));
    let measured = !workbench.subject().is_empty();
    let editing = view.step == Step::Regions && measured;
    let regions = &workbench.document().regions;
    let notes = Notes::recall(ui, &scene);
    let scale = legend::show(ui, workbench, &scene, robot.as_ref(), &notes.said, &palette);
    let plot = Plot::new(("workspace", view.plane.name(), view.fitted))
        .data_aspect(1.0)
        .show_x(false)
        .show_y(false)
        .show_background(false)
        .show_crosshair(false)
        .set_margin_fraction(egui::Vec2::splat(0.02))
        .grid_color(palette.line)
        .x_grid_spacer(|input| steps(input.bounds, false, 9.0))
        .y_grid_spacer(|input| steps(input.bounds, false, 9.0))
        .custom_x_axes(hints(Axis::X, right))
        .custom_y_axes(hints(Axis::Y, up));
    let emphasised = view.hovered.or(view.selected);
    let pixels = ui.pixels_per_point();
    let shown = plot.show(ui, |plot| {
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
    let samples = workbench.subject().overview.usable.len();
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Figure,
            true,
            format!("workspace plot, {samples} samples"),
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
            crowd::crowd(workbench, &scene, &transform)
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

/// What the legend says of what is not drawn. It stands above the plot, and what is drawn follows
/// from the plot's size: the legend says what the frame before found.
struct Notes {
    id: egui::Id,
    said: Vec<String>,
}

impl Notes {
    fn recall(ui: &Ui, scene: &Scene) -> Self {
        let id = ui.scope_id().with("what is not drawn");
        let said = if scene.canvas == Canvas::Shapes {
            scene.notes()
        } else {
            ui.data(|data| data.get_temp(id)).unwrap_or_default()
        };
        Self { id, said }
    }

    fn keep(self, ui: &Ui, scene: &Scene, transform: &PlotTransform) {
        if scene.canvas == Canvas::Shapes {
            return;
        }
        let now = layout::drawn(scene, layout::counts(scene, transform));
        if now != self.said {
            ui.data_mut(|data| data.insert_temp(self.id, now));
            ui.ctx().request_repaint();
        }
    }
}

/// Sends what is under the pointer, and says what it is.
pub(crate) fn hover(
    response: &egui::Response,
    workbench: &Workbench,
    under: Option<usize>,
    commands: &mut Vec<Command>,
) {
    let left = left(response, &response.ctx);
    if (response.hovered() || left) && under != workbench.view().hovered {
        commands.push(Command::Hover(under));
    }
    if response.clicked() {
        commands.push(Command::Select(under));
    }
    if let Some(sample) = under
        && let Some(pointer) = response.hover_pos()
    {
        response.ctx.set_cursor_icon(CursorIcon::PointingHand);
        card::show(&response.ctx, workbench, sample, pointer, response.rect);
    }
}

/// Whether the pointer has just left this widget.
pub(crate) fn left(response: &egui::Response, ctx: &egui::Context) -> bool {
    let id = response.id.with("was hovered");
    let now = response.hovered();
    ctx.data_mut(|data| {
        let before: bool = data.get_temp(id).unwrap_or_default();
        data.insert_temp(id, now);
        before && !now
    })
}

/// The samples that a finding is about, no more than can be told apart.
pub(crate) fn marked(view: &ViewState, samples: usize) -> impl Iterator<Item = usize> + '_ {
    const MOST: usize = 2000;
    let there = view.marked.iter().copied().filter(move |s| *s < samples);
    there.take(MOST)
}

fn screen(transform: &PlotTransform, p: [f64; 2]) -> Pos2 {
    transform.position_from_point(&PlotPoint::new(p[0], p[1]))
}

fn sectors(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    dial: &Dial,
    regions: &[Region],
    palette: &Palette,
    editing: bool,
) {
    let mut order: Vec<usize> = (0..regions.len()).collect();
    order.sort_by(|a, b| regions[*a].from_rad.total_cmp(&regions[*b].from_rad));
    // One mesh without soft edges: neighbouring pieces leave no seams.
    let mut mesh = Mesh::default();
    let mut next = 0;
    for (place, region) in order.into_iter().map(|k| &regions[k]).enumerate() {
        let color = palette.sectors[place % 2];
        for corners in layout::sector(dial, region.from_rad, region.to_rad) {
            let first = next;
            next += 4;
            for corner in corners {
                mesh.colored_vertex(screen(transform, corner), color);
            }
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, first + 3);
        }
    }
    shapes.push(Shape::mesh(mesh));
    let stroke = if editing {
        Stroke::new(1.5, palette.accent)
    } else {
        Stroke::new(1.0, palette.line)
    };
    for region in regions {
        for angle in [region.from_rad, region.to_rad] {
            let inner = screen(transform, dial.at(angle, SECTOR.0 * dial.radius_mm));
            let end = if editing { HANDLE } else { SECTOR.1 };
            let outer = screen(transform, dial.at(angle, end * dial.radius_mm));
            shapes.push(Shape::line_segment([inner, outer], stroke));
        }
    }
}

fn path(shapes: &mut Vec<Shape>, transform: &PlotTransform, scene: &Scene, palette: &Palette) {
    for path in &scene.paths_mm {
        let points: Vec<Pos2> = path.iter().map(|p| screen(transform, *p)).collect();
        shapes.push(Shape::line(points, Stroke::new(1.25, palette.nominal)));
    }
    if let Some(dial) = &scene.dial {
        let centre = screen(transform, dial.centre_mm);
        let stroke = Stroke::new(1.5, palette.nominal);
        for (a, b) in [((-6.0, 0.0), (6.0, 0.0)), ((0.0, -6.0), (0.0, 6.0))] {
            let at = |(x, y): (f32, f32)| pos2(centre.x + x, centre.y + y);
            shapes.push(Shape::line_segment([at(a), at(b)], stroke));
        }
        shapes.push(marks::ring(centre, 3.5, stroke));
    }
}

fn arrows(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    palette: &Palette,
    identified: bool,
) {
    let m = scene.magnification;
    let tip = |from: [f64; 2], v: [f64; 2]| [from[0] + m * v[0], from[1] + m * v[1]];
    let ghost = Stroke::new(1.0, palette.before.gamma_multiply(0.38));
    let flat = if identified {
        palette.after
    } else {
        palette.before
    };
    let colouring = scene.look.colouring;
    for arrow in &scene.arrows {
        if let Some(before) = arrow.before_mm {
            // The simulation that the deviation before belongs to.
            let from = [
                arrow.from_mm[0] + arrow.vector_mm[0] - before[0],
                arrow.from_mm[1] + arrow.vector_mm[1] - before[1],
            ];
            let (from, to) = (
                screen(transform, from),
                screen(transform, tip(from, before)),
            );
            marks::arrow(shapes, from, to, ghost);
        }
    }
    for arrow in &scene.arrows {
        let from = screen(transform, arrow.from_mm);
        let to = screen(transform, tip(arrow.from_mm, arrow.vector_mm));
        let (width, color) = match arrow.says {
            Some(part) => {
                let wedge = WEDGE[0] + part * (WEDGE[1] - WEDGE[0]);
                let width = colouring.condition().map_or(WIDTH, |_| wedge);
                (width, scale_at(colouring, palette, part))
            }
            None if colouring.condition().is_some() => (WIDTH, ghost.color),
            None => (WIDTH, flat),
        };
        marks::arrow(shapes, from, to, Stroke::new(width, color));
    }
}

fn points(shapes: &mut Vec<Shape>, transform: &PlotTransform, scene: &Scene, palette: &Palette) {
    let size = scene.look.mark;
    for point in &scene.points {
        let at = screen(transform, point.at_mm);
        shapes.push(match point.within {
            None => marks::disc(at, 2.6 * size, palette.text),
            Some(true) => marks::disc(at, 2.8 * size, palette.within),
            Some(false) => {
                let edge = Stroke::new(1.4, palette.outside);
                marks::diamond(at, 4.2 * size, palette.surface, edge)
            }
        });
        if point.suspected {
            shapes.push(marks::ring(at, 8.0, Stroke::new(1.5, palette.warning)));
        }
    }
}

fn emphasis(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    workbench: &Workbench,
    sample: usize,
    palette: &Palette,
) {
    let subject = workbench.subject();
    if !subject.usable[sample] {
        return;
    }
    let measured = subject.measured(sample);
    let [right, up] = workbench.view().plane.axes();
    // Its vector over all others, whatever their colour.
    let e = shown(workbench, sample);
    let from = [measured[right] - e[right], measured[up] - e[up]];
    let m = scene.magnification;
    let to = [from[0] + m * e[right], from[1] + m * e[up]];
    let (from, to) = (screen(transform, from), screen(transform, to));
    marks::arrow(
        shapes,
        from,
        to,
        Stroke::new(2.0 * WIDTH + 2.0, palette.surface),
    );
    marks::arrow(shapes, from, to, Stroke::new(2.0 * WIDTH, palette.accent));
    ring(shapes, transform, workbench, sample, palette);
}

/// A ring around a sample.
fn ring(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    workbench: &Workbench,
    sample: usize,
    palette: &Palette,
) {
    let subject = workbench.subject();
    if !subject.usable[sample] {
        return;
    }
    let measured = subject.measured(sample);
    let at = workbench.view().plane.axes().map(|axis| measured[axis]);
    let at = screen(transform, at);
    shapes.push(marks::ring(at, 9.0, Stroke::new(2.5, palette.accent)));
}

fn names_of_regions(
    ui: &Ui,
    scene: &Scene,
    transform: &PlotTransform,
    regions: &[Region],
    palette: &Palette,
) {
    let Some(dial) = &scene.dial else {
        return;
    };
    let painter = ui.painter().with_clip_rect(*transform.frame());
    for region in regions {
        let middle = 0.5 * (region.from_rad + region.to_rad);
        let at = screen(transform, dial.at(middle, 0.42 * dial.radius_mm));
        let font = crate::gui::tokens::strong(size::BODY);
        painter.text(at, Align2::CENTER_CENTER, &region.name, font, palette.muted);
    }
}
