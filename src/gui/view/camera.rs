//! From where the workspace is looked at, on a plane or in three dimensions, and what its colours say.
//!
//! The projection is parallel, so that lengths across the line of sight can be read everywhere. With
//! azimuth a and elevation e the unit vectors of the view are, in the base frame (z up),
//!
//! ```text
//! towards = (cos e cos a, cos e sin a, sin e)      from the workspace towards the viewer
//! right   = (−sin a, cos a, 0)
//! up      = towards × right
//! ```
//!
//! so that z never leans to the side. The view fits a sphere around everything that is drawn: the
//! scale stays the same while the camera orbits.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use crate::gui::core::overview::corners;
use crate::lanes::dot;

/// Axes of a view: orthogonal unit vectors, right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facing {
    /// To the right on the screen.
    pub(crate) right: [f64; 3],
    /// Up on the screen.
    pub(crate) up: [f64; 3],
    /// Out of the screen, towards the viewer.
    pub(crate) towards: [f64; 3],
}

impl Facing {
    /// The same view with each of its axes exchanged.
    pub(crate) fn map(self, of: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self {
            right: of(self.right),
            up: of(self.up),
            towards: of(self.towards),
        }
    }

    /// A point or vector as it is seen: to the right and up, mm.
    pub(crate) fn flat(&self, p: [f64; 3]) -> [f64; 2] {
        [dot(self.right, p), dot(self.up, p)]
    }

    /// How near to the viewer a point is, mm; the larger the nearer.
    pub(crate) fn nearness(&self, p: [f64; 3]) -> f64 {
        dot(self.towards, p)
    }

    /// Smallest and largest corner of a box as it is seen, mm. `ends` are the box's corners with
    /// the smallest and with the largest coordinates.
    pub(crate) fn flat_box(&self, ends: [[f64; 3]; 2]) -> [[f64; 2]; 2] {
        let corner = |corner: usize| self.flat([0, 1, 2].map(|k| ends[corner >> k & 1][k]));
        corners((0..8).map(corner))
    }
}

/// A ball around everything that is drawn, mm of the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ball {
    pub(crate) centre_mm: [f64; 3],
    pub(crate) radius_mm: f64,
}

impl Ball {
    /// The ball around these points, mm; those that are not finite do not count.
    pub(crate) fn around(points: &[[f64; 3]]) -> Self {
        let finite = points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
        let [low, high] = corners(finite.copied());
        if low[0] > high[0] {
            return Self {
                centre_mm: [0.0; 3],
                radius_mm: 1.0,
            };
        }
        let centre_mm = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let from_centre = |p: &[f64; 3]| {
            let off = [0, 1, 2].map(|k| p[k] - centre_mm[k]);
            dot(off, off).sqrt()
        };
        let far = points.iter().map(from_centre).filter(|d| d.is_finite());
        Self {
            centre_mm,
            radius_mm: far.fold(1.0, f64::max),
        }
    }
}

/// Azimuth and elevation for each point that is dragged, rad.
const TURN: f64 = 0.008;
/// The smallest and the largest zoom.
const ZOOM: [f64; 2] = [0.1, 1e5];
/// The ball takes this part of the plot.
const FILLED: f64 = 0.96;

/// Direction, distance and centre of the three-dimensional view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Camera {
    /// About z, from x, rad.
    pub(crate) azimuth_rad: f64,
    /// Above the plane of x and y, rad, from −π/2 to π/2.
    pub(crate) elevation_rad: f64,
    /// 1: everything fits.
    pub(crate) zoom: f64,
    /// The point that is in the middle of the plot and that the camera orbits about, from the middle
    /// of everything, mm.
    pub(crate) offset_mm: [f64; 3],
}

impl Default for Camera {
    /// The three axes look equally long: tan e = 1/√2.
    fn default() -> Self {
        Self {
            azimuth_rad: -FRAC_PI_4,
            elevation_rad: 0.5_f64.sqrt().atan(),
            zoom: 1.0,
            offset_mm: [0.0; 3],
        }
    }
}

impl Camera {
    pub(crate) fn facing(&self) -> Facing {
        let (sin_a, cos_a) = self.azimuth_rad.sin_cos();
        let (sin_e, cos_e) = self.elevation_rad.sin_cos();
        Facing {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            towards: [cos_e * cos_a, cos_e * sin_a, sin_e],
        }
    }

