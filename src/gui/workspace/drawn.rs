//! What is drawn in a plane: sectors, the nominal path, vectors, points, and what stands out.

use egui::epaint::Mesh;
use egui::{Align2, Pos2, Rect, Shape, Stroke, Ui, Vec2, pos2};
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::layers::{OUTLINE, WEDGE, WIDTH, scale_at};
use crate::gui::plots::marks;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::Colouring;
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::sessions::Region;

use super::apart::longest_of_cells;
use super::layout::{self, HANDLE, SECTOR};
use super::model::{Dial, Scene, shown};

fn screen(transform: &PlotTransform, p: [f64; 2]) -> Pos2 {
    transform.position_from_point(&PlotPoint::new(p[0], p[1]))
}

pub(super) fn sectors(
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

/// Width of a path where its colour says how sure the model is, points …
const BAND: f32 = 7.0;
/// … and that of the square of a pose that was not measured.
pub(super) const SQUARE: f32 = 5.0;

pub(super) fn path(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    palette: &Palette,
) {
    for (at, part) in &scene.over {
        let square = Rect::from_center_size(screen(transform, *at), Vec2::splat(SQUARE));
        let color = scale_at(Colouring::Uncertainty, palette, *part);
        shapes.push(Shape::rect_filled(square, 0.0, color));
    }
    for (k, path) in scene.paths_mm.iter().enumerate() {
        let points: Vec<Pos2> = path.iter().map(|p| screen(transform, *p)).collect();
        let sure = scene.sure.get(k).map_or(&[][..], Vec::as_slice);
        for (pair, part) in points.windows(2).zip(sure) {
            let color = scale_at(Colouring::Uncertainty, palette, *part);
            shapes.push(Shape::line_segment(
                [pair[0], pair[1]],
                Stroke::new(BAND, color),
            ));
        }
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

pub(super) fn arrows(
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
    let kept = longest_of_cells(scene, transform);
    let all = kept.unwrap_or_else(|| (0..scene.arrows.len()).collect());
    for arrow in all.iter().map(|k| &scene.arrows[*k]) {
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
    for arrow in all.iter().map(|k| &scene.arrows[*k]) {
        let from = screen(transform, arrow.from_mm);
        let to = screen(transform, tip(arrow.from_mm, arrow.vector_mm));
        let (width, color) = match arrow.says {
            Some(part) => {
                let wedge = WEDGE[0] + part * (WEDGE[1] - WEDGE[0]);
                let width = if colouring.by_width() { wedge } else { WIDTH };
                (width, scale_at(colouring, palette, part))
            }
            None if colouring.by_width() => (WIDTH, ghost.color),
            None => (WIDTH, flat),
        };
        marks::arrow(shapes, from, to, Stroke::new(width, color));
    }
}

pub(super) fn points(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    palette: &Palette,
) {
    let size = scene.look.mark;
    let thin = (size + 0.25).min(1.0);
    let colouring = scene.look.colouring;
    for point in &scene.points {
        let at = screen(transform, point.at_mm);
        // Where nothing is known the mark is left open.
        let said = point
            .says
            .map_or(palette.surface, |part| scale_at(colouring, palette, part));
        let radius = if point.within.is_some() { 2.8 } else { 2.6 } * size;
        shapes.push(match (point.within, colouring) {
            (Some(false), _) => {
                let edge = Stroke::new(1.4 * thin, palette.outside);
                marks::diamond(at, 4.2 * size, said, edge)
            }
            (None, Colouring::State) => marks::disc(at, radius, palette.text),
            (Some(true), Colouring::State) => marks::disc(at, radius, palette.within),
            (_, _) => {
                let edge = Stroke::new(OUTLINE * thin, palette.text);
                marks::pointing(at, radius, 0.0, said, edge)
            }
        });
        if point.suspected {
            shapes.push(marks::ring(at, 8.0, Stroke::new(1.5, palette.warning)));
        }
    }
}

pub(super) fn emphasis(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    workbench: &Workbench,
    sample: usize,
    palette: &Palette,
) {
    let Some([x, y]) = in_plane(workbench, sample) else {
        return;
    };
    // Its vector over all others, whatever their colour.
    let e = workbench.facing().flat(shown(workbench, sample));
    let from = [x - e[0], y - e[1]];
    let m = scene.magnification;
    let to = [from[0] + m * e[0], from[1] + m * e[1]];
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
pub(super) fn ring(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    workbench: &Workbench,
    sample: usize,
    palette: &Palette,
) {
    if let Some(at) = in_plane(workbench, sample) {
        let at = screen(transform, at);
        shapes.push(marks::ring(at, 9.0, Stroke::new(2.5, palette.accent)));
    }
}

/// Where a sample was measured, as it is seen, mm; none if it is not usable.
fn in_plane(workbench: &Workbench, sample: usize) -> Option<[f64; 2]> {
    let subject = workbench.subject();
    let measured = subject.usable[sample].then(|| subject.measured(sample))?;
    Some(workbench.facing().flat(measured))
}

/// Names of regions stand so far from the axis, in parts of the farthest reflector's distance.
const NAMES: f64 = 0.42;

pub(super) fn names_of_regions(
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
        let at = screen(transform, dial.at(middle, NAMES * dial.radius_mm));
        let font = crate::gui::style::tokens::strong(size::BODY);
        // As wide as the sector is there.
        let sides = [region.from_rad, region.to_rad];
        let sides = sides.map(|q| screen(transform, dial.at(q, NAMES * dial.radius_mm)));
        let room = if region.to_rad - region.from_rad < std::f64::consts::PI {
            sides[0].distance(sides[1])
        } else {
            2.0 * at.distance(screen(transform, dial.centre_mm))
        };
        let galley = widgets::cut(
            ui,
            &region.name,
            font.clone(),
            palette.muted,
            room.max(24.0),
        );
        let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
        if galley.elided && ui.rect_contains_pointer(place) {
            // Whole, over whatever is there, while the pointer is on it.
            let whole = painter.layout_no_wrap(region.name.clone(), font, palette.text);
            let place = Align2::CENTER_CENTER.anchor_size(at, whole.size());
            painter.rect_filled(place.expand(3.0), 3.0, palette.surface);
            painter.galley(place.min, whole, palette.text);
        } else {
            painter.galley(place.min, galley, palette.muted);
        }
    }
}
