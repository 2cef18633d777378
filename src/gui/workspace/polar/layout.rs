//! Where the parts of the polar view go, in divisions from its middle.

use egui::Pos2;
use egui_plot::{PlotPoint, PlotTransform};

use super::model::{Polar, Spot};

/// Radius of the nominal circle, divisions.
pub(crate) const NOMINAL: f64 = 8.0;
/// Spokes are so many parts of a turn apart.
pub(crate) const SPOKES: u8 = 12;
/// Room for the names of the spokes, divisions.
const ROOM: f64 = 1.9;
/// Chords of circles are parts of a turn.
const CHORDS: u16 = 180;

/// How angles lie on the screen: from where, and which way round.
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

    /// The point at an angle of the joint and so many divisions from the middle.
    pub(crate) fn at(self, q: f64, divisions: f64) -> [f64; 2] {
        let (sin, cos) = (self.zero_rad + self.way * q).sin_cos();
        [divisions * cos, divisions * sin]
    }

    /// The angle of the joint at a point, the turn nearest to `near`.
    pub(crate) fn angle_of(self, [x, y]: [f64; 2], near: f64) -> f64 {
        let angle = self.way * (y.atan2(x) - self.zero_rad);
        let turn = std::f64::consts::TAU;
        angle + turn * ((near - angle) / turn).round()
    }
}

/// How far from the middle a deviation is drawn, divisions; never on the other side of it.
pub(crate) fn radius(polar: &Polar, mm: f64) -> f64 {
    (NOMINAL + mm / polar.division_mm).max(0.0)
}

/// Smallest and largest corner, divisions.
pub(crate) fn bounds(polar: &Polar) -> [[f64; 2]; 2] {
    let out = NOMINAL + polar.divisions[1] + ROOM;
    [[-out; 2], [out; 2]]
}

/// A circle about the middle.
pub(crate) fn circle(divisions: f64) -> Vec<[f64; 2]> {
    let chord = |k: u16| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(CHORDS)).sin_cos();
        [divisions * cos, divisions * sin]
    };
    (0..=CHORDS).map(chord).collect()
}

/// The angle at which the rings are named: in the widest place without samples, or else between
/// two spokes.
pub(crate) fn names_at(polar: &Polar) -> f64 {
    let [low, high] = polar.range;
    let spoke = std::f64::consts::TAU / f64::from(SPOKES);
    let free = std::f64::consts::TAU - (high - low);
    let middle = if free.is_finite() && free > spoke {
        high + 0.5 * free
    } else {
        0.0
    };
    // Never on a spoke, whose own name stands there.
    ((middle / spoke).floor() + 0.5) * spoke
}

/// Where a spot's deviations are on the screen: before, unless only what is left is shown, and
/// after.
pub(crate) fn places(
    polar: &Polar,
    spot: &Spot,
    bearing: Bearing,
    only_after: bool,
    transform: &PlotTransform,
) -> [Option<Pos2>; 2] {
    let at = |mm: f64| {
        let [x, y] = bearing.at(spot.q, radius(polar, mm));
        (x.is_finite() && y.is_finite())
            .then(|| transform.position_from_point(&PlotPoint::new(x, y)))
    };
    let before = (!only_after || spot.after_mm.is_none()).then_some(spot.before_mm);
    [before.and_then(at), spot.after_mm.and_then(at)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::loaded_session::Component;

    fn polar() -> Polar {
        let spot = Spot {
            sample: 0,
            q: 0.5,
            before_mm: 0.4,
            after_mm: Some(-0.1),
            side: 0.0,
        };
        Polar::from_spots(vec![spot], Component::Radial, false)
    }

    #[test]
    fn a_deviation_outwards_is_outside_the_nominal_circle_by_its_divisions() {
        let polar = polar();
        assert_eq!(polar.division_mm, 0.1);
        assert!((radius(&polar, 0.4) - (NOMINAL + 4.0)).abs() < 1e-9);
        assert!(radius(&polar, -0.1) < NOMINAL);
        assert_eq!(radius(&polar, -1e9), 0.0);
        let [low, high] = bounds(&polar);
        assert!(high[0] > radius(&polar, 0.4) && low[1] < -radius(&polar, 0.4));
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
    fn rings_are_named_where_no_samples_are() {
        let mut polar = polar();
        polar.range = [-2.0, 2.0];
        let between = names_at(&polar).to_degrees();
        assert!((between - 165.0).abs() < 1e-9 || (between - 195.0).abs() < 1e-9);
        polar.range = [-3.1, 3.1];
        let between = names_at(&polar).to_degrees();
        assert!((between - 15.0).abs() < 1e-9);
    }
}
