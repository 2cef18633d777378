//! From a scene to lines, areas and words of a picture, whatever the picture is drawn on; and the camera: where
//! things of the scene are in it.

use egui::{Pos2, Rect, Vec2, vec2};
use egui_plot::{PlotBounds, PlotPoint, PlotTransform};

use crate::numeric::single;

use crate::gui::view::Facing;

use super::{Form, Item, Label, Layer, Mark, Place, Scene, Stroke, Tint};

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

/// How angles lie in a picture: from where, and which way round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bearing {
    /// Where 0 is, rad from the right, anticlockwise.
    pub(crate) zero_rad: f64,
    /// 1 anticlockwise, −1 clockwise.
    pub(crate) way: f64,
}

impl Bearing {
    /// As in the plane with these directions of the tool at home and a quarter turn further.
    pub(crate) fn of(radial: [f64; 2], tangential: [f64; 2]) -> Self {
        let turn = radial[0] * tangential[1] - radial[1] * tangential[0];
        Self {
            zero_rad: radial[1].atan2(radial[0]),
            way: if turn < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// The point at an angle of the joint and so far from the middle.
    pub(crate) fn at(self, q: f64, radius: f64) -> [f64; 2] {
        let (sin, cos) = (self.zero_rad + self.way * q).sin_cos();
        [radius * cos, radius * sin]
    }

    /// The angle of the joint at a point, the turn nearest to `near`.
    pub(crate) fn angle_of(self, [x, y]: [f64; 2], near: f64) -> f64 {
        let angle = self.way * (y.atan2(x) - self.zero_rad);
        let turn = std::f64::consts::TAU;
        angle + turn * ((near - angle) / turn).round()
    }
}

/// Planes and the view in space are parallel projections of mm of the measuring frame; in a plane
/// the camera is locked. The polar view is a projection as well: its first coordinate is the angle
/// of the joint, its second the deviation.
///
/// From mm to the coordinates of a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Projection {
    /// Along the line of sight; a plot's coordinates are mm.
    Parallel(Facing),
    /// Around the angle of a joint: a deviation of 0 is on the circle with this radius, never on the
    /// other side of the middle.
    Around(Bearing, f64),
}

/// A projection, and where the plot's coordinates are in the picture.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    projection: Projection,
    transform: PlotTransform,
}

impl Camera {
    pub(crate) fn new(projection: Projection, transform: &PlotTransform) -> Self {
        Self {
            projection,
            transform: *transform,
        }
    }

    /// One that shows these bounds (smallest and largest corner), with the same scale both ways, in a
    /// rectangle.
    pub(crate) fn showing(projection: Projection, [low, high]: [[f64; 2]; 2], frame: Rect) -> Self {
        let sides = [frame.width(), frame.height()].map(f64::from);
        let scale = (0..2).map(|k| sides[k] / (high[k] - low[k]).max(1e-9));
        let scale = scale.fold(f64::INFINITY, f64::min);
        let half = sides.map(|side| 0.5 * side / scale);
        let middle = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
        let bounds = PlotBounds::from_min_max(
            [middle[0] - half[0], middle[1] - half[1]],
            [middle[0] + half[0], middle[1] + half[1]],
        );
        Self::new(projection, &PlotTransform::new(frame, bounds, false))
    }

    /// A picture of signs alone: points to the right and up of `at`.
    pub(crate) fn of_signs(at: Pos2) -> Self {
        let facing = crate::gui::view::Plane::Xy.facing();
        let frame = Rect::from_center_size(at, Vec2::splat(2.0));
        Self::showing(Projection::Parallel(facing), [[-1.0; 2], [1.0; 2]], frame)
    }

    pub(crate) fn transform(&self) -> &PlotTransform {
        &self.transform
    }

    pub(crate) fn frame(&self) -> Rect {
        *self.transform.frame()
    }

    /// Points of the picture for each mm.
    pub(crate) fn points_per_mm(&self) -> f64 {
        self.transform.dpos_dvalue_x().abs()
    }

