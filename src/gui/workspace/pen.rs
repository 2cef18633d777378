//! What the workspace is drawn with: a camera, which says where places are in the picture, and a pen that draws there,
//! in points and in the colours of the theme.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, Vec2, vec2};
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

/// Words, and how they stand at their place.
#[derive(Debug, Clone)]
pub(super) struct Label {
    pub(super) text: String,
    pub(super) color: Color32,
    pub(super) anchor: Align2,
    pub(super) font: FontId,
    /// What is longer is cut, points; whole where the pointer is on it.
    pub(super) most: Option<f32>,
}

impl Label {
    pub(super) fn new(text: impl Into<String>, color: Color32) -> Self {
        Self {
            text: text.into(),
            color,
            anchor: Align2::CENTER_CENTER,
            font: FontId::proportional(size::SMALL),
            most: None,
        }
    }

    pub(super) fn anchored(self, anchor: Align2) -> Self {
        Self { anchor, ..self }
    }
}

/// Shapes, bottom first.
pub(super) struct Pen<'a> {
    pub(super) painter: &'a Painter,
    pub(super) palette: &'a Palette,
    pub(super) shapes: Vec<Shape>,
}

impl<'a> Pen<'a> {
    pub(super) fn new(painter: &'a Painter, palette: &'a Palette) -> Self {
        Self {
            painter,
            palette,
            shapes: Vec::new(),
        }
    }

    /// Draws with one at once.
    pub(super) fn draw(ui: &Ui, draw: impl FnOnce(&mut Pen<'_>)) {
        let palette = Palette::of(ui);
        let mut pen = Pen::new(ui.painter(), &palette);
        draw(&mut pen);
        ui.painter().extend(pen.shapes);
    }

    pub(super) fn line(&mut self, points: impl IntoIterator<Item = Pos2>, stroke: Stroke) {
        let points: Vec<Pos2> = points.into_iter().collect();
        self.shapes.push(match points[..] {
            [from, to] => Shape::line_segment([from, to], stroke),
            _ => Shape::line(points, stroke),
        });
    }

    /// The area that points enclose: convex, whatever their order.
    pub(super) fn area(&mut self, points: Vec<Pos2>, fill: Color32, edge: Stroke) {
        self.shapes
            .push(Shape::convex_polygon(hull(points), fill, edge));
    }

    pub(super) fn disc(&mut self, at: Pos2, radius: f32, fill: Color32) {
        self.mark(at, (Form::Disc, radius), fill, Stroke::NONE);
    }

    /// A sign as large at any zoom, of this radius.
    pub(super) fn mark(
        &mut self,
        at: Pos2,
        (form, radius): (Form, f32),
        fill: Color32,
        edge: Stroke,
    ) {
        self.shapes.push(mark(at, radius, form, fill, edge));
    }

    /// An arrow with a head that grows with it, up to a point.
    pub(super) fn arrow(&mut self, [tail, tip]: [Pos2; 2], stroke: Stroke) {
        let along = tip - tail;
        let length = along.length();
        if length < 0.75 {
            return;
        }
        let head = (0.35 * length).clamp(1.0, 6.0 + stroke.width);
        let neck = tip - along / length * head;
        self.line([tail, neck], stroke);
        let half = 0.5 * (tip - neck);
        let across = vec2(-half.y, half.x);
        let head = vec![tip, neck + across, neck - across];
        self.shapes
            .push(Shape::convex_polygon(head, stroke.color, Stroke::NONE));
    }

    pub(super) fn label(&mut self, at: Pos2, label: &Label) {
        let (text, font) = (label.text.clone(), label.font.clone());
        let mut job = LayoutJob::simple_singleline(text, font, label.color);
        if let Some(most) = label.most {
            job.wrap = TextWrapping::truncate_at_width(most);
        }
        let galley = self.painter.layout_job(job);
        let place = label.anchor.anchor_size(at, galley.size());
        self.shapes
            .push(Shape::galley(place.min, galley, label.color));
    }
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