    /// The same direction, everything in sight.
    pub(crate) fn fitted(self) -> Self {
        Self {
            zoom: 1.0,
            offset_mm: [0.0; 3],
            ..self
        }
    }

    /// Points on the screen for each mm, in a plot of this size in points.
    pub(crate) fn points_per_mm(&self, ball: &Ball, size: [f64; 2]) -> f64 {
        let half = 0.5 * size[0].min(size[1]).max(1.0);
        self.zoom * FILLED * half / ball.radius_mm
    }

    /// Smallest and largest corner of what a plot of this size (points) shows, mm to the right and
    /// up from the projected origin.
    pub(crate) fn bounds(&self, ball: &Ball, size: [f64; 2]) -> [[f64; 2]; 2] {
        let scale = self.points_per_mm(ball, size);
        let middle = [0, 1, 2].map(|k| ball.centre_mm[k] + self.offset_mm[k]);
        let middle = self.facing().flat(middle);
        let half = size.map(|side| 0.5 * side.max(1.0) / scale);
        [
            [middle[0] - half[0], middle[1] - half[1]],
            [middle[0] + half[0], middle[1] + half[1]],
        ]
    }

    /// After a drag by so many points to the right and down: what is near follows the pointer.
    pub(crate) fn orbited(self, [right, down]: [f64; 2]) -> Self {
        let azimuth = self.azimuth_rad - TURN * right;
        let elevation = self.elevation_rad + TURN * down;
        Self {
            azimuth_rad: azimuth - TAU * (azimuth / TAU).round(),
            elevation_rad: elevation.clamp(-FRAC_PI_2, FRAC_PI_2),
            ..self
        }
    }

    /// After a drag by so many mm to the right and up: everything follows the pointer.
    pub(crate) fn panned(self, [right, up]: [f64; 2]) -> Self {
        let facing = self.facing();
        Self {
            offset_mm: [0, 1, 2]
                .map(|k| self.offset_mm[k] - right * facing.right[k] - up * facing.up[k]),
            ..self
        }
    }

    /// Closer by this factor about a point that is so many mm to the right of the plot's middle and
    /// above it: that point stays where it is on the screen.
    pub(crate) fn zoomed(self, factor: f64, [right, up]: [f64; 2]) -> Self {
        let next = Self {
            zoom: (self.zoom * factor).clamp(ZOOM[0], ZOOM[1]),
            ..self
        };
        let part = self.zoom / next.zoom - 1.0;
        next.panned([right * part, up * part])
    }

    /// In words: from which direction.
    pub(crate) fn describe(&self) -> String {
        let [azimuth, elevation] = [self.azimuth_rad, self.elevation_rad]
            .map(|a| crate::present::numbers::trimmed(a.to_degrees(), 0));
        say!(
            "seen from azimuth {azimuth}°, elevation {elevation}°",
            azimuth,
            elevation
        )
    }
}

