//! The robot in space: links as rods, joints as drums about their axes, what is near over what is
//! far. Rods and drums are as thick as in the plane at any zoom: they are signs, not the machine.

use std::f64::consts::TAU;

use egui::{Color32, Pos2, Shape, Stroke};
use nalgebra::{Point3, Vector3};

use crate::gui::plots::marks;
use crate::gui::style::tokens::Palette;
use crate::gui::view::Facing;

use super::super::robot::{Drawn, FAINT, real_beneath};

/// Width of a rod, and of its wall, points.
const ROD: [f32; 2] = [10.0, 1.25];
/// Radius and half the length of a drum, points; of a joint that slides half a side.
const DRUM: [f64; 2] = [8.5, 8.5];
const BLOCK: f64 = 8.0;
/// Half a side of the plate that the robot stands on, points.
const PLATE: f64 = 17.0;

/// What a robot is drawn with.
pub(super) struct Pen<'a, S: Fn(Point3<f64>) -> Pos2> {
    pub(super) facing: &'a Facing,
    /// Screen points for each mm.
    pub(super) points_per_mm: f64,
    /// Where a point of the measuring frame is on the screen.
    pub(super) screen: S,
    pub(super) palette: &'a Palette,
    /// The axes of the base in the measuring frame.
    pub(super) base: [Vector3<f64>; 3],
}

impl<S: Fn(Point3<f64>) -> Pos2> Pen<'_, S> {
    /// How near to the viewer a point is, mm.
    fn nearness(&self, p: Point3<f64>) -> f64 {
        self.facing.nearness(p.into())
    }

    /// A flat piece around a point with these half sides (or radii, where it is round), points.
    fn face(&self, at: Point3<f64>, sides: [Vector3<f64>; 2], round: bool) -> Vec<Pos2> {
        let corners: u8 = if round { 24 } else { 4 };
        let corner = |k: u8| {
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(corners)).sin_cos();
            let out = if round { 1.0 } else { 2.0_f64.sqrt() };
            let off = (sides[0] * cos + sides[1] * sin) * (out / self.points_per_mm);
            (self.screen)(at + off)
        };
        (0..corners).map(corner).collect()
    }

    /// A drum about an axis, or a block along it.
    fn joint(&self, at: Point3<f64>, axis: Vector3<f64>, turns: bool, edge: Stroke) -> Vec<Shape> {
        let fill = self.palette.surface;
        let [radius, half] = if turns { DRUM } else { [BLOCK; 2] };
        let aside = if axis.x.abs() < 0.9 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        let across = axis.cross(&aside).normalize();
        let sides = [across * radius, axis.cross(&across) * radius];
        // The end that is farther first, the body over it, the nearer end over both.
        let way = if self.facing.nearness(axis.into()) < 0.0 {
            -axis
        } else {
            axis
        };
        let off = way * (half / self.points_per_mm);
        let ends = [at - off, at + off].map(|end| self.face(end, sides, turns));
        let body = hull(ends.concat());
        vec![
            Shape::convex_polygon(body, self.palette.inset, edge),
            Shape::convex_polygon(ends[1].clone(), fill, edge),
            marks::disc((self.screen)(at + off), 1.6, edge.color),
        ]
    }

    /// A link from one corner to the next.
    fn rod(&self, from: Point3<f64>, to: Point3<f64>, color: Color32) -> Vec<Shape> {
        let ends = [from, to].map(|p| (self.screen)(p));
        let mut shapes = Vec::new();
        for (width, color) in [
            (ROD[0], color),
            (ROD[0] - 2.0 * ROD[1], self.palette.surface),
        ] {
            shapes.push(Shape::line_segment(ends, Stroke::new(width, color)));
            shapes.extend(ends.map(|end| marks::disc(end, 0.5 * width, color)));
        }
        shapes
    }
}

