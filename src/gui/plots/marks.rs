//! Marks on the screen. Shape says what colour says: a disc is within the tolerance, an open
//! diamond outside; a triangle points the way that the joint came.

use egui::{Color32, Pos2, Shape, Stroke, Vec2, pos2, vec2};

use crate::present::chart::Form;

/// An arrow with a head that grows with it, up to a point.
pub(crate) fn arrow(shapes: &mut Vec<Shape>, from: Pos2, to: Pos2, stroke: Stroke) {
    let along = to - from;
    let length = along.length();
    if length < 0.75 {
        return;
    }
    let head = (0.35 * length).clamp(1.0, 6.0 + stroke.width);
    let unit = along / length;
    let across = vec2(-unit.y, unit.x);
    let neck = to - unit * head;
    shapes.push(Shape::line_segment([from, neck], stroke));
    shapes.push(Shape::convex_polygon(
        vec![to, neck + across * head * 0.5, neck - across * head * 0.5],
        stroke.color,
        Stroke::NONE,
    ));
}

pub(crate) fn disc(at: Pos2, radius: f32, fill: Color32) -> Shape {
    Shape::circle_filled(at, radius, fill)
}

pub(crate) fn ring(at: Pos2, radius: f32, stroke: Stroke) -> Shape {
    Shape::circle_stroke(at, radius, stroke)
}

/// A diamond: filled with `fill`, outlined with `stroke`.
pub(crate) fn diamond(at: Pos2, radius: f32, fill: Color32, stroke: Stroke) -> Shape {
    let corner = |x: f32, y: f32| at + Vec2::new(x, y) * radius;
    let corners = vec![
        corner(0.0, -1.0),
        corner(1.0, 0.0),
        corner(0.0, 1.0),
        corner(-1.0, 0.0),
    ];
    Shape::convex_polygon(corners, fill, stroke)
}

/// A triangle that points to the right (`side` > 0) or to the left; a disc where it is 0.
pub(crate) fn pointing(at: Pos2, radius: f32, side: f64, fill: Color32, stroke: Stroke) -> Shape {
    if side == 0.0 {
        return Shape::Circle(egui::epaint::CircleShape {
            center: at,
            radius,
            fill,
            stroke,
        });
    }
    let x = if side > 0.0 { 1.0 } else { -1.0 };
    let corners = vec![
        pos2(at.x + x * 1.25 * radius, at.y),
        pos2(at.x - x * 0.75 * radius, at.y + radius * 1.1),
        pos2(at.x - x * 0.75 * radius, at.y - radius * 1.1),
    ];
    Shape::convex_polygon(corners, fill, stroke)
}

/// A mark of a chart.
pub(crate) fn mark(at: Pos2, radius: f32, form: Form, fill: Color32, stroke: Stroke) -> Shape {
    let side = match form {
        Form::Disc => 0.0,
        Form::Forwards => 1.0,
        Form::Backwards => -1.0,
        Form::Diamond => return diamond(at, 1.3 * radius, fill, stroke),
    };
    pointing(at, radius, side, fill, stroke)
}
