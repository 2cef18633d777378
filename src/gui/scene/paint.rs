//! From a scene to lines, areas and words of a picture, whatever the picture is drawn on.

use egui::{Pos2, Rect, Vec2, vec2};

use super::camera::Camera;
use super::items::{Form, Item, Label, Layer, Mark, Scene};
use super::tint::{Stroke, Tint};

/// What a picture is drawn on. Everything is in points, and areas are convex.
pub(crate) trait Canvas {
    fn line(&mut self, points: Vec<Pos2>, stroke: Stroke);

    fn area(&mut self, corners: Vec<Pos2>, fill: Option<Tint>, edge: Option<Stroke>);

    fn disc(&mut self, at: Pos2, radius: f32, fill: Option<Tint>, edge: Option<Stroke>);

    fn triangles(&mut self, triangles: &mut dyn Iterator<Item = ([Pos2; 3], Tint)>);

    /// Coloured corners, so many in a row.
    fn net(&mut self, corners: &[(Pos2, Tint)], across: usize);

    /// Width and height of words.
    fn size(&self, label: &Label) -> Vec2;

    /// Words that fill this rectangle.
    fn words(&mut self, place: Rect, label: &Label);

    /// What a graphics processor draws, where there is one.
    fn layer(&mut self, _: &Layer, _: &Camera) {}

    /// From its tail over its neck, where the head begins, to its tip.
    fn arrow(&mut self, [tail, neck, tip]: [Pos2; 3], stroke: Stroke) {
        self.line(vec![tail, neck], stroke);
        let half = 0.5 * (tip - neck);
        let across = vec2(-half.y, half.x);
        let head = vec![tip, neck + across, neck - across];
        self.area(head, Some(stroke.colour), None);
    }
}

/// Draws a scene.
pub(crate) fn paint(scene: &Scene, camera: &Camera, canvas: &mut dyn Canvas) {
    items(&scene.items, camera, canvas);
}

pub(super) fn items(items: &[Item], camera: &Camera, canvas: &mut dyn Canvas) {
    let mut taken = Vec::new();
    for item in items {
        match item {
            Item::Line(places, stroke) => {
                let points = places.iter().map(|place| camera.place(place));
                canvas.line(points.collect(), *stroke);
            }
            Item::Area(corners, fill, edge) => {
                let corners = corners.iter().map(|place| camera.place(place));
                canvas.area(hull(corners.collect()), *fill, *edge);
            }
            Item::Triangles(triangles) => {
                let at = |p: [f32; 3]| camera.at(p.map(f64::from));
                let mut seen = triangles
                    .iter()
                    .map(|(corners, ink)| (corners.map(at), *ink));
                canvas.triangles(&mut seen);
            }
            Item::Net(corners, across) => {
                let seen = corners
                    .iter()
                    .map(|(place, ink)| (camera.place(place), *ink));
                canvas.net(&seen.collect::<Vec<_>>(), *across);
            }
            Item::Vector(ends, stroke) => arrow(canvas, ends.map(|p| camera.place(&p)), *stroke),
            Item::Mark(one) => mark(canvas, camera, one),
            Item::Label(label) => words(canvas, camera, label, &mut taken),
            Item::Layer(layer) => canvas.layer(layer, camera),
        }
    }
}

/// An arrow with a head that grows with it, up to a point.
fn arrow(canvas: &mut dyn Canvas, [from, to]: [Pos2; 2], stroke: Stroke) {
    let along = to - from;
    let length = along.length();
    if length >= 0.75 {
        let head = (0.35 * length).clamp(1.0, 6.0 + stroke.width);
        canvas.arrow([from, to - along / length * head, to], stroke);
    }
}

fn mark(canvas: &mut dyn Canvas, camera: &Camera, mark: &Mark) {
    let at = camera.place(&mark.at);
    let (ahead, corners): (_, &[[f32; 2]]) = match mark.form {
        Form::Disc => return canvas.disc(at, mark.radius, mark.fill, mark.edge),
        Form::Diamond => (vec2(1.0, 0.0), &DIAMOND),
        Form::Square => (vec2(1.0, 0.0), &SQUARE),
        Form::Ahead(along) => (camera.direction(mark.at.at, along).normalized(), &TRIANGLE),
    };
    let corners = corners_of(corners, at, mark.radius, ahead);
    canvas.area(corners, mark.fill, mark.edge);
}

/// Corners of forms that look to the right, of a radius of 1.
pub(crate) const DIAMOND: [[f32; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
pub(crate) const TRIANGLE: [[f32; 2]; 3] = [[1.25, 0.0], [-0.75, 1.1], [-0.75, -1.1]];
const SQUARE: [[f32; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// The same of this radius about a point, looking that way.
pub(crate) fn corners_of(corners: &[[f32; 2]], at: Pos2, radius: f32, ahead: Vec2) -> Vec<Pos2> {
    let across = vec2(-ahead.y, ahead.x);
    let corner = |[x, y]: &[f32; 2]| at + (ahead * *x + across * *y) * radius;
    corners.iter().map(corner).collect()
}

/// Words where they belong; some not where others stand already.
fn words(canvas: &mut dyn Canvas, camera: &Camera, label: &Label, taken: &mut Vec<Rect>) {
    let size = canvas.size(label);
    let mut place = label.anchor.anchor_size(camera.place(&label.at), size);
    if let Some([x, y]) = label.padding {
        place = inside(place, camera.frame());
        let back = place.expand2(vec2(x, y));
        if taken.iter().any(|other| other.intersects(back)) {
            return;
        }
        taken.push(back);
        if label.background.is_some() {
            let corners = [
                back.left_top(),
                back.right_top(),
                back.right_bottom(),
                back.left_bottom(),
            ];
            canvas.area(corners.to_vec(), label.background, None);
        }
    }
    canvas.words(place, label);
}

/// The same rectangle, moved so that it is within the frame.
fn inside(place: Rect, frame: Rect) -> Rect {
    let within = |low: f32, high: f32, from: f32, to: f32| (from - low).max((to - high).min(0.0));
    let x = within(place.left(), place.right(), frame.left(), frame.right());
    let y = within(place.top(), place.bottom(), frame.top(), frame.bottom());
    // Where one looks at a part, the names of what is elsewhere stay there.
    if x.abs() > place.width() || y.abs() > place.height() {
        return place;
    }
    place.translate(vec2(x, y))
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