named! {
    /// The plane that the workspace is looked at in.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub(crate) enum Plane {
        /// From above.
        #[default]
        Xy = "x y",
        /// From the side.
        Xz = "x z",
        /// From the front.
        Yz = "y z",
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Plane {
    /// The axes that it shows: to the right, and up.
    pub(crate) fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Xz => [0, 2],
            Self::Yz => [1, 2],
        }
    }

    /// Its axes in the measuring frame.
    pub(crate) fn facing(self) -> Facing {
        let unit = |axis: usize, sign: f64| [0, 1, 2].map(|k| if k == axis { sign } else { 0.0 });
        let [right, up] = self.axes();
        let sign = if self == Self::Xz { -1.0 } else { 1.0 };
        Facing {
            right: unit(right, 1.0),
            up: unit(up, 1.0),
            towards: unit(self.normal(), sign),
        }
    }

    /// The axis that it looks along.
    pub(crate) fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    //! The geometry of the camera: where points are on the screen before and after it moves.

    use super::*;

    const BALL: Ball = Ball {
        centre_mm: [100.0, -50.0, 300.0],
        radius_mm: 400.0,
    };
    const SIZE: [f64; 2] = [600.0, 400.0];

    /// Where a point is on the screen, points from the upper left corner.
    fn seen(camera: &Camera, p: [f64; 3]) -> [f64; 2] {
        let [low, high] = camera.bounds(&BALL, SIZE);
        let [x, y] = camera.facing().flat(p);
        [
            (x - low[0]) / (high[0] - low[0]) * SIZE[0],
            (high[1] - y) / (high[1] - low[1]) * SIZE[1],
        ]
    }

    fn near(a: [f64; 2], b: [f64; 2]) {
        assert!(
            (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9,
            "{a:?} {b:?}"
        );
    }

    #[test]
    fn the_axes_of_a_view_are_a_right_handed_frame_with_z_upright() {
        for (azimuth_rad, elevation_rad) in [(0.3, 0.5), (-2.0, -1.2), (3.0, 1.5)] {
            let camera = Camera {
                azimuth_rad,
                elevation_rad,
                ..Camera::default()
            };
            let Facing { right, up, towards } = camera.facing();
            let cross = [
                right[1] * up[2] - right[2] * up[1],
                right[2] * up[0] - right[0] * up[2],
                right[0] * up[1] - right[1] * up[0],
            ];
            assert!((0..3).all(|k| (cross[k] - towards[k]).abs() < 1e-12));
            assert!((dot(up, up) - 1.0).abs() < 1e-12 && right[2] == 0.0 && up[2] > 0.0);
        }
    }

    #[test]
    fn what_is_drawn_fits_from_every_side() {
        let mut camera = Camera::default();
        for _ in 0..40 {
            camera = camera.orbited([37.0, 11.0]);
            for corner in 0..8_usize {
                let side = BALL.radius_mm / 3.0_f64.sqrt();
                let p = [0, 1, 2]
                    .map(|k| BALL.centre_mm[k] + if corner >> k & 1 == 1 { side } else { -side });
                let [x, y] = seen(&camera, p);
                assert!((0.0..=SIZE[0]).contains(&x) && (0.0..=SIZE[1]).contains(&y));
            }
        }
    }

    #[test]
    fn orbiting_leaves_the_pivot_in_the_middle_and_turns_what_is_near_with_the_pointer() {
        let camera = Camera::default().panned([40.0, -25.0]);
        let pivot = [0, 1, 2].map(|k| BALL.centre_mm[k] + camera.offset_mm[k]);
        let turned = camera.orbited([50.0, 20.0]);
        near(seen(&camera, pivot), [300.0, 200.0]);
        near(seen(&turned, pivot), [300.0, 200.0]);
        let towards = camera.facing().towards;
        let front = [0, 1, 2].map(|k| pivot[k] + 100.0 * towards[k]);
        let (before, after) = (seen(&camera, front), seen(&turned, front));
        assert!(
            after[0] > before[0] && after[1] > before[1],
            "{before:?} {after:?}"
        );
        // Straight from above is as far as it goes.
        assert_eq!(camera.orbited([0.0, 1e6]).elevation_rad, FRAC_PI_2);
    }

    #[test]
    fn panning_takes_everything_along_by_as_many_points_as_the_pointer_moved() {
        let camera = Camera::default()
            .zoomed(3.0, [0.0; 2])
            .orbited([15.0, -30.0]);
        let p = [80.0, 20.0, 250.0];
        let scale = camera.points_per_mm(&BALL, SIZE);
        let moved = camera.panned([24.0 / scale, 10.0 / scale]);
        let [x, y] = seen(&camera, p);
        near(seen(&moved, p), [x + 24.0, y - 10.0]);
    }

    #[test]
    fn zooming_leaves_what_is_under_the_pointer_where_it_is() {
        let camera = Camera::default().orbited([70.0, 30.0]);
        let p = [180.0, 60.0, 410.0];
        let [x, y] = seen(&camera, p);
        let scale = camera.points_per_mm(&BALL, SIZE);
        let at = [(x - 0.5 * SIZE[0]) / scale, (0.5 * SIZE[1] - y) / scale];
        let closer = camera.zoomed(4.0, at);
        near(seen(&closer, p), [x, y]);
        assert!((closer.points_per_mm(&BALL, SIZE) / scale - 4.0).abs() < 1e-9);
        assert_eq!(
            closer.fitted().bounds(&BALL, SIZE),
            camera.fitted().bounds(&BALL, SIZE)
        );
        // No nearer than numbers go, and then nothing moves.
        assert_eq!(camera.zoomed(1e30, [0.0; 2]).zoom, ZOOM[1]);
    }

    #[test]
    fn around_no_point_at_all_there_is_a_ball_that_can_be_drawn() {
        assert_eq!(Ball::around(&[[f64::INFINITY; 3]]).radius_mm, 1.0);
    }
}
