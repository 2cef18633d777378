//! Samples around the angle: one by one, their mean, or their extremes. Before is hollow, after is
//! filled; triangles point the way that the joint came.

use egui::epaint::Mesh;
use egui::{Color32, Pos2, Shape, Stroke, vec2};
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::cache::envelope::Envelope;
use crate::gui::plots::marks;
use crate::gui::style::tokens::Palette;
use crate::numeric::single;

use super::layout::{self, Bearing};
use super::model::{Polar, Spot, Trace};

/// Columns of extremes around.
const COLUMNS: usize = 720;

/// Means at each angle: before is dashed.
pub(super) fn lines(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    polar: &Polar,
    bearing: Bearing,
    palette: &Palette,
) {
    let points = |piece: &[[f64; 2]]| -> Vec<Pos2> {
        let point = |[q, mm]: &[f64; 2]| bearing.at(*q, layout::radius(polar, *mm));
        piece.iter().map(|p| screen(transform, point(p))).collect()
    };
    let pieces = |traces: &'_ [Trace]| -> Vec<Vec<Pos2>> {
        let pieces = traces.iter().flat_map(|trace| &trace.pieces);
        pieces.map(|piece| points(piece)).collect()
    };
    let stroke = Stroke::new(1.25, palette.before.gamma_multiply(0.8));
    for piece in pieces(&polar.before) {
        shapes.extend(Shape::dashed_line(&piece, stroke, 5.0, 3.0));
    }
    for piece in pieces(&polar.after) {
        shapes.push(Shape::line(piece, Stroke::new(1.5, palette.after)));
    }
}

pub(super) fn dots(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    polar: &Polar,
    spots: &[Spot],
    bearing: Bearing,
    only_after: bool,
    palette: &Palette,
) {
    let identified = spots.iter().any(|s| s.after_mm.is_some());
    let (fill, edge) = if identified {
        (Color32::TRANSPARENT, palette.before.gamma_multiply(0.75))
    } else {
        (palette.before.gamma_multiply(0.35), palette.before)
    };
    let placed: Vec<_> = spots
        .iter()
        .map(|spot| {
            let places = layout::places(polar, spot, bearing, only_after, transform);
            (spot, places)
        })
        .collect();
    for (spot, [before, _]) in &placed {
        if let Some(at) = before {
            let ahead = ahead(spot, bearing);
            let stroke = Stroke::new(1.2, edge);
            shapes.push(pointing(*at, 3.2, ahead, fill, stroke));
        }
    }
    for (spot, [_, after]) in &placed {
        if let Some(at) = after {
            let stroke = Stroke::new(0.8, palette.surface);
            let ahead = ahead(spot, bearing);
            shapes.push(pointing(*at, 3.4, ahead, palette.after, stroke));
        }
    }
}

/// The way that the joint moved, on the screen; nothing where it is not known.
fn ahead(spot: &Spot, bearing: Bearing) -> Option<egui::Vec2> {
    if spot.side == 0.0 {
        return None;
    }
    let [x, y] = bearing.at(spot.q, 1.0).map(single);
    let turn = single(bearing.way * spot.side.signum());
    Some(turn * vec2(-y, -x))
}

/// A triangle that points this way; a disc where there is none.
fn pointing(
    at: Pos2,
    radius: f32,
    ahead: Option<egui::Vec2>,
    fill: Color32,
    stroke: Stroke,
) -> Shape {
    let Some(ahead) = ahead else {
        return marks::pointing(at, radius, 0.0, fill, stroke);
    };
    let across = vec2(-ahead.y, ahead.x);
    let corners = vec![
        at + ahead * 1.25 * radius,
        at - ahead * 0.75 * radius + across * 1.1 * radius,
        at - ahead * 0.75 * radius - across * 1.1 * radius,
    ];
    Shape::convex_polygon(corners, fill, stroke)
}

/// What lies between the smallest and the largest deviation in each piece of the circle.
pub(super) fn extremes(
    transform: &PlotTransform,
    polar: &Polar,
    envelope: &Envelope,
    bearing: Bearing,
    only_after: bool,
    palette: &Palette,
) -> Shape {
    let mut mesh = Mesh::default();
    let least = 1.5 / transform.dpos_dvalue_x().abs();
    let mut add = |q: [f64; 2], [low, high]: [f64; 2], color: Color32| {
        let first = u32::try_from(mesh.vertices.len()).unwrap_or(0);
        for (q, divisions) in [(q[0], low), (q[0], high), (q[1], high), (q[1], low)] {
            let at = screen(transform, bearing.at(q, divisions));
            mesh.colored_vertex(at, color);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    };
    let [low, high] = polar.range;
    let columns = envelope.columns([low, high + 1e-9], COLUMNS);
    let thick = |mm: [f64; 2]| {
        let [a, b] = mm.map(|mm| layout::radius(polar, mm));
        let more = (0.5 * (least - (b - a))).max(0.0);
        [a - more, b + more]
    };
    for column in columns.iter().filter(|_| !only_after) {
        if let Some([low, high]) = column.before_mm.map(thick) {
            add(column.x, [low, high], palette.before.gamma_multiply(0.3));
            add(column.x, [low, low + least], palette.before);
            add(column.x, [high - least, high], palette.before);
        }
    }
    for column in columns.iter() {
        if let Some(ends) = column.after_mm.map(thick) {
            add(column.x, ends, palette.after.gamma_multiply(0.85));
        }
    }
    Shape::mesh(mesh)
}

pub(super) fn screen(transform: &PlotTransform, [x, y]: [f64; 2]) -> Pos2 {
    transform.position_from_point(&PlotPoint::new(x, y))
}
