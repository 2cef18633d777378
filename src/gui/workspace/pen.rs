//! What the workspace is drawn with: a camera, which says where places are in the picture, and a pen that draws there,
//! in points and in the colours of the theme.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use egui_plot::{PlotBounds, PlotPoint, PlotTransform};

use crate::gui::plots::mark;
use crate::gui::style::{Palette, size};
use crate::gui::view::Facing;
use crate::numeric::single;
use crate::present::chart::Form;

/// Planes and the view in space are parallel projections of mm of the measuring frame along the line of sight; in a
/// plane the camera is locked. A plot's coordinates are mm.
#[derive(Clone, Copy)]
pub(super) struct Camera {
    pub(super) facing: Facing,
    pub(super) transform: PlotTransform,
}

impl Camera {
    /// One that shows these bounds (smallest and largest corner), which are formed like it, in a rectangle.
    pub(super) fn showing(facing: Facing, [low, high]: [[f64; 2]; 2], frame: Rect) -> Self {
        let transform = PlotTransform::new(frame, PlotBounds::from_min_max(low, high), false);
        Self { facing, transform }
    }

    pub(super) fn frame(&self) -> Rect {
        *self.transform.frame()
    }

    /// Points of the picture for each mm.
    pub(super) fn points_per_mm(&self) -> f64 {
        self.transform.dpos_dvalue_x().abs()
    }

    /// A point in the coordinates of the plot, in the picture.
    pub(super) fn at_flat(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    /// A point in the picture.
    pub(super) fn at(&self, p: [f64; 3]) -> Pos2 {
        self.at_flat(self.facing.flat(p))
    }

    /// How a direction looks in the picture: as long as it is drawn, of 1.
    pub(super) fn direction(&self, along: [f64; 3]) -> Vec2 {
        let [right, up] = self.facing.flat(along);
        vec2(single(right), -single(up))
    }
}

/// Draws one thing over the other.
#[derive(Clone, Copy)]
pub(super) struct Pen<'a> {
    pub(super) painter: &'a Painter,
    pub(super) palette: &'a Palette,
}

impl Pen<'_> {
    pub(super) fn line(self, points: impl IntoIterator<Item = Pos2>, stroke: Stroke) {
        self.painter.line(points.into_iter().collect(), stroke);
    }

    /// A sign as large at any zoom, of this radius.
    pub(super) fn mark(self, at: Pos2, (form, radius): (Form, f32), fill: Color32, edge: Stroke) {
        self.painter.add(mark(at, radius, form, fill, edge));
    }

    /// An arrow with a head that grows with it, up to a point.
    pub(super) fn arrow(self, [tail, tip]: [Pos2; 2], stroke: Stroke) {
        let along = tip - tail;
        let length = along.length();
        if length < 0.75 {
            return;
        }
        let head = (0.35 * length).clamp(1.0, 6.0 + stroke.width);
        let neck = tip - along / length * head;
        self.painter.line_segment([tail, neck], stroke);
        let half = 0.5 * (tip - neck);
        let across = vec2(-half.y, half.x);
        let head = vec![tip, neck + across, neck - across];
        self.painter
            .add(Shape::convex_polygon(head, stroke.color, Stroke::NONE));
    }

    pub(super) fn label(self, at: Pos2, anchor: Align2, text: impl ToString, color: Color32) {
        let font = FontId::proportional(size::SMALL);
        self.painter.text(at, anchor, text, font, color);
    }
}
