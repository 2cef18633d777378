//! The screen: a scene as shapes of egui.

use std::sync::Arc;

use egui::epaint::{CircleShape, Mesh};
use egui::text::{LayoutJob, TextWrapping};
use egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Shape, vec2};

use super::paint::{Camera, DIAMOND, SQUARE, corners_of, hull};
use super::{
    ColourToken, Form, Item, Label, Layer, LegendEntry, Mark, Place, Stroke, Tint, Triangle,
};
use crate::gui::layers::gpu::{CloudLayer, HeatLayer, Layer as _};
use crate::gui::layers::{Frame, LayerOptions};
use crate::gui::style::{Palette, strong};

/// Shapes in the colours of a theme.
pub(crate) struct Screen<'a> {
    painter: &'a Painter,
    palette: &'a Palette,
    shapes: &'a mut Vec<Shape>,
}

impl<'a> Screen<'a> {
    pub(crate) fn new(
        painter: &'a Painter,
        palette: &'a Palette,
        shapes: &'a mut Vec<Shape>,
    ) -> Self {
        Self {
            painter,
            palette,
            shapes,
        }
    }

    /// Draws the sign of a legend about its middle.
    pub(crate) fn symbol(painter: &Painter, palette: &Palette, entry: &LegendEntry, at: Pos2) {
        let mut shapes = Vec::new();
        let mut screen = Screen::new(painter, palette, &mut shapes);
        screen.draw(&entry.sign, &Camera::of_signs(at));
        painter.extend(shapes);
    }

    fn color(&self, ink: Option<Tint>) -> Color32 {
        ink.map_or(Color32::TRANSPARENT, |ink| ink.color(self.palette))
    }

    fn stroke(&self, stroke: Option<Stroke>) -> egui::Stroke {
        stroke.map_or(egui::Stroke::NONE, |stroke| {
            egui::Stroke::new(stroke.width, stroke.colour.color(self.palette))
        })
    }

    fn galley(&self, label: &Label) -> Arc<Galley> {
        let font = if label.bold {
            strong(label.size)
        } else {
            FontId::proportional(label.size)
        };
        let color = label.colour.color(self.palette);
        let mut job = LayoutJob::simple_singleline(label.text.clone(), font, color);
        if let Some(most) = label.most {
            job.wrap = TextWrapping::truncate_at_width(most);
        }
        self.painter.layout_job(job)
    }
}

