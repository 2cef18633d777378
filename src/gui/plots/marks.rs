//! Marks of charts on the screen. Shape says what colour says: a triangle points the way that the joint
//! came.

use egui::{Color32, Pos2, Shape, Stroke, vec2};

use crate::gui::scene::{DIAMOND, TRIANGLE, corners_of};
use crate::present::chart::Form;

pub(crate) fn disc(at: Pos2, radius: f32, fill: Color32) -> Shape {
    Shape::circle_filled(at, radius, fill)
}

pub(crate) fn ring(at: Pos2, radius: f32, stroke: Stroke) -> Shape {
    Shape::circle_stroke(at, radius, stroke)
}

/// A mark of a chart.
pub(crate) fn mark(at: Pos2, radius: f32, form: Form, fill: Color32, stroke: Stroke) -> Shape {
    let corners = match form {
        Form::Disc => {
            return Shape::Circle(egui::epaint::CircleShape {
                center: at,
                radius,
                fill,
                stroke,
            });
        }
        Form::Diamond => corners_of(&DIAMOND, at, 1.3 * radius, vec2(1.0, 0.0)),
        Form::Forwards => corners_of(&TRIANGLE, at, radius, vec2(1.0, 0.0)),
        Form::Backwards => corners_of(&TRIANGLE, at, radius, vec2(-1.0, 0.0)),
    };
    Shape::convex_polygon(corners, fill, stroke)
}
