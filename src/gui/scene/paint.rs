//! The camera: where things of a scene are in its picture; and what forms become there.

use egui::{Pos2, Rect, Vec2, vec2};
use egui_plot::{PlotBounds, PlotPoint, PlotTransform};

use crate::numeric::single;

use crate::gui::view::Facing;

use super::Place;

/// Corners of forms that look to the right, of a radius of 1.
pub(crate) const DIAMOND: [[f32; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
pub(crate) const TRIANGLE: [[f32; 2]; 3] = [[1.25, 0.0], [-0.75, 1.1], [-0.75, -1.1]];
pub(super) const SQUARE: [[f32; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// The same of this radius about a point, looking that way.
pub(crate) fn corners_of(corners: &[[f32; 2]], at: Pos2, radius: f32, ahead: Vec2) -> Vec<Pos2> {
    let across = vec2(-ahead.y, ahead.x);
    let corner = |[x, y]: &[f32; 2]| at + (ahead * *x + across * *y) * radius;
    corners.iter().map(corner).collect()
}

/// The convex hull of points, in order around it (Andrew's monotone chain).
pub(super) fn hull(mut points: Vec<Pos2>) -> Vec<Pos2> {
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

/// Planes and the view in space are parallel projections of mm of the measuring frame along the line of sight; in a
/// plane the camera is locked. A plot's coordinates are mm.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    facing: Facing,
    transform: PlotTransform,
}

impl Camera {
    pub(crate) fn new(facing: Facing, transform: &PlotTransform) -> Self {
        Self {
            facing,
            transform: *transform,
        }
    }

    /// One that shows these bounds (smallest and largest corner), with the same scale both ways, in a
    /// rectangle.
    pub(crate) fn showing(facing: Facing, [low, high]: [[f64; 2]; 2], frame: Rect) -> Self {
        let sides = [frame.width(), frame.height()].map(f64::from);
        let scale = (0..2).map(|k| sides[k] / (high[k] - low[k]).max(1e-9));
        let scale = scale.fold(f64::INFINITY, f64::min);
        let half = sides.map(|side| 0.5 * side / scale);
        let middle = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
        let bounds = PlotBounds::from_min_max(
            [middle[0] - half[0], middle[1] - half[1]],
            [middle[0] + half[0], middle[1] + half[1]],
        );
        Self::new(facing, &PlotTransform::new(frame, bounds, false))
    }

    /// A picture of signs alone: points to the right and up of `at`.
    pub(crate) fn of_signs(at: Pos2) -> Self {
        let facing = crate::gui::view::Plane::Xy.facing();
        let frame = Rect::from_center_size(at, Vec2::splat(2.0));
        Self::showing(facing, [[-1.0; 2], [1.0; 2]], frame)
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
        self.facing.flat(p)
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

    /// How near to the viewer a point is, mm; the same for all where nothing is near.
    pub(crate) fn nearness(&self, p: [f64; 3]) -> f64 {
        self.facing.nearness(p)
    }

    /// How a direction looks in the picture: as long as it is drawn, of 1.
    pub(crate) fn direction(&self, along: [f64; 3]) -> Vec2 {
        let [right, up] = self.facing.flat(along);
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
}