impl Screen<'_> {
    /// Draws a scene.
    pub(crate) fn draw(&mut self, items: &[Item], camera: &Camera) {
        for item in items {
            match item {
                Item::Line(places, stroke) => {
                    let points: Vec<Pos2> = places.iter().map(|p| camera.place(p)).collect();
                    let drawn = self.stroke(Some(*stroke));
                    self.shapes.push(match points[..] {
                        [from, to] => Shape::line_segment([from, to], drawn),
                        _ => Shape::line(points, drawn),
                    });
                }
                Item::Area(corners, fill, edge) => {
                    let corners = corners.iter().map(|place| camera.place(place));
                    self.area(hull(corners.collect()), *fill, *edge);
                }
                Item::Triangles(triangles) => self.triangles(triangles, camera),
                Item::Net(corners, across) => self.net(corners, *across, camera),
                Item::Vector(ends, stroke) => self.arrow(ends.map(|p| camera.place(&p)), *stroke),
                Item::Mark(mark) => self.mark(camera.place(&mark.at), mark),
                Item::Label(label) => {
                    let at = camera.place(&label.at);
                    let place = label.anchor.anchor_size(at, self.galley(label).size());
                    self.words(place, label);
                }
                Item::Layer(layer) => self.layer(layer, camera),
            }
        }
    }

    fn area(&mut self, corners: Vec<Pos2>, fill: Option<Tint>, edge: Option<Stroke>) {
        let shape = Shape::convex_polygon(corners, self.color(fill), self.stroke(edge));
        self.shapes.push(shape);
    }

    fn mark(&mut self, at: Pos2, mark: &Mark) {
        let corners = match mark.form {
            Form::Disc => {
                return self.shapes.push(Shape::Circle(CircleShape {
                    center: at,
                    radius: mark.radius,
                    fill: self.color(mark.fill),
                    stroke: self.stroke(mark.edge),
                }));
            }
            Form::Diamond => &DIAMOND,
            Form::Square => &SQUARE,
        };
        let corners = corners_of(corners, at, mark.radius, vec2(1.0, 0.0));
        self.area(corners, mark.fill, mark.edge);
    }

    /// An arrow with a head that grows with it, up to a point.
    fn arrow(&mut self, [tail, tip]: [Pos2; 2], stroke: Stroke) {
        let along = tip - tail;
        let length = along.length();
        if length < 0.75 {
            return;
        }
        let head = (0.35 * length).clamp(1.0, 6.0 + stroke.width);
        let neck = tip - along / length * head;
        let shaft = Shape::line_segment([tail, neck], self.stroke(Some(stroke)));
        self.shapes.push(shaft);
        let half = 0.5 * (tip - neck);
        let across = vec2(-half.y, half.x);
        let head = vec![tip, neck + across, neck - across];
        self.area(head, Some(stroke.colour), None);
    }

    fn triangles(&mut self, triangles: &[(Triangle, Tint)], camera: &Camera) {
        let mut mesh = Mesh::default();
        for (corners, ink) in triangles {
            let first = u32::try_from(mesh.vertices.len()).unwrap_or(u32::MAX);
            let color = ink.color(self.palette);
            for corner in corners {
                mesh.colored_vertex(camera.at(corner.map(f64::from)), color);
            }
            mesh.add_triangle(first, first + 1, first + 2);
        }
        self.shapes.push(Shape::mesh(mesh));
    }

    fn net(&mut self, corners: &[(Place, Tint)], across: usize, camera: &Camera) {
        let mut mesh = Mesh::default();
        let row = u32::try_from(across).unwrap_or(u32::MAX);
        for (here, (place, ink)) in (0_u32..).zip(corners) {
            mesh.colored_vertex(camera.place(place), ink.color(self.palette));
            if here >= row && here % row > 0 {
                let [left, below] = [here - 1, here - row];
                mesh.add_triangle(here, left, below);
                mesh.add_triangle(left, below, below - 1);
            }
        }
        self.shapes.push(Shape::mesh(mesh));
    }

    fn layer(&mut self, layer: &Layer, camera: &Camera) {
        let pixels = self.painter.pixels_per_point();
        let frame = |look: &LayerOptions, heat| {
            Frame::new(look, self.palette, camera.transform(), heat, pixels)
        };
        let rect = camera.frame();
        self.shapes.push(match layer {
            Layer::Heat(heat, look) => HeatLayer {
                heat: Arc::clone(heat),
                frame: frame(look, Some(heat)),
            }
            .shape(rect),
            Layer::Samples(samples) => {
                let look = &samples.look;
                CloudLayer {
                    cloud: Arc::clone(&samples.cloud),
                    remainder: samples.remainder.clone(),
                    frame: frame(look, None),
                    counts: samples.counts,
                    ghosts: look.ghosts(),
                }
                .shape(rect)
            }
        });
    }

    fn words(&mut self, place: Rect, label: &Label) {
        let color = label.colour.color(self.palette);
        let galley = self.galley(label);
        let pointer = self.painter.ctx().input(|i| i.pointer.hover_pos());
        let pointer = pointer.filter(|at| self.painter.clip_rect().contains(*at));
        if galley.elided && pointer.is_some_and(|at| place.contains(at)) {
            // Whole, over whatever is there.
            let whole = Label {
                most: None,
                colour: ColourToken::Text.into(),
                ..label.clone()
            };
            let size = self.galley(&whole).size();
            let place = Align2::CENTER_CENTER.anchor_size(place.center(), size);
            let ground = place.expand(3.0);
            let ground = Shape::rect_filled(ground, 3.0, self.palette.surface);
            self.shapes.push(ground);
            return self.words(place, &whole);
        }
        self.shapes.push(Shape::galley(place.min, galley, color));
    }
}

/// A dashed line through points that may be nearer to each other than a dash is long; lengths of a
/// dash and of the gap after it, points.
pub(crate) fn dashes(points: &[Pos2], stroke: egui::Stroke, lengths: [f32; 2]) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut dash: Vec<Pos2> = points.first().copied().into_iter().collect();
    let (mut drawn, mut left) = (true, lengths[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let mut length = from.distance(to);
        if !length.is_finite() {
            continue;
        }
        while length > left {
            from += (to - from) * (left / length);
            length -= left;
            dash.push(from);
            if drawn {
                shapes.push(Shape::line(std::mem::take(&mut dash), stroke));
            }
            dash = vec![from];
            drawn = !drawn;
            left = lengths[usize::from(!drawn)];
        }
        left -= length;
        dash.push(to);
    }
    if drawn && dash.len() > 1 {
        shapes.push(Shape::line(dash, stroke));
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::style::DARK;
    use egui::pos2;

    #[test]
    fn dashes_have_one_length_however_near_the_points_are() {
        let ends = [pos2(0.0, 3.0), pos2(85.0, 3.0)];
        let fine: Vec<Pos2> = (0_u8..=170)
            .map(|k| pos2(0.5 * f32::from(k), 3.0))
            .collect();
        let stroke = egui::Stroke::new(1.0, DARK.text);
        let lengths = |points: &[Pos2]| {
            let shapes = dashes(points, stroke, [5.0, 3.5]);
            let of = |shape: &Shape| shape.visual_bounding_rect().width();
            shapes.iter().map(of).collect::<Vec<f32>>()
        };
        let (few, many) = (lengths(&ends), lengths(&fine));
        assert_eq!(few.len(), 10);
        assert_eq!(many.len(), 10);
        for (a, b) in few.iter().zip(&many) {
            assert!((a - b).abs() < 1e-2, "{few:?} {many:?}");
        }
        assert!(dashes(&ends[..1], stroke, [5.0, 3.5]).is_empty());
    }
}