    /// A point in the coordinates of the plot.
    pub(crate) fn flat(&self, p: [f64; 3]) -> [f64; 2] {
        match self.projection {
            Projection::Parallel(facing) => facing.flat(p),
            Projection::Around(bearing, nominal) => bearing.at(p[0], (nominal + p[1]).max(0.0)),
        }
    }

    /// A point in the picture.
    pub(crate) fn at(&self, p: [f64; 3]) -> Pos2 {
        let [x, y] = self.flat(p);
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    /// A place in the picture.
    pub(crate) fn place(&self, place: &Place) -> Pos2 {
        let [x, y] = place.aside;
        self.at(place.at) + vec2(x, y)
    }

    /// Where marks of samples are in the picture.
    pub(crate) fn samples(&self, scene: &Scene) -> impl Iterator<Item = (usize, [f32; 2])> {
        scene.items.iter().filter_map(|item| match item {
            Item::Mark(mark) => Some((mark.sample?, self.place(&mark.at).into())),
            _ => None,
        })
    }

    /// How near to the viewer a point is, mm; the same for all where nothing is near.
    pub(crate) fn nearness(&self, p: [f64; 3]) -> f64 {
        match self.projection {
            Projection::Parallel(facing) => facing.nearness(p),
            Projection::Around(..) => 0.0,
        }
    }

    /// How a direction at a point looks in the picture: as long as it is drawn, of 1.
    pub(crate) fn direction(&self, at: [f64; 3], along: [f64; 3]) -> Vec2 {
        let [right, up] = match self.projection {
            Projection::Parallel(facing) => facing.flat(along),
            Projection::Around(bearing, _) => {
                let [out, around] = [along[1], bearing.way * along[0]];
                let [x, y] = bearing.at(at[0], 1.0);
                [out * x - around * y, out * y + around * x]
            }
        };
        vec2(single(right), -single(up))
    }
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

    #[test]
    fn an_angle_is_found_again_whichever_way_the_joint_turns() {
        for (radial, tangential) in [
            ([1.0, 0.0], [0.0, 1.0]),
            ([0.0, 1.0], [1.0, 0.0]),
            ([-0.6, 0.8], [-0.8, -0.6]),
        ] {
            let bearing = Bearing::of(radial, tangential);
            let quarter = bearing.at(std::f64::consts::FRAC_PI_2, 1.0);
            for k in 0..2 {
                assert!((bearing.at(0.0, 1.0)[k] - radial[k]).abs() < 1e-12);
                assert!((quarter[k] - tangential[k]).abs() < 1e-12);
            }
            for q in [-4.0, -0.3, 0.0, 2.0, 5.5] {
                let found = bearing.angle_of(bearing.at(q, 7.0), q + 0.2);
                assert!((found - q).abs() < 1e-12, "{q} {found}");
            }
        }
    }

    #[test]
    fn around_a_joint_a_deviation_is_outside_its_circle_and_a_way_along_it() {
        let frame = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0));
        let bounds = [[-10.0; 2], [10.0; 2]];
        for way in [1.0, -1.0] {
            let zero_rad = 0.3;
            let around = Projection::Around(Bearing { zero_rad, way }, 8.0);
            let camera = Camera::showing(around, bounds, frame);
            assert_eq!(camera.points_per_mm(), 5.0);
            let radius = |mm: f64| camera.at([0.7, mm, 0.0]).distance(frame.center());
            assert!((radius(0.0) - 40.0).abs() < 1e-3 && (radius(1.0) - 45.0).abs() < 1e-3);
            assert!(radius(-1e9) < 1e-3);
            for along in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
                let step = [0.7 + 1e-4 * along[0], 8e-4 * along[1], 0.0];
                let moved = camera.at(step) - camera.at([0.7, 0.0, 0.0]);
                let found = camera.direction([0.7, 0.0, 0.0], along);
                assert!((found.length() - 1.0).abs() < 1e-6);
                assert!(moved.normalized().dot(found) > 0.99, "{moved:?} {found:?}");
            }
        }
    }
}
