//! Link geometry: the real axis of a joint runs elsewhere than the nominal one.
//!
//! ```text
//! p = … exp([ξ_{i−1}] θ_{i−1}) · T_i · exp([ξ_i] θ_i) …,   T_i = exp [x X + y Y; α X + β Y]
//! ```
//!
//! `T_i` is a constant rigid motion relative to the link before: the axis of joint i and everything
//! behind it move. Its screw is about the joint's own point (`point_mm`; the origin of the joint's
//! frame where the robot came as DH rows or URDF), so that the angles turn the axis about that
//! point and the lengths shift it. X is the base axis that is least parallel to the joint's axis
//! at home, made perpendicular to it (the first of equals), Y = axis × X. As both directions are
//! across the joint's own axis no neighbour can make them singular, which the Denavit–Hartenberg
//! rows of parallel axes are. A sliding joint has the two angles: it does not matter where it runs.
//!
//! Belongs to the calibration of every robot with several joints and is never a candidate.

use super::about::{About, Form, Prior, Quantity, Role, Stage};
use super::block::Block;
use super::block::moving::RigidMotion;
use super::needs::Need;
use super::rotation::{left_jacobian, rotation};
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::{add_scaled, cross, dot, scaled, times};
use crate::rounding;
use crate::text::Text;

const ABOUT: About = About {
    id: "link-geometry",
    title: phrase!("Link geometry"),
    stage: Stage::Bearing,
    form: Form::Plain(&[
        Quantity::new("x_mm", Unit::MM).not_sliding(),
        Quantity::new("y_mm", Unit::MM).not_sliding(),
        Quantity::new("about_x_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_y_mrad", Unit::MILLIRADIAN),
    ]),
    equation: "T_i = exp of a small screw across the axis, before joint i",
    source: "Okamura & Park, Kinematic calibration using the product of exponentials formula, 1996",
    cause: phrase!(
        "links are longer or shorter than in the nominal model, axes are not square or not parallel"
    ),
    usual_size: phrase!("0.05 to 1 mm, 0.05 to 2 mrad"),
    confused_with: phrase!("the zero of the joint before, where the axes are square to each other"),
    check: phrase!("the kinematic data in the controller"),
    needs: &[SEVERAL_JOINTS],
    role: Role::JointAxis,
    priors: &[
        Prior::of(1.0),
        Prior::of(1.0),
        Prior::of(2e-3),
        Prior::of(2e-3),
    ],
    ..About::PLAIN
};

const SEVERAL_JOINTS: Need = Need::of_samples(Need::SEVERAL_JOINTS, |survey, _| {
    (survey.joints.len() == 1)
        .then(|| text!("the robot has a single axis: axis tilt and base offset take its place"))
});

/// The effect `link-geometry`: position in mm and direction in rad of a joint's axis.
pub static LINK_GEOMETRY: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, _: &Term) -> Text {
    text!("enter the identified geometry as the controller's kinematic data")
}

fn act(me: &Placed, block: &mut Block) {
    let (x, y) = across(me.frame.along);
    let c = &me.coefficients;
    let screw = Screw {
        turn: add_scaled(scaled(x, c[2]), y, c[3]),
        shift: add_scaled(scaled(x, c[0]), y, c[1]),
    };
    let zero = [0.0; 3];
    let units = [(zero, x), (zero, y), (x, zero), (y, zero)];
    let mut by = units.map(|(turn, shift)| Screw { turn, shift });
    if block.asks_for::<4>(me) {
        by = by.map(|unit| screw.left_jacobian_times(unit));
    }
    let motion = RigidMotion {
        origin_mm: me.frame.origin_mm,
        rotation: rotation(screw.turn),
        shift_mm: times(left_jacobian(screw.turn), screw.shift),
        by: by.map(|by| (by.turn, by.shift)),
    };
    block.move_rigidly(me, &motion);
}

/// X and Y of a joint with this axis: see the module.
pub(crate) fn across(along: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let mut least = 0;
    for axis in 1..3 {
        if along[axis].abs() < along[least].abs() - rounding::WRITTEN {
            least = axis;
        }
    }
    let unit: [f64; 3] = std::array::from_fn(|k| f64::from(u8::from(k == least)));
    let x = add_scaled(unit, along, -dot(unit, along));
    let x = scaled(x, 1.0 / dot(x, x).sqrt());
    (x, cross(along, x))
}

/// A screw about a joint's point.
#[derive(Clone, Copy)]
struct Screw {
    turn: [f64; 3],
    shift: [f64; 3],
}

impl Screw {
    /// The left Jacobian of SE(3) at this screw times another one, `Σ adⁿ/(n + 1)!`: the derivative
    /// of the exponential as a screw (Barfoot, *State Estimation for Robotics*, 2017, §7.1.5).
    fn left_jacobian_times(self, of: Self) -> Self {
        let mut sum = of;
        let mut power = of;
        for n in 1..MOST_TERMS {
            let factor = 1.0 / (n + 1) as f64;
            let turn = cross(self.turn, power.turn);
            let shift = add_scaled(
                cross(self.turn, power.shift),
                cross(self.shift, power.turn),
                1.0,
            );
            power = Self {
                turn: scaled(turn, factor),
                shift: scaled(shift, factor),
            };
            sum.turn = add_scaled(sum.turn, power.turn, 1.0);
            sum.shift = add_scaled(sum.shift, power.shift, 1.0);
            let all = power.turn.iter().chain(&power.shift);
            if all.fold(0.0, |largest, v| v.abs().max(largest)) < NOTHING {
                break;
            }
        }
        sum
    }
}

/// Of small errors a few terms are enough: what follows changes no bit of a column.
const NOTHING: f64 = 1e-30;
/// Enough for turns up to π to the last bits.
const MOST_TERMS: usize = 24;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn x_is_the_base_axis_least_parallel_to_the_joints_axis() {
        assert_eq!(across([0.0, 0.0, 1.0]), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
        assert_eq!(across([0.0, 1.0, 0.0]), ([1.0, 0.0, 0.0], [0.0, 0.0, -1.0]));
        assert_eq!(across([1.0, 0.0, 0.0]), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
        let (x, _) = across([0.6, 0.0, 0.8]);
        assert_eq!(x, [0.0, 1.0, 0.0]);
        // Rounding decides nothing.
        let (x, _) = across([1e-17, 0.0, 1.0]);
        assert!((x[0] - 1.0).abs() < 1e-12);
    }
}