/// The nominal robot, by its surface where that is known, and the real one beside it.
pub(super) fn beneath<S: Fn(Point3<f64>) -> Pos2>(
    shapes: &mut Vec<Shape>,
    drawn: &Drawn,
    transform: &egui_plot::PlotTransform,
    pen: &Pen<'_, S>,
    surface: Option<Shape>,
) {
    nominal(shapes, drawn, pen, surface);
    real_beneath(shapes, transform, drawn, pen.palette);
}

/// The nominal robot alone.
pub(super) fn nominal<S: Fn(Point3<f64>) -> Pos2>(
    shapes: &mut Vec<Shape>,
    drawn: &Drawn,
    pen: &Pen<'_, S>,
    surface: Option<Shape>,
) {
    let seen = |color: Color32| {
        if drawn.asked_for {
            color
        } else {
            pen.palette.surface.lerp_to_gamma(color, FAINT)
        }
    };
    let edge = seen(pen.palette.nominal);
    let ink = seen(pen.palette.text);
    let corners = &drawn.corners_mm;
    if let Some(base) = corners.first() {
        let plate = pen.face(*base, [pen.base[0] * PLATE, pen.base[1] * PLATE], false);
        let stroke = Stroke::new(1.25, edge);
        shapes.push(Shape::convex_polygon(plate, pen.palette.surface, stroke));
    }
    if let Some(surface) = surface {
        shapes.push(surface);
    } else {
        links_and_joints(shapes, drawn, pen, [edge, ink]);
    }
    if let Some(tool) = corners.last() {
        let at = (pen.screen)(*tool);
        shapes.push(marks::disc(at, 5.5, pen.palette.surface));
        shapes.push(marks::ring(at, 5.5, Stroke::new(1.5, edge)));
    }
}

/// Rods and drums, where the screws are all that is known.
fn links_and_joints<S: Fn(Point3<f64>) -> Pos2>(
    shapes: &mut Vec<Shape>,
    drawn: &Drawn,
    pen: &Pen<'_, S>,
    [edge, ink]: [Color32; 2],
) {
    let thin = Stroke::new(1.5, ink);
    let corners = &drawn.corners_mm;
    let mut pieces: Vec<(f64, Vec<Shape>)> = Vec::new();
    for pair in corners.windows(2).filter(|p| (p[1] - p[0]).norm() > 1e-6) {
        let middle = nalgebra::center(&pair[0], &pair[1]);
        pieces.push((pen.nearness(middle), pen.rod(pair[0], pair[1], edge)));
    }
    let above = DRUM[0] / pen.points_per_mm;
    for (sign, at) in drawn.signs.iter().zip(corners.iter().skip(1).step_by(2)) {
        let axis = Vector3::from(sign.axis);
        let joint = pen.joint(*at, axis, sign.turns, thin);
        pieces.push((pen.nearness(*at) + above, joint));
    }
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    shapes.extend(pieces.into_iter().flat_map(|(_, piece)| piece));
}

/// The convex hull of points, in order around it (Andrew's monotone chain).
fn hull(mut points: Vec<Pos2>) -> Vec<Pos2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Pos2>| {
        let mut chain: Vec<Pos2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                let (along, next) = (b - a, p - a);
                if along.x * next.y - along.y * next.x > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut around = half(&mut points.iter().copied());
    around.extend(half(&mut points.iter().rev().copied()));
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn the_hull_holds_every_point_and_turns_one_way() {
        let points: Vec<Pos2> = (0..40_u8)
            .map(|k| {
                let t = f32::from(k);
                pos2((t * 2.4).sin() * (10.0 + t), (t * 1.7).cos() * 20.0)
            })
            .collect();
        let around = hull(points.clone());
        assert!(around.len() >= 3);
        for k in 0..around.len() {
            let (a, b) = (around[k], around[(k + 1) % around.len()]);
            for p in &points {
                let (along, off) = (b - a, *p - a);
                assert!(along.x * off.y - along.y * off.x > -1e-2, "{p:?}");
            }
        }
    }
}
